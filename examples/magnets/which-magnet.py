#!/usr/bin/env python3
"""Which magnet of the stirrer's outline, 56 x 40 x 9 mm, has the maxima of its field 41 mm apart?

    python3 examples/magnets/which-magnet.py              # all variants, some minutes
    python3 examples/magnets/which-magnet.py --field bar  # the field of one

For each variant: the distance of the maxima of |B| on its long axis at the height of the bead's centre and on the
plate; how the field at its middle compares with the greatest; the remanence that gives the greatest field of the
paper's five lines (31.7 mT at kappa = 1.5 and a bead of 1.2 T); and, by runs with the paper's viscous friction, the
remanence with which the bead draws four festoons at 10.7 Hz, with what follows from it.  The program is the one in
the environment variable FESTOON, or `festoon`.
"""
import argparse
import json
import math
import os
import subprocess
import tempfile

FESTOON = os.environ.get("FESTOON", "festoon")
GREATEST = 31.74e-3  # T
DEPTH, CENTRE = 16.2, 18.7  # of the mid-plane below plate and bead's centre, mm


def block(x, length, along, up, z=0.0, thickness=9.0, width=40.0):
    """A block with its middle at (x, 0, z): edges in mm, direction of its remanence."""
    return {"centre": (x, 0, z), "size": (length, width, thickness), "direction": (along, 0, up)}


def pair(gap, along, up, z=0.0, thickness=9.0):
    """Two blocks with a gap, mirror images whose poles face up and down."""
    length = (56.0 - gap) / 2
    return [block((gap + length) / 2, length, along, up, z, thickness),
            block(-(gap + length) / 2, length, along, -up, z, thickness)]


def fading(power, steps=15):
    """A remanence that falls to the ends as 1 - |x/28 mm|^power, in blocks."""
    edges = [56.0 * i / steps - 28.0 for i in range(steps + 1)]
    return [block((a + b) / 2, b - a, 1 - abs((a + b) / 56.0) ** power, 0) for a, b in zip(edges, edges[1:])]


def oblique(degrees):
    angle = math.radians(degrees)
    return pair(0.0, math.cos(angle), math.sin(angle))


VARIANTS = {
    "bar": ("one block, along its length", [block(0, 56.0, 1, 0)]),
    "short": ("its middle 45 mm alone", [block(0, 45.0, 1, 0)]),
    "wide": ("45 x 49 mm, wider than the outline", [block(0, 45.0, 1, 0, width=49.0)]),
    "fading": ("remanence that falls to the ends, 1 - (x/28 mm)^4", fading(4)),
    "across": ("one block, along its width", [block(0, 40.0, 1, 0, width=56.0)]),
    "upright": ("two blocks, up and down, gap 30 mm", pair(30.0, 0, 1)),
    "upright-0": ("two blocks, up and down, no gap", pair(0.0, 0, 1)),
    "yoke": ("two blocks, up and down, gap 31 mm, on iron", pair(31.0, 0, 1, -4.5, 18.0)),
    "bar-yoke": ("one block along its length, iron 1 mm below it",
                 [block(0, 56.0, 1, 0), block(0, 56.0, -1, 0, z=-11.0)]),
    "oblique": ("two halves, tilted by 27 degrees towards the bead", oblique(27.0)),
    "gap": ("two blocks along the length, gap 12 mm", pair(12.0, 1, 0)),
}


def scene(parts, remanence, folder):
    """A scene file with these parts."""
    path = os.path.join(folder, "magnet.yaml")
    with open(path, "w", encoding="utf-8") as out:
        out.write("bead:\n  radius: 2.5 mm\n  mass: 0.5 g\n  remanence: 1.2 T\nmagnet:\n  shape: parts\n"
                  f"  depth: {DEPTH} mm\n  parts:\n")
        for part in parts:
            out.write("    - kind: cuboid\n      centre: [" + ", ".join(f"{c} mm" for c in part["centre"]) + "]\n"
                      "      size: [" + ", ".join(f"{c} mm" for c in part["size"]) + "]\n"
                      "      remanence: [" + ", ".join(f"{remanence * c:.12g} T" for c in part["direction"]) + "]\n")
    return path


