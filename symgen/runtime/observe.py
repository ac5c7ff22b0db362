"""Quantities wanted at outputs only: accelerations, multipliers, joint coordinates, residuals."""

from __future__ import annotations

from typing import Any

import numpy as np
from numba import types

from symgen.runtime import abi
from symgen.store.jit import jit

_WINDING = abi.WINDING
_A, _I, _M, _I8 = types.float64[::1], types.int64[::1], types.float64[:, ::1], types.int64


@jit()
def fill_rates(
    rhs: Any,
    confirm: Any,
    accept: Any,
    times: Any,
    states: Any,
    angles: Any,
    p: Any,
    w: Any,
    iw: Any,
    nq: int,
    multipliers: int,
    accelerations: Any,
    lam: Any,
    y: Any,
    rate: Any,
) -> None:
    """Do the work of `observe_rates`; `y` and `rate` are working memory for a state each."""
    for k in range(times.shape[0]):
        for i in range(y.shape[0]):
            y[i] = states[k, i]
        for i in range(angles.shape[1]):
            w[_WINDING + i] = angles[k, i]
        accept(times[k], y, p, w, iw)  # brings along what a method remembers: a partition, a basis
        if rhs(times[k], y, p, w, iw, rate) != 0:
            confirm(times[k], y, p, w, iw, rate)
        for i in range(accelerations.shape[1]):
            accelerations[k, i] = rate[nq + i]
        for i in range(lam.shape[1]):
            lam[k, i] = w[multipliers + i]


@jit(_I8(abi.RHS, abi.RHS, abi.ACCEPT, _A, _M, _M, _A, _A, _I, _I8, _I8, _M, _M))
def observe_rates(
    rhs: Any,
    confirm: Any,
    accept: Any,
    times: Any,
    states: Any,
    angles: Any,
    p: Any,
    w: Any,
    iw: Any,
    nq: int,
    multipliers: int,
    accelerations: Any,
    lam: Any,
) -> int:
    """Evaluate v' and lambda at every output.

    Parameters
    ----------
    rhs, confirm, accept : emitted functions
        See `symgen.runtime.abi`.
    times, states : Array, shapes (k,), (k, ny)
        The outputs, in the order of time.
    angles : Array, shape (k, number of angles whose turns are counted)
        What the section ``winding`` held at the outputs.
    nq, multipliers : int
        Number of coordinates, and where the multipliers begin in `w`.
    accelerations, lam : Array, shapes (k, nv), (k, m)
        Results.
    """
    y = np.zeros(states.shape[1])
    rate = np.zeros(states.shape[1])
    fill_rates(rhs, confirm, accept, times, states, angles, p, w, iw, nq, multipliers, accelerations, lam, y, rate)
    return 0


@jit()
def fill_rows(
    observe: Any,
    times: Any,
    states: Any,
    accelerations: Any,
    angles: Any,
    p: Any,
    w: Any,
    nq: int,
    observed: Any,
    y: Any,
    rate: Any,
    out: Any,
) -> None:
    """Do the work of `observe_rows`; `y`, `rate` and `out` are working memory for a state each and for a row."""
    for k in range(times.shape[0]):
        for i in range(y.shape[0]):
            y[i] = states[k, i]
        for i in range(accelerations.shape[1]):
            rate[nq + i] = accelerations[k, i]
        for i in range(angles.shape[1]):
            w[_WINDING + i] = angles[k, i]
        observe(times[k], y, p, w, rate, out)
        for i in range(observed.shape[1]):
            observed[k, i] = out[i]


@jit(_I8(abi.OBSERVE, _A, _M, _M, _M, _A, _A, _I8, _M))
def observe_rows(
    observe: Any,
    times: Any,
    states: Any,
    accelerations: Any,
    angles: Any,
    p: Any,
    w: Any,
    nq: int,
    observed: Any,
) -> int:
    """Evaluate D v' - gamma and the joint coordinates with their rates at every output.

    Parameters
    ----------
    observe : emitted function
        See `symgen.runtime.abi`.
    times, states, accelerations : Array, shapes (k,), (k, ny), (k, nv)
        The outputs.
    angles : Array, shape (k, number of angles whose turns are counted)
        What the section ``winding`` held at the outputs.
    observed : Array, shape (k, m + 2 n)
        Result, in the order that ``observe`` writes.
    """
    y = np.zeros(states.shape[1])
    rate = np.zeros(states.shape[1])
    out = np.zeros(max(1, observed.shape[1]))
    fill_rows(observe, times, states, accelerations, angles, p, w, nq, observed, y, rate, out)
    return 0
