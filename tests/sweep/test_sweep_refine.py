"""Refined sweeps: which points they compute, that their rows are those of the whole sweep, that nothing depends on
threads, kills or the way there, and what is drawn between the points.

The rules of src/sweep/refine.c are written here a second time, in the plainest way: applied to the rows of the whole
sweep until nothing changes.  Environment: FESTOON is the program, SOURCE_DIR the source tree.

tests: sweep/refine.c sweep/refined.c sweep/filled.c"""

import csv
import io
import itertools
import json
import os
import re
import resource
import signal
import sqlite3
import subprocess
import unittest

import events
from sweep_tools import FESTOON, Case, change, content_of, festoon

CHEAP = ["--set", "run.periods=8", "--set", "run.discard=4", "--set", "run.rtol=1e-6", "--portable"]


def over(*axes):
    return [word for axis in axes for word in ("--over", axis)]


# Beyond the plate's edge runs cannot begin: their rows have no regime, which is a value like the others.
MAP = [*CHEAP, "--set", "plate.radius=6cm", *over("start.r=0.3:2.9:33", "model.kappa=0.2:2:22")]


class Grid:
    """The points of a map over ranges of these lengths, and what the rules make of their values."""

    def __init__(self, counts, levels, values, step=None):
        self.counts, self.levels, self.values, self.step = counts, levels, values, step
        self.axes = range(len(counts))
        self.divided = set()
        self.exist = {(0, place) for place in itertools.product(*[range(0, n - 1, 2**levels) for n in counts])}
        before = -1
        while before != len(self.divided):
            before = len(self.divided)
            for level, place in list(self.exist):
                if self.differs(level, place):
                    self.follow(level, place)
        self.points = set().union(*[self.corners(*cell) for cell in self.exist])

    def corners(self, level, place):
        width = 2 ** (self.levels - level)
        return set(itertools.product(*[(place[a], min(place[a] + width, self.counts[a] - 1)) for a in self.axes]))

    def differs(self, level, place):
        values = {self.values[corner] for corner in self.corners(level, place)}
        if self.step is None or None in values:
            return len(values) > 1
        return max(values) - min(values) > self.step

    def inside(self, place):
        return all(0 <= place[a] < self.counts[a] - 1 for a in self.axes)

    def divide(self, level, place):
        """Divide the cell of this level that is or contains the place, and all those that contain it."""
        for above in range(level + 1):
            width = 2 ** (self.levels - above)
            whole = tuple(at // width * width for at in place)
            self.divided.add((above, whole))
            for part in itertools.product(*[(at, at + width // 2) for at in whole]):
                if self.inside(part):
                    self.exist.add((above + 1, part))

    def follow(self, level, place):
        width = 2 ** (self.levels - level)
        if level < self.levels:
            self.divide(level, place)
        for near in itertools.product(*[(at - width, at, at + width) for at in place]):
            if level > 0 and self.inside(near):
                self.divide(level - 1, near)

    def filled(self):
        """What is known of the points that are not computed: of a cell whose corners agree, their value."""
        known = {}
        for cell in self.exist - self.divided:
            corners = self.corners(*cell)
            values = {self.values[corner] for corner in corners}
            if len(values) == 1:
                ranges = [range(min(c[a] for c in corners), max(c[a] for c in corners) + 1) for a in self.axes]
                known.update({point: next(iter(values)) for point in itertools.product(*ranges)})
        return {point: value for point, value in known.items() if point not in self.points and value is not None}


def places(counts):
    return list(itertools.product(*[range(n) for n in counts]))


class RefineCase(Case):
    WHOLE, HEADS = {}, {}

    def whole(self, words):
        """The rows of the whole sweep as they are exported, by point, computed once."""
        key = tuple(words)
        if key not in self.WHOLE:
            self.good("sweep", *words, "-o", self.path("whole.db"))
            self.WHOLE[key] = self.lines("whole.db")
            self.HEADS[key] = self.rows("whole.db").splitlines()[0]
            os.remove(self.path("whole.db"))
        return self.WHOLE[key]

    def lines(self, name):
        """Exported lines by point."""
        text = self.rows(name)
        return {int(row["point"]): line for row, line in
                zip(csv.DictReader(io.StringIO(text)), text.splitlines()[1:])}

    def values(self, words, key):
        lines = self.whole(words)
        place = next(csv.reader([self.HEADS[tuple(words)]])).index(key)
        return {point: next(csv.reader([line]))[place] or None for point, line in lines.items()}

    def sweep(self, name, words, *options):
        return json.loads(self.good("sweep", *words, *options, "--json", "-o", self.path(name)))


class Points(RefineCase):
    def check_islands(self, grid, wrong):
        """What is missed are whole islands: no point of one is computed."""
        for start in wrong:
            island, fresh = {start}, [start]
            while fresh:
                row, column = fresh.pop()
                for near in ((row - 1, column), (row + 1, column), (row, column - 1), (row, column + 1)):
                    if near not in island and grid.values.get(near, "outside") == grid.values[start]:
                        island.add(near)
                        fresh.append(near)
            self.assertFalse(island & grid.points)

    def check(self, name, grid, told, words):
        """The rows are those of the whole sweep at the points of the grid, bit by bit."""
        numbers = {point: i for i, point in enumerate(places(grid.counts))}
        expected = {numbers[point]: self.whole(words)[numbers[point]] for point in grid.points}
        self.assertEqual(self.lines(name), expected)
        self.assertEqual((told["computed"], told["rows"]), (len(expected), len(expected)))

    def test_a_map_of_regimes(self):
        counts = (33, 22)
        values = dict(zip(places(counts), self.values(MAP, "regime").values()))
        sizes = []
        for levels in (1, 3):
            grid = Grid(counts, levels, values)
            told = self.sweep(f"{levels}.db", MAP, "--refine", str(levels))
            self.check(f"{levels}.db", grid, told, MAP)
            sizes.append(told["computed"])
            wrong = [point for point, value in grid.filled().items() if value != values[point]]
            self.assertLessEqual(len(wrong), {1: 2, 3: 15}[levels])  # measured: 1 and 9
            self.check_islands(grid, wrong)
        self.assertLess(sizes[1], sizes[0])
        self.assertLess(sizes[0], 0.7 * len(values))

    def test_a_number_along_one_axis(self):
        """Of 70 points the last one is not a multiple of 8."""
        words = [*CHEAP, *over("drive.frequency=1Hz:40Hz:70")]
        values = [None if v is None else float(v) for v in self.values(words, "mean_r").values()]
        grid = Grid((70,), 3, dict(zip(places((70,)), values)), 0.1)
        told = self.sweep("a.db", words, "--refine", "3", "--refine-by", "mean_r:0.1")
        self.check("a.db", grid, told, words)
        self.assertLess(told["computed"], 60)

    def test_where_the_symmetry_changes(self):
        """Around the period halving at 13.37 Hz, where S1, S2 and runs that do not tell are three values."""
        words = ["--set", "run.periods=160", "--set", "run.discard=100", "--portable", *over("drive.frequency=12Hz:16Hz:33")]
        values = dict(zip(places((33,)), self.values(words, "symmetry").values()))
        self.assertEqual(set(values.values()), {"S1", "S2", None})
        grid = Grid((33,), 3, values)
        told = self.sweep("a.db", words, "--refine", "3", "--refine-by", "symmetry")
        self.check("a.db", grid, told, words)
        lines = self.good("export", self.path("a.db"), "--csv", "--quantity", "symmetry").splitlines()[1:]
        self.assertEqual({line.split(",")[1] for line in lines}, {"S1", "S2", ""})
        self.assertLess(told["computed"], 30)
        festoons = self.values(words, "festoons")  # known where the symmetry is
        self.assertEqual([value is None for value in festoons.values()], [value is None for value in values.values()])

    def test_a_change_in_the_last_cell(self):
        """The last cell is narrower, and its last corner the last point that is computed: only that one is off the plate."""
        words = [*CHEAP, "--set", "plate.radius=6cm", *over("start.r=0.3:2.65:22")]
        grid = Grid((22,), 3, dict(zip(places((22,)), self.values(words, "regime").values())))
        told = self.sweep("a.db", words, "--refine", "3", "--threads", "1", "--lanes", "1")
        self.check("a.db", grid, told, words)
        self.assertIn((20,), grid.points)

    def test_a_range_of_two_points(self):
        """Beside a long one; both of its points are coarse."""
        counts = (33, 2)
        words = [*CHEAP, *over("drive.frequency=3Hz:40Hz:33", "model.kappa=0.3:2:2")]
        values = self.values(words, "regime").values()
        self.assertGreater(len(set(values)), 1)
        grid = Grid(counts, 2, dict(zip(places(counts), values)))
        told = self.sweep("a.db", words, "--refine", "2")
        self.check("a.db", grid, told, words)
        self.assertLess(len(grid.points), 66)

    def test_three_ranges_and_a_list(self):
        """Each value of the list is refined by itself."""
        words = [*CHEAP, "--set", "plate.radius=3cm",
                 *over("drive.frequency=2Hz:30Hz:7", "model.dynamics=rigid,farago2020", "model.kappa=0.2:2:6",
                       "start.r=0.2:1.5:5")]
        values = list(self.values(words, "regime").values())
        told = self.sweep("a.db", words, "--refine", "1")
        expected = {}
        numbers = {point: i for i, point in enumerate(places((7, 2, 6, 5)))}
        for kind in range(2):
            own = {(a, b, c): values[numbers[a, kind, b, c]] for a, b, c in places((7, 6, 5))}
            for a, b, c in Grid((7, 6, 5), 1, own).points:
                expected[numbers[a, kind, b, c]] = self.whole(words)[numbers[a, kind, b, c]]
        self.assertEqual(self.lines("a.db"), expected)
        self.assertEqual(told["computed"], len(expected))


class OneOutcome(RefineCase):
    """Whatever happens on the way, the rows are the same."""

    STRAIGHT = []

    def setUp(self):
        super().setUp()
        if not self.STRAIGHT:
            self.sweep("straight.db", MAP, "--refine", "3", "--threads", "1")
            self.STRAIGHT.extend((content_of(self.path("straight.db")), self.rows("straight.db")))
        with open(self.path("straight.db"), "wb") as file:
            file.write(self.STRAIGHT[0])
        self.expected = self.STRAIGHT[1]

    def test_threads_and_lanes(self):
        for words in (["--threads", "5"], ["--threads", "2"]):
            self.sweep("a.db", MAP, "--refine", "3", *words)
            self.assertEqual(self.rows("a.db"), self.expected)
            os.remove(self.path("a.db"))

    def test_kills(self):
        path, words = self.path("cut.db"), [FESTOON, "sweep", *MAP, "--refine", "3", "-o", self.path("cut.db")]
        struck = 0
        for wanted in (1, 60, 150, 300):
            process = events.start(words)
            events.wait_for(process, lambda: events.rows(path) >= wanted)
            process.send_signal(signal.SIGINT if wanted == 150 else signal.SIGKILL)
            status = process.wait()
            struck += status in (-signal.SIGKILL, 130)
        self.assertGreater(struck, 0)
        told = self.sweep("cut.db", MAP, "--refine", "3")
        self.assertEqual(self.rows("cut.db"), self.expected)
        self.assertEqual(told["computed"], told["rows"])

    def test_rows_that_are_lost(self):
        base = sqlite3.connect(self.path("straight.db"))
        base.execute("DELETE FROM rows WHERE point % 3 = 1")
        base.commit()
        base.close()
        self.sweep("straight.db", MAP, "--refine", "3")
        self.assertEqual(self.rows("straight.db"), self.expected)

    def test_going_on_otherwise(self):
        """A finer start, another key and the whole sweep go on with the rows that are there."""
        finer = self.sweep("finer.db", MAP, "--refine", "1")
        told = self.sweep("straight.db", MAP, "--refine", "1")
        self.assertEqual(told["computed"], finer["computed"])
        self.assertLess(told["added"], finer["added"])
        self.assertEqual(self.rows("straight.db"), self.rows("finer.db"))
        coarse = self.sweep("straight.db", MAP, "--refine", "3")
        self.assertEqual((coarse["added"], coarse["rows"]), (0, told["rows"]))
        self.sweep("straight.db", MAP, "--refine", "3", "--refine-by", "mean_r:0.1")
        told = self.sweep("straight.db", MAP)
        self.assertEqual((told["computed"], told["rows"]), (told["points"], told["points"]))
        self.assertEqual(self.lines("straight.db"), self.whole(MAP))
        told = self.good("export", "--quantity", "regime", "--csv", self.path("straight.db"))
        self.assertEqual(told.count("\n"), 33 * 22 + 1)

    def test_a_damaged_line(self):
        change(self.path("straight.db"), "UPDATE festoon SET value = replace(value, '3', '2') WHERE key = 'refine'")
        for words in (("sweep", *MAP, "--refine", "3", "-o"), ("plot",), ("export", "--quantity", "regime", "--csv")):
            words = (*words, self.path("straight.db")) + (("-o", self.path("x.svg")) if words == ("plot",) else ())
            self.assertIn("damaged", self.refused(*words))

    def test_the_line_of_another_sweep(self):
        other = ["--over", "start.r=0.3:2.9:9", *CHEAP]
        self.sweep("other.db", other, "--refine", "2")
        change(self.path("straight.db"), f"ATTACH '{self.path('other.db')}' AS other", "UPDATE festoon SET value = (SELECT "
               "value FROM other.festoon WHERE key = 'refine') WHERE key = 'refine'")
        self.assertIn("damaged", self.refused("export", "--quantity", "regime", "--csv", self.path("straight.db")))


class Terminal(RefineCase):
    """The line of progress while the set of points grows, and Ctrl-C there."""

    LINE = (r"([0-9.]+) %(?:  ([0-9]+) (s|min) left)?  ([0-9]+) of ((?:now )?about )?([0-9]+) points, "
            r"([0-9.e+-]+) a second")

    def check_lines(self, text):
        """Each line agrees with itself; how many points there will be is said to be an estimate, and where the part
        that is done falls the line says that there are more points now. Returns how many lines there were."""
        lines = re.findall(self.LINE, text)
        most = known = 0
        for percent, left, unit, computed, about, total, rate in lines:
            part = int(computed) / int(total)
            self.assertAlmostEqual(float(percent), 100 * part, delta=0.06)
            self.assertIn(about, ("now about ",) if part < most else ("about ", "now about "))  # not all parts are shown
            self.assertGreaterEqual(int(computed), known)
            if left and unit == "s" and float(rate) > 0:
                self.assertAlmostEqual(int(left), (int(total) - int(computed)) / float(rate), delta=1 + 0.01 * int(left))
            most, known = max(most, part), int(computed)
        return len(lines)

    def test_the_line_and_ctrl_c(self):
        found = []

        def words(periods):
            return ["sweep", *MAP, "--set", f"run.periods={periods}", "--refine", "2", "--threads", "1", "-o"]

        def blow(periods):
            found[:] = events.on_a_terminal([FESTOON, *words(periods), self.path(f"{periods}.db")],
                                            lambda text: text.count(" a second") >= 2, as_key=True)
            return found[0] == 130
        periods = events.struck(blow, 30)
        status, out, text = found
        self.assertEqual((status, out), (130, b""))
        self.assertGreaterEqual(self.check_lines(text), 2)
        told = re.search(r"interrupted with ([0-9]+) of about ([0-9]+) points done; the same command goes on", text)
        path = self.path(f"{periods}.db")
        self.assertEqual(int(told[1]), events.rows(path))
        self.assertLess(int(told[1]), int(told[2]))
        status, out, text = events.on_a_terminal([FESTOON, *words(periods), path], lambda text: False)
        self.assertEqual(status, 0, text)
        self.check_lines(text)
        self.good(*words(periods), self.path("straight.db"))
        self.assertEqual(self.rows(f"{periods}.db"), self.rows("straight.db"))


class Adversity(RefineCase):
    WORDS = ["sweep", *CHEAP, *over("drive.frequency=3Hz:40Hz:65", "model.kappa=0.3:2:5"), "--refine", "1", "-o"]
    STRAIGHT = []

    def test_other_results_or_another_scene(self):
        """Such a file is refused and stays as it is, its line `refine` too."""
        words = [*CHEAP, *over("model.kappa=1:2:9"), "--refine", "1"]
        self.sweep("a.db", words)
        for other in (["--set", "bead.radius=3mm"], ["--over", "start.r=1:2:5"], ["--seed", "3"]):
            self.assertIn("was made with", self.refused("sweep", *words, *other, "-o", self.path("a.db")))
        change(self.path("a.db"), "UPDATE festoon SET value = value - 1 WHERE key = 'results_version'")
        for options in ([], ["--refine-by", "mean_r:0.1"]):
            message = self.refused("sweep", *words, *options, "-o", self.path("a.db"))
            self.assertRegex(message, "results_version")

    def check_goes_on(self, path, spoilt):
        """`spoilt(size)` runs the sweep where its file cannot grow beyond so many kilobytes.  What was committed stays,
        and more room gets further; how much room that takes depends on the machine, for a commit has the rows of half a
        second, or 256."""
        kept = []
        for doublings in range(6):
            status, out, err = spoilt(90 << doublings)
            if status != 0 or not kept:
                self.assertEqual((status, out), (1, ""), err)
                self.assertRegex(err, "the disk is full.*make room|files may have [0-9]+ bytes at most here.*ulimit -f")
            kept.append(self.good("export", path, "--csv").count("\n") - 1)
            if kept[-1] > kept[0]:
                break
        self.assertEqual(kept, sorted(kept))
        self.assertGreater(kept[-1], kept[0])
        if not self.STRAIGHT:
            self.good(*self.WORDS, self.path("whole.db"))
            self.STRAIGHT.append(self.rows("whole.db"))

    def test_a_limit_of_file_sizes(self):
        path = self.path("a.db")

        def spoilt(size):
            return festoon(*self.WORDS, path, preexec_fn=lambda: resource.setrlimit(
                resource.RLIMIT_FSIZE, (1024 * size // 2, 1024 * size // 2)))
        self.check_goes_on(path, spoilt)
        self.good(*self.WORDS, path)
        self.assertEqual(self.rows("a.db"), self.STRAIGHT[0])

    def test_a_full_disk(self):
        place = self.path("small")
        os.mkdir(place)
        if os.getuid() != 0 or subprocess.run(["mount", "-t", "tmpfs", "-o", "size=100k", "none", place],
                                              stderr=subprocess.DEVNULL).returncode != 0:
            self.skipTest("a small file system needs root")
        self.addCleanup(subprocess.run, ["umount", place], check=True)
        path = os.path.join(place, "a.db")

        def spoilt(size):
            subprocess.run(["mount", "-o", f"remount,size={size}k", place], check=True)
            return festoon(*self.WORDS, path)
        self.check_goes_on(path, spoilt)
        subprocess.run(["mount", "-o", "remount,size=64m", place], check=True)
        self.good(*self.WORDS, path)
        self.assertEqual(self.good("export", path, "--csv"), self.STRAIGHT[0])

    def test_a_number_that_no_run_has(self):
        """Runs on the plate have no impacts: nothing is divided, and the program says so."""
        words = ["sweep", *CHEAP, *over("model.kappa=1:2:17"), "--refine", "2", "--json", "-o", self.path("a.db")]
        status, out, err = festoon(*words, "--refine-by", "impacts_per_return:0.1")
        self.assertEqual((status, json.loads(out)["computed"]), (0, 5))
        self.assertIn("impacts_per_return has no value in any of the 5 rows, so nothing was refined", err)
        status, out, err = festoon(*words, "--quiet")
        self.assertEqual((status, err), (0, ""))


class Refusals(RefineCase):
    def test_what_cannot_be_refined(self):
        for axes, options, part in (
                (["model.kappa=1:2:33"], ["--refine", "0"], "--refine"),
                (["model.kappa=1:2:33"], ["--refine", "5"], "from 1 to 4"),
                (["model.kappa=1:2:4"], ["--refine", "1"], "5 points"),
                (["model.kappa=1:2:2", "start.r=1,2,3,4,5,6"], ["--refine", "1"], "5 points"),
                (["model.kappa=1,2,3,4,5"], ["--refine", "1"], "nothing to refine"),
                (["model.kappa=1:2:random:40"], ["--refine", "1"], "random"),
                (["model.kappa=1:2:9", "start.r=1:2:9", "start.phi=1:2:9", "drive.frequency=1:2:9"],
                 ["--refine", "1"], "3 ranges at most"),
                (["model.kappa=1:2:30000", "start.r=1:2:30000"], ["--refine", "1"], "begin coarser"),
                (["model.kappa=1:2:33"], ["--refine", "2", "--carry", "up"], "carried"),
                (["model.kappa=1:2:33"], ["--refine-by", "regime"], "--refine N"),
                (["model.kappa=1:2:33"], ["--refine", "2", "--refine-by", "mean_q:1"], "nearest is mean_r"),
                (["model.kappa=1:2:33"], ["--refine", "2", "--refine-by", "reason"], "a text"),
                (["model.kappa=1:2:33"], ["--refine", "2", "--refine-by", "model.kappa:0.1"], "a parameter"),
                (["model.kappa=1:2:33"], ["--refine", "2", "--refine-by", "mean_r"], "by how much"),
                (["model.kappa=1:2:33"], ["--refine", "2", "--refine-by", "regime:1"], "no step"),
                (["model.kappa=1:2:33"], ["--refine", "2", "--refine-by", "mean_r:0"], "positive")):
            self.assertIn(part, self.refused("sweep", *over(*axes), *options, "-o", self.path("a.db")))
            self.assertEqual(os.listdir(self.directory), [])


class Figures(RefineCase):
    def boxes(self, name, *options):
        """The boxes of each block of a figure's data."""
        self.good("plot", self.path(name), *options, "-o", self.path("figure.svg"))
        blocks = {}
        for text in content_of(self.path("figure.dat"), "r").split("\n\n\n"):
            name, _, *lines = text.strip("\n").split("\n")
            blocks[name[2:]] = [[float(word) for word in line.split()] for line in lines if line]
        return content_of(self.path("figure.gp"), "r"), blocks

    def test_a_map(self):
        """Computed and filled cells cover the points that they should, each once, in their regime's one colour."""
        counts = (33, 22)
        values = dict(zip(places(counts), self.values(MAP, "regime").values()))
        grid = Grid(counts, 3, values)
        self.sweep("a.db", MAP, "--refine", "3")
        script, blocks = self.boxes("a.db")
        self.assertIn(f"{len(grid.points)} runs", script.replace("\\n", " "))
        self.assertIn("between runs that agree", " ".join(re.findall(r"set label '([^']*)' at", script)))
        computed = {point: values[point] for point in grid.points if values[point]}  # failed runs have no cell
        self.assertEqual(self.regimes(blocks, "cells"), {**grid.filled(), **computed})

    def regimes(self, blocks, kind):
        """The regimes in whose colours points of the map are painted."""
        names = ["undecided", "locked", "librating", "counter-rotating", "corotating", "chaotic", "ejected", "lifted"]
        found = {}
        for name, boxes in blocks.items():
            if not name.startswith(kind + "-"):
                continue
            for x, y, low, high, *_ in boxes:
                row, first = round((y - 0.3) / 2.6 * 32), round((x - 0.2) / 1.8 * 21)
                for i in range(first, round((high - 0.2) / 1.8 * 21 + 0.45)):
                    self.assertNotIn((row, i), found)
                    found[row, i] = names[int(name.split("-")[1])]
        return found

    def test_regimes_between_points_that_a_number_chose(self):
        """Where the corners of a cell are of two regimes nothing is painted between them."""
        counts = (33, 22)
        radii = {point: None if value is None else float(value)
                 for point, value in zip(places(counts), self.values(MAP, "mean_r").values())}
        grid = Grid(counts, 3, radii, 100.0)
        grid.values = dict(zip(places(counts), self.values(MAP, "regime").values()))
        self.sweep("a.db", MAP, "--refine", "3", "--refine-by", "mean_r:100")
        _, blocks = self.boxes("a.db")
        computed = {point: grid.values[point] for point in grid.points if grid.values[point]}
        self.assertEqual(self.regimes(blocks, "cells"), {**grid.filled(), **computed})

    def test_a_linear_number_is_interpolated_exactly(self):
        """The drive's frequency is itself such a number; the last cells are narrower along both axes."""
        words = [*CHEAP, *over("drive.frequency=10:12:9", "model.kappa=1:1.2:11")]
        told = self.sweep("a.db", words, "--refine", "2", "--refine-by", "mean_r:9")
        self.assertEqual(told["computed"], 3 * 4)
        _, blocks = self.boxes("a.db", "--quantity", "frequency_hz", "--units", "lab")
        self.assertEqual(len(blocks["cells"]), 9 * 11)
        for _, y, *_, value in blocks["cells"]:
            self.assertAlmostEqual(value, y, 4)

    def test_numbers_are_interpolated(self):
        self.sweep("a.db", MAP, "--refine", "3")
        script, blocks = self.boxes("a.db", "--quantity", "mean_r", "--units", "scaled")
        self.assertIn("interpolated", script)
        known = self.good("export", self.path("a.db"), "--csv", "--quantity", "mean_r").count("\n") - 1
        self.assertGreater(len(blocks["cells"]), 2 * known)

    def test_curves_show_the_points(self):
        words = [*CHEAP, *over("drive.frequency=1Hz:40Hz:70")]
        told = self.sweep("a.db", words, "--refine", "3")
        _, blocks = self.boxes("a.db", "--quantity", "mean_r")
        self.assertEqual(len(blocks["panel1-curve1"]), told["computed"])  # the other curve is of signs
        chosen = self.good("export", self.path("a.db"), "--csv", "--quantity", "mean_r")
        self.assertEqual(chosen.count("\n"), 1 + told["computed"])


if __name__ == "__main__":
    unittest.main()
