"""Measured fields through the program: magnet.shape: grid with maps as CSV, VTK and HDF5, from the program's own
`field --csv` and from others; what is wrong in a file is named with its line; a map that changed is refused.

tests: io/map_file.c io/map_csv.c io/map_points.c io/map_vtk.c io/map_hdf5.c io/hdf5_map.c io/map_write.c"""

import json
import math
import os
import random
import struct
import unittest

from sweep_tools import Case, festoon

SHORT = ["--set", "run.periods=12", "--set", "run.discard=4", "--set", "drive.omega=0.5"]
B0 = ["--set", "model.kappa=1.5", "--set", "magnet.b0=10mT"]
HEAD = "x [mm],y [mm],z [mm],Bx [mT],By [mT],Bz [mT]"


class Maps(Case):
    """Each test has a map of the five lines on a grid of 3 mm, and its samples."""

    def setUp(self):
        super().setUp()
        self.map = self.path("map.csv")
        self.good("field", *B0, "--csv", self.map, "--radius", "45mm", "--spacing", "3mm")
        with open(self.map) as file:
            self.lines = [line.strip() for line in file if not line.startswith("#")]
        self.rows = [[float(cell) for cell in line.split(",")] for line in self.lines[1:]]

    def write(self, name, text):
        with open(self.path(name), "w" if isinstance(text, str) else "wb") as file:
            file.write(text)
        return self.path(name)

    def over(self, path, *words):
        return ["--set", "magnet.shape=grid", "--set", f"magnet.file={path}", *B0, *words]

    def field(self, path, *words):
        return json.loads(self.good("field", *self.over(path), "--at", "0.43,-0.61", "--json", *words))

    def says(self, name, text, *sentences, words=()):
        path = self.write(name, text)
        status, out, err = festoon("run", *self.over(path), *words)
        self.assertEqual((status, out), (2, ""), err)
        for sentence in sentences:
            self.assertIn(sentence, err)

    def same(self, path):
        """The map gives the field of the CSV."""
        wanted, found = self.field(self.map), self.field(path)
        for a, b in zip(wanted["b"] + sum(wanted["grad"], []), found["b"] + sum(found["grad"], [])):
            self.assertAlmostEqual(a, b, delta=1e-12 * 10)


