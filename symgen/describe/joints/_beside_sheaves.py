"""Which sheaves a rope is on at the start: those that its straight way does not pass by."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

from symgen.base.vocabulary.expressions import Expr, Number, names_in_expression
from symgen.describe.formulas.formula_numbers import Symbols, formula_of
from symgen.describe.formulas.start import Numbers
from symgen.describe.joints._stops_of_rope import Placed, across, between, placed_stop, product_of_vectors, seen_sign
from symgen.describe.parts.scope import Scope


def sheaves_at_start(numbers: Numbers, placed: Sequence[Placed]) -> list[bool]:
    """Return whether the rope is on each stop at the start: as if on all, until no sheave is passed by."""
    on = [stop.stop.wound is not False for stop in placed]
    for _ in placed:
        before = list(on)
        for j, here in enumerate(placed):
            if here.stop.is_sheave and here.stop.wound is None:
                i, k = neighbours(on, j)
                on[j] = not passes_by(numbers, here, (placed[i], placed[k]), placed, (i, j, k))
        if on == before:
            break
    return on


def neighbours(on: Sequence[bool], j: int) -> tuple[int, int]:
    """Return the stops before and after one that the rope is on."""
    return max(i for i in range(j) if on[i]), min(k for k in range(j + 1, len(on)) if on[k])


def start_formula(scope: Scope, placed: Sequence[Placed], on: Sequence[bool], j: int) -> Expr:
    """Return the formula of parameters that is 1 where the rope is on a sheave at the start, else 0.

    Beside other sheaves it is a number: they would decide together.
    """
    beside = (placed[j - 1], placed[j + 1])
    if placed[j].stop.wound is None and not any(x.stop.is_sheave for x in beside):
        symbols = Symbols()
        own = [placed_stop(scope, symbols, x.stop) for x in (*beside, placed[j])]
        passing = passes_by(symbols, own[2], (own[0], own[1]), placed, (j - 1, j, j + 1))
        formula = formula_of(1.0 - passing)
        if any(names_in_expression(formula)):
            return formula
    return Number(float(on[j]))


def passes_by(
    numbers: Numbers, here: Placed, ends: tuple[Placed, Placed], placed: Sequence[Placed], at: tuple[int, int, int]
) -> Any:
    """Whether the straight part from one stop to another passes by a sheave: on its side, between its ends and clear.

    `placed` are the stops with numbers, of which `at` names the first end, the sheave and the second end.
    """
    a, b = ends
    i, j, k = at
    apart = math.dist(placed[i].place, placed[k].place)
    if not apart > abs(across(placed[j], placed[i], placed[k])[1]):
        return 0.0
    signs = [seen_sign(placed[j], placed[n]) for n in (i, k)]
    first, side = signs[0] * a.radius, signs[1] * b.radius - signs[0] * a.radius
    (ux, uy), (cx, cy) = (
        tuple(product_of_vectors(vector, e) for e in here.triad[:2]) for vector in (between(a, b), between(a, here))
    )
    square = ux * ux + uy * uy
    length = numbers.apply_function("sqrt", square)
    sine = side / length
    cosine = numbers.apply_function("sqrt", 1.0 - sine * sine)
    ex, ey = (ux * cosine + uy * sine) / length, (uy * cosine - ux * sine) / length
    clear = math.copysign(1.0, placed[j].radius) * (first + ex * cy - ey * cx - here.radius)
    foot = ex * cx + ey * cy
    inside = [numbers.apply_function("gt", x, 0.0) for x in (clear, foot, length * cosine - foot)]
    return inside[0] * inside[1] * inside[2]
