"""Bit rot: single bits of a sweep's files are turned over, one at a time, and the file is used.

    rot.py [--count N] [--write] [--seed N]

Two fifths of the flips hit a database that was closed, two fifths one whose sweep was killed, with its log beside it.  Of
these, a third hit the first pages (the head of the file, its tables, the record of what the sweep is, the head of the
log), and the others any place.  A flip is harmless if the export is the same to the byte, and detected if the export ends
with another status than 0; then no row of an export into a file may differ from what it was.  Afterwards the same sweep
command either comes to the right rows or refuses the file.  One fifth hits images of runs that were not over when their
sweep was killed, behind the checksums of the log: a bit of one is turned over, or two change places; that is detected if
the sweep says how many it could not use.

Environment: FESTOON, SOURCE_DIR, BUILD_DIR.  Status 1: something was silently wrong.
"""

import os
import random
import shutil
import sqlite3
import sys
import tempfile

import events
import section
from sweeps import FESTOON, festoon, good, stopped_at_work, words_of

ENDINGS = ("", "-wal", "-shm")


def content_of(path):
    with open(path, "rb") as file:
        return file.read()


class Subject:
    """The files to be damaged, the rows that they hold, and those of the finished sweep."""

    def __init__(self, name, path, words):
        self.name, self.words = name, words
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


def long_words(periods):
    """A sweep of few runs of this length, with images of them."""
    return ["sweep", "--set", f"run.periods={periods}", "--set", "run.discard=4", "--over", "drive.frequency=9Hz:20Hz:6",
            "--threads", "2", "--checkpoint", "0.02", "-o"]


def killed_with_images(path):
    """Kills a sweep when images of two runs or more are saved; returns its words."""
    def blow(periods):
        return events.kill_when([FESTOON, *long_words(periods), path],
                                lambda: (events.ask(path, "SELECT count(*) FROM checkpoints") or 0) >= 2)
    return long_words(events.struck(blow, 400))


def subjects(folder, points):
    paths = [os.path.join(folder, name) for name in ("closed.db", "killed.db", "images.db")]
    good(*words_of(points), paths[0])
    found = [Subject("closed", paths[0], words_of(points))]
    process, points = stopped_at_work(points, paths[1], points // 4)
    found.append(Subject("with a log", paths[1], words_of(points)))
    process.kill()
    process.wait()
    words = killed_with_images(paths[2])
    found.append(Subject("with images", paths[2], words))
    work = os.path.join(folder, "work")
    os.makedirs(work)
    for subject, path in zip(found, paths):
        good(*subject.words, path)
        subject.whole = good("export", path, "--csv")
        subject.put(os.path.join(work, "a.db"))
        subject.rows = festoon("export", os.path.join(work, "a.db"), "--csv")[1]
    return found


def alter_images(path, rng):
    """Turns over a bit of one image, its size or its checksum, or exchanges two; returns what was hit, and how many."""
    with sqlite3.connect(path) as base:
        images = [list(row) for row in base.execute("SELECT size, checksum, image, point FROM checkpoints")]
        first, second = rng.sample(images, 2)
        exchanged = rng.random() < 0.25
        if exchanged:
            first[3], second[3] = second[3], first[3]
        else:
            member, bit = rng.choice((0, 1, 2, 2)), rng.randrange(63)
            if member < 2:
                first[member] ^= 1 << bit
            else:
                spoilt = bytearray(first[2])
                spoilt[rng.randrange(len(spoilt))] ^= 1 << bit % 8
                first[2] = bytes(spoilt)
        base.executemany("UPDATE checkpoints SET size = ?, checksum = ?, image = ? WHERE point = ?", images)
    base.close()
    return ("two images change places", 2) if exchanged else ("an image", 1)


def strike_images(subject, work, rng):
    """The same as strike() for an image; what was hit besides."""
    path = os.path.join(work, "a.db")
    subject.put(path)
    what, count = alter_images(path, rng)
    if festoon("export", path, "--csv")[1] != subject.rows:
        return what, "detected", "", "the export changed"
    status, _, err = festoon(*subject.words, path)
    if status != 0 or good("export", path, "--csv") != subject.whole:
        return what, "detected", "", f"the sweep that went on has other rows, or status {status}: {err}"
    told = f"what was saved of unfinished runs was damaged: {count} are made anew" in err
    return what, "detected", "went on", None if told else "the sweep says nothing of it"


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
    status, _, err = festoon(*subject.words, path)
    if status not in (0, 2):
        return exported, "", f"the sweep ended with status {status}: {err}"
    if status == 0 and good("export", path, "--csv") != subject.whole:
        return exported, "", "the sweep that went on has other rows"
    return exported, "refused" if status == 2 else "went on", None


def campaign(count, seed, points=120):
    rng = random.Random(seed)
    counts, wrong = {}, []
    with tempfile.TemporaryDirectory(prefix="festoon-rot-") as folder:
        closed, killed, images = subjects(folder, points)
        work = os.path.join(folder, "work")
        for i in range(count):
            subject = (closed, killed, closed, killed, images)[i % 5]
            if subject is images:
                where, exported, resumed, problem = strike_images(subject, work, rng)
            else:
                ending, place, bit = *subject.choose(rng), rng.randrange(8)
                where = {"": "file", "-wal": "log", "-shm": "shared memory"}[ending]
                exported, resumed, problem = strike(subject, work, ending, place, bit)
            key = (subject.name, where)
            entry = counts.setdefault(key, dict.fromkeys(("harmless", "detected", "went on", "refused", "wrong"), 0))
            entry[exported] += 1
            if problem:
                entry["wrong"] += 1
                wrong.append(f"{subject.name}, {where}, {'' if subject is images else f'byte {place}, bit {bit}'}: {problem}")
                print(wrong[-1], file=sys.stderr, flush=True)
            else:
                entry[resumed] += 1
        shutil.rmtree(work)
    return counts, wrong


def report(counts, count, seed, wrong):
    rows = [(name, file, sum(entry[key] for key in ("harmless", "detected")), entry["harmless"], entry["detected"],
             entry["went on"], entry["refused"], entry["wrong"]) for (name, file), entry in sorted(counts.items())]
    return (f"""Promise: a bit that turned over in a sweep's files is never exported as a result and never goes into a row that is
computed later. {count} single bits were turned over (`tests/reliability/rot.py --count {count} --seed {seed}`), in a
closed database, in one whose sweep was killed, with its log, and in images of runs that were not over then, which may
also change places; the sweep says that it makes such runs anew. *Harmless*: the export is the same to the byte.
*Detected*: `festoon export` ends with status 2, says so, and an export into a file has no wrong row. Then the same sweep
command went on to the right rows, or refused the file (its head, its tables or its record of what it is a sweep of
were hit). Silently wrong: {len(wrong)}.

""" + section.table(["database", "hit", "flips", "harmless", "detected", "sweep went on", "sweep refused", "silently wrong"],
                    rows))


if __name__ == "__main__":
    sys.exit(section.run("rot", campaign, report))
