"""Errors, reactions, violations and run times over random mechanisms: quantiles by method.

    python -m benchmarks.statistics                    the table of its page, from the record
    python -m benchmarks.records statistics --workers N    measures the record
    python -m benchmarks.statistics --count N [--seeds S,S] [--until T] [--integrators A,B]
        [--methods A,B:OPTION=VALUE] [--workers N] [--seconds S] [-o ROWS]     another sample

Mechanisms are drawn in the plane and in space by turns (`benchmarks.mechanisms.draw`): trees and closed loops of one to
six freedoms, with dependent rows here and there. Those whose motion does not stay regular are left out, and counted.
Constant steps are 0.03 over the rate rms(v') / rms(v) of a mechanism's motion, tolerances 1e-7. Errors are distances to
`direct-correction` in the metric of M with `dop853` at 1e-11, at 201 outputs, and ratios are the error of `lagrange`
over that of the method: above 1 the method is better. Where no method comes near with `dop853` at 1e-7 the motion is
not predictable, and the mechanism is left out as well.
"""

from __future__ import annotations

import argparse
import math
import random
import tempfile
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import astuple, dataclass
from functools import partial
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray
from rich.table import Table

from benchmarks.mechanisms.draw import Refused, draw
from benchmarks.mechanisms.toml import text
from benchmarks.page_tables import PageTable, list_of, print_tables
from benchmarks.records import Line, Pair, Record, measure
from benchmarks.show import show
from symgen.api import Model, load
from symgen.base.errors import SymgenError
from symgen.result.result import FAILED, Result
from symgen.study.comparison.combinations import split_variant
from symgen.study.comparison.distances import Distances
from symgen.study.references.reference import Reference

Array = NDArray[np.float64]

#: Runs are measured, not judged.
UNWATCHED: dict[str, Any] = {"max_violation": 1e9, "max_energy_error": 1e9, "verify": False}
METHODS = (
    *("baumgarte", "baumgarte:rule=motion", "velocity-projection", "post-stabilization", "direct-correction"),
    *("direct-correction:weight=mass", "coordinate-partitioning"),
    *("augmented-lagrangian", "index1-augmented-lagrangian"),
)
#: Steps of constant length over the rate of the motion, and tolerances of adaptive integrators.
STEP, RTOL = 0.03, 1e-7
#: Outputs, and attempted steps of a reference at most.
OUTPUTS, ATTEMPTS = 201, 20_000
#: Errors that differ by less are alike: where joints hardly open, closing them changes nothing.
ALIKE = 0.05
#: Errors of `lagrange` below this share of the mechanism's length are not resolved; motions slower than this stand.
RESOLVED, STANDS = 1e-9, 1e-3
#: Samples of a bootstrap.
SAMPLES = 2000
#: Processor time of a mechanism at most [s].
PATIENCE = 60.0
HEADINGS = ("method", "n", "10 %", "50 %", "90 %", "better", "worse", "mean", "reactions", "|Phi|", "time")

#: The record: seeds, mechanisms of each, end of the runs [s] and integrators.
SEEDS, COUNT, UNTIL, INTEGRATORS = (2026, 54), 300, 4.0, ("rk4", "dop853", "picard")
#: Errors over the length that a predictable motion keeps below with one method at least.
FOLLOWED = 1e-3
#: Errors of runs that are lost, which small changes decide.
LOST = 0.1
#: Numbers of the record that are below are not resolved; ratio of errors within which processors agree.
UNRESOLVED, WITHIN = 1e-7, {"picard": 4.0}


@dataclass(frozen=True)
class Measured:
    """One run: errors of positions over the length [1], of reactions over the largest, violation, and CPU time [s]."""

    error: float
    reactions: float | None
    violation: float
    seconds: float


