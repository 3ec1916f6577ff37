"""Parts of `festoon paper` that need no whole paper: statements alone, the list of them, the large maps, bad input.
(The paper: test_paper_reduced_long.py.)

tests: paper/main.c paper/probes.c paper/statements.c paper/dry_maps.c cli/paper.c
labels: numbers"""

import json
import math
import os
import signal
import subprocess
import tempfile
import time
import unittest
from pathlib import Path

import bead_by_hand as hand
from paper_by_hand import repeat, run

FESTOON = os.environ["FESTOON"]


class Parts(unittest.TestCase):
    def test_the_rules_in_the_documentation(self):
        """docs/paper.md has the rules of `festoon paper --statements`, line by line."""
        done = run("paper", "--statements")
        self.assertEqual(done.returncode, 0, done.stderr)
        page = (Path(os.environ["SOURCE_DIR"]) / "docs" / "paper.md").read_text()
        self.assertIn("\n\n" + done.stdout.split("\n\n")[0] + "\n\n", page)

    def test_statements_alone(self):
        """Against another program in another language, by hand, and by the command that stands beside each number."""
        for name, expected, verdict in (("magint-least", 0.8932067698746, "reproduced"),
                                        ("estimate-moment", 1.5625e-3, "close"),  # 2.5e-3^3 1e5/1
                                        ("dry-weight", 12.49048, "close"),  # 0.2 9.81/(2.5e-3 2 pi 10)
                                        ("spacing", 40 / 92, "reproduced")):
            done = run("paper", "--only", name)
            self.assertEqual(done.returncode, 0, done.stderr)
            statement = json.loads(done.stdout)
            self.assertLess(abs(statement["farago2020"] / expected - 1), 2e-4, statement)
            self.assertEqual(statement["verdict"], verdict, statement)
            for prefix, dynamics in (("", "farago2020"), ("rigid_", "rigid")):
                printed = repeat(statement[prefix + "command"])
                self.assertEqual(printed[statement[prefix + "reads"]], statement[dynamics], name)

    def test_the_slipping_lock_by_hand(self):
        """At 7 Hz the bead that rubs dry locks beside the magnet and slips: the five equations of that state, written
        here.  At 8 Hz, beyond the fold of such states, it leaves the plate."""
        dry = ["--set", "friction.law=coulomb", "--set", "friction.mu=0.2", "--set", "run.rtol=1e-10", "--json"]
        locked = json.loads(run("run", *dry, "--set", "drive.frequency=7Hz").stdout)
        self.assertEqual(locked["regime"], "locked")
        x, y, vx, vy, *rest = locked["final_state"]
        n, w, omega = rest[:3], rest[3:], locked["omega"]
        eps, kappa = 2.5 / 23, 1.5
        b, gradient = hand.field(x, y, 0.0)
        force = [kappa * eps ** 2 * hand.dot(n, [gradient[j][i] for j in range(3)]) for i in range(3)]
        torque = [kappa * eps ** 2 * c for c in hand.cross(n, b)]
        load = 9.81 / (0.023 * 312.5 ** 2) - force[2]
        slip = [vx - eps * w[1], vy + eps * w[0]]
        friction = [0.2 * load * s / math.hypot(*slip) for s in slip]
        turning = hand.cross([0, 0, omega], w)
        e_cross_f = [-friction[1], friction[0], 0.0]
        left = [-omega ** 2 * x - force[0] + friction[0], -omega ** 2 * y - force[1] + friction[1]]
        left += [2 * eps ** 2 / 5 * turning[i] - torque[i] - eps * e_cross_f[i] for i in range(3)]
        self.assertLess(max(map(abs, left)), 1e-8, left)
        self.assertGreater(math.hypot(*slip), 0.1)
        gone = json.loads(run("run", *dry, "--set", "drive.frequency=8Hz").stdout)
        self.assertEqual(gone["regime"], "ejected")

    def test_the_large_maps_go_on_where_they_were_interrupted(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        directory = Path(scratch.name) / "maps"
        database = directory / "dry-map-rolling-far.db"
        process = subprocess.Popen([FESTOON, "paper", "--dry-maps", "-o", str(directory)], stdin=subprocess.DEVNULL,
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        while process.poll() is None and not database.exists():
            time.sleep(0.01)
        process.send_signal(signal.SIGINT)
        out, messages = process.communicate()
        self.assertEqual((process.returncode, out), (130, ""), messages)
        self.assertIn("the same command goes on", messages)
        self.assertEqual(run("export", str(database), "--csv").returncode, 0)
        self.assertFalse((directory / "dry-maps.csv").exists())
        for wrong in (["--dry-maps"], ["--dry-maps", "--reduced", "-o", str(directory)]):
            done = run("paper", *wrong)
            self.assertEqual((done.returncode, done.stdout), (2, ""))

    def test_no_such_statement(self):
        done = run("paper", "--only", "maximum")
        self.assertEqual((done.returncode, done.stdout), (2, ""))
        self.assertIn("the nearest is maxima", done.stderr)
        self.assertEqual(run("paper", "--only", "maxima", "-o", "x").returncode, 2)


if __name__ == "__main__":
    unittest.main()
