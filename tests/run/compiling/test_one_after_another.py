"""Methods of a mechanism that are generated one after the other share what has nothing to do with the method."""

import gc

import pytest

from symgen.api import load
from symgen.derive.formulate import formulate as stage
from symgen.derive.methods import METHODS
from symgen.derive.methods._base import EXPLICIT_FORMS
from symgen.run.compiling import straight
from symgen.run.compiling.method_choice import choose_method
from symgen.run.compiling.pipeline import generate


def choices():
    """Every method as an explicit integrator wants it, and those that implicit ones solve."""
    for name in METHODS.names:
        forms = set(METHODS.get(name).forms)
        yield choose_method(name, None, not forms & EXPLICIT_FORMS)


@pytest.mark.by_turns(3)
@pytest.mark.slow
@pytest.mark.parametrize("target", ["cpu", "cuda"])
@pytest.mark.parametrize("name", ["slider-crank", "spherical-double-pendulum"])
def test_a_method_has_the_code_that_it_has_alone(name, target):
    """Each is lowered on the graph that those before it have grown; alone is: of a mechanism that was read anew."""
    wanted = [c for c in choices() if target == "cpu" or not c.implicit][:: 2 if target == "cpu" else 5]
    alone = {c.stem: generate(load(name).mechanism, (c,), target=target).modules for c in wanted}
    mechanism = load(name).mechanism
    for choice in (*wanted, *wanted[::-1]):
        found = generate(mechanism, (choice,), target=target).modules
        assert found == alone[choice.stem], choice.stem


def test_equations_are_derived_once(monkeypatch):
    derived, original = [], stage.formulate
    monkeypatch.setattr(stage, "formulate", lambda mechanism: derived.append(mechanism.name) or original(mechanism))
    mechanism, other = load("pendulum").mechanism, load("pendulum").mechanism
    for choice in list(choices())[:4]:
        generate(mechanism, (choice,))
    assert derived == ["pendulum"]
    generate(other, (choose_method("lagrange"),))
    generate(other, (choose_method("lagrange"),), target="lanes")
    generate(mechanism, (choose_method("lagrange"),))
    assert derived == ["pendulum"] * 4, "another mechanism, though it is equal, another target, and the first again"


def test_nothing_of_a_mechanism_that_is_gone_is_kept():
    mechanism = load("pendulum").mechanism
    generate(mechanism, (choose_method("lagrange"),))
    assert straight._latest
    del mechanism
    gc.collect()
    assert not straight._latest


def test_what_fails_halfway_is_derived_anew(monkeypatch):
    """A graph on which a method was lowered in part is not given to the next one."""
    from symgen.derive.lower import law

    mechanism, expected = load("pendulum").mechanism, generate(load("pendulum").mechanism, (choose_method("ggl"),))

    def fails(*_):
        raise RuntimeError("halfway")

    generate(mechanism, (choose_method("lagrange"),))
    with monkeypatch.context() as patch, pytest.raises(RuntimeError, match="halfway"):
        patch.setattr(law, "lower_law", fails)
        generate(mechanism, (choose_method("lagrange"),))
    assert not straight._latest
    assert generate(mechanism, (choose_method("ggl"),)).modules == expected.modules
