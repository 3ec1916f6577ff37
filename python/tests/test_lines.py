"""What a physicist writes: each capability, a few lines each."""

import gc
import inspect
import json
import math
import pathlib
import pickle
import subprocess
import weakref
import xml.etree.ElementTree

import numpy as np
import pytest

import festoon as fs

SOURCE = pathlib.Path(__file__).resolve().parents[2]


# ---------------------------------------------------------------------------------------- the bead


def test_keywords_take_units_and_both_forms():
    bead = fs.Bead(frequency="642 rpm", friction__gamma="300 1/s", mu=0.3, start__phi="0.1 rad")
    assert bead.frequency == 642 / 60 and bead.gamma == 300.0 and bead.mu == 0.3
    assert bead.omega == pytest.approx(2 * math.pi * 10.7 / 300)
    assert bead.start__phi == pytest.approx(math.degrees(0.1))
    scaled = bead.replace(omega=0.25)
    assert scaled.omega == 0.25 and scaled.frequency == pytest.approx(0.25 * 300 / (2 * math.pi))
    assert scaled.replace(frequency=8).omega == pytest.approx(2 * math.pi * 8 / 300)
    assert fs.Bead(kappa=np.float64(1.2)).kappa == 1.2 and fs.Bead(magnet__lines=np.int64(3)).magnet__lines == 3


def test_a_quantity_given_twice_is_refused():
    with pytest.raises(fs.BadInput, match="two forms"):
        fs.Bead(frequency=8, omega=0.2)
    with pytest.raises(fs.BadInput, match="twice"):
        fs.Bead(frequency=8, drive__frequency=9)


def test_errors_carry_the_library_s_words():
    with pytest.raises(fs.BadInput) as caught:
        fs.Bead(friction__gama=3)
    assert caught.value.where == "friction.gama" and "the nearest is friction.gamma" in caught.value.sentence
    assert isinstance(caught.value, ValueError) and isinstance(caught.value, fs.FestoonError)
    again = pickle.loads(pickle.dumps(caught.value))
    assert (type(again), again.where, again.sentence) == (fs.BadInput, caught.value.where, caught.value.sentence)
    with pytest.raises(fs.BadInput, match="effect"):
        fs.Bead(bead__a=1.0).run()
    with pytest.raises(fs.NoConvergence):
        fs.Bead(frequency=2).orbit()


def test_scenes(tmp_path):
    bead = fs.Bead(frequency="9.3 Hz", kappa=1.7, friction__law="coulomb", bead__radius="2 mm")
    bead.save(tmp_path / "bead.yaml")
    assert fs.Bead.load(tmp_path / "bead.yaml") == bead == fs.Bead(tmp_path / "bead.yaml")
    assert fs.Bead(tmp_path / "bead.yaml", kappa=1.1) == bead.replace(kappa=1.1) != bead
    assert fs.Bead(bead.scene(comments=True)) == bead and hash(fs.Bead(bead.scene())) == hash(bead)
    assert pickle.loads(pickle.dumps(bead)) == bead
    assert eval(repr(bead), {"Bead": fs.Bead}) == bead
    (tmp_path / "bad.yaml").write_text("drive:\n  frequenzy: 3\n")
    with pytest.raises(fs.BadInput) as caught:
        fs.Bead.load(tmp_path / "bad.yaml")
    assert caught.value.where.endswith("bad.yaml:2") and "frequency" in caught.value.sentence


def test_every_parameter_is_a_keyword():
    """The tables of Python are those of the headers: rows of params.def and run.def by their macros."""
    import re

    text = (SOURCE / "include/festoon/params.def").read_text()
    keys = [".".join(pair) for pair in re.findall(r"^FST_(?:REAL|INT|CHOICE)\((\w+), (\w+),", text, re.M)]
    assert len(keys) > 30 and set(keys) <= set(fs._tables.PARAMETERS)
    names = re.findall(r"^FST_RESULT\((\w+),", (SOURCE / "include/festoon/run.def").read_text(), re.M)
    assert names == list(fs._tables.RESULTS)
    signature = inspect.signature(fs.Bead)
    for key in keys:
        assert key.replace(".", "__") in signature.parameters
        assert getattr(fs.Bead, key.replace(".", "__")).__doc__
    assert {"frequency", "omega", "kappa", "gamma", "mu"} <= set(signature.parameters)
    columns = re.findall(r"^FST_COLUMN\((\w+),", (SOURCE / "src/io/columns.def").read_text(), re.M)
    assert columns == list(fs._tables.COLUMNS)


