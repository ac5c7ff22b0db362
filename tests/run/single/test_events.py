"""Events of runs: where they are found, what resets do, when they accumulate. References share no code with symgen."""

import math
from types import SimpleNamespace

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.optimize import brentq
from scipy.special import ellipkinc
from support.emitted import mechanism_of

import symgen
from symgen.base.errors import InputError
from symgen.base.settings import Settings
from symgen.describe.files.builder import MechanismBuilder, to_toml
from symgen.describe.files.validate import validate
from symgen.run.effects.effects import impulse_along
from symgen.run.integrators import INTEGRATORS
from symgen.run.layout.probe import rate_function
from symgen.run.planning.prepare import prepare
from symgen.study.stress.study import stress

G, E = 9.81, 0.7
FIRST = math.sqrt(2.0 / G)  # a fall of 1 m
BALL = {
    "mechanism": {"name": "ball", "gravity": [0.0, -G]},
    "run": {"until": 5.0, "step": 1e-2},
    "bodies": {"ball": {"type": "point", "mass": 1.3, "position": [0.0, 1.0]}},
}
BOUNCE = {"impact": {"when": "ball.y < 0", "reset": {"ball.vy": f"-{E}*ball.vy"}}}


def ball(**events):
    return symgen.load(mechanism_of({**BALL, "events": events}))


def times_of(result, name):
    return np.array([event.t for event in result.events if event.name == name])


# -- where events are --------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("integrator", "step"), [("rk4", 1e-2), ("rk4", 0.3), pytest.param("dop853", None, marks=pytest.mark.slow)]
)
def test_a_ball_bounces_until_its_impacts_accumulate(integrator, step):
    result = ball(**BOUNCE).simulate(method="lagrange", integrator=integrator, step=step)
    found = times_of(result, "impact")
    flights = 2.0 * FIRST * E ** np.arange(len(found))
    expected = FIRST + np.concatenate([[0.0], np.cumsum(flights[1:])])
    np.testing.assert_allclose(found, expected, rtol=0.0, atol=1e-12)
    np.testing.assert_allclose(found[:2], [0.4515236409857, 1.083656738366], rtol=0.0, atol=1e-12)
    end = FIRST * (1.0 + 2.0 * E / (1.0 - E))
    assert abs(end - 2.558633965586) < 1e-12
    assert abs(result.accumulation - end) < 1e-9
    assert result.status == "failed" and result.reason.startswith("events of 'impact' accumulate at t = 2.5586339655")
    assert result.end < end and end - result.end < 1e-8 and result.t[-1] == result.end


@pytest.mark.parametrize("jumps", [False, True])
@pytest.mark.parametrize(("integrator", "step"), [("rk4", 2e-2), ("rk4", 5e-2), ("dop853", None)])
def test_what_conditions_of_two_parts_leave_out_for_a_moment_of_a_step(integrator, step, jumps):
    """The parts are straight lines over time; where an input jumps at the same time, g is 0 at the end of a step."""
    late = 0.179916
    drawn = {
        "mechanism": {"name": "cart", "gravity": [0.0, 0.0]},
        "bodies": {"cart": {"type": "point", "mass": 1.0, "position": [0.0, 0.0], "velocity": [1.0, 0.0]}},
        "inputs": {"push": 0.0},
        "forces": {"push": {"type": "force", "body": "cart", "force": [0.0, "push"]}},
        "events": {
            f"{name}{k}": {"when": when}
            for k, x in enumerate((0.162, 0.178, 0.1799))
            for name, when in (("gap", f"cart.x < {x} or t > {late}"), ("peak", f"cart.x > {x} and t < {late}"))
        },
    }
    given = {"push": f"1 if t < {late} else -1"} if jumps else {}
    cart = symgen.load(mechanism_of(drawn))
    result = cart.simulate(method="lagrange", integrator=integrator, step=step, until=1.0, inputs=given)
    found = {event.name: event.t for event in result.events}
    assert len(result.events) == len(found)
    expected = {"gap0": late, "gap1": late, "gap2": late, "peak0": 0.162, "peak1": 0.178, "peak2": 0.1799}
    assert found == pytest.approx(expected, rel=0.0, abs=1e-12)


@pytest.mark.parametrize(("floor", "bounce"), [(1.0, 0.7), (100.0, 0.5), (-0.55, 0.1), (1.0, 1e-9)])
@pytest.mark.parametrize("integrator", ["rk4", "dop853"])
def test_impacts_accumulate_on_a_floor_that_is_not_at_zero(integrator, floor, bounce):
    """Height is known to fewer digits there, and to none that tell the last rebounds from the floor."""
    raw = {**BALL, "bodies": {"ball": BALL["bodies"]["ball"] | {"position": [0.0, floor + 1.0]}}}
    impact = {"when": f"ball.y < {floor}", "reset": {"ball.vy": f"-{bounce}*ball.vy"}}
    result = symgen.load(mechanism_of(raw)).simulate(
        method="lagrange", integrator=integrator, step=1e-2, events={"impact": impact}
    )
    found = times_of(result, "impact")
    flights = 2.0 * FIRST * bounce ** np.arange(len(found))
    expected = FIRST + np.concatenate([[0.0], np.cumsum(flights[1:])])
    assert result.status == "failed" and result.reason.startswith("events of 'impact' accumulate at t = ")
    # an impact is known to the height's rounding over the speed: at the last one, the slowest, a thousandth of a flight
    np.testing.assert_allclose(found, expected, rtol=0.0, atol=1e-3 * flights[-1] + 1e-14 * max(1.0, abs(floor)))
    end = FIRST * (1.0 + 2.0 * bounce / (1.0 - bounce))
    told = 1e-2 if len(found) > 2 else 1.0  # a single impact says nothing of what follows
    assert abs(result.accumulation - end) < told * (end - found[-1]) + 1e-12


