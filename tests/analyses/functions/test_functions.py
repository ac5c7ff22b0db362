"""Dynamics as functions: trees beside own recursions, loops beside differences and NumPy, calls with wrong arrays."""

import sys
import types
from pathlib import Path

import numpy as np
import pytest
from support.recursion import Recursion, random_robot, urdf

from symgen.analyses.functions import array_function
from symgen.api import Model, load
from symgen.base.errors import InputError
from symgen.describe.files.builder import MechanismBuilder
from symgen.describe.files.validate import validate
from symgen.describe.formats import read_robot

BOUNDED = Path(__file__).resolve().parents[3] / "benchmarks" / "bounded" / "files"
#: Parents and kinds of joints: a chain, slides, forks.
ROBOTS = {
    "chain": ([-1, 0, 1], "rrr"),
    "slides": ([-1, 0, 1], "prp"),
    "fork": ([-1, 0, 0, 1, 2], "rrrpr"),
    "two": ([-1, -1, 0, 1], "rprr"),
}


@pytest.fixture(scope="module", params=ROBOTS)
def robot(request, tmp_path_factory):
    limbs = random_robot(len(request.param), *ROBOTS[request.param])
    path = tmp_path_factory.mktemp("robots") / f"{request.param}.urdf"
    path.write_text(urdf(limbs), encoding="utf-8")
    return load(path), Recursion(limbs)


def states(n, count=3, seed=1):
    rng = np.random.default_rng(seed)
    return [tuple(rng.uniform(-1.0, 1.0, n) for _ in range(4)) for _ in range(count)]


def order_of(functions, recursion):
    """Place of each velocity among the limbs."""
    names = [f"j_{limb.name}" for limb in recursion.limbs]
    return np.array([names.index(x.name.partition(".")[0]) for x in functions.velocities])


def close(value, exact, part=1e-12):
    return np.abs(value - exact).max() <= part * max(1.0, np.abs(exact).max())


@pytest.mark.slow
def test_trees_are_those_of_own_recursions(robot):
    model, recursion = robot
    f = model.functions()
    order, n = order_of(f, recursion), len(recursion.limbs)
    assert len(f.velocities) == n and not f.rows
    back = np.argsort(order)
    for q, v, a, effort in states(n):
        of = q[back], v[back]
        mass = recursion.mass(of[0])[np.ix_(order, order)]
        bias = recursion.efforts(*of, np.zeros(n))[order]
        assert close(f.mass_matrix(q), mass)
        assert close(f.bias(q, v), bias)
        assert close(f.inverse_dynamics(q, v, a), recursion.efforts(*of, a[back])[order])
        assert close(f.forward_dynamics(q, v, effort), np.linalg.solve(mass, effort - bias), 1e-11)
        assert abs(f.kinetic_energy(q, v) - 0.5 * v @ mass @ v) < 1e-12 * (v @ mass @ v)


@pytest.mark.slow_cases("fork", "chain", "slides")
def test_frames_are_those_of_own_recursions(robot):
    model, recursion = robot
    f = model.functions()
    tool, order = f.frame("tool"), order_of(f, recursion)
    for q, v, _, _ in states(len(order)):
        back = np.argsort(order)
        turn, place, jacobian = recursion.tool(q[back])
        assert close(tool.pose(q), np.block([[turn, place[:, np.newaxis]], [0.0, 0.0, 0.0, 1.0]]))
        assert close(tool.jacobian(q), jacobian[:, order])
        assert close(tool.velocity(q, v), jacobian[:, order] @ v)
        both = np.kron(np.eye(2), turn.T)
        assert close(tool.local.jacobian(q), both @ jacobian[:, order])
        assert close(tool.local.velocity(q, v), both @ jacobian[:, order] @ v)
        for frame in (tool, tool.local):
            rate = difference(lambda x, frame=frame, v=v: frame.jacobian(x) @ v, q, v)
            assert close(frame.jacobian_rate(q, v), rate, 1e-9)


def difference(function, x, direction, h=1e-3):
    """Derivative along a direction, of the sixth order."""
    weights = {1: 3 / 4, 2: -3 / 20, 3: 1 / 60}
    return sum(w / h * (function(x + k * h * direction) - function(x - k * h * direction)) for k, w in weights.items())


