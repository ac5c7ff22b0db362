"""The start of runs: a consistent state and scratch, of one run or of many in a loop.

Single runs of large mechanisms and sweeps call the compiled functions, single runs of small mechanisms the same source
as plain Python (`symgen.compile.loopcode.exact`). A start that cannot be closed is a code, not an error.
"""

from __future__ import annotations

import math

from symgen.compile.loopcode.bare import bare, part
from symgen.compile.loopcode.exact import copy_numbers, exact
from symgen.compile.native.annotations import Array, Integers
from symgen.run.layout import abi
from symgen.run.layout import ensemble_abi as e
from symgen.run.layout.scales import extent_of, free_scale, larger_number, measure_lengths, row_weight, speed_of
from symgen.run.layout.start_records import (
    Closing,
    Instant,
    Layout,
    StartConditions,
    StartModel,
    Work,
)
from symgen.run.starts import decisions
from symgen.run.starts.closing import (
    close_positions,
    complete_velocities,
    find_undetermined,
    is_light,
    mask_redundant,
    place_constraints,
)
from symgen.run.starts.joint_starts import Further, Joints, fill_further

#: A model, its ``observe``, and the joint coordinates that starts hold.
Holding = tuple[StartModel, abi.Observe, Joints]


#: Layout, and the numbers of a new scratch array that are not 0: their places, and they themselves.
Described = tuple[Layout, Integers, Array]


@exact(entry=True)
def begin_row(model: Described, state: Array, now: Instant, iw: Integers, conditions: StartConditions) -> int:
    """Set a run to a described state, with new scratch and counters, for `close_row`; velocities become conditions."""
    layout, places, numbers = model
    y, w, first = now.y, now.w, layout.nq
    for i in range(w.shape[0]):
        w[i] = 0.0
    for i in range(places.shape[0]):
        w[places[i]] = numbers[i]
    for i in range(iw.shape[0]):
        iw[i] = 0
    copy_numbers(state, y, layout.ny)
    for j in range(layout.nv):
        conditions.velocities[j] = y[first + j]
        y[first + j] = 0.0
    return 0


@exact(entry=True)
def close_row(model: Holding, now: Instant, conditions: StartConditions, work: Work) -> int:
    """Make the start of a run consistent.

    Positions are closed by shortest changes from those described, fixed ones staying the same; then the held
    coordinates go to their values in small steps, each closed by moving the others, so that the mechanism keeps the
    branch in which it was described. Where this fails, values with which all joints are closed already are taken at
    once: all coordinates of a position that no path reaches, possibly one of another branch.

    Parameters
    ----------
    model : tuple
        First a `Layout` and a `MassTable`, then ``geometry``, ``measure``, ``move``, ``spread``, `solve`, ``formulas``,
        `project`, `turns` and ``rhs``: emitted ones (`symgen.run.layout.abi`), two of
        `symgen.run.starts.start_solvers` and one of `symgen.run.starts.masses`. After
        these ``observe``, and `symgen.run.starts.joint_starts.Joints`.
    now, conditions, work : Instant, StartConditions, Work
        See `symgen.run.layout.start_records`. The state holds the described coordinates and velocities of 0; parameters
        and masses are prepared, the pivots are 1.

    Returns
    -------
    int
        `ASSEMBLED`, or the code of a failure; see `symgen.run.layout.ensemble_abi`.
    """
    (layout, masses, geometry, measure, move, spread, solve, formulas, project, turns, rhs), observe, joints = model
    closing = Closing(geometry, measure, move, spread, solve, masses, formulas, project)
    y, w, summary = now.y, now.w, conditions.summary
    values = joints.values.m - layout.m
    nothing = Further(observe, part(joints.held, 0, 0), joints.goals, joints.out, layout.residual, layout.nu)
    code = check_numbers(layout, now, summary)
    if code == e.ASSEMBLED:
        measure_lengths(geometry, layout, now, work)
    if code == e.ASSEMBLED and layout.windings > 0:
        turns(geometry, measure, layout, now, work)
        for i in range(layout.windings):
            if math.isfinite(layout.branches[i]):
                w[abi.WINDING + i] = layout.branches[i]
    if code == e.ASSEMBLED:
        code = _reach_positions(closing, layout, now, conditions, work, joints, nothing)
    h = layout.held.shape[0] // 2
    if code == e.OPEN and h > 0 and values == 0 and _close_at_once(closing, layout, now, conditions, work, nothing):
        if layout.windings > 0:
            turns(geometry, measure, layout, now, work)
        code = e.ASSEMBLED
    if code == e.ASSEMBLED:
        if joints.rates.m == layout.m:
            code = complete_velocities(closing, layout, now, work, conditions.velocities)
        else:
            code = _complete_with_rates(closing, layout, now, conditions, work, joints, observe)
    if code == e.PROJECTED:
        summary[e.START_VELOCITIES] = 1.0
        code = e.ASSEMBLED
    if code == e.ASSEMBLED:
        undetermined = find_undetermined(closing, layout, now, work)
        if undetermined >= 0:
            summary[e.START_WHERE] = undetermined
            code = e.UNDETERMINED
    if code == e.ASSEMBLED:
        summary[e.REDUNDANT_ROWS] = mask_redundant(closing, layout, now, work, nothing)
        w[abi.LENGTH] = larger_number(w[abi.LENGTH], extent_of(layout, y))
        w[abi.SPEED] = speed_of(layout, w, part(y, layout.nq, layout.nv))
        if layout.ask_light != 0 and is_light(rhs, closing, layout, now, work):
            summary[e.LIGHT] = 1.0
    summary[e.START] = code
    return int(code)


