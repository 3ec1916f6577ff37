"""The commands orbit, locked, branch and lyapunov as a user meets them: keys, statuses, files and figures.

tests: cli/orbit.c cli/locked.c cli/lyapunov.c orbit/locked.c
labels: slow"""

import json
import os
import tempfile
import unittest

from sweep_tools import festoon


def document(*words):
    status, out, err = festoon(*words, "--json")
    if status != 0:
        raise AssertionError(f"{words}: status {status}: {err}")
    return json.loads(out)


class Orbits(unittest.TestCase):
    def test_orbit_keys(self):
        orbit = document("orbit", "--set", "drive.omega=0.352")
        for key in """omega symmetry period mean_r std_r mean_alpha_dot mean_nz festoons multipliers stable residual
                state""".split():
            self.assertIn(key, orbit)
        self.assertEqual(orbit["symmetry"], "S2")
        self.assertIs(orbit["stable"], True)
        self.assertEqual([len(pair) for pair in orbit["multipliers"]], [2] * 8)
        self.assertEqual(len(orbit["state"]), 10)
        self.assertAlmostEqual(orbit["festoons"], 13.6226520692, 9)

    def test_festoons(self):
        orbit = document("orbit", "--festoons", "12")
        self.assertAlmostEqual(orbit["festoons"], 12, 10)
        self.assertEqual(orbit["others"], [])
        status, out, err = festoon("orbit", "--festoons", "6")
        self.assertEqual((status, out), (1, ""))
        self.assertIn("N is from 3.10358 to 5.7594 on its S1 orbits; N is from 11.5188 to 136.167 on its S2 orbits", err)

    def test_no_orbit(self):
        status, out, err = festoon("orbit", "--set", "drive.omega=0.05")
        self.assertEqual((status, out), (1, ""))
        self.assertIn("locks", err)

    def test_locked(self):
        states = document("locked", "--set", "drive.omega=0.05")["states"]
        self.assertEqual(len(states), 10)
        for state in states:
            for key in "r phi_deg n w eigenvalues stable slip".split():
                self.assertIn(key, state)
            self.assertEqual([len(pair) for pair in state["eigenvalues"]], [2] * 9)
        self.assertEqual([s["stable"] for s in states].count(True), 2)
        self.assertIn(None, [s["phi_deg"] for s in states])  # on the axis

    def test_what_a_list_of_locked_states_lacks_is_said(self):
        status, out, err = festoon("locked", "--set", "magnet.depth=0.010")
        self.assertEqual(status, 0, err)
        self.assertIn("may lack some", out)
        self.assertTrue(document("locked", "--set", "friction.law=none")["truncated"])
        self.assertFalse(document("locked")["truncated"])

    def test_growth_like_a_power_of_time_is_no_exponent(self):
        spectrum = document("lyapunov", "--set", "bead.material=paramagnetic", "--set", "bead.a=0.01", "--set",
                            "run.periods=150", "--set", "run.discard=50")
        self.assertGreater(spectrum["exponents"][0], 0)  # a locked bead with a neutral direction
        self.assertFalse(spectrum["converged"])

    def test_a_bead_that_passes_a_weakly_unstable_state_goes_on(self):
        """Just above the Hopf point at 0.0921063 the bead comes within 1e-7 of rest, and departs from it at the rate
        6e-4 gamma."""
        orbit = document("orbit", "--set", "drive.omega=0.0922")
        self.assertEqual((orbit["regime"], orbit["stable"]), ("librating", True))
        self.assertGreater(orbit["std_r"], 1e-3)

    def test_no_family_is_followed_twice(self):
        for over in ("0.2:3.6", "0.15:3.5"):
            branch = document("branch", "--kind", "counter", "--over", f"drive.omega={over}")
            self.assertEqual({point["branch"] for point in branch["points"]}, {0, 1}, over)

    def test_families_that_cross_are_no_special_points(self):
        branch = document("branch", "--kind", "locked", "--over", "drive.omega=0.08:0.1")
        self.assertEqual([special["type"] for special in branch["specials"]], ["hopf"])
        self.assertEqual({crossing["type"] for crossing in branch["crossings"]}, {"transcritical"})
        (crossing,) = branch["crossings"]  # both sides belong to the branch that is met there
        values = [point["value"] for point in branch["points"] if point["branch"] == crossing["born"]]
        self.assertLess(min(values), crossing["value"] - 0.005)
        self.assertGreater(max(values), crossing["value"] + 0.005)

    def test_branch_and_figures(self):
        with tempfile.TemporaryDirectory() as directory:
            path = os.path.join(directory, "branch.json")
            branch = document("branch", "--kind", "counter", "--over", "drive.omega=0.24:0.4", "-o", path)
            with open(path, encoding="utf-8") as again:
                self.assertEqual(json.load(again), branch)
            for point in branch["points"]:
                for key in "value mean_r mean_alpha_dot mean_nz festoons symmetry stable branch".split():
                    self.assertIn(key, point)
            (special,) = branch["specials"]
            self.assertEqual((special["type"], special["parameter"], special["criticality"]),
                             ("pitchfork", "drive.omega", "supercritical"))
            self.assertAlmostEqual(special["value"], 0.26885303399, 9)
            self.assertEqual(special["value"], special["omega"])
            runs = os.path.join(directory, "runs.json")
            with open(runs, "w", encoding="utf-8") as out:
                out.write(festoon("run", "--set", "drive.omega=0.3", "--json")[1])
            for observable in ("mean_r", "mean_nz", "festoons"):
                figure = os.path.join(directory, observable + ".svg")
                status, _, err = festoon("plot", path, "--quantity", observable, "--runs", runs, "-o", figure)
                self.assertEqual(status, 0, err)
                self.assertGreater(os.path.getsize(figure), 2000)
            figure = os.path.join(directory, "circle.svg")
            self.assertEqual(festoon("plot", path, "--quantity", "multipliers", "-o", figure)[0], 0)
            status, _, err = festoon("plot", path, "--quantity", "mean_rr", "-o", figure)
            self.assertEqual(status, 2)
            self.assertIn("mean_r", err)
            with open(path, "w", encoding="utf-8") as broken:
                broken.write("{}")
            self.assertEqual(festoon("plot", path, "-o", figure)[0], 2)

    def test_branch_usage(self):
        for words in (["--kind", "counter"], ["--over", "drive.omega=0.2:0.3"], ["--kind", "x", "--over", "a=1:2"],
                      ["--kind", "counter", "--over", "drive.omegaa=0.2:0.3"],
                      ["--kind", "counter", "--over", "drive.omega=0.3:0.2"]):
            self.assertEqual(festoon("branch", *words)[0], 2, words)

    def test_lyapunov(self):
        spectrum = document("lyapunov", "--set", "drive.omega=0.352", "--set", "run.periods=120",
                            "--set", "run.discard=80")
        for key in "exponents error converged".split():
            self.assertIn(key, spectrum)
        self.assertEqual(len(spectrum["exponents"]), 9)
        self.assertAlmostEqual(sum(spectrum["exponents"]), -7, 6)
        self.assertAlmostEqual(sum(spectrum["exponents"]), spectrum["divergence"], 6)


if __name__ == "__main__":
    unittest.main()
