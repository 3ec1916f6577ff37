"""Bit rot: single bits of a sweep's files are turned over, one at a time, and the file is used.

    rot.py [--count N] [--write] [--seed N]

Half of the flips hit a database that was closed, half one whose sweep was killed, with its log beside it.  Of each half,
a third hit the first pages (the head of the file, its tables, the record of what the sweep is, the head of the log), and
the others any place.  A flip is harmless if the export is the same to the byte, and detected if the export ends with
another status than 0; then no row of an export into a file may differ from what it was.  Afterwards the same sweep command
either comes to the right rows or refuses the file.

Environment: FESTOON, SOURCE_DIR, BUILD_DIR.  Status 1: something was silently wrong.
"""

import os
import random
import shutil
import sys
import tempfile

import section
from sweeps import festoon, good, stopped_at_work, words_of

ENDINGS = ("", "-wal", "-shm")


def content_of(path):
    with open(path, "rb") as file:
        return file.read()


class Subject:
    """The files to be damaged, the rows that they hold, and those of the finished sweep."""

    def __init__(self, name, path, points):
        self.name, self.points = name, points
        self.files = {ending: content_of(path + ending) for ending in ENDINGS if os.path.exists(path + ending)}
        self.rows = self.whole = None

    def put(self, path, ending=None, place=0, bit=0):
        for old in os.listdir(os.path.dirname(path)):
            os.remove(os.path.join(os.path.dirname(path), old))
        for each, content in self.files.items():
            if each == ending:
                content = bytearray(content)
                content[place] ^= 1 << bit
            with open(path + each, "wb") as out:
                out.write(content)

    def choose(self, rng):
        """A file and a place in it."""
        if rng.random() < 1 / 3:
            ending = rng.choice([ending for ending in self.files if ending != "-shm"])
            return ending, rng.randrange(min(len(self.files[ending]), 3 * 4096 if ending == "" else 1024))
        sizes = [(ending, len(content)) for ending, content in self.files.items()]
        place = rng.randrange(sum(size for _, size in sizes))
        for ending, size in sizes:
            if place < size:
                return ending, place
            place -= size
        raise AssertionError


def subjects(folder, points):
    path = os.path.join(folder, "closed.db")
    good(*words_of(points), path)
    closed = Subject("closed", path, points)
    path = os.path.join(folder, "killed.db")
    process, points = stopped_at_work(points, path, points // 4)
    killed = Subject("with a log", path, points)
    process.kill()
    process.wait()
    good(*words_of(points), path)
    for subject, base in ((closed, "closed.db"), (killed, "killed.db")):
        subject.whole = good("export", os.path.join(folder, base), "--csv")
        work = os.path.join(folder, "work")
        os.makedirs(work, exist_ok=True)
        subject.put(os.path.join(work, "a.db"))
        subject.rows = good("export", os.path.join(work, "a.db"), "--csv")
    return closed, killed


def strike(subject, work, ending, place, bit):
    """The effect of one flip on the export and on the sweep that goes on; a sentence if something is silently wrong."""
    path = os.path.join(work, "a.db")
    subject.put(path, ending, place, bit)
    status, out, err = festoon("export", path, "--csv")
    exported = "harmless" if status == 0 else "detected"
    if status == 0 and out != subject.rows:
        return exported, "", "the export changed with status 0"
    if status not in (0, 2) or (status != 0 and (out or "festoon: " not in err)):
        return exported, "", f"the export ended with status {status}: {err}"
    if status != 0:
        subject.put(path, ending, place, bit)
        festoon("export", path, "--csv", "-o", path + ".csv")
        if os.path.exists(path + ".csv"):
            right = set(subject.rows.splitlines())
            wrong = [line for line in content_of(path + ".csv").decode().splitlines() if line not in right]
            if wrong:
                return exported, "", f"the export into a file has a wrong row: {wrong[0][:80]}"
    subject.put(path, ending, place, bit)
    status, _, err = festoon(*words_of(subject.points), path)
    if status not in (0, 2):
        return exported, "", f"the sweep ended with status {status}: {err}"
    if status == 0 and good("export", path, "--csv") != subject.whole:
        return exported, "", "the sweep that went on has other rows"
    return exported, "refused" if status == 2 else "went on", None


def campaign(count, seed, points=120):
    rng = random.Random(seed)
    counts, wrong = {}, []
    with tempfile.TemporaryDirectory(prefix="festoon-rot-") as folder:
        both = subjects(folder, points)
        for i in range(count):
            subject = both[i % 2]
            ending, place = subject.choose(rng)
            bit = rng.randrange(8)
            exported, resumed, problem = strike(subject, os.path.join(folder, "work"), ending, place, bit)
            key = (subject.name, "file" if ending == "" else "log" if ending == "-wal" else "shared memory")
            entry = counts.setdefault(key, dict.fromkeys(("harmless", "detected", "went on", "refused", "wrong"), 0))
            entry[exported] += 1
            if problem:
                entry["wrong"] += 1
                wrong.append(f"{subject.name}{ending}, byte {place}, bit {bit}: {problem}")
                print(wrong[-1], file=sys.stderr, flush=True)
            else:
                entry[resumed] += 1
        shutil.rmtree(os.path.join(folder, "work"))
    return counts, wrong


def report(counts, count, seed, wrong):
    rows = [(name, file, sum(entry[key] for key in ("harmless", "detected")), entry["harmless"], entry["detected"],
             entry["went on"], entry["refused"], entry["wrong"]) for (name, file), entry in sorted(counts.items())]
    return (f"""Promise: a bit that turned over in a sweep's files is never exported as a result and never goes into a row that is
computed later. {count} single bits were turned over (`tests/reliability/rot.py --count {count} --seed {seed}`), in a
closed database and in one whose sweep was killed, with its log. *Harmless*: the export is the same to the byte.
*Detected*: `festoon export` ends with status 2, says so, and an export into a file has no wrong row. Then the same sweep
command went on to the right rows, or refused the file (its head, its tables or its record of what it is a sweep of
were hit). Silently wrong: {len(wrong)}.

""" + section.table(["database", "hit", "flips", "harmless", "detected", "sweep went on", "sweep refused", "silently wrong"],
                    rows))


if __name__ == "__main__":
    sys.exit(section.run("rot", campaign, report))
