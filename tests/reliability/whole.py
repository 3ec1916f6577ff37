#!/usr/bin/env python3
"""A success that is told is whole: every command while memory runs out, and while a write or a read fails.

    tests/reliability/whole.py [--places N] [--write] [--command NAME]...

Every command, with each of its formats, runs undisturbed, and then again and again with a preloaded library: its n-th
allocation fails; its n-th write fails because the disk is full or broken; its n-th read
fails.  n goes through all numbers up to N, and through N of them spread evenly where there are more (2000 unless told).
The promise holds when a command ends with status 0 and the same outputs to the last byte, or with status 1, one sentence,
and of each output all or nothing; never with a crash, another status, or a file left over.  Status 1: a promise was broken.

Environment: FESTOON, SOURCE_DIR, BUILD_DIR as for the tests.
"""

import argparse
import concurrent.futures
import errno
import hashlib
import os
import queue
import re
import shutil
import subprocess
import sys
import tempfile
import threading

import films
import hdf5_reader
import section
import tracks
from faults import BUILD, FESTOON, PRELOADED, read, some

SHORT = ("--set", "run.periods=6", "--set", "run.discard=2", "--set", "run.samples=16")
MAP = ("--csv", "map.csv", "--radius", "20mm", "--spacing", "4mm", "--set", "magnet.b0=10mT")
BROKE_DOWN = "festoon: a library that this command uses broke down, mostly because memory ran out"
TWO_AT_ONCE = 2
SHORT_TEST = 40  # with so many places, or less, what takes long is left out


class Command:
    """A command: its words, and what is special about it."""

    def __init__(self, words, places=1.0, program="festoon", needs=None):
        self.words = words
        self.places = places    # the part of the places that a short test tries, because its work is longer; 0: none
        self.program = program  # the process in which things fail
        self.needs = needs      # a helper that must be there
        self.name = self.wanted = None
        self.told = ""          # what it says on standard error when nothing fails
        self.counts = {}


