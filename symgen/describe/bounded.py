"""Rows whose force has bounds: what all rooms may ask of one, whatever its kind is."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, Any, Protocol

import msgspec

from symgen.base.vocabulary.expressions import Expr
from symgen.base.vocabulary.measures import Effort, Holonomic, Measure

if TYPE_CHECKING:
    from symgen.describe.mechanism import ModeEvent, Output


class RowFamily(msgspec.Struct, frozen=True):
    """Words for bounded rows of related kinds, in sentences on all that a mechanism has of them.

    Parameters
    ----------
    one, some, noun : str
        What one of them is, without and with an article, and what all are.
    in_force, off : str
        What a row is where it is in force, and where it is off.
    part : str
        Their name among the parts of a mechanism, in digests.
    fact : str
        Their name among the facts of ``symgen inspect``.
    named : str
        Their names in a sentence, a format of one place.
    hint : str
        Where mechanisms with them are taken.
    line : callable
        Facts of a row -> the line of ``symgen inspect`` on it.
    apart : str
        Which key has bounds that do not depend on a reaction; empty where none do.
    held : str
        What a row in force holds, a format of one place.
    """

    one: str
    some: str
    noun: str
    in_force: str
    off: str
    part: str
    fact: str
    named: str
    hint: str
    held: str
    line: Callable[[Mapping[str, Any]], str]
    apart: str = ""


class BoundedRow(Protocol):
    """A row whose force has bounds: off in a part of a run, with an effort in its place.

    Kinds are in `symgen.describe.bounds.kinds`. Within two bounds a force keeps a coordinate at rest; a `one_sided`
    row only pushes, where its measure has the value that it holds.
    """

    @property
    def name(self) -> str:
        """Name, with which the names of its events and outputs begin; several rows may share it."""
        ...

    @property
    def label(self) -> str:
        """Name that no other row has."""
        ...

    @property
    def row(self) -> str:
        """Name of the row that is in force at times."""
        ...

    @property
    def owner(self) -> str:
        """The joint; the row itself where it has none."""
        ...

    @property
    def along(self) -> str:
        """The coordinate of a joint, ``JOINT`` or ``JOINT.COORDINATE``; empty for another measure."""
        ...

    @property
    def reversed(self) -> bool:
        """Whether its measure is the coordinate with the other sign."""
        ...

    @property
    def one_sided(self) -> bool:
        """Whether its force only pushes; its second bound is none."""
        ...

    @property
    def smooth(self) -> bool:
        """Whether a smooth force replaces it."""
        ...

    @property
    def family(self) -> RowFamily:
        """Words for rows of its kind."""
        ...

    @property
    def where(self) -> str:
        """Its place in a file, for messages."""
        ...

    @property
    def measure(self) -> Measure:
        """What it acts along."""
        ...

    @property
    def unit(self) -> str:
        """Unit of the measure."""
        ...

    @property
    def held(self) -> Holonomic:
        """The row in force."""
        ...

    @property
    def effort(self) -> Effort:
        """The effort where the row is off."""
        ...

    @property
    def place(self) -> tuple[str, Expr]:
        """What the row holds at a value, with its words: a coordinate, or a gap."""
        ...

    @property
    def numbers(self) -> tuple[tuple[str, Expr], ...]:
        """Bounds at rest and at the beginning of a motion, or the restitution of a one-sided row, with words."""
        ...

    @property
    def pressed(self) -> tuple[str, ...]:
        """Rows whose forces are what bounds depend on: the reaction of a joint, or a gap's; none where they do not."""
        ...

    @property
    def signed(self) -> bool:
        """Whether what presses is the force of a one-sided row, which has a sign, and not the reaction of a joint."""
        ...

    @property
    def in_contact(self) -> bool:
        """Whether it is a row of a contact: of its gap, or along it."""
        ...

    @property
    def paired(self) -> bool:
        """Whether it is one of two rows along a contact in space, of which the second one follows the first."""
        ...

    @property
    def second(self) -> bool:
        """Whether it is the second one of these."""
        ...

    @property
    def turns(self) -> bool:
        """Whether it is a row of a contact against turning, of which impacts have no impulse."""
        ...

    @property
    def way(self) -> Expr | None:
        """Component of the direction of its motion; None where that is the number ``sign`` of the row."""
        ...

    @property
    def renewed(self) -> Expr | None:
        """The number ``sign`` after a step; None where steps leave it as it is."""
        ...

    @property
    def across(self) -> tuple[tuple[Measure, ...], ...]:
        """Cosines of the axes of `pressed` with directions across the joint; none where these are components."""
        ...

    @property
    def coefficient(self) -> Expr:
        """Bound in motion over the size of the reaction, a formula of ``rate``."""
        ...

    @property
    def without_reaction(self) -> BoundedRow:
        """The row with that part of its effort alone which depends on no reaction."""
        ...

    @property
    def surface(self) -> Expr:
        """How fast a driven surface moves along it, whose rate is the speed of slip on the surface then [m/s]."""
        ...

    @property
    def changing(self) -> bool:
        """Whether its bounds depend on more than parameters."""
        ...

    @property
    def unequal(self) -> bool:
        """Whether its bounds differ in the two directions."""
        ...

    @property
    def shift(self) -> Expr | None:
        """Middle of the bounds at rest less the middle of those in motion; None where it is 0."""
        ...

    def middle_of_bounds(self) -> Expr:
        """Return the force in the middle between the bounds of two directions as a motion begins."""
        ...

    @property
    def taking(self) -> Expr:
        """The effort that takes energy, a formula of outputs."""
        ...

    def events(self, beside: Sequence[BoundedRow]) -> tuple[ModeEvent, ...]:
        """Return the events at which its mode is chosen anew; it may carry the forces of rows beside it."""
        ...

    def outputs(self, beside: Sequence[BoundedRow]) -> Iterator[Output]:
        """Yield its mode and force, beside other rows with bounds."""
        ...

    def facts(self) -> dict[str, Any]:
        """Return what `symgen inspect` says of it, besides its name, row and unit."""
        ...
