"""Stress studies on small models: known limits, known errors, known motions."""

import csv
import json
import math
import os
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import symgen
from symgen.base.errors import InputError, SimulationError
from symgen.result.points import Points
from symgen.run.compiling.method_choice import choose_method
from symgen.run.starts import assembler
from symgen.study.journal import Journal
from symgen.study.references.independent import IndependentEquations
from symgen.study.references.motion import CompiledEquations, InterpretedEquations, motion_with_estimate
from symgen.study.references.reference import reference_motion
from symgen.study.references.solvers import fastest_modes
from symgen.study.stress.bench import Base, Level
from symgen.study.stress.cells import CellReference, LimitTask, RunTask, compute_cell
from symgen.study.stress.families import FAMILIES, levels_of_family
from symgen.study.stress.findings import largest_root
from symgen.study.stress.shared_by_cells import code_of_cell
from symgen.study.stress.stress_rows import save_stress_csv
from symgen.study.stress.study import QUICK_COMPILATION, _make_cell, _Study, method_pairs, stress
from tests.study.test_reference import start_of

ROOT = Path(__file__).resolve().parents[2]


# -- references --------------------------------------------------------------------------------------------------------


@pytest.mark.slow
def test_compiled_equations_are_the_interpreted_ones():
    """SciPy's DOP853 on lambdified equations and extrapolation on compiled ones agree, at other parameter values."""
    mechanism = Base.of_mechanism("slider-crank").stressed
    values = symgen.load(mechanism).parameters()
    equations = CompiledEquations(mechanism, values)
    changed = {**values, "stress_stiffness": 300.0, "stress_damping": 2.0, "stress_mass": 3.0, "stress_gravity": 0.5}
    q, v = start_of(symgen.load(mechanism), changed)
    times = np.linspace(0.0, 0.5, 6)
    equations.set_parameters(changed)
    found = motion_with_estimate(equations, q, v, times)
    other = reference_motion(mechanism, changed, q, v, times, solver="scipy-dop853")
    apart = Points.of_mechanism(mechanism, changed).largest_distance(found.q, other.q)
    assert apart < 1e-9
    assert apart < 10.0 * (found.estimated_error + other.estimated_error)
    assert found.estimated_error < 1e-9


@pytest.mark.slow
def test_compiled_slopes_are_differences_of_the_interpreted_rates():
    mechanism = Base.of_mechanism("slider-crank").stressed
    values = {**symgen.load(mechanism).parameters(), "stress_stiffness": 300.0, "stress_damping": 2.0}
    equations, plain = CompiledEquations(mechanism, values), IndependentEquations(mechanism, values)
    q, v = start_of(symgen.load(mechanism), values)
    y = equations.nearest_state(0.0, np.concatenate([q, v + 0.3]))
    plain.nearest_state(0.0, y)
    found, expected = equations.slopes(0.1, y), plain.slopes(0.1, y)
    assert np.abs(expected).max() > 100.0
    np.testing.assert_allclose(found, expected, atol=1e-7 * np.abs(expected).max())


CART = """
[mechanism]
name = "cart"
gravity = [0.0, -9.81]
[run]
until = 0.4
[bodies.cart]
mass = 2.0
inertia = 0.1
position = [0.1, 0.0]
[bodies.pole]
mass = 1.0
inertia = 0.08
points = { pin = [-0.5, 0.0] }
position = ["0.1 + 0.5*sin(0.4)", "-0.5*cos(0.4)"]
angle = "0.4 - pi/2"
[joints.rail]
type = "translational"
between = ["ground", "cart"]
at = [[0.0, 0.0], "centre"]
axis = [1.0, 0.0]
[joints.pin]
type = "revolute"
between = ["cart", "pole"]
at = ["centre", "pin"]
[joints.motor]
type = "driver"
joint = "rail"
value = "0.1 + 0.05*sin(3*t)"
"""


