#!/usr/bin/env python3
"""Put faults into the code, one at a time, and count how many of them the tests notice: `make mutants`.

The files tests/mutants/*.mutants list the faults (entries.py describes the form).  The script copies the tree to
build-mutants/tree-N and builds it there as `make test` does.  Then it takes one fault after another: it changes the
file, builds, and runs the tests that are likely to notice; if all of them pass, it runs every other test that is not
long.  The fault is noticed when a test fails, crashes or hangs (a test's time limit follows from the time that it takes
without a fault).  A fault that does not compile is invalid, and one that compiles to the same object files is
equivalent; neither counts.

Results are kept in build-mutants/results, one file for each fault, so that interrupted work goes on where it stopped.  A
result is used again until its fault or the faulty file changes; the result of a fault that survived, until any file of
the tree changes.  --fresh forgets all results.  The exit status is 0 if every fault applies, at least 95 % were noticed,
and each survivor has a reason (`why:`).
"""

import argparse
import collections
import concurrent.futures
import filecmp
import fnmatch
import hashlib
import json
import os
import queue
import re
import shutil
import signal
import subprocess
import sys
import time

HERE = os.path.dirname(os.path.abspath(__file__))
SOURCE = os.environ.get("SOURCE_DIR") or os.path.dirname(os.path.dirname(HERE))
sys.path[:0] = [HERE, os.path.join(SOURCE, "tests", "reliability")]
import entries as listed  # noqa: E402
import section  # noqa: E402

TARGET = 95.0  # per cent of the faults that must be noticed
COUNTED = ("noticed", "survived", "open")  # open: not noticed by its likely tests, the others were not asked
OF_THE_LIST = "test_mutants"  # fails with every fault, since the old text of one is gone


def copied_files():
    """The files that make the tree: what git tracks, and what it would track."""
    command = ["git", "-C", SOURCE, "ls-files", "-z", "--cached", "--others", "--exclude-standard"]
    try:
        names = subprocess.run(command, check=True, capture_output=True).stdout.decode().split("\0")
    except (OSError, subprocess.CalledProcessError):  # no git, or an unpacked archive
        names = []
        for folder, below, files in os.walk(SOURCE):
            below[:] = [name for name in below if not name.startswith(("build", ".git", "demo-results"))]
            names += [os.path.relpath(os.path.join(folder, name), SOURCE) for name in files]
    return sorted(name for name in names if name and os.path.isfile(os.path.join(SOURCE, name)))


def digest(path):
    """Fingerprint of a file."""
    with open(path, "rb") as file:
        return hashlib.sha256(file.read()).hexdigest()


def fingerprint_of_tree(names):
    """A text that changes if any file changes that is compiled or tested."""
    parts = [name + digest(os.path.join(SOURCE, name)) for name in names
             if name.split("/")[0] in ("src", "paper", "include", "tests", "tools", "examples", "cmake", "CMakeLists.txt")
             and not name.startswith(("tests/mutants/", "tests/reliability/"))]
    return hashlib.sha256("".join(parts).encode()).hexdigest()


def mirror(source, target, names=None):
    """Makes `target` a copy of `source`, times included; equal files are left alone."""
    if names is None:
        names = [os.path.relpath(os.path.join(folder, name), source)
                 for folder, _, files in os.walk(source) for name in files]
    wanted = set(names)
    for folder, _, files in os.walk(target):
        for name in files:
            path = os.path.join(folder, name)
            if os.path.relpath(path, target) not in wanted:
                os.unlink(path)
    for name in names:
        old, new = os.path.join(source, name), os.path.join(target, name)
        if not os.path.lexists(old):
            continue
        if os.path.lexists(new):
            a, b = os.lstat(old), os.lstat(new)
            if a.st_mtime_ns == b.st_mtime_ns and a.st_size == b.st_size:
                continue
            os.unlink(new)
        os.makedirs(os.path.dirname(new), exist_ok=True)
        shutil.copy2(old, new, follow_symlinks=False)


