"""`festoon lab`: the address of the page with a scene, and what a desktop is asked to open.

The program and its libraries are copied into a folder with a strange name, with a page beside them or in share.
Environment: FESTOON, SOURCE_DIR, BUILD_DIR.

tests: cli/lab.c host/lab_page.c"""

import html
import os
import pathlib
import re
import shutil
import subprocess
import tempfile
import time
import unittest
import urllib.parse

import events

BUILD = pathlib.Path(os.environ["BUILD_DIR"])
HEADER = pathlib.Path(os.environ["SOURCE_DIR"], "include", "festoon", "festoon.h").read_text()
VERSION = subprocess.run([os.environ["FESTOON"], "--version"], capture_output=True, text=True, check=True).stdout.split("\n")[0]
STAMP = f'<meta name="generator" content="{VERSION}, results version {re.search("FST_RESULTS_VERSION ([0-9]+)", HEADER)[1]}">'


class Lab(unittest.TestCase):
    def setUp(self):
        holder = tempfile.TemporaryDirectory(prefix="festoon-lab-")
        self.addCleanup(holder.cleanup)
        self.top = pathlib.Path(os.path.realpath(holder.name)) / "a b#c&'<é>"
        self.folder = self.top / "lib"
        self.folder.mkdir(parents=True)
        for path in [pathlib.Path(os.environ["FESTOON"]), *BUILD.glob("libfestoon*.so*")]:
            shutil.copy2(path, self.folder / path.name, follow_symlinks=False)
        self.page = self.folder / "festoon-lab.html"

    def run_lab(self, *words, **variables):
        environment = {key: value for key, value in os.environ.items() if key not in ("DISPLAY", "WAYLAND_DISPLAY")}
        return subprocess.run([self.folder / "festoon", "lab", *words], capture_output=True, text=True, check=False,
                              timeout=events.HANG, env={**environment, **variables})

    def address(self, *words):
        done = self.run_lab("--print", *words)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        return done.stdout.rstrip("\n")

    def test_no_page(self):
        done = self.run_lab()
        self.assertEqual((done.returncode, done.stdout), (1, ""))
        self.assertIn("make lab", done.stderr)

    def test_old_page(self):
        """A page of other results would show other numbers than the program."""
        self.page.write_text(re.sub("version [0-9]+", "version 1", STAMP))
        done = self.run_lab()
        self.assertEqual((done.returncode, done.stdout), (1, ""))
        self.assertIn("another version", done.stderr)

    def test_address(self):
        """The path comes back from the address, and the scene has what differs from the default, and nothing else."""
        self.page.write_text(STAMP)
        words = ("--set", "drive.frequency=642 rpm", "--set", "friction.law=coulomb", "--set", "start.phi=-12.5")
        path, _, fragment = self.address(*words).partition("#")
        self.assertRegex(path, r"^file://[\w/.~%-]*$")
        self.assertEqual(urllib.parse.unquote(path), f"file://{self.page}")
        self.assertEqual(dict(urllib.parse.parse_qsl(fragment)),
                         {"v": "1", "friction.law": "coulomb", "start.phi": "-12.5"})
        self.assertTrue(self.address().endswith("#v=1"))
        self.assertTrue(self.address("--set", "drive.omega=0.25").endswith("#v=1&drive.omega=0.25"))

    def test_installed_page(self):
        """Beside lib, and beside a folder of an architecture in it."""
        for up in (self.top, self.top.parent):
            page = up / "share" / "festoon" / "festoon-lab.html"
            page.parent.mkdir(parents=True)
            page.write_text(STAMP)
            self.assertIn(urllib.parse.quote(str(page)), self.address())
            page.unlink()

    def test_bad_scene(self):
        self.page.write_text(STAMP)
        done = self.run_lab("--set", "drive.freqency=3")
        self.assertEqual((done.returncode, done.stdout), (2, ""))
        self.assertIn("drive.frequency", done.stderr)

    def test_no_desktop(self):
        self.page.write_text(STAMP)
        for variables in ({}, {"DISPLAY": ":9", "PATH": str(self.top), "XDG_RUNTIME_DIR": str(self.top)}):
            done = self.run_lab(**variables)
            self.assertEqual(done.returncode, 0)
            self.assertIn("no desktop", done.stderr)
            self.assertTrue(done.stdout.startswith("file://"))
        self.assertEqual(list(self.top.glob("*.html")), [], "nothing is left where nothing could be opened")

    def test_desktop(self):
        """xdg-open gets a page that leads to the address, because it would drop what stands behind "#"."""
        self.page.write_text(STAMP)
        opener, asked = self.top / "bin" / "xdg-open", self.top / "asked"
        opener.parent.mkdir()
        opener.write_text('#!/bin/sh\nprintf "%s" "$1" > "$ASKED.part"\nmv "$ASKED.part" "$ASKED"\n')
        opener.chmod(0o755)
        words = ("--set", "drive.frequency=12", "--set", "friction.law=rolling")
        done = self.run_lab(*words, DISPLAY=":9", PATH=f"{opener.parent}:{os.environ['PATH']}", ASKED=str(asked),
                            XDG_RUNTIME_DIR=str(self.top))
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        deadline = time.monotonic() + events.HANG
        while not asked.exists() and time.monotonic() < deadline:
            time.sleep(0.01)
        way = pathlib.Path(asked.read_text())
        self.assertEqual(way.parent, self.top)
        self.assertEqual(way.stat().st_mode & 0o777, 0o600)
        target = re.search(r'content="0;url=([^"]*)"', way.read_text())[1]
        self.assertEqual(html.unescape(target), self.address(*words))
        self.assertEqual(done.stdout.rstrip("\n"), self.address(*words))


if __name__ == "__main__":
    unittest.main()
