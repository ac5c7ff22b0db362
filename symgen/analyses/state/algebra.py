"""Linear algebra that analyses share: the same decision on dependent rows everywhere."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import fields, is_dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from symgen.run.layout.compiled import ModelInfo

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]
#: Forces and violations to be removed -> the step and the change of the multipliers.
Solver = Callable[[Array, Array], tuple[Array, Array]]

#: Singular values of D below this fraction of the largest one count as zero.
DEPENDENT = 1e-9
#: Singular values of a linear system's matrix of n rows below n times this part of the largest one count as zero; so do
#: stiffnesses.
ZERO = 1e-14
#: A stiffness along a shape below this part of the numbers that it is the sum of is their rounding.
ROUNDED = 1e-13
#: Squares of frequencies below this part of the largest one are computed again, among themselves.
LOW = 1e-3
#: What of a stiffness is not symmetric is rounding below this part of what its shapes are restored by.
EVEN = 1e-9
#: Parts of the largest singular value of a dense matrix that count as zero, and of a right side that no step undoes.
RANK, UNSOLVED = 1e-13, 1e-6
#: Matrices with more rows than this are factored, which takes a twentieth of the time of their singular values.
FACTORED = 48


def null_space_split(d: Array, loads: Array | None = None) -> tuple[Array, Array, Array]:
    """Return an orthonormal basis of the rows' null space, their pseudo-inverse, and their dependencies.

    Parameters
    ----------
    d : Array, shape (m, n)
        Rows; each is scaled to length 1 before its rank is decided.
    loads : Array, shape (m,), optional
        Multipliers of rows that count as large as each other, as of `symgen.analyses.state.subject.Subject.loads`; all
        are 1 by default.

    Returns
    -------
    basis : Array, shape (n, n - r)
        Z with D Z = 0.
    inverse : Array, shape (n, m)
        D^+ with the rank of the scaled rows: right sides give changes of least norm, and forces, by its transpose,
        multipliers of least norm where each is divided by its load.
    left : Array, shape (m, m - r)
        Combinations of the scaled rows that vanish.
    """
    m, n = d.shape
    if m == 0:
        return np.eye(n), np.zeros((n, 0)), np.zeros((0, 0))
    sizes = np.linalg.norm(d, axis=1)
    sizes[sizes == 0.0] = 1.0
    u, s, vt = np.linalg.svd(d / sizes[:, None], full_matrices=True)
    rank = int(np.sum(s > DEPENDENT * s.max(initial=0.0)))
    inverse = (vt[:rank].T / s[:rank]) @ (u[:, :rank] / sizes[:, None]).T
    left = u[:, rank:]
    if left.shape[1]:  # scaled rows would share a load by their lengths
        loads = np.ones(m) if loads is None else loads
        nothing = np.linalg.qr(left / (sizes * loads)[:, None])[0]
        inverse = inverse - ((inverse / loads) @ nothing) @ nothing.T * loads
    return vt[rank:].T.copy(), inverse, left


def coordinate_differences(info: ModelInfo, a: Array, b: Array) -> Array:
    """Return differences of coordinates, without whole turns, of Euler parameters with the nearer sign."""
    gaps = a[: info.nq] - b[: info.nq]
    turns = np.array([q.unit == "rad" for q in info.coordinates], dtype=np.bool_)
    gaps[turns] -= 2.0 * np.pi * np.round(gaps[turns] / (2.0 * np.pi))
    for first, _ in info.spins:  # both signs are one orientation
        one, other = a[first : first + 4], b[first : first + 4]
        gaps[first : first + 4] = min(one - other, one + other, key=lambda x: float(np.linalg.norm(x)))
    return gaps


def symmetric_part(a: Array) -> Array:
    """Return the symmetric part of a matrix."""
    return 0.5 * (a + a.T)


def squares_along(mass: Any, stiffness: Any, directions: Array) -> tuple[Array, Array, bool]:
    """Return the squares of frequencies along directions, of the symmetric part of a stiffness, and if that is all.

    What counts as rounding is decided shape by shape: beside a stiff spring a pendulum is no less a pendulum.

    Parameters
    ----------
    mass, stiffness : Array or sparse, shape (nv, nv)
        M and K.
    directions : Array, shape (nv, n)
        Motions along which masses are definite.

    Returns
    -------
    squares : Array, shape (n,)
        In increasing order [1/s^2]; 0 where it is the rounding of its parts, or all of these are rounding beside the
        largest stiffness along the directions, whatever the masses.
    vectors : Array, shape (n, n)
        Shapes in terms of the directions, normalised by masses, one a column.
    even : bool
        Whether the stiffness is symmetric along the directions, as where forces have a potential.

    Raises
    ------
    scipy.linalg.LinAlgError
        If masses are not definite.
    """
    along = directions.T @ (stiffness @ directions)
    squares, vectors = _squares_and_shapes(mass, stiffness, directions)
    sizes = sum_of_parts(stiffness, directions @ vectors)
    restored = np.abs(squares)
    least = len(squares) * ZERO * np.abs(along).max(initial=0.0) * np.sum(vectors**2, axis=0)
    rounding = np.maximum(ROUNDED * sizes, least)
    limit = EVEN * np.maximum.outer(restored, restored) + np.sqrt(np.outer(rounding, rounding))
    even = not np.any(np.abs(vectors.T @ (along - along.T) @ vectors) > limit)
    return np.where((restored <= ROUNDED * sizes) | (sizes <= least), 0.0, squares), vectors, even


def _squares_and_shapes(mass: Any, stiffness: Any, directions: Array) -> tuple[Array, Array]:
    """Return squares of frequencies along directions in increasing order, and their shapes in terms of these.

    Each eigenvalue has an error that is a part of the largest one. Those far below it are computed again along their
    own shapes: the error of these enters as its square, and the largest eigenvalue is no longer there.
    """
    from scipy import linalg

    squares, vectors = linalg.eigh(*(symmetric_part(directions.T @ (a @ directions)) for a in (stiffness, mass)))
    low = np.abs(squares) < LOW * np.abs(squares).max(initial=0.0)
    if low.any():
        squares[low], within = _squares_and_shapes(mass, stiffness, directions @ vectors[:, low])
        vectors[:, low] = vectors[:, low] @ within
    return squares, vectors


def sum_of_parts(matrix: Any, shapes: Array) -> Array:
    """Return the sum of the sizes of all parts of x^T A x for each column x."""
    return np.asarray(np.sum(np.abs(shapes) * (abs(matrix) @ np.abs(shapes)), axis=0))


def eigenvalues_with_zeros(a: Array, sizes: Array | None = None) -> tuple[Complex, Complex]:
    """Return eigenvalues and eigenvectors, with exact zeros where the rank says so.

    A cyclic coordinate or a body that is free to go gives two zeros and one vector, which rounding parts into a pair of
    the square root of its own size. The ranks of the matrix and of its powers decide
    how many zeros there are. In double numbers that is a frequency below 1e-14 n of the
    largest one where each shape's size is its own, or else its square below that part of the largest square: beside
    vibrations of 1e6 rad/s, a swing of less than 0.1 or 0.2 rad/s counts as none.

    Parameters
    ----------
    a : Array, shape (n, n)
        The matrix.
    sizes : Array, shape (n,), optional
        What counts as large of each state, so that ranks do not depend on units; all are 1 by default.
    """
    sizes = np.ones(len(a)) if sizes is None else sizes
    a = a * sizes / sizes[:, np.newaxis]
    values, vectors = np.linalg.eig(a)
    values, n = values.astype(np.complex128), len(a)
    count, largest, rest = 0, 0.0, a
    while len(rest):
        _, s, vt = np.linalg.svd(rest)
        largest = largest or float(s[0])
        none = s <= n * ZERO * largest
        if not none.any():
            break
        count += int(none.sum())
        rest = vt[~none] @ rest @ vt[~none].T
    values[np.argsort(np.abs(values))[:count]] = 0.0
    return values, np.asarray(vectors * sizes[:, np.newaxis], dtype=np.complex128)


def rank_order(values: Array | Complex) -> NDArray[np.int64]:
    """Return the order by decreasing real, then decreasing imaginary part; values apart by rounding count as equal."""
    numbers = np.asarray(values, dtype=np.complex128)
    grain = 1e-12 * np.abs(numbers).max(initial=0.0) or 1.0
    return np.asarray(np.lexsort((-numbers.imag, -np.round(numbers.real / grain))), dtype=np.int64)


def sort_eigenvalues(values: Array | Complex) -> Complex:
    """Return eigenvalues by `rank_order`."""
    return (np.asarray(values, dtype=np.complex128) + 0.0)[rank_order(values)]


def numerical_rank(matrix: Array, least: float | None = None) -> int:
    """Return the number of singular values above a limit, NumPy's by default; 0 of an empty matrix in every NumPy."""
    return int(np.linalg.matrix_rank(matrix, tol=least)) if matrix.size else 0


