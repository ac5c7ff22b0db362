"""Many runs of one compiled model with a constant step, several at once in the lanes of vector instructions.

Lanes take the same steps side by side, in the frame of single runs with other operations on a state. A run that comes
near a singular position, meets a suspicious pivot, needs a new choice of independent rows, exceeds a limit or fails is
left to the loop over single runs, from its start. So every run that ends here has succeeded, and every other one has
exactly the result of a single run.

Element i of every array of the lanes is at ``LANES*i + lane``; those of emitted code are parts of one array z
(`symgen.base.ir.program.lane_bases`), which replaces ``p``.
"""

from __future__ import annotations

import math
from collections.abc import Callable

from symgen.base.ir.numerics import SKIP
from symgen.base.ir.program import LANE_COUNTERS, LANES, lane_bases
from symgen.compile.loopcode.bare import bare, part
from symgen.compile.loopcode.loop_instances import Instances, Meanings, compiled_loop
from symgen.compile.loopcode.vectors import combine, copied
from symgen.compile.native.annotations import Array, Record, function_type, signature_from
from symgen.run.layout import abi
from symgen.run.layout import ensemble_abi as e
from symgen.run.layout.records import (
    Kept,
    Outputs,
    RowChunk,
    Run,
    Sizes,
    Span,
    State,
)
from symgen.run.layout.redundancy import FALLEN, no_rows_fell
from symgen.run.layout.scales import speed_within_tolerance
from symgen.run.layout.scheme_records import TableauRecord
from symgen.run.loops import watch as watching
from symgen.run.loops.frame import integrate
from symgen.run.loops.schemes import explicit
from symgen.run.rows.row_results import end_run
from symgen.run.rows.rows import begin_run, select_elements

#: rhs(t, z) and accept(t, z).
LaneFunction = Callable[[float, Array], int]
LANE_FUNCTION = function_type(LaneFunction)


class LaneSystem(Record):
    """What lanes have in place of a `ModelSystem`: functions of all lanes."""

    sizes: Sizes
    rhs: LaneFunction
    accept: LaneFunction


#: Sizes; ``rhs`` and ``accept`` of all lanes; then functions of a single run: the rates with their confirmation,
#: ``accept``, ``observe`` and ``balance``.
LaneModel = tuple[Sizes, LaneFunction, LaneFunction, abi.Rhs, abi.Rhs, abi.Accept, abi.Observe, abi.Balance]

_L, _SPARE, _NONE_GOES = LANES, len(LANE_COUNTERS), abi.PAUSED
_PHI, _DRIFT, _KINETIC, _POTENTIAL = abi.PHI * _L, abi.DRIFT * _L, abi.KINETIC * _L, abi.POTENTIAL * _L
_SHORTEST, _MEAN_MASS = abi.SHORTEST_ROW * _L, abi.MEAN_MASS * _L
_PIVOT, _RANK, _LENGTH, _SPEED = abi.PIVOT * _L, abi.RANK * _L, abi.LENGTH * _L, abi.SPEED * _L
_STEP_STATUS, _WINDING = abi.STEP_STATUS * _L, abi.WINDING * _L
_PHI_MEASURE, _DRIFT_MEASURE = abi.PHI_MEASURE * _L, abi.DRIFT_MEASURE * _L
_MAX_PHI, _MAX_DRIFT, _MAX_ENERGY = abi.MAX_PHI * _L, abi.MAX_DRIFT * _L, abi.MAX_ENERGY * _L
_START, _SCALE, _POTENTIAL_START = abi.ENERGY_START * _L, abi.ENERGY_SCALE * _L, abi.POTENTIAL_START * _L
_LIMIT_PHI, _LIMIT_DRIFT, _LIMIT_ENERGY = abi.LIMIT_PHI * _L, abi.LIMIT_DRIFT * _L, abi.LIMIT_ENERGY * _L
_SMALLEST, _LAST_SINE, _FALL = abi.SMALLEST_PIVOT * _L, abi.LAST_SINE * _L, abi.FALL * _L
_LAST_TIME, _WARN, _CHOSEN = abi.LAST_TIME * _L, abi.WARN_PIVOT * _L, abi.CHOSEN * _L
_LARGEST_SINE, _PASSAGE = abi.LARGEST_SINE * _L, watching.PASSAGE
_SUSPECTS, _FAILURES = LANE_COUNTERS.index("suspects") * _L, LANE_COUNTERS.index("failures") * _L
_ITERATIONS = LANE_COUNTERS.index("iterations") * _L
#: After the gauges of all lanes: the largest coordinate, the rank at the start, 1 for lanes left to single runs, and
#: the part of the best pivot below which lanes with rows left out are left to single runs, 0 for others. Then the
#: factors from velocities to speeds.
_LARGEST, _FIRST_RANK, _ODD = abi.N_GAUGES * _L, (abi.N_GAUGES + 1) * _L, (abi.N_GAUGES + 2) * _L
_LEAST_PART, _N_LANE_GAUGES = (abi.N_GAUGES + 3) * _L, abi.N_GAUGES + 4
#: Angles beyond this lose digits in the reduction of emitted sines.
_LARGEST_ANGLE = 1e5
_NEGLIGIBLE = watching.NEGLIGIBLE
#: Rows that have lost more than half of their gradient are watched in single runs.
_SHORT = 0.25


