"""Points of tables that a run reads over the state, and kinks of what it adds up: a function of their arguments."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from symgen.compiling.side import compile_side
from symgen.describe.kinks import jumps_over_state, knots_of, switches_of
from symgen.describe.mechanism import Mechanism
from symgen.describe.printer import to_text
from symgen.ir.interpolation import Interpolation
from symgen.runtime.compiled import CompiledModel
from symgen.runtime.knots import Knots
from symgen.runtime.run import RunSpec
from symgen.runtime.switches import Switches

#: Which derivative of a table jumps at its points.
_JUMPS = {"linear": 1, "pchip": 2, "cubic": 3}


def with_looks(mechanism: Mechanism, compiled: CompiledModel, spec: RunSpec, bends: bool = True) -> RunSpec:
    """Return what a run is to do that ends steps at points of tables, and passes no two switches in a step.

    With `bends` steps end at what `abs`, `min` and `max` compare as well, as schemes have it that know the
    accelerations at their beginning.
    """
    knots, switches = compile_knots(mechanism, compiled, bends), compile_switches(mechanism, compiled)
    return replace(spec, knots=knots, switches=switches)


def compile_knots(mechanism: Mechanism, compiled: CompiledModel, bends: bool = True) -> Knots | None:
    """Return where steps of a run should end for its tables and, with `bends`, kinks; None where it has none."""
    found = [(argument, table) for argument, table in knots_of(mechanism) if bends or table is not None]
    if not found:
        return None
    formulas = [(to_text(argument), argument) for argument, _ in found]
    side = compile_side(mechanism, compiled, "knots", "Arguments of tables, abs, min and max", formulas, 2)
    tables = [table for _, table in found]
    return Knots(
        function=side.function,
        levels=tuple((0.0,) if table is None else table.x for table in tables),
        periods=tuple(0.0 if table is None or not table.periodic else table.x[-1] - table.x[0] for table in tables),
        orders=tuple(1 if table is None else _JUMPS[table.interpolation] for table in tables),
        sizes=tuple((math.inf,) if table is None else _sizes(table.interpolated) for table in tables),
    )


def _sizes(found: Interpolation) -> tuple[float, ...]:
    """Return how far both sides of each point of a table part within the shorter piece, over the range of values."""
    x, y, n = np.array(found.x), np.array(found.y), len(found.x)
    gaps = np.diff(x)
    if found.pieces:
        (_, *before), (_, *after) = (np.array(found.pieces[k : n + k]).T for k in (0, 1))
        u = np.concatenate([[0.0], gaps])
        b1, b2, b3 = before
        parts = [after[0] - (b1 + u * (2.0 * b2 + u * (3.0 * b3))), after[1] - (b2 + 3.0 * u * b3), after[2] - b3]
    else:
        slopes = np.concatenate([[0.0], np.diff(y) / gaps, [0.0]])
        parts = [np.diff(slopes)]
    h = np.minimum(np.concatenate([gaps[:1], gaps]), np.concatenate([gaps, gaps[-1:]]))
    total = np.zeros(n)
    for k, part in enumerate(parts, 1):
        total += np.abs(part) * h**k
    span = float(np.ptp(y))
    return tuple((total / span).tolist()) if span > 0.0 else (0.0,) * n


def compile_switches(mechanism: Mechanism, compiled: CompiledModel) -> Switches | None:
    """Return what steps of a run may not pass two of, None where forces and integrals compare nothing of the state."""
    found = switches_of(mechanism)
    if not found:
        return None
    formulas = [(to_text(argument), argument) for argument in found]
    side = compile_side(mechanism, compiled, "switches", "What forces and integrals compare", formulas, 1, True)
    return Switches(side.function, len(found), "ydot" in side.reads, jumps_over_state(mechanism))
