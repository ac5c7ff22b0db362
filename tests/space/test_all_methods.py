"""Every method on a spatial mechanism, with the integrator it is meant for, against one run at a tight tolerance."""

from functools import cache

import numpy as np
import pytest
from support.spatial_runs import columns, run

from symgen.derive.methods import METHODS
from symgen.result.points import Points
from symgen.run.integrators import INTEGRATORS
from symgen.run.planning.automatic import constant_integrator

TIMES = np.linspace(0.0, 0.3, 7)
#: Of second order, or with an error of its own as the penalty has: they need more room [m].
ROUGH = {"generalized-alpha": 3e-5, "index3-augmented-lagrangian": 3e-5, "penalty": 1e-6}
ROUGH |= {"compliant-constraints": 1e-6, "braun-goldfarb": 1e-5}
ROUGH |= {"half-explicit": 3e-6, "rattle": 1e-4, "discrete-gradient": 1e-4}
#: Their violations are judged and end such a run.
COARSE = ("implicit-constraint",)


@cache
def expected():
    model, result = run("spatial-slider-crank", until=0.3, times=TIMES)
    return model, columns(result, model.mechanism)


@pytest.mark.by_turns(4)
@pytest.mark.slow
@pytest.mark.parametrize("method", [m for m in METHODS.names if m not in COARSE])
def test_every_method_moves_the_slider_crank(method):
    model, q = expected()
    integrator = constant_integrator(method)
    settings = (
        {"rtol": 1e-9, "atol": 1e-11}
        if INTEGRATORS.get(integrator).adaptive
        else {"step": 1e-4 if method == "braun-goldfarb" else 5e-4}
    )
    result = model.simulate(method=method, integrator=integrator, until=0.3, times=TIMES, **settings)
    assert result.status in ("ok", "unverified"), result.reason
    apart = Points.of_mechanism(model.mechanism, {}).largest_distance(columns(result, model.mechanism), q)
    assert apart < ROUGH.get(method, 1e-8)
