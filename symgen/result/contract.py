"""What programs get of a result: the JSON of ``symgen run --json``."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from symgen.result.run_data import RunData


def contract(result: RunData) -> dict[str, Any]:
    """Return a result as JSON has it; numbers that are not finite become None."""
    last = result.t.shape[0] - 1
    found: dict[str, Any] = finite(
        {
            "mechanism": result.mechanism,
            "method": result.method,
            "integrator": result.integrator,
            "shape": result.shape,
            "coordinates": result.coordinates,
            "state": list(result.state),
            "step": result.step,
            "rtol": result.rtol,
            "atol": result.atol,
            "until": result.until,
            "status": result.status,
            "reason": result.reason,
            "warnings": list(result.warnings),
            "notes": list(result.notes),
            "parameters": dict(result.parameters),
            "inputs": dict(result.inputs),
            "steps": result.steps,
            "rejected": result.rejected,
            "evaluations": result.evaluations,
            "iterations": result.iterations,
            "seconds": {
                "derive": result.seconds.derive,
                "emit": result.seconds.emit,
                "compile": result.seconds.compile,
                "run": result.seconds.run,
            },
            "position_violation_max": result.position_violation_max,
            "velocity_violation_max": result.velocity_violation_max,
            "energy_drift_max": result.energy_drift_max,
            "error_estimate": result.error_estimate,
            "rank": {
                "rows": result.rank.rows,
                "rank": result.rank.rank,
                "identical_rows_dropped": result.rank.identical_rows_dropped,
            },
            "rank_events": [
                {"t_in": e.t_in, "t_out": e.t_out, "rank": e.rank, "smallest_pivot": e.smallest_pivot}
                for e in result.rank_events
            ],
            "rank_event_count": result.rank_event_count,
            "end": result.end,
            "events": [event.to_json() for event in result.events],
            "watched": [{"name": name, "action": action} for name, action in result.watched],
            "accumulation": result.accumulation,
            "start": result.start,
            "final": {
                "t": float(result.t[last]) if last >= 0 else None,
                "q": result.q.row(),
                "v": result.v.row(),
                "lam": result._final_multipliers,
                **({"outputs": result.outputs.row()} if result.columns("outputs") else {}),
            },
        }
    )
    return found


def finite(value: Any) -> Any:
    """Return `value` with every number that JSON cannot express replaced by None."""
    if isinstance(value, dict):
        return {key: finite(item) for key, item in value.items()}
    if isinstance(value, list | tuple):
        return [finite(item) for item in value]
    if isinstance(value, float) and not math.isfinite(value):
        return None
    return value
