"""SciPy's solvers as the schemes behind references: which there are, and those that keep a history."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from symgen.arguments import one_of
from symgen.errors import SimulationError

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

    end, calls = float(times[-1]) if len(times) else 0.0, 0

    def rate(t: float, state: Array) -> Array:
        nonlocal calls
        calls += 1
        if calls > MOST_CALLS:
            raise SimulationError(f"the reference motion cannot be integrated beyond t = {t:.6g} s: no progress")
        if calls % 1000 == 0:
            progress(min(1.0, max(0.0, t / end)))
        return equations.rate(t, state)

    if end <= 0.0:
        return np.tile(y[: equations.n], (len(times), 1))
    solve: Any = solve_ivp  # SciPy's types do not know arrays of tolerances
    scale = np.maximum(np.abs(y), 1.0)
    found = solve(rate, (0.0, end), y, name, times, rtol=rtol, atol=rtol * scale, **jacobian_for(equations, name))
    if not found.success or not np.all(np.isfinite(found.y)):
        at = float(found.t[-1]) if len(found.t) else 0.0
        raise SimulationError(f"the reference motion cannot be integrated beyond t = {at:.6g} s: {found.message}")
    states = [equations.project(float(t), state) for t, state in zip(times, found.y.T, strict=True)]
    return np.array(states)[:, : equations.n]


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
