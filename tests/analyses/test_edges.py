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
