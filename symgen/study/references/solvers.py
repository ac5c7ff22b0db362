"""SciPy's solvers as the schemes behind references: which there are, and those that keep a history."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from itertools import pairwise
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from symgen.arguments import one_of
from symgen.describe.kinks import compares_state
from symgen.errors import SimulationError
from symgen.study.references.parts import in_parts, longest_of

if TYPE_CHECKING:
    from symgen.study.references.independent import IndependentEquations

Array = NDArray[np.float64]
#: Called with how far the work is, from 0 to 1.
Progress = Callable[[float], None]

#: Tolerances of the two integrations of the general route; the first one is the reference.
FINE, COARSE = 3e-14, 3e-13
#: What can be asked for -> class of `scipy.integrate`, its tolerances, and whether it goes on from a projected state.
SOLVERS: Mapping[str, tuple[str, float, float, bool]] = {
    "scipy-dop853": ("DOP853", FINE, COARSE, True),
    "scipy-radau": ("Radau", 1e-11, 1e-10, True),
    "scipy-bdf": ("BDF", 1e-10, 1e-9, False),
    "scipy-lsoda": ("LSODA", 1e-12, 1e-11, False),
}
#: Stands for a formula where there is one, else SciPy's DOP853.
AUTO = "auto"
#: Where a step ends, and the integral of the rates along it leads, may be so many tolerances apart; the latter is taken
#: from so many evaluations.
UNSEEN, LOOKS = 1e4, 16
#: Steps are no longer than the time over this where forces compare the state, and shorter than this part of it they
#: are not taken again.
LOOKED_AT, SHORTEST = 200, 1e-6
#: Steps of multistep solvers, which are all as short as one of them has to be, are not shorter than this part of it.
FEWEST = 1e-4
#: Evaluations after which a multistep solver is given up.
MOST_CALLS = 3_000_000


def check_solver(name: str) -> str:
    """Return the name of a way to a reference.

    Raises
    ------
    InputError
        If there is no such way; says the nearest one.
    """
    return one_of("--reference", name, (AUTO, *SOLVERS))


def in_one_go(
    equations: IndependentEquations, y: Array, times: Array, name: str, rtol: float, progress: Progress
) -> Array:
    """Return q at `times` from a multistep solver: its history forbids changes on the way, so outputs are projected."""
    from scipy.integrate import solve_ivp

    calls = 0

    def rate(t: float, state: Array) -> Array:
        nonlocal calls
        calls += 1
        if calls > MOST_CALLS:
            raise SimulationError(f"the reference motion cannot be integrated beyond t = {t:.6g} s: no progress")
        if calls % 1000 == 0:
            progress(min(1.0, max(0.0, t / float(times[-1]))))
        return equations.rate(t, state)

    solve: Any = solve_ivp  # SciPy's types do not know arrays of tolerances
    scale, compares = np.maximum(np.abs(y), 1.0), compares_state(equations.mechanism)
    bound = longest_of(equations, times)
    more = {"rtol": rtol, "atol": rtol * scale, "dense_output": compares, **jacobian_for(equations, name)}

    def part(first: float, y: Array, times: Array, _: Progress) -> Array:
        if times[-1] <= first:
            return np.tile(y, (len(times), 1))
        span = float(times[-1]) - first
        longest = min(bound, span / LOOKED_AT if compares else np.inf)
        while True:
            found = solve(rate, (first, float(times[-1])), y, name, times, max_step=longest, **more)
            if not found.success or not np.all(np.isfinite(found.y)):
                at = float(found.t[-1]) if len(found.t) else first
                why = f"the reference motion cannot be integrated beyond t = {at:.6g} s: {found.message}"
                raise SimulationError(why)
            steps = pairwise(found.sol.ts.tolist()) if compares else ()
            blind = [b - a for a, b in steps if unseen_in(equations, found.sol, a, b, scale) > UNSEEN * rtol]
            longest = 0.5 * max(blind, default=0.0)
            if longest < FEWEST * span:
                return np.asarray(found.y.T)

    found = in_parts(equations, y, times, progress, part)
    states = [equations.project(float(t), state) for t, state in zip(times, found, strict=True)]
    return np.array(states).reshape(len(times), len(y))[:, : equations.n]


def unseen_in(
    equations: IndependentEquations, motion: Callable[[float], Array], first: float, last: float, scale: Array
) -> float:
    """Return how far a step's end is from where the integral of the rates along it leads, over `scale`.

    A force that acts between two values of the state, and only there, may lie between all evaluations of a step, where
    no estimate of a solver sees it.
    """
    nodes, weights = np.polynomial.legendre.leggauss(LOOKS)
    half, middle = 0.5 * (last - first), 0.5 * (last + first)
    along = [equations.rate(t, motion(t)) for t in (middle + half * nodes).tolist()]
    change = motion(last) - motion(first) - half * (weights @ np.array(along))
    return float(np.max(np.abs(change) / scale))


def jacobian_for(equations: IndependentEquations, name: str) -> dict[str, Callable[[float, Array], Array]]:
    """Return the Jacobian for SciPy's implicit solvers, by central differences.

    Their own differences enlarge the step of a coordinate that no rate depends on, at every call, until it overflows.
    """
    if name not in ("Radau", "BDF"):
        return {}

    def jacobian(t: float, y: Array) -> Array:
        steps = 1e-6 * np.maximum(1.0, np.abs(y))
        columns = [
            (equations.rate(t, y + step * unit) - equations.rate(t, y - step * unit)) / (2.0 * step)
            for step, unit in zip(steps, np.eye(len(y)), strict=True)
        ]
        return np.column_stack(columns)

    return {"jac": jacobian}
