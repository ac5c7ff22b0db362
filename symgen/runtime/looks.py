"""Looks between the steps of an adaptive run: at where the next one should end, and at what the last one has passed.

The loop is left after each step, and the looks are plain Python: no loop is compiled for them, and runs without what is
looked at are entered once, as ever.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from symgen.describe.events import RESET
from symgen.runtime import abi
from symgen.runtime.entry import direct
from symgen.runtime.probe import rates_of
from symgen.runtime.switches import MOST_AGAIN

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from symgen.runtime.simulation import Simulation

#: No step is taken again that would be shorter than this part of the time: rounding says what it passes.
_SHORTEST = 1e-13
#: What counts as work that was done, of steps that are taken again as well.
_COUNTED = (abi.EVALUATIONS, abi.JACOBIANS, abi.NEWTON_ITERATIONS)


def stepped(run: Simulation, enter: Callable[[float], int], pause: float) -> int:
    """Enter a loop for each step; return how it ended.

    A step is made to end at a point of a table (`symgen.runtime.knots`), and one that has passed two switches is taken
    again (`symgen.runtime.switches`).

    Parameters
    ----------
    run : Simulation
        The run.
    enter : callable
        Enters the loop, which is left (`PAUSED`) when as many steps as it is told have been accepted.
    pause : float
        Steps of the run after which to return.
    """
    state, knots, switches, rtol = run.state, run.spec.knots, run.spec.switches, run.spec.rtol
    arrays: tuple[Any, ...] = state.clock, state.control
    views: list[Any] = [memoryview(array) for array in arrays]  # read and written faster than arrays are
    clock, control = views
    met = [] if knots is None else knots.met(rtol)
    out = [0.0] * (0 if knots is None else 3 * len(knots.levels))
    rates = _rates(run)
    with np.errstate(all="ignore"):
        if control[abi.BEGUN] != 1:  # the scheme has to begin before anything is known of its first step
            code = enter(min(pause, control[abi.STEPS]))
            if code != abi.PAUSED:
                return code
        before, again, longest = _seen(run, rates), 0, 0.0
        while (steps := control[abi.STEPS]) < pause:
            if knots is not None and again == 0:
                try:
                    knots.function(clock[abi.TIME], state.y, state.p, state.w, rates(), out)
                    clock[abi.NEXT] = knots.step(out, clock[abi.NEXT], met)
                except (ArithmeticError, ValueError):
                    pass  # what plain Python refuses to evaluate is nan in compiled code: the step stays as it is
            if switches is not None:
                run.snapshot.take(run.scheme)
            code = enter(min(pause, steps + 1))
            if code not in (abi.PAUSED, abi.DONE, abi.MET):
                return code
            if switches is not None and control[abi.STEPS] > steps:
                after, h = _seen(run, rates), clock[abi.STEP]
                if again == 0 or h < longest:
                    part = 1.0
                    if before is not None and after is not None and not _was_reset(run):
                        part = switches.part(before, after, h, rtol)
                    if part < 1.0 and again < MOST_AGAIN and part * h > _SHORTEST * clock[abi.TIME]:
                        _take_again(run, part * h)
                        again, longest = again + 1, h
                        continue
                before, again = after, 0
            if code != abi.PAUSED:
                return code
    return abi.PAUSED


def _take_again(run: Simulation, h: float) -> None:
    """Go back to where the last step began, and have the next one try `h` seconds."""
    control, clock = run.state.control, run.state.clock
    counted, refused = control[[*_COUNTED]], control[abi.REJECTED]
    run.go_back()
    control[[*_COUNTED]], control[abi.REJECTED] = counted, refused + 1
    clock[abi.NEXT] = h


def _seen(run: Simulation, rates: Callable[[], NDArray[np.float64]]) -> Sequence[float] | None:
    """Return values and rates of switches where a run stands, None where they are not known."""
    switches, state = run.spec.switches, run.state
    if switches is None:
        return None
    now, out = float(state.clock[abi.TIME]), [0.0] * (2 * switches.count)
    try:
        switches.function(now, state.y, state.p, state.w, rates(), out)
    except (ArithmeticError, ValueError):
        return None
    return out


def _was_reset(run: Simulation) -> bool:
    """Return whether velocities have jumped where a run stands: what lies across such a jump was not passed."""
    happened = [] if run.events is None else run.events.happened[-1:]
    return any(event.action == RESET and event.t == run.state.clock[abi.TIME] for event in happened)


def _rates(run: Simulation) -> Callable[[], NDArray[np.float64]]:
    """Return what gives the rate of the state where a run stands; zeros where nothing reads it."""
    state, law, switches = run.state, run.compiled.law_module, run.spec.switches
    if run.setup.knows_rates and not hasattr(law, "rates"):
        known = state.memory[: len(state.y)]
        return lambda: known
    found: NDArray[np.float64] = np.zeros_like(state.y)
    if run.spec.knots is None and (switches is None or not switches.needs_rates):
        return lambda: found
    # what emitted functions remember is that of the step
    own = state.y.copy(), state.p, state.w.copy(), state.iw.copy(), found
    function, confirm = (direct(f, abi.RHS, 0.0, *own) for f in rates_of(law))

    def rates() -> NDArray[np.float64]:
        now = float(state.clock[abi.TIME])
        own[0][:], own[2][:], own[3][:] = state.y, state.w, state.iw
        if function(now) != 0:
            confirm(now)
        state.control[abi.EVALUATIONS] += 1
        return found

    return rates
