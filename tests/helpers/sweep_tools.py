"""What the tests of sweeps share: running the program, temporary folders, comparing databases.

Environment: FESTOON is the program, SOURCE_DIR the source tree.
"""

import os
import sqlite3
import subprocess
import tempfile
import unittest

from events import HANG

FESTOON = os.environ["FESTOON"]
SHORT = ["--set", "run.periods=8", "--set", "run.discard=4", "--set", "run.rtol=1e-8"]
SMALL = SHORT + ["--over", "drive.frequency=9Hz:20Hz:6", "--over", "model.kappa=1,1.5,2"]


def festoon(*words, **options):
    options.setdefault("timeout", HANG)
    done = subprocess.run([FESTOON, *words], stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                          stderr=subprocess.PIPE, **options)
    return done.returncode, done.stdout.decode(), done.stderr.decode(errors="replace")


def content_of(path, mode="rb"):
    with open(path, mode) as file:
        return file.read()


RESEAL = os.path.join(os.environ["BUILD_DIR"], "tests", "reseal")


def change(path, *statements, known=True, reseal=RESEAL):
    """Changes a sweep's database by SQL, and gives it the checksums that fit its new contents; `known`: whether its
    scene is still one that this program reads, and that `reseal` was built with."""
    base = sqlite3.connect(path)
    for statement in statements:
        base.execute(*statement) if isinstance(statement, tuple) else base.execute(statement)
    base.commit()
    base.close()
    done = subprocess.run([reseal, path])
    assert done.returncode == (0 if known else 3), done


class Case(unittest.TestCase):
    def setUp(self):
        holder = tempfile.TemporaryDirectory(prefix="festoon-sweep-")
        self.addCleanup(holder.cleanup)
        self.directory = holder.name

    def path(self, name):
        return os.path.join(self.directory, name)

    def good(self, *words, **options):
        status, out, err = festoon(*words, **options)
        self.assertEqual(status, 0, err)
        return out

    def refused(self, *words, status=2, **options):
        before = {name: content_of(self.path(name)) for name in os.listdir(self.directory)
                  if os.path.isfile(self.path(name))}
        found, out, err = festoon(*words, **options)
        self.assertEqual((found, out), (status, ""), err)
        for name, content in before.items():
            self.assertEqual(content_of(self.path(name)), content, name)
        return err

    def rows(self, name):
        return self.good("export", self.path(name), "--csv")
