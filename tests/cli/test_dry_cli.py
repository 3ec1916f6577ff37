"""Dry friction through the program: what a run tells, trajectories, pictures, sweeps and bad input.

tests: cli/run_report.c io/columns.c study/lane_contact.c study/exponent.c"""
import csv
import json
import math
import os
import re
import unittest

from sweep_tools import Case

DRY = ("--set", "friction.law=coulomb")
SHORT = ("--set", "run.periods=60", "--set", "run.discard=30")


class Runs(Case):
    def run_of(self, *words):
        return json.loads(self.good("run", *DRY, *SHORT, *words, "--json"))

    def test_what_a_run_tells(self):
        """The numbers are those of an integrator that was written apart, in Python and the laboratory frame."""
        found = self.run_of()
        self.assertEqual((found["regime"], found["symmetry"]), ("counter-rotating", "S1"))
        for key, wanted, error in (("mean_r", 0.731289719, 1e-7), ("mean_alpha_dot", -0.062930963, 1e-7),
                                   ("sticking", 0.372234, 1e-5), ("effective_rate", 0.515366, 1e-5)):
            self.assertAlmostEqual(found[key], wanted, delta=error)
        self.assertEqual(found["captures_per_return"], 3)
        self.assertIs(found["never_slips"], False)
        self.assertEqual((found["mean_rolling_power"], found["mean_pivoting_power"]), (0, 0))
        self.assertLess(found["energy_residual"], 1e-10)
        self.assertAlmostEqual(found["effective_rate"],
                               found["mean_friction_power"] / found["rms_slip"] ** 2, delta=1e-12)

    def test_other_laws_tell_nothing_of_it(self):
        found = json.loads(self.good("run", *SHORT, "--json"))
        for key in ("sticking", "captures_per_return", "effective_rate", "mean_rolling_power", "mean_pivoting_power",
                    "never_slips"):
            self.assertIsNone(found[key])

    def test_no_friction_at_all(self):
        """A coefficient of 0 is the law `none`, to the bit."""
        dry = json.loads(self.good("run", *DRY, *SHORT, "--set", "friction.mu=0", "--json"))
        none = json.loads(self.good("run", *SHORT, "--set", "friction.law=none", "--set", "friction.mu=0", "--json"))
        for key in ("final_state", "mean_r", "mean_friction_power", "never_slips", "sticking", "rhs_calls"):
            self.assertEqual(dry[key], none[key])

    def test_a_contact_that_never_slips(self):
        rolling = self.run_of("--set", "friction.law=rolling")
        strong = self.run_of("--set", "friction.mu=10")
        self.assertEqual([found["never_slips"] for found in (rolling, strong)], [True, True])
        self.assertEqual([found["sticking"] for found in (rolling, strong)], [1, 1])
        self.assertIsNone(strong["effective_rate"])
        self.assertAlmostEqual(strong["mean_r"], rolling["mean_r"], delta=1e-6)
        self.assertIn("never slips", self.good("run", *DRY, *SHORT, "--set", "friction.mu=10"))

    def test_rolling_resistance_takes_power(self):
        found = self.run_of("--set", "friction.rolling_resistance=1e-3")
        self.assertGreater(found["mean_rolling_power"], 0)
        self.assertLess(found["energy_residual"], 1e-10)
        self.assertLess(abs(found["mean_drive_power"] - found["mean_friction_power"] - found["mean_rolling_power"]),
                        1e-6 * found["mean_drive_power"])

    def test_bad_input(self):
        for words, wanted in ((("friction.mu=-0.1",), "out of range"),
                              (("friction.mu_static=0.1",), "at least as strong"),
                              (("friction.law=colomb",), "the nearest is coulomb"),
                              (("friction.stribeck_speed=3 kg",), "friction.stribeck_speed")):
            sets = [word for text in words for word in ("--set", text)]
            self.assertIn(wanted, self.refused("run", *DRY, *SHORT, *sets))


