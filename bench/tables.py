"""The figures of `make bench` as Markdown tables, for docs/performance.md.

    tables.py PERFORMANCE.csv TABLES.md

A line of the first file is one cell: TABLE,ROW,COLUMN,VALUE.  The tables are written to the second file and printed.
"""

import csv
import platform
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


def markdown(name, cells):
    rows = list(dict.fromkeys(row for row, _, _ in cells))
    columns = list(dict.fromkeys(column for _, column, _ in cells))
    values = {(row, column): value for row, column, value in cells}
    yield f"| {name} | " + " | ".join(columns) + " |"
    yield "|---" * (len(columns) + 1) + "|"
    for row in rows:
        yield f"| {row} | " + " | ".join(values.get((row, column), "") for column in columns) + " |"


def main():
    tables = {}
    with open(sys.argv[1], encoding="utf-8", newline="") as lines:
        for table, row, column, value in csv.reader(lines):
            tables.setdefault(table, []).append((row, column, value))
    text = f"Processor: {processor()}\n"
    for name, cells in tables.items():
        text += "\n" + "\n".join(markdown(name, cells)) + "\n"
    with open(sys.argv[2], "w", encoding="utf-8") as out:
        out.write(text)
    print(text)


if __name__ == "__main__":
    main()
