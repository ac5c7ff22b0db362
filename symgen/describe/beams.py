"""Beams of a mechanism file: each becomes bodies, the nodes, and beam elements between them before validation.

A node has the mass and the rotary inertia of the beam at its place, by the weights of a rule of integration that is
exact for cubics and positive (Gregory's, of fourth order), so that mass, centre of mass and moments of inertia of the
beam are exact, and frequencies converge as its elements do while M stays diagonal.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from itertools import pairwise
from typing import Any

import msgspec

from symgen.describe.beam_sections import BeamSection, properties_of
from symgen.describe.bodies import shifted, turned
from symgen.describe.evaluate import scalars
from symgen.describe.fields import read, words_of
from symgen.describe.formula_text import to_text
from symgen.describe.kinds import FORCES, JOINTS
from symgen.describe.mechanism import AnyBody, Body, SpatialBody, Vec
from symgen.describe.scope import CENTRE, Scope
from symgen.describe.start import euler_parameters
from symgen.errors import nearest, quoted
from symgen.vocabulary.expressions import ONE, ZERO, Expr, Number, call, number, total
from symgen.vocabulary.measures import GROUND
from symgen.vocabulary.rotations import matrix

Raw = Mapping[str, Any]
#: Names of the nodes at the ends, and how elements and loads are called behind a beam's name.
START, END, ELEMENT, LOAD = "start", "end", "e", "load"
#: Elements of a beam at most.
MOST_ELEMENTS = 100_000
_PLACE = re.compile(r"at\(\s*([0-9.eE+-]+)\s*\)")
#: Coordinates of the place in a load by length.
_OWN = re.compile(r"(?<![A-Za-z0-9_.])([xyz])(?![A-Za-z0-9_.])")
#: Weights of few nodes: trapezoid, Simpson, 3/8, Boole; and those at the ends of many nodes.
_FEW = {1: (0.5,), 2: (1 / 3, 4 / 3), 3: (3 / 8, 9 / 8), 4: (14 / 45, 64 / 45, 24 / 45)}
_MANY = (3 / 8, 7 / 6, 23 / 24)


def weights(elements: int) -> list[float]:
    """Return the weights of the nodes of a beam in lengths of its elements, all above 0."""
    ends = _FEW.get(elements, _MANY)
    return [(*ends, 1.0)[min(k, elements - k, len(ends))] for k in range(elements + 1)]


@dataclass(frozen=True)
class _Clamp:
    """The end of a beam on a body: the place and axes in that body's frame, mass and rotary inertia about the axes."""

    body: str
    place: Vec
    axes: tuple[Vec, ...]
    mass: Expr
    rotary: tuple[Expr, ...]


