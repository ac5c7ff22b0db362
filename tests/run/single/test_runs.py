"""Runs: statuses, failures with reason and time, rank events, interruption, parameters."""

import copy
import os
import subprocess
import sys

import numpy as np
import pytest
from support.emitted import mechanism_of
from support.kinds import ADAPTIVE, INTEGRATORS, METHODS
from support.models import parallelogram
from support.runs import run

from symgen.api import load
from symgen.base.settings import Settings
from symgen.compile.store.stats import cache_stats
from symgen.derive.methods import METHODS as KNOWN
from symgen.describe.catalogue import raw
from symgen.run.integrators import INTEGRATORS as SCHEMES
from symgen.run.layout import abi
from symgen.run.planning.automatic import constant_integrator
from symgen.run.planning.prepare import make_plan
from symgen.run.single.run import integrate


def test_a_run_that_went_well():
    result = load("four-bar").simulate(integrator="rk4", until=0.5)
    assert (result.status, result.reason, result.warnings, result.notes) == ("ok", None, (), ())
    assert result.steps == 500 and result.rank_event_count == 0 and result.smallest_pivot.min() > 0.1
    assert result.evaluations == 4 * result.steps


# -- failures ----------------------------------------------------------------------------------------------------------


def test_baumgarte_beyond_its_limit():
    """alpha = beta = 500 with RK4 is stable up to 5.57 ms."""
    keys = {"method": "baumgarte", "options": {"method.alpha": 500, "method.beta": 500}, "until": 2.0}
    result = load("four-bar").simulate(**keys, integrator="rk4", step=7e-3)
    assert result.status == "failed"
    assert any("the step 0.007 s exceeds 0.00557 s" in w for w in result.warnings)
    assert "exceeds max_violation" in result.reason and f"at t = {result.outcome.end:.6g} s" in result.reason
    assert 0.0 < result.outcome.end < 2.0
    # inside the limit violations stay bounded, although steps as coarse as that leave much of them
    assert load("four-bar").simulate(**keys, integrator="rk4", step=4e-3, max_violation=1.0).status == "ok"
    assert load("four-bar").simulate(**keys, integrator="rk4", step=7e-3, max_violation=1.0).status == "failed"


@pytest.mark.parametrize("integrator", ADAPTIVE)
def test_adaptive_steps_stay_below_the_limit(integrator):
    limit = KNOWN.get("baumgarte").largest_step({"alpha": 500, "beta": 500}, SCHEMES.get(integrator).real_boundary)
    outcome = run(
        load("four-bar"),
        method="baumgarte",
        integrator=integrator,
        options={"method.alpha": 500, "method.beta": 500},
        until=0.5,
    )
    assert outcome.code == abi.DONE and outcome.steps >= 0.5 / limit


def out_of_reach():
    """A slider that is pulled away at constant speed until crank and rod are stretched."""
    description = copy.deepcopy(raw("slider-crank"))
    del description["bodies"]["crank"]["angular_velocity"]
    value = "0.5433874092913796 + 0.1*t"
    description["joints"]["pull"] = {"type": "driver", "joint": "guide", "value": value}
    return load(mechanism_of(description))


#: When the slider of `out_of_reach` has come to 0.15 m + 0.45 m.
STRETCHED = (0.6 - 0.5433874092913796) / 0.1


@pytest.mark.parametrize("integrator", INTEGRATORS)
@pytest.mark.parametrize("method", METHODS)
def test_a_motion_that_cannot_go_on_fails_where_it_ends(method, integrator):
    step = 1e-3 if integrator == "rk4" else None
    result = out_of_reach().simulate(method=method, integrator=integrator, step=step, until=2.0)
    assert result.status == "failed"
    assert f"at t = {result.outcome.end:.6g} s" in result.reason
    assert STRETCHED - 0.01 < result.outcome.end < STRETCHED + 0.01
    assert np.all(np.isfinite(result.q.values)), "what is kept was good"
    assert result.t[-1] <= result.outcome.end and len(result.t) > 50


def test_energy_out_of_balance_is_a_failure():
    result = load("four-bar").simulate(method="direct-correction", integrator="euler", step=1e-2, until=10.0)
    assert result.status == "failed" and "the energy leaves its balance" in result.reason