def of_argument(function, state, place):
    """A function of one of its arguments, with the others as in a state."""
    return lambda x: np.asarray(function(*state[:place], x, *state[place + 1 :]))


@pytest.mark.by_turns(3)
@pytest.mark.slow
def test_derivatives_of_robots_are_those_of_differences(robot):
    compare_derivatives(robot[0].functions())


def test_derivatives_are_those_of_differences():
    rod = {"mass": 2.0, "inertia": 0.1, "points": {"end": (0.7, 0.1)}, "centre_of_mass": (0.3, 0.0)}
    builder = MechanismBuilder("arm", gravity=(0.0, -9.81)).body("upper", **rod).body("lower", **rod)
    builder.joint("hip", "revolute", between=("ground", "upper"), at=((0.0, 0.0), (0.0, 0.0)))
    builder.joint("knee", "revolute", between=("upper", "lower"), at=("end", (0.0, 0.0)))
    compare_derivatives(Model(builder.build()).functions("joint"))


@pytest.mark.by_turns(3)
@pytest.mark.slow
@pytest.mark.parametrize("name", ["four-bar", "slider-crank", "bricard", "spatial-slider-crank"])
def test_derivatives_with_rows_are_those_of_differences(name):
    f = load(name).functions("joint")
    q, v = f.start
    rng = np.random.default_rng(0)
    a, effort = rng.uniform(-1.0, 1.0, (2, len(v)))
    v = f.reduction(q)[1] @ np.ones(f.reduction(q)[1].shape[1])
    along = f.reduction(q)[1][:, 0]  # rows that repeat others agree only where loops are closed
    for name, last in (("forward_dynamics", effort), ("inverse_dynamics", a)):
        function = getattr(f, name)
        for by in ("v", function.arguments[2]):
            exact = f.derivative(name, by)(q, v, last) @ along
            place = function.arguments.index(by)
            assert close(
                exact, difference(of_argument(function, (q, v, last), place), (q, v, last)[place], along), 1e-8
            )
        exact = f.derivative(name, "q")(q, v, last)
        if len(f.rows) == f.reduction(q)[1].shape[0] - 1 == np.linalg.matrix_rank(f.constraint_jacobian(q)):
            for k, e in enumerate(np.eye(len(q))):
                assert close(exact[:, k], difference(of_argument(function, (q, v, last), 0), q, e, 1e-4), 1e-7)


def compare_derivatives(f):
    q, v, a, effort = states(len(f.velocities))[0]
    calls = {
        "inverse_dynamics": (q, v, a),
        "forward_dynamics": (q, v, effort),
        "bias": (q, v),
        "kinetic_energy": (q, v),
    }
    for name, state in calls.items():
        function = getattr(f, name)
        for i, by in enumerate(function.arguments[:-1]):
            exact = f.derivative(name, by)(*state)
            for k in range(len(q)):
                slope = difference(of_argument(function, state, i), state[i], np.eye(len(q))[k])
                assert close(exact[..., k], slope, 1e-8), (name, by)
    mass = f.derivative("mass_matrix", "q")(q).reshape(len(q), len(q), len(q))
    assert close(mass @ v, difference(f.mass_matrix, q, v), 1e-8)


LOOPS = [
    ("four-bar", "joint"),
    ("slider-crank", "joint"),
    *(pytest.param(*x, marks=pytest.mark.slow) for x in (("four-bar", "absolute"), ("n-four-bar:2", "joint"))),
    *(pytest.param(*x, marks=pytest.mark.slow) for x in (("bricard", "joint"), ("andrews", "joint"))),
]


