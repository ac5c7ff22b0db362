"""Formulas of t as codes that one compiled function evaluates: nothing is compiled for a formula.

Values are those of `symgen.describe.formulas.evaluate.evaluate` to the last bit, nan where that raises: undefined
operands make a value undefined, unless a condition discards them.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from symgen.base.errors import InputError
from symgen.base.vocabulary.expressions import FUNCTIONS, Call, Expr, Name, Number, names_in_expression, table_of
from symgen.compile.loopcode.loop_instances import called
from symgen.compile.native.annotations import Array, Integers, Record
from symgen.describe.formulas.evaluate import evaluate_formula
from symgen.describe.table_functions import Table

#: Functions by numbers: of a table, of conditions, and of one operand or two.
_TABLE, _WHERE, _AND, _OR = range(1, 5)
_ADD, _SUB, _MUL, _DIV, _POW, _NEG, _ABS, _SIGN, _MIN, _MAX, _LT, _LE, _GT, _GE, _NOT, _ATAN2 = range(5, 21)
_SQRT, _EXP, _LOG, _SIN, _COS, _TAN, _ASIN, _ACOS, _ATAN, _SINH, _COSH, _TANH, _ASINH, _ACOSH, _ATANH = range(21, 36)
_CODES = {
    **{"where": _WHERE, "and": _AND, "or": _OR, "add": _ADD, "sub": _SUB, "mul": _MUL, "div": _DIV, "pow": _POW},
    **{"neg": _NEG, "abs": _ABS, "sign": _SIGN, "min": _MIN, "max": _MAX, "both": _MIN, "either": _MAX, "lt": _LT},
    **{"le": _LE, "gt": _GT, "ge": _GE, "not": _NOT, "atan2": _ATAN2, "sqrt": _SQRT, "exp": _EXP, "log": _LOG},
    **{"sin": _SIN, "cos": _COS, "tan": _TAN, "asin": _ASIN, "acos": _ACOS, "atan": _ATAN, "sinh": _SINH},
    **{"cosh": _COSH, "tanh": _TANH, "asinh": _ASINH, "acosh": _ACOSH, "atanh": _ATANH},
}
assert _CODES.keys() == FUNCTIONS.keys()
#: Most periods of a table from 0 that are told apart.
_PERIODS = 1e15


class Formula(Record):
    """A formula as codes.

    Attributes
    ----------
    result : int
        Place of its value.
    codes : Array of int64, shape (5 k,)
        Function, places of three operands and place of the value of each of k steps. The second operand of a table is
        its number.
    tables : Array of int64
        First number, and number of pieces, or less than 0 the number of points of straight lines, of each table.
    values : Array
        The time, then numbers, parts without the time and values of steps.
    points : Array
        Of each table period, first point and beginnings of pieces, then their coefficients; of straight lines points
        and values.
    """

    result: int
    codes: Integers
    tables: Integers
    values: Array
    points: Array


@dataclass(frozen=True)
class CodedFormula:
    """A formula as codes.

    Attributes
    ----------
    formula : Formula
        With its numbers.
    fixed : tuple of (int, Expr)
        Places of parts without the time, and these.
    tables : mapping of str to Table
        Tables that it may read.
    """

    formula: Formula
    fixed: tuple[tuple[int, Expr], ...]
    tables: Mapping[str, Table]

    def of(self, values: Mapping[str, float]) -> Formula:
        """Return the formula for values of its names, with memory of its own."""
        numbers = self.formula.values.copy()
        for place, part in self.fixed:
            numbers[place] = values[part.name] if isinstance(part, Name) else self._number(part, values)
        return self.formula._replace(values=numbers)

    def _number(self, part: Expr, values: Mapping[str, float]) -> float:
        try:
            return evaluate_formula(part, values, tables=self.tables)
        except InputError:
            return math.nan


def code_formula(e: Expr, tables: Mapping[str, Table]) -> CodedFormula:
    """Return a formula of t and parameters as codes.

    Parameters
    ----------
    e : Expr
        The formula.
    tables : mapping of str to Table
        Tables that it may read.
    """
    values, fixed, read, steps = [0.0], list[tuple[int, Expr]](), dict[str, int](), dict[tuple[int, ...], int]()

    def place_of(part: Expr) -> int:
        if isinstance(part, Name) and part.name == "t":
            return 0
        if isinstance(part, Number) or "t" not in set(names_in_expression(part)):
            if not isinstance(part, Number):
                fixed.append((len(values), part))
            values.append(part.value if isinstance(part, Number) else math.nan)
            return len(values) - 1
        assert isinstance(part, Call), "other names are no names of the time"
        operands, table = [place_of(a) for a in part.arguments], table_of(part.function)
        if table is not None:
            operands.append(read.setdefault(table, len(read)))
        step = _TABLE if table is not None else _CODES[part.function], *operands, *(0,) * (3 - len(operands))
        if step not in steps:
            steps[step] = len(values)
            values.append(math.nan)
        return steps[step]

    result = place_of(e)
    heads, points = list[int](), list[float]()
    for name in read:
        f = tables[name].interpolated
        heads += [len(points), len(f.pieces) or -len(f.x)]
        points += [f.period, f.x[0], *f.starts, *(c for piece in f.pieces for c in piece)] if f.pieces else [*f.x, *f.y]
    codes = [number for step, place in steps.items() for number in (*step, place)]
    integers = np.array(codes, dtype=np.int64), np.array(heads, dtype=np.int64)
    return CodedFormula(Formula(result, *integers, np.array(values), np.array(points)), tuple(fixed), tables)


@called
def apply_function(code: int, a: float, b: float) -> float:
    """Return a function of one operand or two."""
    if code <= _MUL:
        return a + b if code == _ADD else a - b if code == _SUB else a * b
    if code <= _POW:
        return a / b if code == _DIV else math.pow(a, b)
    if code <= _SIGN:
        sign = (1.0 if a > 0.0 else 0.0) - (1.0 if a < 0.0 else 0.0)
        return -a if code == _NEG else abs(a) if code == _ABS else sign
    if code <= _MAX:
        return min(a, b) if code == _MIN else max(a, b)
    if code <= _NOT:
        above = a > b if code == _GT else a >= b if code == _GE else a == 0.0
        return 1.0 if (a < b if code == _LT else a <= b if code == _LE else above) else 0.0
    if code <= _SQRT:
        return math.atan2(a, b) if code == _ATAN2 else math.sqrt(a)
    if code <= _LOG:
        return math.exp(a) if code == _EXP else math.log(a)
    if code <= _TAN:
        return math.sin(a) if code == _SIN else math.cos(a) if code == _COS else math.tan(a)
    if code <= _ATAN:
        return math.asin(a) if code == _ASIN else math.acos(a) if code == _ACOS else math.atan(a)
    if code <= _TANH:
        return math.sinh(a) if code == _SINH else math.cosh(a) if code == _COSH else math.tanh(a)
    return math.asinh(a) if code == _ASINH else math.acosh(a) if code == _ACOSH else math.atanh(a)


@called
def value_of_points(points: Array, at: int, count: int, x: float) -> float:
    """Return the value of a table, as `symgen.base.ir.interpolation.Interpolation.value` has it."""
    if count < 0:
        n = -count
        if x <= points[at] or x >= points[at + n - 1]:
            return float(points[at + n] if x <= points[at] else points[at + 2 * n - 1])
        i = points_to(points, at, at + n, x)
        x0, x1, y0, y1 = points[i - 1], points[i], points[i + n - 1], points[i + n]
        return float(y0 + (y1 - y0) * (x - x0) / (x1 - x0))
    period, starts = points[at], at + 2
    if period > 0.0:
        periods = (x - points[at + 1]) / period
        if not abs(periods) < _PERIODS:
            return math.nan
        x -= period * math.floor(periods)
    i = points_to(points, starts + 1, starts + count, x) - 1
    u, c = x - points[i], starts + count + 4 * (i - starts)
    return float(points[c] + u * (points[c + 1] + u * (points[c + 2] + u * points[c + 3])))


def points_to(points: Array, low: int, high: int, x: float) -> int:
    """Return the place of the first of ascending numbers from `low` on that is greater than x, else `high`."""
    while low < high:
        middle = (low + high) // 2
        if x < points[middle]:
            high = middle
        else:
            low = middle + 1
    return low


@called
def joined_conditions(deciding: float, a: float, b: float) -> float:
    """Return "or" (`deciding` 1) or "and" (0) of two conditions; a deciding one overrides an undefined one."""
    for x in (a, b):
        if not math.isnan(x) and (1.0 if x != 0.0 else 0.0) == deciding:
            return deciding
    return math.nan if math.isnan(a) or math.isnan(b) else 1.0 - deciding


def coded_at(f: Record, state: Formula, j: int, t: float) -> float:
    """Return the value of a coded formula: `formula_at` of `symgen.run.loops.times_of_jumps`."""
    return coded_value_at(state, t)


@called
def coded_value_at(formula: Formula, t: float) -> float:
    """Return the value of a formula at a time, nan where it is undefined."""
    codes, values = formula.codes, formula.values
    values[0] = t
    for i in range(0, codes.shape[0], 5):
        code, a, b = codes[i], values[codes[i + 1]], values[codes[i + 2]]
        if code == _WHERE:
            x = math.nan if math.isnan(a) else b if a != 0.0 else values[codes[i + 3]]
        elif code == _AND or code == _OR:
            x = joined_conditions(1.0 if code == _OR else 0.0, a, b)
        elif math.isnan(a) or (math.isnan(b) and codes[i + 2] > 0 and code != _TABLE):
            x = math.nan
        elif code == _TABLE:
            head = 2 * codes[i + 2]
            x = value_of_points(formula.points, formula.tables[head], formula.tables[head + 1], a)
        else:
            x = apply_function(code, a, b)
        values[codes[i + 4]] = x if math.isfinite(x) else math.nan
    return float(values[formula.result])
