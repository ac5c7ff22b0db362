"""Lowest modes of large mechanisms at rest: sparse matrices from looped code, and shift-invert iterations.

Nothing is formulated for the whole mechanism: the descriptor form and its derivatives are sums over elements. Newton's
method and the iterations of Lanczos solve with one sparse factorisation each of

    [ K - s M   D^T ]
    [ D         0   ]
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from symgen.analyses.linearise import in_order
from symgen.analyses.modes import Modes
from symgen.errors import AnalysisError, InputError
from symgen.plan import make_plan
from symgen.run_setup import give_inputs, ready
from symgen.runtime import abi
from symgen.runtime.newton import Pattern
from symgen.runtime.probe import Ready
from symgen.settings import Settings

if TYPE_CHECKING:
    from symgen.describe.mechanism import Mechanism
    from symgen.runtime.compiled import CompiledModel

Array = NDArray[np.float64]

#: Steps of Newton's method at most, and what part of the forces counts as none.
MOST_STEPS, TOLERANCE = 60, 1e-12
#: Damping or turning of this part of the stiffness and masses is refused: these modes are those of M and K alone.
NONE = 1e-9


@dataclass(frozen=True)
class Sparse:
    """The descriptor form of a mechanism at rest as sparse matrices.

    Attributes
    ----------
    compiled : CompiledModel
        `lagrange` with its descriptor form.
    p, w : Array
        Parameters and scratch.
    pattern : Pattern
        Where the numbers of ``tangent`` belong.
    kept : Array of int
        Rows that are not redundant.
    """

    compiled: CompiledModel
    p: Array
    w: Array
    pattern: Pattern
    kept: NDArray[np.int64]

    def matrices(self, y: Array, lam: Array) -> tuple[Any, Any, Any, Any, Any]:
        """Return N, M, D, the stiffness K and the derivative of the balance by v at a state at rest."""
        from scipy.sparse import coo_matrix

        f, nq, nv, m, n = self.pattern, self.pattern.nq, self.pattern.nv, self.pattern.m, self.pattern.unknowns
        k, j = np.zeros(n), np.zeros(f.size)
        k[nq + nv : nq + nv + m] = lam
        Ready(self.compiled.law_module.tangent, abi.STAGE)(0.0, y, k, self.p, self.w, j)

        def block(rows: tuple[int, int], columns: tuple[int, int]) -> Any:
            inside = (f.rows >= rows[0]) & (f.rows < rows[0] + rows[1])
            inside &= (f.columns >= columns[0]) & (f.columns < columns[0] + columns[1])
            places = f.rows[inside] - rows[0], f.columns[inside] - columns[0]
            return coo_matrix((j[inside], places), shape=(rows[1], columns[1])).tocsc()

        motion = -block((0, nq), (n + nq, nv))
        balance = (nq, nv)
        mass, force_rows = block(balance, (nq, nv)), block(balance, (nq + nv, m))
        stiffness = block(balance, (n, nq)) @ motion
        return motion, mass, force_rows.T.tocsr()[self.kept].tocsc(), stiffness, block(balance, (n + nq, nv))

    def forces(self, y: Array, lam: Array) -> tuple[Array, Array]:
        """Return D^T lambda - f, and Phi."""
        nq, nv, m = self.pattern.nq, self.pattern.nv, self.pattern.m
        k, r = np.zeros(self.pattern.unknowns), np.zeros(self.pattern.unknowns)
        k[nq + nv : nq + nv + m] = lam
        Ready(self.compiled.law_module.residual, abi.STAGE)(0.0, y, k, self.p, self.w, r)
        Ready(self.compiled.model.geometry, abi.MEASURE)(0.0, y, self.p, self.w)
        return r[nq : nq + nv].copy(), self.compiled.section(self.w, "residual")[self.kept].copy()

    def whole(self, multipliers: Array) -> Array:
        """Return multipliers of all rows from those that are kept."""
        found = np.zeros(self.pattern.m)
        found[self.kept] = multipliers
        return found

    def moved(self, y: Array, change: Array) -> Array:
        """Return a state whose coordinates are moved by a change, Euler parameters kept at length 1."""
        found = y.copy()
        found[: self.pattern.nq] += change
        for first, _ in self.compiled.info.spins:
            found[first : first + 4] /= np.linalg.norm(found[first : first + 4])
        return found


def lowest_modes(mechanism: Mechanism, settings: Settings, count: int) -> Modes:
    """Return the modes at the equilibrium near the start whose frequencies are the lowest.

    Parameters
    ----------
    mechanism : Mechanism
        The description.
    settings : Settings
        ``parameters``, ``inputs`` and ``start`` are looked at; coordinates are those of bodies.
    count : int
        How many.

    Raises
    ------
    InputError
        If a setting is wrong, or something damps or turns.
    AnalysisError
        If no equilibrium is found near the start.
    """
    from scipy.sparse.linalg import LinearOperator, eigsh

    given = give_inputs(mechanism, settings)
    asked = replace(given.settings, method="lagrange", integrator="radau5", shape="looped", coordinates="absolute")
    plan = make_plan(given.mechanism, asked)
    compiled, start = ready(given.mechanism, plan, asked.parameters)
    pattern = Pattern.of(compiled, start.w)
    kept = np.setdiff1d(np.arange(pattern.m), pattern.masked)
    sparse = Sparse(compiled, start.p, start.w, pattern, kept)
    y = start.y.copy()
    y[pattern.nq :] = 0.0
    y, lam = _rest(sparse, y)
    motion, mass, rows, stiffness, damping = sparse.matrices(y, lam)
    free = pattern.nv - len(kept)
    if not 0 < count < free:
        raise InputError("count", f"fewer than the mechanism's {free} modes", str(count), "ask for all modes")
    scale = float(np.sqrt(abs(stiffness).max() * abs(mass).max()))
    if damping.nnz and abs(damping).max() > NONE * scale:
        raise InputError("count", "a mechanism without dampers", "one that has some", "ask for all modes")
    solve = _solver(stiffness, rows)
    inverse = LinearOperator((pattern.nv,) * 2, matvec=lambda x: solve(x, np.zeros(len(kept)))[0], dtype=np.float64)
    begin = solve(mass @ np.ones(pattern.nv), np.zeros(len(kept)))[0]
    symmetric = 0.5 * (stiffness + stiffness.T)
    squares, vectors = eigsh(symmetric, k=count, M=mass, sigma=0.0, OPinv=inverse, v0=begin, which="LM", tol=0.0)
    order = np.argsort(squares)
    squares, vectors = squares[order], vectors[:, order]
    roots = np.sqrt(-squares.astype(np.complex128))
    names = tuple(q.name for q in compiled.info.coordinates)
    about = {name: float(x) for name, x in zip(names, y, strict=False)}
    shapes = (motion @ vectors).T.astype(np.complex128)
    return Modes(in_order(np.concatenate([roots, -roots])), squares, free, names, shapes, about=about)


def _rest(sparse: Sparse, y: Array) -> tuple[Array, Array]:
    """Return the equilibrium near a state and its multipliers, by Newton's method."""
    lam = np.zeros(sparse.pattern.m)
    best = np.inf
    for step in range(MOST_STEPS):
        force, gaps = sparse.forces(y, lam)
        motion, _, rows, stiffness, _ = sparse.matrices(y, lam)
        load = max(float(np.abs(rows.T @ lam[sparse.kept]).max(initial=0.0)), 1e-300)
        error = float(np.abs(force).max(initial=0.0)) / load + float(np.abs(gaps).max(initial=0.0))
        if step > 1 and error < 1e3 * TOLERANCE and error >= 0.5 * best:
            return y, lam
        best = min(best, error)
        if step == 0:  # without multipliers there is no geometric stiffness: masses in its place
            stiffness = sparse.matrices(y, lam)[1] + stiffness
        change, more = _solver(stiffness, rows)(-force, -gaps)
        if not np.all(np.isfinite(change)):
            break
        if step > 0:
            y = sparse.moved(y, motion @ change)
        lam = lam + sparse.whole(more)
    raise AnalysisError("no equilibrium was found near the start; ask for all modes, or give a start nearer to one")


def _solver(stiffness: Any, rows: Any) -> Callable[[Array, Array], tuple[Array, Array]]:
    """Return what solves with the sparse matrix of directions and rows, refined once."""
    from scipy.sparse import bmat
    from scipy.sparse.linalg import splu

    n = stiffness.shape[0]
    scale = float(abs(stiffness).max()) or 1.0
    matrix = bmat([[stiffness / scale, rows.T], [rows, None]], format="csc")
    try:
        factors = splu(matrix)
    except RuntimeError:
        raise AnalysisError("the stiffness is singular: something can move without a force") from None

    def solve(force: Array, gaps: Array) -> tuple[Array, Array]:
        right = np.concatenate([force / scale, gaps])
        found = factors.solve(right)
        found += factors.solve(right - matrix @ found)
        return found[:n], found[n:] * scale

    return solve
