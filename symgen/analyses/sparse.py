"""The descriptor form of large mechanisms at rest as sparse matrices, from looped code; equilibria by them.

Nothing is formulated for the whole mechanism: the descriptor form and its derivatives are sums over elements. A search
solves, step by step, with one sparse factorisation of

    [ K + s G   D^T ]
    [ D         0   ]

which is Newton's method where s = 0. Far from rest s is so large that a step stays short and goes downhill.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from symgen.analyses.settle import EXACT, NEAR, OPENED
from symgen.analyses.subject import at_start, given_at_start
from symgen.analyses.yardsticks import Yardsticks
from symgen.errors import AnalysisError
from symgen.runtime import abi
from symgen.runtime.newton import Pattern
from symgen.runtime.probe import Ready
from symgen.settings import Settings

if TYPE_CHECKING:
    from symgen.describe.mechanism import Mechanism
    from symgen.runtime.compiled import CompiledModel

Array = NDArray[np.float64]
#: Forces and violations that are to be undone -> the step and the change of the multipliers.
Solver = Callable[[Array, Array], tuple[Array, Array]]

#: Steps of a search at most, and what part of the forces counts as none.
MOST_STEPS, TOLERANCE = 300, 1e-12
#: How long a step downhill may be, in lengths of the mechanism and radians.
REACH = 0.5
#: A closing step as long as this has no way; what everything is moved by then, in lengths of the mechanism and radians.
SINGULAR, ASTRAY = 1e6, 0.01
#: What s is multiplied with where a step is too long, and the least part of its root that is left behind a short one.
FASTER, LEAST = 4.0, 0.1


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

    def whole(self, multipliers: Array) -> Array:
        """Return multipliers of all rows from the work of those that are kept."""
        found = np.zeros(self.pattern.m)
        found[self.kept] = multipliers
        return found / self.gaps

    def moved(self, y: Array, change: Array) -> Array:
        """Return a state whose coordinates are moved by a change, Euler parameters kept at length 1."""
        found = y.copy()
        found[: self.pattern.nq] += change
        for first, _ in self.compiled.info.spins:
            found[first : first + 4] /= np.linalg.norm(found[first : first + 4])
        return found


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
    y, steps = _closed(sparse)
    motion, _, rows, stiffness, _ = sparse.matrices(y, np.zeros(sparse.pattern.m))
    force, gaps = sparse.forces(y, np.zeros(sparse.pattern.m))
    still = _level(sparse)
    lam = sparse.whole(_regular(still, rows)(-force, np.zeros(len(gaps)))[1])
    force, gaps = sparse.forces(y, lam)
    motion, _, rows, stiffness, _ = sparse.matrices(y, lam)
    shift, best, before = 0.0, np.inf, (y, lam)
    first = float(abs(stiffness).max()) or 1.0
    for step in range(steps + 1, MOST_STEPS):
        load = float(np.abs(rows.T @ (sparse.gaps * lam)[sparse.kept]).max(initial=1e-300))
        # where joints carry nothing, what each force changes by over a thousandth of the mechanism
        stiff = 1e-3 * np.asarray(abs(stiffness).sum(axis=1)).ravel()
        error = float((np.abs(force) / np.maximum(load, stiff)).max(initial=0.0) + np.abs(gaps).max(initial=0.0))
        good = min(error, best) < 1e3 * TOLERANCE
        if good and (error >= 0.5 * best or error <= EXACT):
            # a step that balances no more may lead anywhere
            return sparse, *(before if error > best else (y, lam)), step
        if error < best:
            before, best = (y, lam), error
        found = _near(sparse, motion, solver(stiffness, rows), force, gaps)
        if found is None and good:
            return sparse, y, lam, step
        if found is None:
            found, shift = _down(sparse, (y, lam), (motion, still, rows, stiffness), (force, gaps), shift or first)
        change, more = found
        y, lam = sparse.moved(y, motion @ change), lam + sparse.whole(more)
        force, gaps = sparse.forces(y, lam)
        motion, _, rows, stiffness, _ = sparse.matrices(y, lam)
    raise AnalysisError(
        f"no equilibrium was found from this start: after {MOST_STEPS} steps {error:.3g} of the forces is not "
        "balanced; another start may lead to one"
    )


def _closed(sparse: Sparse) -> tuple[Array, int]:
    """Return a position that is nearly closed, and the steps taken: each the shortest one.

    Where rows depend on each other, as those of links in one line, everything is moved a little.
    """
    y, lam, rng = sparse.y, np.zeros(sparse.pattern.m), np.random.default_rng(0)
    for step in range(MOST_STEPS):
        motion, _, rows, _, _ = sparse.matrices(y, lam)
        force, gaps = sparse.forces(y, lam)
        solve = solver(_level(sparse), rows)
        if solve is not None and np.linalg.norm(gaps) <= OPENED:
            return y, step
        change = np.full(len(force), np.inf) if solve is None else solve(np.zeros(len(force)), -gaps)[0]
        long = _length(sparse, motion, change)
        if not long < SINGULAR:
            change, long = ASTRAY * rng.standard_normal(len(force)), 1.0
        y = sparse.moved(y, motion @ (min(1.0, REACH / max(long, 1e-300)) * change))
    raise AnalysisError("no equilibrium was found from this start: it cannot be closed; another start may do")


def _regular(stiffness: Any, rows: Any) -> Solver:
    found = solver(stiffness, rows)
    if found is None:
        raise AnalysisError("the rows cannot be told apart: some depend on others near the start")
    return found


def _level(sparse: Sparse) -> Any:
    """Return what steps are measured with: turns, and displacements over the mechanism's length.

    Not masses: light turns would be cheap, and short links fold like a fan rather than bend.
    """
    from scipy.sparse import eye

    return eye(sparse.pattern.nv, format="csc")


def _length(sparse: Sparse, motion: Any, change: Array) -> float:
    moved = np.abs(motion @ change) / sparse.lengths
    return float(moved.max(initial=0.0)) if np.all(np.isfinite(moved)) else np.inf


def _near(sparse: Sparse, motion: Any, solve: Solver | None, force: Array, gaps: Array) -> tuple[Array, Array] | None:
    """Return the step of Newton's method where it is short, else None."""
    if solve is None:
        return None
    found = solve(-force, -gaps)
    return found if _length(sparse, motion, found[0]) < NEAR else None


