"""Clutches and brakes, whose bounds are formulas: closed forms, and an event-driven simulation that tries all modes."""

import itertools
from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import symgen
from symgen.describe.files.load import parse_toml
from symgen.describe.files.validate import validate

TIGHT = {"integrator": "dop853", "rtol": 1e-12, "atol": 1e-13}
#: A motor of 2 kg m^2 at 10 rad/s and a load of 3 kg m^2 at rest; a clutch, whose pressure is an input.
CLUTCH = """
[mechanism]
name = "clutch"

[parameters]
slope = 2.0

[inputs]
pressure = 0.0

[bodies.motor]
mass = 1.0
inertia = 2.0
angular_velocity = 10.0

[bodies.load]
mass = 1.0
inertia = 3.0

[joints.shaft]
type = "revolute"
between = ["ground", "motor"]
at = [[0.0, 0.0], "centre"]

[joints.clutch]
type = "revolute"
between = ["motor", "load"]
at = ["centre", "centre"]
friction = { sliding = "pressure" }
"""
#: A wheel of 2 kg m^2 under a torque that is an input, its brake, and a hand that turns at 1 rad/s.
BRAKE = """
[mechanism]
name = "brake"

[inputs]
torque = 2.0
pressure = 1.0

[states]
wear = {{ rate = "1.0", start = 0.0 }}

[bodies.wheel]
mass = 1.0
inertia = 2.0

[bodies.hand]
mass = 1.0
inertia = 1.0
angular_velocity = 1.0

[joints.free]
type = "revolute"
between = ["ground", "hand"]
at = [[1.0, 0.0], "centre"]

[joints.pin]
type = "revolute"
between = ["ground", "wheel"]
at = [[0.0, 0.0], "centre"]
friction = {friction}

[forces.drive]
type = "torque"
body = "wheel"
torque = "{torque}"
"""


def model(text: str) -> symgen.Model:
    return symgen.load(validate(parse_toml(text, "clutch.toml"), "clutch.toml"))


def brake(friction: str, torque: str = "torque") -> symgen.Model:
    return model(BRAKE.format(friction=friction, torque=torque))


def times_of(result: Any) -> list[tuple[str, float]]:
    assert result.status == "ok", result.reason
    return [(event.name, event.t) for event in result.events]


# -- a clutch between two inertias -------------------------------------------------------------------------------------


def locked(slope: float) -> tuple[float, float]:
    """Return when a ramp of the pressure locks the clutch, and the common speed: momentum is kept."""
    return float(np.sqrt(2.0 * 10.0 / (slope * (1.0 / 2.0 + 1.0 / 3.0)))), 2.0 * 10.0 / 5.0


@pytest.mark.slow
@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
@pytest.mark.parametrize("steps", [TIGHT, {"integrator": "picard"}], ids=["dop853", "picard"])
def test_a_ramp_of_the_pressure_locks_a_clutch(steps: dict[str, Any], coordinates: str) -> None:
    """Whether the ramp is an input's formula or its data, it locks at the same time, at the speed of both together."""
    time, speed = locked(2.0)
    clutch, common = model(CLUTCH), {"coordinates": coordinates, "until": 5.0, **steps}
    for pressure in ("slope*t", {"t": [0.0, 6.0], "u": [0.0, 12.0], "interpolation": "linear"}):
        result = clutch.simulate(inputs={"pressure": pressure}, **common)
        ((name, at),) = times_of(result)
        assert (name, at) == ("clutch.stick", pytest.approx(time, abs=1e-10))
        assert result["load.omega"][-1] == pytest.approx(speed, abs=1e-10)
        assert result["motor.omega"][-1] == pytest.approx(speed, abs=1e-10)


