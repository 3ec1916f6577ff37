"""festoon measure understands the tracks of every program, and says of each bad file what is wrong with it.

tests: io/xml.c tracks/read_columns.c tracks/read_imagej.c tracks/read_tracker.c tracks/read_trackmate.c tracks/read.c tracks/raw.c io/text_lines.c tracks/read_trk.c tracks/choose.c cli/measure.c"""

import json
import math
import os
import subprocess
import tempfile
import unittest

import tracks

FESTOON = os.environ["FESTOON"]
HAS_XML = "expat yes" in subprocess.run([FESTOON, "--version"], capture_output=True, text=True).stdout


class Measure(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)

    def write(self, text, name="track.csv"):
        path = os.path.join(self.folder.name, name)
        with open(path, "wb") as out:
            out.write(text if isinstance(text, bytes) else text.encode("utf-8"))
        return path

    def run_measure(self, text, *options):
        return subprocess.run([FESTOON, "measure", self.write(text), *options], capture_output=True, text=True)

    def measured(self, text, *options):
        done = self.run_measure(text, "--json", *options)
        self.assertEqual(done.returncode, 0, done.stderr)
        return json.loads(done.stdout), done.stderr

    def refused(self, text, *options, status=2):
        done = self.run_measure(text, "--json", *options)
        self.assertEqual((done.returncode, done.stdout), (status, ""), done.stderr)
        return done.stderr


