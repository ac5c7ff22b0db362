"""Findings of a comparison as sentences computed from its rows, and the rows that represent its methods."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from statistics import median

from symgen.base.errors import enumeration
from symgen.result.result import FAILED, OK, UNVERIFIED
from symgen.study.comparison.comparison_rows import Row, Trace
from symgen.study.comparison.comparison_study import Study
from symgen.study.report import words
from symgen.study.yardstick import YARDSTICK

#: The integrator and the step of the source, used to compare methods that were run with them.
USUAL = "rk4"
#: An error above this in a run that ended ok is a false success [m].
WRONG = 1e-3
#: Errors for which the cheapest run is named [m].
TARGETS = (1e-3, 1e-6, 1e-9)
#: A violation below this is rounding, times the lengths and speeds of usual mechanisms.
ROUNDING = 1e-11
#: Number of methods named at either end of a long list.
MOST = 4
#: Slopes are fitted over errors above this multiple of the reference's own.
CLEAR = 10.0


def methods_of_study(study: Study) -> list[str]:
    """Return the methods of a study in order."""
    return list(dict.fromkeys(row.label for row in study.rows))


def line_number(method: str) -> int:
    """Return a number of a method for its line style: the same in every report."""
    from symgen.derive.methods import METHODS
    from symgen.study.comparison.combinations import DEFAULT_METHODS

    others = [name for name in METHODS.names if name not in DEFAULT_METHODS]
    order = [*DEFAULT_METHODS, *others]
    return order.index(method) if method in order else len(order)


def _distance_from_own_step(row: Row, step: float) -> float:
    """Return the distance of a row from the mechanism's own step, or from the middle of the usual tolerances."""
    return abs(math.log(row.step / step)) if row.step is not None else abs(math.log10((row.rtol or 1.0) / 1e-8))


def representative_rows(study: Study) -> list[tuple[Row, Trace]]:
    """Return one row per method: with the usual integrator if run, at the step nearest to the mechanism's."""
    pairs = []
    for method in methods_of_study(study):
        own = [(row, trace) for row, trace in zip(study.rows, study.traces, strict=True) if row.label == method]
        usual = [pair for pair in own if pair[0].integrator == USUAL]
        first = [pair for pair in own if pair[0].integrator == own[0][0].integrator]
        pairs.append(min(usual or first, key=lambda pair: _distance_from_own_step(pair[0], study.step)))
    return pairs


def settings_text(study: Study) -> str:
    """Return the setting of the representatives in words, or the common part."""
    rows = [row for row, _ in representative_rows(study)]
    most = max({row.setting for row in rows}, key=[row.setting for row in rows].count)
    settings = [f"{row.integrator}, {words.setting_in_words(row.step, row.rtol)}" for row in rows]
    shared = next(text for row, text in zip(rows, settings, strict=True) if row.setting == most)
    others = [f"{row.label} ({text})" for row, text in zip(rows, settings, strict=True) if row.setting != most]
    return "; ".join([shared, *([", ".join(others)] if others else [])])


def findings_of_rows(study: Study) -> tuple[str, ...]:
    """Return the findings of the rows, most important first; those without numbers are left out."""
    sentences = [
        _finding_on_reference(study),
        _finding_on_cheapest(study),
        _finding_on_best(study),
        *_finding_on_statuses(study),
        _finding_on_wrong(study),
        _finding_on_violations(study),
        _finding_on_energy(study),
        _finding_on_costs(study),
        _finding_on_orders(study),
        _finding_on_spread(study),
    ]
    return tuple(words.as_sentence(text) for text in sentences if text)


def _name_of_row(row: Row) -> str:
    return f"{row.label} with {row.integrator} at {words.setting_in_words(row.step, row.rtol)}"


def _finding_on_reference(study: Study) -> str:
    if study.how == "none":
        return words.readable_number(study.note)
    marked = sum(row.below_reference for row in study.rows)
    text = (
        f"errors are distances to a reference motion ({words.readable_number(study.how)}), which may "
        "itself be off by about "
        f"{words.rounded_number(study.estimated_error)} m"
    )
    if marked:
        lie = words.plural(marked, "row lies", "rows lie")
        text += f"; {lie} below that (marked *), beyond what the reference resolves"
    return f"{text}. Note: {words.readable_number(study.note)}" if study.note else text


def _trusted_rows(study: Study) -> list[Row]:
    """Return the rows that ended ok and have an error."""
    return [row for row in study.rows if row.status == OK and row.error is not None]


