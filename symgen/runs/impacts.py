"""Impacts of stops: Newton's law through all rows of joints, in the metric of M.

At an impact the rate u of each gap that is 0 satisfies ``u+ + e min(u-, 0) >= 0`` with a restitution e, its impulse
only pushes, and one of both is zero: the box problem (`symgen.runs.box`) on rates instead of accelerations. Dry
friction has bounds and therefore no impulse. Where impacts follow each other ever faster, so that the time until they
accumulate counts as zero, the stop is at rest.
"""

from __future__ import annotations

from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from symgen.base.errors import InputError
from symgen.describe.stops import HIT
from symgen.layout import abi
from symgen.loopcode.exact import compiled_form
from symgen.runs.box import new_box, solve_box

if TYPE_CHECKING:
    from collections.abc import Sequence

    from symgen.effects.effects import Impact
    from symgen.loops.run_spec import BoundedRows
    from symgen.runs.events import Events
    from symgen.runs.simulation import Simulation

Array = NDArray[np.float64]

#: Impulses below this part of the largest are rounding.
_NOTHING = 1e-12


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
    """

    def __init__(self, simulation: Simulation, rows: BoundedRows) -> None:
        self.simulation, self.rows = simulation, rows
        self.latest = dict[int, "Impact"]()
        self.left = dict[int, float]()
        self._ends = dict[int, list[float]]()  # by rows, the end of the series of flights as it follows at each impact

    @property
    def _events(self) -> Events:
        events = self.simulation.events
        assert events is not None, "stops have events"
        return events

    def strike(
        self, touching: Sequence[int], rate: Array, restitution: Array, pull: Array, matrix: Array, modes: Array
    ) -> None:
        """Change the velocities of the run by an impact.

        Parameters
        ----------
        touching : sequence of int
            Rows whose gaps are 0.
        rate, restitution, pull : Array
            Of these; `pull` are their accelerations without impulses.
        matrix : Array
            Change of their rates by impulses along them.
        modes : Array
            View of the modes of all rows with bounds, all of which are off.
        """
        state = self.simulation.state
        k, now = len(touching), float(state.clock[abi.TIME])
        box = new_box(k)
        box.matrix[:], box.offset[:] = matrix.ravel(), rate + restitution * np.minimum(rate, 0.0)
        box.lower[:] = -np.inf
        if compiled_form(solve_box)(k, box) != 0:
            names = ", ".join(self.rows.names[i] for i in touching)
            raise InputError("stops", "impulses that can be found", f"none of {names} at t = {now:.6g} s")
        active = [i for i, c in zip(touching, box.forces, strict=True) if -c > _NOTHING * np.abs(box.forces).max()]
        watched = self._events.watched
        numbers = [watched.names.index(f"{self.rows.names[i]}.{HIT}") for i in active]
        impact = watched.effects.apply(numbers, now, state.y, state.p, state.w)
        before = rate[[touching.index(i) for i in active]]
        after = -restitution[[touching.index(i) for i in active]] * np.minimum(before, 0.0)
        self._lose(active, impact, before + after)
        self.latest = dict.fromkeys(active, impact)
        hit = [n for i, n in zip(active, numbers, strict=True) if rate[touching.index(i)] < 0.0]
        end = self._events.end_of_resets(hit, state)
        self._ends = {i: ends for i, ends in self._ends.items() if active == [i]}
        first = touching.index(active[0])
        e, pulled = float(restitution[first]), pull[first] < 0.0 and restitution[first] < 1.0
        if len(active) == 1 and pulled:  # the series of flights to and fro
            ends = self._ends.setdefault(active[0], [])
            ends.append(now + 2.0 * e * float(rate[first] / pull[first]) / (1.0 - e))
            end = end if end is None else best_end(ends, e)
        self.left = {}
        if end is not None:
            modes[active, 2] = 1.0
            self._lose(active, watched.effects.apply(numbers, now, state.y, state.p, state.w), after)
            modes[active, 2] = 0.0
            self._events.forget_resets(hit)
            self.left = dict.fromkeys(active, max(end - now, 0.0))
            self._ends.clear()
        self._events.begin_anew(state)

    def _lose(self, active: Sequence[int], impact: Impact, rates: Array) -> None:
        """Add what an impact takes to the losses of its stops, by the sums of their rates before and after it."""
        y, impulses = self.simulation.state.y, impact.impulses[len(impact.impulses) - len(active) :]
        for i, impulse, rate in zip(active, impulses, rates, strict=True):
            if (place := self.rows.losses[i - self.rows.dry]) is not None:
                y[place] -= 0.5 * float(impulse * rate)


def best_end(ends: Sequence[float], restitution: float) -> float:
    """Return the time at which flights end, from the times that follow at each impact from the rate and its change.

    Their errors fall with the square of the duration of a flight, of which the next one takes a part `restitution`; the
    errors by rounding grow as flights become shorter. The time that changes least is taken.
    """
    part = restitution**2
    better = [(b - part * a) / (1.0 - part) for a, b in pairwise(ends)]
    steps = [abs(b - a) for a, b in pairwise(better)]
    return better[steps.index(min(steps)) + 1] if steps else ends[-1]
