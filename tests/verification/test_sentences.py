"""Numbers in sentences of findings are those of their tables: a table that changes has its sentences red."""

import pytest

from benchmarks import sentences


@pytest.mark.parametrize("page", sentences.pages(), ids=lambda page: page.stem)
def test_measured_numbers_are_those_of_tables(page):
    given = sentences.GIVEN.get(page.stem, {})
    unknown = [f"{number}: {words}" for number, words in sentences.typed(page) if number not in given]
    assert not unknown
    assert {number for number, _ in sentences.typed(page)} == {*given}, "what is given is no cell"


def test_pages_that_are_known_exist():
    assert {*sentences.GIVEN} <= {page.stem for page in sentences.pages()}


def test_a_cell_that_changes_makes_its_sentence_typed(tmp_path, monkeypatch):
    page = tmp_path / "gains.md"
    text = "Costs 12 percent more, error 3.4e-5 m.\n\n| a | b |\n| --- | --- |\n| 1.12 | 3.41e-5 |\n"
    page.write_text(text, encoding="utf-8")
    monkeypatch.setattr(sentences, "ROOT", tmp_path)
    assert not [*sentences.typed(page)]
    page.write_text(text.replace("| 1.12 | 3.41e-5 |", "| 1.17 | 3.61e-5 |"), encoding="utf-8")
    assert [number for number, _ in sentences.typed(page)] == ["12", "3.4e-5"]
