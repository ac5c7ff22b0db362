"""Functions made from their source against the same functions compiled by Numba: equal to the last bit.

They are compared on a processor without fused multiply-add. With it the compiler is free to choose the product that a
sum takes in, and chooses by what stands around it: two right translations of one function may differ in a last bit.
"""

from __future__ import annotations

import pytest

from symgen.methods import METHODS

from .twofold import apart

#: Small models with methods of every kind of law and correction; the usual tests try the first.
SMALL = (
    ("pendulum", ("lagrange",)),
    ("pendulum", ("augmented-lagrangian", "null-space", "coordinate-partitioning", "ggl")),
    ("four-bar", ("direct-correction", "index1-augmented-lagrangian")),
    ("rough", ("lagrange",)),
)


@pytest.mark.parametrize(
    ("model", "methods"),
    [pytest.param(*case, marks=() if i == 0 else pytest.mark.slow) for i, case in enumerate(SMALL)],
    ids=[f"{model}-{methods[0]}" for model, methods in SMALL],
)
def test_functions_of_small_models(model, methods):
    assert apart(model, *methods) == ""


#: Larger ones, and every other method once: minutes, nearly all of them Numba's.
LONG = (
    *(("slider-crank", (name,)) for name in METHODS if not any(name in methods for _, methods in SMALL)),
    ("everything", ("lagrange",)),
    ("spatial-slider-crank", ("direct-correction",)),
    ("rolling-disc", ("direct-correction",)),
)


@pytest.mark.slow
@pytest.mark.parametrize(("model", "methods"), LONG, ids=[f"{model}-{methods[0]}" for model, methods in LONG])
def test_functions_of_every_method(model, methods):
    assert apart(model, *methods) == ""