# -- operations of the frame, for all lanes ----------------------------------------------------------------------------


def open_lanes(sizes: Sizes, state: State) -> Run:
    """Return the states of runs; the trial state is a part of z, for emitted code."""
    s = bare(state)
    trial = part(s.p, 0, sizes.width)
    kept = s.y, trial, s.p, s.w, s.iw, s.clock, s.gauges, s.control, s.passages, s.memory
    return Run(*kept, s.share, s.metric, s.scales, s.room)


def settle_lanes(sizes: Sizes, span: Span, run: Run) -> None:
    """Set the factors of speeds; raise their scales to speeds of motions that cross the mechanism during the run."""
    for i in range(sizes.nv):
        for lane in range(_L):
            gauge = run.w[(sizes.gauge + i) * _L + lane]
            run.gauges[(_N_LANE_GAUGES + i) * _L + lane] = 1.0 / math.sqrt(gauge)
    for lane in range(_L):
        speed = run.w[_LENGTH + lane] / span.duration
        speed = speed if speed > run.w[_SPEED + lane] else run.w[_SPEED + lane]
        run.w[_SPEED + lane] = speed
        open_speed = speed_within_tolerance(span, speed)
        run.gauges[_SCALE + lane] = run.w[_MEAN_MASS + lane] * open_speed * open_speed


def evaluate_lanes(system: LaneSystem, run: Run, t: float, y: Array, rate: Array) -> None:
    """Set `rate` to the rates of the trial states."""
    width = system.sizes.width
    system.rhs(t, run.p)
    copied(width, part(run.p, width, width), rate)


def correct_lanes(system: LaneSystem, run: Run, t: float, y: Array, between: bool) -> int:
    """Correct and measure the trial states; failures are counted."""
    system.accept(t, run.p)
    return 0


def note_lane_step(run: Run, h: float) -> None:
    """Store the present step for emitted functions."""
    for lane in range(_L):
        run.w[_STEP_STATUS + lane] = h


def largest_turn_of_lanes(sizes: Sizes, span: Span, run: Run) -> float:
    """Return 0: lanes in which an angle changes by too much in a step are left to single runs."""
    for i in range(sizes.nq):
        for lane in range(_L):
            turn = abs(run.trial[i * _L + lane] - run.y[i * _L + lane]) * (1.0 - run.metric[i])
            run.gauges[_ODD + lane] = run.gauges[_ODD + lane] if turn <= span.turn else 1.0
    return 0.0


def remember_lane_ranks(sizes: Sizes, run: Run) -> None:
    """Do nothing: each lane has the rank of its own start."""


def begin_lanes(run: Run) -> None:
    """Set the initial energies of the balances: the energies of the first accepted states."""
    for lane in range(_L):
        run.gauges[_START + lane] = run.w[_KINETIC + lane] + run.w[_POTENTIAL + lane]
        run.gauges[_POTENTIAL_START + lane] = run.w[_POTENTIAL + lane]


