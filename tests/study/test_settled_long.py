"""A map of regimes is the same whether runs end once they have settled or not, and so are the means within their
errors.

tests: study/settle.c
labels: long"""

import os
import sqlite3
import subprocess
import tempfile
import unittest

FESTOON = os.environ["FESTOON"]
KEYS = ("regime", "symmetry", "settled_at", "mean_r", "mean_r_error", "mean_nz", "mean_nz_error", "max_r", "rhs_calls")


def rows_of(directory, name, *settings):
    """The rows of a map of frequency and kappa, as dictionaries by their points."""
    path = os.path.join(directory, name + ".db")
    command = [FESTOON, "sweep", "--over", "drive.frequency=1:40:32", "--over", "model.kappa=0.1:3:32", "-o", path]
    for setting in settings:
        command += ["--set", setting]
    subprocess.run(command, check=True, capture_output=True)
    database = sqlite3.connect(path)
    found = database.execute("SELECT point, " + ", ".join(KEYS) + " FROM rows").fetchall()
    database.close()
    return {row[0]: dict(zip(KEYS, row[1:])) for row in found}


class Map(unittest.TestCase):
    def check(self, *settings):
        with tempfile.TemporaryDirectory(prefix="festoon-settled-") as directory:
            settled = rows_of(directory, "settled", "run.until=settled", *settings)
            whole = rows_of(directory, "whole", *settings)
        self.assertEqual(len(settled), 1024)
        self.assertEqual(settled.keys(), whole.keys())
        known = [point for point, row in settled.items() if row["settled_at"] is not None]
        self.assertGreater(len(known), 950)
        self.assertLess(sum(row["rhs_calls"] for row in settled.values()),
                        0.25 * sum(row["rhs_calls"] for row in whole.values()))
        for point, row in settled.items():
            self.assertEqual((row["regime"], row["symmetry"]), (whole[point]["regime"], whole[point]["symmetry"]), point)
        librating = 0
        for point in known:
            a, b = settled[point], whole[point]
            if a["regime"] == "librating":  # whole drive periods are not whole cycles: the long run's means are blunt
                librating += 1
                self.assertAlmostEqual(a["mean_r"], b["mean_r"], delta=1e-3)
                continue
            for key in ("mean_r", "mean_nz"):
                self.assertLessEqual(abs(abs(a[key]) - abs(b[key])), 3 * (a[key + "_error"] + b[key + "_error"]), point)
            self.assertAlmostEqual(a["max_r"], b["max_r"], delta=1e-6)
        self.assertGreater(librating, 40)

    def test_rigid(self):
        self.check()

    def test_farago2020(self):
        self.check("model.dynamics=farago2020")


if __name__ == "__main__":
    unittest.main()