@pytest.mark.by_turns(3)
@pytest.mark.slow
@pytest.mark.parametrize(("name", "coordinates"), LOOPS)
def test_loops_are_those_of_differences_and_numpy(name, coordinates):
    f = load(name).functions(coordinates)
    q, v = f.start
    d, mass = f.constraint_jacobian(q), f.mass_matrix(q)
    free = np.linalg.svd(d)[2][np.linalg.matrix_rank(d, 1e-9 * np.abs(d).max()) :]
    v = v + free.T @ np.ones(len(free))
    for k, e in enumerate(np.eye(len(v))):
        along = difference(f.violation, q, f.rates(q, e), 1e-4)
        assert close(d[:, k], along, 1e-9)
    assert np.abs(f.violation(q)).max() < 1e-9
    # the rate of D v where v' is 0, and that of the momentum: Lagrange's equations
    drift = difference(lambda x: f.constraint_jacobian(x) @ v, q, f.rates(q, v), 1e-4)
    assert close(f.gamma(q, v), -drift, 1e-9)
    rng = np.random.default_rng(0)
    effort = rng.uniform(-1.0, 1.0, len(v))
    m = len(d)
    whole = np.block([[mass, d.T], [d, np.zeros((m, m))]])
    right = np.r_[effort - f.bias(q, v), f.gamma(q, v)]
    expected = np.linalg.lstsq(whole, right, rcond=1e-12)[0][: len(v)]
    a = f.forward_dynamics(q, v, effort)
    assert close(a, expected, 1e-9)
    # the shortest efforts that make these accelerations
    shortest = f.inverse_dynamics(q, v, a)
    assert close(free @ shortest, free @ effort, 1e-9)
    assert np.abs(shortest - free.T @ (free @ shortest)).max() < 1e-9 * max(1.0, np.abs(shortest).max())


def test_bias_is_the_gradient_of_the_potential_and_the_lagrangian_of_absolute_coordinates():
    f = load("slider-crank").functions("joint")
    q, v = f.start
    v = np.ones_like(v)
    for k, e in enumerate(np.eye(len(q))):
        momentum = difference(lambda x: f.mass_matrix(x) @ v, q, v, 1e-4)[k]
        force = difference(lambda x, e=e: f.kinetic_energy(x, v) - f.potential_energy(x), q, e, 1e-4)
        assert abs(f.bias(q, v)[k] - (momentum - force)) < 1e-8


@pytest.mark.slow
def test_named_actuators_make_what_is_asked():
    model = load("four-bar")
    f = model.functions("joint")
    q, v = f.start
    d = f.constraint_jacobian(q)
    free = np.linalg.svd(d)[2][len(d) :]
    v = free.T @ np.ones(len(free))
    names = [f"{joint.name}.{label}" for joint in model.mechanism.joints for label, _ in joint.coordinates]
    effort = np.linspace(-1.0, 1.0, len(v))
    a = f.forward_dynamics(q, v, effort)
    needed = free @ (f.mass_matrix(q) @ a + f.bias(q, v))
    for chosen in (names[:1], names[:2], names):
        ways = np.column_stack([way_of(f, name, q, v) for name in chosen])
        expected = np.linalg.lstsq(free @ ways, needed, rcond=None)[0]
        assert close(f.actuated(*chosen)(q, v, a), expected, 1e-9)


def way_of(f, name, q, v):
    """The rate of a joint's angle over velocities, from the difference of the angles of its bodies."""
    joint = next(j for j in f.mechanism.joints if j.name == name.partition(".")[0])
    row = np.zeros(len(v))
    for body, sign in zip(joint.bodies, (-1.0, 1.0), strict=True):
        if body != "ground":
            row += sign * f.frame(body).jacobian(q)[2]
    return row


def test_a_reduced_jacobian_closes_the_loops():
    f = load("four-bar").functions("absolute")
    q, _ = f.start
    names, along = f.reduction(q, ("crank.omega",))
    assert names == ("crank.omega",) and np.abs(f.constraint_jacobian(q) @ along).max() < 1e-12
    frame = f.frame("coupler")
    assert close(frame.reduced_jacobian(q, names), frame.jacobian(q) @ along)
    chosen, _ = f.reduction(q)
    assert len(chosen) == 1
    with pytest.raises(InputError, match="expected 1 velocities that are independent there"):
        f.reduction(q, ("crank.omega", "crank.vx"))
    with pytest.raises(InputError, match=r"got 'crank.omeg'; did you mean 'crank.omega'"):
        f.reduction(q, ("crank.omeg",))


