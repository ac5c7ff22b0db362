"""The integrator `picard` beside `dop853`: error against run time, random starts, hard cases, outputs.

    python -m benchmarks.picard work                 factors at equal error of the end, in one run, in turns
    python -m benchmarks.picard starts [COUNT]       errors over tolerances and failures from random starts
    python -m benchmarks.picard hard                 a kink, a damper, a stiff spring, long straight code
    python -m benchmarks.picard outputs              what 101 outputs cost, and their errors
    python -m benchmarks.picard figure ROWS FILE     error against run time, from rows of `benchmarks.against_peers`

References are motions in extended precision (`benchmarks.extended`). Errors are those of q at the end of a run, the
largest; a time is the least processor time of several runs, and that at an error follows from a quadratic through
logarithms of the runs with 21 tolerances.
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from functools import lru_cache, partial
from typing import Any

import numpy as np
from numpy.typing import NDArray
from rich.table import Table

import symgen
from benchmarks.extended import reference
from benchmarks.page_tables import KEPT, PageTable, list_of, number, print_tables
from benchmarks.show import show
from symgen import MechanismBuilder, Settings
from symgen.run.planning.prepare import Prepared, prepare
from symgen.run.single.outcome import Outcome

Array = NDArray[Any]
INTEGRATORS = ("dop853", "picard")
LEVELS = (1e-6, 1e-9, 1e-12)
TOLERANCES = tuple(10.0 ** (-k / 2) for k in range(6, 27))
REPEATS = 12
METHODS = ("lagrange", "direct-correction")
#: Model: end [s], and constant steps of the reference.
MODELS = {
    "four-bar": (10.0, 400),
    "andrews": (0.03, 300),
    "bricard": (10.0, 200),
    "spatial-slider-crank": (5.0, 2500),
    "jansen-leg": (5.0, 400),
}


def prepared(mechanism: Any, integrator: str, until: float, **more: Any) -> Prepared:
    """Return a run that has the end of the motion for its only output, unless others are given."""
    return prepare(mechanism, Settings(**{"times": [0.0, until], "until": until, "integrator": integrator, **more}))


def best_of(run: Prepared, repeats: int = REPEATS) -> tuple[Outcome, float]:
    """Return the last of several runs, and the shortest processor time [s]."""
    outcomes = [run.integrate() for _ in range(repeats)]
    return outcomes[-1], min(outcome.cpu_seconds for outcome in outcomes)


def at_end(outcome: Outcome) -> Array:
    """Return q at the end of a run in the coordinates of its loop."""
    info, simulation = outcome.compiled.info, outcome.simulation
    assert simulation is not None, "a run of its own"
    return np.array(simulation.state.y[: info.nq])


def time_at(rows: list[tuple[float, float]], level: float) -> float:
    """Return the time at which runs have an error, nan beyond those that were tried."""
    usable = [(np.log10(e), np.log10(t)) for e, t in rows if 1e-15 < e < 1e-3]
    if len(usable) < 4:
        return float("nan")
    errors, times = np.array(usable).T
    if not errors.min() - 0.35 <= np.log10(level) <= errors.max() + 0.35:
        return float("nan")
    return float(10 ** np.polyval(np.polyfit(errors, times, 2), np.log10(level)))


@lru_cache(maxsize=32)
def exact(name: str, coordinates: str) -> tuple[Array, float]:
    """Return q and v at the end of a model's run in extended precision, and what half the step changes."""
    until, steps = MODELS[name]
    run = prepared(symgen.load(name).mechanism, "dop853", until, method="lagrange", coordinates=coordinates)
    return reference(run, steps)


def factors(name: str, coordinates: str, method: str) -> str:
    """Return the time of `dop853` over that of `picard` at all levels of error."""
    end, _ = exact(name, coordinates)
    rows: dict[str, list[tuple[float, float]]] = {integrator: [] for integrator in INTEGRATORS}
    for tolerance in TOLERANCES:
        for integrator in INTEGRATORS:
            more = {"rtol": tolerance, "atol": tolerance, "method": method, "coordinates": coordinates}
            run = prepared(symgen.load(name).mechanism, integrator, MODELS[name][0], **more)
            outcome, seconds = best_of(run)
            q = at_end(outcome)
            if outcome.code == 0:
                rows[integrator].append((float(np.abs(q - end[: len(q)]).max()), seconds))
    ratios = (time_at(rows["dop853"], level) / time_at(rows["picard"], level) for level in LEVELS)
    return ", ".join("-" if np.isnan(ratio) else f"{ratio:.1f}" for ratio in ratios)


