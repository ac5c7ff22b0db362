"""The frame of all loops around the step of a scheme: outputs, accepted states, error control and termination.

Loops are instances of this plain Python (`symgen.runtime.loop_instances`). A scheme gives a meaning to the names below,
and so does the target: a processor, vector lanes, a CUDA device.

| name | takes | does |
| --- | --- | --- |
| `prepare` | system, scheme, span, run | initial data of the scheme |
| `attempt` | system, scheme, span, run, t, following, h, between | sets ``run.trial``, at `following`, from ``run.y`` |
| `renew` | system, scheme, span, run, t, changed | updates the scheme's memory after the state at `t` was accepted |
| `shrunk`, `grown` | span, run, [h,] error | ratio of the next step to a refused or accepted one |
| `interpolate` | system, scheme, span, run, outputs, t, following, h | outputs inside a step, from its ends |
| `happened` | system, run, t, following, h, hunting | tests whether an event lies inside an acceptable step |
| `attend` | system, run, doing | other work for events (`symgen.runtime.hunting`): `LOOK`, `REMEMBER`, `RECALL` |
| `aimed` | system, run, h | a step that ends where the state passes a point of a table, in place of one of `h` |
| `is_astray` | span, run, adaptive | whether an accepted state was corrected by more than its error explains |

`attempt` returns its error estimate over the tolerance, 0 without an estimate, and changes no data of the run: it may
be repeated with a shorter step. All data for the next step are in the arrays of `symgen.runtime.records.State`, so a
loop can be left and entered again, in another process too.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import Any

from symgen.native import types
from symgen.runtime import abi
from symgen.runtime.bare import bare, part
from symgen.runtime.loop_instances import loop as compiled_loop
from symgen.runtime.loop_instances import viewing
from symgen.runtime.records import OUTPUTS, SIZES, SPAN, STATE, ModelSystem, Run
from symgen.runtime.redundancy import rows_fell
from symgen.runtime.scales import settle
from symgen.runtime.step_control import grown, shrunk, with_step
from symgen.runtime.vectors import copied, received
from symgen.runtime.watch import approach, begin, keep_maxima, meets, remember_rank, stuck, watch

#: Positions of the step to try, and of the longest one that ends before the event sought, in the data of events
#: (`symgen.runtime.search_records`).
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


def happened(system: Any, run: Any, t: float, following: float, h: float, hunting: int) -> int:
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
    """Write output `k`: the state, the measures of ``accept``, and angles with counted turns."""
    for i in range(sizes.ny):
        outputs.states[k, i] = y[i]
    for i in range(abi.N_STATUS):
        outputs.status[k, i] = w[i]
    for i in range(abi.N_STATUS, outputs.status.shape[1]):
        outputs.status[k, i] = w[abi.WINDING - abi.N_STATUS + i]


def taken_back(run: Any, times: Any, out: int, t: float) -> int:
    """Remove those of the first `out` outputs that are after the time `t` [s]; return the number left.

    Outputs inside a step are written before its end is fixed: a step that is refused, or shortened to an event, has
    others.
    """
    while out > 0 and times[out - 1] > t:
        out -= 1
    run.control[abi.OUTPUTS] = out
    return out


def largest_turn(sizes: Any, span: Any, run: Any) -> float:
    """Return the largest change of an angle from the state to the trial state [rad]."""
    largest = 0.0
    for i in range(sizes.nq):
        if run.metric[i] == 0.0:
            largest = max(largest, abs(run.trial[i] - run.y[i]))
    return largest


def refused(run: Any, times: Any, out: int, t: float, phi: float, drift: float, energy: float) -> int:
    """Refuse the step from the time `t` [s]; restore the largest violations and energy error from before it.

    Returns the number of the first `out` outputs that are left.
    """
    run.control[abi.REJECTED] += 1
    run.control[abi.REFUSED] = 1
    run.gauges[abi.MAX_PHI], run.gauges[abi.MAX_DRIFT], run.gauges[abi.MAX_ENERGY] = phi, drift, energy
    return taken_back(run, times, out, t)


# -- the frame ---------------------------------------------------------------------------------------------------------


def integrate(model: Any, scheme: Any, span: Any, state: Any, outputs: Any) -> int:
    """Integrate from the present state of a run to the end of `span`.

    Parameters
    ----------
    model : tuple
        Parts of a `ModelSystem`: the sizes of the model, then its functions (`symgen.runtime.abi`), 0 for
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
        Code of its end, see `symgen.runtime.abi`.
    """
    system = ModelSystem(*model)
    sizes, scheme, outputs = system.sizes, bare(scheme), bare(outputs)
    run, until, times, width = opened(sizes, state), span.until, outputs.times, sizes.width
    clock, control, asked = run.clock, run.control, times.shape[0]
    tiny = 0.0 if ADAPTIVE else abi.SAME_TIME * span.step
    if control[abi.BEGUN] == 0:
        remember_rank(sizes, run)
        settle(sizes, span, run)
        copied(width, run.y, run.trial)
        correct(system, run, clock[abi.TIME], run.trial, False)
        copied(width, run.trial, run.y)
        begin(run)
        code = watch(sizes, run, run.y, clock[abi.TIME])
        if code != abi.DONE:
            return code
        out = control[abi.OUTPUTS]
        while out < asked and times[out] <= clock[abi.TIME] + tiny:
            store(sizes, run.w, outputs, out, run.y)
            out += 1
        control[abi.OUTPUTS] = out
    if control[abi.BEGUN] != 1:  # a scheme begins, or discards past steps
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
    t, out = clock[abi.TIME], control[abi.OUTPUTS]
    hunting, crossing, doubtful = NOTHING, False, False
    whole, whole_following, wanted = 0.0, 0.0, 0.0
    phi, drift, energy = run.gauges[abi.MAX_PHI], run.gauges[abi.MAX_DRIFT], run.gauges[abi.MAX_ENERGY]
    while t < until - tiny:
        if hunting == NOTHING:
            doubtful = False
            if control[abi.STOP] != 0:
                return abi.STOPPED
            if control[abi.STEPS] >= span.pause:
                return abi.PAUSED
            crossing = False
        # -- the step to try
        if EVENTS and hunting != NOTHING:
            attend(system, run, RECALL)
            h = run.hunt[TRY]
            following = whole_following if h == whole else t + h
        elif ADAPTIVE:
            if stuck(span, run, t):
                return abi.NO_PROGRESS
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
                return abi.TINY_STEP
        else:
            h, following = span.step, clock[abi.ORIGIN] + (control[abi.INDEX] + 1) * span.step
            if following > until + tiny:
                h, following = until - t, until
        between = not DENSE and hunting == NOTHING and out < asked and times[out] < following - tiny
        if between:
            h, following = times[out] - t, times[out]
        elif hunting == NOTHING:
            whole, whole_following = h, following
            attend(system, run, REMEMBER)
        probing = between or hunting == SEEK
        note_step(run, h)
        kinetic, potential = run.w[abi.KINETIC], run.w[abi.POTENTIAL]
        error = attempt(system, scheme, span, run, t, following, h, probing)
        # -- is it good enough?
        turn = largest_turn(sizes, span, run) if math.isfinite(span.turn) and error >= 0.0 else 0.0
        if turn > span.turn:
            if not ADAPTIVE:
                return abi.TURNED
            clock[abi.NEXT] = _SHORT_OF * h * span.turn / turn
            refuse(run)
            hunting, out = NOTHING, refused(run, times, out, t, phi, drift, energy)
            continue
        if error < 0.0:
            if error == TOO_LARGE:
                return abi.NO_ROOM
            if not ADAPTIVE:
                return abi.NEWTON
            clock[abi.NEXT] = 0.25 * h
            hunting, out = NOTHING, refused(run, times, out, t, phi, drift, energy)
            continue
        good = error <= 1.0 or (crossing and error <= max(_HOPELESS, _ASTRAY / span.rtol))
        if EVENTS and ADAPTIVE and not good and not between and (hunting == NOTHING or doubtful):
            if hunting != TAKE and math.isfinite(error):  # a switch inside may cause the error
                hunting = happened(system, run, t, following, h, DOUBT if hunting == NOTHING else hunting)
                doubtful = hunting != NOTHING
                if doubtful and run.hunt[LOW] != h:  # an attempt that ends before the switch has its own error
                    continue
            hunting = NOTHING
        if ADAPTIVE and not between and hunting != SEEK and not good:
            hunting = NOTHING
            if crossing:
                control[abi.BARRED] = 1
            change = shrunk(span, run, error)
            if EVENTS and doubtful:  # its end is near a switch, and some stages are beyond it
                change = _SHORT_OF
            clock[abi.NEXT] = h * change
            refuse(run)
            out = refused(run, times, out, t, phi, drift, energy)
            continue
        bits = correct(system, run, following, run.trial, probing)
        if between:
            keep_maxima(sizes, run, run.trial)
            store(sizes, run.w, outputs, out, run.trial)
            out += 1
            control[abi.OUTPUTS] = out
            # the work's error is judged by the energies at the beginning of the step, whatever outputs it has
            run.w[abi.KINETIC], run.w[abi.POTENTIAL] = kinetic, potential
            continue
        if bits & 1 != 0 or (ADAPTIVE and hunting == NOTHING and meets(run)):
            if not ADAPTIVE:
                return abi.CORRECTION if math.isfinite(run.w[abi.PHI]) else abi.NOT_FINITE
            control[abi.BARRED] = 1
            clock[abi.NEXT] = 0.5 * h
            hunting, out = NOTHING, refused(run, times, out, t, phi, drift, energy)
            continue
        if EVENTS:
            hunting = happened(system, run, t, following, h, hunting)
            if hunting == SEEK or hunting == TAKE:
                continue
            if hunting == FAIL:
                clock[abi.TIME] = following
                return abi.UNDEFINED
            if hunting == HOLD:
                return abi.TINY_STEP
        # -- it is: the state at `following` is accepted
        control[abi.STEPS] += 1
        code = watch(sizes, run, run.trial, following)
        setting_out = (not ADAPTIVE or ROUGH) and control[abi.STEPS] <= SETTING_OUT
        if setting_out and code == abi.ENERGY and following < span.end - tiny:
            code = abi.DONE
        if EVENTS and code == abi.DONE and is_astray(span, run, ADAPTIVE):
            code = abi.JUMPED
        if code != abi.DONE:
            return code
        if EVENTS and hunting == MEET:
            code = abi.MET
            out = taken_back(run, times, out, following)
        elif EVENTS and hunting == CROWD:
            code = abi.NOTED
        restart = EVENTS and hunting == RESTART
        if restart:
            out = taken_back(run, times, out, following)
        hunting = NOTHING
        if DENSE and out < asked and times[out] < following:
            interpolate(system, scheme, span, run, outputs, t, following, h)
            out = control[abi.OUTPUTS]
        received(width, run.trial, run.y)
        if not ADAPTIVE:
            control[abi.INDEX] += 1
            early = following == until and following < clock[abi.ORIGIN] + control[abi.INDEX] * span.step - tiny
            if early or (EVENTS and code == abi.MET):
                clock[abi.ORIGIN], control[abi.INDEX] = following, 0  # a continued run has its grid from here
        elif crossing:
            clock[abi.ALLOWED] = 0.0
        else:
            grow = grown(span, run, h, error)
            clock[abi.NEXT] = h * (min(1.0, grow) if control[abi.REFUSED] == 1 else grow)
            if EVENTS and h < wanted and control[abi.REFUSED] == 0:  # it was not shortened by its error
                clock[abi.NEXT] = max(clock[abi.NEXT], wanted)
        control[abi.REFUSED] = control[abi.BARRED] = 0
        t = following
        phi, drift, energy = run.gauges[abi.MAX_PHI], run.gauges[abi.MAX_DRIFT], run.gauges[abi.MAX_ENERGY]
        clock[abi.STEP] = h
        if out < asked and times[out] <= t + tiny:
            store(sizes, run.w, outputs, out, run.y)
            out += 1
            control[abi.OUTPUTS] = out
        if restart:  # rates jump at a switch, so that data of past steps are useless
            clock[abi.NEXT], clock[abi.ALLOWED] = max(clock[abi.NEXT], whole), 0.0
            prepare(system, scheme, with_step(span, clock[abi.NEXT]), run)
        else:
            renew(system, scheme, span, run, t, bits & 2 != 0)
        if code != abi.DONE:
            return code
        if rows_fell(run):
            return abi.CHOOSE
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
