"""Passages: instants at which a run is left and goes on otherwise, kept with all that derivatives need of them.

Events change velocities and modes, and known times change inputs. A run that keeps its passages is one of directions
(`symgen.run.directions.directions`) or one that is passed through backwards (`symgen.run.directions.adjoint`).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from symgen.run.directions.moments import Moment, Moments
from symgen.run.directions.slips_in_space import SlipsInSpace
from symgen.run.effects.pushing import KeptTies
from symgen.run.layout import abi
from symgen.run.single.simulation import Simulation

if TYPE_CHECKING:
    from symgen.run.layout.compiled import CompiledModel
    from symgen.run.layout.records import Outputs
    from symgen.run.loops.integrator import Integrator
    from symgen.run.loops.run_spec import RunSpec
    from symgen.run.single.events import Happening
    from symgen.run.starts.assembly import Start

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Struck:
    """Effects of events on a state.

    Attributes
    ----------
    numbers : tuple of int
        Their numbers.
    at : Moment
        The state before them.
    ties : KeptTies or None
        Of contacts, what the impact was tied to.
    """

    numbers: tuple[int, ...]
    at: Moment
    ties: KeptTies | None = None


@dataclass(frozen=True)
class RunPassage:
    """An instant at which a run goes on otherwise.

    Attributes
    ----------
    numbers : tuple of int
        Numbers of the events whose time it is; none at a known time, whose derivative is zero.
    before, after : Moment
        The state on both sides.
    effects : tuple of Struck
        Effects of events in their order.
    starts : bool
        Whether the run begins here.
    """

    numbers: tuple[int, ...]
    before: Moment
    after: Moment
    effects: tuple[Struck, ...] = ()
    starts: bool = False


class PassingSimulation(Simulation):
    """A run that keeps its passages.

    Parameters
    ----------
    compiled, integrator, start, spec
        As for `Simulation`.
    """

    def __init__(self, compiled: CompiledModel, integrator: Integrator, start: Start, spec: RunSpec) -> None:
        super().__init__(compiled, integrator, start, spec)
        self._p = self.state.p.copy()
        self._longest = self.span.largest

    @property
    def plain(self) -> CompiledModel:
        """The model without directions."""
        return self.compiled

    @cached_property
    def _slips(self) -> SlipsInSpace | None:
        """Contacts whose slip has a direction; None without any."""
        watched = self.spec.events
        if watched is None or watched.bounded is None or not watched.bounded.paired:
            return None
        return SlipsInSpace(Moments(self.plain, np.zeros((len(self.start.p), 1))), watched)

    def enter(
        self, outputs: Outputs, until: float | None = None, pause: float = np.inf, most: float | None = None
    ) -> int:
        """Continue; where slip has a direction, each step is as short as directions need it before slip ends."""
        while True:
            here = self.state.control[abi.STEPS]
            code = super().enter(outputs, until, pause if self._slips is None else min(pause, here + 1), most)
            if code != abi.PAUSED or self.state.control[abi.STEPS] >= pause:
                return code

    def _shorten_step(self) -> None:
        """Let the next step be as short as directions of slip need it."""
        if self._slips is not None and self.spec.adaptive:
            longest = self._slips.longest_step(self._slips.moments.plain(self._present_moment()))
            self.span = self.span._replace(largest=min(self._longest, longest))

    @property
    def has_modes(self) -> bool:
        """Whether rows have bounds, so that a run begins in modes."""
        return self.turn is not None and self.turn.rows is not None

    def _struck(self) -> tuple[Struck, ...]:
        """Return what events have just changed, in order."""
        effects = [] if self.turn is None else self.turn.effects_in_order
        return tuple(
            Struck(numbers, Moment(self._time, y, self.state.p.copy(), w), ties) for numbers, y, w, ties in effects
        )

    @property
    def _time(self) -> float:
        return float(self.state.clock[abi.TIME])

    def _present_moment(self) -> Moment:
        state = self.state
        return Moment(self._time, state.y.copy(), state.p.copy(), state.w.copy())

    def note_passed(self, passage: RunPassage) -> None:
        """Take a passage; the run goes on after it. What is done with it is up to subclasses."""
        raise NotImplementedError

    def _pass_event(
        self, numbers: Sequence[int], before: Moment, effects: tuple[Struck, ...] = (), starts: bool = False
    ) -> None:
        self._p = self.state.p.copy()
        self.note_passed(RunPassage(tuple(numbers), before, self._present_moment(), effects, starts))

    def _begin_modes(self) -> None:
        if not self.has_modes or self.state.control[abi.BEGUN] == 1:
            self._shorten_step()
            return
        before = self._present_moment()._replace(p=self._p)
        starts = bool(self.state.control[abi.BEGUN] == 0 and self.state.control[abi.STEPS] == 0)
        super()._begin_modes()
        self._pass_event((), before, self._struck(), starts)
        self._shorten_step()

    def _meet(self, events: Sequence[tuple[int, Happening]]) -> int:
        before, acting = self._present_moment(), self._rows_that_act(events)
        code = super()._meet(events)
        if acting:
            self._pass_event(acting, before, self._struck())
        return code

    def _rows_that_act(self, events: Sequence[tuple[int, Happening]]) -> list[int]:
        """Return the numbers of the events at the present time that change anything."""
        from symgen.describe.bounds.bounded_modes import MODE
        from symgen.describe.parts.event_sections import RESET

        now = self._time
        return [number for number, event in events if event.t == now and event.action in (MODE, RESET)]

    def _go_on_changed(self) -> bool:
        before = self._present_moment()._replace(p=self._p)
        if not super()._go_on_changed():
            return False
        self._pass_event((), before, self._struck() if self.has_modes else ())
        return True
