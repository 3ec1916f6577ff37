"""Sweeps that are killed or interrupted, and go on.

Environment: FESTOON is the program, SOURCE_DIR the source tree; FESTOON_KILLS the number of databases of which each
is killed three times.
"""

import os
import random
import signal
import sqlite3
import subprocess
import time
import unittest

from sweep_tools import FESTOON, SHORT, Case


class Resuming(Case):
    LONG = SHORT + ["--over", "drive.frequency=9Hz:20Hz:40", "--over", "model.kappa=1:2:20", "--threads", "2"]

    def test_sigkill_and_resume(self):
        self.good("sweep", *self.LONG, "-o", self.path("whole.db"))
        expected = self.rows("whole.db")
        rng = random.Random(4)
        rounds = int(os.environ.get("FESTOON_KILLS", "6"))
        broken_off = 0
        for i in range(rounds):
            name = f"cut{i}.db"
            for _ in range(3):
                process = subprocess.Popen([FESTOON, "sweep", *self.LONG, "-o", self.path(name)],
                                           stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
                time.sleep(rng.uniform(0.0, 1.2))
                broken_off += process.poll() is None
                process.kill()
                process.wait()
            self.good("sweep", *self.LONG, "-o", self.path(name))
            self.assertEqual(self.rows(name), expected)
        self.assertGreater(broken_off, 0)
        # A database killed while it is made leaves its unfinished file, and that file's journal.
        self.assertEqual([name for name in os.listdir(self.directory) if not name.endswith(".db") and ".part" not in name], [])

    def test_interruption_ends_with_130(self):
        words = ["sweep", "--set", "run.periods=100", "--set", "run.discard=50", "--over",
                 "drive.frequency=9Hz:20Hz:2000", "-o", self.path("a.db")]
        process = subprocess.Popen([FESTOON, *words], stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        for _ in range(600):  # until the first rows are committed
            time.sleep(0.1)
            if os.path.exists(self.path("a.db-wal")) and os.path.getsize(self.path("a.db-wal")) > 0:
                break
        process.send_signal(signal.SIGINT)
        out, err = process.communicate(timeout=30)
        self.assertEqual((process.returncode, out), (130, b""), err)
        self.assertIn(b"the same command goes on", err)
        base = sqlite3.connect(self.path("a.db"))
        rows = base.execute("SELECT count(*) FROM rows").fetchone()[0]
        base.close()
        self.assertTrue(0 < rows < 2000, rows)


class FarAway(Case):
    """On a network file system there is no write-ahead log: processes share no memory there."""

    def setUp(self):
        super().setUp()
        self.preloaded = os.path.join(os.environ["BUILD_DIR"], "tests", "far_away.so")
        if not os.path.exists(self.preloaded):
            self.skipTest("nothing can be preloaded into a program with sanitizers")
        self.far = dict(os.environ, LD_PRELOAD=self.preloaded)

    def mode_of(self, name):
        base = sqlite3.connect(self.path(name))
        try:
            return base.execute("PRAGMA journal_mode").fetchone()[0]
        finally:
            base.close()

    def test_a_rollback_journal_survives_kills_too(self):
        words = ["sweep", *Resuming.LONG, "-o"]
        self.good(*words, self.path("whole.db"))
        self.assertEqual(self.mode_of("whole.db"), "wal")
        rng = random.Random(5)
        seen = set()
        for _ in range(6):
            process = subprocess.Popen([FESTOON, *words, self.path("far.db")], env=self.far,
                                       stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            time.sleep(rng.uniform(0.0, 0.8))
            seen |= set(os.listdir(self.directory))
            process.kill()
            process.wait()
        self.assertNotIn("far.db-wal", seen)
        self.assertNotIn("far.db-shm", seen)
        self.good(*words, self.path("far.db"), env=self.far)
        self.assertEqual(self.mode_of("far.db"), "delete")
        self.assertEqual(self.rows("far.db"), self.rows("whole.db"))

    def test_a_log_from_elsewhere(self):
        """A sweep begun on a disk of the machine, killed, and moved to the network with its log."""
        words = ["sweep", *Resuming.LONG, "-o", self.path("a.db")]
        process = subprocess.Popen([FESTOON, *words], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        while process.poll() is None and not (os.path.exists(self.path("a.db-wal")) and
                                              os.path.getsize(self.path("a.db-wal")) > 0):
            time.sleep(0.01)
        process.kill()
        process.wait()
        self.assertTrue(os.path.exists(self.path("a.db-wal")))
        self.good(*words, env=self.far)
        self.assertEqual(self.mode_of("a.db"), "delete")
        self.assertEqual(self.good("export", self.path("a.db"), "--csv", env=self.far).count("\n"), 801)


if __name__ == "__main__":
    unittest.main()
