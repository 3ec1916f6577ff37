"""Measurements and fits in matplotlib's Axes: what was seen, over what the model says."""

from typing import Any, Dict, List, Optional

import numpy as np

from . import _style
from ._errors import BadInput
from ._given import of_class
from ._native import call, ffi, lib, text_of
from .orbits import _choose

# ---------------------------------------------------------------------------------------- fits


def _measured() -> List[str]:
    return [text_of(lib.fst_measured_name(i)) for i in range(lib.FST_MEASURED_COUNT)]


def fit(f: Any, y: Optional[str] = None, *, ax: Any = None) -> Any:
    """Draw measured points with their errors over the fitted model with its uncertainty, and below what is left.

    Parameters
    ----------
    f
        A `Fit`.
    y
        "mean_r", "std_r" or "bead_frequency"; by default the first that was measured.
    ax
        The Axes to draw into, without what is left; without it a new figure is made, of both.

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
    names = _measured()
    if of_class(f, "Fit", "f")._points is None:
        raise BadInput("Fit.plot", "a fit to a track has no table of points: draw what was measured of the track")
    if y is not None:
        _choose(y, names, "y")
    there = {f._fit.numbers[i].what for i in range(f._fit.number_count)}
    what = min(there) if y is None else names.index(y)
    if what not in there:
        raise BadInput("y", f"the table has no {y}; it has {', '.join(names[i] for i in sorted(there))}")
    if f._fit.curve_count < 2:
        raise BadInput("curve_points", "the fit was made without curves: say fit(..., curve_points=60)")
    made = ffi.new("fst_chart **")
    call(lib.fst_chart_of_fit, f._points, f._fit, what, made)
    chart = ffi.gc(made[0], lib.fst_chart_free)
    both: List[Any] = [ax if ax is None else _style.axes(ax)]
    if ax is None:
        shape = {"sharex": True, "figsize": (6.0, 6.0), "layout": "constrained", "gridspec_kw": {"height_ratios": (5, 3)}}
        both = list(_style.pyplot().subplots(2, **shape)[1])
    for i, place in enumerate(both):
        panel = chart.panels[i]
        for k in range(panel.curve_count):
            _style.curve(place, panel.curves[k])
        words = (text_of(chart.title), text_of(chart.about)) if i == 0 else ("", "")
        below = _style.lowered(chart.x_label) if place is both[-1] else ""
        _style.dress(place, *words, below, _style.lowered(panel.left_label))
    both[0].set_xlim(chart.x_low, chart.x_high)
    handles = {text: handle for place in both for handle, text in zip(*place.get_legend_handles_labels())}
    _style.key_below(both[-1], list(handles.values()))
    return both[0]


# ---------------------------------------------------------------------------------------- measurements

_KINDS = ("path", "magnet", "radius")


def _places(m: Any) -> Dict[str, Any]:
    """The track on the plate about its centre, and as seen from the magnet."""
    placed = ffi.gc(ffi.new("fst_placed_track *"), lib.fst_placed_track_free)
    call(lib.fst_place_track, m.track._track, m._found, placed)
    size = 8 * placed.count
    found: Dict[str, Any] = {
        name: np.frombuffer(ffi.buffer(getattr(placed, name), size)).copy() if size else np.empty(0)
        for name in ("t", "x", "y", "seen_x", "seen_y", "r")
    }
    rows = np.frombuffer(ffi.buffer(placed.row, size), np.uintp) if size else np.empty(0, int)
    found["used"] = m.track.flag[rows.astype(int)] != lib.FST_FRAME_REJECTED
    found["clock"] = text_of(placed.clock)
    return found


def measurement(m: Any, kind: str = "path", *, ax: Any = None) -> Any:
    """Draw a measured track.

    Parameters
    ----------
    m
        A `Measurement`.
    kind
        "path": on the plate, about the centre that was found; "magnet": as seen from the turning magnet; "radius":
        the distance from the centre over one swing, with the curve that was fitted to it.
    ax
        The Axes to draw into; without it a new figure is made.

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
    of_class(m, "Measurement", "m")
    _choose(kind, list(_KINDS), "kind")
    p, found = _places(m), m._found
    unit = m.length_unit
    ax = _style.axes(ax, 5.4, 4.2 if kind == "radius" else 5.4)
    if kind == "magnet" and not np.isfinite(found.drive_from_track_hz):
        raise BadInput("kind", "the track does not tell how the magnet turns, so that its frame is not known")
    if kind == "radius":
        _radius(ax, m, p)
        return ax
    x, y = (p["seen_x"], p["seen_y"]) if kind == "magnet" else (p["x"], p["y"])
    used = p["used"]
    ax.plot(x[used], y[used], ".", markersize=2.2, color=_style.colour("blue"), label="the bead, frame by frame")
    if not used.all():
        ax.plot(x[~used], y[~used], "x", markersize=5, color=_style.colour("vermilion"), label="rejected")
    circle = np.linspace(0, 2 * np.pi, 181)
    ax.plot(
        m.mean_r * np.cos(circle), m.mean_r * np.sin(circle), color=_style.colour("grey"), linewidth=1,
        label="mean radius",
    )
    ax.plot([0], [0], "+", markersize=9, color=_style.colour("black"), label="centre")
    ax.set_aspect("equal")
    title = "The bead's path on the plate" if kind == "path" else "The bead's path as seen from the magnet"
    labels = ("x", "y") if kind == "path" else ("X", "Y")
    _style.dress(ax, title, _about(m), *(f"{word} ({unit})" for word in labels))
    _style.key_below(ax)
    return ax


def _about(m: Any) -> str:
    words = f"⟨r⟩ = {m.mean_r:.5g} ± {m.mean_r_error:.1g} {m.length_unit}, {m.frames} frames"
    return words + (f", {m.lost} lost" if m.lost else "")


def _radius(ax: Any, m: Any, p: Dict[str, Any]) -> None:
    found = m._found
    hertz = found.wave_hz
    if not np.isfinite(hertz):
        raise BadInput("kind", "no swing of the radius was found in this track")
    since = p["t"] - found.wave_origin
    part = np.mod(hertz * since, 1.0)
    used = p["used"]
    ax.plot(
        part[used], p["r"][used], ".", markersize=2.2, color=_style.colour("black"),
        label="the bead, frame by frame",
    )
    u = np.linspace(0, 1, 361)
    wave = [lib.fst_fitted_radius(found, found.wave_origin + part / hertz) for part in u]
    ax.plot(u, wave, color=_style.colour("blue"), linewidth=1.8, label="what was fitted to it")
    one = f"{1 / hertz:.4g} {p['clock']}" if hertz else ""
    _style.dress(
        ax, "Distance from the centre over one swing", _about(m), f"part of the swing of {one}",
        f"r ({m.length_unit})",
    )
    _style.key_below(ax)


__all__ = ["fit", "measurement"]
