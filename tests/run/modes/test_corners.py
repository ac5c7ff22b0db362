"""Corners of gaps, where abs, min, max or a condition changes its piece while a stop is closed: closed forms decide."""

import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import symgen
from tests.result.targets.test_c_modes import loaded, program_of, rows_of, transitions_of
from tests.result.targets.test_fmu import fmu_of, simulated

#: A yo-yo: its string of 0.8 m is wound on an axle of 10 mm, and winds up the other way below.
YO_YO = """
[mechanism]
name = "yo-yo"
gravity = [0.0, -9.81]
[run]
until = 1.5
[bodies.disc]
mass = 0.05
inertia = 2e-5
hold = true
position = [0.0, 0.0]
angle = 0.0
velocity = [0.0, -0.1]
angular_velocity = 10.0
[joints.rail]
type = "rows"
rows = [{ position = "disc.x" }]
[stops.string]
gap = "disc.y + 0.8 - abs(0.01*disc.theta - 0.8)"
"""
#: When the string is unwound; it falls with an effective mass of m + I / r^2 = 5 m.
G, FALL = 9.81, 9.81 / 5.0
UNWOUND = (-0.1 + math.sqrt(0.01 + 2.0 * FALL * 0.8)) / FALL
#: The impact takes what both ends of the string share: 4 / 5 of the mirrored rate would be 1, less 1 / 5.
REBOUND = 0.6 * (0.1 + FALL * UNWOUND)
HEIGHT = -0.8 + REBOUND * (1.5 - UNWOUND) - 0.5 * FALL * (1.5 - UNWOUND) ** 2

#: A block on a floor that becomes a ramp, or ends at an edge, at x = 1.
BLOCK = """
[mechanism]
name = "block"
gravity = [0.0, -9.81]
[run]
until = {until}
[bodies.b]
type = "point"
mass = 2.0
velocity = [2.0, 0.0]
[stops.floor]
gap = "{gap}"
restitution = {restitution}
"""
RAMPS = "b.y - max(0, b.x - 1)", "b.y - ((b.x - 1) if b.x > 1 else 0)"
EDGES = "b.y + max(0, b.x - 1)", "b.y + ((b.x - 1) if b.x > 1 else 0)", "b.y - min(0, 1 - b.x)"
#: When it is back at the foot of the ramp, or lands on the slope past the edge.
BACK = 0.5 + 4.0 / G

INTEGRATORS = {
    "dop853": {"integrator": "dop853"},
    "picard": {"integrator": "picard"},
    "radau5": {"integrator": "radau5"},
    "rk4": {"integrator": "rk4", "step": 1e-3},
}
WAYS = [(i, c) for c in ("absolute", "joint") for i in INTEGRATORS]
ways = pytest.mark.parametrize(("integrator", "coordinates"), WAYS, ids=[f"{i}-{c}" for i, c in WAYS])


def block(gap: str, until: float, restitution: float = 0.0) -> str:
    return BLOCK.format(gap=gap, until=until, restitution=restitution)


def simulated_by(model: symgen.Model, integrator: str, coordinates: str, **settings: Any) -> symgen.Result:
    result = model.simulate(coordinates=coordinates, verify=False, **INTEGRATORS[integrator], **settings)
    assert result.ok, result.reason
    return result


def names(result: symgen.Result) -> list[str]:
    return [event.name.rpartition(".")[2] for event in result.events]


@pytest.mark.slow
def test_a_yo_yo_jerks_where_its_string_is_unwound(tmp_path: Path) -> None:
    model = loaded(YO_YO, tmp_path)
    for integrator in ("dop853", "picard"):
        result = simulated_by(model, integrator, "absolute")
        (hit,) = result.events
        assert hit.name == "string.hit" and abs(hit.t - UNWOUND) < 1e-12
        assert abs(hit.v_after["disc.vy"] - REBOUND) < 1e-10
        assert abs(result["disc.y"][-1] - HEIGHT) < 1e-10
    assert abs(UNWOUND - 0.853516078568) < 1e-12 and abs(HEIGHT + 0.521650916668) < 1e-12


