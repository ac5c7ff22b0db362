"""Dry friction with constant bounds against closed forms and event-driven references."""

import copy
from functools import cache
from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from support.checks import assert_same_motion
from support.ending import Ending

import symgen
from symgen.base.errors import InputError
from symgen.base.settings import Settings
from symgen.derive.methods import METHODS
from symgen.describe.files.load import parse_toml, read_raw
from symgen.describe.files.validate import validate
from symgen.describe.mechanism import Mechanism
from symgen.run.integrators import INTEGRATORS
from symgen.run.planning.plan import Purpose
from symgen.run.planning.prepare import Prepared, prepare

#: A mass of 1 kg at 1 m with a dry torque of 0.5 N m, from rest at 1 rad.
PIN = """
[mechanism]
name = "dry-pendulum"
gravity = [0.0, -9.81]

[bodies.bob]
mass = 1.0
inertia = 0.5
points = { pivot = [0.0, 1.0] }
angle = 1.0

[joints.pin]
type = "revolute"
between = ["ground", "bob"]
at = [[0.0, 0.0], "pivot"]
start = { angle = 1.0 }
friction = { sliding = 0.5 }
"""
#: Angles where it turns round, from the energy: (cos x - cos y) m g l = M |x - y|, at 30 digits; it rests at the last.
TURNS = (
    *(0.881250748295449, 0.766732151685371, 0.655609990293531, 0.547205606673427, 0.440950245643447),
    *(0.336353552604635, 0.23298085662412, 0.130436008136909, 0.0283477182464195),
)

BELT = """
[mechanism]
name = "belt-oscillator"

[bodies.belt]
mass = 1.0
inertia = 1.0
velocity = [0.1, 0.0]

[joints.rail]
type = "translational"
between = ["ground", "belt"]
at = [[0.0, 0.0], [0.0, 0.0]]
axis = [1.0, 0.0]

[joints.motor]
type = "driver"
joint = "rail"
value = "0.1*t"
"""
BLOCK = """
[bodies.NAME]
mass = 1.0
inertia = 1.0
velocity = [0.1, 0.0]

[joints.on_NAME]
type = "translational"
between = ["belt", "NAME"]
at = [[0.0, 0.0], [0.0, 0.0]]
axis = [1.0, 0.0]
friction = { static = STATIC, sliding = SLIDING }

[forces.spring_NAME]
type = "force"
body = "NAME"
force = ["FORCE", 0.0]
"""
#: Period, and duration of a slip, of a block of 1 kg on a spring of 100 N/m: static 6 N, sliding 4 N.
PERIOD, SLIDES, LOOSE = 0.8068887871591406, 0.4068887871591406, 0.6
#: Transitions of two blocks, ground - 100 N/m - a - 60 N/m - b, static 6 and 5 N, sliding 4 and 3 N, by matrix
#: exponentials with 34 digits: the first ones and the 39th.
TWO = (
    *((0.6, "on_a.slip"), (0.90788428598005780312, "on_a.stick"), (1.3078842859800578031, "on_a.slip")),
    *((1.5456694645680470859, "on_b.slip"), (1.6199173686982691934, "on_a.stick")),
    *((1.7641109426474493103, "on_a.slip"), (2.1072286814774374223, "on_a.stick")),
    (2.3224956946429597024, "on_b.stick"),
)
LAST_OF_TWO = 11.765884035763298434

WHEEL = """
[mechanism]
name = "dry-wheel"

[inputs]
torque = 0.0

[bodies.wheel]
mass = 1.0
inertia = 2.0

[joints.axle]
type = "revolute"
between = ["ground", "wheel"]
at = [[0.0, 0.0], "centre"]
friction = { static = 1.5, sliding = 1.0, viscous = 0.2 }

[forces.motor]
type = "torque"
body = "wheel"
torque = "torque"
"""