@pytest.mark.parametrize("settings", [{"integrator": "rk4", "step": 0.03}, {"integrator": "dop853"}], ids=str)
@pytest.mark.parametrize("when", ["ball.vy + 2.5", "ball.vy < -2.5", "2.5 + ball.vy < 0 and t > 0.1"])
def test_a_speed_that_is_set_back_where_it_is_met_is_met_again_and_again(when, settings):
    """A falling ball is slowed to 1 m/s whenever it has 2.5: the reset takes the event's function away from zero."""
    model = ball(brake={"when": when, "reset": {"ball.vy": "-1"}}, felt={"when": when, "action": "record"})
    result = model.simulate(method="lagrange", until=1.0, **settings)
    expected = np.arange(2.5, 1.0 * G, 1.5) / G
    assert result.ok and len(expected) == 5
    for name in ("brake", "felt"):
        np.testing.assert_allclose(times_of(result, name), expected, rtol=0.0, atol=1e-12)
    np.testing.assert_allclose(result["ball.vy"][-1], 1.5 * len(expected) - G, rtol=0.0, atol=1e-11)


def test_energy_that_impacts_take_is_work():
    result = ball(**BOUNCE).simulate(method="lagrange", until=2.0)
    assert result.ok and len(result.events) == 4
    lost = sum(event.work for event in result.events)
    m, height = 1.3, 1.0
    np.testing.assert_allclose(lost, -m * G * height * (1.0 - E**8), rtol=1e-12)
    np.testing.assert_allclose(result.work[-1], lost, rtol=1e-12)
    assert np.abs(result.energy_error).max() < 1e-12
    first = result.events[0]
    assert first.action == "reset" and first.v_after["ball.vy"] == pytest.approx(E * math.sqrt(2.0 * G), rel=1e-12)
    np.testing.assert_allclose(first.impulses["ball.vy"], m * (1.0 + E) * math.sqrt(2.0 * G), rtol=1e-12)


def test_the_state_behind_a_reset_that_ends_a_run_has_its_energy():
    """Reset and stop at the same time: the last output is that behind the blow, and so is the balance of energy."""
    land = {"when": "ball.y < 0", "action": "stop"}
    result = ball(**BOUNCE, land=land).simulate(method="lagrange", integrator="rk4", step=1e-2)
    m, speed = 1.3, math.sqrt(2.0 * G)
    assert result.ok and result.t[-1] == result.end == result.events[0].t
    np.testing.assert_allclose(result["ball.vy"][-1], E * speed, rtol=1e-12)
    np.testing.assert_allclose(result.kinetic[-1], 0.5 * m * (E * speed) ** 2, rtol=1e-12)
    np.testing.assert_allclose(result.work[-1], 0.5 * m * speed**2 * (E * E - 1.0), rtol=1e-12)
    assert abs(result.energy_error[-1]) < 1e-12 * m * G


@pytest.mark.parametrize("integrator", ["rk4", "dop853"])
def test_many_resets_at_once_are_no_heap(integrator):
    """Sixty of them that ask for the same, at one time: the ball goes on as after one."""
    many = {f"impact{i}": BOUNCE["impact"] for i in range(60)}
    result = ball(**many).simulate(method="lagrange", integrator=integrator, step=1e-2, until=1.2)
    assert (result.status, result.reason) == ("ok", None) and len(result.events) == 120
    for name in ("impact0", "impact59"):
        np.testing.assert_allclose(times_of(result, name), [FIRST, FIRST * (1 + 2 * E)], rtol=0.0, atol=1e-12)


@pytest.mark.parametrize(("times", "each", "steps"), [(30, 10, 5), (101, 1, 2), (300, 1, 3), (1, 300, 3)])
def test_a_step_with_more_events_than_there_is_room_for_loses_none(times, each, steps):
    """Some events at each of some times in one step, and behind them the impact; up to the room of notes it is one."""
    moments = np.linspace(0.1, 0.4, times)
    noted = {f"at{k}x{i}": {"when": f"t > {t!r}"} for k, t in enumerate(moments.tolist()) for i in range(each)}
    result = ball(**noted, **BOUNCE).simulate(method="lagrange", integrator="rk4", step=0.5, until=0.5)
    assert result.ok and result.steps <= steps and len(result.events) == times * each + 1
    expected = [*np.repeat(moments, each), FIRST]
    np.testing.assert_allclose([event.t for event in result.events], expected, rtol=0.0, atol=1e-12)
    after = 0.5 - FIRST
    np.testing.assert_allclose(result["ball.y"][-1], E * math.sqrt(2.0 * G) * after - 0.5 * G * after**2, atol=1e-12)


def spinning():
    rod = {"mass": 1.2, "inertia": 0.1, "points": {"A": [-0.5, 0.0]}, "position": [0.0, -0.5], "angle": "-pi/2"}
    return symgen.load(
        mechanism_of(
            {
                "mechanism": {"name": "rod", "gravity": [0.0, -G]},
                "run": {"until": 3.0, "step": 1e-3},
                "bodies": {"rod": rod | {"angular_velocity": 9.0}},
                "joints": {"pin": {"type": "revolute", "between": ["ground", "rod"], "at": [[0.0, 0.0], "A"]}},
            }
        )
    )


def test_a_rod_passes_a_turn_where_the_elliptic_integral_says():
    # (I + m l^2) th'' = -m g l sin th: t = (2 / w0) F(th / 2, k^2), k = 2 W / w0
    square = 1.2 * G * 0.5 / (0.1 + 1.2 * 0.25)
    whole = 2.0 / 9.0 * ellipkinc(math.pi, 4.0 * square / 81.0)
    settings = {"integrator": "dop853", "rtol": 1e-13, "atol": 1e-13, "times": [1.0]}
    result = spinning().simulate(stop_when="rod.theta > 1.5*pi", **settings)
    assert result.ok and result.end == result.t[-1] == result.events[0].t
    np.testing.assert_allclose(result.end, whole, rtol=0.0, atol=1e-12)
    assert result["rod.theta"][-1] > 1.5 * math.pi > result["rod.theta"][-1] - 1e-13
    assert result.notes[-1] == f"stopped at t = {result.end:.13g} s by the event 'rod.theta > 1.5*pi'"


