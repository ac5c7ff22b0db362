"""The catalogue's Andrews' mechanism in absolute coordinates against the test set's equations in seven coordinates.

The test set's mass matrix and applied forces are typed in below from its report; the kinematics used for the projection
come from the catalogue's own points and joints.
"""

import json
from pathlib import Path

import numpy as np
import pytest

from describe.measured import Posed, complex_value
from symgen.base.vocabulary.expressions import ZERO
from symgen.describe.files.load import load_mechanism

DATA = json.loads((Path(__file__).parents[2] / "data" / "andrews_ivp.json").read_text())
PARAMETERS = DATA["parameters"]
START = np.array([float(value) for value in DATA["start"]])
MODEL = load_mechanism("andrews")


def place(seven) -> dict[str, tuple]:
    """Poses of the seven frames: angles as the file documents them, origins at the pins of the bodies that carry."""
    beta, theta, gamma, phi, delta, omega, epsilon = seven
    p = Posed(MODEL, {b.name: (0.0, 0.0, 0.0) for b in MODEL.bodies})
    fixed = {joint.name: [p.number(c) for c in joint.rows[0].measure.a.point] for joint in MODEL.joints}
    frames = {
        "K1": (*fixed["O"], beta),
        "K3": (*fixed["B"], gamma),
        "K5": (*fixed["A5"], delta),
        "K7": (*fixed["A7"], epsilon),
    }
    for body, carrier, pin, angle in (
        ("K2", "K1", "F", beta + theta),
        ("K4", "K5", "G", phi + delta),
        ("K6", "K7", "H", omega + epsilon),
    ):
        point = dict(MODEL.body(carrier).points)[pin]
        p.frames = frames | {"ground": (0.0, 0.0, 0.0)}
        x, y, _ = frames[carrier]
        frames[body] = (*(np.array([x, y]) + p.turned(carrier, point)), angle)
    return frames


def absolute(seven) -> np.ndarray:
    """Centres of mass and angles, body by body."""
    posed = Posed(MODEL, place(seven))
    result = []
    for body in MODEL.bodies:
        x, y, angle = posed.frames[body.name]
        result += [*(np.array([x, y]) + posed.turned(body.name, body.centre_of_mass)), angle]
    return np.array(result)


def jacobian(seven) -> np.ndarray:
    steps = 1e-30j * np.eye(7)
    return np.array([np.imag(absolute(seven + step)) / 1e-30 for step in steps]).T


def masses() -> np.ndarray:
    posed = Posed(MODEL)
    return np.diag([posed.number(m) for b in MODEL.bodies for m in (b.mass, b.mass, b.inertia)])


def applied(seven) -> np.ndarray:
    """Generalised applied forces in seven coordinates from the model's efforts, by complex steps."""
    result = np.zeros(7)
    for force in MODEL.forces:
        for effort in force.efforts:
            s = Posed(MODEL, place(seven)).measure(effort.measure)
            values = {p.name: p.value for p in MODEL.parameters}
            slope = np.imag(complex_value(effort.potential, values | {"s": s + 1e-30j})) / 1e-30
            size = (complex_value(effort.magnitude, values) if effort.magnitude != ZERO else 0.0) - slope
            for i, step in enumerate(1e-30j * np.eye(7)):
                result[i] += size * np.imag(Posed(MODEL, place(seven + step)).measure(effort.measure)) / 1e-30
    return result


