"""Controllers of a run: functions that are called on exact clocks as it goes on."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING

from symgen.base import arguments
from symgen.base.errors import InputError
from symgen.run.layout import abi

if TYPE_CHECKING:
    from collections.abc import Sequence

    from symgen.result.stepping.stepped_run import SteppedRun

#: What a controller is: of the time of the beat and the run; it may return values to be set, by name.
Controller = Callable[[float, "SteppedRun"], Mapping[str, float] | None]


@dataclass
class Clock:
    """When a controller is called.

    Attributes
    ----------
    controller : callable
        The function.
    start, interval : float
        Beats are at ``start + k interval`` [s].
    beat : int
        The next k.
    """

    controller: Controller
    start: float
    interval: float
    beat: int = 0

    @property
    def due(self) -> float:
        """Time of the next beat [s]."""
        return self.start + self.beat * self.interval

    def is_due(self, t: float, slack: float) -> bool:
        """Whether the next beat is at a time, or was before it; `slack` is what the run takes for the same time [s]."""
        return self.due - t <= max(slack, abi.SAME_TIME * self.interval)


class Controllers:
    """The controllers of a run.

    Attributes
    ----------
    clocks : list of Clock
        When each is called.
    calling : bool
        Whether they are being called.
    """

    def __init__(self) -> None:
        self.clocks, self.calling = list[Clock](), False

    def add(self, controller: Controller, t: float, interval: float) -> None:
        """Have a function called from a time on [s], after each interval [s]."""
        interval = arguments.number("interval", interval, positive=True)
        if controller is None or arguments.callable_or_none("controller", controller) is None:
            raise InputError("controller", "a function", "None")
        self.clocks.append(Clock(controller, t, interval))

    @property
    def beats(self) -> tuple[tuple[float, float, int], ...]:
        """Start [s], interval [s] and next beat of each."""
        return tuple((c.start, c.interval, c.beat) for c in self.clocks)

    @property
    def intervals(self) -> tuple[float, ...]:
        """Interval of each [s]."""
        return tuple(c.interval for c in self.clocks)

    def take_up(self, beats: Sequence[tuple[float, float, int]]) -> None:
        """Go on at other beats, as `beats` returned them."""
        for clock, (start, _, beat) in zip(self.clocks, beats, strict=True):
            clock.start, clock.beat = start, beat

    def begin_at(self, t: float) -> None:
        """Begin anew at a time [s]."""
        for clock in self.clocks:
            clock.start, clock.beat = t, 0

    def due_before(self, until: float) -> float:
        """Return the time of the first beat, at most `until` [s]."""
        return min((until, *(clock.due for clock in self.clocks)))

    def call(self, run: SteppedRun, now: float, slack: float) -> None:
        """Call those whose time has come, and set what they return; `slack` is as for `Clock.is_due`."""
        self.calling = True
        try:
            for clock in self.clocks:
                if clock.is_due(now, slack):
                    values = clock.controller(clock.due, run)
                    if values is not None:
                        run.set(arguments.mapping("controller", values, "values by name, or None"))
                    clock.beat += 1
        finally:
            self.calling = False