class Neighbours(Case):
    """What is not known of the neighbours of a bead is said, with the results of a run that tell more."""

    def refused_by(self, command, *sets):
        words = [word for text in sets for word in ("--set", text)]
        return self.refused(command, *DRY, "--set", "run.periods=10", "--set", "run.discard=5", *words, status=1)

    def test_held_discs(self):
        held = ("friction.mu=0.5", "drive.frequency=1Hz", "start.r=0.7", "contact.patch=hertz", "contact.radius=1mm")
        results = self.run_keys()
        for command in ("lyapunov", "orbit"):
            err = self.refused_by(command, *held)
            self.assertRegex(err, "holds the bead's disc|stops a disc")
            self.assertRegex(err, "not followed through")
            self.assertNotIn("festoon lyapunov tells", err)
            for named in re.findall(r"\((\w+)\)", err):
                self.assertIn(named, results, err)
        self.assertIn("(period)", self.refused_by("orbit", *held))

    def test_held_discs_of_stronger_static_friction(self):
        """A disc that is held loses its slip and its pivoting: three directions.  The other exponents, which come from
        vectors carried along a run, are the logarithms of the orbit's multipliers over its period."""
        sets = ("friction.mu=0.5", "friction.mu_static=0.6", "drive.frequency=15Hz", "contact.patch=hertz",
                "contact.radius=3mm", "run.periods=100", "run.discard=40")
        words = [*DRY, *[word for text in sets for word in ("--set", text)], "--json"]
        found, orbit = (json.loads(self.good(command, *words)) for command in ("lyapunov", "orbit"))
        self.assertEqual(found["exponents"].count(None), 3)
        self.assertEqual(orbit["symmetry"], "S2")  # whose multipliers are those of half a period
        wanted = [2 * math.log(math.hypot(*m)) / orbit["period"] for m in orbit["multipliers"] if m != [0, 0]]
        wanted = sorted([0, *wanted], reverse=True)  # that along the flow too
        self.assertEqual(len(wanted), 6)
        for a, b, error in zip(found["exponents"], wanted, found["errors"]):
            self.assertAlmostEqual(a, b, delta=2 * error)
            self.assertLess(error, 1e-3)

    def test_flights(self):
        """The exponents of a bead that flies; their sum is not the divergence, because impacts contract too."""
        words = ("lyapunov", *DRY, "--set", "friction.mu=0.2", "--set", "drive.frequency=84Hz", "--set",
                 "impact.restitution=0.3", "--set", "run.periods=12", "--set", "run.discard=8")
        spectrum = json.loads(self.good(*words, "--json"))
        self.assertIsNone(spectrum["divergence"])
        self.assertEqual(len(spectrum["exponents"]), 9)
        self.assertIn("impacts have no divergence", self.good(*words))

    def run_keys(self):
        return json.loads(self.good("run", *DRY, "--set", "run.periods=2", "--set", "run.discard=1", "--json"))


