"""What gaps and friction do at one state, or at one impact: sought by signs, and verified.

A mode says of each gap whether it is closed, and of each friction whether it is at rest (0) or the sign of its rate.
Forces at rest that are many are those that are farthest within their bounds.
"""

from __future__ import annotations

import itertools
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from scipy.optimize import linprog

from benchmarks.bounded.rubbing.bodies import Machine
from benchmarks.bounded.touch.bodies import Array

#: Rates below this are zero [m/s, rad/s], and rounding over sizes.
STILL, _ROUNDING = 1e-9, 1e-9
#: Turns of loads that are lengths, of signs, most combinations that are tried where signs do not settle, and shares.
_TURNS, _SIGNS, _MOST, _SHARES = 60, 30, 6000, 3


class Unsolved(Exception):
    """No mode is right."""


@dataclass(frozen=True)
class Mode:
    """Closed gaps, and what each friction does."""

    closed: frozenset[int]
    ways: tuple[int, ...]


@dataclass
class Answer:
    """Accelerations (or velocities after an impact) in a mode, and the forces (or impulses) of all rows."""

    mode: Mode
    value: Array
    joints: Array
    pushes: Array
    rubs: Array
    bounds: Array


class State:
    """Rows of a machine at one state."""

    def __init__(self, machine: Machine, t: float, q: Array, v: Array) -> None:
        self.machine, self.q, self.v = machine, q, v
        self.rows, self.gained = machine.rows(q, v)
        self.places = machine.places()
        self.m, self.n, self.k = self.places[-1].stop, len(machine.gaps), len(machine.rubs)
        self.gap, self.rub = self.rows[self.m : self.m + self.n], self.rows[self.m + self.n :]
        self.free = machine.force(t, q, v) / machine.masses

    def solve(self, mode: Mode, factors: Array, free: Array, target: Array, judged: bool = True) -> Answer:
        """Return the solution in a mode: `factors` are beta and kappa of all that rubs, `target` of all rows' rates.

        Where it is not `judged`, forces that are many are any of them: what they leave is the same.
        """
        closed, m, n = sorted(mode.closed), self.m, self.n
        resting = [i for i, way in enumerate(mode.ways) if way == 0]
        moving = [i for i, way in enumerate(mode.ways) if way != 0]
        names = [*range(m), *(m + j for j in closed), *(m + n + i for i in resting)]
        rows, right = self.rows[names], target[names] - self.rows[names] @ free
        at, forces = {name: place for place, name in enumerate(names)}, np.zeros(len(names))
        for turn in range(_TURNS):
            columns, offset = rows.copy(), np.zeros(len(free))
            for i in moving:
                rub, push = self.machine.rubs[i], -mode.ways[i] * self.rub[i]
                offset += factors[i, 0] * push
                if rub.gap >= 0 and m + rub.gap in at:
                    columns[at[m + rub.gap]] += factors[i, 1] * push
                elif rub.joint >= 0:
                    place = self.places[rub.joint]
                    size = float(np.linalg.norm(forces[place]))
                    if size > 0.0:
                        columns[place] += factors[i, 1] * np.outer(forces[place] / size, push)
            taken = columns.T / self.machine.masses[:, None]
            matrix, left = rows @ taken, right - rows @ (offset / self.machine.masses)
            found = _solution(matrix, left)
            settled = turn > 0 and np.abs(found - forces).max(initial=0.0) <= 1e-14 * np.abs(found).max(initial=0.0)
            forces = found
            if settled or not any(self.machine.rubs[i].joint >= 0 for i in moving):
                break
        if judged:
            forces = self._shared(matrix, forces, resting, closed, factors)
        value = free + offset / self.machine.masses + taken @ forces
        pushes, rubs = np.zeros(n), np.zeros(self.k)
        pushes[closed], rubs[resting] = forces[m : m + len(closed)], forces[m + len(closed) :]
        bounds = self._bounds(forces[:m], pushes, factors)
        for i in moving:
            rubs[i] = -mode.ways[i] * bounds[i]
        return Answer(mode, value, forces[:m], pushes, rubs, bounds)

    def _bounds(self, joints: Array, pushes: Array, factors: Array) -> Array:
        """Return the bounds of all that rubs."""
        loads = np.zeros(self.k)
        for i, rub in enumerate(self.machine.rubs):
            if rub.gap >= 0:
                loads[i] = pushes[rub.gap]
            elif rub.joint >= 0:
                loads[i] = np.linalg.norm(joints[self.places[rub.joint]])
        return np.asarray(factors[:, 0] + factors[:, 1] * loads)

    def _shared(self, matrix: Array, forces: Array, resting: list[int], closed: list[int], factors: Array) -> Array:
        """Return forces of which those at rest that are many are as far within their bounds as they can be."""
        if not len(matrix) or not resting:
            return forces
        _, sizes, rows = np.linalg.svd(matrix)
        spare = rows[int(np.sum(sizes > 1e-9 * sizes[0])) :].T
        if not spare.shape[1]:
            return forces
        first, m = self.m + len(closed), self.m
        for _ in range(_SHARES):
            bounds = np.zeros((len(resting), 1 + len(forces)))  # constant parts, and slopes by all forces
            for line, i in zip(bounds, resting, strict=True):
                rub = self.machine.rubs[i]
                line[0] = factors[i, 0]
                if rub.gap in closed:
                    line[1 + m + closed.index(rub.gap)] = factors[i, 1]
                elif rub.joint >= 0:
                    place, size = self.places[rub.joint], float(np.linalg.norm(forces[self.places[rub.joint]]))
                    line[1 + place.start : 1 + place.stop] = factors[i, 1] * forces[place] / max(size, 1e-300)
            own, room = spare[first:], bounds[:, :1] + bounds[:, 1:] @ forces[:, None]
            ones, push = np.ones((len(resting), 1)), -spare[m:first]
            lines = np.vstack(
                [
                    np.hstack([own - bounds[:, 1:] @ spare, ones]),
                    np.hstack([-own - bounds[:, 1:] @ spare, ones]),
                    np.hstack([push, np.zeros((len(closed), 1))]),
                ]
            )
            right = np.concatenate([room[:, 0] - forces[first:], room[:, 0] + forces[first:], forces[m:first]])
            scale = 1.0 + float(np.abs(forces).max())
            limits = [(-1e3 * scale, 1e3 * scale)] * (spare.shape[1] + 1)
            best = linprog(np.append(np.zeros(spare.shape[1]), -1.0), lines, right, bounds=limits)
            if best.x is None:
                break
            forces = forces + spare @ best.x[:-1]
        return forces


