"""Several beads through the program: what a run tells, beside the numbers of an independent program (each with how it
was made: DOP853 at a tolerance of 1e-10 to 1e-12, contacts as constraints), trajectories, and what is refused.

tests: cli/run_beads.c cli/run_files.c cli/beads_report.c io/beads_sentence.c io/beads_text.c io/beads_file.c beads/scene.c"""
import json
import math
import unittest

from sweep_tools import Case

THIRTY = "drive: {frequency: 30 Hz}\nmodel: {chi: 1.243e-3}\n"  # chi of the independent program
OPPOSITE = THIRTY + "beads:\n  - start.phi: 3 deg\n  - start.phi: 183 deg\n"
# A snap: two beads 50 degrees apart.
SNAP = THIRTY + "beads:\n  - start: {phi: 3 deg}\n  - start: {phi: 53 deg}\n"


def bar(count):
    """Beads in a row along the magnet, at rest in its frame but for small gaps; heights of the arch are not told."""
    lines = [THIRTY + "start: {spin: rest}\nbeads:\n"]
    for i in range(count):
        lines.append(f"  - start.position: [{(i - (count - 1) / 2) * 5.0000001} mm, 0, 2.5 mm]\n"
                     f"    start.n: [1, 0, 0]\n")
    return "".join(lines)


class Beads(Case):
    def scene(self, text, name="scene.yaml"):
        with open(self.path(name), "w") as file:
            file.write(text)
        return self.path(name)

    def run_of(self, text, *words, turns=5, discard=2):
        return json.loads(self.good("run", self.scene(text), "--json", "--set", f"run.periods={turns}", "--set",
                                    f"run.discard={discard}", *words))

    def near(self, value, wanted, tolerance):
        self.assertLess(abs(value - wanted), tolerance, f"{value} is not {wanted}")


