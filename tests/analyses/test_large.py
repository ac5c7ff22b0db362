"""Lowest modes by sparse matrices: zeros of Laguerre polynomials, found by Newton's method with 40 digits."""

from __future__ import annotations

import mpmath
import numpy as np
import pytest
from numpy.testing import assert_allclose

from analyses import rods
from symgen.errors import InputError


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


def test_what_lowest_modes_are_not_for():
    with pytest.raises(InputError, match="modes about an equilibrium"):
        rods.chain(3).modes(count=2, at="start")
    with pytest.raises(InputError, match="count"):
        rods.chain(3).modes(count=0)
