"""The beam element against its energy written anew: rotations as quaternions, F inverted as a matrix, complex steps."""

import numpy as np
import pytest
from support.emitted import mechanism_of
from support.graph_values import node_values, state_inputs

from symgen.base.ir.derivative import jacobian
from symgen.derive.formulate.flexure import PLANE, SPACE
from symgen.derive.formulate.formulate import formulate

STEP = 1e-30
LENGTH, DAMPING = 0.8, 0.03
PLANAR = {"axial": 200.0, "shear": 80.0, "bending": 1.3, "curvature": 0.4}
SPATIAL = {
    "axial": 200.0,
    "shear": [80.0, 60.0],
    "torsion": 0.9,
    "bending": [1.3, 2.1],
    "curvature": [0.2, -0.3, 0.4],
}


def raw(space: str, damping: float = 0.0, **keys) -> dict:
    """Return two bodies and an element between points of them, its ends skewed against their axes."""
    spatial = space == "spatial"
    body = {"mass": 1.0, "inertia": [0.1, 0.2, 0.3] if spatial else 0.1}
    ends = {"at": [[0.1, 0.05, -0.02], [-0.03, 0.02, 0.01]], "axis": [[0.8, 0.6, 0.0], [0.0, 0.6, 0.8]]}
    ends["reference"] = [[-0.6, 0.8, 0.0], [1.0, 0.0, 0.0]]
    if not spatial:
        ends = {"at": [[0.1, 0.05], [-0.03, 0.02]], "axis": [[0.8, 0.6], [0.6, 0.8]]}
    element = {"type": "beam", "between": ["a", "b"], "length": LENGTH, "damping": damping, **ends, **keys}
    return {
        "mechanism": {"name": "leaf", "space": space},
        "bodies": {"a": body, "b": body},
        "forces": {"leaf": element},
    }


def product(a, b):
    v = a[0] * b[1:] + b[0] * a[1:] + np.cross(a[1:], b[1:])
    return np.concatenate([[a[0] * b[0] - a[1:] @ b[1:]], v])


def rotated(q, v):
    return product(product(q, np.concatenate([[0.0], v])), q * np.array([1, -1, -1, -1]))[1:]


def hat(a):
    return np.array([[0 * a[0], -a[2], a[1]], [a[2], 0 * a[0], -a[0]], [-a[1], a[0], 0 * a[0]]])


def deformation(ra, qa, rb, qb):
    """Return psi by the middle frame, with the functions that series stand for in the program."""
    relative = product(qa * np.array([1, -1, -1, -1]), qb)
    sine = np.sqrt(relative[1:] @ relative[1:])
    half = np.arctan(sine / relative[0])
    psi = 2.0 * half * relative[1:] / sine
    middle = (qa + qb) / np.sqrt((qa + qb) @ (qa + qb))
    d = rotated(middle * np.array([1, -1, -1, -1]), rb - ra)
    ratio = half / np.sin(half)
    return np.concatenate([d * ratio - (ratio - 1.0) * psi * (psi @ d) / (psi @ psi), psi])


def energy(psi, compliances, rest):
    w = hat(psi[3:])
    ad = np.block([[w, hat(psi[:3])], [np.zeros((3, 3)), w]])
    flexibility = LENGTH * np.diag(compliances) + LENGTH / 12 * (ad * compliances) @ ad.T
    return 0.5 * (psi - rest) @ np.linalg.solve(flexibility, psi - rest), flexibility


def turn(angle, axis=(0.0, 0.0, 1.0)):
    return np.concatenate([[np.cos(angle / 2)], np.sin(angle / 2) * np.array(axis)])


def element_in_plane(q, keys):
    """Return psi, U and F of the planar element: a spatial one whose section is infinitely soft across the plane."""
    qa, qb = turn(q[2] + np.arctan2(0.6, 0.8)), turn(q[5] + np.arctan2(0.8, 0.6))
    ends = ((q[0:2], q[2], [0.1, 0.05]), (q[3:5], q[5], [-0.03, 0.02]))
    ra, rb = (np.append(r, 0.0) + rotated(turn(angle), np.append(at, 0.0)) for r, angle, at in ends)
    psi = deformation(ra, qa, rb, qb)
    compliances = np.array([1 / keys["axial"], 1 / keys["shear"], 1.0, 1.0, 1.0, 1 / keys["bending"]])
    rest = LENGTH * np.array([1.0, 0, 0, 0, 0, keys["curvature"]])
    u, flexibility = energy(psi, compliances, rest)
    plane = np.ix_([0, 1, 5], [0, 1, 5])
    return psi[[0, 1, 5]], u, flexibility[plane]


