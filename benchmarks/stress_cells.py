"""Stiff and extreme cases of the catalogue: tables of docs/tables/stress.md from a record of `symgen stress`.

    python -m benchmarks.stress_cells [models] [causes] [families] [methods]    tables of the page, from the record
    python -m benchmarks.stress_cells picture                                   draws its picture
    python -m benchmarks.records stress_cells [--workers N]             measures what it lacks, hours on one core

A line of the record is a family on a model, with the outcomes of its cells by method and integrator, with the cells
that report success and are wrong, and why. `models` counts outcomes, `causes` false successes; `families` has the
accurate cells of those judged, for integrators that all methods are run with. A record may lack families of a model:
tables say how many there are. `methods` has the cells of four families on the four-bar by method.
"""

from __future__ import annotations

import random
import re
import sys
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Sequence
from functools import partial
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from benchmarks.kept_pictures import slim
from benchmarks.page_tables import KEPT, ROOT, PageTable, list_of, print_tables
from benchmarks.records import Line, Pair, Record
from symgen.base.errors import plural
from symgen.derive.methods import METHODS
from symgen.run.planning.automatic import AUTO
from symgen.study.stress.cell_outcome import GOOD, OUTCOMES, REFUSED, UNJUDGED
from symgen.study.stress.families import FAMILIES
from symgen.study.stress.findings import cause_of_failure
from symgen.study.stress.study import stress

#: Stands for the mechanisms of families of their own.
OWN = "-"
OWN_FAMILIES = tuple(name for name, family in FAMILIES.items() if family.own)
#: Quick ones first.
MODELS = (
    *("four-bar", "andrews", "slider-crank", "pendulum", "spatial-slider-crank", "n-four-bar:2", "heavy-top"),
    *("rolling-disc", "driven-four-bar", "free-rigid-body", "spherical-double-pendulum", "bricard", "chain:4"),
    *("flyball-governor", "stewart-platform", "front-suspension"),
)
#: Families of planes, and the one of gains, which have tables of their own.
PLANES = ("alpha-beta", "step-stiffness", "gain")
#: Families of the table by method.
CASES = ("singular-passage", "redundancy", "mass-ratio", "inconsistent-start")
COLUMNS = ("rk4", "dop853", "radau5", AUTO)
#: Seconds of compilation of pairs without looped code; fewer for models of more coordinates.
COMPILATION, LARGE = 36.0, {"bricard", "chain:4", "flyball-governor", "front-suspension", "stewart-platform"}
#: Processor time of a family on a model at most [s].
PATIENCE = 7200.0

PAGE, PICTURE = "docs/tables/stress.md", "docs/pictures/stress-catalogue.svg"
#: Pairs of fewer judged cells have no share; so many are listed as the most and the least often accurate.
LEAST, MOST = 50, 4

Outcomes = Counter[str]


class Job(NamedTuple):
    """A family on a model."""

    model: str
    family: str


def jobs() -> Iterator[Job]:
    """Yield all families, model by model."""
    yield from (Job(OWN, family) for family in OWN_FAMILIES)
    yield from (Job(model, family) for model in MODELS for family in FAMILIES if family not in OWN_FAMILIES)


def examine(job: Job, methods: Sequence[str] = ()) -> dict[str, Any]:
    """Return outcomes of cells and false successes by method and integrator, and causes of those of named methods."""
    model = "four-bar" if job.model == OWN else job.model
    study = stress([model], [job.family], methods, compilation=1.0 if model in LARGE else COMPILATION, searches=False)
    cells = dict[str, Counter[str]]()
    for row in study.rows:
        cells.setdefault(f"{row.method} {row.integrator}", Counter())[row.outcome] += 1
    false = Counter(f"{row.method} {row.integrator}" for row in study.false_successes)
    causes = Counter(cause_of_failure(row) for row in study.false_successes if row.method != AUTO)
    verified = Counter(f"{row.method} {row.integrator}" for row in study.rows if row.verified_falsely)
    return {"cells": cells, "false": false, "causes": causes, "verified": verified}


def again(stored: Line, dice: random.Random) -> Iterator[Pair]:
    """Yield the outcomes of a method beside those measured again."""
    methods = sorted({name.split()[0] for name in stored["cells"]} - {AUTO})
    if not methods:
        return
    method = dice.choice(methods)
    new = examine(Job(stored["model"], stored["family"]), [method])["cells"]
    for name in sorted(name for name in stored["cells"] if name.split()[0] == method):
        where = f"{stored['model']}, {stored['family']}, {name}"
        yield Pair(where, stored["cells"][name], dict(new.get(name, {})))


def outcomes(lines: Iterable[Line], chosen: Callable[[str, str], bool] = lambda method, integrator: True) -> Outcomes:
    """Return how often each outcome occurs, of methods and integrators that a function chooses."""
    count: Outcomes = Counter()
    for line in lines:
        for name, cells in line["cells"].items():
            if chosen(*name.split()):
                count.update(cells)
    return count


