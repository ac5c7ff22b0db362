"""Symmetric elimination on a pattern that is fixed when code is generated.

The order is minimum degree; ties go to the row that waits for the fewest pivots before it (chains of dependent
divisions are the cost of a small factorisation), then to the smaller index: few fill-ins, and reproducible. The
factorisation is emitted for exactly that pattern; structural zeros are not stored.

For generic code the same elimination is laid out as index lists, in time linear in the fill. Pivots that follow each
other with the same rows below (those of one joint, as a rule) form a supernode: their columns of L have one list of
rows.
"""

from __future__ import annotations

import heapq
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

from symgen.base.ir.graph import Graph


def minimum_degree(
    neighbours: Sequence[frozenset[int]], first: frozenset[int] = frozenset()
) -> tuple[tuple[int, ...], list[set[int]]]:
    """Return an elimination order of low fill for a symmetric pattern, and each pivot's rows below it.

    It takes time linear in the fill.

    Parameters
    ----------
    neighbours : sequence of frozenset
        For each row, the other rows with an entry in its column.
    first : frozenset
        Rows that are eliminated before all others.
    """
    graph = [set(n) for n in neighbours]
    level = [0] * len(graph)
    queue = [(i not in first, len(near), 0, i) for i, near in enumerate(graph)]
    heapq.heapify(queue)
    order: list[int] = []
    below: list[set[int]] = []
    done = [False] * len(graph)
    while queue:
        _, degree, waiting, pivot = heapq.heappop(queue)
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
            heapq.heappush(queue, (i not in first, len(near), level[i], i))
    return tuple(order), below


def fill_of_order(neighbours: Sequence[frozenset[int]], order: Sequence[int]) -> int:
    """Return the number of entries of L that a symmetric pattern does not have, for an order of elimination."""
    graph, filled = [set(near) for near in neighbours], 0
    for pivot in order:
        clique = graph[pivot]
        for i in clique:
            filled += len(clique) - 1 - len(clique & graph[i])
            graph[i] |= clique
            graph[i] -= {i, pivot}
    return filled // 2


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
        return self.solve_transposed(graph, self.solve_lower(graph, right))

    def solve_lower(self, graph: Graph, right: Sequence[int]) -> list[int]:
        """Return the nodes of L^-1 x."""
        x = list(right)
        for k in self.order:
            for i, entry in self.lower[k]:
                x[i] = graph.sub(x[i], graph.mul(entry, x[k]))
        return x

    def solve_transposed(self, graph: Graph, half: Sequence[int]) -> list[int]:
        """Return the nodes of L^-T D^-1 x."""
        x = list(half)
        for k in reversed(self.order):
            x[k] = graph.mul(x[k], self.reciprocal[k])
            for i, entry in self.lower[k]:
                x[k] = graph.sub(x[k], graph.mul(entry, x[i]))
        return x


def factorise_symmetric(
    graph: Graph,
    matrix: Mapping[tuple[int, int], int],
    order: Sequence[int],
    reciprocal: Callable[[int, int, int], int],
) -> FactorNodes:
    """Build the factorisation of a symmetric matrix of nodes.

    Parameters
    ----------
    graph : Graph
        Graph of the nodes.
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


@dataclass(frozen=True)
class Supernode:
    """Consecutive pivots: their rows, and the rows below them in the order of elimination."""

    columns: tuple[int, ...]
    below: tuple[int, ...]


def supernodes(neighbours: Sequence[frozenset[int]]) -> tuple[Supernode, ...]:
    """Return the supernodes of an elimination of low fill, in the order of elimination.

    Parameters
    ----------
    neighbours : sequence of frozenset
        For each row, the other rows with an entry in its column.
    """
    order, below = minimum_degree(neighbours)
    place = {row: k for k, row in enumerate(order)}
    nodes: list[Supernode] = []
    columns: list[int] = []
    for k, row in enumerate(order):
        columns.append(row)
        following = order[k + 1] if k + 1 < len(order) else -1
        if following in below[k] and len(below[k]) == len(below[k + 1]) + 1 and len(columns) < LARGEST:
            continue  # by fill the rows below the next pivot are among these
        nodes.append(Supernode(tuple(columns), tuple(sorted(below[k], key=place.__getitem__))))
        columns = []
    return tuple(nodes)


#: Most columns of a supernode: generic code is written out for one and two.
LARGEST = 2


@dataclass(frozen=True)
class Elimination:
    """Index lists of an L D L^T factorisation in panels.

    The panel of a supernode with c columns and r rows below holds its c + r rows one after the other, c entries each.

    Parameters
    ----------
    nodes : tuple of Supernode
        In the order of elimination.
    first : tuple of int
        Beginning of each panel.
    size : int
        Length of all panels.
    largest : int
        Largest c * r: room for a panel's entries before they are divided by pivots.
    """

    nodes: tuple[Supernode, ...]
    first: tuple[int, ...]
    size: int
    largest: int
    place: dict[int, tuple[int, int]]  # row -> (supernode, column in it)
    local: tuple[dict[int, int], ...]  # for each supernode: row -> place in its panel

    @classmethod
    def lay_out(cls, neighbours: Sequence[frozenset[int]]) -> Elimination:
        """Order and lay out a pattern."""
        nodes = supernodes(neighbours)
        first, place, local, size = list[int](), dict[int, tuple[int, int]](), list[dict[int, int]](), 0
        for s, node in enumerate(nodes):
            first.append(size)
            rows = (*node.columns, *node.below)
            size += len(rows) * len(node.columns)
            local.append({row: i for i, row in enumerate(rows)})
            for k, row in enumerate(node.columns):
                place[row] = (s, k)
        largest = max((len(n.columns) * len(n.below) for n in nodes), default=0)
        return cls(nodes, tuple(first), size, largest, place, tuple(local))

    @property
    def rows_alone(self) -> tuple[int, ...]:
        """Rows that are eliminated before all their neighbours, in their order."""
        behind = {row for node in self.nodes for row in (*node.columns[1:], *node.below)}
        return tuple(sorted(self.place.keys() - behind))

    def place_of_entry(self, a: int, b: int) -> int:
        """Return the place of the entry of rows `a` and `b`."""
        (sa, ka), (sb, kb) = self.place[a], self.place[b]
        if (sb, kb) > (sa, ka):
            a, sa, ka, sb, kb = b, sb, kb, sa, ka
        return self.first[sb] + self.local[sb][a] * len(self.nodes[sb].columns) + kb

    def lists_for_code(self) -> list[int]:
        """Return the lists for generic code.

        The number of supernodes and of rows, where each row's diagonal entry is, where each supernode's list begins
        (counted from here), and the lists: number of columns, number of rows below, where the panel begins, the rows of
        the columns, the rows below, then for each pair of rows below, the second not after the first, where its update
        goes.
        """
        lists: list[list[int]] = []
        for node, first in zip(self.nodes, self.first, strict=True):
            below = node.below
            each = [len(node.columns), len(below), first, *node.columns, *below]
            for i, a in enumerate(below):
                each += [self.place_of_entry(a, b) for b in below[: i + 1]]
            lists.append(each)
        size = len(self.place)
        table = [len(self.nodes), size, *(self.place_of_entry(i, i) for i in range(size))]
        start = len(table) + len(lists)
        for each in lists:
            table.append(start)
            start += len(each)
        for each in lists:
            table += each
        return table
