"""SciPy's solvers as the schemes of references, step by step and, for multistep ones, in one go."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from itertools import pairwise
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from symgen.base.arguments import one_word_of
from symgen.base.errors import SimulationError
from symgen.describe.facts.kinks import compares_state
from symgen.describe.facts.short_changes import longest_step
from symgen.run.breaks.foreseen_seams import foresee_changes

if TYPE_CHECKING:
    from symgen.study.references.independent import IndependentEquations
    from symgen.study.references.motion import CompiledEquations

Array = NDArray[np.float64]

#: Tolerances of the two integrations of the general route; the first one is the reference.
FINE, COARSE = 3e-14, 3e-13
#: Name of a solver -> class of `scipy.integrate`, its tolerances, and whether it continues from a projected state.
SOLVERS: Mapping[str, tuple[str, float, float, bool]] = {
    "scipy-dop853": ("DOP853", FINE, COARSE, True),
    "scipy-radau": ("Radau", 1e-11, 1e-10, True),
    "scipy-bdf": ("BDF", 1e-10, 1e-9, False),
    "scipy-lsoda": ("LSODA", 1e-12, 1e-11, False),
}
#: A formula if one exists, else SciPy's DOP853.
AUTO = "auto"
#: Largest distance between the end of a step and the integral of the rates along it, in tolerances; the integral uses
#: so many evaluations.
UNSEEN, LOOKS = 1e4, 16
#: Steps are no longer than the time over this where forces compare the state, and shorter than this part of it they
#: are not taken again.
LOOKED_AT, SHORTEST = 200, 1e-6
#: Steps of multistep solvers, which are all as short as one of them has to be, are not shorter than this part of it.
FEWEST = 1e-4
#: Evaluation limit of a multistep solver.
MOST_CALLS = 3_000_000
#: So many consecutive steps below this fraction of the mean one count as collapsed: a singular position.
COLLAPSE, PATIENCE, MORE_PATIENCE = 1e-3, 30, 300
#: Errors of evaluations far off the constraints, and of SciPy where a Jacobian is not finite.
FAILURES = (ArithmeticError, ValueError, np.linalg.LinAlgError)


class OverBudgetError(SimulationError):
    """A reference exceeds its evaluation limit."""


class CollapsedError(SimulationError):
    """Steps became too small to advance, or the state is not finite: a singular position lies ahead."""

    def __init__(self, t: float, reason: str = "the state is not finite") -> None:
        super().__init__(f"the reference motion cannot be integrated beyond t = {t:.6g} s: {reason}")


@dataclass(frozen=True)
class Scheme:
    """Integration of equations step by step.

    Parameters
    ----------
    name : str
        Class of `scipy.integrate`.
    rtol : float
        Relative tolerance.
    every : int
        Every `every`-th output is projected, and the integration continues from it.
    mass_weighted : bool
        Whether projections are the shortest in the metric of M.
    step : float or None
        Constant step, with a projection after each [s].
    most : float
        Evaluation limit, Jacobians included.
    """

    name: str
    rtol: float
    every: int = 1
    mass_weighted: bool = True
    step: float | None = None
    most: float = math.inf


def check_solver(name: str) -> str:
    """Return the checked name of a way to a reference.

    Raises
    ------
    InputError
        If the way does not exist; names the nearest one.
    """
    return one_word_of("reference_by", name, (AUTO, *SOLVERS))


def integrate_by_steps(
    equations: IndependentEquations,
    y: Array,
    times: Array,
    scheme: Scheme,
    scale: Array | None = None,
    see: Callable[[float, float, Array], None] | None = None,
) -> Array:
    """Return the states at `times`, coordinates and their rates; steps end at the outputs.

    Where forces compare the state, a step that missed a comparison is repeated with half the length.

    Parameters
    ----------
    equations, y, times
        Integrated equations, initial state, and output times [s].
    scheme : Scheme
        Scheme of integration.
    scale : Array, optional
        Error scales; by default those of the state, at least 1.
    see : callable, optional
        Called with the length of each step, and the time and the state at its end.

    Raises
    ------
    SimulationError
        If the motion cannot be integrated, or not within the evaluations of the scheme.
    """
    import scipy.integrate

    scale = np.maximum(np.abs(y), 1.0) if scale is None else scale
    make: Any = getattr(scipy.integrate, scheme.name)  # SciPy's types lack arrays and infinity as tolerances
    compares = compares_state(equations.mechanism) and scheme.step is None
    longest = min(
        longest_reference_step(equations, times), float(times[-1]) / LOOKED_AT if compares and len(times) else np.inf
    )
    rate = Limited(equations, scheme.most)
    more: dict[str, Any] = {"rtol": scheme.rtol, "atol": scheme.rtol * scale, "max_step": longest}
    if scheme.step is not None:  # no error exceeds an infinite tolerance, so that every step is the largest allowed
        more = {"atol": np.inf, "max_step": scheme.step}
    elif scheme.name == "Radau":
        more["jac"] = rate.slopes
    # each jump of a force takes some tiny steps as well
    patience = MORE_PATIENCE if compares else PATIENCE

    def integrate_part(first: float, y: Array, times: Array) -> Array:
        motion = np.empty((len(times), len(y)))
        solver: Any = None  # nor that a step changes the status
        usual, steps, tiny = scheme.step or 0.0, 0, 0
        for k, t in enumerate(times.tolist()):
            if t > first and solver is None:
                begin = {} if scheme.step is None else {"first_step": min(scheme.step, t - first)}
                with finite_at(first):
                    solver = make(rate, first, y, t, **more, **begin)
            elif t > first:
                solver.t_bound, solver.status = t, "running"
                # the step before an output is cut short; continuing with it would waste evaluations
                solver.h_abs = max(solver.h_abs, usual)
            while solver is not None and solver.status == "running":
                before, at, state = solver.h_abs, float(solver.t), solver.y
                with finite_at(at):
                    message = solver.step()
                    looks = compares and solver.status != "failed"
                    unseen = unseen_change(equations, solver.dense_output(), at, solver.t, scale) if looks else 0.0
                    if unseen > UNSEEN * scheme.rtol and solver.step_size > SHORTEST * t:
                        solver = make(rate, at, state, t, first_step=0.5 * solver.step_size, **more)
                        continue
                    steps += 1
                    # of steps that are cut short before an output there is one in a row; many tiny ones lead nowhere
                    mean = (solver.t - first) / steps
                    tiny = tiny + 1 if solver.step_size is not None and solver.step_size < COLLAPSE * mean else 0
                    if solver.status == "failed" or tiny >= patience or not np.all(np.isfinite(solver.y)):
                        collapsed = "the step size collapses" if tiny else "the state is not finite"
                        raise CollapsedError(solver.t, message or collapsed)
                    if scheme.step is not None:
                        project_state(solver)
                if see is not None:
                    see(float(solver.step_size), float(solver.t), solver.y)
                usual = before if solver.status == "finished" else solver.h_abs
            if solver is not None:
                if k % scheme.every == 0 and scheme.step is None:
                    project_state(solver)
                y = solver.y
            motion[k] = y
        return motion

    def project_state(solver: Any) -> None:
        solver.y = equations.nearest_state(float(solver.t), solver.y, scheme.mass_weighted)
        solver.f = solver.fun(float(solver.t), solver.y)

    return integrate_in_parts(equations, y, times, integrate_part)


def integrate_by_multistep(equations: IndependentEquations, y: Array, times: Array, scheme: Scheme) -> Array:
    """Return the states at `times` from a multistep solver; outputs are projected: it allows no change on the way."""
    from scipy.integrate import solve_ivp

    solve: Any = solve_ivp  # SciPy's types lack arrays of tolerances
    scale, compares = np.maximum(np.abs(y), 1.0), compares_state(equations.mechanism)
    bound, rate = longest_reference_step(equations, times), Limited(equations, scheme.most)
    more: dict[str, Any] = {"rtol": scheme.rtol, "atol": scheme.rtol * scale, "dense_output": compares}
    if scheme.name == "BDF":
        more["jac"] = rate.slopes

    def integrate_part(first: float, y: Array, times: Array) -> Array:
        if times[-1] <= first:
            return np.tile(y, (len(times), 1))
        span = float(times[-1]) - first
        longest = min(bound, span / LOOKED_AT if compares else np.inf)
        while True:
            solution = solve(rate, (first, float(times[-1])), y, scheme.name, times, max_step=longest, **more)
            if not solution.success or not np.all(np.isfinite(solution.y)):
                raise CollapsedError(float(solution.t[-1]) if len(solution.t) else first, solution.message)
            steps = pairwise(solution.sol.ts.tolist()) if compares else ()
            blind = [
                b - a for a, b in steps if unseen_change(equations, solution.sol, a, b, scale) > UNSEEN * scheme.rtol
            ]
            longest = 0.5 * max(blind, default=0.0)
            if longest < FEWEST * span:
                return np.asarray(solution.y.T)

    solution = integrate_in_parts(equations, y, times, integrate_part)
    states = [equations.nearest_state(float(t), state) for t, state in zip(times, solution, strict=True)]
    return np.array(states).reshape(len(times), len(y))


@contextmanager
def finite_at(t: float) -> Iterator[None]:
    """Raise `CollapsedError` with the time where evaluations fail."""
    try:
        yield
    except FAILURES as error:
        raise CollapsedError(t) from error


class Limited:
    """Rates of equations, and their Jacobian, within a limit of evaluations.

    Parameters
    ----------
    equations : IndependentEquations
        The equations.
    most : float
        Largest number of evaluations; a Jacobian counts as those that its differences take.
    """

    def __init__(self, equations: IndependentEquations, most: float) -> None:
        self._equations, self._most, self._calls = equations, most, 0

    def __call__(self, t: float, y: Array) -> Array:
        """Return the rates."""
        self._count_evaluations(1)
        return self._equations.rate(t, y)

    def slopes(self, t: float, y: Array) -> Array:
        """Return the Jacobian of the rates."""
        self._count_evaluations(2 * len(y))
        return self._equations.slopes(t, y)

    def _count_evaluations(self, more: int) -> None:
        self._calls += more
        if self._calls > self._most:
            raise OverBudgetError(f"the reference takes more than {self._most:g} evaluations")


def unseen_change(
    equations: IndependentEquations, motion: Callable[[float], Array], first: float, last: float, scale: Array
) -> float:
    """Return the distance of a step's end from the integral of the rates along it, over `scale`.

    A force that acts between two values of the state, and only there, may lie between all evaluations of a step, where
    no error estimate sees it.
    """
    nodes, weights = np.polynomial.legendre.leggauss(LOOKS)
    half, middle = 0.5 * (last - first), 0.5 * (last + first)
    along = [equations.rate(t, motion(t)) for t in (middle + half * nodes).tolist()]
    change = motion(last) - motion(first) - half * (weights @ np.array(along))
    return float(np.max(np.abs(change) / scale))


#: Parts that are shorter than this part of the end lead from one side of a jump to the other.
JUMP = 3e-12

#: Called with the time at which a part begins, the state there, the times at which states are wanted, the last of them
#: the part's end; returns the states.
Integrate = Callable[[float, Array, Array], Array]


def longest_reference_step(equations: IndependentEquations, times: Array) -> float:
    """Return the longest step of a reference that resolves the formulas of the time [s]."""
    return longest_step(equations.mechanism, float(times[-1]))[0] if len(times) and times[-1] > 0.0 else np.inf


def integrate_in_parts(
    equations: IndependentEquations,
    y: Array,
    times: Array,
    integrate: Integrate,
) -> Array:
    """Return the states at some times, integrated part by part.

    Parameters
    ----------
    equations : IndependentEquations
        Integrated equations with their formulas.
    y : Array
        The state at the time 0.
    times : Array
        Increasing from 0 or later [s].
    integrate : callable
        See `Integrate`.
    """
    motion, done = np.empty((len(times), len(y))), 0
    end = float(times[-1]) if len(times) else 0.0
    seams = foresee_changes(equations.mechanism).seams(equations.parameters, end) if end else ()
    for first, last in pairwise([*([seam.t for seam in seams] or [0.0]), end]):
        upto = int(np.searchsorted(times, last, side="right"))
        own = times[done:upto]
        if seams and last - first < JUMP * end:  # what acts before it up to its middle, and then what acts after it
            y = y + 0.5 * (last - first) * (equations.rate(first, y) + equations.rate(last, y))
            states = np.tile(y, (len(own), 1))
        else:
            instants = own if len(own) and own[-1] == last else np.append(own, last)
            states = integrate(first, y, instants)
            y = states[-1]
        motion[done:upto], done = states[: len(own)], upto
    return motion


#: Radau integrates motions with a decay of more e-foldings.
STIFF_FOLDINGS = 3e4


def is_stiff(equations: CompiledEquations, y: Array, until: float) -> bool:
    """Whether something decays over a motion by more than `STIFF_FOLDINGS`.

    A conservative system has modes in pairs, one growing for each decaying, and is not stiff over any length; the
    excess of decay over growth counts.
    """
    falling, growing = fastest_modes(equations, y)
    return (falling - growing) * until > STIFF_FOLDINGS


def fastest_modes(equations: CompiledEquations, y: Array) -> tuple[float, float]:
    """Return the fastest decay and the fastest growth of the linearised equations at a state [1/s]."""
    slopes = equations.slopes(0.0, y)
    if not np.all(np.isfinite(slopes)):
        return 0.0, 0.0
    real = np.linalg.eigvals(slopes).real
    return float(max(0.0, -real.min(initial=0.0))), float(real.max(initial=0.0))
