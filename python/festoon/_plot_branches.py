"""Branches in matplotlib's Axes: bifurcation diagrams, as the library's chart describes them."""

from typing import Any, Optional

from . import _plot_several, _style
from ._given import of_class
from ._native import call, ffi, lib, text_of
from ._quantities import units_of
from .orbits import _choose


def branch(b: Any, y: str = "mean_r", *, units: str = "given", label: Optional[str] = None, ax: Any = None) -> Any:
    """Draw a branch: stable parts solid, unstable ones dashed, special points with signs of their own.

    Several branches may go into one Axes, where each has one colour.

    Parameters
    ----------
    b
        A `Branch`.
    y
        mean_r, mean_alpha_dot, mean_nz, festoons, min_r, period, phi_deg, slip, relaxation_time, swing_ratio; of a
        special point that was followed over two parameters, "second" is the default, of places where a bead floats
        height_mm (beside tilt_deg, circle_mm, gap_mm).  "multipliers": those of the
        orbits with the unit circle, or the eigenvalues of locked states.
    units
        "lab" (mm, s, Hz), "scaled" or "si"; "given": those of a laboratory where the parameter has them.
    label
        Its name in the key, where several branches stand in one Axes; by default what it has of its own.
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
    of_class(b, "Branch", "b")
    names = ["multipliers"]
    while lib.fst_branch_observable_at(len(names) - 1):
        names.append(text_of(lib.fst_branch_observable_at(len(names) - 1).name))
    y = text_of(lib.fst_branch_observable(b._branch)) if y == "mean_r" else y
    _choose(y, names, "y")
    made = ffi.new("fst_chart **")
    call(lib.fst_chart_of_branch, b._branch, y.encode(), units_of(units), ffi.NULL, 0, made)
    chart = ffi.gc(made[0], lib.fst_chart_free)
    ax = _style.axes(ax, 6.0, 4.6)
    others = _plot_several.before(ax)
    panel, there = chart.panels[0], [*ax.lines]
    for i in range(panel.curve_count):
        _style.curve(ax, panel.curves[i])
    lines = [line for line in ax.lines if line not in there]
    for i in range(chart.mark_count):
        ax.axvline(chart.marks[i].x, color="#777777", linestyle=":", linewidth=1.2, label=text_of(chart.marks[i].text))
    if chart.square:
        ax.set_aspect("equal")
        limits = [*ax.get_xlim(), *ax.get_ylim()] if others else [chart.x_low, chart.x_high, panel.low, panel.high]
        ax.set_xlim(min(chart.x_low, limits[0]), max(chart.x_high, limits[1]))
        ax.set_ylim(min(panel.low, limits[2]), max(panel.high, limits[3]))
    about = f"dynamics {b.bead.model__dynamics}" if b.bead and not others else ""
    params = b.bead._params if b.bead else b._branch.scene or None
    fixed = {"": y, **{key: "" for key in (b.key, b.second_key) if key}}
    if lines and not chart.square:
        _plot_several.beside(ax, _plot_several.Drawn(params, fixed, lines, [], label, True))
    known = set()
    for signs in ax.collections:  # each sign stands in the key once
        signs.set_label("_" if signs.get_label() in known else signs.get_label())
        known.add(signs.get_label())
    _style.dress(ax, text_of(chart.title), about, _style.lowered(chart.x_label), _style.lowered(panel.left_label))
    _style.key_below(ax)
    return ax
