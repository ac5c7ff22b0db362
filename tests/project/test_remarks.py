"""Who says what is known of a model: the page is the stored table, the table is what happens, and nobody is silent."""

import pytest

from benchmarks import remarks
from symgen.run.compiling.folders import generator_digest

#: Another one of so many parts of the table is computed again at each state of the sources.
TURNS = 40


def test_the_page_is_the_stored_table() -> None:
    table = remarks.stored()
    assert list(table) == list(remarks.REMARKS), "run python -m benchmarks.remarks"
    assert all(list(table[each]) == remarks.asked(each) for each in table)
    assert remarks.PAGE.read_text(encoding="utf-8") == remarks.page(table), "run python -m benchmarks.remarks"


def test_nobody_is_silent() -> None:
    """What is known of a model reaches the reader of each result, or the result is refused, or says what it leaves."""
    for remark, row in remarks.stored().items():
        silent = [consumer for consumer, said in row.items() if said == remarks.SILENT]
        assert not silent, (remark, silent)
        assert sum(said in (remarks.SAYS, remarks.UNJUDGING) for said in row.values()) >= len(row) - 4, remark


@pytest.mark.slow
def test_the_table_is_what_happens() -> None:
    table, turn = remarks.stored(), int(generator_digest(), 16)
    cells = [(remark, consumer) for remark in table for consumer in table[remark]]
    own = cells[turn % TURNS :: TURNS]
    assert {cell: remarks.cell(*cell) for cell in own} == {(r, c): table[r][c] for r, c in own}
