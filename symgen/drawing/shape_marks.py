"""Marks of the shapes that bodies of a file have."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from symgen.describe.mechanism import AnyBody, Shape, Vec
from symgen.drawing.markers import BodyPoint
from symgen.drawing.pen import Pen, across
from symgen.drawing.scene import Disc, Line, Look, Mark, Solid
from symgen.vocabulary.measures import Marker

#: Sides of a cylinder.
SIDES = 24


def shape_marks(pen: Pen, body: AnyBody, shape: Shape, colour: str) -> list[Mark]:
    """Return what is drawn of a shape.

    Parameters
    ----------
    pen : Pen
        What draws.
    body : Body or SpatialBody
        Whose shape it is.
    shape : Shape
        In the body's frame.
    colour : str
        Of the body, where the shape has none.
    """
    numbers = pen.numbers
    colour = shape.colour or colour
    look = Look(colour, colour, 1.6, 0.25)
    index = numbers.index[body.name]

    def place(point: Vec) -> BodyPoint:
        return numbers.place(Marker(body.name, point))

    if shape.kind == "polyline":
        points = tuple(place(point).at for point in shape.points)
        return [Line(index, points, look, shape.closed)]
    sizes = [numbers.number(e) for e in shape.sizes]
    middle = place(shape.at)
    at, turned = numbers.out(middle), numbers.now.turns[index]
    if shape.kind == "box":
        size = np.array([*sizes, 0.0]) if len(sizes) == 2 else np.array(sizes)
        return [pen.box(index, at, turned.T, size, replace(look, opacity=0.6) if numbers.spatial else look)]
    if shape.kind == "sphere" and numbers.spatial:
        rings = [pen.ring(index, at, axis, sizes[0], Look(colour, "", 0.7)) for axis in turned.T]
        return [Disc(index, middle.at, sizes[0], look), *rings]
    if not numbers.spatial:
        ring = pen.ring(index, at, np.array([0.0, 0.0, 1.0]), sizes[0], look)
        return [ring, Line(index, (middle.at, ring.points[0]), replace(look, width=1.0))]
    axis = turned @ numbers.vector(shape.axis)
    first, second = across(axis)
    turn = np.linspace(0.0, 2.0 * np.pi, SIDES, endpoint=False)[:, None]
    ring_points = sizes[0] * (np.cos(turn) * first + np.sin(turn) * second)
    ends = [at + 0.5 * sign * sizes[1] * axis + ring_points for sign in (-1.0, 1.0)]
    faces = [pen.points(index, ends[1]), pen.points(index, ends[0][::-1])]
    for k in range(SIDES):
        j = (k + 1) % SIDES
        faces.append(pen.points(index, [ends[0][k], ends[0][j], ends[1][j], ends[1][k]]))
    return [Solid(index, tuple(faces), replace(look, ink=colour, width=0.4, opacity=0.6))]
