"""Parameters that change while a run goes on: what follows is the run that begins there with the new values."""

from dataclasses import replace

import numpy as np
import pytest

from symgen.api import load
from symgen.errors import InputError
from symgen.running.prepare import prepare
from symgen.runtime import abi
from symgen.runtime.simulation import Simulation
from symgen.settings import Settings

PAIRS = [
    *(("direct-correction", name) for name in ("rk4", "abm4", "abm", "dop853", "radau5", "sdirk", "rkmk4")),
    *(("lagrange", "newmark"), ("index3-augmented-lagrangian", "trapezoidal")),
    *(("generalized-alpha", "generalized-alpha"), ("coordinate-partitioning", "abm")),
]
UNTIL, STEP, CHANGED = 0.1, 2e-3, {"rod_mass": 3.0, "gravity": 4.0}


@pytest.fixture(scope="module")
def model(tmp_path_factory):
    path = tmp_path_factory.mktemp("changed") / "slider.toml"
    path.write_text(MODEL)
    return load(path)


MODEL = """
[mechanism]
name = "slider-with-spring"
gravity = [0.0, "-gravity"]
[run]
until = 0.2
step = 2e-3
[parameters]
gravity = 9.81
rod_mass = 1.5
stiffness = 40.0
[inputs]
push = 0.0
[bodies.crank]
mass = 1.0
inertia = "0.01*rod_mass"
points = { a = [-0.2, 0.0], b = [0.2, 0.0] }
position = ["0.2*cos(0.6)", "0.2*sin(0.6)"]
angle = 0.6
angular_velocity = 4.0
[bodies.rod]
mass = "rod_mass"
inertia = 0.05
points = { a = [-0.5, 0.0], b = [0.5, 0.0] }
position = ["0.4*cos(0.6) + 0.5*cos(0.23)", "0.2*sin(0.6)"]
angle = -0.23
[joints.A]
type = "revolute"
between = ["ground", "crank"]
at = [[0.0, 0.0], "a"]
[joints.B]
type = "revolute"
between = ["crank", "rod"]
at = ["b", "a"]
[joints.C]
type = "pin-in-slot"
between = ["ground", "rod"]
at = [[0.0, 0.0], "b"]
axis = [1.0, 0.0]
[forces.spring]
type = "torsional-spring-damper"
between = ["ground", "crank"]
stiffness = "stiffness"
damping = 0.1
[forces.push]
type = "torque"
body = "crank"
torque = "push"
"""


def simulation(model, method, integrator, parameters=None, y=None):
    """Return a simulation over `UNTIL`, from a state where one is given."""
    adaptive = integrator in ("abm", "dop853", "radau5", "sdirk")
    more = {} if adaptive else {"step": STEP}
    settings = Settings(
        method=method, integrator=integrator, until=UNTIL, times=[UNTIL], shape="straight", max_violation=1e-3, **more
    )
    run = prepare(model.mechanism, replace(settings, parameters=parameters or {}))
    start = run.start if y is None else replace(run.start, y=y.copy())
    return Simulation(run.compiled, run.plan.integrator, start, run.spec)


def parameters(simulation, values):
    """Return the parameters of a run with others among them."""
    info = simulation.compiled.info
    return np.array([values.get(q.name, x) for q, x in zip(info.parameters, simulation.state.p, strict=False)])


@pytest.mark.parametrize(("method", "integrator"), PAIRS)
def test_what_follows_a_change_is_a_run_with_the_new_values(model, method, integrator):
    whole = simulation(model, method, integrator)
    outputs = whole.outputs(np.zeros(0))
    assert whole.enter(outputs, until=0.5 * UNTIL) == abi.DONE
    middle, gauges = whole.state.y.copy(), whole.state.gauges
    whole.changes.set(parameters(whole, CHANGED))
    assert whole.enter(outputs) == abi.DONE
    rest = simulation(model, method, integrator, CHANGED, middle[: whole.sizes.ny])
    assert rest.enter(rest.outputs(np.zeros(0)), until=0.5 * UNTIL) == abi.DONE
    # adaptive runs are of one length, so their first steps differ: what they agree by is their tolerance
    n = whole.sizes.nq + whole.sizes.nv
    np.testing.assert_allclose(whole.state.y[:n], rest.state.y[:n], rtol=0.0, atol=1e-6)
    # the energy is in balance on both sides of the change
    assert gauges[abi.MAX_ENERGY] < 1e-3 * gauges[abi.ENERGY_SCALE]


def test_the_same_values_change_nothing(model):
    whole, part = (simulation(model, "direct-correction", "abm4") for _ in range(2))
    assert whole.enter(whole.outputs(np.zeros(0))) == abi.DONE
    assert part.enter(part.outputs(np.zeros(0)), until=0.05) == abi.DONE
    assert not part.changes.give({"push": 0.0})
    assert part.enter(part.outputs(np.zeros(0))) == abi.DONE
    np.testing.assert_array_equal(part.state.y, whole.state.y)


@pytest.mark.parametrize(
    ("values", "message"),
    [
        ({"gravity": float("nan")}, r"set: expected parameters for which the equations are defined"),
        ({"rod_mass": -1.0}, r"set: expected a mass and an inertia of crank above 0"),
    ],
)
def test_what_cannot_be_changes_nothing(model, values, message):
    found = simulation(model, "direct-correction", "rk4")
    before = found.save()
    with pytest.raises(InputError, match=message):
        found.changes.set(parameters(found, values))
    for name, array in found.save().items():
        np.testing.assert_array_equal(array, before[name])
