"""Couplings, primitives, rotors, bushings and springs that other elements or closed forms say as well."""

import re

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import symgen
from symgen.api import Model
from symgen.base.errors import InputError
from symgen.describe.files.validate import validate
from symgen.run.compiling.choices import count_rhs_operations, mechanism_on_tree

TIGHT = {"integrator": "dop853", "rtol": 1e-12, "atol": 1e-13, "until": 1.0}
AT = [[0.0, 0.0], [0.0, 0.0]]


def model(raw):
    return Model(validate(raw, "file"))


def end_of(raw, *names, **settings):
    result = model(raw).simulate(**{**TIGHT, **settings})
    assert result.status == "ok"
    return np.array([(result.q if name in result.q.names else result.v)[name][-1] for name in names])


# -- rotors ------------------------------------------------------------------------------------------------------------


def planar_arm(rotor):
    """A double pendulum with a motor of ratio 5 at its second joint: by keys, or as a body with a coupling."""
    raw = {
        "mechanism": {"name": "arm", "gravity": [0.0, -9.81]},
        "bodies": {
            "one": {"mass": 2.0, "inertia": 0.2, "position": [0.5, 0.0], "angular_velocity": 1.0},
            "two": {"mass": 1.0, "inertia": 0.1, "position": [1.4, 0.0], "angular_velocity": -1.0},
        },
        "joints": {
            "A": {"type": "revolute", "between": ["ground", "one"], "at": [[0.0, 0.0], [-0.5, 0.0]]},
            "B": {"type": "revolute", "between": ["one", "two"], "at": [[0.5, 0.0], [-0.4, 0.0]]},
        },
    }
    if rotor == "keys":
        raw["joints"]["B"] |= {"rotor_inertia": 0.01, "gear_ratio": 5.0}
    if rotor == "body":
        raw["bodies"]["rotor"] = {"mass": 0.0, "inertia": 0.01, "angular_velocity": -10.0}
        raw["joints"]["hinge"] = {"type": "revolute", "between": ["ground", "rotor"], "at": AT}
        raw["joints"]["mesh"] = {"type": "coupling", "terms": {"hinge": 1.0, "B": -5.0}}
    return raw


def spatial_arm(rotor):
    raw = {
        "mechanism": {"name": "arm", "space": "spatial", "gravity": [0.0, 0.0, -9.81]},
        "bodies": {
            "one": {"mass": 2.0, "inertia": [0.1, 0.2, 0.3], "position": [0.5, 0.0, 0.0]},
            "two": {"mass": 1.0, "inertia": [0.05, 0.1, 0.12], "position": [1.4, 0.0, 0.0]},
        },
        "joints": {
            "A": {
                "type": "universal",
                "between": ["ground", "one"],
                "at": [[0.0] * 3, [-0.5, 0, 0]],
                "axes": [[0, 0, 1], [0, 1, 0]],
            },
            "B": {
                "type": "revolute",
                "between": ["one", "two"],
                "at": [[0.5, 0, 0], [-0.4, 0, 0]],
                "axis": [0, 0.6, 0.8],
                "start": {"rate": 2.0},
            },
        },
    }
    raw["bodies"]["one"]["angular_velocity"] = [0.0, 0.0, 1.0]
    if rotor == "keys":
        raw["joints"]["B"] |= {"rotor_inertia": 0.01, "gear_ratio": 5.0}
    if rotor == "body":
        raw["bodies"]["rotor"] = {"mass": 0.0, "inertia": [0.0, 0.0, 0.01], "angular_velocity": [0, 0, 10.0]}
        hinge = {"type": "revolute", "between": ["ground", "rotor"], "at": [[0.0] * 3] * 2, "axis": [0, 0, 1]}
        raw["joints"] |= {"hinge": hinge, "mesh": {"type": "coupling", "terms": {"hinge": 1.0, "B": -5.0}}}
    return raw


ARMS = {
    "plane": (planar_arm, ("one.theta", "two.theta", "one.omega", "two.omega")),
    "space": (spatial_arm, ("two.x", "two.y", "two.z", "two.e1", "two.wx")),
}


