"""Modes of rows with bounds: their numbers, the words of their events, and mechanisms with and without such rows.

A row with bounds is in force in some modes (`symgen.base.ir.program.MODES`), and has an effort where it is off. The
numbers of the row are names of formulas: ``ROW.held``, ``.sign`` and ``.limit``. Where the bounds depend on a joint's
reaction, laws solve for the effort in motion (`symgen.derive.lower.drag`), and ``ROW.jamming`` is the square of the
part of the reaction that the effort itself brings about.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence

import msgspec

from symgen.base.errors import InputError
from symgen.base.ir.program import MODE_NUMBERS, MODES
from symgen.base.vocabulary.expressions import ONE, ZERO, Expr, Name, Number, Reading, call, readings_in
from symgen.base.vocabulary.measures import Carrying, Driven, Integral
from symgen.describe.bounded import BoundedRow, RowFamily
from symgen.describe.mechanism import Mechanism, ModeEvent, Output

#: Action of events at which modes are chosen anew.
MODE = "mode"
#: Last words of their names: rest ends, a rate passes zero, rest begins.
SLIP, REVERSE, STICK = "slip", "reverse", "stick"
#: Last word of the event at which an effort by a reaction would bring about all of the reaction itself.
JAM = "jam"
#: Last words of the names of events of one-sided rows: an impact, the row comes into force, it is off again.
HIT, REST, LEAVE = "hit", "rest", "leave"
#: Last word of the event at which a contact opens.
LIFT = "lift"
#: Bound in place of none, by which forces may be divided [N].
LEAST_BOUND = Number(1e-300)


# -- formulas of one row -----------------------------------------------------------------------------------------------


def name_of_number(row: BoundedRow, number: str) -> Name:
    """Return the name of a number of a row with bounds."""
    return Name(f"{row.row}.{number}")


def effort_in_force(row: BoundedRow) -> Reading:
    """Return the effort of the row, 0 where it is off."""
    return Reading(row.row, Driven(row.row, row.measure))


def bounds_from_carried_force(row: BoundedRow, beside: Sequence[BoundedRow]) -> tuple[Expr, ...]:
    """Return what a row in force adds to its bound for rows whose force it carries, where bounds vary.

    Constant bounds of these are in the number ``limit`` of the row. Of a carried row the number ``constant`` is the
    place of its carrier, counted from 1, and ``limit`` is the largest force of the carrier for each of its own. All
    friction that gaps press is one number, whose sums for all rows are found together: written out in each row, they
    would grow with the square of the rows.
    """
    place = next(i for i, other in enumerate(beside, 1) if other.row == row.row)
    terms = list[Expr]()
    # of two rows along a contact none carries another one's
    if any(other.signed and not other.paired and other.row != row.row for other in beside):
        terms.append(carried_bounds(row))
    for other in beside:
        if other.changing and not other.pressed and other.row != row.row:
            held, constant, limit = (name_of_number(other, number) for number in ("held", "constant", "limit"))
            carries = call("mul", call("sub", ONE, held), equals_whole_number(constant, place))
            terms.append(call("mul", call("mul", carries, limit), other.numbers[0][1]))
    return tuple(terms)


def carried_bounds(row: BoundedRow) -> Reading:
    """Return the sum of the bounds at rest, by forces of gaps, of the rows that a row in force carries."""
    return Reading(f"{row.row}.carried", Carrying(row.row))


def equals_whole_number(number: Expr, value: int) -> Expr:
    """Return the formula that is 1 where a whole number has a value, and 0 where it has another one."""
    return call("max", ZERO, call("sub", ONE, call("abs", call("sub", number, Number(float(value))))))


def formula_of_closed(row: BoundedRow) -> Expr:
    """Return the formula that is 1 where a one-sided row is closed, else 0."""
    return closed_by(row.row)


def closed_by(row: str) -> Expr:
    """Return the formula that is 1 where the one-sided row of some name is closed, else 0."""
    held, limit = Name(f"{row}.held"), Name(f"{row}.limit")
    return call("add", held, call("mul", call("sub", ONE, held), limit))


def measure_derivative(row: BoundedRow, order: int = 1) -> Reading:
    """Return a derivative of the measure."""
    return Reading(f"{row.label}{'.rate' * order}", row.measure, order)


def unit_of_effort(row: BoundedRow) -> str:
    """Return the unit of its force."""
    return "N m" if row.unit == "rad" else "N"


# -- rows of a mechanism -----------------------------------------------------------------------------------------------


def places_of_first_modes(mechanism: Mechanism) -> Iterator[tuple[str, int]]:
    """Yield joints whose rows may be off, then rows with bounds, with the place of their first number of modes."""
    first = 0
    for joint in mechanism.joints:
        if joint.name in mechanism.switchable:
            yield joint.name, first
            first += MODE_NUMBERS * len(joint.rows)
    for bounded in mechanism.bounded:
        yield bounded.row, first
        first += MODE_NUMBERS


def mode_names(mechanism: Mechanism) -> dict[str, int]:
    """Return the names of the numbers of rows with bounds, with their places in the section ``modes``."""
    places = dict(places_of_first_modes(mechanism)) if mechanism.bounded else {}
    return {
        f"{bounded.row}.{number}": places[bounded.row] + i
        for bounded in mechanism.bounded
        for i, number in enumerate(MODES)
    }


def two_sided_rows(mechanism: Mechanism) -> tuple[BoundedRow, ...]:
    """Return the rows whose force has two bounds."""
    return tuple(row for row in mechanism.bounded if not row.one_sided)


def one_sided_rows(mechanism: Mechanism) -> tuple[BoundedRow, ...]:
    """Return the rows whose force only pushes."""
    return tuple(row for row in mechanism.bounded if row.one_sided)


def coordinate_of(mechanism: Mechanism, row: BoundedRow) -> str:
    """Return the name of the coordinate of a joint that a row is along."""
    joint = mechanism.joint_named(row.owner)
    return next(f"{joint.name}.{label}" for label, measure in joint.coordinates if measure == row.measure)


def event_of_mode(
    row: BoundedRow, word: str, when: Expr, text: str, reset: tuple[tuple[Expr, Expr], ...] = (), way: str = "falling"
) -> ModeEvent:
    """Return an event of a row: the last word of its name, its switching function, its text and what it sets."""
    return ModeEvent(f"{row.name}.{word}", when, way, MODE, reset, text, word)


def mode_events(mechanism: Mechanism) -> tuple[ModeEvent, ...]:
    """Return the events at which modes are chosen anew. A function of another mode is 1: it sleeps."""
    return tuple(
        msgspec.structs.replace(event, row=number)
        for number, row in enumerate(mechanism.bounded)
        for event in row.events(mechanism.bounded)
    )


def bounded_outputs(rows: Sequence[BoundedRow]) -> Iterator[Output]:
    """Yield mode and force of each row."""
    for row in rows:
        yield from row.outputs(rows)


def with_bounded_outputs(mechanism: Mechanism) -> Mechanism:
    """Return a mechanism that reports modes and forces of its rows with bounds."""
    if not mechanism.bounded:
        return mechanism
    return msgspec.structs.replace(mechanism, outputs=(*mechanism.outputs, *bounded_outputs(mechanism.bounded)))


def without_bounds(mechanism: Mechanism, rows: Sequence[BoundedRow] | None = None) -> Mechanism:
    """Return a mechanism without its rows with bounds, or some of them, and what it reports of all."""
    left = () if rows is None else tuple(row for row in mechanism.bounded if row not in rows)
    if len(left) == len(mechanism.bounded):
        return mechanism
    outputs = _outputs_without(mechanism, bounded_outputs(mechanism.bounded))
    return msgspec.structs.replace(mechanism, bounded=left, outputs=outputs)


def _outputs_without(mechanism: Mechanism, reports: Iterable[Output]) -> tuple[Output, ...]:
    """Return the outputs of a mechanism without some reports, and without integrals of what they report."""
    reported = {output.name: None for output in reports}
    rows = {bounded.row for bounded in mechanism.bounded}

    def rows_read_by(value: Expr) -> bool:
        sources = [reading.source for reading in readings_in(value)]
        inner = [source.of for source in sources if isinstance(source, Integral)]
        return any(isinstance(s, Driven) and s.row in rows for s in sources) or any(map(rows_read_by, inner))

    return tuple(o for o in mechanism.outputs if o.name not in reported and not rows_read_by(o.value))


def rows_by_family(mechanism: Mechanism) -> dict[RowFamily, tuple[BoundedRow, ...]]:
    """Return the rows with bounds of a mechanism by their families, in their order."""
    families = dict.fromkeys(row.family for row in mechanism.bounded)
    return {family: tuple(row for row in mechanism.bounded if row.family == family) for family in families}


def refuse_bounds(where: str, mechanism: Mechanism) -> None:
    """Refuse a mechanism with rows with bounds where nothing chooses their modes.

    Raises
    ------
    InputError
        If it has any.
    """
    for family, rows in rows_by_family(mechanism).items():
        names = ", ".join(dict.fromkeys(row.name for row in rows))
        raise InputError(where, f"a mechanism without {family.noun}", family.named.format(names), family.hint)
