"""What cells of a stress study may cost, what is left out for it, and references that cost less."""

import numpy as np
import pytest

import symgen
from symgen.base.errors import SimulationError
from symgen.base.settings import Settings
from symgen.derive.methods import METHODS
from symgen.run.planning.automatic import AUTO, constant_integrator
from symgen.run.planning.prepare import make_plan
from symgen.study.references import effort, routes
from symgen.study.references.motion import (
    COARSE,
    FINE,
    ROUGH_COARSE,
    ROUGH_FINE,
    CompiledEquations,
    motion_with_estimate,
)
from symgen.study.references.motion import _two_extrapolations as extrapolations
from symgen.study.references.reference import Reference
from symgen.study.references.solvers import STIFF_FOLDINGS, OverBudgetError, fastest_modes, is_stiff
from symgen.study.stress.bench import Base
from symgen.study.stress.cells import CellReference, LimitTask, RunTask, compute_cell
from symgen.study.stress.families import levels_of_family
from symgen.study.stress.study import method_pairs, stress
from tests.study.test_reference import start_of


def plan_of(name, method, integrator, **settings):
    model = symgen.load(name)
    return make_plan(model.mechanism, Settings(method=method, integrator=integrator, **settings)), model.mechanism


# -- budgets -----------------------------------------------------------------------------------------------------------


def test_budgets_fall_with_the_cost_of_an_evaluation():
    small, medium, large = (symgen.load(name).mechanism for name in ("four-bar", "n-four-bar:10", "n-four-bar:20"))
    assert effort.explicit_budget(small) == effort.BUDGET
    ratio = large.body_coordinates / medium.body_coordinates
    assert effort.explicit_budget(medium) / effort.explicit_budget(large) == pytest.approx(ratio, rel=1e-4)
    assert effort.implicit_budget(small) == effort.IMPLICIT_BUDGET
    assert effort.implicit_budget(symgen.load("andrews").mechanism) < effort.IMPLICIT_BUDGET / 8
    assert effort.implicit_budget(large) == effort.LEAST_IMPLICIT


