"""What becomes of a run, told from constructed facts; the search for the largest step; the map and the findings."""

import math
from dataclasses import replace

import numpy as np
import pytest

from symgen.study.stress import findings as sentences
from symgen.study.stress.cell_outcome import ACCURATE, OUTCOMES, Run, classify, false_success
from symgen.study.stress.cells import largest
from symgen.study.stress.findings import cause, explained, findings, largest_root
from symgen.study.stress.stress_rows import Limit, Map, Stress, StressRow

REGULAR = np.ones(11)
FLAT = np.array([1.0, 0.8, 0.5, 0.3, 0.1, 0.05, 0.2, 0.4, 0.6, 0.8, 1.0])
GOOD = Run(True, np.full(11, 1e-6), REGULAR, 0.0, 1e-9, 2.0)
SMALL, LARGE = np.linspace(0.0, 0.05, 11), np.linspace(0.0, 5.0, 11)
#: On the reference until output 5, elsewhere from then on.
JUMP = np.array([0.0] * 5 + [1.0] * 6)


@pytest.mark.parametrize(
    ("changes", "outcome"),
    [
        ({}, "ok"),
        ({"errors": np.full(11, ACCURATE)}, "ok"),
        ({"errors": np.full(11, ACCURATE * 1.001)}, "inaccurate"),
        ({"errors": SMALL, "violation": 10.0}, "inaccurate"),
        ({"errors": LARGE}, "inaccurate"),  # out of phase, but where the mechanism can be
        ({"errors": LARGE, "violation": 10.0}, "diverged"),
        ({"errors": LARGE, "violation": math.inf}, "diverged"),
        ({"errors": np.full(11, np.nan), "violation": 0.0}, "diverged"),
        ({"errors": np.array([])}, "diverged"),
        ({"errors": JUMP, "sines": FLAT}, "wrong branch"),
        ({"errors": JUMP, "sines": REGULAR}, "inaccurate"),
        ({"errors": JUMP, "sines": FLAT, "violation": 1.0}, "diverged"),
        # the error has grown long before the flat position
        (
            {"errors": np.array([0.0, *[1.0] * 10]), "sines": FLAT[::-1] * 0 + np.array([1.0] * 9 + [0.01, 0.5])},
            "inaccurate",
        ),
        ({"finished": False, "errors": np.full(5, 1e-9), "sines": FLAT}, "singular"),
        ({"finished": False, "errors": np.full(2, 1e-9), "sines": FLAT}, "diverged"),
        ({"finished": False, "errors": np.full(5, 1e-9)}, "diverged"),
        ({"reference_error": None}, "unjudged"),
        ({"reference_error": ACCURATE}, "unjudged"),
        ({"reference_error": ACCURATE / 2}, "ok"),
    ],
)
def test_outcomes(changes, outcome):
    assert classify(replace(GOOD, **changes)) == outcome
    assert outcome in OUTCOMES


def test_a_run_is_not_believed():
    assert false_success("ok", "inaccurate", 2e-3)
    assert false_success("ok", "diverged", None)
    assert not false_success("ok", "ok", ACCURATE)
    assert not false_success("unverified", "wrong branch", 1.0)
    assert not false_success("failed", "diverged", 1.0)
    assert not false_success("ok", "unjudged", 1.0)


@pytest.mark.parametrize("limit", [3e-6, 0.9e-3, 1.1e-3, 0.02, 0.7])
def test_the_largest_step_is_found_within_a_percent_or_so(limit):
    tried = []

    def holds(step):
        tried.append(step)
        return step <= limit

    found = largest(holds, 1e-3, 1.0)
    assert limit / 1.012 < found <= limit
    assert len(tried) < 30


def test_no_largest_step():
    assert largest(lambda step: True, 1e-3, 1.0) == 1.0
    assert largest(lambda step: False, 1e-3, 1.0) is None


