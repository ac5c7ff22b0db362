"""Records of the compiled functions of a start: the model's layout, an instant of a run, working memory."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from symgen.compile.native.annotations import Array, Integers, Record, function_type
from symgen.run.layout import abi


class Layout(Record):
    """Layout of a model for the functions of a start.

    Attributes
    ----------
    t : float
        Time of the start [s].
    nq, nv, ny, m, windings : int
        Coordinates, velocities, length of the state, constraint rows, angles whose turns are counted.
    sparse, ask_light : int
        1 where ``spread`` computes the shortest changes in the metric of the gauge; where too light bodies are
        reported.
    mass, residual, nu, jacobian, pivot, mask, change, gauge, row_weight : int
        First indices of these sections of w.
    entries : Array of int64, shape (3 k,)
        (row, column, slot or -1) of D's structural entries.
    constants : Array, shape (k,)
        Their values where they have no slot.
    massless, unchanged, fixed : Array of int64, shape (nv,)
        1 where a mass of 0 is described; where a velocity must not change; where the coordinate that it changes
        stays as described.
    held : Array of int64, shape (2 h,)
        (coordinate, velocity) of each held coordinate.
    rows : Array of int64, shape (2 m,)
        (joint, 0 for a row that is an angle or a number) of each row.
    alone : Array of int64, shape (m,)
        1 for rows that are never left out, see `symgen.run.layout.compiled.ModelInfo`.
    switches : Array of int64, shape (m,)
        Places in w of `held` of rows that may be off, -1 for others.
    spin : Array of int64, shape (nv,)
        The body's first angular velocity for an angular velocity, -1 for others.
    lengths : Array, shape (nq,)
        1 for coordinates that are lengths, else 0.
    datum : Array, shape (nq,)
        What coordinates are measured from, see `symgen.describe.facts.lengths.origin_of_sizes`.
    branches : Array, shape (windings,)
        Known values of angles whose turns are counted; nan where turns are chosen.
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
    entries: Integers
    constants: Array
    massless: Integers
    unchanged: Integers
    fixed: Integers
    held: Integers
    rows: Integers
    alone: Integers
    switches: Integers
    spin: Integers
    lengths: Array
    datum: Array
    branches: Array


class Instant(Record):
    """Arguments of emitted functions: a state y, prepared parameters p and scratch w."""

    y: Array
    p: Array
    w: Array


class StartConditions(Record):
    """Conditions on the start of a run, and its summary.

    Attributes
    ----------
    velocities : Array, shape (nv,)
        Velocities; nan where they are to be completed.
    targets : Array, shape (h,)
        Values of the held coordinates.
    summary : Array, shape (N_SUMMARY,)
        The columns of the start are set; see `symgen.run.layout.ensemble_abi`.
    """

    velocities: Array
    targets: Array
    summary: Array


class MassTable(Record):
    """What formulas give of M (`symgen.run.starts.masses`).

    Attributes
    ----------
    rotors : int
        Number of rotors.
    places : Array of int64, shape (2 e,)
        (row, column) of each entry; empty where M counts as diagonal.
    """

    rotors: int
    places: Integers


class Closing(Record):
    """Functions called at a start: emitted ones, and a solver of `symgen.run.starts.start_solvers`.

    ``geometry`` comes before ``measure`` and ``spread`` at the same state. `masses`, `formulas` and `project` are those
    of an M that is not diagonal (`symgen.run.starts.masses`).
    """

    geometry: abi.Measure
    measure: abi.Measure
    move: abi.Move
    spread: abi.Move
    solve: Solve
    masses: MassTable
    formulas: abi.Observe
    project: Project


class Work(Record):
    """Working memory, the same for all rows.

    Attributes
    ----------
    right, x, scale : Array, shapes (m,), (nv,), (nv,)
        A least-norm problem: D x = right with x / scale shortest; `right` is overwritten.
    first, direction : Array, shapes (nq,), (ny,)
        Coordinates at the beginning of a path; a direction, or rates.
    y, w : Array, shapes (ny,), (nw,)
        Another state with its scratch.
    numbers : Array
        Memory of the least-norm solver, or of the choice of turns.
    order, counters : Array of int64
        Order of rows; counters for calls of ``rhs``.
    """

    right: Array
    x: Array
    scale: Array
    first: Array
    direction: Array
    y: Array
    w: Array
    numbers: Array
    order: Integers
    counters: Integers


def new_work(layout: Layout, nw: int, numbers: int = 0, integers: int = 0) -> Work:
    """Return working memory for a model whose scratch has `nw` numbers, with room for at least so many others."""
    n, m, k = layout.nv, layout.m, layout.windings
    ny = layout.ny
    solver = 2 * (m + n) if layout.sparse else m * n + m * m + 2 * m + n
    sizes = m, n, n, layout.nq, ny, ny, nw, max(solver, m * k + 2 * k + m, numbers)
    counts = (np.zeros(size, dtype=np.int64) for size in (max(m, integers), abi.N_COUNTERS))
    return Work._make((*(np.zeros(size) for size in sizes), *counts))


#: solve(spread, layout, now, work): see `symgen.run.starts.start_solvers`.
Solve = Callable[[abi.Move, Layout, Instant, Work], int]
#: project(formulas, masses, layout, now, work): see `symgen.run.starts.masses`.
Project = Callable[[abi.Observe, MassTable, Layout, Instant, Work], int]
#: turns(geometry, measure, layout, now, work): see `symgen.run.starts.start_solvers`.
Turns = Callable[[abi.Measure, abi.Measure, Layout, Instant, Work], int]
SOLVE, PROJECT, TURNS = function_type(Solve), function_type(Project), function_type(Turns)
#: A model for `symgen.run.starts.starting.close_row`: its layout, what a `Closing` has, choice of turns and
#: ``rhs``.
StartModel = tuple[
    Layout, MassTable, abi.Measure, abi.Measure, abi.Move, abi.Move, Solve, abi.Observe, Project, Turns, abi.Rhs
]
