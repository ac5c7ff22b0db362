"""Velocities that rows fix: the same motion as dense matrices have, masks, ranks, and what is never taken."""

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from support.checks import RANDOM, close
from support.graph_values import node_values
from support.switching import with_switchable

import symgen
from derive.lower.test_rank import SCHUR, equations_of, laid_out
from symgen.base.ir.program import EliminationPlan, FixedVelocities
from symgen.derive.formulate.formulate import formulate
from symgen.derive.lower.closed_loops import loop_pairs, loops_in_order
from symgen.derive.lower.fixed_velocities import fixed_velocities
from symgen.derive.lower.plans import cheapest_plan
from symgen.derive.lower.scalar import ScalarNodes
from symgen.derive.methods._base import multiplier_law
from symgen.run.compiling.choices import mechanism_on_tree
from symgen.run.planning.starts import parameter_values


def motion(system):
    law = multiplier_law(system, system.gamma)
    return [law.acceleration, law.multipliers]


def flagged(system):
    return [*motion(system), system.flag()]


def fixing(equations, hinges=False):
    return EliminationPlan(fixed_velocities(equations, hinges), schur=False)


def rows_with_units(rng, m: int, n: int) -> np.ndarray:
    """Sparse rows, some with entries of +-1."""
    d = rng.normal(size=(m, n)) * (rng.random((m, n)) < 0.4)
    d[np.arange(m), rng.integers(n, size=m)] = rng.choice((-1.0, 1.0), m)
    return d


@RANDOM
@given(seed=st.integers(0, 10**6), m=st.integers(1, 6), spare=st.integers(1, 3), masked=st.booleans())
def test_motion_is_that_of_the_dense_equations(seed, m, spare, masked):
    rng = np.random.default_rng(seed)
    n = m + spare
    d, masses = rows_with_units(rng, m, n), rng.uniform(0.5, 4.0, n)
    equations, values = equations_of(d, masses)
    plan = fixing(equations)
    kept = [i for i in range(m) if i in plan.rows or not masked]
    if not plan.fixed or np.linalg.svd(d[kept], compute_uv=False)[-1] < 0.1:
        return
    values |= {("mask", i): math.inf for i in range(m) if i not in kept}
    f, gamma = rng.normal(size=n), rng.normal(size=m)
    values |= {("f", j): float(x) for j, x in enumerate(f)} | {("gamma", i): float(x) for i, x in enumerate(gamma)}
    scalars, (a, multipliers) = laid_out(equations, motion, plan)
    k = len(kept)
    dense = np.block([[np.diag(masses), d[kept].T], [d[kept], np.zeros((k, k))]])
    expected = np.linalg.solve(dense, np.concatenate([f, gamma[kept]]))
    close(node_values(scalars.graph, a, values), expected[:n], "v'", 1e-9)
    found = np.array(node_values(scalars.graph, multipliers, values))
    close(found[kept], expected[n:], "lambda", 1e-9)
    assert not found[[i for i in range(m) if i not in kept]].any()


@RANDOM
@given(seed=st.integers(0, 10**6), independent=st.integers(1, 5), repeated=st.integers(0, 3))
def test_ranks_and_corrections_are_those_of_the_pseudoinverse(seed, independent, repeated):
    rng = np.random.default_rng(seed)
    n = independent + 2
    base = rows_with_units(rng, independent, n)
    if np.linalg.svd(base, compute_uv=False)[-1] < 0.1:
        return
    mixing = np.vstack([np.eye(independent), rng.integers(-1, 2, size=(repeated, independent))])
    mixing[independent:][~mixing[independent:].any(axis=1), 0] = 1
    d = (mixing @ base)[rng.permutation(independent + repeated)]
    equations, values = equations_of(d, rng.uniform(0.5, 4.0, n))
    plan = fixing(equations)
    right = d @ rng.normal(size=n)

    def change(system):
        rank = system.rank_factor()
        by_factor = system.variable("change", "nv")
        target = system.variable("right", "m")
        return [rank, system.stored_constrained("identity", "change", rank, system.zeros("nv"), target, by_factor)]

    scalars, (rank, nodes) = laid_out(equations, change, plan)
    rest = [i for i in range(len(d)) if i not in plan.rows]
    pivots = node_values(scalars.graph, [rank.pivots[i] for i in rest], values)
    diagonal = (d**2).sum(axis=1)
    values |= {("pivot", i): x / diagonal[i] for i, x in zip(rest, pivots, strict=True)}
    values |= {("right", i): float(x) for i, x in enumerate(right)}
    values |= {("jacobian", e.slot): float(d[e.row, e.column]) for e in scalars.jacobian if e.slot is not None}
    kept = len(plan.rows) + sum(values["pivot", i] > 1e-9 for i in rest)
    assert kept == independent
    close(node_values(scalars.graph, nodes, values), np.linalg.pinv(d) @ right, "change", 1e-8)


