"""One random mechanism: drawn, moved by the reference, run by symgen, judged."""

from __future__ import annotations

import math
import tempfile
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from benchmarks.mechanisms.draw import Refused, draw
from benchmarks.mechanisms.toml import text
from benchmarks.plain.moving import Array
from benchmarks.plain.start import CannotClose, start
from benchmarks.plain.system import read
from benchmarks.verification.judge import Verdict, judge
from benchmarks.verification.reference import LEAST, OUTPUTS, Contradiction, Reference, Unusable, prepared
from benchmarks.verification.runs import Configuration, Outcome, basic, every_method, run


@dataclass(frozen=True)
class Job:
    """Which mechanism, and how it is run."""

    seed: int
    index: int
    shapes: tuple[str, ...]
    methods: bool
    spatial: bool | None
    least: float = LEAST

    @property
    def configurations(self) -> list[Configuration]:
        """The runs."""
        if self.methods:
            return [configuration for shape in self.shapes for configuration in every_method(shape)]
        return basic(list(self.shapes))


def examine(job: Job) -> dict[str, Any]:
    """Return a line about one mechanism, ready for JSON."""
    line: dict[str, Any] = {"seed": job.seed, "index": job.index}
    try:
        drawn = draw(job.seed, job.index, job.spatial)
    except Refused as refused:
        return {**line, "unusable": str(refused)}
    return {**line, "features": list(drawn.features), **compared(drawn.raw, job.configurations, job.least)}


def compared(raw: Mapping[str, Any], configurations: list[Configuration], least: float = LEAST) -> dict[str, Any]:
    """Return the runs of a mechanism with what is to be said of them, or why nothing is.

    Parameters
    ----------
    raw : mapping
        Its file.
    configurations : list of Configuration
        What to run.
    least : float
        How near to singular positions motions may come; see `prepared`.
    """
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "drawn.toml"
        path.write_text(text(raw), encoding="utf-8")
        try:
            begin = None if _determined(raw) else _theirs(path, raw)
            reference = prepared(raw, begin=begin, least=least)
        except Contradiction as unusable:
            return _contradicted(path, configurations, str(unusable))
        except (Unusable, CannotClose, np.linalg.LinAlgError) as unusable:
            return {"unusable": str(unusable)}
        steady = reference.coarse is not None
        runs = [_line(a, *_judged(path, a, reference)) for a in configurations if steady or a.rtol is not None]
    return {"until": float(reference.times[-1]), "growth": reference.growth["q"], "runs": runs}


def _judged(path: Path, configuration: Configuration, reference: Reference) -> tuple[Outcome, Verdict]:
    outcome = run(path, configuration, reference.times, reference.step)
    verdict = judge(reference, configuration, outcome)
    if verdict.right is False and outcome.status == "ok" and configuration.rtol is None:
        verdict = judge(
            reference, configuration, outcome, run(path, configuration, reference.times, reference.step / 2)
        )
    return outcome, verdict


def _determined(raw: Mapping[str, Any]) -> bool:
    return start(read(raw)).determined


def _theirs(path: Path, raw: Mapping[str, Any]) -> tuple[Array, Array]:
    """Return symgen's own start where the file leaves a choice, once it is seen to be one the file allows."""
    system = read(raw)
    mine = start(system)
    outcome = run(path, Configuration("lagrange", "rk4", "straight"), np.linspace(0.0, 1e-3, 2), 1e-3)
    if not len(outcome.t):
        raise Unusable(f"symgen has no start: {outcome.reason}")
    q, v = (
        outcome.columns[name][0, [outcome.names[name].index(n) for n in names]]
        for name, names in (("q", system.names_q), ("v", system.names_v))
    )
    c = system.constraints(system.at(0.0, q, v))
    open_ = max(np.abs(c.phi).max(initial=0.0), np.abs(c.d @ v - c.nu).max(initial=0.0))
    described = np.concatenate([body.start for body in system.bodies.values()])
    moved = float(np.abs(np.abs(q) - np.abs(described)).max())
    if not open_ < 1e-8 * max(1.0, float(np.abs(v).max())) or moved > 3.0 * mine.moved + 1e-6:
        raise BadStart(f"symgen's start is open by {open_:.2g} and moved by {moved:.2g}, mine by {mine.moved:.2g}")
    return q, v


class BadStart(Exception):
    """A start of symgen's that the file does not allow."""


def _contradicted(path: Path, configurations: list[Configuration], why: str) -> dict[str, Any]:
    """Return runs of a mechanism that has no motion: none of them may be `ok`."""
    runs = []
    for a in configurations:
        outcome = run(path, a, np.linspace(0.0, 1.0, OUTPUTS + 1), 1.0 / 400)
        verdict = Verdict(outcome.status not in ("ok", "raised"), outcome.status != "ok", {}, {}, ("no motion",))
        runs.append(_line(a, outcome, verdict))
    return {"contradiction": why, "runs": runs}


def _line(configuration: Configuration, outcome: Outcome, verdict: Verdict) -> dict[str, Any]:
    return {
        "run": configuration.label,
        "status": outcome.status,
        "reason": outcome.reason,
        "honest": verdict.honest,
        "right": verdict.right,
        "wrong": list(verdict.wrong),
        "errors": {n: _finite(x) for n, x in verdict.errors.items()},
        "bounds": {n: _finite(x) for n, x in verdict.bounds.items()},
        "facts": {k: _finite(x) if isinstance(x, float) else x for k, x in outcome.facts.items()},
    }


def _finite(x: float) -> float:
    return x if math.isfinite(x) else 1e300