@pytest.mark.slow
@pytest.mark.parametrize("name", ["pendulum", "four-bar"])
def test_accelerations_are_those_of_runs(name):
    model = load(name)
    run = model.simulate(until=0.1, times=[0.0, 0.1], method="lagrange", coordinates="absolute", rtol=1e-11)
    f = model.functions("absolute")
    q, v = np.asarray(run.q)[-1], np.asarray(run.v)[-1]
    assert close(f.forward_dynamics(q, v, np.zeros(len(v))), np.asarray(run.a)[-1], 1e-9)


def test_many_states_and_other_arrays_have_the_same_bits():
    f = load("four-bar").functions("joint")
    q, v = f.start
    assert isinstance(f.bias.__call__, types.BuiltinFunctionType)
    rows = q + 0.01 * np.arange(5.0)[:, np.newaxis]
    many = f.mass_matrix(rows)
    assert many.shape == (5, 3, 3)
    assert all(np.array_equal(many[k], f.mass_matrix(rows[k])) for k in range(5))
    a = f.forward_dynamics(rows, v, np.zeros(3))
    assert np.array_equal(a[2], f.forward_dynamics(rows[2], v, np.zeros(3)))
    assert f.kinetic_energy(rows, v).shape == (5,) and isinstance(f.kinetic_energy(q, v), float)
    plain = f.bias(q, v)
    for other in (q.tolist(), np.repeat(q, 2)[::2], q.astype(">f8")):
        assert np.array_equal(f.bias(other, v), plain)
    out = np.empty(3)
    assert f.bias(q, v, f.p, out) is out and np.array_equal(out, plain)
    matrix = np.empty((3, 3))
    assert f.mass_matrix(q, f.p, matrix) is matrix and np.array_equal(matrix, f.mass_matrix(q))
    assert f.mass_matrix(q, out=matrix) is matrix


def test_states_of_a_stepped_run_are_arguments(monkeypatch):
    model = load("four-bar")
    f, run = model.functions("joint"), model.start(coordinates="joint", integrator="rk4", step=1e-3)
    run.step(0.01)
    plain = f.bias(np.array(run.q), np.array(run.v))
    monkeypatch.setattr(array_function._Converted, "__call__", None)  # they are not converted
    assert np.array_equal(f.bias(run.q, run.v), plain) and type(f.bias(run.q, run.v)) is np.ndarray
    with pytest.raises(TypeError):
        f.bias(run.q.tolist(), run.v)


@pytest.mark.slow
@pytest.mark.parametrize("name", ["press", "bucket"])
def test_functions_have_the_states_of_runs_whose_rows_with_bounds_they_lack(name):
    model = load(BOUNDED / f"{name}.toml")
    f, run = model.functions("joint"), model.start(coordinates="joint", integrator="rk4", step=1e-3)
    run.step(0.2)
    assert [x.name for x in f.coordinates] == list(run.q.names)
    assert [x.name for x in f.velocities] == list(run.v.names)
    assert np.abs(f.violation(run.q)).max() < 1e-12
    run.step(0.4)  # it moves
    assert np.abs(run.v).max() > 0.1
    assert np.abs(f.constraint_jacobian(run.q) @ run.v).max() < 1e-10


def test_numbers_are_arguments():
    model = load("four-bar")
    f = model.functions("joint")
    q, v = f.start
    heavy = f.values(crank_mass=12.0)
    assert np.array_equal(f.mass_matrix(q, heavy), model.functions("joint", {"crank_mass": 12.0}).mass_matrix(q))
    assert np.array_equal(f.mass_matrix(q, {"crank_mass": 12.0}), f.mass_matrix(q, heavy))
    assert not np.array_equal(f.mass_matrix(q), f.mass_matrix(q, heavy))
    exact = f.derivative("bias", "p")(q, v)[:, f.parameters.index("crank_mass")]
    assert close(exact, f.bias(q, v, f.values(crank_mass=f.p[0] + 1.0)) - f.bias(q, v), 1e-12)


def test_calls_keep_no_memory():
    f = load("four-bar").functions("joint")
    q, v = f.start
    matrix, numbers = np.empty((3, 3)), np.dtype(np.float64)
    before = [sys.getrefcount(x) for x in (numbers, q, f.p, matrix)]
    for _ in range(1000):
        f.bias(q, v)
        f.kinetic_energy(q, v)
        f.mass_matrix(q, f.p, matrix)
    after = [sys.getrefcount(x) for x in (numbers, q, f.p, matrix)]
    assert max(abs(b - a) for a, b in zip(before, after, strict=True)) < 10


