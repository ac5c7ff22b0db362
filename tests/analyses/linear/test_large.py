"""Equilibria and lowest modes by sparse matrices: zeros of Laguerre polynomials with 40 digits, and a catenary."""

import mpmath
import numpy as np
import pytest
import scipy.sparse
from numpy.testing import assert_allclose

import symgen
from analyses import rods
from analyses.rest.test_equilibrium import CATENARY, STABLE, STARTS
from symgen.analyses.linear.large import _far_negative_square
from symgen.base.errors import InputError


def laguerre_zeros(n, near):
    """Zeros of L_n by Newton's method on its recurrence."""
    found = []
    with mpmath.workdps(40):
        for x in map(mpmath.mpf, near):
            for _ in range(8):
                a, b = mpmath.mpf(1), 1 - x
                for k in range(1, n):
                    a, b = b, ((2 * k + 1 - x) * b - k * a) / (k + 1)
                x -= b * x / (n * (b - a))
            found.append(float(x))
    return np.array(found)


@pytest.mark.slow  # looped code of an implicit law is compiled
@pytest.mark.parametrize("n", [60, 1000])
def test_the_lowest_modes_of_a_long_chain(n):
    found = rods.chain(n).modes(count=10)
    zeros = laguerre_zeros(n, found.omega_squared / rods.GRAVITY)
    assert np.all(np.diff(zeros) > 0.0) and 0.9 < zeros[0] / (1.4458 / (n + 0.5)) < 1.1  # j_0^2 / 4 over n + 1/2
    assert_allclose(found.omega_squared, rods.GRAVITY * zeros, rtol=1e-10)
    assert found.degrees_of_freedom == n and len(found.eigenvalues) == 20
    assert_allclose(sum(found.participation.values()), 1.0, rtol=1e-12)
    moved = np.abs(found.shapes[:, -2:]) ** 2  # masses are 1 kg, and shapes normalised by them
    assert_allclose(found.participation[f"m{n - 1}"], moved.sum(axis=1), rtol=1e-9)


def test_what_lowest_modes_are_not_for():
    with pytest.raises(InputError, match="modes about an equilibrium"):
        rods.chain(3).modes(count=2, at="start")
    with pytest.raises(InputError, match="count"):
        rods.chain(3).modes(count=0)


@pytest.mark.slow
@pytest.mark.parametrize("start", STARTS)
def test_links_hang_as_a_catenary_by_sparse_matrices(start):
    found = rods.catenary(STARTS[start]).equilibrium(shape="looped")
    force, lowest, angle = CATENARY
    assert_allclose(abs(found.multipliers["j0.x"]), force, rtol=1e-11)
    assert_allclose(found.q["l0.theta"] % (2.0 * np.pi) - 2.0 * np.pi, angle, rtol=1e-11)
    assert found.stability == "stable" and abs(found.q["l4.y"] + 0.1 * np.sin(found.q["l4.theta"]) - lowest) < 1e-11


@pytest.mark.slow
def test_redundant_rows_are_the_same_by_sparse_matrices():
    dense, sparse = (rods.four_bar(doubled=True).equilibrium(shape=shape) for shape in ("straight", "looped"))
    assert sparse.q.keys() == dense.q.keys() and sparse.not_unique == dense.not_unique == ("D", "D2", "link")
    assert_allclose(sparse.q["crank.theta"] % (2.0 * np.pi), STABLE[0], rtol=1e-12)
    assert_allclose(sparse.omega_squared, STABLE[1], rtol=1e-12)
    for name, value in dense.multipliers.items():
        assert sparse.multipliers[name] == pytest.approx(value, abs=1e-11)


@pytest.mark.slow
def test_large_mechanisms_of_one_freedom_have_its_frequency():
    """Too large for dense matrices, with fewer frequencies than are asked for otherwise; beside straight code."""
    looped, straight = (symgen.load("n-four-bar:20").equilibrium(shape=shape) for shape in ("looped", "straight"))
    assert len(looped.omega_squared) == len(straight.omega_squared) == 1
    assert looped.stability == straight.stability
    assert_allclose(looped.omega_squared, straight.omega_squared, rtol=1e-9)


@pytest.mark.slow
def test_many_links_hang_as_a_chain_does():
    """Their lowest joint approaches that of a catenary, an arc of 2 m over 1 m."""
    half = 0.5 * 2.0
    a = float(mpmath.findroot(lambda x: 2 * x * mpmath.sinh(0.5 / x) - 2.0, 0.23))
    depth = float(np.hypot(a, half) - a)
    lowest = [
        -min(
            rods.catenary(lambda i, n=n: -1.3 + 2.6 * (i + 0.5) / n, n).equilibrium(shape="looped").q[f"l{n // 2}.y"], 0
        )
        for n in (100, 200)
    ]
    assert abs(lowest[1] - depth) < 2e-4 and abs(lowest[1] - depth) < 0.6 * abs(lowest[0] - depth)


@pytest.mark.parametrize("falling", [-1e-3, -40.0, -1e5, -3e9])
def test_what_falls_far_beyond_what_is_near_is_seen(falling):
    squares = np.append(np.arange(1.0, 200.0), falling)
    stiffness, mass = (scipy.sparse.diags(x, format="csc") for x in (squares, np.ones(200)))
    rows = scipy.sparse.csc_matrix((0, 200))
    near = np.sort(squares[np.argsort(np.abs(squares))[:10]])
    found = _far_negative_square(stiffness, mass, rows, near)
    assert (near[0] < 0.0) or (found and found[0] == pytest.approx(falling, rel=1e-3))
    assert not _far_negative_square(scipy.sparse.diags(np.abs(squares), format="csc"), mass, rows, near)


@pytest.mark.slow
def test_looped_code_has_the_linear_system_of_straight_code():
    """Also with parameters, and in a chain whose masses are as many as its links."""
    ends = [rods.mass_spring_damper().linearise(shape=shape, by=("k",)) for shape in ("straight", "looped")]
    assert ends[0].states == ends[1].states and ends[0].inputs == ends[1].inputs == ("push", "k")
    for name in "ABCD":
        assert_allclose(getattr(ends[1], name), getattr(ends[0], name), rtol=1e-12, atol=1e-12)
    ends = [rods.chain(6).linearise(shape=shape) for shape in ("straight", "looped")]
    assert_allclose(ends[1].A, ends[0].A, rtol=1e-11, atol=1e-11)