@pytest.mark.slow
@ways
@pytest.mark.parametrize("rtol", [1e-6, 1e-8, 1e-11])
def test_a_yo_yo_by_every_integrator(integrator: str, coordinates: str, rtol: float, tmp_path: Path) -> None:
    tolerance = {} if integrator == "rk4" else {"rtol": rtol}
    result = simulated_by(loaded(YO_YO, tmp_path), integrator, coordinates, **tolerance)
    assert [event.name for event in result.events] == ["string.hit"]
    assert abs(result["disc.y"][-1] - HEIGHT) < 1e-9


@pytest.mark.slow
def test_a_yo_yo_by_default_and_by_other_methods(tmp_path: Path) -> None:
    model = loaded(YO_YO, tmp_path)
    result = model.simulate()
    assert result.status == "ok" and abs(result["disc.y"][-1] - HEIGHT) < 1e-10
    for method in ("lagrange", "null-space", "coordinate-partitioning", "udwadia-kalaba", "baumgarte"):
        result = model.simulate(method=method, integrator="dop853", verify=False)
        assert result.ok and abs(result["disc.y"][-1] - HEIGHT) < 1e-8, method


@pytest.mark.by_turns(2)
@pytest.mark.slow
def test_a_yo_yo_from_every_angle(tmp_path: Path) -> None:
    sweep = loaded(YO_YO, tmp_path).sweep(vary={"disc.theta": np.linspace(0.0, 5.0, 301)})
    assert {str(status) for status in sweep.status} == {"ok"}


@pytest.mark.by_turns(3)
@pytest.mark.slow
@ways
def test_a_block_meets_a_ramp_and_comes_back(integrator: str, coordinates: str, tmp_path: Path) -> None:
    for gap in RAMPS:
        result = simulated_by(loaded(block(gap, 1.5), tmp_path), integrator, coordinates)
        assert names(result) == ["hit", "hit"]
        np.testing.assert_allclose([event.t for event in result.events], [0.5, BACK], rtol=0, atol=1e-10)
        assert abs(result["b.x"][-1] - (1.0 - (1.5 - BACK))) < 1e-9


@pytest.mark.by_turns(3)
@pytest.mark.slow
@ways
def test_a_block_flies_off_an_edge_and_lands(integrator: str, coordinates: str, tmp_path: Path) -> None:
    for gap in EDGES:
        result = simulated_by(loaded(block(gap, 0.8), tmp_path), integrator, coordinates)
        assert names(result) == ["leave"] and abs(result.events[0].t - 0.5) < 1e-10
        assert abs(result["b.y"][-1] + 0.44145) < 1e-9
        result = simulated_by(loaded(block(gap, 1.2), tmp_path), integrator, coordinates)
        assert names(result) == ["leave", "hit", "rest"] and abs(result.events[1].t - BACK) < 1e-9


@pytest.mark.slow
@ways
def test_a_start_on_a_corner(integrator: str, coordinates: str, tmp_path: Path) -> None:
    result = simulated_by(loaded(block("b.y - max(0, b.x)", 1.5), tmp_path), integrator, coordinates)
    np.testing.assert_allclose([event.t for event in result.events], [0.0, BACK - 0.5], rtol=0, atol=1e-10)
    assert names(result) == ["hit", "hit"] and abs(result["b.x"][-1] + 1.5 - (BACK - 0.5)) < 1e-9


@pytest.mark.slow
@pytest.mark.parametrize("integrator", INTEGRATORS)
@pytest.mark.parametrize(("slope", "restitution", "count"), [(1.0, 0.5, 53), (20.0, 0.0, 2), (20.0, 0.5, 30)])
def test_ramps_with_rebound(integrator: str, slope: float, restitution: float, count: int, tmp_path: Path) -> None:
    until = 1.2 if slope == 1.0 else 0.9
    gap = f"b.y - {slope}*max(0, b.x - 1)"
    result = simulated_by(loaded(block(gap, until, restitution), tmp_path), integrator, "absolute")
    assert len(result.events) == count and abs(result.events[0].t - 0.5) < 1e-10