def keep_lane_maxima(sizes: Sizes, run: Run, y: Array) -> float:
    """Update the largest violations and energy errors."""
    w, gauges, work = run.w, run.gauges, (sizes.nq + sizes.nv) * _L
    for lane in range(_L):
        error = abs(w[_KINETIC + lane] + w[_POTENTIAL + lane] - gauges[_START + lane] - y[work + lane])
        phi, drift = w[_PHI + lane], w[_DRIFT + lane]
        gauges[_MAX_PHI + lane] = phi if phi > gauges[_MAX_PHI + lane] else gauges[_MAX_PHI + lane]
        gauges[_MAX_DRIFT + lane] = drift if drift > gauges[_MAX_DRIFT + lane] else gauges[_MAX_DRIFT + lane]
        gauges[_MAX_ENERGY + lane] = error if error > gauges[_MAX_ENERGY + lane] else gauges[_MAX_ENERGY + lane]
    return 0.0


def watch_lanes(sizes: Sizes, run: Run, y: Array, t: float) -> int:
    """Judge accepted states as `symgen.run.loops.watch.watch` does; mark lanes that cannot continue."""
    w, counters, gauges, after = run.w, run.iw, run.gauges, sizes.nq + sizes.nv
    run.clock[abi.TIME] = t
    keep_lane_maxima(sizes, run, y)
    for lane in range(_L):
        gauges[_LARGEST + lane] = 0.0
    for i in range(sizes.nq):
        for lane in range(_L):
            angle = abs(y[i * _L + lane]) * (1.0 - run.metric[i])
            gauges[_ODD + lane] = gauges[_ODD + lane] if angle <= _LARGEST_ANGLE else 1.0
            size = abs(y[i * _L + lane] - run.share[sizes.width + i]) * run.metric[i]
            gauges[_LARGEST + lane] = size if size > gauges[_LARGEST + lane] else gauges[_LARGEST + lane]
    for i in range(sizes.nq, after):
        for lane in range(_L):
            size = abs(y[i * _L + lane]) * gauges[(_N_LANE_GAUGES + i - sizes.nq) * _L + lane]
            w[_SPEED + lane] = size if size > w[_SPEED + lane] else w[_SPEED + lane]
    work, going = after * _L, 0.0
    for lane in range(_L):
        largest = gauges[_LARGEST + lane]
        length = largest if largest > w[_LENGTH + lane] else w[_LENGTH + lane]
        kinetic, done = w[_KINETIC + lane], abs(y[work + lane])
        error = kinetic + w[_POTENTIAL + lane] - gauges[_START + lane] - y[work + lane]
        change = abs(w[_POTENTIAL + lane] - gauges[_POTENTIAL_START + lane])
        scale = kinetic if kinetic > gauges[_SCALE + lane] else gauges[_SCALE + lane]
        scale = change if change > scale else scale
        scale = done if done > scale else scale
        gauges[_SCALE + lane] = scale
        pivot, smallest, warn = w[_PIVOT + lane], gauges[_SMALLEST + lane], gauges[_WARN + lane]
        gauges[_SMALLEST + lane] = pivot if pivot < smallest else smallest
        sine = math.sqrt(pivot if pivot > 0.0 else 0.0)
        elapsed, fall, before = t - gauges[_LAST_TIME + lane], gauges[_FALL + lane], gauges[_LAST_SINE + lane]
        met = (fall > 0.0) & (before - fall * elapsed < math.sqrt(warn))
        gauges[_FALL + lane] = (before - sine) / elapsed if elapsed > 0.0 else 0.0
        gauges[_LAST_TIME + lane] = t
        gauges[_LAST_SINE + lane] = sine
        most = sine if sine > gauges[_LARGEST_SINE + lane] else gauges[_LARGEST_SINE + lane]
        gauges[_LARGEST_SINE + lane] = most
        phi, drift = w[_PHI_MEASURE + lane], w[_DRIFT_MEASURE + lane]
        best = pivot if pivot > gauges[_CHOSEN + lane] else gauges[_CHOSEN + lane]
        gauges[_CHOSEN + lane] = best
        bad = met | (pivot < warn) | (sine <= _PASSAGE * most) | (pivot < gauges[_LEAST_PART + lane] * best)
        bad |= w[_RANK + lane] != gauges[_FIRST_RANK + lane]
        bad |= not phi <= gauges[_LIMIT_PHI + lane] * length
        bad |= not drift <= gauges[_LIMIT_DRIFT + lane] * w[_SPEED + lane]
        least = _NEGLIGIBLE * (kinetic + abs(w[_POTENTIAL + lane]))
        bad |= not abs(error) <= gauges[_LIMIT_ENERGY + lane] * scale + least
        bad |= not w[_SHORTEST + lane] >= _SHORT
        bad |= (counters[_SUSPECTS + lane] > 0.0) | (counters[_FAILURES + lane] > 0.0)
        odd = 1.0 if bad else gauges[_ODD + lane]
        gauges[_ODD + lane] = odd
        going += 1.0 - odd
    return abi.DONE if going > 0.0 else _NONE_GOES


