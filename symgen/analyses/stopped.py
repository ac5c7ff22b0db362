"""Stops in analyses: those that are closed at the start are rows in force, open ones are left out.

What comes out holds where closed stops push and gaps of open ones are not negative: `fault` is the check.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np
from msgspec.structs import replace as replaced
from numpy.typing import NDArray

from symgen.base.errors import AnalysisError, InputError
from symgen.base.vocabulary.measures import FormulaMeasure, Holonomic
from symgen.describe.bounds.stops import gap_of
from symgen.describe.joints.rows import tied
from symgen.describe.mechanism import EndStop, Joint
from symgen.run.compiling.side import compile_side
from symgen.run.layout import abi
from symgen.run.single.bounded_rows import STILL, TOUCHING

if TYPE_CHECKING:
    from symgen.analyses.subject import Subject
    from symgen.base.vocabulary.expressions import Expr
    from symgen.describe.mechanism import Mechanism
    from symgen.run.layout.compiled import CompiledModel
    from symgen.run.starts.assembly import Start

Array = NDArray[np.float64]

#: A force below this part of the largest multiplier is none.
NO_FORCE = 1e-9


def closed_stops(
    mechanism: Mechanism, compiled: CompiledModel, start: Start, stops: Sequence[EndStop]
) -> tuple[EndStop, ...]:
    """Return the stops whose gap is 0 at a state, and stays so.

    Parameters
    ----------
    mechanism, compiled
        The mechanism without stops.
    start : Start
        The state.
    stops : sequence of EndStop
        The stops.

    Raises
    ------
    InputError
        If a gap is negative, or a stop is struck.
    """
    if not stops:
        return ()
    w = start.w
    side = compile_side(mechanism, compiled, "gaps", "Gaps of stops and their rates", _gaps(stops), rates=1)
    closed = list[EndStop]()
    gaps, rates = side(start.t, start.y, start.p, w.copy(), np.zeros_like(start.y)).reshape(2, -1)
    for stop, gap, rate in zip(stops, gaps, rates, strict=True):
        nothing, still = TOUCHING * _scale(stop, w, abi.LENGTH), STILL * _scale(stop, w, abi.SPEED)
        if not gap >= -nothing:
            raise InputError(f"stop {stop.name}", "a gap of at least 0", f"{gap:.6g}", "a start within all stops")
        if gap <= nothing and rate < -still:
            raise InputError(f"stop {stop.name}", "a state without an impact", f"a rate of {rate:.6g}", "a run has it")
        if gap <= nothing and rate <= still:
            closed.append(stop)
    return tuple(closed)


def _gaps(stops: Sequence[EndStop]) -> list[tuple[str, Expr]]:
    """Return gaps by name; of a gap that a formula describes the formula, as its text selects the kept code."""
    return [
        (stop.name, stop.measure.of if isinstance(stop.measure, FormulaMeasure) else gap_of(stop)) for stop in stops
    ]


def _scale(stop: EndStop, w: Array, place: int) -> float:
    """Return the mechanism's scale of lengths or speeds in the unit of a gap."""
    return float(w[place] / (w[abi.LENGTH] or 1.0) if stop.unit == "rad" else w[place]) or 1.0


def with_rows(mechanism: Mechanism, stops: Sequence[EndStop]) -> Mechanism:
    """Return a mechanism in which stops are joints with the row that is in force where they are closed."""
    # formulas, which a tree does not take for coordinates that are prescribed: the force is that of a row
    rows = [(stop, Holonomic("stop", FormulaMeasure(gap_of(stop)), unit=stop.unit)) for stop in stops]
    return replaced(
        mechanism, joints=(*mechanism.joints, *(Joint(stop.name, "rows", tied(row), (row,)) for stop, row in rows))
    )


def mode_of(closed: Sequence[EndStop], opened: Sequence[EndStop]) -> tuple[str, ...]:
    """Say which stops are in force in one sentence; in none where there are no stops."""
    named = (closed, "closed, held as rows"), (opened, "open, left out")
    parts = [f"{', '.join(stop.name for stop in stops)} {word}" for stops, word in named if stops]
    return (f"stops as at the start: {'; '.join(parts)}",) if parts else ()


def fault(subject: Subject, y: Array, lam: Array) -> str:
    """Return the sentence on the first stop that cannot be in its mode at a state; empty where all can.

    Parameters
    ----------
    subject : Subject
        The mechanism.
    y, lam : Array
        The state and the multipliers of rows.
    """
    rows = {row.name: i for i, row in enumerate(subject.compiled.info.rows)}
    least = NO_FORCE * np.abs(lam / subject.loads).max(initial=0.0)
    for stop in subject.shut:
        at = rows[stop.row]
        if not -lam[at] / subject.loads[at] > least:
            unit = "N m" if stop.unit == "rad" else "N"
            return f"the closed stop {stop.name} does not push there (force {-lam[at]:.6g} {unit}): start with it open"
    if subject.opened:
        side = compile_side(subject.mechanism, subject.compiled, "gaps", "Gaps of stops", _gaps(subject.opened))
        gaps = side(subject.t, y, subject.p, subject.w.copy(), np.zeros_like(y))
        for stop, gap in zip(subject.opened, gaps, strict=True):
            if not gap >= -TOUCHING * _scale(stop, subject.w, abi.LENGTH):
                gap_there = f"its gap is {gap:.6g} {stop.unit}"
                return f"the stop {stop.name}, open at the start, is passed there ({gap_there}): start with it closed"
    return ""


def refuse_fault(subject: Subject, y: Array, lam: Array) -> None:
    """Refuse a state at which a stop cannot be in its mode.

    Raises
    ------
    AnalysisError
        With the first such stop.
    """
    if sentence := fault(subject, y, lam):
        raise AnalysisError(sentence)
