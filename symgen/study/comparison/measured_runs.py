"""From one timed run to its row and its curves."""

from __future__ import annotations

from statistics import median
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from symgen.result.judge import judge
from symgen.run.layout import abi
from symgen.study.comparison.comparison_rows import Row, Trace, half_width
from symgen.study.comparison.laws import contact_measures

if TYPE_CHECKING:
    from symgen.run.planning.prepare import Prepared
    from symgen.run.single.outcome import Outcome
    from symgen.study.comparison.distances import Distances
    from symgen.study.comparison.turns import Turns

Array = NDArray[np.float64]

#: Largest number of points of a curve.
LONGEST = 400


def measure_run(
    run: Prepared,
    runs: Turns,
    distances: Distances | None,
    variant: str,
    stopped: Outcome | None = None,
    law: str = "",
) -> tuple[Row, Trace]:
    """Compare one run with the reference and measure it.

    Parameters
    ----------
    run : Prepared
        What was run.
    runs : Turns
        Its results, and run times beside the yardstick.
    distances : Distances or None
        Measures of errors; None without a reference.
    variant : str
        Options that distinguish the method from others of the study.
    stopped : Outcome, optional
        The run as one of its limits stopped it, by which it is judged; `runs` then have no limits.
    law : str
        Law of rows with two bounds.
    """
    plan, outcome = run.plan, run.of_bodies(runs.outcome)
    count = len(outcome.times)
    verdict = judge(run, outcome if stopped is None else run.of_bodies(stopped))
    along = None if distances is None else distances.position_errors(outcome)
    judged = distances if outcome.code == abi.DONE else None
    error = None if along is None or judged is None else float(along.max(initial=0.0))
    accelerations = outcome.acceleration_violations if count else np.zeros(0)
    status, adaptive = outcome.status_columns, plan.spec.adaptive
    violations = {"position": status[:, abi.PHI], "velocity": status[:, abi.DRIFT], "acceleration": accelerations}
    contact = contact_measures(plan.mechanism, outcome)
    row = Row(
        method=plan.choice.method.name,
        coordinates=plan.coordinates,
        variant=variant,
        integrator=plan.integrator.name,
        step=None if adaptive else plan.spec.step,
        rtol=plan.spec.rtol if adaptive else None,
        status=verdict.status,
        reason=verdict.reason,
        error=error,
        relative_error=error / judged.scale if error is not None and judged and judged.scale > 0.0 else None,
        velocity_error=None if judged is None else _largest_value(judged.velocity_errors(outcome)),
        reaction_error=None if judged is None else _largest_value(judged.reaction_errors(outcome)),
        beyond_limits=stopped is not None and outcome.code == abi.DONE,
        below_reference=error is not None and judged is not None and error < judged.reference.estimated_error,
        **_times_of_turns(runs),
        evaluations=outcome.evaluations,
        iterations=outcome.counters.get("iterations", 0),
        position_violation_max=outcome.position_violation_max,
        velocity_violation_max=outcome.velocity_violation_max,
        acceleration_violation_max=float(accelerations.max()) if count else None,
        relative_violation=None if distances is None else outcome.position_violation_max / (distances.size or 1.0),
        **_summaries_of_violations(violations),
        energy_drift_max=outcome.energy_drift_max,
        warnings=(*plan.mechanism.remarks, *plan.all_warnings, *outcome.start.warnings, *verdict.warnings),
        law=law,
        creep=None if judged is None else judged.largest_creep(outcome),
        transitions=None if contact is None else contact.transitions,
        impacts=None if contact is None else contact.impacts,
        dissipated=None if contact is None else contact.dissipated,
    )
    kinetic, potential = status[:, abi.KINETIC], status[:, abi.POTENTIAL]
    work = outcome.states[:, outcome.compiled.info.work]
    curves = {
        **violations,
        **{"t": outcome.times, "error": () if along is None else along},
        **{"kinetic": kinetic, "potential": potential},
        "energy_error": kinetic + potential - outcome.energy_start - work,
    }
    trace = Trace(**{name: _round_values(values) for name, values in curves.items()})
    return row, trace


def _summaries_of_violations(violations: dict[str, Array]) -> dict[str, Any]:
    """Return root mean squares and final values of violations, by the fields of a row."""
    rms = {f"{level}_violation_rms": _root_mean_square(values) for level, values in violations.items()}
    final = {f"{level}_violation_final": float(x[-1]) if len(x) else None for level, x in violations.items()}
    return rms | final


def _times_of_turns(runs: Turns) -> dict[str, Any]:
    """Return the run times of a row, by its fields."""
    middle = median(runs.seconds)
    low, high = runs.quartiles or (None, None)
    least, most = runs.ratio_interval or (None, None)
    return {
        "run_seconds": middle,
        "run_seconds_median": middle,
        "run_seconds_low": low,
        "run_seconds_high": high,
        "run_seconds_spread": None if runs.single else max(runs.seconds) - min(runs.seconds),
        "wall_seconds": median(runs.wall),
        "disturbed": runs.disturbed,
        "cost_ratio": runs.ratio,
        "cost_ratio_low": least,
        "cost_ratio_high": most,
        "cost_ratio_spread": half_width(runs.ratio, least, most),
    }


def _largest_value(values: Array | None) -> float | None:
    return None if values is None else float(values.max(initial=0.0))


def _root_mean_square(values: Array) -> float | None:
    return float(np.sqrt(np.mean(np.square(values)))) if len(values) else None


def _round_values(values: Any) -> tuple[float, ...]:
    """Return the values to draw, rounded to five digits."""
    every = max(1, -(-len(values) // LONGEST))
    return tuple(float(f"{x:.5g}") for x in values[::every])
