"""References by compiled code: two formulations of the equations with two integrators.

The second derivation of a mechanism in space (`symgen.study.references.independent`) is interpreted: too slow for the
many motions of a stress study. Without one are beam elements, rows with bounds, and events that change the state.
Compiled code can differ in the formulation of the equations and in the integrator. The motion is that of
`direct-correction` with Runge-Kutta steps at a tight tolerance; its error is estimated from
`index1-augmented-lagrangian`, which solves another system for the accelerations, with Adams steps. Where bounds
depend on reactions, which that system finds by iteration, `lagrange` in joint coordinates takes its place.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import replace
from typing import NamedTuple

import numpy as np
from msgspec import structs
from numpy.typing import NDArray

from symgen.base.errors import SimulationError
from symgen.base.settings import Settings
from symgen.describe.bounds.bounded_modes import rows_by_family, without_bounds
from symgen.describe.bounds.by_reaction import pressed_rows
from symgen.describe.formulas.evaluate import parameter_values
from symgen.describe.mechanism import Mechanism
from symgen.describe.parts.event_sections import RESET
from symgen.result.points import Points
from symgen.result.reactions import Forces, seats_of_reactions
from symgen.run.compiling.choices import straight_seconds
from symgen.run.compiling.pipeline import straight_alone
from symgen.run.layout import abi
from symgen.run.layout.compiled import CompiledModel
from symgen.run.planning.automatic import linearise_start
from symgen.run.planning.prepare import prepare
from symgen.run.starts.assembly import Start
from symgen.study.references.effort import LARGEST_IMPLICIT_REFERENCE, explicit_budget, implicit_budget
from symgen.study.references.reference import Reference

Array = NDArray[np.float64]


class Route(NamedTuple):
    """A formulation of the equations with an integrator and its relative tolerance."""

    method: str
    integrator: str
    options: Mapping[str, str | float]
    rtol: float
    coordinates: str = "absolute"


#: Method, integrator, options and tolerance of the two routes; the first is the reference.
ROUTES: tuple[Route, ...] = (
    Route("direct-correction", "dop853", {"method.weight": "mass"}, 1e-12),
    Route("index1-augmented-lagrangian", "abm", {}, 1e-11),
)
#: Routes where decay requires more evaluations of explicit steps than the limit.
STIFF_ROUTES: tuple[Route, ...] = (
    Route("direct-correction", "radau5", {"method.weight": "mass"}, 1e-10),
    Route("ggl", "radau5", {}, 1e-9),
)
#: Explicit routes where rounding of very stiff forces makes their tolerances unattainable.
ROUGH_ROUTES = tuple(route._replace(rtol=rtol) for route, rtol in zip(ROUTES, (1e-9, 1e-8), strict=True))
#: Evaluation limit of a route, for small mechanisms; the last one where implicit routes are tried first.
BUDGET, STIFF_BUDGET, TRIED_STIFF_BUDGET = 20_000_000, 300_000, 30_000
#: Evaluations of looped code after which a route begins again with straight code, where that compiles within some
#: seconds: it is several times as fast, and its rounding is smaller.
LOOPED_BUDGET, LONGEST_COMPILATION = 100_000, 10.0
#: A tolerance that can be attained takes less than so many times the evaluations of a rough one.
UNATTAINED = 6
#: Evaluation limit of explicit steps due to decay, for small mechanisms; the stiff routes are used beyond.
STIFF_FROM = 6_000_000


def parts_without_derivation(mechanism: Mechanism) -> str:
    """Return what no second derivation of a mechanism has; empty where it has all of it."""
    if any(force.flexures for force in mechanism.forces):
        return "beam elements"
    if mechanism.has_modal_bodies:
        return "modal bodies"
    for family in rows_by_family(mechanism):
        return family.noun
    if mechanism.holding:
        return "joints that hold for a while"
    return "events that change the state" if any(event.action == RESET for event in mechanism.events) else ""


def derivable_part(mechanism: Mechanism) -> Mechanism:
    """Return a mechanism without what no second derivation has: its positions and constraints are the same."""
    if not parts_without_derivation(mechanism):
        return mechanism
    forces = tuple(structs.replace(force, flexures=()) for force in mechanism.forces)
    return structs.replace(without_bounds(mechanism), events=(), forces=forces)


def _fitting_routes(mechanism: Mechanism, routes: tuple[Route, ...]) -> tuple[Route, ...]:
    """Return routes for massless bodies, which have no metric of masses, and for bounds by reactions."""
    first, second = routes
    if mechanism.has_massless:
        first = first._replace(options={})
    if pressed_rows(mechanism):
        second = Route("lagrange", second.integrator, {}, second.rtol, "joint")
    return first, second


def fastest_decay(mechanism: Mechanism, compiled: CompiledModel, start: Start) -> float:
    """Return the fastest decay of the linearised motion at the start [1/s]; 0 where it cannot be computed."""
    jacobian = linearise_start(mechanism, compiled, start)
    if not np.all(np.isfinite(jacobian)):
        return 0.0
    return float(max(0.0, -np.linalg.eigvals(jacobian).real.min(initial=0.0)))


def motion_by_two_routes(
    mechanism: Mechanism,
    parameters: Mapping[str, float],
    times: Array,
    decay: float = 0.0,
    start: Mapping[str, float] | None = None,
    enough: float = 0.0,
    quick: bool = False,
) -> Reference:
    """Return the motion by the first of `ROUTES`, or of `STIFF_ROUTES`, its error estimated by the second.

    Parameters
    ----------
    mechanism : Mechanism
        The mechanism.
    parameters : mapping
        Values that differ from the mechanism's own.
    times : Array
        Output times [s], increasing from 0.
    decay : float
        Fastest decay at the start [1/s].
    start : mapping, optional
        Prescribed coordinates and velocities of the start.
    enough : float
        Estimated error, over the mechanism's size, with which rough tolerances do instead of long integrations.
    quick : bool
        Whether long routes are rough, and implicit ones are tried where decay asks for more than `LOOPED_BUDGET`.

    Raises
    ------
    SimulationError
        If a route does not reach its end.
    """
    # twelve evaluations a step of dop853, which is stable up to 6.39 over the decay
    evaluations = decay * float(times[-1]) * 12.0 / 6.39
    if evaluations > explicit_budget(mechanism, STIFF_FROM) and not _has_implicit(mechanism):
        raise SimulationError(
            f"its fastest decay, {decay:.2g} 1/s, needs implicit steps, whose dense matrices are too large for "
            f"references from {LARGEST_IMPLICIT_REFERENCE} coordinates on"
        )
    common = Settings(parameters=parameters, start=start or {}, until=float(times[-1]), times=list(times))
    size = Points.of_mechanism(mechanism, parameter_values(mechanism, parameters)).size
    reference, failures = None, list[SimulationError]()
    for attempt in _attempts_in_order(mechanism, evaluations, enough, quick):
        try:
            reference = _motion_by_routes(mechanism, common, attempt)
        except SimulationError as error:
            failures.append(error)
            continue
        if quick or attempt.routes is not ROUGH_ROUTES or reference.estimated_error <= enough * size(reference.q):
            break
    if reference is None:
        raise failures[-1]
    return reference


class Attempt(NamedTuple):
    """Two routes in a shape of code, each within so many evaluations."""

    routes: tuple[Route, ...]
    shape: str
    budget: int


def _has_implicit(mechanism: Mechanism) -> bool:
    return mechanism.body_coordinates <= LARGEST_IMPLICIT_REFERENCE


def _attempts_in_order(mechanism: Mechanism, evaluations: float, enough: float, quick: bool) -> Iterator[Attempt]:
    """Yield what is tried in turn, where explicit steps need so many `evaluations` for the decay.

    A tight integration that comes to no end may have tolerances that rounding does not allow: rough ones come before a
    long one.
    """
    if evaluations > explicit_budget(mechanism, STIFF_FROM):
        yield Attempt(STIFF_ROUTES, "straight", implicit_budget(mechanism, STIFF_BUDGET))
        return
    looped, rough = not straight_alone(mechanism), quick or enough > 0.0
    if quick and evaluations > LOOPED_BUDGET and _has_implicit(mechanism):
        budget = implicit_budget(mechanism, TRIED_STIFF_BUDGET)
        yield Attempt(STIFF_ROUTES, "looped" if looped else "straight", budget)
    most = explicit_budget(mechanism, BUDGET)
    shape = "straight" if straight_alone(mechanism) or straight_seconds(mechanism) < LONGEST_COMPILATION else "looped"
    if looped:
        short = min(most, LOOPED_BUDGET)
        yield Attempt(ROUTES, "looped", short)
        if rough:
            yield Attempt(ROUGH_ROUTES, "looped", short if quick else short // UNATTAINED)
    for routes in (ROUGH_ROUTES, ROUTES) if looped and rough else (ROUTES, ROUGH_ROUTES):
        if not (quick and looped and routes is ROUTES):
            yield Attempt(routes, shape, most)


def _motion_by_routes(mechanism: Mechanism, common: Settings, attempt: Attempt) -> Reference:
    motions, routes = [], _fitting_routes(mechanism, attempt.routes)
    for method, integrator, options, rtol, coordinates in routes:
        settings = replace(common, method=method, integrator=integrator, options=options)
        settings = replace(settings, rtol=rtol, atol=1e-2 * rtol, coordinates=coordinates)
        settings = replace(settings, shape="straight" if coordinates == "joint" else attempt.shape)
        run = prepare(mechanism, settings).with_spec(max_evaluations=attempt.budget)
        outcome = run.integrate()
        if outcome.interrupted:
            raise KeyboardInterrupt
        if outcome.code != abi.DONE:
            many = f"it takes more than {attempt.budget:.3g} evaluations"
            reason = many if outcome.code == abi.STOPPED else outcome.reason
            raise SimulationError(f"the reference by {method} with {integrator} does not come to its end: {reason}")
        motions.append(run.of_bodies(outcome))
    values, nq = parameter_values(mechanism, common.parameters), motions[0].compiled.info.nq
    apart = Points.of_mechanism(mechanism, values).largest_distance(*(motion.states[:, :nq] for motion in motions))
    q, v = motions[0].compiled.info.parts(motions[0].states)
    forces = Forces(motions[0], seats_of_reactions(mechanism, values))
    multipliers = forces.multipliers()
    lam = dict(zip(multipliers.names, multipliers.values.T, strict=True))
    (method, integrator, _, rtol, _), (other, with_other, _, _, coordinates) = routes
    how = f"{method} with {integrator} at {rtol:g}; estimated from {other} with {with_other}"
    how += " in joint coordinates" if coordinates == "joint" else ""
    if lacking := parts_without_derivation(mechanism):
        how += f"; there is no second derivation of {lacking}"
    times = np.array(common.times)
    return Reference(how, max(apart, 1e-14), times, q, v, lam=lam, undetermined=forces.non_unique)
