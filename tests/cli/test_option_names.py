"""Names of options: an old name gives what the new one gives, with a sentence, and is offered nowhere; the manual page
says each option once and gives a command exactly the options that it takes, with the words of its help.

Environment: FESTOON_SHORTER (1): of the options that a command does not take, one in so many is tried; with it, no
rival laws are fitted, which test_fit_cli.py does.

tests: cli/options.c cli/help.c cli/completion_offer.c cli/schema.c
labels: slow"""

import json
import os
import re
import shutil
import subprocess
import unittest

import events
import tracks
from sweep_tools import Case, FESTOON

SOURCE_DIR = os.environ["SOURCE_DIR"]
BUILD_DIR = os.environ["BUILD_DIR"]

STRIDE = int(os.environ.get("FESTOON_SHORTER", "1"))

SHORT = ["--set", "run.periods=6", "--set", "run.discard=2"]
SWEEP = ["--over", "drive.frequency=10Hz:11Hz:2", "--over", "model.kappa=1.4:1.6:3"]

# A command for each old name: what stands before it, its value if it has one, and what it writes.
USES = {
    ("plot", "key"): (["plot", "../s.db", "-o", "f.svg"], "mean_r", "gnuplot"),
    ("plot", "colour"): (["plot", "../t.csv", "-o", "f.svg"], "slip", "gnuplot"),
    ("plot", "observable"): (["plot", "../b.json", "-o", "f.svg"], "slip", "gnuplot"),
    ("plot", "at"): (["plot", "../s.db", "-o", "f.svg"], "model.kappa=1.5", "gnuplot"),
    ("plot", "arrows"): (["plot", "../t.csv", "-o", "f.svg"], None, "gnuplot"),
    ("export", "key"): (["export", "../s.db", "--csv"], "mean_r,regime", None),
    ("movie", "colour"): (["movie", "../t.csv", "-o", "frames", "--to", "1", "--fps", "2", "--size", "160x160"], "n_z",
                          None),
    ("field", "map"): (["field", "-o", "f.svg"], "load", "gnuplot"),
    ("measure", "track"): (["measure", "../many.csv", "--fps", "240", "--json"], "8", None),
    ("fit", "compare"): (["fit", "../points.csv", "--free", "model.kappa", "--json"], None, None),
    ("run", "fps"): (["run", *SHORT, "--csv", "r.csv"], "100", None),
    ("track", "picture"): (["track", "../film.mp4", "-o", "t.csv"], "p.png", "ffmpeg"),
}


def of_film(folder):
    """A film of a bead, and a table of points, which few of the commands need."""
    subprocess.run([FESTOON, "movie", "t.csv", "--camera", "--to", "3", "--fps", "60", "--size", "320x240", "-o", "film.mp4"],
                   cwd=folder, check=True, capture_output=True, timeout=events.HANG)


