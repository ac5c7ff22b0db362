"""Arcs along a curve, within a tolerance: pairs of arcs that have its tangents, in place of what is no arc."""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable, Iterator, Sequence
from itertools import pairwise

import msgspec

#: Points of a pair of arcs at which its distance from the curve is measured, and how often a curve is halved.
_CHECKED, _HALVINGS = 24, 16
#: Largest turn of a pair of arcs [rad], and that of a corner that a drawing's rounding makes between smooth curves.
_TURN, SMOOTH = 0.5 * math.pi, 1e-2
#: Turn below which two pieces are tangent [rad].
_TANGENT = 1e-10

#: Point and direction of a curve at its parameter.
At = Callable[[float], tuple[complex, complex]]
#: A point, and the bulge of the arc that leads there, 0 of a segment.
Bulged = tuple[complex, float]


class NotSmooth(Exception):
    """No arcs come near to a curve."""


class Stretch(msgspec.Struct, frozen=True):
    """A part of a drawing.

    Parameters
    ----------
    at : callable
        Point and direction of length 1 at a parameter from 0 to 1.
    bulge : float or None
        Of a segment or an arc, which it is exactly.
    """

    at: At
    bulge: float | None = None

    @property
    def start(self) -> complex:
        """The first point."""
        return self.at(0.0)[0]

    @property
    def end(self) -> complex:
        """The last point."""
        return self.at(1.0)[0]

    @property
    def back(self) -> Stretch:
        """The same from its end to its start."""

        def at(x: float) -> tuple[complex, complex]:
            point, along = self.at(1.0 - x)
            return point, -along

        return Stretch(at, None if self.bulge is None else -self.bulge)

    def placed(self, factor: complex, mirrored: bool) -> Stretch:
        """Return the same, mirrored at the first axis or not, times a factor."""

        def at(x: float) -> tuple[complex, complex]:
            point, along = self.at(x)
            if mirrored:
                point, along = point.conjugate(), along.conjugate()
            return factor * point, along * factor / abs(factor)

        return Stretch(at, self.bulge if self.bulge is None or not mirrored else -self.bulge)


def bulged(start: complex, end: complex, bulge: float) -> Stretch:
    """Return the segment or the arc between two points; `bulge` is the tangent of a quarter of its angle."""
    quarter = math.atan(bulge)
    along = (end - start) / abs(end - start)

    def at(x: float) -> tuple[complex, complex]:
        if bulge == 0.0:
            return start + x * (end - start), along
        turned = 2.0 * quarter * x
        chord = math.sin(turned) / math.sin(2.0 * quarter)
        return start + (end - start) * chord * cmath.exp(1j * (turned - 2.0 * quarter)), along * cmath.exp(
            2j * (turned - quarter)
        )

    return Stretch(at, bulge)


def pair_of_arcs(at: At, begin: float, end: float) -> tuple[list[Bulged], float]:
    """Return the two arcs with the tangents at both ends of a part of a curve, and how far they leave it.

    Source: Bolton, K. M.: Biarc curves. Computer-Aided Design 7(2), 1975, 89 to 92.
    """
    (a, ta), (b, tb) = at(begin), at(end)
    chord = b - a
    if chord == 0.0 or abs(cmath.phase(tb / ta)) > _TURN or (chord / ta).real <= 0.0 or (chord / tb).real <= 0.0:
        return [], math.inf
    # equal lengths of the tangents from the ends to the corners: the usual choice
    over = 2.0 * (1.0 - (ta * tb.conjugate()).real)
    along = (chord * (ta + tb).conjugate()).real
    length = abs(chord) ** 2 / (along + math.sqrt(along * along + over * abs(chord) ** 2))
    middle = 0.5 * ((a + length * ta) + (b - length * tb))
    points = [at(begin + (end - begin) * i / _CHECKED)[0] for i in range(1, _CHECKED)]
    arcs, far = list[Bulged](), 0.0
    for start, finish, quarter in (
        (a, middle, 0.5 * cmath.phase((middle - a) / ta)),
        (middle, b, 0.5 * cmath.phase(tb / (b - middle))),
    ):
        arcs.append((finish, math.tan(quarter)))
        far = max(far, _farthest(points, start, finish, quarter))
    return arcs, far


def _farthest(points: Sequence[complex], start: complex, finish: complex, quarter: float) -> float:
    """Return how far points between the ends of an arc leave its circle."""
    way = finish - start
    tangent = way * cmath.exp(-2j * quarter) / abs(way)
    k, far = 2.0 * math.sin(2.0 * quarter) / abs(way), 0.0
    for point in points:
        if 0.0 < ((point - start) * way.conjugate()).real < abs(way) ** 2:
            u = (point - start) / tangent
            height = 2.0 * u.imag - k * abs(u) ** 2
            far = max(far, abs(height) / (1.0 + math.sqrt(max(0.0, 1.0 - k * height))))
    return far


def arcs_along(stretches: Sequence[Stretch], closed: bool, tolerance: float) -> list[Bulged]:
    """Return the points after the first one of a chain, and the bulges that lead there.

    Corners below `SMOOTH`, which rounded numbers of a drawing make where curves are tangent, are smoothed.

    Raises
    ------
    NotSmooth
        If no arcs come within the tolerance.
    """
    first, last = ([x.at(end)[1] for x in stretches] for end in (0.0, 1.0))
    turned = [False] * len(stretches)
    for i in range(0 if closed else 1, len(stretches)):
        if _TANGENT < abs(cmath.phase(first[i] / last[i - 1])) < SMOOTH:
            both = first[i] + last[i - 1]
            first[i] = last[i - 1] = both / abs(both)
            turned[i] = turned[i - 1] = True
    result = list[Bulged]()
    for stretch, begins, ends, other in zip(stretches, first, last, turned, strict=True):
        if stretch.bulge is not None and not other:
            result.append((stretch.end, stretch.bulge))
        else:
            result += _within(_with_ends(stretch.at, begins, ends), 0.0, 1.0, tolerance, _HALVINGS)
    return result


def _with_ends(at: At, first: complex, last: complex) -> At:
    """Return a curve with other directions at its ends."""

    def of(x: float) -> tuple[complex, complex]:
        point, along = at(x)
        return point, first if x == 0.0 else last if x == 1.0 else along

    return of


def _within(at: At, begin: float, end: float, tolerance: float, halvings: int) -> Iterator[Bulged]:
    """Yield arcs that leave a curve by no more than a tolerance."""
    pair, far = pair_of_arcs(at, begin, end)
    if far <= tolerance:
        yield from pair
        return
    if halvings == 0:
        raise NotSmooth
    for a, b in pairwise((begin, 0.5 * (begin + end), end)):
        yield from _within(at, a, b, tolerance, halvings - 1)
