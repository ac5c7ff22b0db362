"""A linkage whose pins share a friction, and a block on one of its bars whose friction is by its reaction."""

from pathlib import Path

import numpy as np
import pytest
from scipy.optimize import brentq, linprog

import symgen
from benchmarks.bounded.compare import ROWS, Reference, examined
from benchmarks.bounded.sleds import sledded
from tests.result.targets.test_c_modes import assert_same_run, loaded, program_of
from tests.result.targets.test_fmu import fmu_of, simulated
from tests.run.modes.test_static_sets import ENDS, PULL, five_bar

#: Force on the block [N], its friction over its reaction, its mass [kg], and where it starts along the bar.
LOAD, COEFFICIENT, MASS, START = np.array([0.9, -1.1]), 0.3, 0.5, -0.1
STATIC = np.array([0.806, 1.168, 2.522, 1.996, 0.826])
#: Direction of the bar that the block slides on, and its middle.
ALONG, MIDDLE = (ENDS[2] - ENDS[1]) / np.hypot(*(ENDS[2] - ENDS[1])), (ENDS[1] + ENDS[2]) / 2.0


def five_bar_with_block() -> str:
    """Return the linkage with a block that starts along a bar at a parameter's speed."""
    angle, position = float(np.arctan2(ALONG[1], ALONG[0])), (MIDDLE + START * ALONG).tolist()
    text = five_bar(STATIC, 0.6).replace("[bodies.b0]", "[parameters]\nspeed = 1.0\n[bodies.b0]", 1)
    return (
        text
        + f"""
[bodies.block]
mass = {MASS}
inertia = 0.01
angle = {angle!r}
position = {position}
velocity = ["speed*{float(ALONG[0])!r}", "speed*{float(ALONG[1])!r}"]
[joints.slide]
type = "translational"
between = ["b1", "block"]
at = [[{START}, 0.0], [0.0, 0.0]]
axis = [1.0, 0.0]
friction = {{ coefficient = {COEFFICIENT} }}
[forces.load]
type = "force"
body = "block"
force = {LOAD.tolist()}
"""
    )


def block_at(speed: float, t: float) -> tuple[float, float]:
    """Return where the block is along the bar at rest, and its acceleration; friction stops it for good."""
    pressing, along = abs(LOAD[0] * -ALONG[1] + LOAD[1] * ALONG[0]), LOAD @ ALONG
    assert abs(along) < COEFFICIENT * pressing
    slowing = (along - COEFFICIENT * pressing * np.sign(speed)) / MASS
    if speed == 0.0 or t >= -speed / slowing:
        return START + (0.0 if speed == 0.0 else -0.5 * speed**2 / slowing), 0.0
    return START + speed * t + 0.5 * slowing * t**2, slowing


def part_needed(speed: float, t: float) -> float:
    """Return the least largest part of what the pins hold at rest, of all forces that hold the linkage."""
    turned = np.array([[-1.0, 1.0]]) * np.diff(ENDS, axis=0)[:, ::-1]
    rates = np.linalg.svd(turned.T)[2][2:].T
    pins = np.diff(np.vstack([np.zeros((1, 2)), rates, np.zeros((1, 2))]), axis=0)
    place, acceleration = block_at(speed, t)
    arm = MIDDLE + place * ALONG - ENDS[1]
    moves = np.outer(turned[0], rates[0]) + np.outer([-arm[1], arm[0]], rates[1])
    power = t * (PULL @ (turned[:2].T @ rates[:2])) + (LOAD - MASS * acceleration * ALONG) @ moves
    sides = [np.column_stack([side * np.eye(5), -STATIC]) for side in (1.0, -1.0)]
    found = linprog(
        np.r_[np.zeros(5), 1.0],
        A_ub=np.vstack(sides),
        b_ub=np.zeros(10),
        A_eq=np.column_stack([pins.T, np.zeros(2)]),
        b_eq=-power,
        bounds=[(None, None)] * 5 + [(0.0, None)],
    )
    return float(found.x[-1])


