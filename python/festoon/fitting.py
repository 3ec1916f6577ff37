"""Parameters that follow from measured points or tracks."""

import contextlib
import json
from typing import Any, Dict, Iterable, List, Optional, Union

import numpy as np

from ._errors import BadInput
from ._given import as_file, is_path, of_class, whole_of
from ._keys import key_of, known_key
from ._native import Watch, call, ffi, lent, lib, options_of, path_bytes, strings, take_text, text_of
from ._pickled import Told, image_of, same, struct_of
from ._progress import Progress
from ._quantities import quantity
from ._tabled import Column, Shown, Table, about, scales_of
from .bead import Bead
from .measuring import Measurement, Path, Track, _points_measured, _seconds, read_track


class FitParameter:
    """A parameter that was sought: `value`, `error` and `interval`, in SI."""

    def __init__(self, parameter: Any) -> None:
        self.key = text_of(parameter.key)
        self.unit = text_of(lib.fst_unit_name(parameter.unit))
        self.value = float(parameter.value)
        self.error = float(parameter.error)
        self.interval = (float(parameter.interval[0]), float(parameter.interval[1]))
        self.bootstrap_error = float(parameter.bootstrap_error)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, FitParameter) and same(self.__dict__, other.__dict__)

    def __hash__(self) -> int:
        return hash((self.key, self.value))

    def __repr__(self) -> str:
        unit = "" if self.unit == "1" else f" {self.unit}"
        return f"{self.key} = {self.value:.6g} +- {self.error:.2g}{unit}"


