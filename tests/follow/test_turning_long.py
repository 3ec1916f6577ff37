"""How a bead with marks turns, from films whose truth is known: n, W and the slip in each frame, with errors; a bead without
marks, and a wrong diameter.

Without ffmpeg the test is skipped.

tests: follow/turning.c follow/pose.c follow/light.c follow/spin.c follow/rhythm.c follow/patch.c film/marks.c
labels: long"""

import math
import sys
import unittest

import films
from films import run

if not films.can_film():
    sys.exit(77)

# A bead of 30 pixels at 240 frames a second, exposed for 0.5 ms.
CAMERA = ("--size", "640x640", "--plate", "90mm", "--distance", "300mm", "--from", "20", "--exposure",
          "0.5ms", "--readout", "1ms", "--noise", "1", "--quality", "5")
VECTORS = {"n": ("nx", "ny", "nz"), "w": ("wx", "wy", "wz"), "slip": ("slip_x", "slip_y")}


def columns(path):
    """Each vector of a table, row by row."""
    names, rows = films.read(path)
    place = {name.split(" ")[0]: i for i, name in enumerate(names)}
    found = {key: [[row[place[name]] for name in of] for row in rows] for key, of in VECTORS.items()}
    for key in ("n_error", "w_error", "slip_error"):
        found[key] = [row[place[key]] for row in rows] if key in place else None
    return found


def rms(values):
    return math.sqrt(sum(value * value for value in values) / len(values))


class Turning(films.OnFilms):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        done = run("run", "--set", "drive.frequency=10.7Hz", "--set", "run.periods=42", "--set", "run.discard=0", "--set",
                   "run.samples=200", "--csv", cls.folder / "r.csv")
        assert done.returncode == 0, done.stderr

    def turned(self, name, *options, diameter="5mm"):
        """A film with these options, and its track with the turning."""
        facts = films.film(self.folder / "r.csv", self.folder / f"{name}.mp4", *CAMERA, *options)
        corners = next(line for line in facts.splitlines() if line.startswith("marks")).split('"')[1]
        out, done = self.track(self.folder / f"{name}.mp4", "--scale", corners, "--distance", "300mm", "--turning",
                               diameter)
        return out, done.stdout

    def compare(self, marks, n_most, slip_most):
        """n within `n_most` degrees (rms), and |V| within the part `slip_most` of it on the median."""
        out, said = self.turned(marks, "--marks", marks, "--to", "40")
        self.assertIn("turning     n in ", said)
        found, true = columns(out), columns(self.folder / f"{marks}.truth.csv")
        angles, shares, offs, relative = [], {"w": [0, 0], "slip": [0, 0]}, [], []
        for i, (n, m) in enumerate(zip(found["n"], true["n"])):
            if math.isnan(n[0]):
                continue
            angles.append(math.degrees(math.acos(max(-1.0, min(1.0, sum(a * b for a, b in zip(n, m)))))))
        for key, share in shares.items():
            for value, truth, error in zip(found[key], true[key], found[key + "_error"]):
                if not math.isnan(error):
                    share[0] += sum(abs(a - b) < error for a, b in zip(value, truth))
                    share[1] += len(value)
        for value, truth, w in zip(found["slip"], true["slip"], true["w"]):
            speed, size = math.hypot(truth[0] + 2.5 * w[1], truth[1] - 2.5 * w[0]), math.hypot(*truth)
            if not math.isnan(value[0]):
                offs.append(math.hypot(value[0] - truth[0], value[1] - truth[1]) / speed)
                if size > 0.05 * speed:
                    relative.append(abs(math.hypot(*value) / size - 1.0))
        relative.sort()
        print(f"n in {len(angles)} of {len(found['n'])} frames, rms {rms(angles):.2f} degrees; |V| median "
              f"{relative[len(relative) // 2]:.3f}, rms {rms(relative):.3f}; V off by {rms(offs):.4f} v; shares {shares}")
        self.assertGreater(len(angles), 0.95 * len(found["n"]))
        self.assertLess(rms(angles), n_most)
        self.assertGreater(sum(angle < 3.0 for angle in angles), (0.95 if marks == "half" else 0.8) * len(angles))
        self.assertLess(relative[len(relative) // 2], slip_most)
        self.assertLess(rms(relative), 0.12)
        for share in shares.values():
            self.assertGreater(share[0], 0.55 * share[1])
        return shares

    def test_n_w_and_slip(self):
        for share in self.compare("half", 0.7, 0.05).values():
            self.assertLess(share[0], 0.98 * share[1])

    def test_two_dots(self):
        self.compare("dots", 3.0, 0.05)

    def test_a_bead_without_marks(self):
        out, said = self.turned("bare", "--to", "28")
        self.assertIn("no marks that turn with the bead could be followed", said)
        names, rows = films.read(out)
        self.assertIn("slip_error [mm/s]", names)
        self.assertTrue(all(math.isnan(cell) for row in rows for cell in row[4:]))

    def test_what_is_refused(self):
        film = self.folder / "a.mp4"
        self.refused(film, "needs a scale and the distance", "--turning", "5mm")
        self.refused(film, "pixels wide|give its diameter|dark dots", "--turning", "8mm", "--scale", "plate 120mm",
                     "--distance", "180mm")
        self.refused(film, "more than 0", "--turning", "0mm", "--scale", "plate 120mm", "--distance", "180mm")


if __name__ == "__main__":
    unittest.main()