class Runs(Beads):
    def test_an_opposite_pair_to_five_turns(self):
        run = self.run_of(OPPOSITE, "--set", "run.rtol=1e-12")
        x, y = run["beads"][0]["final_state"][:2]
        self.near(x, -0.541044064192, 2e-10)
        self.near(y, 0.754309504732, 2e-10)
        self.assertLess(abs(run["energy_residual"]), 1e-12)
        self.assertEqual(run["outcome"], "apart")
        self.assertEqual([group["kind"] for group in run["groups"]], ["single", "single"])
        self.assertEqual([group["members"] for group in run["groups"]], [[0], [1]])
        self.assertEqual(run["scene"]["beads"], [{"start.phi": 3}, {"start.phi": 183}])
        self.assertEqual(len(run["beads"][1]["final_state"]), 12)
        self.assertEqual(run["contacts"], [{"a": 0, "b": None, "force": run["contacts"][0]["force"]},
                                           {"a": 1, "b": None, "force": run["contacts"][1]["force"]}])
        self.near(run["frequency_hz"], 30, 1e-12)
        self.assertEqual(run["counts"], {name: 0 for name in run["counts"]})

    def test_the_energy_residual_is_told_over_the_work_too(self):
        run = self.run_of(OPPOSITE, turns=20, discard=0)
        work = run["powers"]["drive"] * run["periods"] * 2 * math.pi / run["omega"]
        self.assertGreater(work, 0.3)
        self.near(run["energy_residual"] / run["relative_energy_residual"], work, 1e-9)
        stepped = self.run_of(OPPOSITE, "--set", "run.method=stepping", turns=1, discard=0)
        self.assertIsNone(stepped["relative_energy_residual"])
        self.assertIsNotNone(stepped["energy_residual"])

    def test_a_snap_and_its_events(self):
        run = self.run_of(SNAP, "--set", "contact.pair_rate=312.5", "--set", "run.rtol=1e-12", turns=2, discard=1)
        events = {(event["kind"], *event["beads"]): event for event in reversed(run["events"])}
        self.near(events["lift", 1]["time"], 18.133451, 2e-6)
        self.near(events["touch", 0, 1]["time"], 18.937630601, 1e-8)
        self.near(events["touch", 0, 1]["speed"], 0.693348445, 1e-8)
        self.near(events["lift", 0]["time"], 19.023942, 2e-6)
        self.near(events["land", 0]["time"], 19.235220, 2e-6)
        self.assertEqual(run["counts"]["touch"], sum(event["kind"] == "touch" for event in run["events"]))
        self.assertLess(abs(run["energy_residual"]), 1e-12)

    def test_apart_does_not_deny_a_contact(self):
        """These two touch at the end, but have not for a turn of the magnet."""
        run = self.run_of(SNAP.replace("53 deg", "60 deg"), "--set", "contact.pair_rate=312.5", turns=3.54, discard=1.5)
        self.assertIn((0, 1), {(contact["a"], contact["b"]) for contact in run["contacts"]})
        self.assertEqual((run["outcome"], run["reason"]), ("apart", "no two beads stay together for a turn of the magnet"))

    def test_beads_that_float_bounce_off_each_other(self):
        """Without plate, weight, moments and friction: momentum stays, and of the relative velocity the normal part, at
        the moment of the impact, comes back times the restitution."""
        text = ("plate: {shape: none, gravity: 0}\nmagnet: {shape: parts}\nfriction: {law: none}\nworld: {frame: laboratory}\n"
                "model: {chi: 0}\nfield: {uniform: [0, 0, 1 uT]}\nbead: {density: 7500 kg/m^3, moment: 0.02 A m^2}\n"
                "impact: {restitution: 0.7}\nbeads:\n")
        starts = ((2, (0, 0, 0), (0.3, 0.02, 0)), (3, (12, 1, 2), (-0.1, 0, 0.05)))  # mm, m/s
        for radius, place, velocity in starts:
            text += (f"  - {{radius: {radius} mm, start: {{position: [{', '.join(f'{x} mm' for x in place)}], n: [0, 0, 1], "
                     f"velocity: [{', '.join(f'{v} m/s' for v in velocity)}], angular_velocity: [0, 0, 0]}}}}\n")
        run = json.loads(self.good("run", self.scene(text), "--json", "--set", "run.duration=0.1s", "--set", "run.discard=0"))
        self.assertEqual((run["counts"]["touch"], run["restitution"]), (1, 0.7))
        after = [[23e-3 * 312.5 * v for v in bead["final_state"][3:6]] for bead in run["beads"]]
        apart = [b - a for a, b in zip(starts[0][1], starts[1][1])]
        before, left = ([b - a for a, b in zip(*pair)] for pair in ([start[2] for start in starts], after))
        time = 23e-3 * run["events"][0]["time"] / (23e-3 * 312.5)
        normal = [(x + 1e3 * v * time) / 5 for x, v in zip(apart, before)]
        self.near(math.hypot(*normal), 1, 1e-8)
        towards = sum(v * n for v, n in zip(before, normal))
        self.assertLess(towards, -0.2)
        for k in range(3):
            self.near(left[k], before[k] - 1.7 * towards * normal[k], 1e-8)
            self.near(sum(s[0]**3 * (v[k] - s[2][k]) for s, v in zip(starts, after)), 0, 1e-9)

    def test_beads_that_are_all_gone_have_no_means(self):
        words = ("--set", "plate.radius=21mm", "--set", "beads[0].start.r=0.9", "--set", "beads[1].start.r=0.9")
        run = self.run_of(OPPOSITE, *words, turns=40, discard=20)
        self.assertEqual([bead["regime"] for bead in run["beads"]], ["ejected"] * 2)
        self.assertEqual(set(run["powers"].values()), {None}, run["powers"])
        text = self.good("run", self.scene(OPPOSITE), "--set", "run.periods=40", "--set", "run.discard=20", *words)
        for word in ("means behind", "power", "nan"):
            self.assertNotIn(word, text)

    def test_a_bar_of_two(self):
        run = self.run_of(bar(2), turns=60, discard=59)
        self.assertEqual(run["outcome"], "bar")
        group, = run["groups"]
        self.assertEqual((group["kind"], sorted(group["members"]), group["centre_rate"]), ("pair", [0, 1], None))
        self.near(group["axis_rate"], run["omega"], 1e-6)
        forces = {(contact["a"], contact["b"]): contact["force"] for contact in run["contacts"]}
        self.near(forces[0, 1], 3.29360694, 1e-6)
        for bead in run["beads"]:
            self.near(bead["mean_load_weights"], 19.72219, 1e-4)
        self.near(run["powers"]["drive"], 5.53486e-5, 1e-9)
        self.near(run["powers"]["drive"], run["powers"]["plate"] + run["powers"]["pair"], 1e-9)

    def test_an_opposite_pair_in_the_long_run(self):
        """The periodic orbit has <r> = 0.92580221093 and alpha'/omega = -0.13233987620; the window holds no whole returns."""
        run = self.run_of(OPPOSITE, turns=700, discard=400)
        for bead in run["beads"]:
            self.assertEqual(bead["regime"], "counter-rotating")
            self.near(bead["mean_r"], 0.92580221093, 1e-5)
            self.near(bead["mean_alpha_dot"] / run["omega"], -0.13233987620, 1e-4)

    def test_a_walker(self):
        """The periodic walk has a centre at -0.1211756265 of the drive's rate, 0.6086857726 l from the axis, and the powers
        below; a window of this length knows them to a percent."""
        run = self.run_of(SNAP.replace("53 deg", "40 deg"), "--set", "contact.pair_rate=312.5", turns=400, discard=200)
        self.assertEqual((run["outcome"], run["sentence"]),
                         ("walker", "a pair turns with the magnet, and its centre walks against it"))
        group, = run["groups"]
        self.near(group["axis_rate"] / run["omega"], 1, 1e-3)
        self.near(group["centre_rate"] / run["omega"], -0.1211756265, 2e-3)
        for name, power, width in (("drive", 5.0949300e-3, 3e-5), ("plate", 2.0803862e-3, 2e-5),
                                   ("pair", 3.869493e-4, 1e-5), ("impacts", 2.6275946e-3, 3e-5)):
            self.near(run["powers"][name], power, width)

    def test_text_says_it_in_one_line_and_tables(self):
        text = self.good("run", self.scene(OPPOSITE), "--set", "run.periods=4", "--set", "run.discard=1")
        self.assertEqual(text.splitlines()[0], "two beads circle opposite each other, against the magnet")
        for word in ("method exact", "single", "counter-rotating", "mm", "Hz", "mW", "restitution", "lift 0"):
            self.assertIn(word, text)
        text = self.good("run", self.scene(bar(2)), "--set", "run.periods=60", "--set", "run.discard=59")
        self.assertEqual(text.splitlines()[0], "a pair turns with the magnet about the axis")
        self.assertRegex(text, r"(?m)^  pair     1 2 ")  # people count from 1, keys and JSON from 0
        self.assertRegex(text, r"(?m)^  1     locked (.|\n)*^  2     locked ")
        locked = self.good("locked", self.scene(bar(2)))
        self.assertRegex(locked, r"(?m)^     1   [\d.]+ (.|\n)*^     2   [\d.]+ ")
        self.assertIn("beads 1 and 2 press each other", locked)

    def test_one_bead_as_a_list_is_the_single_bead(self):
        alone = json.loads(self.good("run", "--json", "--set", "run.periods=20", "--set", "run.rtol=1e-12"))
        listed = self.run_of("beads: [{}]\n", "--set", "run.rtol=1e-12", turns=20)
        state = listed["beads"][0]["final_state"]
        for k, wanted in zip((0, 1, 3, 4, 6, 7, 8, 9, 10, 11), alone["final_state"]):
            self.near(state[k], wanted, 1e-9 if k > 8 else 1e-10)
        text = self.good("run", self.scene("beads: [{}]\n"), "--set", "run.periods=20")
        self.assertTrue(text.startswith("one bead circles, against the magnet\n"), text)

    def test_keys_of_beads_on_the_command_line(self):
        run = self.run_of(OPPOSITE, "--set", "beads[1].start.phi=170", "--set", "beads[2].start.r=0.2", "--set",
                          "beads[2].radius=1.5mm", turns=1, discard=0.1)
        self.assertEqual(run["scene"]["beads"], [{"start.phi": 3}, {"start.phi": 170},
                                                 {"bead.radius": 0.0015, "start.r": 0.2}])
        self.assertEqual(len(run["beads"]), 3)


