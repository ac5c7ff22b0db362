"""Motions at sampled times, and aims and limits as numbers of them, with derivatives by the numbers that vary."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from itertools import pairwise
from typing import Generic, NamedTuple, Protocol, TypeVar

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
T = TypeVar("T")

#: Fewest intervals of trapezoids that means are extrapolated from.
EXTRAPOLATED = 73


class NoMotion(Exception):
    """Values with which the machine does not move through all times; the text says why."""


class Motions(Protocol):
    """Motions for values of the numbers that vary."""

    def at(self, x: Array, times: Array) -> tuple[Array, Array]:
        """Return quantities at times and their derivatives, shapes (k, quantities), (k, quantities, n).

        Raises
        ------
        NoMotion
            If the motion does not reach all times.
        """

    def screen(self, xs: Array, times: Array) -> list[Array | str]:
        """Return the quantities for rows of values, each shape (k, quantities), or why there are none."""


class Remembering(Generic[T]):
    """A function of arrays that remembers its last value: optimisers ask for values and slopes one after the other.

    Parameters
    ----------
    function : callable
        The function.
    """

    def __init__(self, function: Callable[..., T]) -> None:
        self._function = function
        self._last: tuple[tuple[bytes, ...], T] | None = None

    def __call__(self, *arrays: Array) -> T:
        """Return the value of the function."""
        key = tuple(array.tobytes() for array in arrays)
        if self._last is None or self._last[0] != key:
            self._last = key, self._function(*arrays)
        return self._last[1]


class Taken(NamedTuple):
    """A number of a quantity over time.

    Attributes
    ----------
    word : str
        ``peak``, ``rms``, ``max`` or ``min``; empty for the quantity itself, at every time in a limit and at the end in
        an aim.
    quantity : str
        A column of results, an output, or a formula of such.
    """

    word: str
    quantity: str

    @property
    def text(self) -> str:
        """As it is written."""
        return f"{self.word}({self.quantity})" if self.word else self.quantity


def mean_weights(count: int) -> Array:
    """Return the weights of a mean over even times: trapezoids, and Romberg's rule over many times.

    Trapezoids are best over whole periods, and Romberg's rule else, which takes what trapezoids of two, four and eight
    intervals add to the error as an even polynomial.

    Parameters
    ----------
    count : int
        Number of times, both ends included.
    """
    if count < 2:
        return np.ones(count)
    table = list[Array]()
    for every in (1, 2, 4, 8):
        if every > 1 and ((count - 1) % every or count <= EXTRAPOLATED * every):
            break
        weights = np.zeros(count)
        weights[::every] = every
        weights[[0, -1]] *= 0.5
        table.append(weights / (count - 1))
    for k in range(1, len(table)):
        table = [(4.0**k * fine - coarse) / (4.0**k - 1.0) for fine, coarse in pairwise(table)]
    return table[0]


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

    def mean_square(self, quantity: int, every: int = 1) -> tuple[float, Array]:
        """Return the root mean square of a quantity over the motion, and its derivatives.

        Parameters
        ----------
        quantity : int
            Its place.
        every : int
            1 for all even times, 2 for every second one of them, and so on.
        """
        at = self.even[::every]
        y, dy, weights = self.values[at, quantity], self.slopes[at, quantity], mean_weights(len(at))
        size = float(np.sqrt(max(0.0, weights @ y**2)))
        return size, (weights * y) @ dy / size if size > 0.0 else np.zeros(dy.shape[1])


class Reached(NamedTuple):
    """What a quantity reached, and when [s]; no time for a mean."""

    value: float
    t: float | None


@dataclass(frozen=True)
class Measure:
    """A number of a quantity over time, one side of which counts.

    Attributes
    ----------
    taken : Taken
        What is taken of the quantity.
    quantity : int
        Its place among the quantities of a motion.
    unit : str
        Its unit.
    side : str
        ``largest`` where it is to stay below a bound, ``smallest`` above.
    """

    taken: Taken
    quantity: int
    unit: str
    side: str

    @property
    def sign(self) -> float:
        """1 where less is better, else -1."""
        return 1.0 if self.side == "largest" else -1.0

    @property
    def at_every_time(self) -> bool:
        """Whether all times count; else one is enough, or a mean counts."""
        word = self.taken.word
        return not word or (word in ("peak", "max") and self.sign > 0.0) or (word == "min" and self.sign < 0.0)

    def reached(self, sampled: Sampled) -> Reached:
        """Return what the quantity reached."""
        if self.taken.word == "rms":
            return Reached(sampled.mean_square(self.quantity)[0], None)
        y = sampled.values[:, self.quantity]
        y = np.abs(y) if self.taken.word == "peak" else y
        low = self.taken.word == "min" or (not self.taken.word and self.sign < 0.0)
        k = int(np.argmin(y) if low else np.argmax(y))
        return Reached(float(y[k]), float(sampled.times[k]))

    def numbers(self, sampled: Sampled) -> tuple[Array, Array]:
        """Return the numbers that stay on one side of a bound, with their derivatives: one a time where all count."""
        y, dy = sampled.values[:, self.quantity], sampled.slopes[:, self.quantity]
        if self.taken.word == "rms":
            value, slope = sampled.mean_square(self.quantity)
            return np.array([value]), slope[np.newaxis]
        if self.at_every_time:
            both = self.taken.word == "peak"
            return (np.concatenate([y, -y]), np.concatenate([dy, -dy])) if both else (y, dy)
        reached = self.reached(sampled)
        k = int(np.searchsorted(sampled.times, reached.t or 0.0))
        turned = -1.0 if self.taken.word == "peak" and y[k] < 0.0 else 1.0
        return turned * y[[k]], turned * dy[[k]]


@dataclass(frozen=True)
class Limit(Measure):
    """A limit of a quantity.

    Attributes
    ----------
    bound, size : float
        The limit, and what parts of it are relative to.
    text : str
        What a person wrote.
    of_file : bool
        Whether it is a limit of the file.
    """

    bound: float
    size: float
    text: str
    of_file: bool = False

    def excess(self, value: float) -> float:
        """Return by how much a value is beyond the limit, in parts of its size; 0 within."""
        return max(0.0, self.sign * (value - self.bound) / self.size)

    def rooms(self, sampled: Sampled) -> tuple[Array, Array]:
        """Return the rooms to the limit, in parts of its size, and their derivatives: a row a time where all count."""
        y, dy = self.numbers(sampled)
        return self.sign * (self.bound - y) / self.size, -self.sign * dy / self.size


class Aim(Measure):
    """What is made as small as possible; the least value of a quantity (``min``) as large as possible."""

    @property
    def is_bounded(self) -> bool:
        """Whether it is a bound of the quantity at every time; else it is one number."""
        return self.taken.word in ("peak", "max", "min")

    def reached(self, sampled: Sampled) -> Reached:
        """Return the number that the aim takes; of a quantity without a word, that at the end."""
        if self.taken.word:
            return super().reached(sampled)
        return Reached(float(sampled.values[-1, self.quantity]), float(sampled.times[-1]))

    def score(self, sampled: Sampled) -> float:
        """Return the aim such that less is better."""
        return self.sign * self.reached(sampled).value

    def number(self, sampled: Sampled) -> tuple[float, Array]:
        """Return an aim that is one number, with its derivatives."""
        if self.taken.word == "rms":
            return sampled.mean_square(self.quantity)
        return float(sampled.values[-1, self.quantity]), sampled.slopes[-1, self.quantity]

    def signed(self, sampled: Sampled) -> tuple[Array, Array]:
        """Return the numbers that an aim keeps below a bound, with their derivatives."""
        y, dy = self.numbers(sampled)
        return self.sign * y, self.sign * dy


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
