"""Results as pickles: structs of the library as bytes, which the same build reads back, and when two are equal."""

import json
import math
from typing import Any, Dict, Optional, Tuple

from ._errors import BadInput
from ._native import ffi

#: Of structs with pointers: the arrays behind them, and the fields with their lengths ("": a text; None: one struct).
ARRAYS: Dict[str, Dict[str, Optional[str]]] = {
    "fst_locked_list": {"states": "count", "families": "family_count"},
    "fst_branch": {"points": "point_count", "specials": "special_count", "ends": "end_count", "scene": None},
    "fst_fit": {"outliers": "outlier_count", "numbers": "number_count", "curve": "curve_count", "remarks": ""},
    "fst_points": {"rows": "count"},
}

Image = Tuple[str, bytes, Dict[str, bytes]]


def image_of(struct: Any) -> Image:
    """A struct, and the arrays to which it points, as bytes."""
    ctype = ffi.typeof(struct)
    name = (ctype.item if ctype.kind == "pointer" else ctype).cname.removeprefix("struct ")
    copy = ffi.new(f"{name} *", struct[0] if ctype.kind == "pointer" else struct)
    arrays: Dict[str, bytes] = {}
    for field, count in ARRAYS.get(name, {}).items():
        pointer = getattr(copy, field)
        if pointer:
            length = 1 if count is None else getattr(copy, count) if count else len(ffi.string(pointer)) + 1
            arrays[field] = bytes(ffi.buffer(pointer, length * ffi.sizeof(ffi.typeof(pointer).item)))
            setattr(copy, field, ffi.NULL)
    if name == "fst_fit":
        copy.params.magnet_map = ffi.NULL
    return name, bytes(ffi.buffer(copy)), arrays


def struct_of(image: Image) -> Any:
    """The struct of an image, from another process or of this one; it owns its arrays."""
    name, data, arrays = image
    if len(data) != ffi.sizeof(name):
        raise BadInput("pickle", "it was pickled by another version of festoon")
    made = ffi.new(f"{name} *")
    ffi.memmove(made, data, len(data))
    kept = [made]
    for field, content in arrays.items():
        item = ffi.typeof(getattr(made, field)).item
        kept.append(ffi.new(f"{item.cname}[]", len(content) // ffi.sizeof(item)))
        ffi.memmove(kept[-1], content, len(content))
        setattr(made, field, kept[-1])
    return ffi.gc(made, lambda _, kept=kept: None)


def same(one: Any, other: Any) -> bool:
    """Equality under which a number that is undefined (NaN) equals another one."""
    if isinstance(one, dict) and isinstance(other, dict):
        return one.keys() == other.keys() and all(same(value, other[key]) for key, value in one.items())
    if isinstance(one, (list, tuple)) and isinstance(other, (list, tuple)):
        return len(one) == len(other) and all(map(same, one, other))
    if isinstance(one, float) and isinstance(other, float):
        return one == other or (math.isnan(one) and math.isnan(other))
    return bool(one == other)


class Told:
    """A result is equal to another one that says the same of an equal bead."""

    def _facts(self) -> Any:
        """What it says, without a bead."""
        return self.to_dict()  # type: ignore[attr-defined]

    def __eq__(self, other: object) -> bool:
        if type(other) is not type(self):
            return NotImplemented
        mine, theirs = getattr(self, "bead", None), getattr(other, "bead", None)
        return bool(mine == theirs) and same(self._facts(), other._facts())  # type: ignore[attr-defined]

    def __hash__(self) -> int:
        return hash(json.dumps(self._facts(), sort_keys=True, default=repr))


class Printed(Told):
    """A result that holds what a command prints with --json."""

    _told: Dict[str, Any]

    def to_dict(self) -> Dict[str, Any]:
        """What the program prints with --json.

        Returns
        -------
        dict
            Keys and numbers as the program prints them; None where a number is undefined.

        Raises
        ------
        OutOfMemory
            Where there is no memory for it.
        """
        return dict(self._told)
