"""Rows of a contact against turning: rolling resistance, and friction of a patch against spin about the normal.

Both are rows as those of slip, of an angular velocity: what bounds their moment is a length times the force of the gap.
Impacts have no impulse of them.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any, ClassVar

from symgen.base.vocabulary.expressions import Expr
from symgen.base.vocabulary.measures import Holonomic, Nonholonomic
from symgen.describe.bounded import BoundedRow
from symgen.describe.bounds.bounded_modes import closed_by, event_of_mode, measure_derivative
from symgen.describe.bounds.contact_rows import Tangent
from symgen.describe.bounds.contact_rows_in_space import TangentInSpace, length_of
from symgen.describe.mechanism import ModeEvent, Output

#: Keys of a contact, with what each turns about.
TORSION, ROLLING = "torsion", "rolling"


def _events_of(row: Tangent, events: Sequence[ModeEvent]) -> tuple[ModeEvent, ...]:
    """Return events of slip with the words for moments."""
    words = {"friction at its bound": "moment at its bound", "rate of slip 0": "angular velocity 0"}
    return tuple(event_of_mode(row, e.word, e.when, words.get(e.text, e.text)) for e in events)


def _outputs_of(row: Tangent, moment: Expr, rate: Expr) -> Iterator[Output]:
    yield Output(f"{row.name}.mode", row.mode(closed_by(f"{row.contact}.normal")), "")
    yield Output(f"{row.name}.moment", moment, "N m")
    yield Output(f"{row.name}.rate", rate, "rad/s")


class _OfContact:
    """What rows against turning have alike."""

    __slots__ = ()
    turns: ClassVar[bool] = True

    name: str

    @property
    def label(self) -> str:
        """The name."""
        return self.name

    @property
    def contact(self) -> str:
        """The name of its gap."""
        return self.name.rpartition(".")[0]

    @property
    def owner(self) -> str:
        """The contact."""
        return self.contact

    @property
    def row(self) -> str:
        """Name of the row that is in force at rest."""
        return self.label

    @property
    def where(self) -> str:
        """Its place in a file."""
        return f"contacts.{self.name}"


class Turning(_OfContact, Tangent, frozen=True, kw_only=True):
    """One row against turning at a contact, in the plane, or about its normal; its name ends with the key."""

    measure: Any
    unit: str = "rad"

    @property
    def held(self) -> Any:
        """The row in force, of an angle, or of a velocity."""
        key = self.name.removeprefix(f"{self.contact}.")
        if key == TORSION:
            return Nonholonomic(key, self.measure, unit="rad/s")
        return Holonomic(key, self.measure, unit=self.unit)

    @property
    def place(self) -> tuple[str, Expr]:
        """Its coordinate."""
        return f"angle of {self.name}", measure_derivative(self, 0)

    def events(self, beside: Sequence[BoundedRow]) -> tuple[ModeEvent, ...]:
        """Return the events at which its mode is chosen anew."""
        return _events_of(self, super().events(beside))

    def outputs(self, beside: Sequence[BoundedRow]) -> Iterator[Output]:
        """Yield mode, moment and angular velocity."""
        return _outputs_of(self, self.total_effort(beside), measure_derivative(self))


class RollingInSpace(_OfContact, TangentInSpace, frozen=True, kw_only=True):
    """One of the two rows against rolling on a plane in space."""

    unit: str = "rad"

    @property
    def label(self) -> str:
        """The name with its number."""
        return f"{self.name}{self.number}"

    @property
    def held(self) -> Any:
        """The row in force, of a velocity."""
        return Nonholonomic(f"{ROLLING}{self.number}", self.slips[self.number - 1], unit="rad/s")

    def events(self, beside: Sequence[BoundedRow]) -> tuple[ModeEvent, ...]:
        """Return the events of both rows."""
        return _events_of(self, super().events(beside))

    def outputs(self, beside: Sequence[BoundedRow]) -> Iterator[Output]:
        """Yield mode, and the sizes of moment and angular velocity."""
        if self.number == 1:
            moment = length_of([row.total_effort() for row in self.rows])
            yield from _outputs_of(self, moment, length_of([measure_derivative(row) for row in self.rows]))


def turning_rows(contact: str, key: str, measures: Sequence[Any], radius: tuple[Expr, Expr]) -> tuple[Tangent, ...]:
    """Return the rows of a key of a contact.

    Parameters
    ----------
    contact, key : str
        Name of the contact, and `TORSION` or `ROLLING`.
    measures : sequence
        Angle or angular velocities, one for each row.
    radius : pair of Expr
        Moment over the force of the gap in motion and at rest [m].
    """
    name, (sliding, static) = f"{contact}.{key}", radius
    if len(measures) == 2:
        one, other = measures
        return RollingInSpace(name=name, sliding=sliding, static=static, measure=one, slips=(one, other)).rows
    return (Turning(name=name, sliding=sliding, static=static, measure=measures[0]),)
