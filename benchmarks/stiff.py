"""A stiff case: implicit schemes at steps 100 times larger than explicit ones can take.

The coupler of a four-bar is elastic, 1e8 N/m with a strong damper. The largest stable step of `rk4` is found by
bisection; implicit pairs run at 100 times that and are compared with a tight run of `radau5`, which in turn is compared
with `ggl` at another step.

    python -m benchmarks.stiff
"""

from __future__ import annotations

import sys
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache, partial
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from benchmarks.motions import positions, run
from benchmarks.page_tables import PageTable, Row, list_of, number, print_tables
from symgen.api import Model, load
from symgen.result.points import Points
from symgen.run.integrators import INTEGRATORS

Array = NDArray[np.float64]

UNTIL = 0.5
TIMES = np.linspace(0.0, UNTIL, 6)
FACTOR = 100.0
#: About `FACTOR` times the largest stable step of `rk4`.
STEP = 5e-3
PAIRS = (
    ("direct-correction", "radau5"),
    ("lagrange", "radau5"),
    ("baumgarte", "radau5"),
    ("ggl", "radau5"),
    ("direct-correction", "sdirk"),
    ("direct-correction", "rodas"),
    ("direct-correction", "trapezoidal"),
    ("direct-correction", "newmark"),
    ("generalized-alpha", "generalized-alpha"),
    ("index3-augmented-lagrangian", "trapezoidal"),
)


@cache
def model() -> Model:
    """Return the four-bar with an elastic coupler."""
    return load(Path(__file__).with_name("stiff-four-bar.toml"))


def explicit_limit(method: str = "direct-correction", integrator: str = "rk4") -> float:
    """Return the largest step [s] with which a run of 200 steps stays in bounds, by bisection in the logarithm."""

    def stable(step: float) -> bool:
        return run(model(), method, integrator, step, np.array([0.0, 200 * step])).status == "ok"

    low, high = 1e-7, 1e-2
    while high / low > 1.02:
        middle = float(np.sqrt(low * high))
        low, high = (middle, high) if stable(middle) else (low, middle)
    return low


@dataclass(frozen=True)
class Attempt:
    """One pair at a step far above the explicit limit."""

    method: str
    integrator: str
    step: float
    status: str
    error: float
    steps: int
    seconds: float
    reason: str


@cache
def reference() -> tuple[Array, float]:
    """Return q at `TIMES` from tight runs of `radau5` with two methods, and their distance [m]."""
    rows = []
    for method, step in (("direct-correction", 1e-4), ("ggl", 1.25e-4)):
        result = run(model(), method, "radau5", step, TIMES)
        assert result.status == "ok", result.reason
        rows.append(positions(result))
    return rows[0], points().largest_distance(rows[0], rows[1])


def points() -> Points:
    """Return the points that errors are taken of."""
    return Points.of_mechanism(model().mechanism, model().parameters())


def row(method: str, integrator: str, step: float) -> Attempt:
    """Run one pair with a constant step."""
    result = run(model(), method, integrator, step, TIMES)
    q, exact = positions(result), reference()[0]
    error = points().largest_distance(q, exact[: len(q)]) if len(q) > 1 else np.inf
    return Attempt(
        method, integrator, step, result.status, error, result.steps, result.seconds.run, result.reason or ""
    )


def table() -> PageTable:
    """Return the errors of all pairs at `STEP`, behind the largest stable step of `rk4`."""

    def cells(method: str, integrator: str) -> Iterator[str]:
        one = row(method, integrator, STEP)
        yield from (one.status, number(one.error))

    def explicit() -> Iterator[str]:
        yield from (f"stable to {explicit_limit():.1e} s".replace("e-0", "e-"), "")

    rows: list[Row] = [(("`direct-correction` with `rk4`", "4"), partial(list_of, explicit))]
    for method, integrator in PAIRS:
        names = f"`{method}` with `{integrator}`", str(INTEGRATORS.get(integrator).order)
        rows.append((names, partial(list_of, cells, method, integrator)))
    return PageTable("stiff", "docs/tables/stiff-limit.md", ("pair", "order", "status", "error [m]"), tuple(rows))


if __name__ == "__main__":
    sys.exit(print_tables({"stiff": table()}, sys.argv[1:]))
