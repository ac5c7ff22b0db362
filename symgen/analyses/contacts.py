"""Forces of rows with bounds along a recorded motion: closed stops, and sliding friction by reactions.

Along a motion the modes are known: a stop is closed where its gap and the rate of it are 0, and friction acts against
the rate. A closed stop pushes as much as spares the actuators. The force of friction by a reaction depends on the
efforts, which change the reaction, so that both are found in turn.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING

import msgspec
import numpy as np
from numpy.typing import NDArray

from symgen.base.errors import counted
from symgen.base.vocabulary.expressions import Expr, Name, Reading, call
from symgen.base.vocabulary.measures import Effort
from symgen.describe.bounded import BoundedRow
from symgen.describe.bounds.dry_friction import Friction
from symgen.describe.bounds.modes import one_sided, rate_of, two_sided
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
#: Rounds of forces of friction, and the part of the largest by which they change in the last one.
ROUNDS, SETTLED = 200, 1e-14
#: What an effort of a closed stop costs beside one of an actuator.
CHEAP = 1e-6


@dataclass(frozen=True)
class Contacts:
    """Rows with bounds whose forces are found along a motion.

    Attributes
    ----------
    frictions : tuple of Friction
        Those whose bounds depend on reactions.
    stops : tuple of BoundedRow
        One-sided rows.
    """

    frictions: tuple[Friction, ...] = ()
    stops: tuple[BoundedRow, ...] = ()

    @classmethod
    def of(cls, mechanism: Mechanism) -> Contacts:
        """Return these rows of a mechanism."""
        pressed = tuple(row for row in two_sided(mechanism) if isinstance(row, Friction) and row.pressed)
        return cls(pressed, one_sided(mechanism))

    @property
    def rows(self) -> tuple[BoundedRow, ...]:
        """All of them, friction first."""
        return (*self.frictions, *self.stops)

    @property
    def parameters(self) -> tuple[str, ...]:
        """The inputs that represent their forces."""
        return tuple(f"{row.row}{_MARK}" for row in self.rows)

    def exerted(self, mechanism: Mechanism) -> Mechanism:
        """Return a mechanism with their forces as inputs; those of friction have its viscous part beside."""
        forces, viscous = list[Force](), {row.row: row.viscous for row in self.frictions}
        for row, parameter in zip(self.rows, self.parameters, strict=True):
            magnitude: Expr = Name(parameter)
            if row.row in viscous:
                magnitude = call("sub", magnitude, call("mul", viscous[row.row], Name("rate")))
            forces.append(Force(parameter, "force", (), (Effort("bound", row.measure, magnitude),)))
        inputs = tuple(Parameter(name, 0.0, "", input=True) for name in self.parameters)
        whole = (*mechanism.parameters, *inputs)
        return msgspec.structs.replace(mechanism, forces=(*mechanism.forces, *forces), parameters=whole)

    def along(self, mechanism: Mechanism, motion: PrescribedMotion, length: float) -> Along:
        """Return what a motion says of them."""
        formulas = list[tuple[str, Expr]]()
        for friction in self.frictions:
            rate = rate_of(friction)
            bound = call("mul", call("sign", rate), friction.bound_in_motion(rate))
            cosines = (cosine for line in friction.across for cosine in line)
            formulas += [(f"{friction.name} against", call("neg", bound))]
            formulas += [(f"{friction.name} across {i}", Reading("", cosine)) for i, cosine in enumerate(cosines)]
        for stop in self.stops:
            formulas += [stop.place, (f"rate of {stop.name}", rate_of(stop))]
        side = compile_side(mechanism, motion.compiled, "bounds", "places of rows with bounds", formulas)
        columns = iter(motion.observed(side.function, len(formulas)).T)
        names, reactions = [row.name for row in motion.compiled.info.rows], list[Reaction]()
        for friction in self.frictions:
            factor, rows = next(columns), [names.index(name) for name in friction.pressed]
            cosines_of = [[next(columns) for _ in line] for line in friction.across]
            reactions.append(Reaction(factor, rows, cosines_of))
        closed = np.zeros((len(motion.times), len(self.stops)), dtype=np.bool_)
        for i, stop in enumerate(self.stops):
            gap, rate_of_gap = next(columns), next(columns)
            near = gap <= TOUCH * (length if stop.unit == "m" else 1.0)
            closed[:, i] = near & (np.abs(rate_of_gap) <= REST * max(np.abs(rate_of_gap).max(), 1e-300))
        return Along(self, tuple(reactions), closed)


@dataclass(frozen=True)
class Reaction:
    """Friction by a reaction along a motion: its force over the size of the reaction, and how that is made of rows."""

    factor: Array
    rows: list[int]
    cosines: list[list[Array]]

    def force(self, multipliers: Array) -> Array:
        """Return the force along the coordinate at each time."""
        parts = [multipliers[:, row] for row in self.rows]
        if self.cosines:
            parts = [sum(np.multiply(c, x) for c, x in zip(line, parts, strict=True)) for line in self.cosines]  # type: ignore[misc]
        force: Array = self.factor * np.sqrt(np.sum(np.square(parts), axis=0))
        return force


#: Takes the forces of friction and which stops push; returns efforts with the forces of stops behind them, and
#: multipliers.
Solve = Callable[[Array, Flags], tuple[Array, Array]]


@dataclass(frozen=True)
class Along:
    """Rows with bounds along a motion; arrays have one row a time."""

    contacts: Contacts
    reactions: tuple[Reaction, ...]
    closed: Flags

    def found(self, solve: Solve) -> tuple[Array, Flags, list[str]]:
        """Return forces of friction, the stops that push, and sentences on both."""
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
        return forces, pushing, list(self._said(apart, forces))

    def _said(self, apart: float, forces: Array) -> list[str]:
        said = list[str]()
        for i, stop in enumerate(self.contacts.stops):
            if times := int(self.closed[:, i].sum()):
                said.append(
                    f"{stop.name} is closed at {counted(times, 'time')}: efforts are the least with what it can bear"
                )
        if apart > 1e-9 * float(np.abs(forces).max(initial=0.0)):
            names = ", ".join(friction.name for friction in self.contacts.frictions)
            said.append(f"forces of friction by reactions ({names}) are not found: they jam, or nearly do")
        return said
