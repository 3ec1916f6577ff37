"""What beads do for ever, through the program: locked bars, the orbit of an opposite pair, the drive at which a bar breaks,
beside the numbers of an independent program, and what is refused.

tests: cli/beads_orbits.c io/beads_orbit_json.c orbit/beads_listed.c"""
import json
import unittest

from sweep_tools import Case

THIRTY = "drive: {frequency: 30 Hz}\nmodel: {chi: 1.243e-3}\nrun: {periods: 60, discard: 30}\n"
OPPOSITE = THIRTY + "beads:\n  - start.phi: 3 deg\n  - start.phi: 183 deg\n"


def bar(count):
    """Beads in a row along the magnet, at rest."""
    lines = [THIRTY + "start: {spin: rest}\nbeads:\n"]
    for i in range(count):
        lines.append(f"  - start.position: [{(i - (count - 1) / 2) * 5.0000001} mm, 0, 2.5 mm]\n"
                     f"    start.n: [1, 0, 0]\n")
    return "".join(lines)


class ForEver(Case):
    def scene(self, text):
        with open(self.path("scene.yaml"), "w") as file:
            file.write(text)
        return self.path("scene.yaml")

    def test_a_bar_of_three(self):
        told = json.loads(self.good("locked", self.scene(bar(3)), "--json"))
        (state,) = told["states"]
        eps = 2.5 / 23
        self.assertLess(abs(state["beads"][1]["z"] / (2 * eps) - 0.05165622), 5e-9)
        self.assertLess(abs(state["beads"][0]["load_weights"] - 30.21196), 5e-6)
        self.assertLess(abs(state["power"] - 1.830241e-4), 5e-11)
        self.assertEqual([(pair["a"], pair["b"]) for pair in state["pair_forces"]], [(0, 1), (1, 2)])
        for pair in state["pair_forces"]:
            self.assertLess(abs(pair["force"] - 3.46217435), 5e-9)
        self.assertTrue(state["stable"])
        self.assertEqual(len(state["eigenvalues"]), 25)
        self.assertIn("3 beads turn with the magnet", self.good("locked", self.scene(bar(3))))

    def test_an_opposite_pair(self):
        told = json.loads(self.good("orbit", self.scene(OPPOSITE), "--json"))
        self.assertLess(abs(told["mean_r"] - 0.92580221093), 5e-12)
        self.assertLess(abs(told["mean_alpha_dot"] / told["omega"] + 0.13233987620), 5e-12)
        self.assertEqual(told["symmetry"], "exchange")
        self.assertTrue(told["stable"])
        self.assertLess(abs(max(abs(complex(*pair)) for pair in told["multipliers"]) - 0.9991387), 5e-8)
        self.assertIn("change places", self.good("orbit", self.scene(OPPOSITE)))

    def test_where_a_bar_breaks(self):
        words = ("branch", self.scene(bar(2)), "--kind", "locked", "--over", "drive.frequency=20:400")
        told = json.loads(self.good(*words, "--json", "--units", "si"))
        for point in told["points"][::7] + [special["at"] | {"omega": special["omega"], "omega_per_s": special["omega_per_s"]} for special in told["specials"]]:
            rate, length = (told["scene"][key] for key in ("friction.gamma", "magnet.half_length"))
            newton = told["scene"]["bead.mass"] * length * rate**2
            self.assertAlmostEqual(point["omega_per_s"], point["omega"] * rate, delta=1e-9 * rate)
            self.assertAlmostEqual(point["beads"][0]["r_m"], point["beads"][0]["r"] * length, delta=1e-12)
            self.assertAlmostEqual(point["pair_forces"][0]["force_newtons"], point["pair_forces"][0]["force"] * newton, delta=1e-12)
        self.assertEqual([special["type"] for special in told["specials"]], ["hopf", "hopf", "contact"])
        self.assertEqual(told["ends"][1]["type"], "contact")
        self.assertEqual(told["ends"][1]["value"], told["specials"][2]["value"])
        self.assertLess(abs(told["specials"][2]["at"]["pair_forces"][0]["force"]), 1e-9)
        self.assertIn("at 32 Hz: at the end of the range", self.good(*words[:-1], "drive.frequency=28:32"))

    def test_what_is_refused(self):
        scene = self.scene(OPPOSITE)
        over = ("--over", "drive.frequency=10:40")
        for words, part in ((("lyapunov", scene), "beads: festoon lyapunov takes one bead on a flat plate in air: only of its equations"),
                            (("lyapunov", scene), "multipliers of festoon orbit"),
                            (("orbit", scene, "--festoons", "3"), "--festoons is for one bead"),
                            (("branch", scene, "--kind", "counter", *over), "--kind locked"),
                            (("branch", scene, "--kind", "locked", *over, "-o", self.path("b.json")), "--output"),
                            (("branch", scene, "--kind", "locked", "--over", "start.phi=1:2"), "start.phi")):
            self.assertIn(part, self.refused(*words))
        self.assertIn("no state in which they turn with the magnet", self.refused("locked", scene, status=1))


if __name__ == "__main__":
    unittest.main()
