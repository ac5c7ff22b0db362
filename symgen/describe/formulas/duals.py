"""Formulas with directions: numbers that carry their derivatives by chosen parameters, for starts and parameters.

They are `symgen.describe.formulas.start.Numbers`, so the described start is written once. Rules are those of emitted
code: the slopes in `symgen.base.vocabulary.elementary_functions`, and one side at a kink.
"""

from __future__ import annotations

import math
from collections.abc import Container, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from symgen.base.errors import InputError
from symgen.base.vocabulary.elementary_functions import ELEMENTARY
from symgen.base.vocabulary.expressions import FUNCTIONS, Call, Expr, Name, Number, Reading, table_of
from symgen.describe.formulas.evaluate import dependent_parameters, evaluate_formula
from symgen.describe.mechanism import Mechanism

#: Derivatives, one for each direction.
Slopes = tuple[float, ...]


class Dual:
    """A number with its derivatives.

    Parameters
    ----------
    value : float
        The number.
    slopes : tuple of float
        Its derivatives; empty for a number that depends on nothing.
    """

    __slots__ = ("slopes", "value")

    def __init__(self, value: float, slopes: Slopes = ()) -> None:
        self.value, self.slopes = value, slopes

    def __float__(self) -> float:
        return self.value

    def __add__(self, other: Any) -> Dual:
        b = as_dual(other)
        return Dual(self.value + b.value, combine_derivatives(1.0, self, 1.0, b))

    def __sub__(self, other: Any) -> Dual:
        b = as_dual(other)
        return Dual(self.value - b.value, combine_derivatives(1.0, self, -1.0, b))

    def __mul__(self, other: Any) -> Dual:
        b = as_dual(other)
        return Dual(self.value * b.value, combine_derivatives(b.value, self, self.value, b))

    def __truediv__(self, other: Any) -> Dual:
        b = as_dual(other)
        value = self.value / b.value
        return Dual(value, combine_derivatives(1.0 / b.value, self, -value / b.value, b))

    def __neg__(self) -> Dual:
        return Dual(-self.value, tuple(-x for x in self.slopes))

    def __radd__(self, other: Any) -> Dual:
        return as_dual(other) + self

    def __rsub__(self, other: Any) -> Dual:
        return as_dual(other) - self

    def __rmul__(self, other: Any) -> Dual:
        return as_dual(other) * self

    def __gt__(self, other: Any) -> bool:
        return self.value > float(other)


def as_dual(x: Any) -> Dual:
    """Return a number as one with derivatives."""
    return x if isinstance(x, Dual) else Dual(float(x))


def combine_derivatives(p: float, a: Dual, q: float, b: Dual) -> Slopes:
    """Return the derivatives of p a + q b."""
    if not a.slopes or not b.slopes:
        return tuple(p * x for x in a.slopes) or tuple(q * x for x in b.slopes)
    return tuple(p * x + q * y for x, y in zip(a.slopes, b.slopes, strict=True))


class _Floats:
    """Operations on floats, under the names that slopes of elementary functions use on a graph."""

    one = 1.0
    constant = staticmethod(float)
    add = staticmethod(lambda a, b: a + b)
    sub = staticmethod(lambda a, b: a - b)
    mul = staticmethod(lambda a, b: a * b)
    div = staticmethod(lambda a, b: a / b)
    neg = staticmethod(lambda a: -a)

    @staticmethod
    def call(name: str, a: float) -> float:
        """Return an elementary function."""
        return ELEMENTARY[name].evaluate(a)


@dataclass(frozen=True)
class Duals:
    """Numbers of one run with derivatives by some directions.

    Attributes
    ----------
    values : mapping of str to Dual
        Parameters.
    """

    values: Mapping[str, Dual]

    def value(self, expression: Expr, where: str) -> Dual:
        """Return the value of a formula with its derivatives.

        Raises
        ------
        InputError
            If it has none.
        """
        own = {name: x.value for name, x in self.values.items()}
        value = evaluate_formula(expression, own, where)
        return Dual(value, self.derivatives(expression, where))

    def quick_value(self, expression: Expr, where: str) -> Dual:
        """Return the same by one walk over a formula; `value` takes another one, for its messages."""
        try:
            found = self._formula(expression, where)
            if math.isfinite(found.value):
                return found
        except (ArithmeticError, ValueError, TypeError):  # undefined somewhere, perhaps where it does not count
            pass
        return self.value(expression, where)

    def derivatives(self, expression: Expr, where: str) -> Slopes:
        """Return the derivatives of a formula that has a value."""
        return self._formula(expression, where).slopes

    def apply_function(self, function: str, *arguments: Any) -> Dual:
        """Return a function of formulas."""
        return apply_to_duals(function, [as_dual(a) for a in arguments])

    def check_above(self, limit: Any, x: Any, where: str, expected: str, got: str) -> Dual:
        """Return `x`.

        Raises
        ------
        InputError
            If it is at or below the limit.
        """
        if not float(x) > float(limit):
            raise InputError(where, expected, got)
        return as_dual(x)

    def _formula(self, e: Expr, where: str) -> Dual:
        if isinstance(e, Number):
            return Dual(e.value)
        if isinstance(e, Name | Reading):
            return self.values[e.name]
        assert isinstance(e, Call), "all kinds of expressions are known"
        if e.function == "where":
            test, yes, no = e.arguments
            return self._formula(yes if self._formula(test, where).value else no, where)
        if table_of(e.function) is not None:
            raise InputError(where, "a formula without tables, as sensitivities of a start follow it", e.function)
        return apply_to_duals(e.function, [self._formula(a, where) for a in e.arguments])