@pytest.mark.slow
def test_interpreted_equations_are_the_compiled_ones_and_undefined_where_these_are():
    mechanism = Base.of_mechanism("slider-crank").stressed
    values = {**symgen.load(mechanism).parameters(), "stress_stiffness": 300.0, "stress_mass": 3.0}
    pair = [kind(mechanism, values) for kind in (CompiledEquations, InterpretedEquations)]
    q, v = np.linspace(0.1, 0.9, 9), np.linspace(-1.0, 1.0, 9)
    for compiled, interpreted in zip(*(equations.evaluate(0.2, q, v) for equations in pair), strict=True):
        np.testing.assert_allclose(interpreted, compiled, rtol=1e-13, atol=1e-12)
    assert np.isnan(pair[1].evaluate(0.2, np.full(9, np.inf), v)[0]).any()


@pytest.mark.by_turns(4)
@pytest.mark.slow
def test_attempts_of_a_search_on_a_driven_cart_compile_nothing_anew(tmp_path):
    """Steps, parameters and starts are arguments of the code of one formulation."""
    file = tmp_path / "cart.toml"
    file.write_text(CART)
    code = f"from study.test_stress import search_on_a_cart as f; f({str(file)!r})"
    path = os.pathsep.join(p for p in sys.path if p)  # a process of its own: what others have loaded is not compiled
    own = {"SYMGEN_COMPILER": "explain", "SYMGEN_CACHE_DIR": str(tmp_path / "cache"), "PYTHONPATH": path}
    done = subprocess.run(
        [sys.executable, "-c", code], capture_output=True, text=True, check=False, env=os.environ | own
    )
    assert done.returncode == 0, done.stderr
    before, _, behind = done.stderr.partition("the search begins")
    assert "compiled in" in before
    compiled = [line.split()[0] for line in behind.splitlines() if "compiled in" in line]
    assert len(compiled) == len(set(compiled)) < 10, compiled


def search_on_a_cart(file):
    level = levels_of_family("stiffness", Base.of_mechanism(Path(file)), True)[1]
    known = compute_cell(CellReference(level))
    assert compute_cell(RunTask(level, "lagrange", "rk4", known))["outcome"] in ("ok", "inaccurate", "diverged")
    print("the search begins", file=sys.stderr, flush=True)
    found = compute_cell(LimitTask(level, "lagrange", "rk4", known))
    assert 1e-4 < found["accurate_step"] <= found["stable_step"] < 0.01


@pytest.mark.slow
def test_a_stiff_motion_has_a_reference_too():
    """A point mass that sinks against a strong damper: v = m g / c along the damper, in closed form."""
    builder = symgen.MechanismBuilder("sinking", gravity=(0.0, -9.81))
    builder.parameter("c", 1e8)
    builder.body("bob", type="point", mass=2.0, position=(0.0, -1.0), velocity=(0.0, 0.0))
    builder.joint("guide", "distance", between=("ground", "bob"), at=((1e6, -1.0), "centre"), length=1e6)
    builder.force("damper", "spring-damper", between=("ground", "bob"), at=((0.0, 0.0), "centre"), damping="c")
    mechanism = builder.build()
    values = {"c": 1e8}
    times = np.linspace(0.0, 1.0, 5)
    found = motion_with_estimate(CompiledEquations(mechanism, values), np.array([0.0, -1.0]), np.zeros(2), times)
    assert "Radau" in found.how
    np.testing.assert_allclose(found.q[:, 1], -1.0 - 2.0 * 9.81 / 1e8 * times, rtol=0.0, atol=1e-9)


def test_a_solver_that_gives_up_costs_its_reference_alone(monkeypatch):
    """SciPy's Radau raises ValueError where the Jacobian is not finite; the study goes on without that reference."""

    def gives_up(*arguments, **options):
        raise ValueError("array must not contain infs or NaNs")

    monkeypatch.setattr("scipy.integrate.Radau", gives_up)
    monkeypatch.setattr("symgen.study.references.motion.is_stiff", lambda equations, y, until: True)
    mechanism = symgen.load("pendulum").mechanism
    equations = CompiledEquations(mechanism, {p.name: p.value for p in mechanism.parameters})
    with pytest.raises(SimulationError, match="cannot be integrated beyond t = 0 s: the state is not finite"):
        motion_with_estimate(equations, np.array([-1.0, 0.0]), np.zeros(2), np.array([0.0, 0.1]))


