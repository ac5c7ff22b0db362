"""Steps ahead with directions, in one call: the loop of a run with directions, entered step by step.

Before each step the directions in the state are set to seeds, so that after the step they are the derivatives of this
step alone. The loop writes states, derivatives of states and derivatives of outputs for each step. If there are more
directions than the code has lanes, the loop takes the same step again for the others.
"""

from __future__ import annotations

from typing import Any

from symgen.compile.loopcode.bare import bare, part
from symgen.compile.loopcode.loop_instances import compiled_loop, signature_of
from symgen.compile.native import types
from symgen.compile.native.annotations import Array, Integers, Record, record_type
from symgen.compile.store.jit import RuntimeFunction, jit
from symgen.run.layout import abi
from symgen.run.layout import ensemble_abi as e
from symgen.run.layout.records import ModelSystem, Outputs, Span, State, System
from symgen.run.loops.frame_parts import evaluate
from symgen.run.loops.step_control import part_of_step

#: Code of an end beside those of loops: the step ends elsewhere than that of the run.
ELSEWHERE = 200
#: Numbers of `Ahead.head`: steps, passes and lanes; outputs; 1 where steps vary, and where the end of the one step is
#: compared.
STEPS, PASSES, LANES, OUTPUTS, ADAPTIVE, COMPARES = range(6)
#: Numbers of `Ahead.numbers`: the end of the first step and the length of further ones [s]; part of the state by which
#: an end may differ.
END, LENGTH, SAME = range(3)


class Ahead(Record):
    """Steps ahead.

    Attributes
    ----------
    head, numbers : Array of int64, Array
        At the places of `STEPS` and following, and of `END` and following.
    y, p, w, iw, clock, gauges, control : Array, Array of int64
        The state before, without directions; overwritten. Numbers computed from parameters are the last elements of
        p; the run with directions computes its own, which may be more or fewer.
    end : Array
        The state after the one step, where it is compared.
    places : Array of int64
        Places in y of the states.
    inputs : Array of int64
        Places in p of the inputs; `values` has theirs, step by step; empty where inputs stay.
    seeds, numbers_by : Array
        Directions of y and of p at the beginning of each pass; inputs change no masses.
    states, slopes, by_outputs : Array
        Results, step by step.
    still, room : Array
        Working memory: arrays of y, p and w with directions, and outputs with them.
    """

    head: Integers
    numbers: Array
    y: Array
    p: Array
    w: Array
    iw: Integers
    clock: Array
    gauges: Array
    control: Integers
    end: Array
    places: Integers
    inputs: Integers
    values: Array
    seeds: Array
    numbers_by: Array
    states: Array
    slopes: Array
    by_outputs: Array
    still: Array
    room: Array


AHEAD = record_type(Ahead)


def copy_to_beginning(source: Array | Integers, target: Array | Integers) -> None:
    """Copy an array to the beginning of another one."""
    for i in range(source.shape[0]):
        target[i] = source[i]


def begin_pass(a: Ahead, state: State, k: int, which: int, prepare: e.Prepare, prepare_law: e.Prepare) -> None:
    """Give a run with directions the state before step `k`, with the seeds of a pass."""
    lanes = a.head[LANES]
    ny, np, nw = a.y.shape[0], state.p.shape[0] // (1 + lanes), a.w.shape[0]
    copy_to_beginning(a.y, state.y)
    copy_to_beginning(part(a.seeds, which * ny * lanes, ny * lanes), part(state.y, ny, ny * lanes))
    copy_to_beginning(a.p, state.p)
    copy_to_beginning(part(a.numbers_by, which * np * lanes, np * lanes), part(state.p, np, np * lanes))
    copy_to_beginning(a.w, state.w)
    for i in range(nw, nw * (1 + lanes)):
        state.w[i] = 0.0
    copy_to_beginning(a.iw, state.iw)
    copy_to_beginning(a.clock, state.clock)
    copy_to_beginning(a.gauges, state.gauges)
    copy_to_beginning(a.control, state.control)
    count = a.inputs.shape[0]
    if a.values.shape[0] > 0:
        for i in range(count):
            state.p[a.inputs[i]] = a.values[k * count + i]
    prepare(state.p)
    prepare_law(state.p)


def keep_pass(a: Ahead, state: State, k: int, which: int) -> None:
    """Keep the derivatives of the states after step `k`."""
    lanes, n, ny = a.head[LANES], a.places.shape[0], a.y.shape[0]
    row = a.head[PASSES] * lanes
    for i in range(n):
        first, to = ny + a.places[i] * lanes, (k * n + i) * row + which * lanes
        for j in range(lanes):
            a.slopes[to + j] = state.y[first + j]


