"""Values on the command line: everything behind the first "=" is the value, a list must have the expected number of
values, and a command that fails leaves no file.

tests: cli/options.c cli/values.c"""

import os
import unittest

from sweep_tools import Case


class Options(Case):
    def test_all_behind_the_first_equals_sign_is_the_value(self):
        """No part of a value is dropped, because the rest could be valid by accident."""
        for setting in ("run.periods=abc=50", "run.periods=50=60", "bead.material==hard", "start.r=0.9=0.8"):
            with self.subTest(setting=setting):
                key, value = setting.split("=", 1)
                err = self.refused("check", "--set", setting)
                self.assertIn(key, err)
                self.assertIn(value, err)

    def test_lists_have_their_length(self):
        """A list with too few numbers, too many, or text behind them is refused."""
        self.good("run", "--set", "run.periods=2", "--set", "run.discard=1", "-o", self.path("t.csv"))
        for zoom in ("1,2,3", "1,2,3,4,5", "1,2,3,4,", "1,2,3,4 mm", "1;2;3;4", ""):
            with self.subTest(zoom=zoom):
                self.assertIn("zoom", self.refused("plot", self.path("t.csv"), "-o", self.path("f.svg"), "--zoom", zoom))
                self.assertFalse(os.path.exists(self.path("f.svg")))
        for number in ("1,2", "one", "1 period", ""):
            with self.subTest(number=number):
                err = self.refused("plot", self.path("t.csv"), "-o", self.path("f.svg"), "--from", number)
                self.assertIn(f'--from: "{number}" must be a number, without a unit', err)

    def test_seconds_between_checkpoints(self):
        """Seconds are a positive number without a unit; the command does not begin with any other value."""
        for seconds, word in (("0", "positive seconds"), ("-1", "positive seconds"), ("1e10", "positive seconds"),
                              ("nan", "a number"), ("inf", "a number"), ("3s", "without a unit"), ("", "a number")):
            with self.subTest(seconds=seconds):
                err = self.refused("sweep", "--over", "drive.frequency=10,11", "-o", self.path("a.db"), "--checkpoint", seconds)
                self.assertIn(f'--checkpoint: "{seconds}" must be ', err)
                self.assertIn(word, err)
                self.assertFalse(os.path.exists(self.path("a.db")))

    def test_a_failed_run_leaves_no_file(self):
        """A start that does not exist makes no trajectory, and leaves the file of an earlier run as it was."""
        impossible = ["--set", "model.eps=0.2", "--set", "start.r=0.2", "--set", "start.spin=rolling"]
        self.refused("run", *impossible, "-o", self.path("new.csv"))
        self.assertEqual(os.listdir(self.directory), [])
        self.good("run", "--set", "run.periods=2", "--set", "run.discard=1", "-o", self.path("t.csv"))
        self.refused("run", *impossible, "-o", self.path("t.csv"))
        self.assertEqual(os.listdir(self.directory), ["t.csv"])


if __name__ == "__main__":
    unittest.main()
