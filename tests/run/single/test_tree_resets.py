"""Resets in joint coordinates: the same blow as in the coordinates of bodies, and as impact equations by hand say."""

import numpy as np
import pytest
from support.emitted import mechanism_of

import symgen
from run.single.test_events import four_bar

#: A solve of a well-conditioned system of a few dozens of numbers of order 1, and what is asked for.
ROUNDING = 1e-12


def skew(a):
    return np.array([[0.0, -a[2], a[1]], [a[2], 0.0, -a[0]], [-a[1], a[0], 0.0]])


def turning(e):
    """Return the matrix of Euler parameters."""
    x = skew(e[1:])
    return np.eye(3) + 2.0 * e[0] * x + 2.0 * x @ x


def impact(mass, rows, values, v):
    """Return velocities and impulses of M (v+ - v) = C^T i, C v+ = c; of least norm where rows repeat each other."""
    n, k = len(v), len(values)
    matrix = np.block([[mass, -rows.T], [rows, np.zeros((k, k))]])
    found = np.linalg.lstsq(matrix, np.concatenate([mass @ v, values]), rcond=None)[0]
    return found[:n], found[n:]


def states(event):
    return (np.array(list(x.values())) for x in (event.q, event.v, event.v_after))


TENSORS = {
    "upper": np.array([[0.2, 0.01, -0.02], [0.01, 0.3, 0.015], [-0.02, 0.015, 0.25]]),
    "lower": np.array([[0.12, -0.01, 0.005], [-0.01, 0.15, 0.02], [0.005, 0.02, 0.1]]),
}
MASSES = {"upper": 2.0, "lower": 1.3}
TOP, END, LOW = np.array([0.1, -0.2, 0.5]), np.array([-0.15, 0.1, -0.4]), np.array([0.2, 0.1, 0.3])


def two_stones(**events):
    """Return two bodies on balls, one below the other; points are off the axes, tensors full."""
    points = {"upper": {"A": TOP.tolist(), "B": END.tolist()}, "lower": {"A": LOW.tolist()}}
    bodies = {
        name: {"mass": MASSES[name], "inertia": TENSORS[name].tolist(), "points": points[name]} for name in MASSES
    }
    bodies["upper"] |= {"position": (-TOP).tolist(), "angular_velocity": [1.0, -0.5, 2.0]}
    bodies["lower"] |= {"position": (END - TOP - LOW).tolist(), "angular_velocity": [0.3, 1.5, -1.0]}
    pins = {"a": ("ground", "upper", [0.0, 0.0, 0.0], "A"), "b": ("upper", "lower", "B", "A")}
    joints = {n: {"type": "spherical", "between": [i, j], "at": [p, q]} for n, (i, j, p, q) in pins.items()}
    raw = {"mechanism": {"name": "stones", "space": "spatial", "gravity": [0.0, 0.0, -9.81]}}
    raw |= {"run": {"until": 0.4, "step": 1e-3}, "bodies": bodies, "joints": joints, "events": events}
    return symgen.load(mechanism_of(raw))


@pytest.mark.slow
def test_a_blow_in_space_on_a_velocity_that_is_none_of_the_state():
    event = {"when": "t > 0.1", "reset": {"lower.vx": "0.5 - lower.vx", "upper.wz": "2*upper.wz"}}
    result = two_stones(blow=event).simulate(until=0.2, coordinates="joint")
    assert result.ok and result.rank.rows == 6
    blow = result.events[0]
    q, v, after = states(blow)
    a, b = turning(q[3:7]), turning(q[10:14])
    mass = np.zeros((12, 12))
    for i, name in enumerate(MASSES):
        mass[6 * i : 6 * i + 3, 6 * i : 6 * i + 3] = MASSES[name] * np.eye(3)
        mass[6 * i + 3 : 6 * i + 6, 6 * i + 3 : 6 * i + 6] = TENSORS[name]
    rows = np.zeros((8, 12))
    rows[:3, :3], rows[:3, 3:6] = np.eye(3), -a @ skew(TOP)
    rows[3:6, :3], rows[3:6, 3:6] = -np.eye(3), a @ skew(END)
    rows[3:6, 6:9], rows[3:6, 9:] = np.eye(3), -b @ skew(LOW)
    rows[6, 6] = rows[7, 5] = 1.0
    assert np.abs(rows[:6] @ v).max() < ROUNDING
    expected, impulses = impact(mass, rows, np.array([0.0] * 6 + [0.5 - v[6], 2.0 * v[5]]), v)
    np.testing.assert_allclose(after, expected, rtol=0.0, atol=ROUNDING * np.abs(v).max())
    signs = np.array([-1.0] * 6 + [1.0] * 2)
    np.testing.assert_allclose(list(blow.impulses.values()), signs * impulses, rtol=0.0, atol=10.0 * ROUNDING)
    np.testing.assert_allclose(blow.work, 0.5 * (after @ mass @ after - v @ mass @ v), rtol=0.0, atol=ROUNDING)
    assert np.abs(result.energy_error).max() < 1e-6


