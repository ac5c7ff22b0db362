"""Constant steps of the classical Runge-Kutta scheme that end at events, for programs without loops of their own."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from symgen.compile.loopcode.exact import copy_numbers, exact
from symgen.compile.native.annotations import Array, Integers, Record
from symgen.run.effects.applying import EffectModel, EffectWork, apply_effects
from symgen.run.layout import abi
from symgen.run.layout.start_records import Instant, Layout

#: Bisections of a step, and roundings of the time at which they end.
MOST_HALVES, FINEST = 60, 5.0 * 2.0**-52
#: A last step is longer than the others by at most this share; where steps fail, they halve to this share of the time.
LONGER, NEAREST = 2e-12, 1e-9
#: Results of `take_steps`: the time is reached; an event ends the run; a step fails, or events contradict each other.
REACHED, ENDED, FAILED = range(3)
#: Layout, ``rhs`` and its confirmation, ``accept``, switching functions, and the direction of each event: 1 or -1 where
#: its function rises or falls, 0 for both, 2 for events that change nothing.
StepModel = tuple[Layout, abi.Rhs, abi.Rhs, abi.Accept, abi.Observe, Integers]
#: Steps, the effects of events, and 1 for each event that ends the run, else 0.
RunModel = tuple[StepModel, EffectModel, Integers]


class StepWork(Record):
    """Working memory of steps.

    Attributes
    ----------
    first, second, third, fourth, middle : Array
        Rates at the four stages, arrays of their own, since a view of an array is a new object in JavaScript;
        the state at a stage.
    y, w, before, after : Array
        State and scratch at the beginning; switching functions at both ends of a step.
    clock : Array, shape (1,)
        Time [s].
    counters, chosen : Array of int64
        Counters at the beginning; 1 for each event at the end of the step, else 0.
    ending : Array of int64, shape (1,)
        Number of the event that ends the run, -1 where none does.
    """

    first: Array
    second: Array
    third: Array
    fourth: Array
    middle: Array
    y: Array
    w: Array
    before: Array
    after: Array
    clock: Array
    counters: Integers
    chosen: Integers
    ending: Integers


def new_step_work(ny: int, nw: int, events: int) -> Any:
    """Return working memory."""
    sizes = ny, ny, ny, ny, ny, ny, nw, events, events, 1
    integers = (np.zeros(size, dtype=np.int64) for size in (abi.N_COUNTERS, events, 1))
    return StepWork._make((*(np.zeros(size) for size in sizes), *integers))


@exact()
def all_finite(x: Array, count: int) -> bool:
    """Whether the first numbers of an array are finite."""
    finite = True
    for i in range(count):
        finite = finite and math.isfinite(x[i])
    return finite


@exact()
def set_rates(model: StepModel, t: float, y: Array, p: Array, w: Array, iw: Integers, rate: Array) -> int:
    """Set the rates of a state, confirmed where a pivot is suspicious."""
    _, rhs, confirm, _, _, _ = model
    if rhs(t, y, p, w, iw, rate) != 0:
        confirm(t, y, p, w, iw, rate)
    return 0


@exact(entry=True)
def find_rates(model: StepModel, t: float, y: Array, p: Array, w: Array, iw: Integers, rate: Array) -> bool:
    """Set the rates of a state; return whether they are finite."""
    layout, _, _, _, _, _ = model
    set_rates(model, t, y, p, w, iw, rate)
    return bool(all_finite(rate, layout.ny))


@exact()
def set_stage(y: Array, factor: float, rate: Array, stage: Array) -> int:
    """Set `stage` to a state and a multiple of rates."""
    for i in range(stage.shape[0]):
        stage[i] = y[i] + factor * rate[i]
    return 0


@exact(entry=True)
def take_step(model: StepModel, t: float, h: float, now: Instant, iw: Integers, work: StepWork) -> bool:
    """Make a step; return whether it succeeds."""
    layout, _, _, accept, _, _ = model
    (y, p, w), middle, n = now, work.middle, layout.ny
    w[abi.STEP_STATUS] = h
    a, b, c, d = work.first, work.second, work.third, work.fourth
    set_rates(model, t, y, p, w, iw, a)
    set_stage(y, 0.5 * h, a, middle)
    set_rates(model, t + 0.5 * h, middle, p, w, iw, b)
    set_stage(y, 0.5 * h, b, middle)
    set_rates(model, t + 0.5 * h, middle, p, w, iw, c)
    set_stage(y, h, c, middle)
    set_rates(model, t + h, middle, p, w, iw, d)
    for i in range(n):
        y[i] += h / 6.0 * (a[i] + 2.0 * (b[i] + c[i]) + d[i])
    return bool(accept(t + h, y, p, w, iw) % 2 == 0 and all_finite(y, n))


@exact()
def copy_counters(source: Integers, copy: Integers) -> int:
    """Copy the counters."""
    for i in range(abi.N_COUNTERS):
        copy[i] = source[i]
    return 0


@exact()
def keep_beginning(now: Instant, iw: Integers, work: StepWork) -> int:
    """Keep the beginning of a step."""
    copy_numbers(now.y, work.y, work.y.shape[0])
    copy_numbers(now.w, work.w, work.w.shape[0])
    return int(copy_counters(iw, work.counters))


@exact()
def restore_beginning(now: Instant, iw: Integers, work: StepWork) -> int:
    """Go back to the beginning of a step."""
    copy_numbers(work.y, now.y, work.y.shape[0])
    copy_numbers(work.w, now.w, work.w.shape[0])
    return int(copy_counters(work.counters, iw))


@exact()
def passes_event(direction: int, before: float, after: float) -> bool:
    """Whether a switching function passes 0 as its event has it; see `STEP_MODEL` for directions."""
    rises, falls = before < 0.0 and after >= 0.0, before > 0.0 and after <= 0.0
    return (rises and (direction == 0 or direction == 1)) or (falls and (direction == 0 or direction == -1))


@exact()
def attempt_step(model: StepModel, t: float, h: float, now: Instant, iw: Integers, work: StepWork) -> int:
    """Make a step; return the number of events in it, -1 where it fails."""
    _, _, _, _, happens, directions = model
    if not take_step(model, t, h, now, iw, work):
        return -1
    count = 0
    if directions.shape[0] > 0:
        happens(t + h, now.y, now.p, now.w, work.middle, work.after)
    for k in range(directions.shape[0]):
        work.chosen[k] = 1 if passes_event(directions[k], work.before[k], work.after[k]) else 0
        count += work.chosen[k]
    return int(count)


@exact()
def step_to_event(model: StepModel, t: float, h: float, now: Instant, iw: Integers, work: StepWork) -> float:
    """Make a step, or a shorter one to the first event in it.

    Parameters
    ----------
    model : tuple
        See `StepModel`.
    t, h : float
        Time and step [s].
    now, iw : Instant, Array of int
        State of the run and counters.
    work : StepWork
        Working memory; it keeps the beginning of the step, and `chosen` has the events at the end.

    Returns
    -------
    float
        Length of the step, nan where it failed.
    """
    _, _, _, _, happens, directions = model
    keep_beginning(now, iw, work)
    if directions.shape[0] > 0:
        happens(t, now.y, now.p, now.w, work.middle, work.before)
    count = attempt_step(model, t, h, now, iw, work)
    low, high = 0.0, h
    if directions.shape[0] > 0:
        if count > 0:
            for _ in range(MOST_HALVES):
                if count < 0 or not high - low > FINEST * (1.0 + abs(t)):
                    break
                middle = 0.5 * (low + high)
                restore_beginning(now, iw, work)
                count = attempt_step(model, t, middle, now, iw, work)
                low, high = (low, middle) if count > 0 else (middle, high)
            restore_beginning(now, iw, work)
            count = attempt_step(model, t, high, now, iw, work) if count >= 0 else -1
    return high if count >= 0 else math.nan


@exact(entry=True)
def take_steps(
    model: RunModel, until: float, h: float, now: Instant, iw: Integers, work: StepWork, impact: EffectWork
) -> int:
    """Make steps up to a time; events happen at their times, and one that ends runs is the last.

    Parameters
    ----------
    model : tuple
        See `RunModel`.
    until, h : float
        Time, and the length of the steps; the last one is shorter [s].
    now, iw : Instant, Array of int
        State of the run and counters.
    work, impact : StepWork, EffectWork
        Working memory; `clock` is the time.

    Returns
    -------
    int
        `REACHED`, `ENDED`, with the event in `ending`, or `FAILED`: then steps have halved up to the last state from
        which the motion goes on.
    """
    steps, effects, ends = model
    _, _, _, _, changes = effects
    clock, halving, size = work.clock, False, h
    work.ending[0] = -1
    while clock[0] < until:
        t, rest = clock[0], until - clock[0]
        if halving:
            size = 0.5 * size
            if not size > NEAREST * (1.0 + abs(t)):
                return FAILED
        step = rest if rest < size + LONGER * size else size
        length = step_to_event(steps, t, step, now, iw, work)
        if length > 0.0:
            clock[0] = until if length == rest else t + length
            happened, last = False, -1
            for k in range(ends.shape[0]):
                happened = happened or work.chosen[k] != 0
                last = k if last < 0 and work.chosen[k] != 0 and ends[k] != 0 else last
            if changes.owners.shape[0] + changes.writes.shape[0] > 0:
                if happened and apply_effects(effects, clock[0], now, work.chosen, impact) != 0:
                    return FAILED
            if last >= 0:
                work.ending[0] = last
                return ENDED
        else:
            restore_beginning(now, iw, work)
            size, halving = step, True
    return REACHED
