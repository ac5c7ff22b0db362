"""Starts in which coordinates, velocities and joint coordinates are held, against closed forms and geometry."""

import copy
import math
import tomllib
from pathlib import Path

import numpy as np
import pytest
from support.checks import assert_same_motion
from support.emitted import mechanism_of
from support.models import circles

import symgen
from symgen.base.errors import AssemblyError, InputError
from symgen.run.starts import decisions

DEFECTS = Path(__file__).resolve().parents[2] / "data" / "defects"
CRANK, LINK, ROCKER, PIVOT = 0.05, 0.30, 0.08, np.array([0.3, -0.05])


def raw(name: str = "wiper"):
    with (DEFECTS / f"{name}.toml").open("rb") as file:
        return tomllib.load(file)


def model(tables):
    return symgen.load(mechanism_of(tables))


def started(tables, held=None, method="lagrange", shape="straight"):
    """The values that a start has, by name."""
    found = model(tables)
    compiled = found.compile(method, shape=shape)
    start = found.assemble(compiled, held=held)
    names = [q.name for q in (*compiled.info.coordinates, *compiled.info.velocities)]
    return dict(zip(names, start.y.tolist(), strict=False)), start


def wiper_angles(crank: float, side: float = 1.0) -> tuple[float, float]:
    """Angles of link and arm where two circles meet, about the crank's tip and the arm's pivot."""
    tip = CRANK * np.array([math.cos(crank), math.sin(crank)])
    b = circles(tip, PIVOT, LINK, ROCKER, side)
    link, rocker = b - tip, b - PIVOT
    return math.atan2(link[1], link[0]), math.atan2(-rocker[0], rocker[1])


# -- in the file, from the command line, from Python -------------------------------------------------------------------


HOLDS = [True, ["position", "angle", "velocity"], ["angle"], "angle"]


@pytest.mark.parametrize("hold", HOLDS, ids=str)
def test_the_wiper_starts_at_half_a_radian(hold):
    tables = raw()
    tables["bodies"]["crank"]["hold"] = hold
    q, start = started(tables)
    link, arm = wiper_angles(0.5)
    assert q["crank.theta"] == 0.5
    assert q["link.theta"] == pytest.approx(link, abs=1e-13) and q["arm.theta"] == pytest.approx(arm, abs=1e-13)
    noted = " ".join(start.notes)
    assert "arm.theta from 0 to -0.579327 rad" in noted and "crank.theta" not in noted
    assert "arm.theta from 0 to -0.579327 rad" in start.warnings[0]


def test_a_small_move_is_told_with_the_digits_that_show_it():
    tables = {
        "mechanism": {"name": "hung-rod"},
        "bodies": {
            "rod": {"mass": 1.0, "inertia": 0.1, "points": {"top": [-0.5, 0.0]}, "position": [0.500000002, 0.0]}
        },
        "joints": {"pin": {"type": "revolute", "between": ["ground", "rod"], "at": [[0.0, 0.0], "top"]}},
    }
    _, start = started(tables)
    words = "described positions leave joints open, which the shortest changes close"
    assert start.notes == (f"{words}: rod.x from 0.500000002 to 0.5 m",)


@pytest.mark.slow
def test_what_is_held_is_the_first_output_to_the_last_bit():
    found = model(raw()).simulate(start={"crank.theta": 0.5}, integrator="dop853", until=0.01)
    assert found["crank.theta"][0] == 0.5 and found.start["q"]["crank.theta"] == 0.5
    assert found.to_json()["start"] == found.start
    assert "the start holds crank.theta = 0.5 rad; link.x from 0.19 to " in found.notes[0]
    swept = symgen.sweep(model(raw()), {"crank.omega": [0.0, 1.0]}, start={"crank.theta": 0.5}, until=0.01, times=[0.0])
    assert np.all(swept["crank.theta"][:, 0] == 0.5)
    assert_same_motion(swept["arm.theta"][0], found["arm.theta"][:1])


@pytest.mark.slow
def test_what_the_file_holds_a_sweep_holds():
    tables = raw()
    tables["bodies"]["crank"]["hold"] = "angle"
    single = model(tables).simulate(until=0.01, times=[0.0], step=1e-4)
    swept = symgen.sweep(model(tables), {"drag": [0.5, 0.6]}, until=0.01, times=[0.0], step=1e-4)
    for name in single.q.names:
        assert_same_motion(swept[name][0], single[name])
    # and where it varies it is what it varies over
    swept = symgen.sweep(model(tables), {"crank.theta": [0.3, 0.7]}, until=0.01, times=[0.0], step=1e-4)
    np.testing.assert_array_equal(swept["crank.theta"][:, 0], [0.3, 0.7])