def test_schema(program):
    assert fs.schema() == ask(program, "schema", "--json")


def test_card():
    bead = fs.Bead(friction__law="coulomb")
    page = bead._repr_html_()
    xml.etree.ElementTree.fromstring(f"<div>{page}</div>")
    assert "<svg" in page and "friction.law" in page and "coulomb" in page and "kappa" in page and len(page) < 60000
    points = page.split("points='")[1].split("'")[0].split()
    places = np.array([[float(number) for number in point.split(",")] for point in points])
    assert len(points) > 500 and places.min() >= 0 and places.max() <= 220 and np.ptp(places[:, 0]) > 100
    run = bead.run(periods=20)
    xml.etree.ElementTree.fromstring(f"<div>{run._repr_html_()}</div>")


# ---------------------------------------------------------------------------------------- runs and samples


def test_run_in_units(bead):
    run = bead.run()
    assert run.regime == "counter-rotating" and run.symmetry == "S1" and 0 < run.mean_r_error < 1e-6
    assert run.si.mean_r == run.mean_r * 0.023 and run.lab.mean_r == pytest.approx(23 * run.mean_r)
    assert (run.si.unit("mean_r"), run.lab.unit("mean_r")) == ("m", "mm")
    assert run.si.mean_alpha_dot == pytest.approx(run.mean_alpha_dot * bead.gamma)
    again = pickle.loads(pickle.dumps(run))
    assert again.to_dict() == run.to_dict() and again.reason == run.reason
    assert math.isnan(run.sticking) and run.never_slips is None and run.trajectory is None and run.complete


def test_trajectory_is_the_memory_of_the_library(bead):
    tr = bead.run(periods=20, trajectory=True).trajectory
    assert isinstance(tr, np.ndarray) and tr.dtype.names == tuple(fs._tables.COLUMNS) and len(tr) == 20 * 64 + 1
    assert not tr.flags.owndata and tr.r.base is not None and np.shares_memory(tr.r, tr)
    assert np.allclose(tr.r, np.hypot(tr.X, tr.Y)) and np.allclose(tr.x, tr.r * np.cos(tr.alpha), atol=1e-12)
    assert tr.si.x[-1] == tr.x[-1] * 0.023 and tr.lab.unit("WX") == "rad/s" and tr.si.unit("t") == "s"
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


# ---------------------------------------------------------------------------------------- sweeps


def test_sweep_has_a_row_for_each_point():
    base = fs.Bead(run__periods=20)
    s = fs.sweep(base, frequency=np.linspace(9, 12, 3), kappa=[1.2, 1.5], model__dynamics=["rigid", "farago2020"])
    assert s.shape == s.mean_r.shape == (3, 2, 2) and s.dims == ("frequency", "kappa", "model__dynamics")
    assert s.complete and s.done.all() and not s.failed.any()
    assert s.parameter("frequency")[2, 1, 0] == 12 and s.parameter("model__dynamics")[0, 0, 1] == "farago2020"
    assert s.bead(2, 0, 1) == base.replace(frequency=12, kappa=1.2, model__dynamics="farago2020", run__discard=10)
    one = s[1, 1, 0]
    assert isinstance(one, fs.Run) and one.mean_r == s.mean_r[1, 1, 0]
    part = s[:, 1]
    assert part.shape == (3, 2) and part.dims == ("frequency", "model__dynamics")
    assert np.array_equal(part.mean_r, s.mean_r[:, 1])
    assert s[..., 0].dims == ("frequency", "kappa") and np.array_equal(s[..., 0].mean_r, s.mean_r[..., 0])
    assert s[..., :, :, :].dims == s.dims
    assert np.array_equal(s.si.mean_r, s.mean_r * 0.023)
    assert np.shares_memory(s.mean_r, s._rows)


