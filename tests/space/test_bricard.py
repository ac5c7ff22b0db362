"""Bricard's six-bar: 30 rows of rank 29, against a reference of another program and by five methods."""

import numpy as np
import pytest
from support.spatial_runs import DATA, point, run

REFERENCE = np.loadtxt(DATA / "bricard_square_rods.csv", delimiter=",")
#: Joint -> body and place relative to its centre of mass.
PINS = {
    "P0": ("rod1", (-0.5, 0.0, 0.0)),
    "P1": ("rod1", (0.5, 0.0, 0.0)),
    "P2": ("rod2", (0.0, -0.5, 0.0)),
    "P3": ("rod3", (0.0, 0.0, 0.5)),
    "P4": ("rod4", (-0.5, 0.0, 0.0)),
    "P5": ("rod5", (0.0, 0.5, 0.0)),
}
METHODS = [
    "direct-correction",
    *(
        pytest.param(name, marks=pytest.mark.slow)
        for name in ("lagrange", "coordinate-partitioning", "augmented-lagrangian", "index1-augmented-lagrangian")
    ),
]


@pytest.mark.slow
@pytest.mark.by_turns(3)
@pytest.mark.parametrize("method", METHODS)
def test_all_joints_follow_the_reference(method):
    _, result = run("bricard", method, "rk4", step=1e-3, until=10.0, times=REFERENCE[:, 0])
    assert result.status in ("ok", "unverified"), result.reason
    assert (result.rank.rows, result.rank.rank) == (30, 29)
    expected = {f"P{i}": REFERENCE[:, 3 * i - 2 : 3 * i + 1] for i in range(1, 5)}
    expected |= {"P0": np.zeros((501, 3)), "P5": np.tile([0.0, 0.0, 1.0], (501, 1))}
    for name, (body, place) in PINS.items():
        away = np.linalg.norm(point(result, body, place) - expected[name], axis=1)
        assert away.max() < 2e-8, f"{name} is {away.max():g} m from the reference"


def test_the_redundant_row_is_named():
    model, result = run("bricard", "direct-correction", "rk4", step=1e-2, until=0.1)
    (row,) = result.rank.redundant_rows
    assert row.split(".")[0] in {joint.name for joint in model.mechanism.joints}
