"""Motions of a machine: DOP853 between events, each of which is looked for in all of a step."""

from __future__ import annotations

import itertools
from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np
from scipy.integrate import DOP853
from scipy.optimize import brentq

from benchmarks.bounded.rubbing.bodies import Machine
from benchmarks.bounded.rubbing.modes import STILL, Answer, State, Unsolved, accelerate, choose, factors_of, strike
from benchmarks.bounded.touch.bodies import Array

#: What an event is and of which gap or friction; what is above zero as long as a mode holds; a state at a time.
Key = tuple[str, int]
Margins = dict[Key, float]
Dense = Callable[[float], Array]
#: Parts of a step that are looked at, longest step [s], most events.
_PARTS, _LONGEST, _MOST = 4, 1e-2, 600
#: Gaps that are zero [m]; rates at which gaps close that do not spring back, and below which a series is at its
#: end [m/s].
_NEAR, _SLOW, _LAST = 1e-11, 1e-6, 1e-4
#: Gaps and forces above which a margin counts that has begun at 0, and its depth that contradicts the mode.
_AWAKE, _DEEP = {"hit": 1e-14}, -1e-7


@dataclass
class Motion:
    """Places at output times, and what has happened."""

    t: list[float] = field(default_factory=list)
    q: list[Array] = field(default_factory=list)
    events: list[tuple[float, str, int]] = field(default_factory=list)


def run(machine: Machine, q: Array, v: Array, times: Array, rtol: float = 1e-11) -> Motion:
    """Return the motion of a machine from a start, which no gap penetrates.

    Raises
    ------
    Unsolved
        If modes are not found, or events do not end.
    """
    motion, pending, t = Motion(), [float(x) for x in times], float(times[0])
    q, v = machine.closed(np.array(q, float)), np.array(v, float)
    q, v, closed = _met(machine, t, q, v)
    stops = [x for x in machine.breaks if x > t] + [pending[-1]]
    forced: dict[int, int] = {}
    past = dict[int, list[Array]]()
    for _ in range(_MOST):
        state = State(machine, t, q, v)
        answer, loose = choose(state, closed, forced)
        t, q, v, what, i = _until_event(machine, answer, loose, t, q, v, stops[0], pending, motion, rtol)
        forced = {}
        closed = sorted(answer.mode.closed)
        if what == "end":
            stops.pop(0)
            if not stops:
                return motion
            continue
        motion.events.append((t, what, i))
        if what == "hit":
            q, v, closed = _met(machine, t, q, v)
            rate = float(State(machine, t, q, v).gap[i] @ v)
            past.setdefault(i, []).append(np.array([rate, t, *q, *v]))
            if i not in closed and (ended := _end_of_series(past[i][-3:])) is not None:
                t, q, v = float(ended[0]), ended[1 : len(q) + 1], ended[len(q) + 1 :]
                _note(motion, pending, t, _standing(q), len(q))
                v = strike(State(machine, t, q, v), [*closed, i], np.inf).value
                closed, past[i] = sorted([*closed, i]), []
        elif what == "lift":
            closed = [j for j in closed if j != i]
        elif what == "slip":
            now = accelerate(State(machine, t, q, v), answer.mode, factors_of(machine, loose))
            forced[i] = -int(np.sign(now.rubs[i]))
    raise Unsolved("events do not end")


def _standing(q: Array) -> Dense:
    """Return a place as a function of time."""
    return lambda _: q


def _end_of_series(past: list[Array]) -> Array | None:
    """Return time and state at the end of a series of impacts: smooth functions of the rate left, at the rate 0."""
    if len(past) < 3 or not past[0][0] > past[1][0] > past[2][0] > 0.0 or past[2][0] > _LAST:
        return None
    rates = np.array([each[0] for each in past])
    weights = [np.prod([b / (b - a) for b in rates if b != a]) for a in rates]
    return np.asarray(weights @ np.array(past)[:, 1:])


