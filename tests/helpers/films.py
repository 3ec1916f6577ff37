"""Films of a bead and their truth, made by `festoon movie --camera`, and tracks compared with it."""

import csv
import math
import os
import subprocess
import tempfile
import unittest
from pathlib import Path

FESTOON = os.environ["FESTOON"]


def run(*words, **more):
    """Run the program."""
    return subprocess.run([FESTOON, *map(str, words)], capture_output=True, text=True, stdin=subprocess.DEVNULL,
                          check=False, **more)


def can_film():
    """Whether ffmpeg and ffprobe are there."""
    for name in ("ffmpeg", "ffprobe"):
        try:
            subprocess.run([name, "-version"], capture_output=True, check=True)
        except (OSError, subprocess.CalledProcessError):
            return False
    return True


def ffmpeg(*words):
    """Run ffmpeg, over any file that is there."""
    subprocess.run(["ffmpeg", "-v", "error", "-nostdin", "-y", *map(str, words)], check=True, stdin=subprocess.DEVNULL)


def trajectory(path, periods=16, frequency="10.7Hz"):
    """The bead of the default scene, after it has settled."""
    done = run("run", "--set", f"run.periods={periods}", "--set", "run.discard=0", "--set", "run.samples=64", "--set",
               f"drive.frequency={frequency}", "--csv", path)
    assert done.returncode == 0, done.stderr


def film(trajectory_file, path, *options):
    """A film by a camera; returns what was printed of it."""
    done = run("movie", trajectory_file, "-o", path, "--camera", *options)
    assert done.returncode == 0, done.stderr
    return done.stdout


def read(path):
    """Names of columns, and rows with NAN for empty cells, without comments."""
    with open(path, newline="", encoding="utf-8") as file:
        rows = list(csv.reader(line for line in file if not line.startswith("#")))
    return rows[0], [[float(cell) if cell else math.nan for cell in row] for row in rows[1:]]


def compare(track, truth):
    """How far a track in px or mm is from the truth: rms of a coordinate about their mean offset; how many frames were
    lost; the ratio of their mean distances from the middle."""
    names, rows = read(track)
    _, true = read(truth)
    first = 2 if names[2] == "x [mm]" else 4
    pairs = [(r[2], r[3], t[first], t[first + 1]) for r, t in zip(rows, true) if not math.isnan(r[2])]
    means = [sum(pair[i] for pair in pairs) / len(pairs) for i in range(4)]
    off = [(a - means[0] - c + means[2], b - means[1] - d + means[3]) for a, b, c, d in pairs]
    rms = math.sqrt(sum(x * x + y * y for x, y in off) / (2 * len(off)))
    mean = [sum(math.hypot(p[i] - means[i], p[i + 1] - means[i + 1]) for p in pairs) for i in (0, 2)]
    return {"rms": rms, "lost": len(rows) - len(pairs), "rows": len(rows), "true_rows": len(true),
            "ratio": mean[0] / mean[1], "offset": math.hypot(means[0] - means[2], means[1] - means[3])}


SMALL = ("--size", "320x240", "--tilt", "10deg", "--readout", "0ms", "--seed", "7")


class OnFilms(unittest.TestCase):
    """Tests on a short film, a.mp4, in a folder of their own."""

    @classmethod
    def setUpClass(cls):
        cls.scratch = tempfile.TemporaryDirectory()
        cls.folder = Path(cls.scratch.name)
        cls.path = cls.folder / "t.csv"
        trajectory(cls.path)
        cls.facts = film(cls.path, cls.folder / "a.mp4", *SMALL, "--to", "2.7")

    @classmethod
    def tearDownClass(cls):
        cls.scratch.cleanup()

    def track(self, film, *options):
        out = self.folder / "out.csv"
        out.unlink(missing_ok=True)
        done = run("track", film, "-o", out, *options)
        self.assertEqual(done.returncode, 0, done.stderr)
        return out, done

    def refused(self, film, words, *options, status=2):
        """The sentence has these words, and nothing is left behind."""
        before = set(os.listdir(self.folder))
        done = run("track", film, "-o", self.folder / "no.csv", *options)
        self.assertEqual(done.returncode, status, done.stderr)
        for word in words.split("|"):
            self.assertIn(word, done.stderr)
        self.assertEqual(set(os.listdir(self.folder)), before)
