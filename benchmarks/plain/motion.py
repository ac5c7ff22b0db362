"""Motions: DOP853 of SciPy with a projection after every step, or Runge and Kutta's four stages at constant steps."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.integrate import DOP853

from benchmarks.plain.moving import Array
from benchmarks.plain.start import projected
from benchmarks.plain.system import System, scaled

#: Why a motion ended that no state continues, by constraints that depend on each other but ask for different things.
CONTRADICTION = "the constraints contradict each other"


@dataclass
class Motion:
    """A motion at its output times.

    Attributes
    ----------
    t : list of float
        Times [s].
    q, v, lam, energies, reactions : list of Array
        At these times; energies are kinetic, potential and work [J], reactions those of all joints one after another.
    unique : Array of bool
        Rows whose multipliers the equations determine at every output.
    unique_reactions : Array of bool
        Joints whose reactions they determine.
    smallest : float
        The smallest singular value of D with rows of length 1 on the way, those that are always 0 apart, and the
        smallest margin of a joint.
    reached : float
        Until when it went [s].
    evaluations : int
        Of accelerations.
    ended : str
        Why the motion ended before its time; empty where it did not.
    """

    t: list[float] = field(default_factory=list)
    q: list[Array] = field(default_factory=list)
    v: list[Array] = field(default_factory=list)
    lam: list[Array] = field(default_factory=list)
    energies: list[Array] = field(default_factory=list)
    reactions: list[Array] = field(default_factory=list)
    unique: NDArray[np.bool_] | None = None
    unique_reactions: NDArray[np.bool_] | None = None
    smallest: float = np.inf
    reached: float = 0.0
    evaluations: int = 0
    ended: str = ""

    @property
    def drift(self) -> float:
        """The largest |E - E0 - W| [J]."""
        table = np.array(self.energies)
        balance = table[:, 0] + table[:, 1] - table[:, 2]
        return float(np.abs(balance - balance[0]).max())

    @property
    def energy_scale(self) -> float:
        """The largest kinetic energy, change of potential energy, or work [J]."""
        table = np.array(self.energies)
        return float(max(table[:, 0].max(), np.abs(table[:, 1] - table[0, 1]).max(), np.abs(table[:, 2]).max()))


class _Run:
    """One motion being made."""

    def __init__(self, system: System, q: Array, v: Array, least: float) -> None:
        self.system, self.least, self.motion = system, least, Motion()
        c = system.constraints(system.at(0.0, q, v))
        self.rank, self.y = system.rank(c.d), np.concatenate([q, v, [0.0]])

    def parts(self, y: Array) -> tuple[Array, Array]:
        nq = self.system.nq
        return y[:nq], y[nq:-1]

    def rates(self, t: float, y: Array) -> Array:
        self.motion.evaluations += 1
        q, v = self.parts(y)
        system = self.system
        state = system.at(t, q, v)
        c = system.constraints(state)
        f, other, _ = system.loads(state)
        a, lam = system.accelerations(c, f, self.rank)
        return np.concatenate([system.rates_of(q, v), a, [other @ v - lam @ c.nu]])

    def accept(self, t: float, y: Array) -> Array:
        """Return the state projected; remember angles; look how near it is to a singular position."""
        q, v = projected(self.system, t, *self.parts(y), self.rank)
        state = self.system.at(t, q, v)
        self.system.follow(state)
        self.motion.reached = t
        c = self.system.constraints(state)
        d, size = c.d, max(1.0, float(np.abs(q).max()), float(np.abs(v).max()))
        if max(np.abs(c.phi).max(initial=0.0), np.abs(c.d @ v - c.nu).max(initial=0.0)) > 1e-8 * size:
            self.motion.ended = CONTRADICTION
        if self.rank:
            sizes = np.linalg.svd(scaled(d)[0], compute_uv=False)
            self.motion.smallest = min(self.motion.smallest, float(sizes[self.rank - 1]))
        for joint in self.system.joints:
            for margin in joint.margins:
                self.motion.smallest = min(self.motion.smallest, margin(state))
        return np.concatenate([q, v, y[-1:]])

    def store(self, t: float, y: Array) -> None:
        system, motion = self.system, self.motion
        q, v = self.parts(y)
        state = system.at(t, q, v)
        c = system.constraints(state)
        f, _, energy = system.loads(state)
        a, _ = system.accelerations(c, f, self.rank)
        lam, open_ = system.multipliers(c, f, a, self.rank)
        reactions = system.reactions(state, c.d, lam)
        # by so little of what is open, of the size of the others, a multiplier may differ
        unique = np.linalg.norm(open_, axis=1) < 1e-10 if len(lam) else np.ones(0, dtype=bool)
        determined = np.array([self._determined(i, c.d, open_) for i in range(len(system.joints))], dtype=bool)
        motion.unique = unique if motion.unique is None else motion.unique & unique
        motion.unique_reactions = (
            determined if motion.unique_reactions is None else motion.unique_reactions & determined
        )
        motion.t.append(t)
        motion.q.append(q.copy())
        motion.v.append(v.copy())
        motion.lam.append(lam)
        motion.reactions.append(np.concatenate([*reactions.values(), np.zeros(0)]))
        motion.energies.append(np.array([system.kinetic(v), energy, y[-1]]))

    def _determined(self, joint: int, d: Array, open_: Array) -> bool:
        """Whether no change of multipliers that balances itself reaches the joint's reaction."""
        first = sum(len(j.rows) for j in self.system.joints[:joint])
        rows = slice(first, first + len(self.system.joints[joint].rows))
        return bool(np.abs(d[rows].T @ open_[rows]).max(initial=0.0) < 1e-6)

    def singular(self) -> bool:
        if self.motion.smallest < self.least:
            self.motion.ended = f"near a singular position ({self.motion.smallest:.2g})"
        elif not np.isfinite(self.y).all():
            self.motion.ended = "not finite"
        return bool(self.motion.ended)