def store_lanes(sizes: Sizes, w: Array, outputs: Outputs, k: int, y: Array) -> None:
    """Write output `k` of all lanes: states, measures of ``accept``, and angles with counted turns."""
    n, width = sizes.ny * _L, outputs.status.shape[0] // outputs.times.shape[0]
    for i in range(n):
        outputs.states[k * n + i] = y[i]
    for i in range(abi.N_STATUS * _L):
        outputs.status[k * width + i] = w[i]
    for i in range(width - abi.N_STATUS * _L):
        outputs.status[k * width + abi.N_STATUS * _L + i] = w[_WINDING + i]


_MEANINGS = Meanings(
    "sweeps in vector lanes",
    open_run=open_lanes,
    evaluate=evaluate_lanes,
    correct=correct_lanes,
    note_step=note_lane_step,
    store_output=store_lanes,
    largest_turn=largest_turn_of_lanes,
    settle_scales=settle_lanes,
    remember_rank=remember_lane_ranks,
    begin_watch=begin_lanes,
    keep_maxima=keep_lane_maxima,
    watch=watch_lanes,
    # emitted code for lanes writes whole vectors, which are read as such
    rows_fell=no_rows_fell,
    attempt=explicit.attempt_constant,
    follow=combine,
)


# -- groups of rows ----------------------------------------------------------------------------------------------------


def load_rows(chunk: RowChunk, sizes: Sizes, state: State, g: int, z: Array, gauges: Array) -> None:
    """Load a group of rows into the lanes; the last group repeats its last row."""
    n, n_p, nw, total = sizes.ny, state.p.shape[0], state.w.shape[0], chunk.selected.shape[0]
    p_at = 2 * sizes.width
    w_at = p_at + n_p * _L
    for lane in range(_L):
        r = chunk.selected[min(g + lane, total - 1)]
        for i in range(n):
            z[i * _L + lane] = chunk.ys[r * n + i]
        for i in range(n_p):
            z[p_at + i * _L + lane] = chunk.ps[r * n_p + i]
        for i in range(nw):
            z[w_at + i * _L + lane] = chunk.ws[r * nw + i]
        for i in range(_SPARE):
            z[w_at + (nw + i) * _L + lane] = 0.0
        begin_run(state, chunk.limits)
        for i in range(abi.N_GAUGES):
            gauges[i * _L + lane] = state.gauges[i]
        rank = part_of_best = 0.0
        for i in range(sizes.m):
            rank += 1.0 if chunk.ws[r * nw + sizes.pivots + i] >= SKIP else 0.0
            part_of_best = FALLEN if chunk.ws[r * nw + sizes.mask + i] > 0.0 else part_of_best
        gauges[_FIRST_RANK + lane], gauges[_ODD + lane], gauges[_LEAST_PART + lane] = rank, 0.0, part_of_best


def unload_row(lane: int, sizes: Sizes, lanes: State, state: State, outputs: Outputs, kept: Kept) -> None:
    """Copy the run of a lane to the arrays of a single run."""
    n, nw, columns = sizes.ny, state.w.shape[0], kept.outputs.status.shape[1]
    for i in range(nw):
        state.w[i] = lanes.w[i * _L + lane]
    for k in range(outputs.times.shape[0]):
        for i in range(n):
            kept.outputs.states[k, i] = outputs.states[(k * n + i) * _L + lane]
        for i in range(columns):
            kept.outputs.status[k, i] = outputs.status[(k * columns + i) * _L + lane]
    for i in range(abi.N_GAUGES):
        state.gauges[i] = lanes.gauges[i * _L + lane]
    for i in range(state.iw.shape[0]):
        state.iw[i] = 0
    state.iw[abi.ITERATIONS] = int(lanes.iw[_ITERATIONS + lane])


