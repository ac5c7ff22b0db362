"""Forces that leave their bounds and return inside one step, and formulas of forces that jump beside resting rows."""

import math
from typing import Any

import numpy as np
import pytest

import symgen
from symgen.describe.files.load import parse_toml
from symgen.describe.files.validate import validate

CLUTCH = """
[mechanism]
name = "clutch"
[run]
until = 1.2
[parameters]
peak = 7.0
[bodies.hub]
mass = 1.0
inertia = 1.0
[bodies.plate]
mass = 1.0
inertia = 1.0
angular_velocity = 9.0
[joints.axle]
type = "revolute"
between = ["ground", "hub"]
at = [[0.0, 0.0], "centre"]
[joints.face]
type = "revolute"
between = ["hub", "plate"]
at = ["centre", "centre"]
friction = { coefficient = 0.5, static_coefficient = 0.56, radius = 1.0 }
[forces.press]
type = "force"
body = "plate"
force = ["18*cos(0.4*pi*t)", 0.0]
[forces.motor]
type = "torque"
body = "hub"
torque = "peak*sin(10*pi*t)"
"""
PRESS, SLOW, FAST, SPEED, UNTIL = 9.0, 0.4 * math.pi, 10.0 * math.pi, 9.0, 1.2
STATIC = 0.56 * 18.0


def root(g: Any, t: float) -> float | None:
    """Return where g first falls to 0 after t, by a fine grid and bisection; None where it does not."""
    grid = np.linspace(t, UNTIL, 24001)
    k = np.flatnonzero((g(grid)[1:] <= 0.0) & (g(grid)[:-1] > 0.0))
    if not len(k):
        return None
    low, high = grid[k[0]], grid[k[0] + 1]
    for _ in range(60):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if g(middle) > 0.0 else (low, middle)
    return float(high)


def clutch(peak: float) -> tuple[float, float, int]:
    """Return both angles at the end, and the number of changes of modes: integrals of sines between them."""

    def drag(t: Any) -> Any:
        return PRESS * np.sin(SLOW * t) / SLOW

    def push(t: Any) -> Any:
        return -peak * np.cos(FAST * t) / FAST

    def turns(t: Any, after: float, sign: float, share: float) -> Any:
        """Angle by the friction of a sign and a share of the motor, from rest."""
        way = -PRESS * (np.cos(SLOW * t) - np.cos(SLOW * after)) / SLOW**2 - drag(after) * (t - after)
        motor = -peak * (np.sin(FAST * t) - np.sin(FAST * after)) / FAST**2 - push(after) * (t - after)
        return sign * way + share * motor

    t, sign, count = 0.0, 1.0, 0
    hub, plate, hub_speed, plate_speed = 0.0, 0.0, 0.0, SPEED
    while True:
        if sign:

            def margin(x: Any, t: float = t, sign: float = sign, slip: float = plate_speed - hub_speed) -> Any:
                return sign * (slip - 2.0 * sign * (drag(x) - drag(t)) - (push(x) - push(t)))
        else:

            def margin(x: Any) -> Any:
                return STATIC * np.cos(SLOW * x) - np.abs(0.5 * peak * np.sin(FAST * x))

        end = root(margin, t + (1e-6 if sign and count else 0.0))
        stop = UNTIL if end is None else end
        of_hub, of_plate, share = (sign, -sign, 1.0) if sign else (0.0, 0.0, 0.5)
        hub += hub_speed * (stop - t) + turns(stop, t, of_hub, share)
        plate += plate_speed * (stop - t) + turns(stop, t, of_plate, 0.0 if sign else 0.5)
        hub_speed += of_hub * (drag(stop) - drag(t)) + share * (push(stop) - push(t))
        plate_speed += of_plate * (drag(stop) - drag(t)) + (0.0 if sign else 0.5) * (push(stop) - push(t))
        if end is None:
            return hub, plate, count
        t, count, load = end, count + 1, math.sin(FAST * end)
        held = sign and abs(0.5 * peak * load) <= STATIC * math.cos(SLOW * end)
        sign = 0.0 if held else -math.copysign(1.0, load)


def model_of(text: str) -> symgen.Model:
    return symgen.Model(validate(parse_toml(text, "clutch.toml"), "clutch.toml"))


SETTINGS = ({"integrator": "picard"}, {"integrator": "dop853", "rtol": 1e-6, "atol": 1e-8}, {"integrator": "radau5"})

#: Integrators with a loop over rows.
SWEPT = ("picard", "dop853")


