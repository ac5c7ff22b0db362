"""Tables of pages beside what is measured: numbers spoilt by hand are found, and a second writing changes nothing."""

import random
import re

import pytest
from support.rotation import number_of_turn

from benchmarks.code_of_times import code_of_times, loops_of, text_of_loop, texts
from benchmarks.findings import TABLES, measured_tables
from benchmarks.page_tables import (
    BAND,
    DECADE,
    KEPT,
    ROOT,
    ROUNDING,
    PageTable,
    agrees,
    cells_of,
    differences,
    drawn,
    is_older,
    is_stale,
    markdown,
    missing,
    place,
    two_digits,
    written,
)
from benchmarks.records import NAMES, Pair, Record, record_of, shortened
from symgen.run.integrators import INTEGRATORS

#: Tables that are measured, run times among them, and those that follow from records.
MEASURED = [table for table in measured_tables(times=True) if not table.stored]
TIMED = [table for table in MEASURED if table.times]
STORED = [table for table in TABLES if table.stored]
NUMBER = re.compile(r"-?\d\.\d+e[-+]?\d+")


def text_of(table):
    return (ROOT / table.page).read_text(encoding="utf-8")


def study_of(table):
    return (ROOT / table.study).read_text(encoding="utf-8")


def printed(table):
    """The rows of a table as its page has them."""
    first, end = place(table, text_of(table))
    return [cells_of(line) for line in text_of(table).splitlines()[first + 2 : end]]


@pytest.mark.parametrize("table", TABLES, ids=lambda table: f"{table.page} {table.command}")
def test_a_page_has_the_table_with_its_headings_and_rows(table):
    assert not list(differences(table, text_of(table), dict(enumerate(printed(table)))))
    for (names, _), row in zip(table.rows, printed(table), strict=True):
        assert row[: len(names)] == list(names)


@pytest.mark.slow_cases("docs/tables/random-mechanisms.md statistics", "docs/tables/equal-work.md equal_work")
@pytest.mark.parametrize("table", STORED, ids=lambda table: f"{table.page} {table.command}")
def test_a_table_of_a_record_and_its_sentences_are_those_of_the_page(table):
    for row, own in zip(printed(table), table.measured(), strict=True):
        assert all(cell in (shown, KEPT) for shown, cell in zip(row, own, strict=True))
    assert not missing(table, study_of(table))


def test_a_digit_of_a_sentence_spoilt_by_hand_is_missing():
    table = next(table for table in STORED if table.command == "equal_error")
    claim = next(iter(table.claims()))
    spoilt = re.sub(r"0\.\d\d", "0.01", claim, count=1)
    assert spoilt != claim
    assert missing(table, study_of(table).replace(claim, spoilt)) == [claim]


@pytest.mark.parametrize("page", sorted((ROOT / "docs/findings").glob("*.md")), ids=lambda page: page.stem)
def test_a_study_is_a_page_of_600_words_with_a_figure_at_most_and_a_command(page):
    text = page.read_text(encoding="utf-8")
    assert len(re.findall(r"[^\s|]*\w[^\s|]*", text)) <= 600
    assert text.count("![") <= 1
    assert page.stem == "README" or "`python -m benchmarks." in text


def test_ten_numbers_spoilt_by_hand_are_found_with_page_and_line():
    spoilt, dice = dict[tuple[str, int], str](), random.Random(54)
    while len(spoilt) < 10:
        table = dice.choice(MEASURED)
        first, end = place(table, text_of(table))
        lines = text_of(table).splitlines()
        number = dice.randrange(first + 2, end)
        numbers = [m for m in NUMBER.finditer(lines[number]) if abs(float(m[0])) > ROUNDING]
        if not numbers or (table.page, number + 1) in spoilt:
            continue
        match = dice.choice(numbers)
        mantissa, power = match[0].split("e")
        column = len(cells_of(lines[number][: match.start()] + "|")) - 1
        wrong = f"{float(mantissa) + 0.3:.1f}e{int(power) + 2 * (column in table.loose)}"
        lines[number] = lines[number][: match.start()] + wrong + lines[number][match.end() :]
        spoilt[table.page, number + 1] = wrong
        found = list(differences(table, "\n".join(lines), dict(enumerate(printed(table)))))
        assert [(f.page, f.line) for f in found] == [(table.page, number + 1)]
        assert wrong in found[0].printed and match[0] in found[0].measured
        assert f"{table.page}:{number + 1}" in str(found[0])


