"""What the paper rests on, measured again within some time: drawn lines of its records, drawn rows of its pages.

    python -m benchmarks.measured_again [--minutes M] [--seed N]

Records and pages take turns, each with lines in an order of dice, until the time is over. Counts and words must be the
same, errors agree to the bands of their module; run times of pages are not measured.
"""

from __future__ import annotations

import argparse
import random
import sys
import time
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field
from functools import partial

from benchmarks import equal_error, equal_work, literature, statistics
from benchmarks.page_tables import KEPT, ROOT, PageTable, differences, markdown
from benchmarks.records import Record

#: Differences that are printed of each source.
SHOWN = 10


@dataclass
class Source:
    """Lines that numbers of the paper come from.

    Attributes
    ----------
    name : str
        What follows ``python -m benchmarks.``, and where lines are.
    lines : list of callables
        Each measures a line again: the count of its numbers, and those that are others, in words.
    stray : float
        Share of numbers that may be others, as rounding differs between processors.
    again, numbers : int
        Lines and numbers measured again.
    others : list of str
        Numbers that are others now, and what a line raised.
    seconds : float
        Processor time of the lines measured again [s].
    """

    name: str
    lines: list[Callable[[], tuple[int, list[str]]]]
    stray: float = 0.0
    again: int = 0
    numbers: int = 0
    others: list[str] = field(default_factory=list)
    seconds: float = 0.0

    @property
    def agrees(self) -> bool:
        """Whether no more numbers are others than strays."""
        return len(self.others) <= self.stray * self.numbers

    def measure_next(self) -> None:
        """Measure the next line; one that raises is a difference, and those of the hour before are kept."""
        began = time.process_time()
        try:
            count, others = self.lines[self.again]()
        except Exception as error:
            count, others = 1, [f"line {self.again + 1} of this order raised {type(error).__name__}: {error}"]
        self.seconds += time.process_time() - began
        self.again, self.numbers, self.others = self.again + 1, self.numbers + count, [*self.others, *others]


def source_of_record(record: Record, seed: int) -> Source:
    """Return the lines of a record in an order of dice."""
    dice, lines = random.Random(seed), record.lines()

    def measure(k: int) -> tuple[int, list[str]]:
        pairs = [*record.again(lines[k], dice)]
        return len(pairs), [str(pair) for pair in pairs if not pair.agree]

    order = dice.sample(range(len(lines)), len(lines))
    return Source(f"{record.name}, record", [partial(measure, k) for k in order], record.stray)


def source_of_page(table: PageTable, seed: int) -> Source:
    """Return the rows of a table of a page in an order of dice."""
    text = (ROOT / table.page).read_text(encoding="utf-8")

    def measure(k: int) -> tuple[int, list[str]]:
        names, rest = table.rows[k]
        cells = rest()
        found = differences(table, text, {k: [*names, *cells]})
        return sum(cell != KEPT for cell in cells), [str(each) for each in found]

    order = random.Random(seed).sample(range(len(table.rows)), len(table.rows))
    return Source(f"{table.command}, {table.page}", [partial(measure, k) for k in order])


def sources_of_paper(seed: int) -> list[Source]:
    """Return the pages and records whose numbers the paper has; pages take less time."""
    pages = (literature.law(), literature.gains(), literature.closing())
    records = (equal_error.RECORD, equal_work.RECORD, statistics.RECORD)
    return [
        *(source_of_page(table, seed) for table in pages),
        *(source_of_record(record, seed) for record in records),
    ]


def measure_in_turns(sources: Sequence[Source], seconds: float, clock: Callable[[], float] = time.monotonic) -> None:
    """Measure lines of all sources in turns; none begins after so many seconds."""
    began = clock()
    while any(source.again < len(source.lines) for source in sources):
        for source in sources:
            if clock() - began >= seconds:
                return
            if source.again < len(source.lines):
                source.measure_next()


def in_words(sources: Sequence[Source]) -> str:
    """Return the report: of each source its new lines, their differences, and its stored lines."""
    headings = ("source", "lines", "measured again", "numbers", "others", "processor time [s]")
    rows = [
        [f"`{s.name}`", *map(str, (len(s.lines), s.again, s.numbers, len(s.others))), f"{s.seconds:.0f}"]
        for s in sources
    ]  # fmt: skip
    return "\n".join(["# Measured again", "", *markdown(headings, rows), "", *_sentences(sources), ""])


def _sentences(sources: Sequence[Source]) -> Iterator[str]:
    for source in sources:
        if source.others:
            share = f"{len(source.others)} of {source.numbers}"
            allowed = "" if not source.stray else f", {source.stray:.0%} may be: rounding differs between processors"
            yield f"- `{source.name}`: {share} numbers are others{allowed}."
            yield from (f"  - {other}" for other in source.others[:SHOWN])
    left = sum(len(source.lines) - source.again for source in sources)
    yield f"- As stored, not measured again: {left} lines, and run times of pages."


def main(arguments: Sequence[str] | None = None) -> int:
    """Measure lines again and print what they say; 1 if more numbers than strays are others."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.measured_again")
    parser.add_argument("--minutes", type=float, default=45.0, help="no line begins after so many minutes")
    parser.add_argument("--seed", type=int, default=1, help="of the order of lines")
    chosen = parser.parse_args(arguments)
    sources = sources_of_paper(chosen.seed)
    measure_in_turns(sources, 60.0 * chosen.minutes)
    sys.stdout.write(in_words(sources))
    return int(not all(source.agrees for source in sources))


if __name__ == "__main__":
    sys.exit(main())