CART = {
    "mechanism": {"name": "cart-pole", "gravity": [0.0, -9.81]},
    "parameters": {"tilt": 0.05},
    "bodies": {
        "cart": {"mass": 1.0, "inertia": 0.1},
        "pole": {"mass": 0.2, "inertia": 0.01, "points": {"foot": [0.0, -0.5]}, "position": [0.0, 0.5]},
    },
    "joints": {
        "rail": {"type": "translational", "between": ["ground", "cart"], "at": [[0.0, 0.0], "centre"], "axis": [1, 0]},
        "pin": {"type": "revolute", "between": ["cart", "pole"], "at": ["centre", "foot"]},
    },
}


def test_a_pole_starts_at_a_twentieth_of_a_radian():
    tables = copy.deepcopy(CART)
    q, _ = started(tables, {"pole.theta": 0.05, "cart.x": 0.0})
    assert q["pole.theta"] == 0.05 and q["cart.x"] == 0.0
    assert q["pole.x"] == pytest.approx(-0.5 * math.sin(0.05), abs=1e-16)
    assert q["pole.y"] == pytest.approx(0.5 * math.cos(0.05), abs=1e-16)
    # the pin's angle is none of the body's coordinates, as the cart might turn
    tables["joints"]["pin"]["start"] = {"angle": "tilt", "rate": 0.3}
    q, start = started(tables, {"cart.x": 0.0})
    assert q["pole.theta"] == 0.05 and q["pole.omega"] == pytest.approx(0.3, abs=1e-15)
    assert q["pole.vx"] == pytest.approx(q["cart.vx"] - 0.5 * 0.3 * math.cos(0.05), abs=1e-15)
    assert "the start holds cart.x = 0 m, pin.angle = 0.05 rad" in start.notes[0]


def test_velocities_that_are_held_are_kept_and_the_others_follow():
    tables = raw()
    tables["bodies"]["crank"] |= {"hold": True, "angular_velocity": 2.0}
    tables["bodies"]["arm"]["angular_velocity"] = -1.0  # contradicts, and is not held
    q, start = started(tables)
    assert q["crank.theta"] == 0.5 and q["crank.omega"] == 2.0
    step = 1e-6
    (_, before), (_, after) = wiper_angles(0.5 - step), wiper_angles(0.5 + step)
    assert q["arm.omega"] == pytest.approx(2.0 * (after - before) / (2 * step), abs=1e-8)
    assert "velocities contradicted" in start.notes[-1] and "arm.omega changed from -1 to" in start.notes[-1]


# -- joint coordinates -------------------------------------------------------------------------------------------------


def test_an_angle_between_two_bodies_that_move():
    """Law of cosines at joint A; the rate by a difference of it."""
    q, _ = started(raw(), {"A.angle": -0.8, "A.rate": 0.5})
    assert q["link.theta"] - q["crank.theta"] == pytest.approx(-0.8, abs=1e-14)
    assert q["link.omega"] - q["crank.omega"] == pytest.approx(0.5, abs=1e-13)
    link, arm = wiper_angles(q["crank.theta"])
    assert q["link.theta"] == pytest.approx(link, abs=1e-13) and q["arm.theta"] == pytest.approx(arm, abs=1e-13)


def test_joints_on_the_ground_are_coordinates_of_bodies_in_the_plane():
    q, _ = started(raw(), {"motor.angle": 0.5, "motor.rate": 2.0})
    assert q["crank.theta"] == 0.5 and q["crank.omega"] == 2.0
    assert q == started(raw(), {"crank.theta": 0.5, "crank.omega": 2.0})[0]
    swept = symgen.sweep(model(raw()), {"drag": [0.5]}, start={"motor.angle": 0.5}, until=1e-3, times=[0.0])
    assert swept["crank.theta"][0, 0] == 0.5


X = {"reference": [[1, 0, 0], [1, 0, 0]]}
SWING = {
    "mechanism": {"name": "swing-in-space", "space": "spatial", "gravity": [0.0, 0.0, -9.81]},
    "bodies": {
        "arm": {"mass": 1.0, "inertia": [0.1, 0.2, 0.25], "points": {"end": [0.4, 0.0, 0.0]}},
        "rod": {
            "mass": 0.5,
            "inertia": [0.01, 0.05, 0.05],
            "points": {"top": [-0.3, 0.0, 0.0]},
            "position": [0.7, 0.0, 0.0],
        },
    },
    "joints": {
        "hub": {
            "type": "revolute",
            "between": ["ground", "arm"],
            "at": [[0, 0, 0], "centre"],
            "axis": [[0, 0, 1]] * 2,
            **X,
        },
        "pin": {"type": "revolute", "between": ["arm", "rod"], "at": ["end", "top"], "axis": [[0, 1, 0]] * 2, **X},
    },
}


