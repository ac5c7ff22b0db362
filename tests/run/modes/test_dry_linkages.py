"""Random chains and loops with dry pins and stops against an event-driven reference in independent angles.

The reference shares nothing with symgen: rods in their angles, loops closed by the intersection of circles, modes by
SciPy's bounded least squares, breaking loose by its linear programs where rows at rest depend on each other.
"""

from dataclasses import dataclass, field
from functools import partial

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.optimize import linprog, lsq_linear
from support.rotation import of_turn

from symgen.base.settings import Settings
from symgen.describe.files.validate import validate
from symgen.run.planning.prepare import prepare

GRAVITY = 9.81
#: Rates that are none, accelerations that are none, forces at a bound, and rates behind an impact that end a series.
STILL, NOTHING, AT_BOUND, SERIES = 1e-10, 1e-9, 1.0 - 1e-9, 1e-6
#: Gaps at which a stop is hit, below 0, so that one that has just been hit is beyond it.
PASSED = 1e-12


def unit(angles):
    return np.stack([np.cos(angles), np.sin(angles)], axis=-1)


def across(angles):
    return np.stack([-np.sin(angles), np.cos(angles)], axis=-1)


def dependent(matrix):
    """Whether rows depend on each other."""
    return np.linalg.matrix_rank(matrix, tol=1e-8 * np.abs(matrix).max(), hermitian=True) < len(matrix)


@dataclass
class Modes:
    """Signs of the rates of pins, 0 at rest, and whether stops are closed."""

    signs: np.ndarray
    closed: np.ndarray


