"""Quick stress studies of the whole catalogue: what `symgen stress NAME --quick` costs, and how its cells end.

    python -m benchmarks.stress_quick                                   prints the table of docs/tables/stress.md
    python -m benchmarks.stress_quick apart MODEL ...                   how many methods a study tells apart
    python -m benchmarks.records stress_quick [--workers N]             measures what the record lacks

A line has the processor time of the command in one process, `first` with loops in the cache and nothing of the
mechanism (of the four-bar with an empty cache), `warm` with everything there. A worker has the cache of
SYMGEN_CACHE_DIR, or one of its own, in which it studies the four-bar beforehand.
"""

from __future__ import annotations

import json
import os
import random
import resource
import subprocess
import sys
import tempfile
from collections import Counter
from collections.abc import Iterator
from functools import partial
from typing import Any, NamedTuple

from benchmarks.page_tables import PageTable, list_of, print_tables
from benchmarks.records import Line, Pair, Record
from symgen.describe.catalogue import all_names, names
from symgen.study.stress.cell_outcome import GOOD, OUTCOMES
from symgen.study.stress.study import INDEX_ONE, STIFF, SUITED

PAGE = "docs/tables/stress.md"
#: Time of a study at most, however busy the machine is [s].
LONGEST = 1200.0
#: Processor time of a study that the test of a day may repeat [s].
SHORT = 25.0
#: Fills a cache with the loops.
FILLS = "four-bar"


class Job(NamedTuple):
    """A mechanism of the catalogue."""

    model: str


def jobs() -> Iterator[Job]:
    """Yield all mechanisms, studied ones first."""
    yield from map(Job, dict.fromkeys((*names(), *all_names())))


def examine(job: Job) -> dict[str, Any]:
    """Return processor times of two studies in a row, the number of cells, searches and outcomes."""
    if job.model == FILLS or not os.environ.get("SYMGEN_CACHE_DIR"):
        os.environ["SYMGEN_CACHE_DIR"] = tempfile.mkdtemp(prefix="symgen-stress-quick-")
        if job.model != FILLS:
            study(FILLS)
    first, found = study(job.model)
    if "says" in found:
        return {"first": first, **found}
    return {"first": first, "warm": study(job.model)[0], **found}


def study(model: str) -> tuple[float, dict[str, Any]]:
    """Return the processor time of the command [s], and what its JSON says."""
    command = [sys.executable, "-m", "symgen", "stress", model, "--quick", "--json", "--jobs", "1"]
    before = _of_children()
    done = subprocess.run(command, capture_output=True, text=True, check=False, timeout=LONGEST)
    seconds = _of_children() - before
    if not done.stdout:
        return seconds, {"says": done.stderr.strip().splitlines()[-1]}
    found = json.loads(done.stdout)
    rows = [row for row in found["rows"] if not _is_beside(row)]
    counts = Counter(row["outcome"] for row in rows)
    outcomes = {name: counts[name] for name in found["outcomes"] if counts[name]}
    left_out = len({pair["method"] for pair in found["left_out"]})
    return seconds, {"cells": len(rows), "searches": len(found["limits"]), "left": left_out, "outcomes": outcomes}


def _is_beside(row: Line) -> bool:
    """Whether a cell is one of the integrator that suits stiff families, which the record leaves out."""
    return row["integrator"] == SUITED and row["family"] in STIFF and row["method"] in INDEX_ONE


def _of_children() -> float:
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def again(stored: Line, dice: random.Random) -> Iterator[Pair]:
    """Yield the outcomes of a mechanism beside those measured again."""
    if "outcomes" in stored:
        yield Pair(stored["model"], stored["outcomes"], study(stored["model"])[1].get("outcomes"))


def costs() -> PageTable:
    """Return seconds of the processor, cells, and how they ended, of each mechanism in the record."""
    lines = {line["model"]: line for line in RECORD.lines() if "outcomes" in line}
    shown = [name for name in OUTCOMES if name != GOOD]

    def cells(model: str) -> Iterator[str]:
        line = lines[model]
        counts = line["outcomes"]
        yield from (f"{line['first']:.0f}", f"{line['warm']:.0f}", str(line["cells"]), str(counts.get(GOOD, 0)))
        yield ", ".join(f"{counts[name]} {name}" for name in shown if name in counts)
        yield str(line["searches"])

    rows = tuple(((f"`{job.model}`",), partial(list_of, cells, job.model)) for job in jobs() if job.model in lines)
    headings = ("model", "first [s]", "warm [s]", "cells", GOOD, "others", "searches")
    return PageTable("stress_quick", PAGE, headings, rows, stored=True, claims=missing)


def missing() -> Iterator[str]:
    """Yield the mechanisms of which the record has nothing."""
    done = {line["model"] for line in RECORD.lines() if "outcomes" in line}
    left = [f"`{job.model}`" for job in jobs() if job.model not in done]
    if left:
        yield f"Without figures: {', '.join(left)}."


def told_apart(model: str, integrator: str = "rk4") -> str:
    """Return the row of a mechanism: methods with an integrator, lists of outcomes, lines beside `lagrange`, time."""
    command = [sys.executable, "-m", "symgen", "stress", model, "--quick", "--json", "--jobs", "1"]
    before = _of_children()
    done = subprocess.run(command, capture_output=True, text=True, check=False, timeout=LONGEST)
    seconds, found = _of_children() - before, json.loads(done.stdout)
    lines = [line for line in found["beside"] if line["integrator"] == integrator]
    outcomes = dict[str, list[tuple[str, str, str]]]()
    for row in found["rows"]:
        if row["integrator"] == integrator:
            outcomes.setdefault(row["method"], []).append((row["family"], row["case"], row["outcome"]))
    common = set.intersection(*({each[:2] for each in own} for own in outcomes.values()))
    lists = {tuple(each for each in own if each[:2] in common) for own in outcomes.values()}
    return f"| `{model}` | {len(outcomes)} | {len(lists)} | {len(lines)} | {seconds:.0f} |"


def tables() -> dict[str, PageTable]:
    """Return the table by its name."""
    return {"": costs()}


def is_short(stored: Line) -> bool:
    """Whether a study takes seconds: the test of a day draws from these."""
    return float(stored["first"]) <= SHORT


RECORD = Record("stress_quick", jobs, examine, again, float("inf"), share=0.02, daily=is_short)


if __name__ == "__main__":
    if sys.argv[1:2] == ["apart"]:
        print("| model | methods with `rk4` | lists of outcomes | lines beside `lagrange` | time [s] |")
        for name in sys.argv[2:]:
            print(told_apart(name), flush=True)
        sys.exit()
    sys.exit(print_tables(tables(), [""]))
