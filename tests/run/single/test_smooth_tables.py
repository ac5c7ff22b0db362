"""Runs with tables of smooth pieces: cams, power, and the same numbers from every shape of code."""

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.interpolate import CubicSpline

from symgen.api import Model
from symgen.derive.formulate.formulate import formulate
from symgen.derive.lower.model import lower_model
from symgen.describe.files.builder import MechanismBuilder
from symgen.describe.files.validate import validate

#: A cubic polynomial of time, which a cubic table through points of it is.
CAM = "0.1 + 0.3*t - 0.4*t**2 + 0.15*t**3"
POINTS = np.array([0.0, 0.21, 0.5, 0.83, 1.1, 1.4])


def cam_follower(value):
    """A block that a cam lifts, with a pendulum on it."""
    heights = 0.1 + 0.3 * POINTS - 0.4 * POINTS**2 + 0.15 * POINTS**3
    return Model(
        MechanismBuilder("cam-follower", gravity=(0.0, -9.81))
        .parameter("speed", 2.0)
        .table("cam", POINTS, heights, interpolation="cubic")
        .body("block", mass=1.0, inertia=0.1)
        .body("rod", mass=0.5, inertia=0.02, points={"top": (0.0, 0.3)}, position=(0.0, -0.2), angle=0.4)
        .joint("guide", "translational", between=("ground", "block"), at=((0.0, 0.0), "centre"), axis=(0.0, 1.0))
        .joint("lift", "driver", joint="guide", value=value)
        .joint("pin", "revolute", between=("block", "rod"), at=("centre", "top"))
        .build()
    )


@pytest.mark.slow_cases("direct-correction-rk4-straight", "ggl-radau5-straight", "direct-correction-rk4-looped")
@pytest.mark.parametrize("shape", ["straight", "looped"])
@pytest.mark.parametrize(("method", "integrator"), [("direct-correction", "rk4"), ("ggl", "radau5")])
def test_a_cam_is_the_polynomial_that_its_points_lie_on(shape, method, integrator):
    """Value, slope and second derivative of the table enter Phi, nu and gamma: motion and multipliers agree."""
    asked = {"until": 0.6, "method": method, "integrator": integrator, "shape": shape, "output_step": 0.05}
    found = cam_follower("cam(speed*t)").simulate(**asked)
    expected = cam_follower(CAM.replace("t", "(speed*t)")).simulate(**asked)
    assert found.status == expected.status == "ok"
    # multipliers are of the order of 10 N; second derivatives of the table are rounded at 1e-13 of its coefficients
    for table in ("q", "v", "lam"):
        a, b = (getattr(r, table).values for r in (found, expected))
        np.testing.assert_allclose(a, b, rtol=0.0, atol=1e-9)


PUSH = "f(1.2*sin(block.x)) - 9*block.x - 0.1*f(sin(block.vx)) + 0.2*f(t)"


def forced(interpolation, periodic):
    """A block in a guide that a force of a table of its place and rate, and of time, moves."""
    x = np.linspace(-1.0, 1.0, 9)
    y = np.array([0.3, -1.2, 0.4, 2.0, -0.7, 0.1, 1.1, -0.4, 0.3])
    return Model(
        MechanismBuilder("table-force")
        .table("f", x, 40.0 * y, interpolation=interpolation, periodic=periodic)
        .body("block", mass=1.0, inertia=0.1, position=(0.9, 0.0), velocity=(1.5, 0.0))
        .joint("guide", "translational", between=("ground", "block"), at=((0.0, 0.0), "centre"), axis=(1.0, 0.0))
        .force(
            "push",
            "force",
            body="block",
            force=("f(1.2*sin(block.x)) - 9*block.x - 0.1*f(sin(block.vx)) + 0.2*f(t)", 0.0),
        )
        .build()
    )


@pytest.mark.slow
@pytest.mark.parametrize(("interpolation", "periodic"), [("cubic", False), ("cubic", True), ("pchip", False)])
def test_power_of_table_forces_is_the_change_of_energy(interpolation, periodic):
    """The block leaves the table on the right; the same motion from both shapes and another scheme."""
    model = forced(interpolation, periodic)
    runs = [
        model.simulate(
            until=2.0, method="lagrange", integrator="dop853", rtol=1e-11, atol=1e-12, shape=shape, times=TIMES
        )
        for shape in ("straight", "looped")
    ]
    runs.append(model.simulate(until=2.0, method="lagrange", integrator="radau5", rtol=1e-9, atol=1e-11, times=TIMES))
    for run in runs:
        assert run.status == "ok"
        scale = np.abs(run.work).max()
        assert np.abs(run.energy_error).max() < 1e-7 * scale
        np.testing.assert_allclose(run.q["block.x"], runs[0].q["block.x"], rtol=0.0, atol=1e-6)
    assert max(np.sin(runs[0].q["block.x"])) > 1.0 / 1.2


