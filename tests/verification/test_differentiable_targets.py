"""CasADi and JAX: modules of a mechanism's dynamics equal the compiled functions, and so do their derivatives."""

import importlib.util
import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from support.recursion import random_robot, urdf

from symgen.api import Model, load
from symgen.base.errors import InputError
from symgen.cli import main
from symgen.describe.files.builder import MechanismBuilder
from symgen.result.targets import TARGETS, Request

MECHANISMS = [
    ("four-bar", "absolute"),
    ("slider-crank", "joint"),
    ("bricard", "joint"),
    ("spatial-slider-crank", "joint"),
    ("andrews", "joint"),
    ("heavy-top", "joint"),
    ("spherical-double-pendulum", "absolute"),
    ("flyball-governor", "joint"),
    ("n-four-bar:2", "joint"),
    ("robot", "joint"),
]
#: Those that JAX, which takes seconds for each, is tried on: both kinds of coordinates, plane and space, rows and none.
JAX = [
    ("four-bar", "absolute"),
    ("bricard", "joint"),
    ("heavy-top", "joint"),
    ("spherical-double-pendulum", "absolute"),
    ("robot", "joint"),
]
ARGUMENTS = {"q": 0, "v": 1, "a": 2, "effort": 3, "p": 4}


def module_of(model, coordinates, target, folder):
    package = TARGETS.get(target).write(Request(model.mechanism, folder, coordinates=coordinates))
    (path,) = package.files
    spec = importlib.util.spec_from_file_location(path.stem, path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def model_of(name, folder):
    if name != "robot":
        return load(name)
    path = folder / "robot.urdf"
    path.write_text(urdf(random_robot(4, [-1, 0, 0, 1], "rrpr")), encoding="utf-8")
    return load(path)


def state_of(f, seed=0):
    """A state on the rows, accelerations along them, efforts, and numbers."""
    q, v = f.start
    rng = np.random.default_rng(seed)
    free = f.reduction(q)[1]
    v = v + free @ rng.uniform(-1.0, 1.0, free.shape[1])
    return [q, v, rng.uniform(-1.0, 1.0, len(v)), rng.uniform(-1.0, 1.0, len(v)), f.p]


def functions_of(f):
    names = ["mass_matrix", "bias", "forward_dynamics", "inverse_dynamics", "rates", "kinetic_energy"]
    return [*names, "potential_energy", *(["constraint_jacobian", "violation", "nu", "gamma"] if f.rows else [])]


def arguments(function, state):
    return [state[ARGUMENTS[name]] for name in function.arguments]


def numbers(value):
    return value.full() if hasattr(value, "full") else np.asarray(value)


def apart(value, exact, name=""):
    """The largest error of a number over the largest one of its row, or of all where a row is 0 or the rounding of one.

    A violation of the rows is rounding by itself: its error counts in metres and radians.
    """
    exact = np.atleast_1d(exact)
    off, size = np.abs(np.reshape(numbers(value), exact.shape) - exact), np.abs(exact)
    rows = size.max(axis=-1, keepdims=True, initial=0.0) if exact.ndim > 1 else size.max(initial=0.0)
    return (
        off.max()
        if name == "violation"
        else (off / np.where(rows > 1e-25, rows, max(1.0, size.max(initial=0.0)))).max(initial=0.0)
    )


def compare(module, f, state, limit=1e-13):
    for name in functions_of(f):
        compiled = getattr(f, name)
        given = arguments(compiled, state)
        exact = np.asarray(compiled(*given))
        assert apart(getattr(module, name)(*given), exact, name) < limit, name
    body = next(b for b in f.mechanism.bodies)
    point = f"{body.name}_{body.points[0][0]}" if body.points else body.name
    frame = f.frame(f"{body.name}.{body.points[0][0]}" if body.points else body.name)
    for what in ("pose", "velocity", "jacobian"):
        compiled = getattr(frame, what)
        given = arguments(compiled, state)
        exact = compiled(*given)
        assert apart(getattr(module, f"{what}_{point}")(*given), exact) < limit


def test_casadi_functions_of_a_loop_and_their_derivatives(tmp_path):
    compare_casadi("slider-crank", "joint", tmp_path)


@pytest.mark.by_turns(4)
@pytest.mark.slow
@pytest.mark.parametrize(("name", "coordinates"), MECHANISMS)
def test_casadi_functions_are_the_compiled_ones(name, coordinates, tmp_path):
    compare_casadi(name, coordinates, tmp_path)


def compare_casadi(name, coordinates, tmp_path):
    import casadi as ca

    model = model_of(name, tmp_path)
    module, f = module_of(model, coordinates, "casadi", tmp_path), model.functions(coordinates)
    state = state_of(f)
    compare(module, f, state)
    function = module.forward_dynamics
    symbols = [ca.SX.sym(name, function.size1_in(i)) for i, name in enumerate(function.name_in())]
    for i, by in enumerate(("q", "v", "effort")):
        slope = ca.Function("slope", symbols, [ca.jacobian(function(*symbols), symbols[i])])
        given = arguments(f.forward_dynamics, state)
        exact = f.derivative("forward_dynamics", by)(*given)
        assert apart(np.ravel(numbers(slope(*given))), np.ravel(exact)) < 1e-12, by  # some rows are rounding


def alone(function, *arguments):
    """Call a function of this module in a process of its own: threads of JAX stay where it was imported."""
    words = ", ".join(repr(str(x)) for x in arguments)
    code = f"from verification.test_differentiable_targets import {function.__name__} as f; f({words})"
    environment = os.environ | {"PYTHONPATH": os.pathsep.join(p for p in sys.path if p)}
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False, env=environment)
    assert done.returncode == 0, done.stderr


