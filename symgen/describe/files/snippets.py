"""Tables of new bodies, joints and forces, as text at its place in a mechanism file."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from string import ascii_uppercase
from typing import Any, NamedTuple

from symgen.base.errors import InputError, quote, suggest
from symgen.base.vocabulary.measures import GROUND
from symgen.describe.files.places import Outline
from symgen.describe.files.text_changes import Change

#: Names of the points of a new body.
_LETTERS = "ABC"
#: Speed of a new motor [rad/s], stiffness [N/m] and damping [N s/m] of a new spring, a new load [N].
SPEED, STIFFNESS, DAMPING, LOAD = 2.0, 1000.0, 10.0, 10.0
#: What can be added -> how many points it has at least, and at most.
POINTS_OF_KIND = {
    **{"body": (2, 3), "pin": (2, 2), "weld": (2, 2), "slide": (1, 2), "spring": (2, 2), "motor": (1, 1)},
    **{"load": (1, 1), "point": (2, 2)},
}
#: What needs to know how bodies are turned.
TURNED = ("weld", "slide", "motor", "point")
#: Angles [rad] that closing a loop leaves where the hand meant 0.
FINEST = 1e-9
#: What sums of a few numbers leave of rounding, beside the largest of them and beside 1.
ROUNDING = 1e-14


class Spot(NamedTuple):
    """A point that was pointed at.

    Attributes
    ----------
    x, y : float
        Where it is [m].
    body, point : str, str
        The body that has it, empty for the ground, and its name there, empty for coordinates.
    at : tuple of float
        The point in the frame of the body [m].
    joint : str
        The joint that holds it, if any.
    """

    x: float
    y: float
    body: str = ""
    point: str = ""
    at: tuple[float, float] = (0.0, 0.0)
    joint: str = ""

    @property
    def owner(self) -> str:
        """The body, or the ground."""
        return self.body or GROUND

    @property
    def written(self) -> str:
        """The point as a file has it: its name, or its coordinates in the frame of its body."""
        if self.body and self.point:
            return f'"{self.point}"'
        return _vector_text(self.at if self.body else (self.x, self.y))


def snippet_changes(
    kind: str,
    spots: Sequence[Spot],
    raw: Mapping[str, Any],
    parts: Outline,
    text: str,
    angles: Mapping[str, float] | None = None,
) -> tuple[tuple[Change, ...], str]:
    """Return the changes that add something to a file, one for each section, and the path of what they add.

    Parameters
    ----------
    kind : {"body", "pin", "weld", "slide", "spring", "motor", "load", "point"}
        What is added.
    spots : sequence of Spot
        The points that it is at: two or three of a body; two of a pin, a weld and a spring; a point and where it
        slides to, along x of the ground by default, of a slide; a point of a body and where the new one is, of a point;
        one of others.
    raw, parts, text : mapping, Outline, str
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
    file = _File(raw, parts, text, angles or {})
    if kind == "point":
        return _point_change(file, *spots)
    makers: dict[str, Callable[[_File, Sequence[Spot]], list[_Block]]] = {
        "body": _body_snippet,
        "pin": _pin_snippet,
        "weld": _weld_snippet,
        "slide": _slide_snippet,
        "spring": _spring_snippet,
        "motor": _motor_snippet,
        "load": _load_snippet,
    }
    blocks = makers[kind](file, spots)
    return _insert_tables(blocks, parts, text), blocks[0].path


class _Block(NamedTuple):
    """A table."""

    path: str
    lines: tuple[str, ...]