# -- families ----------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("family", FAMILIES)
@pytest.mark.parametrize("quick", [True, False])
def test_families_make_cases(family, quick):
    levels = levels_of_family(family, Base.of_mechanism("four-bar"), quick)
    assert levels and len({level.label for level in levels}) == len(levels)
    for level in levels:
        assert level.family == family and len(level.values) == (
            2 if family in ("alpha-beta", "scale", "step-stiffness") else 1
        )
        assert level.until > 0.0 and level.step > 0.0
        known = {p.name for p in level.mechanism.parameters}
        assert set(level.parameters) <= known


def test_one_compiled_module_serves_all_cases_but_those_with_other_joints():
    """What compiles is told by the digest.

    These are the base, two redundant ones, the linkage of adjustable lengths, the same with a
    driver, three chains, a mass on a spring, and five at their limits.
    """
    from symgen.describe.facts.digest import digest

    base = Base.of_mechanism("four-bar")
    found = {digest(level.mechanism) for name in FAMILIES for level in levels_of_family(name, base, False)}
    assert len(found) == 14


@pytest.mark.slow
def test_neutral_handles_change_nothing():
    base = Base.of_mechanism("four-bar")
    plain = symgen.load("four-bar").simulate(integrator="dop853", rtol=1e-10, until=1.0)
    same = symgen.load(base.stressed).simulate(integrator="dop853", rtol=1e-10, until=1.0)
    np.testing.assert_allclose(same["coupler.x"][-1], plain["coupler.x"][-1], atol=1e-9)


@pytest.mark.slow
def test_handles_turn_what_they_say():
    """Twice the mass factor and twice gravity, by the independent equations: forces and masses double."""
    base = Base.of_mechanism("four-bar")
    values = symgen.load(base.stressed).parameters()
    equations = CompiledEquations(base.stressed, values)
    q, v = np.linspace(0.1, 0.9, 9), np.zeros(9)
    before, mass = equations.evaluate(0.0, q, v)[4], equations.mass.copy()
    equations.set_parameters({**values, "stress_mass": 2.0, "stress_gravity": 3.0})
    after = equations.evaluate(0.0, q, v)[4]
    assert equations.mass[3:6] == pytest.approx(2.0 * mass[3:6]) and equations.mass[0] == mass[0]
    assert after[1] == pytest.approx(3.0 * before[1]) and after[4] == pytest.approx(6.0 * before[4])


def test_families_say_why_they_do_not_apply():
    study = stress(["pendulum"], ["mass-ratio", "redundancy", "spin-rate"], ["lagrange"], quick=True)
    assert not study.rows
    assert {family for _, family, _ in study.skipped} == {"mass-ratio", "redundancy", "spin-rate"}


@pytest.mark.slow
@pytest.mark.slow_cases("cart-pole")
@pytest.mark.parametrize("model", ["cart-pole", "inverted-pendulum"])
def test_a_body_that_its_file_holds_is_displaced_all_the_same(model):
    study = stress([model], ["inconsistent-start"], ["lagrange"], quick=True)
    assert [row.outcome for row in study.rows] == ["ok"]


@pytest.mark.slow
def test_starts_of_a_study_are_compiled(monkeypatch):
    """A study closes hundreds: interpreted as a single one is, they take a quarter of its time."""
    monkeypatch.setattr(assembler, "plain_form", lambda function: pytest.fail(f"{function.__name__} is interpreted"))
    study = stress(["pendulum"], ["gravity"], ["lagrange"], quick=True)
    assert {row.outcome for row in study.rows} == {"ok"}
    with pytest.raises(pytest.fail.Exception):
        symgen.simulate("pendulum", until=0.1)


