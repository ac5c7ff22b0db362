"""Places and turns of interfaces of modal bodies, in the frames of these bodies, at many states."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from symgen.describe.modal_body import CarriedInterface

Array = NDArray[np.float64]


class InterfacePoses(NamedTuple):
    """Poses of an interface in the frame of its body.

    Attributes
    ----------
    origins : Array, shape (k, d)
        From the centre of mass [m].
    turns : Array, shape (k, d, d)
        Rotation matrices from axes of the interface to those of the body.
    """

    origins: Array
    turns: Array

    def place(self, point: Array) -> Array:
        """Return a point of the interface, or one at each state, from the centre of mass of the body, shape (k, d)."""
        own = np.broadcast_to(point, self.origins.shape)
        return np.asarray(self.origins + (self.turns @ own[:, :, np.newaxis])[:, :, 0])


def interface_poses(carried: CarriedInterface, modes: Array) -> InterfacePoses:
    """Return the poses of an interface.

    Parameters
    ----------
    carried : CarriedInterface
        The interface.
    modes : Array, shape (k, modes)
        Coordinates of the modes of its body [m].
    """
    origins = np.asarray(carried.place) + modes @ np.asarray(carried.shape).reshape(modes.shape[1], -1)
    turn = modes @ np.asarray(carried.turn).reshape(modes.shape[1], -1)
    if carried.curve:
        origins = origins + np.einsum("ki,ija,kj->ka", modes, np.array(carried.curve), modes)
        turn = turn + np.einsum("ki,ija,kj->ka", modes, np.array(carried.twist), modes)
    if turn.shape[1] == 1:
        c, s = np.cos(turn[:, 0]), np.sin(turn[:, 0])
        return InterfacePoses(origins, np.stack([np.stack([c, -s], 1), np.stack([s, c], 1)], 1))
    p = 0.5 * turn
    skew = np.zeros((len(p), 3, 3))
    for i, j, k in ((0, 1, 2), (1, 2, 0), (2, 0, 1)):
        skew[:, j, i], skew[:, i, j] = p[:, k], -p[:, k]
    factor = 2.0 / (1.0 + np.sum(p * p, axis=1))
    return InterfacePoses(origins, np.eye(3) + factor[:, np.newaxis, np.newaxis] * (skew + skew @ skew))