class Test:
    """One test of the quick suite, as ctest would run it."""

    def __init__(self, described):
        properties = {item["name"]: item["value"] for item in described.get("properties", [])}
        self.name, self.command = described["name"], described["command"]
        self.folder = properties.get("WORKING_DIRECTORY")
        self.labels = properties.get("LABELS", [])
        self.environment = dict(item.split("=", 1) for item in properties.get("ENVIRONMENT", []))
        self.skipped = properties.get("SKIP_RETURN_CODE", 77)

    def run(self, limit, log):
        """`passed`, `failed` or `hangs`."""
        with open(log, "wb") as output:
            # A process group of its own, so that everything that a test starts ends with it.
            process = subprocess.Popen(self.command, cwd=self.folder, env={**os.environ, **self.environment},
                                       stdin=subprocess.DEVNULL, stdout=output, stderr=output, start_new_session=True)
            try:
                status = process.wait(limit)
            except subprocess.TimeoutExpired:
                return "hangs"
            finally:
                try:
                    os.killpg(process.pid, signal.SIGKILL)
                except ProcessLookupError:
                    pass
                process.wait()
        return "passed" if status in (0, self.skipped) else "failed"


class Tree:
    """A copy of the tree, and beside it the copy's state when it was built without faults."""

    def __init__(self, place, number, jobs):
        self.root = os.path.join(place, f"tree-{number}")
        self.build, self.clean = os.path.join(self.root, "build"), os.path.join(place, f"clean-{number}")
        self.log = self.root + ".log"  # not in the tree, of which tests ask that it hold no such file
        self.jobs, self.tests, self.times = jobs, {}, {}

    def make(self, *targets):
        """Builds; returns the end of the messages if it failed, else an empty text."""
        done = subprocess.run(["cmake", "--build", self.build, "-j", str(self.jobs)] +
                              (["--target", *targets] if targets else []),
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=False)
        return "" if done.returncode == 0 else done.stdout.decode(errors="replace")[-2000:]

    def prepare(self, names):
        """Copies, configures and builds the tree, and keeps a copy of the result."""
        if os.path.isdir(self.clean):
            mirror(self.clean, self.build)  # an interrupted run may have left a fault in it
        mirror_tree(names, self.root)
        subprocess.run(["cmake", "--preset", "release", "--log-level=WARNING", "-DFESTOON_TESTS=ON"], cwd=self.root,
                       check=True, stdout=subprocess.DEVNULL)
        trouble = self.make()
        if trouble:
            raise SystemExit(f"the tree does not build without a fault:\n{trouble}")
        os.makedirs(self.clean, exist_ok=True)
        mirror(self.build, self.clean)
        shown = subprocess.run(["ctest", "--test-dir", self.build, "--show-only=json-v1"], check=True,
                               capture_output=True).stdout
        self.tests = {test.name: test for test in map(Test, json.loads(shown)["tests"])
                      if "long" not in test.labels and test.name != OF_THE_LIST}

    def objects_changed(self):
        """Whether any object file differs from the one without the fault."""
        for folder, _, files in os.walk(self.build):
            for name in files:
                if name.endswith(".o"):
                    path = os.path.join(folder, name)
                    clean = os.path.join(self.clean, os.path.relpath(path, self.build))
                    if os.path.getmtime(path) != os.path.getmtime(clean) and not filecmp.cmp(path, clean, False):
                        return True
        return False

    def limit(self, name):
        """Seconds after which a test hangs."""
        return 30.0 + 10.0 * self.times.get(name, 60.0)

    def notices(self, name, confirm):
        """Returns in words how a test notices the fault, or None. With `confirm` the test is run again: if it passes
        the second time, it failed for another reason."""
        how = self.tests[name].run(self.limit(name), self.log)
        if how != "passed" and (confirm or how == "hangs"):
            how = self.tests[name].run(self.limit(name), self.log)
        return None if how == "passed" else f"{name} {how}"

    def judge(self, entry, quick):
        """Puts the fault in, finds out which test notices it, and takes it out again."""
        path = os.path.join(self.root, entry.path)
        kept = os.stat(path)
        with open(path, encoding="utf-8") as file:
            text = file.read()
        begun = time.monotonic()
        try:
            with open(path, "w", encoding="utf-8") as file:
                file.write(entry.apply(text))
            outcome, by = self.judge_built(entry, quick)
        finally:
            with open(path, "w", encoding="utf-8") as file:
                file.write(text)
            os.utime(path, ns=(kept.st_atime_ns, kept.st_mtime_ns))
            mirror(self.clean, self.build)
        return {"outcome": outcome, "by": by, "seconds": round(time.monotonic() - begun, 1)}

    def judge_built(self, entry, quick):
        likely = [name for name in entry.tests if name in self.tests]
        targets = [name for name in likely if name.startswith("test_") and not self.is_python(name)]
        trouble = self.make("festoon_program", *targets)
        if trouble:
            return "invalid", trouble
        if not self.objects_changed() and not self.make() and not self.objects_changed():
            return "equivalent", ""
        for name in likely:
            how = self.notices(name, False)
            if how:
                return "noticed", how
        if quick:
            return "open", "not by " + " ".join(likely)
        if self.make():
            return "invalid", "the rest of the tree does not build"
        for name in sorted(set(self.tests) - set(likely), key=lambda name: self.times.get(name, 60.0)):
            how = self.notices(name, True)
            if how:
                return "noticed", how
        return "survived", ""

    def is_python(self, name):
        """Whether a test is a script, not a program of its own."""
        return "ython" in os.path.basename(self.tests[name].command[0])


