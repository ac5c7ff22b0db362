"""Emitted functions compiled here against the same functions compiled by Numba: equal to rounding.

They are compared on a processor without fused multiply-add. With it the compiler is free to choose the product that a
sum takes in, and chooses by what stands around it: two right translations of one function may differ in a last bit,
and behind a cancellation in any.
"""

import pytest
from support.rotation import of_turn

from symgen.derive.methods import METHODS

from .twofold import apart

#: Methods of every kind of law and correction, each with a model that needs them.
KINDS = ("lagrange", "augmented-lagrangian", "null-space", "coordinate-partitioning", "ggl", "direct-correction")
#: Models with all kinds of elements, and every other method in some turn, as most of their functions are those of
#: another method. Numba compiles all of them: one case runs in a turn.
CASES = (
    ("pendulum", KINDS[1:5]),
    ("everything", KINDS[:1]),
    ("rough", KINDS[:1]),
    ("slider-crank", of_turn((name for name in METHODS if name not in KINDS), 3)),
    ("rolling-disc", KINDS[5:]),
)


@pytest.mark.by_turns(2)
@pytest.mark.slow
@pytest.mark.parametrize(("model", "methods"), [pytest.param(*case, id=case[0]) for case in of_turn(CASES, 5)])
def test_functions_are_numbas(model, methods):
    assert apart(model, *methods) == ""
