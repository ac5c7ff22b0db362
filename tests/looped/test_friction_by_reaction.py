"""Friction by reactions in loops: closed forms and references of other tests, both shapes over 300 values, refusals."""

import copy
from dataclasses import replace

import numpy as np
import pytest
from support.rotation import of_turn

import symgen
from symgen.base.errors import InputError
from symgen.base.settings import Settings
from symgen.describe.files.load import read_raw
from symgen.describe.files.validate import validate
from symgen.run.planning.prepare import prepare
from tests.run.modes.test_friction_by_reaction import ARM, four_bar, slider_crank

TIGHT = {"rtol": 1e-12, "atol": 1e-12}
LOOPS = {"coordinates": "absolute", "shape": "looped"}


@pytest.mark.slow
def test_a_slide_rubs_by_its_normal_force():
    """Times and angle of minimal coordinates and full Newton-Euler in NumPy."""
    model, settings = symgen.load(slider_crank({"coefficient": 0.3})), {"until": 2.5, "output_step": 0.5, **LOOPS}
    result = model.simulate(method="lagrange", integrator="dop853", **settings, **TIGHT)
    assert result.shape == "looped"
    times = [e.t for e in result.events if e.name != "slide.reverse" or e.t > 0.5]
    np.testing.assert_allclose(times, [0.859203053389, 1.37849207954, 2.00166970939], rtol=0, atol=1e-10)
    assert abs(result["crank.theta"][-1] + 1.75991021743) < 1e-10


@pytest.mark.slow
def test_a_pin_rubs_by_its_own_reaction():
    result = symgen.load(four_bar(A=ARM)).simulate(until=25.0, output_step=1.0, integrator="dop853", **LOOPS, **TIGHT)
    assert [e.name for e in result.events] == ["A.reverse"] * 17 + ["A.stick"]
    assert abs(result.events[-1].t - 24.1083153831) < 1e-9
    assert abs(result["crank.theta"][-1] + 2.14493122869) < 1e-10


def rubbing(joints=("A", "B", "C", "D")):
    """A four-bar with pins that rub."""
    pin = {"coefficient": "mu", "static_coefficient": "1.3*mu", "radius": 0.03}
    raw, source = read_raw("four-bar")
    raw = copy.deepcopy(raw)
    raw["parameters"]["mu"] = 0.15
    for joint in joints:
        raw["joints"][joint]["friction"] = pin
    return validate(raw, source)


METHODS = (
    *(("lagrange", "dop853", TIGHT), ("direct-correction", "picard", TIGHT), ("baumgarte", "dop853", TIGHT)),
    *(("lagrange", "radau5", {"rtol": 1e-10, "atol": 1e-10}), ("ggl", "radau5", {"rtol": 1e-10, "atol": 1e-10})),
    *(("udwadia-kalaba", "dop853", TIGHT), ("generalized-alpha", "generalized-alpha", {"step": 2e-3})),
)


@pytest.mark.by_turns(6)
@pytest.mark.slow
@pytest.mark.parametrize(
    ("method", "integrator", "steps"), [pytest.param(*case, id=f"{case[0]}-{case[1]}") for case in METHODS]
)
def test_both_shapes_agree_where_all_pins_rub(method, integrator, steps):
    """Each reaction depends on all frictions; pins turn round one by one, stick, and break loose together."""
    model, settings = symgen.load(rubbing()), {"until": 4.0, "output_step": 0.1, "verify": False, **steps}
    straight, looped = (
        model.simulate(method=method, integrator=integrator, coordinates="absolute", shape=shape, **settings)
        for shape in ("straight", "looped")
    )
    assert len(straight.events) > 8 and [e.name for e in straight.events] == [e.name for e in looped.events]
    np.testing.assert_allclose(looped.q.values, straight.q.values, rtol=0.0, atol=1e-7 if "step" in steps else 1e-9)
    for name in straight.outputs.names:
        np.testing.assert_allclose(looped[name], straight[name], rtol=0.0, atol=1e-6)


@pytest.mark.slow
def test_a_spatial_slider_crank_whose_hinge_and_guide_rub():
    raw, source = read_raw("spatial-slider-crank")
    raw = copy.deepcopy(raw)
    raw["joints"]["A"]["friction"] = {"coefficient": 0.1, "radius": 0.01}
    raw["joints"]["guide"]["friction"] = {"coefficient": 0.1}
    model, settings = symgen.load(validate(raw, source)), {"until": 3.0, "integrator": "dop853", **TIGHT}
    straight, looped = (
        model.simulate(method="lagrange", coordinates="absolute", shape=shape, **settings)
        for shape in ("straight", "looped")
    )
    assert len(straight.events) > 4 and [e.name for e in straight.events] == [e.name for e in looped.events]
    np.testing.assert_allclose(looped.q.values, straight.q.values, rtol=0.0, atol=1e-9)


@pytest.mark.by_turns(3)
@pytest.mark.slow
def test_a_slider_crank_that_rubs_over_300_coefficients():
    """Slide and pins rub by their reactions: ends and events of straight code, in constant steps."""
    pin = {"coefficient": "mu", "radius": 0.02}
    raw, source = read_raw("slider-crank")
    raw = copy.deepcopy(raw)
    raw["parameters"]["mu"] = 0.1
    for joint, keys in raw["joints"].items():
        if keys["type"] in ("revolute", "translational", "prismatic"):
            raw["joints"][joint]["friction"] = pin if keys["type"] == "revolute" else {"coefficient": "mu"}
    assert sum("friction" in keys for keys in raw["joints"].values()) == 4
    mechanism, ends, counts = validate(raw, source), {}, {}
    settings = Settings("lagrange", "rk4", until=0.5, step=1e-3, coordinates="absolute", verify=False)
    for shape in ("straight", "looped"):
        outcomes = [
            prepare(mechanism, replace(settings, shape=shape, parameters={"mu": float(mu)})).integrate()
            for mu in of_turn(np.linspace(0.01, 0.3, 300), 4)
        ]
        ends[shape] = [outcome.states[-1] for outcome in outcomes]
        counts[shape] = [[event.name for event in outcome.happened] for outcome in outcomes]
    np.testing.assert_allclose(ends["looped"], ends["straight"], rtol=0.0, atol=1e-9)
    assert counts["looped"] == counts["straight"] and len({len(names) for names in counts["straight"]}) > 1


@pytest.mark.slow
def test_methods_that_iterate_and_jammed_pins_are_refused():
    model = symgen.load(rubbing("A"))
    expected = "method 'augmented-lagrangian': expected one that finds multipliers at once, where dry friction depends"
    with pytest.raises(InputError, match=expected):
        model.simulate(until=0.1, method="augmented-lagrangian", **LOOPS)
    jammed = symgen.load(four_bar(A={"coefficient": 3.0, "radius": 0.9}))
    with pytest.raises(InputError, match=r"got 1\.615"):
        jammed.simulate(until=0.1, method="lagrange", **LOOPS)
