"""Consistent starts of many runs in compiled code: what `symgen.runtime.assembly` does for one, without Python.

A run may hold coordinates at values of its own. Closing then begins at the described start and moves the held
coordinates to their values in small steps, each closed by moving the others, so that the mechanism keeps the branch it
was described in. What cannot be closed is a row with its reason, not an error.
"""

from __future__ import annotations

import math
from typing import Any

from numba import types

from symgen.runtime import abi
from symgen.runtime import ensemble_abi as e
from symgen.runtime.bare import bare, part
from symgen.runtime.closing import close_positions, complete_velocities, is_light, largest_of, mask_redundant
from symgen.runtime.turning import choose_turns
from symgen.store.jit import jit

_F8, _I8 = types.float64, types.int64
_A, _I = types.float64[::1], types.int64[::1]

_NQ, _NV, _M, _NP, _NW, _LIGHT_CHECK = e.NQ, e.NV, e.M, e.NP, e.NW, e.LIGHT_CHECK
_STRICT, _MASS, _RESIDUAL, _PIVOTS, _MASK, _ASSEMBLED = e.STRICT, e.MASS, e.RESIDUAL, e.PIVOTS, e.MASK, e.ASSEMBLED
_UNDEFINED, _NO_MASS, _OPEN, _CONTRADICTION, _MOVED, _PROJECTED = (
    e.UNDEFINED,
    e.NO_MASS,
    e.OPEN,
    e.CONTRADICTION,
    e.MOVED,
    e.PROJECTED,
)
_N_SUMMARY, _STOP, _LENGTH, _SPEED = e.N_SUMMARY, abi.STOP, abi.LENGTH, abi.SPEED
_S_START, _S_MOVED, _S_VELOCITIES = (e.SUMMARY.index("start" + end) for end in ("", "_moved", "_velocities"))
_S_WHERE, _S_SIZE = e.SUMMARY.index("start_where"), e.SUMMARY.index("start_size")
_S_REDUNDANT, _S_LIGHT = e.SUMMARY.index("redundant_rows"), e.SUMMARY.index("light")
_WINDINGS = e.WINDINGS
#: Held coordinates go to their values in steps of at most this [m or rad], but in no more than so many steps.
_STRIDE, _MOST_STRIDES = 0.1, 2000


