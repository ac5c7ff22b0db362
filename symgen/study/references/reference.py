"""References: the motion as exactly as it can be had, by routes that share nothing with the emitted code.

A mechanism of the catalogue for which `CLOSED` knows a formula, or an equation in one coordinate, gets that; every
other one is integrated by SciPy's DOP853 at a tight tolerance from independently derived equations, projected at each
output, twice with different tolerances and segments, the difference of the two being the estimated error. Where the
motion comes near a singular position, constant steps lead through, and two runs whose steps fall differently have to
agree (`symgen.study.references.singular_passing`); where they do not, the reference says so. Another of SciPy's
solvers can be asked for, for every mechanism: then schemes, too, are others than symgen's.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from msgspec import structs
from numpy.typing import NDArray

from symgen.describe.mechanism import Mechanism
from symgen.errors import InputError
from symgen.result.points import AGREEMENT, Points
from symgen.study.references.closed_space import CLOSED_SPACE
from symgen.study.references.singular_passing import SingularWatch, pass_through
from symgen.study.references.solvers import (
    AUTO,
    MOST_CALLS,
    SOLVERS,
    CollapsedError,
    Scheme,
    by_steps,
    check_solver,
    in_one_go,
)

if TYPE_CHECKING:
    from symgen.study.references.independent import IndependentEquations

Array = NDArray[np.float64]

#: Two runs through singular positions that agree by chance understate their error; it was up to five times the
#: difference with `n-four-bar`, whose exact motion is known.
DOUBT = 5.0


@dataclass(frozen=True)
class Reference:
    """A motion to compare with.

    Attributes
    ----------
    how, estimated_error : str, float
        Where it comes from, in one sentence, and how far its points may be off [m].
    times, q : Array, shapes (k,), (k, nq)
        Times [s] and coordinates.
    note : str
        One sentence where two runs with different steps part at a singular position: what errors mean then. Empty
        where there is nothing to say.
    """

    how: str
    estimated_error: float
    times: Array
    q: Array
    note: str = ""


def reference(
    mechanism: Mechanism,
    parameters: Mapping[str, float],
    q: Array,
    v: Array,
    times: Array,
    solver: str = AUTO,
    own_start: bool = True,
) -> Reference:
    """Return the reference motion of a mechanism.

    Parameters
    ----------
    mechanism : Mechanism
        What moves.
    parameters : mapping
        Values of all parameters.
    q, v : Array, shapes (nq,), (nv,)
        Consistent start.
    times : Array
        Where the motion is wanted [s], increasing from 0 or later.
    solver : str
        ``auto``, or one of `SOLVERS`.
    own_start : bool
        Whether the start is the one that the mechanism describes: formulas know no other one.

    Raises
    ------
    InputError
        If there is no such solver.
    SimulationError
        If the motion cannot be integrated, e.g. into a singularity.
    """
    if check_solver(solver) != AUTO:
        return _integrated(mechanism, parameters, (q, v), times, solver)
    closed = closed_form(mechanism) if own_start else None
    if closed is not None:
        how, estimated, motion = closed(mechanism, parameters, q, times)
        return Reference(how, estimated, times, motion)
    return _integrated(mechanism, parameters, (q, v), times, "scipy-dop853")


def closed_form(mechanism: Mechanism) -> Callable[[Mechanism, Mapping[str, float], Array, Array], Closed] | None:
    """Return the formula for the motion of a mechanism of the catalogue, None where there is none."""
    closed = CLOSED.get(_family(mechanism))
    return closed if closed is not None and _from_catalogue(mechanism) else None


def _family(mechanism: Mechanism) -> str:
    return "n-four-bar" if mechanism.name.startswith("n-four-bar-") else mechanism.name


def _from_catalogue(mechanism: Mechanism) -> bool:
    """Whether a mechanism is the one of the catalogue, not another of the same name."""
    from symgen.describe.load import load

    family = _family(mechanism)
    size = mechanism.name.removeprefix("n-four-bar-")
    try:
        entry = load(f"{family}:{size}" if family == "n-four-bar" else family)
    except InputError:
        return False
    return structs.replace(entry, defaults=mechanism.defaults) == mechanism


# -- formulas ----------------------------------------------------------------------------------------------------------

Closed = tuple[str, float, Array]


def pendulum(mechanism: Mechanism, parameters: Mapping[str, float], q: Array, times: Array) -> Closed:
    """Released at rest at x = -1: sin(phi / 2) = k cd(w t, k^2), phi from the downward vertical, k = sin(phi_0 / 2)."""
    from scipy.special import ellipj, ellipk

    length, gravity = 1.0, 9.81
    phi0 = math.atan2(q[0], -q[1])
    k = math.sin(phi0 / 2.0)
    # whole periods are taken off first: the functions lose digits with the size of their argument
    u = np.remainder(math.sqrt(gravity / length) * times, 4.0 * ellipk(k * k))
    _, cn, dn, _ = ellipj(u, k * k)
    phi = 2.0 * np.arcsin(k * cn / dn)
    motion = length * np.column_stack([np.sin(phi), -np.cos(phi)])
    return "Jacobi's elliptic functions", 1e-14 * max(100.0, float(times[-1])), motion


def n_four_bar(mechanism: Mechanism, parameters: Mapping[str, float], q: Array, times: Array) -> Closed:
    """All verticals turn alike, and couplers are carried: see `parallel_cranks`."""
    return parallel_cranks([body.name for body in mechanism.bodies], times)


def parallel_cranks(names: Sequence[str], times: Array) -> Closed:
    """((N + 1) / 3 + N) theta'' = g ((N + 1) / 2 + N) sin(theta), theta clockwise from the upward vertical.

    The bodies are ``vertical0`` to ``verticalN`` and ``coupler0`` to ``couplerN-1``, of 1 m and 1 kg; verticals begin
    upright with 1 rad/s to the right. This is the regular branch of their motion.
    """
    from scipy.integrate import solve_ivp

    n = sum(name.startswith("coupler") for name in names)
    factor = 9.81 * ((n + 1) / 2 + n) / ((n + 1) / 3 + n)

    def solve(rtol: float) -> Array:
        def rate(_: float, y: Array) -> list[float]:
            return [y[1], factor * math.sin(y[0])]

        end = float(times[-1])
        # short steps: interpolation to the output times must not be what limits the accuracy
        solution = solve_ivp(rate, (0.0, end), [0.0, 1.0], "DOP853", times, rtol=rtol, atol=rtol, max_step=0.01)
        return np.asarray(solution.y[0], dtype=float)

    theta = solve(3e-14)
    s, c, zero = np.sin(theta), np.cos(theta), np.zeros(len(times))
    columns: list[Array] = []
    for name in names:
        if name.startswith("vertical"):
            columns += [int(name.removeprefix("vertical")) + 0.5 * s, 0.5 * c, math.pi / 2 - theta]
        else:
            columns += [int(name.removeprefix("coupler")) + 0.5 + s, c, zero]
    estimated = 2.0 * float(np.abs(solve(1e-12) - theta).max(initial=0.0))
    return "the equation of the regular branch in one coordinate, DOP853 at 3e-14", estimated, np.column_stack(columns)


def driven_four_bar(mechanism: Mechanism, parameters: Mapping[str, float], q: Array, times: Array) -> Closed:
    """Crank angle as prescribed; the joint of coupler and rocker where two circles meet, on the side of the start."""
    crank, coupler, rocker, base = 2.0, 8.0, 5.0, 10.0
    theta = parameters["crank_start"] + parameters["crank_speed"] * times
    bx, by = crank * np.cos(theta), crank * np.sin(theta)
    dx, dy = base - bx, -by
    d = np.hypot(dx, dy)
    along = (d**2 + coupler**2 - rocker**2) / (2.0 * d)
    across = np.sqrt(coupler**2 - along**2)
    # q holds crank x, y, theta, coupler x, y, theta, ...: on which side of the line from B to D the coupler lies
    b0 = crank * np.array([math.cos(parameters["crank_start"]), math.sin(parameters["crank_start"])])
    side = math.copysign(1.0, (base - b0[0]) * (q[4] - b0[1]) + b0[1] * (q[3] - b0[0]))
    cx = bx + (along * dx - side * across * dy) / d
    cy = by + (along * dy + side * across * dx) / d
    coupler_angle = np.unwrap(np.arctan2(cy - by, cx - bx))
    rocker_angle = np.unwrap(np.arctan2(cy, cx - base))
    motion = np.column_stack(
        [bx / 2, by / 2, theta, (bx + cx) / 2, (by + cy) / 2, coupler_angle, (base + cx) / 2, cy / 2, rocker_angle]
    )
    return "closed form: the prescribed crank and the intersection of two circles", 1e-13, motion


#: Mechanism of the catalogue -> formula.
CLOSED: Mapping[str, Callable[[Mechanism, Mapping[str, float], Array, Array], Closed]] = {
    "driven-four-bar": driven_four_bar,
    "n-four-bar": n_four_bar,
    "pendulum": pendulum,
    **CLOSED_SPACE,
}


# -- any mechanism -----------------------------------------------------------------------------------------------------


def _integrated(
    mechanism: Mechanism,
    parameters: Mapping[str, float],
    start: tuple[Array, Array],
    times: Array,
    solver: str,
) -> Reference:
    """Integrate independently derived equations twice."""
    from symgen.study.references.independent import IndependentEquations

    name, fine_tolerance, coarse_tolerance, goes_on = SOLVERS[solver]
    equations = IndependentEquations(mechanism, parameters)
    y = equations.project(0.0, equations.state(*start))

    if not goes_on:
        fine = in_one_go(equations, y, times, Scheme(name, fine_tolerance, most=MOST_CALLS))
        coarse = in_one_go(equations, y, times, Scheme(name, coarse_tolerance, most=MOST_CALLS))
    else:
        watch, sizes = SingularWatch(equations, y), list[float]()

        def see(size: float, t: float, state: Array) -> None:
            sizes.append(size)
            watch.see(t, state)

        try:
            fine = by_steps(equations, y, times, Scheme(name, fine_tolerance), see=see)
            collapsed = False
        except CollapsedError:
            collapsed = True
        if collapsed or watch.passed:
            return _through(mechanism, parameters, equations, y, times, sizes)
        coarse = by_steps(equations, y, times, Scheme(name, coarse_tolerance, 3, False))
    estimated = Points.of(mechanism, parameters).distance(fine, coarse)
    how = (
        f"independently derived equations, SciPy {name} at {fine_tolerance:g}, projected at every output; "
        f"estimated from a second run at {coarse_tolerance:g}"
    )
    return Reference(how, max(estimated, 1e-14), times, fine)


def _usual(sizes: list[float]) -> float:
    """Return the step by which half of the time was covered: steps that collapsed are many but cover nothing."""
    ordered = np.sort(np.array(sizes))
    covered = np.cumsum(ordered)
    return float(ordered[int(np.searchsorted(covered, 0.5 * covered[-1]))])


def _through(
    mechanism: Mechanism,
    parameters: Mapping[str, float],
    equations: IndependentEquations,
    y: Array,
    times: Array,
    sizes: list[float],
) -> Reference:
    """Return the reference of a motion that comes near singular positions."""
    step = _usual(sizes) if sizes else float(times[-1]) / 1000.0
    passage = pass_through(equations, y, times, step, Points.of(mechanism, parameters))
    how = (
        f"independently derived equations, SciPy DOP853 at constant steps near {step:.2g} s, projected after every "
        f"step, through singular positions; estimated from {passage.runs} runs whose steps fall differently"
    )
    note = ""
    if passage.parted is not None:
        note = (
            f"the two reference runs that agree best part by more than {AGREEMENT:g} of the mechanism's size at "
            f"t = {passage.parted:.4g} s, behind a singular position: from there on it is not known which branch the "
            "motion takes, and errors are distances to one of them"
        )
    return Reference(how, max(DOUBT * passage.difference, 1e-14), times, passage.q, note)
