"""Single evaluations of emitted functions from Python, at the price of one cached compilation for all models."""

from __future__ import annotations

from typing import Any

from numba import types

from symgen.runtime import abi
from symgen.store.jit import jit

_F8, _A, _I = types.float64, types.float64[::1], types.int64[::1]


@jit(types.int64(abi.MEASURE, _F8, _A, _A, _A))
def call_measure(function: Any, t: float, y: Any, p: Any, w: Any) -> int:
    """Call ``geometry``."""
    return int(function(t, y, p, w))


@jit(types.int64(abi.RHS, _F8, _A, _A, _A, _I, _A))
def call_rhs(function: Any, t: float, y: Any, p: Any, w: Any, iw: Any, ydot: Any) -> int:
    """Call ``rhs``."""
    return int(function(t, y, p, w, iw, ydot))
