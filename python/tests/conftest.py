"""The module of the build tree, and the program beside it."""

import json
import os
import pathlib
import subprocess
import sys

import pytest

BUILD = pathlib.Path(os.environ.get("BUILD_DIR", pathlib.Path(__file__).resolve().parents[2] / "build"))
sys.path.insert(0, str(BUILD / "python"))
os.environ.setdefault("MPLBACKEND", "Agg")


def ask(program, *words):
    """The JSON that the program prints."""
    return json.loads(subprocess.run([program, *words], check=True, stdout=subprocess.PIPE).stdout)


@pytest.fixture(scope="session")
def program():
    return os.environ.get("FESTOON", str(BUILD / "festoon"))


@pytest.fixture(scope="session")
def bead():
    import festoon

    return festoon.Bead(run__periods=60)
