"""Lengths and angles of a planar mechanism in a picture, each with the numbers of the file that it changes."""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Any, NamedTuple

from symgen.base.errors import InputError, quote, suggest
from symgen.base.units import Unit, read_amount, read_unit
from symgen.base.vocabulary.expressions import Expr, names_in_expression
from symgen.base.vocabulary.measures import GROUND
from symgen.describe.edits.handles import PointsOfFile, Spans, WrittenPoint, span_of_number
from symgen.describe.edits.snippet_tables import exact_number
from symgen.describe.edits.text_changes import Change
from symgen.describe.formulas.evaluate import evaluate_formula, parameter_values
from symgen.describe.mechanism import Body, Mechanism

LENGTH, ANGLE = "length", "angle"
#: Sides of a body that are dimensions at most.
MOST_SIDES = 12
_STEP, _ROUNDS = 1e-6, 50
#: What a solved parameter may leave of a dimension, beside its size.
_NEAR = 1e-13

Vector = tuple[Expr, ...]


class Dimension(NamedTuple):
    """A length or an angle in a picture.

    Attributes
    ----------
    kind : str
        `LENGTH`, or `ANGLE` of the line between two points with x of the ground.
    name : str
        Such as ``bodies.rod.A-B``, ``bodies.rod.angle`` and, of two pins at the ground, ``ground.foot-top``.
    value : float
        At the start [m, rad].
    ends : tuple of float
        Where it is: x and y of both points [m].
    parts : tuple of str
        Paths of the body or the joints that it belongs to.
    fixed : bool
        Whether no number of the file decides it alone.
    """

    kind: str
    name: str
    value: float
    ends: tuple[float, float, float, float]
    parts: tuple[str, ...]
    fixed: bool


def dimensions_of_file(
    mechanism: Mechanism, raw: Mapping[str, Any], spans: Spans, text: str, q: Sequence[float], part: str = ""
) -> tuple[Dimension, ...]:
    """Return the dimensions of a planar mechanism; none in space.

    Parameters
    ----------
    mechanism, raw, spans, text, q
        As for `symgen.describe.edits.handles.movable_points`.
    part : str
        The body or the joint, such as ``bodies.rod``, that they belong to; all of the mechanism by default.
    """
    if mechanism.space != "planar":
        return ()
    points = PointsOfFile(mechanism, raw, spans, text, q)
    return tuple(each.dimension(points) for each in _all_lines(points) if not part or part in each.parts)


def dimension_changes(
    mechanism: Mechanism,
    raw: Mapping[str, Any],
    spans: Spans,
    text: str,
    q: Sequence[float],
    name: str,
    value: str,
) -> tuple[Change, ...]:
    """Return the changes of a text that give a dimension a value.

    Parameters
    ----------
    mechanism, raw, spans, text, q
        As for `dimensions_of_file`.
    name : str
        Of the dimension.
    value : str
        A length in metres, an angle in degrees, or either with its unit, such as ``25 mm``.

    Raises
    ------
    InputError
        If there is no such dimension, the value is none of its kind, or several numbers of the file decide it.
    """
    points = PointsOfFile(mechanism, raw, spans, text, q)
    lines = {each.name: each for each in _all_lines(points)}
    if name not in lines:
        raise InputError("dimension", "one of the picture", quote(name), suggest(name, lines))
    return lines[name].changes(points, read_dimension(lines[name].kind, value))


def read_dimension(kind: str, text: str) -> float:
    """Return a typed length [m] or angle [rad].

    Raises
    ------
    InputError
        If it is no number, or one with a unit of something else.
    """
    expected = "a length above 0, such as 0.25 or '25 mm'" if kind == LENGTH else "an angle, such as 30 or '0.5 rad'"
    amount = read_amount(text.strip())
    unit = read_unit(amount.unit or ("m" if kind == LENGTH else "deg")) if amount is not None else None
    if amount is None or not isinstance(unit, Unit) or unit.si != ("m" if kind == LENGTH else "rad"):
        raise InputError(kind, expected, quote(text))
    value = unit.to_si(amount.number)
    if not math.isfinite(value) or (kind == LENGTH and value <= 0.0):
        raise InputError(kind, expected, quote(text))
    return value


