"""What all plots share: words, units and colours, which are asked of the library, and the dress of an Axes."""

import re
import textwrap
from typing import Any, Dict, List, NamedTuple, Optional, Sequence, Tuple

import numpy as np

from ._errors import Unavailable
from ._native import ffi, lib, text_of
from ._quantities import UNITS, units_of
from ._tables import COLUMNS

#: Letters of a title in an inch of the figure, and of the line below it.
TITLE, ABOUT = 9, 13
GRID = "#e4e4e4"
SOFT = "#555555"


def pyplot() -> Any:
    """matplotlib.pyplot; without matplotlib the package is named."""
    try:
        import matplotlib.pyplot
    except ImportError:
        raise Unavailable(
            "plot",
            "plots are drawn by matplotlib, which this python3 lacks: sudo apt install python3-matplotlib",
        ) from None
    return matplotlib.pyplot


# ---------------------------------------------------------------------------------------- words and units


class Quantity(NamedTuple):
    """What an axis shows: values times `factor`, with a label like "mean radius ⟨r⟩ (mm)"."""

    factor: float
    label: str

    @property
    def words(self) -> str:
        """The label without its unit."""
        return self.label.rsplit(" (", 1)[0]


def lowered(label: Any) -> str:
    """A label of the library, in which an underscore lowers the letter behind it, for matplotlib."""
    return re.sub(r"_(\w)", r"$_{\\mathregular{\1}}$", text_of(label))


def _quantity(raw: Any) -> Quantity:
    return Quantity(float(raw.factor), lowered(raw.label))


def scales_of(params: Any) -> Any:
    return ffi.new("fst_scales *", lib.fst_scales_of(params))


def of_result(key: str, unit: str, units: str, scales: Any) -> Quantity:
    # The name of a unit that stays as it is points into `kept`.
    kept = unit.encode()
    return _quantity(lib.fst_quantity_of_result(key.encode(), kept, units_of(units), scales))


def of_column(name: str, units: str, params: Any) -> Quantity:
    place = list(COLUMNS).index(name)
    return _quantity(lib.fst_quantity_of_column(lib.fst_column_at(place), units_of(units), params))


def units_over(keys: Sequence[str]) -> str:
    """The units of a figure over these parameters where nobody asked for any."""
    kept = [ffi.new("char[]", key.encode()) for key in keys]
    found = lib.fst_units_over(kept, len(kept))
    return next(name for name, place in UNITS.items() if place == found)


def units_of_bead(params: Any) -> str:
    """Scaled where the drive is, those of a laboratory where it is a frequency."""
    return "lab" if params.drive_omega != params.drive_omega else "scaled"


# ---------------------------------------------------------------------------------------- colours


def colour(name: str) -> str:
    """The house's "black", "blue", "vermilion", "green", "purple", "grey", "sky" or "orange"."""
    return text_of(lib.fst_colour_code(getattr(lib, f"FST_COLOUR_{name.upper()}")))


def palette(name: str) -> Any:
    """The colours of a quantity, "diverging", "line" or "map", for matplotlib."""
    pyplot()
    from matplotlib.colors import LinearSegmentedColormap

    definition = text_of(lib.fst_palette_definition(getattr(lib, f"FST_PALETTE_{name.upper()}")))
    stops = [(float(place), code) for place, code in re.findall(r"([-0-9.]+) '(#\w+)'", definition)]
    low, high = stops[0][0], stops[-1][0]
    made = LinearSegmentedColormap.from_list(
        f"festoon-{name}", [((place - low) / (high - low), code) for place, code in stops]
    )
    made.set_bad("#ffffff")
    return made


#: The library's palettes.
_PALETTES = {getattr(lib, f"FST_PALETTE_{name.upper()}"): name for name in ("diverging", "line", "map")}


def colours_in(found: Any) -> Tuple[Any, Any]:
    """The palette and the range of an fst_colour_range."""
    pyplot()
    from matplotlib.colors import Normalize

    return palette(_PALETTES[found.palette]), Normalize(found.low, found.high)


def colours_between(name: str, low: float, high: float) -> Tuple[Any, Any]:
    """The palette and the range of a quantity that has values from `low` to `high`."""
    return colours_in(lib.fst_colours_between(name.encode(), low, high))


def look(what: str, index: int) -> Tuple[str, str]:
    """Words and colour of a "regime" or of a "special" point."""
    found = getattr(lib, f"fst_{what}_look")(index)
    return text_of(found.words), text_of(found.colour)


# ---------------------------------------------------------------------------------------- curves


def numbers(pointer: Any, count: int) -> Any:
    """So many numbers of the library, as an array of its own."""
    return np.frombuffer(ffi.buffer(pointer, 8 * count)).copy() if count else np.empty(0)