class Beams:
    """The beams of a description.

    Parameters
    ----------
    raw : mapping
        The description.
    scope_of : callable
        Scope of a section and a name.
    body_of : callable
        Reads the body that a scope names from its table.
    """

    def __init__(
        self, raw: Raw, scope_of: Callable[[str, str], Scope], body_of: Callable[[Scope, object], AnyBody]
    ) -> None:
        self.raw, self.scope_of, self.body_of = raw, scope_of, body_of
        self._nodes: dict[str, list[str]] = {}  # beam -> its nodes, "" for an end that is clamped
        self._clamps: list[_Clamp] = []
        self._centres: dict[str, Any] = {}  # of bodies that ends are clamped to, in their frames
        self.bodies: dict[str, Any] = {}
        self.forces: dict[str, Any] = {}

    def expanded(self) -> dict[str, Any]:
        """Return the description without beams: with their nodes behind its bodies, their elements before its forces.

        Raises
        ------
        InputError
            At the first thing of a beam that is wrong.
        """
        for name, table in self.raw["beams"].items():
            scope = self.scope_of("beams", name)
            self._add(scope, name, read(BeamSection, table, scope.where("")))
        raw = {key: dict(value) if key in ("joints", "forces") else value for key, value in self.raw.items()}
        for section in ("joints", "forces"):
            for name, table in raw.get(section, {}).items():
                if isinstance(table, Mapping):
                    raw[section][name] = self._on_nodes(self.scope_of(section, name), dict(table), section)
        del raw["beams"]
        return raw | {
            "bodies": {**self.raw.get("bodies", {}), **self.bodies},
            "forces": {**self.forces, **raw.get("forces", {})},
        }

    def clamped(self, body: AnyBody) -> AnyBody:
        """Return a body with the masses of the ends of beams that are clamped to it."""
        for clamp in self._clamps:
            if clamp.body == body.name and not body.is_point:
                body = _with_mass(body, clamp)
        return body

    # -- nodes and elements ------------------------------------------------------------------------------------------

    def _add(self, scope: Scope, name: str, beam: BeamSection) -> None:
        n = beam.elements
        if not 1 <= n <= MOST_ELEMENTS:
            raise scope.error("elements", f"a number of elements, 1 to {MOST_ELEMENTS}", str(n))
        if beam.load is not None and any(x in scope.context.states for x in "xyz"):
            raise scope.error("load", "x, y and z to mean the place", "a parameter or an input of that name")
        shape, properties = _shape(scope, beam), properties_of(scope, beam)
        clamps = [beam.clamp, ""] if isinstance(beam.clamp, str) else list(beam.clamp)
        if len(clamps) != 2:
            raise scope.error("clamp", "one body, or two: that of the start and that of the end", words_of(beam.clamp))
        names = [f"{name}.{START}", *(f"{name}.{k}" for k in range(1, n)), f"{name}.{END}"]
        length, step = total(shape.length), call("div", shape.length, number(n))
        ends: list[tuple[str, Any, Any, Any]] = []
        self._nodes[name] = []
        for k, (node, weight) in enumerate(zip(names, weights(n), strict=True)):
            pose, size = shape.pose(k / n), _times(number(weight), step)
            mass = _times(size, properties.mass)
            rotary = tuple(_times(size, e) for e in properties.rotary)
            clamp = clamps[0] if k == 0 else clamps[1] if k == n else ""
            if clamp:
                ends.append(self._clamp(scope, clamp, pose, mass, rotary))
            else:
                self.bodies[node] = self._node(scope, beam, shape, pose, mass, rotary)
                x, y = ([float(i == j) for j in range(scope.dimension)] for i in range(2))
                ends.append((node, CENTRE, x, y))
                if beam.load is not None:
                    load = [_times_text(size, part, node) for part in beam.load]
                    self.forces[f"{name}.{LOAD}{k}"] = {"type": "force", "body": node, "force": load}
            self._nodes[name].append("" if clamp else node)
        element: dict[str, Any] = {
            "type": "beam",
            "length": _raw(step),
            "damping": beam.damping,
            **properties.stiffness,
        }
        if shape.bend != ZERO:
            bend = _raw(call("div", shape.bend, length))
            element["curvature"] = [0.0, 0.0, bend] if scope.spatial else bend
        for k, (a, b) in enumerate(pairwise(ends)):
            keys = {"between": [a[0], b[0]], "at": [a[1], b[1]], "axis": [a[2], b[2]]}
            if scope.spatial:
                keys["reference"] = [a[3], b[3]]
            self.forces[f"{name}.{ELEMENT}{k + 1}"] = element | keys

    def _node(
        self, scope: Scope, beam: BeamSection, shape: _Shape, pose: _Pose, mass: Expr, rotary: tuple[Expr, ...]
    ) -> dict[str, Any]:
        """Return the table of a node."""
        node: dict[str, Any] = {"mass": _raw(mass), "position": [_raw(e) for e in pose.place], "hold": beam.hold}
        if scope.spatial:
            node["inertia"] = [_raw(e) for e in rotary]
            node["orientation"] = {f"{x}_axis": [_raw(e) for e in pose.axes[i]] for i, x in enumerate("xy")}
        else:
            node["inertia"], node["angle"] = _raw(rotary[0]), _raw(pose.angle)
        if beam.velocity is None and beam.angular_velocity is None:
            return node
        still = (0.0,) * scope.dimension
        velocity = scope.vector("velocity", still if beam.velocity is None else beam.velocity)
        arm = tuple(_less(x, y) for x, y in zip(pose.place, shape.start, strict=True))
        turning = beam.angular_velocity
        if scope.spatial:
            omega = scope.vector("angular_velocity", still if turning is None else _three(scope, turning))
            swept = tuple(_less(_times(omega[i - 2], arm[i - 1]), _times(omega[i - 1], arm[i - 2])) for i in range(3))
            node["angular_velocity"] = [_raw(_dot(omega, axis)) for axis in pose.axes]
        else:
            if isinstance(turning, tuple):
                raise scope.error("angular_velocity", "one number in the plane", words_of(turning))
            omega = (scope.constant("angular_velocity", 0.0 if turning is None else turning),)
            swept = _times(call("neg", omega[0]), arm[1]), _times(omega[0], arm[0])
            node["angular_velocity"] = _raw(omega[0])
        node["velocity"] = [_raw(total(v, w)) for v, w in zip(velocity, swept, strict=True)]
        return node

    def _clamp(
        self, scope: Scope, name: str, pose: _Pose, mass: Expr, rotary: tuple[Expr, ...]
    ) -> tuple[str, Any, Any, Any]:
        """Return the body of a clamped end with the place and two axes of the end there, and keep its mass for it."""
        place, axes = pose.place, pose.axes
        if name != GROUND:
            bodies = self.raw.get("bodies", {})
            if name not in bodies:
                got = f"the unknown body {quoted(name)}"
                raise scope.error("clamp", "the name of a body or 'ground'", got, nearest(name, [*bodies, GROUND]))
            body = self.body_of(self.scope_of("bodies", name), bodies[name])
            if body.is_point:
                raise scope.error("clamp", "a body with an angle", f"the point mass '{name}'")
            frame = _axes_of(scope, body)
            arm = tuple(_less(x, y) for x, y in zip(place, body.position, strict=True))
            place = tuple(_dot(arm, axis) for axis in frame)
            axes = tuple(tuple(_dot(v, axis) for axis in frame) for v in axes)
            self._clamps.append(_Clamp(name, place, axes, mass, rotary))
            self._centres[name] = [_raw(e) for e in body.centre_of_mass]
        return name, [_raw(e) for e in place], *([_raw(e) for e in axis] for axis in axes[:2])  # type: ignore[return-value]

    # -- names of nodes ----------------------------------------------------------------------------------------------

    def _on_nodes(self, scope: Scope, table: dict[str, Any], section: str) -> dict[str, Any]:
        """Return the table of a joint or force with beams and places on them replaced by nodes.

        The centre of a body that ends of beams are clamped to is that of the body as it is described.
        """
        if _is(table.get("body"), self._centres) and table.get("at", CENTRE) == CENTRE and table.get("type") == "force":
            table["at"] = self._centres[table["body"]]
        at = table.get("at")
        if isinstance(table.get("between"), list | tuple) and isinstance(at, list | tuple):
            pairs = zip(table["between"], at, strict=False)
            table["at"] = at = [self._centres[b] if x == CENTRE and _is(b, self._centres) else x for b, x in pairs]
        if isinstance(table.get("body"), str) and table["body"] in self._nodes:
            table["body"] = self._node_at(scope, table["body"], at)
            at = CENTRE
        elif isinstance(table.get("between"), list | tuple) and any(_is(b, self._nodes) for b in table["between"]):
            between = list(table["between"])
            places = list(at) if isinstance(at, list | tuple) and len(at) == len(between) else [None] * len(between)
            for i, body in enumerate(between):
                if _is(body, self._nodes):
                    between[i], places[i] = self._node_at(scope, body, places[i]), CENTRE
            table["between"], at = between, places
        else:
            return table
        kinds: Any = JOINTS if section == "joints" else FORCES
        kind = table.get("type")
        table.pop("at", None)
        if not (isinstance(kind, str) and kind in kinds) or "at" in kinds.get(kind).__struct_fields__:
            table["at"] = at
        return table

    def _node_at(self, scope: Scope, beam: str, at: object) -> str:
        """Return the node of a beam at one of its ends, by its number, or at a place."""
        nodes = self._nodes[beam]
        last = len(nodes) - 1
        expected = f"a node of the beam '{beam}': '{START}', '{END}', a number up to {last}, or 'at(0.5)' of its length"
        numbers = {START: 0, END: last} | {str(k): k for k in range(last + 1)}
        place = _PLACE.fullmatch(at) if isinstance(at, str) else None
        if place is not None:
            try:
                where = float(place.group(1)) * last
            except ValueError:
                raise scope.error("at", expected, words_of(at)) from None
            k = min(max(round(where), 0), last)
            if abs(where - k) > 1e-9 * last:
                hint = f"the nearest node is number {k}, at({k / last:g})"
                raise scope.error("at", expected, f"{words_of(at)}, where no node is", hint)
        elif isinstance(at, bool) or not isinstance(at, int | str) or str(at) not in numbers:
            raise scope.error("at", expected, "no such key" if at is None else words_of(at))
        else:
            k = numbers[str(at)]
        if not nodes[k]:
            got = f"the end of '{beam}' that is clamped to a body"
            raise scope.error("at", "a node that moves by itself", got, "name that body and a point of it")
        return nodes[k]