def turn(axis: int, angle: float):
    c, s = math.cos(angle), math.sin(angle)
    i, j = (axis + 1) % 3, (axis + 2) % 3
    m = np.eye(3)
    m[i, i], m[j, j], m[i, j], m[j, i] = c, c, -s, s
    return m


@pytest.mark.by_turns(3)
@pytest.mark.slow
@pytest.mark.parametrize(
    ("method", "shape"), [("lagrange", "straight"), ("direct-correction", "straight"), ("lagrange", "looped")]
)
def test_revolute_joints_in_space(method, shape):
    """Two pins one behind the other, one of them more than half a turn from where it is described."""
    hub, pin, rates = 4.0, -0.7, (1.5, -2.0)
    held = {"hub.angle": hub, "pin.angle": pin, "hub.rate": rates[0], "pin.angle.rate": rates[1]}
    q, _ = started(copy.deepcopy(SWING), held, method, shape)
    first = turn(2, hub)
    second = first @ turn(1, pin)
    place = first @ [0.4, 0.0, 0.0] + second @ [0.3, 0.0, 0.0]
    np.testing.assert_allclose([q["rod.x"], q["rod.y"], q["rod.z"]], place, atol=1e-14)
    spin = np.array([0.0, 0.0, rates[0]]) + first @ [0.0, rates[1], 0.0]
    np.testing.assert_allclose([q["rod.wx"], q["rod.wy"], q["rod.wz"]], second.T @ spin, atol=1e-13)
    speed = np.cross([0.0, 0.0, rates[0]], first @ [0.4, 0.0, 0.0]) + np.cross(spin, second @ [0.3, 0.0, 0.0])
    np.testing.assert_allclose([q["rod.vx"], q["rod.vy"], q["rod.vz"]], speed, atol=1e-13)
    found = model(copy.deepcopy(SWING)).simulate(start=held, method=method, until=0.01, step=1e-3, shape=shape)
    assert found["hub.angle"][0] == pytest.approx(hub, abs=1e-14), "turns are counted from there"
    assert found["pin.angle.rate"][0] == pytest.approx(rates[1], abs=1e-13)


def test_a_joint_start_in_the_file_in_space_and_an_orientation_that_is_held():
    tables = copy.deepcopy(SWING)
    tables["joints"]["pin"]["start"] = {"angle": 0.25}
    half = 0.5 * 0.6
    tables["bodies"]["arm"] |= {
        "orientation": {"quaternion": [math.cos(half), 0.0, 0.0, math.sin(half)]},
        "hold": "angle",
    }
    q, _ = started(tables)
    expected = [math.cos(half), 0.0, 0.0, math.sin(half)]
    np.testing.assert_allclose([q[f"arm.e{i}"] for i in range(4)], expected, atol=1e-15)  # kept at length 1
    place = turn(2, 0.6) @ ([0.4, 0.0, 0.0] + turn(1, 0.25) @ [0.3, 0.0, 0.0])
    np.testing.assert_allclose([q["rod.x"], q["rod.y"], q["rod.z"]], place, atol=1e-14)


def test_large_mechanisms_hold_joint_coordinates_by_compiled_and_sparse_algebra(monkeypatch):
    expected = started(raw(), {"A.angle": -0.8, "A.rate": 0.5})[0]
    monkeypatch.setattr(decisions, "LARGEST_INTERPRETED", 0)
    assert started(raw(), {"A.angle": -0.8, "A.rate": 0.5})[0] == expected
    monkeypatch.setattr(decisions, "LARGEST_DENSE", 0)
    found = symgen.load(mechanism_of(raw()))
    compiled = found.compile("lagrange", shape="looped")
    start = found.assemble(compiled, held={"A.angle": -0.8, "A.rate": 0.5})
    np.testing.assert_allclose(start.y[: len(expected)], list(expected.values()), atol=1e-12)


# -- contradictions ----------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("held", "words"),
    [
        ({"crank.theta": 0.5, "arm.theta": 1.0}, "crank.theta = 0.5 rad, arm.theta = 1 rad"),
        ({"arm.theta": 1.9}, "arm.theta = 1.9 rad"),
        ({"crank.theta": 0.5, "A.angle": 0.0}, "crank.theta = 0.5 rad, A.angle = 0 rad"),
    ],
)
def test_a_start_that_cannot_be_held_is_refused_with_what_it_holds(held, words):
    with pytest.raises(AssemblyError) as caught:
        started(raw(), held)
    assert f"cannot be assembled from this start with {words} held: joint '" in str(caught.value)
    assert caught.value.joints and "other ways" not in str(caught.value)