def _finding_on_cheapest(study: Study) -> str:
    rows, parts = _trusted_rows(study), list[str]()
    for target in TARGETS:
        good = sorted((r for r in rows if (r.error or 0.0) < target), key=lambda r: r.run_seconds)
        if not good or study.estimated_error > target or (parts and len(good) == len(rows)):
            continue
        best = good[0]
        text = (
            f"below {words.chosen_number(target)} m, {_name_of_row(best)} ({words.seconds_in_words(best.run_seconds)}"
        )
        other = next((r for r in good if r.label != best.label), None)
        if other is not None:
            times = words.ratio_in_words(other.run_seconds / best.run_seconds)
            text += f"; the next method, {other.label}, takes {times} times that"
        parts.append(text + ")")
    return f"cheapest runs that ended ok, by their error: {'; '.join(parts)}" if parts else ""


def _finding_on_best(study: Study) -> str:
    rows = _trusted_rows(study)
    if not rows:
        return ""
    best = min(rows, key=lambda r: r.error or 0.0)
    limit = max(best.error or 0.0, study.estimated_error)
    alike = sum((r.error or 0.0) <= limit for r in rows)
    text = f"the smallest error, {words.rounded_number(best.error)} m, is that of {_name_of_row(best)}"
    if alike > 1:
        text += f"; {alike} runs are as accurate as the reference can show"
    return text


def _finding_on_statuses(study: Study) -> list[str]:
    by_status = {s: [r for r in study.rows if r.status == s] for s in (OK, UNVERIFIED, FAILED)}
    text = f"of {words.plural(len(study.rows), 'run')} {len(by_status[OK])} ended ok"
    for status, what in ((UNVERIFIED, "unverified"), (FAILED, "failed")):
        text += f", {len(by_status[status])} {what}" if by_status[status] else ""
    if study.interrupted:
        text += "; the study was interrupted, so rows are missing"
    sentences = [text]
    for status, one, many in ((FAILED, "failed", "failed"), (UNVERIFIED, "is unverified", "are unverified")):
        reasons: dict[str, list[Row]] = {}
        for row in by_status[status]:
            # the same reason at another time or with other numbers is the same
            reasons.setdefault((row.reason or "").split(" at t = ")[0].split(" (")[0], []).append(row)
        for rows in reasons.values():
            first = f"{_name_of_row(rows[0])}: {words.readable_number(rows[0].reason or '')}"
            if len(rows) == 1:
                sentences.append(f"1 run {one}: {first}")
            else:
                each = enumeration([f"{m} ({n})" for m, n in _counts_by_name(r.label for r in rows)])
                sentences.append(f"{len(rows)} runs {many} for one reason: {each}; e.g. {first}")
    return sentences


def _counts_by_name(names: Iterable[str]) -> list[tuple[str, int]]:
    every = list(names)
    return [(name, every.count(name)) for name in dict.fromkeys(every)]


def _finding_on_wrong(study: Study) -> str:
    rows = [r for r in study.rows if r.status == OK and r.error is not None and r.error > WRONG]
    if not _trusted_rows(study):
        return ""
    if not rows:
        return f"no run that ended ok is off by more than {words.chosen_number(WRONG)} m"
    worst = max(rows, key=lambda r: r.error or 0.0)
    count = words.plural(len(rows), "run")
    each = enumeration([f"{m} ({n})" for m, n in _counts_by_name(r.label for r in rows)])
    return (
        f"{count} ended ok although off by more than {words.chosen_number(WRONG)} m, as steps or tolerances were too "
        f"coarse or another branch was taken: {each}; the worst is {_name_of_row(worst)}, "
        f"{words.rounded_number(worst.error)} m"
    )


def _methods_at_rounding(study: Study, values: dict[str, float], unit: str) -> str:
    """Return the methods that keep a quantity at rounding, and the values of the others."""
    small = [m for m, x in values.items() if x < ROUNDING]
    large = sorted(((x, m) for m, x in values.items() if x >= ROUNDING), reverse=True)
    parts = []
    if small:
        parts.append(f"below {words.chosen_number(ROUNDING)} with {enumeration(small)}")
    if large:
        rest = f" and less with {words.plural(len(large) - MOST, 'other')}" if len(large) > MOST else ""
        parts.append(", ".join(f"{words.rounded_number(x)} {unit} with {m}" for x, m in large[:MOST]) + rest)
    return "; ".join(parts)