def breakaway(speed: float) -> float:
    """Return the first time at which no forces within the bounds of the pins hold the linkage."""
    times = np.linspace(0.0, 20.0, 201)
    late = next(t for t in times if part_needed(speed, float(t)) > 1.0)
    return float(brentq(lambda t: part_needed(speed, t) - 1.0, late - times[1], late, xtol=1e-11))


def first_slip(result: symgen.Result) -> float:
    return next(event.t for event in result.events if event.name[0] == "p" and event.name.endswith(".slip"))


@pytest.mark.by_turns(2)
@pytest.mark.slow
@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
def test_pins_hold_while_a_block_slides_and_rests(coordinates: str, tmp_path: Path) -> None:
    """At 2.5 m/s the block still slides where the linkage breaks loose; at 0.7 m/s it rests before."""
    model = loaded(five_bar_with_block(), tmp_path)
    for speed in (0.7, 2.5):
        expected = breakaway(speed)
        settings = {"integrator": "dop853", "until": expected + 0.1, "coordinates": coordinates, "verify": False}
        result = model.simulate(parameters={"speed": speed}, **settings)
        assert result.ok
        assert first_slip(result) == pytest.approx(expected, rel=1e-8)
        sticks = [event.t for event in result.events if event.name == "slide.stick"]
        assert (len(sticks) == 1 and sticks[0] < expected) == (speed != 2.5)


@pytest.mark.slow
@pytest.mark.by_turns(15)
@pytest.mark.parametrize("part", range(15))
def test_pins_hold_at_300_speeds_of_the_block(part: int, tmp_path: Path) -> None:
    """From 0.01 to 3 m/s; about 2.4 m/s the linkage would hold again 0.1 s after it has broken loose."""
    model = loaded(five_bar_with_block(), tmp_path)
    for speed in np.linspace(0.01, 3.0, 300)[part::15]:
        expected = breakaway(speed)
        settings = {"integrator": "dop853", "until": expected + 0.1, "verify": False}
        result = model.simulate(parameters={"speed": float(speed)}, **settings)
        assert result.ok and first_slip(result) == pytest.approx(expected, rel=2e-9), speed


@pytest.mark.by_turns(4)
@pytest.mark.slow
def test_pins_hold_in_rows_in_c_in_an_fmu_and_step_by_step(tmp_path: Path) -> None:
    """All of them call one function; the linkage has moved by the end."""
    model = loaded(five_bar_with_block().replace("speed = 1.0", "speed = 2.5"), tmp_path)
    until = round(breakaway(2.5) + 0.2, 1)
    transitions = assert_same_run(model, program_of(model, tmp_path / "c"), until, 2e-3)
    assert transitions[0][0] == pytest.approx(breakaway(2.5), rel=1e-8)
    alone = model.simulate(integrator="dop853", until=until, rtol=1e-11, atol=1e-12, verify=False)
    rows = model.sweep({"speed": [0.7, 2.5]}, integrator="dop853", until=until, rtol=1e-11, atol=1e-12, times=[until])
    assert rows["b0.theta"][1, -1] == pytest.approx(alone["b0.theta"][-1], abs=1e-10)
    assert abs(alone["b0.theta"][-1] - alone["b0.theta"][0]) > 1e-3
    run = model.start(integrator="dop853", rtol=1e-11, atol=1e-12)
    for _ in range(round(until / 0.1)):
        run.step(0.1)
    assert run.q["b0.theta"] == pytest.approx(alone["b0.theta"][-1], abs=1e-9)
    found = simulated(fmu_of(model, tmp_path / "bar.fmu"), "ModelExchange", until, outputs=["b0.theta"])
    assert found["b0.theta"][-1] == pytest.approx(alone["b0.theta"][-1], abs=1e-6)


@pytest.mark.by_turns(2)
@pytest.mark.slow
def test_motions_are_those_without_a_sled() -> None:
    """A sled that rubs by its reaction, beside the event-driven simulation of what stands next to it."""
    against, verdicts = examined(sledded("loop", 4), ("lagrange", ROWS), 1.2)
    assert isinstance(against, Reference)
    assert [verdict for verdict in verdicts if verdict.outcome != "right"] == []
    assert len(verdicts) == 2
