"""SDF: motions beside the same mechanisms in URDF and MJCF, inertia beside MuJoCo's compiler, and what is refused."""

import re
from pathlib import Path
from typing import Any

import mujoco
import numpy as np
import pytest

from symgen.api import Model
from symgen.base.errors import InputError
from symgen.describe.files.validate import validate
from symgen.describe.formats import Import, format_of, read_robot


def imported(tmp_path: Path, text: str, name: str = "file.sdf", **options: bool) -> Import:
    path = tmp_path / name
    path.write_text(text, encoding="utf-8")
    kind = format_of(path)
    assert kind == path.suffix[1:].replace("xml", "mjcf")
    return read_robot(path, kind, **options)


def model_of(read: Import) -> Model:
    return Model(validate(read.raw, "imported"))


def inertial(mass: float, pose: str, xx: float, yy: float, zz: float) -> str:
    tensor = f"<ixx>{xx}</ixx><iyy>{yy}</iyy><izz>{zz}</izz>"
    return f"<inertial><pose>{pose}</pose><mass>{mass}</mass><inertia>{tensor}</inertia></inertial>"


#: A four-bar whose loop is native; the poses pass through frames, joints and a nested model.
BAR = f"""<sdf version="1.9"><world name="w"><gravity>0 0 -9.81</gravity><model name="bar"><pose>0 0 1 0 0 0</pose>
  <frame name="far"><pose degrees="true">0.5 0 0 0 0 90</pose></frame>
  <frame name="top" attached_to="crank"><pose>0 0 0.3 0 0 0</pose></frame>
  <link name="crank"><pose relative_to="A"/>{inertial(1.0, "0.1 0 0.1 0 0 0", 0.01, 0.02, 0.03)}</link>
  <link name="rod"><pose relative_to="top">0 0 0 0 0 0</pose>{inertial(2.0, "0.1 0 0.1 0 0 0", 0.02, 0.02, 0.01)}</link>
  <model name="side"><pose relative_to="far">0 0 0 0 0 -1.5707963267948966</pose>
    <link name="rocker">{inertial(1.5, "0.1 0 0.1 0 0 0", 0.03, 0.01, 0.01)}</link></model>
  <joint name="A" type="revolute"><pose relative_to="__model__"/><parent>world</parent><child>crank</child>
    <axis><xyz>0 2 0</xyz><dynamics><damping>0.3</damping><spring_stiffness>2</spring_stiffness>
    <spring_reference>0.4</spring_reference></dynamics></axis></joint>
  <joint name="B" type="revolute"><parent>top</parent><child>rod</child><axis><xyz>0 1 0</xyz></axis></joint>
  <joint name="C" type="continuous"><parent>world</parent><child>side::rocker</child>
    <axis><xyz expressed_in="far">1 0 0</xyz></axis></joint>
  <joint name="D" type="ball"><pose relative_to="rod">0.5 0 0 0 0 0</pose><parent>rod</parent>
    <child>side::rocker</child></joint>
</model></world></sdf>"""


