"""Files of the program: trajectories, sweeps, branches."""

import json
import os
import subprocess
from typing import Any, Dict, Iterable, List, Optional, Union

from ._errors import BadInput, FestoonError, Unavailable, warn
from ._native import Watch, call, ffi, lib, path_bytes, strings, take_text, text_of
from ._progress import Progress
from ._quantities import units_of
from .beads_trajectories import read as read_beads
from .branches import read_branch
from .sweeps import read_sweep
from .trajectories import read as read_trajectory

Path = Union[str, "os.PathLike[str]"]


def export(
    database: Path, path: Path, keys: Iterable[str] = (), units: str = "scaled"
) -> None:
    """Write the rows of a sweep's database as .csv, .json or .h5; with `keys` only these, as .csv with units.

    Parameters
    ----------
    database
        The sweep.
    path
        The table.
    keys
        Columns; none: all.
    units
        "scaled", "lab" or "si".

    Raises
    ------
    MissingFile
        Where the file is not there.
    BadInput
        Where it is damaged, or something else.
    """
    name = os.fspath(path)
    endings = {".csv": lib.FST_EXPORT_CSV, ".json": lib.FST_EXPORT_JSON, ".h5": lib.FST_EXPORT_HDF5}
    words, kept = strings(list(keys))
    if kept or units != "scaled":
        shown = units_of(units)
        with Watch(None) as watch:
            watch.call(lib.fst_sweep_export_keys, path_bytes(database), words, len(kept), shown, path_bytes(path), ffi.NULL, watch.told)
        return
    ending = os.path.splitext(name)[1]
    if ending not in endings:
        raise BadInput("export", f'"{name}" must end in .csv, .json or .h5')
    with Watch(None) as watch:
        watch.call(lib.fst_sweep_export, path_bytes(database), endings[ending], path_bytes(path), ffi.NULL, watch.told)


def merge(databases: Iterable[Path], path: Path, *, progress: Progress = None) -> Any:
    """Join the shards of a sweep, whole or not, in one new database, as `festoon merge` does, and read it.

    The files are only read, in any order, and may overlap.  A warning names points without a row; the call of
    `festoon.sweep` that made the shards, without `shard` and with the new file, computes them.

    Parameters
    ----------
    databases
        The shards.
    path
        The new database.
    progress
        True: a bar; or a function of (fraction, what).

    Returns
    -------
    Sweep or SweepTable
        All rows.

    Raises
    ------
    BadInput
        Where the new file is there already, or the files are not of one sweep, or their rows differ, or some are
        damaged; of the last the others are merged all the same.
    MissingFile
        Where a file is not there.
    Interrupted
        After Ctrl-C; nothing is written.
    """
    if isinstance(databases, (str, bytes, os.PathLike)):
        raise BadInput("merge", "it takes a list of databases and the path of the new one")
    kept = [ffi.new("char[]", path_bytes(name)) for name in databases]
    merged = ffi.new("fst_sweep_merged *")
    with Watch(progress, title="merge") as watch:
        watch.call(lib.fst_sweep_merge, ffi.new("const char *[]", kept), len(kept), path_bytes(path), watch.told, merged)
    if merged.rows < merged.points:
        warn(f"{merged.points - merged.rows} of {merged.points} points have no row: {text_of(merged.missing)}")
    return read_sweep(path)


def schema() -> List[Dict[str, Any]]:
    """The table of all parameters: key, unit, default, min, max, doc.

    Returns
    -------
    list of dict
        One for each parameter.

    Raises
    ------
    OutOfMemory
        Where there is no memory for it.
    """
    rows: List[Dict[str, Any]] = json.loads(take_text(lib.fst_schema_json()))
    return rows


def _paper_program() -> List[str]:
    """The words that start `festoon paper`: its program beside the module or in the build tree, or the command."""
    here = os.path.dirname(os.path.abspath(__file__))
    for folder in (here, os.path.join(here, "..", "..")):
        if os.access(os.path.join(folder, "festoon-paper"), os.X_OK):
            return [os.path.join(folder, "festoon-paper")]
    return ["festoon", "paper"]


def paper(
    directory: Path, *, reduced: bool = False, films: bool = False, only: Optional[str] = None, progress: bool = False
) -> str:
    """Compute what the paper shows, with figures and a report in `directory`; returns the summary.

    With `only`, the id of a statement, nothing is written and the statement comes back as JSON.  The program
    `festoon paper` does it, which shows its progress on a terminal.

    Parameters
    ----------
    directory
        Where all goes.
    reduced
        Fewer and shorter runs.
    films
        Films too.
    only
        The id of one statement.
    progress
        Whether the program shows it on the terminal.

    Returns
    -------
    str
        The summary, or the statement as JSON.

    Raises
    ------
    BadInput
        Where there is no such statement.
    Unavailable
        Where the program is missing.
    """
    words = _paper_program() + ["--only", only] if only is not None else [*_paper_program(), "-o", os.fspath(directory)]
    words += ["--reduced"] * reduced + ["--films"] * (films and only is None)
    try:
        done = subprocess.run(words, stdout=subprocess.PIPE, stderr=None if progress else subprocess.PIPE, text=True, check=False)
    except FileNotFoundError as missing:
        raise Unavailable("paper", "the program festoon, which does this, is not on PATH") from missing
    if done.returncode != 0:
        kind = BadInput if done.returncode == 2 else FestoonError
        told = (done.stderr or "festoon paper failed").strip().removeprefix("festoon: ")
        option, colon, sentence = told.partition(": ")
        names = bool(colon) and option.startswith("--")
        raise kind(option[2:] if names else "paper", sentence if names else told)
    return done.stdout


def read(path: Path) -> Any:
    """Read what the program or this module wrote: a trajectory (.h5, .csv), a sweep (.db) or a branch (.json).

    Parameters
    ----------
    path
        The file, in any of its formats.

    Returns
    -------
    Trajectory, BeadsTrajectory, Sweep, SweepTable or Branch
        Scaled, as what was written.

    Raises
    ------
    MissingFile
        Where the file is not there.
    BadInput
        Where it is damaged, or something else.
    Interrupted
        After Ctrl-C.
    """
    name = os.fspath(path)
    is_sweep, has_beads = ffi.new("int *"), ffi.new("int *")
    if not name.endswith(".db"):
        call(lib.fst_is_sweep, path_bytes(path), is_sweep)
    if is_sweep[0] or name.endswith(".db"):
        return read_sweep(path)
    if name.endswith(".json"):
        return read_branch(path)
    call(lib.fst_trajectory_has_beads, path_bytes(path), has_beads)
    return read_beads(path) if has_beads[0] else read_trajectory(path)
