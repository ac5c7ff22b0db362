"""An array whose columns have names and units."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from html import escape
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from symgen.base.arguments import kind_of_value, whole_number
from symgen.base.digits import digits, scale_of
from symgen.base.errors import InputError, fit_lines, quote, suggest

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Labelled:
    """Columns over time, read by name or as an array.

    ``table["crank.x"]`` is one column; ``table["crank"]`` holds all columns of the body or joint; ``np.asarray(table)``
    and ``table.values`` are the array.

    Attributes
    ----------
    values : Array, shape (k, n)
        One row an output.
    names, units : tuple of str, length n
        Labels of the columns.
    """

    values: Array
    names: tuple[str, ...]
    units: tuple[str, ...]

    def __post_init__(self) -> None:
        if self.values.ndim != 2 or not self.values.shape[1] == len(self.names) == len(self.units):
            raise ValueError(f"{len(self.names)} names and {len(self.units)} units for an array {self.values.shape}")

    def __getitem__(self, name: str) -> Array:
        """Return the column called `name`, shape (k,), or all columns of the body or joint `name`, shape (k, c).

        Raises
        ------
        InputError
            If there is no such name; says the nearest one.
        """
        if not isinstance(name, str):
            hint = "outputs are rows: table.values[-1] is the last one as an array, table.row(-1) by name"
            raise InputError("result", "the name of a column, a body or a joint", kind_of_value(name), hint)
        if name in self.names:
            return self.values[:, self.names.index(name)]
        group = [i for i, full in enumerate(self.names) if full.startswith(f"{name}.")]
        if not group:
            hint = suggest(name, self.names) if len(self.names) <= 40 or "." in name else ""
            raise InputError("result", "the name of a column, a body or a joint", quote(name), hint)
        return self.values[:, group]

    def unit(self, name: str) -> str:
        """Return the unit of the column `name`."""
        self[name]
        return self.units[self.names.index(name)] if name in self.names else ""

    def row(self, index: int = -1) -> dict[str, float]:
        """Return one row by name, the last one unless told; empty where there are no rows.

        Raises
        ------
        InputError
            If there is no such row.
        """
        count = len(self.values)
        if count == 0:
            return {}
        index = whole_number("row", index, -count, count - 1)
        return {name: float(x) for name, x in zip(self.names, self.values[index], strict=True)}

    def __array__(self, dtype: Any = None, copy: bool | None = None) -> NDArray[Any]:
        if copy is False:
            return np.asarray(self.values, dtype=dtype)
        return np.array(self.values, dtype=dtype)

    def __iter__(self) -> Iterator[str]:
        return iter(self.names)

    def __contains__(self, name: object) -> bool:
        return name in self.names

    def __len__(self) -> int:
        return len(self.names)

    def _repr_html_(self) -> str:
        ends = (column_texts(self, np.min), column_texts(self, np.max), column_texts(self))
        rows = [(name, self.units[i], *(texts.get(name, "") for texts in ends)) for i, name in enumerate(self.names)]
        return notebook_table(("", "unit", "smallest", "largest", "last"), rows, most=60)

    def __repr__(self) -> str:
        shown = ", ".join(self.names[:6]) + (", ..." if len(self.names) > 6 else "")
        return f"Labelled({self.values.shape[0]} outputs of {len(self.names)}: {shown})"


def columns_at(table: Labelled, places: Sequence[int]) -> Labelled:
    """Return the columns of a table at some places, in their order."""
    names, units = (tuple(of[i] for i in places) for of in (table.names, table.units))
    return Labelled(table.values[:, list(places)], names, units)


def column_texts(table: Labelled, of: Callable[[Array], float] = lambda column: float(column[-1])) -> dict[str, str]:
    """Return a number of each column as people read it, by the names; empty where there are no rows.

    Values that are rounding beside the largest number of all columns of their unit become 0.

    Parameters
    ----------
    table : Labelled
        The columns.
    of : callable
        The number of a column, the last one by default.
    """
    if not len(table.values):
        return {}
    scales = unit_scales(table)
    columns = zip(table.names, table.units, table.values.T, strict=True)
    return {name: digits(of(values), scales[unit]) for name, unit, values in columns}


def largest_magnitudes(values: Array) -> tuple[float, ...]:
    """Return the largest finite magnitude of an array, nothing where there is none."""
    largest = float(np.abs(values).max(initial=0.0))
    if math.isfinite(largest):
        return (largest,) if values.size else ()
    finite = values[np.isfinite(values)]
    return (float(np.abs(finite).max()),) if finite.size else ()


def unit_scales(table: Labelled) -> dict[str, float]:
    """Return the scale of the numbers of each unit: the largest of all columns, of moments forces times lengths."""
    units = np.array(table.units)
    scales = {unit: scale_of(largest_magnitudes(table.values[:, units == unit]), unit) for unit in set(table.units)}
    return scales | {unit: max(x, least_scale(scales, unit)) for unit, x in scales.items()}


def common_scales(tables: Iterable[Labelled]) -> dict[str, float]:
    """Return the scale of the numbers of each unit in tables of one motion, of moments also force times length."""
    scales = dict[str, float]()
    for table in tables:
        for unit, size in unit_scales(table).items():
            scales[unit] = max(size, scales.get(unit, 0.0))
    return scales | {unit: max(scales.get(unit, 0.0), least_scale(scales, unit)) for unit in PRODUCTS}


#: Units of products: what is nothing beside the product of the scales of its factors is rounding.
PRODUCTS = {"N m": ("N", "m"), "J": ("N", "m"), "W": ("N", "m/s")}


def least_scale(scales: Mapping[str, float], unit: str) -> float:
    """Return the scale of a unit from the scales of its factors; 0 where it is no product or a factor has none."""
    a, b = PRODUCTS.get(unit, (unit, ""))
    return scales.get(a, 0.0) * scales.get(b, 0.0)


def notebook_table(headings: Sequence[str], rows: Sequence[Sequence[str]], most: int = 200) -> str:
    """Return a table for notebooks, all of its texts escaped; of more than `most` rows the first ones."""

    def table_row(cells: Sequence[str], tag: str) -> str:
        return "<tr>" + "".join(f"<{tag} style='text-align:left'>{escape(cell)}</{tag}>" for cell in cells) + "</tr>"

    head = table_row(headings, "th") if headings else ""
    first = fit_lines(len(rows), most)
    left = [f"<tr><td>... {len(rows) - first} more</td></tr>"] if len(rows) > first else []
    return f"<table>{head}{''.join([table_row(cells, 'td') for cells in rows[:first]] + left)}</table>"


class NamedQuantity(Protocol):
    """Anything with a name and a unit."""

    @property
    def name(self) -> str: ...  # noqa: D102  # the class says what they are
    @property
    def unit(self) -> str: ...  # noqa: D102  # the class says what they are


def label_columns(values: Array, quantities: Iterable[NamedQuantity]) -> Labelled:
    """Return `values` with the names and units of `quantities`."""
    columns = tuple(quantities)
    return Labelled(values, tuple(q.name for q in columns), tuple(q.unit for q in columns))
