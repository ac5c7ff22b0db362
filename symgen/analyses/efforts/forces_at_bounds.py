"""Forces of rows with bounds along a recorded motion: closed stops and contacts, friction at rest and by reactions.

Along a motion the modes are known: a gap is closed where it is 0 and stays so, and what slides, or begins to, acts
against its way. Forces of closed gaps, and of friction at rest, are free within limits: they spare the actuators most.
A force by a reaction depends on the efforts, which change the reaction, so that both are found in turn.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING

import msgspec
import numpy as np
from numpy.typing import NDArray

from symgen.analyses.efforts.least_efforts import Limits
from symgen.base.errors import plural
from symgen.base.vocabulary.expressions import Expr, Name, Reading, call
from symgen.base.vocabulary.measures import Effort
from symgen.describe.bounded import BoundedRow
from symgen.describe.bounds.bounded_modes import measure_derivative, one_sided_rows, two_sided_rows
from symgen.describe.bounds.by_motion import force_over_reaction, force_without_reaction
from symgen.describe.bounds.by_reaction import rows_bounded_by_reactions
from symgen.describe.bounds.dry_friction import Friction
from symgen.describe.mechanism import Force, Mechanism, Parameter
from symgen.run.compiling.side import compile_side

if TYPE_CHECKING:
    from symgen.run.single.outcome import PrescribedMotion

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]
States = NDArray[np.int64]

#: Suffix of the inputs that represent such forces: not valid in names of a file.
_MARK = "~bound"
#: A gap is closed below this length, in lengths of the mechanism. Rates and accelerations below a part of the largest
#: of any row are none, as are rates below lengths of the mechanism in 1 s, and accelerations below those by forces.
TOUCH, REST, LEAST_RATE = 1e-8, 1e-6, 1e-9
#: Rounds of forces by reactions, and the part of the largest by which they change in the last one.
ROUNDS, SETTLED = 200, 1e-14
#: What a row does at a time: no force of its own, it pushes, it slides or begins to, it holds.
NOTHING, PUSHES, SLIDES, HOLDS = range(4)


@dataclass(frozen=True)
class Contacts:
    """Rows with bounds whose forces are found along a motion.

    Attributes
    ----------
    sliding : tuple of BoundedRow
        Those whose bounds depend on reactions.
    stops : tuple of BoundedRow
        One-sided rows.
    along : tuple of BoundedRow
        Rows along contacts.
    resting : tuple of BoundedRow
        Dry friction whose forces count here at rest, and are forces of the mechanism in motion.
    """

    sliding: tuple[BoundedRow, ...] = ()
    stops: tuple[BoundedRow, ...] = ()
    along: tuple[BoundedRow, ...] = ()
    resting: tuple[BoundedRow, ...] = ()

    @classmethod
    def of_mechanism(cls, mechanism: Mechanism) -> Contacts:
        """Return these rows of a mechanism."""
        along = tuple(row for row in mechanism.bounded if row.signed)
        resting = (row for row in two_sided_rows(mechanism) if isinstance(row, Friction) and not row.pressed)
        return cls(rows_bounded_by_reactions(mechanism), one_sided_rows(mechanism), along, tuple(resting))

    @property
    def apart(self) -> tuple[BoundedRow, ...]:
        """The rows that are no forces of the mechanism in motion."""
        return (*self.sliding, *self.stops, *self.along)

    @property
    def limited(self) -> tuple[BoundedRow, ...]:
        """The rows whose forces are free within limits at times."""
        return (*self.stops, *self.along, *self.resting)

    @property
    def rows(self) -> tuple[BoundedRow, ...]:
        """All of them, those by reactions first."""
        return (*self.sliding, *self.limited)

    @property
    def parameters(self) -> tuple[str, ...]:
        """The inputs that represent their forces."""
        return tuple(f"{row.row}{_MARK}" for row in self.rows)

    def as_inputs(self, mechanism: Mechanism) -> Mechanism:
        """Return a mechanism with their forces as inputs, beside what does not depend on reactions."""
        forces = list[Force]()
        for row, parameter in zip(self.rows, self.parameters, strict=True):
            apart = row not in self.resting
            magnitude = call("add", Name(parameter), force_without_reaction(row)) if apart else Name(parameter)
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
        for row in self.limited:
            formulas += [row.place, *((f"{'rate of ' * k}{row.name}", measure_derivative(row, k)) for k in (1, 2))]
        for row in (*self.along, *self.resting):
            formulas += row.numbers
        for row in self.resting:
            formulas += [
                (f"middle of {row.name} at rest", _middle_at_rest(row)),
                (f"middle of {row.name}", row.middle_of_bounds()),
            ]
        side = compile_side(mechanism, motion.compiled, "bounds", "places of rows with bounds", formulas)
        columns = iter(motion.observe_motion(side.function, len(formulas)).T)
        names, reactions = [row.name for row in motion.compiled.info.rows], list[Reaction]()
        for row in self.sliding:
            factor, rows = next(columns), [names.index(name) for name in row.pressed]
            cosines_of = [[next(columns) for _ in line] for line in row.across]
            reactions.append(Reaction(factor, rows, cosines_of))
        count, k = len(self.limited), len(motion.times)
        places, rates, seconds = (np.zeros((k, count)) for _ in range(3))
        for i in range(count):
            places[:, i], rates[:, i], seconds[:, i] = next(columns), next(columns), next(columns)
        bounds = [(next(columns), next(columns)) for _ in (*self.along, *self.resting)]
        middles = [(next(columns), next(columns)) for _ in self.resting]
        return Along(self, tuple(reactions), *self._states(motion, length, places, rates, seconds), bounds, middles)

    def _states(
        self, motion: PrescribedMotion, length: float, places: Array, rates: Array, seconds: Array
    ) -> tuple[States, Array]:
        """Return what the limited rows do at each time, and the way in which those slide that do."""
        spans = np.array([length if row.unit == "m" else 1.0 for row in self.limited])
        forced = float(np.abs(motion.responses.accelerations).max(initial=0.0))
        still = np.abs(rates) <= spans * max(LEAST_RATE, REST * float(np.abs(rates / spans).max(initial=0.0)))
        steady = np.abs(seconds) <= REST * max(float(np.abs(seconds).max(initial=0.0)), forced, 1e-300)
        states, count = np.zeros(places.shape, dtype=np.int64), len(self.stops)
        shut = (places <= TOUCH * spans) & still & steady
        states[:, :count] = np.where(shut[:, :count], PUSHES, NOTHING)
        ways = np.sign(np.where(still, seconds, rates))
        rows = {row.row: i for i, row in enumerate(self.stops)}
        for i, row in enumerate(self.along, count):
            closed = shut[:, rows[row.pressed[0]]]
            states[:, i] = np.where(closed, np.where(still[:, i] & steady[:, i], HOLDS, SLIDES), NOTHING)
        for i in range(count + len(self.along), len(self.limited)):
            states[:, i] = np.where(still[:, i], np.where(steady[:, i], HOLDS, SLIDES), NOTHING)
        return states, ways


def _middle_at_rest(row: BoundedRow) -> Expr:
    """Return the middle of the bounds at rest."""
    return row.middle_of_bounds() if row.shift is None else call("add", row.middle_of_bounds(), row.shift)


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


#: Takes the forces by reactions; returns multipliers.
Solve = Callable[[Array], Array]


@dataclass(frozen=True)
class Along:
    """Rows with bounds along a motion; arrays have one row a time.

    Attributes
    ----------
    contacts : Contacts
        The rows.
    reactions : tuple of Reaction
        Of the rows by reactions.
    states, ways : Array, shape (k, m)
        What the limited rows do, and in which way those move that slide.
    bounds : list of (Array, Array)
        At rest and in motion, of rows along contacts and of dry friction.
    middles : list of (Array, Array)
        At rest and in motion, of dry friction.
    """

    contacts: Contacts
    reactions: tuple[Reaction, ...]
    states: States
    ways: Array
    bounds: list[tuple[Array, Array]]
    middles: list[tuple[Array, Array]]

    @property
    def limited(self) -> Flags:
        """The times at which a force is within limits."""
        return np.asarray((self.states != NOTHING).any(axis=1))

    def limits_at(self, k: int) -> Limits:
        """Return the limits of forces at a time."""
        contacts, states = self.contacts, self.states[k]
        count, turned, width = len(contacts.limited), list[Array](), list[float]()
        fixed, along = np.zeros(count), len(contacts.stops)
        above = {row.pressed[0]: i for i, row in enumerate(contacts.along, along)}
        for i, stop in enumerate(contacts.stops):
            at = above.get(stop.row, -1)
            if states[i] == PUSHES:
                rest, motion = self.bounds[at - along] if at >= 0 else (np.zeros(0), np.zeros(0))
                holds = at >= 0 and states[at] == HOLDS and rest[k] > 0.0
                for part in (rest[k], -rest[k]) if holds else (-self.ways[k, at] * motion[k] if at >= 0 else 0.0,):
                    turned.append(np.eye(count)[i] + (part * np.eye(count)[at] if at >= 0 else 0.0))
                    width.append(np.inf)
        for i in range(along + len(contacts.along), count):
            bounds, middles = self.bounds[i - along], self.middles[i - along - len(contacts.along)]
            if states[i] == HOLDS:
                fixed[i] = -middles[0][k] - bounds[0][k]
                turned.append(np.eye(count)[i])
                width.append(2.0 * float(bounds[0][k]))
            elif states[i] == SLIDES:
                fixed[i] = -(self.ways[k, i] * bounds[1][k] + middles[1][k])
        return Limits(np.array(turned).reshape(-1, count).T, fixed, np.array(width))

    def solve_forces(self, solve: Solve) -> tuple[Array, list[str]]:
        """Return forces by reactions, and sentences on all rows."""
        forces, apart = np.zeros((len(self.states), len(self.reactions))), np.inf
        for _ in range(ROUNDS if self.reactions else 0):
            multipliers = solve(forces)
            new = np.column_stack([r.force(multipliers) for r in self.reactions])
            apart = float(np.abs(new - forces).max(initial=0.0))
            forces = new
            if apart <= SETTLED * float(np.abs(new).max(initial=0.0)):
                break
        return forces, self._sentences(apart if self.reactions else 0.0, forces)

    def _sentences(self, apart: float, forces: Array) -> list[str]:
        sentences, contacts = list[str](), self.contacts
        for i, row in enumerate(contacts.limited):
            if row in contacts.stops and (times := int((self.states[:, i] == PUSHES).sum())):
                sentences.append(
                    f"{row.name} is closed at {plural(times, 'time')}: efforts are the least with what it can bear"
                )
            elif row not in contacts.stops and (times := int((self.states[:, i] == HOLDS).sum())):
                sentences.append(
                    f"friction of {row.name} is at rest at {plural(times, 'time')}: efforts are the least that it "
                    "allows, and may be from 'lowest' to 'highest'"
                )
        if apart > 1e-9 * float(np.abs(forces).max(initial=0.0)):
            names = ", ".join(row.name for row in self.contacts.sliding)
            sentences.append(f"forces by reactions at {names} are not found: they jam, or nearly do")
        return sentences
