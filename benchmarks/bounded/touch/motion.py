"""Motions of a scene: DOP853 between events, each of which is looked for in all of a step."""

from __future__ import annotations

import itertools
from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np
from scipy.integrate import DOP853
from scipy.optimize import brentq

from benchmarks.bounded.touch.bodies import Array, Scene
from benchmarks.bounded.touch.modes import (
    DOWN,
    REST,
    STILL,
    UP,
    Answer,
    Modes,
    Problem,
    accelerations,
    brought_to_rest,
    choose,
    impact,
)

#: Parts of a step that are looked at.
PARTS = 6
#: Most events, and energy that an impact may add, over that before.
MOST, _GAIN = 1000, 1e-9


#: Rates after impacts below which a series is looked for [m/s], and difference of its sums by two impacts and by three.
_LAST, _SAME = 1e-5, 1e-9
#: Depth of a gap that is no rounding [m].
_DEEP = 1e-7
#: Rates of gaps behind a series that are rounding [m/s].
_STILL = 1e-8
#: Ends of a part of a surface, and those by which one comes to the next part.
_BACK = {"ahead": "back", "back": "ahead"}


class Ended(Exception):
    """Newton's law adds energy, or events do not end."""


@dataclass
class Motion:
    """States at output times, and what has happened."""

    t: list[float] = field(default_factory=list)
    q: list[Array] = field(default_factory=list)
    events: list[tuple[float, str, int]] = field(default_factory=list)


@dataclass
class Impact:
    """A state after an impact, and the largest rate at which gaps open that touch."""

    t: float
    rate: float
    q: Array
    v: Array


@dataclass
class Phase:
    """What holds between two events.

    Attributes
    ----------
    modes : dict
        Of closed contacts.
    friction : Array
        Coefficients in motion.
    waking : set of (str, int)
        Margins of contacts that leave without a rate, begin to slide, or have come to a part of a surface: not looked
        at until they have.
    """

    modes: Modes
    friction: Array
    waking: set[tuple[str, int]]


def run(scene: Scene, q: Array, v: Array, times: list[float], rtol: float = 1e-12) -> Motion:
    """Return the motion of a scene from a start, which no gap penetrates.

    Raises
    ------
    Unsolved, Ended
        If modes are not determined, or the motion is of no use.
    """
    motion, t, loose, past = Motion(), times[0], set[int](), dict[int, list[Impact]]()
    passed = set[tuple[str, int]]()
    for contact in scene.contacts:
        contact.follow(q, closed=False)
    q = scene.closed(np.array(q, float))
    closed, forced = _touching(scene, q), Modes()
    v = _struck(scene, q, np.array(v, float), closed)
    closed = _staying(scene, q, v, closed)
    pending = list(times)
    for _ in range(MOST):
        answer = choose(scene, q, v, closed, forced, loose)
        problem = Problem(scene, q, v)
        if pulled := _pulled(scene, problem, answer):
            closed = sorted({*closed, *pulled})
            answer = choose(scene, q, v, closed, forced, loose)
        for i, contact in enumerate(scene.contacts):
            contact.follow(q, i in answer.modes)
        problem = Problem(scene, q, v)
        rates, opens = problem.slip @ v, problem.gap @ v
        loose = {i for i, mode in answer.modes.items() if mode != REST}
        left = {i for i in _touching(scene, q) if i not in answer.modes and abs(opens[i]) < STILL}
        friction = np.array([contact.sliding for contact in scene.contacts])
        waking = {("hit", i) for i in left} | {("stick", i) for i in loose if abs(rates[i]) <= STILL} | passed
        phase, passed = Phase(answer.modes, friction, waking), set()
        t, q, v, what, i = _until_event(scene, phase, t, q, v, pending, motion, rtol)
        if scene.gaps(q).min() < -_DEEP:
            raise Ended("a gap is penetrated")
        if what == "end":
            return motion
        motion.events.append((t, what, i))
        closed, forced = list(answer.modes), {}
        if what == "hit":
            closed = sorted(set(closed) | {i} | set(_touching(scene, q)))
            v = _struck(scene, q, v, closed)
            opens = Problem(scene, q, v).gap @ v
            rate = float(opens[i] if opens[i] > _STILL else opens[closed].max())
            past.setdefault(i, []).append(Impact(t, rate, q, v))
            ended = _ended(past[i][-3:])
            if ended is not None:
                _note(motion, pending, ended.t, _between(past[i][-1], ended), len(q))
                t, q, past[i] = ended.t, ended.q, []
                still = np.abs(Problem(scene, q, ended.v).gap @ ended.v) < _STILL
                v = brought_to_rest(scene, q, ended.v, [j for j in closed if still[j]])
                if not pending:
                    return motion
            closed = _staying(scene, q, v, closed)
        elif what == "lift":
            closed = [j for j in closed if j != i]
        elif what == "slip":
            now = accelerations(Problem(scene, q, v), phase.modes, friction)
            for j, mode in phase.modes.items():
                contact = scene.contacts[j]
                if mode == REST and contact.static > 0.0:
                    margin = contact.static * now.normal[j] - abs(now.along[j])
                    if j == i or margin < 1e-9 * (1.0 + now.normal[j]):
                        forced[j] = DOWN if now.along[j] > 0.0 else UP
        elif what in _BACK:
            if scene.contacts[i].step(what):
                passed = {(_BACK[what], i)}
            else:
                still = np.abs(Problem(scene, q, v).gap @ v) < STILL
                closed = [j for j in {*closed, *_touching(scene, q)} if j != i and still[j]]
        elif what == "stick":
            loose = loose - {i}
            row = Problem(scene, q, v)
            loose = {j for j in loose if abs(row.slip[j] @ v) > STILL}
    raise Ended("events do not end")


