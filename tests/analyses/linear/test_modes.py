"""Modes and linear systems at rest, by closed forms, SymPy's Linearizer, complex steps and minimal coordinates."""

import math
import sys
import types

import numpy as np
import pytest
import sympy as sp
from numpy.testing import assert_allclose
from scipy.integrate import solve_ivp
from scipy.special import roots_laguerre
from support import bricard
from support.emitted import mechanism_of
from sympy.physics.mechanics import LagrangesMethod, ReferenceFrame, dynamicsymbols

import symgen
from analyses import rods
from symgen.analyses.state.algebra import eigenvalues_with_zeros
from symgen.base.errors import InputError


@pytest.mark.fast("2", "10")
@pytest.mark.parametrize("n", [2, 10, 40])
def test_a_hanging_chain_has_the_zeros_of_laguerre_s_polynomial(n):
    found = rods.chain(n).modes()
    squares = rods.GRAVITY * roots_laguerre(n)[0]
    assert found.degrees_of_freedom == n
    assert_allclose(found.omega_squared, squares, rtol=1e-12)
    assert_allclose(found.eigenvalues.imag[:n], np.sqrt(squares)[::-1], rtol=1e-12)
    assert np.all(found.eigenvalues.real == 0.0)


def test_shapes_are_normalised_and_tables_sum_to_one():
    model = rods.chain(5)
    found = model.modes()
    gram = found.shapes.real @ found.shapes.real.T  # all masses are 1 kg
    assert_allclose(gram, np.eye(5), atol=1e-12)
    assert_allclose(sum(found.participation.values()), 1.0, rtol=1e-12)
    assert_allclose(sum(found.stiffening.values()), 1.0, rtol=1e-10)
    share = found.participation["m4"][0]  # energies by hand: squares of the shape's components
    lowest = found.shapes[0].real
    assert_allclose(share, np.sum(lowest[-2:] ** 2), rtol=1e-12)
    # links stiffen by what they carry: N (difference of displacements)^2 / l over omega^2
    across = np.diff(np.concatenate([[0.0], lowest[::2]]))
    links = np.array([found.stiffening[f"l{i}"][0] for i in range(5)])
    assert_allclose(links, rods.GRAVITY * np.arange(5, 0, -1) * across**2 / found.omega_squared[0], rtol=1e-9)


@pytest.mark.slow
def test_bricard_s_redundant_row_is_harmless():
    model = symgen.load("bricard")
    rest = model.equilibrium()
    found = model.modes()
    square, slope = bricard.square_at(math.pi / 2)
    assert abs(slope) < 1e-12 and rest.not_unique  # the first rod has turned by a right angle
    assert_allclose([rest.q["rod1.x"], rest.q["rod1.z"]], [0.0, -0.5], atol=1e-12)
    assert_allclose(found.omega_squared, [square], rtol=1e-9)
    assert_allclose(model.modes(coordinates="joint").omega_squared, [square], rtol=1e-9)


def test_damped_eigenvalues_are_those_of_the_textbook():
    model = rods.mass_spring_damper()
    found, root = model.modes(), 50.0 * math.sqrt(1 - 0.05**2)
    assert_allclose(found.eigenvalues, [-2.5 + 1j * root, -2.5 - 1j * root], rtol=1e-13)
    assert not len(found.omega_squared)
    assert_allclose([found.frequencies[0], found.damping[0]], [root / (2 * math.pi), 0.05], rtol=1e-12)


def test_inputs_and_outputs_have_their_names():
    model = rods.mass_spring_damper()
    found = model.linearise(states=["body.x"])
    assert (found.states, found.inputs, found.outputs) == (("body.x", "body.vx"), ("push",), ("where", "pull", "both"))
    assert_allclose(found.A, [[0.0, 1.0], [-2500.0, -5.0]], rtol=1e-13)
    assert_allclose(found.B, [[0.0], [1 / 1.6]], rtol=1e-13)
    # the spring pulls the body back: its force is what it exerts along its length, dampers included
    assert_allclose(np.abs(found.C), [[1.0, 0.0], [4000.0, 8.0], [0.0, 2.0]], atol=1e-12)
    assert_allclose(found.D, [[0.0], [0.0], [1.0]], atol=1e-15)
    space = found.state_space()
    assert_allclose(np.linalg.eigvals(space.A).imag, [49.93746, -49.93746], rtol=1e-6)
    assert (space.B.shape, space.C.shape, space.D.shape) == ((2, 1), (3, 2), (3, 1))


