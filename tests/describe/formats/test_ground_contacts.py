"""Contacts of robots with the ground: the same tables from URDF, MJCF and SDF, motions beside closed forms."""

import json
import math
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from symgen.api import Model
from symgen.describe.files.validate import validate
from symgen.describe.formats import Import
from tests.describe.formats.test_sdf import imported

INERTIA = "".join(f"<{key}>{x}</{key}>" for key, x in (("ixx", 0.1), ("iyy", 0.2), ("izz", 0.3)))
#: Shapes by a name: place, turn about x, and the geometry in URDF (SDF), in MJCF, and what is read of both.
SHAPES: dict[str, tuple[str, float, dict[str, Any], str, dict[str, Any]]] = {
    "ball": ("0.1 0 0", 0.0, {"sphere": {"radius": 0.2}}, 'type="sphere" size="0.2"', {"sphere": 0.2}),
    "pill": (
        "0 0.1 0",
        math.pi / 2,
        {"capsule": {"radius": 0.05, "length": 0.3}},
        'type="capsule" size="0.05 0.15"',
        {"capsule": [0.05, 0.3], "axis": [0.0, -1.0, 0.0]},
    ),
    "brick": (
        "0 0 0.1",
        math.pi / 2,
        {"box": {"size": "0.1 0.2 0.4"}},
        'type="box" size="0.05 0.1 0.2"',
        {"box": [0.1, 0.4, 0.2]},
    ),
}


def of_urdf(name: str, geometry: dict[str, Any], place: str, turn: float, friction: float) -> str:
    """Return a body with one shape of collision."""
    tag, sizes = next(iter(geometry.items()))
    shape = f"<{tag} " + " ".join(f'{key}="{x}"' for key, x in sizes.items()) + "/>"
    return (
        f'<robot name="one"><link name="{name}"><inertial><mass value="2"/><inertia ixx="0.1" iyy="0.2" izz="0.3"/>'
        f'</inertial><collision><origin xyz="{place}" rpy="{turn} 0 0"/><geometry>{shape}</geometry></collision></link>'
        f'<gazebo reference="{name}"><mu1>{friction}</mu1></gazebo></robot>'
    )


def of_sdf(name: str, geometry: dict[str, Any], place: str, turn: float, friction: float) -> str:
    """Return the body in SDF, above the plane of another model."""
    tag, sizes = next(iter(geometry.items()))
    shape = f"<{tag}>" + "".join(f"<{key}>{x}</{key}>" for key, x in sizes.items()) + f"</{tag}>"
    surface = f"<surface><friction><ode><mu>{friction}</mu></ode></friction></surface>"
    return (
        f'<sdf version="1.9"><world name="w"><model name="one"><link name="{name}"><inertial><mass>2</mass><inertia>'
        f'{INERTIA}</inertia></inertial><collision name="c"><pose>{place} {turn} 0 0</pose><geometry>{shape}</geometry>'
        f'{surface}</collision></link></model><model name="floor"><static>true</static><link name="slab">'
        '<collision name="c"><pose>0 0 -1 0 0 0</pose><geometry><plane><normal>0 0 1</normal></plane></geometry>'
        "</collision></link></model></world></sdf>"
    )


def of_mjcf(name: str, geometry: str, place: str, turn: float, friction: float) -> str:
    """Return the body in MJCF, above a plane with less friction."""
    geom = f'<geom {geometry} pos="{place}" euler="{turn} 0 0" friction="{friction}"/>'
    return (
        '<mujoco model="one"><compiler angle="radian"/><worldbody><geom type="plane" size="1 1 1" pos="0 0 -1" '
        f'friction="0.1"/><body name="{name}"><freejoint/><inertial pos="0 0 0" mass="2" diaginertia="0.1 0.2 0.3"/>'
        f"{geom}</body></worldbody></mujoco>"
    )


