"""The notebooks run from the first cell to the last; they are stored with what they draw and print, without paths.

KEEP_NOTEBOOKS=examples/notebooks stores them anew."""

import base64
import io
import json
import os
import pathlib

import pytest

from conftest import BUILD

SOURCE = pathlib.Path(os.environ.get("SOURCE_DIR", pathlib.Path(__file__).resolve().parents[2]))
NOTEBOOKS = sorted((SOURCE / "examples/notebooks").glob("*.ipynb"))


def test_there_are_three():
    assert [path.stem for path in NOTEBOOKS] == ["from-a-film-to-parameters", "paper-in-ten-cells", "your-own-magnet"]


def outputs_of(book):
    return [output for cell in book["cells"] if cell["cell_type"] == "code" for output in cell["outputs"]]


def pictures_lacking(book):
    """Cells that draw and have no picture."""
    code = [cell for cell in book["cells"] if cell["cell_type"] == "code"]
    drawn = [cell for cell in code if ".plot" in "".join(cell["source"])]
    return [
        "".join(cell["source"]) for cell in drawn
        if not any("image/png" in output.get("data", {}) for output in cell["outputs"])
    ] if drawn else ["nothing is drawn"]


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_stored_with_their_pictures(path):
    """What a reader sees who runs nothing: every cell was run in order, and drew what it says; no path of a machine."""
    text = path.read_text(encoding="utf-8")
    book = json.loads(text)
    counts = [cell["execution_count"] for cell in book["cells"] if cell["cell_type"] == "code"]
    assert counts == list(range(1, len(counts) + 1)) and pictures_lacking(book) == []
    for folder in ("/home/", "/tmp", "/root", str(SOURCE)):
        assert folder not in text


def test_the_stored_ones_are_small():
    assert sum(path.stat().st_size for path in NOTEBOOKS) < 1_000_000


def test_the_texts_fit_what_is_printed():
    """A first case that decides, frames for each film, and a power that comes near to that of a square root."""
    said = {
        path.stem: "".join("".join(output.get("text", "")) for output in outputs_of(json.loads(path.read_text("utf-8"))))
        for path in NOTEBOOKS
    }
    assert "undecided" not in said["your-own-magnet"].splitlines()[0]
    frames = [line.split(": ")[1] for line in said["from-a-film-to-parameters"].splitlines() if "frames of" in line]
    assert len(set(frames)) == 4 and frames[0].startswith("1794 ")
    powers = [float(line.split("power ")[1]) for line in said["paper-in-ten-cells"].splitlines() if "power" in line]
    assert len(powers) == 3 and powers == sorted(powers, reverse=True) and abs(powers[-1] - 0.5) < 0.03


def test_the_paper_has_ten_cells():
    book = json.loads((SOURCE / "examples/notebooks/paper-in-ten-cells.ipynb").read_text(encoding="utf-8"))
    assert sum(cell["cell_type"] == "code" for cell in book["cells"]) == 10


def made_small(book):
    """Pictures of 256 colours, and nothing of when a cell ran."""
    image = pytest.importorskip("PIL.Image")
    for cell in book["cells"]:
        cell["metadata"].pop("execution", None)
    for output in outputs_of(book):
        if "image/png" in output.get("data", {}):
            small = io.BytesIO()
            picture = image.open(io.BytesIO(base64.b64decode(output["data"]["image/png"])))
            picture.convert("RGB").quantize(256).save(small, "PNG", optimize=True)
            output["data"]["image/png"] = base64.b64encode(small.getvalue()).decode("ascii")
    return book


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_runs(path, tmp_path, monkeypatch):
    """Every cell runs, draws what it says it draws, and warns of nothing."""
    pytest.importorskip("ipykernel")
    nbformat, nbclient = pytest.importorskip("nbformat"), pytest.importorskip("nbclient")
    for name in ("IPYTHONDIR", "JUPYTER_CONFIG_DIR", "JUPYTER_DATA_DIR", "JUPYTER_RUNTIME_DIR"):
        monkeypatch.setenv(name, str(tmp_path / name))
    monkeypatch.setenv("PYTHONPATH", str(BUILD / "python"))
    monkeypatch.setenv("MPLBACKEND", "module://matplotlib_inline.backend_inline")
    book = nbformat.read(path, as_version=4)
    nbclient.NotebookClient(book, timeout=1800, resources={"metadata": {"path": str(tmp_path)}}).execute()
    complaints = [output.text for output in outputs_of(book) if output.get("name") == "stderr"]
    assert complaints == []
    assert pictures_lacking(book) == []
    if "KEEP_NOTEBOOKS" in os.environ:
        nbformat.write(made_small(book), pathlib.Path(os.environ["KEEP_NOTEBOOKS"]) / path.name)