class _Line(NamedTuple):
    """The line between two points of a body or of the ground, whose length or angle is a dimension."""

    kind: str
    name: str
    parts: tuple[str, ...]
    first: WrittenPoint
    second: WrittenPoint

    def dimension(self, points: PointsOfFile) -> Dimension:
        """Return the dimension in the picture."""
        ends = self._ends(points)
        x, y = ends[2] - ends[0], ends[3] - ends[1]
        value = math.hypot(x, y) if self.kind == LENGTH else math.atan2(y, x)
        try:
            fixed = not self.changes(points, 1.1 * value if self.kind == LENGTH else value + 0.1)
        except InputError:
            fixed = True
        return Dimension(self.kind, self.name, value, ends, self.parts, fixed)

    def changes(self, points: PointsOfFile, value: float) -> tuple[Change, ...]:
        """Return the changes that give it a value [m, rad]."""
        if self.kind == LENGTH:
            return self._changes_of_length(points, value)
        x0, y0, x1, y1 = self._ends(points)
        turn = math.remainder(value - math.atan2(y1 - y0, x1 - x0), 2.0 * math.pi)
        if abs(turn) < _NEAR:
            return ()
        if "angle" in points.raw["bodies"][self.first.body]:
            return self._changes_of_angle(points, turn)
        return self._turned_points(points, turn)

    def _ends(self, points: PointsOfFile) -> tuple[float, float, float, float]:
        places = (points.place_in_ground(p.body, _local(points, p)) for p in (self.first, self.second))
        (x0, y0), (x1, y1) = places
        return x0, y0, x1, y1

    def _changes_of_length(self, points: PointsOfFile, length: float) -> tuple[Change, ...]:
        """Move the second point along the line, or the first one, or change the only parameter that decides it."""
        for fixed, moved in ((self.first, self.second), (self.second, self.first)):
            a, b = _local(points, fixed), _local(points, moved)
            now = math.dist(a, b)
            if abs(length - now) <= _NEAR * now:
                return ()
            goal = tuple(x + (y - x) * length / now for x, y in zip(a, b, strict=True))
            if (changes := _moved_point(points, moved, goal)) is not None:
                return changes
        vectors = [points.vector_of_spot(p) for p in (self.first, self.second)]

        def measured(values: Mapping[str, float]) -> float:
            a, b = ([evaluate_formula(e, values) for e in vector] for vector in vectors)
            return math.dist(a, b)

        return (_solved_parameter(points, self.name, measured, length),)

    def _changes_of_angle(self, points: PointsOfFile, turn: float) -> tuple[Change, ...]:
        """Turn the body: the number of its angle, or the parameter that decides it."""
        name = self.first.body
        raw, path = points.raw["bodies"][name]["angle"], ("bodies", name, "angle")
        angle = next(b.angle for b in points.mechanism.bodies if isinstance(b, Body) and b.name == name)
        now = evaluate_formula(angle, points.values)
        if any(names_in_expression(angle)):
            change = _solved_parameter(points, self.name, lambda values: evaluate_formula(angle, values), now + turn)
            return (change,)
        span = span_of_number(points.text, points.spans[path])
        if span is None:  # a formula of numbers alone, as "pi/3"
            span, degrees = points.spans[path], exact_number(math.degrees(now + turn))
            return (Change(*span, f'"{degrees} deg"'),)
        return (Change(*span, exact_number((now + turn) / points.metres_of_unit(raw))),)

    def _turned_points(self, points: PointsOfFile, turn: float) -> tuple[Change, ...]:
        """Turn all points of a body and its centre of mass about the first one: its frame stays."""
        entry, body = points.raw["bodies"][self.first.body], self.first.body
        x0, y0 = _local(points, self.first)
        c, s = math.cos(turn), math.sin(turn)
        changes = list[Change]()
        written: dict[tuple[str, ...], Any] = {("points", key): vector for key, vector in entry["points"].items()}
        if "centre_of_mass" in entry:
            written["centre_of_mass",] = entry["centre_of_mass"]
        for keys, vector in written.items():
            point = WrittenPoint(body, ("bodies", body, *keys), keys[-1] if len(keys) > 1 else "", vector)
            if not isinstance(vector, list):
                raise _no_number(self.name)
            x, y = _local(points, point)
            goal = (x0 + c * (x - x0) - s * (y - y0), y0 + s * (x - x0) + c * (y - y0))
            own = _moved_point(points, point, goal, alone=True)
            if own is None:
                raise _no_number(self.name)
            changes += own
        return tuple(changes)


