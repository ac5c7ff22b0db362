"""Stops that move and stops that give way, against closed forms and an event-driven simulation of their own."""

from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

import symgen
from symgen.describe.files.load import parse_toml
from symgen.describe.files.validate import validate

TIGHT = {"integrator": "dop853", "rtol": 1e-12, "atol": 1e-13}
#: A slide of 2 kg that falls from 0.3 m.
SLIDE = """
[mechanism]
name = "slide"
gravity = [0.0, {gravity}]

[parameters]
part = 0.5
amplitude = 0.02

[inputs]
height = 0.0

[bodies.b]
mass = 2.0
inertia = 0.1
position = [0.0, {height}]
velocity = [0.0, {speed}]

[joints.rail]
type = "translational"
between = ["ground", "b"]
at = [[0.0, 0.0], "centre"]
axis = [0.0, 1.0]
"""


def slide(stop: str, gravity: float = -10.0, height: float = 0.3, speed: float = 0.0) -> symgen.Model:
    text = SLIDE.format(gravity=gravity, height=height, speed=speed) + stop
    return symgen.load(validate(parse_toml(text, "slide.toml"), "slide.toml"))


def height_above(floor: Callable[[Any], Any], t: float, y: float, v: float, x: Any) -> Any:
    """Return how far a ball that flies from height y with speed v at t is above a floor at x."""
    return y + v * (x - t) - 5.0 * (x - t) ** 2 - floor(x)


def bounces(until: float) -> tuple[list[float], float, float]:
    """Return the impacts of a ball by gravity on a floor 0.02 sin(20 t) with restitution 0.5, its height and speed."""
    floor, rate = lambda t: 0.02 * np.sin(20.0 * t), lambda t: 0.4 * np.cos(20.0 * t)
    t, y, v, times = 0.0, 0.3, 0.0, []
    while True:
        gap = partial(height_above, floor, t, y, v)
        grid = np.arange(t + 1e-7, until, 1e-5)
        below = np.flatnonzero(gap(grid) < 0.0)
        if not len(below):
            return times, y + v * (until - t) - 5.0 * (until - t) ** 2, v - 10.0 * (until - t)
        hit = brentq(gap, grid[below[0] - 1], grid[below[0]], xtol=1e-15)
        y, v = floor(hit), v - 10.0 * (hit - t)
        v, t = rate(hit) - 0.5 * (v - rate(hit)), hit
        times.append(hit)


# -- stops that move ---------------------------------------------------------------------------------------------------


@pytest.mark.fast("formula-absolute")
@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
@pytest.mark.parametrize(
    ("lower", "inputs"),
    [("amplitude*sin(20*t)", {}), ("height", {"height": "0.02*sin(20*t)"})],
    ids=["formula", "input"],
)
def test_a_floor_that_shakes(lower: str, inputs: dict[str, str], coordinates: str) -> None:
    """A lower end of a formula of t, or of an input, gives the slide its own rate at each impact."""
    model = slide(f'stop = {{ lower = "{lower}", restitution = "part" }}')
    times, y, v = bounces(0.79)
    assert len(times) == 5
    result = model.simulate(until=0.79, coordinates=coordinates, inputs=inputs, **TIGHT)
    assert [event.name for event in result.events] == ["rail.lower.hit"] * 5
    np.testing.assert_allclose([event.t for event in result.events], times, rtol=0.0, atol=1e-10)
    np.testing.assert_allclose([result["b.y"][-1], result["b.vy"][-1]], [y, v], rtol=0.0, atol=1e-9)


@pytest.mark.slow
def test_what_rests_on_a_floor_that_shakes() -> None:
    """It moves with the floor, whose acceleration of 8 m/s^2 is too small to throw it; one of 16 m/s^2 throws it."""
    model = slide('stop = { lower = "amplitude*sin(20*t)" }', height=0.0, speed=0.4)
    result = model.simulate(until=1.0, **TIGHT)
    assert result.events == () and result["rail.lower.mode"].min() == 1.0
    assert result["b.y"][-1] == pytest.approx(0.02 * np.sin(20.0), abs=1e-10)
    assert result["rail.lower.force"][-1] == pytest.approx(2.0 * (10.0 - 8.0 * np.sin(20.0)), abs=1e-8)
    thrown = slide('stop = { lower = "2*amplitude*sin(20*t)" }', height=0.0, speed=0.8).simulate(until=0.1, **TIGHT)
    (leave,) = thrown.events
    assert (leave.name, leave.t) == ("rail.lower.leave", pytest.approx(np.arcsin(10.0 / 16.0) / 20.0, abs=1e-10))


