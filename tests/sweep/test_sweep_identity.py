"""A sweep's file records its scene, the seed of its random values, and whether all rows are there.

tests: sweep/identity.c cli/fields.c"""

import ctypes
import json
import re
import sqlite3
import unittest

from hdf5_reader import Hdf5
from sweep_tools import SHORT, Case, change, festoon

DRAWN = SHORT + ["--over", "drive.frequency=9Hz:20Hz:random:4", "--over", "model.kappa=1:2:random:4"]


class OtherPrograms(Case):
    """Files of programs that knew fewer keys, or more."""
    WORDS = SHORT + ["--over", "drive.frequency=9Hz:20Hz:4"]

    def scene(self):
        base = sqlite3.connect(self.path("a.db"))
        (text,), = base.execute("SELECT value FROM festoon WHERE key = 'scene'")
        base.close()
        return text

    def rewrite(self, before, after, *more, known=True):
        text = self.scene()
        self.assertIn(before, text)
        change(self.path("a.db"), ("UPDATE festoon SET value = ? WHERE key = 'scene'", (text.replace(before, after),)),
               *more, known=known)

    def go_on(self, *words):
        return ("sweep", *self.WORDS, *words, "-o", self.path("a.db"))

    def test_a_key_that_the_file_lacks_has_its_default(self):
        self.good(*self.go_on())
        before = self.rows("a.db")
        self.rewrite("  gravity: 9.81 m/s2\n", "", "DELETE FROM rows WHERE point = 2")
        self.assertIn("plate.gravity = 9.81, not 5", self.refused(*self.go_on("--set", "plate.gravity=5")))
        self.assertEqual(json.loads(self.good(*self.go_on("--json")))["added"], 1)
        self.assertEqual(self.rows("a.db"), before)

    def test_a_group_that_the_file_lacks_too(self):
        self.good(*self.go_on("--set", "magnet.lines=7"))
        self.rewrite(re.search(r"^friction:\n(?:  .*\n)*", self.scene(), re.M).group(), "")
        self.assertEqual(json.loads(self.good(*self.go_on("--set", "magnet.lines=7", "--json")))["added"], 0)
        self.rewrite("  lines: 7\n", "")
        self.assertIn("magnet.lines = 5, not 7", self.refused(*self.go_on("--set", "magnet.lines=7")))

    def test_the_same_value_in_other_words(self):
        self.good(*self.go_on())
        self.rewrite("mass: 0.5 g", "mass: 500 mg")
        self.good(*self.go_on())

    def test_an_unknown_key_is_named(self):
        """Nothing tells what it did to the rows, whatever its value."""
        self.good(*self.go_on())
        self.rewrite("plate:\n", "plate:\n  roughness: 0\n", known=False)
        for words in (self.go_on(), ("export", self.path("a.db"), "--csv")):
            self.assertIn("plate.roughness", self.refused(*words))

    def test_a_changed_scene_needs_its_checksum(self):
        self.good(*self.go_on())
        base = sqlite3.connect(self.path("a.db"))
        base.execute("UPDATE festoon SET value = replace(value, '  mu: 0.2\n', '') WHERE key = 'scene'")
        base.commit()
        base.close()
        self.assertIn("checksum", self.refused(*self.go_on()))


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
        self.assertIn("1 run failed, its row says why", self.good(*words, self.path("b.db")))
        self.assertIn("c.db: 1 point (", self.good("sweep", *SHORT, "--over", "start.r=0.9", "-o", self.path("c.db")))

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
