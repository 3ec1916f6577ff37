#!/usr/bin/env python3
"""Faults of the disk and of helpers: every command that writes or reads a file, on disks that fail.

    tests/reliability/faults.py [--count N] [--write] [--command NAME]...

Each case is one command under one fault: a disk that is full after so many bytes, a write, sync, rename, close or read
that fails, a limit of file sizes, a directory that goes away, a second command to the same name, a helper that is
missing or dies.  The promise holds when the command ends with status 0 and a whole file, or with status 1, one
sentence that names the file, and the old file as it was; never with a crash, another status, or a file left over.
At most N cases are tried (all unless told), drawn evenly from the list.  Status 1: a promise was broken.

Environment: FESTOON, SOURCE_DIR, BUILD_DIR as for the tests.
"""

import argparse
import errno
import hashlib
import os
import random
import resource
import shutil
import signal
import subprocess
import sys
import tempfile

import films
import section
import tracks

SOURCE = os.path.abspath(os.environ.get("SOURCE_DIR", os.path.join(os.path.dirname(__file__), "..", "..")))
BUILD = os.path.abspath(os.environ.get("BUILD_DIR", os.path.join(SOURCE, "build")))
FESTOON = os.environ.get("FESTOON", os.path.join(BUILD, "festoon"))
PRELOADED = os.path.join(BUILD, "tests", "faults.so")

SHORT = ("--set", "run.periods=12", "--set", "run.discard=2", "--set", "run.samples=16")
OTHER = ("--set", "run.periods=6", "--set", "run.discard=2", "--set", "run.samples=16")
MAP = ("--radius", "20mm", "--spacing", "4mm", "--set", "magnet.b0=10mT")
PLACES = 40  # where a disk is full: so many places over the file, and its ends


def run(words, env=None, **more):
    more.setdefault("stdout", subprocess.PIPE)
    return subprocess.run([FESTOON, *words], stdin=subprocess.DEVNULL, stderr=subprocess.PIPE, timeout=300,
                          env={**os.environ, **(env or {})}, **more)


def done(*words):
    result = run(words)
    if result.returncode != 0:
        raise SystemExit(f"{words}: {result.stderr.decode(errors='replace')}")
    return result


def give_measured(folder, film):
    """A track and points for a fit, and a film where it is wanted and ffmpeg is there."""
    with open(os.path.join(folder, "track.csv"), "w", encoding="ascii") as out:
        out.write(tracks.own(tracks.places(seconds=2), unit="mm"))
    with open(os.path.join(folder, "points.csv"), "w", encoding="ascii") as out:
        out.write("frequency [Hz],mean_r [mm],mean_r_error [mm],bead_frequency [Hz],bead_frequency_error [Hz]\n"
                  "11,18.03,0.05,-3.283,0.05\n14,20.275,0.05,-2.832,0.05\n")
    if film and films.can_film():
        csv = os.path.join(folder, "film.csv")
        done("run", "--set", "run.periods=16", "--set", "run.discard=0", "--set", "run.samples=64", "--csv", csv)
        done("movie", csv, "--camera", *films.SMALL, "--to", "0.5", "-o", os.path.join(folder, "a.mp4"))


class Command:
    """A command that writes `out` (a file, or a folder of frames) from files in the folder `given`."""

    def __init__(self, name, words, out, old=None, helper=None, reads=None):
        self.name, self.words, self.out = name, words, out
        self.old = old          # words of a command that makes the old file; None: there is none
        self.helper = helper    # the program that draws, or None
        self.reads = reads      # the file that it reads


