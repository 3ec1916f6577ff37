"""`festoon plot` of several beads: paths, discs, contacts, gaps and loads in the figure's data are those of the
trajectory, options that say nothing of several beads are refused, and damaged files are.

tests: draw/figure_beads.c draw/figure_groups.c draw/figure_lag.c io/bead_table.c cli/plot.c"""

import csv
import json
import math
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

FESTOON = os.environ["FESTOON"]
LENGTH, GAMMA, GRAVITY = 23e-3, 312.5, 9.81  # m, 1/s, m/s^2
SCENE = """drive: {frequency: 30 Hz}
contact: {pair_rate: 312.5 1/s}
run: {periods: 6, discard: 1}
beads: [{start.phi: 3 deg}, {start.phi: 28 deg, radius: 2 mm, mass: 0.3 g}, {start.phi: 180 deg}]
"""


def run(*words):
    """Run the program: status, standard output, messages."""
    done = subprocess.run([FESTOON, *map(str, words)], capture_output=True, text=True, check=False)
    return done.returncode, done.stdout, done.stderr


def read(path):
    """The rows of a trajectory, {name: number}; no number is nan."""
    with open(path, encoding="utf-8") as file:
        rows = list(csv.reader(line for line in file if not line.startswith("#")))
    names = [word.split(" [")[0] for word in rows[0]]
    return [dict(zip(names, (float(word) if word else math.nan for word in row))) for row in rows[1:]]


