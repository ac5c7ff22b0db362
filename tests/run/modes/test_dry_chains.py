"""Random chains with dry pins against event-driven references in angles, with SciPy's least squares for modes."""

from dataclasses import dataclass
from functools import cache, partial

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.optimize import lsq_linear

from symgen.base.settings import Settings
from symgen.describe.files.validate import validate
from symgen.run.planning.prepare import prepare

GRAVITY = 9.81


@dataclass
class Chain:
    """Uniform rods, one hanging on the other; dry torques of their pins, angles and angular velocities at the start."""

    lengths: np.ndarray
    masses: np.ndarray
    sliding: np.ndarray
    static: np.ndarray
    angles: np.ndarray
    speeds: np.ndarray

    @classmethod
    def random(cls, seed: int, moving: bool) -> "Chain":
        numbers = np.random.default_rng(seed)
        n = 2 + seed % 2
        sliding = numbers.uniform(0.3, 4.0, n)
        return cls(
            numbers.uniform(0.3, 1.0, n),
            numbers.uniform(0.5, 2.0, n),
            sliding,
            sliding * numbers.choice([1.0, 1.4], n),
            numbers.uniform(-3.0, 3.0, n),
            numbers.normal(size=n) * moving,
        )

    def friction(self, i):
        return {"sliding": float(self.sliding[i]), "static": float(self.static[i])}

    def described(self):
        raw = {"mechanism": {"name": "dry-chain", "gravity": [0.0, -GRAVITY]}, "bodies": {}, "joints": {}}
        place, velocity = np.zeros(2), np.zeros(2)
        for i, (length, mass, angle, speed) in enumerate(
            zip(self.lengths, self.masses, self.angles, self.speeds, strict=True)
        ):
            along = length * np.array([np.cos(angle), np.sin(angle)])
            turned = speed * np.array([-along[1], along[0]])
            raw["bodies"][f"b{i}"] = {
                "mass": float(mass),
                "inertia": float(mass * length**2 / 12),
                "points": {"p": [-float(length) / 2, 0.0], "q": [float(length) / 2, 0.0]},
                "position": (place + along / 2).tolist(),
                "velocity": (velocity + turned / 2).tolist(),
                "angle": float(angle),
                "angular_velocity": float(speed),
            }
            raw["joints"][f"j{i}"] = {
                "type": "revolute",
                "between": [f"b{i - 1}" if i else "ground", f"b{i}"],
                "at": ["q" if i else [0.0, 0.0], "p"],
                "friction": self.friction(i),
            }
            place, velocity = place + along, velocity + turned
        return validate(raw, "dry-chain")

    def equations(self, y):
        """Return M and f in the angles of the rods."""
        n = len(self.lengths)
        angles, speeds = y[:n], y[n:]
        mass, force = np.diag(self.masses * self.lengths**2 / 12), np.zeros(n)
        difference = angles[:, None] - angles[None, :]
        for k in range(n):
            arms = np.where(np.arange(n) < k, self.lengths, np.where(np.arange(n) == k, self.lengths / 2, 0.0))
            mass += self.masses[k] * np.outer(arms, arms) * np.cos(difference)
            force -= self.masses[k] * arms * (GRAVITY * np.cos(angles) + np.sin(difference) @ (arms * speeds**2))
        return mass, force

    def motion(self, y, signs):
        """Return accelerations and the torques of pins at rest."""
        rows = np.eye(len(signs)) - np.eye(len(signs), k=-1)
        mass, force = self.equations(y)
        free, torques = np.linalg.solve(mass, force - rows.T @ (signs * self.sliding)), np.zeros(len(signs))
        rest = np.flatnonzero(signs == 0.0)
        spread = np.linalg.solve(mass, rows[rest].T)
        torques[rest] = np.linalg.solve(rows[rest] @ spread, rows[rest] @ free)
        return free - spread @ torques[rest], torques

    def chosen(self, y, still, broken):
        """Return the signs of the pins' rates, 0 at rest: static bounds first, those in motion for what is loose."""
        n = len(still)
        rows = np.eye(n) - np.eye(n, k=-1)
        mass, force = self.equations(y)
        signs = np.where(still, 0.0, np.sign(rows @ y[n:]))
        rest = np.flatnonzero(still)
        if not len(rest):
            return signs
        lower = np.linalg.cholesky(mass)
        columns = np.linalg.solve(lower, rows[rest].T)
        right = np.linalg.solve(lower, force - rows.T @ (signs * self.sliding))
        bounds = np.where(broken, self.sliding, self.static)[rest]
        while True:
            torques = lsq_linear(columns, right, (-bounds, bounds), method="bvls", tol=1e-15, max_iter=200).x
            moves = np.abs(columns.T @ (right - columns @ torques)) > 1e-9
            if not (over := moves & (bounds > self.sliding[rest])).any():
                break
            bounds = np.where(over, self.sliding[rest], bounds)
        moves |= broken[rest] & (np.abs(torques) >= bounds * (1.0 - 1e-9))
        signs[rest] = np.where(moves, np.sign(torques), 0.0)
        return signs

    def function(self, signs, i, t, y):
        n = len(signs)
        if signs[i] != 0.0:
            return signs[i] * (y[n + i] - (y[n + i - 1] if i else 0.0))
        return self.static[i] - abs(self.motion(y, signs)[1][i])

    def run(self, until):
        """Return the state at the end, and the number of transitions."""
        n, t, y = len(self.lengths), 0.0, np.concatenate([self.angles, self.speeds])
        nothing = np.zeros(n, dtype=bool)
        rows = np.eye(n) - np.eye(n, k=-1)
        signs, count = self.chosen(y, np.abs(rows @ y[n:]) < 1e-12, nothing), 0
        while True:
            events = []
            for i in range(n):
                event = partial(self.function, signs, i)
                event.terminal, event.direction = True, -1
                events.append(event)
            rate = partial(lambda signs, t, y: np.concatenate([y[n:], self.motion(y, signs)[0]]), signs)
            found = solve_ivp(rate, (t, until), y, method="DOP853", rtol=1e-12, atol=1e-13, events=events)
            t, y = found.t[-1], found.y[:, -1]
            if found.status != 1:
                return y, count
            hit = np.array([len(times) > 0 for times in found.t_events])
            still = (signs == 0.0) | hit | (np.abs(rows @ y[n:]) < 1e-10)
            signs, count = self.chosen(y, still, hit & (signs == 0.0)), count + 1


