"""The reference's motion of a mechanism, with what is needed to say how far off a run may be."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from benchmarks.plain.motion import CONTRADICTION, Motion, constant_steps, integrate
from benchmarks.plain.moving import Array
from benchmarks.plain.start import projected, start
from benchmarks.plain.system import System, read

#: Groups of numbers that are compared.
GROUPS = ("q", "v", "lam", "reactions", "energies")
#: Outputs of a motion besides its start.
OUTPUTS = 10
#: A motion ends before its smallest singular value or margin falls below this, unless asked for more.
LEAST = 0.04
#: Size of the disturbance by which it is told how disturbances grow [m, rad, m/s, rad/s].
DISTURBANCE = 1e-6
#: Evaluations that a motion may take.
MOST = 12_000
RTOL = 1e-12


class Unusable(Exception):
    """The motion says nothing: too near a singular position, too stiff, or too sensitive."""


class Contradiction(Unusable):
    """No motion satisfies the constraints, so that no run may be called `ok`."""


@dataclass(frozen=True)
class Reference:
    """A motion and its sensitivity.

    Attributes
    ----------
    motion : Motion
        At `times`.
    scales, growth : mapping of str to float
        For each of `GROUPS` the largest number, and the largest change for a disturbance of the start, divided by it.
    coarse : mapping of str to float
        For each group the error of the classical Runge-Kutta scheme with `step`; None where it does not get through.
    own : mapping of str to float
        The difference to a run whose tolerance is 100 times larger.
    determined : bool
        Whether the file alone says the start.
    """

    system: System
    motion: Motion
    times: Array
    step: float
    scales: Mapping[str, float]
    growth: Mapping[str, float]
    coarse: Mapping[str, float] | None
    own: Mapping[str, float]
    determined: bool


def groups(system: System, motion: Motion) -> dict[str, Array]:
    """Return what is compared, an array of outputs by columns for each group.

    Euler parameters become rotation matrices, multipliers and reactions that are not unique become 0, and the
    potential energy counts from the start.
    """
    lam, reactions, energies = (np.array(x) for x in (motion.lam, motion.reactions, motion.energies))
    energies[:, 1] -= energies[0, 1]
    if motion.unique is not None and motion.unique_reactions is not None and len(motion.unique):
        lam = np.where(motion.unique, lam, 0.0)
        per = 6 if system.document.spatial else 3
        reactions = np.where(np.repeat(motion.unique_reactions, per), reactions, 0.0)
    return {
        "q": placed(system, np.array(motion.q)),
        "v": np.array(motion.v),
        "lam": lam,
        "reactions": reactions,
        "energies": energies,
    }


def placed(system: System, q: Array) -> Array:
    """Return positions and angles, in space rotation matrices, of states as rows."""
    if not system.document.spatial:
        return q
    rows = []
    for one in q:
        state = system.at(0.0, one, np.zeros(system.nv))
        rows.append(np.concatenate([np.concatenate([r, a.ravel()]) for r, a, _ in state.frames.values()]))
    return np.array(rows)


def distances(system: System, one: Motion, other: Motion) -> dict[str, float]:
    """Return the largest difference of each group."""
    a, b = groups(system, one), groups(system, other)
    return {name: float(np.abs(a[name] - b[name]).max(initial=0.0)) for name in GROUPS}


def prepared(
    raw: Mapping[str, Any],
    until: float = 1.0,
    steps: int = 400,
    begin: tuple[Array, Array] | None = None,
    seed: int = 0,
    least: float = LEAST,
) -> Reference:
    """Return the reference of a mechanism.

    Parameters
    ----------
    raw : mapping
        Its file.
    until : float
        The end that is hoped for [s]; nearness to singular positions and sensitivity make it less.
    steps : int
        Constant steps of the coarse run, a multiple of `OUTPUTS`.
    begin : pair of Array, optional
        The start, where the file does not determine it; it must satisfy the constraints.
    seed : int
        Of the disturbance.
    least : float
        The motion ends before its smallest singular value or margin falls below this.

    Raises
    ------
    Unusable
        If no part of the motion can serve.
    """
    system = read(raw)
    described = start(system)
    q, v = (described.q, described.v) if begin is None else begin
    if begin is not None:
        system.follow(system.at(0.0, q, v))
    turns = dict(system.turns)

    def run(q: Array, v: Array, rtol: float) -> Motion:
        system.turns = dict(turns)
        return integrate(system, q, v, times, rtol, least, MOST)

    for _ in range(3):
        times = np.linspace(0.0, until, OUTPUTS + 1)
        motion = run(q, v, RTOL)
        if not motion.ended:
            break
        if motion.ended == CONTRADICTION:
            raise Contradiction(motion.ended)
        until = float(f"{0.6 * motion.reached:.3g}")
        if until < 0.01:
            break
    if motion.ended:
        raise Unusable(motion.ended)
    own = distances(system, motion, run(q, v, 100 * RTOL))
    growth = _growth(system, turns, motion, times, q, v, seed)
    if not growth["q"] < 1e3 or own["q"] > 1e-6:
        raise Unusable(f"disturbances grow {growth['q']:.1g} times, tolerances leave {own['q']:.1g}")
    step, coarse = until / steps, None
    for factor in (1, 4):
        system.turns = dict(turns)
        rough = constant_steps(system, q, v, times, step / factor)
        if not rough.ended:
            step, coarse = step / factor, distances(system, motion, rough)
            break
    scales = {name: float(np.abs(values).max(initial=0.0)) for name, values in groups(system, motion).items()}
    scales["energies"] = float(np.abs(np.array(motion.energies)).max())
    return Reference(system, motion, times, step, scales, growth, coarse, own, described.determined)


def _growth(
    system: System, turns: dict[Any, float], motion: Motion, times: Array, q: Array, v: Array, seed: int
) -> dict[str, float]:
    """Return by how much each group changes for a disturbance of the start along its constraints, over its size."""
    rng = np.random.default_rng(seed)
    rank = system.rank(system.constraints(system.at(0.0, q, v)).d)
    shift, kick = (DISTURBANCE * rng.standard_normal(system.nv) for _ in range(2))
    system.turns = dict(turns)
    q1, v1 = projected(system, 0.0, system.moved(q, shift), v + kick, rank)
    system.follow(system.at(0.0, q1, v1))
    other = integrate(system, q1, v1, times, 1e-9, 0.0, MOST)
    if other.ended:
        raise Unusable(other.ended)
    return {name: size / DISTURBANCE for name, size in distances(system, motion, other).items()}
