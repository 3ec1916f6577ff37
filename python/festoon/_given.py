"""What is given to calls: of the right class or refused; tables in memory, for the readers of files."""

import contextlib
import operator
import os
import tempfile
from typing import Any, Dict, Iterable, Iterator, List, Mapping, Optional, Sequence

import numpy as np

from ._errors import BadInput, FestoonError


def of_class(value: Any, name: str, where: str) -> Any:
    """The value, which must be of a class of this module."""
    if not any(kind.__name__ == name and kind.__module__.startswith("festoon.") for kind in type(value).__mro__):
        raise TypeError(f"{where} must be a festoon.{name}, not {type(value).__name__}")
    return value


def word_of(value: Any, where: str) -> bytes:
    """A text for the library."""
    if not isinstance(value, str):
        raise TypeError(f"{where} must be a text, not {type(value).__name__}")
    if "\0" in value:
        raise BadInput(where, f"{value!r} has a null character")
    return value.encode()


def whole_of(value: Any, where: str, most: int = 2**31 - 1) -> int:
    """A whole number from 0 on."""
    try:
        number = operator.index(value)
    except TypeError:
        raise TypeError(f"{where} must be a whole number, not {type(value).__name__}") from None
    if not 0 <= number <= most:
        raise BadInput(where, f"{value} is not a whole number from 0 to {most}")
    return number


def number_of(value: Any, where: str) -> float:
    """A number."""
    try:
        return float(value)
    except (TypeError, ValueError):
        raise TypeError(f"{where} must be a number, not {value!r}") from None


def numbers_in(values: Any, where: str) -> Any:
    """An array of numbers."""
    try:
        return np.ascontiguousarray(values, float)
    except (TypeError, ValueError):
        raise BadInput(where, f"{values!r} is no array of numbers") from None


def rows_in(values: Any, where: str, of_what: str) -> List[Mapping[str, Any]]:
    """A list of dictionaries."""
    rows = list(values) if isinstance(values, Iterable) and not isinstance(values, (str, Mapping)) else [values]
    if isinstance(values, Mapping) or not all(isinstance(row, Mapping) for row in rows):
        raise BadInput(where, f"it must be a list of dictionaries, {of_what}, not {values!r}")
    return rows


def is_path(data: Any) -> bool:
    """Whether it is the name of a file."""
    return isinstance(data, (str, bytes, os.PathLike))


def _columns(data: Any, plain: Sequence[str], where: str) -> Dict[str, Any]:
    """Columns by their names; an array without names has those of `plain`."""
    names = getattr(data, "columns", None)
    if names is None:
        names = data.keys() if hasattr(data, "keys") else getattr(getattr(data, "dtype", None), "names", None)
    if names is not None:
        return {str(name): np.asarray(data[name]) for name in names}
    rows = np.asarray(data)
    if rows.ndim != 2 or rows.shape[1] != len(plain) or rows.dtype.kind not in "iuf":
        what = f"numbers of the shape (rows, {len(plain)}): {', '.join(plain)}" if plain else "names of columns"
        raise BadInput(where, f"it must be a file, or a data frame, a dictionary or an array with {what}")
    return {name: rows[:, i] for i, name in enumerate(plain)}


def _cell(value: Any) -> str:
    if value is None or (isinstance(value, float) and np.isnan(value)):
        return ""
    text = repr(float(value)) if isinstance(value, float) else str(value)
    if any(mark in text for mark in ',"\n\r'):
        return '"' + text.replace('"', '""') + '"'
    return text


@contextlib.contextmanager
def as_file(data: Any, plain: Sequence[str], where: str, unit: Optional[str] = None) -> Iterator[str]:
    """A CSV file of the data, with every digit, as long as it is read; what is wrong in it lies in `where`.

    Columns t, x and y have the units s and `unit`, where their names have none.
    """
    units = {"t": "s", "x": unit, "y": unit} if unit else {}
    columns = _columns(data, plain, where)
    if len({len(values) for values in columns.values()}) > 1 or any(np.ndim(v) != 1 for v in columns.values()):
        raise BadInput(where, "its columns must be of one length, and one number to a row")
    heads = [f"{name} [{units[name]}]" if name in units else name for name in columns]
    with tempfile.TemporaryDirectory(prefix="festoon-", ignore_cleanup_errors=True) as folder:
        path = os.path.join(folder, "data.csv")
        with open(path, "w", encoding="utf-8", newline="\n") as file:
            for row in [heads, *zip(*(values.tolist() for values in columns.values()))]:
                file.write(",".join(map(_cell, row)) + "\n")
        try:
            yield path
        except FestoonError as error:
            raise type(error)(error.where.replace(path, where), error.sentence.replace(path, where)) from None
