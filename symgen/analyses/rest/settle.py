"""The search for an equilibrium: f(q, 0) = D^T lambda, Phi(q) = 0, with dense or with sparse matrices.

The mechanism is closed first. A search then solves, step by step,

    [ K + s G   D^T ]
    [ D         0   ]

which is Newton's method where s = 0. Far from rest s is so large that a step stays short and goes downhill.
"""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import suppress
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, TypeVar

import numpy as np
from numpy.typing import NDArray

from symgen.analyses.state.algebra import Solver, largest_magnitude, solver_with_rows, unit_stiffness
from symgen.analyses.state.subject import Subject
from symgen.base.errors import AnalysisError

if TYPE_CHECKING:
    from symgen.analyses.state.sparse_statics import Sparse
from symgen.analyses.rest.dense_statics import DenseStatics

Array = NDArray[np.float64]

#: Most steps of a search, and most trials of a step.
MOST_STEPS, MOST_TRIALS = 300, 60
#: Forces and violations below this fraction of what they are compared with count as zero; below this one they are
#: rounding, and no step makes them less.
TOLERANCE, EXACT = 1e-9, 1e-16
#: A step of Newton's method up to this, in lengths of the mechanism and radians, is near what it leads to; steps
#: downhill are this long at most.
NEAR, REACH = 0.15, 1.0
#: Lengths of the mechanism by which a step downhill may open it.
OPENED = 0.05
#: A closing step as long as this has no way; what everything is moved by then, in lengths of the mechanism and radians.
SINGULAR, ASTRAY = 1e6, 0.01
#: Factor of s where a step is too long, and the least part of its root that is left after a short one.
FASTER, SLOWER = 4.0, 0.3
#: Parts of what is not balanced at first that the first load step takes away, and the last one that is tried; Newton's
#: steps in one.
FIRST_LOAD, LEAST_LOAD, CORRECTIONS = 0.25, 1e-3, 20
#: Newton's step that ends a load step, and the last one; below the third, steps that grow no shorter are rounding
#: [lengths of the mechanism, rad].
FOLLOWED, RESTING, ROUNDED = 1e-3, 1e-13, 1e-7


#: A static problem over changes in lengths of the mechanism and radians: forces are work. So it is the same one in
#: micrometres, where moments are nothing beside forces as numbers.
S = TypeVar("S", "DenseStatics", "Sparse")


@dataclass(frozen=True)
class Settled:
    """A position where all forces balance.

    Attributes
    ----------
    subject : Subject
        The mechanism, with angles that count turns as they were followed there.
    y : Array
        The state.
    lam : Array
        Multipliers of all rows, then of what is held.
    steps : int
        Steps taken.
    """

    subject: Subject
    y: Array
    lam: Array
    steps: int


def settle_position(subject: Subject, y: Array, held: Sequence[tuple[str, float]] = (), near: float = NEAR) -> Settled:
    """Return a position where all forces balance.

    Parameters
    ----------
    subject : Subject
        The mechanism.
    y : Array
        A state; its velocities are kept.
    held : sequence of (str, float)
        Coordinates held at a value by a force of their own, whose multiplier comes last.
    near : float
        Length of the longest step of Newton's method that is taken; from further away steps go downhill.

    Raises
    ------
    AnalysisError
        If no equilibrium is found.
    """
    statics, y, lam, steps = search_equilibrium(DenseStatics(subject, held), y, near)
    return Settled(statics.subject, y, lam, steps)


def search_equilibrium(statics: S, y: Array, near: float = NEAR) -> tuple[S, Array, Array, int]:
    """Return a static problem at an equilibrium, the state there, its multipliers, and the steps taken.

    Where forces have no potential, such as a controller's, downhill may lead nowhere: Newton's method alone follows.
    Beams come to rest by load steps, if these lead somewhere: their stiffness along them is so large beside that of
    bending that steps downhill are short.

    Raises
    ------
    AnalysisError
        If no equilibrium is found.
    """
    if any(force.flexures for force in statics.mechanism.forces):
        with suppress(AnalysisError):
            return _search_by_load_steps(statics, y)
    try:
        return _search_from(statics, y, near)
    except AnalysisError as error:
        try:
            return _search_from(statics, y, np.inf)
        except AnalysisError:
            raise error from None


