"""Stops whose gaps change over time themselves: impacts, rest and work against closed forms."""

from typing import Any

import numpy as np
import pytest

import symgen
from symgen.base.errors import InputError
from symgen.describe.files.load import parse_toml
from symgen.describe.files.validate import validate
from symgen.describe.mechanism import Mechanism

#: A ball of 2 kg falls from 0.3 m on a floor that rises at 0.5 m/s, which it meets at 0.2 s.
FLOOR = """
[mechanism]
name = "moving-floor"
gravity = [0.0, -10.0]

[parameters]
part = 1.0

[bodies.b]
type = "point"
mass = 2.0
position = [0.0, 0.3]

[joints.guide]
type = "rows"
rows = [{ position = "b.x" }]

[stops.floor]
gap = "b.y - 0.5*t"
restitution = "part"

[outputs]
lost = "floor.dissipated"
"""
#: A load at rest that a rope on a winch takes up at 0.6 s.
WINCH = """
[mechanism]
name = "winch"

[bodies.b]
type = "point"
mass = 2.0
position = [0.0, -0.7]

[joints.guide]
type = "rows"
rows = [{ position = "b.x" }]

[stops.rope]
gap = "1 - 0.5*t + b.y"
"""
#: A block of 2 kg on a rail with 4 N of friction, before a wall that comes at 1 m/s from 0.5 m behind it.
WALL = """
[mechanism]
name = "moving-wall"

[parameters]
part = 0.0
speed = 0.0

[bodies.block]
mass = 2.0
inertia = 0.1
velocity = ["speed", 0.0]

[joints.rail]
type = "translational"
between = ["ground", "block"]
at = [[0.0, 0.0], "centre"]
axis = [1.0, 0.0]
friction = { sliding = 4.0 }

[stops.wall]
gap = "block.x + 0.5 - t"
restitution = "part"

[outputs]
lost = "wall.dissipated"
"""
STEPS = [
    {},
    {"integrator": "dop853", "rtol": 1e-11, "atol": 1e-12},
    {"integrator": "radau5", "rtol": 1e-10, "atol": 1e-12},
    {"integrator": "rk4", "step": 1e-2},
]
NAMES = ["default", "dop853", "radau5", "rk4"]


def described(text: str) -> Mechanism:
    return validate(parse_toml(text, "moving.toml"), "moving.toml")


def simulate(text: str, steps: dict[str, Any], **settings: Any) -> Any:
    result = symgen.load(described(text)).simulate(**steps, **settings)
    assert result.status == "ok", result.reason
    return result


@pytest.mark.slow_cases("1.0-default-joint", "1.0-dop853-joint")
@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
@pytest.mark.parametrize("steps", STEPS, ids=NAMES)
@pytest.mark.parametrize("part", [1.0, 0.5, 0.0])
def test_an_impact_on_a_rising_floor(part: float, steps: dict[str, Any], coordinates: str) -> None:
    """The rate of 2.5 m/s relative to the floor is reversed; the plastic ball rises with the floor."""
    result = simulate(
        FLOOR, steps, parameters={"part": part}, until=0.25, times=[0.0, 0.1, 0.25], coordinates=coordinates
    )
    assert [event.name for event in result.events] == ["floor.hit", "floor.rest"][: 2 if part == 0.0 else 1]
    assert result.events[0].t == pytest.approx(0.2, abs=1e-12)
    speed, gravity = (0.5 + 2.5 * part), 10.0 if part else 0.0
    height = 0.1 + speed * 0.05 - gravity / 2.0 * 0.05**2
    np.testing.assert_allclose(result["b.y"], [0.3, 0.25, height], rtol=0, atol=1e-10)
    np.testing.assert_allclose(result["b.vy"], [0.0, -1.0, speed - 0.05 * gravity], rtol=0, atol=1e-10)
    assert result["lost"][-1] == pytest.approx(6.25 * (1.0 - part**2), abs=1e-10)
    assert max(result.events[0].impulses.values()) == pytest.approx(5.0 * (1.0 + part), abs=1e-10)
    assert result.energy_drift_max < 1e-11  # the floor's work counts


@pytest.mark.parametrize("steps", STEPS, ids=NAMES)
def test_a_winch_takes_a_load_along(steps: dict[str, Any]) -> None:
    result = simulate(WINCH, steps, until=1.0, times=[0.5, 1.0])
    assert [(event.name, round(event.t, 12)) for event in result.events] == [("rope.hit", 0.6), ("rope.rest", 0.6)]
    np.testing.assert_allclose(result["b.y"], [-0.7, -0.5], rtol=0, atol=1e-10)
    np.testing.assert_allclose(result["b.vy"], [0.0, 0.5], rtol=0, atol=1e-10)


