"""Directions of what is left out of a series of impacts: it follows from earlier impacts, which have directions, too.

Where impacts accumulate beside other contacts, a rate z changes by ``parts u`` in what is left out, where u is the rate
of the gap that leads (`symgen.run.modes.contact_series`):

    parts = (z - z') / (u' - u) - a (t - t') / (u' - u)

Here t', u' and z' are of an earlier impact, and a is the acceleration at rest. A run remembers the directions of its
impacts as it goes; the way back asks for them, and finds their derivatives before it comes to those impacts.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from symgen.describe.bounds.bounded_modes import HIT
from symgen.describe.formulas.duals import Dual
from symgen.run.directions.push_directions import rows_of_velocities
from symgen.run.effects.pushing import KeptTies
from symgen.run.loops.run_spec import Watched
from symgen.run.modes.contact_series import SAME_MODES
from symgen.run.modes.impact_memory import AT, HEAD, RATE, REMEMBERED

Array = NDArray[np.float64]

#: Part of what is left out to which it is found again, as it was when accelerations were those of a trial; what is no
#: more than rounding, over the rate that remains.
_AGREES, _ROUNDING = 1e-4, 1e-9


@dataclass
class ImpactDirections:
    """Directions of the latest impacts of each event: of the time, then of the rates of all rows after an impact.

    Attributes
    ----------
    latest : dict
        By the number of the event, times of the latest impacts with directions, shape (1 + rows, k).
    """

    latest: dict[int, list[tuple[float, Array]]] = field(default_factory=dict)

    def remember(self, events: Sequence[int], t: float, slopes: Array) -> None:
        """Remember the directions of an impact of events."""
        for event in events:
            impacts = self.latest.setdefault(event, [])
            if impacts and impacts[-1][0] == t:
                impacts.pop()
            impacts.append((t, slopes))
            del impacts[: -REMEMBERED - 1]

    def recall(self, event: int, t: float, shape: tuple[int, int]) -> Array | None:
        """Return the directions of an impact of an event, of a shape; None where it is not remembered."""
        return next((slopes for at, slopes in self.latest.get(event, []) if at == t), None)


@dataclass
class ImpactsAhead(ImpactDirections):
    """Impacts on the way back that it has yet to come to.

    Attributes
    ----------
    shapes : dict
        By event and time, the shapes of the directions of impacts ahead.
    units : dict
        Directions of impacts in place of zero.
    bars : dict
        Derivatives of the number at the end by time and rates of impacts ahead, shape (1 + rows,).
    """

    shapes: dict[tuple[int, float], tuple[int, int]] = field(default_factory=dict)
    units: dict[tuple[int, float], Array] = field(default_factory=dict)
    bars: dict[tuple[int, float], Array] = field(default_factory=dict)

    def recall(self, event: int, t: float, shape: tuple[int, int]) -> Array:
        """Return the directions of an impact that is ahead, zero unless they are given."""
        self.shapes[event, t] = shape
        return self.units.get((event, t), np.zeros(shape))

    def derivatives_here(self, count: int) -> Array:
        """Return the derivatives by `count` directions, through the impacts of the present passage alone."""
        total = np.zeros(count)
        for event, t in list(self.bars):
            slopes = super().recall(event, t, (0, 0))
            if slopes is not None:
                total += self.bars.pop((event, t)) @ slopes
        return total

    def units_of_impacts(
        self, count: int, columns: Sequence[int]
    ) -> Iterator[list[tuple[tuple[int, float], int, int]]]:
        """Give units to the impacts ahead, as many at once as there are columns for them.

        Yields impact, row and column of each unit; the passage is forgotten after the last ones.
        """
        shapes = dict(self.shapes)
        wanted = [(impact, row) for impact, (rows, _) in shapes.items() for row in range(rows)]
        for first in range(0, len(wanted), len(columns)):
            self.units = {impact: np.zeros((rows, count)) for impact, (rows, _) in shapes.items()}
            units = [(*unit, column) for unit, column in zip(wanted[first:], columns, strict=False)]
            for impact, row, column in units:
                self.units[impact][row, column] = 1.0
            yield units
        for memory in (self.shapes, self.units, self.latest):
            memory.clear()

    def add(self, units: Sequence[tuple[tuple[int, float], int, int]], slopes: Array) -> None:
        """Add the derivatives by units, of which `slopes` has one a column."""
        for impact, row, column in units:
            rows, _ = self.shapes[impact]
            self.bars.setdefault(impact, np.zeros(rows))[row] += slopes[column]


def slopes_left_over(now: Dual, u: Dual, earlier: Sequence[tuple[Dual, Dual]]) -> Dual:
    """Return how a number changes in what is left out over the rate u, from two spans as runs do, see `contact_series`.

    Parameters
    ----------
    now, u : Dual
        The number, and the rate of the gap that leads, after the latest impact.
    earlier : sequence of (Dual, Dual)
        The same after earlier impacts, the later one first.
    """
    one, two = ((now - number) / (rate - u) for number, rate in earlier)
    return two if abs(two.value - one.value) <= SAME_MODES * abs(one.value) else one


def _dual(value: float, slopes: Array) -> Dual:
    return Dual(float(value), tuple(slopes))


class SeriesDirections:
    """Directions of the parts of rates that are left out of a series of impacts.

    Parameters
    ----------
    watched : Watched
        Switching functions of the run.
    kept : KeptTies
        Of the impulses that bring to rest.
    impacts : ImpactDirections
        Directions of earlier impacts.
    """

    def __init__(self, watched: Watched, kept: KeptTies, impacts: ImpactDirections) -> None:
        rows, series = watched.bounded, kept.series
        assert rows is not None and series is not None, "a series of impacts of contacts"
        self.k, self.leads, self.parts, self.impacts = len(rows.names), kept.leads.tolist(), kept.parts, impacts
        self.memory, self.rates, self.rests = series
        self.hits, self.along = watched.events_of_rows(HIT, self.k), rows_of_velocities(watched)
        assert watched.effects is not None, "a run with impacts"
        self.owners = watched.effects.changes.owners.tolist()

    def slopes(self, t: float, later: Array, rates: Array, accelerations: tuple[Array, Array] | None) -> Array | None:
        """Return the directions of the parts, shape (velocities, k); None where they do not follow from impacts.

        Parameters
        ----------
        t : float
            Time of the latest impact.
        later : Array, shape (k,)
            Directions of the time.
        rates : Array, shape (rows, k)
            Directions of the rates after it.
        accelerations : (Array, Array) or None
            Those at rest and their directions, None while these are not known.
        """
        parts, now = np.zeros((len(self.leads), len(later))), _dual(t, later)
        rests, by_rests = (self.rests, np.zeros_like(rates)) if accelerations is None else accelerations
        for j, lead in enumerate(self.leads):
            if lead < 0:
                continue
            gap, size = self.hits.index(self.owners[lead]), HEAD + self.k
            row = self.along[j] if self.along[j] >= 0 else self.hits.index(self.owners[j])
            times, numbers = list[tuple[Dual, Dual]](), list[tuple[Dual, Dual]]()
            for past in range(REMEMBERED):
                line = self.memory[(REMEMBERED * gap + past) * size :][:size]
                slopes = self.impacts.recall(self.hits[gap], float(line[AT]), (1 + self.k, len(later)))
                if slopes is None or not line[RATE] > self.rates[gap] > 0.0:
                    return None
                u = _dual(line[RATE], slopes[1 + gap])
                times.append((_dual(line[AT], slopes[0]), u))
                numbers.append((_dual(line[HEAD + row], slopes[1 + row]), u))
            u = _dual(self.rates[gap], rates[gap])
            by_rest = _dual(rests[row], by_rests[row]) * slopes_left_over(now, u, times)
            part = -by_rest
            if self.along[j] >= 0:
                z = _dual(self.rates[row], rates[row])
                # its sum by earlier impacts, or its own end where it ends with the series, as the run has taken it
                forms = part + slopes_left_over(z, u, numbers), part - z / u
                part = min(forms, key=lambda form: abs(form.value - self.parts[j]))
            if not abs(part.value - self.parts[j]) <= _AGREES * (abs(part.value) + abs(by_rest.value)) + _ROUNDING:
                return None
            parts[j] = part.slopes
        return parts
