"""A warning names a bead whose mass and radius contradict any material, in words and in the JSON of `check`.

tests: model/material.c model/change.c model/bare_number.c study/grid_doubts.c cli/check.c cli/sweep.c
labels: numbers"""

import csv
import json
import tempfile
import unittest
from pathlib import Path

from sweep_tools import festoon

SHORT = ["--set", "run.periods=8", "--set", "run.discard=2"]


def changed(*settings):
    return [word for setting in settings for word in ("--set", setting)]


class Material(unittest.TestCase):
    IMPOSSIBLE = [("bead.radius=5mm",), ("bead.radius=1.5mm",), ("bead.mass=50mg",), ("bead.mass=1.6g",)]
    FORGOTTEN = [("bead.radius=2mm",), ("bead.radius=2.6mm",), ("bead.radius=3mm", "bead.density=8000")]
    POSSIBLE = [(), ("bead.radius=3mm", "bead.mass=0.86g"), ("bead.radius=2mm", "model.kappa=2.3"), ("bead.radius=2mm", "model.kappa=1.5"),
                ("model.eps=0.2",), ("bead.radius=3mm", "bead.density=8000", "model.kappa=1.04"), ("bead.density=8000",),
                ("bead.radius=2.2mm", "bead.moment=0.05", "magnet.b0=6mT"), ("bead.mass=0.4g",)]

    def warnings(self, settings):
        status, out, err = festoon("check", *changed(*settings), "--json")
        self.assertEqual(status, 0, err)
        found = json.loads(out)["warnings"]
        self.assertEqual(err, "".join(f"festoon: warning: {sentence}\n" for sentence in found))
        return found

    def test_a_bare_number_of_unlikely_size(self):
        for setting, unit in (("magnet.depth=8", "8 mm"), ("drive.frequency=642", "642 rpm"), ("drive.omega=10.7", "10.7 Hz")):
            self.assertIn(f"did you mean {'drive.frequency = ' * (unit == '10.7 Hz')}{unit}?", "".join(self.warnings([setting])))
        with tempfile.TemporaryDirectory() as folder:
            scene = Path(folder, "bare.yaml")
            scene.write_text("magnet:\n  depth: 8\n", encoding="utf-8")
            self.assertIn("did you mean 8 mm?", festoon("field", str(scene), "--at", "1,0")[2])

    def test_check_tells(self):
        for settings in self.IMPOSSIBLE:
            self.assertRegex("".join(self.warnings(settings)), r"density of \d+ kg/m\^3, which no material has", settings)
        for settings in self.FORGOTTEN:
            self.assertRegex("".join(self.warnings(settings)), "still (those|that) of the default", settings)
        unmoved = ("bead.radius=3mm", "bead.material=paramagnetic")
        self.assertEqual(self.warnings(unmoved), ["bead.a is 0: the bead feels no magnet"])
        self.assertEqual(self.warnings((*unmoved, "bead.a=0.1")), [])
        self.assertEqual(self.warnings(("bead.remanence=0", "magnet.b0=10mT")), ["bead.remanence is 0: the bead feels no magnet"])
        for settings in self.POSSIBLE:
            self.assertEqual(self.warnings(settings), [], settings)

    def test_commands_tell_and_go_on(self):
        for command in ("run", "lyapunov", "orbit", "locked"):
            status, out, err = festoon(command, *changed("bead.radius=2mm"), *SHORT, "--json")
            self.assertEqual(status, 0, err)
            self.assertEqual(err.count("warning"), 1, err)
            json.loads(out)
            self.assertEqual(festoon(command, *SHORT, "--json")[2], "")

    def test_a_sweep_and_a_branch_over_the_radius_tell_once(self):
        with tempfile.TemporaryDirectory() as folder:
            for axes, count in ((["--over", "bead.radius=2mm:3mm:3"], 1), (["--over", "drive.frequency=10,11"], 0),
                                (["--over", "bead.radius=2.5mm:3mm:3"], 1), (["--over", "bead.mass=0.4g:0.6g:3"], 0),
                                (["--over", "bead.radius=2.5mm,3mm,2.5mm"], 1),
                                (["--over", "bead.radius=3mm,4mm", "--over", "bead.density=7000,8000"], 1),
                                (["--over", "drive.frequency=9:10:300", "--over", "bead.radius=2.5mm,2.6mm,2.5mm"], 1),
                                (["--over", "bead.radius=2mm,3mm", "--set", "model.kappa=2"], 0),
                                (["--over", "model.kappa=1,1.5,2", "--set", "bead.radius=2mm"], 0)):
                path = Path(folder) / f"{len(list(Path(folder).iterdir()))}.db"
                status, out, err = festoon("sweep", *axes, *SHORT, "-o", str(path))
                self.assertEqual((status, err.count("warning")), (0, count), (axes, err))
            for axes, idle in (  # kappa is 1.5, whatever else is said, unless moment and b0 are both known
                    (["--over", "bead.moment=0.01,0.02"], "bead.moment"), (["--over", "magnet.b0=1mT,2mT,3mT"], "magnet.b0"),
                    (["--over", "bead.mass=0.4g,0.5g", "--over", "magnet.b0=1mT,2mT"], "bead.mass and magnet.b0"),
                    (["--over", "bead.moment=0.01,0.02", "--set", "magnet.b0=2mT"], None),
                    (["--over", "bead.moment=0.01,0.02", "--set", "magnet.b0=2mT", "--set", "model.kappa=2"], "bead.moment"),
                    (["--over", "bead.mass=0.4g,0.5g", "--set", "magnet.b0=2mT", "--set", "bead.moment=0.01"], None),
                    (["--over", "bead.radius=2.5mm,2.6mm"], None), (["--over", "bead.inertia=0.4,0.5"], None),
                    (["--over", "magnet.depth=16mm,17mm"], None), (["--over", "magnet.depth=16mm,17mm", "--set", "model.h=0.8"], None),
                    (["--over", "bead.a=1,2"], None), (["--over", "bead.a=0.1,0.2", "--set", "bead.material=mixed"], None),
                    (["--over", "run.rtol=1e-8,1e-9"], None)):
                path = Path(folder) / f"{len(list(Path(folder).iterdir()))}.db"
                status, out, err = festoon("sweep", *axes, *SHORT, "-o", str(path))
                if "no effect" in err:
                    continue
                self.assertEqual(status, 0, err)
                told = [line.split("along ")[1].split(" only")[0] for line in err.splitlines() if "only units change" in line]
                self.assertEqual(told, [idle] if idle else [], (axes, err))
                rows = list(csv.reader(festoon("export", str(path), "--csv")[1].splitlines()))
                results = [row[rows[0].index("mean_r"):rows[0].index("mean_nz")] for row in rows[1:]]
                self.assertEqual(bool(idle), all(row == results[0] for row in results) and results[0][0] != "", axes)
            dry = ["--set", "friction.law=coulomb"]
            coil = ["--set", "magnet.b0=7mT", "--set", "coils[0].radius=15mm"]
            for i, (axes, more, idle) in enumerate((  # what has no effect at all
                    (["friction.mu=0.1,0.2"], [], "friction.mu"), (["friction.mu=0.1,0.2", "friction.law=viscous,none"], [], "friction.mu"),
                    (["friction.mu=0.1,0.2", "friction.law=viscous,coulomb"], [], None), (["start.phi=3,363"], [], "start.phi"),
                    (["friction.mu=0.1,0.2"], dry, None), (["plate.gravity=9,10"], [], None), (["bead.moment=1,1"], [], "bead.moment"),
                    (["coils[0].radius=10mm,20mm"], coil, "coils[0].radius"),
                    (["coils[0].radius=10mm,20mm"], [*coil, "--set", "coils[0].current=1A"], None))):
                words = [word for axis in axes for word in ("--over", axis)] + more
                status, out, err = festoon("sweep", *words, *SHORT, "-o", str(Path(folder) / f"idle{i}.db"))
                told = [line.split("along ")[1].split(" the motion")[0] for line in err.splitlines() if "the motion does not change" in line]
                self.assertEqual((status, told), (0, [idle] if idle else []), (axes, err))
            real = Path(folder, "real.yaml")  # beside a real magnet b0 is a unit, unless it makes the bead's strength out of kappa
            real.write_text("magnet: {shape: parts, parts: [{kind: sphere, centre: [0, 0, 0], size: 10 mm, remanence: [1 T, 0, 0]}]}\n",
                            encoding="utf-8")
            for i, (more, told) in enumerate((([], True), (["--set", "model.kappa=2"], False),
                                              (["--set", "bead.material=paramagnetic", "--set", "bead.a=1e-3"], False))):
                status, out, err = festoon("sweep", str(real), "--over", "magnet.b0=1mT,3mT,7mT", *more, *SHORT, "-o", f"{folder}/real{i}.db")
                self.assertEqual((status, "along magnet.b0 only units change" in err, "the motion does not change" in err), (0, told, False), err)
        status, out, err = festoon("branch", "--kind", "counter", "--over", "bead.radius=2.499mm:2.5mm")
        self.assertEqual((status, err.count("warning")), (0, 1), err)


if __name__ == "__main__":
    unittest.main()
