"""Runs over a grid of parameters, on all processors."""

import os
import tempfile
from typing import Any, Dict, List, Optional, Tuple

import numpy as np

from ._errors import BadInput, MaterialWarning, OutOfMemory, SceneWarning, warn
from ._given import number_of, of_class, whole_of, word_of
from ._keys import key_of, known_key
from ._native import Watch, ffi, lib, options_of, path_bytes, places_of, strings, text_of
from ._progress import Progress
from ._quantities import value_text
from .bead import Bead
from .sweeps import Path, Sweep, grid_of, read_sweep, sweep_of

CARRY: Dict[Optional[str], int] = dict([(None, lib.FST_CARRY_NO), *places_of(lib.pyf_carries).items()])


def axis_text(keyword: str, values: Any) -> str:
    """An axis as the library reads it: KEY=A,B,C; a text is taken as it is ("8:20:13", "8 Hz:20 Hz:5:log")."""
    if isinstance(values, str):
        return f"{known_key(keyword)}={values}"
    if hasattr(values, "__next__"):
        values = list(values)
    words = [value_text(value, known_key(keyword)) for value in np.atleast_1d(np.asarray(values, object)).ravel()]
    return f"{known_key(keyword)}={','.join(words)}"


def _in_memory(
    grid: Any, field_map: Any, threads: int, lanes: int, portable: bool, progress: Progress
) -> Sweep:
    arithmetic = lib.FST_ARITHMETIC_PORTABLE if portable else lib.fst_best_arithmetic()
    made = lib.pyf_batch_new(grid, arithmetic, lanes)
    if not made:
        raise OutOfMemory("sweep", f"no memory for {lib.fst_grid_points(grid)} rows")
    batch = ffi.gc(made, lib.pyf_batch_free)
    points = int(lib.fst_grid_points(grid))
    with Watch(progress, lambda: sweep_of(batch, grid, field_map), "sweep") as watch:
        watch.call(lib.pyf_batch_work, batch, max(1, min(threads, points)), watch.told)
        watch.tell(1.0, f"{points} of {points} runs")
    return sweep_of(batch, grid, field_map)


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
    levitation: bool,
    shard: Tuple[int, int],
    progress: Progress,
) -> Any:
    options = options_of(lib.fst_default_sweep_options())
    words, _kept = strings(axes)
    options.axes, options.axis_count, options.seed = words, len(axes), seed
    if carry not in CARRY:
        raise BadInput("carry", f'unknown direction "{carry}": up or down')
    options.carry, options.threads, options.lanes = CARRY[carry], threads, lanes
    levels, by, step = refining
    key = ffi.new("char[]", word_of(by, "refine_by")) if by else ffi.NULL
    options.refine, options.refine_by, options.refine_step = levels, key, step
    options.levitation = levitation
    options.shard, options.shards = shard
    if portable:
        options.arithmetic = lib.FST_ARITHMETIC_PORTABLE
    counts = ffi.new("fst_sweep_counts *")
    with Watch(progress, lambda: read_sweep(path), "sweep") as watch:
        options.progress = watch.told
        watch.call(lib.fst_sweep, bead._params, path_bytes(path), options, counts)
    if 0 < counts.undefined == counts.computed:
        warn(f"{by or 'regime'} has no value in any run, so nothing was refined")
    if counts.all_failed[0] != b"\0":
        _warn_of_failures(text_of(counts.all_failed))
    return read_sweep(path)


def _warn_of_failures(first: str) -> None:
    warn(f"no run of this sweep could be made; the first: {first}")


