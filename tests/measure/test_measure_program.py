"""What festoon measure writes: tables of points that festoon's other commands read, figures, the path of a scene laid over
a track; measured points over sweeps and branches with chi^2; and the tracks that tools/blender-export.py makes.

tests: measure/json.c measure/figure_measure.c measure/figure_points.c measure/point_curves.c follow/overlay.c measure/points.c measure/clock.c"""

import csv
import importlib.util
import itertools
import json
import math
import os
import random
import re
import shutil
import subprocess
import tempfile
import types
import unittest

import tracks

FESTOON = os.environ["FESTOON"]
SOURCE = os.environ["SOURCE_DIR"]


class Program(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)

    def path(self, name):
        return os.path.join(self.folder.name, name)

    def write(self, name, text):
        with open(self.path(name), "w", encoding="utf-8") as out:
            out.write(text)
        return self.path(name)

    def festoon(self, *words, status=0):
        done = subprocess.run([FESTOON, *words], capture_output=True, text=True)
        self.assertEqual(done.returncode, status, done.stderr)
        return done


class Points(Program):
    def test_table_of_points(self):
        """Three films, a row each: the drive comes from the tracks themselves."""
        drives = (12.8, 14.0, 15.0)
        names = [self.write(f"{f}.csv", tracks.own(tracks.places(drive=f), unit="mm")) for f in drives]
        out = self.path("points.csv")
        done = self.festoon("measure", *names, "--json", "-o", out)
        several = json.loads(done.stdout)
        with open(out, encoding="utf-8") as table:
            rows = list(csv.DictReader(table))
        self.assertEqual((len(rows), len(several)), (3, 3))
        for row, found, drive in zip(rows, several, drives):
            self.assertAlmostEqual(float(row["frequency [Hz]"]), drive, delta=0.01)
            self.assertAlmostEqual(float(row["mean_r [mm]"]), found["mean_r"], places=9)
            self.assertAlmostEqual(float(row["std_r_error [mm]"]), found["std_r_error"], places=9)
            self.assertAlmostEqual(float(row["bead_frequency [Hz]"]), -tracks.BEAD, delta=0.01)

    def test_error_of_the_scale(self):
        """What the track's comment says of it comes back in JSON, in words, and in the table of points."""
        rows = tracks.places()
        exact = self.write("exact.csv", tracks.own(rows, unit="mm"))
        rough = self.write("rough.csv", "# scale_error: 0.0125\n" + tracks.own(rows, unit="mm"))
        plain, found = (json.loads(self.festoon("measure", name, "--json").stdout) for name in (exact, rough))
        self.assertEqual((plain.pop("scale_error"), found.pop("scale_error")), (None, 0.0125))
        self.assertEqual(plain, found)
        self.assertRegex(self.festoon("measure", rough).stdout, r"\+- 1 mm by the scale, which is known to 1\.2 %")
        self.assertNotIn("by the scale", self.festoon("measure", exact).stdout)
        out = self.path("points.csv")
        self.festoon("measure", exact, rough, "-o", out)
        with open(out, encoding="utf-8") as table:
            self.assertEqual([row["scale_error [1]"] for row in csv.DictReader(table)], ["", "0.0125"])
        self.festoon("measure", exact, "-o", out)
        with open(out, encoding="utf-8") as table:
            self.assertNotIn("scale_error", table.readline())
        for scale, error in (("2mm", None), ("2+-0.1mm", 0.05)):
            self.assertEqual(json.loads(self.festoon("measure", rough, "--scale", scale, "--json").stdout)["scale_error"], error)
        for wrong in ("2+-mm", "2+-3mm", "2+--1mm", "0+-1mm", "2+-0.1"):
            self.assertIn("--scale", self.festoon("measure", rough, "--scale", wrong, status=2).stderr)
        for wrong in ("much", "-0.1", "1", ""):
            bad = self.write("bad.csv", f"# scale_error: {wrong}\n" + tracks.own(rows, unit="mm"))
            self.assertIn("bad.csv:1", self.festoon("measure", bad, status=2).stderr)
        bad = self.write("bad.csv", "# rhythm: -3\n" + tracks.own(rows, unit="mm"))
        self.assertIn("number of harmonics", self.festoon("measure", bad, status=2).stderr)
        self.assertIn("not a relative error", self.festoon("fit", self.write(
            "bad.csv", "frequency [Hz],mean_r [mm],mean_r_error [mm],scale_error\n10,20,1,2\n"), "--free", "model.kappa",
            status=2).stderr)

    def test_each_track_its_own(self):
        """Of tracks that do not tell the drive the table has what was given, each its own; a pixel is worth what --scale
        says."""
        drives = (12.8, 14.0)
        names = [self.write(f"{f}.csv", tracks.own(tracks.places(drive=f, swing=0), unit="mm")) for f in drives]
        out = self.path("points.csv")
        self.festoon("measure", *names, "--drive", "12.8Hz,14Hz", "-o", out)
        with open(out, encoding="utf-8") as table:
            for row, drive in zip(csv.DictReader(table), drives, strict=True):
                self.assertAlmostEqual(float(row["frequency [Hz]"]), drive, 12)
        pixels = self.write("px.csv", tracks.own(tracks.places()))
        plain, scaled = (json.loads(self.festoon("measure", pixels, "--json", *more).stdout)
                         for more in ((), ("--scale", "2.5px")))
        self.assertEqual((plain["length_unit"], scaled["length_unit"]), ("px", "px"))
        self.assertAlmostEqual(scaled["mean_r"] / plain["mean_r"], 2.5, 6)

    def test_the_clock(self):
        """What all rates rest on is said where no drive checks it; nothing is called nan."""
        track = self.write("track.csv", tracks.own(tracks.places(drive=12.8)))
        bare = self.write("bare.csv", re.sub(r"(?m)^([^,]*),[^,]*,", r"\1,", tracks.own(tracks.places(drive=12.8))))
        for path, options, words in ((track, (), "all rates rest on the 240 a second that the file's clock says"),
                                     (track, ("--fps", "30"), "all rates rest on the 30 a second that were given"),
                                     (track, ("--drive", "12.8Hz"), "lost; 240 a second\n"), (bare, (), "lost; no clock\n")):
            out = self.festoon("measure", path, *options).stdout
            self.assertIn(words, out)
            self.assertNotIn("nan", out)

    def test_refusals(self):
        pixels = self.write("px.csv", tracks.own(tracks.places()))
        out = self.path("points.csv")
        self.assertIn("--scale", self.festoon("measure", pixels, "-o", out, status=2).stderr)
        self.assertIn("--scale: the track is in pixels",
                      self.festoon("fit", "--track", pixels, "--free", "model.kappa", status=2).stderr)
        self.assertIn(".csv", self.festoon("measure", pixels, "-o", self.path("a.txt"), status=2).stderr)
        self.assertIn("--drive", self.festoon("measure", pixels, "--drive", "1Hz,2Hz", status=2).stderr)
        self.assertIn("--figure", self.festoon("measure", pixels, "--compare", "a.yaml", status=2).stderr)
        self.assertEqual(os.listdir(self.folder.name), ["px.csv"])

    def test_points_over_a_sweep(self):
        """Points that lie so many errors off the computed rows have just that chi^2."""
        base = self.path("sweep.db")
        self.festoon("sweep", "--over", "drive.frequency=15Hz:16Hz:3", "--set", "run.periods=120", "--set",
                     "run.discard=80", "-o", base)
        rows = json.loads(self.festoon("export", base, "--json").stdout)
        lines = ["frequency [Hz],mean_r [mm],mean_r_error [mm],bead_frequency [Hz],bead_frequency_error [Hz]"]
        for k, row in enumerate(rows):
            bead = row["mean_alpha_dot"] * 312.5 / (2 * math.pi)
            lines.append(f"{15 + 0.5 * k!r},{23 * row['mean_r'] + 0.1 * k!r},0.1,{bead - 0.03!r},0.03")
        lines.append("40,20,1,,")  # no curve there
        points = self.write("points.csv", "\n".join(lines) + "\n")
        if not shutil.which("gnuplot"):
            self.skipTest("no gnuplot")
        said = self.festoon("plot", base, "--points", points, "-o", self.path("fig.svg")).stderr
        chi2, counted = re.search(r"chi\^2 = ([\d.]+) of (\d+) measured", said).groups()
        self.assertAlmostEqual(float(chi2), 0 + 1 + 4 + 3, delta=1e-4)
        self.assertEqual(counted, "6")
        self.assertIn("(7 in the table)", said)
        # A scale that makes all lengths wrong alike: chi^2 is the least over it, found here by trying.
        lines = ["frequency [Hz],mean_r [mm],mean_r_error [mm],scale_error"]
        lengths = [23 * row["mean_r"] for row in rows]
        lines += [f"{15 + 0.5 * k!r},{1.03 * length!r},0.1,0.02" for k, length in enumerate(lengths)]
        scaled = self.write("scaled.csv", "\n".join(lines) + "\n")
        said = self.festoon("plot", base, "--points", scaled, "-o", self.path("fig.svg")).stderr
        least = min(s * s + sum(((0.03 - s * 0.02 * 1.03) * length / 0.1) ** 2 for length in lengths)
                    for s in (1e-4 * k for k in range(20000)))
        self.assertAlmostEqual(float(re.search(r"chi\^2 = ([\d.]+) of 3", said)[1]), least, delta=1e-4)
        # Several tables and several results: each pair has the chi^2 that it has alone, and numbers in scaled units.
        dry = self.path("dry.db")
        self.festoon("sweep", "--over", "drive.frequency=15Hz:16Hz:3", "--set", "run.periods=120", "--set", "run.discard=80",
                     "--set", "friction.law=coulomb", "-o", dry)
        odd = self.write("a_b{c}^d.csv", "frequency [Hz],mean_r [mm],mean_r_error [mm]\n15.5,20,0.5\n")
        alone = [re.search(r"(chi\^2 = .*)", self.festoon("plot", result, "--points", table, "-o", self.path("fig.svg")).stderr)[1]
                 for result in (base, dry) for table in (points, odd)]
        said = self.festoon("plot", base, dry, "--points", points, "--points", odd, "--units", "scaled", "-o", self.path("fig.svg")).stdout
        self.assertEqual([line.split(": ", 1)[1] for line in said.splitlines()], alone)
        with open(self.path("fig.gp"), encoding="utf-8") as script:
            script = script.read()
        self.assertIn(r"'a\_b\{c\}\^d.csv'", script)
        self.assertEqual([name in script for name in ("'friction.law viscous'", "'friction.law coulomb'", "'points.csv'")], [True] * 3)
        with open(self.path("fig.dat"), encoding="utf-8") as data:
            block = next(text for text in data.read().split("\n\n\n") if text.startswith("# panel1-curve6"))
        found = [float(word) for word in block.split("\n")[2].split()]
        for number, truth in zip(found, (15.5 * 2 * math.pi / 312.5, 20 / 23, 19.5 / 23, 20.5 / 23), strict=True):
            self.assertAlmostEqual(number, truth, 7)
        short = self.path("short.db")
        self.festoon("sweep", "--over", "drive.frequency=15Hz:16Hz:3", "--set", "run.periods=6", "--set", "run.discard=2",
                     "--set", "friction.gamma=200", "-o", short)
        self.assertIn("another gamma than sweep.db", self.festoon("plot", base, short, "--points", odd, "--units", "scaled", "-o",
                                                                  self.path("no.svg"), status=2).stderr)
        self.festoon("plot", base, short, "--points", odd, "-o", self.path("fig.svg"))
        other = self.path("other.db")
        self.festoon("sweep", "--over", "friction.gamma=300:310:2", "--set", "run.periods=6", "--set", "run.discard=2",
                     "-o", other)
        self.assertIn("friction.gamma",
                      self.festoon("plot", other, "--points", points, "-o", self.path("no.svg"), status=2).stderr)
        self.assertFalse(os.path.exists(self.path("no.svg")))

    def test_points_at_runs_that_stand_alone(self):
        """A run that is alone in its regime is a model, and no line joins it to others; one that is undecided or ejected is
        none, and stands as a sign at the lower edge."""
        if not shutil.which("gnuplot"):
            self.skipTest("no gnuplot")
        for key, drives, table in (("drive.frequency", "3Hz,8Hz,10.7Hz,10.8Hz", (3, 8, 10.7, 10.8)),
                                   ("drive.omega", "0.06,0.16,0.215,0.217",
                                    [(1 + 1e-11) * 312.5 * w / (2 * math.pi) for w in (0.06, 0.16, 0.215, 0.217)])):
            base = self.path(f"{key}.db")
            self.festoon("sweep", "--over", f"{key}={drives}", "--set", "run.periods=200", "--set", "run.discard=100", "-o", base)
            rows = json.loads(self.festoon("export", base, "--json").stdout)
            self.assertEqual([row["regime"] for row in rows], ["locked", "librating", "counter-rotating", "counter-rotating"])
            lines = [f"{x!r},{23 * row['mean_r'] + 0.1!r},0.1" for x, row in zip(table, rows)]
            points = self.write("alone.csv", "frequency [Hz],mean_r [mm],mean_r_error [mm]\n" + "\n".join(lines) + "\n5,17,1\n")
            said = self.festoon("plot", base, "--points", points, "-o", self.path("fig.svg")).stderr
            self.assertIn("chi^2 = 4 of 4 measured numbers (5 in the table)", said)
            self.assertIn("line 6 (5 Hz), mean_r: the curve has a gap there", said)
            with open(self.path("fig.dat"), encoding="utf-8") as file:
                lines = file.read().split("\n\n\n")[0].split("\n")[2:]
            self.assertEqual([len(line) > 0 for line in lines], [True, False, True, False, True, True])  # one line
            for line, row in zip(filter(None, lines), rows, strict=True):
                self.assertAlmostEqual(float(line.split()[1]), 23 * row["mean_r"], 5)

    def test_signs_below_points(self):
        """Runs that are no motion, or an undecided one, stand at the lower edge, on a line for each file, and are no model."""
        if not shutil.which("gnuplot"):
            self.skipTest("no gnuplot")
        for name, kappa in (("a.db", "1.2"), ("b.db", "1.1")):
            self.festoon("sweep", "--set", "run.periods=12", "--set", "run.discard=4", "--set", "start.r=0.7", "--set",
                         "plate.radius=21.3mm", "--set", f"model.kappa={kappa}", "--over", "drive.frequency=8Hz:22Hz:8", "-o", self.path(name))
        wanted = [{}, {}]
        for found, name in zip(wanted, ("a.db", "b.db")):
            for row in json.loads(self.festoon("export", self.path(name), "--json").stdout):
                found.setdefault(row["regime"], []).append(row["drive.frequency"])
        self.assertEqual((wanted[0]["undecided"], wanted[0]["counter-rotating"], 12 in wanted[0]["ejected"], set(wanted[1])),
                         ([14, 16], [18], True, {"undecided", "ejected"}))
        points = self.write("p.csv", "frequency [Hz],mean_r [mm],mean_r_error [mm]\n12,20.3,0.1\n14,20.5,0.1\n18,20.7,0.1\n")
        said = self.festoon("plot", self.path("a.db"), "--points", points, "-o", self.path("fig.svg")).stderr
        self.assertIn("line 2 (12 Hz), mean_r: the run there is ejected\nline 3 (14 Hz), mean_r: the run there is undecided\n", said)
        self.assertIn(" of 1 measured numbers (3 in the table)", said)
        for word in ("undecided", "ejected"):
            self.assertEqual(self.signs(word), {"panel1": [(x, 0.03) for x in wanted[0][word]]})
        with open(self.path("fig.gp"), encoding="utf-8") as script:
            low, high = map(float, re.search(r"set yrange \[(.*?):(.*?)\]", script.read()).groups())
        self.assertLess(low + 0.059 * (high - low), 20.2)  # the bars of errors are within the panel, above the signs
        self.assertGreater(high, 20.8)
        self.festoon("plot", self.path("a.db"), self.path("b.db"), "--points", points, "-o", self.path("fig.svg"))
        with open(self.path("fig.dat"), encoding="utf-8") as file:
            drawn = [tuple(map(float, line.split())) for line in file if line[:1].isdigit() and len(line.split()) == 2]
        for level, found in zip((0.03, 0.07), wanted):
            self.assertEqual(sorted(x for x, y in drawn if y == level), sorted(found["undecided"] + found["ejected"]))
        with open(self.path("fig.gp"), encoding="utf-8") as script:
            script = script.read()
        self.assertEqual([script.count(f"set label '{said}'") for said in ("undecided", "ejected")], [1, 1])
        self.assertIn("model.kappa 1.1: χ² = 0 of 0: undecided'", script)

    def test_the_paper_in_words_over_a_branch(self):
        """At 7 Hz the branch is unstable alone, which says nothing of a bead; where it passes the axis, at 8.9 Hz, the
        bead's frequency jumps, and no line joins its two ends."""
        if not shutil.which("gnuplot"):
            self.skipTest("no gnuplot")
        branch = self.path("branch.json")
        done = subprocess.run([FESTOON, "branch", "--kind", "counter", "--over", "drive.frequency=5Hz:21Hz", "-o", branch],
                              capture_output=True, text=True)
        if done.returncode == 1 and "LAPACK" in done.stderr:
            self.skipTest("no LAPACK")
        words = os.path.join(SOURCE, "examples", "paper-words.csv")
        said = self.festoon("plot", branch, "--points", words, "-o", self.path("fig.svg")).stderr
        chi2, counted = re.search(r"chi\^2 = ([\d.]+) of (\d+) measured", said).groups()
        self.assertEqual(counted, "3")
        self.assertRegex(said, r"left out:\nline \d+ \(6\.7 Hz\), bead_frequency: all states there are unstable\n")
        before, joined = None, 0
        with open(self.path("fig.dat"), encoding="utf-8") as file:
            for line in file:
                numbers = [float(word) for word in line.split()] if line[:1].isdigit() else []
                if before and numbers and all(map(math.isfinite, before + numbers)):
                    joined += 1
                    if before[0] < 9.5 and numbers[0] < 9.5:
                        self.assertLess(abs(numbers[1] - before[1]), 4)
                before = numbers
        self.assertGreater(joined, 20)
        self.assertLess(float(chi2), 3.0)

    def signs(self, *names):
        """{panel: [places]} of the curves with these names in the figure."""
        found = {}
        with open(self.path("fig.dat"), encoding="utf-8") as file:
            for block in file.read().split("\n\n\n"):
                name, words, *lines = block.strip("\n").split("\n")
                if words[2:] in names:
                    found.setdefault(name[2:8], []).extend(tuple(round(float(word), 5) for word in line.split()) for line in lines)
        return {panel: sorted(places) for panel, places in found.items()}

    def test_exact_orbits_over_a_branch(self):
        """Orbits that are found one by one, between the branch's points and on either side of its pitchfork at 13.37 Hz,
        lie on its curve, by either key of the drive; what has no part in chi^2 is named with the reason."""
        if not shutil.which("gnuplot"):
            self.skipTest("no gnuplot")
        orbits = {}
        for f in (9.3, 10.7, 11.4, 12.1, 13.3, 14.0, 14.4):
            done = subprocess.run([FESTOON, "orbit", "--json", "--set", f"drive.frequency={f}Hz"], capture_output=True, text=True)
            if done.returncode == 1 and "LAPACK" in done.stderr:
                self.skipTest("no LAPACK")
            orbits[f] = json.loads(done.stdout)
        head = "frequency [Hz],mean_r [mm],mean_r_error [mm],bead_frequency [Hz],bead_frequency_error [Hz]\n"
        rows = {f: f"{f},{23 * orbit['mean_r']!r},0.01,{orbit['mean_alpha_dot'] * 312.5 / (2 * math.pi)!r},0.001\n"
                for f, orbit in orbits.items()}
        tables = [self.write(f"{f}.csv", head + row) for f, row in rows.items()]
        tables.append(self.write("all.csv", head + "".join(rows.values())))
        for over in ("drive.frequency=8Hz:25Hz", "drive.omega=0.16:0.5"):
            branch = self.path("branch.json")
            self.festoon("branch", "--kind", "counter", "--over", over, "-o", branch)
            for table in tables:
                said = self.festoon("plot", branch, "--points", table, "-o", self.path("fig.svg")).stderr
                chi2, counted, count = re.search(r"chi\^2 = (\S+) of (\d+) measured numbers \((\d+) in", said).groups()
                self.assertLess(float(chi2), 0.05, said)
                self.assertEqual(counted, count)
                self.assertNotIn("left out", said)
        # Both stable branches are drawn up to the pitchfork, as smooth curves.
        with open(branch, encoding="utf-8") as file:
            pitchfork = next(special for special in json.load(file)["specials"] if special["type"] == "pitchfork")
        with open(self.path("fig.dat"), encoding="utf-8") as file:
            block = file.read().split("\n\n\n")[0]
        drawn = [[float(word) for word in line.split()] for line in block.split("\n") if line[:1].isdigit()]
        xs = sorted(x for x, *_ in drawn if math.isfinite(x))
        self.assertLess(max(b - a for a, b in zip(xs, xs[1:])), 0.3)
        there = (pitchfork["value"] * 312.5 / (2 * math.pi), 23 * pitchfork["at"]["mean_r"])
        self.assertEqual(sum(math.dist(there, point[:2]) < 1e-5 for point in drawn), 2)
        # The special points of the branch stand in both panels, where the branch has them.
        with open(branch, encoding="utf-8") as file:
            specials = json.load(file)["specials"]
        hertz = 312.5 / (2 * math.pi)
        wanted = [sorted((round(hertz * s["value"], 5), round(scale * s["at"][key], 5)) for s in specials)
                  for key, scale in (("mean_r", 23), ("mean_alpha_dot", hertz))]
        self.assertEqual(self.signs("pitchfork", "Hopf", "passes the axis, r = 0"), {"panel1": wanted[0], "panel2": wanted[1]})
        # Over several branches the key names each sign once.
        self.festoon("plot", branch, branch, "--points", tables[0], "-o", self.path("fig.svg"))
        self.assertEqual([len(found) for found in self.signs("pitchfork").values()], [1, 1])
        with open(self.path("fig.gp"), encoding="utf-8") as script:
            self.assertEqual(script.read().count("set label 'pitchfork'"), 1)
        # --quantity chooses panels, and what chi^2 is of.
        for key in ("bead_frequency", "mean_alpha_dot"):
            said = self.festoon("plot", branch, "--points", tables[-1], "--quantity", key, "-o", self.path("fig.svg")).stderr
            self.assertIn("of 7 measured numbers (7 in the table)", said)
            self.assertEqual(self.signs("pitchfork", "Hopf", "passes the axis, r = 0"), {"panel1": wanted[1]})
        for key, told in (("mean_q", "the nearest is mean_r"), ("std_r", "no measured number of what is asked for")):
            self.assertIn(told, self.festoon("plot", branch, "--points", tables[0], "--quantity", key, "-o", self.path("no.svg"),
                                             status=2).stderr)
        odd = self.write("odd.csv", "frequency [Hz],mean_r [mm],mean_r_error [mm],std_r [mm],std_r_error [mm]\n"
                                    "10.7,17.63,0.1,1,0.1\n40,20,1,,\n")
        said = self.festoon("plot", branch, "--points", odd, "-o", self.path("fig.svg")).stderr
        self.assertRegex(said, r"odd\.csv over .*branch\.json, left out:\nline 3 \(40 Hz\), mean_r: the curve reaches from [\d.]+ Hz to "
                               r"[\d.]+ Hz\na branch has no std_r\n(?!line)")
        self.assertIn("of 1 measured numbers (3 in the table)", said)
        with open(self.path("fig.gp"), encoding="utf-8") as script:
            self.assertNotIn("deviation of r", script.read())
        said = self.festoon("plot", branch, "--points", odd, "--quantity", "std_r", "-o", self.path("no.svg"), status=2).stderr
        self.assertIn("a branch has none of the measured quantities", said)
        self.assertFalse(os.path.exists(self.path("no.svg")))