def work_table(times: bool = False) -> PageTable:
    """Return factors at equal error by model, coordinates and method; they are run times, measured if asked for."""

    def cells(name: str, coordinates: str) -> Iterator[str]:
        yield from (factors(name, coordinates, method) if times else KEPT for method in METHODS)

    rows = tuple(
        ((f"`{name}`" if coordinates == "joint" else "", coordinates), partial(list_of, cells, name, coordinates))
        for name in MODELS
        for coordinates in ("joint", "absolute")
    )
    levels = ", ".join(f"{level:.0e}".replace("e-0", "e-") for level in LEVELS)
    headings = ("model", "coordinates", *(f"`{method}` {levels}" for method in METHODS))
    return PageTable("picard work", "docs/tables/picard.md", headings, rows, (2, 3), integrators=INTEGRATORS)


def work(arguments: list[str]) -> None:
    """Print factors at equal error."""
    print_tables({"work": work_table(times=True)}, ())


#: Model of the random starts: its coordinate and its speed, which decide all others, and the end [s].
STARTS = {
    "four-bar": ("crank.theta", "crank.omega", 2.0),
    "andrews": ("K1.theta", "K1.omega", 0.006),
    "bricard": ("P0.angle", "P0.angle.rate", 2.0),
}


def starts(arguments: list[str]) -> None:
    """Print errors over tolerances from random states of a run, with speeds 0.2 to 5 times as large."""
    count = int(arguments[0]) if arguments else 1000
    table = Table("model", "rtol", "integrator", "runs", "failed", "error over rtol: 10 %", "median", "90 %", "99 %")
    for name, (place, speed, until) in STARTS.items():
        model, rng = symgen.load(name), np.random.default_rng(1)
        result = model.simulate(
            method="lagrange", integrator="dop853", coordinates="joint", until=MODELS[name][0], rtol=1e-9
        )
        errors: dict[tuple[float, str], list[float]] = {}
        failed: dict[tuple[float, str], int] = {}
        for _ in range(count // len(STARTS)):
            k = rng.integers(1, len(result.t))
            factor = rng.uniform(0.8, 1.26) if name == "bricard" else 0.2 * 25.0 ** rng.uniform()
            start = {place: float(result[place][k]), speed: float(result[speed][k]) * factor}
            more = {"method": "lagrange", "coordinates": "joint", "start": start, "max_violation": 1.0}
            ends = prepared(model.mechanism, "dop853", until, rtol=3e-14, atol=1e-15, **more).integrate()
            if ends.code != 0:
                continue
            for tolerance in (1e-5, 1e-8, 1e-11):
                for integrator in INTEGRATORS:
                    run = prepared(
                        model.mechanism, integrator, until, rtol=tolerance, atol=tolerance, **more
                    ).integrate()
                    failed[tolerance, integrator] = failed.get((tolerance, integrator), 0) + (run.code != 0)
                    error = float(np.abs(at_end(run) - at_end(ends)).max()) / tolerance
                    errors.setdefault((tolerance, integrator), []).append(error)
        for (tolerance, integrator), these in errors.items():
            parts = (f"{x:.3g}" for x in np.percentile(these, (10, 50, 90, 99)))
            counts = str(len(these)), str(failed[tolerance, integrator])
            table.add_row(name, f"{tolerance:.0e}", integrator, *counts, *parts)
    show(table)


def ball_on_a_floor(stiffness: float, damping: float, kink: bool) -> Any:
    """Return a mass on a spring and a damper towards the ground; with a kink it pushes only."""
    builder = MechanismBuilder("hard-case", gravity=(0.0, -9.81))
    builder.body("ball", mass=1.0, inertia=0.1, position=(0.0, 0.5))
    push = f"max(-{stiffness}*ball.y, 0)" if kink else f"-{stiffness}*ball.y - {damping}*ball.vy"
    return builder.force("floor", "force", body="ball", at=(0.0, 0.0), force=(0.0, push)).build()


#: Cases that a polynomial of high order does not like, and their ends [s].
HARD: dict[str, tuple[Callable[[], Any], float]] = {
    "a ball on a floor, a kink, 1e4 N/m": (lambda: ball_on_a_floor(1e4, 0.0, True), 2.0),
    "a damper, 1000 1/s": (lambda: ball_on_a_floor(100.0, 1e3, False), 2.0),
    "a stiff spring, 1000 rad/s": (lambda: ball_on_a_floor(1e6, 0.0, False), 2.0),
    "long straight code, `n-four-bar:20`": (lambda: symgen.load("n-four-bar:20").mechanism, 2.0),
}


def hard_table(times: bool = False) -> PageTable:
    """Return errors of both integrators on hard cases at 1e-9, and the ratio of their times."""

    def cells(case: str) -> Iterator[str]:
        (build, until), seconds = HARD[case], list[float]()
        more = {"method": "direct-correction", "coordinates": "joint"}
        mechanism = build()
        ends = prepared(mechanism, "dop853", until, rtol=3e-14, atol=1e-15, **more).integrate()
        for integrator in INTEGRATORS:
            outcome, own = best_of(prepared(mechanism, integrator, until, rtol=1e-9, atol=1e-9, **more))
            seconds.append(own)
            yield number(float(np.abs(at_end(outcome) - at_end(ends)).max()))
        yield f"{seconds[0] / seconds[1]:.2g}" if times else KEPT

    rows = tuple(((case,), partial(list_of, cells, case)) for case in HARD)
    headings = ("case at rtol 1e-9", "error of `dop853`", "of `picard`", "time of `dop853` over that of `picard`")
    return PageTable("picard hard", "docs/tables/picard.md", headings, rows, (3,), (1, 2), INTEGRATORS)


def hard(arguments: list[str]) -> None:
    """Print hard cases."""
    print_tables({"hard": hard_table(times=True)}, ())


def outputs(arguments: list[str]) -> None:
    """Print what 101 outputs cost, and their errors beside those of the end."""
    table = Table("model", "rtol", "integrator", "end alone [us]", "101 outputs [us]", "q", "v", "q, end", "v, end")
    for name in arguments or ("four-bar", "andrews", "bricard"):
        mechanism, (until, _) = symgen.load(name).mechanism, MODELS[name]
        times = [float(t) for t in np.linspace(0.0, until, 101)]
        more = {"method": "lagrange", "coordinates": "joint", "max_violation": 1e-3}
        right = prepared(mechanism, "dop853", until, times=times, rtol=3e-14, atol=1e-15, **more).integrate().states
        for tolerance in LEVELS:
            for integrator in INTEGRATORS:
                own = {"rtol": tolerance, "atol": tolerance, **more}
                alone = best_of(prepared(mechanism, integrator, until, **own))[1]
                outcome, seconds = best_of(prepared(mechanism, integrator, until, times=times, **own))
                off, nq = np.abs(outcome.states - right[: len(outcome.states)]), outcome.compiled.info.nq
                parts = off[:-1, :nq], off[:-1, nq:-1], off[-1, :nq], off[-1, nq:-1]
                table.add_row(
                    *(name, f"{tolerance:.0e}", integrator, f"{alone * 1e6:.1f}", f"{seconds * 1e6:.1f}"),
                    *(f"{part.max():.1e}" for part in parts),
                )
    show(table)


#: Labels of the figure by how tools and settings begin, and colours.
LINES = {
    "picard": ("symgen", "joint lagrange, picard", "#0b6e4f"),
    "dop853": ("symgen", "joint lagrange, dop853 1e", "#4063d8"),
    "heyoka": ("heyoka", "", "#c2571a"),
    "CasADi": ("casadi", "", "#7a5195"),
}


def figure(arguments: list[str]) -> None:
    """Draw error against run time from the rows of ``python -m benchmarks.against_peers --json FILE``."""
    import json
    from pathlib import Path

    import matplotlib.pyplot as plt

    rows = json.loads(Path(arguments[0]).read_text(encoding="utf-8"))
    drawing, axes = plt.subplots(figsize=(6.4, 4.0), layout="constrained")
    for label, (peer, begin, colour) in LINES.items():
        these = [r for r in rows if r["peer"] == peer and r["setting"].startswith(begin) and r["error"]]
        points = np.array(sorted((r["seconds"] * 1e3, r["error"]) for r in these))
        best = points[np.minimum.accumulate(points[:, 1]) == points[:, 1]]  # the fastest run of each error
        axes.loglog(best[:, 0], best[:, 1], "o-", color=colour, markersize=3, label=label)
    axes.set(xlabel="run time [ms]", ylabel="largest error of a body angle [rad]", ylim=(1e-13, 1e-2))
    axes.grid(which="major", alpha=0.3)
    axes.legend(frameon=False)
    drawing.savefig(arguments[1], metadata={"Date": None})


COMMANDS: dict[str, Callable[[list[str]], None]] = {
    "work": work,
    "starts": starts,
    "hard": hard,
    "outputs": outputs,
    "figure": figure,
}


def main() -> int:
    """Run what the command line asks for."""
    COMMANDS[sys.argv[1]](sys.argv[2:])
    return 0


if __name__ == "__main__":
    sys.exit(main())
