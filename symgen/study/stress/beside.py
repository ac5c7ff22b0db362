"""Methods beside `lagrange` with the same integrator: what a stress study says of methods and not of a scheme.

Whether a run of an explicit scheme ends well at a stiff case is decided by the scheme, so that outcomes of most methods
are alike. Beside the same scheme without a correction errors tell them apart, and so do the largest steps.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from statistics import median
from typing import TYPE_CHECKING

from symgen.study.stress.cell_outcome import GOOD, INACCURATE
from symgen.study.stress.stress_rows import Map
from symgen.study.yardstick import YARDSTICK

if TYPE_CHECKING:
    from symgen.study.stress.stress_rows import ExtremeReached, Stress, StressRow

#: Ratios that differ by less than this digit are one.
DIGITS = 2


@dataclass(frozen=True)
class LineBeside:
    """Methods with the same numbers, on one integrator.

    Attributes
    ----------
    methods : tuple of str
        Their names.
    integrator : str
        The integrator.
    ratios : mapping of str to (float or None)
        By family: median over its cases of the error of the yardstick over the error of the method, above 1 where the
        method is better; None where no case resolves both.
    reached : mapping of str to float
        By family with a search: largest constant step that follows the motion [s].
    extremes : mapping of str to float
        By family with an extreme: largest value up to which all runs are accurate.
    """

    methods: tuple[str, ...]
    integrator: str
    ratios: dict[str, float | None]
    reached: dict[str, float | None]
    extremes: dict[str, float | None]


def beside_yardstick(study: Stress) -> tuple[LineBeside, ...]:
    """Return all methods beside `lagrange`, those with the same numbers as one; none without `lagrange`."""
    shown = Map.of_study(study)
    groups: dict[tuple[str, ...], list[str]] = {}
    numbers: dict[tuple[str, ...], tuple[dict[str, float | None], ...]] = {}
    bases = {(row.integrator, row.model, row.family, row.case): row for row in shown.rows if row.method == YARDSTICK}
    with_base = {key[0] for key in bases}
    for method, integrator in shown.lines:
        if integrator not in with_base:
            continue
        rows = shown.entry((method, integrator)).rows
        ratios = {family: _median_of(_ratios(rows, family, bases)) for family in shown.families}
        own = [x for x in study.limits if (x.method, x.integrator) == (method, integrator)]
        reached = {family: _median_of(_steps(own, family)) for family in dict.fromkeys(x.family for x in own)}
        ends = [x for x in study.extremes if (x.method, x.integrator) == (method, integrator)]
        extremes = {family: _median_of(_values(ends, family)) for family in dict.fromkeys(x.family for x in ends)}
        numbers_of_method = ratios, reached, extremes
        key = (integrator, *(_text(x) for each in numbers_of_method for x in each.values()))
        groups.setdefault(key, []).append(method)
        numbers[key] = numbers_of_method
    return tuple(LineBeside(tuple(names), key[0], *numbers[key]) for key, names in groups.items())


def _ratios(
    rows: Sequence[StressRow], family: str, bases: dict[tuple[str, str, str, str], StressRow]
) -> Iterator[float]:
    """Yield the ratios of errors of cases that the reference resolves and both runs followed."""
    for row in rows:
        base = bases.get((row.integrator, row.model, row.family, row.case))
        if row.family != family or base is None:
            continue
        floor = row.reference_error or 0.0
        followed = {row.outcome, base.outcome} <= {GOOD, INACCURATE}
        if followed and row.error and base.error and min(row.error, base.error) > floor:
            yield base.error / row.error


def _steps(limits: Sequence[object], family: str) -> Iterator[float]:
    for limit in limits:
        step = getattr(limit, "stable_step", None)
        if getattr(limit, "family", "") == family and step is not None:
            yield float(step)


def _values(extremes: Sequence[ExtremeReached], family: str) -> Iterator[float]:
    for extreme in extremes:
        if extreme.family == family and extreme.reached is not None:
            yield extreme.reached


def _median_of(values: Iterator[float]) -> float | None:
    known = list(values)
    return median(known) if known else None


def _text(value: float | None) -> str:
    return "" if value is None else f"{value:.{DIGITS}g}"


def cells_beside(
    line: LineBeside, families: Sequence[str], searched: Sequence[str], extremes: Sequence[str] = ()
) -> tuple[str, ...]:
    """Return the cells of a line: ratios by family, largest steps, and extreme values."""
    return (
        *(_text(line.ratios.get(family)) for family in families),
        *(_text(line.reached.get(family)) for family in searched),
        *(_text(line.extremes.get(family)) for family in extremes),
    )


def families_beside(lines: Sequence[LineBeside]) -> tuple[list[str], list[str]]:
    """Return the families in which a ratio is other than 1 for some line, and those with searches."""
    names = list(dict.fromkeys(family for line in lines for family in line.ratios))
    telling = [x for x in names if {_text(line.ratios[x]) for line in lines if x in line.ratios} - {"", "1"}]
    return telling, list(dict.fromkeys(family for line in lines for family in line.reached))


def extremes_beside(lines: Sequence[LineBeside]) -> list[str]:
    """Return the families whose extreme values differ between lines."""
    names = dict.fromkeys(family for line in lines for family in line.extremes)
    return [x for x in names if len({_text(line.extremes[x]) for line in lines if x in line.extremes}) > 1]
