"""The descriptor form of a large mechanism at rest as sparse matrices: sums over elements, from looped code."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from symgen.analyses.state.yardsticks import Yardsticks
from symgen.run.layout import abi
from symgen.run.layout.probe import Ready
from symgen.run.loops.newton import Pattern

if TYPE_CHECKING:
    from symgen.describe.mechanism import Mechanism
    from symgen.run.layout.compiled import CompiledModel

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Sparse(Yardsticks):
    """The descriptor form of a mechanism at rest as sparse matrices.

    Attributes
    ----------
    mechanism : Mechanism
        With inputs in their places.
    compiled : CompiledModel
        `lagrange` with its descriptor form.
    y, p, w : Array
        The start without velocities, parameters and scratch.
    pattern : Pattern
        Where the numbers of ``tangent`` belong.
    active : Array of int
        Rows that are not redundant.
    """

    mechanism: Mechanism
    compiled: CompiledModel
    y: Array
    p: Array
    w: Array
    pattern: Pattern
    active: NDArray[np.int64]
    t = 0.0
    inputs = ()

    def motion(self, y: Array) -> Any:
        """Return N at a state, over lengths of the mechanism and radians."""
        return self.matrices(y, np.zeros(self.pattern.m))[0]

    def matrices(self, y: Array, lam: Array) -> tuple[Any, Any, Any, Any, Any]:
        """Return N, M, D, the stiffness K and the derivative of the balance by v at a state at rest.

        All over changes in lengths of the mechanism and radians, and violations in these, so that forces are work:
        what is solved with them, and its pivots, are the same in micrometres.
        """
        from scipy.sparse import coo_matrix, diags

        f, nq, nv, m, n = self.pattern, self.pattern.nq, self.pattern.nv, self.pattern.m, self.pattern.unknowns
        k, j = np.zeros(n), np.zeros(f.size)
        k[nq + nv : nq + nv + m] = lam
        Ready(self.compiled.law_module.tangent, abi.STAGE)(0.0, y, k, self.p, self.w, j)

        def sparse_block(rows: tuple[int, int], columns: tuple[int, int]) -> Any:
            inside = (f.rows >= rows[0]) & (f.rows < rows[0] + rows[1])
            inside &= (f.columns >= columns[0]) & (f.columns < columns[0] + columns[1])
            places = f.rows[inside] - rows[0], f.columns[inside] - columns[0]
            return coo_matrix((j[inside], places), shape=(rows[1], columns[1])).tocsc()

        spans, loads = diags(self.spans, format="csc"), diags(1.0 / self.gaps, format="csc")
        motion = -sparse_block((0, nq), (n + nq, nv)) @ spans
        balance = (nq, nv)
        mass, rows = (
            spans @ sparse_block(balance, (nq, nv)) @ spans,
            (spans @ sparse_block(balance, (nq + nv, m)) @ loads).T,
        )
        stiffness, damping = (
            spans @ sparse_block(balance, (n, nq)) @ motion,
            spans @ sparse_block(balance, (n + nq, nv)) @ spans,
        )
        return motion, mass, rows.tocsr()[self.active].tocsc(), stiffness, damping

    def forces(self, y: Array, lam: Array) -> tuple[Array, Array]:
        """Return the work of D^T lambda - f along lengths of the mechanism and radians, and Phi in these."""
        nq, nv, m = self.pattern.nq, self.pattern.nv, self.pattern.m
        k, r = np.zeros(self.pattern.unknowns), np.zeros(self.pattern.unknowns)
        k[nq + nv : nq + nv + m] = lam
        Ready(self.compiled.law_module.residual, abi.STAGE)(0.0, y, k, self.p, self.w, r)
        Ready(self.compiled.model.geometry, abi.MEASURE)(0.0, y, self.p, self.w)
        gaps = self.compiled.section(self.w, "residual") / self.gaps
        return r[nq : nq + nv] * self.spans, gaps[self.active]

    def acting(self, y: Array) -> Array:
        """Return what acts along each velocity at a state without multipliers: bodies have coordinates of their own."""
        return np.abs(self.forces(y, np.zeros(self.pattern.m))[0])

    def derivatives(self, y: Array, lam: Array) -> tuple[Any, Any, Any]:
        """Return N, D of rows that are not redundant, and the stiffness K."""
        motion, _, rows, stiffness, _ = self.matrices(y, lam)
        return motion, rows, stiffness

    def all_multipliers(self, work: Array | None) -> Array:
        """Return multipliers of all rows from the work of those that are kept; 0 without."""
        loads = np.zeros(self.pattern.m)
        loads[self.active] = 0.0 if work is None else work
        return loads / self.gaps

    def wind_angles(self, y: Array) -> Sparse:
        """Return the same: looped code counts no turns beside the angles of bodies."""
        return self
