"""What the program says: to a person on the screen, and as advice in its messages.

tests: cli/run_report.c cli/common.c io/shown.c"""

import os
import re
import unittest

from test_cli import SHORT, SOURCE_DIR, Case, festoon


class ForPeople(Case):
    """What a person reads on the screen."""

    def test_no_negative_zero(self):
        for words in (["locked"], ["locked", "--set", "friction.law=coulomb", "--set", "drive.frequency=3"],
                      ["field", "--at", "0,0"], ["field", "--at", "0.3,0"], ["field", "--at", "-10mm,0mm"],
                      ["run", "--set", "drive.frequency=3", *SHORT], ["orbit", "--set", "drive.omega=1"], ["check"],
                      ["branch", "--kind", "locked", "--over", "drive.frequency=3:4"],
                      ["lyapunov", "--set", "drive.frequency=3", *SHORT]):
            out = self.good(*words)
            self.assertIsNone(re.search(r"(?<![\w.])-0(\.0*)?(?![\w.])", out), f"{words}\n{out}")

    def test_locked_says_stable_or_not(self):
        for frequency in (3, 10.7):
            words = ["locked", "--set", f"drive.frequency={frequency}"]
            out = self.good(*words)
            told = re.findall(r"^ +\d.* (stable|unstable)$", out, re.M)
            states = self.json(*words)["states"]
            self.assertEqual([word == "stable" for word in told], [state["stable"] for state in states])
            self.assertEqual("None is stable" in out, not any(state["stable"] for state in states))

    def test_branch_tells_each_number_once(self):
        path = self.path("b.json")
        status, out, said = festoon("branch", "--kind", "locked", "--over", "drive.omega=0.06:0.11", "-o", path)
        self.assertEqual(status, 0, said)
        self.assertIn(f"wrote {path}", said)
        specials = re.findall(r"^  \S+ +drive\.omega = .*", out, re.M)
        self.assertTrue(specials, out)
        for line in specials:
            self.assertEqual(line.count("omega"), 1, line)
        out = self.good("branch", "--kind", "locked", "--over", "drive.frequency=3:5.5")
        self.assertRegex(out, r"drive\.frequency = [\d.]+ Hz  omega = [\d.]+ gamma  ")

    def test_field_in_tesla(self):
        """A moment and kappa tell B0; the derivative over the height is dB/dZ."""
        known = ["--set", "magnet.b0=40mT", "--set", "bead.moment=0.05"]
        si = self.json("field", "--at", "10mm,5mm", "--units", "si", *known)
        plain = self.json("field", "--at", "10mm,5mm", *known)
        self.assertNotIn("b_tesla", plain)
        self.assertEqual([si["b"], si["grad"]], [plain["b"], plain["grad"]])
        for k in range(3):
            self.assertAlmostEqual(si["b_tesla"][k], 0.04 * si["b"][k], delta=1e-15)
            for i in range(3):
                self.assertAlmostEqual(si["grad_tesla_per_m"][k][i], 0.04 / 0.023 * si["grad"][k][i], delta=1e-12)
        low, high = (self.json("field", "--at", "10mm,5mm", "--units", "si", "--height", h, *known)["b_tesla"]
                     for h in ("18.699mm", "18.701 mm"))
        for k in range(3):
            self.assertAlmostEqual((high[k] - low[k]) / 2e-6, si["grad_tesla_per_m"][k][2], delta=1e-5)
        text = self.good("field", "--at", "10mm,5mm", "--units", "lab", "--height", "20mm", *known)
        for part in ("20 mm over the magnet's mid-plane", "(mT)", "(mT/mm)", "B0 = 40 mT"):
            self.assertIn(part, text)
        si = self.json("field", "--at", "10mm,5mm", "--units", "si", "--height", "20mm", *known)
        rows = [[float(word) for word in re.findall(r"-?[\d.]+(?:e-?\d+)?", line[4:])] for line in text.splitlines()
                if re.match("[XYZ] ", line)]
        for row, field, slopes in zip(rows, si["b_tesla"], si["grad_tesla_per_m"], strict=True):
            for told, value in zip(row, [1e3 * field, *slopes], strict=True):  # 1 mT/mm is 1 T/m
                self.assertAlmostEqual(told / value, 1, 4)
        unknown = self.json("field", "--at", "0,0", "--units", "si")
        self.assertEqual([unknown["b_tesla"], unknown["grad_tesla_per_m"]], [[None] * 3, [[None] * 3] * 3])
        self.assertIn("give bead.moment or magnet.b0", self.good("field", "--at", "0,0", "--units", "si"))
        for height in ("0mm", "-1mm", "nan", "20 kg", ""):
            self.bad(["field", "--at", "0,0", "--height", height], "--height", "18.7mm")
        self.bad(["field", "--at", "0,0", "--quantity", "z"], "--quantity", "-o")

    def test_field_takes_lengths(self):
        self.assertEqual(self.json("field", "--at", "11.5mm,23 mm")["b"], self.json("field", "--at", "0.5,1")["b"])
        self.assertEqual(self.json("field", "--at", "1cm, -0.2")["b"], self.json("field", "--at", "10 mm,-0.2")["b"])
        self.assertIn("(10 mm, 5 mm)", self.good("field", "--at", "10mm,5mm"))


class Advice(Case):
    """The library speaks of functions; the program says the commands that a person types."""

    def test_commands_in_messages(self):
        scene = self.path("scene.yaml", "bead:\n  radios: 2.5 mm\n")
        for words in (("run", "--set", "bead.radios=1mm"), ("check", scene)):
            self.bad(words, "the nearest is bead.radius (festoon schema lists them all)")
        other = self.path("other.json", "{}")
        self.bad(("plot", other, "-o", self.path("f.svg")), "festoon branch -o FILE.json makes one")
        status, _, said = festoon("orbit", "--set", "drive.omega=0.02", "--set", "start.spin=rest")
        self.assertEqual(status, 1, said)
        self.assertIn("festoon locked lists the states", said)

    def test_the_library_names_no_command(self):
        """Of its strings only a document does: the comments of a scene."""
        names = re.findall(r"^  (\w+) ", self.good("--help"), re.M)
        self.assertIn("lyapunov", names)
        documents = ("src/cli/", "src/io/scene_text.c")
        for folder, _, files in os.walk(os.path.join(SOURCE_DIR, "src")):
            for name in files:
                path = os.path.join(folder, name)
                if os.path.relpath(path, SOURCE_DIR).startswith(documents) or not name.endswith((".c", ".h", ".inl", ".def")):
                    continue
                with open(path, encoding="utf-8") as file:
                    found = re.findall(r'"[^"\n]*\bfestoon (?:%s)\b[^"\n]*"' % "|".join(names), file.read())
                self.assertEqual(found, [], path)


if __name__ == "__main__":
    unittest.main()
