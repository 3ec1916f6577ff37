"""Sweeps over scenes that list beads: rows are what single runs tell, a sweep goes on, and what cannot be is refused.

tests: sweep/bead_columns.c"""
import json
import unittest

from sweep_tools import Case

SCENE = """drive: {frequency: 30 Hz}
contact: {pair_rate: 312.5}
run: {periods: 6, discard: 4}
beads:
  - start.phi: 3 deg
  - start.phi: 183 deg
"""
OVER = "beads[1].start.phi=53,120,183"


class Sweeps(Case):
    def setUp(self):
        super().setUp()
        self.scene = self.path("scene.yaml")
        with open(self.scene, "w") as file:
            file.write(SCENE)

    def rows(self, name):
        return json.loads(self.good("export", name, "--json"))

    def test_rows_are_single_runs(self):
        name = self.path("s.db")
        self.good("sweep", self.scene, "--over", OVER, "--over", "run.rtol=1e-9,1e-8", "-o", name)
        rows = self.rows(name)
        self.assertEqual([row["beads[1].start.phi"] for row in rows], [53, 53, 120, 120, 183, 183])
        for row in rows:
            run = json.loads(self.good("run", self.scene, "--json", "--set",
                                       f"beads[1].start.phi={row['beads[1].start.phi']}", "--set",
                                       f"run.rtol={row['run.rtol']}"))
            largest = max(run["groups"], key=lambda group: len(group["members"]))
            self.assertEqual((row["outcome"], row["reason"], row["groups"], row["largest_kind"], row["largest_beads"]),
                             (run["outcome"], run["reason"], len(run["groups"]), largest["kind"], len(largest["members"])))
            for key in ("mean_r", "centre_rate", "axis_rate"):
                self.assertEqual(row[key], largest[key])
            for key in ("drive", "plate", "pair"):
                self.assertEqual(row[f"{key}_power"], run["powers"][key])
            self.assertEqual(row["impact_power"], run["powers"]["impacts"])
            for key, count in run["counts"].items():
                self.assertEqual(row[key], count)
            for key in ("energy_residual", "rhs_calls", "periods", "method"):
                self.assertEqual(row[key], run[key])
        self.assertEqual(rows[0]["largest_kind"], "pair")
        self.assertEqual(rows[4]["outcome"], "apart")

    def test_a_sweep_goes_on_and_knows_its_beads(self):
        name, other = self.path("s.db"), self.path("t.db")
        words = ("sweep", self.scene, "--over", OVER, "-o", name)
        self.good(*words)
        before = self.rows(name)
        self.assertIn("3 points", self.good(*words))
        self.assertEqual(self.rows(name), before)
        for change, said in (("beads[0].start.phi=4", "beads[0].start.phi = 3"), ("model.chi=1e-3", "model.chi"),
                             ("beads[2].start.r=0", "beads[2].start.r = (not given)")):
            self.assertIn(said, self.refused("sweep", self.scene, "--set", change, "--over", OVER, "-o", name))
        self.good("sweep", self.scene, "--over", OVER, "--threads", "2", "-o", other)
        self.assertEqual(self.rows(other), before)

    def test_chosen_columns(self):
        name = self.path("s.db")
        self.good("sweep", self.scene, "--over", "beads[1].start.phi=120,183", "-o", name)
        lines = self.good("export", name, "--csv", "--quantity", "outcome,largest_kind,mean_r,centre_rate,impact_power", "--units",
                          "lab").splitlines()
        self.assertEqual(lines[0], "beads[1].start.phi [deg],outcome,largest_kind,mean_r [mm],centre_rate [Hz],"
                         "impact_power [mW],status")
        cells = lines[2].split(",")
        self.assertEqual(cells[:3] + cells[-1:], ["183", "apart", "single", "done"])
        self.assertAlmostEqual(float(cells[3]), 21.3, 1)
        self.assertEqual(self.good("export", name, "--csv", "--units", "lab").splitlines()[0],
                         "beads[1].start.phi [deg],outcome,groups,mean_r [mm],centre_rate [Hz],status")
        self.assertIn("have no regime", self.refused("export", name, "--csv", "--quantity", "regime"))
        self.assertIn("have no mean_b; the nearest is mean_r", self.refused("export", name, "--csv", "--quantity", "mean_b"))
        self.good("export", name, "--hdf5", "-o", self.path("s.h5"))
        single = self.path("one.db")
        self.good("sweep", "--set", "run.periods=2", "--set", "run.discard=1", "--over", "start.r=0.8,0.9", "-o", single)
        self.assertIn("of one bead, have no outcome; no name is like it", self.refused("export", single, "--csv", "--quantity", "outcome"))

    def test_refused(self):
        for words, said in ((("--carry", "up"), "leave this out"), (("--refine", "2"), "leave this out")):
            self.assertIn(said, self.refused("sweep", self.scene, "--over", "drive.frequency=20Hz:30Hz:9", *words, "-o",
                                             self.path("r.db")))
        self.assertIn("the scene lists 2 beads", self.refused("sweep", self.scene, "--over", "beads[2].start.r=0,0.1", "-o",
                                                              self.path("r.db")))
        rows = self.path("overlap.db")
        self.good("sweep", self.scene, "--over", "beads[1].start.phi=4,183", "-o", rows)
        self.assertIn("overlap", self.rows(rows)[0]["reason"])
        self.assertEqual([row["outcome"] for row in self.rows(rows)], [None, "apart"])


if __name__ == "__main__":
    unittest.main()