@pytest.mark.slow_cases("default-joint", "dop853-joint")
@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
@pytest.mark.parametrize("steps", STEPS, ids=NAMES)
def test_a_floor_that_swings_throws_what_rests_on_it(steps: dict[str, Any], coordinates: str) -> None:
    """It is left where its acceleration is that of gravity, with its speed; its force does work."""
    moving = FLOOR.replace('"b.y - 0.5*t"', '"b.y - 0.3 - 0.2*sin(10.0*t)"').replace("part = 1.0", "part = 0.0")
    moving = moving.replace("position = [0.0, 0.3]", "position = [0.0, 0.3]\nvelocity = [0.0, 2.0]")
    left = np.arcsin(0.5) / 10.0
    result = simulate(moving, steps, until=0.15, times=[0.04, 0.15], coordinates=coordinates)
    assert [event.name for event in result.events] == ["floor.leave"]
    assert result.events[0].t == pytest.approx(left, abs=1e-10)
    flight = 0.15 - left
    height = 0.4 + 2.0 * np.cos(0.5235987755982989) * flight - 5.0 * flight**2
    np.testing.assert_allclose(result["b.y"], [0.3 + 0.2 * np.sin(0.4), height], rtol=0, atol=1e-9)
    assert result.energy_drift_max < 1e-6


@pytest.mark.slow_cases("1.0-default-joint", "1.0-default-absolute", "1.0-dop853-joint", "1.0-radau5-joint")
@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
@pytest.mark.parametrize("steps", STEPS, ids=NAMES)
@pytest.mark.parametrize("part", [1.0, 0.5, 0.0])
def test_a_wall_pushes_a_block_that_friction_holds(part: float, steps: dict[str, Any], coordinates: str) -> None:
    """It is hit at 0.5 s, slides at 1 + e m/s and is overtaken e s later, at a relative rate of -e."""
    result = simulate(WALL, steps, parameters={"part": part}, until=0.8, times=[0.4, 0.8], coordinates=coordinates)
    assert result.events[0].name == "wall.hit" and result.events[0].t == pytest.approx(0.5, abs=1e-12)
    time = 0.8 - 0.5
    place = (1.0 + part) * time - (time**2 if part else 0.0)
    np.testing.assert_allclose(result["block.x"], [0.0, place], rtol=0, atol=1e-10)
    assert result["lost"][-1] == pytest.approx(1.0 - part**2, abs=1e-10)
    assert result.energy_drift_max < 1e-10


@pytest.mark.by_turns(3)
@pytest.mark.slow_cases(
    "1.0-default-absolute", "1.0-default-joint", "1.0-dop853-joint", "1.0-dop853-absolute", "1.0-radau5-joint"
)
@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
@pytest.mark.parametrize("steps", STEPS, ids=NAMES)
@pytest.mark.parametrize("part", [1.0, 0.5, 0.0])
def test_a_wall_meets_a_block_that_slides(part: float, steps: dict[str, Any], coordinates: str) -> None:
    """The block moves at -1 + 2 t m/s, and the wall at 1 m/s; it is met at 0.25 s at a relative rate of 1.5 m/s."""
    moving = WALL.replace("speed = 0.0", "speed = -1.0").replace("+ 0.5 - t", "+ 0.4375 - t")
    behind, time = 1.0 + 1.5 * part, 0.05
    result = simulate(moving, steps, parameters={"part": part}, until=0.3, times=[0.3], coordinates=coordinates)
    assert result.events[0].name == "wall.hit" and result.events[0].t == pytest.approx(0.25, abs=1e-11)
    slows = 2.0 if part else 0.0
    np.testing.assert_allclose(result["block.x"], -0.1875 + behind * time - slows / 2.0 * time**2, rtol=0, atol=1e-10)
    np.testing.assert_allclose(result["block.vx"], behind - slows * time, rtol=0, atol=1e-10)
    assert result["lost"][-1] == pytest.approx(2.25 * (1.0 - part**2), abs=1e-10)
    assert result.energy_drift_max < 1e-10