def _met(machine: Machine, t: float, q: Array, v: Array) -> tuple[Array, Array, list[int]]:
    """Return a state after the impact of its gaps, where there is one, and the gaps that stay closed."""
    touching = [j for j, gap in enumerate(machine.gap_values(q)) if gap < _NEAR]
    state = State(machine, t, q, v)
    if touching and min((state.gap @ v)[touching]) < -1e-12:
        v = strike(state, touching, _SLOW).value
    rates = state.gap @ v
    return q, v, [j for j in touching if abs(rates[j]) < 1e-11]


def _until_event(
    machine: Machine, chosen: Answer, loose: set[int], t: float, q: Array, v: Array, until: float, pending: list[float],
    motion: Motion, rtol: float,
) -> tuple[float, Array, Array, str, int]:  # fmt: skip
    """Integrate in a mode up to the next event; return time, state, what it is, and of which gap or friction."""
    n, mode, factors = len(q), chosen.mode, factors_of(machine, loose)

    def rates(x: float, y: Array) -> Array:
        return np.concatenate([y[n:], accelerate(State(machine, x, y[:n], y[n:]), mode, factors, judged=False).value])

    def margins(x: float, y: Array) -> Margins:
        """Return what is above zero as long as the mode holds."""
        state = State(machine, x, y[:n], y[n:])
        now = accelerate(state, mode, factors)
        found, gaps = Margins(), machine.gap_values(y[:n])
        for j in range(state.n):
            found["lift" if j in mode.closed else "hit", j] = float(now.pushes[j] if j in mode.closed else gaps[j])
        for i, way in enumerate(mode.ways):
            if way:
                found["stick", i] = float(way * state.rub[i] @ y[n:])
            else:
                found["slip", i] = float(now.bounds[i] - abs(now.rubs[i]))
        return found

    y = np.concatenate([q, v])
    if until - t <= 1e-15:
        return t, q, v, "end", -1
    before = margins(t, y)
    waking = {key for key, value in before.items() if value <= _AWAKE.get(key[0], STILL)}
    first = min(until - t, _LONGEST, _short(machine, chosen, t, y))
    solver = DOP853(rates, t, y, until, rtol=rtol, atol=1e-2 * rtol, max_step=_LONGEST, first_step=first)
    while solver.status == "running":
        solver.step()
        if str(solver.status) == "failed":
            raise Unsolved("the integration fails")
        dense = solver.dense_output()
        for low, high in itertools.pairwise(np.linspace(solver.t_old, solver.t, _PARTS + 1)):
            after = margins(high, dense(high))
            waking -= {key for key in waking if after[key] > _AWAKE.get(key[0], STILL)}
            met = [key for key in after if after[key] < (0.0 if key not in waking else _DEEP)]
            if met:
                at, key = min((_root(margins, dense, key, before, low, high), key) for key in met)
                _note(motion, pending, at, dense, n)
                found = dense(at)
                return at, found[:n].copy(), found[n:].copy(), *key
            before = after
        _note(motion, pending, solver.t, dense, n)
    return solver.t, solver.y[:n], solver.y[n:], "end", -1


def _root(
    margins: Callable[[float, Array], Margins], dense: Dense, key: Key, before: Margins, low: float, high: float
) -> float:
    """Return the time at which a margin is zero."""
    if before[key] <= 0.0:
        return low
    return float(brentq(lambda x: margins(x, dense(x))[key], low, high, xtol=1e-16, rtol=1e-15))


def _short(machine: Machine, chosen: Answer, t: float, y: Array) -> float:
    """Return a step that sees the flights that begin."""
    n, least = len(y) // 2, np.inf
    state, gaps = State(machine, t, y[:n], y[n:]), machine.gap_values(y[:n])
    for j in range(state.n):
        if j not in chosen.mode.closed and gaps[j] < 1e-9:
            up = float(state.gap[j] @ y[n:])
            pull = float(state.gap[j] @ chosen.value + state.gained[state.m + j])
            if up > 0.0 and pull < 0.0:
                least = min(least, -0.25 * up / pull)
    return float(least)


def _note(motion: Motion, pending: list[float], t: float, dense: Dense, n: int) -> None:
    """Write the places at output times up to a time."""
    while pending and pending[0] <= t:
        motion.t.append(pending[0])
        motion.q.append(np.array(dense(pending[0])[:n]))
        pending.pop(0)