@pytest.mark.parametrize("table", TIMED, ids=lambda table: table.command)
def test_a_stale_time_is_found_with_page_and_line(table):
    first, end = place(table, text_of(table))
    for number in range(first + 2, end):
        lines = text_of(table).splitlines()
        cells = cells_of(lines[number])
        for column in table.times:
            own = list(cells)
            times = re.search(r"\d+\.?\d*", own[column])
            if times is None:
                continue
            own[column] = own[column].replace(times[0], f"{4.0 * float(times[0]):.3g}", 1)
            lines[number] = "| " + " | ".join(own) + " |"
            (found,) = differences(table, "\n".join(lines), dict(enumerate(printed(table))))
            assert (found.page, found.line) == (table.page, number + 1) and found.measured == cells[column]


def test_a_page_keeps_times_that_a_quiet_machine_repeats():
    table = next(table for table in TIMED if table.command == "literature classes")
    rows = printed(table)
    for factor, kept in ((1.1, True), (1.2, False)):
        again = [[*row[:2], f"{factor * float(row[2]):.2f}", *row[3:]] for row in rows]
        assert (written(table, text_of(table), again, "2031-01-02") == text_of(table)) is kept


@pytest.mark.parametrize(
    ("one", "other", "band", "same"),
    [
        ("1.6e-3 (1.0)", "1.7e-3 (1.0)", 0.0, True),  # one unit of the last digit
        ("1.6e-3 (1.0)", "1.8e-3 (1.0)", 0.0, False),
        ("1.6e-3 (1.0)", "1.6e-3 (1.2)", 0.0, False),
        ("2e-15", "7.0e-14", 0.0, True),  # rounding
        ("2e-15", "1.0e-9", 0.0, False),
        ("14 of 20", "13 of 20", 0.0, False),  # counts
        ("1,394", "1394", 0.0, True),
        ("ok", "failed", 0.0, False),
        ("1.08", "1.2", BAND, True),  # times by a band
        ("1.08", "1.3", BAND, False),
        ("2.0, 2.8, 4.4", "1.8, 2.6, -", BAND, True),
        ("2.0, 2.8, 4.4", "2.0, 2.8, 3.7", BAND, False),
        ("2.0, 2.8, 4.4", "2.0, 2.8", BAND, False),
        ("1.08", KEPT, BAND, True),
        ("1e-3", "2e-6", 0.0, False),  # one digit of other sizes
        ("9.9e-8", "1.0e-7", 0.0, True),
        ("1e-3, 2e-7", "5e-3, 3e-8", DECADE, True),  # rounding decides
        ("1e-3, 2e-7", "5e-3, 3e-6", DECADE, False),
        ("2e-14", "8e-13", DECADE, True),
        ("-6.4e-6", "6.4e-6", 0.0, False),
        ("1.0e-3", "nan", 0.0, False),
    ],
)
def test_cells_compare_by_kind(one, other, band, same):
    assert agrees(one, other, band) is same


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


@pytest.mark.slow  # measures: a row or two in a turn
def test_some_of_the_cells_are_measured_again():
    chosen = drawn(MEASURED, 1 / 150, number_of_turn())
    assert chosen
    found = []
    for table, number in chosen:
        names, measure = table.rows[number]
        found += differences(table, text_of(table), {number: [*names, *measure()]})
    assert not found, "\n".join(map(str, found))


@pytest.mark.by_turns(10)
@pytest.mark.parametrize("name", [name for name in NAMES if record_of(name).lines()])
@pytest.mark.slow  # measures: a part of a share of the lines, others in another turn
def test_drawn_lines_of_a_record_are_measured_again(name):
    found = list(record_of(name).differences(number_of_turn()))
    assert not found, "\n".join(found)


@pytest.mark.parametrize(
    ("pair", "agree"),
    [
        (Pair("", "ok", "ok"), True),
        (Pair("", 3, 4), False),
        (Pair("", 1.6e-4, 1.7e-4), True),  # two digits
        (Pair("", 1.6e-4, 1.9e-4), False),
        (Pair("", 1.6e-4, 1.9e-4, 2.0), True),
        (Pair("", 1.6e-9, 1.9e-10, floor=1e-8), True),
        (Pair("", 1.6e-4, None), False),
        (Pair("", 1.0, -1.0), False),
    ],
)
def test_numbers_of_records_compare_by_kind(pair, agree):
    assert pair.agree is agree


