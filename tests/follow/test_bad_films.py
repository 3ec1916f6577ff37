"""`festoon track` on films in bad light and by a camera that shakes: a shake is followed, and the track does not have it;
a roll is told;
what cannot be followed is refused with the reason, camera or light.

Without ffmpeg the test is skipped.

tests: follow/still.c follow/learn.c follow/shake.c follow/overlay.c cli/track.c
labels: slow"""

import math
import os
import re
import sys
import tempfile
import unittest

import films
from films import compare, ffmpeg

if not films.can_film():
    sys.exit(77)


class BadFilms(films.OnFilms):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.good = cls.folder / "good.mp4"
        films.film(cls.path, cls.good, "--size", "480x360", "--noise", "1", "--quality", "0", "--readout", "0ms",
                   "--to", "1.5")

    def shaken(self, size):
        """The film by a camera that moves by so many pixels (rms, in both directions), to a quarter of a pixel, or to a
        whole one if it moves by many."""
        film = self.folder / "shaken.mp4"
        fine = 4 if size < 2 else 1
        room, far = fine * int(2 * size + 4), fine * math.sqrt(2) * size
        larger, smaller = (f"scale={fine}*iw:{fine}*ih:flags=bicubic,", f",scale=iw/{fine}:ih/{fine}:flags=area") if fine > 1 else ("", "")
        ffmpeg("-i", self.good, "-vf", f"{larger}crop=iw-{2 * room}:ih-{2 * room}:"
               f"x='{room}+{far}*sin(n*0.37+sin(n*0.05))':y='{room}+{far}*sin(n*0.53+1+2*sin(n*0.031))'{smaller}", "-crf", "16", film)
        return film

    def test_shakes_are_followed(self):
        """From half a pixel to eight: the track is within 0.2 pixels of the truth, but for a constant."""
        for size in (0.5, 8):
            out, done = self.track(self.shaken(size))
            found = compare(out, self.folder / "good.truth.csv")
            self.assertEqual((found["lost"], found["rows"]), (0, found["true_rows"]))
            self.assertLess(found["rms"], 0.15, size)
            told = float(re.search(r"camera      moved by ([\d.]+) pixels", done.stdout)[1])
            self.assertAlmostEqual(told / size, 1.0, delta=0.25)

    def rolled(self, degrees):
        """The film by a camera that turns about its own axis by so many degrees (rms)."""
        film = self.folder / "rolled.mp4"
        ffmpeg("-i", self.good, "-vf", f"rotate='{degrees * math.sqrt(2) / 57.2958}*sin(n*0.37)',crop=iw-80:ih-80", "-crf", "16",
               film)
        return film

    def test_a_camera_that_rolls(self):
        """It is told, with the angle; much of it is refused."""
        _, done = self.track(self.rolled(0.3))
        told = float(re.search(r"turned about its own axis by ([\d.]+) degrees", done.stdout)[1])
        self.assertAlmostEqual(told / 0.3, 1.0, delta=0.25)
        self.refused(self.rolled(2), "the camera turns about its own axis by|degrees|fix the camera")

    def test_a_steady_camera(self):
        """Nothing is said of a shake, and nothing of the light."""
        _, done = self.track(self.good)
        self.assertNotIn("camera  ", done.stdout)
        self.assertNotIn("gray levels of 255 only", done.stderr)
        films.film(self.path, self.folder / "lamps.mp4", "--size", "480x360", "--flicker", "0.3", "--uneven", "0.5",
                   "--noise", "6", "--to", "1.5")
        self.assertNotIn("camera  ", self.track(self.folder / "lamps.mp4")[1].stdout)

    def test_a_ring_within_a_faint_edge(self):
        """A black ring is taken for a plate that hardly differs from the table: the edge around it is told."""
        flat, film = self.folder / "flat.mp4", self.folder / "ring.mp4"
        films.film(self.path, flat, "--size", "480x360", "--noise", "1", "--tilt", "0deg", "--quality", "0", "--to", "0.6")
        for outside, told in (("lum(X,Y)", False), ("if(lt(hypot(X-240,Y-180),146),lum(X,Y),158)", True)):
            ffmpeg("-i", flat, "-vf", f"geq=lum='if(between(hypot(X-240,Y-180),130,134),25,{outside})':cb=128:cr=128",
                   "-crf", "10", "-preset", "ultrafast", film)
            _, done = self.track(film, "--scale", "plate 120 mm")
            self.assertEqual("a fainter edge of 29" in done.stderr, told, done.stdout + done.stderr)

    def test_too_much_shake(self):
        self.refused(self.shaken(45), "the camera moves|pixels|fix the camera")

    def test_bad_light(self):
        """Dark, and so noisy that the bead drowns: both are light, and the sentence has the levels and the noise."""
        film = self.folder / "light.mp4"
        for bright, noise in ((0.04, 0), (0.4, 60)):
            ffmpeg("-i", self.good, "-vf", f"lutyuv=y=16+(val-16)*{bright},noise=alls={noise}:allf=t", "-crf", "16", "-preset", "ultrafast",
                   film)
            with tempfile.TemporaryDirectory() as other:  # refused, it leaves the picture alone
                self.refused(film, "too little light|gray levels|noise|more light", "--figure", f"{other}/why.png")
                self.assertEqual(os.listdir(other), ["why.png"])

    def test_a_dim_film(self):
        """It is tracked with a warning, and its picture is shown brighter."""
        film, picture = self.folder / "dim.mp4", self.folder / "dim.png"
        ffmpeg("-i", self.good, "-vf", "lutyuv=y=16+(val-16)*0.12", "-crf", "10", film)
        _, done = self.track(film, "--figure", picture)
        self.assertNotIn("was converted", done.stderr)
        self.assertRegex(done.stderr, r"differs from the plate by \d+ gray levels of 255 only, where the noise of a pixel is")
        ffmpeg("-i", picture, "-pix_fmt", "gray", self.folder / "dim.pgm")
        ffmpeg("-i", film, "-frames:v", "1", "-pix_fmt", "gray", self.folder / "frame.pgm")
        shown, filmed = (max((self.folder / name).read_bytes()[20:]) for name in ("dim.pgm", "frame.pgm"))
        self.assertGreater(shown, 200)
        self.assertLess(filmed, 60)


if __name__ == "__main__":
    unittest.main()
