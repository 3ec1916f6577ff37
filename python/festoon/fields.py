"""The magnet's field at many points, and the equations of motion at many states."""

import math
from typing import Any, Tuple

import numpy as np

from ._errors import BadInput, Interrupted
from ._given import numbers_in
from ._native import call, dtype_of, ffi, lib
from ._quantities import quantity
from .bead import Bead


#: So many points in a call: a few milliseconds with the slowest magnet.
PIECE = 2048


def _scaled(value: Any, units: str, length: float) -> Any:
    """Places in l: a text has its unit, a number that of `units`."""
    if isinstance(value, str):
        return np.float64(quantity(value, lib.FST_UNIT_LENGTH, "field") / length)
    numbers = numbers_in(value, "field").reshape(np.shape(value))
    return numbers / length if units == "si" else numbers


def places(x: Any, y: Any, units: str, length: float) -> Tuple[Any, Any, Tuple[int, ...]]:
    """Places in l, flat, and their shape."""
    if units not in ("scaled", "si"):
        raise BadInput("field", f'unknown units "{units}": scaled or si')
    xs, ys = np.broadcast_arrays(_scaled(x, units, length), _scaled(y, units, length))
    return np.ascontiguousarray(xs).ravel(), np.ascontiguousarray(ys).ravel(), xs.shape


def _in_pieces(function: Any, model: Any, count: int, arrays: Any) -> None:
    """A function of the library over arrays, given with their numbers to a point; between pieces Python obeys Ctrl-C."""
    places = [(ffi.from_buffer("double[]", values), width) for values, width in arrays]
    try:
        for i in range(0, count, PIECE):
            function(model, min(PIECE, count - i), *[values + width * i for values, width in places])
    except KeyboardInterrupt:
        raise Interrupted() from None


def _states(states: Any, where: str) -> Any:
    size = lib.FST_STATE_SIZE
    given = numbers_in(states, where)
    if given.ndim < 1 or given.shape[-1] != size:
        raise BadInput(where, f"a state has {size} numbers: an array of states has the shape (..., {size})")
    if not np.isfinite(given).all():
        raise BadInput(where, "a number of a state is not finite")
    return given


def of_states(bead: Bead, states: Any, name: str, shape: Tuple[int, ...]) -> Any:
    """See Bead.rhs() and Bead.jacobian()."""
    given = _states(states, name)
    made = np.empty(given.shape[:-1] + shape)
    if made.size:
        size = given.shape[-1]
        _in_pieces(getattr(lib, f"pyf_{name}"), bead._flat_model, given.size // size, [(given, size), (made, math.prod(shape))])
    return made


def observe(bead: Bead, states: Any) -> Any:
    """See Bead.observe()."""
    given = _states(states, "observe")
    made = np.zeros(given.shape[:-1], dtype_of("fst_observation"))
    if made.size:
        count = given.size // given.shape[-1]
        rows = ffi.from_buffer("fst_observation[]", made)
        lib.pyf_observe(bead._flat_model, count, ffi.from_buffer("double[]", given), rows)
    return made.view(np.recarray)


def field(bead: Any, x: Any, y: Any, height: Any, units: str) -> Tuple[Any, Any]:
    """See Bead.field(); `bead` may also be a smoothed map."""
    model = bead._model
    groups = lib.fst_model_groups(model)
    length, tesla = float(groups.length_unit), float(groups.field_unit)
    if units == "si" and math.isnan(tesla):
        raise BadInput("field", "B0 in tesla does not follow from the parameters: give magnet.b0 or bead.moment")
    if height is not None:
        made, wanted = ffi.new("fst_model **"), float(_scaled(height, units, length))
        if not (wanted > 0 or (wanted <= 0 and lib.fst_magnet_in_tesla(bead._params))):
            raise BadInput("field", f"the height {height} is not a positive one")
        call(lib.fst_field_model_new, bead._params, wanted, made)
        model = ffi.gc(made[0], lib.fst_model_free)
    xs, ys, shape = places(x, y, units, length)
    b, grad = np.empty((*shape, 3)), np.empty((*shape, 3, 3))
    if xs.size:
        _in_pieces(lib.pyf_field, model, xs.size, [(xs, 1), (ys, 1), (b, 3), (grad, 9)])
    if units == "si":
        b *= tesla
        grad *= tesla / length
    return b, grad
