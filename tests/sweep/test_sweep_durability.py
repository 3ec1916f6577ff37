"""Sweeps in adverse conditions: any number of threads, lanes and ranks, in any order; disks that are full, read-only or
on a network; signals that follow each other.  (Kills by the dozen are those of test_reliability_kills.py.)

tests: sweep/make.c sweep/database.c host/file_system.c
labels: long"""

import itertools
import json
import os
import random
import shutil
import signal
import sqlite3
import subprocess
import sys
import unittest

import events
import test_sweep_ranks
from sweep_tools import FESTOON, SHORT, SMALL, Case, content_of, festoon

HAVE_MPI = shutil.which("mpirun") and "mpi yes" in festoon("--version")[1]


class Invariance(Case):
    """Rows depend on their parameters and the form of arithmetic alone."""

    def widths(self):
        """Pairs of a form and a number of lanes that this processor has."""
        for form, lanes in itertools.product(("portable", "avx2", "avx512"), ("1", "4", "8")):
            words = ["--arithmetic", form, "--lanes", lanes]
            status, _, err = festoon("sweep", *SHORT, "--over", "start.r=0.9", *words,
                                     "-o", self.path(f"try-{form}-{lanes}.db"))
            if status == 0:
                yield form, words
            else:
                self.assertEqual(status, 1, err)

    def test_threads_lanes_and_ranks(self):
        found, tried = {}, 0
        for form, words in list(self.widths()):
            for threads, ranks in itertools.product(("1", "2"), (0, 1, 2, 3) if HAVE_MPI else (0,)):
                name = f"{tried}.db"
                tried += 1
                whole = ["sweep", *SMALL, *words, "--threads", threads, "-o", self.path(name)]
                if ranks == 0:
                    self.good(*whole)
                else:
                    status, _, err = test_sweep_ranks.RankCase.finish(self, test_sweep_ranks.start(ranks, *whole))
                    self.assertEqual(status, 0, err)
                found.setdefault(form, set()).add(self.rows(name))
        self.assertGreaterEqual(tried, 6)
        for form, contents in found.items():
            self.assertEqual(len(contents), 1, form)

    def test_order(self):
        """Points are computed in any order: holes of a database are filled, and values may be listed in another
        order."""
        self.good("sweep", *SMALL, "-o", self.path("whole.db"))
        expected = self.rows("whole.db")
        rng = random.Random(11)
        for i in range(8):
            shutil.copy(self.path("whole.db"), self.path("holes.db"))
            base = sqlite3.connect(self.path("holes.db"))
            base.executemany("DELETE FROM rows WHERE point = ?", [(p,) for p in rng.sample(range(18), 9)])
            base.commit()
            base.close()
            self.good("sweep", *SMALL, "-o", self.path("holes.db"), "--threads", str(1 + i % 2))
            self.assertEqual(self.rows("holes.db"), expected)
        values = [1, 1.25, 1.5, 1.75, 2]
        by_kappa = []
        for order in (values, rng.sample(values, 5), values[::-1]):
            name = "-".join(map(str, order)) + ".db"
            self.good("sweep", *SHORT, "--over", "model.kappa=" + ",".join(map(str, order)), "-o", self.path(name))
            rows = json.loads(self.good("export", self.path(name), "--json"))
            by_kappa.append({row.pop("model.kappa"): {**row, "point": 0} for row in rows})
        self.assertEqual(by_kappa[0], by_kappa[1])
        self.assertEqual(by_kappa[0], by_kappa[2])


