"""Sweeps as a user meets them: rows, refusals, carrying, exports, figures.

tests: sweep/sweep.c sweep/workers.c sweep/chains.c sweep/columns.c sweep/export.c sweep/outcomes.c
  cli/sweep.c"""

import csv
import io
import json
import math
import os
import pty
import re
import sqlite3
import subprocess
import unittest

from hdf5_reader import Hdf5
from sweep_tools import FESTOON, SHORT, SMALL, Case, change, content_of, festoon


class Rows(Case):
    def test_keys_values_and_order(self):
        self.good("sweep", *SMALL, "-o", self.path("a.db"))
        rows = json.loads(self.good("export", self.path("a.db"), "--json"))
        self.assertEqual([row["point"] for row in rows], list(range(18)))
        self.assertEqual([row["model.kappa"] for row in rows[:4]], [1, 1.5, 2, 1])
        self.assertEqual(rows[0]["drive.frequency"], 9)
        self.assertEqual(rows[-1]["drive.frequency"], 20)
        run = json.loads(self.good("run", *SHORT, "--set", "drive.frequency=9", "--json"))
        self.assertLess(set(run) - {"scene", "groups", "version"}, set(rows[1]))
        self.assertAlmostEqual(run["mean_r"], rows[1]["mean_r"], 5)
        self.assertEqual(run["regime"], rows[1]["regime"])

    def test_portable_rows_have_the_bits_of_a_run(self):
        self.good("sweep", *SMALL, "--portable", "-o", self.path("a.db"))
        row = json.loads(self.good("export", self.path("a.db"), "--json"))[1]
        run = json.loads(self.good("run", *SHORT, "--set", "drive.frequency=9", "--json"))
        for key in set(run) - {"scene", "groups", "version"}:
            self.assertEqual(run[key], row[key], key)

    def test_many_exponents_wanted_in_one_step(self):
        """More runs than there are lanes end in the same step and wait for their exponents."""
        words = ["sweep", *SHORT, "--over", "drive.frequency=9Hz:20Hz:300", "--portable"]
        self.good(*words, "-o", self.path("many.db"))
        self.good(*words, "--lanes", "1", "-o", self.path("one.db"))
        self.assertEqual(self.rows("many.db"), self.rows("one.db"))

    def test_nothing_depends_on_threads_or_lanes(self):
        found = set()
        for i, words in enumerate((["--threads", "1"], ["--threads", "2"], ["--threads", "5"])):
            self.good("sweep", *SMALL, *words, "-o", self.path(f"{i}.db"))
            found.add(self.rows(f"{i}.db"))
        self.assertEqual(len(found), 1)
        found = set()
        for lanes in ("1", "4", "8"):
            status, _, err = festoon("sweep", *SMALL, "--portable", "--lanes", lanes, "-o", self.path(f"p{lanes}.db"))
            if status == 1 and "processor" in err:
                continue
            self.assertEqual(status, 0, err)
            found.add(self.rows(f"p{lanes}.db"))
        self.assertEqual(len(found), 1)

    def test_failures_are_rows(self):
        self.good("sweep", *SHORT, "--over", "start.r=0.05,0.95,2.9", "--set", "plate.radius=0.07", "-o", self.path("a.db"))
        self.good("sweep", *SHORT, "--over", "start.r=0.10869565217391304,0.9", "--set",
                  "model.eps=0.10869565217391304", "-o", self.path("b.db"))
        rows = json.loads(self.good("export", self.path("b.db"), "--json"))
        self.assertEqual(rows[0]["status"], "bad input")
        self.assertIsNone(rows[0]["regime"])
        self.assertIn("rolling", rows[0]["reason"])
        self.assertEqual(rows[1]["status"], "done")

    def test_a_sweep_of_failures_alone_has_failed(self):
        """Its status is 1, now and when it is asked again; all rows and the summary are there.  One run that is made makes it 0."""
        fails = ("sweep", *SHORT, "--set", "start.r=20", "-o", self.path("none.db"), "--over")
        for more in ((), (), ("--json",)):
            status, out, err = festoon(*fails, "drive.frequency=5Hz,6Hz,7Hz", *more)
            self.assertEqual(status, 1, err)
            self.assertRegex(err, r"none\.db: no run of this sweep could be made; the first: bad input: .*plate")
            self.assertIn('"rows": 3' if more else "all 3 points", out)
            rows = json.loads(self.good("export", self.path("none.db"), "--json"))
            self.assertEqual([row["status"] for row in rows], ["bad input"] * 3)
        some = self.good("sweep", *SHORT, "--over", "start.r=20,0.9", "-o", self.path("some.db"))
        self.assertIn("1 run failed, its row says why", some)

    def test_carry_goes_on_from_the_neighbour(self):
        for direction, order in (("up", [0, 1, 2, 3]), ("down", [3, 2, 1, 0])):
            name = direction + ".db"
            self.good("sweep", *SHORT, "--over", "drive.omega=0.3:0.36:4", "--over", "model.dynamics=rigid,farago2020",
                      "--carry", direction, "--portable", "-o", self.path(name))
            rows = json.loads(self.good("export", self.path(name), "--json"))
            self.assertEqual([rows[2 * i]["carried"] for i in order], [0, 1, 1, 1])
            run = json.loads(self.good("run", *SHORT, "--set", f"drive.omega={rows[2 * order[0]]['drive.omega']!r}", "--json"))
            self.assertEqual(run["final_state"], rows[2 * order[0]]["final_state"])
        up, down = self.rows("up.db"), self.rows("down.db")
        self.assertNotEqual(up, down)
        # A chain that was interrupted goes on with the same bits.
        base = sqlite3.connect(self.path("up.db"))
        base.execute("DELETE FROM rows WHERE point >= 3")
        base.commit()
        base.close()
        self.good("sweep", *SHORT, "--over", "drive.omega=0.3:0.36:4", "--over", "model.dynamics=rigid,farago2020",
                  "--carry", "up", "--portable", "-o", self.path("up.db"))
        self.assertEqual(self.rows("up.db"), up)

    def test_what_has_settled_is_carried(self):
        """Runs that end early because they have settled are gone on from, also after an interruption."""
        words = ["sweep", "--over", "drive.frequency=7.29,8,9,10", "--set", "model.kappa=1.035", "--set",
                 "run.until=settled", "--carry", "up"]
        for form in ("--portable", "--json"):
            self.good(*words, form, "-o", self.path("a.db"))
            whole = self.rows("a.db")
            rows = json.loads(self.good("export", self.path("a.db"), "--json"))
            self.assertEqual([row["carried"] for row in rows], [0, 1, 1, 1])
            self.assertTrue(all(row["settled_at"] < row["periods"] < 400 for row in rows))
            base = sqlite3.connect(self.path("a.db"))
            base.execute("DELETE FROM rows WHERE point >= 2")
            base.commit()
            base.close()
            self.good(*words, form, "-o", self.path("a.db"))
            self.assertEqual(self.rows("a.db"), whole)
            os.remove(self.path("a.db"))

    def test_nothing_is_carried_from_a_bead_that_left_the_plate(self):
        """After an ejection or a lift-off a chain begins anew at the scene's own start, also if it is resumed after
        an interruption."""
        brief = ["--set", "run.periods=15", "--set", "run.discard=3", "--set", "run.rtol=1e-8"]
        for regime, carried, axis, *scene in (
                ("ejected", [0, 0, 1], "plate.radius=45mm,80mm,90mm", "start.r=1.9", "drive.omega=2"),
                ("lifted", [0, 0, 1], "bead.a=-1e-3,1e-3,2e-3", "bead.material=paramagnetic")):
            settings = [word for value in scene for word in ("--set", value)]
            words = ["sweep", *brief, *settings, "--over", axis, "--carry", "up", "--portable", "-o", self.path(regime)]
            self.good(*words)
            whole = self.rows(regime)
            rows = json.loads(self.good("export", self.path(regime), "--json"))
            self.assertEqual([row["carried"] for row in rows], carried)
            self.assertEqual(rows[0]["regime"], regime)
            self.assertNotIn(rows[1]["regime"], ("ejected", "lifted"))
            key = axis.split("=")[0]
            alone = json.loads(self.good("run", *brief, *settings, "--set", f"{key}={rows[1][key]!r}", "--json"))
            self.assertEqual(alone["final_state"], rows[1]["final_state"])
            base = sqlite3.connect(self.path(regime))
            base.execute("DELETE FROM rows WHERE point >= 1")
            base.commit()
            base.close()
            self.good(*words)
            self.assertEqual(self.rows(regime), whole)


