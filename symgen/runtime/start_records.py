"""What the compiled functions of a start work on: the model's layout, an instant of a run, working memory."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from symgen.native import types
from symgen.runtime import abi


class Layout(NamedTuple):
    """What the functions of a start have to know about a model.

    Attributes
    ----------
    t : float
        Time of the start [s].
    nq, nv, ny, m, windings : int
        Coordinates, velocities, length of the state, constraint rows, angles whose turns are counted.
    sparse, ask_light : int
        1 where ``spread`` gives the changes that are shortest in the metric of the gauge; where it shall be said
        whether bodies are too light.
    mass, residual, nu, jacobian, pivot, mask, change, gauge, row_weight : int
        Where these sections of w begin.
    entries : Array of int, shape (3 k,)
        (row, column, slot or -1) of D's structural entries.
    constants : Array, shape (k,)
        Their values where they have no slot.
    massless, kept, fixed : Array of int, shape (nv,)
        1 where a mass of 0 is described; where a given velocity may not be changed; where the coordinate that it
        changes stays as described.
    held : Array of int, shape (2 h,)
        (coordinate, velocity) of each coordinate that is held.
    rows : Array of int, shape (2 m,)
        (joint, 0 for a row that is an angle or a number) of each row.
    alone : Array of int, shape (m,)
        1 for rows that are never left out, see `symgen.runtime.compiled.ModelInfo`.
    spin : Array of int, shape (nv,)
        The body's first angular velocity for an angular velocity, -1 for others.
    lengths : Array, shape (nq,)
        1 for coordinates that are lengths, else 0.
    branches : Array, shape (windings,)
        Angles whose turns are counted as they are known to be; nan where turns are chosen.
    """

    t: float
    nq: int
    nv: int
    ny: int
    m: int
    windings: int
    sparse: int
    ask_light: int
    mass: int
    residual: int
    nu: int
    jacobian: int
    pivot: int
    mask: int
    change: int
    gauge: int
    row_weight: int
    entries: Any
    constants: Any
    massless: Any
    kept: Any
    fixed: Any
    held: Any
    rows: Any
    alone: Any
    spin: Any
    lengths: Any
    branches: Any


class Instant(NamedTuple):
    """A state y, prepared parameters p and scratch w: what emitted functions take."""

    y: Any
    p: Any
    w: Any


class StartConditions(NamedTuple):
    """What is asked of the start of a run, and what is said of it.

    Attributes
    ----------
    given : Array, shape (nv,)
        Velocities; nan where they are to be completed.
    targets : Array, shape (h,)
        Values of the held coordinates.
    summary : Array, shape (N_SUMMARY,)
        The columns of the start are set; see `symgen.runtime.ensemble_abi`.
    """

    given: Any
    targets: Any
    summary: Any


class Closing(NamedTuple):
    """What the pieces of a start call: emitted functions, and a solver of `symgen.runtime.least_norm`.

    ``geometry`` comes before ``measure`` and ``spread`` at the same state.
    """

    geometry: Any
    measure: Any
    move: Any
    spread: Any
    solve: Any


class Work(NamedTuple):
    """Working memory, the same for all rows.

    Attributes
    ----------
    right, x, scale : Array, shapes (m,), (nv,), (nv,)
        A least-norm problem: D x = right with x / scale shortest; `right` is overwritten.
    first, direction : Array, shapes (nq,), (ny,)
        Coordinates from which others are reached; a direction, or rates.
    y, w : Array, shapes (ny,), (nw,)
        Another state with its scratch.
    numbers : Array
        Of the least-norm solver, or of the choice of turns.
    order, counters : Array of int
        Order of rows; counters for calls of ``rhs``.
    """

    right: Any
    x: Any
    scale: Any
    first: Any
    direction: Any
    y: Any
    w: Any
    numbers: Any
    order: Any
    counters: Any


def new_work(layout: Layout, nw: int) -> Work:
    """Return working memory for a model whose scratch has `nw` numbers."""
    n, m, k = layout.nv, layout.m, layout.windings
    ny = layout.ny
    solver = 2 * (m + n) if layout.sparse else m * n + m * m + 2 * m + n
    sizes = m, n, n, layout.nq, ny, ny, nw, max(solver, m * k + 2 * k + m)
    integers = (np.zeros(size, dtype=np.int64) for size in (m, abi.N_COUNTERS))
    return Work._make((*(np.zeros(size) for size in sizes), *integers))


_A, _I = types.float64[::1], types.int64[::1]
LAYOUT = types.RecordType((types.float64, *(types.int64,) * 16, _I, _A, *(_I,) * 7, _A, _A), Layout)
INSTANT = types.RecordType((_A,) * 3, Instant)
ASKED = types.RecordType((_A,) * 3, StartConditions)
WORK = types.RecordType((*(_A,) * 8, _I, _I), Work)
#: solve(spread, layout, now, work): see `symgen.runtime.least_norm`.
SOLVE = types.FunctionType(types.int64(abi.MOVE, LAYOUT, INSTANT, WORK))
#: turns(geometry, measure, layout, now, work): see `symgen.runtime.turning`.
TURNS = types.FunctionType(types.int64(abi.MEASURE, abi.MEASURE, LAYOUT, INSTANT, WORK))
#: A model as `symgen.runtime.starting.close_row` takes it: its layout, what a `Closing` is made of, the choice of turns
#: and ``rhs``.
MODEL = types.RecordType((LAYOUT, abi.MEASURE, abi.MEASURE, abi.MOVE, abi.MOVE, SOLVE, TURNS, abi.RHS))
