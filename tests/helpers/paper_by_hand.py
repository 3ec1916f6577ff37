"""Numbers of `festoon paper` computed otherwise: tests that test_paper_reduced_long.py runs on its one run of the
paper.

A motion is integrated by bead_by_hand.py, in another frame and by another method; the field is that of the ten charges.
"""

import json
import math
import os
import re
import subprocess

import bead_by_hand as hand

FESTOON = os.environ["FESTOON"]


def run(*arguments):
    return subprocess.run([FESTOON, *arguments], capture_output=True, text=True, stdin=subprocess.DEVNULL)


def repeat(command):
    """The JSON that a command of the report prints."""
    words = command.split()
    assert words[0] == "festoon", command
    done = run(*words[1:])
    assert done.returncode == 0, (command, done.stderr)
    return json.loads(done.stdout)


def curve(path, block):
    """The points (x, y) of one curve of a figure's data."""
    text = path.read_text()
    found = re.search(rf"^# {block}\n((?:.*\n)*?)\n\n", text + "\n\n\n", re.MULTILINE)[1]
    lines = [line.split() for line in found.splitlines() if line and not line.startswith("#")]
    return {round(float(x), 6): float(y) for x, y in lines}


class ByHand:
    """For a test case that has `paper`, the object of paper.json, `directory` and statement()."""

    def by_hand(self, command, steps=500):
        """One return of the motion at whose end the command arrives, integrated by tests/helpers/bead_by_hand.py."""
        result = repeat(command)
        motion = hand.one_return(result["final_state"], result["omega"], result["dynamics"] == "farago2020", steps)
        self.assertLess(motion.open, 1e-6, command)
        return motion

    def close_to(self, value, expected, tolerance, where):
        self.assertLess(abs(value - expected), tolerance * max(abs(expected), 1e-2), where)

    def test_table1_by_hand(self):
        """Each row of Table 1 in another frame, by another method, with means taken in another way."""
        for row in self.paper["table1"]:
            for dynamics in ("farago2020", "rigid"):
                motion = self.by_hand(row[f"{dynamics}_command"])
                near = (row["omega"], dynamics) == (0.2845, "farago2020")  # close to the halving: settles slowly
                self.close_to(row[dynamics], motion.festoons, 2e-4 if near else 1e-6, (row, dynamics))
                self.assertEqual(row[f"{dynamics}_symmetry"], "S2" if motion.s2 else "S1")

    def test_statements_by_hand(self):
        for prefix, dynamics in (("", "farago2020"), ("rigid_", "rigid")):
            four = self.by_hand(self.statement("fold4-angle")[prefix + "command"])
            many = self.by_hand(self.statement("fold15-angle")[prefix + "command"])
            rolling = many.mean["r"] * many.alpha_dot
            phi_dot = many.omega - many.alpha_dot
            for name, value, tolerance in (
                    ("fold4-festoons", four.festoons, 1e-6), ("fold4-angle", four.max_angle, 2e-4),
                    ("fold4-nz", abs(four.mean["n_z"]), 1e-6),
                    ("fold4-field", 100 * max(four.max_b / four.mean["b"] - 1, 1 - four.min_b / four.mean["b"]), 2e-4),
                    ("fold15-festoons", many.festoons, 1e-6), ("fold15-angle", many.max_angle, 2e-4),
                    ("magint-least", many.min_r, 1e-5), ("steady-radius", many.std_r / many.mean["r"], 1e-6),
                    ("shrinking", 100 * (1 - many.std_r / four.std_r), 1e-6),
                    ("circling", abs(rolling) / (hand.EPS * many.omega), 1e-6),
                    ("turning-rate", phi_dot / many.omega, 1e-6),
                    ("friction", 100 * abs(many.mean["friction"] / many.mean["magnetic"]), 1e-5),
                    ("magnetic-term", 100 * abs(many.mean["magnetic_printed"] / many.mean["magnetic"] - 1), 1e-5),
                    ("rolling-mean", 100 * abs(many.mean["v_alpha"] / rolling), 1e-5),
                    ("slip-formula", 100 * abs((many.mean["v_alpha"] - rolling - hand.EPS * phi_dot) / rolling), 1e-5)):
                self.close_to(self.statement(name)[dynamics], value, tolerance, (name, dynamics))

    def test_curves_by_hand(self):
        """Points on the curves of the figures, read from their data, against tests/helpers/bead_by_hand.py."""
        command = self.statement("fold15-angle")["command"]
        for omega in (0.25, 0.35, 1.0):
            motion = self.by_hand(command.replace("0.4", str(omega)))
            terms = curve(self.directory / "evolution-farago2020.dat", "panel1-curve1"), \
                curve(self.directory / "evolution-farago2020.dat", "panel1-curve2"), \
                curve(self.directory / "evolution-farago2020.dat", "panel1-curve3"), \
                curve(self.directory / "evolution-farago2020.dat", "panel1-curve4")
            for term, name in zip(terms, ("centrifugal", "magnetic", "magnetic_printed", "friction")):
                self.close_to(term[omega], motion.mean[name] / hand.EPS**2, 1e-5, (omega, name))
            self.close_to(curve(self.directory / "test.dat", "panel1-curve1")[omega], motion.alpha_dot, 1e-6, omega)
            if omega < 0.5:
                data = self.directory / "comparison.dat"
                self.close_to(curve(data, "panel1-curve1")[omega], motion.mean["r"], 1e-6, omega)
                self.close_to(curve(data, "panel1-curve3")[omega], motion.alpha_dot, 1e-6, omega)
                self.close_to(curve(data, "inset1-curve1")[omega], motion.std_r, 1e-5, omega)

    def test_the_field_by_hand(self):
        """Statements about the field and the averages of section VI, from the ten charges."""
        def strongest(length_mm):
            heights = 18.7 / length_mm, 40 / (4 * length_mm)
            charges = [(s, k * heights[1], s) for k in range(-2, 3) for s in (1, -1)]
            low, high = 0.3, 2.0
            for _ in range(50):
                middle = 0.5 * (low + high)
                b, g = hand.field(middle, 0.0, 0.0, heights[0], charges)
                low, high = (middle, high) if sum(b[i] * g[i][0] for i in range(3)) > 0 else (low, middle)
            return 2 * length_mm * low
        self.close_to(self.statement("maxima")["rigid"], strongest(23.0), 1e-9, "maxima")
        self.close_to(self.statement("magint-field")["rigid"] * 46, strongest(23.0), 1e-9, "magint-field")
        self.close_to(strongest(self.statement("length-fitted")["rigid"]), 41.0, 1e-9, "length")

        def mean_pull(r, rate, chi):
            total = 0.0
            for i in range(360):
                turn = math.radians(i)
                c, s, moment = math.cos(turn), math.sin(turn), chi + rate * math.radians(i)
                n = (-math.sin(moment) * s, math.sin(moment) * c, -math.cos(moment))
                g = hand.field(r * c, r * s, 0.0)[1]
                total += sum(n[k] * (g[k][0] * c + g[k][1] * s) for k in range(3)) / 360
            return total
        ratio = abs(mean_pull(1.05, 1, math.pi) / mean_pull(1.05, -1, math.pi))
        self.close_to(self.statement("corotation-force")["farago2020"], ratio, 1e-9, "corotation-force")
        r = repeat(self.statement("fold15-angle")["command"])["mean_r"]
        size = {k: math.hypot(mean_pull(r, k, 0.0), mean_pull(r, k, math.pi / 2)) for k in (-3, -2, -1, 0, 2, 3)}
        self.close_to(self.statement("resonance")["farago2020"],
                      max(v for k, v in size.items() if k != -1) / size[-1], 1e-7, "resonance")
        outwards = sum(mean_pull(0.9 + 0.01 * i, -1, math.pi) >= 0 for i in range(61))
        self.assertEqual(self.statement("counter-force")["rigid"], outwards)