def test_a_blow_where_a_motor_moves_the_tree():
    """The motor keeps its speed: its own impulse does work, and is told with those of the other joints."""
    bar = {"mass": 1.5, "inertia": 0.2, "points": {"A": [-0.5, 0.0], "B": [0.5, 0.0]}}
    raw = {
        "mechanism": {"name": "whip", "gravity": [0.0, -9.81]},
        "run": {"until": 0.4, "step": 1e-3},
        "bodies": {"arm": bar | {"position": [0.5, 0.0]}, "whip": bar | {"position": [1.5, 0.0]}},
        "joints": {
            "hip": {"type": "revolute", "between": ["ground", "arm"], "at": [[0.0, 0.0], "A"]},
            "knee": {"type": "revolute", "between": ["arm", "whip"], "at": ["B", "A"]},
            "motor": {"type": "driver", "body": "arm", "coordinate": "theta", "value": "3*t"},
        },
        "events": {"blow": {"when": "t > 0.2", "reset": {"whip.vy": "1"}}},
    }
    result = symgen.load(mechanism_of(raw)).simulate(coordinates="joint")
    assert result.ok and "arm.theta" not in result.state
    blow = result.events[0]
    q, v, after = states(blow)
    mass, rows = np.diag([1.5, 1.5, 0.2] * 2), np.zeros((6, 6))
    arms = [0.5 * np.array([-np.sin(q[i]), np.cos(q[i])]) for i in (2, 5)]
    rows[:2, :2], rows[:2, 2] = np.eye(2), -arms[0]
    rows[2:4, :2], rows[2:4, 2], rows[2:4, 3:5], rows[2:4, 5] = -np.eye(2), -arms[0], np.eye(2), -arms[1]
    rows[4, 2] = rows[5, 4] = 1.0
    expected, impulses = impact(mass, rows, np.array([0.0] * 4 + [3.0, 1.0]), v)
    np.testing.assert_allclose(after, expected, rtol=0.0, atol=ROUNDING * np.abs(v).max())
    own = dict(zip(("motor.angle", "whip.vy"), impulses[4:] * [-1.0, 1.0], strict=True))
    found = [blow.impulses[next(n for n in blow.impulses if n.startswith("motor"))], blow.impulses["whip.vy"]]
    np.testing.assert_allclose(found, list(own.values()), rtol=0.0, atol=10.0 * ROUNDING)
    np.testing.assert_allclose(blow.work, 0.5 * (after @ mass @ after - v @ mass @ v), rtol=0.0, atol=10.0 * ROUNDING)
    assert np.abs(result.energy_error).max() < 1e-6


def both(model, **settings):
    return [model.simulate(coordinates=c, **settings) for c in ("absolute", "joint")]


#: A velocity of each that a blow changes; `bricard` has a redundant row, `rolling-disc` a nonholonomic one.
STRUCK = {"cart-pole": "pole.omega", "bricard": "rod3.wy", "rolling-disc": "disc.wz", "spatial-slider-crank": "rod.vx"}


@pytest.mark.slow_cases("bricard", "rolling-disc", "spatial-slider-crank")
@pytest.mark.parametrize("name", STRUCK)
def test_the_blow_is_that_of_the_coordinates_of_bodies(name):
    """At the first instant, where both are in one state, and the motions behind it within the integrator's error."""
    model = symgen.load(name)
    speed = STRUCK[name]
    event = {"blow": {"when": "t > 1e-9", "reset": {speed: f"0.5*{speed} + 0.3"}}}
    settings = {
        "events": event,
        "until": 0.1,
        "output_step": 0.02,
        "integrator": "dop853",
        "rtol": 1e-11,
        "atol": 1e-13,
    }
    bodies, joints = both(model, method="direct-correction", **settings)
    assert bodies.ok and joints.ok and joints.velocity_violation_max < 1e-10
    (a,), (b,) = bodies.events, joints.events
    assert abs(a.t - b.t) < 1e-14 and a.v_after.keys() == b.v_after.keys() and a.impulses.keys() == b.impulses.keys()
    for first, second in ((a.v_after, b.v_after), (a.impulses, b.impulses), ({"": a.work}, {"": b.work})):
        x, y = (np.array(list(values.values())) for values in (first, second))
        np.testing.assert_allclose(y, x, rtol=0.0, atol=ROUNDING * max(1.0, np.abs(x).max()))
    for table in ("q", "v"):
        x, y = getattr(bodies, table).values, getattr(joints, table).values
        np.testing.assert_allclose(y, x, rtol=0.0, atol=1e-8 * max(1.0, np.abs(x).max()))


