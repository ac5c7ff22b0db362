"""The scene of a mechanism in positions; bodies as their shapes, or as bars and plates through their points."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from itertools import pairwise

import numpy as np

from symgen.base.errors import InputError
from symgen.base.vocabulary.measures import GROUND, Marker, markers_in
from symgen.describe.contacts.outlines import Outline
from symgen.describe.drawing.drawn_surfaces import contact_items, outlines_of_contacts, size_of_outline
from symgen.describe.drawing.force_parts import force_item
from symgen.describe.drawing.joint_parts import sliding_direction
from symgen.describe.drawing.meshes import mesh_faces
from symgen.describe.drawing.pen import RIGID, BodyPoint, Pen, PlacedMechanism, directions_across_axis
from symgen.describe.drawing.scene import (
    GREY,
    GROUNDED,
    Array,
    DrawnCircle,
    Item,
    Line,
    Look,
    Mark,
    Point,
    Scene,
    Solid,
    Tube,
    axis_against_gravity,
)
from symgen.describe.drawing.symbols import gap_mark, joint_symbol
from symgen.describe.formulas.evaluate import parameter_values, scalar_values
from symgen.describe.formulas.start import described_start
from symgen.describe.mechanism import AnyBody, Mechanism, Shape, SpatialBody, Vec
from symgen.describe.modal_body import Modal

#: A symbol in parts of the picture's diagonal, and of the usual distance between points of a body.
SHARE, OF_BODY = 0.017, 0.17
#: Joints whose symbols show a body that has no points but its centre of mass.
SHOWN = ("translational", "cylindrical", "screw", "rolling", "rolling-disc", "rolling-sphere", "gear")
#: Sides of a cylinder; half the width of a bar, in units.
SIDES, HALF = 24, 0.38


def build_scene(
    mechanism: Mechanism,
    q: Sequence[float] | Array | None = None,
    values: Mapping[str, float] | None = None,
    open_joints: Sequence[str] = (),
) -> Scene:
    """Return the scene of a mechanism.

    Parameters
    ----------
    mechanism : Mechanism
        Any.
    q : array, shape (nq,) or (k, nq), optional
        Coordinates of all bodies; symbols are laid out for the first, guides long enough for all. The described start
        by default, which may be open.
    values : mapping of str to float, optional
        Parameters that differ from the described ones.
    open_joints : sequence of str
        Joints that are marked as open.

    Raises
    ------
    InputError
        If `q` has not as many numbers as the mechanism has coordinates.
    """
    parameters = parameter_values(mechanism, values)
    if q is None:
        q = described_start(mechanism, scalar_values(parameters))[0]
    rows = np.atleast_2d(np.asarray(q, dtype=np.float64))
    size = mechanism.body_coordinates
    if rows.ndim != 2 or rows.shape[1] != size or not len(rows):
        raise InputError("q", f"{size} coordinates, as {mechanism.name} has", str(rows.shape[-1]))
    rows = rows[:: max(1, len(rows) // 60)]
    numbers = PlacedMechanism(mechanism, parameters, rows)
    up = axis_against_gravity([numbers.number(g) for g in mechanism.gravity], numbers.spatial)
    points = _points_of_bodies(numbers)
    unit = _symbol_size(numbers, points)
    pen = Pen(numbers, unit, up)
    guided = {name for joint in mechanism.joints if joint.kind in SHOWN for name in joint.bodies}
    discs = [each for _, outlines in outlines_of_contacts(mechanism) for each in outlines if _is_central(numbers, each)]
    guided |= {disc.points[0].body for disc in discs}
    bodies = [_body_item(pen, body, points[body.name], guided) for body in mechanism.bodies]
    joints = [joint_symbol(pen, joint) for joint in mechanism.joints]
    forces = [force_item(pen, force) for force in mechanism.forces if force.kind != "modal"]
    faults = [gap_mark(pen, item) for item in joints if item.name in open_joints]
    return Scene(
        name=mechanism.name,
        title=mechanism.title,
        items=(*_ground_item(pen), *bodies, *contact_items(pen), *forces, *joints, *faults),
        spatial=numbers.spatial,
        up=up,
        unit=unit,
        frames=numbers.frames,
        carried=tuple(pen.carried),
    )


def _points_of_bodies(numbers: PlacedMechanism) -> dict[str, list[Point]]:
    """Return the points of each body from its centre of mass: points of joints and forces, and named points."""
    names = [body.name for body in numbers.mechanism.bodies]
    by_body: dict[str, dict[Point, None]] = {name: {} for name in names}
    for element in (*numbers.mechanism.joints, *numbers.mechanism.forces, *_outlines_with_points(numbers)):
        for marker in markers_in(element):
            if marker.body in by_body:
                place = numbers.place(marker)
                by_body[names[place.body]][_round_point(place.at)] = None
    for joint in numbers.mechanism.joints:
        if joint.kind != "pin-in-slot" or numbers.spatial:
            continue
        pin, slot = numbers.markers(joint.rows[0])
        if slot.body != GROUNDED:  # which is as long as its slot
            along = sliding_direction(numbers, joint)
            own = numbers.now.turns[slot.body].T @ along
            for reach in numbers.range_along(slot, pin, along):
                x, y, z = np.array(slot.at) + reach * own
                by_body[names[slot.body]][_round_point((x, y, z))] = None
    for body in numbers.mechanism.bodies:
        for _, point in body.points:
            by_body[body.name][_round_point(numbers.place(Marker(body.name, point)).at)] = None
    return {name: list(points) for name, points in by_body.items()}


def _outlines_with_points(numbers: PlacedMechanism) -> list[Outline]:
    """Return the outlines of contacts whose points bodies reach to: all but lines, and discs about centres of mass."""
    outlines = [each for _, outlines in outlines_of_contacts(numbers.mechanism) for each in outlines]
    return [each for each in outlines if each.normal is None and not _is_central(numbers, each)]


def _is_central(numbers: PlacedMechanism, outline: Outline) -> bool:
    """Return whether an outline is a disc about the centre of mass of its body, which shows the body."""
    return size_of_outline(numbers, outline) != 0.0 and not any(numbers.place(outline.points[0]).at)


def _round_point(point: Point) -> Point:
    x, y, z = (round(c, 12) + 0.0 for c in point)
    return (x, y, z)


def _symbol_size(numbers: PlacedMechanism, points: Mapping[str, list[Point]]) -> float:
    """Return the size of symbols [m]: small against the mechanism and its bodies."""
    places = [numbers.now.to_ground(numbers.index[name], own) for name, own in points.items() if own]
    everyone = (*numbers.mechanism.joints, *numbers.mechanism.forces)
    grounded = [m for element in everyone for m in numbers.markers(element) if m.body < 0]
    places += [numbers.now.to_ground(-1, [m.at]) for m in grounded]
    places.append(numbers.now.centres[:-1])
    for name, shape in numbers.mechanism.shapes:
        corners: Sequence[Point] | Array = [numbers.place(Marker(name, point)).at for point in shape.points]
        if shape.kind == "mesh":
            corners = mesh_faces(numbers, name, shape)
        places.append(numbers.now.to_ground(numbers.index[name], np.array(corners).reshape(-1, 3)))
    everything = np.concatenate(places)
    whole = float(np.linalg.norm(np.ptp(everything, axis=0)))
    spans = [float(np.linalg.norm(np.ptp(np.array(own), axis=0))) for own in points.values() if len(own) > 1]
    sizes = [numbers.number(e) for _, shape in numbers.mechanism.shapes for e in shape.sizes]
    sizes += [size_of_outline(numbers, e) for _, each in outlines_of_contacts(numbers.mechanism) for e in each]
    whole = max([whole, *sizes])
    spans = [s for s in spans if s > 0.0]
    usual = float(np.median(spans)) if spans else whole
    return min(SHARE * max(whole, usual), OF_BODY * usual) or 0.1


def _ground_item(pen: Pen) -> list[Item]:
    """Return the shapes of the ground, where it has some."""
    shapes = [shape for name, shape in pen.numbers.mechanism.shapes if name == GROUND]
    marks = tuple(mark for shape in shapes for mark in _shape_marks(pen, GROUND, shape, GREY))
    return [Item("ground", GROUND, "ground", marks)] if marks else []


def _body_item(pen: Pen, body: AnyBody, points: list[Point], guided: set[str]) -> Item:
    """Return a body: its shape where it has one, else an outline of its points, and its centre of mass."""
    numbers = pen.numbers
    i = numbers.index[body.name]
    colour = pen.colour(i)
    centre = BodyPoint(i, (0.0, 0.0, 0.0))
    if "." in body.name:  # a node of a beam, whose elements draw it, or an interface
        return Item("body", body.name, "node", (pen.dot(centre, 0.18, RIGID),), label=(i, (0.0, 0.0, 0.0)))
    shapes = [shape for name, shape in numbers.mechanism.shapes if name == body.name]
    marks: list[Mark]
    if body.modal is not None and not shapes:
        return Item("body", body.name, "modal", _outline_marks(pen, body.name, body.modal), label=(i, (0.0, 0.0, 0.0)))
    if body.is_point and not shapes:
        marks = [pen.dot(centre, 0.75, Look("#20262e", colour, 1.0))]
    elif shapes:
        marks = [mark for shape in shapes for mark in _shape_marks(pen, body.name, shape, colour)]
    else:
        marks = _body_outline(
            pen,
            i,
            points,
            _half_edges_of_inertia_box(numbers, body),
            Look(colour, colour, 1.6, 0.16),
            body.name in guided,
        )
    if not body.is_point:
        held = any(body.name in joint.bodies for joint in numbers.mechanism.joints)
        if numbers.spatial and not held and points and not shapes:
            marks += _body_outline(
                pen, i, [], _half_edges_of_inertia_box(numbers, body), Look(colour, colour, 1.0, 0.3), False
            )
        marks.append(pen.dot(centre, 0.34, replace(RIGID, width=0.8), mass=True))
    own = [p for p in points if any(p)]
    x, y, z = np.mean(np.array(own), axis=0) if own else np.zeros(3)
    return Item("body", body.name, "point" if body.is_point else "rigid", tuple(marks), label=(i, (x, y, z)))


def _outline_marks(pen: Pen, name: str, modal: Modal) -> tuple[Mark, ...]:
    """Return the lines of a modal body, which move with its modes."""
    first, origin = pen.numbers.outlines[name], (0.0, 0.0, 0.0)
    colour = pen.colour(pen.numbers.index[name])
    ends = [(BodyPoint(first + a, origin), BodyPoint(first + b, origin)) for a, b in modal.outline.lines]
    lines = [pen.stretch("rod", a, b, Look(colour, "", 2.0)) for a, b in ends]
    return (*lines, pen.dot(BodyPoint(pen.numbers.index[name], origin), 0.34, replace(RIGID, width=0.8), mass=True))


def _half_edges_of_inertia_box(numbers: PlacedMechanism, body: AnyBody) -> Array:
    """Return half the edges of the box of even density that has a body's mass and moments of inertia [m]."""
    mass = numbers.number(body.mass) or 1.0
    if isinstance(body, SpatialBody):
        xx, yy, zz = (numbers.number(e) for e in (body.inertia or ())[:3])
        squares = np.array([yy + zz - xx, xx + zz - yy, xx + yy - zz]) * 1.5 / mass
        return np.sqrt(np.maximum(squares, 0.0))
    radius = (2.0 * numbers.number(body.inertia) / mass) ** 0.5
    return np.array([radius, radius, 0.0])


