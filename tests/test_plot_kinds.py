"""`festoon plot` of time series, sections, ramps and branches, and `run --csv` in units of the laboratory: the
numbers of the figures are those of their files, axes have units, keys have no empty lines, and bad input is refused
with nothing left behind.

Environment: FESTOON is the program.
"""

import csv
import json
import math
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

FESTOON = os.environ["FESTOON"]
LENGTH, GAMMA, MASS, GRAVITY = 23e-3, 312.5, 0.5e-3, 9.81  # m, 1/s, kg, m/s^2


def run(*words):
    """Run the program: status, standard output, messages."""
    done = subprocess.run([FESTOON, *map(str, words)], capture_output=True, text=True, check=False)
    return done.returncode, done.stdout, done.stderr


def good(*words):
    """Run the program, which must succeed."""
    status, out, messages = run(*words)
    assert status == 0, messages
    return out


def read_csv(path):
    """Columns by name, and their units."""
    with open(path, encoding="utf-8") as file:
        rows = list(csv.reader(line for line in file if not line.startswith("#")))
    names, units = zip(*((word.split(" [")[0], word.split(" [")[1][:-1]) for word in rows[0]))
    return dict(zip(names, zip(*[[float(x) for x in row] for row in rows[1:]]))), dict(zip(names, units))


