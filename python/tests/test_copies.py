"""Copies and pickles are equal to what they were made of; parameters can be unset; Ctrl-C is obeyed at once."""

import copy
import os
import pickle
import signal
import subprocess
import sys
import threading

import numpy as np
import pytest

import festoon as fs
from conftest import BUILD

BALL = {"kind": "sphere", "centre": [0, 0, "-5 mm"], "size": "20 mm", "remanence": [1.2, 0, 0]}


@pytest.fixture(scope="module")
def track(tmp_path_factory):
    """A bead as a camera sees it, with one wild place."""
    lab = fs.Bead().run(periods=60, discard=20, trajectory=True, fps=240, sample_from=20).trajectory.lab
    noise = np.random.default_rng(1).normal(scale=0.05, size=(2, len(lab.t)))
    rows = np.column_stack([lab.t, lab.x + noise[0], lab.y + noise[1]])
    rows[100, 1] += 30
    path = tmp_path_factory.mktemp("track") / "track.csv"
    np.savetxt(path, rows, delimiter=",", header="# scale_error: 0.004\nt [s],x [mm],y [mm]", comments="")
    return path


def results(track):
    short = fs.Bead(run__periods=20)
    branch = short.branch(omega=(0.26, 0.275))
    grid = fs.sweep(short.replace(run__periods=4), kappa=[1.2, 1.5], frequency=[9, 10])
    failing = fs.sweep(short.replace(run__periods=4), start__r=[0.95, short.groups.eps])
    dry = short.replace(friction__law="coulomb", frequency=3).locked()
    read = fs.read_track(track)
    seen = fs.measure(read, drive="10.7 Hz")
    fs.save_points(track.with_name("points.csv"), [seen, seen])
    fit = fs.fit(track.with_name("points.csv"), free=["kappa"])
    yield from (short, short.groups, short.run(trajectory=True), short.run().lab, short.orbit(), dry, dry[0])
    yield from (branch, branch.specials[0], branch.ends[0], fs.UNSET, read, seen, fit, fit.parameters[0])
    yield from (dry.families[0][0], short.replace(run__discard=10).lyapunov())
    yield short.run(ramp=(10, 12), ramp_points=2, ramp_wait=0)
    yield from (grid, grid[:, 1], grid.si, failing, failing[failing.failed])
    yield fs.sweep(short.replace(run__periods=2), kappa="1:2:random:3", seed=5)


def test_copies_and_pickles_are_equal(track):
    kinds = set()
    for one in results(track):
        kinds.add(type(one).__name__)
        for again in (pickle.loads(pickle.dumps(one)), copy.deepcopy(one), copy.copy(one)):
            assert type(again) is type(one) and again == one and not again != one, one
            if hasattr(one, "to_dict"):
                assert str(again.to_dict()) == str(one.to_dict())  # as texts, for NaN is not NaN
    assert len(kinds) == 19, kinds


AGAIN = """
import pickle, sys
sys.path.insert(0, sys.argv[1])
for one in pickle.load(open(sys.argv[2], "rb")):
    print(one.to_dict() if hasattr(one, "to_dict") else type(one).__name__, len(pickle.dumps(one)))
"""


def test_pickles_are_read_by_another_process(track, tmp_path):
    """Nothing in them points into the memory of the process that wrote them."""
    made = [*results(track), fs.fit(track=track, free="kappa", drive="10.7 Hz", bead=fs.Bead(run__periods=20))]
    fs.Bead(run__periods=20).branch(omega=(0.26, 0.275)).save(tmp_path / "branch.json")
    made.append(fs.read(tmp_path / "branch.json"))
    with open(tmp_path / "all.pickle", "wb") as file:
        pickle.dump(made, file)
    done = subprocess.run([sys.executable, "-B", "-c", AGAIN, str(BUILD / "python"), str(tmp_path / "all.pickle")], capture_output=True,
                          text=True, check=True, env={**os.environ, "MALLOC_PERTURB_": "85"})
    lines = done.stdout.splitlines()
    assert len(lines) == len(made) and done.stderr == ""
    for one, line in zip(made, lines):
        if hasattr(one, "to_dict"):
            assert line.startswith(str(one.to_dict())), type(one)


