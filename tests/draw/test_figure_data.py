"""Figures of trajectories show the numbers of their file in the units of their axes, which the data and the script
beside the figure tell.

tests: draw/figure_path.c draw/view.c draw/figure_branch.c"""

import csv
import json
import math
import os
import re
import subprocess
import tempfile

FESTOON = os.environ["FESTOON"]
LENGTH = 23.0  # mm, the unit of length
SETTINGS = {"run.periods": 8, "run.discard": 3, "run.samples": 32, "magnet.width": "30 mm", "start.phi": 50}


def festoon(folder, *words):
    """Run the program in a folder."""
    done = subprocess.run([FESTOON, *words], cwd=folder, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr


def read_csv(path):
    """Columns of a trajectory by their names without units."""
    with open(path, encoding="utf-8") as file:
        rows = list(csv.reader(line for line in file if not line.startswith("#")))
    names = [name.split(" [")[0] for name in rows[0]]
    return {name: [float(row[i]) for row in rows[1:]] for i, name in enumerate(names)}


def read_blocks(path):
    """Blocks of numbers of a figure's data by name."""
    blocks, name, in_head = {}, None, False
    with open(path, encoding="utf-8") as file:
        for line in file:
            if line.startswith("# ") and not in_head:
                name, in_head = line[2:].strip(), True
                blocks[name] = []
            elif not line.startswith("#"):
                in_head = False
                if line.strip():
                    blocks[name].append([float(word) for word in line.split()])
    return blocks


def close(actual, expected, tolerance):
    """Equal within an absolute tolerance."""
    assert abs(actual - expected) <= tolerance, f"{actual} is not {expected}"


def figure(folder, *options):
    """A figure's script, its blocks, and the trajectory."""
    settings = [word for key, value in SETTINGS.items() for word in ("--set", f"{key}={value}")]
    festoon(folder, "run", *settings, "-o", "t.csv")
    festoon(folder, "plot", "t.csv", "-o", "f.svg", *options)
    with open(os.path.join(folder, "f.gp"), encoding="utf-8") as file:
        script = file.read()
    return script, read_blocks(os.path.join(folder, "f.dat")), read_csv(os.path.join(folder, "t.csv"))


def test_a_path_begins_after_the_discard():
    """The path begins with the first sample after the discard, in mm, and the magnet is drawn as it stood at that
    moment."""
    with tempfile.TemporaryDirectory() as folder:
        script, blocks, columns = figure(folder)
    first = next(i for i, turns in enumerate(columns["drive_turns"]) if turns > SETTINGS["run.discard"] - 1e-9)
    x, y, colour = blocks["path"][0]
    close(x, LENGTH * columns["x"][first], 1e-3)
    close(y, LENGTH * columns["y"][first], 1e-3)
    close(colour, columns["n_z"][first], 1e-5)
    turned = columns["alpha"][first] - columns["Phi"][first]
    along, across = LENGTH, 15.0
    for corner, (sign, other) in zip(blocks["magnet"], ((-1, -1), (1, -1), (1, 1), (-1, 1), (-1, -1))):
        close(corner[0], sign * along * math.cos(turned) - other * across * math.sin(turned), 1e-3)
        close(corner[1], sign * along * math.sin(turned) + other * across * math.cos(turned), 1e-3)
    reach = max(abs(value) for row in blocks["path"] for value in row[:2])
    low, high = map(float, re.search(r"set xrange \[(\S+):(\S+)\]", script).groups())
    assert low <= -reach and high >= reach, (low, high, reach)
    title = re.search(r"set label 'ω = (\S+) \((\S+) Hz\)", script)
    close(float(title.group(1)), columns["omega"][0], 1e-4)
    close(float(title.group(2)), 10.7, 1e-3)


def test_a_run_that_has_settled_is_shown_settled():
    """It ended before its discard; shown is its end, not how it began."""
    with tempfile.TemporaryDirectory() as folder:
        festoon(folder, "run", "--set", "run.until=settled", "-o", "t.csv")
        festoon(folder, "plot", "t.csv", "-o", "f.svg")
        blocks, columns = read_blocks(os.path.join(folder, "f.dat")), read_csv(os.path.join(folder, "t.csv"))
    end = columns["drive_turns"][-1]
    assert end < 40
    first = next(i for i, turns in enumerate(columns["drive_turns"]) if turns >= math.floor(end - 5.5) - 1e-9)
    close(blocks["path"][0][0], LENGTH * columns["x"][first], 1e-3)
    close(blocks["path"][0][1], LENGTH * columns["y"][first], 1e-3)


def test_between_samples_the_path_goes_on():
    """Every sample of the range lies on the path."""
    with tempfile.TemporaryDirectory() as folder:
        _, blocks, columns = figure(folder, "--from", "4", "--to", "5")
    shown = [i for i, turns in enumerate(columns["drive_turns"]) if 4 - 1e-9 <= turns <= 5 + 1e-9]
    for i in shown[:-1]:
        nearest = min(math.hypot(x - LENGTH * columns["x"][i], y - LENGTH * columns["y"][i])
                      for x, y, _ in blocks["path"])
        assert nearest < 1e-3, (i, nearest)
    steps = [math.dist(a[:2], b[:2]) for a, b in zip(blocks["path"], blocks["path"][1:])]
    assert max(steps) < 3 * sorted(steps)[len(steps) // 2], "the path jumps"


def test_colours_cover_the_range_shown():
    """The range of colours covers every value, and begins at zero if the values come near it."""
    for column in ("slip", "angle", "B", "n_alpha"):
        with tempfile.TemporaryDirectory() as folder:
            script, blocks, _ = figure(folder, "--quantity", column)
        values = [row[2] for row in blocks["path"]]
        low, high = map(float, re.search(r"set cbrange \[(\S+):(\S+)\]", script).groups())
        assert low <= min(values) + 1e-6 and high >= max(values) - 1e-6, (column, low, high, min(values), max(values))
        span = max(values) - min(values)
        if min(values) < 0 < max(values):
            close(low, -high, 1e-9)
        elif 0 <= min(values) < 0.2 * max(values):
            close(low, 0.0, 0.0)
        else:
            assert high - low < 2 * span, (column, low, high, span)


def test_dots_of_runs_over_a_branch():
    """A run's dot is drawn at its own drive, in the branch's parameter, and on the branch."""
    for key, of_run in (("drive.omega", "omega"), ("drive.frequency", "frequency_hz")):
        with tempfile.TemporaryDirectory() as folder:
            low, high = (0.345, 0.355) if key == "drive.omega" else (17.2, 17.6)
            festoon(folder, "branch", "--kind", "counter", "--over", f"{key}={low}:{high}", "-o", "b.json")
            done = subprocess.run([FESTOON, "run", "--set", f"{key}={(low + high) / 2}", "--set", "run.periods=60",
                                   "--json"], cwd=folder, capture_output=True, text=True, check=True)
            with open(os.path.join(folder, "runs.json"), "w", encoding="utf-8") as file:
                file.write(done.stdout)
            festoon(folder, "plot", "b.json", "--runs", "runs.json", "-o", "f.svg")
            blocks = read_blocks(os.path.join(folder, "f.dat"))
        run = json.loads(done.stdout)
        (dot,) = [rows for name, rows in blocks.items() if len(rows) == 1 and not math.isnan(rows[0][0])]
        close(dot[0][0], run[of_run], 1e-6)
        # Over a frequency the branch is shown in units of the laboratory.
        close(dot[0][1], run["mean_r"] * (LENGTH if key == "drive.frequency" else 1.0), 1e-6)


for name, test in list(globals().items()):
    if name.startswith("test_"):
        test()
        print("ok", name)
