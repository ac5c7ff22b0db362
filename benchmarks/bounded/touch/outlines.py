"""Random scenes of discs and polygons on outlines, whose gaps are those of the nearest point of a chain.

A chain has features: segments, arcs and corners. A place belongs to a feature between the normals at its ends, and what
is closed stays on its feature up to them.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import Any

import numpy as np

from benchmarks.bounded.touch.bodies import GROUND, Array, Complex, Surface, Touching, point_of, turned
from benchmarks.bounded.touch.scenes import Draft

#: Turn that is no corner [rad], part of a segment by which it goes on under what follows a hollow corner, way beyond
#: the ends of a feature that is rounding, and way from them within which corners pass each other [m].
_TANGENT, _BEYOND, _NEAR, _PASSES = 1e-9, 0.1, 1e-12, 1e-7
#: Gap of a corner beside no segment [m].
_FAR = 10.0


@dataclass(frozen=True)
class Feature:
    """A segment, an arc or a corner, and the directions along it at its ends, 0 where it goes on.

    An arc has a centre and a radius, below 0 where it is hollow. The radius of a corner is 0, that of a segment None.
    """

    start: complex
    end: complex
    first: complex
    last: complex
    centre: complex = 0.0
    radius: float | None = None

    def ways(self, place: complex) -> tuple[float, float]:
        """Return how far a place is from the normals at both ends, above 0 within."""
        return _dot(place - self.start, self.first), _dot(self.end - place, self.last)

    def far(self, place: complex) -> float:
        """Return the gap of a place."""
        if self.radius is None:
            return ((place - self.start) * self.first.conjugate()).imag
        return (-1.0 if self.radius < 0.0 else 1.0) * abs(place - self.centre) - self.radius

    def look(self, x: Any, y: Any) -> tuple[Any, Any, Any]:
        """Return the gap of a place, and the direction away from the feature."""
        if self.radius is None:
            nx, ny = -self.first.imag, self.first.real
            return nx * (x - self.start.real) + ny * (y - self.start.imag), nx, ny
        x, y = x - self.centre.real, y - self.centre.imag
        far, sign = np.sqrt(x * x + y * y), -1.0 if self.radius < 0.0 else 1.0
        return sign * far - self.radius, sign * x / far, sign * y / far


def _dot(a: complex, b: complex) -> float:
    return (a * b.conjugate()).real


def _piece(start: complex, end: complex, bulge: float) -> Feature:
    """Return a segment, or the arc of a bulge as in DXF files."""
    chord, half = (end - start) / abs(end - start), 2.0 * math.atan(bulge)
    if bulge == 0.0:
        return Feature(start, end, chord, chord)
    turn = complex(math.cos(half), math.sin(half))
    first, last, radius = chord / turn, chord * turn, -0.5 * abs(end - start) / math.sin(half)
    return Feature(start, end, first, last, start - 1j * first * radius, radius)


def chains_of(points: Sequence[complex], bulges: Sequence[float], closed: bool) -> list[tuple[Feature, ...]]:
    """Return the features between hollow corners; of a closed chain, which has none, all from a corner on."""
    pieces = [_piece(points[i - 1], points[i], bulges[i]) for i in range(0 if closed else 1, len(points))]
    if closed:
        found = [
            (_corner(before, after), after) for before, after in zip(pieces[-1:] + pieces[:-1], pieces, strict=True)
        ]
        return [tuple(feature for both in found for feature in both)]
    first, last = pieces[0], pieces[-1]
    chains = [[Feature(first.start, first.start, 0.0, first.first, first.start, 0.0), first]]
    for before, after in pairwise(pieces):
        turn = (before.last.conjugate() * after.first).imag
        if turn > _TANGENT:
            chains[-1][-1] = _longer(before, 0.0, _BEYOND)
            chains.append([_longer(after, _BEYOND, 0.0)])
        else:
            chains[-1] += [_corner(before, after), after] if turn < -_TANGENT else [after]
    chains[-1].append(Feature(last.end, last.end, last.last, 0.0, last.end, 0.0))
    return [tuple(chain) for chain in chains]


def _corner(before: Feature, after: Feature) -> Feature:
    return Feature(after.start, after.start, before.last, after.first, after.start, 0.0)


def _longer(feature: Feature, ahead: float, beyond: float) -> Feature:
    """Return a segment with more at its start and its end, by parts of its length; an arc as it is."""
    if feature.radius is not None:
        return feature
    start = feature.start + ahead * (feature.start - feature.end)
    return replace(feature, start=start, end=feature.end + beyond * (feature.end - feature.start))


@dataclass
class OnOutline(Touching):
    """A disc beside a chain of a body: a corner, of radius 0, meets no corners.

    Attributes
    ----------
    disc, other : Surface
        The disc, and the body of the chain.
    features, closed : tuple of Feature, bool
        The chain, and whether its ends are joined.
    sliding, static, restitution : float
        Coefficients.
    on : int or None
        Number of the feature on which it is closed.
    """

    disc: Surface
    other: Surface
    features: tuple[Feature, ...]
    closed: bool
    sliding: float = 0.0
    static: float = 0.0
    restitution: float = 0.0
    on: int | None = None

    def _place(self, q: Complex) -> Complex:
        """Return the centre in the frame of the chain's body."""
        centre, body = point_of(q, self.disc.body, self.disc.at)[0], self.other.body
        if body == GROUND:
            return centre
        angle, (x, y) = q[3 * body + 2], centre - q[3 * body : 3 * body + 2]
        c, s = np.cos(angle), np.sin(angle)
        return np.array([c * x + s * y, c * y - s * x])

    def nearest(self, q: Complex) -> int | None:
        """Return the number of the nearest feature; None of a corner beside a corner."""
        place = complex(*np.real(self._place(q)).tolist())
        own = [
            (abs(feature.far(place)) + (_NEAR if feature.radius == 0.0 else 0.0), i)
            for i, feature in enumerate(self.features)
            if min(feature.ways(place)) > -_NEAR
        ]
        number = min(own)[1] if own else None
        return None if number is None or self.disc.radius == self.features[number].radius == 0.0 else number

    def look(self, q: Complex) -> tuple[Complex, Complex, Complex]:
        """Return the gap, the direction that pushes the disc, and the point that touches."""
        (x, y), number = self._place(q), self.nearest(q) if self.on is None else self.on
        gap, nx, ny = (_FAR + 0.0 * x, 0.0, 1.0) if number is None else self.features[number].look(x, y)
        normal, radius = turned(q, self.other.body, (nx, ny)), self.disc.radius or 0.0
        return gap - radius, normal, point_of(q, self.disc.body, self.disc.at)[0] - radius * normal

    def follow(self, q: Array, closed: bool) -> None:
        """Keep the nearest feature as long as it is closed."""
        self.on = None if not closed else self.nearest(q) if self.on is None else self.on

    def ends(self, q: Array) -> dict[str, float]:
        """Return how far it is from both ends of its feature."""
        return dict(zip(("back", "ahead"), self.features[self.on or 0].ways(complex(*self._place(q))), strict=True))

    def passes(self, q: Array) -> bool:
        """Return whether a corner is about to pass a corner."""
        number = None if self.disc.radius else self.nearest(q)
        return number is not None and min(self.features[number].ways(complex(*self._place(q)))) < _PASSES

    def step(self, way: str) -> bool:
        """Go on to the next feature; return whether there is one."""
        number, count = (self.on or 0) + (1 if way == "ahead" else -1), len(self.features)
        self.on = number % count
        return self.disc.radius != 0.0 and (self.closed or 0 <= number < count)


