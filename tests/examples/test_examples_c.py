"""The examples in C (examples/c): each prints what the program computes, to the last bit, and is a page of the API
reference.  The test `installed` builds them against the installed library, by the line in each."""

import csv
import io
import json
import math
import os
import re
import shlex
import subprocess
import unittest
from pathlib import Path

from sweep_tools import Case, content_of

SOURCES = Path(os.environ["SOURCE_DIR"])
PROGRAMS = Path(os.environ["BUILD_DIR"]) / "tests" / "examples"
LISTED = sorted(path.stem for path in (SOURCES / "examples" / "c").glob("*.c"))


class Examples(Case):
    def example(self, name, *words):
        done = subprocess.run([PROGRAMS / name, *words], stdin=subprocess.DEVNULL, capture_output=True, text=True,
                              cwd=self.directory, check=False)
        if done.returncode == 77:
            self.skipTest(done.stderr)
        return done

    def printed(self, name, *words):
        done = self.example(name, *words)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout

    def by_the_program(self, name):
        """The output of the command in the opening comment of an example."""
        text = (SOURCES / "examples" / "c" / (name + ".c")).read_text(encoding="utf-8")
        words = shlex.split(re.search(r"^ \*     festoon (.*)$", text, re.M).group(1))
        return self.good(*words, *([] if "-o" in words else ["--json"]), cwd=self.directory)

    def test_run(self):
        said = self.printed("run", "642 rpm", "of-ours.csv")
        run = json.loads(self.by_the_program("run"))
        self.assertTrue(said.startswith(f"{run['regime']}: {run['reason']}\n"), said)
        for key, value in re.findall(r"^(\w+) = (\S+)$", said, re.M):
            self.assertEqual(float(value), run[key], key)
        self.assertIn("festoons = ", said)
        lines = [line for line in content_of(self.path("path.csv"), "r").splitlines() if not line.startswith("#")]
        expected = [(row["t [1/gamma]"], row["x [l]"], row["y [l]"]) for row in csv.DictReader(lines)]
        found = [tuple(row.values()) for row in csv.DictReader(io.StringIO(content_of(self.path("of-ours.csv"), "r")))]
        self.assertGreater(len(found), 1000)
        self.assertEqual(found, expected)

    def test_force(self):
        """Without coil and draught it is the run of the program; with them it is another."""
        said = re.findall(r"r = (\S+) l, (\S+) times round", self.printed("force"))
        path = self.path("path.csv")
        self.good("run", "--set", "run.periods=60", "--set", "run.discard=1", "--set", "run.samples=32", "--csv", path)
        lines = [line for line in content_of(path, "r").splitlines() if not line.startswith("#")]
        r = [math.hypot(float(row["x [l]"]), float(row["y [l]"])) for row in csv.DictReader(lines)]
        self.assertEqual(len(r), 60 * 32 + 1)
        self.assertAlmostEqual(float(said[0][0]), sum(r[1:]) / (60 * 32), delta=1e-9)
        self.assertEqual(len(said), 3)
        for other in said[1:]:
            self.assertGreater(abs(float(other[0]) - float(said[0][0])), 1e-4)

    def test_run_with_bad_input(self):
        done = self.example("run", "7 mm")
        self.assertEqual((done.returncode, done.stdout), (1, ""))
        self.assertIn('has the unknown unit "mm" (units here: Hz ', done.stderr)

    def test_map(self):
        found = list(csv.DictReader(io.StringIO(self.printed("map"))))
        self.by_the_program("map")
        rows = json.loads(self.good("export", self.path("map.db"), "--json"))
        self.assertEqual(len(found), len(rows))
        for line, row in zip(found, rows):
            self.assertEqual(line["regime"], row["regime"])
            for key in set(line) - {"regime"}:
                expected = row[key] if row[key] is not None else math.nan
                self.assertEqual(repr(float(line[key])), repr(float(expected)), (key, line))  # repr: nan is nan

    def test_branch(self):
        said = self.printed("branch")
        branch = json.loads(self.by_the_program("branch"))
        stable = sum(point["stable"] for point in branch["points"])
        self.assertIn(f"{len(branch['points'])} orbits on {branch['branches']} branches, {stable} of them stable", said)
        found = re.findall(r"^(\S+) at omega = (\S+) on branch (\d+), r = (\S+)$", said, re.M)
        self.assertEqual([(kind, float(value), int(number), float(r)) for kind, value, number, r in found],
                         [(s["type"], s["value"], s["branch"], s["at"]["mean_r"])
                          for s in branch["specials"] + branch.get("crossings", [])])
        self.assertIn("pitchfork", said)
        for end in branch["ends"]:
            self.assertIn(f"branch {end['branch']} ends at {end['value']:.17g}: {end['reason']}\n", said)

    def test_field(self):
        """The field agrees with its definition for two charges, and the bead moves as over a line of the paper's
        magnet."""
        said = self.printed("field")
        places = re.findall(r"^x = (\S+): B = (\S+) (\S+) (\S+), dB_x/dx = (\S+)$", said, re.M)
        self.assertEqual(len(places), 5)
        height = json.loads(self.good("check", "--json"))["groups"]["h"]
        for place in places:
            x, *numbers = map(float, place)
            b, slope = [0.0, 0.0, 0.0], 0.0
            for charge, reach in ((4.5, 0.9), (-4.5, -0.9)):
                d = (x - reach, 0.3, height)
                distance = math.hypot(*d)
                b = [old + charge * part / distance**3 for old, part in zip(b, d)]
                slope += charge * (1 / distance**3 - 3 * d[0]**2 / distance**5)
            for found, expected in zip(numbers, (*b, slope)):
                self.assertAlmostEqual(found, expected, delta=1e-13 * 10)
        radii = dict(re.findall(r"^(.*): counter-rotating, r = (\S+)$", said, re.M))
        line = json.loads(self.good("run", "--set", "magnet.lines=1", "--set", "drive.frequency=20Hz", "--json"))
        self.assertEqual(float(radii["a line"]), line["mean_r"])
        self.assertAlmostEqual(float(radii["as a line"]), line["mean_r"], delta=1e-9)
        self.assertGreater(abs(float(radii["two charges"]) - line["mean_r"]), 0.01)

    def test_law(self):
        said = self.printed("law")
        runs = re.findall(r"^grip (\S+): counter-rotating, (\S+) festoons, power of the drive (\S+), of friction (\S+)$",
                          said, re.M)
        self.assertEqual([grip for grip, *_ in runs], ["50", "250", "1000"])
        for _, _, drive, friction in runs:
            self.assertGreater(float(friction), 1e-5)
            self.assertAlmostEqual(float(drive) / float(friction), 1.0, delta=1e-9)
        orbit = re.search(r"^orbit: S1, (\S+) festoons, stable, residual (\S+)$", said, re.M)
        self.assertAlmostEqual(float(orbit[1]), float(runs[1][1]), delta=1e-8)  # from the run, and from Newton's method
        self.assertLess(float(orbit[2]), 1e-11)

    def test_public_headers_alone(self):
        for path in (SOURCES / "examples" / "c").glob("*.c"):
            for header in re.findall(r"^#include\s+(\S+)", path.read_text(encoding="utf-8"), re.M):
                self.assertRegex(header, r"^<(festoon/festoon(_tools)?|[a-z]+)\.h>$", path.name)

    def test_each_is_a_page_of_the_reference(self):
        pages = (SOURCES / "docs" / "examples.dox").read_text(encoding="utf-8")
        landing = (SOURCES / "docs" / "api.md").read_text(encoding="utf-8")
        self.assertEqual(sorted(re.findall(r"@example (\w+)\.c", pages)), LISTED)
        self.assertEqual(sorted(set(re.findall(r"\\ref (\w+)\.c ", landing))), LISTED)
        self.assertEqual([name for name in LISTED if not hasattr(self, "test_" + name)], [])


if __name__ == "__main__":
    unittest.main()
