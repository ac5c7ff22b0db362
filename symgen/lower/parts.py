"""Parts that the programs of models and laws share: what is stored between blocks, geometry, corrections."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from symgen.formulate.equations import Equations
from symgen.ir.graph import Graph
from symgen.ir.program import STATUS, Block, Entry, Target
from symgen.lower.algebra import SKIP, System
from symgen.lower.factor import Factor
from symgen.lower.hoist import Hoister
from symgen.lower.vectors import Vector

Outputs = list[tuple[Target, int]]


class Stored:
    """The variable entries of a factor, kept in ``w`` between the block that factorises and those that solve."""

    def __init__(self, graph: Graph, factor: Factor) -> None:
        self.graph, self.factor = graph, factor
        self.lower = [(k, i, n) for k in factor.order for i, n in factor.lower[k] if graph.value(n) is None]
        self.reciprocal = [(k, factor.reciprocal[k]) for k in factor.order if graph.value(factor.reciprocal[k]) is None]

    def outputs(self, lower: str, reciprocal: str) -> Outputs:
        """Return what the factorising block writes."""
        return [(Target(lower, i), n) for i, (_, _, n) in enumerate(self.lower)] + [
            (Target(reciprocal, i), n) for i, (_, n) in enumerate(self.reciprocal)
        ]

    def loaded(self, lower: str, reciprocal: str) -> Factor:
        """Return the factor as the solving block reads it."""
        g, f = self.graph, self.factor
        slots = {(k, i): g.input(lower, s) for s, (k, i, _) in enumerate(self.lower)}
        columns = {k: tuple((i, slots.get((k, i), n)) for i, n in f.lower[k]) for k in f.order}
        reciprocals = dict(f.reciprocal) | {k: g.input(reciprocal, s) for s, (k, _) in enumerate(self.reciprocal)}
        return Factor(f.order, columns, reciprocals, f.pivots, f.diagonal)


def constraint_entries(g: Graph, equations: Equations) -> tuple[Entry, ...]:
    """Return the structural entries of D; variable ones get a slot in the section ``jacobian``."""
    entries: list[Entry] = []
    slot = 0
    for i, row in enumerate(equations.rows):
        for j, node in row.entries:
            constant = g.value(node)
            entries.append(Entry(i, j, constant, None if constant is not None else slot))
            slot += constant is None
    return tuple(entries)


def geometry_outputs(system: System, jacobian: Sequence[Entry]) -> Outputs:
    """Return what every ``geometry`` writes: Phi as the residual, its norm, nu and the variable entries of D."""
    g, rows = system.graph, system.equations.rows
    outputs: Outputs = [(Target("residual", i), n) for i, n in enumerate(system.phi)]
    outputs.append(to_status("position_violation", g.call("sqrt", system.phi.dot(system.phi).node)))
    outputs += [(Target("nu", i), r.nu) for i, r in enumerate(rows) if r.nu != g.zero]
    entries = [node for row in rows for _, node in row.entries]
    outputs += [(Target("jacobian", e.slot), n) for e, n in zip(jacobian, entries, strict=True) if e.slot is not None]
    return outputs


def pivot_outputs(system: System, factor: Factor) -> Outputs:
    """Return relative pivots, the rank they decide, and the smallest of rows that are not masked.

    A relative pivot is the squared sine of the angle between a row and those eliminated before it.
    """
    g = system.graph
    outputs: Outputs = []
    rank, smallest = g.zero, g.one
    for i in range(len(factor.order)):
        if factor.pivots[i] == factor.diagonal[i]:
            rank = g.add(rank, g.one)
            continue
        relative = g.div(factor.pivots[i], factor.diagonal[i])
        outputs.append((Target("pivot", i), relative))
        least = g.add(g.mul(g.constant(SKIP), factor.diagonal[i]), system.mask[i])
        rank = g.add(rank, g.call("step", factor.pivots[i], least))
        smallest = g.call("min", smallest, g.add(relative, system.mask[i]))
    return [*outputs, to_status("rank", rank), to_status("smallest_pivot", smallest)]


def to_status(name: str, node: int) -> tuple[Target, int]:
    """Return an output to the status at the beginning of ``w``."""
    return Target("status", STATUS.index(name)), node


def loaded_rows(g: Graph, jacobian: Sequence[Entry], m: int) -> list[list[tuple[int, int]]]:
    """Return the rows of D with the variable entries read from ``w``."""
    rows: list[list[tuple[int, int]]] = [[] for _ in range(m)]
    for e in jacobian:
        node = g.constant(e.constant) if e.constant is not None else g.input("jacobian", e.slot or 0)
        rows[e.row].append((e.column, node))
    return rows


def spread(
    hoister: Hoister,
    equations: Equations,
    jacobian: Sequence[Entry],
    stored: Stored,
    names: tuple[str, str] = ("lower", "reciprocal"),
    weight: Callable[[Vector], Vector] | None = None,
) -> Block:
    """Block of the correction x = -W^-1 D^T (D W^-1 D^T)^-1 r of the section ``residual``.

    Parameters
    ----------
    stored : Stored
        The factor of D W^-1 D^T, kept in the sections `names`.
    weight : callable, optional
        Applies W^-1; the identity unless given.
    """
    g = hoister.graph
    y = stored.loaded(*names).solve(g, [g.neg(g.input("residual", i)) for i in range(equations.m)])
    x = transposed_product(g, jacobian, y, equations.nv)
    if weight is not None:
        x = list(weight(Vector(g, tuple(x))))
    outputs = [(Target("change", j), n) for j, n in enumerate(x)]
    return hoister.block(
        "spread", "the correction -D^+ times the section `residual`, of v, or of q by N", outputs, ("p", "w")
    )


def transposed_product(g: Graph, jacobian: Sequence[Entry], y: Sequence[int], columns: int) -> list[int]:
    """Return D^T y with the D that `geometry` left."""
    x = [g.zero] * columns
    for i, row in enumerate(loaded_rows(g, jacobian, len(y))):
        for j, entry in row:
            x[j] = g.add(x[j], g.mul(entry, y[i]))
    return x
