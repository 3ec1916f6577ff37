"""The memory of a sweep, of resuming it and of its exports does not grow with the number of points.

What is measured is the greatest resident size of the program (wait4), in which that of this interpreter before exec()
counts as well; it lies close to the program's own.  Environment: FESTOON is the program, BUILD_DIR
the build tree.

tests: sweep/point_set.c sweep/rows.c sweep/export.c
labels: numbers slow"""

import os
import signal
import sqlite3
import sys
import unittest

import events
from sweep_tools import FESTOON, Case, change, festoon

FEW = 1000
MEBIBYTES = 2  # allowed difference: pages of SQLite's cache, stacks of threads
VERY_SHORT = ["--set", "run.periods=0.01", "--set", "run.discard=0.001", "--threads", "2"]


class Child:
    """The interface that events.wait_for() needs, for a program that was forked here so that wait4() can report on
    it."""

    def __init__(self, pid):
        self.pid = pid

    def poll(self):
        done = os.waitid(os.P_PID, self.pid, os.WEXITED | os.WNOHANG | os.WNOWAIT)
        return done and done.si_status


def peak(*words, interrupted_when=None):
    """Status and greatest resident size in MiB."""
    child = os.fork()
    if child == 0:
        nothing = os.open(os.devnull, os.O_RDWR)
        for descriptor in range(3):
            os.dup2(nothing, descriptor)
        os.execv(FESTOON, [FESTOON, *words])
    if interrupted_when is not None:
        events.wait_for(Child(child), interrupted_when)
        os.kill(child, signal.SIGINT)
    _, status, usage = os.wait4(child, 0)
    return os.waitstatus_to_exitcode(status), usage.ru_maxrss / 1024


class Measured(Case):
    def command(self, count, *words):
        return ["sweep", *VERY_SHORT, "--over", f"drive.frequency=5Hz:20Hz:{count}", *words, "-o",
                self.path(f"{count}.db")]


class GoingOn(Measured):
    MANY = 20000  # test_sweep_memory_long.py: more

    def begun(self, count):
        """A database in which every thousandth point is missing; rows without numbers, but for the radius."""
        status, _, err = festoon(*self.command(2))
        self.assertEqual(status, 0, err)
        # Only its identity is needed, and rows may be there.
        peak(*self.command(count), interrupted_when=lambda: events.rows(self.path(f"{count}.db")))
        change(self.path(f"{count}.db"), "DELETE FROM rows", (
            "WITH RECURSIVE c(i) AS (SELECT 0 UNION ALL SELECT i + 1 FROM c WHERE i < ?) "
            "INSERT INTO rows(point, status, regime, mean_r) SELECT i, 'done', 'locked', 0.001 * i FROM c "
            "WHERE i % 1000 != 999", (count - 1,)))

    def test_going_on_and_exports(self):
        sizes = {}
        for count in (FEW, self.MANY):
            self.begun(count)
            for name, words in (("go on", self.command(count)),
                                ("nothing to do", self.command(count)),
                                ("csv", ["export", self.path(f"{count}.db"), "--csv"]),
                                ("keys", ["export", self.path(f"{count}.db"), "--csv", "--quantity", "regime"]),
                                ("json", ["export", self.path(f"{count}.db"), "--json", "-o", self.path("out.json")]),
                                ("hdf5", ["export", self.path(f"{count}.db"), "--hdf5", "-o", self.path("out.h5")])):
                status, size = peak(*words)
                if name == "hdf5" and status == 1:
                    continue  # built without HDF5
                self.assertEqual(status, 0, name)
                sizes[name, count] = size
            base = sqlite3.connect(self.path(f"{count}.db"))
            self.assertEqual(base.execute("SELECT count(*) FROM rows").fetchone()[0], count)
            base.close()
        for name, count in sizes:
            # HDF5 keeps an index of the chunks of each data set: some 7 bytes a row.
            allowed = 3 * MEBIBYTES if name == "hdf5" else MEBIBYTES
            self.assertLess(sizes[name, self.MANY] - sizes[name, FEW], allowed, (name, sizes))


class Memory(Measured):
    def test_from_a_thousand_points_to_a_thousand_million(self):
        """The large sweep is interrupted when it has as many rows as the whole small one."""
        status, small = peak(*self.command(FEW))
        self.assertEqual(status, 0)
        for count in (1000000, 1000000000):
            status, large = peak(*self.command(count),
                                 interrupted_when=lambda: events.rows(self.path(f"{count}.db")) >= FEW)
            self.assertEqual(status, 130)
            self.assertGreaterEqual(events.rows(self.path(f"{count}.db")), FEW)
            self.assertLess(large - small, MEBIBYTES, (small, large))

    def test_refined(self):
        """The memory of a refined sweep follows the points that it computes, some thousand of a thousand million."""
        status, small = peak(*self.command(FEW))
        self.assertEqual(status, 0)
        status, large = peak(*self.command(1000000000, "--refine", "20"))
        self.assertEqual(status, 0)
        self.assertTrue(900 < events.rows(self.path("1000000000.db")) < 10000)
        self.assertLess(large - small, MEBIBYTES, (small, large))
        status, exported = peak("export", self.path("1000000000.db"), "--csv", "--quantity", "regime")
        self.assertEqual(status, 0)
        self.assertLess(exported - small, MEBIBYTES, (small, exported))

    def test_chains(self):
        words = ["--over", "model.kappa=1,2", "--carry", "up"]
        status, small = peak(*self.command(FEW, *words))
        self.assertEqual(status, 0)
        status, large = peak(*self.command(1000000, *words),
                             interrupted_when=lambda: events.rows(self.path("1000000.db")) >= FEW)
        self.assertEqual(status, 130)
        self.assertLess(large - small, MEBIBYTES, (small, large))


if __name__ == "__main__":
    if not os.path.exists(os.path.join(os.environ["BUILD_DIR"], "tests", "far_away.so")):
        print("skipped: sanitizers keep what is freed")
        sys.exit(77)
    unittest.main()
