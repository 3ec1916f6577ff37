"""The program's figures, drawn by gnuplot: .svg, .pdf or .png, with script and data beside them."""

import os
from typing import Any, Dict, Iterable, List, Optional, Tuple, Union

from ._errors import BadInput
from ._given import of_class, word_of
from ._native import call, ffi, lib, options_of, path_bytes, places_of, text_of
from ._quantities import units_of

Path = Union[str, "os.PathLike[str]"]

__all__ = ["branch", "field", "over", "points", "sweep", "trajectory"]

KINDS = places_of(lib.pyf_figures)


def set_options(options: Any, given: Dict[str, Any], where: str) -> List[Any]:
    """Set fields of a struct of options by name; returns what must stay alive with it.

    `begin` and `end` are the fields `from` and `to`, for `from` is a word of Python.
    """
    names = {name: field.type for name, field in ffi.typeof(options).item.fields}
    hidden = {"cookie", "progress", "kind", "keys"}
    kept: List[Any] = []
    for word, value in given.items():
        name = {"begin": "from", "end": "to"}.get(word, word)
        if name not in names or name in hidden:
            usable = [{"from": "begin", "to": "end"}.get(n, n) for n in names if n not in hidden]
            raise BadInput(where, f'unknown option "{word}"; there are {", ".join(usable)}')
        if value is None:
            continue
        if name == "units":
            value = units_of(value)
        elif isinstance(value, (str, os.PathLike)):
            value = ffi.new("char[]", os.fsencode(value))
            kept.append(value)
        setattr(options, name, value)
    return kept


def trajectory(
    samples: Any, path: Path, kind: str, *, keys: Iterable[str] = (), **given: Any
) -> None:
    """See Trajectory.figure().

    Parameters
    ----------
    samples
        A `Trajectory`.
    path
        The picture.
    kind
        path, local-n, radius-field, time, section or ramp.
    keys
        Columns, of the kinds time and section.
    **given
        Options of `Trajectory.figure`.

    Raises
    ------
    BadInput
        Where the ending of the path, or an option, is wrong.
    Unavailable
        Where gnuplot or the ending's converter is missing.
    """
    options = options_of(lib.fst_default_figure_options())
    if kind not in KINDS:
        raise BadInput("kind", f'unknown kind "{kind}"; there are {", ".join(KINDS)}')
    options.kind = KINDS[kind]
    kept = set_options(options, given, "Trajectory.figure")
    words = list(keys)
    if len(words) > lib.FST_FIGURE_KEYS:
        raise BadInput("keys", f"a figure shows at most {lib.FST_FIGURE_KEYS} columns")
    for i, word in enumerate(words):
        kept.append(ffi.new("char[]", word_of(word, "keys")))
        options.keys[i] = kept[-1]
    table, arrays = samples._rows()
    call(lib.fst_figure_trajectory, table, path_bytes(path), options)
    del arrays, kept


def branch(
    branches: Any, path: Path, observable: Optional[str], *, units: str = "given", dots: Iterable[Tuple[float, float]] = ()
) -> None:
    """See Branch.figure(); `dots` are pairs of abscissa and ordinate.

    Parameters
    ----------
    branches
        A `Branch`.
    path
        The picture.
    observable
        What is drawn; None: mean_r, of places where a bead floats height_mm.
    units
        "given", "lab", "scaled" or "si".
    dots
        Pairs of abscissa and ordinate.

    Raises
    ------
    BadInput
        Where the ending of the path, or an option, is wrong.
    Unavailable
        Where gnuplot or the ending's converter is missing.
    """
    pairs = [float(number) for pair in dots for number in pair]
    of_class(branches, "Branch", "branches")
    name = observable or text_of(lib.fst_branch_observable(branches._branch))
    call(
        lib.fst_figure_branch,
        branches._branch,
        word_of(name, "observable"),
        units_of(units),
        ffi.new("double[]", pairs) if pairs else ffi.NULL,
        len(pairs) // 2,
        path_bytes(path),
    )


def field(bead: Any, path: Path, units: str) -> None:
    """See Bead.figure().

    Parameters
    ----------
    bead
        A `Bead`.
    path
        The picture.
    units
        "given", "lab", "scaled" or "si".

    Raises
    ------
    BadInput
        Where the ending of the path, or an option, is wrong.
    Unavailable
        Where gnuplot or the ending's converter is missing.
    """
    call(lib.fst_figure_field, of_class(bead, "Bead", "bead")._params, units_of(units), path_bytes(path))