@pytest.mark.by_turns(3)
@pytest.mark.slow
@pytest.mark.parametrize(
    ("method", "integrator"),
    [
        ("augmented-hamiltonian", "rk4"),
        ("lagrange", "abm4"),
        pytest.param("ggl", "radau5", marks=pytest.mark.slow),
        pytest.param("null-space", "rk4", marks=pytest.mark.slow),
        pytest.param("coordinate-partitioning", "abm", marks=pytest.mark.slow),
        pytest.param("generalized-alpha", "generalized-alpha", marks=pytest.mark.slow),
    ],
)
def test_methods_with_memory_begin_anew(method, integrator):
    adaptive = integrator in ("radau5", "abm")
    steps = {"rtol": 1e-10, "atol": 1e-12} if adaptive else {"step": 5e-4}
    event = {"when": "crank.theta > 1.5", "reset": {"rocker.omega": "-0.5*rocker.omega"}}
    model = four_bar(wall=event)
    reference = model.simulate(integrator="dop853", rtol=1e-12, atol=1e-13, until=0.4, output_step=0.1)
    result = model.simulate(
        method=method, integrator=integrator, until=0.4, output_step=0.1, coordinates="joint", **steps
    )
    assert result.ok and len(result.events) == len(reference.events) > 0
    # schemes of second order are off by as much at this step
    limit = 2e-4 if integrator == "generalized-alpha" else 1e-6
    np.testing.assert_allclose(result.q.values, reference.q.values, rtol=0.0, atol=limit)


@pytest.mark.slow
def test_resets_at_the_same_time_and_those_that_contradict():
    events = {
        "one": {"when": "t > 0.1", "reset": {"crank.omega": "2"}},
        "two": {"when": "t > 0.1", "reset": {"rocker.omega": "0.7*rocker.omega"}},
    }
    result = four_bar(**events).simulate(coordinates="joint")
    assert result.status == "failed"
    assert result.reason.startswith("events 'one' and 'two': reset: expected velocities that the joints and each")
    stones = {
        "one": {"when": "t > 0.1", "reset": {"lower.wx": "0"}},
        "two": {"when": "t > 0.1", "reset": {"upper.wy": "1"}},
    }
    bodies, joints = both(two_stones(**stones), until=0.2, integrator="dop853", rtol=1e-11, atol=1e-13)
    assert [e.work != 0.0 for e in joints.events] == [True, False] and len(joints.events) == 2
    for a, b in zip(bodies.events, joints.events, strict=True):
        assert a.impulses.keys() == b.impulses.keys() and b.v_after["lower.wx"] == 0.0
        x, y = (np.array(list(e.v_after.values())) for e in (a, b))
        np.testing.assert_allclose(y, x, rtol=0.0, atol=1e-9)


def test_step_by_step():
    event = {"when": "t > 0.1", "reset": {"coupler.omega": "1.5"}}
    model = four_bar(blow=event)
    run = model.start(coordinates="joint", integrator="rk4", step=1e-3)
    run.run(0.2)
    whole = model.simulate(coordinates="joint", integrator="rk4", step=1e-3, until=0.2)
    assert run.bodies["coupler.x"] == whole["coupler.x"][-1]
    assert run.events[0].v_after["coupler.omega"] == 1.5 and run.events[0].work == whole.events[0].work
    assert [name.partition(".")[0] for name in run.events[0].q] != [n.partition(".")[0] for n in whole.events[0].q]


@pytest.mark.parametrize("times", [(0.4,), (0.05, 0.4)])
def test_a_reset_reads_the_input_of_its_time_wherever_outputs_are(times):
    """The input jumps behind the blow, with no output in between: velocity and impulse are those of before it."""
    rod = {"mass": 1.2, "inertia": 0.1, "points": {"A": [-0.5, 0.0]}, "position": [0.5, 0.0], "angular_velocity": 1.0}
    raw = {
        "mechanism": {"name": "struck-rod", "gravity": [0.0, 0.0]},
        "bodies": {"rod": rod},
        "joints": {"pin": {"type": "revolute", "between": ["ground", "rod"], "at": [[0.0, 0.0], "A"]}},
        "inputs": {"speed": 1.0},
        "events": {"blow": {"when": "t > 0.1", "reset": {"rod.omega": "speed"}}},
    }
    model = symgen.load(mechanism_of(raw))
    settings = {"method": "lagrange", "integrator": "rk4", "step": 1e-2, "until": 0.4, "times": times}
    jump = {"t": [0.0, 0.25], "u": [3.0, 7.0], "interpolation": "hold"}
    result = model.simulate(coordinates="joint", inputs={"speed": jump}, **settings)
    (blow,) = result.events
    assert result.ok and blow.v_after["rod.omega"] == pytest.approx(3.0, rel=1e-12)
    # about the pin: (I + m l^2) (3 - 1)
    assert blow.impulses["rod.omega"] == pytest.approx((0.1 + 1.2 * 0.25) * 2.0, rel=1e-12)
