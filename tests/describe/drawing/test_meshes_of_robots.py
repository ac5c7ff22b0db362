"""Meshes of robots' files: where MuJoCo has them, below the root of a package, and nowhere else."""

import os
from pathlib import Path

import mujoco
import numpy as np
import pytest

from symgen.base.errors import InputError
from symgen.cli import main
from symgen.describe.drawing.mechanism_scene import build_scene
from symgen.describe.drawing.meshes import MOST_TRIANGLES
from symgen.describe.drawing.scene import Solid
from symgen.describe.files.load import load_mechanism
from symgen.describe.formats import Import, format_of, read_robot

#: MuJoCo reads numbers of meshes by the language of the process.
pytestmark = pytest.mark.usefixtures("decimal_point")

CORNERS = np.array([[0.1, 0.0, 0.2], [1.0, 0.1, 0.0], [0.0, 2.0, 0.3], [0.2, 0.1, 3.0]])
WAVEFRONT = "".join(f"v {x} {y} {z}\n" for x, y, z in CORNERS) + "f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n"

MJCF = """<mujoco model="m"><compiler angle="radian" meshdir="{folder}"/>
  <asset><mesh name="a" file="t.obj" scale="0.1 -0.2 0.3" refpos="0.5 0.1 0.2"/>
    <mesh name="b" file="inner/t.obj" scale="-0.2 -0.2 -0.2" refpos="0.1 0.2 0.3" refquat="0.9 0.1 0.3 0.2"/>
    <mesh name="c" file="t.obj" scale="0.1 0.2 0.3" refquat="0.9 0.1 0.3 0.2"/>
    <mesh name="d" vertex="0 0 0 1 0 0 0 1 0 0 0 1"/></asset>
  <worldbody><body name="one" pos="0 0 1" euler="0.3 0.2 0.1"><freejoint/>
    <geom name="a" type="mesh" mesh="a" pos="0.1 0.2 0.3" quat="0.7 0.1 0.2 0.3" rgba="1 0 0 1"/>
    <geom name="hidden" type="sphere" size="9" group="3"/>
    <body name="two" pos="0.5 0 0" euler="0 0 1"><joint axis="0 1 0"/><geom name="b" type="mesh" mesh="b" pos="0 1 0"/>
      <geom type="mesh" mesh="c"/><geom type="mesh" mesh="d"/></body></body></worldbody></mujoco>"""


def written(folder: Path, name: str, text: str) -> Path:
    path = folder / name
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text + "\n")
    return path


def read(path: Path) -> Import:
    kind = format_of(path)
    assert kind is not None
    return read_robot(path, kind, floating=True)


def reasons(path: Path) -> list[str]:
    return [f"{item.where}: {item.why}" for item in read(path).left_out if item.what == "meshes"]


def faces_of(path: Path, role: str = "body") -> list[np.ndarray]:
    items = [item for item in build_scene(load_mechanism(path)).items if item.role == role]
    return [np.array(m.faces) for item in items for m in item.marks if isinstance(m, Solid)]


def corner_set(points: np.ndarray) -> np.ndarray:
    points = np.unique(points.reshape(-1, 3).round(6) + 0.0, axis=0)
    return points[np.lexsort(points.T)]


