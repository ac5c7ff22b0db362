"""Formulas of a mechanism as nodes of one graph: equal nodes where formulas are equal after simplification."""

from __future__ import annotations

from dataclasses import dataclass, field

from symgen.base.ir.formula import GraphFunctions
from symgen.base.ir.graph import ARITHMETIC, Graph
from symgen.base.vocabulary.expressions import Expr, Name, Number, Reading, call
from symgen.base.vocabulary.measures import GROUND, Direction, Marker
from symgen.describe.mechanism import Mechanism


@dataclass
class Formulas:
    """The names of a mechanism as inputs of a graph: time, parameters, coordinates and velocities in their order."""

    mechanism: Mechanism
    graph: Graph = field(default_factory=Graph)

    def __post_init__(self) -> None:
        g = self.graph
        self.names: dict[str, int] = {"t": g.input("t", 0)}
        for i, parameter in enumerate(self.mechanism.parameters):
            self.names[parameter.name] = g.input("p", i)
        self.first_q: dict[str, int] = {}  # body -> index of its first coordinate
        self.first: dict[str, int] = {}  # body -> index of its first velocity
        coordinates = index = 0
        for body in self.mechanism.bodies:
            self.first_q[body.name], self.first[body.name] = coordinates, index
            for coordinate in body.coordinates:
                self.names[f"{body.name}.{coordinate}"] = g.input("q", coordinates)
                coordinates += 1
            for speed in body.speeds:
                self.names[f"{body.name}.{speed}"] = g.input("v", index)
                index += 1
        self.size = index
        for i, state in enumerate(self.mechanism.states, 1):  # after the work
            self.names[state.name] = g.input("z", i)
        #: Body -> reference point of its points: its centre of mass, unless a joint holds it elsewhere.
        self.references = {b.name: b.centre_of_mass for b in self.mechanism.bodies}

    def expression(self, e: Expr, **placeholders: int) -> int:
        """Return the node of a formula of the file."""
        names = {**self.names, **placeholders} if placeholders else self.names
        functions = GraphFunctions(self.graph)

        def node(e: Expr) -> int:
            if isinstance(e, Number):
                return self.graph.constant(e.value)
            if isinstance(e, Name):
                return names[e.name]
            if isinstance(e, Reading):
                return self.reading(e)
            arguments = tuple(node(a) for a in e.arguments)
            if e.function in ARITHMETIC:
                return self.graph.apply(e.function, arguments)
            return functions.call(e.function, *arguments)

        return node(e)

    def reading(self, r: Reading) -> int:
        """Return the node of a measure's value or rate.

        Raises
        ------
        KeyError
            As measures are derived by `symgen.derive.formulate`.
        """
        raise KeyError(r.name)

    def local(self, marker: Marker) -> list[int]:
        """Return the marker relative to the body's point of reference (ground: to the origin)."""
        point = marker.point
        if marker.body != GROUND:
            point = tuple(call("sub", p, c) for p, c in zip(point, self.references[marker.body], strict=True))
        return [self.expression(e) for e in point]

    def direction(self, along: Direction) -> list[int]:
        """Return the components of a direction in its body's frame."""
        return [self.expression(e) for e in along.vector]
