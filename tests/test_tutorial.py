"""The shorter half of docs/tutorial.md is true: its commands run and print what it says.  (test_tutorial_long.py runs
the whole page.)

Environment: FESTOON is the program, SOURCE_DIR the source tree.
"""

import os
import pathlib
import re
import shutil
import tempfile
import unittest

import tutorial

SOURCE = pathlib.Path(os.environ["SOURCE_DIR"])
LONG_SECTIONS = ("The regimes", "A map, and a film")


class Page(unittest.TestCase):
    titles = [title for title in tutorial.sections() if title not in LONG_SECTIONS]

    def test_commands_print_what_the_page_says(self):
        steps = tutorial.sections()
        with tempfile.TemporaryDirectory(prefix="festoon-tutorial-") as folder:
            for command, lines in (step for title in self.titles for step in steps[title]):
                if re.match(r"festoon (plot|movie)", command) and not self.can_draw(command):
                    continue
                with self.subTest(command=command):
                    done = tutorial.run(os.environ["FESTOON"], command, folder)
                    self.assertEqual(done.returncode, 0, done.stderr)
                    printed = [line.strip() for line in done.stdout.splitlines()]
                    for line in lines:
                        self.assertIn(line.strip(), printed)
                    for target in re.findall(r" -o (\S+)", command):
                        self.assertGreater(os.path.getsize(os.path.join(folder, target)), 100)

    @staticmethod
    def can_draw(command):
        return shutil.which("ffmpeg" if " movie " in command else "gnuplot") is not None

    def test_every_picture_is_there_and_small(self):
        """Each is made by a command of the page, and all together are less than 600 kB."""
        made = {name for steps in tutorial.sections().values() for command, _ in steps
                for name in re.findall(r"plot .*-o (\w+)\.png", command)}
        shown = tutorial.pictures()
        self.assertEqual(set(shown) - made, set())
        self.assertGreater(len(shown), 7)
        files = {path.stem.removeprefix("tutorial-"): path.stat().st_size
                 for path in (SOURCE / "docs" / "images").glob("tutorial-*.png")}
        self.assertEqual(set(files), set(shown))
        self.assertLess(sum(files.values()), 600000)

    def test_every_regime_is_named(self):
        page = tutorial.text()
        for regime in "locked librating counter-rotating corotating chaotic ejected lifted undecided".split():
            self.assertIn(regime, page)


if __name__ == "__main__":
    unittest.main()