#: A block of 1 kg on a ramp; a coefficient of 0.5 times its constant normal force.
RAMP = """
[mechanism]
name = "ramp"
gravity = ["9.81*sin(slope)", "-9.81*cos(slope)"]

[parameters]
slope = 0.4

[bodies.block]
mass = 1.0
inertia = 1.0

[joints.ramp]
type = "translational"
between = ["ground", "block"]
at = [[0.0, 0.0], [0.0, 0.0]]
axis = [1.0, 0.0]
friction = { sliding = "0.5*9.81*cos(slope)" }
"""


@cache
def described(text: str) -> Mechanism:
    return validate(parse_toml(text, "file.toml"), "file.toml")


@cache
def blocks(*names: str) -> Mechanism:
    bounds = {"a": ("6.0", "4.0"), "b": ("5.0", "3.0")}
    forces = {"a": "-160*a.x + 60*b.x" if "b" in names else "-100*a.x", "b": "60*a.x - 60*b.x"}
    parts = [
        BLOCK.replace("NAME", name)
        .replace("STATIC", bounds[name][0])
        .replace("SLIDING", bounds[name][1])
        .replace("FORCE", forces[name])
        for name in names
    ]
    return described(BELT + "".join(parts))


@cache
def four_bar(torque: float) -> Mechanism:
    """Return the four-bar of the catalogue with the same dry torque in all of its pins."""
    raw, source = read_raw("four-bar")
    raw = copy.deepcopy(raw)
    for joint in raw["joints"].values():
        joint["friction"] = {"sliding": torque}
    return validate(raw, source)


def ready(mechanism: Mechanism, until: float, integrator: str = "dop853", **settings: Any) -> Prepared:
    steps = {"step": 4e-3} if integrator == "rk4" else {"rtol": 1e-12, "atol": 1e-12}
    return prepare(mechanism, Settings(integrator=integrator, until=until, verify=False, **steps | settings))


def changes(outcome: Any) -> list[tuple[float, str]]:
    return [(event.t, event.name) for event in outcome.happened]


@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
@pytest.mark.parametrize(
    ("integrator", "most"), [("dop853", 1e-11), ("picard", 1e-11), ("radau5", 1e-11), ("rk4", 1e-5)]
)
def test_a_pendulum_turns_round_and_rests_where_energies_say(integrator: str, most: float, coordinates: str) -> None:
    run = ready(described(PIN), 14.0, integrator, coordinates=coordinates)
    outcome = run.of_bodies(run.integrate())
    assert outcome.reason == ""
    assert [name for _, name in changes(outcome)] == ["pin.reverse"] * 8 + ["pin.stick"]
    place = [c.name for c in outcome.compiled.info.coordinates].index("bob.theta")
    signs = np.where(np.arange(9) % 2, 1.0, -1.0)
    at_events = [event.state[place] for event in outcome.happened]
    np.testing.assert_allclose(at_events, signs * TURNS, rtol=0, atol=most)
    assert abs(outcome.states[-1][place] + TURNS[-1]) < most


def test_at_rest_nothing_creeps() -> None:
    mechanism = described(PIN)
    ends = [ready(mechanism, until, "dop853").integrate().states[-1] for until in (14.0, 1000.0)]
    np.testing.assert_allclose(ends[1][2], ends[0][2], rtol=0, atol=1e-13)


@pytest.mark.slow_cases("dop853-1e-11")
@pytest.mark.parametrize(("integrator", "most"), [("dop853", 1e-11), ("picard", 1e-11), ("radau5", 1e-11)])
def test_a_block_on_a_belt_slips_and_sticks_with_its_period(integrator: str, most: float) -> None:
    count = 10
    outcome = ready(blocks("a"), count * PERIOD, integrator).integrate()
    times = [LOOSE + i * PERIOD + more for i in range(count) for more in (0.0, SLIDES)][:-1]
    assert [name for _, name in changes(outcome)] == (["on_a.slip", "on_a.stick"] * count)[:-1]
    np.testing.assert_allclose([t for t, _ in changes(outcome)], times, rtol=0, atol=most)
    assert outcome.energy_drift_max < 1e-9


