"""Involute teeth: the outline of a spur gear by arcs, and the numbers of the law by which two gears touch.

The flanks are involutes of the base circle, up to the circle of the tips. Each is a chain of pairs of arcs with its
tangents, so many that they lie within a part of the module of it. A hollow arc joins two teeth at their roots.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Iterator
from itertools import pairwise

from symgen.base.vocabulary.expressions import Number, product
from symgen.describe.contacts.arcs_along import pair_of_arcs
from symgen.describe.contacts.chains import Plane
from symgen.describe.contacts.gear import Gear
from symgen.describe.contacts.outline_sections import GearTable
from symgen.describe.parts.scope import Scope

#: The most pairs of arcs that a flank takes.
_MOST = 400
#: Halvings that find where the root's arc begins.
_HALVINGS = 60


class _Flank:
    """The right flank of a tooth about the first axis, with the module 1."""

    def __init__(self, scope: Scope, table: GearTable) -> None:
        self.teeth, pressure = table.teeth, table.pressure_angle
        if table.teeth < 4:
            raise scope.error("gear_profile.teeth", "a number of at least 4", repr(table.teeth))
        if not 0.05 <= pressure <= 0.8:
            raise scope.error("gear_profile.pressure_angle", "an angle from 0.05 to 0.8 rad", f"{pressure!r} rad")
        for key in ("addendum", "dedendum"):
            if not 0.0 < (size := getattr(table, key)) < 0.5 * table.teeth:
                expected = f"a number above 0 and below half of the teeth, {0.5 * table.teeth!r}"
                raise scope.error(f"gear_profile.{key}", expected, repr(size))
        pitch = 0.5 * table.teeth
        self.base, self.tip, self.root = pitch * math.cos(pressure), pitch + table.addendum, pitch - table.dedendum
        self.half = 0.5 * (0.5 * math.pi - table.thinner) / pitch + math.tan(pressure) - pressure
        if not 0.0 < self.half < math.pi / self.teeth:
            raise scope.error("gear_profile", "teeth and gaps at the base circle", "none of one of both")
        self.end = self._roll(self.tip)
        if self.half - (self.end - math.atan(self.end)) <= 0.0:
            got = f"teeth that end below their tips at {self.tip:.6g} modules from the centre"
            raise scope.error("gear_profile", "teeth with a width at their tips", got)
        self.begin = self._root_roll()
        if self.begin >= self.end:
            raise scope.error("gear_profile.dedendum", "roots within the flanks", f"{table.dedendum!r} modules")
        self.tolerance = table.tolerance
        if not 1e-9 <= self.tolerance <= 1e-2:
            raise scope.error("gear_profile.tolerance", "a part of the module from 1e-9 to 1e-2", repr(self.tolerance))

    def _roll(self, radius: float) -> float:
        """Return the angle that the string unwinds to reach a radius, 0 within the base circle."""
        return math.sqrt(max(0.0, (radius / self.base) ** 2 - 1.0))

    def at(self, roll: float) -> tuple[complex, complex]:
        """Return the point of the right flank at an angle of the string, and its direction outwards."""
        turned = cmath.exp(1j * (roll - self.half))
        return self.base * (1.0 - 1j * roll) * turned, turned

    def _root_of(self, roll: float) -> tuple[float, float]:
        """Return the distance from the centre and the radius of the arc that touches two flanks at their roots.

        Its centre is in the middle of the gap on the right, on the normal of the flank.
        """
        point, along = self.at(roll)
        middle = cmath.exp(-1j * math.pi / self.teeth)
        normal = -1j * along
        # point + radius * normal = distance * middle
        radius = -(point * middle.conjugate()).imag / (normal * middle.conjugate()).imag
        return ((point + radius * normal) * middle.conjugate()).real, radius

    def _root_roll(self) -> float:
        """Return where the flanks begin: below 0 on radial lines within the base circle, in base radii."""

        def lowest(roll: float) -> float:
            far, radius = self._root_of(roll)
            return far - radius

        if lowest(0.0) > self.root:
            beta = math.pi / self.teeth - self.half
            far = self.root / (1.0 - math.sin(beta))
            return far * math.cos(beta) / self.base - 1.0
        low, high = 0.0, self.end
        for _ in range(_HALVINGS):
            roll = 0.5 * (low + high)
            low, high = (roll, high) if lowest(roll) < self.root else (low, roll)
        return high

    def arcs(self) -> list[tuple[complex, float]]:
        """Return the points after the first one of the involute, and the bulges that lead there."""
        first = max(self.begin, 0.0)
        for count in range(1, _MOST + 1):
            # a pair leaves the involute by its length^3 times the change of curvature, which is that of rolls
            rolls = [first + (self.end - first) * i / count for i in range(count + 1)]
            pairs = [pair_of_arcs(self.at, a, b) for a, b in pairwise(rolls)]
            if max(far for _, far in pairs) <= self.tolerance:
                return [each for pair, _ in pairs for each in pair]
        raise AssertionError("arcs come near to any involute")

    def tooth(self) -> Iterator[tuple[complex, float]]:
        """Yield the points of a tooth counterclockwise and the bulges before them, first the bulge of the root."""
        right = [(self.at(max(self.begin, 0.0))[0], 0.0), *self.arcs()]
        if self.begin < 0.0:
            right.insert(0, ((1.0 + self.begin) * self.base * cmath.exp(-1j * self.half), 0.0))
        turn = cmath.phase(self._root_direction())
        yield right[0][0], math.tan(0.25 * turn)
        yield from right[1:]
        tip = right[-1][0]
        yield tip.conjugate(), math.tan(-0.5 * cmath.phase(tip))
        for (point, _), (_, bulge) in zip(right[-2::-1], right[:0:-1], strict=True):
            yield point.conjugate(), bulge

    def _root_direction(self) -> complex:
        """Return the downward direction of the right flank at its root, less the angle of the left flank before."""
        direction = self.at(max(self.begin, 0.0))[1]
        middle = cmath.exp(-1j * math.pi / self.teeth)
        outwards = direction / middle  # mirrored by the middle of the gap, and back
        return -outwards * outwards


def teeth_of_gear(scope: Scope, table: GearTable) -> tuple[Gear, list[tuple[Plane, float]]]:
    """Return the gear of a table about the origin, and its corners with the bulges before them, counterclockwise.

    Raises
    ------
    InputError
        With the key that is wrong.
    """
    module = scope.constant("gear_profile.module", table.module, positive=True)
    flank = _Flank(scope, table)
    tooth = list(flank.tooth())
    corners = [
        ((product(Number(p.real), module), product(Number(p.imag), module)), bulge)
        for turn in range(table.teeth)
        for point, bulge in tooth
        for p in [point * cmath.exp(2j * math.pi * turn / table.teeth)]
    ]
    corners.append(corners[0])
    pitch = 0.5 * table.teeth
    inner = flank.base * math.hypot(1.0, max(flank.begin, 0.0))
    base = product(Number(flank.base), module)
    return Gear(table.teeth, base, flank.half, inner, flank.tip, pitch, flank.base / pitch), corners
