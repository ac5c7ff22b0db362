"""The spatial slider-crank against a motion computed by another program."""

import numpy as np
import pytest
from support.spatial_runs import DATA, run, turned

REFERENCE = np.loadtxt(DATA / "spatial_slider_crank.csv", delimiter=",")
METHODS = [
    "direct-correction",
    *(pytest.param(name, marks=pytest.mark.slow) for name in ("lagrange", "index1-augmented-lagrangian")),
]


@pytest.mark.parametrize("method", METHODS)
def test_the_slider_follows_the_reference(method):
    _, result = run("spatial-slider-crank", method, rtol=1e-11, atol=1e-13, until=5.0, times=REFERENCE[:, 0])
    assert result.status == "ok", result.reason
    assert (result.rank.rows, result.rank.rank) == (17, 17)
    np.testing.assert_allclose(result["slider.x"], REFERENCE[:, 1], rtol=0.0, atol=2e-8)
    # 54 rad are eight turns and a half, which the joint's coordinate counts
    np.testing.assert_allclose(result["A.angle"], REFERENCE[:, 2], rtol=0.0, atol=1e-7)
    np.testing.assert_allclose(result["crank.wx"], REFERENCE[:, 3], rtol=0.0, atol=2e-6)


def test_the_start_is_the_source_s():
    _, result = run("spatial-slider-crank", until=1e-3)
    omega = turned(result, "rod")[0].apply([result[f"rod.w{c}"][0] for c in "xyz"])
    np.testing.assert_allclose(omega, [1.92, -0.96, 0.48], atol=1e-14)
    np.testing.assert_allclose([result[f"rod.v{c}"][0] for c in "xyz"], [0.12, -0.24, 0.0], atol=1e-14)
    np.testing.assert_allclose([result[f"slider.v{c}"][0] for c in "xyz"], [0.24, 0.0, 0.0], atol=1e-14)
    assert result.energy_drift_max < 1e-12
