"""Orbits, branches, locked states and exponents."""

import gc
import math
import pathlib
import pickle

import numpy as np
import pytest

import festoon as fs
from conftest import ask

SCENES = pathlib.Path(__file__).resolve().parents[2] / "examples/worlds"


def test_orbit():
    orbit = fs.Bead().orbit()
    assert orbit.stable and orbit.symmetry == "S1" and orbit.turns == -1 and orbit.residual < 1e-10
    assert orbit.multipliers.shape == (8,) and np.all(abs(orbit.multipliers) < 1)
    leading = np.max(abs(orbit.multipliers))
    assert orbit.relaxation_time == pytest.approx(-orbit.period / math.log(leading))
    assert pickle.loads(pickle.dumps(orbit)).to_dict() == orbit.to_dict()
    assert orbit.mean_r == pytest.approx(fs.Bead().run().mean_r, rel=1e-9)


def test_branch(tmp_path):
    branch = fs.Bead().branch(omega=(0.24, 0.28), kind="counter")
    assert [special.type for special in branch.specials] == ["pitchfork"]
    special = branch.specials[0]
    assert special.value == pytest.approx(0.26885, abs=1e-4) and branch.complete
    assert special["value"] == special.value and dict(special)["omega"] == special.omega and "state" in special
    assert "phase" not in special and len(special) == 8
    table = special.to_pandas()
    assert (table["type"][0], table["value"][0]) == ("pitchfork", special.value)
    with pytest.raises(fs.BadInput):
        special.to_pandas("lab")
    assert branch.mean_r.shape == branch.value.shape == (len(branch),) and set(branch.stable) == {0, 1}
    assert np.all((branch.value >= 0.24 - 1e-12) & (branch.value <= 0.28 + 1e-12))
    assert sum(len(points) for points in branch) == len(branch)
    branch.save(tmp_path / "branch.json")
    read = fs.read(tmp_path / "branch.json")
    assert np.array_equal(read.mean_r, branch.mean_r) and read.key == "drive.omega"
    with pytest.raises(fs.BadInput, match="did you mean counter"):
        fs.Bead().branch(omega=(0.2, 0.3), kind="conter")


def test_points_of_a_branch_outlive_it():
    points = fs.Bead().branch(omega=(0.24, 0.25)).points
    gc.collect()
    assert np.all(points["omega"] > 0.2) and np.all(points["omega"] < 0.3)


def test_locked_states():
    states = fs.Bead(frequency=3).locked()
    assert len(states) >= 2 and states[0].stable and not states[-1].stable
    first = states[0]
    assert first.eigenvalues.shape == (9,) and np.max(first.eigenvalues.real) < 0
    assert np.linalg.norm(first.n) == pytest.approx(1.0) and first.r == pytest.approx(np.hypot(*first.state[:2]))


def test_lyapunov():
    spectrum = fs.Bead(run__periods=120, run__discard=60).lyapunov()
    assert spectrum.exponents.shape == (9,) and np.all(np.diff(spectrum.exponents) <= 0)
    assert spectrum.exponents.sum() == pytest.approx(spectrum.divergence, abs=1e-3)


def test_critical():
    found = fs.Bead().critical(over="drive.frequency=8Hz:12Hz:5", tolerance=1e-2)
    assert found.value == pytest.approx(8.89731631832, abs=1e-8) and found.special == "origin-crossing"
    assert [row.regime for row in found.stretches] == [found.below, found.above] == ["librating", "counter-rotating"]
    again = pickle.loads(pickle.dumps(found))
    assert again.to_dict() == found.to_dict() and again == found
    none = fs.Bead().critical(over="drive.frequency=4Hz:6Hz:3")
    assert found.reason is None and none.value is None and none.reason == "no bead circles against the magnet"
    with pytest.raises(fs.BadInput, match="a critical speed is one of"):
        fs.Bead().critical(over="magnet.depth=1cm:2cm:3")


def test_branch_of_levitation(tmp_path):
    bead = fs.Bead(SCENES / "levitation.yaml")
    branch = bead.branch(frequency=(155, 170), kind="levitating")
    specials = {special.type: special.value for special in branch.specials}
    assert specials == {"hopf": pytest.approx(158.8, abs=0.05), "fold": pytest.approx(162.1, abs=0.05)}
    assert branch.multipliers.shape == (len(branch), 11) and branch.specials[0].state.shape == (12,)
    branch.save(tmp_path / "branch.json")
    read = fs.read(tmp_path / "branch.json")
    assert np.array_equal(read.height_mm, branch.height_mm) and np.array_equal(read.multipliers, branch.multipliers)
    assert np.array_equal(read.points["levitation"]["state"], branch.points["levitation"]["state"])
    assert read.kind == "levitating" and "height_mm" in dir(read) and branch.to_dict() == pickle.loads(pickle.dumps(branch)).to_dict()
    branch.figure(tmp_path / "branch.svg")
    assert "distance from the magnet" in (tmp_path / "branch.svg").read_text()
    pytest.importorskip("matplotlib")
    assert "distance" in branch.plot().get_ylabel()


# ---------------------------------------------------------------------------------------- in a world


def test_what_a_bead_in_a_world_does_for_ever(program, tmp_path):
    """Orbits, locked states, places and branches, as the program prints them."""
    bowl = {"plate__shape": "bowl", "plate__bowl_radius": "200 mm"}
    swung = fs.World(drive__waveform="oscillating", drive__amplitude="30 deg", frequency="2 Hz", run__periods=20)
    floats = fs.World(str(SCENES / "levitation.yaml"))
    still = fs.World(frequency=2, start__r=0.3, run__periods=100, **bowl)
    for world, found, words in (
        (fs.World(**bowl, run__periods=100), lambda world: world.orbit(), ["orbit"]),
        (swung, lambda world: world.orbit(), ["orbit"]),
        (still, lambda world: world.locked(), ["locked"]),
        (floats, lambda world: world.locked(), ["locked"]),
        (still, lambda world: world.branch(kind="locked", frequency=(2, 2.1)), ["branch", "--kind", "locked", "--over", "drive.frequency=2:2.1"]),
    ):
        world.save(tmp_path / "world.yaml")
        one, told = found(world), ask(program, words[0], str(tmp_path / "world.yaml"), *words[1:], "--json")
        mine = one.to_dict()
        for each in (mine, told):  # what a run leaves out is said where it was asked in Python
            each.pop("scene", None)
        assert mine == told and pickle.loads(pickle.dumps(one)) == one and len(repr(one)) > 20
    orbit, places = swung.orbit(), floats.locked()
    assert orbit.stable and orbit.frame == "turning" and orbit.lab.period == pytest.approx(0.5) and len(orbit.state) == 12
    assert abs(orbit.multipliers).max() == abs(orbit.multipliers[0]) < 0.2 and orbit.residual < 1e-9
    assert len(places) == 4 and places.states[0]["stable"] and places.lab.height_mm[0] == places.states[0]["height_mm"]
    assert isinstance(floats.branch(kind="levitating", frequency=(150, 151)), fs.Branch)
    for call, words in ((lambda: still.branch(frequency=(2, 3)), "is of kind locked, levitating or driven"),
                        (lambda: still.orbit(festoons=4), "counted on a flat plate")):
        with pytest.raises(fs.BadInput, match=words):
            call()
