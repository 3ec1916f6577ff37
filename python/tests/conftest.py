"""The module of the build tree, and the program beside it."""

import os
import pathlib
import sys

import pytest

BUILD = pathlib.Path(os.environ.get("BUILD_DIR", pathlib.Path(__file__).resolve().parents[2] / "build"))
sys.path.insert(0, str(BUILD / "python"))
os.environ.setdefault("MPLBACKEND", "Agg")


@pytest.fixture(scope="session")
def program():
    return os.environ.get("FESTOON", str(BUILD / "festoon"))


@pytest.fixture(scope="session")
def bead():
    import festoon

    return festoon.Bead(run__periods=60)
