"""How the surfaces of contacts are drawn: discs with a spoke, holes, points, lines as guides, and segments."""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise
from typing import Any

import numpy as np

from symgen.describe.contacts.outlines import LineInPieces, Outline
from symgen.describe.drawing.drawn_in_space import surface_marks
from symgen.describe.drawing.pen import EARTH, BodyPoint, Pen, PlacedMechanism
from symgen.describe.drawing.scene import GROUNDED, INK, Array, Item, Line, Look, Mark, Side
from symgen.describe.mechanism import Mechanism

#: Half the length of a line beside which outlines are, in symbols.
_LONG = 1e4


def contact_items(pen: Pen) -> list[Item]:
    """Return the surfaces of all contacts; one that several share is drawn once."""
    items, seen = list[Item](), set[Outline]()
    for name, outlines in outlines_of_contacts(pen.numbers.mechanism):
        marks, sizes = list[Mark](), [size_of_outline(pen.numbers, outline) for outline in outlines]
        for outline in outlines:
            others = [point for other in outlines if other != outline for point in _places(pen, other)]
            if outline not in seen or outline.normal is not None:
                marks += _marks(pen, outline, others, max(sizes) or 3.0 * pen.unit)
            seen.add(outline)
        sides = (
            tuple(_sides(pen, outline) for outline in outlines)
            if any(isinstance(x, LineInPieces) for x in outlines)
            else ()
        )
        items.append(Item("contact", name, "contact", tuple(marks), sides=sides))
    return items


def _sides(pen: Pen, outline: Outline) -> tuple[Side, ...]:
    """Return the pieces of a surface in the plane."""
    places = _places(pen, outline)
    body, points = places[0].body, tuple(place.at for place in places)
    if outline.normal is not None:
        at = pen.numbers.in_ground_frame(places[0])
        along = _LONG * pen.unit * across(pen.numbers.direction(outline.normal))
        line = pen.line(body, [at - along, at + along], Look())
        return (Side(body, line.points),)
    if not isinstance(outline, LineInPieces):
        return (Side(body, points, pen.numbers.number(outline.radius)),)
    stretches = pairwise((*outline.starts, len(points) - 1))
    return tuple(Side(body, points[first : last + 1], whole=False) for first, last in stretches)


def across(normal: Array) -> Array:
    """Return the direction of a line with a normal."""
    return np.array([normal[1], -normal[0], 0.0])


def outlines_of_contacts(mechanism: Mechanism) -> list[tuple[str, tuple[Outline, ...]]]:
    """Return the outlines of contacts that have some, by name."""
    gaps: list[Any] = [row for row in mechanism.bounded if row.in_contact and row.one_sided]
    return [(gap.name, gap.outlines) for gap in gaps if gap.outlines]


def _places(pen: Pen, outline: Outline) -> list[BodyPoint]:
    return [pen.numbers.place(marker) for marker in outline.points]


def size_of_outline(numbers: PlacedMechanism, outline: Outline) -> float:
    """Return the largest of the sizes of a surface [m]."""
    return max(abs(numbers.number(e)) for e in (outline.radius, *outline.edges))


def _marks(pen: Pen, outline: Outline, others: list[BodyPoint], reach: float) -> list[Mark]:
    """Return the marks of a surface.

    `others` are points of what it meets, along which a line is long enough, and a plane wide enough by `reach` beyond.
    """
    if pen.numbers.spatial:
        return surface_marks(pen, outline, others, reach)
    places = _places(pen, outline)
    body, at = places[0].body, pen.numbers.in_ground_frame(places[0])
    look = EARTH if body == GROUNDED else Look(pen.colour(body), "", 1.6)
    if outline.normal is not None:
        normal = pen.numbers.direction(outline.normal)
        return _line(pen, places[0], normal, others)
    if len(places) > 1:
        points = tuple(place.at for place in places)
        return [Line(body, points, replace(look, width=2.4), in_pieces=isinstance(outline, LineInPieces))]
    radius = pen.numbers.number(outline.radius)
    if radius == 0.0:
        return [pen.dot(places[0], 0.22, replace(look, fill=look.ink))]
    ring = pen.ring(body, at, np.array([0.0, 0.0, 1.0]), abs(radius), look)
    if radius < 0.0:
        return [ring]
    filled = replace(ring, look=replace(look, fill=look.ink, opacity=0.16))
    return [filled, Line(body, (places[0].at, ring.points[0]), replace(look, width=1.0))]


def _line(pen: Pen, on: BodyPoint, normal: Array, others: list[BodyPoint]) -> list[Mark]:
    """Return a line as a guide as long as what is over it goes."""
    along, at = across(normal), pen.numbers.in_ground_frame(on)
    spans = [pen.numbers.ends_of_travel(on, other, along) for other in others]
    reach = min((low for low, _ in spans), default=0.0), max((high for _, high in spans), default=0.0)
    if on.body != GROUNDED:
        start, end = reach[0] - 2.2 * pen.unit, reach[1] + 2.2 * pen.unit
        return [pen.line(on.body, [at + start * along, at + end * along], Look(INK, "", 1.6))]
    return pen.rail(on.body, at, along, reach, -normal)
