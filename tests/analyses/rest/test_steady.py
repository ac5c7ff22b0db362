"""Steady motions: bicycle, disc, conical pendulum, governor; values of the literature and by minimal coordinates."""

import math

import numpy as np
import pytest
from numpy.testing import assert_allclose

import symgen
from analyses import rods
from symgen.analyses.state.algebra import numerical_rank
from symgen.base.errors import InputError

#: Rows of A for the rates of lean and steer rate, constant, by v and by v^2 (Meijaard et al. 2007, and SymPy's test of
#: the same benchmark).
STILL = np.array([[9.48977444677355, -0.571523173729245, 0.0, 0.0], [11.7194768719633, 30.9087533932407, 0.0, 0.0]])
BY_SPEED = np.array([[0, 0, -0.105522449805691, -0.330515398992311], [0, 0, 3.67680523332152, -3.08486552743311]])
BY_SQUARE = np.array([[0.0, -0.891197738059089, 0.0, 0.0], [0.0, -1.97171508499972, 0.0, 0.0]])
EIGENVALUES = {
    0.0: [5.530943717654, 3.131643247907, -3.131643247907, -5.530943717654],
    5.0: [-0.3228664290041, -0.7753418821958 + 4.464867713788j, -0.7753418821958 - 4.464867713788j, -14.0783896928],
}
#: Speeds at which weave becomes stable and capsize unstable [m/s], from the same paper.
WEAVE, CAPSIZE = 4.29238253634111, 6.02426201538837


@pytest.mark.by_turns(3)
@pytest.mark.slow
@pytest.mark.parametrize("v", [0.0, 1.0, 5.0, 10.0])
def test_a_bicycle_rides(v):
    found = symgen.load("bicycle").linearise(at="start", states=["lean", "steer"], parameters={"speed": v})
    assert found.states == ("lean", "steer", "lean.rate", "steer.rate")
    assert_allclose(found.A[:2], np.eye(4)[2:], atol=1e-12)
    assert_allclose(found.A[2:], STILL + v * BY_SPEED + v**2 * BY_SQUARE, rtol=1e-12, atol=1e-12)
    if v in EIGENVALUES:
        assert_allclose(found.eigenvalues(), EIGENVALUES[v], rtol=1e-10)
    # a torque on the handlebar works through the inverse of the paper's mass matrix
    mass = np.array([[80.81722, 2.31941332208709], [2.31941332208709, 0.29784188199686]])
    assert_allclose(found.B[2:, 0], np.linalg.inv(mass)[:, 1], rtol=1e-12)


@pytest.mark.by_turns(2)
@pytest.mark.slow
def test_weave_and_capsize_speeds(tmp_path):
    asked = {"at": "start", "states": ["lean", "steer"]}
    found = symgen.load("bicycle").locus(("speed", np.linspace(4.0, 6.5, 6)), **asked)
    assert_allclose([c.value for c in found.crossings], [WEAVE, CAPSIZE], rtol=1e-9)
    assert [c.rising for c in found.crossings] == [False, True]
    assert_allclose(found.crossings[0].eigenvalue.imag, 3.43503384866144, rtol=1e-8)
    assert len(found.plot().figure.axes) == 2
    assert found.plot(tmp_path / "locus.svg").read_text().lstrip().startswith("<?xml")


def test_a_turn_is_no_straight_ride():
    with pytest.raises(InputError, match=r"in which no state changes, got one where 'lean' changes"):
        symgen.load("bicycle").linearise(at="start", states=["lean", "steer"], parameters={"lean_rate": 0.1})


def disc(spin, radius=0.3):
    """A thin disc that rolls upright: x forward, z up, the axis of the disc along y."""
    body = {
        "mass": 2.0,
        "inertia": [2 * radius**2 / 4, 2 * radius**2 / 2, 2 * radius**2 / 4],
        "position": [0.0, 0.0, radius],
        "velocity": [spin * radius, 0.0, 0.0],
        "angular_velocity": [0.0, spin, 0.0],
    }
    contact = {"type": "rolling-disc", "body": "disc", "radius": radius, "axis": [0, 1, 0], "normal": [0, 0, 1]}
    up = [
        "(2*(disc.e1*disc.e3 - disc.e0*disc.e2))",
        "(2*(disc.e2*disc.e3 + disc.e0*disc.e1))",
        "(disc.e0**2 - disc.e1**2 - disc.e2**2 + disc.e3**2)",
    ]
    outputs = {
        "lean": f"asin({up[1]})",  # about x, which points forward
        "turn": f"(disc.wx*{up[0]} + disc.wz*{up[2]})/sqrt(1 - {up[1]}**2)",
    }
    return rods.model({"disc": body}, {"contact": contact}, "spatial", outputs=outputs)


