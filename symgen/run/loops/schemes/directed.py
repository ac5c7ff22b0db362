"""Adaptive runs with directions that keep the error of these, estimated from the stages of their accepted steps.

Directions have no weight in the choice of steps. Where the state hardly moves, steps are too long for the directions,
as their own embedded estimates show. The scheme's own memory is followed by the numbers of elements of the state and
of directions, then by the largest element of each direction, the largest error of a step and the end of that step, for
coordinates, velocities and auxiliary states.
"""

from __future__ import annotations

import math

from symgen.compile.loopcode.bare import part
from symgen.compile.loopcode.loop_instances import called
from symgen.compile.loopcode.vectors import total
from symgen.compile.native.annotations import Array
from symgen.run.layout import abi
from symgen.run.layout.records import ModelSystem, Run, Span
from symgen.run.layout.scheme_records import MULTISTEP, TABLEAU, Multistep, TableauRecord
from symgen.run.loops.frame import loop
from symgen.run.loops.schemes.adams import ADAPTIVE_PARTS as ADAMS_PARTS
from symgen.run.loops.schemes.adams import DEPTH
from symgen.run.loops.schemes.adams import renew as put_in_front
from symgen.run.loops.schemes.explicit import ADAPTIVE_PARTS
from symgen.run.loops.schemes.explicit import renew as set_first_stage

#: Positions of the numbers of elements and of directions; then, of each direction and part of the state, those of its
#: largest element, its largest error and the time of that [s].
OWN, LANES, HEAD = 0, 1, 2
SIZE, ERROR, MOMENT, NUMBERS, PARTS = 0, 1, 2, 3, 3


@called
def keep_errors(system: ModelSystem, run: Run, t: float, memory: int, error: Array, other: Array, both: int) -> None:
    """Keep the largest errors of directions; with `both`, two estimates are combined as in the error of the state."""
    sizes = system.sizes
    own, lanes = int(run.memory[memory + OWN]), int(run.memory[memory + LANES])
    work = sizes.nq + sizes.nv
    for direction in range(lanes):
        for k in range(PARTS):
            first, last = (0, sizes.nq) if k == 0 else (sizes.nq, work) if k == 1 else (work + 1, own)
            size, largest, second = 0.0, 0.0, 0.0
            for i in range(first, last):
                at = own + i * lanes + direction
                size, largest = max(size, abs(run.y[at])), max(largest, abs(error[at]))
                second = max(second, abs(other[at]))
            if both == 1 and largest > 0.0:
                largest = largest * largest / math.sqrt(largest * largest + 0.01 * second * second)
            record = part(run.memory, memory + HEAD + (direction * PARTS + k) * NUMBERS, NUMBERS)
            record[SIZE] = max(record[SIZE], size)
            if largest > record[ERROR]:
                record[ERROR], record[MOMENT] = largest, t


def renew_explicit(system: ModelSystem, scheme: TableauRecord, span: Span, run: Run, t: float, changed: bool) -> None:
    """Keep the errors of directions, and set the first stage of the next step."""
    row: int = scheme.nodes.shape[0]
    width, start = system.sizes.width, scheme.start
    error, other = part(run.room, 0, width), part(run.room, width, width)
    h, last = run.clock[abi.STEP], row + scheme.estimates
    total(width, h, start[row], start[row + 1], scheme.column, scheme.value, run.memory, error)
    total(width, h, start[last - 1], start[last], scheme.column, scheme.value, run.memory, other)
    keep_errors(system, run, t, row * width, error, other, 1 if scheme.estimates > 1 else 0)
    set_first_stage(system, scheme, span, run, t, changed)


def renew_adams(system: ModelSystem, scheme: Multistep, span: Span, run: Run, t: float, changed: bool) -> None:
    """Keep the errors of directions, and put the derivative at the accepted state in front of the history."""
    width = system.sizes.width
    error = part(run.room, 0, width)
    for i in range(width):
        error[i] *= 0.1
    keep_errors(system, run, t, DEPTH * (width + 1), error, error, 0)
    put_in_front(system, scheme, span, run, t, changed)


explicit = loop(__name__, "explicit", TABLEAU, **ADAPTIVE_PARTS | {"renew": renew_explicit})
adams = loop(__name__, "adams", MULTISTEP, **ADAMS_PARTS | {"renew": renew_adams})