@pytest.mark.slow
def test_several_corners_in_one_gap(tmp_path: Path) -> None:
    text = block("b.y - 0.2*max(0, b.x - 1) + 0.05*max(0, b.x - 1.5) + 0.3*max(0, b.x - 2)", 0.815)
    result = loaded(text, tmp_path).simulate(integrator="dop853", verify=False)
    assert result.ok and names(result) == ["hit", "leave"]
    assert abs(result.events[0].v_after["b.vx"] - 2.0 / 1.04) < 1e-10
    # past 1.5 the slope is 0.15, which is less steep than 0.2: it flies with the rates that it has there
    rate = math.sqrt((2.0 / 1.04) ** 2 - 2.0 * 0.5 * 0.2 * G / 1.04)
    assert abs(result.events[1].v["b.vx"] - rate) < 1e-9 and abs(result["b.vx"][-1] - rate) < 1e-9


@pytest.mark.by_turns(12)
@pytest.mark.slow
@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
@pytest.mark.parametrize("integrator", ["dop853", "picard", "rk4"])
def test_rows_of_a_sweep_are_single_runs(integrator: str, coordinates: str, tmp_path: Path) -> None:
    for text, vary, column in (
        (YO_YO, ("disc.theta", np.linspace(0.0, 4.0, 5)), "disc.y"),
        (block(RAMPS[0], 1.5), ("b.vx", np.linspace(1.9, 2.1, 5)), "b.x"),
        (block(EDGES[0], 1.2), ("b.vx", np.linspace(1.9, 2.1, 5)), "b.y"),
    ):
        model, (name, values) = loaded(text, tmp_path), vary
        settings = {**INTEGRATORS[integrator], "coordinates": coordinates}
        table = model.sweep(vary={name: values}, **settings).to_dataframe()
        (key,) = [key for key in table.columns if key.startswith(column)]
        single = [model.simulate(verify=False, start={name: float(x)}, **settings)[column][-1] for x in values]
        assert table[key].tolist() == single


@pytest.mark.slow
@pytest.mark.parametrize("integrator", ["dop853", "picard", "rk4"])
def test_steps_from_python(integrator: str, tmp_path: Path) -> None:
    run = loaded(YO_YO, tmp_path).start(**INTEGRATORS[integrator])
    for _ in range(100):
        run.step(0.015)
    assert abs(run.q["disc.y"] - HEIGHT) < 1e-9


@pytest.mark.by_turns(4)
@pytest.mark.slow
def test_c_passes_corners(tmp_path: Path) -> None:
    model = loaded(YO_YO, tmp_path)
    for folder, keys in (("steps", {}), ("run", {"integrator": "dop853"})):
        program = program_of(model, tmp_path / folder, **keys)
        rows, transitions = rows_of(program, 1.5, 0.005)
        assert [word for _, word in transitions] == ["string.hit"] and abs(transitions[0][0] - UNWOUND) < 1e-11
        assert abs(rows[-1, 2] - HEIGHT) < 1e-10
    cases = (RAMPS[0], ["hit", "hit"]), (EDGES[0], ["leave", "hit", "rest"]), ("b.y - max(0, b.x)", ["hit", "hit"])
    for number, (gap, expected) in enumerate(cases):
        model = loaded(block(gap, 1.5), tmp_path)
        program = program_of(model, tmp_path / str(number))
        _, transitions = rows_of(program, 1.5, 0.005)
        assert [word.rpartition(".")[2] for _, word in transitions] == expected
        assert transitions_of(model.simulate(integrator="rk4", step=0.005, verify=False))[0][1] == transitions[0][1]


@pytest.mark.by_turns(2)
@pytest.mark.slow
def test_an_fmu_passes_corners(tmp_path: Path) -> None:
    model = loaded(YO_YO, tmp_path)
    path = fmu_of(model, tmp_path / "yo_yo.fmu")
    for kind, most in (("CoSimulation", 1e-9), ("ModelExchange", 1e-6)):
        result = simulated(path, kind, 1.5, step=0.005)
        assert abs(result["disc.y"][-1] - HEIGHT) < most, kind


