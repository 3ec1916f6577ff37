"""`festoon paper`: what its documentation prints of the whole paper.

Environment: FESTOON_PAPER=reduced leaves it out, because it takes minutes; `make demo` computes the whole paper too.

tests: paper/statements.c paper/json.c
labels: long slow"""

import os
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

FESTOON = os.environ["FESTOON"]

if os.environ.get("FESTOON_PAPER") == "reduced":
    sys.exit(77)


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
        for row, one, other in zip(rows, *curves):  # the bars stand as far to the left as to the right
            self.assertAlmostEqual(float(row[0]), (one[0] + other[0]) / 2)
        for column, curve in enumerate(curves):
            for row, (strength, middle, lowest, percent) in zip(rows, curve):
                self.assertAlmostEqual(float(row[0]), strength, delta=0.02)
                self.assertAlmostEqual(middle, (lowest + percent) / 2, places=6)
                self.assertEqual(row[1 + column], f"{1.5 * percent / 100:.4f}", (row, column))


if __name__ == "__main__":
    unittest.main()
