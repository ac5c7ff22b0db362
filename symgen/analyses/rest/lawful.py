"""Rests that obey the laws of rows with bounds: stops and contacts open and close until all laws hold.

A search begins with the rows as at the start. What comes out is judged by the laws; a row that they contradict changes
its mode: what is passed closes, what does not push opens, what is beyond its cone slides and holds nothing. Where no
rest without dry friction exists, the start is one if friction holds it.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from symgen.analyses.rest.equilibria import Equilibrium, find_equilibrium, judge_equilibrium
from symgen.analyses.rest.held_rows import held_start, is_held_row
from symgen.analyses.rest.pushed import sink_on
from symgen.analyses.rest.settle import Settled
from symgen.analyses.state.algebra import DEPENDENT, null_space_split
from symgen.analyses.state.laws_at_rest import Holding, contacts_holding, forces_at_rest, multipliers_with
from symgen.analyses.state.one_sided import RowModes, fault_of_gaps, fault_of_mode
from symgen.analyses.state.sticking import Fault, fault_along
from symgen.analyses.state.subject import Subject, make_subject
from symgen.base.errors import AnalysisError, AssemblyError

if TYPE_CHECKING:
    from symgen.base.settings import Settings
    from symgen.describe.mechanism import Mechanism

Array = NDArray[np.float64]

#: Most changes of modes.
MOST_CHANGES = 40


@dataclass(frozen=True)
class Rest:
    """A rest that obeys all laws.

    Attributes
    ----------
    start : Subject
        The mechanism at its start, with the rows that are in force at the rest.
    settled : Settled
        The position.
    equilibrium : Equilibrium
        Its judgement.
    """

    start: Subject
    settled: Settled
    equilibrium: Equilibrium


def find_lawful_rest(
    mechanism: Mechanism,
    settings: Settings,
    by: Sequence[str] = (),
    sinking: bool = True,
    subject: Subject | None = None,
) -> Rest:
    """Find the equilibrium that the start leads to, with the rows in force that it has there.

    Parameters
    ----------
    mechanism, settings, by
        As for `symgen.analyses.state.subject.make_subject`.
    sinking : bool
        Whether an unstable rest that is not near the start is left for a stable one.
    subject : Subject, optional
        The mechanism at its start, if it is known.

    Raises
    ------
    AnalysisError
        If no equilibrium is found, with what the first one lacks.
    """
    subject = subject or make_subject(mechanism, settings, by)
    modes, seen = row_modes_at_start(mechanism, subject), set[RowModes]()
    first: Fault | None = None
    for _ in range(MOST_CHANGES):
        try:
            rest = _rest_from(mechanism, settings, by, subject, sinking)
        except AnalysisError:
            if first is None:
                raise
            break
        rest, fault, rows = _judge_by_laws(rest)
        if fault is None:
            return replace(rest, equilibrium=_with_notes(rest, first))
        first = first or fault
        seen.add(modes)
        for row in rows:
            modes = _changed(modes, row, rest.settled.subject)
        if modes in seen:
            break
        try:
            subject = make_subject(mechanism, settings, by, modes)
        except AssemblyError:  # a tree is put together from bodies that close
            settings = replace(settings, coordinates="absolute")
            subject = make_subject(mechanism, settings, by, modes)
    raise AnalysisError(first.whole if first is not None else "")


def row_modes_at_start(mechanism: Mechanism, subject: Subject) -> RowModes:
    """Return the modes that the rows with bounds of a mechanism have in a subject."""
    stuck, along = {each.row.row for each in subject.stuck}, {row.row for row in mechanism.bounded if row.signed}
    return RowModes(frozenset(row.row for row in subject.shut), frozenset(along - stuck))


def with_bodies(mechanism: Mechanism, settings: Settings, subject: Subject) -> Subject:
    """Return a mechanism in coordinates of bodies with the rows in force that a subject has."""
    settings = replace(settings, coordinates="absolute")
    if subject.held and (held := held_start(mechanism, settings)) is not None:
        return held[0]
    own = make_subject(mechanism, settings, (), row_modes_at_start(mechanism, subject))
    return replace(own, whence=subject.whence)


def multipliers_of_bodies(bodies: Subject, y: Array, known: Mapping[str, float]) -> Array | None:
    """Return the multipliers in coordinates of bodies where rows with bounds have known forces; None without any.

    Parameters
    ----------
    bodies, y : Subject, Array
        The mechanism and its state.
    known : mapping of str to float
        Multipliers by rows.
    """
    own = {*(row.row for row in bodies.shut), *(each.row.row for each in bodies.stuck)}
    holding = [Holding(row.name) for row in bodies.compiled.info.rows if row.name in own or is_held_row(row.name)]
    if not holding:
        return None
    return multipliers_with(bodies, y, holding, np.array([known[each.row] for each in holding]))


def _changed(modes: RowModes, row: str, subject: Subject) -> RowModes:
    """Return modes of which one has changed."""
    stuck = [each.row for each in subject.stuck]
    if row in {each.row for each in stuck}:
        pairs = ({one.row, other.row} for one, other in pairwise(stuck) if other.second)
        return RowModes(modes.shut, modes.loose | next((pair for pair in pairs if row in pair), {row}))
    return RowModes(modes.shut ^ {row}, modes.loose)


def _rest_from(mechanism: Mechanism, settings: Settings, by: Sequence[str], subject: Subject, sinking: bool) -> Rest:
    """Find a rest with the rows of a subject, or the start where dry friction holds it and there is no other."""
    try:
        settled = find_equilibrium(subject)
    except AnalysisError:
        held = held_start(mechanism, settings, by)
        if held is None:
            raise
        settled = Settled(held[0], held[0].y, held[1], 0)
        return Rest(held[0], settled, judge_equilibrium(settled, held[1]))
    rest = judge_equilibrium(settled)
    return Rest(subject, *(sink_on(subject, settled, rest) if sinking else (settled, rest)))


def _judge_by_laws(rest: Rest) -> tuple[Rest, Fault | None, Sequence[str]]:
    """Return a rest with forces that obey the laws; else what contradicts them, and the rows that change."""
    subject, y, lam = rest.settled.subject, rest.equilibrium.y, rest.equilibrium.lam
    fault = None if subject.held else fault_of_mode(subject, y, lam)
    if fault is None and not (subject.stuck and _dependent_rows(subject, y)):
        return rest, None, ()
    if (gap := fault_of_gaps(subject, y)) is not None:
        return rest, gap, (gap.row,)
    holding = contacts_holding(subject)
    begun = forces_at_rest(subject, y, holding)
    if begun is None or (fault is None and begun.moving):
        return rest, fault, () if fault is None else (fault.row,)
    if fault is None or not begun.moving:
        lam = multipliers_with(subject, y, holding, begun.forces)
        return replace(rest, equilibrium=judge_equilibrium(rest.settled, lam)), None, ()
    return rest, _fault_of_motion(rest, fault, begun.moving), begun.moving


def _dependent_rows(subject: Subject, y: Array) -> set[str]:
    """Return the rows whose forces are not unique."""
    dependent = null_space_split(subject.rows(subject.evaluate(y)), subject.loads)[2]
    rows = zip(subject.compiled.info.rows, np.abs(dependent).max(axis=1, initial=0.0), strict=True)
    return {row.name for row, share in rows if share > DEPENDENT}


def _fault_of_motion(rest: Rest, fault: Fault, moving: Sequence[str]) -> Fault:
    """Return what contradicts the laws in a row that begins to move, with what it would take if that is unique."""
    subject, y, lam = rest.settled.subject, rest.equilibrium.y, rest.equilibrium.lam
    if _dependent_rows(subject, y).isdisjoint(x.row for x in subject.shut):
        for each in filter(None, (fault, fault_along(subject, y, lam))):
            if each.row in moving:
                return each
    contacts = {x.row.row: x.row.name for x in subject.stuck}
    names = ", ".join(dict.fromkeys(contacts[row] for row in moving if row in contacts))
    return Fault(moving[0], f"friction at {names} does not hold it" if names else fault.sentence)


def _with_notes(rest: Rest, first: Fault | None) -> Equilibrium:
    """Return an equilibrium with what friction leaves open, and why rows are not as at the start."""
    own, subject, notes = rest.equilibrium, rest.settled.subject, list[str]()
    if first is not None:
        notes.append(f"another rest than with rows as at the start, where {first.sentence}")
    if friction_leaves_more(subject, own.y):
        notes.append("friction holds other positions too: this is one of a set of equilibria")
    return replace(own, notes=(*own.notes, *notes))


def friction_leaves_more(subject: Subject, y: Array) -> bool:
    """Return whether more would be free without rows that friction holds."""
    own, d = {each.row.row for each in subject.stuck}, subject.rows(subject.evaluate(y))
    others = [i for i, r in enumerate(subject.compiled.info.rows) if not (r.name in own or is_held_row(r.name))]
    return bool(subject.split_freedom(d[others])[0].shape[1] > subject.split_freedom(d)[0].shape[1])
