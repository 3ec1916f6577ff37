"""Sweeps of several beads and of worlds: columns over a grid."""

from typing import Any, Dict, List, Optional, Tuple

import numpy as np

from ._errors import BadInput
from ._keys import keyword_of, row_of
from ._native import call, ffi, lent, lib, text_of
from ._pickled import Told
from ._quantities import Scales
from ._tabled import NUMBERS, Column, Shown, Table, about, numbers_of, scaled_columns
from .bead import Bead


class Axis:
    """A varied parameter: `values` in SI (of a choice, its names), and how far apart in points they are."""

    def __init__(self, grid: Any, number: int) -> None:
        self.key = text_of(lib.fst_grid_key(grid, number))
        self.keyword = keyword_of(self.key)
        self.random = lib.fst_grid_axis_spacing(grid, number) == lib.FST_SPACING_RANDOM
        self.stride = int(lib.fst_grid_axis_stride(grid, number))
        count = int(lib.fst_grid_axis_points(grid, number))
        values = np.array([lib.fst_grid_value(grid, number, i * self.stride) for i in range(count)])
        kind, names, _ = row_of(self.key)
        if kind == "str":
            self.values = lent(np.array(names.split(", "))[values.astype(int)])
        else:
            self.values = lent(values.astype(int) if kind == "int" else values)

    def at(self, points: Any, values: Any = None) -> Any:
        """The values, or those in another unit, at points of the grid."""
        values = self.values if values is None else values
        return lent(np.asarray(values[(points // self.stride) % len(values)]))

    def shown(self, scales: Scales) -> Tuple[Any, str]:
        """The values in other units, and the unit."""
        return scales.of_parameter(self.key, self.values)


def sizes_of(axes: List[Axis]) -> Dict[str, int]:
    """The dimensions of a grid and their lengths; random axes share one."""
    return {"draw" if axis.random else axis.keyword: len(axis.values) for axis in axes}


def scales_at(grid: Any, points: Any) -> Any:
    """The four scales of each of these points of a grid, which may vary them: a further dimension."""
    made = np.empty((*points.shape, 4))
    numbers = np.ascontiguousarray(points, np.int64)
    call(lib.pyf_grid_scales, grid, ffi.from_buffer("int64_t[]", numbers), points.size, ffi.from_buffer("fst_scales[]", made))
    return made


class ScalesOver(Scales):
    """Factors for the rows of a sweep, each with the units of its point: an array where these differ, else one number."""

    def __init__(self, scales: Any, units: Optional[str]) -> None:
        distinct, which = np.unique(scales.reshape(-1, 4).view(np.uint64), axis=0, return_inverse=True)
        self._which = which.reshape(scales.shape[:-1])
        self._each = [Scales(ffi.new("fst_scales *", list(map(float, row)))[0], units or "scaled") for row in distinct.view(float)]
        first = scales.reshape(-1, 4)[0] if scales.size else [1.0] * 4
        super().__init__(ffi.new("fst_scales *", list(map(float, first)))[0], units or "scaled")

    def factor(self, number: str, unit: str) -> Tuple[Any, str]:
        factor, name = super().factor(number, unit)
        each = [scales.factor(number, unit) for scales in self._each]
        if len({one for one, _ in each}) <= 1 or name == unit:
            return factor, name
        return np.array([one if its == name else np.nan for one, its in each])[self._which], name


def coords_of(axes: List[Axis], dims: Tuple[str, ...], points: Any, scales: Scales) -> Dict[str, Column]:
    """The varied parameters at points of a grid."""
    made = {}
    for axis in axes:
        values, unit = axis.shown(scales)
        along, at = dims, points
        if axis.keyword in dims:
            place = dims.index(axis.keyword)
            along, at = (axis.keyword,), np.moveaxis(points, place, 0).reshape(points.shape[place], -1)[:, 0]
        made[axis.keyword] = Column(along, axis.at(at, values), unit, row_of(axis.key)[2], axis.key)
    return made


class SweepTable(Shown, Told):
    """What a sweep of several beads, of one in a world or of places of levitation tells: columns over a grid.

    A column is an attribute and an item, an array of the grid's shape: numbers, NaN where undefined, or words.
    """

    def __init__(self, grid: Any, rows: List[Dict[str, Any]]) -> None:
        self.axes = [Axis(grid, i) for i in range(lib.fst_grid_axis_count(grid))]
        self._sizes = sizes_of(self.axes)
        self.dims = tuple(self._sizes)
        self._base = Bead._unmade(lib.fst_grid_base(grid)[0])
        self._rows = rows
        self._scales = scales_at(grid, np.arange(int(np.prod(self.shape))).reshape(self.shape))
        self._units = {name: text_of(lib.fst_sweep_key_unit(grid, name.encode())) for name in (rows[0] if rows else ())}

    @property
    def shape(self) -> Tuple[int, ...]:
        """The length of each dimension."""
        return tuple(self._sizes.values())

    @property
    def columns(self) -> List[str]:
        """The names of what it tells."""
        return list(self._rows[0])

    def __getitem__(self, name: str) -> Any:
        if name not in self._rows[0]:
            raise BadInput("sweep", f'no column "{name}"; there are {", ".join(self.columns)}')
        told: Dict[int, Any] = {row["point"]: row[name] for row in self._rows}
        count = int(np.prod(self.shape))
        if any(isinstance(value, str) for value in told.values()):
            values: Any = np.array([told.get(i) or "" for i in range(count)])
        else:
            unknown = np.nan * np.ones_like(next((v for v in told.values() if v is not None), np.nan), float)
            values = np.array([unknown if told.get(i) is None else told[i] for i in range(count)], float)
        return lent(values.reshape(self.shape + values.shape[1:]))

    def __getattr__(self, name: str) -> Any:
        if name.startswith("_") or name not in self._rows[0]:
            raise AttributeError(name)
        return self[name]

    def __dir__(self) -> List[str]:
        return [*super().__dir__(), *self.columns]

    def to_dict(self) -> Dict[str, Any]:
        """The columns by their names.

        Returns
        -------
        dict
            Lists in the order of the points that have rows, as `festoon export --json` writes them.

        Raises
        ------
        OutOfMemory
            Where there is no memory for it.
        """
        return {name: [row[name] for row in self._rows] for name in self.columns}

    def _table(self, units: Optional[str]) -> Table:
        scales = ScalesOver(self._scales, units)
        coords = coords_of(self.axes, self.dims, np.arange(int(np.prod(self.shape))).reshape(self.shape), scales)
        values = {name: self[name] for name in self.columns if name not in (*coords, *(axis.key for axis in self.axes))}
        states = values.pop("final_state", None)
        known = {name: self._units[name] for name, column in values.items() if column.dtype.kind == "f"}
        known.update({name: "mm" for name in values if name.endswith("_mm")}, **{name: "deg" for name in values if name.endswith("_deg")})
        if states is not None:
            values.update(numbers_of(states, before="final_"))
            known.update({f"final_{name}": unit for name, unit in NUMBERS.items()})
        return Table(self.dims, coords, scaled_columns(self.dims, values, known, scales, {}), about(self._base.scene()))

    def __repr__(self) -> str:
        return f"SweepTable: {' x '.join(map(str, self.shape))} points over {', '.join(self.dims)}; columns {', '.join(self.columns)}"