def test_arrays_of_results_can_be_read_alone(track):
    """Every array that a result lends, those of its parts too."""
    seen, looked_at = 0, set()

    def look(thing, name):
        nonlocal seen
        if isinstance(thing, np.ndarray):
            assert not thing.flags.writeable, name
            with pytest.raises(ValueError, match="read-only|readonly"):
                thing[...] = thing[...] if thing.ndim else thing
            seen += 1
        if isinstance(thing, (list, tuple)):
            for part in thing:
                look(part, name)
        elif type(thing).__module__.startswith("festoon.") and id(thing) not in looked_at:
            looked_at.add(id(thing))
            kept.append(thing)
            if isinstance(thing, (fs.Bead, fs.Groups)) or type(thing).__name__.endswith("In"):
                return  # they hold numbers; columns in other units are computed for the caller
            for member in dir(thing):
                own = isinstance(thing, np.ndarray) and hasattr(np.ndarray, member)
                if not member.startswith("_") and not own and not callable(getattr(type(thing), member, None)):
                    look(getattr(thing, member), f"{name}.{member}")

    kept = []  # an id is one object's as long as it lives
    for one in results(track):
        for again in (one, pickle.loads(pickle.dumps(one))):
            look(again, type(one).__name__)
    assert seen > 400


def test_what_differs_is_not_equal():
    bead = fs.Bead(run__periods=4)
    run = bead.run()
    assert run == bead.run() and hash(run) == hash(bead.run()) and run != bead.run(periods=5)
    assert run != bead.run(trajectory=True) and bead.orbit() != bead.replace(kappa=1.49).orbit()
    sweep = fs.sweep(bead, kappa=[1.2, 1.5])
    assert sweep == fs.sweep(bead, kappa=[1.2, 1.5]) != fs.sweep(bead, kappa=[1.2, 1.6])
    failed = pickle.loads(pickle.dumps(fs.sweep(bead, start__r=[0.95, bead.groups.eps])))
    assert "rolling" in str(failed.errors[1]) and failed[0] == fs.sweep(bead, start__r=[0.95])[0]


def test_a_flow_says_how_to_go_on():
    flow = fs.Bead().flow()
    for way in (pickle.dumps, copy.copy, copy.deepcopy):
        with pytest.raises(TypeError, match=r"bead.flow\(state\)"):
            way(flow)


def test_a_pickle_of_another_version_is_refused():
    make, (bead, image, *rest) = fs.Bead(run__periods=4).run().__reduce__()
    with pytest.raises(fs.BadInput, match="another version"):
        make(bead, (image[0], image[1][:-8], image[2]), *rest)


# ---------------------------------------------------------------------------------------- parameters


def test_parameters_are_unset():
    bead = fs.Bead(frequency=8, kappa=1.8, model__eps=0.11, friction__law="coulomb", friction__mu_static=0.3)
    assert bead.replace(model__eps=fs.UNSET).model__eps is None and bead.replace(model__eps=None) == bead
    for key in ("frequency", "kappa", "model__eps", "friction__law", "friction__mu_static"):
        bead = bead.replace(**{key: fs.UNSET})
    assert bead == fs.Bead() == fs.Bead(fs.Bead(kappa=1.8), kappa=fs.UNSET)
    assert fs.Bead(omega=0.2).replace(omega=fs.UNSET, frequency=9) == fs.Bead(frequency=9)
    magnet = fs.Bead(magnet__parts=[BALL], magnet__depth="30 mm")
    assert magnet.replace(magnet__parts=fs.UNSET, magnet__shape=fs.UNSET, magnet__depth=fs.UNSET) == fs.Bead()
    # Beside a real magnet kappa counts only where it is given, its default too.
    given = magnet.replace(kappa=1.5)
    assert given.kappa == 1.5 and given.replace(kappa=fs.UNSET).kappa == magnet.kappa != 1.5
    with pytest.raises(fs.BadInput, match="unknown key"):
        bead.replace(kapa=fs.UNSET)
    with pytest.raises(fs.BadInput, match="splitting is gone"):
        fs.Bead(run__method="splitting")


