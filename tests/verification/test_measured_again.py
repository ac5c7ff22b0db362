"""What the paper rests on, measured again: turns within a time, and numbers that are others."""

import random

import pytest

from benchmarks import measured_again
from benchmarks.measured_again import Source, in_words, measure_in_turns, source_of_page, source_of_record
from benchmarks.page_tables import PageTable
from benchmarks.records import Pair, Record


def clock(step):
    """Return a clock that advances with every look."""
    now = -step

    def look():
        nonlocal now
        now += step
        return now

    return look


def record_with(tmp_path, monkeypatch, values):
    """Return a record of numbers that are 1.0 when they are measured again."""
    monkeypatch.setattr("benchmarks.records.FOLDER", tmp_path)
    (tmp_path / "ones.jsonl").write_text("".join(f'{{"value": {value}}}\n' for value in values))
    return Record("ones", list, dict, lambda line, dice: [Pair("a value", line["value"], 1.0)], 1.0)


def test_numbers_that_are_others_are_named(tmp_path, monkeypatch):
    source = source_of_record(record_with(tmp_path, monkeypatch, [1.0, 1.05, 2.0]), seed=3)
    measure_in_turns([source], 1e9)
    assert (source.again, source.numbers, source.others) == (3, 3, ["a value: 2.0, measured 1.0"])
    assert not source.agrees and "1 of 3 numbers are others" in in_words([source])
    assert "not measured again: 0 lines" in in_words([source])


def test_sources_take_turns_until_the_time_is_over():
    calls = []
    sources = [Source(name, [lambda name=name: (calls.append(name) or 1, [])] * 5) for name in "ab"]
    measure_in_turns(sources, 3.0, clock(1.0))  # the first look begins it
    assert [source.again for source in sources] == [1, 1] and all(source.agrees for source in sources)
    measure_in_turns(sources, 0.0, clock(1.0))
    assert [source.again for source in sources] == [1, 1]
    measure_in_turns(sources, 1e9, clock(1.0))
    assert [source.again for source in sources] == [5, 5]


def test_a_line_that_raises_is_a_difference_and_the_others_are_kept():
    def raises():
        raise ArithmeticError("no start")

    source = Source("ones", [lambda: (3, []), raises, lambda: (2, [])])
    measure_in_turns([source], 1e9)
    assert (source.again, source.numbers) == (3, 6) and not source.agrees
    assert source.others == ["line 2 of this order raised ArithmeticError: no start"] and source.seconds >= 0.0


def test_rows_of_a_page_are_compared_with_what_it_prints(tmp_path, monkeypatch):
    (tmp_path / "page.md").write_text(
        "`python -m benchmarks.ones`\n\n| a | b |\n| --- | --- |\n| x | 1.2 |\n| y | 1.9 |\n"
    )
    monkeypatch.setattr(measured_again, "ROOT", tmp_path)
    rows = tuple(((name,), lambda: ["1.2"]) for name in "xy")
    source = source_of_page(PageTable("ones", "page.md", ("a", "b"), rows), seed=1)
    measure_in_turns([source], 1e9)
    assert source.numbers == 2 and source.others == ["page.md:6, b: '1.9', measured '1.2'"]


@pytest.mark.slow
def test_a_line_of_each_source_of_the_paper():
    sources = measured_again.sources_of_paper(random.Random(5).randrange(99))
    assert [len(source.lines) > 4 for source in sources] == [True] * 6
    for source in sources[:2]:
        source.measure_next()
        assert source.numbers > 0 and not source.others
