"""What becomes of a run, told from constructed facts; the search for the largest step; the map and the findings."""

import json
import math
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

from study.report.made import stress_row
from symgen.study.runner import Cell, Status
from symgen.study.stress import study_progress
from symgen.study.stress.cell_outcome import ACCURATE, OUTCOMES, CellRun, classify_outcome, false_success
from symgen.study.stress.findings import cause_of_failure, explain_failures, findings_of_study, largest_root
from symgen.study.stress.searches import largest_steps
from symgen.study.stress.stress_rows import Map, Stress
from symgen.study.stress.study_progress import Whole, expected_work, with_first_cells

REGULAR = np.ones(11)
FLAT = np.array([1.0, 0.8, 0.5, 0.3, 0.1, 0.05, 0.2, 0.4, 0.6, 0.8, 1.0])
GOOD = CellRun(True, np.full(11, 1e-6), REGULAR, 0.0, 2.0)
SMALL, LARGE = np.linspace(0.0, 0.05, 11), np.linspace(0.0, 5.0, 11)
#: On the reference until output 5, elsewhere from then on.
JUMP = np.array([0.0] * 5 + [1.0] * 6)


@pytest.mark.parametrize(
    ("changes", "outcome"),
    [
        ({}, "ok"),
        ({"errors": np.full(11, 2.0 * ACCURATE)}, "ok"),  # of a length of 2 m
        ({"errors": np.full(11, 2.0 * ACCURATE * 1.001)}, "inaccurate"),
        ({"errors": np.full(11, ACCURATE), "length": 0.9}, "inaccurate"),
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
    ],
)
def test_outcomes(changes, outcome):
    assert classify_outcome(replace(GOOD, **changes)) == outcome
    assert outcome in OUTCOMES


def test_a_run_is_not_believed():
    for outcome in OUTCOMES:
        wrong = outcome in ("inaccurate", "wrong branch", "singular", "diverged")
        assert false_success("ok", outcome) is wrong
        assert not false_success("unverified", outcome) and not false_success("failed", outcome)


def power(limit, order=4.0, beyond=math.inf):
    """Return errors that follow a power of the step, 1e-3 at a limit, and fail beyond a step; and the steps tried."""
    tried = []

    def error(step):
        tried.append(step)
        return 1e-3 * (step / limit) ** order if step <= beyond else math.inf

    return error, tried


@pytest.mark.parametrize("limit", [3e-6, 0.9e-3, 1.1e-3, 0.02, 0.7])
@pytest.mark.parametrize(("order", "beyond"), [(1.0, math.inf), (4.0, math.inf), (4.0, 1.0), (0.1, math.inf)])
def test_the_largest_step_is_found_within_a_percent_or_so(limit, order, beyond):
    """`beyond` is a multiple of the limit: all steps that do not fail are within it."""
    found = []
    for factor in (math.inf, 1.0, 0.6, 1.9):
        error, tried = power(limit, order, beyond * limit)
        (step,) = largest_steps(error, 1e-3, 1.0, factor * limit, [1e-3])
        assert limit / 1.012 < step <= limit * (1.0 + 1e-12)
        assert len(tried) == len(set(tried)) < 25
        found.append(step)
    assert found == [found[0]] * 4, "to the last digit the same"


def test_errors_that_follow_a_power_of_the_step_tell_where_the_limit_is():
    error, tried = power(3e-6)
    largest_steps(error, 1e-3, 1.0, math.inf, [1e-3])
    smallest = min(tried)
    assert sum(step <= 3e-6 for step in tried) <= 2 and smallest > 2e-6, "no step far below, each of which is long"
    error, tried = power(3e-6)
    both = largest_steps(error, 1e-3, 1.0, math.inf, [0.1, 1e-3])
    assert sum(step <= 1e-5 for step in tried) <= 5 and both[0] == pytest.approx(3e-6 * 100**0.25, rel=0.012)


def test_a_search_from_where_the_limit_is_expected_tries_few_steps_within():
    error, tried = power(3e-6, 0.0, 3e-6)
    largest_steps(error, 1e-3, 1.0, 3e-6, [1e-3])
    assert len(tried) == 2 and sum(step <= 3e-6 for step in tried) == 1
    near = [largest_steps(error, 1e-3, 1.0, at, [1e-3], halvings=4) for at in (5e-6, math.inf)]
    assert near[0] == near[1] and 3e-6 / 1.1 < near[0][0] <= 3e-6


