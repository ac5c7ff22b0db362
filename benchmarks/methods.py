"""Every method on every mechanism of the catalogue: violations, energy drift and cost relative to `lagrange`.

`rk4` at 1e-3 s over 10 s, or the method's own integrator where it does not fit; `andrews` at 1e-5 s to 0.05 s, and once
more at 1e-3 s, which is 1.4 rad a step and expected to fail. Times are the best of several runs, `lagrange` before and
after each method; the ratios of the source are those of its interpreted code.

    python -m benchmarks.methods [MODEL ...] [--repeat 5] [--overhead 9]
"""

from __future__ import annotations

import argparse
import statistics
import sys
from collections.abc import Sequence
from dataclasses import dataclass

from rich.table import Table

from benchmarks.show import show
from symgen.api import Model, load
from symgen.derive.methods import METHODS
from symgen.result.result import Result
from symgen.run.integrators import INTEGRATORS
from symgen.run.planning.automatic import constant_integrator

#: Model -> step [s], end [s].
MODELS = {
    "pendulum": (1e-3, 10.0),
    "four-bar": (1e-3, 10.0),
    "slider-crank": (1e-3, 10.0),
    "n-four-bar:2": (1e-3, 10.0),
    "driven-four-bar": (1e-3, 10.0),
    "andrews": (1e-5, 0.05),
}
#: What is too long a step for a mechanism, to be seen failing.
TOO_LONG = {"andrews": (1e-3, 0.05)}
#: Ratios of the source on its planar four-bar.
SOURCE = {"baumgarte": 1.62, "augmented-lagrangian": 1.82, "direct-correction": 1.21}


@dataclass(frozen=True)
class Row:
    """One method on one mechanism; `ratio` is its run time over that of `lagrange`, None where a run broke off."""

    model: str
    method: str
    integrator: str
    step: float
    status: str
    reason: str
    position: float
    velocity: float
    energy: float
    ratio: float | None


def simulate(model: Model, method: str, step: float, until: float, repeat: int) -> Result:
    """Run with constant steps; only the end is kept, so that outputs cost nothing."""
    scheme = INTEGRATORS.get(constant_integrator(method))
    options = {"integrator.adaptive": "false"} if scheme.adaptive else {}
    return model.simulate(
        method=method,
        integrator=constant_integrator(method),
        step=step,
        until=until,
        times=[until],
        repeat=repeat,
        options=options,
    )


def row(name: str, method: str, step: float, until: float, repeat: int) -> Row:
    """Measure one method."""
    model = load(name)
    before = simulate(model, "lagrange", step, until, repeat)
    result = simulate(model, method, step, until, repeat)
    after = simulate(model, "lagrange", step, until, repeat)
    whole = result.steps > 0 and result.status != "failed" and before.status != "failed"
    base = min(before.seconds.run, after.seconds.run)
    return Row(
        model=name,
        method=method,
        integrator=result.integrator,
        step=step,
        status=result.status,
        reason=result.reason or "",
        position=result.position_violation_max,
        velocity=result.velocity_violation_max,
        energy=result.energy_drift_max,
        ratio=result.seconds.run / base if whole else None,
    )


def overhead(method: str, name: str = "four-bar", runs: int = 9) -> tuple[float, float, float]:
    """Return the median, smallest and largest of the ratios of run times to `lagrange`, each in turns."""
    model, (step, until) = load(name), MODELS[name]
    ratios = []
    for _ in range(runs):
        base, other = (simulate(model, m, step, until, 15).seconds.run for m in ("lagrange", method))
        ratios.append(other / base)
    return statistics.median(ratios), min(ratios), max(ratios)


def table(rows: Sequence[Row]) -> Table:
    """Return the rows of one mechanism as a table."""
    title = f"{rows[0].model}, step {rows[0].step:g} s"
    result = Table(title=title)
    headings = (
        "method",
        "integrator",
        "status",
        "|Phi| [m]",
        "|D v - nu|",
        "energy drift [J]",
        "time",
        "source",
        "reason",
    )
    for heading in headings:
        result.add_column(heading, justify="left" if heading in ("method", "integrator", "reason") else "right")
    for r in rows:
        ratio = "" if r.ratio is None else f"{r.ratio:.2f}"
        source = f"{SOURCE[r.method]:.2f}" if r.method in SOURCE and r.model == "four-bar" else ""
        numbers = f"{r.position:.1e}", f"{r.velocity:.1e}", f"{r.energy:.1e}", ratio, source
        result.add_row(r.method, r.integrator, r.status, *numbers, r.reason[:60])
    return result


def main(arguments: Sequence[str] | None = None) -> int:
    """Print one table a mechanism, and the overheads that are promised."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.methods", description=__doc__)
    parser.add_argument("models", nargs="*", default=list(MODELS), help="models of the catalogue")
    parser.add_argument("--repeat", type=int, default=5, help="timed runs of each method")
    parser.add_argument("--overhead", type=int, default=9, help="pairs of runs behind the overheads; 0: none")
    options = parser.parse_args(arguments)
    for name in options.models:
        for step, until in (MODELS[name], *([TOO_LONG[name]] if name in TOO_LONG else [])):
            show(table([row(name, m, step, until, options.repeat) for m in METHODS.names]))
    if options.overhead:
        summary = Table(
            title=f"four-bar, rk4: run time over that of lagrange, {options.overhead} pairs, best of 15 each"
        )
        for heading in ("method", "median", "smallest", "largest", "source"):
            summary.add_column(heading)
        for method in ("lagrange", *SOURCE):
            numbers = [f"{x:.3f}" for x in overhead(method, runs=options.overhead)]
            summary.add_row(method, *numbers, f"{SOURCE[method]:.2f}" if method in SOURCE else "1")
        show(summary)
    return 0


if __name__ == "__main__":
    sys.exit(main())
