"""Tables of docs/findings.md from the JSON of comparisons.

    symgen compare four-bar spatial-slider-crank bricard front-suspension n-four-bar:2 --methods all --json > all.json
    python -m benchmarks.comparison_tables all.json

The first counts how runs ended; the second has, for each method, the run time of its fastest run that is `ok` and
within an error, over that of the fastest of all methods on the same mechanism.
"""

from __future__ import annotations

import json
import sys
from collections import Counter
from pathlib import Path
from typing import Any

from benchmarks.stress_tables import table
from symgen.methods import METHODS
from symgen.result.result import FAILED, OK, UNVERIFIED
from symgen.study.stress.cell_outcome import ACCURATE

Studies = list[dict[str, Any]]
#: Errors [m] at which methods are compared.
ERRORS = (1e-4, 1e-6, 1e-8)


def ends(studies: Studies) -> str:
    """Return how runs ended on each mechanism, and which are `ok` and off by more than 1e-3 m."""
    lines = []
    for study in studies:
        rows = study["rows"]
        count = Counter(row["status"] for row in rows)
        wrong = Counter(
            f"`{row['integrator']}` with {row['step'] or row['rtol']:g}"
            for row in rows
            if row["status"] == OK and not row["error"] <= ACCURATE
        )
        listed = ", ".join(f"{n} {setting}" for setting, n in wrong.most_common())
        lines.append(
            [f"`{study['mechanism']}`", len(rows), *(count[name] for name in (OK, UNVERIFIED, FAILED)), listed]
        )
    return table(["mechanism", "runs", OK, UNVERIFIED, FAILED, "ok and off by more than 1e-3 m"], lines)


def times(studies: Studies, error: float) -> str:
    """Return the run times of methods within an error [m], over the shortest on each mechanism."""
    columns = []
    for study in studies:
        shortest: dict[str, float] = {}
        for row in study["rows"]:
            if row["status"] == OK and row["error"] <= error:
                method, seconds = row["method"], row["run_seconds"]
                shortest[method] = min(seconds, shortest.get(method, seconds))
        columns.append({method: x / min(shortest.values()) for method, x in shortest.items()})
    order = sorted(
        METHODS.names, key=lambda name: (-sum(name in c for c in columns), sum(c.get(name, 0.0) for c in columns))
    )
    lines = [[f"`{name}`", *(f"{c[name]:.3g}" if name in c else "-" for c in columns)] for name in order]
    return table([f"within {error:g} m", *(f"`{study['mechanism']}`" for study in studies)], lines)


def main(arguments: list[str]) -> None:
    """Print the tables."""
    files = (json.loads(Path(path).read_text(encoding="utf-8")) for path in arguments)
    studies = [study for file in files for study in file.get("studies", [file])]
    print(ends(studies), *(times(studies, error) for error in ERRORS), sep="\n")


if __name__ == "__main__":
    main(sys.argv[1:])
