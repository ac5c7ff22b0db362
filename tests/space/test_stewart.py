"""Stewart's platform with driven legs: inverse and forward kinematics, and the work of the drives."""

import math

import numpy as np
import pytest
from support.spatial_runs import centre, energy, point, run, turned


@pytest.mark.slow
def test_inverse_and_forward_kinematics_agree():
    """Legs driven with the lengths of a prescribed motion move the platform in that way, to 1e-12."""
    times = np.linspace(0.0, 2.0, 101)
    model, result = run("stewart-platform", integrator="rk4", step=2e-3, until=2.0, times=times)
    assert result.status == "ok", result.reason
    assert (result.rank.rows, result.rank.rank) == (78, 78)
    w, t = 2.0 * math.pi, result.t
    place = np.column_stack(
        [0.1 * np.sin(w * t), 0.05 * (1.0 - np.cos(w * t)), 1.0 + 0.08 * np.sin(2.0 * w * t)],
    )
    np.testing.assert_allclose(centre(result, "platform"), place, rtol=0.0, atol=1e-12)
    turn = 0.3 * np.sin(w * t)
    heading = turned(result, "platform").apply([1.0, 0.0, 0.0])
    np.testing.assert_allclose(heading, np.column_stack([np.cos(turn), np.sin(turn), 0.0 * t]), rtol=0.0, atol=1e-12)

    # forward: from where the platform is, the lengths of the legs
    for i in range(6):
        beta = math.radians(120.0 * (i // 2) + (10.0 if i % 2 else -10.0))
        gamma = math.radians(120.0 * (i // 2) + (50.0 if i % 2 else -50.0))
        foot = [0.8 * math.cos(beta), 0.8 * math.sin(beta), 0.0]
        head = point(result, "platform", [0.4 * math.cos(gamma), 0.4 * math.sin(gamma), 0.0])
        length = np.linalg.norm(head - foot, axis=1)
        np.testing.assert_allclose(result[f"leg{i + 1}.displacement"], length, rtol=0.0, atol=1e-12)

    # the drives' power is the rate of the energy: over whole periods they do no work
    whole = energy(result, model.mechanism)
    assert np.abs(whole - whole[0]).max() > 1.0
    assert abs(whole[-1] - whole[0]) < 1e-8
    power = -sum(result[f"multiplier.drive{i}.driver"] * result[f"leg{i}.displacement.rate"] for i in range(1, 7))
    slope = np.gradient(whole, t, edge_order=2)
    assert np.abs(power[1:-1] - slope[1:-1]).max() < 0.05 * np.abs(power).max()
    assert result.energy_drift_max < 1e-6
