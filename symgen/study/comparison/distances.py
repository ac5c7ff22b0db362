"""Distances of runs from a reference: of positions, of velocities, and of the reactions that the motion determines."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from symgen.describe.bounds.bounded_modes import two_sided_rows
from symgen.describe.formulas.evaluate import parameter_values
from symgen.result.labelled import Labelled
from symgen.result.points import Points
from symgen.result.reactions import Forces, Seat, seats_of_reactions
from symgen.run.layout import abi
from symgen.run.single.outcome import PrescribedMotion
from symgen.study.comparison.laws import is_resting, rates_along_rows

if TYPE_CHECKING:
    from symgen.describe.mechanism import Mechanism
    from symgen.run.layout.compiled import CompiledModel
    from symgen.run.single.outcome import Outcome
    from symgen.run.starts.assembly import Start
    from symgen.study.references.reference import Reference

Array = NDArray[np.float64]


def reference_reactions(
    mechanism: Mechanism, values: Mapping[str, float], reference: Reference, compiled: CompiledModel, start: Start
) -> dict[str, Array]:
    """Return the reactions of a reference motion, joint by joint, where the motion determines them.

    Parameters
    ----------
    mechanism : Mechanism
        The mechanism.
    values : mapping
        Values of all parameters.
    reference : Reference
        A motion with multipliers.
    compiled, start : CompiledModel, Start
        Code of the geometry, whose D turns multipliers into forces, and a start with the parameters prepared.
    """
    info, k = compiled.info, len(reference.times)
    lam = np.column_stack([np.zeros((k, 0)), *(reference.lam[row.name] for row in info.rows)])
    forces = Forces(_motion_with_multipliers(reference, compiled, start, lam), seats_of_reactions(mechanism, values))
    reactions = forces.reactions(Labelled(lam, tuple(row.name for row in info.rows), ("N",) * info.m))
    return {joint: reactions[joint] for joint in forces.seats if joint not in reference.undetermined}


def reference_rates(mechanism: Mechanism, reference: Reference, compiled: CompiledModel, start: Start) -> Array:
    """Return the rates of coordinates along rows with two bounds of a reference motion, shape (k, n)."""
    lam = np.zeros((len(reference.times), compiled.info.m))
    return rates_along_rows(mechanism, _motion_with_multipliers(reference, compiled, start, lam))


def _motion_with_multipliers(
    reference: Reference, compiled: CompiledModel, start: Start, lam: Array
) -> PrescribedMotion:
    """Return a reference motion with multipliers."""
    info, k = compiled.info, len(reference.times)
    states = np.zeros((k, info.ny))
    states[:, : info.work] = np.column_stack([reference.q, reference.v])
    return PrescribedMotion(
        times=reference.times,
        states=states,
        status_columns=np.zeros((k, abi.N_STATUS + info.kept)),
        compiled=compiled,
        start=start,
        p=start.p,
        w=start.w,
        prescribed_accelerations=np.zeros((k, info.nv)),
        prescribed_multipliers=lam,
    )


@dataclass(frozen=True)
class Distances:
    """Measures of the distance of runs from a reference motion.

    Parameters
    ----------
    mechanism : Mechanism
        The mechanism.
    parameters : mapping
        Values that differ from the mechanism's own.
    reference : Reference
        The reference motion.
    reactions : mapping of str to Array
        Its reactions, `reference_reactions`.
    rates : Array, optional
        Rates of coordinates along rows with two bounds, shape (k, n).
    """

    mechanism: Mechanism
    parameters: Mapping[str, float]
    reference: Reference
    reactions: Mapping[str, Array]
    rates: Array | None = None

    @cached_property
    def points(self) -> Points:
        """Points between which positions and velocities are compared."""
        return Points.of_mechanism(self.mechanism, self._values)

    @cached_property
    def size(self) -> float:
        """The mechanism's length [m]."""
        return self.points.size(self.reference.q)

    @cached_property
    def scale(self) -> float:
        """Length that errors are shares of [m]: the mechanism's, or the range of a motion that is small against it."""
        return self.points.scale_of_errors(self.reference.q)

    @cached_property
    def speed(self) -> float:
        """Largest speed of a point [m/s]."""
        return float(self.points.speed_distances((self.reference.q, self.reference.v)).max(initial=0.0))

    @cached_property
    def load(self) -> float | None:
        """Largest reaction [N], None without one."""
        return float(self._largest_load(self.reactions.values()).max(initial=0.0)) if self.reactions else None

    def position_errors(self, outcome: Outcome) -> Array:
        """Return the largest distance of points at each output [m]."""
        q, _ = outcome.compiled.info.parts(outcome.states)
        return self.points.distances_over_time(q, self.reference.q[: len(q)])

    def velocity_errors(self, outcome: Outcome) -> Array:
        """Return the largest difference of the velocities of points at each output [m/s]."""
        q, v = outcome.compiled.info.parts(outcome.states)
        return self.points.speed_distances((q, v), (self.reference.q[: len(q)], self.reference.v[: len(q)]))

    def reaction_errors(self, outcome: Outcome) -> Array | None:
        """Return the largest difference of reactions at each output [N]; None where no motion determines one.

        Moments count as the forces that have them at the mechanism's length.
        """
        if not self.reactions:
            return None
        forces, k = Forces(outcome, self._seats), len(outcome.times)
        own = forces.reactions(forces.multipliers())
        return self._largest_load(own[joint] - exact[:k] for joint, exact in self.reactions.items())

    def largest_creep(self, outcome: Outcome) -> float | None:
        """Return the largest rate [m/s] along a coordinate of a row with two bounds that rests in the reference.

        Angles count with the mechanism's length. None where none rests.
        """
        if self.rates is None or not self.size > 0.0:
            return None
        lengths = np.array([self.size if row.unit == "rad" else 1.0 for row in two_sided_rows(self.mechanism)])
        where = is_resting(self.rates, self.speed / lengths)
        if not where.any():
            return None
        rates = rates_along_rows(self.mechanism, outcome) * lengths
        return float(np.abs(rates[where]).max())

    @cached_property
    def _values(self) -> dict[str, float]:
        return parameter_values(self.mechanism, self.parameters)

    @cached_property
    def _seats(self) -> Mapping[str, Seat]:
        return seats_of_reactions(self.mechanism, self._values)

    def _largest_load(self, vectors: Iterable[Array]) -> Array:
        """Return the largest force, or moment over the mechanism's length, at each output."""
        n = self.points.dimension
        lengths = list[Array]()
        for vector in vectors:
            lengths.append(np.linalg.norm(vector[:, :n], axis=1))
            if self.size > 0.0:
                lengths.append(np.linalg.norm(vector[:, n:], axis=1) / self.size)
        largest: Array = np.max(lengths, axis=0)
        return largest
