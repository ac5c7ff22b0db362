"""A mechanism file that a hand adds to: points that were pointed at, tables at their places, numbers as text."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

from symgen.base.errors import InputError
from symgen.base.vocabulary.measures import GROUND
from symgen.describe.edits.text_changes import Change
from symgen.describe.files.places import DocumentOutline

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
        return vector_text(self.at if self.body else (self.x, self.y))


class EditedFile:
    """A file that something is added to: what it has, names that are free in it, and how its bodies stand."""

    def __init__(self, raw: Mapping[str, Any], parts: DocumentOutline, text: str, angles: Mapping[str, float]) -> None:
        self.raw, self.parts, self.text, self._angles = raw, parts, text, angles
        self._used = {str(name) for value in raw.values() if isinstance(value, Mapping) for name in value}

    def take_free_name(self, stem: str) -> str:
        """Return the stem with the first number that makes it a free name, which is taken then."""
        number = next(n for n in range(1, len(self._used) + 2) if f"{stem}{n}" not in self._used)
        self._used.add(f"{stem}{number}")
        return f"{stem}{number}"

    def take_name(self, name: str) -> str:
        """Return a name, followed by a number if it is in use, and note that it is taken."""
        if name in self._used:
            return self.take_free_name(name)
        self._used.add(name)
        return name

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

    def joint_at(self, spot: Spot) -> str:
        """Return the pin at a spot, else the slide of its point; empty where there is none."""
        slides = (
            name
            for name, entry in self.raw.get("joints", {}).items()
            if entry.get("type") in ("translational", "prismatic")
            and (spot.body, spot.point) in zip(entry.get("between") or (), entry.get("at") or (), strict=False)
        )
        return spot.joint or next(slides, "")

    def count_joints(self, body: str) -> int:
        """Return how many joints hold a body."""
        return sum(body in (entry.get("between") or ()) for entry in self.raw.get("joints", {}).values())


def need_body(kind: str, spot: Spot) -> None:
    """Refuse a point of the ground where a body is needed."""
    if not spot.body:
        raise InputError(kind, "a point of a body", "a point of the ground")


def insert_tables(tables: Sequence[tuple[str, str]], parts: DocumentOutline, text: str) -> tuple[Change, ...]:
    """Return the changes that put tables after the last ones of their sections, else at the end of the file.

    Parameters
    ----------
    tables : sequence of (str, str)
        The path of each, and its text.
    parts, text : DocumentOutline, str
        Of the file.
    """
    ends = {
        str(header.path[0]): end for header, (_, end) in zip(parts.headers, blocks_of_headers(parts, text), strict=True)
    }
    places: dict[int, list[str]] = {}
    for path, table in tables:
        places.setdefault(ends.get(path.partition(".")[0], len(text.rstrip())), []).append(table)
    changes = []
    for at, own in places.items():
        body = "\n\n".join(own)
        before = "" if at == 0 else "\n" if text[:at].endswith("\n") else "\n\n"
        after = "\n" if at == len(text) or text[at] != "\n" else ""
        changes.append(Change(at, at, f"{before}{body}{after}"))
    return tuple(changes)


def blocks_of_headers(parts: DocumentOutline, text: str) -> list[tuple[int, int]]:
    """Return the characters of the tables that headers begin, without what belongs to the next header or to none.

    Comments right above a header belong to it, and so do comments right below a table's last line to the table; blank
    lines after a table belong to none.

    Parameters
    ----------
    parts : DocumentOutline
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


def vector_text(values: Sequence[float]) -> str:
    """Return a vector for a file."""
    return f"[{', '.join(map(exact_number, values))}]"


#: The path of a table, and its text.
Table = tuple[str, str]


def table_at(path: str, *lines: str) -> Table:
    """Return a table with its header."""
    return path, "\n".join((f"[{path}]", *lines))


def uniform_body(name: str, points: Mapping[str, tuple[float, float]], angle: float = 0.0) -> Table:
    """Return a body of 1 kg through points: a uniform rod or triangular plate, whose frame is at the first point.

    Parameters
    ----------
    name : str
        Of the body.
    points : mapping of str to tuple of float
        Two or three points in the frame of the ground [m].
    angle : float
        Of its frame [rad].
    """
    corners = [*points.values()]
    sides = [math.dist(a, b) for a, b in zip(corners, [*corners[1:], corners[0]], strict=True)]
    c, s, (x, y) = math.cos(angle), math.sin(angle), corners[0]
    own = [(c * (a - x) + s * (b - y), c * (b - y) - s * (a - x)) for a, b in corners]
    centre = [math.fsum(each) / len(own) for each in zip(*own, strict=True)]
    inertia = sides[0] ** 2 / 12.0 if len(corners) == 2 else math.fsum(side**2 for side in sides) / 36.0
    written = ", ".join(f"{letter} = {vector_text(p)}" for letter, p in zip(points, own, strict=True))
    lines = [
        "mass = 1.0",
        f"inertia = {short_number(inertia)}",
        f"centre_of_mass = [{', '.join(short_number(x) for x in centre)}]",
        f"points = {{ {written} }}",
        f"position = {vector_text(corners[0])}",
    ]
    if angle:
        lines.append(f"angle = {exact_number(angle)}")
    return table_at(f"bodies.{name}", *lines)


def ordered_pair(kind: str, spots: Sequence[Spot]) -> tuple[Spot, Spot]:
    """Return two points, the one of the ground first."""
    a, b = spots if not spots[0].body or spots[1].body else (spots[1], spots[0])
    if a.owner == b.owner:
        raise InputError(kind, "points of two bodies, or of a body and the ground", f"'{a.owner}' twice")
    return a, b


def between_lines(a: Spot, b: Spot) -> list[str]:
    """Return the bodies and the points of a joint or force, as a file has them."""
    return [f'between = ["{a.owner}", "{b.owner}"]', f"at = [{a.written}, {b.written}]"]


def pin_table(file: EditedFile, a: Spot, b: Spot) -> Table:
    """Return a pin of two points."""
    return table_at(f"joints.{file.take_free_name('pin')}", 'type = "revolute"', *between_lines(a, b))


def displacement_at(joint: Mapping[str, Any], spot: Spot) -> float | None:
    """Return how far the point at a spot has gone along a slide of the ground; None for other joints."""
    if joint.get("type") not in ("translational", "prismatic") or joint["between"][0] != GROUND:
        return None
    on, axis = joint["at"][0], joint.get("axis", ())
    if not all(isinstance(v, list) and all(type(x) in (int, float) for x in v) for v in (on, axis)):
        return None
    return float(((spot.x - on[0]) * axis[0] + (spot.y - on[1]) * axis[1]) / math.hypot(*axis))
