"""Boxes and a quadruped beside MuJoCo: soft contacts sink as their time constant says, those of symgen do not."""

import pytest

from benchmarks import beside_mujoco
from benchmarks.beside_siconos import G
from benchmarks.peers.mujoco_contacts import standing


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


@pytest.mark.slow
def test_a_quadruped_stands_where_another_one_sinks_or_creeps() -> None:
    _, _, least, creep = beside_mujoco.stand()
    assert abs(least) < 1e-13 and creep < 1e-7
    soft, _, stiff = (
        standing(beside_mujoco.QUADRUPED, setting["step"], setting["time"], beside_mujoco.STANDS)
        for setting in beside_mujoco.THEIRS.values()
    )
    assert 5e-4 < -soft[1] < 1.5e-3 and soft[2] < 1e-6  # as it comes, it sinks and stays
    assert -stiff[1] < 1e-6 and 1e-4 < stiff[2] < 1e-2  # as stiff as steps allow, it creeps
