"""Tables of new bodies, joints and forces, as text at its place in a mechanism file."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

from symgen.base.errors import InputError, quote, suggest
from symgen.base.vocabulary.measures import GROUND
from symgen.describe.files.places import Outline
from symgen.describe.files.text_changes import Change

#: Names of the points of a new body.
_LETTERS = "ABC"
#: Speed of a new motor [rad/s], stiffness [N/m] and damping [N s/m] of a new spring, a new load [N].
SPEED, STIFFNESS, DAMPING, LOAD = 2.0, 1000.0, 10.0, 10.0
#: Angles [rad], and shares of a vector, that closed loops leave where the hand meant 0.
FINEST = 1e-6


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
    kind: str, spots: Sequence[Spot], raw: Mapping[str, Any], parts: Outline, text: str, angle: float = 0.0
) -> tuple[tuple[Change, ...], str]:
    """Return the changes that add something to a file, one for each section, and the path of what they add.

    Parameters
    ----------
    kind : {"body", "pin", "slide", "spring", "motor", "load"}
        What is added.
    spots : sequence of Spot
        The points that it is at: two or three of a body, two of a pin and a spring, one of others.
    raw, parts, text : mapping, Outline, str
        The file: its tables, their places, its text.
    angle : float
        Angle of the body of a slide, or of the joint of a motor, at the start [rad].

    Raises
    ------
    InputError
        If it cannot be added there.
    """
    makers = {
        "body": _body_snippet,
        "pin": _pin_snippet,
        "slide": _slide_snippet,
        "spring": _spring_snippet,
        "motor": _motor_snippet,
        "load": _load_snippet,
    }
    if kind not in makers:
        raise InputError("kind", "a part that can be added", quote(kind), suggest(kind, makers))
    least, most = {"body": (2, 3), "pin": (2, 2), "spring": (2, 2)}.get(kind, (1, 1))
    if not least <= len(spots) <= most:
        count = f"{least} points" if least == most else f"{least} to {most} points"
        raise InputError(kind, count if most > 1 else "one point", str(len(spots)))
    if raw.get("mechanism", {}).get("space", "planar") != "planar":
        raise InputError(kind, "a mechanism in the plane", "one in space", "write its table into the text")
    blocks = makers[kind](_Names(raw), spots, angle if abs(angle) > FINEST else 0.0)
    return _insert_tables(blocks, parts, text), blocks[0].path


class _Block(NamedTuple):
    """A table."""

    path: str
    lines: tuple[str, ...]


class _Names:
    """Names that are free in a file, and the tables that it has."""

    def __init__(self, raw: Mapping[str, Any]) -> None:
        self.raw = raw
        self.used = {str(name) for value in raw.values() if isinstance(value, Mapping) for name in value}

    def take_free_name(self, stem: str) -> str:
        """Return the stem with the first number that makes it a free name, which is taken then."""
        number = next(n for n in range(1, len(self.used) + 2) if f"{stem}{n}" not in self.used)
        self.used.add(f"{stem}{number}")
        return f"{stem}{number}"


def _body_snippet(names: _Names, spots: Sequence[Spot], _: float) -> list[_Block]:
    """Return a body through points; where they are points of others, a pin holds them there."""
    corners = [(spot.x, spot.y) for spot in spots]
    sides = [math.dist(a, b) for a, b in zip(corners, [*corners[1:], corners[0]], strict=True)]
    if min(sides) <= 0.0:
        raise InputError("body", "points in different places", "two in one place")
    x, y = (math.fsum(c) / len(corners) for c in zip(*corners, strict=True))
    turn = math.atan2(corners[1][1] - corners[0][1], corners[1][0] - corners[0][0]) if len(corners) == 2 else 0.0
    # a uniform rod, a uniform triangular plate
    inertia = sides[0] ** 2 / 12.0 if len(corners) == 2 else math.fsum(s * s for s in sides) / 36.0
    c, s = math.cos(turn), math.sin(turn)
    own = [(c * (a - x) + s * (b - y), c * (b - y) - s * (a - x)) for a, b in corners]
    points = ", ".join(f"{letter} = {_vector_text(p)}" for letter, p in zip(_LETTERS, own, strict=False))
    name = names.take_free_name("bar" if len(corners) == 2 else "plate")
    lines = (
        f"mass = 1.0\ninertia = {short_number(inertia)}\npoints = {{ {points} }}\nposition = {_vector_text((x, y))}",
    )
    blocks = [_Block(f"bodies.{name}", (*lines, f"angle = {short_number(turn)}") if turn else lines)]
    for letter, spot in zip(_LETTERS, spots, strict=False):
        if spot.body:
            blocks.append(_pin_table(names, spot, Spot(spot.x, spot.y, name, letter)))
    return blocks


def _pin_snippet(names: _Names, spots: Sequence[Spot], _: float) -> list[_Block]:
    a, b = spots if not spots[0].body or spots[1].body else (spots[1], spots[0])
    if a.owner == b.owner:
        raise InputError("pin", "points of two bodies, or of a body and the ground", f"'{a.owner}' twice")
    return [_pin_table(names, a, b)]


def _pin_table(names: _Names, a: Spot, b: Spot) -> _Block:
    lines = ('type = "revolute"', f'between = ["{a.owner}", "{b.owner}"]', f"at = [{a.written}, {b.written}]")
    return _Block(f"joints.{names.take_free_name('pin')}", lines)


def _slide_snippet(names: _Names, spots: Sequence[Spot], angle: float) -> list[_Block]:
    """Return a slide of a point of a body along x of the ground; the body keeps its angle."""
    (spot,) = spots
    _need_body("slide", spot)
    lines = ['type = "translational"', f'between = ["{GROUND}", "{spot.body}"]']
    lines += [f"at = [{_vector_text((spot.x, spot.y))}, {spot.written}]", "axis = [1.0, 0.0]"]
    return [
        _Block(
            f"joints.{names.take_free_name('slide')}",
            (*lines, f"angle = {short_number(angle)}") if angle else (*lines,),
        )
    ]


def _spring_snippet(names: _Names, spots: Sequence[Spot], _: float) -> list[_Block]:
    a, b = spots
    if a.owner == b.owner:
        raise InputError("spring", "points of two bodies, or of a body and the ground", f"'{a.owner}' twice")
    length = math.dist((a.x, a.y), (b.x, b.y))
    lines = ['type = "spring-damper"', f'between = ["{a.owner}", "{b.owner}"]', f"at = [{a.written}, {b.written}]"]
    lines += [f"stiffness = {STIFFNESS}", f"damping = {DAMPING}", f"free_length = {short_number(length)}"]
    return [_Block(f"forces.{names.take_free_name('spring')}", tuple(lines))]


def _motor_snippet(names: _Names, spots: Sequence[Spot], angle: float) -> list[_Block]:
    """Return a driver that turns a pin on from where it is at the start."""
    (spot,) = spots
    if not spot.joint or names.raw.get("joints", {}).get(spot.joint, {}).get("type") != "revolute":
        raise InputError("motor", "a pin, which it turns", "another point" if not spot.joint else f"'{spot.joint}'")
    value = f'value = "{short_number(angle)} + {SPEED}*t"' if angle else f'value = "{SPEED}*t"'
    return [_Block(f"joints.{names.take_free_name('motor')}", ('type = "driver"', f'joint = "{spot.joint}"', value))]


def _load_snippet(names: _Names, spots: Sequence[Spot], _: float) -> list[_Block]:
    (spot,) = spots
    _need_body("load", spot)
    lines = ('type = "force"', f'body = "{spot.body}"', f"at = {spot.written}", f"force = [0.0, {-LOAD}]")
    return [_Block(f"forces.{names.take_free_name('load')}", lines)]


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


def _vector_text(values: Sequence[float]) -> str:
    """Return a vector for a file; what is rounding beside its largest component is 0."""
    size = max(map(abs, values))
    return f"[{', '.join(short_number(x if abs(x) > FINEST * size else 0.0) for x in values)}]"
