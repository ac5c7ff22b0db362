"""Functions of the motion at outputs of a run: rates, multipliers, joint coordinates, formulas."""

from __future__ import annotations

import math

from symgen.compile.loopcode.bare import part
from symgen.compile.native.annotations import Array, Integers, Matrix
from symgen.compile.store.jit import jit
from symgen.run.layout import abi
from symgen.run.layout.records import Observed, Outputs, Sizes

#: Outputs at which the balance of forces is evaluated at most, and evaluations of a run for each of them but the first.
_BALANCES, _EVALUATIONS = 8, 1000


@jit()
def put_output(sizes: Sizes, outputs: Outputs, k: int, y: Array, w: Array) -> None:
    """Set `y` and the angles in `w` to their values at an output."""
    for i in range(sizes.ny):
        y[i] = outputs.states[k, i]
    for i in range(outputs.status.shape[1] - abi.N_STATUS):
        w[abi.WINDING + i] = outputs.status[k, abi.N_STATUS + i]


@jit(entry=True)
def observe_rates(
    model: tuple[Sizes, abi.Rhs, abi.Rhs, abi.Accept],
    outputs: Outputs,
    count: int,
    p: Array,
    w: Array,
    iw: Integers,
    observed: Observed,
    room: Array,
) -> int:
    """Evaluate v' and lambda at outputs.

    Parameters
    ----------
    model : tuple
        Its sizes, and ``rates`` or ``rhs``, ``confirm`` and ``accept`` (`symgen.run.layout.abi`).
    outputs : Outputs
        In the order of time.
    count : int
        Number of outputs.
    p, w, iw : Array
        Arguments of emitted functions, scratch and counters as at the start of the run.
    observed : Observed
        Receives accelerations and multipliers.
    room : Array
        Working memory for two states.
    """
    sizes, rates, confirm, accept = model
    y, rate = part(room, 0, sizes.ny), part(room, sizes.ny, sizes.ny)
    for k in range(count):
        put_output(sizes, outputs, k, y, w)
        accept(outputs.times[k], y, p, w, iw)  # updates the memory of a method: a partition, a basis
        if rates(outputs.times[k], y, p, w, iw, rate) != 0:
            confirm(outputs.times[k], y, p, w, iw, rate)
        for i in range(sizes.nv):
            observed.accelerations[k, i] = rate[sizes.nq + i]
        for i in range(sizes.m):
            observed.multipliers[k, i] = w[sizes.multipliers + i]
    return 0


@jit()
def _size_of_forces(sizes: Sizes, w: Array) -> float:
    """Return the square of forces in the section ``change``, moments over the lengths of bodies."""
    total = 0.0
    for i in range(sizes.nv):
        total += w[sizes.gauge + i] * w[sizes.change + i] ** 2
    return total


@jit()
def left_at_output(
    model: tuple[Sizes, abi.Rhs, abi.Rhs, abi.Accept, abi.Balance],
    outputs: Outputs,
    k: int,
    p: Array,
    w: Array,
    iw: Integers,
    room: Array,
) -> float:
    """Return what v' and lambda of a law leave of the forces at an output, over their terms; 0 where nothing acts."""
    sizes, rates, confirm, accept, balance = model
    y, rate, t = part(room, 0, sizes.ny), part(room, sizes.ny, sizes.ny), outputs.times[k]
    put_output(sizes, outputs, k, y, w)
    accept(t, y, p, w, iw)
    if rates(t, y, p, w, iw, rate) != 0:
        confirm(t, y, p, w, iw, rate)
    balance(t, y, p, w, rate)
    left = _size_of_forces(sizes, w)
    for i in range(sizes.m):
        w[sizes.multipliers + i] = 0.0
    balance(t, y, p, w, rate)
    terms = _size_of_forces(sizes, w)  # of M v' - f, which is D^T lambda where all balances
    for i in range(sizes.nv):
        rate[sizes.nq + i] = 0.0
    balance(t, y, p, w, rate)
    terms += _size_of_forces(sizes, w)
    return math.sqrt(left / terms) if terms > 0.0 else 0.0


