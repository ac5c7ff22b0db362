"""From a mechanism and positions to its scene."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np

from symgen.describe.evaluate import parameter_values, scalars
from symgen.describe.mechanism import AnyBody, Mechanism, SpatialBody
from symgen.describe.start import described_start
from symgen.drawing.body_parts import outline, shape_marks
from symgen.drawing.force_parts import force_item
from symgen.drawing.pen import RIGID, BodyPoint, Pen, PlacedMechanism, parts
from symgen.drawing.scene import COLOURS, Array, Item, Look, Mark, Point, Scene, upwards
from symgen.drawing.symbols import gap_item, joint_item
from symgen.errors import InputError
from symgen.vocabulary.measures import Marker

#: A symbol in parts of the picture's diagonal, and of the usual distance between points of a body.
SHARE, OF_BODY = 0.017, 0.17
#: Joints whose symbols show a body that has no points but its centre of mass.
SHOWN = ("translational", "cylindrical", "screw", "rolling", "rolling-disc", "rolling-sphere", "gear")


def build_scene(
    mechanism: Mechanism,
    q: Sequence[float] | Array | None = None,
    values: Mapping[str, float] | None = None,
    open_joints: Sequence[str] = (),
) -> Scene:
    """Return what is drawn of a mechanism.

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
        q = described_start(mechanism, scalars(parameters))[0]
    rows = np.atleast_2d(np.asarray(q, dtype=np.float64))
    size = mechanism.body_coordinates
    if rows.ndim != 2 or rows.shape[1] != size or not len(rows):
        raise InputError("q", f"{size} coordinates, as {mechanism.name} has", str(rows.shape[-1]))
    rows = rows[:: max(1, len(rows) // 60)]
    numbers = PlacedMechanism(mechanism, parameters, rows)
    up = upwards([numbers.number(g) for g in mechanism.gravity], numbers.spatial)
    points = _points(numbers)
    unit = _unit(numbers, points)
    pen = Pen(numbers, unit, up)
    guided = {name for joint in mechanism.joints if joint.kind in SHOWN for name in joint.bodies}
    bodies = [_body_item(pen, body, points[body.name], guided) for body in mechanism.bodies]
    joints = [joint_item(pen, joint) for joint in mechanism.joints]
    forces = [force_item(pen, force) for force in mechanism.forces]
    faults = [gap_item(pen, item) for item in joints if item.name in open_joints]
    return Scene(
        name=mechanism.name,
        title=mechanism.title,
        items=(*bodies, *forces, *joints, *faults),
        spatial=numbers.spatial,
        up=up,
        unit=unit,
        frames=numbers.frames,
        carried=tuple(pen.carried),
    )


def _points(numbers: PlacedMechanism) -> dict[str, list[Point]]:
    """Return the points of each body from its centre of mass: those of joints and forces, and those with names."""
    by_body: dict[str, dict[Point, None]] = {frame.name: {} for frame in numbers.frames}
    names = [frame.name for frame in numbers.frames]
    for element in (*numbers.mechanism.joints, *numbers.mechanism.forces):
        for marker in parts(element):
            if isinstance(marker, Marker) and marker.body in by_body:
                place = numbers.place(marker)
                by_body[names[place.body]][_rounded(place.at)] = None
    for body in numbers.mechanism.bodies:
        for _, point in body.points:
            by_body[body.name][_rounded(numbers.place(Marker(body.name, point)).at)] = None
    return {name: list(points) for name, points in by_body.items()}


def _rounded(point: Point) -> Point:
    x, y, z = (round(c, 12) + 0.0 for c in point)
    return (x, y, z)


def _unit(numbers: PlacedMechanism, points: Mapping[str, list[Point]]) -> float:
    """Return the size of symbols [m]: small beside the mechanism, and beside what they are drawn on."""
    places = [numbers.now.out(numbers.index[name], own) for name, own in points.items() if own]
    everyone = (*numbers.mechanism.joints, *numbers.mechanism.forces)
    grounded = [m for element in everyone for m in numbers.markers(element) if m.body < 0]
    places += [numbers.now.out(-1, [m.at]) for m in grounded]
    places.append(numbers.now.centres[:-1])
    for name, shape in numbers.mechanism.shapes:
        corners = [numbers.place(Marker(name, point)).at for point in shape.points]
        places.append(numbers.now.out(numbers.index[name], np.array(corners).reshape(-1, 3)))
    everything = np.concatenate(places)
    whole = float(np.linalg.norm(np.ptp(everything, axis=0)))
    spans = [float(np.linalg.norm(np.ptp(np.array(own), axis=0))) for own in points.values() if len(own) > 1]
    sizes = [numbers.number(e) for _, shape in numbers.mechanism.shapes for e in shape.sizes]
    whole = max([whole, *sizes])
    spans = [s for s in spans if s > 0.0]
    usual = float(np.median(spans)) if spans else whole
    return min(SHARE * max(whole, usual), OF_BODY * usual) or 0.1


def _body_item(pen: Pen, body: AnyBody, points: list[Point], guided: set[str]) -> Item:
    """Return a body: its shape where it has one, else an outline of its points, and its centre of mass."""
    numbers = pen.numbers
    i = numbers.index[body.name]
    colour = COLOURS[i % len(COLOURS)]
    centre = BodyPoint(i, (0.0, 0.0, 0.0))
    shapes = [shape for name, shape in numbers.mechanism.shapes if name == body.name]
    marks: list[Mark]
    if body.is_point and not shapes:
        marks = [pen.dot(centre, 0.75, Look("#20262e", colour, 1.0))]
    elif shapes:
        marks = [mark for shape in shapes for mark in shape_marks(pen, body, shape, colour)]
    else:
        marks = outline(pen, i, points, _gyration(numbers, body), Look(colour, colour, 1.6, 0.16), body.name in guided)
    if not body.is_point:
        held = any(body.name in joint.bodies for joint in numbers.mechanism.joints)
        if numbers.spatial and not held and points and not shapes:
            marks += outline(pen, i, [], _gyration(numbers, body), Look(colour, colour, 1.0, 0.3), False)
        marks.append(pen.dot(centre, 0.34, replace(RIGID, width=0.8), mass=True))
    own = [p for p in points if any(p)]
    x, y, z = np.mean(np.array(own), axis=0) if own else np.zeros(3)
    return Item("body", body.name, "point" if body.is_point else "rigid", tuple(marks), label=(i, (x, y, z)))


def _gyration(numbers: PlacedMechanism, body: AnyBody) -> Array:
    """Return half the edges of the box of even density that has a body's mass and moments of inertia [m]."""
    mass = numbers.number(body.mass) or 1.0
    if isinstance(body, SpatialBody):
        xx, yy, zz = (numbers.number(e) for e in (body.inertia or ())[:3])
        squares = np.array([yy + zz - xx, xx + zz - yy, xx + yy - zz]) * 1.5 / mass
        return np.sqrt(np.maximum(squares, 0.0))
    radius = (2.0 * numbers.number(body.inertia) / mass) ** 0.5
    return np.array([radius, radius, 0.0])
