"""What the abstract of the source claims, measured on its four mechanisms with its settings.

    python -m benchmarks.claims

The six methods of the source with `rk4` at 1 ms, and `dependent-correction`, which is `coordinate-partitioning` without
closed stages: violations, energy, the error of the motion, and processor time in turns with `lagrange`.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator
from functools import cache, partial

from benchmarks.page_tables import PageTable, list_of, number, print_tables
from symgen.study.comparison.combinations import DEFAULT_METHODS
from symgen.study.comparison.compare_models import compare
from symgen.study.comparison.comparison_rows import Row

#: Mechanisms of the source, as the catalogue names them.
MECHANISMS = ("four-bar", "bricard", "spatial-slider-crank", "front-suspension")
METHODS = (*DEFAULT_METHODS, "dependent-correction")
INTEGRATORS = ("rk4",)
PAGE = "docs/tables/source-claims.md"
HEADINGS = ("mechanism", "method", r"\|Phi\|", r"\|D v - nu\|", "energy [J]", "error [m]", "time")


@cache
def rows_of(mechanism: str) -> dict[str, Row]:
    """Return the rows of a mechanism by method."""
    study = compare(mechanism, METHODS, INTEGRATORS, [1e-3])
    return {row.method: row for row in study.rows}


def measures(mechanism: str, method: str) -> Iterator[str]:
    """Yield violations, energy error, error of the motion, and the ratio of times."""
    row = rows_of(mechanism)[method]
    for value in (row.position_violation_max, row.velocity_violation_max, row.energy_drift_max, row.error):
        yield "none" if value is None else number(value)
    yield "none" if row.cost_ratio is None else f"{row.cost_ratio:.2f}"


def table() -> PageTable:
    """Return the table of all methods on all mechanisms."""
    pairs = [(mechanism, method) for mechanism in MECHANISMS for method in METHODS]
    rows = tuple(((name, f"`{method}`"), partial(list_of, measures, name, method)) for name, method in pairs)
    return PageTable("claims", PAGE, HEADINGS, rows, times=(6,), integrators=INTEGRATORS)


if __name__ == "__main__":
    sys.exit(print_tables({"claims": table()}, sys.argv[1:]))
