"""Symbols of joints in the plane, as engineering drawings have them."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from symgen.describe.mechanism import Joint
from symgen.drawing.joint_parts import (
    DRIVE,
    PITCH,
    Z,
    along_of,
    axis_of,
    ends_of,
    grounded,
    plain,
    turned_about,
    wheel_marks,
)
from symgen.drawing.markers import BodyPoint, PlacedMechanism, parts
from symgen.drawing.pen import RIGID, Pen, across
from symgen.drawing.scene import GREY, GROUNDED, Array, Look, Mark
from symgen.vocabulary.measures import AnyAngle, Component, PointSpeed, Sum


def _pin(pen: Pen, joint: Joint) -> list[Mark]:
    a, b = ends_of(pen.numbers, joint)
    return [*grounded(pen, (a, b)), pen.dot(a if a.body != GROUNDED else b, 0.42)]


def weld(pen: Pen, joint: Joint) -> list[Mark]:
    """Return the symbol of a weld, a filled square."""
    a, b = ends_of(pen.numbers, joint)
    at = pen.numbers.out(a)
    square = pen.box(a.body, at, np.eye(3), np.full(3, 0.7 * pen.unit), RIGID)
    return [*grounded(pen, (a, b), swivel=False), square]


def _slide(pen: Pen, joint: Joint) -> list[Mark]:
    numbers, u = pen.numbers, pen.unit
    a, b = ends_of(numbers, joint)
    along = along_of(numbers, joint)
    side = _lower(pen, along, a.body)
    span = numbers.span(a, b, along)
    block = np.stack([along, side, Z]), np.array([2.4, 1.3, 1.3]) * u
    start = numbers.out(a)
    on = start + ((numbers.out(b) - start) @ along) * along
    marks = pen.rail(a.body, start + 0.65 * u * side, along, span, side)
    if a.body != GROUNDED:
        marks += pen.rail(a.body, start - 0.65 * u * side, along, span, -side)
    marks.append(pen.box(b.body, on, *block, Look("#20262e", "#dfe4ea", 1.2)))
    return [*marks, *(pen.earth(on + 0.65 * u * side, along, side) if b.body == GROUNDED else [])]


def _lower(pen: Pen, along: Array, body: int) -> Array:
    """Return the direction across another one that points downwards, on the ground."""
    side = np.array([-along[1], along[0], 0.0])
    return -side if side @ pen.up > 1e-9 else side


def _slot(pen: Pen, joint: Joint) -> list[Mark]:
    numbers, u = pen.numbers, pen.unit
    pin, slot = numbers.markers(joint.rows[0])
    along = along_of(numbers, joint)
    side, at = _lower(pen, along, slot.body), numbers.out(slot)
    low, high = numbers.span(slot, pin, along)
    marks: list[Mark] = []
    for sign in (1.0, -1.0):
        ends = [at + (low - 1.5 * u) * along, at + (high + 1.5 * u) * along]
        marks.append(pen.line(slot.body, np.array(ends) + 0.55 * sign * u * side))
    if slot.body == GROUNDED:
        marks += pen.rail(GROUNDED, at + 0.55 * u * side, along, (low, high), side)
    return [*marks, pen.dot(pin, 0.42)]


def link(pen: Pen, joint: Joint) -> list[Mark]:
    """Return a rod between two pins."""
    a, b = ends_of(pen.numbers, joint)
    rod = pen.stretch("rod", a, b, Look("#20262e", "", 2.2))
    return [*grounded(pen, (a, b)), rod, pen.dot(a, 0.36), pen.dot(b, 0.36)]


def _rolling(pen: Pen, joint: Joint) -> list[Mark]:
    numbers, u = pen.numbers, pen.unit
    disc, line = numbers.markers(joint.rows[0])
    along = along_of(numbers, joint)
    normal = np.array([-along[1], along[0], 0.0])
    sums = [m for m in parts(joint.rows) if isinstance(m, Sum)]
    radius = abs(numbers.number(sums[0].terms[1][0]))
    span = numbers.span(line, disc, along)
    wheel = wheel_marks(pen, disc, Z, radius, joint.bodies[0])
    return [*pen.rail(line.body, numbers.out(line), along, (span[0] - u, span[1] + u), -normal), *wheel]


def _mesh(pen: Pen, joint: Joint) -> list[Mark]:
    """Return the pitch circles of the wheels, where the gear has radii and its wheels turn on pins."""
    numbers = pen.numbers
    sums = [m for m in parts(joint.rows) if isinstance(m, Sum)]
    sized = bool(joint.rows) and joint.rows[0].unit == "m"
    marks: list[Mark] = []
    for k, body in enumerate(joint.bodies[:2]):
        centre = _pivot(numbers, body, joint)
        if centre is None:
            continue
        if sized:
            radius = abs(numbers.number(sums[0].terms[k][0]))
            marks += wheel_marks(pen, centre, Z, radius, body, Look(GREY, "#9aa7b5", 1.0, 0.15, dashed=True))
        else:
            marks.append(pen.ring(centre.body, numbers.out(centre), Z, 0.9 * pen.unit, PITCH))
    return marks


def _pivot(numbers: PlacedMechanism, body: str, gear: Joint) -> BodyPoint | None:
    carrier = gear.bodies[2] if len(gear.bodies) > 2 else "ground"
    for other in numbers.mechanism.joints:
        if other.kind == "revolute" and set(other.bodies) == {body, carrier}:
            a, b = ends_of(numbers, other)
            return a if a.body == numbers.index[body] else b
    return BodyPoint(numbers.index[body], (0.0, 0.0, 0.0)) if body in numbers.index else None


def blade(pen: Pen, joint: Joint) -> list[Mark]:
    """Return the short line of a blade."""
    numbers, u = pen.numbers, pen.unit
    at = numbers.markers(joint.rows)[0]
    speeds = [m for m in parts(joint.rows) if isinstance(m, PointSpeed)]
    if speeds:
        across_it = numbers.direction(speeds[0].along)
        along = np.array([-across_it[1], across_it[0], 0.0])
    else:
        along = numbers.direction(numbers.directions(joint.rows)[-1])
    middle = numbers.out(at)
    return [pen.line(at.body, [middle - 1.2 * u * along, middle + 1.2 * u * along], Look("#20262e", "", 3.0))]


def driver(pen: Pen, joint: Joint) -> list[Mark]:
    """Return an arrow along the coordinate that is driven."""
    numbers, u = pen.numbers, pen.unit
    turning = [m for m in parts(joint.rows) if isinstance(m, AnyAngle)]
    sliding = [m for m in parts(joint.rows) if isinstance(m, Component)]
    driven = [j for j in numbers.mechanism.joints if j is not joint and set(j.bodies) == set(joint.bodies)]
    if sliding:
        move = sliding[0]
        a, b = numbers.place(move.a), numbers.place(move.b)
        along = numbers.direction(move.along)
        at = numbers.out(b)
        side = across(along)[0] if numbers.spatial else np.array([-along[1], along[0], 0.0])
        start = at + 1.5 * u * side - 1.2 * u * along
        return pen.arrow(a.body, np.array([start, start + 2.6 * u * along]), DRIVE)
    if turning:
        if not driven:
            pivot, axis = BodyPoint(numbers.index[joint.bodies[-1]], (0.0, 0.0, 0.0)), axis_of(numbers, joint)
        else:
            pivot, axis = turned_about(numbers, driven[0], joint.rows)
        return pen.turning(pivot.body, numbers.out(pivot), axis, 1.35, DRIVE)
    return plain(pen, joint)


#: In the plane: kind -> what draws it.
PLANAR: dict[str, Callable[[Pen, Joint], list[Mark]]] = {
    "revolute": _pin,
    "rigid": weld,
    "translational": _slide,
    "pin-in-slot": _slot,
    "distance": link,
    "rolling": _rolling,
    "gear": _mesh,
    "knife-edge": blade,
    "driver": driver,
}