@dataclass(frozen=True)
class Case:
    """A mechanism with its reference motion, its freedoms and dependent rows, and the step that suits it."""

    model: Model
    distances: Distances
    freedoms: int
    dependent: int
    step: float
    times: list[float]

    @classmethod
    def of(cls, model: Model, until: float) -> Case | None:
        """Return the case, None where the motion does not stay regular or nothing moves."""
        times = np.linspace(0.0, until, OUTPUTS).tolist()
        keys: dict[str, Any] = {"until": until, "times": times, "verify": False, "max_attempts": ATTEMPTS}
        options = {"method.weight": "mass"}
        exact = model.simulate(
            method="direct-correction", integrator="dop853", rtol=1e-11, atol=1e-12, options=options, **keys
        )
        v = np.asarray(exact.v)
        regular = len(exact.t) == OUTPUTS and not exact.rank_event_count and exact.rank.rows
        if exact.status == FAILED or not regular or np.abs(v).max() < STANDS:
            return None
        loose = exact.forces.non_unique
        reactions = {joint: exact.reactions[joint] for joint in exact.forces.seats if joint not in loose}
        motion = Reference("", 1e-11, np.array(times), np.asarray(exact.q), v)
        rate = math.sqrt(float(np.square(np.asarray(exact.a)).mean() / np.square(v).mean()))
        step = until / math.ceil(until * rate / STEP)
        rank = exact.rank
        counts = (v.shape[1] - rank.rank, rank.rows + rank.identical_rows_dropped - rank.rank)
        return cls(model, Distances(model.mechanism, {}, motion, reactions), *counts, step, times)

    def run(self, words: str, integrator: str) -> Measured | None:
        """Return the measures of a method, None where it does not reach the end."""
        method, own = split_variant(words)
        options: dict[str, str | float] = {f"method.{name}": value for name, value in own.items()}
        steps: dict[str, Any] = {"step": self.step} if integrator == "rk4" else {"rtol": RTOL, "atol": 1e-2 * RTOL}
        try:
            result: Result = self.model.simulate(
                method=method, integrator=integrator, until=self.times[-1], times=self.times, options=options,
                **steps, **UNWATCHED,
            )  # fmt: skip
        except SymgenError:
            return None
        if result.status == FAILED or len(result.t) < OUTPUTS:
            return None
        outcome, scale = result.outcome, self.distances.load
        loads = self.distances.reaction_errors(outcome)
        error = float(self.distances.position_errors(outcome).max()) / self.distances.size
        reactions = None if loads is None or not scale else float(loads.max()) / scale
        return Measured(error, reactions, result.position_violation_max, outcome.cpu_seconds)


class Job(NamedTuple):
    """One mechanism."""

    seed: int
    number: int


def case_of(seed: int, index: int, until: float) -> Case | None:
    """Return a drawn mechanism with its reference, None where its motion is not regular."""
    with tempfile.TemporaryDirectory() as folder:
        try:
            path = Path(folder) / f"m{index}.toml"
            path.write_text(text(draw(seed, index).raw), encoding="utf-8")
            return Case.of(load(path), until)
        except (Refused, SymgenError):
            return None


def examine(
    job: Job,
    until: float = UNTIL,
    integrators: Sequence[str] = INTEGRATORS,
    methods: Sequence[str] = METHODS,
) -> dict[str, Any]:
    """Return what a mechanism is, with the numbers of `Measured` by integrator and method; empty if it is left out."""
    case = case_of(*job, until)
    if case is None:
        return {"freedoms": None}
    runs = dict[str, dict[str, tuple[float | None, ...]]]()
    for integrator in integrators:
        base = case.run("lagrange", integrator)
        if base is None or base.error < RESOLVED:
            continue
        runs[integrator] = {"lagrange": astuple(base)}
        for method in methods:
            own = case.run(method, integrator)
            if own is not None:
                runs[integrator][method] = astuple(own)
    return {"freedoms": case.freedoms, "dependent": case.dependent, "step": case.step, "runs": runs}


def predictable(line: Line) -> bool:
    """Whether a mechanism is regular, and a method follows its reference with `dop853`."""
    runs = line.get("runs")
    return runs is not None and min([m[0] for m in runs.get("dop853", {}).values()], default=0.0) <= FOLLOWED


def pairs_of(lines: Iterable[Line], integrator: str, method: str) -> list[tuple[Measured, Measured]]:
    """Return `lagrange` and a method on the same predictable mechanisms."""
    own = (line["runs"].get(integrator, {}) for line in lines if predictable(line))
    return [(Measured(*runs["lagrange"]), Measured(*runs[method])) for runs in own if method in runs]


def quantiles(values: Sequence[float]) -> tuple[str, ...]:
    """Return the tenth, half and nine tenths of some values as cells."""
    return ("", "", "") if not len(values) else tuple(f"{x:.3g}" for x in np.percentile(values, [10, 50, 90]))


def cells_of_ratios(pairs: Sequence[tuple[Measured, Measured]]) -> tuple[str, ...]:
    """Return the cells of a method from pairs of `lagrange` and the method on the same mechanisms."""
    ratios = [base.error / own.error for base, own in pairs if own.error > 0.0]
    forces = [b.reactions / o.reactions for b, o in pairs if b.reactions and o.reactions]
    shares = [np.array(ratios) > 1.0 + ALIKE, np.array(ratios) < 1.0 - ALIKE]
    better, worse = (f"{100 * float(np.mean(share)):.0f} %" for share in shares)
    middle = f"{math.exp(float(np.mean(np.log(ratios)))):.3g}"
    violations = [base.violation / own.violation for base, own in pairs if own.violation > 0.0]
    seconds = [own.seconds / base.seconds for base, own in pairs if base.seconds > 0.0]
    medians = [f"{np.median(x):.3g}" if x else "" for x in (forces, violations, seconds)]
    return (str(len(ratios)), *quantiles(ratios), better, worse, middle, *medians)


