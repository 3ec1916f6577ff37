"""Figures of sweeps: positions, units and scales of what is drawn, read from the data beside the figure.

tests: draw/figure_sweep.c draw/figure_sweep_axes.c draw/figure_sweep_curves.c draw/figure_sweep_map.c
  draw/quantity.c draw/figure_over.c draw/charts_over.c draw/caption.c sweep/table.c"""

import csv
import io
import json
import math
import os
import re
import shutil
import signal
import sys
import unittest

import events
from sweep_tools import FESTOON, SHORT, Case, change, content_of, festoon

GAMMA, HALF_LENGTH = 312.5, 23e-3


def words(script):
    """All texts of a figure in their order; a text that takes several lines is one again."""
    return " ".join(re.findall(r"set label '(.*?)' at ", script))


class Figures(Case):
    def sweep(self, name, *over):
        axes = [word for axis in over for word in ("--over", axis)]
        self.good("sweep", *SHORT, *axes, "-o", self.path(name))
        return list(csv.DictReader(io.StringIO(self.rows(name))))

    def plot(self, name, *options):
        """The script and the data blocks, {name: [[number]]}; signs at the edges of panels are in self.signs, [(block, words,
        [[number]])]."""
        self.good("plot", self.path(name), *options, "-o", self.path("figure.svg"))
        self.assertIn("<svg", content_of(self.path("figure.svg"), "r")[:2000])
        return self.figure()

    def figure(self):
        blocks, script = {}, content_of(self.path("figure.gp"), "r")
        edges, self.signs = re.findall(r"'(panel\d+-curve\d+)' using 1:2 axes x1y2", script), []
        for text in content_of(self.path("figure.dat"), "r").split("\n\n\n"):
            name, words, *lines = text.strip("\n").split("\n")
            numbers = [[float(word) for word in line.split()] for line in lines if line and "nan" not in line]
            if name[2:] in edges:
                self.signs.append((name[2:], words[2:], numbers))
            else:
                blocks[name[2:]] = [[float(word) for word in line.split()] for line in lines if line]
        return script, blocks

    def over(self, *names_and_options):
        self.good("plot", *[self.path(word) if word.endswith((".db", ".json", ".csv")) else word for word in names_and_options],
                  "-o", self.path("figure.svg"))
        script, blocks = self.figure()
        colours = dict(re.findall(r"'(panel\d-curve\d)'.* lc rgb '(#\w+)' notitle", script))
        return script, blocks, colours

    def cells(self, name, *options):
        """Each cell of a heat map: x, y, x_low, x_high, y_low, y_high, value."""
        script, blocks = self.plot(name, "--kind", "map", *options)
        return script, blocks["cells"]