def falling_rod(**events):
    """A rod that falls from rest about its end: omega^2 = 2 m g l sin(-theta) / (I + m l^2), theta from 0 on."""
    rod = {"mass": 1.2, "inertia": 0.1, "points": {"A": [-0.5, 0.0]}, "position": [0.5, 0.0]}
    pin = {"type": "revolute", "between": ["ground", "rod"], "at": [[0.0, 0.0], "A"]}
    raw = {"mechanism": {"name": "falling-rod", "gravity": [0.0, -G]}, "bodies": {"rod": rod}, "joints": {"pin": pin}}
    return symgen.load(mechanism_of({**raw, "events": events}))


@pytest.mark.parametrize("method", ["lagrange", "augmented-hamiltonian"])
def test_accelerations_are_those_of_the_motion_whatever_a_method_integrates(method):
    """A speed that is passed once is met once; a rod that hardly rebounds from a stop rests on it."""
    settings = {"method": method, "integrator": "rk4", "step": 1e-3, "max_violation": 1e-3}
    square = 2.0 * 1.2 * G * 0.5 / (0.1 + 1.2 * 0.25)
    passed = {"when": "rod.omega < -1", "reset": {"rod.omega": "rod.omega"}}
    result = falling_rod(passed=passed).simulate(until=0.2, **settings)
    assert result.ok and len(result.events) == 1
    np.testing.assert_allclose(result.events[0].q["rod.theta"], -math.asin(1.0 / square), rtol=1e-6)
    stop = {"when": "rod.theta < -0.3", "reset": {"rod.omega": "-1e-9*rod.omega"}}
    result = falling_rod(stop=stop).simulate(until=0.5, **settings)
    assert len(result.events) == 1 and result.reason.startswith("events of 'stop' accumulate at t = ")
    np.testing.assert_allclose(result.events[0].v["rod.omega"], -math.sqrt(square * math.sin(0.3)), rtol=1e-6)


def test_rates_are_those_behind_a_closer_look_where_a_pivot_is_suspicious():
    def wrong(t, y, p, w, iw, rate):
        rate[:] = math.nan
        return 1

    def right(t, y, p, w, iw, rate):
        rate[:] = y + t
        return 0

    y = np.array([1.0, 2.0])
    for law in (
        SimpleNamespace(rhs=wrong, confirm=right),
        SimpleNamespace(rhs=right),
        SimpleNamespace(rhs=wrong, rates=right),
    ):
        rate = np.zeros(2)
        rate_function(SimpleNamespace(law_module=law))(3.0, y, None, None, None, rate)
        np.testing.assert_array_equal(rate, [4.0, 5.0])


#: From rest at angle 0: theta = (t^2/2 - t^3/3)/0.35 where the push is 1, back at 0 at t = 3/2; and its mirror image.
AT_ZERO = {
    "mechanism": {"name": "at-zero"},
    "parameters": {"push": 1.0},
    "bodies": {"a": {"mass": 1.0, "inertia": 0.1, "points": {"o": [-0.5, 0.0]}, "position": [0.5, 0.0]}},
    "joints": {"p": {"type": "revolute", "between": ["ground", "a"], "at": [[0.0, 0.0], "o"]}},
    "forces": {"u": {"type": "torque", "body": "a", "torque": "push*(1 - 2*t)"}},
}
BACK = 1.5


@pytest.mark.parametrize("push", [1.0, -1.0])
@pytest.mark.parametrize(
    ("integrator", "step", "coordinates"),
    [
        *[("picard", None, "absolute"), ("picard", None, "joint"), ("dop853", None, "absolute")],
        *[("rk4", 1e-2, "joint"), ("radau5", None, "absolute"), ("abm", None, "absolute")],
    ],
)
def test_what_leaves_zero_at_the_start_crosses_nothing_until_it_comes_back(integrator, step, coordinates, push):
    whens = {"angle": "a.theta", "side": "a.theta > 0", "height": "a.y", "cube": "a.theta**3"}
    events = {
        f"{name}_{direction}": {"when": when, "direction": direction}
        for name, when in whens.items()
        for direction in ("rising", "falling", "any")
        if name != "side"
    }
    events["side"] = {"when": whens["side"]}
    model = symgen.load(mechanism_of({**AT_ZERO, "events": events}))
    settings = {"integrator": integrator, "step": step, "coordinates": coordinates, "parameters": {"push": push}}
    result = model.simulate(until=2.0, verify=False, **settings)
    way = "falling" if push > 0.0 else "rising"
    names = {f"{name}_{k}" for name in ("angle", "height", "cube") for k in (way, "any")}
    names |= {"side"} if push < 0.0 else set()
    assert result.status == "ok" and {event.name for event in result.events} == names
    assert len(result.events) == len(names)
    # the root of the cube is known to the cube root of rounding alone
    for event in result.events:
        assert abs(event.t - BACK) < (1e-4 if "cube" in event.name else 1e-7)


@pytest.mark.parametrize("direction", ["rising", "falling", "any"])
def test_stops_and_resets_that_start_at_zero_wait_for_a_crossing(direction):
    turn = {"turn": {"when": "a.theta", "direction": direction, "reset": {"a.omega": "-a.omega/2"}}}
    stop = {"stop": {"when": "a.theta", "direction": direction, "action": "stop"}}
    for events in (turn, stop):
        result = symgen.load(mechanism_of({**AT_ZERO, "events": events})).simulate(until=1.6)
        assert result.status == "ok"
        if direction == "rising":
            assert result.events == () and result.end == 1.6
        else:
            assert [event.t for event in result.events] == pytest.approx([BACK], abs=1e-7)
            assert result.end == (1.6 if "turn" in events else result.events[0].t)
    free, met = (1.6 - 1.6**2) / 0.35, (BACK - BACK**2) / 0.35
    expected = free if direction == "rising" else free - 1.5 * met
    turned = symgen.load(mechanism_of({**AT_ZERO, "events": turn})).simulate(until=1.6)
    assert turned["a.omega"][-1] == pytest.approx(expected, abs=1e-6)


