"""Rotors take part in impulses: impacts and resets beside a flywheel that a row gears to the joint, and by hand."""

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from support.ending import Ending

import symgen
from symgen.describe.files.load import parse_toml
from symgen.describe.files.validate import validate

#: Two arms in the plane without gravity; the shoulder has a stop, the elbow's motor turns GEAR times as fast.
ARM = """
[mechanism]
name = "arm"
[parameters]
ratio = 20.0
[bodies.upper]
mass = 2.0
inertia = 0.1
position = [0.4, 0.0]
points = { a = [-0.4, 0.0], b = [0.4, 0.0] }
angular_velocity = 1.0
[bodies.lower]
mass = 1.0
inertia = 0.05
position = [1.1, 0.0]
points = { a = [-0.3, 0.0], c = [0.3, 0.0] }
angular_velocity = 1.0
[joints.shoulder]
type = "revolute"
between = ["ground", "upper"]
at = [[0.0, 0.0], "a"]
stop = { upper = 0.5, restitution = 0.3 }
[joints.elbow]
type = "revolute"
between = ["upper", "lower"]
at = ["b", "a"]
"""
ROTOR = 'rotor_inertia = 4e-5\ngear_ratio = "ratio"\n'
FLYWHEEL = """
[bodies.flywheel]
mass = 1.0
inertia = 4e-5
[joints.axle]
type = "revolute"
between = ["ground", "flywheel"]
at = [[0.0, 0.0], "centre"]
[joints.geared]
type = "rows"
between = ["upper", "lower", "flywheel"]
rows = [{ position = "flywheel.theta - ratio*(lower.theta - upper.theta)" }]
"""
KICK = """
[events.kick]
when = "t - 0.3"
reset = { "lower.omega" = -2.0 }
"""
SETTINGS = {"until": 1.0, "integrator": "dop853", "rtol": 1e-12, "atol": 1e-13, "verify": False}


def arm(text: str) -> symgen.Model:
    return symgen.Model(validate(parse_toml(text, "arm.toml"), "arm.toml"))


def by_hand(ratio: float) -> tuple[float, float, float]:
    """Return the impulse at the stop, the work of the impact and the angle of the lower arm after 1 s."""

    def mass(elbow: float) -> np.ndarray:
        own, mixed = 0.05 + 0.3**2, 0.05 + 0.3**2 + 0.8 * 0.3 * np.cos(elbow)
        whole = 0.1 + 2.0 * 0.4**2 + 0.05 + 0.8**2 + 0.3**2 + 2.0 * 0.8 * 0.3 * np.cos(elbow)
        return np.array([[whole, mixed], [mixed, own + 4e-5 * ratio**2]])

    def rates(_: float, y: np.ndarray) -> list[float]:
        h = 0.8 * 0.3 * np.sin(y[1])
        forces = np.array([h * (2.0 * y[2] * y[3] + y[3] ** 2), -h * y[2] ** 2])
        return [y[2], y[3], *np.linalg.solve(mass(y[1]), forces)]

    def stop(_: float, y: np.ndarray) -> float:
        return y[0] - 0.5

    exact = {"rtol": 1e-13, "atol": 1e-14, "method": "DOP853"}
    there = solve_ivp(rates, (0.0, 1.0), [0.0, 0.0, 1.0, 0.0], events=Ending(stop), **exact)
    y, m = there.y[:, -1], mass(there.y[1, -1])
    column = np.linalg.solve(m, [1.0, 0.0])
    impulse = 1.3 * y[2] / column[0]
    v = y[2:] - impulse * column
    on = solve_ivp(rates, (there.t[-1], 1.0), [*y[:2], *v], **exact).y[:, -1]
    return impulse, 0.5 * (v @ m @ v - y[2:] @ m @ y[2:]), on[0] + on[1]


@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
@pytest.mark.parametrize("ratio", [5.0, 60.0])
@pytest.mark.slow
def test_an_impact_moves_the_rotor(ratio: float, coordinates: str) -> None:
    impulse, work, end = by_hand(ratio)
    run = arm(ARM + ROTOR).simulate(parameters={"ratio": ratio}, coordinates=coordinates, **SETTINGS)
    (hit,) = run.events
    assert run.status == "ok" and hit.impulses["shoulder.upper.stop"] == pytest.approx(impulse, rel=1e-11)
    assert hit.work == pytest.approx(work, rel=1e-11)
    assert run["lower.theta"][-1] == pytest.approx(end, abs=1e-10)