def test_a_failed_run_is_a_row():
    bead = fs.Bead(run__periods=5)
    eps = bead.groups.eps
    s = fs.sweep(bead, start__r=[0.95, eps, 0.9])
    assert s.failed.tolist() == [False, True, False]
    failed = s[s.failed]
    assert failed.shape == (1,) and isinstance(failed.errors[0], fs.BadInput) and "rolling" in str(failed.errors[0])
    assert math.isnan(s.mean_r[1]) and s.regime[1] == "" and s.errors[0] is None
    with pytest.raises(fs.BadInput):
        s[1]


def test_sweep_for_other_libraries():
    pytest.importorskip("pandas")
    pytest.importorskip("xarray")
    s = fs.sweep(fs.Bead(run__periods=10), frequency=[9, 10, 11], kappa=[1.2, 1.5])
    data = s.to_xarray()
    assert data.mean_r.dims == ("frequency", "kappa") and data.mean_r.attrs["units"] == "l"
    assert data.frequency.attrs["units"] == "Hz" and np.array_equal(data.mean_r, s.mean_r)
    frame = s.to_pandas()
    assert len(frame) == 6 and frame.kappa.tolist() == [1.2, 1.5] * 3
    assert np.array_equal(frame.mean_r, s.mean_r.ravel())


def test_sweep_with_random_and_logarithmic_axes():
    bead = fs.Bead(run__periods=2)
    s = fs.sweep(bead, kappa="1:2:random:5", gamma="200:400:random:5", seed=7)
    assert s.shape == (5,) and s.dims == ("draw",) and len(set(s.parameter("kappa"))) == 5
    with pytest.raises(fs.BadInput, match="unit"):
        s.si
    s = fs.sweep(bead, kappa="1:4:3:log")
    assert s.parameter("kappa").tolist() == pytest.approx([1, 2, 4])
    with pytest.raises(fs.BadInput, match="nearest"):
        fs.sweep(bead, freqency=[1, 2])


def test_sweep_in_a_file_goes_on(tmp_path):
    bead, file = fs.Bead(run__periods=5), tmp_path / "sweep.db"
    first = fs.sweep(bead, frequency=[9, 10], file=file)
    before = file.read_bytes()
    again = fs.sweep(bead, frequency=[9, 10], file=file)
    assert np.array_equal(first.mean_r, again.mean_r) and len(before) > 0
    with pytest.raises(fs.BadInput):
        fs.sweep(bead, frequency=[9, 11], file=file)
    fs.export(file, tmp_path / "rows.json")
    assert [row["mean_r"] for row in json.loads((tmp_path / "rows.json").read_text())] == first.mean_r.tolist()
    fs.export(file, tmp_path / "rows.csv", ["mean_r"], units="lab")
    assert (tmp_path / "rows.csv").read_text().startswith("drive.frequency [Hz],mean_r [mm]")
    carried = fs.sweep(bead, frequency=[9, 10], carry="up")
    assert carried.mean_r[0] == first.mean_r[0] and carried.mean_r[1] != first.mean_r[1]


def test_a_refined_sweep(bead):
    bead = bead.replace(plate__radius="6 cm", run__periods=4, run__discard=2)
    axes = {"start__r": "0.3:2.9:33", "kappa": "0.2:2:22"}
    whole = fs.sweep(bead, **axes)
    part = fs.sweep(bead, **axes, refine=3)
    assert part.shape == whole.shape and not part.complete and whole.computed.all()
    assert 0.2 < part.computed.mean() < 0.7
    assert np.array_equal(part.mean_r[part.computed], whole.mean_r[part.computed], equal_nan=True)
    assert np.isnan(part.mean_r[~part.computed]).all()
    # Where runs around a point agree, its regime is known, as the whole sweep has it but for missed islands.
    names = np.array([*fs.sweeps.REGIMES, ""])
    between = part._between.reshape(part.shape)
    known = np.isfinite(between)
    assert not (known & part.computed).any() and known.mean() > 0.3
    assert (names[between[known].astype(int)] != whole.regime[known]).sum() <= 15
    assert part.refined and not whole.refined and f"{(~part.computed).sum()} left out (refined)" in repr(part)
    assert set(part.regime[~part.computed]) == {""} and part[part.computed].complete
    with pytest.raises(fs.BadInput, match="was not computed, because the sweep was refined"):
        part[tuple(np.argwhere(~part.computed)[0])]