def test_no_step_below_the_smallest_is_tried():
    error, tried = power(3e-6)
    assert largest_steps(error, 1e-3, 1.0, math.inf, [1e-3], smallest=5e-6) == [None]
    assert 5e-6 < min(tried) < 5.1e-6
    assert largest_steps(error, 1e-3, 1.0, 1e-4, [1e-3], smallest=2e-6) == largest_steps(
        error, 1e-3, 1.0, math.inf, [1e-3]
    )
    assert largest_steps(error, 1e-3, 1.0, math.inf, [1e-3], smallest=2.0) == [None], "only the largest was tried"


def test_what_is_accurate_is_stable_beyond_a_step_that_is_not():
    def error(step):
        return 1e-4 if step < 2e-5 or 4e-5 < step < 8e-5 else math.inf if step > 8e-5 else 0.5

    for expected in (2e-5, 7e-5, math.inf):
        stable, accurate = largest_steps(error, 1e-3, 1.0, expected, [0.1, 1e-3])
        assert stable >= accurate and any(limit / 1.012 < accurate < limit for limit in (2e-5, 8e-5))


def test_no_largest_step():
    for expected in (math.inf, 1e-4, 1e-9):  # the last is below the scan
        assert largest_steps(lambda step: 0.0, 1e-3, 1.0, expected, [1e-3]) == [1.0]
        assert largest_steps(lambda step: math.inf, 1e-3, 1.0, expected, [0.1, 1e-3]) == [None, None]


def test_roots_of_the_feedback():
    for alpha, beta in ((5.0, 5.0), (7.0, 3.0), (2.0, 9.0), (0.0, 4.0)):
        expected = max(abs(np.roots([1.0, 2.0 * alpha, beta**2])))
        assert largest_root(alpha, beta) == pytest.approx(expected, rel=1e-6)


def row(method, outcome, error, case="1", **changes):
    return stress_row("four-bar", method, outcome, error, case=case, **changes)


ROWS = (
    row("lagrange", "ok", 1e-6),
    row("lagrange", "inaccurate", 2e-3, "2", verified="unverified"),
    row("penalty", "diverged", None, "2", status="failed"),
    row("penalty", "too slow", None, "3", status="not run"),
    row("penalty", "inaccurate", 0.5, "4", position_violation_max=1e-7, verified="ok"),
    row("auto", "ok", 1e-6, integrator="auto", step=None),
    row("auto", "refused", None, "2", integrator="auto", step=None, status="not run"),
)
STUDY = Stress(("four-bar",), ROWS, (), (), ())


def test_the_map_sums_up():
    shown = Map.of_study(STUDY)
    assert shown.lines == (("lagrange", "rk4"), ("penalty", "rk4"), ("auto", "auto"))
    assert [shown.entry(line, "stiffness").text for line in shown.lines] == ["1/2 i", "0/3 idt", "1/1 r"]


def test_findings_say_what_the_rows_say():
    found = " ".join(findings_of_study(STUDY))
    assert "Of 7 cells of the map 2 ok, 2 inaccurate, 1 diverged, 1 too slow and 1 refused." in found
    assert "auto (1 of 1)" not in found  # beside methods with three cells
    assert (
        "1 of 3 pairs are accurate in every case that was judged (auto); hardest: 2 on four-bar and 2 others" in found
    )
    assert "auto reports success with an error above 0.001 of the length in no cell of 2." in found
    assert (
        "Methods chosen by name report success with an error above 0.001 of the length in 2 of 5 cells, in 1 of these "
        "with --verify too: 1 because" in found
    )
    study = replace(STUDY, rows=(*ROWS, row("auto", "inaccurate", 0.02, "3", integrator="auto", step=None)))
    assert "auto reports success with an error above 0.001 of the length in 1 cell of 3." in " ".join(
        findings_of_study(study)
    )
    assert [r.method for r in study.false_successes] == ["lagrange", "penalty", "auto"]


def test_every_false_success_is_explained():
    assert "constant step" in cause_of_failure(ROWS[1])
    assert "penalty" in cause_of_failure(ROWS[4])
    assert "branch" in cause_of_failure(row("lagrange", "wrong branch", 1.0))
    assert "add up" in cause_of_failure(row("auto", "inaccurate", 1.0, step=None))
    assert explain_failures(ROWS[1]).startswith("lagrange with rk4, stiffness 2: error 0.002 m; ")


