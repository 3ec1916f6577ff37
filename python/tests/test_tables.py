"""All results with columns as data frames and data sets, in all units; merged sweeps."""

import copy
import inspect
import math
import pickle

import numpy as np
import pytest

import festoon as fs
from conftest import ask
from test_errors import SOURCE

pandas, xarray = pytest.importorskip("pandas"), pytest.importorskip("xarray")

L, GAMMA, MASS = 0.023, 312.5, 5e-4
#: Of each scaled unit its counterparts, with factors that are computed here.
LAB = {"l": ("mm", 1e3 * L), "1/gamma": ("s", 1 / GAMMA), "l gamma": ("mm/s", 1e3 * L * GAMMA), "l gamma^2": ("mN", 1e3 * MASS * L * GAMMA**2),
       "l^2 gamma^2": ("uJ", 1e6 * MASS * L**2 * GAMMA**2), "l^2 gamma^3": ("mW", 1e3 * MASS * L**2 * GAMMA**3)}
TURNS = {"mean_alpha_dot", "mean_alpha_dot_error", "mean_phi_dot", "omega", "WX", "WY", "WZ", "w_x", "w_y", "w_z", "spin", "centre_rate", "axis_rate", "value"}


#: Their columns are not attributes.
NESTED = (fs.SmoothedMap, fs.BeadsRun, fs.BeadsLocked, fs.BeadsBranch, fs.LockedStates, fs.Critical, fs.Fit, fs.FloatingStates)


@pytest.fixture(scope="module")
def results(noisy):
    short = fs.Bead(run__periods=20)
    rolling = dict(frequency="30 Hz", contact__pair_rate=GAMMA, run__periods=60)
    bar = fs.Beads(beads=[{"start__r": 0.12, "start__phi": phi} for phi in (0, 180)], start__spin="rest", **rolling)
    few = bar.replace(run__periods=3, run__discard=1)
    pair = fs.Beads(beads=[{"start__phi": 3}, {"start__phi": 183}], **{**rolling, "run__periods": 40}, model__chi=1.243e-3)
    world = fs.World(plate__shape="bowl", plate__bowl_radius="200 mm", run__periods=4).run(trajectory=True)
    swung = fs.World(drive__waveform="oscillating", drive__amplitude="30 deg", frequency="2 Hz", run__periods=20)
    run, beads_run = short.run(trajectory=True), few.run(trajectory=True)
    lab = short.run(periods=60, trajectory=True, fps=240, sample_from=20).trajectory.lab
    track = fs.Track(np.column_stack([lab.t, lab.x, lab.y]))
    measured = fs.measure(track, drive="10.7 Hz")
    made = [run, run.trajectory, short.orbit(), short.locked(), short.replace(run__discard=10).lyapunov(), world, world.trajectory]
    made += [short.branch(omega=(0.26, 0.275)), short.branch(omega=(0.1, 0.101), kind="locked"), bar.locked(), bar.branch(frequency=(25, 25.5))]
    made += [beads_run, beads_run.trajectory, pair.orbit(), fs.sweep(short.replace(run__periods=2), frequency=[9, 10], kappa=[1.2, 1.5])]
    made += [fs.sweep(few, frequency=[29, 30]), track, measured, fs.fit([measured] * 2, free="kappa"), noisy.smooth()]
    made += [swung.orbit(), fs.World(str(SOURCE / "examples/worlds/levitation.yaml")).locked()]
    return [*made, short.replace(run__periods=30).critical(over="drive.frequency=7:9:3", tolerance=0.05)]


def test_every_class_with_columns_is_here(results):
    tabled = {name for name in fs.__all__ if inspect.isclass(getattr(fs, name)) and hasattr(getattr(fs, name), "to_pandas")}
    assert tabled == {type(one).__name__ for one in results} and len(tabled) == 21
    ours = {name for name in fs.__all__ if inspect.isclass(getattr(fs, name)) and getattr(fs, name).__module__ != "festoon._errors"}
    assert ours - tabled == {"Bead", "Beads", "World", "Flow", "Groups", "Locked"}




