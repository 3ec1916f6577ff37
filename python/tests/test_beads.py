"""Several beads: the program's numbers, arrays of the samples, files, copies, and what is refused."""

import copy
import json
import math
import pickle
import subprocess

import numpy as np
import pytest

import festoon as fs
from conftest import ask

WALKER = dict(frequency="30 Hz", model__chi=1.243e-3, contact__pair_rate=312.5, run__periods=3, run__discard=1, run__samples=16)


@pytest.fixture(scope="module")
def pair():
    return fs.Beads(beads=[{"start__phi": 3}, {"start__phi": 53}], **WALKER)


@pytest.fixture(scope="module")
def run(pair):
    return pair.run(trajectory=True)


def test_numbers_are_the_programs(program, pair, run, tmp_path):
    pair.save(tmp_path / "pair.yaml")
    theirs = ask(program, "run", str(tmp_path / "pair.yaml"), "--json")
    ours = run.to_dict()
    assert {key: ours[key] for key in theirs if key != "scene"} == {key: theirs[key] for key in theirs if key != "scene"}
    assert fs.Beads(tmp_path / "pair.yaml") == pair and len(pair) == 2 and len(pair.beads) == 2


def test_the_snap_of_two_beads(run):
    """The second bead leaves the plate, the pair touches, the first lifts and lands: event-located times of an
    independent program (several beads, 30 Hz, Phi = 3 and 53 degrees, pair rate 1), to 2 turns of the magnet."""
    told = [(event["kind"], event["beads"], event["time"], event["speed"]) for event in run.events[:4]]
    assert [(kind, beads) for kind, beads, *_ in told] == [("lift", [1]), ("touch", [0, 1]), ("lift", [0]), ("land", [0])]
    assert np.allclose([time for *_, time, _ in told], [18.133451, 18.937630601, 19.023942, 19.235220], atol=2e-6, rtol=0)
    assert abs(told[1][3] - 0.693348445) < 1e-8
    assert run.counts["touch"] >= 1 and [group["kind"] for group in run.groups] == ["pair"]


def test_samples(run):
    tr = run.trajectory
    assert tr.states.shape == (49, 2, 12) and tr.loads.shape == (49, 2) and len(tr) == 49
    assert np.array_equal(tr.states[-1], [bead["final_state"] for bead in run.beads])
    assert np.allclose(np.linalg.norm(tr.states[..., 6:9], axis=-1), 1) and not tr.states.flags.writeable
    places = tr.places("lab")
    assert np.allclose(np.hypot(places[..., 0], places[..., 1]), 23 * np.hypot(tr.states[..., 0], tr.states[..., 1]))
    assert np.array_equal(np.isnan(tr.loads), tr.states[..., 2] > tr.setup.alone(0).groups.eps + 1e-9)


def test_one_bead_of_a_list_keeps_its_path():
    """Alone on the plate a bead of the list moves as fs.Bead does."""
    keys = dict(frequency=12, run__periods=3, run__discard=1, run__samples=8)
    one = fs.Bead(**keys).run(trajectory=True).trajectory
    listed = fs.Beads(beads=[{}], **keys).run(trajectory=True).trajectory
    assert np.allclose(listed.states[:, 0, 0], one.X, atol=1e-8) and np.allclose(listed.states[:, 0, 1], one.Y, atol=1e-8)


@pytest.mark.parametrize("ending", ["h5", "csv"])
def test_files(pair, run, tmp_path, ending):
    path = tmp_path / f"t.{ending}"
    assert pair.run(trajectory=path).trajectory is None
    again = fs.read(path)
    assert np.array_equal(again.states, run.trajectory.states) and np.array_equal(again.t, run.trajectory.t)
    assert np.array_equal(again.loads, run.trajectory.loads, equal_nan=True) and again.setup == pair


def columns_of(sweep):
    """What a sweep says of its rows, as texts, for NaN is not NaN; but for how long they took."""
    return str({name: column for name, column in sweep.to_dict().items() if not name.endswith("seconds")})


def test_a_sweep_of_the_program_is_exported(program, pair, tmp_path):
    pair.save(tmp_path / "pair.yaml")
    subprocess.run([program, "sweep", "pair.yaml", "--over", "drive.frequency=29:30:2", "-o", "s.db"], cwd=tmp_path, check=True,
                   capture_output=True)
    read = fs.read(tmp_path / "s.db")
    assert read.shape == (2,) and read.outcome[0] in ("apart", "undecided")
    with pytest.raises(fs.BadInput, match="outcome"):
        read["outcom"]
    again = fs.sweep(pair, frequency=[29, 30])
    assert again.dims == ("frequency",) and columns_of(again) == columns_of(read)
    fs.export(tmp_path / "s.db", tmp_path / "s.csv", keys=["outcome"])
    assert len((tmp_path / "s.csv").read_text().splitlines()) >= 3


