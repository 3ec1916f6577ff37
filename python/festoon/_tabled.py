"""Results as data frames of pandas and data sets of xarray, and their columns in other units: one mixin for all."""

from typing import Any, Dict, List, Mapping, NamedTuple, Optional, Tuple

import numpy as np

from ._errors import BadInput
from ._native import ffi, lent, lib, text_of
from ._quantities import Scales
from ._tables import COLUMNS

#: The twelve numbers of a bead, in the order of the library, with their units; a bead on a plate has ten, without Z and vZ.
NUMBERS = {"X": "l", "Y": "l", "Z": "l", "vX": "l gamma", "vY": "l gamma", "vZ": "l gamma", "nX": "1", "nY": "1", "nZ": "1",
           "WX": "gamma", "WY": "gamma", "WZ": "gamma"}
OF_PLATE = [name for name in NUMBERS if name not in ("Z", "vZ")]
DOCS = {**{name: doc for name, (_, doc) in COLUMNS.items()}, "vZ": "vertical velocity",
        "Z": "height of the centre over the plate; without one, over the magnet's reference plane"}


class Column(NamedTuple):
    """Values over named dimensions.  Words and numbers of things have no unit."""

    dims: Tuple[str, ...]
    values: Any
    unit: str = ""
    doc: str = ""
    title: str = ""


class Table(NamedTuple):
    """Columns, of which those over `rows` make the rows of a data frame; further dimensions become columns of it."""

    rows: Tuple[str, ...]
    coords: Dict[str, Column]
    columns: Dict[str, Column]
    about: Dict[str, Any]

    def column(self, name: str) -> Column:
        """One of them."""
        found = self.columns.get(name) or self.coords.get(name)
        if found is None:
            raise BadInput("columns", f'no column "{name}"; there are {", ".join([*self.coords, *self.columns])}')
        return found


def about(scene: str = "", **more: Any) -> Dict[str, Any]:
    """What a table says of itself: the scene, and the version that computed it."""
    return {**({"scene": scene} if scene else {}), **more, "version": text_of(lib.fst_version())}


def scaled_columns(
    dims: Tuple[str, ...], values: Mapping[str, Any], units: Mapping[str, str], scales: Scales, docs: Mapping[str, str] = DOCS
) -> Dict[str, Column]:
    """Columns of scaled numbers in other units; without a unit values stay what they are."""
    made = {}
    for name, given in values.items():
        array, unit = np.asarray(given), units.get(name, "")
        if unit:
            factor, unit = scales.factor(name.removeprefix("final_"), unit)
            if np.ndim(factor):  # one for each row
                array = array * np.reshape(factor, np.shape(factor) + (1,) * (array.ndim - np.ndim(factor)))
            elif factor != 1.0:
                array = array * factor
        further = tuple(f"{name}_{i}" if i else f"number_of_{name}" for i in range(array.ndim - len(dims)))
        made[name] = Column((*dims, *further), array, unit, docs.get(name, ""))
    return made


def numbers_of(states: Any, names: Any = tuple(NUMBERS), before: str = "") -> Dict[str, Any]:
    """The numbers of states, by their names."""
    return {before + name: states[..., i] for i, name in enumerate(names)}


def frame_of(table: Table) -> Any:
    """The data frame of a table."""
    import pandas

    sizes: Dict[str, int] = {}
    for column in (*table.coords.values(), *table.columns.values()):
        sizes.update(zip(column.dims, np.shape(column.values)))
    shape = tuple(sizes[name] for name in table.rows)
    made: Dict[str, Any] = {}
    units: Dict[str, str] = {}
    for name, column in {**table.coords, **table.columns}.items():
        further = tuple(dim for dim in column.dims if dim not in table.rows)
        if name in table.coords and further or any(dim in table.coords and table.coords[dim].unit for dim in further):
            continue  # it names places of a dimension that has no rows, or is a curve over one
        known = np.asarray(column.values).reshape(
            tuple(sizes[dim] if dim in column.dims else 1 for dim in table.rows) + tuple(sizes[dim] for dim in further)
        )
        rest = known.shape[len(shape) :]
        values = np.broadcast_to(known, shape + rest).reshape(int(np.prod(shape)), int(np.prod(rest)))
        for i, place in enumerate(np.ndindex(*rest)):
            full = "_".join([name, *map(str, place)])
            made[full] = values[:, i].copy()
            units.update({full: column.unit} if column.unit else {})
    frame = pandas.DataFrame(made)
    frame.attrs = {**table.about, "units": units}
    return frame


