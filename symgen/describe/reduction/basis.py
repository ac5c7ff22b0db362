"""Modes of a body: rigid interfaces and Craig and Bampton's basis, then what of it is orthogonal to rigid motions.

Any such basis contains the rigid motions. What is orthogonal to them in the metric of M has neither momentum nor
angular momentum about the centre of mass: modes about mean axes, Tisserand's, without any loss of generality.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy import linalg, sparse
from scipy.sparse.linalg import LinearOperator, SuperLU, eigsh, splu

from symgen.base.errors import InputError, plural
from symgen.describe.reduction.finite_elements import Array, FiniteElements, Sparse

#: From this many unknowns on eigenvalues are found one by one.
DENSE = 600
#: A combination of modes with less of the largest modal mass is none.
EMPTY = 1e-12
#: Squares of frequencies below this part of the largest one are not above 0.
SOFT = 1e-12


@dataclass(frozen=True)
class ModeBasis:
    """Modes of a body.

    Attributes
    ----------
    shapes : Array, shape (n u, k)
        With psi_i . M psi_j = m delta_ij.
    squares : Array, shape (k,)
        Squares of their frequencies [1/s^2].
    seats : dict of str to Array
        Middle of each interface from the centre of mass.
    static : Array, shape (n u, (d + r) i)
        Static shapes of unit motions of the interfaces, in their order.
    factor : SuperLU or None
        Of K inside.
    inside : Array of int
        Unknowns that belong to no interface.
    """

    shapes: Array
    squares: Array
    seats: dict[str, Array]
    static: Array
    factor: SuperLU | None
    inside: NDArray[np.int64]


def modes_of(elements: FiniteElements, x: Array, sets: Mapping[str, NDArray[np.int64]], inner: int) -> ModeBasis:
    """Return the modes of a body.

    Parameters
    ----------
    elements : FiniteElements
        The body.
    x : Array, shape (n, d)
        Nodes from the centre of mass.
    sets : mapping of str to Array of int
        Nodes of each interface.
    inner : int
        Number of modes with all interfaces held; without interfaces, number of modes of the free body.
    """
    m, k = elements.mass, elements.stiffness
    rigid = elements.rigid_motions(x, np.zeros(elements.dimension))
    seats = {name: x[nodes].mean(axis=0) for name, nodes in sets.items()}
    everything = np.arange(m.shape[0])
    tied = np.concatenate([*(elements.unknowns_of(nodes) for nodes in sets.values()), np.zeros(0, np.int64)])
    inside = np.setdiff1d(everything, tied).astype(np.int64)
    static, factor = np.zeros((m.shape[0], 0)), None
    if not sets:
        basis = _free_modes(m, k, rigid, inner)
        count = inner
    else:
        links = linalg.block_diag(*(elements.rigid_motions(x[s], seats[name]) for name, s in sets.items()))
        static = np.zeros((m.shape[0], links.shape[1]))
        static[tied] = links
        if len(inside):
            factor = _factor(k[inside][:, inside])
            static[inside] = -factor.solve(np.asarray(k[inside][:, tied] @ links))
        basis = static
        if inner:
            whole = np.zeros((m.shape[0], inner))
            whole[inside] = _fixed_modes(m[inside][:, inside], k[inside][:, inside], factor, inner)
            basis = np.hstack([static, whole])
        count = basis.shape[1] - rigid.shape[1]
    shapes, squares = _without_rigid_motions(elements, basis, rigid, count)
    return ModeBasis(shapes, squares, seats, static, factor, inside)


def _factor(k: Sparse) -> SuperLU:
    try:
        return splu(sparse.csc_array(k))
    except RuntimeError:
        got = "one that leaves nodes loose while all interfaces are held"
        raise InputError("K", "a stiffness that connects all nodes", got) from None


def _fixed_modes(m: Sparse, k: Sparse, factor: SuperLU | None, count: int) -> Array:
    """Return the lowest modes with all interfaces held."""
    size = m.shape[0]
    if count > size:
        raise InputError("inner", f"at most {size} modes, as many as unknowns inside", str(count))
    if size <= DENSE or count >= size - 1:  # M may be singular, K is not: K x = omega^2 M x by the largest 1/omega^2
        _, shapes = linalg.eigh(m.toarray(), k.toarray(), subset_by_index=(size - count, size - 1))
        return np.asarray(shapes[:, ::-1])
    assert factor is not None
    inverse = LinearOperator((size, size), matvec=factor.solve, dtype=np.float64)
    start = np.random.default_rng(0).standard_normal(size)
    return np.asarray(eigsh(k, count, m, sigma=0.0, OPinv=inverse, v0=start)[1])


def _free_modes(m: Sparse, k: Sparse, rigid: Array, count: int) -> Array:
    """Return the lowest modes of the free body, and its rigid motions."""
    size, more = m.shape[0], count + rigid.shape[1]
    if more > size:
        raise InputError("inner", f"at most {size - rigid.shape[1]} modes of the free body", str(count))
    # of two stiffnesses of a rigid body on springs that give all of its motions one low frequency
    shift = -1e-4 * float(k.diagonal().mean() / m.diagonal().mean()) / size
    if size <= DENSE or more >= size - 1:
        dense_m = m.toarray()
        _, shapes = linalg.eigh(dense_m, (k - shift * m).toarray(), subset_by_index=(size - more, size - 1))
        return np.asarray(shapes)
    start = np.random.default_rng(0).standard_normal(size)
    return np.asarray(eigsh(k, more, m, sigma=shift, v0=start)[1])


def _without_rigid_motions(elements: FiniteElements, basis: Array, rigid: Array, count: int) -> tuple[Array, Array]:
    """Return the modes that a basis has besides rigid motions, and the squares of their frequencies."""
    m, k = elements.mass, elements.stiffness
    momenta = np.linalg.inv(rigid.T @ (m @ rigid))
    whole = float(elements.density.sum())

    def freed(shapes: Array) -> Array:
        return np.asarray(shapes - rigid @ (momenta @ (rigid.T @ (m @ shapes))))

    basis = freed(basis / np.sqrt(np.maximum(np.sum(basis * (m @ basis), axis=0), np.finfo(float).tiny)))
    masses, combined = linalg.eigh(basis.T @ (m @ basis))
    if count < 1 or masses[-count] <= EMPTY * masses[-1]:
        raise InputError("interfaces", "motions that are independent", f"fewer than {plural(count, 'mode')}")
    shapes = basis @ (combined[:, -count:] / np.sqrt(masses[-count:]))
    for _ in range(2):  # once more: rounding leaves nothing of rigid motions
        shapes = freed(shapes)
        lower = np.linalg.cholesky(shapes.T @ (m @ shapes))
        shapes = linalg.solve_triangular(lower, shapes.T, lower=True).T
    squares, combined = linalg.eigh(shapes.T @ (k @ shapes))
    if not squares[0] > SOFT * squares[-1]:
        got = "one with a shape of the body that costs no energy, or less than none"
        raise InputError("K", "a stiffness against all deformations", got, "a part may be loose")
    shapes = shapes @ combined * np.sqrt(whole)
    largest = np.abs(shapes).argmax(axis=0)  # a mode's sign means nothing: its largest entry is positive
    return shapes * np.sign(shapes[largest, np.arange(count)]), squares
