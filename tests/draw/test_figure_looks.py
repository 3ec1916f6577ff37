"""Every kind of figure: --title stands above it letter by letter, --size is the picture's, and the line below the title
names what is not the default.

tests: draw/figure_file.c draw/legend.c draw/caption.c draw/chart.c draw/figure_path.c draw/figure_local.c draw/figure_field.c
  draw/figure_sweep_map.c cli/plot.c cli/values.c
labels: slow"""

import os
import re
import shutil
import struct
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree
import zlib
from pathlib import Path

FESTOON = os.environ["FESTOON"]
SCRATCH = tempfile.TemporaryDirectory()
FOLDER = Path(SCRATCH.name)
SHORT = {"run.periods": "12", "run.discard": "4"}
# What is not the default, with the words that the figure must have for it.
MAGNET = {"magnet.width": "30 mm", "bead.radius": "2 mm", "model.kappa": "1.2", "start.spin": "rest"}
DRY = {**MAGNET, "friction.law": "coulomb", "friction.mu": "0.3"}
TWO = "drive: {frequency: 30 Hz}\nbeads: [{start.phi: 3 deg}, {start.phi: 40 deg}]\n"
POINTS = "frequency [Hz],mean_r [mm],mean_r_error [mm]\n9,17,0.3\n9.8,17.5,0.2\n"
TITLE = "it's \"a\" `date` $HOME \\n @{x}_i^2 & ~ <b> %s 漢字 naïve"


def tearDownModule():
    SCRATCH.cleanup()


def run(*words):
    done = subprocess.run([FESTOON, *map(str, words)], capture_output=True, text=True, check=False)
    return done.returncode, done.stdout, done.stderr


def good(*words):
    status, out, messages = run(*words)
    assert status == 0, messages
    return out


def keys(values):
    return [word for key, value in values.items() for word in ("--set", f"{key}={value}")]


def make(name, scene):
    """All files of which figures are drawn, by the words of a scene; what of it their figures must name."""
    short = keys({**SHORT, **scene})
    still = {key: value for key, value in scene.items() if not key.startswith(("friction", "start"))}
    good("run", *short, "-o", FOLDER / f"{name}.h5")
    good("run", *short, "--ramp", "9:12", "--ramp-wait", "0", "-o", FOLDER / f"{name}-ramp.h5")
    (FOLDER / "two.yaml").write_text(TWO, encoding="utf-8")
    beads = {key: value for key, value in scene.items() if key == "magnet.width"}
    good("run", FOLDER / "two.yaml", *keys({**SHORT, **beads}), "-o", FOLDER / f"{name}-two.h5")
    good("init", "--world", "wave", FOLDER / "wave.yaml") if not (FOLDER / "wave.yaml").exists() else None
    drag = {"medium.drag_rate": "12", "run.duration": "1s", "run.samples": "64"}
    good("run", FOLDER / "wave.yaml", *keys({**drag, **({"wave.amplitude": "0.04 mT"} if scene else {})}), "-o", FOLDER / f"{name}-wave.h5")
    good("sweep", "--quiet", *short, "--over", "drive.frequency=9Hz:10Hz:3", "-o", FOLDER / f"{name}-one.db")
    good("sweep", "--quiet", *short, "--over", "drive.frequency=9Hz:10Hz:3", "--over", "start.phi=0deg:30deg:2", "-o", FOLDER / f"{name}-few.db")
    good("branch", "--quiet", *keys(still), "--kind", "locked", "--over", "drive.frequency=4Hz:6Hz", "-o", FOLDER / f"{name}.json")
    wave = {"wave.amplitude": "0.04 mT"} if scene else {}
    return [(["plot", FOLDER / f"{name}{of}", *words], named) for of, words, named in (
        (".h5", ["--kind", "path"], scene), (".h5", ["--kind", "path", "--inset"], scene), (".h5", ["--kind", "local-n"], scene),
        (".h5", ["--kind", "radius-field"], scene), (".h5", ["--kind", "time"], scene), (".h5", ["--kind", "section"], scene),
        ("-ramp.h5", [], scene), ("-two.h5", [], beads), ("-two.h5", ["--kind", "groups"], beads),
        ("-wave.h5", ["--kind", "path"], wave), ("-wave.h5", ["--kind", "lag"], wave), ("-one.db", [], scene),
        ("-few.db", ["--quantity", "mean_r"], scene), ("-few.db", ["--kind", "map"], scene),
        ("-few.db", ["--kind", "map", "--quantity", "mean_r"], scene), (".json", [], still), (".json", ["--quantity", "multipliers"], still),
        ("-one.db", ["--points", FOLDER / "points.csv"], scene), ("-one.db", [FOLDER / f"{name}-one.db"], scene),
    )] + [(["field", *keys(scene)], scene)]