@pytest.mark.slow
@pytest.mark.parametrize("integrator", ["dop853", "picard", "radau5"])
def test_a_hundred_periods_on_the_belt(integrator: str) -> None:
    outcome = ready(blocks("a"), 100 * PERIOD, integrator).integrate()
    times = [LOOSE + i * PERIOD + more for i in range(100) for more in (0.0, SLIDES)][:-1]
    np.testing.assert_allclose([t for t, _ in changes(outcome)], times, rtol=0, atol=1e-11)


def test_constant_steps_keep_their_order() -> None:
    errors = []
    for step in (1e-2, 5e-3, 2.5e-3):
        outcome = ready(blocks("a"), 5 * PERIOD, "rk4", step=step).integrate()
        times = [LOOSE + i * PERIOD + more for i in range(5) for more in (0.0, SLIDES)][:-1]
        errors.append(np.abs(np.array([t for t, _ in changes(outcome)]) - times).max())
    orders = np.log2(np.array(errors[:-1]) / errors[1:])
    assert ((orders > 3.8) & (orders < 4.2)).all()


@pytest.mark.slow
@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
def test_two_blocks_with_static_bounds_above_sliding(coordinates: str) -> None:
    outcome = ready(blocks("a", "b"), 11.8, coordinates=coordinates).integrate()
    found = changes(outcome)
    assert len(found) == 39
    assert [name for _, name in found[: len(TWO)]] == [name for _, name in TWO]
    np.testing.assert_allclose([t for t, _ in found[: len(TWO)]], [t for t, _ in TWO], rtol=0, atol=1e-11)
    assert found[-1][1] == "on_a.slip"
    assert abs(found[-1][0] - LAST_OF_TWO) < 1e-10


@pytest.mark.slow_cases("joint", "absolute")
@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
def test_dry_pins_of_a_four_bar(coordinates: str) -> None:
    """Four rows with one freedom: event-driven reference in minimal coordinates."""
    run = ready(four_bar(4.0), 23.0, coordinates=coordinates)
    outcome = run.of_bodies(run.integrate())
    assert outcome.reason == ""
    crank = np.array([(event.t, event.state[2]) for event in outcome.happened if event.name == "A.reverse"])
    assert len(crank) == 14
    np.testing.assert_allclose(crank[:3, 1], [-4.242432891245, -0.089570122007, -3.745894429012], rtol=0, atol=1e-10)
    assert abs(crank[0, 0] - 2.77380012222) < 1e-10
    rest = [event for event in outcome.happened if event.name == "A.stick"]
    assert [round(event.t, 8) for event in rest] == [21.49132611]
    assert abs(outcome.states[-1][2] + 2.07596285039) < 1e-10
    assert np.abs(outcome.states[-1][9:18]).max() < 1e-9


@pytest.mark.slow
def test_the_threshold_of_a_four_bar_at_rest() -> None:
    """Force along the crank -24.125 N m, rates 1, -1.188, 0.434, 0.246: 8.412707676783 N m in each pin hold it."""
    for torque, moves in ((8.5, False), (8.41270768, False), (8.41270767, True), (8.4, True)):
        outcome = ready(four_bar(torque), 0.5).integrate()
        angle = abs(outcome.states[-1][2] - outcome.states[0][2])  # 1e-8 N m turn the crank by some 1e-10 rad
        assert angle > 1e-12 if moves else angle < 1e-14
        assert not outcome.happened


def test_an_input_that_jumps_beyond_the_bound() -> None:
    """Torque 2 N m from 0.3 to 0.31 s against 1 N m in motion and 0.2 N m s: slips at 0.3 s, then comes to rest."""
    model = symgen.load(described(WHEEL))
    torque = "piecewise(t < 0.3, 0.5, t < 0.31, 2.0, 0.5)"
    result = model.simulate(
        until=1.0, inputs={"torque": torque}, integrator="dop853", rtol=1e-12, times=[0.2, 0.305, 1.0]
    )
    fast = 5.0 * (1.0 - np.exp(-0.1 * 0.01))
    rest = 0.31 + 10.0 * np.log((fast + 2.5) / 2.5)
    assert [event.name for event in result.events] == ["axle.slip", "axle.stick"]
    np.testing.assert_allclose([event.t for event in result.events], [0.3, rest], rtol=0, atol=1e-11)
    np.testing.assert_array_equal(result.outputs["axle.mode"], [0.0, 1.0, 0.0])
    rate = 5.0 * (1.0 - np.exp(-0.1 * 0.005))
    np.testing.assert_allclose(result.outputs["axle.force"], [-0.5, -1.0 - 0.2 * rate, -0.5], rtol=1e-9)


