"""docs/experiment.md: its commands, as they stand there, lead from films to the parameters that made them.

Without ffmpeg, gnuplot or HDF5 the test is skipped.

labels: long"""

import json
import os
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import films
from films import FESTOON, run

COMPONENTS = run("--version").stdout
if not films.can_film() or "gnuplot yes" not in COMPONENTS or "hdf5 yes" not in COMPONENTS:
    sys.exit(77)

PAGE = (Path(os.environ["SOURCE_DIR"]) / "docs" / "experiment.md").read_text(encoding="utf-8")


class Experiment(unittest.TestCase):
    def test_the_commands_of_the_page(self):
        blocks = re.findall(r"```sh\n(.*?)```", PAGE, re.S)
        self.assertEqual(len(blocks), 2)
        self.assertEqual(len(blocks[1].strip().splitlines()), 6)
        with tempfile.TemporaryDirectory() as folder:
            (Path(folder) / "bin").mkdir()
            (Path(folder) / "bin" / "festoon").symlink_to(FESTOON)
            path = f"{folder}/bin:{os.environ['PATH']}"
            for block in blocks:
                done = subprocess.run(["sh", "-e", "-c", block], cwd=folder, env={**os.environ, "PATH": path},
                                      capture_output=True, text=True, check=False)
                self.assertEqual(done.returncode, 0, done.stderr)
            for name in ("check.png", "fit.png", "path.png"):
                self.assertEqual((Path(folder) / name).read_bytes()[:4], b"\x89PNG", name)
            for film in ("10.7", "13", "16"):
                found = films.compare(Path(folder) / f"{film}.csv", Path(folder) / f"{film}.truth.csv")
                self.assertEqual(found["lost"], 0)
                self.assertLess(found["rms"], 0.1)
                self.assertAlmostEqual(found["ratio"], 1.0, delta=0.003)
            done = run("fit", "points.csv", "lab.yaml", "--free", "model.kappa,friction.gamma", "--json", cwd=folder)
            self.assertEqual(done.returncode, 0, done.stderr)
            fit = {p["key"]: p for p in json.loads(done.stdout)["parameters"]}
            for key, truth in (("model.kappa", 1.5), ("friction.gamma", 312.5)):
                self.assertLess(abs(fit[key]["value"] - truth), 3.0 * fit[key]["error"], key)
                self.assertLess(fit[key]["error"], 0.03 * truth, key)


if __name__ == "__main__":
    unittest.main()