@pytest.mark.by_turns(3)
@pytest.mark.slow
@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
@pytest.mark.parametrize("where", ARMS)
def test_a_rotor_is_a_body_with_a_gear(where, coordinates):
    arm, names = ARMS[where]
    ends = [end_of(arm(rotor), *names, coordinates=coordinates) for rotor in ("keys", "body", "")]
    np.testing.assert_allclose(ends[0], ends[1], rtol=0.0, atol=1e-11)
    assert np.abs(ends[0] - ends[2]).max() > 1e-2
    result = model(arm("keys")).simulate(**TIGHT, coordinates=coordinates)
    assert result.energy_drift_max < 1e-9


@pytest.mark.slow
def test_operations_of_a_rotor():
    counts = {}
    for where, (arm, _) in ARMS.items():
        mechanisms = [validate(arm(rotor), "file") for rotor in ("", "keys", "body")]
        counts[where, "absolute"] = [count_rhs_operations(m) for m in mechanisms]
        counts[where, "joint"] = [count_rhs_operations(mechanism_on_tree(m)) for m in mechanisms]
    for none, keys, body in counts.values():
        # in the plane a body that its pin carries costs no more, as its rows are fixed: but for one sum with constants
        assert none <= keys <= body + 1
    assert counts["space", "absolute"][1] < 0.87 * counts["space", "absolute"][2]
    assert counts["space", "joint"][1] - counts["space", "joint"][0] <= 4


@pytest.mark.slow
def test_a_rotor_on_a_driven_joint():
    """A driver takes what the rotor asks for: J n^2 a beside the inertia of the wheel."""
    raw = {
        "mechanism": {"name": "driven"},
        "bodies": {"wheel": {"mass": 1.0, "inertia": 0.3}},
        "joints": {
            "pin": {
                "type": "revolute",
                "between": ["ground", "wheel"],
                "at": AT,
                "rotor_inertia": 0.02,
                "gear_ratio": 3,
            },
            "turn": {"type": "driver", "joint": "pin", "value": "2*t**2"},
        },
        "outputs": {"torque": "turn.effort"},
    }
    for coordinates in ("absolute", "joint"):
        result = model(raw).simulate(**TIGHT, coordinates=coordinates)
        assert result.outputs["torque"][-1] == pytest.approx(4.0 * (0.3 + 0.02 * 9.0), rel=1e-12)
        assert result.energy_drift_max < 1e-10


# -- couplings ---------------------------------------------------------------------------------------------------------


def wheels(**mesh):
    raw = {
        "mechanism": {"name": "wheels"},
        "parameters": {"load": 3.0},
        "bodies": {
            "a": {"mass": 1.0, "inertia": 0.3, "angle": 0.2},
            "b": {"mass": 1.0, "inertia": 0.5},
        },
        "joints": {
            "A": {"type": "revolute", "between": ["ground", "a"], "at": AT},
            "B": {"type": "revolute", "between": ["ground", "b"], "at": AT},
        },
        "forces": {"load": {"type": "torque", "body": "b", "torque": "load"}},
    }
    raw["joints"]["mesh"] = mesh
    return raw


def test_a_coupling_is_a_gear():
    gear = end_of(wheels(type="gear", between=["a", "b"], ratio=2.0, offset=0.2), "a.theta", "b.theta", "a.omega")
    coupling = wheels(type="coupling", terms={"A": 1.0, "B": 2.0}, value=0.2)
    np.testing.assert_allclose(end_of(coupling, "a.theta", "b.theta", "a.omega"), gear, rtol=0.0, atol=1e-13)


@pytest.mark.slow_cases("{'integrator': 'radau5'}", "{'shape': 'looped'}")
@pytest.mark.parametrize(
    "settings", [{}, {"coordinates": "joint"}, {"shape": "looped"}, {"integrator": "radau5"}], ids=str
)
def test_a_coupling_follows_time_and_a_polynomial(settings):
    """A = 0.3 (1 - cos(2 t)) + 0.2 + 0.5 B + 0.1 B^2 with one degree of freedom, B, by Lagrange's equation."""
    mesh = {
        "type": "coupling",
        "terms": {"A": 1.0},
        "value": "0.3*(1 - cos(2*t))",
        "of": "B",
        "polynomial": [0.2, 0.5, 0.1],
    }

    def rates(t, y):
        b, w = y
        slope = 0.5 + 0.2 * b
        rest = 1.2 * np.cos(2 * t) + 0.2 * w**2  # of a'' = slope b'' + rest
        return [w, (3.0 - 0.3 * slope * rest) / (0.5 + 0.3 * slope**2)]

    raw = wheels(**mesh)
    raw["bodies"]["b"]["angular_velocity"] = 0.0
    wanted = solve_ivp(rates, (0.0, 1.0), [0.0, 0.0], "DOP853", rtol=1e-13, atol=1e-13).y[:, -1]
    np.testing.assert_allclose(end_of(raw, "b.theta", "b.omega", **settings), wanted, rtol=0.0, atol=1e-10)


