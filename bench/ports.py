"""What the processor's ports allow: the instructions of one step in lanes, counted.

    ports.py BENCH_SHARES

`bench_shares --steps FORM` says how often each instruction is executed; objdump (binutils) says what it is.  Printed are
the numbers for one of the twelve evaluations in a step, its share of the sums of the stages and of the step's end
included: instructions that compute with vectors, of which a core of this kind does two in a cycle, and loads, of which it
also does two.  Where the file that PERFORMANCE_TSV names has the times of bench_shares, they are compared with the peak.
"""

import collections
import csv
import os
import re
import subprocess
import sys

EVALUATIONS = 12
FORMS = ("portable, 8 lanes", "avx2", "avx512")
SLOW = re.compile(r"v(div|sqrt|rsqrt|rcp)")
MOVES = re.compile(r"v(mov|lddqu)")
LINE = re.compile(r"^\s*([0-9a-f]+):\s+(?:(?:lock|rep|notrack)\s+)?(\S+)\s*(.*)$")


def kind_of(mnemonic, operands):
    """The kinds of work that an instruction is."""
    parts = re.findall(r"[^,(]*\([^)]*\)|[^,]+", operands.split("#")[0])
    in_memory = ["(" in part for part in parts]
    from_memory, to_memory = any(in_memory[:-1]), bool(in_memory) and in_memory[-1]
    kinds = []
    if mnemonic.startswith("v") and mnemonic != "vzeroupper":
        if to_memory:
            kinds.append("stores of vectors")
        if from_memory:
            kinds.append("loads of vectors")
        moves = MOVES.match(mnemonic) or mnemonic.startswith("vbroadcast") and from_memory
        if not (moves and "{" not in operands):
            kinds.append("arithmetic on vectors")
        if SLOW.match(mnemonic):
            kinds.append("of these, roots, quotients and estimates")
    else:
        kinds.append("others")
    return kinds


def instructions(program):
    listing = subprocess.run(["objdump", "-d", "--no-show-raw-insn", program], capture_output=True, text=True, check=True)
    for line in listing.stdout.splitlines():
        found = LINE.match(line)
        if found:
            yield int(found[1], 16), found[2], found[3]


def counts(program, form):
    output = subprocess.run([program, "--steps", form], capture_output=True, text=True, check=True).stdout
    return {int(offset, 16): int(times) for offset, times in (line.split() for line in output.splitlines())}


def times():
    """ns of an evaluation in a step, and of a fused operation, of each form."""
    found = collections.defaultdict(dict)
    path = os.environ.get("PERFORMANCE_TSV", "")
    if os.path.exists(path):
        with open(path, encoding="utf-8", newline="") as lines:
            for table, row, column, value in csv.reader(lines, delimiter="\t"):
                if table == "steps alone":
                    found[row][column] = float(value)
    return found


def put(form, column, value):
    print(f"  {column:<52} {value}")
    if os.environ.get("PERFORMANCE_TSV"):
        with open(os.environ["PERFORMANCE_TSV"], "a", encoding="utf-8", newline="") as out:
            csv.writer(out, delimiter="\t", lineterminator="\n").writerow(("ports", form, column, value))


def main():
    program = sys.argv[1]
    code = {offset: kind_of(mnemonic, operands) for offset, mnemonic, operands in instructions(program)}
    measured = times()
    for form in FORMS:
        total = collections.Counter()
        for offset, executed in counts(program, form).items():
            for kind in code.get(offset, ["others"]):
                total[kind] += executed
        if not total:
            continue
        print(f"{form}: instructions for one evaluation in a step")
        for kind in ("arithmetic on vectors", "of these, roots, quotients and estimates", "loads of vectors",
                     "stores of vectors", "others"):
            put(form, kind, f"{total[kind] / EVALUATIONS:.0f}")
        if form in measured:
            bound = total["arithmetic on vectors"] / EVALUATIONS * measured[form]["ns a fused operation"]
            put(form, "ns at least", f"{bound:.1f}")
            put(form, "of the time", f"{100 * bound / measured[form]['ns an evaluation in a step']:.0f} %")


if __name__ == "__main__":
    main()