@pytest.mark.parametrize("when", ["t > 0.1234", "sin(t) > sin(0.1234)", "not t < 0.1234", "t > 0.1 and t > 0.1234"])
def test_a_run_stops_inside_a_constant_step(when):
    result = spinning().simulate(integrator="rk4", step=1e-2, stop_when=when)
    assert result.ok and abs(result.end - 0.1234) < 1e-15
    np.testing.assert_array_equal(result.t, [*(1e-2 * np.arange(13)), result.end])
    whole = spinning().simulate(integrator="rk4", step=1e-2)
    np.testing.assert_array_equal(result.q.values[:-1], whole.q.values[:13])  # as if nothing had been asked for
    short = spinning().simulate(integrator="rk4", step=1e-2, until=result.end)
    np.testing.assert_allclose(result.q.values[-1], short.q.values[-1], rtol=1e-15)  # one digit of the step apart


def test_outputs_behind_an_event_are_those_behind_it():
    settings = {"method": "lagrange", "step": 0.3, "output_step": 0.01}  # many outputs inside a step
    found = ball(**BOUNCE).simulate(until=1.0, **settings)
    after = found.t > FIRST
    speed = E * math.sqrt(2.0 * G)
    expected = speed * (found.t - FIRST) - 0.5 * G * (found.t - FIRST) ** 2
    np.testing.assert_allclose(found["ball.y"][after], expected[after], rtol=0.0, atol=1e-12)
    stopped = ball(low={"when": "ball.y < 0", "action": "stop"}).simulate(**settings)
    np.testing.assert_allclose(stopped.t, [*np.arange(0.0, FIRST, 0.01), FIRST], rtol=0.0, atol=1e-12)


#: Loops that are sampled, with constant and with adaptive steps; each of the others would have to be compiled first,
#: and stands in the slow test.
SAMPLED = ("rk4", "dop853")


def settings_of(integrator):
    method = {"generalized-alpha": "generalized-alpha", "trapezoidal": "index3-augmented-lagrangian"}
    method |= {"half-explicit": "half-explicit", "phem56": "half-explicit", "rattle": "rattle"}
    method |= {"discrete-gradient": "discrete-gradient", "gauss": "symmetric-projection"}
    settings = {"method": method.get(integrator, "lagrange"), "integrator": integrator}
    return settings if INTEGRATORS.get(integrator).adaptive else settings | {"step": 2e-3}


def symplectic_impacts(h):
    """Return when a ball that the symplectic Euler scheme drops from 1 m meets the ground, twice.

    n steps of h and one of s end at y = y0 + v t - g/2 (t^2 + n h^2 + s^2), t = n h + s; speeds are exact, v - g t. So
    the first impact is early by h/2. A new grid begins at an impact.
    """
    found, start, height, speed = [], 0.0, 1.0, 0.0
    for _ in range(2):

        def left(n, s, height=height, speed=speed):
            return height + speed * (n * h + s) - 0.5 * G * ((n * h + s) ** 2 + n * h * h + s * s)

        n = next(n for n in range(1, 10**6) if left(n + 1, 0.0) <= 0.0)
        t = n * h + brentq(lambda s, n=n: left(n, s), 0.0, h, xtol=1e-15)
        start, height, speed = start + t, 0.0, E * (G * t - speed)
        found.append(start)
    assert abs(found[0] - FIRST + 0.5 * h) < h * h
    return found


def euler_impacts(h):
    """Return when a ball that Euler's scheme drops from 1 m meets the ground, twice.

    n steps of h and one of s end at y = y0 + v t - g/2 (t^2 - n h^2 - s^2), t = n h + s, which is linear in s; speeds
    are exact, v - g t. So the first impact is late by h/2 and the second one by h (1.5 + E), up to what the shortened
    steps change, s (h - s) g/2 in height: of order g h^2 / (8 |v|). A new grid begins at an impact.
    """
    found, start, height, speed = [], 0.0, 1.0, 0.0
    for _ in range(2):
        n = 1
        while height + speed * n * h - 0.5 * G * h * h * n * (n - 1) > 0.0:
            n += 1
        n -= 1  # whole steps before the one that meets the ground
        s = (height + speed * n * h - 0.5 * G * h * h * n * (n - 1)) / (G * n * h - speed)
        t = n * h + s
        start, height, speed = start + t, 0.0, E * (G * t - speed)
        found.append(start)
    assert abs(found[0] - FIRST - 0.5 * h) < h * h and abs(found[1] - FIRST * (1 + 2 * E) - h * (1.5 + E)) < 2 * h * h
    return found


@pytest.mark.by_turns(8)
@pytest.mark.parametrize(
    "integrator",
    [name if name in SAMPLED else pytest.param(name, marks=pytest.mark.slow) for name in INTEGRATORS.names],
)
def test_integrators_find_events(integrator):
    # constant acceleration is integrated exactly by all but Euler's schemes, whose truncation is known in closed form,
    # and steps of order 1 at the start of abm and bdf
    tolerance = {"abm": 1e-9, "bdf": 1e-7}.get(integrator, 1e-11)
    truncated = {"euler": euler_impacts, "symplectic-euler": symplectic_impacts}
    expected = truncated[integrator](2e-3) if integrator in truncated else [FIRST, FIRST * (1 + 2 * E)]
    found = ball(**BOUNCE).simulate(until=1.2, max_energy_error=10.0, **settings_of(integrator))
    np.testing.assert_allclose(times_of(found, "impact"), expected, rtol=0.0, atol=tolerance)
    # what is only noted changes nothing, to the last bit, but that the long steps of picard may be divided to see it
    conditions = ["rod.theta > 0", "rod.omega < 7 + 2*sin(60*t)"]
    settings = {**settings_of(integrator), "until": 0.5, "max_violation": 1e-2, "max_energy_error": 1.0}
    plain, noted = spinning().simulate(**settings), spinning().simulate(record_when=conditions, **settings)
    assert len(times_of(noted, conditions[0])) == 1 and len(times_of(noted, conditions[1])) >= 2
    for table in ("q", "v"):
        least = 1e-6 if integrator == "picard" else 0.0  # within its tolerance
        np.testing.assert_allclose(getattr(noted, table).values, getattr(plain, table).values, rtol=0.0, atol=least)
    for event in noted.events:
        speed = 7.0 + 2.0 * math.sin(60.0 * event.t) - event.v["rod.omega"]
        value = event.q["rod.theta"] if event.name == conditions[0] else speed
        assert 0.0 <= value < 1e-12


