"""The expression tree: what a formula in a mechanism file becomes after the whitelisting parser.

Three node kinds only. Operators are calls too, so a consumer (SymPy translation, numeric evaluation, printing) is one
table from function name to action.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping

import msgspec

from symgen.vocabulary.functions import ELEMENTARY


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


Expr = Number | Name | Call


#: What precedes the name of a table whose slope has a slope.
SMOOTH = "~"


def table_of(function: str) -> str | None:
    """Return the name of the table that a function of a tree means, None where it means none."""
    return function.removeprefix("table:").removeprefix(SMOOTH) if function.startswith("table:") else None


def _where(condition: float, yes: float, no: float) -> float:
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
    "where": (3, _where),
}


def names(expression: Expr) -> Iterator[str]:
    """Yield every name that `expression` refers to, in order of appearance (with repeats)."""
    stack: list[Expr] = [expression]
    while stack:
        node = stack.pop()
        if isinstance(node, Name):
            yield node.name
        elif isinstance(node, Call):
            stack.extend(reversed(node.arguments))


def number(value: float) -> Number:
    """Return `value` as a literal."""
    return Number(float(value))


ZERO = number(0.0)
ONE = number(1.0)


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
