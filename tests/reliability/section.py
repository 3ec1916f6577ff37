"""The sections of docs/inside/reliability.md: each campaign rewrites its own and leaves the others alone.

A section stands between two comment lines, <!-- begin NAME --> and <!-- end NAME -->.
"""

import argparse
import os
import re
import textwrap


def page():
    """Path of docs/inside/reliability.md in the source tree."""
    source = os.environ.get("SOURCE_DIR") or os.path.join(os.path.dirname(__file__), "..", "..")
    return os.path.join(source, "docs", "inside", "reliability.md")


def table(head, rows):
    """A table in Markdown from a list of column names and a list of rows of the same length."""
    lines = ["| " + " | ".join(head) + " |", "|" + "---|" * len(head)]
    lines += ["| " + " | ".join(str(cell) for cell in row) + " |" for row in rows]
    return "\n".join(lines)


def wrapped(text):
    """Prose and lists with lines of at most 120 characters; tables stay, and so do blanks within code."""
    def paragraph(lines, indent):
        kept = re.sub(r"`[^`\n]*`", lambda code: code[0].replace(" ", "\0"), " ".join(lines.split()))
        lines = textwrap.wrap(kept, 120, subsequent_indent=indent, break_long_words=False, break_on_hyphens=False)
        return "\n".join(lines).replace("\0", " ")

    parts = []
    for block in re.split(r"\n{2,}", text.strip()):
        if block.startswith("- "):
            block = "\n".join(paragraph(item, "  ") for item in re.split(r"\n(?=- )", block))
        elif not block.startswith("|"):
            block = paragraph(block, "")
        parts.append(block)
    return "\n\n".join(parts)


def write(name, text):
    """Replace the text of the section `name`; the page must have that section."""
    with open(page(), encoding="utf-8") as file:
        before = file.read()
    begin, end = f"<!-- begin {name} -->\n", f"<!-- end {name} -->"
    pattern = re.compile(re.escape(begin) + ".*?" + re.escape(end), re.S)
    if len(pattern.findall(before)) != 1:
        raise SystemExit(f"{page()} has no section {name}")
    after = pattern.sub(lambda _: begin + wrapped(text) + "\n" + end, before)
    part = page() + ".part"
    with open(part, "w", encoding="utf-8") as file:
        file.write(after)
    os.replace(part, page())


def run(name, campaign, report, count=1000):
    """The main program of a campaign of `count` blows. campaign(count, seed) returns its findings and a list of the
    promises that were broken; report() makes of these the text of the section `name`. Returns the exit status."""
    options = argparse.ArgumentParser()
    options.add_argument("--count", type=int, default=count)
    options.add_argument("--seed", type=int, default=1)
    options.add_argument("--write", action="store_true")
    given = options.parse_args()
    found, wrong = campaign(given.count, given.seed)
    text = report(found, given.count, given.seed, wrong)
    print(text)
    if given.write:
        write(name, text)
    return 1 if wrong else 0