def mirror_tree(names, root):
    """Copies the files of the tree that have changed, so that the times of the others stay."""
    wanted = set(names)
    for folder, below, files in os.walk(root):
        if folder == root:
            below[:] = [name for name in below if name != "build"]
        for name in files:
            path = os.path.join(folder, name)
            if os.path.relpath(path, root) not in wanted:
                os.unlink(path)
    for name in names:
        old, new = os.path.join(SOURCE, name), os.path.join(root, name)
        if os.path.isfile(new) and filecmp.cmp(old, new, False):
            continue
        os.makedirs(os.path.dirname(new), exist_ok=True)
        shutil.copy(old, new)


def read_json(path):
    """What a file holds, or nothing."""
    try:
        with open(path, encoding="utf-8") as file:
            return json.load(file)
    except (OSError, ValueError):
        return {}


def write_json(path, what):
    """Write a file whole."""
    with open(path + ".part", "w", encoding="utf-8") as file:
        json.dump(what, file, indent=1)
    os.replace(path + ".part", path)


def measure(tree, results, entries, all_tests):
    """Measures the seconds of each test without a fault; a test that fails without a fault cannot notice any."""
    path = os.path.join(results, "times.json")
    times = read_json(path)
    needed = set(tree.tests) if all_tests else {name for entry in entries for name in entry.tests}
    for name in sorted(needed & set(tree.tests)):
        if name in times:
            continue
        begun = time.monotonic()
        how = tree.tests[name].run(1200.0, tree.log)
        if how != "passed":
            raise SystemExit(f"{name} {how} without any fault: see {tree.log}")
        times[name] = round(time.monotonic() - begun, 2)
        print(f"{name}: {times[name]} s without a fault", flush=True)
        write_json(path, times)
    return times


class Results:
    """The kept results, one file for each fault."""

    def __init__(self, folder, tree, likely):
        self.folder, self.tree, self.likely = folder, tree, likely
        os.makedirs(folder, exist_ok=True)

    def path(self, entry):
        """The path of a fault's result."""
        return os.path.join(self.folder, f"{entry.name}.json")

    def key(self, entry):
        """The state for which a result holds."""
        return [entry.fingerprint(), digest(os.path.join(SOURCE, entry.path))]

    def get(self, entry):
        """The kept result, or nothing if it no longer holds."""
        result = read_json(self.path(entry))
        if result.get("key") != self.key(entry):
            return {}
        if result["outcome"] == "open" and not self.likely:
            return {}
        return result if result["outcome"] in ("noticed", "equivalent") or result["tree"] == self.tree else {}

    def put(self, entry, result):
        """Keep a result."""
        write_json(self.path(entry), {**result, "key": self.key(entry), "tree": self.tree})


