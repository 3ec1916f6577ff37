"""The sweeps of examples/, small, as a user runs them: from an empty folder, with the program on the PATH or built.

tests: cli/sweep.c
labels: numbers"""

import os
import shutil
import sqlite3
import subprocess
import sys
import unittest

from sweep_tools import FESTOON, Case, content_of

EXAMPLES = os.path.join(os.environ["SOURCE_DIR"], "examples")


class Examples(Case):
    def run_example(self, name, *counts, **environment):
        done = subprocess.run([os.path.join(EXAMPLES, name), *map(str, counts)], cwd=self.directory, timeout=1000,
                              env=dict(os.environ, FESTOON=FESTOON, **environment), stdin=subprocess.DEVNULL,
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout.decode()

    def query(self, name, text):
        base = sqlite3.connect(self.path(name))
        try:
            return base.execute(text).fetchall()
        finally:
            base.close()

    def is_png(self, name):
        self.assertEqual(content_of(self.path(name))[:8], b"\x89PNG\r\n\x1a\n", name)

    def test_frequency(self):
        out = self.run_example("sweep-frequency.sh", 12)
        self.assertIn("all 12 points", out)
        regimes = [regime for regime, in self.query("sweep-frequency.db", "SELECT regime FROM rows ORDER BY point")]
        self.assertEqual(regimes[0], "locked")  # 1 Hz
        self.assertEqual(set(regimes[1:]), {"counter-rotating"})  # 11.8 Hz and more
        self.assertIn("<svg", content_of(self.path("sweep-frequency.svg"), "r")[:2000])
        self.assertEqual(len(content_of(self.path("sweep-frequency.csv"), "r").splitlines()), 13)
        self.assertIn("0 of them new", self.run_example("sweep-frequency.sh", 12))  # the same command again

    def test_frequency_and_kappa(self):
        self.run_example("sweep-frequency-kappa.sh", 4)
        self.assertEqual(self.query("sweep-frequency-kappa.db", "SELECT count(*) FROM rows"), [(16,)])
        self.is_png("sweep-frequency-kappa.png")
        self.is_png("sweep-frequency-kappa-radius.png")

    def test_refined(self):
        self.assertIn("of 81", self.run_example("sweep-refined.sh", 9, 1))
        self.assertIn("0 of them new", self.run_example("sweep-refined.sh", 9, 2))
        self.is_png("sweep-refined.png")

    def test_basins(self):
        """Half a turn apart, starts end on orbits that are each other's image: opposite <n_z>, equal <r>."""
        self.run_example("sweep-basins.sh", 5)  # Phi = 0, 90, 180, 270, 360 degrees
        self.is_png("sweep-basins.png")
        points = self.query("sweep-basins.db", "SELECT mean_nz, mean_r FROM rows ORDER BY point")
        self.assertEqual(len(points), 25)
        for ring in range(5):
            nz, r = zip(*points[5 * ring:5 * ring + 5])
            for i in (0, 1, 2):
                self.assertGreater(abs(nz[i]), 0.1)
                self.assertAlmostEqual(nz[i], -nz[i + 2], 6)
                self.assertAlmostEqual(r[i], r[i + 2], 6)

    def test_the_built_program_is_found(self):
        """With neither FESTOON nor a festoon on the PATH, an example uses build/festoon beside examples/."""
        for folder in ("examples", "build"):
            os.mkdir(self.path(folder))
        shutil.copy(os.path.join(EXAMPLES, "sweep-frequency.sh"), self.path("examples"))
        os.symlink(FESTOON, self.path("build/festoon"))
        environment = {key: value for key, value in os.environ.items() if key != "FESTOON"}
        environment["PATH"] = "/usr/bin:/bin"
        if shutil.which("festoon", path=environment["PATH"]):
            self.skipTest("a festoon is installed here")
        done = subprocess.run([self.path("examples/sweep-frequency.sh"), "2"], cwd=self.directory, env=environment,
                              stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE, timeout=1000)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn(b"all 2 points", done.stdout)


if __name__ == "__main__":
    if not shutil.which("gnuplot"):
        print("skipped: no gnuplot (gnuplot-nox)")
        sys.exit(77)
    unittest.main()
