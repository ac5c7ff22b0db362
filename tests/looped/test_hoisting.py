"""Loops that fill numbers of a run, interpreted and compiled, beside NumPy's sums."""

import numpy as np
import pytest

from symgen.compile.loopcode.exact import compiled_form, plain_form
from symgen.run.starts.hoisting import copy_masses, sum_products


@pytest.mark.parametrize("form", [plain_form, compiled_form])
def test_sums_and_masses_are_those_of_numpy(form) -> None:
    chance, size, count = np.random.default_rng(5), 7, 40
    targets, velocities = chance.integers(0, size, count), chance.integers(0, 4, count)
    products, ones = chance.standard_normal(count), np.array([2, 5])
    p = chance.standard_normal(30)
    inverse = p[2:6].copy()
    assert form(sum_products)(np.array([10, 18, size, 2]), targets, velocities, products, ones, p) == 0
    for first, weights in ((10, products), (18, products * inverse[velocities])):
        expected = np.bincount(targets, weights, size)
        expected[ones] = 1.0
        assert (p[first : first + size] == expected).all()
    w, before = np.zeros(9), p.copy()
    assert form(copy_masses)(np.array([4, 3, 5]), np.array([1, 20, 4, 21, 1, 22]), p, w) == 0
    own = p[4:9].copy()
    own[1], own[4] = own[1] + p[20] + p[22], own[4] + p[21]
    assert (w == [0.0, 0.0, 0.0, *own, 0.0]).all() and (p == before).all()
