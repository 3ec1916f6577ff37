#!/usr/bin/env python3
"""Fuzzing: random bytes for every reader of the program, under the address and undefined behaviour sanitizers.

    tests/reliability/fuzz.py [--count N] [--write] [--work DIR] [--target NAME]...

N executions in all (10^7 unless told) are shared between the targets of tests/fuzz (fuzz_NAME.c), which start from
the files of tests/fuzz/NAME and from files that the program makes.  What was done is kept in DIR (BUILD_DIR/fuzz
unless told): the same command goes on there.  A finding is minimised and kept in DIR/findings; mend it, and put the
file into tests/fuzz/NAME, which every `make test` replays.  Status 1: something was found; 77: no libFuzzer here.

Environment: FESTOON, SOURCE_DIR, BUILD_DIR as for the tests.
"""

import argparse
import glob
import json
import os
import shutil
import sqlite3
import subprocess
import sys
import tempfile

import section

SOURCE = os.path.abspath(os.environ.get("SOURCE_DIR", os.path.join(os.path.dirname(__file__), "..", "..")))
BUILD = os.path.abspath(os.environ.get("BUILD_DIR", os.path.join(SOURCE, "build")))
FESTOON = os.environ.get("FESTOON", os.path.join(BUILD, "festoon"))

# Shares of the executions: one execution takes microseconds for the first targets; the last ones open files.
SHARES = {"scene": 0.40, "csv": 0.25, "value": 0.22, "over": 0.05, "track": 0.05, "branch": 0.028,
          "sweep": 0.002}
LENGTHS = {"scene": 2048, "csv": 4096, "value": 64, "over": 200, "track": 4096, "branch": 4096,
           "sweep": 16384}
WHAT = {"scene": "scenes (YAML)", "value": "settings: keys, numbers, units", "over": "axes of sweeps (--over)",
        "csv": "trajectories (CSV)", "track": "tracks of filmed beads (tables, XML)", "branch": "branches (JSON)",
        "sweep": "databases of sweeps (SQLite)"}
BATCHES, LEAST = 20, 2000  # of a target; executions of a batch, which begins with the inputs that were kept
# What no reader calls: the formulas and what steps and watches a motion, which take most of the time to compile.
FORMULAS = ("*.inl", "*/src/lanes/*", "*/src/ode/*", "*/src/observe/*")


def run(*words, **options):
    return subprocess.run(words, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, **options)


def done(*words, **options):
    result = run(*words, **options)
    if result.returncode != 0:
        raise SystemExit(" ".join(words) + "\n" + result.stdout.decode(errors="replace")[-4000:])
    return result.stdout.decode(errors="replace")


def has_fuzzer():
    if not shutil.which("clang"):
        return False
    with tempfile.TemporaryDirectory() as folder:
        source = os.path.join(folder, "empty.c")
        with open(source, "w", encoding="ascii") as out:
            out.write("int LLVMFuzzerTestOneInput(const unsigned char *d, unsigned long n) { return d && n ? 0 : 0; }\n")
        return run("clang", "-fsanitize=fuzzer,address,undefined", source, "-o", source + ".x").returncode == 0


def build(work, targets, level):
    """Builds the targets in `work`, linked with libFuzzer to libraries that report their branches to it.  `level`: of
    optimisation.  The formulas are compiled without sanitizers."""
    tree, formulas = os.path.join(work, "build"), os.path.join(work, "formulas")
    with open(formulas, "w", encoding="ascii") as out:
        out.writelines(f"src:{pattern}\n" for pattern in FORMULAS)
    done("cmake", "-S", SOURCE, "-B", tree, "-G", "Ninja", "-DCMAKE_C_COMPILER=clang", "-DCMAKE_BUILD_TYPE=Debug",
         f"-DCMAKE_C_FLAGS_DEBUG={level} -g1 -fsanitize-ignorelist={formulas}",
         "-DFESTOON_SANITIZE=address,undefined,fuzzer-no-link")
    done("cmake", "--build", tree, "--target", "festoon_internal")
    archive, = glob.glob(os.path.join(tree, "**", "libfestoon_internal.a"), recursive=True)
    libraries = done("pkg-config", "--libs", "yaml-0.1", "jansson", "sqlite3", "expat").split()
    for name in targets:
        done("clang", "-std=c11", "-D_POSIX_C_SOURCE=200809L", "-Werror", level, "-g1",
             "-fsanitize=fuzzer,address,undefined", "-fno-sanitize-recover=all", "-I", os.path.join(SOURCE, "include"),
             "-I", os.path.join(SOURCE, "src"), os.path.join(SOURCE, "tests", "fuzz", f"fuzz_{name}.c"), archive,
             *libraries, "-lm", "-ldl", "-lpthread", "-o", os.path.join(work, "fuzz_" + name))


