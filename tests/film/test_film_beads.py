"""Films of several beads and of worlds: every bead is where its trajectory has it, in its colour; one bead as a list of
one keeps its film; what cannot be filmed is refused in words.

tests: film/cast.c film/layout.c film/cairo_module.c film/cairo_words.c film/camera.c io/bead_table.c cli/movie.c"""

import math
import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

from pictures import read_png, rows_of

FESTOON, SOURCE = os.environ["FESTOON"], Path(os.environ["SOURCE_DIR"])
SIZE, LENGTH, RADIUS = 240, 23.0, 2.5  # pixels; mm
COLOURS = ((0, 158, 115), (204, 121, 167), (153, 153, 51))  # of beads 1, 2 and 3, as in figures
THREE = """
drive: {frequency: 30 Hz}
start: {spin: rest}
beads:
  - {start.phi: 3 deg}
  - {start.phi: 120 deg, bead.radius: 2 mm}
  - {start.phi: 240 deg, start.r: 1.1}
run: {periods: 4, discard: 1}
"""


def run(*words):
    return subprocess.run([FESTOON, *map(str, words)], capture_output=True, text=True, check=False)


if "cairo yes" not in run("--version").stdout:
    sys.exit(77)


def place_of(row, bead):
    """X, Y and Z of a bead in mm, on the axes of the laboratory."""
    x, y, z = (LENGTH * row[f"{name}_{bead}"] for name in "XYZ")
    angle = 2 * math.pi * row["drive_turns"]
    return x * math.cos(angle) - y * math.sin(angle), x * math.sin(angle) + y * math.cos(angle), z


def of_colour(pixels, colour, x, y, radius):
    """The share of a circle, in pixels, that has a colour."""
    hits = 0
    for step in range(72):
        px, py = x + radius * math.cos(step / 72 * 6.2832), y + radius * math.sin(step / 72 * 6.2832)
        around = [pixels[round(py) + dy][round(px) + dx] for dy in (-1, 0, 1) for dx in (-1, 0, 1)]
        hits += min(math.dist(pixel, colour) for pixel in around) < 60
    return hits / 72


