"""Magnets of parts through the program: sweeps over a number of a part, their files, figures and films, and maps.

tests: draw/poles.c draw/field_map.c cli/field.c"""
import json
import math
import unittest

from sweep_tools import Case, festoon

SCENE = """bead: {density: 7.5 g/cm^3}
magnet:
  shape: parts
  parts:
    - {kind: sphere, centre: [-15 mm, 0, 0], size: 12 mm, remanence: [0, 0, 1.1]}
    - kind: dipole
      centre: [15 mm, 1 mm, -1 mm]
      moment: [0, 0.1, -1]
run: {periods: 4, discard: 2, rtol: 1e-8}
"""
OVER = "magnet.parts[0].size[0]=10mm:14mm:3"


class Parts(Case):
    def setUp(self):
        super().setUp()
        self.scene = self.path("scene.yaml")
        with open(self.scene, "w") as file:
            file.write(SCENE)

    def rows(self, name):
        return json.loads(self.good("export", name, "--json"))

    def test_a_sweep_is_its_single_runs(self):
        name = self.path("s.db")
        self.good("sweep", self.scene, "--over", OVER, "--over", "magnet.parts[1].moment[2]=-1,1", "--portable", "-o",
                  name)
        rows = self.rows(name)
        self.assertEqual([row["magnet.parts[0].size[0]"] for row in rows], [0.01, 0.01, 0.012, 0.012, 0.014, 0.014])
        self.assertEqual(len({tuple(row["final_state"]) for row in rows}), 6)
        for row in rows:
            run = json.loads(self.good("run", self.scene, "--json", "--set",
                                       f"magnet.parts[0].size[0]={row['magnet.parts[0].size[0]']}", "--set",
                                       f"magnet.parts[1].moment[2]={row['magnet.parts[1].moment[2]']}"))
            for key in ("mean_r", "regime", "min_b"):
                self.assertEqual(row[key], run[key])
            self.assertEqual(row["final_state"], run["final_state"])
            self.assertEqual(run["scene"]["magnet.parts"][0]["size"], [row["magnet.parts[0].size[0]"]])

    def test_a_sweep_knows_its_parts(self):
        """The same command goes on, another magnet is refused with the number that differs, and the file stays."""
        name = self.path("s.db")
        words = ("sweep", self.scene, "--over", OVER, "-o", name)
        self.good(*words)
        before = self.rows(name)
        self.good(*words)
        for change, said in (("magnet.parts[1].moment[1]=0.2", "magnet.parts[1].moment[1] = 0.1"),
                             ("magnet.parts[2].kind=dipole", "magnet.parts[2].kind = (not given), not dipole"),
                             ("bead.density=8000", "bead.density = 7500")):
            err = self.refused("sweep", self.scene, "--set", change, "--over", OVER, "-o", name)
            self.assertIn(said, err)
            self.assertIn("left untouched", err)
        self.assertEqual(self.rows(name), before)

    def test_radius_is_physical(self):
        """Mass and moment go as R^3, and so does what the magnet does to the bead, beside its height."""
        small, large = (json.loads(self.good("field", self.scene, "--at", "10mm,3mm", "--height", "25mm", "--units", "si",
                                             "--set", f"bead.radius={radius}", "--json")) for radius in ("1mm", "2mm"))
        for k in range(3):
            self.assertAlmostEqual(large["force_newtons"][k] / small["force_newtons"][k], 8.0, places=10)
            self.assertEqual(large["b_tesla"][k], small["b_tesla"][k])

    def test_nothing_is_told_where_doubles_end(self):
        """A unit of fields that is 0, and a height whose powers are not doubles."""
        for unit in ("0", "1e-320"):
            err = self.refused("field", self.scene, "--at", "0,0", "--set", f"magnet.b0={unit}")
            self.assertIn("magnet.b0", err)
            self.assertIn("at least 1e-09 T", err)
        for height in ("1e300", "-1e60 mm"):
            err = self.refused("field", self.scene, "--at", "0,0", "--height", height)
            self.assertIn(f'--height: "{height}" is out of range: up to 1e+50 l', err)

    def test_results_in_si(self):
        """Beside the scaled numbers, and whatever B0 and l are, as long as the start is the same."""
        plain = json.loads(self.good("run", self.scene, "--json"))
        one = json.loads(self.good("run", self.scene, "--json", "--units", "si"))
        two = json.loads(self.good("run", self.scene, "--json", "--units", "si", "--set", "magnet.b0=0.3T", "--set",
                                   "magnet.half_length=46mm", "--set", "start.r=0.475"))
        self.assertEqual({key: one[key] for key in plain}, plain)
        added = sorted(set(one) - set(plain))
        for key in ("mean_b_tesla", "max_r_m", "mean_friction_power_watts", "min_load_newtons", "rms_slip_m_per_s"):
            self.assertIn(key, added)
            self.assertAlmostEqual(two[key] / one[key], 1.0, delta=1e-6)  # run.rtol is 1e-8
        self.assertAlmostEqual(one["mean_b_tesla"], 0.01 * one["mean_b"], delta=1e-15)
        self.assertAlmostEqual(one["min_load_newtons"], one["min_load_weights"] * 7500 * math.pi / 6 * 0.005 ** 3 * 9.81,
                               delta=1e-12)
        report = self.good("run", self.scene, "--units", "si")
        self.assertRegex(report, r"field <\|B\|> .* T\n")
        self.assertRegex(report, r"load on the plate .* N\n")
        self.assertRegex(report, r"power of the drive .* W\n")
        lines = json.loads(self.good("run", "--set", "run.periods=2", "--set", "run.discard=1", "--units", "si", "--json"))
        self.assertIsNone(lines["mean_b_tesla"])  # nothing says how strong the paper's magnet is

    def test_within_a_part(self):
        err = self.refused("field", self.scene, "--at", "-15mm,2mm", "--height", "3mm")
        for word in ("--at", "magnet.parts[0], a sphere", "-15 mm"):
            self.assertIn(word, err)
        self.good("field", self.scene, "--at", "-15mm,2mm", "--height", "-7mm")  # below it

    def test_parts_in_one_place_are_told(self):
        """The first pair, by whatever reads the scene; not of parts that touch, and not where one is the hole of another."""
        block = "    - {kind: cuboid, centre: [%s, 0, 0], size: 10 mm, remanence: [0, 0, %s]}\n".replace("10 mm", "[10 mm, 10 mm, 10 mm]")
        scene = self.path("blocks.yaml")
        for blocks, told in (([("0", "1"), ("9 mm", "1"), ("19 mm", "1")], ["[0] and magnet.parts[1]"]), ([("0", "1"), ("10 mm", "1")], []),
                             ([("0", "1"), ("8 mm", "1"), ("4 mm", "0.5")], ["[0] and magnet.parts[1]"]),
                             ([("0", "1"), ("0", "-1"), ("30 mm", "1")], [])):
            for world in ("", "medium: {viscosity: 1 mPa s}\n"):
                with open(scene, "w") as file:
                    file.write("magnet:\n  shape: parts\n  parts:\n" + "".join(block % numbers for numbers in blocks) + world)
                status, _, err = festoon("check", scene)
                self.assertEqual(status, 0, err)
                found = [line.split("magnet.parts", 1)[1].split(" overlap")[0] for line in err.splitlines() if " overlap" in line]
                self.assertEqual(found, told)
                if not world:
                    self.assertEqual(festoon("run", scene, "--set", "run.periods=1", "--set", "run.discard=0")[2].count(" overlap"), len(told))

    def test_parts_that_a_sweep_moves_into_each_other(self):
        """One sentence, with the first such point; nothing more where the scene itself has it."""
        block = "    - {kind: cuboid, centre: [%d mm, 0, 0], size: [10 mm, 10 mm, 10 mm], remanence: [0, 0, 1]}\n"
        scene = self.path("blocks.yaml")
        for centre, at in ((25, " = 0.008"), (5, "")):
            with open(scene, "w") as file:
                file.write("magnet:\n  shape: parts\n  parts:\n" + block % 0 + block % centre)
            for values, told in (("25mm,15mm", 0), ("16mm,12mm,8mm,4mm", 1)):
                _, _, err = festoon("sweep", scene, "--set", "run.periods=1", "--set", "run.discard=0", "--over",
                                    f"magnet.parts[1].centre[0]={values}", "-o", self.path(f"{centre}{told}.db"))
                self.assertEqual(err.count(" overlap"), told if centre == 25 else 1, err)
                self.assertIn(f"at magnet.parts[1].centre[0]{at}, " if told and at else "", err)

    def test_trajectories_keep_the_parts(self):
        name = self.path("t.csv")
        self.good("run", self.scene, "--csv", name)
        with open(name) as file:
            self.assertIn("moment: [0 A m2, 0.1 A m2, -1 A m2]", file.read())

    def test_maps_show_the_poles(self):
        """The outlines in the data of a map are those of the parts: the ball's circle is north, the dipole south."""
        figure = self.path("f.svg")
        self.good("field", self.scene, "--quantity", "z", "--height", "3mm", "--units", "lab", "-o", figure)
        with open(figure[:-3] + "dat") as file:
            blocks = file.read().split("\n\n\n")
        named = {block.strip().splitlines()[0].strip("# "): block for block in blocks if block.strip()}
        north, south, field = ([[float(word) for word in line.split()] for line in named[name].splitlines()
                                if line.strip() and not line.startswith("#")] for name in ("north", "south", "map"))
        for x, y in north:
            self.assertAlmostEqual((x + 15) ** 2 + y ** 2, 36, delta=2e-3)  # six digits each
        self.assertEqual({(round(x), round(y)) for x, y in south}, {(14, 0), (16, 0), (16, 2), (14, 2)})
        inside = [value for x, y, value in field if (x + 15) ** 2 + y ** 2 < 26]
        self.assertTrue(inside and all(value != value for value in inside))

    def test_figures_and_films_are_made(self):
        name, path = self.path("t.h5"), self.path("p.svg")
        if festoon("run", self.scene, "-o", name)[0] != 0:
            self.skipTest("this build has no HDF5")
        self.good("plot", name, "-o", path)
        with open(path) as file:
            self.assertIn("north poles", file.read())
        with open(path[:-3] + "dat") as file:
            self.assertIn("north", file.read())


if __name__ == "__main__":
    unittest.main()
