"""Quantities of rows by the motion that loops in other coordinates have left: joints have run, bodies are observed."""

from __future__ import annotations

import math
from typing import Any

from symgen.compile.loopcode.bare import bare
from symgen.compile.loopcode.loop_instances import compiled_loop
from symgen.compile.native import types
from symgen.compile.native.annotations import Cube
from symgen.run.layout import abi
from symgen.run.layout import ensemble_abi as e
from symgen.run.layout.records import CHUNK, KEPT_OF_RUN, SPAN, STATE, Kept, RowChunk, Span, State, System
from symgen.run.loops.seams import SEAMS
from symgen.run.loops.unbound import take_row
from symgen.run.rows.row_results import observe_outputs
from symgen.run.rows.rows import OBSERVERS, SEAMED, select_elements


def observe_left(model: System, span: Span, chunk: RowChunk, state: State, series: Kept, left: Cube) -> int:
    """Write the quantities of the selected rows by the motion that a loop in other coordinates has left.

    Parameters
    ----------
    model : tuple
        What changes parameters, in the places of `symgen.run.loops.seams.arguments_with_table`, or 0; sizes and
        functions of the observer.
    span, chunk, state, series
        As for `symgen.run.rows.rows.run_rows`, of the model that observes.
    left : Array, shape (rows, ny + status, times)
        States, then their status with the angles that count turns and the modes; nan at times that a run did not reach.

    Returns
    -------
    int
        Number of selected rows that are done.
    """
    chunk, state, series = bare(chunk), bare(state), bare(series)
    system, observers = model
    sizes, outputs, n_p, nw = observers[0], series.outputs, state.p.shape[0], state.w.shape[0]
    ny, times = sizes.ny, outputs.times
    until = times[times.shape[0] - 1]
    for s in range(chunk.selected.shape[0]):
        if state.control[abi.STOP] != 0:
            return int(s)
        r, count, masked = chunk.selected[s], 0, 0
        take_row(system, r)
        select_elements(chunk.ps, r * n_p, n_p, state.p)
        select_elements(chunk.ws, r * nw, nw, state.w)
        while count < times.shape[0] and not math.isnan(left[r, 0, count]):
            for i in range(ny):
                outputs.states[count, i] = left[r, i, count]
            for i in range(outputs.status.shape[1]):
                outputs.status[count, i] = left[r, ny + i, count]
            count += 1
        for i in range(sizes.m):
            masked += 1 if state.w[sizes.mask + i] > 0.0 else 0
        state.control[abi.MASKED] = masked
        state.gauges[abi.ENERGY_START] = chunk.summary[r * e.N_SUMMARY + e.ENERGY_START]
        if chunk.ends == 1 and chunk.summary[r * e.N_SUMMARY + e.OUTPUTS] == 0.0:  # an event has ended it
            times[0] = chunk.summary[r * e.N_SUMMARY + e.END]
        observe_outputs(count, r, system, span, observers, chunk, state, series)
        times[times.shape[0] - 1] = until
    return int(chunk.selected.shape[0])


_left = types.float64[:, :, ::1]
_changing = types.RecordType((types.int64, SEAMS, types.int64, e.PREPARE, e.PREPARE))


def _loop(name: str, system: Any, **meanings: Any) -> Any:
    signature = types.int64(types.RecordType((system, OBSERVERS)), SPAN, CHUNK, STATE, KEPT_OF_RUN, _left)
    return compiled_loop(__name__, name, observe_left, signature, **meanings)


#: The loop over rows, compiled: without seams of parameters, and with them.
observe_rows_left = _loop("observe_rows_left", types.int64)
observe_rows_between_seams = _loop("observe_rows_between_seams", _changing, **SEAMED)