def test_inputs_of_steps_change_modes() -> None:
    run = symgen.load(described(WHEEL)).start(integrator="dop853", step=0.01)
    for _ in range(30):
        run.step(0.01, {"torque": 0.5})
    assert run.v["wheel.omega"] == 0.0
    run.step(0.01, {"torque": 2.0})
    assert abs(run.v["wheel.omega"] - 5.0 * (1.0 - np.exp(-0.1 * 0.01))) < 1e-9
    for _ in range(30):
        run.step(0.01, {"torque": 0.5})
    assert [event.name for event in run.events] == ["axle.slip", "axle.stick"]
    assert abs(run.events[0].t - 0.3) < 1e-14


def test_the_critical_angle_of_a_ramp() -> None:
    critical = float(np.arctan(0.5))
    for slope, moves in ((critical - 1e-9, False), (critical + 1e-9, True)):
        outcome = ready(described(RAMP), 1.0, parameters={"slope": slope}).integrate()
        assert (outcome.states[-1][0] != 0.0) == moves


def test_parameters_that_are_set_change_modes() -> None:
    run = symgen.load(described(RAMP)).start(integrator="dop853", step=0.01)
    run.step(0.01)
    run.set(slope=0.5)
    run.step(0.01)
    down = 9.81 * (np.sin(0.5) - 0.5 * np.cos(0.5)) * 0.01
    assert abs(run.v["block.vx"] - down) < 1e-12
    assert [event.name for event in run.events] == ["ramp.slip"]


#: Methods with other integrators than dop853, their settings, and the accuracy that they reach.
OTHERS: dict[str, tuple[str, dict[str, float], float]] = {
    "braun-goldfarb": ("rk4", {"step": 2e-3}, 1e-6),
    "generalized-alpha": ("generalized-alpha", {"step": 2e-3}, 1e-5),
    "ggl": ("radau5", {"rtol": 1e-10, "atol": 1e-10}, 1e-9),
    "half-explicit": ("half-explicit", {"step": 2e-3}, 0.0),
    "implicit-constraint": ("symplectic-euler", {"step": 2e-3}, 0.0),
    "index3-augmented-lagrangian": ("trapezoidal", {"step": 2e-3}, 0.0),
    "penalty": ("rk4", {"step": 1e-3}, 1e-6),
    "rattle": ("rattle", {"step": 2e-3}, 0.0),
    "discrete-gradient": ("discrete-gradient", {"step": 2e-3}, 0.0),
    "symmetric-projection": ("gauss", {"step": 2e-3}, 1e-9),
}


@pytest.mark.by_turns(3)
@pytest.mark.slow_cases(
    "generalized-alpha",
    "implicit-constraint",
    "null-space",
    "coordinate-partitioning",
    "symmetric-projection",
    "dependent-correction",
)
@pytest.mark.parametrize("method", METHODS.names)
def test_every_method_finds_the_rest_angle_or_says_why_not(method: str) -> None:
    integrator, steps, most = OTHERS.get(method, ("dop853", {"rtol": 1e-12, "atol": 1e-12}, 1e-9))
    settings = Settings(method=method, integrator=integrator, until=14.0, verify=False, coordinates="absolute", **steps)
    try:
        outcome = prepare(described(PIN), settings).integrate()
    except InputError as error:
        assert "where rows may be off" in str(error)
        return
    if outcome.reason:
        assert "max_violation" in outcome.reason
    else:
        assert [event.name for event in outcome.happened] == ["pin.reverse"] * 8 + ["pin.stick"]
        assert abs(outcome.states[-1][2] + TURNS[-1]) < most


