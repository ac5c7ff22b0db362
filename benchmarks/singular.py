"""Singular passages: the N-four-bar through its collinear positions, at many step sizes.

Where steps land relative to the singular position matters more than their size, so each metric of the correction is run
at a hundred steps near 1e-3 s with `rk4` for 10 s. The error is the largest distance of the pin B0 from the regular
branch, which a reduced equation in one coordinate gives; an error where the run did not reach the end is that up to
there. Rounding decides the larger ones, so that quantiles differ by up to an order of magnitude between processors.

    python -m benchmarks.singular
"""

from __future__ import annotations

import sys
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import partial

import numpy as np

import symgen
from benchmarks.page_tables import PageTable, list_of, number, print_tables
from benchmarks.peers import models, reference

#: Numbers of windows, metrics, end of a run [s], and steps [s].
WINDOWS, WEIGHTS, UNTIL = (1, 2, 10), ("identity", "mass"), 10.0
STEPS = np.linspace(0.95e-3, 1.05e-3, 100)


@dataclass(frozen=True)
class Passage:
    """One run: its step [s], error [m], status, and whether it carries a warning."""

    step: float
    error: float
    status: str
    warned: bool


def run(windows: int, method: str, options: Mapping[str, str | float], step: float) -> Passage:
    """Run one step size."""
    truth = models.load(f"n-four-bar:{windows}")
    times = reference.sample_times(truth)
    angle = reference.angles(truth)[:, 0]
    result = symgen.load(f"n-four-bar:{windows}").simulate(
        method=method, integrator="rk4", step=step, until=UNTIL, times=times, options=options
    )
    k = len(result.t)
    theta = result["vertical0.theta"]
    x = result["vertical0.x"] + 0.5 * np.cos(theta) - np.cos(angle[:k])
    y = result["vertical0.y"] + 0.5 * np.sin(theta) - np.sin(angle[:k])
    error = float(np.hypot(x, y).max()) if np.isfinite(x).all() and np.isfinite(y).all() else float("inf")
    return Passage(step, error, result.status, bool(result.warnings))


def table() -> PageTable:
    """Return quantiles of the errors by metric."""

    def cells(windows: int) -> Iterator[str]:
        for weight in WEIGHTS:
            options = {"method.weight": weight}
            errors = [run(windows, "direct-correction", options, float(step)).error for step in STEPS]
            yield ", ".join(number(float(x)) for x in np.percentile(errors, [10, 50, 90]))

    rows = tuple(((str(windows),), partial(list_of, cells, windows)) for windows in WINDOWS)
    headings = ("windows", *(f"`weight={weight}`: 10, 50, 90 % [m]" for weight in WEIGHTS))
    return PageTable("singular", "docs/tables/singular-positions.md", headings, rows, loose=(1, 2))


if __name__ == "__main__":
    sys.exit(print_tables({"singular": table()}, sys.argv[1:]))