def test_a_map_chooses_the_shape():
    import pathlib

    file = pathlib.Path(__file__).resolve().parents[2] / "examples/magnets/measured-map.csv"
    bead = fs.Bead(magnet__file=str(file), kappa=1.2)
    assert bead.magnet__shape == "grid" and pickle.loads(pickle.dumps(bead)) == bead
    assert bead.replace(magnet__file=fs.UNSET, magnet__shape=fs.UNSET) == fs.Bead(kappa=1.2)


def test_ordinary_mistakes_and_habits(track):
    with pytest.raises(TypeError, match=r"Bead\(frequency=10.7\)"):
        fs.Bead(10.7)
    s = fs.sweep(fs.Bead(run__periods=2), kappa=(k / 10 for k in (12, 15)), frequency=[9, 10])
    assert s.kappa.tolist() == [[1.2, 1.2], [1.5, 1.5]] and np.array_equal(s.frequency, s.parameter("frequency"))
    with pytest.raises(AttributeError, match="kappa, frequency has no gama"):
        s.gama
    with pytest.raises(fs.BadInput, match="threads"):
        fs.sweep(fs.Bead(run__periods=2), kappa=[1, 2], threads=-1)
    assert fs.read_track(track, fps="120 Hz").fps == 120


# ---------------------------------------------------------------------------------------- Ctrl-C


class Held:
    """The library, with one function that does not end before it is let go."""

    def __init__(self, library, name):
        self._library, self._name = library, name
        self.begun, self.free, self.ended = threading.Event(), threading.Event(), threading.Event()

    def __getattr__(self, name):
        found = getattr(self._library, name)
        return self._held(found) if name == self._name else found

    def _held(self, function):
        def held(*arguments):
            self.begun.set()
            self.free.wait()
            status = function(*arguments)
            self.ended.set()
            return status

        return held


@pytest.mark.parametrize("name", ["fst_track_read", "fst_measure_track", "fst_fit_track", "fst_trajectory_read"])
def test_ctrl_c_is_obeyed_while_a_function_does_not_ask(name, track, monkeypatch, tmp_path):
    """What the function still does is not seen: the track stays as it was, and the same call works afterwards."""
    from festoon import fitting, measuring, trajectories

    read = fs.read_track(track)
    path = tmp_path / "run.csv"
    fs.Bead(run__periods=2).run(trajectory=path)
    calls = {
        "fst_track_read": lambda: fs.read_track(track),
        "fst_measure_track": lambda: fs.measure(read, drive="10.7 Hz"),
        "fst_fit_track": lambda: fs.fit(track=read, free=["kappa"], drive="10.7 Hz"),
        "fst_trajectory_read": lambda: fs.read(path),
    }
    place = {"fst_trajectory_read": trajectories, "fst_fit_track": fitting}.get(name, measuring)
    held = Held(place.lib, name)
    before = copy.deepcopy(read)
    old = signal.signal(signal.SIGINT, signal.default_int_handler)
    try:
        with monkeypatch.context() as patch:
            patch.setattr(place, "lib", held)
            sender = threading.Thread(target=lambda: (held.begun.wait(), os.kill(os.getpid(), signal.SIGINT)), daemon=True)
            sender.start()
            with pytest.raises(fs.Interrupted):
                calls[name]()
            sender.join()
            assert not held.ended.is_set()
    finally:
        signal.signal(signal.SIGINT, old)
        held.free.set()
    held.ended.wait()
    assert read == before
    calls[name]()