class Readings(Program):
    """What a film can be read as in more than one way."""

    def measured(self, text, *words):
        return json.loads(self.festoon("measure", self.write("film.csv", text), "--json", *words).stdout)

    def assert_covers(self, found, key, truth):
        self.assertLess(abs(found[key] - truth), 4 * found[key + "_error"], key)

    def test_mirrored_film_of_four_festoons(self):
        """2 (9.6 - 3.2) is 9.6 + 3.2: twice the rate of a bead that goes with the magnet is that of one against it."""
        rows = tracks.places(sense=1, drive=9.6)
        found = self.measured(tracks.own(rows), "--drive", "9.6Hz")
        self.assert_covers(found, "bead_frequency_hz", -tracks.BEAD)
        self.assert_covers(found, "festoons", 4.0)
        self.assertIn("mirrored", " ".join(found["warnings"]))

    def test_wrong_drive_makes_no_strange_clock(self):
        """A bead of four festoons is not one of S2 in a film of 800 frames a second."""
        found = self.measured(tracks.own(tracks.places(bead=3.5, drive=10.7)), "--drive", "12Hz")
        self.assertAlmostEqual(found["fps"], 240.0, places=3)
        self.assertAlmostEqual(found["bead_frequency_hz"], -3.5, places=3)
        self.assertIn("frame rate", " ".join(found["warnings"]))
        for key in ("bead_frequency_hz_error", "drive_from_track_hz_error", "radial_frequency_hz_error"):
            self.assertIsNone(found[key], key)  # frame rate or drive: one of them is wrong
        self.assertIn("(--drive could not check them)",
                      self.festoon("measure", self.path("film.csv"), "--drive", "12Hz").stdout)

    def test_slowed_in_parts(self):
        """Of a film slowed in its middle frames are the clock; lost frames, jitter, and a camera that takes fewer frames for a
        while leave a clock that is right."""
        rows, chance = tracks.places(), random.Random(5)
        lines = tracks.own(rows).splitlines()

        def timed(steps, kept=lambda i: True):
            times = itertools.accumulate(steps, initial=0.0)
            cells = [(t, line.split(",")) for t, line in zip(times, lines[1:]) if line]
            return "\n".join(lines[:1] + [",".join([str(n), f"{t:.7f}", *c[2:]])
                                          for n, (t, c) in enumerate(x for i, x in enumerate(cells) if kept(i))]) + "\n"

        even = [1 / 240] * (len(rows) - 1)
        slowed = timed([s * (8 if 200 <= i < 500 else 1) for i, s in enumerate(even)])
        found = self.measured(slowed)
        self.assertIn("slowed in parts", found["warnings"][0])
        for key in ("fps", "bead_frequency_hz", "bead_frequency_hz_error", "drive_from_track_hz"):
            self.assertIsNone(found[key], key)
        self.assert_covers(found, "festoons", tracks.FESTOONS)
        found = self.measured(slowed, "--drive", f"{tracks.DRIVE}Hz")
        self.assert_covers(found, "bead_frequency_hz", -tracks.BEAD)
        self.assertAlmostEqual(found["fps"], 240.0, delta=0.1)
        self.assert_covers(self.measured(slowed, "--fps", "240"), "bead_frequency_hz", -tracks.BEAD)
        for text in (timed(even, lambda i: i % 7), timed(even, lambda i: i % 2 or not 200 <= i < 500),
                     timed([s * (0.7 + 0.6 * chance.random()) for s in even]),
                     timed([s * (0.4 if i % 2 else 1.6) for i, s in enumerate(even)])):
            self.assertNotIn("slowed", " ".join(self.measured(text)["warnings"]))
        # a bead that rests in dim light, of which the camera takes fewer frames, and circles in the light
        resting = [(tracks.R0 + chance.gauss(0, 0.05), chance.gauss(0, 0.05)) for _ in range(60)]
        lines = tracks.own(resting + tracks.places(fps=60.0, seconds=15.0)).splitlines()
        found = self.measured(timed([1 / 30] * 60 + [1 / 60] * 899))
        self.assertNotIn("slowed", " ".join(found["warnings"]))
        self.assertIsNotNone(found["fps"])

    def test_sense_of_a_locked_bead(self):
        """A bead that has the magnet's rate and the other sense: how it goes round, and with which sign the drive would agree."""
        for sense, drive, told in ((1, "-3.2Hz", "counter-clockwise (then give the drive without a minus)"),
                                   (-1, "3.2Hz", "clockwise (then give the drive with a minus)")):
            text = tracks.own(tracks.places(sense=sense, swing=0.0))
            self.assertIn(f"but {told.split(' ', 1)[0]}: the film is mirrored, or the magnet turns {told}",
                          " ".join(self.measured(text, "--drive", drive)["warnings"]))
            other = drive[1:] if sense > 0 else "-" + drive
            self.assertNotIn("mirrored", " ".join(self.measured(text, "--drive", other)["warnings"]))

    def test_folded_line_without_a_drive(self):
        """17.2 Hz at 30 frames a second look like 12.8 Hz: both readings are told, and neither is a result."""
        text = tracks.own(tracks.places(fps=30.0, drive=14.0, seconds=8.0), fps=30.0)
        found = self.measured(text)
        for key in ("drive_from_track_hz", "festoons", "radial_frequency_hz", "symmetry"):
            self.assertIsNone(found[key], key)
            self.assertIsNone(found.get(key + "_error"), key)
        self.assertRegex(" ".join(found["warnings"]), r"\(alias\): the drive may be 14 Hz.* as well as 9\.599 Hz")
        self.assertIn("festoons N               unknown", self.festoon("measure", self.path("film.csv")).stdout)
        found = self.measured(text, "--drive", "14Hz")
        self.assert_covers(found, "drive_from_track_hz", 14.0)
        self.assertLess(found["drive_from_track_hz_error"], 0.01)
        self.assertEqual(self.measured(tracks.own(tracks.places()))["warnings"], [])

    def test_rates_by_the_drive_alone(self):
        """Without a clock the error of the bead's rate has that of the clock in it."""
        for seed in range(1, 7):
            text = re.sub(r"(?m)^(\d+),[^,]*,", r"\1,", tracks.own(tracks.places(seed=seed))).replace("t [s],", "")
            found = self.measured(text, "--drive", f"{tracks.DRIVE}Hz")
            self.assert_covers(found, "bead_frequency_hz", -tracks.BEAD)
            self.assertLess(found["bead_frequency_hz_error"], 0.001)

    def test_oscillation_lost_in_the_exposure(self):
        """What an exposure has blurred away is unknown."""
        text = tracks.own(tracks.places(fps=20.0, seconds=8.0), fps=20.0)
        found = self.measured(text, "--drive", f"{tracks.DRIVE}Hz", "--exposure", "49ms")
        self.assertEqual((found["std_r"], found["std_r_error"], found["mean_r_error"]), (None, None, None))
        self.assertIn("exposure", " ".join(found["warnings"]))