def test_frames_and_data_sets_say_the_same(results):
    """Every variable of a data set is in the frame, number by number, with its unit, but for curves over further axes."""
    for one in results:
        frame, data = one.to_pandas(), one.to_xarray()
        assert frame.attrs["version"] == data.attrs["version"] == fs.__version__
        seen = set()
        flat = data.to_dataframe().reset_index() if data.sizes and all(
            variable.dims == tuple(data.sizes) for variable in data.data_vars.values()) else None
        for name, variable in data.variables.items():
            unit, full = variable.attrs.get("units", ""), [name] if name in frame else [c for c in frame if c.startswith(f"{name}_") and c[len(name) + 1:].isdigit()]
            if not full:
                assert name in ("trace", "trace_time", "with"), (type(one), name)
                continue
            seen.update(full)
            assert {frame.attrs["units"].get(column, "") for column in full} == {unit}, (type(one), name)
            if flat is not None and name in flat and full == [name]:
                merged = frame.merge(flat[[*data.dims, name]], on=list(data.dims), suffixes=("", "_too")) if name not in data.dims else None
                if merged is not None and variable.dtype.kind in "fiu":
                    np.testing.assert_array_equal(merged[name], merged[f"{name}_too"], err_msg=name)
            elif variable.ndim == 1 and full == [name] and len(frame) == len(variable):
                np.testing.assert_array_equal(frame[name].to_numpy(variable.dtype), variable.values, err_msg=name)
            elif variable.ndim == 2 and full != [name] and len(frame) == len(variable):
                np.testing.assert_array_equal(frame[full].to_numpy(), variable.values, err_msg=name)
            elif variable.ndim == 0:
                assert all(value == variable.item() or value != value for value in frame[name])
        assert seen == set(frame), type(one)


def test_columns_are_the_attributes(results):
    for one in results:
        data, looked_at = one.to_xarray(), 0
        for name, variable in data.variables.items():
            own = getattr(one, name, None) if name != "stable" or not isinstance(one, fs.LockedStates) else [s.stable for s in one]
            if name == "symmetry" and isinstance(one, fs.Branch):
                own = [fs.branches.SYMMETRIES[number] or "" for number in own]
            if own is None or callable(own) or isinstance(own, list) and name == "beads" or np.shape(own) != variable.shape:
                continue
            looked_at += 1
            values = variable.values
            assert all(a == b or a != a and b != b for a, b in zip(np.ravel(own), values.ravel())), (type(one), name)
        assert looked_at >= 2 or isinstance(one, NESTED), type(one)


def test_columns_of_lists(results):
    """Results without an attribute for each column: against what the program prints."""
    found = {type(one).__name__: one for one in results}
    told = {name: one.to_dict() for name, one in found.items() if isinstance(one, NESTED[1:])}
    assert len(told) == 7
    beads = {"BeadsRun": (told["BeadsRun"]["beads"], "final_"), "BeadsLocked": (told["BeadsLocked"]["states"][0]["beads"], "")}
    beads["BeadsBranch"] = [bead for point in told["BeadsBranch"]["points"] for bead in point["beads"]], ""
    for name, (rows, before) in beads.items():
        frame = found[name].to_pandas()
        for i, number in enumerate(fs._tabled.NUMBERS):
            assert frame[before + number].tolist() == [row[before + "state"][i] for row in rows], (name, number)
        for key in set(rows[0]) - {"state", "final_state", "n", "w", "z", "ejected_at"}:
            assert frame[key].tolist() == [row[key] for row in rows], (name, key)
    points, frame = told["BeadsBranch"]["points"], found["BeadsBranch"].to_pandas()
    for key in ("value", "omega", "power", "residual", "stable"):
        assert frame[key].tolist() == [point[key] for point in points for _ in range(2)], key
    assert frame.eigenvalues_3.tolist() == [complex(*point["eigenvalues"][3]) for point in points for _ in range(2)]
    locked = found["LockedStates"].to_pandas()
    for name in ("r", "phi_deg", "slip", "friction_power", "stable"):
        np.testing.assert_array_equal(locked[name], [getattr(state, name) for state in found["LockedStates"]])
    assert locked.WZ.tolist() == [state.w[2] for state in found["LockedStates"]]
    assert locked.eigenvalues_1.tolist() == [state.eigenvalues[1] for state in found["LockedStates"]]
    stretches = told["Critical"]["stretches"]
    frame = found["Critical"].to_pandas().rename(columns={"begin": "from", "end": "to"})
    assert frame[["from", "to", "regime", "runs"]].to_dict("records") == stretches and frame.attrs["units"]["begin"] == "Hz"
    parameter, frame = found["Fit"]["kappa"], found["Fit"].to_pandas()
    assert frame.loc[0, ["parameter", "value", "error", "low", "high", "unit"]].tolist() == [
        "model.kappa", parameter.value, parameter.error, *parameter.interval, "1"]
    kinds = {what: found["BeadsRun"].to_pandas(what) for what in ("groups", "contacts", "events", "powers")}
    assert kinds["contacts"].force.tolist() == [row["force"] for row in told["BeadsRun"]["contacts"]]
    assert kinds["groups"].members.tolist() == [", ".join(map(str, row["members"])) for row in told["BeadsRun"]["groups"]]
    assert kinds["powers"].drive[0] == told["BeadsRun"]["powers"]["drive"]
    assert found["BeadsRun"].to_xarray("powers", "lab").drive.attrs["units"] == "mW"