def test_how_a_sweep_is_refined(bead):
    bead = bead.replace(run__periods=4, run__discard=2)
    axes = {"kappa": "0.3:2:17", "frequency": ["9 Hz", "12 Hz"]}
    one = fs.sweep(bead, **axes, refine=2, refine_by="mean_r", refine_step=0.01)
    other = fs.sweep(bead, **axes, refine=2, refine_by="mean_r:0.01")
    assert np.array_equal(one.mean_r, other.mean_r, equal_nan=True) and one.computed.sum() > 10
    with pytest.warns(UserWarning, match="impacts_per_return has no value in any run, so nothing was refined"):
        assert fs.sweep(bead, **axes, refine=2, refine_by="impacts_per_return:1").computed.sum() == 10
    for wrong, words in (
        ({"refine_by": "mean_r"}, "by how much"),
        ({"refine_by": "mean_r:x"}, '"x" in "mean_r:x" must be a number'),
        ({"refine_by": "mean_r:0.1", "refine_step": 0.1}, "give it once"),
        ({"refine_by": "reason"}, "reason is a text"),
        ({"refine": 0, "refine_by": "mean_r:0.1"}, "belongs to a refined sweep"),
        ({"refine": 4}, "from 1 to 3"),
        ({"kappa": np.linspace(0.3, 2, 17)}, "nothing to refine"),
        ({"carry": "up"}, "carried sweep cannot be refined"),
    ):
        with pytest.raises(fs.BadInput, match=words):
            fs.sweep(bead, **{**axes, "refine": 2, **wrong})


def test_progress_is_told(bead):
    told = []
    fs.sweep(bead, frequency="9:12:8", progress=lambda fraction, what: told.append(fraction))
    assert told and told == sorted(told) and told[-1] == 1.0


def test_an_exception_of_the_progress_function_ends_the_call(bead):
    def refuse(fraction, what):
        raise RuntimeError("enough")

    with pytest.raises(RuntimeError, match="enough"):
        bead.run(periods=4000, progress=refuse)
    with pytest.raises(RuntimeError, match="enough"):
        fs.sweep(bead, frequency="9:12:80", progress=refuse)


# ---------------------------------------------------------------------------------------- orbits and branches


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


# ---------------------------------------------------------------------------------------- field and flow


def test_field_broadcasts(bead):
    x, y = np.linspace(-1, 1, 5)[:, None], np.linspace(0, 1, 3)
    b, grad = bead.field(x, y)
    assert b.shape == (5, 3, 3) and grad.shape == (5, 3, 3, 3)
    assert np.allclose(grad, np.swapaxes(grad, -1, -2)) and np.allclose(np.trace(grad, axis1=-2, axis2=-1), 0)
    step = 1e-5
    ahead, behind = bead.field(x + step, y)[0], bead.field(x - step, y)[0]
    assert np.allclose((ahead - behind) / (2 * step), grad[..., 0], atol=1e-7)
    assert np.array_equal(bead.field("10 mm", 0.0)[0], bead.field(10e-3 / 0.023, 0.0)[0])
    with pytest.raises(fs.BadInput, match="tesla"):
        bead.field(0, 0, units="si")
    many = np.linspace(-1, 1, 5001)  # more than one call takes
    assert np.array_equal(bead.field(many, 0.3)[1][::100], bead.field(many[::100], 0.3)[1])


def test_a_field_of_many_points_obeys_ctrl_c(bead, monkeypatch):
    """It is computed piece by piece, and the signal is seen between them."""
    from types import SimpleNamespace

    from festoon import fields

    sizes = []

    def piece(model, count, *arrays):
        sizes.append(count)
        if len(sizes) == 3:
            raise KeyboardInterrupt

    groups = fields.lib.fst_model_groups
    monkeypatch.setattr(fields, "lib", SimpleNamespace(pyf_field=piece, fst_model_groups=groups))
    with pytest.raises(fs.Interrupted):
        bead.field(np.zeros(10**5), 0.0)
    assert sizes == [fields.PIECE] * 3


