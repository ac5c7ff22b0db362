"""Friction by reactions: bounds over the size of a joint's reaction, its components, and the numbers of jamming."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from symgen.base.errors import InputError
from symgen.base.ir.program import JAMMING
from symgen.base.vocabulary.expressions import ONE, ZERO, Call, Expr, Reading, call, scalar_product_of, sum_of_terms
from symgen.base.vocabulary.measures import (
    GROUND,
    Dot,
    Driven,
    FormulaMeasure,
    Holonomic,
    Measure,
    Row,
    Turn,
    axes,
)
from symgen.describe.bounded import BoundedRow
from symgen.describe.mechanism import Joint, Mechanism
from symgen.describe.parts.scope import Scope
from symgen.describe.table_functions import curve_slope

SLIDING = "slides-on"
#: Kinds of joints, in the plane and in space, whose rows of forces are the components of a reaction.
REACTING = ("revolute", "translational", "pin-in-slot", SLIDING)
REACTING_IN_SPACE = ("revolute", "translational", "cylindrical", SLIDING)
#: What the section of jamming numbers of emitted code has.
JAMMING_MEANS = "squares of the parts of a reaction that friction by the reaction itself brings about"


def reacting_rows(scope: Scope, joint: Joint, key: str) -> tuple[str, ...]:
    """Return the rows of a joint whose forces are its reaction.

    Raises
    ------
    InputError
        At the key, if the joint has no such rows.
    """
    kinds = REACTING_IN_SPACE if scope.spatial else REACTING
    own = [row for row in joint.rows if isinstance(row, Holonomic) and row.unit == "m"]
    if joint.kind == SLIDING:  # without those of the slider
        own = own[: scope.dimension]
    rows = tuple(f"{joint.name}.{row.label}" for row in own)
    if not rows or joint.kind not in kinds:
        expected = f"friction by the reaction of a joint among {', '.join(kinds)}"
        raise scope.error(key, expected, f"a {joint.kind} joint")
    return rows


def directions_across(joint: Joint, measure: Measure, pressed: Sequence[str]) -> tuple[tuple[Measure, ...], ...]:
    """Return the cosines of the axes of ground with two directions across the axis of a hinge in space.

    On a curve they are rows of the vector product with its tangent, whose length is the stretch of the curve: so the
    bound along the way is that of a force on the point.
    """
    if joint.kind == SLIDING and pressed:
        slopes = [_slope(row) for row in joint.rows[: len(pressed)]]
        x, y, z = (*slopes, ZERO)[:3]
        minus_x, minus_y, minus_z = (call("neg", each) for each in (x, y, z))
        lines = ((minus_y, x),) if len(slopes) == 2 else ((ZERO, z, minus_y), (minus_z, ZERO, x), (y, minus_x, ZERO))
        return tuple(tuple(FormulaMeasure(each) for each in line) for line in lines)
    if len(pressed) < 3:
        return ()
    assert isinstance(measure, Turn), "a joint with three forces turns about an axis"
    return tuple(tuple(Dot(e, axis) for axis in axes(GROUND, 3)) for e in (measure.zero, measure.quarter))


def _slope(row: Row) -> Expr:
    """Return the derivative by the way of the place on a curve, which a row compares with a point."""
    assert isinstance(row, Holonomic) and isinstance(row.measure, FormulaMeasure), "a row of a point on a curve"
    formula = row.measure.of
    assert isinstance(formula, Call), "a difference"
    return curve_slope(formula.arguments[0])


def reaction_components(row: BoundedRow) -> tuple[Expr, ...]:
    """Return the components of the reaction that bounds depend on."""
    forces = [Reading(each, Driven(each, row.measure)) for each in row.pressed]
    if not row.across:
        return tuple(forces)
    return tuple(
        scalar_product_of(
            forces,
            [
                Reading(f"{row.name}.across{k}{axis}", cosine)
                for axis, cosine in zip("xyz"[: len(line)], line, strict=True)
            ],
        )
        for k, line in enumerate(row.across)
    )


def size_of_reaction(row: BoundedRow) -> Expr:
    """Return the factor of the bounds: the size of the reaction, or 1."""
    parts = reaction_components(row)
    if not parts:
        return ONE
    if len(parts) == 1:
        return call("abs", parts[0])
    squares = [call("mul", part, part) for part in parts]
    return call("sqrt", sum_of_terms(*squares))


def rows_bounded_by_reactions(mechanism: Mechanism) -> tuple[BoundedRow, ...]:
    """Return the rows whose bounds depend on the reaction of a joint."""
    return tuple(row for row in mechanism.bounded if row.pressed and not row.signed)


def pressed_rows(mechanism: Mechanism) -> tuple[BoundedRow, ...]:
    """Return the rows whose bounds depend on forces of other rows: reactions of joints, or forces of gaps."""
    return tuple(row for row in mechanism.bounded if row.pressed)


def tied_impulses(mechanism: Mechanism) -> str:
    """Return what has impulses that depend on others, in words; empty where nothing has."""
    pushing, pressed = [row for row in mechanism.bounded if row.one_sided], rows_bounded_by_reactions(mechanism)
    if any(row.in_contact for row in mechanism.bounded):
        return "contacts"
    if pushing and pressed:
        return f"{pressed[0].family.noun} by reactions beside {pushing[0].family.noun}"
    return "impacts by Poisson's law" if pushing and mechanism.restitution_law != "newton" else ""


def refuse_shared_reactions(row: BoundedRow, repeats: Iterable[tuple[str, str]]) -> None:
    """Refuse bounds over a reaction of which one row repeats another, so that both share it.

    Raises
    ------
    InputError
        With the rows.
    """
    for pair in repeats:
        if set(pair) & set(row.pressed):
            expected = f"a joint whose reaction is determined, for {row.family.one} by it"
            raise InputError(row.where, expected, f"rows {' and '.join(pair)}, the same")


def jamming_names(mechanism: Mechanism) -> dict[str, int]:
    """Return the names of jamming numbers, with their places in the section ``jamming``."""
    return {f"{row.row}.{JAMMING}": i for i, row in enumerate(pressed_rows(mechanism))}
