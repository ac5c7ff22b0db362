"""Meshes in pictures: a cube of triangles against the box shape, simplified meshes, and files that are none."""

import os
import pickle
import struct
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from symgen.base.errors import InputError
from symgen.cli import main
from symgen.describe.drawing.mechanism_scene import build_scene, convex_hull
from symgen.describe.drawing.meshes import LARGEST, MOST_TRIANGLES, simplify_triangles
from symgen.describe.drawing.paper import Path as Stroke
from symgen.describe.drawing.paper import items_on_paper
from symgen.describe.drawing.scene import Solid
from symgen.describe.facts.digest import digest, mechanism_digest
from symgen.describe.files.load import load_mechanism

QUADS = ((0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5))
CORNERS = [(x, y, z) for z in (-0.5, 0.5) for y in (-0.5, 0.5) for x in (-0.5, 0.5)]
CUBE = np.array([[CORNERS[k] for k in t] for a, b, c, d in QUADS for t in ((a, b, c), (a, c, d))])


def binary(triangles: Any) -> bytes:
    body = b"".join(struct.pack("<12fH", 0, 0, 0, *np.ravel(t), 0) for t in triangles)
    return bytes(80) + struct.pack("<I", len(triangles)) + body


def text(triangles: Any) -> bytes:
    lines = ["solid cube"]
    for t in triangles:
        lines += ["facet normal 0 0 0", "outer loop", *(f"vertex {x} {y} {z}" for x, y, z in t), "endloop", "endfacet"]
    return "\n".join([*lines, "endsolid cube"]).encode()


def wavefront(_: Any) -> bytes:
    lines = [f"v {x} {y} {z}" for x, y, z in CORNERS] + ["vn 0 0 1"]
    return "\n".join([*lines, *("f " + " ".join(f"{k - 8}//1" for k in q) for q in QUADS)]).encode()


def written(folder: Path, shape: str) -> Path:
    path = folder / "m.toml"
    path.write_text(
        '[mechanism]\nname = "m"\nspace = "spatial"\n[bodies.b]\nmass = 1.0\ninertia = [1.0, 1.0, 1.0]\n'
        f"centre_of_mass = [0.5, 0.0, 0.0]\nshape = {{ {shape} }}\n"
    )
    return path


def silhouette(path: Path) -> np.ndarray:
    scene = build_scene(load_mechanism(path))
    item = items_on_paper(scene, np.array([0.1, 0.2, 0.3, 0.8, 0.1, -0.5, 0.3]))[0]
    points = np.vstack([part.points for part in item.parts if isinstance(part, Stroke) and len(part.points) in (3, 4)])
    corners = points[convex_hull(points.round(9))]
    return corners


@pytest.mark.parametrize(("end", "write"), [("stl", binary), ("STL", text), ("obj", wavefront)])
def test_a_cube_has_the_silhouette_of_a_box(end: str, write: Any, tmp_path: Path) -> None:
    (tmp_path / "parts").mkdir()
    (tmp_path / "parts" / f"cube.{end}").write_bytes(write(CUBE))
    box = load_mechanism(written(tmp_path, 'type = "box", size = [2.0, 0.4, 0.6], at = [0.1, 0.2, 0.3]'))
    wanted = silhouette(tmp_path / "m.toml")
    # the cube's x axis is the body's y axis, and its first factor mirrors it
    turn = "orientation = { rotation_vector = [0.0, 0.0, 1.5707963267948966] }, scale = [-0.4, 2.0, 0.6]"
    mesh = load_mechanism(written(tmp_path, f'type = "mesh", file = "parts/cube.{end}", at = [0.1, 0.2, 0.3], {turn}'))
    assert silhouette(tmp_path / "m.toml") == pytest.approx(wanted, abs=1e-6)
    assert digest(box) == digest(mesh) and mechanism_digest(box) == mechanism_digest(mesh)
    solid = build_scene(mesh).items[0].marks[0]
    assert isinstance(solid, Solid) and len(solid.faces) == 12
    faces = np.array(solid.faces)
    outwards = np.cross(faces[:, 1] - faces[:, 0], faces[:, 2] - faces[:, 1])
    assert np.all(np.sum(outwards * (faces.mean(axis=1) - faces.mean(axis=(0, 1))), axis=1) > 0.0)


