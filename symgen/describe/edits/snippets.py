"""Tables of new bodies, joints and forces, as text at its place in a mechanism file."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from typing import Any

from symgen.base.errors import InputError, quote, suggest
from symgen.base.vocabulary.measures import GROUND
from symgen.describe.edits.snippet_keys import KEYS, copy_changes, key_change, point_change
from symgen.describe.edits.snippet_tables import (
    FINEST,
    EditedFile,
    Spot,
    Table,
    between_lines,
    displacement_at,
    exact_number,
    insert_tables,
    need_body,
    ordered_pair,
    pin_table,
    short_number,
    table_at,
    uniform_body,
    vector_text,
)
from symgen.describe.edits.snippet_wheels import WHEELS
from symgen.describe.edits.text_changes import Change
from symgen.describe.files.places import DocumentOutline

#: Names of the points of a new body.
_LETTERS = "ABC"
#: Speed of a new motor of a pin [rad/s] and of a slide [m/s], stiffness [N/m] and damping [N s/m] of a new spring, a
#: new load and the push of a new cylinder [N].
SPEED, CREEP, STIFFNESS, DAMPING, LOAD, PUSH = 2.0, 0.1, 1000.0, 10.0, 10.0, 100.0
#: What can be added -> how many points it has at least, and at most.
POINTS_OF_KIND = {
    **{"body": (2, 3), "point": (2, 2), "copy": (2, 2)},
    **{"pin": (2, 2), "weld": (2, 2), "slide": (1, 2), "slot": (1, 2), "rod": (2, 2), "gear": (2, 2), "motor": (1, 1)},
    **{"stop": (1, 1), "friction": (1, 1), "spring": (2, 2), "cylinder": (2, 2), "load": (1, 1)},
    **{"wheel": (2, 2), "touch": (2, 2), "roll": (2, 2), "rack": (2, 2), "rope": (4, 4)},
}
#: What needs to know how bodies are turned.
TURNED = ("weld", "slide", "slot", "gear", "motor", "point", "stop", "touch", "roll", "rack")


def snippet_changes(
    kind: str,
    spots: Sequence[Spot],
    raw: Mapping[str, Any],
    parts: DocumentOutline,
    text: str,
    angles: Mapping[str, float] | None = None,
) -> tuple[tuple[Change, ...], str]:
    """Return the changes that add something to a file, one for each section, and the path of what they add.

    Parameters
    ----------
    kind : str
        What is added, one of `POINTS_OF_KIND`.
    spots : sequence of Spot
        The points that it is at. Of a slide or a slot the second one is where it leads to, along x of the ground by
        default; of a point or a copy the first one belongs to a body, and the second one is where it will be.
    raw, parts, text : mapping, DocumentOutline, str
        The file: its tables, their places, its text.
    angles : mapping, optional
        Body -> its angle at the start [rad]; 0 for others.

    Raises
    ------
    InputError
        If it cannot be added there.
    """
    if kind not in POINTS_OF_KIND:
        raise InputError("kind", "a part that can be added", quote(kind), suggest(kind, POINTS_OF_KIND))
    least, most = POINTS_OF_KIND[kind]
    if not least <= len(spots) <= most:
        count = f"{least} points" if least == most else f"{least} to {most} points"
        raise InputError(kind, count if most > 1 else "one point", str(len(spots)))
    if raw.get("mechanism", {}).get("space", "planar") != "planar":
        raise InputError(kind, "a mechanism in the plane", "one in space", "write its table into the text")
    file = EditedFile(raw, parts, text, angles or {})
    if kind in KEYS:
        return key_change(kind, file, *spots)
    if kind in ("point", "copy"):
        return (point_change if kind == "point" else copy_changes)(file, *spots)
    makers: dict[str, Callable[[EditedFile, Sequence[Spot]], list[Table]]] = {
        "body": _body_snippet,
        "pin": _pin_snippet,
        "weld": _weld_snippet,
        "slide": _slide_snippet,
        "slot": _slot_snippet,
        "rod": _rod_snippet,
        "gear": _gear_snippet,
        "spring": _spring_snippet,
        "cylinder": _cylinder_snippet,
        "motor": _motor_snippet,
        "load": _load_snippet,
        **WHEELS,
    }
    tables = makers[kind](file, spots)
    return insert_tables(tables, parts, text), next(path for path, _ in tables if not path.startswith("parameters."))


def _body_snippet(file: EditedFile, spots: Sequence[Spot]) -> list[Table]:
    """Return a body through points; where they are points of others, a pin holds them there.

    Its frame is at the first point, with the axes of the ground: its numbers are those of the hand, and joints that are
    drawn closed are closed.
    """
    corners = [(spot.x, spot.y) for spot in spots]
    sides = [math.dist(a, b) for a, b in zip(corners, [*corners[1:], corners[0]], strict=True)]
    if min(sides) <= 0.0:
        raise InputError("body", "points in different places", "two in one place")
    name = file.take_free_name("bar" if len(corners) == 2 else "plate")
    blocks = [uniform_body(name, dict(zip(_LETTERS, corners, strict=False)))]
    for letter, spot in zip(_LETTERS, spots, strict=False):
        if spot.body:
            blocks.append(pin_table(file, spot, Spot(spot.x, spot.y, name, letter)))
    return blocks


def _pin_snippet(file: EditedFile, spots: Sequence[Spot]) -> list[Table]:
    return [pin_table(file, *ordered_pair("pin", spots))]


def _weld_snippet(file: EditedFile, spots: Sequence[Spot]) -> list[Table]:
    """Return a weld of two points in one place; the bodies keep their angles."""
    a, b = ordered_pair("weld", spots)
    lines = ['type = "rigid"', *between_lines(a, b)]
    if angle := file.angle_between(a.owner, b.owner):
        lines.append(f"angle = {exact_number(angle)}")
    return [table_at(f"joints.{file.take_free_name('weld')}", *lines)]


def _slide_snippet(file: EditedFile, spots: Sequence[Spot]) -> list[Table]:
    """Return a slide of a point of a body, along the ground or along another body; the body keeps its angle."""
    first, start, axis = _line_of_slide("slide", file, spots)
    body, point = _sliding_end(file, spots[0], first)
    lines = ['type = "translational"', f'between = ["{first}", "{body}"]', f"at = [{start}, {point}]", f"axis = {axis}"]
    if angle := file.angle_between(first, body):
        lines.append(f"angle = {exact_number(angle)}")
    return [table_at(f"joints.{file.take_free_name('slide')}", *lines)]


def _slot_snippet(file: EditedFile, spots: Sequence[Spot]) -> list[Table]:
    """Return a slot in which a point of a body moves, in the ground or in another body; the body may turn."""
    first, start, axis = _line_of_slide("slot", file, spots)
    spot = spots[0]
    if first == spot.body or first in file.ends_at_pin(spot.joint):
        raise InputError("slot", "a point that can move along it", f"one that a pin holds on '{first}'")
    lines = [f'between = ["{spot.body}", "{first}"]', f"at = [{spot.written}, {start}]", f"axis = {axis}"]
    return [table_at(f"joints.{file.take_free_name('slot')}", 'type = "pin-in-slot"', *lines)]


def _line_of_slide(kind: str, file: EditedFile, spots: Sequence[Spot]) -> tuple[str, str, str]:
    """Return what a slide or a slot lies on, a point of it there and its direction, as a file has them."""
    spot, toward = spots[0], spots[1] if len(spots) > 1 else Spot(spots[0].x + 1.0, spots[0].y)
    need_body(kind, spot)
    way = (toward.x - spot.x, toward.y - spot.y)
    size = max(map(abs, way))
    if size <= 0.0:
        raise InputError(kind, "a direction", "one point twice")
    if 0.0 in way:
        way = (way[0] / size, way[1] / size)
    first, start = toward.owner, toward.written if toward.body else vector_text((spot.x, spot.y))
    return first, start, vector_text(file.turn_into_body(first, *way))


def _rod_snippet(file: EditedFile, spots: Sequence[Spot]) -> list[Table]:
    """Return a rod without mass that keeps the distance of two points."""
    a, b = ordered_pair("rod", spots)
    length = math.dist((a.x, a.y), (b.x, b.y))
    if length <= 0.0:
        raise InputError("rod", "points in different places", "two in one place")
    lines = ('type = "distance"', *between_lines(a, b), f"length = {exact_number(length)}")
    return [table_at(f"joints.{file.take_free_name('rod')}", *lines)]


def _gear_snippet(file: EditedFile, spots: Sequence[Spot]) -> list[Table]:
    """Return a pair of wheels of one size at two pins; another ratio moves the place where they touch.

    Raises
    ------
    InputError
        If the points are no pins that one body holds, as its ground or its carrier.
    """
    ends = [file.raw.get("joints", {}).get(spot.joint, {}).get("between", ()) for spot in spots]
    common = [body for body in ends[0] if body in ends[1]]
    if len(common) != 1 or any(len(pair) != 2 for pair in ends):
        raise InputError("gear", "two pins on one body or on the ground", "other points")
    wheels = [next(body for body in pair if body != common[0]) for pair in ends]
    radius = exact_number(0.5 * math.dist(*((spot.x, spot.y) for spot in spots)))
    lines = ['type = "gear"', f'between = ["{wheels[0]}", "{wheels[1]}"]', f"radii = [{radius}, {radius}]"]
    if common[0] != GROUND:
        lines.append(f'carrier = "{common[0]}"')
    offset = float(radius) * sum(file.angle_between(common[0], wheel) for wheel in wheels)
    if offset:
        lines.append(f"offset = {exact_number(offset)}")
    return [table_at(f"joints.{file.take_free_name('gear')}", *lines)]


def _sliding_end(file: EditedFile, spot: Spot, first: str) -> tuple[str, str]:
    """Return the body that slides at a point, and its point.

    At a pin it is the one that fewest joints hold, as the block at the end of a rod, and of several the one that was
    drawn last: a slide holds the angle of its body, and a rod that is held so does not turn.

    Raises
    ------
    InputError
        If what it slides along is pinned there.
    """
    ends = file.ends_at_pin(spot.joint) or {spot.body: spot.written}
    if first in ends:
        got = "the ground" if first == GROUND else f"'{first}'"
        raise InputError("slide", "a point that can slide", f"one that a pin holds on {got}", "take the pin out first")
    latest = [name for name in reversed(file.raw.get("bodies", {})) if name in ends]
    body = min(latest, key=file.count_joints)
    return body, ends[body]


def _spring_snippet(file: EditedFile, spots: Sequence[Spot]) -> list[Table]:
    lines = _lines_of_stretch("spring", spots)
    length = math.dist(*((spot.x, spot.y) for spot in spots))
    lines += [f"stiffness = {STIFFNESS}", f"damping = {DAMPING}", f"free_length = {short_number(length)}"]
    return [table_at(f"forces.{file.take_free_name('spring')}", *lines)]


def _cylinder_snippet(file: EditedFile, spots: Sequence[Spot]) -> list[Table]:
    """Return a cylinder that pushes two points apart."""
    lines = [*_lines_of_stretch("cylinder", spots), f"damping = {DAMPING}", f"actuator = {PUSH}"]
    return [table_at(f"forces.{file.take_free_name('cylinder')}", *lines)]


def _lines_of_stretch(kind: str, spots: Sequence[Spot]) -> list[str]:
    a, b = spots
    if a.owner == b.owner:
        raise InputError(kind, "points of two bodies, or of a body and the ground", f"'{a.owner}' twice")
    return ['type = "spring-damper"', *between_lines(a, b)]


def _motor_snippet(file: EditedFile, spots: Sequence[Spot]) -> list[Table]:
    """Return a driver that turns a pin, or moves a slide of the ground, on from where it is at the start."""
    (spot,) = spots
    name = file.joint_at(spot)
    joint = file.raw.get("joints", {}).get(name, {})
    if joint.get("type") == "revolute":
        begin, rate = file.angle_between(*joint["between"]), SPEED
    elif (displacement := displacement_at(joint, spot)) is not None:
        begin, rate = displacement, CREEP
    else:
        got = f"'{name}'" if name else "another point"
        raise InputError("motor", "a pin, which it turns, or a slide on the ground", got)
    value = f'value = "{exact_number(begin)} + {rate}*t"' if abs(begin) > FINEST else f'value = "{rate}*t"'
    return [table_at(f"joints.{file.take_free_name('motor')}", 'type = "driver"', f'joint = "{name}"', value)]


def _load_snippet(file: EditedFile, spots: Sequence[Spot]) -> list[Table]:
    (spot,) = spots
    need_body("load", spot)
    lines = ('type = "force"', f'body = "{spot.body}"', f"at = {spot.written}", f"force = [0.0, {-LOAD}]")
    return [table_at(f"forces.{file.take_free_name('load')}", *lines)]
