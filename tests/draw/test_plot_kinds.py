"""`festoon plot` of time series, sections, ramps and branches, and `run --csv` in units of the laboratory: the
numbers of the figures are those of their files, axes have units, keys have no empty lines, and bad input is refused
with nothing left behind.

tests: draw/path.c draw/field_map.c draw/figure_series.c draw/smooth.c cli/plot.c
labels: slow"""

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


SCRATCH = tempfile.TemporaryDirectory()


def tearDownModule():
    SCRATCH.cleanup()


class Case(unittest.TestCase):
    folder = Path(SCRATCH.name)

    @classmethod
    def setUpClass(cls):
        """What the figures are drawn of, made once for all."""
        if (cls.folder / "t.csv").exists():
            return
        short = ("--set", "run.periods=12", "--set", "run.discard=4")
        good("run", *short, "-o", cls.folder / "t.csv")
        good("run", *short, "--ramp", "9:12", "--ramp-wait", "0", "-o", cls.folder / "ramp.csv")
        good("run", *short, "--set", "drive.frequency=2Hz", "--set", "start.spin=rest", "-o", cls.folder / "slow.csv")
        good("branch", "--kind", "locked", "--over", "drive.frequency=4Hz:9Hz", "-o", cls.folder / "locked.json")
        good("branch", "--kind", "counter", "--over", "drive.omega=0.25:0.29", "-o", cls.folder / "counter.json")
        Case.columns, _ = read_csv(cls.folder / "t.csv")

    def plot(self, name, *words):
        """The texts of the figure in one line, its script, and its blocks of numbers."""
        good("plot", "--quiet", self.folder / name, "-o", self.folder / "f.svg", *words)
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
        texts, _, blocks = self.plot("t.csv", "--kind", "time", "--quantity", "r,load,slip", "--from", "5", "--to", "6")
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
        _, _, blocks = self.plot("t.csv", "--kind", "section", "--quantity", "r,Phi", "--units", "scaled")
        points = blocks["panel1-curve1"]
        angle = [phi for turns, phi in zip(self.columns["drive_turns"], self.columns["Phi"]) if turns >= 4]
        passes = sum(math.floor((a - math.pi / 2) / (2 * math.pi)) > math.floor((b - math.pi / 2) / (2 * math.pi))
                     for a, b in zip(angle, angle[1:]))
        self.assertEqual(len(points), passes)
        self.assertGreater(passes, 5)
        for _, phi in points:
            self.assertLess(abs(math.remainder(phi - math.pi / 2, 2 * math.pi)), 1e-6)

    def test_section_of_a_closed_orbit(self):
        """One place means nothing by itself: the orbit about it is drawn, on which it lies, and the words say so."""
        good("run", "--set", "run.periods=200", "--set", "run.discard=150", "-o", self.folder / "orbit.csv")
        texts, _, blocks = self.plot("orbit.csv", "--kind", "section")
        self.assertRegex(texts, r"all \d+ passages at one place: the orbit is closed")
        points, orbit = blocks["panel1-curve1"], blocks["panel1-curve2"]
        self.assertLess(max(x for x, _ in points) - min(x for x, _ in points), 0.1)
        self.assertGreater(max(x for x, _ in orbit) - min(x for x, _ in orbit), 8)
        nearest = min(math.hypot(x - points[0][0], y - points[0][1]) for x, y in orbit)
        self.assertLess(nearest, 0.3)
        # A motion that has not settled is points alone.
        texts, _, blocks = self.plot("orbit.csv", "--kind", "section", "--from", "0", "--to", "12")
        self.assertNotIn("panel1-curve2", blocks)
        self.assertIn("a point for each of", texts)

    def test_a_ramp_is_shown_whole(self):
        """Without --kind a ramp is drawn as one, and every kind shows it from end to end; a path stays a path."""
        columns, _ = read_csv(self.folder / "ramp.csv")
        self.assertIn("on a ramp of the drive", self.plot("ramp.csv")[0])
        texts, _, blocks = self.plot("ramp.csv", "--kind", "time", "--quantity", "r")
        times = [x for x, _ in blocks["panel1-curve1"]]
        self.assertAlmostEqual(times[-1] * GAMMA, columns["t"][-1], delta=1e-3 * columns["t"][-1])
        self.assertIn("(9 to 11.99 Hz)", texts)
        self.assertIn("(9 to 11.99 Hz)", self.plot("ramp.csv", "--kind", "path", "--quantity", "slip")[0])
        self.assertIn("Path of the bead", self.plot("t.csv")[0])

    def test_panels_stand_apart(self):
        """Between stacked panels there is room for the numbers at their corners, 12 pixels high."""
        _, script, _ = self.plot("t.csv", "--kind", "time", "--quantity", "r,n_z,slip")
        height = int(re.search(r"set terminal svg size \d+,(\d+)", script)[1])
        frames = [[height * float(x) for x in pair] for pair in
                  re.findall(r"set tmargin at screen ([0-9.]+)\nset bmargin at screen ([0-9.]+)", script)][:3]
        for (_, bottom), (top, _) in zip(frames, frames[1:]):
            self.assertGreater(bottom - top, 16)

    def test_pieces_of_a_path_meet(self):
        """The pieces of a path in changing colours have round ends, so that no seams show between them."""
        for ending in ("svg", "pdf", "png"):
            good("plot", self.folder / "t.csv", "-o", self.folder / f"f.{ending}")
            terminal = re.search(r"set terminal .*", (self.folder / "f.gp").read_text(encoding="utf-8"))[0]
            self.assertIn(" rounded ", terminal)

    def test_no_arrow_meets_words(self):
        """In a map of the field, arrows keep away from the values of its lines, which stand on these lines."""
        good("field", "-o", self.folder / "f.svg", "--units", "lab")
        blocks = {}
        for text in (self.folder / "f.dat").read_text(encoding="utf-8").split("\n\n\n"):
            block, _, *lines = text.strip("\n").split("\n")
            blocks[block[2:]] = [[float(word) for word in line.split()] for line in lines if line]
        self.assertGreater(len(blocks["labels"]), 3)
        wide = max(row[0] for row in blocks["map"]) - min(row[0] for row in blocks["map"])
        for x, y, level in blocks["labels"]:
            at = min(blocks["map"], key=lambda row: math.hypot(row[0] - x, row[1] - y))
            self.assertLess(abs(at[2] - level), 0.1)
            for left, low, across, up in blocks["arrows"]:
                for part in range(11):
                    gap = math.hypot(left + part / 10 * across - x, low + part / 10 * up - y)
                    self.assertGreater(gap, 0.02 * wide)

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
                ("the nearest is slip", ["--kind", "time", "--quantity", "slop"]),
                ("missing", ["--kind", "time", "--quantity", "r,,n_z"]),
                ("at most 6", ["--kind", "time", "--quantity", "r,B,slip,n_z,n_x,n_y,x"]),
                ("two columns", ["--kind", "section", "--quantity", "r"]),
                ("not a ramp", ["--kind", "ramp"]),
                ("colour scale", ["--kind", "radius-field", "--quantity", "slip"]),
                ("at most 1", ["--quantity", "r,slip"]),
                ("nearest is section", ["--kind", "secton"]),
                ("nearest is lab", ["--units", "labs"])):
            self.refused(wanted, "plot", track, *words)
        self.refused("too short for two means", "plot", self.folder / "ramp.csv", "--from", "5", "--to", "8")
        self.refused("never passes", "plot", self.folder / "slow.csv", "--kind", "section")
        self.refused("choose one of given, lab, scaled, si", "field", "--at", "1,1", "--units", "mm")


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
        _, script, _ = self.plot("locked.json", "--quantity", "slip")
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

    def pieces(self, name, observable):
        """The pieces of the first curve, each a list of points."""
        self.plot(name, "--quantity", observable)
        text = (self.folder / "f.dat").read_text(encoding="utf-8").split("\n\n\n")[0]
        pieces = [[[float(word) for word in line.split()] for line in piece.split("\n") if line and line[0] != "#"]
                  for piece in text.split("\n\n")]
        return [piece for piece in pieces if piece and not math.isnan(piece[0][0])]

    def test_a_jump_is_not_joined(self):
        """Where the orbit passes the axis <alpha'> jumps by the drive's 8.9 Hz: both pieces reach the place, and no
        line leads from one to the other."""
        good("branch", "--kind", "counter", "--over", "drive.frequency=8Hz:10Hz", "-o", self.folder / "jump.json")
        (crossing,) = [s for s in json.loads((self.folder / "jump.json").read_text())["specials"]
                       if s["type"] == "origin-crossing"]
        pieces = self.pieces("jump.json", "mean_alpha_dot")
        ends = []
        for piece in pieces:
            self.assertLess(max(abs(b[1] - a[1]) for a, b in zip(piece, piece[1:])), 0.5)
            ends += [y for x, y in (piece[0], piece[-1]) if abs(x - crossing["value"]) < 1e-6]
        self.assertEqual(len(ends), 2)
        self.assertAlmostEqual(max(ends), crossing["value"], 5)
        self.assertAlmostEqual(max(ends) - min(ends), GAMMA / crossing["at"]["period"], 5)
        document = json.loads((self.folder / "jump.json").read_text())
        for point in document["points"]:  # as if N were known on both sides
            point["festoons"] = 5.0 + point["turns"]
        (self.folder / "both.json").write_text(json.dumps(document))
        for piece in self.pieces("both.json", "festoons"):
            self.assertLess(max(y for _, y in piece) - min(y for _, y in piece), 0.5)

    def test_all_curves_stay_within_their_points(self):
        """No radius is negative: <r> of every curve, bent as it may be, lies among the points."""
        good("branch", "--kind", "all", "--over", "drive.frequency=5Hz:12Hz", "-o", self.folder / "all.json")
        found = json.loads((self.folder / "all.json").read_text())
        known = [1e3 * LENGTH * p["mean_r"] for p in found["points"] + [s["at"] for s in found["specials"]]]
        _, _, blocks = self.plot("all.json", "--quantity", "mean_r")
        drawn = [y for name, block in blocks.items() if name.startswith("panel") for _, y in block]
        self.assertGreater(min(drawn), 0)
        self.assertGreater(min(drawn), 0.9 * min(known))
        self.assertLess(max(drawn), 1.01 * max(known))
        # Phi tells a branch from its image under S2: every branch is drawn.
        _, _, blocks = self.plot("all.json", "--quantity", "phi_deg")
        drawn = [point for name, block in blocks.items() if name.startswith("panel") for point in block]
        for p in {p["branch"]: p for p in found["points"] if p["phi_deg"] is not None}.values():
            self.assertLess(min(abs(x - p["value"]) + abs((y - p["phi_deg"] + 180) % 360 - 180) for x, y in drawn), 1e-3)

    def test_an_incomplete_branch_says_so(self):
        document = json.loads((self.folder / "counter.json").read_text())
        self.assertNotIn("incomplete", self.plot("counter.json")[0])
        document["complete"] = False
        (self.folder / "part.json").write_text(json.dumps(document))
        self.assertIn("(incomplete: interrupted)", self.plot("part.json")[0])

    def test_options_of_other_files(self):
        """What says nothing of a file is not left aside in silence."""
        good("sweep", "--set", "run.periods=6", "--set", "run.discard=2", "--over", "drive.frequency=9:10:2", "-o",
             self.folder / "s.db")
        for name, word, words in (
                ("locked.json", "--zoom does not belong to a branch; what does: --quantity", ["--zoom", "0,1,0,1"]),
                ("locked.json", "--kind does not", ["--kind", "section"]), ("locked.json", "--inset", ["--inset"]),
                ("t.csv", "no column \"mean_nz\"", ["--quantity", "mean_nz"]),
                ("t.csv", "--runs does not", ["--runs", "r.json"]),
                ("t.csv", "--no-arrows does not belong to this kind", ["--no-arrows", "--kind", "time"]),
                ("t.csv", "--zoom does not", ["--zoom", "0,1,0,1", "--kind", "section"]),
                ("s.db", "--frame does not belong to a sweep; what does: --kind, --quantity, --only", ["--frame", "lab"]),
                ("s.db", "--kind does not belong to a figure with measured points", ["--kind", "curves", "--points", "p.csv"])):
            self.refused(word, "plot", self.folder / name, *words)

    def test_an_observable_that_is_not_there(self):
        for name, observable in (("locked.json", "festoons"), ("counter.json", "slip"), ("counter.json", "second")):
            self.refused("has a value of " + observable, "plot", self.folder / name, "--quantity", observable)

    def test_scales_that_are_not_known(self):
        with open(self.folder / "counter.json", encoding="utf-8") as file:
            document = json.load(file)
        document["scene"]["magnet.half_length"] *= -1
        (self.folder / "bare.json").write_text(json.dumps(document), encoding="utf-8")
        self.refused("has no scene", "plot", self.folder / "bare.json", "--units", "lab")
        del document["scene"]
        (self.folder / "bare.json").write_text(json.dumps(document), encoding="utf-8")
        self.refused("has no scene", "plot", self.folder / "bare.json", "--units", "lab")
        self.assertIn("mean radius ⟨r⟩ (ℓ)", self.plot("bare.json")[0])