# -- primitives --------------------------------------------------------------------------------------------------------


def box(**joints):
    raw = {
        "mechanism": {"name": "box", "space": "spatial", "gravity": [0.0, 0.0, -9.81]},
        "bodies": {
            "base": {"mass": 3.0, "inertia": [0.2, 0.3, 0.4], "angular_velocity": [0.3, -0.2, 0.5]},
            "box": {"mass": 2.0, "inertia": [0.1, 0.2, 0.3], "position": [0.4, 0.1, 0.2], "velocity": [0.1, 0.2, 0.3]},
        },
        "joints": joints,
    }
    return raw


PAIR = {"between": ["base", "box"]}
ENDS = {**PAIR, "at": [[0.4, 0.1, 0.2], [0.0, 0.0, 0.0]]}
BALL = {"type": "spherical", **ENDS}
ALONG = {"axis": [0.0, 0.6, 0.8]}
SAME = {
    "revolute": ({"type": "revolute", **ENDS, **ALONG}, [BALL, {"type": "parallel-axes", **PAIR, **ALONG}]),
    "rigid": ({"type": "rigid", **ENDS}, [BALL, {"type": "orientation", **PAIR}]),
    "universal": (
        {"type": "universal", **ENDS, "axes": [[1, 0, 0], [0, 1, 0]]},
        [BALL, {"type": "perpendicular", **PAIR, "axes": [[1, 0, 0], [0, 1, 0]]}],
    ),
    "cylindrical": (
        {"type": "cylindrical", **ENDS, **ALONG},
        [
            {"type": "inline", "between": ["box", "base"], "at": ENDS["at"][::-1], **ALONG},
            {"type": "parallel-axes", **PAIR, **ALONG},
        ],
    ),
    "planar": (
        {"type": "planar", **ENDS, "normal": ALONG["axis"]},
        [
            {"type": "in-plane", "between": ["box", "base"], "at": ENDS["at"][::-1], "normal": ALONG["axis"]},
            {"type": "parallel-axes", **PAIR, **ALONG},
        ],
    ),
}


@pytest.mark.by_turns(3)
@pytest.mark.slow
@pytest.mark.parametrize("name", SAME)
def test_joints_are_put_together_of_primitives(name):
    whole, parts = SAME[name]
    ends = [
        end_of(box(**{f"j{i}": joint for i, joint in enumerate(joints)}), "base.x", "box.y", "box.e1", "box.wz")
        for joints in ([whole], parts)
    ]
    np.testing.assert_allclose(ends[1], ends[0], rtol=0.0, atol=1e-11)


def test_orientation_in_the_plane():
    raw = wheels(type="orientation", between=["a", "b"], angle=-0.2)
    moved = end_of(raw, "a.theta", "b.theta")
    assert moved[0] - moved[1] == pytest.approx(0.2, abs=1e-13)
    assert moved[1] == pytest.approx(0.5 * 3.0 / 0.8, rel=1e-12)


def test_a_primitive_that_starts_half_a_turn_away_is_found():
    raw = box(j=BALL, k={"type": "orientation", **PAIR, "axis": [[0, 0, 1]] * 2, "reference": [[1, 0, 0], [-1, 0, 0]]})
    with pytest.raises(symgen.SymgenError, match="'k'"):
        model(raw).simulate(**TIGHT)


# -- bushings, balls and springs ---------------------------------------------------------------------------------------


