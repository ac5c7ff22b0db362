"""Effects of events in rows of sweeps: the single runs, with every kind of loop."""

import numpy as np
import pytest
from support.emitted import mechanism_of

import symgen

SETTINGS = [
    {"integrator": "rk4", "step": 2e-3},
    {"integrator": "rk4", "step": 2e-3, "coordinates": "joint"},
    {"integrator": "dop853", "rtol": 1e-11, "atol": 1e-12},
    {"integrator": "picard", "rtol": 1e-11, "atol": 1e-12},
]


def hammer():
    """A pendulum that bounces off a wall, a little less each time, until it is slow enough; an input may push it."""
    arm = {"mass": "mass", "inertia": 0.05, "points": {"hub": [-0.3, 0.0]}, "position": [0.3, 0.0]}
    raw = {
        "mechanism": {"name": "hammer", "gravity": [0.0, -9.81]},
        "run": {"until": 2.5, "step": 2e-3},
        "parameters": {"mass": 1.0, "bounce": 0.8},
        "inputs": {"push": 0.0},
        "bodies": {"arm": arm},
        "joints": {"hub": {"type": "revolute", "between": ["ground", "arm"], "at": [[0.0, 0.0], "hub"]}},
        "forces": {"push": {"type": "torque", "body": "arm", "torque": "push + hits"}},
        "states": {"hits": {"rate": "-0.1*hits", "start": 0.0}},
        "events": {
            "wall": {
                "when": "arm.theta < -1.2",
                "reset": {"arm.omega": "-bounce*arm.omega", "hits": "hits + 0.1"},
            },
            "tired": {"when": "hits > 0.25", "action": "record"},
            "enough": {"when": "hits > 0.35", "action": "stop"},
        },
    }
    return symgen.load(mechanism_of(raw))


@pytest.mark.by_turns(4)
@pytest.mark.slow
@pytest.mark.parametrize("settings", SETTINGS, ids=str)
@pytest.mark.parametrize("inputs", [{}, {"push": "0.4 if t < 0.711 else 0"}], ids=["plain", "jump"])
def test_rows_are_their_single_runs(settings, inputs):
    bounces = np.array([0.5, 0.8, 0.95])
    found = symgen.sweep(
        hammer(), {"bounce": bounces}, quantities=("q", "v", "hits", "event"), inputs=inputs, **settings
    )
    for i, bounce in enumerate(bounces):
        one = hammer().simulate(parameters={"bounce": float(bounce)}, inputs=inputs, **settings)
        assert found.status[i] == one.status == "ok"
        for event in ("wall", "tired", "enough"):
            times = [x.t for x in one.events if x.name == event]
            assert found[f"event.{event}.count"][i] == len(times)
            if times:
                np.testing.assert_allclose(found[f"event.{event}.first"][i], times[0], rtol=1e-10)
                np.testing.assert_allclose(found[f"event.{event}.last"][i], times[-1], rtol=1e-10)
        assert one.events[0].name == "wall"
        np.testing.assert_allclose(found["end"][i], one.end, rtol=1e-10)
        for name in ("arm.theta", "arm.omega", "hits"):
            np.testing.assert_allclose(found[name][i, -1], one[name][-1], rtol=0.0, atol=1e-9)


@pytest.mark.slow
def test_events_that_accumulate_are_named_as_in_single_runs():
    """A ball in a wedge of two walls that take much of its speed: both accumulate; one that only records does not."""
    raw = {
        "mechanism": {"name": "ball", "gravity": [0.0, -9.81]},
        "run": {"until": 5.0, "step": 1e-2},
        "parameters": {"bounce": 0.5},
        "bodies": {"ball": {"type": "point", "mass": 1.0, "position": [0.0, 1.0]}},
        "events": {
            "top": {"when": "ball.vy", "direction": "falling"},
            "floor": {"when": "ball.y < 0", "reset": {"ball.vy": "-bounce*ball.vy"}},
            "again": {"when": "ball.y < 0", "reset": {"ball.vy": "-bounce*ball.vy"}},
        },
    }
    model, settings = symgen.load(mechanism_of(raw)), {"method": "lagrange", "integrator": "rk4", "step": 1e-2}
    found = symgen.sweep(model, {"bounce": [0.4, 0.6]}, quantities=("ball", "event"), **settings)
    for i, bounce in enumerate((0.4, 0.6)):
        one = model.simulate(parameters={"bounce": bounce}, **settings)
        assert found.status[i] == one.status == "failed"
        assert found.reason[i] == one.reason and one.reason.startswith(
            "events of 'floor' and 'again' accumulate at t ="
        )
