"""Formulas that are not defined where a few evaluations of plain Python look at them: numbers that are nan there."""

from __future__ import annotations

import math
import re

import numpy as np
import pytest

import symgen
from symgen.base.errors import StepError
from symgen.describe import MechanismBuilder
from symgen.run.compiling.linearised import compile_linearised
from symgen.run.compiling.method_choice import choose_method
from symgen.run.compiling.pipeline import compile_model


def sliding(force, velocity=0.0):
    """A mass of 2 kg on a guide, pushed by a formula."""
    return (
        MechanismBuilder("undefined")
        .run(until=0.5, step=0.01)
        .body("mass", mass=2.0, inertia=0.1, velocity=(velocity, 0.0))
        .joint("guide", "translational", between=("ground", "mass"), at=((0.0, 0.0), "centre"), axis=(1.0, 0.0))
        .force("push", "force", body="mass", force=(force, 0.0))
    )


#: A force, and its slope by the velocity of the mass, as floating-point numbers have it; roots rise by a number that is
#: as good as no bound, of which nothing is left where what they are taken of does not change.
SLOPES = (
    ("-sqrt(abs(mass.vx))", 0.0, 0.0),
    ("-sqrt(mass.vx)", -1.0, math.nan),
    ("-sqrt(mass.vx)", 0.0, -5e99),
    ("-log(mass.vx)", 0.0, -math.inf),
    ("-exp(mass.vx)", 1e4, -math.inf),
    ("-sqrt(mass.vx)", 4.0, -0.25),
)


@pytest.mark.parametrize(("force", "velocity", "slope"), SLOPES)
def test_derivatives_where_they_do_not_exist(force, velocity, slope):
    mechanism = sliding(force).build()
    compiled = compile_model(mechanism, choose_method("lagrange"))
    form, y = compile_linearised(mechanism, compiled), np.zeros(compiled.info.ny)
    y[compiled.info.nq] = velocity
    found = form.at(0.0, y, np.zeros(3), compiled.parameter_array({}, {}), compiled.scratch())
    np.testing.assert_allclose(found.by("balance", "v")[0, 0], -slope, rtol=1e-14)


def test_methods_are_chosen_where_a_force_has_no_slope():
    """A force of 3 N less sqrt(v), from rest: the time to v is the integral of 2/(3 - sqrt(v))."""
    model = symgen.load(sliding("3 - sqrt(abs(mass.vx))").build())
    found = model.simulate(method="auto", integrator="auto", rtol=1e-9)
    assert found.status == "ok"
    root = math.sqrt(found.v["mass.vx"][-1])
    assert 4.0 * (-root - 3.0 * math.log1p(-root / 3.0)) == pytest.approx(0.5, rel=1e-6)


def test_a_reset_that_is_not_defined_at_rest():
    """A ball of 1 kg falls 5 m at 10 m/s^2 and is thrown back at sqrt(v^2 - 19) = 9 m/s."""
    mechanism = (
        MechanismBuilder("thrown-back", gravity=(0.0, -10.0))
        .run(until=1.5, step=0.01)
        .body("ball", type="point", mass=1.0, position=(0.0, 5.0))
        .event("floor", when="ball.y < 0", reset={"ball.vy": "sqrt(ball.vy**2 - 19)"})
        .build()
    )
    found = symgen.load(mechanism).simulate(method="lagrange", times=(1.5,))
    assert found.status == "ok" and len(found.events) == 1
    assert found.v["ball.vy"][-1] == pytest.approx(9.0 - 5.0, rel=1e-8)


def falling(when, **more):
    """A ball that falls from `height` = 1 m at 10 m/s^2, on a vertical guide, so that joints carry it as well."""
    return symgen.load(
        MechanismBuilder("falling", gravity=(0.0, -10.0))
        .run(until=0.5, step=0.01)
        .parameter("height", 1.0)
        .body("ball", mass=1.0, inertia=0.1, position=(0.0, "height"))
        .joint("guide", "translational", between=("ground", "ball"), at=((0.0, 0.0), "centre"), axis=(0.0, 1.0))
        .event("watched", when=when, **more)
        .build()
    )


SETTINGS = (
    {"integrator": "rk4", "step": 0.01},
    {"integrator": "dop853"},
    {"integrator": "radau5"},
    {"integrator": "abm"},
    {"integrator": "picard"},
    {"integrator": "rk4", "step": 0.01, "coordinates": "joint"},
    {"integrator": "dop853", "coordinates": "joint"},
)


