"""`festoon track` on more films: of other formats, sizes, cameras and faults, each against its truth.  The quick test is
test_track.py.

Without ffmpeg the test is skipped.

tests: follow/follow.c follow/decoder.c follow/source.c follow/still.c follow/plate.c follow/rim.c
labels: long"""

import os
import random
import re
import shutil
import signal
import subprocess
import sys
import unittest

import films
from films import FESTOON, SMALL, compare, ffmpeg, run

if not films.can_film():
    sys.exit(77)


class Films(films.OnFilms):
    def test_the_same_track_again(self):
        first = self.track(self.folder / "a.mp4")[0].read_bytes()
        self.assertEqual(first, self.track(self.folder / "a.mp4")[0].read_bytes())

    def test_frames_that_the_camera_lost(self):
        """Times jump where a frame is missing, and a person is told."""
        films.film(self.path, self.folder / "d.mp4", *SMALL, "--to", "2.7", "--drop", "7")
        out, done = self.track(self.folder / "d.mp4")
        rows, truth = films.read(out)[1], films.read(self.folder / "d.truth.csv")[1]
        self.assertEqual(len(rows), len(truth))
        for row, true in zip(rows, truth):
            self.assertAlmostEqual(row[1], true[1], places=6)
        self.assertLess(compare(out, self.folder / "d.truth.csv")["rms"], 0.3)
        self.assertIn("the frame rate varies", done.stdout)
        self.assertIn("leaves room for", done.stdout)

    def test_turned_films(self):
        """A film that says it is to be turned is turned: x becomes what was down."""
        ffmpeg("-i", self.folder / "a.mp4", "-c", "copy", "-metadata:s:v", "rotate=90", self.folder / "r.mp4")
        plain = films.read(self.track(self.folder / "a.mp4")[0])[1]
        turned = films.read(self.track(self.folder / "r.mp4")[0])[1]
        for a, b in zip(plain, turned):
            self.assertAlmostEqual(b[2], 239 - a[3], delta=0.2)
            self.assertAlmostEqual(b[3], a[2], delta=0.2)

    def test_images_in_a_folder(self):
        """Frames as PGM and PNG, in the order of their numbers; without --fps they have no clock."""
        films.film(self.path, self.folder / "images", *SMALL, "--to", "1.5")
        found = compare(self.track(self.folder / "images", "--fps", "240")[0], self.folder / "images.truth.csv")
        self.assertLess(found["rms"], 0.3)
        self.assertEqual((found["lost"], found["rows"]), (0, found["true_rows"]))
        self.refused(self.folder / "images", "clock|fps")
        (self.folder / "png").mkdir()
        ffmpeg("-i", self.folder / "images" / "frame-%05d.pgm", self.folder / "png" / "f%d.png")
        (self.folder / "png" / "notes.txt").write_text("not an image")
        found = compare(self.track(self.folder / "png", "--fps", "240")[0], self.folder / "images.truth.csv")
        self.assertLess(found["rms"], 0.3)
        self.assertEqual(found["lost"], 0)

    def test_names_are_only_names(self):
        """Names that ffmpeg could take for options, patterns or protocols."""
        (self.folder / "http:").mkdir()
        plain = self.track(self.folder / "a.mp4")[0].read_bytes()
        for name in ("-i.mp4", "a%d 'q\"\n.mp4", "concat:x|y.mp4", "http:/x.mp4"):
            shutil.copy(self.folder / "a.mp4", self.folder / name)
            done = run("track", "-o", "named.csv", "--", name, cwd=self.folder)
            self.assertEqual(done.returncode, 0, (name, done.stderr))
            self.assertEqual((self.folder / "named.csv").read_bytes(), plain)
        done = run("track", "a.mp4", "-o", "o%d.csv", "--overlay", "v%d.mp4", "--figure", "p%d.png", cwd=self.folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn(b"ftyp", (self.folder / "v%d.mp4").read_bytes()[:12])
        self.assertEqual((self.folder / "p%d.png").read_bytes()[:8], b"\x89PNG\r\n\x1a\n")

    def test_what_cannot_be_tracked(self):
        """No bead, one frame, two beads, no pictures: each a sentence that helps."""
        ffmpeg("-f", "lavfi", "-i", "color=gray:s=160x120:d=1,noise=alls=8", self.folder / "blank.mp4")
        self.refused(self.folder / "blank.mp4", "no bead was found|gray levels")
        ffmpeg("-i", self.folder / "a.mp4", "-frames:v", "1", self.folder / "one.mp4")
        self.refused(self.folder / "one.mp4", "1 frame|5 frames")
        ffmpeg("-i", self.folder / "a.mp4", "-filter_complex", "[0]split[b][c];[b][c]hstack", self.folder / "two.mp4")
        self.refused(self.folder / "two.mp4", "two things|one bead")
        ffmpeg("-f", "lavfi", "-i", "sine=d=1", self.folder / "sound.mp4")
        self.refused(self.folder / "sound.mp4", "no pictures")

    def test_errors_of_scales(self):
        """Of films by many cameras, the scales by the plate and by the bead are within their errors of the truth, mostly; and
        the errors are no larger than half a pixel or so makes them."""
        chance = random.Random(3)
        within, shares = {"plate 120 mm": 0, "bead 5 mm": 0}, []
        for seed in range(8):
            film = self.folder / "s.mp4"
            facts = films.film(self.path, film, "--size", chance.choice(("320x240", "480x270", "640x360")), "--seed", seed,
                               "--tilt", f"{chance.uniform(0, 25):.1f}deg", "--side", f"{chance.uniform(0, 360):.0f}deg",
                               "--noise", f"{chance.uniform(0, 5):.1f}", "--exposure", chance.choice(("1ms", "3ms")),
                               "--uneven", f"{chance.uniform(0, 0.5):.2f}", "--distance",
                               f"{chance.uniform(160, 500):.0f}mm")
            distance = facts.split("seen from ")[1].split(",")[0]
            out, done = self.track(film, "--scale", ";".join(within), "--distance", distance)
            self.assertNotIn("contradict", done.stderr)
            found = re.findall(r"([\d.]+) mm a pixel in the middle of the path, \+- ([\d.e-]+) % \((.*)\)", done.stdout)
            true = float(found[0][0]) / compare(out, self.folder / "s.truth.csv")["ratio"]
            for value, share, words in found:
                within[words] += abs(float(value) / true - 1) < 0.01 * float(share)
                shares.append(float(share))
        for words, count in within.items():
            self.assertGreaterEqual(count, 5, words)
        self.assertLess(max(shares[::2]), 0.3)
        self.assertLess(max(shares[1::2]), 5)

    def follows(self, name, rms, *options, trajectory=None):
        """A film by such a camera: nothing is lost, and places are within `rms` pixels."""
        films.film(trajectory or self.path, self.folder / name, *options)
        found = compare(self.track(self.folder / name)[0], self.folder / (name.rsplit(".", 1)[0] + ".truth.csv"))
        self.assertEqual((found["lost"], found["rows"]), (0, found["true_rows"]), name)
        self.assertLess(found["rms"], rms, name)

    def test_good_cameras(self):
        """At 240 frames a second nothing is lost and the rms is below 0.3 px, at 10.7 and at 19.9 Hz, under lamps that
        flicker, in uneven light, with noise, and seen from the side."""
        quick = self.folder / "quick.csv"
        films.trajectory(quick, 40, "19.9Hz")
        self.follows("hd.mp4", 0.15, "--size", "1280x720")
        self.follows("fast.mp4", 0.3, "--size", "640x360", "--exposure", "4ms", trajectory=quick)
        self.follows("flicker.mp4", 0.3, "--size", "640x360", "--flicker", "0.2", "--uneven", "0.6")
        self.follows("noise.mp4", 0.3, "--size", "640x360", "--noise", "8", "--quality", "28")
        self.follows("side.mov", 0.3, "--size", "640x360", "--tilt", "35deg", "--side", "20deg")

    def test_slow_cameras(self):
        """30 frames a second lose nothing either, and blur costs less than a tenth of the bead's width."""
        slow = self.folder / "slow.csv"
        films.trajectory(slow, 100)
        self.follows("s16.mp4", 0.4, "--size", "640x360", "--fps", "30", "--exposure", "16ms", trajectory=slow)
        self.follows("s30.mp4", 1.0, "--size", "640x360", "--fps", "30", "--exposure", "30ms", trajectory=slow)

    def test_other_formats(self):
        for name, options in (("a.webm", ("-c:v", "libvpx", "-b:v", "2M")), ("a.gif", ()), ("a.avi", ()),
                              ("a.mkv", ("-c", "copy")), ("up.mp4", ("-vf", "negate"))):
            ffmpeg("-i", self.folder / "a.mp4", *options, self.folder / name)
            out, _ = self.track(self.folder / name)
            if name == "a.gif":  # its clock counts hundredths of a second, so frames are left out
                self.assertGreater(len(films.read(out)[1]), 15)
                continue
            found = compare(out, self.folder / "a.truth.csv")
            self.assertEqual((found["lost"], found["rows"]), (0, found["true_rows"]), name)
            self.assertLess(found["rms"], 0.3, name)

    def test_a_film_cut_short(self):
        """What can be decoded is tracked, and a person is told how much that is."""
        films.film(self.path, self.folder / "long.mp4", *SMALL)
        whole = (self.folder / "long.mp4").read_bytes()
        (self.folder / "cut.mp4").write_bytes(whole[:len(whole) * 2 // 3])
        _, done = self.track(self.folder / "cut.mp4")
        self.assertIn("could be decoded", done.stderr)

    def test_duplicates_are_told(self):
        """A film of 240 frames a second converted to 300: every fifth frame is there twice."""
        ffmpeg("-i", self.folder / "a.mp4", "-r", "300", self.folder / "twice.mp4")
        _, done = self.track(self.folder / "twice.mp4")
        self.assertIn("repeat the one before", done.stderr)

    def test_interrupted(self):
        """Ctrl-C ends it with status 130, and nothing is left."""
        films.film(self.path, self.folder / "hd.mp4", "--size", "1280x720")
        before = set(os.listdir(self.folder))
        process = subprocess.Popen([FESTOON, "track", self.folder / "hd.mp4", "-o", self.folder / "i.csv", "--overlay",
                                    self.folder / "i.mp4", "--figure", self.folder / "i.png"], cwd=self.folder,
                                   stderr=subprocess.PIPE, start_new_session=True)
        while not any(name.startswith(".i.") for name in os.listdir(self.folder)):  # its first file has begun
            self.assertIsNone(process.poll())
        os.killpg(process.pid, signal.SIGINT)
        self.assertEqual((process.wait(), b"interrupted" in process.stderr.read()), (130, True))
        process.stderr.close()
        self.assertEqual(set(os.listdir(self.folder)), before)

    def test_memory_is_bounded(self):
        """A film twice as long takes no more memory but for its track."""
        peaks = []
        for periods in (20, 40):
            path = self.folder / f"m{periods}.csv"
            films.trajectory(path, periods)
            films.film(path, self.folder / "m.mp4", *SMALL)
            done = subprocess.run(["python3", "-c", "import resource, subprocess, sys; "
                                   "subprocess.run(sys.argv[1:], check=True, stdout=subprocess.DEVNULL); "
                                   "print(resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss)", FESTOON, "track",
                                   self.folder / "m.mp4", "-o", self.folder / "m.csv"], capture_output=True, check=True)
            peaks.append(int(done.stdout))
        self.assertLess(peaks[1], 1.1 * peaks[0])


if __name__ == "__main__":
    unittest.main()
