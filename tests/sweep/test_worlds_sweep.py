"""Sweeps over worlds and over places of levitation: rows are what single calls tell, and what cannot be is refused.

tests: sweep/bead_columns.c"""
import json
import os
import unittest

from sweep_tools import Case

SCENES = os.path.join(os.environ["SOURCE_DIR"], "examples", "worlds")
SHORT = ("--set", "run.periods=4", "--set", "run.discard=2")
# scene, what is set, what is varied; a tilted plate is no file
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
                                   final_state=[*state[:2], None, *state[2:4], None, *state[4:]])
                    columns = set(row) - {"point", key, "status"}
                    self.assertLess(20, len(columns))
                    for column in columns:
                        self.assertEqual(row[column], run[column], column)

    def test_a_sweep_goes_on(self):
        name, other, over = self.path("s.db"), self.path("t.db"), "drive.frequency=10Hz:20Hz:4"
        words = ("sweep", os.path.join(SCENES, "bowl.yaml"), *SHORT, "--over", over)
        self.good(*words, "-o", name)
        before = self.rows(name)
        self.assertIn("4 points, 0 of them new", self.good(*words, "-o", name))
        self.good(*words, "--threads", "2", "-o", other)
        self.assertEqual(self.rows(other), before)
        self.assertIn("plate.bowl_radius", self.refused(*words, "--set", "plate.bowl_radius=1 m", "-o", name))
        lines = self.good("export", name, "--csv", "--key", "regime,frame,mean_r", "--units", "lab").splitlines()
        self.assertEqual(lines[0], "drive.frequency [Hz],regime,frame,mean_r [mm],status")
        self.assertEqual(lines[1].split(",")[2::2], ["turning", "done"])
        self.assertIn("of a bead in a world, have no std_r", self.refused("export", name, "--csv", "--key", "std_r"))
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
        for words_of_key in ((), ("--key", "above"), ("--key", "below_height_mm")):
            figure = self.path("f.svg")
            self.good("plot", name, *words_of_key, "-o", figure)
            with open(figure, encoding="utf-8") as file:
                text = file.read()
            for word in ("stable", "none") if not words_of_key else ("stable", "oscillates") if "above" in words_of_key else ("height below",):
                self.assertIn(word, text)
        self.assertIn("tells of levitation", self.refused(*words, "-o", name))
        self.assertIn("36 points, 0 of them new", self.good(*words, "--levitation", "-o", name))
        self.assertIn("places where a bead floats, have no mean_r", self.refused("export", name, "--csv", "--key", "mean_r"))

    def test_refused(self):
        scene, name = os.path.join(SCENES, "bowl.yaml"), self.path("r.db")
        for words, said in ((("--carry", "up"), "leave this out"), (("--refine", "1"), "leave this out"),
                            (("--levitation",), "plate.shape none")):
            self.assertIn(said, self.refused("sweep", scene, "--over", "drive.frequency=10Hz:20Hz:5", *words, "-o", name))
        self.assertIn("no effect", self.refused("sweep", "--over", "plate.bowl_radius=1,2", "-o", name))
        failed = self.path("f.db")  # a point that cannot be has a row that says why
        self.good("sweep", scene, *SHORT, "--over", "plate.bowl_radius=2 mm,0.5 m", "-o", failed)
        self.assertIn("larger than the bead", self.rows(failed)[0]["reason"])


if __name__ == "__main__":
    unittest.main()