class Formats(Measure):
    ROWS = tracks.places()

    def check(self, text, *options, scale=1.0, unit="px", shown=""):
        found, said = self.measured(text, *options)
        self.assertIn(shown, said)
        self.assertEqual(found["length_unit"], unit)
        self.assertAlmostEqual(found["mean_r"] / scale, tracks.R0, delta=0.02)
        self.assertAlmostEqual(found["std_r"] / scale, tracks.SWING / math.sqrt(2), delta=0.02)
        self.assertAlmostEqual(found["bead_frequency_hz"], -tracks.BEAD, delta=1e-3)
        self.assertAlmostEqual(found["drive_from_track_hz"], tracks.DRIVE, delta=5e-3)
        self.assertAlmostEqual(found["festoons"], tracks.FESTOONS, delta=5e-3)
        self.assertAlmostEqual(found["fps"], 240, delta=0.01)
        self.assertEqual((found["frames"], found["lost"]), (len(self.ROWS), 0))
        return found

    def test_a_trajectory_of_beads_is_no_track(self):
        path = self.write("", "beads.csv")
        scene = os.path.join(os.environ["SOURCE_DIR"], "examples", "worlds", "bowl.yaml")
        subprocess.run([FESTOON, "run", scene, "--set", "run.periods=2", "--set", "run.discard=1", "--csv", path], check=True,
                       capture_output=True)
        with open(path, encoding="utf-8") as file:
            self.assertIn("trajectory of several beads, or of one in a world", self.refused(file.read()))

    def test_own(self):
        self.check(tracks.own(self.ROWS), shown="festoon's own table")
        self.check(tracks.own(self.ROWS, unit="mm"), unit="mm")
        self.check(tracks.own(self.ROWS), "--scale", "0.5mm", scale=0.5, unit="mm")
        self.check(tracks.own(self.ROWS, fps=30), "--fps", "240")

    def test_generic(self):
        self.check(tracks.generic(self.ROWS), shown="a table with named columns")
        self.check(tracks.generic(self.ROWS).encode("utf-16"), shown="a table with named columns")

    def test_tracker(self):
        self.check(tracks.tracker(self.ROWS), "--scale", "1m", scale=0.001, unit="m", shown="Tracker, text")
        self.check(tracks.tracker(self.ROWS), "--scale", "100cm", scale=0.1, unit="cm")
        self.check(tracks.tracker_two(self.ROWS), "--scale", "1m", scale=0.001, unit="m", shown='"mass_C"')
        self.assertIn("unit", self.refused(tracks.tracker(self.ROWS)))

    @unittest.skipUnless(HAS_XML, "this build has no libexpat")
    def test_trk(self):
        self.check(tracks.trk(self.ROWS), scale=1 / 2000, unit="m", shown="Tracker, project")
        self.check(tracks.trk(self.ROWS, pixels_per_unit=1.0), shown="no scale")

    def test_trackpy(self):
        self.check(tracks.trackpy(self.ROWS), "--fps", "240", shown='track "7", the longest of 2')

    def test_trackmate(self):
        self.check(tracks.trackmate(self.ROWS), unit="um", shown="TrackMate, table")
        if HAS_XML:
            self.check(tracks.trackmate_simple(self.ROWS), shown='track "1", the longest of 2')
            self.check(tracks.trackmate_model(self.ROWS), shown="TrackMate, XML")
        else:
            self.assertIn("libexpat1-dev", self.refused(tracks.trackmate_model(self.ROWS), status=1))

    def test_imagej(self):
        self.check(tracks.imagej(self.ROWS), "--fps", "240", shown="ImageJ")
        self.check(tracks.mtrackj(self.ROWS), "--fps", "240", shown='track "2", the longest of 2')

    def test_dltdv(self):
        self.check(tracks.dltdv(self.ROWS, 8), "--fps", "240", shown="DLTdv 8")
        self.check(tracks.dltdv(self.ROWS, 5), "--fps", "240", "--format", "dltdv5", shown="DLTdv 5")

    def test_trajectory(self):
        """A run of festoon's own, as CSV in all units: the numbers of the run come out again."""
        for units in ("scaled", "lab", "si"):
            with self.subTest(units=units):
                self.check_trajectory("--units", units)

    def check_trajectory(self, *words):
        path = os.path.join(self.folder.name, "run.csv")
        done = subprocess.run([FESTOON, "run", "--csv", path, "--json", "--set", "run.periods=60", "--set",
                               "run.discard=20", "--set", "start.r=0.79", *words], capture_output=True, text=True)
        run = json.loads(done.stdout)
        found = subprocess.run([FESTOON, "measure", path, "--json", "--drive", "10.7Hz"], capture_output=True, text=True)
        self.assertEqual(found.returncode, 0, found.stderr)
        found = json.loads(found.stdout)
        half_length = 0.023 if "si" in words else 23
        self.assertEqual(found["length_unit"], "m" if "si" in words else "mm")
        self.assertAlmostEqual(found["drive_from_track_hz"], 10.7, delta=0.01)
        self.assertAlmostEqual(found["mean_r"], half_length * run["mean_r"], delta=0.02 * half_length)

    def test_which_track(self):
        text = tracks.trackpy(self.ROWS)
        self.assertIn('the nearest is 7 (choices: 7, 3)', self.refused(text, "--fps", "240", "--only", "6"))
        self.check(text, "--fps", "240", "--only", "7")

    def test_every_second_frame(self):
        lines = tracks.own(self.ROWS).splitlines()
        found, said = self.measured("\n".join(lines[:1] + lines[1::2]) + "\n")
        self.assertIn("every 2 frames", said)
        self.assertEqual(found["lost"], 0)
        self.assertAlmostEqual(found["fps"], 120, delta=0.01)
        # The camera's rate, given, is that of all frames, whatever the track has of them: no rate changes.
        whole, _ = self.measured(tracks.own(self.ROWS))
        for rows in (lines[1::2], [lines[1 + i] for i in range(0, len(self.ROWS), 2) if not 100 < i < 140]):
            found, _ = self.measured("\n".join(lines[:1] + rows) + "\n", "--fps", "240")
            for key in ("bead_frequency_hz", "drive_from_track_hz"):
                self.assertAlmostEqual(found[key], whole[key], delta=3 * found[key + "_error"])
            self.assertAlmostEqual(found["fps"], 120, delta=0.01)

    def test_a_gap_counts_its_frames(self):
        """A frame without a row counts as lost, as one whose cells are empty does, with a clock or without."""
        lines = tracks.own(self.ROWS).splitlines()
        for gap in (1, 2, 7):
            for clock in (True, False):
                rows = lines[:200] + lines[200 + gap:]
                text = "\n".join(rows if clock else [",".join(row.split(",")[::2] + row.split(",")[3:]) for row in rows]) + "\n"
                found, _ = self.measured(text, *(() if clock else ("--fps", "240")))
                self.assertEqual((found["lost"], found["frames"]), (gap, len(self.ROWS)), (gap, clock))

    def test_an_uneven_clock_is_told_on_average(self):
        head, *rows = tracks.own(self.ROWS).splitlines()
        clock, slowed = 0.0, []
        for i, row in enumerate(rows):
            cells = row.split(",")
            slowed.append(",".join([cells[0], f"{clock:.7f}", *cells[2:]]))
            clock += (8 if 300 <= i < 500 else 1) / 240
        last = float(slowed[-1].split(",")[1])
        said = self.run_measure("\n".join([head, *slowed]) + "\n").stderr
        self.assertIn(f"{(len(rows) - 1) / last:.6g} frames a second on average, unevenly", said)

    def test_a_range_of_frames(self):
        """--from and --to take what an excerpt of the file has."""
        lines = tracks.own(self.ROWS).splitlines()
        found, said = self.measured(tracks.own(self.ROWS), "--from", "101", "--to", "780")
        cut, _ = self.measured("\n".join(lines[:1] + lines[102:782]) + "\n")
        self.assertIn("in frames 101 to 780", said)
        self.assertEqual(found["frames"], 680)
        for key, value in cut.items():
            if isinstance(value, float):
                self.assertAlmostEqual(found[key], value, delta=1e-8 * abs(value), msg=key)
        self.assertEqual(self.measured(tracks.own(self.ROWS), "--to", "780")[0]["frames"], 781)

    def test_a_scale_of_the_file_that_is_replaced_is_told(self):
        _, said = self.measured(tracks.own(self.ROWS, unit="mm"), "--scale", "2mm")
        self.assertIn("replaces", said)