class Bands(Case):
    def test_librating_bands_lie_between_bifurcations_of_locked_states(self):
        """The bands of rows, which come from integration, end at the bifurcations, which come from eigenvalues
        (docs/regimes.md)."""
        branch = json.loads(self.good("branch", "--kind", "locked", "--over", "drive.frequency=4Hz:8Hz", "--json"))
        stable = {}
        for point in branch["points"]:
            if point["stable"]:
                stable.setdefault(point["branch"], []).append(point["value"])
        def is_locked(frequency):
            return any(min(values) <= frequency <= max(values) for values in stable.values())
        self.good("sweep", "--over", "drive.frequency=4.2,4.5,4.8,5.5,6.2,6.6,7,7.4,7.8", "-o", self.path("a.db"))
        rows = json.loads(self.good("export", self.path("a.db"), "--json"))
        for row in rows:
            self.assertEqual(row["regime"], "locked" if is_locked(row["drive.frequency"]) else "librating")
        self.assertEqual(len({row["regime"] for row in rows}), 2)


class Refusals(Case):
    def test_other_parameters(self):
        self.good("sweep", *SMALL, "-o", self.path("a.db"))
        to = ["-o", self.path("a.db")]
        self.assertIn("run.rtol", self.refused("sweep", *SMALL, "--set", "run.rtol=1e-7", *to))
        self.assertIn("axis_1", self.refused("sweep", *SHORT, "--over", "drive.frequency=9Hz:20Hz:7", "--over",
                                             "model.kappa=1,1.5,2", *to))
        self.assertIn("carry", self.refused("sweep", *SMALL, "--carry", "up", *to))

    def test_foreign_files(self):
        for name, content in (("text.db", b"precious text, not a database"), ("short.db", b"x")):
            with open(self.path(name), "wb") as out:
                out.write(content)
            self.refused("sweep", *SMALL, "-o", self.path(name))
            self.refused("export", self.path(name), "--csv")
        base = sqlite3.connect(self.path("other.db"))
        base.execute("CREATE TABLE t(a)")
        base.commit()
        base.close()
        self.refused("sweep", *SMALL, "-o", self.path("other.db"))
        os.mkdir(self.path("dir.db"))
        self.refused("sweep", *SMALL, "-o", self.path("dir.db"))
        self.refused("sweep", *SMALL, "-o", self.path("none/a.db"), status=1)
        self.refused("export", self.path("missing.db"), "--csv")

    def test_full_disk(self):
        mount = self.path("small")
        os.mkdir(mount)
        if os.getuid() != 0 or subprocess.run(["mount", "-t", "tmpfs", "-o", "size=512k", "none", mount],
                                              stderr=subprocess.DEVNULL).returncode != 0:
            self.skipTest("a small file system needs root")
        try:
            words = ["sweep", *SHORT, "--over", "drive.frequency=9Hz:20Hz:1500", "-o", os.path.join(mount, "a.db")]
            status, out, err = festoon(*words)
            self.assertEqual((status, out), (1, ""), err)
            self.assertIn("disk is full", err)
            subprocess.run(["mount", "-o", "remount,size=64m", mount], check=True)
            base = sqlite3.connect(os.path.join(mount, "a.db"))
            kept = base.execute("SELECT count(*) FROM rows").fetchone()[0]
            base.close()
            self.assertGreater(kept, 0)
            out = self.good(*words, "--json")
            self.assertEqual(json.loads(out)["added"], 1500 - kept)
        finally:
            subprocess.run(["umount", mount], check=True)


