"""Loops in files of robots: joints that `<gazebo>` adds to a URDF, and trees that keep their inertia in MJCF."""

import itertools
import math
from pathlib import Path

import mujoco
import numpy as np
import pytest

from symgen.api import Model
from symgen.describe.files.validate import validate
from symgen.describe.formats import Import, format_of, read_robot
from symgen.describe.parts.topology import count_empty_ends, spanning_tree, state_names
from symgen.run.compiling.choices import mechanism_on_tree

LINKS = "".join(
    f'<link name="{name}"><inertial><origin xyz="{centre}"/><mass value="1"/>'
    '<inertia ixx="0.1" iyy="0.1" izz="0.1" ixy="0" ixz="0" iyz="0"/></inertial></link>'
    for name, centre in (("a", "0.5 0 0"), ("b", "0 0 0.5"), ("c", "0.5 0 0"))
)
JOINTS = "".join(
    f'<joint name="{name}" type="continuous"><parent link="{parent}"/><child link="{child}"/>'
    f'<origin xyz="{at}"/><axis xyz="0 1 0"/></joint>'
    for name, parent, child, at in (
        ("j0", "world", "a", "0 0 0"),
        ("j1", "a", "b", "1 0 0"),
        ("j2", "world", "c", "0 0 1"),
    )
)


def imported(tmp_path: Path, text: str, name: str) -> Import:
    """Return what is read of a file."""
    path = tmp_path / name
    path.write_text(text, encoding="utf-8")
    return read_robot(path, str(format_of(path)))


def model_of(read: Import) -> Model:
    """Return the model of what was read."""
    return Model(validate(read.raw, "imported"))


def looped(tmp_path: Path, closing: str) -> Import:
    """Return a parallelogram that is open but for what `<gazebo>` says."""
    text = f'<robot name="loop"><link name="world"/>{LINKS}{JOINTS}<gazebo>{closing}</gazebo></robot>'
    return imported(tmp_path, text, "loop.urdf")


@pytest.mark.by_turns(2)
@pytest.mark.slow
@pytest.mark.parametrize("pose", ["<pose>1 0 0 0 0 0</pose>", '<pose relative_to="b">0 0 1 0 0.4 0</pose>'])
def test_a_joint_in_gazebo_closes_a_loop(tmp_path: Path, pose: str) -> None:
    """A parallelogram of three bars about y keeps the two cranks parallel, and falls as one of 0.9 kg m^2."""
    ends = f"<parent>b</parent><child>c</child>{pose}<axis><xyz>0 1 0</xyz></axis>"
    read = looped(tmp_path, f'<joint name="closing" type="revolute">{ends}</joint>')
    assert not [item for item in read.left_out if item.moves]
    assert read.raw["joints"]["closing"]["cut"] is True
    run = model_of(read).simulate(until=0.05, coordinates="joint", output_step=0.05)
    assert run.status == "ok"
    np.testing.assert_allclose(run["j2.angle"], run["j0.angle"], atol=1e-9)
    np.testing.assert_allclose(run["j1.angle"], -run["j0.angle"], atol=1e-9)
    # two cranks of 0.1 + 0.25 kg m^2 about their ends, and 1 kg that both carry at 1 m
    assert run.a["a.alphay"][0] == pytest.approx((0.5 + 0.5 + 1.0) * 9.81 / (2 * 0.35 + 1.0), rel=1e-9)


@pytest.mark.parametrize(
    ("closing", "why"),
    [
        ('<joint name="x" type="gearbox"><parent>b</parent><child>c</child></joint>', "'gearbox'"),
        ('<joint name="x" type="ball"><parent>b</parent><child>d</child></joint>', "'d'"),
        ('<joint name="j0" type="ball"><parent>b</parent><child>c</child></joint>', "'j0' twice"),
        (
            '<joint name="x" type="revolute"><parent>b</parent><child>c</child>'
            '<axis><xyz expressed_in="a">0 1 0</xyz></axis></joint>',
            "'a'",
        ),
    ],
)
def test_a_joint_in_gazebo_that_is_not_read_is_listed_as_one_that_moves(tmp_path: Path, closing: str, why: str) -> None:
    read = looped(tmp_path, closing)
    (item,) = (item for item in read.left_out if item.what == "a joint of <gazebo>")
    assert item.moves and item.why.endswith(f"got {why}")
    assert set(read.raw["joints"]) == {"j0", "j1", "j2"}


FOOT = """<mujoco model="foot"><compiler angle="radian"/><worldbody>
<body name="foot"><joint name="roll" type="hinge" axis="1 0 0"/><joint name="pitch" type="hinge" axis="0 1 0"/>
 <inertial pos="0.03 0 -0.02" mass="0.3" diaginertia="1e-4 9e-4 9e-4"/>
 <body name="rod" pos="0.02 -0.015 0.008"><joint name="u" type="hinge" axis="0 1 0"/>
  <joint name="w" type="hinge" axis="1 0 0"/><inertial pos="0 0 0.1" mass="0.015" diaginertia="7e-5 7e-5 2e-7"/></body>
</body>
<body name="m" pos="0.02 0 0.22"><joint name="motor" type="hinge" axis="1 0 0"/>
 <inertial pos="0.004 -0.005 0" mass="0.009" diaginertia="2e-6 1e-6 1e-6"/></body>
</worldbody><equality><connect body1="m" body2="rod" anchor="0.0175 -0.016 -0.004"/></equality></mujoco>"""


@pytest.mark.slow
def test_connect_keeps_the_tree_of_a_file(tmp_path: Path) -> None:
    """The mass matrix of joint coordinates is MuJoCo's, which knows no loop in it."""
    read = imported(tmp_path, FOOT, "foot.xml")
    assert [name for name, joint in read.raw["joints"].items() if joint.get("cut")] == ["equality0"]
    mechanism = model_of(read).mechanism
    tree = mechanism_on_tree(mechanism).topology
    assert tree is not None and tree.cut == ("equality0",)
    functions = model_of(read).functions(coordinates="joint")
    q, _ = functions.start
    own = mujoco.MjModel.from_xml_string(FOOT)
    data = mujoco.MjData(own)
    mujoco.mj_forward(own, data)
    names = [name.partition(".")[0] for name, _ in state_names(mechanism, tree)[1]]
    order = [own.joint(name).dofadr[0] for name in names]
    for column, unit in zip(functions.mass_matrix(q).T, np.eye(own.nv)[order], strict=True):
        product = np.zeros(own.nv)
        mujoco.mj_mulM(own, data, product, unit)
        np.testing.assert_allclose(column, product[order], atol=1e-12)


@pytest.mark.slow
def test_no_tree_ends_in_a_body_without_mass_where_another_does_not(tmp_path: Path) -> None:
    """The rod hangs on the motor by the shortest way, which leaves the fork of its universal joint without inertia."""
    read = imported(tmp_path, FOOT, "foot.xml")
    for joint in read.raw["joints"].values():
        joint.pop("cut", None)
    mechanism = model_of(read).mechanism
    for cut in itertools.chain([()], ([name] for name in ("u", "w", "motor"))):
        tree = spanning_tree(mechanism, tuple(cut))
        forked = any(name in cut for name in ("u", "w"))
        assert count_empty_ends(mechanism, tree) == (1 if forked else 0), cut
    functions = model_of(read).functions(coordinates="joint")
    least = np.linalg.eigvalsh(functions.mass_matrix(functions.start[0])).min()
    assert least > 1e-8 and math.isfinite(
        functions.forward_dynamics(*functions.start, [0.0] * len(functions.start[1]))[0]
    )
