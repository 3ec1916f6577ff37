"""Sweeps in matplotlib's Axes: curves over one parameter, maps over two."""

from typing import Any, List, Optional, Tuple

import numpy as np

from . import _plot_several, _style
from ._errors import BadInput
from ._given import of_class
from ._keys import row_of
from ._native import call, ffi, lib, text_of
from ._quantities import units_of
from ._tables import RESULTS
from .bead import Bead
from .orbits import _choose
from .runs import REGIMES
from .sweep_tables import ScalesOver


#: The most curves that stand side by side; a sweep with more values of both parameters is a map.
_MOST_CURVES = 7
_CURVES = ("blue", "vermilion", "green", "purple", "sky", "orange", "black")
#: matplotlib's signs of what has no value.
_GAPS = {"undecided": "+", "ejected": "^", "lifted": "v", "touched": "d", "lost": "*", "failed": "x"}


class _Side:
    """A dimension of a sweep as a figure shows it: values in the figure's unit, or names of a choice."""

    def __init__(self, sweep: Any, along: int, axis: Any, units: str) -> None:
        self.along = along
        keys = [text_of(lib.fst_grid_key(sweep._grid, i)) for i in range(lib.fst_grid_axis_count(sweep._grid))]
        found = ffi.new("fst_sweep_axis *")
        call(lib.fst_sweep_axis_of, sweep._grid, keys.index(axis.key), units_of(units), found)
        shown = _style.Quantity(float(found.factor), _style.lowered(found.label))
        values = np.moveaxis(sweep.parameter(axis.keyword), along, 0).reshape(sweep.shape[along], -1)[:, 0]
        self.names: Optional[List[str]] = None
        kind, names, _ = row_of(axis.key)
        if kind == "str":
            self.names = [name for name in names.split(", ") if name in values]  # only choices that were swept
            values = np.array([self.names.index(name) for name in values])
        self.values = values.astype(float) * (1.0 if self.names else shown.factor)
        self.label, self.words = shown.label, shown.words
        self.logarithmic = bool(found.logarithmic) and len(self.values) > 1

    def text(self, i: int) -> str:
        """A value in the key."""
        return self.names[int(self.values[i])] if self.names else f"{self.values[i]:.4g}"

    def dress(self, axis: Any, scale: Any) -> None:
        """Ticks and scale of matplotlib's axis."""
        if self.names:
            axis.set_ticks(range(len(self.names)), self.names)
        elif self.logarithmic:
            scale("log")

    def edges(self) -> Any:
        """Borders of cells half way between neighbours; `values` must rise."""
        v = np.log(self.values) if self.logarithmic else self.values
        if len(v) == 1:
            wide = max(0.1 * abs(v[0]), 1e-9)
            made = np.array([v[0] - wide, v[0] + wide])
        else:
            inner = 0.5 * (v[:-1] + v[1:])
            made = np.concatenate([[2 * v[0] - inner[0]], inner, [2 * v[-1] - inner[-1]]])
        return np.exp(made) if self.logarithmic else made


def _dims_of(sweep: Any) -> Tuple[str, ...]:
    """The names of a sweep's dimensions: that of a random axis, where it is drawn alone, is the axis' own."""
    random = [axis.keyword for axis in sweep.axes if axis.random]
    return tuple(random[0] if name == "draw" and len(random) == 1 else name for name in sweep.dims)


def _regime_index(sweep: Any) -> Any:
    """The regimes as numbers, NaN where a run failed."""
    regime = sweep.regime
    numbers = np.full(sweep.shape, np.nan)
    for i, name in enumerate(REGIMES):
        numbers[regime == name] = i
    numbers[~sweep.done] = np.nan
    return numbers


def _sweep_values(sweep: Any, y: str, units: str) -> Tuple[Any, str, str]:
    """Values, label and words of what is drawn."""
    if y == "regime":
        return _regime_index(sweep), "", "regimes"
    scales = ScalesOver(sweep._scales(), units)
    shown = _style.of_result(y, RESULTS[y][0], units, scales._scales)
    return sweep._array(y) * scales.factor(y, RESULTS[y][0])[0], shown.label, shown.words


