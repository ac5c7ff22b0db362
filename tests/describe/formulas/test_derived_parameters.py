"""Parameters that are formulas of parameters, against files with the numbers written out."""

import json

import numpy as np
import pytest

from symgen.api import Model, load
from symgen.base.errors import InputError
from symgen.cli import main
from symgen.describe.facts.digest import digest
from symgen.describe.files.builder import MechanismBuilder
from symgen.describe.files.load import load_mechanism
from symgen.describe.formulas.evaluate import evaluation_order, parameter_values
from symgen.describe.formulas.parser import FormulaNames, parse
from symgen.study.ensemble.parameter_sweep import sweep

#: In an order that no formula could be worked out in from the top.
DERIVED = {"inertia": "mass*length**2/12", "mass": "density*length", "density": 1.9, "length": 0.8, "half": "length/2"}
#: What the formulas are for a density and a length, in the same operations.
BY_HAND = {
    "inertia": lambda rho, length: rho * length * length**2 / 12,
    "mass": lambda rho, length: rho * length,
    "density": lambda rho, length: rho,
    "length": lambda rho, length: length,
    "half": lambda rho, length: length / 2,
}
FEW = {"until": 0.1, "step": 0.01, "times": (0.05, 0.1)}


def pendulum(parameters):
    """A rod on a pin."""
    found = MechanismBuilder("derived-rod", gravity=(0.0, -9.81))
    for name, value in parameters.items():
        found.parameter(name, value)
    return (
        found.body("rod", mass="mass", inertia="inertia", points={"top": (0.0, "half")}, angle=0.7)
        .joint("pin", "revolute", between=("ground", "rod"), at=((0.0, 0.0), "top"))
        .build()
    )


def by_hand(density, length):
    """The same with numbers alone."""
    return {name: float(formula(density, length)) for name, formula in BY_HAND.items()}


@pytest.fixture(scope="module")
def model():
    return Model(pendulum(DERIVED))


def test_defaults_are_worked_out_in_any_order(model):
    assert model.parameters() == by_hand(1.9, 0.8)
    assert [p.name for p in model.mechanism.parameters] == list(DERIVED)
    assert [p.value for p in model.mechanism.parameters] == list(by_hand(1.9, 0.8).values())


def test_code_and_digest_are_those_of_plain_parameters(model):
    assert digest(model.mechanism) == digest(pendulum(by_hand(2.0, 1.0)))


def test_derived_ones_follow_and_can_be_set(model):
    assert model.parameters({"length": 1.3}) == by_hand(1.9, 1.3)
    # a number takes the place of a formula, and what depends on it follows
    found = model.parameters({"mass": 5.0, "length": 1.3})
    assert found == {**by_hand(1.9, 1.3), "mass": 5.0, "inertia": 5.0 * 1.3**2 / 12}


def test_a_single_run_is_that_of_the_numbers_written_out(model):
    found = model.simulate(**FEW, parameters={"length": 1.3})
    expected = Model(pendulum(by_hand(1.9, 1.3))).simulate(**FEW)
    assert found.parameters == expected.parameters
    for name in ("q", "v", "kinetic", "potential"):
        np.testing.assert_array_equal(np.asarray(getattr(found, name)), np.asarray(getattr(expected, name)))


@pytest.mark.slow_cases("settled0")
@pytest.mark.parametrize("settled", [{}, {"mass": 1.1}])
def test_rows_of_a_sweep_are_single_runs(model, settled):
    """Two axes, one of them a base of most others; with a derived one that stands for itself."""
    axes = {"length": [0.5, 0.9, 1.7], "density": [1.0, 3.0]}
    found = sweep(model, vary=axes, parameters=settled, quantities=["rod.theta", "rod.omega"], **FEW)
    for i, length in enumerate(axes["length"]):
        for j, density in enumerate(axes["density"]):
            single = model.simulate(**FEW, parameters={"length": length, "density": density, **settled})
            for name, table in (("rod.theta", single.q), ("rod.omega", single.v)):
                np.testing.assert_array_equal(found[name][i, j], table[name])