def test_units(results):
    """Every column in the units of a laboratory, by factors that are computed here."""
    converted = set()
    for one in results:
        with pytest.raises(fs.BadInput, match="unknown units"):
            one.to_pandas(units="furlongs")
        own, lab, si = one.to_xarray(), one.to_xarray(units="lab"), one.to_xarray(units="si")
        for name, variable in own.variables.items():
            unit = variable.attrs.get("units", "")
            shown, factor = LAB.get(unit, (unit, 1.0))
            if unit == "gamma":
                turns = name.removeprefix("final_") in TURNS
                shown, factor = ("Hz", GAMMA / (2 * math.pi)) if turns else ("1/s", GAMMA)
            if isinstance(one, fs.SmoothedMap):
                shown, factor = {"m": ("mm", 1e3), "T": ("mT", 1e3), "T/m": ("mT/mm", 1.0)}[unit]
            assert lab[name].attrs.get("units", "") == shown, (type(one), name)
            if variable.dtype.kind in "fc":
                np.testing.assert_allclose(lab[name].values, factor * variable.values, rtol=1e-12, err_msg=name)
            if factor != 1.0:
                converted.add(type(one).__name__)
            words_and_parameters = isinstance(one, (fs.Run, fs.Sweep)) and name not in {*fs._tables.RESULTS, "frequency", "kappa"}
            if hasattr(type(one), "lab") and not words_and_parameters and variable.shape == np.shape(getattr(one, name, variable)):
                got = np.asarray(getattr(one.lab, name) if not isinstance(one, (fs.Trajectory, fs.Fit)) else one.lab[name])
                assert np.array_equal(got.ravel(), lab[name].values.ravel(), equal_nan=variable.dtype.kind in "fc"), (type(one), name)
                if type(one).__name__ not in ("Sweep", "Run", "Orbit"):
                    assert one.lab.unit(name) == shown
            if unit == "l":
                np.testing.assert_allclose(si[name].values, L * variable.values, rtol=1e-12)
                assert si[name].attrs["units"] == "m"
    assert len(converted) >= 15, converted


def test_parameters_in_other_units():
    """Varied ones, sought ones and those of branches, with digits that are shifted; omega turns, as the result of this name."""
    bead = fs.Bead(run__periods=2, run__discard=1)
    s = fs.sweep(bead, omega=[0.2, 0.3], magnet__depth=["9 mm", "16 mm"], friction__law=["none", "viscous"])
    turns = np.array([0.2, 0.3]) * GAMMA / (2 * math.pi)
    assert s.lab.magnet__depth[0, :, 0].tolist() == [9.0, 16.0] and s.lab.unit("magnet__depth") == "mm"
    assert s.lab.friction__law[0, 0].tolist() == ["none", "viscous"] and np.array_equal(s.si.magnet__depth, s.magnet__depth)
    for found in (s.lab.omega[:, 0, 0], s.to_pandas("lab").omega.unique(), s[:, 1, 1].lab.omega, s.to_xarray("lab").omega):
        np.testing.assert_allclose(found, turns, rtol=1e-15)
    run = s[0, 1, 1]
    np.testing.assert_allclose([run.lab.omega, run.si.omega], [turns[0], 0.2 * GAMMA], rtol=1e-15)
    assert (run.lab.unit("omega"), run.si.unit("omega"), s.to_pandas().attrs["units"]["omega"]) == ("Hz", "rad/s", "gamma")
    with pytest.raises(AttributeError):
        s.lab.kappa
    with pytest.raises(KeyError):
        s.lab.parameter("kappa")
    fit = fs.fit({"frequency [Hz]": [9.0, 11.0], "mean_r [mm]": [17.0, 18.0], "mean_r_error [mm]": [0.1, 0.1]}, free="magnet.depth",
                 bead=fs.Bead(run__periods=30))
    own, lab = fit.to_pandas(), fit.to_pandas("lab")
    assert (own.unit[0], lab.unit[0], fit.lab.unit("value")) == ("m", "mm", "")
    np.testing.assert_allclose(lab.loc[0, ["value", "error", "low", "high"]].astype(float), own.loc[0, ["value", "error", "low", "high"]].astype(float) * 1e3)


