"""What is wrong is said in words of Python, by exceptions of the right kind, and nothing is left half made."""

import errno
import os
import pathlib
import pickle
import re
import subprocess
import sys

import pytest

import festoon as fs
from conftest import BUILD
from festoon import _errors

SOURCE = pathlib.Path(__file__).resolve().parents[2]

#: Sentences of the library that Python never hears: it begins with the library's defaults, and never writes a field.
UNHEARD = ("fst_default_", "a field of fst_params")


# ---------------------------------------------------------------------------------------- names


def literals(unit):
    """The string literals of a C file, neighbours joined."""
    text = re.sub(r'"\s*\n\s*"', "", re.sub(r"^#.*$", "", unit.read_text(encoding="utf-8"), flags=re.M))
    text = re.sub(r"\bassert\(.*?\);", "", text)  # nobody is told these
    return re.findall(r'"((?:[^"\\\n]|\\.)*)"', text)


def test_no_sentence_has_a_name_of_c():
    """Every sentence and every place of the library's sources, as Python says it."""
    heard, places = [], []
    for unit in sorted((SOURCE / "src").rglob("*.c")):
        if unit.parent.name == "cli":
            continue
        for text in literals(unit):
            if re.fullmatch(r"fst_\w+(\.\w+)*", text):
                places.append(text)
            elif "fst_" in text and not any(word in text for word in UNHEARD):
                heard.append(text)
    assert len(places) > 60 and len(heard) >= 6
    assert [text for text in heard if "fst_" in _errors.sentence_in_python(text)] == []
    assert [text for text in places if "fst_" in _errors.place_in_python(text)] == []
    for ours in _errors.CALLS.values():
        if "()" in ours:
            kind, name = ours.removesuffix("()").split(".")
            assert callable(getattr(fs if kind == "festoon" else getattr(fs, kind), name))


@pytest.mark.parametrize("call, words", [
    (lambda: fs.Bead(magnet__parts=3), "magnet.parts: it must be a list of dictionaries, one a part"),
    (lambda: fs.Bead(magnet__parts=[3]), "magnet.parts: "), (lambda: fs.Beads(beads=3), "beads: it must be a list of dictionaries"),
    (lambda: fs.sweep(kappa=[1, 2], refine="x"), "refine must be a whole number"),
    (lambda: fs.sweep(kappa=[1, 2], refine=1, refine_step="x"), "refine_step must be a number, not 'x'"),
    (lambda: fs.sweep(kappa=[1, 2], shard=3), "shard: 3 is not"), (lambda: fs.Bead().rhs("a"), "rhs: 'a' is no array of numbers"),
    (lambda: fs.Bead().field(["a"], 1), "field: "), (lambda: fs.Bead().branch(omega=(0.2, 0.3), step="x"), "step must be a number"),
    (lambda: fs.merge([], "all.db"), "merge: there are no databases")])
def test_wrong_arguments_are_named(call, words):
    with pytest.raises((fs.BadInput, TypeError)) as caught:
        call()
    assert str(caught.value).startswith(words)


def test_arguments_have_their_names():
    for call, where in (
        (lambda: fs.Bead().flow(rtol=9), "flow"),
        (lambda: fs.Bead().orbit(festoons=-3), "festoons"),
        (lambda: fs.fit({"frequency [Hz]": [9.0], "mean_r [mm]": [17.0], "mean_r_error [mm]": [0.1]}, free=["run.rtol"]), "free"),
        (lambda: fs.Bead().branch(omega=(0.2, 0.2)), "branch"),
    ):
        with pytest.raises(fs.BadInput) as caught:
            call()
        assert caught.value.where == where and "fst_" not in str(caught.value)
    with pytest.raises(fs.BadInput) as caught:
        fs.paper("nowhere", only="onse")
    assert caught.value.where == "only" and caught.value.sentence.startswith("there is no statement")
    with pytest.raises(fs.NoConvergence, match=r"Bead.locked\(\)"):
        fs.Bead(frequency=2).orbit()


@pytest.mark.parametrize(
    "wrong, right",
    [("kapa", "kappa"), ("frequncy", "frequency"), ("omga", "omega"), ("gama", "gamma"), ("radus", "bead__radius"),
     ("friction_law", "friction__law"), ("magnet_depth", "magnet__depth"), ("dynamics", "model__dynamics")],
)
def test_the_nearest_keyword_is_named(wrong, right):
    """Of short names and long ones, wherever a keyword is taken."""
    for call in (
        lambda: fs.Bead(**{wrong: 1.2}),
        lambda: fs.Bead().replace(**{wrong: 1.2}),
        lambda: fs.sweep(**{wrong: [1.2, 1.3]}),
        lambda: fs.Bead().branch(**{wrong: (1.2, 1.3)}),
        lambda: fs.fit({"frequency [Hz]": [9.0], "mean_r [mm]": [17.0]}, free=[wrong]),
    ):
        with pytest.raises(fs.BadInput) as caught:
            call()
        assert caught.value.where == wrong
        assert f"the nearest is {right} (festoon.schema() lists them all)" in caught.value.sentence


def test_no_nearest_keyword_that_is_far():
    with pytest.raises(fs.BadInput) as caught:
        fs.Bead(xyzzy=3)
    assert caught.value.sentence == 'unknown keyword "xyzzy"; festoon.schema() lists them all'


