"""Measurements and fits in matplotlib's Axes: what was seen, over what the model says."""

from typing import Any, Dict, List, Optional

import numpy as np

from . import _style
from ._errors import BadInput
from ._native import lib, text_of
from .orbits import _choose

# ---------------------------------------------------------------------------------------- fits


def _measured() -> List[str]:
    return [text_of(lib.fst_measured_name(i)) for i in range(lib.FST_MEASURED_COUNT)]


def _quantity_of(name: str, index: int, params: Any) -> Any:
    """How a measured quantity, which is in SI, is shown."""
    if lib.fst_measured_unit(index) != lib.FST_UNIT_LENGTH:
        return _style.of_result(name, "Hz", "lab", _style.scales_of(params))
    return _style.of_result(name, "l", "lab", _style.scales_of(params))._replace(factor=1e3)


def _numbers_of(fit: Any, what: int, used: bool) -> Dict[str, Any]:
    rows = [n for n in (fit._fit.numbers[i] for i in range(fit._fit.number_count)) if n.what == what]
    rows = [n for n in rows if bool(n.used) == used]
    points = [fit._points.rows[n.row] for n in rows]
    return {
        "x": np.array([point.frequency for point in points]),
        "xerr": np.nan_to_num([point.frequency_error for point in points]),
        "y": np.array([n.value for n in rows]),
        "yerr": np.array([point.error[what] for point in points]),
    }


def fit(f: Any, y: Optional[str] = None, *, ax: Any = None) -> Any:
    """Draw measured points with their errors over the fitted model with its uncertainty.

    Parameters
    ----------
    y
        "mean_r", "std_r" or "bead_frequency"; by default the first that was measured.
    ax
        The Axes to draw into; without it a new figure is made.
    """
    names = _measured()
    if f._points is None:
        raise BadInput("Fit.plot", "a fit to a track has no table of points: draw what was measured of the track")
    if y is not None:
        _choose(y, names, "y")
    there = {f._fit.numbers[i].what for i in range(f._fit.number_count)}
    what = min(there) if y is None else names.index(y)
    if what not in there:
        raise BadInput("y", f"the table has no {y}; it has {', '.join(names[i] for i in sorted(there))}")
    if f._fit.curve_count < 2:
        raise BadInput("curve_points", "the fit was made without curves: say fit(..., curve_points=60)")
    ax = _style.axes(ax, 6.0, 4.4)
    shown = _quantity_of(names[what], what, f.bead._params)
    curve = [f._fit.curve[i] for i in range(f._fit.curve_count)]
    x = np.array([point.frequency for point in curve])
    model = shown.factor * np.array([point.value[what] for point in curve])
    spread = shown.factor * np.array([point.spread[what] for point in curve])
    blue = _style.colour("blue")
    ax.fill_between(
        x, model - spread, model + spread, color=blue, alpha=0.22, linewidth=0,
        label="uncertainty of the model (one standard deviation)",
    )
    ax.plot(x, model, color=blue, linewidth=1.6, label="model")
    for used, words, colour, inside in ((True, "measured", "black", None), (False, "left out", "vermilion", "white")):
        data = _numbers_of(f, what, used)
        if len(data["x"]):
            ax.errorbar(
                data["x"], shown.factor * data["y"], shown.factor * data["yerr"], data["xerr"], fmt="o",
                markersize=4.5, capsize=2.5, elinewidth=1.1, color=_style.colour(colour), markerfacecolor=inside,
                label=words, zorder=3,
            )
    found = ", ".join(repr(parameter).replace("+-", "±") for parameter in f.parameters)
    _style.dress(ax, "Measured points and the fitted model", found, "frequency of the magnet (Hz)", shown.label)
    _style.key_below(ax)
    return ax


# ---------------------------------------------------------------------------------------- measurements

_KINDS = ("path", "magnet", "radius")


def _places(m: Any) -> Dict[str, Any]:
    """The track on the plate about its centre, without the tilt of the camera; times as those of the wave."""
    track, found = m.track, m._found
    seen = track.flag != lib.FST_FRAME_LOST
    clock = np.isfinite(track.fps)
    t = track.t[seen] if clock else (track.frame[seen] - track.frame[0]).astype(float)
    x, y = track.x[seen] - found.centre[0], track.y[seen] - found.centre[1]
    xx, xy, yy = found.stretch
    return {
        "t": t, "x": xx * x + xy * y, "y": xy * x + yy * y, "clock": "s" if clock else "frames",
        "used": track.flag[seen] != lib.FST_FRAME_REJECTED,
    }


def _seen_from_magnet(found: Any, t: Any, x: Any, y: Any) -> Any:
    """Places in the frame of the magnet, which turns anticlockwise in a film that is not mirrored."""
    mirrored = (found.bead_frequency_hz > 0) != (found.filmed_sense > 0)
    angle = 2 * np.pi * found.drive_from_track_hz * (t - found.wave_origin)
    y = -y if mirrored else y
    return np.cos(angle) * x + np.sin(angle) * y, np.cos(angle) * y - np.sin(angle) * x


def measurement(m: Any, kind: str = "path", *, ax: Any = None) -> Any:
    """Draw a measured track.

    Parameters
    ----------
    kind
        "path": on the plate, about the centre that was found; "magnet": as seen from the turning magnet; "radius":
        the distance from the centre over one swing, with the curve that was fitted to it.
    ax
        The Axes to draw into; without it a new figure is made.
    """
    _choose(kind, list(_KINDS), "kind")
    p, found = _places(m), m._found
    unit = m.length_unit
    ax = _style.axes(ax, 5.4, 4.2 if kind == "radius" else 5.4)
    if kind == "magnet" and not np.isfinite(found.drive_from_track_hz):
        raise BadInput("kind", "the track does not tell how the magnet turns, so that its frame is not known")
    if kind == "radius":
        _radius(ax, m, p)
        return ax
    x, y = p["x"], p["y"]
    if kind == "magnet":
        x, y = _seen_from_magnet(found, p["t"], x, y)
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
        part[used], np.hypot(p["x"], p["y"])[used], ".", markersize=2.2, color=_style.colour("black"),
        label="the bead, frame by frame",
    )
    u = np.linspace(0, 1, 361)
    wave = np.full_like(u, found.wave_mean)
    for k in range(lib.FST_WAVE_LIMIT):
        angle = 2 * np.pi * (k + 1) * u
        wave += found.wave_cos[k] * np.cos(angle) + found.wave_sin[k] * np.sin(angle)
    ax.plot(u, wave, color=_style.colour("blue"), linewidth=1.8, label="what was fitted to it")
    one = f"{1 / hertz:.4g} {p['clock']}" if hertz else ""
    _style.dress(
        ax, "Distance from the centre over one swing", _about(m), f"part of the swing of {one}",
        f"r ({m.length_unit})",
    )
    _style.key_below(ax)


__all__ = ["fit", "measurement"]