def test_views_in_other_units_are_copied(results):
    for one in results:
        if hasattr(type(one), "lab"):
            for again in (pickle.loads(pickle.dumps(one.lab)), copy.deepcopy(one.lab)):
                assert type(again) is type(one.lab) and (again == one.lab or isinstance(one, fs.Trajectory))
    branch = next(one for one in results if isinstance(one, fs.Branch))
    assert "mean_r" in dir(branch.lab) and not branch.lab.mean_r.flags.writeable
    with pytest.raises(AttributeError):
        branch.lab.mean_q
    with pytest.raises(fs.BadInput, match="mean_r"):
        branch.lab["mean_q"]


def test_a_branch_from_a_file_has_units_too(results, tmp_path):
    branch = next(one for one in results if isinstance(one, fs.Branch))
    branch.save(tmp_path / "branch.json")
    again = fs.read(tmp_path / "branch.json")
    assert again.bead is None and np.array_equal(again.lab.mean_r, branch.lab.mean_r) and again.lab.unit("period") == "s"
    assert again.lab.unit("value") == "Hz" and branch.to_xarray().value.attrs["long_name"] == "drive.omega"


def test_final_states_of_a_sweep_of_worlds():
    world = fs.World(plate__shape="bowl", plate__bowl_radius="200 mm", run__periods=2, run__discard=1)
    s = fs.sweep(world, frequency=[9, 10])
    frame = s.to_pandas("lab")
    assert np.allclose(frame.final_WX, s.final_state[:, 9] * GAMMA / (2 * math.pi), rtol=1e-12)
    assert frame.attrs["units"]["final_Z"] == "mm" and pickle.loads(pickle.dumps(s)) == s


def test_measured_lengths(results):
    track = next(one for one in results if isinstance(one, fs.Track))
    assert track.to_xarray("si").x.attrs["units"] == "m" and np.allclose(track.to_pandas("si").x, track.x / 1e3)
    pixels = fs.Track({"t": [0.0, 1.0], "x": [1.0, 2.0], "y": [0.0, 0.0]}, unit="px")
    assert pixels.to_pandas().attrs["units"]["x"] == "px"
    with pytest.raises(fs.BadInput):
        pixels.to_pandas("lab")


# ---------------------------------------------------------------------------------------- merged sweeps


def test_merge(program, tmp_path):
    bead, axes = fs.Bead(run__periods=3, run__discard=1), {"frequency": [9, 10, 11], "kappa": [1.2, 1.5]}
    parts = [tmp_path / f"{i}.db" for i in (1, 2)]
    for i, part in enumerate(parts):
        half = fs.sweep(bead, **axes, file=part, shard=(i + 1, 2))
        assert 0 < half.done.sum() < 6
    with pytest.warns(UserWarning, match="3 of 6 points have no row"):
        assert not fs.merge(parts[:1], tmp_path / "half.db").complete
    whole = fs.merge(parts, tmp_path / "all.db")
    assert whole.complete and np.array_equal(whole.mean_r, fs.sweep(bead, **axes).mean_r)
    assert ask(program, "merge", *map(str, parts), "-o", str(tmp_path / "theirs.db"), "--json")["rows"] == 6
    assert fs.read(tmp_path / "theirs.db") == whole
    with pytest.raises(fs.BadInput, match="list"):
        fs.merge(parts[0], tmp_path / "b.db")
    with pytest.raises(fs.BadInput):
        fs.merge(parts, tmp_path / "all.db")  # it is there
    with pytest.raises(fs.BadInput):
        fs.merge([], tmp_path / "none.db")
    with pytest.raises(fs.BadInput, match="file"):
        fs.sweep(bead, **axes, shard=(1, 2))
