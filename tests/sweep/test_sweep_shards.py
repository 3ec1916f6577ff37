"""Shards of a sweep, each in a database of its own, and their merging: the rows of one sweep, bit for bit, or a refusal.

Environment: FESTOON is the program, SOURCE_DIR the source tree, BUILD_DIR the build tree.

tests: sweep/merge.c sweep/chains.c sweep/identity.c sweep/make.c cli/merge.c"""

import json
import os
import shutil
import sqlite3
import subprocess
import unittest

import events
from sweep_tools import FESTOON, SHORT, SMALL, Case, change, content_of, festoon

EXAMPLES = os.path.join(os.environ["SOURCE_DIR"], "examples")
KAPPA = ["--over", "model.kappa=1,1.5,2"]
# Every kind of rows: words of the sweep, number of shards, points of the first one.
KINDS = {
    "two axes": (SMALL, 3, [0, 5, 7, 9, 14, 16]),
    "random values": ([*SHORT, "--over", "drive.frequency=9Hz:20Hz:random:5", "--seed", "7"], 2, [0, 3, 4]),
    "carried": ([*SHORT, "--over", "drive.omega=0.3:0.36:5", *KAPPA, "--carry", "down"], 2, [0, 3, 6, 9, 12]),
    "beads": ([os.path.join(EXAMPLES, "beads", "opposite.yaml"), "--set", "run.periods=3", "--set", "run.discard=1",
               "--over", "drive.frequency=20,30"], 2, [0]),
    "levitation": ([os.path.join(EXAMPLES, "worlds", "levitation.yaml"), "--levitation",
                    "--over", "drive.frequency=150Hz:250Hz:3"], 2, [0]),
}


class Shards(Case):
    def shard(self, index, count, *words):
        name = self.path(f"s{index}of{count}.db")
        self.good("sweep", *(words or SMALL), "--shard", f"{index}/{count}", "-o", name)
        return name

    def whole(self, *words):
        self.good("sweep", *(words or SMALL), "-o", self.path("one.db"))
        return self.rows("one.db")

    def points(self, name):
        base = sqlite3.connect(name)
        try:
            return [point for point, in base.execute("SELECT point FROM rows ORDER BY point")]
        finally:
            base.close()

    def not_merged(self, *names):
        """Refused, and nothing is left; the inputs are as they were."""
        said = self.refused("merge", *names, "-o", self.path("all.db"))
        self.assertEqual([name for name in os.listdir(self.directory) if "all" in name], [])
        return said

    def alter(self, name, *statements):
        base = sqlite3.connect(name)
        for statement in statements:
            base.execute(statement)
        base.commit()
        base.close()


