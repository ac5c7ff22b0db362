"""Many runs that are kept between steps: one compiled call takes each of them on by a time and evaluates formulas.

A row is the block of memory of a single run. It is copied to where the loop of single runs works, so that each row
takes the steps of a single run, bit for bit.
"""

from __future__ import annotations

from typing import Any

from symgen.compile.loopcode.bare import bare, part
from symgen.compile.loopcode.loop_instances import compiled_loop, signature_of
from symgen.compile.native import types
from symgen.compile.native.annotations import Array, Integers, Record, record_type
from symgen.compile.store.jit import RuntimeFunction
from symgen.run.layout import abi
from symgen.run.layout import ensemble_abi as e
from symgen.run.layout.records import OUTPUTS, SPAN, STATE, Outputs, Span, State, System
from symgen.run.loops.seams import is_defined
from symgen.run.loops.step_control import part_of_step


class Stepped(Record):
    """Rows of a step, and where its results go.

    Attributes
    ----------
    fronts : Array, shape (rows, size), flat
        Memory of each run.
    front : Array, shape (size,)
        Memory of the run that the loop works on.
    given : Array, shape (rows, inputs), flat
        Values of the inputs.
    places : Array of int64
        Indices of the inputs in ``p``.
    moving : Array of int64
        1 for rows that go on; others are measured alone.
    codes : Array of int64
        End code of each row, written.
    values : Array, shape (rows, formulas), flat
        Written.
    until : Array
        Time to reach, of each row [s]; written.
    w, rates, counters : Array, Array of int64
        Working memory of formulas.
    dt : Array, shape (1,)
        Time of a step [s].
    bounds : Array of int64, shape (2,)
        Rows of this call.
    rated, adaptive : int
        1 where formulas read accelerations or forces of joints; where steps vary.
    """

    fronts: Array
    front: Array
    given: Array
    places: Integers
    moving: Integers
    codes: Integers
    values: Array
    until: Array
    w: Array
    rates: Array
    dt: Array
    counters: Integers
    bounds: Integers
    rated: int
    adaptive: int


STEPPED = record_type(Stepped)


def changed_inputs(table: Stepped, r: int, p: Array) -> bool:
    """Set the inputs of a row; return whether one has changed."""
    other, count = False, table.places.shape[0]
    for i in range(count):
        value = table.given[r * count + i]
        other = other or p[table.places[i]] != value
        p[table.places[i]] = value
    return other


def evaluate_stepped_rows(model: System, table: Stepped, r: int, state: State) -> None:
    """Evaluate the formulas of a row at its state, which stays as it is."""
    rates, confirm, observe, count = model
    t, w, counters = state.clock[abi.TIME], table.w, table.counters
    for i in range(w.shape[0]):
        w[i] = state.w[i]
    if table.rated == 1:
        for i in range(counters.shape[0]):
            counters[i] = 0
        if rates(t, state.y, state.p, w, counters, table.rates) != 0:
            confirm(t, state.y, state.p, w, counters, table.rates)
    observe(t, state.y, state.p, w, table.rates, part(table.values, r * count, count))


def step_each(model: System, scheme: Record, span: Span, table: Stepped, state: State, outputs: Outputs) -> int:
    """Advance rows by a time, and evaluate formulas at their states then.

    A row that fails stays where it was. One whose loop has a request (a negative code) is left as it is there.

    Parameters
    ----------
    model : tuple
        First argument of the loop over one run, this loop, ``prepare`` of model and law, and the functions and the
        number of the formulas.
    scheme, span, state, outputs
        As for the loop.
    table : Stepped
        The rows.
    """
    system, loop, prepare, prepare_law, formulas = model
    table, state = bare(table), bare(state)
    size, control = table.front.shape[0], state.control
    for r in range(table.bounds[0], table.bounds[1]):
        row = part(table.fronts, r * size, size)
        for i in range(size):
            table.front[i] = row[i]
        code = int(abi.DONE)
        if table.moving[r] == 1:
            if changed_inputs(table, r, state.p):
                prepare(state.p)
                prepare_law(state.p)
                if control[abi.BEGUN] == 1:
                    control[abi.BEGUN] = abi.AFRESH
                if not is_defined(state.p):
                    code = int(abi.UNPREPARED)
            table.until[r] = state.clock[abi.TIME] + table.dt[0]
            step = span.step
            if table.adaptive == 1 and control[abi.STEPS] > 0:  # a scheme that begins anew keeps its step
                step = state.clock[abi.NEXT]
            if code == abi.DONE:
                code = loop(system, scheme, part_of_step(span, table.until[r], step), state, outputs)
            if code <= abi.DONE:
                for i in range(size):
                    row[i] = table.front[i]
            else:
                for i in range(size):
                    table.front[i] = row[i]
        table.codes[r] = code
        if code >= abi.DONE:
            evaluate_stepped_rows(formulas, table, r, state)
    return 0


_FORMULAS = types.RecordType((abi.RHS, abi.RHS, abi.OBSERVE, types.int64))
_loops: dict[Any, Any] = {}


def over_stepped(loop: RuntimeFunction) -> Any:
    """Return the compiled function around the loop of single runs, made at the first use."""
    if loop not in _loops:
        name = f"{loop.__module__.rpartition('.')[2]}_{loop.__name__}_stepped"
        signature = signature_of(loop)
        system, scheme = signature.arguments[:2]
        model = types.RecordType((system, types.FunctionType(signature), e.PREPARE, e.PREPARE, _FORMULAS))
        kind = types.int64(model, scheme, SPAN, STEPPED, STATE, OUTPUTS)
        _loops[loop] = globals()[name] = compiled_loop(__name__, name, step_each, kind)
    return _loops[loop]
