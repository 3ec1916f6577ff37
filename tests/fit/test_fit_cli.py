"""The command fit as a user meets it: keys, statuses, sentences, figures.

tests: fit/json.c cli/fit.c fit/figure_fit.c measure/points.c"""

import csv
import json
import os
import random
import signal
import subprocess
import tempfile
import unittest

from sweep_tools import FESTOON, festoon

HEAD = "frequency [Hz],mean_r [mm],mean_r_error [mm],std_r [mm],std_r_error [mm],bead_frequency [Hz],bead_frequency_error [Hz]"


def row(frequency, *sets):
    """A row of the table by the program's own orbit."""
    status, out, err = festoon("orbit", "--json", "--set", f"drive.frequency={frequency}", *sets)
    if status != 0:
        raise AssertionError(err)
    orbit = json.loads(out)
    rate = orbit["scene"]["friction.gamma"] / 6.283185307179586
    return [frequency, 23 * orbit["mean_r"], 0.05, 23 * orbit["std_r"], 0.03, rate * orbit["mean_alpha_dot"], 0.005]


class Fit(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.rows = [row(f, "--set", "model.kappa=1.7", "--set", "friction.gamma=290") for f in (11, 13.5, 16, 19)]
        cls.table = cls.write("points.csv", cls.rows)

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    @classmethod
    def write(cls, name, rows, head=HEAD):
        path = os.path.join(cls.folder.name, name)
        with open(path, "w", encoding="utf-8") as out:
            out.write(head + "\n")
            for cells in rows:
                out.write(",".join(str(cell) for cell in cells) + "\n")
        return path

    def refused(self, words, *says):
        status, out, err = festoon("fit", *words)
        self.assertEqual((status, out), (2, ""), err)
        for text in says:
            self.assertIn(text, err)

    def check_what_is_left(self, figure):
        """Below each quantity stands what is left: the points less the model, here nothing, with the same errors; a
        band is named in the key only where it can be seen."""
        with open(figure.replace(".svg", ".dat"), encoding="utf-8") as text:
            blocks = [block.strip("\n").split("\n") for block in text.read().split("\n\n\n")]
        named = {lines[0][2:]: [[float(word) for word in line.split()] for line in lines[2:] if line.strip()]
                 for lines in blocks}
        points, left = named["panel1-curve3"], named["panel2-curve3"]
        self.assertEqual([point[0] for point in points], [point[0] for point in left])
        for point, rest in zip(points, left):
            self.assertLess(abs(rest[1]), 0.1 * (rest[5] - rest[4]))
            self.assertAlmostEqual(point[5] - point[4], rest[5] - rest[4], 6)
        self.assertEqual({y for _, y, *_ in named["panel2-curve2"]}, {0.0})
        titles = {lines[0][2:]: lines[1] for lines in blocks if len(lines) > 1}
        for panel in (1, 2):
            band, height = named[f"panel{panel}-curve1"], named[f"panel{panel}-curve3"]
            widest = max(row[3] - row[2] for row in band)
            reach = max(row[3] for row in band) - min(row[2] for row in band)
            reach = max(reach, max(row[5] for row in height) - min(row[4] for row in height))
            if not 0.008 < widest / reach < 0.012:
                self.assertEqual("uncertainty" in titles[f"panel{panel}-curve1"], widest > 0.01 * reach)

    def test_keys(self):
        figure = os.path.join(self.folder.name, "fit.svg")
        drawn = ["-o", figure] if "gnuplot yes" in festoon("--version")[1] else []
        status, out, err = festoon("fit", self.table, "--free", "model.kappa,friction.gamma", "--json", *drawn)
        self.assertEqual(status, 0, err)
        if drawn:
            with open(figure, encoding="utf-8") as text:
                picture = text.read()
            for word in ("measured", "model", "frequency of the magnet"):
                self.assertIn(word, picture)
            self.check_what_is_left(figure)
        fit = json.loads(out)
        for key in "parameters derived correlation chi2 dof weakest outliers points".split():
            self.assertIn(key, fit)
        self.assertEqual([p["key"] for p in fit["parameters"]], ["model.kappa", "friction.gamma"])
        for p, truth in zip(fit["parameters"], (1.7, 290)):
            self.assertAlmostEqual(p["value"] / truth, 1, 4)
            self.assertGreater(p["error"], 0)
            self.assertTrue(p["interval"][0] < truth < p["interval"][1])
        strength = fit["derived"]["kappa_gamma2"]
        self.assertAlmostEqual(strength["value"] / (1.7 * 290 * 290), 1, 4)
        self.assertGreater(strength["error"], 0)
        self.assertEqual(fit["correlation"][0][1], fit["correlation"][1][0])
        words = ["fit", self.table, "--free", "magnet.depth", "--set", "model.kappa=1.7"]
        self.assertEqual(json.loads(festoon(*words, "--json")[1])["derived"], {})
        self.assertNotIn("gamma^2", festoon(*words)[1])
        self.assertEqual((fit["points"], fit["dof"], fit["outliers"]), (12, 10, []))
        self.assertIn("friction.gamma", fit["weakest"])

    def test_wild_number_by_line_and_column(self):
        rows = [list(cells) for cells in self.rows]
        rows[2][5] = -3.4
        status, out, err = festoon("fit", self.write("wild.csv", rows), "--free", "model.kappa,friction.gamma", "--json")
        self.assertEqual(status, 0, err)
        fit = json.loads(out)
        self.assertEqual([(o["line"], o["column"], o["column_number"]) for o in fit["outliers"]], [(4, "bead_frequency", 6)])
        self.assertAlmostEqual(fit["parameters"][1]["value"] / 290, 1, 4)

    def test_a_film_in_slow_motion(self):
        """Rates that are 8 times too low are those of no bead near the scene: the fit ends at once, and says so."""
        slow = [self.rows[0][0] / 8, *self.rows[0][1:5], self.rows[0][5] / 8, 0.0001]
        status, out, err = festoon("fit", self.write("slow.csv", [slow]), "--free", "model.kappa,friction.gamma")
        self.assertEqual((status, out), (1, ""), err)
        self.assertIn("no motion like the measured one", err)
        self.assertIn("stored as 30", err)

    def test_given_has_units_and_may_be_repeated(self):
        status, out, err = festoon("fit", self.table, "--free", "model.kappa", "--given", "magnet.depth=16.2+-0.2 mm",
                                   "--given", "friction.gamma=290 1/s +- 5 1/s", "--json")
        self.assertEqual(status, 0, err)
        fit = json.loads(out)
        self.assertEqual([p["key"] for p in fit["parameters"]], ["model.kappa"])
        self.assertEqual([p["key"] for p in fit["given"]], ["magnet.depth", "friction.gamma"])
        self.assertEqual(fit["given"][0]["given"], [0.0162, 0.0002])
        self.assertAlmostEqual(fit["given"][0]["value"], 0.0162, 6)
        self.assertEqual(fit["dof"], 11)

    def test_bad_tables(self):
        free = ["--free", "model.kappa,friction.gamma"]
        good = ",".join(str(cell) for cell in self.rows[0])
        for lines, says in (
            ([HEAD, good, "11,twenty,1,1,1,1,1"], [":3", "column 2 (mean_r)", "twenty"]),
            ([HEAD, good, "11,20,0,1,1,1,1"], [":3", "column 3 (mean_r_error)", "greater than 0"]),
            ([HEAD, "11,20,1"], [":2", "column 4 (std_r)"]),
            (["frequency [Hz],mean_r [mm]", "11,20"], [":1", "column 2 (mean_r)", "mean_r_error"]),
            (["frequency [Hz],mean_r [mile],mean_r_error [mm]", "11,20,1"], [":1", "column 2 (mean_r)", "mile"]),
            (["frequency [Hz],mean_r [mm],mean_r_error [mm]", "11,20,1"], ["1 numbers, and 2 parameters"]),
        ):
            path = self.write("bad.csv", [], "\n".join(lines))
            self.refused([path, *free], *says)
        self.refused(["no-such-file.csv", *free], "no-such-file.csv")

    def test_options_of_tracks(self):
        """They would be without effect on a table."""
        for words in (("--exposure", "2ms"), ("--scale", "3mm"), ("--drive", "5Hz"), ("--fps", "240"), ("--from", "3"), ("--to", "5")):
            self.refused([self.table, "--free", "model.kappa", *words], f"{words[0]} belongs to tracks")

    def test_a_film_of_two_beads(self):
        rows = [f"{frame},{frame / 240:.6f},{x},{frame % 7},{name},0" for frame in range(40) for name, x in ((1, frame), (2, -frame))]
        path = os.path.join(self.folder.name, "two.csv")
        with open(path, "w", encoding="utf-8") as text:
            text.write("\n".join(["frame,t [s],x [mm],y [mm],track,doubts", *rows]) + "\n")
        self.refused(["--track", path, "--free", "model.kappa"], "the film has 2 beads")

    def test_a_film_of_a_locked_bead(self):
        path = os.path.join(self.folder.name, "locked.csv")
        done = festoon("run", "--set", "drive.frequency=3 Hz", "--set", "run.periods=40", "--set", "run.samples=80", "--csv", path)
        self.assertEqual(done[0], 0, done[2])
        status, _, err = festoon("fit", "--track", path, "--free", "model.kappa", "--drive", "3Hz")
        self.assertNotEqual(status, 0)
        self.assertIn("in this film the bead is locked to the magnet (3 Hz)", err)

    def test_the_drive_of_a_film(self):
        """It is said how the magnet turned, with an error that covers the truth, and from where that is known."""
        path = os.path.join(self.folder.name, "film.csv")
        done = subprocess.run([FESTOON, "run", "--set", "drive.frequency=12Hz", "--set", "run.periods=100", "--set", "run.discard=60",
                               "--csv", path, "--units", "lab", "--fps", "240"], capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        with open(path, encoding="utf-8") as text:
            rows = list(csv.reader(line for line in text if not line.startswith("#")))
        places = [[word.split(" [")[0] for word in rows[0]].index(name) for name in ("t", "x", "y")]
        chance = random.Random(4)
        lines = [",".join([row[places[0]], *(f"{float(row[k]) + chance.gauss(0, 0.05):.5f}" for k in places[1:])]) for row in rows[1:]]
        with open(path, "w", encoding="utf-8") as text:
            text.write("\n".join(["t [s],x [mm],y [mm]", *lines]) + "\n")
        for words, given in (((), None), (("--drive", "12.01Hz"), 12.01)):
            found = json.loads(festoon("fit", "--track", path, "--free", "model.kappa,friction.gamma", "--json", *words)[1])["drive"]
            self.assertEqual((found["given"], found["unit"]), (given, "Hz"))
            self.assertLess(abs(found["value"] - 12), 4 * found["error"])
            self.assertLess(found["error"], 1e-3)
            said = festoon("fit", "--track", path, "--free", "model.kappa,friction.gamma", *words)[1]
            self.assertRegex(said, r"\n  drive +12\.0*\d* \+- 0\.0*\d+ Hz .*, " + (f"sought from the {given} Hz given" if given else "as the track told it")
                             if found["value"] >= 12 else r"\n  drive +11\.9+\d* \+- ")
        self.assertNotIn("drive", json.loads(festoon("fit", self.table, "--free", "model.kappa,friction.gamma", "--json")[1]))

    def test_bad_wishes(self):
        self.refused([self.table], "--free model.kappa,friction.gamma")
        self.refused([], "festoon measure")
        self.refused([self.table, "--free", "model.kapa"], "--free", "model.kappa")
        self.refused([self.table, "--free", "model.kappa,"], "--free")
        self.refused([self.table, "--free", "model.kappa,bead.mass"], "do not depend on bead.mass")
        self.refused([self.table, "--free", "model.kappa", "--given", "magnet.depth=16"], "--given", "KEY=VALUE+-ERROR")
        self.refused([self.table, "--free", "model.kappa", "--bootstrap", "3"], "--bootstrap")
        self.refused([self.table, self.table, "--free", "model.kappa"], "a table already")
        self.refused([self.table, "--free", "model.kappa,friction.gamma", "--set", "friction.law=coulomb"],
                     "model.kappa, friction.gamma")

    def test_interruption(self):
        done = subprocess.Popen([FESTOON, "fit", self.table, "--free", "model.kappa,friction.gamma", "--bootstrap", "100000"],
                                stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        # It ends by the signal whenever that comes once the program's handlers stand; before, the signal itself ends it.
        done.send_signal(signal.SIGINT)
        out, _ = done.communicate(timeout=1000)
        self.assertIn(done.returncode, (130, -signal.SIGINT))
        self.assertEqual(out, b"")


if __name__ == "__main__":
    if "cminpack yes" not in festoon("--version")[1] or "lapack yes" not in festoon("--version")[1]:
        print("skipped: festoon was built without cminpack or LAPACK")
        raise SystemExit(77)
    unittest.main()
