#!/usr/bin/env python3
"""A success that is told is whole: every command while memory runs out, and while a write or a read fails.

    tests/reliability/whole.py [--places N | --few N] [--write] [--command NAME]...

Every command, with each of its formats, runs undisturbed, and then again and again with a preloaded library: its n-th
allocation fails; its n-th write fails because the disk is full or broken; its n-th read
fails.  n goes through all numbers up to N, and through N of them spread evenly where there are more (2000 unless told;
a tenth, but 40 at least, of commands that take long), and of a sweep's allocations through the last N.
--few N: N allocations over all commands together, and a write and a read of each; what takes long is left out.
The promise holds when a command ends with status 0, the same outputs to the last byte and the same warnings, or with status 1, one sentence, and of each output all or nothing; never with a crash, another status, or a file
left over.  Status 1: a promise was broken.

Environment: FESTOON, SOURCE_DIR, BUILD_DIR as for the tests.
"""

import argparse
import concurrent.futures
import contextlib
import errno
import hashlib
import os
import queue
import re
import shutil
import sqlite3
import subprocess
import sys
import tempfile
import threading

import hdf5_reader
import section
from faults import FESTOON, MAP, PRELOADED, SOURCE, give_measured, read, some

SHORT = ("--set", "run.periods=6", "--set", "run.discard=2", "--set", "run.samples=16")
NO_THREADS = "cannot allocate memory for thread-local data"  # glibc's last words when it loads a library
BROKE_DOWN = "festoon: a library that this command uses broke down, mostly because memory ran out"
TWO_AT_ONCE = 2


class Command:
    """A command: its words, and what is special about it."""

    def __init__(self, words, slow=False, program="festoon", needs=None):
        self.words = words
        self.slow = slow        # at fewer places; left out where few are tried
        self.program = program  # the process in which things fail
        self.needs = needs      # a helper that must be there
        self.name = self.wanted = None
        self.told = ""          # what it says on standard error when nothing fails
        self.counts = {}


def commands():
    """Every command and every format that it writes.  They run in a folder of their own beside the folder `given`."""
    return {**of_scenes(), **of_beads(), **of_orbits(), **of_sweeps(), **of_figures(), **of_films()}


def of_scenes():
    scene = "../given/scene.yaml"
    return {
        "help run": Command(["help", "run"]),
        "completion bash": Command(["completion", "bash"]),
        "schema": Command(["schema"]),
        "schema --json": Command(["schema", "--json"]),
        "init": Command(["init", "new.yaml"]),
        "init -": Command(["init", "-"]),
        "check": Command(["check", scene]),
        "check --json": Command(["check", scene, "--json"]),
        "run": Command(["run", scene, *SHORT]),
        "run --json": Command(["run", *SHORT, "--json", "--units", "si"]),
        "run --ramp --json": Command(["run", *SHORT, "--json", "--ramp", "omega=0.2:0.21", "--ramp-points", "3",
                                      "--ramp-wait", "0"]),
        "run -o .csv": Command(["run", *SHORT, "-o", "t.csv"]),
        "run --csv --units lab": Command(["run", *SHORT, "--csv", "t.csv", "--units", "lab"]),
        "run -o .h5": Command(["run", *SHORT, "-o", "t.h5"]),
        "field --at": Command(["field", "--at", "1,0.5"]),
        "field --at --json": Command(["field", "--at", "1,0.5", "--json", "--units", "si"]),
        "field --csv": Command(["field", *MAP, "--csv", "map.csv"]),
        "field of a map": Command(["field", "--at", "0.1,0.1", "--json", "--set", "magnet.shape=grid", "--set",
                                   "magnet.file=../given/map.csv"]),
        "field of coils": Command(["field", "../given/worlds/coils.yaml", "--at", "0,0", "--time", "125ms", "--json"]),
        "lyapunov": Command(["lyapunov", *SHORT]),
        "lyapunov --json": Command(["lyapunov", *SHORT, "--json"]),
        "critical": Command(["critical", "--over", "drive.frequency=8.5Hz:10Hz:4", "--tolerance", "0.05"], slow=True),
        "paper --statements": Command(["paper", "--statements"], program="festoon-paper"),
    }


