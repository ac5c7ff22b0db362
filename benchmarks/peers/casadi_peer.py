"""CasADi: an index-1 reduction in minimal coordinates with loops.

The coordinates are the body angles; the loop closures enter with Lagrange
multipliers. Mass matrix and reduced multiplier matrix are factorised in
straight-line code (sparse L D L^T), which was several times faster than the
symbolic QR factorisation that ``casadi.solve`` picks by default.
"""

from __future__ import annotations

import contextlib
import os
import re
import shutil
import subprocess
import tempfile
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import casadi as ca
import numpy as np

from . import reference
from .measure import Measured, Row, best_of, row
from .models import GROUND, Array, Model, Point

NAME = "casadi"
VERSION = str(ca.CasadiMeta.version())
FLAGS = ("-O3", "-march=native")
TOLERANCES = (1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-11, 1e-12, 1e-13)
REFINEMENTS = (0.1, 0.15, 0.2, 0.25, 1 / 3, 0.4, 0.5, 2 / 3, 0.8, 0.92, 1.0, 2.0, 4.0)
STABILISED = 50.0
Method = dict[str, Any]
ADAMS: Method = {"linear_multistep_method": "adams"}
METHODS: dict[str, Method] = {
    "Adams, functional": ADAMS | {"nonlinear_solver_iteration": "functional"},
    "Adams, Newton": ADAMS,
    "BDF, Newton": {},
}


def rows(model: Model) -> Iterator[Row]:
    """Measure every setting.

    Parameters
    ----------
    model : Model
        The mechanism.

    Yields
    ------
    Row
        One result per setting.
    """
    truth = reference.angles(model)
    compiler = shutil.which("gcc")
    # The stabilisation, only needed where the constraints become dependent, is
    # scaled to the time unit of the mechanism like the step.
    rates = (0.0, STABILISED) if "windows" in model.parameters else (0.0,)
    for rate in rates:
        dynamics = right_hand_side(model, rate * 1e-3 / model.step)
        suffix = f", Baumgarte {rate:g}/s" if rate else ""
        for factor in REFINEMENTS:
            steps = round(model.duration / model.step / reference.INTERVALS * factor)
            step = model.duration / reference.INTERVALS / steps
            yield row(
                NAME,
                VERSION,
                f"RK4 {step:.3g} s{', gcc' if compiler else ''}{suffix}",
                model.name,
                lambda steps=steps, dynamics=dynamics: _fixed(model, dynamics, steps, compiler, truth),
            )
        for label, method in METHODS.items():
            for tolerance in TOLERANCES if rate == rates[-1] else TOLERANCES[2::3]:
                yield row(
                    NAME,
                    VERSION,
                    f"CVODES {label} {tolerance:.0e}{', gcc' if compiler else ''}{suffix}",
                    model.name,
                    lambda tolerance=tolerance, method=method, dynamics=dynamics: _variable(
                        model, dynamics, tolerance, method, compiler, truth
                    ),
                )


def start(model: Model) -> Array:
    """Give the initial state.

    Parameters
    ----------
    model : Model
        The mechanism.

    Returns
    -------
    ndarray, shape (2 * bodies,)
        Body angles, then rates.
    """
    return np.array([b.angle for b in model.bodies] + [b.rate for b in model.bodies])


def right_hand_side(model: Model, rate: float = 0.0) -> Any:
    """Derive the state derivative.

    Parameters
    ----------
    model : Model
        The mechanism.
    rate : float
        Baumgarte's alpha = beta in 1/s.

    Returns
    -------
    casadi.Function
        From the state (angles, rates) to its derivative, in scalar operations.
    """
    count = len(model.bodies)
    q, v = ca.SX.sym("q", count), ca.SX.sym("v", count)
    centre: dict[int, Any] = {}
    cos, sin = ca.cos(q), ca.sin(q)

    def arm(body: int, point: Point) -> Any:
        x, y = point
        return ca.vertcat(cos[body] * x - sin[body] * y, sin[body] * x + cos[body] * y)

    def world(body: int, point: Point) -> Any:
        return ca.DM(point) if body == GROUND else centre[body] + arm(body, point)

    tree, loops = model.tree()
    for joint in tree:
        centre[joint.b] = world(joint.a, joint.point_a) - arm(joint.b, joint.point_b)
    places = ca.vertcat(*[centre[i] for i in range(count)])
    masses = ca.DM(np.repeat([b.mass for b in model.bodies], 2))
    jacobian = ca.jacobian(places, q)
    bias = ca.jtimes(ca.jtimes(places, q, v), q, v)
    weight = ca.repmat(ca.DM([0.0, -model.gravity]), count, 1)
    inertia = ca.diag(ca.DM([b.inertia for b in model.bodies]))
    mass = ca.mtimes(jacobian.T, ca.mtimes(ca.diag(masses), jacobian)) + inertia
    force = ca.mtimes(jacobian.T, masses * (weight - bias))
    for body, torque in model.torques.items():
        force[body] += torque
    for spring in model.springs:
        gap = world(spring.body, spring.point) - ca.DM(spring.anchor)
        length = ca.norm_2(gap)
        pull = -spring.stiffness * (length - spring.length) / length * gap
        force += ca.mtimes(ca.jacobian(gap, q).T, pull)
    closure = ca.vertcat(*[world(j.a, j.point_a) - world(j.b, j.point_b) for j in loops])
    rows_ = ca.jacobian(closure, q)
    speed = ca.mtimes(rows_, v)
    target = -ca.jtimes(speed, q, v) - 2 * rate * speed - rate**2 * closure
    solved = _solve(mass, ca.horzcat(force, rows_.T))
    free, spread = solved[:, 0], solved[:, 1:]
    pull = _solve(ca.mtimes(rows_, spread), ca.mtimes(rows_, free) - target)
    derivative = ca.vertcat(v, free - ca.mtimes(spread, pull))
    return ca.Function("dynamics", [ca.vertcat(q, v)], [ca.cse(derivative)])


