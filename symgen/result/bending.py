"""Beam elements at the outputs of a run: whether any is bent or stretched more than an element should be."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from symgen.base.vocabulary.expressions import Expr
from symgen.base.vocabulary.measures import GROUND, Component, Direction, Flexure, Marker, Sum
from symgen.describe.formulas.evaluate import evaluate
from symgen.describe.mechanism import Mechanism
from symgen.result.points import rotation_matrices

Array = NDArray[np.float64]

#: Largest bend [rad] and largest stretch of an element.
MOST_BENT, MOST_STRETCHED = 1.0, 0.2


def warning_on_bending(mechanism: Mechanism, parameters: Mapping[str, float], q: Array) -> str | None:
    """Return a sentence about the beam element that is bent or stretched most, None where none is too much.

    Parameters
    ----------
    mechanism, parameters
        The mechanism, and values of its parameters.
    q : Array, shape (k, nq)
        Coordinates of bodies at the outputs.
    """
    poses, worst, sentence = _Poses(mechanism, parameters, q), 1.0, None
    for force in mechanism.forces:
        for flexure in force.flexures:
            bend, stretch = poses.bend_and_stretch(flexure)
            for most, limit, words in (
                (bend, MOST_BENT, "is bent by {:.2g} rad, more than 1 rad"),
                (stretch, MOST_STRETCHED, "is stretched by {:.2g} of its length, more than 0.2"),
            ):
                if most / limit > worst:
                    worst, sentence = most / limit, f"beam element {force.name} {words.format(most)}"
    return sentence


class _Poses:
    """Places and directions of a mechanism at some times."""

    def __init__(self, mechanism: Mechanism, parameters: Mapping[str, float], q: Array) -> None:
        self.parameters, self.q, self.spatial = parameters, q, mechanism.space == "spatial"
        self.bodies, first = {}, 0
        for body in mechanism.bodies:
            self.bodies[body.name] = (body, first)
            first += len(body.coordinates)

    def numbers_of_vector(self, vector: tuple[Expr, ...]) -> Array:
        return np.array([evaluate(e, self.parameters, "forces") for e in vector])

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

    def bend_and_stretch(self, flexure: Flexure) -> tuple[float, float]:
        """Return the largest angle between the ends [rad] and the largest change of the length of the arc over it."""
        along = [m for m in flexure.measures if isinstance(m, Sum) and isinstance(m.terms[0][1], Component)]
        pairs = [[part for _, part in m.terms if isinstance(part, Component)] for m in along]
        frames = [[self._direction_in_ground(part.along) for part in pair] for pair in pairs]
        cosine = np.sum([np.sum(u * v, axis=1) for u, v in frames], axis=0)
        bend = np.arccos(np.clip(0.5 * (cosine - (1.0 if self.spatial else 0.0)), -1.0, 1.0))
        chord = np.linalg.norm(self.places_of_marker(pairs[0][0].b) - self.places_of_marker(pairs[0][0].a), axis=1)
        length = evaluate(flexure.length, self.parameters, "forces")
        stretch = np.abs(chord / np.sinc(0.5 * bend / np.pi) / length - 1.0)
        return float(bend.max(initial=0.0)), float(stretch.max(initial=0.0))

    def _direction_in_ground(self, direction: Direction) -> Array:
        return self.vector_in_ground(direction.body, self.numbers_of_vector(direction.vector))