def test_velocities_that_follow_from_each_other_are_not_all_fixed():
    d = np.array([[1.0, -1.0, 0.0], [0.0, 1.0, -1.0], [-1.0, 0.0, 1.0]])
    equations, _ = equations_of(d, np.ones(3))
    assert len(fixed_velocities(equations, False)) == 2, "the third row depends on the others"


def test_rows_that_may_be_off_fix_nothing():
    mechanism = symgen.load("four-bar").mechanism
    joint = mechanism.joints[0].name
    switched = formulate(with_switchable(mechanism, joint))
    fixed = {switched.rows[r].joint for each in fixed_velocities(switched, True) for r in each.rows}
    assert joint not in fixed
    assert joint in {formulate(mechanism).rows[r].joint for r in fixing(formulate(mechanism)).rows}


@pytest.mark.parametrize("scale", [1.0, 1e-4, 0.0])
def test_what_is_left_of_a_row_raises_the_flag_where_it_cancels(scale):
    """The second row differs from the first one, which fixes a velocity, by a small entry only."""
    d = np.array([[1.0, 0.5, 0.0], [1.0, 0.5 + 0.7 * scale, 0.3 * scale]])
    equations, values = equations_of(d, np.ones(3))
    plan = EliminationPlan((FixedVelocities((0,), (0,)),), schur=False)
    scalars, (_, _, flag) = laid_out(equations, flagged, plan)
    assert bool(node_values(scalars.graph, [flag], values)[0]) == (scale < 1e-3)
    values["mask", 1] = math.inf
    assert not node_values(scalars.graph, [flag], values)[0], "a masked row is no suspect"


ENTRIES = (
    *("klann-leg", "engine", "cam-follower", "spherical-double-pendulum", "n-four-bar:2"),
    "four-bar",
    "slider-crank",
    "andrews",
    "driven-four-bar",
    "rolling-disc",
    "jansen-leg",
    "spatial-slider-crank",
)


@pytest.mark.by_turns(4)
@pytest.mark.fast(
    "absolute-engine",
    "absolute-slider-crank",
    "absolute-driven-four-bar",
    "joint-cam-follower",
    "joint-spherical-double-pendulum",
    "joint-four-bar",
    "joint-rolling-disc",
    "joint-spatial-slider-crank",
)
@pytest.mark.parametrize("name", ENTRIES)
@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
def test_every_plan_gives_the_motion_of_the_dense_equations(name, coordinates):
    mechanism = symgen.load(name).mechanism
    mechanism = mechanism_on_tree(mechanism) if coordinates == "joint" else mechanism
    e = formulate(mechanism)
    plans = [
        SCHUR,
        *(EliminationPlan(fixing(e, h).fixed, False, normal) for h in (False, True) for normal in (False, True)),
    ]
    plans = list(dict.fromkeys(plan for plan in plans if plan.schur or plan.fixed))
    inputs = {("p", i): float(x) for i, x in enumerate(parameter_values(mechanism).values())} | {("t", 0): 0.3}
    inputs |= {("mask", i): 0.0 for i in range(e.m)} | {("gauge", j): 1.0 for j in range(e.nv)}
    inputs |= {("winding", i): 0.0 for i in range(len(e.windings))}
    solved = [laid_out(e, motion, plan) for plan in plans]
    for free in (
        (),
        *((c,) for c in dict.fromkeys(c for _, columns in loop_pairs(e, closing(e).fixed) for c in columns)),
    ):
        if (plan := closing(e, free)).loops:
            solved.append(laid_out(e, flagged, plan, closed=True))
    plain, rng = ScalarNodes(e), np.random.default_rng(1)
    for _ in range(6):
        q = rng.uniform(-1.0, 1.0, e.nq)
        for i, _ in e.spins:
            q[i : i + 4] /= np.linalg.norm(q[i : i + 4])
        state = (
            inputs | {("q", i): x for i, x in enumerate(q)} | {("v", j): x for j, x in enumerate(rng.normal(size=e.nv))}
        )
        matrix = np.zeros((e.nv + e.m, e.nv + e.m))
        nodes = {(i, j): n for (i, j), n in plain.mass_matrix.items()}
        nodes |= {(e.nv + r, j): n for r, row in enumerate(e.rows) for j, n in row.entries}
        for (i, j), x in zip(nodes, node_values(e.graph, list(nodes.values()), state, e.tables), strict=True):
            matrix[i, j] = matrix[j, i] = x
        right = node_values(e.graph, [*e.forces, *(row.gamma for row in e.rows)], state, e.tables)
        if not e.m or np.linalg.cond(matrix) > 1e9:
            continue
        expected = np.linalg.solve(matrix, right)
        for scalars, (a, multipliers, *flag) in solved:
            found = np.array(node_values(scalars.graph, [*a, *multipliers, *flag], state, e.tables))
            if flag and found[-1]:
                continue
            size = np.linalg.cond(matrix) * np.abs(expected).max() * (100 if flag else 1)  # a sine of 1/100 has no flag
            assert np.abs(found[: len(expected)] - expected).max() <= 1e-13 * size


