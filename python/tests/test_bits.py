"""The bits of Python are the bits of the program."""

import math
import subprocess

import numpy as np
import pytest

import festoon as fs
from conftest import ask


def same(ours, theirs):
    """Equal as numbers, bit by bit; null is NaN."""
    if theirs is None:
        return ours is None or (isinstance(ours, float) and math.isnan(ours))
    return ours == theirs


@pytest.mark.parametrize(
    "keywords",
    [
        {"frequency": "8 Hz"},
        {"kappa": 1.2, "omega": 0.3, "model__dynamics": "farago2020"},
        {"friction__law": "coulomb", "friction__mu": 0.1, "run__periods": 30},
    ],
)
def test_run(program, keywords):
    bead = fs.Bead(run__periods=60).replace(**keywords)
    bead_keys = {"frequency": "drive.frequency", "kappa": "model.kappa", "omega": "drive.omega"}
    words = []
    for keyword, value in {"run__periods": 60, **keywords}.items():
        words += ["--set", f"{bead_keys.get(keyword, keyword.replace('__', '.'))}={value}"]
    theirs = ask(program, "run", "--json", *words)
    run = bead.run()
    assert run.to_dict() == theirs
    for name in ("mean_r", "std_r", "mean_alpha_dot", "sticking", "festoons", "end_time"):
        assert same(getattr(run, name), theirs[name])
    assert run.regime == theirs["regime"] and run.symmetry == theirs["symmetry"]
    assert list(run.final_state) == theirs["final_state"]


def test_trajectory(program, bead, tmp_path):
    """The samples in memory are those of the program's file, and of a file that Python made."""
    theirs = tmp_path / "theirs.h5"
    subprocess.run([program, "run", "--set", "run.periods=20", "-o", theirs], check=True, capture_output=True)
    short = fs.Bead(run__periods=20)
    ours = short.run(trajectory=True).trajectory
    read = fs.read(theirs)
    assert read.bead == ours.bead == short.replace(run__discard=10) and read.complete
    assert np.array_equal(np.asarray(ours), np.asarray(read))
    again = short.run(trajectory=tmp_path / "ours.csv")
    assert again.trajectory is None
    assert np.array_equal(np.asarray(fs.read(tmp_path / "ours.csv")), np.asarray(read))


@pytest.mark.parametrize("portable", [False, True])
def test_sweep(program, tmp_path, portable):
    file = tmp_path / "sweep.db"
    words = ["sweep", "--set", "run.periods=30", "--over", "drive.frequency=8,11.3,14", "--over",
             "model.kappa=1.1,1.5", "-o", file]
    subprocess.run([program, *words, *(["--portable"] if portable else [])], check=True, capture_output=True)
    theirs = fs.read(file)
    ours = fs.sweep(fs.Bead(run__periods=30), frequency=["8", "11.3 Hz", 14], kappa=[1.1, 1.5], portable=portable)
    assert ours.shape == theirs.shape == (3, 2) and ours.dims == theirs.dims == ("frequency", "kappa")
    for name in fs._tables.RESULTS:
        assert np.array_equal(getattr(ours, name), getattr(theirs, name), equal_nan=True), name
    assert np.array_equal(ours.regime, theirs.regime) and np.array_equal(ours.symmetry, theirs.symmetry)
    assert np.array_equal(ours.final_state, theirs.final_state) and np.array_equal(ours.reason, theirs.reason)
    if portable:
        assert ours[1, 0].to_dict() == ours.bead(1, 0).run().to_dict()


SHORT = {"run__duration": "0.5 s", "frequency": "20 Hz"}


@pytest.mark.parametrize("setup, axes", [
    (fs.Bead(**SHORT), {"frequency": [6, 8, 20, 30]}),
    (fs.Bead(**SHORT), {"omega": [0.1, 0.3]}),
    (fs.Bead(run__periods=100, friction__law="coulomb"), {"run__periods": [6, 9]}),
    (fs.Bead(run__periods=6, friction__law="coulomb", friction__stribeck_speed="5 mm/s"), {"friction__mu_static": [0.3, 0.4]}),
    (fs.Beads(beads=[{"start__phi": 3}, {"start__phi": 183}], **SHORT), {"frequency": [8, 30]}),
    (fs.World(plate__shape="bowl", plate__bowl_radius="200 mm", **SHORT), {"omega": [0.1, 0.3]})])
def test_what_is_left_out_of_means_follows_each_run(program, tmp_path, setup, axes):
    """A duration has a number of periods at each drive, and half of them are left out."""
    setup.save(tmp_path / "setup.yaml")
    words = [word for name, values in axes.items() for word in ("--over", f"{fs._keys.key_of(name)}={','.join(map(str, values))}")]
    subprocess.run([program, "sweep", "setup.yaml", *words, "-o", "s.db"], cwd=tmp_path, check=True, capture_output=True)
    theirs, ours = fs.read(tmp_path / "s.db"), fs.sweep(setup, **axes)
    if isinstance(ours, fs.Sweep):
        assert ours == theirs and ours.done.all()
    else:
        told = [{name: str(column) for name, column in s.to_dict().items() if not name.endswith("seconds")} for s in (ours, theirs)]
        assert told[0] == told[1] and set(ours.status) == {"done"}


def test_branch_of_a_setup_with_a_duration(program, tmp_path):
    subprocess.run([program, "init", "lev.yaml", "--world", "levitation"], cwd=tmp_path, check=True, capture_output=True)
    words = ["branch", "--kind", "levitating", str(tmp_path / "lev.yaml"), "--over", "drive.frequency=60:70", "--json"]
    branch = fs.World(tmp_path / "lev.yaml").branch(kind="levitating", frequency=(60, 70))
    assert branch.to_dict()["points"] == ask(program, *words)["points"]
    assert fs.Bead(**SHORT).run__discard == fs.Bead(run__periods=10).run__discard == 5
    assert fs.Bead().replace(**SHORT).run(discard=2).bead.run__discard == 2


def test_orbit_and_locked_states(program):
    assert fs.Bead().orbit().to_dict() == ask(program, "orbit", "--json")
    assert fs.Bead(frequency=25).locked().to_dict() == ask(program, "locked", "--json", "--set", "drive.frequency=25")


def test_field(program):
    theirs = ask(program, "field", "--json", "--at", "0.3,-0.2", "--height", "20mm", "--units", "si", "--set",
                 "magnet.b0=3mT")
    bead = fs.Bead(magnet__b0="3 mT")
    b, grad = bead.field(0.3, -0.2, height="20 mm")
    assert b.tolist() == theirs["b"] and grad.tolist() == theirs["grad"]
    length = bead.groups.length_unit
    b, grad = bead.field(0.3 * length, -0.2 * length, height="20 mm", units="si")
    assert np.allclose(b, theirs["b_tesla"], rtol=1e-12) and np.allclose(grad, theirs["grad_tesla_per_m"], rtol=1e-12)