@pytest.mark.parametrize(("others", "named"), [(0, 0), (5, 0), (6, 6), (100, 100)])
def test_a_record_may_have_few_numbers_that_rounding_decides(others, named, tmp_path, monkeypatch):
    monkeypatch.setattr("benchmarks.records.FOLDER", tmp_path)
    (tmp_path / "drawn.jsonl").write_text("".join(f'{{"number": {i}, "error": 1e-4}}\n' for i in range(1000)))
    measured = iter([3e-4] * others + [1e-4] * (100 - others))

    def again(stored, dice):
        yield Pair(f"line {stored['number']}", stored["error"], next(measured))

    record = Record("drawn", lambda: (), lambda job: {}, again, patience=1.0)
    assert len(list(record.differences(seed=1))) == named


def test_a_day_draws_from_lines_that_take_seconds(tmp_path, monkeypatch):
    monkeypatch.setattr("benchmarks.records.FOLDER", tmp_path)
    (tmp_path / "drawn.jsonl").write_text("".join(f'{{"number": {i}}}\n' for i in range(100)))
    record = Record(
        "drawn", lambda: (), lambda job: {}, lambda line, dice: [Pair("", line["number"], -1)], 1.0, 0.1,
        daily=lambda line: line["number"] < 10,
    )  # fmt: skip
    assert {int(found.split()[2].rstrip(",")) for found in record.differences(seed=2)} <= set(range(10))
    assert len([*record.differences(seed=2)]) == 2


def test_stored_numbers_have_three_digits_and_are_finite():
    assert shortened({"a": [1.23456e-7, float("inf")], "b": "x", "c": 12345}) == {
        "a": [1.23e-7, None],
        "b": "x",
        "c": 12345,
    }


@pytest.mark.parametrize("table", TIMED, ids=lambda table: f"{table.page} {table.command}")
def test_times_of_a_page_are_by_the_present_code_or_called_older(table):
    """A loop that changes changes the digest: its tables are measured again, or say that an older code had them."""
    assert not is_stale(table, text_of(table), code_of_times(table))


def test_a_change_of_a_loop_or_of_emitted_code_is_another_code(monkeypatch):
    own, table = list(texts(())), TIMED[0]
    assert any("def integrate(" in text for text in own) and any("def rhs(" in text for text in own)
    assert not any('"""' in text for text in own)
    code = code_of_times(table)
    monkeypatch.setattr("benchmarks.code_of_times.texts", lambda _: [*own[:-1], own[-1].replace("0.5", "0.25")])
    changed = code_of_times(table)
    assert changed != code
    page = written(table, text_of(table), printed(table), "2031-01-02", code)
    assert not is_stale(table, page, code) and not is_older(table, page, code)
    assert is_stale(table, page, changed) and is_older(table, page, changed)


@pytest.mark.parametrize("integrator", INTEGRATORS.names)
def test_a_loop_that_changes_makes_times_of_its_integrators_older_and_no_others(integrator, monkeypatch):
    own = PageTable("own", TIMED[0].page, ("time",), (), times=(0,), integrators=(integrator,))
    changed, common = set(loops_of(integrator)), {loop for name in ("rk4", "dop853") for loop in loops_of(name)}
    tables = [own, *TIMED]
    before = [code_of_times(table) for table in tables]
    monkeypatch.setattr(
        "benchmarks.code_of_times.text_of_loop", lambda loop: text_of_loop(loop) + "changed" * (loop in changed)
    )
    older = [code_of_times(table) != code for table, code in zip(tables, before, strict=True)]
    by_loop = [bool(changed & {loop for name in table.integrators for loop in loops_of(name)}) for table in tables]
    in_yardstick = integrator == "picard" or bool(changed & common)
    assert older == [in_yardstick or runs for runs in by_loop] and older[0]


@pytest.mark.parametrize("table", TIMED, ids=lambda table: f"{table.page} {table.command}")
def test_a_table_with_times_names_the_integrators_that_it_runs(table):
    first, end = place(table, text_of(table))
    shown = set(re.findall(r"`([^`]*)`", "\n".join(text_of(table).splitlines()[first:end])))
    assert table.integrators and shown & set(INTEGRATORS.names) <= set(table.integrators) <= set(INTEGRATORS.names)


def test_times_of_another_code_are_not_kept_for_agreeing():
    """A ratio of 1.18 agrees with 1.41 within the bands, but an older code had it."""
    table = next(table for table in TIMED if table.command == "literature closing")
    rows, (column, *_) = printed(table), table.times
    new = [list(row) for row in rows]
    new[0][column] = two_digits(1.1 * float(rows[0][column].replace(",", "")))
    page = written(table, text_of(table), new, "2031-01-02", "0123abcd")
    assert f"| {new[0][column]} |" in page and "times by code 0123abcd" in page