def _on(draft: Draft, name: str, body: int, points: Sequence[complex], bulges: Sequence[float], closed: bool) -> None:
    """Add an outline to the file."""
    corners = [
        [p.real, p.imag] if b == 0.0 else {"to": [p.real, p.imag], "bulge": b}
        for p, b in zip(points, bulges, strict=True)
    ]
    table = {"body": draft.name(body), "points": corners, **({"closed": True} if closed else {})}
    draft.raw.setdefault("outlines", {})[name] = table


def _law(draft: Draft) -> tuple[dict[str, Any], tuple[float, float, float]]:
    """Return random coefficients, of the file and of the simulation."""
    mu, e = float(draft.random.choice([0.0, draft.one(0.05, 1.0), draft.one(0.05, 1.0)])), draft.one(0.2, 0.6)
    e = float(draft.random.choice([0.0, e]))
    static = round(mu * float(draft.random.choice([1.0, 1.0, 1.3])), 6)
    table = {
        "restitution": e,
        **({"friction": mu if mu == static else {"sliding": mu, "static": static}} if mu else {}),
    }
    return table, (mu, static, e)


def _slopes(draft: Draft, beyond: float, arcs: bool = False) -> tuple[list[complex], list[float]]:
    """Return 2 to 12 pieces from the left to the right, with corners both ways; the ends are longer."""
    count = int(draft.random.integers(2, 13))
    x = np.concatenate([[0.0], np.cumsum([draft.one(0.15, 0.5) for _ in range(count)])])
    x -= x[count // 2] + 0.03
    x[0] -= beyond
    x[-1] += beyond
    points = [complex(round(float(a), 6), draft.one(-0.12, 0.12)) for a in x]
    return points, [draft.one(-0.25, 0.2) if arcs and draft.random.random() < 0.5 else 0.0 for _ in points]


def _falling(draft: Draft, over: float) -> Surface:
    draft.longest = 8e-3
    r, mass = draft.one(0.03, 0.07), draft.one(0.5, 2.0)
    inertia, place = round(draft.one(0.4, 0.9) * mass * r * r, 8), (0.0, over)
    velocity, spin = (draft.one(-1.0, 1.0), 0.0), draft.one(-20.0, 20.0)
    return Surface(draft.body("disc", mass, inertia, place, velocity=velocity, omega=spin), radius=r)


def _disc_over(
    draft: Draft, body: int, disc: Surface, points: list[complex], bulges: list[float], closed: bool
) -> None:
    """Add an outline under a disc."""
    _on(draft, "under", body, points, bulges, closed)
    table, law = _law(draft)
    shapes = [{"body": "disc", "disc": disc.radius}, {"outline": "under"}]
    draft.raw["contacts"]["touch"] = {"between": shapes, **table}
    for features in chains_of(points, bulges, closed):
        draft.contacts.append(OnOutline(disc, Surface(body), features, closed, *law))


def hills(draft: Draft) -> None:
    """Draw a disc that falls on hills and valleys of segments."""
    _disc_over(draft, GROUND, _falling(draft, draft.one(0.3, 0.5)), *_slopes(draft, 0.5), False)


def dunes(draft: Draft) -> None:
    """Draw a disc that falls on hills and valleys of segments and arcs."""
    _disc_over(draft, GROUND, _falling(draft, draft.one(0.3, 0.5)), *_slopes(draft, 0.5, True), False)


def _convex(draft: Draft) -> list[complex]:
    """Return a convex polygon about the origin, counterclockwise: points of an ellipse."""
    count = int(draft.random.integers(3, 7))
    wide, high, first = draft.one(0.08, 0.15), draft.one(0.08, 0.15), draft.one(0.0, 6.0)
    turns = [first + (i + draft.one(-0.25, 0.25)) * math.tau / count for i in range(count)]
    return [complex(round(wide * math.cos(turn), 6), round(high * math.sin(turn), 6)) for turn in turns]


def turning(draft: Draft) -> None:
    """Draw a disc that falls on a polygon which turns on a pin."""
    points, mass = [2.0 * p for p in _convex(draft)], draft.one(1.0, 3.0)
    body = draft.body("cam", mass, round(0.02 * mass, 6), (0.0, 0.0), omega=draft.one(-4.0, 4.0))
    draft.pin(GROUND, body, (0.0, 0.0), (0.0, 0.0))
    disc = _falling(draft, draft.one(0.35, 0.45))
    pull = draft.one(20.0, 60.0)
    draft.spring(disc.body, (0.0, 0.0), (pull, pull), (0.0, 0.0))
    # chains of closed outlines run clockwise, the free side on their left
    _disc_over(draft, body, disc, points[::-1], [0.0] * len(points), True)


def tumbling(draft: Draft) -> None:
    """Draw a polygon that falls on hills and valleys: corners of each beside faces of the other."""
    draft.longest = 8e-3
    points, bulges = _slopes(draft, 2.0)
    shape, mass = _convex(draft), draft.one(0.5, 2.0)
    velocity, spin = (draft.one(-1.0, 1.0), 0.0), draft.one(-5.0, 5.0)
    place = 0.0, draft.one(0.3, 0.4)
    body = draft.body("polygon", mass, round(0.006 * mass, 6), place, velocity=velocity, omega=spin)
    _on(draft, "under", GROUND, points, bulges, False)
    _on(draft, "shape", body, shape, [0.0] * len(shape), True)
    table, law = _law(draft)
    draft.raw["contacts"]["touch"] = {"between": [{"outline": "under"}, {"outline": "shape"}], **table}
    chains = chains_of(points, bulges, False)
    for p in shape:
        draft.contacts += [
            OnOutline(Surface(body, (p.real, p.imag), 0.0), Surface(GROUND), features, False, *law)
            for features in chains
        ]
    (faces,) = chains_of(shape[::-1], bulges[: len(shape)] + [0.0] * len(shape), True)
    for before, at, after in zip(points, points[1:], points[2:], strict=False):
        if ((at - before).conjugate() * (after - at)).imag < 0.0:
            corner = Surface(GROUND, (at.real, at.imag), 0.0)
            draft.contacts.append(OnOutline(corner, Surface(body), faces, True, *law))


OUTLINES: dict[str, Callable[[Draft], None]] = {draw.__name__: draw for draw in (hills, dunes, turning, tumbling)}
