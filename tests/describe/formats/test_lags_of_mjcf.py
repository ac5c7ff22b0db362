"""Actuators of MJCF with a law of their own: lags, integrals and dampers move as in MuJoCo, held at one command."""

import numpy as np
import pytest

import symgen

mujoco = pytest.importorskip("mujoco")

MACHINE = """<mujoco><option gravity="0 0 -9.81" integrator="RK4" timestep="1e-5">
<flag contact="disable" limit="disable"/></option><worldbody>
<body name="u" pos="0 0 1"><joint name="a" axis="0 1 0" damping="0.02" armature="0.01"/>
<geom type="capsule" size="0.02" fromto="0 0 0 0.3 0 0" mass="0.8"/>
<body name="v" pos="0.3 0 0"><joint name="b" axis="0 1 0" damping="0.01"/>
<geom type="capsule" size="0.02" fromto="0 0 0 0.2 0 0.1" mass="0.4"/></body></body></worldbody>
<actuator>{}</actuator></mujoco>"""
#: Actuator -> its element and the command.
ACTUATORS = {
    "damper": ('<damper name="p" joint="a" kv="4" ctrlrange="0 1"/>', 0.5),
    "intvelocity": ('<intvelocity name="p" joint="a" kp="30" kv="0.6" actrange="-1 1"/>', 0.9),
    "intvelocity at the end of its range": (
        '<intvelocity name="p" joint="a" kp="30" kv="0.6" actrange="-0.2 0.2"/>',
        0.9,
    ),
    "intvelocity without a command": ('<intvelocity name="p" joint="a" kp="30" kv="0.6" actrange="-1 1"/>', 0.0),
    "filter": ('<general name="p" joint="a" dyntype="filter" dynprm="0.1" gainprm="3" biastype="none"/>', 1.0),
    "filterexact": ('<general name="p" joint="a" dyntype="filterexact" dynprm="0.1" gainprm="3"/>', 1.0),
    "cylinder": ('<cylinder name="p" joint="b" timeconst="0.05" area="0.5" bias="0.1 -1 0"/>', 0.5),
    "affine gain": ('<general name="p" joint="b" gaintype="affine" gainprm="2 0.5 -0.3"/>', 0.4),
}


@pytest.mark.slow
@pytest.mark.parametrize("kind", ACTUATORS)
def test_actuators_with_a_law_of_their_own_move_as_in_mujoco(tmp_path, kind):
    """They were left out among what changes nothing: 2.5 rad off after half a second without any command."""
    element, command = ACTUATORS[kind]
    path = tmp_path / "arm.xml"
    path.write_text(MACHINE.format(element))
    model = mujoco.MjModel.from_xml_string(path.read_text())
    data = mujoco.MjData(model)
    data.ctrl[:] = command
    for _ in range(50_000):
        mujoco.mj_step(model, data)
    own = symgen.load(path)
    assert not any("an actuator" in remark for remark in own.remarks)
    result = own.simulate(until=0.5, inputs={"p": command}, integrator="dop853", rtol=1e-10, atol=1e-11)
    found = [result[name][-1] for name in ("a.angle", "b.angle")]
    np.testing.assert_allclose(found, data.qpos, atol=5e-5)


def test_an_actuator_that_is_left_out_is_among_what_the_motion_may_depend_on(tmp_path):
    path = tmp_path / "arm.xml"
    path.write_text(MACHINE.format('<muscle name="p" joint="a" lengthrange="0 1"/>'))
    assert any("the motion may depend on it: an actuator (p)" in remark for remark in symgen.load(path).remarks)
