"""--over for every parameter in every form: a key can be varied, with units, or is refused in words.

tests: study/grid.c cli/values.c"""

import csv
import io
import json
import math
import os
import unittest

from sweep_tools import Case, festoon

VERY_SHORT = ["--set", "run.periods=2", "--set", "run.discard=1", "--set", "run.rtol=1e-6"]

# Two values of each real parameter, as a range in a unit where it has one, and as the numbers that rows have.
RANGES = {
    "bead.radius": ("2mm:0.3cm", 2e-3, 3e-3), "bead.mass": ("400mg:0.6g", 4e-4, 6e-4),
    "bead.inertia": ("0.3:0.6", 0.3, 0.6),
    "bead.density": ("7 g/cm^3:8000", 7e3, 8e3), "bead.remanence": ("1:1200 mT", 1, 1.2),
    "bead.moment": ("0.1:0.2 A m2", 0.1, 0.2), "bead.a": ("1:2", 1, 2), "bead.b": ("-1:1", -1, 1),
    "magnet.half_length": ("20mm:25mm", 20e-3, 25e-3), "magnet.width": ("3cm:40mm", 30e-3, 40e-3),
    "magnet.depth": ("15mm:17mm", 15e-3, 17e-3), "magnet.b0": ("10mT:200G", 10e-3, 20e-3),
    "drive.frequency": ("600rpm:12Hz", 10, 12), "drive.omega": ("0.2:0.4", 0.2, 0.4),
    "friction.gamma": ("0.3 1/ms:330 1/s", 300, 330), "friction.mu": ("0.1:0.3", 0.1, 0.3),
    "friction.mu_static": ("0.25:0.4", 0.25, 0.4), "friction.stribeck_speed": ("1 mm/s:0.01", 1e-3, 1e-2),
    "friction.rolling_resistance": ("1e-4:1e-3", 1e-4, 1e-3),
    "contact.radius": ("0.1mm:200um", 1e-4, 2e-4), "contact.modulus": ("2 MPa:0.004 GPa", 2e6, 4e6),
    "impact.restitution": ("0:0.5", 0, 0.5),
    "model.kappa": ("1:2", 1, 2), "model.eps": ("0.1:0.12", 0.1, 0.12), "model.h": ("0.7:0.9", 0.7, 0.9),
    "model.lambda": ("0.3:0.5", 0.3, 0.5), "plate.radius": ("20cm:230mm", 0.2, 0.23),
    "plate.gravity": ("9.8 m/s2:10", 9.8, 10), "start.r": ("0.5:0.9", 0.5, 0.9),
    "start.phi": ("-90:0.25turn", -90, 90), "run.periods": ("2:3", 2, 3), "run.discard": ("0:1", 0, 1),
    "run.rtol": ("1e-6:1e-5", 1e-6, 1e-5), "run.duration": ("0.2s:300 ms", 0.2, 0.3),
}
OF_BEADS = {"contact.pair_rate", "contact.pair_mu", "model.chi", "run.method"}  # of a list of beads alone
OF_WORLDS = {"plate.shape", "plate.bowl_radius", "medium.density", "medium.viscosity",
             "medium.drag_coefficient", "medium.added_mass", "medium.drag_rate", "medium.spin_drag_rate",
             "medium.quadratic_drag",
             "plate.tilt", "plate.tilt_azimuth", "drive.waveform", "drive.amplitude", "drive.chirp", "wave.length",
             "wave.amplitude", "wave.ratio", "world.frame"}  # by which rows are of worlds
ALONE = {"plate.bowl_radius", "plate.tilt_azimuth", "drive.amplitude", "drive.chirp", "medium.drag_coefficient",
         "medium.added_mass"}  # they need another key
DRY = "friction.law=coulomb"
NEEDS = {"bead.a": ["bead.material=paramagnetic"], "bead.b": ["bead.material=mixed"], "friction.mu_static": [DRY],
         "friction.stribeck_speed": [DRY, "friction.mu_static=0.4"], "friction.rolling_resistance": [DRY],
         "bead.remanence": ["magnet.b0=10mT"],
         "magnet.shape": ["magnet.shape=parts", "magnet.parts[0].kind=dipole", "magnet.parts[0].moment[0]=2"],
         "contact.radius": [DRY, "contact.patch=hertz"],
         "contact.modulus": [DRY, "contact.patch=hertz"],
         "contact.patch": [DRY, "contact.patch=hertz", "contact.radius=0.1mm"], "impact.restitution": [DRY]}
