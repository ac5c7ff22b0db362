"""All methods on the source's four mechanisms and a singular one: how runs end, and what an error costs.

    python -m benchmarks.all_methods [ends] [times]              tables of the page, from the record
    python -m benchmarks.records all_methods --anew --workers N  measures it: about half an hour of one core

Each method runs with `rk4`, `dop853` and `picard`, or with its own integrator, at the default steps and tolerances of
`symgen compare`. `ends` counts how runs ended. `times` has, for each method, the run time of its fastest run that is
`ok` and within 1e-6 m, over that of the fastest of all methods on the same mechanism.
"""

from __future__ import annotations

import random
import sys
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from functools import partial
from typing import Any, NamedTuple

from benchmarks.page_tables import PageTable, list_of, number, print_tables
from benchmarks.records import Line, Pair, Record
from symgen.derive.methods import METHODS
from symgen.result.result import FAILED, OK, UNVERIFIED
from symgen.run.integrators import INTEGRATORS as KINDS
from symgen.study.comparison.compare_models import compare
from symgen.study.journal import Journal
from symgen.study.report.comparison_findings import WRONG
from symgen.study.yardstick import YARDSTICK

MECHANISMS = ("four-bar", "spatial-slider-crank", "bricard", "front-suspension", "n-four-bar:2")
INTEGRATORS = ("rk4", "dop853", "picard")
#: Error [m] at which methods are compared.
ERROR = 1e-6
#: Errors [m] below are those of references, and errors above of motions that have left their branch.
RESOLVED, LOST = 1e-9, 1e-2
#: The same where each passage near a singular position amplifies rounding, which differs from processor to processor.
ROUNDED = {"n-four-bar:2": 1e-5}
#: Processor time of a mechanism at most [s].
PATIENCE = 7200.0
PAGE = "docs/tables/all-methods.md"


class Job(NamedTuple):
    """A mechanism."""

    mechanism: str


class Run(NamedTuple):
    """A run of the record: its step [s] or tolerance, status, error [m] and time [s]."""

    integrator: str
    setting: float
    status: str
    error: float | None
    seconds: float


def suitable(method: str) -> tuple[str, ...]:
    """Return those of the integrators that a method fits, none if it runs with its own."""
    forms = set(METHODS.get(method).forms)
    return tuple(name for name in INTEGRATORS if forms & set(KINDS.get(name).forms))


def examine(job: Job, methods: Sequence[str] = METHODS.names) -> dict[str, Any]:
    """Return the runs of methods on a mechanism."""
    rows = list[dict[str, Any]]()
    journal = Journal()  # has the reference, which takes longer than the runs of a method
    for integrators in dict.fromkeys(map(suitable, methods)):
        chosen = [method for method in methods if suitable(method) == integrators]
        rows += compare(job.mechanism, chosen, integrators, journal=journal).to_json()["rows"]
    runs: dict[str, list[Run]] = {method: [] for method in methods}
    for row, seconds in zip(rows, times_by_turns(rows), strict=True):
        setting = row["step"] or row["rtol"]
        runs[row["method"]].append(Run(row["integrator"], setting, row["status"], row["error"], seconds))
    return {"runs": runs}


def times_by_turns(rows: Sequence[Mapping[str, Any]]) -> list[float]:
    """Return the times of rows [s]: ratios in turns times the time of the yardstick, which other work has changed once.

    Rows without a ratio, whose yardstick fails or does not take the integrator, have their own processor time.
    """

    def setting(row: Mapping[str, Any]) -> tuple[Any, ...]:
        return row["integrator"], row["step"], row["rtol"]

    yardsticks = {setting(row): row["run_seconds"] for row in rows if row["method"] == YARDSTICK and row["cost_ratio"]}

    def seconds(row: Mapping[str, Any]) -> float:
        yardstick, ratio = yardsticks.get(setting(row)), row["cost_ratio"]
        return float(yardstick * ratio if yardstick and ratio else row["run_seconds"])

    return list(map(seconds, rows))


def again(stored: Line, dice: random.Random) -> Iterator[Pair]:
    """Yield status and error of the runs of a method beside those measured again."""
    methods = dice.sample(sorted(stored["runs"]), 1)
    new = examine(Job(stored["mechanism"]), methods)["runs"]
    for method in methods:
        where = f"{stored['mechanism']}, {method}"
        old = [Run(*run) for run in stored["runs"][method]]
        yield Pair(f"{where}, runs", [run[:2] for run in old], [run[:2] for run in new[method]])
        for one, other in zip(old, new[method], strict=False):
            setting = f"{where}, {one.integrator} {one.setting:g}"
            least = ROUNDED.get(stored["mechanism"], RESOLVED)
            if one.error is not None and least < one.error < LOST and one.status == OK:
                yield Pair(f"{setting}, status", one.status, other.status)
                yield Pair(f"{setting}, error", one.error, other.error, 4.0 if one.integrator == "picard" else 1.1)