def data_of(table: Table) -> Any:
    """The data set of a table."""
    import xarray

    def variable(name: str, column: Column) -> Any:
        attrs = {"units": column.unit, "long_name": column.title or name, "description": column.doc}
        return column.dims, np.array(column.values), {key: text for key, text in attrs.items() if text}

    coords = {name: variable(name, column) for name, column in table.coords.items()}
    return xarray.Dataset({name: variable(name, column) for name, column in table.columns.items()}, coords, table.about)


class Tabled:
    """A result with columns."""

    def _table(self, units: Optional[str]) -> Table:
        raise NotImplementedError

    def to_pandas(self, units: Optional[str] = None) -> Any:
        """A data frame of the columns.

        Parameters
        ----------
        units
            "scaled", "lab" or "si"; the default is the unit system of this result's own attributes.

        Returns
        -------
        pandas.DataFrame
            Its `attrs` have the units of the columns, and what is known of scene and version.

        Raises
        ------
        BadInput
            Where units are unknown, or cannot be had.
        """
        return frame_of(self._table(units))

    def to_xarray(self, units: Optional[str] = None) -> Any:
        """A data set of the columns, each with unit and description in its `attrs`.

        Parameters
        ----------
        units
            "scaled", "lab" or "si"; the default is the unit system of this result's own attributes.

        Returns
        -------
        xarray.Dataset
            Its `attrs` have what is known of scene and version.

        Raises
        ------
        BadInput
            Where units are unknown, or cannot be had.
        """
        return data_of(self._table(units))


class TableIn:
    """The columns of a result in other units, as attributes and as items; `unit(name)` has the unit of one."""

    def __init__(self, result: Any, units: str) -> None:
        self._result, self._units = result, units
        self._shown: Table = result._table(units)

    def __getitem__(self, name: str) -> Any:
        return lent(np.array(self._shown.column(name).values))

    def __getattr__(self, name: str) -> Any:
        shown = self.__dict__.get("_shown")
        if shown is None or (name not in shown.columns and name not in shown.coords):
            raise AttributeError(name)
        values = self[name]
        return values if values.ndim else values.item()

    def __dir__(self) -> List[str]:
        return [*super().__dir__(), *self._shown.coords, *self._shown.columns]

    def unit(self, name: str) -> str:
        """The unit of a column here."""
        return self._shown.column(name).unit

    def __reduce__(self) -> Any:
        return TableIn, (self._result, self._units)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, TableIn) and self._units == other._units and bool(self._result == other._result)

    def __hash__(self) -> int:
        return hash((self._result, self._units))


class Shown(Tabled):
    """A result whose columns are scaled, and can be had in other units."""

    @property
    def si(self) -> TableIn:
        """The columns in SI units."""
        return TableIn(self, "si")

    @property
    def lab(self) -> TableIn:
        """The columns in the units of a laboratory: mm, s, Hz, mT."""
        return TableIn(self, "lab")


def scales_of(params: Any, units: Optional[str]) -> Scales:
    """The scales of a scene; None: numbers stay scaled."""
    return Scales(params, units or "scaled")


def pointer_of(struct: Any) -> Any:
    """A pointer to a struct, whichever of both it is."""
    return struct if ffi.typeof(struct).kind == "pointer" else ffi.addressof(struct)
