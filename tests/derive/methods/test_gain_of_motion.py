"""Gains of `baumgarte` by ``rule=motion``: the rate of the motion, whatever the units and the step."""

import numpy as np
import pytest

import symgen
from symgen.api import Model
from symgen.base.settings import Settings
from symgen.describe import MechanismBuilder
from symgen.run.planning.prepare import make_plan

MOTION = {"baumgarte.rule": "motion"}


def plan_of(model, **settings):
    options = settings.pop("options", MOTION)
    return make_plan(model.mechanism, Settings("baumgarte", "rk4", options=options, **settings))


def bar(length, weight=9.81):
    """A bar of this length that falls from the horizontal, its weight such that all angles are the same."""
    raw = MechanismBuilder("bar", gravity=(0.0, -weight * length))
    ends = {"points": {"A": (-0.5 * length, 0.0)}, "angle": 0.0}
    raw.body("bar", mass=2.0, inertia=length**2 / 6.0, position=(0.5 * length, 0.0), **ends)
    raw.joint("pin", "revolute", between=("ground", "bar"), at=((0.0, 0.0), "A"))
    return Model(raw.build())


def test_the_gain_is_the_rate_of_the_first_second():
    model = symgen.load("pendulum")
    times = np.linspace(0.0, 1.0, 201)
    run = model.simulate(method="direct-correction", integrator="dop853", rtol=1e-10, until=1.0, times=times)
    rate = np.sqrt(np.square(np.asarray(run.a)).sum() / np.square(np.asarray(run.v)).sum())
    plan = plan_of(model, until=5.0)
    assert plan.method_parameters == pytest.approx({"alpha": rate, "beta": rate}, rel=1e-5)
    (note,) = plan.notes
    assert note.startswith("rule=motion: alpha = beta = ") and note.endswith("from 0 to 1 s")
    short = plan_of(model, until=0.5).method_parameters["alpha"]
    assert short == pytest.approx(plan_of(model, until=0.5, step=1e-2).method_parameters["alpha"]) != rate


def test_no_unit_matters():
    one, thousand = (plan_of(bar(length), until=2.0).method_parameters["alpha"] for length in (1.0, 1000.0))
    assert one == pytest.approx(thousand, rel=1e-4)


def test_a_given_gain_stays():
    plan = plan_of(symgen.load("pendulum"), options=MOTION | {"method.alpha": 3.0})
    assert plan.method_parameters["alpha"] == 3.0 != plan.method_parameters["beta"]


def test_what_stands_keeps_its_gains():
    plan = plan_of(bar(1.0, weight=0.0), until=1.0)
    assert plan.method_parameters == {} and plan.notes == ("rule=motion: nothing moves, so that the gains stay",)


@pytest.mark.slow
def test_violations_are_near_the_least_that_gains_give():
    """The gain of least violation does not depend on the step, and is near the rate: 4.6 1/s on this mechanism."""
    model = symgen.load("four-bar")
    rate = plan_of(model, until=2.0).method_parameters["alpha"]
    for step in (8e-3, 4e-3):
        common = {"method": "baumgarte", "integrator": "rk4", "step": step, "until": 2.0, "verify": False}
        common |= {"max_violation": 1.0}
        runs = [
            model.simulate(options={"method.alpha": x * rate, "method.beta": x * rate}, **common)
            for x in (0.1, 0.3, 1.0, 3.0, 10.0)
        ]
        own = model.simulate(options=MOTION, **common)
        assert own.position_violation_max == runs[2].position_violation_max
        assert own.position_violation_max < 4.0 * min(run.position_violation_max for run in runs)
