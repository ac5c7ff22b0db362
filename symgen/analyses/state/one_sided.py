"""One-sided rows in analyses: those that are in force at the start are rows, others are left out.

What comes out holds where rows in force push and gaps of others are not negative: `fault_of_mode` is the check.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import msgspec
import numpy as np
from msgspec.structs import replace as replaced
from numpy.typing import NDArray

from symgen.analyses.state.sticking import Fault, fault_along
from symgen.base.errors import AnalysisError, InputError
from symgen.base.vocabulary.measures import FormulaMeasure, Holonomic
from symgen.describe.bounded import BoundedRow
from symgen.describe.bounds.bounded_modes import unit_of_effort
from symgen.describe.joints.rows import tied_bodies
from symgen.describe.mechanism import Joint
from symgen.run.compiling.side import compile_side
from symgen.run.layout import abi
from symgen.run.layout.scales import LEAST_SPEED
from symgen.run.modes.bounded_rows import STILL
from symgen.run.modes.row_records import TOUCHING

if TYPE_CHECKING:
    from symgen.analyses.state.subject import Subject
    from symgen.base.vocabulary.expressions import Expr
    from symgen.describe.mechanism import Mechanism
    from symgen.run.layout.compiled import CompiledModel
    from symgen.run.starts.assembly import Start

Array = NDArray[np.float64]

#: A force below this part of the largest multiplier is none.
NO_FORCE = 1e-9


class RowModes(msgspec.Struct, frozen=True):
    """Rows that a search has in force, in place of those that the start closes.

    Parameters
    ----------
    shut : frozenset of str
        One-sided rows in force.
    loose : frozenset of str
        Rows along contacts that hold nothing.
    """

    shut: frozenset[str]
    loose: frozenset[str] = frozenset()


def rows_in_force_at(
    mechanism: Mechanism, compiled: CompiledModel, start: Start, bounded: Sequence[BoundedRow]
) -> tuple[BoundedRow, ...]:
    """Return the one-sided rows whose gap is 0 at a state, and stays so.

    Parameters
    ----------
    mechanism, compiled
        The mechanism without them.
    start : Start
        The state.
    bounded : sequence of BoundedRow
        The rows.

    Raises
    ------
    InputError
        If a gap is negative, or there is an impact.
    """
    if not bounded:
        return ()
    w = start.w
    side = compile_side(mechanism, compiled, "gaps", "Gaps and their rates", _gaps_by_name(bounded), rates=1)
    closed = list[BoundedRow]()
    gaps, rates = side(start.t, start.y, start.p, w.copy(), np.zeros_like(start.y)).reshape(2, -1)
    for row, gap, rate in zip(bounded, gaps, rates, strict=True):
        size = _scale_of_gap(row, w, abi.LENGTH)
        # a state at rest has speeds of rounding alone, which are no scale
        nothing, still = TOUCHING * size, STILL * max(_scale_of_gap(row, w, abi.SPEED), LEAST_SPEED * size)
        if not gap >= -nothing:
            raise InputError(row.where, "a gap of at least 0", f"{gap:.6g}", f"a start within all {row.family.noun}")
        if gap <= nothing and rate < -still:
            raise InputError(row.where, "a state without an impact", f"a rate of {rate:.6g}", "a run has it")
        if gap <= nothing and rate <= still:
            closed.append(row)
    return tuple(closed)


def _gaps_by_name(bounded: Sequence[BoundedRow]) -> list[tuple[str, Expr]]:
    """Return gaps by name; of a gap that a formula describes the formula, as its text selects the kept code."""
    return [(row.label, row.measure.of if isinstance(row.measure, FormulaMeasure) else row.place[1]) for row in bounded]


def _scale_of_gap(row: BoundedRow, w: Array, place: int) -> float:
    """Return the mechanism's scale of lengths or speeds in the unit of a gap."""
    return float(w[place] / (w[abi.LENGTH] or 1.0) if row.unit == "rad" else w[place]) or 1.0


def rows_as_joints(mechanism: Mechanism, bounded: Sequence[BoundedRow]) -> Mechanism:
    """Return a mechanism in which one-sided rows are joints with the row that is in force at times."""
    # formulas, which a tree does not take for coordinates that are prescribed: the force is that of a row
    rows = [(each.label, Holonomic(each.held.label, FormulaMeasure(each.place[1]), unit=each.unit)) for each in bounded]
    return replaced(
        mechanism, joints=(*mechanism.joints, *(Joint(name, "rows", tied_bodies(row), (row,)) for name, row in rows))
    )


def mode_in_words(shut: Sequence[BoundedRow], opened: Sequence[BoundedRow], whence: str) -> tuple[str, ...]:
    """Say which one-sided rows are in force, as at the start or in the rest, in one sentence for each family."""
    sentences = list[str]()
    for family in dict.fromkeys(row.family for row in (*shut, *opened)):
        named = (shut, f"{family.in_force}, held as rows"), (opened, f"{family.off}, left out")
        own = [(", ".join(row.label for row in rows if row.family == family), words) for rows, words in named]
        parts = [f"{names} {words}" for names, words in own if names]
        sentences.append(f"{family.noun} {whence}: {'; '.join(parts)}")
    return tuple(sentences)


def fault_of_mode(subject: Subject, y: Array, lam: Array) -> Fault | None:
    """Return why a row cannot be in its mode at a state: by its force, by its gap, or along it; None where all can.

    Parameters
    ----------
    subject : Subject
        The mechanism.
    y, lam : Array
        The state and the multipliers of rows.
    """
    return fault_of_push(subject, lam) or fault_of_gaps(subject, y) or fault_along(subject, y, lam)


def fault_of_push(subject: Subject, lam: Array) -> Fault | None:
    """Return the first row in force that does not push, None without any."""
    rows = {row.name: i for i, row in enumerate(subject.compiled.info.rows)}
    least = NO_FORCE * np.abs(lam / subject.loads).max(initial=0.0)
    for row in subject.shut:
        at, words = rows[row.row], row.family
        if not -lam[at] / subject.loads[at] > least:
            return Fault(
                row.row,
                f"the {words.in_force} {words.one} {row.label} does not push there "
                f"(force {-lam[at]:.6g} {unit_of_effort(row)})",
                f"start with it {words.off}",
            )
    return None


def fault_of_gaps(subject: Subject, y: Array) -> Fault | None:
    """Return the first row left out whose gap is negative, None without any."""
    if subject.opened:
        side = compile_side(subject.mechanism, subject.compiled, "gaps", "Gaps", _gaps_by_name(subject.opened))
        gaps = side(subject.t, y, subject.p, subject.w.copy(), np.zeros_like(y))
        for row, gap in zip(subject.opened, gaps, strict=True):
            if not gap >= -TOUCHING * _scale_of_gap(row, subject.w, abi.LENGTH):
                words, gap_there = row.family, f"its gap is {gap:.6g} {row.unit}"
                return Fault(
                    row.row,
                    f"the {words.one} {row.label}, {words.off} at the start, is passed there ({gap_there})",
                    f"start with it {words.in_force}",
                )
    return None


def refuse_impossible_mode(subject: Subject, y: Array, lam: Array) -> None:
    """Refuse a state at which a one-sided row cannot be in its mode.

    Raises
    ------
    AnalysisError
        With the first such row.
    """
    if (fault := fault_of_mode(subject, y, lam)) is not None:
        raise AnalysisError(fault.whole)
