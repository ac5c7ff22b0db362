"""Loops in closed form: a driven parallelogram, whose determinant vanishes at both folded positions of every turn."""

import math

import numpy as np
import pytest

import symgen
from symgen.base.ir.program import COUNTERS
from symgen.base.settings import Settings
from symgen.run.planning.prepare import prepare

SPEED, START = 3.0, 1.0
PARALLELOGRAM = f"""
[mechanism]
name = "driven-parallelogram"
gravity = [0.0, -9.81]

[parameters]
coupler_mass = {{ value = 6.0, unit = "kg" }}

[bodies.crank]
mass = 2.0
inertia = 0.7
points = {{ B = [2.0, 0.0] }}
position = [0.0, 0.0]
angle = {START}
angular_velocity = {SPEED}

[bodies.coupler]
mass = "coupler_mass"
inertia = "3.0*coupler_mass"
points = {{ C = [6.0, 0.0] }}
position = [{2.0 * math.cos(START)}, {2.0 * math.sin(START)}]

[bodies.rocker]
mass = 2.0
inertia = 0.7
points = {{ C = [2.0, 0.0] }}
position = [6.0, 0.0]
angle = {START}
angular_velocity = {SPEED}

[joints.A]
type = "revolute"
between = ["ground", "crank"]
at = [[0.0, 0.0], [0.0, 0.0]]

[joints.B]
type = "revolute"
between = ["crank", "coupler"]
at = ["B", [0.0, 0.0]]

[joints.C]
type = "revolute"
between = ["coupler", "rocker"]
at = ["C", "C"]

[joints.D]
type = "revolute"
between = ["ground", "rocker"]
at = [[6.0, 0.0], [0.0, 0.0]]

[joints.motor]
type = "driver"
joint = "A"
coordinate = "angle"
value = "{START} + {SPEED}*t"
"""


@pytest.fixture(scope="module")
def model(tmp_path_factory):
    path = tmp_path_factory.mktemp("loops") / "driven-parallelogram.toml"
    path.write_text(PARALLELOGRAM, encoding="utf-8")
    return symgen.load(path)


@pytest.mark.slow_cases("6.0-joint", "1e-06-joint")
@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
@pytest.mark.parametrize("mass", [6.0, 1e-6, 1e-12])
def test_a_driven_parallelogram_passes_its_folded_positions(model, coordinates, mass):
    result = model.simulate(
        method="direct-correction",
        integrator="rk4",
        step=1e-3,
        until=5.0,
        coordinates=coordinates,
        verify=False,
        parameters={"coupler_mass": mass},
    )
    assert result.status == "ok"
    turned = START + SPEED * np.asarray(result.t)
    np.testing.assert_allclose(result["rocker.theta"], turned, rtol=0.0, atol=1e-9)
    np.testing.assert_allclose(result["coupler.theta"], 0.0, rtol=0.0, atol=1e-9)


@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
def test_a_loop_is_confirmed_by_pivots_and_a_row_that_is_left_out_raises_the_flag(model, coordinates):
    settings = Settings(method="direct-correction", step=1e-3, until=0.1, coordinates=coordinates, verify=False)
    run = prepare(model.mechanism, settings)
    law, start = run.compiled.law_module, run.start
    y, w, iw = np.array(start.y), np.array(start.w), np.zeros(len(COUNTERS), dtype=np.int64)
    closed, by_pivots = np.zeros_like(y), np.zeros_like(y)
    assert law.rhs(0.0, y, start.p, w, iw, closed) == 0
    assert law.confirm(0.0, y, start.p, w, iw, by_pivots) == 0
    np.testing.assert_allclose(by_pivots, closed, rtol=1e-10, atol=1e-10)
    assert not iw.any(), "confirmed by pivots of which none is suspicious"
    run.compiled.section(w, "mask")[1:] = math.inf
    assert law.rhs(0.0, y, start.p, w, iw, closed) == 1