def festoon(*arguments):
    done = subprocess.run([FESTOON, *arguments, "--json"], capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise SystemExit(done.stderr)
    return json.loads(done.stdout)


def strength(path, x, height):
    """|B| in T at the place x (mm) on the long axis, at a height over the mid-plane."""
    place = ("--at", f"{x:.6f}mm,0mm", "--height", f"{height}mm")
    return math.hypot(*festoon("field", path, *place, "--units", "si")["b_tesla"])


def greatest(parts, height, folder):
    """Place (mm) and size (T, at a remanence of 1 T) of the greatest |B| on the long axis, and |B| at the middle."""
    path = scene(parts, 1.0, folder)
    size = {x: strength(path, x, height) for x in range(0, 42, 3)}
    best = max(size, key=size.get)
    low, high = max(best - 3.0, 0.0), best + 3.0
    while high - low > 0.02:
        left, right = low + (high - low) / 3, high - (high - low) / 3
        if strength(path, left, height) < strength(path, right, height):
            low = left
        else:
            high = right
    place = (low + high) / 2
    return place, strength(path, place, height), size[0]


def run(parts, remanence, hertz, folder):
    return festoon("run", scene(parts, remanence, folder), "--set", f"drive.frequency={hertz} Hz", "--set",
                   "run.rtol=1e-7", "--set", "run.periods=200", "--set", "run.discard=120")


def circles(result):
    return result["festoons"] if result["regime"] == "counter-rotating" else None


def waves(result):
    """Festoons as an S1 pattern counts them, half of those of S2; None: the bead does not circle against the magnet."""
    speed = result["mean_alpha_dot"]
    return 1 - result["omega"] / speed if speed and speed < 0 else None


def four_festoons(parts, folder):
    """The least remanence at which the number of festoons at 10.7 Hz falls through 4; None: there is none."""
    def count_at(remanence):
        return waves(run(parts, remanence, 10.7, folder))

    below = None
    for remanence in (0.2 * 1.2 ** i for i in range(12)):
        count, high = count_at(remanence), remanence
        while below and count and count < 4 and high / below > 1.003:
            middle = math.sqrt(below * high)
            more = count_at(middle)
            if more is None:
                break
            below, high = (middle, high) if more > 4 else (below, middle)
        if below and high / below <= 1.003 and abs(count_at(high) - 4) < 0.05:
            return high
        below = remanence if count and count > 4 else None
    return None


def describe(name, only_field, folder):
    words, parts = VARIANTS[name]
    place, size, middle = greatest(parts, CENTRE, folder)
    plate = greatest(parts, DEPTH, folder)[0]
    print(f"{name}: {words}\n  maxima {2 * place:.1f} mm apart ({2 * plate:.1f} mm on the plate); middle "
          f"{100 * middle / size:.0f} % of the greatest; {GREATEST / size:.3f} T gives the greatest field of the lines",
          flush=True)
    if only_field:
        return
    remanence = four_festoons(parts, folder)
    if remanence is None:
        print("  no remanence from 0.2 to 1.5 T gives 4 festoons at 10.7 Hz", flush=True)
        return
    at = {hertz: run(parts, remanence, hertz, folder) for hertz in (10.7, 16.0, 19.9)}
    shown = ", ".join(f"{hertz} Hz {circles(r):.2f} ({r['symmetry']})" if circles(r) else f"{hertz} Hz {r['regime']}"
                      for hertz, r in at.items())
    spread = 100 * at[10.7]["std_b"] / at[10.7]["mean_b"]
    print(f"  4 festoons at 10.7 Hz with {remanence:.3f} T: |B| spreads by {spread:.1f} %; festoons {shown}",
          flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--field", action="store_true", help="no runs")
    parser.add_argument("variants", nargs="*", metavar="VARIANT", help="of " + ", ".join(VARIANTS))
    options = parser.parse_args()
    for name in options.variants:
        if name not in VARIANTS:
            parser.error(f"there is no variant {name}: it is one of {', '.join(VARIANTS)}")
    with tempfile.TemporaryDirectory() as folder:
        for name in options.variants or VARIANTS:
            describe(name, options.field, folder)


if __name__ == "__main__":
    main()