@pytest.mark.parametrize(
    ("call", "sentence"),
    [
        (lambda f, q, v: f.bias(q[:2], v), r"bias: q: expected an array of shape \(3,\) or \(k, 3\), got one of shape"),
        (lambda f, q, v: f.bias(q, "x"), r"bias: v: expected an array of shape"),
        (lambda f, q, v: f.bias(q), "bias: expected arguments q, v, p and out"),
        (lambda f, q, v: f.bias(q, v, w=1), "got 2 of them and 'w'"),
        (lambda f, q, v: f.bias([q] * 2, [v] * 3), "expected as many states in each argument, got 2 and 3"),
        (lambda f, q, v: f.bias(q, v, f.p, np.empty(2)), "bias: out: expected a writeable array of shape"),
        (lambda f, q, v: f.bias(q, v, {"crank_mas": 1}), "got 'crank_mas'; did you mean 'crank_mass'"),
        (lambda f, q, v: f.frame("coupler.P"), "frame 'coupler.P': expected a body or a point of four-bar"),
        (lambda f, q, v: f.frame("couplr"), "did you mean 'coupler'"),
        (lambda f, q, v: f.derivative("bias", "a"), r"expected an argument of bias \(q, v, p\), got a"),
        (lambda f, q, v: f.derivative("bia", "q"), "did you mean 'bias'"),
        (lambda f, q, v: f.actuated("A.angl"), "expected an input of the file or a coordinate of a joint"),
        (lambda f, q, v: f.forward_dynamics(q + np.nan, v, v), "q: expected finite numbers, got some that are not"),
    ],
)
def test_what_is_wrong_is_said_in_a_sentence(call, sentence):
    f = load("four-bar").functions("joint")
    with pytest.raises(InputError, match=sentence):
        call(f, *f.start)


def parallelogram(mass: float = 1.0) -> Model:
    """Two cranks of 1 m and a coupler of 2 m between pins 2 m apart, driven by a motor."""
    builder = (
        MechanismBuilder("parallelogram", gravity=(0.0, -9.81))
        .input("motor", 0.0, unit="N m")
        .body("crank", mass=1.0, inertia=0.1, points={"P": (1.0, 0.0)}, angle=1.0)
        .body("coupler", mass=mass, inertia=0.1 * mass, points={"Q": (2.0, 0.0)}, position=(0.54, 0.84))
        .body("rocker", mass=1.0, inertia=0.1, points={"Q": (1.0, 0.0)}, position=(2.0, 0.0), angle=1.0)
        .joint("A", "revolute", between=("ground", "crank"), at=((0.0, 0.0), (0.0, 0.0)))
        .joint("P", "revolute", between=("crank", "coupler"), at=("P", (0.0, 0.0)))
        .joint("Q", "revolute", between=("coupler", "rocker"), at=("Q", "Q"))
        .joint("B", "revolute", between=("ground", "rocker"), at=((2.0, 0.0), (0.0, 0.0)))
        .force("drive", "torque", body="crank", torque="2*motor")
    )
    return Model(builder.build())


@pytest.mark.slow
def test_an_input_of_the_file_is_an_actuator():
    f = parallelogram().functions("joint", {"motor": 0.5})
    q, v = f.start
    driven = f.values(motor=3.0)
    a = f.forward_dynamics(q, v, np.zeros(3), driven)
    assert close(f.actuated("motor")(q, v, a), np.array([3.0]), 1e-11)
    assert close(f.actuated("motor")(q, v, a, driven), np.array([3.0]), 1e-11)


def servo():
    """Return a cart whose servo and whose input have limits, as imports of MJCF write them."""
    builder = MechanismBuilder("servo").input("wanted", 0.0, unit="m").body("cart", mass=2.0, inertia=1.0)
    builder.joint("rail", "translational", between=("ground", "cart"), at=((0.0, 0.0), "centre"), axis=(1.0, 0.0))
    spring = "50*min(max(wanted, -0.1), 0.1) - 50*rail.displacement - 3*rail.displacement.rate"
    builder.force("drive", "spring-damper", joint="rail", actuator=f"min(max({spring}, -2), 2)")
    return Model(builder.build())


