"""What tests of spatial mechanisms read off results: points, momenta and energies, by SciPy's rotations."""

from pathlib import Path

import numpy as np
from scipy.spatial.transform import Rotation

import symgen
from symgen.describe.formulas.evaluate import evaluate_formula

DATA = Path(__file__).parents[1] / "data"


def start_of(model, parameters=None):
    """Consistent start of a mechanism: q and v."""
    compiled = model.compile()
    start = model.assemble(compiled, parameters)
    nq = compiled.info.nq
    return start.y[:nq], start.y[nq:-1]


def columns(result, mechanism, speeds=False):
    """Coordinates or velocities of a result, shape (k, n)."""
    names = [f"{b.name}.{c}" for b in mechanism.bodies for c in (b.speeds if speeds else b.coordinates)]
    return np.column_stack([result[name] for name in names])


def turned(result, body):
    """Orientation of a body at all times."""
    return Rotation.from_quat(np.column_stack([result[f"{body}.{c}"] for c in ("e1", "e2", "e3", "e0")]))


def centre(result, body):
    """Centre of mass of a body, shape (k, 3)."""
    return np.column_stack([result[f"{body}.{c}"] for c in "xyz"])


def velocity(result, body):
    """Velocity of the centre of mass, shape (k, 3)."""
    return np.column_stack([result[f"{body}.v{c}"] for c in "xyz"])


def spin(result, body):
    """Angular velocity in body axes, shape (k, 3)."""
    return np.column_stack([result[f"{body}.w{c}"] for c in "xyz"])


def point(result, body, local):
    """Point of a body given relative to its centre of mass, shape (k, 3)."""
    return centre(result, body) + turned(result, body).apply(local)


def inertia(mechanism, name, parameters=None):
    """Mass and tensor of a body."""
    body = mechanism.body(name)
    values = {p.name: p.value for p in mechanism.parameters} | (parameters or {})
    mass = evaluate_formula(body.mass, values)
    if body.inertia is None:
        return mass, np.zeros((3, 3))
    xx, yy, zz, xy, xz, yz = (evaluate_formula(e, values) for e in body.inertia)
    return mass, np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])


def momentum(result, mechanism, about=(0.0, 0.0, 0.0)):
    """Angular momentum of all bodies about a point of the ground, in ground axes, shape (k, 3)."""
    total = np.zeros((len(result.t), 3))
    for body in mechanism.bodies:
        mass, tensor = inertia(mechanism, body.name)
        total += mass * np.cross(centre(result, body.name) - about, velocity(result, body.name))
        if not body.is_point:
            total += turned(result, body.name).apply(spin(result, body.name) @ tensor)
    return total


def energy(result, mechanism, gravity=(0.0, 0.0, -9.81)):
    """Kinetic energy, and weight's potential, shape (k,)."""
    total = np.zeros(len(result.t))
    for body in mechanism.bodies:
        mass, tensor = inertia(mechanism, body.name)
        v = velocity(result, body.name)
        total += 0.5 * mass * np.sum(v * v, axis=1) - mass * centre(result, body.name) @ np.asarray(gravity)
        if not body.is_point:
            w = spin(result, body.name)
            total += 0.5 * np.sum((w @ tensor) * w, axis=1)
    return total


def run(name, method="direct-correction", integrator="dop853", **settings):
    """Model and result of a catalogue entry, at tight tolerances unless told otherwise."""
    if "step" not in settings:
        settings = {"rtol": 1e-13, "atol": 1e-14} | settings
    model = symgen.load(name)
    return model, model.simulate(method=method, integrator=integrator, **settings)
