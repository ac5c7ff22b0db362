"""Statistics over random mechanisms: the same seed gives the same cases, and cells are quantiles of ratios."""

import json
import sys

import pytest

from benchmarks import statistics
from benchmarks.statistics import Job, Measured, case_of, examine, line, measured


def test_cells_are_quantiles_of_ratios_to_lagrange():
    base = Measured(1e-4, 1e-3, 1e-6, 1.0)
    others = [Measured(1e-4 / r, 1e-3 / r, 1e-8, 1.5) for r in (0.5, 1.0, 2.0, 4.0, 8.0)]
    count, low, middle, high, better, worse, mean, reactions, violations, seconds = line(
        [(base, other) for other in others]
    )
    assert (count, middle, better, worse, mean) == ("5", "2", "60 %", "20 %", "2")
    assert (reactions, violations, seconds) == ("2", "100", "1.5")
    assert (float(low), float(high)) == pytest.approx((0.7, 6.4))


def test_a_case_measures_a_method_against_its_reference():
    case, again = (case_of(2026, 1, 1.0) for _ in range(2))
    assert again.step == case.step and (again.distances.reference.q == case.distances.reference.q).all()
    coarse = case.run("direct-correction", "rk4")
    fine = case.run("direct-correction:weight=mass", "dop853")
    assert 0.0 < fine.error < 0.1 * coarse.error
    assert coarse.violation < 1e-9 and case.run("no-such-method", "rk4") is None


def test_processes_give_the_lines_of_one_process_and_a_file_of_rows_gives_the_table(tmp_path, monkeypatch, capsys):
    jobs = [Job(2026, index, 1.0, ("rk4",), ("baumgarte",)) for index in range(3)]
    own = {job.index: examine(job) for job in jobs}
    for line_ in measured(jobs, 2, 60.0):
        expected = own[line_["index"]]
        assert untimed(line_) == untimed(expected)
    assert any("runs" in line_ for line_ in own.values()) and not list(measured(jobs, 1, 0.0))
    rows = tmp_path / "rows.jsonl"
    rows.write_text("".join(json.dumps(line_) + "\n" for line_ in own.values()), encoding="utf-8")
    command = ["statistics", "--count", "3", "--seeds", "2026", "--methods", "baumgarte", "-o", str(rows)]
    monkeypatch.setattr(sys, "argv", command)
    monkeypatch.setattr(statistics, "examine", None)  # nothing is measured again
    statistics.main()
    regular = sum("runs" in line_ for line_ in own.values())
    assert f"seed 2026: {regular} regular of 3" in capsys.readouterr().out
    assert len(rows.read_text(encoding="utf-8").splitlines()) == 3


def untimed(line_):
    """Return a line without its run times."""
    runs = [{k: x for k, x in run.items() if k != "seconds"} for run in line_.get("runs", ())]
    return {**line_, "runs": runs}
