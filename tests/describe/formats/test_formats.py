"""Files of other programs: bodies, joints and forces from URDF and MJCF, against closed forms and MuJoCo."""

import json
import math
import sys
from pathlib import Path

import mujoco
import numpy as np
import pytest

from symgen.api import Model
from symgen.base.errors import InputError
from symgen.cli import main
from symgen.describe.files.load import load_mechanism
from symgen.describe.files.validate import validate
from symgen.describe.formats import Import, format_of, read_robot
from symgen.describe.formats._poses import (
    Pose,
    axis_rotation,
    matrix_product,
    quaternion_of_rotation,
    rotation_from_quaternion,
    rotation_from_rpy,
)
from symgen.run.compiling.free_by_loops import free_velocities

#: A lever of two links that a fixed joint holds together, a slide on it, a follower, and a link without mass.
ARM = """<?xml version="1.0"?>
<robot name="Test Arm">
  <link name="world"/>
  <link name="lever">
    <inertial><origin xyz="0 0 -0.2"/><mass value="2"/>
      <inertia ixx="0.03" iyy="0.03" izz="0.002" ixy="0" ixz="0" iyz="0"/></inertial>
    <visual><geometry><box size="0.1 0.1 0.4"/></geometry><material name="orange"><color rgba="1 0.5 0 1"/></material>
    </visual>
    <collision><geometry><box size="0.1 0.1 0.4"/></geometry></collision>
  </link>
  <link name="weight">
    <inertial><mass value="1"/><inertia ixx="0.01" iyy="0.01" izz="0.01" ixy="0" ixz="0" iyz="0"/></inertial>
  </link>
  <link name="tool"/>
  <joint name="pivot" type="revolute">
    <parent link="world"/><child link="lever"/><origin xyz="0 0 1" rpy="0 0.4 0"/><axis xyz="0 1 0"/>
    <dynamics damping="0.3"/><limit lower="-1" upper="1" effort="5" velocity="2"/>
  </joint>
  <joint name="weld" type="fixed"><parent link="lever"/><child link="weight"/><origin xyz="0 0 -0.5"/></joint>
  <joint name="tip" type="continuous"><parent link="weight"/><child link="tool"/><axis xyz="0 0 1"/></joint>
</robot>
"""


def imported(tmp_path: Path, text: str, name: str = "arm.urdf", *, floating: bool = False) -> Import:
    path = tmp_path / name
    path.write_text(text, encoding="utf-8")
    kind = format_of(path)
    assert kind is not None
    return read_robot(path, kind, floating=floating)


def model_of(read: Import) -> Model:
    return Model(validate(read.raw, "imported"))


def test_a_lever_swings_as_its_mass_and_inertia_say(tmp_path: Path) -> None:
    read = imported(tmp_path, ARM)
    assert list(read.raw["bodies"]) == ["lever"]
    assert read.raw["bodies"]["lever"]["mass"] == 3.0
    model = model_of(read)
    inertia = 0.03 + 2 * 0.2**2 + 0.01 + 1 * 0.5**2  # about the pivot, by Steiner
    run = model.simulate(until=0.5, inputs={"pivot_torque": 0.7}, coordinates="joint", rtol=1e-11)

    from scipy.integrate import solve_ivp

    def rate(_: float, y: np.ndarray) -> list[float]:
        moment = 9.81 * (2 * 0.2 + 1 * 0.5)
        return [y[1], (0.7 - 0.3 * y[1] - moment * math.sin(y[0] + 0.4)) / inertia]

    exact = solve_ivp(rate, (0.0, 0.5), [0.0, 0.0], rtol=1e-12, atol=1e-13).y[0, -1]
    assert run["pivot.angle"][-1] == pytest.approx(exact, abs=1e-9)


def test_what_is_left_out_is_listed(tmp_path: Path) -> None:
    left_out = {item.what: item for item in imported(tmp_path, ARM).left_out}
    assert set(left_out) == {"contacts", "limits of effort and speed", "limits", "a joint"}
    assert left_out["contacts"].moves and left_out["limits"].moves and not left_out["a joint"].moves
    assert left_out["a joint"].where == "tip"


