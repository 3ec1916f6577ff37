"""A small, fixed sample of the study tests/reliability/regimes.py: a run and one ten times as long get the same
regime.

The seed is not the published one; the sample is small enough that a single contradiction is a finding.

tests: study/regime.c
labels: numbers"""

import importlib.util
import os
import tempfile
import unittest

SOURCE_DIR = os.environ["SOURCE_DIR"]
PATH = os.path.join(SOURCE_DIR, "tests", "reliability", "regimes.py")


def load_study():
    spec = importlib.util.spec_from_file_location("regimes", PATH)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


class Sample(unittest.TestCase):
    def test_longer_runs_agree(self):
        study = load_study()
        with tempfile.TemporaryDirectory(prefix="festoon-regimes-") as directory:
            study.BATCH = 20
            pairs = study.study(240, 11, False, True, directory, 1, lambda text: None)
        self.assertEqual(len(pairs), 240)
        table = study.outcomes(pairs)
        for regime in ("locked", "librating", "counter-rotating", "corotating"):
            for longer, count in table[regime].items():
                self.assertIn(longer, (regime, "undecided"), f"{count} of {dict(table[regime])} were called {regime}")
        called = sum(sum(table[regime].values()) for regime in ("locked", "librating", "counter-rotating"))
        same = sum(table[regime][regime] for regime in ("locked", "librating", "counter-rotating"))
        self.assertGreater(called, 60)
        self.assertGreaterEqual(same, 0.98 * called)
        self.assertLess(sum(table["undecided"].values()), 90)

    def test_intervals(self):
        study = load_study()
        low, high = study.wilson(0, 100)  # Brown, Cai and DasGupta, Stat. Sci. 16, 101 (2001)
        self.assertEqual(low, 0.0)
        self.assertAlmostEqual(high, 0.0370, 4)
        low, high = study.wilson(5, 50)
        self.assertAlmostEqual(low, 0.0435, 4)
        self.assertAlmostEqual(high, 0.2136, 4)


if __name__ == "__main__":
    unittest.main()
