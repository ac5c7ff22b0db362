"""Rows with bounds in loops: closed forms of friction and of impacts, dependent rows, and a long chain that rubs."""

import copy

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import symgen
from symgen.base.settings import Settings
from symgen.describe import MechanismBuilder
from symgen.describe.files.load import read_raw
from symgen.describe.files.validate import validate
from symgen.run.planning.prepare import prepare
from tests.run.modes.test_dry_friction import PIN, TURNS, described
from tests.run.modes.test_stops import BALL, G, times
from tests.run.modes.test_stops import described as with_stops

TIGHT = {"rtol": 1e-12, "atol": 1e-12}
METHODS = [
    ("lagrange", "dop853", TIGHT),
    ("direct-correction", "picard", TIGHT),
    ("baumgarte", "dop853", TIGHT),
    ("augmented-lagrangian", "dop853", TIGHT),
    ("mass-orthogonal-projection", "dop853", TIGHT),
    ("lagrange", "radau5", {"rtol": 1e-10, "atol": 1e-10}),
    ("ggl", "radau5", {"rtol": 1e-10, "atol": 1e-10}),
    ("generalized-alpha", "generalized-alpha", {"step": 2e-3}),
]


@pytest.mark.by_turns(3)
@pytest.mark.fast("lagrange-dop853")
@pytest.mark.parametrize(
    ("method", "integrator", "steps"), [pytest.param(*case, id=f"{case[0]}-{case[1]}") for case in METHODS]
)
def test_a_pendulum_rests_where_its_friction_holds_it(method, integrator, steps):
    """Nine half swings, whose ends follow from the energy that each takes; the forces at rest are those of weight."""
    settings = Settings(method, integrator, until=14.0, verify=False, shape="looped", **steps)
    outcome = prepare(described(PIN), settings).integrate()
    assert outcome.reason == "" and outcome.compiled.shape == "looped"
    assert [event.name for event in outcome.happened] == ["pin.reverse"] * 8 + ["pin.stick"]
    assert abs(outcome.states[-1][2] + TURNS[-1]) < (1e-5 if "step" in steps else 1e-9)


@pytest.mark.by_turns(2)
@pytest.mark.slow
@pytest.mark.parametrize("method", ["lagrange", pytest.param("augmented-lagrangian", marks=pytest.mark.slow)])
def test_a_ball_bounces_until_it_rests(method):
    settings = Settings(method, "dop853", until=4.0, verify=False, shape="looped", **TIGHT)
    outcome = prepare(with_stops(BALL), settings).integrate()
    first = np.sqrt(2.0 / G)
    hits = first + 2.0 * first * np.concatenate([[0.0], np.cumsum(0.7 ** np.arange(1, 20))])
    np.testing.assert_allclose(times(outcome, "floor.hit")[:20], hits, rtol=0, atol=1e-12)
    assert outcome.happened[-1].name == "floor.rest" and abs(outcome.states[-1][1]) < 1e-12


@pytest.mark.slow
def test_four_pins_that_rest_at_one_time():
    """Their rows depend on each other at rest; the angle is that of Newton's and Euler's equations by hand."""
    raw, source = read_raw("four-bar")
    raw = copy.deepcopy(raw)
    for joint in "ABCD":
        raw["joints"][joint]["friction"] = {"sliding": 4.0}
    model = symgen.load(validate(raw, source))
    run = model.simulate(method="lagrange", integrator="dop853", shape="looped", until=23.0, rtol=1e-11, atol=1e-12)
    assert run.status == "ok"
    assert run["crank.theta"][-1] == pytest.approx(-2.07596285039, abs=1e-9)


LINK, MASS, INERTIA = 0.1, 0.1, 1e-3


def rubbing_chain(count, friction, rate=0.0):
    """Links in a horizontal line, pinned to each other and to the ground; every second one begins to turn."""
    builder, before = MechanismBuilder(f"rubbing-chain-{count}", gravity=[0.0, -G]), "ground"
    for i in range(count):
        builder.body(f"link{i}", mass=MASS, inertia=INERTIA, position=[LINK * (0.5 + i), 0.0])
        start, at = {"rate": rate * (-1.0) ** i}, [0.5 * LINK if i else 0.0, 0.0]
        pin = {"between": [before, f"link{i}"], "at": [at, [-0.5 * LINK, 0.0]], "friction": friction, "start": start}
        builder.joint(f"pin{i}", "revolute", **pin)
        before = f"link{i}"
    return symgen.load(builder.build())


