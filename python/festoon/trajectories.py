"""The samples of a run: an array with the columns of a trajectory file."""

import os
import textwrap
from typing import Any, List, Optional, Tuple, Union

import numpy as np

from ._native import Watch, ffi, lent, lib, path_bytes
from ._progress import Progress
from ._quantities import Scales
from ._tabled import DOCS, Table, Tabled, about, scaled_columns, scales_of
from ._tables import COLUMNS, Columns
from .bead import Bead
from .films import Filmed

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


class Trajectory(Filmed, Tabled, Columns, np.ndarray):  # type: ignore[type-arg]
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

    def _told(self) -> List[str]:
        """What a card says of it."""
        head = f"Trajectory: {len(self)} samples of {len(self.dtype.names or ())} columns"
        lines = [head + ("" if self.complete else " (interrupted)")]
        if len(self):
            lab, turns = self.lab, self.drive_turns
            lines.append(f"drive periods {turns[0]:.6g} to {turns[-1]:.6g}, {lab.t[0]:.6g} to {lab.t[-1]:.6g} {lab.unit('t')}")
            lines.append(f"r from {lab.r.min():.4g} to {lab.r.max():.4g} {lab.unit('r')}")
        return [*lines, f"columns: {', '.join(self.dtype.names or ())}"]

    def __repr__(self) -> str:
        if self.dtype != DTYPE or self.ndim != 1 or self.bead is None:
            return repr(self.view(np.ndarray))
        return "\n".join(line for part in self._told() for line in textwrap.wrap(part, 108, subsequent_indent="  "))

    def __str__(self) -> str:
        return repr(self)

    def _repr_html_(self) -> str:
        from . import _cards

        return _cards.trajectory_card(self)

    @property
    def si(self) -> TrajectoryIn:
        """The columns in SI units."""
        return TrajectoryIn(self, "si")

    @property
    def lab(self) -> TrajectoryIn:
        """The columns in the units of a laboratory: mm, s, mm/s, mT."""
        return TrajectoryIn(self, "lab")

    def _table(self, units: Optional[str]) -> Table:
        values = {name: self._column(name).ravel() for name in COLUMNS}
        units_of_columns = {name: unit for name, (unit, _) in COLUMNS.items()}
        columns = scaled_columns(("t",), values, units_of_columns, scales_of(self.bead._params, units), DOCS)
        return Table(("t",), {"t": columns.pop("t")}, columns, about(self.bead.scene()))

    def _rows(self) -> Tuple[Any, Any]:
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
        """Draw the path with matplotlib; returns its Axes: see `festoon.plots.trajectory`.

        Parameters
        ----------
        colour
            The column that colours the path.
        **options
            Those of the function that is named above.

        Returns
        -------
        matplotlib.axes.Axes
            The Axes with the picture, in which all can still be changed.

        Raises
        ------
        BadInput
            Where a name is unknown; the sentence has the nearest.
        Unavailable
            Where matplotlib is missing.
        """
        from . import plots

        return plots.trajectory(self, colour, **options)

    def figure(self, path: Path, kind: str = "path", **options: Any) -> None:
        """The program's figure as .svg, .pdf or .png.

        Kinds: path, local-n, radius-field, time, section, ramp.  Options: colour, arrows, inset, begin, end
        (drive periods), zoom (mm), title, keys, units.

        Parameters
        ----------
        path
            The picture.
        kind
            One of those above.
        **options
            Those above.

        Raises
        ------
        BadInput
            Where the ending of the path, or an option, is wrong.
        Unavailable
            Where gnuplot or the ending's converter is missing.
        """
        from . import figures

        figures.trajectory(self, path, kind, **options)

    def movie(self, path: Path, *, progress: Progress = None, **options: Any) -> None:
        """A film of the motion, .mp4, .gif or a folder of PNG frames.

        Options: width, height, fps, begin, end (drive periods), seconds_per_turn, colour, units.

        Parameters
        ----------
        path
            The film.
        progress
            True: a bar; or a function of (fraction, what).
        **options
            Those above.

        Raises
        ------
        BadInput
            Where an argument is wrong; the sentence says what was expected.
        Unavailable
            Where ffmpeg or cairo is missing.
        Interrupted
            After Ctrl-C.
        """
        from . import films

        films.movie(self, path, progress, **options)

    def film(self, path: Path, *, truth: Optional[Path] = None, progress: Progress = None, **options: Any) -> Any:
        """A gray film as a camera over the plate takes it; the options are those of fst_camera_options.

        Parameters
        ----------
        path
            The film.
        truth
            A file for where the bead was.
        progress
            True: a bar; or a function of (fraction, what).
        **options
            width, height, fps (1/s), exposure (s), noise (gray levels), tilt (degrees), distance (m), plate (m), ...

        Returns
        -------
        dict
            What is known of the film: frames, plate (m), distance (m), ...

        Raises
        ------
        BadInput
            Where an argument is wrong; the sentence says what was expected.
        Unavailable
            Where ffmpeg is missing.
        Interrupted
            After Ctrl-C.
        """
        from . import films

        return films.camera(self, path, truth, progress, **options)


def _again(rows: Any, bead: Bead, complete: bool) -> Trajectory:
    return Trajectory._of(lent(rows), bead, complete)


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
    return Trajectory._of(lent(rows), bead, bool(table.complete))


