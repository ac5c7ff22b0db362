"""Automatic choices: what is chosen for which facts, and the sentences that say why."""

from functools import cache

import pytest
from support.emitted import mechanism_of
from support.models import parallelogram

from benchmarks.pairs import forms_in_common
from benchmarks.stiff import model as stiff_model
from symgen.api import Model, load
from symgen.auto import STIFF_RATIO, Facts, decide, gather, resolve
from symgen.methods import METHODS
from symgen.plan import Settings, make_plan

CALM = Facts(
    rows=8,
    rank=8,
    coordinates=9,
    massless=False,
    fastest_decay=1.0,
    fastest_oscillation=2.0,
    slowest_change=1.0,
)


def facts(**changes):
    from dataclasses import replace

    return replace(CALM, **changes)


@cache
def settled(name, method="auto", integrator="auto"):
    models = {"stiff": stiff_model, "parallelogram": lambda: Model(mechanism_of(parallelogram()))}
    model = models[name]() if name in models else load(name)
    return resolve(model, Settings(method=method, integrator=integrator))


def test_regular_mechanism():
    chosen, reasons = settled("four-bar")
    assert (chosen.method, chosen.integrator) == ("direct-correction", "dop853")
    assert chosen.options == {"method.weight": "mass"}
    assert len(reasons) == 2
    assert "method direct-correction with weight=mass" in reasons[0] and "singular" in reasons[0]
    assert reasons[1].startswith("integrator dop853: the fastest decay")


def test_singular_positions_ahead():
    chosen, _ = settled("n-four-bar:1")
    assert (chosen.method, chosen.integrator) == ("direct-correction", "dop853")
    assert chosen.options["method.weight"] == "mass"


def test_redundant_constraints():
    chosen, reasons = settled("parallelogram")
    assert (chosen.method, chosen.integrator) == ("direct-correction", "dop853")
    assert any("1 of 12 rows depend on others" in r for r in reasons)


def test_stiff_mechanism():
    chosen, reasons = settled("stiff")
    assert (chosen.method, chosen.integrator) == ("direct-correction", "radau5")
    assert any(r.startswith("integrator radau5: the fastest decay") and "times the steps" in r for r in reasons)


def test_only_what_is_asked_for_is_chosen():
    chosen, reasons = settled("four-bar", integrator="rk4")
    assert (chosen.method, chosen.integrator) == ("direct-correction", "rk4")
    assert all(not r.startswith("integrator") for r in reasons)
    chosen, reasons = settled("four-bar", method="baumgarte")
    assert (chosen.method, chosen.integrator, chosen.options) == ("baumgarte", "dop853", {})
    assert all(not r.startswith("method") for r in reasons)


def test_nothing_is_gathered_where_nothing_is_asked():
    asked = Settings(method="lagrange", integrator="rk4")
    assert resolve(load("four-bar"), asked) == (asked, ())


@pytest.mark.parametrize(
    ("changes", "method", "integrator", "word"),
    [
        ({"rows": 0, "rank": 0}, "lagrange", "dop853", "no constraints"),
        ({"massless": True}, "direct-correction", "dop853", "no mass"),
        ({"fastest_decay": 1e6}, "direct-correction", "radau5", "1e+06 1/s"),
        ({"fastest_decay": 1e6, "coordinates": 300}, "direct-correction", "dop853", "too many"),
        ({"rank": 7}, "direct-correction", "dop853", "1 of 8 rows"),
    ],
)
def test_rules(changes, method, integrator, word):
    found = decide(facts(**changes), "auto", "auto")
    assert found[:2] == (method, integrator)
    assert any(word in reason for reason in found[2]), found[2]


@pytest.mark.parametrize("method", METHODS.names)
@pytest.mark.parametrize("decay", [1.0, 1e6])
def test_what_is_chosen_fits(method, decay):
    """Whatever the method asked for, the integrator chosen beside it solves its form."""
    _, integrator, reasons = decide(facts(fastest_decay=decay), method, "auto")
    assert forms_in_common(method, integrator), f"{method} with {integrator}"
    assert reasons and reasons[0].startswith(f"integrator {integrator}: ")
    make_plan(load("pendulum"), Settings(method=method, integrator=integrator))


def test_stiffness_is_relative_to_the_motion():
    assert facts(fastest_decay=1e4, slowest_change=1.0).stiffness > STIFF_RATIO
    assert facts(fastest_decay=1e4, slowest_change=1e3).stiffness < STIFF_RATIO


def test_a_stiff_mechanism_with_a_method_for_explicit_integrators_only():
    _, integrator, (reason,) = decide(facts(fastest_decay=1e6), "null-space", "auto")
    assert integrator == "dop853" and "null-space has no form for implicit integrators" in reason


def test_reasons_are_among_the_notes_of_a_run():
    result = load("four-bar").simulate(method="auto", integrator="auto", until=0.1)
    assert result.ok and result.method == "direct-correction" and result.integrator == "dop853"
    assert any("method direct-correction" in n for n in result.notes)


def test_the_facts_of_the_stiff_case():
    found = gather(stiff_model(), {})
    assert found.rank == found.rows == 10 and found.coordinates == 12
    assert found.fastest_decay == pytest.approx(5.5e4, rel=0.05)  # damping over the reduced mass