class _File:
    """A file that something is added to: what it has, names that are free in it, and how its bodies stand."""

    def __init__(self, raw: Mapping[str, Any], parts: Outline, text: str, angles: Mapping[str, float]) -> None:
        self.raw, self.parts, self.text, self._angles = raw, parts, text, angles
        self._used = {str(name) for value in raw.values() if isinstance(value, Mapping) for name in value}

    def take_free_name(self, stem: str) -> str:
        """Return the stem with the first number that makes it a free name, which is taken then."""
        number = next(n for n in range(1, len(self._used) + 2) if f"{stem}{n}" not in self._used)
        self._used.add(f"{stem}{number}")
        return f"{stem}{number}"

    def angle_of_body(self, name: str) -> float:
        """Return how far a body is turned at the start [rad]; what closing leaves of 0 is 0."""
        angle = self._angles.get(name, 0.0)
        return angle if abs(angle) > FINEST else 0.0

    def angle_between(self, first: str, second: str) -> float:
        """Return how far a body is turned against another one [rad]."""
        angle = self.angle_of_body(second) - self.angle_of_body(first)
        return angle if abs(angle) > FINEST else 0.0

    def turn_into_body(self, name: str, x: float, y: float) -> tuple[float, float]:
        """Return a vector of the ground in the frame of a body."""
        angle = self.angle_of_body(name)
        c, s = math.cos(angle), math.sin(angle)
        return c * x + s * y, c * y - s * x

    def ends_at_pin(self, joint: str) -> dict[str, str]:
        """Return the bodies that pins hold together in one place, each with its point as the file has it."""
        ends = [(name, e) for name in self.raw.get("joints", {}) if (e := self._ends_of_pin(name))]
        found = dict[str, str]()
        while grown := {
            body: point
            for name, own in ends
            if name == joint or any(found.get(body) == point for body, point in own.items())
            for body, point in own.items()
            if body not in found
        }:
            found |= grown
        return found

    def _ends_of_pin(self, name: str) -> dict[str, str]:
        entry = self.raw["joints"][name]
        between, at = entry.get("between"), entry.get("at")
        if entry.get("type") != "revolute" or not isinstance(between, list) or not isinstance(at, list):
            return {}
        spans = (self.parts.values.get(("joints", name, "at", i)) for i in range(len(at)))
        return {body: self.text[slice(*span)] for body, span in zip(between, spans, strict=False) if span is not None}

    def count_joints(self, body: str) -> int:
        """Return how many joints hold a body."""
        return sum(body in (entry.get("between") or ()) for entry in self.raw.get("joints", {}).values())


def _body_snippet(file: _File, spots: Sequence[Spot]) -> list[_Block]:
    """Return a body through points; where they are points of others, a pin holds them there.

    Its frame is at the first point, with the axes of the ground: its numbers are those of the hand, and joints that are
    drawn closed are closed.
    """
    corners = [(spot.x, spot.y) for spot in spots]
    sides = [math.dist(a, b) for a, b in zip(corners, [*corners[1:], corners[0]], strict=True)]
    if min(sides) <= 0.0:
        raise InputError("body", "points in different places", "two in one place")
    own = [(a - corners[0][0], b - corners[0][1]) for a, b in corners]
    centre = [math.fsum(c) / len(own) for c in zip(*own, strict=True)]
    # a uniform rod, a uniform triangular plate
    inertia = sides[0] ** 2 / 12.0 if len(corners) == 2 else math.fsum(s * s for s in sides) / 36.0
    points = ", ".join(f"{letter} = {_vector_text(p)}" for letter, p in zip(_LETTERS, own, strict=False))
    name = file.take_free_name("bar" if len(corners) == 2 else "plate")
    lines = (
        "mass = 1.0",
        f"inertia = {short_number(inertia)}",
        f"centre_of_mass = [{', '.join(short_number(c) for c in centre)}]",
        f"points = {{ {points} }}",
        f"position = {_vector_text(corners[0])}",
    )
    blocks = [_Block(f"bodies.{name}", lines)]
    for letter, spot in zip(_LETTERS, spots, strict=False):
        if spot.body:
            blocks.append(_pin_table(file, spot, Spot(spot.x, spot.y, name, letter)))
    return blocks


def _pin_snippet(file: _File, spots: Sequence[Spot]) -> list[_Block]:
    return [_pin_table(file, *_ordered_pair("pin", spots))]


