"""Worlds by the program: their scenes, what run and locked tell of them, and what is refused in words.

tests: cli/run_world.c cli/run_files.c cli/init.c beads/world_run.c"""

import json
import math
import os
import unittest

from sweep_tools import Case

SCENES = os.path.join(os.environ["SOURCE_DIR"], "examples", "worlds")


class Worlds(Case):
    def scene(self, name):
        path = self.path(name + ".yaml")
        if not os.path.exists(path):
            self.good("init", path, "--world", name)
        return path

    def test_init_writes_the_examples(self):
        for name in ("levitation", "bowl", "water"):
            with open(os.path.join(SCENES, name + ".yaml"), encoding="utf-8") as file:
                self.assertEqual(self.good("init", "-", "--world", name), file.read())
            self.good("check", self.scene(name))
        self.assertIn("levitation", self.refused("init", "-", "--world", "levitatoin"))
        self.assertIn("start.position[2]", self.refused("init", "-", "--set", "plate.shape=none"))  # as `check` says
        self.assertIn("plate.bowl_radius", self.refused("init", self.path("b.yaml"), "--set", "plate.shape=bowl"))

    def test_levitation(self):
        run = json.loads(self.good("run", self.scene("levitation"), "--json"))
        self.assertEqual((run["regime"], run["frame"]), ("levitating", "turning"))
        self.assertLess(abs(run["energy_residual"]), 1e-10)
        self.assertAlmostEqual(run["final_lab_si"][2], 25.056e-3, delta=2e-5)
        self.assertRegex(run["reason"], r"on average 25\.05\d* mm below the magnet's reference plane$")  # gravity is negative
        self.assertEqual(len(run["final_lab"]), 12)
        # 600 whole turns: the magnet's axes are the laboratory's again
        for one, other in zip(run["final_lab"], run["final_state"]):
            self.assertAlmostEqual(one, other, delta=1e-9)
        lost = json.loads(self.good("run", self.scene("levitation"), "--set", "medium.drag_rate=3", "--set",
                                    "medium.spin_drag_rate=3", "--json"))
        self.assertIn(lost["regime"], ("lost", "touched"))
        self.assertLess(lost["final_time"], run["final_time"])
        states = json.loads(self.good("locked", self.scene("levitation"), "--json"))["states"]
        best = next(state for state in states if state["position_m"][2] > 0)
        self.assertTrue(best["stable"])
        self.assertAlmostEqual(best["height_mm"], 25.056, delta=2e-2)
        self.assertEqual(len(best["eigenvalues_per_s"]), 11)
        self.assertAlmostEqual(math.hypot(*best["n"]), 1, delta=1e-12)

    def test_a_bead_that_is_lost_has_no_means(self):
        """It lives 15 periods, and its window would begin after 225."""
        words = ("run", self.scene("levitation"), "--set", "drive.frequency=150Hz")
        lost, text = json.loads(self.good(*words, "--json")), self.good(*words)
        self.assertEqual(lost["regime"], "lost")
        means = {key: value for key, value in lost.items() if key.startswith("mean_") or key == "window_periods"}
        self.assertEqual(set(means.values()), {None}, means)
        self.assertIsNotNone(lost["energy_residual"])  # of the whole run
        for word in ("means over", "power", "nan"):
            self.assertNotIn(word, text)

    def test_a_wave_that_lifts_a_bead_loses_it(self):
        """The field from above grows with the height as exp(k z): the bead that it lifts ends a wave length up."""
        words = (self.scene("wave"), "--set", "wave.ratio=3", "--set", "run.duration=0.5s")
        run = json.loads(self.good("run", *words, "--json", "--csv", self.path("up.csv")))
        self.assertEqual((run["regime"], run["mean_r"]), ("lost", None))
        self.assertIn("had risen by a wave length", run["reason"])
        self.assertAlmostEqual(run["final_lab_si"][2], 62.5e-3, delta=1e-9)
        with open(self.path("up.csv"), encoding="utf-8") as file:
            self.assertGreater(len(file.readlines()), 60)
        self.good("sweep", *words, "--over", "wave.ratio=0,2", "-o", self.path("up.db"))
        rows = json.loads(self.good("export", self.path("up.db"), "--json"))
        self.assertEqual([row["regime"] for row in rows], ["backward", "lost"])
        self.assertIn("more than a wave.length", self.refused("run", *words, "--set", "start.position[2]=65mm"))
        with open(self.path("two.yaml"), "w", encoding="utf-8") as scene:
            scene.write("drive: {waveform: wave, frequency: 2 Hz}\nwave: {length: 60 mm, amplitude: 2 mT, ratio: 3}\nmagnet: {shape: parts}\n"
                        "bead: {mass: 0.5 g, remanence: 1.2 T}\nplate: {radius: 10 m}\nstart: {spin: rest}\nbeads:\n"
                        "  - start.position: [0, 0, 2.5 mm]\n  - start.position: [20 mm, 0, 2.5 mm]\nrun: {duration: 0.1 s, discard: 0}\n")
        two = json.loads(self.good("run", self.path("two.yaml"), "--json"))
        self.assertEqual(([bead["regime"] for bead in two["beads"]], two["sentence"]), (["lost"] * 2, "two beads gone"))
        self.assertIn("bead 1 was lost", two["reason"])

    def test_a_height_that_goes_on_has_not_settled(self):
        words = ("--set", "plate.shape=none", "--set", "plate.gravity=0", "--set", "magnet.shape=parts", "--set", "bead.remanence=1T",
                 "--set", "field.uniform[2]=1uT", "--set", "start.velocity[2]=0.05m/s", "--set", "start.spin=rest")
        place = [word for i, n in enumerate((0, 0, 1)) for key in (f"start.position[{i}]=0mm", f"start.n[{i}]={n}", f"start.angular_velocity[{i}]=0")
                 for word in ("--set", key)]
        run = json.loads(self.good("run", *words, *place, "--set", "start.velocity[0]=0", "--set", "start.velocity[1]=0", "--json",
                                   "--set", "run.duration=0.5s", "--set", "run.discard=0"))
        self.assertEqual(run["regime"], "undecided")
        self.assertIn("its mean height goes from", run["reason"])

    def test_a_bead_that_meets_a_wire_ends_there(self):
        """The field of a wire has no end: a bead that a coil pulls in would take ever shorter steps."""
        path = self.path("coil.yaml")
        text = ("bead: {radius: 1 mm, density: 7.4 g/cm^3, remanence: 1.2 T}\nmagnet: {shape: parts, depth: 0 mm}\n"
                "coils:\n  - {radius: 20 mm, centre: [0, 0, 1 mm], axis: [0.3, 0, 1], turns: 200, current: 2 A}\n"
                "start: {position: [5 mm, 3 mm, 1 mm], spin: rest}\ndrive: {frequency: 2 Hz}\nrun: {duration: 2 s}\n")
        with open(path, "w", encoding="utf-8") as file:
            file.write(text)
        run = json.loads(self.good("run", path, "--json"))
        self.assertEqual(run["regime"], "touched")
        self.assertIn("the wire of a coil", run["reason"])
        x, y, z = (1e3 * value for value in run["final_lab_si"][:3])
        across = math.hypot(1, 0.3)
        along = (0.3 * x + z - 1) / across  # the axis of the coil
        off = math.hypot(math.sqrt(x * x + y * y + (z - 1) ** 2 - along * along) - 20, along)
        self.assertAlmostEqual(off, 1, places=6)  # the bead's radius from the wire

    def test_branch_of_levitation(self):
        scene, path, figure = self.scene("levitation"), self.path("b.json"), self.path("b.svg")
        branch = ("branch", scene, "--kind", "levitating", "--over", "magnet.parts[0].rotation[0]=3.5:6")
        told = json.loads(self.good(*branch, "--json", "-o", path))
        with open(path, encoding="utf-8") as file:
            self.assertEqual(json.load(file), told)
        fold = next(s for s in told["specials"] if s["type"] == "fold")
        states = json.loads(self.good("locked", scene, "--set", f"magnet.parts[0].rotation[0]={fold['value'] * 1.000001}",
                                      "--json"))["states"]
        self.assertLess(min(abs(s["height_mm"] - fold["at"]["height_mm"]) for s in states), 0.1)
        self.assertEqual({len(p["eigenvalues_per_s"]) for p in told["points"]}, {11})
        for name in ((), ("--quantity", "circle_mm"), ("--quantity", "multipliers")):
            self.good("plot", path, *name, "-o", figure)
            with open(figure, encoding="utf-8") as file:
                words = file.read()
            self.assertIn(("distance from the magnet", "circle", "Eigenvalues")[len(name) and 1 + ("multipliers" in name)], words)
            if "multipliers" not in name:
                for side in ("stable, above the magnet", "stable, below the magnet"):
                    self.assertIn(side, words)
        self.assertIn("height_mm", self.refused("plot", path, "--quantity", "festoons", "-o", figure))
        self.assertIn("one of a family", self.refused(*branch, "--set", "medium.spin_drag_rate=0"))
        self.assertIn("leave it out", self.refused(*branch, "--tolerance", "1e-9"))

    def test_trajectories(self):
        for name, frame in (("levitation", "turning"), ("compass", "laboratory"), ("wave", "laboratory")):
            words = ("run", self.scene(name), "--set", "run.duration=0.1", "--json")
            plain = json.loads(self.good(*words))
            path = self.path(name + ".csv")
            told = json.loads(self.good(*words, "--csv", path, "-o", self.path(name + ".h5"), "--sample-rate", "100"))
            self.assertEqual(told["frame"], frame)
            with open(path, encoding="utf-8") as file:
                lines = file.read().splitlines()
            table = [line.split(",") for line in lines if not line.startswith("#")]
            self.assertEqual((len(table), table[0][2], table[0][-1]), (12, "X_0 [l]", "load_0 [l gamma^2]"))
            last = [float(cell) for cell in table[-1][:14]]
            self.assertAlmostEqual(last[0], told["final_time"], delta=1e-9 * told["final_time"])
            # the magnet's turns: a wave has none
            self.assertAlmostEqual(last[1], 0 if name == "wave" else 0.1 * told["frequency_hz"], delta=1e-9)
            for one, other in zip(last[2:], told["final_state"]):
                self.assertAlmostEqual(one, other, delta=1e-8 * max(1, abs(other)))
            result = json.loads(next(line for line in lines if line.startswith("# result = "))[11:])
            self.assertEqual(result["frame"], frame)
            for key in ("regime", "final_lab"):
                self.assertEqual(result[key], told[key])
            if frame == "laboratory":  # samples change nothing
                self.assertEqual(plain["final_lab"], told["final_lab"])

    def test_loads_of_samples_are_the_same_in_both_frames(self):
        """In the laboratory's frame the field at a sample is that of the sample's time."""
        loads = {}
        for frame in ("turning", "laboratory"):
            path = self.path(frame + ".csv")
            told = json.loads(self.good("run", self.scene("bowl"), "--set", f"world.frame={frame}", "--set", "run.periods=4",
                                        "--set", "run.discard=1", "--csv", path, "--json"))
            with open(path, encoding="utf-8") as file:
                table = [line.strip().split(",") for line in file if not line.startswith("#")]
            self.assertEqual(table[0][-1], "load_0 [l gamma^2]")
            loads[frame] = [float(row[-1]) for row in table[1:]]
            heights = [float(row[table[0].index("Z_0 [l]")]) for row in table[1:] if float(row[1]) >= 1]  # the window's
            self.assertAlmostEqual(told["mean_height"], (sum(heights) - (heights[0] + heights[-1]) / 2) / (len(heights) - 1), delta=1e-5)
        self.assertEqual(len(loads["turning"]), 257)
        for one, other in zip(*loads.values()):
            self.assertAlmostEqual(one, other, delta=1e-10)

    def test_bowl_and_water(self):
        for name in ("bowl", "water"):
            run = json.loads(self.good("run", self.scene(name), "--set", "run.periods=40", "--json"))
            self.assertLess(abs(run["energy_residual"]), 1e-10)
            self.assertLess(run["mean_alpha_dot"], 0)

    def test_a_start_a_little_below_the_bowl_is_on_it(self):
        """Told with seven digits; the bead then is where the wall is, towards the bowl's centre."""
        rho = 97.5
        for low, x, good in ((34e-6, 20.0, True), (99e-6, 20.0, True), (150e-6, 20.0, False)):
            z = 100 - math.sqrt(rho**2 - x**2) - low
            words = [word for text in ("plate.shape=bowl", "plate.bowl_radius=100mm", "start.spin=rest", f"start.position[0]={x}mm", "start.position[1]=0mm",
                                       f"start.position[2]={z!r}mm", "run.duration=1ms", "run.discard=0", "run.samples=1000") for word in ("--set", text)]
            if not good:
                self.assertIn("below its place", self.refused("run", *words))
                continue
            self.good("run", *words, "--csv", self.path("low.csv"))
            with open(self.path("low.csv"), encoding="utf-8") as file:
                first = [line for line in file if not line.startswith("#")][1].split(",")
            place = [23 * float(cell) for cell in first[2:5]]
            self.assertAlmostEqual(math.hypot(place[0], place[1], place[2] - 100), rho, delta=1e-10)
            self.assertAlmostEqual(place[0] / (100 - place[2]), x / (100 - z), delta=1e-12)

    def test_a_wide_bowl_in_thin_air_is_the_plate(self):
        flat = json.loads(self.good("run", "--set", "run.periods=20", "--json"))
        bowl = json.loads(self.good("run", "--set", "run.periods=20", "--set", "plate.shape=bowl", "--set",
                                    "plate.bowl_radius=1000 m", "--json"))
        air = json.loads(self.good("run", "--set", "run.periods=20", "--set", "medium.drag_rate=1e-9", "--json"))
        for k, place in enumerate((0, 1, 3, 4, 6, 7, 8, 9, 10, 11)):
            self.assertAlmostEqual(air["final_state"][place], flat["final_state"][k], delta=1e-7)
            self.assertAlmostEqual(bowl["final_state"][place], flat["final_state"][k], delta=1e-2)
        none = json.loads(self.good("run", "--set", "run.periods=20", "--set", "medium.drag_rate=0", "--json"))
        radii = [json.loads(self.good("run", "--set", "magnet.b0=7.3 mT", "--set", f"field.uniform[2]={field}", "--json"))["mean_r"]
                 for field in ("0", "-50e-6")]  # that of the Earth shifts <r> by 0.1 to 0.2 %
        self.assertLess(abs(radii[1] / radii[0] - 1 + 0.0015), 0.0006)
        self.assertEqual(none["final_state"], flat["final_state"])

    def test_orbits_and_locked_states(self):
        """In a bowl as wide as a plain they are those of the flat plate; in narrow ones and in water there are others."""
        wide = ("--set", "plate.shape=bowl", "--set", "plate.bowl_radius=1000 m")
        flat, bowl = (json.loads(self.good("orbit", *words, "--json")) for words in ((), wide))
        for key in ("period", "mean_r", "mean_alpha_dot"):
            self.assertAlmostEqual(flat[key], bowl[key], delta=1e-4 * abs(flat[key]))
        for one, other in zip(flat["multipliers"][:4], bowl["multipliers"][:4]):
            self.assertLess(math.hypot(one[0] - other[0], one[1] - other[1]), 1e-4)
        slow = ("--set", "drive.frequency=4")
        states = json.loads(self.good("locked", *slow, "--json"))["states"]
        state = json.loads(self.good("locked", *slow, *wide, "--json"))["states"][0]
        at = min((s for s in states if s["stable"]), key=lambda s: abs(s["r"] - state["beads"][0]["r"]))
        self.assertAlmostEqual(at["r"], state["beads"][0]["r"], delta=1e-4)
        self.assertEqual(len(state["eigenvalues"]), 9)
        for one, other in zip(sorted(at["eigenvalues"]), sorted(state["eigenvalues"])):
            self.assertLess(abs(one[0] - other[0]), 1e-3)
        self.assertTrue(json.loads(self.good("orbit", self.scene("bowl"), "--json"))["stable"])
        self.assertIn("--kind locked", self.refused("branch", self.scene("bowl"), "--kind", "counter", "--over", "drive.omega=0.1:0.2"))

    def test_a_bead_at_rest_circles_neither_way(self):
        """Beside a block that stands still, in a uniform field, over a coil: rounding is no sense, and nothing drives."""
        block = "- {kind: cuboid, centre: [0, 0, 0], size: [50 mm, 20 mm, 10 mm], remanence: [0.5 T, 0, 0], motion: fixed}"
        dipole = "- {kind: dipole, centre: [0, 0, -30 mm], moment: [0.2, 0, 0]}"
        coil = "coils: [{radius: 40 mm, centre: [0, 0, -20 mm], axis: [0, 0, 1], turns: 200, current: 1}]\n"
        scenes = (("rests in the laboratory", block, ""), ("rests in the laboratory", "", "field: {uniform: [1 mT, 0, 0]}\n"),
                  ("", "", coil), ("", f"{block}\n  {dipole}", ""))
        path = self.path("still.yaml")
        for says, parts, rest in scenes:
            with open(path, "w", encoding="utf-8") as scene:
                scene.write("magnet:\n  shape: parts\n" + (f"  parts:\n  {parts}\n" if parts else "") + rest +
                            "bead: {remanence: 1.2 T, density: 7500}\nstart: {r: 0.5, spin: rest}\nrun: {duration: 4 s}\n")
            for more in ("run.duration=4s", "run.duration=5s", "start.phi=20"):
                run = json.loads(self.good("run", path, "--set", more, "--json"))
                self.assertEqual(run["regime"], "undecided", run["reason"])
                self.assertIn(says, run["reason"])
                self.assertNotIn("drive's rate", run["reason"])
                self.assertLess(abs(run["mean_alpha_dot"]), 1e-4 * run["omega"])

    def test_means_have_errors(self):
        """A bead on a plate that is all but level, as on a level one: windows cut its swings off anywhere."""
        for frequency, periods in (("9Hz", 400), ("9Hz", 60), ("8.5Hz", 60), ("10.7Hz", 60)):
            words = ("run", "--json", "--set", "magnet.depth=8mm", "--set", f"drive.frequency={frequency}")
            level = json.loads(self.good(*words))
            run = json.loads(self.good(*words, "--set", "plate.tilt=1e-6deg", "--set", f"run.periods={periods}"))
            for key in ("mean_r", "mean_alpha_dot"):
                error = run[key + "_error"]
                self.assertLess(abs(run[key] - level[key]), error)
                self.assertLess(error, 4.6 * level["omega"] / periods)  # of a turn or so, not of many

    def test_a_bead_on_the_axis_has_no_rate(self):
        block = "{kind: cuboid, centre: [0, 0, -5 mm], size: [20 mm, 10 mm, 5 mm], remanence: [0, 0, 1.2 T], motion: fixed}"
        with open(self.path("axis.yaml"), "w", encoding="utf-8") as scene:
            scene.write(f"magnet: {{shape: parts, depth: 10 mm, parts: [{block}]}}\nbead: {{mass: 0.5 g, remanence: 1.2 T}}\n"
                        "start: {position: [5 mm, 2 mm, 2.5 mm], spin: rest}\nrun: {duration: 10 s}\n")
        run = json.loads(self.good("run", self.path("axis.yaml"), "--json"))
        self.assertEqual((run["regime"], run["mean_alpha_dot"], run["mean_alpha_dot_error"]), ("undecided", None, None))
        self.assertIn("rests in the laboratory", run["reason"])

    def test_the_field_in_a_bowl_is_that_at_the_bead(self):
        there = ("field", self.scene("bowl"), "--at", "20mm,5mm", "--json")
        bead, rise = json.loads(self.good(*there)), 197.5 - math.sqrt(197.5**2 - 20**2 - 5**2)
        middle = json.loads(self.good("field", self.scene("bowl"), "--at", "0,0", "--json"))
        self.assertAlmostEqual(bead["height"] - middle["height"], rise / 23, delta=1e-12)
        self.assertEqual(json.loads(self.good(*there, "--height", repr(bead["height"]))), bead)
        self.assertIn("in the bowl", self.refused("field", self.scene("bowl"), "--at", "198mm,0"))
        self.assertNotIn("on the plate\n", self.good("field", self.scene("levitation"), "--at", "0,0"))

    def test_driven(self):
        words = ("--set", "world.frame=laboratory", "--set", "run.discard=1", "--set", "drive.frequency=164", "--set",
                 "start.position[2]=32 mm")
        path, figure = self.path("driven.json"), self.path("driven.svg")
        self.assertIn("kind driven does not follow in the magnet's frame: set world.frame to laboratory",
                      self.refused("branch", self.scene("levitation"), "--kind", "driven", "--over", "drive.frequency=161:165"))
        told = json.loads(self.good("branch", self.scene("levitation"), *words, "--kind", "driven", "--over",
                                    "drive.frequency=161:165", "-o", path, "--json"))
        self.assertEqual([s["type"] for s in told["specials"]], ["fold"])
        self.assertAlmostEqual(told["specials"][0]["value"], 162.077, delta=1e-3)
        self.assertEqual({len(p["state"]) for p in told["points"]}, {12})
        self.good("plot", path, "-o", figure)
        self.good("plot", path, "--quantity", "multipliers", "-o", figure)
        self.assertIn("1 branch, ", self.good("branch", "--kind", "counter", "--over", "drive.frequency=14.9Hz:15Hz"))

    def test_refusals(self):
        for words, *sets in (("give plate.bowl_radius", "plate.shape=bowl"),
                             ("larger than the bead", "plate.shape=bowl", "plate.bowl_radius=2mm"),
                             ("plate.bowl_radius has no effect", "plate.bowl_radius=1"),
                             ("without medium.density", "medium.drag_coefficient=0.4"),
                             ("choose one above 0", "plate.tilt_azimuth=3"),
                             ("choose carried", "drive.velocity[1]=1"),
                             ("slide as well as roll", "friction.law=rolling", "plate.tilt=1deg"),
                             ("say", "medium.viscosity=1e-3", "medium.drag_rate=1"),
                             ("pulls the bead off", "plate.gravity=-9.81"),
                             ("start.position[2]", "plate.shape=none"),
                             ("below its place", "start.position[0]=5mm", "start.position[2]=1mm")):
            words_of_sets = [word for text in sets for word in ("--set", text)]
            self.assertIn(words, self.refused("run", *words_of_sets))
        self.assertIn("inside the magnet", self.refused("run", self.scene("levitation"), "--set",
                                                        "start.position[2]=12mm"))
        self.assertRegex(self.refused("lyapunov", "--set", "medium.density=1000"),
                         r"medium\.density: festoon lyapunov takes one bead .* eigenvalues of festoon locked say; .* two runs")
        self.assertIn("plate.shape none", self.refused("branch", "--kind", "levitating", "--over", "drive.omega=1:2"))


if __name__ == "__main__":
    unittest.main()