@exact()
def check_numbers(layout: Layout, now: Instant, summary: Array) -> int:
    """Return whether numbers are finite and masses positive, except for those described as 0."""
    y, p, w, massless, finite = now.y, now.p, now.w, layout.massless, True
    for i in range(layout.nq):
        finite = finite and math.isfinite(y[i])
    for j in range(layout.nv):
        if finite and massless[j] == 0 and not w[layout.mass + j] > 0.0:
            summary[e.START_WHERE], summary[e.START_SIZE] = j, w[layout.mass + j]
            return int(e.NO_MASS)
    for i in range(p.shape[0]):
        finite = finite and math.isfinite(p[i])
    return int(e.ASSEMBLED if finite else e.UNDEFINED)


@exact()
def _reach_positions(
    closing: Closing,
    layout: Layout,
    now: Instant,
    conditions: StartConditions,
    work: Work,
    joints: Joints,
    nothing: Further,
) -> int:
    """Close the described positions, then positions on the path of held coordinates to their values."""
    y, first, scale, held, targets = now.y, work.first, work.scale, layout.held, conditions.targets
    h, values, strides, nw = layout.held.shape[0] // 2, joints.values.m - layout.m, 0, now.w.shape[0]
    of = part(joints.held, 0, values)
    further = Further(nothing.observe, of, joints.goals, joints.out, layout.residual, layout.nu)
    state = Instant(y, now.p, joints.w)
    for j in range(layout.nv):
        scale[j] = 0.0 if layout.fixed[j] != 0 else free_scale(layout, now.w, j)
    for i in range(layout.nq):
        first[i] = y[i]
    for k in range(decisions.MOST_STRIDES + 1):
        for c in range(h if k > 0 else 0):
            i = held[2 * c]
            y[i] = targets[c] if k == strides else first[i] + (k / strides) * (targets[c] - first[i])
        for c in range(values if k > 0 else 0):
            origin, goal = joints.origins[c], targets[h + c]
            joints.goals[c] = goal if k == strides else origin + (k / strides) * (goal - origin)
        if k > 0 and values > 0:
            closed = close_positions(closing, joints.values, state, work, further)
            copy_numbers(joints.w, now.w, nw)
        else:
            closed = close_positions(closing, layout, now, work, nothing)
        if not closed:
            return int(e.OPEN)
        if k == 0:
            moved = away = 0.0
            length = larger_number(now.w[abi.LENGTH], extent_of(layout, y))
            for i in range(layout.nq):
                change = abs(y[i] - first[i])
                if change > moved and change > decisions.MOVED * (length if layout.lengths[i] != 0.0 else 1.0):
                    moved = change
            conditions.summary[e.START_MOVED] = moved
            for c in range(h):
                i = held[2 * c]
                first[i] = y[i]
                scale[held[2 * c + 1]] = 0.0
                distance = abs(targets[c] - y[i]) / (length if layout.lengths[i] != 0.0 else 1.0)
                away = distance if distance > away else away
            if values > 0:
                copy_numbers(now.w, joints.w, nw)
                for c in range(values):
                    joints.goals[c] = 0.0
                fill_further(joints.values, state, work, further)
            for c in range(values):
                i = layout.m + c
                joints.origins[c] = joints.w[joints.values.residual + i]
                distance = abs(targets[h + c] - joints.origins[c])
                distance /= length if joints.values.rows[2 * i + 1] == 1 else 1.0
                away = distance if distance > away else away
            if h + values > 0:
                strides = decisions.MOST_STRIDES
                if away < decisions.STRIDE * strides:
                    strides = math.ceil(away / decisions.STRIDE) if away > decisions.STRIDE else 1
        if k == strides:
            break
    return int(e.ASSEMBLED)


@exact()
def _complete_with_rates(
    closing: Closing,
    layout: Layout,
    now: Instant,
    goal: StartConditions,
    work: Work,
    joints: Joints,
    observe: abi.Observe,
) -> int:
    """Complete the velocities of a state in which rates of joint coordinates are held."""
    values, rates = joints.values.m - layout.m, joints.rates.m - layout.m
    of, goals, first = part(joints.held, values, rates), part(joints.goals, values, rates), layout.held.shape[0] // 2
    for c in range(rates):
        goals[c] = goal.targets[first + values + c]
    state = Instant(now.y, now.p, joints.w)
    copy_numbers(now.w, joints.w, now.w.shape[0])
    further = Further(observe, of, goals, joints.out, layout.residual, layout.nu)
    place_constraints(closing, joints.rates, state, work, further)
    return int(complete_velocities(closing, joints.rates, state, work, goal.velocities))


