"""Distances between two motions, and whether they agree: one measure for ``--verify``, automatic choices and studies.

The points of a body are its centre of mass and the tips of its axes at the body's own length, so that an error of an
angle counts as the distance it moves the body's far end. The limit of agreement is a share of the mechanism's size: no
unit of length matters. Nothing inside one run sees its global error; a second run estimates it
(`symgen.result.reruns`).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from symgen.base.vocabulary.rotations import rotation_matrix_of
from symgen.describe.facts.lengths import origin_of_sizes, own_length
from symgen.describe.formulas.evaluate import scalar_values
from symgen.describe.mechanism import Mechanism
from symgen.describe.modal_body import CarriedInterface
from symgen.result.interface_poses import interface_poses

Array = NDArray[np.float64]

#: A motion below the first share of the mechanism's size is rounding, and one below the second is small against it.
STILL, SMALL = 1e-13, 0.1


@dataclass(frozen=True)
class Points:
    """The points of a mechanism's bodies as functions of its coordinates.

    Attributes
    ----------
    bodies : tuple of (int, float)
        For each body where its coordinates begin, and its own length; 0 for a point mass.
    dimension : int
        2 in the plane, 3 in space.
    slender : bool
        Whether some bodies are nodes of beams, whose own lengths are not those of the beam.
    datum : tuple of float
        The place that a point is measured from (`symgen.describe.facts.lengths.origin_of_sizes`).
    speeds : tuple of int
        For each body where its velocities begin.
    carried : tuple of (int, int, CarriedInterface)
        Interfaces of modal bodies: where the coordinates of the body begin, and where its modes do.
    """

    bodies: tuple[tuple[int, float], ...]
    dimension: int = 2
    slender: bool = False
    datum: tuple[float, ...] = ()
    speeds: tuple[int, ...] = ()
    carried: tuple[tuple[int, int, CarriedInterface], ...] = ()

    @classmethod
    def of_mechanism(cls, mechanism: Mechanism, parameters: Mapping[str, float]) -> Points:
        """Collect the bodies of `mechanism` with the lengths that they have at these parameters."""
        bodies, speeds, first, first_speed = [], [], 0, 0
        carried, places = list[tuple[int, int, CarriedInterface]](), dict[str, tuple[int, int]]()
        for body in mechanism.bodies:
            if body.carried is not None:
                carried.append((*places[body.carried.host], body.carried))
                continue
            count = 0 if body.modal is None else len(body.modal.stiffness)
            places[body.name] = first, first + len(body.coordinates) - count
            bodies.append((first, own_length(body, parameters)))
            speeds.append(first_speed)
            first += len(body.coordinates)
            first_speed += len(body.speeds)
        slender = any(force.flexures for force in mechanism.forces)
        dimension = 3 if mechanism.space == "spatial" else 2
        datum = tuple(origin_of_sizes(mechanism, scalar_values(parameters))[:dimension])
        return cls(tuple(bodies), dimension, slender, datum, tuple(speeds), tuple(carried))

    def size(self, q: Array) -> float:
        """Return the mechanism's size [m]: the longest body's own length.

        Where all bodies are point masses, or some are nodes of beams, it is the extent of what they do: the diagonal of
        the box that holds them; of one point at one place its distance from the mechanism's datum.

        Parameters
        ----------
        q : Array, shape (k, nq)
            Coordinates at some times.
        """
        longest = max((length for _, length in self.bodies), default=0.0)
        if (longest > 0.0 and not self.slender) or not self.bodies or not len(q):
            return longest
        places = np.concatenate([q[:, i : i + self.dimension] for i, _ in self.bodies])
        extent = float(np.linalg.norm(np.ptp(places, axis=0)))
        return max(longest, extent) or float(np.linalg.norm(places[0] - self.datum))

    def scale_of_errors(self, q: Array, small: float = SMALL) -> float:
        """Return what errors of a motion are shares of [m]: the mechanism's size, or the range of a small motion.

        A mechanism that stands still would follow every motion far smaller than itself.

        Parameters
        ----------
        q : Array, shape (k, nq)
            The motion, from its start.
        small : float
            Share of the size below which a motion is small.
        """
        size = self.size(q)
        moved = self.distances_over_time(q, np.repeat(q[:1], len(q), axis=0)).max(initial=0.0)
        return float(moved) if STILL * size < moved < small * size else size

    def largest_distance(self, a: Array, b: Array) -> float:
        """Return the largest distance [m] between corresponding points, over all bodies and times.

        Parameters
        ----------
        a, b : Array, shape (k, nq)
            Coordinates at the same times.
        """
        return float(self.distances_over_time(a, b).max(initial=0.0))

    def distances_over_time(self, a: Array, b: Array) -> Array:
        """Return the largest distance [m] over all bodies at each time, shape (k,)."""
        largest = np.zeros(len(a))
        if self.dimension == 2:
            largest = self._planar_distances(a, b)
        for i, length in self.bodies if self.dimension == 3 else ():
            centre = a[:, i : i + self.dimension] - b[:, i : i + self.dimension]
            candidates = [np.linalg.norm(centre, axis=1)]
            if length > 0.0:
                turn = slice(i + 3, i + 7)
                tips = rotation_matrices(a[:, turn]) - rotation_matrices(b[:, turn])
                candidates += [np.linalg.norm(centre + length * tips[:, :, k], axis=1) for k in range(self.dimension)]
            largest = np.maximum(largest, np.max(candidates, axis=0))
        for interface in self.carried:
            away = self._interface_places(interface, a) - self._interface_places(interface, b)
            largest = np.maximum(largest, np.linalg.norm(away, axis=1))
        return largest

    def _planar_distances(self, a: Array, b: Array) -> Array:
        """Return the largest distance over all bodies in the plane, at once for all of them."""
        if not self.bodies:
            return np.zeros(len(a))
        first, length = (np.array(part) for part in zip(*self.bodies, strict=True))
        first, turning = first.astype(int), length > 0.0
        x, y = a[:, first] - b[:, first], a[:, first + 1] - b[:, first + 1]
        largest = np.hypot(x, y).max(axis=1)
        if turning.any():
            (x, y), length, angle = (part[:, turning] for part in (x, y)), length[turning], first[turning] + 2
            c = length * (np.cos(a[:, angle]) - np.cos(b[:, angle]))
            s = length * (np.sin(a[:, angle]) - np.sin(b[:, angle]))
            tips = np.maximum(np.hypot(x + c, y + s), np.hypot(x - s, y + c))
            largest = np.maximum(largest, tips.max(axis=1))
        return np.asarray(largest)

    def _interface_places(self, interface: tuple[int, int, CarriedInterface], q: Array) -> Array:
        """Return the places of an interface, shape (k, dimension)."""
        (first, modes, carried), n = interface, self.dimension
        turn = slice(first + n, first + n + (1 if n == 2 else 4))
        own = interface_poses(carried, q[:, modes : modes + len(carried.shape)]).origins
        return np.asarray(q[:, first : first + n] + (rotation_matrices(q[:, turn]) @ own[:, :, np.newaxis])[:, :, 0])

    def speed_distances(self, a: tuple[Array, Array], b: tuple[Array, Array] | None = None) -> Array:
        """Return the largest difference of the points' velocities [m/s] over all bodies at each time, shape (k,).

        Parameters
        ----------
        a, b : pair of Array, shapes (k, nq), (k, nv)
            Coordinates and velocities at the same times; without `b` at rest.
        """
        largest = np.zeros(len(a[0]))
        for body in range(len(self.bodies)):
            difference = self._velocities(body, *a)
            if b is not None:
                difference = difference - self._velocities(body, *b)
            largest = np.maximum(largest, np.linalg.norm(difference, axis=2).max(axis=0, initial=0.0))
        return largest

    def _velocities(self, body: int, q: Array, v: Array) -> Array:
        """Return the velocities of a body's points, shape (points, k, dimension)."""
        (i, length), j, n = self.bodies[body], self.speeds[body], self.dimension
        centre = v[:, j : j + n]
        if length == 0.0:
            return centre[np.newaxis]
        axes, omega = rotation_matrices(q[:, i + n : i + (3 if n == 2 else 7)]), v[:, j + n : j + (3 if n == 2 else 6)]
        if n == 2:
            turning = np.stack([omega * np.column_stack([-axes[:, 1, k], axes[:, 0, k]]) for k in range(2)])
        else:  # angular velocities are in body axes
            turning = np.stack([(axes @ np.cross(omega, unit)[:, :, np.newaxis])[:, :, 0] for unit in np.eye(3)])
        return np.concatenate([centre[np.newaxis], centre + length * turning])


