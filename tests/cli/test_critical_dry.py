"""`festoon critical` under dry friction, where outcomes alternate about the border.

tests: sweep/critical.c
labels: numbers"""

import json
import tempfile
import unittest

from sweep_tools import festoon

ROLLS = """bead: {radius: 1.8 mm, density: 7450 kg/m^3, remanence: 1.15 T}
friction: {gamma: 260 1/s, law: coulomb, mu: 0.22}
run: {periods: 60, discard: 30}
magnet:
  shape: parts
  depth: 13 mm
  parts: [{kind: cuboid, centre: [0, 0, 0], size: [44 mm, 24 mm, 7 mm], remanence: [0.9 T, 0, 0]}]
"""


class Critical(unittest.TestCase):
    def test_dry_friction_is_enclosed_by_runs_which_alternate(self):
        """Each border lies between runs of `run` itself that differ; above the speed none does anything else."""
        status, out, err = festoon("critical", "--set", "friction.law=coulomb", "--over", "drive.frequency=7Hz:11Hz:5", "--tolerance", "0.05",
                                   "--json")
        self.assertEqual(status, 0, err)
        found = json.loads(out)
        self.assertIsNone(found["special"])
        self.assertEqual(found["above"], "counter-rotating")
        self.assertLess(found["parting"] + found["parting_error"], found["value"] - found["error"])
        for at, goes in ((found["parting"] - 1.1 * found["parting_error"], True), (found["parting"] + 1.1 * found["parting_error"], False)):
            run = json.loads(festoon("run", "--set", "friction.law=coulomb", "--set", f"drive.frequency={at:.17g}", "--json")[1])
            self.assertEqual(run["regime"] in ("locked", "librating", "corotating"), goes, run["regime"])
        for stretch in found["stretches"]:
            if stretch["to"] > found["value"] + found["error"]:
                self.assertIn(stretch["regime"], ("counter-rotating", "undecided"))
            if stretch["regime"] == "counter-rotating" and stretch["from"] < found["value"]:
                self.assertGreaterEqual(stretch["from"], found["value"] - found["error"] * (1 + 1e-9))

    def test_the_first_runs_that_alternate_belong_to_the_error(self):
        """At 10.75 Hz the bead circles against the magnet, at 10.5 Hz and 11 Hz it is thrown out."""
        scene = tempfile.NamedTemporaryFile("w", suffix=".yaml")
        self.addCleanup(scene.close)
        scene.write("bead: {radius: 3 mm, density: 7.5 g/cm^3}\nmodel: {kappa: 1.04}\n")
        scene.flush()
        status, out, err = festoon("critical", scene.name, "--set", "friction.law=coulomb", "--set", "friction.mu=0.1", "--set", "run.rtol=1e-8",
                                   "--over", "drive.frequency=10.25Hz:12.5Hz:10", "--tolerance", "0.02", "--json")
        self.assertEqual(status, 0, err)
        found = json.loads(out)
        outcomes = [(row["regime"], row["from"]) for row in found["stretches"]]
        self.assertEqual(outcomes[:3], [("ejected", 10.25), ("counter-rotating", 10.75), ("ejected", 11.0)])
        self.assertAlmostEqual(found["value"] - found["error"], 10.5, delta=1e-12)

    def test_undecided_runs_are_told(self):
        """At 17.5 Hz the bead rolls near the axis for ever, which stays undecided; at 18 Hz it circles against the magnet."""
        scene = tempfile.NamedTemporaryFile("w", suffix=".yaml")
        self.addCleanup(scene.close)
        scene.write(ROLLS)
        scene.flush()
        status, out, err = festoon("critical", scene.name, "--over", "drive.frequency=16Hz:18.5Hz:6", "--tolerance", "0.09")
        self.assertEqual(status, 0, err)
        self.assertIn("from it on, up to 17 Hz, counter-rotating; undecided runs from 17.5 to 17.5 Hz: 1\n", out)


if __name__ == "__main__":
    unittest.main()
