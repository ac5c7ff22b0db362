"""Rank decided on D D^T: dependent rows are skipped, and corrections are those of the Moore-Penrose inverse."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from support.checks import RANDOM, close
from support.graph_values import node_values

from symgen.base.ir.graph import Graph
from symgen.base.ir.numerics import SUSPICIOUS
from symgen.base.ir.program import EliminationPlan
from symgen.derive.formulate.equations import ConstraintRow, Equations, MassBlock, Quantity
from symgen.derive.lower.recorded_law import Part, RecordedLaw
from symgen.derive.lower.scalar import ScalarNodes
from symgen.derive.methods._system import System

SCHUR = EliminationPlan()


def equations_of(d: np.ndarray, masses: np.ndarray) -> tuple[Equations, dict]:
    """Equations with the entries of D as inputs unless they are +-1, and their values; a mask of zeros."""
    graph, (m, n) = Graph(), d.shape
    values = {("d", i * n + j): float(d[i, j]) for i, j in np.argwhere(d != 0.0)} | {("mask", i): 0.0 for i in range(m)}
    rows = tuple(
        ConstraintRow(
            f"r{i}", f"j{i}", "m", graph.zero, entries_of(graph, d[i], i * n), graph.zero, graph.input("gamma", i)
        )
        for i in range(m)
    )
    names = tuple(Quantity(f"b.{j}", "m") for j in range(n))
    equations = Equations(
        name="matrix",
        graph=graph,
        parameters=(),
        coordinates=names,
        velocities=names,
        q_rates=tuple(graph.input("v", j) for j in range(n)),
        mass=tuple(MassBlock((j,), ((graph.constant(float(x)),),)) for j, x in enumerate(masses)),
        rows=rows,
        forces=tuple(graph.input("f", j) for j in range(n)),
        power=graph.zero,
        kinetic=graph.zero,
        potential=graph.zero,
        joint_coordinates=(),
        tables=(),
        omissions=(),
        dropped_rows=(),
    )
    return equations, values


def entries_of(graph, row, first):
    columns = map(int, np.flatnonzero(row))
    return tuple((j, graph.constant(row[j]) if abs(row[j]) == 1.0 else graph.input("d", first + j)) for j in columns)


def random_rows(rng, m: int, n: int) -> np.ndarray:
    """Sparse rows, none of them empty."""
    d = rng.normal(size=(m, n)) * (rng.random((m, n)) < 0.5)
    d[np.arange(m), rng.integers(n, size=m)] += 1.5
    return d


def laid_out(equations: Equations, formula, plan=SCHUR, closed=False):
    """What a formula over a system gives, element by element."""
    system = System()
    ends = formula(system)
    part = Part("rhs", "", tuple(("", end.index) for end in ends))
    record = RecordedLaw(tuple(system.tape.operations), (part,)).choose_solution(plan.schur)
    scalars = ScalarNodes(equations, record.operations, plan=plan)
    scalars = scalars.with_closed_loops(record.operations, plan) if closed else scalars
    scalars.compute(record.output_operations)
    return scalars, [scalars.values[index] for index in record.output_operations]


def corrected(equations: Equations, values, d, b, weight=None):
    """D^+ b as the emitted code computes it: y from the factor of D W D^T, then W D^T y."""

    def formula(system):
        rank = system.rank_factor()
        right = system.variable("right", "m")
        return [rank, system.solve(rank if weight is None else system.weighted_factor(rank, "mass"), right)]

    scalars, (rank, nodes) = laid_out(equations, formula)
    known = values | {("right", i): float(x) for i, x in enumerate(b)}
    # what `geometry` leaves for the factor of another metric: D, and the reciprocal pivots that decide rank
    stored = node_values(scalars.graph, [rank.reciprocal[k] for k in rank.order], known)
    known |= {("reciprocal", i): float(x) for i, x in enumerate(stored)}
    known |= {("jacobian", e.slot): float(d[e.row, e.column]) for e in scalars.jacobian}
    y = node_values(scalars.graph, nodes, known)
    return (np.ones(d.shape[1]) if weight is None else weight) * (d.T @ y), np.array(y)


@RANDOM
@given(seed=st.integers(0, 10**6), independent=st.integers(1, 5), repeated=st.integers(0, 3))
def test_corrections_are_those_of_the_pseudoinverse(seed, independent, repeated):
    rng = np.random.default_rng(seed)
    n = independent + 2
    base = random_rows(rng, independent, n)
    if np.linalg.svd(base, compute_uv=False)[-1] < 0.1:
        return
    # repeated rows: copies and combinations of few rows, as redundant joints make them
    mixing = np.vstack([np.eye(independent), rng.integers(-1, 2, size=(repeated, independent))])
    mixing[independent:][~mixing[independent:].any(axis=1), 0] = 1
    d = (mixing @ base)[rng.permutation(independent + repeated)]
    masses = rng.uniform(0.5, 4.0, n)
    equations, values = equations_of(d, masses)
    b = d @ rng.normal(size=n)
    found, y = corrected(equations, values, d, b)
    np.testing.assert_allclose(found, np.linalg.pinv(d) @ b, rtol=0, atol=1e-9)
    assert np.count_nonzero(y) <= independent
    weighted = np.linalg.pinv(d / np.sqrt(masses)) @ b / np.sqrt(masses)
    np.testing.assert_allclose(corrected(equations, values, d, b, 1 / masses)[0], weighted, rtol=0, atol=1e-9)


def test_the_row_eliminated_last_is_the_one_that_is_skipped():
    d = np.array([[1.0, 1.0, 0.0], [0.0, 1.0, 1.0], [1.0, 2.0, 1.0]])
    equations, values = equations_of(d, np.ones(3))
    scalars, (factor,) = laid_out(equations, lambda system: [system.rank_factor()])
    reciprocal = node_values(scalars.graph, [factor.reciprocal[k] for k in scalars.order], values)
    assert [x == 0.0 for x in reciprocal] == [False, False, True]


@RANDOM
@given(seed=st.integers(0, 10**6), m=st.integers(2, 6))
def test_masked_rows_are_as_if_they_were_not_there(seed, m):
    rng = np.random.default_rng(seed)
    n = m + 2
    d, masses = random_rows(rng, m, n), rng.uniform(0.5, 4.0, n)
    masked = int(rng.integers(m))
    kept = [i for i in range(m) if i != masked]
    if np.linalg.svd(d[kept], compute_uv=False)[-1] < 0.1:
        return
    equations, values = equations_of(d, masses)
    values["mask", masked] = math.inf
    f, gamma = rng.normal(size=n), rng.normal(size=m)
    values |= {("f", j): float(x) for j, x in enumerate(f)} | {("gamma", i): float(x) for i, x in enumerate(gamma)}
    scalars, (multipliers,) = laid_out(equations, lambda s: [s.solve_schur(s.D @ s.minv(s.f) - s.gamma)])
    found = node_values(scalars.graph, multipliers, values)
    s = d[kept] @ np.diag(1 / masses) @ d[kept].T
    expected = np.zeros(m)
    expected[kept] = np.linalg.solve(s, d[kept] @ (f / masses) - gamma[kept])
    close(found, expected, "lambda", 1e-9)


@pytest.mark.parametrize(("angle", "suspicious"), [(1.0, False), (1e-2, False), (1e-4, True), (0.0, True)])
def test_nearly_parallel_rows_raise_the_flag(angle, suspicious):
    """The pivot is the squared sine of the angle between the rows."""
    d = np.array([[1.0, 0.0, 0.3], [math.cos(angle), math.sin(angle), 0.3 * math.cos(angle)]])
    equations, values = equations_of(d, np.ones(3))
    scalars, (_, flag) = laid_out(equations, lambda s: [s.solve_schur(s.gamma), s.flag()])
    assert bool(node_values(scalars.graph, [flag], values)[0]) == suspicious == (math.sin(angle) ** 2 < SUSPICIOUS)
    values["mask", scalars.order[-1]] = math.inf
    assert node_values(scalars.graph, [flag], values)[0] == 0.0, "a masked row is no suspect"
