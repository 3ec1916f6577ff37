"""Sweeps that are killed or interrupted, and go on.

Environment: FESTOON is the program, SOURCE_DIR the source tree, BUILD_DIR the build tree; FESTOON_KILLS the number of
databases of which each is killed three times.

tests: sweep/checkpoints.c sweep/images.c sweep/workers.c sweep/journal.c
labels: threads slow"""

import os
import random
import re
import signal
import sqlite3
import time
import unittest

import events
from sweep_tools import FESTOON, SHORT, Case, festoon

PRELOADED = os.path.join(os.environ["BUILD_DIR"], "tests")


def short_runs(count):
    """Many short runs."""
    return ["sweep", *SHORT, "--over", f"drive.frequency=9Hz:20Hz:{count}", "--over", "model.kappa=1,1.5",
            "--threads", "2", "-o"]


def long_runs(periods):
    """Few runs, no more than fit into the lanes of two threads; images are saved after every 50 ms of work."""
    return ["sweep", "--set", f"run.periods={periods}", "--set", f"run.discard={periods // 2}", "--set", "run.rtol=1e-8",
            "--over", "drive.frequency=6Hz:20Hz:12", "--threads", "2", "--checkpoint", "0.05", "-o"]


class Measured(Case):
    """Sweeps that last some tenths of a second on this machine, which is measured once; with their rows."""
    SIZES, WHOLE = {}, {}

    def size_of(self, words, size, seconds=0.3):
        if words.__name__ not in self.SIZES:
            self.SIZES[words.__name__] = events.sized(lambda size: self.whole(words, size), seconds, size)
        return self.SIZES[words.__name__]

    def whole(self, words, size):
        if (words.__name__, size) not in self.WHOLE:
            self.good(*words(size), self.path("whole.db"))
            self.WHOLE[words.__name__, size] = self.rows("whole.db")
            os.remove(self.path("whole.db"))
        return self.WHOLE[words.__name__, size]