class Rubbing(Chain):
    """The same with torques by the reactions of pins: `sliding` and `static` are mu r [m]."""

    @classmethod
    def random(cls, seed: int, moving: bool) -> "Rubbing":
        chain = super().random(seed, moving)
        chain.sliding, chain.static = 0.03 * chain.sliding, 0.03 * chain.static
        return chain

    def friction(self, i):
        return {"coefficient": float(self.sliding[i]), "static_coefficient": float(self.static[i]), "radius": 1.0}

    def pressed(self, y, accelerations):
        """Return the forces of pins on the rods below: of gravity and inertia of all rods from each one on."""
        n = len(self.lengths)
        e, across = np.array([np.cos(y[:n]), np.sin(y[:n])]).T, np.array([-np.sin(y[:n]), np.cos(y[:n])]).T
        ends = self.lengths[:, None] * (accelerations[:, None] * across - (y[n:] ** 2)[:, None] * e)
        centres = np.cumsum(ends, axis=0) - ends / 2 + np.array([0.0, GRAVITY])
        return np.cumsum((self.masses[:, None] * centres)[::-1], axis=0)[::-1]

    def linear(self, y):
        """Return accelerations and forces of pins without friction, and what unit torques take from both."""
        mass, force = self.equations(y)
        n = len(force)
        rows = np.eye(n) - np.eye(n, k=-1)
        x = np.linalg.solve(mass, np.column_stack([force, rows.T]))
        none = self.pressed(y, np.zeros(n))
        parts = np.array([self.pressed(y, x[:, 1 + j]) - none for j in range(n)])
        return x[:, 0], x[:, 1:], self.pressed(y, x[:, 0]), parts

    @staticmethod
    def sizes(alone, parts, torques):
        return np.sqrt(((alone - np.tensordot(torques, parts, 1)) ** 2).sum(axis=1))

    def motion(self, y, signs):
        return self.moved(y, signs)[:2]

    def moved(self, y, signs):
        n = len(signs)
        free, spread, alone, parts = self.linear(y)
        rows, rest, torques = np.eye(n) - np.eye(n, k=-1), np.flatnonzero(signs == 0.0), np.zeros(n)
        relative, matrix = rows @ free, rows @ spread
        among = np.linalg.inv(matrix[np.ix_(rest, rest)])
        for _ in range(500):
            before, size = torques, self.sizes(alone, parts, torques)
            torques = signs * self.sliding * size
            torques[rest] = among @ (relative - matrix @ torques)[rest]
            if np.abs(torques - before).max() < 1e-14:
                break
        return free - spread @ torques, torques, size

    def chosen(self, y, still, broken):
        n = len(still)
        rows = np.eye(n) - np.eye(n, k=-1)
        mass, force = self.equations(y)
        signs = np.where(still, 0.0, np.sign(rows @ y[n:]))
        rest = np.flatnonzero(still)
        if not len(rest):
            return signs
        lower = np.linalg.cholesky(mass)
        columns = np.linalg.solve(lower, rows[rest].T)
        torques, (_, _, alone, parts) = self.motion(y, signs)[1], self.linear(y)
        coefficients = np.where(broken, self.sliding, self.static)[rest]
        while True:
            for _ in range(500):
                before, size = torques.copy(), self.sizes(alone, parts, torques)
                torques = signs * self.sliding * size
                right, bounds = np.linalg.solve(lower, force - rows.T @ torques), coefficients * size[rest]
                torques[rest] = lsq_linear(columns, right, (-bounds, bounds), method="bvls", tol=1e-15, max_iter=200).x
                if np.abs(torques - before).max() < 1e-13:
                    break
            moves = np.abs(columns.T @ (right - columns @ torques[rest])) > 1e-9
            if not (over := moves & (coefficients > self.sliding[rest])).any():
                break
            coefficients = np.where(over, self.sliding[rest], coefficients)
        moves |= broken[rest] & (np.abs(torques[rest]) >= bounds * (1.0 - 1e-9))
        signs[rest] = np.where(moves, np.sign(torques[rest]), 0.0)
        return signs

    def function(self, signs, i, t, y):
        if signs[i] != 0.0:
            return super().function(signs, i, t, y)
        _, torques, size = self.moved(y, signs)
        return self.static[i] * size[i] - abs(torques[i])


@cache
def reference(kind: type[Chain], seed: int, moving: bool) -> tuple[np.ndarray, int]:
    """Return the state of a chain after 1 s, and the number of its transitions."""
    return kind.random(seed, moving).run(1.0)


@pytest.mark.by_turns(4)
@pytest.mark.fast("Chain-4-True-absolute")
@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
@pytest.mark.parametrize(
    ("kind", "seed", "moving"),
    [*((Chain, *x) for x in ((1, False), (2, True), (3, True), (4, True))), (Rubbing, 5, True)],
)
def test_random_chains(kind: type[Chain], seed: int, moving: bool, coordinates: str) -> None:
    chain = kind.random(seed, moving)
    end, count = reference(kind, seed, moving)
    settings = Settings(integrator="dop853", until=1.0, verify=False, rtol=1e-12, atol=1e-12, coordinates=coordinates)
    run = prepare(chain.described(), settings)
    outcome = run.of_bodies(run.integrate())
    assert outcome.reason == ""
    assert len({event.t for event in outcome.happened}) == count
    n = len(chain.lengths)
    np.testing.assert_allclose(outcome.states[-1][2 : 3 * n : 3], end[:n], rtol=0, atol=1e-8)
