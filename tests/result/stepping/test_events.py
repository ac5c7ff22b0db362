"""Events of runs that go on step by step: one run however it is divided, stops, resets, and what is saved of them."""

import math
import pickle

import numpy as np
import pytest
from support.checks import assert_same_motion
from support.emitted import mechanism_of

import symgen
from symgen.base.errors import InputError, StepError

G, E = 9.81, 0.7
FIRST = math.sqrt(2.0 / G)  # a fall of 1 m
BALL = {
    "mechanism": {"name": "stepped-ball", "gravity": [0.0, -G]},
    "run": {"until": 5.0, "step": 1e-2},
    "parameters": {"floor": 0.0},
    "bodies": {"ball": {"type": "point", "mass": 1.3, "position": [0.0, 1.0], "velocity": [2.0, 0.0]}},
}
BOUNCE = {"impact": {"when": "ball.y < floor", "reset": {"ball.vy": f"-{E}*ball.vy"}}}
NOTED = {
    "low": {"when": "ball.y < 0.61"},
    "far": {"when": "sin(20*ball.x)", "direction": "any"},
}


def ball(**events):
    return symgen.load(mechanism_of({**BALL, "events": events}))


def flight(t):
    """Height and vertical speed of the ball, its impacts known in closed form."""
    begin, speed, height = 0.0, 0.0, 1.0
    end = FIRST
    while t > end:
        speed = E * (G * FIRST if begin == 0.0 else speed)
        begin, height, end = end, 0.0, end + 2.0 * speed / G
    return height + speed * (t - begin) - 0.5 * G * (t - begin) ** 2, speed - G * (t - begin)


@pytest.mark.fast("rk4-True", "rk4-False")
@pytest.mark.parametrize(("integrator", "direct"), [("rk4", True), ("rk4", False), ("abm4", True)])
def test_pieces_are_one_run_with_events_that_are_noted(integrator, direct):
    model, settings = ball(**NOTED), {"method": "lagrange", "integrator": integrator, "step": 1e-2}
    whole = model.simulate(until=0.6, **settings)
    sim = model.start(until=0.6, **settings)
    sim._loop.direct = direct
    for k in range(60):
        assert sim.step(1e-2) is None
        if k == 31:
            saved = pickle.loads(pickle.dumps(sim.save()))
            other = model.start(until=0.6, **settings)
    assert_same_motion(sim.q, whole.q.values[-1])
    assert_same_motion(sim.v, whole.v.values[-1])
    assert len(sim.events) > 7 and [e.name for e in sim.events] == [e.name for e in whole.events]
    assert_same_motion([e.t for e in sim.events], [e.t for e in whole.events])
    other.restore(saved)
    other.run(0.6)
    np.testing.assert_array_equal(other.state, sim.state)
    assert [e.to_json() for e in other.events] == [e.to_json() for e in sim.events]
    sim.restore(saved)
    assert [e.t for e in sim.events] == [e.t for e in whole.events if e.t <= saved.t]


@pytest.mark.parametrize("settings", [{"integrator": "rk4", "step": 1e-2}, {"integrator": "dop853"}])
@pytest.mark.parametrize("direct", [True, False])
def test_resets_happen_on_the_way(settings, direct):
    sim = ball(**BOUNCE).start(method="lagrange", **settings)
    sim._loop.direct = direct
    for k in range(20):
        assert sim.step(0.1) is None
        assert (sim.q["ball.y"], sim.v["ball.vy"]) == pytest.approx(flight(0.1 * (k + 1)), abs=1e-11)
    times = [e.t for e in sim.events]
    np.testing.assert_allclose(times[:2], [FIRST, FIRST * (1.0 + 2.0 * E)], rtol=0.0, atol=1e-12)
    assert len(times) == 4 and sim.events[0].v_after["ball.vy"] == pytest.approx(E * G * FIRST)


@pytest.mark.parametrize("settings", [{"integrator": "rk4", "step": 1e-2}, {"integrator": "dop853"}])
def test_a_run_stands_at_an_event_that_stops_it_and_goes_on_from_there(settings):
    model = ball(half={"when": "ball.y < 0.5", "action": "stop"}, low={"when": "ball.y < 0.25", "action": "stop"})
    sim, calls = model.start(method="lagrange", **settings), []
    sim.every(0.1, lambda t, run: calls.append(t))
    event = sim.run(1.0)
    assert event.name == "half" and event == sim.events[-1]
    assert sim.t == event.t == pytest.approx(math.sqrt(1.0 / G), abs=1e-13) and len(calls) == 4
    assert sim.q["ball.y"] == event.q["ball.y"] == pytest.approx(0.5, abs=1e-13)
    event = sim.step(0.5)
    assert event.name == "low" and sim.t == pytest.approx(math.sqrt(1.5 / G), abs=1e-13)
    assert sim.run(0.6) is None and sim.t == pytest.approx(0.6) and len(sim.events) == 2
    assert sim.q["ball.y"] == pytest.approx(1.0 - 0.5 * G * 0.36, abs=1e-11)
    assert calls == [k * 0.1 for k in range(6)]