def element_in_space(q, keys):
    ea, eb = (
        np.column_stack(x)
        for x in (([0.8, 0.6, 0], [-0.6, 0.8, 0], [0, 0, 1]), ([0, 0.6, 0.8], [1, 0, 0], [0, 0.8, -0.6]))
    )
    ra, rb = (
        q[i : i + 3] + rotated(q[i + 3 : i + 7], np.array(at))
        for i, at in ((0, [0.1, 0.05, -0.02]), (7, [-0.03, 0.02, 0.01]))
    )
    psi = deformation(ra, product(q[3:7], quaternion(ea)), rb, product(q[10:14], quaternion(eb)))
    parts = [keys["axial"], *keys["shear"], keys["torsion"], *keys["bending"]]
    u, flexibility = energy(psi, 1.0 / np.array(parts), LENGTH * np.array([1.0, 0, 0, *keys["curvature"]]))
    return psi, u, flexibility


def quaternion(m):
    """Return the quaternion of a rotation matrix whose trace is not -1."""
    w = np.sqrt(1.0 + np.trace(m)) / 2
    return np.array([w, *(np.array([m[2, 1] - m[1, 2], m[0, 2] - m[2, 0], m[1, 0] - m[0, 1]]) / (4 * w))])


def moved(q, space, i, step):
    """Return positions along the velocity i."""
    change = q.astype(complex)
    if space == "planar":
        change[i] += step
        return change
    body, place = divmod(i, 6)
    if place < 3:
        change[7 * body + place] += step
        return change
    at = slice(7 * body + 3, 7 * body + 7)
    change[at] += 0.5 * step * product(q[at], np.eye(4)[place - 2])
    return change


def pose(space: str, seed: int):
    """Return positions in which the element is strained and bent by some tenths, and velocities."""
    rng = np.random.default_rng(seed)
    if space == "planar":
        q = np.array([0.3, -0.2, 0.5, 1.0, 0.4, 0.6]) + 0.1 * rng.standard_normal(6)
        return q, rng.standard_normal(6)
    q = rng.standard_normal(14)
    q[3:7] /= np.linalg.norm(q[3:7])
    bend = 0.3 * rng.standard_normal(3)
    ea = np.column_stack(([0.8, 0.6, 0], [-0.6, 0.8, 0], [0, 0, 1]))
    eb = np.column_stack(([0, 0.6, 0.8], [1, 0, 0], [0, 0.8, -0.6]))
    relative = np.array([1.0, *bend / 2])
    q[10:14] = product(
        product(product(q[3:7], quaternion(ea)), relative / np.linalg.norm(relative)),
        quaternion(eb) * np.array([1, -1, -1, -1]),
    )
    q[7:10] = (
        q[0:3] + rotated(product(q[3:7], quaternion(ea)), np.array([0.8, 0.05, -0.03])) + 0.05 * rng.standard_normal(3)
    )
    return q, rng.standard_normal(12)


@pytest.mark.slow_cases("planar-keys0-element_in_plane-0")
@pytest.mark.parametrize("seed", range(4))
@pytest.mark.parametrize(
    ("space", "keys", "element"), [("planar", PLANAR, element_in_plane), ("spatial", SPATIAL, element_in_space)]
)
def test_force_of_the_graph_is_that_of_a_complex_step_of_the_energy(space, keys, element, seed):
    q, v = pose(space, seed)
    equations = formulate(mechanism_of(raw(space, **keys)))
    inputs = state_inputs(0.0, q, v * 0)
    g, n = equations.graph, len(v)
    energies = [element(moved(q, space, i, STEP * 1j), keys)[1] for i in range(n)]
    expected = -np.array([u.imag for u in energies]) / STEP
    scale = np.abs(expected).max()
    assert np.abs(node_values(g, equations.forces, inputs) - expected).max() <= 1e-12 * scale
    assert abs(node_values(g, [equations.potential], inputs)[0] / energies[0].real - 1.0) <= 1e-12
    assert np.linalg.norm(element(q.astype(complex), keys)[0][2 if space == "planar" else slice(3, 6)]) > 0.05

    # Kelvin-Voigt: the power of dampers is -tau psi'^T F^-1 psi', and their forces are its gradient
    damped = formulate(mechanism_of(raw(space, DAMPING, **keys)))
    inputs = state_inputs(0.0, q, v)
    slopes = np.array([element(moved(q, space, i, STEP * 1j), keys)[0].imag / STEP for i in range(n)]).T
    _, _, flexibility = element(q.astype(complex), keys)
    lost = DAMPING * np.linalg.solve(flexibility.real, slopes @ v)
    still = expected + (
        np.array(node_values(equations.graph, equations.forces, inputs))
        - node_values(g, equations.forces, state_inputs(0.0, q, 0 * v))
    )
    forces = np.array(node_values(damped.graph, damped.forces, inputs))
    assert np.abs(forces - (still - slopes.T @ lost)).max() <= 1e-12 * np.abs(forces).max()
    power = node_values(damped.graph, [damped.power], inputs)[0]
    assert abs(power + (slopes @ v) @ lost) <= 1e-12 * abs(power)