@pytest.mark.parametrize("world", ["levitation", "bowl", "compass", "wave"])
def test_files_of_a_world(program, world, tmp_path):
    """One bead in a world: its run, trajectory and sweep are those of the program, in either frame."""
    def start(*words):
        return subprocess.run([program, *words], cwd=tmp_path, check=True, capture_output=True).stdout

    start("init", "world.yaml", "--world", world)
    short = ("--set", "run.duration=0.05")
    told = json.loads(start("run", "world.yaml", *short, "-o", "t.h5", "--sample-rate", "100", "--json"))
    bead = fs.World(tmp_path / "world.yaml", run__duration=0.05)
    run = bead.run(trajectory=True, fps=100)
    assert isinstance(run, fs.WorldRun) and f", in the {'turning' if run.frame == 'turning' else 'laboratory'}" in repr(run)
    assert repr(bead).startswith("World(")
    assert bead.cause == {"wave": "drive.waveform", "compass": "field.uniform"}.get(world, "plate.shape")
    assert bead == fs.Bead(tmp_path / "world.yaml", run__duration=0.05) == pickle.loads(pickle.dumps(bead))
    assert run.frame == told["frame"] and run.regime == told["regime"] and np.array_equal(run.final_lab, told["final_lab"])
    assert pickle.loads(pickle.dumps(run)) == run and run.to_dict().keys() == told.keys()
    read = fs.read(tmp_path / "t.h5")
    assert read.frame == run.frame and np.array_equal(read.states, run.trajectory.states)
    assert np.allclose(read.places()[-1, 0], told["final_lab"][:3], atol=1e-9)
    if world in ("levitation", "bowl"):
        other = bead.replace(world__frame="laboratory").run(trajectory=True, fps=100).trajectory
        assert (read.frame, other.frame) == ("turning", "laboratory")
        assert np.allclose(other.places(), read.places(), atol=1e-9) and np.allclose(other.t, read.t)
    start("sweep", "world.yaml", *short, "--over", "bead.inertia=0.4:0.5:2", "-o", "s.db")
    sweep = fs.read(tmp_path / "s.db")
    assert sweep.shape == (2,) and sweep.dims == ("bead__inertia",) and sweep.regime[0] == told["regime"]
    assert sweep.final_state.shape == (2, 12) and np.array_equal(sweep.final_state[0], told["final_state"])
    assert sweep["mean_r"][0] == told["mean_r"] and "frame" in sweep.columns and "2 points" in repr(sweep)
    again = fs.sweep(bead, bead__inertia=[0.4, 0.5])
    assert again.frame[0] == run.frame and columns_of(again) == columns_of(sweep)


def test_a_map_of_levitation(program, tmp_path):
    subprocess.run([program, "init", "world.yaml", "--world", "levitation"], cwd=tmp_path, check=True, capture_output=True)
    subprocess.run([program, "sweep", "world.yaml", "--levitation", "--over", "drive.frequency=190:200:2", "-o", "s.db"],
                   cwd=tmp_path, check=True, capture_output=True)
    made = fs.sweep(fs.Bead(tmp_path / "world.yaml"), frequency=[190, 200], levitation=True)
    assert made.below[1] == "stable" and columns_of(made) == columns_of(fs.read(tmp_path / "s.db"))


def test_vectors_of_a_start():
    bead = fs.Bead(start__position=["20 mm", "1 mm"], start__n=[None, 0, 1])
    assert repr(bead) == "Bead(start__position=[0.02, 0.001, None], start__n=[None, 0.0, 1.0])"
    assert eval(repr(bead), {"Bead": fs.Bead}) == bead and np.allclose(bead.start_state()[:2], [20 / 23, 1 / 23])


def test_copies_and_pickles_are_equal(pair, run):
    for one in (pair, run, run.trajectory):
        for other in (pickle.loads(pickle.dumps(one)), copy.deepcopy(one)):
            assert type(other) is type(one) and other == one
    assert run != pair.replace(run__periods=2).run()


def test_tables(run):
    events = run.to_pandas("events", "lab")
    assert list(events.kind[:2]) == ["lift", "touch"] and events.attrs["units"]["time"] == "s"
    assert math.isclose(events.time[1], run.events[1]["time"] / 312.5)
    assert math.isclose(run.to_pandas("beads", "lab").mean_r[0], 23 * run.beads[0]["mean_r"])
    assert run.to_pandas("lab").equals(run.to_pandas("beads", "lab"))  # as of every other result
    assert math.isclose(run.to_pandas("beads", "lab").mean_alpha_dot[0], 312.5 / (2 * math.pi) * run.beads[0]["mean_alpha_dot"])
    assert set(run.to_pandas("powers")) == {"drive", "plate", "pair", "impacts"} and len(run.to_pandas("groups")) == 1
    with pytest.raises(fs.BadInput, match="unknown table"):
        run.to_pandas("bead")


