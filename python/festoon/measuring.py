"""Tracks of filmed beads, and what is measured of them."""

import json
import math
import os
from typing import Any, Dict, Iterable, List, Mapping, Optional, Tuple, Union

import numpy as np

from ._errors import BadInput
from ._given import as_file, is_path, of_class, word_of
from ._native import Watch, call, dtype_of, ffi, lib, options_of, owned_array, path_bytes, take_text, text_of
from ._pickled import Told, image_of, struct_of
from ._progress import Progress
from ._quantities import quantity
from ._tabled import Column, Table, Tabled, about
from ._tables import MEASURED, MeasuredNumbers
from .bead import Bead

Path = Union[str, "os.PathLike[str]"]


#: The arrays of a track, and the types of their numbers in C.
COLUMNS = {"frame": "int64_t", "t": "double", "x": "double", "y": "double", "flag": "unsigned char", "doubts": "int"}


def _struct_of(columns: Mapping[str, Any], length_unit: str, fps: float, steady: bool, scale_error: float, rhythm: int) -> Any:
    """A track of the library over arrays of numpy, which live as long as it."""
    made = ffi.new("fst_track *")
    for name, kind in COLUMNS.items():
        setattr(made, name, ffi.from_buffer(f"{kind}[]", columns[name]))
    if "turning" in columns:
        made.turning = ffi.from_buffer("fst_turning[]", columns["turning"])
    made.rows = made.capacity = len(columns["frame"])
    made.length_unit, made.fps, made.steady = length_unit.encode(), fps, steady
    made.scale_error, made.rhythm = scale_error, rhythm
    return ffi.gc(made, lambda _, kept=(made, columns): None)


def _track_again(
    columns: Mapping[str, Any], length_unit: str, fps: float, steady: bool, scale_error: float, rhythm: int, understood: str,
    report: Any
) -> "Track":
    made = Track._of(_struct_of(columns, length_unit, fps, steady, scale_error, rhythm), understood)
    made.report = report
    return made


def length_in(units: Optional[str], own: str) -> Tuple[float, str]:
    """The factor from a track's unit of length, and the name of that to which it leads."""
    if units is None:
        return 1.0, own
    if units not in ("lab", "si"):
        raise BadInput("units", f'unknown units "{units}" of a track; there are lab and si')
    factor = quantity(f"1 {own}", lib.FST_UNIT_LENGTH, "units")
    return (1e3 * factor, "mm") if units == "lab" else (factor, "m")


