"""A stiff case: implicit schemes at steps 100 times larger than explicit ones can take.

The coupler of a four-bar is elastic, 1e8 N/m with a strong damper. The largest stable step of `rk4` is found by
bisection; implicit pairs run at 100 times that and are compared with a tight run of `radau5`, which in turn is compared
with an explicit run below the limit.

    python -m benchmarks.stiff
"""

from __future__ import annotations

import sys
from dataclasses import dataclass
from functools import cache
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from rich.table import Table

from benchmarks.motions import positions, run
from benchmarks.show import show
from symgen.api import Model, load
from symgen.integrators import INTEGRATORS
from symgen.result.points import Points

Array = NDArray[np.float64]

UNTIL = 0.5
TIMES = np.linspace(0.0, UNTIL, 6)
FACTOR = 100.0
PAIRS = (
    ("direct-correction", "radau5"),
    ("lagrange", "radau5"),
    ("baumgarte", "radau5"),
    ("ggl", "radau5"),
    ("direct-correction", "sdirk"),
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
class Row:
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
    return rows[0], points().distance(rows[0], rows[1])


def points() -> Points:
    """Return the points that errors are taken of."""
    return Points.of(model().mechanism, model().parameters())


def row(method: str, integrator: str, step: float) -> Row:
    """Run one pair with a constant step."""
    result = run(model(), method, integrator, step, TIMES)
    q, exact = positions(result), reference()[0]
    error = points().distance(q, exact[: len(q)]) if len(q) > 1 else np.inf
    return Row(method, integrator, step, result.status, error, result.steps, result.seconds.run, result.reason or "")


def main() -> int:
    """Print the table."""
    limit = explicit_limit()
    explicit = run(model(), "direct-correction", "rk4", limit / 1.5, TIMES)
    distance = points().distance(positions(explicit), reference()[0])
    table = Table(
        title=f"elastic coupler, {UNTIL:g} s: rk4 is stable up to {limit:.3g} s; steps {FACTOR:g} times larger"
    )
    for heading in ("method", "integrator", "order", "step [s]", "status", "error [m]", "steps", "run [ms]", "reason"):
        table.add_column(heading, justify="left" if heading in ("method", "integrator") else "right")
    for r in (row(m, i, limit * FACTOR) for m, i in PAIRS):
        numbers = f"{r.step:.2e}", r.status, f"{r.error:.1e}", str(r.steps), f"{r.seconds * 1e3:.1f}", r.reason[:70]
        table.add_row(r.method, r.integrator, str(INTEGRATORS.get(r.integrator).order), *numbers)
    table.caption = (
        f"reference: radau5 at 1e-4 s, {reference()[1]:.1e} m from ggl at 1.25e-4 s; rk4 at {limit / 1.5:.2e} s: "
        f"{explicit.steps} steps, {explicit.seconds.run * 1e3:.1f} ms, {distance:.1e} m from it"
    )
    show(table)
    return 0


if __name__ == "__main__":
    sys.exit(main())
