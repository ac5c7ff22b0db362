"""Loops with events, located by shorter steps from the same state, for every scheme.

After each good attempt the loop (`symgen.run.loops.frame`) evaluates switching functions at the end of the step. If
`symgen.run.loops.searching.decide` finds that an event may lie inside, shorter steps from the same state enclose it to
the resolution of time; the state at an event is that of such a step. Before each of them the memory of emitted
functions is restored from the beginning of the step, so if an event is only noted, the whole step is then taken
unaffected.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from symgen.compile.loopcode.bare import bare, part
from symgen.compile.loopcode.loop_instances import Meanings, called, compiled_loop
from symgen.compile.loopcode.vectors import copied
from symgen.compile.native import types
from symgen.compile.native.annotations import Array, Record, record_type
from symgen.compile.store.jit import RuntimeFunction
from symgen.run.layout import abi
from symgen.run.layout.records import OUTPUTS, SPAN, EventRun, ModelSystem, Sizes, Span, State
from symgen.run.loops import frame
from symgen.run.loops import search_records as searching
from symgen.run.loops.frame_parts import DOUBT, LOOK, NOTHING, REMEMBER, TRY, evaluate
from symgen.run.loops.frame_parts import correct as plain_correct
from symgen.run.loops.frame_parts import open_run as plain_opened
from symgen.run.loops.inner_points import enter_point
from symgen.run.loops.inside import stays_away
from symgen.run.loops.searching import remember
from symgen.run.loops.switching import cubic
from symgen.run.loops.unbound import inside

#: Largest correction of an accepted state in units of the tolerance of its step (over the catalogue they are below 1);
#: and one that is always allowed to a constant step, of angles and of coordinates over the length of the mechanism.
FAR, SMALL = 1e3, 1e-3


class EventState(State):
    """A `State` with the data of events.

    Attributes
    ----------
    hunt : Array
        See `symgen.run.loops.search_records`.
    """

    hunt: Array


class EventSystem(ModelSystem):
    """A `ModelSystem` with the functions of events.

    Attributes
    ----------
    happens : function
        Switching functions with their rates.
    decide : function
        `symgen.run.loops.searching.decide`.
    rates : function
        The rates q' and v': ``rhs``, or a separate function of a law that does not integrate v.
    """

    happens: abi.Observe
    decide: abi.Decide
    rates: abi.Rhs


#: Type of the state of a run for compiled loops.
EVENT_STATE = record_type(EventState)


# -- functions for the frame -------------------------------------------------------------------------------------------


def open_event_run(sizes: Sizes, state: EventState) -> EventRun:
    """Return the state of a run, its working memory divided into parts, with its events."""
    return EventRun(*plain_opened(sizes, state), bare(state).hunt)  # type: ignore[call-arg]  # mypy counts no fields


def decide_event(system: EventSystem, run: EventRun, t: float, h: float, doing: int, y: Array) -> int:
    """Return the decision of `symgen.run.loops.searching.decide` on the state `y` at the end of a step."""
    n, width = int(run.hunt[searching.COUNT]), system.sizes.width
    notes = notes_at(n, width, run.w.shape[0])
    return int(system.decide(run.hunt, n, notes, t, h, doing, width, y, run.w, run.iw))


@called
def evaluate_events(system: EventSystem, run: EventRun, t: float, y: Array) -> None:
    """Evaluate switching functions and their rates at a state; the memory of emitted functions stays as it is."""
    width, hunt, n = system.sizes.width, run.hunt, int(run.hunt[searching.COUNT])
    at, m = searching.N_HEAD + searching.N_COLUMNS * n, searching.N_VALUES * n
    out, state, rate = part(hunt, at, m), part(hunt, at + m, width), part(hunt, at + m + width, width)
    if hunt[searching.NEEDS_RATES] != 0.0:
        decide_event(system, run, t, 0.0, searching.KEEP, y)
        copied(width, y, state)
        # this may close dependent coordinates of the copy
        if system.rates(t, state, run.p, run.w, run.iw, rate) != 0:
            system.confirm(t, state, run.p, run.w, run.iw, rate)
        run.control[abi.EVALUATIONS] += 1
    system.happens(t, y, run.p, run.w, rate, out)
    if hunt[searching.NEEDS_RATES] != 0.0:
        decide_event(system, run, t, 0.0, searching.GIVE_BACK, y)


def search_step(system: EventSystem, scheme: Record, run: EventRun, following: float, h: float, search: int) -> int:
    """JumpSearch an acceptable step for events; return the decision of `decide`."""
    hunt, n = run.hunt, int(run.hunt[searching.COUNT])
    evaluate_events(system, run, following, run.trial)
    if search == NOTHING or search == DOUBT:
        hunt[searching.INSIDE] = 0.0
    if search == NOTHING:
        if stays_away(hunt, n, h) == 1:
            return NOTHING
        look_inside(system, scheme, run, following, h)
    return decide_event(system, run, following, h, search, run.trial)


@called
def look_inside(system: EventSystem, scheme: Record, run: EventRun, following: float, h: float) -> None:
    """Evaluate switching functions at inner points of the motion in a good attempt; those at its end are kept."""
    hunt, n, width, t = run.hunt, int(run.hunt[searching.COUNT]), system.sizes.width, run.clock[abi.TIME]
    m = searching.N_VALUES * n
    first = searching.N_HEAD + searching.N_COLUMNS * n
    out, y = part(hunt, first, m), part(hunt, first + m + 2 * width, width)
    kept = part(hunt, searching.N_HEAD + searching.AT_END * n, m)
    copied(width, run.trial, y)
    decide_event(system, run, following, 0.0, searching.KEEP, run.trial)
    x = inside(system, scheme, run, t, following, h, 0, y)
    own = x > 0.0
    if not own:
        rates_at_ends(system, run, t, following)
    decide_event(system, run, following, 0.0, searching.GIVE_BACK, run.trial)
    for j in range(m):
        kept[j] = out[j]
    for i in range(searching.N_INSIDE):
        if own and i > 0:
            x = inside(system, scheme, run, t, following, h, i, y)
        elif not own:
            x = between_ends(system, run, h, i, y)
        evaluate_events(system, run, t + x * h, y)
        enter_point(hunt, n, x * h)
    for j in range(m):
        out[j] = kept[j]


@called
def rates_at_ends(system: EventSystem, run: EventRun, t: float, following: float) -> None:
    """Evaluate rates at both ends of a step."""
    width, hunt, n = system.sizes.width, run.hunt, int(run.hunt[searching.COUNT])
    first = searching.N_HEAD + (searching.N_COLUMNS + searching.N_VALUES) * n
    state = part(hunt, first, width)
    for end in range(2):
        copied(width, run.trial if end == 1 else run.y, state)
        evaluate(system, run, following if end == 1 else t, state, part(hunt, first + (3 + end) * width, width))
        run.control[abi.EVALUATIONS] += 1


def between_ends(system: EventSystem, run: EventRun, h: float, i: int, y: Array) -> float:
    """Set `y` to the state at inner point i of the cubic through both ends of a step; return its part of the step."""
    width, hunt, n = system.sizes.width, run.hunt, int(run.hunt[searching.COUNT])
    first = searching.N_HEAD + (searching.N_COLUMNS + searching.N_VALUES) * n
    before, after = part(hunt, first + 3 * width, width), part(hunt, first + 4 * width, width)
    x = (i + 1.0) / (searching.N_INSIDE + 1.0)
    for j in range(system.sizes.ny):
        y[j] = cubic(run.y[j], h * before[j], run.trial[j], h * after[j], x)
    return x


def prepare_event_search(system: EventSystem, run: EventRun, doing: int) -> int:
    """Find the side of each event on which a run begins, or continues after a change of velocities or parameters.

    Or save the memory of emitted functions at the beginning of a step (`REMEMBER`), or restore it (`RECALL`).
    """
    if doing == REMEMBER:
        hunt, w = run.hunt, run.w
        n, width, t = int(hunt[searching.COUNT]), system.sizes.width, run.clock[abi.TIME]
        return int(remember(hunt, n, t, width, run.y, w.shape[0], w, run.iw))
    if doing == LOOK:
        evaluate_events(system, run, run.clock[abi.TIME], run.y)
    return decide_event(system, run, run.clock[abi.TIME], 0.0, doing, run.y)


def step_to_event_point(system: EventSystem, run: EventRun, h: float) -> float:
    """Return the step to try in place of one of `h` seconds: one that ends at the next point of a table."""
    decide_event(system, run, run.clock[abi.TIME], h, searching.AIM, run.y)
    return float(run.hunt[TRY])


def correct_at_jumps(system: EventSystem, run: EventRun, t: float, y: Array, between: bool) -> int:
    """Correct and measure a state; store how far that moves it where rows may jump."""
    hunt, sizes = run.hunt, system.sizes
    at, width = int(hunt[searching.BEGINNING]), sizes.width
    if at == 0:
        return int(plain_correct(system, run, t, y, between))
    before, began = part(hunt, at + 1 + width, width), part(hunt, at + 1, width)
    copied(width, y, before)
    went = largest_difference(y, began, run.scales, 0, sizes.nq)
    bits = plain_correct(system, run, t, y, between)
    hunt[searching.WENT], hunt[searching.MOVED] = went, largest_difference(y, before, run.scales, 0, sizes.nq)
    hunt[searching.SPED] = largest_difference(y, before, run.metric, sizes.nq, sizes.nq + sizes.nv)
    return int(bits)


def largest_difference(y: Array, other: Array, weights: Array, first: int, last: int) -> float:
    """Return the largest weighted difference of two states in the elements from `first` to `last`; nan is ignored."""
    far = 0.0
    for i in range(first, last):
        size = abs(y[i] - other[i]) * weights[i]
        if size > far:
            far = size
    return far


def is_astray_at_jump(span: Span, run: EventRun, adaptive: bool) -> bool:
    """Return whether a correction moved the accepted state by much more than the error of its step explains.

    The error of a constant step is unknown; it moves no coordinate farther than the step itself moves one.
    """
    hunt = run.hunt
    if hunt[searching.BEGINNING] == 0.0:
        return False
    if adaptive:
        most = FAR * span.rtol
        return bool(hunt[searching.MOVED] > most or hunt[searching.SPED] > most * run.w[abi.SPEED])
    return bool(hunt[searching.MOVED] > SMALL + hunt[searching.WENT])


def notes_at(n: int, width: int, nw: int) -> int:
    """Return the index of the first note."""
    return (
        searching.N_HEAD
        + (searching.N_COLUMNS + searching.N_VALUES) * n
        + searching.N_STATES * width
        + 2 * (nw + abi.N_COUNTERS)
    )


MEANINGS = Meanings(
    "runs with events or switches",
    EVENTS=True,
    MARGINS=True,
    open_run=open_event_run,
    ModelSystem=EventSystem,
    locate_event=search_step,
    prepare_search=prepare_event_search,
    step_to_point=step_to_event_point,
    correct=correct_at_jumps,
    is_astray=is_astray_at_jump,
)
_loops: dict[Any, Any] = {}


def loop_with_events(loop: RuntimeFunction | None) -> Any:
    """Return the same loop with events, built at the first use.

    Parameters
    ----------
    loop : compiled loop
        From `symgen.run.loops.frame.loop`.
    """
    if loop is None:  # an integrator whose loop depends on the model
        return None
    if loop not in _loops:
        (module, name, scheme, *functions), meanings = frame.RECIPES[loop]
        kinds = *frame.kinds_of(functions), abi.OBSERVE, abi.DECIDE, abi.RHS
        signature = types.int64(types.RecordType(kinds), scheme, SPAN, EVENT_STATE, OUTPUTS)
        own = f"{module.rpartition('.')[2]}_{name}"
        _loops[loop] = compiled_loop(__name__, own, frame.integrate, signature, **{**meanings, **MEANINGS})
    return _loops[loop]


def __getattr__(name: str) -> Any:
    """Return the loop with events of a built-in scheme: another process loads it by name."""
    from importlib import import_module
    from importlib.util import find_spec

    scheme, _, own = name.partition("_")
    if own and find_spec(f"symgen.run.loops.schemes.{scheme}") is not None:
        loop = getattr(import_module(f"symgen.run.loops.schemes.{scheme}"), own, None)
        if loop in frame.RECIPES:
            return loop_with_events(loop)
    raise AttributeError(f"module '{__name__}' has no attribute '{name}'")


# -- from Python -------------------------------------------------------------------------------------------------------


def undefined_event(state: EventState) -> int:
    """Return the number of the first event whose condition is undefined at the last evaluation."""
    n = int(state.hunt[searching.COUNT])
    return int(np.argmax(np.isnan(state.hunt[searching.N_HEAD + searching.N_COLUMNS * n :][:n])))


def beginning_of(hunt: Array, width: int, nw: int) -> tuple[float, Array, Array]:
    """Return time, state and ``w`` at the beginning of the last step."""
    n, at = int(hunt[searching.COUNT]), int(hunt[searching.BEGINNING])
    kept = searching.N_HEAD + (searching.N_COLUMNS + searching.N_VALUES) * n + searching.N_STATES * width
    return float(hunt[at]), hunt[at + 1 :][:width].copy(), hunt[kept:][:nw].copy()


def taken_notes(hunt: Array, width: int, nw: int) -> list[tuple[float, int, Array]]:
    """Return time, number and state of the events noted so far; clear the notes."""
    first = notes_at(int(hunt[searching.COUNT]), width, nw)
    count, size = int(hunt[searching.NOTED]), 2 + width
    rows = hunt[first : first + count * size].reshape(count, size).copy()
    hunt[searching.NOTED] = hunt[searching.ACCEPTED] = 0.0
    return [(float(row[0]), int(row[1]), row[2:]) for row in rows]
