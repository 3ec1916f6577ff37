"""Sweeps by several processes under mpirun: they make the same rows, and refuse what cannot work.  (Killed and
interrupted ranks: test_sweep_ranks_long.py.)

Environment: FESTOON is the program, BUILD_DIR the build tree.

tests: sweep/ranks.c sweep/ranks_messages.c sweep/mpi_module.c
labels: slow"""

import glob
import os
import shutil
import sqlite3
import subprocess
import sys
import unittest

import events
from sweep_tools import FESTOON, SHORT, SMALL, Case, festoon

MPIRUN = ["mpirun", "--oversubscribe", "--allow-run-as-root", "--bind-to", "none"]
# What Open MPI itself keeps until its end is not a concern of the address sanitizer.
ENVIRONMENT = dict(os.environ, ASAN_OPTIONS="detect_leaks=0")


def start(ranks, *words):
    return subprocess.Popen([*MPIRUN, "-n", str(ranks), FESTOON, *words], stdin=subprocess.DEVNULL,
                            stdout=subprocess.PIPE, stderr=subprocess.PIPE, env=ENVIRONMENT)


class RankCase(Case):
    def finish(self, process, timeout=events.HANG):
        """Status, output and messages. An mpirun whose ranks were killed sometimes hangs when none of them is left;
        it is ended then."""
        alone = 0
        while True:
            try:
                out, err = process.communicate(timeout=min(timeout, 2.0))
                return process.returncode, out.decode(), err.decode(errors="replace")
            except subprocess.TimeoutExpired:
                alone = alone + 1 if events.lost_its_children(process) else 0
                timeout -= 2.0
                if alone == 5 or timeout <= 0:
                    process.kill()

    def sweep(self, ranks, name, *words):
        status, out, err = self.finish(start(ranks, "sweep", *words, "-o", self.path(name)))
        self.assertEqual(status, 0, err)
        return out


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
        for i in ("1", "2"):  # a shard may have ranks, and has whole chains
            self.assertEqual(self.sweep(2, f"{i}.db", *words, "--shard", f"{i}/2").count("points of shard"), 1)
        self.good("merge", self.path("1.db"), self.path("2.db"), "-o", self.path("merged.db"))
        self.assertEqual(self.rows("merged.db"), self.rows("alone.db"))

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


    def test_refined_sweeps(self):
        words = [*SHORT, "--set", "plate.radius=6cm", "--over", "start.r=0.3:2.9:33", "--over", "model.kappa=0.2:2:22",
                 "--refine", "3"]
        self.good("sweep", *words, "-o", self.path("alone.db"))
        for ranks in (2, 3):
            self.sweep(ranks, f"{ranks}.db", *words)
            self.assertEqual(self.rows(f"{ranks}.db"), self.rows("alone.db"))


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
        done = subprocess.run([*MPIRUN, "-n", "2", "sh", "-c", other, "sh", *words], env=ENVIRONMENT, timeout=events.HANG,
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
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE, timeout=events.HANG,
                              env=dict(os.environ, **variables))
        return done.returncode, done.stdout.decode(), done.stderr.decode()


if __name__ == "__main__":
    if not shutil.which("mpirun") or "mpi yes" not in festoon("--version")[1]:
        print("skipped: no mpirun (openmpi-bin), or festoon was built without MPI (libopenmpi-dev)")
        sys.exit(77)
    unittest.main()