class Stepping(Beads):
    def ring(self, count):
        lines = [f"  - start.phi: {360 * i / count}\n    start.n: [0, 0, 1]\n" for i in range(count)]
        return THIRTY + "start: {spin: rest, r: 1.5}\nbeads:\n" + "".join(lines)

    def test_two_beads_by_either_method(self):
        """Halving the step halves the distance to the exact method, or does better."""
        exact = self.run_of(OPPOSITE, turns=2, discard=1)["beads"][1]["final_state"]
        gaps = []
        for steps in (1000, 2000):
            run = self.run_of(OPPOSITE, "--set", "run.method=stepping", "--set", f"run.step={steps}", turns=2, discard=1)
            self.assertEqual((run["method"], run["steps_per_turn"], run["steps_accepted"]), ("stepping", steps, 2 * steps))
            gaps.append(math.dist(run["beads"][1]["final_state"][:3], exact[:3]))
        self.assertLess(gaps[1], 0.6 * gaps[0])
        seconds = self.run_of(OPPOSITE, "--set", "run.method=stepping", "--set", f"run.step={1 / 30 / 2000:.17g} s", turns=2,
                              discard=1)
        self.near(seconds["steps_per_turn"], 2000, 1e-9)

    def test_a_long_list(self):
        name = self.path("many.h5")
        run = self.run_of(self.ring(12), "--set", "run.method=stepping", "--set", "run.step=500", "-o", name, turns=1,
                          discard=0.5)
        self.assertEqual((len(run["beads"]), len(run["scene"]["beads"])), (12, 12))
        self.assertEqual(run["scene"]["beads"][1], {"start.phi": 30, "start.n[0]": 0, "start.n[1]": 0, "start.n[2]": 1})
        self.assertIn("have no keys", self.refused("run", self.scene(self.ring(12)), "--set", "beads[3].start.r=1"))
        self.assertIn("at most 8 beads", self.refused("sweep", self.scene(self.ring(12)), "--set", "run.method=stepping",
                                                      "--over", "drive.frequency=20,30", "-o", self.path("s.db")))