def rotation_matrices(orientation: Array) -> Array:
    """Return rotation matrices from angles, shape (k, 1), or from Euler parameters, shape (k, 4)."""
    if orientation.shape[1] == 1:
        c, s = np.cos(orientation[:, 0]), np.sin(orientation[:, 0])
        return np.stack([np.stack([c, -s], 1), np.stack([s, c], 1)], 1)
    e0, e1, e2, e3 = (orientation / np.linalg.norm(orientation, axis=1, keepdims=True)).T
    return np.stack([np.stack(row, 1) for row in rotation_matrix_of((e0, e1, e2, e3))], 1)


#: Two motions agree when no point of a body is farther from its counterpart than this share of the mechanism's size:
#: of the longest body's own length, or of the extent of the motion where all bodies are point masses.
AGREEMENT = 1e-4
#: Motions below this share of the size count as one of it: no run is asked to be exact beyond `AGREEMENT` of that.
LEAST_MOTION = 1e-6


@dataclass(frozen=True)
class Agreement:
    """Distances between two motions.

    Attributes
    ----------
    distances : Array, shape (k,)
        Largest distance between corresponding points at each output [m].
    limit : float
        Up to which they agree [m].
    rounding : float
        Of a point at the mechanism's size [m].
    small : float
        Range of a motion that is small against the mechanism and that the limit is a share of [m], else 0.
    """

    distances: Array
    limit: float
    rounding: float = 0.0
    small: float = 0.0

    @property
    def apart(self) -> float:
        """Largest distance of all [m]; nan if a motion is not finite."""
        return float(self.distances.max(initial=0.0))

    @property
    def holds(self) -> bool:
        """Whether they agree."""
        return self.apart <= self.limit

    @property
    def parts(self) -> int | None:
        """First output at which they do not agree, None if they do."""
        away = np.flatnonzero(~(self.distances <= self.limit))
        return int(away[0]) if len(away) else None


