"""Dry friction whose bounds at rest and in motion differ forwards and backwards."""

from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.optimize import linprog

from symgen.base.errors import InputError
from tests.result.targets.test_c_modes import assert_same_run, loaded, program_of
from tests.result.targets.test_fmu import fmu_of, simulated
from tests.run.modes.test_static_sets import ENDS, PULL, five_bar

HEAD = '[mechanism]\nname = "{}"\ngravity = [0.0, 0.0]\n[parameters]\n{}\n'
WHEEL = (
    HEAD.format("wheel", "slope = 1.0")
    + """
[bodies.wheel]
mass = 1.0
inertia = 2.0
[joints.pin]
type = "revolute"
between = ["ground", "wheel"]
at = [[0.0, 0.0], "centre"]
friction = { sliding = { forwards = 2.0, backwards = 1.0 }, static = STATIC }
[forces.motor]
type = "torque"
body = "wheel"
torque = "slope*t"
"""
)
#: A block on a rail that a spring pulls to and fro: friction in motion and at rest [N], forwards and backwards.
SLIDES, HOLDS = (3.0, 1.0), (4.5, 3.5)
MASS, STIFFNESS, FREQUENCY, UNTIL = 1.5, 40.0, 2.3, 6.0
PULLED = (
    HEAD.format("pulled", "size = 0.4")
    + f"""
[bodies.block]
mass = {MASS}
inertia = 1.0
[joints.rail]
type = "translational"
between = ["ground", "block"]
at = [[0.0, 0.0], "centre"]
axis = [1.0, 0.0]
friction = {{ sliding = {{ forwards = {SLIDES[0]}, backwards = {SLIDES[1]} }}, static = STATIC }}
[forces.spring]
type = "force"
body = "block"
force = ["{STIFFNESS}*(size*sin({FREQUENCY}*t) - block.x)", 0.0]
"""
)
STATIC = f"{{ forwards = {HOLDS[0]}, backwards = {HOLDS[1]} }}"


def pull(t: float, x: float, size: float) -> float:
    return STIFFNESS * (size * np.sin(FREQUENCY * t) - x)


def pulled_block(size: float) -> tuple[float, list[float]]:
    """Return where the block is at the end, and when it breaks loose, from stick to slip by roots of SciPy."""
    t, state, slips = 0.0, np.zeros(2), list[float]()
    while t < UNTIL:
        ends = []
        for sign, most in ((1, HOLDS[0]), (-1, HOLDS[1])):

            def left(time: float, y: np.ndarray, sign: int = sign, most: float = most) -> float:
                return most - sign * pull(time, y[0], size)

            left.terminal, left.direction = True, -1
            ends.append(left)
        held = solve_ivp(lambda _, y: [0.0, 0.0], (t, UNTIL), state, events=ends, max_step=0.01, rtol=1e-12)
        if held.status == 0:
            return float(state[0]), slips
        t, sign = float(held.t[-1]), 1.0 if len(held.t_events[0]) else -1.0
        slips.append(t)
        while t < UNTIL:
            drag = SLIDES[0] if sign > 0.0 else -SLIDES[1]

            def rates(time: float, y: np.ndarray, drag: float = drag) -> list[float]:
                return [y[1], (pull(time, y[0], size) - drag) / MASS]

            def stops(time: float, y: np.ndarray, sign: float = sign) -> float:
                return float(sign * y[1]) if time > slips[-1] + 1e-7 else 1.0

            stops.terminal, stops.direction = True, -1
            slid = solve_ivp(rates, (t, UNTIL), state, events=[stops], rtol=1e-12, atol=1e-13, method="DOP853")
            t, state = float(slid.t[-1]), slid.y[:, -1]
            if slid.status == 0:
                return float(state[0]), slips
            state[1], force = 0.0, pull(t, float(state[0]), size)
            if -HOLDS[1] <= force <= HOLDS[0]:
                break
            sign = 1.0 if force > 0.0 else -1.0
            slips.append(t)
    return float(state[0]), slips


