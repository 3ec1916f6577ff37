"""The program's figures and films through the library."""

import base64
import re
import struct
import subprocess

import numpy as np
import pytest

import festoon as fs

TURNING = {"run__periods": 40, "run__discard": 20}


@pytest.fixture(scope="module")
def samples():
    return fs.Bead(**TURNING).run(trajectory=True).trajectory


def needs(word):
    if f"{word} yes" not in fs.components:
        pytest.skip(f"there is no {word}")


@pytest.mark.parametrize("kind", ["path", "local-n", "radius-field", "time", "section"])
def test_figure_of_a_trajectory(samples, kind, tmp_path, program):
    """The data of the figure are those of the program's."""
    needs("gnuplot")
    samples.figure(tmp_path / "ours.svg", kind=kind)
    words = ["--set", "run.periods=40", "--set", "run.discard=20"]
    subprocess.run([program, "run", *words, "-o", tmp_path / "run.h5"], check=True, capture_output=True)
    subprocess.run([program, "plot", tmp_path / "run.h5", "--kind", kind, "-o", tmp_path / "theirs.svg"],
                   check=True, capture_output=True)
    assert (tmp_path / "ours.dat").read_bytes() == (tmp_path / "theirs.dat").read_bytes()
    assert b"<svg" in (tmp_path / "ours.svg").read_bytes()


def test_options_of_figures(samples, tmp_path):
    needs("gnuplot")
    samples.figure(tmp_path / "path.png", colour="n_z", begin=25, end=30, title="one", zoom=[-30, 30, -30, 30])
    samples.figure(tmp_path / "time.svg", kind="time", keys=["r", "n_z"], units="lab")
    for kind, options, words in (
        ("path", {"color": "r"}, "unknown option"),
        ("pfad", {}, "unknown kind"),
        ("time", {"keys": ["rr"]}, "rr"),
    ):
        with pytest.raises(fs.BadInput, match=words):
            samples.figure(tmp_path / "none.svg", kind=kind, **options)
    assert not (tmp_path / "none.svg").exists()


def test_figures_of_branches_fields_and_sweeps(tmp_path):
    needs("gnuplot")
    branch = fs.Bead().branch(omega=(0.24, 0.28))
    branch.figure(tmp_path / "branch.svg", "festoons")
    fs.Bead().figure(tmp_path / "field.svg")
    fs.sweep(fs.Bead(run__periods=20), frequency="9:11:5", file=tmp_path / "sweep.db")
    fs.figures.sweep(tmp_path / "sweep.db", tmp_path / "sweep.svg", ["mean_r"])
    fs.figures.over([tmp_path / "sweep.db"] * 2, tmp_path / "over.svg", keys=["mean_r"], units="lab")
    for name in ("branch", "field", "sweep", "over"):
        assert b"</svg>" in (tmp_path / f"{name}.svg").read_bytes()


def test_movie(tmp_path):
    needs("cairo")
    fs.Bead(run__discard=5).movie(tmp_path / "frames", periods=1, width=200, height=200, fps=10)
    frames = sorted((tmp_path / "frames").glob("*.png"))
    assert len(frames) >= 10
    assert struct.unpack(">II", frames[0].read_bytes()[16:24]) == (200, 200)
    with pytest.raises(fs.BadInput):
        fs.Bead().movie(tmp_path / "odd.mp4", periods=1, width=201)


def test_movie_of_two_beads(program, tmp_path):
    """Frame by frame the film that the program makes of the file."""
    needs("cairo")
    pair = fs.Beads(beads=[{"start__phi": 3}, {"start__phi": 53}], frequency="30 Hz", run__periods=2, run__discard=1, run__samples=64)
    pair.save(tmp_path / "pair.yaml")
    subprocess.run([program, "run", tmp_path / "pair.yaml", "-o", tmp_path / "t.h5"], check=True, capture_output=True)
    words = ["--size", "200x200", "--fps", "10"]
    subprocess.run([program, "movie", tmp_path / "t.h5", "-o", tmp_path / "theirs", *words], check=True, capture_output=True)
    pair.run(trajectory=True).trajectory.movie(tmp_path / "ours", width=200, height=200, fps=10)
    ours, theirs = (sorted((tmp_path / name).glob("*.png")) for name in ("ours", "theirs"))
    assert len(ours) == len(theirs) > 5
    assert [frame.read_bytes() for frame in ours] == [frame.read_bytes() for frame in theirs]