@pytest.mark.by_turns(6)
@pytest.mark.slow
def test_jax_functions_are_the_compiled_ones(tmp_path):
    alone(compare_jax, tmp_path)


def compare_jax(folder):
    for name, coordinates in JAX:
        print(name, coordinates, file=sys.stderr)
        compare_one_jax(name, coordinates, Path(folder))


def compare_one_jax(name, coordinates, tmp_path):
    model = model_of(name, tmp_path)
    module, f = module_of(model, coordinates, "jax", tmp_path), model.functions(coordinates)
    import jax

    state = state_of(f)
    compare(module, f, state)
    given = arguments(f.forward_dynamics, state)
    for i, by in enumerate(("q", "v", "effort")):
        slope = jax.jacfwd(module.forward_dynamics, argnums=i)(*given)
        assert apart(np.ravel(slope), np.ravel(f.derivative("forward_dynamics", by)(*given))) < 1e-12, by


@pytest.mark.by_turns(2)
@pytest.mark.slow
def test_jax_takes_many_states_and_gradients(tmp_path):
    alone(many_states, tmp_path)


def many_states(folder):
    tmp_path = Path(folder)
    model = load("four-bar")
    module, f = module_of(model, "joint", "jax", tmp_path), model.functions("joint")
    import jax

    q, v, _, effort, p = state_of(f)
    states = q + 1e-3 * np.random.default_rng(1).normal(size=(10_000, 3))
    many = jax.jit(jax.vmap(lambda x: module.forward_dynamics(x, v, effort)))(states)
    assert apart(many, f.forward_dynamics(states, v, effort)) < 1e-11
    heavy = jax.grad(lambda numbers: module.kinetic_energy(q, v, numbers))(p)
    assert apart(heavy, f.derivative("kinetic_energy", "p")(q, v)) < 1e-12


def test_a_module_says_what_it_holds_and_the_command_writes_it(tmp_path, capsys):
    assert main(["generate", "four-bar", "--target", "jax", "--coordinates", "joint", "-o", str(tmp_path)]) == 0
    text = (tmp_path / "four_bar_jax.py").read_text(encoding="utf-8")
    assert "forward_dynamics(q, v, effort, p): v' with all rows in force, 3" in text
    assert "v[0] crank.omega [rad/s]" in text and "import jax" in text
    capsys.readouterr()


def test_what_has_no_form_is_refused(tmp_path):
    request = Request(load("four-bar").mechanism, tmp_path, shape="looped")
    with pytest.raises(InputError, match="--target casadi: expected the straight shape, got looped"):
        TARGETS.get("casadi").write(request)
    light = MechanismBuilder("light").body("a", mass=0.0, inertia=0.1).build()
    with pytest.raises(InputError, match="--target jax: expected bodies with mass and inertia"):
        TARGETS.get("jax").write(Request(light, tmp_path))
    tabled = MechanismBuilder("tabled").body("a", mass=1.0, inertia=0.1).table("push", [0.0, 1.0], [0.0, 2.0])
    tabled.force("f", "torque", body="a", torque="push(a.theta)")
    with pytest.raises(InputError, match="--target jax: expected a mechanism without tables, got push"):
        TARGETS.get("jax").write(Request(Model(tabled.build()).mechanism, tmp_path))
