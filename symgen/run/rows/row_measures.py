"""Formulas of runs, and the entries of D, at the outputs that loops over rows have left."""

from __future__ import annotations

import math

from symgen.compile.loopcode.loop_instances import compiled_loop
from symgen.compile.native.annotations import Array, Cube, Integers, Matrix, Record, signature_from
from symgen.run.layout import abi
from symgen.run.layout import ensemble_abi as e
from symgen.run.layout.records import Span
from symgen.run.loops.seams import Seams, parameters_at, select_row


class Left(Record):
    """Results of the runs of an ensemble, and working memory.

    Attributes
    ----------
    times : Array, shape (1, times) or (runs, times)
        Output times, of all runs or of each [s].
    selected : Array of int64
        Runs.
    seen : Array, shape (runs, columns, times)
        Results; nan at times that a run did not reach.
    first : int
        The first column that is copied.
    places : Array of int64
        Destination of each column from there on: (array, index), flat.
    ps, ws : Array, shapes (runs, np), (runs, nw)
        Parameters at the start, and scratch, which is overwritten.
    y, rates : Array, shape (ny,), p (shape (np,))
        Working memory.
    """

    times: Matrix
    selected: Integers
    seen: Cube
    first: int
    places: Integers
    ps: Matrix
    ws: Matrix
    y: Array
    rates: Array
    p: Array


#: What changes the parameters of runs: `symgen.run.loops.seams.Seams`, and ``prepare`` of model and law.
Changing = tuple[Seams, Span, e.Prepare, e.Prepare]


def bring_output(columns: Cube, r: int, k: int, first: int, places: Integers, y: Array, rates: Array, w: Array) -> bool:
    """Copy results of a run at an output to the arguments of functions; return whether the run reached it."""
    for c in range(places.shape[0] // 2):
        value, at = columns[r, first + c, k], places[2 * c + 1]
        if places[2 * c] == e.OF_Y:
            y[at] = value
        elif places[2 * c] == e.OF_RATES:
            rates[at] = value
        else:
            w[at] = value
    reached = True
    for i in range(y.shape[0]):
        reached = reached and not math.isnan(y[i])
    return reached


def measure_each(model: tuple[Left, Changing, abi.Observe, abi.Measure], values: Cube, at: int, entries: Cube) -> int:
    """Evaluate formulas of a run, and the entries of D that vary, at all outputs of runs.

    Parameters
    ----------
    model : tuple
        A `Left`, what changes parameters, a function of the formulas, and ``geometry`` (`symgen.run.layout.abi`).
    values : Array, shape (runs, times, numbers)
        Written; nan at times that a run did not reach.
    at : int
        Where the entries begin in ``w``.
    entries : Array, shape (runs, times, entries)
        Written likewise; without runs where they are not requested.
    """
    left, (seams, span, prepare, prepare_law), observe, geometry = model
    times, selected, columns, first, places, ps, ws, y, rates, p = left
    for s in range(selected.shape[0]):
        r, passed = selected[s], 0
        select_row(seams, r)
        for i in range(p.shape[0]):
            p[i] = ps[r, i]
        for k in range(times.shape[1]):
            reached = bring_output(columns, r, k, first, places, y, rates, ws[r])
            t = times[r if times.shape[0] > 1 else 0, k]
            if reached:
                passed = parameters_at(seams, span, prepare, prepare_law, t, passed, p)
            if reached and values.shape[2] > 0:
                observe(t, y, p, ws[r], rates, values[r, k])
            for i in range(0 if reached else values.shape[2]):
                values[r, k, i] = math.nan
            if entries.shape[0] > 0:
                if reached:
                    geometry(t, y, p, ws[r])
                for i in range(entries.shape[2]):
                    entries[r, k, i] = ws[r, at + i] if reached else math.nan
    return 0


#: The loop over rows, compiled.
measure_rows = compiled_loop(__name__, "measure_rows", measure_each, signature_from(measure_each))