@pytest.mark.slow
def test_a_disc_stands_upright_above_the_critical_spin():
    """lean'' = 4/5 g/r lean + 6/5 Omega u, u' = -2 Omega lean'."""
    critical = 3.301514803844
    squares = []
    for spin in (1.0, critical, 5.0):
        found = disc(spin).linearise(at="start", states=["lean", "turn"])
        assert found.states == ("lean", "turn", "lean.rate")
        stiff = 0.8 * rods.GRAVITY / 0.3
        own = [[0, 0, 1], [0, 0, -2 * spin], [stiff, 1.2 * spin, 0]]
        assert_allclose(found.A, own, atol=1e-11)
        squares.append(stiff - 2.4 * spin**2)
    assert squares[0] > 0 > squares[2] and abs(squares[1]) < 1e-10


def conical(rate=5.0):
    """A point mass on a massless rod in a vertical plane that a driver turns."""
    bodies = {
        "yoke": {"mass": 1.0, "inertia": [0.1, 0.1, 0.1], "position": [0.0, 0.0, 0.0]},
        "bob": {
            "mass": 1.0,
            "inertia": [0.0, 0.0, 0.0],
            "position": [math.sin(1.0), 0.0, -math.cos(1.0)],
            "orientation": {"x_axis": [math.cos(1.0), 0.0, math.sin(1.0)], "y_axis": [0.0, 1.0, 0.0]},
            "points": {"top": [0.0, 0.0, 1.0]},
        },
    }
    joints = {
        "shaft": rods.pin("ground", "yoke", rods.GROUND3, "centre", axis=[0.0, 0.0, 1.0]),
        "hinge": rods.pin("yoke", "bob", "centre", "top", axis=[0.0, 1.0, 0.0]),
        "motor": {"type": "driver", "joint": "shaft", "value": f"{rate}*t"},
    }
    return rods.model(bodies, joints, "spatial")


@pytest.mark.slow
def test_a_driven_conical_pendulum():
    angle, omega = 1.167556903805, 4.598973363698  # arccos(g / Omega^2), Omega sin(angle)
    found = conical().steady()
    assert_allclose(-found.q["bob.z"], math.cos(angle), rtol=1e-11)
    assert_allclose(found.omega_squared, [omega**2], rtol=1e-11)
    assert_allclose(conical().modes(at="steady").eigenvalues, [1j * omega, -1j * omega], rtol=1e-11)


def governor(x, parameters=(8e5, 4e4, 0.5)):
    """Rates of the shaft's speed, angle and rate of each arm below the horizontal, height and rate of the slider."""
    k, c, l0 = parameters
    speed, a1, b1, a2, b2, s, w = x
    arm, along = 5.3, 0.3 * 2 * 0.01**2 / 12
    across = 0.3 * (1 + 0.01**2) / 12 + 0.3 * 0.5**2 + 5.0
    first = 0.3 * 0.5 + 5.0  # mass times distance from the hinge
    inertia = 2 * 0.3 * 0.01**2 / 12 + 3 * 2 * 0.1**2 / 12
    slope = 0.0
    push, torques = -3.0 * 9.81, []
    for a, b in ((a1, b1), (a2, b2)):
        inertia = (
            inertia + arm * 0.05**2 + 2 * 0.05 * first * np.cos(a) + along * np.sin(a) ** 2 + across * np.cos(a) ** 2
        )
        by_angle = -2 * 0.05 * first * np.sin(a) + 2 * (along - across) * np.sin(a) * np.cos(a)
        slope = slope + by_angle * b
        x1, z1 = 0.5 * np.cos(a), 1 - 0.5 * np.sin(a) - s
        length = np.sqrt(x1**2 + z1**2)
        rate = (x1 * (-0.5 * np.sin(a) * b) + z1 * (-0.5 * np.cos(a) * b - w)) / length
        pull = k * (length - l0) + c * rate
        push = push + pull * z1 / length
        by_a = (x1 * (-0.5 * np.sin(a)) + z1 * (-0.5 * np.cos(a))) / length
        torques.append((0.5 * by_angle * speed**2 + 9.81 * first * np.cos(a) - pull * by_a) / across)
    return np.array([-slope * speed / inertia, b1, torques[0], b2, torques[1], w, push / 3.0])


