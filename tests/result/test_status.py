"""What a run may claim, and what it must say."""

import re
from dataclasses import replace

import numpy as np
import pytest
from support.emitted import mechanism_of
from support.models import parallelogram

import symgen
from symgen.base.settings import Settings
from symgen.result.judge import JUMP_DOUBT, JUMP_FAILURE, judge
from symgen.result.points import Points
from symgen.result.reruns.verification import verify_run
from symgen.run.planning.prepare import prepare
from symgen.run.single.outcome import RankEvent
from symgen.study.references.reference import reference_motion
from symgen.study.stress.bench import Base
from symgen.study.stress.families import singular_passage


def outcome_of(model, method="direct-correction", verify=False, **changes):
    """An honest run with some of what its loop saw replaced, as `judge` takes it."""
    run = prepare(model.mechanism, Settings(method=method, integrator="rk4", until=0.05, verify=verify))
    return run, replace(run.integrate(), **changes)


def judged(run, outcome):
    """The verdict, with a second run where the settings ask for it."""
    return judge(run, outcome, verify_run(run, outcome)[2] if run.plan.settings.verify else None)


@pytest.fixture(scope="module")
def four_bar():
    return symgen.load("four-bar")


PASSAGE = {
    "rank_events": (RankEvent(0.01, 0.02, 8, 3e-9),),
    "rank_event_count": 1,
    "smallest_pivot": 3e-9,
    "energy_scale": 10.0,
}


def test_a_plain_run_is_ok(four_bar):
    verdict = judged(*outcome_of(four_bar))
    assert (verdict.status, verdict.reason, verdict.warnings) == ("ok", None, ())


def test_a_corrected_run_past_a_singular_position_is_ok_with_a_warning(four_bar):
    verdict = judged(*outcome_of(four_bar, **PASSAGE))
    assert verdict.status == "ok"
    assert verdict.warnings == (
        "passed near a singular position at t = 0.01 s: smallest pivot 3e-09; "
        "the error there is not controlled by the step size",
    )


@pytest.mark.parametrize("method", ["lagrange", "baumgarte"])
def test_an_uncorrected_one_is_unverified(four_bar, method):
    verdict = judged(*outcome_of(four_bar, method, **PASSAGE))
    assert verdict.status == "unverified"
    assert "t = 0.01 s: smallest pivot 3e-09" in verdict.reason
    assert verdict.warnings


def test_a_small_pivot_without_event_counts_too(four_bar):
    verdict = judged(*outcome_of(four_bar, "lagrange", smallest_pivot=5e-5))
    assert verdict.status == "unverified"


@pytest.mark.parametrize(
    ("share", "status", "reason"),
    [
        (JUMP_DOUBT / 2, "ok", None),
        (
            JUMP_DOUBT * 2,
            "unverified",
            "energy jumped by 0.0002 J, 2e-05 of the energy in motion, over a passage near a",
        ),
        (JUMP_FAILURE * 2, "failed", "energy jumped by 0.02 J, 0.002 of the energy in motion, over a passage near a"),
    ],
)
def test_energy_jumps_over_a_passage(four_bar, share, status, reason):
    verdict = judged(*outcome_of(four_bar, **PASSAGE, energy_jump=share * 10.0))
    assert (verdict.status, len(verdict.warnings)) == (status, 1)
    assert verdict.reason == (reason and f"{reason} singular position")


CONSTANT = {"integrator": "rk4", "step": 1e-3}


@pytest.mark.slow_cases("0.001-settings0-failed")
@pytest.mark.parametrize(
    ("gap", "settings", "status"),
    [
        (1e-3, {"method": "direct-correction", **CONSTANT}, "failed"),  # on the other branch
        (1e-2, {"method": "direct-correction", **CONSTANT}, "unverified"),  # off by 5 mm
        (1e-2, {"method": "direct-correction", "integrator": "rk4", "step": 2.5e-4}, "ok"),
        (1e-2, {"method": "direct-correction", **CONSTANT, "verify": True}, "unverified"),
        (1e-4, {"method": "penalty", "integrator": "dop853"}, "unverified"),  # off by 8 mm: joints give
        (1e-4, {"method": "direct-correction", "integrator": "dop853", "verify": False}, "ok"),
        (1e-4, {"method": "lagrange", "integrator": "picard", "verify": False}, "ok"),
    ],
)
def test_runs_that_are_wrong_behind_a_passage_are_not_ok(gap, settings, status):
    """A parallelogram that misses its flat position by a gap: its pivot stays above what counts as near-singular."""
    level = singular_passage(Base.of_mechanism("four-bar"), gap)
    result = symgen.load(level.mechanism).simulate(until=level.until, parameters=level.parameters, **settings)
    assert result.status == status and result.rank_event_count == 0


@pytest.mark.slow_cases("jansen-leg", "wiper")
@pytest.mark.parametrize("model", ["four-bar", "wiper", "jansen-leg"])
def test_coarse_runs_in_regular_positions_have_no_passage(model):
    run = prepare(symgen.load(model).mechanism, Settings(method="generalized-alpha", until=2.0))
    outcome = run.integrate()
    assert outcome.energy_drift_max > 1e-5 * outcome.energy_scale and outcome.energy_jump == 0.0
    assert judge(run, outcome).status == "ok"


