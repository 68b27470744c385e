"""Rows of a run as arrays."""

from __future__ import annotations

import difflib
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from .errors import extra

__all__ = ["Column", "History"]


@dataclass(frozen=True)
class Column:
    """A column of a history.

    Attributes
    ----------
    name : str
        Its name in ``history.csv``, such as ``RX1_N``.
    unit : str
        Its unit, such as ``N`` or ``rad/s``; ``1`` of a number without one.
    meaning : str
        What it is.
    """

    name: str
    unit: str
    meaning: str


class History(Mapping[str, np.ndarray]):
    """The rows of a run: a mapping from names of columns to arrays of shape ``(rows,)``.

    The values are views of :attr:`array` and cannot be written; ``history["RX1_N"].copy()`` can. The numbers are those that
    ``whirl run`` writes to ``history.csv``, to the bit.

    Attributes
    ----------
    array : numpy.ndarray
        Shape ``(rows, columns)``, float64, row after row. The first column is the time in s.
    columns : tuple of Column
        Name, unit and meaning of each column.
    """

    __slots__ = ("_places", "array", "columns")

    def __init__(self, array: np.ndarray, columns: Iterable[Column]):
        self.columns = tuple(columns)
        array = np.asarray(array, dtype=np.float64)
        if array.ndim != 2 or array.shape[1] != len(self.columns):
            raise ValueError(
                f"a history of {len(self.columns)} columns has values of the shape (rows, "
                f"{len(self.columns)}), not {array.shape}"
            )
        self.array = array.view()
        self.array.flags.writeable = False
        self._places = {own.name: place for place, own in enumerate(self.columns)}

    def __getitem__(self, name: str) -> np.ndarray:
        """The values of a column, shape ``(rows,)``."""
        return self.array[:, self._place(name)]

    def __iter__(self) -> Iterator[str]:
        return iter(self._places)

    def __len__(self) -> int:
        return len(self.columns)

    def __repr__(self) -> str:
        rows = len(self.array)
        span = f", t = {self.array[0, 0]:g} … {self.array[-1, 0]:g} s" if rows else ""
        return f"<whirl.History of {rows} rows, {len(self.columns)} columns{span}>"

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, History):
            return NotImplemented
        return self.columns == other.columns and np.array_equal(
            self.array, other.array, equal_nan=True
        )

    __hash__ = None  # type: ignore[assignment]

    def __reduce__(self):
        return History, (np.ascontiguousarray(self.array), self.columns)

    @property
    def time(self) -> np.ndarray:
        """Times of the rows in s, shape ``(rows,)``."""
        return self.array[:, 0]

    def column(self, name: str) -> Column:
        """Name, unit and meaning of a column."""
        return self.columns[self._place(name)]

    def unit(self, name: str) -> str:
        """The unit of a column."""
        return self.column(name).unit

    def to_xarray(self) -> Any:
        """The history as an :class:`xarray.Dataset` with the dimension ``t_s``.

        Every variable has its ``units`` and its meaning (``long_name``) as attributes.
        """
        xarray = extra("xarray", "xarray", "History.to_xarray()")
        first, *others = self.columns

        def about(own: Column) -> dict[str, str]:
            return {"units": own.unit, "long_name": own.meaning}

        return xarray.Dataset(
            {own.name: (first.name, self[own.name], about(own)) for own in others},
            coords={first.name: (first.name, self[first.name], about(first))},
        )

    def to_pandas(self) -> Any:
        """The history as a :class:`pandas.DataFrame` with the index ``t_s``.

        ``frame.attrs["units"]`` and ``frame.attrs["meanings"]`` have those of every column.
        """
        pandas = extra("pandas", "pandas", "History.to_pandas()")
        first, *others = self.columns
        frame = pandas.DataFrame(
            self.array[:, 1:],
            index=pandas.Index(self.time, name=first.name),
            columns=[own.name for own in others],
        )
        frame.attrs["units"] = {own.name: own.unit for own in self.columns}
        frame.attrs["meanings"] = {own.name: own.meaning for own in self.columns}
        return frame

    def _place(self, name: str) -> int:
        place = self._places.get(name)
        if place is None:
            raise KeyError(_absent("column", name, self._places))
        return place


def _absent(what: str, name: object, known) -> str:
    """What is said of a name that is not there."""
    near = difflib.get_close_matches(str(name), list(known), n=1)
    meant = f"; did you mean `{near[0]}`?" if near else f"; there are: {', '.join(known)}"
    return f"there is no {what} `{name}`{meant}"
