"""The words of the glossary have one meaning in names of files: the page lists every file that has a word."""

import re
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
PAGE = (ROOT / "docs" / "development" / "glossary.md").read_text(encoding="utf-8")
#: Word -> meaning and listed files, of each line of the table.
LINES = {
    cells[0]: (cells[1], re.findall(r"`([^`]+)`", cells[2]))
    for line in PAGE.splitlines()
    if line.startswith("| ") and (cells := [cell.strip() for cell in line.split("|")[1:-1]])[0] not in ("word", "---")
}


def having(word: str) -> set[str]:
    """Return the files of the package that have a word in their names, one of it or several, without `.py`."""
    pattern = re.compile(rf"(?:^|_){word.removesuffix('s').replace(' ', '_')}s?(?:_|$)")
    paths = (path.relative_to(ROOT / "symgen").with_suffix("") for path in (ROOT / "symgen").rglob("*.py"))
    return {path.as_posix() for path in paths if pattern.search(path.name)}


@pytest.mark.parametrize("word", LINES)
def test_files_with_a_word_of_the_glossary_are_listed_with_its_meaning(word: str) -> None:
    meaning, listed = LINES[word]
    assert meaning
    new, gone = having(word) - {*listed}, {*listed} - having(word)
    assert not new, f"{sorted(new)} have '{word}': list them if they mean '{meaning}', else rename them"
    assert not gone, f"docs/development/glossary.md lists {sorted(gone)} for '{word}', which are not there"


def test_the_glossary_has_at_most_thirty_words() -> None:
    assert 20 <= len(LINES) <= 30


def test_a_word_is_found_wherever_it_is_in_a_name() -> None:
    assert "run/loops/seams" in having("seam")
    assert "result/stepping/seams_ahead" in having("seam")
    assert "describe/joints/point_on_plane" not in having("lane")