def _ended(past: list[Impact]) -> Impact | None:
    """Return the state at the end of a series of impacts, None where it is none.

    It is a smooth function of the rate that remains: one of second order is extrapolated to the rate 0, where one of
    first order says nearly the same.
    """
    if len(past) < 3 or past[-1].rate > _LAST or not past[-3].rate > past[-2].rate > past[-1].rate > 0.0:
        return None
    numbers = np.array([[impact.t, *impact.q, *impact.v] for impact in past])
    rates, n = np.array([impact.rate for impact in past]), len(past[-1].q)
    first, second = _at_zero(rates[1:]) @ numbers[1:], _at_zero(rates) @ numbers
    if np.abs(second - first)[n + 1 :].max() > _SAME:
        return None
    return Impact(float(second[0]), 0.0, second[1 : n + 1], second[n + 1 :])


def _at_zero(places: Array) -> Array:
    """Return the weights of values at some places in their interpolation at 0."""
    return np.array([np.prod([b / (b - a) for b in places if b != a]) for a in places])


def _between(one: Impact, other: Impact) -> Callable[[float], Array]:
    """Return the places between two impacts that are close, as a function of time."""
    return lambda t: one.q + (t - one.t) / max(other.t - one.t, 1e-300) * (other.q - one.q)


def _pulled(scene: Scene, problem: Problem, answer: Answer) -> list[int]:
    """Return the open gaps that touch without a rate and close: at the top of a flight that is too low to be seen."""
    gained = problem.gained[problem.joints : problem.joints + problem.n]
    pull, opens = answer.rates[: problem.n] + gained, problem.gap @ problem.v
    least = -1e-6 * (1.0 + np.abs(pull).max())
    touching = [i for i in _touching(scene, problem.q) if i not in answer.modes]
    return [i for i in touching if abs(opens[i]) < STILL and pull[i] < least]


def _touching(scene: Scene, q: Array) -> list[int]:
    return [i for i, gap in enumerate(scene.gaps(q)) if gap < scene.near]


def _staying(scene: Scene, q: Array, v: Array, closed: list[int]) -> list[int]:
    rates = Problem(scene, q, v).gap @ v
    return [i for i in closed if abs(rates[i]) < 1e-11]


def _struck(scene: Scene, q: Array, v: Array, touching: list[int]) -> Array:
    """Return the velocities after an impact of gaps, where one closes."""
    problem = Problem(scene, q, v)
    if not touching or min((problem.gap @ v)[touching]) >= -1e-12:
        return v
    after = impact(scene, q, v, touching, scene.slow).value
    if len(touching) > 1 and (problem.gap @ after)[touching].max() < scene.turns:
        after = brought_to_rest(scene, q, after, touching)
    before = float(v @ (scene.masses * v))
    if float(after @ (scene.masses * after)) > before * (1.0 + _GAIN):
        raise Ended("an impact adds energy")
    return after