@pytest.mark.parametrize("keyword", ["coils", "field__uniform", "start__position", "magnet__parts"])
@pytest.mark.parametrize("value", [3, "3"])
def test_a_list_is_wanted(keyword, value):
    with pytest.raises(fs.BadInput) as caught:
        fs.Bead(**{keyword: value})
    assert caught.value.where == keyword.replace("__", ".")
    assert "it must be a list of " in caught.value.sentence and f"not {value!r}" in caught.value.sentence
    with pytest.raises(fs.BadInput):
        fs.Bead(coils=[value])


# ---------------------------------------------------------------------------------------- files


@pytest.mark.parametrize(
    "read",
    [
        fs.Bead, fs.Bead.load, fs.read, lambda path: fs.read(f"{path}.h5"), lambda path: fs.read(f"{path}.csv"),
        lambda path: fs.read(f"{path}.db"), lambda path: fs.read(f"{path}.json"), fs.read_track, fs.measure,
        lambda path: fs.fit(path, free="kappa"), lambda path: fs.fit(track=path, free="kappa"), fs.track,
        lambda path: fs.export(path, "rows.csv"), lambda path: fs.export(path, "rows.csv", ["mean_r"]),
        lambda path: fs.figures.sweep(path, "map.svg"), lambda path: fs.figures.over([path, path], "two.svg"),
        lambda path: fs.figures.points("run.json", path, "points.svg"),
        lambda path: fs.Bead(magnet__file=path),
    ],
)
def test_a_missing_file_is_not_found(read, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    with pytest.raises(FileNotFoundError) as caught:
        read("missing")
    error = caught.value
    assert isinstance(error, fs.BadInput) and isinstance(error, fs.InputOutput)
    assert error.errno == errno.ENOENT and error.filename.startswith("missing")
    assert str(error) == f"{error.filename}: cannot read this file: {os.strerror(errno.ENOENT)}"
    again = pickle.loads(pickle.dumps(error))
    assert (type(again), str(again), again.filename) == (fs.MissingFile, str(error), error.filename)
    assert list(tmp_path.iterdir()) == []


def test_a_missing_folder_is_not_found(tmp_path):
    for write in (
        fs.Bead().save, lambda path: fs.Bead(run__periods=2).run(trajectory=path),
        lambda path: fs.Bead().figure(path.with_suffix(".svg")),
    ):
        with pytest.raises(FileNotFoundError):
            write(tmp_path / "missing" / "file.csv")


# ---------------------------------------------------------------------------------------- memory

STARVED = """
import resource
import festoon as fs

bead = fs.Bead(run__periods=20)
before = bead.run(trajectory=True)
grid = fs.sweep(bead, kappa=[1.2, 1.5])
with open("/proc/self/statm") as file:
    pages = int(file.read().split()[0])
resource.setrlimit(resource.RLIMIT_AS, (resource.getpagesize() * pages + 150 * 2**20, resource.RLIM_INFINITY))
for call in (
    lambda: fs.sweep(bead, kappa="1:2:4000000"),
    lambda: bead.run(trajectory=True, start=before.final_state, periods=12000, discard=0),
):
    try:
        call()
    except MemoryError as error:
        assert isinstance(error, fs.OutOfMemory) and "no memory" in str(error), error
        print("told")
after = bead.run(trajectory=True)
assert after == before and fs.sweep(bead, kappa=[1.2, 1.5]) == grid
print("whole")
"""


def test_without_memory_a_call_says_so_and_the_next_one_works(tmp_path):
    """4 GB of rows and 280 MB of samples, where 150 MB are left; the sanitizers need more room themselves."""
    done = subprocess.run([sys.executable, "-B", "-c", STARVED], env={**os.environ, "PYTHONPATH": str(BUILD / "python")},
                          capture_output=True, text=True, check=False, cwd=tmp_path)
    assert (done.stdout, done.stderr) == ("told\ntold\nwhole\n", "")


def test_a_text_for_which_there_is_no_memory(monkeypatch):
    """Every function that returns a text returns NULL then: a MemoryError, and not an empty text."""
    from festoon import _native, bead, files, orbits, runs

    class Poor:
        def __getattr__(self, name):
            if name.endswith("_json") or name == "fst_scene_text":
                return lambda *_: _native.ffi.NULL
            return getattr(_native.lib, name)

    one = fs.Bead(run__periods=4)
    run, orbit, locked = one.run(), fs.Bead().orbit(), fs.Bead(frequency=3).locked()
    for module in (bead, files, orbits, runs):
        monkeypatch.setattr(module, "lib", Poor())
    for call in (one.scene, run.to_dict, orbit.to_dict, locked.to_dict, fs.schema):
        with pytest.raises(MemoryError) as caught:
            call()
        assert isinstance(caught.value, fs.FestoonError)


def test_a_sweep_is_read_whole_or_not(monkeypatch, tmp_path):
    """Without memory a refined sweep is not read as one that is not refined, nor with the rows that were written."""
    from festoon import sweeps

    file = tmp_path / "sweep.db"
    fs.sweep(fs.Bead(run__periods=2), kappa="1:2:5", refine=1, file=file)

    def starved(*arguments):
        if isinstance(arguments[2], bytes):
            pathlib.Path(os.fsdecode(arguments[2])).write_text("[]")
        arguments[-1].code = sweeps.lib.FST_NO_MEMORY
        return sweeps.lib.FST_NO_MEMORY

    for name in ("fst_sweep_read_filled", "fst_sweep_export"):

        class Poor:
            def __getattr__(self, asked, name=name):
                return starved if asked == name else getattr(_errors.lib, asked)

        with monkeypatch.context() as patch:
            patch.setattr(sweeps, "lib", Poor())
            with pytest.raises(MemoryError):
                fs.read(file)
    assert fs.read(file).refined
