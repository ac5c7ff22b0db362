"""What a measure is in a model's graph: value, row and quadratic velocity term."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from symgen.base.ir.graph import Graph


@dataclass(frozen=True)
class DerivedMeasure:
    """A measure in the model: value, row (velocity index -> node) and quadratic velocity term b of s'' = J v' + b.

    `drift` is s' - J v: 0 except for a formula of t.
    """

    value: int
    row: Mapping[int, int]
    bias: int
    drift: int = Graph.ZERO

    def velocity_part(self, graph: Graph, velocities: tuple[int, ...]) -> int:
        """Return the node of J v, the part of s' that velocities make."""
        return graph.sum_of(graph.mul(node, velocities[i]) for i, node in sorted(self.row.items()))

    def rate(self, graph: Graph, velocities: tuple[int, ...]) -> int:
        """Return the node of s' = J v + drift."""
        return graph.add(self.velocity_part(graph, velocities), self.drift)
