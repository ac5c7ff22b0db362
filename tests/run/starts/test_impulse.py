"""The smallest impulse: the equations of impact by NumPy, plain Python and printed C to the bit."""

import numpy as np
import pytest
from compile.native import printed

from symgen.compile.loopcode.exact import compiled_form, plain_form
from symgen.run.effects.accumulation import accumulation
from symgen.run.effects.applying import apply_effects
from symgen.run.effects.effects import impulse_along
from symgen.run.starts.impulse import new_impulse, smallest_impulse


def problem(seed, n, k, rank, massless=0):
    """Return M, C, c and v of a problem that has a solution; rows of C have the rank `rank`."""
    random = np.random.default_rng(seed)
    factor = random.normal(size=(n, n))
    factor[:, :massless] = 0.0
    mass = factor.T @ factor
    rows = random.normal(size=(k, rank)) @ random.normal(size=(rank, n))
    rows[:massless, :massless] += 3.0 * np.eye(massless)
    return mass, rows, rows @ random.normal(size=n), random.normal(size=n)


@pytest.mark.parametrize(
    ("n", "k", "rank", "massless"), [(6, 3, 3, 0), (6, 5, 3, 0), (9, 9, 9, 0), (4, 0, 0, 0), (6, 3, 3, 2), (1, 1, 1, 0)]
)
@pytest.mark.parametrize("seed", range(4))
def test_the_equations_of_impact(seed, n, k, rank, massless):
    mass, rows, values, v = problem(seed, n, k, rank, massless)
    matrix = np.block([[mass, -rows.T], [rows, np.zeros((k, k))]])
    expected = np.linalg.lstsq(matrix, np.concatenate([mass @ v, values]), rcond=1e-11)[0][:n]
    after, impulses, contradictory = impulse_along(mass, rows, values, v)
    assert not contradictory
    size = 1e-9 * max(1.0, np.abs(expected).max())
    np.testing.assert_allclose(after, expected, rtol=0.0, atol=size)
    np.testing.assert_allclose(rows @ after, values, rtol=0.0, atol=1e-12 * max(1.0, np.abs(rows).sum()))
    np.testing.assert_allclose(
        mass @ (after - v), rows.T @ impulses, rtol=0.0, atol=1e-9 * max(1.0, np.abs(mass).sum())
    )


@pytest.mark.parametrize("columns", [(1,), (2, 0), ()])
def test_velocities_that_nothing_couples_are_set_without_a_decomposition(columns):
    """A row of zeros more has the general solution."""
    random = np.random.default_rng(len(columns))
    mass, rows, v = np.diag([1.3, 1.3, 0.02]), np.eye(3)[list(columns)], random.normal(size=3)
    values = random.normal(size=len(columns))
    after, impulses, contradictory = impulse_along(mass, rows, values, v)
    general = impulse_along(mass, np.vstack([rows, np.zeros(3)]), np.append(values, 0.0), v)
    assert not contradictory
    np.testing.assert_allclose(after, general[0], rtol=0.0, atol=1e-14)
    np.testing.assert_allclose(impulses, general[1][:-1], rtol=0.0, atol=1e-14)
    assert impulse_along(mass, np.vstack([rows, rows]), np.append(values, values + 1.0), v)[2] == (len(columns) > 0)


def test_rows_that_contradict_each_other_are_noticed():
    mass, rows, values, v = problem(0, 5, 3, 2)
    assert not impulse_along(mass, rows, values, v)[2]
    assert impulse_along(mass, rows, values + np.array([0.0, 0.0, 1e-6]), v)[2]
    assert impulse_along(mass, rows, values * [1.0, np.nan, 1.0], v)[2]


@pytest.mark.slow
def test_plain_python_and_printed_c_have_the_bits_of_machine_code(tmp_path):
    signature = smallest_impulse.compiled.signature
    library = printed.Library({"smallest_impulse": printed.source_of(smallest_impulse, signature)}, tmp_path)
    forms = (
        compiled_form(smallest_impulse),
        plain_form(smallest_impulse),
        library.function("smallest_impulse", signature),
    )
    for seed in range(5):
        mass, rows, values, v = problem(seed, 6, 5, 3 + seed % 3)
        results = []
        for form in forms:
            work = new_impulse(6, 5)
            work.mass[:], work.rows[:], work.values[:] = mass.ravel(), rows.ravel(), values
            assert form(6, 5, v, work) == 0
            results.append(work)
        for other in results[1:]:
            printed.assert_same_bits(printed.arrays(other), printed.arrays(results[0]))


@pytest.mark.parametrize("function", [apply_effects, accumulation], ids=["effects", "accumulation"])
def test_effects_have_a_form_in_c(function):
    assert printed.source_of(function, function.compiled.signature)
