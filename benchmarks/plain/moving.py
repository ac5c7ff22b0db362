"""Numbers and vectors that move with a mechanism: value, gradient, rate and what velocities add to the second rate.

For s(t, q) with q' given by velocities v, ``s' = gradient v + (what time alone does)`` and
``s'' = gradient v' + curve``. Forward differentiation carries all of them through every operation, so a row of a joint
is written as its value only, in vectors and rotation matrices.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


@dataclass(slots=True)
class Moving:
    """A number or a vector of a state.

    Attributes
    ----------
    value : Array, shape (...)
        Its value.
    gradient : Array, shape (..., nv)
        Of its rate with respect to the velocities.
    rate, curve : Array, shape (...)
        s', and s'' less ``gradient v'``.
    """

    value: Array
    gradient: Array
    rate: Array
    curve: Array

    def __add__(self, o: Moving) -> Moving:
        return Moving(self.value + o.value, self.gradient + o.gradient, self.rate + o.rate, self.curve + o.curve)

    def __sub__(self, o: Moving) -> Moving:
        return Moving(self.value - o.value, self.gradient - o.gradient, self.rate - o.rate, self.curve - o.curve)

    def __neg__(self) -> Moving:
        return self.times(-1.0)

    def times(self, factor: float) -> Moving:
        """Return this times a constant."""
        return Moving(factor * self.value, factor * self.gradient, factor * self.rate, factor * self.curve)

    def plus(self, constant: float) -> Moving:
        """Return this plus a constant."""
        return Moving(self.value + constant, self.gradient, self.rate, self.curve)

    def part(self, i: int) -> Moving:
        """Return one component of a vector."""
        return Moving(self.value[i], self.gradient[i], self.rate[i], self.curve[i])

    def scaled(self, factor: Moving) -> Moving:
        """Return a vector times a number that moves."""
        return Moving(
            factor.value * self.value,
            np.multiply.outer(self.value, factor.gradient) + factor.value * self.gradient,
            factor.rate * self.value + factor.value * self.rate,
            factor.curve * self.value + 2.0 * factor.rate * self.rate + factor.value * self.curve,
        )

    def through(self, f: float, slope: float, bend: float) -> Moving:
        """Return a function of this number, from the function's value and first two derivatives there."""
        return Moving(np.asarray(f), slope * self.gradient, slope * self.rate, slope * self.curve + bend * self.rate**2)


def dot(a: Moving, b: Moving) -> Moving:
    """Return a . b."""
    return Moving(
        a.value @ b.value,
        b.value @ a.gradient + a.value @ b.gradient,
        b.value @ a.rate + a.value @ b.rate,
        b.value @ a.curve + 2.0 * (a.rate @ b.rate) + a.value @ b.curve,
    )


def crossed(a: Array, b: Array) -> Array:
    """Return a x b of two vectors in space."""
    return np.array([a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]])


def skew(a: Array) -> Array:
    """Return the matrix that takes b to a x b."""
    return np.array([[0.0, -a[2], a[1]], [a[2], 0.0, -a[0]], [-a[1], a[0], 0.0]])


def cross(a: Moving, b: Moving) -> Moving:
    """Return a x b."""
    return Moving(
        crossed(a.value, b.value),
        skew(a.value) @ b.gradient - skew(b.value) @ a.gradient,
        crossed(a.rate, b.value) + crossed(a.value, b.rate),
        crossed(a.curve, b.value) + 2.0 * crossed(a.rate, b.rate) + crossed(a.value, b.curve),
    )


def constant(value: Any, nv: int) -> Moving:
    """Return what does not move."""
    x = np.asarray(value, dtype=float)
    return Moving(x, np.zeros((*x.shape, nv)), np.zeros_like(x), np.zeros_like(x))


def root(a: Moving) -> Moving:
    """Return the square root of a number."""
    r = float(np.sqrt(a.value))
    return a.through(r, 0.5 / r, -0.25 / (r * float(a.value)))


def inverse(a: Moving) -> Moving:
    """Return 1 / a."""
    x = 1.0 / float(a.value)
    return a.through(x, -x * x, 2.0 * x**3)


def length(a: Moving) -> Moving:
    """Return the length of a vector."""
    return root(dot(a, a))


def direction(a: Moving) -> Moving:
    """Return a vector divided by its length."""
    return a.scaled(inverse(length(a)))


def angle(sine: Moving, cosine: Moving, near: float) -> Moving:
    """Return the angle whose sine and cosine are in a ratio, on the branch that is nearest to another angle."""
    s, c = sine.value, cosine.value
    square = s * s + c * c
    theta = float(np.arctan2(s, c))
    theta += 2.0 * np.pi * round((near - theta) / (2.0 * np.pi))
    rate = (c * sine.rate - s * cosine.rate) / square
    return Moving(
        np.asarray(theta),
        (c * sine.gradient - s * cosine.gradient) / square,
        rate,
        (c * sine.curve - s * cosine.curve - 2.0 * rate * (s * sine.rate + c * cosine.rate)) / square,
    )
