"""Loss of power: the states in which it may leave a disk, built from what a sweep asked of the file system.

    power.py [--count N] [--write] [--seed N]

A sweep runs with a recorder before the C library (tests/preload/disk_recorder.c).  From its log and a moment in it, a
state of the disk is built: whatever was synced is there; of the writes since, none, all, those before some moment, or any
of them, each whole or in pieces of 512 bytes; of the names that were made, changed or removed since their folder was
synced likewise.  Then `festoon export` must have at least the rows that were readable when the last sync before that
moment was over, with the same bits, and `festoon sweep` must come to the rows of an undisturbed sweep.

Environment: FESTOON, SOURCE_DIR, BUILD_DIR.  Status 1: a promise was broken; 77: no recorder (sanitizers).
"""

import os
import random
import shutil
import sqlite3
import subprocess
import sys
import tempfile

import section
from sweeps import FESTOON, festoon, good

TESTS = os.path.join(os.environ["BUILD_DIR"], "tests")
RECORDER = os.path.join(TESTS, "disk_recorder.so")
SECTOR = 512


def words(points, *more):
    return ["sweep", "--set", "run.periods=0.01", "--set", "run.discard=0.001", "--threads", "2", "--over",
            f"drive.frequency=5Hz:20Hz:{points}", *more, "-o"]


# ---------------------------------------------------------------------------------------------------- the record

def read_log(path):
    """The entries of a record: (kind, ...)."""
    with open(path, "rb") as file:
        text = file.read()
    entries, at = [], 0
    while at < len(text):
        end = text.index(b"\n", at)
        kind, rest = text[at:at + 1].decode(), text[at + 2:end].decode()
        at = end + 1
        if kind == "W":
            inode, place, size = map(int, rest.split())
            entries.append(("W", inode, place, text[at:at + size]))
            at += size
        elif kind in "TC":
            inode, value = rest.split(" ", 1)
            entries.append((kind, int(inode), int(value) if kind == "T" else value))
        elif kind == "S":
            entries.append((kind, int(rest)))
        elif kind in "RL":
            end = text.index(b"\n", at)
            entries.append((kind, rest, text[at:end].decode()))
            at = end + 1
        else:
            entries.append((kind, rest))
    return entries


class File:
    """What is on the disk for sure, and what was asked for since."""

    def __init__(self, content=b""):
        self.safe, self.asked = bytearray(content), []

    def sync(self):
        self.safe, self.asked = self.content(self.asked), []

    def content(self, asked):
        content = bytearray(self.safe)
        for entry in asked:
            if entry[0] == "T":
                content = content[:entry[1]] + bytes(max(0, entry[1] - len(content)))
            else:
                place, data = entry[1:]
                content += bytes(max(0, place + len(data) - len(content)))
                content[place:place + len(data)] = data
        return content


class Disk:
    """The disk after some entries of a record; a file system may give the number of a removed file to the next one."""

    def __init__(self, names):
        self.files = {}                                                   # inode of the record: File
        self.safe = {name: File(content) for name, content in names.items()}
        self.names, self.asked = dict(self.safe), []                      # names now; operations since the sync

    def do(self, entry):
        kind = entry[0]
        if kind == "C":
            self.files[entry[1]] = File()
            self.rename(("C", entry[2], self.files[entry[1]]))
        elif kind in "WT":
            if entry[1] in self.files:
                self.files[entry[1]].asked.append((kind, *entry[2:]))
        elif kind == "S":
            if entry[1] in self.files:
                self.files[entry[1]].sync()
        elif kind == "D":
            self.safe, self.asked = dict(self.names), []
        else:
            self.rename(entry)

    def rename(self, entry):
        self.asked.append(entry)
        apply_name(self.names, entry)

    def whole(self):
        return {name: file.content(file.asked) for name, file in self.names.items()}

    def state(self, rng):
        """One of the states that a loss of power may leave now."""
        how = rng.choice(("none", "all", "before", "any", "any", "torn", "torn"))
        names = dict(self.safe)
        for entry in chosen(self.asked, rng.choice(("none", "all", "before", "any")), rng):
            apply_name(names, entry)
        return {name: file.content(tear(chosen(file.asked, how, rng), how, rng)) for name, file in names.items()}