@pytest.mark.parametrize("folder", ["assets", "../assets", "."])
def test_meshes_of_mjcf_are_where_mujoco_has_them(folder: str, tmp_path: Path) -> None:
    for name in ("t.obj", "inner/t.obj"):
        written((tmp_path / "in" / folder).resolve(), name, WAVEFRONT)
    path = written(tmp_path, "in/m.xml", MJCF.format(folder=folder))
    shapes = faces_of(path)
    model = mujoco.MjModel.from_xml_path(str(path))
    for faces, name in zip(shapes, ("a", "b"), strict=True):
        geom, turn = model.geom(name), np.zeros(9)
        mujoco.mju_quat2Mat(turn, geom.quat)
        body, mesh = int(geom.bodyid[0]), int(geom.dataid[0])
        first, count = int(model.mesh_vertadr[mesh]), int(model.mesh_vertnum[mesh])
        vertices = model.mesh_vert[first : first + count] @ turn.reshape(3, 3).T + geom.pos
        wanted = vertices - model.body_ipos[body]  # shapes are drawn from the centre of mass
        found = corner_set(faces)
        assert found == pytest.approx(corner_set(wanted), abs=2e-6), name  # MuJoCo's vertices have seven digits
        # by the divergence theorem: a mirror that left faces inside out would change the sign
        unscaled = abs(np.linalg.det(CORNERS[1:] - CORNERS[0])) / 6.0
        volume = unscaled * abs(np.prod(model.mesh_scale[mesh]))
        assert np.sum(np.linalg.det(faces)) / 6.0 == pytest.approx(volume, rel=1e-6)
    assert reasons(path) == [
        "1 in pictures: they are turned, then scaled by several factors",
        "1 in pictures: they are made without files",
    ]
    assert [shape["type"] for shape in read(path).raw["bodies"]["one"]["shape"]] == ["mesh"]


