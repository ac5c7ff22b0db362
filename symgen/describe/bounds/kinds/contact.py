"""The section ``contacts`` of files: shapes that touch, with friction and impacts along their surfaces."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Any

import msgspec

from symgen.base.vocabulary.expressions import ZERO, Expr, Number, Reading, difference, product
from symgen.base.vocabulary.measures import (
    Angle,
    FormulaMeasure,
    FormulaSpeed,
    Measure,
    RollingSpeed,
    Spin,
    markers_in,
)
from symgen.describe.bounded import BoundedRow
from symgen.describe.bounds.contact_parts import part_of_contact
from symgen.describe.bounds.contact_rows import CONTACTS, TANGENTS, ContactGap, Tangent
from symgen.describe.bounds.contact_rows_in_space import TangentInSpace
from symgen.describe.bounds.contact_rows_turning import ROLLING, TORSION, turning_rows
from symgen.describe.bounds.keys import SectionOfFiles
from symgen.describe.bounds.kinds.stop import read_restitution
from symgen.describe.contacts.among import pairs_among
from symgen.describe.contacts.slopes import slopes_of_places
from symgen.describe.contacts.surfaces import Touch, read_pair
from symgen.describe.contacts.surfaces_in_space import read_pair_in_space
from symgen.describe.parts.fields import Scalar, StateFunction, read_table, value_in_words
from symgen.describe.parts.scope import Scope

#: Largest difference of slopes that are one.
_SAME = 1e-9
#: What is expected of shapes that resist turning.
_ONE_PLACE = "shapes that touch at one place"
#: What is expected where contacts in space have no friction.
_WITHOUT_FRICTION = "no such key beside a formula, or a capsule beside a sphere, which have no friction in space"


class FrictionOfContact(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """Coefficients of friction.

    Parameters
    ----------
    sliding : scalar
        Friction in motion over the force of the contact.
    static : scalar
        The same at rest, at least that in motion; by default the same.
    """

    sliding: Scalar
    static: Scalar | None = None


class ContactSection(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """A contact of two bodies, or of a body and the ground.

    Parameters
    ----------
    among : list of tables or str
        In place of two shapes, a set of any number, of which an outline may be named alone: any two of different bodies
        are a contact ``NAME_ONE_OTHER``, called after their bodies or outlines, numbered where several have one name.
    between : list of two tables
        Shapes, ``{ body = "wheel", at = [0.0, 0.0], disc = 0.3 }`` beside another disc,
        ``{ line = "ground", on = [0.0, 0.0], normal = [0.0, 1.0] }``,
        ``{ body = "table", segment = [[0.0, 0.0], [1.0, 0.0]] }`` or ``{ outline = "cam" }``, of the section of
        outlines. A disc of radius 0 is a point, one below 0 a hole. In space ``{ body = "ball", sphere = 0.1 }``,
        ``{ plane = "ground", on = [0.0, 0.0, 0.0], normal = [0.0, 0.0, 1.0] }``,
        ``{ body = "coin", axis = [0.0, 0.0, 1.0], disc = 0.1 }``, ``{ body = "pill", capsule = [0.1, 0.3] }`` of a
        radius and a length, and ``{ body = "die", box = [0.1, 0.1, 0.1] }``.
    gap : str
        In place of shapes, a formula as that of a stop [m].
    slip : str
        Beside a gap with friction, the formula of a coordinate along the contact [m], whose rate is the speed of slip.
    friction : scalar or table
        Friction over the force of the contact, or ``{ static = 0.4, sliding = 0.3 }``; none by default.
    restitution : scalar
        Rate of the gap after an impact over that before, from 0 to 1; 0 by default.
    torsion : scalar
        In space, radius of a ring that bears [m]: by it friction resists spin about the normal; none by default.
    rolling : scalar
        Moment against rolling over the force of the contact [m]; none by default.
    """

    between: list[dict[str, Any]] | None = None
    among: list[dict[str, Any] | str] | None = None
    gap: StateFunction | None = None
    slip: StateFunction | None = None
    friction: float | str | dict[str, float | str] | None = None
    restitution: Scalar = 0.0
    torsion: Scalar | None = None
    rolling: Scalar | None = None


def read_contact(scope: Scope, raw: object) -> tuple[BoundedRow, ...]:
    """Return the rows of a contact: its gap, and with friction the slip along it.

    Raises
    ------
    InputError
        With the key that is wrong.
    """
    section = read_table(ContactSection, raw, scope.where(""))
    given = [key for key in ("between", "gap", "among") if getattr(section, key) is not None]
    if len(given) != 1:
        got = " and ".join(given) or "none of them"
        raise scope.error("between", "shapes, or the key gap or among in their place", got)
    if section.among is None:
        return _rows_of_pair(scope, section, read_touch(scope, section))
    if section.slip is not None:
        raise scope.error("slip", "no such key beside among, whose shapes have one", value_in_words(section.slip))
    found, read = list[BoundedRow](), read_pair_in_space if scope.spatial else read_pair
    for pair in pairs_among(scope, "among", section.among):
        own = Scope(scope.context, scope.path, pair.name)
        found += _rows_of_pair(own, section, read(own, "among", list(pair.between), pair.places))
    return tuple(found)


def _rows_of_pair(scope: Scope, section: ContactSection, touch: Touch) -> tuple[BoundedRow, ...]:
    """Return the rows of a contact of two shapes, or of formulas."""
    *rows, gap = rows_of_contact(scope, "", scope.name, touch, section.friction, section.restitution)
    return (*rows, *_rows_against_turning(scope, section, touch, rows), gap)


def _rows_against_turning(
    scope: Scope, section: ContactSection, touch: Touch, rows: list[BoundedRow]
) -> Iterator[Tangent]:
    """Yield the rows of torsion and of rolling."""
    for key, given in ((TORSION, section.torsion), (ROLLING, section.rolling)):
        if given is None:
            continue
        got, slip = value_in_words(given), rows[0] if rows else None
        if not isinstance(slip, Tangent):
            raise scope.error(key, "the key friction beside it", got)
        radius = scope.constant(key, given)
        if scope.value(radius, key) < 0.0:
            raise scope.error(key, "a length of at least 0", repr(scope.value(radius, key)))
        about = _measures_of_turning(scope, key, got, touch)
        coefficients = (radius, radius)
        if key == TORSION:
            coefficients = (product(slip.sliding, radius), product(slip.static, radius))
        yield from turning_rows(scope.name, key, about, coefficients)


def _measures_of_turning(scope: Scope, key: str, got: str, touch: Touch) -> tuple[Measure | FormulaSpeed, ...]:
    """Return the angle, or the angular velocities, that a key is about.

    Raises
    ------
    InputError
        If shapes have none.
    """
    if not scope.spatial:
        bodies = tuple(dict.fromkeys(marker.body for marker in markers_in(touch.gap)))
        if key == TORSION or touch.further or len(bodies) != 2:
            raise scope.error(key, "no such key in the plane" if key == TORSION else _ONE_PLACE, got)
        return (Angle(*bodies),)
    slips = [slip for slip in touch.slips if isinstance(slip, RollingSpeed)]
    if not slips or touch.further:
        raise scope.error(key, f"{_ONE_PLACE}: a sphere or a rim on a plane", got)
    ways = [slips[0].normal] if key == TORSION else [slip.along for slip in slips]
    a, b = slips[0].normal.body, slips[0].centre.body
    rates = (Reading(f"{scope.name}.{key}{i}.rate", Spin(a, b, way), 1) for i, way in enumerate(ways, 1))
    return tuple(map(FormulaSpeed, rates))


def rows_of_contact(
    scope: Scope, key: str, name: str, touch: Touch, friction: object, restitution: float | str
) -> tuple[BoundedRow, ...]:
    """Return the rows of a contact with some name, whose keys are in a table at `key`."""
    rows = _rows_of_touch(scope, key, name, touch, friction, restitution)
    if not touch.further:
        return rows
    gaps = [_rows_of_touch(scope, key, name, part, friction, restitution)[-1] for part in (touch, *touch.further)]
    parts = [part_of_contact(gap, number) for number, gap in enumerate(gaps, 1) if isinstance(gap, ContactGap)]
    return tuple(row for part in parts for row in part)


def _rows_of_touch(
    scope: Scope, key: str, name: str, touch: Touch, friction: object, restitution: float | str
) -> tuple[BoundedRow, ...]:
    """Return the rows of a contact of one part, the gap last."""
    within = f"{key}." if key else ""
    law = read_restitution(scope, f"{within}restitution", restitution)
    if touch.changes_rows and restitution != 0.0:
        expected = "no restitution where arcs of two outlines touch"  # some runs had an impact where parts change
        raise scope.error(f"{within}restitution", expected, value_in_words(restitution))
    if friction is None and touch.surfaces:
        raise scope.error(f"{within}friction", "friction, by which a surface that moves acts", "no such key")
    tangent = None if friction is None else _read_friction(scope, f"{within}friction", name, touch, friction)
    table = f"joints.{scope.name}.{key}" if key else ""
    if tangent is not None and table:
        tangent = msgspec.structs.replace(tangent, table=table)
    gap = ContactGap(name, name, touch.gap, touch.value, "m", law, tangent, touch.distance, table, touch.outlines)
    return (gap,) if tangent is None else (*tangent.rows, gap)


def _read_friction(scope: Scope, key: str, name: str, touch: Touch, raw: object) -> Tangent:
    """Return the friction of a contact."""
    table = {"sliding": raw} if not isinstance(raw, dict) else raw
    given = read_table(FrictionOfContact, table, scope.where(key))
    at = {"sliding": key if table is not raw else f"{key}.sliding", "static": f"{key}.static"}
    sliding = scope.constant(at["sliding"], given.sliding)
    static = sliding if given.static is None else scope.constant(at["static"], given.static)
    sizes = {word: scope.value(e, at[word]) for word, e in (("sliding", sliding), ("static", static))}
    for word, size in sizes.items():
        if size < 0.0:
            raise scope.error(at[word], "a value of at least 0", repr(size))
    if sizes["static"] < sizes["sliding"]:
        raise scope.error(
            at["static"], f"a value of at least that of sliding ({sizes['sliding']!r})", repr(sizes["static"])
        )
    if scope.spatial:
        if not touch.slips:
            raise scope.error(key, _WITHOUT_FRICTION, value_in_words(raw))
        slips = _over_surfaces(name, touch.slips, touch.surfaces)
        return TangentInSpace(name=name, measure=slips[0], sliding=sliding, static=static, slips=slips)
    if touch.slip is None:
        raise scope.error(key, "no friction along teeth, of which several touch", value_in_words(raw))
    (slip,) = _over_surfaces(name, (touch.slip,), touch.surfaces)
    return Tangent(name, slip, sliding, static)


def _over_surfaces(name: str, slips: tuple[Any, ...], speeds: tuple[Expr, ...]) -> tuple[Any, ...]:
    """Return slips as rates over surfaces that move by themselves."""
    if not speeds:
        return slips
    return tuple(
        FormulaSpeed(difference(Reading(f"{name}.slip{i}.rate", slip, 1), speed))
        for i, (slip, speed) in enumerate(zip(slips, speeds, strict=True), 1)
    )


def read_touch(scope: Scope, section: ContactSection) -> Touch:
    """Return gap and slip of a contact, from shapes or from formulas."""
    if section.between is not None:
        if section.slip is not None:
            raise scope.error("slip", "no such key beside between, whose shapes have one", value_in_words(section.slip))
        return (read_pair_in_space if scope.spatial else read_pair)(scope, "between", section.between)
    assert section.gap is not None, "one of both keys is there"
    if scope.spatial and section.friction is not None:
        raise scope.error("friction", _WITHOUT_FRICTION, value_in_words(section.friction))
    of = scope.of_row("gap", section.gap, speeds=False, inputs=True)
    if section.friction is None:
        if section.slip is not None:
            raise scope.error("slip", "the key friction beside it", value_in_words(section.slip))
        return Touch(FormulaMeasure(of), ZERO, FormulaMeasure(of))
    if section.slip is None:
        raise scope.error("slip", "a coordinate along the contact, as it has friction", "no such key")
    along = scope.of_row("slip", section.slip, speeds=False, inputs=True)
    return Touch(FormulaMeasure(_with_unit_slope(scope, of)), ZERO, FormulaMeasure(along), of)


def _with_unit_slope(scope: Scope, gap: Expr) -> Expr:
    """Return a gap over the length of its derivative by the place of a body, so that its force is the contact's.

    Raises
    ------
    InputError
        If bodies differ in that length, or it is no number.
    """
    slopes = slopes_of_places(gap)
    if slopes is None:
        expected = "a gap that is linear in places of bodies, where friction is over its force"
        raise scope.error("friction", expected, "another one", "shapes in 'between' have such a gap")
    lengths = {body: math.hypot(*slope) for body, slope in slopes.items() if any(slope)}
    if not lengths:
        return gap
    (one, length), *others = lengths.items()
    for other, size in others:
        if abs(size - length) > _SAME * length:
            got = f"{length:.6g} for '{one}' and {size:.6g} for '{other}'"
            raise scope.error("friction", "a gap that changes equally with the place of each body", got)
    return gap if abs(length - 1.0) <= _SAME else product(Number(1.0 / length), gap)


KIND = SectionOfFiles("contacts", CONTACTS, ContactSection, read_contact, (TANGENTS,))
