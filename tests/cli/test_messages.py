"""Sentences about bad input: what a person reads when a word, an option or a file is not what a command takes.

tests: cli/file_kind.c cli/fields.c cli/help.c base/nearest.c host/components.c"""

import os
import re
import shutil
import subprocess
import unittest

from test_cli import SHORT, Case, festoon

# What is of the inside of the program, and helps nobody who uses it.
LEAKS = re.compile(r"\bfst_|/dev/fd|\(null\)|\bNULL\b|\bsrc/|__func__|0x[0-9a-f]{6}")

TRACK = "frame,t [s],x [mm],y [mm]\n" + "".join(f"{i},{i / 100},{i % 7},{i % 5}\n" for i in range(100))


class Words(Case):
    """An unknown word: the name that is near, or means the same; all names where none is near."""

    def test_synonyms(self):
        for key, word, meant in (("friction.law", "dry", "coulomb"), ("friction.law", "damping", "viscous"),
                                 ("friction.law", "Frictionless", "none"), ("friction.law", "columb", "coulomb"),
                                 ("friction.law", "visc", "viscous"), ("friction.law", "viscuos", "viscous"),
                                 ("model.dynamics", "exact", "rigid"), ("bead.material", "soft", "paramagnetic")):
            self.bad(["run", "--set", f"{key}={word}"], f"the nearest is {meant} ")

    def test_nothing_near(self):
        """The nearest by letters would be misleading: frictionless is not an xyz."""
        for word in ("xyz", "one-two", "q"):
            said = self.said("run", "--set", f"friction.law={word}")
            self.assertIn("choose one of viscous, none, coulomb, rolling", said)
            self.assertNotIn("nearest", said)

    def said(self, *words):
        status, out, said = festoon(*words)
        self.assertEqual((status, out), (2, ""), said)
        return said

    def test_options(self):
        """--threads is none of plot, and far from all of its options."""
        said = self.said("plot", "a.h5", "--threads", "3", "-o", "a.svg")
        self.assertNotIn("nearest", said)
        for name in ("--output", "--kind", "--points"):
            self.assertIn(name, said)
        self.assertIn("the nearest is --units", self.said("run", "--unit", "si"))
        self.assertIn("the nearest is movie", self.said("film"))
        self.assertIn("the nearest is run", self.said("simulate"))

    def test_a_name_by_its_end(self):
        path = self.path("s.db")
        self.good("sweep", *SHORT, "--over", "drive.frequency=9:10:2", "-o", path)
        self.bad(["export", path, "--csv", "--quantity", "r"], "--quantity: unknown key \"r\"; the nearest is mean_r")

    def test_a_unit_is_asked_for_by_its_option(self):
        self.bad(["measure", self.path("t.csv", "frame,x,y\n1,2,3\n2,3,4\n"), "--fps", "30"], "--scale")


