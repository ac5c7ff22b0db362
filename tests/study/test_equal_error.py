"""Run time at an error, and the front of error and run time."""

import math
from dataclasses import replace

import pytest

import symgen
from study.report import made
from symgen.base.errors import InputError
from symgen.cli._comparison_tables import show_study
from symgen.study.comparison.combinations import Combinations
from symgen.study.comparison.equal_error import pareto_front, time_at_error, times_at
from symgen.study.journal import Journal
from symgen.study.report.kinds.comparison_report import comparison_report


def line(method, errors, **changes):
    return [made.row(method, 1e-3 / 2**k, e, 1.0, **changes) for k, e in enumerate(errors)]


def test_times_between_settings_lie_on_a_power_law():
    """Fourth order: a tenth of the error takes 10^(1/4) times the time, between the settings as at them."""
    points = [(16.0**-k, 2.0**k) for k in range(6)]
    for error in (1e-1, 1e-3, 1e-6):
        assert time_at_error(points, error) == pytest.approx(error**-0.25)
    assert time_at_error(points, 16.0**-2) == pytest.approx(4.0)
    assert time_at_error(points, 2.0) is None and time_at_error(points, 1e-9) is None


def test_ratios_are_taken_within_rounds():
    """The load doubles all times of the second round: times spread, ratios do not."""
    errors = [1e-3, 1e-5, 1e-7]
    rows = [*line("lagrange", errors), *line("direct-correction", errors)]
    seconds = [1.0, 2.0, 4.0, 1.5, 3.0, 6.0]
    base, other = times_at(rows, [seconds, [2.0 * s for s in seconds], seconds], [1e-6])
    assert base.seconds == pytest.approx(math.sqrt(8.0)) and base.seconds_high > base.seconds_low
    assert (other.ratio, other.ratio_low, other.ratio_high) == pytest.approx((1.5, 1.5, 1.5))


def test_rows_without_a_resolved_error_are_no_points():
    rows = [*line("lagrange", [1e-3, 1e-7]), made.row("lagrange", 1e-4, None, 1.0, status="failed", reason="")]
    rows += line("penalty", [1e-3, 1e-9], below_reference=True)
    known, unknown = times_at(rows, [[1.0, 2.0, None, 1.0, 2.0]], [1e-5])
    assert known.seconds == pytest.approx(math.sqrt(2.0)) and unknown.seconds is None and unknown.ratio is None
    assert known.reason == "" and unknown.reason == "all of its errors are below that of the reference"


def test_a_line_without_a_time_says_which_way_to_go():
    rows = [*line("lagrange", [1e-3, 1e-5]), made.row("penalty", 1e-3, None, 1.0, status="failed", reason="")]
    rows += [*line("baumgarte", [1e-6]), made.row("baumgarte", 1e-4, 1e-12, 1.0, below_reference=True)]
    seconds = [[1.0] * len(rows)]
    fine, failed, floor = times_at(rows, seconds, [1e-7])
    assert fine.reason == "its smallest error is 1e-05 m; finer steps reach it"
    assert failed.reason == "no run reached its end with an error"
    assert floor.reason == "its smallest error is 1e-06 m; finer ones are below the error of the reference"
    assert times_at(rows, seconds, [1e-2])[0].reason == "its largest error is 0.001 m; coarser steps reach it"


def test_the_front_is_what_none_surpasses():
    rows = [made.row("a", 1e-3, e, t) for e, t in ((1e-3, 1.0), (1e-5, 2.0), (1e-4, 3.0), (1e-9, 4.0), (1e-12, 5.0))]
    assert pareto_front(rows, 1e-14) == {0, 1, 3, 4}
    assert pareto_front(rows, 1e-8) == {0, 1, 3}
    assert pareto_front([made.row("a", 1e-3, None, 0.1, status="failed", reason="")], 1e-8) == frozenset()


@pytest.mark.by_turns(2)
@pytest.mark.slow
def test_a_study_interpolates_times_of_all_its_lines(tmp_path, capsys):
    """The second study reads all rows and rounds from the journal, and so has the same times."""
    arguments = ["pendulum", ["lagrange", "direct-correction"], ["rk4", "dop853"]]
    with Journal(tmp_path / "rows.journal") as journal:
        study = symgen.compare(*arguments, until=1.0, repeat=1, error_at=[1e-9, 1e-10], journal=journal)
        again = symgen.compare(*arguments, until=1.0, repeat=1, error_at=[1e-9, 1e-10], journal=journal)
    assert again.at == study.at and len(study.at) == 8
    for time in study.at:
        assert 0.0 < time.seconds_low <= time.seconds <= time.seconds_high
        assert 0.0 < time.ratio_low <= time.ratio <= time.ratio_high
        assert time.method != "lagrange" or time.ratio == 1.0
    for label in ("lagrange", "direct-correction"):
        assert len({r.step for r in study.rows if r.label == label and r.step}) == 6
        assert len({r.rtol for r in study.rows if r.label == label and r.rtol}) == 9
    show_study(study)
    text = capsys.readouterr().out
    assert "time / lagrange" in text and "CPU [ms]" in text and "^ on the front" in text
    # run times by evaluations: a busy machine decides which rows are on the front otherwise
    paced = replace(study, rows=tuple(replace(row, run_seconds=1e-7 * row.evaluations) for row in study.rows))
    section = next(part for part in comparison_report([paced]).sections if part.title == "pendulum")
    more = section.parts[0]
    assert [section.pictures[0].name, more.pictures[0].name] == ["pendulum-front", "pendulum-ratio"]
    assert any(table.caption.startswith("CPU time at an error") for table in more.tables)


def test_a_line_of_few_settings_is_refused():
    with pytest.raises(InputError, match="at least 6 values"):
        Combinations(["lagrange"], ["rk4"], [1e-3, 5e-4], error_at=[1e-6])
    assert Combinations(["lagrange"], ["rk4"], [1e-3, 5e-4]).error_at == ()
