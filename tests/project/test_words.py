"""Pages are short enough to be read, and what programs write is out of the reader's way."""

from benchmarks import words
from benchmarks.findings import TABLES
from benchmarks.page_tables import ROOT

#: Words that readers may be given, as `python -m benchmarks.words` counts: who adds a page shortens another one.
READERS = 85_000


def test_readers_are_given_few_words() -> None:
    longest = "python -m benchmarks.words --pages"
    assert words.count()[words.READERS] <= READERS, f"shorten pages, those that repeat others first: {longest}"


def test_every_word_is_counted_once() -> None:
    text = [page.read_text(encoding="utf-8") for page in words.pages()]
    assert words.count().total() == sum(len(page.split()) for page in text)
    assert all(page in words.pages() for page in words.WRITTEN)


def test_tables_that_programs_write_are_out_of_the_readers_way() -> None:
    """But for those beside other tools, which the first page of the repository has."""
    pages = {table.page for table in TABLES if table.page.startswith("docs/")}
    assert {(ROOT / page).parent.name for page in pages} == {"tables"}
    assert {page.parent.name for page in words.WRITTEN} == {"tables", "development"}
    said = {page for page in words.pages() if "\nWritten by `python -m " in page.read_text(encoding="utf-8")}
    assert said <= set(words.WRITTEN)


def test_the_words_of_a_table_are_those_of_its_lines() -> None:
    page = ROOT / "docs" / "tables" / "gains.md"
    text = page.read_text(encoding="utf-8")
    lines = [line for line in text.splitlines() if line.startswith("|")]
    assert words.words_of_tables(page, text) == sum(len(line.split()) for line in lines) > 100
    assert dict(words.counts(page))["legends"] < 50