def test_roots_of_the_feedback():
    for alpha, beta in ((5.0, 5.0), (7.0, 3.0), (2.0, 9.0), (0.0, 4.0)):
        expected = max(abs(np.roots([1.0, 2.0 * alpha, beta**2])))
        assert largest_root(alpha, beta) == pytest.approx(expected, rel=1e-6)


def row(method, outcome, error, case="1", **changes):
    base = StressRow(
        *("four-bar", "stiffness", case, (1.0,), method, "rk4", 1e-3, 1.0, outcome, error, 1e-9, "ok", None, 4000),
        *(1e-12, 1e-12, 0.0, "", "", True),
    )
    return replace(base, **changes)


ROWS = (
    row("lagrange", "ok", 1e-6),
    row("lagrange", "inaccurate", 2e-3, "2"),
    row("penalty", "diverged", None, "2", status="failed"),
    row("penalty", "too slow", None, "3", status="not run"),
    row("penalty", "inaccurate", 0.5, "4", position_violation_max=1e-7),
    row("auto", "ok", 1e-6, integrator="auto", step=None),
    row("auto", "refused", None, "2", integrator="auto", step=None, status="not run"),
)
STUDY = Stress(("four-bar",), ROWS, (), (), ())


def test_the_map_sums_up():
    shown = Map.of(STUDY)
    assert shown.lines == (("lagrange", "rk4"), ("penalty", "rk4"), ("auto", "auto"))
    assert [shown.entry(line, "stiffness").text for line in shown.lines] == ["1/2 i", "0/3 idt", "1/1 r"]


def test_findings_say_what_the_rows_say():
    found = " ".join(findings(STUDY))
    assert "Of 7 cells of the map 2 ok, 2 inaccurate, 1 diverged, 1 too slow and 1 refused." in found
    assert "Least often accurate was penalty with rk4: 0 of 3 cells." in found
    assert "hardest are 3 cases alike" in found and "1 of 3 pairs stay accurate in all that was judged (auto)" in found
    assert "auto reports success with an error above 0.001 m in no cell of 2." in found
    assert "Other methods report success with such an error in 2 of 5 cells" in found


def test_findings_name_a_failure_of_auto():
    study = replace(STUDY, rows=(*ROWS, row("auto", "inaccurate", 0.02, "3", integrator="auto", step=None)))
    assert "auto reports success with an error above 0.001 m in 1 cell of 3." in " ".join(findings(study))
    assert [r.method for r in study.false_successes] == ["lagrange", "penalty", "auto"]


def test_every_false_success_is_explained():
    assert "constant step" in cause(ROWS[1])
    assert "penalty" in cause(ROWS[4])
    assert "branch" in cause(row("lagrange", "wrong branch", 1.0))
    assert "add up" in cause(row("auto", "inaccurate", 1.0, step=None))
    assert explained(ROWS[1]).startswith("lagrange with rk4, stiffness 2: error 0.002 m; ")


def test_planes_stay_out_of_the_list_and_the_map():
    plane = row("baumgarte", "inaccurate", 1.0, values=(1.0, 2.0), watched=False, family="alpha-beta")
    study = replace(STUDY, rows=(*ROWS, plane))
    assert plane not in study.false_successes
    assert "alpha-beta" not in Map.of(study).families


def test_findings_about_steps_gains_and_penalties():
    limits = tuple(
        Limit("four-bar", "damping", "1e4 N s/m", m, "rk4", h, h, 1.0)
        for m, h in (("lagrange", 0.01), ("penalty", 0.02), ("ggl", None))
    )
    gains = tuple(
        row("baumgarte", outcome, 1e-9, values=(a, a), family="alpha-beta", watched=False)
        for a, outcome in ((1e3, "ok"), (2.7e3, "ok"), (2.9e3, "diverged"), (5e3, "diverged"))
    )
    penalties = tuple(
        row("penalty", outcome, error, values=(a,), family="penalty-factor")
        for a, outcome, error in ((1e4, "inaccurate", 0.1), (1e8, "ok", 1e-5), (1e12, "ok", 1e-4))
    )
    found = " ".join(findings(replace(STUDY, rows=(*ROWS, *gains, *penalties), limits=limits)))
    assert "from 0.01 s (lagrange with rk4) to 0.02 s (penalty with rk4)" in found
    assert "up to |root| h = 2.7 are accurate and the first that is not has 2.9" in found
    assert "accurate for a = 1e+08 to 1e+12; smallest error 1.0e-05 m at a = 1e+08" in found