# Parameters that no row shows: the tesla scale, masses if kappa is given, an edge that is not reached, and how a
# bead bounces that does not leave the plate.
INVISIBLE = {"bead.moment", "magnet.b0", "bead.mass", "bead.density", "plate.radius", "impact.restitution"}
WHOLE = {"magnet.lines"}
REFUSED = {"run.samples": "changes nothing in a row"}


class Over(Case):
    def setUp(self):
        super().setUp()
        self.count = 0

    def table(self, *axes, sets=()):
        """The rows of a sweep over these axes."""
        self.count += 1
        name = self.path(f"{self.count}.db")
        words = [word for axis in axes for word in ("--over", axis)]
        self.good("sweep", *VERY_SHORT, *[word for text in sets for word in ("--set", text)], *words, "-o", name)
        return json.loads(self.good("export", name, "--json"))

    def says(self, wanted, *axes, sets=()):
        name = self.path("refused.db")
        words = [word for axis in axes for word in ("--over", axis)]
        err = self.refused("sweep", *VERY_SHORT, *[word for text in sets for word in ("--set", text)], *words, "-o", name)
        self.assertIn(wanted, err)
        self.assertIn("--over", err)
        self.assertFalse(os.path.exists(name))


class Keys(Over):
    def test_every_key_of_the_schema(self):
        keys = {row["key"]: row for row in json.loads(self.good("schema", "--json")) if not row["parts"]}
        numbers = {key for key, row in keys.items() if row["kind"] == "real"}
        self.assertEqual(numbers, set(RANGES) | ((OF_BEADS | OF_WORLDS) & numbers) | {"run.step"})
        self.assertEqual({key for key, row in keys.items() if row["kind"] == "integer" or row["kind"] == "int"},
                         WHOLE | set(REFUSED))
        for key in OF_BEADS:
            self.says("choose several", f"{key}=" + ("exact,stepping" if key == "run.method" else "1,2"))
        for key in sorted(OF_WORLDS):
            with self.subTest(key=key):
                self.check_world(key, keys[key]["names"] or ["0.1", "0.4"])
        self.says("choose stepping", "run.step=1e-5,1e-4")
        for key in RANGES:
            with self.subTest(key=key):
                self.check_real(key, keys[key]["unit"])
        for key in (key for key, row in keys.items() if row["kind"] == "text"):
            self.says(f"{key} is a text", f"{key}=a,b")
        field_map = self.path("map.csv")  # for the shape grid, with the height and within the reach of the default bead
        self.good("field", "--set", "magnet.b0=10mT", "--csv", field_map, "--radius", "60mm", "--spacing", "5mm")
        for key, row in keys.items():
            if row["names"] and key not in OF_BEADS | OF_WORLDS:
                with self.subTest(key=key):
                    given = [f"magnet.file={field_map}"] if key == "magnet.shape" else []
                    rows = self.table(f"{key}=" + ",".join(row["names"]), sets=NEEDS.get(key, []) + given)
                    self.assertEqual([found[key] for found in rows], row["names"])
                    self.assertEqual({found["status"] for found in rows}, {"done"})
                    self.says("is a choice", f"{key}={row['names'][0]}:{row['names'][-1]}:2")
        for key, sentence in REFUSED.items():
            self.says(sentence, f"{key}=1:2:2")

    def test_choices_of_parts_and_of_beads(self):
        block = ["magnet.shape=parts", "magnet.parts[0].kind=cuboid", "magnet.parts[0].remanence[0]=1"] + [
            f"magnet.parts[0].size[{axis}]=20mm" for axis in range(3)]
        pair = ["beads[0].start.phi=3", "beads[1].start.phi=183"]
        choices = [row for row in json.loads(self.good("schema", "--json")) if row["kind"] == "choice"]
        for row in choices:
            for key, sets in ((row["key"], block), (f"beads[1].{row['key']}", pair)):
                if row["parts"] if sets is block else row["key"].split(".")[0] in ("bead", "start"):
                    with self.subTest(key=key):
                        values = row["names"][:2]
                        self.assertEqual([found[key] for found in self.table(f"{key}=" + ",".join(values), sets=sets)],
                                         values)

    def check_world(self, key, values):
        """A row says what the key does, or why it can do nothing by itself."""
        if key.split(".")[0] == "wave" or key in ALONE:
            return self.says(f"{key} has no effect with this", f"{key}=" + ",".join(values))
        rows = self.table(f"{key}=" + ",".join(values))
        self.assertEqual([str(row[key]) for row in rows], values)
        for row in rows:
            self.assertIn("frame", row)
            self.assertEqual(row["status"] == "done", row["regime"] is not None)
            self.assertTrue(row["reason"])

    def check_real(self, key, unit_of_key):
        text, low, high = RANGES[key]
        sets = NEEDS.get(key, [])
        rows = self.table(f"{key}={text}:3", sets=sets)
        for row, wanted in zip(rows, (low, (low + high) / 2, high)):
            self.assertTrue(math.isclose(row[key], wanted, rel_tol=1e-12, abs_tol=1e-15), (row[key], wanted))
        self.assertEqual({row["status"] for row in rows}, {"done"}, rows[0]["reason"])
        if key not in INVISIBLE:  # the two values give different rows
            self.assertNotEqual(*[[value for name, value in row.items() if name not in (key, "point")]
                                  for row in (rows[0], rows[2])])
        # The same values as a list, the second one as it is exported in the unit of the laboratory.
        values = text.split(":")
        head, _, _, last = csv.reader(io.StringIO(self.good("export", self.path(f"{self.count}.db"), "--csv", "--units", "lab")))
        unit = head[0][len(key) + 2:-1]
        self.assertEqual((head[0], unit != ""), (key + f" [{unit}]" * (unit != ""), unit_of_key != "1"))
        listed = self.table(f"{key}={values[0]},{last[0]} {unit}", sets=sets)
        self.assertEqual(listed[1][key], rows[2][key])
        for row, other in zip(listed, (rows[0], rows[2])):
            self.assertEqual(row["final_state"], other["final_state"])
        self.says("furlongs", f"{key}={values[0]}:7 furlongs:3", sets=sets)
        self.says("out of range", f"{key}=-1e99:{values[1]}:3", sets=sets)

    def test_whole_numbers(self):
        rows = self.table("magnet.lines=1:7:3")
        self.assertEqual([row["magnet.lines"] for row in rows], [1, 4, 7])
        self.assertEqual([row["magnet.lines"] for row in self.table("magnet.lines=9,3")], [9, 3])
        self.says("between the integers", "magnet.lines=1:4:3")
        self.says("between the integers", "magnet.lines=1:9:random:3")
        self.says("between the integers", "magnet.lines=1:9:3:log")

    def test_strengths_without_effect(self):
        self.says("no effect", "bead.a=1,2")
        self.says("no effect", "bead.b=1,2", sets=["bead.material=paramagnetic"])
        self.says("choose hertz", "contact.radius=0.1mm,0.2mm", sets=[DRY])
        for key in ("impact.restitution", "friction.mu_static", "friction.stribeck_speed"):
            self.says("choose coulomb", f"{key}=0.5,0.6")
        self.table("impact.restitution=0.5,0.6", sets=["medium.density=1"])  # a world has impacts under every law
        self.says("choose coulomb or rolling", "friction.rolling_resistance=1e-3,1e-2")
        self.says("choose coulomb", "contact.patch=point,hertz", sets=["contact.radius=1mm"])
        self.says("choose one greater than friction.mu", "friction.stribeck_speed=0.01,0.02", sets=[DRY])
        self.says("choose at least 2", "magnet.width=30mm,40mm", sets=["magnet.lines=1"])
        self.says("choose hard or mixed", "model.kappa=1,2", sets=["bead.material=paramagnetic", "bead.a=1"])
        # Static friction that is varied counts as given, though the scene has none.
        self.table("friction.mu_static=0.2,0.4", sets=[DRY, "friction.stribeck_speed=0.01"])
        rows = self.table("bead.material=hard,paramagnetic", "bead.a=1,2")
        self.assertEqual([row["final_state"] for row in rows].count(rows[0]["final_state"]), 2)  # hard: both end alike
        self.assertNotEqual(rows[2]["final_state"], rows[3]["final_state"])


    def test_each_length_discards_its_own_part(self):
        """The part of a run that is not averaged follows the length that is varied, and not the scene's."""
        words = ["--set", "run.periods=100", "--set", "run.rtol=1e-6"]
        self.good("sweep", *words, "--over", "run.periods=6,20", "-o", self.path("lengths.db"))
        rows = json.loads(self.good("export", self.path("lengths.db"), "--json"))
        for row, periods in zip(rows, (6, 20)):
            alone = json.loads(self.good("run", *words, "--set", f"run.periods={periods}", "--json"))
            self.assertAlmostEqual(row["mean_r"], alone["mean_r"], delta=1e-6)


