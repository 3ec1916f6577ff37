"""Pictures with matplotlib: each function draws into Axes, its own or yours, and returns them."""

from typing import Any, Optional

import numpy as np

from ._tables import COLUMNS, RESULTS
from .bead import row_of


def _axes(ax: Optional[Any]) -> Any:
    if ax is not None:
        return ax
    import matplotlib.pyplot as plt

    return plt.subplots()[1]


def trajectory(samples: Any, colour: Optional[str] = None, ax: Optional[Any] = None) -> Any:
    """The path in the laboratory, in mm, coloured by a column."""
    from matplotlib.collections import LineCollection

    ax = _axes(ax)
    lab = samples.lab
    if colour is None:
        ax.plot(lab.x, lab.y, linewidth=0.8)
    else:
        points = np.column_stack([lab.x, lab.y])
        lines = LineCollection(np.stack([points[:-1], points[1:]], axis=1), linewidths=1.0)
        lines.set_array(getattr(samples, colour)[:-1])
        ax.add_collection(lines)
        ax.autoscale_view()
        unit = COLUMNS[colour][0]
        ax.figure.colorbar(lines, ax=ax, label=colour if unit == "1" else f"{colour} [{unit}]")
    ax.set_aspect("equal")
    ax.set_xlabel(f"x [{lab.unit('x')}]")
    ax.set_ylabel(f"y [{lab.unit('y')}]")
    return ax


def branch(branches: Any, y: str = "mean_r", ax: Optional[Any] = None) -> Any:
    """An observable over the parameter: stable parts solid, unstable ones dashed, special points marked."""
    ax = _axes(ax)
    for points in branches:
        for stable, style in ((1, "-"), (0, "--")):
            shown = np.where(points["stable"] == stable, points[y], np.nan)
            ax.plot(points["value"], shown, style, color="C0" if stable else "0.5")
    for special in branches.specials:
        at = getattr(special._special.at, y)
        ax.plot(special.value, at, "o", color="C3", markersize=4)
        ax.annotate(special.type, (special.value, at), textcoords="offset points", xytext=(4, 4), fontsize=8)
    unit = row_of(branches.key)[1]
    ax.set_xlabel(branches.key if unit == "1" else f"{branches.key} [{unit}]")
    ax.set_ylabel(f"{y} [{RESULTS[y][0]}]" if y in RESULTS and RESULTS[y][0] != "1" else y)
    return ax


def sweep(results: Any, y: Optional[str] = None, ax: Optional[Any] = None) -> Any:
    """Curves of a result over the first axis, one for each value of the others."""
    ax = _axes(ax)
    y = y or "mean_r"
    first = results.dims[0]
    over = results.parameter(first)
    values = results._array(y)
    over, values = over.reshape(len(over), -1), values.reshape(len(values), -1)
    for i in range(values.shape[1]):
        ax.plot(over[:, i], values[:, i], marker=".", markersize=3)
    ax.set_xlabel(first)
    unit = RESULTS[y][0]
    ax.set_ylabel(y if unit == "1" else f"{y} [{unit}]")
    return ax
