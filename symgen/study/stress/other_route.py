"""Reference motions of mechanisms whose second derivation is not compiled: two formulations that agree.

The second derivation of a spatial mechanism (`symgen.study.references.independent`) is interpreted: too slow for
the many motions of a stress study. What can differ at the speed of compiled code is how the equations are formulated
and integrated. The motion is that of `direct-correction` with Runge-Kutta steps at a tight tolerance; its error is
estimated from `index1-augmented-lagrangian`, which solves another system for the accelerations, with Adams steps.
"""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from symgen.describe.evaluate import parameter_values
from symgen.describe.mechanism import Mechanism
from symgen.errors import SimulationError
from symgen.result.points import Points
from symgen.running.prepare import prepare
from symgen.runtime import abi
from symgen.runtime.assembly import Start
from symgen.runtime.compiled import CompiledModel
from symgen.runtime.probe import Ready
from symgen.settings import Settings
from symgen.study.references.reference import Reference
from symgen.study.stress.effort import LARGEST_IMPLICIT_REFERENCE, explicit_budget, implicit_budget

Array = NDArray[np.float64]

Route = tuple[str, str, dict[str, str | float], float]
#: Method, integrator, options and tolerance of the two routes; the first is the reference.
ROUTES: tuple[Route, ...] = (
    ("direct-correction", "dop853", {"method.weight": "mass"}, 1e-12),
    ("index1-augmented-lagrangian", "abm", {}, 1e-11),
)
#: The same where decay asks explicit steps for more evaluations than they may take.
STIFF_ROUTES: tuple[Route, ...] = (
    ("direct-correction", "radau5", {"method.weight": "mass"}, 1e-10),
    ("ggl", "radau5", {}, 1e-9),
)
#: The first ones where rounding of very stiff forces makes their tolerances unattainable.
ROUGH_ROUTES = tuple((*route[:3], rtol) for route, rtol in zip(ROUTES, (1e-9, 1e-8), strict=True))
#: Evaluations after which a route is given up, for small mechanisms.
BUDGET, STIFF_BUDGET = 20_000_000, 300_000
#: Evaluations that decay may ask explicit steps for, for small mechanisms; the stiff routes are taken beyond.
STIFF_FROM = 6_000_000


class EmittedGeometry:
    """Phi, D and nu of a compiled model as numbers.

    Parameters
    ----------
    compiled, start : CompiledModel, Start
        Model and method, and a start with the parameters prepared.
    """

    def __init__(self, compiled: CompiledModel, start: Start) -> None:
        self.compiled, self.start = compiled, start
        self.m, self.n = compiled.info.m, compiled.info.nv

    def evaluate(self, t: float, q: Array, v: Array) -> tuple[Array, Array, Array]:
        """Return Phi, D and nu at a state."""
        w, y = self.start.w.copy(), np.concatenate([q, v, [0.0]])
        Ready(self.compiled.model.geometry, abi.MEASURE)(t, y, self.start.p, w)
        section = self.compiled.section
        return section(w, "residual").copy(), self.compiled.jacobian(w), section(w, "nu").copy()


def agreed(mechanism: Mechanism, parameters: Mapping[str, float], times: Array, decay: float = 0.0) -> Reference:
    """Return the motion by the first of `ROUTES`, or of `STIFF_ROUTES`, its error estimated by the second.

    Parameters
    ----------
    mechanism : Mechanism
        What moves.
    parameters : mapping
        Values that differ from the mechanism's own.
    times : Array
        Where the motion is wanted [s], increasing from 0.
    decay : float
        Fastest decay at the start [1/s].

    Raises
    ------
    SimulationError
        If a route does not come to its end.
    """
    # twelve evaluations a step of dop853, which is stable up to 6.39 over the decay
    stiff = decay * float(times[-1]) * 12.0 / 6.39 > explicit_budget(mechanism, STIFF_FROM)
    if stiff and mechanism.body_coordinates > LARGEST_IMPLICIT_REFERENCE:
        raise SimulationError(
            f"its fastest decay, {decay:.2g} 1/s, asks for implicit steps, whose dense matrices are too large for "
            f"references from {LARGEST_IMPLICIT_REFERENCE} coordinates on"
        )
    if stiff:
        return _agreed(mechanism, parameters, times, STIFF_ROUTES, implicit_budget(mechanism, STIFF_BUDGET))
    explicit = explicit_budget(mechanism, BUDGET)
    try:
        return _agreed(mechanism, parameters, times, ROUTES, explicit)
    except SimulationError:
        return _agreed(mechanism, parameters, times, ROUGH_ROUTES, explicit)


def _agreed(
    mechanism: Mechanism, parameters: Mapping[str, float], times: Array, routes: tuple[Route, ...], budget: int
) -> Reference:
    found = []
    for method, integrator, options, rtol in routes:
        settings = Settings(
            method=method,
            integrator=integrator,
            options=options,
            rtol=rtol,
            atol=1e-2 * rtol,
            until=float(times[-1]),
            times=list(times),
            parameters=parameters,
            shape="straight" if routes is STIFF_ROUTES else "looped",
        )
        run = prepare(mechanism, settings).with_spec(max_evaluations=budget)
        outcome = run.integrate()
        if outcome.interrupted:
            raise KeyboardInterrupt
        if outcome.code != abi.DONE:
            reason = f"it takes more than {budget:.3g} evaluations" if outcome.code == abi.STOPPED else outcome.reason
            raise SimulationError(f"the reference by {method} with {integrator} does not come to its end: {reason}")
        found.append(run.positions(outcome))
    apart = Points.of(mechanism, parameter_values(mechanism, parameters)).distance(*found)
    (method, integrator, _, rtol), (other, with_other, _, _) = routes
    how = f"{method} with {integrator} at {rtol:g}; estimated from {other} with {with_other}"
    return Reference(how, max(apart, 1e-14), times, found[0])