class Case(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scratch = tempfile.TemporaryDirectory()
        cls.folder = Path(cls.scratch.name)
        short = ("--set", "run.periods=12", "--set", "run.discard=4")
        good("run", *short, "-o", cls.folder / "t.csv")
        good("run", *short, "--ramp", "9:12", "--ramp-wait", "0", "-o", cls.folder / "ramp.csv")
        good("run", *short, "--set", "drive.frequency=2Hz", "--set", "start.spin=rest", "-o", cls.folder / "slow.csv")
        good("branch", "--kind", "locked", "--over", "drive.frequency=4Hz:9Hz", "-o", cls.folder / "locked.json")
        good("branch", "--kind", "counter", "--over", "drive.omega=0.25:0.29", "-o", cls.folder / "counter.json")
        cls.columns, _ = read_csv(cls.folder / "t.csv")

    @classmethod
    def tearDownClass(cls):
        cls.scratch.cleanup()

    def plot(self, name, *words):
        """The texts of the figure in one line, its script, and its blocks of numbers."""
        good("plot", self.folder / name, "-o", self.folder / "f.svg", *words)
        script = (self.folder / "f.gp").read_text(encoding="utf-8")
        blocks = {}
        for text in (self.folder / "f.dat").read_text(encoding="utf-8").split("\n\n\n"):
            block, _, *lines = text.strip("\n").split("\n")
            blocks[block[2:]] = [[float(word) for word in line.split()] for line in lines if line]
        texts = re.findall(r"set label '(.*?)' at ", script)
        self.assertNotIn("", [text.strip() for text in texts])
        self.assertGreater(len(texts), 2)
        return " ".join(texts), script, blocks

    def refused(self, wanted, *words):
        """The command ends with status 2 and a sentence, and leaves no figure."""
        status, out, messages = run(*words, "-o", self.folder / "no.svg")
        self.assertEqual((status, out), (2, ""), messages)
        self.assertIn(wanted, messages)
        self.assertEqual(list(self.folder.glob("*no.*")), [])


class Series(Case):
    def test_time(self):
        """Every sample lies on its curve, in the units of the axes."""
        texts, _, blocks = self.plot("t.csv", "--kind", "time", "--key", "r,load,slip", "--from", "5", "--to", "6")
        for wanted in ("time (s)", "r (mm)", "load (weights of the bead)", "slip of the contact |V| (mm/s)",
                       "(10.7 Hz)"):
            self.assertIn(wanted, texts)
        shown = [i for i, turns in enumerate(self.columns["drive_turns"]) if 5 - 1e-9 <= turns <= 6 + 1e-9]
        speed = 1e3 * LENGTH * GAMMA
        factors = {"r": 1e3 * LENGTH, "load": LENGTH * GAMMA ** 2 / GRAVITY, "slip": speed}
        for panel, (name, factor) in enumerate(factors.items(), 1):
            points = dict((round(x, 8), y) for x, y in blocks[f"panel{panel}-curve1"])
            for i in shown:
                self.assertLess(abs(points[round(float(f"{self.columns['t'][i] / GAMMA:.9g}"), 8)] -
                                    factor * self.columns[name][i]), 1e-6 * factor)
            steps = [abs(b[0] - a[0]) for a, b in zip(blocks[f"panel{panel}-curve1"],
                                                      blocks[f"panel{panel}-curve1"][1:])]
            self.assertLess(max(steps), 2 * min(steps))

    def test_scaled_units(self):
        texts, _, blocks = self.plot("t.csv", "--kind", "time", "--units", "scaled")
        self.assertIn("time (1/γ)", texts)
        self.assertIn("r (ℓ)", texts)
        self.assertAlmostEqual(blocks["panel1-curve1"][-1][1], self.columns["r"][-1], 6)

    def test_section(self):
        """The points of the section lie where Phi passes 90 degrees, to the accuracy of a cubic."""
        _, _, blocks = self.plot("t.csv", "--kind", "section", "--key", "r,Phi", "--units", "scaled")
        points = blocks["panel1-curve1"]
        angle = [phi for turns, phi in zip(self.columns["drive_turns"], self.columns["Phi"]) if turns >= 4]
        passes = sum(math.floor((a - math.pi / 2) / (2 * math.pi)) > math.floor((b - math.pi / 2) / (2 * math.pi))
                     for a, b in zip(angle, angle[1:]))
        self.assertEqual(len(points), passes)
        self.assertGreater(passes, 5)
        for _, phi in points:
            self.assertLess(abs(math.remainder(phi - math.pi / 2, 2 * math.pi)), 1e-6)

    def test_ramp(self):
        texts, _, blocks = self.plot("ramp.csv", "--kind", "ramp")
        self.assertIn("drive frequency (Hz)", texts)
        self.assertIn("mean over whole turns of Φ", texts)
        columns, _ = read_csv(self.folder / "ramp.csv")
        low, high, mean = (blocks[f"panel1-curve{i}"] for i in (1, 2, 3))
        for (x, least), (_, greatest), (_, middle) in zip(low, high, mean):
            self.assertTrue(9 <= x <= 12 and least < middle < greatest)
        radii = [1e3 * LENGTH * r for r in columns["r"]]
        self.assertTrue(min(radii) - 1e-5 <= min(y for _, y in low) and max(y for _, y in high) <= max(radii) + 1e-5)
        self.assertGreater(len(mean), 2)

    def test_what_is_refused(self):
        track = self.folder / "t.csv"
        for wanted, words in (
                ("nearest name is \"slip\"", ["--kind", "time", "--key", "slop"]),
                ("missing", ["--kind", "time", "--key", "r,,n_z"]),
                ("at most 6", ["--kind", "time", "--key", "r,B,slip,n_z,n_x,n_y,x"]),
                ("two columns", ["--kind", "section", "--key", "r"]),
                ("no ramp", ["--kind", "ramp"]),
                ("colour scale", ["--kind", "time", "--colour", "slip"]),
                ("columns of choice", ["--key", "r"]),
                ("nearest is section", ["--kind", "secton"]),
                ("nearest is lab", ["--units", "labs"])):
            self.refused(wanted, "plot", track, *words)
        self.refused("never passes", "plot", self.folder / "slow.csv", "--kind", "section")
        self.refused("nearest is", "field", "--at", "1,1", "--units", "mm")


class Branches(Case):
    def test_words_and_units(self):
        texts, _, blocks = self.plot("locked.json")
        for wanted in ("Locked states over the drive frequency", "drive frequency (Hz)", "mean radius ⟨r⟩ (mm)",
                       "stable", "unstable", "fold"):
            self.assertIn(wanted, texts)
        texts, _, scaled = self.plot("locked.json", "--units", "scaled")
        self.assertIn("drive ω (γ)", texts)
        self.assertIn("mean radius ⟨r⟩ (ℓ)", texts)
        for (x, y), (omega, r) in zip(blocks["panel1-curve1"], scaled["panel1-curve1"]):
            self.assertLess(abs(2 * math.pi * x / GAMMA - omega), 1e-7 * omega)
            self.assertLess(abs(y - 1e3 * LENGTH * r), 1e-6)

    def test_shapes_tell_special_points_apart(self):
        _, script, _ = self.plot("locked.json", "--observable", "slip")
        signs = re.findall(r"'panel1-curve\d+' .* with points ps \S+ lw \S+ pt (\d+) lc rgb '(#\w+)'", script)
        self.assertGreater(len(signs), 1)
        self.assertEqual(len(set(signs)), len(signs))

    def test_no_line_of_the_key_without_a_curve(self):
        """All of this branch is stable: the key does not speak of unstable orbits."""
        good("branch", "--kind", "counter", "--over", "drive.omega=0.3:0.31", "-o", self.folder / "s.json")
        texts, script, _ = self.plot("s.json")
        self.assertNotIn("unstable", texts)
        self.assertEqual(script.count("data index 'key"), 1)

    def test_the_curve_is_smooth_and_passes_the_points(self):
        """Between its points the curve is closer to a branch of many points than straight pieces are."""
        over = ("--over", "drive.omega=0.3:0.5")
        good("branch", "--kind", "counter", *over, "--step", "0.1", "-o", self.folder / "few.json")
        good("branch", "--kind", "counter", *over, "--step", "0.002", "-o", self.folder / "many.json")
        with open(self.folder / "few.json", encoding="utf-8") as file:
            few = sorted((p["value"], p["mean_r"]) for p in json.load(file)["points"])
        _, _, blocks = self.plot("few.json")
        drawn = sorted(map(tuple, blocks["panel1-curve1"]))
        for value, r in few:
            self.assertLess(min(abs(x - value) + abs(y - r) for x, y in drawn), 1e-6)
        with open(self.folder / "many.json", encoding="utf-8") as file:
            truth = sorted((p["value"], p["mean_r"]) for p in json.load(file)["points"])

        def worst(curve):
            greatest = 0.0
            for value, r in truth:
                after = next((i for i, (x, _) in enumerate(curve) if x >= value), 0)
                if after:
                    (x0, y0), (x1, y1) = curve[after - 1], curve[after]
                    greatest = max(greatest, abs(y0 + (y1 - y0) * (value - x0) / max(x1 - x0, 1e-12) - r))
            return greatest

        self.assertLess(worst(drawn), 0.25 * worst(few))

    def test_an_observable_that_is_not_there(self):
        for name, observable in (("locked.json", "festoons"), ("counter.json", "slip"), ("counter.json", "second")):
            self.refused("has a value of " + observable, "plot", self.folder / name, "--observable", observable)

    def test_scales_that_are_not_known(self):
        with open(self.folder / "counter.json", encoding="utf-8") as file:
            document = json.load(file)
        del document["scene"]
        (self.folder / "bare.json").write_text(json.dumps(document), encoding="utf-8")
        self.refused("has no scene", "plot", self.folder / "bare.json", "--units", "lab")
        self.assertIn("mean radius ⟨r⟩ (ℓ)", self.plot("bare.json")[0])


class LaboratoryFiles(Case):
    def test_a_cameras_samples(self):
        """Rows are 1/240 s apart, and their numbers are those of the run in other units."""
        good("run", "--set", "run.periods=6", "--set", "run.discard=2", "--csv", self.folder / "lab.csv", "--units", "lab",
             "--fps", "240", "-o", self.folder / "scaled.csv")
        lab, units = read_csv(self.folder / "lab.csv")
        self.assertEqual([units[name] for name in ("t", "x", "vx", "w_z", "load", "energy", "drive_power", "n_x", "Phi")],
                         ["s", "mm", "mm/s", "rad/s", "mN", "uJ", "mW", "1", "rad"])
        with open(self.folder / "scaled.csv", encoding="utf-8") as file:
            scaled_text = file.read()
        self.assertIn("# festoon trajectory\n", scaled_text[:40])
        for i, t in enumerate(lab["t"]):
            self.assertAlmostEqual(t, i / 240, 12)
        self.assertEqual(len(lab["t"]), 1 + math.floor(6 / 10.7 * 240))

    def test_the_units(self):
        """A file in scaled units beside it holds the same numbers; velocities are the slopes of positions."""
        good("run", "--set", "run.periods=4", "--set", "run.discard=2", "--csv", self.folder / "a.csv", "--units", "lab",
             "--fps", "2000")
        good("run", "--set", "run.periods=4", "--set", "run.discard=2", "--csv", self.folder / "b.csv", "--fps", "2000")
        lab, _ = read_csv(self.folder / "a.csv")
        scaled, _ = read_csv(self.folder / "b.csv")
        factors = {"t": 1 / GAMMA, "x": 1e3 * LENGTH, "vy": 1e3 * LENGTH * GAMMA, "omega": GAMMA,
                   "load": 1e3 * MASS * LENGTH * GAMMA ** 2, "energy": 1e6 * MASS * (LENGTH * GAMMA) ** 2,
                   "friction_power": 1e3 * MASS * LENGTH ** 2 * GAMMA ** 3, "n_z": 1, "alpha": 1}
        for name, factor in factors.items():
            for one, other in zip(lab[name], scaled[name]):
                self.assertLess(abs(one - factor * other), 1e-12 * (1 + abs(one)))
        for i in range(1, len(lab["t"]) - 1):
            slope = (lab["x"][i + 1] - lab["x"][i - 1]) / (lab["t"][i + 1] - lab["t"][i - 1])
            self.assertLess(abs(slope - lab["vx"][i]), 0.02 * max(map(abs, lab["vx"])))

    def test_what_is_refused(self):
        path = self.folder / "c.csv"
        for wanted, words in (("--csv", ["--fps", "3"]), ("nearest is lab", ["--units", "labs"]),
                              ("0.01", ["--csv", path, "--fps", "0"]), ("number", ["--csv", path, "--fps", "x"]),
                              ("nearest is si", ["--csv", path, "--units", "SI"])):
            status, _, messages = run("run", "--set", "run.periods=3", "--set", "run.discard=1", *words)
            self.assertEqual(status, 2, messages)
            self.assertIn(wanted, messages)
        self.assertFalse(path.exists())
        good("run", "--set", "run.periods=3", "--set", "run.discard=1", "--csv", path, "--units", "si")
        self.assertEqual(read_csv(path)[1]["x"], "m")
        self.refused("for other programs", "plot", path)


if __name__ == "__main__":
    if not shutil.which("gnuplot"):
        print("skipped: no gnuplot (gnuplot-nox)")
        sys.exit(77)
    unittest.main()