def _is(name: object, names: Mapping[str, object]) -> bool:
    return isinstance(name, str) and name in names


# -- shape -----------------------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class _Pose:
    """Where a section of the unloaded beam is: its place, its axes, and in the plane its angle."""

    place: Vec
    axes: tuple[Vec, ...]
    angle: Expr


@dataclass(frozen=True)
class _Shape:
    """The unloaded beam: a straight line or an arc from `start` in the plane of two axes.

    `chord` is the distance of its ends, `axes` begin with the direction of the chord, `bend` is the angle [rad] by
    which it turns towards the second one.
    """

    start: Vec
    chord: Expr
    axes: tuple[Vec, ...]
    bend: Expr

    @property
    def length(self) -> Expr:
        """The length of the line."""
        if self.bend == ZERO:
            return self.chord
        half = _times(number(0.5), self.bend)
        return _times(self.chord, call("div", half, call("sin", half)))

    def pose(self, part: float) -> _Pose:
        """Return the section at a part of the length."""
        first, second = self.axes[:2]
        reach: Expr = _times(number(part), self.chord)
        across: Expr = ZERO
        turn: Expr = ZERO
        if self.bend != ZERO:
            half = _times(number(0.5), self.bend)
            along = _times(number(part), half)
            far = _times(self.chord, call("div", call("sin", along), call("sin", half)))
            lean, turn = call("sub", along, half), call("sub", _times(number(2.0), along), half)
            reach, across = _times(far, call("cos", lean)), _times(far, call("sin", lean))
        place = tuple(
            total(s, _times(reach, a), _times(across, b)) for s, a, b in zip(self.start, first, second, strict=True)
        )
        cosine, sine = call("cos", turn), call("sin", turn)
        x = tuple(total(_times(cosine, a), _times(sine, b)) for a, b in zip(first, second, strict=True))
        y = tuple(_less(_times(cosine, b), _times(sine, a)) for a, b in zip(first, second, strict=True))
        return _Pose(place, (x, y, *self.axes[2:]), total(call("atan2", first[1], first[0]), turn))