@pytest.mark.slow
def test_a_native_loop_moves_as_the_same_one_in_urdf(tmp_path: Path) -> None:
    bodies = {"crank": (1.0, 0.01, 0.02, 0.03), "rod": (2.0, 0.02, 0.02, 0.01), "rocker": (1.5, 0.03, 0.01, 0.01)}
    links = "".join(
        f'<link name="{name}"><inertial><origin xyz="0.1 0 0.1"/><mass value="{m}"/>'
        f'<inertia ixx="{a}" iyy="{b}" izz="{c}"/></inertial></link>'
        for name, (m, a, b, c) in bodies.items()
    )
    joints = "".join(
        f'<joint name="{name}" type="continuous"><parent link="{parent}"/><child link="{child}"/>'
        f'<origin xyz="{at}"/><axis xyz="0 1 0"/>{more}</joint>'
        for name, parent, child, at, more in (
            ("A", "frame", "crank", "0 0 1", '<dynamics damping="0.3"/>'),
            ("B", "crank", "rod", "0 0 0.3", ""),
            ("C", "frame", "rocker", "0.5 0 1", ""),
        )
    )
    ends = '<link1 link="rod" xyz="0.5 0 0" rpy="0 0 0"/><link2 link="rocker" xyz="0 0 0.3" rpy="0 0 0"/>'
    urdf = f'<robot name="bar"><link name="frame"/>{links}{joints}<loop_joint name="D" type="spherical">{ends}'
    other = imported(tmp_path, f"{urdf}</loop_joint></robot>", "bar.urdf")
    drive = other.raw["forces"]["A_drive"]
    drive |= {"stiffness": 2.0, "free_angle": 0.4}  # URDF has no springs
    read = imported(tmp_path, BAR)
    assert [joint["type"] for joint in read.raw["joints"].values()] == ["revolute"] * 3 + ["spherical"]
    runs = [
        model_of(x).simulate(until=0.3, inputs={"A_torque": 1.5}, coordinates="absolute", rtol=1e-12, atol=1e-13)
        for x in (read, other)
    ]
    assert all(run.status == "ok" for run in runs)
    assert np.ptp(runs[0]["crank.x"]) > 0.01
    for name, body in (("crank", "crank"), ("rod", "rod"), ("side_rocker", "rocker")):
        for axis in "xyz":
            assert np.abs(runs[0][f"{name}.{axis}"] - runs[1][f"{body}.{axis}"]).max() < 1e-12


@pytest.mark.slow
def test_a_cross_moves_as_two_hinges_in_mjcf(tmp_path: Path) -> None:
    sdf = f"""<sdf version="1.10"><model name="whip">
      <link name="arm"><pose>0.1 0.2 1 0.3 0.2 0.1</pose>{inertial(1.2, "0.05 0 -0.3 0 0 0", 0.02, 0.03, 0.01)}</link>
      <link name="tip"><pose relative_to="arm">0 0 -0.6 0 0 0</pose>
        {inertial(0.4, "0 0 -0.1 0 0 0", 0.002, 0.001, 0.001)}</link>
      <joint name="cross" type="universal"><parent>world</parent><child>arm</child><axis><xyz>1 0 0</xyz></axis>
        <axis2><xyz>0 1 0</xyz></axis2></joint>
      <joint name="slide" type="prismatic"><parent>arm</parent><child>tip</child><axis><xyz>0 0 1</xyz>
        <limit><lower>-0.1</lower><upper>inf</upper><effort>3</effort></limit>
        <dynamics><spring_stiffness>50</spring_stiffness><damping>0.2</damping></dynamics></axis></joint>
    </model></sdf>"""
    mjcf = """<mujoco model="whip"><compiler angle="radian" eulerseq="XYZ"/><option gravity="0 0 -9.8"/><worldbody>
      <body name="arm" pos="0.1 0.2 1" euler="0.3 0.2 0.1"><joint name="a" axis="1 0 0"/><joint name="b" axis="0 1 0"/>
        <inertial pos="0.05 0 -0.3" mass="1.2" diaginertia="0.02 0.03 0.01"/>
        <body name="tip" pos="0 0 -0.6"><joint name="slide" type="slide" axis="0 0 1" stiffness="50" damping="0.2"/>
          <inertial pos="0 0 -0.1" mass="0.4" diaginertia="0.002 0.001 0.001"/></body></body>
    </worldbody></mujoco>"""
    read = imported(tmp_path, sdf, stops=True)
    assert read.raw["joints"]["slide"]["stop"] == {"lower": -0.1}
    reads = imported(tmp_path, sdf), imported(tmp_path, mjcf, "whip.xml")
    runs = [model_of(x).simulate(until=0.3, coordinates="joint", rtol=1e-12, atol=1e-13) for x in reads]
    for body in ("arm", "tip"):
        for axis in "xyz":
            assert np.abs(runs[0][f"{body}.{axis}"] - runs[1][f"{body}.{axis}"]).max() < 1e-12
    assert np.ptp(runs[0]["arm.x"]) > 0.01


