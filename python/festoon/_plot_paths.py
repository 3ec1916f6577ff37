"""Paths of the bead, orbits, and the magnet's field, in matplotlib's Axes."""

from typing import Any, Optional

import numpy as np

from . import _style
from ._given import of_class
from ._native import call, ffi, lib, text_of
from ._quantities import UNITS, units_of
from ._tables import COLUMNS
from .orbits import _choose


#: Of an orbit in its period.
_SAMPLES = 480

# ---------------------------------------------------------------------------------------- trajectories

_FRAMES = ("lab", "magnet")


def _options(kind: str, colour: str, units: str, begin: Optional[float], end: Optional[float]) -> Any:
    """Options of the library's figures, and what must stay alive with them."""
    options = ffi.new("fst_figure_options *", lib.fst_default_figure_options())
    options.kind = getattr(lib, f"FST_FIGURE_{kind}")
    kept = ffi.new("char[]", colour.encode())
    options.colour, options.units = kept, units_of(units)
    if begin is not None:
        setattr(options, "from", begin)
    if end is not None:
        options.to = end
    return options, kept


def _magnet(ax: Any, picture: Any) -> None:
    """The lines of the magnet, from above."""
    for line in (picture.lines[i] for i in range(picture.line_count)):
        x, y = (_style.numbers(values, line.count) for values in (line.x, line.y))
        if line.is_ground:
            ax.fill(x, y, facecolor="#f3f3f3", edgecolor="none", zorder=0.5)
        ax.plot(x, y, color=text_of(line.colour), linewidth=0.8 * line.width, label=_style.lowered(line.words), zorder=1.4)


