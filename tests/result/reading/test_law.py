"""Laws as steps: what is read from the tape is what the methods' pages say."""

import itertools

import pytest

import symgen
from symgen.base.errors import InputError
from symgen.derive.methods import METHODS
from symgen.result.reading.law_steps import law_as_steps


def test_the_law_of_direct_correction_is_the_textbooks():
    steps = [str(step) for step in symgen.load("four-bar").equations.law("direct-correction").steps]
    assert steps[:4] == [
        "solve D M^-1 D^T lambda = D M^-1 f - gamma",
        "q' = N v",
        "v' = M^-1 (f - D^T lambda)",
        "W' = P - lambda^T nu",
    ]
    assert steps[-2:] == ["solve D D^T lambda = - r", "delta = D^T lambda"]


def test_options_change_the_steps():
    found = [str(step) for step in law_as_steps("direct-correction", {"weight": "mass"}).steps]
    assert found[-1] == "delta = M^-1 D^T lambda"


def test_bodies_can_be_the_weight_and_drivers_work_without_rows():
    found = [str(step) for step in law_as_steps("direct-correction", {"weight": "body"}, driven=True).steps]
    assert "W' = P + b v' + c - lambda^T nu" in found
    assert found[-2:] == ["solve D (B^T B)^-1 D^T lambda = - r", "delta = (B^T B)^-1 D^T lambda"]
    assert "b v' + c" in str(symgen.load("driven-four-bar").equations_in("joint").law("null-space"))
    assert "b v'" not in str(symgen.load("driven-four-bar").equations.law())


def words(method, driven):
    options = METHODS.get(method, "law").options
    for chosen in itertools.product(*([(o.name, value) for value in o.values] for o in options)):
        yield str(law_as_steps(method, dict(chosen), driven))


@pytest.mark.parametrize("method", METHODS.names)
def test_nothing_is_called_as_the_tape_calls_it(method):
    internal = ("weighted_", "body_entries", "body_inverse", "driving", "at_velocity", "schur")
    for text in (*words(method, False), *words(method, True)):
        assert not [word for word in internal if word in text]
        assert ("b v' + c" in text) == (" b " in text)


def test_baumgarte_has_its_gains():
    assert "gamma - 2 alpha (D v - nu) - beta^2 Phi" in str(law_as_steps("baumgarte"))


@pytest.mark.parametrize("method", METHODS.names)
def test_every_method_has_steps_in_each_form(method):
    found = law_as_steps(method)
    assert found.steps
    assert found.latex().count("=") >= len(found.steps)
    assert found._repr_latex_().startswith("$")
    assert str(found).startswith(method)


def test_an_unknown_method_is_refused():
    with pytest.raises(InputError, match="direct-correction"):
        law_as_steps("direct-corection")
