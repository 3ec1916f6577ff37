"""One build of festoon with more than it has.

It is made by the commands in examples/c/field.c and law.c, as a user types them, but by Ninja, and with
warnings as errors; and not optimised, which takes a fifth of the time and computes the same bits.  The examples print what test_examples_c.py
compares, and the program knows their magnet and friction law.

Every list of include/festoon/lists.def has a row more there, and nothing else: festoon compiles without a warning, and the
row is in help, JSON, files that are read back, figures and the Python module.

labels: long slow"""

import json
import os
import re
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

from sweep_tools import change

SOURCES = Path(os.environ["SOURCE_DIR"]).resolve()
HEADERS = SOURCES / "include" / "festoon"
PROGRAMS = Path(os.environ["BUILD_DIR"]) / "tests" / "examples"
EXAMPLES = ("field", "law")

# Where the rows of each list show: a choice of a parameter, options of a command ("COMMAND OPTION"), or names that Python
# has.  A list that is missing here has no test.
CHOICES = {"MATERIALS": "bead.material", "DYNAMICS": "model.dynamics", "PATCHES": "contact.patch", "SPINS": "start.spin",
           "UNTILS": "run.until", "PARTS": "magnet.parts[0].kind", "BEADS_METHODS": "run.method", "PLATE_SHAPES": "plate.shape",
           "PART_MOTIONS": "magnet.parts[0].motion", "WAVEFORMS": "drive.waveform", "FRAMES": "world.frame"}
OPTIONS = {"BRANCH_KINDS": "branch --kind", "FOLLOWED_SPECIALS": "branch --follow", "FIGURES": "plot --kind",
           "FIELDS": "field --quantity", "SHOWN": "run --units", "ARITHMETICS": "sweep --arithmetic", "CARRIES": "sweep --carry",
           "EXPORTS": "export --dummy-exports"}
PYTHON = {"REGIMES": "runs.REGIMES", "STOPS": "flows.STOPS", "SYMMETRIES": "runs.SYMMETRIES", "BRANCH_KINDS": "branches.KINDS", "SPECIALS":
          "branches.SPECIALS", "FOLLOWED_SPECIALS": "branches.SPECIALS", "ENDS": "branches.ENDS", "FIGURES": "figures.KINDS",
          "SHOWN": "_quantities.UNITS", "CARRIES": "sweeping.CARRY", "MEASURED_QUANTITIES": "_plot_points._measured()"}
# Of these the program writes names that Python asks by number.
NUMBERED = {"UNITS": "fst_unit_name", "ROLLING_ENDS": "fst_rolling_end_name", "MOTIONS": "fst_motion_name", "PAIRINGS": "fst_pairing_name",
            "ARITHMETICS": "fst_arithmetic_name", "COLOURS": "fst_colour_code", "DYNAMICS": "fst_dynamics_name",
            "NOISE_VERDICTS": "fst_noise_verdict_name"}


def with_dummies(text):
    """lists.def with a copy of the last row of each list behind it, under names of its own; and the names by list."""
    names = {}

    def more(found):
        table, rows = found.group(1), found.group(0)
        last = re.findall(r'ROW\((\w+), ("[^"]*"),', rows)[-1]
        row = rows[rows.rindex(f"ROW({last[0]},"):].rstrip()
        names[table] = "dummy-" + table.lower().replace("_", "-")
        row = row.replace(f"ROW({last[0]}, {last[1]},", f'ROW({last[0].split("_")[0]}_DUMMY_{table}, "{names[table]}",')
        return rows.rstrip() + " \\\n    " + row + "\n"

    text = re.sub(r"#define FST_(\w+)\(ROW\)(?:.*\\\n)+.*\n", more, text)
    return text, names


def link_to(source, folder, inner):
    """The source tree, where the user stands, as links in a folder; but folders of its own down to `inner`."""
    folder.mkdir(exist_ok=True)
    for part in source.iterdir():
        if part.name in EXAMPLES or part.name.startswith("build"):
            continue
        if inner.is_relative_to(folder / part.name):
            link_to(part, folder / part.name, inner)
        else:
            (folder / part.name).symlink_to(part)


def commands_of(example):
    """The commands of an example's comment, for a build that is not optimised."""
    text = (SOURCES / "examples" / "c" / (example + ".c")).read_text(encoding="utf-8")
    configure, build, compile_, start = re.findall(r"^ \*     (\S.*)$", text, re.M)
    assert "-DCMAKE_BUILD_TYPE=Release" in configure, configure
    return configure.replace("Release", "Debug -DFESTOON_WERROR=ON -G Ninja"), build, compile_, start


