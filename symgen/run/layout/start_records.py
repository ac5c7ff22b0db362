"""Records of the compiled functions of a start: the model's layout, an instant of a run, working memory."""

from __future__ import annotations

from collections import namedtuple
from typing import Any, NamedTuple

import numpy as np

from symgen.compile.native import types
from symgen.run.layout import abi

_F, _N, _A, _I = types.float64, types.int64, types.float64[::1], types.int64[::1]


def record_type(name: str, module: str, *kinds: tuple[str, types.Kind]) -> types.RecordType:
    """Return the type of a named tuple in compiled code; the class of the tuple is its `made`.

    Parameters
    ----------
    name, module : str
        Of the class.
    *kinds : (str, Kind)
        Names and type of fields.
    """
    fields = [(field, kind) for names, kind in kinds for field in names.split()]
    names = [field for field, _ in fields]
    return types.RecordType(tuple(kind for _, kind in fields), namedtuple(name, names, module=module))


#: Layout of a model for the functions of a start.
#: - t: Time of the start [s].
#: - nq, nv, ny, m, windings: Coordinates, velocities, length of the state, constraint rows, angles whose turns are
#:   counted.
#: - sparse, ask_light: 1 where ``spread`` computes the shortest changes in the metric of the gauge; where too light
#:   bodies are reported.
#: - mass, residual, nu, jacobian, pivot, mask, change, gauge, row_weight: First indices of these sections of w.
#: - entries (shape (3 k,)): (row, column, slot or -1) of D's structural entries.
#: - constants (shape (k,)): Their values where they have no slot.
#: - massless, unchanged, fixed (shape (nv,)): 1 where a mass of 0 is described; where a velocity must not change;
#:   where the coordinate that it changes stays as described.
#: - held (shape (2 h,)): (coordinate, velocity) of each held coordinate.
#: - rows (shape (2 m,)): (joint, 0 for a row that is an angle or a number) of each row.
#: - alone (shape (m,)): 1 for rows that are never left out, see `symgen.run.layout.compiled.ModelInfo`.
#: - switches (shape (m,)): Places in w of `held` of rows that may be off, -1 for others.
#: - spin (shape (nv,)): The body's first angular velocity for an angular velocity, -1 for others.
#: - lengths (shape (nq,)): 1 for coordinates that are lengths, else 0.
#: - datum (shape (nq,)): What coordinates are measured from, see `symgen.describe.facts.lengths.datum_of`.
#: - branches (shape (windings,)): Known values of angles whose turns are counted; nan where turns are chosen.
LAYOUT = record_type(
    "Layout",
    __name__,
    ("t", _F),
    ("nq nv ny m windings sparse ask_light", _N),
    ("mass residual nu jacobian pivot mask change gauge row_weight", _N),
    ("entries", _I),
    ("constants", _A),
    ("massless unchanged fixed held rows alone switches spin", _I),
    ("lengths datum branches", _A),
)
Layout: Any = LAYOUT.constructor


#: Arguments of emitted functions: a state y, prepared parameters p and scratch w.
INSTANT = record_type("Instant", __name__, ("y p w", _A))
Instant: Any = INSTANT.constructor


#: Conditions on the start of a run, and its summary.
#: - velocities (shape (nv,)): Velocities; nan where they are to be completed.
#: - targets (shape (h,)): Values of the held coordinates.
#: - summary (shape (N_SUMMARY,)): The columns of the start are set; see `symgen.run.layout.ensemble_abi`.
START_CONDITIONS = record_type("StartConditions", __name__, ("velocities targets summary", _A))
StartConditions: Any = START_CONDITIONS.constructor


class Closing(NamedTuple):
    """Functions called at a start: emitted ones, and a solver of `symgen.run.starts.start_solvers`.

    ``geometry`` comes before ``measure`` and ``spread`` at the same state.
    """

    geometry: Any
    measure: Any
    move: Any
    spread: Any
    solve: Any


#: Working memory, the same for all rows.
#: - right, x, scale (shapes (m,), (nv,), (nv,)): A least-norm problem: D x = right with x / scale shortest; `right`
#:   is overwritten.
#: - first, direction (shapes (nq,), (ny,)): Coordinates at the beginning of a path; a direction, or rates.
#: - y, w (shapes (ny,), (nw,)): Another state with its scratch.
#: - numbers: Of the least-norm solver, or of the choice of turns.
#: - order, counters: Order of rows; counters for calls of ``rhs``.
WORK = record_type("Work", __name__, ("right x scale first direction y w numbers", _A), ("order counters", _I))
Work: Any = WORK.constructor


def new_work(layout: Layout, nw: int) -> Work:
    """Return working memory for a model whose scratch has `nw` numbers."""
    n, m, k = layout.nv, layout.m, layout.windings
    ny = layout.ny
    solver = 2 * (m + n) if layout.sparse else m * n + m * m + 2 * m + n
    sizes = m, n, n, layout.nq, ny, ny, nw, max(solver, m * k + 2 * k + m)
    integers = (np.zeros(size, dtype=np.int64) for size in (m, abi.N_COUNTERS))
    return Work._make((*(np.zeros(size) for size in sizes), *integers))


#: solve(spread, layout, now, work): see `symgen.run.starts.start_solvers`.
SOLVE = types.FunctionType(types.int64(abi.MOVE, LAYOUT, INSTANT, WORK))
#: turns(geometry, measure, layout, now, work): see `symgen.run.starts.start_solvers`.
TURNS = types.FunctionType(types.int64(abi.MEASURE, abi.MEASURE, LAYOUT, INSTANT, WORK))
#: A model for `symgen.run.starts.starting.close_row`: its layout, functions of a `Closing`, choice of turns and
#: ``rhs``.
MODEL = types.RecordType((LAYOUT, abi.MEASURE, abi.MEASURE, abi.MOVE, abi.MOVE, SOLVE, TURNS, abi.RHS))
