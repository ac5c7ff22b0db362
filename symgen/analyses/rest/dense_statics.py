"""Forces, gaps and their derivatives at a position, with dense matrices."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from symgen.analyses.state.subject import Subject
from symgen.base.errors import AnalysisError
from symgen.run.compiling.linearised import LinearisedState

if TYPE_CHECKING:
    from symgen.describe.mechanism import Mechanism

Array = NDArray[np.float64]

#: Most iterations of Newton's method for states of the file at rest.
MOST_ITERATIONS = 50
#: A change of states beyond this, over their values or 1, comes from slopes that are nearly singular.
ASTRAY_STATE = 1e4


@dataclass(frozen=True)
class DenseStatics:
    """The static problem of a mechanism in dense matrices; velocities of its states are kept.

    Attributes
    ----------
    subject : Subject
        The mechanism.
    held : sequence of (str, float)
        Coordinates held at a value by a force of their own, whose multiplier comes last.
    """

    subject: Subject
    held: Sequence[tuple[str, float]] = ()

    @property
    def mechanism(self) -> Mechanism:
        """The mechanism."""
        return self.subject.mechanism

    @property
    def lengths(self) -> Array:
        """Scales of changes of coordinates, shape (nq,)."""
        return self.subject.lengths

    @property
    def _active(self) -> NDArray[np.bool_]:
        return np.append(~self.subject.redundant, np.ones(len(self.held), dtype=np.bool_))

    def _evaluate_parts(self, y: Array, lam: Array) -> tuple[Array, Array, Array, Array, Array]:
        subject = self.subject
        e, by_position = evaluate_at_balance(subject, y, lam[: subject.m])
        motion, active = e.by("motion", "v"), ~subject.redundant
        rows, gaps = [e.by("velocities", "v")[active]], [e.value("positions")[active]]
        force = e.value("balance")
        for (name, value), multiplier in zip(self.held, lam[subject.m :], strict=True):
            space, at = subject.position(name)
            if space == "q":
                row, now = motion[at], float(y[at])
            else:
                row, now = e.by("functions", "q")[at] @ motion, float(e.value("functions")[at])
            force = force + row * multiplier
            rows.append(row[np.newaxis])
            gaps.append(np.array([now - value]))
        spans, units = subject.spans, self._units_of_unknowns()[self._active]
        stiffness = spans[:, np.newaxis] * (by_position @ motion) * spans
        return (
            spans * force,
            np.concatenate(gaps) / units,
            motion * spans,
            np.vstack(rows) * spans / units[:, np.newaxis],
            stiffness,
        )

    def _units_of_unknowns(self) -> Array:
        """Return the units of rows and held coordinates: a length of the mechanism or 1 rad."""
        units = [self.subject.unit(name) for name, _ in self.held]
        return np.append(self.subject.gaps, [self.subject.length if unit == "m" else 1.0 for unit in units])

    def forces(self, y: Array, lam: Array) -> tuple[Array, Array]:
        """Return the residuals of the force balance D^T lambda - f (with M v' at constant velocities) and of rows."""
        return self._evaluate_parts(y, lam)[:2]

    def derivatives(self, y: Array, lam: Array) -> tuple[Array, Array, Array]:
        """Return N, D of rows that do not depend on others and of what is held, and the stiffness K."""
        return self._evaluate_parts(y, lam)[2:]

    def all_multipliers(self, work: Array | None) -> Array:
        """Return the multipliers of all rows, held quantities last; 0 if nothing is held."""
        multipliers = np.zeros(len(self._active))
        multipliers[self._active] = 0.0 if work is None else work
        return np.asarray(multipliers / self._units_of_unknowns())

    def move_state(self, y: Array, change: Array) -> Array:
        """Return a state whose coordinates are moved by a change."""
        return self.subject.move_state(y, change)

    def acting(self, y: Array) -> Array:
        """Return what acts along each velocity, as work: sums of sizes, which do not cancel where forces balance."""
        return self.subject.spans * self.subject.acting(self.subject.evaluate(y))

    def wind_angles(self, y: Array) -> DenseStatics:
        """Return the same with the angles that count turns as they are at a state less than half a turn away."""
        return replace(self, subject=self.subject.wind_angles(y))


def evaluate_at_balance(subject: Subject, y: Array, lam: Array | None = None) -> tuple[LinearisedState, Array]:
    """Evaluate where the states of the file have come to rest, which are set in `y`; their stiffness is included.

    Returns
    -------
    e : LinearisedState
        The descriptor form there.
    stiffness : Array, shape (nv, nq)
        Derivatives of the balance by q, states of the file following.

    Raises
    ------
    AnalysisError
        If their rates do not determine them.
    """
    e = subject.evaluate(y, lam=lam)
    if not subject.states:
        return e, e.by("balance", "q")
    own = subject.compiled.info.own_states
    for _ in range(MOST_ITERATIONS):
        slopes, rates, extents = e.by("states", "z"), e.value("states"), subject.extents(y)
        change = solve_or_none(slopes, rates)
        if change is None or not np.abs(change / extents).max() < ASTRAY_STATE:
            # singular here, and perhaps not further along the rates
            change = solve_or_none(slopes - np.abs(rates / extents).max() * np.eye(len(rates)), rates)
        if change is None:
            break
        size = float(np.abs(change / subject.extents(y)).max())
        y[own] -= change
        e = subject.evaluate(y, lam=lam)
        if not size > 1e-14:
            break
    following = solve_or_none(e.by("states", "z"), e.by("states", "q"))
    if following is None:
        names = ", ".join(x.name for x in subject.compiled.info.states)
        raise AnalysisError(f"no equilibrium: the rates of the states {names} do not determine them")
    return e, e.by("balance", "q") - e.by("balance", "z") @ following


def solve_or_none(matrix: Array, right: Array) -> Array | None:
    """Return the solution of a system, None where its matrix is singular."""
    try:
        return np.asarray(np.linalg.solve(matrix, right), dtype=np.float64)
    except np.linalg.LinAlgError:
        return None
