"""`generalized-alpha` with ``index=2``: velocities meet their constraints to rounding, the order stays two."""

import numpy as np
import pytest

import symgen
from symgen.base.errors import InputError
from tests.derive.methods.test_hard_cases import two_links


@pytest.mark.slow_cases("spatial-slider-crank-0.2-0.001")
@pytest.mark.parametrize(("name", "until", "step"), [("four-bar", 1.0, 4e-3), ("spatial-slider-crank", 0.2, 1e-3)])
def test_projected_velocities_keep_the_order(name, until, step):
    model = symgen.load(name)
    common = {"until": until, "times": np.linspace(0.0, until, 6), "verify": False}
    exact = model.simulate(method="direct-correction", integrator="dop853", rtol=1e-12, **common)
    errors = []
    for h in (step, step / 2):
        plain, run = (
            model.simulate(method="generalized-alpha", step=h, options={"method.index": index}, **common)
            for index in ("3", "2")
        )
        assert run.status == "ok" and run.velocity_violation_max < 1e-13 < 1e-7 < plain.velocity_violation_max
        assert run.position_violation_max < 1e-13
        errors.append([np.abs(np.asarray(getattr(run, x)) - np.asarray(getattr(exact, x))).max() for x in "qv"])
    assert np.log2(np.divide(*errors)) == pytest.approx([2.0, 2.0], abs=0.05)


@pytest.mark.slow
def test_adaptive_steps_are_projected_too():
    options = {"method.index": "2", "integrator.adaptive": "true"}
    run = symgen.load("four-bar").simulate(method="generalized-alpha", rtol=1e-5, until=1.0, options=options)
    assert run.status == "ok" and run.velocity_violation_max < 1e-12 and run.rtol == 1e-5


def test_a_massless_body_has_no_metric_to_project_in():
    with pytest.raises(InputError, match="massless"):
        two_links(True).simulate(method="generalized-alpha", step=1e-3, until=0.1, options={"method.index": "2"})