def slid(count, bound, rate, until):
    """Angles of the links by Lagrange's equations in these angles; no pin turns round."""
    places = LINK * np.tri(count, k=-1) + 0.5 * LINK * np.eye(count)  # how far each centre goes by each angle
    lever, pull = MASS * places.T @ places, MASS * G * places.sum(axis=0)

    def rates(t, y):
        angles, speeds = y[:count], y[count:]
        apart = angles[:, None] - angles
        rubbing = -bound * np.sign(np.diff(speeds, prepend=0.0))
        torque = rubbing - np.append(rubbing[1:], 0.0) - pull * np.cos(angles)
        torque -= (lever * np.sin(apart)) @ speeds**2
        return np.concatenate([speeds, np.linalg.solve(lever * np.cos(apart) + INERTIA * np.eye(count), torque)])

    speeds = np.cumsum(rate * (-1.0) ** np.arange(count))
    y = np.concatenate([np.zeros(count), speeds])
    return solve_ivp(rates, (0.0, until), y, method="DOP853", rtol=1e-11, atol=1e-12).y[:, -1]


@pytest.mark.slow
def test_a_chain_of_100_links_that_rub_is_taken_by_loops():
    """Straight code would compile for minutes; the motion is that of Lagrange's equations in NumPy."""
    model = rubbing_chain(100, {"sliding": 0.02}, 5.0)
    run = model.simulate(until=0.004, method="lagrange", integrator="dop853", rtol=1e-9, atol=1e-9)
    assert run.status == "ok" and run.shape == "looped" and not run.events
    exact = slid(100, 0.02, 5.0, 0.004)
    np.testing.assert_allclose(run.q.values[-1][2::3], exact[:100], rtol=0.0, atol=1e-8)


@pytest.mark.slow
def test_short_and_long_code_agree_on_a_rubbing_chain():
    """Some pins stick and others slide: modes are the same, events and the motion within rounding."""
    model, settings = rubbing_chain(4, {"sliding": 0.02, "static": 0.03}), {"until": 0.6, "method": "lagrange"}
    straight, looped = (
        model.simulate(**settings, integrator="dop853", coordinates="absolute", shape=shape, rtol=1e-11, atol=1e-12)
        for shape in ("straight", "looped")
    )
    assert len(straight.events) > 4 and [e.name for e in straight.events] == [e.name for e in looped.events]
    np.testing.assert_allclose(looped.q.values, straight.q.values, rtol=0.0, atol=1e-9)
    for name in straight.outputs.names:
        np.testing.assert_allclose(looped[name], straight[name], rtol=0.0, atol=1e-7)


def parallel_bars():
    """A plate on three equal bars: one row repeats what the others hold, and a pin rubs."""
    builder = MechanismBuilder("parallel-bars", gravity=[0.0, -G])
    builder.parameter("torque", 0.5)
    builder.body("plate", mass=2.0, inertia=0.5, position=[1.0, 1.0])
    for i in range(3):
        builder.body(f"bar{i}", mass=1.0 + i, inertia=0.1, position=[float(i), 0.5], angle=0.5 * np.pi)
        more = {} if i else {"friction": {"sliding": "torque"}, "start": {"rate": 1.0}}
        builder.joint(f"foot{i}", "revolute", between=["ground", f"bar{i}"], at=[[float(i), 0.0], [-0.5, 0.0]], **more)
        builder.joint(f"head{i}", "revolute", between=[f"bar{i}", "plate"], at=[[0.5, 0.0], [i - 1.0, 0.0]])
    return symgen.load(builder.build())


@pytest.mark.by_turns(4)
@pytest.mark.slow
@pytest.mark.parametrize("count", [3, pytest.param(300, marks=pytest.mark.slow)], ids=["3", "300"])
def test_reactions_that_are_not_unique_are_those_of_straight_code(count):
    """Rows that are off count neither as rows in force nor in the rank, also where all of them move."""
    model, names = (
        parallel_bars(),
        [f"{joint}{i}.{axis}" for joint in ("foot", "head") for i in range(3) for axis in ("Fx", "Fy")],
    )
    for torque in np.linspace(0.1, 9.0, count):
        settings = {"until": 0.2, "output_step": 0.05, "integrator": "rk4", "step": 1e-3, "method": "lagrange"}
        runs = [model.simulate(parameters={"torque": torque}, shape=s, **settings) for s in ("straight", "looped")]
        straight, looped = runs
        assert looped.shape == "looped" and looped.rank.rank == straight.rank.rank == 11 and looped.rank.rows == 12
        assert looped.non_unique_reactions == straight.non_unique_reactions != ()
        np.testing.assert_allclose(looped.select(names).values, straight.select(names).values, rtol=0, atol=1e-9)
