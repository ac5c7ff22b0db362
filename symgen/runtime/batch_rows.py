"""What happens before and after each run of a batch: numbers reset, quantities picked, the summary written."""

from __future__ import annotations

import math
from typing import Any

from symgen.runtime import abi
from symgen.runtime import ensemble_abi as e
from symgen.runtime.bare import part
from symgen.runtime.observe import observe_rates, observe_rows
from symgen.store.jit import jit

_NQ, _NV, _NP, _NW, _M_ROWS, _PIVOTS = e.NQ, e.NV, e.NP, e.NW, e.M, e.PIVOTS
_MULTIPLIERS, _WANTS_RATES, _WANTS_JOINTS = e.MULTIPLIERS, e.WANTS_RATES, e.WANTS_JOINTS
_STATE, _STATUS, _ENERGY, _ENERGY_ERROR = e.STATE, e.STATUS, e.ENERGY, e.ENERGY_ERROR
_ACCELERATION, _MULTIPLIER = e.ACCELERATION, e.MULTIPLIER
_N_SUMMARY, _RUNS_DONE, _FIRST = e.N_SUMMARY, e.RUNS_DONE, e.SUMMARY.index("code")
_N_STATUS = abi.RANK + 1
_STOP, _STOPPED, _OUTPUTS, _LAST_RANK, _N_CONTROL = abi.STOP, abi.STOPPED, abi.OUTPUTS, abi.LAST_RANK, abi.N_CONTROL
_STEPS, _REJECTED, _EVALUATIONS, _EVENTS = abi.STEPS, abi.REJECTED, abi.EVALUATIONS, abi.EVENTS
_TIME, _MAX_PHI, _MAX_DRIFT, _MAX_ENERGY = abi.TIME, abi.MAX_PHI, abi.MAX_DRIFT, abi.MAX_ENERGY
_ENERGY_START, _ENERGY_SCALE, _JUMP = abi.ENERGY_START, abi.ENERGY_SCALE, abi.MAX_ENERGY_JUMP
_LIMIT_PHI, _LIMIT_DRIFT, _LIMIT_ENERGY = abi.LIMIT_PHI, abi.LIMIT_DRIFT, abi.LIMIT_ENERGY
_WARN_PIVOT, _SMALLEST_PIVOT, _LAST_SINE = abi.WARN_PIVOT, abi.SMALLEST_PIVOT, abi.LAST_SINE
_PHI, _DRIFT, _KINETIC, _POTENTIAL = abi.PHI, abi.DRIFT, abi.KINETIC, abi.POTENTIAL
_LENGTH, _SPEED = abi.LENGTH, abi.SPEED
_N_EVENT, _MAX_EVENTS, _EVENT_IN, _EVENT_PIVOT = abi.N_EVENT, abi.MAX_EVENTS, abi.EVENT_IN, abi.EVENT_PIVOT
_ITERATIONS, _LIGHT = abi.ITERATIONS, abi.LIGHT


@jit()
def begin_run(y: Any, w: Any, iw: Any, sizes: Any, limits: Any, gauges: Any, control: Any) -> None:
    """Reset what a run keeps; only the flag that stops is left."""
    for i in range(gauges.shape[0]):
        gauges[i] = 0.0
    gauges[_LIMIT_PHI], gauges[_LIMIT_DRIFT], gauges[_LIMIT_ENERGY] = limits[0], limits[1], limits[2]
    gauges[_WARN_PIVOT] = limits[3]
    gauges[_SMALLEST_PIVOT] = gauges[_LAST_SINE] = 1.0
    for i in range(_N_CONTROL):
        if i != _STOP:
            control[i] = 0
    rank = 0
    for i in range(sizes[_M_ROWS]):
        if w[sizes[_PIVOTS] + i] >= 1e-12:
            rank += 1
    control[_LAST_RANK] = rank
    for i in range(iw.shape[0]):
        iw[i] = 0