def test_budgets_go_by_what_a_run_evaluates():
    explicit, mechanism = plan_of("four-bar", "lagrange", "dop853")
    implicit, _ = plan_of("four-bar", "ggl", "radau5")
    constant, _ = plan_of("four-bar", "lagrange", "rk4")
    assert effort.evaluation_budget(explicit, mechanism) == effort.ADAPTIVE_BUDGET
    assert effort.evaluation_budget(constant, mechanism) == effort.BUDGET
    assert effort.evaluation_budget(implicit, mechanism) == effort.IMPLICIT_BUDGET
    searched = [effort.evaluation_budget(plan, mechanism, searched=True) for plan in (constant, implicit)]
    assert searched == [effort.BUDGET // effort.SEARCHED, effort.IMPLICIT_BUDGET]
    dry, bounded = plan_of("dry-four-bar", "lagrange", "rk4")
    assert effort.evaluation_budget(dry, bounded) == effort.BUDGET // effort.BOUNDED


def test_runs_of_a_quick_study_have_less():
    plans = [plan_of("four-bar", "lagrange", name) for name in ("rk4", "dop853")]
    for searched, part in ((False, 1), (True, effort.SEARCHED)):
        budgets = {effort.evaluation_budget(plan, mechanism, searched, quick=True) for plan, mechanism in plans}
        assert budgets == {most // part for most in effort.explicit_limits(quick=True)} == {effort.QUICK_BUDGET // part}
    for name, most in (("four-bar", effort.IMPLICIT_BUDGET), ("chain:20", effort.QUICK_LEAST_IMPLICIT)):
        assert effort.evaluation_budget(*plan_of(name, "ggl", "radau5"), quick=True) == most
    plan, andrews = plan_of("andrews", "ggl", "radau5")
    share = (effort.implicit_budget(andrews) / effort.IMPLICIT_BUDGET) ** (effort.QUICK_IMPLICIT_FALL / 3.0)
    assert effort.evaluation_budget(plan, andrews, quick=True) == pytest.approx(
        share * effort.IMPLICIT_BUDGET, rel=1e-3
    )
    chain, large = (plan_of(name, "lagrange", "rk4") for name in ("chain:4", "n-four-bar:40"))
    share = effort.SMALL / chain[1].body_coordinates
    assert effort.evaluation_budget(*chain, quick=True) == int(effort.QUICK_BUDGET * share**effort.QUICK_FALL)
    assert effort.evaluation_budget(*large, quick=True) == effort.QUICK_BUDGET * effort.QUICK_LEAST


def test_runs_with_bounds_end_in_a_quick_study_where_their_modes_change_at_every_step():
    """A run that follows the motion of a belt takes a third more evaluations than steps without events."""
    most = effort.QUICK_BUDGET // effort.QUICK_BOUNDED
    short, dry = plan_of("dry-four-bar", "lagrange", "rk4", step=1e-3, until=1.0)
    assert effort.evaluation_budget(short, dry, quick=True) == effort.EVENTFUL * 4 * 1000 < most
    assert effort.evaluation_budget(short, dry) == effort.BUDGET // effort.BOUNDED
    for integrator, until in (("rk4", 100.0), ("dop853", 1.0)):
        plan, _ = plan_of("dry-four-bar", "lagrange", integrator, until=until)
        assert effort.evaluation_budget(plan, dry, quick=True) == most


def test_the_smallest_step_takes_all_evaluations():
    plan, _ = plan_of("four-bar", "lagrange", "rk4", step=1e-3, until=2.0)
    least = effort.smallest_step(plan, 80_000)
    assert least == pytest.approx(1e-4)
    finest, _ = plan_of("four-bar", "lagrange", "rk4", step=least, until=2.0)
    assert effort.least_evaluations(finest, 0.0) == pytest.approx(80_000)


def test_a_run_off_its_constraints_does_not_go_on_for_ever():
    assert effort.further_budget(5_000_000, 79) == effort.LEAST_FURTHER
    assert effort.further_budget(5_000_000, 20_000) == 2_000_000
    assert effort.further_budget(3_000, 79) == 3_000
    assert effort.further_budget(100_000, 20_000, quick=True, done=0.1) == 100_000
    assert effort.further_budget(100_000, 20_000, quick=True, done=1e-3) == effort.QUICK_FURTHER
    assert effort.further_budget(100_000, 20_000, done=1e-3) == 100_000


def test_what_is_predicted():
    constant, _ = plan_of("four-bar", "lagrange", "rk4", step=1e-3, until=2.0)
    assert effort.least_evaluations(constant, 1e12) == pytest.approx(4 * 2000)
    adaptive, _ = plan_of("four-bar", "lagrange", "dop853", until=2.0)
    assert effort.least_evaluations(adaptive, 1e6) == pytest.approx(1e6 * 2.0 / 6.39 * 12 / effort.HOPELESS)
    implicit, _ = plan_of("four-bar", "ggl", "radau5", until=2.0)
    assert effort.least_evaluations(implicit, 1e12) == 0.0


@pytest.mark.slow
def test_a_prediction_is_below_what_a_run_takes():
    """A damper that decays fast, yet can be integrated: the prediction must not stop a run that could be made."""
    level = levels_of_family("damping", Base.of_mechanism("four-bar"), False)[2]
    known = compute_cell(CellReference(level))
    assert known["decay"] > 1e4
    found = compute_cell(RunTask(level, "lagrange", "dop853", known))
    plan, _ = plan_of("four-bar", "lagrange", "dop853", until=level.until)
    assert found["outcome"] == "ok"
    assert 0.1 * found["evaluations"] < effort.least_evaluations(plan, known["decay"]) < found["evaluations"]


def test_a_run_without_a_chance_is_not_begun(monkeypatch):
    level = levels_of_family("damping", Base.of_mechanism("four-bar"), False)[4]
    known = {"unusable": None, "estimated_error": 0.0, "decay": 1e9, "length": 1.0, "parameters": {}}
    monkeypatch.setattr("symgen.run.planning.prepare.code_and_start", None)
    found = compute_cell(RunTask(level, "lagrange", "dop853", known))
    assert found["outcome"] == "too slow" and found["reason"].startswith("at least 1.25e+09 evaluations, more than")


def test_cells_without_a_reference_are_not_run(monkeypatch):
    monkeypatch.setattr("symgen.run.planning.prepare.code_and_start", None)
    level = levels_of_family("gravity", Base.of_mechanism("pendulum"), True)[0]
    for known, why in (
        ({"unusable": "none at hand"}, "none at hand"),
        ({"unusable": None, "estimated_error": 0.02, "length": 1.0}, "the two reference runs differ by 0.02 m"),
    ):
        found = compute_cell(RunTask(level, "lagrange", "rk4", known))
        assert (found["outcome"], found["status"], found["reason"]) == ("unjudged", "not run", why)
        assert compute_cell(LimitTask(level, "lagrange", "rk4", known))["stable_step"] is None


# -- what is compiled --------------------------------------------------------------------------------------------------


def test_pairs_without_a_looped_shape():
    assert effort.needs_straight("null-space", "rk4") and effort.needs_straight("coordinate-partitioning", "dop853")
    assert not effort.needs_straight("lagrange", "dop853") and not effort.needs_straight("lagrange", "radau5")
    assert not effort.needs_straight(AUTO, AUTO)


def test_pairs_are_left_out_when_the_time_of_compilation_is_used_up():
    mechanism, other = symgen.load("four-bar").mechanism, symgen.load("driven-four-bar").mechanism
    each = effort.straight_seconds(mechanism)
    asked = [pair for name in METHODS.names for pair in method_pairs(name)]
    straight = {pair for pair in asked if effort.needs_straight(*pair)}
    out = effort.pairs_left_out([mechanism, other], asked, 1.5 * each)
    kept = straight - {x[1:3] for x in out if x[0] == "four-bar"}
    assert len({method for method, _ in kept}) == 1 < len(kept), "explicit integrators share the code of a method"
    assert all((method, constant_integrator(method)) in kept for method, _ in kept), "own integrators first"
    assert {x[1:3] for x in out if x[0] == "driven-four-bar"} == straight
    assert out[0][3] == f"its code does not fit into the {1.5 * each:g} s of compilation"
    assert not effort.pairs_left_out([mechanism, other], asked, 100.0 * each)
    enough = effort.pairs_left_out([mechanism, other], asked, (len({name for name, _ in straight}) + 0.5) * each)
    assert {x[0] for x in enough} == {"driven-four-bar"}, "the base comes first"


@pytest.mark.slow
def test_what_is_left_out_is_listed_and_not_run():
    study = stress(["pendulum"], ["gravity"], ["lagrange", "null-space"], quick=False, compilation=0.3)
    run = {("lagrange", name) for name in ("rk4", "dop853", "picard", "radau5")}
    assert {(row.method, row.integrator) for row in study.rows} == run
    listed = study.to_json()["left_out"]
    assert [(x["mechanism"], x["method"], x["integrator"]) for x in listed] == [
        ("pendulum-stressed", "null-space", name) for name in ("rk4", "dop853", "picard")
    ]


# -- references --------------------------------------------------------------------------------------------------------


def equations_of(name, **changes):
    mechanism = Base.of_mechanism(name).stressed
    model = symgen.load(mechanism)
    return CompiledEquations(mechanism, model.parameters(changes)), *start_of(model, model.parameters(changes))


@pytest.mark.slow
def test_what_conserves_energy_is_not_stiff_however_long_it_lasts():
    """Its modes decay and grow in pairs: the slider-crank's fastest is 16 1/s, which over 2000 s is 3e4 e-foldings."""
    equations, q, v = equations_of("slider-crank")
    y = equations.nearest_state(0.0, np.concatenate([q, v]))
    assert fastest_modes(equations, y)[0] * 2000.0 > STIFF_FOLDINGS
    assert not is_stiff(equations, y, 2000.0)
    damped, q, v = equations_of("slider-crank", stress_damping=1e8)
    assert is_stiff(damped, damped.nearest_state(0.0, np.concatenate([q, v])), 1.0)


@pytest.mark.slow
def test_compiled_rates_are_those_of_numpy():
    equations, q, v = equations_of("slider-crank", stress_stiffness=100.0)
    y = equations.nearest_state(0.0, np.concatenate([q, v + 0.1]))
    expected = super(CompiledEquations, equations).rate(0.0, y)
    np.testing.assert_allclose(equations.rate(0.0, y), expected, rtol=1e-9, atol=1e-9)


@pytest.mark.slow
def test_a_reference_over_its_budget_says_so(monkeypatch):
    monkeypatch.setattr("symgen.study.references.motion.BUDGET", 100)
    equations, q, v = equations_of("slider-crank")
    with pytest.raises(OverBudgetError, match="takes more than 100 evaluations"):
        motion_with_estimate(equations, q, v, np.linspace(0.0, 1.0, 5))
    monkeypatch.setattr("symgen.study.references.motion.STIFF_BUDGET", 100)
    monkeypatch.setattr("symgen.study.references.motion.is_stiff", lambda equations, y, until: True)
    with pytest.raises(OverBudgetError, match="takes more than 100 evaluations"):
        motion_with_estimate(equations, q, v, np.linspace(0.0, 1.0, 5))


@pytest.mark.parametrize("attained", [1e-13, 1e-11])
def test_a_tolerance_that_rounding_does_not_allow_is_given_up_after_some_evaluations(monkeypatch, attained):
    """Evaluations go with the power 1 / 15 of the tolerance, and are as many as are allowed below what is attained."""
    spent = []

    def integrated(equations, y, times, rtol, every, scale, most):
        used = 1000 * (1e-9 / rtol) ** (1 / 15) if rtol > attained else np.inf
        spent.append(min(used, most))
        if used > most:
            raise OverBudgetError("too many")
        return np.array([rtol, every]), used

    monkeypatch.setattr("symgen.study.references.motion._integrate_by_extrapolation", integrated)
    budget = type("Equations", (), {"budget": 1_000_000})
    tolerances, fine, coarse = extrapolations(budget, None, None, None)
    assert [fine.tolist(), coarse.tolist()] == [[tolerances[0], 1], [tolerances[1], 2]]
    assert tolerances == (ROUGH_FINE, ROUGH_COARSE)
    assert sum(spent) < 12_000


def test_the_tightest_tolerances_are_taken_where_rounding_allows_them(monkeypatch):
    def integrated(equations, y, times, rtol, every, scale, most):
        return rtol, 1000

    monkeypatch.setattr("symgen.study.references.motion._integrate_by_extrapolation", integrated)
    assert extrapolations(type("Equations", (), {"budget": 1}), None, None, None) == ((FINE, COARSE), FINE, COARSE)


@pytest.mark.slow
def test_a_stiff_spring_does_not_use_up_the_budget_of_a_reference(monkeypatch):
    """Its motion, at the tightest tolerance, took 551,000 evaluations in vain."""
    level = levels_of_family("stiffness", Base.of_mechanism("jansen-leg"), True)[1]
    counters, run = [], CompiledEquations.advance

    def advance(self, *arguments):
        counters.append(arguments[-2])
        return run(self, *arguments)

    monkeypatch.setattr(CompiledEquations, "advance", advance)
    found = compute_cell(CellReference(level))
    assert found["estimated_error"] < 1e-9
    assert sum({id(used): int(used[0]) for used in counters}.values()) < 60_000


@pytest.mark.slow
def test_two_formulations_take_over_beyond_the_budget(monkeypatch):
    level = levels_of_family("gravity", Base.of_mechanism("slider-crank"), False)[1]
    best = compute_cell(CellReference(level))
    monkeypatch.setattr("symgen.study.references.motion.BUDGET", 100)
    found = compute_cell(CellReference(level))
    assert best["how"].startswith("independently derived") and found["how"].startswith("direct-correction with dop853")
    np.testing.assert_allclose(found["q"], best["q"], atol=1e-9)
    longer = levels_of_family("duration", Base.of_mechanism("slider-crank"), False)[1]
    monkeypatch.setattr(routes, "BUDGET", 100)  # a run is stopped some time after that, the slower one at least
    failed = compute_cell(CellReference(longer))
    assert failed["unusable"].startswith("the reference takes more than 100 evaluations; the reference by ")
    assert "does not come to" in failed["unusable"]


def sinking():
    """A spatial point mass that sinks against a strong damper: v = m g / c along the damper, in closed form."""
    builder = symgen.MechanismBuilder("sinking-in-space", space="spatial", gravity=(0.0, 0.0, -9.81))
    builder.parameter("c", 1e8)
    builder.body("bob", type="point", mass=2.0, position=(0.0, 0.0, -1.0), velocity=(0.0, 0.0, 0.0))
    builder.joint("guide", "distance", between=("ground", "bob"), at=((1e6, 0.0, -1.0), "centre"), length=1e6)
    builder.force("damper", "spring-damper", between=("ground", "bob"), at=((0.0, 0.0, 0.0), "centre"), damping="c")
    return symgen.load(builder.build())


def test_stiff_motions_in_space_have_a_reference():
    model = sinking()
    times = np.linspace(0.0, 1.0, 5)
    found = routes.motion_by_two_routes(model.mechanism, {"c": 1e8}, times, decay=1e8 / 2.0)
    assert found.how.startswith("direct-correction with radau5") and found.estimated_error < 1e-9
    np.testing.assert_allclose(found.q[:, 2], -1.0 - 2.0 * 9.81 / 1e8 * times, rtol=0.0, atol=1e-9)


def tried(monkeypatch, done, **how):
    """Return the attempts of two formulations, and the error or the failure; `done` has the errors of some attempts."""
    attempts, mechanism = [], sinking().mechanism
    q = np.array([[0.0, 0.0, -1.0], [0.0, 0.0, -2.0]])

    def by_routes(mechanism, common, attempt):
        attempts.append((attempt.routes[0].rtol, attempt.shape))
        if attempts[-1] not in done:
            raise SimulationError(f"not {attempts[-1]}")
        return Reference("", done[attempts[-1]], np.zeros(2), q, q)

    monkeypatch.setattr(routes, "_motion_by_routes", by_routes)
    try:
        reference = routes.motion_by_two_routes(mechanism, {"c": 1.0}, np.array([0.0, 1.0]), **how)
    except SimulationError as failure:
        return attempts, str(failure)
    return attempts, reference.estimated_error


TIGHT, ROUGH = (1e-12, "looped"), (1e-9, "looped")
LONG_TIGHT, LONG_ROUGH = (1e-12, "straight"), (1e-9, "straight")


def test_rough_tolerances_do_instead_of_a_long_integration(monkeypatch):
    assert tried(monkeypatch, {TIGHT: 1e-14}, enough=1e-5) == ([TIGHT], 1e-14)
    assert tried(monkeypatch, {ROUGH: 1e-9}, enough=1e-5) == ([TIGHT, ROUGH], 1e-9)
    assert tried(monkeypatch, {ROUGH: 1.0, LONG_ROUGH: 1e-7}, enough=1e-5)[1] == 1e-7
    everything = [TIGHT, ROUGH, LONG_ROUGH, LONG_TIGHT]
    assert tried(monkeypatch, {ROUGH: 1.0, LONG_ROUGH: 1.0, LONG_TIGHT: 0.1}, enough=1e-5) == (everything, 0.1)
    assert tried(monkeypatch, {ROUGH: 1.0}, enough=1e-5) == (everything, 1.0)
    assert tried(monkeypatch, {}, enough=1e-5) == (everything, f"not {LONG_TIGHT}")


def test_a_comparison_has_the_tightest_tolerances_that_can_be_attained(monkeypatch):
    assert tried(monkeypatch, {ROUGH: 1e-9, LONG_TIGHT: 1e-13, LONG_ROUGH: 1e-9}) == ([TIGHT, LONG_TIGHT], 1e-13)
    assert tried(monkeypatch, {LONG_ROUGH: 1e-9}) == ([TIGHT, LONG_TIGHT, LONG_ROUGH], 1e-9)


def test_long_references_of_a_quick_study_are_rough_or_implicit(monkeypatch):
    assert tried(monkeypatch, {ROUGH: 0.1}, enough=1e-5, quick=True) == ([TIGHT, ROUGH], 0.1)
    assert tried(monkeypatch, {}, enough=1e-5, quick=True) == ([TIGHT, ROUGH, LONG_ROUGH], f"not {LONG_ROUGH}")
    stiff, implicit = {"decay": 2.0 * routes.LOOPED_BUDGET}, (1e-10, "looped")
    assert tried(monkeypatch, {implicit: 1e-9}, enough=1e-5, quick=True, **stiff) == ([implicit], 1e-9)
    assert tried(monkeypatch, {TIGHT: 1e-14}, enough=1e-5, quick=True, **stiff) == ([implicit, TIGHT], 1e-14)
    assert tried(monkeypatch, {TIGHT: 1e-14}, enough=1e-5, **stiff)[0] == [TIGHT]


def test_code_of_dense_matrices_is_left_out_of_a_quick_look_at_a_large_mechanism_in_space():
    pair = [("null-space", "rk4")]
    for name, seconds in (("stewart-platform", 7.0), ("spherical-double-pendulum", 0.8), ("n-four-bar:10", 1.1)):
        out = effort.pairs_left_out([symgen.load(name).mechanism], pair, seconds)
        assert bool(out) is (name == "stewart-platform")


def test_implicit_references_end_with_the_size():
    with pytest.raises(SimulationError, match="fastest decay, 1e\\+12 1/s, needs implicit steps"):
        routes.motion_by_two_routes(symgen.load("stewart-platform").mechanism, {}, np.linspace(0.0, 1.0, 3), decay=1e12)
