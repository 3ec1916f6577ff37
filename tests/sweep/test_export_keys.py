"""export --csv --quantity ... --units ...: chosen columns of a sweep, converted into the units that stand in their names.

tests: sweep/export_keys.c cli/export.c"""

import csv
import fcntl
import io
import itertools
import json
import math
import os
import re
import sqlite3
import struct
import unittest

from sweep_tools import Case, SHORT, change, content_of, festoon

KEYS = ["regime", "symmetry", "mean_r", "mean_alpha_dot", "rms_slip", "mean_b", "festoons", "rhs_calls"]


class ExportKeys(Case):
    def sweep(self, *axes, settings=()):
        path = self.path("a.db")
        words = [word for axis in axes for word in ("--over", axis)]
        self.good("sweep", *SHORT, *words, *settings, "-o", path)
        return path, json.loads(self.good("export", path, "--json"))

    def table(self, *words):
        rows = list(csv.reader(io.StringIO(self.good("export", *words))))
        return rows[0], rows[1:]

    def compare(self, rows, known, factors):
        self.assertEqual(len(rows), len(known))
        for row, point in zip(rows, known):
            for key, text in zip(KEYS, row[-len(KEYS) - 1:-1]):
                value = point[key]
                if value is None:
                    self.assertEqual(text, "")
                elif isinstance(value, str):
                    self.assertEqual(text, value)
                else:
                    expected = value * factors.get(key, lambda at: 1.0)(point)
                    self.assertLess(abs(float(text) - expected), 1e-14 * abs(expected) + 1e-300, (key, text))

    def test_units_of_the_laboratory(self):
        """By the definitions of the scaled units, at each point: friction.gamma is varied."""
        path, known = self.sweep("friction.gamma=250,312.5", "magnet.depth=9mm,16.2mm", "drive.frequency=9Hz,19Hz")
        head, rows = self.table(path, "--csv", "--quantity", ",".join(KEYS), "--units", "lab")
        self.assertEqual(head, ["friction.gamma [1/s]", "magnet.depth [mm]", "drive.frequency [Hz]", "regime", "symmetry",
                                "mean_r [mm]", "mean_alpha_dot [Hz]", "rms_slip [mm/s]", "mean_b [B0]", "festoons", "rhs_calls", "status"])
        self.assertEqual([row[:3] for row in rows[:3]], [["250", "9", "9"], ["250", "9", "19"], ["250", "16.2", "9"]])
        gamma = lambda point: point["friction.gamma"]
        self.compare(rows, known, {"mean_r": lambda point: 23.0, "mean_alpha_dot": lambda at: gamma(at) / (2 * math.pi), "rms_slip": lambda at: 23.0 * gamma(at)})

    def test_scaled_and_si(self):
        path, known = self.sweep("magnet.half_length=20mm,23mm", "model.dynamics=rigid,farago2020")
        head, rows = self.table(path, "--csv", "--quantity", ",".join(KEYS), "--units", "scaled")
        self.assertEqual(head[:2] + head[4:6], ["magnet.half_length [m]", "model.dynamics", "mean_r [l]", "mean_alpha_dot [gamma]"])
        self.assertEqual(rows[1][:2], ["0.02", "farago2020"])
        self.compare(rows, known, {})
        self.assertEqual(self.table(path, "--csv", "--quantity", ",".join(KEYS)), (head, rows))
        head, rows = self.table(path, "--csv", "--quantity", ",".join(KEYS), "--units", "si")
        self.assertEqual((head[4], head[5]), ("mean_r [m]", "mean_alpha_dot [rad/s]"))
        length = lambda point: point["magnet.half_length"]
        self.compare(rows, known, {"mean_r": length, "mean_alpha_dot": lambda at: 312.5, "rms_slip": lambda at: 312.5 * length(at)})

    def test_the_usual_keys_into_a_file(self):
        path, _ = self.sweep("drive.frequency=9Hz:12Hz:4")
        self.good("export", path, "--csv", "--units", "lab", "-o", self.path("t.csv"))
        with open(self.path("t.csv"), encoding="utf-8") as file:
            self.assertEqual(file.readline(), "drive.frequency [Hz],regime,mean_r [mm],std_r [mm],mean_alpha_dot [Hz],status\n")
            self.assertEqual(len(file.readlines()), 4)

    def test_points_without_a_row(self):
        """Each point has a line, also where the sweep has not come to it: first, between others, and last."""
        path, known = self.sweep("drive.frequency=9Hz:16Hz:8")
        change(path, "DELETE FROM rows WHERE point IN (0, 3, 4, 6, 7)")
        status, out, err = festoon("export", path, "--csv", "--quantity", "mean_r")
        head, *rows = csv.reader(io.StringIO(out))
        self.assertEqual((status, head), (0, ["drive.frequency [Hz]", "mean_r [l]", "status"]))
        self.assertIn(f"3 of 8 points have a row; the command of the sweep computes the others with -o {path}\n", err)
        with open(path, "r+b") as file:  # the lock of a sweep at work, sweep/lock.c
            fcntl.fcntl(file, fcntl.F_OFD_SETLK, struct.pack("hhqqi4x", fcntl.F_WRLCK, os.SEEK_SET, 1 << 48, 1, 0))
            self.assertIn("3 of 8 points have a row so far: a sweep is at work on it\n",
                          festoon("export", path, "--csv", "--quantity", "mean_r")[2])
        self.assertEqual([row[0] for row in rows], [str(at) for at in range(9, 17)])
        self.assertEqual([row[2] for row in rows], ["missing" if point in (0, 3, 4, 6, 7) else "done" for point in range(8)])
        self.assertEqual([row[1] != "" for row in rows], [point not in (0, 3, 4, 6, 7) for point in range(8)])
        self.assertEqual([float(rows[i][1]) for i in (1, 2, 5)], [known[i]["mean_r"] for i in (1, 2, 5)])
        self.good("plot", path, "-o", self.path("f.svg"))
        title = " ".join(re.findall("set label '(.*?)' at ", content_of(self.path("f.gp"), "r")))
        self.assertIn("3 of 8 runs of 8 turns of the magnet (not complete)", title)

    def test_failed_runs(self):
        """Their status is why they failed, and the run is known to be there."""
        path, known = self.sweep("start.r=0.95,2.5e-1", settings=("--set", "bead.radius=5.75mm"))
        _, rows = self.table(path, "--csv", "--quantity", "mean_r")
        self.assertEqual([(row[2], row[1] == "") for row in rows], [("done", False), (f"bad input: {known[1]['reason']}", True)])
        self.assertGreater(len(known[1]["reason"]), 20)
        change(path, ("UPDATE rows SET reason = ? WHERE point = 1", ('a "wall",\x1b[1m\n',)))
        text = self.good("export", path, "--csv", "--quantity", "mean_r")
        self.assertIn(',,"bad input: a ""wall"",', text)
        self.assertNotIn("\x1b", text)
        self.assertEqual(text.count("\n"), 3)

    def test_every_result_read_back(self):
        """A number in the unit of the laboratory that stands in its head, read back, is the number."""
        with open(os.path.join(os.environ["SOURCE_DIR"], "include", "festoon", "run.def"), encoding="utf-8") as file:
            units = dict(re.findall(r'^FST_RESULT\((\w+), "([^"]*)"', file.read(), re.M))
        settings = ["bead.moment=0.06", "magnet.b0=2.5mT", "friction.law=coulomb", "friction.mu=0.2", "friction.gamma=250",
                    "impact.restitution=0.3", "magnet.half_length=20mm"]
        path, (known,) = self.sweep("bead.mass=0.4g", settings=[word for text in settings for word in ("--set", text)])
        length, rate, mass, field = 20e-3, 250.0, 0.4e-3, 2.5e-3  # what the scaled units are in SI
        scaled = {"l": length, "gamma": rate, "1/gamma": 1 / rate, "l gamma": length * rate, "B0": field,
                  "l gamma^2": mass * length * rate ** 2, "l^2 gamma^2": mass * length ** 2 * rate ** 2,
                  "l^2 gamma^3": mass * length ** 2 * rate ** 3}
        shown = {"mm": 1e-3, "s": 1, "1/s": 1, "mm/s": 1e-3, "mT": 1e-3, "mN": 1e-3, "uJ": 1e-6, "mW": 1e-3, "rad/s": 1,
                 "Hz": 2 * math.pi, "m": 1, "m/s": 1, "T": 1, "N": 1, "J": 1, "W": 1}
        turns, told = {"mean_alpha_dot", "mean_alpha_dot_error", "mean_phi_dot"}, 0
        for choice, keys in itertools.product(("lab", "si"), (list(units)[i::4] for i in range(4))):
            head, rows = self.table(path, "--csv", "--quantity", ",".join(keys), "--units", choice)
            for name, text in zip(head[1:-1], rows[0][1:-1]):
                key, _, unit = name.rstrip("]").partition(" [")
                factor = scaled.get(units[key])
                if factor is None:  # a number, or one whose name says its unit
                    self.assertEqual(unit or "1", units[key])
                    self.assertEqual(float(text) if text else None, known[key])
                    continue
                if key in turns:
                    self.assertEqual(unit, "Hz" if choice == "lab" else "rad/s")
                self.assertIn(unit, shown, name)
                self.assertEqual(text == "", known[key] is None)
                if text:
                    self.assertTrue(math.isclose(float(text) * shown[unit], factor * known[key], rel_tol=1e-12), name)
                    told += 1
        self.assertGreater(told, 50)

    def test_damaged_rows(self):
        """A row whose checksum is wrong is not left out in silence."""
        path, _ = self.sweep("drive.frequency=9Hz:12Hz:4")
        base = sqlite3.connect(path)
        base.execute("UPDATE rows SET mean_r = mean_r + 1 WHERE point = 2")
        base.commit()
        base.close()
        self.assertIn("point 2", self.refused("export", path, "--csv", "--quantity", "mean_r", "-o", self.path("t.csv")))
        self.assertFalse(os.path.exists(self.path("t.csv")))

    def test_bad_words(self):
        path, _ = self.sweep("drive.frequency=9Hz,10Hz")
        out = self.path("t.csv")
        self.assertIn("nearest is mean_r", self.refused("export", path, "--csv", "--quantity", "mean_rr", "-o", out))
        self.assertIn("a name is missing", self.refused("export", path, "--csv", "--quantity", "mean_r,,std_r", "-o", out))
        for word, said in (("csvv", "options begin with dashes: the nearest is --csv "), ("--CSV", "the nearest is --csv ")):
            self.assertIn(said, self.refused("export", path, word))
        self.assertRegex(self.refused("export", path, "xyzzy"), 'unexpected argument "xyzzy"$')
        self.assertIn("nearest is lab", self.refused("export", path, "--csv", "--units", "labs", "-o", out))
        self.assertIn("belong to --csv", self.refused("export", path, "--json", "--units", "lab", "-o", out))
        self.assertEqual(os.listdir(self.directory), ["a.db"])
        beads = self.path("beads.db")
        self.good("sweep", *SHORT, "--set", "beads[0].start.phi=3", "--set", "beads[1].start.phi=183", "--over", "drive.frequency=30", "-o", beads)
        for wrong in ("power_drive", "norm_drif"):  # of what this file has
            told = self.refused("export", beads, "--csv", "--quantity", wrong, "-o", out)
            self.assertIn("drive_power", told)
            self.assertNotIn("norm_drift", told)


if __name__ == "__main__":
    unittest.main()