def test_animation_in_a_notebook(samples, tmp_path):
    """The film that movie() makes, in the page itself."""
    needs("cairo")
    needs("ffmpeg")
    options = {"width": 200, "height": 200, "fps": 10, "begin": 20, "end": 22}
    shown = samples.animate(**options)
    samples.movie(tmp_path / "film.mp4", **options)
    shown.save(tmp_path / "same.mp4")
    assert (tmp_path / "same.mp4").read_bytes() == (tmp_path / "film.mp4").read_bytes()[: len(shown.film)] and len(shown.film) > 1000
    words = re.fullmatch(r'<video controls loop width="200" src="data:video/mp4;base64,([A-Za-z0-9+/=]+)"></video>', shown._repr_html_())
    assert words and base64.b64decode(words[1]) == shown.film and shown.film[4:8] == b"ftyp"
    with pytest.raises(fs.BadInput):
        samples.animate(width=201)


def test_film_and_track(samples, tmp_path):
    """A camera's film of a run, tracked, gives the run's places."""
    needs("cairo")
    needs("ffmpeg")
    facts = samples.film(tmp_path / "film.mp4", truth=tmp_path / "truth.csv", begin=20, end=26, width=640, height=360)
    assert facts["frames"] > 50 and (tmp_path / "truth.csv").exists()
    track = fs.track(tmp_path / "film.mp4", scale="bead 5 mm", csv=tmp_path / "track.csv")
    assert track.report["frames"] == facts["frames"] == len(track) and track.report["lost"] == 0
    r = np.hypot(track.x - track.x.mean(), track.y - track.y.mean())
    assert 0 < r.max() < 60 and track.length_unit == "mm"
    assert np.allclose(fs.read_track(tmp_path / "track.csv").x, track.x, atol=1e-3)


def test_tracks_of_two_beads(program, tmp_path):
    """A list of tracks, each that of the file which the program writes of the same film."""
    needs("ffmpeg")
    pair = fs.Beads(beads=[{"start__phi": 3}, {"start__phi": 183}], run__periods=8, run__discard=2, run__samples=64)
    pair.save(tmp_path / "pair.yaml")
    for words in (("run", "pair.yaml", "-o", "pair.h5"), ("movie", "pair.h5", "-o", "pair.mp4", "--camera", "--size", "320x240"),
                  ("track", "pair.mp4", "-o", "pair.csv", "--beads", "2")):
        subprocess.run([program, *words], cwd=tmp_path, check=True, capture_output=True)
    seen = fs.track(tmp_path / "pair.mp4", beads=2)
    assert len(seen) == 2 and seen[0].report["beads"] == 2 and seen[0].report["doubts"] == []
    for name, one in zip("12", seen):
        read = fs.read_track(tmp_path / "pair.csv", name=name)
        assert np.allclose(read.x, one.x) and np.array_equal(read.doubts, one.doubts) and len(one) > 100
    with pytest.raises(fs.BadInput, match="1 to 4"):
        fs.track(tmp_path / "pair.mp4", beads=5)


def test_notebook_bar(monkeypatch):
    """In a kernel the bar is HTML, and is gone at the end."""
    display = pytest.importorskip("IPython.display")
    shown = []

    class Handle:
        def update(self, html):
            shown.append(html.data)

    def show(html, display_id):
        shown.append(html.data)
        return Handle()

    monkeypatch.setattr(display, "display", show)
    monkeypatch.setattr("festoon._progress.in_notebook", lambda: True)
    fs.Bead(run__periods=3000).run(progress=True)
    assert shown[0].startswith("<progress") and shown[-1] == ""


def test_terminal_bar():
    """On a terminal a line with the time that is left, removed at the end."""
    import os
    import pty
    import sys

    from conftest import BUILD

    leader, follower = pty.openpty()
    code = "import festoon as fs; fs.sweep(fs.Bead(), frequency='9:12:200', progress=True)"
    child = subprocess.Popen([sys.executable, "-B", "-c", code], stderr=follower,
                             env={**os.environ, "PYTHONPATH": str(BUILD / "python")})
    os.close(follower)
    said = b""
    try:
        while data := os.read(leader, 4096):
            said += data
    except OSError:  # the other end is closed
        pass
    assert child.wait() == 0
    os.close(leader)
    assert b"of 200 runs [" in said and b" left" in said and said.endswith(b"\r\x1b[K")


