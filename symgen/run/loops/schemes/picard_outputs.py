"""Outputs inside a step of Picard's iteration, and states at its nodes."""

from __future__ import annotations

from symgen.compile.loopcode.bare import part
from symgen.compile.loopcode.loop_instances import called, viewing
from symgen.compile.loopcode.nodes import PLACES, POINTS, TERMS, integrate_legendre, place, refine, sum_up
from symgen.compile.loopcode.vectors import copied
from symgen.compile.native.annotations import Array
from symgen.compile.native.types import NODES
from symgen.run.layout import abi
from symgen.run.layout.records import ModelSystem, Outputs, Run, Span
from symgen.run.layout.scheme_records import Nodes, TableauRecord
from symgen.run.loops.frame_parts import correct, evaluate, store_output
from symgen.run.loops.schemes.explicit import complete_stages, read_stages
from symgen.run.loops.schemes.picard_memory import (
    ACROSS,
    ADRIFT,
    BUFFER,
    BUFFERS,
    COARSE,
    COEFFICIENTS,
    ENDS,
    MORE,
    ONCE,
    PARTS_OF_STEP,
    RATE,
    REFINED,
    STATE,
    STATES,
    TIMES,
    TWICE,
    WEIGHED,
    WIDE,
)
from symgen.run.loops.watch import keep_maxima


@called
def evaluate_one_by_one(system: ModelSystem, run: Run, times: Array, states: Array, rates: Array) -> None:
    """Evaluate the right-hand side at one node after another."""
    n, width = system.sizes.ny, system.sizes.width
    y, rate = part(run.room, WIDE + STATE * width, width), part(run.room, WIDE + RATE * width, width)
    for i in range(n, width):
        y[i] = 0.0
    for k in range(NODES):
        for i in range(n):
            y[i] = states[i * NODES + k]
        evaluate(system, run, times[k], y, rate)
        for i in range(n):
            rates[i * NODES + k] = rate[i]


@viewing
def run_of_one_step(system: ModelSystem, tableau: TableauRecord, run: Run) -> Run:
    """Return the run with the stages of a step across a singular position for its memory."""
    width = system.sizes.width
    stages = part(run.room, WIDE + STATES * width, tableau.nodes.shape[0] * width)
    room = part(run.room, WIDE + WEIGHED * width, STATES * width)
    fields = run.y, run.trial, run.p, run.w, run.iw, run.clock, run.gauges, run.control, run.passages, stages
    return Run(*fields, run.share, run.metric, run.scales, room)


@called
def interpolate_wide_step(
    system: ModelSystem, scheme: Nodes, span: Span, run: Run, outputs: Outputs, t: float, following: float, h: float
) -> None:
    """Write the outputs inside a step, each corrected; the status at the end of the step is restored.

    Where the polynomial of the nodes is less accurate than the tolerance inside the step, the right-hand side is
    evaluated once more, at eight points between the nodes. Eight states are summed up at once.
    """
    rows, n, width, size = scheme.rows, system.sizes.ny, system.sizes.width, NODES * system.sizes.width
    states, new = part(run.room, WIDE + STATES * width, size), part(run.room, WIDE + STATE * width, width)
    places, once = part(run.room, PARTS_OF_STEP, NODES), part(run.room, ONCE, TERMS * NODES)
    twice, terms, coefficients = part(run.room, TWICE, TERMS * NODES), POINTS, WIDE + COEFFICIENTS * width
    windings, place = outputs.status.shape[1] - abi.N_STATUS, WIDE + ENDS * width
    before, angles = part(run.room, place, abi.N_STATUS), part(run.room, place + abi.N_STATUS, windings)
    for i in range(abi.N_STATUS):
        before[i] = run.w[i]
    for i in range(windings):
        angles[i] = run.w[abi.WINDING + i]
    one, across = run_of_one_step(system, scheme.tableau, run), run.room[ADRIFT] == ACROSS
    if across:
        complete_stages(system, scheme.tableau, run, one.memory, one.room, t, following, h)
    elif run.room[COARSE] != 0.0:
        refine_rates(system, scheme, run, t, h)
        terms, coefficients = TERMS, WIDE + REFINED * width
    series = part(run.room, coefficients, TERMS * width)
    spare = part(run.room, WIDE + COEFFICIENTS * width, TERMS * width)
    out = last = run.control[abi.OUTPUTS]
    while last < outputs.times.shape[0] and outputs.times[last] < following:
        last += 1
    copied(width, run.y, new)
    while out < last:
        count = min(NODES, last - out)
        for k in range(NODES):
            places[k] = (outputs.times[out + min(k, count - 1)] - t) / h
        if not across:
            integrate_legendre(terms, places, once, twice)
            sum_up(h, terms, places, rows, run.y, series, once, twice, states)
        for k in range(count):
            if across:
                read_stages(width, scheme.tableau, places[k], h, run.y, one.memory, spare, new)
            else:
                for i in range(n):
                    new[i] = states[i * NODES + k]
            correct(system, run, outputs.times[out], new, True)
            keep_maxima(system.sizes, run, new)
            store_output(system.sizes, run.w, outputs, out, new)
            out += 1
    run.control[abi.OUTPUTS] = out
    for i in range(abi.N_STATUS):
        run.w[i] = before[i]
    for i in range(windings):
        run.w[abi.WINDING + i] = angles[i]


def inside_wide_step(
    system: ModelSystem, scheme: Nodes, run: Run, t: float, following: float, h: float, i: int, y: Array
) -> float:
    """Set `y` to the state at a node inside a good attempt, and return its part of the step; 0 without nodes."""
    if run.room[ADRIFT] != 0.0:
        return 0.0
    states = part(run.room, WIDE + STATES * system.sizes.width, NODES * system.sizes.width)
    for j in range(system.sizes.ny):
        y[j] = states[j * NODES + i]
    return float(scheme.table[PLACES + i])


@called
def refine_rates(system: ModelSystem, scheme: Nodes, run: Run, t: float, h: float) -> None:
    """Evaluate rates between the nodes; set Legendre coefficients that they correct."""
    rows, width, size = scheme.rows, system.sizes.width, NODES * system.sizes.width
    states, more = part(run.room, WIDE + STATES * width, size), part(run.room, WIDE + MORE * width, size)
    rates = part(run.room, WIDE + BUFFERS * width + int(run.room[BUFFER]) * size, size)
    coefficients, refined = WIDE + COEFFICIENTS * width, part(run.room, WIDE + REFINED * width, 2 * size)
    times = part(run.room, TIMES, NODES)
    place(h, rows, run.y, part(run.memory, NODES, width), rates, scheme.middle, states)
    for k in range(NODES):
        times[k] = t + scheme.middle[PLACES + k] * h
    if scheme.vector == 0 or scheme.derive(times, states, run.p, run.w, more) != 0:
        evaluate_one_by_one(system, run, times, states, more)
    run.control[abi.EVALUATIONS] += NODES
    refine(rows, scheme.dense, part(run.room, coefficients, 2 * size), more, refined)
