"""The section ``contacts``: what is wrong in a file is said in one sentence."""

from pathlib import Path

import pytest

import symgen
from symgen.base.errors import InputError

FILE = """
[mechanism]
name = "touch"
gravity = [0.0, -9.81]
[bodies.disc]
mass = 1.0
inertia = 0.01
position = [0.0, 0.2]
[bodies.other]
mass = 1.0
inertia = 0.01
position = [1.0, 0.2]
[contacts.pair]
{}
"""
DISC, LINE = '{ body = "disc", disc = 0.1 }', '{ line = "ground" }'
BETWEEN = f"between = [{DISC}, {LINE}]\n"


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        (f"{BETWEEN}friction = -0.1", "contacts.pair.friction: expected a value of at least 0, got -0.1"),
        (f"{BETWEEN}restitution = 1.2", "contacts.pair.restitution: expected a value from 0 to 1, got 1.2"),
        (
            f"{BETWEEN}friction = {{ sliding = 0.4, static = 0.3 }}",
            "contacts.pair.friction.static: expected a value of at least that of sliding (0.4), got 0.3",
        ),
        (
            f'between = [{DISC}, {{ body = "other", disc = -0.05 }}]',
            "contacts.pair.between[1]: expected a hole larger than its pin, got radii of 0.05 m and 0.1 m",
        ),
        (
            f'between = [{DISC}, {{ body = "disc", disc = 0.2 }}]',
            "contacts.pair.between: expected two different bodies, got 'disc' twice",
        ),
        (
            f'{BETWEEN}gap = "disc.y"',
            "contacts.pair.between: expected shapes, or the key gap or among in their place, got between and gap",
        ),
        (
            "friction = 0.3",
            "contacts.pair.between: expected shapes, or the key gap or among in their place, got none of them",
        ),
        (
            'gap = "disc.y"\nfriction = 0.3',
            "contacts.pair.slip: expected a coordinate along the contact, as it has friction, got no such key",
        ),
        (
            f'between = [{DISC}, {{ body = "ground", segment = [[1.0, 0.0], [1.0, 0.0]] }}]',
            "contacts.pair.between[1].segment: expected a segment with a length above 0, got two equal ends",
        ),
        (
            f'between = [{DISC}, {{ line = "ground", normal = [0.0, 0.0] }}]',
            "contacts.pair.between[1].normal: expected a direction, got a vector of length 0",
        ),
        (
            f'between = [{DISC}, {{ lime = "ground" }}]',
            "contacts.pair.between[1]: expected a shape: disc, line, outline, segment, got the unknown key 'lime'; "
            "did you mean 'line'?",
        ),
        (
            f'between = [{LINE}, {{ line = "other" }}]',
            "contacts.pair.between: expected a disc, or a point, beside another shape, got a line and a line",
        ),
        (
            'gap = "disc.y*disc.y - 0.01"\nslip = "disc.x"\nfriction = 0.3',
            "contacts.pair.friction: expected a gap that is linear in places of bodies, where friction is over its "
            "force, got another one; shapes in 'between' have such a gap",
        ),
        (
            'gap = "disc.y - 2*other.y"\nslip = "disc.x"\nfriction = 0.3',
            "contacts.pair.friction: expected a gap that changes equally with the place of each body, got 1 for 'disc' "
            "and 2 for 'other'",
        ),
        (
            f"{BETWEEN}[contacts.again]\n{BETWEEN}",
            "contacts.again: expected one contact of two shapes, got the shapes of 'pair'",
        ),
    ],
)
def test_bad_contacts(text: str, sentence: str, tmp_path: Path) -> None:
    (tmp_path / "touch.toml").write_text(FILE.replace("{}", text))
    with pytest.raises(InputError) as caught:
        symgen.load(tmp_path / "touch.toml")
    assert sentence in str(caught.value)


