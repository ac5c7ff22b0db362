"""The stiff flyball governor: two formulations, and the steps of explicit and implicit integrators."""

import numpy as np
import pytest
from support.spatial_runs import columns, run, start_of

import symgen
from symgen.result.points import Points
from symgen.study.references.closed_forms import flyball_governor
from symgen.study.references.reference import reference_motion

#: Largest stable step of RK4 [s]: 2.785 over the rate of the dampers.
LIMIT = 2.785 / 8117.0


def away(result, model):
    """Largest distance [m] from the reduced model, Radau in two coordinates."""
    _, estimated, q, _ = flyball_governor(model.mechanism, model.parameters(), None, result.t)
    assert estimated < 1e-10
    return Points.of_mechanism(model.mechanism, model.parameters()).largest_distance(
        columns(result, model.mechanism), q
    )


@pytest.mark.by_turns(3)
@pytest.mark.slow
def test_two_formulations_agree_for_ten_seconds():
    """24 Cartesian velocities and 20 rows by an explicit integrator, against two coordinates by an implicit one."""
    times = np.linspace(0.0, 10.0, 101)
    model, result = run("flyball-governor", integrator="rk4", step=2e-4, until=10.0, times=times)
    assert result.status == "ok", result.reason
    assert away(result, model) < 1e-8


@pytest.mark.by_turns(3)
@pytest.mark.slow
def test_the_general_route_leads_the_same_way():
    """Derived once more, in Euler parameters and their rates; for a moment only, as it is stiff and slow."""
    times = np.linspace(0.0, 0.02, 5)
    model = symgen.load("flyball-governor")
    found = reference_motion(model.mechanism, model.parameters(), *start_of(model), times, solver="scipy-dop853")
    _, _, q, _ = flyball_governor(model.mechanism, model.parameters(), None, times)
    assert Points.of_mechanism(model.mechanism, model.parameters()).largest_distance(found.q, q) < 1e-11


@pytest.mark.slow
def test_explicit_steps_end_at_the_limit():
    model, result = run("flyball-governor", integrator="rk4", step=0.98 * LIMIT, until=1.0)
    assert result.status == "ok" and away(result, model) < 1e-6
    _, result = run("flyball-governor", integrator="rk4", step=1.05 * LIMIT, until=1.0)
    assert result.status == "failed"


@pytest.mark.slow
def test_implicit_steps_do_not():
    model, result = run("flyball-governor", "ggl", "radau5", rtol=1e-6, atol=1e-8, until=2.0)
    assert result.status == "ok", result.reason
    assert result.t[-1] / result.steps > 20.0 * LIMIT
    assert away(result, model) < 1e-6