def work(trees, entries, results, quick):
    """Judges the faults without a valid result, one fault at a time in each tree."""
    free = queue.SimpleQueue()
    for tree in trees:
        free.put(tree)
    todo = [entry for entry in entries if not results.get(entry)]
    done = collections.Counter()

    def one(entry):
        tree = free.get()
        try:
            result = tree.judge(entry, quick)
            results.put(entry, result)
            done["all"] += 1
            print(f"{done['all']}/{len(todo)} {entry.name}: {result['outcome']} {result['by'].strip()[-300:]} "
                  f"({result['seconds']} s)", flush=True)
        finally:
            free.put(tree)

    with concurrent.futures.ThreadPoolExecutor(len(trees)) as pool:
        futures = [pool.submit(one, entry) for entry in todo]
        try:
            for future in futures:
                future.result()
        except BaseException:
            for future in futures:
                future.cancel()
            raise


def tabulate(entries, results):
    """Rows by room and in all: faults that count, noticed, survived, faults that do not count, per cent."""
    rows, whole = [], collections.Counter()
    for room in dict.fromkeys(entry.room for entry in entries):
        counts = collections.Counter(results.get(entry).get("outcome", "not tried") for entry in entries
                                     if entry.room == room)
        whole.update(counts)
        rows.append(row_of(room, counts))
    return rows + [row_of("all", whole)], whole


def row_of(room, counts):
    """Makes one line of the table."""
    valid = sum(counts[name] for name in COUNTED)
    score = f"{100.0 * counts['noticed'] / valid:.1f} %" if valid else "-"
    return [room, valid, counts["noticed"], counts["survived"] + counts["open"],
            counts["invalid"] + counts["equivalent"], counts["not tried"], score]


HEAD = ["room", "faults", "noticed", "survived", "do not count", "not tried", "score"]


def report(entries, results, write):
    """Prints the score, writes the section, and returns the exit status."""
    rows, counts = tabulate(entries, results)
    widths = [max(len(str(row[i])) for row in [HEAD] + rows) for i in range(len(HEAD))]
    print()
    for row in [HEAD] + rows:
        print("  ".join(str(cell).rjust(width) for cell, width in zip(row, widths)))
    survivors = [entry for entry in entries if results.get(entry).get("outcome") in ("survived", "open")]
    for entry in survivors:
        print(f"survived: {entry.name} ({entry.path}): {' '.join(entry.why) or 'no reason is given'}")
    for entry in entries:
        if results.get(entry).get("outcome") == "invalid":
            print(f"invalid: {entry.name} ({entry.path}) does not compile")
    if write:
        few = [entry.name for entry in survivors if results.get(entry)["outcome"] == "open"]
        section.write("mutants", text_of(rows[-1], survivors, few))
    valid = sum(counts[name] for name in COUNTED)
    left = counts["not tried"]
    if left:
        print(f"{left} faults were not tried")
    return 0 if (valid and 100.0 * counts["noticed"] >= TARGET * valid and not counts["invalid"] and
                 not left and all(entry.why for entry in survivors)) else 1


def results_version():
    """FST_RESULTS_VERSION of the tree: which state of the code the numbers are about."""
    with open(os.path.join(SOURCE, "include", "festoon", "festoon.h"), encoding="utf-8") as file:
        return re.search(r"#define FST_RESULTS_VERSION (\d+)", file.read())[1]


