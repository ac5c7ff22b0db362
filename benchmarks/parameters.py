"""The catalogue swept over each of its parameters: rows that fail, and their reasons.

    python -m benchmarks.parameters [MODEL ...]

Each parameter that is not 0 takes some values about its own, all others staying as they are.
"""

from __future__ import annotations

import sys
from collections import Counter

from rich.table import Table

import symgen
from benchmarks.show import show
from symgen.describe import catalogue

#: Values over the one of the file, and the longest run [s].
PARTS, LONGEST = (0.9, 0.95, 1.05, 1.1), 2.0


def main(chosen: list[str]) -> int:
    """Print the table; return 1 where a row fails."""
    table, failed = Table("model", "parameters", "rows", "failed"), list[str]()
    for name in chosen or catalogue.names(catalogue.MACHINES):
        model = symgen.load(name)
        values = {x.name: x.value for x in model.mechanism.parameters if x.formula is None and x.value != 0.0}
        until, outcomes = min(LONGEST, model.mechanism.defaults.until), Counter[str]()
        for key, value in values.items():
            rows = symgen.sweep(model, {key: [part * value for part in PARTS]}, until=until, times=(until,))
            outcomes.update(str(status) for status in rows.status)
            failed += [f"{name} {key}: {reason}" for reason, _ in rows.reasons(len(PARTS))]
        table.add_row(name, str(len(values)), str(outcomes.total()), str(outcomes["failed"]))
    show(table)
    print("\n".join(dict.fromkeys(failed)))
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
