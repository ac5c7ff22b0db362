"""Constant steps of the classical Runge-Kutta scheme that end at events, for programs without loops of their own."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from symgen.layout import abi
from symgen.layout.start_records import INSTANT, LAYOUT, record_type
from symgen.loopcode.bare import part
from symgen.loopcode.exact import exact
from symgen.native import types

_F, _A, _K = types.float64, types.float64[::1], types.int64[::1]

#: Bisections of a step, and roundings of the time at which they end.
MOST_HALVES, FINEST = 60, 5.0 * 2.0**-52
#: Layout, ``rhs`` and its confirmation, ``accept``, switching functions, and the direction of each event: 1 or -1 where
#: its function rises or falls, 0 for both, 2 for events that change nothing.
STEP_MODEL = types.RecordType((LAYOUT, abi.RHS, abi.RHS, abi.ACCEPT, abi.OBSERVE, _K))
#: Working memory.
#: - stages, middle: Rates at the four stages; the state at a stage.
#: - y, w, before, after: State and scratch at the beginning; switching functions at both ends of a step.
#: - counters, chosen: Counters at the beginning; 1 for each event at the end of the step, else 0.
STEP_WORK = record_type("StepWork", __name__, ("stages middle y w before after", _A), ("counters chosen", _K))
StepWork: Any = STEP_WORK.constructor


def new_step_work(ny: int, nw: int, events: int) -> Any:
    """Return working memory."""
    sizes = 4 * ny, ny, ny, nw, events, events
    integers = (np.zeros(size, dtype=np.int64) for size in (abi.N_COUNTERS, events))
    return StepWork._make((*(np.zeros(size) for size in sizes), *integers))


@exact()
def find_rates(model: Any, t: float, y: Any, now: Any, iw: Any, rate: Any) -> None:
    """Set the rates of a state; where a pivot is suspicious, they are confirmed."""
    _, rhs, confirm, _, _, _ = model
    if rhs(t, y, now.p, now.w, iw, rate) != 0:
        confirm(t, y, now.p, now.w, iw, rate)


@exact()
def take_step(model: Any, t: float, h: float, now: Any, iw: Any, work: Any) -> bool:
    """Make a step; return whether it succeeds."""
    layout, _, _, accept, _, _ = model
    y, middle, n = now.y, work.middle, layout.ny
    now.w[abi.STEP_STATUS] = h
    a, b = part(work.stages, 0, n), part(work.stages, n, n)
    c, d = part(work.stages, 2 * n, n), part(work.stages, 3 * n, n)
    find_rates(model, t, y, now, iw, a)
    for i in range(n):
        middle[i] = y[i] + 0.5 * h * a[i]
    find_rates(model, t + 0.5 * h, middle, now, iw, b)
    for i in range(n):
        middle[i] = y[i] + 0.5 * h * b[i]
    find_rates(model, t + 0.5 * h, middle, now, iw, c)
    for i in range(n):
        middle[i] = y[i] + h * c[i]
    find_rates(model, t + h, middle, now, iw, d)
    for i in range(n):
        y[i] += h / 6.0 * (a[i] + 2.0 * (b[i] + c[i]) + d[i])
    failed = accept(t + h, y, now.p, now.w, iw) % 2 != 0
    for i in range(n):
        failed = failed or not math.isfinite(y[i])
    return not failed


@exact()
def restore(now: Any, iw: Any, work: Any) -> None:
    """Go back to the beginning of the step."""
    for i in range(now.y.shape[0]):
        now.y[i] = work.y[i]
    for i in range(now.w.shape[0]):
        now.w[i] = work.w[i]
    for i in range(iw.shape[0]):
        iw[i] = work.counters[i]


@exact()
def attempt(model: Any, t: float, h: float, now: Any, iw: Any, work: Any) -> int:
    """Make a step from its beginning; return the number of events in it, -1 where it fails."""
    _, _, _, _, happens, directions = model
    restore(now, iw, work)
    if not take_step(model, t, h, now, iw, work):
        return -1
    happens(t + h, now.y, now.p, now.w, work.middle, work.after)
    count = 0
    for k in range(directions.shape[0]):
        before, after, direction = work.before[k], work.after[k], directions[k]
        rises, falls = before < 0.0 and after >= 0.0, before > 0.0 and after <= 0.0
        meant = (rises and (direction == 0 or direction == 1)) or (falls and (direction == 0 or direction == -1))
        work.chosen[k] = 1 if meant else 0
        count += work.chosen[k]
    return int(count)


@exact(types.float64(STEP_MODEL, _F, _F, INSTANT, _K, STEP_WORK))
def step_to_event(model: Any, t: float, h: float, now: Any, iw: Any, work: Any) -> float:
    """Make a step, or a shorter one to the first event in it.

    Parameters
    ----------
    model : tuple
        See `STEP_MODEL`.
    t, h : float
        Time and step [s].
    now, iw : Instant, Array of int
        State of the run and counters.
    work : StepWork
        Working memory; `chosen` has the events at the end.

    Returns
    -------
    float
        Length of the step, nan where it failed.
    """
    _, _, _, _, happens, _ = model
    for i in range(now.y.shape[0]):
        work.y[i] = now.y[i]
    for i in range(now.w.shape[0]):
        work.w[i] = now.w[i]
    for i in range(iw.shape[0]):
        work.counters[i] = iw[i]
    happens(t, now.y, now.p, now.w, work.middle, work.before)
    count = attempt(model, t, h, now, iw, work)
    low, high = 0.0, h
    if count > 0:
        for _ in range(MOST_HALVES):
            if count < 0 or not high - low > FINEST * (1.0 + abs(t)):
                break
            middle = 0.5 * (low + high)
            count = attempt(model, t, middle, now, iw, work)
            low, high = (low, middle) if count > 0 else (middle, high)
        if count >= 0:
            count = attempt(model, t, high, now, iw, work)
    return high if count >= 0 else math.nan
