"""Extreme values that methods reach: the search alone, with limits given, and in a study."""

import math
from dataclasses import replace

import pytest

from symgen.study.stress.bench import Base
from symgen.study.stress.cells import CellReference, RunTask
from symgen.study.stress.extreme_values import search_extremes
from symgen.study.stress.families import levels_of_family
from symgen.study.stress.study import stress

#: A reference that judges.
MOTION = {"unusable": None, "estimated_error": 0.0, "length": 1.0}


def searched(limits, values=(1e2, 1e4, 1e6), halvings=4, judge=None):
    """Return what is found where runs of each method are accurate up to a limit, and the references computed."""
    base = Base.of_mechanism("pendulum")
    level = levels_of_family("gravity", base, True)[0]
    references = list[float]()

    def level_at(model, family, value):
        return replace(level, label=f"{value:g}", values=(value,), family=family, model=model)

    def outcome(task):
        value = task.level.values[0]
        good = value <= limits[task.method]
        return {"outcome": judge(value) if judge is not None else "ok" if good else "diverged"}

    def compute(what, tasks):
        if isinstance(tasks[0], CellReference):
            references.extend(task.level.values[0] for task in tasks)
            return [(task, dict(MOTION)) for task in tasks], False
        return [(task, outcome(task)) for task in tasks], False

    tasks = [
        RunTask(level_at("pendulum", "gravity", value), method, "rk4", MOTION) for method in limits for value in values
    ]
    found, interrupted = search_extremes([(task, outcome(task)) for task in tasks], level_at, compute, halvings)
    assert not interrupted
    return {extreme.method: extreme for extreme in found}, references


def test_a_limit_is_found_to_a_part_of_its_decade():
    limits = {"lagrange": 3.3e4, "baumgarte": 2.9e4, "direct-correction": 7e2}
    found, references = searched(limits)
    for method, limit in limits.items():
        assert found[method].reached <= limit < found[method].beyond
        assert math.log10(found[method].beyond / found[method].reached) == pytest.approx(2.0 / 2**4)
    assert len(references) == len(set(references)) < 3 * 4  # methods on the same way share them


def test_where_all_values_or_none_are_accurate_there_is_one_bound():
    found, references = searched({"lagrange": 1e9, "baumgarte": 1e-9})
    assert (found["lagrange"].reached, found["lagrange"].beyond) == (1e6, None)
    assert (found["baumgarte"].reached, found["baumgarte"].beyond) == (None, 1e-2)
    assert references == [1.0, 1e-2]  # below the least value of the study


def test_a_search_ends_where_a_run_cannot_be_judged():
    outcomes = {1e2: "ok", 1e4: "diverged", 1e6: "diverged"}
    found, references = searched({"lagrange": 0.0}, judge=lambda value: outcomes.get(value, "unjudged"))
    assert (found["lagrange"].reached, found["lagrange"].beyond) == (1e2, 1e4) and references == [1e3]


@pytest.mark.slow
def test_the_largest_damper_is_where_the_largest_step_is_the_step_of_the_mechanism():
    """The decay grows with the damper, and a scheme follows it up to a product of decay and step."""
    study = stress(["pendulum"], ["damping"], ["lagrange"])
    (extreme,), (limit,), step = study.extremes, study.limits, study.rows[0].step
    expected = float(limit.case.split()[0]) * limit.stable_step / step
    assert extreme.integrator == limit.integrator == "rk4" and study.to_json()["extremes"][0]["family"] == "damping"
    assert 0.9 * extreme.reached < expected < 1.1 * extreme.beyond


@pytest.mark.slow
def test_a_quick_study_leaves_stiffness_to_the_largest_steps():
    study = stress(["pendulum"], ["damping", "gravity"], ["lagrange"], quick=True)
    assert {extreme.family for extreme in study.extremes} == {"gravity"}
    assert {limit.family for limit in study.limits} == {"damping"}
