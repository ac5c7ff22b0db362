"""Measures of a mechanism's markers, instantiated from kernels in the model's graph."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from symgen.describe.mechanism import Mechanism
from symgen.formulate.frames import FRAME_SLOTS
from symgen.formulate.kernels import derive
from symgen.ir.expression import build
from symgen.ir.graph import Graph
from symgen.vocabulary.expressions import Expr, call
from symgen.vocabulary.measures import (
    GROUND,
    Angle,
    Component,
    Direction,
    Distance,
    LinkStretch,
    Marker,
    Measure,
    Nonholonomic,
)


@dataclass(frozen=True)
class Derived:
    """A measure in the model: value, row (velocity index -> node) and quadratic velocity term b of s'' = J v' + b."""

    value: int
    row: Mapping[int, int]
    bias: int

    def rate(self, graph: Graph, velocities: tuple[int, ...]) -> int:
        """Return the node of s' = J v."""
        return graph.total(graph.mul(node, velocities[i]) for i, node in sorted(self.row.items()))


@dataclass
class Model:
    """The mechanism's names resolved to nodes: what every instantiation needs."""

    mechanism: Mechanism
    graph: Graph = field(default_factory=Graph)

    def __post_init__(self) -> None:
        g, mechanism = self.graph, self.mechanism
        self.time = g.input("t", 0)
        self.names: dict[str, int] = {"t": self.time}
        self.coordinate_index: dict[str, int] = {}
        for i, parameter in enumerate(mechanism.parameters):
            self.names[parameter.name] = g.input("p", i)
        self.first: dict[str, int] = {}
        index = 0
        for body in mechanism.bodies:
            self.first[body.name] = index
            for coordinate, speed in zip(body.coordinates, body.speeds, strict=True):
                self.names[f"{body.name}.{coordinate}"] = g.input("q", index)
                self.names[f"{body.name}.{speed}"] = g.input("v", index)
                index += 1
        self.size = index
        self.velocities = tuple(g.input("v", i) for i in range(index))
        self._memo: dict[object, Derived] = {}

    def expression(self, e: Expr, **placeholders: int) -> int:
        """Return the node of a formula of the file."""
        return build(self.graph, e, {**self.names, **placeholders} if placeholders else self.names)

    def kind(self, body: str) -> str:
        """Return the frame kind of a body."""
        return "ground" if body == GROUND else "point" if self.mechanism.body(body).is_point else "rigid"

    def local(self, marker: Marker) -> tuple[int, int]:
        """Return the marker relative to the centre of mass (ground: to the origin)."""
        if marker.body == GROUND:
            x, y = marker.point
        else:
            com = self.mechanism.body(marker.body).centre_of_mass
            x, y = (call("sub", p, c) for p, c in zip(marker.point, com, strict=True))
        return self.expression(x), self.expression(y)

    def frame_inputs(self, body: str) -> list[int]:
        """Return the nodes of a frame's slots."""
        g, kind = self.graph, self.kind(body)
        if kind == "ground":
            return [g.zero] * len(FRAME_SLOTS)
        i = self.first[body]
        x, y, vx, vy = g.input("q", i), g.input("q", i + 1), g.input("v", i), g.input("v", i + 1)
        if kind == "point":
            return [x, y, g.one, g.zero, vx, vy, g.zero]
        theta = g.input("q", i + 2)
        return [x, y, g.call("cos", theta), g.call("sin", theta), vx, vy, g.input("v", i + 2)]

    # -- measures ----------------------------------------------------------------------------------------------------

    def measure(self, m: Measure) -> Derived:
        """Return value, row and bias of a measure; equal measures are derived once."""
        found = self._memo.get(m)
        if found is None:
            found = self._memo[m] = self._measure(m)
        return found

    def _measure(self, m: Measure) -> Derived:
        if isinstance(m, Angle):
            return self._angle(m)
        if isinstance(m, Component):
            return self._kernel("component", (m.a.body, m.b.body, m.along.body), self._points(m.a, m.b, m.along))
        if isinstance(m, Distance):
            return self._kernel("distance", (m.a.body, m.b.body), self._points(m.a, m.b))
        if isinstance(m, LinkStretch):
            constants = [*self._points(m.a, m.b), self.expression(m.length)]
            return self._kernel("link-stretch", (m.a.body, m.b.body), constants)
        g = self.graph
        value, bias, row = g.zero, g.zero, dict[int, int]()
        for coefficient, part in m.terms:
            k, derived = self.expression(coefficient), self.measure(part)
            value = g.add(value, g.mul(k, derived.value))
            bias = g.add(bias, g.mul(k, derived.bias))
            for i, node in derived.row.items():
                row[i] = g.add(row.get(i, g.zero), g.mul(k, node))
        return Derived(value, {i: n for i, n in row.items() if n != g.zero}, bias)

    def point_speed(self, row: Nonholonomic) -> Derived:
        """Return the velocity measure of a nonholonomic row; `value` is the kernel's u = J v."""
        constants = [*self.local(row.at), *(self.expression(e) for e in row.along.vector)]
        return self._kernel("point-speed", (row.at.body, row.along.body), constants)

    def _points(self, a: Marker, b: Marker, along: Direction | None = None) -> list[int]:
        constants = [*self.local(a), *self.local(b)]
        if along is not None:
            constants += [self.expression(e) for e in along.vector]
        return constants

    def _angle(self, m: Angle) -> Derived:
        g, value, row = self.graph, self.graph.zero, dict[int, int]()
        for body, sign in ((m.b, g.one), (m.a, g.constant(-1.0))):
            if body != GROUND:
                i = self.first[body] + 2
                value = g.add(value, g.mul(sign, g.input("q", i)))
                row[i] = g.add(row.get(i, g.zero), sign)
        return Derived(value, {i: n for i, n in row.items() if n != g.zero}, g.zero)

    def _kernel(self, kind: str, bodies: tuple[str, ...], constants: list[int]) -> Derived:
        slots: dict[str, int] = {}
        for body in bodies:
            slots.setdefault(body, len(slots))
        kernel = derive(kind, tuple((slots[b], self.kind(b)) for b in bodies))
        flat = [node for body in slots for node in self.frame_inputs(body)] + constants
        nodes = self.graph.inline(kernel.graph, kernel.outputs, {("slot", i): n for i, n in enumerate(flat)})
        row: dict[int, int] = {}
        position = 1
        for body, part in zip(slots, kernel.row, strict=True):
            for offset in range(len(part)):
                if nodes[position] != self.graph.zero:
                    row[self.first[body] + offset] = nodes[position]
                position += 1
        return Derived(nodes[0], row, nodes[-1])
