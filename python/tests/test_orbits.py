"""Orbits, branches, locked states and exponents."""

import gc
import math
import pathlib
import pickle

import numpy as np
import pytest

import festoon as fs

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
    assert branch.specials[0].value == pytest.approx(0.26885, abs=1e-4) and branch.complete
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