def _search_from(statics: S, y: Array, near: float) -> tuple[S, Array, Array, int]:
    """Return the same; steps of Newton's method up to `near` are taken, else those downhill."""
    statics, y, steps = close_nearly(statics, y)
    nothing = statics.all_multipliers(None)
    force, gaps = statics.forces(y, nothing)
    _, rows, stiffness = statics.derivatives(y, nothing)
    even = unit_stiffness(stiffness)
    solve = solver_with_rows(even, rows)
    if solve is None:
        raise AnalysisError("the rows cannot be distinguished: some depend on others near the start")
    work = solve(-force, np.zeros(len(gaps)))[1]
    before = y, work
    # what joints carry, and what acts: forces that cancel leave no measure of themselves
    error, best, shift, first, size = np.inf, np.inf, 0.0, 0.0, statics.acting(y)
    for step in range(steps, MOST_STEPS):
        lam = statics.all_multipliers(work)
        force, gaps = statics.forces(y, lam)
        motion, rows, stiffness = statics.derivatives(y, lam)
        first = first or largest_magnitude(stiffness) or 1.0
        # where joints and forces carry nothing, what each would change by over a thousandth of the mechanism
        stiff = 1e-3 * np.asarray(abs(stiffness).sum(axis=1)).ravel()
        size = np.maximum(size, np.maximum(np.abs(force - rows.T @ work).max(initial=1e-300), stiff))
        error = float((np.abs(force) / size).max(initial=0.0) + np.abs(gaps).max(initial=0.0))
        good = min(error, best) < TOLERANCE
        if good and (error >= 0.5 * best or error <= EXACT):
            # a step that balances no more may lead anywhere
            y, work = before if error > best else (y, work)
            return statics, y, statics.all_multipliers(work), step
        if error < best:
            before, best = (y, work), error
        way = newton_step(statics, motion, solver_with_rows(stiffness, rows), (force, gaps), near)
        if way is None and good:
            return statics, y, lam, step
        if way is None:
            way, shift = _downhill_step(
                statics, (y, work), (motion, even, rows, stiffness), (force, gaps), shift or first
            )
        y, work = statics.move_state(y, motion @ way[0]), work + way[1]
        statics = statics.wind_angles(y)
    raise AnalysisError(
        f"no equilibrium was found from this start: after {MOST_STEPS} steps {error:.3g} of the forces is not "
        "balanced; another start may lead to one"
    )


def _search_by_load_steps(statics: S, y: Array) -> tuple[S, Array, Array, int]:
    """Return the same by load steps: what is not balanced at first is taken away part by part, by Newton's method."""
    statics, y, steps = close_nearly(statics, y)
    force, gaps = statics.forces(y, statics.all_multipliers(None))
    _, rows, stiffness = statics.derivatives(y, statics.all_multipliers(None))
    solve = solver_with_rows(unit_stiffness(stiffness), rows)
    if solve is None:
        raise AnalysisError("the rows cannot be told apart: some depend on others near the start")
    work = solve(-force, np.zeros(len(gaps)))[1]
    first, reached, part = force + rows.T @ work, 0.0, FIRST_LOAD
    while part > LEAST_LOAD and steps < MOST_STEPS:
        share = min(1.0, reached + part)
        now, state, before, within = statics, (y, work), np.inf, False
        for _ in range(CORRECTIONS):
            steps += 1
            force, gaps = now.forces(state[0], now.all_multipliers(state[1]))
            motion, rows, stiffness = now.derivatives(state[0], now.all_multipliers(state[1]))
            solve = solver_with_rows(stiffness, rows)
            change, more = (np.full(1, np.inf), work) if solve is None else solve((1.0 - share) * first - force, -gaps)
            long = length_of_step(now, motion, change) if np.all(np.isfinite(change)) else np.inf
            if not long <= REACH:
                break
            state = now.move_state(state[0], motion @ change), state[1] + more
            now = now.wind_angles(state[0])
            within = long < (FOLLOWED if share < 1.0 else RESTING) or 0.5 * before <= long < ROUNDED
            if within:
                break
            before = long
        if not within:
            part *= 0.25
            continue
        reached, part, statics, (y, work) = share, 2.0 * part, now, state
        if reached == 1.0:
            return statics, y, statics.all_multipliers(work), steps
    raise AnalysisError("no equilibrium was found from this start by load steps")