class Maps(Figures):
    def test_cells_of_an_even_map(self):
        rows = self.sweep("a.db", "drive.frequency=9Hz:12Hz:4", "model.kappa=1:2:3")
        script, cells = self.cells("a.db", "--quantity", "mean_r")
        self.assertEqual(len(cells), 12)
        for row, cell in zip(rows, cells):
            kappa, frequency = float(row["model.kappa"]), float(row["drive.frequency"])
            self.assertAlmostEqual(cell[0], kappa, 6)
            self.assertAlmostEqual(cell[1], frequency, 6)
            self.assertAlmostEqual(cell[2], kappa - 0.25, 6)
            self.assertAlmostEqual(cell[4], frequency - 0.5, 6)
            self.assertTrue(0 <= cell[3] - (kappa + 0.25) < 0.005)  # boxes overlap by a pixel
            self.assertTrue(0 <= cell[5] - (frequency + 0.5) < 0.01)
            self.assertAlmostEqual(cell[6], 1e3 * HALF_LENGTH * float(row["mean_r"]), 5)
        self.assertIn("set xrange [0.75:2.25]", script)
        self.assertIn("set label 'drive frequency (Hz)'", script)
        self.assertIn("set label 'mean radius ⟨r⟩ (mm)'", script)
        self.assertIn("Mean radius ⟨r⟩ over magnetic strength κ and drive frequency", words(script))
        self.assertNotIn("\nset logscale", script)

    def test_logarithmic_cells_meet_at_geometric_means(self):
        self.sweep("a.db", "drive.frequency=8Hz:32Hz:3:log", "model.kappa=0.5:2:3:log")
        script, cells = self.cells("a.db", "--quantity", "max_r")
        self.assertIn("set logscale x", script)
        self.assertIn("set logscale y", script)
        for x, y, x_low, x_high, y_low, y_high, _ in cells:
            self.assertAlmostEqual(x_low / (x / math.sqrt(2)), 1, 6)
            self.assertAlmostEqual(y_low / (y / math.sqrt(2)), 1, 6)
            self.assertTrue(1 - 1e-6 < x_high / (x * math.sqrt(2)) < 1.004)
            self.assertTrue(1 - 1e-6 < y_high / (y * math.sqrt(2)) < 1.004)

    def test_lists_are_sorted_and_repeated_values_drawn_once(self):
        rows = self.sweep("a.db", "start.r=0.9,0.5,0.7,0.5", "model.kappa=3,1,2")
        _, cells = self.cells("a.db", "--quantity", "mean_b")
        wanted = {(float(row["model.kappa"]), float(row["start.r"])): float(row["mean_b"]) for row in rows}
        self.assertEqual(len(cells), 9)
        self.assertEqual([cell[0] for cell in cells], [1, 2, 3] * 3)
        self.assertEqual([cell[1] for cell in cells], [0.5] * 3 + [0.7] * 3 + [0.9] * 3)
        for cell in cells:
            self.assertAlmostEqual(cell[6], wanted[cell[0], cell[1]], 6)

    def test_falling_axes_are_drawn_rising(self):
        self.sweep("a.db", "drive.frequency=12Hz:9Hz:4", "model.kappa=2:1:3")
        script, cells = self.cells("a.db", "--quantity", "mean_b")
        self.assertIn("set xrange [0.75:2.25]\n", script)
        self.assertTrue(all(cell[2] < cell[3] and cell[4] < cell[5] for cell in cells))

    def test_the_line_below_the_title_tells_of_the_points(self):
        """What is not the default; not what an axis gives in another form, nor in this one."""
        for axis, given, told, silent in (
                ("model.eps=0.1,0.12", "bead.radius=3mm", None, "bead.radius"), ("drive.frequency=9,10", "drive.omega=0.3", None, "drive.omega"),
                ("drive.omega=0.2,0.3", "drive.frequency=7", None, "drive.frequency"), ("magnet.depth=1cm,2cm", "model.h=0.5", None, "model.h"),
                ("drive.frequency=9,10", "friction.law=rolling", "dynamics rigid, friction.law rolling, 2 runs", "friction.mu"),
                ("drive.frequency=9,10", "model.kappa=1.25", "model.kappa 1.25, 2 runs", "drive"),
                ("model.dynamics=rigid,farago2020", "model.kappa=1.25", "model.kappa 1.25, 2 runs", "model.dynamics"),
                ("model.dynamics=rigid,farago2020", "run.samples=16", "2 runs", "; ,")):
            name = self.path("c.db")
            self.good("sweep", "--set", "run.periods=3", "--set", "run.discard=1", "--set", given, "--over", axis, "-o", name)
            line = re.findall(r"set label '(.*?)' at [^\n]*textcolor rgb '#555555'", self.plot("c.db")[0])
            os.remove(name)
            self.assertNotIn(silent, " ".join(line), axis)
            if told:
                self.assertIn(told, " ".join(line))

    def test_both_signs_get_a_palette_about_zero(self):
        self.sweep("a.db", "drive.frequency=3Hz:20Hz:2", "model.kappa=1,2")
        script, cells = self.cells("a.db", "--quantity", "mean_alpha_dot")
        greatest = max(abs(cell[6]) for cell in cells)
        low, high = script.split("set cbrange [")[1].split("]")[0].split(":")
        self.assertEqual(float(low), -float(high))
        self.assertAlmostEqual(float(high), greatest, 5)
        self.assertNotIn("cbrange", self.cells("a.db", "--quantity", "mean_r")[0])

    def test_regimes(self):
        rows = self.sweep("a.db", "drive.frequency=1Hz:20Hz:3", "model.kappa=1:2:4")
        script, blocks = self.plot("a.db", "--quantity", "regime")
        drawn = {name for name in blocks if name.startswith("cells-")}
        found = {row["regime"] for row in rows}
        self.assertEqual(len(drawn), len(found))
        for regime in found:
            self.assertIn(f"set label '{regime}'", script)
        # Neighbours of one regime are one box: together the boxes cover the map once.
        area = sum((round(box[3], 2) - box[2]) * (round(box[5], 2) - box[4]) for name in drawn for box in blocks[name])
        self.assertLess(abs(area / (28.5 * 4 / 3) - 1), 0.02)

    def test_choices_are_named(self):
        self.sweep("a.db", "model.dynamics=rigid,farago2020", "drive.frequency=10,12")
        script, cells = self.cells("a.db", "--quantity", "mean_r")
        self.assertIn("set ytics ('rigid' 0, 'farago2020' 1)", script)
        self.assertEqual([cell[1] for cell in cells], [0, 0, 1, 1])
        # Choices between those that were swept have no place.
        laws = ["viscous", "rolling"]
        self.sweep("b.db", "friction.law=" + ",".join(laws), "drive.frequency=10,12")
        script, cells = self.cells("b.db", "--quantity", "mean_r")
        self.assertIn("set ytics ('viscous' 0, 'rolling' 1)", script)
        self.assertEqual(sorted({cell[1] for cell in cells}), [0, 1])
        self.sweep("c.db", "friction.law=coulomb,viscous")
        script, blocks = self.plot("c.db", "--quantity", "mean_r")
        self.assertIn("set xtics ('viscous' 0, 'coulomb' 1)", script)
        self.assertEqual([x for x, _ in blocks["panel1-curve1"]], [0, 1])

    def test_only_figures_that_can_be_made_are_named(self):
        """What the end of a sweep recommends is done, with one axis to three."""
        axes = ["drive.frequency=9,10", "model.kappa=1,2", "start.r=0.5,0.6"]
        for case in (axes[:1], axes[:2], axes, ["model.kappa=1"], ["start.r=0.5:1:random:4", "start.phi=0:90:random:4"]):
            path = self.path(f"named{len(case)}-{len(case[0])}.db")
            said = self.good("sweep", *SHORT, *[word for axis in case for word in ("--over", axis)], "-o", path)
            status, _, err = festoon("plot", path, "-o", self.path("named.svg"))
            self.assertEqual((status == 0), "festoon plot" in said, (case, err))
            self.assertIn(f"festoon export {path} --csv prints the rows", said)

    def test_points_without_a_value_are_counted(self):
        self.sweep("a.db", "drive.frequency=3Hz:20Hz:3", "model.kappa=1,2")
        script, cells = self.cells("a.db", "--quantity", "period")
        self.assertTrue(0 < len(cells) < 6, cells)
        self.assertIn(f"white: {6 - len(cells)} of 6 points", words(script))

    def test_what_is_refused(self):
        self.sweep("r.db", "start.r=0.5:1:random:4", "start.phi=0:90:random:4")
        self.assertIn("random points", self.refused("plot", self.path("r.db"), "-o", self.path("f.svg")))
        self.sweep("g.db", "friction.gamma=300,310", "drive.frequency=10,12")
        self.assertIn("friction.gamma", self.refused("plot", self.path("g.db"), "--units", "scaled", "-o", self.path("f.svg")))
        self.refused("plot", self.path("g.db"), "--units", "imperial", "-o", self.path("f.svg"))
        self.sweep("one.db", "drive.frequency=10,10,10")
        self.plot("one.db")  # a range of one value
        for word, told in (("lap", "the nearest is lab"), ("SI", "the nearest is si"), ("", "choose one of given, lab")):
            self.assertIn(told, self.refused("plot", self.path("one.db"), "--units", word, "-o",
                                                     self.path("no.svg")))
        self.assertFalse(os.path.exists(self.path("no.svg")))


