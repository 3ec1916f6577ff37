"""What stands at the heads of tests: "tests:" and the files that it tests, "labels:" and what is special about it."""

import pathlib
import re


def behind(word, path):
    """The words behind "tests:" or "labels:"; the lines that go on are indented."""
    found = re.search(rf"^( \* )?{word}:(.*(\n( \*)?  +\S.*)*)", path.read_text(encoding="utf-8"), re.M)
    return re.sub(r"(^|\s)\*/?(?=\s|$)|\"", " ", found[2]).split() if found else []


def tests(source):
    """All tests of a tree."""
    return sorted(path for path in pathlib.Path(source, "tests").rglob("test_*.*") if path.suffix in (".c", ".py"))