def _shape_marks(pen: Pen, body: str, shape: Shape, colour: str) -> list[Mark]:
    """Return the marks of a shape.

    Parameters
    ----------
    pen : Pen
        What draws.
    body : str
        The body of the shape, or the ground.
    shape : Shape
        In the body's frame.
    colour : str
        Of the body, where the shape has none.
    """
    numbers = pen.numbers
    colour = shape.colour or colour
    look = Look(colour, colour, 1.6, 0.25)
    index = numbers.index[body]

    def place(point: Vec) -> BodyPoint:
        return numbers.place(Marker(body, point))

    if shape.kind == "polyline":
        points = tuple(place(point).at for point in shape.points)
        return [Line(index, points, look, shape.closed)]
    if shape.kind == "mesh":
        faces_of = tuple(_as_tuples(face) for face in mesh_faces(numbers, body, shape))
        return [Solid(index, faces_of, replace(look, ink=colour, width=0.4, opacity=1.0), convex=False)]
    sizes = [numbers.number(e) for e in shape.sizes]
    middle = place(shape.at)
    at, turned = numbers.in_ground_frame(middle), numbers.now.turns[index]
    if shape.kind == "box":
        size = np.array([*sizes, 0.0]) if len(sizes) == 2 else np.array(sizes)
        return [pen.box(index, at, turned.T, size, replace(look, opacity=0.6) if numbers.spatial else look)]
    if shape.kind == "sphere" and numbers.spatial:
        rings = [pen.ring(index, at, axis, sizes[0], Look(colour, "", 0.7)) for axis in turned.T]
        return [DrawnCircle(index, middle.at, sizes[0], look), *rings]
    if not numbers.spatial:
        ring = pen.ring(index, at, np.array([0.0, 0.0, 1.0]), sizes[0], look)
        return [ring, Line(index, (middle.at, ring.points[0]), replace(look, width=1.0))]
    axis = turned @ numbers.vector(shape.axis)
    first, second = directions_across_axis(axis)
    turn = np.linspace(0.0, 2.0 * np.pi, SIDES, endpoint=False)[:, None]
    ring_points = sizes[0] * (np.cos(turn) * first + np.sin(turn) * second)
    ends = [at + 0.5 * sign * sizes[1] * axis + ring_points for sign in (-1.0, 1.0)]
    faces = [pen.points(index, ends[1]), pen.points(index, ends[0][::-1])]
    for k in range(SIDES):
        j = (k + 1) % SIDES
        faces.append(pen.points(index, [ends[0][k], ends[0][j], ends[1][j], ends[1][k]]))
    return [Solid(index, tuple(faces), replace(look, ink=colour, width=0.4, opacity=0.6))]