class Merging(Shards):
    def test_the_rows_of_one_sweep(self):
        for kind, (words, count, first) in KINDS.items():
            with self.subTest(kind):
                expected = self.whole(*words)
                names = [self.shard(i, count, *words) for i in range(count, 0, -1)]  # in any order
                self.assertEqual(self.points(names[-1]), first)
                before = {name: (content_of(name), os.stat(name).st_mtime_ns) for name in names}
                told = json.loads(self.good("merge", *names, "-o", self.path("all.db"), "--json"))
                total = expected.count("\n") - 1
                self.assertEqual(told, {"points": total, "rows": total, "missing": 0})
                self.assertEqual(self.rows("all.db"), expected)
                self.assertEqual(sum(len(self.points(name)) for name in names), total)  # nothing is computed twice
                self.assertEqual({name: (content_of(name), os.stat(name).st_mtime_ns) for name in names}, before)
                for name in os.listdir(self.directory):
                    os.remove(self.path(name))

    def test_a_missing_shard(self):
        """What is missing is told; the sweep command computes it, or the shard is merged in later."""
        expected, names = self.whole(), [self.shard(i, 3) for i in (1, 3)]
        status, out, err = festoon("merge", *names, "-o", self.path("all.db"))
        self.assertEqual((status, out), (0, f"{self.path('all.db')}: 12 of 18 points\n"))
        self.assertIn("6 of 18 points have no row: 1, 3, 8, 10, 12, 17; ", err)
        self.assertIn("without --shard, computes them", err)
        _, out, err = festoon("export", self.path("all.db"), "--csv", "--quantity", "regime")
        self.assertEqual((out.count(",done\n"), out.count(",missing\n")), (12, 6))
        self.assertIn("12 of 18 points have a row; the command of the sweep computes the others with -o ", err)  # nothing was interrupted
        self.good("merge", self.path("all.db"), self.shard(2, 3), "-o", self.path("late.db"))
        self.assertEqual(json.loads(self.good("sweep", *SMALL, "--json", "-o", self.path("all.db")))["added"], 6)
        for name in ("all.db", "late.db"):
            self.assertEqual(self.rows(name), expected)

    def test_no_room(self):
        mount, names = self.path("small"), [self.shard(i, 2) for i in (1, 2)]
        os.mkdir(mount)
        if os.getuid() != 0 or subprocess.run(["mount", "-t", "tmpfs", "-o", "size=16k", "none", mount], stderr=subprocess.DEVNULL).returncode != 0:
            self.skipTest("a small file system needs root")
        try:
            status, _, err = festoon("merge", *names, "-o", os.path.join(mount, "all.db"))
            self.assertEqual((status, os.listdir(mount)), (1, []), err)
            self.assertIn("the disk is full, and nothing of the new database is left", err)
        finally:
            subprocess.run(["umount", mount], check=True)

    def test_shards_may_overlap(self):
        expected = self.whole()
        self.good("merge", self.shard(1, 2), self.shard(2, 2), self.shard(2, 3), self.path("s1of2.db"), "-o", self.path("all.db"))
        self.assertEqual(self.rows("all.db"), expected)

    def test_other_sweeps(self):
        """The sentence says what differs, and nothing is written."""
        first = self.shard(1, 2)
        for more, said in ((("--set", "plate.gravity=9.7"), "plate.gravity = 9.7, and "), (("--seed", "2"), "with seed 2, and "),
                           (("--carry", "up"), "with carry up, and ")):
            with self.subTest(said):
                other = self.path("other.db")
                self.good("sweep", *SMALL, *more, "--shard", "2/2", "-o", other)
                told = self.not_merged(first, other)
                self.assertTrue(told.startswith(f"festoon: {other}: this sweep was made with "), told)
                self.assertIn(said, told)
                self.assertIn(first, told)
                os.remove(other)

    def test_rows_that_differ(self):
        """Two databases that say that they are of one sweep, with sound rows of a point that are not the same."""
        first = self.shard(1, 2)
        shutil.copy(first, self.path("other.db"))
        change(self.path("other.db"), "UPDATE rows SET mean_r = 1.25 WHERE point = 3")
        self.assertIn("point 3 has another row", self.not_merged(first, self.path("other.db")))

    def test_damaged_rows_are_left_out(self):
        expected, names = self.whole(), [self.shard(i, 2) for i in (1, 2)]
        self.alter(names[0], "UPDATE rows SET mean_r = mean_r + 1e-9 WHERE point IN (3, 7)")
        err = self.refused("merge", *names, "-o", self.path("all.db"))
        self.assertIn(f"{names[0]}: this sweep database is damaged: the rows of the points 3, 7 are lost", err)
        self.assertIn("The other rows were merged", err)
        self.assertIn("2 of 18 points have no row: 3, 7; ", err)
        self.assertEqual(len(self.points(self.path("all.db"))), 16)
        self.good("sweep", *SMALL, "-o", self.path("all.db"))
        self.assertEqual(self.rows("all.db"), expected)
        # A point that another file has is not missing.
        self.assertNotIn("no row", self.refused("merge", *names, self.path("one.db"), "-o", self.path("more.db")))
        self.assertEqual(self.rows("more.db"), expected)

    def test_what_is_no_part(self):
        one = self.shard(1, 2)
        self.assertIn("would be lost", self.refused("merge", one, "-o", one))
        with open(self.path("text"), "w") as file:
            file.write("words\n")
        self.good("sweep", *SHORT, "--over", "drive.frequency=9Hz:20Hz:5", "--refine", "1", "-o", self.path("refined.db"))
        self.assertIn("refined", self.not_merged(self.path("refined.db")))
        self.assertIn("text", self.not_merged(one, self.path("text")))
        self.assertIn("cannot read", self.not_merged(one, self.path("none.db")))
        self.assertIn("--shard I/N", self.not_merged())
        self.assertIn("-o ALL.db", self.refused("merge", one))
        for forged in ("3/2", "1", "1/0", "-9223372036854775808/2", "5/9223372036854775807"):
            change(one, ("UPDATE festoon SET value = ? WHERE key = 'shard'", (forged,)))
            self.assertIn("damaged", self.not_merged(one), forged)


