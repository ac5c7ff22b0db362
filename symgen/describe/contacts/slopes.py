"""Derivatives of formulas by the places of bodies, where they are numbers."""

from __future__ import annotations

from symgen.base.vocabulary.expressions import Call, Expr, Name, Number, Reading
from symgen.base.vocabulary.measures import GROUND, Angle, Component

#: Derivatives by the two coordinates of the place of each body.
Slopes = dict[str, tuple[float, float]]


def slopes_of_places(formula: Expr) -> Slopes | None:
    """Return the derivatives of a formula by the places of bodies; None where one of them is no number."""
    if isinstance(formula, Number):
        return {}
    if isinstance(formula, Name):
        body, _, label = formula.name.rpartition(".")
        return {body: (float(label == "x"), float(label == "y"))} if body and label in ("x", "y") else {}
    if isinstance(formula, Reading):
        return _slopes_of_reading(formula)
    return _slopes_of_call(formula)


def _slopes_of_reading(reading: Reading) -> Slopes | None:
    """Return the derivatives of a point's coordinate in the ground's frame; angles do not depend on places."""
    source = reading.source
    if isinstance(source, Angle):
        return {}
    if isinstance(source, Component) and source.along.body == source.a.body == GROUND:
        x, y = (e.value if isinstance(e, Number) else None for e in source.along.vector)
        return None if x is None or y is None else {source.b.body: (x, y)}
    return None


def _slopes_of_call(formula: Call) -> Slopes | None:
    parts = [slopes_of_places(argument) for argument in formula.arguments]
    if any(part is None for part in parts):
        return None
    known = [part for part in parts if part is not None]
    function, arguments = formula.function, formula.arguments
    if function in ("add", "sub", "neg"):
        signs = [-1.0] if function == "neg" else [1.0] + [1.0 if function == "add" else -1.0] * (len(known) - 1)
        return _sum_of_slopes(known, signs)
    moving = [i for i, part in enumerate(known) if any(any(slope) for slope in part.values())]
    if not moving:
        return {}
    if (function in ("mul", "div") and moving == [0]) or (function == "mul" and len(moving) == 1):
        factor = 1.0
        for i, argument in enumerate(arguments):
            if i not in moving:
                if not isinstance(argument, Number):
                    return None
                factor = factor * argument.value if function == "mul" else factor / argument.value
        return _sum_of_slopes([known[moving[0]]], [factor])
    return None


def _sum_of_slopes(parts: list[Slopes], factors: list[float]) -> Slopes:
    total: Slopes = {}
    for part, factor in zip(parts, factors, strict=True):
        for body, (x, y) in part.items():
            own = total.get(body, (0.0, 0.0))
            total[body] = own[0] + factor * x, own[1] + factor * y
    return total