def test_planes_stay_out_of_the_list_and_the_map():
    plane = row("baumgarte", "inaccurate", 1.0, values=(1.0, 2.0), watched=False, family="alpha-beta")
    study = replace(STUDY, rows=(*ROWS, plane))
    assert plane not in study.false_successes
    assert "alpha-beta" not in Map.of_study(study).families


def test_cells_that_nobody_judged_count_nothing():
    unjudged = row("lagrange", "unjudged", None, "2")
    found = findings_of_study(Stress(("four-bar",), (row("lagrange", "ok", 1e-6), unjudged), (), (), ()))
    assert "Stiffness: accurate in every case that was judged with every pair of method and integrator." in found


def test_an_empty_study_has_no_findings():
    assert findings_of_study(Stress(("four-bar",), (), (), (), ())) == ()


def test_progress_counts_all_parts_and_what_a_journal_had_is_no_work():
    seen = []
    first, second = ([Cell(f"{part}{i}", "", None, cost) for i in range(2)] for part, cost in (("a", 1.0), ("b", 3.0)))
    whole = Whole.of_study([*first, *second], lambda what, status: seen.append((what, status)))
    show = whole.begin_part("first", first)
    show(Status(1, 2, 0.5, None))
    show(Status(2, 2, 1.0, 0.0))
    whole.begin_part("second", second)(Status(0, 2, 0.0, None))
    assert [(what, status.done, status.total, status.share) for what, status in seen] == [
        ("first", 1, 4, 0.125),
        ("first", 2, 4, 0.25),
        ("second", 2, 4, 0.25),
    ]
    assert seen[0][1].seconds_left is None, "nothing was computed yet"
    spent = seen[1][1].seconds_left / 6.0  # one of seven parts of the work, six remain
    assert 0.0 < spent < 60.0


#: Cells of two quick studies: kind, group, integrator, steps, and processor time [ms] beside other work.
MEASURED = json.loads((Path(__file__).parents[1] / "data" / "stress_seconds.json").read_text(encoding="utf-8"))


@pytest.mark.parametrize("speed", [0.2, 1.0, 7.0])
@pytest.mark.parametrize("model", MEASURED)
def test_the_time_left_is_right_within_a_factor_of_one_and_a_half(model, speed, monkeypatch):
    """From a tenth of the time on, by a clock that goes on as cells took their time, on machines of any speed."""
    now = [0.0]
    monkeypatch.setattr(study_progress, "time", SimpleNamespace(monotonic=lambda: now[0]))

    def longer(kind, integrator):
        if kind == "run":
            own = integrator not in ("rk4", "auto", "radau5")
            return study_progress.FIRST_SCHEME if own else study_progress.FIRST_RUN
        return study_progress.FIRST_REFERENCE if kind == "reference" else 0.0

    parts = {kind: [line for line in MEASURED[model] if line[0] == kind] for kind in ("reference", "run", "search")}
    cells = {
        kind: with_first_cells(
            (Cell(f"{kind}{i}", group, None, expected_work(kind, steps, integrator)), longer(kind, integrator))
            for i, (_, group, integrator, steps, _) in enumerate(lines)
        )
        for kind, lines in parts.items()
    }
    seen, total = [], speed * sum(line[-1] for line in MEASURED[model]) / 1e3
    whole = Whole.of_study([cell for own in cells.values() for cell in own], lambda _, status: seen.append(status))
    for kind, lines in parts.items():
        show, work, done = whole.begin_part(kind, cells[kind]), sum(cell.cost for cell in cells[kind]), 0.0
        show(Status(0, len(lines), 0.0, None))
        for i, (cell, line) in enumerate(zip(cells[kind], lines, strict=True), 1):
            now[0] += speed * line[-1] / 1e3
            done += cell.cost
            show(Status(i, len(lines), done / work, None))
            if 0.1 <= now[0] / total <= 0.9:
                assert 1.0 / 1.5 < seen[-1].seconds_left / (total - now[0]) < 1.5
    assert seen[-1].share == pytest.approx(1.0) and seen[-1].seconds_left == pytest.approx(0.0, abs=1e-9)
