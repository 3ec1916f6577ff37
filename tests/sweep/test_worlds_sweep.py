"""Sweeps over worlds and over places of levitation: rows are what single calls tell, and what cannot be is refused.

tests: sweep/bead_columns.c"""
import json
import math
import os
import sqlite3
import unittest

from sweep_tools import Case

SCENES = os.path.join(os.environ["SOURCE_DIR"], "examples", "worlds")
WAVE, WEAK = os.path.join(SCENES, "wave.yaml"), ("--set", "wave.amplitude=0.05 mT", "--set", "plate.radius=500")
SHORT = ("--set", "run.periods=4", "--set", "run.discard=2")
# scene, what is set, what is varied; a tilted plate is not a file
POINTS = (("levitation.yaml", ("--set", "run.duration=0.05"), "medium.drag_rate=5,10"),
          ("bowl.yaml", SHORT, "plate.bowl_radius=0.3 m,0.5 m"),
          ("water.yaml", SHORT, "medium.density=500,1000"),
          ("coils.yaml", ("--set", "run.duration=0.2"), "coils[0].current=0.5,1"),
          ("compass.yaml", SHORT, "field.uniform[0]=2e-5,4e-5"),
          ("wave.yaml", ("--set", "run.duration=0.2"), "wave.ratio=0,0.2"),
          (None, SHORT, "plate.tilt=0,2"))


