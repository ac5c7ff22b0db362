"""The elimination of Newton matrices against NumPy and SuperLU: random patterns, kept pivots, unknowns of all sizes."""

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from scipy.sparse import csc_array
from scipy.sparse.linalg import splu

from benchmarks import newton
from symgen.api import load
from symgen.run.compiling.method_choice import choose_method
from symgen.run.compiling.pipeline import generate
from symgen.run.layout.records import Sizes
from symgen.run.layout.redundancy import leave_out_rest
from symgen.run.loops import sparse
from symgen.run.loops.newton import (
    Pattern,
    Terms,
    alpha_plan,
    elimination_order,
    newton_plan,
    projection_plan,
    stage_plan,
)

NOTHING = np.zeros(0, dtype=np.int64)


class Solver:
    """Plan and numbers for the nonzeros of a matrix."""

    def __init__(self, matrix, left_out=NOTHING, motion=(0, 0, 0)):
        self.rows, self.columns = (x.astype(np.int64) for x in np.nonzero(matrix))
        terms = Terms(self.rows, self.columns, np.zeros_like(self.rows), np.arange(len(self.rows)))
        self.n, self.left_out = len(matrix), left_out
        self.plan, self.numbers = newton_plan(self.n, 1, terms, left_out, len(self.rows), motion=motion)

    def factorise(self, matrix):
        """Return the skipped pivots; room grows as the loops let it."""
        sources = np.append(matrix[self.rows, self.columns], 1.0)
        while (skipped := sparse.prepare_pattern(self.plan, sources, np.ones(1), self.numbers)) < 0:
            self.plan, self.numbers = sparse.enlarge_pattern(self.plan, self.numbers)
        return skipped

    def solve(self, right):
        x = np.full(self.n, np.nan)
        sparse.solve(self.plan, self.numbers, np.asarray(right, dtype=np.float64), x)
        return x


def solved(matrix, right):
    """Return the solution and the number of skipped pivots."""
    solver = Solver(matrix)
    skipped = solver.factorise(matrix)
    return solver.solve(right), skipped


@st.composite
def matrices(draw):
    n = draw(st.integers(1, 12))
    rng = np.random.default_rng(draw(st.integers(0, 10**6)))
    matrix = np.where(rng.random((n, n)) < draw(st.sampled_from([0.1, 0.3, 0.8])), rng.uniform(-1.0, 1.0, (n, n)), 0.0)
    matrix[np.arange(n), rng.permutation(n)] += rng.choice([-1.0, 1.0], n)  # no row and no column is empty
    return matrix * 10.0 ** rng.integers(-6, 6, (n, 1)), rng


@pytest.mark.slow
@given(matrices())
def test_random_patterns_as_numpy_solves_them(case):
    matrix, rng = case
    scaled = matrix / np.abs(matrix).max(axis=1, keepdims=True)
    assume(np.linalg.cond(scaled) < 1e8)
    solver = Solver(matrix)
    for _ in range(3):  # anew, then with the pivots that are kept
        right = matrix @ rng.uniform(-1.0, 1.0, len(matrix))
        assert solver.factorise(matrix) == 0
        expected = np.linalg.solve(scaled, right / np.abs(matrix).max(axis=1))
        np.testing.assert_allclose(solver.solve(right), expected, rtol=1e-6, atol=1e-7)
        matrix = matrix * rng.uniform(0.99, 1.01, matrix.shape)
        scaled = matrix / np.abs(matrix).max(axis=1, keepdims=True)
        assume(np.linalg.cond(scaled) < 1e8)


@pytest.mark.slow
@given(matrices())
def test_singular_matrices_have_a_solution_where_there_is_one(case):
    """A copy of an equation and the unknown that would need it: skipped, and the others are as without both."""
    matrix, rng = case
    n = len(matrix)
    scaled = matrix / np.abs(matrix).max(axis=1, keepdims=True)
    assume(np.linalg.cond(scaled) < 1e4)  # small pivots of worse ones are told from rounding by their size alone
    bordered = np.block([[scaled, scaled[:, :1]], [scaled[:1], scaled[:1, :1]]])  # last row and column are copies
    x, skipped = solved(bordered, bordered @ np.append(rng.uniform(-1.0, 1.0, n), 0.0))
    assert skipped == 1
    again = rng.uniform(-1.0, 1.0, n + 1)
    x, _ = solved(bordered, bordered @ again)
    np.testing.assert_allclose(bordered @ x, bordered @ again, atol=1e-8)