@pytest.mark.slow
def test_the_flyball_governor_about_its_steady_speed():
    x = np.array([2 * math.pi, 0.35, 0.0, 0.35, 0.0, 0.66, 0.0])  # near what the start leads to
    free = [1, 3, 5]  # at the speed of the start, by Newton's method with a complex step

    def jacobian(x):
        return np.array([governor(x + 1e-30j * e).imag / 1e-30 for e in np.eye(7)]).T

    for _ in range(60):
        step = np.linalg.solve(jacobian(x)[np.ix_([2, 4, 6], free)], governor(x)[[2, 4, 6]])
        x[free] -= min(1.0, 0.05 / np.abs(step).max()) * step
    found = symgen.load("flyball-governor").linearise(at="steady")
    names = ["bearing.angle.rate", "hinge1.angle", "hinge1.angle.rate", "hinge2.angle", "hinge2.angle.rate"]
    names += ["sleeve.displacement", "sleeve.displacement.rate"]
    order = [found.states.index(name) for name in names]
    matrix, own = found.A[np.ix_(order, order)], jacobian(x)
    assert_allclose(matrix, own, rtol=1e-10, atol=1e-9 * np.abs(own).max())
    values = np.sort_complex(found.eigenvalues())
    assert_allclose(values, np.sort_complex(np.linalg.eigvals(own)), rtol=1e-10, atol=1e-10 * np.abs(own).max())


@pytest.mark.slow
def test_cyclic_coordinates_can_be_named():
    model = symgen.load("flyball-governor")
    named = model.steady(cyclic=["bearing.angle"])
    assert_allclose(named.q["hinge1.angle"], model.steady().q["hinge1.angle"], rtol=1e-12)
    with pytest.raises(InputError, match=r"did you mean 'bearing\.angle'"):
        model.steady(cyclic=["bearing.angl"])
    with pytest.raises(InputError, match="a coordinate that no force and no row depends on"):
        model.steady(cyclic=["sleeve.displacement"])


@pytest.mark.parametrize("name", ["heavy-top", "free-rigid-body", "rolling-disc"])
def test_what_tumbles_is_not_steady(name):
    with pytest.raises(InputError, match="expected a state of rest, or of a motion in which no state changes"):
        symgen.load(name).modes(at="start")


@pytest.mark.parametrize("name", ["heavy-top", "free-rigid-body"])
def test_what_spins_about_no_joint_s_axis_is_not_taken_to_be_at_rest(name):
    """A fast top was said to hang at rest: no coordinate turns on where orientations are Euler parameters."""
    for found in (symgen.load(name).steady, lambda: symgen.load(name).modes(at="steady")):
        with pytest.raises(InputError, match="the turning of a body about any axis"):
            found()


@pytest.mark.slow
def test_states_of_a_steady_motion_are_found():
    """Lean, steer and speed, and what depends on them alone; eigenvalues are those of the paper, and zeros."""
    for at in ("steady", "start"):
        found = symgen.load("bicycle").modes(at=at)
        moving = [x for x in found.eigenvalues if abs(x) > 1e-5]  # a double zero is parted by the root of rounding
        assert_allclose(moving, EIGENVALUES[5.0], rtol=1e-9)
    assert {"lean", "lean.rate", "head.angle", "head.angle.rate"} <= set(found.names)


