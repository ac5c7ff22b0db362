"""Run times at equal errors: cells are medians of a study, and the record has every method at both errors."""

from random import Random

import pytest

from benchmarks import equal_error
from benchmarks.equal_error import ERRORS, METHODS, Job, again, examine, jobs, page_table, ratio, studies


@pytest.mark.parametrize(
    ("cell", "text"), [([1e-3, 0.5, 0.4, 0.6], "0.50"), ([1e-3, 14.4, 9, 20], "14"), ([None] * 4, "")]
)
def test_a_cell_is_a_ratio(cell, text):
    assert ratio(cell) == text


@pytest.mark.by_turns(2)
@pytest.mark.slow
def test_a_study_has_a_time_of_every_method_at_both_errors(monkeypatch):
    monkeypatch.setitem(equal_error.MECHANISMS, "four-bar", (4.0, 2.0, 1.6e-2))
    chosen = ("lagrange", "direct-correction:weight=mass")
    at = examine(Job("four-bar", "rk4"), chosen)["at"]
    assert set(at) == set(chosen)
    assert all(len(both) == len(ERRORS) and all(cell[1] > 0.0 for cell in both) for both in at.values())
    assert all(cell[1:] == [1.0, 1.0, 1.0] for cell in at["lagrange"])
    # another method than the stored one: the numbers stand beside those measured
    monkeypatch.setattr(equal_error, "METHODS", chosen)
    stored = {"mechanism": "four-bar", "integrator": "rk4", "session": 2, "at": {chosen[1]: [[1e-3, 50.0, 1, 1]] * 2}}
    assert [pair.agree for pair in again(stored, Random(1))] == [False, False]


def test_the_record_has_every_study_and_the_table_its_rows():
    assert set(studies()) == set(jobs())
    table = page_table()
    assert len(table.rows) == sum(job.session == 2 for job in jobs())
    assert all(len(row) == 2 + len(METHODS) - 1 for row in table.measured())
