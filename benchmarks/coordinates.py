"""Coordinates of bodies beside those of joints: operations, run time, and error against run time.

    python -m benchmarks.coordinates

Operations are those of the emitted right-hand side of `lagrange`, and of the tangent of its descriptor form. Run times
are of `direct-correction`: with `rk4` at the mechanism's own step, runs in both coordinates in turns, medians of their
ratios; and with `dop853` to the error asked for: errors at a row of tolerances in both coordinates in turns, with the
shortest processor times of all turns, and the straight line through the logarithms of those within 30 times of it.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator
from functools import partial
from statistics import median
from typing import Any

import numpy as np

import symgen
from benchmarks.page_tables import KEPT, PageTable, list_of, print_tables
from symgen.api import Model
from symgen.derive.formulate.formulate import formulate
from symgen.derive.lower.law import lower_law
from symgen.derive.lower.model import lower_model
from symgen.derive.lower.plans import cheapest_plan, closing_plan
from symgen.derive.methods import METHODS
from symgen.describe.mechanism import Mechanism
from symgen.result.points import Points
from symgen.run.compiling.choices import mechanism_on_tree
from symgen.run.compiling.free_by_loops import free_velocities

MODELS = (
    *("four-bar", "slider-crank", "andrews", "n-four-bar:10", "bricard", "spatial-slider-crank"),
    "flyball-governor",
)
#: Error that `dop853` is asked for [m], and what is tried.
ERROR = 1e-6
COORDINATES = ("absolute", "joint")
INTEGRATORS = ("rk4", "dop853")
TOLERANCES = tuple(10.0 ** (-k / 2) for k in range(8, 24))
TURNS = 5


def operations(mechanism: Mechanism) -> tuple[int, int]:
    """Return those of the right-hand side and of the tangent."""
    method = METHODS.get("lagrange", "")
    equations = formulate(mechanism)
    closing = closing_plan(equations, cheapest_plan(equations), free_velocities(mechanism))
    options = method.complete_options({})
    law = lower_law(equations, lower_model(equations, ""), method, options, implicit=True, closing=closing)
    counts = {block.name: block.operations for block in law.blocks}
    return counts["rhs"], counts["tangent"]


def span(model: Model) -> float:
    """Return how long a run is [s]: no longer than the motion is predictable."""
    defaults = model.mechanism.defaults
    return min(defaults.until, defaults.predictable_until or np.inf, 10.0)


def run(model: Model, coordinates: str, **settings: Any) -> symgen.Result:
    """Return a run of `direct-correction`, the shortest of three."""
    end = span(model)
    return model.simulate(coordinates=coordinates, until=end, output_step=end / 50, repeat=3, **settings)


def at_equal_error(model: Model, exact: np.ndarray, points: Points) -> tuple[float, float]:
    """Return run times [s] at which the error is `ERROR`, of both coordinates."""
    curves: dict[str, dict[float, list[float]]] = {c: {} for c in COORDINATES}
    for _ in range(TURNS):
        for rtol in TOLERANCES:
            for c in COORDINATES:
                curve = curves[c]
                if any(error < ERROR / 30.0 for tol, (error, _) in curve.items() if tol > rtol):
                    continue
                result = run(model, c, integrator=INTEGRATORS[1], rtol=rtol, atol=1e-2 * rtol)
                if result.status == "failed" or len(result.t) != len(exact):
                    continue
                error = float(points.distances_over_time(np.asarray(result.q), exact).max())
                shortest = min(result.outcome.cpu_seconds, curve.get(rtol, [0.0, np.inf])[1])
                curve[rtol] = [error, shortest]
    absolute, joint = (crossing(np.array([curves[c][tol] for tol in sorted(curves[c])])) for c in COORDINATES)
    return absolute, joint


def crossing(curve: np.ndarray) -> float:
    """Return the time at which a curve of (error, time) has `ERROR`, by the line through all its logarithms near it."""
    error, seconds = np.log(curve).T
    near = np.abs(error - np.log(ERROR)) < np.log(30.0)
    slope, height = np.polyfit(error[near], seconds[near], 1)
    return float(np.exp(height + slope * np.log(ERROR)))


def relative_time(model: Model) -> str:
    """Return the median ratio of run times with `rk4`, bodies over joints, of runs in turns."""
    ratios = []
    for _ in range(TURNS):
        a, b = (run(model, c, integrator=INTEGRATORS[0]).outcome.cpu_seconds for c in COORDINATES)
        ratios.append(a / b)
    return f"{median(ratios):.2g}"


def table(times: bool = False) -> PageTable:
    """Return operations and ratios of run times of both coordinates."""

    def cells(name: str) -> Iterator[str]:
        model = symgen.load(name)
        counts = operations(model.mechanism), operations(mechanism_on_tree(model.mechanism))
        yield f"{counts[0][0]} / {counts[1][0]}"
        yield f"{counts[0][1]} / {counts[1][1]}"
        if not times:
            yield from (KEPT, KEPT)
            return
        yield relative_time(model)
        exact = np.asarray(run(model, "joint", integrator="dop853", rtol=1e-13, atol=1e-14).q)
        timed = at_equal_error(model, exact, Points.of_mechanism(model.mechanism, model.parameters()))
        yield f"{timed[0] / timed[1]:.2g}"

    rows = tuple(((f"`{name}`",), partial(list_of, cells, name)) for name in MODELS)
    fixed, adaptive = (f"`{name}`" for name in INTEGRATORS)
    headings = ("mechanism", "right-hand side", "tangent", fixed, f"{adaptive} to {ERROR:g} m".replace("e-0", "e-"))
    return PageTable("coordinates", "docs/tables/coordinates.md", headings, rows, (3, 4), integrators=INTEGRATORS)


if __name__ == "__main__":
    sys.exit(print_tables({"coordinates": table(times=True)}, sys.argv[1:]))
