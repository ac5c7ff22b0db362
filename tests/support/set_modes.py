"""Modes of rows that may be off: changed between two parts of a run."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from symgen.base.errors import InputError, suggest
from symgen.base.ir.numerics import SKIP
from symgen.compile.loopcode.entry import bind_arguments
from symgen.compile.loopcode.exact import compiled_form
from symgen.run.layout import abi
from symgen.run.layout.redundancy import choose_rows, farthest_row, room_of_choice
from symgen.run.loops.watch import remember_rank
from symgen.run.modes.choice import look_anew
from symgen.run.starts.assembler import layout_of_starts

if TYPE_CHECKING:
    from symgen.run.layout.compiled import Array, CompiledModel
    from symgen.run.single.simulation import Simulation


def set_modes(simulation: Simulation, modes: Mapping[str, tuple[float, float, float, float]]) -> None:
    """Set modes of rows from the present state on, see `begin_in_modes`.

    A row that is switched on has to hold at the present state: close it before. Rows that depend on others are chosen
    among the rows in force.

    Parameters
    ----------
    simulation : Simulation
        A run between two entries of its loop.
    modes : mapping of str to (float, float, float, float)
        By names of rows: 1 in force or 0 off, the value that the measure is held at beyond the described one, a sign,
        and the largest effort in force.

    Raises
    ------
    InputError
        If a row cannot be off, or a number is none of these.
    """
    compiled, w = simulation.compiled, simulation.state.w
    info = compiled.info
    places = {info.rows[row].name: k for k, row in enumerate(info.switchable)}
    for name, (held, constant, sign, limit) in modes.items():
        if name not in places:
            raise InputError("modes", "a row that may be off", name, suggest(name, places))
        if held not in (0.0, 1.0) or sign not in (-1.0, 0.0, 1.0) or not np.isfinite(constant + limit):
            expected = "1 or 0, a finite value, a sign of -1, 0 or 1 and a finite effort"
            raise InputError(f"modes.{name}", expected, f"{held:g}, {constant:g}, {sign:g}, {limit:g}")
    for name, mode in modes.items():
        compiled.modes(w)[places[name]] = (*mode, 0.0)
    begin_in_modes(simulation)


def begin_in_modes(simulation: Simulation) -> None:
    """Have a run go on in the modes of its rows; the scheme begins anew, the counts and the balance go on.

    Parameters
    ----------
    simulation : Simulation
        A run between two entries of its loop.
    """
    compiled, state = simulation.compiled, simulation.state
    if _follow(compiled, state, float(state.clock[abi.TIME])):
        simulation.scheme = simulation.integrator.setup(compiled, simulation.spec, state.w).scheme
    remember_rank(simulation.sizes, state)
    look_anew(state)


def _follow(compiled: CompiledModel, state: Any, now: float) -> bool:
    """Evaluate the geometry in new modes; return whether other redundant rows are left out."""
    geometry = bind_arguments(compiled.model.geometry, abi.MEASURE, now, state.y, state.p, state.w)
    geometry(now)
    changed = _choose(compiled, state.w)
    if changed:
        geometry(now)
    return changed


def _choose(compiled: CompiledModel, w: Array) -> bool:
    """Mask the rows that depend on others in force at the position of w; return whether other rows are masked.

    Rows of too large mechanisms stay the same.
    """
    info, layout, mask = compiled.info, layout_of_starts(compiled), compiled.section(w, "mask")
    room, before = np.zeros(room_of_choice(info.m, info.nv)), mask.copy()
    if not len(room):
        return False
    rank = int(compiled_form(farthest_row)(layout, info.nv, info.m, SKIP, 1, w, room))
    redundant = info.m - len(compiled.off(w)) - rank
    mask[:] = 0.0
    if redundant > 0:
        compiled_form(choose_rows)(layout, info.m - redundant, 1, w, room)
    return not np.array_equal(mask, before)