def _until_event(
    scene: Scene, phase: Phase, t: float, q: Array, v: Array, pending: list[float], motion: Motion, rtol: float
) -> tuple[float, Array, Array, str, int]:
    """Integrate in a mode up to the next event; return time, state, what it is, and which contact."""
    n, until = len(q), pending[-1]

    def answer(y: Array) -> Answer:
        return accelerations(Problem(scene, y[:n], y[n:], phase.modes), phase.modes, phase.friction)

    def rates(_: float, y: Array) -> Array:
        return np.concatenate([y[n:], answer(y).value])

    def margins(y: Array) -> dict[tuple[str, int], float]:
        """Return what is above zero as long as the mode holds."""
        problem, found = Problem(scene, y[:n], y[n:], phase.modes), dict[tuple[str, int], float]()
        now, gaps = accelerations(problem, phase.modes, phase.friction), scene.gaps(y[:n])
        for i, contact in enumerate(scene.contacts):
            if i not in phase.modes:
                if not contact.passes(y[:n]):
                    found["hit", i] = gaps[i]
            else:
                found |= {(way, i): far for way, far in contact.ends(y[:n]).items()}
                found["lift", i] = now.normal[i]
                if phase.modes[i] != REST:
                    found["stick", i] = float(phase.modes[i] * problem.slip[i] @ y[n:])
                elif contact.static > 0.0:
                    found["slip", i] = contact.static * now.normal[i] - abs(now.along[i])
        return found

    y = np.concatenate([q, v])
    first = min(scene.longest, _short(scene, phase, y, rates(t, y)))
    if until - t <= 0.0:
        _note(motion, pending, t, lambda _: y, n)
        return t, q, v, "end", -1
    solver = DOP853(
        rates, t, y, until, rtol=rtol, atol=1e-2 * rtol, max_step=scene.longest, first_step=min(first, until - t)
    )
    waking = set(phase.waking)
    before = margins(y)
    while solver.status == "running":
        solver.step()
        if str(solver.status) == "failed":  # of a type that a step changes
            raise Ended("the integration fails")
        dense = solver.dense_output()
        times = np.linspace(solver.t_old, solver.t, PARTS + 1)
        for low, high in itertools.pairwise(times):
            after = margins(dense(high))
            waking -= {key for key in waking if key in after and after[key] > (STILL if key[0] == "stick" else 1e-10)}
            met = [key for key in after if after[key] < 0.0 and key not in waking]
            if met:
                at, key = min((_root(margins, dense, key, before, low, high), key) for key in met)
                _note(motion, pending, at, dense, n, strictly=True)
                found = dense(at)
                return at, found[:n].copy(), found[n:].copy(), *key
            before = after
        _note(motion, pending, solver.t, dense, n)
    return solver.t, solver.y[:n], solver.y[n:], "end", -1


def _short(scene: Scene, phase: Phase, y: Array, rate: Array) -> float:
    """Return a step that sees the flights that begin, and those that end."""
    n, least = len(y) // 2, np.inf
    problem, gaps = Problem(scene, y[:n], y[n:]), scene.gaps(y[:n])
    for i in range(len(scene.contacts)):
        if i not in phase.modes and gaps[i] < 1e-9:
            up = float(problem.gap[i] @ y[n:])
            pull = float(problem.gap[i] @ rate[n:] + problem.gained[problem.joints + i])
            if up > 0.0 and pull < 0.0:
                least = min(least, -0.25 * up / pull)
            elif up < 0.0:
                least = min(least, max(-0.25 * gaps[i] / up, 1e-9))
    return least


def _root(
    margins: Callable[[Array], dict[tuple[str, int], float]],
    dense: Callable[[float], Array],
    key: tuple[str, int],
    before: dict[tuple[str, int], float],
    low: float,
    high: float,
) -> float:
    """Return the time at which a margin is zero."""
    if before.get(key, 0.0) <= 0.0:
        return low
    return float(brentq(lambda x: margins(dense(x)).get(key, 1.0), low, high, xtol=1e-16, rtol=1e-15))


def _note(
    motion: Motion, pending: list[float], t: float, state: Callable[[float], Array], n: int, strictly: bool = False
) -> None:
    """Write the places at output times up to a time."""
    while pending and (pending[0] < t if strictly else pending[0] <= t):
        motion.t.append(pending[0])
        motion.q.append(np.array(state(pending[0])[:n]))
        pending.pop(0)
