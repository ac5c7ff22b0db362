"""Symbols of joints in space."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from symgen.describe.mechanism import Joint
from symgen.describe.topology import articulation_of
from symgen.drawing.joint_parts import GLASS, PITCH, Z, along_of, axis_of, ends_of, grounded, wheel_marks
from symgen.drawing.markers import BodyPoint, parts
from symgen.drawing.pen import RIGID, Pen, across
from symgen.drawing.scene import COLOURS, GREY, GROUNDED, Array, Line, Look, Mark
from symgen.drawing.symbols_plane import blade, driver, link, weld
from symgen.vocabulary.measures import Component, RimHeight, RollingSpeed, Turn


def _hinge(pen: Pen, joint: Joint) -> list[Mark]:
    numbers, u = pen.numbers, pen.unit
    a, b = ends_of(numbers, joint)
    axis, at = axis_of(numbers, joint), numbers.out(a)
    return [*grounded(pen, (a, b)), pen.tube(a.body, at - 0.9 * u * axis, at + 0.9 * u * axis, 0.45)]


def _ball(pen: Pen, joint: Joint) -> list[Mark]:
    a, b = ends_of(pen.numbers, joint)
    return [*grounded(pen, (a, b)), pen.dot(a, 0.55, Look("#20262e", "#e3e8ee", 1.2)), pen.dot(b, 0.22, RIGID)]


def _shaft(pen: Pen, joint: Joint) -> list[Mark]:
    numbers, u = pen.numbers, pen.unit
    a, b = ends_of(numbers, joint)
    axis, start = axis_of(numbers, joint), numbers.out(a)
    low, high = numbers.span(a, b, axis)
    on = start + ((numbers.out(b) - start) @ axis) * axis
    ends = start + (low - 1.5 * u) * axis, start + (high + 1.5 * u) * axis
    stand = replace(a, at=pen.points(a.body, [ends[0]])[0]) if a.body == GROUNDED else a
    marks: list[Mark] = [*grounded(pen, (stand, b)), pen.tube(a.body, *ends, 0.2, Look(GREY, "#d4dae1", 0.8))]
    if joint.kind == "translational":
        frame = np.stack([axis, *across(axis)])
        marks.append(pen.box(b.body, on, frame, np.array([1.8, 1.0, 1.0]) * u, Look("#20262e", "#dfe4ea", 1.0)))
        return marks
    marks.append(pen.tube(b.body, on - 0.9 * u * axis, on + 0.9 * u * axis, 0.45))
    if joint.kind == "screw":
        first, second = across(axis)
        turn = np.linspace(0.0, 6.0 * np.pi, 37)[:, None]
        reach = np.linspace(-1.4, 1.4, 37)[:, None] * u
        coil = start + reach * axis + 0.3 * u * (np.cos(turn) * first + np.sin(turn) * second)
        marks.append(pen.line(a.body, coil, Look(GREY, "", 1.0)))
    return marks


def _shaft_with_pin(pen: Pen, joint: Joint) -> list[Mark]:
    numbers, u = pen.numbers, pen.unit
    pin, slot = numbers.markers(joint.rows)[:2]
    axis, at = along_of(numbers, joint), numbers.out(slot)
    low, high = numbers.span(slot, pin, axis)
    rod = pen.tube(
        slot.body, at + (low - 1.5 * u) * axis, at + (high + 1.5 * u) * axis, 0.2, Look(GREY, "#d4dae1", 0.8)
    )
    return [rod, pen.dot(pin, 0.45)]


def _cross(pen: Pen, joint: Joint) -> list[Mark]:
    numbers, u = pen.numbers, pen.unit
    a, b = ends_of(numbers, joint)
    at, found, marks = numbers.out(a), articulation_of(joint), grounded(pen, (a, b))
    for place, frame in ((a, found.of_a if found else ()), (b, found.of_b if found else ())):
        axis = numbers.direction(frame[2]) if frame else Z
        marks.append(pen.tube(place.body, at - u * axis, at + u * axis, 0.25))
    return marks


def _plate(pen: Pen, joint: Joint) -> list[Mark]:
    numbers, u = pen.numbers, pen.unit
    normals = [m.along for m in parts(joint.rows) if isinstance(m, Component)]
    normal = numbers.direction(normals[0]) if normals else Z
    places = numbers.markers(joint.rows)
    base = next((p for p in places if normals and p.body == numbers.index[normals[0].body]), places[-1])
    first, second = across(normal)
    at = numbers.out(base)
    corners = [at + 3.0 * u * (i * first + j * second) for i, j in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
    others = [p for p in places if p != base]
    return [pen.line(base.body, corners, GLASS, closed=True), *(pen.dot(p, 0.35) for p in others)]


def _round(pen: Pen, joint: Joint) -> list[Mark]:
    """Return a disc or sphere that rolls on a plane of the ground."""
    numbers = pen.numbers
    rims = [m for m in parts(joint.rows) if isinstance(m, RimHeight | RollingSpeed)]
    radius = numbers.number(rims[0].radius)
    centre = numbers.place(rims[0].centre)
    plane = _floor(pen, numbers.direction(rims[0].normal), numbers.markers(joint.rows), centre, radius)
    axis = rims[0].axis
    if axis is not None:
        return [plane, *wheel_marks(pen, centre, numbers.direction(axis), radius, joint.bodies[0])]
    colour = COLOURS[centre.body % len(COLOURS)]
    ball = replace(pen.dot(centre, 1.0, Look(colour, colour, 1.2, 0.2)), radius=radius)
    rings = [pen.ring(centre.body, numbers.out(centre), e, radius, Look(colour, "", 0.7)) for e in np.eye(3)]
    return [plane, ball, *rings]


def _floor(pen: Pen, normal: Array, places: list[BodyPoint], centre: BodyPoint, radius: float) -> Line:
    """Return a part of the plane that holds all of the way."""
    grounded = [p for p in places if p.body == GROUNDED]
    at = pen.numbers.out(grounded[0]) if grounded else np.zeros(3)
    way = np.array([poses.out(centre.body, [centre.at])[0] for poses in pen.numbers.all])
    first, second = across(normal)
    sides = []
    for e in (first, second):
        along = (way - at) @ e
        sides.append((float(along.min()) - 1.5 * radius, float(along.max()) + 1.5 * radius))
    corners = [at + sides[0][i] * first + sides[1][j] * second for i, j in ((0, 0), (1, 0), (1, 1), (0, 1))]
    return pen.line(GROUNDED, corners, GLASS, closed=True)


def _arm(pen: Pen, joint: Joint) -> list[Mark]:
    a, b = pen.numbers.markers(joint.rows)[:2]
    axis, at, u = axis_of(pen.numbers, joint), pen.numbers.out(a), pen.unit
    hinge = pen.tube(a.body, at - 0.7 * u * axis, at + 0.7 * u * axis, 0.4)
    rod = pen.stretch("rod", a, b, Look("#20262e", "", 2.2))
    return [*grounded(pen, (a, b)), hinge, rod, pen.dot(b, 0.5, Look("#20262e", "#e3e8ee", 1.2))]


def _coupled(pen: Pen, joint: Joint) -> list[Mark]:
    """Return rings about the axes of the joints that a gear ties together."""
    marks: list[Mark] = []
    for turn in (m for m in parts(joint.rows) if isinstance(m, Turn)):
        body = pen.numbers.index[turn.zero.body]
        owner = [j for j in pen.numbers.mechanism.joints if j is not joint and turn in list(parts(j.coordinates))]
        if owner:
            a, _ = ends_of(pen.numbers, owner[0])
            axis = np.cross(pen.numbers.direction(turn.zero), pen.numbers.direction(turn.quarter))
            marks.append(pen.ring(body, pen.numbers.out(a), axis, 1.3 * pen.unit, PITCH))
    return marks


#: In space: kind -> what draws it.
SPATIAL: dict[str, Callable[[Pen, Joint], list[Mark]]] = {
    "revolute": _hinge,
    "spherical": _ball,
    "constant-velocity": _ball,
    "universal": _cross,
    "cylindrical": _shaft,
    "translational": _shaft,
    "screw": _shaft,
    "rigid": weld,
    "distance": link,
    "planar": _plate,
    "point-on-plane": _plate,
    "pin-in-slot": _shaft_with_pin,
    "rolling-disc": _round,
    "rolling-sphere": _round,
    "revolute-spherical": _arm,
    "gear": _coupled,
    "rack-and-pinion": _coupled,
    "knife-edge": blade,
    "driver": driver,
}
