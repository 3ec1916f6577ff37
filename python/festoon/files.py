"""Files of the program: trajectories, sweeps, branches."""

import os
from typing import Any, Union

from ._native import lib, path_bytes
from .orbits import read_branch
from .sweeps import read_sweep
from .trajectories import read as read_trajectory

Path = Union[str, "os.PathLike[str]"]


def read(path: Path) -> Any:
    """Read what the program or this module wrote: a trajectory (.h5, .csv), a sweep (.db) or a branch (.json)."""
    name = os.fspath(path)
    if lib.fst_is_sweep(path_bytes(path)) or name.endswith(".db"):
        return read_sweep(path)
    if name.endswith(".json"):
        return read_branch(path)
    return read_trajectory(path)
