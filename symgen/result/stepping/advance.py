"""Going on from Python: pieces between which an interrupt acts, and steps that fail."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING

from symgen.base.errors import InputError, StepError
from symgen.describe.parts.event_sections import STOP
from symgen.run.layout import abi
from symgen.run.single.changes import begin_anew, begin_stepping
from symgen.run.single.events import EventRecord, record_of
from symgen.run.single.run import reason_of

if TYPE_CHECKING:
    from symgen.run.single.simulation import Simulation

#: A loop is left after about so long, so that Ctrl-C is heard [s]; and after so many steps as long as nothing is known.
PATIENCE, FIRST_STEPS = 0.05, 100

# looked up at every step
_TIME, _STEPS, _BEGUN, _DONE = abi.TIME, abi.STEPS, abi.BEGUN, abi.DONE


class Advance:
    """A run that is taken from one accepted state to another.

    Parameters
    ----------
    loop : Simulation
        The run.

    Attributes
    ----------
    unsure : bool
        Whether the state may be no accepted one: see `recover`.
    """

    def __init__(self, loop: Simulation) -> None:
        self.loop, self.unsure = loop, False
        self._clock, self._control = loop.state.clock.data, loop.state.control.data
        self._until, self._most, self._steps_at_once = 0.0, loop.spec.max_attempts, FIRST_STEPS

    def recover(self) -> None:
        """Go back to an accepted state, where an interrupt came between a failure and what is done about it."""
        if self.unsure:
            self._replay()

    def begin(self) -> None:
        """Accept the first state, if that has not happened."""
        if self._control[abi.BEGUN] == 0:
            code = begin_stepping(self.loop)
            if code != abi.DONE:
                self.fail(code)

    def begin_grid(self) -> None:
        """Begin a new grid of constant steps at the present time."""
        self._clock[abi.ORIGIN], self._control[abi.INDEX] = self._clock[abi.TIME], 0

    def take_steps_of(self, step: float) -> None:
        """Go on by constant steps of another length, on a grid that begins here."""
        loop = self.loop
        if step == loop.span.step:
            return
        loop.span = loop.span._replace(step=step)
        self.begin_grid()
        if self._control[abi.BEGUN] == 1 and self._control[abi.STEPS] == 0:
            code = begin_anew(loop)  # schemes may prepare for the first step's length
            if code != _DONE:
                self.fail(code)

    def to(self, until: float) -> EventRecord | None:
        """Go on to a time without a look at controllers, in pieces between which an interrupt is heard.

        Returns the event that has ended it before, if one has.
        """
        loop, control = self.loop, self._control
        if control[_BEGUN] == 0:
            self.begin()
        if loop.spec.adaptive:
            if not loop.is_ahead(until):
                return None
            self._most = control[_STEPS] + control[abi.REJECTED] + loop.spec.max_attempts
        began, further = 0.0, False
        try:
            while True:
                self._until = until
                self.unsure = True
                code = loop.go_until(until, control[_STEPS] + self._steps_at_once, self._most, further)
                if code == _DONE:
                    self.unsure = False
                    return None
                if code == abi.MET:
                    self.unsure = False
                    assert loop.events is not None, "an event was met"
                    event = next(event for event in reversed(loop.events.happened) if event.action == STOP)
                    return record_of(loop.compiled.info, event)
                if code != abi.PAUSED:
                    self.fail(code)
                self.unsure, further = False, True
                now = time.perf_counter()
                if began > 0.0:
                    more = self._steps_at_once * PATIENCE / max(now - began, 1e-9)
                    self._steps_at_once = int(min(max(more, 1), 1e7))
                began = now
        except (KeyboardInterrupt, InputError):  # which may come before it is known how the loop ended
            self.recover()
            raise

    def fail(self, code: int) -> None:
        """Go back to the last accepted state, and raise what happened."""
        moment = self._clock[_TIME]
        reason = reason_of(self.loop, code, moment)
        self._replay()
        raise StepError(reason, moment)

    def _replay(self) -> None:
        """Restore the last accepted state, as the numbers that a failed step leaves are of no use.

        The steps from what is remembered on are done once more. Whether a failed one was counted depends on where it
        failed.
        """
        loop, steps = self.loop, int(self._control[abi.STEPS])
        for accepted in (steps, steps - 1):
            loop.go_back()
            if self._control[abi.BEGUN] == 0:
                break
            try:
                if loop.go_until(self._until, accepted, self._most) in (abi.DONE, abi.PAUSED, abi.MET):
                    break
            except InputError:  # the last step ends in an event that asks for what cannot be
                continue
        else:
            loop.go_back()
        self.unsure = False
