"""Twelve machines with modal bodies, swept past their marks: the record of `benchmarks.modal_limits`, made again."""

import pytest

from benchmarks import modal_limits
from benchmarks.modal_limits import MACHINES


def test_the_page_is_that_of_the_record_and_no_run_is_silent():
    table = modal_limits.stored()
    assert list(table) == list(MACHINES), "run python -m benchmarks.modal_limits"
    assert modal_limits.PAGE.read_text(encoding="utf-8") == modal_limits.page(table)
    for name, kinds in table.items():
        assert list(kinds) == (["linear", "stiffened"] if MACHINES[name].bars else ["linear"])
        for rows in kinds.values():
            assert [row.load for row in rows] == list(MACHINES[name].loads)
            assert not [row for row in rows if modal_limits.verdict(row) == "silent"], name
        errors = [row.error for row in kinds["linear"]]
        assert errors[0] < 0.007 and errors[-1] > 0.015 and kinds["linear"][-1].marked, name


@pytest.mark.by_turns(7)
@pytest.mark.slow
@pytest.mark.parametrize("name", MACHINES)
def test_a_machine_errs_as_the_record_says(name):
    """Errors to 2e-4, and the same marks."""
    for kind, recorded in modal_limits.stored()[name].items():
        for own, row in zip(modal_limits.rows_of(name, kind == "stiffened"), recorded, strict=True):
            assert own.error == pytest.approx(row.error, abs=2e-4) and own.marked == row.marked, (kind, own, row)
