"""`festoon paper`: the comparison with the paper holds, and what it writes is complete and repeatable."""

import html
import json
import os
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time
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
                     "fold15-angle", "fold15-closed", "magint-least", "magint-aligned",
                     "magint-across", "rolling-alpha", "rolling-phi", "friction", "turning-points", "friction-angle",
                     "fold4-corners", "fold4-conjugate", "shrinking", "frequency-lock", "phase-lock", "rolling-mean",
                     "spin-term", "corotation-beads", "paramagnet", "tondu", "moment", "moment-sign",
                     "kinetic", "rolling-identity", "ball-mean", "sine-law", "least-energy", "modulation",
                     "friction-outside", "slow-pole", "slow-parallel"):
            self.assertEqual(self.statement(name)["verdict"], "reproduced", self.statement(name))

    def test_against_independent_computations(self):
        """Numbers of another program, in another language (numpy and a separate integrator), and by hand."""
        expected = {"fold4-festoons": (4.132030109571, None), "fold4-angle": (4.207983150514, None),
                    "fold4-nz": (0.2649200831467, None), "fold15-angle": (3.157395760617, None),
                    "fold15-tilt": (22.19120612678, None), "magint-least": (0.8932067698746, None),
                    "estimate-energy": (4.57763671875, 4.57763671875), "spacing": (40 / 92, 40 / 92),
                    "estimate-moment": (1.5625e-3, 1.5625e-3),  # 2.5e-3^3 1e5/1
                    "dry-weight": (12.49048, 12.49048),  # 0.2 9.81/(2.5e-3 2 pi 10)
                    "estimate-corotation": (8.109117345, 8.109117345)}  # 1.5 2.5e-3 312.5/0.023/(2 pi)
        for name, values in expected.items():
            statement = self.statement(name)
            for dynamics, value in zip(("farago2020", "rigid"), values):
                if value is not None:
                    self.assertLess(abs(statement[dynamics] / value - 1), 2e-4, statement)

    def test_table1_closes_where_the_orbits_do(self):
        """The drives at which patterns close, against the search over the whole branch (`orbit --festoons`)."""
        for row, dynamics in ((0, "farago2020"), (4, "rigid")):
            count = self.paper["table1"][row]["count"]
            done = run("orbit", "--festoons", str(count), "--set", f"model.dynamics={dynamics}", "--json")
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertLess(abs(json.loads(done.stdout)["omega"] - self.paper["table1"][row][f"{dynamics}_closes_at"]),
                            1e-9)
        self.assertIsNone(self.paper["table1"][2]["rigid_closes_at"])

    def test_the_period_halving_is_supercritical(self):
        """The pitchfork of the orbits is where settled runs lose their asymmetry, as its square root."""
        self.assertLess(abs(self.statement("halving-root")["rigid"] - 0.5), 0.1)
        self.assertLess(abs(self.statement("halving-time")["farago2020"] + 1), 0.1)
        for dynamics in ("farago2020", "rigid"):
            self.assertEqual(self.statement("halving-branch")[dynamics], 1)
            line = float(re.search(r"vanishes(?: at ω = |: )([0-9.]+\d)", self.statement("halving")[f"{dynamics}_note"])[1])
            self.assertLess(abs(line - self.statement("halving")[dynamics]), 2e-3)

    def test_what_the_printed_equations_get_wrong(self):
        """The dropped n_r turns the sign of the magnetic term; the weight alone is too light by an order."""
        for name in ("magnetic-term", "corotation-force"):
            self.assertEqual(self.statement(name)["verdict"], "not reproduced", self.statement(name))
        self.assertLess(self.statement("dry-weight")["rigid"], 0.1 * self.statement("dry-pull")["rigid"])
        self.assertEqual(self.statement("dry-pull")["verdict"], "reproduced")

    def test_what_the_drive_gives_friction_takes(self):
        self.assertLess(self.statement("energy")["farago2020"], 1e-6)

    def test_a_locked_bead_does_not_slip(self):
        """No magnetic torque acts along n, so the spin about it grows until the contact is at rest."""
        done = run("locked", "--set", "drive.omega=0.05", "--json")
        self.assertEqual(done.returncode, 0, done.stderr)
        slips = [state["slip"] for state in json.loads(done.stdout)["states"] if state["stable"]]
        self.assertTrue(slips and max(slips) < 1e-12, slips)
        slowest = json.loads(run("run", "--set", "drive.omega=0.02", "--set", "start.spin=rest", "--json").stdout)
        self.assertEqual(slowest["regime"], "locked")
        self.assertLess(slowest["mean_friction_power"], 1e-12)

    # ------------------------------------------------------------ what is written

    def test_the_list_in_the_documentation(self):
        """docs/paper.md has the list that the program makes."""
        done = run("paper", "--statements")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn(done.stdout.strip(), (Path(os.environ["SOURCE_DIR"]) / "docs" / "paper.md").read_text())
        self.assertEqual(done.stdout.count("\n| ") - 3 - 9, len(self.paper["statements"]))

    def test_verdicts_follow_their_rules(self):
        """Each verdict, made again from value, published value and the limits of the criterion."""
        for statement in self.paper["statements"]:
            limits = re.match(r"(number|limit); reproduced: (.*); close: (.*)", statement["criterion"])
            if not limits:
                continue
            for dynamics in ("farago2020", "rigid"):
                expected = "not reproduced"
                for verdict, text in (("close", limits[3]), ("reproduced", limits[2])):
                    ends = [float(x) for x in re.findall(r"-?\d[\d.e+-]*", text)]
                    if limits[1] == "limit":
                        ends.insert(0, float("-inf"))
                    if ends[0] <= statement[dynamics] <= ends[1]:
                        expected = verdict
                key = "verdict" if dynamics == "farago2020" else "rigid_verdict"
                self.assertEqual(statement[key], expected, statement)

    def test_interrupted(self):
        """What was done until then stays, marked incomplete, with status 130."""
        directory = Path(self.scratch.name) / "interrupted"
        process = subprocess.Popen([FESTOON, "paper", "--reduced", "-o", str(directory)], stdin=subprocess.DEVNULL,
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        deadline = time.monotonic() + 600
        while not (directory / "om04-rigid.svg").exists() and time.monotonic() < deadline:
            time.sleep(0.02)
        process.send_signal(signal.SIGINT)
        out, messages = process.communicate()
        self.assertEqual(process.returncode, 130, messages)
        self.assertEqual(out, "")
        paper = json.loads((directory / "paper.json").read_text())
        self.assertFalse(paper["complete"])
        self.assertEqual(paper["table1"], [dict(row, farago2020_closes_at=None, farago2020_closes_with=None,
                                                rigid_closes_at=None, rigid_closes_with=None)
                                           for row in self.paper["table1"]])
        whole = {statement["id"]: statement for statement in self.paper["statements"]}
        self.assertTrue(0 < len(paper["statements"]) < len(whole))
        for statement in paper["statements"]:
            self.assertEqual(statement, whole[statement["id"]])
        self.assertTrue(any(figure["name"] == "om04-rigid" for figure in paper["figures"]))
        for figure in paper["figures"]:
            self.assertTrue((directory / figure["file"]).is_file())
        self.assertIn("Incomplete", (directory / "report.html").read_text())

    def test_without_lapack(self):
        """A sentence stands for what needs the orbits, and the rest of the paper is there."""
        program = Path(FESTOON)
        alone = Path(self.scratch.name) / "alone"
        alone.mkdir()
        for name in program.parent.iterdir():
            if name.is_file() and (name.name == "festoon" or ".so" in name.name) and "lapack" not in name.name:
                shutil.copy2(name, alone / name.name)
        directory = alone / "paper"
        done = subprocess.run([str(alone / "festoon"), "paper", "--reduced", "-o", str(directory)], capture_output=True,
                              text=True, env={**os.environ, "LD_LIBRARY_PATH": str(alone)})
        self.assertEqual(done.returncode, 0, done.stderr)
        paper = json.loads((directory / "paper.json").read_text())
        self.assertTrue(paper["complete"])
        self.assertIn("LAPACK", paper["orbits"]["rigid"]["missing"])
        halving = next(s for s in paper["statements"] if s["id"] == "halving")
        self.assertLess(abs(halving["rigid"] - self.statement("halving")["rigid"]), 2e-3)

    def test_keys(self):
        for statement in self.paper["statements"]:
            self.assertLessEqual({"section", "published", "farago2020", "rigid", "verdict"}, statement.keys())
            self.assertIn(statement["verdict"], VERDICTS)
            self.assertIn(statement["rigid_verdict"], VERDICTS)
        names = [statement["id"] for statement in self.paper["statements"]]
        self.assertEqual(len(names), len(set(names)))

    def test_figures(self):
        figures = self.paper["figures"]
        self.assertGreaterEqual(len(figures), 22)
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
