"""Where standard error is not a terminal, work of more than a minute tells every half minute how far it is; --quiet turns this
off.

tests: cli/terminal.c cli/program.c"""

import os
import re
import signal
import subprocess
import sys
import unittest

import events

FESTOON = os.environ["FESTOON"]
PRELOADED = os.path.join(os.environ["BUILD_DIR"], "tests")
LONG = [FESTOON, "run", "--set", "drive.frequency=10.7Hz", "--set", "run.periods=1e8", "--set", "run.rtol=1e-12"]


@unittest.skipUnless(os.path.exists(os.path.join(PRELOADED, "clock_fast.so")), "sanitizers exclude preloaded libraries")
class Lines(unittest.TestCase):
    def told(self, *options, lines):
        """The lines of a run's standard error, whose clock is fast, up to the one of this number; then it is interrupted."""
        environment = dict(os.environ, LD_PRELOAD=os.path.join(PRELOADED, "clock_fast.so"))
        process = subprocess.Popen([*LONG, *options], stderr=subprocess.PIPE, stdout=subprocess.DEVNULL, text=True,
                                   env=environment)
        found = [process.stderr.readline() for _ in range(lines)]
        process.send_signal(signal.SIGINT)
        rest = process.communicate(timeout=events.HANG)[1]
        self.assertEqual(process.returncode, 130)
        return found, rest

    def test_a_line_every_half_minute(self):
        found, _ = self.told(lines=4)
        times = []
        for line in found:
            self.assertRegex(line, r"^ *[0-9.]+ %  after \d+ s  +[0-9.e+]+ \w+ left.*\n$")
            times.append(int(re.search(r"after (\d+) s", line).group(1)))
        self.assertGreaterEqual(times[0], 60)
        for one, other in zip(times, times[1:]):
            self.assertGreaterEqual(other - one, 29)  # both are rounded

    def test_quiet(self):
        """As much work as writes lines otherwise writes none: a second program at its side tells when."""
        environment = dict(os.environ, LD_PRELOAD=os.path.join(PRELOADED, "clock_fast.so"))
        quiet = subprocess.Popen([*LONG, "--quiet"], stderr=subprocess.PIPE, stdout=subprocess.DEVNULL, text=True, env=environment)
        self.told(lines=3)
        quiet.send_signal(signal.SIGINT)
        said = quiet.communicate(timeout=events.HANG)[1]
        self.assertEqual(quiet.returncode, 130)
        self.assertRegex(said, r"^festoon: interrupted after [^\n]*\n$")


if __name__ == "__main__":
    unittest.main(argv=sys.argv)