def contacts(read: Import) -> dict[str, Any]:
    """Return the contacts of a file, which is valid."""
    validate(read.raw, "imported")
    tables: dict[str, Any] = read.raw["contacts"]
    return tables


@pytest.mark.parametrize("shape", SHAPES)
def test_three_formats_say_one_shape(shape: str, tmp_path: Path) -> None:
    place, turn, geometry, in_mjcf, expected = SHAPES[shape]
    at = {"at": [float(x) for x in place.split()]}
    texts = {
        "one.urdf": of_urdf("base", geometry, place, turn, 0.4),
        "one.sdf": of_sdf("base", geometry, place, turn, 0.4),
        "one.xml": of_mjcf("base", in_mjcf, place, turn, 0.4),
    }
    for name, text in texts.items():
        floating = {"floating": True} if name.endswith("urdf") else {}
        ((own, table),) = contacts(imported(tmp_path, text, name, contacts=True, **floating)).items()
        body, plane = table["between"]
        assert own.startswith(body["body"]) and table["friction"] == 0.4 and "restitution" not in table
        assert body.keys() == {"body", *at, *expected}
        for key, value in (at | expected).items():
            assert body[key] == pytest.approx(value), (name, key)
        height = plane["on"][2]
        assert plane["normal"] == [0.0, 0.0, 1.0]
        lowest = {"ball": -0.2, "pill": -0.05, "brick": 0.0}[shape]
        assert height == pytest.approx(lowest if name.endswith("urdf") else -1.0)
        (without,) = (x for x in imported(tmp_path, text, name, **floating).left_out if x.what == "contacts")
        assert "--contacts ground" in without.why and without.moves


def test_a_turned_box_has_its_corners_and_wheels_their_rims(tmp_path: Path) -> None:
    box = contacts(imported(tmp_path, of_urdf("b", {"box": {"size": "2 2 2"}}, "0 0 0", 0.5, 0.3), floating=True,
                            name="b.urdf", contacts=True))  # fmt: skip
    corners = np.array([table["between"][0]["at"] for table in box.values()])
    assert len(box) == 8 and np.allclose(np.linalg.norm(corners, axis=1), math.sqrt(3.0))
    wheel = {"cylinder": {"radius": 0.1, "length": 0.04}}
    rims = contacts(imported(tmp_path, of_urdf("w", wheel, "0 0 0", math.pi / 2, 0.3), "w.urdf", floating=True,
                             contacts=True))  # fmt: skip
    assert {table["between"][0]["at"][1] for table in rims.values()} == {-0.02, 0.02}
    assert all(table["between"][0]["disc"] == 0.1 for table in rims.values())
    flat = imported(tmp_path, of_urdf("w", wheel, "0 0 0", 0.1, 0.3), "f.urdf", floating=True, contacts=True)
    assert "contacts" not in flat.raw
    assert [str(x) for x in flat.left_out if "contacts" in x.what] == [
        "contacts of a cylinder (w): it stands on its face, and rims of wheels touch alone"
    ]


def test_friction_of_a_pair_is_that_of_the_format(tmp_path: Path) -> None:
    """MuJoCo takes the larger one, that of the higher priority, or none where neither has two directions."""
    text = of_mjcf("base", SHAPES["ball"][3], "0 0 0", 0.0, 0.05)
    for keys, mu in (("", 0.1), ('priority="1"', 0.05), ('condim="1"', 0.1), ('condim="1" priority="1"', 0.0)):
        own = text.replace('<geom type="sphere"', f'<geom {keys} type="sphere"')
        (table,) = contacts(imported(tmp_path, own, "one.xml", contacts=True)).values()
        assert table.get("friction", 0.0) == mu, keys
    apart = text.replace('<geom type="sphere"', '<geom contype="2" conaffinity="2" type="sphere"')
    assert "contacts" not in imported(tmp_path, apart, "one.xml", contacts=True).raw
    bounced = of_sdf("base", SHAPES["ball"][2], "0 0 0", 0.0, 0.4)
    bounced = bounced.replace(
        "<surface>", "<surface><bounce><restitution_coefficient>0.5</restitution_coefficient></bounce>"
    )
    (table,) = contacts(imported(tmp_path, bounced, contacts=True)).values()
    assert table["restitution"] == 0.5


