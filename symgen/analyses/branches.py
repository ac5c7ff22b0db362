"""Which of several ways to close a driven mechanism: found from many places, chosen by what a start asks for."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from symgen.describe.evaluate import parameter_values, scalars
from symgen.describe.start import described_start
from symgen.errors import AssemblyError, InputError, nearest
from symgen.running.starts import compiled_for, start_of
from symgen.runtime import abi
from symgen.runtime.probe import Ready

if TYPE_CHECKING:
    from symgen.running.plan import Plan
    from symgen.runtime.assembly import Start
    from symgen.runtime.compiled import CompiledModel

Array = NDArray[np.float64]

#: Places that a mechanism is closed from, and those behind the last new way after which no more are looked for.
TRIES, ENOUGH = 200, 40
#: Positions as near as this are one, in lengths of the mechanism and radians.
SAME = 1e-6


def branch_near(plan: Plan, asked: Mapping[str, float]) -> tuple[Array, str]:
    """Return the coordinates of the way to close a mechanism at t = 0 that is nearest to a start.

    Parameters
    ----------
    plan : Plan
        Of a mechanism with drivers for all its freedom; nothing is held.
    asked : mapping of str to float
        Coordinates of bodies or joints.

    Returns
    -------
    near : Array, shape (nq,)
        Coordinates.
    words : str
        Which way it is, in a sentence.

    Raises
    ------
    InputError
        If a name is no coordinate: velocities follow from drivers.
    AssemblyError
        If it cannot be closed at all.
    """
    mechanism, parameters, compiled = plan.mechanism, plan.parameters, compiled_for(plan.mechanism, plan.choice)
    info = compiled.info
    known = {q.name: q.unit for q in (*info.coordinates, *info.joint_coordinates)}
    for name in asked:
        if name not in known:
            expected = "a coordinate of a body or joint: velocities follow from the drivers"
            raise InputError(f"start '{name}'", expected, "none of that name", nearest(name, known))
    q = np.array(described_start(mechanism, scalars(parameter_values(mechanism, parameters)))[0], dtype=np.float64)
    ways, refused, last = list[tuple[Array, dict[str, float]]](), AssemblyError("no place closes it"), 0
    for k, guess in enumerate(_places(compiled, q)):
        if ways and k > last + ENOUGH:
            break
        try:
            start = start_of(mechanism, compiled, parameters, plan.method_parameters, near=guess)
        except AssemblyError as error:
            refused = error if k == 0 else refused
            continue
        found = start.y[: info.nq].copy()
        if not any(_apart(compiled, found, other) < SAME for other, _ in ways):
            ways.append((found, _values(compiled, start)))
            last = k
    if not ways:
        raise refused
    far = [sum(_gap(known[name], values[name], x) ** 2 for name, x in asked.items()) for _, values in ways]
    chosen = int(np.argmin(far))
    told = ", ".join(f"{name} = {ways[chosen][1][name]:.6g}" for name in asked)
    several = "1 way to close it is" if len(ways) == 1 else f"{len(ways)} ways to close it are"
    return ways[chosen][0], f"{several} known; that with {told} is nearest to the start"


def _places(compiled: CompiledModel, q: Array) -> list[Array]:
    """Return the described coordinates, then others all over the place."""
    rng, info = np.random.default_rng(0), compiled.info
    lengths = np.array([c.unit == "m" for c in info.coordinates])
    size = float(np.ptp(q[lengths])) or 1.0 if lengths.any() else 1.0
    found = [q]
    for _ in range(TRIES - 1):
        change = np.where(lengths, 0.5 * size, np.pi) * rng.uniform(-1.0, 1.0, len(q))
        place = q + change
        for first, _ in info.spins:
            turned = rng.standard_normal(4)
            place[first : first + 4] = turned / np.linalg.norm(turned)
        found.append(place)
    return found


def _values(compiled: CompiledModel, start: Start) -> dict[str, float]:
    info = compiled.info
    out = np.zeros(info.observed)
    observe = Ready(compiled.model.observe, abi.OBSERVE)
    observe(start.t, start.y.copy(), start.p, start.w.copy(), np.zeros(info.ny), out)
    values = {c.name: float(x) for c, x in zip(info.coordinates, start.y, strict=False)}
    return values | {c.name: float(x) for c, x in zip(info.joint_coordinates, out[info.m :: 2], strict=True)}


def _gap(unit: str, value: float, asked: float) -> float:
    """Return how far a value is from another one, whole turns left out."""
    gap = value - asked
    return gap - 2.0 * np.pi * round(gap / (2.0 * np.pi)) if unit == "rad" else gap


def _apart(compiled: CompiledModel, a: Array, b: Array) -> float:
    info = compiled.info
    gaps = np.array([_gap(c.unit, x, y) for c, x, y in zip(info.coordinates, a, b, strict=True)])
    for first, _ in info.spins:
        one, other = a[first : first + 4], b[first : first + 4]
        gaps[first : first + 4] = min(np.linalg.norm(one - other), np.linalg.norm(one + other))
    return float(np.abs(gaps).max(initial=0.0))
