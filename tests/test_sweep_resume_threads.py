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
        self.assertEqual([name for name in os.listdir(self.directory) if not name.endswith((".db", ".part"))], [])

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


if __name__ == "__main__":
    unittest.main()
