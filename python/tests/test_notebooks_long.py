"""The notebooks run from the first cell to the last, and hold neither outputs nor paths of a machine."""

import json
import os
import pathlib

import pytest

from conftest import BUILD

SOURCE = pathlib.Path(os.environ.get("SOURCE_DIR", pathlib.Path(__file__).resolve().parents[2]))
NOTEBOOKS = sorted((SOURCE / "examples/notebooks").glob("*.ipynb"))


def test_there_are_three():
    assert [path.stem for path in NOTEBOOKS] == ["from-a-film-to-parameters", "paper-in-ten-cells", "your-own-magnet"]


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_clean(path):
    text = path.read_text(encoding="utf-8")
    for cell in json.loads(text)["cells"]:
        assert cell.get("outputs", []) == [] and cell.get("execution_count") is None
    for folder in ("/home/", "/tmp", "/root", str(SOURCE)):
        assert folder not in text


def test_the_paper_has_ten_cells():
    book = json.loads((SOURCE / "examples/notebooks/paper-in-ten-cells.ipynb").read_text(encoding="utf-8"))
    assert sum(cell["cell_type"] == "code" for cell in book["cells"]) == 10


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
    outputs = [output for cell in book.cells if cell.cell_type == "code" for output in cell.outputs]
    complaints = [output.text for output in outputs if output.get("name") == "stderr"]
    assert complaints == []
    drawn = [cell for cell in book.cells if cell.cell_type == "code" and ".plot" in cell.source]
    pictures = [output for output in outputs if "image/png" in output.get("data", {})]
    assert len(pictures) >= len(drawn) > 0
    if "KEEP_NOTEBOOKS" in os.environ:
        nbformat.write(book, pathlib.Path(os.environ["KEEP_NOTEBOOKS"]) / path.name)
