"""The examples in C (examples/c): each prints what the program computes, to the last bit, and is a page of the API
reference.  The test `installed` builds them against the installed library, by the line in each.

Environment: FESTOON is the program, SOURCE_DIR the source tree, BUILD_DIR the build tree.
"""

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
        """What the command that stands in the opening comment of an example prints."""
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

    def test_run_with_bad_input(self):
        done = self.example("run", "7 mm")
        self.assertEqual((done.returncode, done.stdout), (1, ""))
        self.assertIn("the nearest is Hz", done.stderr)

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

    def test_each_is_a_page_of_the_reference(self):
        pages = (SOURCES / "docs" / "examples.dox").read_text(encoding="utf-8")
        landing = (SOURCES / "docs" / "api.md").read_text(encoding="utf-8")
        self.assertEqual(sorted(re.findall(r"@example (\w+)\.c", pages)), LISTED)
        self.assertEqual(sorted(set(re.findall(r"\\ref (\w+)\.c ", landing))), LISTED)
        self.assertEqual([name for name in LISTED if not hasattr(self, "test_" + name)], [])


if __name__ == "__main__":
    unittest.main()
