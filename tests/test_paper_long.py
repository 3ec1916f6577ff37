"""`festoon paper`: every command of paper.json, the slow ones too, prints the number that stands beside it."""

import json
import os
import subprocess
import tempfile
import unittest
from pathlib import Path

FESTOON = os.environ["FESTOON"]


class Commands(unittest.TestCase):
    def test_every_command(self):
        with tempfile.TemporaryDirectory() as scratch:
            subprocess.run([FESTOON, "paper", "--reduced", "-o", scratch], check=True, capture_output=True)
            paper = json.loads((Path(scratch) / "paper.json").read_text())
        printed = {}
        for statement in paper["statements"]:
            for prefix, dynamics in (("", "farago2020"), ("rigid_", "rigid")):
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


if __name__ == "__main__":
    unittest.main()
