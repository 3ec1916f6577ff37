"""examples/magnets: every scene checks and runs as its comment says, the map is what its maker writes, and the field of
the bar is that of its charged ends, summed here.

labels: numbers"""

import importlib.util
import json
import math
import os
import pathlib
import re
import subprocess
import sys
import unittest

FESTOON = os.environ["FESTOON"]
SOURCE = pathlib.Path(os.environ["SOURCE_DIR"])
MAGNETS = SOURCE / "examples" / "magnets"
SCENES = sorted(path.name for path in MAGNETS.glob("*.yaml"))
FEW = ["--set", "run.periods=12", "--set", "run.discard=6"]

sys.dont_write_bytecode = True
maker_at = importlib.util.spec_from_file_location("measured_map", MAGNETS / "measured-map.py")
maker = importlib.util.module_from_spec(maker_at)
maker_at.loader.exec_module(maker)


def festoon(*arguments):
    return subprocess.run([FESTOON, *arguments], capture_output=True, text=True, cwd=SOURCE, check=False)


def answer(*arguments):
    done = festoon(*arguments, "--json")
    if done.returncode != 0:
        raise AssertionError(done.stderr)
    return json.loads(done.stdout)


class Scenes(unittest.TestCase):
    def test_each_checks_and_runs(self):
        self.assertGreaterEqual(len(SCENES), 10)
        for scene in SCENES:
            with self.subTest(scene=scene):
                path = f"examples/magnets/{scene}"
                self.assertIn(f"#   festoon run {path}\n", (MAGNETS / scene).read_text())
                self.assertEqual(festoon("check", path).returncode, 0)
                result = answer("run", path, *FEW)
                if result["regime"] not in ("ejected", "lifted"):
                    self.assertGreater(result["mean_r"], 0)

    def test_each_is_on_the_page_with_its_command(self):
        page = (SOURCE / "docs" / "magnets-gallery.md").read_text()
        for scene in SCENES:
            self.assertIn(f"festoon run examples/magnets/{scene}", page)
        for name in re.findall(r"festoon run examples/magnets/(\S+)", page):
            self.assertIn(name, SCENES)
        for picture in re.findall(r"\]\((images/[^)]+)\)", page):
            self.assertTrue((SOURCE / "docs" / picture).exists(), picture)

    def test_four_poles_have_no_opposite_half_turn(self):
        """Half a turn leaves the cross as it is: S2 is not a symmetry of its field. Discs of opposite polarity have it."""
        for scene, sign in (("cross", 1), ("discs-opposite-hard", -1), ("discs-same-hard", 1), ("halbach", -1)):
            here, there = (answer("field", f"examples/magnets/{scene}.yaml", "--at", at)["b"]
                           for at in ("0.31,0.17", "-0.31,-0.17"))
            self.assertAlmostEqual(there[2], sign * here[2], delta=1e-9 * abs(here[2]), msg=scene)
            self.assertAlmostEqual(there[0], -sign * here[0], delta=1e-9 * abs(here[0]), msg=scene)


class Fields(unittest.TestCase):
    def test_the_map_is_what_its_maker_writes(self):
        made = subprocess.run([sys.executable, "-B", str(MAGNETS / "measured-map.py")], capture_output=True, text=True,
                              check=True).stdout
        self.assertEqual(made.splitlines(), (MAGNETS / "measured-map.csv").read_text().splitlines())

    def test_the_map_tells_the_field_between_its_points(self):
        """At a place between the points of the grid: the maker's own field there, within the probe's noise."""
        x, y = 16.4, -4.7
        shown = answer("field", "examples/magnets/measured-map.yaml", "--at", f"{x}mm,{y}mm", "--units", "si")
        expected = maker.field(maker.charges(), x, y, maker.HEIGHT)
        for value, mt in zip(shown["b_tesla"], expected):
            self.assertAlmostEqual(1e3 * value, mt, delta=4 * maker.NOISE)

    def test_the_bar_is_two_charged_ends(self):
        """|B| at the bead's centre by Gauss's rule over both ends, and the maxima 53 mm apart, not 41."""
        rule = maker.gauss(20)
        ends = [(28.0 * end, 20.0 * u, 4.5 * w, end * 567.0 * 20.0 * 4.5 * wu * ww / (4 * math.pi))
                for end in (1, -1) for u, wu in rule for w, ww in rule]
        for x, y in ((26.5, 0.0), (3.0, 17.0), (-31.0, -24.0)):
            shown = answer("field", "examples/magnets/stirrer-bar.yaml", "--at", f"{x}mm,{y}mm", "--units", "si")
            for value, mt in zip(shown["b_tesla"], maker.field(ends, x, y, 18.7)):
                self.assertAlmostEqual(1e3 * value, mt, delta=1e-9 * 30)
        said = subprocess.run([sys.executable, "-B", str(MAGNETS / "which-magnet.py"), "--field", "bar"], text=True,
                              capture_output=True, check=True).stdout
        apart = float(re.search(r"maxima ([0-9.]+) mm apart", said).group(1))
        place = max((math.hypot(*maker.field(ends, x / 100, 0.0, 18.7)), x / 100) for x in range(2600, 2720))[1]
        self.assertAlmostEqual(apart, 2 * place, delta=0.06)
        self.assertGreater(apart, 53.0)


if __name__ == "__main__":
    unittest.main()