@pytest.mark.by_turns(12)
@pytest.mark.slow
@pytest.mark.parametrize("settings", SETTINGS)
@pytest.mark.parametrize("count", [11, pytest.param(301, marks=pytest.mark.slow)])
def test_a_sweep_of_a_clutch_misses_no_slip(count: int, settings: dict[str, Any]) -> None:
    """Between two stays the motor's sine breaks the clutch loose for some hundredths of a second."""
    model, peaks, angles = model_of(CLUTCH), np.linspace(5.0, 25.0, count), ("hub.theta", "plate.theta")
    swept = settings["integrator"] in SWEPT
    rows = symgen.sweep(model, {"peak": peaks.tolist()}, quantities=angles, **settings) if swept else None
    near = 2e-6 if "rtol" in settings else 1e-9
    for k, peak in enumerate(peaks.tolist()):
        hub, plate, changes = clutch(peak)
        run = model.simulate(parameters={"peak": peak}, verify=False, **settings)
        assert run.status == "ok" and len(run.events) == changes, peak
        np.testing.assert_allclose([run[name][-1] for name in angles], [hub, plate], rtol=0.0, atol=near)
        if rows is not None:
            np.testing.assert_array_equal(rows.values[k, :, -1], [run[name][-1] for name in angles])


BALL = """
[mechanism]
name = "ball"
gravity = [0.0, -10.0]
[run]
until = 1.0
[bodies.ball]
type = "point"
mass = 2.0
velocity = [1.0, 0.0]
[forces.lift]
type = "force"
body = "ball"
force = [0.0, "LIFT"]
[stops.floor]
gap = "ball.y"
"""
WHEEL = """
[mechanism]
name = "wheel"
[run]
until = 1.0
[bodies.wheel]
mass = 1.0
inertia = 0.5
[bodies.slide]
mass = 1.0
inertia = 1.0
position = [0.0, 1.0]
velocity = [1.0, 0.0]
[joints.hub]
type = "revolute"
between = ["ground", "wheel"]
at = [[0.0, 0.0], "centre"]
friction = { sliding = 3.0, static = 4.0 }
[joints.rail]
type = "translational"
between = ["ground", "slide"]
at = [[0.0, 1.0], "centre"]
axis = [1.0, 0.0]
[forces.motor]
type = "torque"
body = "wheel"
torque = "TORQUE"
"""
LEAVES, HELD = BALL.replace("LIFT", "15*(1 + sign(ball.x - 0.5))"), BALL.replace("LIFT", "12 if ball.x > 0.5 else 0")
#: File, coordinate, and its value after 1 s: the ball is at x = t, and so is the slide.
JUMPS = {
    "a stop opens": (LEAVES, "ball.y", 0.5 * (30.0 / 2.0 - 10.0) * 0.5**2),
    "a stop stays closed": (HELD, "ball.y", 0.0),
    "a stop opens and closes": (BALL.replace("LIFT", "40 if ball.x > 0.2 and ball.x < 0.3 else 0"), "ball.y", 0.0),
    "a wheel breaks loose": (WHEEL.replace("TORQUE", "5 if slide.x > 0.5 else 0"), "wheel.theta", 0.5 * 4.0 * 0.5**2),
    "a wheel is held": (WHEEL.replace("TORQUE", "3.5 if slide.x > 0.5 else 0"), "wheel.theta", 0.0),
    "a wheel turns back": (WHEEL.replace("TORQUE", "-5 if slide.x > 0.5 else 3.9"), "wheel.theta", -0.5 * 4.0 * 0.5**2),
    "a wheel comes to rest": (
        WHEEL.replace("TORQUE", "5 if slide.x > 0.3 and slide.x < 0.5 else 0"),
        "wheel.theta",
        0.5 * 4.0 * 0.2**2 + 0.8**2 / (2.0 * 6.0),
    ),
}


@pytest.mark.by_turns(4)
@pytest.mark.slow
@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
@pytest.mark.parametrize("kind", [*JUMPS])
def test_modes_are_chosen_where_a_force_jumps_beside_a_resting_row(kind: str, coordinates: str) -> None:
    text, name, end = JUMPS[kind]
    model = model_of(text)
    for integrator in ("picard", "dop853", "radau5", "sdirk"):
        run = model.simulate(integrator=integrator, coordinates=coordinates, verify=False)
        assert run.status == "ok", (integrator, run.reason)
        assert run[name][-1] == pytest.approx(end, abs=2e-9), integrator
        if integrator in SWEPT:
            start = {"ball.vy" if name == "ball.y" else "wheel.omega": [0.0]}
            rows = symgen.sweep(model, start, quantities=(name,), integrator=integrator, coordinates=coordinates)
            assert rows.values[0, 0, -1] == run[name][-1]
