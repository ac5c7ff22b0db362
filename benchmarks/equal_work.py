"""Run time at equal error over random mechanisms: each method at three steps or tolerances, in turns.

    python -m benchmarks.equal_work                       the table of its page, from the record
    python -m benchmarks.records equal_work --workers N    measures the record

The mechanisms are the first ones of `benchmarks.statistics` that are predictable, with its references. A method runs
with three steps or tolerances, all methods of an integrator in turn, three rounds, by processor time. Its time at the
error that `lagrange` has with the middle setting is interpolated, log time over log error, and extrapolated along the
nearest two settings by no more than a decade of error. Ratios are over the time of `lagrange` there: below 1 the method
is the cheaper one at the same accuracy. Intervals hold with 95 %, by drawing the mechanisms again.
"""

from __future__ import annotations

import math
import random
import statistics as middle
import sys
from collections.abc import Iterator, Mapping, Sequence
from itertools import pairwise
from typing import Any

import numpy as np

from benchmarks import statistics
from benchmarks.page_tables import PageTable, list_of, print_tables
from benchmarks.records import Line, Pair, Record
from benchmarks.statistics import OUTPUTS, RESOLVED, UNWATCHED, Case, Job, case_of, interval, label
from symgen.base.errors import SymgenError
from symgen.base.settings import Settings
from symgen.run.layout import abi
from symgen.run.planning.prepare import Prepared, prepare
from symgen.study.comparison.combinations import split_variant

METHODS = (
    *("lagrange", "baumgarte:rule=motion", "velocity-projection", "direct-correction"),
    *("direct-correction:weight=mass", "coordinate-partitioning", "augmented-lagrangian"),
)
#: Settings by integrator: factors of the step that suits a motion, or relative tolerances, the coarsest first.
SETTINGS = {"rk4": (2.0, 1.0, 0.5), "dop853": (1e-5, 1e-7, 1e-9), "picard": (1e-5, 1e-7, 1e-9)}
ROUNDS = 3
#: Errors beyond those of the settings up to which a time is extrapolated, as a factor.
BEYOND = 10.0
#: Mechanisms of the record, of the first seed.
COUNT = 300
PATIENCE = 240.0
#: A point of a method: error over the length [1] and processor time [s].
Point = Sequence[float]


def run_of(case: Case, words: str, integrator: str, setting: float) -> Prepared | None:
    """Return a run with one setting, None where the method refuses it."""
    method, own = split_variant(words)
    steps: dict[str, Any] = {"step": case.step * setting} if integrator == "rk4" else {"rtol": setting}
    steps |= {} if integrator == "rk4" else {"atol": 1e-2 * setting}
    options: dict[str, str | float] = {f"method.{name}": value for name, value in own.items()}
    arguments = {"until": case.times[-1], "times": case.times, "options": options, **steps, **UNWATCHED}
    try:
        return prepare(case.model.mechanism, Settings(method=method, integrator=integrator, **arguments))
    except SymgenError:
        return None


def points_of(case: Case, integrator: str) -> dict[str, list[list[float] | None]]:
    """Return error and time of every method at every setting; None where a run does not reach the end."""
    every = {(m, s): run_of(case, m, integrator, s) for m in METHODS for s in SETTINGS[integrator]}
    errors, seconds = dict[Any, float](), dict[Any, list[float]]()
    for key, run in every.items():
        if run is None:
            continue
        outcome = run.integrate()
        if outcome.code == abi.DONE and len(outcome.times) == OUTPUTS:
            away = case.distances.position_errors(run.of_bodies(outcome))
            errors[key], seconds[key] = float(away.max()) / case.distances.size, []
    for _ in range(ROUNDS):
        for key in errors:
            run = every[key]
            assert run is not None, "it ended"
            seconds[key].append(run.integrate().cpu_seconds)
    return {
        m: [[errors[m, s], middle.median(seconds[m, s])] if (m, s) in errors else None for s in SETTINGS[integrator]]
        for m in METHODS
    }


def examine(job: Job) -> dict[str, Any]:
    """Return the points of all methods by integrator; none where a mechanism is left out."""
    case = case_of(*job, statistics.UNTIL)
    return {"points": None if case is None else {x: points_of(case, x) for x in SETTINGS}}