def _moments(ax: Any, picture: Any) -> None:
    """Arrows of the moment's horizontal part, each as long as that part."""
    arrows = _style.numbers(picture.arrows, 4 * picture.arrow_count).reshape(-1, 4).T
    ax.quiver(
        *arrows, angles="xy", scale_units="xy", scale=1, color=_style.colour("grey"),
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
    tr
        A `Trajectory`.
    colour
        The column that colours the path, one of those of the trajectory: n_z, slip, angle, B, ...
    over
        Draw the column `colour` over this column ("t", "drive_turns", "Phi") in place of the path.
    frame
        "lab": as a camera over the plate sees it; "magnet": as one that turns with the magnet does.
    units
        "lab" (mm, s, Hz), "scaled" or "si"; "given": those of a laboratory for paths; over a column, scaled where
        the drive is.
    begin, end
        The drive periods shown; without them as many from run.discard on as make a good picture.
    arrows
        Whether arrows show the horizontal part of the moment.
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
    columns = list(COLUMNS)
    _choose(colour, columns, "colour")
    _choose(frame, list(_FRAMES), "frame")
    if over is not None:
        _choose(over, columns, "over")
        return _column_over(tr, colour, over, units, begin, end, ax)
    from matplotlib.collections import LineCollection

    (options, _kept), (table, _columns) = _options("PATH", colour, units, begin, end), of_class(tr, "Trajectory", "tr")._rows()
    options.from_magnet, options.arrows = frame == "magnet", bool(arrows)
    picture = ffi.gc(ffi.new("fst_path_picture *"), lib.fst_path_picture_free)
    call(lib.fst_path_picture_of, table, options, picture)
    ax = _style.axes(ax, 5.4, 5.8)
    x, y, values = (_style.numbers(pointer, picture.count) for pointer in (picture.x, picture.y, picture.colour))
    cmap, norm = _style.colours_in(picture.colours)
    points = np.stack([x, y], axis=1)
    lines = LineCollection(
        np.stack([points[:-1], points[1:]], axis=1), cmap=cmap, norm=norm, linewidth=1.8, capstyle="round", zorder=2
    )
    lines.set_array(values[:-1])
    _magnet(ax, picture)
    if picture.arrow_count:
        _moments(ax, picture)
    ax.add_collection(lines)
    ax.plot(
        x[:1], y[:1], "o", markersize=7, markerfacecolor="white", markeredgewidth=1.8,
        color=_style.colour("black"), label="the bead at the beginning", zorder=3,
    )
    ax.set_aspect("equal")
    ax.set_xlim(picture.box[0], picture.box[1])
    ax.set_ylim(picture.box[2], picture.box[3])
    labels = (_style.lowered(label) for label in (picture.x_label, picture.y_label))
    _style.dress(ax, text_of(picture.title), text_of(picture.about), *labels)
    _style.scale_beside(ax, lines, _style.lowered(picture.colour_label))
    _style.key_below(ax, columns=1)
    return ax


def _column_over(
    tr: Any, name: str, over: str, units: str, begin: Optional[float], end: Optional[float], ax: Any
) -> Any:
    (options, _kept), (table, _columns) = _options("TIME", name, units, begin, end), of_class(tr, "Trajectory", "tr")._rows()
    part = ffi.new("fst_figure_part *")
    call(lib.fst_figure_part_of, table, options, part)
    tr = tr[part.first : part.last]
    ax = _style.axes(ax, 6.2, 3.4)
    units = next(name for name, place in UNITS.items() if place == part.units)
    x, y = (_style.of_column(column, units, tr.bead._params) for column in (over, name))
    ax.plot(x.factor * tr._column(over), y.factor * tr._column(name), color=_style.colour("blue"), linewidth=1.5)
    _style.dress(ax, f"{y.words} over {x.words}", text_of(part.about), x.label, y.label)
    return ax


# ---------------------------------------------------------------------------------------- orbits


def orbit(o: Any, colour: str = "n_z", *, frame: str = "magnet", **options: Any) -> Any:
    """Draw an orbit over one period, closed as seen from the magnet; options are those of `trajectory`.

    Parameters
    ----------
    o
        An `Orbit`.
    colour
        The column that colours the path.
    frame
        "magnet" or "lab".
    **options
        Those of `trajectory`.

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
    periods = abs(of_class(o, "Orbit", "o").bead.omega * o.period / (2 * np.pi))
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
    bead: Any, *, units: str = "given", half_width: Optional[float] = None, half_height: Optional[float] = None,
    ax: Any = None,
) -> Any:
    """Draw the map of ``|B|`` on the plane of the bead's centre, with arrows of the part in the plane.

    Parameters
    ----------
    bead
        A `Bead`.
    units
        "lab" (mm, mT where B0 follows from the bead), "scaled" or "si".
    half_width, half_height
        Of the map, in l; without them it shows the whole magnet.
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
    if units == "given":
        units = _style.units_of_bead(of_class(bead, "Bead", "bead")._params)
    options = ffi.new("fst_field_options *", lib.fst_default_field_options())
    options.units = units_of(units)
    for name, half in (("half_width", half_width), ("half_height", half_height)):
        if half is not None:
            setattr(options, name, half)
    picture = ffi.gc(ffi.new("fst_field_picture *"), lib.fst_field_picture_free)
    call(lib.fst_field_picture_of, bead._params, options, picture)
    ax = _style.axes(ax, 6.0, 5.4)
    x, y = (np.linspace(picture.box[i], picture.box[i + 1], n) for i, n in ((0, picture.columns), (2, picture.rows)))
    masked: Any = np.ma.masked_invalid
    values = masked(_style.numbers(picture.values, picture.columns * picture.rows).reshape(len(y), len(x)))
    cmap, norm = _style.colours_in(picture.colours)
    drawn = ax.pcolormesh(x, y, values, cmap=cmap, norm=norm, shading="gouraud", rasterized=True)
    levels = ax.contour(x, y, values, levels=list(picture.levels)[: picture.level_count], colors="#4f759b", linewidths=0.7)
    places = [(label[0], label[1]) for label in list(picture.labels)[: picture.label_count]]
    if places:
        ax.clabel(levels, fontsize=8, fmt="%.4g", inline=True, manual=places, colors="#0b2a4a")
    ax.quiver(
        *_style.numbers(picture.arrows, 4 * picture.arrow_count).reshape(-1, 4).T, angles="xy", scale_units="xy", scale=1,
        color="#333333", width=0.0026,
    )
    _magnet(ax, picture)
    maxima = np.array([tuple(place) for place in picture.maxima][: picture.maximum_count]).reshape(-1, 2)
    if len(maxima):
        ax.plot(*maxima.T, "x", color="black", markersize=7, markeredgewidth=2, label="maxima of |B|", zorder=3)
    if picture.distance[0] != b"\0":
        ax.plot(*maxima.T, color="black", linewidth=1.2, zorder=3)
        ax.annotate(
            text_of(picture.distance), maxima.mean(axis=0), xytext=(0, 4), textcoords="offset points", ha="center",
            fontsize=8,
        )
    ax.set_aspect("equal")
    ax.plot([], [], color="#4f759b", linewidth=0.7, label=_style.lowered(picture.level_words))
    about = f"{text_of(picture.about)}; arrows: {text_of(picture.arrow_words).split(':')[0]}"
    _style.dress(ax, text_of(picture.title), about, text_of(picture.x_label), text_of(picture.y_label))
    ax.grid(False)
    _style.scale_beside(ax, drawn, _style.lowered(picture.colour_label))
    _style.key_below(ax, columns=1)
    return ax
