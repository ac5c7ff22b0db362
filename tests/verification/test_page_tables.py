"""Tables of pages beside what is measured: numbers spoilt by hand are found, and a second writing changes nothing."""

import datetime
import random
import re

import pytest

from benchmarks.findings import TABLES
from benchmarks.page_tables import KEPT, ROOT, ROUNDING, agrees, cells_of, differences, drawn, markdown, place, written

NUMBER = re.compile(r"-?\d\.\d+e[-+]?\d+")


def text_of(table):
    return (ROOT / table.page).read_text(encoding="utf-8")


def printed(table):
    """The rows of a table as its page has them."""
    first, end = place(table, text_of(table))
    return [cells_of(line) for line in text_of(table).splitlines()[first + 2 : end]]


@pytest.mark.parametrize("table", TABLES, ids=lambda table: table.command)
def test_a_page_has_the_table_with_its_headings_and_rows(table):
    assert not list(differences(table, text_of(table), dict(enumerate(printed(table)))))
    for (names, _), row in zip(table.rows, printed(table), strict=True):
        assert row[: len(names)] == list(names)


def test_ten_numbers_spoilt_by_hand_are_found_with_page_and_line():
    spoilt, dice = dict[tuple[str, int], str](), random.Random(54)
    while len(spoilt) < 10:
        table = dice.choice(TABLES)
        first, end = place(table, text_of(table))
        lines = text_of(table).splitlines()
        number = dice.randrange(first + 2, end)
        numbers = [m for m in NUMBER.finditer(lines[number]) if abs(float(m[0])) > ROUNDING]
        if not numbers or (table.page, number + 1) in spoilt:
            continue
        match = dice.choice(numbers)
        mantissa, power = match[0].split("e")
        wrong = f"{float(mantissa) + 0.3:.1f}e{power}"
        lines[number] = lines[number][: match.start()] + wrong + lines[number][match.end() :]
        spoilt[table.page, number + 1] = wrong
        found = list(differences(table, "\n".join(lines), dict(enumerate(printed(table)))))
        assert [(f.page, f.line) for f in found] == [(table.page, number + 1)]
        assert wrong in found[0].printed and match[0] in found[0].measured
        assert f"{table.page}:{number + 1}" in str(found[0])


@pytest.mark.parametrize(
    ("one", "other", "time", "same"),
    [
        ("1.6e-3 (1.0)", "1.7e-3 (1.0)", False, True),  # one unit of the last digit
        ("1.6e-3 (1.0)", "1.8e-3 (1.0)", False, False),
        ("1.6e-3 (1.0)", "1.6e-3 (1.2)", False, False),
        ("2e-15", "7.0e-14", False, True),  # rounding
        ("2e-15", "1.0e-9", False, False),
        ("14 of 20", "13 of 20", False, False),  # counts
        ("1,394", "1394", False, True),
        ("ok", "failed", False, False),
        ("1.08", "1.9", True, True),  # times by a band
        ("1.08", "2.3", True, False),
        ("1.08", KEPT, True, True),
        ("-6.4e-6", "6.4e-6", False, False),
        ("1.0e-3", "nan", False, False),
    ],
)
def test_cells_compare_by_kind(one, other, time, same):
    assert agrees(one, other, time) is same


def test_writing_again_changes_nothing_and_a_change_gets_the_date():
    table = TABLES[0]
    rows, text = printed(table), text_of(table)
    assert written(table, text, rows, "2031-01-02") == text
    other = [list(row) for row in rows]
    other[0][3] = "9.9e-1 (1.0)"
    once = written(table, text, other, "2031-01-02")
    assert once.count("*Measured on 2031-01-02") == 1 and "9.9e-1 (1.0)" in once
    assert written(table, once, other, "2032-01-02") == once
    # all lines but the row and the date are those of the page
    changed = [(a, b) for a, b in zip(text.splitlines(), once.splitlines(), strict=True) if a != b]
    assert len(changed) == 2


def test_a_table_is_what_is_written():
    lines = markdown(("a", "b"), [["", r"\|Phi\|"], ["x", "2"]])
    assert lines[0] == "| a | b |" and [cells_of(line) for line in lines[2:]] == [["", r"\|Phi\|"], ["x", "2"]]


@pytest.mark.slow  # measures: a tenth of all cells, others on another day
def test_a_tenth_of_the_cells_is_measured_again():
    chosen = drawn(TABLES, 0.1, datetime.datetime.now(tz=datetime.UTC).date().toordinal())
    assert len(chosen) >= 3
    found = []
    for table, number in chosen:
        names, measure = table.rows[number]
        found += differences(table, text_of(table), {number: [*names, *measure()]})
    assert not found, "\n".join(map(str, found))
