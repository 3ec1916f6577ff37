"""Sweeps by several processes under mpirun survive killed and interrupted ranks.

Environment: FESTOON is the program.  FESTOON_RANKS_ROUNDS: how often ranks are killed.

tests: sweep/ranks.c sweep/ranks_messages.c sweep/mpi_module.c
labels: long"""

import os
import random
import shutil
import signal
import sys
import unittest

import events
from sweep_tools import FESTOON, festoon
from test_sweep_ranks import RankCase, start


def medium(count):
    return ["--set", "run.periods=40", "--set", "run.discard=20", "--set", "run.rtol=1e-8", "--checkpoint", "0.05",
            "--over", f"drive.frequency=9Hz:20Hz:{count}", "--over", "model.kappa=1:2:4"]


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


if __name__ == "__main__":
    if not shutil.which("mpirun") or "mpi yes" not in festoon("--version")[1]:
        print("skipped: no mpirun (openmpi-bin), or festoon was built without MPI (libopenmpi-dev)")
        sys.exit(77)
    unittest.main()