@jit()
def pick(
    values: Any,
    at: int,
    outputs: int,
    picks: Any,
    states: Any,
    status: Any,
    accelerations: Any,
    multipliers: Any,
    observed: Any,
    rows: int,
    start: float,
) -> None:
    """Write what is asked for at the outputs of a run, one quantity after the other; nan where there is no output."""
    n_times = states.shape[0]
    work = states.shape[1] - 1
    for c in range(picks.shape[0] // 2):
        source, column, to = picks[2 * c], picks[2 * c + 1], at + c * n_times
        for k in range(outputs):
            if source == _STATE:
                value = states[k, column]
            elif source == _STATUS:
                value = status[k, column]
            elif source == _ENERGY:
                value = status[k, _KINETIC] + status[k, _POTENTIAL]
            elif source == _ENERGY_ERROR:
                value = status[k, _KINETIC] + status[k, _POTENTIAL] - start - states[k, work]
            elif source == _ACCELERATION:
                value = accelerations[k, column]
            elif source == _MULTIPLIER:
                value = multipliers[k, column]
            else:
                value = observed[k, rows + column]
            values[to + k] = value
        for k in range(outputs, n_times):
            values[to + k] = math.nan


@jit()
def summarise(code: int, row: Any, w: Any, iw: Any, gauges: Any, control: Any, events: Any) -> None:
    """Write the numbers by which a run is judged, in the order of `symgen.runtime.ensemble_abi.SUMMARY`."""
    narrowest, where = math.nan, math.nan
    for k in range(min(control[_EVENTS], _MAX_EVENTS)):
        pivot = events[k * _N_EVENT + _EVENT_PIVOT]
        if not narrowest <= pivot:
            narrowest, where = pivot, events[k * _N_EVENT + _EVENT_IN]
    at = _FIRST
    for number in (
        float(code),
        gauges[_TIME],
        float(control[_OUTPUTS]),
        float(control[_STEPS]),
        float(control[_REJECTED]),
        float(control[_EVALUATIONS]),
        float(iw[_ITERATIONS]),
        float(iw[_LIGHT]),
        gauges[_MAX_PHI],
        gauges[_MAX_DRIFT],
        gauges[_MAX_ENERGY],
        gauges[_ENERGY_START],
        gauges[_ENERGY_SCALE],
        gauges[_JUMP],
        gauges[_SMALLEST_PIVOT],
        float(control[_EVENTS]),
        where,
        narrowest,
        w[_PHI],
        w[_DRIFT],
        w[_LENGTH],
        w[_SPEED],
    ):
        row[at] = number
        at += 1


@jit()
def end_run(
    code: int,
    r: int,
    rates: Any,
    rates_confirm: Any,
    accept: Any,
    observe: Any,
    sizes: Any,
    p: Any,
    w: Any,
    kept: Any,
    iw: Any,
    times: Any,
    states: Any,
    status: Any,
    accelerations: Any,
    multipliers: Any,
    observed: Any,
    angles: Any,
    picks: Any,
    values: Any,
    summary: Any,
    gauges: Any,
    control: Any,
    events: Any,
) -> None:
    """Keep what a run gave."""
    summarise(code, part(summary, r * _N_SUMMARY, _N_SUMMARY), w, iw, gauges, control, events)
    k, m = control[_OUTPUTS], sizes[_M_ROWS]
    if sizes[_WANTS_RATES] == 1:
        for i in range(iw.shape[0]):
            iw[i] = 0
        for i in range(k):
            for j in range(angles.shape[1]):
                angles[i, j] = status[i, _N_STATUS + j]
        observe_rates(
            rates,
            rates_confirm,
            accept,
            times[:k],
            states[:k],
            angles[:k],
            p,
            kept,
            iw,
            sizes[_NQ],
            sizes[_MULTIPLIERS],
            accelerations[:k],
            multipliers[:k],
        )
    if sizes[_WANTS_JOINTS] == 1:
        observe_rows(observe, times[:k], states[:k], accelerations[:k], angles[:k], p, w, sizes[_NQ], observed[:k])
    at = r * (picks.shape[0] // 2) * times.shape[0]
    pick(values, at, k, picks, states, status, accelerations, multipliers, observed, m, gauges[_ENERGY_START])
    control[_RUNS_DONE] += 1
