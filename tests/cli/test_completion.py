"""Shell completion: the scripts of `festoon completion` offer what the tables of options and parameters hold, and take
names of files as they are.  bash is driven through its completion function; zsh and fish where they are installed.

tests: cli/completion_offer.c cli/completion.c"""

import json
import os
import re
import shutil
import subprocess
import unittest

from sweep_tools import Case, FESTOON

# Names that would be commands, globs or options if a script evaluated them.
HOSTILE = ["$(touch pwned).yaml", "`touch pwned`.yaml", "a b;touch pwned;.yaml", "*.yaml", "'q'.yaml", "--set.yaml",
           "{a,b}.yaml", "$HOME.yaml", "!!.yaml", "\\.yaml"]

# The scripts ask the program on the path.
ENVIRONMENT = {**os.environ, "PATH": f"{os.path.dirname(os.path.abspath(FESTOON))}:{os.environ['PATH']}"}

DRIVE = r"""
source "$1"; shift
COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); COMPREPLY=()
_festoon
printf '%s\n' "${COMPREPLY[@]}"
"""


KEYS_OF_THE_DRIVE = [f"drive.{name}=" for name in ("frequency", "omega", "waveform", "amplitude", "chirp", "table")]


class Completion(Case):
    def setUp(self):
        super().setUp()
        self.script = self.path("festoon.bash")
        with open(self.script, "w", encoding="utf-8") as file:
            file.write(self.good("completion", "bash"))
        self.commands = re.findall(r"^  ([a-z]+) +[A-Z]", self.good("--help"), re.M)
        self.assertGreater(len(self.commands), 10)

    def offered(self, *words, folder=None):
        """What bash offers for the last of the words, which stand behind the name of the program."""
        done = subprocess.run(["bash", "--norc", "--noprofile", "-c", DRIVE, "bash", self.script, "festoon", *words],
                              capture_output=True, text=True, cwd=folder or self.directory, env=ENVIRONMENT,
                              check=False)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        return [line for line in done.stdout.split("\n") if line]

    def options_of(self, command):
        return set(re.findall(r"^ .*?(--[a-z0-9-]+)", self.good(command, "--help").split("options:")[1], re.M))

    def test_commands_and_options(self):
        words = self.offered("")
        self.assertEqual(set(words), set(self.commands) | {"help", "completion", "--help", "--version"})
        self.assertEqual(self.offered("ru"), ["run"])
        self.assertEqual(self.offered("help", "ru"), ["run"])
        self.assertEqual(self.offered("completion", ""), ["bash", "zsh", "fish"])
        for command in self.commands:
            self.assertEqual(set(self.offered(command, "-")), self.options_of(command), command)
        self.assertEqual(self.offered("run", "--js"), ["--json"])

    def test_scene_keys_and_their_choices(self):
        schema = json.loads(self.good("schema", "--json"))
        keys = [row["key"] + "=" for row in schema]
        self.assertGreater(len(keys), 30)
        self.assertEqual(self.offered("run", "--set", ""), keys)
        self.assertIn("magnet.parts[0].size[2]=", keys)
        self.assertEqual(self.offered("run", "--set", "magnet.parts[0].ki"), ["magnet.parts[0].kind="])
        self.assertEqual(self.offered("run", "--set", "magnet.parts[0].kind", "=", "c"), ["cuboid", "cylinder"])
        with open(self.path("magnet.parts0.kind="), "w", encoding="utf-8"):  # what the key is as a pattern
            self.assertEqual(self.offered("run", "--set", ""), keys)
        self.assertEqual(self.offered("run", "--set", "drive."), KEYS_OF_THE_DRIVE)
        self.assertEqual(self.offered("sweep", "--over", "start.p"), ["start.phi="])
        # Readline breaks words at "=".
        for words in (["--set", "model.dynamics", "=", ""], ["--set", "model.dynamics", "="],
                      ["--set", "=", "model.dynamics", "=", ""]):
            self.assertEqual(self.offered("run", *words), ["rigid", "farago2020"], words)
        self.assertEqual(self.offered("run", "--set", "model.dynamics", "=", "f"), ["farago2020"])
        self.assertEqual(self.offered("run", "--set", "=", "drive.o"), ["drive.omega="])
        self.assertEqual(self.offered("run", "--set", "drive.omega", "=", ""), [])
        # Where COMP_WORDBREAKS has no "=", the word comes whole.
        self.assertEqual(self.offered("run", "--set", "model.dynamics=f"), ["model.dynamics=farago2020"])
        self.assertEqual(self.offered("run", "--set=model.dynamics=f"), ["--set=model.dynamics=farago2020"])

    def test_choices(self):
        self.assertEqual(self.offered("branch", "--kind", ""), ["counter", "locked", "all", "levitating", "driven"])
        self.assertEqual(self.offered("branch", "--kind", "=", "c"), ["counter"])
        self.assertEqual(self.offered("plot", "--kind", "lo"), ["local-n"])
        self.assertEqual(self.offered("sweep", "--threads", ""), [])
        self.assertIn("mean_r", self.offered("plot", "--quantity", "mean_"))
        self.assertEqual(self.offered("plot", "--quantity", "regime,mean_n"), ["regime,mean_nz", "regime,mean_nz_error"])
        self.assertEqual(self.offered("fit", "--free", "model.kappa,friction.g"), ["model.kappa,friction.gamma"])
        self.assertEqual(self.offered("fit", "--given", "magnet.d"), ["magnet.depth="])
        self.assertIn("slip", self.offered("plot", "--quantity", "s"))

    def test_every_choice_is_one(self):
        """What the script offers for an option is not refused as an unknown word."""
        keys = [key for key in self.offered("run", "--set", "") if key.endswith("=")]
        choices = [(key, names) for key in keys if (names := self.offered("run", "--set", key))]
        self.assertGreater(len(choices), 4)
        for key, names in choices:
            for name in names:
                self.assertTrue(name.startswith(key))
                status, _, said = self.run_it("check", "--set", name)
                self.assertNotIn("unknown choice", said, name)
                self.assertIn(status, (0, 2))

    def test_files(self):
        for name in ("scene.yaml", "notes.txt", "map.db", "run.h5"):
            self.path(name)
            open(self.path(name), "w", encoding="utf-8").close()
        os.mkdir(self.path("folder"))
        self.assertEqual(set(self.offered("run", "")), {"scene.yaml", "folder"})
        self.assertEqual(set(self.offered("export", "")), {"map.db", "folder"})
        self.assertEqual(set(self.offered("plot", "")), {"map.db", "run.h5", "folder"})
        self.assertIn("notes.txt", self.offered("run", "-o", ""))
        self.assertIn("notes.txt", self.offered("run", "--output", "not"))

    def test_nothing_is_executed(self):
        """Names of files, and the words typed so far, are offered or ignored, and never evaluated."""
        folder = self.path("hostile")
        os.mkdir(folder)
        for name in HOSTILE:
            open(os.path.join(folder, name), "w", encoding="utf-8").close()
        self.assertEqual(set(self.offered("run", "", folder=folder)), set(HOSTILE))
        for typed in HOSTILE + ["$(touch pwned)/", "`touch pwned`", "--set=$(touch pwned)", "a[$(touch pwned)]"]:
            for words in (["run", typed], ["run", "--set", typed], ["run", "-o", typed], [typed], [typed, ""],
                          ["run", typed, "=", ""], ["run", "--set", typed, "=", typed]):
                self.offered(*words, folder=folder)
        self.assertEqual(set(os.listdir(folder)), set(HOSTILE))

    def test_wrong_words(self):
        for words in ([], ["tcsh"], ["bash", "zsh"]):
            status, out, said = self.run_it("completion", *words)
            self.assertEqual((status, out), (2, ""))
            self.assertIn("bash, zsh or fish", said)
        self.assertIn("source <(festoon completion bash)", self.good("completion", "--help"))

    def run_it(self, *words):
        done = subprocess.run([FESTOON, *words], capture_output=True, text=True, check=False)
        return done.returncode, done.stdout, done.stderr


