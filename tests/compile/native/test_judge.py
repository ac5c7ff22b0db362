"""Emitted functions compiled here against the same functions compiled by Numba: equal to rounding.

They are compared on a processor without fused multiply-add. With it the compiler is free to choose the product that a
sum takes in, and chooses by what stands around it: two right translations of one function may differ in a last bit,
and behind a cancellation in any.
"""

import pytest

from symgen.derive.methods import METHODS

from .twofold import apart

#: Small models with methods of every kind of law and correction.
SMALL = (
    ("pendulum", ("lagrange",)),
    ("pendulum", ("augmented-lagrangian", "null-space", "coordinate-partitioning", "ggl")),
    ("four-bar", ("direct-correction", "index1-augmented-lagrangian")),
    ("rough", ("lagrange",)),
)


#: Every other method once, in one process, as most of their functions are those of another method; and larger models.
CASES = (
    *SMALL,
    ("slider-crank", tuple(name for name in METHODS if not any(name in methods for _, methods in SMALL))),
    ("everything", ("lagrange",)),
    ("rolling-disc", ("direct-correction",)),
)


@pytest.mark.slow
@pytest.mark.parametrize(("model", "methods"), [pytest.param(*case, id=f"{case[0]}-{case[1][0]}") for case in CASES])
def test_functions_are_numbas(model, methods):
    assert apart(model, *methods) == ""