def test_what_stands_on_the_floor_is_listed(tmp_path: Path) -> None:
    slab = '<collision name="c"><pose>0 0 -1'
    step = '<collision name="d"><geometry><box><size>1 1 1</size></box></geometry></collision>'
    sdf = of_sdf("base", SHAPES["ball"][2], "0 0 0", 0.0, 0.4).replace(slab, step + slab)
    plane = '<geom type="plane" size="1 1 1" pos="0 0 -1"'
    mjcf = of_mjcf("base", SHAPES["ball"][3], "0 0 0", 0.0, 0.4).replace(plane, f"{plane}/><geom {SHAPES['brick'][3]}")
    for text, kind in ((sdf, "sdf"), (mjcf, "xml")):
        read = imported(tmp_path, text, f"step.{kind}", contacts=True)
        (listed,) = (x for x in read.left_out if x.what == "shapes of the ground")
        assert (listed.where, listed.moves) == ("box", True)
        assert [two["plane"] for _, two in (x["between"] for x in contacts(read).values())] == ["ground"]


@pytest.mark.slow
@pytest.mark.parametrize("kind", ["urdf", "sdf", "xml"])
def test_a_ball_of_a_robot_falls_and_slides_as_its_law_says(kind: str, tmp_path: Path) -> None:
    geometry = SHAPES["ball"][2]
    text = {
        "urdf": of_urdf("base", geometry, "0 0 0", 0.0, 0.4),
        "sdf": of_sdf("base", geometry, "0 0 0", 0.0, 0.4).replace("0 0 -1 0 0 0", "0 0 -0.2 0 0 0"),
        "xml": of_mjcf("base", SHAPES["ball"][3], "0 0 0", 0.0, 0.4).replace("0 0 -1", "0 0 -0.2"),
    }[kind]
    options = {"floating": True} if kind == "urdf" else {}
    read = imported(tmp_path, text, f"ball.{kind}", contacts=True, **options)
    (body,), g = read.raw["bodies"], -read.raw["mechanism"]["gravity"][2]
    read.raw["bodies"][body]["velocity"] = [1.0, 0.0, 0.0]
    run = Model(validate(read.raw, "ball")).simulate(until=0.1, rtol=1e-12)
    assert run.status == "ok"
    assert run[f"{body}.x"][-1] == pytest.approx(0.1 - 0.5 * 0.4 * g * 0.01, abs=1e-9)
    assert run[f"{body}.wy"][-1] == pytest.approx(0.4 * 2.0 * g * 0.2 / 0.2 * 0.1, abs=1e-9)


def test_the_command_writes_contacts(tmp_path: Path) -> None:
    (tmp_path / "one.urdf").write_text(of_urdf("base", SHAPES["ball"][2], "0 0 0", 0.0, 0.4), encoding="utf-8")
    command = [sys.executable, "-m", "symgen", "import", "one.urdf", "--floating"]
    done = subprocess.run(
        [*command, "--contacts", "ground", "-o", "one.toml"], cwd=tmp_path, text=True, capture_output=True
    )
    assert done.returncode == 0 and "contacts" not in done.stdout, done.stderr
    assert "[contacts.base_contact]" in (tmp_path / "one.toml").read_text(encoding="utf-8")
    listed = subprocess.run([*command, "--json"], cwd=tmp_path, text=True, capture_output=True)
    assert [x["what"] for x in json.loads(listed.stdout)["left_out"]] == ["<gazebo>", "contacts"]
    wrong = subprocess.run([*command, "--contacts", "all"], cwd=tmp_path, text=True, capture_output=True)
    assert wrong.returncode == 2 and "ground" in wrong.stderr