def crossings(functions, until, samples):
    """Return all sign changes of functions of time, in order, by dense sampling."""
    t = np.linspace(0.0, until, samples)
    found = []
    for k, g in enumerate(functions):
        values = g(t)
        for i in np.flatnonzero(values[:-1] * values[1:] < 0.0):
            found.append((brentq(g, t[i], t[i + 1], xtol=1e-14), k, values[i] < 0.0))
    return found


@pytest.mark.parametrize("seed", range(3))
def test_no_crossing_that_is_wider_than_a_step_is_missed(seed):
    rng, h, until = np.random.default_rng(seed), 0.02, 6.0
    texts, functions = [], []
    for _ in range(6):
        (a, b), (u, v) = rng.uniform(5.0, 60.0, 2), rng.uniform(0.0, 6.0, 2)
        c = rng.uniform(-1.0, 1.0)
        texts.append(f"sin({a}*ball.x + {u}) + 0.8*sin({b}*ball.x + {v}) - {c}".replace("- -", "+ "))
        functions.append(lambda t, a=a, b=b, u=u, v=v, c=c: np.sin(a * t + u) + 0.8 * np.sin(b * t + v) - c)
    moving = {**BALL, "bodies": {"ball": {"type": "point", "mass": 1.0, "velocity": [1.0, 0.0]}}}
    events = {f"g{k}": {"when": text} for k, text in enumerate(texts)}
    model = symgen.load(mechanism_of({**moving, "events": events}))
    result = model.simulate(method="lagrange", integrator="rk4", step=h, until=until)
    expected = crossings(functions, until, 200_000)
    found = {k: times_of(result, f"g{k}") for k in range(6)}
    wide = 0
    for k in range(6):
        own = np.array([t for t, j, _ in expected if j == k])
        gaps = np.diff(np.concatenate([[-1.0], own, [until + 1.0]]))
        lonely = own[(gaps[:-1] > h) & (gaps[1:] > h)]
        assert all(np.abs(found[k] - t).min() < 1e-11 for t in lonely)
        assert all(np.abs(own - t).min() < 1e-11 for t in found[k])  # and none that is not there
        wide += len(lonely)
    assert wide > 300
    total = sum(len(x) for x in found.values())
    assert total >= 0.98 * len(expected)  # most of those that lie both inside one step are found by their extremum


def test_an_excursion_inside_one_step_is_found():
    # up 5 m at most at t = 1; 1 mm below that for 29 ms, in the middle of a step of 0.8 s
    thrown = {**BALL, "bodies": {"ball": {"type": "point", "mass": 1.0, "velocity": [0.0, G]}}}
    event = {"when": f"ball.y - {0.5 * G - 1e-3}"}
    model = symgen.load(mechanism_of({**thrown, "events": {"high": event}}))
    half = math.sqrt(2e-3 / G)
    for direction, expected in (("any", [1 - half, 1 + half]), ("rising", [1 - half]), ("falling", [1 + half])):
        events = {direction: event | {"direction": direction}}
        result = model.simulate(method="lagrange", integrator="rk4", step=0.8, until=1.6, events=events)
        np.testing.assert_allclose(times_of(result, direction), expected, rtol=0.0, atol=1e-12)


def test_conditions_are_put_together():
    events = {
        "both": {"when": "t > 0.2 and ball.y < 0.7"},
        "either": {"when": "t > 0.3 or ball.y < 0.7"},
        "neither": {"when": "not (t > 0.3 or ball.y < 0.7)"},
        "ends": {"when": "t < 0.31", "direction": "falling"},
    }
    result = ball(**events).simulate(method="lagrange", until=0.4)
    low = math.sqrt(0.6 / G)
    assert [event.name for event in result.events] == ["both", "either", "ends"]
    np.testing.assert_allclose([event.t for event in result.events], [low, low, 0.31], rtol=0.0, atol=1e-12)


# -- what resets do ----------------------------------------------------------------------------------------------------

#: Lengths, masses, inertias about the centres of mass in the middle, and where the bars of the four-bar stand.
BARS = {"crank": (0.4, 1.0, 0.02), "coupler": (1.1, 2.0, 0.2), "rocker": (0.8, 1.5, 0.1)}


def four_bar(**events):
    bodies = {}
    for name, (length, mass, inertia) in BARS.items():
        points = {"A": [-0.5 * length, 0.0], "B": [0.5 * length, 0.0]}
        bodies[name] = {"mass": mass, "inertia": inertia, "points": points}
    bodies["crank"] |= {"position": [0.1, 0.17], "angle": 1.0, "angular_velocity": 5.0}
    bodies["coupler"] |= {"position": [0.7, 0.55], "angle": 0.35}
    bodies["rocker"] |= {"position": [1.1, 0.37], "angle": 1.8}
    pins = {
        "a": ("ground", "crank", [0.0, 0.0], "A"),
        "b": ("crank", "coupler", "B", "A"),
        "c": ("coupler", "rocker", "B", "B"),
        "d": ("ground", "rocker", [1.0, 0.0], "A"),
    }
    joints = {n: {"type": "revolute", "between": [i, j], "at": [p, q]} for n, (i, j, p, q) in pins.items()}
    return symgen.load(
        mechanism_of(
            {
                "mechanism": {"name": "struck", "gravity": [0.0, -G]},
                "run": {"until": 0.5, "step": 1e-3},
                "bodies": bodies,
                "joints": joints,
                "events": events,
            }
        )
    )