def test_both_ends_move_and_meet_what_is_between_them() -> None:
    """An upper end that comes down at 0.1 m/s pushes down what it meets; a wall of another body's place too."""
    model = slide('stop = { lower = -1.0, upper = "0.4 - 0.1*t" }', gravity=0.0, height=0.3)
    result = model.simulate(until=2.0, **TIGHT)
    assert [(e.name, e.t) for e in result.events] == [
        ("rail.upper.hit", pytest.approx(1.0, abs=1e-10)),
        ("rail.upper.rest", pytest.approx(1.0, abs=1e-10)),
    ]
    assert (result["b.y"][-1], result["b.vy"][-1]) == (pytest.approx(0.2, abs=1e-10), pytest.approx(-0.1, abs=1e-10))


# -- stops that give way -----------------------------------------------------------------------------------------------


def contact(k: float, c: float, m: float, v: float) -> tuple[float, float, float]:
    """Return duration, largest force and rate behind a contact of a mass with a spring and a damper, by its formula.

    x = v/w exp(-d t) sin(w t); the force k x + c x' is 0 at its end, where the damper would begin to pull.
    """
    d = c / (2.0 * m)
    w = np.sqrt(k / m - d**2)

    def x(t: Any) -> Any:
        return v / w * np.exp(-d * t) * np.sin(w * t)

    def rate(t: Any) -> Any:
        return v * np.exp(-d * t) * (np.cos(w * t) - d / w * np.sin(w * t))

    end = brentq(lambda t: k * x(t) + c * rate(t), 0.3 * np.pi / w, 1.2 * np.pi / w, xtol=1e-15)
    times = np.linspace(0.0, end, 200_001)
    return end, float(np.max(k * x(times) + c * rate(times))), float(rate(end))


@pytest.mark.fast("0.0-joint", "30.0-absolute")
@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
@pytest.mark.parametrize("damping", [0.0, 30.0])
def test_the_contact_with_an_elastic_stop(damping: float, coordinates: str) -> None:
    """2 kg at 1 m/s against 1000 N/m: time of contact, largest force and speed behind it by their formulas."""
    stop = (
        f"stop = {{ lower = 0.0, stiffness = 1000.0, damping = {damping} }}\n[outputs]\ntaken = 'rail.lower.dissipated'"
    )
    model = slide(stop, gravity=0.0, height=0.1, speed=-1.0)
    end, peak, speed = contact(1000.0, damping, 2.0, 1.0)
    times = np.concatenate([[0.0], np.linspace(0.1, 0.1 + end, 2001), [0.1 + end + 1e-6, 1.0]])
    result = model.simulate(times=times, until=1.0, coordinates=coordinates, **TIGHT)
    assert result.status == "ok" and result.events == ()
    force = result["rail.lower.force"]
    assert force.max() == pytest.approx(peak, rel=1e-6)
    assert force.min() == 0.0 and force[-2] == 0.0 and force[-4] > 0.0
    assert result["b.vy"][-1] == pytest.approx(-speed, abs=1e-9)
    assert result["taken"][-1] == pytest.approx(1.0 - speed**2, abs=1e-9)


@pytest.mark.slow
def test_an_elastic_stop_in_targets_and_sweeps(tmp_path: Path) -> None:
    """It is a force of the state: no modes, so code of every target has it, and a sweep its largest force."""
    model = slide('stop = { lower = "0.01*t", stiffness = 1000.0, damping = "20*part" }')
    assert model.mechanism.bounded == ()
    assert model.generate(tmp_path / "slide", target="c").files
    parts = np.array([0.0, 0.5, 1.0])
    sweep = model.sweep(
        {"part": parts}, quantities=["max(rail.lower.force)"], until=0.5, times=np.linspace(0.0, 0.5, 5001), **TIGHT
    )

    def fall(t: float, y: np.ndarray, c: float) -> list[float]:
        depth, rate = 0.01 * t - y[0], 0.01 - y[1]
        return [y[1], -10.0 + (max(1000.0 * depth + c * rate, 0.0) if depth > 0.0 else 0.0) / 2.0]

    for part, peak in zip(parts, sweep["max(rail.lower.force)"][:, 0], strict=True):
        run = solve_ivp(fall, (0.0, 0.5), [0.3, 0.0], args=(20.0 * part,), max_step=1e-3, rtol=1e-9, atol=1e-12)
        forces = 2.0 * (np.array([fall(t, y, 20.0 * part)[1] for t, y in zip(run.t, run.y.T, strict=True)]) + 10.0)
        assert peak == pytest.approx(forces.max(), rel=2e-3)


@pytest.mark.slow
def test_an_elastic_gap() -> None:
    """A gap of a formula with the same stiffness is the same stop."""
    limit = slide("stop = { lower = 0.0, stiffness = 1000.0, damping = 30.0 }").simulate(until=1.0, **TIGHT)
    gap = slide('[stops.floor]\ngap = "b.y"\nstiffness = 1000.0\ndamping = 30.0').simulate(until=1.0, **TIGHT)
    np.testing.assert_allclose(gap["b.y"], limit["b.y"], rtol=0.0, atol=1e-10)
    np.testing.assert_allclose(gap["floor.force"], limit["rail.lower.force"], rtol=0.0, atol=1e-6)
