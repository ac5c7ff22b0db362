"""Pieces of consistent starts in compiled code: what `symgen.runtime.assembly` does with NumPy, for one row.

D is dense here, and its least-norm solutions are those of `symgen.runtime.least_norm`.
"""

from __future__ import annotations

import math
from typing import Any

from numba import types

from symgen.runtime import ensemble_abi as e
from symgen.runtime.bare import part
from symgen.runtime.least_norm import least_norm
from symgen.store.jit import jit

_A, _I = types.float64[::1], types.int64[::1]
_NQ, _NV, _M, _NW, _SPATIAL, _MASS = e.NQ, e.NV, e.M, e.NW, e.SPATIAL, e.MASS
_RESIDUAL, _NU, _JACOBIAN, _PIVOTS, _MASK, _CHANGE = e.RESIDUAL, e.NU, e.JACOBIAN, e.PIVOTS, e.MASK, e.CHANGE
_ASSEMBLED, _CONTRADICTION, _PROJECTED = e.ASSEMBLED, e.CONTRADICTION, e.PROJECTED
_WINDINGS = e.WINDINGS
#: As in `symgen.runtime.assembly`.
_SKIP, _ITERATIONS = 1e-12, 60


@jit()
def _rows(d: Any, sizes: Any, scale: Any, table: Any, constants: Any, w: Any) -> None:
    """Write D with its columns scaled into `d`, dense, from what ``geometry`` left in `w`."""
    n = sizes[_NV]
    for i in range(sizes[_M] * n):
        d[i] = 0.0
    for k in range(constants.shape[0]):
        column, slot = table[3 * k + 1], table[3 * k + 2]
        value = constants[k] if slot < 0 else w[sizes[_JACOBIAN] + slot]
        d[table[3 * k] * n + column] = value * scale[column]


@jit(types.int64(_A, _I, _A, _I, _A, _A, _A, _A, _I))
def correct(
    right: Any, sizes: Any, scale: Any, table: Any, constants: Any, w: Any, x: Any, room: Any, order: Any
) -> int:
    """Set `x` to the change with D x = right whose x / scale is shortest; `right` is overwritten.

    Starts take it as a first-class function: copied to every place it is called from it would take seconds to compile.
    """
    m, n = sizes[_M], sizes[_NV]
    d, rest = part(room, 0, m * n), part(room, m * n, m * min(m, n) + m + n)
    _rows(d, sizes, scale, table, constants, w)
    rank = least_norm(d, m, n, right, x, rest, order)
    for j in range(n):
        x[j] *= scale[j]
    return int(rank)


@jit()
def largest_of(values: Any, count: int) -> float:
    """Return the largest magnitude, at least 1."""
    largest = 1.0
    for i in range(count):
        largest = max(largest, abs(values[i]))
    return largest


@jit()
def _step(measure: Any, move: Any, y: Any, x: Any, factor: float, sizes: Any, p: Any, w: Any) -> None:
    """Move the coordinates by a change of the velocities; angles in space that count turns follow."""
    if sizes[_SPATIAL] == 0:
        for j in range(sizes[_NV]):
            y[j] += factor * x[j]
        return
    for j in range(sizes[_NV]):
        w[sizes[_CHANGE] + j] = factor * x[j]
    move(y, w)
    if sizes[_WINDINGS] > 0:
        measure(0.0, y, p, w)


@jit()
def close_positions(
    geometry: Any,
    measure: Any,
    move: Any,
    solve: Any,
    y: Any,
    p: Any,
    w: Any,
    sizes: Any,
    scale: Any,
    table: Any,
    constants: Any,
    vectors: Any,
    room: Any,
    order: Any,
) -> bool:
    """Close positions in place by shortest changes; return whether they are closed."""
    m, n = sizes[_M], sizes[_NV]
    x, right = part(vectors, 0, n), part(vectors, n, m)
    best, stalled = math.inf, 0
    for _ in range(_ITERATIONS):
        geometry(0.0, y, p, w)
        square = 0.0
        for i in range(m):
            right[i] = -w[sizes[_RESIDUAL] + i]
            square += right[i] * right[i]
        size = math.sqrt(square)
        if not math.isfinite(size):
            return False
        largest = largest_of(y, y.shape[0])
        stalled = stalled + 1 if size > 0.5 * best else 0
        best = min(best, size)
        if size <= 1e-15 * largest * max(1, m) or (stalled >= 3 and size < 1e-9 * largest):
            return True
        if stalled >= 15:
            return False
        solve(right, sizes, scale, table, constants, w, x, room, order)
        size = 1e-300
        for j in range(n):
            size = max(size, abs(x[j]))
        # far from closed, a full Newton step can turn bodies by several radians
        _step(measure, move, y, x, min(1.0, 1.0 / size), sizes, p, w)
    return False


@jit()
def _drift(y: Any, sizes: Any, ones: Any, table: Any, constants: Any, w: Any, right: Any) -> float:
    """Set `right` to nu - D v and return its length."""
    nq = sizes[_NQ]
    for i in range(sizes[_M]):
        right[i] = w[sizes[_NU] + i]
    for k in range(constants.shape[0]):
        column, slot = table[3 * k + 1], table[3 * k + 2]
        value = constants[k] if slot < 0 else w[sizes[_JACOBIAN] + slot]
        right[table[3 * k]] -= value * y[nq + column]
    square = 0.0
    for i in range(sizes[_M]):
        square += right[i] * right[i]
    return math.sqrt(square)


