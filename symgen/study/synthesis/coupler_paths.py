"""A path: linkages whose coupler point passes it, from coupler curves of many shapes to least squares.

A shape is turned, scaled and moved onto the path at once, as complex numbers do that by one division. The best ones
begin searches, in which all pins vary, and how far the crank turns from one point of the path to the next.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from itertools import product
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from symgen.analyses.search.measured_data import ColumnAim, MeasuredData, Residuals
from symgen.analyses.search.ranges import Ranges
from symgen.analyses.search.search import Search
from symgen.base.settings import Settings
from symgen.study.design.motions import motions_of
from symgen.study.design.problem import QuantityReader
from symgen.study.synthesis.linkages import COSINE, PLACES, Linkage, pins_of_values, variable_linkage, verify_linkage
from symgen.study.synthesis.tasks import SynthesisTask

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]

#: Shapes for each start, and angles of their cranks in one turn.
SHAPES, ANGLES = 100, 72
#: How many of these angles a path may take, and between which ones it may begin.
SPANS, EVERY = (12, 18, 24, 30, 36, 42, 48, 60, 70), 3
#: Least and most turn of a crank from one point to the next [rad].
LEAST, MOST = 0.01, 2.5
#: Fits of one start, each of so many steps as least squares take, and the part by which one has to be better.
FITS, BETTER = 6, 0.02
#: What a transmission angle keeps beside the least one [rad], and how much its cosine counts beside parts of the size:
#: more, where the linkage that was found falls short of the least angle between the points.
SPARE, STEEP = math.radians(2.0), (0.1, 1.0, 10.0)
#: Starts differ by so many sizes of the task, all pins together.
APART = 0.5


#: Pins of a linkage that moves, which the search's machine is compiled with, in the order of `PLACES` [m].
_ANY = (0.0, 0.0, 1.0, 0.0, 0.0, 0.3, 0.9, 0.8, 0.5, 1.0)


class PathStart(NamedTuple):
    """A shape on the path.

    Attributes
    ----------
    miss : float
        Root mean square of the distances from the points [m].
    places : Array, shape (10,)
        Its pins and its tip, in the order of `PLACES` [m].
    turns : Array, shape (n - 1,)
        Turns of its crank from one point to the next [rad].
    """

    miss: float
    places: Array
    turns: Array


class PathSearch:
    """Linkages whose coupler point passes a path.

    Parameters
    ----------
    task : SynthesisTask
        The path.
    room : float
        Pins are within so many sizes about the middle of the task.
    transmission : float
        The smallest transmission angle of a start [rad].
    """

    def __init__(self, task: SynthesisTask, room: float, transmission: float) -> None:
        self.task, self.transmission = task, transmission
        self.points = task.places[:-1] if task.is_closed else task.places
        self.low, self.high = task.room(room)
        self.turns = [f"turn{k}" for k in range(1, len(self.points))]
        parameters = dict(zip(PLACES, _ANY, strict=True))
        mechanism = variable_linkage({**parameters, **dict.fromkeys(self.turns, 0.1)}, _motor(self.turns))
        reader = QuantityReader(mechanism)
        steep = f"max(abs({COSINE}) - {math.cos(transmission + SPARE)!r}, 0)"  # 0 as well, where forces pass well
        columns = {"coupler.x": self.points[:, 0], "coupler.y": self.points[:, 1], steep: np.zeros(len(self.points))}
        data = MeasuredData("the path", np.linspace(0.0, 1.0, len(self.points)), columns)
        units = dict(zip(columns, ("m", "m", ""), strict=True))
        self._aims = list[ColumnAim]()
        for each in STEEP:
            weights = dict(zip(columns, (1.0 / task.size, 1.0 / task.size, each), strict=True))
            places = tuple(reader.place("synthesize", name) for name in columns)
            self._aims.append(ColumnAim(Residuals([data], units, weights), places))
        self._names = (*PLACES, *self.turns)
        self._motions = motions_of(mechanism, Settings(until=1.0), self._names, 1.0, reader.quantities)

    def find(self, starts: int, seed: int) -> Iterator[Linkage]:
        """Yield verified linkages, from the best shapes on."""
        for start in self._begin(starts, seed):
            for aim in self._aims:
                found = self._fit(start, aim)
                if found is None:
                    break
                linkage, start = found
                if linkage.transmission >= self.transmission:
                    break
            if found is not None:
                yield linkage

    def _begin(self, starts: int, seed: int) -> list[PathStart]:
        """Return the best shapes that are no neighbours."""
        chosen = list[PathStart]()
        for start in self._shapes(starts, seed):
            if all(np.linalg.norm(start.places - other.places) > APART * self.task.size for other in chosen):
                chosen.append(start)
            if len(chosen) == starts:
                break
        return chosen

    def _fit(self, start: PathStart, aim: ColumnAim) -> tuple[Linkage, PathStart] | None:
        """Return the linkage of least squares near a shape, verified, and as a shape itself."""
        way, count = np.sign(start.turns[0]), len(self.turns)
        ends = np.sort([way * LEAST, way * MOST])
        low, high = (
            np.append(np.tile(x, 5), np.full(count, end)) for x, end in ((self.low, ends[0]), (self.high, ends[1]))
        )
        ranges = Ranges(self._names, low, high, np.append(start.places, start.turns))
        search = Search(ranges, self._motions, aim, [], 1.0)
        found = search.check(ranges.parts(ranges.start))
        for _ in range(FITS):
            if found is None:
                break
            before, found = found, search.improve(found)
            if found.score > (1.0 - BETTER) * before.score:
                break
        if found is None:
            return None
        numbers = ranges.values(found.u)
        turned = np.cumsum([0.0, *numbers[len(PLACES) :].tolist()])
        turn = 2.0 * math.pi * float(way) if self.task.is_closed else float(turned[-1])
        if abs(turned[-1]) > 2.0 * math.pi:
            return None
        values = dict(zip(self._names, numbers.tolist(), strict=True))
        linkage = verify_linkage(pins_of_values(values), turn, turned / turn, self.points, None)
        fitted = PathStart(start.miss, numbers[: len(PLACES)], numbers[len(PLACES) :])
        return None if linkage is None else (linkage, fitted)

    # -- shapes --------------------------------------------------------------------------------------------------------

    def _shapes(self, starts: int, seed: int) -> list[PathStart]:
        """Return shapes on the path, the best first."""
        z = self.points[:, 0] + 1j * self.points[:, 1]
        way = np.cumsum(np.append(0.0, np.abs(np.diff(z))))
        turned, found = 2.0 * math.pi / ANGLES, list[PathStart]()
        spans = [span for span in SPANS if not self.task.is_closed or span >= ANGLES - 2]
        parts = [*product(spans, range(0, ANGLES, EVERY), (1, -1))]
        for pins, fixed in _curves(SHAPES * starts, seed, math.cos(self.transmission)):
            for span, first, sign in parts:
                curve = pins[2, (first + sign * np.arange(span + 1)) % ANGLES]
                if not np.isfinite(curve).all():
                    continue
                own = np.cumsum(np.append(0.0, np.abs(np.diff(curve))))
                steps = np.interp(way / way[-1] * own[-1], own, np.arange(span + 1))
                passed = np.interp(steps, np.arange(span + 1), curve)
                start = self._put_on(z, passed, np.array([*fixed, *pins[:, first]]), sign * turned * np.diff(steps))
                if start is not None:
                    found.append(start)
        return sorted(found, key=lambda start: start.miss)

    def _put_on(self, z: Complex, passed: Complex, pins: Complex, turns: Array) -> PathStart | None:
        """Return a shape turned, scaled and moved onto the path; None where its pins are out of the room."""
        centred, wanted = passed - passed.mean(), z - z.mean()
        scale = np.vdot(centred, wanted) / np.vdot(centred, centred).real
        put = scale * (pins - passed.mean()) + z.mean()
        places = np.column_stack([put.real, put.imag])
        if (places < self.low).any() or (places > self.high).any() or np.abs(turns).min() < LEAST:
            return None
        return PathStart(float(np.sqrt(np.mean(np.abs(wanted - scale * centred) ** 2))), places.reshape(-1), turns)


def _curves(count: int, seed: int, steepest: float) -> Iterator[tuple[Complex, Complex]]:
    """Yield coupler curves of drawn linkages on a ground from 0 to 1.

    Yields
    ------
    pins : array, shape (3, angles)
        Crank's pin, rocker's pin and tip at even angles of the crank; nan where it does not close, or where the cosine
        of its transmission angle is above the steepest.
    fixed : array, shape (2,)
        The pivots.
    """
    rng = np.random.default_rng(seed)
    turned = np.exp(2j * math.pi * np.arange(ANGLES) / ANGLES)
    for _ in range(count):
        crank, (coupler, rocker) = rng.uniform(0.1, 1.0), rng.uniform(0.3, 3.0, 2)
        tip = coupler * complex(rng.uniform(-1.0, 2.0), rng.uniform(-1.5, 1.5))
        a = crank * turned
        across = np.abs(1.0 - a)
        cosine = (coupler**2 + rocker**2 - across**2) / (2.0 * coupler * rocker)
        along = (coupler**2 - rocker**2 + across**2) / (2.0 * across)
        height = np.sqrt(np.maximum(coupler**2 - along**2, 0.0))
        direction = (along + 1j * rng.choice([-1.0, 1.0]) * height) * (1.0 - a) / (across * coupler)
        pins = np.array([a, a + coupler * direction, a + tip * direction])
        pins[:, np.abs(cosine) > steepest] = np.nan
        yield pins, np.array([0.0, 1.0], dtype=np.complex128)


def _motor(turns: list[str]) -> str:
    """Return how far the crank has turned: by one turn after the other, each from rest to rest."""
    parts = []
    for k, turn in enumerate(turns):
        passed = f"min(max({len(turns)}*t - {k}, 0), 1)"
        parts.append(f"{turn}*({passed} - sin(2*pi*{passed})/(2*pi))")
    return " + ".join(parts)
