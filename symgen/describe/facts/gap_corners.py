"""Corners of gaps: where the formula of a gap has a kink over the state, the row of a closed stop turns.

A corner is an event of a closed stop alone. While it is open, corners are switches as those of other formulas are
(`symgen.describe.facts.kinks`): its gap is not smooth there, and pushes nothing.
"""

from __future__ import annotations

from collections.abc import Iterator

from symgen.base.vocabulary.expressions import ONE, Expr, Reading, call, names_in_expression, readings_in
from symgen.base.vocabulary.measures import FormulaMeasure, OnChain
from symgen.describe.bounded import BoundedRow
from symgen.describe.bounds.bounded_modes import MODE, formula_of_closed
from symgen.describe.facts.kinks import kink_expressions
from symgen.describe.mechanism import Mechanism, ModeEvent

#: Last word of the names of these events, before a number where a gap has several.
CORNER = "corner"


def corner_events(mechanism: Mechanism, junctions: bool = False) -> Iterator[ModeEvent]:
    """Yield the events at which gaps of closed stops pass corners; their functions are 1 while a stop is open.

    With `junctions` so are those at which gaps pass the pieces of chains: what is in force jumps there, which runs with
    derivatives have to carry through.
    """
    for place, row in enumerate(mechanism.bounded):
        if row.one_sided:
            closed = formula_of_closed(row)
            for number, zero in enumerate(_zero_at_corners(mechanism, row, junctions)):
                when = call("add", call("mul", closed, zero), call("sub", ONE, closed))
                name = f"{row.name}.{CORNER}{number or ''}"
                yield ModeEvent(name, when, "any", MODE, (), "corner of a closed gap", CORNER, place)


def _zero_at_corners(mechanism: Mechanism, row: BoundedRow, junctions: bool) -> Iterator[Expr]:
    """Yield what is 0 at the corners of a gap that the state passes; those over time alone are seams."""
    plain = {p.name for p in mechanism.parameters} | {"t"}
    of = row.measure.of if isinstance(row.measure, FormulaMeasure) else row.held.value
    own = kink_expressions(of) if junctions else _corners_of(of)
    for zero in dict.fromkeys((*own, *kink_expressions(row.held.value))):
        if any(readings_in(zero)) or not set(names_in_expression(zero)) <= plain:
            yield zero


def rows_that_turn(mechanism: Mechanism, corrected: bool) -> tuple[int, ...]:
    """Return the numbers of the rows with bounds that may turn sharply within a step.

    Parameters
    ----------
    mechanism : Mechanism
        The description.
    corrected : bool
        Whether velocities are corrected after each step, so that a correction above its error tells any sharp turn;
        otherwise only gaps with corners count, as other methods leave rates of closed gaps.
    """
    formulas = [(i, row.measure) for i, row in enumerate(mechanism.bounded) if row.one_sided]
    own = [(i, measure.of) for i, measure in formulas if isinstance(measure, FormulaMeasure)]
    return tuple(i for i, of in own if corrected or _corners_of(of))


def _corners_of(formula: Expr) -> tuple[Expr, ...]:
    """Return what is 0 at the corners of a gap; none are where it passes the pieces of a chain without edges."""
    return tuple(
        zero
        for zero in kink_expressions(formula)
        if not (isinstance(zero, Reading) and isinstance(zero.source, OnChain)) or zero.source.chain.sharp
    )
