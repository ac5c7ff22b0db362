"""Names of formulas as nodes of the graph of one mechanism: vectors, D row by row, values kept for other functions."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from copy import copy
from functools import cached_property
from typing import Any, Self

from symgen.base.ir.derivative import jacobian
from symgen.base.ir.program import STATUS, JacobianEntry, OutputSlot
from symgen.derive.formulate.equations import Drag, Equations
from symgen.derive.lower.drag import length_of_vector
from symgen.derive.lower.factor import FactorNodes
from symgen.derive.lower.replay import Nodes, Replay
from symgen.derive.methods._tape import FormulaStep

Outputs = list[tuple[OutputSlot, int]]
#: A sparse matrix: for each row its (column, node) entries in increasing order of column.
Rows = tuple[tuple[tuple[int, int], ...], ...]
#: Rows of a matrix W of weights: for each its nodes by column.
Weight = Sequence[Mapping[int, int]]


class NodeValues(Replay):
    """Names of formulas as nodes of a mechanism's graph, which is copied.

    Parameters
    ----------
    places : mapping of str to (str, int)
        Space and first index of sections that are parts of other arrays.
    """

    def __init__(
        self,
        equations: Equations,
        operations: tuple[FormulaStep, ...] = (),
        parameters: Sequence[str] = (),
        places: Mapping[str, tuple[str, int]] | None = None,
    ) -> None:
        super().__init__(equations.graph.copy(), operations, parameters)
        e, g = equations, self.graph
        k = e.nq + e.nv
        self.places = {"rates.q": ("ydot", 0), "rates.v": ("ydot", e.nq), "rates.work": ("ydot", k)} | {
            **{"k_q": ("k", 0), "k_v": ("k", e.nq), "k_first": ("k", k), "k_second": ("k", k + e.m)}
        }
        self.equations, self.places = equations, self.places if places is None else dict(places)
        for i in range(len(self.parameters)):
            g.input("parameter", i)  # so that the numbers of nodes do not depend on the first use in a formula
        self.mask = tuple(g.input("mask", i) for i in range(e.m))
        self.rows: Rows = tuple(row.entries for row in e.rows)
        self.directions = self.rows  # also of rows that are left out
        self.phi = tuple(g.zero if r.phi is None else r.phi for r in e.rows)
        self.nu = tuple(r.nu for r in e.rows)
        self.v = tuple(g.input("v", i) for i in range(e.nv))
        self.flags: list[int] = []
        self.stored: dict[str, Outputs] = {}
        #: Of drags: their power, the squares of their jamming numbers, and the multipliers of unknowns.
        self.drag_power, self.jamming = self.graph.zero, list[int]()
        self.pressing: Nodes = ()
        #: Whether drags are unknowns of f, one number an element.
        self.pushing = False

    def for_tape(self, operations: tuple[FormulaStep, ...]) -> Self:
        """Return the same for another tape, in the same graph."""
        other = copy(self)
        other.operations, other.values = operations, {}
        return other

    def size(self, name: str) -> int:
        """Return the value of ``nq``, ``nv`` or ``m``."""
        return {"nq": self.equations.nq, "nv": self.equations.nv, "m": self.equations.m}[name]

    def section(self, name: str, size: int) -> Nodes:
        """Return a section of ``w``, or of its substitute, as inputs."""
        space, first = self.places.get(name, (name, 0))
        return tuple(self.graph.input(space, first + i) for i in range(size))

    def _on_quantity(self, operation: FormulaStep) -> Nodes:
        e = self.equations
        name = str(operation.payload[0])
        gamma = tuple(r.gamma for r in e.rows)
        quantities = {"q_rates": e.q_rates, "phi": self.phi, "nu": self.nu, "v": self.v, "gamma": gamma}
        return self._forces() if name == "f" else quantities[name]

    def _forces(self) -> Nodes:
        """Return f; where multipliers or drags are unknowns, with drags."""
        g, forces, pressed = self.graph, list(self.equations.forces), self._pressed_forces()
        if self.pushing:
            pressed = ((drag, g.input("drag", i)) for i, drag in enumerate(self.equations.drags))
        for drag, force in pressed:
            for j, node in self.directions[drag.row]:
                forces[j] = g.sub(forces[j], g.mul(force, node))
        return tuple(forces)

    def _pressed_forces(self) -> Iterator[tuple[Drag, int]]:
        """Yield drags by the unknown multipliers, as forces along the coordinates."""
        if self.pressing:
            yield from self.forces_of_drags(self.pressing)

    def forces_of_drags(self, multipliers: Nodes) -> Iterator[tuple[Drag, int]]:
        """Yield drags by multipliers, as forces along the coordinates."""
        g = self.graph
        for drag in self.equations.drags:
            reaction = self.reaction(drag, multipliers)
            size = reaction[0] if drag.signed else length_of_vector(g, reaction)
            yield drag, g.mul(drag.sign, g.mul(drag.coefficient, size))

    def reaction(self, drag: Drag, multipliers: Nodes) -> Nodes:
        """Return the components of a reaction that a drag depends on."""
        g = self.graph
        return tuple(g.sum_of(g.mul(node, multipliers[row]) for row, node in line) for line in drag.pressed)

    def _on_section(self, operation: FormulaStep) -> Nodes:
        return self.section(str(operation.payload[0]), self.size(operation.size))

    def _on_power(self, operation: FormulaStep) -> int:
        g, power = self.graph, self.equations.power
        for drag, force in self._pressed_forces():
            power = g.sub(power, g.mul(force, drag.rate))
        return power

    def _on_driving(self, operation: FormulaStep, accelerations: Nodes) -> int:
        g, driving = self.graph, self.equations.driving
        assert driving is not None, "drivers prescribe coordinates"
        return g.add(g.sum_of(g.mul(node, accelerations[j]) for j, node in driving.entries), driving.rest)

    def _on_zeros(self, operation: FormulaStep) -> Nodes:
        return (self.graph.zero,) * self.size(operation.size)

    def _on_holonomic_or(self, operation: FormulaStep, otherwise: Nodes) -> Nodes:
        rows = zip(self.equations.rows, otherwise, strict=True)
        return tuple(node if row.phi is None else row.phi for row, node in rows)

    def _on_dot(self, operation: FormulaStep, a: Nodes, b: Nodes) -> int:
        return self.graph.dot(a, b)

    def _on_at_velocity(self, operation: FormulaStep, x: Nodes | int, v: Nodes) -> Any:
        return self.with_velocities(x, v) if isinstance(x, tuple) else self.with_velocities((x,), v)[0]

    def with_velocities(self, x: Nodes, v: Nodes) -> Nodes:
        """Return nodes with other velocities in place of the state's."""
        return tuple(self.graph.replace_inputs(x, {("v", i): n for i, n in enumerate(v)}))

    # -- D -------------------------------------------------------------------------------------------------------------

    def _on_constraints(self, operation: FormulaStep) -> Rows:
        return self.rows

    def product(self, matrix: Rows, x: Nodes) -> Nodes:
        """Return a matrix times a vector."""
        g = self.graph
        return tuple(g.sum_of(g.mul(e, x[j]) for j, e in row) for row in matrix)

    def _on_product(self, operation: FormulaStep, matrix: Rows, x: Nodes) -> Nodes:
        return self.product(matrix, x)

    def _on_transposed(self, operation: FormulaStep, matrix: Rows, y: Nodes) -> Nodes:
        return self.product_with_transpose(matrix, y)

    def product_with_transpose(self, matrix: Rows, y: Nodes) -> Nodes:
        """Return the transpose of a matrix times a vector."""
        g = self.graph
        result = [g.zero] * self.equations.nv
        for row, factor in zip(matrix, y, strict=True):
            for j, e in row:
                result[j] = g.add(result[j], g.mul(e, factor))
        return tuple(result)

    def _on_times_transposed(self, operation: FormulaStep, matrix: Rows, other: Rows) -> Rows:
        g, rows = self.graph, []
        for row in matrix:
            own = dict(row)
            entries = ((k, g.sum_of(g.mul(own[j], e) for j, e in right if j in own)) for k, right in enumerate(other))
            rows.append(tuple((k, node) for k, node in entries if node != g.zero))
        return tuple(rows)

    @cached_property
    def jacobian(self) -> tuple[JacobianEntry, ...]:
        """The structural entries of D; variable ones get a slot in the section ``jacobian``."""
        entries: list[JacobianEntry] = []
        slot = 0
        for i, row in enumerate(self.rows):
            for j, node in row:
                constant = self.graph.value(node)
                entries.append(JacobianEntry(i, j, constant, None if constant is not None else slot))
                slot += constant is None
        return tuple(entries)

    def stored_constraints(self) -> Rows:
        """Return D as ``geometry`` left it."""
        g = self.graph
        rows: list[list[tuple[int, int]]] = [[] for _ in range(self.equations.m)]
        for e in self.jacobian:
            node = g.constant(e.constant) if e.constant is not None else g.input("jacobian", e.slot or 0)
            rows[e.row].append((e.column, node))
        return tuple(map(tuple, rows))

    def _on_stored_constraints(self, operation: FormulaStep) -> Rows:
        return self.stored_constraints()

    def _on_constraint_rate_transposed(self, operation: FormulaStep, y: Nodes, v: Nodes) -> Nodes:
        g, rates = self.graph, self.derivatives_along_motion([n for row in self.rows for _, n in row], v)
        result = [g.zero] * self.equations.nv
        for row, factor in zip(self.rows, y, strict=True):
            for j, _ in row:
                result[j] = g.add(result[j], g.mul(next(rates), factor))
        return tuple(result)

    def derivatives_along_motion(self, nodes: Sequence[int], v: Nodes) -> Iterator[int]:
        """Yield the derivatives of nodes that depend on the position along the motion with velocities `v`."""
        g, e = self.graph, self.equations
        rates = self.with_velocities(e.q_rates, v)
        for slopes in jacobian(g, nodes, [("t", 0), *(("q", i) for i in range(e.nq))]):
            yield g.sum_of(n if space == "t" else g.mul(n, rates[i]) for (space, i), n in sorted(slopes.items()))

    def neighbours(self, matrix: Rows, coupled: Sequence[Mapping[int, int]] | None = None) -> list[frozenset[int]]:
        """Return, for each row of D, the other rows with which D W D^T has an entry; `coupled`: rows of W, or None."""
        by_column: dict[int, set[int]] = {}
        for i, row in enumerate(matrix):
            for j, _ in row:
                for k in (j,) if coupled is None else coupled[j]:
                    by_column.setdefault(k, set()).add(i)
        own = [sorted(j for j, _ in row) for row in matrix]
        return [frozenset(n for j in own[i] for n in by_column.get(j, ()) if n != i) for i in range(len(matrix))]

    def gram(self, matrix: Rows, weight: Weight | None = None) -> dict[tuple[int, int], int]:
        """Return D W D^T as nodes; `weight` None is the identity, else rows of W."""
        g = self.graph
        left: list[dict[int, int]] = []
        for row in matrix:
            if weight is None:
                left.append(dict(row))
                continue
            weighted: dict[int, int] = {}
            for j, e in row:
                for k, node in weight[j].items():
                    weighted[k] = g.add(weighted.get(k, g.zero), g.mul(e, node))
            left.append(weighted)

        def entry(i: int, j: int) -> int:
            return g.sum_of(g.mul(left[i][k], e) for k, e in matrix[j] if k in left[i])

        return self.symmetric_matrix(self.neighbours(matrix, weight), entry)

    def symmetric_matrix(
        self, neighbours: Sequence[frozenset[int]], entry: Callable[[int, int], int]
    ) -> dict[tuple[int, int], int]:
        """Return a symmetric matrix of a pattern as nodes, each computed once; off-diagonal zeros vanish."""
        result: dict[tuple[int, int], int] = {}
        for i, near in enumerate(neighbours):
            for j in (i, *(n for n in sorted(near) if n > i)):
                node = entry(i, j)
                if node != self.graph.zero or i == j:
                    result[i, j] = result[j, i] = node
        return result

    # -- kept values ---------------------------------------------------------------------------------------------------

    def _keep_values(self, section: str, x: Iterable[int]) -> Iterator[int]:
        """Note the values that a function writes to a section, and yield them as inputs, literals unchanged."""
        written = self.stored.setdefault(section, [])
        for node in x:
            if self.graph.value(node) is None:
                written.append((OutputSlot(section, len(written)), node))
                node = self.graph.input(section, len(written) - 1)
            yield node

    def _keep_factor(self, factor: FactorNodes, lower: str, reciprocal: str) -> FactorNodes:
        entries = iter(list(self._keep_values(lower, (n for k in factor.order for _, n in factor.lower[k]))))
        columns = {k: tuple((i, next(entries)) for i, _ in factor.lower[k]) for k in factor.order}
        pivots = list(self._keep_values(reciprocal, (factor.reciprocal[k] for k in factor.order)))
        reciprocals = dict(zip(factor.order, pivots, strict=True))
        return FactorNodes(factor.order, columns, reciprocals, factor.pivots, factor.diagonal)

    def _on_keep(self, operation: FormulaStep, x: Nodes) -> Nodes:
        return tuple(self._keep_values(str(operation.payload[0]), x))

    def _on_keep_constraints(self, operation: FormulaStep, matrix: Rows) -> Rows:
        nodes = iter(list(self._keep_values(str(operation.payload[0]), (e for row in matrix for _, e in row))))
        return tuple(tuple((j, next(nodes)) for j, _ in row) for row in matrix)

    def _on_keep_factor(self, operation: FormulaStep, factor: FactorNodes) -> FactorNodes:
        return self._keep_factor(factor, *(str(operation.payload[0]),) * 2)

    def _on_stored_factor(self, operation: FormulaStep, factor: FactorNodes) -> FactorNodes:
        prefix = str(operation.payload[0])
        return self._keep_factor(factor, f"{prefix}lower", f"{prefix}reciprocal")

    def _reciprocal_pivot(self, row: int, pivot: int, diagonal: int) -> int:
        return self.graph.div(self.graph.one, pivot)


def to_status(name: str, node: int) -> tuple[OutputSlot, int]:
    """Return an output to the status at the beginning of ``w``."""
    return OutputSlot("status", STATUS.index(name)), node