def jacobian(q):
    """Return D of the four pins by hand; a point at s along a bar moves by (-s sin th, s cos th) times th'."""
    turned = {name: q[3 * i + 2] for i, name in enumerate(BARS)}
    ends = {name: 0.5 * BARS[name][0] * np.array([-math.sin(x), math.cos(x)]) for name, x in turned.items()}
    d = np.zeros((8, 9))
    for row, (first, second) in enumerate(
        (
            (None, ("crank", -1)),
            (("crank", 1), ("coupler", -1)),
            (("coupler", 1), ("rocker", 1)),
            (None, ("rocker", -1)),
        )
    ):
        for sign, point in ((-1.0, first), (1.0, second)):
            if point is not None:
                at = 3 * list(BARS).index(point[0])
                d[2 * row : 2 * row + 2, at : at + 2] += sign * np.eye(2)
                d[2 * row : 2 * row + 2, at + 2] += sign * point[1] * ends[point[0]]
    return d


@pytest.mark.slow_cases("joint")
@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
def test_a_blow_on_a_four_bar_is_that_of_the_equations_of_impact(coordinates):
    event = {"when": "t > 0.2", "reset": {"coupler.omega": "1.5 - 0.4*coupler.omega"}}
    result = four_bar(blow=event).simulate(integrator="rk4", until=0.4, coordinates=coordinates)
    assert result.ok and result.coordinates == coordinates
    blow = result.events[0]
    q, v, after = (np.array(list(x.values())) for x in (blow.q, blow.v, blow.v_after))
    mass = np.diag([x for _, m, i in BARS.values() for x in (m, m, i)])
    rows = np.vstack([jacobian(q), np.eye(9)[5]])
    kkt = np.block([[mass, rows.T], [rows, np.zeros((9, 9))]])
    solved = np.linalg.solve(kkt, np.concatenate([mass @ v, np.zeros(8), [1.5 - 0.4 * v[5]]]))
    np.testing.assert_allclose(after, solved[:9], rtol=0.0, atol=1e-12 * np.abs(v).max())
    np.testing.assert_allclose(after[5], 1.5 - 0.4 * v[5], rtol=4e-16)  # a velocity of the state: to the last digit
    impulses = np.array(list(blow.impulses.values()))
    np.testing.assert_allclose(impulses[:8], solved[9:17], rtol=0.0, atol=1e-11)  # D^T Lambda on the left, as lambda
    np.testing.assert_allclose(impulses[8], -solved[17], rtol=0.0, atol=1e-11)
    np.testing.assert_allclose(blow.work, 0.5 * (after @ mass @ after - v @ mass @ v), rtol=0.0, atol=1e-12)
    assert result.velocity_violation_max < 1e-12
    assert np.abs(result.energy_error).max() < 1e-6 and abs(blow.work) > 0.1


@pytest.mark.parametrize("shape", ["straight", pytest.param("looped", marks=pytest.mark.slow)])
def test_a_body_in_space_is_struck_about_one_of_its_axes(shape):
    tensor = np.array([[0.02, 0.001, 0.002], [0.001, 0.03, -0.0015], [0.002, -0.0015, 0.015]])
    spin = [3.0, -1.0, 2.0]
    raw = {
        "mechanism": {"name": "stone", "space": "spatial"},
        "run": {"until": 0.4, "step": 1e-3},
        "bodies": {"stone": {"mass": 2.0, "inertia": tensor.tolist(), "angular_velocity": spin}},
        "events": {"blow": {"when": "t > 0.1", "reset": {"stone.wx": "0.5*stone.wx + 1", "stone.vy": "2"}}},
    }
    result = symgen.load(mechanism_of(raw)).simulate(method="lagrange", shape=shape)
    blow = result.events[0]
    before = np.array([blow.v[f"stone.w{axis}"] for axis in "xyz"])
    # no moment but one about x acts: I (w+ - w) = (mu, 0, 0)
    change = np.linalg.solve(tensor, [1.0, 0.0, 0.0])
    expected = before + change * (0.5 * before[0] + 1.0 - before[0]) / change[0]
    after = np.array([blow.v_after[f"stone.w{axis}"] for axis in "xyz"])
    np.testing.assert_allclose(after, expected, rtol=0.0, atol=1e-13)
    assert [blow.v_after[f"stone.v{axis}"] for axis in "xyz"] == pytest.approx([0.0, 2.0, 0.0], abs=1e-15)
    assert result.ok and np.abs(result.energy_error).max() < 1e-9


@pytest.mark.parametrize(
    ("settings", "tolerance"),
    [
        pytest.param({"integrator": "abm4", "step": 2e-4}, 1e-9, marks=pytest.mark.slow),
        ({"integrator": "rk4", "step": 2e-4}, 1e-10),
        pytest.param({"integrator": "abm", "rtol": 1e-11, "atol": 1e-11}, 1e-8, marks=pytest.mark.slow),
    ],
)
def test_methods_with_memory_begin_anew_behind_a_reset(settings, tolerance):
    # a pendulum that a wall throws back, against SciPy's integrator with its own events
    event = {"when": "rod.theta > 0.9", "reset": {"rod.omega": "-0.3*rod.omega"}}
    model, square = spinning(), 1.2 * G * 0.5 / (0.1 + 1.2 * 0.25)

    def rate(t, y):
        return [y[1], -square * math.cos(y[0])]

    def wall(t, y):
        return y[0] - 0.9

    wall.terminal, wall.direction = True, 1.0
    t, y, expected = 0.0, [-0.5 * math.pi, 9.0], []
    for _ in range(2):
        found = solve_ivp(rate, (t, 10.0), y, method="DOP853", rtol=1e-13, atol=1e-13, events=wall)
        t, y = found.t[-1], [0.9, -0.3 * found.y[1, -1]]
        expected.append(t)
    result = model.simulate(until=expected[-1] + 0.1, events={"wall": event}, **settings)
    np.testing.assert_allclose(times_of(result, "wall"), expected, rtol=0.0, atol=tolerance)


