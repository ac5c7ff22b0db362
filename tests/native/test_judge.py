"""Functions made from their source against the same functions compiled by Numba: equal to the last bit.

They are compared on a processor without fused multiply-add. With it the compiler is free to choose the product that a
sum takes in, and chooses by what stands around it: two right translations of one function may differ in a last bit.
"""

from __future__ import annotations

import pytest

from symgen.methods import METHODS

from .twofold import apart

#: Small models with methods of every kind of law and correction.
SMALL = (
    ("pendulum", ("lagrange",)),
    ("pendulum", ("augmented-lagrangian", "null-space", "coordinate-partitioning", "ggl")),
    ("four-bar", ("direct-correction", "index1-augmented-lagrangian")),
    ("rough", ("lagrange",)),
)


#: The same, larger ones, and every other method once: minutes, nearly all of them Numba's.
CASES = (
    *SMALL,
    *(("slider-crank", (name,)) for name in METHODS if not any(name in methods for _, methods in SMALL)),
    ("everything", ("lagrange",)),
    ("rolling-disc", ("direct-correction",)),
)


@pytest.mark.slow
@pytest.mark.parametrize(("model", "methods"), CASES, ids=[f"{model}-{methods[0]}" for model, methods in CASES])
def test_functions_are_numbas(model, methods):
    assert apart(model, *methods) == ""
