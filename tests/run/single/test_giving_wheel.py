"""A wheel that gives way in the plane: it hops beside closed forms, and is one wheel in all places."""

import json
import math
import subprocess

import numpy as np
import pytest

import symgen
from tests.result.targets.compilers import compiled, written
from tests.result.targets.test_c import rows_of
from tests.result.targets.test_fmu import fmu_of, simulated

G, MASS, RADIUS, STIFFNESS = 9.81, 1.5, 0.2, 2e4
HOPPER = """
[mechanism]
name = "hopper"
gravity = [0.0, -9.81]
[parameters]
stiffness = { value = 2e4, unit = "N/m" }
coefficient = 0.5
[bodies.wheel]
mass = 1.5
inertia = 0.02
position = [0.0, 0.3]
velocity = [0.4, 0.0]
angular_velocity = 3.0
[joints.road]
type = "rolling"
between = ["wheel", "ground"]
radius = 0.2
axis = [1.0, 0.0]
on = [0.0, 0.0]
stiffness = "stiffness"
friction = { coefficient = "coefficient", speed = 0.05 }
[events.touch]
when = "road.gap"
action = "record"
[outputs]
lost = { value = "-integral(road.roll*(road.displacement.rate + 0.2*wheel.omega))", unit = "J" }
[run]
until = 1.0
step = 1e-4
"""


@pytest.fixture
def hopper(tmp_path):
    (tmp_path / "hopper.toml").write_text(HOPPER)
    return symgen.load(tmp_path / "hopper.toml")


def test_a_wheel_hops_as_on_a_spring(hopper):
    """Flights are parabolas, contacts half a period and a bit; energy is lost to the slip alone."""
    result = hopper.simulate(until=3.0, rtol=1e-11)
    assert result.ok
    fall = math.sqrt(2.0 * 0.1 / G)
    rate, impact = math.sqrt(STIFFNESS / MASS), math.sqrt(2.0 * G * 0.1)
    contact = 2.0 * (math.pi - math.atan(impact * rate / G)) / rate
    touches = [fall + sum((2.0 * fall, contact)[k % 2 == 0] for k in range(n)) for n in range(12)]
    found = [event.t for event in result.events if event.name == "touch"]
    np.testing.assert_allclose(found[:12], touches, atol=1e-8)
    depth = G / rate**2 + math.hypot(G / rate**2, impact / rate)
    assert result["road.gap"].min() == pytest.approx(-depth, rel=1e-3)
    kinetic = 0.5 * MASS * (result["wheel.vx"] ** 2 + result["wheel.vy"] ** 2) + 0.01 * result["wheel.omega"] ** 2
    spring = 0.5 * STIFFNESS * np.minimum(result["road.gap"], 0.0) ** 2
    whole = kinetic + spring + MASS * G * result["wheel.y"] + result["lost"]
    np.testing.assert_allclose(whole, whole[0], rtol=1e-9)
    # what remains of the slip is the motion that rolls: moments about the line are kept
    assert result["lost"][-1] == pytest.approx(
        0.5 * (0.4 + 3.0 * RADIUS) ** 2 / (1.0 / MASS + RADIUS**2 / 0.02), rel=1e-6
    )
    assert result["wheel.vx"][-1] + RADIUS * result["wheel.omega"][-1] == pytest.approx(0.0, abs=1e-6)
    np.testing.assert_allclose(MASS * result["wheel.vx"] - 0.1 * result["wheel.omega"], 0.6 - 0.3, atol=1e-9)


def test_damping_takes_energy_and_never_pulls(hopper, tmp_path):
    text = HOPPER.replace('stiffness = "stiffness"', 'stiffness = "stiffness"\ndamping = 40.0')
    (tmp_path / "damped.toml").write_text(text)
    result = symgen.load(tmp_path / "damped.toml").simulate(until=3.0, rtol=1e-9)
    assert result.ok
    assert result["road.normal"].min() == 0.0
    assert result["wheel.y"][result.t > 2.5].max() < 0.205
    assert result["road.normal"][-1] == pytest.approx(MASS * G, rel=0.1)


@pytest.mark.slow
def test_one_wheel_in_all_coordinates_integrators_and_methods(hopper):
    expected = hopper.simulate(rtol=1e-12)
    others = (
        {"coordinates": "joint"},
        {"shape": "looped"},
        {"integrator": "radau5"},
        {"integrator": "picard"},
        {"integrator": "dopri5"},
        {"method": "null-space"},
        {"method": "augmented-lagrangian"},
    )
    for settings in others:
        result = hopper.simulate(rtol=1e-11, atol=1e-13, times=expected.t, **settings)
        assert result.status in ("ok", "unverified"), (settings, result.reason)
        for name in ("wheel.x", "wheel.y", "wheel.theta"):
            np.testing.assert_allclose(result[name], expected[name], atol=1e-9, err_msg=str(settings))