def test_a_state_that_is_not_finite_is_a_failure():
    """A force that grows with the square of the speed explodes in finite time."""
    description = {
        "mechanism": {"name": "explosion"},
        "bodies": {"p": {"type": "point", "mass": 1.0, "velocity": [1.0, 0.0]}},
        "joints": {"line": {"type": "driver", "body": "p", "coordinate": "y", "value": 0.0}},
        "forces": {"push": {"type": "force", "body": "p", "force": ["p.vx**3", 0.0]}},
    }
    model = load(mechanism_of(description))
    for integrator, step in (("rk4", 1e-3), ("dopri5", None)):
        # v' = v^3, v(0) = 1: v = 1 / sqrt(1 - 2 t) ends at 0.5 s
        result = model.simulate(method="lagrange", integrator=integrator, step=step, until=2.0, max_energy_error=1e9)
        assert result.status == "failed" and result.reason
        assert 0.49 < result.outcome.end < 0.53


# -- rank --------------------------------------------------------------------------------------------------------------


def test_passages_are_events_that_hold_the_singular_times():
    """The window is flat where B0 crosses the ground line; times by interpolation of the run itself."""
    outcome = run(
        load("n-four-bar:1"), method="direct-correction", integrator="rk4", step=1e-3, until=5.0, output_step=1e-3
    )
    height = outcome.states[:, 1]
    crossings = outcome.times[:-1][np.sign(height[:-1]) != np.sign(height[1:])]
    assert len(crossings) == outcome.rank_event_count == len(outcome.rank_events) > 3
    for t, event in zip(crossings, outcome.rank_events, strict=True):
        assert event.t_in - 1e-3 <= t <= event.t_out + 1e-3
        assert event.t_out - event.t_in < 0.05
        assert event.smallest_pivot < 1e-4 and event.rank in (7, 8)
    assert outcome.smallest_pivot == min(e.smallest_pivot for e in outcome.rank_events)


def test_without_correction_of_positions_a_passage_leaves_doubt():
    keys = {"integrator": "rk4", "step": 1e-3, "until": 1.0}
    for method in ("lagrange", "baumgarte"):
        result = load("n-four-bar:1").simulate(method=method, **keys)
        assert result.status == "unverified" and "singular position" in result.reason
        assert result.rank_event_count > 0 and result.warnings
    assert load("n-four-bar:1").simulate(method="direct-correction", **keys).status == "ok"


@pytest.mark.parametrize("method", ["lagrange", "baumgarte"])
def test_a_wrong_branch_never_ends_well(method):
    for step in (0.97e-3, 1e-3, 1.02e-3):
        assert load("n-four-bar:1").simulate(method=method, integrator="rk4", step=step, until=10.0).status != "ok"


@pytest.mark.slow_cases("baumgarte")
@pytest.mark.parametrize("method", METHODS)
def test_a_redundant_row_changes_nothing_in_the_motion(method):
    """The parallelogram moves as its one-coordinate equation says, rank 11 of 12 all the way."""
    model = load(mechanism_of(parallelogram()))
    result = model.simulate(method=method, integrator="dop853", rtol=1e-12, atol=1e-12, until=0.5)
    assert result.status == "ok" and (result.rank.rows, result.rank.rank) == (12, 11)
    assert result.rank_event_count == 0
    # 3 links about their ends and the bar: (3/3 + 2) theta'' = g (3/2 + 2) sin(theta), from the vertical, clockwise
    from scipy.integrate import solve_ivp

    c = 9.81 * 3.5 / 3.0
    exact = solve_ivp(
        lambda _, y: [y[1], c * np.sin(y[0])], (0, 0.5), [0.0, 1.0], method="DOP853", rtol=1e-13, atol=1e-14
    )
    assert result["link1.theta"][-1] == pytest.approx(np.pi / 2 - exact.y[0, -1], abs=1e-9)


def test_a_redundant_row_is_no_event_near_a_singular_position():
    """One passage of the flat parallelogram is one event, and its rank never exceeds that of the start."""
    result = load(mechanism_of(parallelogram())).simulate(integrator="rk4", until=1.0, step=1e-3)
    assert max(e.rank for e in result.rank_events) <= 11
    assert result.rank_event_count == 1


def test_a_start_in_a_singular_position_is_left_behind():
    """A flat window released with the velocities of the regular branch: no row is redundant for good."""
    description = raw("n-four-bar", 1)
    for name, x, v in (("vertical0", 0.5, 0.5), ("vertical1", 1.5, 0.5), ("coupler0", 1.5, 1.0)):
        turned = {"position": [x, 0.0], "angle": 0.0, "velocity": [0.0, -v]}
        turned["angular_velocity"] = 0.0 if name == "coupler0" else -1.0
        description["bodies"][name] = description["bodies"][name] | turned
    outcome = run(load(mechanism_of(description)), method="direct-correction", integrator="rk4", step=1e-3, until=0.5)
    assert outcome.code == abi.DONE, outcome.reason
    coupler = outcome.states[:, 5]
    assert np.abs(coupler).max() <= 1e-3, "the coupler stays level on the regular branch"