@cache
def rest_by_the_reaction() -> tuple[int, float]:
    """Return how often a pendulum with mu r of 0.1 m turns round, and where it rests, from its angle alone."""

    def rates(_: float, y: np.ndarray, sign: float) -> list[float]:
        torque = 0.0
        for _ in range(60):
            alpha = (-9.81 * np.sin(y[0]) - sign * torque) / 1.5
            torque = 0.1 * np.hypot(y[1] ** 2 + 9.81 * np.cos(y[0]), alpha + 9.81 * np.sin(y[0]))
        return [y[1], alpha]

    def stops(_: float, y: np.ndarray, sign: float) -> float:
        return sign * y[1]

    angle, turns = 1.0, 0
    while True:
        sign = -np.sign(angle)
        if sign * rates(0.0, np.array([angle, 0.0]), sign)[1] <= 0.0:
            return turns, angle
        swing = solve_ivp(
            rates,
            (0.0, 9.0),
            [angle, 0.0],
            method="DOP853",
            events=Ending(stops, -1.0),
            args=(sign,),
            rtol=1e-12,
            atol=1e-13,
        )
        angle, turns = swing.y[0, -1], turns + 1


@pytest.mark.by_turns(3)
@pytest.mark.slow_cases(
    "coordinate-partitioning",
    "adaptive-baumgarte",
    "generalized-alpha",
    "implicit-constraint",
    "symmetric-projection",
    "baumgarte",
    "dependent-correction",
)
@pytest.mark.parametrize("method", METHODS.names)
def test_every_method_rests_by_the_reaction_or_says_why_not(method: str) -> None:
    integrator, steps, most = OTHERS.get(method, ("dop853", {"rtol": 1e-12, "atol": 1e-12}, 1e-9))
    settings = Settings(method=method, integrator=integrator, until=9.0, verify=False, coordinates="absolute", **steps)
    mechanism = described(PIN.replace("sliding = 0.5", "coefficient = 0.5, radius = 0.2"))
    try:
        outcome = prepare(mechanism, settings).integrate()
    except InputError as error:
        assert str(error).startswith(f"method '{method}': expected one that ")
        return
    if outcome.reason:
        assert "max_violation" in outcome.reason
        return
    turns, angle = rest_by_the_reaction()
    assert [event.name for event in outcome.happened] == ["pin.reverse"] * (turns - 1) + ["pin.stick"]
    assert abs(outcome.states[-1][2] - angle) < most


@pytest.mark.by_turns(4)
@pytest.mark.fast("discrete-gradient", "dopri5", "euler", "half-explicit", "picard", "rk4")
@pytest.mark.parametrize("integrator", INTEGRATORS.names)
def test_every_integrator_turns_round(integrator: str) -> None:
    method = integrator if integrator in METHODS.names else "direct-correction"
    method = {"phem56": "half-explicit", "gauss": "symmetric-projection"}.get(integrator, method)
    try:
        outcome = prepare(
            described(PIN),
            Settings(method=method, integrator=integrator, until=3.5, step=2e-3, verify=False, coordinates="absolute"),
        ).integrate()
    except InputError as error:
        assert "where rows may be off" in str(error)
        return
    assert outcome.reason == ""
    signs = np.array([-1.0, 1.0, -1.0])
    at_events = [event.state[2] for event in outcome.happened]
    assert len(at_events) == 2
    np.testing.assert_allclose(at_events, (signs * TURNS[:3])[:2], rtol=0, atol=3e-2)


@pytest.mark.by_turns(2)
@pytest.mark.slow
@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
def test_rows_of_a_sweep_have_the_bits_of_single_runs(coordinates: str) -> None:
    text = PIN.replace("[bodies.bob]", "[parameters]\ntorque = 0.5\n\n[bodies.bob]").replace("= 0.5 }", '= "torque" }')
    model, torques = symgen.load(described(text)), (0.4, 0.5, 0.7)
    settings = {"integrator": "dop853", "until": 12.0, "coordinates": coordinates, "times": [12.0]}
    rows = model.sweep({"torque": list(torques)}, **settings)["bob.theta"][:, -1]
    alone = [model.simulate(parameters={"torque": x}, verify=False, **settings).q["bob.theta"][-1] for x in torques]
    assert rows.tolist() == alone


