"""Run time of methods at equal errors, as ratios to `lagrange`: five mechanisms, three integrators, two errors.

    python -m benchmarks.equal_error                       the table of its page, from the record
    python -m benchmarks.records equal_error --workers N   measures the record, two minutes with 15 cores

A mechanism with an integrator is a study of `symgen compare --at`: nine steps or eleven tolerances a method, all timed
in turn, nine rounds. Errors are shares of the mechanism's length. Cells are the medians of the rounds' ratios at both
errors, of the CPU time of one process each, so that several processes want a core each; one that is empty has no two
settings with errors on both sides.
"""

from __future__ import annotations

import itertools
import math
import random
import statistics
import sys
from collections.abc import Iterator, Mapping, Sequence
from functools import partial
from typing import Any, NamedTuple

from benchmarks.page_tables import PageTable, list_of, print_tables
from benchmarks.records import Line, Pair, Record
from symgen.study.comparison.combinations import DEFAULT_METHODS
from symgen.study.comparison.compare_models import compare

#: Length [m], end of the run and largest step [s] of each mechanism.
MECHANISMS = {
    "four-bar": (4.0, 10.0, 1.6e-2),
    "slider-crank": (0.225, 5.0, 8e-3),
    "andrews": (0.04, 0.03, 1.6e-4),
    "bricard": (0.5, 10.0, 6.4e-2),
    "spatial-slider-crank": (0.15, 2.0, 8e-3),
}
INTEGRATORS = ("rk4", "dop853", "picard")
METHODS = (
    *("lagrange", "baumgarte", "velocity-projection", "direct-correction", "direct-correction:weight=mass"),
    *(name for name in reversed(DEFAULT_METHODS) if name not in ("lagrange", "baumgarte", "direct-correction")),
)
#: Errors, as largest distances of points of bodies over the length of the mechanism [1].
ERRORS = (1e-6, 1e-8)
#: Number of constant steps of a method, each half of the one before it, and tolerances.
STEPS, RTOLS = 9, tuple(10.0**-k for k in range(2, 13))
#: What is stored of a run time at an error.
NUMBERS = ("seconds", "ratio", "ratio_low", "ratio_high")
#: Factor by which ratios may differ from those of the record, whose code is older: its yardstick took longer.
OLDER = 3.0
#: Processor time of a study at most [s].
PATIENCE = 280.0


class Job(NamedTuple):
    """A mechanism with an integrator, in one of two sessions on different machines."""

    mechanism: str
    integrator: str
    session: int = 2


def examine(job: Job, methods: Sequence[str] = METHODS) -> dict[str, Any]:
    """Return, for each method, its run times [s], and their ratio to `lagrange` with quartiles, at all errors."""
    length, until, step = MECHANISMS[job.mechanism]
    steps, errors = [step / 2**k for k in range(STEPS)], [length * error for error in ERRORS]
    study = compare(
        job.mechanism, methods, (job.integrator,), steps, RTOLS, until=until, repeat=1, error_at=errors
    ).to_json()
    at: dict[str, list[list[float | None]]] = {method: [] for method in methods}
    for error in errors:
        for method in methods:
            times = [x for x in study["at"] if x["method"] == label(method) and math.isclose(x["error"], error)]
            at[method].append([times[0][key] if times else None for key in NUMBERS])
    return {"at": at}


def label(method: str) -> str:
    """Return the label of a line of a study, such as ``direct-correction, weight=mass``."""
    return method.replace(":", ", ")


def ratio(cell: Sequence[float | None]) -> str:
    """Return a ratio as a cell, empty if there is none."""
    middle = cell[1]
    return "" if middle is None else f"{middle:.2f}" if middle < 9.95 else f"{middle:.0f}"


def again(stored: Line, dice: random.Random) -> Iterator[Pair]:
    """Yield the ratios of one method on a mechanism beside those measured again."""
    method = dice.choice(METHODS[1:])
    job = Job(stored["mechanism"], stored["integrator"], stored["session"])
    new = examine(job, ("lagrange", method))["at"][method]
    for error, one, other in zip(ERRORS, stored["at"][method], new, strict=True):
        yield Pair(f"{job.mechanism}, {job.integrator}, {method} at {error:g}", one[1], other[1], OLDER)


