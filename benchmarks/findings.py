"""Measured tables of pages, written into them.

    python -m benchmarks.findings [TABLE ...] [--times]

Each table is the output of a module, whose command the page names before the table. Cells that agree with what is
measured stay as they are, and with all of them the date does. Run times are measured with ``--times`` only, on a quiet
machine; else the page keeps its own.
"""

from __future__ import annotations

import sys
from datetime import date

from benchmarks import literature, long, shared_loads, stiff
from benchmarks.page_tables import ROOT, PageTable, written


def measured_tables(times: bool = False) -> tuple[PageTable, ...]:
    """Return every table that has a module; run times are measured only if asked for."""
    return (*literature.tables(times).values(), shared_loads.table(), stiff.table(), long.table())


TABLES = measured_tables()


def main(arguments: list[str]) -> int:
    """Measure the tables that are named, or all, and write them into their pages."""
    tables = measured_tables(times="--times" in arguments)
    names = [name for name in arguments if name != "--times"]
    for table in tables:
        if names and table.command.split()[-1] not in names:
            continue
        page = ROOT / table.page
        text = page.read_text(encoding="utf-8")
        new = written(table, text, table.measured(), date.today().isoformat())
        page.write_text(new, encoding="utf-8")
        sys.stdout.write(f"{table.command}: {'written into' if new != text else 'as in'} {table.page}\n")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