class Trajectories(Beads):
    def columns(self, name):
        with open(name) as file:
            lines = [line for line in file if not line.startswith("#")]
        heads = [head.split(" ")[0] for head in lines[0].strip().split(",")]
        rows = [[float(cell) for cell in line.split(",")] for line in lines[1:]]
        return {head: [row[i] for row in rows] for i, head in enumerate(heads)}

    def test_samples_do_not_change_the_run(self):
        name = self.path("t.csv")
        without = self.run_of(SNAP, turns=2, discard=1)
        run = self.run_of(SNAP, "--csv", name, turns=2, discard=1)
        self.assertEqual(run["beads"], without["beads"])
        columns = self.columns(name)
        text = self.good("run", self.scene(SNAP), "--set", "run.periods=2", "--set", "run.discard=1")
        for i, bead in enumerate(run["beads"]):  # the table tells the mean, of a bead that is lifted
            heights = columns[f"Z_{i}"][64:]
            mean = (sum(heights) - 0.5 * (heights[0] + heights[-1])) / 64
            self.near(bead["mean_height"], mean, 2e-4 * mean)
            self.assertIn(f" {23 * bead['mean_height']:.5g}\n", text)
        self.assertGreater(max(columns["Z_0"]), 0.11)
        self.assertEqual(len(columns["t"]), 2 * 64 + 1)
        self.near(columns["drive_turns"][-1], 2, 1e-12)
        states = ("X", "Y", "Z", "vX", "vY", "vZ", "nX", "nY", "nZ", "WX", "WY", "WZ")
        for bead in (0, 1):
            for k, column in enumerate(states):
                self.near(columns[f"{column}_{bead}"][-1], run["beads"][bead]["final_state"][k], 1e-9)
        radius = 2.5 / 23
        for row, force in enumerate(columns["force_0_1"]):  # they touch where there is a force, and there alone
            places = [[columns[f"{axis}_{bead}"][row] for axis in "XYZ"] for bead in (0, 1)]
            gap = math.dist(*places) - 2 * radius
            self.assertEqual(math.isnan(force), gap > 1e-9, (row, gap, force))
        self.assertTrue(any(math.isnan(load) for load in columns["load_1"]))

    def test_hdf5_has_the_numbers_of_csv(self):
        h5, csv, again = self.path("t.h5"), self.path("t.csv"), self.path("u.h5")
        self.good("run", self.scene(SNAP), "--set", "run.periods=1", "--set", "run.discard=0.5", "-o", h5, "--csv", csv)
        self.good("run", self.scene(SNAP), "--set", "run.periods=1", "--set", "run.discard=0.5", "-o", again)
        with open(h5, "rb") as one, open(again, "rb") as two:
            self.assertEqual(one.read(), two.read())

    def test_laboratory_units(self):
        scaled, lab = self.path("s.csv"), self.path("l.csv")
        for name, words in ((scaled, ()), (lab, ("--units", "lab"))):
            self.good("run", self.scene(OPPOSITE), "--set", "run.periods=1", "--set", "run.discard=0.5", "--csv", name, *words)
        one, two = self.columns(scaled), self.columns(lab)
        self.near(two["X_1"][5], one["X_1"][5] * 23, 1e-10)
        self.near(two["t"][5], one["t"][5] / 312.5, 1e-12)


