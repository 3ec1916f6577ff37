"""A sample of the campaigns against sweeps' files: bits that turn over, and losses of power.

tests: sweep/journal.c sweep/rows.c
labels: long"""

import os
import subprocess
import sys
import unittest


class Campaigns(unittest.TestCase):
    def sample(self, name, count):
        script = os.path.join(os.environ["SOURCE_DIR"], "tests", "reliability", name)
        done = subprocess.run([sys.executable, "-B", script, "--count", str(count), "--seed", "7"],
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        if done.returncode == 77:
            self.skipTest(done.stdout.decode())
        self.assertEqual(done.returncode, 0, done.stderr.decode() + done.stdout.decode())

    def test_bit_rot(self):
        self.sample("rot.py", 60)

    def test_loss_of_power(self):
        self.sample("power.py", 60)


if __name__ == "__main__":
    unittest.main()
