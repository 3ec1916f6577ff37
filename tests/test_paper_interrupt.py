"""`festoon paper` interrupted, watched on a terminal, and sent to places where it cannot write."""

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

import events

FESTOON = os.environ["FESTOON"]

if shutil.which("gnuplot") is None:
    sys.exit(77)


def start(directory, **more):
    return subprocess.Popen([FESTOON, "paper", "--reduced", "-o", str(directory)], stdin=subprocess.DEVNULL,
                            **{"stdout": subprocess.PIPE, "stderr": subprocess.PIPE, "text": True, **more})


class Interrupted(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scratch = tempfile.TemporaryDirectory()
        cls.folder = Path(cls.scratch.name)
        cls.directory = cls.folder / "paper"
        done = start(cls.directory)
        _, messages = done.communicate()
        assert done.returncode == 0, messages
        cls.whole = json.loads((cls.directory / "paper.json").read_text())

    @classmethod
    def tearDownClass(cls):
        cls.scratch.cleanup()

    def check_what_is_there(self, directory, fewest):
        """What remains is valid JSON that says that it is incomplete, a whole page, every figure that is named, and
        numbers equal to those of the whole paper."""
        paper = json.loads((directory / "paper.json").read_text())
        self.assertFalse(paper["complete"])
        page = (directory / "report.html").read_text()
        self.assertIn("Incomplete", page)
        self.assertTrue(page.rstrip().endswith("</html>"))
        whole = {statement["id"]: statement for statement in self.whole["statements"]}
        self.assertTrue(fewest <= len(paper["statements"]) < len(whole), len(paper["statements"]))
        for statement in paper["statements"]:
            said = whole[statement["id"]]
            self.assertEqual(statement, {key: said[key] for key in statement})
            # The column of dry friction comes last: a statement may be there without it.
            self.assertFalse([key for key in said if key not in statement and not key.startswith("coulomb")])
        for figure in paper["figures"]:
            self.assertTrue((directory / figure["file"]).read_text().rstrip().endswith("</svg>"))
        self.assertFalse([path for path in directory.iterdir() if path.suffix not in
                          (".svg", ".gp", ".dat", ".json", ".html")])
        return paper

    def cut_short(self, name, moment, signals=1):
        """Interrupts it when `moment` holds for the folder; if it was over before, it is tried once more."""
        directory = self.folder / name

        def blow(_):
            shutil.rmtree(directory, ignore_errors=True)
            process = start(directory)
            events.wait_for(process, lambda: moment(directory))
            for _ in range(signals):
                process.send_signal(signal.SIGINT)
                time.sleep(0.01)
            out, messages = process.communicate()
            if process.returncode == 0:
                return False
            self.assertEqual((process.returncode, out), (130, ""), messages)
            self.assertIn("marked incomplete", messages)
            paper = json.loads((directory / "paper.json").read_text())
            return len(paper["statements"]) < len(self.whole["statements"])
        events.struck(blow, 1)
        return directory

    def test_at_once(self):
        directory = self.cut_short("at-once", Path.is_dir)
        self.check_what_is_there(directory, 0)

    def test_two_signals_at_once_are_one_interruption(self):
        """Two signals as `timeout -s INT` sends them: to the process and to its group."""
        directory = self.cut_short("twice", lambda d: (d / "sketch.svg").exists(), signals=2)
        self.check_what_is_there(directory, 20)

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

    def test_among_the_figures(self):
        directory = self.cut_short("figures", lambda d: (d / "sketch.svg").exists())
        self.check_what_is_there(directory, 20)

    def test_after_the_first_figures(self):
        directory = self.cut_short("after", lambda d: (d / "om04-rigid.svg").exists() and (d / "test.svg").exists())
        paper = self.check_what_is_there(directory, 40)
        self.assertTrue(any(figure["name"] == "om04-rigid" for figure in paper["figures"]))
        # The same command makes the whole paper, over what is there.
        again = start(directory)
        _, messages = again.communicate()
        self.assertEqual(again.returncode, 0, messages)
        paper = json.loads((directory / "paper.json").read_text())
        self.assertTrue(paper["complete"])
        for document in (paper, self.whole):
            document["provenance"].pop("seconds", None)
            document["provenance"].pop("processor_seconds", None)
            document["provenance"].pop("parts", None)
        self.assertEqual(paper, self.whole)  # to the last bit
        self.assertNotIn("Incomplete", (directory / "report.html").read_text())
        self.assertEqual(sorted(p.name for p in directory.iterdir()), sorted(p.name for p in self.directory.iterdir()))

    def test_progress_and_ctrl_c_on_a_terminal(self):
        """The progress line shows the share done and the time left. Ctrl-C reaches gnuplot as well, and counts as an
        interruption."""
        for name, until in (("runs", r"s left +runs"), ("drawing", r"s left +figures")):
            directory = self.folder / f"terminal-{name}"
            found = None

            def blow(_):
                nonlocal found
                shutil.rmtree(directory, ignore_errors=True)
                found = events.on_a_terminal([FESTOON, "paper", "--reduced", "-o", str(directory)],
                                             lambda text: re.search(until, text), as_key=True)
                return found[0] != 0
            events.struck(blow, 1)
            status, _, shown = found
            self.assertEqual(status, 130, shown)
            self.assertRegex(shown, r"\d+\.\d %  \d+ s left  runs")
            self.check_what_is_there(directory, 0)


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
        """A file is no directory, and neither is a place inside it; the file stays as it was."""
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