@pytest.mark.by_turns(3)
@pytest.mark.slow_cases(
    "1.0-default-joint", "1.0-default-absolute", "1.0-dop853-joint", "1.0-dop853-absolute", "1.0-radau5-joint"
)
@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
@pytest.mark.parametrize("steps", STEPS, ids=NAMES)
@pytest.mark.parametrize("part", [1.0, 0.5, 0.0])
def test_a_wall_meets_a_block_that_comes_to_rest(part: float, steps: dict[str, Any], coordinates: str) -> None:
    """The wall is met where the block has just come to rest, at 0.5 s: it slides on at once, the other way."""
    moving = WALL.replace("speed = 0.0", "speed = -1.0").replace("+ 0.5 - t", "+ 1.25 - 2.0*t")
    met, behind = 0.5, 2.0 + 2.0 * part  # -t + t**2 + 1.25 = 2 t
    result = simulate(moving, steps, parameters={"part": part}, until=0.8, times=[0.8], coordinates=coordinates)
    hit = next(event for event in result.events if event.name == "wall.hit")
    assert hit.t == pytest.approx(met, abs=1e-11)
    time = 0.8 - met
    place = -0.25 + behind * time - (time**2 if part else 0.0)
    np.testing.assert_allclose(result["block.x"], [place], rtol=0, atol=1e-10)
    np.testing.assert_allclose(result["block.vx"], [behind - (2.0 * time if part else 0.0)], rtol=0, atol=1e-10)
    assert result["lost"][-1] == pytest.approx(4.0 * (1.0 - part**2), abs=1e-10)
    assert result.energy_drift_max < 1e-10


@pytest.mark.by_turns(2)
@pytest.mark.slow
@pytest.mark.parametrize("steps", [{"integrator": "dop853", "rtol": 1e-10}, {"integrator": "rk4", "step": 1e-2}, {}])
@pytest.mark.parametrize("text", [FLOOR, WALL])
def test_rows_and_steps_have_these_impacts(text: str, steps: dict[str, Any]) -> None:
    """Rows of a sweep have the bits of single runs; steps from Python end at the same state within rounding."""
    model, parts = symgen.load(described(text)), [1.0, 0.5, 0.0]
    span: dict[str, Any] = {"until": 0.6, "times": [0.2, 0.6]}
    alone = [model.simulate(parameters={"part": x}, verify=False, **span, **steps) for x in parts]
    rows = model.sweep({"part": parts}, quantities=("q", "v", "lost"), **span, **steps)
    for i, run in enumerate(alone):
        assert rows.status[i] == run.status == "ok"
        for name in (*run.q, *run.v, "lost"):
            assert rows[name][i].tolist() == run[name].tolist(), name
        sim = model.start(parameters={"part": parts[i]}, **steps)
        for _ in range(5):
            sim.step(0.12)
        assert [event.name for event in sim.events] == [event.name for event in run.events]
        for name in (*run.q, *run.v):
            assert sim[name] == pytest.approx(run[name][-1], abs=1e-9), name


def test_impacts_on_a_rising_floor_accumulate() -> None:
    """The flights relative to the floor last 2 u / g: their series ends at 0.2 s + 2 (2.5 e) / (g (1 - e))."""
    result = simulate(FLOOR, {}, parameters={"part": 0.6}, until=1.2, times=[1.2])
    assert result.events[-1].name == "floor.rest" and result.events[-1].t == pytest.approx(0.95, abs=1e-5)
    (note,) = [note for note in result.notes if "accumulate" in note]
    assert float(note.split("t = ")[1].split(" ")[0]) == pytest.approx(0.95, abs=1e-9)
    assert result["b.y"][-1] == pytest.approx(0.6, abs=1e-10)
    assert result["b.vy"][-1] == pytest.approx(0.5, abs=1e-10)
    assert result["lost"][-1] == pytest.approx(6.25, abs=1e-9)


@pytest.mark.by_turns(4)
@pytest.mark.fast("max(0, t - 0.3037)-0.0-rk4-absolute", "(t - 0.3037 if t > 0.3037 else 0)-0.0-default-absolute")
@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
@pytest.mark.parametrize("steps", STEPS, ids=NAMES)
@pytest.mark.parametrize("part", [1.0, 0.5, 0.0])
@pytest.mark.parametrize("moved", ["max(0, t - 0.3037)", "(t - 0.3037 if t > 0.3037 else 0)"])
def test_a_floor_that_starts_at_once_strikes(moved: str, part: float, steps: dict[str, Any], coordinates: str) -> None:
    """The ball rests on it up to then; the rate of 1 m/s is that of an impact."""
    text = FLOOR.replace("0.5*t", moved).replace("0.3]", "0.0]")
    result = simulate(text, steps, parameters={"part": part}, until=0.4, times=[0.2, 0.4], coordinates=coordinates)
    assert [event.name for event in result.events] == ["floor.hit", *["floor.leave"] * (part > 0.0)]
    time = 0.4 - 0.3037
    height = (1.0 + part) * time - (5.0 * time**2 if part else 0.0)
    np.testing.assert_allclose(result["b.y"], [0.0, height], rtol=0, atol=1e-12)
    assert result["lost"][-1] == pytest.approx(1.0 - part**2, abs=1e-12)
    assert result.energy_drift_max < 1e-12


