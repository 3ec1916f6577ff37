"""What files of sweeps may be called and where they may lie, and the texts in what is made of them.

tests: sweep/make.c sweep/export.c"""

import csv
import errno
import io
import os
import resource
import shutil
import subprocess
import unittest

from hdf5_reader import Hdf5
from sweep_tools import SHORT, SMALL, change, content_of, festoon
from test_sweep_journal import Journal, rows_in


class Names(Journal):
    def test_every_name_is_that_of_a_file(self):
        expected = self.made("usual.db")
        for name in (":memory:", "file:a.db?mode=memory", "100%.db", "%41.db", "a#b.db", "a?immutable=1",
                     " a b .db", "a'b\".db", "a\nb.db", "-x.db", "ä.db", "a&b=c;d.db"):
            with self.subTest(name=name):
                self.good("sweep", *SMALL, "-o", name, cwd=self.directory)
                self.assertEqual(rows_in(self.path(name)), 18)
                operand = name if name[0] != "-" else "./" + name
                self.assertEqual(self.good("export", operand, "--csv", cwd=self.directory), expected)
                self.assertIn("0 of them new", self.good("sweep", *SMALL, "-o", name, cwd=self.directory))
                status, _, err = festoon("plot", operand, "-o", "figure.svg", cwd=self.directory)
                if not (status == 1 and "gnuplot" in err):
                    self.assertEqual(status, 0, err)
                os.remove(self.path(name))

    def test_names_that_are_too_long(self):
        """SQLite's files beside a database have longer names than the database."""
        longest = os.pathconf(self.directory, "PC_NAME_MAX")
        for length in range(longest - 9, longest + 2):
            name = "n" * (length - 3) + ".db"
            if length <= longest - 8:
                self.made(name)
                os.remove(self.path(name))
                continue
            said = self.refused("sweep", *SMALL, "-o", self.path(name))
            self.assertIn(f"this name of {length} bytes is too long", said)
            self.assertIn(f"at most {longest - 8}", said)
            self.assertEqual(os.listdir(self.directory), [])
        self.made()
        os.rename(self.path("a.db"), self.path("n" * longest))
        self.assertIn("too long", self.refused("export", self.path("n" * longest), "--csv"))

    def test_paths_that_are_too_long(self):
        folder, made = self.directory, 0
        while len(os.path.realpath(folder)) < 520:
            os.mkdir(os.path.join(folder, "f" * 20))
            folder = os.path.join(folder, "f" * 20)
            path = os.path.join(folder, "a.db")
            status, _, err = festoon("sweep", *SMALL, "-o", path)
            if status == 0:
                made += 1
                self.good("export", path, "--csv")
                last = folder
            else:
                self.assertEqual(status, 2, err)
                self.assertIn("too long for SQLite", err)
                self.assertGreater(len(os.path.realpath(path)), 400)
                self.assertEqual(os.listdir(folder), [])
        self.assertGreater(made, 10)
        # A folder that was renamed: a database that is there needs less room than one that is to be made.
        statuses = set()
        for length in range(2, 140, 6):
            longer = os.path.join(os.path.dirname(last), "g" * length)
            os.rename(last, longer)
            last = longer
            status, _, err = festoon("export", os.path.join(last, "a.db"), "--csv")
            self.assertEqual(status, 0 if len(os.path.realpath(last)) + len("/a.db-journal") <= 511 else 2, err)
            self.assertIn("" if status == 0 else "too long for SQLite", err)
            statuses.add(status)
        self.assertEqual(statuses, {0, 2})

    def test_few_files_may_be_open(self):
        """Whichever file cannot be opened first, the message names the limit of open files, not a permission."""
        if not os.path.exists(os.path.join(os.environ["BUILD_DIR"], "tests", "faults.so")):
            self.skipTest("sanitizers need open files of their own")
        self.made()
        for words in (("sweep", *SMALL, "-o", self.path("b.db")), ("sweep", *SMALL, "-o", self.path("a.db")),
                      ("export", self.path("a.db"), "--csv")):
            refusals = 0
            for most in range(4, 12):
                status, _, err = festoon(*words, preexec_fn=lambda most=most: resource.setrlimit(
                    resource.RLIMIT_NOFILE, (most, most)))
                self.assertIn(status, (0, 1, 127), err)  # 127: the program's libraries cannot be opened
                if status == 1:
                    refusals += 1
                    self.assertIn(os.strerror(errno.EMFILE), err)
                    self.assertNotIn("permission", err)
            self.assertGreater(refusals, 0, words)
            self.assertEqual(status, 0, err)

    def test_every_name_where_nothing_may_be_written(self):
        mount = self.path("small")
        os.mkdir(mount)
        if os.getuid() != 0 or subprocess.run(["mount", "-t", "tmpfs", "-o", "size=1m", "none", mount],
                                              stderr=subprocess.DEVNULL).returncode != 0:
            self.skipTest("a small file system needs root")
        self.addCleanup(subprocess.run, ["umount", "-l", mount], check=True)
        expected = self.made("usual.db")
        log = self.log_of("usual.db", "DELETE FROM rows WHERE point > 8", "UPDATE seal SET commits = commits + 7")
        names = ("100%.db", "a#b.db", "a?immutable=0", "a b.db")
        for name in names:
            shutil.copy(self.path("usual.db"), os.path.join(mount, name))
        subprocess.run(["mount", "-o", "remount,ro", mount], check=True)
        for name in names:
            self.assertEqual(self.good("export", os.path.join(mount, name), "--csv"), expected)
        subprocess.run(["mount", "-o", "remount,rw", mount], check=True)
        self.put("small/a b.db-wal", log)
        subprocess.run(["mount", "-o", "remount,ro", mount], check=True)
        self.assertEqual(self.good("export", os.path.join(mount, "a b.db"), "--csv").count("\n"), 10)  # with its log

    def test_links(self):
        expected = self.made("right.db")
        os.mkdir(self.path("folder"))
        os.symlink("folder/a.db", self.path("link.db"))
        self.assertIn("leads to nothing", self.refused("sweep", *SMALL, "-o", self.path("link.db")))
        os.symlink("folder", self.path("short"))
        self.assertEqual(self.made("short/a.db"), expected)
        self.assertEqual(self.rows("link.db"), expected)
        self.put("empty.db", b"")
        self.assertEqual(self.made("empty.db"), expected)


