"""Automatic choices: what is chosen for which facts, and the sentences that say why."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from support.emitted import mechanism_of
from support.models import parallelogram

from benchmarks.pairs import forms_in_common
from benchmarks.stiff import model as stiff_model
from symgen.api import Model, load
from symgen.base.ir.program import COUNTERS
from symgen.base.settings import Settings
from symgen.derive.methods import METHODS
from symgen.result import points
from symgen.run.compiling.linearised import compile_growth
from symgen.run.layout import abi
from symgen.run.layout.probe import Ready
from symgen.run.planning.automatic import STIFF_RATIO, Facts, automatic_choice, facts_of_plan, linearise_start
from symgen.run.planning.plan import Purpose
from symgen.run.planning.prepare import make_plan, prepare
from symgen.run.starts.assembly import state_scales

CALM = Facts(
    rows=8,
    rank=8,
    coordinates=9,
    massless=False,
    fastest_decay=1.0,
    slowest_change=1.0,
    together=True,
)


def facts(**changes):
    return replace(CALM, **changes)


@cache
def settled(name, method="auto", integrator="auto"):
    models = {"stiff": stiff_model, "parallelogram": lambda: Model(mechanism_of(parallelogram()))}
    model = models[name]() if name in models else load(name)
    plan = make_plan(model.mechanism, Settings(method=method, integrator=integrator))
    return plan.settings, plan.notes


def gathered(mechanism):
    run = prepare(mechanism, Settings(method="lagrange", integrator="dop853"), Purpose.STATE)
    return facts_of_plan(mechanism, run.compiled, run.start, run.spec.until)


@pytest.mark.slow_cases("wiper-dop853-words1")
@pytest.mark.parametrize(
    ("name", "integrator", "words"),
    [
        ("four-bar", "picard", ("method direct-correction with weight=mass", "integrator picard: the fastest decay")),
        ("wiper", "dop853", ()),  # friction compares the speed
        ("n-four-bar:1", "picard", ()),  # singular positions ahead
        ("parallelogram", "picard", ("1 of 12 rows depend on others",)),
        ("stiff", "radau5", ("integrator radau5: the fastest decay", "times the steps")),
    ],
)
def test_mechanisms(name, integrator, words):
    chosen, reasons = settled(name)
    assert (chosen.method, chosen.integrator) == ("direct-correction", integrator)
    assert chosen.options == {"method.weight": "mass"}
    assert all(any(word in reason for reason in reasons) for word in words)


def test_only_what_is_asked_for_is_chosen():
    chosen, reasons = settled("four-bar", integrator="rk4")
    assert (chosen.method, chosen.integrator) == ("direct-correction", "rk4")
    assert all(not r.startswith("integrator") for r in reasons)
    chosen, reasons = settled("four-bar", method="baumgarte")
    assert (chosen.method, chosen.integrator, chosen.options) == ("baumgarte", "picard", {})
    assert all(not r.startswith("method") for r in reasons)


def test_nothing_is_gathered_where_nothing_is_asked():
    asked = Settings(method="lagrange", integrator="rk4")
    plan = make_plan(load("four-bar").mechanism, asked)
    assert (plan.settings, plan.notes) == (asked, ())


@pytest.mark.parametrize(
    ("changes", "method", "integrator", "word"),
    [
        ({"rows": 0, "rank": 0}, "lagrange", "picard", "no constraints"),
        ({"massless": True}, "direct-correction", "picard", "no mass"),
        ({"fastest_decay": 1e6}, "direct-correction", "radau5", "1e+06 1/s"),
        ({"fastest_decay": 1e6, "coordinates": 300}, "direct-correction", "radau5", "1e+06 1/s"),
        ({"coordinates": 300}, "direct-correction", "dop853", "stiffness was not tested"),
        ({"together": False}, "direct-correction", "dop853", "integrator dop853"),
        ({"slow": 0.9}, "direct-correction", "radau5", "converges slowly"),
        ({"rank": 7}, "direct-correction", "picard", "1 of 8 rows"),
    ],
)
def test_rules(changes, method, integrator, word):
    found = automatic_choice(facts(**changes), "auto", "auto")
    assert found[:2] == (method, integrator)
    assert any(word in reason for reason in found[2]), found[2]


@pytest.mark.parametrize("method", METHODS.names)
@pytest.mark.parametrize("decay", [1.0, 1e6])
def test_what_is_chosen_fits(method, decay):
    """Whatever the method asked for, the integrator chosen beside it solves its form."""
    _, integrator, reasons = automatic_choice(facts(fastest_decay=decay), method, "auto")
    assert forms_in_common(method, integrator), f"{method} with {integrator}"
    assert reasons and reasons[0].startswith(f"integrator {integrator}: ")
    make_plan(load("pendulum").mechanism, Settings(method=method, integrator=integrator))


def test_stiffness_is_relative_to_the_motion():
    assert facts(fastest_decay=1e4, slowest_change=1.0).stiffness > STIFF_RATIO
    assert facts(fastest_decay=1e4, slowest_change=1e3).stiffness < STIFF_RATIO


def test_a_stiff_mechanism_with_a_method_for_explicit_integrators_only():
    _, integrator, (reason,) = automatic_choice(facts(fastest_decay=1e6), "null-space", "auto")
    assert integrator == "dop853" and "null-space has no form for implicit integrators" in reason


def test_the_facts_of_the_stiff_case():
    found = gathered(stiff_model().mechanism)
    assert found.rank == found.rows == 10 and found.coordinates == 12
    assert found.fastest_decay == pytest.approx(5.5e4, rel=0.05)  # damping over the reduced mass


@pytest.mark.parametrize("name", ["stiff", "rolling-disc"])
def test_derivatives_of_the_motion_are_those_of_differences(name):
    """Central differences of the emitted right-hand side have half of the digits."""
    mechanism = stiff_model().mechanism if name == "stiff" else load(name).mechanism
    run = prepare(mechanism, Settings(method="lagrange", integrator="dop853"))
    compiled, start = run.compiled, run.start
    found, rate = linearise_start(mechanism, compiled, start), Ready(compiled.law_module.rhs, abi.RHS)
    differences = np.zeros_like(found)
    for j, size in enumerate(state_scales(compiled, start.w, run.spec.until)):
        ends = []
        for sign in (1.0, -1.0):
            y, ydot = start.y.copy(), np.zeros_like(start.y)
            y[j] += sign * 1e-6 * max(size, abs(y[j]))
            ends.append(y[j])
            rate(start.t, y, start.p, start.w.copy(), np.zeros(len(COUNTERS), dtype=np.int64), ydot)
            differences[:, j] += sign * ydot[: len(found)]
        differences[:, j] /= ends[0] - ends[1]
    assert np.abs(found - differences).max() < 1e-8 * np.abs(found).max()


def test_what_cannot_decay_needs_no_derivatives():
    mechanism = load("four-bar").mechanism
    run = prepare(mechanism, Settings(method="lagrange", integrator="dop853"))
    assert compile_growth(mechanism, run.compiled) is None
    assert not linearise_start(mechanism, run.compiled, run.start).any()


# -- the check ---------------------------------------------------------------------------------------------------------


def test_two_runs_agree():
    result = load("four-bar").simulate(method="auto", integrator="auto", until=2.0)
    assert result.status == "ok" and result.rtol == pytest.approx(1e-9) and 0.0 < result.error_estimate < 1e-4
    assert any(note.startswith("verified: a run with rtol = 1e-09 agrees within") for note in result.notes)


@pytest.mark.slow
def test_tolerances_fall_until_two_runs_agree(monkeypatch):
    """What is reported then is as near to an independent reference as the runs are to each other."""
    from symgen.study.references.reference import reference_motion

    model, times = load("four-bar"), np.linspace(0.0, 2.0, 21)
    monkeypatch.setattr(points, "AGREEMENT", 2.5e-11)
    result = model.simulate(method="auto", integrator="auto", until=2.0, times=times)
    assert result.status == "ok" and 1e-13 <= result.rtol < 5e-10
    q, v = result.q.values, result.v.values
    known = reference_motion(model.mechanism, model.parameters(), q[0], v[0], times)
    assert (
        points.Points.of_mechanism(model.mechanism, model.parameters()).largest_distance(q, known.q)
        < 1e-10 + known.estimated_error
    )


def test_runs_that_never_agree_are_unverified(monkeypatch):
    monkeypatch.setattr(points, "AGREEMENT", 0.0)
    result = load("four-bar").simulate(method="auto", integrator="auto", until=1.0)
    assert result.status == "unverified" and result.reason.startswith("two runs still differ by ")


@pytest.mark.parametrize(
    ("changes", "reason"),
    [
        ({"integrator": "auto", "rtol": 1e-3, "atol": 1e-3}, "a run with rtol = 0.0001 differs by "),
        ({"integrator": "rk4", "step": 0.05}, "a run with step = 0.025 s differs by "),
    ],
)
def test_what_was_asked_for_is_kept_and_doubted(changes, reason):
    model = load("four-bar")
    result = model.simulate(method="auto", until=10.0, max_violation=1.0, max_energy_error=1.0, **changes)
    assert result.status == "unverified" and result.reason.startswith(reason)
    assert (result.rtol or result.step) in (changes.get("rtol"), changes.get("step"))


def test_who_chooses_is_not_checked():
    result = load("four-bar").simulate(method="direct-correction", integrator="dop853", rtol=1e-3, atol=1e-3, until=2.0)
    assert result.status == "ok" and not any("verified" in note for note in result.notes)
    assert result.error_estimate is None


def test_integrals_behind_the_work_are_no_velocities():
    """The facts are those of the same mechanism without them."""
    plain = {
        "mechanism": {"name": "swing", "space": "planar", "gravity": [0.0, -9.81]},
        "bodies": {"rod": {"mass": 1.0, "inertia": 1.0 / 12.0, "points": {"top": [0.0, 0.5]}, "angle": 1.0}},
        "joints": {"pin": {"type": "revolute", "between": ["ground", "rod"], "at": [[0.0, 0.0], "top"]}},
    }
    swept = {"swept": {"value": "integral(rod.omega**2)"}, "path": {"value": "integral(abs(rod.omega))"}}
    found = [gathered(mechanism_of(raw)) for raw in (plain, plain | {"outputs": swept})]
    assert replace(found[0], together=False) == found[1]  # an integral of abs has kinks
