"""Runs per second of an ensemble of four-bars over two parameters: on one thread, on all, and one at a time.

    python -m benchmarks.sweeps [RUNS] [UNTIL]

Then what further questions cost, on one thread, as ratios to the plain sweep: histories, quantities behind the loops,
the tree of joints, events, a start that holds a joint coordinate.

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
from symgen.base.memory import processor_count
from symgen.base.settings import Settings
from symgen.run.planning.prepare import prepare
from symgen.study.ensemble.kernel import kernel_of_recipe

#: Single runs that are timed from Python; the time of one does not depend on their number.
SINGLE = 200


def timed(work: Callable[[], Any]) -> tuple[float, float, Any]:
    """Return seconds of the wall clock, seconds of the processor, and what the work gave."""
    wall, processor = time.perf_counter(), time.process_time()
    result = work()
    return time.perf_counter() - wall, time.process_time() - processor, result


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
        kernel_of_recipe(few.ensemble.recipe).compile_all()
        for jobs in sorted({1, processor_count()}):
            before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
            call = partial(symgen.sweep, quantities=("crank.theta",), settings=settings)
            wall, processor, study = timed(partial(call, model, vary, jobs=jobs, target=target))
            grown = (resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before) / 1024
            assert study.counts["ok"] == len(study), study.reasons()
            row(f"{name}, {jobs} thread{'s' if jobs > 1 else ''} (+{grown:.0f} MiB)", len(study), wall, processor)

    questions(model, side, settings)
    run = prepare(model.mechanism, settings)
    run.integrate()
    wall, processor, _ = timed(lambda: [run.integrate() for _ in range(SINGLE)])
    row("the same loop from Python, start given", SINGLE, wall, processor)

    def singles() -> None:
        for i in range(SINGLE):
            model.simulate(settings, parameters={"crank_mass": 1.0 + 2.0 * i / SINGLE})

    model.simulate(settings)
    wall, processor, _ = timed(singles)
    row("Model.simulate", SINGLE, wall, processor)
    show(table)


#: What is asked -> quantities, changes of settings, and a part of the runs where these take long.
QUESTIONS: dict[str, tuple[tuple[str, ...], dict[str, Any], float]] = {
    "one coordinate": (("crank.theta",), {}, 1.0),
    "coordinates and velocities": (("q", "v"), {}, 1.0),
    "and accelerations, reactions": (("q", "v", "crank.alpha", "reactions"), {}, 1.0),
    "in joint coordinates: one": (("crank.theta",), {"coordinates": "joint"}, 1.0),
    "coordinates and velocities there": (("q", "v"), {"coordinates": "joint"}, 1.0),
    "and accelerations, reactions there": (
        ("q", "v", "crank.alpha", "reactions"),
        {"coordinates": "joint"},
        0.1,
    ),
    "an event that does not happen": (("crank.theta",), {"stop_when": "crank.theta > 9"}, 0.1),
    "a joint coordinate held": (("crank.theta",), {"start": {"B.angle": -1.0}}, 0.02),
}


def questions(model: Any, side: int, settings: Settings) -> None:
    """Measure and print what further questions cost."""
    table = Table(title="what is asked, on one thread")
    for heading in ("asked", "runs", "us of processor a run", "to the plain sweep"):
        table.add_column(heading, justify="left" if heading == "asked" else "right")
    plain = math.nan
    for label, (quantities, changes, part) in QUESTIONS.items():
        sweep = partial(symgen.sweep, model, settings=settings, quantities=quantities, jobs=1, **changes)
        sweep(vary={"crank_mass": [2.0]})  # compiles
        few = max(2, round(side * math.sqrt(part)))
        grid = {"crank_mass": f"lin(1, 3, {few})", "coupler_mass": f"lin(4, 12, {few})"}
        study, processor = None, math.inf
        for _ in range(3):
            _, once, study = timed(partial(sweep, vary=grid))
            processor = min(processor, once)
        assert study is not None and study.counts["ok"] == len(study), label
        each = 1e6 * processor / len(study)
        plain = each if math.isnan(plain) else plain
        table.add_row(label, str(len(study)), f"{each:.4g}", f"{each / plain:.2f}")
    show(table)


if __name__ == "__main__":
    main(sys.argv[1:])
