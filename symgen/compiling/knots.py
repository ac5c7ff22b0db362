"""Points of tables that a run reads over the state, and kinks of what it adds up: a function of their arguments."""

from __future__ import annotations

from dataclasses import replace

from symgen.compiling.side import compile_side
from symgen.describe.kinks import knots_of, switches_of
from symgen.describe.mechanism import Mechanism
from symgen.describe.printer import to_text
from symgen.runtime.compiled import CompiledModel
from symgen.runtime.knots import Knots
from symgen.runtime.run import RunSpec
from symgen.runtime.switches import Switches

#: Which derivative of a table jumps at its points.
_JUMPS = {"linear": 1, "pchip": 2, "cubic": 3}


def with_looks(mechanism: Mechanism, compiled: CompiledModel, spec: RunSpec, ends: bool = True) -> RunSpec:
    """Return what a run is to do that passes no two switches in a step and, with `ends`, ends steps at kinks."""
    knots = compile_knots(mechanism, compiled) if ends else None
    return replace(spec, knots=knots, switches=compile_switches(mechanism, compiled))


def compile_knots(mechanism: Mechanism, compiled: CompiledModel) -> Knots | None:
    """Return where steps of a run should end for its tables and integrals, None where it has no such kink."""
    found = knots_of(mechanism)
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
    )


def compile_switches(mechanism: Mechanism, compiled: CompiledModel) -> Switches | None:
    """Return what steps of a run may not pass two of, None where forces and integrals compare nothing of the state."""
    found = switches_of(mechanism)
    if not found:
        return None
    formulas = [(to_text(argument), argument) for argument in found]
    side = compile_side(mechanism, compiled, "switches", "What forces and integrals compare", formulas, 1)
    return Switches(side.function, len(found), "ydot" in side.reads)
