"""The number an expression stands for, given numbers for its names: for starts, sizes and checks, not for run time."""

from __future__ import annotations

import bisect
import math
from collections.abc import Mapping

from symgen.describe.mechanism import SpatialBody, Table
from symgen.describe.orientation import EulerParameters, euler_parameters
from symgen.describe.printer import to_text
from symgen.errors import InputError, nearest
from symgen.vocabulary.expressions import FUNCTIONS, Call, Expr, Name, Number


def evaluate(
    expression: Expr, values: Mapping[str, float], where: str = "expression", tables: Mapping[str, Table] | None = None
) -> float:
    """Return the value of `expression`.

    Parameters
    ----------
    expression : Expr
        The tree.
    values : mapping of str to float
        A number for every name in it.
    where : str
        File and key, for the message.
    tables : mapping of str to Table, optional
        The tables it may call.

    Raises
    ------
    InputError
        If a name has no value or the result is not a finite number.
    """
    if isinstance(expression, Number):
        return expression.value
    if isinstance(expression, Name):
        if expression.name not in values:
            hint = nearest(expression.name, values)
            raise InputError(where, "a value for every name", f"none for '{expression.name}'", hint)
        return float(values[expression.name])
    if expression.function == "where":
        # Only the chosen branch: the other one may be undefined here, which is why a choice was written.
        condition, yes, no = expression.arguments
        return evaluate(yes if evaluate(condition, values, where, tables) else no, values, where, tables)
    arguments = [evaluate(argument, values, where, tables) for argument in expression.arguments]
    try:
        value = _apply(expression, arguments, tables or {})
    except ZeroDivisionError:
        raise _undefined(expression, arguments, where, "divides by zero") from None
    except OverflowError:
        raise _undefined(expression, arguments, where, "is too large") from None
    except ValueError:
        raise _undefined(expression, arguments, where, "is not defined") from None
    if isinstance(value, complex) or not math.isfinite(value):
        raise _undefined(expression, arguments, where, "is not a finite real number")
    return float(value)


def orientation(body: SpatialBody, values: Mapping[str, float], source: str) -> EulerParameters:
    """Return the Euler parameters that a body starts with.

    Parameters
    ----------
    body : SpatialBody
        The body.
    values : mapping of str to float
        Values of the parameters.
    source : str
        File or mechanism, for the message.

    Raises
    ------
    InputError
        If its description stands for no orientation.
    """
    where = f"{source}: bodies.{body.name}.orientation"
    return euler_parameters(body.orientation, lambda e: evaluate(e, values, where), where)


def interpolate(table: Table, x: float) -> float:
    """Return the table's value at `x`: linear between its points, constant beyond its ends."""
    if x <= table.x[0]:
        return table.y[0]
    if x >= table.x[-1]:
        return table.y[-1]
    i = bisect.bisect_right(table.x, x)
    x0, x1, y0, y1 = table.x[i - 1], table.x[i], table.y[i - 1], table.y[i]
    return y0 + (y1 - y0) * (x - x0) / (x1 - x0)


def _apply(expression: Call, arguments: list[float], tables: Mapping[str, Table]) -> float:
    if expression.function.startswith("table:"):
        return interpolate(tables[expression.function.removeprefix("table:")], arguments[0])
    return FUNCTIONS[expression.function][1](*arguments)


def _undefined(expression: Call, arguments: list[float], where: str, why: str) -> InputError:
    at = Call(expression.function, tuple(Number(a) for a in arguments))
    text, shown = to_text(expression), to_text(at)
    got = f"'{text}', which {why}" if text == shown else f"'{text}' = {shown}, which {why}"
    return InputError(where, "a finite number", got)
