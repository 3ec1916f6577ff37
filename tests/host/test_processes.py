"""The programs that festoon starts: the signals that they inherit, and their leftovers when they fail.

tests: host/process.c io/ffmpeg.c cli/terminal.c"""

import os
import signal
import subprocess
import unittest

from sweep_tools import FESTOON, Case, content_of

RUN = ["--set", "run.periods=3", "--set", "run.discard=1", "--set", "run.samples=32"]


class Processes(Case):
    def setUp(self):
        super().setUp()
        self.tools = self.path("tools")
        os.mkdir(self.tools)
        self.good("run", *RUN, "-o", self.path("t.csv"))

    def pretend(self, name, *lines):
        """Makes a program of this name that does what the lines of a shell script say."""
        path = os.path.join(self.tools, name)
        with open(path, "w", encoding="utf-8") as file:
            file.write("\n".join(("#!/bin/sh", *lines)) + "\n")
        os.chmod(path, 0o755)

    def festoon(self, *words):
        """Status and messages of festoon, which finds the pretended programs first."""
        environment = {**os.environ, "PATH": self.tools + os.pathsep + os.environ["PATH"]}
        done = subprocess.run([FESTOON, *words], env=environment, stdin=subprocess.DEVNULL, capture_output=True,
                              text=True, timeout=300, check=False)
        return done.returncode, done.stderr

    def leftovers(self):
        """The names of temporary files in the folder."""
        return [name for name in os.listdir(self.directory) if ".part" in name]

    def test_no_signal_is_ignored_or_blocked(self):
        """festoon ignores SIGPIPE, but a program that it starts must not: it would go on writing to nobody."""
        for name, words in (("gnuplot", ("plot", self.path("t.csv"), "-o", self.path("f.svg"))),
                            ("ffmpeg", ("movie", self.path("t.csv"), "-o", self.path("f.mp4")))):
            noted = self.path(name + ".signals")
            self.pretend(name, f"grep -E 'SigIgn|SigBlk' /proc/self/status > {noted}", "cat > /dev/null", "exit 1")
            status, words = self.festoon(*words)
            if not os.path.exists(noted):
                self.assertIn("cannot paint films", words)  # this build has no Cairo
                continue
            self.assertEqual(status, 1, words)
            for line in content_of(noted, "r").splitlines():
                mask = int(line.split()[1], 16)
                for number in (signal.SIGPIPE, signal.SIGTERM, signal.SIGINT):
                    self.assertEqual(mask >> (number - 1) & 1, 0, f"{name}: {line}")

    def test_a_film_that_failed(self):
        """ffmpeg writes something, complains and fails: status 1 with its words, and the old film stays."""
        self.pretend("ffmpeg", "cat > /dev/null", 'for last; do :; done; echo film > "${last#file:}"',
                     "echo 'no such codec' >&2", "exit 1")
        with open(self.path("f.mp4"), "w", encoding="utf-8") as file:
            file.write("old")
        status, words = self.festoon("movie", self.path("t.csv"), "-o", self.path("f.mp4"))
        if "cannot paint films" in words:
            self.skipTest("built without Cairo")
        self.assertEqual(status, 1, words)
        self.assertIn("no such codec", words)
        self.assertEqual(content_of(self.path("f.mp4"), "r"), "old")
        self.assertEqual(self.leftovers(), [])

    def test_a_figure_that_failed(self):
        """The same for gnuplot."""
        self.pretend("gnuplot", "echo 'line 3: undefined' >&2", "exit 1")
        with open(self.path("f.svg"), "w", encoding="utf-8") as file:
            file.write("old")
        status, words = self.festoon("plot", self.path("t.csv"), "-o", self.path("f.svg"))
        self.assertEqual(status, 1, words)
        self.assertIn("undefined", words)
        self.assertEqual(content_of(self.path("f.svg"), "r"), "old")
        self.assertEqual(self.leftovers(), [])

    def test_a_caller_without_streams(self):
        """A pipe to gnuplot must not take the number of a standard stream that the caller closed: the figure is
        drawn."""
        for closed in (">&-", "<&- >&- 2>&-"):
            with self.subTest(closed=closed):
                figure = self.path("f.svg")
                if os.path.exists(figure):
                    os.unlink(figure)
                command = f'"$0" plot "$1" -o "$2" {closed}'
                done = subprocess.run(["sh", "-c", command, FESTOON, self.path("t.csv"), figure], timeout=300, check=False)
                self.assertEqual(done.returncode, 0)
                self.assertIn("</svg>", content_of(figure, "r"))


if __name__ == "__main__":
    unittest.main()