class Resuming(Measured):
    def test_sigkill_and_resume(self):
        """Killed when the file is there, when some rows are in it, or a moment later: no committed row is lost."""
        rng = random.Random(4)

        def rounds(count):
            expected = self.whole(short_runs, count)
            struck = 0
            for i in range(int(os.environ.get("FESTOON_KILLS", "6"))):
                path = self.path(f"cut{count}-{i}.db")
                for _ in range(3):
                    seen = events.rows(path)
                    wanted = rng.choice((0, 1, rng.randrange(1, count)))
                    process = events.start([FESTOON, *short_runs(count), path])
                    events.wait_for(process, lambda: os.path.exists(path) and events.rows(path) >= seen + wanted)
                    time.sleep(rng.choice((0.0, rng.uniform(0.0, 0.05))))  # any moment will do
                    seen = events.rows(path)
                    process.kill()
                    process.wait()
                    struck += process.returncode == -signal.SIGKILL
                    self.assertGreaterEqual(events.rows(path), seen)
                self.good(*short_runs(count), path)
                self.assertEqual(self.rows(path), expected)
            return struck >= 3
        events.struck(rounds, self.size_of(short_runs, 100))
        # A program that was killed while it made a database left files beside it; the last command removed them.
        self.assertEqual([name for name in os.listdir(self.directory) if not name.endswith(".db")], [])

    def test_a_kill_costs_no_more_than_what_came_after_the_last_image(self):
        """Killed whenever the images of its runs have changed, a sweep still comes to its end, although no run
        finishes within one life of the program: work before the last image is never done again."""
        def blow(periods):
            path = self.path(f"cut{periods}.db")
            lives, before = 0, 0
            while True:
                spent = os.times().children_user
                if not events.kill_when([FESTOON, *long_runs(periods), path],
                                        lambda: events.images(path) not in (0, before)):
                    break
                lives += 1
                before = events.images(path)
                self.assertLess(lives, 300, "it gets no further")
            # A program that has computed for so long has saved images of its runs.
            self.assertTrue(lives > 0 or os.times().children_user - spent < 4.0, "there were no images")
            self.assertEqual(self.rows(f"cut{periods}.db"), self.whole(long_runs, periods))
            self.assertIsNone(events.ask(path, "SELECT count(*) FROM checkpoints"))  # nothing is left of them
            return lives >= 3
        events.struck(blow, self.size_of(long_runs, 500))

    def altered(self, name, alter):
        """Alters the images of a killed sweep, as a list of [point, size, checksum, image], and lets it go on: it says
        how many it could not use, and comes to the right rows."""
        def blow(periods):
            path = self.path(f"{name}{periods}.db")
            if not events.kill_when([FESTOON, *long_runs(periods), path],
                                    lambda: (events.ask(path, "SELECT count(*) FROM checkpoints") or 0) >= 2):
                return False
            base = sqlite3.connect(path)
            images = [list(row) for row in base.execute("SELECT point, size, checksum, image FROM checkpoints")]
            count = alter(images)
            base.execute("DELETE FROM checkpoints")
            base.executemany("INSERT INTO checkpoints VALUES(?, ?, ?, ?)", images)
            base.commit()
            base.close()
            status, _, err = festoon(*long_runs(periods), path)
            self.assertEqual(status, 0, err)
            self.assertEqual([line for line in err.splitlines() if "saved" in line], count and [
                f"festoon: {path}: what was saved of unfinished runs was damaged: {count} are made anew"] or [])
            self.assertEqual(self.rows(f"{name}{periods}.db"), self.whole(long_runs, periods))
            return True
        events.struck(blow, self.size_of(long_runs, 500))

    def test_damaged_images_are_not_trusted(self):
        def flip(images):
            for image in images:
                spoilt = bytearray(image[3])
                spoilt[(7919 * (image[0] + 1)) % len(spoilt)] ^= 1 << image[0] % 8
                image[3] = bytes(spoilt)
            return len(images)
        self.altered("bad", flip)

    def test_images_of_other_points_are_not_trusted(self):
        def exchange(images):
            images[0][1:], images[1][1:] = images[1][1:], images[0][1:]
            return 2
        self.altered("exchanged", exchange)
        self.altered("sound", lambda images: 0)

    def test_interruption_ends_with_130(self):
        """SIGINT and SIGTERM save finished rows and runs in flight; two signals at once count as one."""
        for number, times, seconds in ((signal.SIGINT, 1, "0.05"), (signal.SIGTERM, 1, "1e6"), (signal.SIGINT, 2, "1e6")):
            def blow(periods):
                path = self.path(f"{number}-{times}-{periods}.db")
                words = long_runs(periods)
                words[words.index("--checkpoint") + 1] = seconds
                process = events.start([FESTOON, *words, path], stdout=-1, stderr=-1)
                events.wait_for(process, lambda: events.rows(path))
                for _ in range(times):
                    process.send_signal(number)
                out, err = process.communicate(timeout=events.HANG)
                if process.returncode == 0:
                    return False
                self.assertEqual((process.returncode, out), (130, b""), err)
                self.assertIn(b"the same command goes on", err)
                done = int(re.search(rb"interrupted with (\d+) of 12", err).group(1))
                self.assertEqual(events.rows(path), done)  # all that was finished
                if done == 12:
                    return False  # the signal came behind the last run, when there is no table of runs in flight any more
                # Every run that was not is there as it was when the signal came.
                self.assertEqual(done + events.ask(path, "SELECT count(*) FROM checkpoints"), 12)
                self.good(*long_runs(periods), path)
                self.assertEqual(self.rows(f"{number}-{times}-{periods}.db"), self.whole(long_runs, periods))
                return True
            events.struck(blow, self.size_of(long_runs, 500))

    def test_the_second_interruption_ends_it_at_once(self):
        """The sweep waits for another program that locks its database; a second signal after a while ends the sweep
        there."""
        def blow(count):
            path = self.path(f"second{count}.db")
            process = events.start([FESTOON, *short_runs(count), path], stdout=-1, stderr=-1)
            if not events.wait_for(process, lambda: events.rows(path)):
                process.communicate()
                return False
            base = sqlite3.connect(path, timeout=60, isolation_level=None)
            try:
                base.execute("BEGIN IMMEDIATE")
                process.send_signal(signal.SIGINT)
                events.wait_for(process, lambda: events.seems_noted(process, signal.SIGINT))
                time.sleep(0.3)  # any longer time would do: signals within a quarter of a second count as one
                process.send_signal(signal.SIGINT)
                process.communicate(timeout=events.HANG)
            finally:
                base.close()
            if process.returncode in (0, 130):
                return False  # the sweep had nothing left to write, and did not wait
            self.assertEqual(process.returncode, -signal.SIGINT)
            return True
        events.struck(blow, self.size_of(short_runs, 100))

    def test_a_clock_that_is_set_back_stops_no_commit(self):
        library = os.path.join(PRELOADED, "clock_ahead.so")
        if not os.path.exists(library):
            self.skipTest("nothing can be preloaded into a program with sanitizers")

        def many_long_runs(periods):
            # One thread, because the end of a second one would wake the thread that waits.
            words = [*long_runs(periods)[:-1], "--over", "model.kappa=1,1.5,2", "-o"]
            words[words.index("--threads") + 1] = "1"
            return words

        def blow(periods):
            path = self.path(f"clock{periods}.db")
            process = events.start([FESTOON, *many_long_runs(periods), path], env=dict(os.environ, LD_PRELOAD=library))
            events.wait_for(process, lambda: events.rows(path))
            process.kill()
            process.wait()
            return process.returncode == -signal.SIGKILL and 0 < events.rows(path) < 36
        size = self.size_of(many_long_runs, 100)
        self.assertTrue(any(blow(size * factor) for factor in (1, 4, 16)), "no row was committed before the end")


