"""What a notebook shows of a bead and of a run: tables, and the path as a small SVG."""

import html
import math
from typing import Any, List, Optional, Sequence

import numpy as np

from ._errors import FestoonError
from ._tables import PARAMETERS, RESULTS

#: Groups that are not pure numbers: the units behind the scaled ones.
GROUP_UNITS = {"length_unit": " m", "time_unit": " s", "mass": " kg", "field_unit": " T"}
STYLE = "style='border-collapse: collapse; font-size: 90%'"


def number(value: Any) -> str:
    """A number for a person."""
    return f"{value:.6g}" if isinstance(value, float) else str(value)


def _row(cells: Sequence[str], title: str = "") -> str:
    hint = f" title='{html.escape(title, quote=True)}'" if title else ""
    inside = "".join(f"<td style='text-align: left; padding: 1px 8px'>{html.escape(cell)}</td>" for cell in cells)
    return f"<tr{hint}>{inside}</tr>"


def path_svg(x: Any, y: Any, size: int = 220, edge: Optional[float] = None) -> str:
    """A path as an SVG of its own, in the colour of the text around it; the cross is the axis."""
    reach = 1.05 * max(float(np.max(np.hypot(x, y))), 1e-9) if edge is None else edge
    half = size / 2
    points = " ".join(f"{half + half * a / reach:.1f},{half - half * b / reach:.1f}" for a, b in zip(x, y))
    cross = f"M{half - 4} {half}h8M{half} {half - 4}v8"
    return (
        f"<svg xmlns='http://www.w3.org/2000/svg' width='{size}' height='{size}' viewBox='0 0 {size} {size}' "
        f"role='img' aria-label='path of the bead, seen from above'>"
        f"<path d='{cross}' stroke='currentColor' opacity='0.5' fill='none'/>"
        f"<polyline points='{points}' fill='none' stroke='#2166ac' stroke-width='1.1'/></svg>"
    )


def _short_path(bead: Any) -> str:
    """The path over a few turns after a short time, or the sentence of what hinders it."""
    try:
        short = bead.replace(run__discard=0.0, run__periods=80.0, run__samples=32, run__rtol=1e-7)
        import warnings

        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            run = short.run(trajectory=True, sample_from=60.0)
    except FestoonError as error:
        return f"<p>{html.escape(str(error))}</p>"
    path = run.trajectory
    if not len(path):
        return f"<p>{html.escape(run.regime)}</p>"
    return path_svg(path.x, path.y) + "<br/><small>path of drive periods 60 to 80, from above</small>"


def bead_card(bead: Any) -> str:
    """Parameters, groups and the path of a bead."""
    given = bead._given()
    rows: List[str] = []
    for key, (kind, unit, doc) in PARAMETERS.items():
        value = bead._parameter(key)
        if value is None or (key.startswith("run.") and key not in given):
            continue
        shown = number(value) + ("" if kind == "str" or unit == "1" else f" {unit}")
        rows.append(_row([key, shown, "given" if key in given else ""], doc))
    for i, part in enumerate(bead.magnet__parts):
        words = ", ".join(f"{name} {value}" for name, value in part.items() if name != "kind")
        rows.append(_row([f"magnet.parts[{i}]", part["kind"], words]))
    groups = [
        _row([name.rstrip("_"), number(value) + GROUP_UNITS.get(name, "")])
        for name, value in bead.groups
        if not (isinstance(value, float) and math.isnan(value))
    ]
    cell = "style='vertical-align: top; text-align: left; padding-right: 24px'"
    return (
        f"<table><tr><td {cell}><b>parameters</b><table {STYLE}>{''.join(rows)}</table></td>"
        f"<td {cell}><b>what follows</b><table {STYLE}>{''.join(groups)}</table></td>"
        f"<td {cell}>{_short_path(bead)}</td></tr></table>"
    )


def trajectory_card(samples: Any) -> str:
    """A trajectory: how much of it there is, and its path, of at most some thousand corners."""
    if samples.dtype.names is None or samples.ndim != 1 or samples.bead is None:
        return f"<pre>{html.escape(repr(samples))}</pre>"
    few = samples[:: 1 + len(samples) // 4000]
    path = path_svg(few.x, few.y) if len(few) else ""
    return path + "".join(f"<p>{html.escape(line)}</p>" for line in samples._told())


def run_card(run: Any) -> str:
    """The numbers of a run, scaled and in units of a laboratory."""
    lab = run.lab
    rows = [_row(["", "scaled", "laboratory"])]
    for name, (unit, doc) in RESULTS.items():
        value = getattr(run, name)
        if not math.isnan(value):
            there = lab.unit(name)
            shown = "" if there == unit else f"{number(getattr(lab, name))} {there}"
            rows.append(_row([name, number(value) + ("" if unit == "1" else f" {unit}"), shown], doc))
    head = html.escape((run.regime or run.status) + (f", {run.symmetry}" if run.symmetry else ""))
    return f"<b>{head}</b><br/>{html.escape(run.reason)}<table {STYLE}>{''.join(rows)}</table>"