def test_velocities_that_contradict_are_refused_with_what_is_held():
    with pytest.raises(AssemblyError) as caught:
        started(raw(), {"crank.theta": 0.5, "crank.omega": 1.0, "arm.omega": 1.0, "A.rate": 2.0})
    beside = "together with crank.omega = 1 rad/s, arm.omega = 1 rad/s, A.angle.rate = 2 rad/s, which the start holds"
    assert beside in str(caught.value)


def test_an_orientation_that_cannot_be_held_is_named():
    tables = copy.deepcopy(SWING)
    tables["bodies"]["arm"] |= {"orientation": {"rotation_vector": [0.2, 0.0, 0.0]}, "hold": True}
    with pytest.raises(AssemblyError, match=r"arm.orientation as described held: joint 'hub' stays open by"):
        started(tables)


def test_a_driver_contradicts_a_joint_coordinate():
    tables = raw()
    tables["joints"]["drive"] = {"type": "driver", "joint": "A", "value": "-0.5 + t"}
    with pytest.raises(AssemblyError, match=r"with A.angle = -0.6 rad held: joint 'drive' stays open by"):
        started(tables, {"A.angle": -0.6})


def test_a_strict_start_takes_what_is_held_as_asked_for():
    tables = raw()
    with pytest.raises(InputError, match="strict"):
        model(tables).simulate(strict=True, until=0.01)
    assert model(tables).simulate(strict=True, until=0.01, start={"crank.theta": 0.5}, step=1e-4).ok


# -- what is said of moves ---------------------------------------------------------------------------------------------


def test_a_far_point_of_a_body_that_turned_little_is_warned_of():
    """The arm's end is farther away than its centre of mass: it moves by more than a tenth of the mechanism's size."""
    tables = raw()
    tables["bodies"]["arm"]["angle"] = -0.36
    tables["bodies"]["arm"]["points"]["far"] = [0.0, 0.9]
    tables["bodies"]["crank"]["hold"] = "angle"
    q, start = started(tables)
    assert abs(q["arm.theta"] + 0.36) < decisions.FAR_TURNED
    assert "arm." in start.warnings[0]


def test_a_body_in_space_that_was_turned_about_a_slanted_axis_is_warned_of():
    """0.32 rad about (1, 1, 0): no Euler parameter has changed by 0.15."""
    tables = copy.deepcopy(SWING)
    tables["bodies"]["arm"]["orientation"] = {"rotation_vector": [0.23, 0.23, 0.0]}
    tables["bodies"]["rod"]["position"] = [0.7, 0.0, 0.0]
    _, start = started(tables)
    assert "arm" in " ".join(start.warnings)


# -- bad input ---------------------------------------------------------------------------------------------------------

BAD = [
    (("bodies", "crank", "hold"), "angel", "did you mean 'angle'"),
    (("bodies", "crank", "hold"), 3, "expected true, or which of 'position', 'angle' and 'velocity' are kept, got 3"),
    (("bodies", "link", "hold"), "velocity", "got 'velocity' without such a key"),
    (("joints", "motor", "start"), {"angel": 1.0}, "did you mean 'angle'"),
    (("joints", "motor", "start"), 0.5, "expected a table of the joint's coordinates at the start"),
    (("joints", "motor", "start"), {"angle": "motor"}, "motor"),
    (("joints", "motor", "start"), {"rate": 1.0, "angle.rate": 2.0}, "each thing held once"),
]


@pytest.mark.parametrize(("path", "value", "told"), BAD, ids=[str(b[1]) for b in BAD])
def test_bad_keys_are_told_in_one_sentence(path, value, told):
    tables = raw()
    tables[path[0]][path[1]][path[2]] = value
    with pytest.raises(InputError) as caught:
        mechanism_of(tables)
    assert told in str(caught.value) and "\n" not in str(caught.value)


def test_what_is_described_twice_is_told():
    tables = raw()
    tables["bodies"]["crank"]["hold"] = "angle"
    tables["joints"]["motor"]["start"] = {"angle": 0.4}
    with pytest.raises(InputError, match=r"each thing held once, got crank.theta and motor.angle, which are the same"):
        mechanism_of(tables)


@pytest.mark.parametrize(
    ("name", "told"),
    [
        ("crank.teta", "did you mean 'crank.theta'"),
        ("motor.angel", "did you mean 'motor.angle'"),
        ("A", "got none of that name"),
    ],
)
def test_unknown_names_are_told(name, told):
    with pytest.raises(InputError, match=told):
        model(raw()).simulate(start={name: 0.5})


def test_euler_parameters_are_refused():
    with pytest.raises(InputError, match="an Euler parameter"):
        model(copy.deepcopy(SWING)).simulate(start={"arm.e0": 1.0})
