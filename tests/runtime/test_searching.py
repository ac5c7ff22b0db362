"""The search for events as compiled code: from its source, so that a first run with events does not wait for Numba."""

import numpy as np
import pytest

from symgen.native.library import kinds_of
from symgen.runtime import abi, searching, switching


def test_the_search_is_in_the_language_of_emitted_code():
    """`read` raises where a function, or one that it calls, would be left to Numba."""
    function = searching.decide.read(kinds_of(abi.DECIDE.signature.args))
    assert {f.name for f in function.called} >= {
        "look",
        "keep",
        "give_back",
        "take_in",
        "candidate",
        "settle",
        "hidden",
    }


def test_the_first_root_of_a_cubic_is_numpys():
    """Against the roots of the polynomial with these values and slopes at both ends."""
    rng, met = np.random.default_rng(1), 0
    for _ in range(300):
        g0, d0, g1, d1 = 1.0, 6.0 * rng.standard_normal(), -rng.uniform(0.1, 2.0), 6.0 * rng.standard_normal()
        rise = g1 - g0
        roots = np.roots([d0 + d1 - 2.0 * rise, 3.0 * rise - 2.0 * d0 - d1, d0, g0])
        inside = sorted(r.real for r in roots if abs(r.imag) < 1e-9 and 0.0 < r.real < 1.0)
        gaps = np.diff(inside)
        if gaps.size and gaps.min() < 1e-3:
            continue  # a double root, which rounding has or has not
        met += 1
        # roots of a polynomial with coefficients near 10 and gaps above 1e-3: rounding over its slope there
        assert switching.first_root(g0, d0, g1, d1, 1.0) == pytest.approx(inside[0], abs=1e-9)
    assert met > 250
