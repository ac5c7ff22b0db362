"""The descriptor form of large mechanisms at rest as sparse matrices, from looped code; equilibria by them.

Nothing is formulated for the whole mechanism: the descriptor form and its derivatives are sums over elements.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from symgen.analyses.settle import search
from symgen.analyses.subject import at_start, given_at_start
from symgen.analyses.yardsticks import Yardsticks
from symgen.runtime import abi
from symgen.runtime.newton import Pattern
from symgen.runtime.probe import Ready
from symgen.settings import Settings

if TYPE_CHECKING:
    from symgen.describe.mechanism import Mechanism
    from symgen.runtime.compiled import CompiledModel

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Sparse(Yardsticks):
    """The descriptor form of a mechanism at rest as sparse matrices.

    Attributes
    ----------
    compiled : CompiledModel
        `lagrange` with its descriptor form.
    y, p, w : Array
        The start without velocities, parameters and scratch.
    pattern : Pattern
        Where the numbers of ``tangent`` belong.
    kept : Array of int
        Rows that are not redundant.
    """

    compiled: CompiledModel
    y: Array
    p: Array
    w: Array
    pattern: Pattern
    kept: NDArray[np.int64]

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

        def block(rows: tuple[int, int], columns: tuple[int, int]) -> Any:
            inside = (f.rows >= rows[0]) & (f.rows < rows[0] + rows[1])
            inside &= (f.columns >= columns[0]) & (f.columns < columns[0] + columns[1])
            places = f.rows[inside] - rows[0], f.columns[inside] - columns[0]
            return coo_matrix((j[inside], places), shape=(rows[1], columns[1])).tocsc()

        spans, loads = diags(self.spans, format="csc"), diags(1.0 / self.gaps, format="csc")
        motion = -block((0, nq), (n + nq, nv)) @ spans
        balance = (nq, nv)
        mass, rows = spans @ block(balance, (nq, nv)) @ spans, (spans @ block(balance, (nq + nv, m)) @ loads).T
        stiffness, damping = spans @ block(balance, (n, nq)) @ motion, spans @ block(balance, (n + nq, nv)) @ spans
        return motion, mass, rows.tocsr()[self.kept].tocsc(), stiffness, damping

    def all_rows(self, y: Array) -> Any:
        """Return D with the rows that are redundant."""
        return replace(self, kept=np.arange(self.pattern.m)).matrices(y, np.zeros(self.pattern.m))[2]

    def forces(self, y: Array, lam: Array) -> tuple[Array, Array]:
        """Return the work of D^T lambda - f along lengths of the mechanism and radians, and Phi in these."""
        nq, nv, m = self.pattern.nq, self.pattern.nv, self.pattern.m
        k, r = np.zeros(self.pattern.unknowns), np.zeros(self.pattern.unknowns)
        k[nq + nv : nq + nv + m] = lam
        Ready(self.compiled.law_module.residual, abi.STAGE)(0.0, y, k, self.p, self.w, r)
        Ready(self.compiled.model.geometry, abi.MEASURE)(0.0, y, self.p, self.w)
        gaps = self.compiled.section(self.w, "residual") / self.gaps
        return r[nq : nq + nv] * self.spans, gaps[self.kept]

    def derivatives(self, y: Array, lam: Array) -> tuple[Any, Any, Any]:
        """Return N, D of rows that are not redundant, and the stiffness K."""
        motion, _, rows, stiffness, _ = self.matrices(y, lam)
        return motion, rows, stiffness

    def whole(self, work: Array | None) -> Array:
        """Return multipliers of all rows from the work of those that are kept; 0 without."""
        found = np.zeros(self.pattern.m)
        found[self.kept] = 0.0 if work is None else work
        return found / self.gaps

    def wound(self, y: Array) -> Sparse:
        """Return the same: angles of looped code are those of bodies."""
        return self


def _at_start(mechanism: Mechanism, settings: Settings) -> Sparse:
    """Return a mechanism's descriptor form at its start, closed or not."""
    given = given_at_start(mechanism, settings)
    asked = replace(given.settings, method="lagrange", integrator="radau5", shape="looped", coordinates="absolute")
    found = at_start(given.mechanism, asked)
    compiled, y, p, w = found.compiled, found.y.copy(), found.p, found.w
    pattern = Pattern.of(compiled, w)
    y[pattern.nq :] = 0.0
    kept = np.setdiff1d(np.arange(pattern.m), pattern.masked)
    return Sparse(compiled, y, p, w, pattern, kept)


def settled(mechanism: Mechanism, settings: Settings) -> tuple[Sparse, Array, Array, int]:
    """Return a descriptor form, the equilibrium that the start leads to, its multipliers, and the steps taken.

    Parameters
    ----------
    mechanism : Mechanism
        The description.
    settings : Settings
        ``parameters``, ``inputs`` and ``start`` are looked at; coordinates are those of bodies.

    Raises
    ------
    InputError
        If a setting is wrong.
    AnalysisError
        If no equilibrium is found.
    """
    sparse = _at_start(mechanism, settings)
    return search(sparse, sparse.y)
