"""Boxes on each other beside MuJoCo: soft contacts sink by what their time constant says, those of symgen do not."""

import pytest

from benchmarks import beside_mujoco
from benchmarks.beside_siconos import G


@pytest.mark.slow
def test_boxes_sink_in_soft_contacts_alone() -> None:
    scene = "dropped 5"
    _, least, speed = beside_mujoco.own(scene, {})
    assert abs(least) < 1e-13 and speed < 1e-12
    depths = {}
    for name, setting in beside_mujoco.THEIRS.items():
        _, deepest, _ = beside_mujoco.theirs(scene, setting)
        depths[name] = -deepest
        # a spring with critical damping that carries the weight of a body: g T^2 and few times as much
        assert 0.05 * G * setting["time"] ** 2 < -deepest < 20.0 * G * setting["time"] ** 2, name
    soft, small, stiff = depths.values()
    assert soft == pytest.approx(small, rel=0.01) and stiff < 1e-3 * soft