def of_column(column: str, method: str, integrator: str) -> bool:
    """Whether a pair belongs to a column, by its integrator or as `auto`."""
    return column in (method, integrator)


def judged(count: Outcomes) -> int:
    """Return how many cells were run and had a reference."""
    return count.total() - count[REFUSED] - count[UNJUDGED]


def measured_models() -> tuple[str, ...]:
    """Return the models of which the record has families."""
    there = {line["model"] for line in lines_of()}
    return tuple(model for model in (OWN, *MODELS) if model in there)


def lines_of(model: str = "", family: str = "") -> list[Line]:
    """Return the lines of a model or a family."""
    return [
        line
        for line in RECORD.lines()
        if "cells" in line and model in ("", line["model"]) and family in ("", line["family"])
    ]


def share_of_jobs(model: str = "", family: str = "") -> str:
    """Return how many of the jobs of a model or a family the record has."""
    wanted = [job for job in jobs() if model in ("", job.model) and family in ("", job.family)]
    there = {Job(line["model"], line["family"]) for line in lines_of()}
    return f"{sum(job in there for job in wanted)} of {len(wanted)}"


def false_of(lines: Iterable[Line], auto: bool) -> int:
    """Return how many cells of `auto`, or of named methods, report success and are wrong."""
    pairs = (item for line in lines for item in line["false"].items())
    return sum(n for name, n in pairs if (name.split()[0] == AUTO) is auto)


def models() -> PageTable:
    """Return how cells ended on each model, and how many report success and are wrong."""
    shown = [name for name in OUTCOMES if name != REFUSED]

    def cells(model: str) -> Iterator[str]:
        lines = lines_of(model)
        count, false = outcomes(lines), [false_of(lines, auto) for auto in (False, True)]
        yield share_of_jobs(model)
        yield from map(str, (count.total(), *(count[name] for name in shown), *false))

    rows = [((f"`{model}`",), partial(list_of, cells, model)) for model in measured_models()]
    rows.append((("all",), partial(list_of, cells, "")))
    headings = ("model", "families", "cells", *shown, "false successes", "of `auto`")
    return PageTable("stress_cells models", PAGE, headings, tuple(rows), stored=True, claims=claims)


def claims() -> Iterator[str]:
    """Yield what the page says of all cells."""
    lines = lines_of()
    by_auto = outcomes(lines, lambda method, _: method == AUTO)
    ends = ", ".join(f"{by_auto[name]} {name}" for name in OUTCOMES if by_auto[name])
    wrong = false_of(lines, auto=True)
    yield f"False successes of `auto`: {wrong or 'none'} in {by_auto.total()} cells; {ends}."
    watched = [line for line in lines if line["family"] not in PLANES]
    named, false = outcomes(watched, lambda method, _: method != AUTO).total(), false_of(lines, auto=False)
    share = 100.0 * false / max(named, 1)
    yield f"Of {named} cells of named methods {false} ({share:.2g} percent) are false successes."
    left = dict[str, list[Line]]()
    for line in lines:
        if "verified" in line:
            left.setdefault(line["model"], []).append(line)
    parts = [
        f"{sum(sum(line['verified'].values()) for line in own)} of {false_of(own, auto=False)} on `{model}` "
        f"({plural(len(own), 'family', 'families')})"
        for model, own in left.items()
    ]
    if parts:
        yield f"With `--verify` are left: {', '.join(parts)}."


def causes() -> PageTable:
    """Return why named methods report success and are wrong, with the families in which they do."""
    by_cause = dict[str, Outcomes]()
    for line in lines_of():
        for why, n in line["causes"].items():
            by_cause.setdefault(why, Counter())[line["family"]] += n
    ordered = sorted(by_cause.items(), key=lambda item: -item[1].total())

    def cells(why: str) -> Iterator[str]:
        yield str(by_cause[why].total())
        yield ", ".join(f"{family} {n}" for family, n in by_cause[why].most_common())

    rows = tuple(((why,), partial(list_of, cells, why)) for why, _ in ordered)
    return PageTable("stress_cells causes", PAGE, ("why", "cells", "families"), rows, stored=True)


def families() -> PageTable:
    """Return the accurate cells of those judged, by family and integrator."""

    def cells(family: str) -> Iterator[str]:
        yield share_of_jobs(family=family)
        for column in COLUMNS:
            count = outcomes(lines_of(family=family), partial(of_column, column))
            yield f"{count[GOOD]} of {judged(count)}"

    named = [*OWN_FAMILIES, *(family for family in FAMILIES if family not in (*OWN_FAMILIES, *PLANES))]
    rows = tuple(((family,), partial(list_of, cells, family)) for family in named)
    headings = ("family", "models", *(f"`{name}`" for name in COLUMNS))
    return PageTable("stress_cells families", PAGE, headings, rows, stored=True, claims=shares)


