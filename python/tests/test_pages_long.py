"""The pages say what is true: their lines run, the gallery runs, and sphinx has nothing to complain of."""

import doctest
import html
import importlib.util
import os
import pathlib
import re
import subprocess
import sys
import urllib.parse

import pytest

from conftest import BUILD

SOURCE = pathlib.Path(os.environ.get("SOURCE_DIR", pathlib.Path(__file__).resolve().parents[2]))
EXAMPLES = sorted((SOURCE / "examples/python").glob("plot_*.py"))
HAVE_SPHINX = all(map(importlib.util.find_spec, ("sphinx", "sphinx_gallery", "numpydoc", "myst_parser", "furo")))


def blocks(page):
    return re.findall(r"^```python\n(.*?)^```", (SOURCE / page).read_text(encoding="utf-8"), re.M | re.S)


def run_lines(lines, folder):
    """In a python of its own, which draws without a screen; a warning is a failure."""
    where = {**os.environ, "PYTHONPATH": str(BUILD / "python"), "MPLBACKEND": "Agg"}
    done = subprocess.run(
        [sys.executable, "-B", "-c", lines], env=where, cwd=folder, capture_output=True, text=True, check=False
    )
    assert (done.returncode, done.stderr) == (0, "")
    return done.stdout


def test_ten_lines_of_the_readme(tmp_path):
    lines = next(block for block in blocks("README.md") if "fs.sweep" in block)
    assert len(lines.splitlines()) == 10
    told = run_lines(lines + "figure.savefig('picture.png')\n", tmp_path)
    assert told.startswith("counter-rotating 17.63") and (tmp_path / "picture.png").stat().st_size > 20000


def test_lines_of_the_guide(tmp_path):
    """Lines build on those before them; what looks like a session gives what stands there."""
    plain = [block for block in blocks("docs/python.md") if ">>>" not in block]
    assert "counter-rotating" in run_lines("\n".join(plain), tmp_path)
    sessions = [block for block in blocks("docs/python.md") if ">>>" in block]
    assert sessions
    for text in sessions:
        test = doctest.DocTestParser().get_doctest(text, {}, "docs/python.md", None, 0)
        assert doctest.DocTestRunner().run(test).failed == 0


def test_there_are_eight_examples():
    assert len(EXAMPLES) == 8
    first = EXAMPLES[0].read_text(encoding="utf-8").split('"""')[2]
    assert len([line for line in first.splitlines() if line]) == 5


@pytest.mark.skipif(HAVE_SPHINX, reason="the gallery runs them all")
@pytest.mark.parametrize("path", EXAMPLES, ids=lambda path: path.stem)
def test_example(path, tmp_path):
    run_lines(path.read_text(encoding="utf-8"), tmp_path)


def lacking(root):
    """What pages, styles and scripts name on this machine and is not there, or needs a server to be found."""
    named = []
    for page in root.rglob("*.html"):
        for tag in re.findall(r"<[a-z]+\s[^>]*>", page.read_text(encoding="utf-8")):
            assert not re.match(r"<script[^>]*type=.module", tag), "a browser does not load a module from a file"
            named += [(page, name) for name in re.findall(r"\s(?:href|src)=[\"']([^\"']+)", tag)]
    for style in root.rglob("*.css"):
        text = re.sub(r"/\*.*?\*/", "", style.read_text(encoding="utf-8"), flags=re.S)
        named += [(style, name) for name in re.findall(r"@import\s+[\"']([^\"']+)", text)]
        named += [(style, name) for name in re.findall(r"url\([\"']?([^\"')]+)", text)]
    for script in root.rglob("*.js"):
        named += [(script, name) for name in re.findall(r"^import\b.*", script.read_text(encoding="utf-8"), re.M)]
    assert len(named) > 500
    gone = []
    for where, name in named:
        url = urllib.parse.urlsplit(html.unescape(name))
        if not (url.scheme or url.netloc) and url.path and (
            url.path.startswith("/") or not (where.parent / urllib.parse.unquote(url.path)).exists()
        ):
            gone.append((str(where.relative_to(root)), name))
    return gone


@pytest.mark.skipif(not HAVE_SPHINX, reason="sphinx or a part of it is missing")
def test_sphinx_has_no_complaint():
    """Of the pages, and of the examples, which it runs: an error or a warning ends in what it says."""
    done = subprocess.run(
        ["cmake", "--build", BUILD, "--target", "python-docs"], capture_output=True, text=True, check=False
    )
    told = done.stdout + done.stderr
    assert done.returncode == 0 and "WARNING" not in told and "Warning" not in told, told
    page = (BUILD / "docs/python/gallery/index.html").read_text(encoding="utf-8")
    assert all(path.stem in page for path in EXAMPLES)
    pictures = list((BUILD / "docs/python/_images").glob("sphx_glr_plot_*.png"))
    assert len(pictures) >= 8 and str(SOURCE) not in page
    assert lacking(BUILD / "docs/python") == []
