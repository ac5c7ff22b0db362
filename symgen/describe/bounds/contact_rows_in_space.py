"""Friction along a contact in space: two rows across its gap, whose force together is within a circle.

Both are rows of one ball (`symgen.run.laws.problem`). In motion the force is the coefficient times that of the gap,
against the velocity of slip u: along u / |u|, with the sign of ``s . u``. The numbers ``sign`` of the rows are the
direction s in which the contact slides after each step; by it the force goes on smoothly through u = 0. Near 0 only
rounding has directions: the velocity ``constant`` of the first row along s is added to what u has along it, and out of
rest the velocity ``limit`` as well.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any, ClassVar

import msgspec

from symgen.base.errors import InputError
from symgen.base.ir.program import JAMMING
from symgen.base.vocabulary.expressions import ONE, Expr, Name, Number, call, sum_of_terms
from symgen.base.vocabulary.measures import Nonholonomic, Speed
from symgen.describe.bounded import BoundedRow
from symgen.describe.bounds.bounded_modes import (
    JAM,
    REVERSE,
    SLIP,
    closed_by,
    effort_in_force,
    event_of_mode,
    measure_derivative,
    name_of_number,
)
from symgen.describe.bounds.contact_rows import Tangent
from symgen.describe.mechanism import Mechanism, ModeEvent, Output

#: What is said where friction in space is not taken.
WITHOUT, HINT = "a mechanism without friction of contacts in space", "runs, sweeps, equilibria and modes have it"
#: The direction of slip is renewed where slip has turned by more than the angle with this cotangent.
TURNED = 0.3
#: Slip has a direction above this many times the velocity ``constant``.
CLEAR = 10.0
#: Square of a length that is none, and no divisor of zero.
_NONE = Number(1e-300)


def length_of(parts: Sequence[Expr]) -> Expr:
    """Return the length of a vector, of which the derivative is finite at 0."""
    return call("sqrt", sum_of_terms(*(call("mul", x, x) for x in parts), _NONE))


def refuse_rows_in_pairs(where: str, mechanism: Mechanism) -> None:
    """Refuse friction of contacts in space where runs alone have it.

    Raises
    ------
    InputError
        With the contacts.
    """
    names = dict.fromkeys(row.name for row in mechanism.bounded if row.paired)
    if names:
        raise InputError(where, WITHOUT, f"that of {', '.join(names)}", HINT)


class TangentInSpace(Tangent, frozen=True, kw_only=True):
    """One of the two rows of friction along a contact in space.

    Parameters
    ----------
    measure : Speed
        Velocity of slip along its direction.
    slips : tuple of two Speed
        Those of both rows.
    number : int
        1 or 2.
    part : int
        Number of the part of the surface that it is along, counted from 1; 0 without parts.
    """

    paired: ClassVar[bool] = True

    measure: Any
    slips: tuple[Speed, ...]
    number: int = 1
    part: int = 0

    @property
    def contact(self) -> str:
        """The label of its gap."""
        return f"{self.name}.{self.part}" if self.part else self.name

    @property
    def owner(self) -> str:
        """The label of its gap, which has rows along it in analyses."""
        return self.contact

    @property
    def label(self) -> str:
        """The label of the gap, with the word for the velocity along it and its number."""
        return f"{self.contact}.slip{self.number}"

    @property
    def row(self) -> str:
        """Name of the row that is in force at rest."""
        return f"{self.contact}.tangent{self.number}"

    @property
    def held(self) -> Any:
        """The row in force, of a velocity."""
        return Nonholonomic(f"tangent{self.number}", self.slips[self.number - 1])

    @property
    def second(self) -> bool:
        """Whether it follows the first one."""
        return self.number == 2

    @property
    def rows(self) -> tuple[TangentInSpace, ...]:
        """Both rows."""
        return tuple(
            msgspec.structs.replace(self, measure=slip, number=number) for number, slip in enumerate(self.slips, 1)
        )

    @property
    def moves(self) -> Expr:
        """The formula that is 1 where the contact slides, else 0: components of its direction are not 0."""
        return call("abs", call("sign", name_of_number(self.rows[0], "sign")))

    def mode(self, closed: Expr) -> Expr:
        """Return the formula of the contact's mode in outputs, 2 where it slides, from the formula of a closed gap."""
        return call("add", closed, self.moves)

    @property
    def _slip(self) -> tuple[Expr, ...]:
        """Velocity of slip."""
        return tuple(measure_derivative(row) for row in self.rows)

    def _with_velocity(self, velocity: Sequence[Expr], along: Expr) -> tuple[Expr, ...]:
        """Return a velocity of slip with another one along the direction of the mode added to it."""
        signs = (name_of_number(row, "sign") for row in self.rows)
        return tuple(call("add", u, call("mul", along, s)) for u, s in zip(velocity, signs, strict=True))

    @property
    def _led(self) -> tuple[Expr, ...]:
        """Velocity of slip with what leads it out of rest."""
        return self._with_velocity(self._slip, name_of_number(self.rows[0], "limit"))

    def _along_direction(self, velocity: Sequence[Expr]) -> Expr:
        """Return the component of a velocity of slip along the direction of the mode."""
        signs = (name_of_number(row, "sign") for row in self.rows)
        return sum_of_terms(*(call("mul", s, u) for s, u in zip(signs, velocity, strict=True)))

    @property
    def _ahead(self) -> Expr:
        """The formula that is negative where slip has passed 0, or turned; linear along a line through 0.

        It is the part of the velocity along the direction of the mode, less some of the size of the part across it.
        """
        (s, u), (r, v) = ((name_of_number(row, "sign"), x) for row, x in zip(self.rows, self._slip, strict=True))
        across = call("abs", call("sub", call("mul", s, v), call("mul", r, u)))
        return call("sub", self._along_direction(self._slip), call("mul", Number(TURNED), across))

    @property
    def way(self) -> Expr:
        """Component of the direction of slip; 0 unless the contact slides."""
        side = call("sign", self._along_direction(self._led))
        least = call("mul", side, name_of_number(self.rows[0], "constant"))
        clear = self._with_velocity(self._led, least)
        return call("mul", side, call("div", clear[self.number - 1], length_of(clear)))

    @property
    def renewed(self) -> Expr:
        """The number ``sign`` after a step; it stays where slip is slow, and unless the contact slides."""
        least, own = name_of_number(self.rows[0], "constant"), name_of_number(self, "sign")
        slow = call("lt", length_of(self._slip), call("mul", Number(CLEAR), least))
        return call("where", call("mul", self.moves, call("sub", ONE, slow)), self.way, own)

    def total_effort(self, beside: Sequence[BoundedRow] = ()) -> Expr:
        """Return the effort at rest and in motion along its direction, a formula of outputs."""
        against = call("mul", self.way, call("mul", self.sliding, self.pressing))
        return call("sub", effort_in_force(self), call("add", against, name_of_number(self, "effort")))

    @property
    def taking(self) -> Expr:
        """The effort that takes energy, a formula of outputs: where slip passes 0 it has no jump."""
        own = call("div", self._led[self.number - 1], length_of(self._led))
        against = call("mul", call("mul", self.moves, own), call("mul", self.sliding, self.pressing))
        return call("sub", effort_in_force(self), call("add", against, name_of_number(self, "effort")))

    @property
    def place(self) -> tuple[str, Expr]:
        """Its coordinate, which is 0: velocities of slip are rates of none."""
        return f"slip of {self.name}", measure_derivative(self, 0)

    def events(self, beside: Sequence[BoundedRow]) -> tuple[ModeEvent, ...]:
        """Return the events of both rows: rest ends at the edge of the circle, slip where it is 0 or has turned.

        A closed contact at rest of which other rows carry a part keeps that part of its force.
        """
        if self.number != 1:
            return ()
        closed, moves = closed_by(f"{self.contact}.normal"), self.moves
        forces = [call("sub", effort_in_force(row), name_of_number(row, "effort")) for row in self.rows]
        within = call("sub", call("mul", self.static, self.pressing), length_of(forces))
        within = call("add", within, name_of_number(self, "limit"))
        rests = call("mul", closed, call("sub", ONE, moves))
        resting = call("add", call("mul", rests, within), call("sub", ONE, rests))
        held = call("mul", *(name_of_number(row, "held") for row in self.rows))
        watched = call("mul", call("mul", call("sub", ONE, held), rests), length_of(self._slip))
        still = call("sub", call("sub", ONE, moves), call("mul", call("sub", ONE, held), rests))
        moving = call("sub", call("add", call("mul", moves, self._ahead), still), watched)
        jamming = (Name(f"{row.row}.{JAMMING}") for row in self.rows)
        free = call("sub", ONE, call("add", *jamming))
        return (
            event_of_mode(self, SLIP, resting, "friction at its bound"),
            event_of_mode(self, REVERSE, moving, "rate of slip 0"),
            event_of_mode(self, JAM, free, "jamming number 1"),
        )

    def outputs(self, beside: Sequence[BoundedRow]) -> Iterator[Output]:
        """Yield the size of the friction summed over all parts, and the speed of slip at the nearest one."""
        if self.number != 1 or self.part > 1:
            return
        parts = [row for row in beside if isinstance(row, TangentInSpace) and row.name == self.name and row.number == 1]
        sizes = [length_of([row.total_effort() for row in each.rows]) for each in parts]
        gaps = {row.row: row.place[1] for row in beside if row.one_sided}
        slip, nearest = length_of(self._slip), gaps[self.pressed[0]]
        for row in parts[1:]:
            gap = gaps[row.pressed[0]]
            slip = call("where", call("lt", gap, nearest), length_of(row._slip), slip)
            nearest = call("min", gap, nearest)
        yield Output(f"{self.name}.friction", sum_of_terms(*sizes), "N")
        yield Output(f"{self.name}.slip", slip, "m/s")