def of_beads():
    """Several beads, and one bead in a world of three dimensions."""
    walker, water = "../given/beads/walker.yaml", "../given/worlds/water.yaml"
    floater, many = "../given/worlds/levitation.yaml", ("--set", "run.method=stepping")
    return {
        "init --world": Command(["init", "new.yaml", "--world", "levitation"]),
        "check of beads --json": Command(["check", walker, "--json"]),
        "run of beads": Command(["run", walker, *SHORT]),
        "run of beads --json": Command(["run", walker, *SHORT, "--json"]),
        "run of beads -o .h5": Command(["run", walker, *SHORT, "-o", "t.h5"]),
        "run of beads --csv": Command(["run", walker, *SHORT, "--csv", "t.csv", "--units", "lab"]),
        "run of beads, stepping": Command(["run", walker, *SHORT, *many, "--json"]),
        "run of a world": Command(["run", water, *SHORT]),
        "run of a world --json": Command(["run", water, *SHORT, "--json"]),
        "run of a world -o .h5": Command(["run", water, *SHORT, "-o", "t.h5"]),
        "run of a world --csv": Command(["run", floater, "--set", "run.duration=20ms", "--csv", "t.csv"]),
        "locked of beads --json": Command(["locked", "../given/beads/bar.yaml", "--json"]),
        "locked of a floater": Command(["locked", floater]),
        "locked of a floater --json": Command(["locked", floater, "--json"]),
        "orbit of beads": Command(["orbit", "../given/beads/opposite.yaml"], slow=True),
        "orbit of beads --json": Command(["orbit", "../given/beads/opposite.yaml", "--json"], slow=True),
        "branch --kind levitating": Command(["branch", floater, "--kind", "levitating", "--over",
                                             "drive.frequency=199:200", "--json"], slow=True),
        "sweep of beads": Command(["sweep", walker, *SHORT, "--threads", "1", "--over", "impact.restitution=0:0.5:2",
                                   "-o", "s.db"]),
        "sweep --levitation": Command(["sweep", floater, "--levitation", "--threads", "1", "--over",
                                       "drive.frequency=199:200:2", "-o", "s.db"]),
        "export of beads --csv": Command(["export", "../given/w.db", "--csv"]),
        "export of beads --hdf5": Command(["export", "../given/w.db", "--hdf5", "-o", "e.h5"]),
        "export of floaters --json": Command(["export", "../given/l.db", "--json"]),
    }


def of_orbits():
    counter = ("--kind", "counter", "--over", "drive.omega=0.5:0.501")
    return {
        "orbit": Command(["orbit"]),
        "orbit --json": Command(["orbit", "--json"]),
        "locked": Command(["locked"], slow=True),
        "locked --json": Command(["locked", "--json"], slow=True),
        "branch": Command(["branch", *counter]),
        "branch --json": Command(["branch", *counter, "--json"]),
        "branch -o": Command(["branch", *counter, "-o", "b.json"]),
    }


def of_sweeps():
    sweep, over = "../given/s.db", ("--threads", "1", "--over", "model.kappa=1:2:3", "-o", "s.db")
    return {
        "sweep": Command(["sweep", *SHORT, *over, "--json"]),
        "sweep --refine": Command(["sweep", *SHORT, "--threads", "1", "--over", "model.kappa=1:2:5", "--refine", "1", "-o",
                                   "s.db"]),
        "export --csv": Command(["export", sweep, "--csv"]),
        "export --csv -o": Command(["export", sweep, "--csv", "-o", "e.csv"]),
        "export --quantity": Command(["export", sweep, "--csv", "--quantity", "mean_r,regime", "--units", "lab"]),
        "export --json": Command(["export", sweep, "--json"]),
        "export --hdf5": Command(["export", sweep, "--hdf5", "-o", "e.h5"]),
        "export of a part": Command(["export", "../given/part.db", "--csv", "--quantity", "mean_r"]),
    }


