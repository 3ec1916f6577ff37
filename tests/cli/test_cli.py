"""The program as a user meets it: exit statuses, output on the right stream, the JSON keys that scripts rely on,
files.

tests: cli/program.c cli/main.c cli/commands.c cli/common.c cli/options.c cli/scene.c cli/groups.c cli/help.c cli/init.c
  cli/check.c cli/schema.c cli/run.c cli/field.c host/components.c"""

import json
import math
import os
import re
import shlex
import shutil
import signal
import subprocess
import tempfile
import time
import unittest

import events

FESTOON = os.environ["FESTOON"]
SOURCE_DIR = os.environ["SOURCE_DIR"]

SHORT = ["--set", "run.periods=30", "--set", "run.discard=10"]

RUN_KEYS = """omega frequency_hz dynamics mean_r std_r mean_alpha_dot mean_phi_dot mean_nz festoons symmetry regime
max_angle_deg mean_b std_b min_b max_b mean_friction_power mean_drive_power periods rhs_calls final_state""".split()

REGIMES = """locked librating counter-rotating corotating chaotic ejected lifted undecided""".split()


def festoon(*words, **options):
    options.setdefault("stdin", subprocess.DEVNULL)
    options.setdefault("stdout", subprocess.PIPE)
    options.setdefault("timeout", events.HANG)
    done = subprocess.run([FESTOON, *words], stderr=subprocess.PIPE, **options)
    return done.returncode, (done.stdout or b"").decode(), done.stderr.decode(errors="replace")


class Case(unittest.TestCase):
    maxDiff = None

    def setUp(self):
        holder = tempfile.TemporaryDirectory(prefix="festoon-cli-")
        self.addCleanup(holder.cleanup)
        self.directory = holder.name

    def path(self, name, contents=None):
        path = os.path.join(self.directory, name)
        if contents is not None:
            with open(path, "wb") as file:
                file.write(contents.encode() if isinstance(contents, str) else contents)
        return path

    def good(self, *words, **options):
        status, out, messages = festoon(*words, **options)
        self.assertEqual(status, 0, messages)
        return out

    def bad(self, words, *parts, status=2, **options):
        """The command is refused with this status, prints nothing on standard output, and its message contains every
        part."""
        got, out, messages = festoon(*words, **options)
        self.assertEqual((got, out), (status, ""), f"{words}: {messages}")
        for part in parts:
            self.assertIn(part, messages, words)
        self.assertEqual(messages.count("\n"), 1, messages)
        return messages

    def json(self, *words):
        return json.loads(self.good(*words, "--json"))


