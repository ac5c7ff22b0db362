"""Numbers as people read them: what rounding leaves of a zero is 0. Saved data, JSON and CSV keep all digits."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from typing import Any

#: A number below this part of the largest one beside it is what rounding leaves.
NOTHING = 1e-12
#: The scale of a column of a matrix, at least, as a part of the largest number of the matrix.
BESIDE = 1e-2
#: What numbers of these units are measured by at least, however small all of them are.
OWN_SIZE = {"rad": 1.0, "deg": 1.0}


def scale_of(values: Iterable[float], unit: str = "") -> float:
    """Return the size that numbers of one kind are compared with: the largest finite one; of angles at least 1.

    Parameters
    ----------
    values : iterable of float
        A column, or all columns of one unit.
    unit : str
        Of them.
    """
    return max([OWN_SIZE.get(unit, 0.0), *(abs(float(x)) for x in values if math.isfinite(x))])


def cleaned(values: Any, scale: float) -> Any:
    """Return a number, or an array, with 0 for what lies below `NOTHING` of a scale."""
    return values * (abs(values) >= NOTHING * scale) + 0.0


def digits(x: float, scale: float, count: int = 6) -> str:
    """Return the text of a number to some digits, 0 where it is rounding beside a scale."""
    return f"{cleaned(x, scale):.{count}g}"


def complex_digits(x: complex, count: int = 6) -> tuple[str, str]:
    """Return the texts of the real part, and of the imaginary one with its sign; empty where that is 0."""
    real, imaginary = (cleaned(part, abs(x)) for part in (x.real, x.imag))
    return f"{real:.{count}g}", f"{imaginary:+.{count}g}" if imaginary else ""


def column(values: Sequence[float], unit: str = "", count: int = 6, least: float = 0.0) -> list[str]:
    """Return the texts of a column of one unit, whose scale is at least a given one."""
    scale = max(scale_of(values, unit), least)
    return [digits(x, scale, count) for x in values]


def table(rows: Sequence[Sequence[float]]) -> list[list[str]]:
    """Return the texts of a matrix by rows; a column that is nothing beside the others may be rounding throughout."""
    least = BESIDE * scale_of(x for row in rows for x in row)
    columns = [column(values, least=least) for values in zip(*rows, strict=True)]
    return [list(row) for row in zip(*columns, strict=True)]