def close_nearly(statics: S, y: Array) -> tuple[S, Array, int]:
    """Return a position that is nearly closed, and the steps taken: each the shortest one.

    Where rows depend on each other, as those of links in one line, everything is moved a little.
    """
    lam, rng = statics.all_multipliers(None), np.random.default_rng(0)
    for step in range(MOST_STEPS):
        force, gaps = statics.forces(y, lam)
        motion, rows, stiffness = statics.derivatives(y, lam)
        solve = solver_with_rows(unit_stiffness(stiffness), rows)
        if solve is not None and np.linalg.norm(gaps) <= OPENED:
            return statics, y, step
        change = np.full(len(force), np.inf) if solve is None else solve(np.zeros(len(force)), -gaps)[0]
        long = length_of_step(statics, motion, change)
        if not long < SINGULAR:
            change, long = ASTRAY * rng.standard_normal(len(force)), 1.0
        y = statics.move_state(y, motion @ (min(1.0, REACH / max(long, 1e-300)) * change))
        statics = statics.wind_angles(y)
    raise AnalysisError("no equilibrium was found from this start: it cannot be closed; another start may do")


def length_of_step(statics: DenseStatics | Sparse, motion: Any, change: Array) -> float:
    """Return the largest change of a coordinate in a step, in lengths of the mechanism and radians."""
    if not np.all(np.isfinite(change)):
        return np.inf
    return float((np.abs(motion @ change) / statics.lengths).max(initial=0.0))


def newton_step(
    statics: DenseStatics | Sparse, motion: object, solve: Solver | None, right: tuple[Array, Array], near: float
) -> tuple[Array, Array] | None:
    """Return the step of Newton's method, or as much of it as a step may be long, where it is shorter than `near`."""
    if solve is None:
        return None
    change, more = solve(-right[0], -right[1])
    long = length_of_step(statics, motion, change)
    part = min(1.0, REACH / max(long, 1e-300))
    return (part * change, part * more) if long < near else None


def _downhill_step(
    statics: DenseStatics | Sparse,
    at: tuple[Array, Array],
    matrices: tuple[Any, ...],
    right: tuple[Array, Array],
    shift: float,
) -> tuple[tuple[Array, Array], float]:
    """Return a step downhill that is short enough, and the s that the next one is to be tried with."""
    (y, work), (motion, even, rows, stiffness), (force, gaps) = at, matrices, right
    for _ in range(MOST_TRIALS):
        solve = solver_with_rows(stiffness + shift * even, rows)
        if solve is not None:
            change, more = solve(-force, -gaps)
            long = length_of_step(statics, motion, change)
            steep = float(change @ ((stiffness + shift * even) @ change)) if long <= REACH else 0.0
            if steep > 0.0:
                then, opened = statics.forces(
                    statics.move_state(y, motion @ change), statics.all_multipliers(work + more)
                )
                ahead = float(change @ then) <= 0.5 * steep
                if ahead and np.linalg.norm(opened) <= max(OPENED, float(np.linalg.norm(gaps))):
                    return (change, more), shift * min(1.0, max(SLOWER, 0.7 * long / REACH) ** 2)
        shift *= FASTER
    raise AnalysisError("no equilibrium was found from this start: no step leads downhill; another start may do")