class Units(Figures):
    def test_drive_and_lengths(self):
        self.sweep("f.db", "drive.frequency=10Hz:12Hz:3", "start.r=0.5,0.9")
        self.sweep("o.db", "drive.omega=0.2:0.24:3", "start.r=0.5,0.9")
        hertz = GAMMA / (2 * math.pi)
        script, cells = self.cells("f.db", "--quantity", "mean_r", "--units", "scaled")
        self.assertIn("set label 'drive ω (γ)'", script)
        self.assertAlmostEqual(cells[0][1], 10 / hertz, 6)
        self.assertAlmostEqual(cells[1][0], 0.9, 6)
        length = cells[0][6]
        script, cells = self.cells("f.db", "--quantity", "mean_r", "--units", "lab")
        self.assertIn("set label 'r at the start (mm)'", script)
        self.assertIn("set label 'mean radius ⟨r⟩ (mm)'", script)
        self.assertAlmostEqual(cells[1][0], 0.9 * 1e3 * HALF_LENGTH, 5)
        self.assertAlmostEqual(cells[0][6], length * 1e3 * HALF_LENGTH, 4)
        script, cells = self.cells("o.db", "--quantity", "mean_alpha_dot", "--units", "lab")
        self.assertIn("set label 'drive frequency (Hz)'", script)
        self.assertAlmostEqual(cells[0][1], 0.2 * hertz, 5)
        self.assertIn("set label 'bead''s circling ⟨α′⟩/2π (Hz)'", script)
        self.assertAlmostEqual(cells[0][6] / self.cells("o.db", "--quantity", "mean_alpha_dot")[1][0][6], hertz, 3)
        for key, unit, factor in (("max_slip", "mm/s", 1e3 * HALF_LENGTH * GAMMA), ("end_time", "s", 1 / GAMMA)):
            script, cells = self.cells("o.db", "--quantity", key, "--units", "lab")
            self.assertIn(f"({unit})", script)
            self.assertLess(abs(cells[0][6] / self.cells("o.db", "--quantity", key)[1][0][6] / factor - 1), 1e-6)

    def test_units_are_those_of_each_point(self):
        """A varied parameter may be a unit, or make one: all columns are drawn as they are exported, whatever it is."""
        with open(self.path("density.yaml"), "w") as scene:
            scene.write("bead: {radius: 1.5 mm, density: 7.5 g/cm^3, remanence: 1.1 T}\nmagnet: {b0: 9 mT}\n"
                        "run: {periods: 4, discard: 2}\n")
        with open(self.path("beads.yaml"), "w") as scene:
            scene.write("bead: {density: 7.5 g/cm^3}\nrun: {periods: 3, discard: 2}\ncontact: {pair_rate: 312.5}\n"
                        "beads: [start.phi: 3 deg, start.phi: 183 deg]\n")
        for scene, axis in (("density", "bead.radius=1mm,1.5mm"), ("density", "bead.density=7000,7500"),
                            ("density", "magnet.b0=8mT,9mT"), ("density", "friction.gamma=300,310"),
                            ("density", "magnet.half_length=22mm,23mm"), ("density", "friction.gamma=310"),
                            ("beads", "bead.density=7000,7500")):
            name, key = self.path(f"{scene}-{axis}.db"), axis.split("=")[0]
            self.good("sweep", self.path(f"{scene}.yaml"), "--over", axis, "--over", "drive.frequency=10,10.7", "-o", name)
            rows = json.loads(self.good("export", name, "--json"))
            columns = [column for column in rows[0] if all(isinstance(row[column], float) for row in rows)
                       and column not in (key, "drive.frequency")]
            self.assertGreater(len(columns), 7)
            for few in (columns[i : i + 8] for i in range(0, len(columns), 8)):
                shown = ("--units", "lab", "--quantity", ",".join(few))
                head, *lines = csv.reader(io.StringIO(self.good("export", name, "--csv", *shown)))
                blocks = self.plot(f"{scene}-{axis}.db", "--kind", "curves", *shown)[1]
                for panel, column in enumerate(few, 1):
                    place = [word.split(" ")[0] for word in head].index(column)
                    wanted = sorted(float(line[place]) for line in lines)
                    drawn = sorted(y for block, points in blocks.items() if block.startswith(f"panel{panel}-")
                                   for _, y in points if math.isfinite(y))
                    self.assertEqual(len(drawn), len(wanted), (axis, column))
                    for one, other in zip(drawn, wanted):
                        self.assertLessEqual(abs(one - other), 1e-5 * abs(other), (axis, head[place]))

    def test_the_upper_axis_has_the_friction_rate_of_the_points(self):
        self.sweep("g.db", "friction.gamma=300,600", "drive.frequency=9,10")
        script = self.plot("g.db", "--only", "friction.gamma=600", "--quantity", "mean_r")[0]
        low = float(re.search(r"set x2range \[(\S+):", script).group(1))
        self.assertAlmostEqual(low, 9 * 2 * math.pi / 600, 6)
        self.assertIn("⟨r⟩ (mm)", script)  # the units of a sweep over what is shown
        whole = self.plot("g.db", "--kind", "curves", "--quantity", "mean_r")[0]
        self.assertNotIn("drive ω", whole)
        self.assertIn("⟨r⟩ (ℓ)", whole)

    def test_metres_become_half_lengths(self):
        self.sweep("m.db", "magnet.depth=15mm:17mm:3", "bead.radius=2mm,3mm")
        self.assertEqual([round(cell[0], 6) for cell in self.cells("m.db", "--quantity", "mean_r")[1]], [2, 3] * 3)
        cells = self.cells("m.db", "--quantity", "mean_r", "--units", "scaled")[1]
        self.assertAlmostEqual(cells[0][0], 2 / 23, 6)
        self.assertAlmostEqual(cells[0][1], 15 / 23, 6)

    def test_curves(self):
        rows = self.sweep("c.db", "drive.omega=0.2:0.8:5:log")
        script, blocks = self.plot("c.db", "--quantity", "mean_r,rms_slip", "--units", "lab")
        self.assertIn("set logscale x\n", script)
        self.assertIn("set logscale x2\n", script)
        for row, (x, y) in zip(rows, blocks["panel1-curve1"]):
            self.assertLess(abs(x / (float(row["drive.omega"]) * GAMMA / (2 * math.pi)) - 1), 1e-6)
            self.assertLess(abs(y / (float(row["mean_r"]) * 23) - 1), 1e-6)

    def test_regimes_have_one_colour_in_all_panels(self):
        rows = self.sweep("c.db", "drive.omega=0.04,0.2,0.22,0.24")
        script, blocks = self.plot("c.db")
        entries = re.findall(r"'(panel\d)-(curve\d)'.* lc rgb '(#\w+)' notitle", script)
        colours = [colour for panel, _, colour in entries if panel == "panel3"]
        self.assertGreater(len(colours), 1)
        self.assertEqual(len(set(colours)), len(colours))
        self.assertEqual([colour for _, _, colour in entries], colours * 3)
        # The key has one entry for each regime, in the colours of the panels.
        keyed = re.findall(r"data index 'key\d+'.* lc rgb '(#\w+)' notitle", script)
        self.assertEqual(keyed, colours)
        names = [name for name in re.findall(r"set label '([\w-]+)' at \S+ left front", script)]
        self.assertEqual(sorted(names), sorted({row["regime"] for row in rows}))
        for panel, key in enumerate(("mean_r", "std_r", "mean_alpha_dot"), 1):
            for curve, regime in enumerate(names, 1):
                drawn = [y for _, y in blocks[f"panel{panel}-curve{curve}"] if math.isfinite(y)]
                wanted = [float(row[key]) for row in rows if row["regime"] == regime]
                self.assertEqual(len(drawn), len(wanted))
                for one, other in zip(drawn, wanted):
                    self.assertAlmostEqual(one, other, 6)

    def test_names_stand_in_the_place_of_numbers(self):
        self.sweep("c.db", "drive.frequency=2,10,20")
        script, blocks = self.plot("c.db", "--quantity", "regime")
        names = dict((name, int(value)) for name, value in re.findall(r"'([\w-]+)' (\d)", script.split("set ytics (")[1]
                                                                       .split(")")[0]))
        rows = csv.DictReader(io.StringIO(self.rows("c.db")))
        self.assertEqual([y for _, y in blocks["panel1-curve1"]], [names[row["regime"]] for row in rows])

    def test_keys_without_values(self):
        self.sweep("c.db", "drive.frequency=10,11,12")
        script, blocks = self.plot("c.db", "--quantity", "mean_r,largest_exponent,min_b")
        self.assertIn("no value of: largest Lyapunov exponent (1/s)", words(script))
        self.assertEqual(sorted(name for name in blocks if name.startswith("panel")), ["panel1-curve1", "panel2-curve1"])
        self.assertIn("no point", self.refused("plot", self.path("c.db"), "--quantity", "largest_exponent", "-o",
                                               self.path("f.svg")))
        self.sweep("m.db", "drive.frequency=19,20", "model.kappa=1.5,1.6")
        self.assertIn("no point", self.refused("plot", self.path("m.db"), "--quantity", "largest_exponent", "-o",
                                               self.path("f.svg")))