class Disks(Case):
    """Mounting file systems needs root; without it, or if mounting is forbidden, these tests are skipped."""

    def mount(self, *words):
        place = self.path("mounted")
        os.makedirs(place, exist_ok=True)
        if os.getuid() != 0 or subprocess.run(["mount", *words, place], stderr=subprocess.DEVNULL).returncode != 0:
            self.skipTest("mounting a file system needs root")
        self.addCleanup(subprocess.run, ["umount", "-l", place], check=True)
        return place

    def unfinished(self, name):
        self.good("sweep", *SMALL, "-o", self.path(name))
        base = sqlite3.connect(self.path(name))
        base.execute("DELETE FROM rows WHERE point > 8")
        base.commit()
        base.close()

    def test_a_disk_that_fills_up_again_and_again(self):
        place = self.mount("-t", "tmpfs", "-o", "size=300k", "none")
        path = os.path.join(place, "a.db")
        words = ["sweep", *SHORT, "--over", "drive.frequency=9Hz:20Hz:1500", "-o", path]
        kept = []
        for size in range(300, 20000, 200):
            subprocess.run(["mount", "-o", f"remount,size={size}k", place], check=True)
            status, out, err = festoon(*words)
            if status == 0:
                break
            self.assertEqual((status, out), (1, ""), err)
            self.assertIn("disk is full", err)
            if os.path.exists(path):
                shutil.copytree(place, self.path(f"copy{size}"))  # with the log, if there is one
                base = sqlite3.connect(self.path(f"copy{size}/a.db"))
                kept.append(base.execute("SELECT count(*) FROM rows").fetchone()[0])
                base.close()
        self.assertEqual(status, 0)
        self.assertGreater(len(kept), 2)
        self.assertEqual(kept, sorted(kept))
        self.good("sweep", *words[1:-1], self.path("whole.db"))
        self.assertEqual(self.good("export", path, "--csv"), self.rows("whole.db"))

    def test_no_room_for_the_first_page(self):
        place = self.mount("-t", "tmpfs", "-o", "size=4k", "none")
        path = os.path.join(place, "a.db")
        with open(os.path.join(place, "fill"), "wb") as out:
            out.write(bytes(4096))
        status, out, err = festoon("sweep", *SMALL, "-o", path)
        self.assertEqual((status, out), (1, ""), err)
        self.assertRegex(err, "full|No space left")
        self.assertEqual(os.listdir(place), ["fill"])

    def test_a_file_system_for_reading_only(self):
        place = self.mount("-t", "tmpfs", "-o", "size=8m", "none")
        path = os.path.join(place, "a.db")
        part = ["sweep", *SMALL]
        self.good(*part, "-o", self.path("whole.db"))
        expected = self.rows("whole.db")
        self.unfinished(path)
        subprocess.run(["mount", "-o", "remount,ro", place], check=True)
        sound = content_of(path)
        for words in (part + ["-o", path], part + ["-o", os.path.join(place, "new.db")]):
            status, out, err = festoon(*words)
            self.assertEqual((status, out), (1, ""), err)
            self.assertRegex(err, "no permission|cannot write here")
        self.assertEqual(content_of(path), sound)
        self.assertEqual(self.good("export", path, "--csv").count("\n"), 10)  # reading goes on
        subprocess.run(["mount", "-o", "remount,rw", place], check=True)
        self.good(*part, "-o", path)
        self.assertEqual(self.good("export", path, "--csv"), expected)

    def test_an_interrupted_sweep_where_nothing_may_be_written(self):
        """A database whose log was left beside it by a kill can be read after the disk became read-only."""
        place = self.mount("-t", "tmpfs", "-o", "size=64m", "none")

        def sweep(count):
            return ["sweep", *SHORT, "--over", f"drive.frequency=9Hz:20Hz:{count}", "-o",
                    os.path.join(place, f"{count}.db")]

        def blow(count):
            path = os.path.join(place, f"{count}.db")
            return events.kill_when([FESTOON, *sweep(count)], lambda: events.rows(path))
        words = sweep(events.struck(blow, 300))
        subprocess.run(["mount", "-o", "remount,ro", place], check=True)
        before = {name: content_of(os.path.join(place, name)) for name in os.listdir(place)}
        status, out, err = festoon(*words)
        self.assertEqual((status, out), (1, ""), err)
        self.assertIn("no permission", err)
        self.assertEqual({name: content_of(os.path.join(place, name)) for name in os.listdir(place)}, before)

    def test_permissions_of_files_and_folders(self):
        if os.getuid() == 0:
            self.skipTest("root may write everywhere: the read-only file system is the test")
        self.unfinished("a.db")
        os.chmod(self.path("a.db"), 0o444)
        self.assertIn("no permission", self.refused("sweep", *SMALL, "-o", self.path("a.db"), status=1))
        os.mkdir(self.path("closed"), 0o555)
        self.assertIn("cannot write here", self.refused("sweep", *SMALL, "-o", self.path("closed/a.db"), status=1))

    def test_an_immutable_file(self):
        self.unfinished("a.db")
        if subprocess.run(["chattr", "+i", self.path("a.db")], stderr=subprocess.DEVNULL).returncode != 0:
            self.skipTest("chattr +i is not for everyone and every file system")
        self.addCleanup(subprocess.run, ["chattr", "-i", self.path("a.db")], check=True)
        self.assertIn("no permission", self.refused("sweep", *SMALL, "-o", self.path("a.db"), status=1))


class Signals(Case):
    def test_interruptions_add_up(self):
        rng = random.Random(3)

        def blow(count):
            words = ["sweep", *SHORT, "--over", f"drive.frequency=9Hz:20Hz:{count}", "-o"]
            self.good(*words, self.path(f"whole{count}.db"))
            path, struck = self.path(f"a{count}.db"), 0
            for _ in range(5):
                seen = events.rows(path) + rng.choice((0, count // 20))
                status, out, err = events.signal_when([FESTOON, *words, path], lambda: events.rows(path) > seen,
                                                      rng.choice((signal.SIGINT, signal.SIGTERM)))
                self.assertIn(status, (130, 0), err)
                if status == 130:
                    self.assertEqual(out, b"")
                    struck += 1
            self.good(*words, path)
            self.assertEqual(self.rows(f"a{count}.db"), self.rows(f"whole{count}.db"))
            return struck >= 2
        events.struck(blow, 1000)


if __name__ == "__main__":
    program = unittest.main(exit=False)
    for test, why in program.result.skipped:
        print(f"skipped {test}: {why}", file=sys.stderr)
    sys.exit(not program.result.wasSuccessful())
