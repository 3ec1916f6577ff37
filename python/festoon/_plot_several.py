"""Several sweeps or branches in one Axes: each has a colour of the Axes' cycle, and a name."""

from typing import Any, Dict, List, Optional
from weakref import WeakKeyDictionary

from ._keys import keyword_of
from ._native import ffi, lib, text_of
from ._tables import PARAMETERS


class Drawn:
    """What stands in an Axes of one result: its curves, signs that have other colours, and what it is of."""

    def __init__(
        self, params: Any, fixed: Dict[str, str], lines: List[Any], marks: List[Any], label: Optional[str], as_one: bool
    ) -> None:
        self.lines, self.marks, self.label = lines, marks, label
        #: Rows of signs at the lower edge.
        self.levels = 0
        #: Whether all its curves get one colour and one name; else each has a name of its own.
        self.as_one, self.names = as_one, [str(line.get_label()) for line in lines]
        self.texts = dict(fixed)
        text = ffi.new("char[]", 4096)
        for key in PARAMETERS if params is not None else ():
            if key not in fixed and not key.startswith("run."):
                lib.fst_params_get(params, lib.fst_param_find(key.encode()), text, 4096)
                self.texts[key] = text_of(text)


#: By Axes, in order; one that was cleared has none of their lines any more.
_DRAWN: "WeakKeyDictionary[Any, List[Drawn]]" = WeakKeyDictionary()


def before(ax: Any) -> List[Drawn]:
    """What was drawn into an Axes; its limits are no longer those of the first result alone."""
    found = [one for one in _DRAWN.get(ax, []) if any(line in list(ax.lines) for line in one.lines)]
    if found:
        ax.relim()
        ax.autoscale()
    return found


def _next_colour(ax: Any) -> str:
    """The next one of the Axes' own cycle."""
    line = ax.plot([], [])[0]
    line.remove()
    return str(line.get_color())


def _name(one: Drawn, all_of_them: List[Drawn]) -> str:
    """What a result has of its own."""
    if one.label is not None:
        return one.label
    own = [key for key in one.texts if one.texts[key] and any(one.texts[key] != other.texts.get(key) for other in all_of_them)]
    return ", ".join(f"{keyword_of(key)} {one.texts[key]}".strip() for key in own) or f"{all_of_them.index(one) + 1}"


def beside(ax: Any, drawn: Drawn) -> bool:
    """Take a result into an Axes; True: there are others, and each has its colour and its name now."""
    found = [*before(ax), drawn]
    _DRAWN[ax] = found
    if len(found) < 2:
        return False
    for one in found:
        for mark in one.marks:
            mark.remove()
        if one.as_one and one.names[0]:
            colour, one.names = _next_colour(ax), ["", *("_" for _ in one.lines[1:])]
            for line in one.lines:
                line.set_color(colour)
            if one.marks:
                one.lines[0].set(marker="o", markersize=3)
        one.marks = []
        for line, name in zip(one.lines, one.names):
            line.set_label(name if name == "_" else ", ".join(part for part in (name, _name(one, found)) if part))
    return True