def test_a_quick_study_is_of_its_models_alone_and_compiles_for_so_long(monkeypatch):
    """Mechanisms of families, the same for every model, are studied where they are named."""
    studies = []
    monkeypatch.setattr(_Study, "run", lambda self, skipped: studies.append(self))
    for arguments in ({"quick": True}, {"cases": ["length-ratio"], "quick": True}, {}):
        stress(["four-bar"], **arguments)
    quick, named, whole = ({level.model for level in study.levels} for study in studies)
    assert (quick, named, whole) == ({"four-bar"}, {"-"}, {"four-bar", "-"})
    assert [study.compilation for study in studies] == [QUICK_COMPILATION, QUICK_COMPILATION, math.inf]
    assert not studies[0].left_out, "a small mechanism has all methods"


@pytest.mark.parametrize("quick", [True, False])
def test_a_search_is_in_the_same_case_whatever_the_extent(quick, monkeypatch):
    asked = []

    def motions(self, what, tasks, whole):
        asked.append(tasks)
        return [(task, {}) for task in tasks], False

    monkeypatch.setattr(_Study, "_compute_cells", motions)
    monkeypatch.setattr("symgen.study.stress.study.cells_without_reference", lambda motion: None)
    monkeypatch.setattr("symgen.study.stress.study._make_row", lambda task, outcome: None)
    monkeypatch.setattr("symgen.study.stress.study._make_limit", lambda task, outcome: None)
    monkeypatch.setattr("symgen.study.stress.study.search_extremes", lambda *words: ((), False))
    stress(["four-bar"], ["stiffness", "damping"], ["lagrange"], quick=quick)
    assert [(task.level.family, task.level.values) for task in asked[2]] == [
        ("stiffness", (1e4,)),
        ("damping", (1e4,)),
    ]
    assert {task.halvings for task in asked[2]} == {4 if quick else 7}


# -- known truths ------------------------------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def damped():
    """The four-bar with a stiff damper, its reference, and the fastest decay by the independent equations."""
    level = levels_of_family("damping", Base.of_mechanism("four-bar"), False)[1]
    known = compute_cell(CellReference(level))
    values = symgen.load(level.mechanism).parameters(level.parameters)
    equations = CompiledEquations(level.mechanism, values)
    y = equations.nearest_state(0.0, np.concatenate([known["q"][0], np.zeros(equations.n)]))
    return level, known, fastest_modes(equations, y)[0]


@pytest.mark.slow
def test_the_largest_step_of_rk4_is_where_its_region_of_stability_ends(damped):
    level, known, fastest = damped
    for method in ("lagrange", "coordinate-partitioning"):
        found = compute_cell(LimitTask(level, method, "rk4", known))
        assert found["stable_step"] == pytest.approx(2.785 / fastest, rel=0.04)


@pytest.mark.slow
def test_the_length_of_a_point_on_a_link_is_the_range_of_its_motion():
    """It swings from one side to the other. In lengths of its link the largest step would be that of an error."""
    level = levels_of_family("duration", Base.of_mechanism("pendulum"), True)[0]
    known = compute_cell(CellReference(level))
    assert known["length"] == pytest.approx(2.0, rel=1e-2)
    found = compute_cell(LimitTask(level, "lagrange", "rk4", known))
    assert found["accurate_step"] < found["stable_step"] and found["stable_step"] > 0.02


@pytest.mark.slow
def test_an_l_stable_integrator_has_no_such_limit(damped):
    level, known, fastest = damped
    found = compute_cell(LimitTask(level, "ggl", "radau5", known))
    assert found["stable_step"] > 10.0 * 2.785 / fastest


@pytest.mark.slow
def test_baumgarte_s_gains_are_stable_up_to_the_limit_of_rk4():
    study = stress(["four-bar"], ["alpha-beta"], ["baumgarte"], quick=True)
    assert len(study.rows) == 25
    real = [
        (largest_root(*row.values) * row.step, row.outcome == "ok")
        for row in study.rows
        if row.values[0] >= row.values[1]
    ]
    assert all(good == (reach < 2.785) for reach, good in real)
    assert {good for _, good in real} == {True, False}


