"""`festoon lyapunov` and the exponents of long runs report their progress and end at the first signal.

tests: cli/lyapunov.c"""

import os
import pty
import re
import signal
import subprocess
import unittest

FESTOON = os.environ["FESTOON"]


class Long(unittest.TestCase):
    def interrupt(self, words, beyond=0.0):
        """Starts a command on a terminal, waits until the progress shows more than `beyond` per cent, and sends one
        signal."""
        leader, follower = pty.openpty()
        program = subprocess.Popen([FESTOON, *words], stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=follower)
        os.close(follower)
        shown = ""
        try:
            while not any(float(number) >= beyond for number in re.findall(r"([\d.]+) %", shown)):
                shown += os.read(leader, 4096).decode()
            program.send_signal(signal.SIGINT)
            while True:  # reads until the terminal closes: the program has ended
                try:
                    piece = os.read(leader, 4096)
                except OSError:
                    break
                if not piece:
                    break
                shown += piece.decode()
            out, _ = program.communicate()
        finally:
            program.kill()
            program.wait()
            os.close(leader)
        self.assertEqual((program.returncode, out), (130, b""), shown)
        self.assertIn("interrupted", shown)
        return shown

    def test_lyapunov_at_a_slow_drive(self):
        self.interrupt(["lyapunov", "--set", "drive.frequency=1e-6"])

    def test_lyapunov_of_more_periods_than_an_integer_counts_pieces(self):
        self.interrupt(["lyapunov", "--set", "run.periods=1e9", "--set", "run.discard=0", "--json"])

    def test_lyapunov_during_a_long_discard(self):
        self.interrupt(["lyapunov", "--set", "run.periods=1e9", "--set", "run.discard=9e8"])

    def test_the_exponent_of_a_long_libration(self):
        """The steps of a run are 70 % of its progress; the exponent is the rest."""
        self.interrupt(["run", "--set", "drive.omega=0.11", "--set", "run.periods=20000", "--set", "run.discard=10",
                        "--set", "run.rtol=1e-6"], beyond=70.5)


if __name__ == "__main__":
    unittest.main()