def _weld_snippet(file: _File, spots: Sequence[Spot]) -> list[_Block]:
    """Return a weld of two points in one place; the bodies keep their angles."""
    a, b = _ordered_pair("weld", spots)
    lines = ['type = "rigid"', *_between_lines(a, b)]
    if angle := file.angle_between(a.owner, b.owner):
        lines.append(f"angle = {exact_number(angle)}")
    return [_Block(f"joints.{file.take_free_name('weld')}", tuple(lines))]


def _ordered_pair(kind: str, spots: Sequence[Spot]) -> tuple[Spot, Spot]:
    """Return two points, the one of the ground first."""
    a, b = spots if not spots[0].body or spots[1].body else (spots[1], spots[0])
    if a.owner == b.owner:
        raise InputError(kind, "points of two bodies, or of a body and the ground", f"'{a.owner}' twice")
    return a, b


def _between_lines(a: Spot, b: Spot) -> list[str]:
    return [f'between = ["{a.owner}", "{b.owner}"]', f"at = [{a.written}, {b.written}]"]


def _pin_table(file: _File, a: Spot, b: Spot) -> _Block:
    return _Block(f"joints.{file.take_free_name('pin')}", ('type = "revolute"', *_between_lines(a, b)))


def _slide_snippet(file: _File, spots: Sequence[Spot]) -> list[_Block]:
    """Return a slide of a point of a body, along the ground or along another body; the body keeps its angle."""
    spot, toward = spots[0], spots[1] if len(spots) > 1 else Spot(spots[0].x + 1.0, spots[0].y)
    _need_body("slide", spot)
    way = (toward.x - spot.x, toward.y - spot.y)
    size = max(map(abs, way))
    if size <= 0.0:
        raise InputError("slide", "a direction", "one point twice")
    first, start = toward.owner, toward.written if toward.body else _vector_text((spot.x, spot.y))
    body, point = _sliding_end(file, spot, first)
    if 0.0 in way:
        way = (way[0] / size, way[1] / size)
    lines = ['type = "translational"', f'between = ["{first}", "{body}"]', f"at = [{start}, {point}]"]
    lines.append(f"axis = {_vector_text(file.turn_into_body(first, *way))}")
    if angle := file.angle_between(first, body):
        lines.append(f"angle = {exact_number(angle)}")
    return [_Block(f"joints.{file.take_free_name('slide')}", tuple(lines))]


def _sliding_end(file: _File, spot: Spot, first: str) -> tuple[str, str]:
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


def _spring_snippet(file: _File, spots: Sequence[Spot]) -> list[_Block]:
    a, b = spots
    if a.owner == b.owner:
        raise InputError("spring", "points of two bodies, or of a body and the ground", f"'{a.owner}' twice")
    length = math.dist((a.x, a.y), (b.x, b.y))
    lines = ['type = "spring-damper"', *_between_lines(a, b)]
    lines += [f"stiffness = {STIFFNESS}", f"damping = {DAMPING}", f"free_length = {short_number(length)}"]
    return [_Block(f"forces.{file.take_free_name('spring')}", tuple(lines))]


def _motor_snippet(file: _File, spots: Sequence[Spot]) -> list[_Block]:
    """Return a driver that turns a pin on from where it is at the start."""
    (spot,) = spots
    joint = file.raw.get("joints", {}).get(spot.joint, {})
    if joint.get("type") != "revolute":
        raise InputError("motor", "a pin, which it turns", "another point" if not spot.joint else f"'{spot.joint}'")
    angle = file.angle_between(*joint["between"])
    value = f'value = "{exact_number(angle)} + {SPEED}*t"' if angle else f'value = "{SPEED}*t"'
    return [_Block(f"joints.{file.take_free_name('motor')}", ('type = "driver"', f'joint = "{spot.joint}"', value))]


def _load_snippet(file: _File, spots: Sequence[Spot]) -> list[_Block]:
    (spot,) = spots
    _need_body("load", spot)
    lines = ('type = "force"', f'body = "{spot.body}"', f"at = {spot.written}", f"force = [0.0, {-LOAD}]")
    return [_Block(f"forces.{file.take_free_name('load')}", lines)]


