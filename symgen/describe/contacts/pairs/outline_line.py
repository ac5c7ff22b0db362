"""An outline over a line: corners, ends and round parts are feet, and arcs roll on it, as parts of one contact."""

from __future__ import annotations

import msgspec

from symgen.base.vocabulary.expressions import Expr
from symgen.describe.contacts.arcs_on_line import arc_runs, stands_on_ends, touch_of_run
from symgen.describe.contacts.chains import BodyOutline
from symgen.describe.contacts.feet import feet_of
from symgen.describe.contacts.outlines import Outline
from symgen.describe.contacts.pairs.disc_line import LineTable, line_of_table, touch_of_line
from symgen.describe.contacts.pairs.disc_outline import as_one, drawn_outline
from symgen.describe.contacts.surfaces import OUTLINE, Pair, Touch
from symgen.describe.parts.scope import Scope


def read_outline_over_line(scope: Scope, key: str, table: LineTable, outline: BodyOutline) -> Touch:
    """Return the heights of the feet of an outline over a line, and the way of each along it."""
    on, normal = line_of_table(scope, key, table)
    drawn = drawn_outline(outline, lambda e: scope.value(e, key)), Outline((on,), normal=normal)

    def value(e: Expr) -> float:
        return scope.value(e, key)

    runs = arc_runs(outline, value)
    if any(stands_on_ends(run, outline, value) for run in runs):
        expected = "arcs whose circles lie within the outline, or whose two ends no line meets at once"
        raise scope.error(key, expected, f"those of '{outline.name}'")
    apart = frozenset(i for run in runs for i in run.pieces)
    touches = [touch_of_line(scope, on, normal, foot) for foot in feet_of(scope, key, outline, apart)]
    touches += (touch_of_run(scope, on, normal, outline, run) for run in runs)
    return as_one([msgspec.structs.replace(touch, outlines=drawn) for touch in touches])


KIND = Pair("line", LineTable, read_outline_over_line, lambda table: str(table.line), OUTLINE)
