"""Numbers as people read them: what rounding leaves of a zero is shown as 0. Saved data, JSON and CSV keep all digits."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from typing import Any

#: A number below this part of the largest one beside it is what rounding leaves.
NOTHING = 1e-12
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


def column(values: Sequence[float], unit: str = "", count: int = 6) -> list[str]:
    """Return the texts of a column of one unit."""
    scale = scale_of(values, unit)
    return [digits(x, scale, count) for x in values]
