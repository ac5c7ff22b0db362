"""Bodies of a raw spatial description: positions, rotation matrices of Euler parameters, motion.

Numbers may be real or complex: derivatives are complex steps.
"""

import math
from types import SimpleNamespace

import numpy as np

from support.curves import curve
from support.plain import PLAIN_FUNCTIONS, piecewise

GROUND = "ground"
STEP = 1e-30


def angle_of(y, x):
    """atan2(y, x), analytic, so that it takes complex steps."""
    turn = math.atan2(np.real(y), np.real(x))
    if np.isrealobj(y) and np.isrealobj(x):
        return turn
    square = np.real(x) ** 2 + np.real(y) ** 2
    return turn + 1j * (np.real(x) * np.imag(y) - np.real(y) * np.imag(x)) / square


def skew(p):
    zero = 0.0 * p[0]
    return np.array([[zero, -p[2], p[1]], [p[2], zero, -p[0]], [-p[1], p[0], zero]])


def rotation(e):
    """Matrix of Euler parameters of any length: |e|^2 times a rotation."""
    real, vector = e[0], np.asarray(e[1:])
    return (real * real - vector @ vector) * np.eye(3) + 2 * np.outer(vector, vector) + 2 * real * skew(vector)


def product(a, b):
    """Product of quaternions."""
    u, w = np.asarray(a[1:]), np.asarray(b[1:])
    return np.array([a[0] * b[0] - u @ w, *(a[0] * w + b[0] * u + np.cross(u, w))])


def unit(vector):
    vector = np.asarray(vector, dtype=float)
    return vector / np.linalg.norm(vector)


def triad(axis, reference=None):
    """Columns first, second, axis; without a reference the first is made of the frame's axis after the nearest one."""
    axis = unit(axis)
    if reference is None:
        reference = np.eye(3)[(int(np.argmax(np.abs(axis))) + 1) % 3]
    first = unit(np.asarray(reference, dtype=float) - (axis @ reference) * axis)
    return np.column_stack([first, np.cross(axis, first), axis])


class Bodies:
    """The bodies of a raw spatial description, with numbers for its parameters."""

    def __init__(self, raw, values=None) -> None:
        self.raw, self.bodies = raw, raw["bodies"]
        self.known = {n: getattr(np, n) for n in ("sin", "cos", "sqrt", "exp", "tanh")} | PLAIN_FUNCTIONS
        self.known |= {"piecewise": piecewise}
        for name, table in raw.get("tables", {}).items():
            self.known[name] = curve(**table)
        self.values = dict(raw.get("parameters", {})) | (values or {})
        self.first_q, self.first_v, self.nq, self.nv = {}, {}, 0, 0
        for name in self.bodies:
            self.first_q[name], self.first_v[name] = self.nq, self.nv
            self.nq += 7 if self.turns(name) else 3
            self.nv += 6 if self.turns(name) else 3

    def turns(self, body) -> bool:
        return body == GROUND or self.bodies[body].get("type", "rigid") == "rigid"

    def number(self, value, **names):
        if not isinstance(value, str):
            return value
        return eval(value, {"__builtins__": {}}, self.known | self.values | names)  # a test's own text

    def vector(self, values):
        return np.array([self.number(e) for e in values])

    def of_state(self, value, t, q, v, **names):
        bodies = {}
        for name in self.bodies:
            i, j, turns = self.first_q[name], self.first_v[name], self.turns(name)
            labels = ("x", "y", "z", "e0", "e1", "e2", "e3")[: 7 if turns else 3]
            rates = ("vx", "vy", "vz", "wx", "wy", "wz")[: 6 if turns else 3]
            parts = {n: q[i + k] for k, n in enumerate(labels)} | {n: v[j + k] for k, n in enumerate(rates)}
            for point in self.bodies[name].get("points", {}):
                parts[point] = self._components(self.point(name, point, q), self.velocity(name, point, q, v))
            for axis, along in zip(("ex", "ey", "ez"), self.matrix(name, q).T if turns else (), strict=False):
                parts[axis] = self._components(along, np.cross(self.spin(name, q, v), along))
            bodies[name] = SimpleNamespace(**parts)
        return self.number(value, t=t, **bodies, **names)

    @staticmethod
    def _components(place, speed):
        return SimpleNamespace(**dict(zip(("x", "y", "z", "vx", "vy", "vz"), (*place, *speed), strict=True)))

    # -- motion --------------------------------------------------------------------------------------------------------

    def rates(self, q, v):
        """q' = N v."""
        result = []
        for name in self.bodies:
            i, j = self.first_q[name], self.first_v[name]
            result += [*v[j : j + 3]]
            if self.turns(name):
                result += [*(product(q[i + 3 : i + 7], np.array([0.0, *v[j + 3 : j + 6]])) / 2)]
        return np.array(result)

    def moved(self, q, v, tau):
        """Where constant velocities lead within a time tau, exactly."""
        result = []
        for name in self.bodies:
            i, j = self.first_q[name], self.first_v[name]
            result += [*(np.asarray(q[i : i + 3]) + tau * np.asarray(v[j : j + 3]))]
            if self.turns(name):
                omega = np.asarray(v[j + 3 : j + 6])
                size = np.linalg.norm(omega)
                turn = np.array([math.cos(size * tau / 2), *(math.sin(size * tau / 2) / max(size, 1e-300) * omega)])
                result += [*product(q[i + 3 : i + 7], turn)]
        return np.array(result)

    # -- bodies and points ---------------------------------------------------------------------------------------------

    def matrix(self, body, q):
        if body == GROUND or not self.turns(body):
            return np.eye(3)
        i = self.first_q[body]
        return rotation(np.asarray(q[i + 3 : i + 7]))

    def centre(self, body, q):
        return np.zeros(3) if body == GROUND else np.asarray(q[self.first_q[body] : self.first_q[body] + 3])

    def arm(self, body, point, q):
        """From the centre of mass (ground: the origin) to a point, in ground axes."""
        if body == GROUND:
            return self.vector(point)
        if point == "centre" or not self.turns(body):
            return np.zeros(3)
        keys = self.bodies[body]
        local = self.vector(keys["points"][point] if isinstance(point, str) else point)
        return self.matrix(body, q) @ (local - self.vector(keys.get("centre_of_mass", (0.0, 0.0, 0.0))))

    def point(self, body, point, q):
        return self.centre(body, q) + self.arm(body, point, q)

    def spin(self, body, q, v):
        """Angular velocity in ground axes."""
        if body == GROUND or not self.turns(body):
            return np.zeros(3)
        j = self.first_v[body]
        return self.matrix(body, q) @ np.asarray(v[j + 3 : j + 6])

    def velocity(self, body, point, q, v):
        if body == GROUND:
            return np.zeros(3)
        j = self.first_v[body]
        return np.asarray(v[j : j + 3]) + np.cross(self.spin(body, q, v), self.arm(body, point, q))

    def direction(self, body, vector, q):
        return self.matrix(body, q) @ unit(vector)
