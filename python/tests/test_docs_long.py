"""Every example in a docstring gives what it says, and every type is right."""

import doctest
import importlib
import os
import pathlib
import pkgutil
import shutil
import subprocess

import pytest

import festoon
from conftest import BUILD

SOURCE = pathlib.Path(os.environ.get("SOURCE_DIR", pathlib.Path(__file__).resolve().parents[2]))
MODULES = [f"festoon.{module.name}" for module in pkgutil.iter_modules(festoon.__path__) if module.name != "_festoon"]


@pytest.mark.parametrize("name", ["festoon", *MODULES])
def test_docstrings(name, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert doctest.testmod(importlib.import_module(name)).failed == 0


def test_examples_are_found():
    """At least the calls that a reader meets first have an example."""
    found = [test for test in doctest.DocTestFinder().find(festoon.bead.Bead) if test.examples]
    assert len(found) >= 4


def test_types(tmp_path):
    mypy = shutil.which("mypy", path="/usr/bin:/usr/local/bin")
    if not mypy:
        pytest.skip("mypy is not there")
    (tmp_path / "user.py").write_text(
        "import festoon as fs\n"
        "bead = fs.Bead(frequency='10.7 Hz', friction__law='coulomb')\n"
        "reveal_type(bead.replace(kappa=1.2))\n"
        "reveal_type(bead.run().mean_r)\n"
        "reveal_type(fs.sweep(bead, kappa=[1, 2])[0])\n"
        "reveal_type(fs.World(plate__shape='none').orbit())\n"
        "lab: float = bead.run().lab.mean_r + float(fs.sweep(bead, kappa=[1, 2]).lab.kappa[0])\n"
        "fs.Bead(frequenzy=3)\n"
    )
    config = ["--config-file", str(SOURCE / "pyproject.toml")]
    package = subprocess.run(
        [mypy, *config, "--cache-dir", str(tmp_path / "cache"), "-p", "festoon"],
        cwd=BUILD / "python", stdout=subprocess.PIPE, text=True, check=False,
    )
    assert package.returncode == 0, package.stdout
    user = subprocess.run(
        [mypy, *config, "--cache-dir", str(tmp_path / "cache"), str(tmp_path / "user.py")],
        cwd=BUILD / "python", stdout=subprocess.PIPE, text=True, check=False,
    ).stdout
    assert "Union[festoon.beads_orbits.BeadsOrbit, festoon.beads_orbits.WorldOrbit]" in user, user
    assert "festoon.bead.Bead" in user and 'is "builtins.float"' in user, user
    assert 'Unexpected keyword argument "frequenzy"' in user and "Found 1 error" in user, user