def test_inertia_of_shapes_is_that_of_mujoco(tmp_path: Path) -> None:
    sdf = """<sdf version="1.11"><model name="heap"><link name="heap">
      <inertial auto="true"><density>500</density></inertial>
      <collision name="a"><pose>0.1 0.2 0.3 0.4 0.5 0.6</pose><geometry><box><size>0.2 0.3 0.4</size></box></geometry>
      </collision><collision name="b"><density>800</density><pose>0 0.4 0 0.7 0 0</pose><geometry><capsule>
      <radius>0.1</radius><length>0.5</length></capsule></geometry></collision>
      <collision name="c"><pose>0.5 0 0 0 0.3 0</pose><geometry><cylinder><radius>0.2</radius><length>0.1</length>
      </cylinder></geometry></collision><collision name="d"><pose>0 0 0.9 0 0 0.2</pose><geometry><ellipsoid>
      <radii>0.1 0.2 0.3</radii></ellipsoid></geometry></collision><collision name="e"><geometry><sphere><radius>0.15
      </radius></sphere></geometry></collision></link></model></sdf>"""
    shapes = (
        'type="box" size="0.1 0.15 0.2" pos="0.1 0.2 0.3" euler="0.4 0.5 0.6"',
        'type="capsule" size="0.1 0.25" pos="0 0.4 0" euler="0.7 0 0"',
        'type="cylinder" size="0.2 0.05" pos="0.5 0 0" euler="0 0.3 0"',
        'type="ellipsoid" size="0.1 0.2 0.3" pos="0 0 0.9" euler="0 0 0.2"',
        'type="sphere" size="0.15"',
    )
    geoms = "".join(f"<geom density='{800 if 'capsule' in shape else 500}' {shape}/>" for shape in shapes)
    compiler = '<compiler angle="radian" eulerseq="XYZ"/>'
    model = mujoco.MjModel.from_xml_string(
        f"<mujoco>{compiler}<worldbody><body><freejoint/>{geoms}</body></worldbody></mujoco>"
    )
    body = imported(tmp_path, sdf).raw["bodies"]["heap"]
    assert body["mass"] == pytest.approx(model.body_mass[1], rel=1e-12)
    assert np.allclose(body["centre_of_mass"], model.body_ipos[1], atol=1e-12)
    turn = np.zeros(9)
    mujoco.mju_quat2Mat(turn, model.body_iquat[1])
    tensor = turn.reshape(3, 3) @ np.diag(model.body_inertia[1]) @ turn.reshape(3, 3).T
    xx, yy, zz, xy, xz, yz = body["inertia"]
    assert np.allclose([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]], tensor, rtol=1e-9, atol=1e-9 * tensor.max())
    heavy = imported(tmp_path, sdf.replace("<density>500", "<mass>7</mass><density>500")).raw["bodies"]["heap"]
    assert heavy["mass"] == pytest.approx(7.0) and heavy["inertia"][0] == pytest.approx(7.0 / body["mass"] * xx)


def test_fixed_joints_either_way_round_hold_links_together(tmp_path: Path) -> None:
    links = "".join(
        f'<link name="{name}"><pose>{x} 0 0 0 0 0</pose>{inertial(1.0, "0 0 0 0 0 0", 0.1, 0.1, 0.1)}</link>'
        for name, x in (("a", 0.0), ("b", 1.0), ("c", 2.0), ("d", 3.0))
    )
    pairs = (("a", "b"), ("c", "b"), ("c", "a"))  # the last one closes a ring
    joints = "".join(
        f'<joint name="{p}{c}" type="fixed"><parent>{p}</parent><child>{c}</child></joint>' for p, c in pairs
    )
    old = """<joint name="swing" type="revolute"><parent>c</parent><child>d</child><axis><xyz>0 1 0</xyz>
      <use_parent_model_frame>1</use_parent_model_frame></axis></joint>
      <joint name="twin" type="revolute"><parent>c</parent><child>d</child><axis><xyz>0 1 0</xyz>
      <mimic joint="swing"><multiplier>1</multiplier></mimic></axis></joint>"""
    read = imported(tmp_path, f'<sdf version="1.6"><model name="chain">{links}{joints}{old}</model></sdf>')
    bodies = read.raw["bodies"]
    assert (
        list(bodies) == ["a", "d"] and bodies["a"]["mass"] == 3.0 and bodies["a"]["centre_of_mass"] == [1.0, 0.0, 0.0]
    )
    assert bodies["a"]["inertia"] == pytest.approx([0.3, 2.3, 2.3])
    assert read.raw["joints"]["twin_mimic"]["type"] == "coupling" and list(read.raw["inputs"]) == ["swing_torque"]