@pytest.mark.slow
def test_four_bar_by_sympy_s_linearizer():
    """Three absolute angles and two conditions, linearised at the stable equilibrium by SymPy."""
    angles, t = dynamicsymbols("a b c"), dynamicsymbols._t
    (a, b, c), speeds = angles, [x.diff(t) for x in angles]
    lengths, masses, g = (1, 3, 3), (1, 3, 3), sp.Rational(981, 100)

    def end(length, angle):
        return sp.Matrix([length * sp.cos(angle), length * sp.sin(angle)])

    middles = [end(1, a) / 2, end(1, a) + end(3, b) / 2, sp.Matrix([4, 0]) + end(3, c) / 2]
    kinetic = sum(
        m * (p.diff(t).dot(p.diff(t))) / 2 + m * sp.Rational(length**2, 24) * s**2
        for m, length, p, s in zip(masses, lengths, middles, speeds, strict=True)
    )
    height = sum(m * g * p[1] for m, p in zip(masses, middles, strict=True))
    loop = list(end(1, a) + end(3, b) - sp.Matrix([4, 0]) - end(3, c))
    method = LagrangesMethod(kinetic - height, angles, hol_coneqs=loop, frame=ReferenceFrame("N"))
    method.form_lagranges_equations()
    model = rods.four_bar()
    rest = model.equilibria(("crank.theta", np.linspace(4.0, 5.0, 3)))[0]
    values = {x: rest.q[f"{n}.theta"] for x, n in zip(angles, ("crank", "coupler", "rocker"), strict=True)}
    point = {**values, **dict.fromkeys(speeds, 0), **{s.diff(t): 0 for s in speeds}}
    lam = sp.symbols("l1 l2")
    balance = method.eom.subs(dict(zip(method.lam_vec, lam, strict=True))).subs(point)
    solved = np.linalg.lstsq(
        np.array(balance.jacobian(lam), float), -np.array(balance.subs(dict.fromkeys(lam, 0)), float), rcond=None
    )[0]
    point |= dict(zip(method.lam_vec, solved.ravel(), strict=True))
    linear = method.linearize(
        q_ind=[a], qd_ind=[speeds[0]], q_dep=[b, c], qd_dep=speeds[1:], op_point=point, A_and_B=True
    )
    matrix = np.array(linear[0], float)
    found = model.linearise(at="start", states=["crank.theta"], start={"crank.theta": rest.q["crank.theta"]})
    assert_allclose(found.A, matrix, rtol=1e-9, atol=1e-9)  # the start is closed to rounding of its positions
    assert_allclose(-found.A[1, 0], 22.57021890188508, rtol=1e-9)


def test_what_drivers_hold_has_the_empty_system():
    model = symgen.load("driven-four-bar")
    assert model.linearise().states == () and model.modes().degrees_of_freedom == 0


CART = {
    "mechanism": {"name": "cart", "gravity": [0.0, -9.81]},
    "bodies": {
        "cart": {"mass": 2.0, "inertia": 0.1, "position": [0.1, 0.0]},
        "pole": {"mass": 1.0, "inertia": 0.08, "points": {"pin": [-0.5, 0.0]}, "position": [0.1, -0.5]}
        | {"angle": "-pi/2"},
    },
    "joints": {
        "rail": {"type": "translational", "between": ["ground", "cart"], "at": [[0, 0], "centre"], "axis": [1, 0]},
        "pin": {"type": "revolute", "between": ["cart", "pole"], "at": ["centre", "pin"]},
        "motor": {"type": "driver", "joint": "rail", "value": "0.1"},
    },
}


def driven_cart(value):
    joints = CART["joints"] | {"motor": CART["joints"]["motor"] | {"value": value}}
    return symgen.Model(mechanism_of({**CART, "joints": joints}))


