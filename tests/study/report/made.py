"""Studies made by hand: what a report says can then be known without running anything."""

from dataclasses import replace

from symgen.study.comparison.comparison_rows import Row, Trace
from symgen.study.comparison.comparison_study import Study
from symgen.study.stress.stress_rows import StressRow
from symgen.study.yardstick import YARDSTICK


def row(method, step, error, seconds, **changes):
    """Return a row of rk4 that ended ok."""
    values = {
        "method": method,
        "integrator": "rk4",
        "step": step,
        "rtol": None,
        "status": "ok",
        "reason": None,
        "error": error,
        "below_reference": False,
        "run_seconds": seconds,
        "run_seconds_spread": 0.2 * seconds,
        "run_seconds_median": seconds,
        "run_seconds_low": 0.97 * seconds,
        "run_seconds_high": 1.04 * seconds,
        "wall_seconds": 1.1 * seconds,
        "evaluations": 1000,
        "iterations": 7,
        "position_violation_max": 1e-13,
        "velocity_violation_max": 2e-13,
        "energy_drift_max": 3e-8,
        "acceleration_violation_max": 4e-12,
        "position_violation_rms": 5e-14,
        "velocity_violation_rms": 6e-14,
        "acceleration_violation_rms": 7e-13,
        "position_violation_final": 8e-14,
        "velocity_violation_final": 9e-14,
        "acceleration_violation_final": 1e-12,
    }
    return Row(**{**values, **changes})


def trace(size=1.0):
    """Return curves of eleven outputs."""
    t = tuple(0.1 * i for i in range(11))
    rising = tuple(size * 1e-9 * i for i in range(11))
    level = (size * 1e-12,) * 11
    return Trace(t, rising, level, level, level, tuple(10.0 * x for x in t), tuple(-10.0 * x for x in t), rising)


def study(rows=None, **changes):
    """Return a study of four methods at two steps; `baumgarte` fails once, the penalty is far off."""
    if rows is None:
        rows = [
            row("lagrange", 1e-3, 1.6e-7, 1.0e-3, position_violation_max=3e-8),
            row("lagrange", 5e-4, 1.0e-8, 2.0e-3, position_violation_max=1e-8),
            row("baumgarte", 1e-3, 1.6e-7, 1.1e-3),
            row("baumgarte", 5e-4, None, 1e-4, status="failed", reason="the state is no longer finite at t = 0.3 s"),
            row("direct-correction", 1e-3, 1.6e-8, 1.3e-3),
            row("direct-correction", 5e-4, 1e-13, 2.4e-3, below_reference=True),
            row("penalty", 1e-3, 0.5, 1.2e-3),
            row("penalty", 5e-4, 0.25, 2.4e-3),
        ]
    values = {
        "mechanism": "four-bar",
        "how": "a formula at 3e-14",
        "estimated_error": 1e-12,
        "until": 1.0,
        "traces": tuple(trace(i + 1) for i in range(len(rows))),
        "title": 'A linkage <with> odd & "quoted" words',
        "digest": "0123456789abcdef",
        "repeat": 3,
    }
    return Study(**{**values, "rows": with_ratios(rows), **changes})


def with_ratios(rows):
    """Return the rows with their ratios to `lagrange` at the same step, each with an interval of 10 % about it."""
    base = {r.setting: r.run_seconds for r in rows if r.method == YARDSTICK}
    rated = []
    for r in rows:
        ratio = r.run_seconds / base[r.setting] if r.ended and r.setting in base else None
        if ratio is not None:
            half = 0.0 if r.method == YARDSTICK else 0.1 * ratio
            bounds = {"cost_ratio_low": ratio - 0.5 * half, "cost_ratio_high": ratio + half, "cost_ratio_spread": half}
            r = replace(r, cost_ratio=ratio, **bounds)
        rated.append(r)
    return tuple(rated)


def stress_row(model, method, outcome, error, **changes):
    """Return a cell of a stress study with rk4 that ended ok."""
    base = StressRow(
        *(model, "stiffness", "1", (1.0,), method, "rk4", 1e-3, 1.0, outcome, error, error, 1e-9, "ok", None, 4000),
        *(1e-12, 1e-12, 0.0, "", "", True),
    )
    return replace(base, **changes)