def _body_outline(pen: Pen, body: int, points: Sequence[Point], gyration: Array, look: Look, shown: bool) -> list[Mark]:
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
        Whether symbols of joints already show a body without points.
    """
    away = np.array([p for p in points]).reshape(-1, 3)
    if not len(away) or not np.any(np.ptp(np.vstack([away, np.zeros(3)]), axis=0) > 0.0):
        return [] if shown else _inertia_mark(pen, body, gyration, look)
    if len(away) == 1:
        away = np.vstack([away, np.zeros(3)])
    middle = away.mean(axis=0)
    _, spread, axes = np.linalg.svd(away - middle, full_matrices=False)
    length = spread[0]
    if len(spread) < 2 or spread[1] <= 1e-6 * length:  # in a line
        order = np.argsort((away - middle) @ axes[0])
        return [_bar_mark(pen, body, away[order[0]], away[order[-1]], look)]
    if len(spread) < 3 or spread[2] <= 1e-6 * length:
        corners = convex_hull((away - middle) @ axes[:2].T)
        plate = Line(body, _as_tuples(away[corners]), look, closed=True)
        inner = [p for k, p in enumerate(away) if k not in set(corners)]
        if not pen.numbers.spatial or len(corners) < 3:
            return [plate]
        ends = np.vstack([away[corners], away[corners[:1]]])
        bars = [_bar_mark(pen, body, a, b, look) for a, b in pairwise(ends)]
        return [plate, *bars, *(_bar_mark(pen, body, middle, p, look) for p in inner)]
    if len(away) == 4:
        pairs = [(i, j) for i in range(4) for j in range(i)]
        return [_bar_mark(pen, body, away[i], away[j], look) for i, j in pairs]
    return [_bar_mark(pen, body, middle, p, look) for p in away]


def _inertia_mark(pen: Pen, body: int, gyration: Array, look: Look) -> list[Mark]:
    at, turned = pen.numbers.now.centres[body], pen.numbers.now.turns[body]
    if pen.numbers.spatial:
        return [pen.box(body, at, turned.T, 2.0 * np.maximum(gyration, 0.02 * float(gyration.max())), look)]
    radius = float(gyration[0])
    ring = pen.ring(body, at, np.array([0.0, 0.0, 1.0]), radius, replace(look, dashed=True))
    return [ring, Line(body, ((0.0, 0.0, 0.0), (radius, 0.0, 0.0)), replace(look, fill=""))]


def _as_tuples(points: Array) -> tuple[Point, ...]:
    return tuple((x, y, z) for x, y, z in points.tolist())


def _bar_mark(pen: Pen, body: int, a: Array, b: Array, look: Look) -> Mark:
    """Return a bar with round ends, in space a tube."""
    ends = _as_tuples(np.array([a, b]))
    half = HALF * pen.unit
    if pen.numbers.spatial:
        return Tube(body, ends[0], ends[1], 0.6 * half, replace(look, opacity=0.45, width=1.0))
    way = np.arctan2(b[1] - a[1], b[0] - a[0])
    turn = way + np.linspace(-0.5 * np.pi, 0.5 * np.pi, 9)
    rim = half * np.column_stack([np.cos(turn), np.sin(turn), np.zeros(len(turn))])
    return Line(body, _as_tuples(np.concatenate([b + rim, a - rim])), look, closed=True)


def convex_hull(points: Array) -> list[int]:
    """Return the corners of the convex hull of points in a plane, counter-clockwise."""
    order = [int(i) for i in np.lexsort((points[:, 1], points[:, 0]))]

    def hull_chain(indices: Sequence[int]) -> list[int]:
        corners: list[int] = []
        for i in indices:
            while len(corners) > 1 and _turn_of_corner(points[corners[-2]], points[corners[-1]], points[i]) <= 0.0:
                corners.pop()
            corners.append(i)
        return corners[:-1]

    return hull_chain(order) + hull_chain(order[::-1])


def _turn_of_corner(a: Array, b: Array, c: Array) -> float:
    return float((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]))
