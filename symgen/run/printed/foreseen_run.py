"""Times at which formulas jump or have kinks, found by a run for its own parameters, for programs without Python.

Runs of Python have these times before they begin (`symgen.run.breaks.foreseen_seams`). A program whose parameters
change finds them anew at each start, window after window: a window is as long as the run, and shorter where it has more
jumps than there is room for. Where all formulas are straight lines over time, and pass few levels, the first window has
no end.
"""

from __future__ import annotations

import math
from typing import Any

from symgen.compile.loopcode.loop_instances import Meanings, called, compiled_loop
from symgen.compile.native import types
from symgen.compile.native.annotations import Array, Integers, record_type
from symgen.run.layout import abi
from symgen.run.layout.records import STATE, State
from symgen.run.loops.event_loop import EVENT_STATE
from symgen.run.loops.seams import SEAMS, Seams
from symgen.run.loops.times_of_jumps import (
    COUNT,
    DROPPED,
    FROM,
    LEFT_OUT,
    TO,
    JumpSearch,
    lay_seams,
    length_of,
    note_line,
    search_curve,
)

_F, _N = types.float64, types.int64


class Foresight(JumpSearch):
    """A search of a run for its own parameters.

    Attributes
    ----------
    lines : function
        Values of formulas: of a straight line that at 0 and the slope.
    slots, straight : Array of int64, shape (k,)
        Of each formula its place in `out`, 1 for a straight line.
    out : Array
        Values of all formulas.
    """

    lines: abi.Observe
    slots: Integers
    straight: Integers
    out: Array


FORESIGHT = record_type(Foresight)


@called
def emitted_formula_at(f: Foresight, state: State, j: int, t: float) -> float:
    """Return the value of formula j at a time."""
    f.lines(t, state.y, state.p, state.w, state.y, f.out)
    return float(f.out[f.slots[j]])


def foresee_run(is_start: int, t: float, foresight: Foresight, seams: Seams, state: State) -> int:
    """Lay out the seams of a run at its start, or of the next window where the present one ends.

    Parameters
    ----------
    is_start : int
        1 where a run begins, at 0 s.
    t : float
        The time up to which the run has come [s].
    foresight : Foresight
        Passages of formulas.
    seams : Seams
        Written; none has been passed.
    state : State
        State of the run, with its parameters.

    Returns
    -------
    int
        1 where seams have been laid out.
    """
    f = foresight
    if is_start == 0 and (f.known[TO] == math.inf or t < f.known[TO] * (1.0 - f.same)):
        return 0
    start, end, whole, count = 0.0 if is_start != 0 else f.known[TO], math.inf, length_of(f), f.kinds.shape[0]
    for j in range(count):
        if f.straight[j] == 0 or f.periods[j] > 0.0:
            end = start + whole
    f.found[COUNT] = f.found[DROPPED] = f.found[LEFT_OUT] = 0
    f.known[FROM] = start
    for j in range(count):
        if f.straight[j] != 0:
            f.lines(0.0, state.y, state.p, state.w, state.y, f.out)
            at = f.slots[j]
            note_line(f, j, f.out[at], f.out[at + 1], start, end)
        else:
            search_curve(f, state, j, start, end)
    if f.found[DROPPED] != 0:
        n = f.found[COUNT] - 1
        f.found[COUNT], end = n, 0.5 * (f.moments[n - 1] + f.moments[n])
    f.known[TO], seams.rows[1], state.control[abi.PASSED] = end, 0, 0
    lay_seams(f, seams, end)
    return 1


FORESEEN = Meanings("printed runs that find times of jumps", formula_at=emitted_formula_at)
_loops: dict[bool, Any] = {}


def foreseen_run(events: bool) -> Any:
    """Return `foresee_run` for runs with or without switching functions, made at the first use."""
    if events not in _loops:
        signature = types.int64(_N, _F, FORESIGHT, SEAMS, EVENT_STATE if events else STATE)
        name = "foresee_events" if events else "foresee"
        _loops[events] = compiled_loop(__name__, name, foresee_run, signature, **FORESEEN)
    return _loops[events]
