"""Sweeps by several processes under mpirun: the same rows, killed and interrupted ranks, what is refused.

Environment: FESTOON is the program, BUILD_DIR the build tree.  FESTOON_RANKS_ROUNDS: how often ranks are killed.
"""

import glob
import os
import random
import shutil
import signal
import sqlite3
import subprocess
import sys
import time
import unittest

from sweep_tools import FESTOON, SHORT, SMALL, Case, festoon

MPIRUN = ["mpirun", "--oversubscribe", "--allow-run-as-root", "--bind-to", "none"]
# What Open MPI itself keeps until its end is no concern of the address sanitizer.
ENVIRONMENT = dict(os.environ, ASAN_OPTIONS="detect_leaks=0")
MEDIUM = ["--set", "run.periods=90", "--set", "run.discard=45", "--set", "run.rtol=1e-8", "--over",
          "drive.frequency=9Hz:20Hz:40", "--over", "model.kappa=1:2:20"]


def start(ranks, *words):
    return subprocess.Popen([*MPIRUN, "-n", str(ranks), FESTOON, *words], stdin=subprocess.DEVNULL,
                            stdout=subprocess.PIPE, stderr=subprocess.PIPE, env=ENVIRONMENT)


def ranks_of(process):
    """The process numbers of the ranks, once all run."""
    with open(f"/proc/{process.pid}/task/{process.pid}/children", encoding="ascii") as file:
        return [int(word) for word in file.read().split()]


class RankCase(Case):
    def finish(self, process, timeout=300):
        out, err = process.communicate(timeout=timeout)
        return process.returncode, out.decode(), err.decode(errors="replace")

    def sweep(self, ranks, name, *words):
        status, out, err = self.finish(start(ranks, "sweep", *words, "-o", self.path(name)))
        self.assertEqual(status, 0, err)
        return out

    def committed(self, name):
        if not os.path.exists(self.path(name)):
            return 0
        base = sqlite3.connect(self.path(name))
        try:
            return base.execute("SELECT count(*) FROM rows").fetchone()[0]
        finally:
            base.close()

    def wait_for_rows(self, name, process):
        while process.poll() is None and self.committed(name) == 0:
            time.sleep(0.05)


class SameRows(RankCase):
    def test_any_number_of_ranks(self):
        self.good("sweep", *SMALL, "-o", self.path("alone.db"))
        expected = self.rows("alone.db")
        for ranks in (1, 2, 3):
            out = self.sweep(ranks, f"{ranks}.db", *SMALL, "--json")
            self.assertEqual(out.count('"points": 18'), 1)  # rank 0 alone reports
            self.assertEqual(self.rows(f"{ranks}.db"), expected)

    def test_chains_are_carried_by_any_rank(self):
        words = [*SHORT, "--over", "drive.omega=0.3:0.36:5", "--over", "model.kappa=1:2:7", "--carry", "down"]
        self.good("sweep", *words, "-o", self.path("alone.db"))
        self.sweep(3, "many.db", *words)
        self.assertEqual(self.rows("many.db"), self.rows("alone.db"))

    def test_ranks_go_on_with_what_one_process_began(self):
        self.good("sweep", *SMALL, "-o", self.path("a.db"))
        expected = self.rows("a.db")
        base = sqlite3.connect(self.path("a.db"))
        base.execute("DELETE FROM rows WHERE point % 3 = 1")
        base.commit()
        base.close()
        out = self.sweep(2, "a.db", *SMALL, "--json")
        self.assertIn('"added": 6', out)
        self.assertEqual(self.rows("a.db"), expected)
        self.assertIn('"added": 0', self.sweep(3, "a.db", *SMALL, "--json"))


