"""Runs, their samples and ramps."""

import gc
import math
import pickle
import weakref

import numpy as np
import pytest

import festoon as fs


def test_run_in_units(bead):
    run = bead.run()
    assert run.regime == "counter-rotating" and run.symmetry == "S1" and 0 < run.mean_r_error < 1e-6
    assert run.si.mean_r == run.mean_r * 0.023 and run.lab.mean_r == pytest.approx(23 * run.mean_r)
    assert (run.si.unit("mean_r"), run.lab.unit("mean_r")) == ("m", "mm")
    assert run.si.mean_alpha_dot == pytest.approx(run.mean_alpha_dot * bead.gamma)
    assert run.lab.mean_alpha_dot * 2 * math.pi == pytest.approx(run.si.mean_alpha_dot)
    shown = {"mm": 1e-3, "s": 1, "Hz": 2 * math.pi, "1/s": 1, "mm/s": 1e-3, "mN": 1e-3, "uJ": 1e-6, "mW": 1e-3}
    for name, (unit, _) in fs._tables.RESULTS.items():  # every number in units of the laboratory, read back through its unit
        if unit == run.lab.unit(name):
            assert getattr(run.lab, name) == getattr(run, name) or math.isnan(getattr(run, name))
        else:
            assert getattr(run.lab, name) * shown[run.lab.unit(name)] == pytest.approx(getattr(run.si, name), nan_ok=True)
    again = pickle.loads(pickle.dumps(run))
    assert again.to_dict() == run.to_dict() and again.reason == run.reason
    assert math.isnan(run.sticking) and run.never_slips is None and run.trajectory is None and run.complete


def test_trajectory_is_the_memory_of_the_library(bead):
    tr = bead.run(periods=20, trajectory=True).trajectory
    assert isinstance(tr, np.ndarray) and tr.dtype.names == tuple(fs._tables.COLUMNS) and len(tr) == 20 * 64 + 1
    assert not tr.flags.owndata and tr.r.base is not None and np.shares_memory(tr.r, tr)
    assert np.allclose(tr.r, np.hypot(tr.X, tr.Y)) and np.allclose(tr.x, tr.r * np.cos(tr.alpha), atol=1e-12)
    assert tr.si.x[-1] == tr.x[-1] * 0.023 and tr.lab.unit("WX") == "Hz" and tr.si.unit("t") == "s"
    part = tr[10:20]
    assert isinstance(part, fs.Trajectory) and part.bead == tr.bead and np.array_equal(part["r"], tr.r[10:20])
    assert not isinstance(tr["r"], fs.Trajectory)


def test_the_last_view_frees_the_memory(bead):
    """The owner of the samples lives as long as any view, and no longer."""
    tr = bead.run(periods=5, trajectory=True).trajectory
    base = tr
    while isinstance(base.base, np.ndarray):
        base = base.base
    column = tr.r[3:]
    values = column.copy()
    alive = weakref.ref(base)
    del tr, base
    gc.collect()
    assert alive() is not None and np.array_equal(column, values)
    del column
    gc.collect()
    assert alive() is None


def test_samples_as_a_camera_takes_them(bead):
    tr = bead.run(periods=10, trajectory=True, fps=240, sample_from=5).trajectory
    assert np.allclose(np.diff(tr.si.t), 1 / 240) and tr.drive_turns[0] >= 5


def test_start_from_a_state(bead):
    """A run that starts where another ended goes on with its motion."""
    first = bead.run(periods=40)
    onward = bead.run(periods=10, start=first.final_state)
    assert onward.mean_r == pytest.approx(first.mean_r, rel=0.05)
    with pytest.raises(fs.BadInput, match="10 numbers"):
        bead.run(start=[1, 2, 3])


def test_ramp(bead):
    run = bead.run(periods=60, discard=20, ramp=(10.0, "12 Hz"), ramp_points=4, ramp_wait=0)
    assert run.ramp.dtype.names[:3] == ("omega", "frequency_hz", "mean_r") and len(run.ramp) == 4
    assert np.all(np.diff(run.ramp["frequency_hz"]) > 0) and 10 < run.ramp["frequency_hz"][0] < 12
    assert len(run.to_dict()["ramp"]) == 4


@pytest.mark.parametrize("keywords", [{"fps": 0}, {"fps": -3}, {"fps": math.nan}, {"fps": "60 mm"},
                                      {"sample_from": math.nan}, {"sample_from": -1}])
def test_samples_that_cannot_be_are_refused(keywords):
    with pytest.raises(fs.BadInput) as caught:
        fs.Bead().run(periods=10, trajectory=True, **keywords)
    assert caught.value.where == next(iter(keywords))