def test_looks_and_points_follow(tmp_path: Path) -> None:
    lever = imported(tmp_path, ARM).raw["bodies"]["lever"]
    assert lever["points"] == {"weight": [0.0, 0.0, -0.5], "tool": [0.0, 0.0, -0.5]}
    assert lever["shape"][0]["type"] == "box" and lever["shape"][0]["colour"] == "#ff8000"


def test_a_start_outside_the_limits_is_moved_into_them(tmp_path: Path) -> None:
    read = imported(tmp_path, ARM.replace('lower="-1"', 'lower="0.3"'))
    run = model_of(read).simulate(until=0.01, coordinates="joint")
    assert run["pivot.angle"][0] == pytest.approx(0.3, abs=1e-12)


@pytest.mark.slow
def test_limits_become_stops(tmp_path: Path) -> None:
    path = tmp_path / "arm.urdf"
    path.write_text(ARM, encoding="utf-8")
    read = read_robot(path, "urdf", stops=True)
    assert read.raw["joints"]["pivot"]["stop"] == {"lower": -1.0, "upper": 1.0}
    assert "limits" not in {item.what for item in read.left_out}
    run = model_of(read).simulate(until=2.0, inputs={"pivot_torque": 30.0}, coordinates="joint")
    assert run["pivot.angle"][-1] == pytest.approx(1.0, abs=1e-9)  # pressed against its stop


@pytest.mark.slow
def test_mimic_and_a_floating_base(tmp_path: Path) -> None:
    text = """<robot name="pair">
  <link name="base"><inertial><mass value="4"/><inertia ixx="0.1" iyy="0.1" izz="0.1"/></inertial></link>
  <link name="left"><inertial><origin xyz="0.2 0 0"/><mass value="1"/><inertia ixx="0.01" iyy="0.02" izz="0.02"/>
  </inertial></link>
  <link name="right"><inertial><origin xyz="0.2 0 0"/><mass value="1"/><inertia ixx="0.01" iyy="0.02" izz="0.02"/>
  </inertial></link>
  <joint name="a" type="revolute"><parent link="base"/><child link="left"/><axis xyz="0 1 0"/>
    <limit lower="-3" upper="3" effort="1" velocity="1"/></joint>
  <joint name="b" type="prismatic"><parent link="base"/><child link="right"/><axis xyz="0 0 2"/>
    <limit lower="-3" upper="3" effort="1" velocity="1"/><mimic joint="a" multiplier="0.5" offset="0.1"/></joint>
</robot>"""
    read = imported(tmp_path, text, floating=True)
    assert list(read.raw["inputs"]) == ["a_torque"]
    run = model_of(read).simulate(until=0.3, inputs={"a_torque": 0.2}, coordinates="joint")
    assert np.allclose(run["b.displacement"], 0.1 + 0.5 * run["a.angle"], atol=1e-9)
    total = 4 * run["base.z"] + run["left.z"] + run["right.z"]
    assert (total[-1] - total[0]) / 6 == pytest.approx(-9.81 * 0.3**2 / 2, abs=1e-8)  # the base falls


@pytest.mark.slow
def test_a_joint_that_mimics_with_an_offset_starts_where_its_leader_leaves_it(tmp_path: Path) -> None:
    """The leader stays at 0, also of a follower of a follower, and nothing is closed by moving."""
    mass = '<inertial><origin xyz="0.2 0 0"/><mass value="1"/><inertia ixx="0.01" iyy="0.02" izz="0.02"/></inertial>'
    links = "".join(f'<link name="{name}">{mass}</link>' for name in ("base", "one", "two", "three"))
    joints = "".join(
        f'<joint name="{name}" type="{kind}"><parent link="base"/><child link="{child}"/><axis xyz="0 1 0"/>'
        f'<limit lower="-3" upper="3" effort="1" velocity="1"/>{mimic}</joint>'
        for name, kind, child, mimic in (
            ("c", "revolute", "three", '<mimic joint="b" multiplier="2" offset="-0.4"/>'),
            ("a", "revolute", "one", ""),
            ("b", "prismatic", "two", '<mimic joint="a" multiplier="0.5" offset="0.1"/>'),
        )
    )
    run = model_of(imported(tmp_path, f'<robot name="three">{links}{joints}</robot>')).simulate(until=0.01)
    start = {name: run[name][0] for name in ("a.angle", "b.displacement", "c.angle")}
    assert start == pytest.approx({"a.angle": 0.0, "b.displacement": 0.1, "c.angle": -0.2}, abs=1e-12)
    assert not any("moved" in note for note in run.notes)