def commands():
    """Every command and every format that it writes.  They run in a folder of their own beside the folder `given`."""
    scene, csv, h5 = "../given/scene.yaml", "../given/t.csv", "../given/t.h5"
    branch, sweep, track, film = "../given/b.json", "../given/s.db", "../given/track.csv", "../given/a.mp4"
    rows = "../given/points.csv"
    over = ("--threads", "1", "--over", "model.kappa=1:2:3", "-o", "s.db")
    few = ("--to", "1", "--fps", "4", "--size", "160x160")
    counter = ("--kind", "counter", "--over", "drive.omega=0.5:0.501")
    drawn, filmed = {"needs": "gnuplot", "places": 0}, {"needs": "ffmpeg", "places": 0}
    return {
        "help run": Command(["help", "run"], places=0.5),
        "completion bash": Command(["completion", "bash"], places=0.2),
        "schema": Command(["schema"], places=0.2),
        "schema --json": Command(["schema", "--json"], places=0.5),
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
        "run -o .h5": Command(["run", *SHORT, "-o", "t.h5"], places=0.5),
        "sweep": Command(["sweep", *SHORT, *over, "--json"], places=0.5),
        "sweep --refine": Command(["sweep", *SHORT, "--threads", "1", "--over", "model.kappa=1:2:5", "--refine", "1", "-o",
                                   "s.db"], places=0.2),
        "export --csv": Command(["export", sweep, "--csv"]),
        "export --csv -o": Command(["export", sweep, "--csv", "-o", "e.csv"], places=0.5),
        "export --key": Command(["export", sweep, "--csv", "--key", "mean_r,regime", "--units", "lab"], places=0.5),
        "export --json": Command(["export", sweep, "--json"], places=0.5),
        "export --hdf5": Command(["export", sweep, "--hdf5", "-o", "e.h5"], places=0.5),
        "field --at": Command(["field", "--at", "1,0.5"]),
        "field --at --json": Command(["field", "--at", "1,0.5", "--json", "--units", "si"]),
        "field --csv": Command(["field", *MAP]),
        "field of a map": Command(["field", "--at", "0.1,0.1", "--json", "--set", "magnet.shape=grid", "--set",
                                   "magnet.file=../given/map.csv"]),
        "field -o": Command(["field", "-o", "f.svg"], **drawn),
        "orbit": Command(["orbit"], places=0.5),
        "orbit --json": Command(["orbit", "--json"], places=0.5),
        "locked": Command(["locked"], places=0),
        "locked --json": Command(["locked", "--json"], places=0.1),
        "branch --json": Command(["branch", *counter, "--json"], places=0.5),
        "branch -o": Command(["branch", *counter, "-o", "b.json"]),
        "lyapunov": Command(["lyapunov", *SHORT], places=0.2),
        "lyapunov --json": Command(["lyapunov", *SHORT, "--json"]),
        "plot .csv": Command(["plot", csv, "-o", "p.svg"], **drawn),
        "plot .h5": Command(["plot", h5, "--kind", "time", "-o", "p.svg"], **drawn),
        "plot .json": Command(["plot", branch, "-o", "p.svg"], **drawn),
        "plot .db": Command(["plot", sweep, "--key", "regime", "-o", "p.svg"], **drawn),
        "plot .db --points": Command(["plot", "../given/f.db", "--points", rows, "-o", "p.svg"], **drawn),
        "movie .mp4": Command(["movie", csv, *few, "-o", "m.mp4"], **filmed),
        "movie FOLDER": Command(["movie", csv, *few, "-o", "frames"], places=0),
        "movie --camera": Command(["movie", csv, *few, "--camera", "-o", "m.mp4"], **filmed),
        "measure": Command(["measure", track], places=0.5),
        "measure --json -o": Command(["measure", track, "--json", "-o", "points.csv"]),
        "measure --figure": Command(["measure", track, "--figure", "m.svg", "--compare", scene], **drawn),
        "track": Command(["track", film, "-o", "t.csv"], **filmed),
        "track --picture": Command(["track", film, "-o", "t.csv", "--picture", "t.png"], **filmed),
        "track --overlay": Command(["track", film, "-o", "t.csv", "--overlay", "t.mp4"], **filmed),
        "fit": Command(["fit", rows, "--free", "model.kappa"], places=0),
        "fit --json": Command(["fit", rows, "--free", "model.kappa", "--json"], places=0.3),
        "fit -o": Command(["fit", rows, "--free", "model.kappa", "-o", "f.svg"], **drawn),
        "paper --statements": Command(["paper", "--statements"], program="festoon-paper"),
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

    def __init__(self, folder, chosen, every):
        self.root = os.path.realpath(folder)
        self.commands, self.tally, self.violations = {}, {}, []
        self.slots = queue.SimpleQueue()
        os.mkdir(place(self.root, "given"))
        make_given(place(self.root, "given"))
        for number in range(TWO_AT_ONCE):
            os.mkdir(place(self.root, str(number)))
            self.slots.put(str(number))
        for name, command in commands().items():
            if (name in chosen if chosen else every or command.places) and (not command.needs or shutil.which(command.needs)):
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

    def cases(self, command, places, every):
        """The faults to be tried: (row of the report, call, error, number)."""
        few = max(4, round(places * (1 if every else command.places)))
        for number in some(command.counts["memory"], few):
            yield ("an allocation fails", "memory", 0, number)
        for number in some(command.counts["write"], max(4, few // 4)):
            yield ("a write fails: disk full", "write", errno.ENOSPC, number)
            yield ("a write fails: disk broken", "write", errno.EIO, number)
        for number in some(command.counts["read"], max(4, few // 4)):
            yield ("a read fails", "read", errno.EIO, number)

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
        elif status == 0 and outputs != command.wanted:
            differ = [name for name in {**outputs, **command.wanted} if outputs.get(name) != command.wanted.get(name)]
            problem = f"status 0, but not the same: {', '.join(differ)}"
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
        broke = status == 1 and BROKE_DOWN in lines[-1:]
        if broke:  # as after a kill: the next command that writes the file removes what was left
            problem = None
        elif left:
            problem = f"left over: {left}"
        return status, problem, words, broke

    def all(self, places, every):
        work = [(command, case) for command in self.commands.values() for case in self.cases(command, places, every)]
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


def make_given(folder):
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
    do("field", *MAP)
    do("run", *SHORT, "--set", "run.periods=16", "--set", "run.discard=0", "--set", "run.samples=64", "--csv", "film.csv")
    if films.can_film():
        do("movie", "film.csv", "--camera", *films.SMALL, "--to", "0.5", "-o", "a.mp4")
    with open(place(folder, "track.csv"), "w", encoding="ascii") as out:
        out.write(tracks.own(tracks.places(seconds=2), unit="mm"))
    with open(place(folder, "points.csv"), "w", encoding="ascii") as out:
        out.write("frequency [Hz],mean_r [mm],mean_r_error [mm],bead_frequency [Hz],bead_frequency_error [Hz]\n"
                  "11,18.03,0.05,-3.283,0.05\n14,20.275,0.05,-2.832,0.05\n")


HEAD = ["command", "cases", "the same output", "a sentence", "a library broke down", "broken promises"]


def table(campaign, memory):
    """The table of the faults of memory, or of the others: a row for each command."""
    rows = {}
    for (command, fault), row in campaign.tally.items():
        if (fault == "an allocation fails") == memory:
            rows[command] = [a + b for a, b in zip(rows.get(command, [0] * 5), row)]
    rows["together"] = [sum(column) for column in zip(*rows.values())]
    chosen = [0, 1, 2, 3, 4, 5] if memory else [0, 1, 2, 3, 5]
    lines = [[name, *row] for name, row in rows.items()]
    return section.table([HEAD[i] for i in chosen], [[line[i] for i in chosen] for line in lines])


def report(campaign, places):
    """The section of docs/reliability.md."""
    broken = "".join(f"- {line}\n" for line in campaign.violations[:20])
    return f"""The promise: a command ends with status 0 and its whole output, or with status 1, one sentence, and of each
file all or nothing; also when memory runs out half way.

The attack: `tests/reliability/whole.py` runs each command and format undisturbed, and then again and again while one
allocation fails (each of them, or {places} spread over all where there are more); while one write of an output fails, because the disk is full or broken; and while one read fails. What
a command writes is compared with the undisturbed output, byte by byte (of HDF5: number by number). HDF5, fontconfig and the run-time
library of Fortran end the program or crash where they get no memory: the program then says so, with status 1, and the
next command that writes the file removes what was left of it, as after a kill.

Memory:

{table(campaign, True)}

Writes and reads:

{table(campaign, False)}

{broken}"""


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--places", type=int, default=2000)
    parser.add_argument("--write", action="store_true")
    parser.add_argument("--command", action="append")
    given = parser.parse_args()
    if not os.path.exists(PRELOADED):
        print(f"skipped: {PRELOADED} is not built (a build with sanitizers has none)")
        return 77
    with tempfile.TemporaryDirectory(prefix="festoon-whole-") as folder:
        campaign = Campaign(folder, given.command, given.places > SHORT_TEST)
        campaign.all(given.places, given.places > SHORT_TEST)
        total = sum(row[0] for row in campaign.tally.values())
        if given.write:
            section.write("whole", report(campaign, given.places))
        print(f"{total} cases, {len(campaign.violations)} broken promises")
        return 1 if campaign.violations else 0


if __name__ == "__main__":
    sys.exit(main())