class Sweeps(Case):
    def rows(self, name):
        return json.loads(self.good("export", name, "--json"))

    def test_rows_are_single_runs(self):
        for scene, sets, over in POINTS:
            with self.subTest(over):
                name, key = self.path(over.split("=")[0] + ".db"), over.split("=")[0]
                words = [] if scene is None else [os.path.join(SCENES, scene)]
                self.good("sweep", *words, *sets, "--over", over, "-o", name)
                rows = self.rows(name)
                self.assertEqual(len(rows), 2)
                for row in rows:
                    run = json.loads(self.good("run", *words, *sets, "--set", f"{key}={row[key]}", "--json"))
                    if "frame" not in run:  # no tilt: a bead on the plate, whose state has no height
                        state = run["final_state"]
                        run.update(frame="turning", mean_height=None, mean_medium_power=None,
                                   mean_velocity=None, mean_velocity_error=None,
                                   final_state=[*state[:2], None, *state[2:4], None, *state[4:]])
                    columns = set(row) - {"point", key, "status", "carried"}
                    self.assertLess(20, len(columns))
                    for column in columns:
                        self.assertEqual(row[column], run[column], column)

    def test_a_lost_bead_has_no_powers(self):
        name, keys = self.path("lost.db"), "regime,mean_drive_power,mean_medium_power,window_periods"
        self.good("sweep", os.path.join(SCENES, "levitation.yaml"), "--over", "drive.frequency=150Hz", "-o", name)
        self.assertEqual(self.good("export", name, "--csv", "--quantity", keys).splitlines()[1], "150,lost,,,,done")

    def test_a_sweep_goes_on(self):
        name, other, over = self.path("s.db"), self.path("t.db"), "drive.frequency=10Hz:20Hz:4"
        words = ("sweep", os.path.join(SCENES, "bowl.yaml"), *SHORT, "--over", over)
        self.good(*words, "-o", name)
        before = self.rows(name)
        self.assertIn("4 points, 0 of them new", self.good(*words, "-o", name))
        self.good(*words, "--threads", "2", "-o", other)
        self.assertEqual(self.rows(other), before)
        self.assertIn("plate.bowl_radius", self.refused(*words, "--set", "plate.bowl_radius=1 m", "-o", name))
        lines = self.good("export", name, "--csv", "--quantity", "regime,frame,mean_r", "--units", "lab").splitlines()
        self.assertEqual(lines[0], "drive.frequency [Hz],regime,frame,mean_r [mm],status")
        self.assertEqual(lines[1].split(",")[2::2], ["turning", "done"])
        self.assertRegex(self.good("export", name, "--csv", "--units", "lab").splitlines()[0],
                         r"regime,mean_r \[mm\],mean_alpha_dot \[Hz\],mean_velocity \[mm/s\],status")
        self.assertIn("of a bead in a world, have no std_r; no name is like it", self.refused("export", name, "--csv", "--quantity", "std_r"))
        self.good("export", name, "--hdf5", "-o", self.path("s.h5"))
        self.good("plot", name, "-o", self.path("s.svg"))

    def test_places_are_those_of_locked(self):
        name, scene = self.path("map.db"), os.path.join(SCENES, "levitation.yaml")
        tilt, drag = "magnet.parts[0].rotation[0]", ("--set", "medium.drag_rate=1", "--set", "medium.spin_drag_rate=1")
        words = ("sweep", scene, *drag, "--over", f"{tilt}=3,5,8,12", "--over", "drive.frequency=75,77,106,108,158,161,163,257,259")
        self.good(*words, "--levitation", "-o", name)
        rows = {(row[tilt], row["drive.frequency"]): row for row in self.rows(name)}
        # below: the folds of WORLDS.md at 258.0, 162.1, 106.9 and 75.9 Hz; above: the Hopf point at 158.8 Hz
        for at, under, over in ((3, 257, 259), (5, 161, 163), (8, 106, 108), (12, 75, 77)):
            self.assertEqual(rows[at, under]["below"], "none")
            self.assertEqual(rows[at, over]["below"], "stable")
        self.assertEqual((rows[5, 158]["above"], rows[5, 161]["above"]), ("oscillates", "stable"))
        self.assertIsNone(rows[5, 161]["below_height_mm"])
        for (angle, frequency) in ((5, 163), (5, 158), (12, 77)):
            row = rows[angle, frequency]
            states = json.loads(self.good("locked", scene, *drag, "--set", f"{tilt}={angle}", "--set",
                                          f"drive.frequency={frequency}", "--json"))["states"]
            self.assertEqual(row["places"], len(states))
            for side, sign in (("below", 1), ("above", -1)):  # gravity is negative: below is z > 0
                here = [s for s in states if sign * s["position_m"][2] > 0]
                best = min(here, default=None, key=lambda s: (not s["stable"], s["eigenvalues_per_s"][0][0] * (not s["stable"])))
                for column, key in (("height_mm", "height_mm"), ("tilt_deg", "tilt_deg"), ("gap_mm", "gap_mm")):
                    self.assertEqual(row[f"{side}_{column}"], best and best[key])
                self.assertEqual(row[f"{side}_growth_per_s"], best and best["eigenvalues_per_s"][0][0])
        for words_of_key in ((), ("--quantity", "above"), ("--quantity", "below_height_mm")):
            figure = self.path("f.svg")
            self.good("plot", name, *words_of_key, "-o", figure)
            with open(figure, encoding="utf-8") as file:
                text = file.read()
            for word in ("stable", "none") if not words_of_key else ("stable", "oscillates") if "above" in words_of_key else ("height below",):
                self.assertIn(word, text)
        self.assertIn("tells of levitation", self.refused(*words, "-o", name))
        self.assertIn("36 points, 0 of them new", self.good(*words, "--levitation", "-o", name))
        self.assertIn(",below,below_height_mm,above,above_height_mm,status", self.good("export", name, "--csv", "--units", "lab").splitlines()[0])
        self.assertIn("places where a bead floats, have no mean_r", self.refused("export", name, "--csv", "--quantity", "mean_r"))

    def test_hysteresis_of_the_lock(self):
        """Carried up, the lock of a wave holds to Om0^2/C; carried down, the bead is caught again at (4/pi) Om0."""
        drag, k_radius = 12.0, 2 * math.pi / 60e-3 * 2.5e-3
        words = (WAVE, *WEAK, "--set", f"medium.drag_rate={drag}", "--set", "friction.gamma=3000", "--set", "run.duration=10",
                 "--set", "run.discard=20")
        groups = json.loads(self.good("check", *words, "--set", "drive.frequency=8", "--json"))["groups"]
        torque = groups["kappa"] * 0.05e-3 / groups["field_unit_t"] / groups["time_unit_s"]**2
        om0, damping = math.sqrt(torque / 1.4) * (1 - k_radius), drag / 1.4
        caught, lost = 4 / math.pi * om0 / (2 * math.pi), om0**2 / damping / (2 * math.pi)
        over = [round(f, 1) for f in (0.95 * caught, 1.05 * caught, 1.4 * caught, 0.9 * lost, 0.97 * lost, 1.03 * lost)]
        told = {}
        for way in ("up", "down"):
            name = self.path(way + ".db")
            self.good("sweep", *words, "--over", "drive.frequency=" + ",".join(map(str, over)), "--carry", way, "-o", name)
            told[way] = [row["regime"] for row in self.rows(name)]
        self.assertEqual(told["up"], ["backward"] * 5 + ["drifting"])
        self.assertEqual(told["down"][0], "backward")
        self.assertNotIn("backward", told["down"][1:])

    def test_carried_is_a_sequence_of_runs(self):
        """Each from where the last one ended, also where the command was cut; of a wave, but for whole wave lengths."""
        at = ("position", "velocity", "n", "angular_velocity")
        for scene, sets, key, values in ((WAVE, (*WEAK, "--set", "run.duration=4"), "drive.frequency", (3, 4, 5.5)),
                                         (os.path.join(SCENES, "compass.yaml"), SHORT, "field.uniform[0]", (1e-5, 2e-5, 4e-5)),
                                         (os.path.join(SCENES, "bowl.yaml"), SHORT, "drive.frequency", (30, 31))):
            with self.subTest(scene):
                name, start = self.path(f"{len(values)}{key}.db"), ()
                words = ("sweep", scene, *sets, "--over", f"{key}=" + ",".join(map(str, values)), "--carry", "up", "-o", name)
                self.good(*words)
                whole = self.rows(name)
                self.assertEqual([row["carried"] for row in whole], [0] + [1] * (len(values) - 1))
                with sqlite3.connect(name) as database:
                    database.execute("DELETE FROM rows WHERE point >= 1")
                database.close()
                self.good(*words)
                self.assertEqual(self.rows(name), whole)
                for row, value in zip(whole, values):
                    run = json.loads(self.good("run", scene, *sets, "--set", f"{key}={value}", *start, "--json"))
                    self.assertEqual(run["regime"], row["regime"])
                    for one, other in zip((row["mean_velocity"] or 0, *row["final_state"][3:]), (run["mean_velocity"] or 0, *run["final_state"][3:])):
                        self.assertAlmostEqual(one, other, delta=1e-7)
                    start = [word for k, what in enumerate(at) for i in range(3)
                             for word in ("--set", f"start.{what}[{i}]={run['final_lab_si'][3 * k + i]!r}")]

    def test_refined(self):
        """A map of words that is refined has the words of the whole one."""
        words = ("sweep", WAVE, *WEAK, "--set", "run.duration=2", "--over", "drive.frequency=1Hz:17Hz:9", "--over", "medium.drag_rate=10:30:5")
        self.good(*words, "-o", self.path("all.db"))
        self.good(*words, "--refine", "1", "-o", self.path("some.db"))
        whole = {row["point"]: row for row in self.rows(self.path("all.db"))}
        some = self.rows(self.path("some.db"))
        self.assertLess(len(some), len(whole))
        for row in some:
            self.assertEqual(row, whole[row["point"]])
        self.good("plot", self.path("some.db"), "-o", self.path("some.svg"))

    def test_refused(self):
        scene, name = os.path.join(SCENES, "bowl.yaml"), self.path("r.db")
        self.assertIn("plate.shape none", self.refused("sweep", scene, "--over", "drive.frequency=10Hz:20Hz:5", "--levitation", "-o", name))
        pair = os.path.join(SCENES, os.pardir, "beads", "opposite.yaml")
        for words, said in (((pair, "--over", "drive.frequency=10,20"), "leave this out"),
                            ((scene, "--over", "plate.bowl_radius=1,2"), "where the bead touches it"),
                            ((WAVE, "--over", "wave.length=0.06,0.07"), "phase at every place"),
                            ((WAVE, "--over", "drive.frequency=2,2.03"), "after 40.6 periods, at point 1, the drive"),
                            (("--set", "drive.waveform=chirp", "--set", "drive.chirp=1", "--over", "drive.frequency=2,3"), "choose drive.waveform"),
                            ((os.path.join(SCENES, "coils.yaml"), "--set", "coils[0].frequency=2.1", "--over", "coils[0].ac=1,2"), "current of coils[0]")):
            with self.subTest(said):
                self.assertIn(said, self.refused("sweep", *words, "--carry", "up", "-o", name))
        # 3 Hz, given as drive.omega: after a second the drive and coils of 2 Hz are where they began
        self.good("sweep", os.path.join(SCENES, "coils.yaml"), "--set", f"drive.omega={2 * math.pi * 3 / 312.5!r}", "--over",
                  "coils[0].ac=1,2", "--carry", "up", "-o", self.path("omega.db"))
        self.assertIn("no effect", self.refused("sweep", "--over", "plate.bowl_radius=1,2", "-o", name))
        failed = self.path("f.db")  # a point that cannot be has a row that says why
        self.good("sweep", scene, *SHORT, "--over", "plate.bowl_radius=2 mm,0.5 m", "-o", failed)
        self.assertIn("larger than the bead", self.rows(failed)[0]["reason"])


if __name__ == "__main__":
    unittest.main()