class Track(Tabled):
    """Where a filmed bead was, frame by frame; its arrays lie over the library's memory.

    Parameters
    ----------
    data
        A data frame, a dictionary or a structured array with columns as a file has them, or an array of t (s), x, y.
    unit
        Of x and y, where the names of columns have none; of arrays "mm" by default.
    **reading
        Further keywords of :func:`read_track`: fps, scale, ...

    Raises
    ------
    BadInput
        Where the data are not a track; `where` counts their rows as lines of a table.
    """

    #: What is known of the film that was tracked.
    report: Optional[Dict[str, Any]]

    #: How the file was understood: format, clock, unit, where y points.
    understood: str
    length_unit: str
    _track: Any

    def __init__(self, data: Any, *, unit: Optional[str] = None, **reading: Any) -> None:
        unit = unit if unit or not hasattr(data, "shape") or hasattr(data, "columns") else "mm"
        with as_file(data, ("t", "x", "y"), "data", unit) as path:
            self.__dict__.update(read_track(path, **reading).__dict__)

    @classmethod
    def _of(cls, track: Any, understood: str = "") -> "Track":
        made = cls.__new__(cls)
        made._track, made.report, made.understood = track, None, understood
        made.length_unit = text_of(track.length_unit)
        return made

    def _column(self, name: str, dtype: Any, writable: bool = False) -> Any:
        return owned_array(getattr(self._track, name), self._track.rows, dtype, self._track, writable)

    @property
    def frame(self) -> Any:
        """Numbers of the frames."""
        return self._column("frame", "i8")

    @property
    def t(self) -> Any:
        """Times, s; NaN: the file has no clock."""
        return self._column("t", "f8")

    @property
    def x(self) -> Any:
        """Places in `length_unit`, NaN where the bead was lost."""
        return self._column("x", "f8")

    @property
    def y(self) -> Any:
        """Places, upward."""
        return self._column("y", "f8")

    @property
    def flag(self) -> Any:
        """0: seen, 1: lost, 2: rejected."""
        return self._column("flag", "u1")

    @property
    def doubts(self) -> Any:
        """How often until each frame the bead may have exchanged its name with another one's."""
        return self._column("doubts", "i4")

    @property
    def turning(self) -> Any:
        """How the bead turns: rows of n [1], n_error [rad], w and w_error [rad/s], slip and slip_error [`length_unit`/s], NaN
        where unknown; None: it was not looked at."""
        return self._column("turning", dtype_of("fst_turning")) if self._track.turning else None

    @property
    def fps(self) -> float:
        """Frames a second [Hz]."""
        return float(self._track.fps)

    @property
    def scale_error(self) -> float:
        """Relative error of the scale [1], by which all lengths are wrong alike; 0: none, or unknown."""
        return float(self._track.scale_error)

    def __len__(self) -> int:
        return int(self._track.rows)

    def _table(self, units: Optional[str]) -> Table:
        factor, length = length_in(units, self.length_unit)
        known = {"t": (1.0, "s"), "x": (factor, length), "y": (factor, length)}
        made = {name: Column(("frame",), getattr(self, name) * known.get(name, (1, ""))[0], known.get(name, (1, ""))[1])
                for name in COLUMNS if name != "frame"}
        turning = {"n": "1", "n_error": "rad", "w": "rad/s", "w_error": "rad/s", "slip": length, "slip_error": length}
        for name, unit in turning.items() if self.turning is not None else ():
            values = self.turning[name] * (factor if name.startswith("slip") else 1.0)
            dims = ("frame", "axis" if values.shape[1] == 3 else "side") if values.ndim == 2 else ("frame",)
            made[name] = Column(dims, values, f"{unit}/s" if name.startswith("slip") else unit)
        frame = Column(("frame",), self.frame, "", "number of the frame")
        return Table(("frame",), {"frame": frame}, made, about(fps=self.fps, scale_error=self.scale_error))

    def _columns(self) -> Dict[str, Any]:
        names = [*COLUMNS, "turning"] if self._track.turning else COLUMNS
        return {name: getattr(self, name).copy() for name in names}

    def _clock(self) -> Tuple[str, float, bool, float, int]:
        return self.length_unit, self.fps, bool(self._track.steady), self.scale_error, int(self._track.rhythm)

    def _copy(self) -> Tuple[Any, Dict[str, Any]]:
        """The track once more, for a call that may reject rows of it and be interrupted, and its arrays."""
        columns = self._columns()
        return _struct_of(columns, *self._clock()), columns

    def _take(self, copy: Any, columns: Mapping[str, Any]) -> None:
        """What a call has changed of a copy; the arrays of this track stay where they are."""
        for name, dtype in (("t", "f8"), ("flag", "u1")):
            self._column(name, dtype, writable=True)[:] = columns[name]
        self._track.fps, self._track.steady = copy.fps, copy.steady

    def __reduce__(self) -> Tuple[Any, ...]:
        facts = (*self._clock(), self.understood, self.report)
        return _track_again, (self._columns(), *facts)

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Track):
            return NotImplemented
        facts = [(t.length_unit, t.scale_error, t.understood, t.report, len(t), t.turning is None) for t in (self, other)]
        if facts[0] == facts[1] and self.turning is not None:
            mine, theirs = (track.turning.view("f8") for track in (self, other))
            if not np.array_equal(mine, theirs, equal_nan=True):
                return False
        return facts[0] == facts[1] and all(
            np.array_equal(getattr(self, name), getattr(other, name), equal_nan=name in ("t", "x", "y"))
            for name in COLUMNS
        )

    __hash__ = None  # type: ignore[assignment]  # measuring a track may reject rows of it

    def save(self, path: Path) -> None:
        """Write the track as festoon's CSV.

        Parameters
        ----------
        path
            The file, .csv.

        Raises
        ------
        InputOutput
            Where the file cannot be written.
        """
        call(lib.fst_track_write, path_bytes(path), self._track)

    def __repr__(self) -> str:
        return f"Track: {len(self)} frames, {self.fps:.6g} a second, in {self.length_unit}"


