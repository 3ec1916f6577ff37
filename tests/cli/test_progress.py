"""Where standard error is no terminal, work of more than a minute tells every half minute how far it is; --quiet turns this
off, and every command that shows progress has it.

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


class Commands(unittest.TestCase):
    def test_every_command_with_progress_can_be_quiet(self):
        """A command's file that begins progress has the option in its table; no other has it."""
        folder = os.path.join(os.environ["SOURCE_DIR"], "src", "cli")
        help_of = {}
        for name in sorted(os.listdir(folder)):
            if name.endswith(".c"):
                with open(os.path.join(folder, name), encoding="utf-8") as text:
                    source = text.read()
                command = re.search(r'^    \.name = "(\w+)",$', source, re.M)
                if command:
                    help_of[command.group(1)] = ("progress_begin(" in source, "--quiet" in subprocess.run(
                        [FESTOON, command.group(1), "--help"], capture_output=True, text=True, check=True).stdout)
        self.assertGreater(len(help_of), 15)
        help_of.pop("paper")  # a program of its own, which has it
        for command, (begins, has) in help_of.items():
            self.assertEqual(begins, has, command)


if __name__ == "__main__":
    unittest.main(argv=sys.argv)