@pytest.mark.by_turns(2)
@pytest.mark.slow
@pytest.mark.parametrize("integrator", ["dop853", "picard"])
def test_rows_of_a_sweep_choose_modes_in_compiled_loops(integrator: str) -> None:
    """Four dry pins that break loose, turn round and rest: each row has the bits of one."""
    raw, source = read_raw("four-bar")
    raw["parameters"]["grip"] = 4.0
    for pin in "ABCD":
        raw["joints"][pin]["friction"] = {"sliding": "grip", "static": "1.1*grip"}
    model, grips = symgen.Model(validate(raw, source)), (2.0, 4.0, 8.5)
    settings = {"integrator": integrator, "until": 12.0, "times": [3.0, 12.0], "coordinates": "absolute"}
    names = ("crank.theta", "A.mode", "D.force")
    alone = [model.simulate(parameters={"grip": x}, verify=False, **settings) for x in grips]
    assert [len(run.events) > 10 for run in alone] == [True, True, False]
    rows = model.sweep({"grip": list(grips)}, quantities=names, **settings)
    for i, run in enumerate(alone):
        assert rows["crank.theta"][i].tolist() == run["crank.theta"].tolist()
        assert rows["A.mode"][i].tolist() == run["A.mode"].tolist()
        np.testing.assert_allclose(rows["D.force"][i], run["D.force"], rtol=1e-12)


#: An input that jumps at the start, at an output, between outputs, and at the end of a run over 1 s.
_JUMPS = "piecewise(t < 0.05, late, t < 0.3, 0.5, t < 0.3 + late, 2.0, t < 1.0, 0.5, 3.0)"


@pytest.mark.by_turns(3)
@pytest.mark.slow
@pytest.mark.parametrize(
    ("integrator", "coordinates"), [("dop853", "absolute"), ("rk4", "absolute"), ("picard", "joint")]
)
def test_rows_choose_modes_where_inputs_jump(integrator: str, coordinates: str) -> None:
    """In the compiled loop: the numbers of single runs, and the instant of rest of a closed form."""
    text = WHEEL.replace("[bodies.wheel]", "[parameters]\nlate = 0.01\nrub = 1.0\n\n[bodies.wheel]")
    model, lates = symgen.load(described(text.replace("sliding = 1.0", 'sliding = "rub"'))), (0.01, 0.021, 1.7)
    settings = {"integrator": integrator, "until": 1.0, "inputs": {"torque": _JUMPS}, "coordinates": coordinates}
    settings |= (
        {"times": [0.0, 0.3, 0.305, 0.5, 1.0], "step": 1e-2} if integrator != "picard" else {"times": [0.3, 1.0]}
    )
    names = ("wheel.theta", "axle.angle", "wheel.omega", "wheel.alpha", "axle.mode", "axle.force")
    alone = [[model.simulate(parameters={"late": x, "rub": rub}, verify=False, **settings) for rub in (1.0, 0.7)]
             for x in lates]  # fmt: skip
    rows = model.sweep({"late": list(lates), "rub": [1.0, 0.7]}, quantities=names, **settings)
    assert {str(x) for x in rows.status.ravel()} <= {run.status for one in alone for run in one}
    for i, j in np.ndindex(3, 2):
        run = alone[i][j]
        assert {"axle.slip", "axle.stick"} >= {event.name for event in run.events} >= {"axle.slip"}
        for name in names:
            assert_same_motion(rows[name][i, j], run[name], name)
        assert rows["wheel.theta"][i, j].tolist() == run["wheel.theta"].tolist()
        assert [rows[x][i, j] for x in ("steps", "evaluations")] == [run.steps, run.evaluations]
    if integrator == "dop853":  # 2 N m from 0.3 to 0.31 s against 1 N m and 0.2 N m s
        fast = 5.0 * (1.0 - np.exp(-0.1 * 0.01))
        rest = 10.0 * np.log((fast + 2.5) / 2.5)
        turn = 5.0 * 0.01 - 10.0 * fast + 10.0 * (fast + 2.5) * (1.0 - np.exp(-0.1 * rest)) - 2.5 * rest
        assert abs(rows["wheel.theta"][0, 0, -1] - turn) < 1e-9