class Refused(Beads):
    def says(self, wanted, text, *words, command="run"):
        error = self.refused(command, self.scene(text), *words)
        self.assertIn(wanted, error)

    def test_what_cannot_be(self):
        self.says("overlap at the start", "beads: [{}, {}]\n")
        self.says("beads 1 and 2", "beads:\n  - start.phi: 3\n  - start.phi: 5\n")
        self.says("at most 8 beads, and the scene lists 100: choose stepping", "beads: [" + ", ".join(["{}"] * 100) + "]\n")
        self.says("more than 1000 beads", "beads: [" + ", ".join(["{}"] * 1001) + "]\n")
        self.says("choose stepping", OPPOSITE, "--set", "run.step=1e-5")
        self.says("list several in beads", "contact: {pair_rate: 300}\n")
        self.says("contact.pair_rate has no effect on one bead", "contact: {pair_rate: 300}\nbeads:\n  - {}\n")
        self.says("list several in beads", "model: {chi: 1e-3}\n")
        self.says("impact.restitution has no effect with plate.shape none",
                  "plate: {shape: none}\nimpact: {restitution: 0.5}\nbeads:\n  - {}\n")
        self.says("scene.yaml:2", "beads:\n  - start: {phii: 3}\n")
        self.says("start.phi", "beads:\n  - start: {phii: 3}\n")
        self.says("for one bead", OPPOSITE, "--ramp", "7:20")
        self.says("no effect", OPPOSITE, "--set", "beads[1].bead.a=1")
        self.says("rigid", OPPOSITE, "--set", "model.dynamics=farago2020")
        self.says("choose a smaller", OPPOSITE, "--set", "beads[1].start.r=20")
        self.says("below its place", "beads:\n  - start.position: [20 mm, 0, 1 mm]\n  - {}\n")

    def test_commands_for_one_bead(self):
        self.says("bead", OPPOSITE, command="lyapunov")

    def test_check(self):
        self.assertIn("good scene; beads: 2", self.good("check", self.scene(OPPOSITE)))
        self.says("overlap", "beads: [{}, {}]\n", command="check")
        self.assertEqual(len(json.loads(self.good("check", self.scene(OPPOSITE), "--json"))["scene"]["beads"]), 2)


if __name__ == "__main__":
    unittest.main()