class Usage(Case):
    def test_version_and_help(self):
        self.assertRegex(self.good("--version"), r"^festoon \d+\.\d+\.\d+\n")
        for words in (["--help"], ["-h"], ["help"]):
            self.assertIn("usage: festoon", self.good(*words))
        for command in "run field plot paper init check schema".split():
            text = self.good(command, "--help")
            self.assertIn(f"usage: festoon {command}", text)
            self.assertEqual(text, self.good("help", command))
            self.assertIn(command, self.good("--help"))

    def test_alone_it_greets(self):
        """Without a word, festoon shows three commands, which work in this order; an empty word is still an error."""
        text = self.good()
        commands = re.findall(r"^  festoon (.*?)  ", text, re.M)
        self.assertEqual([command.split()[0] for command in commands], ["run", "plot", "init"])
        for command in commands:
            self.good(*shlex.split(command), cwd=self.directory)
        self.assertEqual(sorted(os.listdir(self.directory)), ["bead.h5", "my-bead.yaml", "path.dat", "path.gp", "path.png"])
        self.bad([""], "unknown command")

    def test_version_is_quick(self):
        """A start takes less than 10 ms. The test takes the best of many, because the machine may be busy."""
        best = math.inf
        for _ in range(20):
            started = time.perf_counter()
            subprocess.run([FESTOON, "--version"], stdout=subprocess.DEVNULL, check=True)
            best = min(best, time.perf_counter() - started)
        print(f"festoon --version: {1e3 * best:.1f} ms")

    def test_unknown_words(self):
        self.bad(["rnu"], "nearest is run")
        self.bad(["help", "feild"], "nearest is field")
        self.bad(["--versoin"], "nearest is --version")
        self.bad(["run", "--jsn"], "--jsn", "nearest is --json")
        self.bad(["run", "--oputput=x"], "nearest is --output")
        self.bad(["run", "-x"], "unknown option -x")
        self.bad(["run", "--set", "bead.radius", "-2mm"], 'a "=" is missing: --set bead.radius=-2mm')
        self.bad(["run", "a.yaml", "b.yaml"], "unexpected argument")
        self.bad(["schema", "x"], "unexpected argument")
        self.bad(["run", "--json", "--json"], "given twice")
        self.bad(["run", "--json=yes"], "takes no value")
        self.bad(["run", "--set"], "KEY=VALUE")
        self.bad(["run", "-o", "--json"], "--json follows")

    def test_bad_settings(self):
        self.bad(["check", "--set", "bead.radius"], "KEY=VALUE")
        self.bad(["check", "--set", "bead.raduis=1mm"], "nearest is bead.radius")
        self.bad(["check", "--set", "bead.radius=1Hz"], "um mm cm m")
        self.bad(["check", "--set", "bead.radius=2m"], "out of range", "1000 mm")
        self.bad(["check", "--set", "model.dynamics=riged"], "nearest is rigid")
        self.bad(["check", "--set", "run.rtol=nan"], "not a decimal number")
        self.bad(["check", "--set", "magnet.lines=1.5"], "integer")
        self.bad(["check", "--set", "run.discard=400"], "run.discard")
        self.bad(["check", "--set", "start.r=0"], "start.r")

    def test_bad_options(self):
        self.bad(["field"], "--at")
        self.bad(["field", "--json", "-o", self.path("f.svg")], "--at")
        for at in ("1", "1,2,3", "1,", ",1", "1,b", "1;2", "1,nan", "", "1Hz,2", "1mm,2g", "1mm", "1,5mm,2mm"):
            self.bad(["field", "--at", at], "--at", "10mm,5mm")
        for ramp in ("7", "7:", ":7", "7:0", "7:-3", "7:8:9", "omega=0.2", "omega=0.2:9 Hz", "7 mm:8 mm"):
            self.bad(["run", "--ramp", ramp], "--ramp")
        self.bad(["run", "--ramp-points", "3"], "--ramp")
        self.bad(["run", "--ramp", "7:8", "--ramp-points", "0"], "--ramp-points")
        self.bad(["run", "--csv", self.path("t.txt")], ".csv")
        self.bad(["run", "-o", self.path("t.txt")], ".h5 or .csv")
        self.bad(["run", "-o", self.path("t.csv"), "--csv", self.path("t.csv")], "same file")
        self.bad(["run", "-o", self.directory + "/none/t.csv"], "No such file", status=1)
        self.bad(["plot"], "trajectory is missing")
        self.bad(["plot", "x.h5"], "-o")
        self.bad(["plot", "x.h5", "-o", "x.svg", "--kind", "pth"], "nearest is path")
        self.bad(["plot", "x.h5", "-o", "x.svg", "--from", "3", "--to", "2"], "--to")
        self.bad(["plot", "x.h5", "-o", "x.svg", "--zoom", "1,0,0,1"], "--zoom")
        self.bad(["paper"], "-o DIR")
        self.bad(["run", "--set", "bead.a=1e-3"], "bead.a", "hard", "paramagnetic or mixed")
        self.bad(["run", "--set", "bead.material=paramagnetic", "--set", "bead.b=1e-3"], "bead.b", "choose mixed, or")


    def test_the_program_of_the_paper_is_missing(self):
        """festoon paper is done by festoon-paper; without it there is a sentence."""
        alone = self.path("festoon")
        shutil.copy(FESTOON, alone)
        done = subprocess.run([alone, "paper", "--statements"], capture_output=True, text=True, check=False,
                              env={**os.environ, "LD_LIBRARY_PATH": os.path.dirname(FESTOON)})
        self.assertEqual((done.returncode, done.stdout), (1, ""))
        self.assertIn("festoon-paper", done.stderr)

    def test_nearest_names(self):
        self.bad(["run", "--set", "drive.freq=9"], "the nearest is drive.frequency ")
        self.bad(["run", "--set", "freq=9"], "the nearest is drive.frequency ")
        self.bad(["branch", "--kind", "counter", "--over", "drive.freq=9:10"], "the nearest is drive.frequency")
        self.bad(["sweep", "--over", "drive.freq=9:10:3", "-o", self.path("a.db")], "the nearest is drive.frequency ")
        self.bad(["run", "--out=x.h5"], "the nearest is --output")
        self.bad(["run", "--frequency", "9Hz"], "unknown option --frequency; a parameter is set by --set drive.frequency=VALUE")
        self.bad(["run", "--radius=2mm"], "unknown option --radius; a parameter is set by --set bead.radius=VALUE")
        self.bad(["export", "--frequency", "9Hz"], "unknown option --frequency; choose one of --quiet, --help, --csv, ")
        self.assertEqual(self.good("help", "help"), self.good("--help"))
        self.assertEqual(self.good("help", "completion"), self.good("completion", "--help"))

    def test_decimal_comma(self):
        self.bad(["run", "--set", "drive.frequency=1,5 Hz"], 'has a decimal comma: write "1.5 Hz", with a point')
        self.bad(["run", "--ramp", "7,5:20"], 'has a decimal comma: write "7.5", with a point')
        scene = self.path("s.yaml", "bead:\n  radius: 2,5 mm\n")
        self.bad(["check", scene], "s.yaml:2", 'write "2.5 mm"')


