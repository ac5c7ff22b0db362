"""Files that fuzzing found: numbers that overflow, starts without a derivative, chains of joints, long files."""

from pathlib import Path

import pytest

import symgen
from symgen.base.errors import AssemblyError, InputError
from verification.running import measured
from verification.running import symgen as command

BODY = "[bodies.b]\nmass = 12.0\ninertia = 1.0\n"
PIN = '[joints.a]\ntype = "revolute"\nbetween = ["ground", "b"]\nat = [[0.0, 0.0], [0.5, 0.0]]\n'
HEAD = '[mechanism]\nname = "found"\n'
OVERFLOWS = {
    "a weight": (HEAD + "gravity = [1e308, 0.0]\n" + BODY + PIN, "bodies.b"),
    "a joint": (
        HEAD
        + BODY
        + PIN
        + '[joints.d]\ntype = "distance"\nbetween = ["ground", "b"]\nat = [[0.0, 9.0], "centre"]\nlength = 1e200\n',
        "joints.d",
    ),
    "a force": (
        HEAD + BODY + PIN + '[forces.f]\ntype = "torque"\nbody = "b"\ntorque = "t*1e200*1e200"\n',
        "forces.f",
    ),
    "a spring": (
        HEAD
        + BODY
        + '[forces.k]\ntype = "spring-damper"\nbetween = ["ground", "b"]\nat = [[0.0, 2.0], "centre"]\n'
        + "stiffness = 1e200\nfree_length = 1e200\n",
        "forces.k",
    ),
}


def written(folder: Path, text: str) -> Path:
    path = folder / "found.toml"
    path.write_text(text, encoding="utf-8")
    return path


@pytest.mark.parametrize(("text", "where"), OVERFLOWS.values(), ids=OVERFLOWS)
def test_numbers_that_overflow_are_refused_where_they_stand(text: str, where: str, tmp_path: Path) -> None:
    """They would have no literal in emitted code."""
    with pytest.raises(InputError, match=f"{where}: expected numbers whose products, sums and quotients are finite"):
        symgen.simulate(written(tmp_path, text), until=0.01, shape="straight")


@pytest.mark.parametrize("verb", ["check", "run", "inspect", "generate"])
def test_every_command_says_so_in_one_sentence(verb: str, tmp_path: Path) -> None:
    words = [verb, written(tmp_path, OVERFLOWS["a weight"][0]), *(["--output", "out"] if verb == "generate" else [])]
    said = command(words, tmp_path)
    assert said.code == 2 and said.sentence, said.err
    assert not (tmp_path / "out").exists()


SPACE = '[mechanism]\nname = "found"\nspace = "spatial"\n[bodies.b]\nmass = 2.0\ninertia = [0.1, 0.1, 0.2]\n'
STARTS = {
    "a disc that lies flat": (
        SPACE
        + 'position = [0.0, 0.0, 0.3]\n[joints.j]\ntype = "rolling-disc"\nbody = "b"\nradius = 0.3\n'
        + "axis = [0.0, 0.0, 1.0]\nnormal = [0.0, 0.0, 1.0]\n",
        "j.normal",
    ),
    "a blade on end": (
        SPACE
        + '[joints.j]\ntype = "knife-edge"\nbody = "b"\naxis = [0.0, 0.0, 1.0]\nat = [0.0, 0.0, 0.0]\n'
        + "normal = [0.0, 0.0, 1.0]\n",
        "j.side",
    ),
    "ends that meet": (
        HEAD
        + '[bodies.b]\ntype = "point"\nmass = 1.0\nposition = [0.0, 0.0]\n[joints.j]\ntype = "distance"\n'
        + 'between = ["ground", "b"]\nat = [[0.0, 0.0], "centre"]\nlength = 1.0\n',
        "j.distance",
    ),
}


@pytest.mark.parametrize("shape", ["straight", "looped"])
@pytest.mark.parametrize(("text", "row"), STARTS.values(), ids=STARTS)
def test_a_start_without_derivative_names_the_joint(text: str, row: str, shape: str, tmp_path: Path) -> None:
    match = f"found: joint 'j' cannot be closed from this start: its row {row} has no derivative there"
    with pytest.raises(AssemblyError, match=match):
        symgen.simulate(written(tmp_path, text), until=0.01, shape=shape)


def test_a_chain_of_joints_ends_in_sentences(tmp_path: Path) -> None:
    chain = "".join(f'[joints.j{i}]\ntype = "driver"\njoint = "j{i + 1}"\nvalue = 0\n' for i in range(3000))
    said = command(["check", written(tmp_path, HEAD + BODY + chain)], tmp_path)
    assert said.code == 2
    *lines, more = said.err.splitlines()
    assert len(lines) == 100 and more.endswith(" more")
    assert all("expected joints that refer to each other in at most" in line for line in lines)


@pytest.mark.by_turns(2)
@pytest.mark.slow
@pytest.mark.parametrize("lines", ["p{0} = {0}.0\n", "[a.a.a.a{0}]\n"], ids=["parameters", "headers"])
def test_long_files_take_little_memory(lines: str, tmp_path: Path) -> None:
    text = HEAD + BODY + "[parameters]\n" + "".join(lines.format(i) for i in range(46_000))
    said = measured(["check", written(tmp_path, text)], tmp_path)
    assert said.code == 2 and said.sentence, said.err
    assert said.memory < 200e6
