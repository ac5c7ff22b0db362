"""The frame of all loops around the step of a scheme: outputs, accepted states, error control and termination.

Loops are instances of this plain Python (`symgen.loopcode.loop_instances`). A scheme gives a meaning to the names
below, and so does the target: a processor, vector lanes, a CUDA device.

| name | takes | does |
| --- | --- | --- |
| `prepare` | system, scheme, span, run | initial data of the scheme |
| `attempt` | system, scheme, span, run, t, following, h, between | sets ``run.trial``, at `following`, from ``run.y`` |
| `renew` | system, scheme, span, run, t, changed | updates the scheme's memory after the state at `t` was accepted |
| `shrunk`, `grown` | span, run, [h,] error | ratio of the next step to a refused or accepted one |
| `interpolate` | system, scheme, span, run, outputs, t, following, h | outputs inside a step, from its ends |
| `happened` | system, run, following, h, hunting | tests whether an event lies inside an acceptable step |
| `attend` | system, run, doing | other work for events (`symgen.loops.hunting`): `LOOK`, `REMEMBER`, `RECALL` |
| `aimed` | system, run, h | a step that ends where the state passes a point of a table, in place of one of `h` |
| `is_astray` | span, run, adaptive | whether an accepted state was corrected by more than its error explains |

`attempt` returns its error estimate over the tolerance, 0 without an estimate, and changes no data of the run: it may
be repeated with a shorter step. All data for the next step are in the arrays of `symgen.layout.records.State`, so a
loop can be left and entered again, in another process too.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import Any

from symgen.layout import abi
from symgen.layout.records import OUTPUTS, SIZES, SPAN, STATE, ModelSystem, Run
from symgen.layout.redundancy import rows_fell
from symgen.layout.scales import settle
from symgen.loopcode.bare import bare, part
from symgen.loopcode.loop_instances import loop as compiled_loop
from symgen.loopcode.loop_instances import viewing
from symgen.loopcode.vectors import copied, received
from symgen.loops.step_control import grown, shrunk, with_step
from symgen.loops.watch import approach, begin, keep_maxima, meets, remember_rank, stuck, watch
from symgen.native import types

#: Positions of the step to try, and of the longest one that ends before the event sought, in the data of events
#: (`symgen.loops.search_records`).
TRY, LOW = range(2)

# -- defaults of a loop; schemes may set others ------------------------------------------------------------------------
#: Whether steps follow the error estimate; whether it is rough, so that the error of the first steps is a large part of
#: an energy that is only building up.
ADAPTIVE, ROUGH = False, False
#: Whether outputs inside a step are interpolated; otherwise each is reached by a shortened step.
DENSE = False
#: Whether events are sought; if not, the search is not compiled.
EVENTS = False

#: Constant steps at the beginning of a run in which its energy is not judged: from rest, the error of n steps of a
#: first-order scheme is an n-th of an energy that is only building up.
SETTING_OUT = 100
#: A step across a singular position is refused only above this multiple of the tolerance, or, if that is tighter, an
#: error of this part of the state: it leads nowhere. The rounding error of such a step does not follow the tolerance.
_HOPELESS, _ASTRAY = 1e6, 1e-2
#: Step across a zone over the distance to its middle: not 2, so that no stage at half the step meets the middle.
_ACROSS = 2.3
#: Assumed step until an adaptive run has chosen one, as a part of the run.
_BEFORE = 1e-3
#: Part of the distance to a switch taken by a step whose stages do not pass it.
_SHORT_OF = 0.9
#: Results of an attempt: an iteration did not converge; a matrix does not fit into its room.
DIVERGED, TOO_LARGE = -1.0, -2.0
#: Results of `happened`: no event; an event, so that shorter steps locate it; the same, and the next attempt is taken;
#: the state ends in an event; little room for more notes; a comparison in formulas changes, so that the scheme begins
#: anew; the motion is held at such a switch, which it crosses to and fro; a condition is undefined.
NOTHING, SEEK, TAKE, MEET, CROWD, RESTART, HOLD, FAIL = range(8)
#: Test of a step that is not good enough: whether its error is that of a switch inside, which is then sought.
DOUBT = FAIL + 1
#: Judgements of a step beside the codes of an end: try another one from the same state; the same, as it is refused.
AGAIN, REFUSE = 101, 102
#: Other work for events: find the side of each on which a run begins; save the memory of emitted functions at the
#: beginning of a step; restore it.
LOOK, REMEMBER, RECALL = range(DOUBT + 1, DOUBT + 4)


def prepare(system: Any, scheme: Any, span: Any, run: Any) -> None:
    """Do nothing: a scheme without memory needs nothing at the start."""


def attempt(
    system: Any, scheme: Any, span: Any, run: Any, t: float, following: float, h: float, between: bool
) -> float:
    """Stand for the step of a scheme."""
    return DIVERGED


def renew(system: Any, scheme: Any, span: Any, run: Any, t: float, changed: bool) -> None:
    """Do nothing: a scheme without memory keeps nothing of a step."""


def refuse(run: Any) -> None:
    """Do nothing: the memory of a scheme is valid for another attempt as well."""


def interpolate(
    system: Any, scheme: Any, span: Any, run: Any, outputs: Any, t: float, following: float, h: float
) -> None:
    """Stand for the dense output of a scheme."""


def happened(system: Any, run: Any, following: float, h: float, hunting: int) -> int:
    """Return `NOTHING`: placeholder for events, between a good attempt and its acceptance."""
    return NOTHING


def attend(system: Any, run: Any, doing: int) -> int:
    """Do nothing: placeholder for the initial sides of events (`LOOK`), `REMEMBER` and `RECALL`."""
    return NOTHING


def aimed(system: Any, run: Any, h: float) -> float:
    """Return the step to try in place of one of `h` seconds, proposed by the error estimate."""
    return h


def is_astray(span: Any, run: Any, adaptive: bool) -> bool:
    """Return False: only rows that may jump are examined."""
    return False


# -- parts that depend on the target -----------------------------------------------------------------------------------


@viewing
def opened(sizes: Any, state: Any) -> Any:
    """Return the state of a run, its working memory divided into parts."""
    s, width = bare(state), sizes.width
    trial, room = part(s.room, 0, width), part(s.room, width, s.room.shape[0] - width)
    kept = s.y, trial, s.p, s.w, s.iw, s.clock, s.gauges, s.control, s.events, s.memory
    return Run(*kept, s.share, s.metric, s.scales, room)


def evaluate(system: Any, run: Any, t: float, y: Any, rate: Any) -> None:
    """Set `rate` to the rate of the state `y`."""
    if system.rhs(t, y, run.p, run.w, run.iw, rate) != 0:
        system.confirm(t, y, run.p, run.w, run.iw, rate)


def correct(system: Any, run: Any, t: float, y: Any, between: bool) -> int:
    """Correct and measure a state, without a trace if it is between steps; return the bits of ``accept``."""
    run.iw[abi.PROBING] = 1 if between else 0
    bits = system.accept(t, y, run.p, run.w, run.iw)
    run.iw[abi.PROBING] = 0
    return int(bits)


def note_step(run: Any, h: float) -> None:
    """Store the present step for emitted functions."""
    run.w[abi.STEP_STATUS] = h


def store(sizes: Any, w: Any, outputs: Any, k: int, y: Any) -> None:
    """Write output `k`: the state, the measures of ``accept``, angles with counted turns and modes of rows."""
    for i in range(sizes.ny):
        outputs.states[k, i] = y[i]
    for i in range(abi.N_STATUS):
        outputs.status[k, i] = w[i]
    for i in range(abi.N_STATUS, outputs.status.shape[1]):
        outputs.status[k, i] = w[abi.WINDING - abi.N_STATUS + i]


def store_between(sizes: Any, run: Any, outputs: Any) -> None:
    """Measure and store the trial state as an output between steps."""
    out = run.control[abi.OUTPUTS]
    keep_maxima(sizes, run, run.trial)
    store(sizes, run.w, outputs, out, run.trial)
    run.control[abi.OUTPUTS] = out + 1


def taken_back(run: Any, times: Any, t: float) -> None:
    """Remove the outputs after the time `t` [s].

    Outputs inside a step are written before its end is fixed: a step that is refused, or shortened to an event, has
    others.
    """
    out = run.control[abi.OUTPUTS]
    while out > 0 and times[out - 1] > t:
        out -= 1
    run.control[abi.OUTPUTS] = out


def largest_turn(sizes: Any, span: Any, run: Any) -> float:
    """Return the largest change of an angle from the state to the trial state [rad]."""
    largest = 0.0
    for i in range(sizes.nq):
        if run.metric[i] == 0.0:
            largest = max(largest, abs(run.trial[i] - run.y[i]))
    return largest


def refused(run: Any, times: Any, t: float, phi: float, drift: float, energy: float) -> None:
    """Refuse the step from the time `t` [s]; restore the largest violations and energy error from before it."""
    run.control[abi.REJECTED] += 1
    run.control[abi.REFUSED] = 1
    run.gauges[abi.MAX_PHI], run.gauges[abi.MAX_DRIFT], run.gauges[abi.MAX_ENERGY] = phi, drift, energy
    taken_back(run, times, t)


# -- the frame ---------------------------------------------------------------------------------------------------------


def begin_loop(system: Any, scheme: Any, span: Any, run: Any, outputs: Any) -> int:
    """Measure and store the first state of a run, if it is new; begin the scheme, or discard its past steps.

    Returns the code of an end, `DONE` to continue.
    """
    sizes, clock, control, times = system.sizes, run.clock, run.control, outputs.times
    if control[abi.BEGUN] == 0:
        remember_rank(sizes, run)
        settle(sizes, span, run)
        copied(sizes.width, run.y, run.trial)
        correct(system, run, clock[abi.TIME], run.trial, False)
        copied(sizes.width, run.trial, run.y)
        begin(run)
        code = watch(sizes, run, run.y, clock[abi.TIME])
        if code != abi.DONE:
            return code
        out, latest = control[abi.OUTPUTS], clock[abi.TIME] + resolution(span)
        while out < times.shape[0] and times[out] <= latest:
            store(sizes, run.w, outputs, out, run.y)
            out += 1
        control[abi.OUTPUTS] = out
    if control[abi.BEGUN] != 1:
        clock[abi.ALLOWED] = 0.0
        control[abi.REFUSED] = control[abi.BARRED] = control[abi.KNOWN] = 0
        if ADAPTIVE:
            clock[abi.NEXT] = span.step
        # laws whose gains follow the step are evaluated before the first step
        note_step(run, span.step if span.step > 0.0 else _BEFORE * span.duration)
        prepare(system, scheme, span, run)
        if attend(system, run, LOOK) == FAIL:
            return abi.UNDEFINED
        control[abi.BEGUN] = 1
    return abi.DONE


def resolution(span: Any) -> float:
    """Return the difference below which times of a grid of constant steps are equal [s]."""
    return 0.0 if ADAPTIVE else abi.SAME_TIME * span.step


def choose_step(
    system: Any, span: Any, run: Any, outputs: Any, t: float
) -> tuple[int, float, float, bool, bool, float]:
    """Choose the step from the time `t` [s].

    Returns
    -------
    tuple
        Code of an end, `DONE` to continue; the step and its end [s]; whether it ends at an output between steps;
        whether it crosses a singular position; the step that the error estimate proposes [s].
    """
    clock, control, times, until = run.clock, run.control, outputs.times, span.until
    code, h, following, crossing, wanted = abi.DONE, 0.0, 0.0, False, 0.0
    if control[abi.STOP] != 0:
        code = abi.STOPPED
    elif control[abi.STEPS] >= span.pause:
        code = abi.PAUSED
    elif not ADAPTIVE:
        h, following = span.step, clock[abi.ORIGIN] + (control[abi.INDEX] + 1) * span.step
        if following > until + resolution(span):
            h, following = until - t, until
    elif stuck(span, run, t):
        code = abi.NO_PROGRESS
    else:
        crossing = control[abi.BARRED] == 0 and control[abi.IN_ZONE] == 1 and run.gauges[abi.FALL] > 0.0
        h = approach(min(clock[abi.NEXT], span.largest), run.gauges)
        if crossing:
            h = min(span.largest, _ACROSS * run.gauges[abi.LAST_SINE] / run.gauges[abi.FALL])
        wanted = h
        if EVENTS and not crossing:
            h = aimed(system, run, h)
        following = t + h
        if t + 1.01 * h >= until:
            h, following = until - t, until
        if not h > max(abi.RESOLVED_TIME * abs(t), abi.SHORTEST_STEP):
            code = abi.TINY_STEP
    between, out = False, control[abi.OUTPUTS]
    if not DENSE and out < times.shape[0] and times[out] < following - resolution(span):
        between, h, following = True, times[out] - t, times[out]
    return code, h, following, between, crossing, wanted


def judge_attempt(
    system: Any, span: Any, run: Any, step: Any, error: float, hunting: int, doubtful: bool
) -> tuple[int, int, bool]:
    """Judge the attempt at a step by its error estimate.

    Parameters
    ----------
    step : tuple
        The step and its end [s]; whether it ends at an output between steps; whether it crosses a singular position.
    error : float
        Error over the tolerance; negative if the attempt has no result.
    hunting : int
        Last result of `happened`.
    doubtful : bool
        Whether the error of the whole step may be that of a switch inside, which is sought.

    Returns
    -------
    tuple
        `DONE` for a good one, `AGAIN`, `REFUSE` or the code of an end; then `hunting` and `doubtful`.
    """
    h, following, between, crossing = step
    verdict = abi.DONE
    good = error <= 1.0 or (crossing and error <= max(_HOPELESS, _ASTRAY / span.rtol))
    turn = largest_turn(system.sizes, span, run) if math.isfinite(span.turn) and error >= 0.0 else 0.0
    if turn > span.turn and not ADAPTIVE:
        verdict = abi.TURNED
    elif turn > span.turn:
        verdict = REFUSE
        run.clock[abi.NEXT] = _SHORT_OF * h * span.turn / turn
        refuse(run)
    elif error == TOO_LARGE:
        verdict = abi.NO_ROOM
    elif error < 0.0 and not ADAPTIVE:
        verdict = abi.NEWTON
    elif error < 0.0:
        verdict = REFUSE
        run.clock[abi.NEXT] = 0.25 * h
    elif ADAPTIVE and not good and not between:
        if EVENTS and (hunting == NOTHING or doubtful):
            if hunting != TAKE and math.isfinite(error):  # a switch inside may cause the error
                hunting = happened(system, run, following, h, DOUBT if hunting == NOTHING else hunting)
                doubtful = hunting != NOTHING
                if doubtful and run.hunt[LOW] != h:  # an attempt that ends before the switch has its own error
                    verdict = AGAIN
            if verdict != AGAIN:
                hunting = NOTHING
        if verdict != AGAIN and hunting != SEEK:
            verdict = REFUSE
            if crossing:
                run.control[abi.BARRED] = 1
            change = shrunk(span, run, error)
            if EVENTS and doubtful:  # its end is near a switch, and some stages are beyond it
                change = _SHORT_OF
            run.clock[abi.NEXT] = h * change
            refuse(run)
    return verdict, hunting, doubtful


def judge_state(system: Any, run: Any, h: float, following: float, bits: int, hunting: int) -> tuple[int, int]:
    """Judge the state at the end of a good attempt: its correction, and events that its step may pass.

    Parameters
    ----------
    h, following : float
        The step and its end [s].
    bits : int
        Result of `correct`.
    hunting : int
        Last result of `happened`.

    Returns
    -------
    tuple
        `DONE` for a good one, `AGAIN`, `REFUSE` or the code of an end; then `hunting`.
    """
    verdict = abi.DONE
    if bits & 1 != 0 and not ADAPTIVE:
        verdict = abi.CORRECTION if math.isfinite(run.w[abi.PHI]) else abi.NOT_FINITE
    elif bits & 1 != 0 or (ADAPTIVE and hunting == NOTHING and meets(run)):
        verdict = REFUSE
        run.control[abi.BARRED] = 1
        run.clock[abi.NEXT] = 0.5 * h
    elif EVENTS:
        hunting = happened(system, run, following, h, hunting)
        if hunting == SEEK or hunting == TAKE:
            verdict = AGAIN
        elif hunting == FAIL:
            run.clock[abi.TIME] = following
            verdict = abi.UNDEFINED
        elif hunting == HOLD:
            verdict = abi.TINY_STEP
    return verdict, hunting


def accept_step(
    system: Any, scheme: Any, span: Any, run: Any, outputs: Any, t: float, step: Any, trial: Any, hunting: int
) -> int:
    """Accept the trial state at the end of a step from the time `t` [s], with the outputs inside.

    Parameters
    ----------
    step : tuple
        The step and its end [s]; whether it crosses a singular position; the step that the error estimate proposed and
        the one without events [s].
    trial : tuple
        Error of the trial state over the tolerance; whether its correction changed it.
    hunting : int
        Last result of `happened`.

    Returns
    -------
    int
        Code of an end, `DONE` to continue.
    """
    h, following, crossing, wanted, whole = step
    error, changed = trial
    control, times, width = run.control, outputs.times, system.sizes.width
    met, restart = EVENTS and hunting == MEET, EVENTS and hunting == RESTART
    control[abi.STEPS] += 1
    code = watch(system.sizes, run, run.trial, following)
    setting_out = (not ADAPTIVE or ROUGH) and control[abi.STEPS] <= SETTING_OUT
    if code != abi.DONE and not (setting_out and code == abi.ENERGY and following < span.end - resolution(span)):
        return code
    if EVENTS and is_astray(span, run, ADAPTIVE):
        return abi.JUMPED
    if met or restart:
        taken_back(run, times, following)
    if DENSE and control[abi.OUTPUTS] < times.shape[0] and times[control[abi.OUTPUTS]] < following:
        interpolate(system, scheme, span, run, outputs, t, following, h)
    received(width, run.trial, run.y)
    propose_step(span, run, h, following, crossing, wanted, error, met)
    out = control[abi.OUTPUTS]
    if out < times.shape[0] and times[out] <= following + resolution(span):
        store(system.sizes, run.w, outputs, out, run.y)
        control[abi.OUTPUTS] = out + 1
    if restart:  # rates jump at a switch, so that data of past steps are useless
        run.clock[abi.NEXT], run.clock[abi.ALLOWED] = max(run.clock[abi.NEXT], whole), 0.0
        prepare(system, scheme, with_step(span, run.clock[abi.NEXT]), run)
    else:
        renew(system, scheme, span, run, following, changed)
    if met:
        return abi.MET
    if EVENTS and hunting == CROWD:
        return abi.NOTED
    return abi.CHOOSE if rows_fell(run) else abi.DONE


def propose_step(
    span: Any, run: Any, h: float, following: float, crossing: bool, wanted: float, error: float, met: bool
) -> None:
    """Propose the step after an accepted one, with the names of `accept_step`; `met`: the run ends in an event."""
    clock, control = run.clock, run.control
    if not ADAPTIVE:
        control[abi.INDEX] += 1
        grid = clock[abi.ORIGIN] + control[abi.INDEX] * span.step
        if met or (following == span.until and following < grid - resolution(span)):
            clock[abi.ORIGIN], control[abi.INDEX] = following, 0  # a continued run has its grid from here
    elif crossing:
        clock[abi.ALLOWED] = 0.0
    else:
        grow = grown(span, run, h, error)
        clock[abi.NEXT] = h * (min(1.0, grow) if control[abi.REFUSED] == 1 else grow)
        if EVENTS and h < wanted and control[abi.REFUSED] == 0:  # it was not shortened by its error
            clock[abi.NEXT] = max(clock[abi.NEXT], wanted)
    control[abi.REFUSED] = control[abi.BARRED] = 0
    clock[abi.STEP] = h


def integrate(model: Any, scheme: Any, span: Any, state: Any, outputs: Any) -> int:
    """Integrate from the present state of a run to the end of `span`.

    Parameters
    ----------
    model : tuple
        Parts of a `ModelSystem`: the sizes of the model, then its functions (`symgen.layout.abi`), 0 for
        those that the scheme does not call.
    scheme : record
        The scheme.
    span : Span
        End of the integration, and its steps.
    state : State
        State of the run, a `HuntingState` if events are sought; changed.
    outputs : Outputs
        Outputs, written from ``control[OUTPUTS]`` on.

    Returns
    -------
    int
        Code of its end, see `symgen.layout.abi`.
    """
    system = ModelSystem(*model)
    scheme, outputs, run = bare(scheme), bare(outputs), opened(system.sizes, state)
    code = begin_loop(system, scheme, span, run, outputs)
    if code != abi.DONE:
        return code
    t, hunting, crossing, doubtful = run.clock[abi.TIME], NOTHING, False, False
    whole, whole_following, wanted = 0.0, 0.0, 0.0
    phi, drift, energy = run.gauges[abi.MAX_PHI], run.gauges[abi.MAX_DRIFT], run.gauges[abi.MAX_ENERGY]
    while t < span.until - resolution(span):
        if EVENTS and hunting != NOTHING:
            attend(system, run, RECALL)
            h, between = run.hunt[TRY], False
            following = whole_following if h == whole else t + h
        else:
            code, h, following, between, crossing, wanted = choose_step(system, span, run, outputs, t)
            if code != abi.DONE:
                return code
            doubtful = False
            if not between:
                whole, whole_following = h, following
                attend(system, run, REMEMBER)
        probing, bits = between or hunting == SEEK, 0
        note_step(run, h)
        kinetic, potential = run.w[abi.KINETIC], run.w[abi.POTENTIAL]
        error = attempt(system, scheme, span, run, t, following, h, probing)
        step = h, following, between, crossing
        code, hunting, doubtful = judge_attempt(system, span, run, step, error, hunting, doubtful)
        if code == abi.DONE:
            bits = correct(system, run, following, run.trial, probing)
            if between:
                store_between(system.sizes, run, outputs)
                # the work's error is judged by the energies at the beginning of the step, whatever outputs it has
                run.w[abi.KINETIC], run.w[abi.POTENTIAL] = kinetic, potential
                continue
            code, hunting = judge_state(system, run, h, following, bits, hunting)
        if code == AGAIN:
            continue
        if code == REFUSE:
            hunting = NOTHING
            refused(run, outputs.times, t, phi, drift, energy)
            continue
        if code == abi.DONE:
            taken, trial = (h, following, crossing, wanted, whole), (error, bits & 2 != 0)
            code = accept_step(system, scheme, span, run, outputs, t, taken, trial, hunting)
        if code != abi.DONE:
            return code
        t, hunting = following, NOTHING
        phi, drift, energy = run.gauges[abi.MAX_PHI], run.gauges[abi.MAX_DRIFT], run.gauges[abi.MAX_ENERGY]
    return abi.DONE


#: The functions of a `ModelSystem` with their types.
FUNCTIONS = {
    **{"rhs": abi.RHS, "confirm": abi.RHS, "accept": abi.ACCEPT},
    **{"turn": abi.MOVE, "residual": abi.STAGE, "tangent": abi.STAGE},
}
#: Arguments with which each loop was made, for its variant with events.
RECIPES: dict[Any, tuple[tuple[Any, ...], dict[str, Any]]] = {}


def kinds_of(functions: Iterable[str]) -> tuple[types.Kind, ...]:
    """Return the types of the parts of a `ModelSystem`; functions besides ``rhs``, ``confirm``, ``accept`` by name."""
    called = {"rhs", "confirm", "accept", *functions}
    return SIZES, *(kind if name in called else types.int64 for name, kind in FUNCTIONS.items())


def loop(module: str, name: str, scheme: Any, *functions: str, **meanings: Any) -> Any:
    """Return the compiled loop around the step of a scheme.

    Parameters
    ----------
    module, name : str
        Module variable of the loop.
    scheme : Record
        Type of the scheme's record.
    *functions : str
        Functions that it calls besides ``rhs``, ``confirm`` and ``accept``.
    **meanings
        Meanings of the names of the frame.
    """
    signature = types.int64(types.RecordType(kinds_of(functions)), scheme, SPAN, STATE, OUTPUTS)
    made = compiled_loop(module, name, integrate, signature, **meanings)
    RECIPES[made] = (module, name, scheme, *functions), meanings
    return made