def test_events_follow_parameters_that_are_set():
    sim = ball(**BOUNCE).start(method="lagrange", integrator="rk4", step=1e-2)
    sim.step(0.2)
    sim.set(floor=0.5)
    assert sim.step(0.2) is None
    assert sim.events[0].t == pytest.approx(math.sqrt(1.0 / G), abs=1e-12)
    other = ball(low={"when": "ball.y < floor", "action": "stop"}).start(method="lagrange", step=1e-2)
    other.step(0.3)
    other.set(floor=0.9)  # which is above the ball: the condition has become true
    assert other.step(0.1).name == "low" and other.t == pytest.approx(0.3, abs=1e-12)


@pytest.mark.parametrize("direct", [True, False])
def test_where_impacts_accumulate_the_run_stays_before_the_last_one(direct):
    sim = ball(**BOUNCE).start(method="lagrange", integrator="rk4", step=1e-2)
    sim._loop.direct = direct
    end = FIRST * (1.0 + 2.0 * E / (1.0 - E))
    for _ in range(2):  # going on ends there again
        with pytest.raises(StepError, match=r"events of 'impact' accumulate at t = 2\.558633965"):
            sim.run(3.0)
        assert sim.t < end and end - sim.t < 1e-6 and np.isfinite(sim.state).all()
        assert all(e.t <= sim.t for e in sim.events)


@pytest.mark.slow
@pytest.mark.parametrize("direct", [True, False])
def test_velocities_that_cannot_be_leave_the_run_before_the_event(direct):
    rod = {"mass": 1.2, "inertia": 0.1, "points": {"A": [-0.5, 0.0]}, "position": [0.0, -0.5], "angle": "-pi/2"}
    model = symgen.load(
        mechanism_of(
            {
                "mechanism": {"name": "stepped-rod"},
                "bodies": {"rod": rod | {"angular_velocity": 2.0}},
                "joints": {"pin": {"type": "revolute", "between": ["ground", "rod"], "at": [[0.0, 0.0], "A"]}},
                "events": {
                    "first": {"when": "rod.theta > -pi/2 + 0.2"},
                    "blow": {"when": "t > 0.205", "reset": {"rod.omega": "2", "rod.vx": "9"}},
                },
            }
        )
    )
    sim = model.start(integrator="rk4", step=1e-2)
    sim._loop.direct = direct
    for _ in range(2):
        with pytest.raises(InputError, match="event 'blow': reset: expected velocities that the joints"):
            sim.run(0.5)
        assert sim.t == pytest.approx(0.2) and [e.name for e in sim.events] == ["first"]


def test_what_was_saved_belongs_to_runs_with_the_same_events():
    one, other = (ball(low={"when": f"ball.y < {y}"}).start(method="lagrange", step=1e-2) for y in (0.5, 0.6))
    for run, saved in ((one, other.save()), (ball().start(method="lagrange", step=1e-2), one.save())):
        with pytest.raises(InputError, match="restore: expected a state of "):
            run.restore(saved)


def test_a_run_goes_on_with_events_of_another_kind():
    """With all that was kept but what was known of the events: bit for bit where the scheme has no memory."""
    model, settings = ball(), {"method": "lagrange", "integrator": "rk4", "step": 1e-2}
    first = model.simulate(until=0.2, **settings)
    rest = model.simulate(until=1.0, start=first, stop_when="ball.y < 0.5", **settings)
    assert rest.ok and rest.end == pytest.approx(math.sqrt(1.0 / G), abs=1e-12)
    assert "with all that it kept but its events: events " in rest.notes[0]
    watched = model.simulate(until=0.2, stop_when="ball.y < 0.5", **settings)
    whole = model.simulate(until=0.4, **settings)
    for begun, more in ((first, {"record_when": "ball.y < 0.9"}), (watched, {})):
        rest = model.simulate(until=0.4, start=begun, **more, **settings)
        for name, table in rest.tables().items():
            np.testing.assert_array_equal(table.values, whole.tables()[name].values[-len(rest.t) :], err_msg=name)
    whole = model.simulate(until=0.6, record_when="ball.y < 0.5", **settings)
    first = model.simulate(until=0.3, record_when="ball.y < 0.5", **settings)
    rest = model.simulate(until=0.6, record_when="ball.y < 0.5", start=first, **settings)
    np.testing.assert_array_equal(rest.q.values[-1], whole.q.values[-1])
    assert [e.t for e in rest.events] == [e.t for e in whole.events]


def test_parameters_that_change_right_behind_a_reset_do_the_work_of_their_change_alone():
    """The ball stops on the floor with a blow; there it becomes twice as heavy: m v^2 / 2 once more, v behind it."""
    heavy = {**BALL, "parameters": {**BALL["parameters"], "mass": 1.3}}
    heavy["bodies"] = {"ball": {**BALL["bodies"]["ball"], "mass": "mass"}}
    land = {"land": {"when": "ball.y < floor", "action": "stop"}}
    run = symgen.load(mechanism_of({**heavy, "events": BOUNCE | land})).start(
        method="lagrange", integrator="rk4", step=1e-2
    )
    assert run.run(1.0).name == "land"
    work, place = run._loop.state.y, run._compiled.info.work
    before = float(work[place])
    square = 2.0**2 + E * E * 2.0 * G
    assert before == pytest.approx(0.5 * 1.3 * (E * E - 1.0) * 2.0 * G, rel=1e-12)
    run.set(mass=2.6)
    assert float(work[place]) - before == pytest.approx(0.5 * 1.3 * square, rel=1e-9)
