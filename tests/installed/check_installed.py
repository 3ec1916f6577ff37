#!/usr/bin/env python3
"""Install festoon into a temporary DESTDIR, move the tree, and use it as somebody else would.

    check_installed.py CMAKE GENERATOR PREFIX C_COMPILER [C++_COMPILER]

Environment: SOURCE_DIR, BUILD_DIR.  An outside C program and an outside C++ program are built by pkg-config and by
find_package(festoon) and run; so are the installed examples in C, by the line that stands in each, and the first program
of docs/api.md; the installed program runs, its manual page is there, and the module for HDF5 is found where it was
installed.
"""
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

CMAKE, GENERATOR, PREFIX, C_COMPILER = sys.argv[1:5]
CXX_COMPILER = sys.argv[5] if len(sys.argv) > 5 else None
SOURCES = pathlib.Path(os.environ["SOURCE_DIR"]) / "tests" / "installed"
BUILD_DIR = pathlib.Path(os.environ["BUILD_DIR"])


def run(*command, **changes):
    """Run a command with changed environment variables; its standard output, or an exception that shows all."""
    words = [str(word) for word in command]
    done = subprocess.run(words, capture_output=True, text=True, env={**os.environ, **changes}, check=False)
    print("$", *words)
    print(done.stdout + done.stderr, end="", flush=True)
    if done.returncode != 0:
        raise SystemExit(f"status {done.returncode}")
    return done.stdout


def install(scratch):
    """The installed tree's prefix, moved away from where it was installed."""
    run(CMAKE, "--install", BUILD_DIR, DESTDIR=str(scratch / "stage"))
    staged = scratch / "stage" / PREFIX.lstrip("/")
    moved = scratch / "moved"
    shutil.move(staged, moved)
    return moved


def only(prefix, pattern):
    """The one file under `prefix` that matches."""
    found = list(prefix.rglob(pattern))
    if len(found) != 1:
        raise SystemExit(f"{pattern}: expected one file, found {found}")
    return found[0]


def check_tree(prefix):
    """The program runs from the moved tree, with its libraries, its module and its manual page."""
    program = only(prefix, "bin/festoon")
    print("version:", run(program, "--version"), flush=True)
    for place in ("share/bash-completion/completions/festoon", "share/zsh/site-functions/_festoon",
                  "share/fish/vendor_completions.d/festoon.fish", "share/doc/festoon/examples/paper-10.7Hz.yaml",
                  "share/doc/festoon/examples/c/run.c", "share/doc/festoon/LICENSE"):
        if not (prefix / place).is_file():
            raise SystemExit(f"{place} is not installed")
    run(program, "check", prefix / "share/doc/festoon/examples/paper-19.9Hz.yaml")
    if "reproduced" not in run(program, "paper", "--statements"):
        raise SystemExit("festoon paper --statements, of its own program, lists no statement")
    manual = only(prefix, "festoon.1").read_text(encoding="utf-8")
    for word in ("bead.radius", "mean_alpha_dot"):
        if word not in manual.replace("\\-", "-"):
            raise SystemExit(f"the manual page does not mention {word}")
    if (BUILD_DIR / "festoon-hdf5.so").exists():
        only(prefix, "festoon/festoon-hdf5.so")
        trajectory = prefix / "short.h5"
        run(program, "run", "--set", "run.periods=2", "--set", "run.discard=1", "-o", trajectory)
        if not trajectory.exists():
            raise SystemExit("festoon run -o short.h5 wrote no file")


def check_pkg_config(prefix, scratch):
    """Both programs built by the compiler's own command line."""
    pkg_config_path = str(only(prefix, "festoon.pc").parent)
    library_path = str(only(prefix, "libfestoon.so").parent)
    programs = [("festoon", C_COMPILER, "-std=c11", "outside.c")]
    if CXX_COMPILER:
        programs.append(("festoon-tools", CXX_COMPILER, "-std=c++17", "outside.cpp"))
    for package, compiler, standard, source in programs:
        flags = run("pkg-config", "--cflags", "--libs", package, PKG_CONFIG_PATH=pkg_config_path).split()
        program = scratch / f"{source}.out"
        run(compiler, standard, "-Wall", "-Wextra", "-Wpedantic", "-Werror", SOURCES / source, "-o", program, *flags)
        run(program, LD_LIBRARY_PATH=library_path)


def check_examples(prefix, scratch):
    """Each example is built by the line in its opening comment, in its own folder, and runs; and what the landing page
    of the API reference begins with prints what it says."""
    pkg_config_path = str(only(prefix, "festoon.pc").parent)
    library_path = str(only(prefix, "libfestoon.so").parent)
    folder = only(prefix, "examples/c")
    shutil.copytree(folder, scratch / "c")
    page = (SOURCES.parents[1] / "docs" / "api.md").read_text(encoding="utf-8")
    first = re.search(r"```c\n(.*?)```", page, re.S).group(1)
    (scratch / "c" / "first.c").write_text(first, encoding="utf-8")
    lines = {"first": re.search(r"^    (cc .*first)$", page, re.M).group(1)}
    for source in folder.glob("*.c"):
        text = source.read_text(encoding="utf-8")
        if "FESTOON_OWN_PHYSICS" not in text:  # else it needs a library of its own
            lines[source.stem] = re.search(r"^ \*     (cc .* -o \w+)$", text, re.M).group(1)
    if len(lines) < 4:
        raise SystemExit(f"examples: {sorted(lines)}")
    for name, line in lines.items():
        strict = line.replace("cc ", f"'{C_COMPILER}' -Wall -Wextra -Wpedantic -Werror ", 1)
        run("sh", "-c", f"cd '{scratch}/c' && {strict}", PKG_CONFIG_PATH=pkg_config_path)
        out = run("sh", "-c", f"cd '{scratch}/c' && ./{name} || test $? -eq 77", LD_LIBRARY_PATH=library_path)
        if name == "first" and out.strip() not in page:
            raise SystemExit(f"docs/api.md says otherwise: {out}")


def check_find_package(prefix, scratch):
    """Both programs built by a CMake project that looks for festoon."""
    build = scratch / "outside"
    options = [f"-DCMAKE_PREFIX_PATH={prefix}", f"-DCMAKE_C_COMPILER={C_COMPILER}", "-DCMAKE_BUILD_TYPE=Release"]
    if CXX_COMPILER:
        options.append(f"-DCMAKE_CXX_COMPILER={CXX_COMPILER}")
    else:
        options.append("-DWITH_CXX=OFF")
    run(CMAKE, "-G", GENERATOR, "-S", SOURCES, "-B", build, *options)
    run(CMAKE, "--build", build)
    run(build / "outside_c")
    if CXX_COMPILER:
        run(build / "outside_cpp")


def main():
    if not CXX_COMPILER:
        print("no C++ compiler: the outside C++ program is skipped")
    with tempfile.TemporaryDirectory(prefix="festoon-installed-") as name:
        scratch = pathlib.Path(name)
        prefix = install(scratch)
        check_tree(prefix)
        check_pkg_config(prefix, scratch)
        check_examples(prefix, scratch)
        check_find_package(prefix, scratch)


main()
