"""Errors, reactions, violations and run times over random mechanisms: quantiles by method.

    python -m benchmarks.statistics [--count N] [--seeds S,S] [--until T] [--integrators A,B]
        [--methods A,B:OPTION=VALUE] [--workers N] [--seconds S] [-o ROWS]

Mechanisms are drawn in the plane and in space by turns (`benchmarks.mechanisms.draw`): trees and closed loops of one to
six freedoms, with dependent rows here and there. Those whose motion does not stay regular are left out, and counted.
Constant steps are 0.03 over the rate rms(v') / rms(v) of a mechanism's motion, tolerances 1e-7. Errors are distances to
`direct-correction` in the metric of M with `dop853` at 1e-11, at 201 outputs, and ratios are the error of `lagrange`
over that of the method: above 1 the method is better.

Each mechanism is a line of JSON in the file of rows as soon as it is measured, and mechanisms that the file has are not
measured again: what was measured anywhere gives the tables here.
"""

from __future__ import annotations

import argparse
import contextlib
import json
import math
import sys
import tempfile
import time
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import asdict, dataclass, fields
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from rich.table import Table

from benchmarks.mechanisms.draw import Refused, draw
from benchmarks.mechanisms.toml import text
from benchmarks.show import show
from benchmarks.verification.workers import answers
from symgen.api import Model, load
from symgen.base.errors import SymgenError
from symgen.result.result import FAILED, Result
from symgen.study.comparison.combinations import variant_of
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
#: Processor time of a mechanism at most [s].
PATIENCE = 60.0
HEADINGS = ("method", "n", "10 %", "50 %", "90 %", "better", "worse", "mean", "reactions", "|Phi|", "time")

#: A mechanism of the file of rows: seed, index, what it is, and its runs by integrator and method.
Line = Mapping[str, Any]


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
        method, own = variant_of(words)
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
        loads = self.distances.of_reactions(outcome)
        error = float(self.distances.of_positions(outcome).max()) / self.distances.size
        reactions = None if loads is None or not scale else float(loads.max()) / scale
        return Measured(error, reactions, result.position_violation_max, outcome.cpu_seconds)


@dataclass(frozen=True)
class Job:
    """One mechanism and its runs."""

    seed: int
    index: int
    until: float
    integrators: tuple[str, ...]
    methods: tuple[str, ...]


def case_of(seed: int, index: int, until: float) -> Case | None:
    """Return a drawn mechanism with its reference, None where its motion is not regular."""
    with tempfile.TemporaryDirectory() as folder:
        try:
            path = Path(folder) / f"m{index}.toml"
            path.write_text(text(draw(seed, index).raw), encoding="utf-8")
            return Case.of(load(path), until)
        except (Refused, SymgenError):
            return None


def examine(job: Job) -> dict[str, Any]:
    """Return the line of a mechanism: without runs where its motion is not regular."""
    line: dict[str, Any] = {"seed": job.seed, "index": job.index}
    case = case_of(job.seed, job.index, job.until)
    if case is None:
        return line
    runs = []
    for integrator in job.integrators:
        base = case.run("lagrange", integrator)
        if base is None or base.error < RESOLVED:
            continue
        runs.append({"integrator": integrator, "method": "lagrange", **asdict(base)})
        for method in job.methods:
            own = case.run(method, integrator)
            if own is not None:
                runs.append({"integrator": integrator, "method": method, **asdict(own)})
    return line | {"freedoms": case.freedoms, "dependent": case.dependent, "step": case.step, "runs": runs}


def measured(jobs: Iterable[Job], workers: int, seconds: float) -> Iterator[dict[str, Any]]:
    """Yield the lines of mechanisms as processes finish them; none begins after so many seconds."""
    began = time.monotonic()
    timely = (job for job in jobs if time.monotonic() - began < seconds)
    for answer in answers(examine, timely, workers, PATIENCE):
        yield answer.value or {"seed": answer.job.seed, "index": answer.job.index, "died": answer.died}


def lines_in(path: Path | None) -> list[Line]:
    """Return the lines of a file of rows."""
    if path is None or not path.exists():
        return []
    return [json.loads(line) for line in path.read_text(encoding="utf-8").splitlines() if line.strip()]


def pairs_of(lines: Iterable[Line], integrator: str, method: str) -> list[tuple[Measured, Measured]]:
    """Return `lagrange` and a method on the same mechanisms."""
    pairs = []
    for line in lines:
        runs = {run["method"]: run for run in line.get("runs", ()) if run["integrator"] == integrator}
        if method in runs:
            base, own = (
                Measured(**{f.name: runs[name][f.name] for f in fields(Measured)}) for name in ("lagrange", method)
            )
            pairs.append((base, own))
    return pairs


def quantiles(values: Sequence[float]) -> tuple[str, ...]:
    """Return the tenth, half and nine tenths of some values as cells."""
    return ("", "", "") if not len(values) else tuple(f"{x:.3g}" for x in np.percentile(values, [10, 50, 90]))


def line(pairs: Sequence[tuple[Measured, Measured]]) -> tuple[str, ...]:
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
        regular = sum("runs" in line for line in own)
        for integrator in integrators:
            title = f"{integrator}, {until:g} s, seed {seed}: {regular} regular of {len(own)} mechanisms"
            table = Table(title=title)
            for heading in HEADINGS:
                table.add_column(heading)
            for method in methods:
                if pairs := pairs_of(own, integrator, method):
                    table.add_row(method, *line(pairs))
            yield table


def main() -> None:
    """Measure, and print a table for each seed and integrator."""
    parser = argparse.ArgumentParser(description="Quantiles over random mechanisms.")
    parser.add_argument("--count", type=int, default=48, help="mechanisms of each seed")
    parser.add_argument("--seeds", default="1")
    parser.add_argument("--until", type=float, default=4.0)
    parser.add_argument("--integrators", default="rk4")
    parser.add_argument("--methods", default=",".join(METHODS))
    parser.add_argument("--workers", type=int, default=1, help="processes; run times want a core each")
    parser.add_argument("--seconds", type=float, default=math.inf, help="no mechanism begins after so many seconds")
    parser.add_argument("-o", "--output", type=Path, help="file of rows; the mechanisms that it has are not measured")
    chosen = parser.parse_args()
    integrators, methods = tuple(chosen.integrators.split(",")), tuple(chosen.methods.split(","))
    lines = lines_in(chosen.output)
    done = {(line["seed"], line["index"]) for line in lines}
    pairs = ((int(seed), index) for index in range(chosen.count) for seed in chosen.seeds.split(","))
    jobs = (Job(*pair, chosen.until, integrators, methods) for pair in pairs if pair not in done)
    with contextlib.ExitStack() as stack:
        file = None if chosen.output is None else stack.enter_context(chosen.output.open("a", encoding="utf-8"))
        for row in measured(jobs, chosen.workers, chosen.seconds):
            lines.append(row)
            if file is not None:
                file.write(json.dumps(row) + "\n")
                file.flush()
            print(f"{len(lines)} mechanisms", end="\r", file=sys.stderr, flush=True)
    for table in tables(lines, integrators, methods, chosen.until):
        show(table)


if __name__ == "__main__":
    main()
