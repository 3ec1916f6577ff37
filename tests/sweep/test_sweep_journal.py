"""What the journal of a sweep trusts, which command may write it, and its messages when it is damaged, deleted or
replaced.

tests: sweep/journal.c sweep/database.c sweep/file.c sweep/log.c sweep/make.c sweep/lock.c sweep/rows.c
labels: slow"""

import errno
import os
import shutil
import signal
import socket
import sqlite3
import subprocess
import sys
import time
import unittest

import events
from sweep_tools import FESTOON, SHORT, SMALL, Case, change, content_of, festoon

sys.path.append(os.path.join(os.environ["SOURCE_DIR"], "tests", "reliability"))
from power import read_log  # noqa: E402

OTHER = SHORT + ["--over", "drive.frequency=9Hz:20Hz:6", "--over", "model.kappa=1,1.5,2", "--set", "start.r=0.9"]


class Journal(Case):
    def made(self, name="a.db", words=SMALL):
        self.good("sweep", *words, "-o", self.path(name))
        return self.rows(name)

    def log_of(self, name, *statements):
        """Makes a write-ahead log with these changes of a database, and leaves the database as it was."""
        shutil.copy(self.path(name), self.path("twin.db"))
        base = sqlite3.connect(self.path("twin.db"))
        base.execute("PRAGMA wal_autocheckpoint = 0")
        for statement in statements:
            base.execute(statement)
        base.commit()
        log = content_of(self.path("twin.db-wal"))
        base.close()
        os.remove(self.path("twin.db"))
        return log

    def put(self, name, content):
        with open(self.path(name), "wb") as out:
            out.write(content)


