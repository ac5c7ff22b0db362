"""Rows whose formulas jump or have kinks over the state, examined where a run passes such a place.

The state goes on in a straight line from the beginning of the step, with its velocities from before a correction. On
this line a formula has the rate that its row has in the motion, on either side of the place.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property, partial
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from symgen.run.breaks.refused_motions import NEAR, jump_at_time
from symgen.run.layout import abi
from symgen.run.loops.event_loop import EventState, beginning_of

if TYPE_CHECKING:
    from symgen.describe.facts.kinks import ChangingRow
    from symgen.run.layout.compiled import CompiledModel

Array = NDArray[np.float64]

#: Places on the line where switches are evaluated first, bisections of one, and their distance from the next place in
#: units of that of evaluations.
_LOOKS, _BISECTIONS, _APART = 32, 60, 8.0
#: The part of the line that is searched, in units of the step, and at least as a part of the run.
_AHEAD, _LEAST = 2.0, 1e-6


@dataclass(frozen=True)
class RowJumps:
    """Rows of a run whose formulas may jump or have kinks over the state.

    Attributes
    ----------
    rows : tuple of ChangingRow
        The rows.
    values : callable
        Their switches, row by row, then their formulas, at a state: a function of (t, y, p, w, ydot).
    until : float
        End of the run [s].
    """

    rows: tuple[ChangingRow, ...]
    values: Callable[[float, Array, Array, Array, Array], Array]
    until: float = 1.0

    @cached_property
    def _switches(self) -> int:
        return sum(len(row.switches) for row in self.rows)

    def sentence(self, compiled: CompiledModel, state: EventState) -> str:
        """Return the sentence on the row that jumps or has a kink in the last step of a run; empty without one.

        Parameters
        ----------
        compiled : CompiledModel
            Model and method.
        state : EventState
            State of the run.
        """
        from symgen.run.layout.probe import rate_function

        began, y, w = beginning_of(state.hunt, len(state.y), len(state.w))
        rate, step = np.zeros(len(y)), float(state.clock[abi.TIME]) - began
        with np.errstate(all="ignore"):
            rate_function(compiled)(began, y, state.p, w.copy(), state.iw.copy(), rate)

        def at(s: float) -> Array:
            return self.values(began + s, y + s * rate, state.p, w, rate)

        reach = max(_AHEAD * step, _LEAST * self.until, float(state.w[abi.STEP_STATUS]))
        scales = max(float(w[abi.LENGTH]), 1e-300), float(w[abi.SPEED])
        places = self._places(at, reach)
        for place, gap in places:
            h = min(NEAR * self.until, gap / _APART)
            for i, row in enumerate(self.rows):
                f = partial(_entry, at, self._switches + i)
                kind, size = jump_at_time(f, place, h, (place - h, place + h), row.is_speed, scales)
                if kind:
                    unit = row.unit if kind == "value" else f"{row.unit}/s"
                    return (
                        f"row {row.name} jumps: its {kind} changes by {size:.6g} {unit} at t = {began + place:.6g} s, "
                        "which would take an impulse; a formula whose value and rate are continuous takes forces"
                    )
        return ""

    def _places(self, at: Callable[[float], Array], reach: float) -> list[tuple[float, float]]:
        """Return where switches pass 0 on the line, in order [s], and the distance of each from its neighbours."""
        low = -0.5 * _LEAST * self.until
        grid = np.linspace(low, reach, _LOOKS)
        table = np.array([at(s)[: self._switches] for s in grid])
        places = list[float]()
        for k in range(self._switches):
            for (a, before), (b, after) in pairwise(zip(grid, table[:, k], strict=True)):
                if (before < 0.0) == (after < 0.0) or not np.isfinite(before + after):
                    continue
                below, left, right = before < 0.0, float(a), float(b)
                for _ in range(_BISECTIONS):
                    middle = 0.5 * (left + right)
                    left, right = (middle, right) if (at(middle)[k] < 0.0) == below else (left, middle)
                places.append(right)
        places.sort()
        apart = 1e-3 * NEAR * self.until
        places = [s for i, s in enumerate(places) if i == 0 or s - places[i - 1] > apart]
        gaps = [b - a for a, b in pairwise(places)]
        return [(s, min(gaps[max(i - 1, 0) : i + 1], default=math.inf)) for i, s in enumerate(places)]


def _entry(at: Callable[[float], Array], i: int, s: float) -> float:
    return float(at(s)[i])
