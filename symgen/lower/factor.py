"""Symmetric elimination on a pattern that is known while code is generated.

The order is minimum degree; ties go to the row that waits for the fewest pivots before it (chains of dependent
divisions are what a small factorisation costs), then to the smaller index: few fill-ins, and the same for ever. The
factorisation is emitted for exactly that pattern; nothing is stored that is structurally zero.
"""

from __future__ import annotations

import heapq
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

from symgen.ir.graph import Graph


def minimum_degree(neighbours: Sequence[frozenset[int]]) -> tuple[tuple[int, ...], list[set[int]]]:
    """Return an elimination order of low fill for a symmetric pattern, and each pivot's rows below it.

    It takes time linear in the fill.

    Parameters
    ----------
    neighbours : sequence of frozenset
        For each row, the other rows it has an entry with.
    """
    graph = [set(n) for n in neighbours]
    level = [0] * len(graph)
    queue = [(len(near), 0, i) for i, near in enumerate(graph)]
    heapq.heapify(queue)
    order: list[int] = []
    below: list[set[int]] = []
    done = [False] * len(graph)
    while queue:
        degree, waiting, pivot = heapq.heappop(queue)
        if done[pivot] or degree != len(graph[pivot]) or waiting != level[pivot]:
            continue  # the entry is out of date
        done[pivot] = True
        clique = graph[pivot]
        order.append(pivot)
        below.append(clique)
        for i in sorted(clique):
            near = graph[i]
            near |= clique
            near.discard(i)
            near.discard(pivot)
            level[i] = max(level[i], level[pivot] + 1)
            heapq.heappush(queue, (len(near), level[i], i))
    return tuple(order), below


@dataclass(frozen=True)
class FactorNodes:
    """L and the reciprocal pivots of an L D L^T factorisation, as nodes.

    `lower[k]` lists (row, node) of column k of L below the diagonal, in the order of elimination.
    """

    order: tuple[int, ...]
    lower: Mapping[int, tuple[tuple[int, int], ...]]
    reciprocal: Mapping[int, int]
    pivots: Mapping[int, int]
    diagonal: Mapping[int, int]

    def solve(self, graph: Graph, right: Sequence[int]) -> list[int]:
        """Return the nodes of the solution for a right-hand side."""
        return self.back(graph, self.forward(graph, right))

    def forward(self, graph: Graph, right: Sequence[int]) -> list[int]:
        """Return the nodes of L^-1 x."""
        x = list(right)
        for k in self.order:
            for i, entry in self.lower[k]:
                x[i] = graph.sub(x[i], graph.mul(entry, x[k]))
        return x

    def back(self, graph: Graph, half: Sequence[int]) -> list[int]:
        """Return the nodes of L^-T D^-1 x."""
        x = list(half)
        for k in reversed(self.order):
            x[k] = graph.mul(x[k], self.reciprocal[k])
            for i, entry in self.lower[k]:
                x[k] = graph.sub(x[k], graph.mul(entry, x[i]))
        return x


def factorise(
    graph: Graph,
    matrix: Mapping[tuple[int, int], int],
    order: Sequence[int],
    reciprocal: Callable[[int, int, int], int],
) -> FactorNodes:
    """Build the factorisation of a symmetric matrix of nodes.

    Parameters
    ----------
    graph : Graph
        Where the nodes live.
    matrix : mapping of (row, column) to node
        Both triangles; structurally zero entries absent.
    order : sequence of int
        Elimination order.
    reciprocal : callable
        ``reciprocal(row, pivot, diagonal)`` returns the node used for 1 / pivot: 0 for a row to be skipped.
    """
    work = dict(matrix)
    columns: dict[int, set[int]] = {i: set() for i in order}
    for i, j in matrix:
        if i != j:
            columns[i].add(j)
    done: set[int] = set()
    lower: dict[int, tuple[tuple[int, int], ...]] = {}
    pivots: dict[int, int] = {}
    reciprocals: dict[int, int] = {}
    rank_of = {row: position for position, row in enumerate(order)}
    for k in order:
        pivots[k] = work[k, k]
        reciprocals[k] = reciprocal(k, pivots[k], matrix[k, k])
        done.add(k)
        below = sorted((i for i in columns[k] if i not in done), key=rank_of.__getitem__)
        factors = [graph.mul(work[i, k], reciprocals[k]) for i in below]
        for a, i in enumerate(below):
            for j in below[a:]:
                update = graph.mul(factors[a], work[j, k])
                work[i, j] = graph.sub(work.get((i, j), graph.zero), update)
                work[j, i] = work[i, j]
                columns[i].add(j)
                columns[j].add(i)
        lower[k] = tuple(zip(below, factors, strict=True))
    return FactorNodes(tuple(order), lower, reciprocals, pivots, {k: matrix[k, k] for k in order})
