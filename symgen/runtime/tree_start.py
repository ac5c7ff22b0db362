"""The start of a run in joint coordinates from positions that are closed already: scales, and rows without a say.

Rows of loops may vanish as a whole there, for ever (a hinge beside another on one axis) or at a dead centre. What the
one start of `symgen.runtime.starting` takes for the smallest row is rounding then, so lengths are compared with those
of the mechanism here.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from symgen.ir.numerics import SKIP
from symgen.ir.program import STATUS
from symgen.runtime import abi, decisions
from symgen.runtime import ensemble_abi as e
from symgen.runtime.assembler import Assembly
from symgen.runtime.compiled import CompiledModel
from symgen.runtime.exact import plain_form
from symgen.runtime.probe import Ready
from symgen.runtime.scales import weigh_rows
from symgen.runtime.start_records import Instant

Array = NDArray[np.float64]

#: A row of D, over the mechanism's length, below this is rounding.
NOTHING = 1e-9


def settle_tree(
    compiled: CompiledModel, y: Array, p: Array, t: float, turned: Sequence[float], scales: tuple[float, float, Array]
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
    turned : sequence of float
        Angles that count turns.
    scales : tuple of float, float, Array
        Length and speed of the mechanism, and the section ``gauge``: the lengths of bodies, measured where they have
        coordinates of their own.
    """
    info, w = compiled.info, compiled.scratch()
    model, law = compiled.model, compiled.law_module
    with np.errstate(all="ignore"):
        for module in (model, law):
            Ready(module.prepare, e.PREPARE)(p)
        Ready(model.masses, abi.MOVE)(p, w)
        w[abi.WINDING : abi.WINDING + info.windings] = turned
        geometry = Ready(model.geometry, abi.MEASURE)
        layout = Assembly.of(compiled).layout._replace(t=t)
        now = Instant(y, p, w)
        w[abi.LENGTH], w[abi.SPEED], gauge = scales
        compiled.section(w, "gauge")[:] = gauge
        w[STATUS.index("mean_mass")] = float(compiled.section(w, "mass") @ gauge) / max(1, info.nv)
        geometry(t, y, p, w)
        masked = _dependent(compiled, geometry, y, p, w, t)
        compiled.section(w, "mask")[masked] = np.inf
        geometry(t, y, p, w)
        plain_form(weigh_rows)(layout, now)
    rank = int(np.sum(compiled.section(w, "pivot") >= SKIP))
    return w, rank, tuple(info.rows[i].name for i in np.flatnonzero(masked))


def _dependent(compiled: CompiledModel, geometry: Ready, y: Array, p: Array, w: Array, t: float) -> NDArray[np.bool_]:
    """Return the rows that depend on others at a position and near it."""
    info = compiled.info
    here = compiled.section(w, "pivot") < SKIP
    least, found = int(here.sum()), here.copy()
    length = float(w[abi.LENGTH])
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
        compiled.section(near, "mask")[:] = 0.0
        compiled.move(other, direction * scale * (decisions.PROBE_DISTANCE / size), near)
        for _ in range(20):
            geometry(t, other, p, near)
            open_by = weight * compiled.section(near, "residual")
            if not np.abs(open_by).max(initial=0.0) > 1e-12 * length:
                break
            matrix = weight[:, np.newaxis] * compiled.jacobian(near) * scale
            compiled.move(other, -scale * _shortest(matrix, open_by, length), near)
        geometry(t, other, p, near)
        there = compiled.section(near, "pivot") < SKIP
        if np.isfinite(near[abi.PHI]) and int(there.sum()) < least:
            least, found = int(there.sum()), there.copy()
    return found


def _shortest(matrix: Array, right: Array, length: float) -> Array:
    """Return the shortest x with matrix x = right, what is rounding left out."""
    left, singular, columns = np.linalg.svd(matrix, full_matrices=False)
    kept = singular > max(NOTHING * length, decisions.RANK_CUTOFF * singular.max(initial=0.0))
    return np.asarray(columns[kept].T @ ((left[:, kept].T @ right) / singular[kept]))
