#!/usr/bin/env python3
"""Kill sweeps, hundreds of times, and see that nothing is lost but what docs/sweeps.md says, and that the rows in
the end are those of a sweep that was never killed.

    tests/reliability/kills.py [--count N] [--seed N] [--only TEXT] [--write]

N kills (500) are shared between kinds of sweeps.  Each database is killed several times, each time at another moment:
while it is made, when so many rows are in it, when runs in flight were saved, or anywhere; then the command is given
once more and may end.  Work is sized by measuring it, and only blows that struck a program at work count.  --write
puts the table into docs/inside/reliability.md.  Environment: FESTOON is the program, SOURCE_DIR the source tree.  Status 1: a
promise was broken.
"""

import argparse
import os
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import time

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path[:0] = [HERE, os.path.join(os.path.dirname(HERE), "helpers")]
FESTOON = os.environ.setdefault("FESTOON", os.path.join(HERE, "..", "..", "build", "festoon"))

import events  # noqa: E402
import section  # noqa: E402

THREADS = 2
CHECKPOINT = 0.05
COMMIT, HURRY = 0.5, 0.05  # seconds from the end of a run to its commit at most, but for the disk; and to be heard
MOST_LOST = CHECKPOINT + COMMIT + HURRY
FEW = ["--set", "run.periods=8", "--set", "run.discard=4", "--set", "run.rtol=1e-8"]
MPIRUN = ["mpirun", "--oversubscribe", "--allow-run-as-root", "--bind-to", "none"]


# ------------------------------------------------------------------ the kinds of sweeps

def rows_of(size):
    return [*FEW, "--over", f"drive.frequency=9Hz:20Hz:{size}", "--over", "model.kappa=1,1.5"]


def flights_of(size):
    """Twelve long runs, all in flight at once."""
    return ["--set", f"run.periods={size}", "--set", f"run.discard={size // 2}", "--set", "run.rtol=1e-8", "--over",
            "drive.frequency=6Hz:20Hz:12"]


def chains_of(size):
    return [*FEW, "--over", f"drive.omega=0.3:0.36:{size}", "--over", "model.kappa=1:2:6", "--carry", "down"]


def exponents_of(size):
    """Runs that librate or are chaotic: most of the work are their Lyapunov exponents."""
    return ["--set", f"run.periods={size}", "--set", "run.discard=16", "--set", "model.kappa=0.93", "--over",
            "drive.frequency=6.57Hz:6.8Hz:10"]


class Kind:
    """A kind of sweep, its share of the kills, and the counts of what happened."""

    def __init__(self, name, words, size, seconds, share, blows=5, ranks=0, raced=False, portable=False, number=None):
        self.name, self.words, self.size, self.seconds, self.share, self.blows = name, words, size, seconds, share, blows
        self.ranks, self.raced, self.number = ranks, raced, number or signal.SIGKILL
        self.more = ["--portable"] if portable else []
        self.kills = self.journals = self.refused = self.committed = self.young = 0
        self.lost_work = 0.0
        self.took = self.processor = 0.0
        self.broken = ""

    def command(self, path):
        return [FESTOON, "sweep", *self.words(self.size), *self.more, "--threads", str(1 if self.ranks else THREADS),
                "--checkpoint", str(CHECKPOINT), "-o", path]

    def ranked(self, path):
        return [*MPIRUN, "-n", str(self.ranks), *self.command(path)] if self.ranks else self.command(path)


def kinds():
    found = [
        Kind("many short runs", rows_of, 100, 0.4, 6, blows=3),
        Kind("many short runs, the portable arithmetic", rows_of, 30, 0.4, 2, blows=3, portable=True),
        Kind("long runs, all in flight", flights_of, 300, 2.5, 4, blows=12),
        Kind("long runs, SIGTERM instead", flights_of, 300, 1.5, 2, blows=8, number=signal.SIGTERM),
        Kind("chains (--carry)", chains_of, 10, 0.4, 4, blows=3),
        Kind("Lyapunov exponents", exponents_of, 40, 0.8, 4, blows=6),
        Kind("two commands at once on one file", rows_of, 100, 0.4, 3, blows=4, raced=True),
    ]
    if shutil.which("mpirun") and b"mpi yes" in subprocess.run([FESTOON, "--version"], capture_output=True,
                                                               check=True).stdout:
        found.append(Kind("a rank of three under mpirun", rows_of, 100, 0.5, 2, blows=2, ranks=3))
        found.append(Kind("long runs on two ranks, one killed", flights_of, 300, 1.0, 1, blows=4, ranks=2))
    return found