def _sweep_options(kind: Optional[str], keys: Iterable[str], units: str, at: Dict[str, Any]) -> Tuple[Any, List[Any]]:
    """A struct of what is shown of a sweep, and what must stay alive with it."""
    options = ffi.new("fst_sweep_figure *")
    kept: List[Any] = []
    if kind is not None:
        if kind not in KINDS:
            raise BadInput("kind", f'unknown kind "{kind}"; there are {", ".join(KINDS)}')
        options.kind = KINDS[kind]
    options.units = units_of(units)
    for field, words in (("keys", list(keys)), ("at", [f"{key}={value}" for key, value in dict(at).items()])):
        if len(words) > len(getattr(options, field)):
            raise BadInput(field, f"at most {len(getattr(options, field))} can be given")
        for i, word in enumerate(words):
            kept.append(ffi.new("char[]", word_of(word, field)))
            getattr(options, field)[i] = kept[-1]
    return options, kept


def sweep(
    database: Path, path: Path, keys: Iterable[str] = (), units: str = "given", *, kind: Optional[str] = None,
    at: Optional[Dict[str, Any]] = None,
) -> None:
    """Draw a sweep's database: curves of the keys over one axis; over two a map of one key, or a family of curves.

    Parameters
    ----------
    database
        The sweep.
    path
        The picture.
    keys
        What is drawn; none: the program chooses.
    units
        "given", "lab", "scaled" or "si".
    kind
        "curves" or "map"; None: curves where one of two axes has at most seven values.
    at
        Values of axes, ``{"friction.mu": 0.2}``: only the points that have them.

    Raises
    ------
    MissingFile
        Where the file is not there.
    BadInput
        Where it is damaged, or something else.
    Unavailable
        Where gnuplot or the ending's converter is missing.
    """
    options, kept = _sweep_options(kind, keys, units, at or {})
    call(lib.fst_figure_sweep, path_bytes(database), options, path_bytes(path))
    del kept


def over(
    files: Iterable[Path], path: Path, kind: str = "path", *, keys: Iterable[str] = (), units: str = "given",
    observable: str = "", at: Optional[Dict[str, Any]] = None, **given: Any
) -> None:
    """Lay sweeps and branches, or trajectories, over each other; the key says what differs between their scenes.

    Parameters
    ----------
    files
        At most eight: databases of sweeps and branches (JSON) over one parameter, or trajectories.
    path
        The picture.
    kind
        Of trajectories: path, time, section or ramp.
    keys
        Columns of trajectories, or keys of sweeps and branches.
    units
        "given", "lab", "scaled" or "si".
    observable
        What is shown of branches; "": the keys.
    at
        Values of axes of sweeps, as of `sweep`.
    **given
        Options of `Trajectory.figure`.

    Raises
    ------
    BadInput
        Where files have no axis in common.
    MissingFile
        Where a file is not there.
    Unavailable
        Where gnuplot or the ending's converter is missing.
    """
    words = list(keys)
    sweeps, kept = _sweep_options(None, words, units, at or {})
    options = options_of(lib.fst_default_figure_options())
    kept += set_options(options, {**given, "units": units}, "figures.over")
    options.kind = KINDS[kind] if kind in KINDS else lib.FST_FIGURE_COUNT
    for i, word in enumerate(words[:lib.FST_FIGURE_KEYS]):
        kept.append(ffi.new("char[]", word_of(word, "keys")))
        options.keys[i] = kept[-1]
    names = [ffi.new("char[]", path_bytes(file)) for file in files]
    call(
        lib.fst_figure_over, ffi.new("const char *[]", names), len(names), options, sweeps,
        word_of(observable, "observable") if observable else ffi.NULL, path_bytes(path),
    )
    del kept


def points(results: Path, measured: Path, path: Path) -> Tuple[float, int, int]:
    """Lay measured points over a sweep or a branch over the drive: (chi^2, numbers counted, numbers in all).

    Parameters
    ----------
    results
        A sweep or a branch over the drive.
    measured
        A table of points.
    path
        The picture.

    Returns
    -------
    tuple
        chi^2, the numbers that count in it, and all numbers.

    Raises
    ------
    MissingFile
        Where the file is not there.
    BadInput
        Where it is damaged, or something else.
    """
    fit = ffi.new("fst_points_fit *")
    names = [ffi.new("char[]", path_bytes(file)) for file in (results, measured)]
    over, laid = (ffi.new("const char *[]", [name]) for name in names)
    call(lib.fst_figure_points, over, 1, laid, 1, ffi.NULL, path_bytes(path), fit)
    return float(fit.chi2), int(fit.counted), int(fit.all)