def test_a_run_goes_on_from_the_last_state_of_another() -> None:
    model = symgen.load(described(PIN))
    settings = {"integrator": "dop853", "rtol": 1e-11, "verify": False, "coordinates": "absolute"}
    whole = model.simulate(until=5.0, times=[5.0], **settings)
    first = model.simulate(until=3.0, times=[3.0], **settings)
    second = model.simulate(until=5.0, times=[5.0], start=first, **settings)
    assert abs(second.q["bob.theta"][-1] - whole.q["bob.theta"][-1]) < 1e-11
    assert [event.name for event in (*first.events, *second.events)] == [event.name for event in whole.events]


def test_a_stribeck_curve_and_viscous_friction() -> None:
    """The speed of a wheel under a constant torque is where torque and friction agree."""
    keys = "friction = { static = 1.5, sliding = 1.0, viscous = 0.2, stribeck_speed = 2.0 }"
    text = WHEEL.replace("friction = { static = 1.5, sliding = 1.0, viscous = 0.2 }", keys)
    model = symgen.load(described(text))
    settings = {"until": 400.0, "times": [400.0], "integrator": "dop853", "rtol": 1e-11, "atol": 1e-12}
    fast = model.simulate(inputs={"torque": 2.0}, **settings).v["wheel.omega"][-1]
    assert abs(1.0 + 0.5 * np.exp(-((fast / 2.0) ** 2)) + 0.2 * fast - 2.0) < 1e-9
    assert model.simulate(inputs={"torque": 1.49}, **settings).v["wheel.omega"][-1] == 0.0


def test_a_reset_has_no_impulse_of_friction() -> None:
    """A stop of half a wheel's speed: friction, at rest or not, takes no part in it; behind it modes are new."""
    event = '\n[events.kick]\nwhen = "t > 0.5"\nreset = { "wheel.omega" = 1.0 }\n'
    model = symgen.load(described(WHEEL + event))
    result = model.simulate(until=9.0, integrator="dop853", rtol=1e-12, times=[0.7, 9.0])
    assert [event.name for event in result.events] == ["kick", "axle.slip", "axle.stick"]
    assert abs(result.v["wheel.omega"][0] - (6.0 * np.exp(-0.1 * 0.2) - 5.0)) < 1e-10
    assert abs(result.events[2].t - (0.5 + 10.0 * np.log(6.0 / 5.0))) < 1e-10


def test_inspect_shows_rows_with_bounds() -> None:
    facts = symgen.load(blocks("a")).inspect().facts
    assert facts["friction"] == [
        {
            **{"name": "on_a", "row": "on_a.friction", "unit": "N", "static": "6.0", "sliding": "4.0"},
            **{"viscous": "0.0", "stribeck_speed": None, "reaction": [], "jamming_number": None},
        }
    ]


@pytest.mark.slow
def test_starts_are_those_without_friction() -> None:
    """Rows at rest are off while a mechanism is closed and its velocities are completed."""
    raw, source = read_raw("four-bar")
    raw = copy.deepcopy(raw)
    raw["bodies"]["crank"]["angular_velocity"] = 0.7
    raw["bodies"]["coupler"]["angle"] = 0.3
    plain = prepare(validate(raw, source), Settings(until=1.0), Purpose.STATE).start
    for joint in raw["joints"].values():
        joint["friction"] = {"sliding": 4.0}
    dry = prepare(validate(raw, source), Settings(until=1.0), Purpose.STATE).start
    np.testing.assert_allclose(dry.y, plain.y, rtol=0, atol=1e-13)
    held = prepare(validate(raw, source), Settings(until=1.0, start={"A.angle": 1.0}), Purpose.STATE).start
    assert abs(held.y[2] - 1.0) < 1e-12
