"""A run in a few lines, for terminals and notebooks."""

from __future__ import annotations

import math
from collections import Counter
from typing import TYPE_CHECKING, Any

from symgen.base.errors import plural
from symgen.result.contract import json_value
from symgen.result.labelled import Labelled, notebook_table
from symgen.result.result import FAILED

if TYPE_CHECKING:
    from symgen.result.result import Result


def summary_lines(result: Result) -> list[tuple[str, str]]:
    """Return (label, text) pairs that say what was run and how it went."""
    if result.rtol is None:
        steps = f"step {result.step:g} s"
    else:
        over = " of length and speed" if result.relative_atol else ""
        steps = f"rtol {result.rtol:g}, atol {result.atol:g}{over}"
    rejected = f", {result.rejected} rejected" if result.rejected else ""
    s, rank = result.seconds, result.rank
    spread = f" (spread {s.run_spread:.2g} s)" if s.run_spread else ""
    derivation = f"; derived in {s.derive:.3g} s, emitted in {s.emit:.3g} s" if s.derive else ""
    dropped = f", {rank.identical_rows_dropped} identical dropped" if rank.identical_rows_dropped else ""
    together = ", eight at a time" if result.vector_width else ""
    pairs = [
        ("mechanism", result.mechanism),
        ("method", f"{result.method}, {result.integrator}, {steps}, until {result.until:g} s"),
        *([("coordinates", _coordinates_in_words(result))] if result.coordinates != "absolute" else []),
        ("status", status_in_words(result)),
        (
            "steps",
            f"{result.steps}{rejected}, {plural(result.evaluations, 'evaluation')} of the right-hand side{together}",
        ),
        ("time", f"run {s.run:.4g} s{spread}; compiled code ready in {s.compile:.3g} s{derivation}"),
        ("violations", f"position {result.position_violation_max:.3g}, velocity {result.velocity_violation_max:.3g}"),
        ("energy error", f"{result.energy_drift_max:.3g} J"),
        ("rank", f"{rank.rank} of {plural(rank.rows, 'row')}{dropped}"),
    ]
    if result.rank_event_count:
        pairs.append(("passages", f"{result.rank_event_count} near singular positions"))
    if result.events:
        counts = Counter(event.name for event in result.events)
        names = [name if n == 1 else f"{name} {n} times" for name, n in counts.items()]
        pairs.append(("events", f"{', '.join(names)}; the last at t = {result.events[-1].t:g} s"))
    if len(result.t):
        pairs.append(("outputs", f"{len(result.t)}, the last at t = {result.t[-1]:g} s"))
    return pairs


def _coordinates_in_words(result: Result) -> str:
    """Return the coordinates of the state, in words."""
    count = len(result.state)
    return f"{result.coordinates}, {count} numbers of the state; the rank is that over all rows of the mechanism"


def status_in_words(result: Result) -> str:
    """Return status, reason, how the error was estimated, and proposals: ``ok (error about 3.2e-07 m, from ...)``."""
    text = result.status + (f": {result.reason}" if result.reason else "")
    if result.status == FAILED:
        return text
    adaptive = result.rtol is not None
    parts = [f"local errors within rtol {result.rtol:g}"] if adaptive else []
    if result.error_estimate is not None:
        other = "other tolerances" if adaptive else "half the step"
        parts.append(f"error about {result.error_estimate:.2g} m, from a run with {other}")
    else:
        whole, finer = ("global error", "a tenth of it") if adaptive else ("error", "half the step")
        why = f" as {result.unchecked}" if adaptive and result.unchecked else ""
        parts.append(f"{whole} not estimated{why}: `verify` runs again with {finer}")
    parts += [
        f"stiff: {proposal.replace('--integrator', '`integrator`')} takes longer steps" for proposal in result.proposals
    ]
    return f"{text} ({'; '.join(parts)})"


def summary_table(result: Result) -> str:
    """Return the summary as an HTML table."""
    rows = [*summary_lines(result), *(("warning", w) for w in result.warnings), *(("note", n) for n in result.notes)]
    return notebook_table((), rows)


def extreme_values(table: Labelled) -> dict[str, dict[str, Any]]:
    """Return unit, last, smallest and largest value of each column, None where there is none."""
    entries: dict[str, dict[str, Any]] = {}
    for i, (name, unit) in enumerate(zip(table.names, table.units, strict=True)):
        values = table.values[:, i]
        numbers = (values[-1], values.min(), values.max()) if len(values) else (math.nan,) * 3
        entries[name] = {"unit": unit, **dict(zip(("final", "min", "max"), map(float, numbers), strict=True))}
    return {name: json_value(entry) for name, entry in entries.items()}
