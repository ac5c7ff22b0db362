"""Rows of a contact: a gap with a force that only pushes, and friction along it, which that force bounds.

Both rows have the contact's name. In motion the friction is a fraction of the force of the gap, which laws solve for
(`symgen.derive.lower.drag`); at rest it is a row in force, held as long as its force is within the fraction of at rest.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any, ClassVar

import msgspec

from symgen.base.ir.program import JAMMING
from symgen.base.vocabulary.expressions import ONE, ZERO, Call, Expr, Number, Reading, call, sum_of_terms
from symgen.base.vocabulary.measures import (
    Carrying,
    Driven,
    Effort,
    FormulaSpeed,
    Holonomic,
    Nonholonomic,
)
from symgen.describe.bounded import BoundedRow, RowFamily
from symgen.describe.bounds.bounded_modes import (
    HIT,
    JAM,
    LEAST_BOUND,
    LIFT,
    REVERSE,
    SLIP,
    bounds_from_carried_force,
    carried_bounds,
    closed_by,
    effort_in_force,
    equals_whole_number,
    event_of_mode,
    formula_of_closed,
    measure_derivative,
    name_of_number,
)
from symgen.describe.bounds.end_stop import EndStop
from symgen.describe.bounds.row import Bounds
from symgen.describe.contacts.outlines import Outline
from symgen.describe.formulas.formula_text import to_text
from symgen.describe.mechanism import ModeEvent, Output


def _line_of_gap(facts: Mapping[str, Any]) -> str:
    """Return the line of `symgen inspect` on the gap of a contact."""
    x = facts
    line = (
        f"contact {x['name']}: row {x['row']} in force where it is closed, pushing [N]; restitution {x['restitution']}"
    )
    line += f"; {x['outline']}" if x["outline"] else ""
    if not x.get("closed"):
        return f"{line}; open at the start"
    others = [name for name in x["part"] if name != x["name"]]
    line += f"; closed at the start, {'coupled with ' + ', '.join(others) if others else 'alone'}"
    if x["jamming"] is not None:
        forwards, backwards = x["jamming"]
        line += f", jamming numbers G_NN - s mu G_NT {forwards:.4g} forwards and {backwards:.4g} backwards [1/kg]"
    return line if x["unique"] else f"{line}; forces not unique"


def _line_of_friction(facts: Mapping[str, Any]) -> str:
    """Return the line of `symgen inspect` on the friction of a contact."""
    x = facts
    bounds = f"up to {x['static']} times the force of {x['reaction'][0]}; {x['sliding']} in motion"
    moves = "" if x["surface_speed"] is None else f"; the surface moves at {x['surface_speed']} [m/s]"
    return f"friction of contact {x['name']}: row {x['row']} in force at rest {bounds}{moves}"


CONTACTS = RowFamily(
    one="contact",
    some="a contact",
    noun="contacts",
    in_force="closed",
    off="open",
    part="contacts",
    fact="contacts",
    named="{}",
    hint="runs and sweeps have them",
    held="while it is closed, {}",
    line=_line_of_gap,
)
TANGENTS = RowFamily(
    one="friction of contact",
    some="friction of contacts",
    noun="friction of contacts",
    in_force="at rest",
    off="in motion",
    part="tangents",
    fact="contact_friction",
    named="that of {}",
    hint="runs and sweeps have it",
    held="while it sticks, {} does not change",
    line=_line_of_friction,
)


class Tangent(Bounds, frozen=True):
    """Dry friction along a contact: a coordinate, and a bound that the force of its gap presses.

    Parameters
    ----------
    name : str
        Of the contact.
    measure : Measure or FormulaSpeed
        The slip; its rate where a surface moves by itself.
    sliding, static : Expr
        Bounds in motion and at rest over the force of the gap.
    table : str
        Its table in a file, where that is not an entry of the section.
    alone : bool
        Whether the gap is left out, as in a part of looped code.
    """

    family: ClassVar[RowFamily] = TANGENTS
    signed: ClassVar[bool] = True
    in_contact: ClassVar[bool] = True

    name: str
    measure: Any
    sliding: Expr
    static: Expr
    unit: str = "m"
    table: str = ""
    alone: bool = False

    @property
    def contact(self) -> str:
        """The label of its gap."""
        return self.name

    @property
    def label(self) -> str:
        """The label of the gap, with the word for the coordinate along it."""
        return f"{self.contact}.slip"

    @property
    def row(self) -> str:
        """Name of the row that is in force at rest."""
        return f"{self.contact}.tangent"

    @property
    def owner(self) -> str:
        """The contact, or its part."""
        return self.contact

    @property
    def along(self) -> str:
        """No coordinate of a joint."""
        return ""

    @property
    def where(self) -> str:
        """Its place in a file."""
        return f"{self.table or f'contacts.{self.name}'}.friction"

    @property
    def surface(self) -> Expr:
        """The speed of a surface that moves by itself, which the rate of slip is less [m/s]."""
        of = self.measure.of if isinstance(self.measure, FormulaSpeed) else ZERO
        return of.arguments[1] if isinstance(of, Call) and of.function == "sub" else ZERO

    @property
    def held(self) -> Any:
        """The row in force, of a velocity where a surface moves."""
        if isinstance(self.measure, FormulaSpeed):
            return Nonholonomic("tangent", self.measure)
        return Holonomic("tangent", self.measure, unit=self.unit)

    @property
    def pressed(self) -> tuple[str, ...]:
        """The row of the gap."""
        return () if self.alone else (f"{self.contact}.normal",)

    @property
    def coefficient(self) -> Expr:
        """Bound in motion over the force of the gap."""
        return self.sliding

    @property
    def effort(self) -> Effort:
        """The effort by which transitions probe accelerations; laws solve for that in motion."""
        return Effort("friction", self.measure, call("neg", name_of_number(self, "effort")))

    @property
    def without_reaction(self) -> Tangent:
        """The row without its gap."""
        return msgspec.structs.replace(self, alone=True)

    @property
    def rows(self) -> tuple[Tangent, ...]:
        """The rows of friction along the contact."""
        return (self,)

    def mode(self, closed: Expr) -> Expr:
        """Return the formula of the mode of its contact in outputs, from the formula of a closed gap."""
        sign = name_of_number(self, "sign")
        still = call("mul", closed, call("sub", ONE, call("mul", sign, sign)))
        return call("add", still, call("mul", Number(2.0), sign))

    @property
    def place(self) -> tuple[str, Expr]:
        """The coordinate."""
        return f"slip of {self.name}", measure_derivative(self, 0)

    @property
    def numbers(self) -> tuple[tuple[str, Expr], ...]:
        """Bounds at rest and in motion over the force of the gap."""
        return (
            (f"coefficient of {self.name} at rest", self.static),
            (f"coefficient of {self.name} in motion", self.sliding),
        )

    def total_effort(self, beside: Sequence[BoundedRow] = ()) -> Expr:
        """Return the effort at rest and in motion along the slip, a formula of outputs.

        Where one row in force carries the friction of others beside it, each has an equal part of its bound.
        """
        against = call("mul", name_of_number(self, "sign"), call("mul", self.sliding, self.pressing))
        own = call("add", against, name_of_number(self, "effort"))
        if not any(row.signed and row.row != self.row for row in beside):
            return call("sub", effort_in_force(self), own)
        bound = call("mul", self.static, self.pressing)
        least = call("max", bound, LEAST_BOUND)
        part = call("div", least, call("add", least, carried_bounds(self)))
        share = Reading(f"{self.row}.share", Carrying(self.row, share=True))
        lent = call("mul", call("sign", name_of_number(self, "limit")), call("mul", share, least))
        return call("sub", call("add", call("mul", effort_in_force(self), part), lent), own)

    @property
    def pressing(self) -> Reading:
        """The force of the gap."""
        (row,) = self.pressed
        return Reading(row, Driven(row, self.measure))

    @property
    def taking(self) -> Expr:
        """The effort that takes energy, a formula of outputs."""
        return self.total_effort()

    def events(self, beside: Sequence[BoundedRow]) -> tuple[ModeEvent, ...]:
        """Return the events at which its mode is chosen anew.

        They sleep while the contact is open. A closed contact at rest whose row is not in force, as joints lock it or
        other rows carry it, is watched by its rate. Where several do, it has an effort of its own, which its bound may
        reach; ``limit`` is then what counts as none.
        """
        held, sign, limit = (name_of_number(self, number) for number in ("held", "sign", "limit"))
        bounds = call("mul", self.static, self.pressing), limit, *bounds_from_carried_force(self, beside)
        left = call("sub", sum_of_terms(*bounds), call("abs", effort_in_force(self)))
        off, closed = call("sub", ONE, held), closed_by(f"{self.contact}.normal")
        shares = equals_whole_number(name_of_number(self, "constant"), -1)
        own = call("sub", sum_of_terms(*bounds[:2]), call("abs", name_of_number(self, "effort")))
        apart = call("add", call("sub", ONE, shares), call("mul", shares, own))
        resting = call("add", call("mul", held, left), call("mul", off, apart))
        still = call("sub", ONE, call("mul", sign, sign))
        watched = call("mul", call("mul", off, closed), call("abs", measure_derivative(self)))
        asleep = call("add", held, call("mul", off, call("sub", ONE, closed)))
        moving = sum_of_terms(
            call("mul", sign, measure_derivative(self)), call("mul", still, call("sub", asleep, watched))
        )
        free = call("sub", ONE, name_of_number(self, JAMMING))
        return (
            event_of_mode(self, SLIP, resting, "friction at its bound"),
            event_of_mode(self, REVERSE, moving, "rate of slip 0"),
            event_of_mode(self, JAM, free, "jamming number 1"),
        )

    def outputs(self, beside: Sequence[BoundedRow]) -> Iterator[Output]:
        """Yield the friction, along the slip; what both rows share is reported by the gap."""
        yield Output(f"{self.name}.friction", self.total_effort(beside), "N")
        yield Output(f"{self.name}.slip", measure_derivative(self), "m/s")

    def facts(self) -> dict[str, Any]:
        """Return what `symgen inspect` says of it."""
        speed = None if self.surface == ZERO else to_text(self.surface)
        return {"static": to_text(self.static), "sliding": to_text(self.sliding), "surface_speed": speed}


class ContactGap(EndStop, frozen=True):
    """The gap of a contact: the row of a stop, beside which there may be friction.

    Parameters
    ----------
    tangent : Tangent or None
        The friction along it.
    distance : Expr or None
        The distance that is reported, where the gap is another function of it.
    table : str
        Its table in a file, where that is not an entry of the section.
    outlines : tuple of Outline
        The surfaces, for pictures.
    """

    family: ClassVar[RowFamily] = CONTACTS
    in_contact: ClassVar[bool] = True

    tangent: Tangent | None = None
    distance: Expr | None = None
    table: str = ""
    outlines: tuple[Outline, ...] = ()

    @property
    def row(self) -> str:
        """Name of the row that is in force where the contact is closed."""
        return f"{self.label}.normal"

    @property
    def held(self) -> Holonomic:
        """The row in force."""
        return Holonomic("normal", self.measure, self.value, self.unit)

    @property
    def along(self) -> str:
        """No coordinate of a joint."""
        return ""

    @property
    def where(self) -> str:
        """Its place in a file."""
        return self.table or f"contacts.{self.name}"

    def events(self, beside: Sequence[BoundedRow]) -> tuple[ModeEvent, ...]:
        """Return the events at which the contact closes or opens; an impact sets the rate of slip as well."""
        hit, opens = super().events(beside)
        along = () if self.tangent is None else self.tangent.rows
        reset = (*hit.reset, *((measure_derivative(row), ZERO) for row in along))
        lift = event_of_mode(self, LIFT, opens.when, "force of a closed contact 0")
        return (event_of_mode(self, HIT, hit.when, hit.text, reset), lift)

    def facts(self) -> dict[str, Any]:
        """Return what `symgen inspect` says of it."""
        return {**super().facts(), "outline": "; ".join(outline.words for outline in self.outlines if outline.words)}

    def outputs(self, beside: Sequence[BoundedRow]) -> Iterator[Output]:
        """Yield mode (0 open, 1 closed, and of it with friction 1 at rest, 2 or -2 in motion), force and gap."""
        yield Output(f"{self.name}.mode", self.mode, "")
        yield Output(f"{self.name}.force", effort_in_force(self), "N")
        yield Output(f"{self.name}.gap", self.place[1] if self.distance is None else self.distance, "m")

    @property
    def mode(self) -> Expr:
        """The formula of its mode in outputs."""
        closed: Expr = formula_of_closed(self)
        return closed if self.tangent is None else self.tangent.mode(closed)
