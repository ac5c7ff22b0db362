"""How what touches and rolls in space is drawn: spheres with rings, planes, rims with a spoke, capsules and boxes."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from symgen.base.vocabulary.measures import Direction
from symgen.describe.contacts.outlines import Outline
from symgen.describe.drawing.joint_parts import GLASS, wheel_marks
from symgen.describe.drawing.pen import BodyPoint, Pen, directions_across_axis
from symgen.describe.drawing.scene import Array, Line, Look, Mark


def surface_marks(pen: Pen, outline: Outline, others: Sequence[BodyPoint], reach: float) -> list[Mark]:
    """Return the marks of the surface of a contact in space.

    Parameters
    ----------
    pen : Pen
        What draws.
    outline : Outline
        The surface.
    others : sequence of BodyPoint
        Points of what a plane meets.
    reach : float
        Size of what a plane meets [m].
    """
    numbers = pen.numbers
    place = numbers.place(outline.points[0])
    radius, sizes = numbers.number(outline.radius), [numbers.number(e) for e in outline.edges]
    colour = pen.colour(place.body)
    look = Look(colour, colour, 1.6, 0.2)
    at, turned = numbers.in_ground_frame(place), numbers.now.turns[place.body]
    if outline.normal is not None:
        return [floor_under_paths(pen, outline.normal, place, others, reach)]
    if len(sizes) == 3:
        return [pen.box(place.body, at, turned.T, np.array(sizes), look)]
    if outline.about is not None:
        axis = numbers.direction(outline.about)
        if not sizes:
            return wheel_marks(pen, place, axis, radius, outline.points[0].body)
        ends = [at + sign * 0.5 * sizes[0] * axis for sign in (-1.0, 1.0)]
        centres = [BodyPoint(place.body, point) for point in pen.points(place.body, ends)]
        sides = [
            pen.line(place.body, [end + radius * way for end in ends], replace(look, fill="", opacity=1.0))
            for across in directions_across_axis(axis)
            for way in (across, -across)
        ]
        return [*(mark for centre in centres for mark in ball_marks(pen, centre, radius)), *sides]
    if radius == 0.0:
        return [pen.dot(place, 0.22, replace(look, fill=look.ink))]
    ball = ball_marks(pen, place, abs(radius))
    return ball if radius > 0.0 else ball[1:]


def ball_marks(pen: Pen, centre: BodyPoint, radius: float) -> list[Mark]:
    """Return a sphere with three rings about the axes of the ground."""
    colour, at = pen.colour(centre.body), pen.numbers.in_ground_frame(centre)
    ball = replace(pen.dot(centre, 1.0, Look(colour, colour, 1.2, 0.2)), radius=radius)
    return [ball, *(pen.ring(centre.body, at, axis, radius, Look(colour, "", 0.7)) for axis in np.eye(3))]


def floor_under_paths(
    pen: Pen, normal: Direction, origin: BodyPoint, centres: Sequence[BodyPoint], radius: float
) -> Line:
    """Return a part of the plane through a point that holds whole paths, as its body sees these."""
    base, numbers = pen.numbers.index[normal.body], pen.numbers
    at = numbers.in_ground_frame(origin)
    seen = [
        poses.to_body(base, poses.to_ground(centre.body, [centre.at]))[0] for poses in numbers.all for centre in centres
    ]
    way = numbers.now.to_ground(base, seen)
    sides = list[list[Array]]()
    for e in directions_across_axis(numbers.direction(normal)):
        along = (way - at) @ e
        sides.append([(float(along.min()) - 1.5 * radius) * e, (float(along.max()) + 1.5 * radius) * e])
    corners = [at + sides[0][i] + sides[1][j] for i, j in ((0, 0), (1, 0), (1, 1), (0, 1))]
    return pen.line(base, corners, GLASS, closed=True)
