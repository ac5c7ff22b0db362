"""Measured tables, written into the pages of docs/tables.

    python -m benchmarks.findings [TABLE ...] [--times]

Each table is the output of a module, whose command the page names before the table. Cells that agree with what is
measured stay as they are, and with all of them the date does. Run times are measured with ``--times`` only, on a quiet
machine; else the page keeps its own. Tables of records (`benchmarks.records`) follow from what is stored. Sentences
that follow from the same numbers are compared with the page, and those that it has otherwise are printed. Run times
belong to the code of the loops that ran (`benchmarks.code_of_times`): without ``--times``, tables whose times are of an
older one are refused.
"""

from __future__ import annotations

import sys
from datetime import date

from benchmarks import (
    all_methods,
    backward,
    beside_tools,
    by_numba,
    claims,
    coordinates,
    equal_error,
    equal_work,
    functions,
    identification,
    lie_groups,
    literature,
    long,
    picard,
    shared_loads,
    singular,
    space,
    statistics,
    stiff,
    stress_cells,
    stress_quick,
)
from benchmarks.code_of_times import code_of_times
from benchmarks.page_tables import ROOT, PageTable, is_older, missing, written


def measured_tables(times: bool = False) -> tuple[PageTable, ...]:
    """Return every table that has a module; run times are measured only if asked for."""
    return (
        *literature.tables(times).values(),
        *(claims.table(), shared_loads.table(), stiff.table(), long.table(), singular.table()),
        backward.table(times),
        *lie_groups.tables().values(),
        *(coordinates.table(times), picard.work_table(times), picard.hard_table(times), space.methods(times)),
        *all_methods.tables().values(),
        *stress_cells.tables().values(),
        *(stress_quick.tables().values() if stress_quick.RECORD.lines() else ()),
        *(
            equal_error.page_table(),
            equal_work.page_table(),
            statistics.page_table(),
            identification.page_table(),
            *beside_tools.tables(),
        ),
        *functions.tables(),
        by_numba.page_table(),
    )


TABLES = measured_tables()


def main(arguments: list[str]) -> int:
    """Measure the tables that are named, or all, and write them into their pages; 1 if a study lacks a sentence."""
    timed = "--times" in arguments
    tables = measured_tables(times=timed)
    with_times = measured_tables(times=True)
    names, lacking = [name for name in arguments if name != "--times"], 0
    for table in tables:
        if names and not {table.command, table.command.split()[-1], table.command.split()[0]} & set(names):
            continue
        page = ROOT / table.page
        text = page.read_text(encoding="utf-8")
        code = code_of_times(table) if table.times else ""
        if not timed and any(is_older(t, text, code) for t in with_times if t.command == table.command):
            lacking += 1
            sys.stdout.write(f"{table.command}: {table.page} has times of older code; measure them with --times\n")
            continue
        new = written(table, text, table.measured(), date.today().isoformat(), code)
        page.write_text(new, encoding="utf-8")
        sys.stdout.write(f"{table.command}: {'written into' if new != text else 'as in'} {table.page}\n")
        for claim in missing(table, (ROOT / table.study).read_text(encoding="utf-8")):
            lacking += 1
            sys.stdout.write(f"  {table.study} has no sentence '{claim}'\n")
    return int(lacking > 0)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