@pytest.mark.slow
def test_errors_of_long_links_count_in_lengths_of_the_crank():
    """In lengths of links of 1e6 m a crank that stands still would be right."""
    level = levels_of_family("length-ratio", Base.of_mechanism("four-bar"), False)[-1]
    known = compute_cell(CellReference(level))
    assert level.values == (1e6,) and known["length"] == 1.0
    still = np.array(known["q"])[:1].repeat(len(known["q"]), axis=0)
    found = compute_cell(RunTask(level, "lagrange", "dop853", {**known, "q": still.tolist()}))
    assert found["outcome"] == "inaccurate" and found["relative_error"] == found["error"] > 0.1


@pytest.mark.slow
def test_the_error_of_a_penalty_falls_with_its_factor():
    study = stress(["four-bar"], ["penalty-factor"], ["penalty"])
    error = {row.values[0]: row.error for row in study.rows if row.integrator == "dop853"}
    assert error[1e6] / error[1e4] == pytest.approx(1e-2, rel=0.5)
    assert 0.005 < error[1e8] / error[1e6] < 0.06  # the tolerance of the integrator shows already
    assert error[1e12] > 10.0 * error[1e8]  # rounding has taken over
    lengths = {round(row.error / row.relative_error, 9) for row in study.rows if row.error}
    assert len(lengths) == 1 and 1.0 < lengths.pop() < 4.0  # of the range of the motion, below the longest link
    for row in study.rows:
        if row.status != "not run" and not row.note:
            assert (row.outcome == "ok") == (row.error is not None and row.relative_error <= 1e-3)


@pytest.mark.slow
def test_a_branch_is_lost_at_the_singular_position_without_correction():
    study = stress([], ["singular-passage"], ["lagrange", "direct-correction", "auto"], quick=True)
    found = {(row.method, row.values[0]): row for row in study.rows}
    assert found["lagrange", 0.0].outcome in ("singular", "wrong branch")
    assert found["lagrange", 0.0].status != "ok"
    assert found["direct-correction", 0.0].outcome == "ok"
    assert found["auto", 0.0].outcome == "ok"
    assert all(row.model == "-" for row in study.rows)


@pytest.mark.by_turns(2)
@pytest.mark.slow
@pytest.mark.parametrize("space", ["planar", "spatial"])
def test_cells_see_a_force_between_two_places(space, tmp_path):
    """A point that flies by at 1 m/s is pushed by 6.6 N for 0.8 mm, as single runs see; cells were off by 1e-3 m."""
    rest = ", 0.0" if space == "spatial" else ""
    path = tmp_path / "pushed.toml"
    path.write_text(
        f'[mechanism]\nname = "pushed"\nspace = "{space}"\n[bodies.a]\ntype = "point"\nmass = 1.0\n'
        f"position = [0.3, 0.0{rest}]\nvelocity = [1.0, 0.0{rest}]\n"
        f'[forces.push]\ntype = "force"\nbody = "a"\nforce = ["6.6 if 0.9996 < a.x < 1.0004 else 0", 0.0{rest}]\n'
    )
    level = Level("past", (1.0,), symgen.load(path).mechanism, 2.0, 1e-3)
    known = compute_cell(CellReference(level))
    times, edge, faster = np.linspace(0.0, 2.0, 51), 0.7 - 4e-4, math.sqrt(1.0 + 2.0 * 6.6 * 8e-4)
    expected = np.where(times < edge, 0.3 + times, 1.0 + 4e-4 + faster * (times - edge - (faster - 1.0) / 6.6))
    assert np.abs(np.array(known["q"])[:, 0] - expected).max() < 1e-6
    found = compute_cell(RunTask(level, "lagrange", "dop853", known))
    assert found["outcome"] == "ok" and found["error"] < 1e-6