REFUSED: dict[str, tuple[str, str]] = {
    "bomb": ('<!DOCTYPE sdf [<!ENTITY a "b">]><sdf version="1.9"/>', "XML without a document type"),
    "include": (
        BAR.replace('<frame name="far">', '<include><uri>../../etc/passwd</uri></include><frame name="far">'),
        "include: expected one file, got '../../etc/passwd'",
    ),
    "ring": (
        BAR.replace('name="far"><pose', 'name="far"><pose relative_to="C"'),
        "expected poses in chains, got a ring",
    ),
    "frame": (BAR.replace('"top">0', '"tap">0'), "expected the name of a frame, got 'tap'; did you mean 'top'"),
    "kind": (BAR.replace('"ball"', '"hinge"'), "joint 'D', type: expected one of fixed, revolute"),
    "gearbox": (BAR.replace('"ball"', '"gearbox"'), "joint 'D': expected two axes of a gearbox, got less"),
    "two axes": (BAR.replace('"ball"', '"revolute2"'), "joint 'D': expected two axes of a revolute2 joint, got less"),
    "twice": (BAR.replace('name="rod"', 'name="crank"'), "expected a name used once, got 'crank' twice"),
    "axis": (BAR.replace("0 2 0", "0 0 0"), "expected an axis other than 0 0 0"),
    "number": (BAR.replace("0.3</damping>", "x</damping>"), "damping: expected a finite number, got 'x'"),
    "mass": (BAR.replace("<mass>2.0", "<mass>-1"), "expected a mass of 0 or above"),
    "version": (BAR.replace('"1.9"', '"new"'), "expected a version such as 1.9, got 'new'"),
    "none": ('<sdf version="1.9"><world name="w"/></sdf>', "expected a file with a model, got none"),
    "name": (BAR.replace('link name="rod"', 'link name="a::b"'), "expected an element with a name without '::'"),
    "mesh": (
        '<sdf version="1.11"><model name="m"><link name="l"><inertial auto="1"/><collision name="c"><geometry><mesh>'
        "<uri>/etc/passwd</uri></mesh></geometry></collision></link></model></sdf>",
        "expected box, sphere, cylinder, capsule or ellipsoid, got 'mesh'",
    ),
    "placement": (BAR.replace('<model name="bar">', '<model name="bar" placement_frame="far">'), "a placement_frame"),
    "root": ('<robot name="r"/>', "outermost element is 'sdf'"),
}


@pytest.mark.parametrize("case", REFUSED)
def test_a_wrong_file_is_refused_in_a_sentence(case: str, tmp_path: Path) -> None:
    text, words = REFUSED[case]
    with pytest.raises(InputError) as caught:
        imported(tmp_path, text)
    assert words in str(caught.value), str(caught.value)


def test_hostile_names_become_plain_ones(tmp_path: Path) -> None:
    read = imported(tmp_path, BAR.replace("crank", "&lt;script&gt;&quot;];import os").replace('"A"', '"lambda"'))
    mechanism = validate(read.raw, "imported")
    names = [*(body.name for body in mechanism.bodies), *(joint.name for joint in mechanism.joints), *mechanism.inputs]
    assert len(names) == 10 and all(re.fullmatch("[A-Za-z][A-Za-z0-9_]*", name) for name in names)
    assert "lambda" not in names


