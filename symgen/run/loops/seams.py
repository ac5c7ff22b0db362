"""The loop from seam to seam, where parameters change and the scheme restarts without a return to Python.

It encloses another loop, which it enters for each part of a run by its address: one for each kind of loop, compiled
when a run first has seams. Single runs, runs step by step and rows of sweeps enter it in place of the other.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from symgen.compile.loopcode.bare import bare
from symgen.compile.loopcode.loop_instances import compiled_loop, signature_of
from symgen.compile.native import types
from symgen.compile.native.annotations import Array, Integers, Record, record_type
from symgen.compile.store.jit import RuntimeFunction, jit
from symgen.run.layout import abi
from symgen.run.layout import ensemble_abi as e
from symgen.run.layout.records import Outputs, Span, State, System
from symgen.run.loops.step_control import part_of_step

if TYPE_CHECKING:
    from symgen.run.layout.compiled import CompiledModel
    from symgen.run.loops.run_spec import Seam

#: Numbers of `Seams.head`: the present row, and 1 where steps are adaptive, and where modes are chosen at each change.
ROW, VARYING, CHOOSES = range(3)


class Seams(Record):
    """The seams of all rows one after the other; a single run is one row.

    Attributes
    ----------
    head : Array of int64
        `ROW`, `VARYING` and `CHOOSES`.
    rows : Array of int64, shape (rows + 1,)
        First seam of each row.
    times : Array
        Times of the seams, in order in each row [s].
    skips : Array of int64, shape (seams,)
        1 for seams after which a run goes on at the next one, without a step; 2 where rates of gaps jump
        between the two.
    changes : Array of int64, shape (seams + 1,)
        First change of each seam.
    places, values : Array of int64, Array
        Changes: an index in ``p``, and the value there from then on.
    """

    head: Integers
    rows: Integers
    times: Array
    skips: Integers
    changes: Integers
    places: Integers
    values: Array


SEAMS = record_type(Seams)


def seams_with_room(most: int, adaptive: bool, chooses: bool = False) -> Seams:
    """Return room for the seams of one run, at which no number changes.

    Parameters
    ----------
    most : int
        Number of seams.
    adaptive, chooses : bool
        Whether steps are adaptive, and modes are chosen at each change.
    """
    head, rows, none = np.array([0, int(adaptive), int(chooses)]), np.zeros(2, dtype=np.int64), np.zeros(0)
    skips, changes = np.zeros(most, dtype=np.int64), np.zeros(most + 1, dtype=np.int64)
    return Seams(head, rows, np.zeros(most), skips, changes, none.astype(np.int64), none)


def due_time(seams: Seams, count: int) -> float:
    """Return the time of seam number `count` of the present row [s]; infinity after the last one."""
    at = seams.rows[seams.head[ROW]] + count
    return float(seams.times[at]) if at < seams.rows[seams.head[ROW] + 1] else math.inf


def write_seam(seams: Seams, count: int, p: Array) -> bool:
    """Write the values of seam number `count` to `p`; return whether any has changed."""
    at, other = seams.rows[seams.head[ROW]] + count, False
    for i in range(seams.changes[at], seams.changes[at + 1]):
        other = other or p[seams.places[i]] != seams.values[i]
        p[seams.places[i]] = seams.values[i]
    return other


def has_gap(seams: Seams, count: int) -> bool:
    """Whether a run goes on at the next seam, without a step, after seam number `count` of the present row."""
    at = seams.rows[seams.head[ROW]] + count
    return bool(at < seams.rows[seams.head[ROW] + 1] and seams.skips[at] != 0)


def has_struck(seams: Seams, count: int) -> bool:
    """Whether rates of gaps have jumped before seam number `count` of the present row."""
    at = seams.rows[seams.head[ROW]] + count - 1
    return bool(count > 0 and seams.skips[at] == 2)


def span_of_part(seams: Seams, count: int, span: Span, clock: Array, control: Integers) -> tuple[float, float]:
    """Return end and steps [s] of a part of a run: towards seam number `count`, after which the run skips.

    A grid of constant steps may have a point there to rounding. No stage may lie after the seam: the last step is
    shorter by that much, and the grid is moved for it.
    """
    to, step, origin = due_time(seams, count), float(span.step), float(clock[abi.ORIGIN])
    if seams.head[VARYING] == 0 and to <= span.until:
        ahead = math.floor((to - origin) / step + 0.5)
        before = origin + (ahead - 1.0) * step
        if abs(to - (origin + ahead * step)) <= abi.SAME_TIME * step:
            if before - clock[abi.TIME] > time_tolerance(seams, span, to):
                to = before
            else:
                step = to - float(clock[abi.TIME])
                clock[abi.ORIGIN] = to - (float(control[abi.INDEX]) + 1.0) * step
    return to, step


def skip_to_seam(seams: Seams, count: int, clock: Array) -> None:
    """Set the time to the next seam after seam number `count`."""
    clock[abi.TIME] = max(clock[abi.TIME], due_time(seams, count + 1))


def select_row(seams: Seams, r: int) -> None:
    """Select the seams of a row: its own, or the common ones."""
    seams.head[ROW] = r if seams.rows.shape[0] > 2 else 0


def parameters_at(
    seams: Seams, span: Span, prepare: e.Prepare, prepare_law: e.Prepare, t: float, passed: int, p: Array
) -> int:
    """Set `p` to the parameters at an output, from those after `passed` seams; at a seam, to those before it.

    Returns
    -------
    int
        Number of seams before the output.
    """
    changed = False
    while t > due_time(seams, passed) + time_tolerance(seams, span, t):
        changed = write_seam(seams, passed, p) or changed
        passed += 1
    if changed:
        prepare(p)
        prepare_law(p)
    return passed


def is_defined(p: Array) -> bool:
    """Whether all numbers are finite."""
    for i in range(p.shape[0]):
        if not math.isfinite(p[i]):
            return False
    return True


def time_tolerance(seams: Seams, span: Span, t: float) -> float:
    """Return the difference up to which times near a time count as the same [s]."""
    if seams.head[VARYING] != 0:
        return abi.RESOLVED_TIME * abs(t)
    return abi.SAME_TIME * float(span.step)


@jit(entry=True)
def prepare_by_caller(p: Array) -> int:
    """Replace a ``prepare`` that the caller of the loop calls."""
    return 1


def between_seams(model: System, scheme: Record, span: Span, state: State, outputs: Outputs) -> int:
    """Enter a loop for each part of a run, as for a whole run.

    Parameters
    ----------
    model : tuple
        First argument of the loop, `Seams`, the loop, and ``prepare`` of model and law.
    scheme, span, state, outputs
        As for the loop.
    """
    system, seams, loop, prepare, prepare_law = model
    seams, state = bare(seams), bare(state)
    clock, control = state.clock, state.control
    while True:
        begin, now = due_time(seams, control[abi.PASSED]), clock[abi.TIME]
        if begin - now > time_tolerance(seams, span, now):
            origin, to, step = clock[abi.ORIGIN], begin, span.step
            if has_gap(seams, control[abi.PASSED]):
                to, step = span_of_part(seams, control[abi.PASSED], span, clock, control)
            moved = clock[abi.ORIGIN]
            code = loop(system, scheme, part_of_step(span, min(to, span.until), step), state, outputs)
            if clock[abi.ORIGIN] == moved:
                clock[abi.ORIGIN] = origin
            now = clock[abi.TIME]
            if code != abi.DONE:
                return int(code)
            if begin - now > time_tolerance(seams, span, now):
                if span.until - now > time_tolerance(seams, span, now):
                    continue
                return int(code)
        control[abi.PASSED] += 1
        # a kink changes no number, but the history of multistep schemes ends there as well
        if control[abi.BEGUN] == 1:
            control[abi.BEGUN] = abi.AFRESH
        changed = write_seam(seams, control[abi.PASSED] - 1, state.p)
        skipped = has_gap(seams, control[abi.PASSED] - 1)
        if skipped:
            skip_to_seam(seams, control[abi.PASSED] - 1, clock)
            control[abi.PASSED] += 1
            changed = write_seam(seams, control[abi.PASSED] - 1, state.p) or changed
        if changed:
            if prepare(state.p) != 0:
                return abi.CHANGED
            prepare_law(state.p)
            if not is_defined(state.p):
                return abi.UNPREPARED
        if (changed or skipped) and seams.head[CHOOSES] != 0:
            return abi.CHANGED
        if control[abi.BEGUN] != 0 and span.until - now <= time_tolerance(seams, span, now):
            return abi.DONE


_loops: dict[Any, Any] = {}


def loop_with_seams(loop: RuntimeFunction) -> Any:
    """Return the loop that enters another one for each part of a run, made at the first use.

    Parameters
    ----------
    loop : compiled loop
        From `symgen.run.loops.frame.loop`, or one that looks for events or between steps.
    """
    if loop not in _loops:
        name = f"{loop.__module__.rpartition('.')[2]}_{loop.__name__}"
        signature = signature_of(loop)
        model = types.RecordType((*signature.arguments[:1], SEAMS, types.FunctionType(signature), e.PREPARE, e.PREPARE))
        entry = compiled_loop(__name__, name, between_seams, types.int64(model, *signature.arguments[1:]), once=True)
        _loops[loop] = globals()[name] = entry  # it is known by its name, as all loops are
    return _loops[loop]


# -- from Python -------------------------------------------------------------------------------------------------------


def arguments_with_table(
    compiled: CompiledModel,
    system: tuple[Any, ...],
    loop: RuntimeFunction,
    adaptive: bool,
    rows: Sequence[Sequence[Seam]],
    alone: bool = True,
) -> tuple[Any, ...]:
    """Return the first arguments of the loop that goes from seam to seam.

    Parameters
    ----------
    compiled, adaptive, rows
        As for `seams_of_loop`.
    system, loop : tuple, compiled loop
        First argument of the enclosed loop, and this loop.
    alone : bool
        Whether it is a single run: modes are chosen after the loop, and parameters prepared there.
    """
    # in looped code nothing is prepared in the loop
    left = compiled.shape == "looped" or (alone and compiled.info.bounded)
    return (
        system,
        seams_of_loop(compiled, adaptive, rows),
        loop,
        *((prepare_by_caller, prepare_by_caller) if left else preparing_functions(compiled)),
    )


def preparing_functions(compiled: CompiledModel) -> tuple[Any, Any]:
    """Return the emitted functions that follow a change of parameters: ``prepare`` of the model and of the law."""
    return compiled.model.prepare, compiled.law_module.prepare


def seams_of_loop(compiled: CompiledModel, adaptive: bool, rows: Sequence[Sequence[Seam]]) -> Any:
    """Return the seams of rows as `Seams`.

    Parameters
    ----------
    compiled : CompiledModel
        Model and method.
    adaptive : bool
        Whether steps vary.
    rows : sequence of sequence of Seam
        The seams of each row.
    """
    places = {q.name: i for i, q in enumerate(compiled.info.parameters)}
    seams = [seam for row in rows for seam in row]
    changes = [(places[name], value) for seam in seams for name, value in seam.values.items()]
    return Seams(
        head=np.array([0, int(adaptive), int(bool(compiled.info.bounded))]),
        rows=np.cumsum([0, *map(len, rows)]),
        times=np.array([seam.t for seam in seams], dtype=np.float64),
        skips=np.array([seam.skips + seam.strikes for seam in seams], dtype=np.int64),
        changes=np.cumsum([0, *(len(seam.values) for seam in seams)]),
        places=np.array([place for place, _ in changes], dtype=np.int64),
        values=np.array([value for _, value in changes], dtype=np.float64),
    )