@pytest.mark.by_turns(2)
@pytest.mark.slow
@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
def test_rows_of_a_sweep_lock_as_runs_do(coordinates: str) -> None:
    """In the slowest row the clutch still slips at the end."""
    slopes = [0.5, 1.5, 2.5]
    sweep = model(CLUTCH).sweep(
        {"slope": slopes}, inputs={"pressure": "slope*t"}, until=5.0, coordinates=coordinates,
        quantities=["load.omega", "motor.omega"], **TIGHT,
    )  # fmt: skip
    assert set(sweep.status) == {"ok"}
    load = [s * 5.0**2 / 2.0 / 3.0 if locked(s)[0] > 5.0 else locked(s)[1] for s in slopes]
    np.testing.assert_allclose(sweep["load.omega"][:, 0], load, rtol=0.0, atol=1e-10)
    np.testing.assert_allclose(sweep["motor.omega"][:, 0], (20.0 - 3.0 * np.array(load)) / 2.0, rtol=0.0, atol=1e-10)


@pytest.mark.slow
def test_constant_steps_lock_by_their_order() -> None:
    """A pressure by the speed that is left: 10 - w falls as exp(-k t) with k = 5/6, and locks by what is added."""
    clutch = model(CLUTCH.replace('"pressure"', '"2*(motor.omega - load.omega)**2/10 + 1"'))
    k = (0.5 + 1.0 / 3.0) * np.array([0.2, 1.0])
    exact = np.arctan(10.0 * np.sqrt(k[0] / k[1])) / np.sqrt(k[0] * k[1])
    errors = [
        abs(times_of(clutch.simulate(integrator="rk4", step=h, until=5.0))[0][1] - exact) for h in (0.1, 0.05, 0.025)
    ]
    assert all(12.0 < a / b < 24.0 for a, b in itertools.pairwise(errors))
    assert times_of(clutch.simulate(until=5.0, **TIGHT))[0][1] == pytest.approx(exact, abs=1e-10)


def test_a_clutch_from_python() -> None:
    """Pressed in pieces: 6 N m for a second, nothing for a second, 6 N m until it locks; then a brake of the load."""
    sim = model(CLUTCH).start(**TIGHT)
    sim.step(1.0, u={"pressure": 6.0})
    assert sim["load.omega"] == pytest.approx(2.0, abs=1e-10)
    sim.set(pressure=0.0)
    sim.step(1.0)
    assert (sim["load.omega"], sim["motor.omega"]) == (pytest.approx(2.0, abs=1e-10), pytest.approx(7.0, abs=1e-10))
    sim.step(2.0, u={"pressure": 6.0})
    assert [(event.name, event.t) for event in sim.events] == [("clutch.stick", pytest.approx(3.0, abs=1e-10))]
    assert sim["load.omega"] == pytest.approx(4.0, abs=1e-10)


# -- bounds that change under what rests -------------------------------------------------------------------------------


@pytest.mark.by_turns(3)
@pytest.mark.slow_cases(
    "pressure-settings8",
    "3 - hand.omega*t-settings6",
    "3 - hand.theta-settings3",
    "3 - wear-settings2",
    "3 if hand.theta < 1 else 1-settings5",
)
@pytest.mark.parametrize(
    ("friction", "settings"),
    [
        ("3 - t", {}),
        ("3 if t < 1 else 1", {}),
        ("3 - wear", {}),
        ("3 - hand.theta", {}),
        ("3 - free.angle", {}),
        ("3 if hand.theta < 1 else 1", {}),
        ("3 - hand.omega*t", {}),
        ("pressure", {"inputs": {"pressure": "3 - t"}}),
        ("pressure", {"inputs": {"pressure": "3 if t < 1 else 1"}}),
        ("3*pressure", {"inputs": {"pressure": {"t": [0.0, 1.0], "u": [1.0, 1.0 / 3.0], "interpolation": "hold"}}}),
    ],
)
def test_what_rests_breaks_loose_where_the_bound_falls_below_its_force(friction: str, settings: dict[str, Any]) -> None:
    """2 N m against a bound that is 2 N m after a second, and 3 - t N m from there on, or 1 N m."""
    wheel = brake(f'{{ sliding = "{friction}" }}')
    for steps in (TIGHT, {"integrator": "rk4", "step": 0.01}):
        result = wheel.simulate(until=2.0, **settings, **steps)
        assert times_of(result) == [("pin.slip", pytest.approx(1.0, abs=1e-10))]
        jumps = "if" in friction or "if" in str(settings) or "hold" in str(settings)
        assert result["wheel.omega"][-1] == pytest.approx(0.5 if jumps else 0.25, abs=1e-9)


