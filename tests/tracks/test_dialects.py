"""One reader of tables of text: a map, a track and a trajectory are read in every dialect, and give the same numbers.
(The table of measured points: test_points.c.)

A dialect is what separates the cells, the decimal sign, a byte order mark, the ends of lines, and where units stand.

tests: io/text_table.c

Environment: FESTOON is the program.
"""

import itertools
import json
import math
import os
import subprocess
import tempfile
import unittest

FESTOON = os.environ["FESTOON"]

SEPARATORS = {"comma": ",", "semicolon": ";", "tab": "\t", "blanks": "  "}
HEADS = {"brackets": "{} [{}]", "parentheses": "{} ({})", "slash": "{}/{}"}
# Decimal commas stand between commas in quotes alone.
DIALECTS = [(separator, comma, bom, end, head)
            for separator, comma, bom, end, head in itertools.product(
                SEPARATORS, (False, True), (False, True), ("\n", "\r\n"), HEADS)]


def dialect(text, separator, comma, bom, end, head):
    """The table `text`, which has commas, decimal points and units in brackets, in another dialect; comments stay."""
    lines, first = [], True
    for line in text.splitlines():
        if not line.startswith("#"):
            cells = line.split(",")
            if first:
                parts = [cell.rstrip("]").split(" [") for cell in cells]
                cells = [HEADS[head].format(*part) if len(part) == 2 else part[0] for part in parts]
            elif comma:
                cells = [cell.replace(".", ",") for cell in cells]
                cells = [f'"{cell}"' for cell in cells] if separator == "comma" else cells
            first = False
            line = SEPARATORS[separator].join(cells)
        lines.append(line)
    return (("\ufeff" if bom else "") + end.join(lines) + end).encode()


def run(*words):
    done = subprocess.run([FESTOON, *words], capture_output=True, text=True)
    return done.returncode, done.stdout, done.stderr


class Dialects(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.folder.cleanup)

    def path(self, name):
        return os.path.join(self.folder.name, name)

    def write(self, name, data):
        with open(self.path(name), "wb") as out:
            out.write(data)
        return self.path(name)

    def every_dialect(self, name, text, ask, but=()):
        """What ask(path) says is the same of the plain table and of every dialect of it."""
        wanted = ask(self.write(name, text.encode()))
        self.assertEqual(wanted[0], 0, wanted)
        for words in DIALECTS:
            if (words[0], words[-1]) == but:
                continue
            with self.subTest(dialect=words):
                self.assertEqual(ask(self.write(name, dialect(text, *words))), wanted)

    def test_maps(self):
        path = self.path("made.csv")
        scale = ("--set", "model.kappa=1.5", "--set", "magnet.b0=10mT")
        self.assertEqual(run("field", *scale, "--csv", path, "--radius", "45mm", "--spacing", "3mm")[0], 0)
        with open(path) as made:
            text = made.read()
        self.every_dialect("map.csv", text, lambda path: run(
            "field", "--set", "magnet.shape=grid", "--set", f"magnet.file={path}", *scale, "--at", "0.43,-0.61", "--json"))
        # Heads as numpy and people write them.
        wanted = run("field", "--set", "magnet.shape=grid", "--set", f"magnet.file={path}", *scale, "--at", "0.43,-0.61")
        rows = [line for line in text.splitlines() if line[0] != "#"][1:]
        for head in ("# x [mm], y [mm], z [mm], Bx [mT], By [mT], Bz [mT]", '% "X (mm)",Y/mm,z_mm,B_x [mT],b_y_mT,BZ(mT)'):
            for separator in (",", " "):
                for order in ("le", "be"):
                    other = self.write("other.csv", "\n".join(
                        ["\ufeff# measured", head, *(row.replace(",", separator) for row in rows)]).encode("utf-16-" + order))
                    found = run("field", "--set", "magnet.shape=grid", "--set", f"magnet.file={other}", *scale, "--at",
                                "0.43,-0.61")
                    self.assertEqual(found, wanted, (head, separator, order))

    def test_tracks(self):
        rows = []
        for frame in range(240):
            t = frame / 240
            angle, r = -2 * math.pi * 3.2 * t, 80 + 6 * math.cos(2 * math.pi * 16 * t)
            rows.append(f"{frame},{t:.7f},{r * math.cos(angle):.4f},{r * math.sin(angle):.4f}\n")
        # A head that begins otherwise is a table of unknown origin: this is said, and nothing else differs.
        self.every_dialect("track.csv", "t [s],frame,x [mm],y [mm]\n" + "".join(
            ",".join((row.split(",")[1], row.split(",")[0], *row.split(",")[2:])) for row in rows),
            lambda path: run("measure", path, "--json"))
        # The plainest name of a column counts; an index called frame stands before the column.
        plain = run("measure", self.write("track.csv", ("frame,t [s],x [mm],y [mm]\n" + "".join(rows)).encode()), "--json")
        more = [f"9,{row.strip()},1,2,3\n" for row in rows]
        head = "frame,frame,t [s],x [mm],y [mm],x/y,y_px,T_s\n"
        self.assertEqual(run("measure", self.write("track.csv", (head + "".join(more)).encode()), "--json")[:2], plain[:2])
        self.assertIn("twice", run("measure", self.write("track.csv", b"t/s,x/mm,x/cm,y/mm\n1,2,3,4\n"))[2])

    def test_trajectories(self):
        path = self.path("made.csv")
        self.assertEqual(run("run", "--csv", path, "--set", "run.periods=6", "--set", "run.discard=2", "--set",
                             "run.samples=64")[0], 0)
        with open(path) as made:
            text = made.read()

        def ask(path):
            status, said, err = run("measure", path, "--drive", "10.7Hz", "--json")
            return status, said, err

        # "vX/l gamma" between blanks is two columns, for people too.
        self.every_dialect("run.csv", text, ask, but=("blanks", "slash"))


if __name__ == "__main__":
    unittest.main()