def test_a_path_from_another_folder_finds_the_same_meshes(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    for name in ("t.obj", "inner/t.obj"):
        written(tmp_path / "in", name, WAVEFRONT)
    whole = faces_of(written(tmp_path, "in/m.xml", MJCF.format(folder=".")))
    monkeypatch.chdir(tmp_path)
    os.symlink("in/m.xml", "link.xml")
    for name in ("in/m.xml", "link.xml"):
        assert all(np.array_equal(a, b) for a, b in zip(faces_of(Path(name)), whole, strict=True))


def test_files_that_mujoco_would_open_elsewhere_are_refused(tmp_path: Path) -> None:
    for text, words in (
        ('<compiler meshdir="../.."/>', "compiler, meshdir"),
        ('<compiler meshdir="parts"/><asset><mesh file="../../../t.obj"/></asset>', "mesh, file"),
        ('<asset><texture type="cube" fileright="/etc/right.png"/></asset>', "texture, fileright"),
        ('<asset><model name="x" file="../../other.xml"/></asset>', "model: expected a file in the folder of m.xml"),
        ('<asset><hfield name="x" file="a\0b.png"/></asset>', "syntax error"),
    ):
        path = written(tmp_path / "a" / "b", "m.xml", f"<mujoco>{text}<worldbody/></mujoco>")
        with pytest.raises(InputError) as error:
            read(path)
        assert words in str(error.value) and "\n" not in str(error.value)
    bare = '<compiler strippath="true"/><asset><mesh name="t" file="C:/far/../../t.obj"/></asset>'
    body = '<body name="b"><freejoint/><geom type="mesh" mesh="t"/></body>'
    written(tmp_path / "a" / "b", "t.obj", WAVEFRONT)
    path = written(tmp_path / "a" / "b", "m.xml", f"<mujoco>{bare}<worldbody>{body}</worldbody></mujoco>")
    assert len(faces_of(path)) == 1


URDF = """<robot name="r"><link name="a"><inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1"/></inertial>
{meshes}</link><link name="base"/><joint name="j" type="revolute"><parent link="base"/><child link="a"/>
<axis xyz="0 0 1"/><limit lower="-1" upper="1"/></joint></robot>"""
SDF = """<sdf version="1.9"><model name="r"><link name="a">{meshes}</link></model></sdf>"""
_AS_URDF = '<visual><geometry><mesh filename="{}"/></geometry></visual>'
_AS_SDF = '<visual name="v"><geometry><mesh><uri>{}</uri></mesh></geometry></visual>'
FORMS = [("urdf", URDF, _AS_URDF, "package://"), ("sdf", SDF, _AS_SDF, "model://")]


@pytest.mark.parametrize(("end", "robot", "visual", "scheme"), FORMS)
def test_a_package_is_the_folder_above_of_that_name(
    end: str, robot: str, visual: str, scheme: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    outer, inner = tmp_path / "arms", tmp_path / "arms" / "source" / "urdf"
    for name in ("meshes/t.obj", "source/parts/t.obj", "source/urdf/t.obj"):
        written(outer, name, WAVEFRONT)
    written(tmp_path, "t.obj", WAVEFRONT)
    written(outer, "source/package.xml", '<package format="3"><name>tool</name><version>1</version></package>')
    os.symlink(tmp_path / "t.obj", outer / "meshes" / "link.obj")
    good = [f"{scheme}arms/meshes/t.obj", f"{scheme}tool/parts/t.obj", "../parts/t.obj", "t.obj"]
    bad = [
        f"{scheme}arms/../t.obj",
        f"{scheme}tool/../meshes/t.obj",
        "../../meshes/t.obj",
        f"{scheme}arms/meshes/link.obj",
    ]
    bad += [
        "file:///etc/t.obj",
        f"{scheme}other/meshes/t.obj",
        f"{scheme}arms/meshes/absent.stl",
        "a\u00a0" * 200 + ".stl",
    ]
    meshes = "".join(visual.format(name) for name in (*good, *bad, f"{scheme}arms/meshes/t.dae"))
    path = written(inner, f"r.{end}", robot.format(meshes=meshes))
    names = [shape["file"] for shape in read(path).raw["bodies"]["a"]["shape"]]
    assert names == ["meshes/t.obj", "source/parts/t.obj", "source/parts/t.obj", "source/urdf/t.obj"]
    assert reasons(path) == [
        f"{len(bad)} in pictures: they are not in the folder or the package of the file",
        "1 in pictures: only STL and OBJ files are drawn",
    ]
    found = faces_of(path)
    assert len(found) == 4 and all(np.allclose(corner_set(faces), corner_set(CORNERS)) for faces in found)
    assert main(["import", str(path), "-o", str(outer / "r.toml"), *(["--floating"] if end == "urdf" else [])]) == 0
    assert main(["draw", str(outer / "r.toml"), "-o", str(tmp_path / "r.svg")]) == 0
    assert len(faces_of(outer / "r.toml")) == 4
    assert main(["import", str(path), "-o", str(inner / "r.toml")]) == 0
    assert [len(faces_of(inner / "r.toml"))] == [1] and "3 in pictures" in capsys.readouterr().out


def test_a_file_that_is_no_package_names_none(tmp_path: Path) -> None:
    written(tmp_path, "parts/t.obj", WAVEFRONT)
    for text in ("<package>", "<package><version>1</version></package>", "<name>arms</name>", ""):
        written(tmp_path, "package.xml", text)
        path = written(tmp_path, "urdf/r.urdf", URDF.format(meshes=_AS_URDF.format("../parts/t.obj")))
        assert reasons(path) == ["1 in pictures: they are not in the folder or the package of the file"], text
    written(tmp_path, "package.xml", "<?xml version='1.0'?>\n<package>\n <name> arms </name></package>")
    assert reasons(path) == []


def test_a_link_whose_looks_cannot_be_drawn_has_those_of_contact(tmp_path: Path) -> None:
    looks = _AS_URDF.format("t.dae") + "<collision><geometry><sphere radius='0.3'/></geometry></collision>"
    shapes = read(written(tmp_path, "r.urdf", URDF.format(meshes=looks))).raw["bodies"]["a"]["shape"]
    assert [shape["type"] for shape in shapes] == ["sphere"]
    bare = looks[looks.index("<collision") :]  # a link without looks is not seen, as in other programs
    assert "shape" not in read(written(tmp_path, "r.urdf", URDF.format(meshes=bare))).raw["bodies"]["a"]


def test_a_body_with_meshes_for_the_eye_does_not_show_what_collides(tmp_path: Path) -> None:
    written(tmp_path, "t.obj", WAVEFRONT)
    geoms = '<geom type="mesh" mesh="t" contype="0" conaffinity="0"/><geom type="box" size="9 9 9"/>'
    eyes = '<geom type="sphere" size="0.1" contype="0" conaffinity="0"/><geom type="box" size="1 1 1"/>'
    bodies = "".join(f'<body name="b{k}"><freejoint/>{x}</body>' for k, x in enumerate((geoms, eyes)))
    asset = '<asset><mesh name="t" file="t.obj"/></asset>'
    path = written(tmp_path, "m.xml", f"<mujoco>{asset}<worldbody>{bodies}</worldbody></mujoco>")
    tables = read(path).raw["bodies"]
    assert [[s["type"] for s in b["shape"]] for b in tables.values()] == [["mesh"], ["sphere", "box"]]


@pytest.mark.parametrize(("end", "robot", "visual", "scheme"), FORMS)
def test_the_ground_has_the_looks_of_links_that_stand_on_it(
    end: str, robot: str, visual: str, scheme: str, tmp_path: Path
) -> None:
    written(tmp_path, "t.obj", WAVEFRONT)
    looks = visual.format("t.obj")
    if end == "urdf":
        text = robot.format(meshes="").replace('<link name="base"/>', f'<link name="base">{looks}</link>')
    else:
        foot = f'<link name="foot">{looks}</link><joint name="f" type="fixed"><parent>world</parent>'
        foot += "<child>foot</child></joint>"
        text = robot.format(meshes="").replace("</model>", f"{foot}</model>")
    path = written(tmp_path, f"r.{end}", text)
    assert read_robot(path, end).raw["mechanism"]["shape"][0]["file"] == "t.obj"
    (faces,) = faces_of(path, "ground")
    assert corner_set(faces) == pytest.approx(corner_set(CORNERS))  # in the ground frame
    for folder, count in ((tmp_path, 1), (tmp_path / "elsewhere", 0)):
        folder.mkdir(exist_ok=True)
        assert main(["import", str(path), "-o", str(folder / "m.toml")]) == 0
        assert len(faces_of(folder / "m.toml", "ground")) == count


def test_the_ground_is_drawn_where_a_body_at_its_origin_is(tmp_path: Path) -> None:
    shape = '[{ type = "box", size = [2.0, 0.4], at = [0.1, 0.2] }, { type = "sphere", radius = 0.5 }]'
    body = "[bodies.b]\nmass = 1.0\ninertia = 1.0\n"
    head = '[mechanism]\nname = "m"\n'
    ground = build_scene(load_mechanism(written(tmp_path, "a.toml", f"{head}shape = {shape}\n{body}"))).items[0]
    own = build_scene(load_mechanism(written(tmp_path, "b.toml", f"{head}{body}shape = {shape}\n"))).items[0]
    assert ground.role == "ground" and {mark.body for mark in ground.marks} == {-1}
    assert [mark.points for mark in ground.marks] == [mark.points for mark in own.marks[:3]]
    with pytest.raises(InputError, match=r"mechanism.shape\[0\].size: expected 2 lengths"):
        load_mechanism(written(tmp_path, "c.toml", f"{head}shape = {shape.replace('0.4', '0.4, 1.0')}\n{body}"))
    with pytest.raises(InputError, match=r"mechanism.shape.file: expected a relative path"):
        spatial = f'{head}space = "spatial"\nshape = {{ type = "mesh", file = "../x.stl" }}\n'
        load_mechanism(
            written(
                tmp_path,
                "d.toml",
                spatial + body.replace("1.0\n", "1.0\n", 1).replace("inertia = 1.0", "inertia = [1.0, 1.0, 1.0]"),
            )
        )


def test_many_meshes_of_mjcf_share_the_triangles_of_a_body(tmp_path: Path) -> None:
    n = 50
    grid = [(x, y, np.sin(0.3 * x) * np.cos(0.2 * y)) for x in range(n) for y in range(n)]
    quads = [(k, k + 1, k + n + 1, k + n) for k in (x * n + y + 1 for x in range(n - 1) for y in range(n - 1))]
    text = "".join("v {} {} {}\n".format(*p) for p in grid) + "".join("f {} {} {} {}\n".format(*q) for q in quads)
    written(tmp_path, "t.obj", text)
    geoms = '<geom type="mesh" mesh="t" mass="1"/>' * 4
    mesh = '<asset><mesh name="t" file="t.obj" inertia="shell"/></asset>'
    body = f'<worldbody><body name="b"><freejoint/>{geoms}</body></worldbody>'
    shapes = faces_of(written(tmp_path, "m.xml", f"<mujoco>{mesh}{body}</mujoco>"))
    assert len(shapes) == 4 and MOST_TRIANGLES / 4 < sum(map(len, shapes)) <= MOST_TRIANGLES
