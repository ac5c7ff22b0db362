"""The order of elimination with the fewest operations, counted for each mechanism."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace

from symgen.base.ir.graph import PARAMETER
from symgen.base.ir.program import EliminationPlan
from symgen.derive.formulate.equations import Equations, without_bounded_rows
from symgen.derive.lower.closed_loops import loops_in_order
from symgen.derive.lower.fixed_velocities import fixed_velocities, mass_entries
from symgen.derive.lower.record import record_multipliers
from symgen.derive.lower.scalar import ScalarNodes


def cheapest_plan(equations: Equations, closing: bool = True, drags: bool | None = None) -> EliminationPlan:
    """Return the plan whose right-hand side has the fewest operations.

    Equal numbers are decided by the longest chain of operations. Loops in closed form are left out unless `closing`.
    With `drags`, which the equations have unless told otherwise, sliders without mass are eliminated: M has no inverse.
    """
    if not equations.m:
        return EliminationPlan()
    inverts = not (bool(equations.drags) if drags is None else drags) or not _has_massless(equations)
    plans = [
        plan for plan in _candidate_plans(equations) if (closing or not plan.loops) and (inverts or not plan.schur)
    ]
    costs = {plan: cost_of_plan(equations, plan) for plan in plans}
    best = min(costs, key=costs.__getitem__)
    normal = replace(best, normal=True)
    # Euler parameters have no sines whose squares meet
    return best if best.schur or equations.spins or cost_of_plan(equations, normal) >= costs[best] else normal


def closing_plan(equations: Equations, plan: EliminationPlan, free: Sequence[int]) -> EliminationPlan:
    """Return a plan that also closes loops, with some velocities free; the same one where that takes more operations.

    Of equations with bounded rows it is the plan of motions with none of these in force.

    Parameters
    ----------
    equations : Equations
        The derived equations.
    plan : EliminationPlan
        From `cheapest_plan`.
    free : sequence of int
        Velocities that no loop is solved for.
    """
    if any(row.bounded for row in equations.rows):
        drags, equations = bool(equations.drags), without_bounded_rows(equations)
        plan = cheapest_plan(equations, closing=False, drags=drags)
    loops = loops_in_order(equations, plan.fixed, free) if free and not plan.loops else ()
    orders = dict.fromkeys((loops, loops[::-1]))  # from free velocities on, and towards them
    normal = (False,) if equations.spins else (False, True)
    plans = [plan, *(EliminationPlan(plan.fixed, False, n, order) for order in orders if order for n in normal)]
    return min(plans, key=lambda each: cost_of_plan(equations, each)) if len(plans) > 1 else plan


def _candidate_plans(equations: Equations) -> Iterator[EliminationPlan]:
    yield EliminationPlan()
    for hinges in (False, True) if any(row.axes for row in equations.rows) else (False,):
        fixed = fixed_velocities(equations, hinges)
        if fixed:
            yield EliminationPlan(fixed, schur=False)
        loops = loops_in_order(equations, fixed)
        if loops:
            yield EliminationPlan(fixed, schur=False, loops=loops)


def _has_massless(equations: Equations) -> bool:
    """Return whether M has a 0 on its diagonal."""
    return any(i == j and equations.graph.value(node) == 0.0 for (i, j), node in mass_entries(equations).items())


def cost_of_plan(equations: Equations, plan: EliminationPlan) -> tuple[int, int]:
    """Return the operations of a right-hand side, and the longest chain of them: none on parameters alone."""
    record = record_multipliers(equations.driving is not None)
    record = record.choose_solution(plan.schur, frozenset(("constrained",) if equations.drags else ()))
    scalars = ScalarNodes(equations, record.operations, plan=plan)
    scalars = scalars.with_closed_loops(record.operations, plan) if plan.loops else scalars
    scalars.compute(record.output_operations)
    values = [scalars.values[i] for i in record.output_operations]
    nodes = [n for value in values for n in (value if isinstance(value, tuple) else (value,)) if n is not None]
    g, depth, counted = scalars.graph, dict[int, int](), 0
    for node in g.required_nodes(nodes, lambda node: g.depends[node] == PARAMETER):
        op, args, _ = g.nodes[node]
        if op in ("const", "input") or g.depends[node] == PARAMETER:
            depth[node] = 0
        else:
            counted += 1
            depth[node] = 1 + max(depth[a] for a in args)
    return counted, max(depth.values())