def test_a_force_that_jumps_in_time_breaks_what_rests_loose() -> None:
    """Adaptive steps ended in no progress there, as modes were chosen before the jump."""
    result = brake("{ sliding = 2.0 }", "1.0 if t < 1 else 3.0").simulate(until=2.0, **TIGHT)
    assert times_of(result) == [("pin.slip", pytest.approx(1.0, abs=1e-10))]
    assert result["wheel.omega"][-1] == pytest.approx(0.5, abs=1e-10)


@pytest.mark.slow
def test_bounds_at_their_force_from_the_start() -> None:
    """A bound that falls from the force breaks loose at once; one that rises as fast as twice the torque holds."""
    assert times_of(brake('{ sliding = "2 - t" }').simulate(until=1.0, **TIGHT)) == [
        ("pin.slip", pytest.approx(0.0, abs=1e-10))
    ]
    held = brake('{ sliding = "2*t" }', "t").simulate(until=1.0, **TIGHT)
    assert times_of(held) == [] and held["wheel.omega"][-1] == 0.0
    slips = brake('{ sliding = "t" }', "2*t").simulate(until=1.0, **TIGHT)
    assert times_of(slips) == [("pin.slip", pytest.approx(0.0, abs=1e-10))]
    assert slips["wheel.omega"][-1] == pytest.approx(0.25, abs=1e-10)


def test_a_negative_pressure_presses_nothing() -> None:
    """A bound of 1 - t is none from t = 1 on, where it does not drive the wheel either."""
    result = brake('{ sliding = "1 - t" }').simulate(until=2.0, **TIGHT)
    assert result["wheel.omega"][-1] == pytest.approx((2.0 * 2.0 - 0.5) / 2.0, abs=1e-10)
    assert result["pin.force"][-1] == 0.0


@pytest.mark.slow
def test_a_bound_over_the_rate_and_another_exponent() -> None:
    """A bound of 3 - rate up to 2 rad/s: the wheel comes to rest after 2 ln 2 from 1.5 rad/s; and exp(-rate)."""
    spun = BRAKE.replace("inertia = 2.0\n", "inertia = 2.0\nangular_velocity = 1.5\n", 1)
    table = "\n[tables]\ncurve = {{ x = [0.0, 1.0, 2.0, 9.0], y = [3.0, 2.0, 1.0, 1.0] }}\n"
    wheel = model((spun + table).format(friction='{ sliding = "curve(rate)" }', torque="0.0"))
    for steps, most in ((TIGHT, 1e-10), ({"integrator": "picard"}, 1e-8)):
        assert times_of(wheel.simulate(until=2.0, **steps)) == [
            ("pin.stick", pytest.approx(2.0 * np.log(2.0), abs=most))
        ]
    written = model(spun.format(friction='{ sliding = "1 + exp(-rate)" }', torque="0.0")).simulate(until=4.0, **TIGHT)
    keys = "{ sliding = 1.0, static = 2.0, stribeck_speed = 1.0, stribeck_exponent = 1.0 }"
    keyed = model(spun.format(friction=keys, torque="0.0")).simulate(until=4.0, **TIGHT)
    exact = 2.0 * np.log((np.exp(1.5) + 1.0) / 2.0)  # w' = -(1 + exp(-w))/2
    for result in (written, keyed):
        assert times_of(result) == [("pin.stick", pytest.approx(exact, abs=1e-10))]


SLOPE = """
[mechanism]
name = "slope"
gravity = [0.0, -10.0]

[bodies.block]
mass = 2.0
inertia = 1.0
velocity = [1.6, 1.2]

[joints.slope]
type = "translational"
between = ["ground", "block"]
at = [[0.0, 0.0], "centre"]
axis = [4.0, 3.0]
angle = 0.0
friction = { coefficient = "0.25 + 0.1*rate", static_coefficient = "0.8 - 0.1*t" }
"""


