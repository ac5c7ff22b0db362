"""Formulas of many numbers at once, as arrays.

What is undefined for some values (a division by 0, the root of a negative number) is nan there.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field
from functools import partial
from typing import Any

import numpy as np

from symgen.describe.tables import Table
from symgen.vocabulary.expressions import FUNCTIONS, Expr, Name, Number, Reading, table_of

#: Functions that operators of arrays work out for all runs at once; the others are called for each.
_OPERATORS = ("add", "sub", "mul", "div", "neg")


@dataclass(frozen=True)
class Columns:
    """The numbers of many runs (`symgen.describe.start.Numbers`), by the functions that one run's are worked out by.

    What is undefined is nan, and stays so whatever is done with it, unless a choice leaves it aside. What is the same
    for all runs is worked out once.

    Attributes
    ----------
    values : mapping of str to float or Array
        For every name a number, or an array of shape (k,).
    tables : mapping of str to Table
        That formulas may read.
    """

    values: Mapping[str, Any]
    tables: Mapping[str, Table] = field(default_factory=dict)

    def value(self, expression: Expr, where: str = "") -> Any:
        """Return a formula's values."""
        if isinstance(expression, Number):
            return expression.value
        if isinstance(expression, Name | Reading):
            return self.values[expression.name]
        return self.apply(expression.function, *(self.value(a) for a in expression.arguments))

    def apply(self, function: str, *arguments: Any) -> Any:
        """Return a function of formulas."""
        if function == "where":
            condition, yes, no = arguments
            if not _varies(arguments):
                return condition if condition != condition else yes if condition else no
            return np.where(np.isnan(condition), np.nan, np.where(condition != 0.0, yes, no))
        if function in ("and", "or"):
            return _joined(function == "or", *arguments)
        table = table_of(function)
        work_out: Any = FUNCTIONS[function][1] if table is None else self.tables[table].interpolated.value
        if not _varies(arguments):
            return _number(work_out, *arguments)
        if function not in _OPERATORS:
            work_out = np.frompyfunc(partial(_number, work_out), len(arguments), 1)
        with np.errstate(all="ignore"):
            values = np.asarray(work_out(*arguments), dtype=np.float64)
        return np.where(np.isfinite(values), values, np.nan)

    def above(self, limit: Any, x: Any, where: str, expected: str, got: str) -> Any:
        """Return `x`, nan where it is not above a limit."""
        return np.where(x > limit, x, np.nan) if _varies((limit, x)) else x if x > limit else np.nan


def _joined(deciding: bool, a: Any, b: Any) -> Any:
    """Return whether one of two conditions holds (`deciding`), or both; undefined ones yield to those that decide."""
    values = np.asarray([*np.broadcast_arrays(a, b)], dtype=np.float64)
    undefined = np.isnan(values)
    decided = (~undefined & ((values != 0.0) == deciding)).any(axis=0)
    result = np.where(decided, float(deciding), np.where(undefined.any(axis=0), np.nan, float(not deciding)))
    return result if _varies((a, b)) else float(result)


def _varies(arguments: Iterable[Any]) -> bool:
    return any(isinstance(a, np.ndarray) for a in arguments)


def _number(function: Callable[..., Any], *arguments: float) -> float:
    """Return a function of numbers, nan where it is undefined."""
    if any(a != a for a in arguments):
        return math.nan
    try:
        value = function(*arguments)
    except (ArithmeticError, ValueError):
        return math.nan
    return value if isinstance(value, float) and math.isfinite(value) else math.nan
