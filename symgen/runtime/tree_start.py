"""The start of a run in joint coordinates from positions that are closed already: scales, and rows without a say.

Rows of loops may vanish as a whole there, for ever (a hinge beside another on one axis) or at a dead centre. What the
one start of `symgen.runtime.starting` takes for the smallest row is rounding then, so lengths are compared with those
of the mechanism here.
"""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from symgen.ir.numerics import SKIP
from symgen.native import types
from symgen.runtime import abi, decisions
from symgen.runtime.bare import bare, part
from symgen.runtime.compiled import CompiledModel, ModelInfo
from symgen.runtime.exact import exact, plain_form
from symgen.runtime.probe import Ready
from symgen.runtime.redundancy import row_chooser
from symgen.runtime.scales import VANISHED, has_vanished, mean_mass, square_rows, weigh_rows
from symgen.runtime.start_records import INSTANT, LAYOUT, Instant

Array = NDArray[np.float64]

#: A product of Euler parameters below this is one of orientations more than 120 degrees apart.
TURNED_OVER = 0.5


def settle_tree(
    compiled: CompiledModel, y: Array, p: Array, t: float, turned: Array, scales: tuple[float, float, Array]
) -> tuple[Array, int, tuple[str, ...]]:
    """Return the scratch of a start, the rank of D there, and the rows that depend on others.

    Parameters
    ----------
    compiled : CompiledModel
        In joint coordinates.
    y : Array, shape (ny,)
        The start, which satisfies the constraints.
    p : Array
        Parameters; prepared here.
    t : float
        Time [s].
    turned : Array, shape (windings,)
        Angles that count turns.
    scales : tuple of float, float, Array
        Length and speed of the mechanism, and the section ``gauge``: the lengths of bodies, measured where they have
        coordinates of their own.
    """
    info, w = compiled.info, compiled.scratch()
    with np.errstate(all="ignore"):
        compiled.prepare(p)
        Ready(compiled.model.masses, abi.MOVE)(p, w)
        w[abi.WINDING : abi.WINDING + info.windings] = turned
        geometry = Ready(compiled.model.geometry, abi.MEASURE)
        layout = compiled.layout._replace(t=t)
        now = Instant(y, p, w)
        w[abi.LENGTH], w[abi.SPEED], gauge = scales
        compiled.section(w, "gauge")[:] = gauge
        w[abi.MEAN_MASS] = plain_form(mean_mass)(layout, w)
        masked, rank = _dependent(compiled, geometry, layout, now)
        compiled.section(w, "mask")[:] = np.where(masked, np.inf, 0.0)
        plain_form(weigh_rows)(layout, now)
        geometry(t, y, p, w)
        if masked.any() and w[abi.PIVOT] < decisions.STAND_BADLY and row_chooser(compiled)(w):
            geometry(t, y, p, w)
            masked = compiled.section(w, "mask") > 0.0
    return w, rank, compiled.redundant(w)


def turned_by_tree(info: ModelInfo, closed: Array, carried: Array) -> int:
    """Return which of the bodies that turn in space the joints of a tree turn over at a start, -1 where none.

    Rows of absolute coordinates leave open to which side the axis of a joint points, a tree does not.

    Parameters
    ----------
    info : ModelInfo
        Of bodies.
    closed, carried : Array, shapes (>= nq,)
        Coordinates of bodies as they were closed, and as the tree carries them.
    """
    for k, (first, _) in enumerate(info.spins):
        if abs(carried[first : first + 4] @ closed[first : first + 4]) < TURNED_OVER:
            return k
    return -1


class Carrying(NamedTuple):
    """Where what stands in rows of bodies and of a tree.

    Attributes
    ----------
    runs, work, outs : int
        Rows; elements of a tree's state before the work; numbers that ``observe`` writes.
    places : Array of int, shape (2 work,)
        Of each of these elements: 0 and where it stands in the state of bodies, or 1 and where ``observe`` writes it.
    windings, gauges, spins : Array of int
        Where angles that count turns, and squares of lengths, stand in the scratch of bodies; -1 where that is 1. Where
        Euler parameters begin among the coordinates of bodies.
    dependent : Array of int, shape (runs,)
        Set to 1 where rows of loops depend on others, 0 elsewhere.
    alike : Array, shape (runs * spins,)
        Set to the products of Euler parameters as bodies were closed with those that the tree carries.
    """

    runs: int
    work: int
    outs: int
    places: Any
    windings: Any
    gauges: Any
    spins: Any
    dependent: Any
    alike: Any


_I, _A = types.int64[::1], types.float64[::1]
_CARRYING = types.Record((*(types.int64,) * 3, *(_I,) * 5, _A), Carrying)


