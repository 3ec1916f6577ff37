"""The list of hand-made faults: tests/mutants/ROOM.mutants, one file a room.

An entry is a block, separated from the next one by an empty line:

    [winding-half-turn] src/base/winding.h
    # the start exactly at Phi = 180 degrees
    - if (w->y >= 0 && y < 0
    + if (w->y > 0 && y < 0
    tests: test_winding test_run
    why: only where nobody notices it: the reason for which this fault may survive

The lines behind "-" are the old text, which must stand in the file exactly once, and the lines behind "+" are what
replaces it; without a "+" the old text is taken out.  White space counts as white space, however much there is of it,
so that a change of layout leaves an entry valid.  `tests` are tried first, `why` and the comments may be left out.
A line that begins with ";" is skipped.
"""

import hashlib
import os
import re

HERE = os.path.dirname(os.path.abspath(__file__))


class Wrong(Exception):
    """An entry that cannot be read, or does not apply."""


class Entry:
    """One fault."""

    def __init__(self, room, name, path):
        self.room, self.name, self.path = room, name, path
        self.old, self.new, self.tests, self.comment, self.why = [], [], [], [], []

    def pattern(self):
        """A pattern of the old text that ignores its layout."""
        words = " ".join(self.old).split()
        return re.compile(r"\s+".join(re.escape(word) for word in words))

    def apply(self, text):
        """The text of the file with the fault in it."""
        found = [match.span() for match in self.pattern().finditer(text)]
        if len(found) != 1:
            raise Wrong(f"{self.name}: its old text stands {len(found)} times in {self.path}, not once")
        start, end = found[0]
        after = text[:start] + "\n".join(self.new) + text[end:]
        if after == text:
            raise Wrong(f"{self.name}: it changes nothing in {self.path}")
        return after

    def fingerprint(self):
        """A text that changes if the fault changes."""
        return hashlib.sha256(repr((self.path, self.old, self.new)).encode()).hexdigest()

    def check(self):
        """Raises Wrong if something is missing."""
        if not self.path or not self.old:
            raise Wrong(f"{self.room}.mutants: {self.name} needs a file and a line of old text")
        if not self.tests:
            raise Wrong(f"{self.room}.mutants: {self.name} names no test")


FIELDS = {"tests": lambda entry, rest: entry.tests.extend(rest.split()),
          "why": lambda entry, rest: entry.why.append(rest)}


def parse(room, text):
    """The entries of one file."""
    entries, entry = [], None
    for number, line in enumerate(text.splitlines(), 1):
        if not line.strip():
            entry = None
            continue
        if line.startswith(";"):
            continue
        head = re.fullmatch(r"\[([a-z0-9-]+)\] (\S+)", line)
        if head:
            entry = Entry(room, head.group(1), head.group(2))
            entries.append(entry)
            continue
        field = re.fullmatch(r"(\w+): (.+)", line)
        if entry is None:
            raise Wrong(f"{room}.mutants:{number}: a block begins with [NAME] FILE")
        if line[:2] in ("- ", "+ "):
            (entry.old if line[0] == "-" else entry.new).append(line[2:])
        elif line.startswith("# "):
            entry.comment.append(line[2:])
        elif field and field.group(1) in FIELDS:
            FIELDS[field.group(1)](entry, field.group(2))
        else:
            raise Wrong(f"{room}.mutants:{number}: this line begins with none of '- ', '+ ', '# ', 'tests: ', 'why: '")
    return entries


def read_all(folder=HERE):
    """Every entry, room by room in the order of the rooms."""
    order = "base host model ode observe lanes study orbit io sweep draw film paper cli tables".split()
    files = [name for name in os.listdir(folder) if name.endswith(".mutants")]
    rooms = sorted((name[:-len(".mutants")] for name in files), key=lambda room: (room not in order, room)
                   if room not in order else (False, f"{order.index(room):02}"))
    entries = []
    for room in rooms:
        with open(os.path.join(folder, room + ".mutants"), encoding="utf-8") as file:
            entries += parse(room, file.read())
    for entry in entries:
        entry.check()
    names = [entry.name for entry in entries]
    twice = sorted({name for name in names if names.count(name) > 1})
    if twice:
        raise Wrong(f"these names stand for more than one fault: {' '.join(twice)}")
    return entries


def stale(entries, source):
    """One sentence for each entry that does not apply to the tree; an empty list if all do."""
    complaints, texts = [], {}
    for entry in entries:
        try:
            if entry.path not in texts:
                with open(os.path.join(source, entry.path), encoding="utf-8") as file:
                    texts[entry.path] = file.read()
            entry.apply(texts[entry.path])
        except (OSError, Wrong) as why:
            complaints.append(str(why))
    return complaints
