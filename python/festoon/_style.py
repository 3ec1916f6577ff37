"""What all plots share: words, units and colours, which are asked of the library, and the dress of an Axes."""

import re
import textwrap
from typing import Any, List, NamedTuple, Optional, Sequence, Tuple

from ._errors import Unavailable
from ._native import ffi, lib, text_of
from ._quantities import units_of
from ._tables import COLUMNS

#: Letters of a title in an inch of the figure.
TITLE = 9
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


def _quantity(raw: Any) -> Quantity:
    label = ffi.string(raw.label).decode()
    return Quantity(float(raw.factor), re.sub(r"_(\w)", r"$_{\\mathregular{\1}}$", label))


def scales_of(params: Any) -> Any:
    return ffi.new("fst_scales *", lib.fst_scales_of(params))


def of_parameter(key: str, units: str, scales: Any) -> Quantity:
    return _quantity(lib.fst_quantity_of_parameter(key.encode(), units_of(units), scales))


def of_result(key: str, unit: str, units: str, scales: Any) -> Quantity:
    # The name of a unit that stays as it is points into `kept`.
    kept = unit.encode()
    return _quantity(lib.fst_quantity_of_result(key.encode(), kept, units_of(units), scales))


def of_column(name: str, units: str, params: Any) -> Quantity:
    place = list(COLUMNS).index(name)
    return _quantity(lib.fst_quantity_of_column(lib.fst_column_at(place), units_of(units), params))


def units_over(keys: Sequence[str]) -> str:
    """The units of a figure over these parameters where nobody asked for any."""
    if any(key in ("magnet.half_length", "friction.gamma") for key in keys):
        return "given"
    lab = any(lib.fst_units_of_parameter(key.encode()) == lib.FST_SHOWN_LAB for key in keys)
    return "lab" if lab else "scaled"


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


def colours_between(name: str, low: float, high: float) -> Tuple[Any, Any]:
    """The palette and the range of a quantity that has values from `low` to `high`."""
    pyplot()
    from matplotlib.colors import Normalize

    both = low < 0 < high
    if name == "n_z":
        both, low, high = True, -1.0, 1.0
    elif both:
        high = max(-low, high)
        low = -high
    elif 0 <= low < 0.25 * high:
        low = 0.0
    if not high > low:
        span = max(1e-3 * abs(low), 1e-12)
        low, high = low - span, high + span
    return palette("diverging" if both else "line"), Normalize(low, high)


def look(what: str, index: int) -> Tuple[str, str]:
    """Words and colour of a "regime" or of a "special" point."""
    found = getattr(lib, f"fst_{what}_look")(index)
    return text_of(found.words), text_of(found.colour)


# ---------------------------------------------------------------------------------------- the Axes


def axes(ax: Any, width: float = 5.4, height: float = 4.2) -> Any:
    """The caller's Axes, or those of a new figure, of so many inches."""
    if ax is not None:
        return ax
    return pyplot().subplots(figsize=(width, height), layout="constrained")[1]


def dress(ax: Any, title: str, about: str = "", x: str = "", y: str = "") -> None:
    """Title, what is known of the bead in small letters below it, labels and a faint grid."""
    title = "\n".join(textwrap.wrap(title, int(TITLE * ax.figure.get_figwidth())))
    ax.set_title(title, fontsize=11, pad=19 if about else 6)
    if about:
        ax.annotate(
            about, (0.5, 1), xycoords="axes fraction", xytext=(0, 5), textcoords="offset points",
            ha="center", va="bottom", fontsize=8.5, color=SOFT,
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


def about_bead(bead: Any, omega: Optional[Tuple[float, float]] = None) -> str:
    """The drive and the law: "ω = 0.2151 (10.7 Hz), dynamics rigid"."""
    first, last = omega or (bead.omega, bead.omega)
    hertz = bead.gamma / 6.283185307179586
    if abs(last - first) > 1e-9 * abs(last):
        words = f"ω = {first:.4g} to {last:.4g} ({first * hertz:.4g} to {last * hertz:.4g} Hz)"
    else:
        words = f"ω = {last:.4g} ({last * hertz:.4g} Hz)"
    words += f", dynamics {bead.model__dynamics}"
    if bead.friction__law == "coulomb":
        words += f", dry friction μ = {bead.mu:.3g}"
    return words