def _down(
    sparse: Sparse, at: tuple[Array, Array], matrices: tuple[Any, ...], right: tuple[Array, Array], shift: float
) -> tuple[tuple[Array, Array], float]:
    """Return a step downhill that is short enough, and the s that the next one is to be tried with."""
    (y, lam), (motion, still, rows, stiffness), (force, gaps) = at, matrices, right
    for _ in range(60):
        solve = solver(stiffness + shift * still, rows)
        if solve is not None:
            change, more = solve(-force, -gaps)
            long = _length(sparse, motion, change)
            steep = float(change @ ((stiffness + shift * still) @ change))
            if long <= REACH and steep > 0.0:
                then, open_ = sparse.forces(sparse.moved(y, motion @ change), lam + sparse.whole(more))
                ahead = float(change @ then) <= 0.5 * steep
                closed = np.linalg.norm(open_) <= max(OPENED, float(np.linalg.norm(gaps)))
                if ahead and closed:
                    return (change, more), shift * min(1.0, max(LEAST, 0.7 * long / REACH) ** 2)
        shift *= FASTER
    raise AnalysisError("no equilibrium was found from this start: no step leads downhill; another start may do")


def solver(stiffness: Any, rows: Any) -> Solver | None:
    """Return what solves with the sparse matrix of directions and rows, refined once; None where it is singular."""
    from scipy.sparse import bmat
    from scipy.sparse.linalg import splu

    n = stiffness.shape[0]
    scale = float(abs(stiffness).max()) or 1.0
    matrix = bmat([[stiffness / scale, rows.T], [rows, None]], format="csc")
    try:
        factors = splu(matrix)
    except RuntimeError:
        return None

    def solve(force: Array, gaps: Array) -> tuple[Array, Array]:
        right = np.concatenate([force / scale, gaps])
        found = factors.solve(right)
        found += factors.solve(right - matrix @ found)
        return found[:n], found[n:] * scale

    return solve
