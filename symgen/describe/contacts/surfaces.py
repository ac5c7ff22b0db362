"""Shapes of contacts: a disc of a body or an outline, and what it meets, which is read where the pair is."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

import msgspec

from symgen.base.errors import quote, suggest
from symgen.base.registry import Registry
from symgen.base.vocabulary.expressions import JUMPING, ZERO, Call, Expr, call, sum_of_terms
from symgen.base.vocabulary.measures import GROUND, Angle, FormulaSpeed, Marker, Measure, Speed, Sum, nested_parts
from symgen.describe.contacts.chains import BodyOutline
from symgen.describe.contacts.outlines import Outline
from symgen.describe.parts.fields import Point, Scalar, TimeFunction, read_table, value_in_words
from symgen.describe.parts.scope import Scope

#: The words for the shapes of which each pair has one.
DISC, OUTLINE = "disc", "outline"


class DiscTable(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """A disc: a point where its radius is 0, a hole where it is below 0.

    Parameters
    ----------
    body : str
        Its body, or ``"ground"``.
    at : point
        Its centre; the origin of the body by default.
    disc : scalar
        Its radius [m].
    """

    body: str
    at: Point = (0.0, 0.0)
    disc: Scalar = 0.0


class OutlineTable(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """An outline.

    Parameters
    ----------
    outline : str
        Its name in the section of outlines.
    surface_speed : scalar
        Speed with which its surface moves along it, as a belt does, the free side on the left [m/s]: a number or a
        formula of t.
    """

    outline: str
    surface_speed: TimeFunction | None = None


class Disc(msgspec.Struct, frozen=True):
    """A disc: its centre, its radius with the sign of the file, and its number."""

    centre: Marker
    radius: Expr
    size: float

    @property
    def body(self) -> str:
        """Its body."""
        return self.centre.body

    @property
    def outline(self) -> Outline:
        """Its outline."""
        return Outline((self.centre,), self.radius)


class Touch(msgspec.Struct, frozen=True):
    """What a pair of shapes is: its gap [m], the coordinate along it [m], and the bodies.

    Parameters
    ----------
    gap : Measure
        Distance of the shapes less `value`, with a derivative of length 1 over either body's place where they touch.
    value : Expr
        Where the shapes touch.
    slip : Measure, FormulaSpeed or None
        Coordinate whose rate is the speed of one surface along the other, or that speed; None where nothing rubs.
    distance : Expr or None
        The distance that is reported, where the gap is another function of it.
    outlines : tuple of Outline
        The surfaces, for pictures.
    further : tuple of Touch
        The same of other smooth parts of a surface, which are in touch apart from this one.
    slips : tuple of two Speed, or empty
        In space, in place of `slip`, the velocity of the second surface along the first one; empty where nothing rubs.
    changes_rows : bool
        Whether a contact passes from one part to another one while it is closed, as arcs of two outlines do.
    surfaces : tuple of Expr
        How fast the surfaces move along the slip, or the two slips, by themselves [m/s]; empty where none does.
    """

    gap: Measure
    value: Expr
    slip: Measure | FormulaSpeed | None
    distance: Expr | None = None
    outlines: tuple[Outline, ...] = ()
    further: tuple[Touch, ...] = ()
    slips: tuple[Speed, Speed] | tuple[()] = ()
    changes_rows: bool = False
    surfaces: tuple[Expr, ...] = ()

    def moved(self, *speeds: Expr) -> Touch:
        """Return the same of surfaces that move by themselves."""
        if all(speed == ZERO for speed in speeds):
            return self
        parts = tuple(part.moved(*speeds) for part in self.further)
        return msgspec.structs.replace(self, further=parts, surfaces=speeds)


class Pair(msgspec.Struct, frozen=True):
    """A pair of shapes: a disc or an outline, and another one.

    Parameters
    ----------
    word : str
        The key that names the other shape.
    table : type
        The table of the other shape.
    read : callable
        Scope, key of the other shape, its table and the disc or outline -> `Touch`.
    body : callable or None
        Table of the other shape -> its body; None where the table has it not, and reading asks for two bodies.
    beside : str
        The word for the shape that it is beside.
    """

    word: str
    table: type[msgspec.Struct]
    read: Callable[[Scope, str, Any, Any], Touch]
    body: Callable[[Any], str] | None
    beside: str = DISC


PAIRS: Registry[Pair] = Registry("symgen.describe.contacts.pairs", "pair of shapes")


def read_disc(scope: Scope, key: str, table: DiscTable) -> Disc:
    """Return a disc from its table."""
    body = scope.body(f"{key}.body", table.body)
    centre = scope.marker(f"{key}.at", body, table.at)
    radius = scope.constant(f"{key}.disc", table.disc)
    return Disc(centre, radius, scope.value(radius, f"{key}.disc"))


def outline_named(scope: Scope, key: str, table: OutlineTable) -> BodyOutline:
    """Return the outline with the name of a table."""
    outlines, name = scope.context.outlines, table.outline
    if name not in outlines:
        hint = suggest(name, outlines)
        raise scope.error(f"{key}.outline", "the name of an outline", f"the unknown outline {quote(name)}", hint)
    return outlines[name]


#: Word for the shape that a pair has -> its table, and how the shape is read from it.
SHAPES: Mapping[str, tuple[type[msgspec.Struct], Callable[[Scope, str, Any], Disc | BodyOutline]]] = {
    DISC: (DiscTable, read_disc),
    OUTLINE: (OutlineTable, outline_named),
}


def read_pair(scope: Scope, key: str, raw: object, places: tuple[int, int] = (0, 1)) -> Touch:
    """Return gap and slip of two shapes, whose places in the list of a key are those in a file.

    Raises
    ------
    InputError
        With the shape that is wrong.
    """
    tables = two_tables(scope, key, raw, "{ body = BODY, disc = RADIUS }")
    pairs = {(pair.beside, pair.word): pair for _, pair in PAIRS.items()}
    words = dict.fromkeys(word for _, word in pairs)
    keys = [f"{key}[{i}]" for i in places]
    kinds = [word_of_shape(scope, keys[i], table, words, DiscTable, DISC) for i, table in enumerate(tables)]
    first = next((i for i in (0, 1) if (kinds[i], kinds[1 - i]) in pairs), None)
    if first is None:
        if OUTLINE in kinds:
            other = kinds[1 - kinds.index(OUTLINE)]
            raise scope.error(key, "a disc, a line or an outline beside an outline", f"a {other}")
        raise scope.error(key, "a disc, or a point, beside another shape", f"a {kinds[0]} and a {kinds[1]}")
    own, other, pair = keys[first], keys[1 - first], pairs[kinds[first], kinds[1 - first]]
    form, read = SHAPES[pair.beside]
    shape = read(scope, own, read_table(form, tables[first], scope.where(own)))
    table = read_table(pair.table, tables[1 - first], scope.where(other))
    if pair.body is not None:
        check_bodies(scope, key, scope.body(other, pair.body(table)), shape)
    speeds = (
        speed_of_surface(scope, f"{at}.surface_speed", each.get("surface_speed"))
        for at, each in zip(keys, tables, strict=True)
    )
    return pair.read(scope, other, table, shape).moved(sum_of_terms(*speeds))


def speed_of_surface(scope: Scope, key: str, raw: float | str | None) -> Expr:
    """Return the speed of a surface; 0 for None.

    Raises
    ------
    InputError
        If the formula jumps: at rest on it, bodies would have to.
    """
    speed = ZERO if raw is None else scope.of_time(key, raw)
    if any(isinstance(e, Call) and e.function in JUMPING for e in nested_parts(speed)):
        expected = "a formula of t without jumps, such as min(t/0.1, 1)"
        raise scope.error(key, expected, value_in_words(raw))
    return speed


def check_bodies(scope: Scope, key: str, body: str, shape: Disc | BodyOutline) -> None:
    """Refuse a shape beside its own body."""
    if body == shape.body:
        raise scope.error(key, "two different bodies", f"'{body}' twice")


def two_tables(scope: Scope, key: str, raw: object, usual: str) -> list[Mapping[str, Any]]:
    """Return the tables of two shapes; `usual` shows one in an error."""
    if not isinstance(raw, list | tuple) or len(raw) != 2:
        raise scope.error(key, f"two shapes, [{usual}, SHAPE]", value_in_words(raw))
    return [table if isinstance(table, Mapping) else {} for table in raw]


def word_of_shape(
    scope: Scope,
    key: str,
    table: Mapping[str, Any],
    words: Mapping[str, object],
    usual: type[msgspec.Struct],
    usual_word: str,
) -> str:
    """Return the word for the shape that a table describes; a body with a point alone is the usual one of radius 0."""
    found = [word for word in words if word in table and word != usual_word]
    if found:
        return found[0]
    unknown = [word for word in table if word not in usual.__struct_fields__]
    if unknown or "body" not in table:
        got = f"the unknown key {quote(unknown[0])}" if unknown else value_in_words(dict(table))
        hint = suggest(str(unknown[0]), list(words)) if unknown else ""
        raise scope.error(key, f"a shape: {', '.join(words)}", got, hint)
    return usual_word


def slip_with_turns(
    scope: Scope, terms: tuple[tuple[Expr, Measure], ...], radius: Expr, bodies: tuple[str, str]
) -> Sum:
    """Return a sum of measures, with the radius times the angle of the second body relative to the first one."""
    one, other = bodies
    if radius != ZERO:
        terms += tuple(
            (sign_of(radius, sign), Angle(GROUND, body))
            for body, sign in ((other, 1.0), (one, -1.0))
            if body != GROUND and scope.turns(body)
        )
    return Sum(terms)


def sign_of(value: Expr, sign: float) -> Expr:
    """Return a value, or its negative."""
    return value if sign > 0.0 else call("neg", value)
