"""Results over a grid of parameters: what a sweep is, and how its database is read."""

import json
import os
import tempfile
from typing import Any, Dict, List, Mapping, Optional, Tuple, Union

import numpy as np

from ._errors import BadInput, FestoonError, OutOfMemory, warn
from ._keys import key_of
from ._native import Watch, call, dtype_of, exception_of, ffi, lent, lib, owned_array, path_bytes, strings, text_of
from ._tabled import NUMBERS, OF_PLATE, Table, Tabled, about, numbers_of, scaled_columns
from ._tables import PARAMETERS, RESULTS, SweepNumbers
from .bead import Bead
from .runs import REGIMES, SYMMETRIES, Run
from .sweep_tables import Axis, ScalesOver, SweepTable, coords_of, scales_at, sizes_of

Path = Union[str, "os.PathLike[str]"]

NOT_RUN = -1


class SweepIn(SweepNumbers):
    """The numbers of a sweep in other units."""

    def __init__(self, sweep: "Sweep", units: str) -> None:
        self._sweep, self._units = sweep, units
        self._scales = ScalesOver(sweep._scales(), units)

    def _array(self, name: str) -> Any:
        return self._sweep._array(name) * self._scales.factor(name, RESULTS[name][0])[0]

    def parameter(self, keyword: str) -> Any:
        """The values of a varied parameter, as `Sweep.parameter`."""
        axis = self._sweep._axis(keyword)
        return axis.at(self._sweep._points, axis.shown(self._scales)[0])

    def __getattr__(self, name: str) -> Any:
        sweep = self.__dict__.get("_sweep")
        if sweep is not None and any(axis.keyword == name for axis in sweep.axes):
            return self.parameter(name)
        raise AttributeError(f"a Sweep has no {name} in other units")

    def unit(self, name: str) -> str:
        """The unit of a number, or of a varied parameter, here."""
        if name in RESULTS:
            return self._scales.factor(name, RESULTS[name][0])[1]
        return str(self._sweep._axis(name).shown(self._scales)[1])

    def __reduce__(self) -> Any:
        return SweepIn, (self._sweep, self._units)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, SweepIn) and self._units == other._units and self._sweep == other._sweep

    def __hash__(self) -> int:
        return hash((self._sweep, self._units))