@jit()
def complete_velocities(
    solve: Any,
    y: Any,
    given: Any,
    w: Any,
    sizes: Any,
    scale: Any,
    table: Any,
    constants: Any,
    vectors: Any,
    room: Any,
    order: Any,
) -> int:
    """Set the velocities; return `ASSEMBLED`, `PROJECTED` or `CONTRADICTION`."""
    nq, n, m = sizes[_NQ], sizes[_NV], sizes[_M]
    x, right = part(vectors, 0, n), part(vectors, n, m)
    missing = False
    for j in range(n):
        known = math.isfinite(given[j])
        y[nq + j] = given[j] if known else 0.0
        scale[j] = 0.0 if known else 1.0
        missing = missing or not known
    if m == 0:
        return _ASSEMBLED
    speed = largest_of(part(y, nq, n), n)
    size = _drift(y, sizes, scale, table, constants, w, right)
    if missing:
        solve(right, sizes, scale, table, constants, w, x, room, order)
        for j in range(n):
            y[nq + j] += x[j]
        size = _drift(y, sizes, scale, table, constants, w, right)
    if size <= 1e-9 * speed:
        # what is left is rounding: take it out without touching the given values noticeably
        for j in range(n):
            scale[j] = 1.0
        solve(right, sizes, scale, table, constants, w, x, room, order)
        for j in range(n):
            y[nq + j] += x[j]
        return _ASSEMBLED
    heaviest = 0.0
    for j in range(n):
        heaviest = max(heaviest, w[sizes[_MASS] + j])
    for j in range(n):  # massless bodies give way first
        scale[j] = 1.0 / math.sqrt(max(w[sizes[_MASS] + j], 1e-12 * heaviest))
    for _ in range(2):
        _drift(y, sizes, scale, table, constants, w, right)
        solve(right, sizes, scale, table, constants, w, x, room, order)
        for j in range(n):
            y[nq + j] += x[j]
    size = _drift(y, sizes, scale, table, constants, w, right)
    return _PROJECTED if size <= 1e-8 * speed else _CONTRADICTION


@jit()
def mask_redundant(
    geometry: Any,
    measure: Any,
    move: Any,
    solve: Any,
    y: Any,
    p: Any,
    w: Any,
    probe: Any,
    sizes: Any,
    scale: Any,
    table: Any,
    constants: Any,
    vectors: Any,
    room: Any,
    order: Any,
) -> None:
    """Mask the rows that depend on others at the start and at closed positions near it: not only at a singular one."""
    nq, n, m, ny, nw = sizes[_NQ], sizes[_NV], sizes[_M], y.shape[0], sizes[_NW]
    count = 0
    for i in range(m):
        if w[sizes[_PIVOTS] + i] < _SKIP:
            w[sizes[_MASK] + i] = math.inf
            count += 1
    if count == 0:
        return
    other, probed, direction = part(probe, 0, ny), part(probe, ny, nw), part(probe, ny + nw, n)
    x, right = part(vectors, 0, n), part(vectors, n, m)
    for k in range(3):
        # a direction along the constraints, another one each time
        for j in range(n):
            direction[j] = math.cos((k + 1.0) * (j + 1.0))
            scale[j] = 1.0
        for i in range(m):
            right[i] = 0.0
        for c in range(constants.shape[0]):
            column, slot = table[3 * c + 1], table[3 * c + 2]
            value = constants[c] if slot < 0 else w[sizes[_JACOBIAN] + slot]
            right[table[3 * c]] += value * direction[column]
        solve(right, sizes, scale, table, constants, w, x, room, order)
        size = 0.0
        for j in range(n):
            direction[j] -= x[j]
            size = max(size, abs(direction[j]))
        if size < 1e-9:  # nothing moves
            return
        for i in range(ny):
            other[i] = y[i]
        for i in range(nw):
            probed[i] = w[i]
        for i in range(m):
            probed[sizes[_MASK] + i] = 0.0
        _step(measure, move, other, direction, 0.03 * largest_of(y, nq) / size, sizes, p, probed)
        if close_positions(
            geometry, measure, move, solve, other, p, probed, sizes, scale, table, constants, vectors, room, order
        ):
            for i in range(m):
                if not probed[sizes[_PIVOTS] + i] < _SKIP:
                    w[sizes[_MASK] + i] = 0.0


@jit()
def is_light(rhs: Any, geometry: Any, y: Any, p: Any, w: Any, probe: Any, sizes: Any, iw: Any) -> bool:
    """Whether a pivot of S is suspiciously small although D D^T finds no row dependent."""
    ny, nw, m = y.shape[0], sizes[_NW], sizes[_M]
    other, probed, rate = part(probe, 0, ny), part(probe, ny, nw), part(probe, ny + nw, ny)
    for i in range(ny):
        other[i] = y[i]
    for i in range(nw):
        probed[i] = w[i]
    for i in range(iw.shape[0]):
        iw[i] = 0
    if rhs(0.0, other, p, probed, iw, rate) == 0:
        return False
    geometry(0.0, other, p, probed)
    for i in range(m):
        if probed[sizes[_MASK] + i] == 0.0 and not probed[sizes[_PIVOTS] + i] >= _SKIP:
            return False
    return True