def text_of(whole, survivors, few):
    """The section of docs/inside/reliability.md; `whole` is the table's last row, `few` are the faults of which only the
    likely tests were run."""
    text = ("Faults that a reviewer would call bugs (a wrong sign, factor, index or threshold; a check, a term or an "
            "error bar left\nout; an unquoted text; an ignored status) are put into the code by hand, one at a time. "
            "`tests/mutants/*.mutants` lists\nthem, a block for each fault. For each fault the tree is built, and its "
            "tests are run, all but the long ones, until one\nfails or hangs. Faults that compile to the same object "
            f"files do not count. Of {whole[1]} faults tests noticed {whole[2]}\n({whole[6]}), in the code with "
            f"`FST_RESULTS_VERSION` {results_version()}.")
    left = whole[5]
    if left:
        text += f"\n\n{left} faults were not tried: `make mutants` goes on with them."
    text += ("\n\nFaults that no test notices (`why` in `tests/mutants` says why that is accepted):\n\n" if survivors
             else "\n\nTests noticed every fault that was tried.\n")
    for entry in survivors:
        what = " ".join(entry.comment) or "`" + " ".join(" ".join(entry.old).split()).replace("|", "\\|") + "`"
        text += f"- `{entry.name}` in `{entry.path}` ({what}){'' if entry.why else ': no reason yet'}\n"
    if few and len(few) == len(survivors):
        text += "\nFor these faults only the likely tests were run.\n"
    elif few:
        text += f"\nFor {len(few)} of these only the likely tests were run: `{'`, `'.join(few)}`.\n"
    return text


def arguments():
    """The options."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--room", action="append", default=[], help="the faults of this room only")
    parser.add_argument("--only", action="append", default=[], metavar="NAME", help="this fault only; 'pair-*': those so called")
    parser.add_argument("--list", action="store_true", help="list the faults and what is known of them, run nothing")
    parser.add_argument("--likely", action="store_true",
                        help="run the likely tests only; what they do not notice stays open")
    parser.add_argument("--fresh", action="store_true", help="forget the results of earlier runs")
    parser.add_argument("--trees", type=int, default=1, help="faults that are tried at the same time (1)")
    parser.add_argument("-j", "--jobs", type=int, default=os.cpu_count(), help="processes of each build")
    parser.add_argument("--place", default=os.path.join(SOURCE, "build-mutants"), metavar="FOLDER",
                        help="where the copies of the tree and the results are (build-mutants)")
    parser.add_argument("--write", action="store_true", help="rewrite section mutants of docs/inside/reliability.md")
    return parser.parse_args()


def main():
    options = arguments()
    for number in (signal.SIGINT, signal.SIGTERM):  # also where a shell had them ignored
        signal.signal(number, signal.default_int_handler)
    try:
        entries = listed.read_all()
    except listed.Wrong as why:
        raise SystemExit(str(why)) from None
    if options.room or options.only:
        entries = [entry for entry in entries if entry.room in options.room
                   or any(fnmatch.fnmatch(entry.name, name) for name in options.only)]
    complaints = listed.stale(entries, SOURCE)
    for complaint in complaints:
        print(f"stale: {complaint}")
    if complaints:
        return 1
    if not entries:
        raise SystemExit("no such fault: --list shows their names")
    names = copied_files()
    place = os.path.abspath(options.place)
    results = Results(os.path.join(place, "results"), fingerprint_of_tree(names), options.likely)
    if options.fresh:
        shutil.rmtree(results.folder)
        os.makedirs(results.folder)
    if options.list:
        for entry in entries:
            known = results.get(entry)
            print(f"{entry.room:9} {entry.name:32} {entry.path:34} {known.get('outcome', 'not tried')} "
                  f"{known.get('by', '')[:60]}")
        return 0
    if any(not results.get(entry) for entry in entries):
        trees = [Tree(place, number, options.jobs) for number in range(1, options.trees + 1)]
        for tree in trees:
            tree.prepare(names)
        unknown = {name for entry in entries for name in entry.tests} - set(trees[0].tests)
        if unknown:
            print(f"no such tests among those that are not long: {' '.join(sorted(unknown))}", file=sys.stderr)
        times = measure(trees[0], results.folder, entries, not options.likely)
        for tree in trees:
            tree.times = times
        work(trees, entries, results, options.likely)
    return report(entries, results, options.write)


if __name__ == "__main__":
    try:
        sys.exit(main())
    except KeyboardInterrupt:
        print("interrupted; what was found so far is kept", file=sys.stderr)
        sys.exit(130)
