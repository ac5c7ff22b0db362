"""Arithmetic on numbers of a function that is written, of which each has a name."""

from __future__ import annotations

from collections.abc import Callable

from symgen.compile.native import language as lang


class DirectedNumbers:
    """Operations on numbers as expressions, under the names that slopes of elementary functions use on a graph.

    Parameters
    ----------
    named : callable
        Expression -> a variable or constant with its value.
    """

    one = lang.Constant("float", 1.0)

    def __init__(self, named: Callable[[lang.Expression], lang.Expression]) -> None:
        self.named = named

    def constant(self, value: float) -> lang.Expression:
        """Return a number."""
        return lang.Constant("float", value)

    def add(self, a: lang.Expression, b: lang.Expression) -> lang.Expression:
        """Return a sum."""
        return lang.ScalarOperation("float", "add", (a, b))

    def sub(self, a: lang.Expression, b: lang.Expression) -> lang.Expression:
        """Return a difference."""
        return lang.ScalarOperation("float", "sub", (a, b))

    def mul(self, a: lang.Expression, b: lang.Expression) -> lang.Expression:
        """Return a product."""
        return lang.ScalarOperation("float", "mul", (a, b))

    def neg(self, a: lang.Expression) -> lang.Expression:
        """Return the opposite."""
        return lang.ScalarOperation("float", "neg", (a,))

    def div(self, a: lang.Expression, b: lang.Expression) -> lang.Expression:
        """Return a quotient, which has a name."""
        return self.named(lang.ScalarOperation("float", "div", (a, b)))

    def call(self, name: str, *values: lang.Expression) -> lang.Expression:
        """Return the value of a function, which has a name."""
        own = "pow" if name == "pow" else f"math.{name}"
        return self.named(lang.ScalarOperation("float", own, values))
