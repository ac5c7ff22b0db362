"""Contacts of a robot with the ground, from its shapes of collision."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping
from itertools import product
from typing import Any

from symgen.base.vocabulary.rotations import scalar_product
from symgen.describe.formats._drives import names_with_count, tidy_numbers
from symgen.describe.formats._names import DescriptionNames
from symgen.describe.formats._poses import Pose, Vector, matrix_transpose, scaled_vector, unit_vector
from symgen.describe.formats._robot import GROUND, LeftOut, Robot, TouchingShape

#: A cylinder whose axis is nearer to the normal than this cosine stands on its face, which no pair of shapes has.
_UPRIGHT = 0.5
#: Part of a unit by which an edge of a box may miss an axis of its body.
_ALONG = 1e-9


def ground_contacts(
    robot: Robot, names: DescriptionNames, carriers: Mapping[str, str], place_of_body: Callable[[str], Pose]
) -> tuple[dict[str, Any], list[LeftOut]]:
    """Return the tables ``[contacts.NAME]`` of shapes that touch the ground, and what they leave out.

    The ground is the plane of the file. Without one it is horizontal, through the origin, or through the lowest point
    that touches it where the motion starts, if that is lower.

    Parameters
    ----------
    robot : Robot
        What a file describes.
    names : DescriptionNames
        Names that are taken.
    carriers : mapping of str to str
        Link -> the link whose body it belongs to.
    place_of_body : callable
        Such a link -> the frame of its body in the ground frame.
    """
    links = {name: link for name, link in robot.links.items() if carriers[name] != GROUND}
    fixed = [
        shape.moved(link.place) for name, link in robot.links.items() if name not in links for shape in link.touching
    ]
    floor = next((shape for shape in (*robot.touching_ground, *fixed) if shape.sort == "plane"), None)
    planes = [] if floor is None else [floor]
    normal = matrix_transpose(floor.frame.rotation)[2] if floor else _upwards(robot.gravity)
    tables, lowest, lost = dict[str, Any](), math.inf, dict[str, list[str]]()
    for name, link in links.items():
        body = carriers[name]
        inner = place_of_body(body).inverse() @ link.place
        for k, shape in enumerate(link.touching, 1):
            placed = shape.moved(link.place)
            pieces = list(_pieces(shape.moved(inner), _cosine(placed, normal)))
            if not pieces:
                lost.setdefault(shape.sort, []).append(name)
            stem = name if k == 1 else f"{name}_{k}"
            for i, piece in enumerate(pieces, 1):
                table = {"body": names.name_for("link", body)} | piece
                own = names.name_for("contact", stem if len(pieces) == 1 else f"{stem}_{i}")
                tables[own] = {"between": [table, None]} | _surfaces(shape, planes)
            if pieces:
                lowest = min(lowest, _lowest(placed, normal))
    on = floor.frame.origin if floor else scaled_vector(min(0.0, lowest), normal)
    ground = {"plane": "ground", "on": tidy_numbers(on), "normal": tidy_numbers(normal)}
    for table in tables.values():
        table["between"][1] = ground
    left_out = [
        LeftOut(f"contacts of a {sort}", names_with_count(where), _WHY.get(sort, _OTHERS), True)
        for sort, where in lost.items()
    ]
    if others := [shape.sort for shape in (*robot.touching_ground, *fixed) if shape is not floor]:
        left_out.append(LeftOut("shapes of the ground", names_with_count(others), "bodies touch one plane", True))
    return tables, left_out


_OTHERS = "spheres, capsules, boxes and wheels touch the ground"
_WHY = {"cylinder": "it stands on its face, and rims of wheels touch alone"}


def _surfaces(shape: TouchingShape, plane: list[TouchingShape]) -> dict[str, float]:
    """Return the keys of a contact."""
    both = [shape, *plane]
    surfaces = {"friction": min(x.friction for x in both), "restitution": max(x.restitution for x in both)}
    return {key: x for key, x in surfaces.items() if x}


def _upwards(gravity: Vector) -> Vector:
    return unit_vector(scaled_vector(-1.0, gravity)) if any(gravity) else (0.0, 0.0, 1.0)


def _cosine(shape: TouchingShape, normal: Vector) -> float:
    """Return the cosine between a shape's third axis and the normal of the ground."""
    return float(scalar_product(matrix_transpose(shape.frame.rotation)[2], normal))


def _pieces(shape: TouchingShape, cosine: float) -> Iterator[dict[str, Any]]:
    """Yield the shapes of symgen that a shape in the frame of its body is made of; none where there is no such."""
    frame, sizes = shape.frame, shape.sizes
    at, axis = {"at": tidy_numbers(frame.origin)}, {"axis": tidy_numbers(matrix_transpose(frame.rotation)[2])}
    if min(sizes, default=0.0) <= 0.0:
        return
    if shape.sort == "sphere":
        yield at | {"sphere": sizes[0]}
    elif shape.sort == "capsule":
        yield at | axis | {"capsule": list(sizes)}
    elif shape.sort == "box":
        if all(min(abs(abs(x) - 1.0), abs(x)) < _ALONG for row in frame.rotation for x in row):
            yield at | {"box": tidy_numbers([scalar_product(map(abs, row), sizes) for row in frame.rotation])}
        else:
            yield from ({"at": tidy_numbers(corner)} for corner in _corners(shape))
    elif shape.sort == "cylinder" and abs(cosine) < _UPRIGHT:
        for end in _ends(shape):
            yield {"at": tidy_numbers(end)} | axis | {"disc": sizes[0]}


def _corners(box: TouchingShape) -> list[Vector]:
    a, b, c = (0.5 * x for x in box.sizes)
    return [box.frame.point_in_outer_frame((i * a, j * b, k * c)) for i, j, k in product((-1.0, 1.0), repeat=3)]


def _ends(shape: TouchingShape) -> list[Vector]:
    """Return the centres of both ends of a capsule or a cylinder."""
    return [shape.frame.point_in_outer_frame((0.0, 0.0, way * shape.sizes[1])) for way in (-0.5, 0.5)]


def _lowest(shape: TouchingShape, normal: Vector) -> float:
    """Return the height of the lowest point of a shape in the ground frame."""
    if shape.sort == "box":
        return min(float(scalar_product(normal, corner)) for corner in _corners(shape))
    if shape.sort == "sphere":
        return float(scalar_product(normal, shape.frame.origin)) - shape.sizes[0]
    sine = 1.0 if shape.sort == "capsule" else math.sqrt(1.0 - _cosine(shape, normal) ** 2)
    return min(float(scalar_product(normal, end)) for end in _ends(shape)) - shape.sizes[0] * sine
