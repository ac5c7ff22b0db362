"""The judgement of a step in the frame of loops: its attempt by the error estimate, then the state at its end."""

from __future__ import annotations

import math

from symgen.compile.native.annotations import Record
from symgen.run.layout import abi
from symgen.run.layout.records import EventRun, ModelSystem, Span
from symgen.run.loops.frame_parts import (
    ADAPTIVE,
    DIVIDE,
    DOUBT,
    EVENTS,
    FAIL,
    HOLD,
    LOW,
    NOTHING,
    SEEK,
    TAKE,
    TOO_LARGE,
    TRY,
    largest_turn,
)
from symgen.run.loops.step_control import shrunk_step
from symgen.run.loops.unbound import locate_event, refuse
from symgen.run.loops.watch import meets_singularity

#: A step across a singular position is refused only above this multiple of the tolerance, or, if that is tighter, an
#: error of this part of the state: it leads nowhere. The rounding error of such a step does not follow the tolerance.
_HOPELESS, _ASTRAY = 1e6, 1e-2
#: Part of the distance to a switch taken by a step whose stages do not pass it.
_SHORT_OF = 0.9
#: Judgements of a step beside the codes of an end: try another one from the same state; the same, as it is refused.
AGAIN, REFUSE = 101, 102


def judge_attempt(
    system: ModelSystem,
    scheme: Record,
    span: Span,
    run: EventRun,
    step: tuple[float, float, bool, bool],
    error: float,
    search: int,
    doubtful: bool,
) -> tuple[int, int, bool]:
    """Judge the attempt at a step by its error estimate.

    Parameters
    ----------
    step : tuple
        The step and its end [s]; whether it ends at an output between steps; whether it crosses a singular position.
    error : float
        Error over the tolerance; negative if the attempt has no result.
    search : int
        Last result of `locate_event`.
    doubtful : bool
        Whether the error of the whole step may be that of a switch inside, which is sought.

    Returns
    -------
    tuple
        `DONE` for a good one, `AGAIN`, `REFUSE` or the code of an end; then `search` and `doubtful`.
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
        if EVENTS and (search == NOTHING or doubtful):
            if search != TAKE and math.isfinite(error):  # a switch inside may cause the error
                search = locate_event(system, scheme, run, following, h, DOUBT if search == NOTHING else search)
                doubtful = search != NOTHING
                # an attempt that ends before the switch has its own error
                if doubtful and run.hunt[LOW] != h:
                    verdict = AGAIN
            if verdict != AGAIN:
                search = NOTHING
        if verdict != AGAIN and search != SEEK:
            verdict = REFUSE
            if crossing:
                run.control[abi.BARRED] = 1
            change = shrunk_step(span, run, error)
            if EVENTS and doubtful:  # its end is near a switch, and some stages are beyond it
                change = _SHORT_OF
            run.clock[abi.NEXT] = h * change
            refuse(run)
    return verdict, search, doubtful


def judge_state(
    system: ModelSystem, scheme: Record, run: EventRun, h: float, following: float, bits: int, search: int
) -> tuple[int, int]:
    """Judge the state at the end of a good attempt: its correction, and events that its step may pass.

    Parameters
    ----------
    h, following : float
        The step and its end [s].
    bits : int
        Result of `correct`.
    search : int
        Last result of `locate_event`.

    Returns
    -------
    tuple
        `DONE` for a good one, `AGAIN`, `REFUSE` or the code of an end; then `search`.
    """
    verdict = abi.DONE
    if bits & 1 != 0 and not ADAPTIVE:
        verdict = abi.CORRECTION if math.isfinite(run.w[abi.PHI]) else abi.NOT_FINITE
    elif bits & 1 != 0 or (ADAPTIVE and search == NOTHING and meets_singularity(run)):
        verdict = REFUSE
        run.control[abi.BARRED] = 1
        run.clock[abi.NEXT] = 0.5 * h
    elif EVENTS:
        search = locate_event(system, scheme, run, following, h, search)
        if search == SEEK or search == TAKE:
            verdict = AGAIN
        elif search == DIVIDE:
            verdict = REFUSE
            run.clock[abi.NEXT] = run.hunt[TRY]
        elif search == FAIL:
            run.clock[abi.TIME] = following
            verdict = abi.UNDEFINED
        elif search == HOLD:
            verdict = abi.TINY_STEP
    return verdict, search
