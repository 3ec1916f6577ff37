"""Branches in matplotlib's Axes: bifurcation diagrams."""

from typing import Any, Dict, List, Optional, Sequence, Tuple

import numpy as np

from . import _style
from ._errors import BadInput
from ._native import ffi, lib, text_of
from .orbits import SPECIALS, _choose



def _observables() -> List[Tuple[str, str, int]]:
    found: List[Tuple[str, str, int]] = []
    while True:
        row = lib.fst_branch_observable_at(len(found))
        if not row:
            return found
        found.append((text_of(row.name), text_of(row.unit), int(row.offset)))


def _of_points(points: Any, offset: int, unit: str) -> Any:
    """An observable of points; angles lie about 0 and 180 degrees, so that the gap of their range is at -90."""
    name = next(name for name, field in points.dtype.fields.items() if field[1] == offset)
    values = np.array(points[name], float)
    return np.where(values < -90, values + 360, values) if unit == "deg" else values


def _jumps(unit: str, a: float, b: float) -> bool:
    return unit == "deg" and not abs(b - a) <= 90


def _border(b: Any, p: Any, q: Any, special: Any, y: Any, unit: str) -> Optional[Tuple[float, float]]:
    """Where the stability changes between two points: at the special point there, otherwise half way."""
    x, reach = 0.5 * (p["value"] + q["value"]), 1.5 * abs(p["value"] - q["value"]) + 1e-9
    r, reach_r = 0.5 * (p["mean_r"] + q["mean_r"]), 1.5 * abs(p["mean_r"] - q["mean_r"]) + 1e-6
    near = [
        (abs(s.value - x), s.value, value)
        for s, value in zip(b.specials, special)
        if s.type != "origin-crossing" and abs(s.value - x) < reach and abs(s._special.at.mean_r - r) < reach_r
    ]
    if near and not _jumps(unit, y[0], min(near)[2]) and not _jumps(unit, y[1], min(near)[2]):
        return min(near)[1:]
    return None if _jumps(unit, y[0], y[1]) else (x, 0.5 * (y[0] + y[1]))


def _pieces(b: Any, points: Any, y: Any, special: Any, unit: str) -> Tuple[List[Any], List[Any]]:
    """The curves of one branch: stable pieces and unstable ones, joined where the stability changes."""
    made: Tuple[List[Any], List[Any]] = ([], [])
    piece: List[Tuple[float, float]] = []
    for i, point in enumerate(points):
        stable = bool(point["stable"])
        if i and bool(points[i - 1]["stable"]) != stable:
            border = _border(b, points[i - 1], point, special, (y[i - 1], y[i]), unit)
            piece.extend([border] if border else [])
            made[not points[i - 1]["stable"]].append(piece)
            piece = [border] if border else []
        elif i and _jumps(unit, y[i - 1], y[i]):
            made[not stable].append(piece)
            piece = []
        piece.append((float(point["value"]), float(y[i])))
    if len(points):
        made[not points[-1]["stable"]].append(piece)
    return made


#: The most pieces of a smooth curve between two points, and about as many points as all curves need.
_PIECES, _ENOUGH = 8, 1600


def _smooth(curve: Any, wide: float, tall: float, parts: int) -> Any:
    """The house's cubics through the points of a piece; a point that is given twice is kept once.

    What grows by orders of magnitude is smoothed by its logarithm: cubics would swing."""
    y = curve[:, 1]
    if y.min() > 0 and y.max() > 100 * y.min():
        by_logarithm = _smooth(np.stack([curve[:, 0], np.log(y)], axis=1), wide, float(np.ptp(np.log(y))), parts)
        return np.stack([by_logarithm[:, 0], np.exp(by_logarithm[:, 1])], axis=1)
    fresh = np.abs(np.diff(curve, axis=0)) > 1e-9 * np.array([wide, tall])
    curve = curve[np.append(True, fresh.any(axis=1))]
    room = parts * (len(curve) - 1) + 1
    x, y = (np.ascontiguousarray(curve[:, i]) for i in range(2))
    to_x, to_y = np.empty(room), np.empty(room)
    given = [ffi.from_buffer("double[]", array) for array in (x, y)]
    made = [ffi.from_buffer("double[]", array, require_writable=True) for array in (to_x, to_y)]
    count = lib.fst_smooth(*given, len(curve), parts, wide, tall, *made)
    return np.stack([to_x[:count], to_y[:count]], axis=1)