@pytest.mark.parametrize("settings", SETTINGS, ids=lambda s: "-".join(map(str, s.values())))
def test_a_run_fails_where_the_condition_of_an_event_becomes_undefined(settings):
    """The ball is at the root of 0 m after sqrt(0.2) s: the first step that ends later meets a root of less."""
    model = falling("sqrt(ball.y) > 5", action="stop")
    found = model.simulate(**settings)
    assert found.status == "failed" and found.events == ()
    sentence = r"the condition of the event 'watched' is undefined at t = (\S+) s"
    assert 0.2**0.5 < float(re.fullmatch(sentence, found.reason)[1]) <= 0.5

    stepped = model.start(**settings)
    with pytest.raises(StepError, match=sentence) as caught:
        stepped.run(0.5)
    assert stepped.t < 0.2**0.5 < caught.value.time


@pytest.mark.slow
def test_rows_of_sweeps_fail_alone_where_the_condition_of_an_event_is_undefined():
    model, settings = falling("sqrt(ball.y) > 5", action="stop"), {"integrator": "rk4", "step": 0.01}
    found = symgen.sweep(model, {"height": [1.0, 2.0]}, times=(0.1, 0.5), **settings)
    assert list(found.status) == ["failed", "ok"]
    assert found.reason[0] == model.simulate(**settings).reason


@pytest.mark.parametrize("integrator", ["rk4", "dop853"])
def test_a_condition_that_is_undefined_at_the_start_alone(integrator):
    found = falling("sqrt(t - 1e-9) > 5").simulate(integrator=integrator)
    assert (found.status, found.reason) == ("failed", "the condition of the event 'watched' is undefined at t = 0 s")


def test_a_condition_that_a_reset_makes_undefined():
    """Thrown up at 3 m/s, the ball is where the root of -2 is met."""
    found = falling("sqrt(1 - ball.vy) > 2", reset={"ball.vy": 3.0}).simulate(integrator="rk4")
    assert found.status == "failed" and len(found.events) == 1
    assert found.reason == "the condition of the event 'watched' is undefined at t = 0.3 s"


GUARDED = (
    *("ball.y > 0 and sqrt(ball.y) < 0.5", "sqrt(ball.y) < 0.5 and ball.y > 0"),
    *("ball.y < 0.25 or sqrt(ball.y) < 0.5", "not (sqrt(ball.y) >= 0.5 and ball.y >= 0.25)"),
    "ball.y > 0 and (sqrt(ball.y) < 0.5 or log(ball.y) > 1)",
)


@pytest.mark.parametrize("when", GUARDED)
def test_a_guard_keeps_what_is_undefined_aside(when):
    """The ball is at 0.25 m after sqrt(0.15) s, and below 0 at the end."""
    found = falling(when).simulate(integrator="rk4")
    assert found.status == "ok", found.reason
    assert [event.t for event in found.events] == [pytest.approx(0.15**0.5, abs=1e-12)]


@pytest.mark.parametrize("integrator", ["dop853", "rk4", "radau5"])
def test_a_failure_names_the_root_that_has_no_value(integrator):
    arm = symgen.load(
        MechanismBuilder("rooted", gravity=(0.0, 0.0))
        .input("push", 0.0)
        .body("arm", mass=1.0, inertia=0.1)
        .joint("pin", "revolute", between=("ground", "arm"), at=((0.0, 0.0), "centre"))
        .force("motor", "torque", body="arm", torque="push + (log(arm.theta) if arm.theta > 5 else 0)")
        .output("way", "integral(abs(arm.omega))")
        .build()
    )
    run = arm.simulate(inputs={"push": "max(0.1, sqrt(0.5 - t))"}, integrator=integrator, until=1.0)
    assert run.status == "failed" and run.end == pytest.approx(0.5, abs=2e-3)
    assert run.reason.endswith(": sqrt(0.5 - t) of force 'motor' is undefined"), run.reason


@pytest.mark.parametrize("formula", ["sqrt(1.0 + ball.y)", "log(1.0 + ball.y)", "asin(ball.y)"])
def test_a_failure_names_the_formula_of_the_state_that_has_no_value(formula):
    """The ball falls from 0 to -1 m in sqrt(0.2) s; a force across its way does not change that."""
    ball = symgen.load(
        MechanismBuilder("leaving", gravity=(0.0, -10.0))
        .body("ball", type="point", mass=1.0)
        .force("wind", "force", body="ball", force=(formula, 0.0))
        .build()
    )
    for settings in ({"integrator": "dop853"}, {"integrator": "rk4", "step": 1e-3}, {"integrator": "radau5"}, {}):
        found = ball.simulate(until=1.0, **settings)
        assert found.status == "failed" and found.end == pytest.approx(0.2**0.5, abs=2e-3)
        assert found.reason.endswith(f": {formula} of force 'wind' is undefined"), (settings, found.reason)
    calm = ball.simulate(until=0.4)
    assert calm.status == "ok"