class Over(Figures):
    """Files over each other: each has its own rows in its own colour, and a name that says what differs."""

    def test_two_sweeps_and_a_branch(self):
        axis = "drive.frequency=9Hz:15Hz:4"
        rows = self.sweep("plain.db", axis)
        self.good("sweep", *SHORT, "--set", "model.kappa=1.2", "--set", "bead.radius=2mm", "--over", axis, "-o", self.path("other.db"))
        script, blocks, colours = self.over("plain.db", "other.db", "--quantity", "mean_r,std_r")
        self.assertIn("bead.radius 2.5 mm, model.kappa 1.5", words(script))
        self.assertIn("bead.radius 2 mm, model.kappa 1.2", words(script))
        self.assertEqual(colours["panel1-curve1"], colours["panel2-curve1"])
        self.assertNotEqual(colours["panel1-curve1"], colours["panel1-curve2"])
        others = list(csv.DictReader(io.StringIO(self.rows("other.db"))))
        for curve, source in (("curve1", rows), ("curve2", others)):
            for panel, key in (("panel1", "mean_r"), ("panel2", "std_r")):
                drawn = {round(x, 6): y for x, y in blocks[f"{panel}-{curve}"]}
                for row in source:  # a distance that is undecided and far beyond the others has a sign alone
                    far = (key == "mean_r" and row["regime"] == "undecided"
                           and drawn.get(round(float(row["drive.frequency"]), 6)) is None)
                    self.assertTrue(far or abs(drawn[round(float(row["drive.frequency"]), 6)] - 23 * float(row[key])) < 5e-5)
        self.good("branch", "--kind", "counter", "--over", "drive.frequency=14Hz:15Hz", "-o", self.path("orbits.json"))
        self.assertNotIn("model.kappa", words(self.plot("orbits.json")[0]))
        script, blocks, _ = self.over("plain.db", "orbits.json")
        self.assertIn("plain.db", words(script))  # nothing but the axis differs
        self.assertIn("orbits.json", words(script))
        self.assertTrue(any(14 <= x <= 15 and 19 < y < 22 for x, y in blocks["panel1-curve2"]), blocks)

    def test_a_branch_is_in_each_panel(self):
        """Whose quantity it has; of others the key says that it has none, and which kinds of branches there are."""
        self.sweep("f.db", "drive.frequency=13:15:3")
        for kind in ("counter", "locked"):
            self.good("branch", "--kind", kind, "--over", "drive.frequency=13.3Hz:13.5Hz", "-o", self.path(f"{kind}.json"))
        alone = []
        for key in ("mean_r", "mean_alpha_dot"):
            script, blocks = self.plot("counter.json", "--quantity", key)
            alone.append(blocks["panel1-curve1"])
            order = re.findall(r"data index '(panel1-curve\d)' .* (lines|points)", script)
            self.assertEqual([style for _, style in order], ["lines", "lines", "points", "lines"])
            self.assertEqual(blocks[order[-1][0]], alone[-1])  # what is stable is seen on the signs
            self.assertIn("set border back", script)  # and signs on the frame
        for first, second in (("f.db", "counter.json"), ("counter.json", "f.db")):
            script, blocks, _ = self.over(first, second, "--quantity", "regime,mean_r,mean_alpha_dot,std_r")
            self.assertIn("counter.json, no regime, no std\\_r", words(script))
            self.assertIn("set ytics ('undecided' 0)\n", script)  # the word that occurs
            for curve in alone:
                self.assertEqual(list(blocks.values()).count(curve), 2)
        for quantity, panels in (("mean_r", 1), ("mean_r,mean_alpha_dot", 2)):
            script, blocks, _ = self.over("counter.json", "locked.json", "--quantity", quantity)
            self.assertEqual({name[:6] for name in blocks if name.startswith("panel")}, {f"panel{p + 1}" for p in range(panels)})
            self.assertIn("counter.json, counter", words(script))
            self.assertIn("locked.json, locked: unstable", words(script))  # it has no other curve
        both = ("plot", self.path("counter.json"), self.path("locked.json"), "-o", self.path("no.svg"), "--quantity")
        for keys, told in (("mean_r,std_r", 'unknown observable "std_r"'), ("mean_r,festoons", "(kind: locked) has a value of festoons"),
                           ("mean_r,multipliers", "multipliers are drawn alone")):
            self.assertIn(told, self.refused(*both, keys))

    def test_what_is_the_same_stands_below_the_title(self):
        self.good("branch", "--kind", "locked", "--over", "drive.omega=0.05:0.1", "--set", "model.kappa=1.25", "-o",
                  self.path("locked.json"))
        self.assertIn("model.kappa 1.25", words(self.plot("locked.json")[0]))
        for name, law in (("a.db", "viscous"), ("b.db", "rolling")):
            self.good("sweep", *SHORT, "--set", "model.kappa=1.25", "--set", f"friction.law={law}", "--over",
                      "drive.frequency=9,10", "-o", self.path(name))
        script, _, _ = self.over("a.db", "b.db")
        line = re.findall(r"set label '(.*?)' at [^\n]*textcolor rgb '#555555'", script)
        self.assertEqual(line, ["model.kappa 1.25"])
        self.assertEqual(re.findall(r"set label '(friction.*?)' at", script), ["friction.law viscous", "friction.law rolling"])

    def test_a_long_name_takes_several_lines(self):
        more = ("model.kappa=1.2", "friction.law=none", "bead.radius=2mm", "bead.inertia=0.5", "magnet.depth=17mm", "magnet.width=41mm")
        axis = ("--over", "drive.frequency=9,10", "-o")
        self.good("sweep", *SHORT, *axis, self.path("a.db"))
        self.good("sweep", *SHORT, *[w for text in more for w in ("--set", text)], *axis, self.path("b.db"))
        script, _, _ = self.over("a.db", "b.db", "--quantity", "mean_r")
        name = ("bead.radius 2 mm, bead.inertia 0.5, magnet.width 41 mm, magnet.depth 17 mm, friction.law none, model.kappa 1.2")
        self.assertIn(name, words(script))
        self.assertLess(max(map(len, re.findall(r"set label '(.*?)' at [0-9.]+,[0-9.]+ left front", script))), 80)

    def test_carried_sweeps_name_their_way(self):
        for way in ("up", "down"):
            self.good("sweep", *SHORT, "--over", "drive.frequency=9,10", "--carry", way, "-o", self.path(f"c-{way}.db"))
        script, _, _ = self.over("c-up.db", "c-down.db", "--quantity", "mean_r")
        self.assertIn("c-up.db, upwards c-down.db, downwards", words(script))

    def test_trajectories(self):
        for name, kappa in (("a.csv", "1.2"), ("b.csv", "1.8")):
            self.good("run", *SHORT, "--set", f"model.kappa={kappa}", "-o", self.path(name))
        for kind in ("path", "time", "section"):
            script, blocks, colours = self.over("a.csv", "b.csv", "--kind", kind)
            self.assertIn("model.kappa 1.2", words(script), kind)
            self.assertIn("model.kappa 1.8", words(script), kind)
            self.assertGreater(len(set(colours.values())), 1)
            self.assertNotEqual(blocks["panel1-curve1"], blocks[max(name for name in blocks if name.startswith("panel1"))])
        self.assertEqual(self.over("a.csv", "b.csv", "--kind", "time")[1]["panel1-curve1"][0][0], 0)

    def test_what_has_nothing_in_common_is_refused(self):
        self.sweep("f.db", "drive.frequency=9,10")
        self.sweep("k.db", "model.kappa=1,1.5")
        self.sweep("two.db", "model.kappa=1,1.5", "drive.frequency=9,10")
        self.good("run", *SHORT, "-o", self.path("t.csv"))
        out = ("-o", self.path("no.svg"))
        for names in (("f.db", "k.db"), ("f.db", "t.csv"), ("t.csv", "f.db")):
            self.assertIn("no axis in common", self.refused("plot", *map(self.path, names), *out), names)
        self.assertIn("--only KEY=VALUE", self.refused("plot", self.path("f.db"), self.path("two.db"), *out))
        both = ("plot", self.path("f.db"), self.path("f.db"))
        self.assertIn("--quantity: of several files a colour tells the file, and not the regime of a point: ask for the regime first, "
                      "as in regime,mean_r,", self.refused(*both, "--quantity", "mean_r,regime", *out))
        self.good(*both, "--quantity", "regime,mean_r", "-o", self.path("yes.svg"))
        self.assertIn("path, time, section and ramp",
                      self.refused("plot", self.path("t.csv"), self.path("t.csv"), "--kind", "local-n", *out))
        self.refused("plot", *[self.path("f.db")] * 9, *out)
        for name, options, told in (("f.db", ("--kind", "time"), "is of trajectories"), ("f.db", ("--quantity", "q"), "unknown key"),
                                    ("t.csv", ("--quantity", "r"), "time, sections and ramps"),
                                    ("t.csv", ("--only", "model.kappa=1"), "no sweep of these"), ("f.db", ("--kind", "map"), "two axes"),
                                    ("t.csv", ("--kind", "curves"), "path, time, section and ramp")):
            self.assertIn(told, self.refused("plot", *[self.path(name)] * 2, *options, *out), (name, options))
        self.assertFalse(os.path.exists(self.path("no.svg")))
        self.assertIn("no sweep of these varies", self.refused("plot", *[self.path("f.db")] * 2, "--only", "start.r=1", *out))
        for kind in ((), ("--kind", "curves")):
            self.over("f.db", "two.db", "--only", "model.kappa=1.5", *kind)

    def test_lines_join_neighbours_of_one_regime(self):
        """In families, over other sweeps and below measured points; what is undecided and far away is a sign alone."""
        self.sweep("f.db", "drive.frequency=9:15:7", "model.kappa=1,1.5")
        for point, (regime, r) in enumerate([("locked", 0.8), ("locked", 0.9), ("undecided", 0.7), ("undecided", 7), ("librating", 0.6),
                                             ("librating", 0.5), ("locked", 0.4)]):
            change(self.path("f.db"), ("UPDATE rows SET regime = ?, mean_r = ? WHERE point / 2 = ?", (regime, r, point)))
        with open(self.path("p.csv"), "w", encoding="utf-8") as file:
            file.write("frequency [Hz],mean_r [mm],mean_r_error [mm]\n9.5,20,1\n11,20,1\n")
        only, wanted = ("--only", "model.kappa=1.5"), [[9, 10], [11], [13, 14], [15]]
        for words_of, joined in ((("f.db",), wanted), (("f.db", "f.db", *only), wanted),
                                 (("f.db", "--points", "p.csv", *only), [[9, 10], [13, 14], [15]])):
            script, _, _ = self.over(*words_of, "--quantity", "mean_r")
            text = next(block for block in content_of(self.path("figure.dat"), "r").split("\n\n\n") if "panel1-curve1\n" in block)
            pieces = [piece.strip().split("\n") for piece in text.strip().split("\n", 2)[2].split("\n\n")]
            self.assertEqual([[float(line.split()[0]) for line in piece] for piece in pieces if piece != [""]], joined, words_of)
            self.assertIn([11, 12], [[x for x, _ in points] for _, said, points in self.signs if said == "undecided"])
        self.assertIn("at model.kappa 1.5", words(script))
        self.assertIn("--only KEY=VALUE", self.refused("plot", self.path("f.db"), "--points", self.path("p.csv"), "-o", self.path("f.svg")))
        self.assertIn("no sweep of these varies", self.refused("plot", self.path("f.db"), "--points", self.path("p.csv"), *only, "--only",
                                                               "bead.radius=2mm", "-o", self.path("f.svg")))
        self.assertIn("--only, --units, --title, --size", self.refused("plot", self.path("f.db"), "--points", self.path("p.csv"), "--kind", "map",
                                                                      "-o", self.path("f.svg")))


