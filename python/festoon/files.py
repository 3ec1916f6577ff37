"""Files of the program: trajectories, sweeps, branches."""

import json
import os
from typing import Any, Dict, Iterable, List, Optional, Union

from ._errors import BadInput
from ._native import Watch, call, ffi, lib, options_of, path_bytes, strings, take_text
from ._progress import Progress
from ._quantities import units_of
from .orbits import read_branch
from .sweeps import read_sweep
from .trajectories import read as read_trajectory

Path = Union[str, "os.PathLike[str]"]


def export(
    database: Path, path: Path, keys: Iterable[str] = (), units: str = "scaled"
) -> None:
    """Write the rows of a sweep's database as .csv, .json or .h5; with `keys` only these, as .csv with units."""
    name = os.fspath(path)
    endings = {".csv": lib.FST_EXPORT_CSV, ".json": lib.FST_EXPORT_JSON, ".h5": lib.FST_EXPORT_HDF5}
    words, kept = strings(list(keys))
    if kept or units != "scaled":
        shown = units_of(units)
        call(lib.fst_sweep_export_keys, path_bytes(database), words, len(kept), shown, path_bytes(path), ffi.NULL)
        return
    ending = os.path.splitext(name)[1]
    if ending not in endings:
        raise BadInput("export", f'"{name}" must end in .csv, .json or .h5')
    call(lib.fst_sweep_export, path_bytes(database), endings[ending], path_bytes(path), ffi.NULL)


def schema() -> List[Dict[str, Any]]:
    """The table of all parameters: key, unit, default, min, max, doc."""
    rows: List[Dict[str, Any]] = json.loads(take_text(lib.fst_schema_json()))
    return rows


def paper(
    directory: Path, *, reduced: bool = False, films: bool = False, only: Optional[str] = None, progress: Progress = None
) -> str:
    """Compute what the paper shows, with figures and a report in `directory`; returns the summary.

    With `only`, the id of a statement, nothing is written and the statement comes back as JSON.
    """
    options = options_of(lib.fst_default_paper_options())
    summary, word = ffi.new("char **"), ffi.new("char[]", (only or "").encode())
    options.reduced, options.films, options.summary = reduced, films, summary
    if only is not None:
        options.only = word
    with Watch(progress, title="paper") as watch:
        options.progress = watch.told
        watch.call(lib.fst_paper, path_bytes(directory), options)
    return take_text(summary[0])


def read(path: Path) -> Any:
    """Read what the program or this module wrote: a trajectory (.h5, .csv), a sweep (.db) or a branch (.json)."""
    name = os.fspath(path)
    if lib.fst_is_sweep(path_bytes(path)) or name.endswith(".db"):
        return read_sweep(path)
    if name.endswith(".json"):
        return read_branch(path)
    return read_trajectory(path)