@pytest.mark.by_turns(2)
@pytest.mark.slow
@pytest.mark.parametrize("tag", ["loop_joint", "loop"])
def test_two_dialects_close_a_loop(tmp_path: Path, tag: str) -> None:
    ends = {
        "loop_joint": '<link1 link="rod" xyz="0.5 0 0" rpy="0 0 0"/><link2 link="rocker" xyz="0 0 0.3" rpy="0 0 0"/>',
        "loop": '<predecessor link="rod"><origin xyz="0.5 0 0"/></predecessor>'
        '<successor link="rocker"><origin xyz="0 0 0.3"/></successor>',
    }[tag]
    mass = '<inertial><origin xyz="0.1 0 0.1"/><mass value="1"/><inertia ixx="0.01" iyy="0.01" izz="0.01"/></inertial>'
    joints = "".join(
        f'<joint name="{name}" type="continuous"><parent link="{parent}"/><child link="{child}"/>'
        f'<origin xyz="{at}"/><axis xyz="0 1 0"/></joint>'
        for name, parent, child, at in (
            ("A", "frame", "crank", "0 0 0"),
            ("B", "crank", "rod", "0 0 0.3"),
            ("C", "frame", "rocker", "0.5 0 0"),
        )
    )
    links = "".join(f'<link name="{name}">{mass}</link>' for name in ("crank", "rod", "rocker"))
    text = (
        f'<robot name="bar"><link name="frame"/>{links}{joints}<{tag} name="D" type="spherical">{ends}</{tag}></robot>'
    )
    run = model_of(imported(tmp_path, text)).simulate(until=0.15, coordinates="joint", start={"A.angle.rate": 2.0})
    assert run.status == "ok"
    assert np.allclose(run["C.angle"], run["A.angle"], atol=1e-8)  # a parallelogram


MJCF = """<mujoco model="gripper"><compiler angle="radian"/><option timestep="1e-4" integrator="RK4"/>
  <default><joint armature="0.02" damping="0.1"/></default>
  <worldbody>
    <body name="arm" pos="0 0 1" euler="0.3 0 0.2">
      <joint name="yaw" axis="0 0 1" stiffness="3" springref="0.4"/><joint name="pitch" axis="0 1 0.2" pos="0.05 0 0"/>
      <geom type="capsule" fromto="0 0 0 0.4 0 0" size="0.03"/>
      <body name="slider" pos="0.4 0 0"><joint name="slide" type="slide" axis="1 0 0.5" armature="0.03"/>
        <geom type="box" size="0.05 0.04 0.03" pos="0 0.02 0"/><site name="tip" pos="0.1 0 0"/>
        <body name="ball" pos="0 0 -0.1"><joint name="socket" type="ball" armature="0"/>
          <geom type="sphere" size="0.04" pos="0.05 0 -0.1"/></body>
      </body></body></worldbody>
  <actuator><motor name="drive" joint="pitch" gear="2"/>
    <position name="servo" joint="slide" kp="50" ctrlrange="-0.1 0.1" forcerange="-20 20"/></actuator>
  <tendon><fixed name="coil" stiffness="8" damping="0.3" springlength="0.1"><joint joint="yaw" coef="0.5"/>
    <joint joint="pitch" coef="-1"/></fixed></tendon>
</mujoco>"""