class Progress(Case):
    def test_a_sweep_that_goes_on_shows_what_is_there_and_its_own_speed(self):
        words = ["sweep", *SHORT, "--over", "drive.frequency=9Hz:20Hz:1000", "--threads", "1", "-o", self.path("a.db")]
        self.good(*words)
        base = sqlite3.connect(self.path("a.db"))
        base.execute("DELETE FROM rows WHERE point >= 250")
        base.commit()
        base.close()
        master, slave = pty.openpty()
        process = subprocess.Popen([FESTOON, *words], stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=slave)
        os.close(slave)
        shown = b""
        try:
            while piece := os.read(master, 4096):
                shown += piece
        except OSError:  # the other side is closed
            pass
        os.close(master)
        self.assertEqual(process.communicate()[0].count(b"750 of them new"), 1)
        lines = re.findall(rb"([0-9.]+) %(?:  ([0-9]+) s left)?  ([0-9]+) of 1000 points, ([0-9.e+]+) a second", shown)
        if not lines:
            self.skipTest("this machine was faster than the line")
        for percent, left, there, rate in lines:
            self.assertGreaterEqual(int(there), 250)
            self.assertAlmostEqual(float(percent), int(there) / 10, delta=0.06)
            if left and float(rate) > 0:
                self.assertAlmostEqual(int(left), (1000 - int(there)) / float(rate), delta=1 + 0.01 * int(left))