def _warn(grid: Any, levitation: bool) -> None:
    """What the program says of such a sweep."""
    sentence = ffi.new("char[]", 512)
    if lib.fst_grid_contradiction(grid, sentence, 512):
        warn(text_of(sentence), MaterialWarning)
    if not levitation and lib.fst_grid_idle_axes(grid, sentence, 512):
        warn(f"{text_of(sentence)} (Bead.groups has them)", SceneWarning)
    if lib.fst_grid_followers(grid, sentence, 512):
        warn(text_of(sentence), SceneWarning)


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
    levitation: bool = False,
    shard: Tuple[int, int] = (0, 0),
    progress: Progress = None,
    **axes: Any,
) -> Sweep:
    """Run a bead over a grid of parameters: a :class:`Sweep`, on all processors that this process may use; of several
    beads, or of one in a world, a :class:`SweepTable`.

    Parameters
    ----------
    bead
        By default the paper's.
    **axes
        Parameters as keywords, each with an array, a list (of numbers, texts with units, or names of choices) or
        a text as the program takes it ("8:20:13", "1:100:20:log", "0.9:1.1:random:50").  Axes multiply.
    file
        A database: rows are kept in it, and the same call goes on where an interrupted one ended.
    carry
        "up" or "down": each run starts from the end of its neighbour along the first axis.
    threads, lanes
        How many threads, 0: all processors; how many runs are made side by side in each, 0: what is quickest.
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
    levitation
        Find the places where a bead without a plate floats, and run nothing.
    shard
        (I, N): compute the I-th of N parts alone, I from 1, into a `file` of its own; `festoon.merge` joins them.
    progress
        True: a bar; or a function of (fraction, what).

    Returns
    -------
    Sweep or SweepTable
        Its numbers are arrays of the grid's shape, scaled.

    Raises
    ------
    BadInput
        Where an argument is wrong; the sentence says what was expected.
    Interrupted
        After Ctrl-C; `partial` is what was done by then.
    OutOfMemory
        Where there is no memory for it.

    Notes
    -----
    A run that fails is a row of NaN with an error, not an exception; where all fail, a warning has the first reason.  Ctrl-C raises `Interrupted`, whose
    `partial` is the sweep with the rows that were done.

    Examples
    --------
    >>> s = sweep(Bead(run__periods=40), kappa=[1.2, 1.5])
    >>> s.shape, [str(regime) for regime in s.regime]
    ((2,), ['counter-rotating', 'counter-rotating'])
    """
    bead = Bead() if bead is None else bead
    of_class(bead, "Bead", "bead")
    bead = bead._asked(map(key_of, axes))
    whole_of(seed, "seed", 2**64 - 1)
    whole_of(lanes, "lanes")
    texts = [axis_text(keyword, values) for keyword, values in axes.items()]
    count = whole_of(threads or 0, "threads") or len(os.sched_getaffinity(0))
    grid = grid_of(bead, texts, seed)
    _warn(grid, levitation)
    refining = _refining(whole_of(refine, "refine"), refine_by, number_of(refine_step, "refine_step"))
    if not isinstance(shard, (tuple, list)) or len(shard) != 2:
        raise BadInput("shard", f"{shard!r} is not (I, N), as (1, 4)")
    shard = whole_of(shard[0], "shard"), whole_of(shard[1], "shard")
    if shard != (0, 0) and file is None:
        raise BadInput("shard", "a part of a sweep is for merging: give it a file")
    if file is not None:
        return _into_file(  # type: ignore[no-any-return]
            bead, texts, file, seed, carry, count, lanes, portable, refining, levitation, shard, progress
        )
    in_three_dimensions = levitation or lib.fst_grid_row_kind(grid) != lib.FST_ROWS_OF_RUNS
    if in_three_dimensions or carry is not None or refining != (0, None, 0.0):
        with tempfile.TemporaryDirectory(prefix="festoon-") as folder:
            path = os.path.join(folder, "sweep.db")
            return _into_file(  # type: ignore[no-any-return]
                bead, texts, path, seed, carry, count, lanes, portable, refining, levitation, shard, progress
            )
    made = _in_memory(grid, bead._map, count, lanes, portable, progress)
    made._seed = seed
    if made.size and all(row["done"] and row["status"] > lib.FST_OK for row in made._rows):
        _warn_of_failures(f"{made.status.flat[0]}: {made.reason.flat[0]}")
    return made
