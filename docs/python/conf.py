"""The pages of the Python module: guide, gallery, reference.  `make python-docs` builds them in build/docs/python."""

import os
import pathlib
import warnings

import matplotlib
import sphinx_gallery.sorting

import festoon
from festoon import _tables

matplotlib.use("Agg")
warnings.filterwarnings("ignore", message=".*Agg.*non-GUI backend.*")

SOURCE = pathlib.Path(os.environ["SOURCE_DIR"])
HERE = pathlib.Path(__file__).resolve().parent

project = "festoon"
author = copyright = "The festoon authors"
version = release = festoon.__version__

extensions = ["sphinx.ext.autodoc", "numpydoc", "myst_parser", "sphinx_gallery.gen_gallery"]
exclude_patterns = ["gallery/*.ipynb", "gallery/*.py", "gallery/*.md5"]
myst_enable_extensions = ["colon_fence"]
myst_heading_anchors = 3
html_theme = "furo"
html_title = f"festoon {version}"
html_copy_source = False
autodoc_typehints = "none"
autodoc_member_order = "bysource"
numpydoc_show_class_members = False

sphinx_gallery_conf = {
    "examples_dirs": str(SOURCE / "examples" / "python"),
    "gallery_dirs": "gallery",
    "within_subsection_order": sphinx_gallery.sorting.FileNameSortKey,
    "filename_pattern": "plot_",
    "download_all_examples": False,
    "show_memory": False,
    "min_reported_time": 1e9,
    "remove_config_comments": True,
    "abort_on_example_error": True,
    "capture_repr": (),
}


def cell(text):
    """A cell of a CSV table, in which nothing is markup."""
    for mark in "\\*`|_":
        text = text.replace(mark, "\\" + mark)
    return '"' + text.replace('"', '""') + '"'


def table(title, columns, rows):
    lines = [f".. csv-table:: {title}", f"   :header: {', '.join(cell(name) for name in columns)}", "   :class: names", ""]
    return "\n".join([*lines, *("   " + ", ".join(cell(text) for text in row) for row in rows), "", ""])


def write_tables():
    """Pages of the tables that the library has: parameters, results, columns."""
    parameters = [(key.replace(".", "__"), unit, doc) for key, (_, unit, doc) in _tables.PARAMETERS.items()]
    parts = ["Tables", "======", "", "They are asked of the library itself.", ""]
    parts.append(table("Parameters, as keywords", ("keyword", "unit or choices", "what it is"), parameters))
    for title, rows in (
        ("Numbers of a run and of a sweep", _tables.RESULTS),
        ("Columns of a trajectory", _tables.COLUMNS),
        ("Numbers measured of a track", _tables.MEASURED),
    ):
        parts.append(table(title, ("name", "unit", "what it is"), [(name, *row) for name, row in rows.items()]))
    (HERE / "tables.rst").write_text("\n".join(parts), encoding="utf-8")


write_tables()


def fill_in(app, exception):
    """Debian's theme leaves two imports for a server to resolve; pages that are opened as files need what they name."""
    static = pathlib.Path(app.outdir) / "_static"
    named = {
        "styles/furo.css": ("@import url(/javascript/normalize.css/normalize.css);", "/usr/share"),
        "scripts/furo.js": ('import Gumshoe from "./gumshoe-patched.js";', static / "scripts"),
    }
    for name, (line, folder) in named.items():
        file = static / name
        text = file.read_text(encoding="utf-8") if exception is None else ""
        if line in text:
            path = line.split('"')[1] if '"' in line else line.split("(")[1].split(")")[0]
            there = pathlib.Path(f"{folder}/{path}")
            file.write_text(text.replace(line, there.read_text(encoding="utf-8") if there.is_file() else ""), encoding="utf-8")


def setup(app):
    app.connect("build-finished", fill_in)
