"""Looks between the steps of an adaptive run: at where the next one should end, and at what the last one has passed.

A loop around another one, which it enters for each step by its address: one for each kind of scheme, compiled when a
run first has something to look at. Single runs, runs step by step and rows of sweeps enter it in place of the other.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numba import types

from symgen.runtime import abi
from symgen.runtime.bare import bare, part
from symgen.runtime.hunting import without_notes
from symgen.runtime.instances import called, signature_of
from symgen.runtime.instances import loop as compiled_loop
from symgen.runtime.knots import aimed
from symgen.runtime.probe import rates_of
from symgen.runtime.records import Span
from symgen.runtime.switches import MOST_AGAIN, passed

if TYPE_CHECKING:
    from symgen.runtime.compiled import CompiledModel
    from symgen.runtime.integrator import Setup
    from symgen.runtime.records import State
    from symgen.runtime.run import RunSpec

#: No step is taken again that would be shorter than this part of the time: rounding says what it passes.
_SHORTEST = 1e-13
#: Numbers of a run: 1 where `before` is that of its state; how often the last step was taken again, and how long it
#: was at first; where the rates of a state are had from.
KNOWN, AGAIN, LONGEST, RATES = range(4)
#: They are not read; they stand first in what the scheme keeps; they are evaluated.
_UNREAD, _KEPT, _ASKED = range(3)
_STOP, _REJECTED, _ROW = abi.STOP, abi.REJECTED, abi.N_EVENT
_EVALUATIONS, _JACOBIANS, _ITERATIONS = abi.EVALUATIONS, abi.JACOBIANS, abi.NEWTON_ITERATIONS


class Looks(NamedTuple):
    """What is looked at between steps, and room for it.

    Attributes
    ----------
    head : Array
        Numbers: `KNOWN` and those behind it.
    before, after : Array
        Values, rates and sizes of switches at the beginning and at the end of a step.
    out : Array
        Arguments of tables with two rates.
    levels, starts, tables : Array
        What these pass, see `symgen.runtime.knots.aimed`.
    kept, counts : Array
        What the run kept at the beginning of a step.
    hunt : Array
        What it keeps of its events but notes, empty where there are none.
    y, w, iw, rate : Array
        A state at which rates are evaluated, what emitted functions remember of it, and the rates.
    """

    head: Any
    before: Any
    after: Any
    out: Any
    levels: Any
    starts: Any
    tables: Any
    kept: Any
    counts: Any
    hunt: Any
    y: Any
    w: Any
    iw: Any
    rate: Any

    def forget(self) -> None:
        """Look at the state anew: others may have changed it."""
        self.head[KNOWN] = 0.0


_A, _K = types.float64[::1], types.int64[::1]
LOOKS = types.NamedTuple((*(_A,) * 5, _K, _A, _A, _K, _A, _A, _A, _K, _A), Looks)


# -- what a run keeps --------------------------------------------------------------------------------------------------


@called
def exchanged(array: Any, kept: Any, at: int, back: bool) -> int:
    """Copy an array to where `kept` has room for it, or from there; return where that ends."""
    for i in range(array.shape[0]):
        if back:
            array[i] = kept[at + i]
        else:
            kept[at + i] = array[i]
    return at + int(array.shape[0])


def passage(state: Any) -> Any:
    """Return the last passage near a singular position, which the next state may be part of."""
    k = min(max(state.control[abi.EVENTS], 1), abi.MAX_EVENTS) - 1
    return part(state.events, k * _ROW, _ROW)


@called
def exchange(state: Any, looks: Any, back: bool) -> int:
    """Keep what a step changes but its counts, or have it again; return where these stand."""
    at = exchanged(state.y, looks.kept, 0, back)
    at = exchanged(state.w, looks.kept, at, back)
    at = exchanged(state.clock, looks.kept, at, back)
    at = exchanged(state.gauges, looks.kept, at, back)
    at = exchanged(state.memory, looks.kept, at, back)
    at = exchanged(looks.hunt, looks.kept, at, back)
    exchanged(passage(state), looks.kept, at, back)
    return int(exchanged(state.iw, looks.counts, 0, back))


@called
def keep(state: Any, looks: Any) -> None:
    """Keep what a step changes."""
    exchanged(state.control, looks.counts, exchange(state, looks, False), False)


@called
def go_back(state: Any, looks: Any) -> None:
    """Have a run be where it was, one attempt later; work that was done counts."""
    first, control = exchange(state, looks, True), state.control
    for i in range(control.shape[0]):
        if i != _STOP and i != _EVALUATIONS and i != _JACOBIANS and i != _ITERATIONS and i != _REJECTED:
            control[i] = looks.counts[first + i]
    control[_REJECTED] += 1


# -- the loop ----------------------------------------------------------------------------------------------------------


def rates_at(looks: Any, state: Any, rates: Any, confirm: Any) -> Any:
    """Return the rate of the state where a run stands."""
    if looks.head[RATES] == _ASKED:  # what emitted functions remember stays that of the step
        exchanged(state.y, looks.y, 0, False)
        exchanged(state.w, looks.w, 0, False)
        exchanged(state.iw, looks.iw, 0, False)
        t = state.clock[abi.TIME]
        if rates(t, looks.y, state.p, looks.w, looks.iw, looks.rate) != 0:
            confirm(t, looks.y, state.p, looks.w, looks.iw, looks.rate)
        state.control[abi.EVALUATIONS] += 1
    known = part(state.memory, 0, looks.rate.shape[0] if looks.head[RATES] == _KEPT else 0)
    return known if looks.head[RATES] == _KEPT else looks.rate


def until_step(span: Any, steps: float) -> Any:
    """Return a span that ends where so many steps have been accepted."""
    return Span(
        *(span.step, span.largest, span.until, span.end, span.duration, span.rtol, span.atol, span.relative),
        *(span.safety, span.most, min(span.pause, steps)),
    )


def stepped(model: Any, scheme: Any, span: Any, state: Any, outputs: Any) -> int:
    """Enter a loop for each step, as it is entered for all.

    A step is made to end at a point of a table (`symgen.runtime.knots`), and one that has passed two switches is taken
    again (`symgen.runtime.switches`).

    Parameters
    ----------
    model : tuple
        What the loop takes first, `Looks`, the loop; what gives the rates of a state and confirms them, and the
        functions of tables and of switches.
    scheme, span, state, outputs
        As for the loop.
    """
    system, looks, loop, rates, confirm, knots, switches = model
    looks, state = bare(looks), bare(state)
    head, clock, control = looks.head, state.clock, state.control
    if control[abi.BEGUN] != 1:  # the scheme has to begin before anything is known of its first step
        code = loop(system, scheme, until_step(span, float(control[abi.STEPS])), state, outputs)
        if code != abi.PAUSED:
            return int(code)
        head[KNOWN] = 0.0
    if head[KNOWN] == 0.0:
        head[AGAIN] = 0.0
        if looks.before.shape[0] > 0:
            switches(clock[abi.TIME], state.y, state.p, state.w, rates_at(looks, state, rates, confirm), looks.before)
        head[KNOWN] = 1.0
    while control[abi.STEPS] < span.pause:
        steps = control[abi.STEPS]
        if looks.out.shape[0] > 0 and head[AGAIN] == 0.0:
            knots(clock[abi.TIME], state.y, state.p, state.w, rates_at(looks, state, rates, confirm), looks.out)
            clock[abi.NEXT] = aimed(looks.levels, looks.starts, looks.tables, looks.out, clock[abi.NEXT])
        if looks.before.shape[0] > 0:
            keep(state, looks)
        code = loop(system, scheme, until_step(span, float(steps + 1)), state, outputs)
        if control[abi.STEPS] == steps or code > abi.DONE:
            return int(code)
        if looks.before.shape[0] > 0:
            switches(clock[abi.TIME], state.y, state.p, state.w, rates_at(looks, state, rates, confirm), looks.after)
            h, share = clock[abi.STEP], 1.0
            if head[AGAIN] == 0.0 or h < head[LONGEST]:
                share = passed(looks.before, looks.after, h, span.rtol)
            if share < 1.0 and head[AGAIN] < MOST_AGAIN and share * h > _SHORTEST * clock[abi.TIME]:
                go_back(state, looks)
                clock[abi.NEXT] = share * h
                head[AGAIN] += 1.0
                head[LONGEST] = h
                continue
            exchanged(looks.after, looks.before, 0, False)
            head[AGAIN] = 0.0
        if code != abi.PAUSED:
            return int(code)
    return abi.PAUSED


_loops: dict[Any, Any] = {}


def with_looks(loop: Any) -> Any:
    """Return the loop that enters another one for each step; made when it is first asked for.

    Parameters
    ----------
    loop : compiled loop
        From `symgen.runtime.frame.loop`, or one that looks for events.
    """
    if loop not in _loops:
        name = f"{loop.__module__.rpartition('.')[2]}_{loop.__name__}"
        signature, functions = signature_of(loop), (abi.RHS, abi.RHS, abi.OBSERVE, abi.OBSERVE)
        model = types.Tuple((*signature.args[:1], LOOKS, types.FunctionType(signature), *functions))
        made = compiled_loop(__name__, name, stepped, types.int64(model, *signature.args[1:]), once=True)
        _loops[loop] = globals()[name] = made  # it is known by its name, as all loops are
    return _loops[loop]


# -- from Python -------------------------------------------------------------------------------------------------------


def looking(
    compiled: CompiledModel, setup: Setup, spec: RunSpec, system: tuple[Any, ...], state: State
) -> tuple[tuple[Any, ...], Looks]:
    """Return what the loop takes first, and what of it is looked at.

    Parameters
    ----------
    compiled, setup, spec
        Model and method, the scheme, and what there is to look at.
    system : tuple
        What the loop takes that is entered for each step.
    state : State
        What the run keeps.
    """
    law, knots, switches, hunt = compiled.law_module, spec.knots, spec.switches, without_notes(state)
    rates, source, count = setup.functions[:2], _UNREAD, 0 if switches is None else switches.count
    levels, starts, tables = (np.zeros(0),) * 3 if knots is None else knots.arrays(spec.rtol)
    if setup.knows_rates and not hasattr(law, "rates"):
        source = _KEPT
    elif knots is not None or (switches is not None and switches.needs_rates):
        rates, source = rates_of(law), _ASKED
    floats = state.y, state.w, state.clock, state.gauges, state.memory, hunt
    looks = Looks(
        *(np.array([0.0, 0.0, 0.0, source]), np.zeros(3 * count), np.zeros(3 * count), np.zeros(len(tables))),
        *(levels, starts.astype(np.int64), tables, np.zeros(sum(map(len, floats)) + _ROW)),
        *(np.zeros(len(state.iw) + len(state.control), dtype=np.int64), hunt),
        *(np.zeros_like(array) for array in (state.y, state.w, state.iw, state.y)),
    )
    functions = [x.function for x in (knots or switches, switches or knots) if x is not None]
    return (system, looks, setup.loop, *rates, *functions), looks
