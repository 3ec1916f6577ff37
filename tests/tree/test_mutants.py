"""The list of hand-made faults (tests/mutants) still fits the tree: each applies once, and its tests are there.

`make mutants` puts the faults in and counts which ones the tests notice.

labels: tree"""

import os
import pathlib
import sys
import tempfile

SOURCE = os.environ["SOURCE_DIR"]
sys.path.insert(0, os.path.join(SOURCE, "tests", "mutants"))
import entries as listed  # noqa: E402
import heads  # noqa: E402

LEAST = 150
ROOMS = {path.name for path in pathlib.Path(SOURCE, "src").iterdir() if path.is_dir()} | {"tables"} | \
    {path.name for path in [pathlib.Path(SOURCE, "paper")] if path.is_dir()}
PHYSICS = {"model", "ode", "beads", "observe", "lanes", "study", "orbit"}
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


def test_the_tests_are_there():
    """The likely tests of each fault exist, and none is a long one."""
    known = OTHER_TESTS | {path.stem for path in pathlib.Path(SOURCE, "tests").rglob("*_*.*")
                           if path.name.startswith(("test_", "fuzz_")) and path.suffix in (".c", ".py")
                           and "long" not in heads.behind("labels", path)}
    entries = listed.read_all()
    assert not listed.stale(entries, SOURCE)
    missing = {f"{name} (of {entry.name})" for entry in entries for name in entry.tests if name not in known}
    assert not missing, f"no such quick tests: {', '.join(sorted(missing))}"


def test_what_no_longer_fits_is_reported():
    """Complaints about a function or an old text that is gone, or stands twice, a fault that changes nothing, and
    malformed blocks.  A text counts only in its function, wherever that stands in the room."""
    block = "[one] second\n# a comment\n- a  <\n- b\n+ a > b\ntests: test_x\nwhy: no reason\n"
    (entry,) = listed.parse("base", block)
    assert (entry.tests, entry.why, entry.comment) == (["test_x"], ["no reason"], ["a comment"])
    with tempfile.TemporaryDirectory() as folder:
        room = pathlib.Path(folder, "src", "base")
        room.mkdir(parents=True)
        (room / "other.c").write_text("int first(int a)\n{\n    return a < b;\n}\n")
        for text, complaints in (("a <\n        b", 0), ("a > b", 1), ("a < b || a < b", 1), ("", 1), ("aa < b", 1)):
            (room / "file.c").write_text(f"int second(void);\n\nint second(int a)\n{{\n    return {text};\n}}\n")
            assert len(listed.stale([entry], folder)) == complaints, text
        (room / "file.c").write_text("#define second(a) \\\n    (a < b)\n")
        assert not listed.stale([entry], folder) and entry.path == "src/base/file.c"
        assert entry.apply((room / "file.c").read_text()) == "#define second(a) \\\n    (a > b)\n"
        (room / "twice.c").write_text("#define second(a) (a < b)\n")
        assert len(listed.stale([entry], folder)) == 1
        (entry,) = listed.parse("base", block.replace("second", "file.c second"))
        assert not listed.stale([entry], folder)
        (same,) = listed.parse("base", "[same] other.c\n- a <\n+ a <\ntests: test_x\n")
        assert len(listed.stale([same], folder)) == 1
        (named,) = listed.parse("base", "[named] other.c\n- a <\n+ a >\n")
        assert len(listed.stale([named], folder)) == 1 and not named.tests
        test = pathlib.Path(folder, "tests", "base", "test_other.c")
        test.parent.mkdir(parents=True)
        test.write_text("/* Others.\n * tests: base/file.c\n *   base/other.c */\n")
        assert not listed.stale([named], folder) and named.tests == ["test_other"]
    for bad in ("- a\n", "[one] file.c\nold: a\n", "[One] file.c\n- a\n", "[one] file.c a b\n- a\n"):
        try:
            listed.parse("base", bad)
        except listed.Wrong:
            continue
        raise AssertionError(f"this was read: {bad!r}")
    (entry,) = listed.parse("base", "[one] file.c\ntests: test_x\n")
    try:
        entry.check()
    except listed.Wrong:
        return
    raise AssertionError("no old text was missing")


for name, test in list(globals().items()):
    if name.startswith("test_"):
        test()
        print("ok", name)