TIMES = np.linspace(0.0, 2.0, 21)


@pytest.mark.slow
def test_lanes_take_smooth_tables():
    from symgen.study.ensemble.parameter_sweep import sweep

    model = forced("cubic", False)
    asked = {"vary": {"block.x": np.linspace(-0.9, 1.2, 11)}, "until": 0.5, "integrator": "rk4"} | {
        "step": 1e-3,
        "method": "lagrange",
    }
    single, lanes = (
        sweep(model, **asked, quantities=["block.x"], target=target)["block.x"] for target in ("cpu", "lanes")
    )
    np.testing.assert_allclose(lanes, single, rtol=0.0, atol=1e-12)


def test_programs_ask_for_the_derivatives_they_need():
    equations = formulate(cam_follower("cam(speed*t)").mechanism)
    asked = {what for block in lower_model(equations, digest="").blocks for what in block.tables}
    assert asked == {("cam", "value"), ("cam", "slope"), ("cam", "second")}


HEIGHTS = (0.0, 0.1, 0.0, 0.1, 0.02)
PLACES = (-1.0, 0.0, 1.0, 2.0, 3.0)


def bead(lift=" - 0.02*f(2*t)"):
    """A point on a wire whose height a table gives, as a knee's path is a table of its angle."""
    return Model(
        validate(
            {
                "mechanism": {"name": "bead", "gravity": [0.0, -9.81]},
                "tables": {"f": {"x": list(PLACES), "y": list(HEIGHTS), "interpolation": "cubic"}},
                "bodies": {"b": {"type": "point", "mass": 1.0, "position": [0.5, 0.1], "velocity": [0.4, 0.0]}},
                "joints": {"wire": {"type": "rows", "rows": [{"position": f"b.y - f(b.x){lift}"}]}},
            },
            "bead",
        )
    )


def on_the_wire(times):
    """Return x of the bead by (1 + f'^2) x'' = -f' (f'' x'^2 + h'' + g), h being the lift of the wire."""
    slope, second = (CubicSpline(PLACES, HEIGHTS).derivative(k) for k in (1, 2))

    def rate(t, y):
        x, v = y
        lift = 0.02 * 4.0 * second(2.0 * t)
        return [v, -slope(x) * (second(x) * v**2 + lift + 9.81) / (1.0 + slope(x) ** 2)]

    start = bead().simulate(until=1e-9, method="lagrange", integrator="rk4")
    begin = [start.q["b.x"][0], start.v["b.vx"][0]]
    return solve_ivp(rate, (0.0, times[-1]), begin, "DOP853", t_eval=times, rtol=1e-12, atol=1e-13).y[0]


@pytest.mark.slow_cases("direct-correction-radau5-looped", "direct-correction-radau5-straight")
@pytest.mark.parametrize("shape", ["straight", "looped"])
@pytest.mark.parametrize(
    ("method", "integrator"),
    [
        ("direct-correction", "radau5"),
        ("direct-correction", "sdirk"),
        ("direct-correction", "trapezoidal"),
        ("direct-correction", "newmark"),
        ("direct-correction", "rodas"),
        ("generalized-alpha", "hht"),
        ("ggl", "radau5"),
        ("generalized-alpha", "generalized-alpha"),
    ],
)
def test_rows_of_tables_in_implicit_schemes(shape, method, integrator):
    """Derivatives of gamma have the third derivative of the table; the motion is that of the wire's own equation."""
    times = np.linspace(0.0, 0.5, 11)
    keys = {"method": method, "integrator": integrator, "shape": shape, "times": times, "until": 0.5}
    adaptive = {"rtol": 1e-9, "atol": 1e-10} if integrator == "radau5" else {"step": 1e-3}
    run = bead().simulate(**keys, **adaptive)
    assert run.status == "ok"
    np.testing.assert_allclose(run.q["b.x"], on_the_wire(times), atol=1e-7 if integrator == "radau5" else 1e-4)


def test_a_table_in_a_row_at_rest():
    """The bead rests where the wire is level; there omega^2 is g f''."""
    f = CubicSpline(PLACES, HEIGHTS)
    low = min(f.derivative().roots(extrapolate=False), key=lambda x: abs(x - 1.0))
    model = bead("")
    rest = model.equilibrium(start={"b.x": 0.8})
    assert rest.stability == "stable" and rest.q["b.x"] == pytest.approx(low, abs=1e-9)
    square = 9.81 * float(f(low, 2))
    assert rest.omega_squared == pytest.approx((square,), rel=1e-9)
    about = model.linearise(start={"b.x": 0.8})
    assert np.sort(about.eigenvalues().imag) == pytest.approx([-(square**0.5), square**0.5], rel=1e-9)
