"""Ways along the elements of a body, from interface to interface or from end to end."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray
from scipy import sparse
from scipy.sparse.csgraph import dijkstra

from symgen.describe.reduction.finite_elements import FiniteElements, Sparse

Numbers = NDArray[np.int64]


def middles_of(x: NDArray[np.float64], sets: Mapping[str, Numbers]) -> list[int]:
    """Return the node of each interface that is nearest to its middle."""
    return [int(s[np.argmin(np.linalg.norm(x[s] - x[s].mean(axis=0), axis=1))]) for s in sets.values()]


def graph_of(elements: FiniteElements) -> Sparse:
    """Return the distances of nodes that an element joins."""
    x, u = elements.x, elements.unknowns
    coupled = abs(elements.stiffness[::u, ::u]).tocoo()
    apart = coupled.row != coupled.col
    row, col = coupled.row[apart], coupled.col[apart]
    return sparse.csr_array((np.linalg.norm(x[row] - x[col], axis=1), (row, col)), shape=(len(x), len(x)))


def shortest_ways(elements: FiniteElements, start: int, ends: list[int]) -> list[Numbers]:
    """Return the nodes of the shortest way from one node to each of others, or to the farthest where none is named."""
    reach, before = (numbers[0] for numbers in dijkstra(graph_of(elements), True, [start], True))
    lines = list[Numbers]()
    for end in ends or [int(np.argmax(np.where(np.isfinite(reach), reach, -1.0)))]:
        line = [end]
        while line[-1] != start and before[line[-1]] >= 0:
            line.append(int(before[line[-1]]))
        if len(line) > 1:
            lines.append(np.array(line[::-1], dtype=np.int64))
    return lines
