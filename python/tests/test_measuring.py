"""Tracks, what is measured of them, and fits."""

import math
import pickle
import subprocess

import numpy as np
import pytest

import festoon as fs
from conftest import ask


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


def test_turning(program, bead, tmp_path):
    """What a track has of the bead's turning is read, copied, and judged by a fit, as the program does."""
    lab = bead.run(periods=100, discard=60, trajectory=True, fps=240, sample_from=60).trajectory.lab
    names = "nx,ny,nz,n_error [rad],wx [rad/s],wy [rad/s],wz [rad/s],w_error [rad/s],slip_x [mm/s],slip_y [mm/s],slip_error [mm/s]"
    numbers = [0.6, 0.0, 0.8, 0.01, 1.0, 2.0, 3.0, 0.5, 100.0, -50.0, 200.0]
    noise = np.random.default_rng(1).normal(scale=0.05, size=(2, len(lab.t)))
    lines = ["# rhythm: 3", f"frame,t [s],x [mm],y [mm],{names}"]
    for i, (t, x, y) in enumerate(zip(lab.t, lab.x + noise[0], lab.y + noise[1])):
        known = numbers if i % 5 else [""] * 11
        lines.append(",".join(map(str, [i, t, x, y, *known])))
    path = tmp_path / "turning.csv"
    path.write_text("\n".join(lines) + "\n")
    track = fs.read_track(path)
    known = track.turning[np.arange(len(track)) % 5 > 0]
    assert np.isnan(track.turning["slip"][0]).all() and (known["slip"] == [100.0, -50.0]).all()
    assert (known["n"] == [0.6, 0, 0.8]).all() and (known["w"] == [1, 2, 3]).all() and (known["slip_error"] == 200).all()
    again = pickle.loads(pickle.dumps(track))
    assert track._track.rhythm == again._track.rhythm == 3
    assert again == track and np.array_equal(again.turning["w"], track.turning["w"], equal_nan=True)
    assert fs.read_track(path, scale="2mm").turning["slip"][1].tolist() == [200.0, -100.0]
    assert fs.Track({"t": [0, 1], "x": [0, 1], "y": [0, 1]}, unit="mm").turning is None
    fit = fs.fit(track=track, free=["kappa", "friction.gamma"], drive="10.7 Hz").to_dict()
    theirs = ask(program, "fit", "--track", path, "--free", "model.kappa,friction.gamma", "--drive", "10.7Hz", "--json")
    assert fit["slip_frames"] == theirs["slip_frames"] == len(known) and fit["slip_misfit"] == theirs["slip_misfit"] > 0


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
    assert 0 < fit.kappa_gamma2_error < 0.01 * fit.kappa_gamma2
    assert math.isnan(fs.fit(points, free="magnet.depth", bead=truth).kappa_gamma2)
    assert fit.to_dict() == ask(program, "fit", points, "--free", "model.kappa,friction.gamma", "--json")


def test_tables_in_memory(bead, tmp_path):
    """A data frame, a dictionary and an array are the file with the same numbers, bit by bit."""
    pandas = pytest.importorskip("pandas")
    lab = bead.run(trajectory=True, fps=240, sample_from=20).trajectory.lab
    rows = np.column_stack([lab.t, lab.x, lab.y])
    rows[7, 1:] = np.nan
    frame = pandas.DataFrame(rows, columns=["t [s]", "x [mm]", "y [mm]"])
    frame.to_csv(tmp_path / "track.csv", index=False)
    read = fs.read_track(tmp_path / "track.csv")
    names = np.rec.fromarrays(rows.T, names="t,x,y")
    for data in (rows, frame, dict(frame.items()), names):
        made = fs.Track(data)
        assert made == read and made.flag[7] == 1 and np.array_equal(made.x[:7], rows[:7, 1])
        assert fs.measure(data, drive="10.7 Hz") == fs.measure(tmp_path / "track.csv", drive="10.7 Hz")
    assert fs.Track(rows, unit="cm").length_unit == "cm"
    bare = pandas.DataFrame({"frame": np.arange(len(rows)), "x": rows[:, 1], "y": rows[:, 2]})
    assert fs.Track(bare, unit="mm", fps=240).fps == 240
    measured = fs.measure(rows, drive="10.7 Hz")
    fs.save_points(tmp_path / "points.csv", [measured] * 2)
    fit = fs.fit(tmp_path / "points.csv", free="kappa")
    # As texts, for a number in mm in the file is that in m, to its last digit, and a shift of the point.
    table = pandas.read_csv(tmp_path / "points.csv", comment="#", dtype=str)
    assert fs.fit(table, free="kappa") == fs.fit([measured] * 2, free="kappa") == fit
    assert fs.fit(track=rows, free="kappa", drive="10.7 Hz") == fs.fit(track=read, free="kappa", drive="10.7 Hz")


def test_tables_that_cannot_be_are_refused_where_they_lie():
    rows = np.zeros((9, 2))
    for call, where, words in (
        (lambda: fs.Track(rows), "data", "t, x, y"),
        (lambda: fs.Track({"t [s]": [0.0], "x [kg]": [1.0], "y [kg]": [2.0]}), "data", "kg"),
        (lambda: fs.Track({"t": [0.0, 1.0], "x": [1.0]}), "data", "one length"),
        (lambda: fs.measure(None), "data", "data frame"),
        (lambda: fs.fit(rows, free="kappa"), "points", "names of columns"),
        (lambda: fs.fit({"frequency [Hz]": [9.0], "mean_r [kg]": [17.0]}, free="kappa"), "points", "kg"),
    ):
        with pytest.raises(fs.BadInput, match=words) as caught:
            call()
        assert caught.value.where.split(":")[0] == where and "festoon-" not in str(caught.value)


@pytest.mark.parametrize("rate", [20, -20, 21.3])
def test_places_on_an_exact_circle(rate):
    """Rounding errors are not festoons, from which another rate would seem to follow."""
    t = np.arange(200) / 100
    measured = fs.measure(np.column_stack([t, 20 * np.cos(rate * t), 20 * np.sin(rate * t)]))
    assert abs(measured.bead_frequency_hz - rate / (2 * math.pi)) < 1e-12 and abs(measured.mean_r - 20) < 1e-12
    assert math.isnan(measured.festoons)