def _point_change(file: _File, spot: Spot, place: Spot) -> tuple[tuple[Change, ...], str]:
    """Return the change that gives a body another point: a further hole of a bar, a point that draws a path."""
    _need_body("point", spot)
    own = file.raw["bodies"][spot.body].get("points", {})
    span = file.parts.values.get(("bodies", spot.body, "points"))
    if span is None or not file.text[slice(*span)].endswith("}"):
        raise InputError("point", "a body with points = { ... }", f"'{spot.body}' without", "write it into the text")
    dx, dy = file.turn_into_body(spot.body, place.x - spot.x, place.y - spot.y)
    name = next((c for c in ascii_uppercase if c not in own), f"P{len(own)}")
    inner = file.text[span[0] + 1 : span[1] - 1].rstrip()
    entry = f"{name} = {_vector_text((spot.at[0] + dx, spot.at[1] + dy))}"
    at = span[0] + 1 + len(inner)
    return (Change(at, at, f", {entry}" if inner else f" {entry} "),), f"bodies.{spot.body}.points.{name}"


def _need_body(kind: str, spot: Spot) -> None:
    if not spot.body:
        raise InputError(kind, "a point of a body", "a point of the ground")


def _insert_tables(blocks: Sequence[_Block], parts: Outline, text: str) -> tuple[Change, ...]:
    """Return the changes that put tables after the last ones of their sections, else at the end of the file."""
    ends = {
        str(header.path[0]): end for header, (_, end) in zip(parts.headers, blocks_of_headers(parts, text), strict=True)
    }
    places: dict[int, list[_Block]] = {}
    for block in blocks:
        places.setdefault(ends.get(block.path.partition(".")[0], len(text.rstrip())), []).append(block)
    changes = []
    for at, own in places.items():
        body = "\n\n".join("\n".join((f"[{block.path}]", *block.lines)) for block in own)
        before = "" if at == 0 else "\n" if text[:at].endswith("\n") else "\n\n"
        after = "\n" if at == len(text) or text[at] != "\n" else ""
        changes.append(Change(at, at, f"{before}{body}{after}"))
    return tuple(changes)


def blocks_of_headers(parts: Outline, text: str) -> list[tuple[int, int]]:
    """Return the characters of the tables that headers begin, without what belongs to the next header or to none.

    Comments right above a header belong to it, and so do comments right below a table's last line to the table; blank
    lines after a table belong to none.

    Parameters
    ----------
    parts : Outline
        The parts of the file.
    text : str
        Its text.
    """
    starts = [header.start for header in parts.headers] + [len(text)]
    result = []
    for header, end in zip(parts.headers, starts[1:], strict=True):
        lines = text[header.start : end].split("\n")
        if end < len(text):  # what follows the last line of the table
            lines.pop()
        tail = len(lines)
        while tail > 1 and (not lines[tail - 1].strip() or lines[tail - 1].lstrip().startswith("#")):
            tail -= 1
        while tail < len(lines) and lines[tail].lstrip().startswith("#") and "" in map(str.strip, lines[tail:]):
            tail += 1
        result.append((header.start, header.start + len("\n".join(lines[:tail]))))
    return result


def short_number(value: float) -> str:
    """Return a number of at most six digits for a file."""
    short = float(f"{value:.6g}")
    return repr(0.0 if abs(short) < 1e-12 else short)


def exact_number(value: float) -> str:
    """Return the shortest decimal that is a number but for the rounding of sums of metres, or of radians."""
    within = ROUNDING * max(1.0, abs(value))
    decimals = (float(f"{value:.{digits}g}") for digits in range(1, 17))
    return repr(0.0 if abs(value) <= within else next((x for x in decimals if abs(x - value) <= within), value))


def _vector_text(values: Sequence[float]) -> str:
    return f"[{', '.join(map(exact_number, values))}]"