def integrate(
    system: System,
    q: Array,
    v: Array,
    times: Array,
    rtol: float = 1e-12,
    least: float = 0.0,
    most: int = 200_000,
) -> Motion:
    """Return the motion at the given times, the first of which is the start's.

    Parameters
    ----------
    system : System
        The mechanism; its angles in space are those of the start.
    q, v : Array
        A state that satisfies the constraints.
    times : Array
        Output times [s].
    rtol : float
        Relative tolerance; the absolute one is a hundredth of it times the size of positions and speeds.
    least : float
        The motion ends where `Motion.smallest` falls below it.
    most : int
        It ends after this many evaluations.
    """
    run = _Run(system, q, v, least)
    run.store(float(times[0]), run.y)
    step: float | None = None
    for start, end in zip(times[:-1].tolist(), times[1:].tolist(), strict=True):
        first = None if step is None else min(step, end - start)
        tolerances: dict[str, Any] = {"rtol": rtol, "atol": _atol(run, rtol), "first_step": first}
        solver = DOP853(run.rates, start, run.y, end, **tolerances)
        while solver.status == "running":
            if solver.step() is not None:  # says why it failed
                run.motion.ended = "steps became too small"
                return run.motion
            if solver.t != end and solver.step_size is not None:
                step = float(solver.h_abs)
            run.y = solver.y = run.accept(float(solver.t), solver.y)
            if run.singular() or run.motion.evaluations > most:
                run.motion.ended = run.motion.ended or "too many evaluations"
                return run.motion
            solver.f = run.rates(float(solver.t), solver.y)
        step = max(step or 0.0, float(solver.step_size or 0.0))
        run.store(end, run.y)
    return run.motion


def _atol(run: _Run, rtol: float) -> Array:
    q, v = run.parts(run.y)
    energy = max(run.system.kinetic(v), 1e-3)
    sizes = np.concatenate(
        [np.full(len(q), max(1e-3, np.abs(q).max())), np.full(len(v), max(1e-3, np.abs(v).max())), [energy]]
    )
    return 1e-2 * rtol * sizes


def constant_steps(system: System, q: Array, v: Array, times: Array, step: float, correct: bool = True) -> Motion:
    """Return the motion by the classical Runge-Kutta scheme; every output time is a whole number of steps.

    Parameters
    ----------
    system, q, v, times
        As for `integrate`.
    step : float
        Constant step [s].
    correct : bool
        Whether the state is brought back to the constraints after every step.
    """
    run = _Run(system, q, v, 0.0)
    run.store(float(times[0]), run.y)
    for start, end in zip(times[:-1].tolist(), times[1:].tolist(), strict=True):
        count = round((end - start) / step)
        h = (end - start) / count
        for k in range(count):
            t, y = start + k * h, run.y
            k1 = run.rates(t, y)
            k2 = run.rates(t + h / 2, y + h / 2 * k1)
            k3 = run.rates(t + h / 2, y + h / 2 * k2)
            k4 = run.rates(t + h, y + h * k3)
            run.y = y + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4)
            if correct:
                run.y = run.accept(t + h, run.y)
            else:
                system.follow(system.at(t + h, *run.parts(run.y)))
            if run.singular():
                return run.motion
        run.store(end, run.y)
    return run.motion
