"""How often random tests try, and how numbers are compared."""

import os
from collections.abc import Mapping

import numpy as np
from hypothesis import Phase, settings

#: Random inputs are drawn anew by every run; a failure prints the case. SYMGEN_EXAMPLES asks for more of them.
RANDOM = settings(
    max_examples=int(os.environ.get("SYMGEN_EXAMPLES", "4")),
    database=None,
    phases=[Phase.explicit, Phase.generate, Phase.shrink],
)


#: Of the largest number: what two ways of making one run may differ by.
ROUNDING = 1e-12


def assert_same_motion(found, expected, what: str = "") -> None:
    """Compare rows of sweeps, lanes and runs step by step with single runs: the same motion to rounding."""
    close(found, expected, what, ROUNDING)


def close(found, expected, what: str, tolerance: float = 2e-11) -> None:
    """Compare numbers up to rounding on the scale of the largest expected one, at least 1."""
    expected = np.asarray(expected, dtype=float)
    scale = max(1.0, float(np.abs(expected[np.isfinite(expected)]).max(initial=0.0)))
    np.testing.assert_allclose(found, expected, rtol=0.0, atol=tolerance * scale, err_msg=what)


def assert_same_arrays(found: Mapping[str, np.ndarray], expected: Mapping[str, np.ndarray]) -> None:
    """Arrays by name are equal bit for bit."""
    for name, array in expected.items():
        np.testing.assert_array_equal(found[name], array, err_msg=name)
