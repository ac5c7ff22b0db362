"""Parts of symbols of joints: their points and axes, stands, wheels."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from symgen.base.vocabulary.measures import Component, Sum, Turning, nested_parts
from symgen.describe.drawing.pen import EARTH, FILLED, PLAIN, BodyPoint, Pen, PlacedMechanism, directions_across_axis
from symgen.describe.drawing.scene import GREY, GROUNDED, Array, Look, Mark
from symgen.describe.mechanism import Joint
from symgen.describe.parts.topology import articulation_of_joint

DRIVE = Look("#a0522d", "", 1.6)
PITCH = Look(GREY, "", 1.0, dashed=True)
GLASS = Look(GREY, "#9aa7b5", 0.8, 0.25)
Z = np.array([0.0, 0.0, 1.0])


def joint_points(pen: Pen, joint: Joint) -> list[Mark]:
    """Return the points that a joint ties, for kinds without a symbol; for rows, points of bodies."""
    places = pen.numbers.markers(joint)
    if joint.kind == "rows":  # formulas read points as they are seen from the origin
        places = [place for place in places if place.body != GROUNDED]
    if joint.kind == "slides-on":  # what slides; the curve is drawn with its beam
        places = [place for place in places if place.body == pen.numbers.index[joint.bodies[0]]][:1]
    return [pen.dot(place, 0.35, PLAIN) for place in places]


def joint_ends(numbers: PlacedMechanism, joint: Joint) -> tuple[BodyPoint, BodyPoint]:
    """Return the points of both bodies of a joint, from its first rows, in the order of its bodies."""
    articulation = articulation_of_joint(joint)
    if articulation is not None:
        return numbers.place(articulation.a), numbers.place(articulation.b)
    places = numbers.markers(joint.rows)
    return places[0], places[1] if len(places) > 1 else places[0]


def sliding_direction(numbers: PlacedMechanism, joint: Joint) -> Array:
    """Return the direction that a joint's displacement counts along."""
    components = [m for _, m in joint.coordinates if isinstance(m, Component)]
    return numbers.direction(components[0].along) if components else np.array([1.0, 0.0, 0.0])


def joint_axis(numbers: PlacedMechanism, joint: Joint) -> Array:
    """Return the axis of a joint."""
    if not numbers.spatial:
        return Z
    articulation = articulation_of_joint(joint)
    if articulation is not None and articulation.of_a:
        return numbers.direction(articulation.of_a[2])
    turns = [m for m in nested_parts(joint) if isinstance(m, Turning)]
    if turns:
        return np.cross(numbers.direction(turns[0].zero), numbers.direction(turns[0].quarter))
    directions = numbers.directions(joint.rows)
    return numbers.direction(directions[-1]) if directions else Z


def pivot_and_axis(numbers: PlacedMechanism, joint: Joint, angle: object) -> tuple[BodyPoint, Array]:
    """Return the point of a joint and the axis of one of its angles, both on the body that has the axis.

    The second body turns forward about the axis where the angle grows.
    """
    ends = joint_ends(numbers, joint)
    for part in nested_parts(angle):
        sign, inner = 1.0, part
        if isinstance(part, Sum) and len(part.terms) == 1:
            sign, inner = float(np.sign(numbers.number(part.terms[0][0]))), part.terms[0][1]
        if isinstance(inner, Turning):
            sign *= 1.0 if inner.zero.body == joint.bodies[0] else -1.0
            axis = sign * np.cross(numbers.direction(inner.zero), numbers.direction(inner.quarter))
            return next((end for end in ends if end.body == numbers.index[inner.zero.body]), ends[0]), axis
    return ends[0], joint_axis(numbers, joint)


def ground_stand(pen: Pen, places: tuple[BodyPoint, BodyPoint], swivel: bool = True) -> list[Mark]:
    """Return the stand of a ground point of a joint, if any."""
    for place in places:
        if place.body == GROUNDED:
            at, up = pen.numbers.in_ground_frame(place), pen.up
            if pen.numbers.spatial:
                return _draw_stand(pen, at)
            along = np.array([up[1], -up[0], 0.0])
            foot = at - 1.5 * pen.unit * up
            sides = [at, foot + 0.9 * pen.unit * along, foot - 0.9 * pen.unit * along]
            triangle = [pen.line(GROUNDED, sides, FILLED, closed=True)] if swivel else []
            return [*triangle, *pen.ground_hatching(foot if swivel else at, along, -up)]
    return []


def _draw_stand(pen: Pen, at: Array) -> list[Mark]:
    u, (first, second) = pen.unit, directions_across_axis(pen.up)
    foot = at - 1.8 * u * pen.up
    plate = [foot + u * 1.1 * (i * first + j * second) for i, j in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
    marks: list[Mark] = [pen.line(GROUNDED, plate, Look(GREY, "#c9cfd6", 0.8), closed=True)]
    for k in (-0.6, 0.0, 0.6):
        ends = [foot + u * (k * first - 1.1 * second), foot + u * ((k - 0.5) * first + 1.1 * second)]
        marks.append(pen.line(GROUNDED, ends, replace(EARTH, width=0.6)))
    return [*marks, pen.tube(GROUNDED, foot, at, 0.22, Look(GREY, "#c9cfd6", 0.8))]


def wheel_marks(
    pen: Pen, centre: BodyPoint, axis: Array, radius: float, body: str, look: Look | None = None
) -> list[Mark]:
    """Return a circle with a spoke, in the colour of its body."""
    colour = pen.colour(pen.numbers.index[body])
    at = pen.numbers.in_ground_frame(centre)
    ring = pen.ring(centre.body, at, axis, radius, look or Look(colour, colour, 1.6, 0.13))
    rim = pen.numbers.now.to_ground(ring.body, ring.points)
    return [ring, pen.line(centre.body, [at, rim[0]], Look(colour, "", 1.0)), pen.dot(centre, 0.2)]