def keep_outputs(a: Ahead, state: State, k: int, observe: abi.Observe) -> None:
    """Keep the derivatives of outputs at the state after step `k`, by that state."""
    lanes, count = a.head[LANES], a.head[OUTPUTS]
    ny, np, nw = a.y.shape[0], state.p.shape[0] // (1 + lanes), a.w.shape[0]
    y, p = part(a.still, 0, state.y.shape[0]), part(a.still, state.y.shape[0], state.p.shape[0])
    w = part(a.still, state.y.shape[0] + state.p.shape[0], state.w.shape[0])
    row = a.head[PASSES] * lanes
    for which in range(a.head[PASSES]):
        copy_to_beginning(part(state.y, 0, ny), y)
        copy_to_beginning(part(a.seeds, which * ny * lanes, ny * lanes), part(y, ny, ny * lanes))
        copy_to_beginning(part(state.p, 0, np), p)
        copy_to_beginning(part(state.w, 0, nw), w)
        for i in range(nw, w.shape[0]):
            w[i] = 0.0
        rates, out = part(a.room, 0, y.shape[0]), part(a.room, y.shape[0], count * (1 + lanes))
        observe(state.clock[abi.TIME], y, p, w, rates, out)
        for i in range(count):
            for j in range(lanes):
                a.by_outputs[(k * count + i) * row + which * lanes + j] = out[count + i * lanes + j]


def ends_elsewhere(a: Ahead, y: Array) -> bool:
    """Whether a state differs from the state of the run after its step."""
    largest, off = 1.0, 0.0
    for i in range(a.end.shape[0]):
        largest, off = max(largest, abs(a.end[i])), max(off, abs(a.end[i] - y[i]))
    return not off <= a.numbers[SAME] * largest


def step_ahead(model: System, scheme: Record, span: Span, state: State, outputs: Outputs) -> int:
    """Make steps from a state, each with its derivatives.

    Parameters
    ----------
    model : tuple
        First argument of the loop, `Ahead`, the loop, ``prepare`` of model and law, and the function of outputs.
    scheme, span, state, outputs
        As for the loop.

    Returns
    -------
    int
        Code of the end of the last step, `ELSEWHERE` where this is compared and another one.
    """
    system, ahead, loop, prepare, prepare_law, observe = model
    a, run = bare(ahead), bare(state)
    n = a.places.shape[0]
    for k in range(a.head[STEPS]):
        until = a.numbers[END] if k == 0 else a.clock[abi.TIME] + a.numbers[LENGTH]
        for which in range(a.head[PASSES]):
            begin_pass(a, run, k, which, prepare, prepare_law)
            if a.head[ADAPTIVE] != 0 and run.control[abi.BEGUN] == 1:
                # the scheme's memory of the last rates has directions as well
                evaluate(ModelSystem(*system), run, run.clock[abi.TIME], run.y, run.memory)
            code = loop(system, scheme, part_of_step(span, until, span.step), state, outputs)
            if code != abi.DONE:
                return int(code)
            keep_pass(a, run, k, which)
        if a.head[COMPARES] != 0 and ends_elsewhere(a, run.y):
            return ELSEWHERE
        for i in range(n):
            a.states[k * n + i] = run.y[a.places[i]]
        if a.head[OUTPUTS] > 0:
            keep_outputs(a, run, k, observe)
        if k + 1 < a.head[STEPS]:
            copy_to_beginning(part(run.y, 0, a.y.shape[0]), a.y)
            copy_to_beginning(part(run.p, 0, a.p.shape[0]), a.p)
            copy_to_beginning(part(run.w, 0, a.w.shape[0]), a.w)
            copy_to_beginning(run.iw, a.iw)
            copy_to_beginning(run.clock, a.clock)
            copy_to_beginning(run.gauges, a.gauges)
            copy_to_beginning(run.control, a.control)
    return abi.DONE


@jit(entry=True)
def observe_nothing_ahead(t: float, y: Array, p: Array, w: Array, ydot: Array, out: Array) -> int:
    """Replace the outputs of a file that has none; it is never called."""
    return 0


_loops: dict[Any, Any] = {}


def loop_ahead_of(loop: RuntimeFunction) -> Any:
    """Return the loop that enters another one step by step, made at the first use.

    Parameters
    ----------
    loop : compiled loop
        From `symgen.run.loops.frame.loop`, without events.
    """
    if loop not in _loops:
        name = f"{loop.__module__.rpartition('.')[2]}_{loop.__name__}"
        signature = signature_of(loop)
        kinds = AHEAD, types.FunctionType(signature), e.PREPARE, e.PREPARE, abi.OBSERVE
        model = types.RecordType((*signature.arguments[:1], *kinds))
        entry = compiled_loop(__name__, name, step_ahead, types.int64(model, *signature.arguments[1:]))
        _loops[loop] = globals()[name] = entry  # it is known by its name, as all loops are
    return _loops[loop]
