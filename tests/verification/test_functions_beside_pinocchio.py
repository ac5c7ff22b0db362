"""Dynamics, frames and derivatives of robots beside Pinocchio, which reads the same files."""

import numpy as np
import pinocchio as pin
import pytest
from support.recursion import random_robot, urdf

from benchmarks.functions import LEG, batches, timed
from symgen.api import load

ROBOTS = {
    "chain": ([-1, 0, 1], "rrr"),
    "arm": ([-1, 0, 1, 2, 3, 4], "rrrrrr"),
    "slides": ([-1, 0, 1, 2], "prpr"),
    "fork": ([-1, 0, 0, 1, 2, 2], "rrrprr"),
    "two": ([-1, -1, 0, 1], "rprr"),
}


@pytest.mark.slow
@pytest.mark.by_turns(4)
@pytest.mark.parametrize("name", [x if x == "chain" else pytest.param(x, marks=pytest.mark.slow) for x in ROBOTS])
def test_robots_are_pinocchios(name, tmp_path):
    limbs = random_robot(sum(map(ord, name)), *ROBOTS[name])
    text = urdf(limbs)
    path = tmp_path / "robot.urdf"
    path.write_text(text, encoding="utf-8")
    f, other = load(path).functions(), pin.buildModelFromXML(text)
    data, tool = other.createData(), f.frame("tool")
    order = np.array([other.joints[other.getJointId(x.name.partition(".")[0])].idx_v for x in f.velocities])
    both, damping = np.ix_(order, order), np.array([limb.damping for limb in limbs])
    places = {other.joints[other.getJointId(f"j_{limb.name}")].idx_v: i for i, limb in enumerate(limbs)}
    loss = damping[[places[i] for i in order]]
    frame, world, local = other.getFrameId("tool"), pin.LOCAL_WORLD_ALIGNED, pin.LOCAL
    back, rng = np.argsort(order), np.random.default_rng(0)
    for _ in range(5):
        q, v, a, effort = rng.uniform(-1.0, 1.0, (4, len(order)))
        theirs = q[back], v[back]
        mass = np.triu(pin.crba(other, data, theirs[0]))
        assert apart(f.mass_matrix(q), (mass + np.triu(mass, 1).T)[both]) < 1e-12
        assert apart(f.bias(q, v), pin.nonLinearEffects(other, data, *theirs)[order] + loss * v) < 1e-12
        assert apart(f.inverse_dynamics(q, v, a), pin.rnea(other, data, *theirs, a[back])[order] + loss * v) < 1e-12
        acceleration = pin.aba(other, data, *theirs, (effort - loss * v)[back])[order]
        assert apart(f.forward_dynamics(q, v, effort), acceleration) < 1e-12
        pin.computeRNEADerivatives(other, data, *theirs, a[back])
        assert apart(f.derivative("inverse_dynamics", "q")(q, v, a), data.dtau_dq[both]) < 1e-12
        assert apart(f.derivative("inverse_dynamics", "v")(q, v, a), data.dtau_dv[both] + np.diag(loss)) < 1e-12
        pin.computeABADerivatives(other, data, *theirs, (effort - loss * v)[back])
        assert apart(f.derivative("forward_dynamics", "q")(q, v, effort), data.ddq_dq[both]) < 1e-11
        pin.forwardKinematics(other, data, *theirs, np.zeros(len(order)))
        pin.updateFramePlacements(other, data)
        pin.computeJointJacobians(other, data, theirs[0])
        assert apart(tool.pose(q), data.oMf[frame].homogeneous) < 1e-12
        for ours, axes in ((tool, world), (tool.local, local)):
            assert apart(ours.jacobian(q), pin.getFrameJacobian(other, data, frame, axes)[:, order]) < 1e-12
            assert apart(ours.velocity(q, v), pin.getFrameVelocity(other, data, frame, axes).vector) < 1e-12
        rate = pin.getFrameClassicalAcceleration(other, data, frame, world).vector
        assert apart(tool.jacobian_rate(q, v), rate) < 1e-12


@pytest.mark.slow
def test_a_closed_leg_has_the_accelerations_of_other_programs():
    velocities, table, apart_from = batches(LEG)
    assert velocities == 4 and {"pinocchio", "mujoco, alone"} < set(table["forward_dynamics"])
    assert apart_from["pinocchio"] < 1e-12 and apart_from["mujoco"] < 1e-3  # its connection is soft
    for row in table.values():
        assert all(times["us"] > 0.0 and len(times["over"]) == 3 for times in timed(row, rounds=2).values())


def apart(value, exact):
    return np.abs(value - exact).max() / max(1.0, np.abs(exact).max())