class OneShard(Shards):
    def test_which(self):
        for wrong in ("0/3", "4/3", "1/0", "x", "", "1/3x", "1.5/3", "1/9999999999"):
            self.assertIn("--shard: ", self.refused("sweep", *SMALL, "--shard", wrong, "-o", self.path("a.db")), wrong)
        self.assertIn("18 points", self.refused("sweep", *SMALL, "--shard", "1/19", "-o", self.path("a.db")))
        self.assertIn("3 chains", self.refused("sweep", *SMALL, "--carry", "up", "--shard", "1/4", "-o", self.path("a.db")))
        self.assertIn("refined", self.refused("sweep", *SMALL, "--refine", "1", "--shard", "1/2", "-o", self.path("a.db")))
        self.assertEqual(os.listdir(self.directory), [])
        self.good("sweep", *SMALL, "--shard", "1/1", "-o", self.path("a.db"))  # the whole sweep
        self.assertIn("0 of them new", self.good("sweep", *SMALL, "-o", self.path("a.db")))

    def test_it_goes_on_as_itself(self):
        name = self.shard(1, 3)
        before = self.rows(name)
        self.assertIn("all 6 points of shard 1/3, 0 of them new", self.good("sweep", *SMALL, "--shard", "1/3", "-o", name))
        self.assertIn("shard 1/3, not shard 2/3", self.refused("sweep", *SMALL, "--shard", "2/3", "-o", name))
        self.assertIn("shard 1/3, not the whole", self.refused("sweep", *SMALL, "-o", name))
        self.good("sweep", *SMALL, "-o", self.path("one.db"))
        self.assertIn("whole sweep, not shard 1/3", self.refused("sweep", *SMALL, "--shard", "1/3", "-o", self.path("one.db")))
        # Points of other shards are not missing; its own are.
        chains = self.shard(1, 2, *KINDS["carried"][0])
        told = self.good("export", chains, "--csv", "--quantity", "regime")
        self.assertEqual((told.count("\n"), told.count(",done\n")), (6, 5))
        status, out, err = festoon("export", name, "--csv", "--quantity", "regime")
        self.assertEqual((status, out.count("\n"), err), (0, 7, ""))
        self.alter(name, "DELETE FROM rows WHERE point IN (7, 14)")
        status, out, err = festoon("export", name, "--csv", "--quantity", "regime")
        self.assertEqual((status, out.count(",done\n"), out.count(",missing\n")), (0, 4, 2))
        self.assertIn("4 of 6 points", err)
        told = json.loads(self.good("sweep", *SMALL, "--shard", "1/3", "-o", name, "--json"))
        self.assertEqual([told[key] for key in ("points", "computed", "rows", "added")], [18, 6, 6, 2])
        self.assertEqual(self.rows(name), before)

    def test_killed(self):
        """A killed shard is merged as far as it came, with what its log has, and is left as it was; then it goes on."""
        def blow(count):
            words = [*SHORT, "--over", f"drive.frequency=9Hz:20Hz:{count}", *KAPPA]
            name, merged = self.path(f"cut{count}.db"), self.path(f"merged{count}.db")
            if not events.kill_when([FESTOON, "sweep", *words, "--shard", "2/3", "-o", name], lambda: events.rows(name)):
                return False
            files = [name, name + "-wal"]
            before = [content_of(file) for file in files]
            rows = json.loads(self.good("merge", name, "-o", merged, "--json"))["rows"]
            self.assertGreater(rows, 0)
            self.assertEqual([content_of(file) for file in files], before)
            self.assertEqual(events.rows(name), rows)
            added = json.loads(self.good("sweep", *words, "--shard", "2/3", "-o", name, "--json"))["added"]
            self.assertEqual((rows + added, len(self.points(name))), (count, count))
            self.good("sweep", *words, "-o", self.path("one.db"))
            self.good("merge", name, self.path("one.db"), "-o", self.path("all.db"))  # its rows are those of the whole
            return True
        events.struck(blow, 300)

    def test_the_example(self):
        for i in (1, 2):
            subprocess.run(["sh", os.path.join(EXAMPLES, "sweep-array.sbatch"), "2", "2"], check=True, cwd=self.directory,
                           env=dict(os.environ, SLURM_ARRAY_TASK_ID=str(i)), stdout=subprocess.DEVNULL)
        told = self.good("merge", self.path("sweep-array-1.db"), self.path("sweep-array-2.db"), "-o", self.path("all.db"))
        self.assertIn("all 4 points", told)


if __name__ == "__main__":
    unittest.main()