def shares() -> Iterator[str]:
    """Yield which pairs are accurate most and least often."""
    count = dict[str, Outcomes]()
    for line in lines_of():
        if line["family"] not in PLANES:
            for name, cells in line["cells"].items():
                count.setdefault(name, Counter()).update(cells)
    share = {name: count[name][GOOD] / judged(count[name]) for name in count if judged(count[name]) >= LEAST}
    order = sorted(share, key=lambda name: -share[name])
    for word, chosen in (("Most", order[:MOST]), ("Least", order[: -MOST - 1 : -1])):
        listed = ", ".join(f"{_named(name)} {100.0 * share[name]:.0f}" for name in chosen)
        yield f"{word} often accurate [percent]: {listed}."


def _named(pair: str) -> str:
    method, integrator = pair.split()
    return f"`{method}`" if method == integrator else f"`{method}` with `{integrator}`"


def methods() -> PageTable:
    """Return the accurate cells of each method on the four-bar by family, with what became of the others."""
    lines = {line["family"]: line for line in RECORD.lines() if line["model"] in (OWN, "four-bar") and "cells" in line}

    def cells(method: str) -> Iterator[str]:
        for family in CASES:
            if family not in lines:
                yield KEPT
                continue
            count = outcomes([lines[family]], lambda name, _: name == method)
            others = ", ".join(
                f"{count[name]} {name}" for name in OUTCOMES if count[name] and name not in (GOOD, REFUSED, UNJUDGED)
            )
            yield f"{count[GOOD]} of {judged(count)}" + (f"; {others}" if others else "")

    alike = dict[tuple[str, ...], list[str]]()
    for method in (*sorted(METHODS.names), AUTO):
        own = tuple(cells(method))
        alike.setdefault(own if KEPT not in own else (method,), []).append(method)
    rows = tuple(
        ((", ".join(f"`{name}`" for name in names),), partial(list_of, cells, names[0])) for names in alike.values()
    )
    counted = [line for family, line in lines.items() if family in CASES]

    def false() -> Iterator[str]:
        pairs = Counter[str]()
        for line in counted:
            pairs.update(line["false"])
        listed = ", ".join(f"{_named(name)} {n}" for name, n in pairs.most_common()) or "none"
        yield f"Of these {outcomes(counted).total()} cells {pairs.total()} are false successes: {listed}."

    return PageTable("stress_cells methods", PAGE, ("methods", *CASES), rows, stored=True, claims=false)


def tables() -> dict[str, PageTable]:
    """Return all tables by name."""
    return {"models": models(), "causes": causes(), "families": families(), "methods": methods()}


def picture(path: Path) -> None:
    """Draw the shares of accurate cells by pair and model."""
    from symgen.study.report.stress_figures import picture_of_shares

    cells = {(line["model"], name): Counter[str]() for line in lines_of() for name in line["cells"]}
    false = {key: 0 for key in cells}
    for line in lines_of():
        for name in line["cells"]:
            if line["family"] not in PLANES:
                cells[line["model"], name].update(line["cells"][name])
                false[line["model"], name] += line["false"].get(name, 0)
    order = {name: i for i, name in enumerate((*METHODS.names, AUTO))}
    pairs = sorted({name for _, name in cells}, key=lambda name: (order[name.split()[0]], name))
    models_there = measured_models()
    share, wrong = (
        np.full((len(pairs), len(models_there)), np.nan),
        np.zeros((len(pairs), len(models_there)), dtype=int),
    )
    for i, j in np.ndindex(share.shape):
        key = models_there[j], pairs[i]
        if key in cells and judged(cells[key]):
            share[i, j], wrong[i, j] = 100.0 * cells[key][GOOD] / judged(cells[key]), false[key]
    lines = [(method, integrator) for method, integrator in map(str.split, pairs)]
    drawn = picture_of_shares(lines, models_there, share, wrong)
    # letters stand in hundredths of their height, of which whole ones are enough
    text = re.sub(r"translate\((\d+)[.\d]* 0\)", r"translate(\1)", slim(drawn.data.decode()))
    text = re.sub(r"M (\S+) (\S+) (\S+) \2 ?(?=[M\"])", r"M\1 \2H\3", text)  # marks are horizontal
    text = text.replace("<g/>", "").replace('style="fill:#222222"', 'fill="#222"')  # of each label
    path.write_text(with_words_once(text), encoding="utf-8")


def with_words_once(text: str) -> str:
    """Return a picture in which a word that comes again refers to the first one: letters are most of the file."""
    words = re.compile(r"(?:<use [^>]*/>){2,}")
    counts, names = Counter(words.findall(text)), dict[str, str]()

    def once(match: re.Match[str]) -> str:
        word = match.group()
        if word in names:
            return f'<use href="#{names[word]}"/>'
        if counts[word] == 1:
            return word
        names[word] = f"w{len(names)}"
        return f'<g id="{names[word]}">{word}</g>'

    return words.sub(once, text)


RECORD = Record("stress_cells", jobs, examine, again, PATIENCE, share=0.02)


if __name__ == "__main__":
    if sys.argv[1:] == ["picture"]:
        picture(ROOT / PICTURE)
    else:
        sys.exit(print_tables(tables(), sys.argv[1:]))
