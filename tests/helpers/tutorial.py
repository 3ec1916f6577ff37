"""docs/tutorial.md and README.md as lists of steps: their commands, the lines that these print, and the pictures.

    python3 tests/helpers/tutorial.py PROGRAM IMAGES     runs the tutorial, and writes its pictures to the folder IMAGES

Indented lines that begin with "festoon" or "build/festoon" are commands; other indented lines behind a command are
printed by it ("..." stands for more of them), but comments ("#") and lines before the first command are not.  The
picture images/tutorial-NAME.png is NAME.png of a command, reduced by ffmpeg to twice the width at which it is shown.
"""

import os
import pathlib
import re
import shlex
import subprocess
import sys
import tempfile

SOURCE = pathlib.Path(__file__).resolve().parents[2]
PAGE = SOURCE / "docs" / "tutorial.md"
README = SOURCE / "README.md"


def text(page=PAGE):
    return page.read_text(encoding="utf-8")


def sections(page=PAGE):
    """{title: [(command, [printed lines])]} in the order of the page."""
    found = {}
    for title, body in re.findall(r"^## (.*?)\n(.*?)(?=^## |\Z)", text(page), re.M | re.S):
        steps = []
        for line in re.findall(r"^    (.*)", body, re.M):
            if re.match(r"(build/)?festoon ", line):
                steps.append((line, []))
            elif steps and line.strip() != "..." and not line.startswith("#"):
                steps[-1][1].append(line)
        found[title] = steps
    return found


def pictures():
    """{NAME: width at which the page shows it}."""
    return {name: int(width) for name, width in re.findall(r'<img src="images/tutorial-(\w+)\.png" width="(\d+)"', text())}


def run(program, command, folder):
    """The finished process of a command of the page."""
    return subprocess.run([program, *shlex.split(command)[1:]], cwd=folder, capture_output=True, text=True, check=False)


def write_pictures(program, images):
    with tempfile.TemporaryDirectory(prefix="festoon-tutorial-") as folder:
        for steps in sections().values():
            for command, _ in steps:
                done = run(program, command, folder)
                if done.returncode != 0:
                    sys.exit(f"{command}: status {done.returncode}\n{done.stderr}")
        for name, width in pictures().items():
            subprocess.run(["ffmpeg", "-loglevel", "error", "-y", "-i", os.path.join(folder, name + ".png"), "-vf",
                            f"scale={2 * width}:-1:flags=lanczos,split[a][b];[a]palettegen=max_colors=128[p];[b][p]paletteuse=dither=none",
                            os.path.join(images, f"tutorial-{name}.png")], check=True)


if __name__ == "__main__":
    write_pictures(os.path.abspath(sys.argv[1]), os.path.abspath(sys.argv[2]))