def test_what_is_too_slow_is_told_without_a_clock():
    level = levels_of_family("duration", Base.of_mechanism("four-bar"), True)[0]
    known = {"unusable": None, "estimated_error": 0.0, "length": 1.0, "decay": 0.0, "parameters": {}}
    predicted = compute_cell(RunTask(replace(level, step=1e-7), "lagrange", "rk4", known))
    assert predicted["outcome"] == "too slow" and predicted["evaluations"] == 0
    assert predicted["reason"] == "4e+08 evaluations, more than 5e+06"
    refused = compute_cell(RunTask(level, "lagrange", "generalized-alpha", known))
    assert refused["outcome"] == "refused" and "one that solves the form of lagrange" in refused["reason"]


@pytest.mark.parametrize("integrator", ["rk4", "dop853"])
def test_a_run_ends_at_its_budget_of_evaluations_whatever_the_clock(integrator):
    from symgen.base.settings import Settings
    from symgen.run.layout import abi
    from symgen.run.planning.prepare import prepare

    model = symgen.load("four-bar")
    step = 1e-6 if integrator == "rk4" else None
    settings = Settings(method="lagrange", integrator=integrator, step=step, until=1e3, output_step=1e3)
    run = prepare(model.mechanism, settings).with_spec(max_violation=1e30, max_energy_error=1e30)
    for most in (1, 1000):
        outcome = run.with_spec(max_evaluations=most).integrate()
        assert outcome.code == abi.STOPPED and most < outcome.evaluations < most + 13 and not outcome.interrupted
    short = Settings(method="lagrange", integrator=integrator, step=step, until=1e-4)
    whole = prepare(model.mechanism, short).integrate()
    ended = prepare(model.mechanism, short).with_spec(max_evaluations=whole.evaluations).integrate()
    assert ended.code == abi.DONE and np.array_equal(ended.states, whole.states)


@pytest.mark.slow
def test_a_run_that_stops_itself_is_judged_by_what_it_was_doing():
    """With a tight limit lagrange drifts off its constraints although its motion is still right."""
    study = stress(["four-bar"], ["redundancy"], ["lagrange"], quick=True, max_violation=1e-13)
    (row,) = study.rows
    assert row.status == "failed" and row.outcome in ("inaccurate", "diverged")
    assert row.note.startswith("ended at t = ")


@pytest.mark.slow
def test_bars_that_repeat_constraints_are_judged_by_the_motion_without_them():
    study = stress(["four-bar"], ["redundancy", "step"], ["direct-correction"], quick=True)
    errors = {row.family: row.error for row in study.rows if row.case in ("1 bar more", "0.001 s")}
    assert set(errors) == {"redundancy", "step"} and max(errors.values()) < 1e-6
    base = Base.of_mechanism("four-bar")
    bars, steps = (levels_of_family(family, base, True)[0] for family in ("redundancy", "step"))
    keys = {_make_cell(CellReference(replace(level, model="four-bar"), True)).key for level in (bars, steps)}
    assert len(keys) == 1  # computed once


def test_looped_code_is_one_object_for_all_starts():
    base, choice = Base.of_mechanism("four-bar"), replace(choose_method("lagrange"), shape="looped")
    slow, fast = levels_of_family("spin-rate", base, True)
    (bars,) = levels_of_family("redundancy", base, True)
    first, second, other = (code_of_cell(level.mechanism, choice) for level in (slow, fast, bars))
    assert slow.mechanism != fast.mechanism and first is second is not other


# -- the study ---------------------------------------------------------------------------------------------------------


@pytest.mark.slow
def test_rows_come_in_order_and_fit_the_contract(tmp_path):
    study = stress(["pendulum"], ["duration", "gravity"], ["lagrange", "ggl", "auto"])
    assert [row.family for row in study.rows] == ["duration"] * 18 + ["gravity"] * 30
    found = study.to_json()
    assert json.loads(json.dumps(found, allow_nan=False))
    keys = {
        "models",
        "coordinates",
        "quick",
        "interrupted",
        "accurate",
        "budget",
        "cells",
        "outcomes",
        "rows",
        "limits",
        "skipped",
    }
    assert set(found) == keys | {"unusable", "left_out", "false_successes", "findings", "beside", "extremes"}
    assert found["cells"] == len(study.rows) == sum(found["outcomes"].values())
    assert not [row for row in study.false_successes if row.method == "auto"]
    path = save_stress_csv(study, tmp_path / "cells.csv")
    with path.open(newline="") as handle:
        rows = list(csv.DictReader(handle))
    assert len(rows) == len(study.rows)
    assert float(rows[0]["error"]) == study.rows[0].error


