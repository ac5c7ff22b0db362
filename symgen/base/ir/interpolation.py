"""Functions by interpolation: straight lines, or cubic pieces with smooth joins."""

from __future__ import annotations

import bisect
import math
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

#: Coefficients c of a piece: c0 + c1 u + c2 u^2 + c3 u^3, u being the distance from its beginning.
Piece = tuple[float, float, float, float]


@dataclass(frozen=True)
class Interpolation:
    """A function of one argument through given points.

    Parameters
    ----------
    name : str
        A checked identifier.
    x, y : tuple of float
        The points, `x` increasing.
    pieces : tuple of Piece
        Empty for straight lines, which are constant beyond their ends. Else the straight piece that ends at the first
        point, the cubic ones between points, and the straight one that begins at the last point.
    period : float
        Period; 0 if it is not periodic.
    """

    name: str
    x: tuple[float, ...]
    y: tuple[float, ...]
    pieces: tuple[Piece, ...] = ()
    period: float = 0.0

    @property
    def starts(self) -> tuple[float, ...]:
        """Beginnings of pieces, from which the distance u is counted; the first piece ends at the first point.

        The last piece begins after the last point, which so has the derivatives of the curve before it.
        """
        return (self.x[0], *self.x[:-1], math.nextafter(self.x[-1], math.inf))

    @property
    def numbers(self) -> int:
        """Number of stored numbers for its evaluation."""
        return 5 * len(self.pieces) if self.pieces else 2 * len(self.x)

    def value(self, x: float, order: int = 0) -> float:
        """Return the function at `x`, or its derivative of an order up to 3."""
        if self.period:
            x -= self.period * math.floor((x - self.x[0]) / self.period)
        if self.pieces:
            starts = self.starts
            i = bisect.bisect_right(starts, x, lo=1) - 1
            (c0, c1, c2, c3), u = self.pieces[i], x - starts[i]
            if order == 0:
                return c0 + u * (c1 + u * (c2 + u * c3))
            if order == 1:
                return c1 + u * (2.0 * c2 + u * (3.0 * c3))
            return 2.0 * c2 + u * (6.0 * c3) if order == 2 else 6.0 * c3
        if x <= self.x[0] or x >= self.x[-1]:
            return 0.0 if order else self.y[0] if x <= self.x[0] else self.y[-1]
        i = bisect.bisect_right(self.x, x)
        x0, x1, y0, y1 = self.x[i - 1], self.x[i], self.y[i - 1], self.y[i]
        return (y0 + (y1 - y0) * (x - x0) / (x1 - x0), (y1 - y0) / (x1 - x0), 0.0, 0.0)[order]


def cubic_slopes(x: Sequence[float], y: Sequence[float]) -> list[float]:
    """Return the slopes at the points of the cubic spline whose first two and last two pieces are one polynomial each.

    Parameters
    ----------
    x, y : sequence of float
        Four points or more.
    """
    h, d = _chord_lengths_and_slopes(x, y)
    n = len(x)
    low, diagonal, high, right = _spline_equations(h, d)
    first, last = x[2] - x[0], x[-1] - x[-3]
    diagonal[0], high[0] = h[1], first
    right[0] = ((h[0] + 2.0 * first) * h[1] * d[0] + h[0] ** 2 * d[1]) / first
    diagonal[n - 1], low[n - 1] = h[-2], last
    right[n - 1] = (h[-1] ** 2 * d[-2] + (2.0 * last + h[-1]) * h[-2] * d[-1]) / last
    return _solve_tridiagonal(low, diagonal, high, right)


def periodic_slopes(x: Sequence[float], y: Sequence[float]) -> list[float]:
    """Return the slopes at the points of the cubic spline that is smooth from its end to its beginning.

    Parameters
    ----------
    x, y : sequence of float
        Four points or more, the last value being the first.
    """
    h, d = _chord_lengths_and_slopes(x, y)
    h, d = [h[-1], *h], [d[-1], *d]  # the piece before each point
    low, diagonal, high, right = (row[1:-1] for row in _spline_equations(h, d))
    # the corners of the matrix are a product of vectors (Sherman and Morrison)
    corner, other, shift = low[0], high[-1], -diagonal[0]
    diagonal[0] -= shift
    diagonal[-1] -= corner * other / shift
    vector = [0.0] * len(right)
    vector[0], vector[-1] = shift, other
    plain, along = (_solve_tridiagonal(low, diagonal, high, b) for b in (right, vector))
    factor = (plain[0] + corner / shift * plain[-1]) / (1.0 + along[0] + corner / shift * along[-1])
    slopes = [a - factor * b for a, b in zip(plain, along, strict=True)]
    return [*slopes, slopes[0]]