def test_what_is_left_out_is_listed(tmp_path: Path) -> None:
    box = "<geometry><box><size>1 1 1</size></box></geometry>"
    more = f"""<plugin name="p" filename="f"/><link name="loose"><gravity>0</gravity>
      <collision name="c">{box}</collision>
      <visual name="v"><geometry><mesh><uri>x.stl</uri></mesh></geometry></visual>
      <visual name="w"><material><diffuse>1 0.5 0 1</diffuse></material>{box}</visual></link>"""
    read = imported(tmp_path, BAR.replace("</model></world>", f"{more}</model></world>"))
    left_out: dict[str, Any] = {item.what: item for item in read.left_out}
    assert set(left_out) == {"contacts", "meshes", "<plugin>", "a link without gravity"}
    assert left_out["<plugin>"].moves and not left_out["meshes"].moves
    loose = read.raw["bodies"]["loose"]
    assert loose["mass"] == 1.0 and loose["inertia"] == [1.0, 1.0, 1.0]  # what SDF takes without <inertial>
    assert loose["shape"][0]["colour"] == "#ff8000"


# -- screws, gearboxes, two axes in a row ------------------------------------------------------------------------------


def nut(thread: str, version: str = "1.10") -> str:
    inside = inertial(2.0, "0 0 0 0 0 0", 0.1, 0.1, 0.3)
    return f"""<sdf version="{version}"><model name="press"><link name="nut"><pose>0 0 1 0 0 0</pose>{inside}</link>
      <joint name="thread" type="screw"><parent>world</parent><child>nut</child><axis><xyz>0 0 1</xyz>
      <dynamics><damping>0.1</damping></dynamics></axis>{thread}</joint></model></sdf>"""


@pytest.mark.fast("old")
@pytest.mark.parametrize(
    "thread",
    ["<screw_thread_pitch>0.5</screw_thread_pitch>", "<thread_pitch>-12.566370614359172</thread_pitch>"],
    ids=["new", "old"],
)
def test_a_nut_sinks_on_its_thread(thread: str, tmp_path: Path) -> None:
    """A right-handed thread of 0.5 m a turn: the weight turns the nut, a = m g / (m + I (2 pi / pitch)^2)."""
    read = imported(tmp_path, nut(thread))
    assert read.raw["joints"]["thread"]["pitch"] == pytest.approx(0.5, rel=1e-12)
    assert [item.what for item in read.left_out] == ["a spring or damper"]
    run = model_of(read).simulate(until=1.0, rtol=1e-11, atol=1e-12)
    slope = 2.0 * np.pi / 0.5
    rate = -2.0 * 9.8 / (2.0 + 0.3 * slope**2)
    assert run["nut.vz"][-1] == pytest.approx(rate, abs=1e-9)
    assert run["nut.wz"][-1] == pytest.approx(rate * slope, abs=1e-8)


def wheels(axis2: str, second: str) -> str:
    links = "".join(
        f'<link name="{name}"><pose>{x} 0 0 0 0 0</pose>{inertial(1.0, "0 0 0 0 0 0", 0.1, 0.1, inertia)}</link>'
        for name, x, inertia in (("frame", 0, 1.0), ("pinion", 0, 0.2), ("wheel", 1, 0.9))
    )
    return f"""<sdf version="1.9"><model name="gears">{links}
      <joint name="base" type="fixed"><parent>world</parent><child>frame</child></joint>
      <joint name="a" type="revolute"><parent>frame</parent><child>pinion</child><axis><xyz>0 0 1</xyz></axis></joint>
      <joint name="b" type="revolute">{second}</joint>
      <joint name="mesh" type="gearbox"><parent>pinion</parent><child>wheel</child><axis><xyz>0 0 1</xyz></axis>
      <axis2><xyz>{axis2}</xyz></axis2><gearbox_ratio>3</gearbox_ratio>
      <gearbox_reference_body>frame</gearbox_reference_body></joint></model></sdf>"""


#: The joint of the second wheel, either way round and with its axis up or down.
SECOND = {
    "up": "<parent>world</parent><child>wheel</child><axis><xyz>0 0 1</xyz></axis>",
    "down": "<parent>frame</parent><child>wheel</child><axis><xyz>0 0 -1</xyz></axis>",
    "back": "<pose relative_to='wheel'/><parent>wheel</parent><child>frame</child><axis><xyz>0 0 1</xyz></axis>",
}