def test_flow(bead):
    flow = bead.flow()
    t, y = flow.advance(until="section")
    assert flow.stop == "section" and t == flow.t > 0 and abs(y[0]) < 1e-14
    t, y = flow.advance(t=20.0)
    assert t == 20.0 and flow.stop == "time" and np.array_equal(y, flow.state)
    with pytest.raises(fs.BadInput, match="unknown event"):
        flow.advance(until="sektion")


def test_a_flow_that_was_stopped_goes_on_with_the_same_bits(bead, monkeypatch):
    stopped, whole = bead.flow(), bead.flow()
    monkeypatch.setattr(stopped._watch, "tell", lambda fraction, what: 1 / 0)
    with pytest.raises(ZeroDivisionError):
        stopped.advance(t=1e9)
    assert 0 < stopped.t < 1e9
    monkeypatch.undo()
    end = math.ceil(stopped.t) + 50.0
    assert np.array_equal(stopped.advance(t=end)[1], whole.advance(t=end)[1]) and stopped.rhs_calls == whole.rhs_calls


# ---------------------------------------------------------------------------------------- measuring


def ask(program, *words):
    return json.loads(subprocess.run([program, *words], stdout=subprocess.PIPE, check=True).stdout)


def test_measure(program, bead, tmp_path):
    """What a camera sees of a run gives the run's numbers back, and the program's."""
    run = bead.run(periods=200, discard=60, trajectory=True, fps=240, sample_from=60)
    lab = run.trajectory.lab
    noise = np.random.default_rng(1).normal(scale=0.05, size=(2, len(lab.t)))
    track = tmp_path / "track.csv"
    rows = np.column_stack([lab.t, lab.x + noise[0], lab.y + noise[1]])
    np.savetxt(track, rows, delimiter=",", header="t [s],x [mm],y [mm]", comments="")
    (tmp_path / "px.csv").write_text(track.read_text().replace("[mm]", "[px]"))
    measured = fs.measure(track, drive="10.7 Hz")
    assert measured.length_unit == "mm" and measured.motion == "turning" and len(measured.track) == len(rows)
    assert abs(measured.mean_r - run.lab.mean_r) < 5 * measured.mean_r_error
    assert abs(measured.festoons - run.festoons) < 5 * measured.festoons_error
    assert measured.to_dict() == ask(program, "measure", track, "--drive", "10.7Hz", "--json")
    assert np.array_equal(fs.read_track(track).x, rows[:, 1])
    with pytest.raises(fs.BadInput):
        fs.measure(track, drive="10.7 mm")
    fs.save_points(tmp_path / "points.csv", [measured, measured])
    subprocess.run([program, "measure", track, track, "--drive", "10.7Hz", "-o", tmp_path / "theirs.csv"],
                   check=True, capture_output=True)
    assert (tmp_path / "points.csv").read_bytes() == (tmp_path / "theirs.csv").read_bytes()
    with pytest.raises(fs.BadInput, match="scale"):
        fs.save_points(tmp_path / "points.csv", [fs.measure(track.with_name("px.csv"))])


def test_fit(program, tmp_path):
    """Points that a model made give its parameters back."""
    truth = fs.Bead(kappa=1.4, gamma=300, run__periods=100)
    lines = ["frequency [Hz],mean_r [mm],mean_r_error [mm],bead_frequency [Hz],bead_frequency_error [Hz]"]
    s = fs.sweep(truth, frequency=[9.5, 10.7, 12, 13.5])
    for f, r, a in zip(s.parameter("frequency"), s.lab.mean_r, s.mean_alpha_dot * 300 / (2 * math.pi)):
        lines.append(f"{f},{r:.6f},0.01,{a:.6f},0.002")
    points = tmp_path / "points.csv"
    points.write_text("\n".join(lines) + "\n")
    fit = fs.fit(points, free=["kappa", "friction.gamma"])
    # The points have no noise, so that they are met better than their errors say.
    assert abs(fit["kappa"].value - 1.4) < fit["kappa"].error and fit.chi2 < 1
    assert abs(fit["gamma"].value - 300) < fit["gamma"].error and fit.dof == 6
    assert fit.correlation.shape == (2, 2) and fit.correlation[0, 0] == 1 and abs(fit.correlation[0, 1]) < 1
    assert fit.bead.kappa == fit["kappa"].value
    assert fit.to_dict() == ask(program, "fit", points, "--free", "model.kappa,friction.gamma", "--json")


