"""Findings of a stress study as plain sentences: computed, never written by hand."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from typing import TYPE_CHECKING

from symgen.base.errors import enumeration, plural
from symgen.run.planning.automatic import AUTO
from symgen.study.stress.beside import beside_yardstick
from symgen.study.stress.cell_outcome import ACCURATE, GOOD, OUTCOMES, REFUSED, UNJUDGED, WRONG_BRANCH, count_outcomes
from symgen.study.stress.stress_rows import Map, map_rows, plane_rows, shares_of_models

if TYPE_CHECKING:
    from symgen.study.stress.stress_rows import Stress, StressRow

#: Methods that hold constraints by forces, and only approximately.
YIELDING = ("penalty", "compliant-constraints", "augmented-lagrangian", "augmented-hamiltonian")
#: Errors of relative tolerances are up to this share of a link's length.
LONG = 1e-6
#: A run with larger violations |Phi| is within its limit, 1e-6, only because the largest coordinate is so large.
OPEN = 1e-4


def findings_of_study(study: Stress) -> tuple[str, ...]:
    """Return a study's findings: counts, the toughest methods, each family, gains and penalties, steps, and trust."""
    shown = Map.of_study(study)
    pairs, count = _shares_of_common_cells(shown)
    return (
        *_count_outcomes(study),
        *_finding_on_underived(study),
        *_finding_on_extremes("models", shares_of_models(study.rows)),
        *_finding_on_extremes(f"pairs of method and integrator, of the {count} that most of them have", pairs),
        *_finding_beside(study),
        *_finding_on_families(shown),
        *_finding_on_gains(study),
        *gain_law(study),
        *_finding_on_penalties(study),
        *_finding_on_steps(study),
        *_finding_on_trust(study),
    )


def _count_outcomes(study: Stress) -> Iterator[str]:
    rows = map_rows(study.rows)
    if not rows:
        return
    planes = len(study.rows) - len(rows)
    beside = f", beside {planes} cells of planes" if planes else ""
    yield f"Of {plural(len(rows), 'cell')} of the map {_outcomes_in_words(rows)}{beside}."
    if study.unusable:
        cases = [f"{family} {case} on {model}" for model, family, case, _ in study.unusable[:3]]
        cases += ["..."] * (len(study.unusable) > len(cases))
        yield (
            f"{_most_of(len(study.unusable), 'case')} could not be judged for want of a reference: {', '.join(cases)}."
        )


def _finding_on_underived(study: Stress) -> Iterator[str]:
    for model, what in study.underived:
        yield (
            f"Cells of {model} are judged by two runs in different formulations at tight tolerances, as there is no "
            f"second derivation of {what}."
        )


def _finding_on_extremes(what: str, cells: Iterable[tuple[str, int, int]]) -> Iterator[str]:
    """Yield the largest and the smallest share of accurate cells, of (name, accurate, judged)."""
    shares = {name: (good / judged, f"{good} of {judged}") for name, good, judged in cells if judged}
    if len(shares) > 1:
        ends = dict.fromkeys(end(share for share, _ in shares.values()) for end in (max, min))
        alike = [[name for name, (share, _) in shares.items() if share == end] for end in ends]
        both = "; fewest: ".join(f"{_first_with_others(names)} ({shares[names[0]][1]})" for names in alike)
        yield f"Most accurate cells among {what}: {both}."


def _finding_on_families(shown: Map) -> Iterator[str]:
    for family in shown.families:
        entries = {line: shown.entry(line, family) for line in shown.lines}
        entries = {line: entry for line, entry in entries.items() if entry.judged}
        if not entries:
            continue
        whole = [_line_of_finding(line) for line, entry in entries.items() if entry.good == entry.judged]
        if len(whole) == len(entries):
            yield (
                f"{_title_of_case(family)}: accurate in every case that was judged with every pair of method "
                "and integrator."
            )
            continue
        which = f" ({'; '.join(whole)})" if 0 < len(whole) <= 4 else ""
        rows = [row for entry in entries.values() for row in entry.rows if row.outcome not in (REFUSED, UNJUDGED)]
        share = f"{len(whole)} of {len(entries)} pairs are accurate in every case that was judged{which}"
        yield f"{_title_of_case(family)}: {share}; hardest: {_hardest_cases(rows)}."


def _shares_of_common_cells(shown: Map) -> tuple[list[tuple[str, int, int]], int]:
    """Return (name, accurate, judged) over the cells that most lines have, of the lines that have all of these.

    Shares of other cells are not compared: whoever ran one easy case has all of them.
    """
    judged = {
        line: {(r.model, r.family, r.case): r for r in shown.entry(line).rows if r.outcome not in (REFUSED, UNJUDGED)}
        for line in shown.lines
    }
    counts = Counter(key for rows in judged.values() for key in rows)
    common = [key for key, count in counts.items() if 2 * count > len(judged)]
    whole = {line: [rows[key] for key in common] for line, rows in judged.items() if all(key in rows for key in common)}
    pairs = [(_line_of_finding(x), sum(r.outcome == GOOD for r in rows), len(common)) for x, rows in whole.items()]
    return pairs, len(common)


