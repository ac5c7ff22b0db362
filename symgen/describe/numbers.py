"""What a described start is worked out in: the numbers of one run, or arrays with an element for each of many.

Algorithms are written once, with the operators of Python and the functions of formulas, and serve both: `Scalars` here,
and columns of a sweep in `symgen.ensemble.chunks`.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Protocol

from symgen.errors import InputError
from symgen.vocabulary.expressions import FUNCTIONS, Expr


class Numbers(Protocol):
    """Numbers of one run, or arrays of many."""

    def value(self, expression: Expr, where: str) -> Any:
        """Return what a formula stands for; `where` is file and key, for the message."""

    def apply(self, function: str, *arguments: Any) -> Any:
        """Return a function of formulas (`symgen.vocabulary.expressions.FUNCTIONS`) of numbers."""

    def above(self, limit: Any, x: Any, where: str, expected: str, got: str) -> Any:
        """Return `x`, which has to be above a limit."""


@dataclass(frozen=True)
class Scalars:
    """The numbers of one run; what is undefined is an error.

    Attributes
    ----------
    evaluate : callable
        What a formula stands for; the second argument is file and key, for the message.
    """

    evaluate: Callable[[Expr, str], float]

    def value(self, expression: Expr, where: str) -> float:
        """Return the number that a formula stands for.

        Raises
        ------
        InputError
            If it has none.
        """
        return self.evaluate(expression, where)

    def apply(self, function: str, *arguments: float) -> float:
        """Return a function of formulas."""
        return FUNCTIONS[function][1](*arguments)

    def above(self, limit: float, x: float, where: str, expected: str, got: str) -> float:
        """Return `x`.

        Raises
        ------
        InputError
            If it is not above the limit.
        """
        if not x > limit:
            raise InputError(where, expected, got)
        return x
