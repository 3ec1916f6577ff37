"""The list of hand-made faults: tests/mutants/ROOM.mutants, one file a room.

An entry is a block, separated from the next one by an empty line:

    [winding-half-turn] fst_winding_add
    # the start exactly at Phi = 180 degrees
    - w->y >= 0
    + w->y > 0
    tests: test_winding test_run
    why: only where nobody notices it: the reason for which this fault may survive

Behind the name stands where the fault is put: in a function, a macro or a table of src/ROOM (of include/festoon, in
tables.mutants), wherever in the room that is, so that a fault stays valid when its function moves.  FILE FUNCTION says
which of several of that name, and FILE alone is for what has no name.  The text behind "-" must stand there exactly
once, and the text behind "+" is what replaces it; without a "+" the old text is taken out.  Several lines of either
belong together.  White space counts as white space, however much there is of it, so that a change of layout leaves an
entry valid.  `tests` are tried first; without them, the tests whose heads name the file.  `why` and the comments may be left out.  A line that begins with ";" is skipped.
"""

import hashlib
import os
import re
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.append(os.path.join(os.path.dirname(HERE), "helpers"))
import heads  # noqa: E402


class Wrong(Exception):
    """An entry that cannot be read, or does not apply."""


def blocks(text):
    """(name, start, end) of every function, macro and table of a file in C: each begins in the first column."""
    found, lines = [], text.splitlines(keepends=True)
    starts = [0]
    for line in lines:
        starts.append(starts[-1] + len(line))
    number = 0
    while number < len(lines):
        first = number
        number += 1
        if lines[first].startswith("#define"):
            while lines[number - 1].endswith("\\\n"):
                number += 1
            name = re.match(r"#define (\w+)", lines[first])
        elif re.match(r"[A-Za-z]", lines[first]):
            while number < len(lines) and not re.search("[;{]", lines[number - 1].partition("/*")[0]) and lines[number].strip():
                number += 1
            head, opened, rest = "".join(lines[first:number]).partition("{")
            if opened and "}" not in rest:
                while number < len(lines) and not lines[number - 1].startswith("}"):
                    number += 1
            name = None if opened or "=" in head else False  # no declaration
            for kind in (r"\b[A-Z][A-Z_]+\((\w+)\)(?=\s*(?:\(|$))", r"(\w+)\(", r"(\w+)(?:\[[^]]*\])*\s*=", r"(\w{7,})\s*$"):
                name = re.search(kind, head) if name is None else name
        else:
            continue
        if name:
            found.append((name[1], starts[first], starts[number]))
    return found


class Source:
    """The files of a tree, read once."""

    def __init__(self, root):
        self.root, self.rooms, self.tests = root, {}, None

    def tests_of(self, path):
        """The tests that name a file of the source at their heads, but the long ones."""
        if self.tests is None:
            self.tests = [(test.stem, heads.behind("tests", test)) for test in heads.tests(self.root)
                          if "long" not in heads.behind("labels", test)]
        return [name for name, files in self.tests if path in files or path.removeprefix("src/") in files]

    def room(self, name):
        """{path in the tree: (text, blocks)} of a room."""
        if name not in self.rooms:
            top = next((path for path in (os.path.join("src", name), name) if os.path.isdir(os.path.join(self.root, path))),
                       os.path.join("include", "festoon"))
            self.rooms[name] = {}
            for folder, _, files in os.walk(os.path.join(self.root, top)):
                for path in sorted(os.path.join(folder, file) for file in files if file.endswith((".c", ".h", ".inl", ".def"))):
                    with open(path, encoding="utf-8") as file:
                        text = file.read()
                    self.rooms[name][os.path.relpath(path, self.root)] = text, blocks(text)
        return self.rooms[name]


class Entry:
    """One fault."""

    def __init__(self, room, name, place):
        self.room, self.name, self.place = room, name, place
        self.path, self.span = None, None  # where it applies: a file of the tree, and from where to where in its text
        self.old, self.new, self.tests, self.comment, self.why = [], [], [], [], []

    def pattern(self):
        """A pattern of the old text that ignores its layout, and in which no word is a part of a longer one."""
        words = " ".join(self.old).split()
        text = r"\s+".join(re.escape(word) for word in words)
        return re.compile((r"(?<!\w)" if re.match(r"\w", words[0]) else "") + text +
                          (r"(?!\w)" if re.search(r"\w$", words[-1]) else ""))

    def find(self, source):
        """Notes the file and the place in it; raises Wrong unless the old text stands there once."""
        file, _, name = self.place.rpartition(" ")
        if "." in name:
            file, name = name, ""
        places = [(path, start, end) for path, (text, found) in source.room(self.room).items()
                  if not file or path.endswith("/" + file)
                  for block, start, end in (found if name else [("", 0, len(text))]) if block == name]
        if not places:
            raise Wrong(f"{self.name}: there is no {self.place} in {self.room}")
        spans = [(path, match.span()) for path, start, end in places
                 for match in self.pattern().finditer(source.room(self.room)[path][0][:end], start)]
        if len(spans) != 1:
            raise Wrong(f"{self.name}: its old text stands {len(spans)} times in {self.place} of {self.room}, not once")
        self.path, self.span = spans[0]
        self.tests = self.tests or source.tests_of(self.path)
        if not self.tests:
            raise Wrong(f"{self.name} names no test, and no test names {self.path}")

    def apply(self, text):
        """The text of the file with the fault in it."""
        start, end = self.span
        after = text[:start] + "\n".join(self.new) + text[end:]
        if after == text:
            raise Wrong(f"{self.name}: it changes nothing in {self.path}")
        return after

    def fingerprint(self):
        """A text that changes if the fault changes."""
        return hashlib.sha256(repr((self.room, self.place, self.old, self.new)).encode()).hexdigest()

    def check(self):
        """Raises Wrong if something is missing."""
        if not self.old:
            raise Wrong(f"{self.room}.mutants: {self.name} needs a line of old text")


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
        head = re.fullmatch(r"\[([a-z0-9-]+)\] ((?:\S+ )?\S+)", line)
        if head:
            entry = Entry(room, head.group(1), head.group(2))
            entries.append(entry)
            continue
        field = re.fullmatch(r"(\w+): (.+)", line)
        if entry is None:
            raise Wrong(f"{room}.mutants:{number}: a block begins with [NAME] FUNCTION, or [NAME] FILE FUNCTION")
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
    order = "base host model ode beads observe lanes study orbit io sweep draw film tracks follow measure fit paper cli tables".split()
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
    """One sentence for each entry that does not apply to the tree; an empty list if all do.  Afterwards each of the others has its place."""
    complaints, tree = [], Source(source)
    for entry in entries:
        try:
            entry.find(tree)
            entry.apply(tree.room(entry.room)[entry.path][0])
        except Wrong as why:
            complaints.append(str(why))
    return complaints
