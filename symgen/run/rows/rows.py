"""Loops over many runs of one compiled model: no Python between runs, no lock held, memory of one run and the results.

Each run is an instance of the frame of single runs, so it takes the same steps. Several threads call these functions at
once, each with its own rows and working memory.
"""

from __future__ import annotations

from typing import Any

from symgen.compile.loopcode.bare import bare
from symgen.compile.loopcode.loop_instances import Meanings, compiled_loop, signature_of
from symgen.compile.native import types
from symgen.compile.native.annotations import Array, type_of
from symgen.compile.store.jit import RuntimeFunction, jit
from symgen.run.layout import abi
from symgen.run.layout.records import (
    CHUNK,
    KEPT_OF_RUN,
    SPAN,
    Kept,
    Observers,
    RowChunk,
    Span,
    State,
    System,
)
from symgen.run.layout.scheme_records import Nodes, TableauRecord
from symgen.run.loops.event_loop import loop_with_events
from symgen.run.loops.seams import loop_with_seams, parameters_at, select_row
from symgen.run.loops.unbound import (
    begin_choice,
    forget_run,
    integrate,
    resume_code,
    store_after,
    take_change,
    take_notes,
    take_row,
    waits_for_caller,
)
from symgen.run.modes import turn
from symgen.run.modes.turn_meanings import meanings_of_turn
from symgen.run.rows import row_events
from symgen.run.rows.row_results import end_run, follow_rows


def select_elements(array: Array, first: int, size: int, out: Array) -> None:
    """Set `out` to elements of an array."""
    for i in range(size):
        out[i] = array[first + i]


def begin_run(state: State, limits: Array) -> None:
    """Reset the state of a run, except for the stop flag."""
    gauges = state.gauges
    for i in range(gauges.shape[0]):
        gauges[i] = 0.0
    for i in range(state.clock.shape[0]):
        state.clock[i] = 0.0
    gauges[abi.LIMIT_PHI], gauges[abi.LIMIT_DRIFT], gauges[abi.LIMIT_ENERGY] = limits[0], limits[1], limits[2]
    gauges[abi.WARN_PIVOT] = limits[3]
    gauges[abi.SMALLEST_PIVOT] = gauges[abi.LAST_SINE] = gauges[abi.LAST_SHORT] = 1.0
    for i in range(abi.N_CONTROL):
        if i != abi.STOP:
            state.control[i] = 0
    for i in range(state.iw.shape[0]):
        state.iw[i] = 0


def run_rows(
    model: System, scheme: Nodes | TableauRecord, span: Span, chunk: RowChunk, state: State, series: Kept
) -> int:
    """Run the selected rows from the starts of `symgen.run.starts.starting.close_runs`.

    Parameters
    ----------
    model : tuple
        First argument of the loop over one run; then, for observed values at outputs, sizes and functions
        (`symgen.run.layout.abi`): ``rates`` or ``rhs``, its confirmation, ``accept``, ``observe`` and ``balance``;
        then, where bounded rows have modes, `OfModes`, else where events change a run, what they change: `OfEffects`.
    scheme, span
        As for a single run.
    chunk : Chunk
        The rows.
    state : State
        Memory of one run; an additional element of `control` counts finished runs.
    series : Kept
        Outputs of one run, at the same times for every run.

    Returns
    -------
    int
        Number of selected rows that are done: all, unless the run was stopped, or the next one waits for an
        examination.
    """
    chunk, state, series = bare(chunk), bare(state), bare(series)
    system, observers = model[0], model[1]
    ny, n_p, nw = observers[0].ny, state.p.shape[0], state.w.shape[0]
    for s in range(chunk.selected.shape[0]):
        if state.control[abi.STOP] != 0:
            return int(s)
        r = chunk.selected[s]
        code = resume_code(state)
        if code == abi.DONE:
            begin_run(state, chunk.limits)
            take_row(system, r)
            select_elements(chunk.ys, r * ny, ny, state.y)
            select_elements(chunk.ps, r * n_p, n_p, state.p)
            select_elements(chunk.ws, r * nw, nw, state.w)
            forget_run(model, state)
            code = begin_choice(model, span, state)
            if code == abi.DONE:
                code = integrate(system, scheme, span, state, series.outputs)
        while code == abi.CHOOSE or code == abi.NOTED or code == abi.MET or code == abi.CHANGED:
            if code == abi.CHOOSE:
                follow_rows(chunk, state, state.w)
            elif code == abi.CHANGED:
                code = take_change(model, span, state)
                if code != abi.CHANGED:
                    break
            elif waits_for_caller(code, model, chunk, state):
                return int(s)
            else:
                ended = take_notes(code, r, model, chunk, state)
                store_after(code, span, state, series.outputs)
                if ended != code:
                    code = abi.MET if ended == abi.DONE else ended
                    break
            code = integrate(system, scheme, span, state, series.outputs)
        if code == abi.STOPPED:
            return int(s)
        if code == abi.DONE:  # a grid of steps meets the end up to rounding
            state.clock[abi.TIME] = span.until
        if code == abi.MET:
            code = abi.DONE
        else:
            code = take_notes(code, r, model, chunk, state)
        end_run(code, r, system, span, observers, chunk, state, series)
    return int(chunk.selected.shape[0])