class Scenes(Case):
    def test_from_standard_input(self):
        """`-` is a scene that another program writes; its errors name the line."""
        scene = self.path("s.yaml", self.good("init", "-", "--set", "drive.frequency=12 RPM"))
        with open(scene, "rb") as file:
            piped = self.good("check", "-", "--json", stdin=file)
        self.assertEqual(piped, self.good("check", scene, "--json"))
        for contents, status, part in (("bead:\n  raduis: 1 mm\n", 2, "standard input:2: unknown key"), ("", 2, "empty"),
                                       ("friction:\n  contact_rate: 0.01\n", 2, "standard input:2: friction.contact_rate is gone"),
                                       ("# " + "x" * (1 << 20), 2, "1048576")):
            reader = subprocess.run([FESTOON, "run", "-"], input=contents.encode(), capture_output=True, check=False)
            self.assertEqual((reader.returncode, reader.stdout), (status, b""))
            self.assertIn(part, reader.stderr.decode())
        closed = subprocess.run(["/bin/sh", "-c", '"$0" run - <&-', FESTOON], capture_output=True, check=False)
        self.assertEqual(closed.returncode, 1)
        self.assertIn(b"standard input", closed.stderr)

    def test_interrupted_while_it_waits_for_a_scene(self):
        with subprocess.Popen([FESTOON, "run", "-"], stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.PIPE) as waits:
            events.wait_for(waits, lambda: events.listens(waits))
            waits.send_signal(signal.SIGINT)
            self.assertEqual(waits.wait(events.HANG), 130)
            self.assertIn(b"interrupted while reading the scene", waits.stderr.read())

    def refused(self, contents, where, *parts):
        path = self.path("s.yaml", contents)
        return self.bad(["check", path], path + where, *parts)

    def test_bad_scenes(self):
        self.refused("bead:\n  raduis: 1 mm\n", ":2:", "bead.radius")
        self.refused("bead:\n  radius: 1 ms\n", ":2:", "um mm cm m")
        self.refused("bead:\n  radius: 1 km\n", ":2:", "bead.radius")
        self.refused("bead:\n  radius: 2 m\n", ":2:", "out of range")
        self.refused("bead:\n  radius: 1 mm\n  radius: 2 mm\n", ":3:", "given twice")
        self.refused("drive:\n  frequency: 9 Hz\n  omega: 0.2\n", ":3:", "drive.frequency")
        self.refused("bead: &x\n  radius: 1 mm\n", ":1:", "aliases")
        self.refused("bead:\n  radius: *x\n", ":2:", "aliases")
        self.refused("bead:\n  radius: !!float 1\n", ":2:", "tags")
        self.refused(b"\x00\x01\x02\xff", ":1:", "UTF-8")
        self.refused(b"\xff\xfeb\x00", ":1:", "UTF-8")
        self.refused(bytes(range(256)) * 100, ":1:", "UTF-8")
        self.refused("bead:\n  radius:\n", ":2:", "no value")
        self.refused("- 1\n", ":1:", "groups of keys")
        self.refused("a: {b: {c: 1}}\n", ":1:", "unknown group")
        self.refused("[" * 100000, ":1:")
        self.refused("a: " * 100000, ":1:")
        self.refused("bead: {radius: 1 mm}\n---\nbead: {radius: 1 mm}\n", ":2:", "one YAML document")

    def test_bad_files(self):
        self.bad(["check", self.path("none.yaml")], "No such file")
        self.bad(["check", self.directory], "directory")
        self.bad(["run", "/dev/zero"], "regular file")
        self.bad(["check", self.path("big.yaml", b"# filler\n" * 120000)], "1048576")
        fifo = self.path("fifo")
        os.mkfifo(fifo)
        self.bad(["run", fifo], "regular file", timeout=20)

    def test_empty_scene_is_the_default(self):
        nothing = self.json("check", self.path("s.yaml", "# nothing\n"))
        self.assertEqual(nothing, self.json("check"))

    def test_set_replaces_every_key(self):
        field = os.path.join(SOURCE_DIR, "examples", "magnets", "measured-map.csv")
        mapped = [f"magnet.file={field}", "magnet.shape=grid"]
        needs = {"bead.remanence": ["magnet.b0=10mT"], "magnet.shape": mapped[:1], "magnet.file": mapped[1:],
                 "magnet.checksum": mapped}
        beads = ["beads[0].start.phi=0", "beads[1].start.phi=180"]
        needs.update(dict.fromkeys(("contact.pair_rate", "contact.pair_mu", "model.chi", "run.method"), beads))
        needs["run.step"] = [*beads, "run.method=stepping"]
        needs["plate.shape"] = [f"start.position[{i}]={x}" for i, x in enumerate((0, 0, 0.08))]
        needs["plate.bowl_radius"] = ["plate.shape=bowl"]
        wave = ["magnet.b0=10mT", "wave.length=0.1", "wave.amplitude=0.01", "drive.waveform=wave"]
        needs["drive.waveform"] = wave[:3]
        needs.update({key: [text for text in wave if key not in text] for key in ("wave.length", "wave.amplitude", "wave.ratio")})
        needs["drive.amplitude"] = ["drive.waveform=oscillating"]
        needs["drive.chirp"] = ["drive.waveform=chirp"]
        needs["drive.table"] = ["drive.waveform=table"]
        scene = self.json("check", *(word for text in mapped for word in ("--set", text)))["scene"]
        texts = {"magnet.file": field, "magnet.checksum": scene["magnet.checksum"], "run.step": 2000.0,
                 "drive.table": "0:0 1:90"}
        for row in json.loads(self.good("schema", "--json")):
            if row["parts"]:  # tests/model/test_parts_keys.c
                continue
            value = row["names"][-1] if row["names"] else texts.get(row["key"], row["default"])
            if value is None:
                value = min(1.0, row["max"])
            sets = [word for text in (*needs.get(row["key"], ()), f"{row['key']}={value}") for word in ("--set", text)]
            scene = self.json("check", *sets)["scene"]
            self.assertEqual(scene[row["key"]], value, row["key"])

    def test_set_chooses_each_kind_of_magnet(self):
        field = os.path.join(SOURCE_DIR, "examples", "magnets", "measured-map.csv")
        kinds = {"lines": [], "parts": ["magnet.parts[0].kind=dipole", "magnet.parts[0].moment[0]=2"],
                 "grid": [f"magnet.file={field}"]}
        (row,) = (row for row in json.loads(self.good("schema", "--json")) if row["key"] == "magnet.shape")
        self.assertEqual(row["names"], list(kinds))
        for kind, needs in kinds.items():
            words = [word for text in (f"magnet.shape={kind}", *needs) for word in ("--set", text)]
            self.assertEqual(self.json("check", *words)["scene"]["magnet.shape"], kind)
            if needs:
                self.bad(["check", *words[:2]], "magnet.file" if kind == "grid" else "magnet.parts")
        checksum = self.json("check", *words)["scene"]["magnet.checksum"]
        self.assertRegex(checksum, "^[0-9a-f]{16}$")
        self.good("check", *words, "--set", f"magnet.checksum={checksum}")
        self.bad(["check", *words, "--set", f"magnet.checksum={checksum[::-1]}"], checksum, "changed")

    def test_set_replaces_the_other_form(self):
        path = self.path("s.yaml", "drive: {omega: 0.3}\nbead: {radius: 2 mm, moment: 0.1}\nmagnet: {b0: 10 mT}\n")
        plain = self.json("check", path)
        self.assertEqual(plain["groups"]["omega"], 0.3)
        self.assertIsNone(plain["scene"]["drive.frequency"])
        self.assertIsNone(plain["scene"]["model.kappa"])
        changed = self.json("check", path, "--set", "drive.frequency=642 rpm", "--set", "model.eps=0.1", "--set",
                            "model.kappa=1.25")
        self.assertIsNone(changed["scene"]["drive.omega"])
        self.assertIsNone(changed["scene"]["bead.radius"])
        self.assertIsNone(changed["scene"]["magnet.b0"])
        self.assertEqual(changed["scene"]["drive.frequency"], 10.7)
        self.assertEqual(changed["groups"]["eps"], 0.1)
        self.assertEqual(changed["groups"]["kappa"], 1.25)

    def test_two_settings_of_one_quantity(self):
        """Every pair of forms that the schema names, in either order, is told; the same key again is not a contradiction."""
        keys = {key["key"]: key for key in json.loads(self.good("schema", "--json"))}
        forms = {name: key["other_form"] for name, key in keys.items() if key["other_form"]}
        self.assertGreater(len(forms), 10)
        for one, two in [*forms.items(), ("start.r", "start.position[0]"), ("start.position[1]", "start.phi")]:
            if "model.kappa" in (one, two):
                continue  # with lines, B0 alone is no other form of it
            with self.subTest(one=one):
                values = [max(0.01, keys.get(name, {}).get("min") or 0) for name in (one, two)]
                told = festoon("check", "--set", f"{one}={values[0]}", "--set", f" {two} ={values[1]}")[2]
                self.assertIn(f"{one} and {two} give the same quantity: the last counts, {two}", told)
        # kappa follows from the moment and B0: which of the three is given last counts, and what it drops is told.
        kappa, moment, field = "model.kappa=2", "bead.moment=0.01", "magnet.b0=10mT"
        block = [f"--set=magnet.parts[0].{key}" for key in ("kind=cuboid", "size[0]=0.05", "size[1]=0.02", "size[2]=0.01", "remanence[0]=1")]
        block.append("--set=magnet.shape=parts")
        for before, sets, dropped in (([], (moment, field, kappa), "magnet.b0 and model.kappa"), ([], (kappa, moment, field), "model.kappa and magnet.b0"),
                                      ([], (kappa, field, moment), "model.kappa and bead.moment"), ([], (field, kappa, moment), "magnet.b0 and model.kappa"),
                                      ([], (kappa, moment), None), ([], (moment, kappa), None), ([], (kappa, field), None),
                                      (block, (moment, kappa), "bead.moment and model.kappa"), (block, (kappa, moment), "model.kappa and bead.moment")):
            with self.subTest(sets=sets):
                told = festoon("check", *before, *(word for value in sets for word in ("--set", value)))[2]
                self.assertEqual("give the same quantity" in told, dropped is not None, told)
                self.assertIn(f"{dropped} give the same quantity" if dropped else "", told)
        scene = self.path("moment.yaml")
        for text, sets, dropped in (("bead: {moment: 0.0005}\nmagnet: {b0: 10 mT}\n", ("model.kappa=2",), "magnet.b0"),
                                    ("model: {kappa: 2}\n", ("bead.moment=0.0005", "magnet.b0=10mT"), "model.kappa"),
                                    ("model: {kappa: 2}\n", ("model.kappa=1.2",), None), ("model: {kappa: 2}\n", ("bead.moment=0.0005",), None)):
            with open(scene, "w", encoding="utf-8") as file:
                file.write(text)
            told = festoon("check", scene, *(word for value in sets for word in ("--set", value)))[2]
            self.assertEqual("does not count" in told, dropped is not None, told)
            self.assertIn(f"the scene's {dropped} does not count" if dropped else "", told)
        given = ["sweep", "--set", "bead.moment=0.0005", "--set", "magnet.b0=10mT", "--set", "run.periods=6", "-o"]
        told = festoon(*given, self.path("k.db"), "--over", "model.kappa=1:2:3")[2]
        self.assertEqual(told.count("model.kappa is varied, so that magnet.b0 follows"), 1, told)
        self.assertNotIn("follows", festoon(*given, self.path("f.db"), "--over", "drive.frequency=9Hz:10Hz:3")[2])
        twice = self.json("check", "--set", "drive.frequency=11", "--set", "drive.frequency=12")
        self.assertEqual(twice["scene"]["drive.frequency"], 12)

    def test_init_and_check(self):
        path = self.path("made.yaml")
        self.good("init", path)
        self.assertEqual(self.json("check", path), self.json("check"))
        self.bad(["init", path], "--force")
        self.bad(["init", self.directory], "directory")
        self.good("init", path, "--force", "--set", "drive.frequency=19.9Hz")
        self.assertEqual(self.json("check", path)["scene"]["drive.frequency"], 19.9)
        self.good("init", cwd=self.directory)
        self.assertIn("festoon.yaml", os.listdir(self.directory))
        with open(path) as file:
            text = file.read()
        for row in json.loads(self.good("schema", "--json")):
            if not row["parts"]:
                self.assertIn(f" {row['key'].split('.')[1]}:", text)
        self.assertEqual(self.good("init", "-", "--set", "drive.frequency=19.9Hz"), text)

    def test_schema(self):
        rows = json.loads(self.good("schema", "--json"))
        text = self.good("schema")
        for row in rows:
            self.assertLessEqual({"key", "unit", "default", "min", "max", "doc"}, set(row))
            self.assertIn(row["key"].replace("[0]", "[N]", 1) if row["parts"] else row["key"], text)
        keys = [row["key"] for row in rows]
        for key in ("bead.radius", "drive.omega", "run.samples", "model.dynamics", "start.spin"):
            self.assertIn(key, keys)

    def test_examples(self):
        examples = os.path.join(SOURCE_DIR, "examples")
        for name, frequency in (("paper-10.7Hz.yaml", 10.7), ("paper-19.9Hz.yaml", 19.9)):
            checked = self.json("check", os.path.join(examples, name))
            self.assertEqual(checked["scene"]["drive.frequency"], frequency)
            self.assertAlmostEqual(checked["groups"]["eps"], 2.5 / 23, places=15)
            self.assertAlmostEqual(checked["groups"]["h"], 18.7 / 23, places=15)
            self.assertAlmostEqual(checked["groups"]["lambda"], 40 / 92, places=15)


