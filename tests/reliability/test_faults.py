"""A small sample of tests/reliability/faults.py: commands that write files to disks that fail.

tests: host/whole_file.c"""

import os
import subprocess
import sys
import unittest

SCRIPT = os.path.join(os.environ["SOURCE_DIR"], "tests", "reliability", "faults.py")
COUNT = os.environ.get("FESTOON_FAULT_COUNT", "30")
COMMANDS = ("run -o .csv", "run -o .h5", "export --json", "plot .csv -o .svg", "movie -o .mp4")


class Faults(unittest.TestCase):
    def test_sample(self):
        words = [sys.executable, "-B", SCRIPT, "--count", COUNT]
        for name in COMMANDS:
            words += ["--command", name]
        done = subprocess.run(words, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
        text = done.stdout.decode(errors="replace")
        if done.returncode == 77:
            self.skipTest(text)
        self.assertEqual(done.returncode, 0, text)
        self.assertIn(" 0 broken promises", text)


if __name__ == "__main__":
    if subprocess.run([sys.executable, "-B", SCRIPT, "--count", "0", "--command", "none"], stdin=subprocess.DEVNULL,
                      stdout=subprocess.DEVNULL).returncode == 77:
        sys.exit(77)
    unittest.main()