@pytest.mark.slow
def test_mjcf_moves_as_in_mujoco(tmp_path: Path) -> None:
    read = imported(tmp_path, MJCF, "gripper.xml")
    assert read.format == "mjcf" and read.raw["bodies"]["slider"]["points"] == {"tip": [0.1, 0.0, 0.0]}
    model, data = (m := mujoco.MjModel.from_xml_string(MJCF)), mujoco.MjData(m)
    model.opt.disableflags |= int(mujoco.mjtDisableBit.mjDSBL_CONTACT)
    data.ctrl[:] = 0.3, 0.5  # the servo's is cut to 0.1
    for _ in range(2000):
        mujoco.mj_step(model, data)
    mujoco.mj_kinematics(model, data)
    run = model_of(read).simulate(
        until=0.2, inputs={"drive": 0.3, "servo": 0.5}, coordinates="joint", rtol=1e-11, atol=1e-12
    )
    for body in ("arm", "slider", "ball"):
        place = [run[f"{body}.{axis}"][-1] for axis in "xyz"]
        assert np.allclose(place, data.body(body).xipos, atol=1e-9), body
    assert run["yaw.angle"][-1] == pytest.approx(float(data.joint("yaw").qpos[0]), abs=1e-9)


@pytest.mark.slow
def test_equalities_of_mjcf(tmp_path: Path) -> None:
    text = """<mujoco><worldbody>
  <body name="a"><joint name="x" axis="0 1 0" ref="0.2"/><geom size="0.1" pos="0.3 0 0"/></body>
  <body name="b" pos="1 0 0"><joint name="y" axis="0 1 0"/><geom size="0.1" pos="0.3 0 0"/></body>
  <body name="c" pos="0 1 0" euler="0 -40 0"><joint name="u" axis="0 1 0"/><geom size="0.1" pos="0.3 0 0"/>
    <body name="d" pos="0.6 0 0" euler="0 80 0"><joint name="w" axis="0 1 0"/><geom size="0.1" pos="0.3 0 0"/></body>
  </body>
  </worldbody><equality><joint joint1="y" joint2="x" polycoef="0 0.5 0.25"/><connect body1="d" anchor="0.6 0 0"/>
  </equality><contact/><option><flag contact="disable"/></option></mujoco>"""
    run = model_of(imported(tmp_path, text, "eq.xml")).simulate(until=0.2, coordinates="joint")
    x = run["x.angle"] - math.radians(0.2)  # an angle of 0.2 degrees where the body is described
    assert np.allclose(run["y.angle"], 0.5 * x + 0.25 * x**2, atol=1e-9) and abs(x[-1]) > 0.1
    assert run["x.angle"][0] == pytest.approx(math.radians(0.2), abs=1e-12)
    first = np.radians(-40) + run["u.angle"]
    second = first + np.radians(80) + run["w.angle"]
    end = 0.6 * np.array([np.cos(first) + np.cos(second), np.sin(first) + np.sin(second)])
    assert np.allclose(end.T, [1.2 * math.cos(np.radians(40)), 0.0], atol=1e-9)


@pytest.mark.slow
def test_armature_between_links_without_mass_is_left_out(tmp_path: Path) -> None:
    text = """<mujoco><worldbody><body name="torso"><joint name="x" type="slide" axis="1 0 0" armature="0.2"/>
      <joint name="z" type="slide" axis="0 0 1" armature="0.3"/><geom type="box" size="0.1 0.1 0.1" mass="2"/></body>
      </worldbody></mujoco>"""
    read = imported(tmp_path, text, "float.xml")
    assert [item.where for item in read.left_out if item.what == "armature"] == ["x", "z"]
    run = model_of(read).simulate(until=0.1, coordinates="joint")
    assert run.status == "ok" and run["torso.z"][-1] == pytest.approx(-0.5 * 9.81 * 0.1**2, rel=1e-6)


