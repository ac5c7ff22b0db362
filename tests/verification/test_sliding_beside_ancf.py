"""A body that slides down a cantilever, beside cable elements in absolute nodal coordinates, own ones and Exudyn's.

The elements are those of M. Berzeri, A. A. Shabana, J. Sound Vib. 235 (2000) 539-565, with the forces of J. Gerstmayr,
H. Irschik, J. Sound Vib. 318 (2008) 461-487. Exudyn has them. Its modelUnitTests.py, SlidingJoint2DTest, says where the
body is after 0.1 s on three of them, by steps of 0.5 ms: no other number of a sliding joint was found in print.
"""

from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.integrate import solve_ivp
from support.emitted import mechanism_of

import symgen

Array = NDArray[np.float64]
LENGTH, AXIAL, BENDING, LINE = 2.0, 2.07e5, 2.07e11 * 1e-12 / 12.0, 7.8e-3
MASS, TURNS, HANGS, G = 0.12, 0.12 / 12.0 * 0.04, 0.1, 9.81
EXUDYN = -0.14920183348514676


def shapes(s: Any, h: float) -> Array:
    """Return the four cubic shapes of an element and their first two derivatives, shape (3, 4, ...)."""
    x = np.asarray(s) / h
    one, zero = np.ones_like(x), np.zeros_like(x)
    powers = np.array([[one, x, x**2, x**3], [zero, one, 2 * x, 3 * x**2], [zero, zero, 2 * one, 6 * x]])
    cubics = np.array([[1, 0, -3, 2], [0, h, -2 * h, h], [0, 0, 3, -2], [0, 0, -h, h]])
    return np.asarray(np.einsum("kp,dp...->dk...", cubics, powers) / h ** np.arange(3).reshape(3, *[1] * (x.ndim + 1)))