def compare_motions(points: Points, a: Array, b: Array, by_motion: bool = False) -> Agreement:
    """Compare two motions.

    Parameters
    ----------
    points : Points
        Points between which distances are measured.
    a, b : Array, shape (k, nq)
        Coordinates at the same times.
    by_motion : bool
        Whether they agree to a share of the range of `a` where that is small: a mechanism that stands still would
        agree with every motion far smaller than itself.
    """
    with np.errstate(all="ignore"):
        size = points.size(a)
        scale = points.scale_of_errors(a) if by_motion else size
        limit, rounding = AGREEMENT * max(scale, LEAST_MOTION * size), float(np.finfo(np.float64).eps) * size
        return Agreement(points.distances_over_time(a, b), limit, rounding, scale if scale < size else 0.0)


@dataclass(frozen=True)
class Verification:
    """Errors of a run as a run with finer steps shows them.

    Attributes
    ----------
    doubt : str or None
        Why the motion is not known well enough; None where two runs agree.
    note : str or None
        What the verification did, one sentence.
    error : float or None
        Estimated error of the run that is reported [m].
    evaluations : int
        Of all runs together.
    whole : bool
        Whether it says what there is to say about the whole run; a first part of it may agree.
    energy : float
        Energy error that finer steps do not make smaller [J], else 0.
    """

    doubt: str | None
    note: str | None
    error: float | None
    evaluations: int
    whole: bool = True
    energy: float = 0.0
