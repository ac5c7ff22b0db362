"""Numbers for display: zeros with rounding errors are shown as 0. Saved data, JSON and CSV keep all digits."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from typing import Any

#: A number below this fraction of the largest in its column is a rounding error.
NOTHING = 1e-12
#: An entry of a matrix below this part of the largest ones of its row and of its column is what rounding left of a sum.
ROUNDING = 4e-15
#: Smallest scale of a column of a matrix, as a fraction of the largest number of the matrix.
BESIDE = 1e-2
#: Smallest scales of numbers of these units.
OWN_SIZE = {"rad": 1.0, "deg": 1.0, "1": 1.0}


def scale_of(values: Iterable[float], unit: str = "") -> float:
    """Return the scale of numbers of one kind: the largest finite magnitude; for angles and cosines at least 1.

    Parameters
    ----------
    values : iterable of float
        A column, or all columns of one unit.
    unit : str
        Their unit.
    """
    return max([OWN_SIZE.get(unit, 0.0), *(abs(float(x)) for x in values if math.isfinite(x))])


def clean(values: Any, scale: float) -> Any:
    """Return a number or an array with 0 for values below `NOTHING` of a scale."""
    return values * (abs(values) >= NOTHING * scale) + 0.0


def clear_matrix_rounding(matrix: Any) -> Any:
    """Return a matrix with 0 for entries that are rounding beside the largest ones of both their row and their column.

    Numbers are kept that a table shows as 0: rows and columns may have any units. A row or a column that is rounding
    throughout beside the matrix has no unit of its own.
    """
    sizes = abs(matrix)
    if not sizes.size:
        return matrix
    rows, columns, whole = sizes.max(axis=1, keepdims=True), sizes.max(axis=0, keepdims=True), sizes.max()
    rows, columns = (x + whole * (x < ROUNDING * whole) for x in (rows, columns))
    return matrix * ((sizes >= ROUNDING * rows) | (sizes >= ROUNDING * columns)) + 0.0


def digits(x: float, scale: float, count: int = 6) -> str:
    """Return the text of a number to some digits, 0 where it is rounding beside a scale."""
    return f"{clean(x, scale):.{count}g}"


def format_complex(x: complex, count: int = 6) -> tuple[str, str]:
    """Return the texts of the real part, and of the imaginary one with its sign; empty where that is 0."""
    real, imaginary = (clean(part, abs(x)) for part in (x.real, x.imag))
    return f"{real:.{count}g}", f"{imaginary:+.{count}g}" if imaginary else ""


def format_column(values: Sequence[float], unit: str = "", count: int = 6, least: float = 0.0) -> list[str]:
    """Return the texts of a column of one unit, whose scale has a lower bound."""
    scale = max(scale_of(values, unit), least)
    return [digits(x, scale, count) for x in values]


def format_rows(rows: Sequence[Sequence[float]]) -> list[list[str]]:
    """Return the texts of a matrix by rows; a column that is nothing beside the others may be rounding throughout."""
    least = BESIDE * scale_of(x for row in rows for x in row)
    columns = [format_column(values, least=least) for values in zip(*rows, strict=True)]
    return [list(row) for row in zip(*columns, strict=True)]
