"""Run time at an error: what each line of a study costs at one and the same accuracy.

Methods at the same step differ in error as well as in time, so that the ratio of their times alone compares nothing.
Run times are interpolated between settings, log time over log error. All settings of all lines are timed in turn,
round by round: a round shares the load of the machine, and ratios are taken within it.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from symgen.study.comparison.comparison_rows import Row

#: Rounds of timed runs.
ROUNDS = 9
#: Name of a line: label of the method, and integrator.
Line = tuple[str, str]
#: Run times of all rows by round [s]; None for a row that has none.
Rounds = Sequence[Sequence[float | None]]


@dataclass(frozen=True)
class TimeAtError:
    """Run time of a line at an error, interpolated over its settings in every round.

    Attributes
    ----------
    error : float
        The error [m].
    method, integrator : str
        Label of the method, and integrator.
    seconds, seconds_low, seconds_high : float or None
        Median and quartiles of the CPU time of the loop over the rounds [s]; None where no two settings of the line
        have errors on both sides.
    ratio, ratio_low, ratio_high : float or None
        The same of the ratio to the first method of the study with the same integrator.
    reason : str
        Why the line has no time at this error; empty where it has one.
    """

    error: float
    method: str
    integrator: str
    seconds: float | None = None
    seconds_low: float | None = None
    seconds_high: float | None = None
    ratio: float | None = None
    ratio_low: float | None = None
    ratio_high: float | None = None
    reason: str = ""


def rows_by_line(rows: Sequence[Row]) -> dict[Line, list[int]]:
    """Return the indices of the rows of each line, the coarsest setting first."""
    lines: dict[Line, list[int]] = {}
    for i, row in enumerate(rows):
        lines.setdefault((row.label, row.integrator), []).append(i)
    return {line: sorted(own, key=lambda i: -(rows[i].step or rows[i].rtol or 0.0)) for line, own in lines.items()}


def time_at_error(points: Sequence[tuple[float, float]], error: float) -> float | None:
    """Return the time at an error, from (error, time) of settings in their order; the least where several fit."""
    fit = []
    for (e0, t0), (e1, t1) in pairwise(points):
        if min(e0, e1) <= error <= max(e0, e1) and e0 != e1:
            share = math.log(error / e0) / math.log(e1 / e0)
            fit.append(t0 * (t1 / t0) ** share)
    return min(fit, default=None)


def times_at(rows: Sequence[Row], rounds: Rounds, errors: Sequence[float]) -> tuple[TimeAtError, ...]:
    """Return the run time of every line at every error.

    Parameters
    ----------
    rows : sequence of Row
        Rows of a study. Those that did not reach the end, or whose error the reference does not resolve, have no point.
    rounds : sequence
        See `Rounds`.
    errors : sequence of float
        Errors [m].
    """
    lines = rows_by_line(rows)
    table = []
    for error in errors:
        columns = {
            line: [_times_of_line(rows, own, seconds, error) for seconds in rounds] for line, own in lines.items()
        }
        for (method, integrator), column in columns.items():
            base = columns.get((rows[0].label, integrator), [])
            pairs = zip(column, base, strict=False)
            ratios = [a / b for a, b in pairs if a is not None and b is not None]
            own = [x for x in column if x is not None]
            reason = "" if own else _reason_of_absence([rows[i] for i in lines[method, integrator]], error)
            middle, low, high = _quartiles_of_values(own)
            ratio, least, most = _quartiles_of_values(ratios)
            table.append(TimeAtError(error, method, integrator, middle, low, high, ratio, least, most, reason))
    return tuple(table)


def _reason_of_absence(rows: Sequence[Row], error: float) -> str:
    """Return why a line has no time at an error."""
    ended = [row for row in rows if row.ended and row.error is not None]
    if not ended:
        return "no run reached its end with an error"
    errors = [row.error for row in ended if not row.below_reference and row.error]
    what = "steps" if rows[0].step is not None else "tolerances"
    if not errors:
        return "all of its errors are below that of the reference"
    if error < min(errors):
        finest = any(row.below_reference for row in ended)
        more = "finer ones are below the error of the reference" if finest else f"finer {what} reach it"
        return f"its smallest error is {min(errors):.2g} m; {more}"
    return f"its largest error is {max(errors):.2g} m; coarser {what} reach it"


def _times_of_line(
    rows: Sequence[Row], own: Sequence[int], seconds: Sequence[float | None], error: float
) -> float | None:
    points = []
    for i in own:
        e, t = rows[i].error, seconds[i]
        if rows[i].ended and not rows[i].below_reference and e and t:
            points.append((e, t))
    return time_at_error(points, error)


def _quartiles_of_values(values: Sequence[float]) -> tuple[float, float, float] | tuple[None, None, None]:
    if not values:
        return None, None, None
    low, middle, high = np.percentile(values, [25.0, 50.0, 75.0]).tolist()
    return middle, low, high


def pareto_front(rows: Sequence[Row], finest: float) -> frozenset[int]:
    """Return the indices of the rows on the Pareto front of error and run time.

    Parameters
    ----------
    rows : sequence of Row
        Rows of a study; those that did not reach the end take no part.
    finest : float
        Error of the reference [m]: smaller ones are alike.
    """
    floor = finest if math.isfinite(finest) else 0.0
    points = [(r.run_seconds, max(r.error, floor), i) for i, r in enumerate(rows) if r.ended and r.error is not None]
    chosen, least = set[int](), math.inf
    for _, error, i in sorted(points):
        if error < least:
            chosen.add(i)
            least = error
    return frozenset(chosen)