def _finding_on_violations(study: Study) -> str:
    rows = [row for row, _ in representative_rows(study) if row.ended]
    values = {r.label: r.position_violation_max for r in rows if math.isfinite(r.position_violation_max)}
    if not values:
        return ""
    return f"largest position violation ({settings_text(study)}): {_methods_at_rounding(study, values, 'm')}"


def _finding_on_energy(study: Study) -> str:
    rows = [row for row, _ in representative_rows(study) if row.ended and math.isfinite(row.energy_drift_max)]
    if len(rows) < 2:
        return ""
    low = min(rows, key=lambda r: r.energy_drift_max)
    high = max(rows, key=lambda r: r.energy_drift_max)
    if words.rounded_number(low.energy_drift_max) == words.rounded_number(high.energy_drift_max):
        return (
            f"largest energy error at the same settings: {words.rounded_number(low.energy_drift_max)} J with "
            "every method"
        )
    return (
        f"largest energy error at the same settings: from {words.rounded_number(low.energy_drift_max)} J "
        f"with {low.label} to "
        f"{words.rounded_number(high.energy_drift_max)} J with {high.label}"
    )


def costs_of_methods(study: Study) -> list[tuple[str, float, float, float, int]]:
    """Return method, median, smallest and largest cost ratio, and their number, for all but the yardstick."""
    ratios_of_methods = []
    for method in methods_of_study(study):
        ratios = [r.cost_ratio for r in study.rows if r.label == method and r.cost_ratio is not None]
        if ratios and method != YARDSTICK:
            ratios_of_methods.append((method, median(ratios), min(ratios), max(ratios), len(ratios)))
    return ratios_of_methods


def _finding_on_costs(study: Study) -> str:
    medians = sorted(costs_of_methods(study), key=lambda c: c[1])
    if not medians:
        return ""
    parts = [f"{method} {words.ratio_in_words(middle)}" for method, middle, *_ in medians]
    if len(parts) > 2 * MOST:
        parts = [*parts[:MOST], "...", *parts[-MOST:]]
    listed = enumeration(parts)
    return f"run time as a multiple of that of {YARDSTICK} at the same integrator and step, medians: {listed}"


def observed_order(rows: Sequence[Row], estimated: float) -> float | None:
    """Return the slope of error against step, both logarithmic, fitted where errors fall as steps do.

    Errors near the reference's own are left out, and those from where a smaller step has no smaller error, which
    rounding has made.
    """
    floor = CLEAR * estimated if math.isfinite(estimated) else 0.0
    good = [(r.step, r.error) for r in rows if r.ended and r.step and r.error and floor < r.error < 0.1]
    good.sort(reverse=True)
    good = good[: next((k for k in range(1, len(good)) if good[k][1] >= good[k - 1][1]), len(good))]
    if len(good) < 2:
        return None
    x, y = [math.log(s) for s, _ in good], [math.log(e) for _, e in good]
    mx, my = sum(x) / len(x), sum(y) / len(y)
    spread = sum((a - mx) ** 2 for a in x)
    return sum((a - mx) * (b - my) for a, b in zip(x, y, strict=True)) / spread if spread > 0.0 else None


def _finding_on_orders(study: Study) -> str:
    parts = []
    for integrator in dict.fromkeys(r.integrator for r in study.rows if r.step is not None):
        slopes = []
        for method in methods_of_study(study):
            own = [r for r in study.rows if (r.label, r.integrator) == (method, integrator)]
            slope = observed_order(own, study.estimated_error)
            if slope is not None:
                slopes.append((slope, method))
        if not slopes:
            continue
        low, high = min(slopes), max(slopes)
        if high[0] - low[0] < 0.1:
            parts.append(f"with {integrator} the error falls with the power {low[0]:.1f} of the step")
        else:
            parts.append(
                f"with {integrator} the error falls with a power of the step from {low[0]:.1f} ({low[1]}) to "
                f"{high[0]:.1f} ({high[1]})"
            )
    return "; ".join(parts)


def _finding_on_spread(study: Study) -> str:
    spreads = study.ratio_spreads
    if spreads is None:
        return ""
    return (
        "made again on the same machine, this study gives the same errors to the last digit; ratios of run time, which "
        f"are of processor time, hold with 95 % within {words.percent_in_words(spreads[0])} in the median row and "
        f"{words.percent_in_words(spreads[1])} in the worst"
    )