def beside_a_wheel(spin):
    """A wheel on an axle, and beside it a body that hangs on a ball, from where it turns with `spin` in its axes."""
    wheel = {"mass": 1.0, "inertia": [0.1, 0.1, 0.2], "position": [3.0, 0.0, 0.0], "angular_velocity": [0.0, 0.0, 4.0]}
    bob = {
        **{"mass": 1.0, "inertia": [0.02, 0.05, 0.05], "position": [0.0, 0.0, -0.5], "angular_velocity": spin},
        **{"points": {"top": [-0.5, 0.0, 0.0]}, "orientation": {"x_axis": [0, 0, -1], "y_axis": [0, 1, 0]}},
    }
    joints = {
        "axle": rods.pin("ground", "wheel", [3.0, 0.0, 0.0], "centre", axis=[0.0, 0.0, 1.0]),
        "ball": rods.pin("ground", "bob", rods.GROUND3, "top", "spherical"),
    }
    return rods.model({"wheel": wheel, "bob": bob}, joints, "spatial")


@pytest.mark.slow_cases("spin0")
@pytest.mark.parametrize("spin", [[20.0, 0.0, 0.0], [0.0, 0.3, 0.2]])
def test_a_spin_is_not_lost_beside_a_wheel_that_turns_on(spin):
    assert_allclose(beside_a_wheel([0.0, 0.0, 0.0]).steady().q["bob.z"], -0.5, rtol=1e-12)
    for moving in (beside_a_wheel(spin).steady, lambda: beside_a_wheel(spin).modes(at="steady")):
        with pytest.raises(InputError, match="the turning of a body about any axis"):
            moving()


def carousel(driven, speed=5.0):
    """A disc that turns on a pin, without gravity, with an arm on a pin at its rim and a spring between both."""
    bodies = {
        "disc": {"mass": 1.0, "inertia": 0.1, "position": [0.0, 0.0], "angular_velocity": speed},
        "arm": {
            **{"mass": 2.0, "inertia": 0.03, "position": [0.8, 0.0], "angular_velocity": speed},
            **{"velocity": [0.0, 0.8 * speed], "points": {"end": [-0.5, 0.0]}},
        },
    }
    joints = {
        "axle": rods.pin("ground", "disc", rods.GROUND2, "centre"),
        "pin": rods.pin("disc", "arm", [0.3, 0.0], "end"),
    }
    if driven:
        joints["motor"] = {"type": "driver", "joint": "axle", "value": f"{speed}*t"}
    spring = {"type": "torsional-spring-damper", "between": ["disc", "arm"], "stiffness": 12.0, "free_angle": 0.8}
    return rods.model(bodies, joints, gravity=[0.0, 0.0], forces={"spring": spring})


@pytest.mark.slow_cases("False")
@pytest.mark.parametrize("driven", [False, True])
def test_what_a_turning_body_carries_turns_along_in_the_plane(driven):
    """Angles in the plane are absolute: no coordinate turns on by itself, so that the disc was taken to be at rest."""
    stiffness, speed, arm, product = 12.0, 5.0, 0.03 + 2.0 * 0.5**2, 2.0 * 0.3 * 0.5
    angle = 0.4
    for _ in range(20):  # what the spring pulls at, and what the turning does
        pull = stiffness * (angle - 0.8) + product * speed**2 * math.sin(angle)
        angle -= pull / (stiffness + product * speed**2 * math.cos(angle))
    stiff = stiffness + product * speed**2 * math.cos(angle)
    if driven:
        squared = stiff / arm
    else:  # the disc slows down and speeds up as the arm moves, with all momentum kept
        both = 0.1 + 2.0 * 0.3**2 + arm + 2.0 * product * math.cos(angle)
        stiff += 4.0 * (product * math.sin(angle) * speed) ** 2 / both
        squared = stiff / (arm - (arm + product * math.cos(angle)) ** 2 / both)
    found = carousel(driven).steady()
    assert_allclose(found.q["pin.angle"], angle, rtol=1e-10)
    if not driven:
        assert_allclose(carousel(driven).steady(cyclic=["arm.theta"]).q["pin.angle"], angle, rtol=1e-10)
    assert found.stability == ("stable" if driven else "indifferent")
    system = carousel(driven).linearise(at="steady")
    moving = [x for x in system.eigenvalues() if x != 0.0]
    assert_allclose(moving, [1j * math.sqrt(squared), -1j * math.sqrt(squared)], rtol=1e-9)
    assert len(system.states) == len(moving) + (not driven)


