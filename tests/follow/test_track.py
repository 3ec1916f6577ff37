"""`festoon movie --camera` and `festoon track` on a short film of few pixels: places and times against the truth, scales,
names of files, and what cannot be tracked.  More: test_track_long.py.

Without ffmpeg the test is skipped.

tests: follow/follow.c follow/decoder.c follow/source.c follow/learn.c follow/bead.c cli/track.c cli/camera.c
labels: slow"""

import math
import os
import re
import shutil
import sys
import unittest

import films
from films import SMALL, compare, ffmpeg, run

if not films.can_film():
    sys.exit(77)


class Track(films.OnFilms):
    @classmethod
    def plain(cls):
        """The track of a.mp4 without options, and what was said; made once."""
        out = cls.folder / "plain.csv"
        if not out.exists():
            cls.said = run("track", cls.folder / "a.mp4", "-o", out)
            assert cls.said.returncode == 0, cls.said.stderr
        return out, cls.said

    def test_places_and_times(self):
        """Within 0.3 pixels of the truth, none lost, y up, rows and times those of the film."""
        out, done = self.plain()
        names, rows = films.read(out)
        self.assertEqual(names, ["frame", "t [s]", "x [px]", "y [px]"])
        found = compare(out, self.folder / "a.truth.csv")
        self.assertLess(found["rms"], 0.3)
        self.assertLess(found["offset"], 0.5)
        self.assertEqual((found["lost"], found["rows"]), (0, found["true_rows"]))
        for i, row in enumerate(rows):
            self.assertEqual(row[0], i)
            self.assertAlmostEqual(row[1], i / 240, places=9)
        self.assertIn(f"frames      {len(rows)}, 240 a second", done.stdout)
        self.assertIn("lost        0\n", done.stdout)
        self.assertNotIn("camera  ", done.stdout)  # which stands still, in good light
        self.assertNotIn("gray levels of 255 only", done.stderr)

    def test_slow_motion(self):
        """The phone's own word for how often it took a picture corrects the clock of a film that plays slowly, as far
        as --fps says nothing else; a film whose clock is right keeps it."""
        for slower, stored, options, rate in ((8, "30", (), 240), (8, "30", ("--fps", "60"), 60), (1, "", (), 240)):
            film = self.folder / "slow.mp4"
            ffmpeg("-itsscale", str(slower), "-i", self.folder / "a.mp4", "-c", "copy", "-movflags", "use_metadata_tags",
                   "-metadata", "com.android.capture.fps=240", film)
            out, done = self.track(film, *options)
            for i, row in enumerate(films.read(out)[1]):
                self.assertAlmostEqual(row[1], i / rate, places=9)
            told = f"taken at 240 frames a second, and is stored at {stored}:"
            self.assertEqual(told in done.stdout, stored != "" and not options, done.stdout)

    def test_a_cut_without_coding_anew(self):
        """What an edit list hides is not missed."""
        film = self.folder / "cut.mp4"
        ffmpeg("-ss", "0.1", "-i", self.folder / "a.mp4", "-c", "copy", film)
        out, done = self.track(film)
        self.assertLess(len(films.read(out)[1]), len(films.read(self.folder / "a.truth.csv")[1]) - 20)
        self.assertNotIn("could be decoded", done.stderr)

    def test_millimetres(self):
        """By the plate's edge and by four marks of a tilted plate: lengths within half a percent.  The bead's own
        diameter, nine pixels here, gives them within half a pixel."""
        marks = self.facts.split('marks        "')[1].split('"')[0]
        distance = self.facts.split("seen from ")[1].split(",")[0]
        for scale in ("plate 120 mm", marks):
            found = compare(self.track(self.folder / "a.mp4", "--scale", scale, "--distance", distance)[0],
                            self.folder / "a.truth.csv")
            self.assertLess(found["rms"], 0.15)
            self.assertAlmostEqual(found["ratio"], 1.0, delta=0.005)
        out = self.track(self.folder / "a.mp4", "--scale", "bead 5 mm")[0]
        self.assertEqual(films.read(out)[0][2:], ["x [mm]", "y [mm]"])
        self.assertAlmostEqual(compare(out, self.folder / "a.truth.csv")["ratio"], 1.0, delta=0.07)
        pixels = films.read(self.plain()[0])[1]
        two = films.read(self.track(self.folder / "a.mp4", "--scale", "10,20:110,20=50mm", "--fps", "30")[0])[1]
        for a, b in zip(pixels, two):
            self.assertAlmostEqual(b[1], a[0] / 30, places=9)
            self.assertAlmostEqual(b[2], 0.5 * a[2], places=9)
            self.assertAlmostEqual(b[3], 0.5 * a[3], places=9)

    def test_errors_of_scales(self):
        """The scale's error is told and stored (measure reads it back: test_measure_program.py); scales that contradict each other are told."""
        distance = self.facts.split("seen from ")[1].split(",")[0]
        out, done = self.track(self.folder / "a.mp4", "--scale", "plate 120 mm; bead 5 mm", "--distance", distance)
        found = re.findall(r"([\d.]+) mm a pixel in the middle of the path, \+- ([\d.]+) % \((.*)\)", done.stdout)
        self.assertEqual([words for _, _, words in found], ["plate 120 mm", "bead 5 mm"])
        self.assertNotIn("contradict", done.stderr)
        self.assertLess(abs(float(found[1][0]) / float(found[0][0]) - 1), 0.01 * float(found[1][1]))
        first = out.read_text().splitlines()[0]
        share = float(first.removeprefix("# scale_error: "))
        self.assertAlmostEqual(100 * share, float(found[0][1]), delta=0.02)
        # Which of two is right nobody knows: the error that is stored reaches from one to the other.
        out, done = self.track(self.folder / "a.mp4", "--scale", "bead 6 mm;plate 120 mm", "--distance", distance)
        share = float(out.read_text().splitlines()[0].removeprefix("# scale_error: "))
        self.assertAlmostEqual(share, 1 / 6, delta=0.02)
        self.assertRegex(done.stderr, r"contradict each other: .* by \"bead 6 mm\", which is used, and .* by \"plate 120 mm\"")
        self.refused(self.folder / "a.mp4", "not a scale", "--scale", "plate 120 mm;")
        self.refused(self.folder / "a.mp4", "more than 4", "--scale", ";".join(["bead 5 mm"] * 5))

    def test_lists_of_other_files_are_no_films(self):
        """A playlist that names a film is not followed."""
        for name, text in (("x.m3u8", f"#EXTM3U\n#EXTINF:1,\nfile://{self.folder}/a.mp4\n"),
                           ("y.mp4", f"ffconcat version 1.0\nfile {self.folder}/a.mp4\n"), ("z.mp4", "hello\n")):
            (self.folder / name).write_text(text)
            self.refused(self.folder / name, "not a film")
        self.refused(self.folder / "nowhere.mp4", "No such file")
        self.refused("/dev/zero", "regular file")
        (self.folder / "empty").mkdir()
        self.refused(self.folder / "empty", "no images")

    def test_what_is_not_understood(self):
        good = self.folder / "a.mp4"
        self.refused(good, "--scale|unit", "--scale", "bead 5")
        self.refused(good, "--scale|plate 460 mm", "--scale", "disc 5 mm")
        self.refused(good, "--scale|outside", "--scale", "1,2:3,4000=5mm")
        self.refused(good, "--distance|more than 0", "--distance", "-3mm")
        for distance in ("18", "18mm"):
            self.refused(good, "focal length of|is the unit right", "--scale", "plate 120 mm", "--distance", distance)
        # The picture shows what was found, where no scale follows from it.
        done = run("track", good, "-o", self.folder / "no.csv", "--scale", "plate 120 mm", "--distance", "1mm", "--figure",
                   self.folder / "why.png")
        self.assertEqual((done.returncode, (self.folder / "no.csv").exists()), (2, False))
        self.assertTrue("--distance" in done.stderr and "mm" in done.stderr, done.stderr)
        self.assertTrue((self.folder / "why.png").read_bytes().startswith(b"\x89PNG"))
        self.refused(good, ".png", "--figure", self.folder / "x.jpg")
        self.refused(good, ".mp4", "--overlay", self.folder / "x.avi")
        self.refused(good, "cannot write", "--overlay", self.folder / "nowhere" / "x.mp4", status=1)
        done = run("track", good, "-o", self.folder / "nowhere" / "x.csv", "--overlay", self.folder / "left.mp4")
        self.assertEqual(done.returncode, 1)
        self.assertFalse((self.folder / "left.mp4").exists())
        done = run("track", good, "-o", self.folder / "x.csv", env={**os.environ, "PATH": "/nowhere"})
        self.assertEqual(done.returncode, 1)
        self.assertIn("install the package ffmpeg", done.stderr)

    def test_camera_options(self):
        """What a camera cannot do is refused, and options of one kind of film do not go with the other."""
        for options, words in ((("--exposure", "5ms"), "longer than a frame"), (("--exposure", "soon"), "1/500s"),
                               (("--tilt", "80deg"), "0 to 60"), (("--size", "321x240"), "even"),
                               (("--plate", "10mm"), "needs a plate"), (("--drop", "1"), "from 2"),
                               (("--turn", "2"), "no meaning with --camera"), (("--from", "90"), "no samples"),
                               (("--quality", "77"), "0 to 51")):
            done = run("movie", self.path, "-o", self.folder / "no.mp4", "--camera", *options)
            self.assertEqual(done.returncode, 2, (options, done.stderr))
            self.assertIn(words, done.stderr)
        done = run("movie", self.path, "-o", self.folder / "no.mp4", "--tilt", "5deg")
        self.assertIn("--tilt needs --camera", done.stderr)
        self.assertFalse((self.folder / "no.mp4").exists())
        self.assertFalse((self.folder / "no.truth.csv").exists())

    def test_truth(self):
        """The truth is the trajectory: at the middle of each exposure."""
        films.film(self.path, self.folder / "e.mp4", *SMALL, "--to", "0.5", "--exposure", "1/1000s")
        lines = [line for line in self.path.read_text().splitlines() if not line.startswith("#")]
        names = [name.split()[0].split("(")[0] for name in lines[0].split(",")]
        rows = [dict(zip(names, map(float, line.split(",")))) for line in lines[1:]]
        gamma = [line for line in self.path.read_text().splitlines() if "gamma:" in line][0]
        rate = float(gamma.split("gamma:")[1].split()[0])
        for frame, t, x, y, *_ in films.read(self.folder / "e.truth.csv")[1]:
            self.assertAlmostEqual(t, frame / 240, places=8)
            now = (t + 0.0005) * rate
            i = max(k for k, row in enumerate(rows) if row["t"] <= now)
            part = (now - rows[i]["t"]) / (rows[i + 1]["t"] - rows[i]["t"])
            for key, value in (("x", x), ("y", y)):
                between = rows[i][key] + part * (rows[i + 1][key] - rows[i][key])
                self.assertTrue(math.isclose(23.0 * between, value, abs_tol=0.1), (frame, key))

    def test_names_are_only_names(self):
        """A name that ffmpeg could take for an option, a pattern or a protocol; names of files to write."""
        name = "-i concat:a%d 'q\"\n|x.mp4"
        shutil.copy(self.folder / "a.mp4", self.folder / name)
        done = run("track", "-o", "o%d.csv", "--overlay", "v%d.mp4", "--figure", "p%d.png", "--", name, cwd=self.folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn(b"ftyp", (self.folder / "v%d.mp4").read_bytes()[:12])
        self.assertEqual((self.folder / "p%d.png").read_bytes()[:8], b"\x89PNG\r\n\x1a\n")
        self.assertEqual(compare(self.folder / "o%d.csv", self.folder / "a.truth.csv")["lost"], 0)

    def test_several_films(self):
        """A table, and the tracks that each film has alone; one that fails is told, and the others are there."""
        shutil.copy(self.folder / "a.mp4", self.folder / "b.c.mp4")
        alone = self.plain()[0].read_bytes()
        (self.folder / "to").mkdir()
        films_of_two = [self.folder / "a.mp4", self.folder / "b.c.mp4"]
        done = run("track", *films_of_two, "-o", self.folder / "to")
        self.assertEqual(done.returncode, 0, done.stderr)
        table = [line.split() for line in done.stdout.splitlines()]
        rows = alone.count(b"\n") - 1
        self.assertEqual([line[:3] + line[4:] for line in table[1:]],
                         [[str(rows), "240", "0", "-", str(self.folder / "to" / name)] for name in ("a.csv", "b.c.csv")])
        for name in ("a.csv", "b.c.csv"):
            self.assertEqual((self.folder / "to" / name).read_bytes(), alone)
            (self.folder / "to" / name).unlink()
        (self.folder / "none.mp4").write_bytes(b"nothing")
        done = run("track", self.folder / "none.mp4", *films_of_two, "-o", self.folder / "to")
        self.assertEqual(done.returncode, 2)
        self.assertEqual([line.split() for line in done.stdout.splitlines()],
                         [table[0], [*5 * "-", "failed:", str(self.folder / "none.mp4")], *table[1:]])
        self.assertRegex(done.stderr, r"none\.mp4: .*\n(?s:.*)wrote .*b\.c\.csv(?s:.*)not all films could be tracked")
        self.assertEqual((self.folder / "to" / "b.c.csv").read_bytes(), alone)
        for words, wanted in [([*films_of_two, "-o", self.folder / "o.csv"], "not a folder"),
                              ([*films_of_two, self.folder / "to" / ".." / "a.mp4", "-o", self.folder / "to"], "as that of"),
                              ([*films_of_two, "-o", self.folder / "to", "--figure", "p.png"], "--figure is of one film")]:
            done = run("track", *words)
            self.assertEqual((done.returncode, done.stdout), (2, ""))
            self.assertIn(wanted, done.stderr)

    def test_a_film_is_not_overwritten(self):
        """By no output, also under another name."""
        film = self.folder / "kept.mp4"
        shutil.copy(self.folder / "a.mp4", film)
        (self.folder / "link.mp4").symlink_to(film)
        for options in (["-o", film], ["-o", self.folder / "link.mp4"], ["-o", self.folder / "o.csv", "--overlay", film],
                        ["-o", self.folder / "o.csv", "--figure", film]):
            done = run("track", film, *options)
            self.assertEqual((done.returncode, done.stdout), (2, ""))
            self.assertIn("is read, and would be lost", done.stderr)
        self.assertEqual(film.read_bytes(), (self.folder / "a.mp4").read_bytes())

    def test_no_bead(self):
        ffmpeg("-f", "lavfi", "-i", "color=gray:s=160x120:d=1,noise=alls=8", self.folder / "blank.mp4")
        self.refused(self.folder / "blank.mp4", "no bead was found|gray levels")


if __name__ == "__main__":
    unittest.main()