def test_pivots_are_kept_until_they_are_small():
    rng = np.random.default_rng(3)
    matrix = np.diag(rng.uniform(4.0, 5.0, 30)) + np.diag(rng.uniform(-1.0, 1.0, 29), 1)
    matrix[rng.integers(0, 30, 40), rng.integers(0, 30, 40)] += 0.5
    solver, right = Solver(matrix), rng.uniform(-1.0, 1.0, 30)
    solver.factorise(matrix)
    rows = solver.plan[solver.plan[sparse.WORK] + 8 * 30 :][:30].copy()
    for shift in (1.0, 1.5):
        solver.factorise(shift * matrix)
        np.testing.assert_allclose(solver.solve(right), np.linalg.solve(shift * matrix, right), rtol=1e-10)
        assert np.array_equal(solver.plan[solver.plan[sparse.WORK] + 8 * 30 :][:30], rows)
    weak = matrix.copy()
    weak[np.arange(30), np.arange(30)] *= 1e-7  # another row has to be the pivot now
    solver.factorise(weak)
    assert not np.array_equal(solver.plan[solver.plan[sparse.WORK] + 8 * 30 :][:30], rows)
    superlu = splu(csc_array(weak)).solve(right)
    np.testing.assert_allclose(solver.solve(right), superlu, rtol=1e-8, atol=1e-8 * np.abs(superlu).max())


def test_room_grows_where_pivots_leave_the_diagonal():
    rng = np.random.default_rng(4)
    n = 40
    matrix = np.where(rng.random((n, n)) < 0.15, rng.uniform(-1.0, 1.0, (n, n)), 0.0) + np.diag(np.full(n, 1e-9))
    matrix[np.arange(n), (np.arange(n) + 1) % n] = 1.0
    solver, right = Solver(matrix), rng.uniform(-1.0, 1.0, n)
    short = 8
    solver.plan = solver.plan[: solver.plan[sparse.POOL] + short].copy()
    solver.numbers = solver.numbers[: len(solver.rows) + 5 * n + short].copy()
    solver.plan[sparse.ROOM] = short
    assert solver.factorise(matrix) == 0 and solver.plan[sparse.ROOM] > 10 * short
    np.testing.assert_allclose(solver.solve(right), np.linalg.solve(matrix, right), rtol=1e-8, atol=1e-9)


def test_what_is_not_finite_has_no_solution_and_does_not_stay():
    matrix = np.diag([1.0, 2.0, 3.0]) + 0.1
    solver = Solver(matrix)
    solver.factorise(np.where(np.eye(3) == 1.0, np.nan, matrix))
    assert np.all(np.isnan(solver.solve(np.ones(3))))
    solver.factorise(matrix)
    np.testing.assert_allclose(solver.solve(np.ones(3)), np.linalg.solve(matrix, np.ones(3)), rtol=1e-12)


# -- unknowns of very different sizes --------------------------------------------------------------------------------


def saddle(stiffness, rng):
    """A stiff block above rows of constraints."""
    k = rng.uniform(-1.0, 1.0, (6, 6))
    d = rng.uniform(-1.0, 1.0, (4, 6))
    matrix = np.block([[stiffness * (k @ k.T + np.eye(6)), d.T], [d, np.zeros((4, 4))]])
    return matrix, d


@pytest.mark.parametrize("stiffness", [1.0, 1e8, 1e16, 1e24])
def test_stiff_unknowns_do_not_hide_multipliers(stiffness):
    rng = np.random.default_rng(7)
    matrix, _ = saddle(stiffness, rng)
    # the multipliers are as large as the stiff forces: in their unit the matrix is as regular as with stiffness 1
    exact = np.concatenate([rng.uniform(1.0, 2.0, 6), stiffness * rng.uniform(1.0, 2.0, 4)])
    scale = np.concatenate([np.ones(6), np.full(4, stiffness)])
    unit = matrix * scale / np.concatenate([np.full(6, stiffness), np.ones(4)])[:, None]
    right = np.concatenate([np.full(6, stiffness), np.ones(4)]) * (unit @ (exact / scale))
    x, skipped = solved(matrix, right)
    assert skipped == 0
    np.testing.assert_allclose(x / scale, exact / scale, rtol=1e-10)