class Beads(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scratch = tempfile.TemporaryDirectory()
        cls.folder = Path(cls.scratch.name)
        (cls.folder / "three.yaml").write_text(SCENE, encoding="utf-8")
        status, _, messages = run("run", cls.folder / "three.yaml", "-o", cls.folder / "t.csv")
        assert status == 0, messages
        cls.rows = read(cls.folder / "t.csv")
        masses = [0.5e-3, 0.3e-3, 0.5e-3]
        cls.radii, cls.masses = [2.5 / 23, 2 / 23, 2.5 / 23], masses

    @classmethod
    def tearDownClass(cls):
        cls.scratch.cleanup()

    def plot(self, *words, name="t.csv"):
        """The script, and {title: curves} of the panels, a curve being pieces of points."""
        status, _, messages = run("plot", self.folder / name, "-o", self.folder / "f.svg", *words)
        self.assertEqual(status, 0, messages)
        curves = {}
        for text in (self.folder / "f.dat").read_text(encoding="utf-8").split("\n\n\n"):
            block, title, *lines = text.strip("\n").split("\n")
            pieces = "\n".join(lines).split("\n\n")
            pieces = [[tuple(map(float, line.split())) for line in piece.splitlines() if line] for piece in pieces]
            curves.setdefault(title[2:], []).append((block[2:], [piece for piece in pieces if piece]))
        return (self.folder / "f.gp").read_text(encoding="utf-8"), curves

    def refused(self, wanted, *words, name="t.csv"):
        status, out, messages = run("plot", self.folder / name, "-o", self.folder / "no.svg", *words)
        self.assertEqual((status, out), (2, ""), messages)
        self.assertIn(wanted, messages)
        self.assertEqual(list(self.folder.glob("*no.*")), [])

    def place(self, row, bead, lab):
        x, y = row[f"X_{bead}"], row[f"Y_{bead}"]
        angle = 2 * math.pi * row["drive_turns"] if lab else 0.0
        return x * math.cos(angle) - y * math.sin(angle), x * math.sin(angle) + y * math.cos(angle)

    def check_paths(self, words, shown, lab, unit):
        script, curves = self.plot(*words)
        for bead in range(3):
            (_, pieces), = curves[f"bead {bead + 1}"]
            self.assertEqual(len(pieces), 1)
            points = pieces[0]
            self.assertGreater(len(points), len(shown))
            parts = (len(points) - 1) // (len(shown) - 1)
            for i, row in enumerate(shown):
                self.assertLess(math.dist(points[parts * i], [unit * x for x in self.place(row, bead, lab)]), 1e-5 * unit)
        return script, curves

    def test_paths_in_both_frames(self):
        """Every sample is a point of its bead's path, from the discard on and from --from on, in either unit."""
        after = [row for row in self.rows if 1 - 1e-9 <= row["drive_turns"] <= 3 + 1e-9]
        script, _ = self.check_paths(("--from", 1, "--to", 3), after, True, 23)
        self.assertIn("set label 'x (mm)'", script)
        script, _ = self.check_paths(("--frame", "magnet", "--units", "scaled", "--from", 1, "--to", 3), after, False, 1)
        self.assertIn("as seen from the magnet", script)
        self.assertIn("set label 'Y (ℓ)'", script)

    def test_beads_at_the_end(self):
        """Rims are circles about the last places with the beads' radii; contacts lie on them both, and moments too."""
        script, curves = self.plot("--from", 0, "--units", "scaled")
        last = self.rows[-1]
        circles = [piece for title in curves for block, pieces in curves[title] for piece in pieces
                   if title == "x y" and len(piece[0]) == 2 and len(piece) > 20]
        self.assertEqual(len(circles), 3)
        for bead, circle in enumerate(circles):
            for point in circle:
                self.assertAlmostEqual(math.dist(point, self.place(last, bead, True)), self.radii[bead], 6)
        touching = [(a, b) for a, b in ((0, 1), (0, 2), (1, 2)) if not math.isnan(last[f"force_{a}_{b}"])]
        self.assertIn((0, 1), touching)
        (_, pieces), = curves["contacts at the end"]
        for (a, b), point in zip(touching, pieces[0]):
            self.assertAlmostEqual(math.dist(point, self.place(last, a, True)) + math.dist(point, self.place(last, b, True)),
                                   math.dist(self.place(last, a, True), self.place(last, b, True)), 6)
        (_, pieces), = curves["horizontal parts of the moments at the end"]
        for bead in range(3):
            (x0, y0), (x1, y1) = pieces[2 * bead]
            angle = 2 * math.pi * last["drive_turns"] + math.atan2(last[f"nY_{bead}"], last[f"nX_{bead}"])
            self.assertLess(abs(math.remainder(math.atan2(y1 - y0, x1 - x0) - angle, 2 * math.pi)), 1e-3)
        self.assertEqual(len(curves["two beads meet"]), 1)
        colours = [script.index(f"lw 2 lc rgb '{code}'") for code in ("#009e73", "#cc79a7", "#999933")]
        self.assertEqual(colours, sorted(colours))

    def test_which_turns_are_shown(self):
        """The last forty turns, to the end; the figure says which, and where the beads are that are drawn to scale."""
        script, curves = self.plot("--to", 3)
        self.assertIn("turns 1 to 3 of 6", script)
        self.assertIn("horizontal parts of the moments at turn 3", script)
        self.assertEqual(run("run", "--set", "plate.tilt=2deg", "--set", "run.samples=8", "--set", "run.periods=45", "--set",
                             "run.discard=2", "-o", self.folder / "tilt.csv")[0], 0)
        rows = read(self.folder / "tilt.csv")
        for options, first, words in (((), 5, "5 to 45 of 45"), (("--from", 0), 0, "moments at the end"),
                                      (("--from", 1), 1, "1 to 45 of 45")):
            script, curves = self.plot(*options, name="tilt.csv")
            self.assertIn(words, script)
            (_, pieces), = curves["bead 1"]
            for point, row in ((pieces[0][0], rows[8 * first]), (pieces[-1][-1], rows[-1])):
                self.assertLess(math.dist(point, (23 * row["X_0"], 23 * row["Y_0"])), 1e-3)

    def gap(self, row, a, b):
        return math.dist(*[[row[f"{axis}_{i}"] for axis in "XYZ"] for i in (a, b)]) - self.radii[a] - self.radii[b]

    def test_groups_before_the_discard(self):
        _, curves = self.plot("--kind", "groups", "--to", 0.5)
        self.assertEqual(curves["beads 1 and 2"][0][1][0][-1][0], 0.5)

    def test_groups(self):
        """Gaps are those of the states, bars those of the forces, loads in the weights of their own beads."""
        script, curves = self.plot("--kind", "groups", "--units", "lab")
        told = next(line for line in (self.folder / "t.csv").read_text("utf-8").splitlines() if "# result = " in line)
        outcome = json.loads(told[len("# result = "):])["outcome"]
        self.assertIn(f"Groups of 3 beads: {outcome}", script)
        self.assertIn("set label 'gap (mm)'", script)
        # people count beads from 1, here as in the key and the panels
        self.assertEqual(set(re.findall(r"\d", re.search("at the end ([^']*)", script)[1])), {"1", "2", "3"})
        pairs = ((0, 1), (0, 2), (1, 2))
        for a, b in pairs:
            (_, gaps), = curves[f"beads {a + 1} and {b + 1}"]
            for row, (turns, gap) in zip(self.rows, gaps[0]):
                self.assertAlmostEqual(turns, row["drive_turns"], 7)
                self.assertAlmostEqual(gap, 23 * self.gap(row, a, b), 5)
        bars = {block: pieces for block, pieces in curves["x y"] if block.startswith("panel2")}
        touched = [pair for pair in pairs if any(not math.isnan(row["force_%d_%d" % pair]) for row in self.rows)]
        self.assertEqual(len(bars), len(touched))
        for place, pair in enumerate(touched, 1):
            spans = [(piece[0][0], piece[1][0]) for piece in bars[f"panel2-curve{place}"]]
            self.assertTrue(all(point[1] == place for piece in bars[f"panel2-curve{place}"] for point in piece))
            for row in self.rows:
                inside = any(low - 1e-9 <= row["drive_turns"] <= high + 1e-9 for low, high in spans)
                self.assertEqual(inside, not math.isnan(row["force_%d_%d" % pair]))
            self.assertIn(f"'{pair[0] + 1}–{pair[1] + 1}' {place}", script)
        weight = LENGTH * GAMMA ** 2 / GRAVITY
        for bead in range(3):
            (_, loads), = curves[f"bead {bead + 1}"]
            shown = {round(turns, 6): load for piece in loads for turns, load in piece}
            wanted = {round(row["drive_turns"], 6): row[f"load_{bead}"] for row in self.rows
                      if not math.isnan(row[f"load_{bead}"])}
            self.assertEqual(set(shown), set(wanted))
            for turns, load in wanted.items():
                factor = weight * self.masses[0] / self.masses[bead]
                self.assertLess(abs(shown[turns] - factor * load), 1e-6 * (1 + abs(shown[turns])))

    def test_many_beads(self):
        """More than eight share colours, and a figure of their contacts is refused."""
        beads = ", ".join(f"{{start.r: {0.5 + 0.3 * (i % 2)}, start.phi: {30 * i} deg}}" for i in range(12))
        (self.folder / "many.yaml").write_text(
            f"drive: {{frequency: 30 Hz}}\nrun: {{method: stepping, periods: 2, discard: 0, step: 200}}\nbeads: [{beads}]\n",
            encoding="utf-8")
        status, _, messages = run("run", self.folder / "many.yaml", "-o", self.folder / "many.csv")
        self.assertEqual(status, 0, messages)
        script, curves = self.plot(name="many.csv")
        paths = [pieces for block, pieces in curves["x y"] if any(len(piece) > 90 for piece in pieces)]
        self.assertEqual([len(pieces) for pieces in paths], [2] * 4 + [1] * 4)
        self.assertIn("no contacts are known", script)
        self.refused("more than 8 beads", "--kind", "groups", name="many.csv")

    def test_sweeps(self):
        """A map of outcomes has the colours of their table, a cell for each run; over one axis the names are an ordinate."""
        scene = self.folder / "two.yaml"
        scene.write_text(SCENE.replace(", {start.phi: 180 deg}]", "]"), encoding="utf-8")
        over = ("--over", "beads[1].start.phi=28deg:180deg:2", "--over", "drive.frequency=20Hz:30Hz:2")
        colours = {"apart": "#0072b2", "walker": "#d55e00", "bar": "#009e73", "undecided": "#888888"}
        for axes in (2, 1):
            name = self.folder / f"{axes}.db"
            status, _, messages = run("sweep", scene, *over[:2 * axes], "-o", name)
            self.assertEqual(status, 0, messages)
            _, rows, _ = run("export", name, "--csv", "--quantity", "outcome")
            found = [row.split(",")[axes] for row in rows.splitlines()[1:]]
            self.assertEqual(len(found), 2 ** axes)
            self.assertIn("apart", found)
            script, curves = self.plot(name=name.name)
            if axes == 2:
                self.assertIn("Outcomes of several beads", script)
                for outcome in set(found):
                    self.assertIn(f"lc rgb '{colours[outcome]}'", script)
                    self.assertIn(f"set label '{outcome}'", script)
            else:
                self.assertIn("set ytics ('apart' 0, 'undecided' 6)", script)  # the axis names what occurs alone
                (_, points), = [curve for curve in curves["x y"] if curve[0] == "panel1-curve1"]
                names = ("apart", "walker", "bar", "ring", "cluster", "ejected", "undecided")
                self.assertEqual([names[int(y)] for piece in points for _, y in piece], found)

    def test_the_lag_of_a_lock(self):
        """In a wave and over a turning magnet the rate is the slope of the lag, and a lock ends where the rate is none."""
        self.assertEqual(run("init", "--world", "wave", self.folder / "wave.yaml")[0], 0)
        self.assertEqual(run("init", "--world", "levitation", self.folder / "levitation.yaml")[0], 0)
        weak = ("--set", "medium.drag_rate=12", "--set", "plate.radius=500m", "--set", "wave.amplitude=0.05mT")
        for scene, words, hertz, locked in (("wave", (*weak, "--set", "drive.frequency=5Hz", "--set", "run.duration=5s"), 5, True),
                                            ("wave", (*weak, "--set", "drive.frequency=9Hz", "--set", "run.duration=2s"), 9, False),
                                            ("levitation", ("--set", "run.duration=0.1s"), 200, None)):
            told = run("run", self.folder / f"{scene}.yaml", *words, "--set", "run.samples=64", "-o", self.folder / "lag.csv")
            self.assertEqual(told[0], 0, told[2])
            script, curves = self.plot("--kind", "lag", "--from", 0, name="lag.csv")
            (_, pieces), = [curve for some in curves.values() for curve in some if curve[0] == "panel1-curve1"]
            steepest = max(abs(rate) for piece in pieces for _, rate in piece)
            for piece in pieces:
                for before, here, after in zip(piece, piece[1:], piece[2:]):
                    slope = (after[0] - before[0]) / 360 * 64 * hertz / 2
                    self.assertLess(abs(slope - here[1]), 0.02 * steepest, (scene, hertz))
            self.assertTrue(locked is None or (len(pieces) == 1) == locked)
            if locked:  # sin(lag) = C w/Om0^2 at rest; drag makes it slip, by less than a tenth
                self.assertLess(abs(pieces[0][-1][1]), 1e-3 * steepest)
                self.assertLess(abs(math.sin(math.radians(pieces[0][-1][0])) / (5 / 7.23) - 1), 0.1)
                self.assertIn("drive.frequency 5 Hz", script)
        lines = (self.folder / "lag.csv").read_text(encoding="utf-8").splitlines()
        first = next(i for i, line in enumerate(lines) if not line.startswith("#")) + 1
        place = [word.split(" [")[0] for word in lines[first - 1].split(",")].index("nX_0")
        upright = [line if line.startswith("#") else ",".join([*line.split(",")[:place], "0,0,1", *line.split(",")[place + 3:]])
                   for line in lines[first:]]
        (self.folder / "upright.csv").write_text("\n".join([*lines[:first], *upright]) + "\n", encoding="utf-8")
        self.refused("lies along the z axis all the time", "--kind", "lag", name="upright.csv")
        self.refused("is of one bead in a world, and this trajectory is of 3", "--kind", "lag")

    def test_the_lag_is_behind_the_field_at_the_bead(self):
        """Behind the field of crossed coils, not the drive's phase; and the angle between both where the field is upright."""
        coil = "{{radius: 5 m, centre: [0,0,0], axis: {}, turns: 1000, {}}}"
        crossed = coil.format("[1,0,0]", "ac: 1 A, frequency: 4 Hz") + ", " + coil.format("[0,1,0]", "ac: 1 A, frequency: 4 Hz, phase: -70 deg")
        free = "plate: {shape: none, gravity: 0, radius: 10 m}\nmedium: {spin_drag_rate: 40 1/s, drag_rate: 5 1/s}\n"
        start = "start: {position: [0,0,0.1 m], n: [1,0,0.5], velocity: [0,0,0], angular_velocity: [0,0,0]}\n"
        for name, coils, axis in ("crossed", crossed, "about z"), ("upright", coil.format("[0,0,1]", "current: 1 A"), "angle between"):
            (self.folder / f"{name}.yaml").write_text(
                "bead: {radius: 2 mm, density: 7.5 g/cm^3, remanence: 1.2 T}\nmagnet: {shape: parts, depth: 10 mm}\n"
                f"coils: [{coils}]\ndrive: {{frequency: 3 Hz}}\nrun: {{periods: 4, discard: 2, samples: 32}}\n{free}{start}", encoding="utf-8")
            told = run("run", self.folder / f"{name}.yaml", "-o", self.folder / "lag.csv")
            self.assertEqual(told[0], 0, told[2])
            script, curves = self.plot("--kind", "lag", "--from", 2, name="lag.csv")
            self.assertIn(axis, script)
            (_, (piece,)), = [curve for some in curves.values() for curve in some if curve[0] == "panel1-curve1"]
            rows = [row for row in read(self.folder / "lag.csv") if row["t"] / GAMMA * 3 >= 2 - 1e-9]
            for row, (angle, _) in zip(rows, piece, strict=True):
                turned = 8 * math.pi * row["t"] / GAMMA
                field = math.atan2(math.cos(turned - math.radians(70)), math.cos(turned))
                wanted = (math.atan2(row["nY_0"], row["nX_0"]) - field if name == "crossed" else math.acos(row["nZ_0"]))
                self.assertAlmostEqual(math.remainder(math.radians(angle) - wanted, 2 * math.pi), 0, delta=1e-5, msg=name)
            self.assertEqual(name == "crossed", min(angle for angle, _ in piece) < -10, name)
        # on a plate, and in a bowl, heights are others than those of the field; a run starts with n along B
        for shape in ((), ("--set", "plate.shape=bowl", "--set", "plate.bowl_radius=150 mm")):
            told = run("run", "--set", "world.frame=laboratory", "--set", "run.periods=2", "--set", "run.discard=1", *shape, "-o",
                       self.folder / "lag.csv")
            self.assertEqual(told[0], 0, told[2])
            _, curves = self.plot("--kind", "lag", "--from", 0, name="lag.csv")
            (_, (piece, *_)), = [curve for some in curves.values() for curve in some if curve[0] == "panel1-curve1"]
            self.assertAlmostEqual(piece[0][0], 0, delta=1e-6)

    def test_every_drive(self):
        """A trajectory is drawn whole, and from one period of the drive to the next, also where the magnet turns back."""
        self.assertEqual(run("init", "--world", "wave", self.folder / "travels.yaml")[0], 0)
        for words, hertz in ((("drive.waveform=oscillating",), 10.7), (("drive.waveform=chirp", "drive.chirp=5"), 10.7),
                             (("drive.waveform=table", "drive.table=0:0 0.1:90 0.2:0"), 10.7),
                             (("drive.waveform=carried", "drive.velocity[0]=0.01"), 10.7), (("drive.frequency=4",), 4)):
            scene = (self.folder / "travels.yaml",) if hertz == 4 else ()
            sets = [word for setting in (*words, "run.duration=0.6s", "run.discard=1", "run.samples=32") for word in ("--set", setting)]
            told = run("run", *scene, *sets, "-o", self.folder / "drive.csv")
            self.assertEqual(told[0], 0, told[2])
            rows = read(self.folder / "drive.csv")
            some = [row for row in rows if 0.5 - 1e-9 <= row["t"] / GAMMA * hertz <= 1.5 + 1e-9]
            for options, shown in ((), rows), (("--from", 0.5, "--to", 1.5), some):
                script, curves = self.plot(*options, name="drive.csv")
                self.assertNotIn("anticlockwise", script)
                (_, pieces), = curves["bead 1"]
                for point, row in ((pieces[0][0], shown[0]), (pieces[-1][-1], shown[-1])):
                    self.assertAlmostEqual(math.hypot(*point), 23 * math.hypot(row["X_0"], row["Y_0"]), delta=1e-3, msg=words)

    def test_refusals(self):
        self.refused("--quantity does not belong to a trajectory of several beads", "--quantity", "slip")
        self.refused("--inset does not belong", "--inset")
        self.refused("--no-arrows does not belong", "--no-arrows")
        self.refused("--quantity does not belong", "--kind", "groups", "--quantity", "r")
        self.refused("figures of their path and of their groups", "--kind", "time")
        self.refused("--zoom does not belong to this kind", "--kind", "groups", "--zoom", "0,1,0,1")
        self.refused("no bead is in the zoom", "--zoom", "50,60,50,60")
        self.refused("choose one of lab, magnet", "--frame", "moon")
        self.refused("the trajectory covers the drive periods 0 to 6", "--kind", "groups", "--from", 8)
        self.refused("fewer than two samples", "--from", 8)
        status, _, messages = run("run", "--set", "run.periods=3", "--set", "run.discard=1", "-o", self.folder / "one.csv")
        self.assertEqual(status, 0, messages)
        self.refused("a figure of groups is of several beads", "--kind", "groups", name="one.csv")
        self.refused("a figure of the lag is of a bead in a world", "--kind", "lag", name="one.csv")

    def test_damaged_files(self):
        """A row cut short, a number that is none, times that fall, a file of another kind."""
        lines = (self.folder / "t.csv").read_text(encoding="utf-8").splitlines()
        first = next(i for i, line in enumerate(lines) if not line.startswith("#")) + 1
        names = [word.split(" [")[0] for word in lines[first - 1].split(",")]
        cells = lines[first + 3].split(",")
        cells[names.index("X_1")] = "nan"
        harmed = {"cut": lines[:first + 3] + [lines[first + 3][:40]],
                  "nan": lines[:first + 3] + [",".join(cells)] + lines[first + 4:],
                  "falls": lines[:first + 3] + [lines[first]] + lines[first + 3:],
                  "empty": lines[:first]}
        for name, text in harmed.items():
            (self.folder / "bad.csv").write_text("\n".join(text) + "\n", encoding="utf-8")
            for kind in ("path", "groups"):
                status, out, messages = run("plot", self.folder / "bad.csv", "-o", self.folder / "no.svg", "--kind", kind)
                self.assertEqual((status, out), (2, ""), (name, messages))
                self.assertIn("bad.csv", messages)
                self.assertEqual(messages.count("\n"), 1, messages)
        (self.folder / "bad.h5").write_bytes(b"\x89HDF\r\n\x1a\n" + bytes(4000))
        self.assertNotIn(run("plot", self.folder / "bad.h5", "-o", self.folder / "no.svg")[0], (0, -11))


if __name__ == "__main__":
    if not shutil.which("gnuplot"):
        sys.exit(77)
    unittest.main()
