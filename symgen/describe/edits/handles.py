"""Points of a planar mechanism that a hand can move, each with the numbers of the file that follow it."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator, Mapping, Sequence
from typing import Any, NamedTuple

from symgen.base.errors import InputError
from symgen.base.units import Unit, read_amount, read_unit
from symgen.base.vocabulary.expressions import Expr, names_in_expression
from symgen.base.vocabulary.measures import GROUND
from symgen.describe.edits.text_changes import is_decimal_number
from symgen.describe.files.places import Path
from symgen.describe.formulas.evaluate import evaluate_formula
from symgen.describe.mechanism import Mechanism
from symgen.describe.parts.context import Context
from symgen.describe.parts.scope import CENTRE, Scope

#: Joints whose two points are one point.
PINS = ("revolute", "rigid")
#: The number at the beginning of a text with a unit, after its quote.
_IN_TEXT = re.compile(r"[\"']+\s*([-+]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][-+]?[0-9]+)?)")
_STEP = 1e-6

Spans = Mapping[Path, tuple[int, int]]


class Follower(NamedTuple):
    """A number of the text that changes while a point is moved.

    Attributes
    ----------
    start, end : int
        Its characters, counted from 0.
    value : float
        The number.
    right, up : float
        By how much it grows with each metre that the point goes to the right, and upwards.
    """

    start: int
    end: int
    value: float
    right: float
    up: float


class Handle(NamedTuple):
    """A point that can be moved.

    Attributes
    ----------
    kind : {"pivot", "pin", "point", "end"}
        A pin at the ground, a pin, another point of a body, the end of a force or joint that has no name.
    name : str
        Path of the joint, point or end in the file.
    x, y : float
        Where it is [m].
    body, point : str, str
        A body that has it, and its name there; empty for a point without a name.
    at : tuple of float
        The point in the frame of that body [m].
    followers : tuple of Follower
        Numbers that follow it; none where all are formulas of several parameters.
    """

    kind: str
    name: str
    x: float
    y: float
    body: str
    point: str
    at: tuple[float, float]
    followers: tuple[Follower, ...]


class WrittenPoint(NamedTuple):
    """A point of one body that the file writes down: its body, its path, its name if any, and its coordinates there."""

    body: str
    path: Path
    point: str
    raw: Sequence[Any]


def movable_points(
    mechanism: Mechanism, raw: Mapping[str, Any], spans: Spans, text: str, q: Sequence[float]
) -> tuple[Handle, ...]:
    """Return the points of a planar mechanism that can be moved; none in space.

    Parameters
    ----------
    mechanism : Mechanism
        The validated description.
    raw : mapping
        The tables of the file.
    spans : mapping
        Characters of each value, from `symgen.describe.files.places.outline_of_document`.
    text : str
        The text of the file.
    q : sequence of float
        Coordinates of all bodies at the start [m, rad].
    """
    return () if mechanism.space != "planar" else tuple(PointsOfFile(mechanism, raw, spans, text, q).all_handles())


def spans_of_parameters(raw: Mapping[str, Any], spans: Spans, text: str) -> dict[str, tuple[int, int]]:
    """Return the characters of the number of each parameter and input that is written as a number."""
    found = dict[str, tuple[int, int]]()
    for section in ("parameters", "inputs"):
        for name, entry in raw.get(section, {}).items():
            path: Path = (section, name)
            if isinstance(entry, Mapping):
                path = (*path, "value" if "value" in entry else "default")
            if path in spans and (span := span_of_number(text, spans[path])) is not None:
                found[name] = span
    return found


def span_of_number(text: str, span: tuple[int, int]) -> tuple[int, int] | None:
    """Return the characters of the number that a value begins with; None for a formula."""
    written = text[span[0] : span[1]]
    if is_decimal_number(written):
        return span
    match = _IN_TEXT.match(written)
    if match is None or read_amount(written.strip("\"'")) is None:
        return None
    return span[0] + match.start(1), span[0] + match.end(1)


class PointsOfFile:
    """The points of one mechanism, with values of its parameters, which are the values of the file unless given."""

    def __init__(
        self,
        mechanism: Mechanism,
        raw: Mapping[str, Any],
        spans: Spans,
        text: str,
        q: Sequence[float],
        values: Mapping[str, float] | None = None,
    ) -> None:
        self.mechanism, self.raw, self.spans, self.text = mechanism, raw, spans, text
        self.context = Context.of_mechanism(mechanism)
        self.values = dict(values or {p.name: p.value for p in mechanism.parameters})
        self.units = {p.name: float(p.own_unit.factor) for p in mechanism.parameters}
        self.of_parameters = spans_of_parameters(raw, spans, text)
        self.centres = {body.name: body.centre_of_mass for body in mechanism.bodies}
        self.poses: dict[str, tuple[float, float, float]] = {GROUND: (0.0, 0.0, 0.0)}
        at = 0
        for body in (body for body in mechanism.bodies if body.carried is None):
            own = [*q[at : at + len(body.coordinates)], 0.0]
            self.poses[body.name] = (own[0], own[1], own[2])
            at += len(body.coordinates)

    def all_handles(self) -> Iterator[Handle]:
        """Yield the handles of pins, then of further points."""
        taken = set[Path]()
        for joint, spots in self.pins_with_points():
            # a pin of centres of mass has no point that a number places
            if spots and (handle := self.make_handle(f"joints.{joint}", "pin", spots)):
                yield handle
            taken |= {spot.path for spot in spots}
        for spot in self.points_of_entries():
            if spot.path not in taken and (handle := self.make_handle(_path_in_words(spot.path), "end", [spot])):
                yield handle
            taken.add(spot.path)

    def pins_with_points(self) -> Iterator[tuple[str, list[WrittenPoint]]]:
        """Yield the pins: the first joint of each, and all points that it and further joints hold together."""
        groups: list[tuple[str, dict[Path, WrittenPoint]]] = []
        for name, entry in self.raw.get("joints", {}).items():
            joint = next((j for j in self.mechanism.joints if j.name == name), None)
            if joint is None or joint.kind not in PINS:
                continue
            own = {spot.path: spot for spot in self.ends_of_entry("joints", name, entry)}
            for group in [g for g in groups if not own.keys().isdisjoint(g[1])]:
                groups.remove(group)
                name, own = group[0], {**group[1], **own}
            groups.append((name, own))
        for name, spots in groups:
            yield name, [*spots.values()]

    def points_of_entries(self) -> Iterator[WrittenPoint]:
        """Yield the points of bodies, and points of joints and forces that have no name."""
        for name, entry in self.raw.get("bodies", {}).items():
            for point, vector in (entry.get("points") or {}).items():
                yield WrittenPoint(name, ("bodies", name, "points", point), point, vector)
        for section in ("joints", "forces"):
            for name, entry in self.raw.get(section, {}).items():
                yield from (spot for spot in self.ends_of_entry(section, name, entry) if not spot.point)

    def ends_of_entry(self, section: str, name: str, entry: Mapping[str, Any]) -> Iterator[WrittenPoint]:
        """Yield the points of an entry that are a point of a body by name or by coordinates."""
        between, at = entry.get("between"), entry.get("at")
        pairs: list[tuple[Any, Any, Path]] = []
        if isinstance(between, list) and isinstance(at, list):
            pairs = [(b, a, (section, name, "at", i)) for i, (b, a) in enumerate(zip(between, at, strict=False))]
        elif isinstance(entry.get("body"), str) and isinstance(at, list):
            pairs = [(entry["body"], at, (section, name, "at"))]
        for body, point, path in pairs:
            if isinstance(point, list):
                yield WrittenPoint(body, path, "", point)
            elif point != CENTRE and point in self.raw.get("bodies", {}).get(body, {}).get("points", {}):
                yield WrittenPoint(
                    body, ("bodies", body, "points", point), point, self.raw["bodies"][body]["points"][point]
                )

    def make_handle(self, name: str, kind: str, spots: Sequence[WrittenPoint]) -> Handle | None:
        """Return the handle of points that lie in one place; None where they have no value."""
        try:
            vectors = [self.vector_of_spot(spot) for spot in spots]
        except InputError:
            return None
        grounded = any(spot.body == GROUND for spot in spots)
        if kind == "pin" and grounded:
            kind = "pivot"
        elif kind == "end" and spots[0].point:
            kind = "point"
        first = max(range(len(spots)), key=lambda i: spots[i].body != GROUND)
        local = tuple(evaluate_formula(e, self.values) for e in vectors[first])
        x, y = self.place_in_ground(spots[first].body, local)
        followers = self.numbers_that_follow(spots, vectors)
        if kind == "pivot":  # bodies keep their sizes, and the loop closes around the pivot's new place
            on_ground = [(s, v) for s, v in zip(spots, vectors, strict=True) if s.body == GROUND]
            followers = self.numbers_that_follow(*zip(*on_ground, strict=True)) or followers
        return Handle(kind, name, x, y, spots[first].body, spots[first].point, (local[0], local[1]), followers)

    def vector_of_spot(self, spot: WrittenPoint) -> tuple[Expr, ...]:
        """Return the coordinates of a point in the frame of its body."""
        return self.scope_of_spot(spot).vector(
            "at" if spot.path[0] != "bodies" else f"points.{spot.point}", tuple(spot.raw)
        )

    def scope_of_spot(self, spot: WrittenPoint) -> Scope:
        """Return the scope of the table that has a point."""
        section, name = str(spot.path[0]), str(spot.path[1])
        return Scope(self.context, f"{section}.{name}", name)

    def place_in_ground(self, body: str, local: Sequence[float]) -> tuple[float, float]:
        """Return a point of a body in the ground frame."""
        x, y, angle = self.poses[body]
        centre = [evaluate_formula(e, self.values) for e in self.centres[body]] if body != GROUND else [0.0, 0.0]
        c, s = math.cos(angle), math.sin(angle)
        dx, dy = local[0] - centre[0], local[1] - centre[1]
        return x + c * dx - s * dy, y + s * dx + c * dy

    def numbers_that_follow(
        self, spots: Sequence[WrittenPoint], vectors: Sequence[Sequence[Expr]]
    ) -> tuple[Follower, ...]:
        """Return the numbers that follow a point: of several coordinates one moves as fits all of them best."""
        slopes: dict[tuple[int, int], list[tuple[float, float, float]]] = {}
        for spot, vector in zip(spots, vectors, strict=True):
            angle = self.poses[spot.body][2]
            for k, expression in enumerate(vector):
                found = self.deciding_number(spot, k, expression)
                if found is not None and found[1] != 0.0:
                    way = (math.cos(angle), math.sin(angle)) if k == 0 else (-math.sin(angle), math.cos(angle))
                    slopes.setdefault(found[0], []).append((found[1], *way))
        result = []
        for (start, end), parts in sorted(slopes.items()):
            size = sum(slope * slope for slope, _, _ in parts)
            right, up = (sum(part[0] * part[i] for part in parts) / size for i in (1, 2))
            result.append(Follower(start, end, float(self.text[start:end].replace("_", "")), right, up))
        centres = [follower for spot in spots for follower in self.centre_that_follows(spot)]
        return (*result, *centres) if result else ()

    def centre_that_follows(self, spot: WrittenPoint) -> Iterator[Follower]:
        """Yield the numbers of a centre of mass that follows a point; see `points_about_centre`."""
        count = self.points_about_centre(spot)
        if not count:
            return
        angle = self.poses[spot.body][2]
        centre = self.raw["bodies"][spot.body]["centre_of_mass"]
        for k, way in enumerate(((math.cos(angle), math.sin(angle)), (-math.sin(angle), math.cos(angle)))):
            span = self.spans.get((*spot.path[:2], "centre_of_mass", k))
            if span is not None:
                yield Follower(*span, float(centre[k]), way[0] / count, way[1] / count)

    def points_about_centre(self, spot: WrittenPoint) -> int:
        """Return how many points, of which one is moved, have the centre of mass in their middle; 0 where none have.

        These are all points of its body, or the first two or three, as of a bar or a plate that has further holes.
        """
        body = self.raw.get("bodies", {}).get(spot.body, {})
        centre, points = body.get("centre_of_mass"), body.get("points")
        if not spot.point or not _are_numbers(centre) or not isinstance(points, Mapping):
            return 0
        for count in (len(points), 2, 3):
            of = dict([*points.items()][:count])
            if spot.point not in of or not all(map(_are_numbers, of.values())):
                continue
            middle = [math.fsum(column) / len(of) for column in zip(*of.values(), strict=True)]
            size = max(abs(x) for point in of.values() for x in point)
            if max(abs(a - b) for a, b in zip(middle, centre, strict=True)) < 1e-5 * size:
                return len(of)
        return 0

    def deciding_number(self, spot: WrittenPoint, k: int, expression: Expr) -> tuple[tuple[int, int], float] | None:
        """Return the characters of the number that decides a coordinate, and metres for a unit of the number."""
        names = sorted(set(names_in_expression(expression)))
        if not names:
            span = self.spans.get((*spot.path, k))
            digits = None if span is None else span_of_number(self.text, span)
            return None if digits is None else (digits, self.metres_of_unit(spot.raw[k]))
        if len(names) > 1 or names[0] not in self.of_parameters:
            return None
        name = names[0]
        step = _STEP * max(1.0, abs(self.values[name]))
        try:
            sides = [evaluate_formula(expression, {**self.values, name: self.values[name] + d}) for d in (step, -step)]
        except InputError:
            return None
        return self.of_parameters[name], (sides[0] - sides[1]) / (2.0 * step) * self.units[name]

    def metres_of_unit(self, value: object) -> float:
        """Return the metres in a unit of a number as written."""
        amount = read_amount(value) if isinstance(value, str) else None
        unit = read_unit(amount.unit) if amount is not None else None
        return float(unit.factor) if isinstance(unit, Unit) else 1.0


def _are_numbers(value: object) -> bool:
    return isinstance(value, list) and len(value) == 2 and all(type(x) in (int, float) for x in value)


def _path_in_words(path: Path) -> str:
    return ".".join(map(str, path))