def ball(n: int) -> np.ndarray:
    a, b = np.meshgrid(np.linspace(0.0, 2.0 * np.pi, n), np.linspace(0.0, np.pi, n))
    grid = np.stack([np.sin(b) * np.cos(a), np.sin(b) * np.sin(a), np.cos(b)], axis=-1)
    p, q, r, s = grid[:-1, :-1], grid[1:, :-1], grid[1:, 1:], grid[:-1, 1:]
    return np.concatenate(
        [np.stack([p, q, r], axis=2).reshape(-1, 3, 3), np.stack([p, r, s], axis=2).reshape(-1, 3, 3)]
    )


def test_many_triangles_become_few() -> None:
    few = simplify_triangles(ball(120), MOST_TRIANGLES)
    assert MOST_TRIANGLES / 4 < len(few) <= MOST_TRIANGLES
    assert np.linalg.norm(few, axis=2) == pytest.approx(np.ones(few.shape[:2]), abs=0.05)
    # the volume by the divergence theorem, which holes would change
    assert np.sum(np.linalg.det(few)) / 6.0 == pytest.approx(4.0 / 3.0 * np.pi, rel=0.03)


def test_all_meshes_of_a_body_share_its_triangles(tmp_path: Path) -> None:
    (tmp_path / "ball.stl").write_bytes(binary(ball(60)))
    one = '{ type = "mesh", file = "ball.stl" }'
    path = written(tmp_path, one[2:-2])
    path.write_text(path.read_text().replace(one, f"[{one}, {one}]"))
    solids = [mark for mark in build_scene(load_mechanism(path)).items[0].marks if isinstance(mark, Solid)]
    assert len(solids) == 2 and 500 < sum(len(solid.faces) for solid in solids) <= MOST_TRIANGLES


HOSTILE = {
    "truncated": (binary(CUBE)[:-7], "breaks off"),
    "no head": (b"\0" * 20, "breaks off"),
    "absurd count": (bytes(80) + b"\xff\xff\xff\xff" + bytes(50), "breaks off: 134 bytes for 4294967295 triangles"),
    "truncated text": (text(CUBE)[:-200], "breaks off"),
    "no numbers": (text(CUBE).replace(b"0.5", b"half"), "three numbers"),
    "nan": (binary([[(float("nan"), 0, 0), (1, 0, 0), (0, 1, 0)]]), "finite"),
    "nan text": (text(CUBE).replace(b"-0.5", b"nan"), "finite"),
    "far": (binary([[(1e30, 0, 0), (1, 0, 0), (0, 1, 0)]]), "finite coordinates of at most 1e+09"),
    "empty": (binary([]), "a mesh with triangles"),
    "large": (b"\0" * (LARGEST + 1), f"at most {LARGEST} bytes"),
}


