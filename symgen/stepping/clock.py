"""Controllers on an exact clock: beats at t0 + k h, each worked out by one multiplication."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING

from symgen.runtime import abi

if TYPE_CHECKING:
    from symgen.stepping.run import SteppedRun

#: What a controller is: of the time of the beat and the run; it may return values to be set, by name.
Controller = Callable[[float, "SteppedRun"], Mapping[str, float] | None]


@dataclass
class Clock:
    """When a controller is called.

    Attributes
    ----------
    controller : callable
        What is called.
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
