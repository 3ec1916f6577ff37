"""The commands branch, orbit and lyapunov at work and in trouble: progress, interruption, and messages about bad
input.

tests: cli/branch.c orbit/tracer.c
labels: slow"""

import json
import os
import re
import subprocess
import tempfile
import unittest

import events

FESTOON = os.environ["FESTOON"]


def branch(*words):
    done = subprocess.run([FESTOON, "branch", *words], capture_output=True, text=True, timeout=events.HANG,
                          stdin=subprocess.DEVNULL)
    return done.returncode, done.stdout, done.stderr


def interrupted(words, beyond=-1.0, used=None):
    """Interrupts a command once its progress line says more than `beyond` per cent; returns status, output and the
    text of the terminal. If the command was over before, words(factor) makes one with more work. The processor
    time from the signal on goes into the list `used`."""
    found = None

    def far_enough(text):
        return any(float(part) > beyond for part in re.findall(r"([0-9.]+) %  .*? left", text))

    def blow(factor):
        nonlocal found
        found = events.on_a_terminal([FESTOON, *words(factor)], far_enough, used=used)
        return found[0] != 0
    events.struck(blow, 1)
    return found


class Interruption(unittest.TestCase):
    def check(self, step, *words, beyond=-1.0):
        with tempfile.TemporaryDirectory() as directory:
            path = os.path.join(directory, "branch.json")
            status, out, said = interrupted(
                lambda factor: ("branch", *words, "--step", f"{step / factor:g}", "-o", path), beyond)
            self.assertEqual((status, out), (130, b""), said)
            self.assertRegex(said, r"\d\.\d %  \d+ s left")
            self.assertIn("marked incomplete", said)
            with open(path, encoding="utf-8") as text:
                kept = json.load(text)
            self.assertIs(kept["complete"], False)
            self.assertEqual(os.listdir(directory), ["branch.json"])
            return kept

    def test_branch(self):
        kept = self.check(0.02, "--kind", "counter", "--over", "drive.omega=0.02:5", "--tolerance", "1e-14",
                          beyond=15.0)  # the first orbits are found by then
        self.assertGreater(len(kept["points"]), 0)

    def test_follow(self):
        self.check(0.01, "--kind", "counter", "--over", "drive.omega=0.25:0.3", "--follow", "pitchfork",
                   "--with", "model.kappa=0.8:3", "--tolerance", "1e-14")

    def test_nothing_is_kept_without_a_file(self):
        status, out, said = interrupted(
            lambda factor: ("branch", "--kind", "all", "--over", "drive.omega=0.02:5", "--step", f"{0.05 / factor:g}"))
        self.assertEqual((status, out), (130, b""))
        self.assertIn("-o FILE.json would have kept", said)

    def test_hard_scenes(self):
        """With a bead that nearly touches the magnet's lines a single integration takes minutes: it must stop within
        the processor time of some 10^5 evaluations of the equations, 0.1 s on an idle processor."""
        before = events.children_time()
        done = subprocess.run([FESTOON, "run", "--json", "--set", "run.periods=2000"], capture_output=True, check=True)
        unit = (events.children_time() - before) / json.loads(done.stdout)["rhs_calls"]
        small = ("--set", "model.h=0.001")
        for words in (("branch", *small, "--kind", "counter", "--over", "drive.omega=0.2:3"),
                      ("branch", *small, "--kind", "all", "--over", "drive.omega=0.02:3"),
                      ("branch", "--kind", "all", "--over", "drive.omega=0.02:5", "--tolerance", "1e-14"),
                      ("orbit", *small), ("orbit", *small, "--festoons", "12")):
            for beyond in (0.0, 0.1, 4.0) if words[0] == "branch" and small[1] not in words else (-1.0,):
                used = []
                status, out, said = interrupted(lambda _, words=words: words, beyond, used)
                self.assertEqual((status, out), (130, b""), (words, said))
                self.assertIn("interrupted after", said)
                self.assertLess(used[-1] / unit, 2e5, (words, beyond))

    def test_what_keeps_nothing(self):
        """The commands end at the first signal, within the long computation and not after it."""
        for words in (lambda factor: ("lyapunov", "--set", f"run.periods={100000 * factor}"),
                      lambda factor: ("lyapunov", "--set", f"run.periods={10**6 * factor}", "--set",
                                      f"run.discard={9 * 10**5 * factor}"),
                      lambda factor: ("orbit", "--festoons", f"{11 + factor}")):
            status, out, said = interrupted(words)
            self.assertEqual((status, out), (130, b""), (words(1), said))
            self.assertIn("interrupted after", said)


