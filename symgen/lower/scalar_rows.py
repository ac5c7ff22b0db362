"""The constraint matrix D of one mechanism, row by row: products with it, and D W D^T."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from functools import cached_property

from symgen.ir.derivative import jacobian
from symgen.ir.program import Entry
from symgen.lower.replay import Nodes
from symgen.lower.scalar_values import Rows, Values, Weight
from symgen.methods._formula import Operation


class OfRows(Values):
    """Operations with D."""

    def _on_constraints(self, operation: Operation) -> Rows:
        return self.rows

    def product(self, matrix: Rows, x: Nodes) -> Nodes:
        """Return a matrix times a vector."""
        g = self.graph
        return tuple(g.total(g.mul(e, x[j]) for j, e in row) for row in matrix)

    def _on_product(self, operation: Operation, matrix: Rows, x: Nodes) -> Nodes:
        return self.product(matrix, x)

    def _on_transposed(self, operation: Operation, matrix: Rows, y: Nodes) -> Nodes:
        g = self.graph
        result = [g.zero] * self.equations.nv
        for row, factor in zip(matrix, y, strict=True):
            for j, e in row:
                result[j] = g.add(result[j], g.mul(e, factor))
        return tuple(result)

    def _on_times_transposed(self, operation: Operation, matrix: Rows, other: Rows) -> Rows:
        g, rows = self.graph, []
        for row in matrix:
            own = dict(row)
            entries = ((k, g.total(g.mul(own[j], e) for j, e in right if j in own)) for k, right in enumerate(other))
            rows.append(tuple((k, node) for k, node in entries if node != g.zero))
        return tuple(rows)

    @cached_property
    def jacobian(self) -> tuple[Entry, ...]:
        """The structural entries of D; variable ones get a slot in the section ``jacobian``."""
        entries: list[Entry] = []
        slot = 0
        for i, row in enumerate(self.rows):
            for j, node in row:
                constant = self.graph.value(node)
                entries.append(Entry(i, j, constant, None if constant is not None else slot))
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

    def _on_stored_constraints(self, operation: Operation) -> Rows:
        return self.stored_constraints()

    def _on_constraint_rate_transposed(self, operation: Operation, y: Nodes, v: Nodes) -> Nodes:
        g, e = self.graph, self.equations
        flat = [n for row in self.rows for _, n in row]
        rates = self._on_at_velocity(operation, e.q_rates, v)
        derivatives = iter(jacobian(g, flat, [("t", 0), *(("q", i) for i in range(e.nq))]))
        result = [g.zero] * e.nv
        for row, factor in zip(self.rows, y, strict=True):
            for j, _ in row:
                rate = g.total(
                    node if space == "t" else g.mul(node, rates[i])
                    for (space, i), node in sorted(next(derivatives).items())
                )
                result[j] = g.add(result[j], g.mul(rate, factor))
        return tuple(result)

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
            return g.total(g.mul(left[i][k], e) for k, e in matrix[j] if k in left[i])

        return self.symmetric(self.neighbours(matrix, weight), entry)

    def symmetric(
        self, neighbours: Sequence[frozenset[int]], entry: Callable[[int, int], int]
    ) -> dict[tuple[int, int], int]:
        """Return a symmetric matrix of a pattern as nodes, each worked out once; zeros beside its diagonal vanish."""
        result: dict[tuple[int, int], int] = {}
        for i, near in enumerate(neighbours):
            for j in (i, *(n for n in sorted(near) if n > i)):
                node = entry(i, j)
                if node != self.graph.zero or i == j:
                    result[i, j] = result[j, i] = node
        return result