@pytest.mark.slow
def test_a_bushing_in_the_plane_is_three_springs_and_dampers():
    raw = {
        "mechanism": {"name": "buffer"},
        "bodies": {"a": {"mass": 2.0, "inertia": 0.3, "position": [0.2, 0.1], "angle": 0.4, "angular_velocity": 1.0}},
        "forces": {
            "held": {
                "type": "bushing",
                "between": ["ground", "a"],
                "at": AT,
                "angle": 0.1,
                "stiffness": [40.0, 90.0, 3.0],
                "damping": [1.0, 2.0, 0.2],
            }
        },
    }

    def rates(t, y):
        x, y_, a, vx, vy, w = y
        return [vx, vy, w, (-40 * x - vx) / 2, (-90 * y_ - 2 * vy) / 2, (-3 * (a - 0.1) - 0.2 * w) / 0.3]

    wanted = solve_ivp(rates, (0.0, 1.0), [0.2, 0.1, 0.4, 0, 0, 1], "DOP853", rtol=1e-13, atol=1e-13).y[:, -1]
    names = ("a.x", "a.y", "a.theta", "a.vx", "a.vy", "a.omega")
    for settings in ({}, {"integrator": "radau5"}, {"shape": "looped"}):
        np.testing.assert_allclose(end_of(raw, *names, **settings), wanted, rtol=0.0, atol=1e-10)
    result = model(raw).simulate(**TIGHT)
    assert result.elements["held.Mz"][0] == pytest.approx(-3.0 * 0.3 - 0.2, rel=1e-12)


@pytest.mark.slow_cases("spatial")
@pytest.mark.parametrize("space", ["planar", "spatial"])
def test_a_bushing_along_fixed_axes_is_two_forces(space):
    """Axes of the ground, whatever the first body does: a force and its opposite say it with formulas."""
    dimension = 2 if space == "planar" else 3
    stiffness, damping = [50.0, 80.0, 60.0][:dimension], [1.0, 2.0, 1.5][:dimension]
    inertia = 0.2 if space == "planar" else [0.2, 0.3, 0.25]
    spin = 2.0 if space == "planar" else [0.3, 0.5, 2.0]
    tip, foot = [0.3, 0.1, 0.2][:dimension], [-0.2, 0.1, 0.1][:dimension]
    raw = {
        "mechanism": {"name": "pair", "space": space},
        "bodies": {
            "a": {"mass": 1.0, "inertia": inertia, "points": {"tip": tip}, "angular_velocity": spin},
            "b": {"mass": 2.0, "inertia": inertia, "points": {"foot": foot}, "position": [0.6, 0.2, 0.3][:dimension]},
        },
        "joints": {},
    }
    rest = [0.0] * (1 if space == "planar" else 3)
    bushing = {"type": "bushing", "between": ["a", "b"], "at": ["tip", "foot"], "frame": "ground"}
    formulas = [
        f"-{k}*(b.foot.{x} - a.tip.{x}) - {c}*(b.foot.v{x} - a.tip.v{x})"
        for k, c, x in zip(stiffness, damping, "xyz", strict=False)
    ]
    opposite = [f"-({text})" for text in formulas]
    by_element = {"held": {**bushing, "stiffness": [*stiffness, *rest], "damping": [*damping, *rest]}}
    by_forces = {
        "on_b": {"type": "force", "body": "b", "at": "foot", "force": formulas},
        "on_a": {"type": "force", "body": "a", "at": "tip", "force": opposite},
    }
    names = ("a.x", "b.y", "a.omega", "b.theta") if space == "planar" else ("a.x", "b.y", "a.wz", "b.e1")
    ends = [end_of({**raw, "forces": forces}, *names) for forces in (by_element, by_forces)]
    np.testing.assert_allclose(ends[0], ends[1], rtol=0.0, atol=1e-11)


def ball(spring, start):
    return {
        "mechanism": {"name": "ball", "space": "spatial"},
        "bodies": {"a": {"mass": 1.0, "inertia": [0.2, 0.3, 0.25], "angular_velocity": start}},
        "joints": {"ball": {"type": "spherical", "between": ["ground", "a"], "at": [[0.0] * 3] * 2}},
        "forces": {"held": {"type": "torsional-spring-damper", "joint": "ball", **spring}},
    }