@pytest.mark.by_turns(2)
@pytest.mark.slow
@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
def test_coefficients_are_formulas_too(coordinates: str) -> None:
    """A block on a slope of 3 in 4 under 16 N stops by v' = -(8 + 0.8 v), and is held until 0.8 - 0.1 t is 12/16."""
    result = model(SLOPE).simulate(until=1.0, coordinates=coordinates, **TIGHT)
    stick = np.log(9.6 / 8.0) / 0.8
    assert times_of(result) == [
        ("slope.stick", pytest.approx(stick, abs=1e-10)),
        ("slope.slip", pytest.approx(0.5, abs=1e-10)),
    ]
    speed = 5.0 * (1.0 - np.exp(-0.8 * 0.5))  # v' = 4 - 0.8 v down the slope
    np.testing.assert_allclose(result["block.vx"][-1], -0.8 * speed, rtol=0.0, atol=1e-9)


# -- several that hold one motion --------------------------------------------------------------------------------------

GEARED = """
[mechanism]
name = "geared"

[bodies.a]
mass = 1.0
inertia = 2.0

[bodies.b]
mass = 1.0
inertia = 2.0

[joints.p]
type = "revolute"
between = ["ground", "a"]
at = [[0.0, 0.0], "centre"]
friction = {{ sliding = "{one}" }}

[joints.q]
type = "revolute"
between = ["ground", "b"]
at = [[1.0, 0.0], "centre"]
friction = {{ sliding = "{two}" }}

[joints.mesh]
type = "gear"
between = ["a", "b"]
ratio = 2.0

[forces.drive]
type = "torque"
body = "a"
torque = 2.0
"""


@pytest.mark.by_turns(3)
@pytest.mark.slow
@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
@pytest.mark.parametrize(("one", "two", "time"), [("2 - t", "2 - t/10", 1.0 / 1.05), ("3 - t", "1 - t/10", 1.5 / 1.05)])
def test_brakes_on_both_shafts_of_a_gear_hold_together(one: str, two: str, time: float, coordinates: str) -> None:
    """A torque of 2 N m slips where the first bound and half of the second are together below it."""
    result = model(GEARED.format(one=one, two=two)).simulate(until=1.9, coordinates=coordinates, **TIGHT)
    assert sorted(times_of(result)) == [(f"{pin}.slip", pytest.approx(time, abs=1e-10)) for pin in "pq"]
    assert result["a.omega"][-1] == pytest.approx(1.05 * (1.9 - time) ** 2 / 2.0 / 2.5, abs=1e-10)


# -- three clutches in a chain -----------------------------------------------------------------------------------------

INERTIAS = (1.0, 0.7, 1.3, 0.9)
#: Torques on the first and the last shaft, and pressures of the clutches.
DRIVE, LOAD = "4*sin(3*t)", "-1.5*cos(2*t)"
PRESSURES = ("1.2 + sin(2*t)", "2.0 - 0.5*t", "0.8*t")


def chain() -> symgen.Model:
    text = '[mechanism]\nname = "chain"\n'
    for i, inertia in enumerate(INERTIAS):
        text += f"[bodies.s{i}]\nmass = 1.0\ninertia = {inertia}\nangular_velocity = {2.0 if i == 0 else 0.0}\n"
        between = '"ground", "s0"' if i == 0 else f'"s{i - 1}", "s{i}"'
        at = '[[0.0, 0.0], "centre"]' if i == 0 else '["centre", "centre"]'
        text += f'[joints.c{i}]\ntype = "revolute"\nbetween = [{between}]\nat = {at}\n'
        text += f'friction = {{ sliding = "{PRESSURES[i - 1]}" }}\n' if i else ""
    for name, body, torque in (("drive", 0, DRIVE), ("load", 3, LOAD)):
        text += f'[forces.{name}]\ntype = "torque"\nbody = "s{body}"\ntorque = "{torque}"\n'
    return model(text)


