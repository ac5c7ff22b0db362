"""What the rows of a stress study say, as plain sentences: computed, never written by hand."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

from symgen.running.automatic import AUTO
from symgen.study.stress.cell_outcome import ACCURATE, DIVERGED, GOOD, OUTCOMES, REFUSED, UNJUDGED, WRONG_BRANCH, counts
from symgen.study.stress.stress_rows import Map, map_rows, plane_rows, shares_of_models

if TYPE_CHECKING:
    from symgen.study.stress.stress_rows import Limit, Stress, StressRow

#: Methods that hold constraints by forces, and only as closely as these push.
YIELDING = ("penalty", "augmented-lagrangian", "augmented-hamiltonian")
#: Errors up to this share of a link's length are what relative tolerances leave.
LONG = 1e-6
#: A run with larger violations |Phi| is within its limit, 1e-6, only because the largest coordinate is so large.
OPEN = 1e-4
#: Sentences about each model are written for so many models at most; beyond, they are summed up.
FEW_MODELS = 3


def findings(study: Stress) -> tuple[str, ...]:
    """Return what a study found: counts, the toughest methods, each family, gains and penalties, steps, and trust."""
    return tuple(
        [
            *_counted(study),
            *_models(study),
            *_toughest(study),
            *_families(study),
            *_gains(study),
            *_penalties(study),
            *_steps(study),
            *_trust(study),
        ]
    )


def _counted(study: Stress) -> Iterator[str]:
    rows = map_rows(study.rows)
    if not rows:
        return
    found = counts([row.outcome for row in rows])
    parts = [f"{found[name]} {name}" for name in OUTCOMES if found[name]]
    planes = len(study.rows) - len(rows)
    beside = f", beside {planes} cells of planes" if planes else ""
    yield f"Of {len(rows)} cells of the map {_listed(parts)}{beside}."
    if study.unusable:
        several = len(study.models) > 1
        cases = [f"{family} {case}{f' on {model}' * several}" for model, family, case, _ in study.unusable[:3]]
        more = "" if len(study.unusable) <= len(cases) else ", ..."
        many = _many(len(study.unusable), "case")
        yield f"{many} could not be judged for want of a reference: {', '.join(cases)}{more}."


def _models(study: Stress) -> Iterator[str]:
    if len(study.models) <= FEW_MODELS:
        return
    shares = [(good / judged, model, good, judged) for model, good, judged in shares_of_models(study.rows) if judged]
    if len(shares) < 2:
        return
    best, worst = max(s[0] for s in shares), min(s[0] for s in shares)
    if best == worst:
        _, model, good, judged = shares[0]
        yield f"All {len(shares)} models went equally well: {model} with {good} of {judged} cells accurate."
        return
    ends = []
    for share, cells in ((best, " cells accurate"), (worst, "")):
        (_, model, good, judged), *others = [s for s in shares if s[0] == share]
        also = f", as did {_many(len(others), 'other')}" if others else ""
        ends.append((model, f"{good} of {judged}{cells}{also}"))
    yield f"Of the models, {ends[0][0]} went best, {ends[0][1]}, and {ends[1][0]} worst, {ends[1][1]}."


def _toughest(study: Stress) -> Iterator[str]:
    shown = Map.of(study)
    shares = []
    for line in shown.lines:
        entry = shown.entry(line)
        if entry.judged:
            shares.append((entry.good / entry.judged, entry.good, entry.judged, line))
    if len(shares) < 2:
        return
    shares.sort(key=lambda s: -s[0])
    if shares[0][0] == shares[-1][0]:
        _, good, judged, line = shares[0]
        yield f"All {len(shares)} pairs were accurate equally often: {_line(line)} in {good} of {judged} cells."
        return
    for label, (share, good, judged, line) in (("Most", shares[0]), ("Least", shares[-1])):
        others = sum(other == share for other, *_ in shares) - 1
        also = f", as often as {_many(others, 'other pair')}" if others else ""
        yield f"{label} often accurate was {_line(line)}: {good} of {judged} cells{also}."


def _families(study: Stress) -> Iterator[str]:
    shown = Map.of(study)
    for family in shown.families:
        entries = {line: shown.entry(line, family) for line in shown.lines}
        entries = {line: entry for line, entry in entries.items() if entry.judged}
        whole = [line for line, entry in entries.items() if entry.good == entry.judged]
        if not entries:
            continue
        left = any(row.outcome in (REFUSED, UNJUDGED) for row in shown.rows if row.family == family)
        if len(whole) == len(entries):
            of = " that was judged" if left else ""
            yield f"{_title(family)}: accurate in every case{of} with every pair of method and integrator."
            continue
        rows = [row for entry in entries.values() for row in entry.rows if row.outcome not in (REFUSED, UNJUDGED)]
        hardest = _hardest(rows)
        kept = (
            f"{len(whole)} of {len(entries)} pairs stay accurate {'in all that was judged' if left else 'throughout'}"
        )
        if 0 < len(whole) <= 4:
            kept += f" ({'; '.join(_line(line) for line in whole)})"
        yield f"{_title(family)}: {kept}; {hardest}."


def _hardest(rows: Sequence[StressRow]) -> str:
    """Return which case spoils most runs, and how."""
    cases = dict.fromkeys((row.model, row.case) for row in rows)
    shares = {}
    for case in cases:
        own = [row for row in rows if (row.model, row.case) == case]
        shares[case] = sum(row.outcome != GOOD for row in own) / len(own)
    worst = max(shares, key=lambda case: shares[case])
    alike = sum(share == shares[worst] for share in shares.values())
    own = [row for row in rows if (row.model, row.case) == worst]
    found = counts([row.outcome for row in own])
    parts = [f"{found[name]} {name}" for name in OUTCOMES if found[name]]
    where = f"{worst[1]} on {worst[0]}" if len({model for model, _ in cases}) > 1 else worst[1]
    if alike > 1:
        return f"hardest are {alike} cases alike, the first of them {where}: {_listed(parts)}"
    return f"hardest is {where}: {_listed(parts)}"


# -- gains, penalties, steps -------------------------------------------------------------------------------------------


def largest_root(alpha: float, beta: float) -> float:
    """Return the modulus of the larger root of s^2 + 2 alpha s + beta^2 [1/s]."""
    inside = alpha * alpha - beta * beta
    return alpha + math.sqrt(inside) if inside >= 0.0 else beta


def _gains(study: Stress) -> Iterator[str]:
    few = len(study.models) <= FEW_MODELS
    reaches = []
    rows = [r for r in plane_rows(study.rows, "alpha-beta") if r.step is not None and r.outcome != UNJUDGED]
    for model in dict.fromkeys(row.model for row in rows):
        # real roots: only for them is the limit the end of the region of stability on the real axis
        own = [
            (largest_root(*row.values) * (row.step or 0.0), row.outcome == GOOD)
            for row in rows
            if row.model == model and row.values[0] >= row.values[1] * (1.0 - 1e-12)
        ]
        stable, unstable = [x for x, good in own if good], [x for x, good in own if not good]
        if stable and unstable:
            reaches.append((_up_to(stable, unstable), min(unstable)))
        if stable and unstable and few:
            reach = _up_to(stable, unstable)
            below = f"all cells up to |root| h = {reach:.3g} are accurate and the first that is not has"
            first = below if reach else "the cell of the smallest |root| h is not accurate,"
            yield (
                f"Baumgarte's gains on {model}: with real roots {first} {min(unstable):.3g}; rk4 is stable up to 2.785."
            )
    if reaches and not few:
        firsts = [above for _, above in reaches]
        yield (
            f"Baumgarte's gains on {_many(len(reaches), 'model')}: with real roots the first cell that is not accurate "
            f"has |root| h from {min(firsts):.3g} to {max(firsts):.3g}; rk4 is stable up to 2.785."
        )


def _up_to(stable: Sequence[float], unstable: Sequence[float]) -> float:
    """Return the largest stable value below all unstable ones, 0 where there is none."""
    return max((x for x in stable if x < min(unstable)), default=0.0)


def _penalties(study: Stress) -> Iterator[str]:
    rows = [row for row in study.rows if row.family == "penalty-factor" and row.outcome not in (UNJUDGED, REFUSED)]
    if len(study.models) > FEW_MODELS:
        yield from _penalties_of_many(rows, len({r.model for r in study.rows if r.family == "penalty-factor"}))
        return
    for method, integrator, model in dict.fromkeys((row.method, row.integrator, row.model) for row in rows):
        own = [r for r in rows if (r.method, r.integrator, r.model) == (method, integrator, model)]
        if len(own) < 2:
            continue
        # a run that ended early has the error of what it reached
        ended = [row for row in own if row.error is not None and row.outcome != DIVERGED and not row.note]
        best = min(ended, key=lambda row: row.error or 0.0, default=None)
        told = f"; smallest error {best.error:.1e} m at a = {best.values[0]:g}" if best is not None else ""
        yield f"Penalty of {_line((method, integrator))} on {model}: {_span(own)}{told}."


def _span(rows: Sequence[StressRow]) -> str:
    """Return for which factors runs are accurate, those between them that are not named as well."""
    good = sorted(row.values[0] for row in rows if row.outcome == GOOD)
    if not good:
        return "accurate for none of the factors"
    if good[0] == good[-1]:
        return f"accurate for a = {good[0]:g} alone"
    between = sorted(row.values[0] for row in rows if row.outcome != GOOD and good[0] < row.values[0] < good[-1])
    but = f" but not for {_listed([f'{a:g}' for a in between])}" if between else ""
    return f"accurate for a = {good[0]:g} to {good[-1]:g}{but}"


def _penalties_of_many(rows: Sequence[StressRow], models: int) -> Iterator[str]:
    for line in dict.fromkeys((row.method, row.integrator) for row in rows):
        own = [row for row in rows if (row.method, row.integrator) == line]
        factors = sorted({row.values[0] for row in own})
        good = {a: sum(row.outcome == GOOD for row in own if row.values[0] == a) for a in factors}
        tried = {a: sum(row.values[0] == a for row in own) for a in factors}
        everywhere = [a for a in factors if good[a] == tried[a]]
        if everywhere:
            of = "" if all(tried[a] == models for a in everywhere) else " that were judged"
            a = _listed([f"{a:g}" for a in everywhere])
            yield f"Penalty of {_line(line)}: accurate on all models{of} for a = {a}."
        else:
            best = max(factors, key=lambda a: good[a] / tried[a])
            alike = sum(good[a] / tried[a] == good[best] / tried[best] for a in factors) - 1
            also = f", {_many(alike, 'other factor')} as often" if alike else ""
            suits = f"a = {best:g} suits {good[best]} of {tried[best]}{also}"
            yield f"Penalty of {_line(line)}: no factor suits all models; {suits}."


def _steps(study: Stress) -> Iterator[str]:
    largest: dict[str, list[tuple[str, list[tuple[str, str]]]]] = {}
    for model, family, case in dict.fromkeys((x.model, x.family, x.case) for x in study.limits):
        own = [x for x in study.limits if (x.model, x.family, x.case) == (model, family, case)]
        stable = [x for x in own if x.stable_step is not None]
        if len(stable) < 2:
            continue

        def step(limit: Limit) -> float:
            return limit.stable_step or 0.0

        most, least = max(stable, key=step), min(stable, key=step)
        tied = [(x.method, x.integrator) for x in stable if step(x) == step(most)]
        largest.setdefault(family, []).append((model, tied))
        if len(study.models) <= FEW_MODELS:
            ends = [[x for x in stable if step(x) == step(end)] for end in (least, most)]
            span = "from " + " to ".join(f"{step(alike[0]):.3g} s ({_first_of(alike)})" for alike in ends)
            if step(least) == step(most):
                span = f"{step(most):.3g} s with each of {len(stable)} pairs"
            none = len(own) - len(stable)
            without = f"; none was found with {_many(none, 'pair')}" if none else ""
            yield f"Largest steps on {model}, {family} {case}: {span}{without}."
    if len(study.models) > FEW_MODELS:
        for family, winners in largest.items():
            lines = [line for _, tied in winners for line in tied]
            order = sorted(dict.fromkeys(lines), key=lambda line: -lines.count(line))
            parts = [f"{_line(line)} on {lines.count(line)}" for line in order]
            shared = ", those with the same step each" if len(lines) > len(winners) else ""
            single = len({model for model, _ in winners}) == len(winners)
            of = _many(len(winners), "model" if single else "case")
            yield f"Largest stable steps in {family}, of {of}: {_listed(parts)}{shared}."


def _first_of(limits: Sequence[Limit]) -> str:
    """Return the pair of the first of some limits, and how many others have the same."""
    others = f" and {_many(len(limits) - 1, 'other pair')}" if len(limits) > 1 else ""
    return _line((limits[0].method, limits[0].integrator)) + others


# -- can a status be trusted? ------------------------------------------------------------------------------------------


def _trust(study: Stress) -> Iterator[str]:
    wrong = study.false_successes
    methods = {row.method for row in study.rows}
    if AUTO in methods:
        own = [row for row in wrong if row.method == AUTO]
        total = sum(row.method == AUTO for row in study.rows)
        said = "in no cell" if not own else f"in {_many(len(own), 'cell')}"
        yield f"auto reports success with an error above {ACCURATE:g} m {said} of {total}."
    others = [row for row in wrong if row.method != AUTO]
    watched = [row for row in study.rows if row.method != AUTO and row.watched]
    if not watched:
        return
    if not others:
        which = "No other run" if AUTO in methods else "No run"
        yield f"{which} reports success with an error above {ACCURATE:g} m, in {len(watched)} cells."
        return
    share = f"{len(others)} of {len(watched)} cells"
    which, such = (
        ("Other methods", "such an error") if AUTO in methods else ("Methods", f"an error above {ACCURATE:g} m")
    )
    yield f"{which} report success with {such} in {share}: {_reasons(others)}."


def _reasons(rows: Sequence[StressRow]) -> str:
    found: dict[str, int] = {}
    for row in rows:
        why = cause(row)
        found[why] = found.get(why, 0) + 1
    return "; ".join(f"{count} because {why}" for why, count in sorted(found.items(), key=lambda item: -item[1]))


def cause(row: StressRow) -> str:
    """Return in words why a run can say ok although its error is large."""
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


def explained(row: StressRow) -> str:
    """Return the explanation of a false success as a sentence."""
    error = "not finite" if row.error is None else f"{row.error:.2g} m"
    return f"{_line((row.method, row.integrator))}, {row.family} {row.case}: error {error}; {cause(row)}."


# -- words -------------------------------------------------------------------------------------------------------------


def _line(line: tuple[str, str]) -> str:
    return line[0] if line[0] == AUTO else f"{line[0]} with {line[1]}"


def _title(family: str) -> str:
    return family.replace("-", " ").capitalize()


def _listed(parts: Sequence[str]) -> str:
    return parts[0] if len(parts) == 1 else f"{', '.join(parts[:-1])} and {parts[-1]}"


def _many(count: int, thing: str) -> str:
    return f"{count} {thing}{'' if count == 1 else 's'}"