def _solution(matrix: Array, left: Array) -> Array:
    """Return the least solution of equations that may depend on each other.

    Raises
    ------
    Unsolved
        If they contradict each other.
    """
    if not len(left):
        return left
    found: Array = np.linalg.lstsq(matrix, left, rcond=1e-11)[0]
    if np.abs(matrix @ found - left).max() > 1e-8 * (1.0 + np.abs(left).max()):
        raise Unsolved("rows contradict each other")
    return found


def factors_of(machine: Machine, loose: set[int]) -> Array:
    """Return beta and kappa of all that rubs: in motion of those that are loose, at rest of the others."""
    return np.array([rub.sliding if i in loose else rub.static for i, rub in enumerate(machine.rubs)]).reshape(-1, 2)


def accelerate(state: State, mode: Mode, factors: Array, judged: bool = True) -> Answer:
    """Return the accelerations in a mode."""
    return state.solve(mode, factors, state.free, -state.gained, judged)


def choose(state: State, closed: list[int], forced: dict[int, int]) -> tuple[Answer, set[int]]:
    """Return the accelerations in the mode that is right, and what is loose: it moves, or begins to.

    What moves has its coefficients of motion; of what rests the least set breaks loose that has to. `forced` begin to
    move in a direction.

    Raises
    ------
    Unsolved
        If there is none.
    """
    rates = state.rub @ state.v
    moving = {i for i in range(state.k) if abs(rates[i]) > STILL or i in forced}
    ways = [forced.get(i, int(np.sign(rates[i])) if i in moving else 0) for i in range(state.k)]
    for count in range(state.k - len(moving) + 1):
        for further in itertools.combinations([i for i in range(state.k) if i not in moving], count):
            loose = moving | set(further)
            kinds = [state.machine.rubs[i].static != state.machine.rubs[i].sliding for i in further]
            if not all(kinds):
                continue
            answer = _right(state, closed, ways, moving, factors_of(state.machine, loose), None)
            begins = {i for i, way in enumerate(answer.mode.ways) if way and i not in moving} if answer else set()
            if answer and all(
                i in loose or state.machine.rubs[i].static == state.machine.rubs[i].sliding for i in begins
            ):
                return answer, moving | begins
    raise Unsolved("no modes")