# -- seams -------------------------------------------------------------------------------------------------------------


def take_seams(system: System, r: int) -> None:
    """Select the seams of a row."""
    select_row(system[1], r)


def hold_between_seams(system: System, span: Span, chunk: RowChunk, r: int, state: State, times: Array, k: int) -> None:
    """Set the parameters to their values at output `k`, from the output before; at a seam, to the values before it."""
    _, seams, _, prepare, prepare_law = system
    control, n_p = state.control, state.p.shape[0]
    if k == 0:
        control[abi.PASSED] = 0
        select_elements(chunk.ps, r * n_p, n_p, state.p)
    passed = parameters_at(seams, span, prepare, prepare_law, times[k], control[abi.PASSED], state.p)
    control[abi.PASSED] = passed


# -- loops -------------------------------------------------------------------------------------------------------------


@jit(entry=True)
def observe_nothing_of_coordinates(t: float, y: Array, p: Array, w: Array, ydot: Array, out: Array) -> int:
    """Replace the emitted ``observe`` where no joint coordinate is requested, so that it is not compiled."""
    return 0


@jit(entry=True)
def balance_nothing(t: float, y: Array, p: Array, w: Array, ydot: Array) -> int:
    """Replace the emitted ``balance`` of laws that have none, as their forces balance whatever the multipliers are."""
    return 0


#: Sizes of a model, and the functions called at outputs.
OBSERVERS = type_of(Observers)
EVENTS = Meanings(
    "sweeps with events", forget_run=row_events.forget_functions, take_notes=row_events.take_notes_of_events
)
EFFECTS = Meanings(
    "sweeps of which events change the state",
    forget_run=row_events.forget_past,
    happen=row_events.happen_with_resets,
    keep_ends=row_events.keep_ends_of_resets,
    store_after=row_events.store_after_effects,
)
MODES = Meanings(
    "sweeps with bounded rows",
    forget_run=row_events.forget_past_modes,
    begin_choice=row_events.begin_row_in_modes,
    happen=row_events.happen_with_modes,
    keep_ends=row_events.keep_ends_of_modes,
    store_after=row_events.store_after_effects,
)
MODES_BETWEEN_SEAMS = Meanings(
    "sweeps with bounded rows and seams",
    begin_choice=row_events.begin_row_between_seams,
    take_change=row_events.choose_after_change,
)
_EXAMINED = Meanings(
    "sweeps with constraints that may jump",
    resume_code=row_events.resume_code_after_examination,
    waits_for_caller=row_events.waits_for_examination,
)
SEAMED = Meanings("sweeps with seams", take_row=take_seams, hold=hold_between_seams)
_loops: dict[Any, Any] = {}


def over_rows(
    loop: RuntimeFunction,
    events: bool = False,
    seams: bool = False,
    effects: bool = False,
    examined: bool = False,
    modes: bool = False,
    turning: tuple[str, ...] = (),
) -> Any:
    """Return the loop over many runs around that over a single run, made at the first use.

    Parameters
    ----------
    loop : compiled loop
        From `symgen.run.loops.frame.loop`.
    events, seams, effects, examined, modes : bool
        Whether rows have switching functions, seams of parameters, events that change a run, constraints that may jump,
        and bounded rows.
    turning : tuple of str
        See `symgen.run.loops.run_spec.Watched`.
    """
    key = loop, events, seams, effects, examined, modes, turning
    if key not in _loops:
        name = f"{loop.__module__.rpartition('.')[2]}_{loop.__name__}" + "_with_events" * events + "_with_seams" * seams
        name += "_with_effects" * effects + "_examined" * examined + "_with_modes" * modes
        name += "".join(f"_{kind}" for kind in turning)
        inner = loop_with_events(loop) if events else loop
        inner = loop_with_seams(inner) if seams else inner
        args = signature_of(inner).arguments
        further = [turn.FURTHER["modes" if modes else "effects"]] if modes or effects else []
        model = types.RecordType((*args[:1], OBSERVERS, *further))
        signature = types.int64(model, *args[1:2], SPAN, CHUNK, *args[3:4], KEPT_OF_RUN)
        meanings: dict[str, Any] = {**(EVENTS if events else {}), **(EFFECTS if effects else {})}
        meanings |= MODES if modes else {}
        meanings |= meanings_of_turn(effects and modes, turning)
        meanings |= MODES_BETWEEN_SEAMS if modes and seams else {}
        meanings |= (SEAMED if seams else {}) | (_EXAMINED if examined else {})
        compiled = compiled_loop(__name__, name, run_rows, signature, integrate=inner, **meanings)
        _loops[key] = globals()[name] = compiled  # it is found by its name, as all loops are
    return _loops[key]
