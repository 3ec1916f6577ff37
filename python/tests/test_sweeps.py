"""Sweeps: their points, files, refinement, and tables for other libraries."""

import csv
import json
import math
import pickle
import subprocess
import warnings

import numpy as np
import pytest

import festoon as fs


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
    runs = list(s)
    assert [run.status for run in runs] == ["done", "bad input", "done"] == s.status.tolist()
    assert runs[1].bead.start__r == eps and "rolling" in runs[1].reason
    assert math.isnan(runs[1].mean_r) and math.isnan(runs[1].lab.mean_r) and runs[1].never_slips is None
    assert runs[1].regime == "" and runs[1].to_dict()["regime"] is None and "bad input: a free-rolling start" in repr(runs[1])
    again = pickle.loads(pickle.dumps(runs[1]))
    assert again == runs[1] != runs[0] and again.status == "bad input" and str(again.error) == str(s.errors[1])
    told = []
    for carry in (None, "up"):  # in memory, and through a file
        with pytest.warns(UserWarning, match="no run of this sweep could be made; the first: bad input: a free-rolling") as of_all:
            fs.sweep(bead, start__r=[eps], kappa=[1, 2], carry=carry)
        told.append([str(one.message) for one in of_all])
        assert of_all[0].filename == __file__
    assert told[0] == told[1] and len(told[0]) == 1
    impossible = fs.sweep(bead.replace(run__discard=3), run__periods=[2, 4])[0]
    assert impossible.status == "bad input" and "leaves nothing" in impossible.reason and "nothing" in impossible._repr_html_()
    assert math.isnan(impossible.to_dict()["mean_r"] or math.nan) and impossible.to_pandas().mean_r.isna().all()


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
    # In laboratory units, each with its name; and what was computed, by which version.
    for lab, about in ((s.to_xarray("lab"), s.to_xarray("lab").attrs), (s.to_pandas("lab"), s.to_pandas("lab").attrs)):
        for name in fs._tables.RESULTS:
            if name not in ("omega", "frequency_hz"):
                values = np.asarray(lab[name]).reshape(s.shape)
                assert np.array_equal(values, getattr(s.lab, name), equal_nan=True), name
                unit = lab[name].attrs["units"] if hasattr(lab, "data_vars") else about["units"][name]
                assert unit == s.lab.unit(name), name
        assert fs.Bead(about["scene"]) == s.bead(0, 0).replace(frequency=fs.UNSET, kappa=fs.UNSET)
        assert about["version"] == fs.__version__ and about["axes"] == "drive.frequency=9,10,11; model.kappa=1.2,1.5"
    assert s.to_pandas().attrs["units"]["kappa"] == "1" and s.to_pandas().attrs["units"]["mean_r"] == "l"

REAL = {"bead__radius": "1.5 mm", "bead__density": 7500, "bead__remanence": 1.1, "magnet__b0": 9e-3}


@pytest.mark.parametrize("axis", [{"bead__radius": [1e-3, 1.5e-3]}, {"bead__density": [7000, 7500]}, {"magnet__b0": [8e-3, 9e-3]},
                                  {"gamma": [300, 310]}, {"gamma": [310]}, {"magnet__half_length": [0.022, 0.023]},
                                  {"bead__density": [7000, 7500], "beads": 1}])