#: matplotlib's look of each style of a curve.
_STYLES: Dict[str, Dict[str, Any]] = {
    "LINE": {"linewidth": 1.8},
    "DASHED": {"linestyle": "--", "linewidth": 1.4},
    "POINTS": {"linestyle": "none", "marker": "o", "markersize": 4.5},
    "OPEN_POINTS": {"linestyle": "none", "marker": "o", "markersize": 4.5, "markerfacecolor": "none"},
    "DOTS": {"linestyle": "none", "marker": ".", "markersize": 2},
}
#: matplotlib's markers for gnuplot's numbers of them.
_SIGNS = {1: "+", 2: "x", 3: "*", 5: "s", 7: "o", 9: "^", 11: "v", 13: "D"}


def curve(ax: Any, curve: Any) -> None:
    """A curve of a chart of the library."""
    x, y = (numbers(values, curve.count) for values in (curve.x, curve.y))
    spread, x_spread = (numbers(values, curve.count) if values else None for values in (curve.spread, curve.x_spread))
    label: Optional[str] = text_of(curve.title) or None
    code = text_of(lib.fst_colour_code(curve.colour))
    if not (np.isfinite(x) & np.isfinite(y)).any():
        return
    if curve.style == lib.FST_CURVE_SIGNS:
        marker = _SIGNS[curve.sign]
        open_sign: Dict[str, Any] = (
            {"linewidths": 1.8} if marker in "x+*" else {"edgecolors": "white", "linewidths": 0.6}
        )
        ax.scatter(x, y, s=52, marker=marker, color=code, label=label, zorder=4, **open_sign)
        return
    if curve.style == lib.FST_CURVE_BAND:
        ax.fill_between(x, y - spread, y + spread, color=code, alpha=0.22, linewidth=0, label=label)
        return
    if spread is not None:
        inside = "white" if curve.style == lib.FST_CURVE_OPEN_ERRORS else None
        ax.errorbar(
            x, y, spread, x_spread, fmt="o", markersize=4.5, capsize=2.5, elinewidth=1.1, color=code,
            markerfacecolor=inside, label=label, zorder=3,
        )
        return
    style = next(look for name, look in _STYLES.items() if curve.style == getattr(lib, f"FST_CURVE_{name}"))
    ax.plot(x, y, color=code, label=label, **style)


# ---------------------------------------------------------------------------------------- the Axes


def axes(ax: Any, width: float = 5.4, height: float = 4.2) -> Any:
    """The caller's Axes, or those of a new figure, of so many inches."""
    if ax is not None:
        if not (hasattr(ax, "plot") and hasattr(ax, "figure")):
            raise TypeError(f"ax must be matplotlib's Axes, not {type(ax).__name__}")
        return ax
    return pyplot().subplots(figsize=(width, height), layout="constrained")[1]


def _broken(text: str, letters: int) -> str:
    """Lines of no more letters, broken behind commas."""
    lines: List[str] = []
    for part in text.split(", "):
        if lines and len(lines[-1]) + len(part) + 3 <= letters:
            lines[-1] += ", " + part
        else:
            lines.append(part)
    return ",\n".join(lines)


def dress(ax: Any, title: str, about: str = "", x: str = "", y: str = "") -> None:
    """Title, what is known of the bead in small letters below it, labels and a faint grid."""
    title = "\n".join(textwrap.wrap(title, int(TITLE * ax.figure.get_figwidth())))
    about = _broken(about, int(ABOUT * ax.figure.get_figwidth()))
    ax.set_title(title, fontsize=11, pad=8 + 11 * len(about.splitlines()) if about else 6)
    for text in [text for text in ax.texts if text.get_gid() == "festoon-about"]:
        text.remove()
    if about:
        ax.annotate(
            about, (0.5, 1), xycoords="axes fraction", xytext=(0, 5), textcoords="offset points",
            ha="center", va="bottom", fontsize=8.5, color=SOFT, gid="festoon-about",
        )
    ax.set_xlabel(x)
    ax.set_ylabel(y)
    ax.grid(True, color=GRID, linewidth=0.8)
    ax.set_axisbelow(True)


def key_below(
    ax: Any, handles: Optional[List[Any]] = None, *, columns: Optional[int] = None, title: Optional[str] = None
) -> None:
    """The key stands below the Axes, where it covers no data."""
    if handles is None:
        handles = ax.get_legend_handles_labels()[0]
    if not handles:
        return
    from matplotlib.transforms import ScaledTranslation

    longest = max(len(str(handle.get_label())) for handle in handles)
    wanted = columns or max(1, min(5, len(handles), 64 // (longest + 8)))
    ax.legend(
        handles=handles, title=title, title_fontsize=9, ncol=wanted, loc="upper center", bbox_to_anchor=(0.5, 0), frameon=False, fontsize=9,
        bbox_transform=ax.transAxes + ScaledTranslation(0, -40 / 72, ax.figure.dpi_scale_trans),
        borderaxespad=0, handlelength=1.8,
    )


def scale_beside(ax: Any, mappable: Any, label: str) -> Any:
    """The scale of colours, on the right."""
    beside = ax.inset_axes((1.03, 0, 0.045, 1))
    bar = ax.figure.colorbar(mappable, cax=beside, label=label)
    bar.outline.set_linewidth(0.6)
    return bar