class BadInput(unittest.TestCase):
    def refused(self, status, *words):
        code, out, err = branch(*words)
        self.assertEqual((code, out), (status, ""), err)
        self.assertEqual(err.count("\n"), 1, err)
        return err

    def test_usage(self):
        counter = ("--kind", "counter")
        for words, part in (
                (("--over", "drive.omega=0.2:0.3"), "say which"),
                (("--kind", "countr", "--over", "drive.omega=0.2:0.3"), "the nearest is counter"),
                (counter, "say over which parameter"),
                ((*counter, "--over", "drive.omega=0.2"), "must be KEY=LO:HI"),
                ((*counter, "--over", "drive.omega=0.2:2:5"), "takes no count"),
                ((*counter, "--over", "drive.omgea=0.2:0.3"), "the nearest is drive.omega"),
                ((*counter, "--over", "model.dynamics=0:1"), "not a parameter with real values"),
                ((*counter, "--over", "drive.omega=0.3:0.2"), "must rise"),
                ((*counter, "--over", "drive.omega=0.2:0.2"), "must rise"),
                ((*counter, "--over", "drive.omega=a:b"), "--over: \"a\" is not a decimal number"),
                ((*counter, "--over", "drive.omega=0.2:inf"), "not a decimal number"),
                ((*counter, "--over", "drive.omega=0.2:0.3", "--tolerance", "1"), "--tolerance: \"1\" must be a number from 1e-14 to 1e-6"),
                ((*counter, "--over", "drive.omega=0.2:0.3", "--step", "0"), "--step: \"0\" must be a number greater than 1e-5"),
                ((*counter, "--over", "drive.omega=0.2:0.3", "--follow", "fold"), "need both"),
                ((*counter, "--over", "drive.omega=0.2:0.3", "--follow", "foldd", "--with", "model.kappa=1:2"),
                 "the nearest is fold"),
                ((*counter, "--over", "drive.omega=0.2:0.3", "--follow", "fold", "--with", "drive.omega=1:2"), "again"),
                (("--kind", "locked", "--over", "model.kappa=-1:1"), "must be 0 to"),
                ((*counter, "--over", "drive.omega=-1:3"), "--over: drive.omega = -1 is out of range: it must be"),
                ((*counter, "--over", "start.r=0.5:1"), "no orbit and no locked state depends on start.r"),
                ((*counter, "--over", "run.periods=10:100"), "depends on run.periods"),
                ((*counter, "--over", "plate.radius=0.01:0.02"), "depends on plate.radius"),
                ((*counter, "--over", "friction.mu=0.1:0.3"), "depends on friction.mu in this scene: along it nothing changes"),
                ((*counter, "--over", "magnet.b0=1mT:2mT"), "depends on magnet.b0 in this scene: along it only units change"),
                ((*counter, "--over", "plate.gravity=9:10"), "with friction.law = viscous no orbit and no locked state"),
                ((*counter, "--over", "drive.omega=0.25:0.3", "--follow", "pitchfork", "--with", "model.kappa=-2:3"),
                 "--with: model.kappa = -2 is out of range"),
                ((*counter, "--over", "drive.omega=0.25:0.3", "--follow", "pitchfork", "--with", "model.kappa=2:3"),
                 "must lie within the range 2 to 3")):
            self.assertIn(part, self.refused(2, *words), words)

    def test_a_place_that_cannot_be_written_costs_no_work(self):
        said = self.refused(1, "--kind", "all", "--over", "drive.omega=0.02:5", "-o", "/nonexistent/branch.json")
        self.assertIn("cannot write here", said)

    def test_a_branch_without_points_is_not_drawn(self):
        with tempfile.TemporaryDirectory() as directory:
            path, figure = os.path.join(directory, "b.json"), os.path.join(directory, "f.svg")
            self.assertEqual(branch("--kind", "counter", "--over", "drive.omega=0.3:0.31", "-o", path)[0], 0)
            with open(path, encoding="utf-8") as text:
                whole = json.load(text)
            self.assertTrue(whole["points"])
            for complete, part in ((True, "nothing to draw"), (False, "interrupted before the first one")):
                with open(path, "w", encoding="utf-8") as text:
                    json.dump(dict(whole, points=[], specials=[], crossings=[], ends=[], complete=complete), text)
                done = subprocess.run([FESTOON, "plot", path, "-o", figure], capture_output=True, text=True, check=False)
                self.assertEqual((done.returncode, done.stdout), (2, ""), done.stderr)
                self.assertIn("this branch has no points", done.stderr)
                self.assertIn(part, done.stderr)
            self.assertEqual(os.listdir(directory), ["b.json"])

    def test_where_no_such_orbit_is(self):
        """The message says what happened to the bead instead, in a whole sentence."""
        locks = self.refused(1, "--kind", "counter", "--over", "drive.omega=0.04:0.06")
        self.assertRegex(locks, r"the bead locks to the magnet at omega = [0-9.]+ \(after .* r = .*\. Try another range")
        ejected = self.refused(1, "--kind", "counter", "--over", "drive.omega=5:6", "--set", "drive.omega=5",
                               "--set", "start.r=3")
        self.assertRegex(ejected, r"the bead flies away at omega = [0-9.]+ .*\. Try another range")
        librates = self.refused(1, "--kind", "counter", "--over", "drive.omega=0.153:0.17",
                                "--set", "drive.omega=0.16")
        self.assertRegex(librates, r"the last try: the orbit met at drive.omega = 0.15\d* librates\. Try another")
        none = self.refused(1, "--kind", "counter", "--over", "drive.omega=0.28:0.3", "--follow", "fold",
                            "--with", "model.kappa=1:2")
        self.assertIn("no fold lies between", none)


