"""The expression tree of a formula in a mechanism file, built by the whitelisting parser.

Four node kinds only. Operators are calls too, so a consumer (SymPy translation, numeric evaluation, printing) is one
table from function name to action.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import TYPE_CHECKING

import msgspec

from symgen.base.vocabulary.elementary_functions import ELEMENTARY

if TYPE_CHECKING:
    from symgen.base.vocabulary.measures import Source


class Number(msgspec.Struct, frozen=True, tag="number"):
    """A literal; folded into the emitted code as a constant."""

    value: float


class Name(msgspec.Struct, frozen=True, tag="name"):
    """A reference: ``t``, a parameter, ``body.x``-like coordinate or velocity, or a placeholder of a measure."""

    name: str


class Call(msgspec.Struct, frozen=True, tag="call"):
    """A function or operator applied to arguments.

    `function` is a key of `FUNCTIONS`, ``table:NAME`` or, where the table is smooth, ``table:~NAME``.
    """

    function: str
    arguments: tuple[Expr, ...]


class Reading(msgspec.Struct, frozen=True, tag="reading"):
    """A quantity read during a motion: a point's coordinate, a joint's angle, or a rate of these.

    `name` is how a formula writes it (``arm.tip.vy``, ``motor.angle``); `order` is 0 for the value, 1 for the rate and
    2 for the second derivative with respect to time. Outputs also read what forces and drivers exert, of order 0.
    """

    name: str
    source: Source
    order: int = 0


Expr = Number | Name | Call | Reading


#: Prefix of the name of a table whose slope has a slope.
SMOOTH = "~"


def table_of(function: str) -> str | None:
    """Return the name of a table function's table, None for other functions."""
    return function.removeprefix("table:").removeprefix(SMOOTH) if function.startswith("table:") else None


def _choose_value(condition: float, yes: float, no: float) -> float:
    return yes if condition else no


#: Name of each function -> (number of arguments, numeric evaluation). Comparisons give 1.0 or 0.0.
FUNCTIONS: Mapping[str, tuple[int, Callable[..., float]]] = {
    "add": (2, lambda a, b: a + b),
    "sub": (2, lambda a, b: a - b),
    "mul": (2, lambda a, b: a * b),
    "div": (2, lambda a, b: a / b),
    "pow": (2, lambda a, b: a**b),
    "neg": (1, lambda a: -a),
    **{name: (1, function.evaluate) for name, function in ELEMENTARY.items()},
    "atan2": (2, math.atan2),
    "abs": (1, abs),
    "sign": (1, lambda a: float((a > 0) - (a < 0))),
    "min": (2, min),
    "max": (2, max),
    "lt": (2, lambda a, b: float(a < b)),
    "le": (2, lambda a, b: float(a <= b)),
    "gt": (2, lambda a, b: float(a > b)),
    "ge": (2, lambda a, b: float(a >= b)),
    "and": (2, lambda a, b: float(bool(a) and bool(b))),
    "or": (2, lambda a, b: float(bool(a) or bool(b))),
    "not": (1, lambda a: float(not a)),
    "where": (3, _choose_value),
    # above 0 where `and`, `or` hold of arguments above 0
    "both": (2, min),
    "either": (2, max),
}
#: End of the name of a state that is 1 while a rope is on a sheave, whose number in `over` follows, or that counts the
#: stations that a point has passed on a curve.
ON_SHEAVE = re.compile(r"\.(?:on[1-9][0-9]*|passed)$")
#: Functions with a kink where their argument is 0, or their two arguments are equal.
BENT = ("abs", "min", "max", "both", "either")
#: Functions that may jump.
JUMPING = ("lt", "le", "gt", "ge", "sign")


def names_in_expression(expression: Expr) -> Iterator[str]:
    """Yield every name that `expression` refers to, readings included, in order of appearance (with repeats)."""
    for node in _leaf_expressions(expression):
        if not isinstance(node, Number):
            yield node.name


def readings_in(expression: Expr) -> Iterator[Reading]:
    """Yield the readings in `expression`, in order of appearance (with repeats)."""
    for node in _leaf_expressions(expression):
        if isinstance(node, Reading):
            yield node


def _leaf_expressions(expression: Expr) -> Iterator[Number | Name | Reading]:
    stack: list[Expr] = [expression]
    while stack:
        node = stack.pop()
        if isinstance(node, Call):
            stack.extend(reversed(node.arguments))
        else:
            yield node


def moving_quantities(expression: Expr) -> tuple[Name | Reading, ...]:
    """Return the coordinates, velocities and readings in `expression`, each once, in order of appearance.

    States that say whether a rope is on a sheave are constants between events, and none of them.
    """
    leaves = (
        e
        for e in _leaf_expressions(expression)
        if isinstance(e, Reading) or (isinstance(e, Name) and "." in e.name and not ON_SHEAVE.search(e.name))
    )
    return tuple(dict.fromkeys(leaves))


def rename_quantities(expression: Expr, of: Mapping[Name | Reading, str]) -> Expr:
    """Return `expression` with other names in place of some names and readings."""
    if isinstance(expression, Call):
        return Call(expression.function, tuple(rename_quantities(a, of) for a in expression.arguments))
    return Name(of[expression]) if isinstance(expression, Name | Reading) and expression in of else expression


def literal_of(value: float) -> Number:
    """Return `value` as a literal."""
    return Number(float(value))


ZERO = literal_of(0.0)
ONE = literal_of(1.0)


def call(function: str, *arguments: Expr) -> Expr:
    """Return the call, folded to a literal where all arguments are literals and the value is finite."""
    if all(isinstance(a, Number) for a in arguments) and function in FUNCTIONS:
        try:
            value = FUNCTIONS[function][1](*(a.value for a in arguments if isinstance(a, Number)))
            if not isinstance(value, complex) and math.isfinite(value):
                return Number(float(value))
        except (ArithmeticError, ValueError):
            pass
    return Call(function, tuple(arguments))


def sum_of_terms(*terms: Expr) -> Expr:
    """Return the sum of terms, those that are the number 0 left out."""
    result: Expr = ZERO
    for term in terms:
        if term != ZERO:
            result = term if result == ZERO else call("add", result, term)
    return result


def difference(a: Expr, b: Expr) -> Expr:
    """Return a - b without terms that are the number 0; 0 of equal ones."""
    return ZERO if a == b else a if b == ZERO else call("neg", b) if a == ZERO else call("sub", a, b)


def product(*factors: Expr) -> Expr:
    """Return the product of factors, those that are the number 1 left out; 0 if one of them is the number 0."""
    if ZERO in factors:
        return ZERO
    result: Expr = ONE
    for factor in factors:
        if factor != ONE:
            result = factor if result == ONE else call("mul", result, factor)
    return result


def scalar_product_of(a: Sequence[Expr], b: Sequence[Expr]) -> Expr:
    """Return the scalar product of two vectors."""
    return sum_of_terms(*map(product, a, b))


def vector_product(a: Sequence[Expr], b: Sequence[Expr]) -> tuple[Expr, Expr, Expr]:
    """Return the vector product of two vectors in space."""
    x, y, z = (difference(product(a[i - 2], b[i - 1]), product(a[i - 1], b[i - 2])) for i in range(3))
    return x, y, z
