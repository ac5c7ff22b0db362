"""Stiff and extreme cases of the catalogue: tables of docs/stress.md from a record of `symgen stress`.

    python -m benchmarks.stress_cells [models] [families] [methods]     tables of the page, from the record
    python -m benchmarks.records stress_cells [--workers N]             measures what it lacks, hours on one core

A line of the record is a family on a model, with the outcomes of its cells by method and integrator and with the cells
that report success and are wrong. `models` counts outcomes; `families` has the accurate cells of those judged, for
integrators that all methods are run with; `methods` has the cells of four families on the four-bar by method.
"""

from __future__ import annotations

import random
import sys
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Sequence
from functools import partial
from typing import Any, NamedTuple

from benchmarks.page_tables import KEPT, PageTable, list_of, print_tables
from benchmarks.records import Line, Pair, Record
from symgen.methods import METHODS
from symgen.running.automatic import AUTO
from symgen.study.stress.cell_outcome import GOOD, OUTCOMES, REFUSED, UNJUDGED
from symgen.study.stress.families import FAMILIES
from symgen.study.stress.study import stress

#: Stands for the mechanisms of families of their own.
OWN = "-"
OWN_FAMILIES = ("length-ratio", "singular-passage")
MODELS = (
    *("andrews", "bricard", "chain:4", "driven-four-bar", "flyball-governor", "four-bar", "free-rigid-body"),
    *("front-suspension", "heavy-top", "n-four-bar:2", "pendulum", "rolling-disc", "slider-crank"),
    *("spatial-slider-crank", "spherical-double-pendulum", "stewart-platform"),
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

Outcomes = Counter[str]


class Job(NamedTuple):
    """A family on a model."""

    model: str
    family: str


def jobs() -> Iterator[Job]:
    """Yield all families on all models, those of the table by method first."""
    every = [Job(model, family) for model in MODELS for family in FAMILIES if family not in OWN_FAMILIES]
    every += [Job(OWN, family) for family in OWN_FAMILIES]
    return iter(sorted(every, key=lambda job: (job.family not in CASES, job.model not in (OWN, "four-bar"))))


def examine(job: Job, methods: Sequence[str] = ()) -> dict[str, Any]:
    """Return the outcomes of cells by method and integrator, and how many are false successes."""
    model = "four-bar" if job.model == OWN else job.model
    study = stress([model], [job.family], methods, compilation=1.0 if model in LARGE else COMPILATION)
    cells = dict[str, Counter[str]]()
    for row in study.rows:
        cells.setdefault(f"{row.method} {row.integrator}", Counter())[row.outcome] += 1
    false = Counter(f"{row.method} {row.integrator}" for row in study.false_successes)
    return {"cells": cells, "false": false}


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


def whole(model: str = "", family: str = "") -> list[Line] | None:
    """Return the lines of a model or a family, None while one is missing."""
    wanted = {job for job in jobs() if model in ("", job.model) and family in ("", job.family)}
    lines = {Job(line["model"], line["family"]): line for line in RECORD.lines() if "cells" in line}
    return [lines[job] for job in wanted] if wanted <= lines.keys() else None


def models() -> PageTable:
    """Return how cells ended on each model, and how many report success and are wrong."""
    shown = [name for name in OUTCOMES if name != REFUSED]

    def cells(model: str) -> Iterator[str]:
        lines = whole(model)
        if lines is None:
            yield from [KEPT] * (len(shown) + 3)
            return
        count = outcomes(lines)
        false = Counter[str]()
        for line in lines:
            false.update(line["false"])
        own = sum(n for name, n in false.items() if name.split()[0] == AUTO)
        yield from map(str, (count.total(), *(count[name] for name in shown), false.total(), own))

    rows = [((f"`{model}`",), partial(list_of, cells, model)) for model in (OWN, *MODELS)]
    rows.append((("all",), partial(list_of, cells, "")))
    headings = ("model", "cells", *shown, "false successes", "of `auto`")
    return PageTable("stress_cells models", "docs/stress.md", headings, tuple(rows), stored=True)


def families() -> PageTable:
    """Return the accurate cells of those judged, by family and integrator."""

    def cells(family: str) -> Iterator[str]:
        lines = whole(family=family)
        for column in COLUMNS:
            if lines is None:
                yield KEPT
                continue
            count = outcomes(lines, partial(of_column, column))
            yield f"{count[GOOD]} of {judged(count)}"

    named = [*OWN_FAMILIES, *(family for family in FAMILIES if family not in (*OWN_FAMILIES, *PLANES))]
    rows = tuple(((family,), partial(list_of, cells, family)) for family in named)
    headings = ("family", *(f"`{name}`" for name in COLUMNS))
    return PageTable("stress_cells families", "docs/stress.md", headings, rows, stored=True)


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
    return PageTable("stress_cells methods", "docs/stress.md", ("methods", *CASES), rows, stored=True)


def tables() -> dict[str, PageTable]:
    """Return all tables by name."""
    return {"models": models(), "families": families(), "methods": methods()}


RECORD = Record("stress_cells", jobs, examine, again, PATIENCE)


if __name__ == "__main__":
    sys.exit(print_tables(tables(), sys.argv[1:]))