def strike(state: State, closed: list[int], slow: float) -> Answer:
    """Return the velocities after an impact: Newton for gaps, and the laws of friction for impulses.

    Gaps that close more slowly than `slow` do not spring back. A machine that is at rest but for rounding stops.
    """
    if np.abs(state.v).max() < 1e-6 * STILL:
        none = np.zeros(state.n), np.zeros(state.k), np.zeros(state.k)
        return Answer(Mode(frozenset(closed), (0,) * state.k), 0.0 * state.v, np.zeros(state.m), *none)
    factors = factors_of(state.machine, set(range(state.k)))
    factors[:, 0] = 0.0
    own = np.array([gap.restitution for gap in state.machine.gaps])
    before = state.gap @ state.v
    after = np.zeros(len(state.rows))
    after[state.m : state.m + state.n] = np.where(before < -slow, -own * before, 0.0)
    ways = [int(np.sign(rate)) for rate in state.rub @ state.v]
    answer = _right(state, closed, ways, set(), factors, after)
    if answer is None:
        raise Unsolved("no impulses")
    return answer


def _right(
    state: State, closed: list[int], ways: list[int], moving: set[int], factors: Array, after: Array | None
) -> Answer | None:
    """Return an answer that obeys all laws: of accelerations, or of rates where those `after` an impact are given."""
    seen = set[Mode]()
    for mode in _modes(state, closed, ways, moving):
        now = mode
        for _ in range(_SIGNS):
            if now in seen or len(seen) > _MOST:
                break
            seen.add(now)
            try:
                answer = state.solve(
                    now, factors, *((state.free, -state.gained) if after is None else (state.v, after))
                )
            except Unsolved:
                break
            better = _improved(state, closed, moving, answer, after)
            if better == now:
                return answer
            now = better
    return None


def _modes(state: State, closed: list[int], ways: list[int], moving: set[int]) -> Iterator[Mode]:
    """Yield modes from which signs are sought: all at rest, as they are, and then all others."""
    free = [i for i in range(state.k) if i not in moving]
    yield Mode(frozenset(closed), tuple(ways[i] if i in moving else 0 for i in range(state.k)))
    yield Mode(frozenset(closed), tuple(ways))
    yield Mode(frozenset(), tuple(ways))
    for choice in itertools.product((1, -1, 0), repeat=len(free)):
        now = list(ways)
        for i, way in zip(free, choice, strict=True):
            now[i] = way
        for count in range(len(closed), -1, -1):
            for some in itertools.combinations(closed, count):
                yield Mode(frozenset(some), tuple(now))


def _improved(state: State, closed: list[int], moving: set[int], answer: Answer, after: Array | None) -> Mode:
    """Return the mode that the signs of an answer ask for: its own where it obeys all laws."""
    m, n, mode = state.m, state.n, answer.mode
    rates = state.rows @ answer.value - (after if after is not None else -state.gained)
    size = _ROUNDING * (np.abs(state.rows[m:]) @ np.abs(answer.value)).max(initial=1e-300)
    most = _ROUNDING * max(np.abs(answer.pushes).max(initial=0.0), np.abs(answer.joints).max(initial=0.0), 1e-300)
    shut = set(mode.closed)
    for j in closed:
        if j in shut and answer.pushes[j] < -most:
            shut.discard(j)
        elif j not in shut and rates[m + j] < -size:
            shut.add(j)
    ways = list(mode.ways)
    for i in range(state.k):
        if i in moving:
            continue
        if ways[i] == 0 and abs(answer.rubs[i]) > answer.bounds[i] + most:
            ways[i] = -int(np.sign(answer.rubs[i]))
        elif ways[i] != 0 and ways[i] * rates[m + n + i] < -size:
            ways[i] = 0
    return Mode(frozenset(shut), tuple(ways))
