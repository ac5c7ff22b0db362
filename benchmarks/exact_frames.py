"""Frames of bars in the plane, exact for any turn: rests under dead loads, and small motions of blades that turn.

Nothing here is symgen's own; modal bodies are compared with these.
"""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np
from numpy.typing import NDArray
from scipy import linalg
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

Array = NDArray[np.float64]
#: Shear stiffness over the axial one: bars of Euler and Bernoulli have a high one.
SHEAR = 1.0


def frame_at_rest(
    x: Array,
    bars: Iterable[tuple[int, int]],
    axial: float,
    bending: float,
    held: Iterable[int],
    loads: dict[int, float],
    steps: int = 4,
) -> Array:
    """Return how far nodes move and turn, shape (n, 3): bars of Reissner with one point each, by Newton's method.

    Unknowns are numbered node by node; `held` are those that stay 0, and `loads` forces and couples [N, N m] on others.
    """
    pairs, n = np.array(list(bars)), len(x)
    step = x[pairs[:, 1]] - x[pairs[:, 0]]
    length, first = np.linalg.norm(step, axis=1), np.arctan2(step[:, 1], step[:, 0])
    free = np.setdiff1d(np.arange(3 * n), list(held))
    whole = np.zeros(3 * n)
    whole[list(loads)] = list(loads.values())
    own = (3 * pairs[:, :, None] + np.arange(3)).reshape(len(pairs), 6)
    stiff = np.array([axial, SHEAR * axial])
    u = np.zeros(3 * n)
    for share in np.linspace(1.0 / steps, 1.0, steps):
        for _ in range(60):
            v = u[own]
            angle, apart = first + (v[:, 2] + v[:, 5]) / 2.0, step + v[:, 3:5] - v[:, :2]
            c, s = np.cos(angle), np.sin(angle)
            turn = np.array([[c, s], [-s, c]]).transpose(2, 0, 1)
            local = np.einsum("bij,bj->bi", turn, apart)
            swung = np.stack([local[:, 1], -local[:, 0]], 1)  # derivative by the angle
            b = np.zeros((len(pairs), 2, 6))
            b[:, :, 3:5], b[:, :, :2] = turn, -turn
            b[:, :, 2] = b[:, :, 5] = swung / 2.0
            push = stiff * (local - np.stack([length, 0.0 * length], 1)) / length[:, None]
            bend = bending * (v[:, 5] - v[:, 2]) / length
            force = np.einsum("bi,bij->bj", push, b)
            force[:, 2] -= bend
            force[:, 5] += bend
            k = np.einsum("bia,i,bij->baj", b, stiff, b) / length[:, None, None]
            curl = np.einsum("bi,bij->bj", np.stack([-push[:, 1], push[:, 0]], 1), turn)  # push . d turn / d angle
            for a in (2, 5):
                for places, sign in ((slice(3, 5), 0.5), (slice(0, 2), -0.5)):
                    k[:, a, places] += sign * curl
                    k[:, places, a] += sign * curl
                for other in (2, 5):
                    k[:, a, other] -= np.sum(push * local, axis=1) / 4.0
                    k[:, a, other] += (1.0 if a == other else -1.0) * bending / length
            residual, tangent = share * whole, np.zeros((3 * n, 3 * n))
            np.add.at(residual, own, -force)
            np.add.at(tangent, (own[:, :, None], own[:, None, :]), k)
            change = np.linalg.solve(tangent[np.ix_(free, free)], residual[free])
            u[free] += change
            if np.abs(change).max() < 1e-11 * np.ptp(x):
                break
    return u.reshape(n, 3)


def bent_strut(share: float, aside: float) -> float:
    """Return the middle of a strut of one metre between pins, an elastica that keeps its length.

    Parameters
    ----------
    share : float
        Thrust over Euler's load; above 1 the rest is that of the three which a straight strut is nearest to.
    aside : float
        Force across the middle over the bending stiffness [1/m^2].
    """
    thrust = np.pi**2 * share

    def half(start: float) -> tuple[float, float]:
        """Return the turn and the deflection in the middle, which has no turn, from the turn at a pin."""
        path = solve_ivp(
            lambda _, u: [-thrust * u[2] - 0.5 * aside * u[1], np.cos(u[0]), np.sin(u[0])],
            (0.0, 0.5),
            [start, 0.0, 0.0],
            rtol=1e-11,
            atol=1e-13,
        )
        return float(path.y[0, -1]), float(path.y[2, -1])

    starts = np.linspace(-1.5, 1.5, 241)
    turns = [half(start)[0] for start in starts]
    rests = [
        half(float(brentq(lambda start: half(start)[0], float(starts[i]), float(starts[i + 1]), xtol=1e-12)))[1]
        for i in range(len(starts) - 1)
        if turns[i] * turns[i + 1] < 0.0
    ]
    k = np.sqrt(thrust)
    straight = aside * (np.tan(0.5 * k) - 0.5 * k) / (2.0 * k**3)
    return min(rests, key=lambda rest: abs(rest - straight))


def lag_of_blade(length: float, bending: float, line_mass: float, speed: float, count: int = 40) -> float:
    """Return the first circular frequency in the plane of the turn of a blade that a hub clamps at its axis [rad/s]."""
    h = length / count
    k, m = np.zeros((2 * count + 2,) * 2), np.zeros((2 * count + 2,) * 2)
    points, weights = np.polynomial.legendre.leggauss(4)
    for i in range(count):
        own = slice(2 * i, 2 * i + 4)
        for point, weight in zip((points + 1.0) / 2.0, weights / 2.0 * h, strict=True):
            s = point
            shape = np.array(
                [1 - 3 * s**2 + 2 * s**3, h * (s - 2 * s**2 + s**3), 3 * s**2 - 2 * s**3, h * (s**3 - s**2)]
            )
            slope = (
                np.array([6 * s**2 - 6 * s, h * (1 - 4 * s + 3 * s**2), 6 * s - 6 * s**2, h * (3 * s**2 - 2 * s)]) / h
            )
            bow = np.array([12 * s - 6, h * (6 * s - 4), 6 - 12 * s, h * (6 * s - 2)]) / h**2
            pull = 0.5 * line_mass * speed**2 * (length**2 - ((i + s) * h) ** 2)
            k[own, own] += weight * (bending * np.outer(bow, bow) + pull * np.outer(slope, slope))
            m[own, own] += weight * line_mass * np.outer(shape, shape)
    k -= speed**2 * m
    return float(np.sqrt(linalg.eigh(k[2:, 2:], m[2:, 2:], eigvals_only=True)[0]))
