"""States of a file's own written at events: closed forms, both coordinates, and what is refused."""

import re

import numpy as np
import pytest
from support.emitted import mechanism_of

import symgen
from symgen.base.errors import InputError

SETTINGS = [
    {"integrator": "dop853", "rtol": 1e-12, "atol": 1e-13},
    {"integrator": "dop853", "rtol": 1e-12, "atol": 1e-13, "coordinates": "joint"},
    {"integrator": "rk4", "step": 1e-3},
    {"integrator": "radau5", "rtol": 1e-11, "atol": 1e-12},
]


def cart(states, events, force="0", **velocity):
    """A cart on a guide along x, without gravity."""
    guide = {"type": "translational", "between": ["ground", "cart"], "at": [[0.0, 0.0], "centre"], "axis": [1.0, 0.0]}
    raw = {
        "mechanism": {"name": "cart"},
        "run": {"until": 1.0, "step": 1e-3},
        "bodies": {"cart": {"mass": 2.0, "inertia": 0.1, "velocity": [1.5, 0.0]}},
        "joints": {"guide": guide},
        "forces": {"push": {"type": "force", "body": "cart", "force": [force, "0"]}},
        "states": states,
        "events": events,
    }
    return symgen.load(mechanism_of(raw))


@pytest.mark.parametrize("settings", SETTINGS, ids=str)
@pytest.mark.parametrize("seed", range(3))
def test_a_state_that_decays_is_multiplied_at_random_times(settings, seed):
    random = np.random.default_rng(seed)
    decay, times = random.uniform(0.2, 3.0), np.sort(random.uniform(0.1, 0.9, 4))
    factors, jumps = random.uniform(0.2, 2.0, 4), random.uniform(-1.0, 1.0, 4)
    events = {
        f"tap{k}": {"when": f"t > {t!r}", "reset": {"level": f"{a!r}*level + {b!r}"}}
        for k, (t, a, b) in enumerate(zip(times.tolist(), factors.tolist(), jumps.tolist(), strict=True))
    }
    states = {"level": {"rate": f"-{decay!r}*level", "start": 2.0}}
    result = cart(states, events).simulate(**settings)
    level, before = 2.0, 0.0
    for t, a, b in zip(times, factors, jumps, strict=True):
        level, before = a * level * np.exp(-decay * (t - before)) + b, t
    assert result.ok and [event.action for event in result.events] == ["reset"] * 4
    assert all(event.work == 0.0 and event.v_after == event.v for event in result.events)
    assert not any(impulse for event in result.events for impulse in event.impulses.values())
    np.testing.assert_allclose(result["level"][-1], level * np.exp(-decay * (1.0 - before)), rtol=1e-9)
    np.testing.assert_allclose(result["cart.vx"][-1], 1.5, rtol=1e-14)


@pytest.mark.parametrize("settings", SETTINGS, ids=str)
def test_a_force_reads_the_speed_at_an_event(settings):
    """The cart passes x = 0.6 at t = 0.4, from where its speed there, 1.5 m/s, is pushed with 4 N for each m/s."""
    events = {"gate": {"when": "cart.x > 0.6", "reset": {"entry": "cart.vx"}}}
    result = cart({"entry": {"rate": 0.0, "start": 0.0}}, events, "4*entry").simulate(**settings)
    assert result.ok and result["entry"][-1] == pytest.approx(1.5, rel=1e-13)
    np.testing.assert_allclose(result.events[0].t, 0.4, rtol=0.0, atol=1e-13)
    np.testing.assert_allclose(result["cart.vx"][-1], 1.5 + 3.0 * 0.6, rtol=1e-11)
    np.testing.assert_allclose(result["cart.x"][-1], 1.5 + 0.5 * 3.0 * 0.6**2, rtol=1e-11)


@pytest.mark.parametrize("settings", SETTINGS, ids=str)
def test_velocities_and_states_of_one_event_read_the_state_before(settings):
    events = {"hit": {"when": "cart.x > 0.6", "reset": {"cart.vx": "-worn*cart.vx", "worn": "worn - 0.1*cart.vx"}}}
    result = cart({"worn": {"rate": 0.0, "start": 0.8}}, events).simulate(**settings)
    (hit,) = result.events
    assert result["worn"][-1] == pytest.approx(0.8 - 0.15, rel=1e-13)
    assert hit.v_after["cart.vx"] == result["cart.vx"][-1] == pytest.approx(-0.8 * 1.5, rel=1e-13)
    assert hit.impulses["cart.vx"] == pytest.approx(-2.0 * 1.8 * 1.5, rel=1e-12)
    assert hit.work == pytest.approx(0.5 * 2.0 * 1.5**2 * (0.8**2 - 1.0), rel=1e-12)


def test_one_state_gets_one_value_at_a_time():
    events = {name: {"when": "t > 0.5", "reset": {"level": "2*level"}} for name in ("a", "b")}
    states = {"level": {"rate": 0.0, "start": 3.0}}
    assert cart(states, events).simulate()["level"][-1] == 6.0
    events["b"] = {"when": "t > 0.5", "reset": {"level": "level + 1"}}
    result = cart(states, events).simulate()
    assert result.status == "failed" and result.t[-1] <= 0.5
    expected = (
        r"^events 'a' and 'b': reset: expected one finite value of each state, got level = 6, level = 4 at t = 0.5"
    )
    assert re.match(expected, result.reason)
    events = {"root": {"when": "t > 0.5", "reset": {"level": "sqrt(-level)"}}}
    result = cart(states, events).simulate()
    assert result.status == "failed"
    assert re.match(r"^event 'root': reset: expected one finite value of each state, got level = n", result.reason)


def test_what_is_no_velocity_and_no_state_is_refused():
    expected = "events.x.reset.cart.x: expected the name of a velocity, such as ball.vy, or of a state, got"
    with pytest.raises(InputError, match=expected):
        cart({"level": {"rate": 0.0}}, {"x": {"when": "t > 1", "reset": {"cart.x": 1.0}}})