class Logs(Journal):
    """Files whose names make SQLite take them for the log of a database."""

    CHANGES = ("UPDATE rows SET mean_r = 9", "UPDATE seal SET commits = commits + 7")

    def test_a_new_sweep_has_nothing_of_a_deleted_one(self):
        self.made("dead.db", OTHER)
        expected = self.made("right.db")
        for ending, content in (("-wal", self.log_of("dead.db", *self.CHANGES)), ("-shm", bytes(32768)),
                                ("-journal", b"\xd9\xd5\x05\xf9\x20\xa1\x63\xd7" + bytes(8184))):
            self.put("a.db" + ending, content)
        self.assertEqual(self.made(), expected)
        self.assertEqual([name for name in os.listdir(self.directory) if name.startswith("a.db-")], [])

    def test_what_a_killed_command_left_is_removed(self):
        """The next command removes what a killed one left, whether the database exists already or is to be made; what
        belongs to another name stays."""
        expected = self.made()
        for _ in range(2):
            for name in (".a.db.festoon.part", ".b.db.festoon.part"):
                self.put(name, b"half a database")
            self.assertEqual(self.made(), expected)
            self.assertEqual(sorted(os.listdir(self.directory)), [".b.db.festoon.part", "a.db"])
            os.remove(self.path("a.db"))

    def test_a_killed_sweep_whose_file_alone_was_deleted(self):
        process, _ = begin(self, "a.db")
        process.kill()
        process.communicate()
        os.remove(self.path("a.db"))
        if os.path.getsize(self.path("a.db-wal")) == 0:
            self.skipTest("it was stopped when its log had just been emptied")
        self.assertEqual(self.made(), self.made("right.db"))

    def test_the_log_of_another_database_is_refused(self):
        self.made("dead.db", OTHER)
        self.made()
        for ending, content in (("-wal", self.log_of("dead.db", *self.CHANGES)),
                                ("-wal", self.log_of("dead.db", self.CHANGES[0])),  # without any mark
                                ("-journal", b"\xd9\xd5\x05\xf9\x20\xa1\x63\xd7" + bytes(8184))):
            self.put("a.db" + ending, content)
            for words in (("sweep", *SMALL, "-o", self.path("a.db")), ("export", self.path("a.db"), "--csv"),
                          ("plot", self.path("a.db"), "-o", self.path("f.svg"))):
                self.assertIn("the log of another database", self.refused(*words))
            os.remove(self.path("a.db" + ending))

    def test_its_own_log_is_read(self):
        self.made()
        log = self.log_of("a.db", "DELETE FROM rows WHERE point > 8", self.CHANGES[1])
        self.put("a.db-wal", log)
        self.assertEqual(self.rows("a.db").count("\n"), 10)
        self.put("a.db-wal", b"")

    def test_a_log_that_was_left_behind_is_refused(self):
        """A database was moved without its log, finished, and moved back: that log would undo later commits."""
        self.made()
        log = self.log_of("a.db", "DELETE FROM rows WHERE point > 8", self.CHANGES[1])
        for more, older in ((7, False), (8, True), (300, True)):
            shutil.copy(self.path("a.db"), self.path("b.db"))
            base = sqlite3.connect(self.path("b.db"))
            base.execute(f"UPDATE seal SET commits = commits + {more}")
            base.commit()
            base.close()
            self.put("b.db-wal", log)
            before = content_of(self.path("b.db"))
            for words in (("export", self.path("b.db"), "--csv"), ("plot", self.path("b.db"), "-o", self.path("f.svg")),
                          ("sweep", *SMALL, "-o", self.path("b.db"))) if older else ():
                self.assertIn("an older log of this one", self.refused(*words))
                self.assertEqual((content_of(self.path("b.db")), content_of(self.path("b.db-wal"))), (before, log))
            if older:
                os.remove(self.path("b.db-wal"))
            self.assertEqual(self.rows("b.db").count("\n"), 19 if older else 10)

    def test_a_damaged_log_is_told(self):
        expected = self.made()
        log = bytearray(self.log_of("a.db", "DELETE FROM rows WHERE point > 8", self.CHANGES[1]))
        log[len(log) // 2] ^= 4
        self.put("a.db-wal", log)
        self.assertIn("log cannot be read", self.refused("export", self.path("a.db"), "--csv"))
        self.assertIn("was damaged", festoon("sweep", *SMALL, "-o", self.path("a.db"))[2])
        self.assertEqual(self.rows("a.db"), expected)
        self.assertEqual(content_of(self.path("a.db.damaged-wal")), log)


    def test_what_a_killed_commit_left_in_the_log_is_no_damage(self):
        """Killed while it wrote many pages, begun again, and killed after it had written fewer."""
        process, points = begin(self, "a.db")
        process.kill()
        process.communicate()
        self.good("export", self.path("a.db"), "--csv")  # empties the log
        log = self.log_of("a.db", self.CHANGES[1], "COMMIT", "BEGIN",
                          "CREATE TABLE pages AS SELECT zeroblob(10000000)", self.CHANGES[1])
        page = int.from_bytes(log[8:12], "big")
        self.put("a.db-wal", log[:-24 - page])
        seen = events.rows(self.path("a.db"))
        process = events.start([FESTOON, "sweep", *long_sweep(points), "-o", self.path("a.db")])
        events.wait_for(process, lambda: events.rows(self.path("a.db")) > seen)
        process.kill()
        process.communicate()
        self.good("export", self.path("a.db"), "--csv")

    def test_a_read_that_fails_is_no_damage(self):
        """A single read fails: whichever it is, the file is not called damaged, and is not replaced."""
        faults = os.path.join(os.environ["BUILD_DIR"], "tests", "faults.so")
        if not os.path.exists(faults):
            self.skipTest("nothing can be preloaded into a program with sanitizers")
        self.made()
        files = {"a.db": content_of(self.path("a.db")), "a.db-wal": self.log_of("a.db", self.CHANGES[1])}
        environment = dict(os.environ, LD_PRELOAD=faults, FESTOON_FAULT_UNDER=self.directory,
                           FESTOON_FAULT_FIRED=self.path("fired"))

        def fate(words, fault):
            for name in os.listdir(self.directory):
                os.remove(self.path(name))
            for name, content in files.items():
                self.put(name, content)
            found = festoon(*words, env=dict(environment, FESTOON_FAULT=f"festoon:{fault}"))
            self.assertEqual([name for name in os.listdir(self.directory) if "damaged" in name], [], found)
            return found

        for words, step in (("export", self.path("a.db"), "--csv"), 1), (("sweep", *SMALL, "-o", self.path("a.db")), 3):
            number, statuses = 1, []
            while number < 1000:
                status, _, err = fate(words, f"read:{errno.EIO}:{number}")
                if not os.path.exists(self.path("fired")):
                    break
                self.assertIn(status, (0, 1), (words[0], number, err))
                statuses.append(status)
                number += step
            self.assertIn(1, statuses)
        self.assertEqual(fate(("export", self.path("a.db"), "--csv"), "interrupted:0:0")[0], 0)


def long_sweep(points):
    return SHORT + ["--over", f"drive.frequency=9Hz:20Hz:{points}", "--threads", "2"]


def begin(case, name):
    """Starts a sweep and stops it when it has its first rows; returns it and its number of points, which is raised
    until the program is still at work when it is stopped."""
    points = int(1500 / float(os.environ.get("FESTOON_SHORTER", "1")))
    while points < 3000000:
        process = subprocess.Popen([FESTOON, "sweep", *long_sweep(points), "-o", case.path(name)],
                                   stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        case.addCleanup(process.kill)
        while process.poll() is None:
            if os.path.exists(case.path(name)) and rows_in(case.path(name)) > 0:
                os.kill(process.pid, signal.SIGSTOP)  # send_signal() would reap a program that is over
                os.waitid(os.P_PID, process.pid, os.WSTOPPED | os.WEXITED | os.WNOWAIT)
                if process.poll() is None and rows_in(case.path(name)) < points:
                    return process, points
                process.send_signal(signal.SIGCONT)
                break
            time.sleep(0.01)
        process.communicate()
        os.remove(case.path(name))
        points *= 4
    raise unittest.SkipTest("this machine is too fast for these sweeps")


def rows_in(path):
    base = sqlite3.connect(path, timeout=60)
    try:
        return base.execute("SELECT count(*) FROM rows").fetchone()[0]
    finally:
        base.close()


class Company(Journal):
    """Several commands work on one file."""

    def end(self, process):
        process.send_signal(signal.SIGCONT)
        out, err = process.communicate(timeout=600)
        return process.returncode, out.decode(), err.decode()

    def test_the_second_says_who_is_at_work(self):
        first, points = begin(self, "a.db")
        status, out, err = festoon("sweep", *long_sweep(points), "-o", self.path("a.db"))
        self.assertEqual((status, out), (1, ""), err)
        self.assertIn(f"process {first.pid} on {socket.gethostname()}", err)
        os.symlink(self.path("a.db"), self.path("link.db"))
        self.assertIn("at work", festoon("sweep", *long_sweep(points), "-o", self.path("link.db"))[2])
        self.assertGreater(self.rows("a.db").count("\n"), 1)  # reading goes on
        first.kill()
        first.communicate()
        self.good("sweep", *long_sweep(points), "-o", self.path("a.db"))  # no waiting for the killed one's lock
        self.assertEqual(self.rows("a.db").count("\n"), points + 1)

    def test_many_make_the_same_file(self):
        expected = self.made("right.db")
        for i in range(5):
            name = f"race{i}.db"
            racers = [subprocess.Popen([FESTOON, "sweep", *SMALL, "-o", self.path(name)], stdin=subprocess.DEVNULL,
                                       stdout=subprocess.DEVNULL, stderr=subprocess.PIPE) for _ in range(5)]
            ends = [(racer.communicate()[1], racer.returncode) for racer in racers]
            self.assertIn(0, [status for _, status in ends], ends)
            for err, status in ends:
                self.assertIn(status, (0, 1), err)
                self.assertEqual(b"at work" in err, status == 1, err)
            self.assertEqual(self.rows(name), expected)
        self.assertEqual([name for name in os.listdir(self.directory) if not name.endswith(".db")], [])

    def test_deleted_under_way(self):
        process, points = begin(self, "a.db")
        os.remove(self.path("a.db"))
        status, out, err = self.end(process)
        self.assertEqual((status, out), (1, ""), err)
        self.assertIn("a.db.rescued", err)
        self.assertGreater(self.rows("a.db.rescued").count("\n"), 1)
        os.rename(self.path("a.db.rescued"), self.path("a.db"))
        self.good("sweep", *long_sweep(points), "-o", self.path("a.db"))
        self.assertEqual(self.rows("a.db").count("\n"), points + 1)

    def test_replaced_under_way(self):
        self.made("other.db", OTHER)
        sound = content_of(self.path("other.db"))
        process, points = begin(self, "a.db")
        os.replace(self.path("other.db"), self.path("a.db"))
        status, out, err = self.end(process)
        self.assertEqual((status, out), (1, ""), err)
        self.assertIn("a.db.rescued", err)
        self.assertEqual(content_of(self.path("a.db")), sound)

    def test_renamed_under_way(self):
        process, points = begin(self, "a.db")
        os.rename(self.path("a.db"), self.path("b.db"))
        status, out, err = self.end(process)
        self.assertEqual((status, out), (1, ""), err)
        self.assertIn(os.path.join(os.path.realpath(self.directory), "b.db"), err)
        self.assertGreater(self.rows("b.db").count("\n"), 1)
        self.good("sweep", *long_sweep(points), "-o", self.path("b.db"))

    def test_its_folder_deleted_or_renamed(self):
        for what, words in ((lambda: shutil.rmtree(self.path("f")), "lost"),
                            (lambda: os.rename(self.path("f"), self.path("g")), "/g/a.db")):
            os.mkdir(self.path("f"))
            process, _ = begin(self, "f/a.db")
            what()
            status, out, err = self.end(process)
            self.assertEqual((status, out), (1, ""), err)
            self.assertIn(words, err)
        self.assertGreater(self.rows("g/a.db").count("\n"), 1)


class Damage(Journal):
    def check(self, expected, lost, *words):
        """The export names the points that are lost and has the others, and a sweep computes the lost ones again."""
        err = self.refused("export", self.path("a.db"), "--csv")
        self.assertIn("damaged", err)
        for word in words:
            self.assertIn(word, err)
        self.assertIn("damaged", self.refused("plot", self.path("a.db"), "-o", self.path("f.svg")))
        self.assertEqual(festoon("export", self.path("a.db"), "--csv", "-o", self.path("a.csv"))[0], 2)
        kept = [line for point, line in enumerate(expected.splitlines()[1:]) if point not in lost]
        self.assertEqual(content_of(self.path("a.csv"), "r").splitlines()[1:], kept)
        status, out, err = festoon("sweep", *SMALL, "-o", self.path("a.db"))
        self.assertEqual(status, 0, err)
        self.assertIn("damaged", err)
        self.assertEqual(self.rows("a.db"), expected)

    def alter(self, *statements):
        base = sqlite3.connect(self.path("a.db"))
        for statement in statements:
            base.execute(statement)
        base.commit()
        base.close()

    def test_rows_that_were_changed(self):
        expected = self.made()
        self.made("other.db", OTHER)
        for lost, words, statement in (
                ({3}, ["the row of point 3 is lost"], "UPDATE rows SET mean_r = mean_r + 1e-15 WHERE point = 3"),
                ({4}, ["the row of point 4 is lost"], "UPDATE rows SET mean_r = 'much' WHERE point = 4"),
                ({5}, ["the row of point 5 is lost"], "UPDATE rows SET reason = 'all is well' WHERE point = 5"),
                ({0, 17}, ["points 0, 17 are"], "UPDATE rows SET returns = 7 WHERE point IN (0, 17)"),
                ({2}, ["the row of point 2 is lost"], "UPDATE rows SET final_X = NULL WHERE point = 2"),
                ({1}, ["the row of point 1 is lost"], "UPDATE rows SET \"model.kappa\" = 2 WHERE point = 1"),
                ({1, 2}, ["points 1-2 are"], "UPDATE rows SET checksum = 0 WHERE point IN (1, 2)"),
                ({7}, ["the row of point 7 is lost"], "UPDATE rows SET checksum = NULL WHERE point = 7"),
                ({8}, ["1 of its rows belong to no point"], "UPDATE rows SET point = 18 WHERE point = 8"),
                ({9}, ["1 of its rows belong to no point"], "UPDATE rows SET point = -1 WHERE point = 9")):
            with self.subTest(statement=statement):
                self.alter(statement)
                self.check(expected, lost, *words)
        self.alter(f"ATTACH '{self.path('other.db')}' AS other", "REPLACE INTO rows SELECT * FROM other.rows WHERE point = 6")
        self.check(expected, {6}, "the row of point 6 is lost")

    def test_pages_that_were_damaged(self):
        """Damages each page in turn: either rows are named as lost and the rest goes on, or the file is called
        damaged."""
        expected = self.made()
        sound = content_of(self.path("a.db"))
        repaired = 0
        for page in range(1, len(sound) // 4096):
            self.put("a.db", sound[:4096 * page] + bytes([0x5A]) * 4096 + sound[4096 * page + 4096:])
            err = self.refused("export", self.path("a.db"), "--csv")
            self.assertIn("damaged", err)
            status, _, err = festoon("sweep", *SMALL, "-o", self.path("a.db"))
            self.assertIn("damaged", err)
            self.assertIn(status, (0, 2))
            if status == 0:
                repaired += 1
                self.assertEqual(self.rows("a.db"), expected)
        self.assertGreater(repaired, 2)
        self.put("a.db", sound[:4096 * 6] + bytes(4096) + sound[4096 * 7:])
        self.assertRegex(self.refused("export", self.path("a.db"), "--csv"), "rows of the points [0-9]+-[0-9]+ are lost")

    def test_what_it_is_a_sweep_of(self):
        self.made()
        sound = content_of(self.path("a.db"))
        for words, statement in (("agree with its checksum", "UPDATE festoon SET value = value || ' ' WHERE key = 'axis_1'"),
                                 ("agree with its checksum", "DELETE FROM festoon WHERE key = 'checksum'"),
                                 ("agree with its checksum", "UPDATE festoon SET value = 7 WHERE key = 'seed'"),
                                 ("older festoon", "PRAGMA user_version = 1"), ("format 3", "PRAGMA user_version = 3"),
                                 ("tables of this database", "CREATE INDEX i ON rows(mean_r)"),
                                 ("tables of this database", "CREATE VIEW v AS SELECT 1"),
                                 ("tables of this database", "CREATE TABLE t(a)"),
                                 ("tables of this database", "CREATE TRIGGER t AFTER INSERT ON rows BEGIN SELECT 1; END"),
                                 ("tables of this database", "ALTER TABLE rows ADD COLUMN more"),
                                 ("not that of a sweep", "PRAGMA application_id = 1")):
            with self.subTest(statement=statement):
                self.put("a.db", sound)
                self.alter(statement)
                for command in (("sweep", *SMALL, "-o", self.path("a.db")), ("export", self.path("a.db"), "--csv")):
                    self.assertIn(words, self.refused(*command))

    def test_all_that_makes_a_sweep_is_compared(self):
        """Changes each line of the identity, with checksums that agree: a wrong value is refused and named."""
        self.made()
        sound = content_of(self.path("a.db"))
        for key, value in (("fingerprint", "0123456789abcdef"), ("arithmetic", "other"), ("results_version", "1"),
                           ("carry", "up"), ("seed", "5")):
            self.put("a.db", sound)
            change(self.path("a.db"), ("UPDATE festoon SET value = ? WHERE key = ?", (value, key)))
            self.assertIn(key, self.refused("sweep", *SMALL, "-o", self.path("a.db")))
            self.rows("a.db")

    def test_a_scene_with_a_key_that_is_gone(self):
        """The database of a festoon that knew run.controller: no command reads it, and the sentence says why."""
        self.made()
        change(self.path("a.db"), "UPDATE festoon SET value = replace(value, 'run:', 'run:' || char(10) || "
                                  "'  controller: plain') WHERE key = 'scene'", known=False)
        for command in (("sweep", *SMALL, "-o", self.path("a.db")), ("export", self.path("a.db"), "--csv")):
            said = self.refused(*command)
            self.assertIn("run.controller is gone", said)
            self.assertIn("left untouched", said)

    def test_what_is_no_sweep(self):
        """Each command says what the file is, and gives advice that fits."""
        base = sqlite3.connect(self.path("foreign.db"))
        base.execute("CREATE TABLE notes(text)")
        base.commit()
        base.close()
        self.put("junk.db", bytes(range(256)) * 20)
        self.put("empty.db", b"")
        self.put("foreign", content_of(self.path("foreign.db")))
        for name, kind in (("junk.db", "not a database of a sweep"), ("empty.db", "not a database of a sweep"),
                           ("foreign.db", "another program made it"), ("foreign", "another program made it")):
            for words in (("export", self.path(name), "--csv"), ("plot", self.path(name), "-o", self.path("f.svg"))):
                said = self.refused(*words)
                self.assertIn(kind, said)
                self.assertIn("festoon sweep -o FILE.db", said)
                self.assertNotIn("choose another name", said)
            if name != "empty.db":  # a sweep replaces an empty file
                said = self.refused("sweep", *SMALL, "-o", self.path(name))
                self.assertIn(kind, said)
                self.assertIn("choose another name", said)
        self.made()
        self.alter("PRAGMA user_version = 1")
        self.assertIn("older festoon", self.refused("plot", self.path("a.db"), "-o", self.path("f.svg")))

    def test_images_of_runs_may_be_there(self):
        self.made()
        self.alter("CREATE TABLE checkpoints(point INTEGER PRIMARY KEY, size INTEGER NOT NULL, checksum INTEGER NOT NULL, "
                   "image BLOB NOT NULL)")
        self.rows("a.db")


class Power(Journal):
    """A small sample of losses of power; tests/reliability/power.py builds the states of the disk."""

    def test_rows_are_on_the_disk_before_they_count(self):
        recorder = os.path.join(os.environ["BUILD_DIR"], "tests", "disk_recorder.so")
        if not os.path.exists(recorder):
            self.skipTest("built without a recorder of the disk")
        folder = os.path.realpath(self.directory)
        environment = dict(os.environ, LD_PRELOAD=recorder, DISK_FOLDER=folder, DISK_LOG=self.path("record"))
        status, _, err = festoon("sweep", *SMALL, "-o", os.path.join(folder, "a.db"), env=environment)
        self.assertEqual(status, 0, err)
        name, waits, synced = None, False, 0
        for kind, inode, *more in read_log(self.path("record")):
            if kind == "C" and more[0].endswith("a.db-wal"):
                name, waits = inode, False
            waits = waits or (kind == "W" and inode == name)
            if kind == "S" and inode == name:
                waits, synced = False, synced + 1
        if name is None:
            self.skipTest("on this file system a sweep has no write-ahead log")
        self.assertGreater(synced, 0)
        self.assertFalse(waits, "the last rows of the log were never synced")

    def test_a_folder_that_cannot_be_synced(self):
        """A file whose name a loss of power may undo is not reported as written, and the next command can use it."""
        faults = os.path.join(os.environ["BUILD_DIR"], "tests", "faults.so")
        if not os.path.exists(faults):
            self.skipTest("nothing can be preloaded into a program with sanitizers")
        environment = dict(os.environ, LD_PRELOAD=faults, FESTOON_FAULT_UNDER=self.directory,
                           FESTOON_FAULT_FIRED=self.path("fired"))

        def fate(number, *words):
            found = festoon(*words, env=dict(environment, FESTOON_FAULT=f"festoon:fsync:{errno.EIO}:{number}"))
            return found[0], found[2]

        status, err = fate(2, "run", *SHORT, "-o", self.path("t.csv"))  # the first fsync is that of the file
        self.assertEqual(status, 1, err)
        self.assertIn("this file is complete, but a loss of power may undo it: its directory cannot be synced", err)
        self.assertIn("# complete = true", content_of(self.path("t.csv"), "r"))
        expected = self.made("right.db")
        told, number = 0, 0
        os.remove(self.path("fired"))
        while number == 0 or os.path.exists(self.path("fired")):
            number += 1
            for name in ("fired", "a.db", "a.db-wal", "a.db-shm"):
                if os.path.exists(self.path(name)):
                    os.remove(self.path(name))
            status, err = fate(number, "sweep", *SMALL, "-o", self.path("a.db"))
            told += status == 1 and "its directory cannot be synced" in err
            self.assertIn(status, (0, 1), (number, err))
            if os.path.exists(self.path("fired")):
                self.assertEqual(self.made(), expected)
        self.assertEqual(told, 1)


if __name__ == "__main__":
    unittest.main()
