"""The lane engines, and the sum over all pairs of beads, are compiled with -O3 whatever the flags of the build: a
distribution's -O2 does not undo it.

Configures the library alone with CMAKE_C_FLAGS=-O2 and no build type, and looks at the commands that would be run: of
several -O options the last one counts.  Builds for debugging and sanitizers keep their own.

tests: lanes/lanes_avx2.c lanes/lanes_avx512.c lanes/lanes_portable4.c lanes/lanes_portable8.c
  lanes/dry_lanes_avx2.c lanes/dry_lanes_avx512.c lanes/dry_lanes_portable4.c lanes/dry_lanes_portable8.c
labels: tree"""

import json
import os
import re
import subprocess
import sys
import tempfile

SOURCE = os.environ["SOURCE_DIR"]
PAIRS = re.compile(r"/beads/dipoles\.c$")
ENGINE = re.compile(r"/(?:dry_)?lanes_(avx2|avx512|portable4|portable8)\.c$")


def commands(build_type, flags, *options):
    """The command that compiles each source file."""
    with tempfile.TemporaryDirectory() as folder:
        made = subprocess.run(["cmake", "-S", SOURCE, "-B", folder, "-DFESTOON_TOOLS=OFF", "-DFESTOON_TESTS=OFF",
                               f"-DCMAKE_BUILD_TYPE={build_type}", f"-DCMAKE_C_FLAGS={flags}", *options],
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)
        assert made.returncode == 0, made.stdout
        with open(os.path.join(folder, "compile_commands.json"), encoding="utf-8") as file:
            return {entry["file"]: entry["command"].split() for entry in json.load(file)}


def last_level(words):
    """The -O option that takes effect: the last one."""
    return [word for word in words if re.fullmatch(r"-O\w*", word)][-1]


def test_engines_keep_their_level():
    """-O3 in the engines, the build's own level in all other files; in a debug build everywhere."""
    levels = {path: last_level(words) for path, words in commands("None", "-O2").items()}
    engines = [path for path in levels if ENGINE.search(path)]
    if not engines:
        print("this processor has no lane engines: skipped")
        sys.exit(77)
    assert len(engines) == 8, engines
    for path, level in levels.items():
        assert level == ("-O3" if path in engines or PAIRS.search(path) else "-O2"), f"{path}: {level}"
    for build in ("Debug", "-Og"), ("None", "-Og", "-DFESTOON_SANITIZE=address,undefined"):
        for path, words in commands(*build).items():
            assert last_level(words) == "-Og", f"{path}: {last_level(words)} in the build {build}"


if __name__ == "__main__":
    for name, test in list(globals().items()):
        if name.startswith("test_"):
            test()
            print("ok", name)