class Signs(Figures):
    """Signs at the lower edge say why a curve has a gap: a run failed, its bead was ejected, or its motion is undecided."""

    def setUp(self):
        super().setUp()
        for name, kappa in (("a.db", "1.1"), ("b.db", "1.2")):
            self.good("sweep", "--set", "run.periods=12", "--set", "run.discard=4", "--set", "start.r=0.7", "--set", "plate.radius=21.3mm",
                      "--set", f"model.kappa={kappa}", "--over", "drive.frequency=8Hz:22Hz:8", "-o", self.path(name))
            change(self.path(name), "UPDATE rows SET status = 'failed', regime = NULL, mean_r = NULL, std_r = NULL, "
                                    "mean_alpha_dot = NULL WHERE point IN (0, 5)")

    def wanted(self, name, told):
        """{words: [abscissa]} of one panel; `told`: something else tells of the undecided motions that have values."""
        found = {}
        for row in csv.DictReader(io.StringIO(self.rows(name))):
            word = row["regime"] or "failed: 2 points"
            if word in ("ejected", "failed: 2 points") or (word == "undecided" and not (told and row["mean_r"])):
                found.setdefault(word, []).append(float(row["drive.frequency"]))
        self.assertEqual(found["failed: 2 points"], [8, 18])
        return found

    def test_of_one_sweep(self):
        for options, told, panels in (((), True, 3), (("--quantity", "mean_r"), False, 1)):
            wanted = self.wanted("a.db", told)
            self.assertIn("ejected", wanted)
            self.assertEqual("undecided" in wanted, not told, "this sweep has undecided runs, with values")
            script, blocks = self.plot("a.db", *options)
            self.assertEqual(len(self.signs), panels * len(wanted))
            for _, said, points in self.signs:
                self.assertIn(said, words(script))
                self.assertEqual([x for x, _ in points], wanted[said], said)
                self.assertTrue(all(0 < y < 0.1 for _, y in points))
            # Nothing lies below the signs' place.
            low, high = map(float, re.findall(r"set yrange \[(.*?):(.*?)\]", script)[0])
            drawn = [y for name, rows in blocks.items() if name.startswith("panel1") for _, y in rows]
            self.assertGreater((min(drawn) - low) / (high - low), 0.059)
            self.assertLess(max(drawn), high)
        # In a panel of names a row tells of ejected and undecided ones.
        self.plot("a.db", "--quantity", "regime")
        self.assertEqual([said for _, said, _ in self.signs], ["failed: 2 points"])

    def test_a_point_without_a_row_has_no_sign(self):
        change(self.path("a.db"), "DELETE FROM rows WHERE point = 5")
        self.assertIn("failed: 1 point'", self.plot("a.db")[0])

    def test_of_several(self):
        """One line of signs for each, in its colour; a file of which nothing else is drawn has its name there."""
        change(self.path("b.db"), "UPDATE rows SET regime = 'ejected', mean_r = NULL WHERE regime IS NOT NULL")
        script, blocks, colours = self.over("a.db", "b.db", "--quantity", "mean_r")
        self.assertEqual(sum(math.isfinite(y) for _, y in blocks["panel1-curve1"]), sum(row["mean_r"] != "" for row in csv.DictReader(io.StringIO(self.rows("a.db")))))
        heights = {}
        for name, said, points in self.signs:
            heights.setdefault(re.search(rf"'{name}' .* rgb '(#\w+)'", script)[1], set()).update(y for _, y in points)
        self.assertEqual(list(heights), [colours["panel1-curve1"], next(c for c in heights if c != colours["panel1-curve1"])])
        self.assertEqual([len(here) for here in heights.values()], [1, 1])
        self.assertNotEqual(*heights.values())
        for said in ("ejected", "failed", "model.kappa 1.2: ejected", "undecided"):
            self.assertIn(f"set label '{said}' at", script)
        self.over("b.db", "b.db", "--quantity", "mean_r")  # no file has a value

    def test_of_a_family(self):
        self.sweep("f.db", "drive.frequency=9,10,11", "model.kappa=1,1.5")
        change(self.path("f.db"), "UPDATE rows SET status = 'failed', regime = NULL, mean_r = NULL WHERE point IN (0, 3)")
        self.plot("f.db", "--quantity", "mean_r")
        self.assertIn([(9, 1)], [[(x, round(y / 0.03)) for x, y in points] for _, _, points in self.signs])
        self.assertIn([10], [[x for x, _ in points] for _, _, points in self.signs])
        self.assertIn("failed", [said for _, said, _ in self.signs])