@pytest.mark.slow
def test_one_wheel_in_sweeps_and_code(hopper, tmp_path):
    """Rows of a sweep, C, both sorts of FMU and JavaScript do as the run does."""
    step, until = 1e-4, 0.5
    model = symgen.load(_without(tmp_path, "event"))
    expected = model.simulate(integrator="rk4", step=step, until=until, output_step=0.01, method="direct-correction")
    end = [expected[f"wheel.{x}"][-1] for x in ("x", "y", "theta", "vx", "vy", "omega")]
    sweep = symgen.sweep(
        model.mechanism,
        {"coefficient": np.array([0.5, 0.2])},
        integrator="rk4",
        step=step,
        until=until,
        method="direct-correction",
    )
    other = model.simulate(
        integrator="rk4", step=step, until=until, parameters={"coefficient": 0.2}, method="direct-correction"
    )
    for row, run in zip(range(2), (expected, other), strict=True):
        np.testing.assert_allclose(sweep["wheel.x"][row], run["wheel.x"][-1], atol=1e-12)
    _, rows = rows_of(compiled(written(model.mechanism, tmp_path / "c")), str(until))
    np.testing.assert_allclose(rows[-1, 1 : len(end) + 1], end, atol=1e-12)
    fmu = fmu_of(model, tmp_path / "hopper.fmu")
    stepped = simulated(fmu, "CoSimulation", until, step=until)
    np.testing.assert_allclose(stepped["wheel.y"][-1], end[1], atol=1e-9)
    exact = model.simulate(rtol=1e-12, until=until)
    integrated = simulated(fmu, "ModelExchange", until, tolerance=1e-10, step=0.01)
    np.testing.assert_allclose(integrated["wheel.y"][-1], exact["wheel.y"][-1], atol=1e-8)
    model.generate(tmp_path / "js", target="javascript")
    program = f"""
        import {{ model }} from "{tmp_path}/js/hopper.mjs";
        const y = model.start();
        for (let k = 0; k < {round(until / step)}; k++) model.step(k*{step}, y, {step});
        console.log(JSON.stringify(Array.from(y)));
    """
    ran = subprocess.run(["node", "--input-type=module"], input=program, capture_output=True, text=True, check=True)
    np.testing.assert_allclose(json.loads(ran.stdout)[:6], end, atol=1e-9)


def _without(folder, section):
    text = HOPPER.partition(f"[{section}")[0] + "[run]\nstep = 1e-4\n"
    (folder / "plain.toml").write_text(text)
    return folder / "plain.toml"


def test_derivatives_follow_the_closed_form(hopper):
    """After a contact the wheel is up in the air for the longer, the less the contact took."""
    path, h = "stiffness", 1e-6
    result = hopper.simulate(until=0.3, rtol=1e-12, sensitivities=(path,))
    impact, fall = math.sqrt(0.2 * G), math.sqrt(0.2 / G)

    def height(stiffness):
        rate = math.sqrt(stiffness / MASS)
        up = 0.3 - fall - 2.0 * (math.pi - math.atan(impact * rate / G)) / rate
        return RADIUS + impact * up - 0.5 * G * up**2

    assert result["wheel.y"][-1] == pytest.approx(height(STIFFNESS), abs=1e-10)
    slope = (height(STIFFNESS * (1.0 + h)) - height(STIFFNESS * (1.0 - h))) / (2.0 * h * STIFFNESS)
    assert result.gradient("wheel.y")[path][-1] == pytest.approx(slope, rel=1e-6)


def test_derivatives_with_damping_are_those_of_differences(tmp_path):
    text = HOPPER.replace('stiffness = "stiffness"', 'stiffness = "stiffness"\ndamping = 40.0')
    (tmp_path / "hopper.toml").write_text(text.partition("[events")[0])
    model = symgen.load(tmp_path / "hopper.toml")
    result = model.simulate(until=0.3, rtol=1e-12, sensitivities=("stiffness", "coefficient"))
    for name, value, column in (("stiffness", 2e4, "wheel.y"), ("coefficient", 0.5, "wheel.x")):
        h = 1e-3 * value
        ends = [model.simulate(until=0.3, rtol=1e-13, parameters={name: value + d})[column][-1] for d in (h, -h)]
        assert result.gradient(column)[name][-1] == pytest.approx((ends[0] - ends[1]) / (2.0 * h), rel=1e-4)