@dataclass
class Linkage:
    """Uniform rods, one hanging on the other; where `end` is a place, the last one ends there on the ground.

    Stops are (pin, sign, limit, restitution): the gap is the sign times the angle of the pin less the limit.
    """

    lengths: np.ndarray
    masses: np.ndarray
    torques: np.ndarray
    angles: np.ndarray
    rates: np.ndarray
    end: np.ndarray | None
    stops: list[tuple[int, float, float, float]] = field(default_factory=list)

    @classmethod
    def random(cls, seed: int) -> "Linkage":
        """One to three freedoms; loops have two rods more."""
        numbers = np.random.default_rng(seed)
        freedom, looped = 1 + seed % 3, seed % 2 == 1
        n = freedom + 2 * looped
        lengths, angles = numbers.uniform(0.4, 1.0, n), numbers.uniform(-2.5, 0.5, n)
        if looped:
            lengths[:freedom] *= 0.8 / freedom
            lengths[-2:] += 1.0
            angles[-2:] = numbers.uniform(0.3, 0.6), numbers.uniform(-0.9, -0.6)
        torques = numbers.uniform(0.3, 2.5, n + looped) * (numbers.uniform(size=n + looped) < 0.8)
        torques[0] = max(torques[0], 0.4)
        torques *= 0.3 if looped and freedom > 1 else 1.0  # so that not all come to rest
        stops = []
        for k in range(2):
            pin = k % freedom
            sign = 1.0 if k == 0 else -1.0
            at = angles[pin] - (angles[pin - 1] if pin else 0.0)
            limit = at - sign * numbers.uniform(0.15, 0.6)
            stops.append((pin, sign, float(limit), float(numbers.choice([0.0, 0.4, 0.7]))))
        rates = numbers.normal(size=freedom) * (seed % 4 != 0)
        end = (lengths[:, None] * unit(angles)).sum(axis=0) if looped else None
        return cls(lengths, numbers.uniform(0.5, 2.0, n), torques, angles, rates, end, stops)

    # -- as a file -----------------------------------------------------------------------------------------------------

    def described(self):
        raw = {"mechanism": {"name": "dry-linkage", "gravity": [0.0, -GRAVITY]}, "bodies": {}, "joints": {}}
        speeds = self.jacobian(self.angles) @ self.rates
        place, velocity = np.zeros(2), np.zeros(2)
        for i, (length, mass) in enumerate(zip(self.lengths, self.masses, strict=True)):
            along, turned = length * unit(self.angles[i]), length * speeds[i] * across(self.angles[i])
            raw["bodies"][f"b{i}"] = {
                "mass": float(mass),
                "inertia": float(mass * length**2 / 12),
                "points": {"p": [-float(length) / 2, 0.0], "q": [float(length) / 2, 0.0]},
                "position": (place + along / 2).tolist(),
                "velocity": (velocity + turned / 2).tolist(),
                "angle": float(self.angles[i]),
                "angular_velocity": float(speeds[i]),
            }
            raw["joints"][f"j{i}"] = {
                "type": "revolute",
                "between": [f"b{i - 1}" if i else "ground", f"b{i}"],
                "at": ["q" if i else [0.0, 0.0], "p"],
            }
            place, velocity = place + along, velocity + turned
        if self.end is not None:
            last = len(self.lengths) - 1
            raw["joints"][f"j{last + 1}"] = {
                "type": "revolute",
                "between": [f"b{last}", "ground"],
                "at": ["q", self.end.tolist()],
            }
        for i, torque in enumerate(self.torques):
            if torque > 0.0:
                raw["joints"][f"j{i}"]["friction"] = {"sliding": float(torque)}
        for pin, sign, limit, restitution in self.stops:
            stop = raw["joints"][f"j{pin}"].setdefault("stop", {})
            stop["lower" if sign > 0.0 else "upper"] = limit
            stop["restitution"] = restitution
        return validate(raw, "dry-linkage")

    # -- equations -----------------------------------------------------------------------------------------------------

    @property
    def freedom(self):
        return len(self.rates)

    def all_angles(self, q):
        """Return the angles of all rods; the loop is closed on the side of the start."""
        if self.end is None:
            return q
        f = self.freedom
        start = (self.lengths[:f, None] * unit(q)).sum(axis=0)
        d, (a, b) = self.end - start, self.lengths[f:]
        r = np.hypot(*d)
        side = np.sign(np.sin(self.angles[f + 1] - self.angles[f]))
        assert abs(a - b) + 0.02 < r < a + b - 0.02, "a singular position"
        first = np.arctan2(d[1], d[0]) - side * np.arccos((a**2 + r**2 - b**2) / (2 * a * r))
        rest = d - a * unit(first)
        return np.concatenate([q, [first, np.arctan2(rest[1], rest[0])]])

    def jacobian(self, angles):
        """Return the derivatives of all angles by the independent ones."""
        f = self.freedom
        if self.end is None:
            return np.eye(f)
        columns = (self.lengths[:, None] * across(angles)).T
        return np.vstack([np.eye(f), -np.linalg.solve(columns[:, f:], columns[:, :f])])

    def equations(self, y):
        """Return M, f, rows of pins and of stops, and what their accelerations have besides that of y."""
        n, f = len(self.lengths), self.freedom
        angles = self.all_angles(y[:f])
        j = self.jacobian(angles)
        speeds, bias = j @ y[f:], np.zeros(n)
        if self.end is not None:
            columns = (self.lengths[:, None] * across(angles)).T
            bias[f:] = np.linalg.solve(columns[:, f:], (self.lengths * speeds**2) @ unit(angles))
        mass, force = np.diag(self.masses * self.lengths**2 / 12), np.zeros(n)
        difference = angles[:, None] - angles[None, :]
        for k in range(n):
            arms = np.where(np.arange(n) < k, self.lengths, np.where(np.arange(n) == k, self.lengths / 2, 0.0))
            mass += self.masses[k] * np.outer(arms, arms) * np.cos(difference)
            force -= self.masses[k] * arms * (GRAVITY * np.cos(angles) + np.sin(difference) @ (arms * speeds**2))
        pins = np.eye(n) - np.eye(n, k=-1)
        if self.end is not None:
            pins = np.vstack([pins, -np.eye(n)[-1]])
        stops = np.array([sign * pins[pin] for pin, sign, _, _ in self.stops])
        rows = np.vstack([pins, stops])
        return j.T @ mass @ j, j.T @ (force - mass @ bias), rows @ j, rows @ bias

    def gaps(self, y):
        q = y[: self.freedom]
        relative = q - np.concatenate([[0.0], q[:-1]])
        return np.array([sign * (relative[pin] - limit) for pin, sign, limit, _ in self.stops])

    def held(self, modes):
        """Return the rows that have no acceleration: pins at rest with friction, then closed stops."""
        pins = len(self.torques)
        return np.concatenate(
            [np.flatnonzero((modes.signs == 0.0) & (self.torques > 0.0)), pins + np.flatnonzero(modes.closed)]
        )

    def motion(self, y, modes):
        """Return accelerations, forces of held rows, their matrix and their accelerations without forces."""
        mass, force, rows, bias = self.equations(y)
        pins, held = len(self.torques), self.held(modes)
        free = np.linalg.solve(mass, force - rows[:pins].T @ (modes.signs * self.torques))
        spread = np.linalg.solve(mass, rows[held].T)
        matrix, offset = rows[held] @ spread, rows[held] @ free + bias[held]
        forces = np.linalg.pinv(matrix, rcond=1e-10, hermitian=True) @ offset
        return free - spread @ forces, forces, matrix, offset

    # -- modes ---------------------------------------------------------------------------------------------------------

    def chosen(self, y, still, broken, touching, leaving, passing=()):
        """Return the modes: one bounded least squares problem for all rows at rest.

        Where no forces at all keep a pin at rest, as at a dead centre, its rate only passes zero.
        """
        _, _, rows, bias = self.equations(y)
        pins = len(self.torques)
        signs = np.where(still, 0.0, np.sign(rows[:pins] @ y[self.freedom :]))
        for pin, sign in passing:
            signs[pin] = sign
        modes = Modes(signs * (self.torques > 0.0), touching & ~leaving)
        held = self.held(modes)
        if len(held):
            _, _, matrix, offset = self.motion(y, modes)
            values, vectors = np.linalg.eigh(matrix)
            kept = values > 1e-10 * values.max()
            root = np.sqrt(values[kept])
            beside = np.abs(offset - vectors[:, kept] @ (vectors[:, kept].T @ offset))
            if beside.max() > 1e-6 * max(1.0, np.abs(offset).max()):
                pin = max((x for x in held if self.freedom <= x < pins), key=lambda x: beside[list(held).index(x)])
                modes.signs[pin] = 1.0
                way = np.sign(rows[pin] @ self.motion(y, modes)[0] + bias[pin])
                return self.chosen(y, still, broken, touching, leaving, (*passing, (pin, way)))
            of_pins = held < pins
            bounds = np.where(of_pins, self.torques[np.minimum(held, pins - 1)], 0.0)
            lower = np.where(of_pins, -bounds, -np.inf)
            problem = root[:, None] * vectors[:, kept].T, (vectors[:, kept].T @ offset) / root
            best = lsq_linear(*problem, (lower, bounds + 1e-300), method="bvls", tol=1e-15, max_iter=200).x
            left = offset - matrix @ best
            moves = np.abs(left) > NOTHING * max(1.0, np.abs(offset).max())
            moves[of_pins] |= broken[held[of_pins]] & (np.abs(best) >= AT_BOUND * bounds)[of_pins]
            for row, moving, force in zip(held, moves, best, strict=True):
                if moving and row < pins:
                    modes.signs[row] = np.sign(force)
                elif moving:
                    modes.closed[row - pins] = False
        while modes.closed.any():  # what pins that have broken loose leave of the forces of stops
            (_, forces, matrix, _), held = self.motion(y, modes), self.held(modes)
            least = -1e-7 if broken.any() else NOTHING  # one that pushes no more where a pin breaks loose opens
            pulling = [row - pins for row, force in zip(held, forces, strict=True) if row >= pins and force > least]
            if not pulling or dependent(matrix):
                break
            modes.closed[pulling] = False
        return modes

    def margin(self, y, modes):
        """Return what pins at rest have left, as a part of their bounds, where their rows depend on each other."""
        _, _, matrix, offset = self.motion(y, modes)
        held, pins = self.held(modes), len(self.torques)
        k, bounds = len(held), np.where(held < pins, self.torques[np.minimum(held, pins - 1)], 0.0)
        values, vectors = np.linalg.eigh(matrix)
        kept = vectors[:, values > 1e-10 * values.max()].T
        values = values[values > 1e-10 * values.max()]
        of_pins = np.flatnonzero(held < pins)
        above = np.zeros((2 * len(of_pins), k + 1))
        for line, i in enumerate(of_pins):
            above[2 * line, i], above[2 * line + 1, i], above[2 * line : 2 * line + 2, k] = 1.0, -1.0, -bounds[i]
        sides = [(None, None) if row < pins else (None, 0.0) for row in held] + [(0.0, None)]
        balance = np.hstack([values[:, None] * kept, np.zeros((len(values), 1))])
        found = linprog([*np.zeros(k), 1.0], above, np.zeros(len(above)), balance, kept @ offset, sides)
        return 1.0 - found.x[-1] if found.status == 0 else -1.0

    # -- a run ---------------------------------------------------------------------------------------------------------

    def impact(self, y, modes):
        """Strike all stops that are touched; return the state behind that."""
        mass, _, rows, _ = self.equations(y)
        f, pins = self.freedom, len(self.torques)
        touched = np.flatnonzero(self.gaps(y) <= 1e-9)
        rows = rows[pins + touched]
        rates = rows @ y[f:]
        if not (rates < -STILL).any():
            return y
        spread = np.linalg.solve(mass, rows.T)
        e = np.array([self.stops[i][3] for i in touched])
        lower = np.linalg.cholesky(rows @ spread)
        wanted = -np.linalg.solve(lower, rates + e * np.minimum(rates, 0.0))
        pushed = lsq_linear(lower.T, wanted, (0.0, np.inf), method="bvls", tol=1e-15).x
        after = np.concatenate([y[:f], y[f:] + spread @ pushed])
        back = rows @ after[f:]
        if len(touched) == 1 and 0.0 < back[0] < SERIES:  # of a series of impacts
            after[f:] -= spread[:, 0] * back[0] / (rows @ spread)[0, 0]
        return after

    def functions(self, modes):
        """Return the functions that end a motion in some modes, with the rows that break loose or leave there."""
        pins, held, f = len(self.torques), self.held(modes), self.freedom
        none = np.zeros(pins, dtype=bool), np.zeros(len(self.stops), dtype=bool)
        found = []
        for i in np.flatnonzero(modes.signs):
            found.append((lambda t, y, i=i: modes.signs[i] * (self.equations(y)[2][i] @ y[f:]), i, *none))
        for i in np.flatnonzero(~modes.closed):
            found.append((lambda t, y, i=i: self.gaps(y)[i] + PASSED, None, *none))
        if not len(held):
            return found
        matrix = self.motion(self.here, modes)[2]
        if dependent(matrix):
            broken = np.isin(np.arange(pins), held)
            return [*found, (lambda t, y: self.margin(y, modes), None, broken, none[1])]
        for k, row in enumerate(held):
            if row < pins:
                broken = np.arange(pins) == row

                def left(t, y, k=k, row=row):
                    return self.torques[row] - abs(self.motion(y, modes)[1][k])

                found.append((left, None, broken, none[1]))
            else:
                leaving = np.arange(len(self.stops)) == row - pins
                found.append((lambda t, y, k=k: -self.motion(y, modes)[1][k], None, none[0], leaving))
        return found

    def run(self, until):
        """Return the angles and their rates at the end, and the number of ends of motions."""
        f, pins, t, count = self.freedom, len(self.torques), 0.0, 0
        y = np.concatenate([self.angles[:f], self.rates])
        none = np.zeros(pins, dtype=bool), np.zeros(len(self.stops), dtype=bool)
        modes = self.chosen(y, np.abs(self.equations(y)[2][:pins] @ y[f:]) < STILL, none[0], none[1], none[1])
        while True:
            self.here = y
            functions = self.functions(modes)
            events = []
            for function, *_ in functions:
                event = partial(lambda g, t, y: g(t, y), function)
                event.terminal, event.direction = True, -1
                events.append(event)
            rate = partial(lambda modes, t, y: np.concatenate([y[f:], self.motion(y, modes)[0]]), modes)
            found = solve_ivp(rate, (t, until), y, method="DOP853", rtol=1e-12, atol=1e-13, events=events)
            assert found.status >= 0
            t, y = found.t[-1], found.y[:, -1]
            if found.status != 1:
                angles = self.all_angles(y[:f])
                return angles, self.jacobian(angles) @ y[f:], count
            broken, leaving, stopped = none[0].copy(), none[1].copy(), []
            for (_, row, loose, opened), times in zip(functions, found.t_events, strict=True):
                if len(times):
                    broken, leaving = broken | loose, leaving | opened
                    stopped += [] if row is None else [row]
            struck = self.impact(y, modes)
            rates = self.equations(struck)[2] @ struck[f:]
            still = np.abs(rates[:pins]) < STILL
            if np.array_equal(struck, y):
                still |= modes.signs == 0.0
                still[stopped] = True
            touching = (self.gaps(struck) <= 1e-9) & (np.abs(rates[pins:]) < STILL)
            y = struck
            modes, count = self.chosen(y, still, broken & still, touching, leaving), count + 1
            assert count < 400


