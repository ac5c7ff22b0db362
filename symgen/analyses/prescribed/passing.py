"""Singular positions on the way of a prescribed motion, and the curve that carries the motion over them."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import KroghInterpolator

from symgen.run.layout.model_arrays import velocity_of_coordinate
from symgen.run.planning.dead_centre import dead_centre

if TYPE_CHECKING:
    from symgen.run.layout.compiled import ModelInfo

Array = NDArray[np.float64]

#: Times -> states, accelerations, and angles that count turns.
Curve = Callable[[Array], tuple[Array, Array, Array]]


@dataclass(frozen=True)
class Passage:
    """A singular position on the way.

    Attributes
    ----------
    t : float
        Its time [s].
    kind : str
        ``"passed"``, or ``"dead centre"`` where the motion ends.
    coordinates : tuple of str
        Coordinates that could move there although all drivers hold still.
    drivers : tuple of str
        Drivers that hold nothing there.
    """

    t: float
    kind: str
    coordinates: tuple[str, ...]
    drivers: tuple[str, ...]

    @property
    def words(self) -> str:
        """One sentence."""
        free = ", ".join(self.coordinates)
        if self.kind == "passed":
            how = "passed on the smooth branch, though another one leaves it"
            return f"singular position at t = {self.t:.9g} s (drivers do not hold {free}): {how}"
        return dead_centre(self.t, self.drivers, self.coordinates)


def curve_through(info: ModelInfo, nodes: Sequence[tuple[Array, ...]]) -> Curve:
    """Return the motion through a few states, by polynomials that have their values and rates.

    Parameters
    ----------
    info : ModelInfo
        The model.
    nodes : sequence of tuple of Array
        Time, q, q', v, v', and angles that count turns.
    """
    times = np.repeat([float(node[0][0]) for node in nodes], 2)

    def interpolation_through(value: int, rate: int) -> KroghInterpolator:
        return KroghInterpolator(times, np.array([x for node in nodes for x in (node[value], node[rate])]))

    q, v = interpolation_through(1, 2), interpolation_through(3, 4)
    turned = np.array([node[5] for node in nodes])

    def states_at(t: Array) -> tuple[Array, Array, Array]:
        y = np.zeros((len(t), info.ny))
        y[:, : info.nq] = q(t)
        for first, _ in info.spins:
            y[:, first : first + 4] /= np.linalg.norm(y[:, first : first + 4], axis=1, keepdims=True)
        y[:, info.nq : info.nq + info.nv] = v(t)
        nearest = np.abs(t[:, np.newaxis] - times[::2]).argmin(axis=1)
        return y, np.atleast_2d(v.derivative(t)), turned[nearest]

    return states_at


def coordinate_rates(info: ModelInfo, q: Array, v: Array) -> Array:
    """Return q' = N v: velocities, and of Euler parameters half their product with the angular velocity."""
    rates = np.zeros(info.nq)
    spun = {first + k for first, _ in info.spins for k in range(4)}
    places = [i for i in range(info.nq) if i not in spun]
    rates[places] = v[[velocity_of_coordinate(i, info) for i in places]]
    for first, at in info.spins:
        scalar, vector, w = q[first], q[first + 1 : first + 4], 0.5 * v[at : at + 3]
        rates[first], rates[first + 1 : first + 4] = -vector @ w, scalar * w + np.cross(vector, w)
    return rates