class FarAway(Measured):
    """On a network file system there is no write-ahead log: processes share no memory there."""

    def setUp(self):
        super().setUp()
        self.preloaded = os.path.join(PRELOADED, "far_away.so")
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
        rng = random.Random(5)
        seen = set()

        def blow(count):
            words, struck = short_runs(count), 0
            self.good(*short_runs(2), self.path("near.db"))
            self.assertEqual(self.mode_of("near.db"), "wal")
            path = self.path(f"far{count}.db")
            for _ in range(6):
                size = os.path.getsize(path) if os.path.exists(path) else 0
                grown = rng.choice((0, 1, 50000))  # the file's size is watched, because a reader would disturb
                struck += events.kill_when([FESTOON, *words, path], lambda: os.path.exists(path) and
                                           os.path.getsize(path) >= size + grown, env=self.far)
                seen.update(name for name in os.listdir(self.directory) if name.startswith("far"))
            self.good(*words, path, env=self.far)
            self.assertEqual(self.mode_of(f"far{count}.db"), "delete")
            self.assertEqual(self.rows(f"far{count}.db"), self.whole(short_runs, count))
            return struck >= 2
        events.struck(blow, self.size_of(short_runs, 100))
        self.assertFalse([name for name in seen if name.endswith(("-wal", "-shm"))])

    def test_a_log_from_elsewhere(self):
        """A sweep begun on a disk of the machine, killed, and moved to the network with its log."""
        def blow(count):
            path = self.path(f"a{count}.db")
            if not events.kill_when([FESTOON, *short_runs(count), path], lambda: events.rows(path)):
                return False
            self.assertTrue(os.path.exists(path + "-wal"))
            self.good(*short_runs(count), path, env=self.far)
            self.assertEqual(self.mode_of(f"a{count}.db"), "delete")
            self.assertEqual(self.good("export", path, "--csv", env=self.far).count("\n"), 2 * count + 1)
            return True
        events.struck(blow, self.size_of(short_runs, 100))


if __name__ == "__main__":
    unittest.main()