def after_one_second(linkage, coordinates):
    settings = Settings(integrator="dop853", until=1.0, verify=False, rtol=1e-12, atol=1e-12, coordinates=coordinates)
    run = prepare(linkage.described(), settings)
    return run.of_bodies(run.integrate())


#: Chains, and loops of one to three freedoms that stay away from singular positions.
SEEDS = (0, 1, 2, 3, 4, 5, 6, 8, 9, 10, 11, 25, 29)


@pytest.mark.slow
@pytest.mark.parametrize("seed", [43, *of_turn(SEEDS, 9)])
def test_random_linkages_agree_with_the_reference(seed: int) -> None:
    """In the 43rd the last pin of a loop passes a dead centre while a stop holds the first one."""
    linkage = Linkage.random(seed)
    angles, rates, count = linkage.run(1.0)
    assert count > 0
    n = len(linkage.lengths)
    for coordinates in ("absolute", "joint"):
        outcome = after_one_second(linkage, coordinates)
        assert outcome.reason == ""
        state = outcome.states[-1]
        difference = (state[2 : 3 * n : 3] - angles + np.pi) % (2.0 * np.pi) - np.pi
        np.testing.assert_allclose(difference, 0.0, rtol=0, atol=1e-8)
        np.testing.assert_allclose(state[3 * n + 2 : 6 * n : 3], rates, rtol=0, atol=1e-7)