@pytest.mark.slow
def test_what_is_at_an_end_of_its_swing_is_no_state():
    """An Euler parameter of the shaft hardly changes next to where it is 1, and its rate follows from it by 1/0."""
    found = symgen.load("flyball-governor").linearise(at="steady", start={"bearing.angle": 1e-9})
    assert {"bearing.angle.rate", "hinge1.angle", "sleeve.displacement"} < set(found.states)
    assert len(found.states) == 7


def test_a_wheel_by_itself_is_steady():
    """All its rates change by is rounding, with which they were compared."""
    wheel = {"mass": 1.0, "inertia": 0.1, "position": [0.3, 3e-10], "angle": 1e-9, "angular_velocity": 4.0}
    axle = rods.pin("ground", "wheel", rods.GROUND2, [-0.3, 0.0])
    found = rods.model({"wheel": wheel}, {"axle": axle}, gravity=[0.0, 0.0]).linearise(at="start")
    assert found.states == ("axle.angle.rate",)
    assert_allclose(found.A, [[0.0]], atol=1e-12)


@pytest.mark.slow
@pytest.mark.parametrize("driven", [None, "second"])
def test_wheels_in_mesh_turn_on_together(driven):
    """A bob on a spring along a spoke of the second wheel; the way along which nothing changes is that of both."""
    speed, stiffness, mass = -2.0, 20.0, 0.5
    bodies = {
        "pinion": {"mass": 1.0, "inertia": 0.02, "position": [0.0, 0.0], "angular_velocity": -3.0 * speed},
        "wheel": {"mass": 2.0, "inertia": 0.2, "position": [0.4, 0.0], "angular_velocity": speed},
        "bob": {"mass": mass, "inertia": 0.01, "position": [0.6, 0.0]},
    }
    joints = {
        "first": rods.pin("ground", "pinion", rods.GROUND2, "centre"),
        "second": rods.pin("ground", "wheel", [0.4, 0.0], "centre"),
        "teeth": {"type": "gear", "between": ["pinion", "wheel"], "radii": [0.1, 0.3]},
        "spoke": rods.pin("wheel", "bob", "centre", "centre", "translational", axis=[1.0, 0.0]),
    }
    if driven is not None:
        joints["motor"] = {"type": "driver", "joint": driven, "value": f"{speed}*t"}
    spring = {"type": "spring-damper", "between": ["wheel", "bob"], "at": [[-1.0, 0.0], "centre"]}
    spring |= {"stiffness": stiffness, "free_length": 1.2}
    model = rods.model(bodies, joints, gravity=[0.0, 0.0], forces={"spring": spring})
    radius = stiffness * 0.2 / (stiffness - mass * speed**2)
    assert_allclose(model.steady().q["spoke.displacement"], radius, rtol=1e-10)
    stiff = stiffness - mass * speed**2
    if driven is None:
        stiff += (2.0 * mass * radius * speed) ** 2 / (0.2 + 0.01 + 0.02 * 3.0**2 + mass * radius**2)
    moving = [x for x in model.linearise(at="steady").eigenvalues() if x != 0.0]
    assert_allclose(moving, [1j * math.sqrt(stiff / mass), -1j * math.sqrt(stiff / mass)], rtol=1e-9)


@pytest.mark.parametrize(("matrix", "expected"), [(np.zeros((0, 3)), 0), (np.zeros((3, 0)), 0), (np.ones((2, 2)), 1)])
def test_the_rank_of_an_empty_matrix_is_0(matrix, expected, monkeypatch):
    """NumPy 2.0 has no largest singular value of an empty matrix."""
    of_numpy = np.linalg.matrix_rank

    def as_numpy_2_0(a, tol=None):
        assert np.linalg.svd(a, compute_uv=False).max() >= 0.0
        return of_numpy(a, tol)

    monkeypatch.setattr(np.linalg, "matrix_rank", as_numpy_2_0)
    assert numerical_rank(matrix) == numerical_rank(matrix, 1e-9) == expected
