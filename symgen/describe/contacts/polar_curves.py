"""Closed curves by their radius, a formula of the direction, for outlines such as cams."""

from __future__ import annotations

import cmath
import math
from collections.abc import Iterator

from symgen.base.vocabulary.expressions import Expr
from symgen.describe.contacts.arcs_along import Stretch
from symgen.describe.contacts.drawn_curves import BadDrawing
from symgen.describe.formulas.evaluate import evaluate_formula
from symgen.describe.parts.scope import Scope

#: The direction in formulas, stretches of a curve, and the step of differences, with weights, in its slopes [rad].
PHI, _STRETCHES, _STEP = "phi", 8, 2e-4
_WEIGHTS = ((1, 8.0 / 12.0), (2, -1.0 / 12.0))
#: Part of a radius by which a curve may miss its start.
_CLOSED = 1e-9


def polar_curve(scope: Scope, radius: float | str) -> Iterator[Stretch]:
    """Yield the stretches of a closed curve from its radius [m], a formula of ``phi`` from 0 to 2 pi.

    Raises
    ------
    BadDrawing
        If the radius is not above 0, or another one after a turn.
    InputError
        If it is no such formula.
    """
    of = scope.of_curve("radius", radius, PHI)
    for i in range(8 * _STRETCHES):
        phi = math.tau * i / (8 * _STRETCHES)
        if not (r := _at(scope, of, phi)) > 0.0:
            raise BadDrawing("a radius above 0", f"{r:.6g} m at phi = {phi:.6g}")
    first, last = _at(scope, of, 0.0), _at(scope, of, math.tau)
    if abs(last - first) > _CLOSED * first:
        raise BadDrawing("a radius that is the same after a turn", f"{first:.6g} m at 0 and {last:.6g} m at 2 pi")

    def stretch(begin: float) -> Stretch:
        def at(x: float) -> tuple[complex, complex]:
            phi = begin + x * math.tau / _STRETCHES
            r = _within_a_turn(scope, of, phi)
            steps = (
                (weight, _within_a_turn(scope, of, phi + side * n * _STEP), side)
                for n, weight in _WEIGHTS
                for side in (1, -1)
            )
            slope = sum(weight * side * other for weight, other, side in steps) / _STEP
            along = complex(slope, r) * cmath.exp(1j * phi)
            return r * cmath.exp(1j * phi), along / abs(along)

        return Stretch(at)

    for i in range(_STRETCHES):
        yield stretch(math.tau * i / _STRETCHES)


def _within_a_turn(scope: Scope, of: Expr, phi: float) -> float:
    return _at(scope, of, phi % math.tau)


def _at(scope: Scope, of: Expr, phi: float) -> float:
    """Return the radius in a direction."""
    return evaluate_formula(of, {PHI: phi}, scope.where("radius"), scope.context.tables)
