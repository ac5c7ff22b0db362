"""Quantities that are wanted at outputs only: accelerations, multipliers, joint coordinates, acceleration violations."""

from __future__ import annotations

from typing import Any

import numpy as np
from numba import types

from symgen.runtime import abi
from symgen.store.jit import jit

_A, _I, _M = types.float64[::1], types.int64[::1], types.float64[:, ::1]


@jit(types.int64(abi.RHS, abi.RHS, abi.OBSERVE, _A, _M, _A, _A, _I, types.int64, types.int64, types.int64, types.int64, _M, _M, _M))
def observe_outputs(
    rhs: Any,
    confirm: Any,
    observe: Any,
    times: Any,
    states: Any,
    p: Any,
    w: Any,
    iw: Any,
    nq: int,
    nv: int,
    m: int,
    multipliers: int,
    accelerations: Any,
    lam: Any,
    observed: Any,
) -> int:
    """Evaluate v', lambda and what ``observe`` gives at every output.

    Parameters
    ----------
    rhs, confirm, observe : emitted functions
        See `symgen.runtime.abi`.
    times, states : Array, shapes (k,), (k, ny)
        The outputs.
    nq, nv, m, multipliers : int
        Sizes, and where the multipliers begin in `w`.
    accelerations, lam, observed : Array
        Results, one row an output.
    """
    y = np.zeros(states.shape[1])
    rate = np.zeros(states.shape[1])
    out = np.zeros(max(1, observed.shape[1]))
    for k in range(times.shape[0]):
        for i in range(y.shape[0]):
            y[i] = states[k, i]
        if rhs(times[k], y, p, w, iw, rate) != 0:
            confirm(times[k], y, p, w, iw, rate)
        observe(times[k], y, p, w, rate, out)
        for i in range(nv):
            accelerations[k, i] = rate[nq + i]
        for i in range(m):
            lam[k, i] = w[multipliers + i]
        for i in range(observed.shape[1]):
            observed[k, i] = out[i]
    return 0