@exact()
def _close_at_once(
    closing: Closing, layout: Layout, now: Instant, conditions: StartConditions, work: Work, nothing: Further
) -> bool:
    """Set held coordinates to their values at once; return whether all is closed then, with the others as described.

    If not, the state is not changed.
    """
    y, w, first, before = now.y, now.w, work.first, work.y
    for i in range(layout.nq):
        before[i], y[i] = y[i], first[i]
    for c in range(layout.held.shape[0] // 2):
        y[layout.held[2 * c]] = conditions.targets[c]
        work.scale[layout.held[2 * c + 1]] = 0.0
    closing.geometry(layout.t, y, now.p, w)
    square, length = 0.0, larger_number(w[abi.LENGTH], extent_of(layout, y))
    for i in range(layout.m):
        square += (row_weight(layout, w, i) * w[layout.residual + i]) ** 2
    if math.sqrt(square) < decisions.CLOSED * length and close_positions(closing, layout, now, work, nothing):
        return True
    for i in range(layout.nq):
        y[i] = before[i]
    closing.geometry(layout.t, y, now.p, w)
    return False


@exact(entry=True)
def close_rows(
    model: Holding,
    all_of_now: Instant,
    all_conditions: StartConditions,
    work: Work,
    selected: Integers,
    control: Integers,
) -> int:
    """Make the starts of many rows consistent.

    Parameters
    ----------
    model, work
        As for `close_row`.
    all_of_now, all_conditions : Instant, StartConditions
        Of all rows, one after the other.
    selected : Array of int
        Rows to work on.
    control : Array of int
        Memory shared with the watching thread.

    Returns
    -------
    int
        Number of processed rows: all, unless the run was stopped.
    """
    (layout, masses, geometry, measure, move, spread, solve, formulas, project, turns, rhs), observe, joints = model
    layout, joints, work = bare(layout), bare(joints), bare(work)
    (ys, ps, ws), rest = bare(all_of_now), bare(all_conditions)
    model = (layout, masses, geometry, measure, move, spread, solve, formulas, project, turns, rhs), observe, joints
    n, ny, h = layout.nv, layout.ny, layout.held.shape[0] // 2 + joints.held.shape[0]
    runs = ys.shape[0] // ny
    n_p, nw = ps.shape[0] // runs, ws.shape[0] // runs
    for s in range(selected.shape[0]):
        if control[abi.STOP] != 0:
            return int(s)
        r = selected[s]
        now = Instant(part(ys, r * ny, ny), part(ps, r * n_p, n_p), part(ws, r * nw, nw))
        summary = part(rest.summary, r * e.N_SUMMARY, e.N_SUMMARY)
        conditions = StartConditions(part(rest.velocities, r * n, n), part(rest.targets, r * h, h), summary)
        close_row(model, now, conditions, work)
    return int(selected.shape[0])


#: The same for a single start: machine code that is made in less time.
close_alone = exact(entry=True, once=True)(getattr(close_rows, "py_func", close_rows))


@exact(entry=True)
def prepare_rows(
    model: e.Prepare,
    law: e.Prepare,
    masses: abi.Move,
    scratch: Array,
    ps: Array,
    ws: Array,
    runs: int,
    selected: Integers,
) -> int:
    """Fill parameters and scratch of the selected ones of `runs` rows.

    Parameters
    ----------
    model, law, masses : emitted functions
        ``prepare`` of both, and ``masses``.
    scratch : Array, shape (nw,)
        Initial scratch of every row.
    ps, ws : Array
        Parameters and scratch of all rows, one after the other.
    runs, selected : int, Array of int
        Number of rows, and the rows to fill.
    """
    scratch, nw, n_p = bare(scratch), scratch.shape[0], ps.shape[0] // runs
    for s in range(selected.shape[0]):
        p, w = part(ps, selected[s] * n_p, n_p), part(ws, selected[s] * nw, nw)
        for i in range(nw):
            w[i] = scratch[i]
        model(p)
        law(p)
        masses(p, w)
    return 0


@exact(entry=True)
def observe_nothing(t: float, y: Array, p: Array, w: Array, ydot: Array, out: Array) -> int:
    """Replace the emitted ``observe`` where no joint coordinate is held, so that it is not compiled."""
    return 0


@exact(entry=True)
def follow_nothing(t: float, y: Array, p: Array, w: Array) -> int:
    """Replace the emitted ``measure`` where no angle counts turns, so that it is not compiled."""
    return 0


@exact(entry=True)
def set_no_rates(t: float, y: Array, p: Array, w: Array, iw: Integers, ydot: Array) -> int:
    """Replace the emitted ``rhs`` where light bodies are not looked for, so that it is not compiled."""
    return 0