def test_set_masses(seven) -> np.ndarray:
    p = PARAMETERS
    _, th, _, ph, _, om, _ = seven
    e, zf = p["e"] - p["ea"], p["zf"] - p["fa"]
    m = np.zeros((7, 7))
    m[0, 0] = (
        p["m1"] * p["ra"] ** 2
        + p["m2"] * (p["rr"] ** 2 - 2 * p["da"] * p["rr"] * np.cos(th) + p["da"] ** 2)
        + p["i1"]
        + p["i2"]
    )
    m[0, 1] = m[1, 0] = p["m2"] * (p["da"] ** 2 - p["da"] * p["rr"] * np.cos(th)) + p["i2"]
    m[1, 1] = p["m2"] * p["da"] ** 2 + p["i2"]
    m[2, 2] = p["m3"] * (p["sa"] ** 2 + p["sb"] ** 2) + p["i3"]
    m[3, 3] = p["m4"] * e**2 + p["i4"]
    m[3, 4] = m[4, 3] = p["m4"] * (e**2 + p["zt"] * e * np.sin(ph)) + p["i4"]
    m[4, 4] = (
        p["m4"] * (p["zt"] ** 2 + 2 * p["zt"] * e * np.sin(ph) + e**2)
        + p["m5"] * (p["ta"] ** 2 + p["tb"] ** 2)
        + p["i4"]
        + p["i5"]
    )
    m[5, 5] = p["m6"] * zf**2 + p["i6"]
    m[5, 6] = m[6, 5] = p["m6"] * (zf**2 - p["u"] * zf * np.sin(om)) + p["i6"]
    m[6, 6] = (
        p["m6"] * (zf**2 - 2 * p["u"] * zf * np.sin(om) + p["u"] ** 2)
        + p["m7"] * (p["ua"] ** 2 + p["ub"] ** 2)
        + p["i6"]
        + p["i7"]
    )
    return m


test_set_masses.__test__ = False


def reported_forces(seven, rates) -> np.ndarray:
    p = PARAMETERS
    _, th, ga, ph, _, om, _ = seven
    bed, thd, _, phd, ded, omd, epd = rates
    e, zf = p["e"] - p["ea"], p["zf"] - p["fa"]
    xd = p["sd"] * np.cos(ga) + p["sc"] * np.sin(ga) + p["xb"]
    yd = p["sd"] * np.sin(ga) - p["sc"] * np.cos(ga) + p["yb"]
    length = np.hypot(xd - p["xc"], yd - p["yc"])
    force = -p["c0"] * (length - p["l0"]) / length
    fx, fy = force * (xd - p["xc"]), force * (yd - p["yc"])
    return np.array(
        [
            p["mom"] - p["m2"] * p["da"] * p["rr"] * thd * (thd + 2 * bed) * np.sin(th),
            p["m2"] * p["da"] * p["rr"] * bed**2 * np.sin(th),
            fx * (p["sc"] * np.cos(ga) - p["sd"] * np.sin(ga)) + fy * (p["sd"] * np.cos(ga) + p["sc"] * np.sin(ga)),
            p["m4"] * p["zt"] * e * ded**2 * np.cos(ph),
            -p["m4"] * p["zt"] * e * phd * (phd + 2 * ded) * np.cos(ph),
            -p["m6"] * p["u"] * zf * epd**2 * np.cos(om),
            p["m6"] * p["u"] * zf * omd * (omd + 2 * epd) * np.cos(om),
        ]
    )


@pytest.mark.parametrize("seed", range(5))
def test_projected_mass_matrix_is_the_test_sets(seed):
    seven = START + np.random.default_rng(seed).uniform(-0.5, 0.5, 7)
    j = jacobian(seven)
    np.testing.assert_allclose(j.T @ masses() @ j, test_set_masses(seven), rtol=1e-12, atol=1e-19)


@pytest.mark.parametrize("seed", range(5))
def test_projected_forces_are_the_test_sets(seed):
    rng = np.random.default_rng(seed)
    seven, rates = START + rng.uniform(-0.5, 0.5, 7), rng.uniform(-3.0, 3.0, 7)
    h = 1e-5
    change = (jacobian(seven + h * rates) - jacobian(seven - h * rates)) @ rates / (2 * h)
    found = applied(seven) - jacobian(seven).T @ masses() @ change
    np.testing.assert_allclose(found, reported_forces(seven, rates), rtol=1e-8, atol=1e-12)


def test_start_is_the_test_sets_to_the_last_digit():
    frames = Posed(MODEL).frames
    for name, pose in place(START).items():
        np.testing.assert_allclose(frames[name], pose, rtol=0, atol=5e-16, err_msg=name)


@pytest.mark.parametrize(("seven", "tolerance"), [(START, 1e-15), (np.array(DATA["end"][:7]), 1e-11)])
def test_loops_are_closed_at_the_test_sets_positions(seven, tolerance):
    residuals = Posed(MODEL, place(seven)).residuals()
    assert len(residuals) == 20
    assert max(map(abs, residuals.values())) < tolerance