def _solve(matrix: Any, right: Any) -> Any:
    """Solve with a symmetric positive definite matrix in straight-line code."""
    diagonal, factor, order = ca.ldl(matrix)
    return ca.ldl_solve(right, diagonal, factor, order)


def _runge_kutta(dynamics: Any, step: float) -> Any:
    """One step of the classical Runge-Kutta method as a function of the state."""
    x = ca.SX.sym("x", dynamics.size1_in(0))
    k1 = dynamics(x)
    k2 = dynamics(x + step / 2 * k1)
    k3 = dynamics(x + step / 2 * k2)
    k4 = dynamics(x + step * k3)
    return ca.Function("step", [x], [x + step / 6 * (k1 + 2 * k2 + 2 * k3 + k4)])


@contextlib.contextmanager
def _scratch() -> Iterator[Path]:
    """Work in a folder of its own, since generated code goes to the current one."""
    here = Path.cwd()
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        try:
            yield Path(folder)
        finally:
            os.chdir(here)


def _compile(function: Any, folder: Path, compiler: str) -> Any:
    """Generate C for a function, compile and load it."""
    function.generate("loop.c")
    library = folder / "loop.so"
    command = [compiler, *FLAGS, "-shared", "-fPIC", "loop.c", "-o", str(library), "-lm"]
    subprocess.run(command, check=True, capture_output=True)
    return ca.external(function.name(), str(library))


def _score(model: Model, loop: Any, truth: Array) -> Measured:
    """Run once for the error, then time."""
    state = ca.DM(start(model))
    count = len(model.bodies)
    values = np.array(loop(state)).T[:, :count]
    if len(values) < len(truth):
        values = np.vstack([start(model)[:count], values])
    error = reference.largest_error(values, truth)
    if not np.isfinite(error):
        return 0.0, 0.0, 0.0, error
    return *best_of(lambda: loop(state)), error


def _fixed(model: Model, dynamics: Any, steps: int, compiler: str | None, truth: Array) -> Measured:
    """Classical Runge-Kutta with so many steps between two samples."""
    single = _runge_kutta(dynamics, model.duration / reference.INTERVALS / steps)
    between = single.fold(steps) if steps > 1 else single
    whole = between.mapaccum("whole", reference.INTERVALS)
    with _scratch() as folder:
        loop = _compile(whole, folder, compiler) if compiler else whole
        return _score(model, loop, truth)


def _variable(
    model: Model, dynamics: Any, tolerance: float, method: Method, compiler: str | None, truth: Array
) -> Measured:
    """CVODES at one tolerance with the samples as output grid."""
    options: Method = method | {
        "disable_internal_warnings": True,
        "reltol": tolerance,
        "abstol": tolerance,
        "max_num_steps": 20_000,
    }
    if compiler:
        jit = {"flags": list(FLAGS), "compiler": compiler, "linker": compiler}
        options |= {"jit": True, "compiler": "shell", "jit_options": jit}
    with _scratch():
        try:
            return _integrator(model, dynamics, options, truth)
        except RuntimeError as problem:
            match = re.search(r"CV_\w+", str(problem))
            reason = match.group() if match else str(problem)
    # Raised here, where no frame keeps the integrator and its files alive.
    raise RuntimeError(reason)


def _integrator(model: Model, dynamics: Any, options: Method, truth: Array) -> Measured:
    """Build an integrator and score it; it deletes its compiled files on return."""
    x = ca.SX.sym("x", dynamics.size1_in(0))
    grid = reference.sample_times(model).tolist()
    solver = ca.integrator("solver", "cvodes", {"x": x, "ode": dynamics(x)}, 0.0, grid, options)
    return _score(model, lambda state: solver(x0=state)["xf"], truth)
