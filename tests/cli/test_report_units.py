"""The numbers that `festoon run` prints for people are those of --json, in the units beside them.

tests: cli/run_report.c cli/groups.c io/shown.c
labels: numbers"""

import json
import math
import os
import re
import subprocess

FESTOON = os.environ["FESTOON"]
REAL = {"bead.moment": "0.06", "magnet.b0": "2.5 mT", "run.periods": "40"}


def run(*more):
    """Standard output of a short run of a bead with SI strengths."""
    settings = [word for key, value in REAL.items() for word in ("--set", f"{key}={value}")]
    done = subprocess.run([FESTOON, "run", *settings, *more], capture_output=True, text=True, check=True)
    return done.stdout


def number(text, name, unit):
    """The number before `unit` on the line that begins with `name`."""
    (line,) = [line for line in text.splitlines() if line.strip().startswith(name + "  ")]
    found = re.search(r"(\S+) " + re.escape(unit) + "$", line)
    assert found, f"{line!r} does not end in {unit}"
    return float(found.group(1))


def close(actual, expected):
    """Equal to all printed digits."""
    assert math.isclose(actual, expected, rel_tol=1e-4), f"{actual} is not {expected}"


def test_numbers_in_laboratory_units():
    """Lengths, rates, times, fields, speeds and powers, each from its scaled value and SI parameters."""
    result, text = json.loads(run("--json")), run()
    scene = result["scene"]
    length, rate, mass = scene["magnet.half_length"], scene["friction.gamma"], scene["bead.mass"]
    hertz = rate / (2 * math.pi)
    close(number(text, "drive omega", "Hz"), result["omega"] * hertz)
    close(number(text, "distance from the axis <r>", "mm"), 1e3 * length * result["mean_r"])
    close(number(text, "its variation delta r", "mm"), 1e3 * length * result["std_r"])
    close(number(text, "bead's circling <alpha'>", "Hz"), result["mean_alpha_dot"] * hertz)
    close(number(text, "moment's turning <phi'>", "Hz"), result["mean_phi_dot"] * hertz)
    close(number(text, "one whole turn of Phi", "s"), result["period"] / rate)
    close(number(text, "field <|B|>", "mT"), 1e3 * scene["magnet.b0"] * result["mean_b"])
    close(number(text, "slip of the contact, rms", "mm/s"), 1e3 * length * rate * result["rms_slip"])
    power = 1e3 * mass * length**2 * rate**3
    close(number(text, "power lost to friction", "mW"), power * result["mean_friction_power"])
    close(number(text, "power of the drive", "mW"), power * result["mean_drive_power"])


def test_groups():
    """The scaled groups, and the drive and the weight beside them."""
    result, text = json.loads(run("--json")), run()
    groups = result["groups"]
    found = re.search(r"drive (\S+) Hz  weight g = (\S+) l gamma\^2  plate (\S+) l", text)
    close(float(found.group(1)), groups["omega"] / groups["time_unit_s"] / (2 * math.pi))
    close(float(found.group(2)), groups["gravity"])
    close(float(found.group(3)), groups["plate_radius"])
    units = re.search(r"l = (\S+) mm  1/gamma = (\S+) ms  mass (\S+) g  B0 = (\S+) mT", text)
    for shown, name in zip(units.groups(), ("length_unit_m", "time_unit_s", "mass_kg", "field_unit_t")):
        close(float(shown), 1e3 * groups[name])


def test_where_a_bead_left():
    """The sentence on an ejected bead: turns, seconds, millimetres, degrees."""
    more = ("--set", "plate.radius=0.021", "--set", "start.r=0.9")
    result, text = json.loads(run("--json", *more)), run(*more)
    assert result["regime"] == "ejected", result["regime"]
    found = re.search(r"after (\S+) turns of the magnet \((\S+) s\), (\S+) mm from the axis, at Phi = (\S+) degrees",
                      text)
    x, y = result["final_state"][:2]
    expected = (result["periods"], result["end_time"] / result["scene"]["friction.gamma"],
                1e3 * result["scene"]["magnet.half_length"] * math.hypot(x, y), math.degrees(math.atan2(y, x)))
    for shown, value in zip(found.groups(), expected):
        assert math.isclose(float(shown), value, rel_tol=1e-3), (shown, value)


def test_the_time_in_which_chaos_parts_beads():
    """The time in seconds is the inverse of the exponent."""
    more = ("--set", "drive.omega=0.4", "--set", "friction.law=none", "--set", "start.r=1.1", "--set", "run.periods=500",
            "--set", "run.discard=100", "--set", "bead.moment=0", "--set", "model.kappa=1.5")
    result = json.loads(run("--json", *more))
    if result["regime"] != "chaotic":
        raise AssertionError(f"this bead was chosen because it is chaotic, but it is {result['regime']}")
    found = re.search(r"part e-fold in (\S+) s", run(*more))
    expected = 1.0 / (result["largest_exponent"] * result["scene"]["friction.gamma"])
    assert math.isclose(float(found.group(1)), expected, rel_tol=1e-2), (found.group(1), expected)


for name, test in list(globals().items()):
    if name.startswith("test_"):
        test()
        print("ok", name)
