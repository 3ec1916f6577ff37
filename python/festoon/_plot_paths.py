"""Paths of the bead, orbits, and the magnet's field, in matplotlib's Axes."""

from typing import Any, Optional, Tuple

import numpy as np

from . import _style
from ._errors import BadInput
from ._native import lib
from ._tables import COLUMNS
from .orbits import _choose


#: Points of a smooth path, and the most pieces that are drawn between two samples.
_ENOUGH, _PIECES = 6000, 8
#: Of an orbit in its period.
_SAMPLES = 480
#: About as many arrows as a picture can bear; as a path from side to side can; the longest one in sides.
_ARROWS, _ARROWS_ALONG, _LONGEST_ARROW = 110, 18, 0.07

# ---------------------------------------------------------------------------------------- trajectories

_FRAMES = {
    "lab": ("x", "y", "vx", "vy", "n_x", "n_y"),
    "magnet": ("X", "Y", "vX", "vY", "nX", "nY"),
}


def _rows_shown(tr: Any, begin: Optional[float], end: Optional[float], turns: float, periods: float) -> slice:
    """The samples that are shown: those asked for, or as many from the discard on as make a good picture."""
    drive, alpha = tr._column("drive_turns"), tr._column("alpha")
    start = begin
    if start is None:
        discard = float(lib.fst_run_discard(tr.bead._params))
        start = discard if len(drive) and drive[-1] > discard else 0.0
    first = int(np.searchsorted(drive, start - 1e-9))
    if end is not None:
        last = int(np.searchsorted(drive, end + 1e-9, side="right"))
    elif first < len(drive):
        over = (drive[first:] - drive[first] > periods) | (
            np.abs(alpha[first:] - alpha[first]) > 2 * np.pi * turns
        )
        last = first + int(np.argmax(over)) if over.any() else len(drive)
    else:
        last = first
    if last - first < 2:
        ends = drive[-1] if len(drive) else 0.0
        raise BadInput(
            "begin",
            f"fewer than two samples from drive period {start:g} on: the trajectory has {len(drive)} samples"
            f" and ends at period {ends:g}",
        )
    return slice(first, last)


def _smooth(t: Any, x: Any, v: Any, pieces: int) -> Any:
    """Cubics through samples with velocities, `pieces` between two of them."""
    part = np.arange(pieces) / pieces
    rest = 1 - part
    h = np.diff(t)[:, None]
    curve = rest**2 * ((1 + 2 * part) * x[:-1, None] + part * h * v[:-1, None])
    curve += part**2 * ((1 + 2 * rest) * x[1:, None] - rest * h * v[1:, None])
    return np.append(curve.ravel(), x[-1])


def _linear(values: Any, pieces: int) -> Any:
    part = np.arange(pieces) / pieces
    return np.append((values[:-1, None] + part * np.diff(values)[:, None]).ravel(), values[-1])


