"""Parameters that change while a run goes on: what follows is the run that begins there with the new values."""

from dataclasses import replace

import numpy as np

from symgen.api import load
from symgen.base.settings import Settings
from symgen.run.planning.prepare import prepare
from symgen.run.single.simulation import Simulation

PAIRS = [
    *(("direct-correction", name) for name in ("rk4", "abm4", "abm", "dop853", "radau5", "sdirk", "rkmk4")),
    *(("lagrange", "newmark"), ("index3-augmented-lagrangian", "trapezoidal")),
    *(("generalized-alpha", "generalized-alpha"), ("coordinate-partitioning", "abm")),
]
UNTIL, STEP, CHANGED = 0.1, 2e-3, {"crank_mass": 3.0, "rocker_mass": 1.5}


def simulation(method, integrator, parameters=None, y=None):
    """Return a simulation over `UNTIL`, from a state where one is given."""
    adaptive = integrator in ("abm", "dop853", "radau5", "sdirk")
    more = {} if adaptive else {"step": STEP}
    settings = Settings(
        method=method, integrator=integrator, until=UNTIL, times=[UNTIL], shape="straight", max_violation=1e-3, **more
    )
    run = prepare(load("four-bar").mechanism, replace(settings, parameters=parameters or {}))
    start = run.start if y is None else replace(run.start, y=y.copy())
    return Simulation(run.compiled, run.plan.integrator, start, run.spec)


def parameters(simulation, values):
    """Return the parameters of a run with others among them."""
    info = simulation.compiled.info
    return np.array([values.get(q.name, x) for q, x in zip(info.parameters, simulation.state.p, strict=False)])