def _finding_beside(study: Stress) -> Iterator[str]:
    """Yield how many methods differ beside `lagrange` with the same integrator."""
    lines = beside_yardstick(study)
    for integrator in dict.fromkeys(line.integrator for line in lines):
        own = [line for line in lines if line.integrator == integrator]
        count = sum(len(line.methods) for line in own)
        if count > 1:
            yield (
                f"With {integrator} {len(own)} of {count} methods differ in their errors beside lagrange or in their "
                "largest steps."
            )


def _hardest_cases(rows: Sequence[StressRow]) -> str:
    """Return the case that spoils most runs, with their outcomes."""
    cases: dict[str, list[StressRow]] = {}
    for row in rows:
        cases.setdefault(row.case if row.model == "-" else f"{row.case} on {row.model}", []).append(row)
    shares = {case: sum(row.outcome != GOOD for row in own) / len(own) for case, own in cases.items()}
    worst = [case for case, share in shares.items() if share == max(shares.values())]
    return f"{_first_with_others(worst)}, {_outcomes_in_words(cases[worst[0]])}"


# -- gains, penalties, steps -------------------------------------------------------------------------------------------


def largest_root(alpha: float, beta: float) -> float:
    """Return the modulus of the larger root of s^2 + 2 alpha s + beta^2 [1/s]."""
    inside = alpha * alpha - beta * beta
    return alpha + math.sqrt(inside) if inside >= 0.0 else beta


def _finding_on_gains(study: Stress) -> Iterator[str]:
    """Yield the limit of accurate Baumgarte gains, for real roots: the end of the region on the real axis."""
    reaches: dict[str, dict[bool, list[float]]] = {}
    for row in plane_rows(study.rows, "alpha-beta"):
        if row.step is not None and row.outcome != UNJUDGED and row.values[0] >= row.values[1] * (1.0 - 1e-12):
            own = reaches.setdefault(row.model, {True: [], False: []})
            own[row.outcome == GOOD].append(largest_root(*row.values) * row.step)
    firsts = [min(own[False]) for own in reaches.values() if own[True] and own[False]]
    if firsts:
        span = " to ".join(dict.fromkeys(f"{x:.3g}" for x in (min(firsts), max(firsts))))
        on = _most_of(len(firsts), "model")
        yield (
            f"Baumgarte's gains on {on}: with real roots the first cell that is not accurate has |root| h = {span}; "
            "rk4 is stable up to 2.785."
        )


def gain_law(study: Stress) -> Iterator[str]:
    """Yield the gain of least violation in units of the motion's rate r, and the slopes of both branches."""
    rows = [row for row in study.rows if row.family == "gain" and row.position_violation_max]
    for model in dict.fromkeys(row.model for row in rows):
        points = sorted((row.values[0], row.position_violation_max or 0.0) for row in rows if row.model == model)
        gain, least = min(points, key=lambda point: point[1])
        below = fitted_slope([(x, y) for x, y in points if x <= gain / 2.0])
        above = fitted_slope([(x, y) for x, y in points if x >= 2.0 * gain])
        slopes = [f"{x:.2g} {side}" for x, side in ((below, "below"), (above, "above")) if x is not None]
        law = f", slopes of log |Phi| {' and '.join(slopes)}" if slopes else ""
        yield f"Baumgarte's gains on {model} with rk4: least |Phi| {least:.1e} m at {gain:.2g} r{law}."


def fitted_slope(points: Sequence[tuple[float, float]]) -> float | None:
    """Return the slope of log y over log x, fitted; None for fewer than three points."""
    if len(points) < 3:
        return None
    x, y = ([math.log(point[k]) for point in points] for k in (0, 1))
    middle = math.fsum(x) / len(x), math.fsum(y) / len(y)
    square = math.fsum((a - middle[0]) ** 2 for a in x)
    return math.fsum((a - middle[0]) * (b - middle[1]) for a, b in zip(x, y, strict=True)) / square