def closing(equations, free=()):
    fixed = fixed_velocities(equations, False)
    return EliminationPlan(fixed, schur=False, normal=True, loops=loops_in_order(equations, fixed, free))


@pytest.mark.slow_cases("joint-jansen-leg-3")
@pytest.mark.parametrize(
    ("name", "loops"), [("jansen-leg", 3), ("driven-four-bar", 1), ("four-bar", 0), ("bricard", 0)]
)
@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
def test_loops_are_closed_where_a_driver_leaves_no_choice_of_velocities(name, loops, coordinates):
    mechanism = symgen.load(name).mechanism
    e = formulate(mechanism_on_tree(mechanism) if coordinates == "joint" else mechanism)
    plan = closing(e)
    assert len(plan.loops) == loops
    assert len({c for each in (*plan.fixed, *plan.loops) for c in each.columns}) == (e.nv if loops else len(plan.fixed))


def dyad(turned: float, reach: float = 0.4):
    """Return equations of a crank with a driver, and two links whose columns enclose an angle, and values of inputs.

    The velocity of the crank is fixed by a row of its own; the two rows of the closing joint are of all three.
    """
    c, s = math.cos(0.3 + turned), math.sin(0.3 + turned)
    d = np.array(
        [[1.0, 0.0, 0.0, 0.0], [0.2, -0.7 * math.sin(0.3), -reach * s, 0.0], [0.1, 0.7 * math.cos(0.3), reach * c, 0.0]]
    )
    equations, values = equations_of(d, np.array([0.5, 1.5, 2.0, 3.0]))
    rows = tuple(replace(row, joint="driver" if i == 0 else "closing") for i, row in enumerate(equations.rows))
    return d, replace(equations, rows=rows), values


@pytest.mark.parametrize("turned", [1.2, 0.01, -0.01, 3.0])
def test_a_closed_loop_has_the_motion_of_the_dense_equations_up_to_its_flag(turned):
    d, e, values = dyad(turned)
    plan = closing(e)
    assert [(each.columns, each.rows) for each in plan.loops] == [((1, 2), (1, 2))]
    scalars, (a, multipliers, flag) = laid_out(e, flagged, plan, closed=True)
    right = np.array([0.3, -1.0, 2.0, 0.7, 0.4, -0.2, 1.1])
    values |= {("f", j): x for j, x in enumerate(right[:4])} | {("gamma", i): x for i, x in enumerate(right[4:])}
    expected = np.linalg.solve(np.block([[np.diag([0.5, 1.5, 2.0, 3.0]), d.T], [d, np.zeros((3, 3))]]), right)
    found = node_values(scalars.graph, [*a, *multipliers, flag], values)
    close(found[:-1], expected, "v' and lambda", 1e-9)
    assert found[-1] == 0.0


@pytest.mark.parametrize(
    ("turned", "reach", "masked"),
    [(0.0, 0.4, None), (math.pi, 0.4, None), (1e-4, 0.4, None), (1.2, 1e-7, None), (1.2, 0.4, 2)],
)
def test_a_loop_is_suspicious_where_its_columns_are_parallel_or_vanish_or_a_row_is_left_out(turned, reach, masked):
    _, e, values = dyad(turned, reach)
    scalars, (_, _, flag) = laid_out(e, flagged, closing(e), closed=True)
    values |= {("f", j): 1.0 for j in range(4)} | {("gamma", i): 1.0 for i in range(3)}
    if masked is not None:
        values["mask", masked] = math.inf
    assert node_values(scalars.graph, [flag], values)[0]


@pytest.mark.parametrize("name", ["four-bar", "bricard", "chain:4", "rolling-disc"])
def test_the_cheapest_plan_takes_no_more_operations_than_others(name):
    e = formulate(symgen.load(name).mechanism)
    best, counts = cheapest_plan(e), {}
    for plan in dict.fromkeys((SCHUR, fixing(e), fixing(e, True), best)):
        scalars, (a, multipliers, flag) = laid_out(e, flagged, plan)
        ends = [*a, *multipliers, *(() if flag is None else (flag,))]
        counts[plan] = scalars.graph.count_operations(ends)
    assert counts[best] == min(counts.values())


@pytest.mark.parametrize("name", ["andrews", "jansen-leg"])
def test_quadratic_velocity_terms_in_the_plane_are_entries_of_other_rows_times_squares(name):
    """A square for each angle; a product and a sum for each entry of a row that turns with one."""
    e = formulate(symgen.load(name).mechanism)
    g, entries = e.graph, [(j, node) for row in e.rows for j, node in row.entries]
    turning = [j for j, node in entries if e.velocities[j].unit == "rad/s" and g.value(node) is None]
    before = g.count_operations([node for _, node in entries])
    both = g.count_operations([*(node for _, node in entries), *(row.gamma for row in e.rows)])
    assert both - before <= len(set(turning)) + 2 * len(turning)
