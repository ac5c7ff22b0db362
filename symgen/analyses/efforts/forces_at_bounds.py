"""Forces of rows with bounds along a recorded motion: closed stops, and what slides with bounds by a reaction.

Along a motion the modes are known: a stop is closed where its gap and the rate of it are 0, and what slides acts
against the rate. The force of a closed stop is the one that spares the actuators most. A force by a reaction depends on
the efforts, which change the reaction, so that both are found in turn.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING

import msgspec
import numpy as np
from numpy.typing import NDArray

from symgen.base.errors import plural
from symgen.base.vocabulary.expressions import Expr, Name, Reading, call
from symgen.base.vocabulary.measures import Effort
from symgen.describe.bounded import BoundedRow
from symgen.describe.bounds.bounded_modes import measure_derivative, one_sided_rows
from symgen.describe.bounds.by_motion import force_over_reaction, force_without_reaction
from symgen.describe.bounds.by_reaction import rows_bounded_by_reactions
from symgen.describe.mechanism import Force, Mechanism, Parameter
from symgen.run.compiling.side import compile_side

if TYPE_CHECKING:
    from symgen.run.single.outcome import PrescribedMotion

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]

#: Suffix of the inputs that represent such forces: not valid in names of a file.
_MARK = "~bound"
#: A stop is closed where its gap, of lengths in those of the mechanism, and the rate of it, of the largest, are below.
TOUCH, REST = 1e-8, 1e-6
#: Rounds of forces by reactions, and the part of the largest by which they change in the last one.
ROUNDS, SETTLED = 200, 1e-14
#: What an effort of a closed stop costs beside one of an actuator.
CHEAP = 1e-6


@dataclass(frozen=True)
class Contacts:
    """Rows with bounds whose forces are found along a motion.

    Attributes
    ----------
    sliding : tuple of BoundedRow
        Those whose bounds depend on reactions.
    stops : tuple of BoundedRow
        One-sided rows.
    """

    sliding: tuple[BoundedRow, ...] = ()
    stops: tuple[BoundedRow, ...] = ()

    @classmethod
    def of_mechanism(cls, mechanism: Mechanism) -> Contacts:
        """Return these rows of a mechanism."""
        return cls(rows_bounded_by_reactions(mechanism), one_sided_rows(mechanism))

    @property
    def rows(self) -> tuple[BoundedRow, ...]:
        """All of them, those by reactions first."""
        return (*self.sliding, *self.stops)

    @property
    def parameters(self) -> tuple[str, ...]:
        """The inputs that represent their forces."""
        return tuple(f"{row.row}{_MARK}" for row in self.rows)

    def as_inputs(self, mechanism: Mechanism) -> Mechanism:
        """Return a mechanism with their forces as inputs, beside what does not depend on reactions."""
        forces = list[Force]()
        for row, parameter in zip(self.rows, self.parameters, strict=True):
            magnitude = call("add", Name(parameter), force_without_reaction(row))
            forces.append(Force(parameter, "force", (), (Effort("bound", row.measure, magnitude),)))
        inputs = tuple(Parameter(name, 0.0, "", input=True) for name in self.parameters)
        whole = (*mechanism.parameters, *inputs)
        return msgspec.structs.replace(mechanism, forces=(*mechanism.forces, *forces), parameters=whole)

    def contacts_along_motion(self, mechanism: Mechanism, motion: PrescribedMotion, length: float) -> Along:
        """Return their reactions and closed stops along a motion."""
        formulas = list[tuple[str, Expr]]()
        for row in self.sliding:
            cosines = (cosine for line in row.across for cosine in line)
            formulas += [(f"{row.name} over its reaction", force_over_reaction(row))]
            formulas += [(f"{row.name} across {i}", Reading("", cosine)) for i, cosine in enumerate(cosines)]
        for stop in self.stops:
            formulas += [stop.place, (f"rate of {stop.name}", measure_derivative(stop))]
        side = compile_side(mechanism, motion.compiled, "bounds", "places of rows with bounds", formulas)
        columns = iter(motion.observe_motion(side.function, len(formulas)).T)
        names, reactions = [row.name for row in motion.compiled.info.rows], list[Reaction]()
        for row in self.sliding:
            factor, rows = next(columns), [names.index(name) for name in row.pressed]
            cosines_of = [[next(columns) for _ in line] for line in row.across]
            reactions.append(Reaction(factor, rows, cosines_of))
        closed = np.zeros((len(motion.times), len(self.stops)), dtype=np.bool_)
        for i, stop in enumerate(self.stops):
            gap, rate_of_gap = next(columns), next(columns)
            near = gap <= TOUCH * (length if stop.unit == "m" else 1.0)
            closed[:, i] = near & (np.abs(rate_of_gap) <= REST * max(np.abs(rate_of_gap).max(), 1e-300))
        return Along(self, tuple(reactions), closed)


@dataclass(frozen=True)
class Reaction:
    """A force over the size of a reaction along a motion, and how the reaction is made of rows."""

    factor: Array
    rows: list[int]
    cosines: list[list[Array]]

    def force(self, multipliers: Array) -> Array:
        """Return the force along the coordinate at each time."""
        parts = [multipliers[:, row] for row in self.rows]
        if self.cosines:
            parts = [np.sum(np.multiply(line, parts), axis=0) for line in self.cosines]
        force: Array = self.factor * np.sqrt(np.sum(np.square(parts), axis=0))
        return force


#: Takes the forces by reactions and which stops push; returns efforts, then the forces of stops, and
#: multipliers.
Solve = Callable[[Array, Flags], tuple[Array, Array]]


@dataclass(frozen=True)
class Along:
    """Rows with bounds along a motion; arrays have one row a time."""

    contacts: Contacts
    reactions: tuple[Reaction, ...]
    closed: Flags

    def solve_forces(self, solve: Solve) -> tuple[Array, Flags, list[str]]:
        """Return forces by reactions, the stops that push, and sentences on both."""
        forces = np.zeros((len(self.closed), len(self.reactions)))
        pushing, apart, count = self.closed.copy(), np.inf, self.closed.shape[1]
        for _ in range(ROUNDS):
            efforts, multipliers = solve(forces, pushing)
            pulling = pushing & (efforts[:, efforts.shape[1] - count :] < 0.0)
            new = np.column_stack([np.zeros((len(forces), 0)), *(r.force(multipliers) for r in self.reactions)])
            apart = float(np.abs(new - forces).max(initial=0.0))
            settled = apart <= SETTLED * float(np.abs(new).max(initial=0.0)) and not pulling.any()
            forces, pushing = new, pushing & ~pulling
            if settled:
                break
        return forces, pushing, self._sentences_on_stops(apart, forces)

    def _sentences_on_stops(self, apart: float, forces: Array) -> list[str]:
        sentences = list[str]()
        for i, stop in enumerate(self.contacts.stops):
            if times := int(self.closed[:, i].sum()):
                sentences.append(
                    f"{stop.name} is closed at {plural(times, 'time')}: efforts are the least with what it can bear"
                )
        if apart > 1e-9 * float(np.abs(forces).max(initial=0.0)):
            names = ", ".join(row.name for row in self.contacts.sliding)
            sentences.append(f"forces by reactions at {names} are not found: they jam, or nearly do")
        return sentences
