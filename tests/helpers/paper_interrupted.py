"""Helps tests that interrupt `festoon paper` and look at what it leaves."""

import json
import os
import re
import shutil
import signal
import subprocess
import time

import events

FESTOON = os.environ["FESTOON"]


def start(directory, **more):
    return subprocess.Popen([FESTOON, "paper", "--reduced", "-o", str(directory)], stdin=subprocess.DEVNULL,
                            **{"stdout": subprocess.PIPE, "stderr": subprocess.PIPE, "text": True, **more})


def without_dry(statement):
    return {key: without_dry(value) if isinstance(value, dict) else value for key, value in statement.items()
            if not key.startswith("coulomb")}


class Interruptions:
    """For a test case that has `folder`, and in `whole` the document of a paper that was not interrupted (None if
    what remains is only checked in itself)."""
    whole = None

    def check_what_is_there(self, directory, fewest):
        """What remains is valid JSON that says that it is incomplete, a whole page, every figure that is named, and
        numbers equal to those of the whole paper."""
        paper = json.loads((directory / "paper.json").read_text())
        self.assertFalse(paper["complete"])
        page = (directory / "report.html").read_text()
        self.assertIn("Incomplete", page)
        self.assertTrue(page.rstrip().endswith("</html>"))
        self.assertGreaterEqual(len(paper["statements"]), fewest)
        self.equals_the_whole(paper)
        for figure in paper["figures"]:
            self.assertTrue((directory / figure["file"]).read_text().rstrip().endswith("</svg>"))
        self.assertFalse([path for path in directory.iterdir() if path.suffix not in
                          (".svg", ".gp", ".dat", ".json", ".html")])
        return paper

    def equals_the_whole(self, paper):
        if self.whole is None:
            return
        whole = {statement["id"]: statement for statement in self.whole["statements"]}
        self.assertLess(len(paper["statements"]), len(whole))
        for statement in paper["statements"]:
            said = whole[statement["id"]]
            # The column of dry friction comes last: a statement, and its second reading, may be there without it.
            without = said if "coulomb" in statement else without_dry(said)
            self.assertEqual(statement if "coulomb" in statement else without_dry(statement), without)

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
            return not paper["complete"]
        events.struck(blow, 1)
        return directory

    def interrupted_on_a_terminal(self, name, until):
        """Presses Ctrl-C when the progress line matches `until`."""
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