def time_at(points: Sequence[Point | None], error: float) -> float | None:
    """Return the time of a method at an error, None where its settings do not lead there."""
    known = sorted((tuple(p) for p in points if p is not None and p[0] > 0.0 and p[1] > 0.0), reverse=True)
    pairs = [(a, b) for a, b in pairwise(known) if a[0] > b[0] and a[1] < b[1]]
    if not pairs or not known[-1][0] / BEYOND <= error <= known[0][0] * BEYOND:
        return None

    def distance(pair: tuple[Point, Point]) -> float:
        (high, _), (low, _) = pair
        return max(math.log(error / high), math.log(low / error), 0.0)

    (e0, t0), (e1, t1) = min(pairs, key=distance)
    return float(t0 * (t1 / t0) ** (math.log(error / e0) / math.log(e1 / e0)))


def ratios(integrator: str, method: str, beside: str = "lagrange") -> list[float]:
    """Return the times of a method over those of another one at the error of `lagrange`, mechanism by mechanism."""
    found = []
    for line in predictable_lines():
        points: Mapping[str, Sequence[Point | None]] = line["points"][integrator]
        base = points["lagrange"][1]
        if base is None or base[0] < RESOLVED:
            continue
        own, other = (time_at(points[name], base[0]) for name in (method, beside))
        if own is not None and other is not None:
            found.append(own / other)
    return found


def predictable_lines() -> list[Line]:
    """Return the lines of mechanisms that a method follows with `dop853`."""

    def follows(line: Line) -> bool:
        at_middle = [p[1] for p in line["points"]["dop853"].values() if p[1] is not None]
        return min((p[0] for p in at_middle), default=1.0) <= statistics.FOLLOWED

    return [line for line in RECORD.lines() if line.get("points") and follows(line)]


def summary(values: Sequence[float]) -> Iterator[str]:
    """Yield the number of ratios, their median and geometric mean with intervals, and tenths."""
    yield str(len(values))
    for of in (np.median, np.mean):
        low, high = interval(values, of)
        yield f"{math.exp(float(of(np.log(values)))):.2f} [{low:.2f}, {high:.2f}]"
    low, high = np.percentile(values, [10, 90])
    yield f"{low:.2f}, {high:.2f}"


def page_table() -> PageTable:
    """Return the ratios of all methods with all integrators."""
    pairs = [(integrator, method) for integrator in SETTINGS for method in METHODS[1:]]
    rows = tuple(((f"`{i}`", label(m)), lambda i=i, m=m: list_of(summary, ratios(i, m))) for i, m in pairs)
    headings = ("integrator", "method", "mechanisms", "median", "geometric mean", "10, 90 %")
    page = "docs/tables/equal-work.md"
    return PageTable("equal_work", page, headings, rows, stored=True, claims=claims)


def claims() -> Iterator[str]:
    """Yield what the page says of pairs of methods."""
    parts = []
    for integrator in SETTINGS:
        own = ratios(integrator, "direct-correction", "velocity-projection")
        low, high = interval(own, np.median)
        parts.append(f"{middle.median(own):.2f} [{low:.2f}, {high:.2f}] with `{integrator}`")
    yield f"Mechanism by mechanism `direct-correction` takes as long as `velocity-projection` times {words(parts)}."
    parts = []
    for integrator in SETTINGS:
        own = ratios(integrator, "direct-correction:weight=mass", "direct-correction")
        low, high = interval(own, np.median)
        parts.append(f"{middle.median(own):.2f} [{low:.2f}, {high:.2f}] with `{integrator}`")
    yield f"The metric of M beside the identity: {words(parts)}."
    yield f"{len(predictable_lines())} of {len(RECORD.lines())} mechanisms move regularly and predictably."


def words(parts: Sequence[str]) -> str:
    """Return parts as a list of a sentence."""
    return f"{', '.join(parts[:-1])} and {parts[-1]}"


def again(stored: Line, dice: random.Random) -> Iterator[Pair]:
    """Yield the errors of a mechanism beside those measured again, with one integrator."""
    if not stored["points"]:
        return
    integrator, case = dice.choice(("rk4", "dop853")), case_of(stored["seed"], stored["number"], statistics.UNTIL)
    assert case is not None, "it was measured"
    new = points_of(case, integrator)
    for method, points in stored["points"][integrator].items():
        for k, (one, other) in enumerate(zip(points, new[method], strict=True)):
            if one is not None and other is not None and one[0] < statistics.LOST:
                where = f"mechanism {stored['number']}, {integrator}, {method}, setting {k}"
                yield Pair(f"{where}, error", one[0], other[0], 1.1, statistics.UNRESOLVED)


def jobs() -> Iterator[Job]:
    """Yield the mechanisms."""
    return (Job(statistics.SEEDS[0], number) for number in range(COUNT))


RECORD = Record("equal_work", jobs, examine, again, PATIENCE, share=0.01)


if __name__ == "__main__":
    sys.exit(print_tables({"equal_work": page_table()}, ()))