@pytest.mark.slow
def test_a_journal_keeps_cells_and_changes_nothing(tmp_path):
    journal = tmp_path / "journal.jsonl"
    with Journal(journal) as kept:
        first = stress(["pendulum"], ["gravity"], ["lagrange"], quick=True, journal=kept)
    lines = journal.read_bytes()
    with Journal(journal) as kept:
        again = stress(["pendulum"], ["gravity"], ["lagrange"], quick=True, journal=kept)
        assert again == first and journal.read_bytes() == lines
        more = stress(["pendulum"], ["gravity"], ["lagrange", "baumgarte"], quick=True, journal=kept)
    assert [row for row in more.rows if row.method == "lagrange"] == list(first.rows)
    assert journal.read_bytes().startswith(lines)


@pytest.mark.by_turns(2)
@pytest.mark.slow
def test_several_processes_find_the_same():
    alone = stress(["pendulum"], ["gravity"], ["lagrange", "penalty"], quick=True)
    together = stress(["pendulum"], ["gravity"], ["lagrange", "penalty"], quick=True, jobs=2)
    assert together == alone


def test_pairs_of_methods_and_integrators():
    assert method_pairs("lagrange") == tuple(("lagrange", name) for name in ("rk4", "dop853", "picard", "radau5"))
    assert method_pairs("lagrange", constant_steps=True) == (("lagrange", "rk4"),)
    assert method_pairs("ggl") == (("ggl", "radau5"),)
    assert method_pairs("auto") == (("auto", "auto"),) and method_pairs("auto", constant_steps=True) == ()


@pytest.mark.slow
def test_a_reference_does_with_less_where_rounding_forbids_more(monkeypatch):
    from symgen.study.references import motion as compiled

    mechanism = symgen.load("pendulum").mechanism
    times = np.linspace(0.0, 1.0, 5)
    equations = CompiledEquations(mechanism, {"bob_mass": 1.0})
    best = motion_with_estimate(equations, np.array([-1.0, 0.0]), np.zeros(2), times)
    monkeypatch.setattr(compiled, "FINE", 1e-18)
    monkeypatch.setattr(compiled, "BUDGET", 20_000)
    found = motion_with_estimate(equations, np.array([-1.0, 0.0]), np.zeros(2), times)
    assert "at 3e-14" in best.how and "at 1e-10" in found.how
    np.testing.assert_allclose(found.q, best.q, atol=1e-8)


FEW = {"models": ("four-bar",), "cases": ("mass-ratio",), "methods": ("lagrange",), "quick": True}


@pytest.mark.slow
def test_runs_in_joint_coordinates_are_judged_by_the_references_of_bodies(tmp_path):
    with Journal(tmp_path / "cells") as journal:
        bodies = stress(**FEW, journal=journal)
        joints = stress(**FEW, journal=journal, coordinates="joint")
        again = stress(**FEW, journal=journal, coordinates="joint")
    assert [(r.case, r.method) for r in joints.rows] == [(r.case, r.method) for r in bodies.rows] != []
    assert all(row.outcome == "ok" and row.error < 1e-8 for row in joints.rows)
    assert joints.rows == again.rows
    # not the cells of bodies: other equations round otherwise
    assert all(a.error != b.error for a, b in zip(bodies.rows, joints.rows, strict=True))
    assert (bodies.to_json()["coordinates"], joints.to_json()["coordinates"]) == ("absolute", "joint")
    assert {*bodies.to_json()["rows"][0]} == {*joints.to_json()["rows"][0]}


def test_other_coordinates_are_refused():
    with pytest.raises(InputError, match="coordinates: expected"):
        stress(**FEW, coordinates="joints")
