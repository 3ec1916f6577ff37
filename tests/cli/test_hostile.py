"""Files and options of strangers are data: hostile texts in every place that holds a text, and in file names.

Each text would make a canary file if gnuplot, a shell or another helper took it for more than a text.  No control
character reaches a terminal, no text of a stranger reaches a figure's script, and what is refused is refused with
status 2 and one sentence.

tests: base/text.c draw/gnuplot.c host/regular_file.c
labels: slow"""

import ctypes
import json
import os
import re
import shutil
import sqlite3
import subprocess
import tempfile
import unittest
import xml.etree.ElementTree
from pathlib import Path

from hdf5_reader import Hdf5

FESTOON = os.environ["FESTOON"]
HAVE_GNUPLOT = shutil.which("gnuplot") is not None
HAVE_FFMPEG = shutil.which("ffmpeg") is not None
# A place takes one of so many texts, and the next place the next ones, so that every text meets many places.
EVERY = 3 if float(os.environ.get("FESTOON_SHORTER", "1")) == 1 else 9
SHORT = ("--set", "run.periods=4", "--set", "run.discard=1", "--set", "run.samples=8")

# CANARY stands for the path of the canary.
POISONS = ["x\n!touch CANARY\n", "`touch CANARY`", "x\n`touch CANARY`", "\"; system(\"touch CANARY\"); #",
           "'; system('touch CANARY'); '", "'\nsystem('touch CANARY')\n'", "$(touch CANARY)", "; touch CANARY #",
           "| touch CANARY", "< touch CANARY", "<script>alert(1)</script><img src=x onerror=alert(1)>",
           "\x1b[2J\x1b]0;owned\x07", "a\u009b2Jb", "a\u202eb", "%s%n%x\\n", "{/=99999999 x}", "\r\n\t\x00"]
# Sequences that a terminal obeys, and characters that hide the rest of a line.
CONTROL = re.compile("[\x00-\x09\x0b-\x1f\x7f-\x9f\u2028-\u202e\u2066-\u2069]")


