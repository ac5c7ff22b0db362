"""What formulas name, as nodes of the graph of one mechanism, and what one function keeps for others."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from copy import copy
from typing import Any, Self

from symgen.formulate.equations import Equations
from symgen.ir.program import STATUS, Target
from symgen.lower.factor import Factor
from symgen.lower.replay import Nodes, Replay
from symgen.methods._formula import Operation

Outputs = list[tuple[Target, int]]
#: A sparse matrix: for each row its (column, node) entries in increasing order of column.
Rows = tuple[tuple[tuple[int, int], ...], ...]
#: Rows of a matrix W of weights: for each its nodes by column.
Weight = Sequence[Mapping[int, int]]


class Values(Replay):
    """What formulas name, as nodes of a mechanism's graph, which is copied.

    Parameters
    ----------
    parameters : sequence of str
        Names of the parameters of the method.
    places : mapping of str to (str, int)
        Space and first index of sections that are parts of other arrays.
    """

    def __init__(
        self,
        equations: Equations,
        operations: tuple[Operation, ...] = (),
        parameters: Sequence[str] = (),
        places: Mapping[str, tuple[str, int]] | None = None,
    ) -> None:
        super().__init__(equations.graph.copy(), operations)
        e, g = equations, self.graph
        k = e.nq + e.nv
        self.places = {"rates.q": ("ydot", 0), "rates.v": ("ydot", e.nq), "rates.work": ("ydot", k)} | {
            **{"k_q": ("k", 0), "k_v": ("k", e.nq), "k_first": ("k", k), "k_second": ("k", k + e.m)}
        }
        self.equations, self.places = equations, self.places if places is None else dict(places)
        self.parameters = {name: g.input("parameter", i) for i, name in enumerate(parameters)}
        self.mask = tuple(g.input("mask", i) for i in range(e.m))
        self.rows: Rows = tuple(row.entries for row in e.rows)
        self.phi = tuple(g.zero if r.phi is None else r.phi for r in e.rows)
        self.nu = tuple(r.nu for r in e.rows)
        self.v = tuple(g.input("v", i) for i in range(e.nv))
        self.flags: list[int] = []
        self.kept: dict[str, Outputs] = {}

    def following(self, operations: tuple[Operation, ...]) -> Self:
        """Return the same for another tape, in the same graph."""
        other = copy(self)
        other.operations, other.values = operations, {}
        return other

    def size(self, name: str) -> int:
        """Return the length that ``nq``, ``nv`` or ``m`` stands for."""
        return {"nq": self.equations.nq, "nv": self.equations.nv, "m": self.equations.m}[name]

    def section(self, name: str, size: int) -> Nodes:
        """Return a section of ``w``, or of what stands for it, as inputs."""
        space, first = self.places.get(name, (name, 0))
        return tuple(self.graph.input(space, first + i) for i in range(size))

    def _on_quantity(self, operation: Operation) -> Nodes:
        e = self.equations
        name = str(operation.payload[0])
        gamma = tuple(r.gamma for r in e.rows)
        known = {"f": e.forces, "q_rates": e.q_rates, "phi": self.phi, "nu": self.nu, "v": self.v, "gamma": gamma}
        return known[name]

    def _on_section(self, operation: Operation) -> Nodes:
        return self.section(str(operation.payload[0]), self.size(operation.size))

    def _on_parameter(self, operation: Operation) -> int:
        return self.parameters[str(operation.payload[0])]

    def _on_status(self, operation: Operation) -> int:
        return self.graph.input("status", STATUS.index(str(operation.payload[0])))

    def _on_power(self, operation: Operation) -> int:
        return self.equations.power

    def _on_driving(self, operation: Operation, accelerations: Nodes) -> int:
        g, driving = self.graph, self.equations.driving
        assert driving is not None, "drivers prescribe coordinates"
        return g.add(g.total(g.mul(node, accelerations[j]) for j, node in driving.entries), driving.rest)

    def _on_zeros(self, operation: Operation) -> Nodes:
        return (self.graph.zero,) * self.size(operation.size)

    def _on_holonomic_or(self, operation: Operation, otherwise: Nodes) -> Nodes:
        rows = zip(self.equations.rows, otherwise, strict=True)
        return tuple(node if row.phi is None else row.phi for row, node in rows)

    def _on_dot(self, operation: Operation, a: Nodes, b: Nodes) -> int:
        return self.graph.dot(a, b)

    def _on_at_velocity(self, operation: Operation, x: Nodes | int, v: Nodes) -> Any:
        vector = isinstance(x, tuple)
        found = self.graph.replaced(x if isinstance(x, tuple) else (x,), {("v", i): n for i, n in enumerate(v)})
        return tuple(found) if vector else found[0]

    def _keep(self, section: str, x: Iterable[int]) -> Iterator[int]:
        """Note what one function writes into a section, and yield it as others read it, literals as they are."""
        written = self.kept.setdefault(section, [])
        for node in x:
            if self.graph.value(node) is None:
                written.append((Target(section, len(written)), node))
                node = self.graph.input(section, len(written) - 1)
            yield node

    def _keep_factor(self, factor: Factor, lower: str, reciprocal: str) -> Factor:
        entries = iter(list(self._keep(lower, (n for k in factor.order for _, n in factor.lower[k]))))
        columns = {k: tuple((i, next(entries)) for i, _ in factor.lower[k]) for k in factor.order}
        pivots = list(self._keep(reciprocal, (factor.reciprocal[k] for k in factor.order)))
        reciprocals = dict(zip(factor.order, pivots, strict=True))
        return Factor(factor.order, columns, reciprocals, factor.pivots, factor.diagonal)

    def _on_keep(self, operation: Operation, x: Nodes) -> Nodes:
        return tuple(self._keep(str(operation.payload[0]), x))

    def _on_keep_constraints(self, operation: Operation, matrix: Rows) -> Rows:
        nodes = iter(list(self._keep(str(operation.payload[0]), (e for row in matrix for _, e in row))))
        return tuple(tuple((j, next(nodes)) for j, _ in row) for row in matrix)

    def _on_keep_factor(self, operation: Operation, factor: Factor) -> Factor:
        return self._keep_factor(factor, *(str(operation.payload[0]),) * 2)

    def _on_stored_factor(self, operation: Operation, factor: Factor) -> Factor:
        prefix = str(operation.payload[0])
        return self._keep_factor(factor, f"{prefix}lower", f"{prefix}reciprocal")

    def _reciprocal(self, row: int, pivot: int, diagonal: int) -> int:
        return self.graph.div(self.graph.one, pivot)


def to_status(name: str, node: int) -> tuple[Target, int]:
    """Return an output to the status at the beginning of ``w``."""
    return Target("status", STATUS.index(name)), node
