"""One statistic over several mechanisms: errors and run times of methods beside `lagrange`."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from statistics import median

from symgen.study.comparison.comparison_rows import Row
from symgen.study.comparison.comparison_study import Study
from symgen.study.comparison.turns import interval_of_median
from symgen.study.yardstick import YARDSTICK


@dataclass(frozen=True)
class Across:
    """A method over the mechanisms of a comparison.

    Attributes
    ----------
    method : str
        Label of the method.
    integrator : str
        Its integrator.
    mechanisms, settings : int
        Number of mechanisms, and of pairs of a row and its yardstick: each step or tolerance counts.
    error, error_low, error_high, error_mean : float or None
        Error of the yardstick over the error of the method at constant steps, above 1 where the method is better: the
        median over the mechanisms, each by the median of its settings, an interval that holds it with 95 % (the range
        of fewer than six mechanisms), and the geometric mean.
    time, time_low, time_high, time_mean : float or None
        The same of the cost ratio: below 1 where the method is faster at an equal step or tolerance.
    """

    method: str
    integrator: str
    mechanisms: int
    settings: int
    error: float | None = None
    error_low: float | None = None
    error_high: float | None = None
    error_mean: float | None = None
    time: float | None = None
    time_low: float | None = None
    time_high: float | None = None
    time_mean: float | None = None


def across_mechanisms(studies: Sequence[Study]) -> tuple[Across, ...]:
    """Return the statistic of every method with every integrator but of the yardstick's own; empty for one study."""
    if len(studies) < 2:
        return ()
    lines = dict.fromkeys((row.label, row.integrator) for study in studies for row in study.rows)
    found = []
    for label, integrator in lines:
        if label == YARDSTICK:
            continue
        errors, times, settings = list[float](), list[float](), 0
        for study in studies:
            base = {row.setting: row for row in study.rows if row.label == YARDSTICK}
            own = [row for row in study.rows if (row.label, row.integrator) == (label, integrator)]
            gains = [x for row in own if (x := _gain(row, base.get(row.setting))) is not None]
            costs = [row.cost_ratio for row in own if row.cost_ratio is not None]
            settings += len(costs)
            errors += [median(gains)] if gains else []
            times += [median(costs)] if costs else []
        if times:
            found.append(Across(label, integrator, len(times), settings, *_summary(errors), *_summary(times)))
    return tuple(found)


def _gain(row: Row, base: Row | None) -> float | None:
    """Return the error of the yardstick over the error of a row.

    None where the reference does not resolve them, and for adaptive runs: at one tolerance the method that makes the
    controller take shorter steps has the smaller error.
    """
    if (
        base is None
        or row.step is None
        or not row.error
        or not base.error
        or row.below_reference
        or base.below_reference
    ):
        return None
    return base.error / row.error


def _summary(values: Sequence[float]) -> tuple[float | None, ...]:
    if not values:
        return (None,) * 4
    low, high = interval_of_median(values)
    return median(values), low, high, math.exp(sum(map(math.log, values)) / len(values))
