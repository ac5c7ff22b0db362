"""Result of a run for programs: the JSON of ``symgen run --json``."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import asdict
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from symgen.result.labelled import Labelled
    from symgen.result.result import Result


#: Attributes of a result that its JSON has under their own names, before and after the times.
_FIRST = (
    *("mechanism", "method", "integrator", "shape", "coordinates", "state"),
    *("step", "rtol", "atol", "relative_atol", "until"),
    *("status", "reason", "warnings", "notes", "parameters", "inputs"),
    *("steps", "rejected", "evaluations", "iterations", "vector_width"),
)
_SECOND = ("position_violation_max", "velocity_violation_max", "energy_drift_max", "error_estimate", "unchecked")


def json_contract(result: Result) -> dict[str, Any]:
    """Return a result as JSON has it; numbers that are not finite become None."""
    seconds, rank = asdict(result.seconds), asdict(result.rank)
    del seconds["run_spread"], rank["redundant_rows"]
    final = {
        "t": float(result.t[-1]) if len(result.t) else None,
        "q": result.q.row(),
        "v": result.v.row(),
        "lam": result._final_multipliers,
        **({"outputs": result.outputs.row()} if result.columns("outputs") else {}),
    }
    facts: dict[str, Any] = json_value(
        {
            **{name: getattr(result, name) for name in _FIRST},
            "seconds": seconds,
            **{name: getattr(result, name) for name in _SECOND},
            "rank": rank,
            "rank_events": [asdict(event) for event in result.rank_events],
            "rank_event_count": result.rank_event_count,
            "end": result.end,
            "events": [event.to_json() for event in result.events],
            "watched": [{"name": name, "action": action} for name, action in result.watched],
            "accumulation": result.accumulation,
            "start": result.start,
            "final": final,
            **({"sensitivities": result.sensitivities.to_json(result)} if result.sensitivities else {}),
        }
    )
    return facts


def json_value(value: object) -> Any:
    """Return `value` with every number that JSON cannot express replaced by None."""
    if isinstance(value, Mapping):
        return {key: json_value(item) for key, item in value.items()}
    if isinstance(value, list | tuple):
        return [json_value(item) for item in value]
    if isinstance(value, float) and not math.isfinite(value):
        return None
    return value


def json_series(table: Labelled) -> dict[str, list[float | None]]:
    """Return a table as JSON has it: lists by key; numbers that are not finite are None."""
    columns = {name: table.values[:, i].tolist() for i, name in enumerate(table.names)}
    return columns if np.all(np.isfinite(table.values)) else json_value(columns)