def test_what_mujoco_advises_its_authors_is_no_warning(tmp_path: Path) -> None:
    assert imported(tmp_path, MJCF.replace("<compiler", '<compiler settotalmass="3"'), "old.xml").raw["bodies"]


@pytest.mark.slow
def test_a_loop_with_a_limit_and_friction_is_where_mujoco_tends_to(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    text = """<mujoco model="slider"><compiler angle="radian"/><option timestep="{h}" integrator="RK4" tolerance="1e-14"
    iterations="200"><flag contact="disable"/></option><default><equality solref="1e-3 1" solimp="{d} {d} 0.001"/>
    <joint solreflimit="1e-3 1" solimplimit="{d} {d} 0.001" solreffriction="1e-3 1" solimpfriction="{d} {d} 0.001"/>
    </default><worldbody><body name="crank" euler="0 -0.7 0"><joint name="A" axis="0 1 0"/>
    <geom type="capsule" fromto="0 0 0 0.3 0 0" size="0.02" mass="0.3"/>
    <body name="rod" pos="0.3 0 0" euler="0 1.2 0"><joint name="B" axis="0 1 0"/>
    <geom type="capsule" fromto="0 0 0 0.7 0 0" size="0.02" mass="0.7"/></body></body>
    <body name="slide" pos="0.85 0 0"><joint name="S" type="slide" axis="1 0 0" frictionloss="0.4" range="-0.5 0.08"
    limited="true"/><geom type="box" size=".05 .05 .05" mass="0.6"/></body></worldbody>
    <equality><connect body1="rod" body2="slide" anchor="0.7 0 0"/></equality></mujoco>"""
    path = tmp_path / "slider.xml"
    path.write_text(text.format(h=1e-4, d=0.9), encoding="utf-8")
    run = model_of(read_robot(path, "mjcf", stops=True)).simulate(until=0.3, rtol=1e-10, atol=1e-11)
    assert run.status == "ok" and run.events  # the limit is met
    monkeypatch.setattr(
        "symgen.run.compiling.free_by_loops.DEPENDENT", -1.0
    )  # the loop is closed by a row that is left out
    model = model_of(read_robot(path, "mjcf", stops=True))
    closed = model.simulate(until=0.3, rtol=1e-10, atol=1e-11)
    assert free_velocities(model.mechanism) and abs(closed["slide.x"][-1] - run["slide.x"][-1]) < 1e-9
    violations, apart = [], []
    for h, d in ((1e-4, 0.9), (5e-5, 0.99), (2.5e-5, 0.9999)):
        model = mujoco.MjModel.from_xml_string(text.format(h=h, d=d))
        data = mujoco.MjData(model)
        largest = 0.0
        for _ in range(60):
            mujoco.mj_step(model, data, round(0.3 / h / 60))
            largest = max(largest, float(np.abs(data.efc_pos[: data.ne]).max()))
        mujoco.mj_kinematics(model, data)
        names = ("crank", "rod", "slide")
        places = [np.array([run[f"{name}.{axis}"][-1] for axis in "xyz"]) - data.body(name).xipos for name in names]
        violations.append(largest)
        apart.append(float(np.abs(places).max()))
    assert violations[2] < 1e-2 * violations[0] and apart[2] < 1e-2 * apart[0]
    assert apart[1] < 0.1 * apart[0]


def test_without_mujoco_a_sentence_says_what_to_install(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "mujoco", None)
    with pytest.raises(InputError, match=r"pip install symgen\[import\]"):
        imported(tmp_path, MJCF, "gripper.xml")


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ('<!DOCTYPE r [<!ENTITY a "aaaa">]><robot name="x"><link name="&a;"/></robot>', "document type"),
        ("<robot name='x'><xacro:macro/></robot>", "expand the macros first"),
        ("<robot name='x'>", "syntax error"),
        ("<model/>", "outermost element is 'robot'"),
        ("<robot name='x'/>", "a robot with links"),
        ("<robot name='x'><link name='a'/></robot>", "a link that moves"),
        ("<robot name='x'><link name='a'/><link name='a'/></robot>", "a name used once"),
        (ARM.replace('type="revolute"', 'type="revolut"'), "did you mean 'revolute'"),
        (ARM.replace('parent link="world"', 'parent link="wrld"'), "did you mean 'world'"),
        (ARM.replace('xyz="0 0 1" rpy', 'xyz="0 0 nan" rpy'), "3 finite numbers"),
        (ARM.replace('<mass value="2"/>', '<mass value="-2"/>'), "a mass of 0 or above"),
        ("<robot name='x'>" + "<link>" * 300 + "</link>" * 300 + "</robot>", "at most 500000 elements, 200 deep"),
        (ARM.replace('axis xyz="0 1 0"', 'axis xyz="0 0 0"'), "an axis other than 0 0 0"),
    ],
)
def test_bad_files_are_refused_in_a_sentence(tmp_path: Path, text: str, words: str) -> None:
    with pytest.raises(InputError) as error:
        imported(tmp_path, text)
    assert words in str(error.value) and "\n" not in str(error.value)