# ------------------------------------------------------------------ blows

class Broken(Exception):
    """A promise that was not kept."""


def finish(process):
    """Waits for a program; returns its status and its seconds of processor time. An mpirun whose ranks were killed
    sometimes hangs when none of them is left; it is ended then."""
    alone = 0
    while "mpirun" in process.args and alive(process) and alone < 200:
        time.sleep(0.05)
        alone = alone + 1 if events.lost_its_children(process) else 0
    if alone == 200:
        os.kill(process.pid, signal.SIGKILL)
    _, status, usage = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    return process.returncode, usage.ru_utime + usage.ru_stime


def rows_text(path):
    return subprocess.run([FESTOON, "export", path, "--csv"], check=True, capture_output=True).stdout


def measure(kind, folder):
    """Size the sweep so that it lasts long enough here; its rows, its time, its processor time."""
    whole = os.path.join(folder, "whole.db")

    def make(size):
        kind.size = size
        for name in os.listdir(folder):
            os.remove(os.path.join(folder, name))
        began = time.monotonic()
        status, kind.processor = finish(events.start(kind.command(whole)))
        kind.took = time.monotonic() - began
        if status != 0:
            raise Broken(f"{kind.name}: a sweep that nobody killed ended with status {status}")
    kind.size = events.sized(make, kind.seconds, kind.size)
    text = rows_text(whole)
    os.remove(whole)
    return text


def moment(kind, path, rng):
    """The event to wait for before the blow."""
    seen, before = events.rows(path), events.images(path)
    choice = rng.randrange(4)
    if choice == 0:
        return lambda: os.path.exists(path)
    if choice == 1:
        wanted = seen + rng.randrange(1, 2 * kind.size)
        return lambda: events.rows(path) >= wanted
    if choice == 2:
        return lambda: events.images(path) not in (0, before)
    until = time.monotonic() + rng.uniform(0.0, 0.7 * kind.took)
    return lambda: time.monotonic() >= until


def strike(kind, process, rng):
    """Returns one of the ranks, or the program itself."""
    victim = process.pid
    if kind.ranks:
        ranks = events.children_of(process)
        if not ranks:
            return
        victim = rng.choice(ranks)
    try:
        os.kill(victim, kind.number)
    except ProcessLookupError:
        pass


def blow(kind, path, rng):
    """Starts the command (or two at once), strikes, and looks what is left; returns whether it struck, and its
    processor time."""
    process = events.start(kind.ranked(path))
    rival = events.start(kind.command(path)) if kind.raced else None
    happened = moment(kind, path, rng)
    limit = time.monotonic() + events.HANG
    while not happened() and time.monotonic() < limit and alive(process):
        time.sleep(events.POLL)
    committed = events.rows(path)
    strike(kind, process, rng)
    status, processor = finish(process)
    if rival:
        if rng.randrange(2):
            os.kill(rival.pid, signal.SIGKILL)  # its process still exists until it is waited for
        ended, _ = finish(rival)
        kind.refused += ended in (1, 2)
        if ended not in (0, 1, 2, -signal.SIGKILL):
            raise Broken(f"{kind.name}: the second command ended with status {ended}")
    if kind.number == signal.SIGTERM and status not in (0, 130, -signal.SIGTERM):
        raise Broken(f"{kind.name}: status {status} after SIGTERM")
    left = events.rows(path)
    if left < committed:
        raise Broken(f"{kind.name}: {committed} rows were committed, {left} are left")
    struck = status != 0 and not (kind.raced and status in (1, 2))
    if struck:
        kind.committed += committed
        kind.young += committed == 0 and not os.path.exists(path)
    return struck, processor


def alive(process):
    return os.waitid(os.P_PID, process.pid, os.WEXITED | os.WNOHANG | os.WNOWAIT) is None


