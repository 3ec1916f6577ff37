"""Figures of parts of a sweep: one value of an axis, families of lines, and comparisons of both.

tests: draw/figure_sweep.c draw/figure_sweep_curves.c draw/figure_over.c"""

import os
import unittest

from sweep_tools import SHORT, festoon
from test_sweep_figures import Figures, words


class Slices(Figures):
    AXES = ("drive.frequency=9Hz:12Hz:4", "model.kappa=1,1.5", "bead.radius=2mm,2.5mm,3mm")

    def curves(self, blocks, panel):
        return [blocks[name] for name in sorted(blocks) if name.startswith(f"panel{panel}-curve")]

    def test_points_of_one_value_of_an_axis(self):
        """Curves, families and maps of a sweep over three axes are the rows that have the values asked for."""
        rows = self.sweep("t.db", *self.AXES)
        self.assertIn("--only KEY=VALUE", self.refused("plot", self.path("t.db"), "-o", self.path("f.svg")))
        for radius in (2, 2.5, 3):
            there = [row for row in rows if abs(float(row["bead.radius"]) - radius * 1e-3) < 1e-9]
            self.assertEqual(len(there), 8)
            wanted = {(float(row["drive.frequency"]), float(row["model.kappa"])): 23 * float(row["mean_r"]) for row in there}
            script, cells = self.cells("t.db", "--quantity", "mean_r", "--only", f"bead.radius={radius}mm")
            self.assertIn(f"at bead.radius {radius:g} mm", words(script))
            self.assertRegex(words(script), r"\b8 runs of \d+ turns of the magnet")
            self.assertEqual(len(cells), 8)
            for cell in cells:
                self.assertAlmostEqual(cell[6], wanted[round(cell[1], 6), round(cell[0], 6)], 4)
            script, blocks = self.plot("t.db", "--quantity", "mean_r", "--only", f"bead.radius={radius}mm")
            self.assertRegex(words(script), r"\b8 runs of \d+ turns of the magnet")  # of all curves
            for kappa, curve in zip((1, 1.5), self.curves(blocks, 1), strict=True):
                self.assertIn(f"model.kappa {kappa:g}", words(script))
                for x, y in curve:
                    self.assertAlmostEqual(y, wanted[round(x, 6), kappa], 4)
            # the regime has a panel where it is asked for, and points of one curve stand beside those of the other
            _, blocks = self.plot("t.db", "--quantity", "mean_r,regime", "--only", f"bead.radius={radius}mm")
            beside = [{round(y - round(y), 3) for _, y in curve} for curve in self.curves(blocks, 2) if len(curve) == 4]
            self.assertEqual(beside, [{-0.175}, {0.175}])
            self.assertFalse(any(name.startswith("panel4") for name in self.plot("t.db", "--only", f"bead.radius={radius}mm")[1]))
            _, blocks = self.plot("t.db", "--quantity", "mean_r", "--only", f"bead.radius={radius}mm", "--only", "model.kappa=1.5")
            self.assertEqual([round(y, 4) for _, y in self.curves(blocks, 1)[0]],
                             [round(wanted[f, 1.5], 4) for f in (9, 10, 11, 12)])

    def test_many_values_make_a_map_and_few_a_family(self):
        self.sweep("m.db", "model.kappa=1:2:8", "drive.frequency=9Hz:12Hz:8")
        self.assertIn("boxxyerror", self.plot("m.db", "--quantity", "mean_r")[0])
        self.assertEqual(len(self.curves(self.plot("m.db", "--quantity", "mean_r", "--kind", "curves")[1], 1)), 8)
        self.sweep("n.db", "model.kappa=1:2:9", "drive.frequency=9Hz:12Hz:9")
        self.assertIn("too many", self.refused("plot", self.path("n.db"), "--kind", "curves", "-o", self.path("f.svg")))

    def test_lines_follow_the_axis(self):
        """Also of a list, and of a random axis; a key is without the digits that rounding left."""
        for name, axis in (("r.db", "drive.frequency=9Hz:12Hz:random:5"), ("l.db", "drive.frequency=11,9,10,12,9.5")):
            rows = self.sweep(name, "bead.inertia=0.3:0.45:4", axis)
            script, blocks = self.plot(name, "--quantity", "mean_r")
            self.assertIn("bead.inertia 0.4 ", words(script) + " ")
            self.assertNotRegex(words(script), "9999|0000")
            for curve, inertia in zip(self.curves(blocks, 1), (0.3, 0.35, 0.4, 0.45), strict=True):
                wanted = sorted((float(row["drive.frequency"]), 23 * float(row["mean_r"])) for row in rows
                                if abs(float(row["bead.inertia"]) - inertia) < 1e-9)
                for (x, y), (f, r) in zip(curve, wanted, strict=True):
                    self.assertAlmostEqual(x, f, 4)
                    self.assertAlmostEqual(y, r, 4)

    def test_a_comparison_says_its_slice(self):
        self.sweep("a.db", *self.AXES[:1], self.AXES[2])
        self.sweep("b.db", *self.AXES[:1], self.AXES[2], "friction.law=rolling")
        self.sweep("c.db", *self.AXES[:1])
        for radius in ("2", "2.5"):  # the latter is as by default
            script = self.over("a.db", "b.db", "--only", f"bead.radius={radius}mm")[0]
            self.assertEqual(words(script).count(f"bead.radius {radius} mm"), 1, words(script))
        script = self.over("a.db", "c.db", "--only", "bead.radius=2mm")[0]
        for radius in ("2", "2.5"):
            self.assertIn(f"bead.radius {radius} mm", words(script))

    def test_how_long_runs_are(self):
        for settings, told in ((("run.periods=6", "run.discard=2"), "4 runs of 6 turns of the magnet"), (("run.duration=0.25s",), "4 runs of 0.25 s")):
            name = self.path(f"{len(settings)}.db")
            self.good("sweep", *[w for text in settings for w in ("--set", text)], "--over", "drive.frequency=9Hz:12Hz:4", "-o", name)
            self.assertIn(told, words(self.plot(f"{len(settings)}.db", "--quantity", "mean_r")[0]))

    def test_runs_that_all_end_without_a_value(self):
        self.good("sweep", *SHORT, "--set", "plate.radius=22mm", "--set", "model.kappa=0.05", "--over", "drive.frequency=14Hz:15Hz:3", "-o", self.path("e.db"))
        told = self.refused("plot", self.path("e.db"), "--quantity", "mean_r", "-o", self.path("e.svg"))
        self.assertIn("no point of the sweep has a value to draw, though all are done", told)
        self.good("plot", self.path("e.db"), "--quantity", "regime", "-o", self.path("e.svg"))

    def test_values_that_are_not_there(self):
        self.sweep("t.db", "model.kappa=1,1.5", "friction.law=viscous,rolling", "drive.frequency=9,10")
        plot = ("plot", self.path("t.db"), "-o", self.path("no.svg"), "--only")
        for at, told in (("model.kappa=1.4", "no points at model.kappa = 1.4; the nearest value is 1.5"),
                         ("friction.law=coulomb", "no points at friction.law = coulomb"), ("friction.law=dry", "friction.law"),
                         ("model.kapa=1", "the nearest is model.kappa"), ("start.r=0.95", "does not vary"),
                         ("model.kappa", "not KEY=VALUE"), ("model.kappa=x", "model.kappa")):
            self.assertIn(told, self.refused(*plot, at), at)
        self.assertIn("model.kappa is given twice", self.refused(*plot, "model.kappa=1", "--only", "model.kappa=1.5"))
        self.assertFalse(os.path.exists(self.path("no.svg")))
        script, _ = self.plot("t.db", "--only", "friction.law=rolling")
        self.assertIn("at friction.law rolling", words(script))


if __name__ == "__main__":
    unittest.main()