class ByAllModes:
    """The chain by SciPy: of all 27 modes of three clutches the one that is consistent, until a margin is passed."""

    masses = np.diag(INERTIAS)
    rows = np.array([[-1.0, 1.0, 0.0, 0.0], [0.0, -1.0, 1.0, 0.0], [0.0, 0.0, -1.0, 1.0]])

    def torques(self, t: float) -> np.ndarray:
        return np.array([4.0 * np.sin(3.0 * t), 0.0, 0.0, -1.5 * np.cos(2.0 * t)])

    def bounds(self, t: float) -> np.ndarray:
        return np.maximum([1.2 + np.sin(2.0 * t), 2.0 - 0.5 * t, 0.8 * t], 0.0)

    def solved(self, t: float, modes: tuple[int, ...]) -> tuple[np.ndarray, np.ndarray]:
        """Return the accelerations, and the torques of all clutches on the shaft behind them; 0 means held."""
        stuck = [i for i, mode in enumerate(modes) if mode == 0]
        sliding = -np.array(modes) * self.bounds(t)
        held = self.rows[stuck]
        k = np.block([[self.masses, -held.T], [held, np.zeros((len(stuck), len(stuck)))]])
        x = np.linalg.solve(k, np.concatenate([self.torques(t) + self.rows.T @ sliding, np.zeros(len(stuck))]))
        sliding[stuck] = x[4:]
        return x[:4], sliding

    def modes(self, t: float, w: np.ndarray, resting: set[int]) -> tuple[int, ...]:
        """Return the modes just behind a time: clutches at rest stay so, or begin to slide as they accelerate."""
        rates, found, ahead = self.rows @ w, [], t + 1e-9
        for modes in itertools.product((0, 1, -1), repeat=3):
            if any(i not in resting and modes[i] != np.sign(rates[i]) for i in range(3)):
                continue
            a, torques = self.solved(ahead, modes)
            relative, bounds = self.rows @ a, self.bounds(ahead)
            if all(abs(torques[i]) <= bounds[i] if modes[i] == 0 else modes[i] * relative[i] > 0.0 for i in resting):
                found.append(modes)
        assert len(found) == 1
        return found[0]

    def margin(self, i: int, modes: tuple[int, ...]) -> Any:
        """Return what falls to 0 where a clutch leaves its mode: the rate that is left, or the torque."""
        if modes[i] != 0:
            return lambda t, w: modes[i] * (self.rows[i] @ w)
        return lambda t, w: self.bounds(t)[i] - abs(self.solved(t, modes)[1][i])

    def run(self, until: float) -> tuple[np.ndarray, list[float]]:
        t, w, times, resting = 0.0, np.array([2.0, 0.0, 0.0, 0.0]), [], {1, 2}
        while t < until:
            modes = self.modes(t, w, resting)

            margins = [self.margin(i, modes) for i in range(3)]
            for each in margins:
                each.terminal, each.direction = True, -1
            run = solve_ivp(
                lambda t, w, modes=modes: self.solved(t, modes)[0], (t, until), w, "DOP853", events=margins, rtol=1e-12,
                atol=1e-13, max_step=0.02,
            )  # fmt: skip
            t, w = run.t[-1], run.y[:, -1]
            if run.status == 1:
                times.append(t)
            met = {i for i in range(3) if len(run.t_events[i])}
            resting = {i for i in range(3) if modes[i] == 0} | met
        return w, times


@pytest.mark.slow
@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
def test_three_clutches_in_a_chain(coordinates: str) -> None:
    """Of all modes at each transition only one is consistent; it and its times are found."""
    speeds, times = ByAllModes().run(5.0)
    assert len(times) > 8
    result = chain().simulate(until=5.0, coordinates=coordinates, **TIGHT)
    found = sorted({round(t, 9) for _, t in times_of(result)})
    np.testing.assert_allclose(found, times, rtol=0.0, atol=1e-8)
    np.testing.assert_allclose([result[f"s{i}.omega"][-1] for i in range(4)], speeds, rtol=0.0, atol=1e-9)


# -- a freewheel -------------------------------------------------------------------------------------------------------


