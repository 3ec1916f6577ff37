"""`festoon paper`: the comparison with the paper holds, and what it writes is complete and repeatable."""

import html
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

FESTOON = os.environ["FESTOON"]
VERDICTS = {"reproduced", "close", "not reproduced"}

if shutil.which("gnuplot") is None:
    sys.exit(77)


def run(*arguments):
    return subprocess.run([FESTOON, *arguments], capture_output=True, text=True, stdin=subprocess.DEVNULL)


class Paper(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scratch = tempfile.TemporaryDirectory()
        cls.directory = Path(cls.scratch.name) / "paper"
        done = run("paper", "--reduced", "-o", str(cls.directory))
        assert done.returncode == 0, done.stderr
        assert "Table 1" in done.stdout, done.stdout
        cls.paper = json.loads((cls.directory / "paper.json").read_text())
        cls.report = (cls.directory / "report.html").read_text()

    @classmethod
    def tearDownClass(cls):
        cls.scratch.cleanup()

    def statement(self, name):
        return next(s for s in self.paper["statements"] if s["id"] == name)

    # ------------------------------------------------------------ the physics

    def test_table1(self):
        """The printed equations give Table 1 within 1.2 %, with its symmetries; the exact ones do not."""
        rows = self.paper["table1"]
        self.assertEqual([row["omega"] for row in rows], [0.21, 0.25, 0.2845, 0.352, 0.405])
        for row in rows:
            self.assertLess(abs(row["farago2020"] / row["published"] - 1), 0.012, row)
            self.assertEqual(row["farago2020_symmetry"], row["published_symmetry"])
            self.assertEqual(row["farago2020_verdict"], "reproduced")
        self.assertEqual([row["rigid_symmetry"] for row in rows], ["S1", "S1", "S2", "S2", "S2"])

    def test_statements_about_the_patterns(self):
        for name in ("maxima", "fold4-festoons", "fold4-angle", "fold4-nz", "fold4-field", "fold15-festoons",
                     "fold15-angle", "fold15-closed", "fold15-tilt", "magint-least", "magint-aligned",
                     "magint-across", "rolling-alpha", "rolling-phi", "friction", "turning-points", "friction-angle",
                     "fold4-corners", "fold4-conjugate", "shrinking", "frequency-lock", "phase-lock", "rolling-mean",
                     "spin-term", "corotation-beads", "paramagnet", "tondu", "moment", "moment-sign",
                     "kinetic"):
            self.assertEqual(self.statement(name)["verdict"], "reproduced", self.statement(name))

    def test_against_independent_computations(self):
        """Numbers of another program, in another language (numpy and a separate integrator), and by hand."""
        expected = {"fold4-festoons": (4.132030109571, None), "fold4-angle": (4.207983150514, None),
                    "fold4-nz": (0.2649200831467, None), "fold15-angle": (3.157395760617, None),
                    "fold15-tilt": (22.19120612678, None), "magint-least": (0.8932067698746, None),
                    "estimate-energy": (4.57763671875, 4.57763671875), "spacing": (40 / 92, 40 / 92),
                    "estimate-moment": (-2.80618, -2.80618), "dry-weight": (1.09658, 1.09658)}
        for name, values in expected.items():
            statement = self.statement(name)
            for dynamics, value in zip(("farago2020", "rigid"), values):
                if value is not None:
                    self.assertLess(abs(statement[dynamics] / value - 1), 2e-4, statement)

    def test_the_period_halving_is_supercritical(self):
        self.assertLess(abs(self.statement("halving-root")["rigid"] - 0.5), 0.1)
        self.assertLess(abs(self.statement("halving-time")["farago2020"] + 1), 0.3)

    def test_what_the_printed_equations_get_wrong(self):
        """The dropped n_r turns the sign of the magnetic term; the weight alone is too light by an order."""
        for name in ("magnetic-term", "dry-weight", "corotation-force"):
            self.assertEqual(self.statement(name)["verdict"], "not reproduced", self.statement(name))
        self.assertEqual(self.statement("dry-pull")["verdict"], "reproduced")

    def test_what_the_drive_gives_friction_takes(self):
        self.assertLess(self.statement("energy")["farago2020"], 1e-6)

    # ------------------------------------------------------------ what is written

    def test_keys(self):
        for statement in self.paper["statements"]:
            self.assertLessEqual({"section", "published", "farago2020", "rigid", "verdict"}, statement.keys())
            self.assertIn(statement["verdict"], VERDICTS)
            self.assertIn(statement["rigid_verdict"], VERDICTS)
        names = [statement["id"] for statement in self.paper["statements"]]
        self.assertEqual(len(names), len(set(names)))

    def test_figures(self):
        figures = self.paper["figures"]
        self.assertGreaterEqual(len(figures), 24)
        for figure in figures:
            path = self.directory / figure["file"]
            self.assertTrue(path.read_text().rstrip().endswith("</svg>"), figure)
            self.assertTrue(path.with_suffix(".gp").is_file() and path.with_suffix(".dat").is_file())
            self.assertIn(figure["verdict"], VERDICTS | {None})

    def test_nothing_half_made_stays(self):
        endings = {path.suffix for path in self.directory.iterdir()}
        self.assertEqual(endings, {".svg", ".gp", ".dat", ".json", ".html"})

    def test_the_report_needs_nothing_else(self):
        self.assertEqual(self.report.count("<img "), len(self.paper["figures"]))
        for source in re.findall(r'(?:src|href)="([^"]{0,40})', self.report):
            self.assertTrue(source.startswith(("data:image/svg+xml;base64,", "#")), source)
        self.assertNotIn("<script", self.report)
        for target in re.findall(r'href="#([^"]+)"', self.report):
            self.assertIn(f'id="{target}"', self.report)

    def test_commands_of_the_report_repeat_its_numbers(self):
        commands = [html.unescape(text) for text in re.findall(r"<pre>(festoon [^<]*)</pre>", self.report)]
        command = next(c for c in commands if "drive.omega=0.4 " in c and "\n" not in c)
        done = run(*command.split()[1:], "--json")
        self.assertEqual(done.returncode, 0, done.stderr)
        result = json.loads(done.stdout)
        self.assertEqual(result["festoons"], self.statement("fold15-festoons")["farago2020"])
        self.assertEqual(result["max_angle_deg"], self.statement("fold15-angle")["farago2020"])

    def test_again_into_the_same_directory(self):
        """An existing directory is accepted, and the numbers are the same to the last bit."""
        self.assertEqual(run("paper", "--reduced", "-o", str(self.directory)).returncode, 0)
        again = json.loads((self.directory / "paper.json").read_text())
        for document in (again, self.paper):
            document["provenance"].pop("seconds", None)
        self.assertEqual(again, self.paper)

    def test_where_nothing_can_be_written(self):
        blocked = Path(self.scratch.name) / "a file"
        blocked.write_text("")
        done = run("paper", "--reduced", "-o", str(blocked))
        self.assertEqual(done.returncode, 2)
        self.assertIn("a file", done.stderr)
        done = run("paper", "--reduced", "-o", str(blocked / "below"))
        self.assertEqual(done.returncode, 1)


if __name__ == "__main__":
    unittest.main()
