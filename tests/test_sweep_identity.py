"""A sweep's file records the seed of its random values, and whether all rows are there.

Environment: FESTOON is the program.
"""

import ctypes
import json
import unittest

from hdf5_reader import Hdf5
from sweep_tools import SHORT, Case, festoon

DRAWN = SHORT + ["--over", "drive.frequency=9Hz:20Hz:random:4", "--over", "model.kappa=1:2:random:4"]


class Identity(Case):
    def test_another_seed_is_another_sweep(self):
        """A sweep with random axes goes on only with the same seed; another seed is refused."""
        self.good("sweep", *DRAWN, "--seed", "7", "-o", self.path("a.db"))
        before = self.rows("a.db")
        self.assertIn("seed", self.refused("sweep", *DRAWN, "--seed", "8", "-o", self.path("a.db")))
        self.assertIn("seed", self.refused("sweep", *DRAWN, "-o", self.path("a.db")))
        self.good("sweep", *DRAWN, "--seed", "7", "-o", self.path("a.db"))
        self.assertEqual(self.rows("a.db"), before)
        self.good("sweep", *DRAWN, "--seed", "8", "-o", self.path("b.db"))
        self.assertNotEqual(self.rows("b.db"), before)

    def test_failed_runs_are_counted(self):
        """Failed runs are counted in the summary for people and in that for programs."""
        words = ["sweep", *SHORT, "--set", "model.eps=0.10869565217391304", "--over",
                 "start.r=0.10869565217391304,0.9,1", "-o"]
        told = json.loads(self.good(*words, self.path("a.db"), "--json"))
        self.assertEqual((told["points"], told["rows"], told["added"], told["failed"]), (3, 3, 3, 1))
        self.assertIn("1 runs failed", self.good(*words, self.path("b.db")))

    def test_what_changes_the_units_carries_no_state(self):
        """A carried state is in units of l and 1/gamma, and means another motion if these change along the chain."""
        for axis in ("friction.gamma=300,312.5", "magnet.half_length=22mm,23mm"):
            err = self.refused("sweep", *SHORT, "--over", axis, "--carry", "up", "-o", self.path("a.db"))
            self.assertRegex(err, r"^festoon: --carry: .* changes the units")

    def test_random_axes_are_not_one(self):
        """Two random axes draw different numbers."""
        self.good("sweep", *DRAWN, "--seed", "7", "-o", self.path("a.db"))
        rows = json.loads(self.good("export", self.path("a.db"), "--json"))
        parts = [((row["drive.frequency"] - 9) / 11, row["model.kappa"] - 1) for row in rows]
        self.assertTrue(all(0 <= a < 1 and 0 <= b < 1 for a, b in parts), parts)
        self.assertGreater(max(abs(a - b) for a, b in parts), 0.05)

    def test_a_part_of_a_sweep_is_not_complete(self):
        """In HDF5 the attribute `complete` says whether every point has its row."""
        import sqlite3  # pylint: disable=import-outside-toplevel
        self.good("sweep", *DRAWN, "-o", self.path("a.db"))
        for missing in (0, 1):
            base = sqlite3.connect(self.path("a.db"))
            base.execute("DELETE FROM rows WHERE point < ?", (missing,))
            base.commit()
            base.close()
            status, _, err = festoon("export", self.path("a.db"), "--hdf5", "-o", self.path("a.h5"))
            if status == 1 and "has no HDF5" in err:
                self.skipTest("built without HDF5")
            self.assertEqual(status, 0, err)
            file = Hdf5(self.path("a.h5"))
            attribute = ctypes.c_int64(file.library.H5Aopen(file.file, b"complete", ctypes.c_int64(0)))
            kind = ctypes.c_int64(file.library.H5Aget_type(attribute))
            value = ctypes.create_string_buffer(16)
            self.assertGreaterEqual(file.library.H5Aread(attribute, kind, value), 0)
            self.assertEqual(value.raw[0], 1 - missing)
            file.library.H5Tclose(kind)
            file.library.H5Aclose(attribute)
            file.close()


if __name__ == "__main__":
    unittest.main()
