"""Modes of contacts and of impacts: all combinations are solved for, and those kept that are right."""

from __future__ import annotations

import itertools
from collections.abc import Collection
from dataclasses import dataclass

import numpy as np

from benchmarks.bounded.touch.bodies import Array, Scene

#: Modes: at rest along the contact, or sliding one of two ways.
REST, UP, DOWN = 0, 1, -1
#: Rates of slip below this are zero [m/s], and rounding over sizes.
STILL, _ROUNDING, _SOLVED = 1e-9, 1e-9, 1e-8

Modes = dict[int, int]


class Unsolved(Exception):
    """No combination of modes is right, or several of different accelerations."""


@dataclass
class Answer:
    """Accelerations (or velocities) in some modes, with the forces of gaps and along them."""

    modes: Modes
    value: Array
    normal: dict[int, float]
    along: dict[int, float]
    rates: Array


class Problem:
    """Rows at one state, of all contacts or of some: M x = f + rows' forces, rows x = targets."""

    def __init__(self, scene: Scene, q: Array, v: Array, which: Collection[int] | None = None) -> None:
        self.scene, self.q, self.v = scene, q, v
        rows, self.gained, masses = scene.all_rows(q, v, which)
        self.joints, n = len(rows) - 2 * len(scene.contacts), len(scene.contacts)
        self.held, self.gap, self.slip = rows[: self.joints], rows[self.joints : -n], rows[-n:]
        self.masses, self.n = masses, n
        self.force = scene.forces(q, v)

    def solve(self, modes: Modes, friction: Array, free: Array, targets: tuple[Array, Array, Array]) -> Answer:
        """Return the solution for free values (of accelerations, or velocities), where rows have the targets."""
        rows, columns, right, names = [*self.held], [*self.held], [*targets[0]], [(-1, 0)] * self.joints
        for i, mode in modes.items():
            rows.append(self.gap[i])
            right.append(targets[1][i])
            names.append((i, 0))
            columns.append(self.gap[i] if mode == REST else self.gap[i] - mode * friction[i] * self.slip[i])
            if mode == REST and self.scene.contacts[i].static > 0.0:
                rows.append(self.slip[i])
                columns.append(self.slip[i])
                right.append(targets[2][i])
                names.append((i, 1))
        if not rows:
            return Answer(dict(modes), free, {}, {}, np.concatenate([self.gap, self.slip]) @ free)
        taken = np.array(columns).T / self.masses[:, None]
        matrix, left = np.array(rows) @ taken, np.array(right) - np.array(rows) @ free
        forces: Array = np.linalg.lstsq(matrix, left, rcond=1e-11)[0].astype(float)
        if np.abs(matrix @ forces - left).max() > _SOLVED * (1.0 + np.abs(left).max()):
            raise Unsolved("rows contradict each other")
        forces = self.shared(matrix, forces, names)
        normal = {i: float(f) for (i, k), f in zip(names, forces, strict=True) if i >= 0 and k == 0}
        along = {i: float(f) for (i, k), f in zip(names, forces, strict=True) if i >= 0 and k == 1}
        for i, mode in modes.items():
            if i not in along:
                along[i] = -mode * friction[i] * normal[i]
        value = free + taken @ forces
        return Answer(dict(modes), value, normal, along, np.concatenate([self.gap, self.slip]) @ value)

    def shared(self, matrix: Array, forces: Array, names: list[tuple[int, int]]) -> Array:
        """Return forces of which those at rest that depend on each other have equal parts of their bounds."""
        _, sizes, rows = np.linalg.svd(matrix)
        spare = rows[np.sum(sizes > 1e-9 * sizes[0]) :].T
        pressed = {i: f for (i, k), f in zip(names, forces, strict=True) if k == 0}
        bounds = [self.scene.contacts[i].static * max(pressed[i], 1e-12) if k == 1 else np.inf for i, k in names]
        weights = 1.0 / np.sqrt(bounds)  # the least sum of force^2 / bound
        fixed = [j for j, (i, k) in enumerate(names) if i >= 0 and k == 0]
        if spare.shape[1] == 0 or np.abs(spare[fixed]).max(initial=0.0) > 1e-9:
            return forces
        part: Array = np.linalg.lstsq(weights[:, None] * spare, -weights * forces, rcond=1e-9)[0]
        total: Array = forces + spare @ part
        return total


def _options(closed: list[int], rates: Array, scene: Scene, forced: Modes) -> list[list[int | None]]:
    found: list[list[int | None]] = []
    for i in closed:
        if i in forced:
            found.append([forced[i]])
        elif scene.contacts[i].static == 0.0:
            found.append([None, REST])
        elif abs(rates[i]) > STILL:
            found.append([None, UP if rates[i] > 0.0 else DOWN])
        else:
            found.append([None, REST, UP, DOWN])
    return found


def accelerations(problem: Problem, modes: Modes, friction: Array) -> Answer:
    """Return the accelerations in some modes."""
    m, n = problem.joints, problem.n
    targets = -problem.gained[:m], -problem.gained[m : m + n], -problem.gained[m + n :]
    return problem.solve(modes, friction, problem.force / problem.masses, targets)


