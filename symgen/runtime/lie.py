"""The loop of explicit Runge-Kutta-Munthe-Kaas schemes: bodies turn by exponentials, not by their Euler parameters.

Within a step the position is ``q0`` moved by u, bodies turned by the exponential of their part of it, and the scheme
integrates u and v. In body axes ``u' = omega + u x omega / 2 + u x (u x omega) / 12``, the series of the inverse
differential of the exponential to the terms that order 4 needs (Munthe-Kaas 1999; Hairer, Lubich, Wanner, Geometric
Numerical Integration, IV.8). Coordinates that are no rotations have u' = v.
"""

from __future__ import annotations

from typing import Any

from numba import types

from symgen.runtime import abi
from symgen.runtime.bare import bare, part
from symgen.runtime.manifold import advance
from symgen.runtime.steps import store
from symgen.runtime.watch import begin, keep_maxima, watch
from symgen.store.jit import jit

_F8, _I8 = types.float64, types.int64
_A, _I, _M = types.float64[::1], types.int64[::1], types.float64[:, ::1]

_STOP, _STEPS, _EVALUATIONS, _OUTPUTS = abi.STOP, abi.STEPS, abi.EVALUATIONS, abi.OUTPUTS
_DONE, _STOPPED, _CORRECTION, _NOT_FINITE = abi.DONE, abi.STOPPED, abi.CORRECTION, abi.NOT_FINITE
_PROBING, _PHI, _STEP_STATUS = abi.PROBING, abi.PHI, abi.STEP_STATUS


@jit()
def exponential_rate(v: Any, at: int, u: Any, spins: Any, nv: int, rate: Any, to: int) -> None:
    """Write u' for velocities that begin at index `at` of `v` to `rate`, from index `to` on."""
    for i in range(nv):
        rate[to + i] = v[at + i]
    for s in range(spins.shape[0]):
        j = spins[s]
        x, y, z = u[j], u[j + 1], u[j + 2]
        a, b, c = v[at + j], v[at + j + 1], v[at + j + 2]
        p, q, r = y * c - z * b, z * a - x * c, x * b - y * a
        rate[to + j] += 0.5 * p + (y * r - z * q) / 12.0
        rate[to + j + 1] += 0.5 * q + (z * p - x * r) / 12.0
        rate[to + j + 2] += 0.5 * r + (x * q - y * p) / 12.0


@jit(
    _I8(
        *(abi.RHS, abi.RHS, abi.ACCEPT, abi.MOVE, _A, _A, _A, _I8, _I8, _I8, _I8),
        *(_A, _A, _A, _I, _F8, _F8, _F8, _A, _M, _M, _A, _I, _A, _A, _I),
    ),
)
def lie_steps(
    rhs: Any,
    confirm: Any,
    accept: Any,
    turn: Any,
    a: Any,
    b: Any,
    c: Any,
    n_stages: int,
    nq: int,
    nv: int,
    changes: int,
    y: Any,
    p: Any,
    w: Any,
    iw: Any,
    t0: float,
    h: float,
    until: float,
    times: Any,
    states: Any,
    status: Any,
    gauges: Any,
    control: Any,
    events: Any,
    room: Any,
    spins: Any,
) -> int:
    """Integrate with constant steps; an output between two steps is reached by a shortened step of its own.

    Parameters
    ----------
    a, b, c : Array
        The tableau, `a` row by row.
    changes : int
        Where the section ``change`` begins in `w`.
    room : Array
        Working memory.
    spins : Array of int
        Where the angular velocities of bodies begin in v.
    """
    width, ny, n = nq + nv, nq + nv + 1, 2 * nv + 1  # of a stage: u', v' and the power
    y, p, w, iw = bare(y), bare(p), bare(w), bare(iw)
    gauges, control, events, status, states = bare(gauges), bare(control), bare(events), bare(status), bare(states)
    at = 0
    trial = part(room, at, ny)
    at += ny
    rate = part(room, at, ny)
    at += ny
    moved = part(room, at, n)
    at += n
    stages = part(room, at, n_stages * n)

    t, out, tiny, index = t0, 0, 1e-9 * h, 0
    accept(t, y, p, w, iw)
    begin(w, gauges)
    code = watch(t, y, nq, w, gauges, control, events)
    if code != _DONE:
        return code
    while out < times.shape[0] and times[out] <= t + tiny:
        store(out, y, w, states, status)
        out += 1
    control[_OUTPUTS] = out
    while t < until - tiny:
        if control[_STOP] != 0:
            return _STOPPED
        following = t0 + (index + 1) * h
        step = h
        if following > until - tiny:
            following = until
            step = until - t
        partial = out < times.shape[0] and times[out] < following - tiny
        if partial:
            following = times[out]
            step = following - t
        w[_STEP_STATUS] = step
        for s in range(n_stages + 1):
            for i in range(n):
                moved[i] = 0.0
            for r in range(min(s, n_stages)):
                weight = step * (a[s * n_stages + r] if s < n_stages else b[r])
                if weight != 0.0:
                    for i in range(n):
                        moved[i] += weight * stages[r * n + i]
            advance(nq, nv, y, moved, trial, w, changes, turn)
            for i in range(nv):
                trial[nq + i] = y[nq + i] + moved[nv + i]
            trial[width] = y[width] + moved[2 * nv]
            if s == n_stages:
                break
            if rhs(t + c[s] * step, trial, p, w, iw, rate) != 0:
                confirm(t + c[s] * step, trial, p, w, iw, rate)
            control[_EVALUATIONS] += 1
            exponential_rate(trial, nq, moved, spins, nv, stages, s * n)
            for i in range(nv + 1):
                stages[s * n + nv + i] = rate[nq + i]
        iw[_PROBING] = 1 if partial else 0
        bits = accept(following, trial, p, w, iw)
        iw[_PROBING] = 0
        if partial:
            keep_maxima(w, trial[width], gauges)
            store(out, trial, w, states, status)
            out += 1
            control[_OUTPUTS] = out
            continue
        if bits & 1:
            return _CORRECTION if w[_PHI] == w[_PHI] else _NOT_FINITE
        y, trial = trial, y
        t = following
        index += 1
        control[_STEPS] = index
        code = watch(t, y, nq, w, gauges, control, events)
        if code != _DONE:
            return code
        if out < times.shape[0] and times[out] <= t + tiny:
            store(out, y, w, states, status)
            out += 1
            control[_OUTPUTS] = out
    return _DONE