def _path(tr: Any, frame: str) -> Tuple[Any, Any, Any, int]:
    """The path and the parameter of its points.  In the magnet's frame a velocity is what a camera sees that turns
    with the magnet."""
    x, y, vx, vy = (tr._column(name) for name in _FRAMES[frame][:4])
    if frame == "magnet":
        omega = tr._column("omega")
        vx, vy = vx + omega * y, vy - omega * x
    pieces = max(1, min(_PIECES, _ENOUGH // len(x)))
    t = tr._column("t")
    return _smooth(t, x, vx, pieces), _smooth(t, y, vy, pieces), t, pieces


def _outline(ax: Any, tr: Any, frame: str, length: float) -> None:
    """The magnet's lines at the beginning, where the magnet is one of lines."""
    bead = tr.bead
    if bead.magnet__shape != "lines":
        return
    turned = 0.0 if frame == "magnet" else tr._column("alpha")[0] - tr._column("Phi")[0]
    wide = 0.5 * (bead.groups.lines - 1) * bead.groups.lambda_
    corners = length * np.array([(-1, -wide), (1, -wide), (1, wide), (-1, wide), (-1, -wide)])
    cosine, sine = np.cos(turned), np.sin(turned)
    x, y = corners[:, 0] * cosine - corners[:, 1] * sine, corners[:, 0] * sine + corners[:, 1] * cosine
    words = "magnet's lines" + ("" if frame == "magnet" else " at the beginning; it turns anticlockwise")
    ax.fill(x, y, facecolor="#f3f3f3", edgecolor="none", zorder=0.5)
    ax.plot(x, y, color="#b4b4b4", linewidth=1, label=words, zorder=0.6)


def _moments(ax: Any, tr: Any, frame: str, length: float, side: float) -> None:
    """Arrows of the moment's horizontal part, each as long as that part."""
    names = _FRAMES[frame]
    x, y = (length * tr._column(name) for name in names[:2])
    along = float(np.hypot(np.diff(x), np.diff(y)).sum())
    stride = len(x) // int(min(_ARROWS, 1 + _ARROWS_ALONG * along / side)) + 1
    scale = _LONGEST_ARROW * side
    n_x, n_y = (scale * tr._column(name)[::stride] for name in names[4:6])
    ax.quiver(
        x[::stride], y[::stride], n_x, n_y, angles="xy", scale_units="xy", scale=1, color=_style.colour("grey"),
        width=0.0028, headwidth=4, headlength=5, headaxislength=4.6, zorder=1.5,
    )
    from matplotlib.lines import Line2D

    words = "horizontal part of the moment n"
    arrow = Line2D([], [], color=_style.colour("grey"), marker=">", markevery=[1], markersize=4, label=words)
    ax.add_line(arrow)


def trajectory(
    tr: Any,
    colour: str = "n_z",
    *,
    over: Optional[str] = None,
    frame: str = "lab",
    units: str = "given",
    begin: Optional[float] = None,
    end: Optional[float] = None,
    arrows: bool = True,
    ax: Any = None,
) -> Any:
    """Draw the path over the plate, or a column over another one.

    Parameters
    ----------
    colour
        The column that colours the path, one of those of the trajectory: n_z, slip, angle, B, ...
    over
        Draw the column `colour` over this column ("t", "drive_turns", "Phi") in place of the path.
    frame
        "lab": as a camera over the plate sees it; "magnet": as one that turns with the magnet does.
    units
        "lab" (mm, s, Hz), "scaled" or "si"; "given": scaled where the drive is.
    begin, end
        The drive periods shown; without them as many from run.discard on as make a good picture.
    arrows
        Whether arrows show the horizontal part of the moment.
    ax
        The Axes to draw into; without it a new figure is made.
    """
    columns = list(COLUMNS)
    _choose(colour, columns, "colour")
    _choose(frame, list(_FRAMES), "frame")
    if units == "given":
        units = _style.units_of_bead(tr.bead._params)
    if over is not None:
        _choose(over, columns, "over")
        return _column_over(tr, colour, over, units, begin, end, ax)
    tr = tr[_rows_shown(tr, begin, end, 2.0, 30.0)]
    from matplotlib.collections import LineCollection

    ax = _style.axes(ax, 5.4, 5.8)
    place = _style.of_column("x", units, tr.bead._params)
    shown = _style.of_column(colour, units, tr.bead._params)
    x, y, _, pieces = _path(tr, frame)
    x, y = place.factor * x, place.factor * y
    values = shown.factor * _linear(tr._column(colour), pieces)
    cmap, norm = _style.colours_between(colour, float(np.nanmin(values)), float(np.nanmax(values)))
    points = np.stack([x, y], axis=1)
    lines = LineCollection(
        np.stack([points[:-1], points[1:]], axis=1), cmap=cmap, norm=norm, linewidth=1.8, capstyle="round", zorder=2
    )
    lines.set_array(values[:-1])
    reach = max(1.12 * float(np.abs(points).max()), 1.12 * place.factor)
    _outline(ax, tr, frame, place.factor)
    if arrows:
        _moments(ax, tr, frame, place.factor, 2 * reach)
    ax.add_collection(lines)
    ax.plot(
        x[:1], y[:1], "o", markersize=7, markerfacecolor="white", markeredgewidth=1.8,
        color=_style.colour("black"), label="the bead at the beginning", zorder=3,
    )
    ax.set_aspect("equal")
    ax.set_xlim(-reach, reach)
    ax.set_ylim(-reach, reach)
    omega = tr._column("omega")
    words = ("x", "y") if frame == "lab" else ("X, along the magnet", "Y")
    labels = [place.label.replace("x", word, 1) for word in words]
    title = "Path of the bead " + ("over the plate" if frame == "lab" else "as seen from the magnet")
    _style.dress(ax, title, _style.about_bead(tr.bead, (float(omega[0]), float(omega[-1]))), *labels)
    _style.scale_beside(ax, lines, shown.label)
    _style.key_below(ax, columns=1)
    return ax


def _column_over(
    tr: Any, name: str, over: str, units: str, begin: Optional[float], end: Optional[float], ax: Any
) -> Any:
    tr = tr[_rows_shown(tr, begin, end, np.inf, 8.0)]
    ax = _style.axes(ax, 6.2, 3.4)
    x = _style.of_column(over, units, tr.bead._params)
    y = _style.of_column(name, units, tr.bead._params)
    ax.plot(x.factor * tr._column(over), y.factor * tr._column(name), color=_style.colour("blue"), linewidth=1.5)
    omega = tr._column("omega")
    about = _style.about_bead(tr.bead, (float(omega[0]), float(omega[-1])))
    _style.dress(ax, f"{y.words} over {x.words}", about, x.label, y.label)
    return ax


# ---------------------------------------------------------------------------------------- orbits


def orbit(o: Any, colour: str = "n_z", *, frame: str = "magnet", **options: Any) -> Any:
    """Draw an orbit over one period, closed as seen from the magnet; options are those of `trajectory`."""
    periods = abs(o.bead.omega * o.period / (2 * np.pi))
    # So many samples in a period that the last one closes the curve.
    rate = _SAMPLES * o.bead.gamma / o.period
    whole = o.bead.run(
        periods=max(periods, options.get("end") or 0) + 1, discard=0.0, trajectory=True, fps=rate, start=o.state
    ).trajectory
    options.setdefault("begin", 0.0)
    options.setdefault("end", periods)
    ax = trajectory(whole, colour, frame=frame, **options)
    words = "Stable" if o.stable else "Unstable"
    ax.set_title(f"{words} orbit" + (f", {o.symmetry}" if o.symmetry else ""), fontsize=11, pad=19)
    return ax


# ---------------------------------------------------------------------------------------- the field


def field(
    bead: Any, *, units: str = "given", half_width: float = 1.9, half_height: float = 1.5, ax: Any = None
) -> Any:
    """Draw the map of ``|B|`` on the plane of the bead's centre, with arrows of the part in the plane.

    Parameters
    ----------
    units
        "lab" (mm, mT where B0 follows from the bead), "scaled" or "si".
    half_width, half_height
        Of the map, in l.
    ax
        The Axes to draw into; without it a new figure is made.
    """
    if units == "given":
        units = _style.units_of_bead(bead._params)
    ax = _style.axes(ax, 6.0, 4.6)
    place = _style.of_column("x", units, bead._params)
    strength = _style.of_column("B", units, bead._params)
    x = np.linspace(-half_width, half_width, 181)
    y = np.linspace(-half_height, half_height, 145)
    b, _ = bead.field(*np.meshgrid(x, y))
    size = strength.factor * np.linalg.norm(b, axis=-1)
    across, up = place.factor * x, place.factor * y
    drawn = ax.pcolormesh(across, up, size, cmap=_style.palette("map"), vmin=0, shading="gouraud", rasterized=True)
    levels = ax.contour(across, up, size, levels=8, colors="#0b2a4a", linewidths=0.7, alpha=0.75)
    ax.clabel(levels, fontsize=8, fmt="%.4g", inline=True)
    step = 12
    part = slice(step // 2, None, step)
    plane = b[part, part, :2]
    flat = np.hypot(plane[..., 0], plane[..., 1])
    longest = 1.1 * place.factor * (x[step] - x[0])
    with np.errstate(invalid="ignore", divide="ignore"):
        arrow = np.where(flat[..., None] > 0, plane / flat[..., None] * np.sqrt(flat / flat.max())[..., None], 0)
    ax.quiver(
        across[part], up[part], longest * arrow[..., 0], longest * arrow[..., 1], pivot="middle", angles="xy",
        scale_units="xy", scale=1, color="#333333", width=0.0026,
    )
    _lines_of_magnet(ax, bead, place.factor)
    ax.set_aspect("equal")
    label = place.label
    _style.dress(
        ax, "The magnet's field at the height of the bead",
        "lines and shades: |B|; arrows: its part in the plane",
        label.replace("x", "X", 1), label.replace("x", "Y", 1),
    )
    ax.grid(False)
    _style.scale_beside(ax, drawn, strength.label)
    _style.key_below(ax, columns=1)
    return ax


def _lines_of_magnet(ax: Any, bead: Any, length: float) -> None:
    if bead.magnet__shape != "lines":
        return
    groups = bead.groups
    for i in range(groups.lines):
        y = length * (i - 0.5 * (groups.lines - 1)) * groups.lambda_
        ax.plot(
            (-length, length), (y, y), color=_style.colour("vermilion"), linewidth=1.5,
            label=None if i else "the magnet's lines", zorder=2,
        )