@pytest.mark.slow_cases("{ forwards = 5.0, backwards = 1.5 }-holds0-joint")
@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
@pytest.mark.parametrize(
    ("static", "holds"), [("{ forwards = 5.0, backwards = 1.5 }", (5.0, 1.5)), ("6.0", (6.0, 6.0))]
)
def test_a_wheel_breaks_loose_by_the_bound_of_its_way(
    static: str, holds: tuple[float, float], coordinates: str, tmp_path: Path
) -> None:
    model = loaded(WHEEL.replace("STATIC", static), tmp_path)
    for slope, breaks, slides in ((1.0, holds[0], 2.0), (-1.0, holds[1], -1.0)):
        result = model.simulate(parameters={"slope": slope}, until=10.0, coordinates=coordinates, rtol=1e-10)
        assert [(event.name, event.t) for event in result.events] == [("pin.slip", pytest.approx(breaks, abs=1e-12))]
        rate = (0.5 * slope * (100.0 - breaks**2) - slides * (10.0 - breaks)) / 2.0
        assert result["wheel.omega"][-1] == pytest.approx(rate, abs=1e-11)
        assert result.outputs["pin.force"][1] == pytest.approx(-slope * result.t[1], abs=1e-13)


def test_bounds_at_rest_below_those_in_motion_are_refused(tmp_path: Path) -> None:
    for static, expected in (
        ("1.5", r"friction\.static: expected a bound of at least that in motion \(2\.0\), got 1\.5"),
        ("{ forwards = 5.0, backwards = 0.5 }", r"friction\.static\.backwards: expected .* \(1\.0\), got 0\.5"),
    ):
        with pytest.raises(InputError, match=expected):
            loaded(WHEEL.replace("STATIC", static), tmp_path)
    with pytest.raises(InputError, match=r"friction\.static: expected one bound, as sliding has one"):
        text = WHEEL.replace("{ forwards = 2.0, backwards = 1.0 }", "1.0")
        loaded(text.replace("STATIC", "{ forwards = 2.0, backwards = 1.0 }"), tmp_path)
    text = WHEEL.replace("STATIC", '{ forwards = "3 - t", backwards = 2.0 }').replace("slope*t", "1.5*slope")
    failed = loaded(text, tmp_path).simulate(until=3.0)
    assert not failed.ok
    assert "got 1.5 at rest and 2 in motion" in failed.reason


def test_a_bound_at_rest_that_falls_lets_go_when_it_meets_the_load(tmp_path: Path) -> None:
    """Backwards 4 N m hold; forwards 6 - t fall to the load of 3.5 N m at 2.5 s."""
    text = WHEEL.replace("STATIC", '{ forwards = "6 - t", backwards = 4.0 }').replace("slope*t", "3.5*slope")
    (event,) = loaded(text, tmp_path).simulate(until=3.0).events
    assert (event.name, event.t) == ("pin.slip", pytest.approx(2.5, abs=1e-12))
    assert loaded(text, tmp_path).simulate(until=3.0, parameters={"slope": -1.0}).events == ()


@pytest.mark.slow
def test_a_block_to_and_fro_in_rows(tmp_path: Path) -> None:
    """Its bounds forwards are larger, so that it creeps backwards; rows of both coordinates beside SciPy's roots."""
    sizes = np.linspace(0.05, 0.9, 18)
    model = loaded(PULLED.replace("STATIC", STATIC), tmp_path)
    expected = [pulled_block(size)[0] for size in sizes]
    for coordinates in ("absolute", "joint"):
        rows = model.sweep(
            {"size": sizes}, until=UNTIL, times=[UNTIL], integrator="dop853", rtol=1e-11, atol=1e-12,
            coordinates=coordinates,
        )  # fmt: skip
        assert rows.counts["ok"] == len(sizes)
        np.testing.assert_allclose(rows["block.x"][:, -1], expected, rtol=0, atol=1e-8)