class Field(Case):
    def test_minus_values(self):
        spaced = self.json("field", "--at", "-0.7,1.1")
        joined = self.json("field", "--at=-0.7,1.1")
        self.assertEqual(spaced, joined)
        self.assertEqual(len(spaced["b"]), 3)
        gradient = spaced["grad"]
        self.assertAlmostEqual(gradient[0][0] + gradient[1][1] + gradient[2][2], 0.0, places=12)
        # The magnet turned by half a turn is the magnet with its poles exchanged.
        opposite = self.json("field", "--at", "0.7,-1.1")
        for here, sign, there in zip(spaced["b"], (1, 1, -1), opposite["b"]):
            self.assertAlmostEqual(here, sign * there, places=13)
        self.assertIn("-0.7", self.good("field", "--at", "-0.7,1.1"))


class Run(Case):
    def test_json_keys(self):
        result = self.json("run", *SHORT)
        for key in RUN_KEYS:
            self.assertIn(key, result)
        self.assertIn(result["regime"], REGIMES)
        self.assertIn(result["symmetry"], ("S1", "S2", None))
        self.assertEqual(len(result["final_state"]), 10)
        self.assertAlmostEqual(result["periods"], 30, places=12)
        self.assertIsInstance(result["rhs_calls"], int)
        self.assertEqual(result["frequency_hz"], 10.7)
        self.assertEqual(result["scene"]["bead.radius"], 0.0025)

    def test_same_run_same_text(self):
        self.assertEqual(self.good("run", "--json", *SHORT), self.good("run", "--json", *SHORT))

    def test_scaled_and_si_agree(self):
        si = self.json("run", *SHORT)
        scaled = self.json("run", *SHORT, "--set", f"drive.omega={si['omega']!r}")
        self.assertEqual(si["final_state"], scaled["final_state"])

    def test_text_for_people(self):
        text = self.good("run", "--set", "model.dynamics=farago2020", "--set", "drive.omega=0.405")
        self.assertRegex(text, r"^counter-rotates: the bead circles backwards once every [\d.]+ turns of the magnet, "
                               r"15 festoons, radius 20\.9 mm\n")
        for word in ("mm", "Hz", "kappa = 1.5", "energy residual", "degrees"):
            self.assertIn(word, text)

    def test_ejected_is_a_result(self):
        result = self.json("run", "--set", "plate.radius=22mm")
        text = self.good("run", "--set", "plate.radius=22mm")
        if result["regime"] == "ejected":
            self.assertRegex(text, r"^ejected: .* after [\d.]+ turns")
        self.assertLessEqual(result["periods"], 400)

    def test_ramp(self):
        words = ["--ramp", "10:12", "--ramp-points", "4", "--set", "run.periods=60", "--set", "run.discard=10"]
        points = self.json("run", *words)["ramp"]
        self.assertEqual(len(points), 4)
        frequencies = [point["frequency_hz"] for point in points]
        self.assertEqual(frequencies, sorted(frequencies))
        self.assertTrue(10 < frequencies[0] and frequencies[-1] < 12)
        self.assertIn("drive Hz", self.good("run", *words))
        words[1] = "600rpm:720 rpm"
        in_rpm = self.json("run", *words)["ramp"]
        self.assertAlmostEqual(in_rpm[0]["mean_r"], points[0]["mean_r"], places=9)

    def test_ramp_waits(self):
        words = ["run", "--ramp", "omega=0.3:0.31", "--ramp-points", "2", "--set", "run.periods=30", "--set", "run.discard=10"]
        result = self.json(*words)
        self.assertEqual([point["settled"] for point in result["ramp"]], [True, True])
        self.assertIn("2 of its 2 pieces settled", result["reason"])
        self.assertGreater(result["periods"], 30)
        self.assertNotIn(" *\n", self.good(*words))
        steady = self.json(*words, "--ramp-wait", "0")
        self.assertEqual([point["settled"] for point in steady["ramp"]], [False, False])
        self.assertIn("leaves it late", steady["reason"])
        self.assertAlmostEqual(steady["periods"], 30, places=6)
        for wrong in (["--ramp-wait", "-1"], ["--ramp-wait", "x"], ["--ramp-disturbance", "0.1"], ["--ramp-disturbance", "nan"]):
            self.bad([*words, *wrong], wrong[0])
            self.bad(["run", *wrong], wrong[0])

    def test_a_drift_is_no_regime(self):
        result = self.json("run", "--set", "drive.frequency=200")
        self.assertEqual((result["regime"], result["symmetry"], result["festoons"], result["period"]),
                         ("undecided", None, None, None))
        self.assertIn("may still drift", result["reason"])
        self.assertIn("raise run.periods", self.good("run", "--set", "drive.frequency=200"))

    def read_csv(self, path):
        with open(path) as file:
            lines = file.read().splitlines()
        names = next(line for line in lines if not line.startswith("#")).split(",")
        rows = [line.split(",") for line in lines if not line.startswith("#")][1:]
        self.assertTrue(all(len(row) == len(names) for row in rows))
        return lines, names, rows

    def test_trajectories(self):
        h5, csv = self.path("t.h5"), self.path("t.csv")
        result = self.json("run", *SHORT, "-o", h5, "--csv", csv, "--set", "run.samples=16")
        self.assertEqual(sorted(os.listdir(self.directory)), ["t.csv", "t.h5"])
        lines, names, rows = self.read_csv(csv)
        self.assertEqual(lines[0], "# festoon trajectory")
        self.assertEqual(lines[-1], "# complete = true")
        self.assertIn("#     frequency: 10.7 Hz", lines)
        self.assertEqual(names[0], "t [1/gamma]")
        self.assertEqual(len(rows), 30 * 16 + 1)
        inside = next(line for line in lines if line.startswith("# result = "))
        self.assertEqual(json.loads(inside[11:])["mean_r"], result["mean_r"])
        with open(h5, "rb") as file:
            self.assertEqual(file.read(8), b"\x89HDF\r\n\x1a\n")
        # Writing files changes no result, and replaces older files of the same names.
        self.assertEqual(self.json("run", *SHORT, "--csv", csv)["final_state"], result["final_state"])

    def test_output_over_a_device_or_directory(self):
        os.mkdir(self.path("d.csv"))
        self.bad(["run", "-o", self.path("d.csv"), *SHORT], "directory")
        os.symlink("/dev/null", self.path("null.csv"))
        self.bad(["run", "-o", self.path("null.csv"), *SHORT], "no regular file")
        self.assertEqual(sorted(os.listdir(self.directory)), ["d.csv", "null.csv"])

    FOR_DAYS = [FESTOON, "run", "--set", "run.periods=1e9", "--set", "run.samples=16"]

    def written(self, name):
        """Size of a file that is being written, under whatever temporary name beside its own."""
        return sum(os.path.getsize(self.path(found)) for found in os.listdir(self.directory) if name in found)

    def test_interrupted(self):
        status, out, messages = events.on_a_terminal(self.FOR_DAYS, lambda text: " left" in text)
        self.assertEqual((status, out), (130, b""), messages)
        self.assertIn("interrupted", messages)
        for number, words in ((signal.SIGINT, []), (signal.SIGHUP, []), (signal.SIGTERM, ["-o", self.path("i.h5")])):
            status, out, messages = events.signal_when([*self.FOR_DAYS, "--csv", self.path("i.csv"), *words],
                                                       lambda: self.written(".i.csv.") > 100000, number)
            self.assertEqual((status, out), (130, b""), messages)
            self.assertIn(b"interrupted", messages)
            self.assertEqual(sorted(os.listdir(self.directory)), ["i.csv", "i.h5"][:1 + bool(words)])
        lines, _, rows = self.read_csv(self.path("i.csv"))
        self.assertEqual(lines[-1], "# complete = false")
        self.assertGreater(len(rows), 100)
        for ending in ("csv", "h5"):
            status, _, messages = festoon("plot", self.path("i." + ending), "-o", self.path(ending + ".svg"))
            if status != 1 or "gnuplot" not in messages:
                self.assertEqual(status, 0, messages)

    def test_nohup(self):
        """SIGHUP stays ignored if the caller ignores it (nohup); SIGTERM still ends the command."""
        def ignored():
            with open(f"/proc/{process.pid}/status", encoding="ascii") as file:
                return int(re.search(r"^SigIgn:\s*(\w+)", file.read(), re.M).group(1), 16)
        process = events.start(["nohup", *self.FOR_DAYS, "--csv", self.path("n.csv")],
                               stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        try:
            events.wait_for(process, lambda: self.written(".n.csv.") > 0)
            self.assertTrue(ignored() >> (signal.SIGHUP - 1) & 1)
        finally:
            process.terminate()
            process.communicate(timeout=events.HANG)
        self.assertEqual(process.returncode, 130)

    def test_plot_refuses_foreign_files(self):
        figure = self.path("f.svg")
        for name, contents in (("a.h5", b"\x89HDF\r\n\x1a\nrubbish"), ("a.csv", b"1,2\n"), ("b.csv", b""),
                               ("c.csv", bytes(range(256)))):
            self.bad(["plot", self.path(name, contents), "-o", figure], name)
        self.bad(["plot", self.path("none.h5"), "-o", figure], "No such file")
        self.assertFalse(os.path.exists(figure))


class StandardOutput(Case):
    def test_full_disk(self):
        with open("/dev/full", "w") as full:
            self.bad(["schema"], "standard output", status=1, stdout=full)

    def test_closed(self):
        for words in (["schema"], ["check", "--json"]):
            done = subprocess.run(["/bin/sh", "-c", '"$0" "$@" >&-', FESTOON, *words], stderr=subprocess.PIPE)
            self.assertEqual(done.returncode, 1)
            self.assertIn(b"standard output", done.stderr)

    def test_closed_streams_do_not_spoil_files(self):
        path = self.path("t.csv")
        done = subprocess.run(["/bin/sh", "-c", '"$0" "$@" <&- >&- 2>&-', FESTOON, "run", "-o", path, *SHORT])
        self.assertEqual(done.returncode, 1)
        with open(path) as file:
            self.assertEqual(file.read().splitlines()[-1], "# complete = true")

    def test_a_reader_that_takes_a_part(self):
        """export --csv | head -1: no error and no message, whether the output is small or larger than a pipe."""
        base = self.path("a.db")
        self.good("sweep", "--over", "drive.frequency=9Hz:12Hz:200", "--set", "run.periods=1", "--set", "run.discard=0.5", "-o", base)
        for words in (["export", base, "--csv"], ["export", base, "--json"], ["schema"], ["run", "--json", *SHORT]):
            with open(self.path("said"), "wb") as said, \
                    subprocess.Popen([FESTOON, *words], stdout=subprocess.PIPE, stderr=said) as writer:
                self.assertTrue(writer.stdout.readline())
                writer.stdout.close()
                self.assertEqual(writer.wait(events.HANG), 0)
            self.assertEqual(os.path.getsize(self.path("said")), 0)

    def test_broken_pipe(self):
        reader, writer = os.pipe()
        os.close(reader)
        with os.fdopen(writer, "w") as stream:
            self.bad(["schema"], "standard output", status=1, stdout=stream)


if __name__ == "__main__":
    unittest.main()
