"""Elimination on a pattern: order, supernodes and index lists for generic code, in time linear in the fill.

The order is that of `symgen.lower.factor`: both shapes eliminate alike and decide rank alike. Pivots that follow each
other with the same rows below (those of one joint, as a rule) form a supernode: their columns of L have one list of
rows.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from symgen.lower.factor import minimum_degree


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
        For each row, the other rows it has an entry with.
    """
    order, below = minimum_degree(neighbours)
    place = {row: k for k, row in enumerate(order)}
    found: list[Supernode] = []
    columns: list[int] = []
    for k, row in enumerate(order):
        columns.append(row)
        following = order[k + 1] if k + 1 < len(order) else -1
        if following in below[k] and len(below[k]) == len(below[k + 1]) + 1 and len(columns) < LARGEST:
            continue  # the rows below the next pivot are among these: fill has seen to that
        found.append(Supernode(tuple(columns), tuple(sorted(below[k], key=place.__getitem__))))
        columns = []
    return tuple(found)


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
        Where each panel begins.
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
    def of(cls, neighbours: Sequence[frozenset[int]]) -> Elimination:
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
    def alone(self) -> tuple[int, ...]:
        """Rows that are eliminated before all that have to do with them, in their order."""
        behind = {row for node in self.nodes for row in (*node.columns[1:], *node.below)}
        return tuple(sorted(self.place.keys() - behind))

    def target(self, a: int, b: int) -> int:
        """Return where the entry of rows `a` and `b` stands."""
        (sa, ka), (sb, kb) = self.place[a], self.place[b]
        if (sb, kb) > (sa, ka):
            a, sa, ka, sb, kb = b, sb, kb, sa, ka
        return self.first[sb] + self.local[sb][a] * len(self.nodes[sb].columns) + kb

    def table(self) -> list[int]:
        """Return the lists that generic code reads.

        The number of supernodes and of rows, where each row's diagonal entry stands, where each supernode's list begins
        (counted from here), and the lists: number of columns, number of rows below, where the panel begins, the rows of
        the columns, the rows below, then for each pair of rows below, the second not after the first, where its update
        goes.
        """
        lists: list[list[int]] = []
        for node, first in zip(self.nodes, self.first, strict=True):
            below = node.below
            each = [len(node.columns), len(below), first, *node.columns, *below]
            for i, a in enumerate(below):
                each += [self.target(a, b) for b in below[: i + 1]]
            lists.append(each)
        size = len(self.place)
        table = [len(self.nodes), size, *(self.target(i, i) for i in range(size))]
        start = len(table) + len(lists)
        for each in lists:
            table.append(start)
            start += len(each)
        for each in lists:
            table += each
        return table