def page_table() -> PageTable:
    """Return the ratios at both errors."""
    lines = studies()

    def cells(job: Job) -> Iterator[str]:
        for method in METHODS[1:]:
            yield ", ".join(map(ratio, lines[job][method]))

    rows = tuple(
        ((f"`{job.mechanism}`", f"`{job.integrator}`"), partial(list_of, cells, job))
        for job in lines
        if job.session == 2
    )
    headings = ("mechanism", "integrator", *(f"`{m}`".replace(":weight=mass`", "`, mass") for m in METHODS[1:]))
    return PageTable("equal_error", "docs/tables/equal-error.md", headings, rows, stored=True, claims=claims)


def claims() -> Iterator[str]:
    """Yield what the page says of the ratios."""

    def span(method: str, *integrators: str) -> tuple[str, str, str]:
        values = [x for i in integrators for x in ratios(method, i)]
        low, middle, high = min(values), statistics.median(values), max(values)
        return f"{low:.2f} to {high:.2f}", f"{middle:.2f}", f"{high:.0f}"

    velocity, direct = "velocity-projection", "direct-correction"
    yield (
        f"With `rk4`, the source's integrator, `{velocity}` takes {span(velocity, 'rk4')[0]} and `{direct}` "
        f"{span(direct, 'rk4')[0]} times as long as `lagrange` on all five mechanisms."
    )
    others = INTEGRATORS[1:]
    yield (
        f"With `dop853` and `picard` `{velocity}` takes {span(velocity, *others)[0]} times as long, "
        f"{span(velocity, *others)[1]} in the middle, and `{direct}` {span(direct, *others)[0]}, "
        f"{span(direct, *others)[1]} in the middle."
    )
    low = min(ratios("direct-correction:weight=mass", "rk4"))
    yield f"The metric of M is worth most in space with `rk4`: {low:.2f}."
    dear, together = ([x for m in METHODS[5:] for i in own for x in ratios(m, i)] for own in (others[:1], others[1:]))
    dear += [x for m in METHODS[5:] for x in ratios(m, "rk4")]
    yield (
        f"`baumgarte` takes {span('baumgarte', *INTEGRATORS)[0]} times as long; `coordinate-partitioning` and what "
        f"iterates {statistics.median(dear):.1f} times in the middle with `rk4` and `dop853`, up to {max(dear):.1f}."
    )
    yield (
        f"With `picard` the same three take up to {max(together):.0f} times as long. That is a property of symgen, not "
        "of the methods: they have no form in vectors, so that nodes are evaluated one by one."
    )
    lines, both = studies(), []
    for job in lines:
        for method in METHODS[1:] if job.session == 2 else ():
            for one, other in zip(lines[job][method], lines[job._replace(session=1)][method], strict=True):
                if one[1] and other[1]:
                    both.append((other[1] / one[1], (one[1] - 1.0) * (other[1] - 1.0) < 0.0, one[1], other[1]))
    quotients, crossed = sorted(row[0] for row in both), [x for row in both if row[1] for x in row[2:]]
    edge = len(both) // 20
    yield (
        f"On another machine nine in ten of the {len(both)} ratios were {quotients[edge]:.2f} to "
        f"{quotients[-edge - 1]:.2f} times these; {len(crossed) // 2}, all between {min(crossed):.2f} and "
        f"{max(crossed):.2f}, lay on the other side of 1."
    )
    spread = [(c[3] - c[2]) / c[1] for at in lines.values() for m in METHODS[1:] for c in at[m] if c[1]]
    yield f"The quartiles of the nine rounds lie {100 * statistics.median(spread):.0f} % apart in the middle."


def studies() -> dict[Job, Mapping[str, Any]]:
    """Return the cells of the record."""
    own = {
        Job(line["mechanism"], line["integrator"], line["session"]): line["at"]
        for line in RECORD.lines()
        if "at" in line
    }
    return {job: own[job] for job in jobs() if job in own}


def ratios(method: str, integrator: str) -> list[float]:
    """Return the ratios of a method with an integrator in the second session."""
    cells = (at[method] for job, at in studies().items() if (job.integrator, job.session) == (integrator, 2))
    return [cell[1] for both in cells for cell in both if cell[1]]


def jobs() -> Iterator[Job]:
    """Yield the mechanisms with each integrator."""
    return (Job(*pair, session) for session in (1, 2) for pair in itertools.product(MECHANISMS, INTEGRATORS))


RECORD = Record("equal_error", jobs, examine, again, PATIENCE)


if __name__ == "__main__":
    sys.exit(print_tables({"equal_error": page_table()}, ()))