class Files(Case):
    """Each kind of file, given to each command that does not take it, is called by its name."""

    def test_kinds(self):
        t, s, b, r, h = (self.path(name) for name in ("t.h5", "s.db", "b.json", "r.json", "rows.h5"))
        self.good("run", *SHORT, "--csv", self.path("t.csv"), "-o", t)
        self.good("sweep", *SHORT, "--over", "drive.frequency=9:10:2", "-o", s)
        self.good("branch", "--kind", "locked", "--over", "drive.omega=0.06:0.062", "-o", b)
        self.path("r.json", self.good("run", *SHORT, "--json"))
        self.path("rows.csv", self.good("export", s, "--csv"))
        self.good("init", self.path("scene.yaml"))
        kinds = {
            "t.h5": "this is a trajectory; festoon plot, movie, measure or fit --track reads it",
            "t.csv": "this is a trajectory; festoon plot, movie, measure or fit --track reads it",
            "s.db": "this is the database of a sweep; festoon plot, export, merge or sweep -o reads it",
            "b.json": "this is a branch; festoon plot reads it",
            "r.json": "this is a document of festoon run --json; festoon plot --runs reads it",
            "rows.csv": "this is what festoon export wrote of a sweep",
            "scene.yaml": "this is a scene; festoon run, ",
            "track.csv": "this is a track; festoon measure or fit --track reads it",
            "points.csv": "this is a table of measured points; festoon fit or plot --points reads it",
            "map.csv": "this is a map of a field",
            "film.mp4": "this is a film; festoon track reads it",
            "picture.png": "this is a picture",
            "empty": "this is an empty file",
        }
        self.path("track.csv", TRACK)
        self.path("points.csv", "frequency [Hz],mean_r [mm],mean_r_error [mm]\n10,17,0.1\n12,15,0.1\n")
        self.path("map.csv", "x [mm],y [mm],z [mm],Bx [mT],By [mT],Bz [mT]\n0,0,1,1,2,3\n")
        self.path("film.mp4", b"\0\0\0\x18ftypisom\0\0\0\0")
        self.path("picture.png", b"\x89PNG\r\n\x1a\n")
        self.path("empty", "")
        commands = {"run": [], "check": [], "plot": ["-o", self.path("o.svg")], "movie": ["-o", self.path("o.mp4")],
                    "export": ["--csv"], "measure": [], "track": ["-o", self.path("o.csv")],
                    "fit": ["--free", "model.kappa"], "fit --track": ["--free", "model.kappa"]}
        takers = {"t.h5": "plot movie measure fit--track", "s.db": "plot export", "b.json": "plot",
                  "scene.yaml": "run check fit", "track.csv": "measure fit--track", "points.csv": "fit",
                  "film.mp4": "track", "empty": "run check fit"}
        takers["t.csv"] = takers["t.h5"]
        for name, sentence in kinds.items():
            for command, options in commands.items():
                if command.replace(" ", "") not in takers.get(name, "").split():
                    self.bad([*command.split(), self.path(name), *options], f"{name}: {sentence}")

    def test_an_empty_scene_says_so(self):
        for text in ("", "# a comment\n\n   # and another\n"):
            status, _, said = festoon("check", self.path("scene.yaml", text))
            self.assertEqual(status, 0)
            self.assertIn("scene.yaml is an empty scene", said)
        self.assertEqual(festoon("check", self.path("scene.yaml", "bead:\n  a: 0\n"))[2], "")