@pytest.mark.by_turns(2)
@pytest.mark.slow_cases("absolute", "joint")
@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
def test_stiffness_and_damping_of_a_ball(coordinates):
    """About a principal axis it is an oscillator; else the torque is -k times the rotation vector less c omega."""
    spring = {"stiffness": 2.0, "damping": 0.1}
    single = end_of(ball(spring, [0.0, 3.0, 0.0]), "a.e2", "a.wy", coordinates=coordinates)
    decay, omega = 0.1 / 0.6, np.sqrt(2.0 / 0.3 - (0.1 / 0.6) ** 2)
    angle = 3.0 / omega * np.exp(-decay) * np.sin(omega)
    rate = 3.0 * np.exp(-decay) * (np.cos(omega) - decay / omega * np.sin(omega))
    np.testing.assert_allclose(single, [np.sin(angle / 2), rate], rtol=0.0, atol=1e-10)

    def rates(t, y):
        e, w = y[:4], y[4:]
        half = np.linalg.norm(e[1:])
        turn = 2.0 * np.arctan2(half, e[0]) * (e[1:] / half if half > 0.0 else 0.0 * w)
        torque = -2.0 * turn - 0.1 * w
        inertia = np.array([0.2, 0.3, 0.25])
        matrix = np.array(
            [[0, -w[0], -w[1], -w[2]], [w[0], 0, w[2], -w[1]], [w[1], -w[2], 0, w[0]], [w[2], w[1], -w[0], 0]]
        )
        return [*(0.5 * matrix @ e), *((torque - np.cross(w, inertia * w)) / inertia)]

    names = ("a.e0", "a.e1", "a.e2", "a.e3", "a.wx", "a.wy", "a.wz")
    wanted = solve_ivp(rates, (0.0, 1.0), [1, 0, 0, 0, 2.0, -1.0, 3.0], "DOP853", rtol=1e-13, atol=1e-13).y[:, -1]
    found = end_of(ball(spring, [2.0, -1.0, 3.0]), *names, coordinates=coordinates)
    np.testing.assert_allclose(found, wanted, rtol=0.0, atol=1e-10)


def sprung(**keys):
    return {
        "mechanism": {"name": "sprung"},
        "bodies": {"a": {"type": "point", "mass": 2.0, "velocity": [0.4, -0.3]}},
        "forces": {"held": {"type": "spring-damper", "between": ["ground", "a"], "at": AT, "stiffness": 18.0, **keys}},
    }


@pytest.mark.slow_cases("{'integrator': 'radau5'}")
@pytest.mark.parametrize(
    "settings", [{}, {"integrator": "radau5"}, {"shape": "looped"}, {"coordinates": "joint"}], ids=str
)
def test_a_spring_of_free_length_0_starts_at_length_0(settings):
    result = model(sprung()).simulate(**{**TIGHT, **settings})
    assert result.q["a.x"][-1] == pytest.approx(0.4 / 3.0 * np.sin(3.0), abs=1e-11)
    assert result.q["a.y"][-1] == pytest.approx(-0.3 / 3.0 * np.sin(3.0), abs=1e-11)
    elements = result.elements
    assert np.isfinite(elements.values).all()
    lengths = np.hypot(result.q["a.x"], result.q["a.y"])
    np.testing.assert_allclose(elements["held.length"], lengths, atol=1e-12)
    np.testing.assert_allclose(elements["held.force"], -18.0 * lengths, atol=1e-11)
    assert result.energy_drift_max < 1e-10


def test_a_spring_of_free_length_0_has_a_stiffness_at_length_0():
    raw = sprung()
    raw["bodies"]["a"].pop("velocity")
    np.testing.assert_allclose(model(raw).modes(at="start").omega_squared, [9.0, 9.0], rtol=1e-12)


@pytest.mark.slow
def test_a_start_by_the_place_of_a_point():
    raw = planar_arm("")
    raw["bodies"]["two"]["points"] = {"tip": [0.4, 0.0]}
    tip = {"type": "place", "between": ["ground", "two"], "at": [[0.0, 0.0], "tip"], "start": {"x": 1.2, "y": 0.5}}
    raw["joints"]["tip"] = tip
    result = model(raw).simulate(**TIGHT)
    assert (result.joint_coordinates["tip.x"][0], result.joint_coordinates["tip.y"][0]) == pytest.approx(
        (1.2, 0.5), abs=1e-12
    )
    other = model(raw).simulate(**TIGHT, start={"tip.x": 1.0, "tip.y": -0.6}, coordinates="joint")
    assert other.joint_coordinates["tip.x"][0] == pytest.approx(1.0, abs=1e-12)
    counts = [count_rhs_operations(validate(r, "file")) for r in (raw, planar_arm(""))]
    assert counts[0] == counts[1]


# -- bad input ---------------------------------------------------------------------------------------------------------

