"""Corners of gaps: where the formula of a gap has a kink over the state, the row of a closed stop turns.

A corner is an event of a closed stop alone. While it is open, corners are switches as those of other formulas are
(`symgen.describe.facts.kinks`): its gap is not smooth there, and pushes nothing.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from symgen.base.vocabulary.expressions import ONE, Call, Expr, Number, call, names_in_expression, readings_in, table_of
from symgen.base.vocabulary.measures import FormulaMeasure
from symgen.describe.bounds.bounded_modes import MODE
from symgen.describe.bounds.end_stop import EndStop
from symgen.describe.facts.kinks import calls_in, kink_expressions
from symgen.describe.mechanism import Event, Mechanism
from symgen.describe.table_functions import Table

#: Last word of the names of these events, before a number where a gap has several.
CORNER = "corner"
#: Largest number of corners of a table; one with more points is sampled from a smooth curve.
MOST_POINTS = 64


def corner_events(mechanism: Mechanism) -> Iterator[Event]:
    """Yield the events at which gaps of closed stops pass corners; their functions are 1 while a stop is open."""
    for row in mechanism.bounded:
        if isinstance(row, EndStop):
            closed = row.is_closed_formula()
            for number, zero in enumerate(dict.fromkeys(_zero_at_corners(mechanism, row))):
                when = call("add", call("mul", closed, zero), call("sub", ONE, closed))
                yield Event(f"{row.name}.{CORNER}{number or ''}", when, "any", MODE, (), "corner of a closed gap")


def row_of_corner(name: str) -> str:
    """Return the row of an event at a corner by its name; empty for other events."""
    row, _, word = name.rpartition(".")
    return row if word.rstrip("0123456789") == CORNER else ""


def _zero_at_corners(mechanism: Mechanism, row: EndStop) -> Iterator[Expr]:
    """Yield what is 0 at the corners of a gap that the state passes; those over time alone are seams."""
    plain = {p.name for p in mechanism.parameters} | {"t"}
    tables = {table.function: table for table in mechanism.tables if table.interpolation == "linear"}
    parts: tuple[Any, ...] = row.value, row.measure.of if isinstance(row.measure, FormulaMeasure) else row.value
    for part in parts:
        found = [*kink_expressions(part)]
        found += (x for e in calls_in(part) if table_of(e.function) for x in _zero_at_points(e, tables))
        yield from (e for e in found if any(readings_in(e)) or not set(names_in_expression(e)) <= plain)


def _zero_at_points(e: Call, tables: dict[str, Table]) -> Iterator[Expr]:
    """Yield what is 0 at the points at which a table changes its slope, within its first period."""
    table = tables.get(e.function)
    if table is None or len(table.x) > MOST_POINTS:
        return
    for i, x in enumerate(table.x):
        before = (table.y[i] - table.y[i - 1]) / (x - table.x[i - 1]) if i > 0 else 0.0
        after = (table.y[i + 1] - table.y[i]) / (table.x[i + 1] - x) if i + 1 < len(table.x) else 0.0
        if before != after:
            yield call("sub", e.arguments[0], Number(x))