def test_light_bodies_are_said(four_bar):
    run, outcome = outcome_of(four_bar)
    counters = {**outcome.counters, "light": 7}
    verdict = judged(run, replace(outcome, counters=counters))
    assert verdict.status == "ok"
    assert "light bodies made D M^-1 D^T ill-conditioned in 7 evaluations" in verdict.warnings[0]


def test_a_second_run_that_agrees_settles_it(four_bar):
    verdict = judged(*outcome_of(four_bar, "lagrange", verify=True, **PASSAGE))
    assert verdict.status == "ok" and verdict.reason is None
    assert "verified: a run with step = 0.0005 s agrees within" in verdict.notes[0]


@pytest.mark.parametrize("seen", [PASSAGE, {}])
def test_a_second_run_that_differs_does_not(four_bar, seen):
    run, outcome = outcome_of(four_bar, verify=True, **seen)
    shift = np.zeros(outcome.states.shape[1])
    shift[3] = 1e-3  # the coupler, by a millimetre
    wrong = replace(outcome, states=outcome.states + shift)
    verdict = judged(run, wrong)
    assert verdict.status == "unverified"
    assert verdict.reason == "a run with step = 0.0005 s differs by 0.001 m in a motion of 0.0025 m"


#: A rod on a pin with a stiff spring under its middle, which falls by twice its weight over the stiffness.
HELD = {
    "mechanism": {"name": "held", "gravity": [0.0, -9.81]},
    "bodies": {"rod": {"mass": 2.0, "inertia": 8.0 / 3.0, "position": [2.0, 0.0], "points": {"A": [-2.0, 0.0]}}},
    "joints": {"pin": {"type": "revolute", "between": ["ground", "rod"], "at": [[0.0, 0.0], "A"]}},
    "forces": {"spring": {"type": "force", "body": "rod", "force": [0.0, "-1e8*rod.y"]}},
}


@pytest.mark.parametrize(
    ("settings", "step"),
    [
        ({"method": "lagrange", "integrator": "rk4", "step": 1e-4}, 5e-5),
        ({"method": "generalized-alpha", "step": 1e-3}, 5e-4),
        ({"method": "rattle", "step": 1e-4}, 5e-5),
    ],
)
def test_two_runs_of_a_small_motion_agree_by_its_range(settings, step):
    """Motions of 1e-6 m on 2 m that differ by as much were taken for one: they are below 1e-4 of the size."""
    model = symgen.load(mechanism_of(HELD))
    run = model.simulate(**settings, until=0.05, verify=True, coordinates="absolute")
    assert run.status == "unverified"
    assert re.match(rf"a run with step = {step:g} s differs by \S+e-07 m in a motion of [78]\.?\d*e-07 m", run.reason)
    fine = model.simulate(method="lagrange", integrator="rk4", step=1e-5, until=0.05, verify=True)
    assert fine.status == "ok" and fine.error_estimate < 1e-10


@pytest.mark.parametrize("share", [1e-9, 1e-6, 1e-5, 3e-4, 1e-2, 1.0])
def test_constraints_that_are_open_by_a_part_of_a_small_motion_are_said(share):
    settings = Settings("lagrange", "rk4", step=1e-5, until=0.05, coordinates="absolute")
    run = prepare(mechanism_of(HELD), settings)
    outcome = run.integrate()
    moved = 7.85e-7  # the tip falls by four times the weight over the stiffness
    verdict = judge(run, replace(outcome, position_violation_max=share * moved))
    assert verdict.status == ("unverified" if share > 1e-4 else "ok")
    assert verdict.status == "ok" or verdict.reason.startswith("constraints are open by ")


# -- the error -----------------------------------------------------------------------------------------------------


def error_of(model, result):
    """The distance from SciPy's solution of independently derived equations."""
    q, v = result.q.values, result.v.values
    known = reference_motion(model.mechanism, model.parameters(), q[0], v[0], result.t)
    return Points.of_mechanism(model.mechanism, model.parameters()).largest_distance(q, known.q)


@pytest.mark.by_turns(3)
@pytest.mark.slow_cases("changes3", "changes0", "changes1", "changes2", "changes5")
@pytest.mark.parametrize(
    "changes",
    [
        {"integrator": "rk4", "step": 0.02},
        {"integrator": "heun", "step": 2e-3},
        {"integrator": "euler", "step": 1e-4, "max_energy_error": 1.0},
        {"method": "baumgarte", "integrator": "trapezoidal", "step": 1e-3, "max_violation": 1.0},
        {"integrator": "dopri5", "rtol": 1e-6, "atol": 1e-8},
        {"method": "auto", "integrator": "rk4", "step": 0.02},
    ],
)
def test_the_estimated_error_is_about_the_error(four_bar, changes):
    result = four_bar.simulate(until=1.0, output_step=0.1, verify=True, **changes)
    actual = error_of(four_bar, result)
    assert 0.3 * actual < result.error_estimate < 3.0 * actual
    assert result.to_json()["error_estimate"] == result.error_estimate
    assert f"error about {result.error_estimate:.2g} m, from a run with " in repr(result)
    assert "error about" in result._repr_html_()