@pytest.mark.by_turns(2)
@pytest.mark.slow
def test_smooth_gaps_have_no_code_for_corners(tmp_path: Path) -> None:
    for gap, word in (("b.y - 0.1*sin(b.x)", False), (RAMPS[0], False), (EDGES[0], True)):
        folder = tmp_path / f"{word}{len(gap)}"
        folder.mkdir()
        loaded(block(gap, 1.5), folder).generate(folder / "c", target="c")
        assert ("corner" in (folder / "c" / "block.c").read_text()) == word


@pytest.mark.slow
@pytest.mark.parametrize(
    ("gap", "until", "column"), [(RAMPS[0], 1.5, "b.x"), (EDGES[0], 0.8, "b.y"), (EDGES[0], 1.2, "b.y")]
)
def test_derivatives_through_corners(gap: str, until: float, column: str, tmp_path: Path) -> None:
    model = loaded(block(gap, until), tmp_path)
    settings: dict[str, Any] = {"integrator": "dop853", "verify": False}
    result = model.simulate(rtol=1e-11, sensitivities=["b.vx"], **settings)
    h = 1e-5
    ends = [model.simulate(rtol=1e-12, start={"b.vx": 2.0 + k * h}, **settings)[column][-1] for k in (1, -1)]
    forward = np.ravel(result.sensitivities.table("q"))[-2:][["b.x", "b.y"].index(column)]
    assert abs(forward - (ends[0] - ends[1]) / (2.0 * h)) < 1e-8
    gradient = model.gradient(column, by=["b.vx"], integrator="dop853", rtol=1e-11)
    assert abs(gradient.by["b.vx"] - forward) < 1e-8


#: A wheel that rests under friction while the kink of another body's force passes, and a floor's force that grows.
STUCK = """
[mechanism]
name = "wheel"
[run]
until = 2.0
[bodies.a]
mass = 1.0
inertia = 0.15
[joints.s]
type = "revolute"
between = ["ground", "a"]
at = [[0.0, 0.0], "centre"]
friction = { sliding = 3.0 }
[forces.motor]
type = "torque"
body = "a"
torque = "10*t - max(0, a.omega - 100)"
"""
LIFTED = """
[mechanism]
name = "ball"
gravity = [0.0, -9.81]
[run]
until = 1.5
[bodies.ball]
type = "point"
mass = 2.0
velocity = [1.0, 0.0]
[forces.lift]
type = "force"
body = "ball"
force = [0.0, "20*ball.x + max(ball.x, -1.0)"]
[stops.floor]
gap = "ball.y"
"""


@pytest.mark.slow
def test_kinks_of_forces_beside_modes(tmp_path: Path) -> None:
    for text, event, t in ((STUCK, "s.slip", 0.3), (LIFTED, "floor.leave", 2.0 * G / 21.0)):
        result = loaded(text, tmp_path).simulate(integrator="picard", verify=False)
        assert result.ok and result.steps < 40
        assert result.events[0].name == event and abs(result.events[0].t - t) < 1e-9


def test_a_gap_that_turns_sharply_without_a_corner_is_named(tmp_path: Path) -> None:
    text = YO_YO.replace("abs(0.01*disc.theta - 0.8)", "sqrt((0.01*disc.theta - 0.8)**2 + 1e-24)")
    result = loaded(text, tmp_path).simulate(integrator="dop853", verify=False)
    assert result.status == "failed"
    assert result.reason.startswith("the gap of string turns sharply at t = 0.8535")