class Films(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = Path(scratch.name)

    def good(self, *words):
        done = run(*words)
        self.assertEqual(done.returncode, 0, done.stderr)

    def trajectory(self, scene, *more):
        out = self.folder / "t.csv"
        if "\n" in str(scene):
            (self.folder / "scene.yaml").write_text(scene)
            scene = self.folder / "scene.yaml"
        self.good("run", scene, "--csv", out, *more)
        return out

    def frames(self, track, *options, name="frames"):
        self.good("movie", track, "-o", self.folder / name, "--size", f"{SIZE}x{SIZE}", *options)
        return sorted((self.folder / name).iterdir())

    def test_every_bead_is_at_its_place_in_its_colour(self):
        """The first frame of a film has no trail: the colour of a bead is its rim's alone."""
        track = self.trajectory(THREE)
        rows = rows_of(track)
        for turns in (0.5, 2.25):
            shown = [row for row in rows if turns - 1e-9 <= row["drive_turns"] <= 3 + 1e-9]
            reach = 1.25 * max(max(map(abs, place_of(row, i)[:2])) for row in shown for i in range(3))
            scale = 0.84 * SIZE / 2 / max(reach, 1.35 * LENGTH, 1.05 * math.hypot(28, 20))
            pixels = read_png(self.frames(track, "--from", turns, "--to", "3", "--fps", "1")[0])[2]
            for i, colour in enumerate(COLOURS):
                x, y, _ = place_of(shown[0], i)
                column, row, radius = SIZE / 2 + scale * x, SIZE / 2 - scale * y, scale * (2 if i == 1 else RADIUS)
                self.assertGreater(of_colour(pixels, colour, column, row, radius), 0.9, (turns, i))
                for off in ((4, 0), (-4, 0), (0, 4), (0, -4)):
                    self.assertLess(of_colour(pixels, colour, column + off[0], row + off[1], radius), 0.8, (turns, i))

    def test_beads_count_from_one(self):
        """In the middle of the first disc of the key stands the stem of a 1, where a 0 is open."""
        self.good("movie", self.trajectory(THREE), "-o", self.folder / "large", "--size", "960x960", "--from", "2.9", "--to",
                  "3", "--fps", "1")
        pixels, size = read_png(sorted((self.folder / "large").iterdir())[0])[2], 0.024 * 960
        column, row = round(960 - 24 - 1.5 * size * 3 + 0.75 * size), round(16 + 0.7 * size)
        self.assertLess(math.dist(pixels[row + round(0.5 * size)][column], COLOURS[0]), 60)  # below the figure
        self.assertLess(min(math.dist(pixel, (255, 255, 255)) for pixel in pixels[row][column - 1:column + 3]), 60)

    def test_a_list_of_one_keeps_its_film(self):
        films = []
        for beads in ("", "beads:\n  - {start.phi: 3 deg}\n"):
            track = self.trajectory(f"run: {{periods: 2, discard: 1}}\n{beads}")
            films.append([frame.read_bytes() for frame in self.frames(track, "--fps", "2", name=f"{len(films)}")])
        self.assertEqual(len(films[0]), 5)
        self.assertEqual(films[0], films[1])

    def test_a_floating_bead_is_seen_from_the_front(self):
        """The rotor is at the top, because gravity points along z, and the floater hangs below it."""
        track = self.trajectory(SOURCE / "examples/worlds/levitation.yaml", "--set", "run.duration=0.02")
        rows, radius, rotor = rows_of(track), 6.35, 9.5
        places = [place_of(row, 0) for row in rows]
        low, high = -rotor, max(z for _, _, z in places) + radius
        across = max(1.05 * rotor, max(max(abs(x), abs(y)) for x, y, _ in places) + radius)
        scale = 0.84 * SIZE / 2 / max(1.15 * across, 0.6 * (high - low))
        frames = self.frames(track, "--fps", "1", "--to", "4")
        row = min(rows, key=lambda r: abs(r["drive_turns"] - 3))
        x, _, z = place_of(row, 0)
        pixels = read_png(frames[3])[2]
        column, down = SIZE / 2 - scale * x, SIZE / 2 + scale * (z - (low + high) / 2)
        dark = (50, 50, 50)
        self.assertGreater(of_colour(pixels, dark, column, down, scale * radius), 0.9)
        self.assertLess(of_colour(pixels, dark, column, down + 4, scale * radius), 0.7)

    def test_the_picture_follows_a_bead_on_a_wave(self):
        track = self.trajectory(SOURCE / "examples/worlds/wave.yaml", "--set", "run.duration=5")
        frames = self.frames(track, "--fps", "1", "--to", "8")
        self.assertEqual(len(frames), 9)  # by the periods of the wave, for nothing turns
        self.assertLess(rows_of(track)[-1]["X_0"] * LENGTH, -150)
        scale = 0.84 * SIZE / 2 / 45  # three quarters of the wave's length
        pixels = read_png(frames[8])[2]
        for off, least, most in ((0.6, 0.6, 1.0), (1.8, 0.0, 0.1)):  # in radii: grey on the bead, the field beside it
            share = of_colour(pixels, (130, 130, 135), SIZE / 2, SIZE / 2, off * scale * RADIUS)
            self.assertTrue(least <= share <= most, (off, share))

    def test_worlds_have_films(self):
        for world in ("bowl", "coils", "water", "compass"):
            length = "run.duration=0.5" if world == "coils" else "run.periods=2"
            track = self.trajectory(SOURCE / f"examples/worlds/{world}.yaml", "--set", length)
            self.assertGreater(len(self.frames(track, "--fps", "1", name=world)), 1)

    def test_a_camera_sees_every_bead(self):
        """The centre of what is dark about the pixel that the truth tells."""
        track = self.trajectory(THREE)
        self.good("movie", track, "-o", self.folder / "film", "--camera", "--noise", "0", "--fps", "30", "--size",
                  "320x240")
        truth = (self.folder / "film.truth.csv").read_text().splitlines()
        self.assertEqual(truth[0], "frame,t [s]" + "".join(
            f",x_{i} [mm],y_{i} [mm],u_{i} [px],v_{i} [px]" for i in range(3)))
        for line in truth[1:]:
            numbers = list(map(float, line.split(",")))
            data = (self.folder / "film" / f"frame-{int(numbers[0]) + 1:05}.pgm").read_bytes()[-320 * 240:]
            for i in range(3):
                u, v = numbers[4 + 4 * i], 239 - numbers[5 + 4 * i]
                near = [(c, r) for r in range(round(v) - 9, round(v) + 10) for c in range(round(u) - 9, round(u) + 10)
                        if math.hypot(c - u, r - v) < 9 and data[320 * r + c] < 110]
                self.assertGreater(len(near), 20)
                self.assertAlmostEqual(sum(c for c, _ in near) / len(near), u, delta=1)
                self.assertAlmostEqual(sum(r for _, r in near) / len(near), v, delta=1)

    def test_what_cannot_be_is_refused(self):
        three = self.trajectory(THREE)
        done = run("movie", three, "-o", self.folder / "no.mp4", "--quantity", "slip")
        self.assertEqual(done.returncode, 2)
        self.assertIn("the colours of their beads", done.stderr)
        floating = self.trajectory(SOURCE / "examples/worlds/levitation.yaml", "--set", "run.duration=0.02")
        for options, words in ((["--camera"], "plate.shape is none"), (["--quantity", "B"], "needs the field"),
                               (["--from", "90"], "covers the drive periods 0 to 4")):
            done = run("movie", floating, "-o", self.folder / "no.mp4", *options)
            self.assertEqual(done.returncode, 2, (options, done.stderr))
            self.assertIn(words, done.stderr)
        self.assertFalse((self.folder / "no.mp4").exists())


if __name__ == "__main__":
    unittest.main()