class Deaths(RankCase):
    def test_a_killed_rank_costs_no_committed_row(self):
        rng = random.Random(7)
        self.good("sweep", *MEDIUM, "-o", self.path("whole.db"))
        expected = self.rows("whole.db")
        for i in range(int(os.environ.get("FESTOON_RANKS_ROUNDS", "2"))):
            name = f"cut{i}.db"
            process = start(2 + i % 2, "sweep", *MEDIUM, "-o", self.path(name))
            self.wait_for_rows(name, process)
            time.sleep(rng.uniform(0, 0.5))
            before = self.committed(name)
            victims = ranks_of(process) if process.poll() is None else []
            if victims:  # else all have done their work
                os.kill(victims[i % len(victims)], signal.SIGKILL)
                self.assertNotEqual(self.finish(process)[0], 0)
            else:
                self.finish(process)
            self.assertGreaterEqual(self.committed(name), before)
            self.assertGreater(before, 0)
            self.sweep(1 + (i + 1) % 3, name, *MEDIUM)
            self.assertEqual(self.rows(name), expected)

    def test_interruption(self):
        long = ["--set", "run.periods=200", *MEDIUM[2:]]
        process = start(2, "sweep", *long, "-o", self.path("a.db"))
        self.wait_for_rows("a.db", process)
        os.kill(ranks_of(process)[-1], signal.SIGINT)  # of a follower: all stop
        status, out, err = self.finish(process)
        self.assertEqual((status, out), (130, ""), err)
        self.assertEqual(err.count("the same command goes on"), 1)
        first = self.committed("a.db")
        self.assertTrue(0 < first < 800, first)
        process = start(3, "sweep", *long, "-o", self.path("a.db"))
        while process.poll() is None and self.committed("a.db") == first:
            time.sleep(0.05)
        process.send_signal(signal.SIGINT)  # of mpirun, which has a status of its own
        self.assertNotEqual(self.finish(process)[0], 0)
        second = self.committed("a.db")
        self.assertTrue(first < second < 800)
        base = sqlite3.connect(self.path("a.db"))
        self.assertEqual(base.execute("PRAGMA integrity_check").fetchall(), [("ok",)])
        base.close()
        out = self.sweep(2, "a.db", *long, "--json")  # the same command goes on
        self.assertIn(f'"added": {800 - second},', out)
        self.assertEqual(self.committed("a.db"), 800)


class Refusals(RankCase):
    def test_other_parameters(self):
        self.good("sweep", *SMALL, "-o", self.path("a.db"))
        before = self.rows("a.db")
        status, out, err = self.finish(start(3, "sweep", *SMALL, "--set", "run.rtol=1e-7", "-o", self.path("a.db")))
        self.assertEqual((status, out), (2, ""))
        self.assertEqual(err.count("made with run.rtol"), 1)
        self.assertEqual(self.rows("a.db"), before)

    def test_ranks_that_would_compute_something_else(self):
        other = 'test "$OMPI_COMM_WORLD_RANK" = 0 || set -- "$@" --set run.rtol=1e-7; exec "$@"'
        words = [FESTOON, "sweep", *SMALL, "-o", self.path("a.db")]
        done = subprocess.run([*MPIRUN, "-n", "2", "sh", "-c", other, "sh", *words], env=ENVIRONMENT, timeout=300,
                              stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        self.assertEqual((done.returncode, done.stdout), (2, b""), done.stderr)
        self.assertIn(b"rank 1", done.stderr)
        self.assertIn(b"would compute other rows", done.stderr)

    def test_without_the_module(self):
        for pattern in ("festoon", "libfestoon*.so*"):
            for path in glob.glob(os.path.join(os.environ["BUILD_DIR"], pattern)):
                shutil.copy(path, self.directory)
        alone = self.path("festoon")
        status, _, err = self.run_with(alone, OMPI_COMM_WORLD_SIZE="2")
        self.assertEqual(status, 1)
        self.assertIn("this festoon has no MPI", err)
        self.assertFalse(os.path.exists(self.path("a.db")))
        self.assertEqual(self.run_with(alone, OMPI_COMM_WORLD_SIZE="1")[0], 0)

    def test_srun_without_mpi(self):
        status, _, err = self.run_with(FESTOON, SLURM_STEP_NUM_TASKS="2")
        self.assertEqual(status, 1)
        self.assertIn("srun --mpi=pmix", err)

    def run_with(self, program, **variables):
        done = subprocess.run([program, "sweep", *SMALL, "-o", self.path("a.db")], stdin=subprocess.DEVNULL,
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE, timeout=300,
                              env=dict(os.environ, **variables))
        return done.returncode, done.stdout.decode(), done.stderr.decode()


if __name__ == "__main__":
    if not shutil.which("mpirun") or "mpi yes" not in festoon("--version")[1]:
        print("skipped: no mpirun (openmpi-bin), or festoon was built without MPI (libopenmpi-dev)")
        sys.exit(77)
    unittest.main()