@pytest.mark.by_turns(4)
@pytest.mark.slow
def test_a_block_to_and_fro_in_c_in_an_fmu_and_step_by_step(tmp_path: Path) -> None:
    model = loaded(PULLED.replace("STATIC", STATIC), tmp_path)
    place, slips = pulled_block(0.4)
    transitions = assert_same_run(model, program_of(model, tmp_path / "c"), UNTIL, 2e-3)
    moves = [t for t, word in transitions if word in ("rail.slip", "rail.reverse")]
    np.testing.assert_allclose(moves, slips, rtol=0, atol=1e-6)
    run = model.start(integrator="dop853", rtol=1e-11, atol=1e-12)
    for _ in range(60):
        run.step(UNTIL / 60)
    assert run.q["block.x"] == pytest.approx(place, abs=1e-8)
    found = simulated(fmu_of(model, tmp_path / "block.fmu"), "ModelExchange", UNTIL, outputs=["block.x"])
    assert found["block.x"][-1] == pytest.approx(place, abs=1e-6)


@pytest.mark.slow
def test_derivatives_by_differences(tmp_path: Path) -> None:
    model = loaded(PULLED.replace("STATIC", STATIC), tmp_path)
    settings = {"integrator": "dop853", "rtol": 1e-11, "atol": 1e-12, "until": 2.0}
    exact = model.simulate(sensitivities=["size"], **settings).gradient("block.x").values[-1, 0]
    near = [model.simulate(parameters={"size": 0.4 + h}, **settings)["block.x"][-1] for h in (-1e-5, 1e-5)]
    assert exact == pytest.approx((near[1] - near[0]) / 2e-5, rel=1e-6)


@pytest.mark.by_turns(2)
@pytest.mark.slow
@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
def test_pins_share_bounds_of_both_ways(coordinates: str, tmp_path: Path) -> None:
    """A linkage holds as long as any forces within all bounds at rest do, whichever way each pin would turn."""
    generator = np.random.default_rng(8)
    turned = np.array([[-1.0, 1.0]]) * np.diff(ENDS, axis=0)[:, ::-1]
    rates = np.linalg.svd(turned.T)[2][2:].T
    pins = np.diff(np.vstack([np.zeros((1, 2)), rates, np.zeros((1, 2))]), axis=0)
    for _ in range(4):
        slides, holds = generator.uniform(0.2, 1.0, (2, 5)).round(3), generator.uniform(1.0, 3.0, (2, 5)).round(3)
        text = five_bar(np.arange(1.0, 6.0), 1.0)
        for i in range(5):
            bounds = [
                f"{{ forwards = {b[0][i]!r}, backwards = {b[1][i]!r} }}" for b in (slides.tolist(), holds.tolist())
            ]
            old = f"friction = {{ sliding = {float(i + 1)!r}, static = {float(i + 1)!r} }}"
            assert old in text
            text = text.replace(old, f"friction = {{ sliding = {bounds[0]}, static = {bounds[1]} }}")
        found = linprog(
            np.r_[np.zeros(5), -1.0],
            A_eq=np.column_stack([pins.T, PULL @ (turned[:2].T @ rates[:2])]),
            b_eq=np.zeros(2),
            bounds=[*zip(-holds[0], holds[1], strict=True), (0.0, None)],
        )
        most = float(found.x[-1])
        result = loaded(text, tmp_path).simulate(
            integrator="dop853", until=1.05 * most, verify=False, coordinates=coordinates
        )
        slips = [event.t for event in result.events if event.name.endswith(".slip")]
        assert slips[0] == pytest.approx(most, rel=1e-9)


def test_the_reference_breaks_loose_more_than_once() -> None:
    slips = pulled_block(0.4)[1]
    assert len(slips) > 2
    assert all(second - first > 1e-3 for first, second in pairwise(slips))
