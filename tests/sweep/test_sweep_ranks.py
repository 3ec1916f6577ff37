"""Sweeps by several processes under mpirun: they make the same rows, survive killed and interrupted ranks, and refuse
what cannot work.

Environment: FESTOON is the program, BUILD_DIR the build tree.  FESTOON_RANKS_ROUNDS: how often ranks are killed.

tests: sweep/ranks.c sweep/ranks_messages.c sweep/mpi_module.c
labels: slow"""

import glob
import os
import random
import shutil
import signal
import sqlite3
import subprocess
import sys
import unittest

import events
from sweep_tools import FESTOON, SHORT, SMALL, Case, festoon

MPIRUN = ["mpirun", "--oversubscribe", "--allow-run-as-root", "--bind-to", "none"]
# What Open MPI itself keeps until its end is no concern of the address sanitizer.
ENVIRONMENT = dict(os.environ, ASAN_OPTIONS="detect_leaks=0")


def medium(count):
    return ["--set", "run.periods=40", "--set", "run.discard=20", "--set", "run.rtol=1e-8", "--checkpoint", "0.05",
            "--over", f"drive.frequency=9Hz:20Hz:{count}", "--over", "model.kappa=1:2:4"]


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


class Deaths(RankCase):
    def whole(self, count):
        """The rows of so many points, computed by one process."""
        if count not in self.known:
            self.good("sweep", *medium(count), "-o", self.path("whole.db"))
            self.known[count] = self.rows("whole.db")
            os.remove(self.path("whole.db"))
        return self.known[count]

    def setUp(self):
        super().setUp()
        self.known = {}
        self.size = events.sized(self.whole, 0.3, 40)

    def wait_for_rows(self, process, path, more_than=0):
        """Whether rows were committed while the ranks were at work."""
        return events.wait_for(process, lambda: events.rows(path) > more_than) and events.children_of(process)

    def test_a_killed_rank_costs_no_committed_row(self):
        rng = random.Random(7)

        def blow(count):
            struck = 0
            for i in range(int(os.environ.get("FESTOON_RANKS_ROUNDS", "2"))):
                name, path = f"cut{count}-{i}.db", self.path(f"cut{count}-{i}.db")
                process = start(2 + i % 2, "sweep", *medium(count), "-o", path)
                self.wait_for_rows(process, path, rng.choice((0, rng.randrange(2 * count))))
                before, victims = events.rows(path), events.children_of(process)
                try:
                    os.kill(victims[i % len(victims)], signal.SIGKILL)
                except (IndexError, ProcessLookupError):  # all ranks were done
                    self.finish(process)
                else:
                    struck += self.finish(process)[0] != 0
                self.assertGreaterEqual(events.rows(path), before)
                self.sweep(1 + (i + 1) % 3, name, *medium(count))
                self.assertEqual(self.rows(name), self.whole(count))
            return struck > 0
        events.struck(blow, self.size)

    def test_interruption(self):
        """A signal to a follower stops all ranks. A signal to mpirun, which has a status of its own and passes the
        signal on at a time of its choice, stops them too. The same command then ends the work."""
        def blow(count):
            points, path = 4 * count, self.path(f"a{count}.db")
            process = start(2, "sweep", *medium(count), "-o", path)
            victims = self.wait_for_rows(process, path)
            try:
                os.kill((victims or [process.pid])[-1], signal.SIGINT)
            except ProcessLookupError:
                pass
            status, out, err = self.finish(process)
            first = events.rows(path)
            if status == 0:
                return False
            self.assertEqual((status, out), (130, ""), err)
            self.assertEqual(err.count("the same command goes on"), 1)
            self.assertIn(f"interrupted with {first} of {points}", err)
            process = start(3, "sweep", *medium(count), "-o", path)
            self.wait_for_rows(process, path, first)
            process.send_signal(signal.SIGINT)
            status = self.finish(process)[0]
            second = events.rows(path)
            self.assertGreaterEqual(second, first)
            if second == points:
                return False
            self.assertNotEqual(status, 0)
            self.assertEqual(events.ask(path, "PRAGMA integrity_check"), "ok")
            out = self.sweep(2, f"a{count}.db", *medium(count), "--json")  # the same command goes on
            self.assertIn(f'"added": {points - second},', out)
            self.assertEqual(self.rows(f"a{count}.db"), self.whole(count))
            return True
        events.struck(blow, self.size)

    def test_runs_in_flight_of_every_rank_are_saved(self):
        """Each of two ranks has one run at a time, so two images come only if the follower sends its own."""
        def words(periods):
            return ["--set", f"run.periods={periods}", "--set", f"run.discard={periods // 2}", "--portable", "--lanes",
                    "1", "--threads", "1", "--checkpoint", "0.05", "--over", "drive.frequency=12Hz:13Hz:8"]

        def blow(periods):
            path = self.path(f"both{periods}.db")
            process = start(2, "sweep", *words(periods), "-o", path)
            both = events.wait_for(process, lambda: (events.ask(path, "SELECT count(*) FROM checkpoints") or 0) >= 2)
            process.send_signal(signal.SIGINT)
            self.finish(process)
            self.good("sweep", *words(periods), "-o", path)
            self.good("sweep", *words(periods), "-o", self.path(f"alone{periods}.db"))
            self.assertEqual(self.rows(f"both{periods}.db"), self.rows(f"alone{periods}.db"))
            return both
        self.assertTrue(any(blow(periods) for periods in (1000, 5000, 25000)), "never two images")

    def test_runs_in_flight_go_on_on_other_ranks(self):
        """Ranks that are killed as soon as images have changed finish their runs all the same."""
        def words(periods):
            return ["--set", f"run.periods={periods}", "--set", f"run.discard={periods // 2}", "--set", "run.rtol=1e-8",
                    "--over", "drive.frequency=6Hz:20Hz:9", "--threads", "1", "--checkpoint", "0.05"]

        def blow(periods):
            path, lives, before = self.path(f"long{periods}.db"), 0, 0
            while True:
                spent = os.times().children_user
                process = start(2, "sweep", *words(periods), "-o", path)
                events.wait_for(process, lambda: events.images(path) not in (0, before))
                try:
                    os.kill(events.children_of(process)[lives % 2], signal.SIGKILL)
                except (IndexError, ProcessLookupError):  # it was over
                    pass
                if self.finish(process)[0] == 0:
                    break
                lives += 1
                before = events.images(path)
                self.assertLess(lives, 300, "it gets no further")
            self.assertTrue(lives > 0 or os.times().children_user - spent < 10.0, "there were no images")
            self.good("sweep", *words(periods), "-o", self.path(f"alone{periods}.db"))
            self.assertEqual(self.rows(f"long{periods}.db"), self.rows(f"alone{periods}.db"))
            return lives >= 2
        events.struck(blow, events.sized(
            lambda size: self.good("sweep", *words(size), "-o", self.path(f"try{size}.db")), 0.3, 500))


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
