"""The shorter half of docs/tutorial.md is true, and what README.md shows of a run: the commands run and print what the
pages say.  (test_tutorial_long.py runs both pages.)

labels: numbers"""

import os
import pathlib
import re
import shutil
import tempfile
import unittest

import tutorial

SOURCE = pathlib.Path(os.environ["SOURCE_DIR"])
LONG_SECTIONS = ("The regimes", "A map, and a film")


def can_draw(command):
    return shutil.which("ffmpeg" if " movie " in command else "gnuplot") is not None


class Commands(unittest.TestCase):
    def do(self, steps):
        """Run the commands of a page in one folder."""
        self.assertTrue(steps)
        with tempfile.TemporaryDirectory(prefix="festoon-tutorial-") as folder:
            os.symlink(SOURCE / "examples", os.path.join(folder, "examples"))
            for command, lines in steps:
                if re.search("festoon (plot|movie) ", command) and not can_draw(command):
                    continue
                with self.subTest(command=command):
                    done = tutorial.run(os.environ["FESTOON"], command, folder)
                    self.assertEqual(done.returncode, 0, done.stderr)
                    printed = [line.strip() for line in done.stdout.splitlines()]
                    for line in lines:
                        self.assertIn(line.strip(), printed)
                    for target in re.findall(r" -o (\S+)", command):
                        self.assertGreater(os.path.getsize(os.path.join(folder, target)), 100)


class Pages(Commands):
    def test_half_of_the_tutorial(self):
        self.do([step for title, steps in tutorial.sections().items() if title not in LONG_SECTIONS for step in steps])

    def test_the_run_of_the_readme(self):
        steps = tutorial.sections(tutorial.README)["First minutes"]
        self.assertGreater(len(steps[0][1]), 4)
        self.do(steps[:1])

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
