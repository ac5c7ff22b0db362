"""Symbols of joints, found by their kinds."""

from __future__ import annotations

from symgen.describe.mechanism import Joint
from symgen.describe.topology import articulation_of
from symgen.drawing.joint_parts import plain
from symgen.drawing.markers import BodyPoint, parts
from symgen.drawing.pen import Pen
from symgen.drawing.scene import PAPER, RED, Item, Look, Mark
from symgen.drawing.symbols_plane import PLANAR
from symgen.drawing.symbols_space import SPATIAL
from symgen.vocabulary.measures import Component, LinkStretch


def joint_item(pen: Pen, joint: Joint) -> Item:
    """Return what is drawn of a joint; kinds without a symbol show the points that they tie."""
    numbers = pen.numbers
    draw = (SPATIAL if numbers.spatial else PLANAR).get(joint.kind, plain)
    held = [m for row in joint.rows for m in parts(row) if isinstance(m, Component | LinkStretch)]
    ends: tuple[BodyPoint, ...] = tuple(numbers.markers(held)) if len(joint.bodies) == 2 else ()
    found = articulation_of(joint)
    if found is not None:
        ends = numbers.place(found.a), numbers.place(found.b)
    return Item("joint", joint.name, joint.kind, tuple(draw(pen, joint)), tuple((p.body, p.at) for p in ends[:2]))


def gap_item(pen: Pen, item: Item) -> Item:
    """Return what marks a joint as open: its two points in rings, and a dashed line between them."""
    look, marks = Look(RED, "", 2.0, dashed=True), list[Mark]()
    places = [BodyPoint(body, at) for body, at in item.ends]
    if len(places) == 2:
        marks.append(pen.stretch("gap", places[0], places[1], look))
    for place in places:
        marks.append(pen.dot(place, 1.1, Look(RED, RED, 2.0, 0.18)))
        marks.append(pen.dot(place, 0.3, Look(RED, PAPER, 1.5)))
    return Item("fault", item.name, item.kind, tuple(marks))
