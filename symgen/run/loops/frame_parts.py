"""Parts of the frame that targets replace, the constants that schemes set, and the codes that parts return.

Parts that do nothing by default are in `symgen.run.loops.unbound`.
"""

from __future__ import annotations

from symgen.compile.loopcode.bare import bare, part
from symgen.compile.loopcode.loop_instances import viewing
from symgen.compile.native.annotations import Array
from symgen.run.layout import abi
from symgen.run.layout.records import EventRun, ModelSystem, Outputs, Run, Sizes, Span, State
from symgen.run.loops.watch import keep_maxima

#: Positions of the step to try, and of the longest one that ends before the event sought, in the data of events
#: (`symgen.run.loops.search_records`).
TRY, LOW = range(2)

# -- defaults of a loop; schemes may set others ------------------------------------------------------------------------
#: Whether steps follow the error estimate; whether it is rough, so that the error of the first steps is a large part of
#: an energy that is only building up.
ADAPTIVE, ROUGH = False, False
#: Whether outputs inside a step are interpolated; otherwise each is reached by a shortened step.
DENSE = False
#: Whether events are sought; if not, the search is not compiled.
EVENTS = False

#: Results of an attempt: an iteration did not converge; a matrix does not fit into its room.
DIVERGED, TOO_LARGE = -1.0, -2.0
#: Results of `located`: no event; an event, so that shorter steps locate it; the same, and the next attempt is taken;
#: the state ends in an event; little room for more notes; a comparison in formulas changes, so that the scheme begins
#: anew; the motion is held at such a switch, which it crosses to and fro; the step is too long to show its events; a
#: condition is undefined.
NOTHING, SEEK, TAKE, MEET, CROWD, RESTART, HOLD, DIVIDE, FAIL = range(9)
#: Test of a step that is not good enough: whether a switch inside causes its error; if so, the loop seeks the switch.
DOUBT = FAIL + 1
#: Other work for events: find the side of each on which a run begins; save the memory of emitted functions at the
#: beginning of a step; restore it.
LOOK, REMEMBER, RECALL = range(DOUBT + 1, DOUBT + 4)


# -- parts that depend on the target -----------------------------------------------------------------------------------


@viewing
def open_run(sizes: Sizes, state: State) -> EventRun:
    """Return the state of a run, its working memory divided into parts."""
    s, width = bare(state), sizes.width
    trial, room = part(s.room, 0, width), part(s.room, width, s.room.shape[0] - width)
    kept = s.y, trial, s.p, s.w, s.iw, s.clock, s.gauges, s.control, s.passages, s.memory
    return Run(*kept, s.share, s.metric, s.scales, room)  # type: ignore[return-value]  # `hunt` is read with `EVENTS` alone


def evaluate(system: ModelSystem, run: Run | State, t: float, y: Array, rate: Array) -> None:
    """Set `rate` to the rate of the state `y`."""
    if system.rhs(t, y, run.p, run.w, run.iw, rate) != 0:
        system.confirm(t, y, run.p, run.w, run.iw, rate)


def correct(system: ModelSystem, run: Run, t: float, y: Array, between: bool) -> int:
    """Correct and measure a state, without a trace if it is between steps; return the bits of ``accept``."""
    run.iw[abi.PROBING] = 1 if between else 0
    bits = system.accept(t, y, run.p, run.w, run.iw)
    run.iw[abi.PROBING] = 0
    return int(bits)


def note_step(run: Run, h: float) -> None:
    """Store the present step for emitted functions."""
    run.w[abi.STEP_STATUS] = h


def store_output(sizes: Sizes, w: Array, outputs: Outputs, k: int, y: Array) -> None:
    """Write output `k`: the state, the measures of ``accept``, angles with counted turns and modes of rows."""
    for i in range(sizes.ny):
        outputs.states[k, i] = y[i]
    for i in range(abi.N_STATUS):
        outputs.status[k, i] = w[i]
    for i in range(abi.N_STATUS, outputs.status.shape[1]):
        outputs.status[k, i] = w[abi.WINDING - abi.N_STATUS + i]


def store_after_reset(outputs: Outputs, count: int, now: float, near: float, y: Array, w: Array) -> None:
    """Have outputs at the time of a reset hold the state after it, from which the motion goes on.

    Parameters
    ----------
    outputs, count : Outputs, int
        Outputs of the run, and the number of those written.
    now, near : float
        The time, and the difference up to which times count as the same [s].
    y, w : Array
        State and scratch after the reset.
    """
    out = count
    while out > 0 and abs(outputs.times[out - 1] - now) <= near:
        out -= 1
        for i in range(outputs.states.shape[1]):
            outputs.states[out, i] = y[i]
        outputs.status[out, abi.KINETIC] = w[abi.KINETIC]
        for i in range(outputs.status.shape[1] - abi.N_STATUS):
            outputs.status[out, abi.N_STATUS + i] = w[abi.WINDING + i]


def store_between(sizes: Sizes, run: Run, outputs: Outputs) -> None:
    """Measure and store the trial state as an output between steps."""
    out = run.control[abi.OUTPUTS]
    keep_maxima(sizes, run, run.trial)
    store_output(sizes, run.w, outputs, out, run.trial)
    run.control[abi.OUTPUTS] = out + 1


def take_back_outputs(run: Run, times: Array, t: float) -> None:
    """Remove the outputs after the time `t` [s].

    Outputs inside a step are written before its end is fixed: a step that is refused, or shortened to an event, has
    others.
    """
    out = run.control[abi.OUTPUTS]
    while out > 0 and times[out - 1] > t:
        out -= 1
    run.control[abi.OUTPUTS] = out


def largest_turn(sizes: Sizes, span: Span, run: Run) -> float:
    """Return the largest change of an angle from the state to the trial state [rad]."""
    largest = 0.0
    for i in range(sizes.nq):
        if run.metric[i] == 0.0:
            largest = max(largest, abs(run.trial[i] - run.y[i]))
    return largest


def refuse_step(run: Run, times: Array, t: float, phi: float, drift: float, energy: float) -> None:
    """Refuse the step from the time `t` [s]; restore the largest violations and energy error from before it."""
    run.control[abi.REJECTED] += 1
    run.control[abi.REFUSED] = 1
    run.gauges[abi.MAX_PHI], run.gauges[abi.MAX_DRIFT], run.gauges[abi.MAX_ENERGY] = phi, drift, energy
    take_back_outputs(run, times, t)