def told(*rows, models=("four-bar",), limits=()):
    return " ".join(findings(Stress(models, rows, limits, (), ())))


def test_findings_of_penalties_name_gaps_and_leave_out_runs_that_ended_early():
    early = {"note": "ended at t = 0.1 s", "status": "failed"}
    rows = [
        ("diverged", 1e-9, 1e2, early),
        ("ok", 1e-4, 1e4, {}),
        ("diverged", None, 1e6, early),
        ("ok", 1e-5, 1e8, {}),
    ]
    penalties = [
        row("penalty", outcome, error, values=(a,), family="penalty-factor", **more) for outcome, error, a, more in rows
    ]
    found = told(*penalties)
    assert "accurate for a = 10000 to 1e+08 but not for 1e+06; smallest error 1.0e-05 m at a = 1e+08." in found
    assert "accurate for a = 10000 alone;" in told(*penalties[:3])
    assert "accurate for none of the factors." in told(penalties[0], penalties[2])
    many = tuple(f"model-{i}" for i in range(4))
    judged = [replace(penalties[1], model=name) for name in many[:3]]
    assert "accurate on all models for a = 10000." in told(*judged, models=many)
    unjudged = replace(judged[0], model=many[3], outcome="unjudged", error=None)
    assert "accurate on all models that were judged for a = 10000." in told(*judged, unjudged, models=many)


def test_findings_do_not_count_cells_that_nobody_judged():
    assert "Stiffness: accurate in every case with every pair" in told(row("lagrange", "ok", 1e-6))
    found = told(row("lagrange", "ok", 1e-6), row("lagrange", "unjudged", None, "2"))
    assert "Stiffness: accurate in every case that was judged with every pair" in found


def test_findings_name_pairs_that_are_as_good():
    good, bad = (row(name, "ok", 1e-6) for name in "ab"), (row(name, "diverged", None) for name in "cde")
    found = told(*good, *bad)
    assert "Most often accurate was a with rk4: 1 of 1 cells, as often as 1 other pair." in found
    assert "0 of 1 cells, as often as 2 other pairs." in found
    alike = told(row("a", "ok", 1e-6), row("b", "ok", 1e-6))
    assert "All 2 pairs were accurate equally often: a with rk4 in 1 of 1 cells." in alike and "Most" not in alike
    assert "No run reports success with an error above 0.001 m, in 2 cells." in alike
    wrong = told(row("a", "inaccurate", 0.5))
    assert "Methods report success with an error above 0.001 m in 1 of 1 cells" in wrong


def test_findings_of_steps_name_pairs_without_any():
    def steps(*found):
        names = [("a", "b", "c")[i] for i in range(len(found))]
        limits = (Limit("four-bar", "damping", "1e4", m, "rk4", h, h, 1.0) for m, h in zip(names, found, strict=True))
        return told(limits=tuple(limits))

    assert "to 0.02 s (b with rk4); none was found with 1 pair." in steps(0.01, 0.02, None)
    assert "damping 1e4: 0.01 s with each of 2 pairs." in steps(0.01, 0.01)


def test_gains_none_of_which_is_accurate_first():
    rows = [
        row("baumgarte", outcome, 1e-9, values=(a, a), family="alpha-beta", watched=False)
        for a, outcome in ((1e3, "diverged"), (2e3, "ok"))
    ]
    assert "the cell of the smallest |root| h is not accurate, 1; rk4" in told(*rows)


def test_an_empty_study_has_no_findings():
    assert sentences.findings(Stress(("four-bar",), (), (), (), ())) == ()
