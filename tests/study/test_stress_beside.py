"""Methods beside `lagrange` with the same integrator: studies made by hand."""

import pytest

from study.report import made
from symgen.study.stress.beside import beside_yardstick, cells_beside, families_beside
from symgen.study.stress.findings import findings_of_study
from symgen.study.stress.stress_rows import LargestSteps, Stress


def study(errors, limits=(), **outcomes):
    """Return a study of two cases of one family: method -> errors of both."""
    rows = [
        made.stress_row("four-bar", method, outcomes.get(method.replace("-", "_"), "ok"), error, case=str(k))
        for method, both in errors.items()
        for k, error in enumerate(both)
    ]
    steps = tuple(LargestSteps("four-bar", "stiffness", "1", m, "rk4", h, h, 1.0) for m, h in dict(limits).items())
    return Stress(("four-bar",), tuple(rows), steps, (), (), quick=True)


def test_the_ratio_is_that_of_errors_in_the_middle_of_the_cases():
    lines = beside_yardstick(study({"lagrange": (1e-5, 1e-5), "baumgarte": (1e-6, 4e-6)}))
    assert [line.methods for line in lines] == [("lagrange",), ("baumgarte",)]
    assert lines[1].ratios["stiffness"] == pytest.approx((10.0 + 2.5) / 2.0)


def test_methods_with_the_same_numbers_are_one_line_unless_their_largest_steps_differ():
    errors = {"lagrange": (1e-5, 1e-5), "udwadia-kalaba": (1e-5, 1.001e-5), "null-space": (1e-5, 1e-5)}
    assert [line.methods for line in beside_yardstick(study(errors))] == [tuple(errors)]
    apart = beside_yardstick(study(errors, {"lagrange": 0.1, "udwadia-kalaba": 0.1, "null-space": 0.2}))
    assert [line.methods for line in apart] == [("lagrange", "udwadia-kalaba"), ("null-space",)]
    families, searched = families_beside(apart)
    assert (families, searched) == ([], ["stiffness"])
    assert [cells_beside(line, families, searched) for line in apart] == [("0.1",), ("0.2",)]


def test_a_run_that_diverges_and_an_error_below_its_reference_have_no_ratio():
    diverged = beside_yardstick(study({"lagrange": (1e-5, 1e-5), "penalty": (1e80, 1e80)}, penalty="diverged"))
    below = beside_yardstick(study({"lagrange": (1e-5, 1e-5), "penalty": (1e-11, 1e-11)}))
    assert diverged[1].ratios == below[1].ratios == {"stiffness": None}


def test_shares_of_other_numbers_of_cells_are_not_compared():
    """A method that ran one easy case is accurate in all of its cells, and is not called the most accurate one."""
    given = study({"lagrange": (1e-5, 1e-5), "baumgarte": (1e-5, 1e-5), "null-space": (1e-6,)})
    (text,) = [x for x in findings_of_study(given) if x.startswith("With rk4")]
    assert text == "With rk4 2 of 3 methods differ in their errors beside lagrange or in their largest steps."
    assert not any("null-space" in x for x in findings_of_study(given) if x.startswith("Most accurate"))
