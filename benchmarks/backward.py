"""`bdf` on the stabilised index-2 equations beside `radau5`, SciPy's BDF and IDA, at three tolerances.

Andrews' mechanism, and the slider-crank of SUNDIALS' example ``idaSlCrank_dns``, whose output file has the counts of
IDA. SciPy integrates the accelerations of the second derivation of the equations (`symgen.study.references`), by the
same tolerances. Errors are those of points at the end, from a tight run of SciPy's DOP853 on these accelerations.

    python -m benchmarks.backward
"""

from __future__ import annotations

import sys
from collections.abc import Iterator
from functools import cache, partial
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from benchmarks.page_tables import KEPT, PageTable, Row, list_of, number, print_tables
from symgen.api import Model, load
from symgen.base.settings import Settings
from symgen.result.points import Points
from symgen.study.references.independent import IndependentEquations

Array = NDArray[np.float64]

TOLERANCES = (1e-4, 1e-6, 1e-8)
TIGHT = 1e-12
#: Mechanism, its file or its name in the catalogue, and the end of its run [s].
PROBLEMS = {
    "slider-crank of IDA": (str(Path(__file__).with_name("idas-slider-crank.toml")), 10.0),
    "`andrews`": ("andrews", 0.03),
}
SOLVERS = {"`ggl` with `bdf`": "bdf", "SciPy's BDF": "SciPy", "`ggl` with `radau5`": "radau5"}
#: Cells of steps, and of residuals with those of difference quotients, that ``idaSlCrank_dns.out`` has at 1e-6.
IDA = ("", "222", "874", "")


@cache
def problem(name: str) -> tuple[Model, IndependentEquations, Array, Array]:
    """Return a model, its accelerations by the second derivation, its start, and its positions at the end."""
    file, until = PROBLEMS[name]
    model = load(file)
    equations = IndependentEquations(model.mechanism, model.parameters())
    begun = model.simulate(until=until, times=[0.0], verify=False)
    start = equations.nearest_state(0.0, equations.state(begun.q.values[0], begun.v.values[0]))
    return model, equations, start, by_scipy(equations, start, until, "DOP853", TIGHT)[0]


def by_scipy(
    equations: IndependentEquations, start: Array, until: float, scheme: str, rtol: float
) -> tuple[Array, int, int]:
    """Return positions at the end, steps and evaluations of a run by SciPy."""
    from scipy.integrate import solve_ivp

    solve: Any = solve_ivp  # SciPy's types lack the results of its solvers
    found = solve(equations.rate, (0.0, until), start, scheme, rtol=rtol, atol=rtol)
    return found.y[: equations.n, -1], len(found.t) - 1, int(found.nfev)


def cells(name: str, solver: str, rtol: float, times: bool) -> Iterator[str]:
    """Yield error, steps, evaluations, and of own runs the processor time of the best of five [ms]."""
    model, equations, start, exact = problem(name)
    until = PROBLEMS[name][1]
    if solver == "SciPy":
        q, steps, evaluations = by_scipy(equations, start, until, "BDF", rtol)
        spent = ""
    else:
        settings = Settings("ggl", solver, until=until, times=[until], rtol=rtol, atol=rtol, verify=False)
        runs = [model.simulate(settings) for _ in range(5 if times else 1)]
        run, spent = runs[0], f"{1e3 * min(one.outcome.cpu_seconds for one in runs):.2g}" if times else KEPT
        assert run.ok, run.reason
        q, steps, evaluations = run.q.values[-1], run.steps, run.evaluations
    error = Points.of_mechanism(model.mechanism, model.parameters()).largest_distance(q[None], exact[None])
    yield from (number(error), str(steps), str(evaluations), spent)


def table(times: bool = False) -> PageTable:
    """Return errors and counts by problem, solver and tolerance, with processor times where asked for."""
    rows: list[Row] = []
    for name in PROBLEMS:
        for label, solver in SOLVERS.items():
            rows += [
                ((name, label, f"{rtol:.0e}".replace("e-0", "e-")), partial(list_of, cells, name, solver, rtol, times))
                for rtol in TOLERANCES
            ]
        if name == next(iter(PROBLEMS)):
            rows.append(((name, "IDA, published", "1e-6"), lambda: IDA))
    headings = ("mechanism", "solver", "rtol, atol", "error [m]", "steps", "evaluations", "ms")
    integrators = tuple(solver for solver in SOLVERS.values() if solver != "SciPy")
    page = "docs/tables/backward.md"
    return PageTable("backward", page, headings, tuple(rows), times=(6,), loose=(3,), integrators=integrators)


if __name__ == "__main__":
    sys.exit(print_tables({"backward": table(times=True)}, sys.argv[1:]))
