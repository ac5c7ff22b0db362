"""A formula without a derivative at a state is named in one sentence; smooth ones are not, however stiff."""

import json

import pytest

import symgen
from symgen.api import Model
from symgen.cli import main
from symgen.describe.files.builder import MechanismBuilder

#: Force along y of a point that springs hold along x, and whether it has a derivative at rest.
CASES = {
    "-3*sign(a.y)*sqrt(abs(a.y))": False,
    "-3*sqrt(max(0, a.y)) + 3*sqrt(max(0, -a.y))": False,
    "-3*sign(a.y)": False,
    "-3*(1 if a.y > 0 else 0)": False,
    "-3*max(0, a.y)": False,
    "3*max(0, -a.y)": False,
    "-3*a.y - sign(a.vy)*abs(a.vy)**0.4": False,
    "-3*a.y - 2*sign(a.vy)": False,
    "-3*a.y - 2*max(a.vy, 0)": False,
    "1e5*max(0, -a.y)**1.5": True,
    "-3*a.y*abs(a.y)": True,
    "-3*a.y - a.vy*abs(a.vy)": True,
    "-1e9*a.y - 50*tanh(1e4*a.vy)": True,
    "-3*a.y - tanh(1e6*a.y)": True,
    "-3*max(a.y, -1) - tanh(1e3*a.y)": True,
    "-3*a.y - sqrt(a.y**2 + 1e-14)": True,
}
SENTENCE = "formulas with a kink or a jump at this state count with the derivative of one side"


def held(force: str, output: str = "", table: bool = False) -> Model:
    """A point that a spring holds along x, with a force along y that may read an input and a table."""
    built = MechanismBuilder("held", gravity=(0.0, 0.0)).run(until=1.0).body("a", type="point", mass=1.0)
    built = built.input("push", 0.0) if output else built
    built = built.table("lines", x=[-1.0, 0.0, 1.0], y=[2.0, 0.0, -3.0], interpolation="linear") if table else built
    built = built.force("f", "force", body="a", force=["-2*a.x", force])
    return symgen.load((built.output("seen", output) if output else built).build())


@pytest.mark.parametrize("force", CASES)
def test_forces_without_a_derivative_are_named(force):
    model = held(force)
    for found in (model.equilibrium(), model.modes(), model.linearise(at="start")):
        assert found.to_dict()["notes"] == list(found.notes)
        assert found.notes == (() if CASES[force] else (f"{SENTENCE}: force 'f'",))


#: Outputs of a point that springs hold, and whether they have a derivative at rest.
OUTPUTS = {
    "abs(a.y)": False,
    "max(0, a.vy)": False,
    "abs(a.ay) + a.x": False,
    "sqrt(abs(a.x))": False,
    "sign(push)": False,
    "a.y**2 + tanh(1e6*a.x) + push": True,
}


@pytest.mark.parametrize("output", OUTPUTS)
def test_outputs_without_a_derivative_are_named(output):
    place, *notes = held("push - 3*a.y", output).linearise().notes
    assert place.startswith("about the stable equilibrium at ")
    assert tuple(notes) == (() if OUTPUTS[output] else (f"{SENTENCE}: output 'seen'",))


@pytest.mark.parametrize("force", ["max(0, push)", "sign(push)*sqrt(abs(push))"])
def test_formulas_without_a_derivative_by_an_input_are_named_together(force):
    model = held(f"{force} - 3*a.y", "abs(push)")
    assert model.linearise().notes[1:] == (f"{SENTENCE}: force 'f', output 'seen'",)
    assert not model.linearise(inputs={"push": 0.3}).notes[1:]


def test_a_table_of_straight_lines_has_kinks_at_its_points():
    assert held("lines(a.y)", table=True).equilibrium().notes == (f"{SENTENCE}: force 'f'",)


@pytest.mark.parametrize("force", ["-3*sign(a.y)", "-3*a.y - 2*max(a.vy, 0)", "-3*a.y*abs(a.y)", "-3*a.y"])
def test_large_mechanisms_name_the_same(force):
    model = held(force)
    assert model.equilibrium(shape="looped").notes == model.equilibrium().notes
    if force == "-3*a.y":
        assert not model.modes(count=1).notes


@pytest.mark.fast("four-bar-absolute", "cart-pole-joint", "spherical-double-pendulum-absolute")
@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
@pytest.mark.parametrize("name", ["four-bar", "cart-pole", "spatial-slider-crank", "spherical-double-pendulum"])
def test_smooth_mechanisms_name_nothing(name, coordinates):
    assert not symgen.load(name).linearise(at="start", instantaneous=True, coordinates=coordinates).notes


def test_the_command_says_it_beside_the_answer(capsys, tmp_path):
    text = '[mechanism]\nname = "p"\ngravity = [0.0, 0.0]\n[run]\nuntil = 1.0\n[bodies.a]\ntype = "point"\nmass = 1.0\n'
    (tmp_path / "p.toml").write_text(text + '[forces.f]\ntype = "force"\nbody = "a"\nforce = ["-a.x", "-2*abs(a.y)"]\n')
    for command in ("equilibrium", "modes", "linearise"):
        assert main([command, str(tmp_path / "p.toml"), "--json"]) == 0
        out, err = capsys.readouterr()
        assert json.loads(out)
        place = "symgen: about the indifferent equilibrium at a.x = 0, a.y = 0\n" if command == "linearise" else ""
        assert err == f"{place}symgen: {SENTENCE}: force 'f'\n"