class TwoParameters(unittest.TestCase):
    def test_curves_that_begin_on_the_border(self):
        """The scene's own value may be an end of the second range: the curve then ends at the end of that range."""
        for kappa in ("1.5:1.52", "1.48:1.5", "1.48:1.52"):
            done = subprocess.run([FESTOON, "branch", "--kind", "locked", "--set", "model.kappa=1.5", "--over",
                                   "drive.frequency=7.4Hz:7.8Hz", "--follow", "hopf", "--with", f"model.kappa={kappa}", "--json"],
                                  capture_output=True, text=True, check=True)
            self.assertEqual([end["type"] for end in json.loads(done.stdout)["ends"]], ["range", "range"], kappa)


class Orbit(unittest.TestCase):
    def test_where_newton_does_not_converge(self):
        """Beyond the fold the bead spirals outward: its returns come close to each other, although no orbit exists
        there."""
        done = subprocess.run([FESTOON, "orbit", "--set", "drive.omega=4"], capture_output=True, text=True, timeout=events.HANG,
                              check=False)
        self.assertEqual((done.returncode, done.stdout), (1, ""))
        self.assertRegex(done.stderr, r"settled on no stable orbit .* last returns differ by [0-9.e-]+ .* was tried \d+")

    def test_an_orbit_of_two_returns_is_named(self):
        """Between 13.71 and 15.22 Hz a period has doubled over this bar: no length of a run and no start leads to a single return."""
        scene = ("bead: {radius: 1.8 mm, density: 7450 kg/m^3, remanence: 1.15 T}\nfriction: {gamma: 260 1/s}\ndrive: {frequency: 14 Hz}\n"
                 "magnet:\n  shape: parts\n  depth: 13 mm\n"
                 "  parts: [{kind: cuboid, centre: [0, 0, 0], size: [44 mm, 24 mm, 7 mm], remanence: [0.9 T, 0, 0]}]\n")
        done = subprocess.run([FESTOON, "orbit", "-"], input=scene, capture_output=True, text=True, timeout=events.HANG, check=False)
        self.assertEqual((done.returncode, done.stdout), (1, ""))
        self.assertRegex(done.stderr, r"closes after 2 returns \(to \d\S*e-\d+; single ones differ by 0\.2\d+\)")
        self.assertIn("festoon branch --kind counter --over drive.frequency=LO:HI follows", done.stderr)
        self.assertNotIn("Try a longer", done.stderr)

    def test_what_did_not_turn_regularly_has_no_returns_to_compare(self):
        done = subprocess.run([FESTOON, "orbit", "--set", "run.periods=1", "--set", "run.discard=0"],
                              capture_output=True, text=True, timeout=events.HANG, check=False)
        self.assertEqual((done.returncode, done.stdout), (1, ""))
        self.assertNotIn("inf", done.stderr)
        self.assertRegex(done.stderr, r"did not turn regularly \(speed in the turning frame: [0-9.e-]+\)")

    def test_a_start_that_is_ejected(self):
        done = subprocess.run([FESTOON, "orbit", "--set", "drive.omega=5", "--set", "start.r=3"], capture_output=True,
                              text=True, timeout=events.HANG, check=False)
        self.assertEqual((done.returncode, done.stdout), (1, ""))
        self.assertRegex(done.stderr, r"flies away at omega = 5 \(after [0-9.]+ drive periods")


if __name__ == "__main__":
    unittest.main()