def make_seeds(corpus, name):
    """The files of tests/fuzz/NAME, and one that the program makes now."""
    os.makedirs(corpus, exist_ok=True)
    for path in glob.glob(os.path.join(SOURCE, "tests", "fuzz", name, "*")):
        shutil.copy(path, corpus)
    made = os.path.join(corpus, "made-by-the-program")
    short = ("--set", "run.periods=4", "--set", "run.discard=1", "--set", "run.samples=4")
    if name == "csv":
        done(FESTOON, "run", *short, "-o", made + ".csv")
    elif name == "branch":
        done(FESTOON, "branch", "--kind", "locked", "--over", "drive.omega=0.2:0.201", "-o", made + ".json")
    elif name == "sweep":
        done(FESTOON, "sweep", *short, "--over", "model.kappa=1:2:2", "-o", made + ".db")
        with sqlite3.connect(made + ".db") as file:  # small pages: a larger part of the file is content
            file.execute("PRAGMA journal_mode=DELETE")
            file.execute("PRAGMA page_size=512")
            file.execute("VACUUM")
        file.close()


def fuzz(work, name, runs, env):
    """Run one batch; the number of executions, and the path of a finding or None."""
    corpus, findings = os.path.join(work, "corpus", name), os.path.join(work, "findings", name) + os.sep
    os.makedirs(findings, exist_ok=True)
    before = set(os.listdir(findings))
    result = run(os.path.join(work, "fuzz_" + name), corpus, f"-runs={runs}", "-timeout=10", "-rss_limit_mb=2048",
                 f"-max_len={LENGTHS[name]}", "-print_final_stats=1",
                 "-artifact_prefix=" + findings, cwd=work, env=env)
    text = result.stdout.decode(errors="replace")
    counts = [int(line.split()[-1]) for line in text.splitlines() if "number_of_executed_units" in line]
    found = sorted(set(os.listdir(findings)) - before)
    if result.returncode != 0:
        with open(os.path.join(work, "findings", name + ".log"), "a", encoding="utf-8") as log:
            log.write(text[-20000:])
        if not found:
            raise SystemExit(f"{name} failed:\n{text[-4000:]}")
    return counts[0] if counts else 0, os.path.join(findings, found[0]) if found else None


def minimise(work, name, path, env):
    smaller = path + ".small"
    run(os.path.join(work, "fuzz_" + name), "-minimize_crash=1", "-runs=20000", "-exact_artifact_path=" + smaller, path,
        cwd=work, env=env, timeout=600)
    return smaller if os.path.exists(smaller) else path


class State:
    """Saves the counts, so that the same command goes on."""

    def __init__(self, work):
        self.path = os.path.join(work, "state.json")
        self.targets = {}
        if os.path.exists(self.path):
            with open(self.path, encoding="utf-8") as file:
                self.targets = json.load(file)

    def of(self, name):
        return self.targets.setdefault(name, {"executions": 0, "findings": 0})

    def save(self):
        with open(self.path + ".part", "w", encoding="utf-8") as file:
            json.dump(self.targets, file, indent=1)
        os.replace(self.path + ".part", self.path)


def report(state, targets):
    rows = [[WHAT[name], f"{state.of(name)['executions']:,}".replace(",", " "), state.of(name)["findings"]]
            for name in targets]
    total = sum(state.of(name)["executions"] for name in targets)
    rows.append(["together", f"{total:,}".replace(",", " "), sum(state.of(name)["findings"] for name in targets)])
    return f"""The promise: whatever bytes a file or an option holds, the program answers with a result or with a sentence.
It does not crash, hang, read beyond its memory or overflow, and what it accepts it can write and read back as the
same bits.

The attack: `tests/reliability/fuzz.py` feeds each reader with inputs that libFuzzer mutates after the branches
that they take, built by clang with the address and the undefined behaviour sanitizer. Every input that ever failed
stands in `tests/fuzz` and is replayed, spoilt at every byte, by each `make test`.

{section.table(["reader", "inputs", "findings"], rows)}
"""


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--count", type=float, default=1e7)
    parser.add_argument("--write", action="store_true")
    parser.add_argument("--work", default=os.path.join(BUILD, "fuzz"))
    parser.add_argument("--target", action="append", choices=list(SHARES))
    given = parser.parse_args()
    if not has_fuzzer():
        print("skipped: no clang with libFuzzer (clang, libclang-rt-14-dev)")
        return 77
    work, targets = os.path.abspath(given.work), given.target or list(SHARES)
    os.makedirs(work, exist_ok=True)
    build(work, targets, "-O0" if given.count < 1e6 else "-O1")  # a sample takes less time than optimisation
    state, found = State(work), 0
    whole = sum(SHARES[name] for name in targets)
    with tempfile.TemporaryDirectory(dir="/dev/shm" if os.access("/dev/shm", os.W_OK) else None) as folder:
        env = {**os.environ, "TMPDIR": folder}
        for name in targets:
            make_seeds(os.path.join(work, "corpus", name), name)
        open_targets = list(targets)
        while open_targets:
            for name in list(open_targets):
                wanted = int(given.count * SHARES[name] / whole) + 1
                left = wanted - state.of(name)["executions"]
                if left <= 0:
                    open_targets.remove(name)
                    continue
                count, finding = fuzz(work, name, min(left, max(wanted // BATCHES, LEAST) + 1), env)
                state.of(name)["executions"] += count
                if finding:
                    state.of(name)["findings"] += 1
                    found += 1
                    open_targets.remove(name)
                    print(f"{name}: {minimise(work, name, finding, env)}", flush=True)
                state.save()
                print(f"{name}: {state.of(name)['executions']} of {wanted}", flush=True)
    if given.write:
        section.write("fuzz", report(state, targets))
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
