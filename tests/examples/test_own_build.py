"""The commands in examples/c/field.c and law.c, as a user types them, but that the build is not optimised, which takes a
fifth of the time and computes the same bits, and has no more than the program: festoon with a magnet and a friction law
of one's own.  The examples print
what test_examples_c.py compares, and the program knows magnet and law.

labels: long"""

import json
import os
import re
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

SOURCES = Path(os.environ["SOURCE_DIR"]).resolve()
PROGRAMS = Path(os.environ["BUILD_DIR"]) / "tests" / "examples"


def output_of(command, folder):
    done = subprocess.run(["sh", "-c", command], cwd=folder, stdin=subprocess.DEVNULL, capture_output=True, text=True,
                          check=False)
    if done.returncode != 0:
        raise AssertionError(f"$ {command}\n{done.stdout[-3000:]}{done.stderr[-3000:]}")
    return done.stdout


class OwnBuild(unittest.TestCase):
    def test_the_commands_of_the_examples(self):
        with tempfile.TemporaryDirectory(prefix="festoon-own-") as name:
            folder = Path(name)
            for part in SOURCES.iterdir():  # the source tree, where the user stands, without writing into it
                if part.name not in ("field", "law", "build-own"):
                    (folder / part.name).symlink_to(part)
            for example in ("field", "law"):
                text = (SOURCES / "examples" / "c" / (example + ".c")).read_text(encoding="utf-8")
                commands = re.findall(r"^ \*     (\S.*)$", text, re.M)
                self.assertIn("-DCMAKE_BUILD_TYPE=Release", commands[0])
                commands[0] = commands[0].replace("Release", "Debug")
                commands[1] += " --target festoon_program"
                self.assertEqual(len(commands), 4)
                printed = [output_of(command, folder) for command in commands][-1]
                expected = output_of(str(PROGRAMS / example), folder)
                self.assertEqual(printed, expected)
            program = "build-own/festoon run --json --set drive.frequency=20Hz --set "
            radius = json.loads(output_of(program + "magnet.shape=charges --set own.reach=0.9 --set own.charge=4.5",
                                          folder))["mean_r"]
            self.assertIn(f"two charges: counter-rotating, r = {radius:.17g}\n", output_of("./field", PROGRAMS))
            self.assertEqual(json.loads(output_of(program + "friction.law=quadratic", folder))["regime"], "counter-rotating")
            if shutil.which("gnuplot"):
                output_of("build-own/festoon field --set magnet.shape=charges -o charges.svg", folder)
                for name in ("charges.dat", "charges.gp"):  # where no bar of lines is marked
                    self.assertNotIn("the magnet's lines", (folder / name).read_text(encoding="utf-8").replace("''", "'"))
            refused = subprocess.run([folder / "build-own/festoon", "run", "--set", "magnet.shape=charge"],
                                     capture_output=True, text=True, check=False)
            self.assertEqual(refused.returncode, 2)
            self.assertIn("charges", refused.stderr)


if __name__ == "__main__":
    unittest.main()
