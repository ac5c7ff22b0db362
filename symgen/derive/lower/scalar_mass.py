"""The mass matrix M of one mechanism: block diagonal, or, where joints of a tree carry the bodies, changing with q."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from copy import copy
from dataclasses import replace
from functools import cached_property
from typing import Self

from symgen.base.ir.graph import PARAMETER, Graph
from symgen.derive.formulate.equations import MassBlock
from symgen.derive.lower.factor import FactorNodes, factorise_symmetric, minimum_degree
from symgen.derive.lower.replay import Nodes
from symgen.derive.lower.scalar_values import NodeValues, Rows
from symgen.derive.methods._tape import FormulaStep


class OfMass(NodeValues):
    """Operations with M, its inverse and its root, and the diagonal matrix for rank decisions."""

    @cached_property
    def mass_entries(self) -> tuple[int, ...]:
        """Entries of M that change with the position, each once; empty where bodies have their own coordinates."""
        g = self.graph
        nodes = (n for block in self.equations.mass for row in block.entries for n in row)
        return tuple(dict.fromkeys(n for n in nodes if g.depends[n] & ~PARAMETER))

    @cached_property
    def with_stored_mass(self) -> Self:
        """The same tape with M from the section ``mass_entry``, for functions without the state.

        M is replaced before it is used: products with it do not keep its entries together.
        """
        other = self._with_mass(_mass_from_section(self.equations.mass, self.mass_entries, self.graph, "mass_entry"))
        other.values, other.stored, other.flags = {}, {}, []
        other.evaluate_remaining(sorted(self.values))
        return other

    @cached_property
    def body(self) -> Self:
        """The same tape with the metric of carried bodies in the place of M."""
        return self._with_mass(self.equations.metric)

    def _with_mass(self, mass: tuple[MassBlock, ...]) -> Self:
        """Return the same tape with another matrix in the place of M, nothing evaluated yet."""
        other = copy(self)
        held = "mass_entries", "mass_matrix", "mass_factor", "row_halves", "coupled", "inverse_mass", "gauge", "saddle"
        for name in held:
            other.__dict__.pop(name, None)
        other.equations = replace(self.equations, mass=mass)
        return other

    def _on_body_entries(self, operation: FormulaStep) -> Nodes:
        return self.body.mass_entries

    def _on_body_inverse(self, operation: FormulaStep, x: Nodes) -> Nodes:
        body = self.body
        stored = body._with_mass(_mass_from_section(body.equations.mass, body.mass_entries, self.graph, "body_entry"))
        return tuple(stored.mass_factor.solve(self.graph, x))

    @cached_property
    def mass_matrix(self) -> dict[tuple[int, int], int]:
        """The entries of M that are not structurally zero."""
        blocks = (_structural_entries(self.graph, block, block.columns) for block in self.equations.mass)
        return {place: node for entries in blocks for place, node in entries.items()}

    @cached_property
    def mass_factor(self) -> FactorNodes:
        """The factor of an M that changes, from the leaves of the tree inwards, without fill."""
        return self.factorise_matrix(self.mass_matrix)

    def factorise_matrix(self, matrix: Mapping[tuple[int, int], int]) -> FactorNodes:
        """Return the factor of a matrix of the velocities, in an elimination order of low fill."""
        near: list[set[int]] = [set() for _ in range(self.equations.nv)]
        for i, j in matrix:
            if i != j:
                near[i].add(j)
        order, _ = minimum_degree([frozenset(n) for n in near])
        return factorise_symmetric(self.graph, matrix, order, self._reciprocal_pivot)

    @cached_property
    def coupled(self) -> Sequence[Mapping[int, int]]:
        """For each velocity, those that M^-1 couples it with."""
        if not self.mass_entries:
            return self.inverse_mass
        coupled: list[Mapping[int, int]] = [{} for _ in range(self.equations.nv)]
        for block in self.equations.mass:
            for j in block.columns:
                coupled[j] = dict.fromkeys(block.columns, 0)
        return coupled

    @cached_property
    def row_halves(self) -> tuple[list[list[int]], list[list[int]]]:
        """L^-1 D^T by the rows of D, and d^-1 L^-1 D^T."""
        return self._half_solve_rows(self.rows)

    def _half_solve_rows(self, matrix: Rows) -> tuple[list[list[int]], list[list[int]]]:
        """Return the same as `row_halves` for some of the rows."""
        g, halves = self.graph, list[list[int]]()
        for row in matrix:
            x = [g.zero] * self.equations.nv
            for j, node in row:
                x[j] = node
            halves.append(self.mass_factor.solve_lower(g, x))
        reciprocal = self.mass_factor.reciprocal
        return halves, [[g.mul(reciprocal[k], x) for k, x in enumerate(half)] for half in halves]

    def _half_solve(self, index: int) -> list[int]:
        """Return L^-1 of a value of the tape; of sums and of D^T y from their parts."""
        g, operation = self.graph, self.operations[index]
        parts = operation.operands
        if operation.kind in ("add", "sub") and operation.size == "nv":
            return [getattr(g, operation.kind)(a, b) for a, b in zip(*map(self._half_solve, parts), strict=True)]
        if operation.kind == "transposed" and self.values[parts[0]] is self.rows:
            y, (halves, _) = self.values[parts[1]], self.row_halves
            return [g.dot([half[k] for half in halves], y) for k in range(self.equations.nv)]
        return self.mass_factor.solve_lower(g, self.values[index])

    def mass_gram(self, matrix: Rows) -> dict[tuple[int, int], int]:
        """Return D M^-1 D^T as nodes."""
        if not self.mass_entries:
            return self.gram(matrix, self.inverse_mass)
        g, (halves, scaled) = self.graph, self.row_halves if matrix is self.rows else self._half_solve_rows(matrix)
        near = self.neighbours(matrix, self.coupled)
        return self.symmetric_matrix(near, lambda i, j: g.dot(scaled[i], halves[j]))

    @cached_property
    def inverse_mass(self) -> list[dict[int, int]]:
        """Rows of M^-1 as column -> node; blocks are inverted by elimination, single entries by their reciprocal."""
        g = self.graph
        result: list[dict[int, int]] = [{} for _ in range(self.equations.nv)]
        for block in self.equations.mass:
            n, matrix = len(block.columns), _structural_entries(g, block, range(len(block.columns)))
            factor = factorise_symmetric(g, matrix, range(n), self._reciprocal_pivot)
            for j in range(n):
                unit = [g.one if i == j else g.zero for i in range(n)]
                for i, node in enumerate(factor.solve(g, unit)):
                    if node != g.zero:
                        result[block.columns[i]][block.columns[j]] = node
        return result

    def _on_minv(self, operation: FormulaStep, x: Nodes) -> Nodes:
        if self.mass_entries:
            return tuple(self.mass_factor.solve_transposed(self.graph, self._half_solve(operation.operands[0])))
        return self._solve_by_blocks(x)

    def _solve_by_blocks(self, x: Nodes) -> Nodes:
        """Return M^-1 x of a constant M."""
        g = self.graph
        result = [g.zero] * len(x)
        for block in self.equations.mass:
            if len(block.columns) == 1:
                j, mass = block.columns[0], block.entries[0][0]
                # two literals are divided while code is generated, so that a weight over its mass is g to the last
                # digit
                literal = g.value(x[j]) is not None and g.value(mass) is not None
                result[j] = g.div(x[j], mass) if literal else g.mul(self.inverse_mass[j][j], x[j])
                continue
            for i in block.columns:
                result[i] = g.sum_of(g.mul(e, x[j]) for j, e in sorted(self.inverse_mass[i].items()))
        return tuple(result)

    def solve_by_factor(self, f: Nodes, gamma: Nodes, factor: FactorNodes) -> tuple[Nodes, Nodes]:
        """Return v' and lambda with ``M v' + D^T lambda = f``, ``D v' = gamma`` by the factor of D M^-1 D^T."""
        g = self.graph
        if not self.mass_entries:
            changes = self.product(self.rows, self._solve_by_blocks(f))
            multipliers = tuple(factor.solve(g, [g.sub(x, y) for x, y in zip(changes, gamma, strict=True)]))
            rest = zip(f, self.product_with_transpose(self.rows, multipliers), strict=True)
            return self._solve_by_blocks(tuple(g.sub(x, y) for x, y in rest)), multipliers
        (halves, scaled), half = self.row_halves, self.mass_factor.solve_lower(g, f)
        changes = tuple(g.dot(row, half) for row in scaled)
        multipliers = tuple(factor.solve(g, [g.sub(x, y) for x, y in zip(changes, gamma, strict=True)]))
        left = [g.sub(x, g.dot([row[k] for row in halves], multipliers)) for k, x in enumerate(half)]
        return tuple(self.mass_factor.solve_transposed(g, left)), multipliers

    def _on_product(self, operation: FormulaStep, matrix: Rows, x: Nodes) -> Nodes:
        solved = self.operations[operation.operands[1]]
        if self.mass_entries and matrix is self.rows and solved.kind == "minv":  # D M^-1 u from the parts of S
            half = self._half_solve(solved.operands[0])
            return tuple(self.graph.dot(scaled, half) for scaled in self.row_halves[1])
        return super()._on_product(operation, matrix, x)

    def _on_mass(self, operation: FormulaStep, x: Nodes) -> Nodes:
        return self.mass_times(x)

    def mass_times(self, x: Nodes) -> Nodes:
        """Return M times a vector."""
        g = self.graph
        result = [g.zero] * len(x)
        for block in self.equations.mass:
            for i, row in zip(block.columns, block.entries, strict=True):
                result[i] = g.sum_of(g.mul(e, x[j]) for j, e in zip(block.columns, row, strict=True))
        return tuple(result)

    def _on_mass_rate(self, operation: FormulaStep, x: Nodes, v: Nodes) -> Nodes:
        g, result = self.graph, [self.graph.zero] * self.equations.nv
        if self.mass_entries:
            changes = dict(zip(self.mass_entries, self.derivatives_along_motion(self.mass_entries, v), strict=True))
            for (i, j), node in sorted(self.mass_matrix.items()):
                if node in changes:
                    result[i] = g.add(result[i], g.mul(changes[node], x[j]))
        return tuple(result)

    def _on_free_acceleration(self, operation: FormulaStep, f: Nodes) -> Nodes:
        regular = all(self.graph.value(node) != 0.0 for node in self._diagonal)
        return self._on_minv(operation, f) if regular else (self.graph.zero,) * len(f)

    def _on_gauged(self, operation: FormulaStep, x: Nodes) -> Nodes:
        return tuple(self.graph.mul(next(iter(self.gauge[j].values())), n) for j, n in enumerate(x))

    @cached_property
    def gauge(self) -> list[dict[int, int]]:
        """Rows of the diagonal matrix for rank decisions: 1 for translations, 1 / l^2 for rotations."""
        units = (v.unit for v in self.equations.velocities)
        return [{j: self.graph.input("gauge", j) if u == "rad/s" else self.graph.one} for j, u in enumerate(units)]

    @property
    def _diagonal(self) -> list[int]:
        return [b.entries[i][i] for b in self.equations.mass for i in range(len(b.columns))]

    def _on_inverse_mass_root(self, operation: FormulaStep) -> Rows:
        """Return L^-T with M = L L^T by rows of the transposed, L^-1; Cholesky's root is the cheapest."""
        rows: list[tuple[tuple[int, int], ...]] = [()] * self.equations.nv
        for block in self.equations.mass:
            for i, entries in zip(block.columns, self._inverse_cholesky(block), strict=True):
                rows[i] = tuple((block.columns[j], n) for j, n in enumerate(entries) if n != self.graph.zero)
        return tuple(rows)

    def _inverse_cholesky(self, block: MassBlock) -> Iterator[list[int]]:
        g, n = self.graph, len(block.columns)
        lower: dict[tuple[int, int], int] = {}
        inverse: dict[tuple[int, int], int] = {}
        for i in range(n):
            for j in range(i + 1):
                rest = g.sub(block.entries[i][j], g.sum_of(g.mul(lower[i, k], lower[j, k]) for k in range(j)))
                lower[i, j] = g.call("sqrt", rest) if i == j else g.div(rest, lower[j, j])
        for i in range(n):
            inverse[i, i] = g.div(g.one, lower[i, i])
            for j in range(i):
                rest = g.sum_of(g.mul(lower[i, k], inverse[k, j]) for k in range(j, i))
                inverse[i, j] = g.neg(g.mul(rest, inverse[i, i]))
            yield [inverse[i, j] for j in range(i + 1)]


def _structural_entries(g: Graph, block: MassBlock, places: Sequence[int]) -> dict[tuple[int, int], int]:
    """Return the entries of a block that are not structurally zero, by the `places` of its rows and columns."""
    return {
        (i, j): node
        for i, row in zip(places, block.entries, strict=True)
        for j, node in zip(places, row, strict=True)
        if node != g.zero or i == j
    }


def _mass_from_section(
    mass: tuple[MassBlock, ...], entries: Nodes, graph: Graph, section: str
) -> tuple[MassBlock, ...]:
    """Return a matrix with its entries from a section."""
    places = {node: graph.input(section, k) for k, node in enumerate(entries)}
    return tuple(MassBlock(b.columns, tuple(tuple(places.get(n, n) for n in row) for row in b.entries)) for b in mass)
