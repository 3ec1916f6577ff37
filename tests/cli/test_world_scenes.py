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

    def test_levitation(self):
        run = json.loads(self.good("run", self.scene("levitation"), "--json"))
        self.assertEqual((run["regime"], run["frame"]), ("levitating", "turning"))
        self.assertLess(abs(run["energy_residual"]), 1e-10)
        self.assertAlmostEqual(run["final_lab_si"][2], 25.056e-3, delta=2e-5)
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

    def test_trajectories(self):
        for name, frame in (("levitation", "turning"), ("compass", "laboratory"), ("wave", "laboratory")):
            words = ("run", self.scene(name), "--set", "run.duration=0.1", "--json")
            plain = json.loads(self.good(*words))
            path = self.path(name + ".csv")
            told = json.loads(self.good(*words, "--csv", path, "-o", self.path(name + ".h5"), "--fps", "100"))
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
            self.good("run", self.scene("bowl"), "--set", f"world.frame={frame}", "--set", "run.periods=4", "--set",
                      "run.discard=1", "--csv", path)
            with open(path, encoding="utf-8") as file:
                table = [line.strip().split(",") for line in file if not line.startswith("#")]
            self.assertEqual(table[0][-1], "load_0 [l gamma^2]")
            loads[frame] = [float(row[-1]) for row in table[1:]]
        self.assertEqual(len(loads["turning"]), 257)
        for one, other in zip(*loads.values()):
            self.assertAlmostEqual(one, other, delta=1e-10)

    def test_bowl_and_water(self):
        for name in ("bowl", "water"):
            run = json.loads(self.good("run", self.scene(name), "--set", "run.periods=40", "--json"))
            self.assertLess(abs(run["energy_residual"]), 1e-10)
            self.assertLess(run["mean_alpha_dot"], 0)

    def test_a_wide_bowl_in_thin_air_is_the_plate(self):
        flat = json.loads(self.good("run", "--set", "run.periods=20", "--json"))
        bowl = json.loads(self.good("run", "--set", "run.periods=20", "--set", "plate.shape=bowl", "--set",
                                    "plate.bowl_radius=1000 m", "--json"))
        air = json.loads(self.good("run", "--set", "run.periods=20", "--set", "medium.drag_rate=1e-9", "--json"))
        for k, place in enumerate((0, 1, 3, 4, 6, 7, 8, 9, 10, 11)):
            self.assertAlmostEqual(air["final_state"][place], flat["final_state"][k], delta=1e-7)
            self.assertAlmostEqual(bowl["final_state"][place], flat["final_state"][k], delta=1e-2)
        none = json.loads(self.good("run", "--set", "run.periods=20", "--set", "medium.drag_rate=0", "--json"))
        self.assertEqual(none["final_state"], flat["final_state"])

    def test_refusals(self):
        for words, *sets in (("give plate.bowl_radius", "plate.shape=bowl"),
                             ("larger than the bead", "plate.shape=bowl", "plate.bowl_radius=2mm"),
                             ("plate.bowl_radius has no effect", "plate.bowl_radius=1"),
                             ("without medium.density", "medium.drag_coefficient=0.4"),
                             ("say", "medium.viscosity=1e-3", "medium.drag_rate=1"),
                             ("pulls the bead off", "plate.gravity=-9.81"),
                             ("start.position[2]", "plate.shape=none"),
                             ("below its place", "start.position[0]=5mm", "start.position[2]=1mm")):
            words_of_sets = [word for text in sets for word in ("--set", text)]
            self.assertIn(words, self.refused("run", *words_of_sets))
        self.assertIn("inside the magnet", self.refused("run", self.scene("levitation"), "--set",
                                                        "start.position[2]=12mm"))
        for command in (("orbit",), ("locked",), ("lyapunov",)):
            self.assertIn("medium.density", self.refused(*command, "--set", "medium.density=1000"))
        self.assertIn("plate.shape none", self.refused("branch", "--kind", "levitating", "--over", "drive.omega=1:2"))


if __name__ == "__main__":
    unittest.main()