@pytest.mark.by_turns(3)
@pytest.mark.slow
@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
@pytest.mark.parametrize(
    "steps", [TIGHT, {"integrator": "picard"}, {"integrator": "rk4", "step": 0.01}], ids=["dop853", "picard", "rk4"]
)
def test_a_freewheel(steps: dict[str, Any], coordinates: str) -> None:
    """Free forwards, held backwards: under 3 sin t N m it turns from rest to 3 rad/s, and stands again behind a period.

    With 2 kg m^2 its rate is 1.5 (1 - cos t), 0 after a period, where the torque is 0 and pushes forwards anew. From pi
    on, a wheel at rest is held.
    """
    wheel = brake("{ sliding = { forwards = 0.0, backwards = 50.0 } }", "3*sin(t)")
    result = wheel.simulate(until=5.0, coordinates=coordinates, **steps)
    assert result.status == "ok"
    assert result["wheel.omega"][-1] == pytest.approx(1.5 * (1.0 - np.cos(5.0)), abs=1e-8)
    backwards = brake("{ sliding = { forwards = 0.0, backwards = 50.0 } }", "-3*sin(t)")
    held = backwards.simulate(until=5.0, coordinates=coordinates, **steps)
    assert times_of(held) == [("pin.slip", pytest.approx(np.pi, abs=1e-9))]
    assert held["wheel.omega"][-1] == pytest.approx(1.5 * (np.cos(np.pi - 5.0) * 1.0 - np.cos(0.0)) * -1.0, abs=1e-8)


@pytest.mark.slow
def test_a_ratchet_whose_pawl_slips() -> None:
    """The force is -1 N m forwards and up to 4 N m backwards, whichever of the two bounds is a formula."""
    sliding = '{ sliding = { forwards = "1 + 0*t", backwards = 4.0 } }'
    result = brake(sliding, "3*t").simulate(until=2.0, **TIGHT)
    assert times_of(result) == [("pin.slip", pytest.approx(1.0 / 3.0, abs=1e-10))]
    assert result["pin.force"][-1] == pytest.approx(-1.0, abs=1e-12)
    result = brake(sliding, "-3*t").simulate(until=2.0, **TIGHT)
    assert times_of(result) == [("pin.slip", pytest.approx(4.0 / 3.0, abs=1e-10))]
    assert result["pin.force"][-1] == pytest.approx(4.0, abs=1e-12)
    assert result["wheel.omega"][-1] == pytest.approx(-3.0 * (2.0 - 4.0 / 3.0) ** 2 / 2.0 / 2.0, abs=1e-10)


RING = """
[mechanism]
name = "ring"

[inputs]
one = 1.5

[bodies.a]
mass = 1.0
inertia = 2.0

[bodies.b]
mass = 1.0
inertia = 2.0

[joints.p]
type = "revolute"
between = ["ground", "a"]
at = [[0.0, 0.0], "centre"]
friction = { sliding = "one" }

[joints.q]
type = "revolute"
between = ["ground", "b"]
at = [[0.0, 0.0], "centre"]
friction = { sliding = 2.0 }

[joints.c]
type = "revolute"
between = ["a", "b"]
at = ["centre", "centre"]
friction = { sliding = 0.5 }

[forces.drive]
type = "torque"
body = "a"
torque = "t"
"""


@pytest.mark.by_turns(6)
@pytest.mark.slow
@pytest.mark.parametrize("steps", [TIGHT, {"integrator": "picard"}], ids=["dop853", "picard"])
@pytest.mark.parametrize(("one", "time", "rate"), [(1.5, 2.0, 1.0), (0.0, 0.5, 1.0), ("2 - t/4", 2.0, 1.25)])
def test_two_brakes_and_a_clutch_that_hold_two_wheels(
    one: Any, time: float, rate: float, steps: dict[str, Any]
) -> None:
    """The first wheel slips where its brake and the clutch together hold no more: one + 0.5 = t."""
    result = model(RING).simulate(until=3.0, inputs={"one": one}, **steps)
    slips = dict(times_of(result))
    assert set(slips) == {"p.slip", "c.slip"}
    assert slips["c.slip"] == pytest.approx(time, abs=1e-7)
    assert result["a.omega"][-1] == pytest.approx(rate * (3.0 - time) ** 2 / 2.0 / 2.0, abs=1e-8)
    assert result["b.omega"][-1] == 0.0