class ManyPoints(Figures):
    """More points than a figure can show: some are drawn, and the title says how many."""

    def fill(self, name, points, value, *over):
        """Makes a sweep with invented rows: mean_r is this expression of the point i."""
        axes = [word for axis in over for word in ("--over", axis)]
        # Replaces all rows by invented ones.
        events.signal_when([FESTOON, "sweep", *SHORT, *axes, "-o", self.path(name)],
                           lambda: events.rows(self.path(name)), signal.SIGINT)
        change(self.path(name), "DELETE FROM rows", (
            "WITH RECURSIVE c(i) AS (SELECT 0 UNION ALL SELECT i + 1 FROM c WHERE i < ?) "
            f"INSERT INTO rows(point, status, regime, mean_r) SELECT i, 'done', 'locked', {value} FROM c",
            (points - 1,)))

    def test_curves(self):
        self.fill("c.db", 100001, "0.5 + i", "drive.frequency=0.1Hz:100.1Hz:100001")
        script, blocks = self.plot("c.db", "--quantity", "mean_r,regime")
        self.assertIn("one point of 11", words(script))
        drawn = blocks["panel1-curve1"]
        self.assertEqual(len(drawn), 9091)
        for i, (x, y) in enumerate(drawn):
            self.assertAlmostEqual(x, 0.1 + 0.001 * 11 * i, 6)
            self.assertLess(abs(y / (23 * (0.5 + 11 * i)) - 1), 1e-6)

    def test_failed_runs_that_are_not_drawn_count(self):
        self.fill("c.db", 20001, "0.5 + i", "drive.frequency=0.1Hz:100.1Hz:20001")
        change(self.path("c.db"), "UPDATE rows SET status = 'failed', regime = NULL, mean_r = NULL WHERE point IN (3, 4, 6)")
        self.plot("c.db", "--quantity", "mean_r")  # one point of three
        self.assertEqual([(said, len(points)) for _, said, points in self.signs], [("failed: 3 points", 2)])

    def test_maps(self):
        self.fill("m.db", 2050 * 10, "i", "model.kappa=1:10:10", "drive.frequency=1Hz:206Hz:2050")
        script, cells = self.cells("m.db", "--quantity", "mean_r")
        self.assertIn("one point of 1 x 3", words(script))
        self.assertEqual(len(cells), 10 * 684)
        for i, cell in enumerate(cells):
            row, column = divmod(i, 684)
            self.assertLessEqual(abs(cell[6] - 23 * (row * 2050 + 3 * column)), 1e-6 * cell[6])
            self.assertAlmostEqual(cell[1], 1 + row, 6)
        script, blocks = self.plot("m.db")
        self.assertEqual(len(blocks["cells-1"]), 10)  # one box for each row: all are locked


class Words(Figures):
    def test_only_the_last_panel_names_the_choices(self):
        self.sweep("w.db", "model.dynamics=rigid,farago2020")
        script, _ = self.plot("w.db", "--quantity", "mean_r,std_r,mean_nz")
        tics = [line for line in script.split("\n") if line.startswith("set xtics (")]
        self.assertEqual(tics, 2 * ["set xtics ('' 0, '' 1)"] + ["set xtics ('rigid' 0, 'farago2020' 1)"])


class Paths(Figures):
    def test_a_zoom_beside_the_path(self):
        self.good("run", *SHORT, "-o", self.path("t.csv"))
        zoom = ("plot", self.path("t.csv"), "-o", self.path("t.svg"), "--zoom")
        self.assertIn("outside of the path", self.refused(*zoom, "500,600,0,20"))
        self.assertFalse(os.path.exists(self.path("t.svg")))
        self.plot("t.csv", "--zoom", "0,30,0,30")


if __name__ == "__main__":
    if not shutil.which("gnuplot"):
        print("skipped: no gnuplot (gnuplot-nox)")
        sys.exit(77)
    unittest.main()
