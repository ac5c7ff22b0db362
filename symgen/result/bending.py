"""Beam elements at some states: how far any is bent or stretched beside what an element should be."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from functools import partial

import numpy as np
from numpy.typing import NDArray

from symgen.base.vocabulary.expressions import Expr
from symgen.base.vocabulary.measures import GROUND, Component, Direction, Flexure, Marker, Sum
from symgen.describe.formulas.evaluate import evaluate_formula
from symgen.describe.mechanism import Mechanism
from symgen.result.part_limits import MotionOfBodies, PartLimit
from symgen.result.points import rotation_matrices

Array = NDArray[np.float64]

#: Largest bend [rad] and largest stretch of an element.
MOST_BENT, MOST_STRETCHED = 1.0, 0.2


def limits_of_elements(mechanism: Mechanism) -> Iterator[PartLimit]:
    """Yield the limits of beam elements: the angle between their ends, and the change of their length.

    Parameters
    ----------
    mechanism : Mechanism
        The mechanism.
    """

    def measure(
        flexure: Flexure, of: int, most: float, parameters: Mapping[str, float], motion: MotionOfBodies
    ) -> Array:
        return _Poses(mechanism, parameters, motion.q).bend_and_stretch(flexure)[of] / most

    def say(name: str, words: str, most: float, factor: float) -> str:
        return f"beam element {name} {words.format(factor * most)}"

    for force in mechanism.forces:
        for flexure in force.flexures:
            for of, most, words in (
                (0, MOST_BENT, "is bent by {:.2g} rad, more than 1 rad"),
                (1, MOST_STRETCHED, "is stretched by {:.2g} of its length, more than 0.2"),
            ):
                yield PartLimit(partial(measure, flexure, of, most), partial(say, force.name, words, most))


class _Poses:
    """Places and directions of a mechanism at some times."""

    def __init__(self, mechanism: Mechanism, parameters: Mapping[str, float], q: Array) -> None:
        self.parameters, self.q, self.spatial = parameters, q, mechanism.space == "spatial"
        self.bodies, first = {}, 0
        for body in mechanism.bodies:
            self.bodies[body.name] = (body, first)
            first += len(body.coordinates)

    def numbers_of_vector(self, vector: tuple[Expr, ...]) -> Array:
        return np.array([evaluate_formula(e, self.parameters, "forces") for e in vector])

    def vector_in_ground(self, body: str, vector: Array) -> Array:
        """Return a vector of a body's frame in the ground frame at all times, shape (k, dimension)."""
        if body == GROUND:
            return np.broadcast_to(vector, (len(self.q), len(vector)))
        at, count = self.bodies[body][1] + len(vector), 4 if self.spatial else 1
        return rotation_matrices(self.q[:, at : at + count]) @ vector

    def places_of_marker(self, marker: Marker) -> Array:
        """Return the places of a marker, shape (k, dimension)."""
        point = self.numbers_of_vector(marker.point)
        if marker.body == GROUND:
            return self.vector_in_ground(GROUND, point)
        body, at = self.bodies[marker.body]
        centre = self.numbers_of_vector(body.centre_of_mass)
        return self.q[:, at : at + len(point)] + self.vector_in_ground(marker.body, point - centre)

    def bend_and_stretch(self, flexure: Flexure) -> tuple[Array, Array]:
        """Return the angle between the ends [rad], and the change of the length of the arc over it, at all times."""
        along = [m for m in flexure.measures if isinstance(m, Sum) and isinstance(m.terms[0][1], Component)]
        pairs = [[part for _, part in m.terms if isinstance(part, Component)] for m in along]
        frames = [[self._direction_in_ground(part.along) for part in pair] for pair in pairs]
        cosine = np.sum([np.sum(u * v, axis=1) for u, v in frames], axis=0)
        bend = np.arccos(np.clip(0.5 * (cosine - (1.0 if self.spatial else 0.0)), -1.0, 1.0))
        chord = np.linalg.norm(self.places_of_marker(pairs[0][0].b) - self.places_of_marker(pairs[0][0].a), axis=1)
        length = evaluate_formula(flexure.length, self.parameters, "forces")
        return bend, np.abs(chord / np.sinc(0.5 * bend / np.pi) / length - 1.0)

    def _direction_in_ground(self, direction: Direction) -> Array:
        return self.vector_in_ground(direction.body, self.numbers_of_vector(direction.vector))
