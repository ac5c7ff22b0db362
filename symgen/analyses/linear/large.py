"""Equilibria and lowest modes of large mechanisms: sparse matrices, and shift-invert iterations of Lanczos.

Nothing is formulated for the whole mechanism: the descriptor form and its derivatives are sums over elements, from
looped code.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from symgen.analyses.linear.eigenmodes import Modes
from symgen.analyses.rest.equilibria import Equilibrium, joints_not_unique, reduced_squares, stability_in_words
from symgen.analyses.rest.settle import search_equilibrium
from symgen.analyses.state.algebra import (
    ROUNDED,
    Solver,
    null_space_split,
    solver_with_rows,
    sort_eigenvalues,
    sum_of_parts,
    symmetric_part,
    unit_stiffness,
)
from symgen.analyses.state.bent_parts import sentence_on_motion
from symgen.analyses.state.edges import sentence_on_edges
from symgen.analyses.state.moving_drivers import note_on_forces_of_time, note_on_moving_drivers, refuse_moving_drivers
from symgen.analyses.state.sparse_statics import Sparse
from symgen.analyses.state.subject import put_inputs_at_start
from symgen.base.errors import AnalysisError, InputError
from symgen.base.settings import Settings
from symgen.result.part_limits import MotionOfBodies
from symgen.run.layout import abi
from symgen.run.layout.probe import Ready
from symgen.run.loops.newton import Pattern
from symgen.run.planning.plan import Purpose
from symgen.run.planning.prepare import prepare

if TYPE_CHECKING:
    from symgen.describe.mechanism import Mechanism

Array = NDArray[np.float64]

#: An asymmetry of stiffness below this part of the restoring stiffness counts as zero; number of random motions that
#: test it.
UNEVEN, SEEN = 1e-8, 3
#: Number of reported squares of frequencies of a large mechanism at rest: those nearest to 0.
FREQUENCIES = 10
#: Up to this many velocities stiffness and masses are reduced as dense matrices.
DENSE = 120
#: Steps of an iteration that searches for negative squares.
LOOKED = 40


def descriptor_equilibrium(mechanism: Mechanism, settings: Settings) -> tuple[Sparse, Array, Array, int]:
    """Find the equilibrium that the start leads to: descriptor form, state, multipliers, and the steps taken.

    Parameters
    ----------
    mechanism : Mechanism
        The description.
    settings : Settings
        ``parameters``, ``inputs`` and ``start`` count; coordinates are those of bodies.

    Raises
    ------
    InputError
        If a setting is wrong.
    AnalysisError
        If no equilibrium is found.
    """
    placed = put_inputs_at_start(mechanism, settings)
    settings = replace(placed.settings, method="lagrange", integrator="radau5", shape="looped", coordinates="absolute")
    run = prepare(placed.mechanism, settings, Purpose.DESCRIBED)
    mechanism, compiled, start = run.mechanism, run.compiled, run.start
    pattern, y = Pattern.of(compiled, start.w), start.y.copy()
    y[pattern.nq :] = 0.0
    active = np.setdiff1d(np.arange(pattern.m), pattern.masked)
    return search_equilibrium(Sparse(mechanism, compiled, y, start.p, start.w, pattern, active), y)


def lowest_modes(mechanism: Mechanism, settings: Settings, count: int) -> Modes:
    """Find the modes of the lowest frequencies at the equilibrium that the start leads to.

    Parameters
    ----------
    mechanism, settings
        As for `descriptor_equilibrium`.
    count : int
        Number of modes.

    Raises
    ------
    InputError
        If a setting is wrong, something damps or turns, or a force follows what it moves.
    AnalysisError
        If no equilibrium is found.
    """
    sparse, y, lam, _ = descriptor_equilibrium(mechanism, settings)
    refuse_moving_drivers("at equilibrium", sparse.mechanism, sparse.compiled, sparse.p, 0.0)
    motion, mass, rows, stiffness, damping = sparse.matrices(y, lam)
    free = sparse.pattern.nv - len(sparse.active)
    if not 0 < count < free:
        raise InputError("count", f"fewer than the mechanism's {free} modes", str(count), "ask for all modes")
    if damping.nnz and abs(damping).max() > 0.0:  # at rest nothing turns, so that only dampers remain
        raise InputError("count", "a mechanism without dampers", "one that has some", "ask for all modes")
    if _has_follower_forces(stiffness, rows):
        raise InputError("count", "forces that have a potential", "one that has none", "ask for all modes")
    squares, vectors = _squares_nearest_zero(stiffness, mass, rows, count)
    roots = np.sqrt(-squares.astype(np.complex128))
    names = tuple(q.name for q in sparse.compiled.info.coordinates)
    about = {name: float(x) for name, x in zip(names, y, strict=False)}
    shapes = (motion @ vectors).T.astype(np.complex128)
    owners = np.array([v.name.rpartition(".")[0] for v in sparse.compiled.info.velocities])
    notes = (*_sentences_on_state(sparse, y), *sentence_on_edges(sparse, y))
    energy = vectors * (mass @ vectors)
    bodies = {body: energy[owners == body].sum(axis=0) / energy.sum(axis=0) for body in dict.fromkeys(owners.tolist())}
    return Modes(
        sort_eigenvalues(np.concatenate([roots, -roots])),
        squares,
        free,
        names,
        shapes,
        bodies,
        about=about,
        notes=notes,
    )


def large_equilibrium(mechanism: Mechanism, settings: Settings) -> Equilibrium:
    """Find the equilibrium that the start leads to, by sparse matrices; of many squares those nearest to 0.

    Parameters
    ----------
    mechanism, settings
        As for `descriptor_equilibrium`.

    Raises
    ------
    InputError, AnalysisError
        As by `descriptor_equilibrium`.
    """
    sparse, y, lam, steps = descriptor_equilibrium(mechanism, settings)
    _, mass, rows, stiffness, _ = sparse.matrices(y, lam)
    free = sparse.pattern.nv - len(sparse.active)
    if sparse.pattern.nv <= DENSE or free <= FREQUENCIES or _has_follower_forces(stiffness, rows):
        small = sparse.pattern.nv <= DENSE or free > FREQUENCIES
        basis = null_space_split(rows.toarray())[0] if small else _free_directions(rows, free)
        squares = reduced_squares(mass, stiffness, basis)
        stability = stability_in_words(squares)
    else:
        squares = _squares_nearest_zero(stiffness, mass, rows, FREQUENCIES)[0]
        stability = stability_in_words(np.append(squares, _far_negative_square(stiffness, mass, rows, squares)))
    info, columns = sparse.compiled.info, sparse.compiled.info.joint_coordinates
    out = np.zeros(info.m + 2 * len(columns))
    observe = Ready(sparse.compiled.model.observe, abi.OBSERVE)
    observe(0.0, y.copy(), sparse.p, sparse.w.copy(), np.zeros(info.ny), out)
    lam, share = _smallest_multipliers(sparse, y, lam)
    places = {c.name: float(x) for c, x in zip(info.coordinates, y, strict=False)}
    return Equilibrium(
        q=places | {c.name: float(x) for c, x in zip(columns, out[info.m :: 2], strict=True)},
        stability=stability,
        omega_squared=tuple(float(x) for x in squares.real),
        residual=float(np.abs(sparse.forces(y, lam)[0] / sparse.spans).max(initial=0.0)),
        iterations=steps,
        states={x.name: float(y[info.own_states][i]) for i, x in enumerate(info.states)},
        multipliers={row.name: float(x) for row, x in zip(info.rows, lam, strict=True)},
        not_unique=joints_not_unique(mechanism, info, share),
        y=y,
        lam=lam,
        notes=(
            *note_on_moving_drivers(sparse.mechanism, sparse.compiled, sparse.p, 0.0),
            *_sentences_on_state(sparse, y),
            *sentence_on_edges(sparse, y),
        ),
    )


def _sentences_on_state(sparse: Sparse, y: Array) -> tuple[str, ...]:
    """Return remarks on the model, and sentences on forces of time and on parts that bend at a state of rest."""
    info, still = sparse.compiled.info, np.zeros((1, sparse.pattern.nv))
    values = {q.name: float(x) for q, x in zip(info.parameters, sparse.p, strict=False)}
    return (
        *sparse.mechanism.remarks,
        *note_on_forces_of_time(sparse.mechanism, 0.0),
        *sentence_on_motion(sparse.mechanism, values, MotionOfBodies(y[np.newaxis, : info.nq], still, still)),
    )


def _has_follower_forces(stiffness: Any, rows: Any) -> bool:
    """Whether the stiffness along free directions is not symmetric, as with forces that follow a body.

    What is not symmetric beside it is the rows' to take, and is no part of any motion: seen by some motions at random.
    """
    apart = stiffness - stiffness.T
    if not apart.nnz:
        return False
    # motions by forces of one size: what is soft moves most, so that nothing stiff beside it hides it
    moved, even = solver_with_rows(stiffness, rows), _solver_or_refuse(unit_stiffness(stiffness), rows)
    none, most = np.zeros(rows.shape[0]), float(abs(stiffness).max())
    for anything in np.random.default_rng(0).standard_normal((SEEN, stiffness.shape[0])):
        force = even(anything, none)[0]
        along = force if moved is None else moved(force, none)[0]
        restored = most * np.abs(along).max() if moved is None else np.abs(force).max()
        limit = UNEVEN * restored + ROUNDED * np.abs(abs(apart) @ np.abs(along)).max()
        if np.abs(even(apart @ along, none)[0]).max(initial=0.0) > limit:
            return True
    return False


def _free_directions(rows: Any, free: int) -> Array:
    """Return an orthonormal basis of the few velocities that rows leave free, shape (nv, free)."""
    n, none = rows.shape[1], np.zeros(rows.shape[0])
    solve = _solver_or_refuse(unit_stiffness(rows.T @ rows), rows)
    anything = np.random.default_rng(0).standard_normal((free, n))  # what is left of it is a basis almost surely
    basis = np.linalg.qr(np.array([solve(x, none)[0] for x in anything]).reshape(free, n).T)[0]
    return np.asarray(basis)


def _smallest_multipliers(sparse: Sparse, y: Array, lam: Array) -> tuple[Array, Array]:
    """Return the smallest multipliers that exert the same, and the share of each row in what exerts nothing."""
    extra = np.setdiff1d(np.arange(sparse.pattern.m), sparse.active)
    if not len(extra):
        return lam, np.zeros(sparse.pattern.m)
    whole = replace(sparse, active=np.arange(sparse.pattern.m)).derivatives(y, np.zeros(sparse.pattern.m))[1].tocsr()
    active = whole[sparse.active]
    solve = _solver_or_refuse(unit_stiffness(whole.T @ whole), active)
    # D_extra = C D_kept, so that (C, -1) exerts nothing: C from least squares
    none = np.zeros((len(extra), sparse.pattern.m))
    for i, row in enumerate(extra):
        none[i, sparse.active] = solve(whole[row].toarray().ravel(), np.zeros(len(sparse.active)))[1]
        none[i, row] = -1.0
    loads = sparse.loads
    basis = np.linalg.qr(none.T / (sparse.gaps * loads)[:, np.newaxis])[0]
    return lam - loads * (basis @ (basis.T @ (lam / loads))), np.linalg.norm(basis, axis=1)


def _squares_nearest_zero(stiffness: Any, mass: Any, rows: Any, count: int) -> tuple[Array, Array]:
    """Return the squares of frequencies nearest to 0 in increasing order, and their shapes."""
    from scipy.sparse.linalg import LinearOperator, eigsh

    n, none = stiffness.shape[0], np.zeros(rows.shape[0])
    solve = _solver_or_refuse(stiffness, rows)
    inverse = LinearOperator((n, n), matvec=lambda x: solve(x, none)[0], dtype=np.float64)
    begin = solve(mass @ np.ones(n), none)[0]
    squares, vectors = eigsh(
        symmetric_part(stiffness), k=count, M=mass, sigma=0.0, OPinv=inverse, v0=begin, which="LM", tol=0.0
    )
    order = np.argsort(squares)
    squares, vectors = squares[order], vectors[:, order]
    nothing = np.abs(squares) <= ROUNDED * sum_of_parts(stiffness, vectors)
    return np.where(nothing, 0.0, squares), np.asarray(vectors)


def _far_negative_square(stiffness: Any, mass: Any, rows: Any, squares: Array) -> list[float]:
    """Return a negative square of a frequency that is not among those nearest to 0, if one is found.

    By Lanczos' iteration with (K - s M)^-1 for shifts s far below 0, one after the other: its values are negative for
    squares below s alone. A negative value among those of a part of the space proves one.
    """
    heavy = mass.diagonal()
    heavy = heavy[heavy > 0.0]
    shift = -1.05 * float(np.abs(squares).max(initial=0.0))
    end = -float(abs(stiffness).sum(axis=1).max()) / float(heavy.min(initial=np.inf))
    none, rng = np.zeros(rows.shape[0]), np.random.default_rng(0)
    while end < shift < 0.0:
        solve = _solver_or_refuse(stiffness - shift * mass, rows)
        x = solve(mass @ rng.standard_normal(stiffness.shape[0]), none)[0]
        basis, images = list[Array](), list[Array]()
        for _ in range(LOOKED):
            for _ in range(2):
                for other in basis:
                    x = x - other * float(other @ (mass @ x))
            size = float(np.sqrt(max(0.0, x @ (mass @ x))))
            if size < 1e-300:
                break
            basis.append(x / size)
            images.append(solve(mass @ basis[-1], none)[0])
            x = images[-1].copy()
        values = np.linalg.eigvalsh(symmetric_part(np.array(basis) @ (mass @ np.array(images).T)))
        if values[0] < -1e-9 * abs(values[-1]):
            return [shift + 1.0 / float(values[0])]
        shift *= 1e3
    return []


def _solver_or_refuse(stiffness: object, rows: object) -> Solver:
    solution = solver_with_rows(stiffness, rows)
    if solution is None:
        raise AnalysisError("the stiffness is singular: something can move without a force")
    return solution