def of_figures():
    """What gnuplot draws, and measured numbers and fits, which may be drawn."""
    csv, track, rows = "../given/t.csv", "../given/track.csv", "../given/points.csv"
    drawn = {"needs": "gnuplot", "slow": True}
    free = ("--free", "model.kappa")
    return {
        "measure": Command(["measure", track]),
        "measure --json -o": Command(["measure", track, "--json", "-o", "points.csv"]),
        "measure --figure": Command(["measure", track, "--figure", "m.svg", "--compare", "../given/scene.yaml"], **drawn),
        "fit": Command(["fit", rows, *free], slow=True),
        "fit --json": Command(["fit", rows, *free, "--json"]),
        "fit --rivals --json": Command(["fit", rows, *free, "--rivals", "--json"], slow=True),
        "fit -o": Command(["fit", rows, *free, "-o", "f.svg"], **drawn),
        "field -o": Command(["field", "-o", "f.svg"], **drawn),
        "plot .csv": Command(["plot", csv, "-o", "p.svg"], **drawn),
        "plot .h5": Command(["plot", "../given/t.h5", "--kind", "time", "-o", "p.svg"], **drawn),
        "plot .json": Command(["plot", "../given/b.json", "-o", "p.svg"], **drawn),
        "plot .db": Command(["plot", "../given/s.db", "--quantity", "regime", "-o", "p.svg"], **drawn),
        "plot .db --points": Command(["plot", "../given/f.db", "--points", rows, "-o", "p.png"], **drawn),
        "plot of beads": Command(["plot", "../given/w.h5", "-o", "p.svg"], **drawn),
        "plot --kind groups": Command(["plot", "../given/w.h5", "--kind", "groups", "-o", "p.svg"], **drawn),
        "plot of floaters": Command(["plot", "../given/l.db", "-o", "p.svg"], **drawn),
    }


def of_films():
    csv, film = "../given/t.csv", "../given/a.mp4"
    few = ("--to", "1", "--fps", "4", "--size", "160x160")
    filmed = {"needs": "ffmpeg", "slow": True}
    return {
        "movie .mp4": Command(["movie", csv, *few, "-o", "m.mp4"], **filmed),
        "movie .gif": Command(["movie", csv, *few, "-o", "m.gif"], **filmed),
        "movie FOLDER": Command(["movie", csv, *few, "-o", "frames"], slow=True),
        "movie --camera": Command(["movie", csv, *few, "--camera", "-o", "m.mp4"], **filmed),
        "track": Command(["track", film, "-o", "t.csv"], **filmed),
        "track --figure": Command(["track", film, "-o", "t.csv", "--figure", "t.png"], **filmed),
        "track --overlay": Command(["track", film, "-o", "t.csv", "--overlay", "t.mp4"], **filmed),
    }


def place(text, *parts):
    return os.path.join(text, *parts)


ONE_AT_A_TIME = threading.Lock()


def columns(path):
    """The columns of a file of HDF5, which leaves a part uncompressed where it has no memory to compress it; the file
    itself where HDF5 cannot read it."""
    with ONE_AT_A_TIME:
        try:
            file = hdf5_reader.Hdf5(path)
            found = [(name, file.column(name)) for name in file.names()]
            file.close()
            return repr(found).encode()
        except AssertionError:
            return read(path)