class LaboratoryFiles(Case):
    def test_a_cameras_samples(self):
        """Rows are 1/240 s apart, and their numbers are those of the run in other units."""
        rate = 250  # of friction, 1/s
        good("run", "--set", "run.periods=6", "--set", "run.discard=2", "--csv", self.folder / "lab.csv", "--units", "lab",
             "--sample-rate", "240", "-o", self.folder / "scaled.csv", "--set", f"friction.gamma={rate}")
        lab, units = read_csv(self.folder / "lab.csv")
        self.assertEqual([units[name] for name in ("t", "x", "vx", "w_z", "load", "energy", "drive_power", "n_x", "Phi")],
                         ["s", "mm", "mm/s", "Hz", "mN", "uJ", "mW", "1", "rad"])
        with open(self.folder / "scaled.csv", encoding="utf-8") as file:
            scaled_text = file.read()
        self.assertIn("# festoon trajectory\n", scaled_text[:40])
        for i, t in enumerate(lab["t"]):
            self.assertAlmostEqual(t, i / 240, 12)
        # Two files of one command, each in units of its own.
        scaled, units = read_csv(self.folder / "scaled.csv")
        self.assertEqual([units[name] for name in ("t", "x", "w_z")], ["1/gamma", "l", "gamma"])
        for name, factor in (("t", 1 / rate), ("x", 1e3 * LENGTH), ("w_z", rate / (2 * math.pi))):
            self.assertLess(max(abs(one - factor * other) for one, other in zip(lab[name], scaled[name])), 1e-9)
        self.assertEqual(len(lab["t"]), 1 + math.floor(6 / 10.7 * 240))

    def test_the_units(self):
        """A file in scaled units beside it holds the same numbers; velocities are the slopes of positions."""
        good("run", "--set", "run.periods=4", "--set", "run.discard=2", "--csv", self.folder / "a.csv", "--units", "lab",
             "--sample-rate", "2000")
        good("run", "--set", "run.periods=4", "--set", "run.discard=2", "--csv", self.folder / "b.csv", "--sample-rate", "2000")
        lab, shown = read_csv(self.folder / "a.csv")
        scaled, units = read_csv(self.folder / "b.csv")
        in_si = {"l": LENGTH, "1/gamma": 1 / GAMMA, "gamma": GAMMA, "l gamma": LENGTH * GAMMA,
                 "l gamma^2": MASS * LENGTH * GAMMA ** 2, "l^2 gamma^2": MASS * (LENGTH * GAMMA) ** 2,
                 "l^2 gamma^3": MASS * LENGTH ** 2 * GAMMA ** 3}
        read = {"mm": 1e-3, "s": 1, "Hz": 2 * math.pi, "mm/s": 1e-3, "mN": 1e-3, "uJ": 1e-6, "mW": 1e-3}
        self.assertEqual([name for name, unit in shown.items() if unit == "Hz"],
                         [name for name, unit in units.items() if unit == "gamma"])
        for name, unit in units.items():
            factor = in_si[unit] / read[shown[name]] if unit in in_si else 1
            self.assertEqual(unit in in_si, shown[name] != unit)
            for one, other in zip(lab[name], scaled[name]):
                self.assertLess(abs(one - factor * other), 1e-12 * (1 + abs(one)), name)
        for i in range(1, len(lab["t"]) - 1):
            slope = (lab["x"][i + 1] - lab["x"][i - 1]) / (lab["t"][i + 1] - lab["t"][i - 1])
            self.assertLess(abs(slope - lab["vx"][i]), 0.02 * max(map(abs, lab["vx"])))

    def test_what_is_refused(self):
        path = self.folder / "c.csv"
        for wanted, words in (("--csv", ["--sample-rate", "3"]), ("nearest is lab", ["--units", "labs"]),
                              ("0.01", ["--csv", path, "--sample-rate", "0"]), ("number", ["--csv", path, "--sample-rate", "x"]),
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
