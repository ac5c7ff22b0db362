"""What rows of sweeps have beside their steps: switching functions, and times at which parameters change."""

from __future__ import annotations

from typing import Any

from symgen.runtime import abi
from symgen.runtime import ensemble_abi as e
from symgen.runtime import search_records as records
from symgen.runtime.bare import bare, part
from symgen.runtime.hunting import notes_at
from symgen.runtime.loop_instances import called
from symgen.runtime.stopping import ROW, change, due, same


def take(array: Any, first: int, size: int, out: Any) -> None:
    """Set `out` to elements of an array."""
    for i in range(size):
        out[i] = array[first + i]


# -- switching functions -----------------------------------------------------------------------------------------------


def forget_functions(state: Any) -> None:
    """Forget on which side of its switching functions the run before was, and what was noted of it."""
    hunt = bare(state).hunt
    n = int(hunt[records.COUNT])
    for i in range(records.N_HEAD + records.SIDE * n, records.N_HEAD + records.N_COLUMNS * n):
        hunt[i] = 0.0
    hunt[records.NOTED] = hunt[records.ACCEPTED] = hunt[records.PASSED] = hunt[records.SINCE] = 0.0


@called
def take_notes_of_events(code: int, r: int, width: int, chunk: Any, state: Any) -> int:
    """Take what a run has noted of its events into the numbers of its row; return how the run ended.

    Parameters
    ----------
    code, r : int
        How its loop was left, and the row.
    width : int
        Of a state.
    chunk, state
        As for `run_rows`.
    """
    hunt, clock = state.hunt, state.clock
    n, numbers = int(hunt[records.COUNT]), chunk.events.shape[0] // (chunk.ps.shape[0] // state.p.shape[0])
    first, row = notes_at(n, width, state.w.shape[0]), part(chunk.events, r * numbers, numbers)
    ended = code
    for i in range(int(hunt[records.NOTED])):
        t, k = hunt[first + i * (2 + width)], int(hunt[first + i * (2 + width) + 1])
        at = e.HEAD_OF_EVENTS + e.OF_EVENT * k
        if row[at] == 0.0:
            row[at + 1] = t
        row[at] += 1.0
        row[at + 2] = t
        if t == clock[abi.TIME] and hunt[records.N_HEAD + records.ACTION * n + k] == float(records.LEAVE):
            ended = abi.DONE
    hunt[records.NOTED] = hunt[records.ACCEPTED] = 0.0
    if code == abi.UNDEFINED:
        for k in range(n):
            g = hunt[records.N_HEAD + records.N_COLUMNS * n + k]
            if not g == g and not row[e.IMPOSSIBLE_EVENT] == row[e.IMPOSSIBLE_EVENT]:
                row[e.IMPOSSIBLE_EVENT] = float(k)
    return ended


# -- stops -------------------------------------------------------------------------------------------------------------


def take_stops(system: Any, r: int) -> None:
    """Have the stops of a row."""
    stops = system[1]
    stops.head[ROW] = r if stops.rows.shape[0] > 2 else 0  # or one table for all


def hold_between_stops(system: Any, span: Any, chunk: Any, r: int, state: Any, times: Any, k: int) -> None:
    """Have the parameters that held at output `k`, from those of the one before; at a stop, those from before it."""
    _, stops, _, prepare, prepare_law = system
    control, n_p, changed = state.control, state.p.shape[0], False
    if k == 0:
        control[abi.PASSED] = 0
        take(chunk.ps, r * n_p, n_p, state.p)
    while times[k] > due(stops, control[abi.PASSED]) + same(stops, span, times[k]):
        changed = change(stops, control[abi.PASSED], state.p) or changed
        control[abi.PASSED] += 1
    if changed:
        prepare(state.p)
        prepare_law(state.p)