def journey(kind, path, expected, wanted, rng):
    """Takes one database from its beginning to its end; returns the number of blows that struck."""
    struck, spent = 0, 0.0
    for _ in range(min(kind.blows, wanted)):
        hit, processor = blow(kind, path, rng)
        spent += processor
        struck += hit
        if not hit and not kind.raced:
            break
    status, processor = finish(events.start(kind.command(path)))
    if status != 0:
        raise Broken(f"{kind.name}: the same command ended with status {status}, and did not go on")
    if rows_text(path) != expected:
        raise Broken(f"{kind.name}: other rows than those of a sweep that was never killed")
    kind.kills += struck
    kind.journals += 1
    if not kind.ranks and not kind.raced:
        kind.lost_work += spent + processor - kind.processor
    return struck


def campaign(kind, count, folder, rng):
    expected = measure(kind, folder)
    vain = 0
    while kind.kills < count and vain < 20:
        path = os.path.join(folder, f"{kind.journals}.db")
        vain = 0 if journey(kind, path, expected, count - kind.kills, rng) else vain + 1
        for name in os.listdir(folder):
            os.remove(os.path.join(folder, name))
    work = kind.lost_work / kind.kills / THREADS if kind.kills else 0.0
    print(f"{kind.name}: {kind.kills} blows on {kind.journals} databases, each {kind.took:.2g} s of work; "
          f"{work:.2f} s of work done again a blow and thread, {kind.refused} refused", flush=True)
    # On a shared processor the same work takes times that differ by half, so this much is allowed.
    allowance = 0.5 * kind.processor / max(1.0, kind.kills / max(1, kind.journals)) / THREADS
    if not kind.ranks and not kind.raced and work > MOST_LOST + allowance:
        raise Broken(f"{kind.name}: {work:.2f} s of work lost a kill and thread, more than {MOST_LOST} s")


# ------------------------------------------------------------------ what came of it

def report(done, seed):
    head = ["what is killed", "kills", "databases", "before the file was there", "committed rows before the blows",
            "work done again, a blow and thread"]
    body = []
    for kind in done:
        measured = not kind.ranks and not kind.raced
        body.append([kind.name, kind.kills, kind.journals, kind.young, kind.committed,
                     f"{max(0.0, kind.lost_work / max(1, kind.kills) / THREADS):.2f} s" if measured else "not measured"])
    total = sum(kind.kills for kind in done)
    broken = "; ".join(f"{kind.name} BROKEN: {kind.broken}" for kind in done if kind.broken)
    return (f"`tests/reliability/kills.py --count {total}` (seed {seed}; SIGKILL but where another signal is named). Every "
            f"database was killed several times, while it was made, between rows, after images of runs in flight were "
            f"saved, or anywhere, and then brought to its end by the same command; "
            f"{broken or 'no committed row was lost, and the rows in the end had the same bits'}. Runs in flight were saved after {CHECKPOINT} s "
            f"of work (`--checkpoint`), so at most {MOST_LOST:.2f} s of work of each thread may be done again, and the start of the "
            f"program.\n\n" + section.table(head, body) + "\n")


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--count", type=int, default=500)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--only", default="", help="the kinds whose names contain this")
    parser.add_argument("--write", action="store_true")
    given = parser.parse_args()
    done = [kind for kind in kinds() if given.only in kind.name]
    shares = sum(kind.share for kind in done)
    rng = random.Random(given.seed)
    broken = []
    for kind in done:
        with tempfile.TemporaryDirectory(prefix="festoon-kills-") as folder:
            try:
                campaign(kind, -(-given.count * kind.share // shares), folder, rng)
            except Broken as why:
                kind.broken = str(why)
                broken.append(kind.broken)
                print(f"BROKEN: {why}", flush=True)
    total = sum(kind.kills for kind in done)
    print(f"{total} kills, {len(broken)} promises broken")
    if given.write:
        section.write("kills", report(done, given.seed))
    if total < given.count // 2:
        print("not killed: the programs were over before")
        return 77 if not broken else 1
    return 1 if broken else 0


if __name__ == "__main__":
    sys.exit(main())