def tables(lines: Sequence[Line], integrators: Sequence[str], methods: Sequence[str], until: float) -> Iterator[Table]:
    """Yield a table for each seed and integrator."""
    for seed in sorted({line["seed"] for line in lines}):
        own = [line for line in lines if line["seed"] == seed]
        regular = sum(map(predictable, own))
        for integrator in integrators:
            title = f"{integrator}, {until:g} s, seed {seed}: {regular} regular of {len(own)} mechanisms"
            table = Table(title=title)
            for heading in HEADINGS:
                table.add_column(heading)
            for method in methods:
                if pairs := pairs_of(own, integrator, method):
                    table.add_row(method, *cells_of_ratios(pairs))
            yield table


def again(stored: Line, dice: random.Random) -> Iterator[Pair]:
    """Yield the numbers of a mechanism beside those measured again, with one integrator."""
    job, runs = Job(stored["seed"], stored["number"]), stored.get("runs") or {}
    integrator = dice.choice(INTEGRATORS)
    new = examine(job, integrators=(integrator,))
    where = f"seed {job.seed}, mechanism {job.number}"
    yield Pair(f"{where}, freedoms", stored["freedoms"], new["freedoms"])
    if not runs or not predictable(stored):
        return
    for name in ("dependent", "step"):
        yield Pair(f"{where}, {name}", stored[name], new[name])
    old, own = runs.get(integrator, {}), new["runs"].get(integrator, {})
    yield Pair(f"{where}, {integrator}, methods", sorted(old), sorted(own))
    for method in old:
        # a vector of another width rounds other sums, and the iteration of `picard` ends otherwise
        within, floor = WITHIN.get(integrator, 1.1), UNRESOLVED
        if method not in own or old[method][0] > LOST:
            continue
        for name, a, b in zip(("error", "reactions"), old[method], own[method], strict=False):
            yield Pair(f"{where}, {integrator}, {method}, {name}", a, b, within, floor)


def page_table() -> PageTable:
    """Return the table of both seeds, the second in brackets."""
    lines = RECORD.lines()
    first, second = ([line for line in lines if line["seed"] == seed] for seed in SEEDS)

    def cells(method: str) -> Iterator[str]:
        both = [cells_of_ratios(pairs_of(own, "rk4", method)) for own in (first, second)]
        a, b = (dict(zip(HEADINGS[1:], one, strict=True)) for one in both)
        yield ", ".join(digits(a[name]) for name in ("10 %", "50 %", "90 %"))
        yield f"{a['better']}, {a['worse']} ({b['better']}, {b['worse']})".replace(" %,", ",")
        for of in (np.median, np.mean):
            yield estimate([base.error / own.error for base, own in pairs_of(lines, "rk4", method)], of)
        yield f"{digits(a['reactions'])} ({digits(b['reactions'])})"
        yield digits(a["time"])

    headings = (
        *("method", "10, 50, 90 %", "better, worse by 5 %", "median", "geometric mean", "of reactions, 50 %"),
        "time, 50 %",
    )
    rows = tuple(((label(method),), partial(list_of, cells, method)) for method in METHODS)
    return PageTable("statistics", "docs/tables/random-mechanisms.md", headings, rows, stored=True, claims=claims)


def interval(values: Sequence[float], of: Any) -> tuple[float, float]:
    """Return the interval of a median or geometric mean that holds with 95 %, by drawing the mechanisms again."""
    drawn = np.random.default_rng(0).choice(np.log(values), (SAMPLES, len(values)))
    low, high = np.percentile(np.exp(of(drawn, axis=1)), [2.5, 97.5])
    return float(low), float(high)


def estimate(values: Sequence[float], of: Any) -> str:
    """Return a median or geometric mean with its interval."""
    low, high = interval(values, of)
    return f"{digits(str(math.exp(float(of(np.log(values))))))} [{digits(str(low))}, {digits(str(high))}]"


def interval_text(values: Sequence[float]) -> str:
    """Return the interval of a median."""
    low, high = interval(values, np.median)
    return f"[{low:.2f}, {high:.2f}]"


def paired(lines: Iterable[Line], integrator: str, method: str, beside: str) -> list[float]:
    """Return the errors of one method over those of another, mechanism by mechanism."""
    runs = (line["runs"].get(integrator, {}) for line in lines if predictable(line))
    return [one[method][0] / one[beside][0] for one in runs if method in one and beside in one and one[beside][0] > 0.0]