@pytest.mark.parametrize("unit", [1.0, 2.0**-50, 2.0**-500, 2.0**500])
@pytest.mark.parametrize("light", [1.0, 1e-18])
def test_no_unit_of_mass_and_no_heavy_body_hides_a_light_one(unit, light):
    """Masses in any unit, the last one light beside the others: what rows leave free of it moves, and nothing else."""
    rng = np.random.default_rng(12)
    masses, d = unit * np.array([1.0, 2.0, 1.5, light, light]), np.zeros((3, 5))
    d[0, :2], d[1, 2:4], d[2] = rng.uniform(0.5, 1.0, 2), [1.0, -1.0], 0.0
    d[2, 1:] = rng.uniform(0.5, 1.0, 4)
    d[2] += d[0]
    matrix = np.block([[np.diag(masses), d.T], [d, np.zeros((3, 3))]])
    solver = Solver(matrix, motion=(0, 5, 3))
    assert solver.factorise(matrix) == 0
    basis = np.linalg.svd(d)[2][3:].T
    force = masses * rng.uniform(1.0, 2.0, 5)
    x = solver.solve(np.append(force, np.zeros(3)))
    expected = basis @ np.linalg.solve(basis.T @ np.diag(masses) @ basis, basis.T @ force)
    np.testing.assert_allclose(x[:5], expected, rtol=1e-9)
    assert solver.factorise(matrix * 1.01) == 0  # with the same pivots


def test_a_dependent_equation_is_skipped():
    rng = np.random.default_rng(8)
    matrix, d = saddle(1e6, rng)
    matrix[9, :6] = matrix[:6, 9] = d[0] + d[1]
    exact = np.concatenate([rng.uniform(1.0, 2.0, 6), rng.uniform(1e6, 2e6, 3), [0.0]])
    x, skipped = solved(matrix, matrix @ exact)
    assert skipped == 1
    np.testing.assert_allclose(x[:6], exact[:6], rtol=1e-8)
    np.testing.assert_allclose(matrix @ x, matrix @ exact, rtol=1e-8)


def test_rows_that_are_left_out_have_no_multiplier():
    """With a row that is dependent up to a violation, and left out, the solution is that without the row."""
    rng = np.random.default_rng(9)
    matrix, d = saddle(1.0, rng)
    matrix[9, :6] = matrix[:6, 9] = d[0] + d[1] + 1e-9 * rng.uniform(-1.0, 1.0, 6)
    right = rng.uniform(-1.0, 1.0, 10)
    expected = np.linalg.solve(matrix[:9, :9], right[:9])
    w = np.array([0.0, 0.0, 0.0, 0.0, np.inf])
    k = np.zeros(10)
    k[9] = 0.25  # a multiplier that an earlier iterate left: the iteration takes it away
    solver = Solver(matrix, np.array([9]))
    sizes = Sizes(*[0] * len(Sizes._fields))._replace(nq=3, nv=3, m=4, unknowns=10, mask=1)
    leave_out_rest(sizes, w, k, right)
    assert solver.factorise(matrix) == 0
    x = solver.solve(right)
    assert x[9] == 0.25
    coupled = expected - 0.25 * np.linalg.solve(matrix[:9, :9], matrix[:9, 9])
    np.testing.assert_allclose(x[:9], coupled, rtol=1e-9)


# -- plans -----------------------------------------------------------------------------------------------------------


def test_the_order_of_a_tridiagonal_matrix_makes_no_fill():
    i = np.arange(50)
    rows, columns = np.concatenate([i, i[1:], i[:-1]]), np.concatenate([i, i[:-1], i[1:]])
    order, fill = elimination_order(50, rows, columns)
    assert sorted(order) == i.tolist() and fill == 2 * 49


def test_multipliers_wait_for_a_neighbour():
    rows, columns = np.array([0, 1, 0, 2, 1, 2]), np.array([0, 1, 2, 0, 2, 1])
    order, _ = elimination_order(3, rows, columns)
    assert order[0] != 2


def pattern_of(name, method):
    """The pattern of a law, without its code being compiled."""
    choice = choose_method(method, None, True)
    modules = generate(load(name).mechanism, (choice,)).modules
    model, law = modules["model"][1], modules[choice.stem][1]
    places = np.array(law["tangent"], dtype=np.int64)
    nq, nv, m = len(model["coordinates"]), len(model["velocities"]), len(model["rows"])
    spins = np.array([j for _, j in model["spins"]], dtype=np.int64)
    return Pattern(nq, nv, m, law["unknowns"], places[:, 0].copy(), places[:, 1].copy(), spins, NOTHING)


