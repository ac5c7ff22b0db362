"""Sets of contacts: any two of some surfaces, beside the same contacts by hand."""

import json
import subprocess
import sys
from itertools import combinations
from pathlib import Path

import pytest

import symgen
from symgen.base.errors import InputError
from tests.run.contacts.scenes import body, head, loaded

#: Walls of a bin, as shapes.
WALLS = (
    '{ line = "ground" }',
    '{ line = "ground", on = [-0.5, 0.0], normal = [1.0, 0.0] }',
    '{ line = "ground", on = [0.5, 0.0], normal = [-1.0, 0.0] }',
)
LAW = "friction = 0.3\nrestitution = 0.1\n"


def discs(count: int) -> str:
    """Return discs over each other, a little aside."""
    places = ((0.01 * (-1) ** i, 0.11 + 0.21 * i) for i in range(count))
    return head("bin") + "".join(body(f"d{i}", 1.0, 0.005, place) for i, place in enumerate(places))


def as_a_set(count: int) -> str:
    """Return the discs in the bin, any two of which may touch."""
    surfaces = [f'{{ body = "d{i}", disc = 0.1 }}' for i in range(count)]
    return f"{discs(count)}[contacts.all]\namong = [{', '.join([*surfaces, *WALLS])}]\n{LAW}"


def by_hand(count: int) -> str:
    """Return the same with each contact written out."""
    surfaces = [(f"d{i}", f'{{ body = "d{i}", disc = 0.1 }}') for i in range(count)]
    surfaces += [(f"ground{i}", wall) for i, wall in enumerate(WALLS, 1)]
    text = discs(count)
    for (one, shape), (other, further) in combinations(surfaces, 2):
        if not one.startswith("ground"):
            text += f"[contacts.all_{one}_{other}]\nbetween = [{shape}, {further}]\n{LAW}"
    return text


@pytest.mark.parametrize("count", [2, 8])
def test_a_set_is_the_same_contacts_by_hand(count: int, tmp_path: Path) -> None:
    """All rows, events and outputs: compiled code is that of one file, and the first result takes as long."""
    own, other = (loaded(text, tmp_path).mechanism for text in (as_a_set(count), by_hand(count)))
    names = dict.fromkeys(row.name for row in own.bounded)
    assert len(names) == count * (count - 1) // 2 + 3 * count
    assert {"all_d0_d1", "all_d0_ground2"} <= set(names)
    assert own.bounded == other.bounded


@pytest.mark.slow
def test_discs_fall_as_by_hand(tmp_path: Path) -> None:
    one, other = (loaded(text, tmp_path).simulate(until=0.3) for text in (as_a_set(3), by_hand(3)))
    assert one.ok and len(one.events) > 1
    assert [(e.t, e.name) for e in one.events] == [(e.t, e.name) for e in other.events]
    assert (one.q.values == other.q.values).all()


def test_check_and_inspect_name_the_contacts(tmp_path: Path) -> None:
    (tmp_path / "bin.toml").write_text(as_a_set(2), encoding="utf-8")

    def answer(*words: str) -> str:
        command = [sys.executable, "-m", "symgen", *words]
        return subprocess.run(command, cwd=tmp_path, check=True, text=True, capture_output=True).stdout

    names = ["all_d0_d1", *(f"all_{d}_ground{i}" for d in ("d0", "d1") for i in (1, 2, 3))]
    assert f"7 contacts: {', '.join(names)}" in answer("check", "bin.toml")
    assert json.loads(answer("check", "bin.toml", "--json"))["contacts"] == names
    shown = symgen.load(tmp_path / "bin.toml").inspect()
    assert all(f"contact {name}: row {name}.normal in force" in str(shown) for name in names)


def test_outlines_and_surfaces_in_space_are_in_sets(tmp_path: Path) -> None:
    boxes = "".join(body(f"b{i}", 1.0, 0.01, (0.0, 0.1 + 0.2 * i)) for i in range(2))
    boxes += "".join(f'[outlines.o{i}]\nbody = "b{i}"\nbox = [0.2, 0.2]\n' for i in range(2))
    text = f'{head("boxes")}{boxes}[contacts.on]\namong = ["o0", "o1", {WALLS[0]}]\n'
    rows = loaded(text, tmp_path).mechanism.bounded
    assert list(dict.fromkeys(row.name for row in rows)) == ["on_o0_o1", "on_o0_ground", "on_o1_ground"]
    balls = '[mechanism]\nname = "balls"\nspace = "spatial"\n'
    for i in range(3):
        balls += f"[bodies.b{i}]\nmass = 1.0\ninertia = [0.1, 0.1, 0.1]\nposition = [0.0, 0.0, {0.1 + 0.3 * i}]\n"
    shapes = [f'{{ body = "b{i}", sphere = 0.1 }}' for i in range(3)]
    balls += f'[contacts.on]\namong = [{", ".join(shapes)}, {{ plane = "ground" }}]\n'
    assert len(loaded(balls, tmp_path).mechanism.bounded) == 6


@pytest.mark.parametrize(
    ("surfaces", "sentence"),
    [
        (", ".join(WALLS), "contacts.all.among: expected surfaces of two bodies or more"),
        ('"d0", "d1"', "contacts.all.among[0]: expected a shape, or the name of an outline, got the body 'd0'"),
        ('{ body = "d0", disc = 0.1 }, { body = "d7" }', "contacts.all.among[1].body: expected the name of a body"),
        ('{ body = "d0", disc = 0.1 }, { body = "d1", radius = 0.1 }', "contacts.all.among[1]: expected a shape"),
        (f'{WALLS[0]}, {{ line = "d0" }}, {{ line = "d1" }}', "contacts.all.among: expected a disc, or a point"),
        ('{ disc = 0.1 }, { body = "d0", disc = 0.1 }', "contacts.all.among[0]: expected a shape"),
    ],
)
def test_sets_that_are_refused(surfaces: str, sentence: str, tmp_path: Path) -> None:
    with pytest.raises(InputError) as refused:
        loaded(f"{discs(2)}[contacts.all]\namong = [{surfaces}]\n", tmp_path)
    assert sentence in str(refused.value) and "\n" not in str(refused.value)


def test_a_name_of_a_set_is_used_once(tmp_path: Path) -> None:
    text = as_a_set(2) + f'[contacts.all_d0_d1]\nbetween = [{{ body = "d0", at = [0.1, 0.0] }}, {WALLS[0]}]\n'
    with pytest.raises(InputError, match=r"contacts\.all_d0_d1: expected a name used once"):
        loaded(text, tmp_path)
