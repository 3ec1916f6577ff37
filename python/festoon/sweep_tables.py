"""Sweeps of several beads and of worlds: columns over a grid."""

from typing import Any, Dict, List, Tuple

import numpy as np

from ._errors import BadInput
from ._native import lent, lib, text_of
from ._pickled import Told
from .bead import keyword_of, row_of


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

    def at(self, points: Any) -> Any:
        """The values at points of the grid."""
        return lent(np.asarray(self.values[(points // self.stride) % len(self.values)]))


class SweepTable(Told):
    """What a sweep of several beads, of one in a world or of places of levitation tells: columns over a grid.

    A column is an attribute and an item, an array of the grid's shape: numbers, NaN where undefined, or words.
    """

    def __init__(self, grid: Any, rows: List[Dict[str, Any]]) -> None:
        self.axes = [Axis(grid, i) for i in range(lib.fst_grid_axis_count(grid))]
        self.dims = tuple(axis.keyword for axis in self.axes)
        self._rows = rows

    @property
    def shape(self) -> Tuple[int, ...]:
        """The length of each dimension."""
        return tuple(len(axis.values) for axis in self.axes)

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

    def to_pandas(self) -> Any:
        """A data frame, a row a point.

        Returns
        -------
        pandas.DataFrame
            The columns as `festoon export --json` writes them.

        Raises
        ------
        ImportError
            Where pandas is missing.
        """
        import pandas

        return pandas.DataFrame(self._rows)

    def __repr__(self) -> str:
        return f"SweepTable: {' x '.join(map(str, self.shape))} points over {', '.join(self.dims)}; columns {', '.join(self.columns)}"