def apply_name(names, entry):
    if entry[0] == "C":
        names[entry[1]] = entry[2]
    elif entry[0] == "U":
        names.pop(entry[1], None)
    elif entry[1] in names:
        names[entry[2]] = names[entry[1]]
        if entry[0] == "R":
            del names[entry[1]]


def chosen(asked, how, rng):
    if how == "none":
        return []
    if how == "all":
        return list(asked)
    if how == "before":
        return asked[:rng.randint(0, len(asked))]
    share = rng.random()
    return [entry for entry in asked if rng.random() < share]


def tear(asked, how, rng):
    """Keeps only some sectors of some writes."""
    if how != "torn":
        return asked
    torn = []
    for entry in asked:
        if entry[0] != "W" or rng.random() < 0.5:
            torn.append(entry)
            continue
        _, place, data = entry
        at = 0
        while at < len(data):
            end = min(len(data), at + SECTOR - (place + at) % SECTOR)
            if rng.random() < 0.5:
                torn.append(("W", place + at, data[at:end]))
            at = end
    return torn


# ---------------------------------------------------------------------------------------------------- scenes

def put(folder, names):
    shutil.rmtree(folder, ignore_errors=True)
    os.makedirs(folder)
    for name, content in names.items():
        with open(os.path.join(folder, os.path.basename(name)), "wb") as out:
            out.write(content)


def contents(folder):
    found = {}
    for name in os.listdir(folder):
        with open(os.path.join(folder, name), "rb") as file:
            found[os.path.join(folder, name)] = file.read()
    return found


class NoExport(Exception):
    pass


class Scene:
    """A recorded sweep."""

    def __init__(self, name, folder, points, before=None, far=False):
        self.name, self.folder, self.words = name, os.path.join(folder, "disk"), words(points)
        self.path = os.path.join(self.folder, "a.db")
        self.preloaded = [os.path.join(TESTS, "far_away.so")] if far else []
        self.environment = dict(os.environ, LD_PRELOAD=" ".join(self.preloaded)) if far else dict(os.environ)
        whole = os.path.join(folder, "whole.db")
        good(*self.words, whole)
        self.whole = good("export", whole, "--csv")
        os.remove(whole)
        put(self.folder, {})
        if before:
            before(self.path, points)
        self.before = contents(self.folder)
        self.entries = self.record(os.path.join(folder, "record"))
        self.promised = {}

    def record(self, log):
        if os.path.exists(log):
            os.remove(log)
        # A file that is there is rewritten first, so that the record has all files from their creation on.
        preloaded = [RECORDER, *self.preloaded]
        environment = dict(os.environ, LD_PRELOAD=" ".join(preloaded), DISK_FOLDER=self.folder, DISK_LOG=log)
        inodes = {os.stat(name).st_ino: name for name in self.before}
        done = subprocess.run([FESTOON, *self.words, self.path], env=environment, stdin=subprocess.DEVNULL,
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE, timeout=600)
        if done.returncode != 0:
            sys.exit(f"{self.name}: the recorded sweep ended with status {done.returncode}: {done.stderr.decode()}")
        self.inodes = inodes
        return read_log(log)

    def disk(self, moment):
        disk = Disk(self.before)
        for inode, name in self.inodes.items():
            disk.files[inode] = disk.names[name]
        for entry in self.entries[:moment]:
            disk.do(entry)
        return disk

    def rows_promised(self, moment):
        """The rows that could be read when the last sync before this moment was over."""
        while moment > 0 and self.entries[moment - 1][0] not in "SD":
            moment -= 1
        if moment not in self.promised:
            put(self.folder, self.disk(moment).whole())
            self.promised[moment] = self.rows_of() if os.path.exists(self.path) else set()
        return self.promised[moment]

    def rows_of(self):
        """The rows of an export into a file, sound ones alone where the status says that some are lost."""
        out = self.path + ".csv"
        status, _, err = festoon("export", self.path, "--csv", "-o", out, env=self.environment)
        if not os.path.exists(out):
            raise NoExport(f"no export, status {status}: {err}")
        with open(out, encoding="utf-8") as file:
            rows = set(file.read().splitlines()[1:])
        os.remove(out)
        return rows

    def strike(self, moment, rng):
        """A sentence if something is wrong after a loss of power at this moment, else None."""
        promised = self.rows_promised(moment)
        state = self.disk(moment).state(rng)
        put(self.folder, state)
        if os.path.exists(self.path):
            try:
                rows = self.rows_of()
            except NoExport as problem:
                return str(problem)
            if not promised <= rows:
                return f"{len(promised - rows)} rows are lost"
            if not rows <= set(self.whole.splitlines()):
                return "a row is wrong"
        elif promised:
            return "the database is lost"
        put(self.folder, state)
        status, _, err = festoon(*self.words, self.path, env=self.environment)
        if status != 0:
            return f"the sweep did not go on, status {status}: {err}"
        status, out, err = festoon("export", self.path, "--csv", env=self.environment)
        if out != self.whole:
            return f"the sweep that went on has other rows, status {status}: {err}"
        return None