def commands(given, out):
    """Every kind of output, and what each command reads."""
    csv, h5, branch, sweep, scene, track, points, beads, film_of = (os.path.join(given, n) for n in (
        "t.csv", "t.h5", "b.json", "s.db", "scene.yaml", "track.csv", "points.csv", "w.h5", "a.mp4"))
    walker, water, floater = (os.path.join(SOURCE, "examples", n) for n in (
        "beads/walker.yaml", "worlds/water.yaml", "worlds/levitation.yaml"))
    to = lambda name: os.path.join(out, name)
    film = ("--to", "1", "--fps", "4", "--size", "160x160")
    return [
        Command("run -o .csv", ["run", scene, *SHORT, "-o", to("t.csv")], "t.csv", ["run", *OTHER, "-o", to("t.csv")],
                reads=scene),
        Command("run -o .h5", ["run", scene, *SHORT, "-o", to("t.h5")], "t.h5", ["run", *OTHER, "-o", to("t.h5")],
                reads=scene),
        Command("sweep", ["sweep", *OTHER, "--threads", "1", "--over", "model.kappa=1:2:3", "-o", to("s.db")], "s.db"),
        Command("export --csv", ["export", sweep, "--csv", "-o", to("e.csv")], "e.csv", ["init", to("e.csv")]),
        Command("export --json", ["export", sweep, "--json", "-o", to("e.json")], "e.json", ["init", to("e.json")]),
        Command("export --hdf5", ["export", sweep, "--hdf5", "-o", to("e.h5")], "e.h5", ["init", to("e.h5")]),
        Command("init", ["init", "--force", to("new.yaml")], "new.yaml", ["init", "--set", "bead.radius=3mm", to("new.yaml")]),
        Command("branch -o", ["branch", "--kind", "locked", "--over", "drive.omega=0.2:0.201", "-o",
                              to("b.json")], "b.json", ["init", to("b.json")]),
        Command("field -o .svg", ["field", "-o", to("f.svg")], "f.svg",
                ["field", "--set", "magnet.lines=1", "-o", to("f.svg")], helper="gnuplot"),
        Command("plot .csv -o .svg", ["plot", csv, "-o", to("p.svg")], "p.svg", ["plot", csv, "--inset", "-o", to("p.svg")],
                helper="gnuplot", reads=csv),
        Command("plot .h5 -o .png", ["plot", h5, "-o", to("p.png")], "p.png", ["plot", csv, "--inset", "-o", to("p.png")],
                helper="gnuplot", reads=h5),
        Command("plot .json -o .svg", ["plot", branch, "-o", to("q.svg")], "q.svg",
                ["plot", branch, "--quantity", "slip", "-o", to("q.svg")], helper="gnuplot", reads=branch),
        Command("plot .db -o .svg", ["plot", sweep, "-o", to("w.svg")], "w.svg",
                ["plot", sweep, "--quantity", "mean_r", "-o", to("w.svg")], helper="gnuplot"),
        Command("movie -o .mp4", ["movie", csv, *film, "-o", to("m.mp4")], "m.mp4", ["movie", csv, *film, "--turn", "2", "-o",
                                                                                  to("m.mp4")], helper="ffmpeg", reads=csv),
        Command("movie -o .gif", ["movie", csv, *film, "-o", to("m.gif")], "m.gif", ["movie", csv, *film, "--turn", "2", "-o",
                                                                                  to("m.gif")], helper="ffmpeg"),
        Command("movie --camera", ["movie", csv, *film, "--camera", "-o", to("c.mp4")], "c.mp4",
                ["movie", csv, *film, "-o", to("c.mp4")], helper="ffmpeg"),
        Command("movie -o FOLDER", ["movie", csv, *film, "-o", to("frames")], "frames"),
        Command("run of beads -o .h5", ["run", walker, *SHORT, "-o", to("w.h5")], "w.h5",
                ["run", walker, *OTHER, "-o", to("w.h5")]),
        Command("run of a world --csv", ["run", water, *SHORT, "--csv", to("u.csv")], "u.csv",
                ["run", water, *OTHER, "--csv", to("u.csv")]),
        Command("sweep --levitation", ["sweep", floater, "--levitation", "--threads", "1", "--over",
                                       "drive.frequency=199:200:2", "-o", to("l.db")], "l.db"),
        Command("field --csv", ["field", *MAP, "--csv", to("map.csv")], "map.csv", ["init", to("map.csv")]),
        Command("measure -o", ["measure", track, "-o", to("points.csv")], "points.csv", ["init", to("points.csv")],
                reads=track),
        Command("measure --figure", ["measure", track, "--figure", to("m.svg")], "m.svg", ["field", "-o", to("m.svg")],
                helper="gnuplot", reads=track),
        Command("fit -o .svg", ["fit", points, "--free", "model.kappa", "-o", to("fit.svg")], "fit.svg",
                ["field", "-o", to("fit.svg")], helper="gnuplot", reads=points),
        Command("plot of beads -o .svg", ["plot", beads, "-o", to("g.svg")], "g.svg",
                ["plot", beads, "--kind", "groups", "-o", to("g.svg")], helper="gnuplot", reads=beads),
        Command("track -o", ["track", film_of, "-o", to("track.csv")], "track.csv", ["init", to("track.csv")]),
    ]