@pytest.mark.parametrize("names", [("wanted",), (["wanted"],)])
def test_an_input_may_be_a_servo_with_limits(names):
    """m a = 50 (u - x) - 3 v by hand, also where u, or the force at present, is beyond its limits."""
    f = servo().functions("joint")
    for x, v, a in ((0.01, 0.2, 0.5), (1.0, -2.0, 0.5), (0.0, 0.0, 20.0)):
        by_hand = x + (2.0 * a + 3.0 * v) / 50.0
        for present in (0.0, 5.0):
            found = f.actuated(*names)([x], [v], [a], f.values(wanted=present))
            assert close(found, np.array([by_hand]), 1e-11)


def test_a_joint_with_one_coordinate_is_an_actuator_by_its_name():
    f = servo().functions("joint")
    assert f.actuated("rail") is f.actuated("rail.displacement")
    drawn = MechanismBuilder("drawn").body("cart", mass=2.0, inertia=1.0)
    drawn.joint("slot", "pin-in-slot", between=("ground", "cart"), at=((0.0, 0.0), "centre"), axis=(1.0, 0.0))
    with pytest.raises(InputError, match=r"got 'slot'; one of slot\.displacement, slot\.angle"):
        Model(drawn.build()).functions("absolute").actuated("slot")
    with pytest.raises(InputError, match=r"expected names of actuators, each once, got rail, rail\.displacement"):
        f.actuated(["rail", "rail.displacement"])


def test_actuators_have_values_for_accelerations_that_break_rows():
    f = parallelogram().functions("joint")
    q, v = f.start
    a = f.forward_dynamics(q, v, np.zeros(3)) + np.array([0.0, 1.0, 0.0])
    assert np.abs(f.constraint_jacobian(q) @ a - f.gamma(q, v)).max() > 0.1
    _, T = f.reduction(q, ["crank.omega"])
    asked = T[:, 0] @ (f.mass_matrix(q) @ a + f.bias(q, v))  # along the motion that the rows allow
    assert f.actuated("motor")(q, v, a) == pytest.approx(asked / 2.0, rel=1e-12)  # the crank has twice the input


def test_accelerations_that_no_actuator_makes_are_refused():
    builder = MechanismBuilder("disc").input("motor", 0.0, unit="N m").body("disc", mass=1.0, inertia=0.5)
    f = Model(builder.force("drive", "torque", body="disc", torque="motor").build()).functions("absolute")
    still = np.zeros(3)
    assert close(f.actuated("motor")(still, still, [0.0, 0.0, 4.0]), np.array([2.0]))
    with pytest.raises(InputError, match="inverse_dynamics: expected accelerations that the actuators can make"):
        f.actuated("motor")(still, still, [1.0, 0.0, 4.0])
    squared = MechanismBuilder("disc").input("motor", 0.0, unit="N m").body("disc", mass=1.0, inertia=0.5)
    f = Model(squared.force("drive", "torque", body="disc", torque="motor**2").build()).functions("absolute")
    with pytest.raises(InputError, match="actuator 'motor': expected an input that forces are affine in"):
        f.actuated("motor")


def test_singular_positions_are_refused():
    f = parallelogram().functions("joint")
    flat = np.zeros(3)
    with pytest.raises(InputError, match="forward_dynamics: expected a position where the rows have the rank"):
        f.forward_dynamics(flat, flat, flat)
    with pytest.raises(InputError, match="inverse_dynamics: state 1: expected a position where the rows have"):
        f.inverse_dynamics([f.start[0], flat], flat, flat)