class Leaks(Case):
    """No sentence about bad input speaks of what is inside the program."""

    def test_many_bad_inputs(self):
        s, t = self.path("s.db"), self.path("t.csv")
        self.good("sweep", *SHORT, "--over", "drive.frequency=9:10:2", "-o", s)
        self.good("run", *SHORT, "--csv", t)
        text = self.path("text", "words\n")
        bad = [["export", s, "--csv", "--quantity", "mean_rr"], ["export", s, "--json", "--quantity", "mean_r"],
               ["export", s, "--csv", "--units", "metre"], ["export", text, "--csv"], ["track", text, "-o", "o.csv"],
               ["plot", s, "--quantity", "bead.radius", "-o", "o.svg"], ["plot", s, "--quantity", "status", "-o", "o.svg"],
               ["plot", t, "--kind", "time", "--quantity", "q", "-o", "o.svg"], ["plot", t, "--quantity", "q", "-o", "o.svg"],
               ["plot", t, "--from", "99", "-o", "o.svg"], ["plot", t, "--zoom", "1,1,1,1", "-o", "o.svg"],
               ["plot", t, "-o", "o.xyz"], ["plot", text, "-o", "o.svg"], ["movie", t, "--fps", "0", "-o", "o.mp4"],
               ["movie", t, "--turn", "-1", "-o", "o.mp4"], ["movie", t, "--size", "1x1", "-o", "o.mp4"],
               ["movie", t, "--camera", "--exposure", "9s", "-o", "o.mp4"], ["movie", t, "-o", "o.xyz/q.mp4"],
               ["sweep", "--over", "friction.law=dry:wet:2", "-o", "q.db"], ["sweep", "--over", "q=1:2:3", "-o", "q.db"],
               ["sweep", "--over", "drive.frequency=9:8:0", "-o", "q.db"], ["sweep", "-o", "q.db"],
               ["sweep", "--over", "drive.frequency=9:10:2", "--lanes", "3", "-o", "q.db"],
               ["sweep", "--over", "drive.frequency=9:10:2", "--refine", "99", "-o", "q.db"],
               ["sweep", "--over", "drive.frequency=9:10:2", "--checkpoint", "-1", "-o", "q.db"],
               ["sweep", "--over", "drive.frequency=9:11:2", "-o", s], ["branch", "--kind", "all", "--over", "bead.radius=1"],
               ["branch", "--kind", "locked", "--over", "friction.law=1:2"],
               ["branch", "--kind", "locked", "--over", "drive.omega=0.06:0.07", "--step", "0"],
               ["branch", "--kind", "locked", "--over", "drive.omega=0.06:0.07", "--follow", "fold"],
               ["branch", "--kind", "locked", "--over", "drive.omega=0.06:0.07", "--follow", "fold", "--with",
                "drive.omega=1:2"], ["orbit", "--festoons", "-1"], ["orbit", "--festoons", "nan"],
               ["measure", t, "--drive", "0"], ["measure", t, "--scale", "0mm"], ["measure", t, "--format", "q"],
               ["measure", t, "--exposure", "9"], ["measure", t, "--fps", "-1"], ["measure", text],
               ["fit", t, "--free", "model.kappa"], ["fit", "--track", t, "--free", "q"],
               ["fit", "--track", t, "--free", "model.kappa", "--given", "model.kappa=1"],
               ["run", "--sample-rate", "0"], ["run", "--ramp", "1"], ["run", "-o", "o.xyz"], ["lab", "--set", "magnet.shape=grid"],
               ["run", "--set", "magnet.shape=grid"], ["run", "--set", f"magnet.file={text}", "--set", "magnet.shape=grid"],
               ["run", "--set", "model.banana=1"], ["run", "--set", "magnet.parts[0].size=1"], ["run", "--set", "bead.mass=0"],
               ["run", "--set", "start.r=99"], ["field", "--at", "x,y"], ["field", "--quantity", "z", "--radius", "0", "-o", "f.svg"],
               ["paper", "--only", "q"], ["export", "none.db", "--csv"], ["plot", "none.h5", "-o", "o.svg"],
               ["track", "none.mp4", "-o", "o.csv"], ["track", self.directory, "-o", "o.csv"], ["check", self.directory]]
        for words in bad:
            done = subprocess.run([os.environ["FESTOON"], *words], capture_output=True, text=True, cwd=self.directory,
                                  stdin=subprocess.DEVNULL, timeout=60)
            self.assertIn(done.returncode, (1, 2), (words, done.stderr))
            self.assertRegex(done.stderr, r"(?m)^festoon: [^\n]+\n\Z", words)
            self.assertIsNone(LEAKS.search(done.stderr), (words, done.stderr))


class Help(Case):
    """The help of each command: nothing of an option's text begins where options do, no line is too long."""

    def test_options_wrap_below_their_texts(self):
        names = re.findall(r"^  (\w+) ", self.good("--help"), re.M)
        self.assertIn("branch", names)
        for name in names:
            head, _, options = self.good(name, "--help").partition("\noptions:\n")
            for line in options.splitlines():
                self.assertRegex(line, r"^(  -\w, --|   --|  {29}|$|expert:$)", name)
            for line in (*options.splitlines(), *head.splitlines()[:2]):
                self.assertLessEqual(len(line), 112, name)


class Version(Case):
    """--version says what works on this machine."""

    def test_a_module_without_its_library(self):
        """A module is there; the library that it needs is not."""
        status, out, _ = festoon("--version")
        self.assertEqual(status, 0)
        if "mpi yes" not in out:
            self.skipTest("no MPI here")
        folder = self.path("lib")
        os.mkdir(folder)
        build = os.environ["BUILD_DIR"]
        for name in ("festoon", "libfestoon.so", "libfestoon-tools.so"):
            for file in os.listdir(build):
                if file == name or file.startswith(name + "."):
                    shutil.copy(os.path.join(build, file), folder)
        with open(os.path.join(build, "festoon-mpi.so"), "rb") as module:
            content = module.read()
        library = re.search(rb"libmpi\.so\.\d+", content).group(0)
        gone = library.replace(b"libmpi", b"libgon")
        with open(os.path.join(folder, "festoon-mpi.so"), "wb") as module:
            module.write(content.replace(library, gone))
        out = subprocess.run([os.path.join(folder, "festoon"), "--version"], capture_output=True, text=True).stdout
        self.assertIn(f"mpi no ({gone.decode()} is not on this machine", out)
        self.assertIn("hdf5 no (install libhdf5-dev", out)


if __name__ == "__main__":
    unittest.main()
