"""Which rows of a study stand for its methods where one row a method is shown."""

from __future__ import annotations

import math

from symgen.study.comparison.comparison_rows import Row, Study, Trace

#: The integrator and the step of the source, by which methods are compared where they have it.
USUAL = "rk4"


def methods(study: Study) -> list[str]:
    """Return the methods of a study in order."""
    return list(dict.fromkeys(row.label for row in study.rows))


def line_number(method: str) -> int:
    """Return a number of a method for its line style: the same in every report."""
    from symgen.methods import METHODS
    from symgen.study.comparison.combinations import DEFAULT_METHODS

    others = [name for name in METHODS.names if name not in DEFAULT_METHODS]
    known = [*DEFAULT_METHODS, *others]
    return known.index(method) if method in known else len(known)


def _closeness(row: Row, step: float) -> float:
    """Return how far a row is from the mechanism's own step, or from the middle of the usual tolerances."""
    return abs(math.log(row.step / step)) if row.step is not None else abs(math.log10((row.rtol or 1.0) / 1e-8))


def representatives(study: Study) -> list[tuple[Row, Trace]]:
    """Return one row a method: with the usual integrator where it was run, at the step nearest to the mechanism's."""
    found = []
    for method in methods(study):
        own = [(row, trace) for row, trace in zip(study.rows, study.traces, strict=True) if row.label == method]
        usual = [pair for pair in own if pair[0].integrator == USUAL]
        first = [pair for pair in own if pair[0].integrator == own[0][0].integrator]
        found.append(min(usual or first, key=lambda pair: _closeness(pair[0], study.step)))
    return found


def most_accurate(study: Study) -> tuple[Row, Trace] | None:
    """Return the run with the smallest error that may be believed; the first that ended where errors are unknown."""
    pairs = [(row, trace) for row, trace in zip(study.rows, study.traces, strict=True) if row.ended]
    known = [pair for pair in pairs if pair[0].error is not None]
    return min(known, key=lambda pair: pair[0].error or 0.0) if known else pairs[0] if pairs else None


def settings_text(study: Study) -> str:
    """Return the setting that representatives share, in words, or what they have in common."""
    rows = [row for row, _ in representatives(study)]
    most = max({row.setting for row in rows}, key=[row.setting for row in rows].count)
    integrator, step, rtol = most
    from symgen.report.words import setting

    text = f"{integrator}, {setting(step, rtol)}"
    others = [f"{row.label} ({row.integrator}, {setting(row.step, row.rtol)})" for row in rows if row.setting != most]
    return text + (f"; {', '.join(others)}" if others else "")