@pytest.mark.by_turns(3)
@pytest.mark.fast("0 0 1--1.0-down")
@pytest.mark.parametrize("second", SECOND)
@pytest.mark.parametrize(("axis2", "sign"), [("0 0 1", -1.0), ("0 0 -2", 1.0)])
def test_a_gearbox_couples_the_joints_of_its_wheels(second: str, axis2: str, sign: float, tmp_path: Path) -> None:
    """theta_2 = -3 theta_1 about the axes of the gearbox: 1 N m on the pinion moves 0.2 + 9 * 0.9 kg m^2."""
    read = imported(tmp_path, wheels(axis2, SECOND[second]))
    assert read.raw["joints"]["mesh_mesh"]["type"] == "coupling"
    run = model_of(read).simulate(until=1.0, inputs={"a_torque": 1.0}, rtol=1e-11, atol=1e-12)
    rate = 1.0 / (0.2 + 9.0 * 0.9)
    assert run["pinion.wz"][-1] == pytest.approx(rate, abs=1e-9)
    assert run["wheel.wz"][-1] == pytest.approx(3.0 * sign * rate, abs=1e-9)


def test_a_gearbox_without_joints_of_its_wheels_is_refused(tmp_path: Path) -> None:
    text = wheels("0 1 0", SECOND["up"])
    with pytest.raises(InputError, match="expected revolute joints of both links with 'frame' about the axes"):
        imported(tmp_path, text)
    with pytest.raises(InputError, match="expected the element gearbox_reference_body, got none"):
        imported(tmp_path, re.sub("<gearbox_reference_body>.*</gearbox_reference_body>", "", text))


@pytest.mark.by_turns(2)
@pytest.mark.slow
@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
def test_two_axes_in_a_row_move_as_two_hinges_in_mjcf(coordinates: str, tmp_path: Path) -> None:
    """A fork that is steered and a wheel in it: each axis has its damper, its spring and its limits."""
    wheel = inertial(1.0, "0.2 0 0 0 0 0", 0.02, 0.03, 0.02)
    sdf = f"""<sdf version="1.9"><model name="fork"><link name="wheel"><pose>0 0 1 0 0 0</pose>{wheel}</link>
      <joint name="fork" type="revolute2"><parent>world</parent><child>wheel</child>
      <axis><xyz>1 0 0.2</xyz><limit><lower>-1</lower><upper>1</upper></limit>
      <dynamics><damping>0.3</damping></dynamics></axis>
      <axis2><xyz>0 1 0.3</xyz><dynamics><spring_stiffness>2</spring_stiffness></dynamics></axis2></joint>
    </model></sdf>"""
    mjcf = """<mujoco model="fork"><option gravity="0 0 -9.8"/><worldbody><body name="wheel" pos="0 0 1">
      <joint name="fork_1" axis="1 0 0.2" damping="0.3"/><joint name="fork_2" axis="0 1 0.3" stiffness="2"/>
      <inertial pos="0.2 0 0" mass="1" diaginertia="0.02 0.03 0.02"/></body></worldbody></mujoco>"""
    read = imported(tmp_path, sdf, stops=True)
    assert read.raw["joints"]["fork_1"]["stop"] == {"lower": -1.0, "upper": 1.0}
    assert list(read.raw["inputs"]) == ["fork_1_torque", "fork_2_torque"]
    reads, tight = (imported(tmp_path, sdf), imported(tmp_path, mjcf, "fork.xml")), {"rtol": 1e-12, "atol": 1e-13}
    runs = [model_of(x).simulate(until=0.5, coordinates=coordinates, **tight) for x in reads]
    assert all(run.status == "ok" for run in runs) and np.ptp(runs[0]["wheel.z"]) > 0.01
    for axis in "xyz":
        assert np.abs(runs[0][f"wheel.{axis}"] - runs[1][f"wheel.{axis}"]).max() < 1e-10
