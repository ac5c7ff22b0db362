"""Constant steps at times where formulas jump or have kinks: each scheme keeps its order."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from itertools import pairwise
from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import symgen
from symgen.base.errors import InputError
from symgen.describe.files.load import parse_toml
from symgen.describe.files.validate import validate

AT, UNTIL = 0.3137, 1.0
#: A block on a rail, with a spring that becomes stiffer.
RAIL = """
[mechanism]
name = "jumps"
gravity = [0.0, 0.0]
[parameters]
at = 0.3137
[bodies.b]
mass = 1.0
inertia = 0.1
velocity = [1.0, 0.0]
[joints.rail]
type = "translational"
between = ["ground", "b"]
at = [[0.0, 0.0], "centre"]
axis = [1.0, 0.0]
[forces.f]
type = "force"
body = "b"
force = ["-4*b.x - 6*b.x**3 + PUSH", "0"]
"""
#: A point whose height a row, a driver or a stop gives, and a spring along x that it makes stiffer.
LIFT = """
[mechanism]
name = "lifts"
gravity = [0.0, -9.81]
[parameters]
at = 0.3137
[bodies.b]
type = "point"
mass = 1.0
velocity = [1.0, 0.0]
[forces.f]
type = "force"
body = "b"
force = ["-4*b.x*(1 + b.y) - 0.2*b.vy", "0"]
"""
ROW = LIFT + '[joints.lift]\ntype = "rows"\nrows = [{ position = "b.y - (0.8*(t - at)**2 if t > at else 0)" }]\n'
STOP = LIFT + '[stops.lift]\ngap = "b.y - 0.8*max(0, t - at)**2"\n'
#: A pendulum on a slider that begins to move.
DRIVEN = """
[mechanism]
name = "driven"
gravity = [0.0, -9.81]
[parameters]
at = 0.3137
[bodies.slider]
mass = 1.0
inertia = 0.1
[bodies.b]
mass = 1.0
inertia = 0.5
position = [0.0, -1.0]
points = { pin = [0.0, 1.0] }
[joints.rail]
type = "translational"
between = ["ground", "slider"]
at = [[0.0, 0.0], "centre"]
axis = [1.0, 0.0]
[joints.pin]
type = "revolute"
between = ["slider", "b"]
at = ["centre", "pin"]
start = { angle = 1.0 }
[joints.drive]
type = "driver"
joint = "rail"
value = "2*max(0, t - at)**2"
"""
#: A block that a push breaks loose: up to then it is held.
HELD = (
    RAIL.replace("PUSH", "(3.0 if t > at else 0.5)")
    .replace("velocity = [1.0, 0.0]\n", "")
    .replace("axis = [1.0, 0.0]\n", "axis = [1.0, 0.0]\nfriction = { sliding = 1.0 }\n")
)
TABLE = '[tables.push]\nx = [0.0, 0.3137, 0.4, 1.0]\ny = [0.0, 0.0, 3.0, 1.0]\ninterpolation = "linear"\n'


def spring(push: Callable[[float], float]) -> Callable[[float, Any], Any]:
    """Return rates of a block on its spring."""
    return lambda t, y: [y[1], -4 * y[0] - 6 * y[0] ** 3 + push(t)]


def lifted(t: float, y: Any) -> Any:
    up = max(0.0, t - AT)
    return [y[1], -4 * y[0] * (1 + 0.8 * up**2) - 0.2 * 1.6 * up]


def swung(t: float, y: Any) -> Any:
    """A pendulum with its centre at 1 m, whose pin moves by 4 m/s^2 behind the time."""
    pushed = 4.0 if t > AT else 0.0
    return [y[1], -(9.81 * np.sin(y[0]) + pushed * np.cos(y[0])) / 1.5]


def with_state(t: float, y: Any) -> Any:
    return [y[1], -4 * y[0] - 6 * y[0] ** 3 + 3 * y[2], (2.0 if t > AT else 0.0) - y[2]]


def with_integral(t: float, y: Any) -> Any:
    return [y[1], -4 * y[0] - 6 * y[0] ** 3, y[1] ** 2 if t > AT else 0.0]


def broken_loose(t: float, y: Any) -> Any:
    return [y[1], -4 * y[0] - 6 * y[0] ** 3 + 2.0] if t > AT else [0.0, 0.0]


def squares(t: float) -> float:
    return 2.0 * float(np.sign(np.sin(9.7 * t)))


#: Text, what is read at the end, its rates, its start, times of jumps.
KINDS: dict[str, tuple[str, tuple[str, ...], Callable[[float, Any], Any], list[float], tuple[float, ...]]] = {
    "force": (
        RAIL.replace("PUSH", "(3.0 if t > at else 0.0)"),
        ("b.x", "b.vx"),
        spring(lambda t: 3.0 if t > AT else 0.0),
        [0.0, 1.0],
        (AT,),
    ),
    "square wave": (
        RAIL.replace("PUSH", "2*sign(sin(9.7*t))"),
        ("b.x", "b.vx"),
        spring(squares),
        [0.0, 1.0],
        (np.pi / 9.7, 2 * np.pi / 9.7, 3 * np.pi / 9.7),
    ),
    "pulse": (
        RAIL.replace("PUSH", "(400.0 if t > at and t < at + 0.002 else 0.0)"),
        ("b.x", "b.vx"),
        spring(lambda t: 400.0 if AT < t < AT + 0.002 else 0.0),
        [0.0, 1.0],
        (AT, AT + 0.002),
    ),
    "table": (
        RAIL.replace("PUSH", "push(t)") + TABLE,
        ("b.x", "b.vx"),
        spring(lambda t: float(np.interp(t, [0.0, 0.3137, 0.4, 1.0], [0.0, 0.0, 3.0, 1.0]))),
        [0.0, 1.0],
        (AT, 0.4),
    ),
    "state": (
        RAIL.replace("PUSH", "3*z") + '[states.z]\nrate = "(2.0 if t > at else 0.0) - z"\n',
        ("b.x", "z"),
        with_state,
        [0.0, 1.0, 0.0],
        (AT,),
    ),
    "integral": (
        RAIL.replace("PUSH", "0") + '[outputs]\nw = "integral(b.vx**2 if t > at else 0.0)"\n',
        ("b.x", "w"),
        with_integral,
        [0.0, 1.0, 0.0],
        (AT,),
    ),
    "row": (ROW, ("b.x", "b.vx"), lifted, [0.0, 1.0], (AT,)),
    "stop": (STOP, ("b.x", "b.vx"), lifted, [0.0, 1.0], (AT,)),
    "driver": (DRIVEN, ("pin.angle",), swung, [1.0, 0.0], (AT,)),
    "friction": (HELD, ("b.x", "b.vx"), broken_loose, [0.0, 0.0], (AT,)),
}
SCHEMES: dict[str, dict[str, Any]] = {
    "rk4": {"integrator": "rk4"},
    "heun": {"integrator": "heun"},
    "abm4": {"integrator": "abm4"},
    "dopri5": {"integrator": "dopri5", "options": {"integrator.adaptive": "false"}},
    "sdirk": {"method": "lagrange", "integrator": "sdirk", "options": {"integrator.adaptive": "false"}},
    "gauss": {"method": "symmetric-projection", "integrator": "gauss"},
    "trapezoidal": {"method": "lagrange", "integrator": "trapezoidal"},
    "generalized-alpha": {"method": "generalized-alpha", "integrator": "generalized-alpha"},
    "half-explicit": {"method": "half-explicit", "integrator": "half-explicit"},
}
ORDERS = {"rk4": 4, "abm4": 4, "dopri5": 5, "sdirk": 4, "gauss": 4, "half-explicit": 3}


def inside(rates: Callable[[float, Any], Any], begin: float, end: float) -> Callable[[float, Any], Any]:
    """Return rates that are those of one piece at its ends, too."""
    return lambda t, y: rates(min(max(t, begin), end), y)


@cache
def reference(kind: str) -> np.ndarray:
    """Return what is read at the end, by pieces between jumps."""
    _, names, rates, y, jumps = KINDS[kind]
    for begin, end in pairwise([0.0, *jumps, UNTIL]):
        beside = begin + 1e-14, end - 1e-14
        y = (
            solve_ivp(inside(rates, *beside), (begin, end), y, method="DOP853", rtol=1e-13, atol=1e-14)
            .y[:, -1]
            .tolist()
        )
    places = {"z": 2, "w": 2, "b.vx": 1}
    return np.array([y[places.get(name, 0)] for name in names])


@cache
def model(kind: str) -> symgen.Model:
    return symgen.load(validate(parse_toml(KINDS[kind][0], "jumps.toml"), "jumps.toml"))


def error_of(kind: str, step: float, **settings: Any) -> float:
    result = model(kind).simulate(step=step, until=UNTIL, verify=False, max_violation=1e-2, **settings)
    assert result.status == "ok", result.reason
    assert len(result.t) == round(UNTIL / step) + 1  # the grid of outputs is that of steps
    found = np.array([result[name][-1] for name in KINDS[kind][1]])
    return float(np.abs(found - reference(kind)).max())


@pytest.mark.by_turns(4)
@pytest.mark.fast(
    "force-abm4",
    "square wave-sdirk",
    "pulse-generalized-alpha",
    "table-dopri5",
    "state-trapezoidal",
    "integral-heun",
    "row-half-explicit",
)
@pytest.mark.parametrize(
    ("kind", "scheme"),
    [(k, s) for k in KINDS for s in SCHEMES if s != "half-explicit" or k not in ("stop", "friction", "driver")],
)
def test_schemes_keep_their_order(kind: str, scheme: str) -> None:
    """Over three steps, none of which meets the jumps."""
    errors = [error_of(kind, step, **SCHEMES[scheme]) for step in (0.02, 0.01, 0.005)]
    slopes = [np.log2(a / b) for a, b in pairwise(errors)]
    order = ORDERS.get(scheme, 2)
    assert errors[-1] < 3e-12 or min(slopes) > order - 0.3 or slopes[-1] > order - 0.3, (errors, slopes)


@pytest.mark.by_turns(3)
@pytest.mark.slow_cases("driver-rk4", "friction-rk4", "stop-abm4", "stop-rk4", "friction-abm4", "driver-abm4")
@pytest.mark.parametrize("scheme", ["rk4", "abm4"])
@pytest.mark.parametrize("kind", ["force", "pulse", "stop", "driver", "friction"])
def test_joint_coordinates_keep_the_order(kind: str, scheme: str) -> None:
    errors = [error_of(kind, step, coordinates="joint", **SCHEMES[scheme]) for step in (0.01, 0.005)]
    assert errors[1] < 3e-8 and np.log2(errors[0] / errors[1]) > 3.6


@pytest.mark.by_turns(4)
@pytest.mark.slow
@pytest.mark.parametrize("at", [0.3137, 0.31, 0.0])
@pytest.mark.parametrize("kind", ["force", "stop", "friction"])
def test_rows_and_steps_are_single_runs(kind: str, at: float) -> None:
    """Where jumps lie on the grid of steps, and where they do not; steps from Python leave the run as it is."""
    settings: dict[str, Any] = {"integrator": "rk4", "step": 0.01}
    alone = model(kind).simulate(parameters={"at": at}, until=UNTIL, verify=False, **settings)
    rows = model(kind).sweep({"at": [at, 0.5]}, quantities=("q", "v"), until=UNTIL, **settings)
    sim = model(kind).start(parameters={"at": at}, **settings)
    free = model(kind).start(parameters={"at": at}, integrator="rk4")
    for _ in range(10):
        sim.step(0.1)
    assert sim.t == pytest.approx(UNTIL, abs=1e-15)
    assert alone.status == "ok" and rows.status[0] == "ok"
    for name in (*alone.q, *alone.v):
        assert rows[name][0, -1] == alone[name][-1], name
        assert sim[name] == pytest.approx(alone[name][-1], abs=1e-13), name
    if at > 0.0:
        alone = model(kind).simulate(parameters={"at": at}, until=UNTIL, verify=False, integrator="rk4", step=1e-3)
        for _ in range(1000):
            free.step(1e-3)
        for name in (*alone.q, *alone.v):
            assert free[name] == pytest.approx(alone[name][-1], abs=1e-10), name


def test_a_jump_at_the_start_acts_from_the_start() -> None:
    """A push with ``t > 0``: the first stage of the first step has it."""
    text = RAIL.replace("PUSH", "(3.0 if t > 0 else 0.0)").replace("-4*b.x - 6*b.x**3 +", "")
    result = symgen.load(validate(parse_toml(text, "push.toml"), "push.toml")).simulate(
        integrator="rk4", step=0.05, until=1.0
    )
    assert result["b.x"][-1] == pytest.approx(2.5, abs=1e-14) and result["b.vx"][-1] == pytest.approx(4.0, abs=1e-14)


def test_events_at_a_jump_happen_once() -> None:
    """An event at the very time of a jump, and one of what jumps."""
    text = RAIL.replace("PUSH", "(3.0 if t > at else 0.0)") + (
        '[events.then]\nwhen = "t - at"\naction = "record"\n'
        '[events.pushed]\nwhen = "(3.0 if t > at else 0.0) - 1.0"\ndirection = "rising"\naction = "record"\n'
    )
    for at in (0.3, 0.3137):
        run = symgen.load(validate(parse_toml(text, "push.toml"), "push.toml"))
        result = run.simulate(integrator="rk4", step=0.01, until=1.0, parameters={"at": at})
        assert sorted(event.name for event in result.events) == ["pushed", "then"]
        assert [event.t for event in result.events] == pytest.approx([at, at], abs=1e-12)


@pytest.mark.slow_cases("0.1", "0.01")
@pytest.mark.parametrize("step", [0.1, 0.01, 0.007])
def test_no_stage_lies_behind_a_jump_at_a_point_of_the_grid(step: float) -> None:
    """Of 300 jumps at k*step, which lie on either side of a sum of steps by rounding, each is met exactly."""
    text = RAIL.replace("PUSH", "(3.0 if t > at else 0.0)").replace("-4*b.x - 6*b.x**3 +", "")
    mechanism = validate(parse_toml(text, "push.toml"), "push.toml")
    at = [k * step for k in range(1, 301)]
    end = 302 * step
    found = symgen.load(mechanism).sweep({"at": at}, integrator="rk4", step=step, until=end, quantities=("q", "v"))
    np.testing.assert_allclose(found["b.vx"][:, -1], [1.0 + 3.0 * (end - t) for t in at], rtol=0.0, atol=1e-10)


def test_steps_beyond_the_end_of_runs_meet_jumps() -> None:
    """A file's run ends at 1 s; steps from Python go on."""
    text = RAIL.replace("PUSH", "(1.0 if t > 0.5 else 0.0) + (1.0 if t > 2.5037 else 0.0)")
    text = text.replace("-4*b.x - 6*b.x**3 +", "").replace("[parameters]", "[run]\nuntil = 1.0\n[parameters]")
    for settings in ({"integrator": "rk4", "step": 0.01}, {"integrator": "rk4"}):
        sim = symgen.load(validate(parse_toml(text, "push.toml"), "push.toml")).start(**settings)
        for _ in range(400):
            sim.step(0.01)
        assert sim["b.vx"] == pytest.approx(1.0 + 3.5 + 4.0 - 2.5037, abs=1e-11)


def test_a_file_without_jumps_has_the_same_steps() -> None:
    """Tables with continuous third derivatives, and what depends on the state, end no constant step."""
    smooth = RAIL.replace("PUSH", "push(t) + abs(b.x)") + TABLE.replace('"linear"', '"cubic"')
    run = symgen.load(validate(parse_toml(smooth, "smooth.toml"), "smooth.toml")).simulate(
        integrator="rk4", step=0.01, until=1.0
    )
    assert run.steps == 100


def test_lanes_refuse_jumps() -> None:
    with pytest.raises(InputError, match="no formulas that jump at times known beforehand"):
        model("force").sweep({"at": [0.2, 0.3]}, integrator="rk4", step=0.01, target="lanes")
