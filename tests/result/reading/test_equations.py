"""Equations as SymPy objects: the emitted functions' numbers, and what SymPy itself says of them."""

import pickle
from functools import partial

import numpy as np
import pytest
import sympy as sp
from support.emitted import Emitted, mechanism_of
from support.in_coordinates import in_coordinates
from support.models import EVERYTHING, ROUGH
from support.rotation import of_turn

import symgen
from symgen.base.errors import InputError
from symgen.base.ir.program import MODE_NUMBERS
from symgen.describe import catalogue
from symgen.describe.files.load import load_mechanism
from symgen.result.reading import symbolic_equations as reading
from symgen.result.reading.symbolic_equations import SymbolicEquations
from symgen.run.compiling.choices import mechanism_on_tree

SMALL = ["four-bar", "driven-four-bar", "slider-crank", "pendulum", "heavy-top", "spherical-double-pendulum"]
SMALL += ["rolling-disc", "free-rigid-body"]
NAMES = ("Phi", "nu", "D", "gamma", "N", "M", "f", "T", "V", "power", "b", "c")


def within(bound, found, expected, scale=None):
    found, expected = np.asarray(found, dtype=float).ravel(), np.asarray(expected, dtype=float).ravel()
    size = np.abs(expected).max(initial=0.0) if scale is None else scale
    assert np.abs(found - expected).max(initial=0.0) <= bound * max(size, 1e-300), (found, expected)


