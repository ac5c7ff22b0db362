"""Bodies: their shapes, or outlines that say nothing of a shape, bars and plates through their points."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from itertools import pairwise

import numpy as np

from symgen.describe.mechanism import AnyBody, Shape, Vec
from symgen.drawing.pen import BodyPoint, Pen, across
from symgen.drawing.scene import Array, Disc, Line, Look, Mark, Point, Solid, Tube
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


#: Half the width of a bar, in units.
HALF = 0.38


def outline(pen: Pen, body: int, points: Sequence[Point], gyration: Array, look: Look, shown: bool) -> list[Mark]:
    """Return a body as bars or a plate through its points; one without is a disc or box of its inertia.

    Parameters
    ----------
    pen : Pen
        What draws.
    body : int
        Its index.
    points : sequence of Point
        Its points from its centre of mass.
    gyration : Array, shape (3,)
        Half the edges of a box of its mass and inertia, in the plane a radius [m].
    look : Look
        Of the outline.
    shown : bool
        Whether symbols of joints show the body already where it has no points.
    """
    away = np.array([p for p in points]).reshape(-1, 3)
    if not len(away) or not np.any(np.ptp(np.vstack([away, np.zeros(3)]), axis=0) > 0.0):
        return [] if shown else _of_inertia(pen, body, gyration, look)
    if len(away) == 1:
        away = np.vstack([away, np.zeros(3)])
    middle = away.mean(axis=0)
    _, spread, axes = np.linalg.svd(away - middle, full_matrices=False)
    length = spread[0]
    if len(spread) < 2 or spread[1] <= 1e-6 * length:  # in a line
        order = np.argsort((away - middle) @ axes[0])
        return [_bar(pen, body, away[order[0]], away[order[-1]], look)]
    if len(spread) < 3 or spread[2] <= 1e-6 * length:
        corners = hull((away - middle) @ axes[:2].T)
        plate = Line(body, _points(away[corners]), look, closed=True)
        inner = [p for k, p in enumerate(away) if k not in set(corners)]
        if not pen.numbers.spatial or len(corners) < 3:
            return [plate]
        ends = np.vstack([away[corners], away[corners[:1]]])
        bars = [_bar(pen, body, a, b, look) for a, b in pairwise(ends)]
        return [plate, *bars, *(_bar(pen, body, middle, p, look) for p in inner)]
    if len(away) == 4:
        pairs = [(i, j) for i in range(4) for j in range(i)]
        return [_bar(pen, body, away[i], away[j], look) for i, j in pairs]
    return [_bar(pen, body, middle, p, look) for p in away]


def _of_inertia(pen: Pen, body: int, gyration: Array, look: Look) -> list[Mark]:
    at, turned = pen.numbers.now.centres[body], pen.numbers.now.turns[body]
    if pen.numbers.spatial:
        return [pen.box(body, at, turned.T, 2.0 * np.maximum(gyration, 0.02 * float(gyration.max())), look)]
    radius = float(gyration[0])
    ring = pen.ring(body, at, np.array([0.0, 0.0, 1.0]), radius, replace(look, dashed=True))
    return [ring, Line(body, ((0.0, 0.0, 0.0), (radius, 0.0, 0.0)), replace(look, fill=""))]


def _points(points: Array) -> tuple[Point, ...]:
    return tuple((float(x), float(y), float(z)) for x, y, z in points)


def _bar(pen: Pen, body: int, a: Array, b: Array, look: Look) -> Mark:
    """Return a bar with round ends, in space a tube."""
    ends = _points(np.array([a, b]))
    half = HALF * pen.unit
    if pen.numbers.spatial:
        return Tube(body, ends[0], ends[1], 0.6 * half, replace(look, opacity=0.45, width=1.0))
    way = np.arctan2(b[1] - a[1], b[0] - a[0])
    turn = np.linspace(-0.5 * np.pi, 0.5 * np.pi, 9)
    first = [b + half * np.array([np.cos(way + t), np.sin(way + t), 0.0]) for t in turn]
    second = [a - half * np.array([np.cos(way + t), np.sin(way + t), 0.0]) for t in turn]
    return Line(body, _points(np.array(first + second)), look, closed=True)


def hull(points: Array) -> list[int]:
    """Return the corners of the convex hull of points in a plane, counter-clockwise."""
    order = [int(i) for i in np.lexsort((points[:, 1], points[:, 0]))]

    def chain(indices: Sequence[int]) -> list[int]:
        corners: list[int] = []
        for i in indices:
            while len(corners) > 1 and _turn(points[corners[-2]], points[corners[-1]], points[i]) <= 0.0:
                corners.pop()
            corners.append(i)
        return corners[:-1]

    return chain(order) + chain(order[::-1])


def _turn(a: Array, b: Array, c: Array) -> float:
    return float((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]))