@pytest.mark.parametrize("steps", STEPS, ids=NAMES)
def test_a_floor_that_stops_at_once_throws(steps: dict[str, Any]) -> None:
    """It takes the ball along at 2 m/s up to 0.1037 s."""
    text = FLOOR.replace("0.5*t", "2*min(t, 0.1037)").replace("0.3]", "0.0]\nvelocity = [0.0, 2.0]")
    result = simulate(text, steps, parameters={"part": 0.0}, until=0.3, times=[0.1, 0.3])
    assert [event.name for event in result.events] == ["floor.leave"]
    np.testing.assert_allclose(result["b.y"], [0.2, 0.2074 + 2 * 0.1963 - 5 * 0.1963**2], rtol=0, atol=1e-11)


@pytest.mark.by_turns(2)
@pytest.mark.slow
def test_rows_have_floors_that_start_at_once() -> None:
    text = FLOOR.replace("0.5*t", "max(0, t - begin)").replace("0.3]", "0.0]")
    model = symgen.load(described(text.replace("part = 1.0", "part = 0.9\nbegin = 0.2")))
    for steps in ({"integrator": "dop853", "rtol": 1e-10}, {"integrator": "rk4", "step": 1e-2}):
        settings: dict[str, Any] = {"until": 0.35, "times": [0.35], **steps}
        rows = model.sweep({"begin": [0.2, 0.3037]}, quantities=("b.y", "b.vy", "lost"), **settings)
        for i, begin in enumerate((0.2, 0.3037)):
            alone = model.simulate(parameters={"begin": begin}, verify=False, **settings)
            assert rows.status[i] == alone.status == "ok" and len(alone.events) == 2
            for name in ("b.y", "b.vy", "lost"):
                assert rows[name][i].tolist() == alone[name].tolist()


INPUT = FLOOR.replace('"b.y - 0.5*t"', '"b.y - height"') + '[inputs.height]\nunit = "m"\ndefault = 0.0\n'


@pytest.mark.fast("0.5*t-dop853", "0.5*t-radau5")
@pytest.mark.parametrize("steps", STEPS, ids=NAMES)
@pytest.mark.parametrize("given", ["0.5*t", ([0.0, 0.1, 1.0], [0.0, 0.05, 0.5])])
def test_an_input_moves_a_floor(given: Any, steps: dict[str, Any]) -> None:
    """As a formula, and as data."""
    for part in (1.0, 0.5, 0.0):
        settings: dict[str, Any] = {"parameters": {"part": part}, "until": 0.25, "times": [0.25]}
        found = simulate(INPUT, steps, inputs={"height": given}, **settings)
        assert found["b.vy"][-1] == pytest.approx(0.5 + 2.5 * part - (0.5 if part else 0.0), abs=1e-10)
        assert found["lost"][-1] == pytest.approx(6.25 * (1.0 - part**2), abs=1e-10)
        assert found.energy_drift_max < 1e-11


def test_inputs_of_gaps_do_not_jump() -> None:
    model = symgen.load(described(INPUT))
    held = {"height": {"t": [0.0, 0.1], "u": [0.0, 0.1], "interpolation": "hold"}}
    for inputs in (held, {"height": "0.1*b.vy"}, {"height": "b.y/2"}):
        with pytest.raises(InputError, match="as gaps read height"):
            model.simulate(until=0.1, inputs=inputs)
    sim = model.start(integrator="rk4", step=0.01)
    with pytest.raises(InputError, match="an input that moves no stop"):
        sim.set(height=0.1)
    sim.step(0.1)
    assert sim["b.y"] == pytest.approx(0.25, abs=1e-12)


@pytest.mark.slow
def test_an_input_that_starts_a_floor_at_once_strikes() -> None:
    text = INPUT.replace("0.3]", "0.0]")
    for given in ("max(0, t - 0.3037)", "t - 0.3037 if t > 0.3037 else 0", ([0.0, 0.3037, 1.0], [0.0, 0.0, 0.6963])):
        for steps in STEPS:
            result = simulate(text, steps, inputs={"height": given}, until=0.4, times=[0.4])
            time = 0.4 - 0.3037
            assert result["b.y"][-1] == pytest.approx(2.0 * time - 5.0 * time**2, abs=1e-12), (given, steps)
