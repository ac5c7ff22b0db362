"""Explicit Runge-Kutta runs that keep their stages, and the adjoint of such a run, step by step backwards.

The scheme's own memory is followed by the number of records and the records: of each step its end, its length, the
corrections of its state, the accepted state, and the rates of all stages. The first record of a part of a run is where
it begins: it has no stages. With these the states at stages are sums, so the adjoint evaluates nothing but adjoints.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from symgen.compile.loopcode.bare import bare, part
from symgen.compile.loopcode.loop_instances import compiled_loop
from symgen.compile.loopcode.vectors import copied, follow, total
from symgen.compile.native import types
from symgen.compile.native.annotations import Array, Integers, Record, function_type, signature_from
from symgen.run.layout import abi
from symgen.run.layout.records import ModelSystem, Run, Span
from symgen.run.layout.scheme_records import TABLEAU, TableauRecord
from symgen.run.loops.frame import loop
from symgen.run.loops.schemes.explicit import ADAPTIVE_PARTS, CONSTANT_PARTS
from symgen.run.loops.schemes.explicit import attempt as adaptive_step
from symgen.run.loops.schemes.explicit import attempt_constant as constant_step
from symgen.run.loops.schemes.explicit import prepare as begin_scheme
from symgen.run.loops.schemes.explicit import renew as set_first_stage

#: Positions in the head of the memory: number of records, rounds of corrections before a step, steps that are kept,
#: number of angles that count turns, number and place of the numbers of modes that steps renew; then its length.
RECORDS, ROUNDS, KEPT_STEPS, TURNING, RENEWED, PLACE, HEAD = 0, 1, 2, 3, 4, 5, 8
#: Positions in a record: time [s], step [s], rounds of corrections, angles that count turns and after them renewed
#: numbers of modes; the state begins at a multiple of so many numbers, the length of vectors.
TIME, STEP, CORRECTIONS, ANGLES, _ALIGNED = 0, 1, 2, 3, 8
#: Adjoint of ``rhs``: adjoints of y, p, w and ydot follow its arguments.
Rates = Callable[[float, Array, Array, Array, Integers, Array, Array, Array, Array, Array], int]
#: Adjoint of ``accept`` with some rounds: adjoints of y, p and w follow its arguments.
Correction = Callable[[float, Array, Array, Array, Integers, Array, Array, Array], int]
RATES, CORRECTION = function_type(Rates), function_type(Correction)


class Corrections(Record):
    """Adjoints of ``accept`` with some rounds before its last one."""

    none: Correction
    one: Correction
    two: Correction
    three: Correction


class RecordSizes(Record):
    """Sizes of the records of steps.

    Attributes
    ----------
    width, angles : int
        Numbers of elements of a state, and of angles that count turns.
    renewed, place : int
        Number and place of numbers of modes that steps renew.
    """

    width: int
    angles: int
    renewed: int
    place: int


class Transposed(Record):
    """Coefficients of a scheme by columns, as the adjoint takes them.

    Attributes
    ----------
    start, column, value : Array
        Row s has the coefficients of the rate at stage s in all later stages, and in the end of the step after them;
        then a row of ones for all stages.
    """

    start: Integers
    column: Integers
    value: Array


def transpose_tableau(scheme: TableauRecord) -> Transposed:
    """Return the coefficients of a tableau by columns."""
    stages, start, column, value = int(scheme.stages), [0], list[int](), list[float]()
    first, columns, values = (x.tolist() for x in (scheme.start, scheme.column, scheme.value))
    for s in range(stages):
        for row in range(s + 1, stages + 1):
            for k in range(first[row], first[row + 1]):
                if columns[k] == s:
                    column.append(row)
                    value.append(values[k])
        start.append(len(column))
    column += range(stages)
    value += [1.0] * stages
    start.append(len(column))
    return Transposed(np.array(start, dtype=np.int64), np.array(column, dtype=np.int64), np.array(value))


def state_at(numbers: int) -> int:
    """Return the place of the state in a record with some numbers of the scratch."""
    return _ALIGNED * ((ANGLES + numbers + _ALIGNED - 1) // _ALIGNED)


def record_size(width: int, stages: int, numbers: int) -> int:
    """Return the length of the record of a step with some numbers of the scratch."""
    return state_at(numbers) + (1 + stages) * width


def keep_forward(system: ModelSystem, scheme: TableauRecord, run: Run, t: float, memory: int, stages: Array) -> None:
    """Keep an accepted step."""
    width, count, angles = system.sizes.width, int(run.memory[memory + RECORDS]), int(run.memory[memory + TURNING])
    renewed, place = int(run.memory[memory + RENEWED]), int(run.memory[memory + PLACE])
    head = state_at(angles + renewed)
    size = head + (1 + scheme.stages) * width
    record = part(run.memory, memory + HEAD + count * size, size)
    record[TIME], record[STEP] = t, run.clock[abi.STEP]
    record[CORRECTIONS] = run.iw[abi.ITERATIONS] - run.memory[memory + ROUNDS]
    for i in range(angles):
        record[ANGLES + i] = run.w[abi.WINDING + i]
    for i in range(renewed):
        record[ANGLES + angles + i] = run.w[place + i]
    copied(width, run.y, part(record, head, width))
    copied(scheme.stages * width, stages, part(record, head + width, scheme.stages * width))
    run.memory[memory + RECORDS] = count + 1.0
    run.memory[memory + KEPT_STEPS] = run.control[abi.STEPS]


def attempt_recorded(
    system: ModelSystem,
    scheme: TableauRecord,
    span: Span,
    run: Run,
    t: float,
    following: float,
    h: float,
    between: bool,
) -> float:
    """Try a constant step; note how many rounds of corrections there were before."""
    run.memory[ROUNDS] = run.iw[abi.ITERATIONS]
    return float(constant_step(system, scheme, span, run, t, following, h, between))


def attempt_adaptive(
    system: ModelSystem,
    scheme: TableauRecord,
    span: Span,
    run: Run,
    t: float,
    following: float,
    h: float,
    between: bool,
) -> float:
    """Try an adaptive step; note how many rounds of corrections there were before."""
    run.memory[scheme.nodes.shape[0] * system.sizes.width + ROUNDS] = run.iw[abi.ITERATIONS]
    return float(adaptive_step(system, scheme, span, run, t, following, h, between))


def renew_constant(system: ModelSystem, scheme: TableauRecord, span: Span, run: Run, t: float, changed: bool) -> None:
    """Keep a constant step."""
    keep_forward(system, scheme, run, t, 0, run.room)


def renew_adaptive(system: ModelSystem, scheme: TableauRecord, span: Span, run: Run, t: float, changed: bool) -> None:
    """Keep an adaptive step, and set the first stage of the next one."""
    keep_forward(system, scheme, run, t, scheme.nodes.shape[0] * system.sizes.width, run.memory)
    set_first_stage(system, scheme, span, run, t, changed)


def prepare_adaptive(system: ModelSystem, scheme: TableauRecord, span: Span, run: Run) -> None:
    """Keep a step that ends where rates have a kink, and set the first stage of the next one."""
    memory = scheme.nodes.shape[0] * system.sizes.width
    if run.control[abi.STEPS] > run.memory[memory + KEPT_STEPS]:
        keep_forward(system, scheme, run, run.clock[abi.TIME], memory, run.memory)
    begin_scheme(system, scheme, span, run)


constant = loop(
    __name__, "constant", TABLEAU, **CONSTANT_PARTS | {"attempt": attempt_recorded, "renew": renew_constant}
)
adaptive = loop(
    __name__,
    "adaptive",
    TABLEAU,
    **ADAPTIVE_PARTS | {"prepare": prepare_adaptive, "attempt": attempt_adaptive, "renew": renew_adaptive},
)


def undo(
    corrections: Corrections,
    rounds: int,
    t: float,
    y: Array,
    p: Array,
    w: Array,
    iw: Integers,
    y_bar: Array,
    p_bar: Array,
    w_bar: Array,
) -> None:
    """Do nothing: accepted states are those at the ends of steps."""


def undo_rounds(
    corrections: Corrections,
    rounds: int,
    t: float,
    y: Array,
    p: Array,
    w: Array,
    iw: Integers,
    y_bar: Array,
    p_bar: Array,
    w_bar: Array,
) -> None:
    """Take back a correction: the adjoint of the corrected state becomes the adjoint of the state `y` before."""
    if rounds == 0:
        corrections.none(t, y, p, w, iw, y_bar, p_bar, w_bar)
    elif rounds == 1:
        corrections.one(t, y, p, w, iw, y_bar, p_bar, w_bar)
    elif rounds == 2:
        corrections.two(t, y, p, w, iw, y_bar, p_bar, w_bar)
    else:
        corrections.three(t, y, p, w, iw, y_bar, p_bar, w_bar)


def carry_adjoint_back(
    rates: Rates,
    corrections: Corrections,
    scheme: TableauRecord,
    table: Transposed,
    sizes: RecordSizes,
    records: Array,
    p: Array,
    w: Array,
    iw: Integers,
    bars: Array,
    room: Array,
) -> int:
    """Turn the adjoint of the state at the end of a run into adjoints of start, parameters and scratch.

    Parameters
    ----------
    rates : function
        Adjoint of ``rhs``.
    corrections : Corrections
        Adjoints of ``accept`` with 0, 1, 2 and 3 rounds before its last one; 0 where it changes no state.
    scheme : TableauRecord
        The scheme.
    table : Transposed
        Its coefficients by columns.
    sizes : RecordSizes
        Sizes of the records.
    records : Array
        The start and the steps.
    p, w, iw : Array
        As of the run; the scratch is changed.
    bars : Array
        Adjoints of the state, the parameters and the scratch one after the other; changed.
    room : Array
        Working memory of (stages + 4) states.
    """
    scheme, table, records, p, w, iw, bars, room = (
        bare(scheme),
        bare(table),
        bare(records),
        bare(p),
        bare(w),
        bare(iw),
        bare(bars),
        bare(room),
    )
    stages, start, column, value = scheme.stages, scheme.start, scheme.column, scheme.value
    width, angles, renewed, place = sizes.width, sizes.angles, sizes.renewed, sizes.place
    head = state_at(angles + renewed)
    size = head + (1 + stages) * width
    y_bar, p_bar = part(bars, 0, width), part(bars, width, p.shape[0])
    w_bar = part(bars, width + p.shape[0], w.shape[0])
    trial, rate, rate_bar = part(room, 0, width), part(room, width, width), part(room, 2 * width, width)
    bars_of_stages = part(room, 3 * width, (stages + 1) * width)
    count = records.shape[0] // size - 1
    for back in range(count):
        k = count - back
        h, t = records[k * size + STEP], records[(k - 1) * size + TIME]
        before = part(records, (k - 1) * size + head, width)
        ks = part(records, k * size + head + width, stages * width)
        w[abi.STEP_STATUS] = h
        for i in range(angles):
            w[abi.WINDING + i] = records[(k - 1) * size + ANGLES + i]
        for i in range(renewed):
            w[place + i] = records[(k - 1) * size + ANGLES + angles + i]
        follow(width, h, start[stages], start[stages + 1], column, value, ks, before, trial)
        undo(
            corrections,
            int(records[k * size + CORRECTIONS]),
            records[k * size + TIME],
            trial,
            p,
            w,
            iw,
            y_bar,
            p_bar,
            w_bar,
        )
        copied(width, y_bar, part(bars_of_stages, stages * width, width))
        for last in range(stages):
            s = stages - 1 - last
            stage_bar = part(bars_of_stages, s * width, width)
            follow(width, h, start[s], start[s + 1], column, value, ks, before, trial)
            total(width, h, table.start[s], table.start[s + 1], table.column, table.value, bars_of_stages, rate_bar)
            for i in range(width):
                stage_bar[i] = 0.0
            rates(t + scheme.nodes[s] * h, trial, p, w, iw, rate, stage_bar, p_bar, w_bar, rate_bar)
        follow(
            width,
            1.0,
            table.start[stages],
            table.start[stages + 1],
            table.column,
            table.value,
            bars_of_stages,
            y_bar,
            y_bar,
        )
    return 0


_SIGNATURE = signature_from(carry_adjoint_back)
#: Without corrections an unused number takes their place.
_UNCORRECTED = types.int64(RATES, types.int64, *_SIGNATURE.arguments[2:])
back_through = compiled_loop(__name__, "back_through", carry_adjoint_back, _UNCORRECTED)
back_through_corrected = compiled_loop(
    __name__, "back_through_corrected", carry_adjoint_back, _SIGNATURE, undo=undo_rounds
)