@exact(types.int64(abi.OBSERVE, abi.MEASURE, abi.OBSERVE, LAYOUT, INSTANT, INSTANT, _CARRYING, _A, _I, _I))
def settle_rows(
    observe: Any,
    geometry: Any,
    bodies: Any,
    layout: Any,
    of_bodies: Any,
    of_tree: Any,
    carrying: Any,
    room: Any,
    selected: Any,
    control: Any,
) -> int:
    """Do what `settle_tree` does for many rows, but for those in which rows of loops depend on others.

    Parameters
    ----------
    observe, geometry, bodies : emitted functions
        Of bodies, and of the tree, the last of which carries its motion to bodies.
    layout : Layout
        Of the tree.
    of_bodies, of_tree : Instant
        Of all rows, one behind the other: consistent, and with parameters and masses prepared.
    carrying : Carrying
        Where what stands.
    room : Array
        Working memory: a state, what ``observe`` or ``bodies`` writes, and scratch.
    selected, control : Array of int
        Rows to work on; what the watching thread shares.
    """
    layout, carrying, (ys, ps, ws), (yt, pt, wt) = bare(layout), bare(carrying), bare(of_bodies), bare(of_tree)
    runs, outs = carrying.runs, carrying.outs
    ny, n_p, nw = ys.shape[0] // runs, ps.shape[0] // runs, ws.shape[0] // runs
    ny_t, np_t, nw_t = yt.shape[0] // runs, pt.shape[0] // runs, wt.shape[0] // runs
    rate, out, scratch = part(room, 0, ny), part(room, ny, outs), part(room, ny + outs, nw)
    for s in range(selected.shape[0]):
        if control[abi.STOP] != 0:
            return int(s)
        r = selected[s]
        y, p, w = part(ys, r * ny, ny), part(ps, r * n_p, n_p), part(ws, r * nw, nw)
        y_t, p_t, w_t = part(yt, r * ny_t, ny_t), part(pt, r * np_t, np_t), part(wt, r * nw_t, nw_t)
        for i in range(nw):
            scratch[i] = w[i]
        observe(layout.t, y, p, scratch, rate, out)
        for k in range(carrying.work):
            at = carrying.places[2 * k + 1]
            y_t[k] = y[at] if carrying.places[2 * k] == 0 else out[at]
        for i in range(carrying.windings.shape[0]):
            w_t[abi.WINDING + i] = w[carrying.windings[i]]
        w_t[abi.LENGTH], w_t[abi.SPEED] = w[abi.LENGTH], w[abi.SPEED]
        for j in range(layout.nv):
            w_t[layout.gauge + j] = 1.0 if carrying.gauges[j] < 0 else w[carrying.gauges[j]]
        w_t[abi.MEAN_MASS] = mean_mass(layout, w_t)
        geometry(layout.t, y_t, p_t, w_t)
        square_rows(layout, w_t)
        for i in range(layout.m):
            if not w_t[layout.pivot + i] >= SKIP or has_vanished(layout, w_t, i):
                carrying.dependent[r] = 1
        geometry(layout.t, y_t, p_t, w_t)
        weigh_rows(layout, Instant(y_t, p_t, w_t))
        count = carrying.spins.shape[0]
        if count > 0:
            bodies(layout.t, y_t, p_t, w_t, rate, out)
        for i in range(count):
            first, alike = carrying.spins[i], 0.0
            for k in range(first, first + 4):
                alike += out[k] * y[k]
            carrying.alike[r * count + i] = alike
    return int(selected.shape[0])


def _dependent(compiled: CompiledModel, geometry: Ready, layout: Any, now: Instant) -> tuple[NDArray[np.bool_], int]:
    """Return the rows that depend on others at a position and near it, and the rank at the position."""
    info, t, (y, p, w) = compiled.info, layout.t, now
    here = _dependent_at(compiled, geometry, layout, now)
    least, found = int(here.sum()), here
    rank, length = info.m - least, float(w[abi.LENGTH])
    scale = length * np.sqrt(compiled.section(w, "gauge"))
    weight = np.array([length if row.unit in ("rad", "rad/s") else 1.0 for row in info.rows])
    for k in range(decisions.PROBES if least else 0):
        direction = np.cos((k + 1.0) * (np.arange(info.nv) + 1.0))
        matrix = weight[:, np.newaxis] * compiled.jacobian(w) * scale
        direction -= _shortest(matrix, matrix @ direction, length)
        size = float(np.abs(direction).max(initial=0.0))
        if not size > decisions.STANDSTILL:
            break
        other, near = y.copy(), w.copy()
        compiled.move(other, direction * scale * (decisions.PROBE_DISTANCE / size), near)
        for _ in range(20):
            geometry(t, other, p, near)
            open_by = weight * compiled.section(near, "residual")
            if not np.abs(open_by).max(initial=0.0) > 1e-12 * length:
                break
            matrix = weight[:, np.newaxis] * compiled.jacobian(near) * scale
            compiled.move(other, -scale * _shortest(matrix, open_by, length), near)
        there = _dependent_at(compiled, geometry, layout, Instant(other, p, near))
        if np.isfinite(near[abi.PHI]) and int(there.sum()) < least:
            least, found = int(there.sum()), there
    return found, rank


def _dependent_at(compiled: CompiledModel, geometry: Ready, layout: Any, now: Instant) -> NDArray[np.bool_]:
    """Return the rows that depend on others at one position; those that have vanished take no part in elimination.

    Rounding divided by rounding would decide which rows depend on those.
    """
    y, p, w = now
    mask = compiled.section(w, "mask")
    mask[:] = 0.0
    geometry(layout.t, y, p, w)
    plain_form(square_rows)(layout, w)
    gone = np.array([plain_form(has_vanished)(layout, w, i) for i in range(compiled.info.m)], dtype=bool)
    if gone.any():
        mask[gone] = np.inf
        geometry(layout.t, y, p, w)
    return np.asarray(gone | (compiled.section(w, "pivot") < SKIP))


def _shortest(matrix: Array, right: Array, length: float) -> Array:
    """Return the shortest x with matrix x = right, what is rounding left out."""
    left, singular, columns = np.linalg.svd(matrix, full_matrices=False)
    kept = singular > max(math.sqrt(VANISHED) * length, decisions.RANK_CUTOFF * singular.max(initial=0.0))
    return np.asarray(columns[kept].T @ ((left[:, kept].T @ right) / singular[kept]))