def _shape(scope: Scope, beam: BeamSection) -> _Shape:
    start, end = scope.vector("start", beam.start), scope.vector("end", beam.end)
    between = tuple(_less(b, a) for a, b in zip(start, end, strict=True))
    chord = _length(between)
    if not scope.value(chord, "end") > 0.0:
        raise scope.error("end", "another point than start", "the same")
    first = _divided(between, chord)
    bend = scope.constant("arc", beam.arc)
    if not abs(scope.value(bend, "arc")) < 6.28:
        raise scope.error("arc", "less than a turn [rad]", words_of(beam.arc))
    if not scope.spatial:
        if beam.y_axis is not None:
            raise scope.error("y_axis", "no such key in the plane", words_of(beam.y_axis))
        return _Shape(start, chord, (first, (call("neg", first[1]), first[0])), bend)
    wanted = scope.vector("y_axis", (0.0, 1.0, 0.0) if beam.y_axis is None else beam.y_axis)
    part = _dot(wanted, first)
    rest = tuple(_less(w, _times(part, e)) for w, e in zip(wanted, first, strict=True))
    size = _length(rest)
    if not scope.value(size, "y_axis") > 1e-6:
        raise scope.error("y_axis", "a direction across the beam", "one along it" if beam.y_axis else "no such key")
    second = _divided(rest, size)
    third = tuple(_less(_times(first[i - 2], second[i - 1]), _times(first[i - 1], second[i - 2])) for i in range(3))
    return _Shape(start, chord, (first, second, third), bend)


