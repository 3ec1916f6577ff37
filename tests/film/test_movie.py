"""`festoon movie`: frames show the trajectory, films are whole or not at all, and failures say what to do.

tests: film/film.c io/ffmpeg.c cli/movie.c"""

import math
import os
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

from pictures import read_png, rows_of

FESTOON = os.environ["FESTOON"]


def run(*arguments, **more):
    return subprocess.run([FESTOON, *map(str, arguments)], capture_output=True, text=True,
                          stdin=subprocess.DEVNULL, **more)


if "cairo yes" not in run("--version").stdout:
    sys.exit(77)


class Movie(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scratch = tempfile.TemporaryDirectory()
        cls.folder = Path(cls.scratch.name)
        cls.track = cls.folder / "track.csv"
        done = run("run", "--set", "run.periods=4", "--set", "run.discard=2", "--csv", cls.track)
        assert done.returncode == 0, done.stderr

    @classmethod
    def tearDownClass(cls):
        cls.scratch.cleanup()

    def frames(self, name, *options):
        out = self.folder / name
        done = run("movie", self.track, "-o", out, *options)
        self.assertEqual(done.returncode, 0, done.stderr)
        return sorted(out.iterdir())

    def test_as_many_frames_as_asked(self):
        frames = self.frames("count", "--from", "1", "--to", "3", "--fps", "5", "--turn", "2", "--size", "200x180")
        self.assertEqual([f.name for f in frames], [f"frame-{i:05}.png" for i in range(1, 22)])
        self.assertEqual(read_png(frames[0])[:2], (200, 180))

    def test_an_earlier_film_leaves_no_frames(self):
        """A shorter film in the same folder replaces all frames of the longer one; other files stay."""
        self.frames("again", "--to", "2", "--fps", "3", "--size", "200x200")
        (self.folder / "again" / "notes.txt").write_text("kept")
        self.frames("again", "--to", "1", "--fps", "3", "--size", "200x200")
        self.assertEqual(sorted(path.name for path in (self.folder / "again").iterdir()),
                         [*(f"frame-{i:05}.png" for i in range(1, 5)), "notes.txt"])

    def test_the_bead_is_where_the_trajectory_has_it(self):
        """The centre of the ball's outline, searched around the place that the file gives."""
        rows = rows_of(self.track)
        shown = [row for row in rows if row["drive_turns"] <= 4.0 + 1e-9]
        reach = max(1.25 * max(max(abs(r["x"]), abs(r["y"])) for r in shown), 1.35) * 23.0
        reach = max(reach, 1.05 * math.hypot(28.0, 20.0))  # room for the bar as it turns
        frames = self.frames("place", "--to", "4", "--fps", "1", "--size", "480x480")
        for turn in (2, 3):
            row = min(rows, key=lambda r: abs(r["drive_turns"] - turn))
            scale = 0.84 * 240 / reach  # pixels a millimetre: the plate leaves a margin for the text around it
            x, y = (240 + s * row[k] * 23.0 * scale for s, k in ((1, "x"), (-1, "y")))
            pixels, radius = read_png(frames[turn])[2], 2.5 * scale
            dark = 0
            for step in range(72):  # the outline is dark all round
                px, py = x + radius * math.cos(step / 72 * 6.2832), y + radius * math.sin(step / 72 * 6.2832)
                around = [sum(pixels[round(py) + dy][round(px) + dx]) for dy in (-1, 0, 1) for dx in (-1, 0, 1)]
                dark += min(around) < 420
            self.assertGreater(dark, 60)

    def test_the_same_frames_again(self):
        first = self.frames("one", "--to", "2", "--fps", "2", "--size", "200x200")
        second = self.frames("two", "--to", "2", "--fps", "2", "--size", "200x200")
        self.assertEqual([f.read_bytes() for f in first], [f.read_bytes() for f in second])

    def test_films(self):
        if shutil.which("ffmpeg") is None:
            self.skipTest("no ffmpeg")
        for name, magic in (("a.mp4", b"ftyp"), ("a.gif", b"GIF89a")):
            out = self.folder / name
            done = run("movie", self.track, "-o", out, "--to", "1", "--fps", "5", "--size", "200x200")
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertIn(magic, out.read_bytes()[:12])
        self.assertFalse([p for p in self.folder.iterdir() if "tmp" in p.name])
        shown = subprocess.run(["ffprobe", "-v", "error", "-count_frames", "-show_entries",
                                "stream=width,height,nb_read_frames,pix_fmt", "-of", "csv=p=0",
                                str(self.folder / "a.mp4")], capture_output=True, text=True)
        self.assertEqual(shown.stdout.strip(), "200,200,yuv420p,6")

    def test_without_ffmpeg_nothing_is_painted(self):
        """A film of many frames is refused before the first, and leaves nothing."""
        out = self.folder / "kept.mp4"
        there = sorted(self.folder.iterdir())
        done = run("movie", self.track, "-o", out, "--to", "1", "--fps", "2", "--size", "200x200",
                   env={**os.environ, "PATH": "/nowhere"})
        self.assertEqual(done.returncode, 1)
        self.assertIn("install the package ffmpeg", done.stderr)
        self.assertIn("or name a folder", done.stderr)
        self.assertEqual(sorted(self.folder.iterdir()), there)

    def test_what_cannot_be_is_refused(self):
        for options, words in ((["--size", "201x200"], "even"), (["--size", "big"], "720x720"),
                               (["--fps", "0"], "frames a second"), (["--quantity", "slipp"], "slip"),
                               (["--from", "90"], "no samples"), (["--from", "3", "--to", "2"], "greater")):
            done = run("movie", self.track, "-o", self.folder / "no.mp4", *options)
            self.assertEqual(done.returncode, 2, (options, done.stderr))
            self.assertIn(words, done.stderr)
        done = run("movie", self.track, "-o", self.folder / "no.avi")
        self.assertEqual(done.returncode, 2)
        self.assertIn(".mp4", done.stderr)
        self.assertFalse((self.folder / "no.mp4").exists())


if __name__ == "__main__":
    unittest.main()