class Forms(Over):
    def values(self, axis, key="model.kappa"):
        return [row[key] for row in self.table(axis)]

    def test_spacings(self):
        self.assertEqual(self.values("model.kappa=1:2:5"), [1, 1.25, 1.5, 1.75, 2])
        self.assertEqual(self.values("model.kappa=2:1:5"), [2, 1.75, 1.5, 1.25, 1])
        self.assertEqual(self.values("model.kappa=1:2:1"), [1])
        self.assertEqual(self.values("model.kappa=1:2:1:log"), [1])
        self.assertEqual(self.values("model.kappa=2:2:3"), [2, 2, 2])
        self.assertEqual(self.values("model.kappa=2:2:3:log"), [2, 2, 2])
        self.assertEqual(self.values("model.kappa=2"), [2])
        self.assertEqual(self.values("model.kappa=2,1,2"), [2, 1, 2])
        self.assertEqual(self.values("model.kappa=1:100:3:log"), [1, 10, 100])
        self.assertEqual(self.values("model.kappa=100:1:log:3"), [100, 10, 1])
        self.assertEqual(self.values("model.kappa=0.1:0.3:3"), [0.1, 0.2, 0.3])

    def test_repeated_values_give_repeated_rows(self):
        first, second = self.table("model.kappa=2,2")
        del first["point"], second["point"]
        self.assertEqual(first, second)

    def test_random_values_come_from_the_seed(self):
        def draw(*words):
            self.count += 1
            name = self.path(f"{self.count}.db")
            self.good("sweep", *VERY_SHORT, "--over", "model.kappa=1:2:random:8", *words, "-o", name)
            return [row["model.kappa"] for row in json.loads(self.good("export", name, "--json"))]
        usual = draw()
        self.assertEqual(usual, draw("--seed", "1"))
        self.assertNotEqual(usual, draw("--seed", "2"))
        self.assertEqual(len(set(usual)), 8)
        self.assertTrue(all(1 <= value < 2 for value in usual))

    def test_what_is_refused(self):
        for axis, wanted in (("model.kappa=0:1:3:log", "positive"), ("start.phi=-5:5:3:log", "positive"),
                             ("model.kappa=1:2:0", "integer from 1"), ("model.kappa=1:2:-3", "integer from 1"),
                             ("model.kappa=1:2:2.5", "integer from 1"), ("model.kappa=1:2:1e3", "integer from 1"),
                             ("model.kappa=1:2:1000000001", "1 to 1000000000"),
                             ("model.kappa=1:2:99999999999999999999", "1 to 1000000000"),
                             ("model.kappa=1:2", "must be KEY="), ("model.kappa", "must be KEY="),
                             ("model.kappa=", "missing"), ("model.kappa=1,,2", "missing"),
                             ("model.kappa=nan:1:3", "not a decimal number"), ("model.kappa=1:inf:3", "not a decimal number"),
                             ("model.kappa=1:2:3:cubic", "unknown spacing"), ("model.kapa=1:2:3", "model.kappa"),
                             ("=1:2:3", "unknown key"), ("friction.contact_rate=0.01,0.02", "contact_rate is gone"),
                             ("contact.patch=point,pade", "choose hertz"), ("model.dynamics=rigit", "rigid")):
            with self.subTest(axis=axis):
                self.says(wanted, axis)

    def test_conflicts(self):
        self.says("varied twice", "model.kappa=1,2", "model.kappa=2,3")
        for one, other in (("drive.frequency=5,6", "drive.omega=0.1,0.2"), ("bead.radius=2mm,3mm", "model.eps=0.1,0.2"),
                           ("magnet.depth=15mm,16mm", "model.h=0.8,0.9"),
                           ("magnet.width=15mm,16mm", "model.lambda=0.8,0.9"),
                           ("model.kappa=1,2", "magnet.b0=1mT,2mT"), ("start.r=0.5,0.6", "start.position[0]=1cm,2cm"),
                           ("start.phi=0,1", "start.position[1]=1cm,2cm")):
            self.says("both its forms", one, other)
            self.says("both its forms", other, one)
        # --over replaces the other form that the scene has, as --set does.
        rows = self.table("drive.omega=0.2,0.4", sets=["drive.frequency=10"])
        self.assertEqual([row["omega"] for row in rows], [0.2, 0.4])
        self.says("more than", "model.kappa=1:2:100000", "start.r=0.5:1:100000")
        self.says("1 to 8 axes", *[f"{key}={RANGES[key][0]}:2" for key in sorted(RANGES)[:9]])
        self.says("same count", "start.r=0.5:1:random:3", "start.phi=0:9:random:4")


if __name__ == "__main__":
    unittest.main()
