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


@pytest.fixture(scope="session")
def noisy(tmp_path_factory):
    """A bead over a noisy map of 14 x 12 samples, and its noise [T]."""
    import festoon as fs
    import numpy as np

    x, y = np.meshgrid(np.arange(-39, 40, 6.0), np.arange(-33, 34, 6.0))
    B, _ = fs.Bead(magnet__b0="10 mT").field(x / 23, y / 23)
    B = 10 * B + np.random.default_rng(2).normal(scale=0.02, size=B.shape)
    path = tmp_path_factory.mktemp("map") / "noisy.csv"
    rows = np.column_stack([x.ravel(), y.ravel(), np.full(x.size, 18.7), B.reshape(-1, 3)])
    np.savetxt(path, rows, delimiter=",", header="x [mm],y [mm],z [mm],Bx [mT],By [mT],Bz [mT]", comments="")
    return fs.Bead(magnet__file=str(path), magnet__b0="10 mT", kappa=1.5)