def test_a_reset_may_make_another_event_happen_at_once():
    events = {**BOUNCE, "up": {"when": "ball.vy > 0", "action": "stop"}}
    result = ball(**events).simulate(method="lagrange")
    assert result.ok and [event.name for event in result.events] == ["impact", "up"]
    assert abs(result.end - FIRST) < 1e-12 and result["ball.vy"][-1] == pytest.approx(E * G * FIRST)


def test_a_ball_that_does_not_come_up_again_gathers_at_once():
    result = ball(stuck={"when": "ball.y < 0", "reset": {"ball.vy": "0"}}).simulate(method="lagrange")
    assert result.status == "failed" and result.reason.startswith("events of 'stuck' accumulate at t = 0.45152364098")


def test_rows_that_are_rounding_take_no_impulse():
    """As those of a joint that is written twice are in joint coordinates."""
    mass, v = np.diag([1.0, 2.0, 3.0]), np.array([0.3, -0.2, 0.1])
    asked = np.array([[1.0, 0.0, 0.0], [1.0, 1.0, 0.0]])
    noise = np.array([[0.0, 1e-17, -2e-17], [3e-17, 0.0, 1e-17]])
    alone, _, _ = impulse_along(mass, asked, np.array([0.5, 0.4]), v)
    found, impulses, contradictory = impulse_along(mass, np.vstack([noise, asked]), np.array([0.0, 0.0, 0.5, 0.4]), v)
    np.testing.assert_allclose(found, alone, rtol=0.0, atol=1e-14)
    np.testing.assert_allclose(alone, [0.5, -0.1, 0.1], rtol=0.0, atol=1e-14)
    assert not contradictory and not impulses[:2].any()


@pytest.mark.slow_cases("joint")
@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
def test_contradictory_velocities_are_refused_with_the_nearest_that_joints_allow(coordinates):
    """Those of a four-bar are on a line through 0: the foot of the perpendicular on it is nearest."""
    event = {"when": "t > 0.2", "reset": {"crank.omega": "2", "rocker.omega": "50"}}
    result = four_bar(blow=event).simulate(coordinates=coordinates)
    said = result.reason
    assert result.status == "failed" and said is not None and abs(result.t[-1] - 0.2) < 1e-9
    assert said.startswith("event 'blow': reset: expected velocities that the joints and each other allow, got ")
    assert "crank.omega = 2, rocker.omega = 50 at t = 0.2 s; the nearest are crank.omega = " in said
    before = four_bar().simulate(until=0.2)
    line = np.array([before[name][-1] for name in ("crank.omega", "rocker.omega")])
    nearest = line * (line @ [2.0, 50.0]) / (line @ line)
    numbers = [float(word.split(" = ")[1]) for word in said.partition("nearest are ")[2].split(", ")]
    np.testing.assert_allclose(numbers, nearest, rtol=1e-5)


@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
def test_what_joints_hold_at_rest_has_no_other_velocity_nearby(coordinates):
    built = MechanismBuilder("slide", gravity=(0.0, -9.81)).body("a", mass=1.0, inertia=0.1, velocity=[1.0, 0.0])
    built = built.joint("guide", "translational", between=["ground", "a"], at=[[0.0, 0.0], "centre"], axis=[1.0, 0.0])
    event = {"when": "t > 0.2", "reset": {"a.omega": 0.3}}
    result = symgen.load(built.build()).simulate(until=0.5, events={"hit": event}, coordinates=coordinates)
    assert result.status == "failed"
    assert result.reason.endswith("got a.omega = 0.3 at t = 0.2 s; the nearest are a.omega = 0")


# -- runs with events --------------------------------------------------------------------------------------------------


def test_a_run_with_events_is_left_saved_and_gone_on_with():
    model = ball(**BOUNCE, top={"when": "ball.vy", "direction": "falling"})
    run = prepare(model.mechanism, Settings(method="lagrange", integrator="rk4", step=1e-2, until=2.0))
    whole, first, second = (run.simulation() for _ in range(3))
    nothing = whole.outputs(np.zeros(0))
    whole.enter(nothing)
    first.enter(nothing, pause=70)
    second.restore(first.save())
    second.enter(nothing)
    np.testing.assert_array_equal(second.state.y, whole.state.y)
    together = [e.t for e in first.events.happened] + [e.t for e in second.events.happened]
    assert together == [e.t for e in whole.events.happened] and len(together) > 5


def test_many_events_are_kept():
    result = ball(often={"when": "sin(400*t)"}).simulate(method="lagrange", integrator="rk4", step=1e-3, until=5.0)
    found = times_of(result, "often")
    expected = np.arange(1, math.floor(2000 / math.pi) + 1) * math.pi / 400
    # the resolution of time, 4e-16 |t|, widens by 8 where rounding of g hides the root
    np.testing.assert_allclose(found, expected, rtol=64 * np.finfo(float).eps, atol=1e-14)


def test_both_shapes_find_the_same_events():
    event = {"blow": {"when": "crank.theta > 1.7", "reset": {"rocker.omega": "-0.5*rocker.omega"}}}
    settings = {"integrator": "rk4", "until": 0.5, "record_when": "sin(30*t) < coupler.y"}
    straight, looped = (four_bar(**event).simulate(shape=shape, **settings) for shape in ("straight", "looped"))
    assert [e.name for e in looped.events] == [e.name for e in straight.events] and len(straight.events) >= 2
    np.testing.assert_allclose([e.t for e in looped.events], [e.t for e in straight.events], rtol=0.0, atol=1e-11)
    np.testing.assert_allclose(looped.q.values, straight.q.values, rtol=0.0, atol=1e-10)


