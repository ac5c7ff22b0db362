"""Records: long measurements whose lines are stored, so that tables of pages are made of them and lines stay checkable.

    python -m benchmarks.records NAME [--anew] [--workers N] [--seconds S]

A record is a file of JSON lines in ``benchmarks/records``. A line names what was measured and has its numbers, to three
digits. What the file has is not measured again, unless it begins anew. Tables of pages follow from the lines alone; a
slow test measures drawn lines again.
"""

from __future__ import annotations

import argparse
import importlib
import json
import math
import random
import sys
import time
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path
from typing import Any

from benchmarks.verification.workers import answers

FOLDER = Path(__file__).with_name("records")
#: Modules that have a record, by its name.
NAMES = (
    "statistics",
    "equal_error",
    "equal_work",
    "all_methods",
    "beside_tools",
    "stress_cells",
    "stress_quick",
    "identification",
    "functions",
    "by_numba",
)
#: Digits of stored numbers.
DIGITS = 3

#: A line of a record: its keys and its numbers.
Line = Mapping[str, Any]


@dataclass(frozen=True)
class Pair:
    """A number of a record beside the same one measured again; `within` is the largest ratio of the two."""

    what: str
    stored: Any
    measured: Any
    within: float = 1.1
    #: Numbers below are rounding, or errors of references.
    floor: float = 0.0

    @property
    def agree(self) -> bool:
        """Whether both are one: counts and words exactly, numbers within a ratio."""
        one, other = self.stored, self.measured
        if not (isinstance(one, float) and isinstance(other, float)):
            return bool(one == other)
        low, high = sorted((abs(one), abs(other)))
        return high <= self.floor or (high <= self.within * low and one * other > 0.0)

    def __str__(self) -> str:
        return f"{self.what}: {self.stored}, measured {self.measured}"


@dataclass(frozen=True)
class Record:
    """A long measurement.

    Parameters
    ----------
    name : str
        Name of its module, and of its file.
    jobs : callable
        Returns what there is to measure; fields of a job are the first keys of its line.
    examine : callable
        Measures a job; a function of a module, as it runs in processes.
    again : callable
        Measures a part of a line again, drawn by dice.
    patience : float
        Processor time of a job at most [s].
    share : float
        Lines of which a part is measured again by the test of a day.
    stray : float
        Share of numbers that may differ: a sensitive motion amplifies the rounding of a processor.
    daily : callable
        Whether the test of a day may draw a line: some take minutes.
    """

    name: str
    jobs: Callable[[], Iterable[Any]]
    examine: Callable[[Any], dict[str, Any]]
    again: Callable[[Line, random.Random], Iterable[Pair]]
    patience: float
    share: float = 0.1
    stray: float = 0.05
    daily: Callable[[Line], bool] = bool

    @property
    def path(self) -> Path:
        """Return the file of lines."""
        return FOLDER / f"{self.name}.jsonl"

    def lines(self) -> list[Line]:
        """Return the stored lines."""
        return lines_in(self.path)

    def differences(self, seed: int) -> Iterator[str]:
        """Yield the numbers of drawn lines that are others now, if they are more than strays."""
        dice, lines = random.Random(seed), [*filter(self.daily, self.lines())]
        drawn = dice.sample(lines, round(self.share * len(lines) + 0.5))
        pairs = [pair for line in drawn for pair in self.again(line, dice)]
        others = [f"{self.name}, {pair}" for pair in pairs if not pair.agree]
        if len(others) > math.ceil(self.stray * len(pairs)):
            yield from others


def lines_in(path: Path | None) -> list[Line]:
    """Return the lines of a file, none where there is none."""
    return [] if path is None or not path.exists() else list(_parsed(path, path.stat().st_mtime_ns))


@lru_cache(maxsize=8)
def _parsed(path: Path, changed: int) -> tuple[Line, ...]:
    return tuple(json.loads(line) for line in path.read_text(encoding="utf-8").splitlines())


def shortened(value: Any) -> Any:
    """Return numbers with `DIGITS` digits, in whatever they are part of; what is not finite is None."""
    if isinstance(value, float):
        return float(f"{value:.{DIGITS - 1}e}") if math.isfinite(value) else None
    if isinstance(value, Mapping):
        return {key: shortened(each) for key, each in value.items()}
    return [shortened(each) for each in value] if isinstance(value, list | tuple) else value


def fields_of(job: Any) -> dict[str, Any]:
    """Return the keys of a job, a named tuple."""
    return dict(job._asdict())


def measure(
    examine: Callable[[Any], dict[str, Any]],
    jobs: Iterable[Any],
    path: Path | None,
    patience: float,
    workers: int = 1,
    seconds: float = math.inf,
) -> list[Line]:
    """Measure what a file of lines has not, add it there, and return all lines.

    Parameters
    ----------
    examine : callable
        Measures a job; a function of a module.
    jobs : iterable of named tuples
        What there is to measure.
    path : Path or None
        File of lines.
    patience : float
        Processor time of a job at most [s].
    workers : int
        Processes.
    seconds : float
        No job begins after so many seconds.
    """
    lines, began = lines_in(path), time.monotonic()
    wanted = list(jobs)
    names = tuple(fields_of(wanted[0])) if wanted else ()
    done = {tuple(line[name] for name in names) for line in lines}
    timely = (job for job in wanted if tuple(job) not in done and time.monotonic() - began < seconds)
    for answer in answers(examine, timely, workers, patience):
        line = fields_of(answer.job) | (shortened(answer.value) or {"died": answer.died})
        lines.append(line)
        if path is not None:
            with path.open("a", encoding="utf-8") as file:
                file.write(json.dumps(line, separators=(",", ":")) + "\n")
        print(*answer.job, f"{time.monotonic() - began:.0f} s", answer.died, file=sys.stderr, flush=True)
    return lines


def record_of(name: str) -> Record:
    """Return the record of a module."""
    record: Record = importlib.import_module(f"benchmarks.{name}").RECORD
    return record


def main(arguments: Sequence[str] | None = None) -> int:
    """Measure a record."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.records", description="Measure what a record lacks.")
    parser.add_argument("name", choices=NAMES)
    parser.add_argument("--anew", action="store_true", help="begin with an empty file")
    parser.add_argument("--workers", type=int, default=1, help="processes; run times want a core each")
    parser.add_argument("--seconds", type=float, default=math.inf, help="nothing begins after so many seconds")
    chosen = parser.parse_args(arguments)
    record = record_of(chosen.name)
    FOLDER.mkdir(exist_ok=True)
    if chosen.anew:
        record.path.unlink(missing_ok=True)
    measure(record.examine, record.jobs(), record.path, record.patience, chosen.workers, chosen.seconds)
    return 0


if __name__ == "__main__":
    sys.exit(main())
