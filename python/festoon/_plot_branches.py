"""Branches in matplotlib's Axes: bifurcation diagrams, as the library's chart describes them."""

from typing import Any

from . import _style
from ._native import call, ffi, lib, text_of
from ._quantities import units_of
from .orbits import _choose


def branch(b: Any, y: str = "mean_r", *, units: str = "given", ax: Any = None) -> Any:
    """Draw a branch: stable parts solid, unstable ones dashed, special points with signs of their own.

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
    names = ["multipliers"]
    while lib.fst_branch_observable_at(len(names) - 1):
        names.append(text_of(lib.fst_branch_observable_at(len(names) - 1).name))
    y = text_of(lib.fst_branch_observable(b._branch)) if y == "mean_r" else y
    _choose(y, names, "y")
    made = ffi.new("fst_chart **")
    call(lib.fst_chart_of_branch, b._branch, y.encode(), units_of(units), ffi.NULL, 0, made)
    chart = ffi.gc(made[0], lib.fst_chart_free)
    ax = _style.axes(ax, 6.0, 4.6)
    panel = chart.panels[0]
    for i in range(panel.curve_count):
        _style.curve(ax, panel.curves[i])
    for i in range(chart.mark_count):
        ax.axvline(chart.marks[i].x, color="#777777", linestyle=":", linewidth=1.2, label=text_of(chart.marks[i].text))
    if chart.square:
        ax.set_aspect("equal")
        ax.set_xlim(chart.x_low, chart.x_high)
        ax.set_ylim(panel.low, panel.high)
    about = f"dynamics {b.bead.model__dynamics}" if b.bead else ""
    _style.dress(ax, text_of(chart.title), about, _style.lowered(chart.x_label), _style.lowered(panel.left_label))
    _style.key_below(ax)
    return ax