def geneva() -> str:
    """Return a Geneva wheel with four slots: the walls are rounded segments, the crank turns at 2 rad/s."""
    start, pin, far, play, inner, radius = 4.0415926535897935, 0.1 * math.sqrt(0.5), 0.1, 0.0052, 0.02, 0.005
    length = 0.05071067811865476
    text = f"""
[mechanism]
name = "geneva"
gravity = [0.0, 0.0]
[run]
until = 10.0
[bodies.wheel]
mass = 0.5
inertia = 0.0005
angle = {math.pi / 4.0}
[bodies.crank]
mass = 0.1
inertia = 0.0001
position = [{far}, 0.0]
angle = {start}
[joints.W]
type = "revolute"
between = ["ground", "wheel"]
at = [[0.0, 0.0], [0.0, 0.0]]
friction = {{ sliding = 0.002 }}
[joints.C]
type = "revolute"
between = ["ground", "crank"]
at = [[{far}, 0.0], [0.0, 0.0]]
[joints.drive]
type = "driver"
joint = "C"
value = "{start} - 2.0*t"
"""
    x, y = f"({far} + {pin}*cos(crank.theta))", f"({pin}*sin(crank.theta))"
    u = f"({x}*cos(wheel.theta) + {y}*sin(wheel.theta))"
    v = f"({y}*cos(wheel.theta) - {x}*sin(wheel.theta))"
    for slot in range(4):
        c, s = math.cos(slot * math.pi / 2.0), math.sin(slot * math.pi / 2.0)
        for word, side in (("p", play), ("n", -play)):
            a, b = inner * c - side * s, inner * s + side * c
            along = f"min(max(({u} - {a})*{c} + ({v} - {b})*{s}, 0.0), {length})"
            gap = f"sqrt(({u} - {a} - {c}*{along})**2 + ({v} - {b} - {s}*{along})**2) - {radius}"
            text += f'[stops.s{slot}{word}]\ngap = "{gap}"\nrestitution = 0.3\n'
    return text


@pytest.mark.by_turns(2)
@pytest.mark.slow
@pytest.mark.parametrize(
    "settings", [{}, {"integrator": "radau5", "rtol": 1e-7, "verify": False}], ids=["own", "radau5"]
)
def test_a_geneva_wheel_misses_no_hit(settings: dict[str, Any], tmp_path: Path) -> None:
    result = loaded(geneva(), tmp_path).simulate(**settings)
    assert result.status == "ok"
    assert len(result.events) == 99 and abs(result["wheel.theta"][-1] - 6.7964906980) < 1e-9


def flanks(start: float, speed: float, turn: float) -> str:
    """A ball of 50 mm on a flank that ends at a corner, where a second one goes down, all turned by an angle.

    The ball flies off at the corner, as its weight does not bend its path as much as the corner does.
    """
    c, s = math.cos(turn), math.sin(turn)
    u = f"({c!r}*(ball.x - 0.37) + {s!r}*(ball.y + 0.21))"
    v = f"({c!r}*(ball.y + 0.21) - {s!r}*(ball.x - 0.37))"
    along = f"max(0.6*{u} - 0.8*{v}, 0)"
    return f"""
[mechanism]
name = "flanks"
gravity = [{G * s!r}, {-G * c!r}]
[run]
until = {0.05 - start / speed!r}
[bodies.ball]
type = "point"
mass = 0.3
position = [{0.37 + c * start - s * 0.05!r}, {-0.21 + s * start + c * 0.05!r}]
velocity = [{c * speed!r}, {s * speed!r}]
[stops.top]
gap = "sqrt(({u} - min({u}, 0))**2 + {v}**2) - 0.05"
restitution = 0.2
[stops.side]
gap = "sqrt(({u} - 0.6*{along})**2 + ({v} + 0.8*{along})**2) - 0.05"
restitution = 0.2
"""


@pytest.mark.by_turns(6)
@pytest.mark.slow
@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
@pytest.mark.parametrize(("start", "speed", "turn"), [(-0.31, 1.0, 0.3), (-0.7, 2.3, 1.1), (-0.4, 3.0, 0.2)])
def test_a_gap_that_is_touched_beside_a_closed_one_is_not_struck(
    start: float, speed: float, turn: float, coordinates: str, tmp_path: Path
) -> None:
    result = loaded(flanks(start, speed, turn), tmp_path).simulate(coordinates=coordinates, verify=False)
    c, s = math.cos(turn), math.sin(turn)
    assert result.status == "ok" and [event.name for event in result.events] == ["top.leave"]
    velocity = [c * speed + s * 0.05 * G, s * speed - c * 0.05 * G]
    np.testing.assert_allclose([result["ball.vx"][-1], result["ball.vy"][-1]], velocity, rtol=0, atol=1e-11)