def read_track(
    path: Path,
    *,
    format: Optional[str] = None,
    name: Optional[str] = None,
    fps: Union[None, float, str] = None,
    scale: Union[None, float, str] = None,
    frames: Tuple[Optional[int], Optional[int]] = (None, None),
) -> Track:
    """Read the track of a bead in any of the formats of `festoon measure`; `scale` is the length of one unit.

    Parameters
    ----------
    path
        The file.
    format
        Where the file does not tell itself which one it is.
    name
        Of the track, in a file of several.
    fps
        Frames a second, Hz.
    scale
        The length of one unit of the file, m, or a text with a unit.
    frames
        The first and the last frame that are taken, by the file's numbers; None: from its first, to its last.

    Returns
    -------
    Track
        Its lengths are in `length_unit`.

    Raises
    ------
    MissingFile
        Where the file is not there.
    BadInput
        Where it is damaged, or something else.
    Interrupted
        After Ctrl-C.
    """
    options = options_of(lib.fst_default_track_options())
    kept = []
    for field, text in (("format", format), ("name", name)):
        if text is not None:
            kept.append(ffi.new("char[]", word_of(text, field)))
            setattr(options, field, kept[-1])
    if fps is not None:
        options.fps = quantity(fps, lib.FST_UNIT_FREQUENCY, "fps")
    if scale is not None:
        options.scale = quantity(scale, lib.FST_UNIT_LENGTH, "scale")
    for field, frame in zip(("from", "to"), frames):
        if frame is not None:
            setattr(options, field, float(frame))
    track = ffi.gc(ffi.new("fst_track *"), lib.fst_track_free)
    understood = ffi.new("char **")
    with Watch(None) as watch:
        watch.call_apart(lib.fst_track_read, path_bytes(path), options, track, understood, keeping=kept)
    return Track._of(track, take_text(understood[0]) if understood[0] else "")