def random_modes(equations, rng):
    """Numbers of the rows with bounds: the first row is in force, friction of the others slides, stops are open.

    Besides, rows that are off have an effort, as friction has that shares its hold with others.
    """
    of_row = [
        (1.0, 0.0, 0.0, 0.0, 0.0) if i == 0 else (0.0, 0.0, rng.choice([-1.0, 1.0]), 0.0, rng.uniform(-1.0, 1.0))
        for i in range(len(equations.modes) // MODE_NUMBERS)
    ]
    return [number for row in of_row for number in row]


def in_force(equations, modes):
    """Names of the rows that are in force."""
    numbers = dict(zip(equations.modes, modes, strict=True))
    return {row for row in equations.rows if numbers.get(f"{row}.held", 1.0)}


def agrees(mechanism, seed=3):
    """What SymPy computes is what emitted functions do, at a random state."""
    emitted, equations = Emitted(mechanism), SymbolicEquations(mechanism)
    # strains of a stiff beam are small differences of positions
    close = partial(within, 1e-10 if mechanism.beams else 1e-12)
    rng = np.random.default_rng(seed)
    q, v = rng.uniform(-1.0, 1.0, emitted.info.nq), rng.uniform(-1.0, 1.0, emitted.info.nv)
    if any(joint.kind == "rolling-disc" for joint in mechanism.joints):  # rims are where axes have length 1
        for first, _ in emitted.info.spins:
            q[first : first + 4] /= np.linalg.norm(q[first : first + 4])
    values = symgen.load(mechanism).parameters()
    modes = random_modes(equations, rng)
    expected = emitted.at(0.3, q, v, emitted.parameters(values), modes=modes)
    numbers = equations.lambdify(*NAMES)(0.3, q, v, modes=modes)
    phi, nu, d, gamma, n, m, f, kinetic, potential, power, b, c = numbers
    lengths = np.abs(q).max() + 1.0 + np.abs(expected.phi).max(initial=0.0)
    close(phi, expected.phi, lengths)  # of differences of coordinates
    close(nu, expected.nu)
    close(d, expected.d)
    off = [name not in in_force(equations, modes) for name in equations.rows]
    close(np.where(off, 0.0, np.ravel(gamma)), expected.gamma)  # observed residuals of rows that are off are 0
    close(kinetic, expected.status["kinetic"])
    close(potential, expected.status["potential"], max(1.0, abs(expected.status["potential"])))
    if mechanism.topology is None and not mechanism.has_modal_bodies:  # whose M follows the state
        close(np.diag(m), expected.masses)
    pushed = np.asarray(d).T @ expected.multipliers
    balance = np.asarray(m) @ expected.acceleration + pushed
    close(balance, f, max(np.abs(f).max(initial=0.0), np.abs(pushed).max(initial=0.0), 1.0))
    close(np.asarray(n) @ v, expected.rates)
    driven = (np.asarray(b) @ expected.acceleration).item() + float(c)  # drivers of prescribed coordinates work too
    assert (equations.derived.driving is None) == (driven == 0.0)
    work = power + driven - expected.multipliers @ np.asarray(nu).ravel()
    close(work, expected.power, max(1.0, abs(power), abs(driven), np.abs(expected.multipliers).max(initial=0.0)))


@pytest.mark.parametrize("name", SMALL)
def test_numbers_are_those_of_the_emitted_functions(name):
    agrees(load_mechanism(name))


@pytest.mark.parametrize("name", ["four-bar", "spherical-double-pendulum"])
def test_numbers_are_those_of_the_emitted_functions_in_joint_coordinates(name):
    agrees(mechanism_on_tree(load_mechanism(name)))


@pytest.mark.slow_cases("everything")
@pytest.mark.parametrize("raw", [EVERYTHING, ROUGH], ids=["everything", "rough"])
def test_numbers_of_every_kind_and_of_tables(raw):
    agrees(mechanism_of(raw))


@pytest.mark.slow
@pytest.mark.parametrize(("name", "coordinates"), of_turn(in_coordinates(catalogue.all_names()), 9))
def test_numbers_of_the_whole_catalogue(name, coordinates):
    mechanism = load_mechanism(name)
    agrees(mechanism_on_tree(mechanism) if coordinates == "joint" else mechanism)


@pytest.mark.by_turns(6)
@pytest.mark.slow_cases(
    "dry-four-bar-joint",
    "geneva-absolute",
    "geneva-joint",
    "slider-crank-with-clearance-absolute",
    "dry-four-bar-absolute",
    "slider-crank-with-clearance-joint",
    "woodpecker-absolute",
)
@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
@pytest.mark.parametrize("name", [name for name in catalogue.all_names() if load_mechanism(name).bounded])
def test_numbers_of_mechanisms_with_dry_friction_and_stops(name, coordinates):
    mechanism = load_mechanism(name)
    agrees(mechanism_on_tree(mechanism) if coordinates == "joint" else mechanism)


@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
def test_dry_friction_slides_in_the_direction_of_the_velocities_by_default(coordinates):
    e = symgen.load("dry-four-bar").equations_in(coordinates)
    compute, rng = e.lambdify("f"), np.random.default_rng(2)
    q, v = rng.uniform(-1.0, 1.0, len(e.q)), rng.uniform(-1.0, 1.0, len(e.v))
    rates = [rate.subs(dict(zip(e.v.values(), v, strict=True))) for rate in e.joint_rates.values()]
    signs = {
        f"{name.partition('.')[0]}.friction.sign": np.sign(float(x)) for name, x in zip("ABCD", rates, strict=True)
    }
    within(0.0, compute(0.0, q, v), compute(0.0, q, v, modes=[signs.get(name, 0.0) for name in e.modes]))
    still, torque = compute(0.0, q, 0 * v), symgen.load("dry-four-bar").parameters()["torque"]
    assert np.abs(compute(0.0, q, v) - compute(0.0, q, v, modes=[0.0] * len(e.modes))).max() > 0.5 * torque
    assert np.abs(still - compute(0.0, q, 0 * v, modes=[0.0] * len(e.modes))).max() == 0.0


def test_states_of_the_file_are_arguments():
    mechanism = mechanism_of(
        {
            "mechanism": {"name": "loaded", "gravity": [0.0, 0.0]},
            "states": {"charge": {"start": 0.5, "rate": "-charge"}},
            "bodies": {"block": {"mass": 2.0, "inertia": 0.1}},
            "forces": {"pull": {"type": "force", "body": "block", "force": ["3*charge", "0"]}},
        }
    )
    compute = SymbolicEquations(mechanism).lambdify("f")
    assert compute(0.0, [0.0] * 3, [0.0] * 3)[0, 0] == 0.0
    assert compute(0.0, [0.0] * 3, [0.0] * 3, states=[0.5])[0, 0] == 1.5


@pytest.mark.slow
def test_shared_terms_of_a_free_body_are_not_called_as_its_velocities_are():
    """A ball that nothing carries hangs on a rod of a pendulum: its velocities are of the state."""
    inertia = [0.1, 0.1, 0.1]
    raw = {
        "mechanism": {"name": "beside", "space": "spatial", "gravity": [0.0, 0.0, -9.81]},
        "bodies": {
            "bob": {"mass": 1.0, "inertia": inertia, "position": [2.0, 0.0, 0.0], "points": {"top": [0.0, 0.0, 1.0]}},
            "ball": {"mass": 1.0, "inertia": inertia},
        },
        "joints": {
            "hinge": {"type": "spherical", "between": ["ground", "bob"], "at": [[2.0, 0.0, 1.0], "top"]},
            "rod": {"type": "distance", "between": ["bob", "ball"], "at": ["centre", [0.3, 0.0, 0.0]], "length": 1.7},
        },
    }
    mechanism = mechanism_on_tree(mechanism_of(raw))
    equations = SymbolicEquations(mechanism)
    of_state = {*equations.q, *equations.v, *equations.parameters}
    assert "ball.vx" in of_state and not of_state & {s.name for s in equations.shared().definitions}
    agrees(mechanism)


def differentiated(equations, expression):
    """d/dt of an expression of t and q along q' = N v."""
    rates = equations.N * sp.Matrix(list(equations.v.values()))
    moved = sp.diff(expression, equations.t)
    return moved + sum((sp.diff(expression, s) * r for s, r in zip(equations.q.values(), rates, strict=True)), sp.S(0))


def vanishes(equations, expression, seed=5):
    rng = np.random.default_rng(seed)
    symbols = [equations.t, *equations.q.values(), *equations.v.values(), *equations.parameters.values()]
    values = dict(zip(symbols, rng.uniform(0.4, 1.2, len(symbols)), strict=True))
    numbers = np.array(sp.lambdify(symbols, sp.Matrix([expression]), "numpy")(*values.values()), dtype=float)
    assert np.abs(numbers).max(initial=0.0) < 1e-12 * 100  # sums of tens of numbers of order 1 to 10


@pytest.mark.by_turns(3)
@pytest.mark.fast("pendulum", "heavy-top", "free-rigid-body")
@pytest.mark.parametrize("name", SMALL)
def test_sympy_itself_finds_the_same_jacobian_gamma_and_masses(name):
    e = symgen.load(name).equations
    q, v = (sp.Matrix(list(s.values())) for s in (e.q, e.v))
    for i, row in enumerate(e.derived.rows):
        if row.phi is not None:
            vanishes(e, (sp.Matrix([e.Phi[i]]).jacobian(q) * e.N - e.D[i, :]))
            vanishes(e, sp.diff(e.Phi[i], e.t) + e.nu[i])
        level = e.D[i, :].dot(v) - e.nu[i] if e.D[i, :] else sp.S(0)
        vanishes(e, differentiated(e, level) + e.gamma[i])
    vanishes(e, sp.hessian(e.T, list(v)) - e.M if e.T != 0 else sp.S(0))


def test_symbols_have_the_names_of_the_file():
    e = symgen.load("four-bar").equations
    assert list(e.q)[:3] == ["crank.x", "crank.y", "crank.theta"]
    assert list(e.v)[2] == "crank.omega"
    assert list(e.parameters) == ["crank_mass", "coupler_mass", "rocker_mass"]
    assert e.rows[2] == "B.x"
    assert e.D[2, 2] == sp.sin(e.q["crank.theta"])
    assert e.M[0, 0] == e.parameters["crank_mass"]
    assert e.coordinates == "absolute"
    assert symgen.load("four-bar").equations_in("joint").coordinates == "joint"


@pytest.mark.slow
def test_shared_terms_have_names_and_mean_what_is_written_without_them():
    e = symgen.load("spherical-double-pendulum").equations
    shared = e.shared()
    names = {s.name for s in shared.definitions}
    assert any(name.endswith(".a00") for name in names)
    planar = symgen.load("four-bar").equations
    known = {s.name: value for s, value in planar.shared().definitions.items()}
    assert known["crank.c"] == sp.cos(planar.q["crank.theta"])
    written = shared.gamma
    for symbol, value in reversed(shared.definitions.items()):
        written = written.subs(symbol, value)
    vanishes(e, written - e.gamma)


def test_values_replace_symbols_everywhere():
    e = symgen.load("four-bar").equations
    changed = e.subs({"crank_mass": 2, e.q["crank.theta"]: 0})
    assert changed.M[0, 0] == 2
    assert changed.D[2, 2] == 0
    assert changed.shared().subs({"crank_mass": 3}).M[0, 0] == 3
    one, other = e.q["crank.x"], e.q["crank.y"]
    turned = e.subs({one: other, other: one})  # at once: one after the other both would be one of them
    assert turned.D == e.D.xreplace({one: other, other: one}) and turned.Phi != e.Phi
    assert turned.Phi == e.Phi.xreplace({one: other, other: one})
    assert turned.subs({one: 2}).Phi == turned.Phi.xreplace({one: sp.Integer(2)})
    rng = np.random.default_rng(1)
    q, v = rng.uniform(size=9), rng.uniform(size=9)
    found = changed.lambdify("D", "f")(0.0, q, v)
    q[2] = 0.0
    expected = e.lambdify("D", "f")(0.0, q, v, [2.0, *list(symgen.load("four-bar").parameters().values())[1:]])
    within(1e-12, found[0], expected[0])
    within(1e-12, found[1], expected[1])
    with pytest.raises(InputError, match="crank_mass"):
        e.subs({"crank_mas": 1})


def test_what_is_too_large_is_written_with_shared_terms_and_says_so(monkeypatch):
    monkeypatch.setattr(reading, "LARGEST", 40)
    e = symgen.load("four-bar").equations
    assert any(note.startswith("gamma would have 54 operations") for note in e.notes)
    assert e.definitions
    assert {s.name for s in e.gamma.free_symbols} & {s.name for s in e.definitions}
    assert symgen.load("pendulum").equations.notes == ()


def test_latex_and_notebooks():
    e = symgen.load("four-bar").equations
    assert r"\theta_{\mathrm{crank}}" in e.latex("Phi")
    moving = sp.Function("phi")(e.t)
    assert r"\varphi" in e.subs({"crank.theta": moving}).latex("Phi")
    assert r"\dot {\varphi}" in e.subs({"crank.omega": moving.diff(e.t)}).latex("gamma")
    assert r"\begin{array}{@{}cccccccccccc@{}}" in symgen.load("spherical-double-pendulum").equations.latex("M")
    assert e._repr_latex_().startswith("$")
    page = e._repr_html_()
    assert "<details>" in page and "four-bar" in page
    with pytest.raises(InputError, match="quantity"):
        e.quantity("Psi")


def test_a_model_with_equations_can_be_pickled():
    model = symgen.load("pendulum")
    assert model.equations.T != 0
    assert pickle.loads(pickle.dumps(model)).equations.M == model.equations.M


ARM = """
[mechanism]
name = "arm"
gravity = [0, -9.81]
[parameters]
speed = 1.3
[inputs]
push = 0.4
[bodies.upper]
mass = 1.2
inertia = 0.2
centre_of_mass = [0.3, 0.1]
[bodies.fore]
mass = 0.8
inertia = 0.1
centre_of_mass = [0.2, 0.0]
position = [0.5, 0.0]
[joints.shoulder]
type = "revolute"
between = ["ground", "upper"]
at = [[0, 0], [0, 0]]
[joints.elbow]
type = "revolute"
between = ["upper", "fore"]
at = [[0.5, 0], [0, 0]]
[joints.motor]
type = "driver"
joint = "shoulder"
value = "speed*t + 0.3*sin(2*t)"
[forces.wind]
type = "force"
body = "fore"
at = [0.4, 0]
force = ["push", "-0.1*fore.vy"]
"""


@pytest.mark.slow
def test_the_power_of_drivers_without_rows_is_what_energy_gains(tmp_path):
    """By the chain rule over T and V with v' = M^-1 f, at random states: no row, so nothing else does work."""
    path = tmp_path / "arm.toml"
    path.write_text(ARM)
    e = symgen.load(str(path)).equations_in("joint")
    assert len(e.v) == 1 and e.b.shape == (1, 1)
    q, v, t = next(iter(e.q.values())), next(iter(e.v.values())), e.t
    acceleration = (e.M.inv() * e.f)[0]
    total = e.T + e.V
    gained = sp.diff(total, t) + sp.diff(total, q) * (e.N * sp.Matrix([v]))[0] + sp.diff(total, v) * acceleration
    given = e.power + e.b[0] * acceleration + e.c
    symbols = [t, q, v, *e.parameters.values()]
    both = sp.lambdify(symbols, [gained, given], "math")
    rng = np.random.default_rng(4)
    for _ in range(20):
        left, right = both(*rng.uniform(-2, 2, len(symbols)))
        assert left == pytest.approx(right, rel=1e-11, abs=1e-11)
    assert "b =" in e.latex() and "c =" in e.latex()
    assert "power of the drivers" in e._repr_html_()
    bodies = symgen.load(str(path)).equations
    assert (
        bodies.b == sp.zeros(1, len(bodies.v)) and bodies.c == 0 and "power of the drivers" not in bodies._repr_html_()
    )