class OtherShells(Case):
    def script(self, shell):
        path = self.path(f"festoon.{shell}")
        with open(path, "w", encoding="utf-8") as file:
            file.write(self.good("completion", shell))
        return path

    @unittest.skipUnless(shutil.which("fish"), "fish is not installed")
    def test_fish(self):
        script, environment = self.script("fish"), {**ENVIRONMENT, "HOME": self.directory}

        def offered(line):
            done = subprocess.run(["fish", "--no-config", "-c", "source $argv[1]; complete -C $argv[2]", script, line],
                                  capture_output=True, text=True, cwd=self.directory, env=environment, check=False)
            self.assertEqual((done.returncode, done.stderr), (0, ""))
            return {row.split("\t")[0] for row in done.stdout.splitlines()}

        self.assertIn("run", offered("festoon "))
        self.assertEqual(offered("festoon run --js"), {"--json"})
        self.assertEqual(offered("festoon run --set drive."), set(KEYS_OF_THE_DRIVE))
        self.assertEqual(offered("festoon run --set model.dynamics=f"), {"model.dynamics=farago2020"})
        self.assertEqual(offered("festoon branch --kind "), {"counter", "locked", "all", "levitating", "driven"})
        self.assertNotIn("--kind", offered("festoon run --"))
        for name in ("a b.yaml", "notes.txt"):
            open(self.path(name), "w", encoding="utf-8").close()
        os.mkdir(self.path("folder"))
        self.assertEqual(offered("festoon check "), {"a b.yaml", "folder/"})
        self.assertEqual(offered("festoon run --output=no"), {"--output=notes.txt"})

    @unittest.skipUnless(shutil.which("zsh"), "zsh is not installed")
    def test_zsh(self):
        """The script loads, and its function is bound to the program."""
        load = 'autoload -U compinit && compinit -D -u && source $1 && print -- $_comps[festoon]'
        done = subprocess.run(["zsh", "-f", "-c", load, "zsh", self.script("zsh")], capture_output=True, text=True,
                              env={**ENVIRONMENT, "HOME": self.directory}, check=False)
        self.assertEqual((done.returncode, done.stdout, done.stderr), (0, "_festoon\n", ""))


if __name__ == "__main__":
    unittest.main()