@pytest.mark.by_turns(3)
@pytest.mark.slow_cases(
    "ggl-bricard",
    "ggl-flyball-governor",
    "index3-augmented-lagrangian-bricard",
    "index3-augmented-lagrangian-flyball-governor",
    "generalized-alpha-bricard",
    "generalized-alpha-flyball-governor",
)
@pytest.mark.parametrize("name", ["four-bar", "n-four-bar:3", "bricard", "flyball-governor"])
@pytest.mark.parametrize("method", ["ggl", "generalized-alpha", "index3-augmented-lagrangian"])
def test_plans_put_numbers_where_the_formula_says(name, method):
    pattern = pattern_of(name, method)
    rng = np.random.default_rng(5)
    n, nq, nv, width = pattern.unknowns, pattern.nq, pattern.nv, pattern.width
    stages = 2 if method == "ggl" else 1
    values = rng.uniform(-1.0, 1.0, (stages, pattern.size))
    by = np.zeros((stages, n, n + width))
    for s in range(stages):
        np.add.at(by[s], (pattern.rows, pattern.columns), values[s])
    if method == "ggl":
        a, h = rng.uniform(-1.0, 1.0, (2, 2)), 0.3
        plan, numbers = stage_plan(pattern, a, 2 * pattern.size)
        sparse.assemble_matrix(plan, np.append(values, 1.0), np.append(1.0, h * a), numbers)
        expected = np.block([[(i == j) * by[i][:, :n] for j in range(2)] for i in range(2)])
        for i in range(2):
            for j in range(2):
                expected[i * n : (i + 1) * n, j * n : j * n + width] += h * a[i, j] * by[i][:, n:]
    else:
        projected = method != "generalized-alpha"
        plan, numbers, size = projection_plan(pattern) if projected else alpha_plan(pattern)
        sources = np.zeros(size)
        sources[: pattern.size], sources[-1] = values[0], 1.0
        delta = 0.2 * rng.uniform(-1.0, 1.0, nv)
        sparse.multiply_sources(plan, sources)
        sparse.turn_rows(plan, sources, delta)
        sparse.assemble_matrix(plan, sources, np.array([1.0, 0.7, 0.4, -0.4, 30.0]), numbers)
        motion = np.eye(nv)
        if nq != nv:
            motion = -by[0][:nq, n + nq :]
            for j in pattern.spins:
                x, y, z = delta[j : j + 3]
                skew = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
                motion[:, j : j + 3] = motion[:, j : j + 3] @ (np.eye(3) - 0.5 * skew + skew @ skew / 6.0)
        expected = by[0][nq:, nq:n].copy()
        expected[:, :nv] += 0.7 * by[0][nq:, n + nq :] + 0.4 * by[0][nq:, n : n + nq] @ motion
        if projected:
            forces = by[0][nq:width, width:n]
            expected = expected[:nv, :nv] + 30.0 * forces @ forces.T
    found, size = np.zeros(expected.shape), plan[sparse.SIZE]
    begins, order = plan[plan[sparse.COLUMNS] :][: size + 1], plan[plan[sparse.ORDER] :][:size]
    rows = plan[plan[sparse.ROWS] :][: plan[sparse.ENTRIES]]
    for k in range(size):
        found[rows[begins[k] : begins[k + 1]], order[k]] = numbers[begins[k] : begins[k + 1]]
    np.testing.assert_allclose(found, expected, rtol=0.0, atol=1e-13)


@pytest.mark.parametrize("pair", newton.PAIRS)
def test_factors_of_a_row_of_windows_grow_with_its_length(pair):
    """Entries of L and U are proportional to the number of windows: so are time and memory."""
    small, middle, large = (newton.factors(f"n-four-bar:{n}", pair) for n in (10, 20, 40))
    assert small["skipped"] == middle["skipped"] == large["skipped"] == 0
    for key in ("unknowns", "entries", "stored"):
        assert large[key] - middle[key] == pytest.approx(2 * (middle[key] - small[key]), rel=0.05)
    assert large["stored"] < 5 * large["entries"]


def test_a_stage_of_lagrange_fills_little():
    pattern = pattern_of("n-four-bar:4", "lagrange")
    order, fill = elimination_order(pattern.unknowns, pattern.rows, pattern.columns % pattern.unknowns)
    assert sorted(order) == list(range(pattern.unknowns))
    assert fill < 2 * pattern.size
