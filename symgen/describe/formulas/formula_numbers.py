"""Formulas with the operators of numbers, so that a calculation with numbers of a start gives a formula of them."""

from __future__ import annotations

from symgen.base.vocabulary.expressions import Expr, Number, call


class Symbol:
    """A formula with the operators of numbers."""

    def __init__(self, of: Expr) -> None:
        self.of = of

    def __add__(self, other: Symbol | float) -> Symbol:
        return Symbol(call("add", self.of, formula_of(other)))

    def __sub__(self, other: Symbol | float) -> Symbol:
        return Symbol(call("sub", self.of, formula_of(other)))

    def __mul__(self, other: Symbol | float) -> Symbol:
        return Symbol(call("mul", self.of, formula_of(other)))

    def __truediv__(self, other: Symbol | float) -> Symbol:
        return Symbol(call("div", self.of, formula_of(other)))

    def __neg__(self) -> Symbol:
        return Symbol(call("neg", self.of))

    def __radd__(self, other: Symbol | float) -> Symbol:
        return Symbol(formula_of(other)) + self

    def __rsub__(self, other: Symbol | float) -> Symbol:
        return Symbol(formula_of(other)) - self

    def __rmul__(self, other: Symbol | float) -> Symbol:
        return Symbol(formula_of(other)) * self


def formula_of(x: Symbol | float) -> Expr:
    """Return the formula of a result, which may be a number."""
    return x.of if isinstance(x, Symbol) else Number(float(x))


class Symbols:
    """Formulas as the numbers of a start (`symgen.describe.formulas.start.Numbers`)."""

    def value(self, expression: Expr, where: str) -> Symbol:
        """Return a formula."""
        return Symbol(expression)

    def apply_function(self, function: str, *arguments: Symbol | float) -> Symbol:
        """Return a function of formulas."""
        return Symbol(call(function, *map(formula_of, arguments)))

    def check_above(self, limit: object, x: Symbol, where: str, expected: str, got: str) -> Symbol:
        """Return `x`: a run checks its numbers."""
        return x
