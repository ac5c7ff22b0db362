"""Forces without a derivative at a state are told of, by what they are; smooth ones are not, however stiff."""

from __future__ import annotations

import json

import pytest

import symgen
from symgen.api import Model
from symgen.cli import main
from symgen.describe.builder import MechanismBuilder

ROOT, JUMP, KINK = "rises without bound with", "jumps with", "has a kink where"
#: Force along y of a point that springs hold along x, and what has to be told: how, and of what it depends on.
CASES = {
    "-3*sign(a.y)*sqrt(abs(a.y))": (ROOT, "positions"),
    "-3*sqrt(max(0, a.y)) + 3*sqrt(max(0, -a.y))": (ROOT, "positions"),
    "-3*sign(a.y)": (JUMP, "positions"),
    "-3*max(0, a.y)": (KINK, "positions"),
    "3*max(0, -a.y)": (KINK, "positions"),
    "-3*a.y - sign(a.vy)*abs(a.vy)**0.4": (ROOT, "velocities"),
    "-3*a.y - 2*sign(a.vy)": (JUMP, "velocities"),
    "-3*a.y - 2*max(a.vy, 0)": (KINK, "velocities"),
    "1e5*max(0, -a.y)**1.5": None,
    "-3*a.y*abs(a.y)": None,
    "-3*a.y - a.vy*sqrt(a.vx**2 + a.vy**2)": None,
    "-1e9*a.y - 50*tanh(1e4*a.vy)": None,
    "-3*a.y - tanh(1e6*a.y)": None,
    "-3*a.y - sqrt(a.y**2 + 1e-14)": None,
}


@pytest.fixture(scope="module")
def held():
    def model(force: str) -> Model:
        built = MechanismBuilder("held", gravity=(0.0, 0.0)).run(until=1.0).body("a", type="point", mass=1.0)
        return symgen.load(built.force("f", "force", body="a", force=["-2*a.x", force]).build())

    return model


@pytest.mark.parametrize("force", CASES)
def test_forces_without_a_derivative_are_told_of(held, force):
    model, expected = held(force), CASES[force]
    for found in (model.equilibrium(), model.modes(), model.linearise(at="start")):
        assert found.to_dict()["notes"] == list(found.notes)
        if expected is None:
            assert not found.notes
        else:
            (note,) = found.notes
            how, what = expected
            assert f"the force along a.vy {how} {what}" in note


#: Outputs, and what is told of them: of what they depend on, and how.
OUTPUTS = {
    "abs(a.y)": [("a kink", "positions")],
    "max(0, a.vy)": [("a kink", "velocities")],
    "abs(a.ay) + a.x": [("a kink", "positions"), ("a kink", "'push'")],
    "sqrt(abs(a.x))": [("rises without bound", "positions")],
    "sign(push)": [("jumps", "'push'")],
    "a.y**2 + tanh(1e6*a.x) + push": [],
}


@pytest.mark.parametrize("output", OUTPUTS)
def test_outputs_without_a_derivative_are_told_of(output):
    built = MechanismBuilder("held", gravity=(0.0, 0.0)).run(until=1.0).body("a", type="point", mass=1.0)
    built = built.input("push", 0.0).force("f", "force", body="a", force=["-2*a.x", "push - 3*a.y"])
    notes = symgen.load(built.output("seen", output).build()).linearise().notes
    assert len(notes) == len(OUTPUTS[output])
    for note, (how, what) in zip(notes, OUTPUTS[output], strict=True):
        assert "the output 'seen'" in note and how in note and what in note


@pytest.mark.parametrize(("force", "how"), {"max(0, push)": "a kink", "sign(push)*sqrt(abs(push))": "rises"}.items())
def test_forces_without_a_derivative_by_an_input_are_told_of(force, how):
    built = MechanismBuilder("held", gravity=(0.0, 0.0)).run(until=1.0).body("a", type="point", mass=1.0)
    built = built.input("push", 0.0).force("f", "force", body="a", force=["-2*a.x", f"{force} - 3*a.y"])
    model = symgen.load(built.build())
    (note,) = model.linearise().notes
    assert "along a.vy" in note and how in note and "'push'" in note
    assert not model.linearise(inputs={"push": 0.3}).notes


@pytest.mark.parametrize("force", ["-3*sign(a.y)", "-3*a.y - 2*max(a.vy, 0)", "-3*a.y*abs(a.y)", "-3*a.y"])
def test_large_mechanisms_tell_the_same(held, force):
    model = held(force)
    assert model.equilibrium(shape="looped").notes == model.equilibrium().notes
    if force == "-3*a.y":
        assert not model.modes(count=1).notes


@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
@pytest.mark.parametrize("name", ["four-bar", "cart-pole", "spatial-slider-crank", "spherical-double-pendulum"])
def test_smooth_mechanisms_have_nothing_to_tell(name, coordinates):
    assert not symgen.load(name).linearise(at="start", instantaneous=True, coordinates=coordinates).notes


def test_the_command_says_it_beside_the_answer(capsys, tmp_path):
    text = '[mechanism]\nname = "p"\ngravity = [0.0, 0.0]\n[run]\nuntil = 1.0\n[bodies.a]\ntype = "point"\nmass = 1.0\n'
    (tmp_path / "p.toml").write_text(text + '[forces.f]\ntype = "force"\nbody = "a"\nforce = ["-a.x", "-2*abs(a.y)"]\n')
    for command in ("equilibrium", "modes", "linearise"):
        assert main([command, str(tmp_path / "p.toml"), "--json"]) == 0
        out, err = capsys.readouterr()
        assert json.loads(out)
        assert err.startswith("symgen: at this state the force along a.vy has a kink") and err.count("\n") == 1