@pytest.mark.slow
def test_light_bodies_are_refused():
    f = parallelogram(mass=0.0).functions("absolute")
    q, v = f.start
    with pytest.raises(InputError, match="every velocity has inertia, got one where bodies are too light"):
        f.forward_dynamics(q, v, v)
    assert f.mass_matrix(q)[3, 3] == 0.0
    f = parallelogram(mass=1e-18).functions("absolute")
    assert np.abs(f.constraint_jacobian(q) @ f.forward_dynamics(q, v, v) - f.gamma(q, v)).max() < 1e-13
    with pytest.raises(InputError, match="or bodies that are too light beside others"):
        parallelogram(mass=1e-30).functions("absolute").forward_dynamics(q, v, v)
    free = Model(MechanismBuilder("free").body("a", mass="m", inertia=0.1).parameter("m", 1.0).build())
    f = free.functions("absolute")
    with pytest.raises(InputError, match="one where bodies are too light"):
        f.forward_dynamics(np.zeros(3), np.zeros(3), np.zeros(3), {"m": 0.0})


@pytest.mark.by_turns(2)
@pytest.mark.slow
@pytest.mark.parametrize("floating", [False, True])
def test_coordinates_of_joints_and_bodies_have_the_same_accelerations(floating, tmp_path):
    limbs = random_robot(7, [-1, 0, 1, 0], "rrpr")
    path = tmp_path / "robot.urdf"
    path.write_text(urdf(limbs).replace('<link name="base"/>', BASE if floating else '<link name="base"/>'))
    model = Model(validate(read_robot(path, "urdf", floating=floating).raw, "robot"))
    joint, bodies = model.functions("joint"), model.functions("absolute")
    rng = np.random.default_rng(2)
    start = {x.name.removesuffix(".rate"): rng.uniform(-0.5, 0.5) for x in joint.coordinates if ".j_" in f".{x.name}"}
    start |= {x.name: rng.uniform(-1.0, 1.0) for x in joint.velocities}
    run = model.start(coordinates="joint", integrator="rk4", start=start)
    state, places = run.bodies, [x.name for x in (*bodies.coordinates, *bodies.velocities)]
    q, v = np.array(run.q), np.array(run.v)
    whole = np.array([state[name] for name in places])
    of_bodies = whole[: len(bodies.coordinates)], whole[len(bodies.coordinates) :]
    assert abs(joint.kinetic_energy(q, v) - bodies.kinetic_energy(*of_bodies)) < 1e-12 * joint.kinetic_energy(q, v)
    assert abs(0.5 * v @ joint.mass_matrix(q) @ v - joint.kinetic_energy(q, v)) < 1e-12 * joint.kinetic_energy(q, v)
    a, b = joint.forward_dynamics(q, v, 0.0 * v), bodies.forward_dynamics(*of_bodies, 0.0 * of_bodies[1])
    for frame in ("limb1", "tool"):
        carried, own = joint.frame(frame), bodies.frame(frame)
        assert close(carried.pose(q), own.pose(of_bodies[0]), 1e-12)
        for one, other in ((carried, own), (carried.local, own.local)):
            assert close(one.velocity(q, v), other.velocity(*of_bodies), 1e-12)
            along = one.jacobian(q) @ a + one.jacobian_rate(q, v)
            assert close(along, other.jacobian(of_bodies[0]) @ b + other.jacobian_rate(*of_bodies), 1e-10)


BASE = '<link name="base"><inertial><mass value="4"/><inertia ixx="0.1" iyy="0.2" izz="0.15"/></inertial></link>'


def hinged(**keys) -> Model:
    builder = MechanismBuilder("door").body(
        "leaf", mass=2.0, inertia=0.3, points={"hinge": (-0.5, 0.0)}, position=(0.5, 0.0)
    )
    return Model(builder.joint("pin", "revolute", between=("ground", "leaf"), at=((0.0, 0.0), "hinge"), **keys).build())


def test_dry_friction_slides_and_stops_are_open():
    plain = hinged().functions("joint")
    f = hinged(friction={"sliding": 0.3}, stop={"lower": -0.1, "upper": 0.1}).functions("joint")
    for speed in (-2.0, 0.0, 3.0):
        q, v = np.array([0.5]), np.array([speed])  # beyond the stop
        assert close(f.bias(q, v) - plain.bias(q, v), 0.3 * np.sign(v))
        assert close(f.forward_dynamics(q, v, v), plain.forward_dynamics(q, v, v - 0.3 * np.sign(v)))
    with pytest.raises(InputError, match="functions: expected dry friction with constant bounds, got friction of pin"):
        hinged(friction={"coefficient": 0.1, "radius": 0.02}).functions("joint")
