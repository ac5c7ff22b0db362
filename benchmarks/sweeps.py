"""Runs per second of an ensemble of four-bars over two parameters: on one thread, on all, and one at a time.

    python -m benchmarks.sweeps [RUNS] [UNTIL]

Seconds of the wall clock and of the processor are both shown: on a machine that does other things only the second ones
can be compared.
"""

from __future__ import annotations

import math
import resource
import sys
import time
from collections.abc import Callable
from functools import partial
from typing import Any

from rich.table import Table

import symgen
from benchmarks.show import show
from symgen.ensemble.kernel import kernel_of
from symgen.ensemble.local import cores
from symgen.plan import make_plan
from symgen.runtime.run import integrate
from symgen.settings import Settings

#: Single runs that are timed from Python; the time of one does not depend on their number.
SINGLE = 200


def timed(work: Callable[[], Any]) -> tuple[float, float, Any]:
    """Return seconds of the wall clock, seconds of the processor, and what the work gave."""
    wall, processor = time.perf_counter(), time.process_time()
    found = work()
    return time.perf_counter() - wall, time.process_time() - processor, found


def main(words: list[str]) -> None:
    """Measure and print."""
    runs = int(words[0]) if words else 100_000
    until = float(words[1]) if len(words) > 1 else 0.1
    side = round(math.sqrt(runs))
    model = symgen.load("four-bar")
    vary = {"crank_mass": f"lin(1, 3, {side})", "coupler_mass": f"lin(4, 12, {side})"}
    settings = Settings(until=until, step=1e-3, times=(until,))
    table = Table(title=f"four-bar, {until:g} s of rk4 at 1e-3 s, direct-correction")
    for heading in ("how", "runs", "wall [s]", "processor [s]", "runs a second", "us of processor a run"):
        table.add_column(heading, justify="left" if heading == "how" else "right")

    def row(how: str, count: int, wall: float, processor: float) -> None:
        rate, each = f"{count / wall:.4g}", f"{1e6 * processor / count:.4g}"
        table.add_row(how, str(count), f"{wall:.3f}", f"{processor:.3f}", rate, each)

    for target, name in (("cpu", "sweep"), ("lanes", "sweep in lanes")):
        few = symgen.sweep(model, {"crank_mass": [2.0]}, settings=settings, quantities=("crank.theta",), target=target)
        kernel_of(few.ensemble.recipe).warm()
        for jobs in sorted({1, cores()}):
            before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
            call = partial(symgen.sweep, quantities=("crank.theta",), settings=settings)
            wall, processor, found = timed(partial(call, model, vary, jobs=jobs, target=target))
            grown = (resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before) / 1024
            assert found.counts["ok"] == len(found), found.reasons()
            row(f"{name}, {jobs} thread{'s' if jobs > 1 else ''} (+{grown:.0f} MiB)", len(found), wall, processor)

    plan = make_plan(model.mechanism, settings)
    compiled, start = model.ready(plan)
    integrate(compiled, plan.tableau, start, plan.spec)
    wall, processor, _ = timed(lambda: [integrate(compiled, plan.tableau, start, plan.spec) for _ in range(SINGLE)])
    row("the same loop from Python, start given", SINGLE, wall, processor)

    def singles() -> None:
        for i in range(SINGLE):
            model.simulate(settings, parameters={"crank_mass": 1.0 + 2.0 * i / SINGLE})

    model.simulate(settings)
    wall, processor, _ = timed(singles)
    row("Model.simulate", SINGLE, wall, processor)
    show(table)


if __name__ == "__main__":
    main(sys.argv[1:])
