"""The numbers that `festoon run` prints for people are those of --json, in the units beside them.

tests: cli/orbit.c cli/beads_orbits.c io/orbit_json.c io/beads_orbit_json.c io/json_si.c cli/run_report.c cli/run_world.c cli/beads_report.c cli/groups.c io/shown.c io/beads_file.c sweep/export_keys.c
labels: numbers"""

import json
import math
import os
import pathlib
import re
import subprocess
import tempfile

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
    found = re.search(r"(\S+) +" + re.escape(unit) + "$", line)
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


SOURCE = pathlib.Path(os.environ["SOURCE_DIR"])
SCENES = sorted(SOURCE.glob("examples/worlds/*.yaml")) + sorted(SOURCE.glob("examples/beads/*.yaml"))
#: What a unit of the laboratory is in SI, and what a scaled one is, of the length, the rate and the mass of a scene.
LAB = {"1": 1, "turn": 1, "mm": 1e-3, "s": 1, "mm/s": 1e-3, "Hz": 2 * math.pi, "uJ": 1e-6, "mN": 1e-3, "mW": 1e-3, "weights": 1, "": 1}
SI = {**{unit: 1 for unit in ("1", "turn", "m", "s", "m/s", "rad/s", "N", "J", "W", "weights", "")}}


def scaled_units(scene):
    bead = {**scene, **(scene["beads"][0] if scene.get("beads") else {})}
    length, rate, mass = scene["magnet.half_length"], scene["friction.gamma"], bead["bead.mass"]
    if mass is None:
        mass = bead["bead.density"] * 4 / 3 * math.pi * bead["bead.radius"] ** 3
    return {"1": 1, "turn": 1, "weights": 1, "": 1, "l": length, "1/gamma": 1 / rate, "gamma": rate, "l gamma": length * rate,
            "l gamma^2": mass * length * rate**2, "l^2 gamma^2": mass * length**2 * rate**2,
            "l^2 gamma^3": mass * length**2 * rate**3}


def same_in_si(numbers, units):
    """Numbers of three systems of units, [(value, unit)] each, are the same in SI, and no system is the other."""
    lab, si, scaled = ([value * known[unit] for value, unit in given] for given, known in zip(numbers, units, strict=True))
    assert len(lab) == len(si) == len(scaled) > 0
    for values in zip(lab, si, scaled):
        assert all(map(math.isnan, values)) or max(values) - min(values) <= 2e-5 * max(map(abs, values)), values


