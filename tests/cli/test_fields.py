"""Fields that stand still, drives and waves by the program: run, field --time, orbit, and what is refused in words.

tests: cli/run_world.c cli/field.c model/field.c draw/field_map.c draw/figure_field.c cli/orbit.c io/scene.c model/coil_rows.c model/waveform.c orbit/world_orbit.c"""

import json
import math
import os
import unittest

from sweep_tools import Case, festoon

WORLDS = os.path.join(os.environ["SOURCE_DIR"], "examples", "worlds")
IN_TESLA = ["--set", "magnet.b0=7.3mT"]


def sets(**words):
    return [word for key, value in words.items() for word in ("--set", f"{key.replace('__', '.')}={value}")]


class Fields(Case):
    def run_of(self, *words):
        return json.loads(self.good("run", *words, "--json"))

    def test_coils_roll_a_bead(self):
        run = self.run_of(os.path.join(WORLDS, "coils.yaml"), *sets(run__duration="0.6 s"))
        self.assertEqual(run["frame"], "laboratory")
        self.assertLess(abs(run["energy_residual"]), 1e-10)
        x = run["final_lab_si"][0]  # rolling, it goes 2 pi f R t, but for the slip and the field's unevenness
        self.assertLess(abs(abs(x) / (2 * math.pi * 2 * 2.5e-3 * 0.6) - 1), 0.1)

    def test_words_for_waves(self):
        """Locked against the wave, at -eps w/(1 - k eps), or with it, at eps w/(1 + k eps); lost; and not settled."""
        scene, turn, k_radius = os.path.join(WORLDS, "wave.yaml"), 2 * math.pi, 2 * math.pi / 60e-3 * 2.5e-3
        run = self.run_of(scene)
        speed = run["groups"]["length_unit_m"] / run["groups"]["time_unit_s"]
        self.assertEqual(run["regime"], "backward")
        self.assertLess(abs(run["energy_residual"]), 1e-10)
        self.assertAlmostEqual(run["mean_velocity"] * speed / (-2.5e-3 * turn * 2 / (1 - k_radius)), 1, delta=1e-12)
        self.assertLess(run["mean_velocity_error"] * speed, 1e-12)
        # weak fields from below and from above: each keeps the bead that begins in its lock
        weak = sets(wave__amplitude="0.05 mT", wave__ratio=1, drive__frequency="8 Hz", run__duration="10 s")
        for word, side in (("backward", 1), ("forward", -1)):
            rate = -side * turn * 8 / (1 - side * k_radius)
            run = self.run_of(scene, *weak, *sets(**{"start__velocity[0]": 2.5e-3 * rate, "start__angular_velocity[1]": rate}))
            self.assertEqual(run["regime"], word)
            self.assertAlmostEqual(run["mean_velocity"] * speed / (2.5e-3 * rate), 1, delta=3e-3)  # it swings about it
            self.assertLess(run["mean_velocity_error"] * speed, 0.05 * 2.5e-3 * abs(rate))
        # the lock holds up to Om0^2/C, here for a bead that the plate hardly lets slip
        drag, torque = 40.0, run["groups"]["kappa"] * 0.05e-3 / run["groups"]["field_unit_t"]
        lost = torque / run["groups"]["time_unit_s"]**2 * (1 - k_radius)**2 / drag / turn
        for word, part in (("backward", 0.93), ("drifting", 1.3)):
            frequency = part * lost
            rate = -turn * frequency / (1 - k_radius)
            run = self.run_of(scene, *sets(wave__amplitude="0.05 mT", drive__frequency=frequency, run__duration="12 s", friction__gamma=3000,
                                           medium__drag_rate=drag, **{"start__velocity[0]": 2.5e-3 * rate, "start__angular_velocity[1]": rate,
                                                                      "start__n[0]": math.cos(1.2), "start__n[1]": 0, "start__n[2]": -math.sin(1.2)}))
            self.assertEqual(run["regime"], word, run["reason"])
        run = self.run_of(scene, *sets(run__duration="0.1 s", run__discard=0))  # it has just been let go
        self.assertEqual(run["regime"], "undecided")
        self.assertIn("mean velocity along the wave goes from", run["reason"])
        self.assertIsNone(self.run_of(os.path.join(WORLDS, "compass.yaml"), *sets(run__periods=2, run__discard=1))["mean_velocity"])

    def test_field_of_the_earth(self):
        """50 uT shift <r> of the counter-rotating bead by about 0.2 %."""
        short = sets(run__periods=120, run__discard=60)
        usual = self.run_of(*short)
        run = self.run_of(os.path.join(WORLDS, "compass.yaml"), *short)
        self.assertEqual(run["frame"], "laboratory")
        self.assertEqual(run["regime"], usual["regime"])
        self.assertTrue(1e-4 < abs(run["mean_r"] / usual["mean_r"] - 1) < 5e-3)

    def test_frames_agree(self):
        told = {}
        for frame in ("turning", "laboratory"):
            run = self.run_of(*IN_TESLA, *sets(drive__waveform="oscillating", drive__amplitude="60 deg", world__frame=frame,
                                               run__periods=4, run__rtol=1e-13))
            self.assertEqual(run["frame"], frame)
            told[frame] = run["final_lab"]
        for one, other in zip(told["turning"], told["laboratory"]):
            self.assertAlmostEqual(one, other, delta=1e-11)

    def test_field_at_a_time(self):
        scene = os.path.join(WORLDS, "coils.yaml")
        for time, axis in (("0", 0), ("125ms", 2)):
            told = json.loads(self.good("field", scene, "--at", "0,0", "--time", time, "--json"))
            b = told["b_tesla"]
            self.assertAlmostEqual(abs(b[axis]), 4e-7 * math.pi * 200 * 2 / (2 * 0.1), delta=1e-9)
            self.assertAlmostEqual(b[2 - axis], 0, delta=1e-9)
        # the magnet turned by a quarter
        one = json.loads(self.good("field", "--at", "0.5,0.2", "--json"))
        turned = ("field", *sets(drive__frequency="10 Hz"), "--at", "-0.2,0.5", "--time", "25ms")
        two = json.loads(self.good(*turned, "--json"))
        for key in ("b", "force"):
            for wanted, found in zip((-one[key][1], one[key][0], one[key][2]), two[key]):
                self.assertAlmostEqual(wanted, found, delta=1e-12)
        self.assertAlmostEqual(one["load"], two["load"], delta=1e-12)
        self.assertAlmostEqual(two["time"], 0.025 * 312.5, delta=1e-12)
        self.assertIn(f"|B| = {math.hypot(*one['b']):.9g} B0", self.good(*turned))
        self.assertIn("those of the time 0", self.refused(*turned, "-o", self.path("f.svg")))
        figure = self.path("f.svg")
        for scene, of in (("coils", "of 2 coils at the time 0"), ("compass", "a uniform field at the time 0")):
            self.good("field", os.path.join(WORLDS, scene + ".yaml"), "-o", figure)
            with open(figure[:-4] + ".gp", encoding="utf-8") as script:
                self.assertIn(of, script.read().replace("\n", " "))
        self.good("field", *sets(drive__waveform="wave", wave__length="60 mm", wave__amplitude="2 mT", magnet__b0="10 mT"), "-o", figure)
        with open(figure[:-4] + ".gp", encoding="utf-8") as script:
            words = script.read()
        self.assertIn("of a wave at the time 0", words)
        self.assertNotIn("magnet's lines", words)

    def test_a_table_and_a_place_tell_the_same_field(self):
        """Of all that makes one, in every scene, but for rounding: --csv, --at, and --time 0; bit for bit where more than a magnet makes it."""
        disc = self.path("fixed.yaml")
        with open(disc, "w", encoding="utf-8") as out:
            out.write("magnet:\n  shape: parts\n  depth: 10 mm\n  parts:\n    - {kind: cylinder, centre: [5 mm, 0 mm, 0 mm],"
                      " size: [10 mm, 5 mm], remanence: [0 T, 0 T, 1 T], motion: fixed}\n")
        scenes = [os.path.join(WORLDS, name) for name in sorted(os.listdir(WORLDS))]
        scenes += [os.path.join(WORLDS, os.pardir, "magnets", name) for name in ("cross.yaml", "halbach.yaml", "measured-map.yaml")]
        for scene in [disc, *scenes, os.path.join(WORLDS, os.pardir, "paper-10.7Hz.yaml")]:
            surrounded = os.path.basename(scene) in ("fixed.yaml", "coils.yaml", "compass.yaml", "wave.yaml")
            known = IN_TESLA if "paper" in scene or "bowl" in scene or "water" in scene else []
            self.good("field", scene, *known, "--csv", self.path("f.csv"), "--radius", "20mm", "--spacing", "5mm")
            with open(self.path("f.csv"), encoding="utf-8") as table:
                rows = {tuple(line.split(",")[:2]): line.split(",") for line in table if line[0] not in "#x"}
            for place in (("5", "-15"), ("-20", "10")):
                at = "{}mm,{}mm".format(*place)
                told = json.loads(self.good("field", scene, *known, "--at", at, "--units", "si", "--json"))
                with self.subTest(scene=scene, at=at):
                    most = max(map(abs, told["b_tesla"]))
                    self.assertGreater(most, 1e-5)
                    for cell, wanted in zip(rows[place][3:6], told["b_tesla"], strict=True):
                        self.assertAlmostEqual(1e-3 * float(cell), wanted, delta=2e-15 * most)
                    if "measured" in scene:  # a map has one height
                        continue
                    then = json.loads(self.good("field", scene, *known, "--at", at, "--time", "0", "--json"))
                    for one, other in zip(told["b"], then["b"]):
                        self.assertAlmostEqual(one, other, delta=0.0 if surrounded else 1e-14 * max(map(abs, told["b"])))
        with_force = json.loads(self.good("field", disc, "--at", "5mm,2mm", "--json"))
        self.assertGreater(math.hypot(*with_force["force"]), 0.0)
        self.assertIn(" mT", self.good("field", disc, "--at", "5mm,2mm", "--units", "lab"))
        self.assertIn("B (mT)", self.good("field", disc, "--at", "5mm,2mm", "--units", "lab", "--time", "1"))
        # the wave's height is the bead's, also where another one is asked
        wave = os.path.join(WORLDS, "wave.yaml")
        low, high = (json.loads(self.good("field", wave, "--at", "0,0", "--json", *words))["b_tesla"][0] for words in ((), ("--height", "7.5mm")))
        base = json.loads(self.good("field", wave, "--at", "0,0", "--json"))["height"] * 23.0
        self.assertAlmostEqual(high / low, math.exp(-2 * math.pi * (7.5 - base) / 60), delta=1e-12)

    def test_no_field_is_told_within_a_part(self):
        """Of a block 20 mm square that turns, and of one that stands still beside it, however it is asked."""
        scene = self.path("blocks.yaml")
        with open(scene, "w", encoding="utf-8") as out:
            out.write("drive: {frequency: 10 Hz}\nmagnet:\n  shape: parts\n  depth: 10 mm\n  parts:\n"
                      "    - {kind: cuboid, centre: [0 mm, 0 mm, 0 mm], size: [20 mm, 20 mm, 10 mm], remanence: [1 T, 0 T, 0 T]}\n"
                      "    - {kind: cuboid, centre: [30 mm, 0 mm, 0 mm], size: [20 mm, 20 mm, 10 mm],"
                      " remanence: [0 T, 0 T, 1 T], motion: fixed}\n")
        for x, y, milliseconds, part in ((0, 0, 0, 0), (13, 0, 0, None), (13, 0, 12.5, 0), (9, 9, 0, 0), (9, 9, 12.5, None),
                                         (35, 5, 0, 1), (35, 5, 25, 1), (-5, 35, 25, None), (-35, 5, 50, None)):
            for words in ((), ("--json",), ("--units", "lab")):
                for time in [("--time", f"{milliseconds}ms")] + [()] * (milliseconds == 0):
                    call = ("field", scene, "--at", f"{x}mm,{y}mm", "--height", "0mm", *time, *words)
                    with self.subTest(call=call):
                        if part is None:
                            self.good(*call)
                        else:
                            self.assertIn(f"lies in or on magnet.parts[{part}], a cuboid", self.refused(*call))
        table = ("field", scene, "--csv", self.path("t.csv"), "--radius", "8mm", "--spacing", "2mm", "--height")
        self.assertIn("-8 mm, -8 mm at the height 4 mm lies in or on a part", self.refused(*table, "4mm"))
        self.assertFalse(os.path.exists(self.path("t.csv")))
        self.good(*table, "5.1mm")

    def test_figures_of_all_fields(self):
        """Also of a field that is the same everywhere, and of none."""
        coils = os.path.join(WORLDS, "coils.yaml")
        for name, words, levels in (("all", (), True), ("load", ("--quantity", "load"), False),
                                    ("none", sets(**{f"coils[{i}].{key}": "0 A" for i in range(2) for key in ("current", "ac")}), False)):
            with self.subTest(name=name):
                self.good("field", coils, *words, "-o", self.path("f.svg"))
                with open(self.path("f.gp"), encoding="utf-8") as script, open(self.path("f.dat"), encoding="utf-8") as data:
                    self.assertEqual("set cntrparam" in script.read(), levels)
                    x, y, shown = map(float, next(line for line in data if line[0] not in "#\n").split())
                told = json.loads(self.good("field", coils, *words[2 * (words[:1] == ("--quantity",)):], "--at", f"{x},{y}", "--json"))
                wanted = told["load"] if name == "load" else math.hypot(*told["b"])
                self.assertAlmostEqual(shown, wanted, delta=2e-4 * abs(wanted))

    def test_orbit_of_a_swinging_magnet(self):
        words = [*sets(drive__waveform="oscillating", drive__amplitude="20 deg", drive__frequency="30 Hz",
                       start__spin="rest", start__r=0.9, start__phi=5, run__periods=200)]
        orbit = json.loads(self.good("orbit", *words, "--json"))
        self.assertEqual(orbit["frame"], "turning")
        self.assertLess(orbit["residual"], 1e-10)
        self.assertTrue(orbit["stable"])
        self.assertEqual(len(orbit["multipliers"]), 9)

    def test_refused(self):
        for words, wanted in (
                (sets(**{"field__uniform[0]": "50 uT"}), "give magnet.b0"),
                (["--set", "coils[1].radius=5 cm"], "no coils[0] before"),
                (["--set", "coils[0].radios=5 cm"], "coils[0].radius"),
                (["--set", "coils[0].current=5 A"], "has no radius"),
                ([*IN_TESLA, "--set", "coils[0].radius=5 cm", "--set", "coils[0].axis[2]=0"], "not a direction"),
                ([*IN_TESLA, "--set", "coils[0].radius=5 cm", "--set", "world.frame=turning"], "is not a frame"),
                (sets(drive__waveform="table"), "two rows"),
                (sets(drive__waveform="table", drive__table="0:0 1:90 0.5:90"), "goes back in time"),
                (sets(drive__waveform="table", drive__table="0:0 1:1e308"), "by 1e+06 degrees"),
                (sets(drive__waveform="table", drive__table="0:0 later"), "not a row of time"),
                (sets(drive__waveform="wave"), "wave.length and wave.amplitude"),
                (sets(drive__waveform="sine"), "choose one of steady"),
                (sets(drive__amplitude=10), "choose oscillating"),
                (sets(wave__ratio=1), "choose wave"),
                (sets(plate__tilt=95), "out of range")):
            with self.subTest(words=words):
                self.assertIn(wanted, self.refused("run", *words))
        pair = os.path.join(WORLDS, os.pardir, "beads", "opposite.yaml")
        for key in ("plate.tilt=5", "world.frame=laboratory", "drive.waveform=oscillating"):
            with self.subTest(key=key):
                self.assertIn("time stepping knows", self.refused("run", pair, "--set", "run.method=stepping", "--set", key))
        for command in (["locked"], ["orbit"], ["branch", "--kind", "locked", "--over", "drive.frequency=30:31"]):
            with self.subTest(command=command):
                self.assertIn("plate.tilt", self.refused(command[0], pair, *command[1:], "--set", "plate.tilt=5"))
        tilted = sets(plate__tilt=5)
        self.assertIn("plate.tilt", self.refused("orbit", *tilted, "--festoons", "2"))
        for command in (["locked"], ["lyapunov"], ["branch", "--kind", "counter", "--over", "model.kappa=1:2"]):
            with self.subTest(command=command):
                self.assertIn("plate.tilt", self.refused(*command, *tilted))
        self.assertIn("does not", self.refused("orbit", *sets(drive__waveform="chirp", drive__chirp=1)))
        self.assertIn("not a multiple", self.refused(
            "orbit", *IN_TESLA, "--set", "coils[0].radius=5 cm", "--set", "coils[0].ac=1 A", "--set", "coils[0].frequency=3.3 Hz"))


if __name__ == "__main__":
    unittest.main()
