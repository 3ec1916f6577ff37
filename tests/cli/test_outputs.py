"""No output replaces what the command reads, a database, or a scene; and an export obeys its first signal.

tests: cli/outputs.c host/whole_file.c sweep/rows.c"""

import os
import shutil
import signal
import subprocess
import tempfile
import unittest
from pathlib import Path

import events

FESTOON = os.environ["FESTOON"]
SHORT = ("--set", "run.periods=4", "--set", "run.discard=1", "--set", "run.samples=16")
MAP = ("--radius", "10mm", "--spacing", "2mm")


class Outputs(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.holder = tempfile.TemporaryDirectory(prefix="festoon-outputs-")
        cls.folder = Path(cls.holder.name)
        (cls.folder / "scene.yaml").write_text("magnet:\n  b0: 10 mT\n", encoding="utf-8")
        cls.good("sweep", *SHORT, "--over", "drive.frequency=9Hz:15Hz:3", "-o", "rows.db")
        cls.good("run", *SHORT, "--csv", "run.csv")
        cls.good("field", "--set", "magnet.b0=10mT", "--csv", "map.csv", "--radius", "40mm", "--spacing", "2mm")
        cls.good("branch", "--kind", "locked", "--over", "drive.omega=0.06:0.07", "-o", "branch.json")
        (cls.folder / "grid.yaml").write_text("magnet:\n  shape: grid\n  file: map.csv\n", encoding="utf-8")
        (cls.folder / "points.csv").write_text("frequency [Hz],mean_r [mm],mean_r_error [mm]\n12,19.1,0.2\n15,20.3,0.2\n", encoding="utf-8")

    @classmethod
    def tearDownClass(cls):
        cls.holder.cleanup()

    @classmethod
    def run_festoon(cls, *words):
        return subprocess.run([FESTOON, *words], cwd=cls.folder, capture_output=True, text=True, check=False, timeout=events.HANG)

    @classmethod
    def good(cls, *words):
        done = cls.run_festoon(*words)
        assert done.returncode == 0, done.stderr

    def test_what_would_be_lost_is_kept(self):
        """Each command that writes a file, over each file that it must not replace; also by a link."""
        os.symlink("rows.db", self.folder / "link.db")
        before = {path.name: path.read_bytes() for path in self.folder.iterdir()}
        for words, lost in (
                (("export", "rows.db", "--csv", "-o"), "rows.db"), (("export", "rows.db", "--json", "-o"), "link.db"),
                (("export", "rows.db", "--hdf5", "-o"), "rows.db"), (("export", "rows.db", "--csv", "--quantity", "mean_r", "-o"), "rows.db"),
                (("export", "rows.db", "--csv", "-o"), "scene.yaml"), (("export", "link.db", "--csv", "-o"), "rows.db"),
                (("field", "scene.yaml", *MAP, "--csv"), "scene.yaml"), (("field", "scene.yaml", *MAP, "--csv"), "rows.db"),
                (("field", "grid.yaml", *MAP, "--csv"), "map.csv"), (("field", "grid.yaml", "--smooth", *MAP, "--csv"), "map.csv"),
                (("branch", "scene.yaml", "--kind", "locked", "--over", "drive.omega=0.06:0.07", "-o"), "scene.yaml"),
                (("branch", "--kind", "locked", "--over", "drive.omega=0.06:0.07", "-o"), "rows.db"),
                (("run", "grid.yaml", *SHORT, "--csv"), "map.csv"), (("measure", "run.csv", "-o"), "run.csv"),
                (("measure", "run.csv", "-o"), "./run.csv")):
            with self.subTest(words=words, lost=lost):
                done = self.run_festoon(*words, lost)
                self.assertEqual((done.returncode, done.stdout), (2, ""))
                self.assertIn("would be lost", done.stderr)
                self.assertEqual({path.name: path.read_bytes() for path in self.folder.iterdir()}, before)
        os.unlink(self.folder / "link.db")
        # What a command itself wrote before is replaced, as ever.
        for _ in range(2):
            self.good("export", "rows.db", "--csv", "-o", "rows.csv")
            self.good("field", "scene.yaml", *MAP, "--csv", "other.csv")

    @unittest.skipUnless(shutil.which("gnuplot"), "no gnuplot")
    def test_a_map_is_not_replaced_by_a_drawn_one(self):
        shutil.copy(self.folder / "map.csv", self.folder / "drawn-2.csv")
        (self.folder / "drawn.yaml").write_text("magnet:\n  shape: grid\n  file: drawn-2.csv\n", encoding="utf-8")
        done = self.run_festoon("field", "drawn.yaml", "--smooth", *MAP, "--csv", "drawn.csv", "--draws", "3")
        self.assertEqual((done.returncode, done.stdout), (2, ""), done.stderr)
        self.assertIn("--draws: drawn-2.csv is read, and would be lost", done.stderr)
        self.assertEqual((self.folder / "drawn-2.csv").read_bytes(), (self.folder / "map.csv").read_bytes())
        self.assertEqual(sorted(path.name for path in self.folder.glob("drawn*")), ["drawn-2.csv", "drawn.yaml"])

    def test_a_dash_is_no_file(self):
        for words in (("run", *SHORT, "-o", "-"), ("run", *SHORT, "--csv", "-"), ("export", "rows.db", "--csv", "-o", "-")):
            done = self.run_festoon(*words)
            self.assertEqual((done.returncode, done.stdout), (2, ""), done.stderr)
            self.assertIn("- is no file; write ./-", done.stderr)
        self.assertFalse((self.folder / "-").exists())

    def test_points_are_kept(self):
        done = self.run_festoon("plot", "branch.json", "--points", "points.csv", "-o", "branch.json")
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertIn("would be lost", done.stderr)

    def test_an_export_obeys_its_first_signal(self):
        """A grid of 1e9 points, of which few have a row: their lines would take many minutes."""
        with subprocess.Popen([FESTOON, "sweep", *SHORT, "--over", "drive.frequency=6Hz:16Hz:1000000000", "-o", "large.db"],
                              cwd=self.folder, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL) as sweep:
            events.wait_for(sweep, lambda: (self.folder / "large.db").exists())
            sweep.send_signal(signal.SIGINT)
            self.assertEqual(sweep.wait(events.HANG), 130)
        with subprocess.Popen([FESTOON, "export", "large.db", "--csv", "--quantity", "mean_r", "-o", "large.csv"], cwd=self.folder,
                              stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True) as export:
            events.wait_for(export, lambda: any(path.stat().st_size > 100000 for path in self.folder.glob(".large.csv*")))
            export.send_signal(signal.SIGINT)
            self.assertIn("interrupted", export.communicate(timeout=events.HANG)[1])
            self.assertEqual(export.returncode, 130)
        self.assertEqual([path.name for path in self.folder.glob("*large.csv*")], [])


if __name__ == "__main__":
    unittest.main()