class Cable:
    """A clamped cable of n elements: places and slopes of nodes, of which the clamp leaves the length of one slope."""

    def __init__(self, n: int):
        self.n, self.h, size = n, LENGTH / n, 2 * n + 2
        self.own = 2 * np.arange(n)[:, None] + np.arange(4)
        mass, weight = np.zeros((size, size)), np.zeros(size)
        rules = [np.polynomial.legendre.leggauss(k) for k in (4, 5, 3)]
        at = [(0.5 * self.h * (p + 1.0), 0.5 * self.h * w) for p, w in rules]
        for own in self.own:
            s = shapes(at[0][0], self.h)[0]
            mass[np.ix_(own, own)] += LINE * (s * at[0][1]) @ s.T
            weight[own] += LINE * s @ at[0][1]
        self.stretched, self.bent = ((shapes(p, self.h), w) for p, w in at[1:])
        self.straight = np.zeros((size, 2))
        self.straight[::2, 0], self.straight[1::2, 0] = np.linspace(0.0, LENGTH, n + 1), 1.0
        self.free = np.setdiff1d(np.arange(2 * size), [0, 1, 3])
        self.mass, self.weight = np.kron(mass, np.eye(2))[np.ix_(self.free, self.free)], weight

    def forces(self, q: Array) -> Array:
        """Return elastic forces and weight: E A (|r'| - 1) and E I of the curvature (r' x r'') / |r'|^2."""
        nodes, (s, w) = q[self.own], self.stretched
        first = np.einsum("kg,ekc->egc", s[1], nodes)
        long = np.linalg.norm(first, axis=2)
        found = -AXIAL * np.einsum("g,eg,egc,kg->ekc", w, 1.0 - 1.0 / long, first, s[1])
        s, w = self.bent
        first, second = (np.einsum("kg,ekc->egc", s[d], nodes) for d in (1, 2))
        square = np.sum(first**2, axis=2)
        crossed = first[..., 0] * second[..., 1] - first[..., 1] * second[..., 0]
        by_first = np.stack([second[..., 1], -second[..., 0]], 2) / square[..., None]
        by_first -= 2.0 * (crossed / square**2)[..., None] * first
        by_second = np.stack([-first[..., 1], first[..., 0]], 2) / square[..., None]
        for d, slope in ((1, by_first), (2, by_second)):
            found -= BENDING * np.einsum("g,eg,egc,kg->ekc", w, crossed / square, slope, s[d])
        whole = np.zeros_like(q)
        np.add.at(whole, self.own, found)
        whole[:, 1] -= G * self.weight
        return np.asarray(whole.ravel()[self.free])

    def run(self, until: float, tolerance: float) -> tuple[Array, float]:
        """Return the centre of the body and its way along the cable; cable, way and turn are the unknowns."""
        f = len(self.free)

        def parts(y: Array) -> tuple[Array, Array, float, float, float, float]:
            q, v = self.straight.ravel().copy(), np.zeros(self.straight.size)
            q[self.free], v[self.free] = y[:f], y[f + 2 : 2 * f + 2]
            return q.reshape(-1, 2), v.reshape(-1, 2), y[f], y[f + 1], y[2 * f + 2], y[2 * f + 3]

        def seat(way: float) -> tuple[Array, Array]:
            e = int(np.clip(way // self.h, 0, self.n - 1))
            return self.own[e], shapes(way - e * self.h, self.h)

        def rates(_: float, y: Array) -> Array:
            q, v, way, turn, speed, spin = parts(y)
            own, s = seat(way)
            first, second = s[1] @ q[own], s[2] @ q[own]
            lever = HANGS * np.array([np.sin(turn), -np.cos(turn)])
            columns = np.zeros((2, *self.straight.shape))
            columns[0, own, 0] = columns[1, own, 1] = s[0]
            jacobian = np.column_stack(
                [columns.reshape(2, -1)[:, self.free], first, HANGS * np.array([np.cos(turn), np.sin(turn)])]
            )
            bias = 2.0 * (s[1] @ v[own]) * speed + second * speed**2 - lever * spin**2
            mass = MASS * jacobian.T @ jacobian
            mass[:f, :f] += self.mass
            mass[-1, -1] += TURNS
            push = jacobian.T @ (MASS * (np.array([0.1 * G, -G]) - bias))
            push[:f] += self.forces(q)
            return np.concatenate([y[f + 2 :], np.linalg.solve(mass, push)])

        start = np.concatenate([self.straight.ravel()[self.free], [0.5 * LENGTH], np.zeros(f + 3)])
        path = solve_ivp(rates, (0.0, until), start, method="Radau", rtol=tolerance, atol=1e-2 * tolerance)
        q, _, way, turn, _, _ = parts(path.y[:, -1])
        own, s = seat(way)
        return s[0] @ q[own] + HANGS * np.array([np.sin(turn), -np.cos(turn)]), way


def own_run(elements: int) -> symgen.Result:
    rod = {"start": [0.0, 0.0], "end": [LENGTH, 0.0], "elements": elements, "clamp": ["ground", ""]}
    rod |= {"axial": AXIAL, "bending": BENDING, "mass": LINE, "rotary": LINE * 1e-6 / 12.0}
    body = {"mass": MASS, "inertia": TURNS, "position": [1.0, -HANGS], "points": {"eye": [0.0, HANGS]}}
    table = {
        "mechanism": {"name": "gondola", "gravity": [0.0, -G]},
        "beams": {"rod": rod},
        "bodies": {"gondola": body},
        "joints": {"on": {"type": "slides-on", "body": "gondola", "at": "eye", "beam": "rod"}},
        "forces": {"push": {"type": "force", "body": "gondola", "force": [0.1 * MASS * G, 0.0]}},
    }
    model = symgen.Model(mechanism_of(table))
    return model.simulate(until=0.1, integrator="radau5", rtol=1e-7, atol=1e-9, verify=False)


@pytest.mark.slow
def test_three_elements_written_here_are_exudyns() -> None:
    """To 1e-7 m of a fall of 0.049 m, though steps of 0.5 ms are coarse."""
    centre, _ = Cable(3).run(0.1, 1e-4)
    assert centre[1] == pytest.approx(EXUDYN, abs=3e-7)


@pytest.mark.slow
def test_a_body_slides_as_on_cable_elements() -> None:
    """Twelve elements each, to 1e-5 m of a fall of 0.049 m and of a way of 6.7 mm; Exudyn's three are 7e-6 m apart."""
    centre, way = Cable(12).run(0.1, 1e-3)
    run = own_run(12)
    assert run.ok, run.status
    np.testing.assert_allclose([run["gondola.x"][-1], run["gondola.y"][-1]], centre, atol=1e-5)
    assert run["on.displacement"][-1] == pytest.approx(way, abs=1e-5)
    assert run["gondola.y"][-1] == pytest.approx(EXUDYN, abs=1e-5)