def test_worlds_and_several_beads_in_all_units():
    """Every column of their tables and every number of their reports: a value times its unit is the same, whether it is
    one of the laboratory, of SI or a scaled one."""
    with tempfile.TemporaryDirectory() as folder:
        table, rows = os.path.join(folder, "t.csv"), "(?m)^(?!#)(.+)$"
        for scene in SCENES:
            texts, cells, fields, reports = [], [], [], []
            for words in ("lab", "si", "scaled"):
                run_it = [FESTOON, "run", scene, "--set", "run.periods=2", "--set", "run.discard=1", "--units", words]
                texts.append(subprocess.run([*run_it, "--csv", table], capture_output=True, text=True, check=True).stdout)
                head, *lines = re.findall(rows, pathlib.Path(table).read_text())
                fields.append(re.findall(r"(\w+) \[(.*?)\]", head))
                cells.append([float(cell) for cell in lines[len(lines) // 2].split(",")])
                # A line of a report ends in numbers and their unit; tables have their units above the numbers.
                found = re.findall(r"^  (?:[a-z<'].*?)  +((?:-?[\d.e+-]+ +)*-?[\d.e+-]+)  ?([a-zA-Z/^ 0-9]*)$", texts[-1], re.M)
                powers = [line for line in texts[-1].splitlines() if line.startswith("  power ")]
                assert powers and all(re.fullmatch(r"  power .*[a-z]  +[\d.e+-]+ +[a-zA-Z].*", line) for line in powers), "one number each"
                reports.append([(float(number.split()[-1]), unit.strip()) for number, unit in found])
            result = json.loads(subprocess.run([*run_it, "--json"], capture_output=True, text=True, check=True).stdout)
            told = result["scene"]
            if scene.parent.name == "worlds":
                close(number(texts[-1], "mean distance from the axis", "l"), result["mean_r"])
                close(number(texts[-1], "power of the drive", "l^2 gamma^3"), result["mean_drive_power"])
            units = (LAB, SI, scaled_units(told))
            assert [name for name, _ in fields[0]] == [name for name, _ in fields[1]] == [name for name, _ in fields[2]]
            same_in_si([[(value, unit) for value, (_, unit) in zip(row, units_of, strict=True)]
                        for row, units_of in zip(cells, fields)], units)
            for name in ("WX_0", "WZ_0"):
                assert [dict(found)[name] for found in fields] == ["Hz", "rad/s", "gamma"], name
            for one, other in ((0, 1), (0, 2), (1, 2)):
                assert texts[one] != texts[other], (scene, "the report has the same units")
            same_in_si(reports, units)


def stands_in(few, many):
    """Whether a document has all that another one has, with the same values."""
    if isinstance(few, dict):
        return all(stands_in(value, many[key]) for key, value in few.items())
    return all(map(stands_in, few, many)) if isinstance(few, list) else few == many


def states_in_si(document, key):
    """The states of a document, or of its beads, are those beside them in m, m/s and rad/s."""
    scene = scaled_units(document["scene"])
    for bead in document.get("beads", [document]):
        axes = (len(bead[key]) - 6) // 2
        factors = [scene["l"]] * axes + [scene["l gamma"]] * axes + [1] * 3 + [scene["gamma"]] * 3
        for value, scaled, factor in zip(bead[key + "_si"], bead[key], factors, strict=True):
            assert math.isclose(value, scaled * factor, rel_tol=1e-12), (key, value, scaled)


def test_json_in_the_units_of_a_laboratory():
    """It has the numbers in SI beside the scaled ones, as --help says: no key changes its meaning with --units."""
    for scene in ([], [SOURCE / "examples/beads/bar.yaml"], [SOURCE / "examples/worlds/bowl.yaml"]):
        given, lab, si = (json.loads(run(*scene, "--set", "run.periods=2", "--set", "run.discard=1", "--json", "--units", units))
                          for units in ("given", "lab", "si"))
        assert lab == si and stands_in(given, lab) and lab != given, scene
        states_in_si(si, "final_state")
        if scene and "beads" in si:
            close(si["energy_residual_joules"], si["energy_residual"] * scaled_units(si["scene"])["l^2 gamma^2"])
    for command in ("run", "orbit", "critical", "field", "locked", "branch"):
        told = " ".join(subprocess.run([FESTOON, command, "--help"], capture_output=True, text=True, check=True).stdout.split())
        assert "to --json lab and si both add the numbers in SI, beside the scaled ones" in told, command


def test_orbits_in_all_units():
    """A report says the same in each of its units, and the SI keys of --json are the scaled ones in SI."""
    ask = lambda *words: subprocess.run([FESTOON, *words], capture_output=True, text=True, check=True).stdout
    swung = ("--set", "drive.waveform=oscillating", "--set", "drive.amplitude=20 deg", "--set", "drive.frequency=30",
             "--set", "start.spin=rest", "--set", "start.phi=5")
    for words in (("orbit",), ("orbit", SOURCE / "examples/beads/opposite.yaml"), ("orbit", *swung)):
        told = {units: json.loads(ask(*words, "--json", "--units", units)) for units in ("given", "si")}
        scene = scaled_units(told["si"]["scene"])
        assert stands_in(told["given"], told["si"]), "a key lost its meaning"
        report = r"^ +(?:bead 1: )?([a-z<][a-z<>,_' ]*?)  +([-\d.e+]+)(?:, [-\d.e+]+)*(?: (\S.*))?$"
        texts = [ask(*words, "--units", units) for units in ("lab", "si", "given")]
        found = [[(float(value), unit) for _, value, unit in re.findall(report, text, re.M) if unit != "degrees"] for text in texts]
        same_in_si(found, (LAB, SI, scene))
        assert len(set(texts)) == 3
        close(told["si"]["period_s"], told["si"]["period"] * scene["1/gamma"])
        states_in_si(told["si"], "state")


#: How a key in SI ends, and the scaled unit of the one that it stands beside.
ENDINGS = {"_m": "l", "_s": "1/gamma", "_per_s": "gamma", "_m_per_s": "l gamma", "_newtons": "l gamma^2", "_watts": "l^2 gamma^3"}


def keys_in_si(document, scene):
    """How many numbers of a document stand in SI beside the scaled ones; each is that number, by its scene and parameter."""
    if isinstance(document, list):
        return sum(keys_in_si(one, scene) for one in document)
    if not isinstance(document, dict):
        return 0
    if document.get("parameter", scene.get("over")):
        over = document.get("parameter", scene.get("over"))
        scene = {**scene, "over": over, **({over: document["value"]} if "value" in document else {})}
    factors, found = scaled_units(scene), 0
    for key, value in document.items():
        for ending, unit in ENDINGS.items():
            if key.endswith(ending) and key[:-len(ending)] in document and value is not None:
                pairs = [(value, document[key[:-len(ending)]])]
                while isinstance(pairs[0][0], list):
                    pairs = [pair for one in pairs for pair in zip(*one, strict=True)]
                assert all(math.isclose(si, factors[unit] * scaled, rel_tol=1e-12) for si, scaled in pairs), key
                found += 1
        found += keys_in_si(value, scene) if key != "scene" else 0
    return found


def test_locked_states_and_branches_in_all_units():
    """--json has SI beside what is scaled, and in the reports each number times its unit is the same."""
    ask = lambda *words: subprocess.run([FESTOON, *words], capture_output=True, text=True, check=True).stdout
    bar, dry = SOURCE / "examples/beads/bar.yaml", ("--set", "friction.law=coulomb")
    for words, least in ((("locked",), 15), (("locked", *dry), 7), (("locked", bar), 6), (("branch", "--kind", "counter", "--over", "drive.frequency=13:14"), 20),
                         (("branch", "--kind", "locked", "--over", "friction.gamma=312:313"), 20)):
        given, si = (json.loads(ask(*words, "--json", "--units", units)) for units in ("given", "si"))
        assert stands_in(given, si), words
        assert keys_in_si(si, si["scene"]) >= least, (words, keys_in_si(si, si["scene"]))
        texts, found, scene = [ask(*words, "--units", units) for units in ("lab", "si", "scaled")], [], si["scene"]
        assert len(set(texts)) == (1 if "friction.gamma=312:313" in words else 3)  # a rate that is a unit itself has no other
        for text in texts:
            numbers = re.findall(r"(?: = | with |drive | at )(-?[\d.e+-]+)(?: to [\d.e+-]+)? (l gamma\^2|l\^2 gamma\^3|[a-zA-Z/0-9]+)", text)
            head = [unit for unit in re.findall(r"\((.*?)\)", re.search(r"(?m)^ .*\br \(.*$|$", text)[0]) if "mu N" not in unit]
            row = re.search(r"(?m)^(?: +\d)? +[\d.]+\.[\d]{10} .*", text)
            numbers += list(zip([row[0].split()[-1 if head[0] == "weights" else 0]], head)) if row and head else []
            found.append([(float(value), unit) for value, unit in numbers])
        known = {"Hz": 2 * math.pi, "1/s": 1}
        same_in_si(found, ({**LAB, **known}, {**SI, **known}, {**scaled_units(scene), **known}))


def exported(base, units):
    """{key: (value, unit)} of the first row of a sweep: every number, with the unit that stands in its name."""
    text = subprocess.run([FESTOON, "export", base, "--csv", "--quantity", "all", "--units", units], capture_output=True, text=True, check=True).stdout
    head, row, *_ = (line.split(",")[1:-1] for line in text.splitlines())
    fields = [re.fullmatch(r"(\S+?)(?: \[(.*)\])?", field).groups() for field in head]
    return {key: (float(cell or "nan"), unit or "1") for cell, (key, unit) in zip(row, fields) if not re.match("[a-z]", cell)}


def test_rows_of_sweeps_in_all_units():
    """The same of every key of a sweep's rows: of a bead, of several, of a world, and of places where a bead floats."""
    same = {"Hz": 2 * math.pi, "1/s": 1, "deg": 1, "B0": 1, "m g": 1}  # of which nobody knows more, or that are the same in all
    with tempfile.TemporaryDirectory() as folder:
        for name, scene, more in (("one", None, ()), ("beads", "beads/bar", ()), ("world", "worlds/bowl", ()), ("floats", "worlds/levitation", ("--levitation",))):
            base, words = os.path.join(folder, name + ".db"), [SOURCE / f"examples/{scene}.yaml"] if scene else []
            subprocess.run([FESTOON, "sweep", *words, *more, "--set", "run.periods=2", "--set", "run.discard=1",
                            "--over", "drive.frequency=29,30", "-o", base], capture_output=True, check=True)
            rows = json.loads(subprocess.run([FESTOON, "export", base, "--json"], capture_output=True, text=True, check=True).stdout)
            keys = [key for key, value in rows[0].items() if isinstance(value, (int, float)) and key not in ("point", "drive.frequency")]
            found = [exported(base, units) for units in ("lab", "si", "scaled")]
            assert found[0].keys() == found[1].keys() == found[2].keys() >= set(keys), name
            for key, value in zip(keys, (rows[0][key] for key in keys)):
                assert found[2][key][0] == value, key
            told = json.loads(subprocess.run([FESTOON, "run", *words, "--set", "run.periods=1", "--set",
                                              "run.discard=0", "--json"], capture_output=True, text=True, check=True).stdout)["scene"]
            same_in_si([list(one.values()) for one in found], ({**LAB, **same}, {**SI, **same}, {**scaled_units(told), **same}))
            for key, shown in found[0].items():  # nothing is scaled in a laboratory, but for what nobody knows more of
                assert "gamma" not in shown[1] and shown[1] not in ("l",) and (shown[1] != "B0" or key.endswith("_b")), key
            if name in ("one", "world"):
                assert [found[0][key][1] for key in ("omega", "final_X", "final_WZ", "mean_drive_power")] == ["Hz", "mm", "Hz", "mW"], name
            assert name != "beads" or found[0]["energy_residual"][1] == "uJ"


for name, test in list(globals().items()):
    if name.startswith("test_"):
        test()
        print("ok", name)
