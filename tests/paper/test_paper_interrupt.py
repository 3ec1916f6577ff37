"""`festoon paper` interrupted at once, within a long piece of work and on a terminal, and sent to places where it
cannot write. (test_paper_reduced_long.py interrupts it later and compares what is there with the whole paper.)

tests: paper/paper.c paper/work.c
labels: numbers"""

import os
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import events
from paper_interrupted import FESTOON, Interruptions, start

if shutil.which("gnuplot") is None:
    sys.exit(77)


class Interrupted(Interruptions, unittest.TestCase):
    def setUp(self):
        self.scratch = tempfile.TemporaryDirectory()
        self.folder = Path(self.scratch.name)

    def tearDown(self):
        self.scratch.cleanup()

    def test_at_once(self):
        directory = self.cut_short("at-once", Path.is_dir)
        self.check_what_is_there(directory, 0)

    def test_within_a_long_piece(self):
        """A single number whose pieces of work last long: the work ends with the signal, not at the end of a piece."""
        words = [FESTOON, "paper", "--only", "remanence"]
        before = os.times()
        subprocess.run(words, stdout=subprocess.DEVNULL, check=True)
        after = os.times()
        whole = after.children_user + after.children_system - before.children_user - before.children_system

        def spent(process):
            fields = Path(f"/proc/{process.pid}/stat").read_text().rsplit(")", 1)[1].split()
            return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")
        process = subprocess.Popen(words, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        events.wait_for(process, lambda: spent(process) > 0.1 * whole)
        process.send_signal(signal.SIGINT)
        _, status, used = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
        out, messages = process.communicate()
        self.assertEqual((process.returncode, out), (130, ""), messages)
        self.assertLess(used.ru_utime + used.ru_stime, 0.5 * whole)

    def test_progress_and_ctrl_c_on_a_terminal(self):
        """The progress line shows the share done and the time left. Ctrl-C counts as an interruption."""
        self.interrupted_on_a_terminal("runs", r"s left +runs")


class Directories(unittest.TestCase):
    def setUp(self):
        self.scratch = tempfile.TemporaryDirectory()
        self.folder = Path(self.scratch.name)

    def tearDown(self):
        self.scratch.cleanup()

    def fails(self, directory, status, words):
        process = start(directory)
        out, messages = process.communicate()
        self.assertEqual((process.returncode, out), (status, ""), messages)
        self.assertIn(words, messages)

    def test_a_file(self):
        """A file is not a directory, and neither is a place inside it; the file stays as it was."""
        path = self.folder / "a file"
        path.write_text("kept")
        self.fails(path, 2, "a file")
        self.fails(path / "below", 1, "below")
        self.assertEqual(path.read_text(), "kept")

    def test_missing_parents(self):
        self.fails(self.folder / "no" / "such", 1, "such")

    def test_not_writable(self):
        """A sentence says so before anything is computed, and nothing is left there."""
        path = Path("/proc/self") if os.geteuid() == 0 else self.folder / "closed"
        if os.geteuid() != 0:
            path.mkdir(mode=0o555)
        self.fails(path, 1, "paper.json")


if __name__ == "__main__":
    unittest.main()