@pytest.mark.parametrize("include", ["../other.xml", "self.xml", "/etc/passwd"])
def test_includes_stay_in_the_folder(tmp_path: Path, include: str) -> None:
    with pytest.raises(InputError, match="include"):
        imported(tmp_path, f'<mujoco><include file="{include}"/></mujoco>', "self.xml")


def test_names_become_identifiers(tmp_path: Path) -> None:
    text = ARM.replace('name="pivot"', "name=\"__import__('os'); rm -rf\"").replace('"lever"', '"ground"')
    read = imported(tmp_path, text)
    assert list(read.raw["joints"]) == ["import___os___rm__rf"] or all(
        name.isidentifier() for name in (*read.raw["joints"], *read.raw["bodies"])
    )
    model_of(read)


def test_the_command_and_every_other_command(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path, target = tmp_path / "arm.urdf", tmp_path / "arm.toml"
    path.write_text(ARM, encoding="utf-8")
    assert main(["import", str(path), "-o", str(target), "--json"]) == 0
    answer = json.loads(capsys.readouterr().out)
    assert answer["format"] == "urdf" and answer["bodies"] == 1 and len(answer["left_out"]) == 4
    first, *rest = remarks = load_mechanism(target).remarks
    assert first.startswith("left out, and the motion may depend on it: contacts")
    assert load_mechanism(path).remarks == remarks and len(rest) == sum(x["moves"] for x in answer["left_out"]) - 1
    assert load_mechanism(target).bodies == load_mechanism(path).bodies
    assert main(["import", str(path), "-o", str(target)]) == 2  # never overwrites
    asked = (
        main(["import", str(path), "--json"]),
        json.loads(capsys.readouterr().out)["file"],
        [*tmp_path.glob("*.toml")],
    )
    assert asked == (0, None, [target])  # JSON alone writes no file
    assert main(["import", str(path), "--json", "-o", "-"]) == 2
    assert main(["check", str(path)]) == 0
    assert main(["import", str(tmp_path / "arm.step")]) == 2


def test_rotations() -> None:
    rotation = rotation_from_rpy((0.3, -0.8, 2.0))
    x, y, z = (
        np.array(axis_rotation(axis, angle))
        for axis, angle in (((1.0, 0, 0), 0.3), ((0, 1.0, 0), -0.8), ((0, 0, 1.0), 2.0))
    )
    assert np.allclose(rotation, z @ y @ x)
    for angle in (0.1, 3.1, -3.1, 2.0):
        for axis in ((1.0, 0.0, 0.0), (0.2, -1.0, 0.4), (0.0, 0.0, -1.0)):
            turn = axis_rotation(axis, angle)
            assert np.allclose(rotation_from_quaternion(quaternion_of_rotation(turn)), turn)
    inner = Pose((1.0, 2.0, 3.0), rotation)
    assert np.allclose((inner @ inner.inverse()).origin, 0.0) and np.allclose(
        matrix_product(rotation, inner.inverse().rotation), np.eye(3)
    )
