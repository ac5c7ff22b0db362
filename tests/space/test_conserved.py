"""Bodies that are known in closed form or by what they conserve: a free body, a top, two rods on balls, a chain."""

import numpy as np
import pytest
from scipy.special import ellipj, ellipkinc
from support.spatial_runs import centre, columns, energy, inertia, momentum, run, spin, start_of, turned, velocity

import symgen
from symgen.result.points import Points
from symgen.study.references.reference import reference_motion


def relative(found, tolerance):
    """Assert that rows stay what the first one is, relative to its size."""
    found = np.asarray(found)
    size = np.linalg.norm(found[0])
    assert np.abs(found - found[0]).max() < tolerance * size


def test_free_body_turns_over_as_jacobi_says():
    """Euler's equations with moments I1 < I2 < I3 and L^2 > 2 T I2 (Landau and Lifshitz, Mechanics, 37)."""
    model, result = run("free-rigid-body")
    assert (result.status, result.rank.rows) == ("ok", 0)
    _, tensor = inertia(model.mechanism, "body")
    i1, i2, i3 = np.diag(tensor)
    w0 = np.array([0.3, 5.0, 0.4])
    twice, square = w0 @ tensor @ w0, np.sum((tensor @ w0) ** 2)
    assert square > twice * i2
    modulus = (i2 - i1) * (twice * i3 - square) / ((i3 - i2) * (square - twice * i1))
    pace = np.sqrt((i3 - i2) * (square - twice * i1) / (i1 * i2 * i3))
    size = [
        np.sqrt((twice * i3 - square) / (i1 * (i3 - i1))),
        np.sqrt((twice * i3 - square) / (i2 * (i3 - i2))),
        np.sqrt((square - twice * i1) / (i3 * (i3 - i1))),
    ]
    start = ellipkinc(np.arctan2(w0[1] / size[1], w0[0] / size[0]), modulus)
    sn, cn, dn, _ = ellipj(start + pace * result.t, modulus)
    expected = np.column_stack([size[0] * cn, size[1] * sn, size[2] * dn])
    np.testing.assert_allclose(expected[0], w0, atol=1e-14)
    assert expected[:, 1].min() < -4.9, "it must turn over"
    np.testing.assert_allclose(spin(result, "body"), expected, atol=1e-10 * np.linalg.norm(w0))

    line = np.asarray(centre(result, "body")[0]) + result.t[:, None] * np.array([0.3, -0.2, 0.1])
    np.testing.assert_allclose(centre(result, "body"), line, atol=1e-12)
    about = turned(result, "body").apply(spin(result, "body") @ tensor)
    for i in range(3):
        assert np.abs(about[:, i] - about[0, i]).max() < 1e-10 * np.sqrt(square)
    relative(energy(result, model.mechanism, (0.0, 0.0, 0.0)), 1e-10)


def test_heavy_top_follows_the_elliptic_solution():
    """u = height of the axis: u'^2 is a cubic with roots u1 < u2 < 1 < u3, so u = u1 + (u2 - u1) sn^2."""
    model, result = run("heavy-top", until=2.0)
    assert result.status == "ok", result.reason
    mass, length, gravity, axial, across = 15.0, 1.0, 9.81, 0.46875, 0.234375 + 15.0
    spin0, turn = 150.0, -4.61538  # about the axis, and about the vertical, at the start with the axis horizontal
    weight = 2.0 * mass * gravity * length / across
    b, a = axial * spin0 / across, turn  # L3 / A and Lz / A
    alpha = turn**2  # (2 E - L3^2 / C) / A at u = 0, where the axis moves horizontally
    roots = np.sort(np.roots([weight, -(alpha + b * b), 2.0 * a * b - weight, alpha - a * a]).real)
    assert roots[1] == pytest.approx(0.0, abs=1e-12) and roots[2] > 1.0 > roots[0] > -1.0
    modulus = (roots[1] - roots[0]) / (roots[2] - roots[0])
    pace = 0.5 * np.sqrt(weight * (roots[2] - roots[0]))
    quarter = ellipkinc(np.pi / 2, modulus)
    sn = ellipj(quarter + pace * result.t, modulus)[0]
    height = roots[0] + (roots[1] - roots[0]) * sn**2
    np.testing.assert_allclose(centre(result, "top")[:, 2], height * length, atol=1e-10)

    np.testing.assert_allclose(spin(result, "top")[:, 1], spin0, rtol=1e-10)
    whole = momentum(result, model.mechanism)
    assert np.abs(whole[:, 2] - whole[0, 2]).max() < 1e-10 * np.linalg.norm(whole[0])
    relative(energy(result, model.mechanism), 1e-10)
    np.testing.assert_allclose(velocity(result, "top")[0], [-turn, 0.0, 0.0], atol=1e-14)


@pytest.mark.slow_cases("chain:3-5.0")
@pytest.mark.parametrize(("name", "until"), [("spherical-double-pendulum", 10.0), ("chain:3", 5.0)])
def test_energy_and_momentum_about_the_vertical_stay(name, until):
    model, result = run(name, until=until)
    assert result.status == "ok", result.reason
    about = momentum(result, model.mechanism)
    size = np.linalg.norm(about, axis=1).max()
    assert size > 1.0
    assert np.abs(about[:, 2] - about[0, 2]).max() < 1e-10 * size
    whole = energy(result, model.mechanism)
    scale = np.abs(whole - whole[0]).max() + 10.0  # J, what goes to and fro
    assert np.abs(whole - whole[0]).max() < 1e-10 * scale


@pytest.mark.by_turns(6)
@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "until"),
    [
        ("free-rigid-body", 10.0),
        ("heavy-top", 1.0),
        ("spherical-double-pendulum", 4.0),
        ("chain:4", 2.0),
    ],
)
def test_independent_equations_lead_the_same_way(name, until):
    times = np.linspace(0.0, until, 41)
    model, result = run(name, until=until, times=times)
    found = reference_motion(model.mechanism, model.parameters(), *start_of(model), times, solver="scipy-dop853")
    apart = Points.of_mechanism(model.mechanism, model.parameters()).largest_distance(
        columns(result, model.mechanism), found.q
    )
    assert apart < max(1e-9, 10.0 * found.estimated_error)
    assert found.estimated_error < 1e-7


@pytest.mark.parametrize("size", [1, 2, 7])
def test_chains_of_all_sizes_are_closed(size):
    model = symgen.load(f"chain:{size}")
    assert len(model.mechanism.bodies) == len(model.mechanism.joints) == size
    assert sum(len(joint.rows) for joint in model.mechanism.joints) == 3 + 5 * (size - 1)
    q, v = start_of(model) if size < 3 else (None, None)
    if q is not None:
        np.testing.assert_allclose(q[:3], [0.5, 0.0, 0.0], atol=1e-12)
        assert np.all(v == 0.0)