def sweep(
    s: Any, y: Optional[str] = None, *, kind: Optional[str] = None, x: Optional[str] = None, units: str = "given",
    label: Optional[str] = None, ax: Any = None,
) -> Any:
    """Draw a sweep: curves over one parameter, a map over two.  Several sweeps with curves may go into one Axes.

    Parameters
    ----------
    s
        A `Sweep`.
    y
        What is drawn, "mean_r", "festoons", ... or "regime"; by default mean_r of curves and the regimes of a map.
    kind
        "curves" or "map"; by default a sweep over two parameters is a map where both have many values.
    x
        The parameter along the abscissa, by its keyword; by default the first one.
    units
        "lab" (mm, s, Hz), "scaled" or "si"; "given": those of a laboratory where a varied parameter has them.
    label
        Its name in the key, where several sweeps stand in one Axes; by default what it has of its own.
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
    of_class(s, "Sweep", "s")
    if y is not None:
        _choose(y, ["regime", *RESULTS], "y")
    if kind is not None:
        _choose(kind, ["curves", "map"], "kind")
    axes, own = {axis.keyword: axis for axis in s.axes}, _dims_of(s)
    if not own or any(name not in axes for name in own) or len(own) > 2:
        raise BadInput(
            "sweep",
            f"a picture shows one or two parameters, not ({', '.join(s.dims)}): choose a part as in s[:, 0], or draw"
            " its numbers with matplotlib",
        )
    dims = list(own)
    if x is not None:
        _choose(x, dims, "x")
        dims.remove(x)
        dims.insert(0, x)
    if units == "given":
        units = _style.units_over([axes[name].key for name in own if len(axes[name].values) > 1])
    sides = [_Side(s, own.index(name), axes[name], units) for name in dims]
    if kind is None:
        few = len(sides) == 1 or min(len(side.values) for side in sides) <= _MOST_CURVES
        kind = "curves" if few else "map"
    if kind == "map" and len(sides) < 2:
        raise BadInput("kind", "a map needs a sweep over two parameters")
    if kind == "map":
        return _map(s, y or "regime", sides, units, ax)
    return _curves(s, y or "mean_r", sides, units, x is None, label, ax)


def _about_sweep(s: Any) -> str:
    base = Bead._of(lib.fst_grid_base(s._grid)[0], s._map)
    varied = [axis.key for axis in s.axes]
    words = "" if "model.dynamics" in varied else f"dynamics {base.model__dynamics}, "
    count = int(s.computed.sum())
    part = f" at {100 * count / s.size:.3g} % of {s.size} points" if s.refined else ""
    of = "" if s.refined or count == s.size else f" of {s.size}"
    part += " (not complete)" if of else ""
    timed = base.run__duration
    length = f"{timed:g} s" if timed is not None else f"{base.run__periods:g} turns of the magnet"
    return f"{words}{count}{of} run{'s' if of or count != 1 else ''} of {length}{part}"


def _regime_marks(ax: Any, x: Any, y: Any, regimes: Any) -> List[Any]:
    made = []
    size = 22 if len(x) <= 80 else 9
    for i in np.unique(regimes[np.isfinite(regimes) & np.isfinite(y)]).astype(int):
        words, colour = _style.look("regime", i)
        here = regimes == i
        made.append(ax.scatter(x[here], y[here], s=size, color=colour, label=words, linewidths=0, zorder=3))
    return made


def _gap_marks(ax: Any, x: Any, states: Any, hidden: Any, level: int, code: str) -> int:
    """Signs at the lower edge where a run failed, or was ejected or undecided, but for those `hidden`; returns how many."""
    count = 0
    for word, marker in _GAPS.items():
        here = (states == word) & ~hidden
        label = f"failed: {here.sum()} point{'s' if here.sum() > 1 else ''}" if word == "failed" else word
        colour = "black" if word == "failed" else _style.look("regime", list(REGIMES).index(word))[1]
        if any(line.get_label() == label for line in ax.lines):
            label = "_"  # no second line in the key
        if here.any():
            ax.plot(
                x[here], np.full(here.sum(), 0.03 + 0.04 * level), transform=ax.get_xaxis_transform(), label=label, marker=marker,
                linestyle="none", color=code or colour, markersize=5, markerfacecolor="none", zorder=4,
            )
        count += int(here.sum())
    return count


def _without_outliers(y: Any, states: Any) -> Any:
    """Distances far beyond those of the motions, of which most runs must be, as of a bead on its way out: its sign tells it."""
    gaps = np.isin(states, list(_GAPS))
    motions = y[~gaps & np.isfinite(y)]
    if 2 * len(motions) <= len(y):
        return y
    low, high = motions.min(), motions.max()
    wider = 2 * max(high - low, 0.5 * max(abs(low), abs(high)))
    return np.where(gaps & ~((y >= low - wider) & (y <= high + wider)), np.nan, y)


def _joined(x: Any, y: Any, states: Any) -> Any:
    """The points of a line that joins neighbours of one regime alone."""
    cut = np.flatnonzero(np.isin(states[:-1], list(_GAPS)) | (states[:-1] != states[1:])) + 1
    return np.insert(x, cut, np.nan), np.insert(y, cut, np.nan)


def _text(value: Any) -> str:
    return f"{value:.6g}" if isinstance(value, float) else str(value)


def _curves(s: Any, y: str, sides: List[_Side], units: str, free: bool, name: Optional[str], ax: Any) -> Any:
    if len(sides) == 2 and free and len(sides[0].values) < len(sides[1].values):
        sides.reverse()
    values, label, words = _sweep_values(s, y, units)
    values = np.moveaxis(values, sides[0].along, 0).reshape(len(sides[0].values), -1)
    ax = _style.axes(ax, 6.0, 4.4)
    others = _plot_several.before(ax)
    if others and y == "regime":
        raise BadInput("y", "the regimes of several sweeps do not stand in one Axes: give each its own")
    across, order = sides[0].values, np.argsort(sides[0].values, kind="stable")
    across, values = across[order], values[order]
    title = f"{words} over the {sides[0].words}"
    title = title[0].upper() + title[1:]
    _style.dress(ax, title, "" if others else _about_sweep(s), sides[0].label, label)
    if y == "regime":  # a row for each regime that occurs
        there = np.unique(values[np.isfinite(values)])
        rows = np.searchsorted(there, values).astype(float)
        values = np.where(np.isfinite(values), rows, np.nan)
        ax.set_yticks(range(len(there)), [REGIMES[int(i)] for i in there])
    states = np.where(s.failed, "failed", np.where(s.computed, s.regime, ""))
    states = np.moveaxis(states, sides[0].along, 0).reshape(len(sides[0].values), -1)[order]
    for i in range(values.shape[1] if y == "mean_r" else 0):
        values[:, i] = _without_outliers(values[:, i], states[:, i])
    lines, marks, before = [], [], sum(len(one.lines) for one in others)
    if len(sides) == 1:
        lines += ax.plot(*_joined(across, values[:, 0], states[:, 0]), color="#b0b0b0", linewidth=0 if y == "regime" else 1.2, zorder=2)
        marks += _regime_marks(ax, across, values[:, 0], _regime_index(s)[order])
    for i in range(values.shape[1] if len(sides) == 2 else 0):
        lines += ax.plot(
            *_joined(across, values[:, i], states[:, i]), color=_style.colour(_CURVES[(before + i) % len(_CURVES)]), linewidth=1.5, marker="o",
            linestyle="none" if y == "regime" else "-", markersize=3 if len(across) <= 80 else 1.5,
            label=sides[1].text(i),
        )
    fixed = {"": y}
    fixed.update({axis.key: "" if axis.keyword in _dims_of(s) else _text(axis.at(s._points.flat[0])) for axis in s.axes})
    drawn = _plot_several.Drawn(lib.fst_grid_base(s._grid), fixed, lines, marks, name, len(sides) == 1)
    several = _plot_several.beside(ax, drawn)
    first = levels = sum(one.levels for one in others)
    for i in range(values.shape[1]):
        code = str(lines[i].get_color()) if several or len(sides) == 2 else ""
        hidden = np.isfinite(values[:, i]) & (len(sides) == 1 or y == "regime")
        levels += _gap_marks(ax, across, states[:, i], hidden, levels, code) > 0
    drawn.levels = levels - first
    if levels:  # no value lies over the signs
        low, high = ax.get_ylim()
        room = 0.02 + 0.04 * levels
        ax.set_ylim(low - room / (1 - room) * (high - low), high)
    sides[0].dress(ax.xaxis, ax.set_xscale)
    if levels or y != "regime" or len(sides) == 2:
        _style.key_below(ax, title=sides[1].label if len(sides) == 2 and not several else None)
    return ax


def _map(s: Any, y: str, sides: List[_Side], units: str, ax: Any) -> Any:
    right, up = sides
    values, label, words = _sweep_values(s, y, units)
    between = np.full(s.shape, np.nan) if s._between is None else s._between[s._points]
    both = np.stack([values, between])
    both = both if up.along == 0 else both.transpose(0, 2, 1)
    for side, along in ((up, 1), (right, 2)):
        order = np.unique(side.values, return_index=True)[1]
        both, side.values = np.take(both, order, axis=along), side.values[order]
    values, between = both
    ax = _style.axes(ax, 6.0, 5.0)
    title = f"{words} over {right.words} and {up.words}"
    _style.dress(ax, title[0].upper() + title[1:], _about_sweep(s), right.label, up.label)
    ax.grid(False)
    if y == "regime":
        _regime_cells(ax, right.edges(), up.edges(), values, between, "failed" if s.complete else "not run, or failed")
    elif not np.isfinite(values).any():
        raise BadInput("y", f"no run of this sweep has a value of {y}")
    else:
        cmap, norm = _style.colours_between(y, float(np.nanmin(values)), float(np.nanmax(values)))
        drawn = ax.pcolormesh(right.edges(), up.edges(), values, cmap=cmap, norm=norm, rasterized=True)
        _style.scale_beside(ax, drawn, label)
    right.dress(ax.xaxis, ax.set_xscale)
    up.dress(ax.yaxis, ax.set_yscale)
    return ax


def _regime_cells(ax: Any, x: Any, y: Any, values: Any, between: Any, lacking: str) -> None:
    """Cells in the colours of their regimes, also those without a run, between runs that agree."""
    from matplotlib.colors import ListedColormap
    from matplotlib.patches import Patch

    looks = [_style.look("regime", i) for i in range(len(REGIMES))]
    colours = ListedColormap([colour for _, colour in looks])
    colours.set_bad("white")
    values = np.where(np.isfinite(values), values, between)
    ax.pcolormesh(x, y, values, cmap=colours, vmin=-0.5, vmax=len(looks) - 0.5, rasterized=True)
    there = np.unique(values[np.isfinite(values)]).astype(int)
    handles = [Patch(color=looks[i][1], label=looks[i][0]) for i in there]
    if not np.isfinite(values).all():
        handles.append(Patch(facecolor="white", edgecolor="#888888", label=lacking))
    _style.key_below(ax, handles)