@jit(
    _I8(
        *(e.PREPARE, e.PREPARE, abi.MOVE, abi.MEASURE, abi.MEASURE, abi.MOVE, e.SOLVE, abi.RHS),
        *(_I, _I, _A, _I, _I, _I, _I),
        *(_A, _A, _A, _A, _A, _A, _A),
        *(_I, _I, _I, _A),
    )
)
def close_runs(
    prepare_model: Any,
    prepare_law: Any,
    masses: Any,
    geometry: Any,
    measure: Any,
    move: Any,
    solve: Any,
    rhs: Any,
    sizes: Any,
    table: Any,
    constants: Any,
    joints: Any,
    massless: Any,
    held: Any,
    selected: Any,
    targets: Any,
    q: Any,
    v: Any,
    ps: Any,
    ys: Any,
    ws: Any,
    summary: Any,
    iw: Any,
    order: Any,
    control: Any,
    room: Any,
) -> int:
    """Close the starts of the selected rows; all arrays of rows are flat.

    Parameters
    ----------
    prepare_model, prepare_law, masses, geometry, measure, move, rhs : emitted functions
        See `symgen.runtime.abi`.
    solve : compiled function
        `symgen.runtime.closing.correct`.
    sizes : Array of int
        See `symgen.runtime.ensemble_abi`.
    table, constants : Array
        Structural entries of D: (row, column, slot or -1) and constants, as `ModelInfo.jacobian`.
    joints : Array of int, shape (m,)
        Joint of each row.
    massless : Array of int, shape (nv,)
        1 where a mass of 0 was described.
    held : Array of int
        (coordinate, velocity, ...) of the coordinates that rows hold.
    selected : Array of int
        Rows to close.
    targets : Array, shape (k, held coordinates)
        Values of the held coordinates.
    q, v : Array, shapes (k, nq), (k, nv)
        Described coordinates, and given velocities; nan where they are to be completed.
    ps : Array, shape (k, np)
        Parameters; prepared on return.
    ys, ws : Array, shapes (k, ny), (k, nw)
        Starts: states and scratch.
    summary : Array, shape (k, N_SUMMARY)
        The columns of the start are set.
    iw, order, control, room : Array
        Counters, working memory for m integers, what the watching thread shares, working memory.

    Returns
    -------
    int
        Rows that were worked on: all of them, unless the run was stopped.
    """
    nq, n, m, nw, np_ = sizes[_NQ], sizes[_NV], sizes[_M], sizes[_NW], sizes[_NP]
    ny = nq + n + 1
    n_held = held.shape[0] // 2
    ys, ps, ws, room, iw, order = bare(ys), bare(ps), bare(ws), bare(room), bare(iw), bare(order)
    sizes, table, constants, summary = bare(sizes), bare(table), bare(constants), bare(summary)
    vectors, scale = part(room, 0, n + m), part(room, n + m, n)
    described = part(room, 2 * n + m, nq)
    probe = part(room, 2 * n + m + nq, 2 * ny + nw)
    dense = part(room, 2 * n + m + nq + 2 * ny + nw, m * n + m * min(m, n) + m + n)
    for s in range(selected.shape[0]):
        if control[_STOP] != 0:
            return int(s)
        r = selected[s]
        y, p, w = part(ys, r * ny, ny), part(ps, r * np_, np_), part(ws, r * nw, nw)
        row = part(summary, r * _N_SUMMARY, _N_SUMMARY)
        for i in range(nw):
            w[i] = 0.0
        for i in range(m):
            w[sizes[_PIVOTS] + i] = 1.0
        for i in range(ny):
            y[i] = 0.0
        finite = True
        for i in range(nq):
            y[i] = q[r * nq + i]
            described[i] = y[i]
            finite = finite and math.isfinite(y[i])
        prepare_model(p)
        prepare_law(p)
        masses(p, w)
        code = _ASSEMBLED if finite else _UNDEFINED
        for j in range(n):
            if code == _ASSEMBLED and massless[j] == 0 and not w[sizes[_MASS] + j] > 0.0:
                code = _NO_MASS
                row[_S_WHERE], row[_S_SIZE] = j, w[sizes[_MASS] + j]
        for i in range(np_):
            if code == _ASSEMBLED and not math.isfinite(p[i]):
                code = _UNDEFINED
        for j in range(n):
            scale[j] = 1.0
        if code == _ASSEMBLED:
            choose_turns(geometry, measure, y, p, w, sizes)
        if code == _ASSEMBLED and not close_positions(
            geometry, measure, move, solve, y, p, w, sizes, scale, table, constants, vectors, dense, order
        ):
            code = _OPEN
        moved = 0.0
        for i in range(nq):
            moved = max(moved, abs(y[i] - described[i]))
        row[_S_MOVED] = moved
        if code == _ASSEMBLED and n_held > 0:
            stride = 0.0
            for i in range(n_held):
                described[i] = y[held[2 * i]]
                scale[held[2 * i + 1]] = 0.0
                stride = max(stride, abs(targets[r * n_held + i] - described[i]))
            strides = int(min(max(1.0, math.ceil(stride / _STRIDE)), _MOST_STRIDES))
            for k in range(strides):
                share = (k + 1.0) / strides
                for i in range(n_held):
                    y[held[2 * i]] = described[i] + share * (targets[r * n_held + i] - described[i])
                    if k == strides - 1:
                        y[held[2 * i]] = targets[r * n_held + i]
                if sizes[_WINDINGS] > 0:
                    measure(0.0, y, p, w)
                if not close_positions(
                    geometry, measure, move, solve, y, p, w, sizes, scale, table, constants, vectors, dense, order
                ):
                    code = _OPEN
                    break
        if code == _OPEN:
            worst = -1.0
            for i in range(m):
                # all rows of a joint count, and the first joint wins a tie, as for a single run
                size = 0.0
                for k in range(m):
                    if joints[k] == joints[i]:
                        size = math.hypot(size, w[sizes[_RESIDUAL] + k])
                if not math.isfinite(size):
                    size = math.inf
                if size > worst:
                    worst = size
                    row[_S_WHERE], row[_S_SIZE] = joints[i], size
        if code == _ASSEMBLED:
            given = part(v, r * n, n)
            velocities = complete_velocities(solve, y, given, w, sizes, scale, table, constants, vectors, dense, order)
            row[_S_VELOCITIES] = 1.0 if velocities == _PROJECTED else 0.0
            if velocities == _CONTRADICTION:
                code = _CONTRADICTION
            elif sizes[_STRICT] == 1 and n_held == 0 and moved > 1e-9 * largest_of(q[r * nq : r * nq + nq], nq):
                code = _MOVED
            elif sizes[_STRICT] == 1 and velocities == _PROJECTED:
                code = _PROJECTED
        if code == _ASSEMBLED:
            mask_redundant(
                geometry, measure, move, solve, y, p, w, probe, sizes, scale, table, constants, vectors, dense, order
            )
            for i in range(m):
                row[_S_REDUNDANT] += 0.0 if w[sizes[_MASK] + i] == 0.0 else 1.0
            w[_LENGTH] = largest_of(y, nq)
            w[_SPEED] = largest_of(part(y, nq, n), n)
            if sizes[_LIGHT_CHECK] == 1 and is_light(rhs, geometry, y, p, w, probe, sizes, iw):
                row[_S_LIGHT] = 1.0
        row[_S_START] = code
    return int(selected.shape[0])


@jit(types.int64(_F8, _A, _A, _A))
def follow_nothing(t: float, y: Any, p: Any, w: Any) -> int:
    """Stand in for the emitted ``measure`` where no angle counts turns, so that it is not compiled."""
    return 0
