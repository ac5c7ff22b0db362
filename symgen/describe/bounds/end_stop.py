"""Stops: a gap, and a row that is in force where the stop is closed; its force pushes.

The gap of an open stop is watched, and so is the force of a closed one. A stop that other rows keep closed has no
force; the number ``limit`` of its row is 1 then, and nothing of it is watched.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any, ClassVar

from symgen.base.vocabulary.expressions import ONE, ZERO, Expr, Number, Reading, call, difference, sum_of_terms
from symgen.base.vocabulary.measures import Effort, FormulaMeasure, Holonomic, Measure
from symgen.describe.bounded import BoundedRow, RowFamily
from symgen.describe.bounds.bounded_modes import (
    HIT,
    LEAVE,
    bounds_from_carried_force,
    effort_in_force,
    event_of_mode,
    formula_of_closed,
    measure_derivative,
    name_of_number,
    unit_of_effort,
)
from symgen.describe.bounds.dry_friction import bound_at_rate
from symgen.describe.bounds.row import Bounds
from symgen.describe.formulas.formula_text import to_text
from symgen.describe.mechanism import ModeEvent, Output

#: Last words of the names of the stops of a coordinate.
LOWER, UPPER = "lower", "upper"


def _inspection_line(facts: Mapping[str, Any]) -> str:
    """Return the line of `symgen inspect` on a row."""
    closed = f"row {facts['row']} in force where it is closed, pushing [{facts['unit']}]"
    return f"stop {facts['name']}: {closed}; restitution {facts['restitution']}"


STOPS = RowFamily(
    one="stop",
    some="a stop",
    noun="stops",
    in_force="closed",
    off="open",
    part="stops",
    fact="stops",
    named="{}",
    hint="runs and sweeps have them",
    held="while it is closed, {}",
    line=_inspection_line,
)


class GapStop(Bounds, frozen=True):
    """What rigid and elastic stops share: a gap, its names and its row.

    Parameters
    ----------
    name : str
        ``JOINT.lower``, ``JOINT.COORDINATE.upper`` and the like, or the name in the section of stops.
    owner : str
        The joint; the stop itself where a formula is its gap.
    measure : Measure
        The gap is ``measure - value``.
    value : Expr
        A number or an expression of parameters.
    unit : str
        Unit of the gap.
    """

    family: ClassVar[RowFamily] = STOPS

    name: str
    owner: str
    measure: Measure
    value: Expr
    unit: str

    @property
    def label(self) -> str:
        """The name, which no other row has unless it is another piece of the gap."""
        return self.name

    @property
    def row(self) -> str:
        """Name of the row that is in force where the stop is closed; of its force where it gives way."""
        return f"{self.label}.stop"

    @property
    def where(self) -> str:
        """Its place, for messages."""
        return f"stop {self.name}"

    @property
    def held(self) -> Holonomic:
        """The row in force."""
        return Holonomic("stop", self.measure, self.value, self.unit)

    @property
    def place(self) -> tuple[str, Expr]:
        """The gap."""
        return f"gap of {self.label}", difference(Reading(self.label, self.measure), self.value)


class EndStop(GapStop, frozen=True):
    """A stop: a gap that does not become negative, and a force that only pushes.

    Parameters
    ----------
    name, owner, measure, value, unit
        See `GapStop`.
    restitution : Expr
        Rate after an impact over that before, with the other sign; from 0 to 1. A formula may read ``rate``, the size
        of the rate before.
    """

    one_sided: ClassVar[bool] = True

    restitution: Expr = ZERO

    @property
    def along(self) -> str:
        """The coordinate; empty where a formula is the gap."""
        return "" if self.name == self.owner else self.name.rpartition(".")[0]

    @property
    def reversed(self) -> bool:
        """Whether its measure is the coordinate with the other sign."""
        return self.name == f"{self.along}.{UPPER}"

    @property
    def effort(self) -> Effort:
        """The effort by which transitions probe accelerations: the sign of the row, which is 0 in runs."""
        return Effort("stop", self.measure, name_of_number(self, "sign"))

    @property
    def numbers(self) -> tuple[tuple[str, Expr], ...]:
        """The restitution."""
        return ((f"restitution of {self.label}", bound_at_rate(self.restitution, measure_derivative(self))),)

    @property
    def taking(self) -> Expr:
        """The effort that takes energy, a formula of outputs."""
        return effort_in_force(self)

    def rebound(self, rate: Expr) -> Expr:
        """Return the rate of the gap after an impact, the law of impacts: ``-e u`` for a rate u below 0, else 0."""
        part = call("mul", Number(0.5), bound_at_rate(self.restitution, rate))
        return call("mul", part, call("sub", call("abs", rate), rate))

    def events(self, beside: Sequence[BoundedRow]) -> tuple[ModeEvent, ...]:
        """Return the events at which the stop closes or opens.

        The number ``limit`` of a row in force is the bound of the dry friction whose force it carries: before the stop
        opens, that holds it too. The velocity that an impact sets is the rate of the gap: 0 where the sign of the row
        is not 0, and where impacts do not come to rest, that of `rebound`.
        """
        held, sign, limit = (name_of_number(self, number) for number in ("held", "sign", "limit"))
        pulling = sum_of_terms(effort_in_force(self), limit, *bounds_from_carried_force(self, beside))
        closed, rate = formula_of_closed(self), measure_derivative(self)
        open_gap = call("add", call("mul", call("sub", ONE, closed), self.place[1]), closed)
        pushing = call("add", call("mul", held, pulling), call("sub", ONE, held))
        after = call("mul", call("sub", ONE, call("mul", sign, sign)), self.rebound(rate))
        return (
            event_of_mode(self, HIT, open_gap, "gap 0", ((rate, after),)),
            event_of_mode(self, LEAVE, pushing, "force of a closed stop 0"),
        )

    def outputs(self, beside: Sequence[BoundedRow]) -> Iterator[Output]:
        """Yield mode (1 closed, 0 open) and force, which pushes."""
        force: Expr = effort_in_force(self)
        if any(not row.one_sided and row.along == self.along for row in beside):
            force = call("mul", Number(0.5), call("add", force, call("abs", force)))
        yield Output(f"{self.name}.mode", formula_of_closed(self), "")
        yield Output(f"{self.name}.force", force, unit_of_effort(self))

    def facts(self) -> dict[str, Any]:
        """Return what `symgen inspect` says of it."""
        return {"restitution": to_text(self.restitution)}


class PieceOfGap(EndStop, frozen=True):
    """One of the smooth formulas of which the gap of a stop is the least: where it is 0, this one pushes.

    All pieces share the stop's name, with which their events and outputs are called.

    Parameters
    ----------
    piece : int
        Its number, counted from 1.
    """

    piece: int = 1

    @property
    def label(self) -> str:
        """The name with the number of the piece."""
        return f"{self.name}.{self.piece}"

    def outputs(self, beside: Sequence[BoundedRow]) -> Iterator[Output]:
        """Yield mode (1 where any piece is closed) and the sum of the forces, once for all pieces."""
        if self.piece != 1:
            return
        pieces = [row for row in beside if isinstance(row, PieceOfGap) and row.name == self.name]
        closed = [formula_of_closed(row) for row in pieces]
        yield Output(f"{self.name}.mode", call("max", *closed), "")
        yield Output(f"{self.name}.force", sum_of_terms(*map(effort_in_force, pieces)), unit_of_effort(self))


def pieces_of(stop: EndStop, gaps: Sequence[Expr]) -> tuple[EndStop, ...]:
    """Return the rows of a stop whose gap is the least of some formulas: the stop itself where there is one."""
    if len(gaps) == 1:
        return (stop,)
    of = {name: getattr(stop, name) for name in EndStop.__struct_fields__}
    return tuple(
        PieceOfGap(**{**of, "measure": FormulaMeasure(gap)}, piece=number) for number, gap in enumerate(gaps, 1)
    )