# -- interruption ------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("integrator", INTEGRATORS)
def test_an_interrupt_keeps_what_was_computed(integrator):
    """Ctrl-C while the loop runs: the flag stops it, outputs up to there are those of a whole run."""
    model = load("pendulum")
    settings = Settings(
        method="lagrange", integrator=integrator, step=1e-4, until=2e5, output_step=1.0, max_violation=1e9, rtol=1e-13,
        atol=1e-13, max_energy_error=1e9,
    )  # fmt: skip
    plan = make_plan(model.mechanism, settings)
    compiled = model.compile("lagrange")
    calls = []

    def interrupt(t):
        calls.append(t)
        if len(calls) == 1:
            raise KeyboardInterrupt

    outcome = integrate(compiled, plan.integrator, model.assemble(compiled), plan.spec, interrupt)
    assert outcome.code == abi.STOPPED and "interrupted" in outcome.reason
    assert 0 < len(outcome.times) < 200_000 and outcome.end < 2e5
    assert outcome.times[-1] <= outcome.end < outcome.times[-1] + 1.0 + 1e-9
    whole = run(
        model, **{"method": "lagrange", "integrator": integrator, "step": 1e-4, "until": 3.0, "output_step": 1.0},
        rtol=1e-13, atol=1e-13,
    )  # fmt: skip
    np.testing.assert_allclose(outcome.states[:3], whole.states[:3], rtol=0, atol=1e-9)


# -- parameters --------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("method", METHODS)
def test_parameters_at_run_time_are_as_good_as_compiled_ones(method):
    """Other masses without compiling again, against a mechanism in which they are written as numbers."""
    new = {"crank_mass": 3.3, "coupler_mass": 0.7, "rocker_mass": 11.0}
    keys = {"method": method, "integrator": constant_integrator(method), "step": 1e-3, "until": 0.5}
    model = load("four-bar")
    first = run(model, **keys)
    before = cache_stats()
    second = run(model, **keys, parameters=new)
    assert cache_stats()["misses"] == before["misses"], "nothing was compiled"
    text = repr(raw("four-bar"))
    for name, value in new.items():
        text = text.replace(f"'{name}*", f"'{value}*").replace(f"'mass': '{name}'", f"'mass': {value}")
    description = eval(text)  # a test's own text
    assert all(isinstance(body["mass"], float) for body in description["bodies"].values())
    baked = run(load(mechanism_of(description)), **keys)
    np.testing.assert_allclose(second.states, baked.states, rtol=0, atol=1e-11)
    assert np.abs(second.states - first.states).max() > 1e-2


def test_times_may_be_any_array():
    """A column of a table is not contiguous; it is an array of times all the same."""
    times = np.array([[0.0, 1.0], [0.1, 2.0], [0.25, 3.0]])[:, 0]
    assert run(load("pendulum"), until=0.3, times=times).times.tolist() == [0.0, 0.1, 0.25]


SCRIPT = """
from symgen.api import load
for integrator in ("rk4", "dopri5", "dop853"):
    r = load("pendulum").simulate(until=0.05, step=1e-3, integrator=integrator)
    print(r.status, *r.outcome.states[-1].tolist())
r = load("scissor-lift").simulate(until=3e-3, step=1e-3, integrator="rk4")  # an output of it is an integral
print(r.status, *r.outcome.states[-1].tolist())
"""


@pytest.mark.slow
def test_everything_runs_without_compilation():
    """NUMBA_DISABLE_JIT=1 is how a run is debugged; it gives the same numbers."""
    found = []
    for disabled in ("1", "0"):
        done = subprocess.run(
            [sys.executable, "-c", SCRIPT],
            capture_output=True,
            text=True,
            timeout=600,
            env=os.environ | {"NUMBA_DISABLE_JIT": disabled},
            check=False,
        )
        assert done.returncode == 0, done.stderr.splitlines()[-1]
        found.append([line.split() for line in done.stdout.splitlines()])
    for plain, fast in zip(*found, strict=True):
        assert plain[0] == fast[0] == "ok"
        np.testing.assert_allclose(np.array(plain[1:], float), np.array(fast[1:], float), rtol=0, atol=1e-13)
