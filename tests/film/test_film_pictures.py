"""Colours in frames of a film: the magnet's north half and the bead's north pole are orange and lie where the
trajectory has them; the south ones are blue.

tests: film/cairo_module.c film/film.c"""

import math
import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

from pictures import read_png, rows_of

FESTOON = os.environ["FESTOON"]
SIZE, LENGTH, WIDTH, RADIUS = 240, 23.0, 40.0, 2.5  # pixels; mm
ORANGE, BLUE = (213, 94, 0), (0, 114, 178)


def festoon(*words):
    """Run the program."""
    done = subprocess.run([FESTOON, *map(str, words)], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    return done.stdout


if "cairo yes" not in festoon("--version"):
    sys.exit(77)


def distance(a, b):
    """The distance between two colours."""
    return math.dist(a, b)


class Pictures(unittest.TestCase):
    def test_north_is_orange(self):
        """Checked in three frames of each turn."""
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            festoon("run", "--set", "run.periods=3", "--set", "run.discard=1", "--csv", folder / "t.csv")
            rows = rows_of(folder / "t.csv")
            festoon("movie", folder / "t.csv", "-o", folder / "frames", "--from", "0", "--to", "2", "--fps", "3",
                    "--turn", "1", "--size", f"{SIZE}x{SIZE}")
            shown = [row for row in rows if row["drive_turns"] <= 2 + 1e-9]
            reach = max(1.25 * max(max(abs(r["x"]), abs(r["y"])) for r in shown), 1.35) * LENGTH
            reach = max(reach, 1.05 * math.hypot(28 / 23 * LENGTH, WIDTH / 2))  # room for the bar as it turns
            scale = 0.84 * SIZE / 2 / reach  # pixels a millimetre
            poles = 0
            for i in range(0, 7):
                row = min(rows, key=lambda r, turns=i / 3: abs(r["drive_turns"] - turns))
                pixels = read_png(folder / "frames" / f"frame-{i + 1:05}.png")[2]

                def at(x, y, pixels=pixels):
                    return pixels[round(SIZE / 2 - scale * y)][round(SIZE / 2 + scale * x)]

                warm = {1: 0, -1: 0}
                angle = 2 * math.pi * i / 3
                for side in (1, -1):
                    for along in range(6, 21, 2):
                        for across in (-15, -12, -9, 9, 12, 15):
                            red, _, blue = at(side * along * math.cos(angle) - across * math.sin(angle),
                                              side * along * math.sin(angle) + across * math.cos(angle))
                            warm[side] += (red > blue) - (red < blue)
                self.assertGreater(warm[1], 15, f"frame {i}: the north half is not orange")
                self.assertLess(warm[-1], -15, f"frame {i}: the south half is not blue")
                if abs(row["n_z"]) > 0.35:
                    sign = 1 if row["n_z"] > 0 else -1
                    x, y = (LENGTH * row[k] + sign * RADIUS * row["n_" + k] for k in "xy")
                    colour = at(x, y)
                    near, far = (ORANGE, BLUE) if sign > 0 else (BLUE, ORANGE)
                    self.assertLess(distance(colour, near), distance(colour, far), f"frame {i}: {colour}")
                    poles += 1
            self.assertGreater(poles, 1)


if __name__ == "__main__":
    unittest.main()