class OldNames(Case):
    def renamed(self):
        with open(os.path.join(SOURCE_DIR, "src", "cli", "options.c"), encoding="utf-8") as file:
            table = re.search(r"renamed\[\] = \{(.*?)\};", file.read(), re.S)[1]
        rows = re.findall(r'\{"(\w+)", "([\w-]+)", "([\w-]*)", [01]\}', table)
        self.assertEqual(len(rows), table.count("{"))
        return rows

    def done(self, folder, *words):
        """Standard output, the files and the messages of a command in a folder of its own."""
        os.mkdir(self.path(folder))
        done = subprocess.run([FESTOON, *words], cwd=self.path(folder), capture_output=True, check=False,
                              timeout=events.HANG)
        files = {}
        for at, _, names in os.walk(self.path(folder)):
            for name in names:
                with open(os.path.join(at, name), "rb") as file:
                    files[os.path.relpath(os.path.join(at, name), self.path(folder))] = file.read()
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout, files, done.stderr.decode()

    def test_they_give_the_same(self):
        self.good("run", *SHORT, "--csv", self.path("t.csv"))
        self.good("sweep", *SHORT, *SWEEP, "-o", self.path("s.db"))
        self.good("branch", "--kind", "locked", "--over", "drive.omega=0.06:0.07", "-o", self.path("b.json"))
        with open(self.path("points.csv"), "w", encoding="utf-8") as file:
            file.write("frequency [Hz],mean_r [mm],mean_r_error [mm]\n" + "".join(
                f"{f},{r},0.2\n" for f, r in ((12, 19.1), (19, 20.5))))
        with open(self.path("many.csv"), "w", encoding="utf-8") as file:
            text = tracks.trackpy(tracks.places())
            rows = [row[:-1] + "8" for row in text.splitlines() if row.endswith(",7")]
            file.write(text + "\n".join(rows[:2 * len(rows) // 3]) + "\n")
        rows = self.renamed()
        self.assertEqual({(command, old) for command, old, _ in rows}, set(USES))
        for number, (command, old, new) in enumerate(rows):
            words, value, helper = USES[command, old]
            with self.subTest(command=command, old=old):
                if helper and not shutil.which(helper) or command == "fit" and STRIDE > 1:
                    continue
                if command == "track":
                    of_film(self.directory)
                behind = [] if value is None else [value]
                now = self.done(f"{command}-{old}-new", *words, *([f"--{new}"] if new else []), *(behind if new else []))
                form = [f"--{old}={value}"] if behind and number % 2 else [f"--{old}", *behind]
                was = self.done(f"{command}-{old}", *words, *form)
                told = f"festoon {command}: --{old} " + (f"is now --{new}\n" if new else "has no effect any more")
                self.assertEqual(was[0:2], now[0:2])
                self.assertEqual(was[2].count(told), 1, was[2])
                self.assertNotRegex(now[2], "is now|any more")
                # A value that is missing is still missing, and the name is offered nowhere.
                if behind:
                    self.assertIn(f"--{new} needs a value", self.refused(*words, f"--{old}"))
                self.assertNotRegex(self.good(command, "--help"), rf"--{old}\b" if old != "compare" else "--compare ")
                self.assertNotIn(f"--{old}\t", self.good("completion", "offer", command, "--"))

    def test_of_a_ramp_they_draw_what_they_drew(self):
        """--colour and --arrows asked for the path; --observable, as --quantity does, for columns over the ramp."""
        self.good("run", "--set", "run.discard=1", "--ramp", "12:11", "--set", "run.periods=24", "--ramp-wait", "0",
                  "--ramp-points", "4", "--csv", self.path("r.csv"))
        drawn = {words: self.done(words[-1], "plot", self.path("r.csv"), "-o", "f.svg", *words[:-1])[1]["f.svg"] for words in (
            ("--kind", "path", "--quantity", "slip", "a"), ("--colour", "slip", "b"),
            ("--kind", "path", "c"), ("--arrows", "d"),
            ("--kind", "ramp", "--quantity", "r", "e"), ("--observable", "r", "f"), ("--quantity", "r", "g"))}
        figures = list(drawn.values())
        self.assertEqual(figures[0], figures[1])
        self.assertEqual(figures[2], figures[3])
        self.assertEqual(figures[4], figures[5])
        self.assertEqual(figures[4], figures[6])
        self.assertEqual(len(set(figures)), 3)

    def test_they_are_names_of_one_command_alone(self):
        self.assertIn("unknown option --colour", self.refused("run", "--colour", "slip"))
        self.assertIn("unknown option --key", self.refused("movie", "t.csv", "--key", "slip"))


def unescaped(text):
    return re.sub(r"\\f[BIR]", "", text).replace("\\-", "-").replace("\\&", "").replace("\\e", "\\")


class Manual(Case):
    """docs/festoon.1, as it was built."""

    def setUp(self):
        super().setUp()
        with open(os.path.join(BUILD_DIR, "docs", "festoon.1"), encoding="utf-8") as file:
            page = unescaped(file.read())
        self.sections = dict(re.findall(r"^\.SH (.*?)\n(.*?)(?=^\.SH|\Z)", page, re.M | re.S))
        self.commands = re.findall(r"^  ([a-z]+) +[A-Z]", self.good("--help"), re.M)

    def entries(self, section):
        return re.findall(r"^\.[TH]P(?: \d+)?\n(.*?)\n(.*?)(?=^\.(?:[TH]P|PD)\b|\Z)", self.sections[section], re.M | re.S)

    def told(self, section):
        """{command: {option: (value, words)}} of a section; each option has one entry."""
        told, seen = {command: {} for command in self.commands}, set()
        for tag, body in self.entries(section):
            if not tag.startswith("-"):
                continue
            name, value = re.fullmatch(r"(?:-\w, )?--([\w-]+)(?: (\S+))?", tag).groups()
            self.assertNotIn(name, seen)
            seen.add(name)
            for meaning in body.split(".br\n"):
                commands, own, words = re.fullmatch(r"((?:[a-z]+, )*[a-z]+)(?: (\S+))?: (.*)", meaning.strip(), re.S).groups()
                for command in commands.split(", "):
                    self.assertNotIn(name, told[command], command)
                    told[command][name] = (value or own, " ".join(words.split()))
        return told

    def helped(self, command):
        """The options of the help, and those of its part for experts."""
        parts = self.good(command, "--help").split("options:\n")[1].split("\nexpert:\n")
        found = []
        for part in parts + [""] * (2 - len(parts)):
            rows = re.findall(r"^ {2,3}(?:-\w, )?--([\w-]+)(?: (\S+))?\s+(.*?)(?=^ {2,3}\S|\Z)", part, re.M | re.S)
            found.append({name: (value or None, " ".join(words.split())) for name, value, words in rows})
        for common in ("quiet", "help"):
            del found[0][common]
        return found

    def test_it_says_what_the_help_says(self):
        usual, expert = self.told("OPTIONS"), self.told("EXPERT OPTIONS AND PARAMETERS")
        for command in self.commands:
            self.assertEqual([usual[command], expert[command]], self.helped(command), command)

    def test_a_command_takes_what_it_says_and_nothing_else(self):
        usual, expert = self.told("OPTIONS"), self.told("EXPERT OPTIONS AND PARAMETERS")
        names = {name for told in (usual, expert) for options in told.values() for name in options}
        self.assertGreater(len(names), 60)
        old = {(command, name) for command, name in USES}
        for command in self.commands:
            taken = {**usual[command], **expert[command]}
            words = [f"--{name}=1" if value else f"--{name}" for name, (value, _) in taken.items()]
            self.assertIn("unknown option --no-such", self.refused(command, "--quiet", *words, "--no-such"), command)
            for name in sorted(names - set(taken))[::STRIDE]:
                if (command, name) not in old:
                    self.assertIn(f"unknown option --{name}", self.refused(command, f"--{name}"), command)

    def test_it_has_every_command_and_parameter_once(self):
        entries = self.entries("COMMANDS")
        self.assertEqual([tag.split()[1] for tag, _ in entries], self.commands + ["help", "completion"])
        for command, (tag, body) in zip(self.commands, entries):
            usage, *told = self.good(command, "--help").split("\noptions:\n")[0].split("\n\n")
            self.assertEqual(tag.split()[1:], usage.split()[2:])
            self.assertEqual(body.split(), " ".join(told).split(), command)
        keys = [tag.split()[1] for part in ("PARAMETERS", "EXPERT OPTIONS AND PARAMETERS")
                for tag, _ in self.entries(part) if tag.startswith(".B ")]
        schema = [row for row in json.loads(self.good("schema", "--json")) if "[" not in row["key"]]
        self.assertEqual(keys, [row["key"] for row in sorted(schema, key=lambda row: row["expert"])])
        self.assertEqual([row["key"] for row in schema if row["expert"]],
                         ["magnet.checksum", "model.eps", "model.h", "model.lambda"])
        self.assertEqual(self.good("schema").split("\nExpert:\n")[1].count("model."), 4)

    def test_it_has_every_key_of_lists(self):
        """Of vectors all components in one entry, of lists those of the first element."""
        told = []
        for tag, body in self.entries("LISTS"):
            key, _, count = re.fullmatch(r"\.B (\S+)(?: \((\d)? ?(.*?)\))?", tag).groups()
            if key == "beads[N]":
                told += ["beads[0]." + name for name in body.strip(". \n").split(": ", 1)[1].split(", ")]
            elif "[" in key or count == "numbers":
                number = int(tag.split("(")[1][0]) if count == "numbers" else 0
                told += [f"{key}[{k}]" for k in range(number)] or [key]
        wanted = [key.replace("[N]", "[0]", 1) for key in re.findall(r"^(\S+\[\S+)$", self.good("schema"), re.M)]
        vectors = {key.rsplit("[", 1)[0] for key in wanted if key.startswith("beads") and key.endswith("[2]")}
        found = [key.replace("[N]", "[0]") for key in told]
        found = [f"{key}[{k}]" for key in found for k in range(3) if key in vectors] + [key for key in found if key not in vectors]
        self.assertGreater(len(wanted), 60)
        self.assertEqual(sorted(found), sorted(wanted))
        (centre,) = [body for tag, body in self.entries("LISTS") if tag.startswith(".B magnet.parts[N].centre ")]
        self.assertEqual(centre.strip(), "Centre of the part along x, y, z of the magnet's frame.")

    def paths(self, found, name=""):
        """{path: value}, with [N] for any element of a list of objects."""
        if isinstance(found, dict):
            inner = [self.paths(value, f"{name}.{key}".lstrip(".")) for key, value in found.items()]
        elif isinstance(found, list) and found and isinstance(found[0], dict):
            inner = [self.paths(value, name + "[N]") for value in found]
        else:
            return {name: found}
        return {key: value for one in inner for key, value in one.items()}

    def test_it_has_every_key_of_json(self):
        """Of several beads, of a world, of places where a bead floats; and each of their units is that of the number in SI."""
        parts = re.split(r"^(?:Of several beads|Of one in a world|What\n\.B locked\ntells of each)", self.sections["RESULTS"], flags=re.M)
        self.assertEqual(len(parts), 4)
        of_one, *others = [[(key, unit or "", body) for key, unit, body in
                            re.findall(r"^\.(?:TP 28|HP 4)\n\.B (\S+)(?: \[(.*?)\])?\n((?:(?!\.).*\n)*)", part, re.M)] for part in parts]
        scenes = os.path.join(SOURCE_DIR, "examples")
        short = ("--set", "run.periods=2", "--set", "run.discard=1", "--json")
        ends = {"l": "_m", "gamma": "_per_s", "1/gamma": "_s", "l gamma": "_m_per_s", "l gamma^2": "_newtons", "l^2 gamma^3": "_watts"}
        documents = (("run", "beads/bar.yaml", "--set", "run.periods=4", *short[2:]), ("run", "worlds/wave.yaml", *short), ("locked", "worlds/levitation.yaml", "--json"))
        for told, (command, scene, *given) in zip(others, documents, strict=True):
            document = json.loads(self.good(command, os.path.join(scenes, scene), *given))
            for aside in ("scene", "version", "groups" if "wave" in scene else ""):
                document.pop(aside, None)
            found = set(self.paths(document["states"][0] if command == "locked" else document))
            words = self.sections["RESULTS"]
            for key, unit, _ in told:
                here = {path for path in found if path == key or path.startswith(key + ".")}
                self.assertTrue(here or key in ("steps_per_turn",), (scene, key))
            known = {key for key, *_ in told} | {key for key, *_ in (of_one if command == "run" else ())}
            for path in found:
                self.assertTrue(any(path == key or path.startswith(key + ".") for key in known) or path.split(".")[-1] in re.findall(r"\w+", words),
                                (scene, path))
            if command == "run":
                in_si = set(self.paths(json.loads(self.good(command, os.path.join(scenes, scene), *given, "--units", "si")))) - found
                for key, unit, _ in told:
                    self.assertEqual({key + end for end in ends.values()} & in_si, {key + ends[unit]} if unit in ends else set(), (scene, key))

    def test_it_names_no_other_option(self):
        """Nor does the text around the tables."""
        known = {"help", "version", "quiet", "mpi"} | {
            name for told in (self.told("OPTIONS"), self.told("EXPERT OPTIONS AND PARAMETERS"))
            for options in told.values() for name in options}
        text = "\n".join(self.sections.values())
        self.assertEqual(set(re.findall(r"(?<![\w-])--([a-z][a-z0-9-]*)", text)) - known, set())

    @unittest.skipUnless(shutil.which("man"), "there is no man")
    def test_it_is_short(self):
        done = subprocess.run(["man", "-l", os.path.join(BUILD_DIR, "docs", "festoon.1")], capture_output=True, text=True,
                              env={**os.environ, "MANWIDTH": "80"}, check=False)
        if done.returncode == 0:
            self.assertLess(done.stdout.count("\n"), 890)


if __name__ == "__main__":
    unittest.main()
