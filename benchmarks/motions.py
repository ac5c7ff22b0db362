"""Runs of single methods for the tables: suitable integrators, and extrapolated motions of second-order ones."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from symgen.api import Model
from symgen.derive.methods import METHODS
from symgen.result.result import Result
from symgen.run.integrators import INTEGRATORS

Array = NDArray[np.float64]
Options = Mapping[str, str | float]


def fine_integrator(method: str) -> str:
    """Return the integrator of highest order that fits a method: `dop853` where it can be used."""
    forms = METHODS.get(method).forms
    return "dop853" if {"ode", "one-step"} & set(forms) else METHODS.get(method).default_integrator


def second_order(method: str) -> bool:
    """Whether only integrators of order 2 fit a method."""
    return INTEGRATORS.get(fine_integrator(method)).order == 2


def run(
    model: Model,
    method: str,
    integrator: str,
    step: float,
    times: Array,
    parameters: Mapping[str, float] | None = None,
    options: Options | None = None,
) -> Result:
    """Run with constant steps, outputs at `times`."""
    chosen = dict(options or {})
    if INTEGRATORS.get(integrator).adaptive:
        chosen["integrator.adaptive"] = "false"
    return model.simulate(
        method=method,
        integrator=integrator,
        step=step,
        until=float(times[-1]),
        times=times.tolist(),
        parameters=parameters or {},
        options=chosen,
    )


def positions(result: Result) -> Array:
    """Return q at the outputs, shape (k, nq)."""
    return np.asarray(result.q)


def motion(
    model: Model,
    method: str,
    step: float,
    times: Array,
    parameters: Mapping[str, float] | None = None,
    options: Options | None = None,
) -> tuple[Array, Result]:
    """Return q at `times` with a method's best integrator, and the run.

    Where only order 2 is to be had, steps h and h / 2 are extrapolated (Richardson). `times` should be multiples of the
    step then: a shortened step before an output has an error of its own.
    """
    integrator = fine_integrator(method)
    coarse = run(model, method, integrator, step, times, parameters, options)
    q = positions(coarse)
    if not second_order(method) or len(q) < len(times):
        return q, coarse
    fine = run(model, method, integrator, step / 2.0, times, parameters, options)
    halved = positions(fine)
    return (4.0 * halved - q) / 3.0 if len(halved) == len(q) else halved, fine