def _axes_of(scope: Scope, body: AnyBody) -> tuple[Vec, ...]:
    """Return the axes of a body's frame in the ground frame, as it is described."""
    if isinstance(body, Body):
        cosine, sine = call("cos", body.angle), call("sin", body.angle)
        return (cosine, sine), (call("neg", sine), cosine)
    if not body.orientation.is_numeric:
        raise scope.error("clamp", "a body whose orientation at the start is given in numbers", f"'{body.name}'")
    rows = matrix(euler_parameters(body.orientation, scalars(scope.context.values), scope.where("clamp")))
    return tuple(tuple(number(x) for x in column) for column in zip(*rows, strict=True))


def _with_mass(body: AnyBody, clamp: _Clamp) -> AnyBody:
    """Return a body with a further mass and rotary inertia at a place of its frame (Huygens, Steiner)."""
    mass = total(body.mass, clamp.mass)
    share = call("div", clamp.mass, mass)
    apart = tuple(_less(p, c) for p, c in zip(clamp.place, body.centre_of_mass, strict=True))
    centre = tuple(total(c, _times(share, d)) for c, d in zip(body.centre_of_mass, apart, strict=True))
    reduced = _times(share, body.mass)
    if isinstance(body, Body):
        assert body.inertia is not None, "a point mass clamps nothing"
        inertia = total(body.inertia, clamp.rotary[0], _times(reduced, _dot(apart, apart)))
        return msgspec.structs.replace(body, mass=mass, centre_of_mass=centre, inertia=inertia)
    assert isinstance(body, SpatialBody) and body.inertia is not None, "a point mass clamps nothing"
    x, y, z = clamp.rotary
    columns = [[e.value for e in axis if isinstance(e, Number)] for axis in clamp.axes]
    rows = tuple(zip(*columns, strict=True))
    own = turned((x, y, z, ZERO, ZERO, ZERO), rows)  # type: ignore[arg-type]  # three rows of three
    both = tuple(total(a, b) for a, b in zip(body.inertia, own, strict=True))
    tensor = shifted(both, call("neg", reduced), apart)  # type: ignore[arg-type]  # six entries
    return msgspec.structs.replace(body, mass=mass, centre_of_mass=centre, inertia=tensor)


# -- arithmetic ------------------------------------------------------------------------------------------------------


def _raw(e: Expr) -> float | str:
    """Return a formula as a file gives it."""
    return e.value if isinstance(e, Number) else to_text(e)


def _times_text(size: Expr, part: float | str, node: str) -> str:
    """Return a load by length, times the length of beam that a node has, at that node."""
    own = _OWN.sub(lambda match: f"{node}.{match.group()}", str(part))
    return f"({to_text(size)})*({own})"


def _times(a: Expr, b: Expr) -> Expr:
    return ZERO if ZERO in (a, b) else b if a == ONE else a if b == ONE else call("mul", a, b)


def _less(a: Expr, b: Expr) -> Expr:
    return a if b == ZERO else call("neg", b) if a == ZERO else call("sub", a, b)


def _dot(a: Vec, b: Vec) -> Expr:
    return total(*(_times(x, y) for x, y in zip(a, b, strict=True)))


def _length(v: Vec) -> Expr:
    return call("sqrt", _dot(v, v))


def _divided(v: Vec, length: Expr) -> Vec:
    return tuple(e if e == ZERO else call("div", e, length) for e in v)


def _three(scope: Scope, value: float | str | tuple[float | str, ...]) -> tuple[float | str, ...]:
    if not isinstance(value, tuple):
        raise scope.error("angular_velocity", "three numbers or expressions of parameters", words_of(value))
    return value
