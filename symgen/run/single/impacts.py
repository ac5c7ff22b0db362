"""Impacts at gaps: Newton's law through all rows of joints, in the metric of M.

At an impact the rate u of each gap that is 0 satisfies ``u+ + e min(u-, 0) >= 0`` with a restitution e, its impulse
only pushes, and one of both is zero: the box problem (`symgen.run.modes.box`) on rates instead of accelerations. A row
with two bounds has no impulse. Where impacts follow each other ever faster, so that the time until they accumulate
counts as zero, the gap is at rest.
"""

from __future__ import annotations

from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from symgen.base.errors import InputError
from symgen.base.ir.program import MODE_NUMBERS
from symgen.compile.loopcode.entry import direct
from symgen.compile.loopcode.exact import compiled_form
from symgen.describe.bounds.modes import HIT
from symgen.run.layout import abi
from symgen.run.modes.bounded_rows import NOT_APPLIED, OTHERS, SAME, SIGN
from symgen.run.modes.strikes import GATHER, STRIKE, gather, new_strikes, strike

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from symgen.run.effects.effects import Impact
    from symgen.run.loops.run_spec import BoundedRows, Watched
    from symgen.run.single.events import Events
    from symgen.run.single.simulation import Simulation

Array = NDArray[np.float64]


class Impacts:
    """The impacts of a run.

    Parameters
    ----------
    simulation : Simulation
        The run.
    rows : BoundedRows
        Its rows whose forces have bounds.

    Attributes
    ----------
    latest : dict of int to Impact
        By rows, impacts at the present time.
    left : dict of int to float
        By rows that impacts have brought to rest at the present time, the time until these would have accumulated [s].
    note : callable or None
        Called behind each impact with the numbers of its events, the state before it and the scratch at it.
    """

    def __init__(self, simulation: Simulation, rows: BoundedRows) -> None:
        self.simulation, self.rows = simulation, rows
        self.latest = dict[int, "Impact"]()
        self.left = dict[int, float]()
        self.note: Callable[[Sequence[int], Array, Array], None] | None = None
        self._entry: Callable[..., int] | None = None
        self._gathering: Callable[..., int] | None = None

    @property
    def _events(self) -> Events:
        events = self.simulation.events
        assert events is not None, "bounded rows have events"
        return events

    @cached_property
    def _strikes(self) -> Any:
        """The impacts as `strike` takes them."""
        watched, state = self._events.watched, self.simulation.state
        work = watched.effects.memory(len(state.y), len(state.w))
        return strikes_of(watched, self.rows, watched.effects, work, self._events.past)

    def strike(self, choice: Any) -> None:
        """Change the velocities of the run by the impact that `symgen.run.modes.strikes.find_struck` has found.

        Parameters
        ----------
        choice : Choice
            The rows with bounds.

        Raises
        ------
        InputError
            If there are no impulses, or joints do not allow the impact.
        """
        state: Any = self.simulation.state  # an `EventState`: there are events
        s, now, effects = self._strikes, float(state.clock[abi.TIME]), self._events.watched.effects
        first = self.simulation.compiled.info.nq
        before, whole = state.y[first : first + len(s.v)].copy(), state.y.copy()
        if self._entry is None:
            arguments = choice, s, state.y, state.p, state.w
            self._entry = direct(compiled_form(strike), STRIKE, 0.0, *arguments)
        code = self._entry(now)
        active = np.flatnonzero(s.active).tolist()
        numbers = [int(s.events[i]) for i in active]
        if code == NOT_APPLIED:
            raise effects.no_velocities(numbers, s.work, before, now)
        if code != SAME:
            names = ", ".join(self.rows.names[i] for i in choice.rest[: choice.at_rest[0]])
            raise InputError(
                self.rows.nouns[self.rows.dry], "impulses that can be found", f"none of {names} at t = {now:.6g} s"
            )
        impact = effects.impact(numbers, s.v, s.impulses, float(s.energy[0]))
        self.latest = dict.fromkeys(active, impact)
        if self.note is not None:
            self.note(numbers, whole, state.w.copy())
        if state.control[abi.BEGUN] != 0:
            self._events.begin_anew(state)
        else:  # the balance of energies begins behind an impact at the start
            state.y[self.simulation.compiled.info.work] = 0.0

    def gather(self, choice: Any) -> bool:
        """Bring gaps to rest where impacts accumulate in the modes behind the latest one; return whether any are.

        Parameters
        ----------
        choice : Choice
            The rows with bounds.

        Raises
        ------
        InputError
            If joints do not allow the rest.
        """
        state: Any = self.simulation.state
        s, now = self._strikes, float(state.clock[abi.TIME])
        if self._gathering is None:
            arguments = choice, s, state.y, state.p, state.w, state.iw, state.hunt
            self._gathering = direct(compiled_form(gather), GATHER, 0.0, *arguments)
        before, whole = s.v.copy(), state.y.copy()
        code = self._gathering(now)
        active = np.flatnonzero(s.active)
        numbers = [int(s.events[i]) for i in active]
        if code == NOT_APPLIED:
            raise self._events.watched.effects.no_velocities(numbers, s.work, before, now)
        if code == OTHERS and self.note is not None:
            w = state.w.copy()  # the formulas of rows that come to rest read their signs
            w[choice.first + MODE_NUMBERS * active + SIGN] = 1.0
            self.note(numbers, whole, w)
        self.left = {int(i): float(s.left[i]) for i in np.flatnonzero(~np.isnan(s.left))}
        return bool(code == OTHERS)


def strikes_of(watched: Watched, rows: BoundedRows, effects: Any, work: Any, past: Any) -> Any:
    """Return the impacts of a run for loops, with the effects of its events, their working memory and past resets."""
    hits = [-1] * rows.dry + [watched.names.index(f"{name}.{HIT}") for name in rows.names[rows.dry :]]
    losses = [-1] * rows.dry + [-1 if place is None else place for place in rows.losses]
    return new_strikes(effects, watched.function, hits, losses, work, past)