@pytest.mark.parametrize("name", HOSTILE)
def test_a_file_that_is_no_mesh_is_refused(name: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    content, sentence = HOSTILE[name]
    (tmp_path / "x.stl").write_bytes(content)
    path = written(tmp_path, 'type = "mesh", file = "x.stl"')
    assert main(["draw", str(path), "-o", str(tmp_path / "m.svg")]) == 2
    words = capsys.readouterr().err
    assert sentence in words and "bodies.b.shape, file 'x.stl'" in words and len(words.strip().splitlines()) <= 2


@pytest.mark.parametrize(
    "content", [b"f 1 2 3\n", b"v 0 0 0\nf 1 1 9\n", b"v 0 0 0\nf 1 1 x\n", b"v 0 0\nf 1 1 1\n", b""]
)
def test_an_obj_file_with_other_words_is_refused(content: bytes, tmp_path: Path) -> None:
    (tmp_path / "x.obj").write_bytes(content)
    with pytest.raises(InputError, match=r"file 'x.obj'"):
        build_scene(load_mechanism(written(tmp_path, 'type = "mesh", file = "x.obj"')))


@pytest.mark.parametrize(
    "file", ["../x.stl", "a/../../x.stl", "/etc/x.stl", "x.dae", "c:/x.stl", "..\\\\x.stl", "", "a\\u0000.stl"]
)
def test_a_path_out_of_the_folder_is_refused(file: str, tmp_path: Path) -> None:
    (tmp_path / "in").mkdir()
    (tmp_path / "x.stl").write_bytes(binary(CUBE))
    with pytest.raises(InputError, match=r"shape.file: expected a relative path .* folder of the mechanism file"):
        load_mechanism(written(tmp_path / "in", f'type = "mesh", file = "{file}"'))


def test_a_link_out_of_the_folder_is_no_file(tmp_path: Path) -> None:
    (tmp_path / "in").mkdir()
    (tmp_path / "x.stl").write_bytes(binary(CUBE))
    os.symlink(tmp_path / "x.stl", tmp_path / "in" / "y.stl")
    for name in ("y.stl", "absent.stl"):
        mechanism = load_mechanism(
            written(tmp_path / "in", f'type = "mesh", file = "{name}"')
        )  # read where it is drawn
        with pytest.raises(InputError, match="expected a file in the folder of the mechanism file, got none there"):
            build_scene(mechanism)


URDF = """<robot name="r"><link name="a"><inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1"/></inertial>
<visual><origin xyz="1 0 0" rpy="0 0 1.5"/><geometry><mesh filename="package://r/parts/c.stl" scale="2 -1 1"/>
</geometry></visual><visual><geometry><mesh filename="../out.stl"/></geometry></visual></link><link name="base"/>
<joint name="j" type="floating"><parent link="base"/><child link="a"/></joint></robot>"""
SDF = """<sdf version="1.9"><model name="r"><link name="a"><visual name="v"><pose>1 0 0 0 0 1.5</pose><geometry><mesh>
<uri>model://r/parts/c.stl</uri><scale>2 -1 1</scale></mesh></geometry></visual><visual name="w"><geometry><mesh>
<uri>../out.stl</uri></mesh></geometry></visual></link></model></sdf>"""


@pytest.mark.parametrize(("end", "robot"), [("urdf", URDF), ("sdf", SDF)])
def test_a_robot_is_drawn_with_its_meshes(
    end: str, robot: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    inner = tmp_path / "in"
    (inner / "parts").mkdir(parents=True)
    (inner / "parts" / "c.stl").write_bytes(binary(CUBE))
    (tmp_path / "out.stl").write_bytes(binary(CUBE))
    path = inner / f"r.{end}"
    path.write_text(robot + "\n")
    text_of = {}
    for where in (inner, tmp_path, inner / "parts", tmp_path / "elsewhere"):
        where.mkdir(exist_ok=True)
        assert main(["import", str(path), "--floating", "-o", str(where / "m.toml")]) == 0
        text_of[where] = (where / "m.toml").read_text()
        assert main(["draw", str(where / "m.toml"), "-o", str(where / "m.svg")]) == 0
    out = capsys.readouterr().out
    assert "left out: meshes (1 in pictures): they are not in the folder or the package of the file" in out
    assert out.count("left out: meshes (1 in pictures): their files are not in the folder of m.toml") == 1
    for where, name in ((inner, "parts/c.stl"), (tmp_path, "in/parts/c.stl"), (inner / "parts", "c.stl")):
        assert f'file = "{name}"' in text_of[where]
    assert "c.stl" not in text_of[tmp_path / "elsewhere"]
    faces = np.array(next(m for m in build_scene(load_mechanism(path)).items[0].marks if isinstance(m, Solid)).faces)
    c, s = np.cos(1.5), np.sin(1.5)
    wanted = CUBE.reshape(-1, 3) * [2.0, -1.0, 1.0] @ np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]]).T
    wanted += [1.0, 0.0, 0.0]
    assert {tuple(p) for p in faces.reshape(-1, 3).round(6) + 0.0} == {tuple(p) for p in wanted.round(6) + 0.0}


@pytest.mark.slow
def test_a_page_has_the_triangles_and_a_pickle_the_folder(tmp_path: Path) -> None:
    (tmp_path / "c.stl").write_bytes(binary(CUBE))
    path = written(tmp_path, 'type = "mesh", file = "c.stl"')
    sent = pickle.loads(pickle.dumps(load_mechanism(path)))
    assert len(build_scene(sent).items[0].marks) == len(build_scene(load_mechanism(path)).items[0].marks)
    assert main(["view", str(path), "--until", "0.1", "-o", str(tmp_path / "m.html")]) == 0
    page = (tmp_path / "m.html").read_text()
    assert page.count("[0.5,0.5,0.5") + page.count("0.5,0.5,0.5]") > 3 and str(tmp_path) not in page
