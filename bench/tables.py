"""The figures of `make bench` as Markdown tables.

    tables.py PERFORMANCE.tsv WORK-PRECISION.csv -o TABLES.md      write all tables to a file, and print them
    tables.py PERFORMANCE.tsv WORK-PRECISION.csv --fill PAGE.md    renew the tables of a page

A line of the first file is one cell: TABLE, ROW, COLUMN, VALUE.  Times of the second file, which has those of some
tolerances, are interpolated to round errors; it need not be there.  A page's tables are known by the name in their
first cell, and keep the rows and columns that they have.
"""

import csv
import math
import os
import platform
import re
import sys


def processor():
    """What /proc/cpuinfo calls the processor, with the numbers by which its generation is told."""
    wanted = ("model name", "cpu family", "model", "stepping")
    found = {}
    try:
        with open("/proc/cpuinfo", encoding="utf-8") as lines:
            for line in lines:
                key, _, value = line.partition(":")
                found.setdefault(key.strip(), value.strip())
    except OSError:
        pass
    return ", ".join(f"{key} {found[key]}" for key in wanted if key in found) or platform.processor()


def at_error(points, error):
    """The time for an error, from those of (error, ms) around it; nothing where none lies beyond."""
    points = sorted(points)
    for (low, slow), (high, quick) in zip(points, points[1:]):
        if low <= error <= high:
            part = math.log(error / low) / math.log(high / low)
            return f"{math.exp(math.log(slow) + part * math.log(quick / slow)):.3g}"
    return ""


def work_and_precision(path):
    """Cells of a table: solvers against errors."""
    solvers = {}
    with open(path, encoding="utf-8", newline="") as lines:
        for line in csv.DictReader(lines):
            solvers.setdefault(line["solver"], []).append((float(line["error"]), float(line["ms"])))
    for solver, points in solvers.items():
        for exponent in (4, 6, 9, 11):
            yield solver, f"1e-{exponent}", at_error(points, 10.0**-exponent)


def short(text):
    """1e-9 instead of 1e-09."""
    return re.sub(r"e-0(\d)\b", r"e-\1", text)


def read(performance, precision):
    """name -> {(row, column): value}"""
    tables = {}
    with open(performance, encoding="utf-8", newline="") as lines:
        for cell in csv.reader(lines, delimiter="\t"):
            table, row, column, value = map(short, cell)
            tables.setdefault(table, {})[row, column] = value
    if os.path.exists(precision):
        tables["ms by error"] = {(row, column): value for row, column, value in work_and_precision(precision)}
    return tables


def line_of(cells):
    return "| " + " | ".join(cells) + " |"


def markdown(name, cells):
    rows, columns = (list(dict.fromkeys(key[i] for key in cells)) for i in (0, 1))
    yield line_of([name, *columns])
    yield "|---" * (len(columns) + 1) + "|"
    for row in rows:
        yield line_of([row, *(cells.get((row, column), "") for column in columns)])


def fill(page, tables):
    cells, columns = None, []
    for line in page:
        if not line.startswith("|"):
            cells = None
            yield line
            continue
        parts = [part.strip() for part in line.strip().strip("|").split("|")]
        if cells is None:
            cells, columns = tables.get(parts[0], {}), parts[1:]
            yield line
        elif any((parts[0], column) in cells for column in columns):
            values = [cells.get((parts[0], column), old) for column, old in zip(columns, parts[1:])]
            yield line_of([parts[0], *values])
        else:
            yield line


def main():
    performance, precision, what, path = sys.argv[1:]
    tables = read(performance, precision)
    if what == "--fill":
        with open(path, encoding="utf-8") as page:
            text = "\n".join(fill(page.read().splitlines(), tables)) + "\n"
    else:
        text = f"Processor: {processor()}\n"
        for name, cells in tables.items():
            text += "\n" + "\n".join(markdown(name, cells)) + "\n"
        print(text)
    with open(path, "w", encoding="utf-8") as out:
        out.write(text)


if __name__ == "__main__":
    main()
