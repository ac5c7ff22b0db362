"""Aims and limits as numbers of a motion at sampled times, with their derivatives by the numbers that vary."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from symgen.study.design.wording import Taken

Array = NDArray[np.float64]


class Sampled(NamedTuple):
    """Quantities of a motion at sampled times.

    Attributes
    ----------
    times : Array, shape (k,)
        Increasing [s].
    values : Array, shape (k, quantities)
        The quantities.
    slopes : Array, shape (k, quantities, n)
        Their derivatives by the numbers that vary, each in parts of its range.
    even : Array of int
        Places of the times that are spaced evenly; others were added where quantities are largest.
    """

    times: Array
    values: Array
    slopes: Array
    even: NDArray[np.int64]

    def mean_square(self, quantity: int) -> tuple[float, Array]:
        """Return the root mean square of a quantity over the even times, and its derivatives."""
        t, y, dy = self.times[self.even], self.values[self.even, quantity], self.slopes[self.even, quantity]
        parts = np.ones(1)
        if len(t) > 1:
            parts = np.gradient(t)
            parts[[0, -1]] *= 0.5
        parts = parts / parts.sum()
        size = float(np.sqrt(parts @ y**2))
        return size, (parts * y) @ dy / size if size > 0.0 else np.zeros(dy.shape[1])


class Reached(NamedTuple):
    """What a quantity reached, and when [s]; no time for a mean."""

    value: float
    t: float | None


def reached_value(taken: Taken, quantity: int, sampled: Sampled, side: str = "largest") -> Reached:
    """Return the number that an aim or a limit takes of a quantity.

    Parameters
    ----------
    taken : Taken
        The word.
    quantity : int
        Place of the quantity.
    sampled : Sampled
        The motion.
    side : str
        Of a limit at every time, which end of it counts.
    """
    if taken.word == "rms":
        return Reached(sampled.mean_square(quantity)[0], None)
    y = sampled.values[:, quantity]
    if taken.word == "peak":
        k = int(np.argmax(np.abs(y)))
        return Reached(float(abs(y[k])), float(sampled.times[k]))
    low = taken.word == "min" or (not taken.word and side == "smallest")
    k = int(np.argmin(y) if low else np.argmax(y))
    return Reached(float(y[k]), float(sampled.times[k]))


def local_minima(rooms: Array, times: int) -> NDArray[np.int64]:
    """Return the places of local minima among rooms of one time after the other, ends included.

    Parameters
    ----------
    rooms : Array
        A number of parts, each with a room a time; or others, which all count.
    times : int
        Number of times.
    """
    if len(rooms) % times:
        return np.arange(len(rooms))
    parts = rooms.reshape(-1, times)
    wide = np.pad(parts, ((0, 0), (1, 1)), constant_values=np.inf)
    return np.flatnonzero((parts <= wide[:, :-2]) & (parts <= wide[:, 2:]))


@dataclass(frozen=True)
class Limit:
    """A limit of a quantity.

    Attributes
    ----------
    taken : Taken
        What is limited: the quantity at every time, or a number of it over time.
    quantity : int
        Place of the quantity.
    side : str
        ``largest`` or ``smallest``.
    bound, size : float
        The limit, and what parts of it are relative to.
    unit, text : str
        Its unit, and what a person wrote.
    of_file : bool
        Whether it is a limit of the file.
    """

    taken: Taken
    quantity: int
    side: str
    bound: float
    size: float
    unit: str
    text: str
    of_file: bool = False

    @property
    def at_every_time(self) -> bool:
        """Whether all times count; else one is enough, or a mean counts."""
        word, largest = self.taken.word, self.side == "largest"
        return not word or (word in ("peak", "max") and largest) or (word == "min" and not largest)

    def reached(self, sampled: Sampled) -> Reached:
        """Return what the quantity reached."""
        return reached_value(self.taken, self.quantity, sampled, self.side)

    def excess(self, value: float) -> float:
        """Return by how much a value is beyond the limit, in parts of its size; 0 within."""
        sign = 1.0 if self.side == "largest" else -1.0
        return max(0.0, sign * (value - self.bound) / self.size)

    def rooms(self, sampled: Sampled) -> tuple[Array, Array]:
        """Return the rooms to the limit, in parts of its size, and their derivatives: a row a time where all count."""
        sign = 1.0 if self.side == "largest" else -1.0
        y, dy = sampled.values[:, self.quantity], sampled.slopes[:, self.quantity]
        if self.taken.word == "rms":
            value, slope = sampled.mean_square(self.quantity)
            y, dy = np.array([value]), slope[np.newaxis]
        elif self.taken.word == "peak":
            k = int(np.argmax(np.abs(y)))
            y, dy = (np.concatenate([y, -y]), np.concatenate([dy, -dy])) if sign > 0.0 else (y[[k]], dy[[k]])
            if sign < 0.0 and y[0] < 0.0:
                y, dy = -y, -dy
        elif not self.at_every_time:
            k = int(np.argmin(y) if self.taken.word == "min" else np.argmax(y))
            y, dy = y[[k]], dy[[k]]
        return sign * (self.bound - y) / self.size, -sign * dy / self.size


@dataclass(frozen=True)
class Aim:
    """What is made as small as possible; the least value of a quantity (``min``) as large as possible.

    Attributes
    ----------
    taken : Taken
        A number of the quantity over time; the quantity at the end without a word.
    quantity : int
        Place of the quantity.
    unit : str
        Its unit.
    """

    taken: Taken
    quantity: int
    unit: str

    @property
    def signs(self) -> tuple[float, ...]:
        """Signs with which the quantity at every time stays below a bound; none where the aim is one number."""
        return {"peak": (1.0, -1.0), "max": (1.0,), "min": (-1.0,)}.get(self.taken.word, ())

    def reached(self, sampled: Sampled) -> Reached:
        """Return the number that the aim takes."""
        if self.taken.word:
            return reached_value(self.taken, self.quantity, sampled)
        return Reached(float(sampled.values[-1, self.quantity]), float(sampled.times[-1]))

    def score(self, value: float) -> float:
        """Return a value such that less of it is better."""
        return -value if self.taken.word == "min" else value

    def number(self, sampled: Sampled) -> tuple[float, Array]:
        """Return an aim that is one number, with its derivatives."""
        if self.taken.word == "rms":
            return sampled.mean_square(self.quantity)
        return float(sampled.values[-1, self.quantity]), sampled.slopes[-1, self.quantity]

    def signed(self, sampled: Sampled) -> tuple[Array, Array]:
        """Return the numbers that an aim keeps below a bound, with their derivatives."""
        y, dy = sampled.values[:, self.quantity], sampled.slopes[:, self.quantity]
        return np.concatenate([s * y for s in self.signs]), np.concatenate([s * dy for s in self.signs])
