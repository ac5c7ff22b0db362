"""Formulas that are the least of several smooth ones: ``min(a, b)``, ``a - max(b, c)``, ``a - abs(b)``."""

from __future__ import annotations

from collections.abc import Collection
from itertools import product

from symgen.base.vocabulary.expressions import Call, Expr, Number, call, names_in_expression, readings_in

#: Most pieces of a formula; one with more is taken as it is.
MOST_PIECES = 8


def least_of(formula: Expr, timely: Collection[str]) -> tuple[Expr, ...]:
    """Return the formulas of which one is the least, without `min`, `max` and `abs` at its top; else the formula.

    Parameters
    ----------
    formula : Expr
        The formula.
    timely : collection of str
        Names of what does not depend on the state: formulas of these alone take the place of each other at times that
        are known before a run.
    """
    pieces = tuple(dict.fromkeys(_pieces(formula, 1.0, timely)))
    return pieces if len(pieces) <= MOST_PIECES else (formula,)


def _pieces(formula: Expr, sign: float, timely: Collection[str]) -> tuple[Expr, ...]:
    """Return formulas whose least, or whose greatest for a negative sign, a formula is."""
    if not isinstance(formula, Call):
        return (formula,)
    function, arguments = formula.function, formula.arguments
    if not any(readings_in(formula)) and set(names_in_expression(formula)) <= set(timely):
        return (formula,)
    if function == ("min" if sign > 0.0 else "max"):
        return tuple(piece for argument in arguments for piece in _pieces(argument, sign, timely))
    if function == "abs" and sign < 0.0:
        return (arguments[0], call("neg", arguments[0]))
    signs: tuple[float, ...] = ()
    if function == "neg":
        signs = (-sign,)
    elif function == "add":
        signs = (sign,) * len(arguments)
    elif function == "sub":
        signs = (sign, -sign)
    elif function in ("mul", "div"):
        signs = _signs_of_factors(function, arguments, sign)
    if not signs:
        return (formula,)
    parts = [_pieces(argument, s, timely) if s else (argument,) for argument, s in zip(arguments, signs, strict=True)]
    if all(len(part) == 1 for part in parts):
        return (formula,)
    return tuple(call(function, *chosen) for chosen in product(*parts))


def _signs_of_factors(function: str, arguments: tuple[Expr, ...], sign: float) -> tuple[float, ...]:
    """Return the sign for the only factor that is no number, 0 for the others; nothing where there are several."""
    signs, total = list[float](), sign
    for place, argument in enumerate(arguments):
        if isinstance(argument, Number):
            total = total if argument.value > 0.0 else -total
            signs.append(0.0)
        elif function == "div" and place > 0:
            return ()
        else:
            signs.append(1.0)
    return tuple(total * s for s in signs) if signs.count(1.0) == 1 else ()