class More(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.holder = tempfile.TemporaryDirectory(prefix="festoon-lists-")
        cls.addClassCleanup(cls.holder.cleanup)
        cls.folder = Path(cls.holder.name)
        own = cls.folder / "examples" / "c" / "own" / "festoon"
        link_to(SOURCES, cls.folder, own)
        # The folder of own.def comes before the public headers: its lists.def is the one that is found.
        text, cls.names = with_dummies((HEADERS / "lists.def").read_text(encoding="utf-8"))
        (own / "lists.def").write_text(text, encoding="utf-8")
        cls.printed = {example: [cls.command("sh", "-c", command) for command in commands_of(example)][-1] for example in EXAMPLES}
        build = cls.folder / "build-own"
        cls.festoon, cls.python = build / "festoon", build / "python"

    @classmethod
    def command(cls, *words, **options):
        done = subprocess.run([str(word) for word in words], cwd=cls.folder, stdin=subprocess.DEVNULL, capture_output=True,
                              text=True, check=False, **options)
        if done.returncode != 0:
            raise AssertionError(f"$ {words}\n{done.stdout[-3000:]}{done.stderr[-3000:]}")
        return done.stdout

    def reseal(self):
        """tests/tools/reseal.c of this build, whose sweeps have parameters that others lack."""
        self.command("cmake", "--build", "build-own", "--target", "festoon_internal")
        libraries = self.command("pkg-config", "--libs", "yaml-0.1", "jansson", "sqlite3", "expat").split()
        self.command("cc", "-std=c11", "-D_POSIX_C_SOURCE=200809L", "-Iexamples/c/own", "-Iinclude", "-Isrc",
                     "tests/tools/reseal.c", "build-own/libfestoon_internal.a", *libraries, "-lm", "-ldl", "-lpthread",
                     "-o", "reseal")
        return self.folder / "reseal"

    def branch(self):
        """A branch of locked states whose kind, special points, ends and symmetries are the dummies; made once."""
        if (self.folder / "branch.json").exists():
            return
        self.command(self.festoon, "branch", "--kind", "locked", "--over", "drive.omega=0.05:0.3", "-o", "branch.json")
        document = json.loads((self.folder / "branch.json").read_text(encoding="utf-8"))
        self.assertTrue(document["specials"] and document["ends"])
        document["kind"] = self.names["BRANCH_KINDS"]
        document["specials"][0]["type"] = self.names["SPECIALS"]
        document["ends"][0]["type"] = self.names["ENDS"]
        document["points"][0]["symmetry"] = self.names["SYMMETRIES"]
        (self.folder / "branch.json").write_text(json.dumps(document), encoding="utf-8")

    def test_a_magnet_and_a_law_of_ones_own(self):
        for example in EXAMPLES:
            self.assertEqual(self.printed[example], self.command(PROGRAMS / example))
        words = (self.festoon, "run", "--json", "--set", "drive.frequency=20Hz", "--set")
        radius = json.loads(self.command(*words, "magnet.shape=charges", "--set", "own.reach=0.9", "--set",
                                         "own.charge=4.5"))["mean_r"]
        self.assertIn(f"two charges: counter-rotating, r = {radius:.17g}\n", self.printed["field"])
        self.assertEqual(json.loads(self.command(*words, "friction.law=quadratic"))["regime"], "counter-rotating")
        if shutil.which("gnuplot"):
            self.command(self.festoon, "field", "--set", "magnet.shape=charges", "-o", "charges.svg")
            for name in ("charges.dat", "charges.gp"):  # where no bar of lines is marked
                self.assertNotIn("the magnet's lines", (self.folder / name).read_text(encoding="utf-8").replace("''", "'"))
        refused = subprocess.run([self.festoon, "run", "--set", "magnet.shape=charge"], capture_output=True, text=True, check=False)
        self.assertEqual(refused.returncode, 2)
        self.assertIn("charges", refused.stderr)

    def test_each_list_is_tested(self):
        known = {*CHOICES, *OPTIONS, *PYTHON, *NUMBERED}
        self.assertEqual(sorted(self.names), sorted(known))

    def test_choices(self):
        schema = {row["key"]: row["names"] for row in json.loads(self.command(self.festoon, "schema", "--json"))}
        words = self.command(self.festoon, "schema")
        for table, key in CHOICES.items():
            name = self.names[table]
            self.assertIn(name, schema[key])
            self.assertIn("|" + name, words)
            if key.startswith("magnet.parts") or key == "run.method":  # these need a whole part, and a list of beads
                continue
            self.command(self.festoon, "init", "scene.yaml", "--set", f"{key}={name}", "--force")
            self.assertIn(f": {name}", (self.folder / "scene.yaml").read_text(encoding="utf-8"))
            read = json.loads(self.command(self.festoon, "check", "scene.yaml", "--json"))
            self.assertEqual(read["scene"][key], name)

    def test_help(self):
        for table, place in OPTIONS.items():
            command, option = place.split()
            shown = self.command(self.festoon, "help", command)
            line = next(line for line in shown.splitlines() if line.startswith(f"   {option} "))
            self.assertIn(self.names[table], line)

    def test_a_branch_is_read_back_and_drawn(self):
        self.branch()
        if not shutil.which("gnuplot"):
            self.skipTest("no gnuplot")
        self.command(self.festoon, "plot", "branch.json", "-o", "branch.svg")
        script = (self.folder / "branch.gp").read_text(encoding="utf-8")
        self.assertIn("contact opens or closes", script)  # the words of the row of which the dummy is a copy

    def test_a_regime_in_a_sweep(self):
        self.command(self.festoon, "sweep", "--over", "drive.omega=0.3:0.4:2", "--over", "start.r=0.9:1:2", "--set",
                     "run.periods=20", "-o", "map.db")
        name = self.names["REGIMES"]
        change(str(self.folder / "map.db"), ("UPDATE rows SET regime = ?", (name,)), reseal=self.reseal())
        self.assertEqual(self.command(self.festoon, "export", "map.db", "--csv", "--quantity", "regime").count(name), 4)
        if shutil.which("gnuplot"):
            self.command(self.festoon, "plot", "map.db", "--quantity", "regime", "-o", "map.svg")
            self.assertIn(name, (self.folder / "map.gp").read_text(encoding="utf-8"))

    def test_python(self):
        if not (self.python / "festoon" / "_tables.py").exists():
            self.skipTest("no Python module")
        self.branch()
        program = f"""
import importlib, json
from festoon._native import ffi, lib, text_of
from festoon._tables import PARAMETERS
def names(place):
    module, name = place.split(".")
    found = getattr(importlib.import_module("festoon." + module), name.rstrip("()"))
    return list(found() if name.endswith(")") else found)
def numbered(function):
    kind = ffi.typeof(getattr(lib, function)).args[0]
    last = max(number for name, number in kind.relements.items() if not name.endswith("_COUNT"))
    return text_of(getattr(lib, function)(last))
branch = importlib.import_module("festoon.branches").read_branch("branch.json")
print(json.dumps({{
    "names": {{table: names(place) for table, place in {PYTHON!r}.items()}},
    "numbered": {{table: numbered(function) for table, function in {NUMBERED!r}.items()}},
    "choices": {{key: PARAMETERS[key] for key in {list(CHOICES.values())!r} if key in PARAMETERS}},
    "branch": branch.to_dict(),
}}))
"""
        cache = (self.python.parent / "CMakeCache.txt").read_text(encoding="utf-8")
        python = re.search(r"^FESTOON_PYTHON_PROGRAM:FILEPATH=(.*)$", cache, re.M).group(1)
        told = json.loads(self.command(python, "-c", program, env={**os.environ, "PYTHONPATH": str(self.python)}))
        for table in PYTHON:
            self.assertIn(self.names[table], told["names"][table])
        for table in NUMBERED:
            if table != "COLOURS":
                self.assertEqual(told["numbered"][table], self.names[table])
        self.assertEqual(told["numbered"]["COLOURS"], "#ddcc77")
        for table, key in CHOICES.items():
            if key in told["choices"]:
                self.assertIn(self.names[table], told["choices"][key][1])
        written = told["branch"]  # what was read from the file is written again
        self.assertEqual(written["kind"], self.names["BRANCH_KINDS"])
        self.assertEqual(written["specials"][0]["type"], self.names["SPECIALS"])
        self.assertEqual(written["ends"][0]["type"], self.names["ENDS"])
        self.assertEqual(written["points"][0]["symmetry"], self.names["SYMMETRIES"])


if __name__ == "__main__":
    unittest.main()
