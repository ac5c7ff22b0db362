"""How far two motions are apart: the largest distance between corresponding points of the bodies.

The points of a body are its centre of mass and the tips of its axes at the body's own length, so that an error of an
angle counts as the distance it moves the body's far end.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from symgen.describe.evaluate import evaluate
from symgen.describe.mechanism import Body, Mechanism

Array = NDArray[np.float64]


def own_length(body: Body, parameters: Mapping[str, float]) -> float:
    """Return a body's own length [m]: 0 for a point mass.

    The largest distance of a named point from the centre of mass, and at least the radius of gyration, which is all
    that a body without points has.
    """
    if body.inertia is None:
        return 0.0
    where = f"bodies.{body.name}"
    cx, cy = (evaluate(e, parameters, where) for e in body.centre_of_mass)
    mass = evaluate(body.mass, parameters, where)
    inertia = evaluate(body.inertia, parameters, where)
    longest = math.sqrt(abs(inertia / mass)) if mass else 0.0
    for _, (x, y) in body.points:
        longest = max(longest, math.hypot(evaluate(x, parameters, where) - cx, evaluate(y, parameters, where) - cy))
    return longest


@dataclass(frozen=True)
class Points:
    """The points of a mechanism's bodies as functions of its coordinates.

    Attributes
    ----------
    bodies : tuple of (int, float)
        For each body where its coordinates begin, and its own length; 0 for a point mass.
    """

    bodies: tuple[tuple[int, float], ...]

    @classmethod
    def of(cls, mechanism: Mechanism, parameters: Mapping[str, float]) -> Points:
        """Collect the bodies of `mechanism` with the lengths that they have at these parameters."""
        bodies, first = [], 0
        for body in mechanism.bodies:
            bodies.append((first, own_length(body, parameters)))
            first += len(body.coordinates)
        return cls(tuple(bodies))

    def distance(self, a: Array, b: Array) -> float:
        """Return the largest distance [m] between corresponding points, over all bodies and times.

        Parameters
        ----------
        a, b : Array, shape (k, nq)
            Coordinates at the same times.
        """
        return float(self.distances(a, b).max(initial=0.0))

    def distances(self, a: Array, b: Array) -> Array:
        """Return the largest distance [m] over all bodies at each time, shape (k,)."""
        largest = np.zeros(len(a))
        for i, length in self.bodies:
            dx, dy = a[:, i] - b[:, i], a[:, i + 1] - b[:, i + 1]
            candidates = [np.hypot(dx, dy)]
            if length > 0.0:
                c = length * (np.cos(a[:, i + 2]) - np.cos(b[:, i + 2]))
                s = length * (np.sin(a[:, i + 2]) - np.sin(b[:, i + 2]))
                candidates += [np.hypot(dx + c, dy + s), np.hypot(dx - s, dy + c)]
            largest = np.maximum(largest, np.max(candidates, axis=0))
        return largest
