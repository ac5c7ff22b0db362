"""Measured numbers in sentences of docs/findings: which table has them.

    python -m benchmarks.sentences    lists the numbers that no table has, with their sentences

A number with a point, an exponent or a percent sign is one of a cell of the page's tables, to the digits that the
sentence prints, or an excess over 1 in percent, or it stands in a sentence that a table yields (`PageTable.claims`).
All others are given, such as steps and tolerances, and listed in `GIVEN` with what they are.
"""

from __future__ import annotations

import re
import sys
from collections.abc import Iterator, Mapping
from pathlib import Path

from benchmarks.page_tables import ROOT

FOLDER = ROOT / "docs" / "findings"
_NUMBER = re.compile(r"(?<![\w.])\d[\d,]*(?:\.\d+)?(?:e-?\d+)?(?![\w])")
_TABLE_OR_HEADING = re.compile(r"^(?:\||#|!\[|\*Measured).*$", re.MULTILINE)
_CODE_OR_LINK = re.compile(r"```.*?```|`[^`]*`|\]\([^)]*\)|doi \S+|https?://\S+", re.DOTALL)
#: Of each page the numbers that are settings or of other people, and what they are.
GIVEN: Mapping[str, Mapping[str, str]] = {
    "README": {"1e-3": "error of an accurate run"},
    "closed-joints": {"1e-3": "step", "1e-12": "decade of three cells", "1.21": "of the paper", "1.62": "of the paper"},
    "energy": {"130": "ratio of two cells", "480": "ratio of two cells"},
    "equal-error": {"1e-6": "error", "1e-8": "error", "0.03": "lengths of runs"},
    "equal-work": {
        **{"0.06": "step", "0.03": "step", "0.015": "step", "1e-5": "tolerance", "1e-9": "tolerance", "95": "interval"},
        **{"1e-7": "tolerance, error", "1e-3": "error", "1e-6": "error of the other study", "1e-8": "the same"},
    },
    "random-mechanisms": {
        **{"0.03": "step", "1e-11": "tolerance", "1e-13": "tolerance", "95": "interval", "1e-3": "error that follows"},
    },
    "redundant-constraints": {"0.3": "angle of bars"},
    "singular-positions": {"1e-3": "step", "1e-13": "violation after a correction"},
    "source-claims": {
        **{"1.2e-5": "error at half the step", "0.5": "step", "0.25": "step", "220": "ratio of constants"},
    },
    "stiff-limit": {
        **{"1e8": "stiffness", "2e5": "damping", "0.5": "length of a run", "1e-3": "step", "1e10": "stiffness"},
        **{"0.1": "step", "1e4": "gravity"},
    },
    "violations": {"4.0e-4": "of the table of claims", "1.8e-6": "of the table of claims"},
}


def pages() -> list[Path]:
    """Return the pages of findings."""
    return sorted(FOLDER.glob("*.md"))


def prose(page: Path) -> str:
    """Return the sentences of a page that no table yields, without code, links and headings."""
    from benchmarks.findings import TABLES

    study = page.relative_to(ROOT).as_posix()
    text = " ".join(_TABLE_OR_HEADING.sub("", page.read_text(encoding="utf-8")).split())
    for claim in (claim for table in TABLES if table.study == study for claim in table.claims()):
        text = text.replace(claim, "")
    return _CODE_OR_LINK.sub("", text)


def cells(page: Path) -> set[float]:
    """Return the numbers of the tables of a page, and of its page of tables."""
    texts = (p.read_text(encoding="utf-8") for p in (page, ROOT / "docs" / "tables" / page.name) if p.is_file())
    lines = (line for text in texts for line in text.splitlines() if line.startswith("|"))
    return {float(x.replace(",", "")) for line in lines for x in _NUMBER.findall(line)}


def is_cell(printed: str, numbers: set[float]) -> bool:
    """Whether a number is one of a table to its digits, or the excess over 1 of one in percent."""
    value = float(printed.replace(",", ""))
    if "e" in printed:
        return any(float(f"{x:.1e}") == value or float(f"{x:.0e}") == value for x in numbers)
    digits = len(printed.partition(".")[2])
    return any(round(x, digits) == value or round(100.0 * (x - 1.0), digits) == value for x in numbers)


def typed(page: Path) -> Iterator[tuple[str, str]]:
    """Yield the measured numbers in sentences of a page that no table has, each with the words around it."""
    text, numbers = prose(page), cells(page)
    for match in _NUMBER.finditer(text):
        behind = text[match.end() : match.end() + 9].lstrip()
        measured = "." in match[0] or "e" in match[0] or behind.startswith(("%", "percent", "times"))
        if measured and not is_cell(match[0], numbers):
            yield match[0], text[max(0, match.start() - 40) : match.end() + 20]


def main() -> int:
    """Print the numbers that no table has; 1 if one is not given."""
    unknown = 0
    for page in pages():
        for printed, words in typed(page):
            what = GIVEN.get(page.stem, {}).get(printed, "")
            unknown += not what
            sys.stdout.write(f"{page.stem}: {printed} ({what or 'UNKNOWN'}) ... {words}\n")
    return int(unknown > 0)


if __name__ == "__main__":
    sys.exit(main())
