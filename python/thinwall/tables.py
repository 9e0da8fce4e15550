"""Tables: pandas data frames where pandas is installed, NumPy structured arrays where it is not.

Either has ``attrs``: the table's ``name`` and ``description``, and by column its ``units`` and ``descriptions``.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Mapping, Sequence

import numpy as np

Value = Any  # str, int, float, bool, or None where it is missing


@dataclass(frozen=True)
class Column:
    """What a column is.

    Attributes
    ----------
    name : str
    type : {"string", "integer", "number", "boolean"}
    unit : str
        ``"m/s"``, ``"deg"``, ``"1"``; empty for text.
    description : str
        One sentence.
    """

    name: str
    type: str
    unit: str
    description: str


class Rows(np.ndarray[Any, np.dtype[np.void]]):
    """A structured array with ``attrs``, as a data frame has them."""

    attrs: dict[str, Any]

    def __array_finalize__(self, origin: Any) -> None:
        self.attrs = dict(getattr(origin, "attrs", {}))

    def __reduce__(self) -> tuple[Any, ...]:
        how, what, state = super().__reduce__()  # type: ignore[misc]
        return how, what, (*state, self.attrs)

    def __setstate__(self, state: Any) -> None:
        *array, self.attrs = state
        super().__setstate__(tuple(array))  # type: ignore[arg-type]


def as_array(name: str, description: str, columns: Sequence[Column], values: Mapping[str, Sequence[Value]]) -> Rows:
    """The table as a structured array. A missing number is NaN; so is a missing integer, whose column then holds floats."""
    arrays = {column.name: _array(column.type, values[column.name]) for column in columns}
    rows = np.empty(
        len(next(iter(arrays.values()), [])), dtype=[(column.name, arrays[column.name].dtype) for column in columns]
    ).view(Rows)
    for key, array in arrays.items():
        rows[key] = array
    rows.attrs = _attrs(name, description, columns)
    return rows


def as_frame(name: str, description: str, columns: Sequence[Column], values: Mapping[str, Sequence[Value]]) -> Any:
    """The table as a data frame; a structured array where pandas is not installed. Missing integers and booleans are ``pandas.NA``."""
    try:
        import pandas  # type: ignore[import]
    except ImportError:
        return as_array(name, description, columns, values)
    series = {column.name: _series(pandas, column.type, values[column.name]) for column in columns}
    frame = pandas.DataFrame(series, columns=list(series))
    frame.attrs.update(_attrs(name, description, columns))
    return frame


def _attrs(name: str, description: str, columns: Sequence[Column]) -> dict[str, Any]:
    return {
        "name": name,
        "description": description,
        "units": {column.name: column.unit for column in columns},
        "descriptions": {column.name: column.description for column in columns},
    }


def _array(kind: str, values: Sequence[Value]) -> Any:
    if kind == "string":
        text = np.array(["" if value is None else value for value in values], dtype=str)
        return text if text.dtype.itemsize else text.astype("U1")
    if None not in values:
        return np.array(values, dtype={"integer": np.int64, "boolean": np.bool_}.get(kind, np.float64))
    if kind == "boolean":
        return np.array(values, dtype=object)
    return np.array([np.nan if value is None else value for value in values], dtype=np.float64)


def _series(pandas: Any, kind: str, values: Sequence[Value]) -> Any:
    if kind in ("integer", "boolean") and None in values:
        return pandas.array(values, dtype="Int64" if kind == "integer" else "boolean")
    if kind == "string":
        return pandas.Series(values, dtype=object)
    return _array(kind, values)
