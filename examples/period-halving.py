#!/usr/bin/env python3
"""Critical exponents of the period halving, from festoon branch and from a transient that festoon run follows.

<n_z>, the paper's p and the relaxation time are fitted to powers of the distance in omega.  p = D+/D- - 1, where one
swing of r grows as much as the other shrinks: p/(p + 2) is linear in the asymmetry, p itself only close to the point.
"""
import csv
import json
import math
import os
import subprocess
import tempfile

FESTOON = os.environ.get("FESTOON", "festoon")


def festoon(*words):
    return subprocess.run([FESTOON, *words], check=True, capture_output=True, text=True).stdout


def line(x, y):
    """Slope of the straight line through the points."""
    mean_x, mean_y = sum(x) / len(x), sum(y) / len(y)
    return (sum((a - mean_x) * (b - mean_y) for a, b in zip(x, y)) / sum((a - mean_x) ** 2 for a in x))


def exponent(distances, values):
    return line([math.log(d) for d in distances], [math.log(abs(v)) for v in values])


def along_the_branches():
    branch = json.loads(festoon("branch", "--kind", "counter", "--set", "drive.omega=0.269",
                                "--over", "drive.omega=0.2684:0.2693", "--step", "0.01", "--json"))
    point = next(s for s in branch["specials"] if s["type"] == "pitchfork")
    print(f"period halving at omega = {point['value']:.12g}, {point['criticality']}")
    below = [p for p in branch["points"] if p["branch"] == point["born"]]
    above = [p for p in branch["points"] if p["branch"] == point["branch"] and p["value"] > point["value"]]
    distances = [point["value"] - p["value"] for p in below]
    print(f"exponent of <n_z> {exponent(distances, [p['mean_nz'] for p in below]):.4f}")
    p = [one["swing_ratio"] for one in below]
    print(f"exponent of p {exponent(distances, p):.4f}, of p/(p + 2) {exponent(distances, [q / (q + 2) for q in p]):.4f}")
    for name, points in (("below", below), ("above", above)):
        distances = [abs(one["value"] - point["value"]) for one in points]
        times = [one["relaxation_time"] for one in points]
        amplitude = sum(t * d for t, d in zip(times, distances)) / len(times)
        print(f"exponent of the relaxation time {name} {exponent(distances, times):.4f}, time times distance"
              f" {amplitude:.4f}")


def by_a_transient(omega):
    """n_z(t) + n_z(t + T/2) vanishes on the symmetric orbit; once in each turn it tells how far off the bead is."""
    orbit = json.loads(festoon("orbit", "--set", f"drive.omega={omega}", "--json"))
    with tempfile.TemporaryDirectory() as directory:
        path = os.path.join(directory, "run.csv")
        festoon("run", "--set", f"drive.omega={omega}", "--set", "run.periods=200", "--set", "run.discard=1",
                "--set", "run.samples=128", "--csv", path)
        with open(path, encoding="utf-8") as text:
            rows = list(csv.DictReader(row for row in text if not row.startswith("#")))
    time = [float(row["t [1/gamma]"]) for row in rows]
    nz = [float(row["nZ [1]"]) for row in rows]

    def at(t):
        i = min(int((t - time[0]) / (time[1] - time[0])), len(time) - 2)
        x = (t - time[i]) / (time[i + 1] - time[i])
        return nz[i] + x * (nz[i + 1] - nz[i])

    turns = range(int(time[-1] / orbit["period"]) - 1)
    seen = [(k * orbit["period"], abs(at(k * orbit["period"]) + at((k + 0.5) * orbit["period"]))) for k in turns]
    small = [(t, a) for t, a in seen if 1e-3 < a < 2e-2]  # neither far from the orbit nor lost between the samples
    fitted = -1.0 / line([t for t, a in small], [math.log(a) for t, a in small])
    print(f"relaxation time at omega = {omega} by a transient {fitted:.5g}, by the multiplier"
          f" {orbit['relaxation_time']:.5g}")


def main():
    along_the_branches()
    for omega in (0.275, 0.285):
        by_a_transient(omega)


if __name__ == "__main__":
    main()
