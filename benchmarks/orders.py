"""Observed orders of convergence: every integrator, with constant steps, on every method.

The slope is fitted to the errors at the finest steps that span three halvings above 100 times the method's floor. The
floor is what rounding leaves: the error with `BEST` at steps as fine as the finest tried. If
positions do not depend on the step at all (a driven mechanism whose positions are corrected), there is nothing to fit.

    python -m benchmarks.orders [MODEL ...]
"""

from __future__ import annotations

import math
import sys
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from rich.console import Console
from rich.table import Table

from symgen.api import Model, load
from symgen.run.integrators import INTEGRATORS
from symgen.run.loops.run_spec import RunSpec
from symgen.run.single.run import integrate

Array = NDArray[np.float64]

#: Model -> time over which errors grow [s].
MODELS = {"four-bar": 2.0, "driven-four-bar": 1.0}
#: Methods whose law is a formula; others, whose orders depend on their own parameters, are given by name.
METHODS = ("lagrange", "baumgarte", "direct-correction")
#: Integrator -> number of steps: the coarsest, and how many times it is multiplied by the root of 2.
STEPS = {"rk4": (16, 16), "dopri5": (8, 14), "dop853": (3, 13)}
#: The integrator whose error at fine steps is the floor.
BEST = "dop853"
HALVINGS = 3.0
ABOVE_FLOOR = 100.0


@dataclass(frozen=True)
class Observed:
    """Errors of one method with one integrator; `slope` is None where no order can be seen."""

    model: str
    method: str
    integrator: str
    order: int
    counts: tuple[int, ...]
    errors: tuple[float, ...]
    floor: float
    slope: float | None


def step_counts(integrator: str) -> list[int]:
    """Return the numbers of steps to try, growing by the root of 2."""
    first, times = STEPS[integrator]
    return [round(first * 2 ** (k / 2)) for k in range(times + 1)]


def final_state(model: Model, method: str, integrator: str, count: int, until: float) -> Array:
    """Return q and v after `count` constant steps; not a number where the run broke off."""
    compiled = model.compile(method)
    spec = RunSpec(
        until=until,
        step=until / count,
        adaptive=False,
        times=np.array([until]),
        max_violation=math.inf,
        max_energy_error=math.inf,
    )
    outcome = integrate(compiled, INTEGRATORS.get(integrator), model.assemble(compiled), spec)
    info = compiled.info
    return outcome.states[-1, :-1] if len(outcome.states) else np.full(info.nq + info.nv, math.nan)


def linkage(t: float) -> Array:
    """Return q of `driven-four-bar` at time `t` in closed form: the circles about B and D meet in C."""
    phi = math.pi / 3 + 2.0 * math.pi * t
    b, d = 2.0 * complex(math.cos(phi), math.sin(phi)), complex(10.0, 0.0)
    gap = d - b
    along = (abs(gap) ** 2 + 8.0**2 - 5.0**2) / (2.0 * abs(gap))
    c = b + gap / abs(gap) * complex(along, math.sqrt(8.0**2 - along**2))
    middles = b / 2.0, (b + c) / 2.0, (c + d) / 2.0
    coupler, rocker = c - b, c - d
    angles = phi, math.atan2(coupler.imag, coupler.real), math.atan2(rocker.imag, rocker.real)
    return np.array([x for m, a in zip(middles, angles, strict=True) for x in (m.real, m.imag, a)])


def reference(name: str, model: Model, until: float) -> tuple[Array, float]:
    """Return q at `until` and how well it is known: in closed form, or where fine steps agree."""
    if name == "driven-four-bar":
        return linkage(until), 1e-15
    fine, finer = (final_state(model, "lagrange", "dop853", count, until) for count in (500, 700))
    nq = len(model.initial_state(model.parameters())[0])
    return finer[:nq], float(np.abs(finer - fine)[:nq].max())


def fitted_slope(counts: list[int], errors: list[float], floor: float) -> float | None:
    """Return minus the slope of log error over log count, over the finest steps that are clear of the floor."""
    usable = [(n, e) for n, e in zip(counts, errors, strict=True) if ABOVE_FLOOR * floor < e < 1.0]
    coarsest = usable[-1][0] / (0.93 * 2**HALVINGS) if usable else 0.0  # counts are rounded
    first = max((n for n, _ in usable if n <= coarsest), default=0)
    if first == 0:
        return None
    window = [(n, e) for n, e in usable if n >= first]
    return -float(np.polyfit([math.log(n) for n, _ in window], [math.log(e) for _, e in window], 1)[0])


def observe(name: str, methods: tuple[str, ...] = (), integrators: tuple[str, ...] = ()) -> list[Observed]:
    """Return what every method shows with every integrator on one model.

    Parameters
    ----------
    name : str
        A catalogue model.
    methods, integrators : tuple of str, optional
        Those of the tables above, unless given.
    """
    model, until = load(name), MODELS.get(name, 2.0)
    exact, _ = reference(name, model, until)

    def error(method: str, integrator: str, count: int) -> float:
        return float(np.abs(final_state(model, method, integrator, count, until)[: len(exact)] - exact).max())

    result: list[Observed] = []
    for method in methods or METHODS:
        for integrator in integrators or STEPS:
            counts = step_counts(integrator)
            errors = [error(method, integrator, n) for n in counts]
            floor = max(error(method, BEST, round(counts[-1] * f)) for f in (0.7, 0.85, 1.0))
            slope = fitted_slope(counts, errors, floor)
            order = INTEGRATORS.get(integrator).order
            result.append(Observed(name, method, integrator, order, tuple(counts), tuple(errors), floor, slope))
    return result


def table(observed: list[Observed]) -> Table:
    """Return the orders as a table: error at the coarsest and the finest step, slope and floor."""
    result = Table(title="observed orders, constant steps; errors in m or rad at the end")
    for heading in ("model", "method", "integrator", "order", "slope", "floor", "coarsest", "finest"):
        result.add_column(heading, justify="left" if heading in ("model", "method", "integrator") else "right")
    for o in observed:
        ends = [f"{o.errors[i]:.1e} ({o.counts[i]})" for i in (0, -1)]
        slope = "none: exact at any step" if o.slope is None else f"{o.slope:.2f}"
        result.add_row(o.model, o.method, o.integrator, str(o.order), slope, f"{o.floor:.1e}", *ends)
    return result


def main(arguments: list[str]) -> int:
    """Print the table for the models asked for."""
    observed = [o for name in arguments or MODELS for o in observe(name)]
    Console(width=140).print(table(observed))
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
