#!/usr/bin/env python3
"""What a Hall probe on a stage would write over a stirrer's magnet: a map of its field, with the probe's noise.

    python3 measured-map.py > measured-map.csv

The magnet is a bar with round ends, 50 x 16 x 10 mm, magnetised along its length (0.9 T), which no part of
festoon describes: its poles are the two half cylinders at its ends.  Their surface charge is summed by Gauss's
rule; nothing here is festoon's.  The noise has a standard deviation of 0.02 mT, and the probe shows hundredths of
a millitesla.  The same seed makes the same map.
"""
import math
import random

LENGTH, WIDTH, THICKNESS, REMANENCE = 50.0, 16.0, 10.0, 900.0  # mm and mT
HEIGHT = 18.7  # of the probe over the magnet's mid-plane, mm
REACH, STEP = 60.0, 3.0  # of the stage, mm
NOISE, DIGITS = 0.02, 2  # mT


def gauss(count):
    """Places and weights of Gauss's rule on -1..1, by Newton's method on Legendre's polynomial."""
    rule = []
    for k in range(count):
        x = math.cos(math.pi * (k + 0.75) / (count + 0.5))
        for _ in range(50):
            before, at = 1.0, x
            for n in range(2, count + 1):
                before, at = at, ((2 * n - 1) * x * at - (n - 1) * before) / n
            slope = count * (x * at - before) / (x * x - 1)
            x -= at / slope
        rule.append((x, 2 / ((1 - x * x) * slope * slope)))
    return rule


def charges():
    """Points of the two round ends, each with the flux that leaves there over 4 pi, mT mm^2."""
    radius, points = WIDTH / 2, []
    for end in (1, -1):
        for u, weight_u in gauss(16):
            for w, weight_w in gauss(12):
                angle = u * math.pi / 2  # from the magnet's axis
                area = radius * math.pi / 2 * weight_u * THICKNESS / 2 * weight_w
                points.append((end * (LENGTH / 2 - radius + radius * math.cos(angle)), radius * math.sin(angle),
                               w * THICKNESS / 2, end * REMANENCE * math.cos(angle) * area / (4 * math.pi)))
    return points


def field(points, x, y, z):
    total = [0.0, 0.0, 0.0]
    for px, py, pz, charge in points:
        d = (x - px, y - py, z - pz)
        strength = charge / math.dist((x, y, z), (px, py, pz)) ** 3
        total = [sum_ + strength * part for sum_, part in zip(total, d)]
    return total


def main():
    points, chance = charges(), random.Random(20)
    count = round(2 * REACH / STEP) + 1
    print("x [mm],y [mm],z [mm],Bx [mT],By [mT],Bz [mT]")
    for row in range(count):
        for column in range(count):
            x, y = column * STEP - REACH, row * STEP - REACH
            shown = [f"{b + chance.gauss(0, NOISE):.{DIGITS}f}" for b in field(points, x, y, HEIGHT)]
            print(f"{x:g},{y:g},{HEIGHT:g},{','.join(shown)}")


if __name__ == "__main__":
    main()
