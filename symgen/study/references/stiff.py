"""Reference motions whose decay is much faster than they are: SciPy's Radau on the compiled independent equations."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from symgen.errors import SimulationError
from symgen.study.references.parts import by_outputs, in_parts, longest_of
from symgen.study.references.passing import FAILURES

if TYPE_CHECKING:
    from symgen.study.references.motion import CompiledEquations

Array = NDArray[np.float64]

#: Decay of so many e-foldings over the motion is left to Radau.
STIFF_FOLDINGS = 3e4
#: Evaluations of an integration after which it is given up, those of Jacobians included.
BUDGET = 400_000
#: Displacement of a component by which the equations are linearised, over its size or 1.
SHIFT = 1e-7


class OverBudgetError(SimulationError):
    """A reference takes more evaluations than it may."""


def slopes(equations: CompiledEquations, t: float, y: Array) -> Array:
    """Return the Jacobian of the rates of a state, by forward differences, shape (2 n, 2 n).

    SciPy's own enlarges the displacement of a component on which nothing depends until it overflows.
    """
    base = equations.rate(t, y)
    jacobian = np.empty((len(y), len(y)))
    for j in range(len(y)):
        moved = y.copy()
        moved[j] += SHIFT * max(1.0, abs(float(y[j])))
        jacobian[:, j] = (equations.rate(t, moved) - base) / (moved[j] - y[j])
    return jacobian


def decay(equations: CompiledEquations, y: Array) -> float:
    """Return the fastest decay of the linearised equations at a state [1/s], by forward differences."""
    return _modes(equations, y)[0]


def is_stiff(equations: CompiledEquations, y: Array, until: float) -> bool:
    """Whether something decays over a motion by more than `STIFF_FOLDINGS`.

    What conserves energy has modes in pairs, one that grows for each that decays, and is not stiff however long it
    lasts; what counts is by how much decay exceeds growth.
    """
    falling, growing = _modes(equations, y)
    return (falling - growing) * until > STIFF_FOLDINGS


def _modes(equations: CompiledEquations, y: Array) -> tuple[float, float]:
    """Return the fastest decay and the fastest growth [1/s]."""
    jacobian = slopes(equations, 0.0, y)
    if not np.all(np.isfinite(jacobian)):
        return 0.0, 0.0
    real = np.linalg.eigvals(jacobian).real
    return float(max(0.0, -real.min(initial=0.0))), float(real.max(initial=0.0))


def by_radau(
    equations: CompiledEquations,
    y: Array,
    times: Array,
    rtol: float,
    every: int,
    progress: Callable[[float], None],
    scale: Array,
) -> Array:
    """Return q at `times`; every `every`-th output is projected.

    Raises
    ------
    SimulationError
        If the motion cannot be integrated, or not within `BUDGET`.
    """
    from scipy.integrate import solve_ivp

    used = 0

    def rate(t: float, at: Array) -> Array:
        nonlocal used
        used += 1
        if used > BUDGET:
            raise OverBudgetError(f"the reference takes more than {BUDGET:g} evaluations")
        return equations.rate(t, at)

    def jacobian(t: float, at: Array) -> Array:
        nonlocal used
        used += len(at) + 1
        return slopes(equations, t, at)

    # fast decay leaves velocities at a state of balance: errors of positions are what counts
    atol: Any = rtol * scale
    longest = longest_of(equations, times)

    def advance(t: float, y: Array, following: float) -> Array:
        beyond = f"the reference motion cannot be integrated beyond t = {t:.6g} s"
        try:
            span = t, following
            found = solve_ivp(rate, span, y, "Radau", rtol=rtol, atol=atol, jac=jacobian, max_step=longest)
        except FAILURES as error:  # SciPy raises where a Jacobian is not finite
            raise SimulationError(f"{beyond}: {error}") from None
        if not found.success or not np.all(np.isfinite(found.y[:, -1])):
            raise SimulationError(beyond)
        return found.y[:, -1]

    part = by_outputs(equations, every, lambda: advance)
    return in_parts(equations, y, times, progress, part)[:, : equations.n]