def test_a_second_run_vouches_for_one_that_stops():
    result = spinning().simulate(stop_when="rod.theta > 0", verify=True)
    assert result.ok and result.error_estimate < 1e-9
    assert any(note.startswith("verified") for note in result.notes)


def test_json_has_the_events():
    found = ball(**BOUNCE).simulate(method="lagrange", until=1.0, stop_when="ball.vy < -4").to_json()
    assert found["end"] == pytest.approx(4.0 / G) and found["status"] == "ok" and found["accumulation"] is None
    (event,) = found["events"]
    assert (event["name"], event["action"], event["t"]) == ("ball.vy < -4", "stop", found["end"])
    assert event["v"]["ball.vy"] == pytest.approx(-4.0) and found["final"]["t"] == found["end"]


@pytest.mark.parametrize(
    ("event", "said"),
    [
        ({"when": "ball.q < 1"}, "events.x.when: expected a condition or an expression of t"),
        ({"when": "1 < 2"}, "events.x.when: expected a condition that time or motion changes, got '1 < 2'"),
        ({"when": "ball.y == 0"}, "conditions are written with <, <=, > and >="),
        ({"action": "stop"}, "events.x.when: expected a condition such as 'ball.y < 0.1'"),
        ({"when": "t > 1", "action": "jump"}, "events.x.action: expected 'record' or 'stop' or 'reset', got 'jump'"),
        ({"when": "t > 1", "direction": "up"}, "events.x.direction: expected 'rising' or 'falling' or 'any', got 'up'"),
        ({"when": "t > 1", "action": "reset"}, "events.x.reset: expected new velocities or states"),
        ({"when": "t > 1", "action": "stop", "reset": {"ball.vy": "1"}}, "events.x.action: expected 'reset'"),
        ({"when": "t > 1", "reset": {}}, "events.x.reset: expected at least one new value"),
        ({"when": "t > 1", "reset": {"ball.y": "1"}}, "events.x.reset.ball.y: expected the name of a velocity"),
        ({"when": "t > 1", "reset": {"ball.vy": "1 <"}}, "events.x.reset.ball.vy: expected a number or an expression"),
        ({"when": "t > 1", "set": {}}, "got the unknown key 'set'; did you mean 'reset'?"),
    ],
)
def test_bad_events_are_refused_in_one_sentence(event, said):
    with pytest.raises(InputError) as caught:
        ball(x=event)
    assert said in str(caught.value) and "\n" not in str(caught.value)


@pytest.mark.parametrize("name", ["omega", "vx", "wz"])
def test_a_parameter_named_like_a_velocity_is_none(name):
    raw = {
        "mechanism": {"name": "thrown"},
        "parameters": {name: 1.0},
        "bodies": {"ball": {"mass": 1.0, "inertia": 1.0}},
        "events": {"x": {"when": "t > 1", "reset": {name: 2.0}}},
    }
    with pytest.raises(InputError, match=f"events.x.reset.{name}: expected the name of a velocity"):
        validate(raw, "thrown")


def test_bad_conditions_of_a_run_are_refused():
    model = ball()
    for settings, said in (
        ({"stop_when": "ball.z < 1"}, "ball: stop_when: expected a condition"),
        ({"stop_when": 3}, "stop_when: expected a list of names, got 3"),
        ({"events": {"a": "t > 1"}}, "events 'a': expected tables by the names of events"),
        ({"events": {"a": {"when": "t > "}}}, "ball: events.a.when: expected a condition"),
    ):
        with pytest.raises(InputError) as caught:
            model.simulate(**settings)
        assert said in str(caught.value)


def test_studies_refuse_events_that_they_do_not_look_for(tmp_path):
    ends = {"impact": {"when": "ball.y < 0", "action": "stop"}}
    model, file = ball(**ends), tmp_path / "ball.toml"
    file.write_text(to_toml({**BALL, "events": ends}))
    said = "expected a mechanism whose runs no event ends, got the event 'impact'; "
    said += r"without impact in \[events\], or with its action 'record', it is taken"
    with pytest.raises(InputError, match=f"compare: {said}"):
        symgen.compare(model)
    with pytest.raises(InputError, match=f"stress: {said}"):
        stress([str(file)])
    with pytest.raises(InputError, match="'lanes': expected no events, got the event 't > 1', which ends runs"):
        symgen.sweep(ball(), {"ball.vx": [0.0, 1.0]}, method="lagrange", stop_when="t > 1", target="lanes")


def test_a_slow_ball_bounces_beside_a_fast_rod():
    """What a reset gives a slow ball may be less than the rounding of the joint of a rod beside it; 1e-6 is not."""
    random, mass = np.random.default_rng(1), np.diag([2.0, 2.0, 0.2, 0.3])
    values = np.array([0.0, 0.0, -0.7e-9])
    for _ in range(50):
        (x, y), rate = random.uniform(-1.0, 1.0, 2), random.uniform(1.0, 5.0)
        rows = np.array([[1.0, 0.0, -x, 0.0], [0.0, 1.0, -y, 0.0], [0.0, 0.0, 0.0, 1.0]])
        v = np.array([rate * x, rate * y, rate, 1e-9])
        v[:2] *= 1.0 + 4e-16 * random.choice([-1.0, 1.0], 2)
        after, _, contradictory = impulse_along(mass, rows, values, v)
        assert not contradictory
        np.testing.assert_allclose(after, [rate * x, rate * y, rate, -0.7e-9], rtol=0.0, atol=1e-14)
    twice = np.concatenate([rows, [[1.0, 0.0, -x, 0.0]]])
    assert impulse_along(mass, twice, np.array([*values, 1e-6]), v)[2]
