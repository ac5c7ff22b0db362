"""A push from an unstable rest that a search has come to by chance: a mechanism sinks on into a stable one."""

from __future__ import annotations

from contextlib import suppress

import numpy as np
from numpy.typing import NDArray

from symgen.analyses.rest.dense_statics import DenseStatics, evaluate_at_balance
from symgen.analyses.rest.equilibria import STABLE, UNSTABLE, Equilibrium, judge_equilibrium
from symgen.analyses.rest.settle import NEAR, Settled, close_nearly, length_of_step, newton_step, settle_position
from symgen.analyses.state.algebra import solver_with_rows, symmetric_part, unit_stiffness
from symgen.analyses.state.subject import Subject
from symgen.base.errors import AnalysisError

Array = NDArray[np.float64]

#: Lengths of pushes, one after the other, each in both directions [lengths of the mechanism, rad].
PUSHES = (0.01, 0.1)
#: Steps of Newton's method are looked at until they are shorter than this, or so many.
REACHED, MOST_STEPS = 1e-6, 20
#: After a push, steps of Newton's method up to this are taken: longer ones lead back.
CLOSE = 1e-3


def sink_on(subject: Subject, settled: Settled, rest: Equilibrium) -> tuple[Settled, Equilibrium]:
    """Return a rest, or a stable one that a push from it leads to, where it is unstable and the start is not near it.

    Parameters
    ----------
    subject : Subject
        The mechanism at its start.
    settled, rest : Settled, Equilibrium
        What the search has found.
    """
    if rest.stability != UNSTABLE or is_near_rest(subject, subject.y.copy()):
        return settled, rest
    change = _falling_direction(settled.subject, rest.y, rest.lam)
    for size in PUSHES:
        for sign in (1.0, -1.0):
            pushed = settled.subject.move_state(rest.y, sign * size * change)
            with suppress(AnalysisError):
                other = settle_position(settled.subject.wind_angles(pushed), pushed, near=CLOSE)
                there = judge_equilibrium(other)
                if there.stability == STABLE:
                    return other, there
    return settled, rest


def is_near_rest(subject: Subject, y: Array) -> bool:
    """Whether Newton's method goes from a state to a rest by ever shorter steps, once the mechanism is closed."""
    statics, y, _ = close_nearly(DenseStatics(subject), y)
    work, before = None, NEAR
    for _ in range(MOST_STEPS):
        lam = statics.all_multipliers(work)
        force, gaps = statics.forces(y, lam)
        motion, rows, stiffness = statics.derivatives(y, lam)
        if work is None:
            even = solver_with_rows(unit_stiffness(stiffness), rows)
            work = np.zeros(len(gaps)) if even is None else even(-force, np.zeros(len(gaps)))[1]
            continue
        way = newton_step(statics, motion, solver_with_rows(stiffness, rows), (force, gaps), before)
        if way is None:
            return False
        before = length_of_step(statics, motion, way[0])
        if before < REACHED:
            return True
        y, work = statics.move_state(y, motion @ way[0]), work + way[1]
        statics = statics.wind_angles(y)
    return False


def _falling_direction(subject: Subject, y: Array, lam: Array) -> Array:
    """Return the change of coordinates along which the stiffness is least, its largest part of a length 1."""
    e, by_position = evaluate_at_balance(subject, y.copy(), lam)
    motion = e.by("motion", "v")
    basis = subject.split_freedom(subject.rows(e))[0]
    vectors = np.linalg.eigh(symmetric_part(basis.T @ (by_position @ motion) @ basis))[1]
    change = motion @ (basis @ vectors[:, 0])
    return np.asarray(change / np.abs(change / subject.lengths).max())
