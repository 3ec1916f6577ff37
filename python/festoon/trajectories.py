"""The samples of a run: an array with the columns of a trajectory file."""

import os
from typing import Any, Optional, Tuple, Union

import numpy as np

from ._native import Watch, ffi, lib, path_bytes
from ._progress import Progress
from ._quantities import Scales
from ._tables import COLUMNS, Columns
from .bead import Bead

Path = Union[str, "os.PathLike[str]"]

#: A row of samples as the library writes it: a double for each column.
DTYPE = np.dtype([(name, "f8") for name in COLUMNS])
PLACES = {name: place for place, name in enumerate(COLUMNS)}


class TrajectoryIn(Columns):
    """The columns of a trajectory in other units, computed as they are asked for."""

    def __init__(self, trajectory: "Trajectory", units: str) -> None:
        self._trajectory, self._units = trajectory, units
        self._scales = Scales(trajectory.bead._params, units)

    def _column(self, name: str) -> Any:
        return self._trajectory._column(name) * self._scales.column(PLACES[name])[0]

    def __getitem__(self, name: str) -> Any:
        return self._column(name)

    def __reduce__(self) -> Any:
        return TrajectoryIn, (self._trajectory, self._units)

    def unit(self, name: str) -> str:
        """The unit of a column here."""
        return self._scales.column(PLACES[name])[1]


class Trajectory(Columns, np.ndarray):  # type: ignore[type-arg]
    """Samples as an array of numpy; columns are attributes and fields, scaled (l, 1/gamma, B0).

    >>> tr = Bead().run(periods=20, trajectory=True).trajectory
    >>> bool(np.allclose(tr.r, np.hypot(tr.x, tr.y)))
    True
    """

    bead: Bead
    #: False: of an interrupted run.
    complete: bool

    @classmethod
    def _of(cls, rows: Any, bead: Bead, complete: bool) -> "Trajectory":
        made: Trajectory = rows.view(cls)
        made.bead = bead
        made.complete = complete
        return made

    def __array_finalize__(self, source: Any) -> None:
        if source is not None:
            self.bead = getattr(source, "bead", None)  # type: ignore[assignment]
            self.complete = getattr(source, "complete", True)

    def __reduce__(self) -> Any:
        return _again, (np.array(self), self.bead, self.complete)

    def __getitem__(self, key: Any) -> Any:
        found = super().__getitem__(key)
        if isinstance(found, Trajectory) and found.dtype != self.dtype:
            return found.view(np.ndarray)
        return found

    def _column(self, name: str) -> Any:
        return self.view(np.ndarray)[name]

    @property
    def si(self) -> TrajectoryIn:
        """The columns in SI units."""
        return TrajectoryIn(self, "si")

    @property
    def lab(self) -> TrajectoryIn:
        """The columns in the units of a laboratory: mm, s, mm/s, mT."""
        return TrajectoryIn(self, "lab")

    def _table(self) -> Tuple[Any, Any]:
        """The library's form of a trajectory, and what must stay alive with it."""
        columns = [np.ascontiguousarray(self._column(name)) for name in COLUMNS]
        pointers = ffi.new("double *[]", [ffi.cast("double *", ffi.from_buffer(c)) for c in columns])
        table = ffi.new("fst_table *")
        table.rows = len(self)
        table.columns = pointers
        table.params = self.bead._params[0]
        table.complete = self.complete
        return table, (columns, pointers)

    def plot(self, colour: str = "n_z", **options: Any) -> Any:
        """Draw the path with matplotlib; returns its Axes: see `festoon.plots.trajectory`."""
        from . import plots

        return plots.trajectory(self, colour, **options)

    def figure(self, path: Path, kind: str = "path", **options: Any) -> None:
        """The program's figure as .svg, .pdf or .png.

        Kinds: path, local-n, radius-field, time, section, ramp.  Options: colour, arrows, inset, begin, end
        (drive periods), zoom (mm), title, keys, units.
        """
        from . import figures

        figures.trajectory(self, path, kind, **options)

    def movie(self, path: Path, *, progress: Progress = None, **options: Any) -> None:
        """A film of the motion, .mp4, .gif or a folder of PNG frames.

        Options: width, height, fps, begin, end (drive periods), seconds_per_turn, colour, units.
        """
        from . import films

        films.movie(self, path, progress, **options)

    def film(self, path: Path, *, truth: Optional[Path] = None, progress: Progress = None, **options: Any) -> Any:
        """A gray film as a camera over the plate takes it; the options are those of fst_camera_options."""
        from . import films

        return films.camera(self, path, truth, progress, **options)


def _again(rows: Any, bead: Bead, complete: bool) -> Trajectory:
    return Trajectory._of(rows, bead, complete)


def read(path: Path) -> Trajectory:
    """Read a trajectory from .h5 or .csv."""
    table = ffi.gc(ffi.new("fst_table *"), lib.fst_table_free)
    with Watch(None) as watch:
        watch.call_apart(lib.fst_trajectory_read, path_bytes(path), table)
    rows = np.empty(table.rows, DTYPE)
    for i, name in enumerate(COLUMNS):
        if table.rows:
            rows[name] = np.frombuffer(ffi.buffer(table.columns[i], 8 * table.rows), "f8")
    found, table.map = table.map, ffi.NULL
    bead = Bead._out_of_file(table.params, ffi.gc(found, lib.fst_field_map_free) if found else None)
    return Trajectory._of(rows, bead, bool(table.complete))


