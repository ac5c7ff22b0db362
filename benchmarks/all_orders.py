"""Observed order of every allowed pair of method and integrator, with constant steps on `four-bar`.

The slope is fitted as `benchmarks.orders` does: over the finest steps that span three halvings above 100 times the
method's floor. The floor is the least error that the pair reaches at finer steps than those (rounding, the tolerances of
iterations), and the spread of the reference. The reference is

- for all methods that converge to the constrained motion: `lagrange` with `dop853` at fine steps;
- for `penalty`, which by construction converges to the motion of another mechanism (the constraints hold up to 1/penalty):
  its own solution at fine steps with `dop853`.

Declared orders are those of the integrator, but `ggl` has that of stabilised index 2 (`index2_order`).

    python -m benchmarks.all_orders [METHOD ...]
"""

from __future__ import annotations

import math
import sys
from dataclasses import dataclass
from functools import cache

import numpy as np
from numpy.typing import NDArray
from rich.table import Table

from benchmarks.orders import fitted_slope
from benchmarks.pairs import allowed_pairs
from benchmarks.show import show
from symgen.api import Model, Settings, load, make_plan
from symgen.integrators import INTEGRATORS
from symgen.methods import METHODS
from symgen.runtime.run import RunSpec, integrate

Array = NDArray[np.float64]

MODEL, UNTIL = "four-bar", 2.0
#: Integrator -> number of steps: the coarsest, and how many times it is multiplied by the root of 2.
STEPS = {
    "euler": (512, 12),
    "heun": (64, 13),
    "rk4": (16, 16),
    "abm4": (32, 15),
    "dopri5": (8, 14),
    "abm": (16, 11),
    "dop853": (3, 13),
    "trapezoidal": (32, 12),
    "newmark": (32, 12),
    "generalized-alpha": (64, 12),
    "sdirk": (8, 12),
    "radau5": (4, 11),
}
#: Methods that converge to a motion of their own.
OWN_REFERENCE = ("penalty",)
#: What an observed order may fall short of the declared one.
TOLERANCE = 0.2


@dataclass(frozen=True)
class Pair:
    """What one pair shows; `slope` is None where three halvings above the floor were not found."""

    method: str
    integrator: str
    order: int
    counts: tuple[int, ...]
    errors: tuple[float, ...]
    floor: float
    slope: float | None

    @property
    def kept(self) -> bool:
        """Whether the declared order is seen."""
        return self.slope is not None and self.slope >= self.order - TOLERANCE


def declared_order(method: str, integrator: str) -> int:
    """Return the order that the pair promises."""
    scheme = INTEGRATORS.get(integrator)
    if METHODS.get(method).forms == ("index-2",):
        return int(getattr(scheme, "index2_order", scheme.order))
    return scheme.order


def final_positions(model: Model, method: str, integrator: str, count: int, until: float = UNTIL) -> Array:
    """Return q after `count` constant steps; not a number where the run broke off."""
    plan = make_plan(model, Settings(method=method, integrator=integrator))
    compiled, start = model.ready(plan)
    spec = RunSpec(
        until=until,
        step=until / count,
        adaptive=False,
        times=np.array([until]),
        max_violation=math.inf,
        max_energy_error=math.inf,
    )
    outcome = integrate(compiled, plan.tableau, start, spec)
    nq = compiled.info.nq
    return outcome.states[-1, :nq] if len(outcome.states) else np.full(nq, math.nan)


@cache
def reference(method: str) -> tuple[Array, float]:
    """Return q at the end, and how well it is known."""
    model, own = load(MODEL), method if method in OWN_REFERENCE else "lagrange"
    fine, finer = (final_positions(model, own, "dop853", count) for count in (500, 700))
    return finer, float(np.abs(finer - fine).max())


def step_counts(integrator: str) -> list[int]:
    """Return the numbers of steps to try, growing by the root of 2."""
    first, times = STEPS[integrator]
    return [round(first * 2 ** (k / 2)) for k in range(times + 1)]


def observe(method: str, integrator: str) -> Pair:
    """Return what one pair shows."""
    model = load(MODEL)
    exact, spread = reference(method)
    counts = step_counts(integrator)
    errors = [float(np.abs(final_positions(model, method, integrator, n) - exact).max()) for n in counts]
    finite = [e for e in errors if math.isfinite(e)]
    # rounding cannot be seen where the last errors still fall as the order says
    best = float(np.abs(final_positions(model, method, integrator, 2 * counts[-1]) - exact).max())
    order = declared_order(method, integrator)
    falls = bool(finite) and best < 0.6 * finite[-1]
    floor = max(spread, 1e-15 if falls else best)
    return Pair(method, integrator, order, tuple(counts), tuple(errors), floor, fitted_slope(counts, errors, floor))


def table(pairs: list[Pair]) -> Table:
    """Return the orders as a table; pairs that miss theirs are marked."""
    result = Table(title=f"{MODEL}, {UNTIL:g} s: observed orders, constant steps; errors of q at the end")
    for heading in ("method", "integrator", "order", "slope", "floor", "coarsest", "finest", ""):
        result.add_column(heading, justify="left" if heading in ("method", "integrator") else "right")
    for p in pairs:
        ends = [f"{p.errors[i]:.1e} ({p.counts[i]})" for i in (0, -1)]
        slope = "none" if p.slope is None else f"{p.slope:.2f}"
        mark = "" if p.kept else "MISSED"
        result.add_row(p.method, p.integrator, str(p.order), slope, f"{p.floor:.1e}", *ends, mark)
    return result


def main(arguments: list[str]) -> int:
    """Print the table for the methods asked for; the exit status is 1 if an order is missed."""
    pairs = [observe(m, i) for m, i in allowed_pairs() if not arguments or m in arguments]
    show(table(pairs))
    return 0 if all(p.kept for p in pairs) else 1


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
