"""Bodies in the plane with joints, gaps and what rubs: rows of rates, and the loads that bounds depend on.

Coordinates are x, y and the angle of each body. All rows are analytic, so that complex steps differentiate them.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any, Protocol

import numpy as np

from benchmarks.bounded.touch.bodies import GROUND, Array, Complex

_STEP = 1e-30


class Joint(Protocol):
    """What holds bodies: what is to be zero, and its rows."""

    def look(self, q: Complex) -> tuple[Complex, Complex]:
        """Return what is to be zero, and its rows."""
        ...


@dataclass(frozen=True)
class Gear:
    """Two bodies whose angles fulfil ``one + ratio other = 0``."""

    one: int
    other: int
    ratio: float

    def look(self, q: Complex) -> tuple[Complex, Complex]:
        """Return what is to be zero, and its row."""
        row = 0.0 * q
        row[3 * self.one + 2], row[3 * self.other + 2] = 1.0, self.ratio
        return np.array([row @ q]), np.array([row])


@dataclass(frozen=True)
class Gap:
    """A function of the coordinates that stays at least 0, with its row.

    Attributes
    ----------
    look : callable
        Takes coordinates; returns the gap and its row.
    restitution : float
        Rate after an impact over that before.
    """

    look: Callable[[Complex], tuple[Any, Complex]]
    restitution: float = 0.0


@dataclass(frozen=True)
class Rub:
    """Friction against a rate: ``beta + kappa load``, in motion and at rest.

    Attributes
    ----------
    row : callable
        Takes coordinates; returns the row of the rate.
    joint, gap : int
        Number of the joint, or of the gap, whose force is the load; -1 for none.
    sliding, static : tuple of float
        Beta and kappa.
    """

    row: Callable[[Complex], Complex]
    joint: int = -1
    gap: int = -1
    sliding: tuple[float, float] = (0.0, 0.0)
    static: tuple[float, float] = (0.0, 0.0)


def turn_between(one: int, other: int) -> Callable[[Complex], Complex]:
    """Return the row of the angular rate of a body less that of another one."""

    def row(q: Complex) -> Complex:
        found = 0.0 * q
        if one != GROUND:
            found[3 * one + 2] = 1.0
        if other != GROUND:
            found[3 * other + 2] = -1.0
        return found

    return row


def pin_that_rubs(one: int, other: int, joint: int, arm: float) -> Rub:
    """Return the friction of a pin: its bound is an arm [m] times its reaction."""
    return Rub(turn_between(other, one), joint=joint, sliding=(0.0, arm), static=(0.0, arm))


@dataclass
class Machine:
    """Masses, joints, gaps, what rubs, and forces as a function of time, coordinates and rates."""

    masses: Array
    joints: list[Joint]
    gaps: list[Gap]
    rubs: list[Rub]
    force: Callable[[float, Array, Array], Array]
    breaks: tuple[float, ...] = field(default=())

    def rows_of(self, q: Complex) -> Complex:
        """Return the rows of joints, of gaps and of what rubs."""
        held = [joint.look(q)[1] for joint in self.joints]
        rows = [*held, *(np.array([gap.look(q)[1]]) for gap in self.gaps)]
        return np.concatenate([*rows, *(np.array([rub.row(q)]) for rub in self.rubs)])

    def rows(self, q: Array, v: Array) -> tuple[Array, Array]:
        """Return all rows, and what their rates gain without accelerations."""
        rows = self.rows_of(q + _STEP * 1j * v)
        return np.real(rows), np.imag(rows) @ v / _STEP

    def gap_values(self, q: Array) -> Array:
        """Return all gaps."""
        return np.array([float(np.real(gap.look(q)[0])) for gap in self.gaps])

    def closed(self, q: Array) -> Array:
        """Return a place at which joints are closed."""
        for _ in range(5):
            parts = [joint.look(q) for joint in self.joints]
            rows = np.real(np.concatenate([part[1] for part in parts]))
            q = q - np.linalg.pinv(rows) @ np.real(np.concatenate([part[0] for part in parts]))
        return q

    def places(self) -> list[slice]:
        """Return where the rows of each joint are."""
        found, at = list[slice](), 0
        none = np.zeros(len(self.masses))
        for joint in self.joints:
            count = len(joint.look(none)[0])
            found.append(slice(at, at + count))
            at += count
        return found