def test_an_error_that_nothing_estimates_is_said(four_bar):
    result = four_bar.simulate(integrator="rk4", until=0.05)
    assert result.ok and result.error_estimate is None and result.to_json()["error_estimate"] is None
    said = "ok (error not estimated: `verify` runs again with half the step)"
    assert said in repr(result) and said in result._repr_html_()
    adaptive = repr(four_bar.simulate(until=0.05, integrator="dopri5", verify=False))
    assert (
        "ok (local errors within rtol 1e-08; global error not estimated as verify is off: `verify` runs again"
        in adaptive
    )


def test_a_wrong_motion_within_all_watches_is_unverified_where_it_is_verified(four_bar):
    asked = {"integrator": "rk4", "step": 0.05, "until": 10.0, "max_energy_error": 1.0}
    assert four_bar.simulate(**asked).ok
    result = four_bar.simulate(**asked, verify=True)
    assert result.status == "unverified" and result.reason.startswith("a run with step = 0.025 s differs by ")
    assert result.error_estimate > 1e-3


def test_a_failed_run_is_not_verified(four_bar):
    result = four_bar.simulate(method="lagrange", integrator="rk4", step=0.2, until=10.0, verify=True)
    assert result.status == "failed" and result.error_estimate is None
    assert "error not estimated" not in repr(result)


@pytest.mark.slow
def test_uncorrected_runs_through_singular_positions_never_end_ok():
    model = symgen.load("n-four-bar:1")
    for method in ("lagrange", "baumgarte"):
        for step in (0.95e-3, 1e-3, 1.05e-3):
            result = model.simulate(method=method, integrator="rk4", step=step, until=4.0)
            assert result.status in ("failed", "unverified"), (method, step)
            assert result.reason and result.warnings


@pytest.mark.slow
def test_a_corrected_run_through_singular_positions_warns():
    result = symgen.simulate("n-four-bar:1", until=4.0)
    assert result.status == "ok"
    assert result.rank_event_count == len(result.rank_events) > 0
    assert any("passed near a singular position" in w for w in result.warnings)


def test_a_failure_has_reason_and_time():
    result = symgen.simulate("four-bar", method="lagrange", integrator="rk4", step=0.2, until=10.0)
    assert result.status == "failed"
    assert " at t = " in result.reason
    assert len(result.t) and np.all(np.isfinite(result.q.values[0]))


# -- interruption ------------------------------------------------------------------------------------------------------


def test_an_interrupted_run_keeps_what_was_computed():
    def progress(reached):
        raise KeyboardInterrupt

    result = symgen.load("four-bar").simulate(until=50_000.0, output_step=1.0, progress=progress)
    assert result.interrupted and result.status == "failed" and result.reason == "interrupted"
    assert 0 < len(result.t) < 50_001
    assert result.reactions.values.shape[0] == len(result.t)
    assert result.to_json()["final"]["t"] == result.t[-1]


# -- redundant constraints ---------------------------------------------------------------------------------------------


def test_redundant_constraints_give_multipliers_of_minimum_norm():
    result = symgen.load(mechanism_of(parallelogram())).simulate(until=0.3, output_step=0.1)
    assert result.ok, result.reason
    assert result.rank.rows == 12 and result.rank.rank == 11
    assert any("1 constraint row depends on the others" in note for note in result.notes)
    assert any("reactions are not unique at" in note for note in result.notes)
    assert set(result.non_unique_reactions) == {f"{end}{i}" for end in "AB" for i in range(3)}
    # the bar's own balance holds whatever the split: weight and inertia are carried by the three heads
    total = sum(result.reactions[f"B{i}.Fy"] for i in range(3))
    assert np.allclose(2.0 * result["bar.ay"], -total - 2.0 * 9.81, atol=1e-8)
    raw = result.outcome.multipliers
    assert np.all(np.linalg.norm(result.lam.values, axis=1) <= np.linalg.norm(raw, axis=1) * (1 + 1e-12))
    assert result.to_json()["final"]["lam"] == pytest.approx(result.lam.row(), abs=1e-9)


def test_repeated_rows_make_reactions_not_unique(tmp_path):
    path = tmp_path / "twice.toml"
    joint = '[joints.{}]\ntype = "revolute"\nbetween = ["ground", "rod"]\nat = [[0.0, 0.0], [-0.5, 0.0]]\n'
    body = "[bodies.rod]\nmass = 1.0\ninertia = 0.1\nposition = [0.5, 0.0]\n"
    path.write_text('[mechanism]\nname = "twice"\n' + body + joint.format("a") + joint.format("b"))
    result = symgen.simulate(path, until=0.01)
    assert result.rank.identical_rows_dropped == 2
    assert result.non_unique_reactions == ("a", "b")
