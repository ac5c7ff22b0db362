"""The band of rests beside an equilibrium: where rows with two bounds hold, with one degree of freedom.

The search finds the equilibrium without such rows. A position beside it is an equilibrium too, as long as the forces
there are within the bounds at rest. The coordinate of a joint with such a row is held at one value after the other. The
band ends where the force that this takes reaches what all bounds together have along the freedom.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import brentq

from symgen.analyses.rest.equilibria import value_of_coordinate
from symgen.analyses.rest.settle import Settled, settle_position
from symgen.analyses.state.one_sided import fault_of_mode
from symgen.analyses.state.subject import Subject
from symgen.base.errors import AnalysisError, plural
from symgen.describe.bounds.bounded_modes import coordinate_of, two_sided_rows
from symgen.describe.formulas.evaluate import evaluate_formula
from symgen.describe.mechanism import Mechanism

Array = NDArray[np.float64]

#: Part of the expected way to an end that the first step takes, factor of the following ones, and the longest, in
#: lengths of the mechanism and radians; ways beyond the last one have no end.
FIRST, GROWING, LONGEST, ENDLESS = 0.25, 1.5, 0.1, 2.0 * math.pi
#: Way over which the slope of the force is taken, and how well an end is known, in the same unit.
SLOPE, EXACT = 1e-4, 1e-13


@dataclass(frozen=True)
class Band:
    """Rests beside an equilibrium.

    Attributes
    ----------
    values : mapping of str to (float, float)
        Coordinate -> its values at both ends; infinite where rows hold on as far as was looked. Empty without
        rows, and where there is no band.
    note : str
        A sentence; empty without rows with two bounds.
    """

    values: Mapping[str, tuple[float, float]]
    note: str


def band_of_rests(mechanism: Mechanism, parameters: Mapping[str, float], rest: Settled) -> Band:
    """Return the band about an equilibrium.

    Parameters
    ----------
    mechanism : Mechanism
        With its rows with bounds.
    parameters : mapping
        Values of all parameters.
    rest : Settled
        An equilibrium without rows with two bounds.
    """
    rows = [row for row in two_sided_rows(mechanism) if not row.signed]
    if not rows:
        return Band({}, "")
    words = rows[0].family
    subject, left_out = rest.subject, f"an equilibrium without {words.noun}, which holds other positions too"
    freedom = subject.split_freedom(subject.rows(subject.evaluate(rest.y)))[0].shape[1]
    if freedom != 1:
        return Band({}, f"{left_out}: no band of them with {plural(freedom, 'degree')} of freedom")
    pressed = ", ".join(row.name for row in rows if row.pressed)
    if pressed:
        return Band({}, f"{left_out}: no band of them, as {words.one} of {pressed} depends on reactions")
    changing = ", ".join(row.name for row in rows if row.changing)
    if changing:
        return Band({}, f"{left_out}: no band of them, as bounds of {changing} are formulas of more than parameters")
    if unequal := ", ".join(row.name for row in rows if row.unequal):
        return Band({}, f"{left_out}: no band of them, as bounds of {unequal} differ in the two directions")
    names = [coordinate_of(mechanism, row) for row in rows]
    bounds = [evaluate_formula(row.numbers[0][1], parameters, f"{row.family.one} of {row.name}") for row in rows]
    rates = np.abs(_rates_of_coordinates(subject, rest.y, names))
    rates /= [subject.length if row.unit == "m" else 1.0 for row in rows]
    if not rates.max() > 0.0:
        return Band({}, f"{left_out}: no band of them, as no joint with {words.one} moves there")
    leading = int(np.argmax(rates))
    search = _Search(names[leading], names, bounds, rest)
    low, high = search.end_of_band(-1.0), search.end_of_band(1.0)
    unit = rows[leading].unit
    parts = [f"from {low:.9g} {unit}" * (low > -math.inf), f"to {high:.9g} {unit}" * (high < math.inf)]
    where = f"with {names[leading]} {' '.join(filter(None, parts))}" if any(parts) else "wherever it stands"
    return Band({names[leading]: (low, high)}, f"{left_out}: it holds {where}")


def _rates_of_coordinates(subject: Subject, y: Array, names: Sequence[str]) -> Array:
    """Return the rates of coordinates along the freedom."""
    e = subject.evaluate(y)
    basis, motion = subject.split_freedom(subject.rows(e))[0], e.by("motion", "v")
    functions = e.by("functions", "q") @ motion
    places = [subject.position(name) for name in names]
    return np.array([float((motion if space == "q" else functions)[at] @ basis[:, 0]) for space, at in places])


@dataclass(frozen=True)
class _Search:
    """The search for the ends of a band.

    Attributes
    ----------
    name : str
        The coordinate that is held.
    names, bounds : sequence of str, of float
        Coordinates with rows, and their bounds.
    rest : Settled
        The equilibrium.
    """

    name: str
    names: Sequence[str]
    bounds: Sequence[float]
    rest: Settled

    @cached_property
    def start(self) -> float:
        return value_of_coordinate(self.rest.subject, self.rest.y, self.name)

    @cached_property
    def unit(self) -> float:
        return self.rest.subject.length if self.rest.subject.unit(self.name) == "m" else 1.0

    def force_beyond_bounds(self, value: float, near: Settled) -> tuple[float, Settled]:
        """Return the force at a value less what rows have; positive also where a one-sided row is in the way."""
        held = settle_position(near.subject, near.y, [(self.name, value)])
        if fault_of_mode(held.subject, held.y, held.lam[: held.subject.m]):
            return 1.0, held
        rates = np.abs(_rates_of_coordinates(held.subject, held.y, [self.name, *self.names]))
        if not rates[0] > 0.0:
            raise AnalysisError(f"{self.name} does not move there")
        return abs(float(held.lam[-1])) - float(np.dot(self.bounds, rates[1:])) / float(rates[0]), held

    def end_of_band(self, way: float) -> float:
        """Return the value at an end of the band; infinite where there is none."""
        near, value = self.rest, self.start
        try:
            now, held = self.force_beyond_bounds(value + way * SLOPE * self.unit, near)
            slope = abs(float(held.lam[-1])) / (SLOPE * self.unit)
            here = -self.force_beyond_bounds(value, near)[0]
            step = min(LONGEST * self.unit, max(FIRST * here / slope, SLOPE * self.unit) if slope > 0.0 else math.inf)
            if now >= 0.0:
                step = SLOPE * self.unit
            while abs(value - self.start) < ENDLESS * self.unit:
                further = value + way * step
                now, held = self.force_beyond_bounds(further, near)
                if now >= 0.0:
                    return self._root_between(value, further, near)
                near, value, step = held, further, min(GROWING * step, LONGEST * self.unit)
        except AnalysisError:  # nothing rests further away
            pass
        return way * math.inf

    def _root_between(self, value: float, further: float, near: Settled) -> float:
        return float(brentq(lambda x: self.force_beyond_bounds(x, near)[0], value, further, xtol=EXACT * self.unit))