class Trajectories(Case):
    def rows(self):
        name = self.path("dry.csv")
        self.good("run", *DRY, "--set", "run.periods=12", "--set", "run.samples=200", "--csv", name)
        with open(name, encoding="utf-8") as file:
            return list(csv.DictReader(line for line in file if not line.startswith("#")))

    def test_columns(self):
        """A bead that slips uses all of its friction, one that sticks less; and the work of friction is f.V."""
        rows = self.rows()
        found = set()
        for row in rows:
            value = {key.split(" ")[0]: float(text) for key, text in row.items()}
            found.add(value["sticking"])
            if value["sticking"] == 1:
                self.assertLessEqual(value["friction_use"], 1 + 1e-9)
                self.assertLess(value["slip"], 1e-12)
            elif value["slip"] > 1e-9:
                self.assertAlmostEqual(value["friction_use"], 1, delta=1e-9)
                self.assertAlmostEqual(value["friction"] * value["slip"], value["friction_power"], delta=1e-12)
                self.assertAlmostEqual(value["friction"], 0.2 * value["load"], delta=1e-12)
        self.assertEqual(found, {0.0, 1.0})
        times = [float(row[next(key for key in row if key.split(" ")[0] == "t")]) for row in rows]
        step = 2 * math.pi / (2 * math.pi * 10.7 / 312.5) / 200
        for i, t in enumerate(times):
            self.assertAlmostEqual(t, i * step, delta=1e-9)

    def test_flights(self):
        """Heights of a bead that flies, in the trajectory and in its pictures."""
        name = self.path("fly.csv")
        self.good("run", *DRY, "--set", "impact.restitution=0.6", "--set", "drive.frequency=80Hz", "--set",
                  "run.periods=3", "--set", "run.discard=1", "-o", name)
        with open(name, encoding="utf-8") as file:
            lines = [line for line in file if not line.startswith("#")]
        names = [word.split("[")[0].split()[0] for word in lines[0].strip().split(",")]
        rows = [dict(zip(names, map(float, line.split(",")))) for line in lines[1:]]
        flown = [row for row in rows if row["flying"] == 1]
        self.assertGreater(len(flown), 3)
        self.assertGreater(max(row["z"] for row in flown), 1e-4)
        for row in rows:
            self.assertGreaterEqual(row["z"], -1e-12)
            if row["flying"] == 0:
                self.assertEqual((row["z"], row["vz"]), (0, 0))
            else:
                self.assertEqual((row["load"], row["friction"]), (0, 0))
        self.good("plot", name, "--quantity", "z", "-o", self.path("fly.svg"))

    def test_pictures(self):
        name = self.path("dry.h5")
        self.good("run", *DRY, "--set", "run.periods=6", "-o", name)
        for words in (("plot", name, "--quantity", "friction_use", "-o", self.path("use.svg")),
                      ("plot", name, "--quantity", "sticking", "-o", self.path("sticking.svg"))):
            self.good(*words)
            self.assertGreater(os.path.getsize(words[-1]), 1000)


class Sweeps(Case):
    def test_rows_are_the_runs(self):
        """In the portable form to the bit, in the fast ones to the tolerance; beside rows of another law."""
        words = (*SHORT, "--over", "friction.law=viscous,coulomb", "--over", "friction.mu=0.2,0.3")
        run = json.loads(self.good("run", *DRY, *SHORT, "--json"))
        for arithmetic in ((), ("--portable",), ("--portable", "--lanes", "1")):
            name = self.path(f"{len(arithmetic)}.db")
            self.good("sweep", *words, *arithmetic, "-o", name)
            row = json.loads(self.good("export", name, "--json"))[2]
            for key in ("final_state", "mean_r", "sticking", "captures_per_return", "regime"):
                if arithmetic:
                    self.assertEqual(row[key], run[key], key)
                elif key.startswith("mean") or key == "sticking":
                    self.assertAlmostEqual(row[key], run[key], delta=1e-7, msg=key)

    def test_exponents_are_those_of_runs(self):
        """Of more runs than lanes, which slip, stick, creep and let go: to the bit, or nearly so in the fast form."""
        words = ("sweep", *DRY, "--set", "run.periods=16", "--set", "run.discard=4", "--set", "run.rtol=1e-5",
                 "--over", "friction.mu=0.1,0.25", "--over", "friction.mu_static=0.25,0.35", "--over", "drive.frequency=5Hz:24Hz:10")
        rows = {}
        for name, arithmetic in (("runs", ("--portable", "--lanes", "1")), ("lanes", ("--portable",)), ("fast", ())):
            self.good(*words, *arithmetic, "-o", self.path(f"{name}.db"))
            rows[name] = json.loads(self.good("export", self.path(f"{name}.db"), "--json"))
        self.assertEqual(rows["lanes"], rows["runs"])
        known = [both for both in zip(rows["runs"], rows["fast"]) if all(row["largest_exponent"] is not None for row in both)]
        self.assertGreater(len(known), 16)
        for run, fast in known:
            error = run["largest_exponent_error"]
            self.assertAlmostEqual(run["largest_exponent"], fast["largest_exponent"], delta=2 * error, msg=run["point"])


if __name__ == "__main__":
    unittest.main()