def half_done(path, points):
    """A closed database in which half the rows are missing."""
    good(*words(points), path)
    base = sqlite3.connect(path)
    base.execute("DELETE FROM rows WHERE point % 2 = 0")
    base.commit()
    base.close()


def stale_log(path, points):
    """The log of a database that was deleted."""
    other = path + ".other"
    good(*words(points, "--set", "start.r=0.9"), other)
    base = sqlite3.connect(other)
    base.execute("PRAGMA wal_autocheckpoint = 0")
    base.execute("UPDATE rows SET mean_r = 9")
    base.execute("UPDATE seal SET commits = 99")
    base.commit()
    shutil.copy(other + "-wal", path + "-wal")
    base.close()
    os.remove(other)


def scenes(folder):
    yield Scene("new", folder, 1500)
    yield Scene("gone on with", folder, 1500, half_done)
    yield Scene("new, beside the log of a deleted one", folder, 800, stale_log)
    yield Scene("long (the log is emptied under way)", folder, 6000)
    yield Scene("on a network file system", folder, 1500, far=True)


def is_sensitive(folder, seed):
    """Whether the attack would find a program that never syncs: its record is this one without the syncs of files,
    its promises are the same."""
    scene, rng = Scene("never synced", folder, 800), random.Random(seed)
    for moment in range(len(scene.entries) + 1):
        scene.rows_promised(moment)
    sync, File.sync = File.sync, lambda file: None
    try:
        return any(scene.strike(rng.randint(0, len(scene.entries)), rng) for _ in range(40))
    finally:
        File.sync = sync


def campaign(count, seed):
    rng = random.Random(seed)
    rows, wrong = [], []
    with tempfile.TemporaryDirectory(prefix="festoon-power-") as folder:
        folder = os.path.realpath(folder)
        if not is_sensitive(folder, seed):
            sys.exit("the simulation finds nothing wrong with a program that never syncs")
        names = 5
        for place, scene in enumerate(scenes(folder)):
            states = count // names + (place < count % names)
            broken = 0
            synced = [i + 1 for i, entry in enumerate(scene.entries) if entry[0] == "S"]
            for state in range(states):
                # Every other one just after a file was synced: what is promised then, and what names may lead to.
                moment = rng.choice(synced) if state % 2 else rng.randint(0, len(scene.entries))
                problem = scene.strike(moment, rng)
                if problem:
                    broken += 1
                    wrong.append(f"{scene.name}, after {moment} of {len(scene.entries)} requests: {problem}")
                    print(wrong[-1], file=sys.stderr, flush=True)
            syncs = sum(entry[0] in "SD" for entry in scene.entries)
            rows.append((scene.name, len(scene.entries), syncs, states, broken))
    return rows, wrong


def report(rows, count, seed, wrong):
    return (f"""Promise: a loss of power at any moment costs no row that was committed (`festoon export` has it, with the same bits), and the
same sweep command comes to the rows of an undisturbed sweep. {count} states of the disk were built from the recorded
requests of sweeps to the file system (`tests/reliability/power.py --count {count} --seed {seed}`): all that was synced,
and of the writes and the changes of names since then none, all, the first, or any, whole or in sectors of 512 bytes. The same
attack finds rows lost by a program that never syncs. Not simulated: disks that say synced when they have not, and file systems that lose what was synced. Broken promises: {len(wrong)}.

""" + section.table(["sweep", "requests", "of them syncs", "states", "promise broken"], rows))


def main():
    if not os.path.exists(RECORDER):
        print("skipped: nothing can be preloaded into a program with sanitizers")
        return 77
    return section.run("power", campaign, report)


if __name__ == "__main__":
    sys.exit(main())
