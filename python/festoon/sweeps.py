"""Runs over a grid of parameters, on all processors."""

import json
import os
import tempfile
import threading
import warnings
from typing import Any, Dict, List, Mapping, Optional, Tuple, Union

import numpy as np

from ._errors import ERRORS, BadInput, FestoonError, Interrupted, OutOfMemory
from ._native import (
    Watch,
    call,
    dtype_of,
    error_of,
    ffi,
    lib,
    new_error,
    options_of,
    owned_array,
    path_bytes,
    strings,
    text_of,
)
from ._progress import Progress, bar_for
from ._quantities import Scales, value_text
from ._tables import RESULTS, SweepNumbers
from .bead import Bead, key_of, keyword_of, row_of
from .runs import REGIMES, SYMMETRIES, Run

Path = Union[str, "os.PathLike[str]"]

NOT_RUN = -1
CARRY = {None: lib.FST_CARRY_NO, "up": lib.FST_CARRY_UP, "down": lib.FST_CARRY_DOWN}


class Axis:
    """A varied parameter: `values` in SI (of a choice, its names), and how far apart in points they are."""

    def __init__(self, grid: Any, number: int) -> None:
        self.key = text_of(lib.fst_grid_key(grid, number))
        self.keyword = keyword_of(self.key)
        self.random = lib.fst_grid_axis_spacing(grid, number) == lib.FST_SPACING_RANDOM
        self.stride = int(lib.fst_grid_axis_stride(grid, number))
        count = int(lib.fst_grid_axis_points(grid, number))
        values = np.array([lib.fst_grid_value(grid, number, i * self.stride) for i in range(count)])
        kind, names, _ = row_of(self.key)
        if kind == "str":
            self.values = np.array(names.split(", "))[values.astype(int)]
        else:
            self.values = values.astype(int) if kind == "int" else values

    def at(self, points: Any) -> Any:
        """The values at points of the grid."""
        return self.values[(points // self.stride) % len(self.values)]


class SweepIn(SweepNumbers):
    """The numbers of a sweep in other units."""

    def __init__(self, sweep: "Sweep", units: str) -> None:
        self._sweep, self._units = sweep, units
        for axis in sweep.axes:
            if axis.key in ("magnet.half_length", "friction.gamma", "bead.mass"):
                raise BadInput("sweep", f"{axis.key} is varied, and with it the unit of the scaled numbers")
        self._scales = Scales(lib.fst_grid_base(sweep._grid), units)

    def _array(self, name: str) -> Any:
        return self._sweep._array(name) * self._scales.factor(RESULTS[name][0])[0]

    def unit(self, name: str) -> str:
        """The unit of a number here."""
        return self._scales.factor(RESULTS[name][0])[1]

    def __reduce__(self) -> Any:
        return SweepIn, (self._sweep, self._units)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, SweepIn) and self._units == other._units and self._sweep == other._sweep

    def __hash__(self) -> int:
        return hash((self._sweep, self._units))


class Sweep(SweepNumbers):
    """Results over a grid.  Every number of a run is an array of the grid's shape, NaN where a run failed.

    An index gives a run, a slice or a mask a smaller sweep: ``s[0, 1]``, ``s[:, 1]``, ``s[s.failed]``.
    """

    def __init__(self, rows: Any, grid: Any, owner: Any, field_map: Any = None) -> None:
        self._rows, self._grid, self._owner, self._map = rows, grid, owner, field_map
        #: Of a refined sweep: by point the regime of runs around it that agree, where none was made; else NaN.
        self._between: Any = None
        #: Of random axes; None: not known, for it was read from a file.
        self._seed: Optional[int] = None
        self.axes = [Axis(grid, i) for i in range(lib.fst_grid_axis_count(grid))]
        #: The name and the length of each dimension.
        self.dims: Tuple[str, ...] = ()
        shape: List[int] = []
        drawn = False
        for axis in self.axes:
            if axis.random and drawn:
                continue
            drawn = drawn or axis.random
            self.dims += ("draw" if axis.random else axis.keyword,)
            shape.append(len(axis.values))
        self._points = np.arange(len(rows)).reshape(shape)

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
        """The values of a varied parameter, an array of the sweep's shape."""
        for axis in self.axes:
            if axis.keyword == keyword or axis.key == key_of(keyword):
                return axis.at(self._points)
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
        """The bead of a point."""
        return self._bead(int(self._points[index]))

    def __getitem__(self, index: Any) -> Any:
        points = self._points[index]
        if np.ndim(points) == 0:
            return self._run(int(points))
        made = object.__new__(Sweep)
        made.__dict__.update(self.__dict__)
        made._points = points
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
        row = self._rows[point]
        if not row["done"] and self.refined:
            raise BadInput("sweep", "this point was not computed, because the sweep was refined: see `computed`")
        if not row["done"]:
            raise Interrupted()
        if row["status"] != lib.FST_OK:
            raise self._error(point) or AssertionError("a failed run has an error")
        result = ffi.new("fst_run_result *")
        ffi.memmove(result, np.ascontiguousarray(row["result"]).tobytes(), ffi.sizeof("fst_run_result"))
        return Run(self._bead(point), result)

    # ------------------------------------------------------------------ its numbers

    def _array(self, name: str) -> Any:
        column = self._rows["result"][name]
        if self._points.size == len(self._rows) and self._points.flags.c_contiguous:
            return column.reshape(self._points.shape)
        return column[self._points]

    def _status(self) -> Any:
        return np.where(self._rows["done"], self._rows["status"], NOT_RUN)[self._points]

    @property
    def regime(self) -> Any:
        """The regimes, as text; "" where there is none."""
        names = np.array([*REGIMES, ""])
        return names[np.where(self.done, self._rows["result"]["regime"][self._points], len(REGIMES))]

    @property
    def symmetry(self) -> Any:
        """S1, S2 or ""."""
        names = np.array([name or "" for name in SYMMETRIES])
        return names[np.where(self.done, self._rows["result"]["symmetry"][self._points], 0)]

    @property
    def reason(self) -> Any:
        """Why each regime."""
        return np.char.decode(self._rows["result"]["reason"][self._points], "utf-8", "replace")

    @property
    def rhs_calls(self) -> Any:
        """Evaluations of the equations of motion."""
        return self._rows["result"]["rhs_calls"][self._points]

    @property
    def never_slips(self) -> Any:
        """Dry friction: 1 where the contact stuck all the time of the means, 0, or -1: other laws."""
        return self._rows["result"]["never_slips"][self._points]

    @property
    def final_state(self) -> Any:
        """The states at the end, ten numbers each."""
        return self._rows["result"]["final_state"][self._points]

    @property
    def done(self) -> Any:
        """Where there is a result."""
        return self._status() == lib.FST_OK

    @property
    def failed(self) -> Any:
        """Where a run failed."""
        return self._status() > lib.FST_OK

    @property
    def computed(self) -> Any:
        """Where a run was made, failed or not: everywhere, unless the sweep was refined or interrupted."""
        return self._status() != NOT_RUN

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
        kind = ERRORS.get(status, FestoonError)
        pointer = int(self._rows["error"][point])
        if not pointer:
            return kind("", text_of(lib.fst_status_text(status)))
        error = ffi.cast("fst_error *", pointer)
        return kind(text_of(error.where), text_of(error.sentence))

    @property
    def errors(self) -> Any:
        """Why runs failed: an array of exceptions, None where a run did not."""
        found = np.empty(self._points.shape, object)
        for place in np.argwhere(self.failed):
            found[tuple(place)] = self._error(int(self._points[tuple(place)]))
        return found

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
        return _sweep_again, (grid, rows, errors, self._points, self.dims, self._between)

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

    def to_pandas(self) -> Any:
        """A DataFrame with a row for each point."""
        import pandas

        columns: Dict[str, Any] = {axis.keyword: axis.at(self._points.ravel()) for axis in self.axes}
        columns["regime"] = self.regime.ravel()
        columns["symmetry"] = self.symmetry.ravel()
        for name in RESULTS:
            # omega is a parameter and a result: the same number, and one column.
            columns.setdefault(name, np.ascontiguousarray(self._array(name)).ravel())
        columns["error"] = ["" if error is None else str(error) for error in self.errors.ravel()]
        return pandas.DataFrame(columns)

    def to_xarray(self) -> Any:
        """A Dataset with units and docs in `attrs`; it has the dimensions of the sweep."""
        import xarray

        coords: Dict[str, Any] = {}
        for axis in self.axes:
            kind, unit, doc = row_of(axis.key)
            attrs = {"long_name": axis.key, "description": doc, **({} if kind == "str" else {"units": unit})}
            if axis.keyword in self.dims:
                along = self.dims.index(axis.keyword)
                points = np.moveaxis(self._points, along, 0).reshape(self.shape[along], -1)[:, 0]
                coords[axis.keyword] = (axis.keyword, axis.at(points), attrs)
            else:
                coords[axis.keyword] = (self.dims, axis.at(self._points), attrs)
        data: Dict[str, Any] = {"regime": (self.dims, self.regime), "symmetry": (self.dims, self.symmetry)}
        for name, (unit, doc) in RESULTS.items():
            if name not in coords:
                data[name] = (self.dims, self._array(name), {"units": unit, "long_name": name, "description": doc})
        return xarray.Dataset(data, coords)

    def plot(self, y: Any = None, **options: Any) -> Any:
        """Draw curves or a map with matplotlib; returns its Axes: see `festoon.plots.sweep`."""
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


# ---------------------------------------------------------------------------------------- making one


def axis_text(keyword: str, values: Any) -> str:
    """An axis as the library reads it: KEY=A,B,C; a text is taken as it is ("8:20:13", "8 Hz:20 Hz:5:log")."""
    if isinstance(values, str):
        return f"{key_of(keyword)}={values}"
    if hasattr(values, "__next__"):
        values = list(values)
    words = [value_text(value, key_of(keyword)) for value in np.atleast_1d(np.asarray(values, object)).ravel()]
    return f"{key_of(keyword)}={','.join(words)}"


def _new_grid(bead: Bead, axes: List[str], seed: int) -> Any:
    words, _kept = strings(axes)
    grid = ffi.new("fst_grid **")
    call(lib.fst_grid_new, bead._params, words, len(axes), seed, grid)
    return ffi.gc(grid[0], lib.fst_grid_free)


def _sweep_of(batch: Any, grid: Any, field_map: Any = None) -> Sweep:
    """The rows of a batch as a sweep; what is not there becomes NaN."""
    owner = (batch, grid)
    count = int(lib.fst_grid_points(grid))
    rows = owned_array(lib.pyf_batch_rows(batch), count, dtype_of("pyf_row"), owner)
    lacking = (rows["done"] == 0) | (rows["status"] != lib.FST_OK)
    if lacking.any():
        for name in RESULTS:
            rows["result"][name][lacking] = np.nan
    return Sweep(rows, grid, owner, field_map)


def _sweep_again(
    given: Tuple[str, List[str], int], rows: Any, errors: Mapping[int, Any], points: Any, dims: Any, between: Any
) -> Sweep:
    """A sweep from another process, which must have the same build."""
    scene, axes, seed = given
    if rows.dtype != dtype_of("pyf_row"):
        raise BadInput("Sweep", "it was pickled by another version of festoon")
    grid = _new_grid(Bead._unmade_of(scene), axes, seed)
    batch = ffi.gc(lib.pyf_batch_new(grid, lib.FST_ARITHMETIC_PORTABLE, 0), lib.pyf_batch_free)
    if not batch:
        raise OutOfMemory("sweep", "no memory for the rows")
    made = Sweep(owned_array(lib.pyf_batch_rows(batch), len(rows), rows.dtype, (batch, grid)), grid, (batch, grid))
    made._rows[:] = rows
    for i, (where, sentence) in errors.items():
        status = made._rows["status"][i]
        if not lib.pyf_row_fail(lib.pyf_batch_rows(batch) + i, where, sentence):
            raise OutOfMemory("sweep", "no memory for a row")
        made._rows["status"][i] = status
    made._points, made.dims, made._between, made._seed = points, dims, between, seed
    return made


def _work(batch: Any, threads: List[threading.Thread], count: int, failures: List[BaseException]) -> None:
    """Let so many threads do the batch; they are in `threads` before they begin, so that none is left behind."""

    def work() -> None:
        error = new_error()
        status = lib.pyf_batch_work(batch, error)
        if status not in (lib.FST_OK, lib.FST_INTERRUPTED):
            failures.append(error_of(error))
            lib.pyf_batch_stop(batch)

    for i in range(count):
        threads.append(threading.Thread(target=work, name=f"festoon-{i}", daemon=True))
        threads[-1].start()


def _join(threads: List[threading.Thread]) -> None:
    """Wait for threads that have been told to stop; a second Ctrl-C does not leave them behind."""
    for thread in threads:
        while thread.is_alive():
            try:
                thread.join()
            except KeyboardInterrupt:
                pass


def _in_memory(
    grid: Any, field_map: Any, threads: int, lanes: int, portable: bool, progress: Progress
) -> Sweep:
    arithmetic = lib.FST_ARITHMETIC_PORTABLE if portable else lib.fst_best_arithmetic()
    made = lib.pyf_batch_new(grid, arithmetic, lanes)
    if not made:
        raise OutOfMemory("sweep", f"no memory for {lib.fst_grid_points(grid)} rows")
    batch = ffi.gc(made, lib.pyf_batch_free)
    points = int(lib.fst_grid_points(grid))
    failures: List[BaseException] = []
    workers: List[threading.Thread] = []
    bar = bar_for(progress, "sweep")
    whole = False
    try:
        _work(batch, workers, max(1, min(threads, points)), failures)
        for worker in workers:
            while worker.is_alive():
                worker.join(0.05)
                done = int(lib.pyf_batch_done(batch))
                bar.tell(done / points, f"{done} of {points} runs")
        whole = True
    except KeyboardInterrupt:
        lib.pyf_batch_stop(batch)
        _join(workers)
        raise Interrupted(_sweep_of(batch, grid, field_map)) from None
    finally:
        bar.end(whole)
        lib.pyf_batch_stop(batch)
        _join(workers)
    if failures:
        raise failures[0]
    return _sweep_of(batch, grid, field_map)


def _into_file(
    bead: Bead,
    axes: List[str],
    path: Path,
    seed: int,
    carry: Optional[str],
    threads: int,
    lanes: int,
    portable: bool,
    refining: Tuple[int, Optional[str], float],
    progress: Progress,
) -> Sweep:
    options = options_of(lib.fst_default_sweep_options())
    words, _kept = strings(axes)
    options.axes, options.axis_count, options.seed = words, len(axes), seed
    if carry not in CARRY:
        raise BadInput("fst_sweep_options.carry", f'unknown direction "{carry}": up or down')
    options.carry, options.threads, options.lanes = CARRY[carry], threads, lanes
    levels, by, step = refining
    key = ffi.new("char[]", by.encode()) if by else ffi.NULL
    options.refine, options.refine_by, options.refine_step = levels, key, step
    if portable:
        options.arithmetic = lib.FST_ARITHMETIC_PORTABLE
    counts = ffi.new("fst_sweep_counts *")
    with Watch(progress, lambda: read_sweep(path), "sweep") as watch:
        options.progress = watch.told
        watch.call(lib.fst_sweep, bead._params, path_bytes(path), options, counts)
    if 0 < counts.undefined == counts.computed:
        warnings.warn(f"{by or 'regime'} has no value in any run, so nothing was refined", stacklevel=3)
    return read_sweep(path)


def _refining(levels: int, by: Optional[str], step: float) -> Tuple[int, Optional[str], float]:
    """What was asked for, where the step may also stand behind the key: "mean_r:0.05"."""
    key, colon, text = (by or "").partition(":")
    if not colon:
        return levels, by, step
    if step != 0.0:
        raise BadInput("refine_step", f'the step stands in refine_by="{by}" already: give it once')
    try:
        return levels, key, float(text)
    except ValueError:
        raise BadInput("refine_by", f'"{text}" in "{by}" must be a number, without a unit') from None


def sweep(
    bead: Optional[Bead] = None,
    *,
    file: Optional[Path] = None,
    carry: Optional[str] = None,
    threads: Optional[int] = None,
    lanes: int = 0,
    portable: bool = False,
    seed: int = 0,
    refine: int = 0,
    refine_by: Optional[str] = None,
    refine_step: float = 0.0,
    progress: Progress = None,
    **axes: Any,
) -> Sweep:
    """Run a bead over a grid of parameters: a :class:`Sweep`, on all processors that this process may use.

    Parameters
    ----------
    axes
        Parameters as keywords, each with an array, a list (of numbers, texts with units, or names of choices) or
        a text as the program takes it ("8:20:13", "1:100:20:log", "0.9:1.1:random:50").  Axes multiply.
    file
        A database: rows are kept in it, and the same call goes on where an interrupted one ended.
    carry
        "up" or "down": each run starts from the end of its neighbour along the first axis.
    portable
        Arithmetic that gives the bits of Bead.run() on every machine; slower.
    seed
        Of random axes.
    refine
        N: compute every 2**N-th value of each axis that is a text "LO:HI:COUNT" first, then those between, N times,
        where the regime differs between neighbours.  The sweep has the shape of the whole grid all the same;
        `computed` says where there are runs.  At the other points numbers are NaN and the regime is "".  Arrays
        and lists have no order: what each of their values gives is refined by itself.
    refine_by, refine_step
        Refine where this key differs instead: "symmetry", or a number by more than the step (in scaled units),
        which may also stand behind the key: "mean_r:0.05".

    A run that fails is a row of NaN with an error, not an exception.  Ctrl-C raises `Interrupted`, whose
    `partial` is the sweep with the rows that were done.

    >>> s = sweep(Bead(run__periods=40), kappa=[1.2, 1.5])
    >>> s.shape, [str(regime) for regime in s.regime]
    ((2,), ['counter-rotating', 'counter-rotating'])
    """
    bead = (bead or Bead())._asked()
    texts = [axis_text(keyword, values) for keyword, values in axes.items()]
    if threads is not None and threads < 0:
        raise BadInput("threads", f"{threads} is no number of threads: 1 or more, or 0 for all processors")
    count = threads or len(os.sched_getaffinity(0))
    grid = _new_grid(bead, texts, seed)
    refining = _refining(refine, refine_by, refine_step)
    if file is not None:
        return _into_file(bead, texts, file, seed, carry, count, lanes, portable, refining, progress)
    if carry is not None or refining != (0, None, 0.0):
        with tempfile.TemporaryDirectory(prefix="festoon-") as folder:
            path = os.path.join(folder, "sweep.db")
            return _into_file(bead, texts, path, seed, carry, count, lanes, portable, refining, progress)
    made = _in_memory(grid, bead._map, count, lanes, portable, progress)
    made._seed = seed
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
    if row.status != lib.FST_OK:
        if not lib.pyf_row_fail(ffi.addressof(row), b"", (given.get("reason") or given["status"]).encode()):
            raise OutOfMemory("sweep", "no memory for a row")
        return
    result.regime = REGIMES.index(given["regime"])
    result.symmetry = SYMMETRIES.index(given["symmetry"])
    result.reason = (given.get("reason") or "").encode()[:255]
    slips = given.get("never_slips")
    result.never_slips = -1 if slips is None else int(slips)
    result.returns, result.rhs_calls = given["returns"], given["rhs_calls"]
    result.accepted, result.rejected = given["steps_accepted"], given["steps_rejected"]
    result.final_state = given["final_state"]


def _regimes_between(path: Path) -> Any:
    """The regimes that a refined sweep gives to points without a run; None: it is not refined, or damaged."""
    keys, _kept = strings(["regime"])
    table = ffi.new("fst_sweep_table *")
    if lib.fst_sweep_read_filled(path_bytes(path), keys, 1, table, new_error()) != lib.FST_OK:
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


def read_sweep(path: Path) -> Sweep:
    """Read a sweep's database."""
    found = ffi.new("fst_grid **")
    call(lib.fst_sweep_read_grid, path_bytes(path), found)
    grid = ffi.gc(found[0], lib.fst_grid_free)
    # After Ctrl-C the thread that still writes there may be quicker than the end of the folder.
    with tempfile.TemporaryDirectory(prefix="festoon-", ignore_cleanup_errors=True) as folder:
        out = os.path.join(folder, "rows.json")
        try:
            with Watch(None) as watch:
                watch.call_apart(lib.fst_sweep_export, path_bytes(path), lib.FST_EXPORT_JSON, out.encode(), ffi.NULL)
        except FestoonError as error:
            if not os.path.exists(out):
                raise
            warnings.warn(error.sentence, stacklevel=2)
        with open(out, encoding="utf-8") as file:
            given = json.load(file)
    batch = ffi.gc(lib.pyf_batch_new(grid, lib.FST_ARITHMETIC_PORTABLE, 0), lib.pyf_batch_free)
    if not batch:
        raise OutOfMemory("sweep", "no memory for the rows")
    rows = lib.pyf_batch_rows(batch)
    texts = {text_of(lib.fst_status_text(i)): i for i in range(lib.FST_INTERRUPTED + 1)}
    for row in given:
        _fill(rows[row["point"]], row, texts)
    made = _sweep_of(batch, grid)
    made._between = _regimes_between(path)
    return made