@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
def test_a_driver_that_moves_is_named_at_once(coordinates):
    """A cart that a sine moves: nothing about an equilibrium, in one sentence; the equilibrium itself holds it."""
    model, settings = driven_cart("0.1 + 0.05*sin(3*t)"), symgen.Settings(coordinates=coordinates)
    for analysis in (model.modes, model.linearise):
        with pytest.raises(InputError, match=r"'motor', which moves at t = 0 s by '0.1 \+ 0.05\*sin\(3.0\*t\)'"):
            analysis(settings)
    rest = model.equilibrium(settings)
    assert rest.stability == "stable" and rest.q["cart.x"] == pytest.approx(0.1, abs=1e-12)
    assert rest.notes == ("motor moves at t = 0 s; the equilibrium holds it there",)


@pytest.mark.parametrize("value", ["0.1", "0.1 + 0.2*max(0, t - 1)**3"])
def test_modes_beside_a_driver_at_rest_are_those_of_the_pole(value):
    model = driven_cart(value)
    arm = 1.0 * 0.5**2 + 0.08
    assert model.modes().frequencies == pytest.approx([np.sqrt(9.81 * 0.5 / arm) / (2 * np.pi)], rel=1e-9)
    assert model.equilibrium().notes == ()


@pytest.mark.slow
def test_a_few_modes_beside_a_driver_that_moves_are_refused_alike():
    with pytest.raises(InputError, match="'motor', which moves"):
        driven_cart("0.1 + 0.05*sin(3*t)").modes(count=1)


def test_a_library_that_is_missing_is_named(monkeypatch):
    monkeypatch.setitem(sys.modules, "control", None)
    with pytest.raises(InputError, match="pip install control"):
        rods.mass_spring_damper().linearise().to_control()


def test_names_are_handed_on_to_control(monkeypatch):
    def ss(*matrices, **names):
        return [m.shape for m in matrices], names

    monkeypatch.setitem(sys.modules, "control", types.SimpleNamespace(ss=ss))
    shapes, names = rods.mass_spring_damper().linearise().to_control()
    assert shapes == [(2, 2), (2, 1), (3, 2), (3, 1)] and names["inputs"] == ["push"]


@pytest.mark.parametrize(
    ("asked", "says"),
    [
        (
            {"at": "start"},
            "expected a state of rest, or of a motion in which no state changes, got one where 'B.angle.rate",
        ),
        ({"states": ["crank.thet"]}, "did you mean 'crank.theta'"),
        ({"states": ["crank.theta", "rocker.theta"]}, "states that do not depend on each other"),
        ({"states": ["crank.omega"]}, "states whose rates follow from them"),
        ({"at": "rest"}, "equilibrium, start, steady, a time above 0 in s"),
        ({"at": -1.0}, "above 0"),
        ({"cyclic": ["A.angle"]}, "names where a steady motion is searched"),
        ({"at": 0.3}, "a state of rest, or of a motion in which no state changes"),
    ],
)
def test_what_has_no_linear_system_is_refused(asked, says):
    with pytest.raises(InputError, match=says):
        rods.four_bar().linearise(**asked)


def test_a_motion_has_the_system_of_the_instant_if_it_is_asked_for():
    """About a swinging rod: theta'' = -1.5 g cos(theta) has its own slope at every angle."""
    model = rods.hanging("revolute")
    found = model.linearise(at=0.2, instantaneous=True, states=["rod.theta"], start={"rod.theta": -1.3})
    own = solve_ivp(lambda t, y: [y[1], -14.715 * math.cos(y[0])], (0, 0.2), [-1.3, 0.0], rtol=1e-12, atol=1e-14)
    assert_allclose([found.about["rod.theta"], found.about["rod.omega"]], own.y[:, -1], rtol=1e-9)
    assert_allclose(found.A, [[0.0, 1.0], [14.715 * math.sin(own.y[0, -1]), 0.0]], rtol=1e-9, atol=1e-12)


@pytest.mark.by_turns(2)
@pytest.mark.slow
@pytest.mark.parametrize(("at", "zeros"), [("equilibrium", 2), ("steady", 1)])
def test_what_a_cyclic_coordinate_leaves_free_is_exactly_zero(at, zeros):
    """A double zero with one vector: rounding would part it into a pair of 4e-7."""
    found = symgen.load("flyball-governor").modes(at=at).eigenvalues
    assert np.sum(found == 0.0) == zeros and np.all(np.abs(found[found != 0.0]) > 1.0)


