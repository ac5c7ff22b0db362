"""A right-hand side for derivatives, without derivatives of the factorisation.

Accelerations and multipliers x solve K x = b. The elimination gives their values; the residual b - K x with x held,
solved with the factor that is there, gives their derivatives: dx = K^-1 (db - dK x). Both directions of differentiation
take them.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from symgen.base.ir.graph import PARAMETER, POSITION, TIME, VELOCITY, Graph
from symgen.base.ir.program import OutputSlot
from symgen.derive.lower.recorded_law import RecordedLaw
from symgen.derive.lower.scalar import ScalarNodes
from symgen.derive.lower.scalar_values import Outputs

#: Space of right-hand sides while a solution is written down.
_RIGHT = "right"


@dataclass(frozen=True)
class _Solved:
    """The equations of a law: f and gamma, with v' and lambda."""

    f: tuple[int, ...]
    gamma: tuple[int, ...]
    unknowns: tuple[int, ...]


def outputs_by_residual(scalars: ScalarNodes, record: RecordedLaw, outputs: Outputs) -> Outputs | None:
    """Return the outputs of a right-hand side with other derivatives, None where these take no fewer operations.

    Parameters
    ----------
    scalars : ScalarNodes
        The evaluated tape.
    record : RecordedLaw
        The tape with both ways of elimination.
    outputs : Outputs
        Of the right-hand side.
    """
    solved = _equations_solved(scalars, record)
    if solved is None:
        return None
    g = scalars.graph
    held = tuple(g.call("held", node) for node in solved.unknowns)
    changes = _newton_change(scalars, solved, held)
    new = {
        node: g.call("carried", node, change)
        for node, change in zip(solved.unknowns, changes, strict=True)
        if g.value(node) is None
    }
    own = [new.get(node, node) for _, node in outputs]
    for k, (target, _) in enumerate(outputs):
        place = _place_of_output(scalars, target)
        if place is None:
            (own[k],) = g.rebuild_from(g, [own[k]], lambda node: new.get(node, node), new.__contains__)
        else:
            own[k] = g.call("carried", solved.unknowns[place], changes[place])
    if count_slope_products(g, own) >= count_slope_products(g, [node for _, node in outputs]):
        return None
    return [(target, node) for (target, _), node in zip(outputs, own, strict=True)]


def _place_of_output(scalars: ScalarNodes, target: OutputSlot) -> int | None:
    """Return the place among v' and lambda of an output."""
    e = scalars.equations
    if target.space == "multipliers":
        return e.nv + target.index
    return target.index - e.nq if target.space == "ydot" and e.nq <= target.index < e.nq + e.nv else None


def _equations_solved(scalars: ScalarNodes, record: RecordedLaw) -> _Solved | None:
    """Return the equations that a right-hand side solves, None where it solves others, or none."""
    own = [(i, o) for i, o in enumerate(record.operations) if o.kind == "constrained"]
    if len(own) != 2 or len({o.operands[-2:] for _, o in own}) != 1:
        return None
    ways = {o.payload[0]: o.operands[0] if scalars.plan.schur else i for i, o in own}
    places = [*own[0][1].operands[-2:], ways["accelerations"], ways["multipliers"]]
    scalars.compute(places)
    f, gamma, accelerations, multipliers = (scalars.values[i] for i in places)
    return _Solved(f, gamma, (*accelerations, *multipliers))


def _newton_change(scalars: ScalarNodes, solved: _Solved, held: tuple[int, ...]) -> list[int]:
    """Return K^-1 times the residual with held unknowns, K held as well: 0 with the derivatives of the unknowns."""
    g, nv = scalars.graph, scalars.equations.nv
    accelerations, multipliers = held[:nv], held[nv:]
    forces = zip(
        scalars.mass_times(accelerations), scalars.product_with_transpose(scalars.rows, multipliers), strict=True
    )
    residual = [g.sub(f, g.add(x, y)) for f, (x, y) in zip(solved.f, forces, strict=True)]
    residual += [g.sub(x, y) for x, y in zip(solved.gamma, scalars.product(scalars.rows, accelerations), strict=True)]
    right = tuple(g.input(_RIGHT, i) for i in range(len(residual)))
    solution = [node for part in scalars.solve_plan(right[:nv], right[nv:]) for node in part]
    follows = set[int]()
    for node in g.required_nodes(solution):
        if node in right or not follows.isdisjoint(g.nodes[node].args):
            follows.add(node)

    def node_with_held_unknowns(node: int) -> int:
        return residual[g.key(node)[1]] if node in follows else g.call("held", node)

    return g.rebuild_from(g, solution, node_with_held_unknowns, lambda node: node not in follows)


def count_slope_products(graph: Graph, ends: Sequence[int]) -> int:
    """Return the number of products in the derivatives of some nodes: about the operations of a direction."""
    moving, waiting = dict[int, bool](), list(ends)
    while waiting:
        node = waiting.pop()
        if node not in moving:
            moving[node] = bool(graph.depends[node] & (TIME | POSITION | VELOCITY | PARAMETER))
            waiting += () if graph.depends[node] == PARAMETER else _arguments_of_derivatives(graph, node)
    count = 0
    for node in sorted(moving):
        op, _, payload = graph.nodes[node]
        if op == "input":
            moving[node] |= payload[0] == "z" if isinstance(payload, tuple) else False
        elif graph.depends[node] != PARAMETER:
            factors = sum(moving[a] for a in _arguments_of_derivatives(graph, node))
            moving[node], count = factors > 0, count + factors * (op not in ("add", "sub", "neg", "carried"))
    return count


def _arguments_of_derivatives(graph: Graph, node: int) -> tuple[int, ...]:
    """Return the arguments of an operation that its derivatives depend on."""
    op, args, _ = graph.nodes[node]
    return () if op == "held" else args[1:] if op == "carried" else args
