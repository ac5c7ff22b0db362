"""Formulas evaluated for arrays of numbers.

Undefined values (a division by 0, the root of a negative number) are nan.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field
from functools import partial
from typing import Any

import numpy as np

from symgen.base.vocabulary.expressions import FUNCTIONS, Expr, Name, Number, Reading, table_of
from symgen.describe.table_functions import Table

#: Functions that array operators evaluate for all runs at once; the others are called for each run.
_OPERATORS = ("add", "sub", "mul", "div", "neg")


@dataclass(frozen=True)
class Columns:
    """The numbers of many runs (`symgen.describe.formulas.start.Numbers`), by the functions of a single run.

    Undefined values are nan; nan propagates unless a condition discards it. Values common to all runs are evaluated
    once.

    Attributes
    ----------
    values : mapping of str to float or Array
        A number or an array of shape (k,) for each name.
    tables : mapping of str to Table
        Tables that formulas may read.
    """

    values: Mapping[str, Any]
    tables: Mapping[str, Table] = field(default_factory=dict)

    def value(self, expression: Expr, where: str = "") -> Any:
        """Return the values of a formula."""
        if isinstance(expression, Number):
            return expression.value
        if isinstance(expression, Name | Reading):
            return self.values[expression.name]
        return self.apply_function(expression.function, *(self.value(a) for a in expression.arguments))

    def apply_function(self, function: str, *arguments: Any) -> Any:
        """Return the values of a function of its arguments."""
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

    def check_above(self, limit: Any, x: Any, where: str, expected: str, got: str) -> Any:
        """Return `x`, or nan where it is not above the limit."""
        return np.where(x > limit, x, np.nan) if _varies((limit, x)) else x if x > limit else np.nan


def _joined(deciding: bool, a: Any, b: Any) -> Any:
    """Return "or" (`deciding`) or "and" of two conditions; a deciding one overrides an undefined one."""
    values = np.asarray([*np.broadcast_arrays(a, b)], dtype=np.float64)
    undefined = np.isnan(values)
    certain = (~undefined & ((values != 0.0) == deciding)).any(axis=0)
    result = np.where(certain, float(deciding), np.where(undefined.any(axis=0), np.nan, float(not deciding)))
    return result if _varies((a, b)) else float(result)


def _varies(arguments: Iterable[Any]) -> bool:
    return any(isinstance(a, np.ndarray) for a in arguments)


def _number(function: Callable[..., Any], *arguments: float) -> float:
    """Return the value of a function of numbers, or nan if it is undefined."""
    if any(a != a for a in arguments):
        return math.nan
    try:
        value = function(*arguments)
    except (ArithmeticError, ValueError):
        return math.nan
    return value if isinstance(value, float) and math.isfinite(value) else math.nan