def test_zeros_are_a_decision_of_rank():
    rng = np.random.default_rng(5)
    turn = np.linalg.qr(rng.standard_normal((7, 7)))[0]
    for small, zeros in ((0.0, 5), (1e-4, 4)):
        a = np.diag([0.0, 0.0, 0.0, -small, 0.0, 3.0, -40.0]) + np.diag([1.0, 2.0, 0.0, 1.0, 0.0, 0.0], 1)
        values, _ = eigenvalues_with_zeros(turn @ a @ turn.T)
        assert np.sum(values == 0.0) == zeros
        assert np.isclose(sorted(values.real)[0], -40.0) and np.isclose(sorted(values.real)[-1], 3.0)


@pytest.mark.by_turns(3)
@pytest.mark.slow
@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
@pytest.mark.parametrize("far", [0.177, 0.3, 1.0 / 3.0])
def test_a_joint_that_holds_nothing_takes_no_freedom(coordinates, far):
    """A mass on a rod's end, and a link from there to the rod's other end, whose row is the rounding of none."""
    end = (0.7304, -0.3957)
    rod = {"mass": 2.0, "inertia": 0.3, "points": {"end": list(end), "other": [far, -0.2273]}, "angle": 0.4}
    c, s = math.cos(0.4), math.sin(0.4)
    place = [c * end[0] - s * end[1], s * end[0] + c * end[1]]
    link = {"type": "distance", "between": ["rod", "bob"], "at": ["other", "centre"]}
    joints = {
        "pin": rods.pin("ground", "rod", rods.GROUND2, "centre"),
        "knot": rods.pin("rod", "bob", "end", "centre"),
        "link": {**link, "length": math.hypot(end[0] - far, end[1] + 0.2273)},
    }
    bob = {"type": "point", "mass": 1.5, "position": place}
    model = rods.model({"rod": rod, "bob": bob}, joints)
    away = math.hypot(*end)
    square = 1.5 * rods.GRAVITY * away / (0.3 + 1.5 * away**2)
    for found in (model.modes(coordinates=coordinates), model.equilibrium(coordinates=coordinates)):
        assert_allclose(found.omega_squared, [square], rtol=1e-12)
    system = model.linearise(coordinates=coordinates)
    assert_allclose(system.eigenvalues(), [1j * math.sqrt(square), -1j * math.sqrt(square)], rtol=1e-12)


@pytest.mark.slow_cases("distances in space")
@pytest.mark.parametrize("kind", ["ball", "distances in space"])
def test_states_that_were_chosen_can_be_given_back_where_bodies_have_euler_parameters(kind):
    model = rods.hanging(kind)
    found = model.linearise()
    assert any(name.startswith("rod.e") for name in found.states)
    again = model.linearise(states=found.states)
    assert again.states == found.states and np.array_equal(again.A, found.A)
    assert_allclose(np.sort(np.abs(model.modes(states=found.states).eigenvalues.imag))[-2:], 14.715**0.5, rtol=1e-9)
    # in another order, which is that of the matrices
    turned = model.linearise(states=found.states[::-1])
    assert turned.states == found.states[::-1]
    assert_allclose(turned.A, found.A[::-1, ::-1], rtol=0.0, atol=1e-12)
    with pytest.raises(InputError, match="do not depend on each other"):
        model.linearise(states=[*found.states, "rod.z"])


@pytest.mark.slow_cases("3")
@pytest.mark.parametrize("size", [1, 3])
def test_a_chain_that_turns_about_the_vertical_has_squares_and_one_of_them_is_zero(size):
    """The shape without stiffness leaves no rounding to compare with; the other squares are those of eigenvalues."""
    found = symgen.load(f"chain:{size}").modes()
    assert len(found.omega_squared) == found.degrees_of_freedom and found.omega_squared[0] == 0.0
    oscillating = np.array([x.imag for x in found.eigenvalues if x.imag > 0.0])
    assert_allclose(np.sort(oscillating**2), found.omega_squared[1:], rtol=1e-12)