class Case:
    """A command, a fault by its name for the table, and how the fault is made."""

    def __init__(self, command, fault, env=None, limit=None, reading=False, must=None):
        self.command, self.fault, self.env, self.limit = command, fault, env, limit
        self.reading = reading  # the fault is in the files that are read
        self.must = must        # "done": this fault is no reason to fail


class Campaign:
    def __init__(self, folder, chosen):
        self.folder = folder
        self.given, self.out = os.path.join(folder, "given"), os.path.join(folder, "out")
        self.fired = os.path.join(folder, "fired")
        self.wanted, self.old = {}, {}  # contents of the finished and of the old files
        self.told = {}                  # what is said on standard error when nothing fails
        self.tally, self.violations = {}, []
        os.mkdir(self.given)
        done("init", os.path.join(self.given, "scene.yaml"))
        done("run", *SHORT, "-o", os.path.join(self.given, "t.csv"))
        done("run", *SHORT, "-o", os.path.join(self.given, "t.h5"))
        done("branch", "--kind", "locked", "--over", "drive.omega=0.2:0.201", "-o",
             os.path.join(self.given, "b.json"))
        done("sweep", *OTHER, "--over", "model.kappa=1:2:3", "-o", os.path.join(self.given, "s.db"))
        done("run", os.path.join(SOURCE, "examples", "beads", "walker.yaml"), *OTHER, "-o", os.path.join(self.given, "w.h5"))
        self.commands = [c for c in commands(self.given, self.out) if not chosen or c.name in chosen]
        give_measured(self.given, any(c.name == "track -o" for c in self.commands))

    # ------------------------------------------------------------------ contents

    def path(self, command):
        return os.path.join(self.out, command.out)

    def content(self, command):
        """The contents of the output: a value that can be compared, or None."""
        path = self.path(command)
        if command.out.endswith(".db"):
            if not os.path.exists(path):
                return None
            result = run(["export", path, "--csv"])
            return result.stdout if result.returncode == 0 else b"unreadable"
        if os.path.isdir(path):
            frames = sorted(n for n in os.listdir(path) if not n.endswith(".part"))
            return [(n, hashlib.sha256(read(os.path.join(path, n))).hexdigest()) for n in frames]
        return hashlib.sha256(read(path)).hexdigest() if os.path.exists(path) else None

    def begin(self, command):
        """An empty folder with the old file in it."""
        for place in (self.out, self.out + ".gone"):
            shutil.rmtree(place, ignore_errors=True)
        os.mkdir(self.out)
        if os.path.exists(self.fired):
            os.remove(self.fired)
        if command.old and command.name in self.old:
            for name, content in self.old[command.name][1].items():
                with open(os.path.join(self.out, name), "wb") as file:
                    file.write(content)

    def learn(self, command):
        """Finds the contents before and after an undisturbed command, and the numbers of its calls."""
        self.begin(command)
        if command.old:
            done(*command.old)
            files = {n: read(os.path.join(self.out, n)) for n in os.listdir(self.out)}
            self.old[command.name] = (self.content(command), files)
        counts = {}
        for program in filter(None, ("festoon", "ffmpeg" if command.helper == "ffmpeg" else None)):
            self.begin(command)
            result = run(command.words, self.preload(program, "count", 0, 0))
            if result.returncode != 0:
                raise SystemExit(f"{command.name}: {result.stderr.decode()}")
            text = read(self.fired).decode() if os.path.exists(self.fired) else ""
            counts[program] = {k: max(int(line.split(k + "=")[1].split()[0]) for line in text.splitlines())
                               for k in ("write", "fsync", "rename", "close", "open", "truncate", "bytes")} if text else {}
        self.wanted[command.name] = self.content(command)
        self.told[command.name] = result.stderr.decode(errors="replace").splitlines()
        reads = 0
        if command.reads:
            self.begin(command)
            run(command.words, self.preload("festoon", "count", 0, 0, self.given))
            reads = int(read(self.fired).decode().split("read=")[1].split()[0]) if os.path.exists(self.fired) else 0
        return counts, reads

    # ------------------------------------------------------------------ the list of cases

    def preload(self, program, call, number, at, under=None):
        return {"LD_PRELOAD": PRELOADED, "FESTOON_FAULT": f"{program}:{call}:{number}:{at}",
                "FESTOON_FAULT_UNDER": under or self.out, "FESTOON_FAULT_FIRED": self.fired}

    def cases(self, command):
        counts, reads = self.learn(command)
        add = []
        for program, of in counts.items():
            size = of.get("bytes", 0)
            places = sorted({0, 1, *(size * i // PLACES for i in range(PLACES)), max(size - 1, 0)})
            for at in places:
                add.append(Case(command, "disk full", self.preload(program, "room", errno.ENOSPC, at)))
                if program == "festoon":
                    add.append(Case(command, "quota", self.preload(program, "room", errno.EDQUOT, at)))
            for call in ("write", "fsync", "rename", "truncate", "close", "open"):
                for number in some(of.get(call, 0)):
                    code = errno.ENOSPC if call == "open" else errno.EIO
                    add.append(Case(command, f"{call} fails", self.preload(program, call, code, number)))
            for number in some(of.get("write", 0) + of.get("fsync", 0)):
                if program == "festoon":
                    add.append(Case(command, "directory goes away", self.preload(program, "vanish", 0, number)))
                else:
                    add.append(Case(command, "helper killed", self.preload(program, "kill", 0, number)))
        total = sum(of.get("bytes", 0) for of in counts.values())
        add += [Case(command, "file size limit", limit=at) for at in sorted({0, 1, *(total * i // 8 for i in range(8))})]
        for at in (1, 7, 4096):
            if total // at < 200000:
                add.append(Case(command, "short writes", self.preload("festoon", "short", 0, at), must="done"))
        # SQLite goes on after interrupted reads and writes, but takes an interrupted sync for a failure.
        add.append(Case(command, "interrupted calls", self.preload("festoon", "interrupted", 0, 0),
                        must=None if command.out.endswith(".db") else "done"))
        for number in some(reads):
            add.append(Case(command, "read fails", self.preload("festoon", "read", errno.EIO, number, self.given),
                            reading=True))
        if reads:
            add.append(Case(command, "interrupted reads", self.preload("festoon", "interrupted", 0, 0, self.given),
                            must="done"))
        return add

    # ------------------------------------------------------------------ one case

    def perform(self, case):
        command = case.command
        self.begin(command)
        limits = {}
        if case.limit is not None:
            limits["preexec_fn"] = lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (case.limit, case.limit))
        result = run(command.words, case.env, **limits)
        self.judge(case, result)

    def judge(self, case, result):
        command, status = case.command, result.returncode
        words = result.stderr.decode(errors="replace")
        gone = os.path.isdir(self.out + ".gone")
        if gone:  # the contents of the directory that went away do not matter; under its name no partial file may exist
            shutil.rmtree(self.out, ignore_errors=True)
            os.rename(self.out + ".gone", self.out)
        content, old = self.content(command), self.old.get(command.name, (None, None))[0]
        fired = case.limit is not None or os.path.exists(self.fired) or case.fault == "interrupted calls"
        problem = None
        if status not in (0, 1):
            problem = f"status {status}"
        elif status == 1 and (case.must == "done" or not fired):
            problem = "failed without a reason"
        elif status == 0 and content != self.wanted[command.name]:
            problem = "status 0, but the file is not whole"
        elif status == 1 and not is_named(words, self.told[command.name], command, self.out, self.given):
            problem = "the sentence names nothing"
        elif status == 1 and not self.is_kept(command, content, old, words):
            problem = "the old file is not as it was"
        left = [n for n in os.listdir(self.out) if n.endswith(".part")] if os.path.isdir(self.out) else []
        if os.path.isdir(self.path(command)):
            left += [n for n in os.listdir(self.path(command)) if n.endswith(".part")]
        if not problem and left and not gone:
            problem = f"left over: {left}"
        self.note(case, problem, status, words)

    def is_kept(self, command, content, old, words):
        if content == old:
            return True
        if self.path(command) not in words and content == self.wanted[command.name]:
            return True  # another output of the command failed
        if command.out == "frames":  # each frame is a file of its own
            return content is not None and all(frame in self.wanted[command.name] for frame in content)
        if "is complete" in words and not command.out.endswith(".db"):  # only its folder could not be synced
            return content == self.wanted[command.name]
        if command.out.endswith(".db"):  # the same command goes on
            again = run(command.words)
            return again.returncode == 0 and self.content(command) == self.wanted[command.name]
        return False

    def note(self, case, problem, status, words):
        row = self.tally.setdefault(case.fault, [0, 0, 0, 0])
        row[0] += 1
        row[1 if problem is None and status == 0 else 2 if problem is None else 3] += 1
        if problem:
            detail = (case.env or {}).get("FESTOON_FAULT") or case.limit
            self.violations.append(f"{case.command.name}, {case.fault} ({detail}): {problem}: {words.strip()[-300:]}")
            print(self.violations[-1], flush=True)

    # ------------------------------------------------------------------ special cases

    def expect(self, command, fault, status, result, condition=True, problem="not as promised"):
        """Counts one special case: the promise is kept if the status is the expected one and the condition holds."""
        case = Case(command, fault)
        wrong = None if result.returncode == status and condition else f"status {result.returncode}: {problem}"
        self.note(case, wrong, result.returncode, result.stderr.decode(errors="replace") if result.stderr else "")

    def helpers(self, command):
        """gnuplot or ffmpeg missing, killed half way, failing with words, and reporting a success that is none."""
        place = os.path.join(self.folder, "bin")
        real = shutil.which(command.helper)
        swallow = "cat >/dev/null; " if command.helper == "ffmpeg" else ""
        scripts = {"helper fails": swallow + "echo 'no such thing' >&2; exit 3", "helper killed": "kill -9 $$",
                   "helper does nothing": swallow + "exit 0",
                   "helper stops half way": f"'{real}' \"$@\" | head -c 1000; exit 0" if command.helper == "gnuplot" else
                   f"for f; do :; done; '{real}' \"$@\"; truncate -s 1500 \"${{f#file:}}\"; exit 0"}
        for fault, script in scripts.items():
            shutil.rmtree(place, ignore_errors=True)
            os.mkdir(place)
            with open(os.path.join(place, command.helper), "w", encoding="ascii") as file:
                file.write("#!/bin/sh\n" + script + "\n")
            os.chmod(file.name, 0o755)
            self.begin(command)
            result = run(command.words, {"PATH": place + ":" + os.environ["PATH"]})
            words = result.stderr.decode(errors="replace")
            self.expect(command, fault, 1, result, self.content(command) == self.old[command.name][0] and
                        (fault != "helper fails" or "no such thing" in words) and
                        not [n for n in os.listdir(self.out) if n.endswith(".part")], "old file, words or leftovers")

    def raced(self, command):
        """Two commands to the same name at once: both files are whole, one of them stays."""
        other = [*command.old]
        self.begin(command)
        both = [subprocess.Popen([FESTOON, *words], stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                                 stderr=subprocess.PIPE) for words in (command.words, other)]
        ends = [subprocess.CompletedProcess(p.args, p.wait(), None, p.stderr.read()) for p in both]
        for process in both:
            process.stderr.close()
        whole = self.content(command) in (self.wanted[command.name], self.old[command.name][0])
        left = [n for n in os.listdir(self.out) if n.endswith(".part")]
        self.expect(command, "raced", 0, ends[0], whole and not left and
                    (ends[1].returncode == 0 or other[0] == "init"), "two at once")

    def leftovers(self, command):
        """A command is killed at a write; the next one removes what was left, but nothing that another process is
        writing."""
        self.begin(command)
        killed = run(command.words, self.preload("festoon", "kill", 0, 1))
        left = [n for n in os.listdir(self.out) if n.endswith(".part")]
        if killed.returncode != -signal.SIGKILL or not left:
            return
        again = run(command.words)
        self.expect(command, "killed, then again", 0, again, self.content(command) == self.wanted[command.name] and
                    not [n for n in os.listdir(self.out) if n.endswith(".part")], "leftovers")

    def living(self):
        """A temporary file that a command is writing survives a second command to the same name."""
        command = self.commands[0]
        self.begin(command)
        path = self.path(command)
        with subprocess.Popen([FESTOON, "run", "--set", "run.periods=1e7", "-o", path], stdin=subprocess.DEVNULL,
                              stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL) as busy:
            while not [n for n in os.listdir(self.out) if n.endswith(".part")] and busy.poll() is None:
                pass
            result = run(command.words)
            left = len([n for n in os.listdir(self.out) if n.endswith(".part")])
            self.expect(command, "another one at work", 0, result, left == 1 and
                        self.content(command) == self.wanted[command.name], f"{left} temporary files")
            busy.send_signal(signal.SIGINT)
        end = subprocess.CompletedProcess(busy.args, busy.returncode, None, b"")
        self.expect(command, "another one at work", 130, end, b"# complete = false" in read(path)[-100:], "interrupted")

    def read_only(self):
        """A place where nothing can be written: for root a directory of the kernel, for others one without permission."""
        for command in self.commands:
            self.begin(command)
            if os.geteuid() == 0:
                place = "/proc/self"
            else:
                place = os.path.join(self.folder, "closed")
                os.makedirs(place, exist_ok=True)
                os.chmod(place, 0o555)
            words = [word.replace(self.out, place) for word in command.words]
            self.expect(command, "read-only directory", 1, run(words))
            words = [word.replace(self.out, os.path.join(self.folder, "none")) for word in command.words]
            self.expect(command, "no such directory", 1, run(words))

    def streams(self):
        """Standard output on a full disk, and readers that stop reading early."""
        sweep = os.path.join(self.given, "s.db")
        for words in (["export", sweep, "--csv"], ["export", sweep, "--json"], ["schema"], ["check"], ["run", *OTHER],
                      ["run", *OTHER, "--json"], ["locked", "--json"]):
            command = Command("> /dev/full", words, "none")
            with open("/dev/full", "wb") as full:
                result = run(words, stdout=full)
            self.expect(command, "standard output full", 1, result, b"standard output" in result.stderr, "sentence")
            shell = "\"$0\" \"$@\" 2>\"$WORDS\" | head -c 1 >/dev/null; exit ${PIPESTATUS[0]}"
            log = os.path.join(self.folder, "words")
            result = subprocess.run(["bash", "-c", shell, FESTOON, *words], env={**os.environ, "WORDS": log},
                                    stdin=subprocess.DEVNULL, stderr=subprocess.PIPE)
            self.expect(command, "reader wants no more", 0, result, read(log) == b"", read(log).decode(errors="replace"))

    def small_disk(self):
        """A real, full file system: the kernel refuses festoon, gnuplot and ffmpeg alike."""
        place = os.path.join(self.folder, "disk")
        os.makedirs(place, exist_ok=True)
        if os.geteuid() != 0:
            return
        for command in self.commands:
            for size in (4, 8, 16, 32, 64, 128, 512):
                if subprocess.run(["mount", "-t", "tmpfs", "-o", f"size={size}k", "none", place],
                                  stderr=subprocess.DEVNULL).returncode != 0:
                    return
                try:
                    words = [word.replace(self.out, place) for word in command.words]
                    result = run(words)
                    path = os.path.join(place, command.out)
                    whole = os.path.exists(path) and (os.path.isdir(path) or command.out.endswith(".db") or hashlib.sha256(
                        read(path)).hexdigest() == self.wanted[command.name])
                    left = [n for n in os.listdir(place) if n.endswith(".part")]
                    right = whole if result.returncode == 0 else os.path.isdir(path) or command.out.endswith(".db") or \
                        not os.path.exists(path)
                    self.expect(command, "small file system", result.returncode if result.returncode in (0, 1) else 1, result,
                                right and not left, "whole or not at all")
                finally:
                    subprocess.run(["umount", place], check=True)


def read(path):
    with open(path, "rb") as file:
        return file.read()


def some(count, most=24):
    """At most `most` of the numbers 1 to count, the first and the last ones among them."""
    numbers = range(1, count + 1)
    if count <= most:
        return list(numbers)
    return sorted({1, 2, 3, count - 2, count - 1, count, *(1 + (count - 1) * i // (most - 1) for i in range(most))})


def is_named(words, told, command, out, given):
    """Whether the message is one sentence that names a file, besides what is told anyway."""
    lines = [line for line in words.strip().splitlines() if line not in told and not line.startswith("wrote ")]
    name = os.path.join(out, command.out.rsplit(".", 1)[0])
    return len(lines) == 1 and lines[0].startswith("festoon: ") and (name in lines[0] or given in lines[0] or
                                                                     out in lines[0])


KINDS = {  # of the faults that the page's table counts together; any other has a row of its own
    "no room: disk full, quota, limit of file sizes": ("quota", "disk full", "file size limit", "small file system",
                                                       "standard output full"),
    "a write, sync, rename, truncation, opening, closing or reading fails": (
        "write fails", "fsync fails", "rename fails", "truncate fails", "open fails", "close fails", "read fails"),
    "short writes, interrupted calls": ("short writes", "interrupted calls", "interrupted reads"),
    "directory goes away, is missing or read-only": ("directory goes away", "no such directory", "read-only directory"),
    "gnuplot or ffmpeg killed, fails, stops, does nothing": ("helper killed", "helper fails", "helper stops half way",
                                                             "helper does nothing"),
    "killed, then again; two at once": ("killed, then again", "raced", "another one at work")}


def rows_of(tally):
    """The table's rows: a kind of fault, and its cases by outcome."""
    kind_of = {fault: kind for kind, faults in KINDS.items() for fault in faults}
    rows = {}
    for fault, row in tally.items():
        for name in (kind_of.get(fault, fault), "together"):
            rows[name] = [a + b for a, b in zip(rows.get(name, [0] * 4), row)]
    rows["together"] = rows.pop("together")  # the last one
    return [[name, *row] for name, row in rows.items()]


def report(campaign, drawn):
    broken = "".join(f"- {line}\n" for line in campaign.violations[:20])
    return f"""The promise: a command that writes a file ends with status 0 and a whole file, or with status 1, one sentence
that names what failed, and the old file as it was. It never crashes, never leaves a file of its own behind, never
says that a disk's failure is bad input, and is not disturbed by signals and writes that take a part.

The attack: `tests/reliability/faults.py` runs {len(campaign.commands)} commands that write files, of each
format, with a preloaded library that makes a chosen call fail: the disk is full (or a quota
used up) after so many bytes, at {PLACES} places over each file; the Nth write, sync, rename,
truncation, opening, closing or reading fails; every write takes one byte; every second call is interrupted; the
directory goes away between two writes. Besides: a limit of file sizes (`ulimit -f`), a real file system of 4 to
512 KiB, a directory that cannot be written, two commands to one name at once, a command killed while it writes, and
gnuplot and ffmpeg that are missing, fail, die half way, or report success without a whole file.{drawn}

A sweep's database is not replaced but goes on: after a fault the same command must finish it with the same rows. A
folder of frames holds whole frames. A directory that cannot be synced is told (status 1) over a complete new file.

{section.table(["fault", "cases", "done", "refused, old file kept", "broken promises"], rows_of(campaign.tally))}

{broken}"""


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--count", type=float, default=1e9)
    parser.add_argument("--write", action="store_true")
    parser.add_argument("--command", action="append")
    given = parser.parse_args()
    if not os.path.exists(PRELOADED):
        print(f"skipped: {PRELOADED} is not built (a build with sanitizers has none)")
        return 77
    for tool in ("gnuplot", "ffmpeg"):
        if not shutil.which(tool):
            print(f"skipped: no {tool}")
            return 77
    with tempfile.TemporaryDirectory(prefix="festoon-faults-") as folder:
        campaign = Campaign(folder, given.command)
        cases = [case for command in campaign.commands for case in campaign.cases(command)]
        possible = len(cases)
        if possible > given.count:
            cases = random.Random(1).sample(cases, int(given.count))
        for case in cases:
            campaign.perform(case)
        full = given.count >= 1000
        for command in campaign.commands:
            if command.helper and (full or command.out == "p.svg" or command.out == "m.mp4"):
                campaign.helpers(command)
            if command.old and (full or not command.helper):
                campaign.raced(command)
            campaign.leftovers(command)
        if not given.command:
            campaign.living()
            campaign.read_only()
            campaign.streams()
            if full:
                campaign.small_disk()
        if given.write:
            drawn = "" if full else f" {len(cases)} cases were drawn from {possible}; the small file system was left out."
            section.write("faults", report(campaign, drawn))
        total = sum(row[0] for row in campaign.tally.values())
        print(f"{total} cases, {len(campaign.violations)} broken promises")
        return 1 if campaign.violations else 0


if __name__ == "__main__":
    sys.exit(main())