class Figures(Program):
    def blocks(self, name):
        """The blocks of a figure's data by their names: a comment line of one word begins a block."""
        found, rows = {}, []
        with open(self.path(name), encoding="utf-8") as data:
            for line in data:
                if re.fullmatch(r"# [a-z-]+\n", line):
                    rows = found[line[2:-1]] = []
                elif line.strip() and not line.startswith("#"):
                    rows.append([float(word) for word in line.split()])
        return found

    def test_a_scene_over_its_own_track(self):
        """A scene's own motion, measured, and the scene laid over it: both are the same curve in the magnet's frame."""
        if not shutil.which("gnuplot"):
            self.skipTest("no gnuplot")
        scene = os.path.join(SOURCE, "examples", "paper-10.7Hz.yaml")
        run = self.path("run.csv")
        self.festoon("run", scene, "--csv", run, "--set", "run.periods=260", "--set", "run.discard=200")
        with open(run, encoding="utf-8") as whole:  # the settled part alone
            lines = whole.read().splitlines()
        head = next(i for i, line in enumerate(lines) if line.startswith("t [")) + 1
        rows = [line.split(",") for line in lines[head:] if not line.startswith("#")]
        names = [name.split(" ")[0] for name in lines[head - 1].split(",")]
        t, x, y = (names.index(name) for name in ("t", "x", "y"))
        made = ["t [s],x [mm],y [mm]"] + [f"{float(row[t]) / 312.5:.9f},{23 * float(row[x]):.9f},{23 * float(row[y]):.9f}"
                                          for row in rows if float(row[t]) / 312.5 > 200 / 10.7]
        for mirrored in (False, True):
            text = "\n".join(made) + "\n"
            if mirrored:
                text = "\n".join([made[0]] + [re.sub(r"([^,]+)$", lambda y: f"{-float(y.group(1)):.9f}", line)
                                              for line in made[1:]]) + "\n"
            track = self.write("track.csv", text)
            drive = "-10.7Hz" if mirrored else "10.7Hz"
            self.festoon("measure", track, "--drive", drive, "--figure", self.path("fig.svg"), "--compare", scene)
            blocks = self.blocks("fig.dat")
            curve = [tuple(row) for row in blocks["model-magnet"]]
            far = max(min(math.hypot(row[3] - a, row[4] - b) for a, b in curve) for row in blocks["seen"][::7])
            self.assertLess(far, 0.15)  # mm; the curve has 512 places on some 110 mm
        # a scene whose run ends as soon as it has settled, before its discard
        self.festoon("measure", track, "--drive", drive, "--figure", self.path("fig.svg"), "--compare", scene, "--set",
                     "run.until=settled")
        same = [tuple(row) for row in self.blocks("fig.dat")["model-magnet"]]
        self.assertLess(max(min(math.dist(a, b) for b in curve) for a in same[::8]), 0.15)

    def test_figure_of_a_locked_bead(self):
        if not shutil.which("gnuplot"):
            self.skipTest("no gnuplot")
        track = self.write("track.csv", tracks.own(tracks.places(sense=1, bead=5.0, swing=0.0)))
        self.festoon("measure", track, "--drive", "5Hz", "--figure", self.path("fig.svg"))
        self.assertTrue(os.path.exists(self.path("fig.svg")))
        said = self.festoon("measure", track, "--drive", "5Hz", "--figure", self.path("no.svg"), "--compare",
                            os.path.join(SOURCE, "examples", "paper-10.7Hz.yaml"), status=2).stderr
        self.assertIn("--compare", said)
        self.assertFalse(os.path.exists(self.path("no.svg")))