@jit()
def number_of_balances(outputs: int, evaluations: int) -> int:
    """Return at how many outputs forces are balanced: the start, and one more for each thousand evaluations of a run.

    An output takes some five evaluations, so that a run takes a percent longer at most.
    """
    return min(outputs, _BALANCES, 1 + evaluations // _EVALUATIONS)


@jit()
def balanced_output(i: int, some: int, outputs: int) -> int:
    """Return the place of one of some outputs that lie from the first to the last."""
    return i * (outputs - 1) // (some - 1) if some > 1 else 0


@jit(entry=True)
def observe_balance(
    model: tuple[Sizes, abi.Rhs, abi.Rhs, abi.Accept, abi.Balance],
    outputs: Outputs,
    count: int,
    evaluations: int,
    first: int,
    last: int,
    p: Array,
    w: Array,
    iw: Integers,
    room: Array,
) -> float:
    """Return the largest |M v' + D^T lambda - f| over its terms at some outputs.

    Parameters
    ----------
    model : tuple
        As for `observe_rates`, then ``balance(t, y, p, w, ydot)``.
    outputs, p, w, iw, room
        As for `observe_rates`.
    count : int
        Number of outputs that the run has reached.
    evaluations : int
        Of the run.
    first, last : int
        First and last output (exclusive) that have these parameters.
    """
    some, largest = number_of_balances(count, evaluations), 0.0
    for i in range(some):
        k = balanced_output(i, some, count)
        if first <= k and k < last:
            left = left_at_output(model, outputs, k, p, w, iw, room)
            largest = left if left > largest else largest
    return largest


@jit(entry=True)
def observe_rows(
    observe: abi.Observe,
    sizes: Sizes,
    outputs: Outputs,
    count: int,
    p: Array,
    w: Array,
    observed: Observed,
    room: Array,
) -> int:
    """Evaluate a function of the motion at outputs: D v' - gamma and joint coordinates, or other quantities.

    Parameters
    ----------
    observe : emitted function
        See `symgen.run.layout.abi`.
    sizes : Sizes
        Of the model.
    outputs, count, p, w
        As for `observe_rates`.
    observed : Observed
        Holds accelerations and multipliers; receives rows, in the order that ``observe`` writes.
    room : Array
        Working memory for two states and a row.
    """
    ny, length = sizes.ny, observed.rows.shape[1]
    y, rate, row = part(room, 0, ny), part(room, ny, ny), part(room, 2 * ny, length)
    for k in range(count):
        put_output(sizes, outputs, k, y, w)
        for i in range(sizes.nv):
            rate[sizes.nq + i] = observed.accelerations[k, i]
        if k < observed.multipliers.shape[0]:  # a device has room for them only where they are requested
            for i in range(sizes.m):
                w[sizes.multipliers + i] = observed.multipliers[k, i]
        observe(outputs.times[k], y, p, w, rate, row)
        for i in range(length):
            observed.rows[k, i] = row[i]
    return 0


@jit(entry=True)
def observe_status(
    geometry: abi.Measure, measure: abi.Measure, sizes: Sizes, outputs: Outputs, p: Array, w: Array, y: Array
) -> int:
    """Measure states, one after the other: the status and the angles that count turns.

    Parameters
    ----------
    geometry, measure : emitted functions
        See `symgen.run.layout.abi`.
    sizes, p, w
        As for `observe_rows`; the scratch holds the angles before the first state.
    outputs : Outputs
        Holds states, and angles that count turns, nan for unknown ones; receives the status.
    y : Array, shape (ny,)
        Working memory.
    """
    for k in range(outputs.times.shape[0]):
        for i in range(sizes.ny):
            y[i] = outputs.states[k, i]
        for i in range(outputs.status.shape[1] - abi.N_STATUS):
            if math.isfinite(outputs.status[k, abi.N_STATUS + i]):
                w[abi.WINDING + i] = outputs.status[k, abi.N_STATUS + i]
        geometry(outputs.times[k], y, p, w)
        measure(outputs.times[k], y, p, w)
        for i in range(abi.N_STATUS):
            outputs.status[k, i] = w[i]
        for i in range(outputs.status.shape[1] - abi.N_STATUS):
            outputs.status[k, abi.N_STATUS + i] = w[abi.WINDING + i]
    return 0


@jit(entry=True)
def observe_scratch(
    geometry: abi.Measure,
    sizes: Sizes,
    outputs: Outputs,
    p: Array,
    w: Array,
    places: Integers,
    rows: Matrix,
    y: Array,
) -> int:
    """Copy parts of the scratch array, as ``geometry`` leaves it at states, side by side into rows.

    Parameters
    ----------
    geometry, sizes, p, w
        As for `observe_status`.
    outputs : Outputs
        Holds states, and angles that count turns.
    places : Array of int64, shape (2 n,)
        First element and length of each part.
    rows : Matrix
        Receives the parts, a row for each state.
    y : Array, shape (ny,)
        Working memory.
    """
    for k in range(outputs.times.shape[0]):
        put_output(sizes, outputs, k, y, w)
        geometry(outputs.times[k], y, p, w)
        at = 0
        for i in range(places.shape[0] // 2):
            first = places[2 * i]
            for j in range(places[2 * i + 1]):
                rows[k, at] = w[first + j]
                at += 1
    return 0


@jit(entry=True)
def observe_with_rates(
    model: tuple[Sizes, abi.Rhs, abi.Rhs, abi.Accept, abi.Observe],
    outputs: Outputs,
    p: Array,
    w: Array,
    iw: Integers,
    rows: Matrix,
    room: Array,
) -> int:
    """Evaluate a function of states with the rates and multipliers of the law there: all of them with directions.

    Parameters
    ----------
    model : tuple
        As for `observe_rates`, then the function.
    outputs, p, w, iw
        As for `observe_rates`.
    rows : Matrix
        Receives what the function writes, a row for each state.
    room : Array
        Working memory for two states and a row.
    """
    sizes, rates, confirm, accept, observe = model
    ny, length = sizes.ny, rows.shape[1]
    y, rate, row = part(room, 0, ny), part(room, ny, ny), part(room, 2 * ny, length)
    for k in range(outputs.times.shape[0]):
        put_output(sizes, outputs, k, y, w)
        accept(outputs.times[k], y, p, w, iw)
        if rates(outputs.times[k], y, p, w, iw, rate) != 0:
            confirm(outputs.times[k], y, p, w, iw, rate)
        observe(outputs.times[k], y, p, w, rate, row)
        for i in range(length):
            rows[k, i] = row[i]
    return 0