def run_lanes(model: LaneModel, scheme: TableauRecord, span: Span, chunk: RowChunk, state: State, kept: Kept) -> int:
    """Run the selected rows, `LANES` at a time; rows that are left to single runs get the code `LEFT`.

    Parameters
    ----------
    model : tuple
        As for `symgen.run.rows.rows.run_rows`; with ``rhs`` and ``accept`` for lanes instead of the
        first three functions. The width is that of all lanes.
    scheme, span, chunk, kept
        As for `symgen.run.rows.rows.run_rows`.
    state : State
        As for single runs; its working memory, `room_of_lanes` numbers, holds the lanes.

    Returns
    -------
    int
        Number of selected rows done: all, unless the run was stopped.
    """
    chunk, state, kept = bare(chunk), bare(state), bare(kept)
    sizes, rhs, lanes_accept, rates, confirm, accept, observe, balance = model
    width, n, n_p, nw, columns = sizes.width, sizes.ny, state.p.shape[0], state.w.shape[0], kept.outputs.status.shape[1]
    times, total, room = kept.outputs.times, chunk.selected.shape[0], state.room
    numbers = 2 * width + (n_p + nw + _SPARE) * _L
    z, at, n_gauges = part(room, 0, numbers), numbers, (_N_LANE_GAUGES + sizes.nv) * _L
    y, gauges = part(room, at, width), part(room, at + width, n_gauges)
    at += width + n_gauges
    states = part(room, at, times.shape[0] * n * _L)
    at += times.shape[0] * n * _L
    status = part(room, at, times.shape[0] * columns * _L)
    at += times.shape[0] * columns * _L
    w, counters = part(z, 2 * width + n_p * _L, nw * _L), part(z, 2 * width + (n_p + nw) * _L, _SPARE * _L)
    outputs = Outputs(times, states, status)
    clock, control, rest = state.clock, state.control, part(room, at, room.shape[0] - at)
    more = state.passages, state.memory, state.share, state.metric, state.scales
    lanes = State(y, z, w, counters, clock, gauges, control, *more, rest)  # type: ignore[arg-type]  # all numbers
    for g in range(0, total, _L):
        if control[abi.STOP] != 0:
            return int(g)
        load_rows(chunk, sizes, state, g, z, gauges)
        copied(width, z, y)
        if integrate((sizes, rhs, 0, lanes_accept, 0, 0, 0), scheme, span, lanes, outputs) == abi.STOPPED:
            return int(g)
        steps, evaluations = control[abi.STEPS], control[abi.EVALUATIONS]
        for lane in range(min(_L, total - g)):
            r = chunk.selected[g + lane]
            if gauges[_ODD + lane] != 0.0:
                chunk.summary[r * e.N_SUMMARY + e.CODE] = abi.LEFT
                continue
            unload_row(lane, sizes, lanes, state, outputs, kept)
            select_elements(chunk.ps, r * n_p, n_p, state.p)
            clock[abi.TIME] = span.until
            control[abi.STEPS], control[abi.OUTPUTS], control[abi.EVALUATIONS] = steps, times.shape[0], evaluations
            end_run(abi.DONE, r, 0, span, (sizes, rates, confirm, accept, observe, balance), chunk, state, kept)
    return int(total)


def room_of_lanes(n: int, stages: int, n_p: int, nw: int, windings: int, n_times: int) -> int:
    """Return the length of the working memory of `run_lanes`."""
    bases = lane_bases(n, n_p, nw)
    numbers = bases["numbers"] + (1 + stages) * bases["ydot"] + _N_LANE_GAUGES + n  # of velocities there are fewer
    return LANES * (numbers + n_times * (n + abi.N_STATUS + windings))


lane_runs = compiled_loop(
    *(__name__, "lane_runs", run_lanes, signature_from(run_lanes)),
    integrate=Instances(_MEANINGS).of(integrate),
)
