"""Modes that states of a file say: rows of joints that hold for a while are in force where their states say so.

Functions of the state compute the mode of a row, ``geometry`` writes it to the modes, and functions without the state
read it there.
"""

from __future__ import annotations

from collections.abc import Sequence

from symgen.base.ir.graph import Graph
from symgen.base.ir.program import MODE_NUMBERS, OutputSlot
from symgen.derive.formulate.equations import Equations
from symgen.derive.lower.scalar_values import Outputs


def modes_of_states(equations: Equations) -> Outputs:
    """Return the modes that states of the file say: 1 where a row is in force, and what it holds beyond its value."""
    rows = [row for row in equations.rows if row.held is not None]
    return [
        (OutputSlot("modes", MODE_NUMBERS * k + i), node)
        for k, row in enumerate(rows)
        if row.held is not None and row.place is not None
        for i, node in enumerate((row.held, row.place))
    ]


def nodes_with_stored_modes(equations: Equations, g: Graph, nodes: Sequence[int]) -> list[int]:
    """Return nodes of a graph in which modes are read where ``geometry`` has written them."""
    stored = {node: g.input(slot.space, slot.index) for slot, node in modes_of_states(equations)}
    held = {node: stored[node] for row in equations.rows if row.place is not None and (node := row.held) in stored}
    return g.rebuild_from(g, nodes, lambda node: held.get(node, node), lambda node: node in held) if held else [*nodes]