def made(folder):
    """What a command left in a folder: the names with the digests of their contents.  A sweep's database counts by its
    rows."""
    found = {}
    for parent, _, names in os.walk(folder):
        for name in names:
            path = place(parent, name)
            if name.endswith(".db"):
                content = subprocess.run([FESTOON, "export", path, "--csv"], stdin=subprocess.DEVNULL,
                                         stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, check=False).stdout
            elif name.endswith((".db-wal", ".db-shm", ".lock", ".damaged")):
                continue
            elif name.endswith(".h5"):
                content = columns(path)
            else:
                content = re.sub(rb'"\w*seconds": [^,\n]*|\([^ ]* s\)\n', b"", read(path))  # how long it took
            found[os.path.relpath(path, folder)] = hashlib.sha256(content).hexdigest()
    return found


class Campaign:
    """The folder of all: `given`, and a folder for each process that runs at a time."""

    def __init__(self, folder, chosen, few):
        self.root = os.path.realpath(folder)
        self.commands, self.tally, self.violations = {}, {}, []
        self.slots = queue.SimpleQueue()
        os.mkdir(place(self.root, "given"))
        wanted = {name: command for name, command in commands().items() if
                  (name in chosen if chosen else not few or not command.slow) and
                  (not command.needs or shutil.which(command.needs))}
        make_given(place(self.root, "given"), any(name.startswith("track") for name in wanted))
        for number in range(TWO_AT_ONCE):
            os.mkdir(place(self.root, str(number)))
            self.slots.put(str(number))
        for name, command in wanted.items():
            command.name = name
            self.learn(command)

    def perform(self, command, fault=None, again=False):
        """Runs a command in a slot that is free, with a fault (call, error, number) or none.  Returns its status, what it
        made, what it said, and whether the fault happened; and the same of the command without the fault after it."""
        slot = self.slots.get()
        try:
            first = self.run_in(slot, command, fault)
            if again and first[0] == 1:
                first += self.run_in(slot, command, None, fresh=False)
            return first
        finally:
            self.slots.put(slot)

    def run_in(self, slot, command, fault, fresh=True):
        home, fired = place(self.root, slot), place(self.root, slot + ".fired")
        if fresh:
            shutil.rmtree(home, ignore_errors=True)
            os.mkdir(home)
        if os.path.exists(fired):
            os.remove(fired)
        env = dict(os.environ)
        if fault:
            call, error, number = fault
            env.update(LD_PRELOAD=PRELOADED, FESTOON_FAULT=f"{command.program}:{call}:{error}:{number}",
                       FESTOON_FAULT_UNDER=self.root, FESTOON_FAULT_FIRED=fired)
        with open(place(home, "stdout"), "wb") as out:
            done = subprocess.run([FESTOON, *command.words], cwd=home, env=env, stdin=subprocess.DEVNULL, stdout=out,
                                  stderr=subprocess.PIPE, timeout=600, check=False)
        words = done.stderr.decode(errors="replace")
        return done.returncode, made(home), words, read(fired).decode() if os.path.exists(fired) else ""

    def learn(self, command):
        """What the command makes undisturbed, and how often it allocates, writes and reads."""
        status, command.wanted, command.told, _ = self.perform(command)
        counted, outputs, words, text = self.perform(command, ("count", 0, 0))
        if (status, counted) != (0, 0) or outputs != command.wanted or words != command.told:
            print(f"left out: {command.name}: {(command.told + words)[:300]}")
            return
        command.counts = {k: int(text.split(k + "=")[1].split()[0]) for k in ("memory", "write", "read")}
        self.commands[command.name] = command

    def cases(self, command, places):
        """The faults to be tried: (row of the report, call, error, number)."""
        places = min(places, max(40, places // 10)) if command.slow else places
        few = max(4, places // 4)
        memory = command.counts["memory"]
        last = range(max(1, memory - places), memory + 1) if "sweep" in command.words else ()  # where rows are made
        for number in sorted({*some(memory, places), *last}):
            yield ("an allocation fails", "memory", 0, number)
        for number in some(command.counts["write"], few):
            yield ("a write fails: disk full", "write", errno.ENOSPC, number)
            yield ("a write fails: disk broken", "write", errno.EIO, number)
        for number in some(command.counts["read"], few):
            yield ("a read fails", "read", errno.EIO, number)

    def few(self, total):
        """A shorter attack: `total` allocations fail, spread over all commands, and one write and one read of each command."""
        commands = list(self.commands.values())
        for i in range(max(total, len(commands))):
            command, at = commands[i % len(commands)], i * 0.618034 % 1
            for fault, call, error in (("an allocation fails", "memory", 0),
                                       ("a write fails: disk full", "write", (errno.ENOSPC, errno.EIO)[i % 2]),
                                       ("a read fails", "read", errno.EIO)):
                if command.counts[call] and (i < len(commands) or call == "memory"):
                    yield command, (fault, call, error, 1 + int(at * command.counts[call]))

    def judge(self, command, case):
        """One case: None, or what is wrong with it."""
        sweeps = any(name.endswith(".db") for name in command.wanted)
        status, outputs, words, fired, *again = self.perform(command, case[1:], sweeps)
        lines = [line for line in words.splitlines() if line not in command.told.splitlines() and not
                 line.startswith(("wrote ", "festoon: warning: "))]
        problem = None
        if status == 2 and case[1] == "read" and "is damaged" in words and ".db" in words:
            pass  # SQLite takes a sector that cannot be read for damage
        elif status not in (0, 1):
            problem = f"status {status}"
        elif status == 0 and not set(command.told.splitlines()) <= set(words.splitlines()):
            problem = "status 0, but a warning is missing"
        elif status == 0 and outputs != command.wanted:
            differ = [name for name in {**outputs, **command.wanted} if outputs.get(name) != command.wanted.get(name)]
            mended = differ == ["stdout"] and case[1] == "read" and "this database was damaged" in words
            problem = None if mended else f"status 0, but not the same: {', '.join(differ)}"
        elif status == 1 and not fired:
            problem = "failed without a reason"
        elif status == 1 and ([line[:9] for line in lines].count("festoon: ") != 1 or lines[-1][:9] != "festoon: " or
                              case[1] != "memory" and len(lines) != 1):  # without memory libraries have words of their own
            problem = "not one sentence"
        elif status == 1 and again and (again[0] != 0 or {**again[1], "stdout": ""} != {**command.wanted, "stdout": ""}):
            problem = "the same command did not finish it"
        elif status == 1:
            half = [name for name, digest in outputs.items() if name != "stdout" and not name.endswith(".db") and
                    digest != command.wanted.get(name)]
            problem = f"half an output: {', '.join(half)}" if half else None
        left = [name for name in outputs if name.endswith(".part")]
        broke = status == 1 and BROKE_DOWN in lines[-1:] or status == 127 and NO_THREADS in words
        if broke:  # as after a kill: the next command that writes the file removes what was left
            problem = None
        elif left:
            problem = f"left over: {left}"
        return status, problem, words, broke

    def all(self, places, few):
        work = list(self.few(few)) if few else [(command, case) for command in self.commands.values()
                                                for case in self.cases(command, places)]
        with concurrent.futures.ThreadPoolExecutor(TWO_AT_ONCE) as pool:
            for (command, case), (status, problem, words, broke) in zip(
                    work, pool.map(lambda one: self.judge(*one), work)):
                row = self.tally.setdefault((command.name, case[0]), [0] * 5)
                row[0] += 1
                row[4 if problem else 3 if broke else 2 if status else 1] += 1
                if problem:
                    detail = ":".join(map(str, case[1:]))
                    self.violations.append(f"{command.name} ({detail}): {problem}: {words.strip()[-200:]}")
                    print(self.violations[-1], flush=True)


def make_given(folder, film):
    """The files that the commands read."""
    def do(*words):
        done = subprocess.run([FESTOON, *words], cwd=folder, stdin=subprocess.DEVNULL, capture_output=True, check=False)
        if done.returncode:
            raise SystemExit(f"{words}: {done.stderr.decode(errors='replace')}")

    do("init", "scene.yaml")
    do("run", *SHORT, "-o", "t.csv")
    do("run", *SHORT, "-o", "t.h5")
    do("branch", "--kind", "counter", "--over", "drive.omega=0.5:0.501", "-o", "b.json")
    do("sweep", *SHORT, "--over", "model.kappa=1:2:3", "-o", "s.db")
    do("sweep", *SHORT, "--over", "drive.frequency=10Hz:15Hz:3", "-o", "f.db")
    for name in ("beads", "worlds"):
        shutil.copytree(place(SOURCE, "examples", name), place(folder, name))
    do("run", "beads/walker.yaml", *SHORT, "-o", "w.h5")
    do("sweep", "beads/walker.yaml", *SHORT, "--over", "impact.restitution=0:0.5:2", "-o", "w.db")
    do("sweep", "worlds/levitation.yaml", "--levitation", "--over", "drive.frequency=199:200:2", "-o", "l.db")
    shutil.copy(place(folder, "s.db"), place(folder, "part.db"))
    with contextlib.closing(sqlite3.connect(place(folder, "part.db"))) as base, base:
        base.execute("DELETE FROM rows WHERE point = 1")
    do("field", *MAP, "--csv", "map.csv")
    give_measured(folder, film)


HEAD = ["cases", "the same output", "a sentence", "a library broke down"]


def table(campaign):
    """A row for memory that runs out, and one for the other faults."""
    rows = {True: [0] * 4, False: [0] * 4}
    for (_, fault), (*counts, _) in campaign.tally.items():
        memory = fault == "an allocation fails"
        rows[memory] = [a + b for a, b in zip(rows[memory], counts)]
    commands = len({command.split()[0] for command, _ in campaign.tally})
    return section.table([f"what fails in these {commands} commands", *HEAD],
                         [["an allocation", *rows[True]], ["a write or a read", *rows[False]]])


def report(campaign, places):
    """The section of docs/inside/reliability.md."""
    broken = "".join(f"- {line}\n" for line in campaign.violations[:20])
    return f"""The promise: a command ends with status 0 and its whole output, or with status 1, one sentence, and of each
file all or nothing; also when memory runs out half way.

The attack: `tests/reliability/whole.py` runs each command and format undisturbed, and then again and again while one
allocation fails (each of them, or {places} spread over all where there are more; {max(40, places // 10)} of commands that take
long); while one write of an output fails, because the disk is full or broken; and while one read fails. What a command writes
is compared with the undisturbed output, byte by byte (of HDF5: number by number). HDF5, fontconfig, OpenBLAS and the
run-time library of Fortran end the program or crash where they get no memory: the program then says so, with status 1, and
the next command that writes the file removes what was left of it, as after a kill. Pixman, which paints letters, leaves some
out and tells nobody, and fontconfig takes another font: a frame of a film may lack letters or have others. Their own
allocations are not made to fail.

{table(campaign)}

Broken promises: {len(campaign.violations)}.

{broken}"""


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--places", type=int, default=2000)
    parser.add_argument("--few", type=int, default=0)
    parser.add_argument("--write", action="store_true")
    parser.add_argument("--command", action="append")
    given = parser.parse_args()
    if not os.path.exists(PRELOADED):
        print(f"skipped: {PRELOADED} is not built (a build with sanitizers has none)")
        return 77
    with tempfile.TemporaryDirectory(prefix="festoon-whole-") as folder:
        campaign = Campaign(folder, given.command, given.few)
        campaign.all(given.places, given.few)
        total = sum(row[0] for row in campaign.tally.values())
        if given.write:
            section.write("whole", report(campaign, given.places))
        print(f"{total} cases, {len(campaign.violations)} broken promises")
        return 1 if campaign.violations else 0


if __name__ == "__main__":
    sys.exit(main())