def largest_magnitude(matrix: Any) -> float:
    """Return the largest magnitude of an element of a dense or sparse matrix, 0 of an empty one."""
    return float(abs(matrix).max()) if matrix.shape[0] else 0.0


def unit_stiffness(stiffness: Any) -> Any:
    """Return the identity, dense or sparse as a stiffness: turns, and displacements over the mechanism's length.

    Not masses: light turns would be cheap, and short links fold like a fan rather than bend.
    """
    from scipy.sparse import eye, issparse

    n = stiffness.shape[0]
    return eye(n, format="csc") if issparse(stiffness) else np.eye(n)


def _dense_inverse(matrix: Array) -> Callable[[Array], Array]:
    """Return the product with the pseudo-inverse of a square matrix; of a large regular one by its factors."""
    if len(matrix) > FACTORED:
        from scipy.linalg import lapack

        size = float(np.abs(matrix).sum(axis=0).max())
        factors, pivots, code = lapack.dgetrf(matrix)
        if code == 0 and lapack.dgecon(factors, size)[0] > RANK:
            return lambda right: lapack.dgetrs(factors, pivots, right)[0]
    return np.linalg.pinv(matrix, rcond=RANK).dot


def solver_with_rows(stiffness: Any, rows: Any) -> Solver | None:
    """Return the solver for the dense or sparse matrix of directions and rows.

    None where it is singular or not finite. Of dense ones it is the pseudo-inverse; a step is infinite where none
    undoes what it is to undo, such as a force along which the stiffness vanishes.
    """
    from scipy.sparse import bmat, issparse
    from scipy.sparse.linalg import splu

    matrix: Any
    inverse: Any
    n, scale, sparse = stiffness.shape[0], largest_magnitude(stiffness) or 1.0, issparse(stiffness)
    if sparse:
        matrix = bmat([[stiffness / scale, rows.T], [rows, None]], format="csc")
        try:
            inverse = splu(matrix).solve
        except RuntimeError:
            return None
    else:
        matrix = np.block([[stiffness / scale, rows.T], [rows, np.zeros((len(rows), len(rows)))]])
        if not np.all(np.isfinite(matrix)):
            return None
        inverse = _dense_inverse(matrix)

    def solve_refined(force: Array, gaps: Array) -> tuple[Array, Array]:
        right = np.concatenate([force / scale, gaps])
        solution = inverse(right)
        solution += inverse(right - matrix @ solution)
        if not sparse and not np.linalg.norm(right - matrix @ solution) <= UNSOLVED * np.linalg.norm(right):
            solution[:] = np.inf
        return solution[:n], solution[n:] * scale

    return solve_refined


def json_form(value: object) -> Any:
    """Return a result as JSON can express it: fields that a result shows, pairs of numbers for complex ones."""
    if is_dataclass(value):
        return {f.name: json_form(getattr(value, f.name)) for f in fields(value) if f.repr}
    if isinstance(value, Mapping):
        return {name: json_form(x) for name, x in value.items()}
    if isinstance(value, tuple):
        return [json_form(x) for x in value]
    if isinstance(value, complex):
        return [value.real, value.imag]
    if isinstance(value, np.ndarray):
        return (np.stack([value.real, value.imag], -1) if np.iscomplexobj(value) else value).tolist()
    return value