class Hostile(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.holder = tempfile.TemporaryDirectory(prefix="festoon-hostile-")
        cls.folder = Path(cls.holder.name)
        cls.canary = cls.folder / "canary"
        cls.poisons = [text.replace("CANARY", str(cls.canary)) for text in POISONS]
        cls.poisons_without_zero = [text.replace("\x00", "") for text in cls.poisons]

    @classmethod
    def tearDownClass(cls):
        cls.holder.cleanup()

    def path(self, name):
        return self.folder / name

    def run_festoon(self, *words):
        return subprocess.run([FESTOON, *map(str, words)], stdin=subprocess.DEVNULL, capture_output=True, cwd=self.folder,
                              timeout=300)

    def good(self, *words):
        done = self.run_festoon(*words)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout

    def harmless(self, *words, statuses=(2,), note=None):
        """The command ends with one of these statuses, and neither its messages nor its files do any harm."""
        done = self.run_festoon(*words)
        note = (note, words, done.stderr)
        self.assertIn(done.returncode, statuses, note)
        self.assertFalse(self.canary.exists(), note)
        for stream in (done.stdout, done.stderr):
            self.assertIsNone(CONTROL.search(stream.decode()), note)
        if done.returncode == 2:
            self.assertEqual(done.stdout, b"", note)
            self.assertRegex(done.stderr.decode(), r"\Afestoon: [^\n]+\n\Z", note)
        return done

    def check_figure(self, stem, poison):
        """Figure, script and data, if they exist, hold only words of festoon's own."""
        for ending in ("svg", "gp", "dat"):
            path = self.path(stem + "." + ending)
            if not path.exists():
                continue
            text = path.read_text()
            self.assertIsNone(CONTROL.search(text.replace("\t", "") if ending == "svg" else text), path)
            self.assertNotIn(str(self.canary), text)
            self.assertNotIn("<script", text)
            if len(poison) > 8:
                self.assertNotIn(poison, text)
            if ending == "svg":
                xml.etree.ElementTree.fromstring(text)
            path.unlink()

    # ------------------------------------------------------------------ files

    def test_scenes(self):
        """A hostile text in place of every key, every value and every group of a scene."""
        lines = [line for line in self.good("init", "-").decode().splitlines() if line and not line.lstrip().startswith("#")]
        places = [(i, part) for i, line in enumerate(lines) for part in (0, 1) if line.partition(":")[2 * part].strip()]
        scene, count = self.path("scene.yaml"), 0
        for turn, (i, part) in enumerate(places):
            indent, (key, colon, value) = lines[i][:len(lines[i]) - len(lines[i].lstrip())], lines[i].strip().partition(":")
            quoted = json.dumps(self.poisons[turn % len(POISONS)])
            line = indent + (f"{quoted}:{value}" if part == 0 else f"{key}: {quoted}")
            scene.write_text("\n".join([*lines[:i], line, *lines[i + 1:]]) + "\n")
            self.harmless("check", scene, note=(line,))
            count += 1
        self.assertGreater(count, 50)
        self.harmless("run", scene)
        self.harmless("sweep", scene, "--over", "model.kappa=1:2:2", "-o", self.path("none.db"))
        for poison in self.poisons:  # as it is, without quotation marks
            scene.write_text("bead:\n  radius: " + poison)
            self.harmless("run", scene)

    def trajectory(self):
        path = self.path("track.csv")
        if not path.exists():
            self.good("run", *SHORT, "-o", path)
        return path.read_text().splitlines()

    @unittest.skipUnless(HAVE_GNUPLOT, "no gnuplot")
    def test_trajectories_as_text(self):
        """A hostile text in every line of the head and of the end, in names of columns, and in a cell."""
        lines, bad, out = self.trajectory(), self.path("bad.csv"), "csv-figure"
        names = next(i for i, line in enumerate(lines) if not line.startswith("#"))
        for turn, i in enumerate([*range(names + 2), len(lines) - 2, len(lines) - 1]):
            poison = self.poisons[turn % len(POISONS)]
            kinds = (lines[i].split("=")[0].rstrip("[") + "= " + poison, lines[i] + poison, poison)
            for line in kinds if turn % 6 == 0 else kinds[turn % 3:turn % 3 + 1]:
                bad.write_bytes("\n".join([*lines[:i], line, *lines[i + 1:], ""]).encode())
                self.harmless("plot", bad, "-o", self.path(out + ".svg"), statuses=(0, 2), note=(i, line))
                self.check_figure(out, poison)
        bad.write_bytes("\n".join([*lines[:names], self.poisons[0], *lines[names + 1:], ""]).encode())
        self.harmless("movie", bad, "-o", self.path("no.mp4"), statuses=(2,))
        self.assertFalse(self.path("no.mp4").exists())

    def set_attribute(self, path, place, name, text):
        """Puts another text into an attribute of an HDF5 file, by HDF5 itself, so that its checksums are right."""
        reader = Hdf5(str(path))
        h5, number = reader.library, ctypes.c_int64
        reader.close()
        for function in ("H5Oopen", "H5Tcopy", "H5Screate", "H5Acreate2", "H5Fopen"):
            getattr(h5, function).restype = number
        zero = number(0)
        file = number(h5.H5Fopen(str(path).encode(), 1, zero))
        where = number(h5.H5Oopen(file, place.encode(), zero))
        kind, space = number(h5.H5Tcopy(number.in_dll(h5, "H5T_C_S1_g"))), number(h5.H5Screate(0))
        h5.H5Tset_size(kind, ctypes.c_size_t(len(text) + 1))
        self.assertGreaterEqual(h5.H5Adelete(where, name.encode()), 0)
        attribute = number(h5.H5Acreate2(where, name.encode(), kind, space, zero, zero))
        self.assertGreaterEqual(h5.H5Awrite(attribute, kind, text + b"\0"), 0)
        for close, what in (("H5Aclose", attribute), ("H5Sclose", space), ("H5Tclose", kind), ("H5Oclose", where),
                            ("H5Fclose", file)):
            self.assertGreaterEqual(getattr(h5, close)(what), 0)

    @unittest.skipUnless(HAVE_GNUPLOT, "no gnuplot")
    def test_trajectories_in_hdf5(self):
        """A hostile text in every attribute of the file and of a column, and hostile scenes in the file."""
        source, bad, out = self.path("track.h5"), self.path("bad.h5"), "h5-figure"
        if "hdf5 yes" not in self.good("--version").decode():
            self.skipTest("no HDF5")
        self.good("run", *SHORT, "-o", source)
        scene = self.good("init", "-").decode()
        texts = [(place, name, poison) for turn, (place, name) in enumerate([
            ("/", "program"), ("/", "version"), ("/", "units"), ("/", "result"), ("/", "scene"), ("/r", "unit"),
            ("/n_z", "description")]) for poison in self.poisons_without_zero[turn::3 * EVERY]]
        texts += [("/", "scene", scene.replace(word, json.dumps(poison))) for poison in self.poisons_without_zero[::2 * EVERY]
                  for word in ("rigid", "2.5 mm", "viscous")]
        for place, name, text in texts:
            shutil.copy(source, bad)
            self.set_attribute(bad, place, name, text.encode())
            statuses = (2,) if name in ("program", "scene") else (0,)
            self.harmless("plot", bad, "-o", self.path(out + ".svg"), statuses=statuses, note=(place, name, text[:200]))
            self.check_figure(out, text)
        self.harmless("movie", bad, "-o", self.path("no.mp4"))

    def texts_of(self, document, way=()):
        """The paths to every text of a document."""
        for key, value in document.items() if isinstance(document, dict) else enumerate(document):
            if isinstance(value, str):
                yield (*way, key)
            elif isinstance(value, (dict, list)):
                yield from self.texts_of(value, (*way, key))

    @staticmethod
    def replaced(document, way, text):
        copy = json.loads(json.dumps(document))
        place = copy
        for key in way[:-1]:
            place = place[key]
        place[way[-1]] = text
        return copy

    @unittest.skipUnless(HAVE_GNUPLOT, "no gnuplot")
    def test_branches(self):
        """A hostile text in place of every text of a branch; an unknown parameter is refused."""
        source, bad, out = self.path("branch.json"), self.path("bad.json"), "branch-figure"
        self.good("branch", "--kind", "locked", "--over", "drive.omega=0.2:0.201", "-o", source)
        document = json.loads(source.read_text())
        ways = {way[0] if way[0] != "ends" else way[-1]: way for way in self.texts_of(document)}
        self.assertIn("parameter", ways)
        ways["second_parameter"] = ("second_parameter",)
        for turn, (name, way) in enumerate(ways.items()):
            poisons = self.poisons[turn % EVERY::EVERY if "parameter" in name else 2 * EVERY]
            for poison in poisons:
                bad.write_text(json.dumps(self.replaced(document, way, poison)))
                statuses = (2,) if "parameter" in name else (0, 2)
                self.harmless("plot", bad, "-o", self.path(out + ".svg"), statuses=statuses, note=(way, poison))
                self.check_figure(out, poison)
        bad.write_text(source.read_text()[:-40] + "\x1b[2J")
        self.harmless("plot", bad, "-o", self.path(out + ".svg"))
        run = json.loads(self.good("run", *SHORT, "--json"))
        for way in list(self.texts_of(run))[::EVERY]:
            bad.write_text(json.dumps(self.replaced(run, way, self.poisons[1])))
            self.harmless("plot", source, "--runs", bad, "-o", self.path(out + ".svg"), statuses=(0, 2), note=way)
            self.check_figure(out, self.poisons[1])
        bad.write_text(json.dumps(run) + "\x1b[2J`touch " + str(self.canary))
        self.harmless("plot", source, "--runs", bad, "-o", self.path(out + ".svg"))

    @unittest.skipUnless(HAVE_GNUPLOT, "no gnuplot")
    def test_databases(self):
        """A hostile text in place of every text of a sweep's database: its identity, the texts of rows, and names of
        columns."""
        source, bad, out = self.path("sweep.db"), self.path("bad.db"), "sweep-figure"
        self.good("sweep", *SHORT, "--over", "model.kappa=1:2:2", "-o", source)
        with sqlite3.connect(source) as file:
            tables = [name for name, in file.execute("SELECT name FROM sqlite_master WHERE type = 'table'")]
            columns = {t: [row[1] for row in file.execute(f"PRAGMA table_info('{t}')")] for t in tables}
            keys = [key for key, in file.execute("SELECT key FROM festoon")]
        file.close()
        changes = [("UPDATE festoon SET value = ? WHERE key = ?", (key,)) for key in keys]
        changes += [(f'UPDATE "{t}" SET "{c}" = ?', ()) for t in tables if t != "festoon" for c in columns[t]]
        changes += [(f'ALTER TABLE "{t}" RENAME COLUMN "{c}" TO {{}}', None) for t in tables if t != "festoon"
                    for c in columns[t][1:6]]
        for turn, (change, more) in enumerate(changes):
            poison = self.poisons_without_zero[turn % len(POISONS)]
            shutil.copy(source, bad)
            with sqlite3.connect(bad) as file:
                try:
                    if more is None:
                        file.execute(change.format('"' + poison.replace('"', '""') + '"'))
                    else:
                        file.execute(change, (poison, *more))
                except sqlite3.Error:
                    continue  # a number as a key, or a value that must be unique
            file.close()
            kinds = [("export", bad, "--json"), ("export", bad, "--csv"), ("plot", bad, "-o", self.path(out + ".svg"))]
            for words in kinds if more or more is None or turn % 9 == 0 else kinds[turn % 3:turn % 3 + 1]:
                self.harmless(*words, statuses=(0, 2), note=(change, more, poison))
            self.check_figure(out, poison)

    # ------------------------------------------------------------------ options and names

    def test_options(self):
        self.trajectory()
        for turn, poison in enumerate(self.poisons_without_zero):
            commands = (
                ("run", "--set", "bead.radius=" + poison), ("run", "--set", poison + "=1"), ("run", "--set", poison),
                ("run", "--" + poison), (poison,), ("run", "--ramp", poison), ("field", "--at", poison),
                ("sweep", "--over", poison, "-o", self.path("no.db")),
                ("sweep", "--over", "model.kappa=" + poison, "-o", self.path("no.db")),
                ("sweep", "--over", poison + "=1:2:2", "-o", self.path("no.db")),
                ("branch", "--kind", poison), ("branch", "--kind", "locked", "--over", poison),
                ("branch", "--kind", "locked", "--over", poison + "=1:2"),
                ("plot", self.path("track.csv"), "--quantity", poison, "-o", self.path("no.svg")),
                ("plot", self.path("track.csv"), "--kind", poison, "-o", self.path("no.svg")),
                ("movie", self.path("track.csv"), "--quantity", poison, "-o", self.path("no.mp4")),
                ("paper", "--only", poison), ("check", self.path(poison.replace("/", "") + ".yaml")))
            for place, words in enumerate(commands):
                if (turn + place) % EVERY == 0:
                    self.harmless(*words)

    @unittest.skipUnless(HAVE_GNUPLOT, "no gnuplot")
    def test_names(self):
        """Files and folders with hostile names: written, drawn, and drawn again by the script."""
        for turn, poison in enumerate(self.poisons_without_zero):
            name = poison.replace(str(self.canary), "canary").replace("/", "")[:80]
            home = self.path(f"place{turn}") / ("" if turn % 2 else name)
            home.mkdir(parents=True)
            for place in (home, Path("."))[turn // 2 % 2:][:1]:
                words = {"cwd": home}
                for step in (("run", *SHORT, "-o", place / (name + ".csv")),
                             ("plot", place / (name + ".csv"), "-o", place / (name + ".svg"))):
                    done = subprocess.run([FESTOON, *map(str, step)], stdin=subprocess.DEVNULL, capture_output=True, timeout=300,
                                          **words)
                    self.assertIn(done.returncode, (0, 2), (step, done.stderr))
                    self.assertIsNone(CONTROL.search((done.stdout + done.stderr).decode()), step)
                    if done.returncode == 2:
                        self.assertIn(b"control characters", done.stderr)
                if (home / (name + ".gp")).exists():
                    subprocess.run(["gnuplot", "./" + name + ".gp"], cwd=home, stdin=subprocess.DEVNULL,
                                   capture_output=True, timeout=300)
            self.assertEqual([str(p) for p in self.folder.rglob("canary*") if p.name == "canary"], [], name)

    @unittest.skipUnless(HAVE_FFMPEG, "no ffmpeg")
    def test_names_of_films(self):
        self.trajectory()
        if "cairo yes" not in self.good("--version").decode():
            self.skipTest("no Cairo")
        for poison in self.poisons_without_zero[1:8:3] + ["-y", "%05d"]:
            name = poison.replace(str(self.canary), "canary").replace("/", "") + ".mp4"
            self.harmless("movie", self.path("track.csv"), "--to", "1", "--fps", "1", "--size", "160x160", "-o",
                          self.path(name), statuses=(0,))
            self.assertIn(b"ftyp", self.path(name).read_bytes()[:12])
            self.assertFalse(list(self.folder.glob("canary")))


if __name__ == "__main__":
    unittest.main()
