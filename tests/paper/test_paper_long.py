"""`festoon paper`: every command of paper.json, the slow ones too, prints the number that stands beside it.

tests: paper/statements.c paper/json.c
labels: long slow"""

import html
import json
import os
import re
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

FESTOON = os.environ["FESTOON"]
REDUCED = tempfile.TemporaryDirectory()  # a reduced paper, made once


def setUpModule():
    subprocess.run([FESTOON, "paper", "--reduced", "-o", REDUCED.name], check=True, capture_output=True)


def tearDownModule():
    REDUCED.cleanup()


class Commands(unittest.TestCase):
    def setUp(self):
        self.paper = json.loads((Path(REDUCED.name) / "paper.json").read_text())

    def test_without_lapack(self):
        """Without LAPACK a sentence stands for every number that needs orbits, and the rest of the paper is there."""
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        alone = Path(scratch.name)
        for name in Path(FESTOON).parent.iterdir():
            if name.is_file() and (name.name in ("festoon", "festoon-paper") or ".so" in name.name) and "lapack" not in name.name:
                shutil.copy2(name, alone / name.name)
        directory = alone / "paper"
        done = subprocess.run([str(alone / "festoon"), "paper", "--reduced", "-o", str(directory)], capture_output=True,
                              text=True, env={**os.environ, "LD_LIBRARY_PATH": str(alone)})
        self.assertEqual(done.returncode, 0, done.stderr)
        paper = json.loads((directory / "paper.json").read_text())
        self.assertTrue(paper["complete"])
        self.assertIn("LAPACK", paper["orbits"]["rigid"]["missing"])
        halving, with_orbits = ([s["rigid"] for s in p["statements"] if s["id"] == "halving"][0]
                                for p in (paper, self.paper))
        self.assertLess(abs(halving - with_orbits), 2e-3)

    def test_every_command(self):
        printed = {}
        for statement in self.paper["statements"]:
            for prefix, dynamics in (("", "farago2020"), ("rigid_", "rigid"), ("coulomb_", "coulomb")):
                if dynamics not in statement:
                    continue
                command = statement[prefix + "command"]
                if command not in printed:
                    done = subprocess.run([FESTOON, *command.split()[1:]], capture_output=True, text=True)
                    self.assertEqual(done.returncode, 0, (command, done.stderr))
                    printed[command] = json.loads(done.stdout)
                value = eval(statement[prefix + "reads"], {"__builtins__": {}, "abs": abs, "max": max}, printed[command])
                expected = statement[dynamics]
                if isinstance(expected, (str, type(None))):
                    self.assertEqual(value, expected, command)
                else:
                    self.assertLessEqual(abs(value - expected), 1e-12 * abs(expected), command)
        self.assertGreater(len(printed), 70)


FRAME = """<iframe id="page" src="report.html" style="border:0;width:{0}px;height:900px"></iframe><pre id="said"></pre>
<script>onload = () => {{
  const page = document.getElementById("page").contentDocument;
  const wide = [...page.querySelectorAll("*")].filter(e => e.getBoundingClientRect().right > {0} + 1).map(e => e.outerHTML);
  document.getElementById("said").textContent = JSON.stringify([page.documentElement.scrollWidth, wide.slice(0, 3)]);
}}</script>"""


class Browser(unittest.TestCase):
    @unittest.skipUnless(shutil.which("chromium"), "there is no chromium")
    def test_nothing_is_wider_than_a_phone(self):
        """In a browser, 390 pixels wide, no part of the report reaches beyond the edge."""
        for width in (390, 1000):
            (Path(REDUCED.name) / "frame.html").write_text(FRAME.format(width))
            page = subprocess.run(["chromium", "--headless", "--no-sandbox", "--disable-gpu",
                                   "--allow-file-access-from-files", f"--user-data-dir={REDUCED.name}/browser",
                                   "--virtual-time-budget=20000", "--dump-dom", f"file://{REDUCED.name}/frame.html"],
                                  capture_output=True, text=True).stdout
            said = json.loads(html.unescape(re.search(r'<pre id="said">(.*?)</pre>', page, re.S)[1]))
            self.assertLessEqual(said[0], width, said)
            self.assertEqual(said[1], [])


class Documentation(unittest.TestCase):
    def test_the_table_of_remanence_is_what_the_program_finds(self):
        """docs/paper.md prints what the figure is drawn from, which no reduced paper has."""
        text = (Path(os.environ["SOURCE_DIR"]) / "docs" / "paper.md").read_text()
        rows = re.findall(r"^\| ([\d.]+)e-3 \| ([\d.]+) \| ([\d.]+) \|$", text, re.MULTILINE)
        with tempfile.TemporaryDirectory() as scratch:
            subprocess.run([FESTOON, "paper", "-o", scratch], check=True, capture_output=True)
            data = (Path(scratch) / "remanence.dat").read_text()
        # A point of the figure: its strength (a little beside it, so that bars do not hide each other), and the bracket's
        # middle, lower and upper end.  The table prints the upper end, the least strength that was seen to suffice.
        curves = [[tuple(map(float, line.split())) for line in block.splitlines() if line and line[0] != "#"]
                  for block in data.split("\n\n\n") if re.search(r"^# panel\d+-curve", block, re.M)]
        self.assertEqual((len(curves), len(rows)), (2, len(curves[0])))
        for column, curve in enumerate(curves):
            for row, (strength, middle, lowest, percent) in zip(rows, curve):
                self.assertAlmostEqual(float(row[0]), strength, delta=0.02)
                self.assertAlmostEqual(middle, (lowest + percent) / 2, places=6)
                self.assertEqual(row[1 + column], f"{1.5 * percent / 100:.4f}", (row, column))


if __name__ == "__main__":
    unittest.main()