@pytest.mark.parametrize(
    ("space", "keys", "element"), [("planar", PLANAR, element_in_plane), ("spatial", SPATIAL, element_in_space)]
)
def test_each_strain_has_a_time_of_its_own(space, keys, element):
    """The forces are -s'^T F^-1 F_T F^-1 s' v: F_T is F of an element whose compliances are multiplied by the times."""
    q, v = pose(space, 11)
    times = {"axial": 0.02, "shear": 0.01, "bending": 0.05} | ({"torsion": 0.03} if space == "spatial" else {})
    softer = keys | {
        key: [x / time for x in keys[key]] if isinstance(keys[key], list) else keys[key] / time
        for key, time in times.items()
    }
    slopes = np.array([element(moved(q, space, i, STEP * 1j), keys)[0].imag / STEP for i in range(len(v))]).T
    flexibility, delayed = (element(q.astype(complex), part)[2].real for part in (keys, softer))
    lost = np.linalg.solve(flexibility, delayed @ np.linalg.solve(flexibility, slopes @ v))
    damped, free = (formulate(mechanism_of(raw(space, damping, **keys))) for damping in (times, 0.0))
    inputs = state_inputs(0.0, q, v)
    forces, still = (np.array(node_values(e.graph, e.forces, inputs)) for e in (damped, free))
    assert np.abs(still - forces - slopes.T @ lost).max() <= 1e-12 * np.abs(forces).max()
    power = node_values(damped.graph, [damped.power], inputs)[0]
    assert power < 0.0 and abs(power + (slopes @ v) @ lost) <= 1e-12 * abs(power)
    alike = formulate(mechanism_of(raw(space, dict.fromkeys(times, DAMPING), **keys)))
    one = formulate(mechanism_of(raw(space, DAMPING, **keys)))
    same = [np.array(node_values(e.graph, e.forces, inputs)) for e in (alike, one)]
    assert np.abs(same[0] - same[1]).max() <= 1e-12 * np.abs(same[1]).max()


@pytest.mark.parametrize(("space", "keys"), [("planar", PLANAR), ("spatial", SPATIAL)])
def test_tangent_is_exact_and_symmetric_along_the_motion(space, keys):
    """Second derivatives by the graph against central differences of forces; in the plane K is symmetric."""
    q, v = pose(space, 7)
    e = formulate(mechanism_of(raw(space, **keys)))
    inputs = [("q", i) for i in range(len(q))]
    slopes = jacobian(e.graph, e.forces, inputs)
    nodes = [row.get(key, e.graph.zero) for row in slopes for key in inputs]
    found = np.array(node_values(e.graph, nodes, state_inputs(0.0, q, 0 * v))).reshape(len(v), len(q))
    h = 1e-6
    columns = []
    for i in range(len(q)):
        sides = [
            node_values(e.graph, e.forces, state_inputs(0.0, q + s * h * np.eye(len(q))[i], 0 * v)) for s in (1, -1)
        ]
        columns.append((np.array(sides[0]) - sides[1]) / (2 * h))
    assert np.abs(found - np.array(columns).T).max() <= 1e-7 * np.abs(found).max()
    if space == "planar":
        assert np.abs(found - found.T).max() <= 1e-12 * np.abs(found).max()


def test_series_are_exact_up_to_one_radian():
    angles = np.linspace(0.01, 1.0, 200)
    exact = angles / (2.0 * np.sin(angles))
    for series, x in ((PLANE, angles**2), (SPACE, 4.0 * np.sin(angles / 2) ** 2)):
        assert np.abs((0.5 + x * np.polyval(series[::-1], x)) / exact - 1.0).max() <= 4e-16


@pytest.mark.parametrize(("space", "keys"), [("planar", PLANAR), ("spatial", SPATIAL)])
def test_rigid_motions_store_nothing(space, keys):
    """The element in its unloaded shape, carried far away and turned about anything: no force beyond rounding."""
    rng = np.random.default_rng(3)
    keys = {**keys, "curvature": 0.0 if space == "planar" else [0.0] * 3}
    description = raw(space, **keys)
    description["forces"]["leaf"] |= {
        "at": [[0.0] * 3, [0.0] * 3],
        "axis": [[1, 0, 0], [1, 0, 0]],
        "reference": [[0, 1, 0]] * 2,
    }
    if space == "planar":
        description["forces"]["leaf"] |= {"at": [[0.0] * 2, [0.0] * 2], "axis": [[1, 0], [1, 0]]}
        del description["forces"]["leaf"]["reference"]
    e = formulate(mechanism_of(description))
    for _ in range(10):
        r = 3.0 * rng.standard_normal(3)
        if space == "planar":
            angle = 10.0 * rng.standard_normal()
            q = [*r[:2], angle, r[0] + LENGTH * np.cos(angle), r[1] + LENGTH * np.sin(angle), angle]
            v = np.zeros(6)
        else:
            way = rng.standard_normal(4)
            way /= np.linalg.norm(way)
            q = [*r, *way, *(r + rotated(way, np.array([LENGTH, 0.0, 0.0]))), *way]
            v = np.zeros(12)
        inputs = state_inputs(0.0, np.array(q), v)
        assert node_values(e.graph, [e.potential], inputs)[0] <= 1e-24
        assert np.abs(node_values(e.graph, e.forces, inputs)).max() <= 1e-12