@pytest.mark.slow_cases("absolute")
@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
def test_a_reset_is_that_of_a_geared_flywheel(coordinates: str) -> None:
    geared = arm(ARM + FLYWHEEL + KICK).simulate(coordinates="absolute", **SETTINGS)
    run = arm(ARM + ROTOR + KICK).simulate(coordinates=coordinates, **SETTINGS)
    assert [event.name for event in run.events] == [event.name for event in geared.events]
    for event, other in zip(run.events, geared.events, strict=True):
        assert event.work == pytest.approx(other.work, rel=1e-10)
        assert event.v_after["upper.omega"] == pytest.approx(other.v_after["upper.omega"], abs=1e-11)
    assert run["lower.theta"][-1] == pytest.approx(geared["lower.theta"][-1], abs=1e-9)


@pytest.mark.by_turns(4)
@pytest.mark.slow
@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
def test_a_sweep_over_the_gear_is_right_in_every_row(coordinates: str) -> None:
    ratios = np.linspace(1.0, 100.0, 301)
    rows = arm(ARM + ROTOR).sweep(
        {"ratio": ratios}, quantities=("lower.theta",), times=[1.0], coordinates=coordinates,
        **{name: value for name, value in SETTINGS.items() if name != "verify"},
    )  # fmt: skip
    assert set(rows.status) == {"ok"}
    ends = np.array([by_hand(ratio)[2] for ratio in ratios])
    np.testing.assert_allclose(rows["lower.theta"][:, 0], ends, atol=1e-9)


#: Wheels in space on axes that a joint keeps parallel, skew to the ground; the second one has products of inertia.
WHEELS = """
[mechanism]
name = "wheels"
space = "spatial"
[bodies.a]
mass = 1.0
inertia = [0.4, 0.5, 0.6]
orientation = { x_axis = [1.0, 0.0, 0.0], y_axis = [0.0, 0.7648421872844885, 0.644217687237691] }
[bodies.b]
mass = 2.0
inertia = [0.3, 0.4, 0.5, 0.02, 0.01, 0.03]
orientation = { x_axis = [1.0, 0.0, 0.0], y_axis = [0.0, 0.7648421872844885, 0.644217687237691] }
[joints.p]
type = "revolute"
between = ["ground", "a"]
at = [[0.0, 0.0, 0.0], "centre"]
axis = [0.0, -0.644217687237691, 0.7648421872844885]
[joints.q]
type = "revolute"
between = ["a", "b"]
at = ["centre", "centre"]
axis = [0.0, 0.0, 1.0]
rotor_inertia = 0.1
gear_ratio = 2.0
[events.kick]
when = "t - 0.5"
reset = { "a.wz" = 1.0 }
"""


@pytest.mark.slow
@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
def test_wheels_in_space_share_a_rotor(coordinates: str) -> None:
    """Of the kick on the first wheel the rotor hands J/(I + J) on to the second one."""
    run = arm(WHEELS).simulate(coordinates=coordinates, **SETTINGS)
    j = 0.1 * 2.0**2
    assert run.status == "ok" and run["b.wz"][-1] == pytest.approx(j / (0.5 + j), rel=1e-11)
    assert run.events[0].work == pytest.approx(0.5 * (0.6 + 0.5 * j / (0.5 + j)), rel=1e-11)


@pytest.mark.by_turns(3)
@pytest.mark.slow
@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
@pytest.mark.parametrize("text", [ARM + ROTOR, ARM + ROTOR + KICK], ids=["impact", "reset and impact"])
def test_derivatives_pass_impulses_with_rotors(text: str, coordinates: str) -> None:
    model, h = arm(text), 1e-4
    run = model.simulate(parameters={"ratio": 20.0}, coordinates=coordinates, sensitivities=["ratio"], **SETTINGS)
    both = [
        model.simulate(parameters={"ratio": 20.0 + s * h}, coordinates=coordinates, **SETTINGS)["lower.theta"][-1]
        for s in (1.0, -1.0)
    ]
    slope = run.gradient("lower.theta").values[-1].item()
    assert slope == pytest.approx((both[0] - both[1]) / (2.0 * h), rel=1e-7)