# ---------------------------------------------------------------------------------------- pictures


def test_axes_come_back(bead):
    matplotlib = pytest.importorskip("matplotlib")
    import matplotlib.pyplot as plt

    tr = bead.run(periods=20, trajectory=True).trajectory
    axes = [tr.plot(colour="n_z"), fs.sweep(bead.replace(run__periods=5), frequency=[9, 10]).plot()]
    axes.append(bead.branch(omega=(0.24, 0.25)).plot())
    assert all(isinstance(ax, matplotlib.axes.Axes) and ax.get_xlabel() for ax in axes)
    plt.close("all")


def test_the_page_or_a_sentence(tmp_path, monkeypatch):
    from festoon import lab

    monkeypatch.setattr(lab, "places", lambda: [tmp_path / lab.PAGE])
    with pytest.raises(fs.Unavailable, match="was not built"):
        fs.Bead().lab()
    (tmp_path / lab.PAGE).write_text("<html><head><title>t</title></head><body>\"&</body></html>")
    shown = fs.Bead(kappa=1.2, friction__law="coulomb").lab()
    assert shown.fragment == "v=1&friction.law=coulomb&model.kappa=1.2&drive.frequency=10.7"
    assert shown.url.startswith("file://") and shown.url.endswith(shown.fragment)
    page = shown._repr_html_()
    assert page.startswith("<iframe srcdoc=") and "v=1&amp;friction.law" in page


# ---------------------------------------------------------------------------------------- real magnets

BALL = {"kind": "sphere", "centre": [0, 0, "-5 mm"], "size": "20 mm", "remanence": [1.2, 0, 0]}


def test_parts_of_a_magnet(tmp_path):
    bead = fs.Bead(magnet__parts=[BALL, {**BALL, "kind": "sphere", "rotation": [30, 0, 0, 1]}], magnet__depth="40 mm")
    assert bead.magnet__shape == "parts" and len(bead.magnet__parts) == 2
    assert bead.magnet__parts[0] == {
        "kind": "sphere", "centre": [0, 0, -0.005], "size": [0.02], "remanence": [1.2, 0, 0]
    }
    assert bead.magnet__parts[1]["rotation"] == [30, 0, 0, 1]
    bead.save(tmp_path / "magnet.yaml")
    assert fs.Bead.load(tmp_path / "magnet.yaml") == bead == eval(repr(bead), {"Bead": fs.Bead})
    assert bead.replace(kappa=1.2).magnet__parts == bead.magnet__parts
    assert "magnet.parts[1]" in bead._repr_html_()
    one = bead.replace(magnet__parts=[BALL])
    assert len(one.magnet__parts) == 1 and one != bead
    with pytest.raises(fs.BadInput, match="kind"):
        fs.Bead(magnet__parts=[{"size": 1}])
    with pytest.raises(fs.BadInput, match="remanence"):
        fs.Bead(magnet__parts=[{**BALL, "remanenz": [1, 0, 0]}])


def test_a_sphere_s_field_is_a_dipole_s():
    """Outside, a magnetised ball is a dipole of moment V J/mu_0 at its centre: B on its axis is 2 J R^3/(3 d^3)."""
    bead = fs.Bead(magnet__parts=[{**BALL, "centre": [0, 0, 0], "remanence": [0, 0, 1.2]}], magnet__depth="40 mm")
    b, _ = bead.field(0, 0, height="45 mm", units="si")
    assert b == pytest.approx([0, 0, 2 * 1.2 * 0.01**3 / (3 * 0.045**3)], rel=1e-12)


