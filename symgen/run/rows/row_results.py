"""Results of a row: the requested quantities at its outputs, and its summary."""

from __future__ import annotations

import math

from symgen.compile.loopcode.bare import part
from symgen.compile.loopcode.loop_instances import called
from symgen.compile.native.annotations import Array, Integers
from symgen.run.layout import abi
from symgen.run.layout import ensemble_abi as e
from symgen.run.layout.records import Kept, Observed, Observers, Outputs, RowChunk, Sizes, Span, State, System
from symgen.run.layout.redundancy import choose_rows
from symgen.run.loops.frame_parts import store_output
from symgen.run.loops.unbound import hold
from symgen.run.loops.watch import iterations_in
from symgen.run.single.observe import (
    balanced_output,
    left_at_output,
    number_of_balances,
    observe_rates,
    observe_rows,
)

_N_PASSAGE, _MAX_PASSAGES = abi.N_PASSAGE, abi.MAX_PASSAGES


def pick_quantities(sizes: Sizes, picks: Integers, series: Kept, count: int, start: float, values: Array) -> None:
    """Write the requested quantities at the outputs of a run, one after the other; nan at outputs not reached.

    Parameters
    ----------
    sizes : Sizes
        Of the model.
    picks : Array of int64
        (source, column) of each quantity.
    series : Kept
        Of the run.
    count : int
        Number of outputs reached.
    start : float
        Energy at the start [J].
    values : Array
        Written.
    """
    outputs, observed, status, work = series.outputs, series.observed, series.outputs.status, sizes.nq + sizes.nv
    n_times = outputs.states.shape[0]
    for c in range(picks.shape[0] // 2):
        source, column, to = picks[2 * c], picks[2 * c + 1], c * n_times
        for k in range(count):
            if source == e.STATE:
                value = outputs.states[k, column]
            elif source == e.STATUS:
                value = status[k, column]
            elif source == e.ENERGY:
                value = status[k, abi.KINETIC] + status[k, abi.POTENTIAL]
            elif source == e.ENERGY_ERROR:
                value = status[k, abi.KINETIC] + status[k, abi.POTENTIAL] - start - outputs.states[k, work]
            elif source == e.ACCELERATION:
                value = observed.accelerations[k, column]
            elif source == e.MULTIPLIER:
                value = observed.multipliers[k, column]
            else:
                value = observed.rows[k, sizes.m + column]
            values[to + k] = value
        for k in range(count, n_times):
            values[to + k] = math.nan


def summarise(code: int, state: State, row: Array) -> None:
    """Write the summary of a run, in the order of `symgen.run.layout.ensemble_abi.SUMMARY`."""
    w, clock, gauges, control, passages = state.w, state.clock, state.gauges, state.control, state.passages
    narrowest, where = math.nan, math.nan
    for k in range(min(control[abi.PASSAGES], _MAX_PASSAGES)):
        pivot = passages[k * _N_PASSAGE + abi.PASSAGE_PIVOT]
        if not narrowest <= pivot:
            narrowest, where = pivot, passages[k * _N_PASSAGE + abi.PASSAGE_IN]
    at = e.CODE
    for number in (
        float(code),
        clock[abi.TIME],
        float(control[abi.OUTPUTS]),
        float(control[abi.STEPS]),
        float(control[abi.REJECTED]),
        float(control[abi.EVALUATIONS]),
        float(iterations_in(state)),
        float(state.iw[abi.LIGHT]),
        gauges[abi.MAX_PHI],
        gauges[abi.MAX_DRIFT],
        gauges[abi.MAX_ENERGY],
        gauges[abi.ENERGY_START],
        gauges[abi.ENERGY_SCALE],
        gauges[abi.MAX_ENERGY_JUMP],
        gauges[abi.SMALLEST_PIVOT],
        float(control[abi.PASSAGES]),
        where,
        narrowest,
        w[abi.PHI],
        w[abi.DRIFT],
        w[abi.LENGTH],
        w[abi.SPEED],
    ):
        row[at] = number
        at += 1


@called
def follow_rows(chunk: RowChunk, state: State, w: Array) -> int:
    """Choose independent rows at the position of `w`; return 1 where they have changed."""
    if chunk.dense.shape[0] == 0:
        return 0
    return int(choose_rows(chunk.layout, chunk.layout.m - state.control[abi.MASKED], 1, w, chunk.dense))


def observe_outputs(
    count: int, r: int, system: System | int, span: Span, model: Observers, chunk: RowChunk, state: State, series: Kept
) -> None:
    """Write the requested quantities of a run with so many outputs; parameters otherwise as for `end_run`."""
    sizes, rates, confirm, accept, observe, _ = model
    law, nw = (sizes, rates, confirm, accept), state.w.shape[0]
    if chunk.rates == 1:
        for i in range(state.iw.shape[0]):
            state.iw[i] = 0
    scratch, outputs, observed = part(chunk.ws, r * nw, nw), series.outputs, series.observed
    follows = state.control[abi.MASKED] > 0 and chunk.dense.shape[0] > 0
    for k in range(count if chunk.rates == 1 or chunk.joints == 1 else 0):
        hold(system, span, chunk, r, state, outputs.times, k)
        here = Outputs(outputs.times[k : k + 1], outputs.states[k : k + 1], outputs.status[k : k + 1])
        single = Observed(observed.accelerations[k : k + 1], observed.multipliers[k : k + 1], observed.rows[k : k + 1])
        if chunk.rates == 1:
            observe_rates(law, here, 1, state.p, scratch, state.iw, single, state.room)
            if follows and follow_rows(chunk, state, scratch) != 0:  # the independent rows depend on the position
                observe_rates(law, here, 1, state.p, scratch, state.iw, single, state.room)
        if chunk.joints == 1:
            observe_rows(observe, sizes, here, 1, state.p, state.w, single, state.room)
    length = (chunk.picks.shape[0] // 2) * series.outputs.times.shape[0]
    values = part(chunk.values, r * length, length)
    pick_quantities(sizes, chunk.picks, series, count, state.gauges[abi.ENERGY_START], values)
    if chunk.rates == 1 or chunk.joints == 1:
        # loops take the padding after a state for zeros; observed values may even be nan
        for i in range(2 * sizes.ny + series.observed.rows.shape[1]):
            state.room[i] = 0.0


def imbalance_of_row(
    count: int, r: int, system: System | int, span: Span, model: Observers, chunk: RowChunk, state: State, series: Kept
) -> float:
    """Return what accelerations leave of the forces, as a single run does; the run is over, so its scratch is free."""
    sizes, rates, confirm, accept, _, balance = model
    law, times, largest = (sizes, rates, confirm, accept, balance), series.outputs.times, 0.0
    some = number_of_balances(count, state.control[abi.EVALUATIONS])
    for i in range(some):
        k = balanced_output(i, some, count)
        hold(system, span, chunk, r, state, times, k)
        left = left_at_output(law, series.outputs, k, state.p, state.w, state.iw, state.room)
        largest = left if left > largest else largest
    for i in range(2 * sizes.ny):  # loops take the padding after a state for zeros
        state.room[i] = 0.0
    return largest


def end_run(
    code: int, r: int, system: System | int, span: Span, model: Observers, chunk: RowChunk, state: State, series: Kept
) -> None:
    """Write the results of a run.

    Parameters
    ----------
    code, r : int
        End code of the loop, and the row.
    system, span : tuple, Span
        Arguments of the loop.
    model : tuple
        Its sizes, and the functions called at outputs.
    chunk, state, series
        As for `run_rows`; `state` is the state of the run at its end.
    """
    sizes, nw, count = model[0], state.w.shape[0], state.control[abi.OUTPUTS]
    summarise(code, state, part(chunk.summary, r * e.N_SUMMARY, e.N_SUMMARY))
    until = series.outputs.times[series.outputs.times.shape[0] - 1]
    if chunk.ends == 1 and count == 0 and code == abi.DONE:  # an event has ended it
        series.outputs.times[0] = state.clock[abi.TIME]
        store_output(sizes, state.w, series.outputs, 0, state.y)
        count = 1
    part(chunk.ws, r * nw, nw)[abi.STEP_STATUS] = state.w[abi.STEP_STATUS]  # for laws whose gains follow the step
    observe_outputs(count, r, system, span, model, chunk, state, series)
    if chunk.balanced == 1:
        left = imbalance_of_row(count, r, system, span, model, chunk, state, series)
        chunk.summary[r * e.N_SUMMARY + e.IMBALANCE] = left
    series.outputs.times[series.outputs.times.shape[0] - 1] = until
    state.control[e.RUNS_DONE] += 1
