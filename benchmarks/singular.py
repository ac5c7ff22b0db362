"""Singular passages: the N-four-bar through its collinear positions, at many step sizes.

Where steps land relative to the singular position matters more than their size, so each method is run at several steps
near 1e-3 s with RK4 for 10 s. The error is the largest distance of the pin B0 from the regular branch, which a reduced
equation in one coordinate gives. A method may be wrong; a run that is wrong must not end `ok` without a warning.

    python -m benchmarks.singular [N ...] [--steps 20] [--methods all] [--coordinates absolute,joint]
"""

from __future__ import annotations

import argparse
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from rich.table import Table

import symgen
from benchmarks.peers import models, reference
from benchmarks.show import show
from symgen.methods import METHODS as KINDS

METHODS: tuple[tuple[str, Mapping[str, str | float]], ...] = (
    ("direct-correction", {"method.weight": "identity"}),
    ("direct-correction", {"method.weight": "mass"}),
    ("lagrange", {}),
    ("baumgarte", {}),
)
UNTIL = 10.0
#: A run that is worse than this [m] has to say that something may be wrong.
WRONG = 1e-6


@dataclass(frozen=True)
class Passage:
    """One run: its step [s], error [m], status, and whether it carries a warning."""

    step: float
    error: float
    status: str
    warned: bool
    seconds: float


def run(
    windows: int, method: str, options: Mapping[str, str | float], step: float, coordinates: str = "absolute"
) -> Passage:
    """Run one step size; an error where the run did not reach the end is that up to there."""
    truth = models.load(f"n-four-bar:{windows}")
    times = reference.sample_times(truth)
    angle = reference.angles(truth)[:, 0]
    result = symgen.load(f"n-four-bar:{windows}").simulate(
        method=method, integrator="rk4", step=step, until=UNTIL, times=times, options=options, coordinates=coordinates
    )
    k = len(result.t)
    theta = result["vertical0.theta"]
    x = result["vertical0.x"] + 0.5 * np.cos(theta) - np.cos(angle[:k])
    y = result["vertical0.y"] + 0.5 * np.sin(theta) - np.sin(angle[:k])
    error = float(np.hypot(x, y).max()) if np.isfinite(x).all() and np.isfinite(y).all() else float("inf")
    return Passage(step, error, result.status, bool(result.warnings), result.seconds.run)


def silent(passages: Sequence[Passage]) -> int:
    """Count runs that are wrong, end `ok` and carry no warning."""
    return sum(p.error > WRONG and p.status == "ok" and not p.warned for p in passages)


def main(arguments: Sequence[str] | None = None) -> int:
    """Print the table; the exit status is 1 if a run was silently wrong."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.singular", description=__doc__)
    parser.add_argument("windows", type=int, nargs="*", default=[1, 2, 10], help="sizes of the N-four-bar")
    parser.add_argument("--steps", type=int, default=20, help="step sizes in [0.95, 1.05] 1e-3 s")
    parser.add_argument("--methods", choices=["few", "all"], default="few", help="those below, or all with defaults")
    parser.add_argument("--coordinates", default="absolute", help="absolute, joint, or both with a comma between")
    options = parser.parse_args(arguments)
    methods = (
        METHODS
        if options.methods == "few"
        else tuple((name, {}) for name, kind in KINDS.items() if "ode" in kind.forms)
    )
    title = f"N-four-bar through its singular positions: RK4, {UNTIL:g} s, {options.steps} steps in [0.95, 1.05]e-3 s"
    table = Table(title=title)
    for column in (
        "N",
        "method",
        "median [m]",
        "worst [m]",
        "> 1e-6 m",
        "statuses",
        "warned",
        "silently wrong",
        "run [ms]",
    ):
        table.add_column(column, justify="left" if column in ("method", "statuses") else "right")
    wrong = 0
    for windows in options.windows:
        for method, chosen, coordinates in (
            (method, chosen, coordinates)
            for coordinates in options.coordinates.split(",")
            for method, chosen in methods
        ):
            steps = np.linspace(0.95e-3, 1.05e-3, options.steps)
            passages = [run(windows, method, chosen, float(step), coordinates) for step in steps]
            errors = np.array([p.error for p in passages])
            statuses = ", ".join(f"{n} {status}" for status, n in sorted(Counter(p.status for p in passages).items()))
            wrong += silent(passages)
            table.add_row(
                str(windows),
                " ".join(
                    [
                        method,
                        *([] if coordinates == "absolute" else [coordinates]),
                        *(f"{key.partition('.')[2]}={value}" for key, value in chosen.items()),
                    ]
                ),
                f"{np.median(errors):.1e}",
                f"{errors.max():.1e}",
                str(int((errors > WRONG).sum())),
                statuses,
                str(sum(p.warned for p in passages)),
                str(silent(passages)),
                f"{np.median([p.seconds for p in passages]) * 1e3:.1f}",
            )
    table.caption = "errors of failed runs are those up to where they stopped"
    show(table)
    return 1 if wrong else 0


if __name__ == "__main__":
    raise SystemExit(main())
