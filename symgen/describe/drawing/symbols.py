"""Symbols of joints by their kinds, in the plane and in space, as in engineering drawings."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from symgen.base.vocabulary.expressions import Call, Expr
from symgen.base.vocabulary.measures import (
    AnyAngle,
    Component,
    Direction,
    FormulaMeasure,
    LinkStretch,
    Marker,
    PointSpeed,
    RimHeight,
    RollingSpeed,
    Sum,
    Turn,
    nested_parts,
)
from symgen.describe.drawing.drawn_in_space import ball_marks, floor_under_paths
from symgen.describe.drawing.joint_parts import (
    DRIVE,
    GLASS,
    PITCH,
    Z,
    ground_stand,
    joint_axis,
    joint_ends,
    joint_points,
    pivot_and_axis,
    sliding_direction,
    wheel_marks,
)
from symgen.describe.drawing.pen import RIGID, BodyPoint, Pen, PlacedMechanism, directions_across_axis
from symgen.describe.drawing.scene import GREY, GROUNDED, PAPER, RED, Array, Item, Look, Mark
from symgen.describe.mechanism import Joint
from symgen.describe.parts.topology import articulation_of_joint


def _pin_symbol(pen: Pen, joint: Joint) -> list[Mark]:
    a, b = joint_ends(pen.numbers, joint)
    return [*ground_stand(pen, (a, b)), pen.dot(a if a.body != GROUNDED else b, 0.42)]


def weld_symbol(pen: Pen, joint: Joint) -> list[Mark]:
    """Return the symbol of a weld, a filled square."""
    a, b = joint_ends(pen.numbers, joint)
    at = pen.numbers.in_ground_frame(a)
    square = pen.box(a.body, at, np.eye(3), np.full(3, 0.7 * pen.unit), RIGID)
    return [*ground_stand(pen, (a, b), swivel=False), square]


def _slide_symbol(pen: Pen, joint: Joint) -> list[Mark]:
    numbers, u = pen.numbers, pen.unit
    a, b = joint_ends(numbers, joint)
    along = sliding_direction(numbers, joint)
    side = _downward_side(pen, along, a.body)
    span = numbers.range_along(a, b, along)
    block = np.stack([along, side, Z]), np.array([2.4, 1.3, 1.3]) * u
    start = numbers.in_ground_frame(a)
    on = start + ((numbers.in_ground_frame(b) - start) @ along) * along
    if a.body != GROUNDED != b.body:
        stroke = [float(x) for x in numbers.ends_of_travel(a, b, along)]
        if min(stroke) * max(stroke) > 0.0 and min(map(abs, stroke)) > 6.0 * u:
            return _telescope_symbol(pen, a, b, along, side, sorted(stroke, key=abs))
    marks = pen.rail(a.body, start + 0.65 * u * side, along, span, side)
    if a.body != GROUNDED:
        marks += pen.rail(a.body, start - 0.65 * u * side, along, span, -side)
    marks.append(pen.box(b.body, on, *block, Look("#20262e", "#dfe4ea", 1.2)))
    return [*marks, *(pen.ground_hatching(on + 0.65 * u * side, along, side) if b.body == GROUNDED else [])]


def _telescope_symbol(
    pen: Pen, a: BodyPoint, b: BodyPoint, along: Array, side: Array, stroke: list[float]
) -> list[Mark]:
    """Return a cylinder whose rod never retracts to its foot: a barrel as long as the shortest length, and a rod."""
    u, start, (short, long) = pen.unit, pen.numbers.in_ground_frame(a), stroke
    on = start + ((pen.numbers.in_ground_frame(b) - start) @ along) * along
    way = float(np.sign(short)) * along
    end = start + (abs(short) - 1.5 * u) * way
    back = on - min(abs(long - short) + 3.0 * u, 0.9 * abs(short)) * way
    corners = [start + 0.8 * u * side, end + 0.8 * u * side, end - 0.8 * u * side, start - 0.8 * u * side]
    piston = [back + 0.8 * u * side, back - 0.8 * u * side]
    return [
        pen.line(a.body, corners, Look("#20262e", "#dfe4ea", 1.2, 0.6), closed=True),
        pen.line(b.body, [back, on], Look("#20262e", "", 2.6)),
        pen.line(b.body, piston, Look("#20262e", "", 2.0)),
    ]


def _downward_side(pen: Pen, along: Array, body: int) -> Array:
    """Return the direction across another one that points downwards, on the ground."""
    side = np.array([-along[1], along[0], 0.0])
    return -side if side @ pen.up > 1e-9 else side


def _slot_symbol(pen: Pen, joint: Joint) -> list[Mark]:
    numbers, u = pen.numbers, pen.unit
    pin, slot = numbers.markers(joint.rows[0])
    along = sliding_direction(numbers, joint)
    side, at = _downward_side(pen, along, slot.body), numbers.in_ground_frame(slot)
    low, high = numbers.range_along(slot, pin, along)
    marks: list[Mark] = []
    for sign in (1.0, -1.0):
        ends = [at + (low - 1.5 * u) * along, at + (high + 1.5 * u) * along]
        marks.append(replace(pen.line(slot.body, np.array(ends) + 0.55 * sign * u * side), guide=True))
    if slot.body == GROUNDED:
        marks += pen.rail(GROUNDED, at + 0.55 * u * side, along, (low, high), side)
    return [*marks, pen.dot(pin, 0.42)]


def link_symbol(pen: Pen, joint: Joint) -> list[Mark]:
    """Return a rod between two pins."""
    a, b = joint_ends(pen.numbers, joint)
    rod = pen.stretch("rod", a, b, Look("#20262e", "", 2.2))
    return [*ground_stand(pen, (a, b)), rod, pen.dot(a, 0.36), pen.dot(b, 0.36)]


def _rolling_symbol(pen: Pen, joint: Joint) -> list[Mark]:
    numbers, u = pen.numbers, pen.unit
    line, disc = numbers.markers(joint.coordinates)
    along = sliding_direction(numbers, joint)
    normal = np.array([-along[1], along[0], 0.0])
    radius = numbers.number(_radius(joint))
    span = numbers.range_along(line, disc, along)
    wheel = wheel_marks(pen, disc, Z, radius, joint.bodies[0])
    return [*pen.rail(line.body, numbers.in_ground_frame(line), along, (span[0] - u, span[1] + u), -normal), *wheel]


def _gear_symbol(pen: Pen, joint: Joint) -> list[Mark]:
    """Return the pitch circles of the wheels, where the gear has radii and its wheels turn on pins."""
    numbers = pen.numbers
    sums = [m for m in nested_parts(joint.rows) if isinstance(m, Sum)]
    sized = bool(joint.rows) and joint.rows[0].unit == "m"
    marks: list[Mark] = []
    for k, body in enumerate(joint.bodies[:2]):
        centre = _pivot_of_wheel(numbers, body, joint)
        if centre is None:
            continue
        if sized:
            radius = abs(numbers.number(sums[0].terms[k][0]))
            marks += wheel_marks(pen, centre, Z, radius, body, Look(GREY, "#9aa7b5", 1.0, 0.15, dashed=True))
        else:
            marks.append(pen.ring(centre.body, numbers.in_ground_frame(centre), Z, 0.9 * pen.unit, PITCH))
    return marks


def _pivot_of_wheel(numbers: PlacedMechanism, body: str, gear: Joint) -> BodyPoint | None:
    carrier = gear.bodies[2] if len(gear.bodies) > 2 else "ground"
    for other in numbers.mechanism.joints:
        if other.kind == "revolute" and set(other.bodies) == {body, carrier}:
            a, b = joint_ends(numbers, other)
            return a if a.body == numbers.index[body] else b
    return BodyPoint(numbers.index[body], (0.0, 0.0, 0.0)) if body in numbers.index else None


def blade_symbol(pen: Pen, joint: Joint) -> list[Mark]:
    """Return the short line of a blade."""
    numbers, u = pen.numbers, pen.unit
    at = numbers.markers(joint.rows)[0]
    speeds = [m for m in nested_parts(joint.rows) if isinstance(m, PointSpeed)]
    if speeds:
        across_it = numbers.direction(speeds[0].along)
        along = np.array([-across_it[1], across_it[0], 0.0])
    else:
        along = numbers.direction(numbers.directions(joint.rows)[-1])
    middle = numbers.in_ground_frame(at)
    return [pen.line(at.body, [middle - 1.2 * u * along, middle + 1.2 * u * along], Look("#20262e", "", 3.0))]


def driver_symbol(pen: Pen, joint: Joint) -> list[Mark]:
    """Return an arrow along the coordinate that is driven."""
    numbers, u = pen.numbers, pen.unit
    turning = [m for m in nested_parts(joint.rows) if isinstance(m, AnyAngle)]
    sliding = [m for m in nested_parts(joint.rows) if isinstance(m, Component)]
    driven = [j for j in numbers.mechanism.joints if j is not joint and set(j.bodies) == set(joint.bodies)]
    if sliding:
        move = sliding[0]
        a, b = numbers.place(move.a), numbers.place(move.b)
        along = numbers.direction(move.along)
        at = numbers.in_ground_frame(b)
        side = directions_across_axis(along)[0] if numbers.spatial else np.array([-along[1], along[0], 0.0])
        start = at + 1.5 * u * side - 1.2 * u * along
        return pen.arrow(a.body, np.array([start, start + 2.6 * u * along]), DRIVE)
    if turning:
        if not driven:
            pivot, axis = BodyPoint(numbers.index[joint.bodies[-1]], (0.0, 0.0, 0.0)), joint_axis(numbers, joint)
        else:
            pivot, axis = pivot_and_axis(numbers, driven[0], joint.rows)
        return pen.turning_arrow(pivot.body, numbers.in_ground_frame(pivot), axis, 1.35, DRIVE)
    return joint_points(pen, joint)


#: In the plane: kind -> function that draws it.
PLANAR: dict[str, Callable[[Pen, Joint], list[Mark]]] = {
    "revolute": _pin_symbol,
    "rigid": weld_symbol,
    "translational": _slide_symbol,
    "pin-in-slot": _slot_symbol,
    "distance": link_symbol,
    "rolling": _rolling_symbol,
    "gear": _gear_symbol,
    "knife-edge": blade_symbol,
    "driver": driver_symbol,
}


def _hinge_symbol(pen: Pen, joint: Joint) -> list[Mark]:
    numbers, u = pen.numbers, pen.unit
    a, b = joint_ends(numbers, joint)
    axis, at = joint_axis(numbers, joint), numbers.in_ground_frame(a)
    return [*ground_stand(pen, (a, b)), pen.tube(a.body, at - 0.9 * u * axis, at + 0.9 * u * axis, 0.45)]


def _ball_symbol(pen: Pen, joint: Joint) -> list[Mark]:
    a, b = joint_ends(pen.numbers, joint)
    return [*ground_stand(pen, (a, b)), pen.dot(a, 0.55, Look("#20262e", "#e3e8ee", 1.2)), pen.dot(b, 0.22, RIGID)]


def _shaft_symbol(pen: Pen, joint: Joint) -> list[Mark]:
    numbers, u = pen.numbers, pen.unit
    a, b = joint_ends(numbers, joint)
    axis, start = joint_axis(numbers, joint), numbers.in_ground_frame(a)
    low, high = numbers.range_along(a, b, axis)
    on = start + ((numbers.in_ground_frame(b) - start) @ axis) * axis
    ends = start + (low - 1.5 * u) * axis, start + (high + 1.5 * u) * axis
    stand = replace(a, at=pen.points(a.body, [ends[0]])[0]) if a.body == GROUNDED else a
    marks: list[Mark] = [*ground_stand(pen, (stand, b)), pen.tube(a.body, *ends, 0.2, Look(GREY, "#d4dae1", 0.8))]
    if joint.kind == "translational":
        frame = np.stack([axis, *directions_across_axis(axis)])
        look = Look("#20262e", pen.colour(b.body), 1.0, 0.45)
        marks.append(pen.box(b.body, on, frame, np.array([1.8, 1.0, 1.0]) * u, look))
        return marks
    marks.append(pen.tube(b.body, on - 0.9 * u * axis, on + 0.9 * u * axis, 0.45))
    if joint.kind == "screw":
        first, second = directions_across_axis(axis)
        turn = np.linspace(0.0, 6.0 * np.pi, 37)[:, None]
        reach = np.linspace(-1.4, 1.4, 37)[:, None] * u
        coil = start + reach * axis + 0.3 * u * (np.cos(turn) * first + np.sin(turn) * second)
        marks.append(pen.line(a.body, coil, Look(GREY, "", 1.0)))
    return marks


def _shaft_with_pin_symbol(pen: Pen, joint: Joint) -> list[Mark]:
    numbers, u = pen.numbers, pen.unit
    pin, slot = numbers.markers(joint.rows)[:2]
    axis, at = sliding_direction(numbers, joint), numbers.in_ground_frame(slot)
    low, high = numbers.range_along(slot, pin, axis)
    rod = pen.tube(
        slot.body, at + (low - 1.5 * u) * axis, at + (high + 1.5 * u) * axis, 0.2, Look(GREY, "#d4dae1", 0.8)
    )
    return [rod, pen.dot(pin, 0.45)]


def _cross_symbol(pen: Pen, joint: Joint) -> list[Mark]:
    numbers, u = pen.numbers, pen.unit
    a, b = joint_ends(numbers, joint)
    at, articulation, marks = numbers.in_ground_frame(a), articulation_of_joint(joint), ground_stand(pen, (a, b))
    for place, frame in (
        (a, articulation.of_a if articulation else ()),
        (b, articulation.of_b if articulation else ()),
    ):
        axis = numbers.direction(frame[2]) if frame else Z
        marks.append(pen.tube(place.body, at - u * axis, at + u * axis, 0.25))
    return marks


def _plate_symbol(pen: Pen, joint: Joint) -> list[Mark]:
    numbers, u = pen.numbers, pen.unit
    normals = [m.along for m in nested_parts(joint.rows) if isinstance(m, Component)]
    normal = numbers.direction(normals[0]) if normals else Z
    places = numbers.markers(joint.rows)
    base = next((p for p in places if normals and p.body == numbers.index[normals[0].body]), places[-1])
    first, second = directions_across_axis(normal)
    at = numbers.in_ground_frame(base)
    corners = [at + 3.0 * u * (i * first + j * second) for i, j in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
    others = [p for p in places if p != base]
    return [pen.line(base.body, corners, GLASS, closed=True), *(pen.dot(p, 0.35) for p in others)]


def _radius(joint: Joint) -> Expr:
    """Return the radius of what rolls, from the speed of its contact, its rim, its slip or its gap."""
    for part in nested_parts(joint):
        match part:
            case RimHeight(radius=radius) | RollingSpeed(radius=radius) | Sum(terms=(_, (radius, _))):
                return radius
            case FormulaMeasure(of=Call("sub", (_, radius))):
                return radius
    raise AssertionError("what rolls has a radius")


def _rolling_body_symbol(pen: Pen, joint: Joint) -> list[Mark]:
    """Return a disc or sphere that rolls on a plane."""
    numbers = pen.numbers
    rims = [m.axis for m in nested_parts(joint) if isinstance(m, RimHeight)]
    places, radius = numbers.markers(joint), numbers.number(_radius(joint))
    centre = next(p for p in places if p.body == numbers.index[joint.bodies[0]])
    normal = next(d for d in numbers.directions(joint) if d.body != joint.bodies[0])
    base = numbers.index[normal.body]
    origin = next((p for p in places if p.body == base), BodyPoint(base, (0.0, 0.0, 0.0)))
    plane = floor_under_paths(pen, normal, origin, [centre], radius)
    if rims:
        return [plane, *wheel_marks(pen, centre, numbers.direction(rims[0]), radius, joint.bodies[0])]
    return [plane, *ball_marks(pen, centre, radius)]


def _arm_symbol(pen: Pen, joint: Joint) -> list[Mark]:
    a, b = pen.numbers.markers(joint.rows)[:2]
    axis, at, u = joint_axis(pen.numbers, joint), pen.numbers.in_ground_frame(a), pen.unit
    hinge = pen.tube(a.body, at - 0.7 * u * axis, at + 0.7 * u * axis, 0.4)
    rod = pen.stretch("rod", a, b, Look("#20262e", "", 2.2))
    return [*ground_stand(pen, (a, b)), hinge, rod, pen.dot(b, 0.5, Look("#20262e", "#e3e8ee", 1.2))]


def _coupled_rings(pen: Pen, joint: Joint) -> list[Mark]:
    """Return rings about the axes of the joints that a gear ties together."""
    marks: list[Mark] = []
    for turn in (m for m in nested_parts(joint.rows) if isinstance(m, Turn)):
        body = pen.numbers.index[turn.zero.body]
        owner = [
            j for j in pen.numbers.mechanism.joints if j is not joint and turn in list(nested_parts(j.coordinates))
        ]
        if owner:
            a, _ = joint_ends(pen.numbers, owner[0])
            axis = np.cross(pen.numbers.direction(turn.zero), pen.numbers.direction(turn.quarter))
            marks.append(pen.ring(body, pen.numbers.in_ground_frame(a), axis, 1.3 * pen.unit, PITCH))
    return marks


#: In space: kind -> function that draws it.
SPATIAL: dict[str, Callable[[Pen, Joint], list[Mark]]] = {
    "revolute": _hinge_symbol,
    "spherical": _ball_symbol,
    "constant-velocity": _ball_symbol,
    "universal": _cross_symbol,
    "cylindrical": _shaft_symbol,
    "translational": _shaft_symbol,
    "screw": _shaft_symbol,
    "rigid": weld_symbol,
    "distance": link_symbol,
    "planar": _plate_symbol,
    "point-on-plane": _plate_symbol,
    "pin-in-slot": _shaft_with_pin_symbol,
    "rolling-disc": _rolling_body_symbol,
    "rolling-sphere": _rolling_body_symbol,
    "revolute-spherical": _arm_symbol,
    "gear": _coupled_rings,
    "rack-and-pinion": _coupled_rings,
    "knife-edge": blade_symbol,
    "driver": driver_symbol,
}


def joint_symbol(pen: Pen, joint: Joint) -> Item:
    """Return the symbol of a joint; kinds without one show the points that they tie."""
    numbers = pen.numbers
    draw = (SPATIAL if numbers.spatial else PLANAR).get(joint.kind, joint_points)
    parts = nested_parts(joint.rows, (Marker, Direction))
    measures = tuple(m for m in parts if isinstance(m, Component | LinkStretch))
    ends: tuple[BodyPoint, ...] = tuple(numbers.markers(measures)) if len(joint.bodies) == 2 else ()
    articulation = articulation_of_joint(joint)
    if articulation is not None:
        ends = numbers.place(articulation.a), numbers.place(articulation.b)
    return Item("joint", joint.name, joint.kind, tuple(draw(pen, joint)), tuple((p.body, p.at) for p in ends[:2]))


def gap_mark(pen: Pen, item: Item) -> Item:
    """Return the mark of an open joint: its two points in rings, and a dashed line between them."""
    look, marks = Look(RED, "", 2.0, dashed=True), list[Mark]()
    places = [BodyPoint(body, at) for body, at in item.ends]
    if len(places) == 2:
        marks.append(pen.stretch("gap", places[0], places[1], look))
    for place in places:
        marks.append(pen.dot(place, 1.1, Look(RED, RED, 2.0, 0.18)))
        marks.append(pen.dot(place, 0.3, Look(RED, PAPER, 1.5)))
    return Item("fault", item.name, item.kind, tuple(marks))
