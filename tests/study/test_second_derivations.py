"""Independent equations of stress studies and comparisons: tables, kinks, states of a file, rotors."""

import numpy as np
import pytest
from scipy.linalg import expm

from symgen import compare, load
from symgen.describe.files.load import validate
from symgen.study.references.independent import IndependentEquations
from symgen.study.references.motion import CompiledEquations
from symgen.study.references.reference import reference_motion
from symgen.study.stress.study import stress
from tests.derive.formulate.test_primitives import ARMS


@pytest.mark.by_turns(3)
@pytest.mark.slow
@pytest.mark.parametrize("name", ["cam-follower", "engine", "scissor-lift"])
def test_both_forms_of_the_equations_are_the_same(name):
    """Tables are read, and the second slope of a kink is zero beside it."""
    mechanism, values = load(name).mechanism, load(name).parameters()
    plain, compiled = (form(mechanism, values) for form in (IndependentEquations, CompiledEquations))
    start = load(name).simulate(until=1e-6, method="lagrange", integrator="rk4", step=1e-6)
    q, v = start.q.values[-1], start.v.values[-1]
    for t in (0.0, 0.013, 9.0):  # at 9 s the ramp of the lift is over
        for a, b in zip(plain.evaluate(t, q, v), compiled.evaluate(t, q, v), strict=True):
            np.testing.assert_allclose(a, b, rtol=1e-9, atol=1e-9 * max(1.0, np.abs(a).max(initial=0.0)))


@pytest.mark.by_turns(2)
@pytest.mark.slow
@pytest.mark.parametrize("name", ["cam-follower", "scissor-lift"])
def test_stress_judges_tables_and_kinks(name):
    study = stress(name, ["gravity"], ["lagrange"], quick=True, jobs=1)
    assert not study.unusable and {row.outcome for row in study.rows} == {"ok"}


LAGGING = """
[mechanism]
name = "lagging"
gravity = [0.0, 0.0]
[bodies.cart]
mass = 2.0
inertia = 0.1
position = [0.1, 0.0]
[joints.rail]
type = "translational"
between = ["ground", "cart"]
at = [[0.0, 0.0], "centre"]
axis = [1.0, 0.0]
angle = 0.0
[forces.spring]
type = "force"
body = "cart"
force = ["-30.0*cart.x - cart.vx + 5.0*lag", 0.0]
[states.lag]
start = 0.3
rate = "2.0*cart.x - lag - 0.5*cart.vx"
[run]
until = 2.0
"""


@pytest.mark.slow
def test_states_of_a_file_have_a_second_derivation(tmp_path):
    """The cart and its lag are linear: both forms of the equations meet a matrix exponential."""
    (path := tmp_path / "lagging.toml").write_text(LAGGING)
    model, times = load(path), np.linspace(0.0, 2.0, 5)
    matrix = np.array([[0.0, 1.0, 0.0], [-15.0, -0.5, 2.5], [2.0, -0.5, -1.0]])
    exact = np.array([expm(matrix * t) @ [0.1, 0.0, 0.3] for t in times])
    q, v = np.array([0.1, 0.0, 0.0]), np.zeros(3)
    found = reference_motion(model.mechanism, {}, q, v, times)
    np.testing.assert_allclose(np.column_stack([found.q[:, 0], found.v[:, 0], found.z]), exact, rtol=0.0, atol=1e-12)
    compiled = CompiledEquations(model.mechanism, {})
    rates = compiled.rate(0.0, compiled.nearest_state(0.0, np.concatenate([q, v, compiled.starts])))
    np.testing.assert_allclose(rates[[0, 3, 6]], matrix @ exact[0], rtol=1e-13, atol=1e-14)
    (row,) = compare(path, ["lagrange"], ["dop853"], rtols=[1e-11], repeat=1).rows
    assert row.status == "ok" and row.error < 1e-10


@pytest.mark.by_turns(4)
@pytest.mark.slow
@pytest.mark.parametrize("where", ["plane", "space"])
def test_rotors_have_a_second_derivation(where):
    """A rotor adds the energy of its rate; a body with a gear, which has equations of its own, moves alike."""
    times, motions = np.array([0.0, 0.2, 0.4]), []
    for rotor in ("keys", "body"):
        model = load(validate(ARMS[where][0](rotor), "file"))
        compiled = model.compile()
        start = model.assemble(compiled)
        q, v = compiled.info.parts(start.y)
        motions.append(
            reference_motion(model.mechanism, model.parameters(), q, v, times).q[:, : 6 if where == "plane" else 14]
        )
        if rotor == "keys" and where == "plane":
            forms = [form(model.mechanism, model.parameters()) for form in (IndependentEquations, CompiledEquations)]
            rates = [form.rate(0.0, form.nearest_state(0.0, form.state(q, v))) for form in forms]
            np.testing.assert_allclose(*rates, rtol=1e-12, atol=1e-12)
    np.testing.assert_allclose(*motions, rtol=0.0, atol=1e-12)
