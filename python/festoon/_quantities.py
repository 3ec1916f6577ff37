"""Values with units: what parameters are given as, and the units in which numbers leave."""

from decimal import Decimal
from typing import Any, Dict, SupportsFloat, Tuple, Union

import numpy as np

from ._errors import BadInput
from ._native import call, ffi, lib, places_of, text_of


class Unset:
    """What UNSET is."""

    def __reduce__(self) -> str:
        return "UNSET"

    def __repr__(self) -> str:
        return "UNSET"


#: As a keyword of `Bead` or `Bead.replace`: the parameter becomes what it is where nothing was said of it.
UNSET = Unset()

#: A number in SI (scaled where the parameter is), a text with a unit ("10.7 Hz"), or the name of a choice.
#: None: the parameter stays as it is; UNSET: as if it had never been given.
Value = Union[None, float, int, str, Unset]

UNITS = places_of(lib.pyf_units)


def value_text(value: Any, where: str) -> str:
    """A value as a scene would say it; a number with all its digits."""
    if getattr(value, "size", None) == 1:
        value = value.item()
    if isinstance(value, str) and "\0" not in value:
        return str(value)
    if isinstance(value, (str, bool)) or not isinstance(value, SupportsFloat) or hasattr(value, "size"):
        raise BadInput(where, f"{value!r} is neither a number nor a text with a unit")
    if isinstance(value, int):
        return str(value)
    return repr(float(value))


def quantity(value: Any, unit: int, where: str = "value") -> float:
    """A number, or a text with a unit of this kind, in SI."""
    text = value_text(value, where)
    if not isinstance(value, str):
        return float(text)
    number = ffi.new("double *")
    try:
        call(lib.fst_parse_value, value.encode(), unit, number)
    except BadInput as error:
        raise BadInput(where, error.sentence) from None
    return float(number[0])


def units_of(name: str) -> int:
    """The units of numbers that leave: "given", "lab", "scaled" or "si"."""
    if name not in UNITS:
        raise BadInput("units", f'unknown units "{name}"; there are {", ".join(UNITS)}')
    return int(UNITS[name])


class Scales:
    """Factors from scaled numbers to other units, of one bead, whose parameters or scales are given."""

    def __init__(self, params: Any, units: str) -> None:
        self._units = units_of(units)
        given = ffi.typeof(params) is ffi.typeof("fst_scales")
        self._scales = ffi.new("fst_scales *", params if given else lib.fst_scales_of(params))
        self._known: Dict[Tuple[str, str], Tuple[float, str]] = {}

    def factor(self, number: str, unit: str) -> Tuple[Any, str]:
        """The factor of a number of the tables and its unit there, and the name of the unit that it leads to."""
        unit = "gamma" if number == "omega" else unit  # which a run's table calls a pure number, and all others a rate
        if (number, unit) not in self._known:
            name = ffi.new("const char **")
            kept = unit.encode()
            factor = lib.fst_number_shown(number.encode(), kept, self._units, self._scales, name)
            self._known[number, unit] = (float(factor), text_of(name[0]))
        return self._known[number, unit]

    def of_parameter(self, key: str, values: Any) -> Tuple[Any, str]:
        """Values of a parameter, in SI or scaled as it is given, and their unit here, as the program exports them; but omega
        is in Hz or rad/s, as the result of this name.  The digits are shifted: 0.009 m are 9 mm and not 9.000000000000002."""
        row, power = lib.fst_param_at(lib.fst_param_find(key.encode())), ffi.new("int *")
        if row.kind != lib.FST_KIND_REAL:
            return values, "" if row.kind == lib.FST_KIND_CHOICE else "1"
        if key == "drive.omega":
            factor, unit = self.factor("omega", "gamma")
            if np.ndim(factor):  # the unit is varied too
                return values, "gamma"
            return (values if factor == 1.0 else values * factor), unit
        if self._units != UNITS["lab"]:
            return values, text_of(lib.fst_unit_name(row.unit))
        unit = text_of(lib.fst_unit_customary(row.unit, power))
        if power[0]:
            shifted = [float(Decimal(repr(float(value))).scaleb(power[0])) for value in np.ravel(values)]
            values = np.array(shifted).reshape(np.shape(values))
        return values, unit

    def column(self, index: int) -> Tuple[float, str]:
        """The same for a column of a trajectory."""
        name = ffi.new("const char **")
        factor = lib.fst_column_shown(lib.fst_column_at(index), self._units, self._scales, name)
        return float(factor), text_of(name[0])