def test_units_are_those_of_each_point(tmp_path, axis):
    """A varied parameter may be a unit, or make one: every column is what the program exports."""
    pytest.importorskip("pandas")
    pytest.importorskip("xarray")
    axis, file = dict(axis), tmp_path / "s.db"
    bead = fs.Bead(**REAL, run__periods=4, run__discard=2)
    if axis.pop("beads", 0):
        bead = fs.Beads(beads=[{"start__phi": 3}, {"start__phi": 183}], bead__density=7500, contact__pair_rate=312.5,
                        run__periods=3, run__discard=2)
    s = fs.sweep(bead, **axis, frequency=[10, 10.7], file=file)
    frame, data = s.to_pandas("lab"), s.to_xarray("lab")
    columns = list(fs._tables.RESULTS) if isinstance(s, fs.Sweep) else s.columns[s.columns.index("reason") + 1 :]
    seen = 0
    for name in columns:
        fs.export(file, tmp_path / "c.csv", [name], units="lab")
        head, *lines = csv.reader(open(tmp_path / "c.csv", newline=""))
        title = head[2]
        try:
            wanted = np.array([float(line[2] or "nan") for line in lines])
        except ValueError:
            continue  # names
        if name == "omega":  # a pure number there
            continue
        for shown in (frame[name], data[name].values.ravel(), getattr(s.lab, name).ravel()):
            np.testing.assert_allclose(np.asarray(shown, float), wanted, rtol=1e-13, err_msg=title)
        unit = frame.attrs["units"].get(name, "1")
        assert unit == s.lab.unit(name) or unit == "1", name
        assert title == (name if unit == "1" else f"{name} [{unit}]")
        seen += 1
    assert seen > 7
    if isinstance(s, fs.Sweep):
        pytest.importorskip("matplotlib")
        line = s.plot("mean_friction_power", units="lab", x="frequency" if s.shape[0] > 1 else None, kind="curves").lines[0]
        shown = line.get_ydata()  # with a gap where the regime changes
        assert shown[~np.isnan(shown)] == pytest.approx(s.lab.mean_friction_power[0])


@pytest.mark.parametrize("axes, scene, carried", [
    ({"start__r": "0.95,EPS,0.9", "friction__law": "viscous,coulomb"}, {}, False),
    ({"omega": "0.2,0.3", "model__dynamics": "rigid,farago2020"}, {"plate__radius": "24 mm"}, False),
    ({"frequency": "9,10.7"}, {"run__periods": 60}, True)])
def test_a_frame_is_the_table_of_the_program(program, tmp_path, axes, scene, carried):
    """All columns under their names, but for the keywords of what is varied; failed runs too."""
    pandas = pytest.importorskip("pandas")
    bead = fs.Bead(**{"run__periods": 6, **scene})
    axes = {name: values.replace("EPS", repr(bead.groups.eps)) for name, values in axes.items()}
    bead.save(tmp_path / "bead.yaml")
    words = [word for name, values in axes.items() for word in ("--over", f"{fs._keys.key_of(name)}={values}")]
    words += ["--carry", "up"] if carried else []
    for line in (["sweep", str(tmp_path / "bead.yaml"), *words, "-o", str(tmp_path / "s.db")],
                 ["export", str(tmp_path / "s.db"), "--csv", "-o", str(tmp_path / "s.csv")]):
        subprocess.run([program, *line], check=True, capture_output=True)
    theirs = pandas.read_csv(tmp_path / "s.csv", dtype=str, keep_default_na=False).sort_values("point", key=lambda column: column.astype(int))
    theirs = theirs.rename(columns=fs._keys.keyword_of)
    theirs = theirs.loc[:, ~theirs.columns.duplicated()]  # omega is a parameter and a result
    sweeps = [fs.read(tmp_path / "s.db"), fs.sweep(bead, **axes, carry="up" if carried else None)]
    assert sweeps[0].failed.any() == ("start__r" in axes) and sweeps[0]._carried.any() == carried
    for frame in (sweep.to_pandas() for sweep in sweeps):
        assert set(frame) == set(theirs) and len(theirs.columns) > 70
        for name in theirs:
            for ours, text in zip(frame[name], theirs[name]):
                blank = ours == "" or ours != ours
                known = blank if text == "" else str(ours) == text or float(ours) == float(text)
                assert known, (name, ours, text)


