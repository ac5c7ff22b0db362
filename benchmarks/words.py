"""Words of the pages of docs, by who reads and who writes them.

    python -m benchmarks.words [--pages]

A word is what stands between blanks, as ``wc -w`` counts: text, tables, code and addresses alike. `programs` are whole
pages that a program writes, and tables by programs in pages with other text, with their headings. What is left of
``docs/tables`` are `legends`: words by hand about measured figures. `development` is for who changes symgen, and
`readers` have everything else. ``--pages`` prints the pages of readers, the longest first.
"""

from __future__ import annotations

import sys
from collections import Counter
from collections.abc import Iterator
from pathlib import Path

from benchmarks import beside_siconos, first_run, gallery, late_names, meeting, modal_limits, remarks, sayable
from benchmarks.findings import TABLES
from benchmarks.page_tables import ROOT, place

DOCS = ROOT / "docs"
#: Pages that a program writes from the first word to the last, beside those of the gallery.
WRITTEN = (
    *(
        beside_siconos.PAGE,
        first_run.PAGE,
        late_names.PAGE,
        meeting.PAGE,
        modal_limits.PAGE,
        remarks.PAGE,
        sayable.PAGE,
    ),
    *(DOCS / "tables" / name for name in ("mujoco.md", "pairs.md")),
)
#: Folders -> who reads them.
KINDS = {"tables": "legends", "development": "development", "decisions": "development"}
READERS, PROGRAMS = "readers", "programs"


def words_of_tables(page: Path, text: str) -> int:
    """Return the words of a page in tables that programs write, 0 if it has none."""
    own = [table for table in TABLES if ROOT / table.page == page]
    lines = text.splitlines()
    return sum(len(" ".join(lines[slice(*place(table, text))]).split()) for table in own)


def counts(page: Path) -> Iterator[tuple[str, int]]:
    """Yield who has the words of a page, and how many."""
    text = page.read_text(encoding="utf-8")
    words = len(text.split())
    by_program = words if page in WRITTEN or page.parent == gallery.FOLDER else words_of_tables(page, text)
    yield PROGRAMS, by_program
    yield KINDS.get(page.relative_to(DOCS).parts[0], READERS), words - by_program


def pages() -> list[Path]:
    """Return all pages of docs."""
    return sorted(DOCS.rglob("*.md"))


def count() -> Counter[str]:
    """Return the words of each kind."""
    total = Counter[str]()
    for page in pages():
        for kind, words in counts(page):
            total[kind] += words
    return total


def main(arguments: list[str]) -> None:
    """Print the words of each kind, or of the readers' pages."""
    rows = [(words, kind) for kind, words in count().items()]
    if "--pages" in arguments:
        own = ((dict(counts(page)).get(READERS, 0), page.relative_to(ROOT).as_posix()) for page in pages())
        rows = [row for row in own if row[0]]
    sys.stdout.writelines(f"{words:8,}  {what}\n" for words, what in sorted(rows, reverse=True))
    sys.stdout.write(f"{sum(words for words, _ in rows):8,}  together\n")


if __name__ == "__main__":
    main(sys.argv[1:])