SPHERE = '{ body = "disc", sphere = 0.1 }'


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        (
            BETWEEN,
            "contacts.pair.between[1]: expected a shape: sphere, plane, disc, capsule, box, got the unknown key 'line'",
        ),
        (
            f'between = [{SPHERE}, {{ body = "other", capsule = [0.1, 0.3] }}]\nfriction = 0.3',
            "contacts.pair.friction: expected no such key beside a formula, or a capsule beside a sphere, which have "
            "no friction in space, got 0.3",
        ),
        (
            f'between = [{SPHERE}, {{ body = "other", disc = 0.1 }}]',
            "contacts.pair.between: expected a pair of shapes that may touch (box and plane, box and sphere, "
            "capsule and plane, capsule and sphere, disc and plane, sphere and plane, sphere and sphere), "
            "got sphere and disc",
        ),
        (
            f'between = [{SPHERE}, {{ body = "disc" }}]',
            "contacts.pair.between: expected two different bodies, got 'disc' twice",
        ),
        (
            'between = [{ body = "disc", sphere = -0.1 }, { plane = "ground" }]',
            "contacts.pair.between: expected a sphere or a point over a plane, got a hollow sphere of 0.1 m",
        ),
        (
            'between = [{ body = "disc", capsule = [0.1, 0.0] }, { plane = "ground" }]',
            "contacts.pair.between[0].capsule: expected a value above 0, got 0.0",
        ),
        ('gap = "disc.z"\nfriction = 0.3', "contacts.pair.friction: expected no such key"),
    ],
)
def test_bad_contacts_in_space(text: str, sentence: str, tmp_path: Path) -> None:
    file = FILE.replace("{}", text).replace('name = "touch"', 'name = "touch"\nspace = "spatial"')
    file = file.replace("[0.0, -9.81]", "[0.0, 0.0, -9.81]").replace("inertia = 0.01", "inertia = [0.01, 0.01, 0.01]")
    (tmp_path / "touch.toml").write_text(file.replace("0.2]\n", "0.2, 0.0]\n"))
    with pytest.raises(InputError) as caught:
        symgen.load(tmp_path / "touch.toml")
    assert sentence in str(caught.value)


@pytest.mark.slow
def test_a_start_that_penetrates_names_its_depth(tmp_path: Path) -> None:
    path = tmp_path / "deep.toml"
    path.write_text(FILE.replace("{}", BETWEEN).replace("position = [0.0, 0.2]", "position = [0.0, 0.05]"))
    with pytest.raises(InputError, match=r"contact pair: expected a gap of at least 0, got -0\.05 at t = 0 s"):
        symgen.load(path).simulate(until=0.1)


@pytest.mark.parametrize(
    ("kind", "keys", "sentence"),
    [
        ("revolute", "hole = 0.01, pin = 0.012", "joints.pin.clearance: expected a hole larger than its pin"),
        (
            "rigid",
            "hole = 0.012, pin = 0.01",
            "joints.pin.clearance: expected a revolute or translational joint in the plane, got a rigid",
        ),
        (
            "translational",
            "length = 0.1, height = 0.05, gap = 0.0",
            "joints.pin.clearance.gap: expected a value above 0, got 0.0",
        ),
        ("translational", "hole = 0.012, pin = 0.01", "joints.pin.clearance: expected the keys"),
    ],
)
def test_bad_clearances(kind: str, keys: str, sentence: str, tmp_path: Path) -> None:
    text = FILE.replace("{}", BETWEEN) + f'[joints.pin]\ntype = "{kind}"\nbetween = ["disc", "other"]\n'
    text += "axis = [1.0, 0.0]\n" if kind == "translational" else ""
    text += f"at = [[0.0, 0.0], [0.0, 0.0]]\nclearance = {{ {keys} }}\n"
    (tmp_path / "touch.toml").write_text(text)
    with pytest.raises(InputError) as caught:
        symgen.load(tmp_path / "touch.toml")
    assert sentence in str(caught.value)
