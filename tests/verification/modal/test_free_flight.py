"""Free flight of curved bodies at 30 rad/s, against d'Alembert's principle on all nodes of their meshes."""

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from support.mesh_motion import MeshMotion
from support.modal_machines import arc, bow, machine, motion_of, reduce_to

CASES = {
    "planar": (bow, "velocity = [1.0, 2.0]\nangular_velocity = 30.0", {"arm.vm1": 2.0, "arm.m2": 0.01}),
    "spatial": (
        arc,
        "velocity = [1.0, 2.0, 0.5]\nangular_velocity = [10.0, 25.0, -15.0]",
        {"arm.vm1": 2.0, "arm.m2": 0.02},
    ),
}


@pytest.mark.by_turns(4)
@pytest.mark.slow
@pytest.mark.parametrize("space", CASES)
def test_a_curved_body_flies_as_all_nodes_do(space, tmp_path):
    """q to 1e-12; momenta and energy are those of the mesh, v^T M v, and stay to 1e-12 and 1e-11."""
    make, keys, start = CASES[space]
    mesh = make()
    body = reduce_to(tmp_path / "arm.npz", mesh, 4)
    model = machine(tmp_path, f'[bodies.arm]\ntype = "modal"\nfile = "arm.npz"\n{keys}\n', space, output_step=0.002)
    result = model.simulate(start=start, integrator="dop853", rtol=1e-13, atol=1e-14)
    assert result.status == "unverified" and "interface arm.root is turned by" in result.reason
    q, v = motion_of(result, model, "arm")
    nodes = MeshMotion(mesh, body.shapes)
    kept = [nodes.momenta(*state) for state in zip(q, v, strict=True)]
    for part, bound in zip(zip(*kept, strict=True), (1e-12, 1e-12, 1e-11), strict=True):
        values = np.array(part)
        assert np.abs(values - values[0]).max() <= bound * np.linalg.norm(values[0])
    energy = np.array([e for _, _, e in kept])
    np.testing.assert_allclose(result.kinetic + result.potential, energy, rtol=1e-12)
    still = np.zeros(nodes.d)
    reference = solve_ivp(
        lambda _, y: nodes.rate(y, still),
        (0.0, 0.1),
        np.concatenate([q[0], v[0]]),
        "DOP853",
        result.t,
        rtol=1e-13,
        atol=1e-14,
    )
    assert np.abs(reference.y[: q.shape[1]].T - q).max() < 1e-12


@pytest.mark.slow_cases("spatial")
@pytest.mark.parametrize("space", CASES)
def test_a_step_of_flight_has_the_accelerations_of_all_nodes(space, tmp_path):
    make, keys, start = CASES[space]
    mesh = make()
    body = reduce_to(tmp_path / "arm.npz", mesh, 1)
    model = machine(tmp_path, f'[bodies.arm]\ntype = "modal"\nfile = "arm.npz"\n{keys}\n', space, until=1e-3)
    result = model.simulate(start=start, integrator="rk4", step=1e-3)
    q, v = motion_of(result, model, "arm")
    nodes = MeshMotion(mesh, body.shapes)
    rate = nodes.rate(np.concatenate([q[0], v[0]]), np.zeros(nodes.d))[q.shape[1] :]
    np.testing.assert_allclose(result.a.values[0], rate, atol=1e-11 * np.abs(rate).max())