def test_sweep_over_a_part():
    bead = fs.Bead(magnet__parts=[BALL], magnet__depth="40 mm", run__periods=2)
    s = fs.sweep(bead, **{"magnet.parts[0].centre[2]": ["-6 mm", -0.005]})
    assert s.shape == (2,) and s.bead(0).magnet__parts[0]["centre"][2] == -0.006
    assert s.parameter("magnet.parts[0].centre[2]").tolist() == [-0.006, -0.005]


# ---------------------------------------------------------------------------------------- what is refused


def test_a_bead_never_changes():
    bead = fs.Bead()
    for name in ("kappa", "frequncy"):
        with pytest.raises(AttributeError, match="never changes"):
            setattr(bead, name, 1.2)


@pytest.mark.parametrize("value", [[1, 2], np.array([1.0, 2.0]), 1j, True, b"1", {}, "1\0", float("nan")])
def test_what_is_no_number_is_bad_input(value):
    with pytest.raises(fs.BadInput) as caught:
        fs.Bead(kappa=value)
    assert caught.value.where == "model.kappa"


@pytest.mark.parametrize("keywords", [{"fps": 0}, {"fps": -3}, {"fps": math.nan}, {"fps": "60 mm"},
                                      {"sample_from": math.nan}, {"sample_from": -1}])
def test_samples_that_cannot_be_are_refused(keywords):
    with pytest.raises(fs.BadInput) as caught:
        fs.Bead().run(periods=10, trajectory=True, **keywords)
    assert caught.value.where == next(iter(keywords))


def test_a_path_is_not_cut_off(tmp_path):
    with pytest.raises(ValueError, match="null"):
        fs.Bead().save(str(tmp_path / "bead\0.yaml"))
    assert not list(tmp_path.iterdir())


# ---------------------------------------------------------------------------------------- a map of the field


@pytest.fixture
def mapped(tmp_path, monkeypatch):
    """A bead over a measured map, whose path begins at the folder of the work."""
    monkeypatch.chdir(tmp_path)
    for name in ("measured-map.csv", "measured-map.yaml"):
        (tmp_path / name).write_bytes((SOURCE / "examples/magnets" / name).read_bytes())
    return fs.Bead("measured-map.yaml", run__periods=3, run__discard=1)


def test_a_scene_in_another_folder_finds_its_map(mapped, tmp_path):
    (tmp_path / "deeper").mkdir()
    mapped.save("deeper/bead.yaml")
    mapped.save("beside.yaml")
    for path in ("deeper/bead.yaml", "beside.yaml", tmp_path / "measured-map.yaml"):
        again = fs.Bead(path, run__periods=3, run__discard=1)
        assert again == mapped and hash(again) == hash(mapped)
        assert np.array_equal(again.field(0.3, 0.1)[1], mapped.field(0.3, 0.1)[1])
    assert mapped.replace(kappa=1.2) != mapped


def test_a_bead_keeps_its_map(mapped, tmp_path, monkeypatch):
    """What follows from a bead uses the map that was read, wherever one works and whatever became of the file."""
    run, rows = mapped.run(trajectory="run.h5"), fs.sweep(mapped, frequency=[14, 15])
    data = pickle.dumps(mapped)
    (tmp_path / "deeper").mkdir()
    monkeypatch.chdir(tmp_path / "deeper")
    assert pickle.loads(data) == mapped
    (tmp_path / "measured-map.csv").unlink()
    b = mapped.field(0.3, 0.1)[0]
    assert mapped.run().mean_r == run.mean_r and np.array_equal(fs.Bead(mapped).field(0.3, 0.1)[0], b)
    del mapped
    gc.collect()
    assert rows[0].mean_r == rows.mean_r[0] and np.array_equal(rows.bead(0).field(0.3, 0.1)[0], b)
    with pytest.raises(fs.BadInput, match="measured-map"):
        rows.bead(0).replace(magnet__checksum="0123456789abcdef")
    read = fs.read(tmp_path / "run.h5")
    assert len(read) > 100 and read.lab.unit("x") == "mm" and read.bead.magnet__shape == "grid"
    with pytest.raises(fs.BadInput, match="measured-map"):
        read.bead.field(0, 0)