def branch(b: Any, y: str = "mean_r", *, units: str = "given", ax: Any = None) -> Any:
    """Draw a branch: stable parts solid, unstable ones dashed, special points with signs of their own.

    Parameters
    ----------
    y
        mean_r, mean_alpha_dot, mean_nz, festoons, min_r, period, phi_deg, slip, relaxation_time, swing_ratio; of a
        special point that was followed over two parameters, "second" is the default.
    units
        "lab" (mm, s, Hz), "scaled" or "si"; "given": those of a laboratory where the parameter has them.
    ax
        The Axes to draw into; without it a new figure is made.
    """
    table = _observables()
    if b.second_key and y == "mean_r":
        y = "second"
    name, unit, offset = table[_choose(y, [row[0] for row in table], "y")]
    if not len(b.points):
        raise BadInput("branch", f"this branch over {b.key} has no points, so that there is nothing to draw")
    if not np.isfinite(_of_points(b.points, offset, unit)).any():
        there = [row[0] for row in table if np.isfinite(_of_points(b.points, row[2], row[1])).any()]
        raise BadInput("y", f"no point of this branch (kind: {b.kind}) has a value of {y}; it has {', '.join(there)}")
    x_shown, y_shown = _axes_of_branch(b, name, unit, units)
    special = [_special_value(s, offset, unit) for s in b.specials]
    hidden = set()
    if name not in ("mean_nz", "phi_deg"):  # only these tell a branch from its image under S2
        hidden = {end.branch for end in b.ends if end.image is not None and end.image < end.branch}
    ax = _style.axes(ax, 6.0, 4.6)
    words = {False: "stable", True: "unstable"}
    wide, tall = (float(np.nanmax(v) - np.nanmin(v)) for v in (b.points["value"], _of_points(b.points, offset, unit)))
    parts = max(1, min(_PIECES, _ENOUGH // len(b.points) + 1))
    for number, points in enumerate(b):
        if number in hidden or not len(points):
            continue
        for unstable, pieces in enumerate(_pieces(b, points, _of_points(points, offset, unit), special, unit)):
            for piece in pieces:
                curve = np.array(piece)
                curve = curve[np.isfinite(curve).all(axis=1)]
                if not len(curve):
                    continue
                curve = _smooth(curve, wide, tall, parts)
                ax.plot(
                    x_shown.factor * curve[:, 0], y_shown.factor * curve[:, 1],
                    color=_style.colour("grey" if unstable else "blue"), linestyle="--" if unstable else "-",
                    linewidth=1.4 if unstable else 1.8, label=words.pop(bool(unstable), None),
                )
    _special_signs(ax, b, special, x_shown.factor, y_shown.factor)
    kinds = {"counter": "Counter-rotating orbits", "locked": "Locked states", "all": "Locked states and orbits"}
    about = f"dynamics {b.bead.model__dynamics}" if b.bead else ""
    _style.dress(ax, f"{kinds[b.kind]} over the {x_shown.words}", about, x_shown.label, y_shown.label)
    handles = ax.get_legend_handles_labels()[0]
    _style.key_below(ax, sorted(handles, key=lambda handle: bool(handle.get_label() != "stable")))
    return ax


def _axes_of_branch(b: Any, name: str, unit: str, units: str) -> Tuple[Any, Any]:
    scales = ffi.new("fst_scales *", (b._branch.half_length, 1 / b._branch.gamma, np.nan, np.nan))
    varied = [key for key in (b.key, b.second_key) if key in ("friction.gamma", "magnet.half_length")]
    if varied and units != "given":
        raise BadInput("units", f"the branch varies {varied[0]}, a unit itself: leave units=\"given\"")
    used = "given" if varied else units if units != "given" else _style.units_over([b.key])
    x_shown = _style.of_parameter(b.key, units, scales)
    if name == "second":
        return x_shown, _style.of_parameter(b.second_key, units, scales)
    return x_shown, _style.of_result(name, unit, used, scales)


def _special_value(special: Any, offset: int, unit: str) -> float:
    at = ffi.cast("char *", ffi.addressof(special._special.at))
    value = float(ffi.cast("double *", at + offset)[0])
    return value + 360 if unit == "deg" and value < -90 else value


#: matplotlib's markers of the special points, in the order of fst_special_type.
_SIGNS = ("s", "^", "D", "o", "v", "x", "+", "*")


def _special_signs(ax: Any, b: Any, values: Sequence[float], x_factor: float, y_factor: float) -> None:
    for i, name in enumerate(SPECIALS):
        places = [(s.value, value) for s, value in zip(b.specials, values) if s.type == name]
        places = [place for place in places if np.isfinite(place).all()]
        if places:
            words, colour = _style.look("special", i)
            x, y = np.array(places).T
            open_sign: Dict[str, Any] = {"linewidths": 1.8} if _SIGNS[i] in "x+*" else {"edgecolors": "white", "linewidths": 0.6}
            ax.scatter(
                x_factor * x, y_factor * y, s=52, marker=_SIGNS[i], color=colour, label=words, zorder=4, **open_sign
            )
