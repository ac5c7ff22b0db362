"""Tables of docs/stress.md from the JSON of stress studies, one study a model.

    for model in pendulum four-bar andrews; do
      symgen stress $model --compilation 36 --resume stress.jsonl --json > studies/$model.json
    done
    python -m benchmarks.stress_tables studies/*.json --picture docs/pictures/stress-catalogue.svg

Mechanisms of families of their own, which stand in every study, are counted once.
"""

from __future__ import annotations

import argparse
import json
from collections import Counter
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any

import msgspec

from benchmarks.gallery import slim
from symgen.running.automatic import AUTO
from symgen.study.stress.cell_outcome import GOOD, OUTCOMES, REFUSED, UNJUDGED
from symgen.study.stress.findings import cause
from symgen.study.stress.stress_rows import Limit, Stress, StressRow, map_rows, outcomes_of_models

COLUMNS = ("rk4", "dop853", "radau5", AUTO)


def studied(paths: Iterable[Path]) -> Stress:
    """Return one study of several in JSON."""
    rows: dict[tuple[object, ...], StressRow] = {}
    limits: dict[tuple[object, ...], Limit] = {}
    tables: dict[str, list[tuple[Any, ...]]] = {"skipped": [], "unusable": [], "left_out": []}
    models: list[str] = []
    for path in paths:
        content = json.loads(path.read_text(encoding="utf-8"))
        models += [model for model in content["models"] if model not in models]
        for row in (msgspec.convert(each, StressRow) for each in content["rows"]):
            rows[row.model, row.family, row.case, row.method, row.integrator, row.step, row.values] = row
        for limit in (msgspec.convert(each, Limit) for each in content["limits"]):
            limits[limit.model, limit.family, limit.case, limit.method, limit.integrator] = limit
        for name, lines in tables.items():
            lines += [tuple(each.values()) for each in content[name] if tuple(each.values()) not in lines]
    ordered = sorted(rows.values(), key=lambda row: row.model)
    return Stress(tuple(models), tuple(ordered), tuple(limits.values()), **{k: tuple(v) for k, v in tables.items()})  # type: ignore[arg-type]  # of JSON


def table(head: Sequence[str], lines: Iterable[Sequence[object]]) -> str:
    """Return a table in Markdown."""
    rows = [head, ["---"] * len(head), *lines]
    return "\n".join("| " + " | ".join(str(cell) for cell in row) + " |" for row in rows) + "\n"


def by_model(study: Stress) -> str:
    """Return how cells ended on each model, and how many of them say ok and are wrong."""
    shown = [name for name in OUTCOMES if name != REFUSED]
    lines: list[list[str | int]] = []
    for model, counted in outcomes_of_models(study.rows):
        false = [row for row in study.false_successes if row.model == model]
        own = sum(row.method == AUTO for row in false)
        lines.append([f"`{model}`", sum(counted.values()), *(counted[n] for n in shown), len(false), own])
    total = ["all", *(sum(int(line[i]) for line in lines) for i in range(1, len(lines[0])))]
    return table(["model", "cells", *shown, "false successes", "of `auto`"], [*lines, total])


def by_cause(study: Stress) -> str:
    """Return why named methods say ok and are wrong, with the families in which they do."""
    causes: dict[str, Counter[str]] = {}
    for row in study.false_successes:
        if row.method != AUTO:
            causes.setdefault(cause(row), Counter())[row.family] += 1
    ordered = sorted(causes.items(), key=lambda item: -item[1].total())
    lines = [(c.total(), why, ", ".join(f"{name} {n}" for name, n in c.most_common())) for why, c in ordered]
    return table(["cells", "why", "families"], lines)


def by_family(study: Stress) -> str:
    """Return the accurate cells of those judged, for integrators that all methods are run with."""
    rows = map_rows(study.rows)
    lines = []
    for family in dict.fromkeys(row.family for row in rows):
        line: list[str] = [family]
        for name in COLUMNS:
            judged = [
                row
                for row in rows
                if row.family == family and row.integrator == name and row.outcome not in (REFUSED, UNJUDGED)
            ]
            line.append(f"{sum(row.outcome == GOOD for row in judged)} of {len(judged)}")
        lines.append(line)
    return table(["family", *(f"`{name}`" for name in COLUMNS)], lines)


def by_method(study: Stress) -> str:
    """Return the accurate cells of methods by family, with what became of the others; equal ones share a line."""
    rows = [row for row in map_rows(study.rows) if row.outcome not in (REFUSED, UNJUDGED)]
    families = tuple(dict.fromkeys(row.family for row in rows))
    lines: dict[tuple[str, ...], list[str]] = {}
    for method in dict.fromkeys(row.method for row in rows):
        line = []
        for family in families:
            count = Counter(row.outcome for row in rows if (row.method, row.family) == (method, family))
            others = ", ".join(f"{count[name]} {name}" for name in OUTCOMES if count[name] and name != GOOD)
            line.append(f"{count[GOOD]} of {count.total()}" + (f"; {others}" if others else ""))
        lines.setdefault(tuple(line), []).append(f"`{method}`")
    return table(["methods", *families], ([", ".join(methods), *line] for line, methods in lines.items()))


def main(arguments: Sequence[str] | None = None) -> None:
    """Print the tables; draw the shares of accurate cells if that is asked for."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("studies", type=Path, nargs="+", help="what symgen stress --json wrote")
    parser.add_argument("--picture", type=Path, help="SVG of the shares of accurate cells by method and model")
    given = parser.parse_args(arguments)
    study = studied(given.studies)
    named = [row for row in study.rows if row.method != AUTO and row.watched]
    false = [row for row in study.false_successes if row.method != AUTO]
    auto = Counter(row.outcome for row in study.rows if row.method == AUTO)
    print(f"{len(study.rows)} cells, {len(study.limits)} searches, {len(study.models)} models\n")
    print(by_model(study))
    print(f"auto: {dict(auto.most_common())}; named: {len(false)} false successes of {len(named)}\n")
    print(by_cause(study))
    print(by_family(study))
    print(by_method(study))
    if given.picture:
        from symgen.report.stress_figures import overview

        given.picture.write_text(slim(overview(study).data.decode()), encoding="utf-8")


if __name__ == "__main__":
    main()
