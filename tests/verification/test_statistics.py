"""Statistics over random mechanisms: the same seed gives the same cases, and cells are quantiles of ratios."""

import json
import sys
from functools import partial
from random import Random

import pytest

from benchmarks import statistics
from benchmarks.records import measure
from benchmarks.statistics import (
    COUNT,
    SEEDS,
    Job,
    Measured,
    again,
    case_of,
    cells_of_ratios,
    examine,
    pairs_of,
    predictable,
)


def test_cells_are_quantiles_of_ratios_to_lagrange():
    base = Measured(1e-4, 1e-3, 1e-6, 1.0)
    others = [Measured(1e-4 / r, 1e-3 / r, 1e-8, 1.5) for r in (0.5, 1.0, 2.0, 4.0, 8.0)]
    count, low, middle, high, better, worse, mean, reactions, violations, seconds = cells_of_ratios(
        [(base, other) for other in others]
    )
    assert (count, middle, better, worse, mean) == ("5", "2", "60 %", "20 %", "2")
    assert (reactions, violations, seconds) == ("2", "100", "1.5")
    assert (float(low), float(high)) == pytest.approx((0.7, 6.4))


@pytest.mark.slow
def test_a_case_measures_a_method_against_its_reference():
    case, again = (case_of(2026, 1, 1.0) for _ in range(2))
    assert again.step == case.step and (again.distances.reference.q == case.distances.reference.q).all()
    coarse = case.run("direct-correction", "rk4")
    fine = case.run("direct-correction:weight=mass", "dop853")
    assert 0.0 < fine.error < 0.1 * coarse.error
    assert coarse.violation < 1e-9 and case.run("no-such-method", "rk4") is None


@pytest.mark.by_turns(2)
@pytest.mark.slow
def test_processes_give_the_lines_of_one_process_and_a_file_of_rows_gives_the_table(tmp_path, monkeypatch, capsys):
    jobs = [Job(2026, number) for number in range(3)]
    own = partial(examine, until=1.0, integrators=("rk4",), methods=("baumgarte",))
    rows = tmp_path / "rows.jsonl"
    lines = measure(own, jobs, rows, 60.0, 2)
    assert sorted(line_["number"] for line_ in lines) == [0, 1, 2] and any("runs" in line_ for line_ in lines)
    for line_ in lines:
        expected = own(Job(2026, line_["number"]))
        assert errors(line_) == pytest.approx(errors(expected), rel=1e-2)
    command = ["statistics", "--count", "3", "--seeds", "2026", "--methods", "baumgarte", "-o", str(rows)]
    monkeypatch.setattr(sys, "argv", command)
    monkeypatch.setattr(statistics, "case_of", None)  # nothing is measured again
    statistics.main()
    regular = sum(map(predictable, lines))
    assert f"seed 2026: {regular} regular of 3" in capsys.readouterr().out
    assert [json.loads(text) for text in rows.read_text(encoding="utf-8").splitlines()] == lines


def errors(line_):
    """Return the errors of a line."""
    runs = line_.get("runs") or {}
    return [numbers[0] for methods in runs.values() for numbers in methods.values()]


def test_the_record_has_the_sample_and_a_motion_that_no_method_follows_does_not_count():
    lines = statistics.RECORD.lines()
    assert {(line_["seed"], line_["number"]) for line_ in lines} == {(s, k) for k in range(COUNT) for s in SEEDS}
    lost = [line_ for line_ in lines if line_.get("runs") is not None and not predictable(line_)]
    assert lost and not pairs_of(lost, "rk4", "baumgarte")


@pytest.mark.by_turns(2)
@pytest.mark.slow
def test_a_line_measured_again_stands_beside_the_stored_one(monkeypatch):
    monkeypatch.setattr(statistics, "INTEGRATORS", ("rk4",))
    lines = (line_ for line_ in statistics.RECORD.lines() if predictable(line_) and "rk4" in line_["runs"])
    stored = next(line_ for line_ in lines if line_["runs"]["rk4"]["lagrange"][0] < 1e-3)
    pairs = list(again(stored, Random(1)))
    assert len(pairs) > 20 and all(pair.agree for pair in pairs)
    spoilt = json.loads(json.dumps(stored))
    spoilt["runs"]["rk4"]["velocity-projection"][0] *= 1.5
    assert [str(p).split(",")[3] for p in again(spoilt, Random(1)) if not p.agree] == [" velocity-projection"]