def claims() -> Iterator[str]:
    """Yield what the page says of the sample and of the quantiles."""
    lines = RECORD.lines()
    samples = [[line for line in lines if line["seed"] == seed] for seed in SEEDS]
    regular = [[line for line in own if line.get("runs") is not None] for own in samples]
    followed = [[line for line in own if predictable(line)] for own in samples]
    both = [line for own in followed for line in own]
    freedoms, dependent = [line["freedoms"] for line in both], sum(line["dependent"] > 0 for line in both)
    yield (
        f"{len(regular[0])} and {len(regular[1])} of {COUNT} move regularly, {len(followed[0])} and {len(followed[1])} "
        f"predictably; nine in ten of these have up to {np.percentile(freedoms, 90):.0f} freedoms, "
        f"{dependent} dependent rows."
    )
    resolved = [len(pairs_of(own, "rk4", METHODS[0])) for own in samples]
    yield f"With `rk4` the error of `lagrange` is resolved on {resolved[0]} and {resolved[1]}."
    cells = {
        m: [dict(zip(HEADINGS[1:], cells_of_ratios(pairs_of(own, "rk4", m)), strict=True)) for own in samples]
        for m in METHODS
    }

    def both_of(method: str, name: str) -> str:
        return " and ".join(digits(one[name].removesuffix(" %")) for one in cells[method])

    motion = "baumgarte:rule=motion"
    yield (
        f"`baumgarte` with 5 1/s does harm on {both_of('baumgarte', 'worse')} %, by the rule of the motion on "
        f"{both_of(motion, 'worse')} %."
    )
    more = np.array(paired(both, "rk4", "velocity-projection", "direct-correction"))
    logs, twentieth = np.sort(np.log(more)), len(more) // 20
    low, high = interval(more.tolist(), np.mean)
    alike, harm, gain = (
        f"{100 * float(np.mean(share)):.0f}"
        for share in (np.abs(np.log(more)) < ALIKE, more < 1.0 - ALIKE, more > 1.0 + ALIKE)
    )
    yield (
        f"Positions beside velocities: median {np.median(more):.3f}; within 5 % on {alike} % of the mechanisms, better "
        f"on {gain} %, worse on {harm} %. In the geometric mean they are worth "
        f"{math.exp(float(logs.mean())):.2f} [{low:.2f}, {high:.2f}], of which the upper twentieth of the mechanisms "
        f"carries {100 * logs[-twentieth:].sum() / logs.sum():.0f} %."
    )
    metric = {i: paired(both, i, "direct-correction", METHODS[5]) for i in INTEGRATORS}
    words = [f"{np.median(x):.2f} {interval_text(x)} with `{i}`" for i, x in metric.items()]
    yield f"The metric of M beside the identity, medians: {', '.join(words[:-1])} and {words[-1]}."


def digits(cell: str) -> str:
    """Return a number with two digits."""
    x = float(cell)
    return f"{x:.0f}" if abs(x) >= 9.95 else f"{x:.2g}" if abs(x) < 0.995 else f"{x:.1f}"


def label(method: str) -> str:
    """Return the name of a line, such as `direct-correction`, mass."""
    name, _, option = method.partition(":")
    own = {"": "", "weight=mass": ", mass"}.get(option, f", `{option}`")
    return f"`{name}`{own}" + (", 5 1/s" if method == "baumgarte" else "")


RECORD = Record(
    "statistics",
    lambda: (Job(seed, number) for number in range(COUNT) for seed in SEEDS),
    examine,
    again,
    PATIENCE,
    share=0.007,
)


def main() -> None:
    """Print the table of the page, or measure another sample and print a table for each seed and integrator."""
    parser = argparse.ArgumentParser(description="Quantiles over random mechanisms.")
    parser.add_argument("--count", type=int, help="mechanisms of each seed of another sample than the record's")
    parser.add_argument("--seeds", default="1")
    parser.add_argument("--until", type=float, default=UNTIL)
    parser.add_argument("--integrators", default="rk4")
    parser.add_argument("--methods", default=",".join(METHODS))
    parser.add_argument("--workers", type=int, default=1, help="processes; run times want a core each")
    parser.add_argument("--seconds", type=float, default=math.inf, help="no mechanism begins after so many seconds")
    parser.add_argument("-o", "--output", type=Path, help="file of rows; the mechanisms that it has are not measured")
    chosen = parser.parse_args()
    if chosen.count is None:
        print_tables({"statistics": page_table()}, ())
        return
    integrators, methods = tuple(chosen.integrators.split(",")), tuple(chosen.methods.split(","))
    jobs = (Job(int(seed), number) for number in range(chosen.count) for seed in chosen.seeds.split(","))
    own = partial(examine, until=chosen.until, integrators=integrators, methods=methods)
    lines = measure(own, jobs, chosen.output, PATIENCE, chosen.workers, chosen.seconds)
    for table in tables(lines, integrators, methods, chosen.until):
        show(table)


if __name__ == "__main__":
    main()
