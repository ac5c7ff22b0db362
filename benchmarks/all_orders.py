"""Observed order of every allowed pair of method and integrator, with constant steps on `four-bar`.

The error is the largest one of q at eight equidistant times. The slope is fitted over the finest steps that span three
halvings above 100 times the method's floor; where there are fewer, over those there are, and the table says how many.
The floor is the error at which finer steps gain nothing (rounding, the tolerances of iterations), at least the spread
of the reference. The reference is

- for all methods that converge to the constrained motion: `lagrange` with `dop853` at fine steps;
- for `penalty` and `compliant-constraints`, which by construction converge to the motion of another mechanism (the
  constraints hold up to 1/penalty): their own solution at fine steps with `dop853`.

Declared orders are those of the integrator, but `ggl` has that of stabilised index 2 (`index2_order`). Order 8 shows in
a narrow window only, between steps too long for the motion and the floor: there steps are tried at fourth roots of 2,
and some methods get parameters (`OPTIONS`) with which their floor is near 1e-13.

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

from benchmarks.orders import ABOVE_FLOOR, HALVINGS
from benchmarks.pairs import allowed_pairs
from benchmarks.show import show
from symgen.api import Model, load
from symgen.base.settings import Settings
from symgen.derive.methods import METHODS
from symgen.run.integrators import INTEGRATORS
from symgen.run.loops.run_spec import RunSpec
from symgen.run.planning.prepare import prepare
from symgen.run.single.run import integrate

Array = NDArray[np.float64]

MODEL, UNTIL = "four-bar", 2.0
#: Times at which errors are taken.
OUTPUTS = 8
#: Integrator -> number of steps: the coarsest, how many times it is doubled, and in how many parts.
STEPS = {
    "euler": (512, 6, 2),
    "heun": (64, 6, 2),
    "rk4": (16, 8, 2),
    "rkmk4": (16, 8, 2),
    "rkmk4-screws": (16, 8, 2),
    "abm4": (32, 7, 2),
    "dopri5": (8, 7, 2),
    "abm": (8, 6, 4),
    "dop853": (8, 5, 4),
    "picard": (12, 2, 4),
    "trapezoidal": (32, 6, 2),
    "newmark": (32, 6, 2),
    "generalized-alpha": (64, 6, 2),
    "hht": (64, 6, 2),
    "half-explicit": (32, 7, 2),
    "phem56": (8, 7, 2),
    "rattle": (64, 6, 2),
    "discrete-gradient": (64, 6, 2),
    "gauss": (8, 6, 2),
    "symplectic-euler": (512, 6, 2),
    "sdirk": (8, 6, 2),
    "rodas": (8, 6, 2),
    "radau5": (8, 6, 2),
    "bdf": (64, 5, 2),
}
#: Parameters that differ from the defaults.
OPTIONS: dict[str, dict[str, float]] = {
    "penalty": {"method.penalty": 1e4},
    "augmented-hamiltonian": {"method.penalty": 1e4},
    "hamiltonian-baumgarte": {"method.penalty": 1e4},
    "compliant-constraints": {"method.compliance": 1e-4},
}
#: Methods that converge to a motion of their own.
OWN_REFERENCE = ("penalty", "compliant-constraints")
#: Methods whose gains grow like one over the step: what they leave of any higher order.
LEFT = {"braun-goldfarb": 2}
#: Pairs whose order cannot be seen on this mechanism, and why.
UNSEEN = {(method, "picard"): "order 16 leaves no three halvings above rounding" for method in METHODS.names} | {
    ("braun-goldfarb", "abm"): "minus one is outside of its region of stability",
    ("energy-projection", "abm"): "velocities scaled from rest leave a floor of 1e-10",
}
#: What an observed order may fall short of the declared one; and the fitted one, where the finest halving has it: with
#: `phem56` the error of 2 s in n steps is C / n^5 (1 - (130 / n)^2), whose second term bends the fit.
TOLERANCE, BENT = 0.2, 0.5


@dataclass(frozen=True)
class Pair:
    """What one pair shows.

    `slope` is None where three halvings above the floor were not found; `finest` is that of the finest one.
    """

    method: str
    integrator: str
    order: int
    counts: tuple[int, ...]
    errors: tuple[float, ...]
    floor: float
    slope: float | None
    halvings: float
    finest: float

    @property
    def is_right(self) -> bool:
        """Whether the declared order is seen."""
        if self.slope is None:
            return False
        bent = self.slope >= self.order - BENT and self.finest >= self.order - TOLERANCE
        return self.slope >= self.order - TOLERANCE or bent


def declared_order(method: str, integrator: str) -> int:
    """Return the order that the pair promises."""
    scheme = INTEGRATORS.get(integrator)
    if METHODS.get(method).forms == ("index-2",):
        return int(getattr(scheme, "index2_order", scheme.order))
    return min(scheme.order, LEFT.get(method, scheme.order))


def positions(model: Model, method: str, integrator: str, count: int) -> Array:
    """Return q at the times of comparison, from `count` constant steps; not a number where the run broke off."""
    settings = Settings(method=method, integrator=integrator, options=OPTIONS.get(method, {}))
    run = prepare(model.mechanism, settings)
    spec = RunSpec(
        until=UNTIL,
        step=UNTIL / count,
        adaptive=False,
        times=np.linspace(0.0, UNTIL, OUTPUTS + 1)[1:],
        max_violation=math.inf,
        max_energy_error=math.inf,
    )
    outcome = integrate(run.compiled, run.plan.integrator, run.start, spec)
    nq = run.compiled.info.nq
    return outcome.states[:, :nq] if len(outcome.states) == OUTPUTS else np.full((OUTPUTS, nq), math.nan)


@cache
def reference(method: str) -> tuple[Array, float]:
    """Return q at the times of comparison, and how well it is known."""
    fine, finer = (positions(load(MODEL), method, "dop853", count) for count in (360, 500))
    return finer, float(np.abs(finer - fine).max())


def step_counts(integrator: str) -> list[int]:
    """Return the numbers of steps to try."""
    first, doublings, parts = STEPS[integrator]
    return [round(first * 2 ** (k / parts)) for k in range(doublings * parts + 1)]


def observe(method: str, integrator: str) -> Pair:
    """Return what one pair shows."""
    model = load(MODEL)
    exact, spread = reference(method if method in OWN_REFERENCE else "lagrange")

    def error(count: int) -> float:
        return float(np.abs(positions(model, method, integrator, count) - exact).max())

    counts = step_counts(integrator)
    errors = [error(n) for n in counts]
    order = declared_order(method, integrator)
    # where the last errors still fall by half of what the order says, no floor is in sight
    beyond = error(2 * counts[-1])
    floor = spread if beyond < errors[-1] * 2.0 ** (-order / 2) else max(spread, beyond, errors[-1])
    return Pair(method, integrator, order, tuple(counts), tuple(errors), floor, *fitted(counts, errors, floor))


def fitted(counts: list[int], errors: list[float], floor: float) -> tuple[float | None, float, float]:
    """Return the slope over the finest steps clear of the floor, the halvings that they span, and the finest slope.

    Steps at which a run broke off end the window. Less than one and a half halvings show no order.
    """
    window: list[tuple[int, float]] = []
    for n, e in sorted(zip(counts, errors, strict=True), reverse=True):
        if e <= ABOVE_FLOOR * floor and not window:
            continue
        if not e < 1.0 or (window and window[0][0] >= 2**HALVINGS * n * 1.05):
            break
        window.append((n, e))
    span = math.log2(window[0][0] / window[-1][0]) if window else 0.0
    if span < 1.5:
        return None, span, math.nan
    logs = np.log([n for n, _ in window]), np.log([e for _, e in window])
    fine = logs[0] > logs[0][0] - 1.05 * math.log(2.0)
    whole, finest = (-float(np.polyfit(x, y, 1)[0]) for x, y in (logs, (logs[0][fine], logs[1][fine])))
    return whole, span, finest


def table(pairs: list[Pair]) -> Table:
    """Return the orders as a table; pairs that miss theirs are marked."""
    result = Table(title=f"{MODEL}, {UNTIL:g} s: observed orders, constant steps; largest errors of q")
    for heading in ("method", "integrator", "order", "slope", "halvings", "finest", "floor", "coarsest", "finest", ""):
        result.add_column(heading, justify="left" if heading in ("method", "integrator") else "right")
    for p in pairs:
        ends = [f"{p.errors[i]:.1e} ({p.counts[i]})" for i in (0, -1)]
        slope = "none" if p.slope is None else f"{p.slope:.2f}"
        mark = "" if p.is_right else UNSEEN.get((p.method, p.integrator), "MISSED")
        result.add_row(
            p.method,
            p.integrator,
            str(p.order),
            slope,
            f"{p.halvings:.1f}",
            f"{p.finest:.2f}",
            f"{p.floor:.1e}",
            *ends,
            mark,
        )
    return result


def main(arguments: list[str]) -> int:
    """Print the table for the methods asked for; the exit status is 1 if an order is missed."""
    pairs = [observe(m, i) for m, i in allowed_pairs() if not arguments or m in arguments]
    show(table(pairs))
    return 0 if all(p.is_right or (p.method, p.integrator) in UNSEEN for p in pairs) else 1


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
