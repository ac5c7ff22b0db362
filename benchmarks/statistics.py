"""Errors, reactions, violations and run times over random mechanisms: quantiles by method.

    python -m benchmarks.statistics [--count N] [--seed S] [--until T] [--integrators A,B] [--methods A,B:OPTION=VALUE]

Mechanisms are drawn in the plane and in space by turns (`benchmarks.mechanisms.draw`): trees and closed loops of one to
six freedoms, with dependent rows here and there. Those whose motion does not stay regular are left out, and counted.
Constant steps are 0.03 over the rate rms(v') / rms(v) of a mechanism's motion, tolerances 1e-7. Errors are distances to
`direct-correction` in the metric of M with `dop853` at 1e-11, at 201 outputs, and ratios are the error of `lagrange`
over that of the method: above 1 the method is better.
"""

from __future__ import annotations

import argparse
import math
import tempfile
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from rich.table import Table

from benchmarks.mechanisms.draw import Refused, draw
from benchmarks.mechanisms.toml import text
from benchmarks.show import show
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
)
#: Steps of constant length over the rate of the motion, and tolerances of adaptive integrators.
STEP, RTOL = 0.03, 1e-7
#: Outputs, and attempted steps of a reference at most.
OUTPUTS, ATTEMPTS = 201, 20_000
#: Errors that differ by less are alike: where joints hardly open, closing them changes nothing.
ALIKE = 0.05
#: Errors of `lagrange` below this share of the mechanism's length are not resolved; motions slower than this stand.
RESOLVED, STANDS = 1e-9, 1e-3


@dataclass(frozen=True)
class Measured:
    """One run: errors of positions over the length [1], of reactions over the largest, violation, and CPU time [s]."""

    error: float
    reactions: float | None
    violation: float
    seconds: float


@dataclass(frozen=True)
class Case:
    """A mechanism with its reference motion, and the step that suits it."""

    model: Model
    distances: Distances
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
        return cls(model, Distances(model.mechanism, {}, motion, reactions), step, times)

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


def cases(count: int, seed: int, until: float) -> Iterator[Case]:
    """Yield the regular ones of the first `count` mechanisms of a seed."""
    with tempfile.TemporaryDirectory() as folder:
        for index in range(count):
            try:
                path = Path(folder) / f"m{index}.toml"
                path.write_text(text(draw(seed, index).raw), encoding="utf-8")
                case = Case.of(load(path), until)
            except (Refused, SymgenError):
                continue
            if case is not None:
                yield case


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


def main() -> None:
    """Print a table for each integrator."""
    parser = argparse.ArgumentParser(description="Quantiles over random mechanisms.")
    parser.add_argument("--count", type=int, default=48)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--until", type=float, default=4.0)
    parser.add_argument("--integrators", default="rk4")
    parser.add_argument("--methods", default=",".join(METHODS))
    chosen = parser.parse_args()
    integrators, methods = chosen.integrators.split(","), chosen.methods.split(",")
    pairs: dict[tuple[str, str], list[tuple[Measured, Measured]]] = {}
    regular = 0
    for case in cases(chosen.count, chosen.seed, chosen.until):
        regular += 1
        for integrator in integrators:
            base = case.run("lagrange", integrator)
            if base is None or base.error < RESOLVED:
                continue
            for method in methods:
                own = case.run(method, integrator)
                if own is not None:
                    pairs.setdefault((integrator, method), []).append((base, own))
        print(f"{regular} regular", end="\r", flush=True)
    for integrator in integrators:
        title = f"{integrator}, {chosen.until:g} s, seed {chosen.seed}: {regular} regular of {chosen.count} mechanisms"
        table = Table(title=title)
        for heading in ("method", "n", "10 %", "50 %", "90 %", "better", "worse", "mean", "reactions", "|Phi|", "time"):
            table.add_column(heading)
        for method in methods:
            if (integrator, method) in pairs:
                table.add_row(method, *line(pairs[integrator, method]))
        show(table)


if __name__ == "__main__":
    main()