class Program(Maps):
    def test_round_trip(self):
        """A map of the lines at 1 mm gives the run of the lines."""
        fine = self.path("fine.csv")
        self.good("field", *B0, "--csv", fine, "--radius", "45mm", "--spacing", "1mm")
        exact = json.loads(self.good("run", *B0, *SHORT, "--json"))
        found = json.loads(self.good("run", *self.over(fine), *SHORT, "--json"))
        for key in ("mean_r", "std_r", "mean_alpha_dot", "max_b", "mean_friction_power"):
            self.assertAlmostEqual(exact[key], found[key], delta=1e-8 * abs(exact[key]), msg=key)
        self.assertEqual(found["regime"], exact["regime"])
        # And a map of that map is the map.
        again = self.path("again.csv")
        self.good("field", *self.over(fine), "--csv", again, "--radius", "20mm", "--spacing", "1mm")
        with open(fine) as one, open(again) as other:
            there = dict((line.rsplit(",", 3)[0], line) for line in one)
            for line in list(other)[2:]:
                place = line.rsplit(",", 3)[0]
                for a, b in zip(line.split(","), there[place].split(",")):
                    self.assertAlmostEqual(float(a), float(b), delta=1e-11)

    def test_commands(self):
        """The commands take it; at this omega the lines' bead circles backwards."""
        grid = self.over(self.map, *SHORT)
        orbit = json.loads(self.good("orbit", *grid, "--json"))
        lines = json.loads(self.good("orbit", *B0, *SHORT, "--json"))
        self.assertAlmostEqual(orbit["mean_r"], lines["mean_r"], delta=1e-3)
        self.assertTrue(self.good("locked", *grid, "--set", "drive.omega=0.1", "--json"))
        check = json.loads(self.good("check", *grid, "--json"))
        self.assertEqual(len(check["scene"]["magnet.checksum"]), 16)
        self.assertEqual(check["map"]["count"], [31, 31, 1])
        self.assertTrue(0 < check["map"]["curl"] < 1e-2, check["map"])
        self.assertIn("curl", self.good("check", *grid))
        turned = self.write("turned.csv", "\n".join(self.lines).replace("Bx", "B?").replace("By", "Bx").replace("B?", "By"))
        for words in (["check"], ["run", *SHORT], ["field", "--at", "0,0"]):
            told = festoon(*words, *self.over(turned))[2]
            self.assertIn("warning: the map of magnet.file has a curl", told)
            self.assertIn("exchanged?", told)
            self.assertNotIn("exchanged?", festoon(*words, *grid)[2])

    def test_its_poles_are_drawn(self):
        """Pictures of a measured field have the lines where B_z is half of its greatest, upwards and downwards; where
        the map is gone a path says so."""
        def content(name):
            with open(self.path(name), encoding="utf-8") as file:
                return file.read()

        def poles(name):
            texts = content(name).split("\n\n\n")
            named = {text.strip("\n").split("\n")[0][2:]: text for text in texts}
            return {pole: [[float(word) for word in line.split()] for line in named[pole].splitlines()
                           if line.strip() and not line.startswith("#")] for pole in ("north", "south")}

        self.good("field", *self.over(self.map), "-o", self.path("f.svg"), "--units", "scaled")
        found = poles("f.dat")
        for sign, pole in ((1, "north"), (-1, "south")):
            heights = [json.loads(self.good("field", *self.over(self.map), "--at", f"{x},{y}", "--json"))["b"][2]
                       for x, y in found[pole][:: max(1, len(found[pole]) // 4)]]
            self.assertGreater(sign * min(heights, key=abs), 0)
            self.assertLess(max(heights, key=abs) / min(heights, key=abs), 1.1)
        self.good("run", *self.over(self.map, *SHORT), "--csv", self.path("path.csv"))
        self.good("plot", self.path("path.csv"), "-o", self.path("p.svg"))
        turned = poles("p.dat")
        self.assertEqual({pole: len(turned[pole]) for pole in turned}, {pole: len(found[pole]) for pole in found})
        os.rename(self.map, self.map + ".gone")
        try:
            self.good("plot", self.path("path.csv"), "-o", self.path("p.svg"))
        finally:
            os.rename(self.map + ".gone", self.map)
        self.assertNotIn("# north", content("p.dat"))
        self.assertIn("without the poles", content("p.gp"))

    def test_where_the_map_ends(self):
        small = self.path("small.csv")
        self.good("field", *B0, "--csv", small, "--radius", "20mm", "--spacing", "2mm")
        result = json.loads(self.good("run", *self.over(small, "--set", "start.r=0.5"), "--json"))
        self.assertEqual(result["regime"], "undecided")
        self.assertIn("the bead left the disc that the map of magnet.file covers", result["reason"])
        status, out, err = festoon("orbit", *self.over(small, "--set", "start.r=0.5"))
        self.assertEqual((status, out), (1, ""))
        self.assertIn("leaves the map", err)
        for words in (["run", *self.over(small, "--set", "start.r=0.95")], ["field", *self.over(small), "--at", "0.9,0"]):
            self.assertEqual(festoon(*words)[:2], (2, ""))
        self.good("field", *self.over(small), "-o", self.path("small.svg"))

    def test_scenes_and_trajectories(self):
        """A path in a scene begins at the scene's folder; a trajectory knows its map's content."""
        os.mkdir(self.path("there"))
        scene = self.write("there/scene.yaml", "magnet:\n  shape: grid\n  file: ../map.csv\n")
        wanted = self.good("run", scene, *SHORT, "--json")
        found = self.good("run", "--set", "magnet.shape=grid", "--set", f"magnet.file={self.map}", *SHORT, "--json")
        self.assertEqual(json.loads(wanted)["final_state"], json.loads(found)["final_state"])
        track = self.path("track.csv")
        self.good("run", scene, *SHORT, "--csv", track)
        with open(track) as file:
            head = file.read(4000)
        self.assertIn("checksum:", head)
        self.assertIn('map.csv"', head)
        self.good("plot", track, "-o", self.path("track.svg"))

    def test_sweeps_know_their_map(self):
        base = self.path("sweep.db")
        words = ["--over", "drive.omega=0.5:0.6:3", "--set", "run.periods=4", "--set", "run.discard=2", "-o", base]
        self.good("sweep", *self.over(self.map), *words)
        rows = json.loads(self.good("export", base, "--json"))
        self.assertEqual({row["status"] for row in rows}, {"done"})
        self.good("sweep", *self.over(self.map), *words)
        moved = self.path("moved.csv")
        os.rename(self.map, moved)
        self.good("sweep", *self.over(moved), *words)  # the same content
        with open(moved, "a") as file:
            file.write("# another remark\n")
        status, out, err = festoon("sweep", *self.over(moved), *words)
        self.assertEqual((status, out), (2, ""))
        self.assertIn("magnet.checksum", err)
        status, out, err = festoon("sweep", *self.over(moved), "--over", "magnet.file=a,b", "-o", self.path("x.db"))
        self.assertEqual(status, 2)
        self.assertIn("magnet.file is a text", err)

    def test_checksum_of_a_scene(self):
        self.says("same.csv", "\n".join(self.lines), "has changed", words=["--set", "magnet.checksum=0123456789abcdef"])


class Tables(Maps):
    def test_any_order(self):
        """Rows and columns in any order, other units, other separators, a head as a comment, other columns."""
        turned = sorted(self.rows, key=lambda row: (row[0], -row[1]))
        self.same(self.write("a.csv", "\n".join([HEAD] + [",".join(map(repr, row)) for row in turned])))
        lines = ["# By (T); B_x [T];note;x [m];y [um];BZ [G]"] + [
            f"{row[4] / 1e3!r};{row[3] / 1e3!r};{i};{row[0] / 1e3!r};{row[1] * 1e3!r};{row[5] * 10!r}"
            for i, row in enumerate(self.rows)]
        self.same(self.write("b.csv", "\r\n".join(lines)))

    def test_wrong_tables(self):
        rows = self.lines[1:]
        table = lambda *lines: "\n".join(lines) + "\n"
        self.says("hole.csv", table(HEAD, *rows[:100], *rows[101:]), "a hole", "x = -24 mm, y = -36 mm")
        self.says("twice.csv", table(HEAD, *rows, rows[7]), f"twice.csv:{len(rows) + 2}", "first as line 9")
        self.says("nan.csv", table(HEAD, rows[0], rows[1].rsplit(",", 1)[0] + ",nan"), "nan.csv:3", "column 6 (Bz)",
                  "is not a number")
        self.says("uneven.csv", table(HEAD, *[",".join(["0.5" if row.split(",")[0] == "0" else row.split(",")[0],
                                                        *row.split(",")[1:]]) for row in rows]),
                  "unevenly spaced along x", "uneven.csv:")
        self.says("unit.csv", table(HEAD.replace("Bx [mT]", "Bx [mm]"), *rows), "unit.csv:1", "Bx", "unknown unit")
        self.says("none.csv", table(HEAD.replace("x [mm],y", "x,y"), *rows), "none.csv:1", "has no unit")
        self.says("missing.csv", table(HEAD.replace("By", "Bq"), *rows), "the column By is missing")
        self.says("double.csv", table(HEAD.replace("By", "Bx"), *rows), "column 5 (Bx): this column is there twice")
        self.says("cells.csv", table(HEAD, rows[0], rows[1] + ",3"), "cells.csv:3", "7 cells")
        self.says("empty.csv", "", "column names is missing")
        self.says("head.csv", HEAD, "no samples")
        self.says("few.csv", table(HEAD, *[row for row in rows if abs(float(row.split(",")[0])) < 9.5]),
                  "along x", "at least 8")
        self.says("height.csv", table(HEAD, *[row.replace(",18.7,", ",19,") for row in rows]), "taken at 19 mm")
        self.says("away.csv", table(HEAD, *[f"{float(row.split(',')[0]) + 60},{row.split(',', 1)[1]}" for row in rows]),
                  "does not surround the axis")
        self.says("map.doc", table(HEAD, *rows), "ends in .csv")
        self.says("bytes.csv", b"\0\xff\x01" * 100, "bytes.csv:1")

    def test_planes(self):
        """Of several planes the one at the bead's centre is taken."""
        other = [[row[0], row[1], 20.7, *[2 * b for b in row[3:]]] for row in self.rows]
        path = self.write("planes.csv", "\n".join([HEAD] + [",".join(map(repr, row)) for row in self.rows + other]))
        self.same(path)
        high = json.loads(self.good("field", *self.over(path), "--set", "magnet.depth=18.2mm", "--at", "0.43,-0.61",
                                    "--json"))
        for a, b in zip(high["b"], self.field(self.map)["b"]):
            self.assertAlmostEqual(a, 2 * b, delta=1e-11)


class Smooth(Maps):
    """field --smooth: charges below a noisy map, whose field is written as a map, or told with its errors."""

    def setUp(self):
        super().setUp()
        chance = random.Random(5)
        self.noise = 0.0025 * max(math.hypot(*row[3:]) for row in self.rows)
        rows = [row[:3] + [b + chance.gauss(0, self.noise) for b in row[3:]] for row in self.rows]
        self.noisy = self.write("noisy.csv", "\n".join([HEAD] + [",".join(map(repr, row)) for row in rows]))

    def told(self, *words):
        return json.loads(self.good("field", *self.over(self.noisy), "--smooth", "--at", "0.43,-0.61", "--json",
                                    "--units", "si", *words))

    def test_errors(self):
        told, exact = self.told(), self.field(self.map)
        for key, error in (("b", told["b_error"]), ("grad", sum(told["grad_error"], []))):
            there = exact[key] if key == "b" else sum(exact[key], [])
            found = told[key] if key == "b" else sum(told[key], [])
            for a, b, e in zip(there, found, error):
                self.assertLess(abs(a - b), 3.5 * e)
        for a, b, e in zip(exact["force"] + [exact["load"]], told["force"] + [told["load"]],
                           told["force_error"] + [told["load_error"]]):
            self.assertLess(abs(a - b), 3.5 * e)
            self.assertLess(e, 0.03 * max(map(abs, exact["force"])))
        self.assertAlmostEqual(told["load_error_newtons"] / told["load_error"],
                               told["load_newtons"] / told["load"], delta=1e-12)
        self.assertEqual(told["load_error_newtons"], told["force_error_newtons"][2])
        self.assertAlmostEqual(told["b_error_tesla"][0], 0.01 * told["b_error"][0], delta=1e-12)
        self.assertAlmostEqual(told["fit"]["noise_tesla"], 1e-3 * self.noise, delta=0.06e-3 * self.noise)
        self.assertNotIn("probe_turned_rad", told["fit"])
        self.assertFalse([key for key in self.field(self.noisy) if key == "fit" or "error" in key])
        text = self.good("field", *self.over(self.noisy), "--smooth", "--at", "0.43,-0.61", "--units", "lab")
        self.assertIn("+- X", text)
        self.assertRegex(text, r"\n\+- force [^ ]+ [^ ]+ [^ ]+ mN, load [^ ]+ mN\n")
        self.assertRegex(text, r"^\d+ charges from .* mm below the map on; .* chi\^2 of \d+ degrees")
        free = self.told("--probe", "--noise", f"{self.noise} mT")["fit"]
        self.assertAlmostEqual(free["noise_tesla"], 1e-3 * self.noise, delta=0.06e-3 * self.noise)
        for turned, error in zip(free["probe_turned_rad"], free["probe_turned_error_rad"]):
            self.assertLess(abs(turned), 3.5 * error)

    def test_a_written_map_is_one(self):
        """Other heights too; and a noise that was told too small is known by what is left."""
        name = self.path("smooth.csv")
        text = self.good("field", *self.over(self.noisy), "--smooth", "--csv", name, "--spacing", "3mm")
        self.assertIn("charges", text)
        with open(name) as file:
            lines = file.read().splitlines()
        self.assertIn("charges", lines[1])
        self.assertEqual(lines[2], HEAD + ",eBx [mT],eBy [mT],eBz [mT],e_slope [mT/mm]")
        self.assertEqual({len(line.split(",")) for line in lines[2:]}, {10})
        self.assertEqual(len(lines), 3 + len(self.rows))
        self.assertLess(json.loads(self.good("check", *self.over(name), "--json"))["map"]["curl"], 1e-3)
        self.assertIn("(festoon field --smooth)", festoon("check", *self.over(self.noisy))[2])
        warned = festoon("field", *self.over(self.noisy), "--smooth", "--at", "0,0")[2]  # it is what runs
        self.assertIn("has a curl of", warned)
        self.assertNotIn("--smooth", warned)
        run = json.loads(self.good("run", *self.over(name, *SHORT), "--json"))
        exact = json.loads(self.good("run", *B0, *SHORT, "--json"))
        self.assertAlmostEqual(run["mean_r"], exact["mean_r"], delta=0.01 * exact["mean_r"])
        for height in ("16.7mm", "24mm"):
            high = self.told("--height", height)
            there = json.loads(self.good("field", *B0, "--height", height, "--at", "0.43,-0.61", "--json"))
            for a, b, e in zip(there["b"], high["b"], high["b_error"]):
                self.assertLess(abs(a - b), 3.5 * e)
        small = self.told("--noise", f"{0.5 * self.noise} mT")["fit"]
        self.assertGreater(small["chi2_per_degree"], 3)
        self.assertGreater(small["noise_tesla"], 0.9e-3 * self.noise)

    def test_the_noise_told_is_judged(self):
        for times, verdict, words in ((0.5, "too small", "it is probably"), (1.0, "agrees", "with which"), (2.0, "too large", "it is probably")):
            told = ["--noise", f"{times * self.noise} mT"]
            fit = self.told(*told)["fit"]
            self.assertEqual(fit["noise_verdict"], verdict)
            self.assertAlmostEqual(fit["noise_told_tesla"], 1e-3 * times * self.noise, delta=1e-12)
            self.assertEqual(fit["chi2_bound"][0] < fit["chi2_per_degree"] < fit["chi2_bound"][1], verdict == "agrees")
            low, high = fit["noise_seen_bound_tesla"]
            self.assertTrue(low < 1e-3 * self.noise < high)
            self.assertTrue(low < fit["noise_seen_tesla"] < high)
            self.assertIn(words, fit["sentence"])
            text = self.good("field", *self.over(self.noisy), "--smooth", *told, "--at", "0,0")
            advice = "" if verdict == "agrees" else " (leave --noise away: the fit then finds the likeliest)"
            self.assertEqual(text.splitlines()[1], fit["sentence"] + advice)
        fit = self.told()["fit"]
        self.assertEqual((fit["noise_verdict"], fit["sentence"], fit["noise_told_tesla"]), ("not told", "", None))
        self.assertEqual(fit["chi2_bound"], [None, None])

    def test_drawn_fields(self):
        """Each is another map; their spread is that of the errors in the file of the likeliest."""
        name = self.path("smooth.csv")
        self.good("field", *self.over(self.noisy), "--smooth", "--csv", name, "--spacing", "9mm", "--draws", "24")
        read = lambda path: [[float(cell) for cell in line.split(",")] for line in open(path) if line[0] in "-0123456789"]
        likeliest, drawn = read(name), [read(self.path(f"smooth-{i}.csv")) for i in range(1, 25)]
        self.assertFalse(os.path.exists(self.path("smooth-25.csv")))
        squares = [((one[i][k] - row[k]) / row[k + 3]) ** 2 for one in drawn for i, row in enumerate(likeliest) for k in (3, 4, 5)]
        self.assertAlmostEqual(math.sqrt(sum(squares) / len(squares)), 1.0, delta=0.15)
        run = json.loads(self.good("run", *self.over(self.path("smooth-3.csv"), *SHORT), "--json"))
        self.assertGreater(run["mean_r"], 0)

    def test_what_is_wrong(self):
        at = ["--at", "0,0"]
        for words, sentence in (([*self.over(self.noisy), "--probe", *at], "give --smooth"),
                                ([*self.over(self.noisy), "--noise", "1mT", *at], "give --smooth"),
                                ([*self.over(self.noisy), "--smooth", "--draws", "3", *at], "give --csv"),
                                ([*self.over(self.noisy), "--smooth", "--csv", self.path("x.csv"), "--draws", "0"], "draws"),
                                ([*self.over(self.noisy), "--csv", self.path("x.csv"), "--draws", "3"], "give --smooth"),
                                ([*self.over(self.noisy), "--smooth", "--noise", "much", *at], "as in 0.05mT"),
                                ([*self.over(self.noisy), "--smooth", "--noise", "9T", *at], "a positive field"),
                                ([*self.over(self.noisy), "--smooth", "--height", "1mm", *at], "too near"),
                                ([*B0, "--smooth", *at], "has no map")):
            status, out, err = festoon("field", *words)
            self.assertEqual((status, out), (2, ""), err)
            self.assertIn(sentence, err)


class Vtk(Maps):
    def setUp(self):
        super().setUp()
        self.side = round(len(self.rows) ** 0.5)
        self.places = [row[0] for row in self.rows[:self.side]]
        self.vectors = [b for row in self.rows for b in row[3:]]

    def legacy(self, binary, even):
        n, numbers = self.side, lambda values: (struct.pack(f">{len(values)}d", *values) + b"\n" if binary else
                                                (" ".join(map(repr, values)) + "\n").encode())
        text = f"# vtk DataFile Version 3.0\na map\n{'BINARY' if binary else 'ASCII'}\n".encode()
        if even:
            text += (f"DATASET STRUCTURED_POINTS\nDIMENSIONS {n} {n} 1\nORIGIN {self.places[0]} {self.places[0]} 18.7\n"
                     f"SPACING 3 3 1\n").encode()
        else:
            text += f"DATASET RECTILINEAR_GRID\nDIMENSIONS {n} {n} 1\n".encode()
            for axis, places in zip("XYZ", (self.places, self.places, [18.7])):
                text += f"{axis}_COORDINATES {len(places)} double\n".encode() + numbers(places)
        return text + f"POINT_DATA {n * n}\nVECTORS B[mT,mm] double\n".encode() + numbers(self.vectors)

    def test_legacy(self):
        for binary in (False, True):
            for even in (False, True):
                self.same(self.write(f"legacy{binary}{even}.vtk", self.legacy(binary, even)))
        whole = self.legacy(True, False)
        self.says("cut.vtk", whole[:-50], "cut off")
        self.says("units.vtk", whole.replace(b"B[mT,mm]", b"B[mT,mT]"), "unit")
        self.says("metres.vtk", whole.replace(b"B[mT,mm]", b"B"), "VTK knows no units")
        self.says("kind.vtk", whole.replace(b"RECTILINEAR_GRID", b"POLYDATA"), "STRUCTURED_POINTS or RECTILINEAR_GRID")
        self.says("many.vtk", whole.replace(b"DIMENSIONS 31 31 1", b"DIMENSIONS 999999 999999 999999"), "larger")
        for count in (31 * 31 - 1, 31 * 31 + 1, 2 * 31 * 31):
            self.says("count.vtk", whole.replace(b"POINT_DATA 961", b"POINT_DATA %d" % count), "vectors on a grid of 961 samples")
        self.says("word.vtk", self.legacy(False, True).replace(b" 18.7\n", b" high\n"), "high")

    def test_xml(self):
        """A converter makes a legacy file of VTK's XML: the message names it."""
        for ending in ("vti", "vtr"):
            self.says("map." + ending, "<VTKFile/>", f"meshio convert map.{ending} map.vtk")


class Hdf5(Maps):
    def test_hdf5(self):
        try:
            import h5py
        except ImportError:
            self.skipTest("h5py is not here")
        side = round(len(self.rows) ** 0.5)
        places = [row[0] for row in self.rows[:side]]

        def make(name, units="mT", drop=None, shape=(side, side, 3)):
            with h5py.File(self.path(name), "w") as file:
                for axis, values in (("x", places), ("y", places), ("z", [18.7])):
                    if axis != drop:
                        file[axis] = values
                        file[axis].attrs["units"] = "mm"
                file.create_dataset("B", shape=shape, data=[b for row in self.rows for b in row[3:]])
                file["B"].attrs["units"] = units
            return self.path(name)

        status, out, err = festoon("field", *self.over(make("map.h5")), "--at", "0.1,0.2")
        if "lacks" in err or "without" in err:
            self.skipTest("this build has no HDF5")
        self.same(make("map.h5"))
        self.same(make("planes.h5", shape=(1, side, side, 3)))
        self.same(make("flat.h5", drop="z"))
        for name, words, sentence in (("unit.h5", {"units": "furlongs"}, "unknown units"),
                                      ("none.h5", {"drop": "y"}, "the data set y is missing"),
                                      ("shape.h5", {"shape": (side * side, 3)}, "has not the shape")):
            status, out, err = festoon("run", *self.over(make(name, **words)))
            self.assertEqual((status, out), (2, ""))
            self.assertIn(sentence, err)
        self.says("broken.h5", b"\x89HDF\r\n\x1a\n" + bytes(2000), "HDF5 cannot open")


if __name__ == "__main__":
    unittest.main()