def texts(path):
    """The texts of a figure and which of them stand as they are, in their order."""
    return [(text.replace("''", "'"), " noenhanced " in rest) for text, rest in
            re.findall(r"^set label '((?:[^']|'')*)' at ([^\n]*)$", path.read_text(encoding="utf-8"), re.MULTILINE)]


def png_resolution(path):
    """Pixels in a metre along both sides, and 1 for metres: of the one chunk that says it, before the picture.  All chunks are whole."""
    data, at, found = path.read_bytes(), 8, {}
    while at < len(data):
        size, name = struct.unpack(">I4s", data[at : at + 8])
        words, check = data[at + 8 : at + 8 + size], data[at + 8 + size : at + 12 + size]
        assert check == struct.pack(">I", zlib.crc32(name + words)), name
        assert name != b"pHYs" or not found.keys() & {b"pHYs", b"IDAT"}
        found[name] = words
        at += 12 + size
    assert at == len(data)
    return struct.unpack(">IIB", found[b"pHYs"])


def png_size(path):
    return struct.unpack(">II", path.read_bytes()[16:24])


class Looks(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        (FOLDER / "points.csv").write_text(POINTS, encoding="utf-8")
        cls.usual, cls.other = make("usual", {}), make("other", DRY)

    def draw(self, words, *more, out="f.svg"):
        status, _, messages = run(*words, *more, "-o", FOLDER / out)
        self.assertEqual(status, 0, (words, messages))
        return texts(FOLDER / "f.gp")

    def test_what_is_not_the_default_is_named(self):
        for (usual, _), (other, named) in zip(self.usual, self.other, strict=True):
            below = [" ".join(text for text, plain in self.draw(words, "--title", "") if plain) for words in (usual, other)]
            for key, value in named.items():
                with self.subTest(other[1:], key=key):
                    self.assertNotIn(f"{key} {value}", below[0])
                    said = {"friction.law": "friction.law coulomb|dry friction", "friction.mu": "(friction.mu|μ =) 0.3"}
                    self.assertRegex(below[1], said.get(key, f"{key} {value}"))
            self.assertNotEqual(*below) if named else None

    def test_the_script_has_the_whole_scene(self):
        """Its comments are a scene that the program reads, and that says what the figure's scene said."""
        for words, named in self.other:
            with self.subTest(words[1:]):
                self.draw(words)
                script = (FOLDER / "f.gp").read_text(encoding="utf-8")
                if "--points" in words:
                    self.assertNotIn("# The scene:", script)  # it may be of several files, each with a scene of its own
                    continue
                scene = re.search(r"^# The scene:\n(.*?)^#$", script, re.MULTILINE | re.DOTALL)[1]
                (FOLDER / "again.yaml").write_text("\n".join(line[2:] for line in scene.splitlines()) + "\n", encoding="utf-8")
                status, _, messages = run("check", FOLDER / "again.yaml")
                self.assertEqual(status, 0, messages)
                for key, value in named.items():
                    group, name = key.split(".")
                    block = re.search(rf"^# {group}:\n((?:#   .*\n)*)", scene, re.MULTILINE)[1]
                    self.assertRegex(block, rf"(?m)^#   {name}: {re.escape(value)}$")

        self.draw(["plot", FOLDER / "usual-one.db", FOLDER / "other-one.db"])
        self.assertNotIn("# The scene:", (FOLDER / "f.gp").read_text(encoding="utf-8"))

    def test_titles_stand_letter_by_letter(self):
        for words, _ in self.usual:
            with self.subTest(words):
                own, given = self.draw(words), self.draw(words, "--title", TITLE)
                title = next(text for text, plain in own if plain)
                self.assertIn((TITLE, True), given)
                self.assertNotIn((title, True), given)
        self.draw(self.usual[0][0], "--title", TITLE)
        drawn = xml.etree.ElementTree.parse(FOLDER / "f.svg").getroot()
        self.assertIn(TITLE, ["".join(text.itertext()).strip() for text in drawn.iter("{http://www.w3.org/2000/svg}text")])

    def test_quotes_at_all_places(self):
        """gnuplot ends a string at two quotes that begin it, and at the second of two pairs."""
        for title in ("'first", "last'", "two''in a row", "'", "''", "' '''x''''y' '", "'.system('touch t').'", '"', "\\'", "'\\"):
            with self.subTest(title):
                self.draw(self.usual[4][0], "--title", title)
                drawn = xml.etree.ElementTree.parse(FOLDER / "f.svg").getroot()
                said = ["".join(text.itertext()).strip() for text in drawn.iter("{http://www.w3.org/2000/svg}text")]
                self.assertIn(title, said)
        self.assertFalse(os.path.exists(FOLDER / "t"))

    def test_long_titles(self):
        """Five lines at most, none wider than the figure, and dots where more was wanted; a line end ends a line."""
        words = self.usual[4][0]
        for title in ("word_ " * 170, "x" * 1000, "_" * 1000, "é" * 1000, "漢" * 330):
            lines = [text for text, plain in self.draw(words, "--title", title)[-8:] if plain and text[:1] == title[:1]]
            self.assertEqual(len(lines), 5, lines)
            self.assertTrue(max(map(len, lines)) <= 55 and lines[-1].endswith("…"), lines)
            self.assertTrue(title.startswith("".join(lines)[:-1].replace(" ", "")[:40]) or " " in title)
        lines = [text for text, plain in self.draw(words, "--title", "one\ntwo\x1b[31m\x07")if plain]
        self.assertEqual(lines[:2], ["one", "two?[31m?"])
        self.assertEqual(len([1 for _, plain in self.draw(words, "--title", "") if plain]), 1)  # the line below it is left

    def test_sizes(self):
        """A PNG has the pixels of its size at 192 an inch, and says so; an SVG says it in mm."""
        for number, (words, _) in enumerate(self.usual):
            wide, tall = (86, 60) if number % 3 else (100, None)
            with self.subTest(words, wide=wide, tall=tall):
                size = f"{wide}mmx{tall}mm" if tall else f"{wide}mm"
                self.draw(words, "--size", size, out="f.png")
                found = png_size(FOLDER / "f.png")
                self.assertEqual(png_resolution(FOLDER / "f.png"), (round(192 / 0.0254), round(192 / 0.0254), 1))
                self.assertAlmostEqual(found[0], wide * 192 / 25.4, delta=1.01)
                if tall:
                    self.assertAlmostEqual(found[1], tall * 192 / 25.4, delta=4)
        self.draw(self.usual[0][0], "--size", "86mmx200mm", out="f.png")
        self.assertAlmostEqual(png_size(FOLDER / "f.png")[1], 200 * 192 / 25.4, delta=2)
        self.draw(self.usual[0][0], "--size", "86mmx60mm")
        root = xml.etree.ElementTree.parse(FOLDER / "f.svg").getroot()
        self.assertEqual((root.get("width"), root.get("height")), ("86mm", "60mm"))
        wide, tall = map(float, root.get("viewBox").split()[2:])
        self.assertAlmostEqual(wide / tall, 86 / 60, delta=0.01)
        self.draw(self.usual[0][0], "--size", "86mmx60mm", out="f.pdf")
        box = re.search(rb"/MediaBox \[ 0 0 (\d+) (\d+)", (FOLDER / "f.pdf").read_bytes())
        self.assertAlmostEqual(int(box[1]), 86 / 25.4 * 72, delta=1.5)

    def test_no_sizes(self):
        for size in ("", "86", "x60mm", "86mmx", "0mm", "-5mm", "19mm", "1001mm", "86mmx2m", "nan", "86mmx0mm", "86mm60mm", "86Hz"):
            with self.subTest(size):
                status, _, messages = run("plot", FOLDER / "usual.h5", "--size", size, "-o", FOLDER / "no.svg")
                self.assertEqual(status, 2, messages)
                self.assertIn("--size", messages)
                self.assertEqual("86mm?" in messages, size == "86", messages)
        self.assertEqual(list(FOLDER.glob("no.*")), [])

    def test_carried_sweeps_say_so(self):
        good("sweep", "--quiet", *keys(SHORT), "--over", "drive.frequency=9Hz:10Hz:3", "--carry", "down", "-o", FOLDER / "carried.db")
        below = " ".join(text for text, plain in self.draw(["plot", FOLDER / "carried.db"]) if plain)
        self.assertIn("each begun where its neighbour ended, downwards", below)


if __name__ == "__main__":
    if not shutil.which("gnuplot"):
        print("no gnuplot")
        sys.exit(77)
    unittest.main()