class Texts(Journal):
    def test_quotes_in_csv(self):
        self.made()
        text = 'it said "no, never",\nand went "'
        change(self.path("a.db"), ("UPDATE rows SET reason = ? WHERE point = 4", (text,)))
        rows = list(csv.DictReader(io.StringIO(self.rows("a.db"))))
        self.assertEqual(len(rows), 18)
        self.assertEqual(rows[4]["reason"], text.replace("\n", "?"))  # no control character leaves a file

    def test_units_of_an_hdf5_file(self):
        self.made()
        status, _, err = festoon("export", self.path("a.db"), "--hdf5", "-o", self.path("a.h5"))
        if status == 1 and "HDF5" in err:
            self.skipTest("built without HDF5")
        self.assertEqual(status, 0, err)
        file = Hdf5(self.path("a.h5"))
        self.addCleanup(file.close)
        units = file.attribute(None, "units")
        for words in ("lengths in l", "times in 1/gamma", "fields in B0"):
            self.assertIn(words, units)


    def test_columns_of_unequal_length(self):
        """The file is made by HDF5 itself, so that every checksum in it is right."""
        status, _, err = festoon("run", *SHORT, "-o", self.path("t.h5"))
        if status != 0 and "HDF5" in err:
            self.skipTest("built without HDF5")
        self.assertEqual(status, 0, err)
        whole = content_of(self.path("t.h5"))
        for change in (-1, 1, -10000):
            self.put("t.h5", whole)
            file = Hdf5(self.path("t.h5"), writable=1)
            rows = len(file.column("r"))
            file.resize("r", max(rows + change, 1))
            file.close()
            self.assertIn("the column r has another length",
                          self.refused("plot", self.path("t.h5"), "-o", self.path("f.svg")))


if __name__ == "__main__":
    unittest.main()