class Fit(Shown, Told):
    """Parameters that follow from measured points, and how well they are known."""

    def __init__(self, fit: Any, points: Any, begun: Bead) -> None:
        self._fit, self._points, self._begun = fit, points, begun
        #: The bead with the values that were found.
        self.bead = Bead._of(fit.params, begun._map)
        self.parameters = [FitParameter(fit.parameters[i]) for i in range(fit.free_count)]
        #: A matrix in the order of the parameters.
        count = fit.free_count
        self.correlation = lent(np.array([list(row)[:count] for row in fit.correlation[0:count]]))
        self.kappa_gamma2 = float(fit.kappa_gamma2)
        self.kappa_gamma2_error = float(fit.kappa_gamma2_error)
        self.chi2, self.dof, self.points = float(fit.chi2), int(fit.dof), int(fit.points)
        self.error_scale = float(fit.error_scale)
        self.weakest = text_of(fit.weakest)
        self.remarks = text_of(fit.remarks)

    def __reduce__(self) -> Any:
        points = None if self._points is None else image_of(self._points)
        return _fit_again, (image_of(self._fit), points, self._begun)

    def __getitem__(self, keyword: str) -> FitParameter:
        for parameter in self.parameters:
            if parameter.key == key_of(keyword):
                return parameter
        raise KeyError(keyword)

    def _table(self, units: Optional[str]) -> Table:
        """A row a parameter.  Their units differ, and are a column."""
        scales = scales_of(self.bead._params, units)
        rows: Dict[str, List[Any]] = {name: [] for name in ("value", "error", "bootstrap_error", "unit", "low", "high")}
        for one in self.parameters:
            numbers, unit = scales.of_parameter(one.key, np.array([one.value, one.error, one.bootstrap_error, *one.interval]))
            for name, value in zip(rows, [*numbers[:3], unit, *numbers[3:]]):
                rows[name].append(value)
        columns = {name: Column(("parameter",), np.array(values)) for name, values in rows.items()}
        columns["correlation"] = Column(("parameter", "with"), self.correlation, "1")
        keys = np.array([one.key for one in self.parameters])
        coords = {"parameter": Column(("parameter",), keys), "with": Column(("with",), keys)}
        return Table(("parameter",), coords, columns, about(self.bead.scene(), chi2=self.chi2, dof=self.dof))

    def to_dict(self) -> Dict[str, Any]:
        """What `festoon fit --json` prints.

        Returns
        -------
        dict
            Keys and numbers as the program prints them; None where a number is undefined.

        Raises
        ------
        OutOfMemory
            Where there is no memory for it.
        """
        text: Dict[str, Any] = json.loads(take_text(lib.fst_fit_json(self._begun._params, self._fit)))
        return text

    def plot(self, y: Optional[str] = None, **options: Any) -> Any:
        """Draw points over the model with matplotlib; returns the Axes: see `festoon.plots.fit`.

        Parameters
        ----------
        y
            "mean_r", "std_r" or "bead_frequency".
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

        return plots.fit(self, y, **options)

    def figure(self, path: Path) -> None:
        """The program's figure: points with errors over the model's curves; give the fit `curve_points`.

        Parameters
        ----------
        path
            The picture.

        Raises
        ------
        BadInput
            Where the ending of the path, or an option, is wrong.
        Unavailable
            Where gnuplot or the ending's converter is missing.
        """
        if self._points is None:
            raise BadInput("Fit.figure", "a fit to a track has no points to draw: festoon.measure() draws a track")
        call(lib.fst_figure_fit, self._points, self._fit, path_bytes(path))

    def __repr__(self) -> str:
        lines = [f"Fit: chi^2 {self.chi2:.6g}, {self.dof} degrees of freedom"]
        lines += [f"  {parameter!r}" for parameter in self.parameters]
        return "\n".join([*lines, *(f"  {line}" for line in self.remarks.splitlines())])


def _fit_again(image: Any, points: Any, begun: Bead) -> Fit:
    found = struct_of(image)
    found.params.magnet_map = begun._map or ffi.NULL
    return Fit(found, None if points is None else struct_of(points), begun)


def _points_of(points: Any) -> Any:
    """The table of points of a file, of data, or of measurements."""
    if isinstance(points, (list, tuple)) and points and all(isinstance(one, Measurement) for one in points):
        return _points_measured(points, None)
    table = ffi.gc(ffi.new("fst_points *"), lib.fst_points_free)
    with contextlib.nullcontext(points) if is_path(points) else as_file(points, (), "points") as path:
        call(lib.fst_points_read, path_bytes(path), table)
    return table


def fit(
    points: Any = None,
    free: Union[str, Iterable[str]] = (),
    given: Union[str, Iterable[str]] = (),
    *,
    track: Any = None,
    bead: Optional[Bead] = None,
    drive: Union[None, float, str] = None,
    exposure: Union[None, float, str] = None,
    rivals: bool = False,
    bootstrap: int = 0,
    seed: int = 0,
    curve_points: int = 0,
    progress: Progress = None,
) -> Fit:
    """Find the parameters with which the model comes nearest to measured points, or to one track.

    `free` are the parameters sought, by key or keyword; `given` is what is known otherwise, as in
    "magnet.depth=16.2+-0.2 mm"; `bead` is where the search begins.

    Parameters
    ----------
    points
        A table of points: a file, a data frame or a dictionary with its columns, or a list of measurements.
    free
        Parameters that are sought, by key or keyword.
    given
        What is known otherwise, as in "magnet.depth=16.2+-0.2 mm".
    track
        In place of points, one track: a `Track`, a file, or data.
    bead
        Where the search begins.
    drive
        Of the magnet in a track, Hz.
    exposure
        Of a frame, s.
    rivals
        Whether other laws and dynamics are tried too.
    bootstrap
        How many tables are drawn anew for a second estimate of the errors; 0: none.
    seed
        Of what is drawn.
    curve_points
        Of the model's curves, for pictures; 0: none.
    progress
        True: a bar; or a function of (fraction, what).

    Returns
    -------
    Fit
        Values and errors in SI, or scaled as the parameter is.

    Raises
    ------
    MissingFile
        Where the file is not there.
    BadInput
        Where it is damaged, or something else.
    NoConvergence
        Where no minimum was found.
    Interrupted
        After Ctrl-C.
    """
    if (points is None) == (track is None):
        raise BadInput("fit", "give a table of points, or a track")
    bead = Bead() if bead is None else bead
    of_class(bead, "Bead", "bead")
    bead = bead._asked()
    options = options_of(lib.fst_default_fit_options())
    free_words, kept_free = strings([known_key(word) for word in ([free] if isinstance(free, str) else free)])
    given_words, kept_given = strings([given] if isinstance(given, str) else list(given))
    options.free, options.free_count = free_words, len(kept_free)
    options.given, options.given_count = given_words, len(kept_given)
    options.rivals, options.bootstrap, options.seed = bool(rivals), whole_of(bootstrap, "bootstrap"), whole_of(seed, "seed", 2**64 - 1)
    options.curve_points = whole_of(curve_points, "curve_points")
    if drive is not None:
        options.drive = quantity(drive, lib.FST_UNIT_FREQUENCY, "drive")
    if exposure is not None:
        options.exposure = _seconds(exposure)
    found = ffi.gc(ffi.new("fst_fit *"), lib.fst_fit_free)
    table: Any = None
    rows: Any = None
    columns: Dict[str, Any] = {}
    kept = (free_words, kept_free, given_words, kept_given, bead)
    if points is not None:
        table = _points_of(points)
    else:
        if not isinstance(track, Track):
            track = read_track(track) if is_path(track) else Track(track)
        rows, columns = track._copy()
    with Watch(progress, title="fit") as watch:
        options.progress = watch.told
        if table is not None:
            watch.call_apart(lib.fst_fit_points, bead._params, table, options, found, keeping=kept)
        else:
            watch.call_apart(lib.fst_fit_track, bead._params, rows, options, found, keeping=kept)
    if isinstance(track, Track):
        track._take(rows, columns)
    return Fit(found, table, bead)