class Exports(Case):
    def test_csv_and_json_agree(self):
        self.good("sweep", *SMALL, "-o", self.path("a.db"))
        text = self.rows("a.db")
        rows = json.loads(self.good("export", self.path("a.db"), "--json"))
        for fields, row in zip(csv.DictReader(io.StringIO(text)), rows):
            self.assertEqual(float(fields["mean_r"]), row["mean_r"])
            self.assertEqual(float(fields["final_WZ"]), row["final_state"][9])
            self.assertEqual(fields["regime"], row["regime"])
            self.assertEqual(fields["festoons"] == "", row["festoons"] is None)
        self.good("export", self.path("a.db"), "--csv", "-o", self.path("a.csv"))
        self.assertEqual(content_of(self.path("a.csv"), "r"), text)
        status, _, err = festoon("export", self.path("a.db"), "--hdf5", "-o", self.path("a.h5"))
        self.assertTrue(status == 0 or "HDF5" in err, err)
        self.refused("export", self.path("a.db"), "--hdf5")
        self.refused("export", self.path("a.db"), "--csv", "--json")

    def test_hdf5_holds_what_csv_says(self):
        """Reads the export by HDF5's own library through ctypes."""
        self.good("sweep", *SHORT, "--over", "drive.frequency=9Hz:20Hz:6", "--over", "model.dynamics=rigid,farago2020",
                  "-o", self.path("a.db"))
        change(self.path("a.db"), "DELETE FROM rows WHERE point = 7",  # an incomplete sweep, with a run that failed
               "UPDATE rows SET status = 'bad input', regime = NULL, mean_r = NULL, reason = 'it broke' WHERE point = 3",
               "UPDATE rows SET reason = NULL WHERE point = 4")
        status, _, err = festoon("export", self.path("a.db"), "--hdf5", "-o", self.path("a.h5"))
        if status == 1 and "HDF5" in err:
            self.skipTest("built without HDF5")
        self.assertEqual(status, 0, err)
        rows = list(csv.DictReader(io.StringIO(self.rows("a.db"))))
        self.assertEqual(len(rows), 11)
        file = Hdf5(self.path("a.h5"))
        self.addCleanup(file.close)
        names = set(file.names())
        self.assertEqual(set(rows[0]), names)
        names.remove("reason")
        self.assertEqual(file.texts("reason"), [row["reason"] for row in rows])
        self.assertEqual([row["reason"] for row in rows][3:5], ["it broke", ""])
        for name in names:
            codes = file.attribute(name, "description").split("|")
            column = file.column(name)
            self.assertEqual(len(column), len(rows), name)
            for row, value in zip(rows, column):
                text = row[name]
                if text == "":
                    self.assertTrue(math.isnan(value), name)
                elif name in ("status", "regime", "symmetry", "dynamics", "model.dynamics"):
                    self.assertEqual(codes[int(value)], text)
                else:
                    self.assertEqual(value, float(text), name)
        self.assertEqual(file.attribute("mean_r", "unit"), "l")
        self.assertEqual(file.attribute("drive.frequency", "unit"), "Hz")

    def test_what_became_of_the_points(self):
        """The table tells the rows' own outcomes and work, whatever computed them; of runs that failed, how many there are."""
        words = ["sweep", "--set", "run.periods=30", "--set", "run.discard=10", "--set", "friction.law=coulomb", "--set",
                 "model.eps=0.10869565217391304", "--over", "start.r=0.10869565217391304,0.9", "--over", "drive.frequency=2Hz:20Hz:10", "-o"]
        told = json.loads(self.good(*words, self.path("a.db"), "--json", "--threads", "1"))["outcomes"]
        self.assertEqual(json.loads(self.good(*words, self.path("b.db"), "--json", "--threads", "3"))["outcomes"], told)
        wanted = {}
        for row in json.loads(self.good("export", self.path("a.db"), "--json")):
            wanted.setdefault(row["regime"] or "failed", []).append(row)
        self.assertEqual({one["outcome"]: one["points"] for one in told}, {name: len(rows) for name, rows in wanted.items()})
        self.assertLess({"failed", "ejected"}, set(wanted))
        self.assertEqual(told[-1], {"outcome": "failed", "points": 10})
        everything = sum(one["rhs_calls"] for one in told[:-1])
        for one in told[:-1]:
            rows = wanted[one["outcome"]]
            self.assertEqual(one["rhs_calls"], sum(row["rhs_calls"] for row in rows))
            self.assertAlmostEqual(one["share"], one["rhs_calls"] / everything, 5)
            self.assertAlmostEqual(one["mean_periods"], sum(row["periods"] for row in rows) / len(rows), 4)
        self.assertEqual(json.loads(self.good(*words, self.path("a.db"), "--json"))["outcomes"], [])  # no row was added
        said = self.good(*words, self.path("c.db"))
        self.assertRegex(said, rf"ejected +{len(wanted['ejected'])} +\d+\.\d\d % +\d+\.\d+\n")
        self.assertRegex(said, r"failed +10\n$")

    def test_outcomes_of_several_beads(self):
        scene = self.path("two.yaml")
        with open(scene, "w", encoding="utf-8") as text:
            text.write("drive: {frequency: 30 Hz}\nrun: {periods: 6, discard: 1}\nbeads: [{start.phi: 3 deg}, {start.phi: 40 deg}]\n")
        out = self.good("sweep", scene, "--over", "impact.restitution=0,0.5", "-o", self.path("a.db"), "--json")
        rows = json.loads(self.good("export", self.path("a.db"), "--json"))
        self.assertEqual({one["outcome"]: one["points"] for one in json.loads(out)["outcomes"]},
                         {name: sum(row["outcome"] == name for row in rows) for name in {row["outcome"] for row in rows}})
        self.assertEqual(sum(one["rhs_calls"] for one in json.loads(out)["outcomes"]), sum(row["rhs_calls"] for row in rows))

    def test_figures(self):
        self.good("sweep", *SHORT, "--over", "drive.frequency=9Hz:20Hz:12", "-o", self.path("line.db"))
        self.good("sweep", *SMALL, "-o", self.path("map.db"))
        for name, words in (("line.db", []), ("line.db", ["--quantity", "festoons,max_b"]), ("map.db", []),
                            ("map.db", ["--quantity", "mean_r"])):
            status, _, err = festoon("plot", self.path(name), *words, "-o", self.path("figure.svg"))
            if status == 1 and "gnuplot" in err:
                self.skipTest("no gnuplot")
            self.assertEqual(status, 0, err)
            self.assertIn("<svg", content_of(self.path("figure.svg"), "r")[:2000])
        self.assertIn("mean_r", self.refused("plot", self.path("map.db"), "--quantity", "mean_rr", "-o", self.path("f.svg")))
        self.refused("plot", self.path("map.db"), "--quantity", "slip", "-o", self.path("f.svg"))


if __name__ == "__main__":
    unittest.main()