def choose(scene: Scene, q: Array, v: Array, closed: list[int], forced: Modes, loose: set[int]) -> Answer:
    """Return the accelerations in the modes that are right; `forced` slide, `loose` have the coefficient of motion.

    Raises
    ------
    Unsolved
        If there are none, or several with different accelerations.
    """
    problem = Problem(scene, q, v)
    rates = problem.slip @ v
    sliding = np.array([contact.sliding for contact in scene.contacts])
    static = np.array([contact.static for contact in scene.contacts])
    while True:
        own = [abs(rates[i]) > STILL or i in loose or i in forced for i in range(problem.n)]
        friction = np.where(own, sliding, static)
        good = _right_ones(problem, closed, rates, friction, forced)
        breaks = {i for i, mode in good.modes.items() if mode != REST and not own[i] and static[i] > sliding[i]}
        if not breaks:
            return good
        loose = loose | breaks


def _right_ones(problem: Problem, closed: list[int], rates: Array, friction: Array, forced: Modes) -> Answer:
    good: list[Answer] = []
    n, m = problem.n, problem.joints
    for choice in itertools.product(*_options(closed, rates, problem.scene, forced)):
        modes = {i: mode for i, mode in zip(closed, choice, strict=True) if mode is not None}
        try:
            answer = accelerations(problem, modes, friction)
        except Unsolved:
            continue
        gap, slip = np.split(answer.rates + problem.gained[m:], [n])
        size = 1.0 + np.abs(gap[closed]).max(initial=0.0) + np.abs(slip[closed]).max(initial=0.0)
        most = 1.0 + max((abs(f) for f in answer.normal.values()), default=0.0)
        right = all(gap[i] >= -_ROUNDING * size for i in closed if i not in modes)
        right &= all(f >= -_ROUNDING * most for f in answer.normal.values())
        for i, mode in modes.items():
            if mode == REST and problem.scene.contacts[i].static > 0.0:
                right &= abs(answer.along[i]) <= friction[i] * answer.normal[i] + _ROUNDING * most
            elif mode != REST and abs(rates[i]) <= STILL and i not in forced:
                right &= mode * slip[i] >= -_ROUNDING * size
        if right:
            good.append(answer)
    return _only(good)


def _only(good: list[Answer]) -> Answer:
    """Return the answer of most modes at rest, where all have the same accelerations."""
    if not good:
        raise Unsolved("no modes")
    size = 1.0 + max(float(np.abs(answer.value).max()) for answer in good)
    if any(np.abs(answer.value - good[0].value).max() > 1e-6 * size for answer in good):
        raise Unsolved("several motions")
    return max(good, key=lambda answer: (len(answer.modes), sum(mode == REST for mode in answer.modes.values())))


def impact(scene: Scene, q: Array, v: Array, touching: list[int], slow: float) -> Answer:
    """Return the velocities after an impact of gaps that are zero: Newton for them, Coulomb for impulses along them.

    Gaps that close more slowly than `slow` do not spring back.

    Raises
    ------
    Unsolved
        As of `choose`.
    """
    problem = Problem(scene, q, v)
    before = problem.gap @ v
    own = np.array([contact.restitution for contact in scene.contacts])
    after = np.where(before < -slow, -own * before, 0.0)
    friction = np.array([contact.sliding for contact in scene.contacts])
    targets = np.zeros(problem.joints), after, np.zeros(problem.n)
    good: list[Answer] = []
    options = [[None, REST] if scene.contacts[i].static == 0.0 else [None, REST, UP, DOWN] for i in touching]
    for choice in itertools.product(*options):
        modes = {i: mode for i, mode in zip(touching, choice, strict=True) if mode is not None}
        try:
            answer = problem.solve(modes, friction, v, targets)
        except Unsolved:
            continue
        gap, slip = np.split(answer.rates, [problem.n])
        size = 1e-300 + np.abs(problem.gap @ v).max() + np.abs(problem.slip @ v).max()
        most = max((abs(f) for f in answer.normal.values()), default=0.0)
        right = all(gap[i] >= after[i] - _ROUNDING * size for i in touching)
        right &= all(f >= -_ROUNDING * most for f in answer.normal.values())
        for i, mode in modes.items():
            if mode == REST and scene.contacts[i].static > 0.0:
                right &= abs(answer.along[i]) <= friction[i] * answer.normal[i] + _ROUNDING * most
            elif mode != REST:
                right &= mode * slip[i] >= -_ROUNDING * size
        if right:
            good.append(answer)
    return _only(good)


def brought_to_rest(scene: Scene, q: Array, v: Array, touching: list[int]) -> Array:
    """Return the velocities where gaps do not open, which strike in turn ever more slowly; slips go on their way."""
    problem = Problem(scene, q, v)
    rates, friction = problem.slip @ v, np.array([contact.sliding for contact in scene.contacts])
    modes = {i: REST if abs(rates[i]) <= STILL else UP if rates[i] > 0.0 else DOWN for i in touching}
    none = np.zeros(problem.n)
    return problem.solve(modes, friction, v, (np.zeros(problem.joints), none, none)).value