def test_a_derived_parameter_may_be_an_axis_itself(model):
    found = sweep(model, vary={"mass": [1.0, 2.0], "length": [0.5, 0.9]}, quantities=["rod.theta"], **FEW)
    single = model.simulate(**FEW, parameters={"mass": 2.0, "length": 0.9})
    np.testing.assert_array_equal(found["rod.theta"][1, 1], single.q["rod.theta"])


def test_rows_where_a_formula_is_undefined_fail_alone():
    parameters = {**DERIVED, "mass": "density/(length - 1)**2"}
    found = sweep(Model(pendulum(parameters)), vary={"length": [0.5, 1.0, 2.0]}, quantities=["rod.theta"], **FEW)
    assert np.isfinite(found["rod.theta"][[0, 2]]).all() and np.isnan(found["rod.theta"][1]).all()


def test_the_command_line_follows_too(tmp_path, capsys):
    text = """
[mechanism]
name = "derived-rod"
[parameters]
inertia = { value = "mass*length**2/12", unit = "kg m^2" }
mass = 2.0
length = 0.5
[bodies.rod]
mass = "mass"
inertia = "inertia"
angular_velocity = 1.0
"""
    path = tmp_path / "rod.toml"
    path.write_text(text)
    assert main(["run", str(path), "--set", "length=0.25", "--until", "0.01", "--json"]) == 0
    assert json.loads(capsys.readouterr().out)["parameters"] == {
        "inertia": 2.0 * 0.25**2 / 12,
        "mass": 2.0,
        "length": 0.25,
    }
    assert load_mechanism(path, {"length": 0.25}).parameters[0].value == 2.0 * 0.25**2 / 12
    assert load_mechanism(path, {"inertia": 0.25}).parameters[0].formula is None


@pytest.mark.parametrize(
    ("parameters", "told"),
    [
        ({"a": "b + 1", "b": "2*c", "c": "a - b"}, "got a -> b -> c -> a"),
        ({"x": 1.0, "a": "x*b", "b": "a"}, "got a -> b -> a"),
        ({"a": "sin(a)"}, "parameters.a: expected a formula that does not lead back to its own parameter, got a -> a"),
        ({f"a{i}": f"a{(i + 1) % 20}" for i in range(20)}, "got a0 -> a1 -> a2 -> a3 -> a4 -> a5 -> a6 -> ... -> a0"),
    ],
)
def test_a_circle_is_refused_by_name(parameters, told):
    with pytest.raises(InputError, match=told.replace(".", r"\.").replace("+", r"\+")):
        pendulum({**DERIVED, **parameters})


def test_an_undefined_value_names_the_parameter(model):
    with pytest.raises(InputError, match=r"parameters.mass: expected a finite number, got .* which divides by zero"):
        pendulum({**DERIVED, "mass": "density/(length - 0.8)"})
    other = Model(pendulum({**DERIVED, "mass": "density/(length - 1)**2"}))
    with pytest.raises(InputError, match=r"parameter 'mass': expected a finite number, got .* which divides by zero"):
        other.parameters({"length": 1.0})


def test_long_chains_need_no_deep_calls():
    known = FormulaNames("", {f"a{i}": f"a{i}" for i in range(5001)})
    formulas = {f"a{i}": parse(f"a{i + 1} + 1", known, "") for i in range(5000)} | {"a5000": None}
    assert evaluation_order(formulas, "parameters") == [f"a{i}" for i in range(5000, -1, -1)]


def test_catalogue_parameters_are_numbers_still():
    for name in ("four-bar", "andrews", "stewart-platform"):
        mechanism = load(name).mechanism
        assert all(p.formula is None for p in mechanism.parameters)
        assert parameter_values(mechanism) == {p.name: p.value for p in mechanism.parameters}
