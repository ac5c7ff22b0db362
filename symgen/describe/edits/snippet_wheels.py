"""Tables of wheels and of what meets them: a disc, its contact, its rolling, a rack, and a rope over a sheave."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence

from symgen.base.errors import InputError
from symgen.describe.edits.snippet_tables import (
    FINEST,
    EditedFile,
    Spot,
    Table,
    between_lines,
    displacement_at,
    exact_number,
    need_body,
    pin_table,
    table_at,
    vector_text,
)

#: Of a new contact.
FRICTION, RESTITUTION = 0.3, 0.2
#: Radius of a wheel: its parameter is called by the body and this.
_RADIUS = "_radius"
#: Sine of the angle below which a rope runs straight past a sheave, so that its turn is that of the side it lies on.
_STRAIGHT = 1e-6


def _wheel_tables(file: EditedFile, spots: Sequence[Spot]) -> list[Table]:
    """Return a disc about a point, whose radius is a parameter; a pin holds it where a body has the point."""
    centre, rim = spots
    radius = _distance("wheel", centre, rim)
    name = file.take_free_name("wheel")
    own = file.take_name(f"{name}{_RADIUS}")
    way = ((rim.x - centre.x) / radius, (rim.y - centre.y) / radius)
    tables = [
        table_at(
            f"bodies.{name}",
            "mass = 1.0",
            f'inertia = "0.5*{own}**2"',
            f"points = {{ A = [0.0, 0.0], B = [{', '.join(_times(c, own) for c in way)}] }}",
            f"position = {vector_text((centre.x, centre.y))}",
        ),
        table_at(f"parameters.{own}", f"value = {exact_number(radius)}", 'unit = "m"'),
    ]
    if centre.body:
        tables.append(pin_table(file, centre, Spot(centre.x, centre.y, name, "A")))
    return tables


def _contact_tables(file: EditedFile, spots: Sequence[Spot]) -> list[Table]:
    """Return a contact, with friction, of a disc about a point with another wheel, by its centre, or with a line."""
    disc, other = (_at_wheel(file, spot) for spot in spots)
    radius, normal = _disc_on_line("touch", file, disc, other)
    own = _radius_of_wheel(file, other)
    shapes = (
        f'{{ body = "{disc.body}", at = {disc.written}, disc = {radius} }}',
        f'{{ body = "{other.body}", at = {other.written}, disc = {own} }}'
        if own and _radius_of_wheel(file, disc)
        else f'{{ line = "{other.owner}", on = {other.written}, normal = {vector_text(normal)} }}',
    )
    lines = (f"between = [{', '.join(shapes)}]", f"friction = {FRICTION}", f"restitution = {RESTITUTION}")
    return [table_at(f"contacts.{file.take_free_name('touch')}", *lines)]


def _rolling_tables(file: EditedFile, spots: Sequence[Spot]) -> list[Table]:
    """Return a joint that lets a disc about a point roll on a line of the ground or of another body."""
    disc, line = _at_wheel(file, spots[0]), spots[1]
    radius, (x, y) = _disc_on_line("roll", file, disc, line)
    lines = [
        'type = "rolling"',
        f'between = ["{disc.body}", "{line.owner}"]',
        f"radius = {radius}",
        f"axis = {vector_text((y, -x))}",
        f"on = {line.written}",
        f"centre = {disc.written}",
    ]
    if turn := file.angle_between(line.owner, disc.body):
        lines.append(f"offset = {exact_number(turn * math.dist((disc.x, disc.y), (line.x, line.y)))}")
    return [table_at(f"joints.{file.take_free_name('roll')}", *lines)]


def _rack_tables(file: EditedFile, spots: Sequence[Spot]) -> list[Table]:
    """Return a coupling of a pin and a slide on the ground: the pinion's radius reaches from its pin to the rack.

    Raises
    ------
    InputError
        If the points are no pin and no slide on the ground, or the slide runs through the pin.
    """
    joints = file.raw.get("joints", {})
    named = {str(joints.get(name, {}).get("type")): (name, spot) for spot in spots if (name := file.joint_at(spot))}
    (pin, centre), (slide, rack) = named.get("revolute", ("", spots[0])), named.get("translational", ("", spots[1]))
    moved = displacement_at(joints.get(slide, {}), rack)
    if not pin or moved is None:
        raise InputError("rack", "the pin of the pinion, then a point that slides on the ground", "other points")
    x, y = joints[slide]["axis"]
    size = math.hypot(x, y)
    # the foot of the pin on the rack moves along the axis by this for each radian
    lever = ((centre.y - rack.y) * x - (centre.x - rack.x) * y) / size
    if abs(lever) <= _STRAIGHT * size:
        raise InputError("rack", "a slide beside the pin", "one through it")
    radius = f"{joints[pin]['between'][1]}{_RADIUS}"
    own = file.raw.get("parameters", {}).get(radius, {})
    fits = isinstance(own, Mapping) and own.get("value") == float(exact_number(abs(lever)))
    factor = _times(math.copysign(1.0, lever), radius) if fits else exact_number(lever)
    lines = ['type = "coupling"', f"terms = {{ {pin} = {factor}, {slide} = -1.0 }}"]
    offset = lever * file.angle_between(*joints[pin]["between"]) - moved
    if abs(offset) > FINEST:
        lines.append(f"value = {exact_number(offset)}")
    return [table_at(f"joints.{file.take_free_name('rack')}", *lines)]


def _rope_tables(file: EditedFile, spots: Sequence[Spot]) -> list[Table]:
    """Return a rope from a point over a sheave, given by its centre and its rim, to another point."""
    first, centre, rim, last = spots
    radius = _distance("rope", centre, rim)
    if first.owner == last.owner:
        raise InputError("rope", "ends on two bodies, or on a body and the ground", f"'{first.owner}' twice")
    arriving, leaving = (centre.x - first.x, centre.y - first.y), (last.x - centre.x, last.y - centre.y)
    turn = arriving[0] * leaving[1] - arriving[1] * leaving[0]
    if abs(turn) <= _STRAIGHT * math.hypot(*arriving) * math.hypot(*leaving):
        turn = (last.x - first.x) * (centre.y - rim.y) - (last.y - first.y) * (centre.x - rim.x)
    side = "left" if turn > 0.0 else "right"
    sheave = f'{{ body = "{centre.body}", at' if centre.body else "{ at"
    over = f'over = [{sheave} = {centre.written}, radius = {exact_number(radius)}, turn = "{side}" }}]'
    return [table_at(f"joints.{file.take_free_name('rope')}", 'type = "rope"', *between_lines(first, last), over)]


def _disc_on_line(kind: str, file: EditedFile, disc: Spot, line: Spot) -> tuple[str, tuple[float, float]]:
    """Return the radius of a disc, and the normal of a line towards it in the frame of the line's body.

    Raises
    ------
    InputError
        If the disc belongs to no body, or to that of the line.
    """
    need_body(kind, disc)
    if disc.body == line.body:
        raise InputError(kind, "a line of another body or of the ground", f"'{disc.body}' twice")
    reach = _distance(kind, disc, line)
    normal = file.turn_into_body(line.owner, (disc.x - line.x) / reach, (disc.y - line.y) / reach)
    return _radius_of_wheel(file, disc) or exact_number(reach), normal


def _at_wheel(file: EditedFile, spot: Spot) -> Spot:
    """Return a spot as the centre of the wheel that a pin holds there, else as it is."""
    ends = file.ends_at_pin(spot.joint) if spot.joint else {}
    wheels = (spot._replace(body=body, point="A", at=(0.0, 0.0)) for body, at in ends.items() if at == '"A"')
    return next((wheel for wheel in wheels if _radius_of_wheel(file, wheel)), spot)


def _radius_of_wheel(file: EditedFile, spot: Spot) -> str:
    """Return the parameter that is the radius of a wheel about a spot, as a file has it; empty where there is none."""
    radius = f"{spot.body}{_RADIUS}"
    return f'"{radius}"' if spot.point == "A" and radius in file.raw.get("parameters", {}) else ""


def _distance(kind: str, a: Spot, b: Spot) -> float:
    reach = math.dist((a.x, a.y), (b.x, b.y))
    if reach <= 0.0:
        raise InputError(kind, "points in different places", "two in one place")
    return reach


def _times(factor: float, name: str) -> str:
    """Return a part of a length as a file has it."""
    digits = exact_number(factor)
    return {"0.0": "0.0", "1.0": f'"{name}"', "-1.0": f'"-{name}"'}.get(digits, f'"{digits}*{name}"')


#: What a hand adds -> its tables.
WHEELS: Mapping[str, Callable[[EditedFile, Sequence[Spot]], list[Table]]] = {
    "wheel": _wheel_tables,
    "touch": _contact_tables,
    "roll": _rolling_tables,
    "rack": _rack_tables,
    "rope": _rope_tables,
}
