"""Passages: instants at which a run is left and goes on otherwise, kept with all that derivatives need of them.

Events change velocities and modes, and known times change inputs. A run that keeps its passages is one of directions
(`symgen.run.directions.directions`) or one that is passed through backwards (`symgen.run.directions.adjoint`).
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, fields, replace
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from symgen.run.directions.moments import Moment
from symgen.run.effects.effects import Effects, Impact
from symgen.run.layout import abi
from symgen.run.single.simulation import Simulation

if TYPE_CHECKING:
    from symgen.run.layout.compiled import CompiledModel
    from symgen.run.loops.integrator import Integrator
    from symgen.run.loops.run_spec import RunSpec
    from symgen.run.single.events import Happening
    from symgen.run.starts.assembly import Start

Array = NDArray[np.float64]
Note = Callable[[Sequence[int], Array, Array], None]


@dataclass(frozen=True)
class Struck:
    """Effects of events on a state.

    Attributes
    ----------
    numbers : tuple of int
        Their numbers.
    at : Moment
        The state before them.
    """

    numbers: tuple[int, ...]
    at: Moment


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


@dataclass(frozen=True, kw_only=True)
class NotedEffects(Effects):
    """Effects of events that are noted.

    Attributes
    ----------
    note : callable
        Called behind effects with the numbers of their events, the state before them and the scratch.
    """

    note: Note

    def apply(self, numbers: Sequence[int], t: float, y: Array, p: Array, w: Array) -> Impact:
        """Change a state by the effects of events at one time; see `Effects.apply`."""
        before = y.copy()
        impact = super().apply(numbers, t, y, p, w)
        self.note(numbers, before, w.copy())
        return impact


class PassingSimulation(Simulation):
    """A run that keeps its passages.

    Parameters
    ----------
    compiled, integrator, start, spec
        As for `Simulation`.
    """

    def __init__(self, compiled: CompiledModel, integrator: Integrator, start: Start, spec: RunSpec) -> None:
        self._effects = list[Struck]()
        watched = spec.events
        if watched is not None and watched.effects is not None:
            plain = {f.name: getattr(watched.effects, f.name) for f in fields(Effects)}
            effects = NotedEffects(**plain, note=self._note)
            spec = replace(spec, events=replace(watched, effects=effects))
        super().__init__(compiled, integrator, start, spec)
        if self.transitions is not None:
            self.transitions.impacts.note = self._note
        self._p = self.state.p.copy()

    def _note(self, numbers: Sequence[int], y: Array, w: Array) -> None:
        self._effects.append(Struck(tuple(numbers), Moment(self._time, y, self.state.p.copy(), w)))

    @property
    def _time(self) -> float:
        return float(self.state.clock[abi.TIME])

    def _moment(self) -> Moment:
        state = self.state
        return Moment(self._time, state.y.copy(), state.p.copy(), state.w.copy())

    def passed(self, passage: RunPassage) -> None:
        """Take a passage; the run goes on behind it. What is done with it is up to subclasses."""
        raise NotImplementedError

    def _pass(self, numbers: Sequence[int], before: Moment, starts: bool = False) -> None:
        effects, self._effects = tuple(self._effects), []
        self._p = self.state.p.copy()
        self.passed(RunPassage(tuple(numbers), before, self._moment(), effects, starts))

    def _begin_modes(self) -> None:
        if self.transitions is None or self.state.control[abi.BEGUN] == 1:
            return
        before = self._moment()._replace(p=self._p)
        starts = bool(self.state.control[abi.BEGUN] == 0 and self.state.control[abi.STEPS] == 0)
        super()._begin_modes()
        self._pass((), before, starts)

    def _meet(self, events: Sequence[tuple[int, Happening]]) -> int:
        before, acting = self._moment(), self._acting(events)
        code = super()._meet(events)
        if acting:
            self._pass(acting, before)
        return code

    def _acting(self, events: Sequence[tuple[int, Happening]]) -> list[int]:
        """Return the numbers of the events at the present time that change anything."""
        from symgen.describe.bounds.modes import MODE
        from symgen.describe.parts.events import RESET

        now = self._time
        return [number for number, event in events if event.t == now and event.action in (MODE, RESET)]

    def _go_on_changed(self) -> bool:
        before = self._moment()._replace(p=self._p)
        if not super()._go_on_changed():
            return False
        self._pass((), before)
        return True
