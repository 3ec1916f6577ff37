"""`festoon paper` interrupted among its figures: what is there equals the whole paper, and the same command ends it.

tests: paper/paper.c paper/work.c
labels: long"""

import json
import shutil
import sys
import tempfile
import unittest
from pathlib import Path

from paper_interrupted import Interruptions, start

if shutil.which("gnuplot") is None:
    sys.exit(77)


class Interrupted(Interruptions, unittest.TestCase):
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

    def test_two_signals_at_once_are_one_interruption(self):
        """Two signals as `timeout -s INT` sends them: to the process and to its group."""
        directory = self.cut_short("twice", lambda d: (d / "sketch.svg").exists(), signals=2)
        self.check_what_is_there(directory, 20)

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

    def test_ctrl_c_while_figures_are_drawn(self):
        """Ctrl-C on a terminal reaches gnuplot as well."""
        self.interrupted_on_a_terminal("drawing", r"s left +figures")


if __name__ == "__main__":
    unittest.main()