class Sweep(Tabled, SweepNumbers):
    """Results over a grid.  Every number of a run is an array of the grid's shape, NaN where a run failed.

    An index gives a run, a slice or a mask a smaller sweep: ``s[0, 1]``, ``s[:, 1]``, ``s[s.failed]``.  A run that
    failed has a `status` and an `error`, and NaN for its numbers.
    """

    def __init__(self, rows: Any, grid: Any, owner: Any, field_map: Any = None) -> None:
        self._rows, self._grid, self._owner, self._map = lent(rows), grid, owner, field_map
        #: Of a refined sweep: by point the regime of runs around it that agree, where none was made; else NaN.
        self._between: Any = None
        #: Where a run began from the end of its neighbour.
        self._carried = np.zeros(len(rows), int)
        #: Of random axes; None: not known, for it was read from a file.
        self._seed: Optional[int] = None
        self.axes = [Axis(grid, i) for i in range(lib.fst_grid_axis_count(grid))]
        sizes = sizes_of(self.axes)
        #: The name of each dimension.
        self.dims: Tuple[str, ...] = tuple(sizes)
        self._points = np.arange(len(rows)).reshape(tuple(sizes.values()))
        self._known_scales: Any = None

    # ------------------------------------------------------------------ its points

    @property
    def shape(self) -> Tuple[int, ...]:
        """The length of each dimension."""
        return tuple(self._points.shape)

    @property
    def size(self) -> int:
        """The number of points."""
        return int(self._points.size)

    def __len__(self) -> int:
        return len(self._points)

    def parameter(self, keyword: str) -> Any:
        """The values of a varied parameter, an array of the sweep's shape.

        Parameters
        ----------
        keyword
            Short or long, as in `festoon.sweep`.

        Returns
        -------
        numpy.ndarray
            In SI or scaled, as the parameter is; names of a choice.

        Raises
        ------
        KeyError
            Where it is not varied.
        """
        return self._axis(keyword).at(self._points)

    def _axis(self, keyword: str) -> Axis:
        for axis in self.axes:
            if axis.keyword == keyword or axis.key == key_of(str(keyword)):
                return axis
        raise KeyError(f"{keyword} is not varied: {', '.join(axis.keyword for axis in self.axes)}")

    def __getattr__(self, name: str) -> Any:
        """The values of a varied parameter: ``s.kappa`` is ``s.parameter("kappa")``."""
        axes = self.__dict__.get("axes", ())
        if any(axis.keyword == name for axis in axes):
            return self.parameter(name)
        raise AttributeError(f"a Sweep over {', '.join(axis.keyword for axis in axes)} has no {name}")

    def _bead(self, point: int) -> Bead:
        params = ffi.new("fst_params *")
        call(lib.fst_grid_params, self._grid, point, params)
        return Bead._of(params[0], self._map)

    def bead(self, *index: int) -> Bead:
        """The bead of a point.

        Parameters
        ----------
        *index
            Of a point, an integer for each dimension.

        Returns
        -------
        Bead
            With the values of this point.

        Raises
        ------
        IndexError
            Where there is no such point.
        """
        return self._bead(int(self._points[index]))

    def __getitem__(self, index: Any) -> Any:
        points = self._points[index]
        if np.ndim(points) == 0:
            return self._run(int(points))
        made = object.__new__(Sweep)
        made.__dict__.update(self.__dict__)
        made._points, made._known_scales = points, None
        made.dims = self._dims_of(index, points.ndim)
        return made

    def _dims_of(self, index: Any, count: int) -> Tuple[str, ...]:
        """Names of the dimensions that remain; a mask leaves one of points."""
        parts = index if isinstance(index, tuple) else (index,)
        for i, part in enumerate(parts):
            if part is Ellipsis:
                parts = (*parts[:i], *[slice(None)] * (len(self.dims) + 1 - len(parts)), *parts[i + 1 :])
                break
        if all(isinstance(part, (int, np.integer, slice)) for part in parts):
            kept = [
                name
                for i, name in enumerate(self.dims)
                if i >= len(parts) or isinstance(parts[i], slice)
            ]
            return tuple(kept)
        return tuple(f"point{i or ''}" for i in range(count))

    def _run(self, point: int) -> Run:
        """The run of a point; where there is no result, one whose numbers are NaN."""
        row = self._rows[point]
        result = ffi.new("fst_run_result *")
        ffi.memmove(result, np.ascontiguousarray(row["result"]).tobytes(), ffi.sizeof("fst_run_result"))
        if row["done"] and row["status"] == lib.FST_OK:
            return Run(self._bead(point), result)
        params = ffi.new("fst_params *")
        lib.fst_grid_params(self._grid, point, params, ffi.NULL)  # which may be why it failed
        result.symmetry = 0
        run = Run(Bead._unmade(params[0], self._map), result, complete=bool(row["done"]))
        run.status = text_of(lib.fst_status_text(int(row["status"]))) if row["done"] else "missing"
        run.error = self._error(point)
        if not row["done"]:
            result.reason = b"not computed, because the sweep was refined" if self.refined else b"not made: the sweep was interrupted"
        return run

    # ------------------------------------------------------------------ its numbers

    def _array(self, name: str) -> Any:
        column = self._rows["result"][name]
        if self._points.size == len(self._rows) and self._points.flags.c_contiguous:
            return column.reshape(self._points.shape)
        return lent(column[self._points])

    def _scales(self) -> Any:
        if self._known_scales is None:
            self._known_scales = scales_at(self._grid, self._points)
        return self._known_scales

    def _status(self) -> Any:
        return lent(np.where(self._rows["done"], self._rows["status"], NOT_RUN)[self._points])

    @property
    def regime(self) -> Any:
        """The regimes, as text; "" where there is none."""
        names = np.array([*REGIMES, ""])
        return lent(names[np.where(self.done, self._rows["result"]["regime"][self._points], len(REGIMES))])

    @property
    def symmetry(self) -> Any:
        """S1, S2 or ""."""
        names = np.array([name or "" for name in SYMMETRIES])
        return lent(names[np.where(self.done, self._rows["result"]["symmetry"][self._points], 0)])

    @property
    def status(self) -> Any:
        """What became of each run: "done", "missing", or in what way it failed."""
        words = np.array([*(text_of(lib.fst_status_text(i)) for i in range(lib.FST_STATUS_COUNT)), "missing"])
        return lent(words[self._status()])

    @property
    def reason(self) -> Any:
        """Why each regime, or why a run failed."""
        words = np.char.decode(self._rows["result"]["reason"][self._points], "utf-8", "replace").astype(object)
        for place in np.argwhere(self.failed):
            words[tuple(place)] = getattr(self.errors[tuple(place)], "sentence")
        return lent(words.astype(str))

    @property
    def dynamics(self) -> Any:
        """The equations of motion of each run, farago2020 or rigid."""
        varied = [axis for axis in self.axes if axis.key == "model.dynamics"]
        base = PARAMETERS["model.dynamics"][1].split(", ")[lib.fst_grid_base(self._grid).model_dynamics]
        return varied[0].at(self._points) if varied else lent(np.full(self.shape, base))

    @property
    def rhs_calls(self) -> Any:
        """Evaluations of the equations of motion."""
        return lent(self._rows["result"]["rhs_calls"][self._points])

    @property
    def never_slips(self) -> Any:
        """Dry friction: 1 where the contact stuck all the time of the means, or 0; NaN: other laws."""
        slips = self._rows["result"]["never_slips"][self._points]
        return lent(np.where(slips < 0, np.nan, slips))

    @property
    def final_state(self) -> Any:
        """The states at the end, ten numbers each."""
        return lent(self._rows["result"]["final_state"][self._points])

    @property
    def done(self) -> Any:
        """Where there is a result."""
        return lent(self._status() == lib.FST_OK)

    @property
    def failed(self) -> Any:
        """Where a run failed."""
        return lent(self._status() > lib.FST_OK)

    @property
    def computed(self) -> Any:
        """Where a run was made, failed or not: everywhere, unless the sweep was refined or interrupted."""
        return lent(self._status() != NOT_RUN)

    @property
    def refined(self) -> bool:
        """Whether the sweep was refined: where it is not `computed`, no run was wanted."""
        return self._between is not None

    @property
    def complete(self) -> bool:
        """Whether every point was run."""
        return not bool(np.any(self._status() == NOT_RUN))

    def _error(self, point: int) -> Optional[FestoonError]:
        status = int(self._rows["status"][point])
        if status <= lib.FST_OK:
            return None
        pointer = int(self._rows["error"][point])
        if not pointer:
            return exception_of(status, "", text_of(lib.fst_status_text(status)))
        error = ffi.cast("fst_error *", pointer)
        return exception_of(status, text_of(error.where), text_of(error.sentence))

    @property
    def errors(self) -> Any:
        """Why runs failed: an array of exceptions, None where a run did not."""
        found = np.empty(self._points.shape, object)
        for place in np.argwhere(self.failed):
            found[tuple(place)] = self._error(int(self._points[tuple(place)]))
        return lent(found)

    @property
    def si(self) -> SweepIn:
        """The numbers in SI units."""
        return SweepIn(self, "si")

    @property
    def lab(self) -> SweepIn:
        """The numbers in the units of a laboratory."""
        return SweepIn(self, "lab")

    # ------------------------------------------------------------------ pickles, and equal ones

    def _axis_texts(self) -> List[str]:
        return [text_of(lib.fst_grid_axis_text(self._grid, i)) for i in range(len(self.axes))]

    def __reduce__(self) -> Tuple[Any, ...]:
        if self._seed is None and any(axis.random for axis in self.axes):
            raise TypeError("a sweep over random axes that was read from a file cannot be pickled: pass its path on")
        base = Bead._unmade(lib.fst_grid_base(self._grid)[0])
        grid = base._portable_scene(), self._axis_texts(), self._seed or 0
        rows = self._rows.copy()
        rows["error"] = 0
        errors = {}
        for i in np.flatnonzero(self._rows["error"]):
            error = ffi.cast("fst_error *", int(self._rows["error"][i]))
            errors[int(i)] = ffi.string(error.where), ffi.string(error.sentence)
        return _sweep_again, (grid, rows, errors, self._points, self.dims, self._between, self._carried)

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Sweep):
            return NotImplemented
        alike = [
            (s.dims, s.shape, s._axis_texts(), Bead._unmade(lib.fst_grid_base(s._grid)[0])) for s in (self, other)
        ]
        if alike[0] != alike[1] or not np.array_equal(self._points, other._points):
            return False
        if list(map(str, self.errors.ravel())) != list(map(str, other.errors.ravel())):
            return False
        if not all(np.array_equal(axis.values, its.values) for axis, its in zip(self.axes, other.axes)):
            return False
        words = ("computed", "regime", "reason")
        if not all(np.array_equal(getattr(self, name), getattr(other, name)) for name in words):
            return False
        return all(np.array_equal(self._array(name), other._array(name), equal_nan=True) for name in RESULTS)

    def __hash__(self) -> int:
        return hash((self.dims, self.shape, *self._axis_texts()))

    # ------------------------------------------------------------------ for other libraries

    def _table(self, units: Optional[str]) -> Table:
        """The columns of `festoon export --csv`, each row in the units of its point."""
        shown = ScalesOver(self._scales(), units)
        coords = coords_of(self.axes, self.dims, self._points, shown)
        known, docs = ({name: row[i] for name, row in RESULTS.items()} for i in (0, 1))
        result = self._rows["result"]
        values: Dict[str, Any] = {"point": self._points, "status": self.status, "carried": self._carried[self._points]}
        values.update((name, getattr(self, name)) for name in ("regime", "symmetry", "reason", "dynamics", "never_slips"))
        values.update((name, self._array(name)) for name in RESULTS)
        values.update({"returns": result["returns"][self._points], "rhs_calls": self.rhs_calls,
                       "steps_accepted": result["accepted"][self._points], "steps_rejected": result["rejected"][self._points]})
        values.update(numbers_of(self.final_state, OF_PLATE, before="final_"))
        known.update({f"final_{name}": NUMBERS[name] for name in OF_PLATE})
        # omega is a parameter and a result: the same number, and one column.
        columns = scaled_columns(self.dims, {name: value for name, value in values.items() if name not in coords}, known, shown, docs)
        scene = Bead._unmade(lib.fst_grid_base(self._grid)[0]).scene()
        return Table(self.dims, coords, columns, about(scene, axes="; ".join(self._axis_texts())))

    def plot(self, y: Any = None, **options: Any) -> Any:
        """Draw curves or a map with matplotlib; returns its Axes: see `festoon.plots.sweep`.

        Parameters
        ----------
        y
            What is drawn.
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

        return plots.sweep(self, y, **options)

    def __repr__(self) -> str:
        size = " x ".join(f"{name} {length}" for name, length in zip(self.dims, self.shape))
        status = self._status()
        words = [f"Sweep: {size}; {int(np.sum(status == lib.FST_OK))} done"]
        if np.any(status > 0):
            words.append(f"{int(np.sum(status > 0))} failed")
        if not self.complete:
            words.append(f"{int(np.sum(status == NOT_RUN))} {'left out (refined)' if self.refined else 'not run'}")
        regimes, counts = np.unique(self.regime[self.done], return_counts=True)
        words += [f"{count} {regime}" for regime, count in zip(regimes, counts)]
        return ", ".join(words)


# ---------------------------------------------------------------------------------------- from rows


def grid_of(bead: Bead, axes: List[str], seed: int) -> Any:
    words, _kept = strings(axes)
    grid = ffi.new("fst_grid **")
    call(lib.fst_grid_new, bead._params, words, len(axes), seed, grid)
    return ffi.gc(grid[0], lib.fst_grid_free)


def sweep_of(batch: Any, grid: Any, field_map: Any = None) -> Sweep:
    """The rows of a batch as a sweep; what is not there becomes NaN."""
    owner = (batch, grid)
    count = int(lib.fst_grid_points(grid))
    rows = owned_array(lib.pyf_batch_rows(batch), count, dtype_of("pyf_row"), owner, writable=True)
    lacking = (rows["done"] == 0) | (rows["status"] != lib.FST_OK)
    if lacking.any():
        for name in (*RESULTS, "final_state"):
            rows["result"][name][lacking] = np.nan
        rows["result"]["never_slips"][lacking] = -1
    return Sweep(rows, grid, owner, field_map)


def _sweep_again(
    given: Tuple[str, List[str], int], rows: Any, errors: Mapping[int, Any], points: Any, dims: Any, between: Any, carried: Any
) -> Sweep:
    """A sweep from another process, which must have the same build."""
    scene, axes, seed = given
    if rows.dtype != dtype_of("pyf_row"):
        raise BadInput("Sweep", "it was pickled by another version of festoon")
    grid = grid_of(Bead._unmade_of(scene), axes, seed)
    batch = ffi.gc(lib.pyf_batch_new(grid, lib.FST_ARITHMETIC_PORTABLE, 0), lib.pyf_batch_free)
    if not batch:
        raise OutOfMemory("sweep", "no memory for the rows")
    ours = owned_array(lib.pyf_batch_rows(batch), len(rows), rows.dtype, (batch, grid), writable=True)
    ours[:] = rows
    for i, (where, sentence) in errors.items():
        if not lib.pyf_row_fail(lib.pyf_batch_rows(batch) + i, where, sentence):
            raise OutOfMemory("sweep", "no memory for a row")
    made = Sweep(ours, grid, (batch, grid))
    made._points, made.dims, made._between, made._carried, made._seed = points, dims, between, carried, seed
    return made


# ---------------------------------------------------------------------------------------- reading one


def _fill(row: Any, given: Mapping[str, Any], texts: Mapping[str, int]) -> None:
    """A row from what the database says of a point."""
    row.done = 1
    row.status = texts.get(given["status"], lib.FST_NO_CONVERGENCE)
    result = row.result
    for name in RESULTS:
        value = given.get(name)
        setattr(result, name, float("nan") if value is None else value)
    slips = given.get("never_slips")
    result.never_slips = -1 if slips is None else int(slips)
    if row.status != lib.FST_OK:
        if not lib.pyf_row_fail(ffi.addressof(row), b"", (given.get("reason") or given["status"]).encode()):
            raise OutOfMemory("sweep", "no memory for a row")
        return
    result.regime = REGIMES.index(given["regime"])
    result.symmetry = SYMMETRIES.index(given["symmetry"])
    result.reason = (given.get("reason") or "").encode()[:255]
    result.returns, result.rhs_calls = given["returns"], given["rhs_calls"]
    result.accepted, result.rejected = given["steps_accepted"], given["steps_rejected"]
    result.final_state = given["final_state"]


def _regimes_between(path: Path) -> Any:
    """The regimes that a refined sweep gives to points without a run; None: it is not refined, or damaged."""
    keys, _kept = strings(["regime"])
    table = ffi.new("fst_sweep_table *")
    try:
        call(lib.fst_sweep_read_filled, path_bytes(path), keys, 1, table)
    except BadInput:
        return None
    try:
        if table.refine == 0:
            return None
        count = int(lib.fst_grid_points(table.grid))
        values = np.frombuffer(ffi.buffer(table.values, 8 * count)).copy()
        values[np.frombuffer(ffi.buffer(table.computed, count), np.uint8) == 1] = np.nan
        return values
    finally:
        lib.fst_sweep_table_free(table)


def read_sweep(path: Path) -> Any:
    """Read a sweep's database: a Sweep, or of beads and worlds a SweepTable."""
    found = ffi.new("fst_grid **")
    call(lib.fst_sweep_read_grid, path_bytes(path), found)
    grid = ffi.gc(found[0], lib.fst_grid_free)
    # After Ctrl-C the thread that still writes there may be quicker than the end of the folder.
    with tempfile.TemporaryDirectory(prefix="festoon-", ignore_cleanup_errors=True) as folder:
        out = os.path.join(folder, "rows.json")
        try:
            with Watch(None) as watch:
                watch.call_apart(lib.fst_sweep_export, path_bytes(path), lib.FST_EXPORT_JSON, out.encode(), ffi.NULL, ffi.NULL)
        except FestoonError as error:
            if not os.path.exists(out) or isinstance(error, OutOfMemory):
                raise
            warn(error.sentence)
        with open(out, encoding="utf-8") as file:
            given = json.load(file)
    if given and "symmetry" not in given[0]:
        return SweepTable(grid, given)
    batch = ffi.gc(lib.pyf_batch_new(grid, lib.FST_ARITHMETIC_PORTABLE, 0), lib.pyf_batch_free)
    if not batch:
        raise OutOfMemory("sweep", "no memory for the rows")
    rows = lib.pyf_batch_rows(batch)
    texts = {text_of(lib.fst_status_text(i)): i for i in range(lib.FST_STATUS_COUNT)}
    for row in given:
        _fill(rows[row["point"]], row, texts)
    made = sweep_of(batch, grid)
    made._carried[[row["point"] for row in given]] = [row["carried"] for row in given]
    made._between = _regimes_between(path)
    return made
