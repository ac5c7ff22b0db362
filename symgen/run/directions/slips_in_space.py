"""Slip of contacts in space in runs with directions: steps that are short before it ends, and when it ends.

Its force turns with the direction of slip u, ``d(u / |u|) = (1 - e e^T) / |u| du``: the part of du across u decays as a
power of the time that is left, at a rate that grows beyond all bounds. Steps of a run do not see that, as its direction
stays; directions need steps as short as that time. Where slip ends, its velocity is 0 and has no direction:
the event is where the component along the last one is 0, and what is left across is taken off by an impulse.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from symgen.base.ir.program import MODE_NUMBERS
from symgen.describe.bounds.bounded_modes import REVERSE
from symgen.run.directions.moments import Directions, Moment, Moments, modes_of_moment
from symgen.run.layout import abi
from symgen.run.modes.bounded_rows import EFFORT, HELD, LIMIT, SIGN

if TYPE_CHECKING:
    from symgen.run.loops.run_spec import Watched

Array = NDArray[np.float64]

#: Longest step over the time in which slip turns; where this part of the scale of speeds is left, slip ends.
_PART, _SLOW = 0.25, 1e-6
#: The same where slip begins, so that its turning is stable and resolved.
_BEGINS = 1.0
#: Slip out of rest begins up to this many times the velocity that leads it.
_LED = 1e3


class SlipsInSpace:
    """Contacts that slide at an instant, by both of their rows.

    Parameters
    ----------
    moments : Moments
        The code; the last direction is the motion.
    watched : Watched
        Switching functions of the run, whose contacts have two rows.
    """

    def __init__(self, moments: Moments, watched: Watched) -> None:
        assert watched.bounded is not None, "a run with contacts"
        self.moments, self.watched, self.rows = moments, watched, watched.bounded
        self._own = [moments.compiled.info.switchable.index(row) for row in moments.compiled.info.bounded]

    def ways(self, w: Array) -> dict[int, Array]:
        """Return the last direction of slip by the first row of each contact that slides."""
        numbers = modes_of_moment(self.moments.compiled, w[self.moments.place_of_modes()])[self._own, SIGN]
        return {i - 1: numbers[i - 1 : i + 1] for i in self.rows.seconds if numbers[i] != 0.0}

    def begins(self, now: Moment) -> bool:
        """Whether a contact slips so slowly out of rest that stability alone decides on steps."""
        numbers = modes_of_moment(self.moments.compiled, now.w[self.moments.place_of_modes()])[self._own]
        led = [i for i in self.ways(now.w) if numbers[i, LIMIT] > 0.0]
        if not led:
            return False
        speeds = self._speeds(now)
        return any(float(np.hypot(*speeds[i : i + 2])) < _LED * numbers[i, LIMIT] for i in led)

    def longest_step(self, now: Moment) -> float:
        """Return the longest step from a state, by the rate at which slip turns: its force over its velocity."""
        ways = self.ways(now.w)
        if not ways:
            return math.inf
        part = _BEGINS if self.begins(now) else _PART
        without, place = now.w.copy(), self.moments.place_of_modes()
        numbers = modes_of_moment(self.moments.compiled, without[place])
        leads = numbers[self._own, LIMIT]
        for i in ways:
            numbers[[self._own[i], self._own[i + 1]], SIGN] = 0.0
        speeds, changes = self._speeds(now), self._accelerations(now)
        changes -= self._accelerations(now._replace(w=without))
        longest = math.inf
        for i in ways:
            speed, change = (float(np.hypot(*x[i : i + 2])) for x in (speeds, changes))
            slow = speed <= _SLOW * self._scale(i, now.w)
            if change > 0.0 and (part == _BEGINS or not slow):
                longest = min(longest, part * (speed + leads[i]) / change)
        return longest

    def _accelerations(self, now: Moment) -> Array:
        """Return the rates of rates of all rows with bounds."""
        rate, w = self.moments.rates_and_scratch(now)
        return self.rows.accelerations(now.t, now.y.copy(), now.p.copy(), w, rate).copy()

    def _scale(self, i: int, w: Array) -> float:
        """Return the scale of speeds of a row."""
        info = self.moments.compiled.info
        turns = info.rows[info.bounded[i]].unit.startswith("rad")
        return float(w[abi.SPEED] / (w[abi.LENGTH] if turns else 1.0))

    def turned(self, w: Array) -> dict[int, tuple[int, Array]]:
        """Return first row and direction by the events at which slip of contacts is 0 or has turned."""
        events = self.watched.events_of_rows(REVERSE, len(self.rows.names))
        return {events[i]: (i, way) for i, way in self.ways(w).items()}

    def going_on(self, before: Moment, after: Moment) -> set[int]:
        """Return the events at which slip has only turned: the contact slides on as before."""
        left = self.ways(after.w)
        return {event for event, (i, _) in self.turned(before.w).items() if i in left}

    def along(self, i: int, way: Array, now: Moment, by: Directions) -> Array:
        """Return the directions of the velocity of slip along a direction, shape (k,)."""
        return np.asarray(way @ self._slopes(now, by)[i : i + 2])

    def ended(self, before: Moment, after: Moment) -> list[int]:
        """Return the first rows of contacts that stay closed and come to rest."""
        left = self.ways(after.w)
        numbers = modes_of_moment(self.moments.compiled, after.w[self.moments.place_of_modes()])[self._own, HELD]
        return [i for i in self.ways(before.w) if i not in left and numbers[self.rows.partners[i]] != 0.0]

    def bring_to_rest(self, before: Moment, after: Moment, by: Directions) -> Array:
        """Return directions of the state after impulses along contacts that come to rest, which have no slip then."""
        info, ends = self.moments.compiled.info, self.ended(before, after)
        if not ends:
            return by.y
        rows, at, base = [j for i in ends for j in (i, i + 1)], slice(info.nq, info.work), self.moments.rates(before)
        first, pushed, gained = self.moments.place_of_modes().start, list[Array](), list[Array]()
        for j in rows:
            w, y = before.w.copy(), before.y.copy()
            w[first + MODE_NUMBERS * self._own[j] + EFFORT] += 1.0
            pushed.append(self.moments.rates(before._replace(w=w))[at] - base[at])
            y[at] += pushed[-1]
            gained.append((self._speeds(before._replace(y=y)) - self._speeds(before))[rows])
        impulses = np.linalg.lstsq(np.array(gained).T, self._slopes(before, by)[rows], rcond=1e-11)[0]
        y = by.y.copy()
        y[at] -= np.array(pushed).T @ impulses
        return y

    def _speeds(self, now: Moment) -> Array:
        """Return the rates of all rows with bounds."""
        count, still = len(self.rows.names), np.zeros_like(now.y)
        return self.rows.state(now.t, now.y.copy(), now.p.copy(), now.w.copy(), still)[count : 2 * count]

    def _slopes(self, now: Moment, by: Directions) -> Array:
        """Return the directions of the rates of all rows with bounds."""
        count = len(self.rows.names)
        return self.moments.evaluate_moment(self.rows.state.function, self.rows.values, now, by)[1][count : 2 * count]