class Blender(Program):
    def test_export(self):
        """A clip as Blender hands it out: places from 0 to 1, y up, muted markers, further objects."""
        spec = importlib.util.spec_from_file_location("blender_export", os.path.join(SOURCE, "tools/blender-export.py"))
        module = importlib.util.module_from_spec(spec)
        spec.loader.exec_module(module)
        width, height, lost = 640, 480, {10, 11, 300}
        thing = types.SimpleNamespace

        def track(name, places):
            return thing(name=name, markers=[thing(frame=i + 1, mute=i in lost, co=(x / width, y / height))
                                             for i, (x, y) in enumerate(places)])

        rows = [(320 + x, 240 + y) for x, y in tracks.places()]
        bead = track('the "bead", 5 mm', rows)
        clip = thing(name="film.mp4", size=(width, height), fps=240.0, frame_start=1,
                     tracking=thing(tracks=[track("speck", rows[:50])], objects=[thing(tracks=[bead])]))
        path = self.write("tracks.csv", module.table(clip))
        done = self.festoon("measure", path, "--json")
        found = json.loads(done.stdout)
        self.assertIn("the longest of 2", done.stderr)
        self.assertAlmostEqual(found["mean_r"], tracks.R0, delta=0.02)
        self.assertAlmostEqual(found["drive_from_track_hz"], tracks.DRIVE, delta=5e-3)
        self.assertEqual((found["frames"], found["lost"]), (960, 3))
        self.assertLess(found["bead_frequency_hz"], 0)
        with self.assertRaises(SystemExit):
            module.table(thing(name="empty", size=(1, 1), fps=25.0, tracking=thing(tracks=[], objects=[])))


if __name__ == "__main__":
    unittest.main()