def _finding_on_penalties(study: Stress) -> Iterator[str]:
    rows = [row for row in study.rows if row.family == "penalty-factor" and row.outcome not in (UNJUDGED, REFUSED)]
    alike = dict[str, list[str]]()
    for line in dict.fromkeys((row.method, row.integrator) for row in rows):
        own = [row for row in rows if (row.method, row.integrator) == line]
        runs = Counter(row.values[0] for row in own)
        good = Counter(row.values[0] for row in own if row.outcome == GOOD)
        shares = {a: good[a] / runs[a] for a in sorted(runs)}
        best = [a for a, share in shares.items() if share == max(shares.values())]
        cells = f"{good[best[0]]} of {runs[best[0]]} cells" if max(shares.values()) < 1.0 else "all cells"
        text = f"accurate most often with a = {enumeration([f'{a:g}' for a in best])}, in {cells}"
        if len(best) == len(shares) > 1:
            text = f"the factor makes no difference from {best[0]:g} to {best[-1]:g}, in {cells}"
        alike.setdefault(text, []).append(_line_of_finding(line))
    yield from (f"Penalty of {enumeration(lines)}: {text}." for text, lines in alike.items())


def _finding_on_steps(study: Stress) -> Iterator[str]:
    """Yield the pairs with the largest stable steps in a family, each with the number of cases in which it has one."""
    families: dict[str, dict[tuple[str, str], list[tuple[float, str]]]] = {}
    for x in study.limits:
        steps = families.setdefault(x.family, {}).setdefault((x.model, x.case), [])
        if x.stable_step is not None:
            steps.append((x.stable_step, _line_of_finding((x.method, x.integrator))))
    for family, cases in families.items():
        several = [steps for steps in cases.values() if len(steps) > 1]
        if several:
            lines = Counter(line for steps in several for step, line in steps if step == max(steps)[0])
            parts = [f"{line} in {count}" for line, count in lines.most_common()]
            yield f"Largest stable steps in {family}, of {_most_of(len(several), 'case')}: {enumeration(parts)}."


# -- can a status be trusted? ------------------------------------------------------------------------------------------


def _finding_on_trust(study: Stress) -> Iterator[str]:
    wrong = study.false_successes
    methods = {row.method for row in study.rows}
    if AUTO in methods:
        own = [row for row in wrong if row.method == AUTO]
        total = sum(row.method == AUTO for row in study.rows)
        cells = _most_of(len(own), "cell") if own else "no cell"
        yield f"auto reports success with an error above {ACCURATE:g} of the length in {cells} of {total}."
    others = [row for row in wrong if row.method != AUTO]
    watched = [row for row in study.rows if row.method != AUTO and row.watched]
    if not watched:
        return
    causes = "; ".join(f"{count} because {why}" for why, count in Counter(map(cause_of_failure, others)).most_common())
    left = f", in {sum(row.verified_falsely for row in others)} of these with --verify too: {causes}"
    cells = f"in {len(others)} of {len(watched)} cells" + (left if others else "")
    yield f"Methods chosen by name report success with an error above {ACCURATE:g} of the length {cells}."


def cause_of_failure(row: StressRow) -> str:
    """Return the reason in words why a run can report ok although its error is large."""
    if row.outcome == WRONG_BRANCH:
        return "another branch was taken at a singular position, where constraints are closed and energy is kept"
    if row.method in YIELDING and (row.position_violation_max or 0.0) > 1e-9:
        return "the penalty lets the joints give, within max_violation"
    if row.family == "length-ratio" and row.error is not None and row.error <= LONG * row.values[0]:
        return f"tolerances are relative, and 1e-3 m is little on links of {row.values[0]:g} m"
    if (row.position_violation_max or 0.0) > OPEN:
        return "violations are measured by the largest coordinate, and angles of many turns are large"
    if row.step is not None:
        return "nothing estimates the error of a constant step, and constraints and energy stay within their limits"
    if row.family == "singular-passage":
        return "the tolerance is kept for each step, and a passage near a singular position multiplies what is left"
    return "the tolerance is kept for each step, and the errors of many steps add up"


def explain_failures(row: StressRow) -> str:
    """Return the explanation of a false success as a sentence."""
    error = "not finite" if row.error is None else f"{row.error:.2g} m"
    return (
        f"{_line_of_finding((row.method, row.integrator))}, {row.family} {row.case}: error {error}; "
        f"{cause_of_failure(row)}."
    )


# -- words -------------------------------------------------------------------------------------------------------------


def _line_of_finding(line: tuple[str, str]) -> str:
    return line[0] if line[0] == AUTO else f"{line[0]} with {line[1]}"


def _title_of_case(family: str) -> str:
    return family.replace("-", " ").capitalize()


def _first_with_others(names: Sequence[str]) -> str:
    """Return the first of some names, and the number of the others."""
    return names[0] if len(names) == 1 else f"{names[0]} and {_most_of(len(names) - 1, 'other')}"


def _outcomes_in_words(rows: Sequence[StressRow]) -> str:
    numbers = count_outcomes([row.outcome for row in rows])
    return enumeration([f"{numbers[name]} {name}" for name in OUTCOMES if numbers[name]])


def _most_of(count: int, thing: str) -> str:
    return f"{count} {thing}{'' if count == 1 else 's'}"