def test_what_a_sweep_can_hardly_mean_is_warned_of():
    """By the library's sentences, once, as the program does; a bead that the sweep does not run is not judged."""
    few, cube = fs.Bead(run__periods=1, run__discard=0), {"kind": "cuboid", "size": ["10 mm"] * 3, "remanence": [1.2, 0, 0]}
    for axes, kind, words in (
        ({"magnet__b0": ["1 mT", "2 mT"]}, fs.SceneWarning, "along magnet.b0 only units change"),
        ({"bead__radius": ["2.5 mm", "3 mm"]}, fs.MaterialWarning, "bead.radius is 0.003 m"),
    ):
        with pytest.warns(kind, match=words) as told:
            fs.sweep(few, **axes)
        assert len(told) == 1 and told[0].filename == __file__
    with pytest.warns(fs.MaterialWarning, match="bead.radius is 0.002499 m") as told:
        fs.Bead().branch(bead__radius=("2.499 mm", "2.5 mm"))
    assert len(told) == 1 and told[0].filename == __file__
    parts = [{**cube, "centre": [x, 0, 0]} for x in (0.0, 0.005, 0.008)]
    with pytest.warns(fs.SceneWarning, match=r"parts\[0\] and magnet.parts\[1\] overlap \(as 2 other pairs do\)") as told:
        solid = fs.Bead(magnet__parts=parts)
    assert told[0].filename == __file__
    with pytest.warns(fs.SceneWarning, match="overlap:") as told:
        fs.Bead(fs.Bead(magnet__parts=parts[:2]).scene())
    assert [one.filename for one in told] == [__file__] * 2
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        solid.replace(frequency=9)
        fs.Bead(magnet__parts=[parts[0], {**cube, "size": ["4 mm"] * 3, "centre": [0.002, 0, 0], "remanence": [-1.2, 0, 0]}])  # a hole
        fs.sweep(few.replace(bead__radius="3 mm"), bead__radius=["2.5 mm"])


def test_sweep_with_random_and_logarithmic_axes():
    bead = fs.Bead(run__periods=2)
    s = fs.sweep(bead, kappa="1:2:random:5", gamma="200:400:random:5", seed=7)
    assert s.shape == (5,) and s.dims == ("draw",) and len(set(s.parameter("kappa"))) == 5
    assert s.si.max_slip == pytest.approx(s.max_slip * 0.023 * s.parameter("gamma"))
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


def test_a_sweep_read_back_is_the_sweep(tmp_path):
    """In every attribute, for runs that fail, stop early or turn, over a number and a choice."""
    bead, file = fs.Bead(run__periods=8, plate__radius="30 mm"), tmp_path / "sweep.db"
    s = fs.sweep(bead, start__r=[0.9, bead.groups.eps, 1.25], friction__law=["viscous", "coulomb"])
    fs.sweep(bead, start__r=[0.9, bead.groups.eps, 1.25], friction__law=["viscous", "coulomb"], file=file)
    again = fs.read(file)
    names = {name for name in dir(s) if not name.startswith("_") and not callable(getattr(s, name))}
    assert {"regime", "symmetry", "done", "failed", "mean_r", "start__r"} < names | {"start__r"} and len(names) > 60

    def plain(value):
        value = np.asarray(value)
        # A database keeps of an error what happened, not the key beside it.
        return [(type(item), getattr(item, "sentence", "")) for item in value.ravel()] if value.dtype == object else value

    for name in sorted(names - {"axes", "si", "lab"}) + ["start__r", "friction__law"]:
        one, other = plain(getattr(s, name)), plain(getattr(again, name))
        if isinstance(one, list):
            assert one == other
        else:
            np.testing.assert_array_equal(one, other, err_msg=name)
    for one, other in zip(s.axes, again.axes):
        assert one.key == other.key and np.array_equal(one.values, other.values)
    for units in ("si", "lab"):
        for name in fs._tables.RESULTS:
            np.testing.assert_array_equal(getattr(getattr(s, units), name), getattr(getattr(again, units), name))
    for place in zip(*np.nonzero(s.done & ~s.failed)):
        assert s.bead(*place) == again.bead(*place)
        assert s[place].to_dict() == again[place].to_dict() and s[place].reason == again[place].reason


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
    left_out = part[tuple(np.argwhere(~part.computed)[0])]
    assert left_out.status == "missing" and not left_out.complete and "because the sweep was refined" in repr(left_out)


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
