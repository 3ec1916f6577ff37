"""`festoon critical`: the border of runs is the special point of the branch; where there is none, and bad input.

tests: sweep/critical.c cli/critical.c
labels: slow numbers"""

import json
import math
import re
import tempfile
import unittest

from sweep_tools import festoon

FEW = ["--over", "drive.frequency=8.5Hz:10Hz:4", "--tolerance", "1e-3"]

MAGNET = """bead: {radius: 2.5 mm, density: 7.5 g/cm^3, remanence: 1.2 T}
magnet:
  shape: parts
  depth: 15 mm
  parts:
    - {kind: cuboid, centre: [15 mm, 0, -6 mm], size: [20 mm, 15 mm, 10 mm], remanence: [0, 0, 1.1 T]}
    - {kind: cuboid, centre: [-15 mm, 0, -6 mm], size: [20 mm, 15 mm, 10 mm], remanence: [0, 0, -1.1 T]}
    - {kind: cylinder, centre: [0, 16 mm, -6 mm], size: [12 mm, 8 mm], remanence: [0, 0, 0.3 T]}
"""


def critical(*words):
    status, out, err = festoon("critical", *words, "--json")
    assert status == 0, err
    return json.loads(out)


class Critical(unittest.TestCase):
    def test_the_border_is_the_crossing_of_the_branch(self):
        found = critical(*FEW)
        branch = json.loads(festoon("branch", "--kind", "counter", "--over", "drive.frequency=8.5Hz:10Hz", "--json")[1])
        (crossing,) = [point["value"] for point in branch["specials"] if point["type"] == "origin-crossing"]
        self.assertEqual((found["special"], found["below"], found["above"]), ("origin-crossing", "librating", "counter-rotating"))
        self.assertLess(abs(found["value"] - crossing), found["error"])
        self.assertLess(found["error"], 1e-8)
        self.assertEqual((found["parting"], found["parting_error"]), (found["value"], found["error"]))
        self.assertEqual(found["until"], found["stretches"][-1]["to"])
        self.assertIn("from it on counter-rotating\n", festoon("critical", *FEW[:-1], "0.09")[1])
        below, above = found["stretches"]  # the runs alone enclose it as tightly as asked
        self.assertTrue(below["to"] < crossing < above["from"] and above["from"] - below["to"] < 1e-3 * crossing)
        self.assertEqual(found["runs"], below["runs"] + above["runs"])
        scaled = critical("--set", "drive.omega=0.3", "--over", "drive.omega=0.17:0.2:4", "--tolerance", "0.05")
        self.assertNotIn("value_hz", scaled)
        gamma = scaled["scene"]["friction.gamma"]
        self.assertLess(abs(scaled["value"] * gamma / (2 * 3.141592653589793) - crossing), 1e-8)

    def test_units(self):
        gamma, few = 312.5, ["--tolerance", "0.05", "--set", "run.periods=120", "--set", "run.discard=60"]
        speeds = [*few, "--set", "drive.omega=0.3", "--over", "drive.omega=0.17:0.2:4"]
        frequencies = [*few, "--over", "drive.frequency=8.4551064Hz:9.9471839Hz:4"]
        for words, units, unit, hertz in ((speeds, "lab", "Hz", 1), (speeds, "si", "rad/s", 1 / (2 * math.pi)),
                                          (speeds, "given", "gamma", gamma / (2 * math.pi)),
                                          (frequencies, "si", "Hz", 1), (frequencies, "scaled", "gamma", gamma / (2 * math.pi))):
            out = festoon("critical", *words, "--units", units)[1]
            found = re.search(r"critical speed: (\S+) \+- \S+ (Hz|gamma|rad/s)(.*)\n(?:.*\n)+?  (\S+) +to +\S+ +\2 ", out)
            self.assertEqual((found[2], "turns a minute" in found[3]), (unit, unit == "Hz"), out)
            self.assertAlmostEqual(float(found[1]) * hertz, 8.8973163, 6)
            self.assertAlmostEqual(float(found[4]) * hertz, 8.4551064, 5)
        told = critical(*speeds, "--units", "lab")
        for row, keys in ((told, ("value", "error", "until", "parting", "parting_error")), (told["stretches"][0], ("from", "to"))):
            for key in keys:
                self.assertAlmostEqual(row[key + "_hz"], row[key] * gamma / (2 * math.pi), 12)
        told = critical(*frequencies, "--units", "si")
        self.assertEqual((told["value_hz"], told["stretches"][1]["to_hz"]), (told["value"], told["stretches"][1]["to"]))

    def test_up_to_where(self):
        """Over two blocks and a cylinder the bead circles against the magnet from 8.6 Hz to 12 Hz only."""
        file = tempfile.NamedTemporaryFile("w", suffix=".yaml")
        self.addCleanup(file.close)
        file.write(MAGNET)
        file.flush()
        words = (file.name, "--set", "run.periods=120", "--set", "run.discard=60", "--tolerance", "0.09",
                 "--over", "drive.frequency=7Hz:16Hz:4")
        status, out, _ = festoon("critical", *words)
        found = critical(*words)
        last = [i for i, row in enumerate(found["stretches"]) if row["regime"] == "counter-rotating"][0]
        until, others = found["stretches"][last]["to"], found["stretches"][last + 1]["from"]
        self.assertEqual((status, found["until"]), (0, until))
        self.assertLess(until, found["stretches"][-1]["to"])
        self.assertIn(f"from it on, up to {until:g} Hz, counter-rotating; other outcomes from {others:g} Hz\n", out)

    def test_none(self):
        for words, said in ((["--over", "drive.frequency=10Hz:12Hz:3"], "at the lowest speed already"),
                            (["--over", "drive.frequency=4Hz:6Hz:3"], "no bead circles against the magnet"),
                            (["--set", "run.periods=4", "--set", "run.discard=1", "--over", "drive.frequency=8Hz:12Hz:5"],
                             "all runs below those that circle against the magnet are undecided"),
                            (["--over", "drive.frequency=9Hz:9.5Hz:2"], "not for another tenth of the speed"),
                            (["--over", "drive.frequency=8Hz:9.1Hz:3", "--tolerance", "0.05"], "not for another tenth of the speed")):
            told = critical(*words)
            self.assertEqual((told["value"], told["found"], told["below"]), (None, False, None))
            self.assertIn(said, told["reason"])
        status, out, _ = festoon("critical", *words)  # the last of them
        self.assertEqual(status, 0)
        self.assertIn(told["reason"], out)

    def test_bad_input(self):
        for words, said in ((["--over", "magnet.depth=1cm:2cm:3"], "drive.frequency or drive.omega"),
                            (["--over", "drive.frequency=8Hz,9Hz"], "LO:HI:COUNT"),
                            (["--tolerance", "0"], "1e-9 to 0.1"), (["--tolerance", "x"], "--tolerance"),
                            (["--set", "plate.shape=none"], "one bead on a flat plate"),
                            (["--set", "beads[0].start.r=0.5", "--set", "beads[1].start.r=0.9"], "one bead on a flat plate")):
            status, out, err = festoon("critical", *words)
            self.assertEqual((status, out), (2, ""), f"{words} {err}")
            self.assertIn(said, err)


if __name__ == "__main__":
    unittest.main()