def _all_lines(points: PointsOfFile) -> Iterator[_Line]:
    """Yield the sides of bodies between points that follow each other, their angles, and lines between ground pins."""
    for name, entry in points.raw.get("bodies", {}).items():
        of = [
            WrittenPoint(name, ("bodies", name, "points", key), key, vector)
            for key, vector in (entry.get("points") or {}).items()
        ]
        sides = list(itertools.pairwise(of)) + ([(of[2], of[0])] if len(of) == 3 else [])
        for a, b in sides[:MOST_SIDES]:
            if _are_apart(points, a, b):
                yield _Line(LENGTH, f"bodies.{name}.{a.point}-{b.point}", (f"bodies.{name}",), a, b)
        if sides and _are_apart(points, *sides[0]) and name in points.poses:
            yield _Line(ANGLE, f"bodies.{name}.angle", (f"bodies.{name}",), *sides[0])
    grounded = {joint: spot for joint, spots in points.pins_with_points() for spot in spots if spot.body == GROUND}
    for (one, a), (other, b) in itertools.pairwise(grounded.items()):
        if _are_apart(points, a, b):
            yield _Line(LENGTH, f"ground.{one}-{other}", (f"joints.{one}", f"joints.{other}"), a, b)


def _are_apart(points: PointsOfFile, a: WrittenPoint, b: WrittenPoint) -> bool:
    try:
        one, other = _local(points, a), _local(points, b)
    except InputError:
        return False
    return math.dist(one, other) > 1e-9 * max(1.0, *map(abs, (*one, *other)))


def _local(points: PointsOfFile, point: WrittenPoint) -> tuple[float, float]:
    x, y = (evaluate_formula(e, points.values) for e in points.vector_of_spot(point))
    return x, y


def _moved_point(
    points: PointsOfFile, point: WrittenPoint, goal: Sequence[float], alone: bool = False
) -> tuple[Change, ...] | None:
    """Return the changes that move a point in its frame; None where a coordinate that changes is no number.

    A centre of mass in the middle of its body's points stays there, unless the point is moved `alone`.
    """
    now, changes = _local(points, point), list[Change]()
    for k, expression in enumerate(points.vector_of_spot(point)):
        if abs(goal[k] - now[k]) <= _NEAR * max(1.0, abs(now[k])):
            continue
        span = points.spans.get((*point.path, k))
        digits = None if span is None or any(names_in_expression(expression)) else span_of_number(points.text, span)
        if digits is None:
            return None
        changes.append(Change(*digits, exact_number(goal[k] / points.metres_of_unit(point.raw[k]))))
    if not alone:
        angle = points.poses[point.body][2]
        c, s = math.cos(angle), math.sin(angle)
        dx, dy = (g - x for g, x in zip(goal, now, strict=True))
        right, up = c * dx - s * dy, s * dx + c * dy
        changes += [
            Change(f.start, f.end, exact_number(f.value + f.right * right + f.up * up))
            for f in points.centre_that_follows(point)
            if abs(f.right * right + f.up * up) > _NEAR * max(1.0, abs(f.value))
        ]
    return tuple(changes)


def _solved_parameter(
    points: PointsOfFile, name: str, measured: Callable[[Mapping[str, float]], float], goal: float
) -> Change:
    """Return the change of the only parameter on which a dimension depends, by Newton's method."""

    def at(parameter: str, x: float) -> float:
        return measured(parameter_values(points.mechanism, {parameter: x}))

    def slope(parameter: str, x: float) -> float:
        step = _STEP * max(1.0, abs(x))
        return (at(parameter, x + step) - at(parameter, x - step)) / (2.0 * step)

    deciding = [p for p in points.of_parameters if abs(slope(p, points.values[p])) > 1e-9]
    if len(deciding) != 1:
        raise _no_number(name, deciding)
    (parameter,) = deciding
    x = points.values[parameter]
    for _ in range(_ROUNDS):
        gap = goal - at(parameter, x)
        if abs(gap) <= _NEAR * max(1.0, abs(goal)):
            break
        x += gap / (slope(parameter, x) or math.inf)
    else:
        raise InputError(name, f"a value that '{parameter}' can give it", f"{goal:.6g}")
    own = next(p for p in points.mechanism.parameters if p.name == parameter)
    return Change(*points.of_parameters[parameter], exact_number(own.own_unit.from_si(x)))


def _no_number(name: str, parameters: Sequence[str] = ()) -> InputError:
    got = f"one of {', '.join(parameters)}" if parameters else "one of formulas"
    return InputError(name, "a dimension that one number of the file decides", got, "change them in the text")