class Measurement(Tabled, Told, MeasuredNumbers):
    """What was measured of a track; lengths in `length_unit`, NaN where a number is unknown."""

    def __init__(self, track: Track, found: Any) -> None:
        self.track, self._found = track, found
        self.length_unit = text_of(found.length_unit)
        #: The centre of the path, in the axes of the file.
        self.centre = tuple(found.centre)
        self.frames, self.lost = int(found.frames), int(found.lost)
        self.motion = text_of(lib.fst_motion_name(found.motion))
        self.warnings = [text_of(found.warnings[i]) for i in range(found.warning_count)]

    def _number(self, name: str) -> float:
        return float(getattr(self._found, name))

    def _table(self, units: Optional[str]) -> Table:
        """One row."""
        factor, length = length_in(units, self.length_unit)
        made = {"motion": Column((), self.motion), "frames": Column((), self.frames), "lost": Column((), self.lost)}
        for name, (unit, doc) in MEASURED.items():
            times, shown = (factor, length) if unit == "length" else (1.0, unit)
            made[name] = Column((), self._number(name) * times, shown, doc)
        return Table((), {}, made, about(warnings="; ".join(self.warnings)))

    def _facts(self) -> Any:
        return [self.to_dict(), self.centre, self.track]

    def __hash__(self) -> int:
        return hash(repr(self.to_dict()))

    def __reduce__(self) -> Any:
        return _measurement_again, (self.track, image_of(self._found))

    def to_dict(self) -> Dict[str, Any]:
        """What `festoon measure --json` prints.

        Returns
        -------
        dict
            Keys and numbers as the program prints them; None where a number is undefined.

        Raises
        ------
        OutOfMemory
            Where there is no memory for it.
        """
        text: Dict[str, Any] = json.loads(take_text(lib.fst_measurement_json(self._found)))
        return text

    def plot(self, kind: str = "path", **options: Any) -> Any:
        """Draw the track with matplotlib; returns its Axes: see `festoon.plots.measurement`.

        Parameters
        ----------
        kind
            "path", "magnet" or "radius".
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

        return plots.measurement(self, kind, **options)

    def figure(self, path: Path, compare: Optional[Bead] = None, progress: Progress = None) -> None:
        """The program's figure of the track, with a bead's path laid over it.

        Parameters
        ----------
        path
            The picture.
        compare
            A bead, whose path is laid over it.
        progress
            True: a bar; or a function of (fraction, what).

        Raises
        ------
        BadInput
            Where the ending of the path, or an option, is wrong.
        Unavailable
            Where gnuplot or the ending's converter is missing.
        """
        with Watch(progress, title="figure") as watch:
            watch.call(
                lib.fst_figure_measurement,
                self.track._track,
                self._found,
                ffi.NULL if compare is None else of_class(compare, "Bead", "compare")._params,
                path_bytes(path),
                watch.told,
            )

    def __repr__(self) -> str:
        lines = [f"Measurement: {self.motion}, {self.frames} frames, {self.lost} lost"]
        for name, (unit, _) in MEASURED.items():
            value = self._number(name)
            if not name.endswith("_error") and not math.isnan(value):
                error = self._number(f"{name}_error") if f"{name}_error" in MEASURED else math.nan
                unit = self.length_unit if unit == "length" else unit
                spread = "" if math.isnan(error) else f" +- {error:.2g}"
                lines.append(f"  {name} = {value:.6g}{spread}" + ("" if unit == "1" else f" {unit}"))
        return "\n".join([*lines, *(f"  warning: {text}" for text in self.warnings)])


def _measurement_again(track: Track, image: Any) -> Measurement:
    return Measurement(track, struct_of(image))


def measure(
    track: Any,
    *,
    drive: Union[None, float, str] = None,
    exposure: Union[None, float, str] = None,
    progress: Progress = None,
    **reading: Any,
) -> Measurement:
    """Measure a track: mean radius and its deviation, frequencies, festoons, each with an error.

    `drive` is in Hz or with a unit, negative where the magnet turns clockwise; `exposure` in s.  Further keywords
    are those of :func:`read_track`.

    Parameters
    ----------
    track
        A `Track`, a file of :func:`read_track`, or data as :class:`Track` takes them.
    drive
        Of the magnet, Hz; negative: clockwise.
    exposure
        Of a frame, s.
    progress
        True: a bar; or a function of (fraction, what).
    **reading
        Further keywords of :func:`read_track` or :class:`Track`.

    Returns
    -------
    Measurement
        Lengths in the track's unit, frequencies in Hz.

    Raises
    ------
    MissingFile
        Where the file is not there.
    BadInput
        Where it is damaged, or something else.
    Interrupted
        After Ctrl-C.
    """
    if not isinstance(track, Track):
        track = read_track(track, **reading) if is_path(track) else Track(track, **reading)
    elif reading:
        raise TypeError("format, name, fps and scale belong to the reading of a file")
    options = options_of(lib.fst_default_measure_options())
    if drive is not None:
        options.drive = quantity(drive, lib.FST_UNIT_FREQUENCY, "drive")
    if exposure is not None:
        options.exposure = _seconds(exposure)
    found = ffi.new("fst_measurement *")
    rows, columns = track._copy()
    with Watch(progress, title="measure") as watch:
        options.progress = watch.told
        watch.call_apart(lib.fst_measure_track, rows, options, found)
    track._take(rows, columns)
    return Measurement(track, found)


def _seconds(value: Union[float, str]) -> float:
    """A time: a number in s, or a text with s, ms or us."""
    if not isinstance(value, str):
        return float(value)
    for ending, factor in (("ms", 1e-3), ("us", 1e-6), ("s", 1.0)):
        if value.strip().endswith(ending):
            try:
                return float(value.strip()[: -len(ending)]) * factor
            except ValueError:
                break
    raise BadInput("exposure", f'"{value}" is not a time: a number of seconds, or one with s, ms or us')


def save_points(
    path: Path, measurements: Iterable[Measurement], drives: Optional[Iterable[Union[float, str]]] = None
) -> None:
    """Write measured tracks as a table of points, which :func:`fit` reads: a row each.

    `drives` are for tracks that do not tell the drive themselves.

    Parameters
    ----------
    path
        The file, .csv.
    measurements
        The measurements that become rows.
    drives
        Hz, one for each.

    Raises
    ------
    BadInput
        Where a track has no scale, or no drive is known.
    InputOutput
        Where the file cannot be written.
    """
    call(lib.fst_points_write, path_bytes(path), _points_measured(measurements, drives))


def _points_measured(measurements: Iterable[Measurement], drives: Optional[Iterable[Union[float, str]]]) -> Any:
    """A table of points: a row of each measured track."""
    measured = list(measurements)
    given: List[Any] = [math.nan] * len(measured) if drives is None else list(drives)
    if len(given) != len(measured):
        raise BadInput("drives", f"there are {len(given)} drives for {len(measured)} tracks")
    points = ffi.new("fst_points *")
    rows = ffi.new("fst_point[]", max(1, len(measured)))
    for i, (one, drive) in enumerate(zip(measured, given)):
        call(lib.fst_point_of, of_class(one, "Measurement", "measurements")._found, quantity(drive, lib.FST_UNIT_FREQUENCY, "drives"), ffi.addressof(rows, i))
    points.rows, points.count = rows, len(measured)
    return ffi.gc(points, lambda _, kept=(points, rows): None)


# ---------------------------------------------------------------------------------------- fits