def runs_of(mechanism: str) -> dict[str, list[Run]]:
    """Return the runs of a mechanism by method, from the record."""
    own = [line["runs"] for line in RECORD.lines() if line["mechanism"] == mechanism]
    return {method: [Run(*run) for run in runs] for each in own for method, runs in each.items()}


def recorded() -> list[str]:
    """Return the mechanisms that the record has."""
    return [name for name in MECHANISMS if runs_of(name)]


def ends() -> PageTable:
    """Return how runs ended on each mechanism, and which are `ok` and off by more than 1e-3 m."""

    def cells(mechanism: str) -> Iterator[str]:
        runs = [run for each in runs_of(mechanism).values() for run in each]
        count = Counter(run.status for run in runs)
        yield str(len(runs))
        yield from (str(count[name]) for name in (OK, UNVERIFIED, FAILED))
        wrong = [run for run in runs if run.status == OK and not (run.error or 0.0) <= WRONG]
        settings = Counter(run.integrator for run in wrong)
        listed = ", ".join(f"{n} with `{name}`" for name, n in settings.most_common())
        yield f"{listed}; at most {number(max(run.error or 0.0 for run in wrong))} m" if wrong else "none"

    rows = tuple(((f"`{name}`",), partial(list_of, cells, name)) for name in recorded())
    headings = ("mechanism", "runs", "`ok`", "`unverified`", "`failed`", "`ok` and off by more than 1e-3 m")
    return PageTable("all_methods ends", PAGE, headings, rows, stored=True)


def shortest(mechanism: str) -> dict[str, Run]:
    """Return, for each method, the fastest run that is `ok` and within `ERROR`."""
    best = dict[str, Run]()
    for method, runs in runs_of(mechanism).items():
        good = [run for run in runs if run.status == OK and (run.error or 0.0) <= ERROR]
        if good:
            best[method] = min(good, key=lambda run: run.seconds)
    return best


def times() -> PageTable:
    """Return the run times of methods within `ERROR`, over the shortest on each mechanism."""
    columns = []
    for name in recorded():
        best = shortest(name)
        least = min((run.seconds for run in best.values()), default=1.0)
        columns.append({method: run.seconds / least for method, run in best.items()})
    reached = {m: sum(m in c for c in columns) for m in METHODS.names}
    order = sorted(
        (m for m in METHODS.names if reached[m]), key=lambda m: (-reached[m], sum(c.get(m, 0.0) for c in columns))
    )

    def cells(method: str) -> Iterator[str]:
        ratios = (c.get(method) for c in columns)
        yield from ("" if x is None else f"{x:.3g}" if x < 999.5 else f"{x:.0f}" for x in ratios)

    rows = tuple(((f"`{method}`",), partial(list_of, cells, method)) for method in order)
    headings = (f"within {ERROR:g} m".replace("e-0", "e-"), *(f"`{name}`" for name in recorded()))
    return PageTable("all_methods times", PAGE, headings, rows, stored=True, claims=claims)


def claims() -> Iterator[str]:
    """Yield what the page says of the runs."""
    every = [run for name in recorded() for runs in runs_of(name).values() for run in runs]
    count = Counter(run.status for run in every)
    yield f"{len(every)} runs: {count[OK]} `ok`, {count[UNVERIFIED]} `unverified`, {count[FAILED]} `failed`."
    fastest = Counter(run.integrator for name in recorded() for run in shortest(name).values())
    listed = ", ".join(f"{n} with `{name}`" for name, n in fastest.most_common())
    yield f"Of the fastest runs of all methods {listed}."
    never = [method for method in METHODS.names if not any(method in shortest(name) for name in recorded())]
    yield "No run within 1e-6 m: " + ", ".join(f"`{method}`" for method in never) + "."


def tables() -> dict[str, PageTable]:
    """Return both tables."""
    return {"ends": ends(), "times": times()}


RECORD = Record("all_methods", lambda: map(Job, MECHANISMS), examine, again, PATIENCE)


if __name__ == "__main__":
    sys.exit(print_tables(tables(), sys.argv[1:]))
