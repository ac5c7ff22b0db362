"""Tendons of MJCF move what they pull as MuJoCo's do."""

from pathlib import Path

import mujoco
import numpy as np
import pytest

from symgen import Model
from symgen.describe.files.validate import validate
from symgen.describe.formats import Import, read_robot

#: A finger of two links and a slider: a tendon through sites of all, one on pulleys, one slack between two lengths.
FINGER = """<mujoco model="finger"><compiler angle="radian"/><option timestep="1e-4" integrator="RK4"/>
  <worldbody><site name="anchor" pos="0 0 1.2"/><site name="post" pos="1.6 0.3 0.9"/>
    <body name="first" pos="0 0 1"><joint name="knee" axis="0 1 0" damping="0.05"/>
      <geom type="capsule" fromto="0 0 0 0.4 0 0" size="0.03"/><site name="over" pos="0.2 0 0.08"/>
      <site name="along" pos="0.35 0.02 0.06"/>
      <body name="tip" pos="0.4 0 0"><joint name="bend" axis="0 1 0.3"/><site name="end" pos="0.15 0.01 0.05"/>
        <geom type="capsule" fromto="0 0 0 0.3 0 0" size="0.02"/></body></body>
    <body name="slider" pos="1 0 1"><joint name="rail" type="slide" axis="1 0 0.2"/><site name="eye" pos="0 0 0.1"/>
      <geom type="box" size="0.05 0.04 0.03"/></body></worldbody>
  <tendon>
    <spatial name="flexor" stiffness="40" damping="0.4" springlength="0.6">
      <site site="anchor"/><site site="over"/><site site="along"/><site site="end"/></spatial>
    <spatial name="tackle" range="0 3"><site site="end"/><site site="eye"/><pulley divisor="2"/>
      <site site="eye"/><site site="post"/><pulley divisor="2"/><site site="eye"/><site site="anchor"/></spatial>
    <spatial name="loose" stiffness="60" springlength="0.2 0.75"><site site="post"/><site site="eye"/></spatial>
    <fixed name="ties" stiffness="3" springlength="-0.1 0.1" damping="0.02"><joint joint="knee" coef="0.5"/>
      <joint joint="bend" coef="-1.5"/></fixed>
    <fixed name="heavy" armature="0.01"><joint joint="rail" coef="2"/></fixed>
  </tendon>
  <actuator><motor name="pull" tendon="flexor" gear="-1.5"/>
    <position name="hoist" tendon="tackle" kp="30" ctrlrange="0 2"/></actuator>
</mujoco>"""


def imported(tmp_path: Path, text: str, *, stops: bool = False) -> Import:
    (path := tmp_path / "finger.xml").write_text(text, encoding="utf-8")
    return read_robot(path, "mjcf", stops=stops)


@pytest.mark.slow
@pytest.mark.parametrize("coordinates", ["joint", "absolute"])
def test_they_pull_as_in_mujoco(tmp_path: Path, coordinates: str) -> None:
    read = imported(tmp_path, FINGER)
    model, data = (m := mujoco.MjModel.from_xml_string(FINGER)), mujoco.MjData(m)
    model.opt.disableflags |= int(mujoco.mjtDisableBit.mjDSBL_CONTACT) | int(mujoco.mjtDisableBit.mjDSBL_LIMIT)
    data.ctrl[:] = 2.0, 1.1
    for _ in range(2000):
        mujoco.mj_step(model, data)
    mujoco.mj_kinematics(model, data)
    run = Model(validate(read.raw, "imported")).simulate(
        until=0.2, inputs={"pull": 2.0, "hoist": 1.1}, coordinates=coordinates, rtol=1e-11, atol=1e-12
    )
    for body in ("first", "tip", "slider"):
        place = [run[f"{body}.{axis}"][-1] for axis in "xyz"]
        assert np.allclose(place, data.body(body).xipos, atol=1e-9), body
    assert abs(run["slider.x"][-1] - run["slider.x"][0]) > 0.01


#: A weight that falls on a thread beside its guide.
FALLING = """<mujoco model="weight"><worldbody><site name="hook" pos="0.3 0 0"/>
  <body name="weight"><joint name="guide" type="slide" axis="0 0 1"/><geom type="sphere" size="0.05"/>
    <site name="eye" pos="0 0 0"/></body></worldbody>
  <tendon><spatial name="thread" range="0.1 0.5"><site site="hook"/><site site="eye"/></spatial></tendon></mujoco>"""


@pytest.mark.slow
def test_limits_become_stops_of_their_lengths(tmp_path: Path) -> None:
    read = imported(tmp_path, FALLING, stops=True)
    assert sorted(read.raw["stops"]) == ["thread_lower", "thread_upper"]
    run = Model(validate(read.raw, "imported")).simulate(until=0.4, coordinates="joint", rtol=1e-10)
    # the thread of 0.5 m is tight 0.4 m below the hook, which the fall reaches after sqrt(2 0.4/g)
    (hit,) = (event for event in run.events if event.name == "thread_upper.hit")
    assert hit.t == pytest.approx(np.sqrt(0.8 / 9.81), abs=1e-9)
    assert run["weight.z"][-1] == pytest.approx(-0.4, abs=1e-9)


def test_what_is_left_out_of_tendons_is_said(tmp_path: Path) -> None:
    kept = imported(tmp_path, FINGER)
    assert [(x.what, x.where) for x in kept.left_out if "tendon" in x.what] == [("limits of tendons", "tackle")]
    assert kept.raw["joints"]["rail"]["rotor_inertia"] == pytest.approx(0.04)
    wrapped = FINGER.replace('<site site="over"/>', '<geom geom="drum"/>', 1).replace(
        '<site name="along"', '<geom name="drum" type="sphere" size="0.03" pos="0.2 0 0.03"/><site name="along"'
    )
    read = imported(tmp_path, wrapped.replace('name="ties"', 'name="ties" frictionloss="0.1"'))
    lost = {(x.what, x.where): x for x in read.left_out if x.moves}
    assert lost["a tendon", "flexor"].why == "its way wraps round geoms, where symgen has straight lines"
    assert ("friction and armature of tendons", "ties") in lost and "flexor_1" not in str(read.raw["forces"])
