"""The magnet's field at many points."""

import math
from typing import Any, Tuple

import numpy as np

from ._errors import BadInput, Interrupted
from ._native import ffi, lib
from ._quantities import quantity
from .bead import Bead


#: So many points in a call: a few milliseconds with the slowest magnet.
PIECE = 2048


def _scaled(value: Any, units: str, length: float) -> Any:
    """Places in l: a text has its unit, a number that of `units`."""
    if isinstance(value, str):
        return np.float64(quantity(value, lib.FST_UNIT_LENGTH, "field") / length)
    numbers = np.asarray(value, float)
    return numbers / length if units == "si" else numbers


def field(bead: Bead, x: Any, y: Any, height: Any, units: str) -> Tuple[Any, Any]:
    """See Bead.field()."""
    if units not in ("scaled", "si"):
        raise BadInput("field", f'unknown units "{units}": scaled or si')
    groups = lib.fst_model_groups(bead._model)
    length, tesla = float(groups.length_unit), float(groups.field_unit)
    if units == "si" and math.isnan(tesla):
        raise BadInput("field", "B0 in tesla does not follow from the parameters: give magnet.b0 or bead.moment")
    if height is not None:
        bead = bead.replace(model__h=float(_scaled(height, units, length)))
    xs, ys = np.broadcast_arrays(_scaled(x, units, length), _scaled(y, units, length))
    shape = xs.shape
    xs, ys = np.ascontiguousarray(xs).ravel(), np.ascontiguousarray(ys).ravel()
    b, grad = np.empty((*shape, 3)), np.empty((*shape, 3, 3))
    if xs.size:
        places = [ffi.from_buffer("double[]", values) for values in (xs, ys, b, grad)]
        try:
            for i in range(0, xs.size, PIECE):  # between pieces Python obeys Ctrl-C
                here = [values + width * i for values, width in zip(places, (1, 1, 3, 9))]
                lib.pyf_field(bead._model, min(PIECE, xs.size - i), *here)
        except KeyboardInterrupt:
            raise Interrupted() from None
    if units == "si":
        b *= tesla
        grad *= tesla / length
    return b, grad