def test_trails(run):
    ax = run.trajectory.plot(begin=1)
    assert len(ax.lines) >= 2 and len(ax.patches) == 2 and "mm" in ax.get_xlabel()
    assert ax.figure.canvas.draw() is None


def test_what_is_wrong_is_said(pair):
    with pytest.raises(fs.BadInput, match="nearest is radius"):
        fs.Beads(beads=[{"raduis": "2 mm"}])
    with pytest.raises(fs.BadInput, match="list of dictionaries"):
        fs.Beads(frequency=12)
    with pytest.raises(fs.BadInput, match="Beads"):
        fs.Bead(pair.scene() + "\n")
    with pytest.raises(fs.BadInput, match="Bead\\(\\) is for it"):
        fs.World(frequency=12)
    with pytest.raises(fs.BadInput, match="World"):
        fs.World(plate__shape="bowl", plate__bowl_radius="200 mm").replace(plate__shape="flat", plate__bowl_radius=fs.UNSET)
    with pytest.raises(fs.BadInput, match="for one bead"):
        pair.lyapunov()
    with pytest.raises(fs.BadInput, match="each from its own start"):
        fs.sweep(pair, frequency="29:30:3", refine=1)
    with pytest.raises(fs.BadInput, match="plate.shape"):
        fs.sweep(fs.Bead(), frequency=[29, 30], levitation=True)
    with pytest.raises(fs.BadInput, match="shape"):
        pair.run(start=np.zeros((3, 12)))
    with pytest.raises(fs.BadInput):
        fs.Beads(beads=[{}, {}]).run()  # they overlap
    assert pair.alone(1).run(periods=4, discard=2).regime
    assert repr(pair).startswith("Beads(beads=[{'start__phi':")


def test_ctrl_c_keeps_the_samples(pair, monkeypatch):
    def tell(fraction, what):
        if fraction > 0.2:
            raise KeyboardInterrupt

    with pytest.raises(fs.Interrupted) as stop:
        pair.replace(run__periods=400).run(trajectory=True, progress=tell)
    assert len(stop.value.partial) > 0


def bar_of_two():
    places = [{"start__r": 0.12, "start__phi": phi} for phi in (0, 180)]
    return fs.Beads(beads=places, start__spin="rest", **{**WALKER, "run__periods": 60})


def test_orbit(program, tmp_path):
    pair = fs.Beads(beads=[{"start__phi": 3}, {"start__phi": 183}], **{**WALKER, "run__periods": 40})
    orbit = pair.orbit()
    pair.save(tmp_path / "pair.yaml")
    theirs = ask(program, "orbit", str(tmp_path / "pair.yaml"), "--json")
    assert orbit.to_dict()["multipliers"] == theirs["multipliers"]
    assert orbit.stable and orbit.symmetry == "exchange"
    assert abs(orbit.multipliers[0] + 0.9991387) < 5e-8
    assert abs(orbit.beads[1]["mean_r"] - 0.92580221093) < 5e-12
    assert pickle.loads(pickle.dumps(orbit)) == orbit


def test_locked_and_branch():
    bar = bar_of_two()
    locked = bar.locked()
    assert locked.stable and abs(locked.power - 5.53486e-5) < 5e-11
    assert all(abs(bead["load_weights"] - 19.72219) < 5e-6 for bead in locked.beads)
    assert abs(locked.pair_forces[0]["force"] - 3.29360694) < 5e-9 and len(locked.eigenvalues) == 16
    branch = bar.branch(frequency=(25, "400 Hz"))
    assert [special["type"] for special in branch.specials] == [special.type for special in branch.specials] == ["hopf", "hopf", "contact"]
    assert pickle.loads(pickle.dumps(branch.specials)) == branch.specials and not hasattr(branch.specials[0], "typ")
    assert abs(branch.specials[2].value - 255.27) < 0.01 and branch.parameter == "drive.frequency"
    assert branch.specials[2].to_pandas()["value"][0] == branch.specials[2].value
    sways = (branch.values > branch.specials[0]["value"]) & (branch.values < branch.specials[1]["value"])
    assert (branch.stable != sways).all() and len(branch.points) == len(branch.values) and "hopf at 194.2" in repr(branch)
    with pytest.raises(fs.NoConvergence, match="no state in which they turn with the magnet"):
        fs.Beads(beads=[{"start__phi": 3}, {"start__phi": 183}], **WALKER).locked()
    with pytest.raises(fs.BadInput, match="the range of one parameter"):
        bar.branch()