def pchip_slopes(x: Sequence[float], y: Sequence[float], periodic: bool = False) -> list[float]:
    """Return slopes with which no piece leaves the range of its ends (Fritsch and Butland 1984).

    Parameters
    ----------
    x, y : sequence of float
        Two points or more.
    periodic : bool
        Whether the function continues from its end to its beginning.
    """
    h, d = _chord_lengths_and_slopes(x, y)
    if len(x) == 2 and not periodic:
        return [d[0], d[0]]
    inner = [_slope_between_chords(h[i - 1], h[i], d[i - 1], d[i]) for i in range(1, len(h))]
    if periodic:
        ends = (_slope_between_chords(h[-1], h[0], d[-1], d[0]),) * 2
    else:
        ends = _slope_at_end(h[0], h[1], d[0], d[1]), _slope_at_end(h[-1], h[-2], d[-1], d[-2])
    return [ends[0], *inner, ends[1]]


def cubic_pieces(x: Sequence[float], y: Sequence[float], slopes: Sequence[float]) -> tuple[Piece, ...]:
    """Return the pieces with given slopes at the points; beyond the ends they are straight."""
    h, d = _chord_lengths_and_slopes(x, y)
    pieces = [(y[0], slopes[0], 0.0, 0.0)]
    for i in range(len(h)):
        third = (slopes[i] + slopes[i + 1] - 2.0 * d[i]) / h[i] ** 2
        pieces.append((y[i], slopes[i], (d[i] - slopes[i]) / h[i] - third * h[i], third))
    return (*pieces, (y[-1], slopes[-1], 0.0, 0.0))


def _chord_lengths_and_slopes(x: Sequence[float], y: Sequence[float]) -> tuple[list[float], list[float]]:
    """Return lengths and slopes of the straight lines between points."""
    h = [b - a for a, b in pairwise(x)]
    return h, [(b - a) / length for (a, b), length in zip(pairwise(y), h, strict=True)]


def _spline_equations(
    h: Sequence[float], d: Sequence[float]
) -> tuple[list[float], list[float], list[float], list[float]]:
    """Return the equations of continuous second derivatives at the inner points: three diagonals and the right side."""
    inner = range(1, len(h))
    low = [0.0, *(h[i] for i in inner), 0.0]
    diagonal = [0.0, *(2.0 * (h[i - 1] + h[i]) for i in inner), 0.0]
    high = [0.0, *(h[i - 1] for i in inner), 0.0]
    right = [0.0, *(3.0 * (h[i] * d[i - 1] + h[i - 1] * d[i]) for i in inner), 0.0]
    return low, diagonal, high, right


def _solve_tridiagonal(
    low: Sequence[float], diagonal: Sequence[float], high: Sequence[float], right: Sequence[float]
) -> list[float]:
    """Return the solution of a system whose matrix has three diagonals."""
    pivots, solution = list(diagonal), list(right)
    for i in range(1, len(solution)):
        factor = low[i] / pivots[i - 1]
        pivots[i] -= factor * high[i - 1]
        solution[i] -= factor * solution[i - 1]
    solution[-1] /= pivots[-1]
    for i in range(len(solution) - 2, -1, -1):
        solution[i] = (solution[i] - high[i] * solution[i + 1]) / pivots[i]
    return solution


def _slope_between_chords(h0: float, h1: float, d0: float, d1: float) -> float:
    """Return the slope between two lines: 0 at a peak, else a weighted harmonic mean."""
    if d0 == 0.0 or d1 == 0.0 or (d0 > 0.0) != (d1 > 0.0):
        return 0.0
    w0, w1 = 2.0 * h1 + h0, h1 + 2.0 * h0
    return (w0 + w1) / (w0 / d0 + w1 / d1)


def _slope_at_end(h0: float, h1: float, d0: float, d1: float) -> float:
    """Return the slope at an end: of the parabola through three points, within the limit that keeps the range."""
    slope = ((2.0 * h0 + h1) * d0 - h0 * d1) / (h0 + h1)
    if slope * d0 <= 0.0:
        return 0.0
    return 3.0 * d0 if d0 * d1 <= 0.0 and abs(slope) > 3.0 * abs(d0) else slope