BAD = [
    (wheels(type="coupling", terms={}), "joints.mesh.terms: expected a table of factors of joint coordinates"),
    (
        wheels(type="coupling", terms={"C": 1.0}),
        "joints.mesh.terms.C: expected the name of a joint, got the unknown joint 'C'",
    ),
    (
        wheels(type="coupling", terms={"A.turn": 1.0}),
        "joints.mesh.terms.A.turn: expected a coordinate of joint 'A', got 'turn'",
    ),
    (wheels(type="coupling", terms={"A": 1.0, "A.angle": 2.0}), "joints.mesh.terms: expected different coordinates"),
    (wheels(type="coupling", terms={"A": "t"}), "'t', which has no meaning here"),
    (
        wheels(type="coupling", terms={"A": 1.0}, of="B"),
        "joints.mesh: expected the keys of and polynomial together, got of alone",
    ),
    (
        wheels(type="coupling", terms={"A": 1.0}, of="B", polynomial=[1.0]),
        "joints.mesh.polynomial: expected a list of numbers",
    ),
    (
        wheels(type="orientation", between=["a", "a"]),
        "joints.mesh.between: expected two different bodies, got 'a' twice",
    ),
    (
        wheels(type="orientation", between=["a", "b"], axis=[1, 0]),
        "joints.mesh.axis: expected no such key in the plane",
    ),
    (wheels(type="perpendicular", between=["a", "b"], axes=[[1, 0], [0, 1]]), "expected a type for planar mechanisms"),
    (wheels(type="place", between=["a", "b"]), "joints.mesh.at: expected two points"),
    (sprung(damping=1.0, stiffness="x"), "the unknown name 'x'"),
    (
        ball({"stiffness": 1.0, "free_angle": 0.1}, [0, 0, 1]),
        "forces.held.free_angle: expected no such key for a spherical joint",
    ),
]


@pytest.mark.parametrize(("raw", "words"), BAD, ids=range(len(BAD)))
def test_bad_input_is_one_sentence(raw, words):
    with pytest.raises(InputError, match=re.escape(words)) as error:
        validate(raw, "file")
    assert "\n" not in str(error.value)


@pytest.mark.parametrize(
    ("keys", "words"),
    [
        ({"rotor_inertia": 0.0}, "joints.B.rotor_inertia: expected a value above 0, got 0.0"),
        ({"gear_ratio": 2.0}, "joints.B.gear_ratio: expected the key rotor_inertia beside it, got no such key"),
        ({"rotor_inertia": "t"}, "'t', which has no meaning here"),
    ],
)
def test_bad_rotors(keys, words):
    raw = planar_arm("")
    raw["joints"]["B"] |= keys
    with pytest.raises(InputError, match=re.escape(words)):
        validate(raw, "file")


@pytest.mark.slow
@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
def test_a_rotor_on_a_slide_is_mass_along_it(coordinates):
    """A spindle turns n rad for 1 m: F = (m + J n^2) a, whether F is applied or a driver's."""
    raw = {
        "mechanism": {"name": "axis", "space": "spatial", "gravity": [0.0, 0.0, -9.81]},
        "bodies": {"table": {"mass": 1.5, "inertia": [0.1] * 3}},
        "joints": {
            "rail": {
                "type": "translational",
                "between": ["ground", "table"],
                "at": [[0.0] * 3] * 2,
                "axis": [1.0, 0.0, 0.0],
                "rotor_inertia": 0.02,
                "gear_ratio": 5,
            }
        },
        "forces": {"push": {"type": "force", "body": "table", "force": [4.0, 0.0, 0.0]}},
    }
    result = model(raw).simulate(**TIGHT, coordinates=coordinates)
    assert result["table.vx"][-1] == pytest.approx(4.0 / (1.5 + 0.02 * 25.0) * result.t[-1], rel=1e-10)
    assert result.energy_drift_max < 1e-9
    del raw["forces"]
    raw["joints"]["move"] = {"type": "driver", "joint": "rail", "value": "3*t**2"}
    raw["outputs"] = {"force": "move.effort"}
    result = model(raw).simulate(**TIGHT, coordinates=coordinates)
    assert result.outputs["force"][-1] == pytest.approx(6.0 * (1.5 + 0.02 * 25.0), rel=1e-12)


def test_rotors_need_an_angle():
    raw = spatial_arm("")
    raw["joints"]["A"]["rotor_inertia"] = 0.1
    words = "joints.A.rotor_inertia: expected a joint with one angle, or one displacement alone, got a universal joint"
    with pytest.raises(InputError, match=f"{words} with 2"):
        validate(raw, "file")