class BadFiles(Measure):
    ROWS = tracks.places(seconds=1.0)

    def test_sentences(self):
        good = tracks.own(self.ROWS)
        lines = good.splitlines()
        cases = [
            ("", "empty"),
            ("frame,t [s],x [px],y [px]\n", "no place"),
            ("\n".join(lines[:2]) + "\n", "one frame"),
            (good.replace(lines[8], lines[8].rsplit(",", 1)[0] + ",east"), ":9: column 4 (y): \"east\" is not a number"),
            (good.replace("[px]", "[furlong]"), "furlong"),
            (good.replace("x [px]", "x [mm]"), "one unit"),
            (good.replace(" [px]", ""), "unit"),
            (good.replace("t [s]", "t [fortnight]"), "fortnight"),
            (good.replace("y [px]", "z [px]"), "the column y is missing"),
            (good.replace(lines[8], "7,0.03"), ":9: the row has 2 cells"),
            (good.replace(lines[8], "7,0.001,1,2"), "does not come after"),
            ("frame,t [s],x [px],y [px],track\n0,0,1,2,a\n0,0,5,9,a\n1,0.1,1,2,a\n", "two beads"),
            ("1,2,3\n4,5,6\n", "the column x is missing"),
            ("<?xml version='1.0'?><Tracks><particle><detection t='0' x='1'/></particle></Tracks>", "detection"),
            ("<Tracks><particle></Tracks>", ":1: this is not XML that can be read: mismatched tag"),
            ("<!DOCTYPE x [<!ENTITY a 'b'>]><Tracks/>", "document type"),
            ("<Tracks", "unclosed"),
            (tracks.own(self.ROWS[:2]).replace("y [px]", "y [px]" + ",a" * 3000), "more than 1024 cells"),
        ]
        for text, words in cases:
            if text.startswith("<") and not HAS_XML:
                continue
            with self.subTest(words=words):
                self.assertIn(words, self.refused(text))

    def test_options(self):
        good = tracks.own(self.ROWS)
        for options, words in [(("--fps", "0"), "--fps"), (("--fps", "fast"), "--fps"), (("--scale", "3"), "--scale"),
                               (("--scale", "-1mm"), "--scale"), (("--format", "traker"), "tracker"),
                               (("--drive", "0Hz"), "--drive"), (("--drive", "10.7 furlongs"), "--drive"),
                               (("--exposure", "2"), "--exposure"), (("--exposure", "2s"), "--exposure"),
                               (("--from", "240"), "csv has frames 0 to 239: of those asked for it has none"),
                               (("--to", "0"), "csv has frames 0 to 239: of those asked for it has one"),
                               (("--from", "2", "--to", "1"), "none"), (("--from", "-1"), "--from"), (("--to", "1.5"), "--to"),
                               (("--only", "b"), "no track")]:
            with self.subTest(options=options):
                self.assertIn(words, self.refused(good, *options))

    def test_frames_of_one_of_several_tracks(self):
        """Which of them ends before --from is said."""
        long, short = self.write(tracks.own(self.ROWS), "long.csv"), self.write(tracks.own(self.ROWS[:100]), "short.csv")
        done = subprocess.run([FESTOON, "measure", long, short, "--from", "120"], capture_output=True, text=True)
        self.assertEqual((done.returncode, done.stdout), (2, ""))
        self.assertRegex(done.stderr, "--from: .*short.csv has frames 0 to 99: of those asked for it has none")

    def test_a_decimal_comma_is_no_second_drive(self):
        paths = [self.write(tracks.own(self.ROWS), name) for name in ("one.csv", "two.csv")]
        for drive in ("10,7Hz", "10,7"):
            done = subprocess.run([FESTOON, "measure", *paths, "--drive", drive], capture_output=True, text=True)
            self.assertEqual((done.returncode, done.stdout), (2, ""))
            self.assertIn("10 stands before a comma without a unit", done.stderr)
        done = subprocess.run([FESTOON, "measure", *paths, "--drive", "10.7Hz,10.7Hz"], capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)

    def test_a_track_is_not_overwritten(self):
        path = self.write(tracks.own(self.ROWS))
        done = subprocess.run([FESTOON, "measure", path, "-o", path], capture_output=True, text=True)
        self.assertEqual((done.returncode, done.stdout), (2, ""))
        self.assertIn("is read, and would be lost", done.stderr)
        with open(path, encoding="utf-8") as text:
            self.assertEqual(text.read(), tracks.own(self.ROWS))

    def test_missing(self):
        done = subprocess.run([FESTOON, "measure"], capture_output=True, text=True)
        self.assertEqual((done.returncode, done.stdout), (2, ""))
        done = subprocess.run([FESTOON, "measure", self.folder.name], capture_output=True, text=True)
        self.assertEqual((done.returncode, done.stdout), (2, ""))

    def test_no_motion(self):
        rest = tracks.places(r0=0.0, swing=0.0)
        self.assertIn("rest", self.refused(tracks.own(rest), status=1))
        trembling = tracks.places(r0=0.3, swing=0.0, noise=0.3, bead=10.7)
        self.assertIn("rest", self.refused(tracks.own(trembling), "--drive", "10.7Hz", status=1))
        self.assertIn("turn", self.refused(tracks.own(tracks.places(seconds=0.2, bead=1.0)), status=1))


if __name__ == "__main__":
    unittest.main()
