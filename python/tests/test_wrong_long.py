"""Whatever is given to a call: an error of a documented kind, in words of Python; never a crash, and no other error."""

import inspect
import warnings

import numpy as np
import pytest

import festoon as fs

WRONG = [None, 3, -1, float("nan"), 10**30, "", "nonsense", "3 parsecs", "a\0b", b"x", [], [1, "x"], {}, {"x": [1]}, np.zeros((2, 3, 4)),
         np.array(["a"]), object(), (1, 2, 3), len, 1j, "10 mm", "\ud800"]
RIGHT = (TypeError, ValueError, KeyError, fs.FestoonError)
#: Arguments of which such a value may be right, and the work long; the sentence of a KeyError is its argument.
LONG = {"periods", "discard", "progress", "over", "tolerance", "steps", "sample_from", "rtol", "span", "until", "fps", "start", "height"}
#: They make files of many kinds, or last; their arguments are those of others.
LEFT = ("movie", "film", "advance", "lab", "critical", "lyapunov", "animate", "paper", "smooth")


def calls():
    """Every public function, and every method of a result, with the object that it is of."""
    bead = fs.Bead(run__periods=2, run__discard=1)
    bowl = fs.World(plate__shape="bowl", plate__bowl_radius="200 mm", run__periods=1, run__discard=0)
    pair = fs.Beads(beads=[{"start__phi": 3}, {"start__phi": 183}], frequency="30 Hz", run__periods=1, run__discard=0)
    run, several = bead.run(trajectory=True), pair.run(trajectory=True)
    seen = fs.Bead().run(periods=40, discard=20, trajectory=True, fps=240, sample_from=20).trajectory.lab
    track = fs.Track(np.column_stack([seen.t, seen.x, seen.y]))
    measured, sweep = fs.measure(track, drive="10.7 Hz"), fs.sweep(bead, kappa=[1.2, 1.5], frequency=[9, 10])
    branch = fs.Bead().branch(frequency=(10.5, 11))
    fit = fs.fit([measured] * 2, free="kappa", bead=fs.Bead(run__periods=20))
    made = [bead, pair, bowl, run, run.trajectory, track, measured, branch, sweep, fs.sweep(pair, frequency=[29, 30]), fit, bead.flow()]
    made += [fs.Bead(run__periods=20).orbit(), fs.Bead(frequency=3).locked(), several, several.trajectory, bowl.run()]
    for one in made:
        for name in dir(type(one)):
            method = getattr(one, name) if not name.startswith("_") and inspect.isfunction(getattr(type(one), name)) else None
            if method is not None and method.__func__.__module__.startswith("festoon."):
                yield f"{type(one).__name__}.{name}", method
    for home in (fs, fs.plots, fs.figures):
        for name in home.__all__:
            thing = getattr(home, name)
            if inspect.isfunction(thing) or thing in (fs.Track, fs.Flow):
                yield f"{home.__name__}.{name}", thing
    good = {"path": "out.svg", "x": 0.1, "y": 0.2, "states": np.zeros(10), "keyword": "kappa", "s": sweep, "b": branch, "f": fit, "m": measured}
    yield "", {**good, "tr": run.trajectory, "o": made[12], "bead": bead, "branches": branch, "measurements": [measured], "t": [0.0, 1.0]}


def test_wrong_arguments(tmp_path, monkeypatch):
    pytest.importorskip("matplotlib")
    monkeypatch.chdir(tmp_path)
    (tmp_path / "x").write_text("nothing\n")
    *functions, (_, good) = calls()
    looked_at, other = 0, []
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        for name, function in functions:
            if name.rsplit(".", 1)[1] in LEFT:
                continue
            given = [p for p in inspect.signature(function).parameters.values() if p.kind in (p.POSITIONAL_OR_KEYWORD, p.KEYWORD_ONLY)]
            needed = {p.name: good.get(p.name, "x") for p in given if p.default is p.empty}
            for parameter in [p.name for p in given if p.name not in LONG][:30]:
                for wrong in WRONG:
                    looked_at += 1
                    try:
                        function(**{**needed, parameter: wrong})
                    except RIGHT as error:
                        if any(word in str(error) for word in ("fst_", "cdata", "ctype", "cffi", "ffi.")):
                            other.append((name, parameter, wrong, repr(error)))
                    except Exception as error:  # of a kind that nobody expects
                        other.append((name, parameter, wrong, repr(error)))
    assert other == [] and looked_at > 4000