def apply_to_duals(function: str, arguments: Sequence[Dual]) -> Dual:
    """Return a function of numbers with derivatives."""
    a, b = arguments[0], arguments[1] if len(arguments) > 1 else Dual(0.0)
    if function == "where":
        return arguments[1] if a.value else arguments[2]
    if function in ("add", "sub", "mul", "div"):
        return {"add": a + b, "sub": a - b, "mul": a * b}.get(function) or a / b
    value = FUNCTIONS[function][1](*(x.value for x in arguments))
    if not any(x.slopes for x in arguments):
        return Dual(value)
    if function in ("min", "max", "both", "either"):
        return Dual(value, (a if value == a.value else b).slopes)
    return Dual(value, combine_derivatives(*_slopes_with_arguments(function, a, b, value)))


def _slopes_with_arguments(function: str, a: Dual, b: Dual, value: float) -> tuple[float, Dual, float, Dual]:
    """Return the slopes of a function by its arguments, each before the argument."""
    x, y, g = a.value, b.value, _Floats()
    if function == "neg":
        return -1.0, a, 0.0, Dual(0.0)
    if function == "abs":
        return math.copysign(1.0, x), a, 0.0, Dual(0.0)
    if function == "pow":
        by_exponent = value * math.log(x) if b.slopes and x > 0.0 else 0.0
        return (y * x ** (y - 1.0) if y != 0.0 else 0.0), a, by_exponent, b
    if function == "atan2":
        square = x * x + y * y
        return y / square, a, -x / square, b
    if function in ELEMENTARY:
        slope: Any = ELEMENTARY[function].slope
        return float(slope(g, x, value)), a, 0.0, Dual(0.0)
    return 0.0, a, 0.0, b  # comparisons and the like are constant between jumps


class ParameterDuals:
    """Parameters with their derivatives by some of them, for many values: the order of formulas is found once.

    Parameters
    ----------
    mechanism : Mechanism
        The mechanism.
    changed : container of str
        Parameters that are set to numbers in place of their formulas.
    by : sequence of str
        Parameters, one for each direction; others leave a direction without any.
    """

    def __init__(self, mechanism: Mechanism, changed: Container[str], by: Sequence[str]) -> None:
        self._own = {name: tuple(float(other == name) for other in by) for name in by}
        numbers = {p.name for p in mechanism.parameters if p.name in changed or p.name in self._own}
        self._formulas = dependent_parameters(mechanism.parameters, numbers)

    def at(self, values: Mapping[str, float]) -> dict[str, Dual]:
        """Return all parameters with their derivatives; formulas of parameters follow.

        Parameters
        ----------
        values : mapping of str to float
            All values; those with formulas are replaced.

        Raises
        ------
        InputError
            If a formula has no value.
        """
        duals = {name: Dual(value, self._own.get(name, ())) for name, value in values.items()}
        following = Duals(duals)
        for name, formula in self._formulas:
            duals[name] = following.quick_value(formula, f"parameter '{name}'")
        return duals


def parameter_duals(
    mechanism: Mechanism, values: Mapping[str, float], changed: Container[str], by: Sequence[str]
) -> dict[str, Dual]:
    """Return all parameters with their derivatives by some of them; arguments as of `ParameterDuals`."""
    return ParameterDuals(mechanism, changed, by).at(values)


def dual_slopes(numbers: Sequence[Any], count: int) -> Iterator[list[float]]:
    """Yield the derivatives of numbers by `count` directions, zeros where they depend on nothing."""
    for number in numbers:
        yield list(number.slopes) if isinstance(number, Dual) and number.slopes else [0.0] * count
