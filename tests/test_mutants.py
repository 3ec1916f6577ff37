"""The list of hand-made faults (tests/mutants) still fits the tree: each applies once, and its tests are there.

Environment: SOURCE_DIR the source tree.  `make mutants` puts the faults in and counts which ones the tests notice.
"""

import os
import sys
import tempfile

SOURCE = os.environ["SOURCE_DIR"]
sys.path.insert(0, os.path.join(SOURCE, "tests", "mutants"))
import entries as listed  # noqa: E402

LEAST = 150
ROOMS = {"base", "host", "model", "ode", "observe", "lanes", "study", "orbit", "io", "sweep", "draw", "film", "paper",
         "cli", "tables", "track"}
PHYSICS = {"model", "ode", "observe", "lanes", "study", "orbit"}
OTHER_TESTS = {"includes", "headers", "exports", "installed"}


def test_the_list_fits_the_tree():
    """Every old text stands once in its file, every room has faults, and the physics rooms most of them."""
    entries = listed.read_all()
    complaints = listed.stale(entries, SOURCE)
    assert not complaints, "\n".join(complaints)
    assert len(entries) >= LEAST, f"{len(entries)} faults, {LEAST} are wanted"
    rooms = [entry.room for entry in entries]
    assert set(rooms) == ROOMS, f"rooms without faults, or unknown ones: {set(rooms) ^ ROOMS}"
    physics = sum(room in PHYSICS for room in rooms)
    assert 2 * physics > len(rooms), f"{physics} of {len(rooms)} faults are in the physics rooms"
    for entry in entries:
        folder = "include/festoon/" if entry.room == "tables" else f"src/{entry.room}/"
        assert entry.path.startswith(folder), f"{entry.name} lies in {entry.path}, not in {folder}"


def test_the_tests_are_there():
    """The likely tests of each fault exist, and none is a long one."""
    files = os.listdir(os.path.join(SOURCE, "tests")) + os.listdir(os.path.join(SOURCE, "tests", "fuzz"))
    known = OTHER_TESTS | {os.path.splitext(name)[0] for name in files if name.startswith(("test_", "fuzz_"))}
    missing = {f"{name} (of {entry.name})" for entry in listed.read_all() for name in entry.tests
               if name not in known or "_long" in name}
    assert not missing, f"no such quick tests: {', '.join(sorted(missing))}"


def test_what_no_longer_fits_is_reported():
    """Complaints about an old text that is gone or stands twice, a fault that changes nothing, and malformed blocks."""
    block = "[one] file.c\n# a comment\n- a  <\n- b\n+ a > b\ntests: test_x\nwhy: no reason\n"
    (entry,) = listed.parse("base", block)
    assert entry.apply("if (a <\n        b)\n") == "if (a > b)\n"
    assert (entry.tests, entry.why, entry.comment) == (["test_x"], ["no reason"], ["a comment"])
    with tempfile.TemporaryDirectory() as folder:
        for text, complaints in (("a < b", 0), ("a > b", 1), ("a < b; a < b", 1), ("", 1)):
            with open(os.path.join(folder, "file.c"), "w", encoding="utf-8") as file:
                file.write(text)
            assert len(listed.stale([entry], folder)) == complaints, text
        os.unlink(os.path.join(folder, "file.c"))
        assert len(listed.stale([entry], folder)) == 1
        (same,) = listed.parse("base", "[same] file.c\n- a\n+ a\ntests: test_x\n")
        with open(os.path.join(folder, "file.c"), "w", encoding="utf-8") as file:
            file.write("a")
        assert len(listed.stale([same], folder)) == 1
    for bad in ("- a\n", "[one] file.c\nold: a\n", "[One] file.c\n- a\n"):
        try:
            listed.parse("base", bad)
        except listed.Wrong:
            continue
        raise AssertionError(f"this was read: {bad!r}")
    for lacking in ("[one] file.c\ntests: test_x\n", "[one] file.c\n- a\n"):
        (entry,) = listed.parse("base", lacking)
        try:
            entry.check()
        except listed.Wrong:
            continue
        raise AssertionError(f"nothing was missing in {lacking!r}")


for name, test in list(globals().items()):
    if name.startswith("test_"):
        test()
        print("ok", name)
