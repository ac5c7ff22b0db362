"""Vectors, scalars and the constraint matrix as nodes of a graph, with the arithmetic that formulas are written in."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import overload

from symgen.ir.graph import Graph


@dataclass(frozen=True)
class Vector:
    """A vector of nodes with elementwise arithmetic."""

    graph: Graph
    nodes: tuple[int, ...]

    @property
    def size(self) -> int:
        """Number of elements; formulas name sizes by it, since whole vectors have theirs at run time only."""
        return len(self.nodes)

    def __add__(self, other: Vector) -> Vector:
        g = self.graph
        return Vector(g, tuple(g.add(a, b) for a, b in zip(self.nodes, other.nodes, strict=True)))

    def __sub__(self, other: Vector) -> Vector:
        g = self.graph
        return Vector(g, tuple(g.sub(a, b) for a, b in zip(self.nodes, other.nodes, strict=True)))

    def times(self, other: Vector) -> Vector:
        """Return the elementwise product."""
        g = self.graph
        return Vector(g, tuple(g.mul(a, b) for a, b in zip(self.nodes, other.nodes, strict=True)))

    def dot(self, other: Vector) -> Scalar:
        """Return the inner product."""
        return Scalar(self.graph, self.graph.dot(self.nodes, other.nodes))

    def __iter__(self) -> Iterator[int]:
        return iter(self.nodes)


@dataclass(frozen=True)
class Scalar:
    """A scalar node with arithmetic, so that a method's formula reads like the textbook's."""

    graph: Graph
    node: int

    def __add__(self, other: Scalar) -> Scalar:
        return Scalar(self.graph, self.graph.add(self.node, other.node))

    def __sub__(self, other: Scalar) -> Scalar:
        return Scalar(self.graph, self.graph.sub(self.node, other.node))

    @overload
    def __mul__(self, other: Scalar) -> Scalar: ...
    @overload
    def __mul__(self, other: Vector) -> Vector: ...
    def __mul__(self, other: Scalar | Vector) -> Scalar | Vector:
        g = self.graph
        if isinstance(other, Vector):
            return Vector(g, tuple(g.mul(self.node, a) for a in other.nodes))
        return Scalar(g, g.mul(self.node, other.node))

    def __rmul__(self, factor: float) -> Scalar:
        return Scalar(self.graph, self.graph.mul(self.graph.constant(factor), self.node))

    def smaller(self, other: Scalar) -> Scalar:
        """Return the smaller of two scalars."""
        return Scalar(self.graph, self.graph.call("min", self.node, other.node))

    def __pow__(self, exponent: int) -> Scalar:
        return Scalar(self.graph, self.graph.power(self.node, self.graph.constant(float(exponent))))


@dataclass(frozen=True)
class Sparse:
    """The constraint matrix D: for each row its (column, node) entries in increasing order of column."""

    graph: Graph
    rows: tuple[tuple[tuple[int, int], ...], ...]
    columns: int

    def __matmul__(self, x: Vector) -> Vector:
        g = self.graph
        return Vector(g, tuple(g.total(g.mul(e, x.nodes[j]) for j, e in row) for row in self.rows))

    def times_transposed(self, other: Sparse) -> Sparse:
        """Return this matrix times the transposed of another one."""
        g = self.graph
        rows = []
        for row in self.rows:
            own = dict(row)
            entries = (
                (k, g.total(g.mul(own[j], e) for j, e in right if j in own)) for k, right in enumerate(other.rows)
            )
            rows.append(tuple((k, node) for k, node in entries if node != g.zero))
        return Sparse(g, tuple(rows), len(other.rows))

    def transposed(self, y: Vector) -> Vector:
        """Return D^T y."""
        g = self.graph
        result = [g.zero] * self.columns
        for row, factor in zip(self.rows, y.nodes, strict=True):
            for j, e in row:
                result[j] = g.add(result[j], g.mul(e, factor))
        return Vector(g, tuple(result))

    def neighbours(self, coupled: Sequence[frozenset[int]] | None = None) -> list[frozenset[int]]:
        """Return, for each row, the other rows with which D W D^T has an entry.

        `coupled` gives for each column those that W couples it with; None: W is diagonal.
        """
        by_column: dict[int, set[int]] = {}
        for i, row in enumerate(self.rows):
            for j, _ in row:
                for k in (j,) if coupled is None else coupled[j]:
                    by_column.setdefault(k, set()).add(i)
        own = [{j for j, _ in row} for row in self.rows]
        return [
            frozenset(n for j in sorted(own[i]) for n in by_column.get(j, ()) if n != i) for i in range(len(self.rows))
        ]
