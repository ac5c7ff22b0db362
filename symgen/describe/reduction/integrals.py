"""Integrals of the modes of a body: all that its equations of motion need of the finite elements."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from symgen.describe.reduction.basis import ModeBasis
from symgen.describe.reduction.finite_elements import Array, FiniteElements

#: Integrals below this part of the mass, or of the mass times the size of the body, are rounding.
ROUNDING = 1e-12


@dataclass(frozen=True)
class Integrals:
    """Inertia of a body as a function of the coordinates m of its modes; r components of a turn, d of a place.

    Attributes
    ----------
    inertia : Array, shape (r, r)
        About the centre of mass, without deformation [kg m^2].
    growth : Array, shape (k, r, r)
        First derivatives of the inertia by each coordinate [kg m].
    second : Array, shape (k, k, r, r)
        Halves of its second derivatives [kg].
    cross : Array, shape (k, k, r)
        Integrals of psi_i x psi_j dm [kg].
    """

    inertia: Array
    growth: Array
    second: Array
    cross: Array


def integrals_of(elements: FiniteElements, x: Array, modes: ModeBasis) -> Integrals:
    """Return the integrals over a body, whose nodes are at `x` from its centre of mass.

    Rotary inertias of nodes are part of the inertia; that they turn with the modes is of second order, and left out.
    """
    fields = _displacements(elements, modes.shapes)
    weighted = np.array([elements.density @ field for field in fields])
    whole, size = float(elements.density.sum()), elements.size
    rest = inertia_tensor(np.einsum("na,nb->ab", x, elements.density @ x)) + elements.rotary.sum(axis=0)
    mixed = np.einsum("na,knb->kab", x, weighted)
    products = np.einsum("ina,jnb->ijab", fields, weighted)
    second = np.array([[inertia_tensor(s) for s in line] for line in products])
    cross = np.array([[_axis(s) for s in line] for line in products])
    return Integrals(
        inertia=rest,
        growth=_without_rounding(2.0 * np.array([inertia_tensor(s) for s in mixed]), whole * size),
        second=_without_rounding((second + np.swapaxes(second, 0, 1)) / 2.0, whole),
        cross=_without_rounding((cross - np.swapaxes(cross, 0, 1)) / 2.0, whole),
    )


def _without_rounding(numbers: Array, scale: float) -> Array:
    """Return numbers with 0 in place of what is rounding: equations then leave these terms out."""
    return np.where(np.abs(numbers) > ROUNDING * scale, numbers, 0.0)


def _displacements(elements: FiniteElements, shapes: Array) -> Array:
    """Return the displacements of all nodes, shape (k, n, d)."""
    n, d = elements.x.shape
    return np.ascontiguousarray(shapes.T.reshape(-1, n, elements.unknowns)[:, :, :d])


def inertia_tensor(second: Array) -> Array:
    """Return the tensor tr(S) 1 - S of the symmetric part of second moments; in the plane its one entry."""
    s = (second + second.T) / 2.0
    return np.array([[np.trace(s)]]) if len(s) == 2 else np.trace(s) * np.eye(3) - s


def _axis(s: Array) -> Array:
    """Return the vector of a x b from the moments of a_i b_j."""
    if len(s) == 2:
        return np.array([s[0, 1] - s[1, 0]])
    return np.array([s[1, 2] - s[2, 1], s[2, 0] - s[0, 2], s[0, 1] - s[1, 0]])


@dataclass(frozen=True)
class InterfaceStiffness:
    """What an interface carries, and from when on linear modes are in doubt; d components of a place.

    The force on an interface, in body axes, is what balances its static shape of a unit motion, all others held:
    ``elastic m + shifted (r'' - g) + spread : (w'~ + w~ w~) + modal m''``.

    Attributes
    ----------
    elastic : Array, shape (d, k)
        By coordinates of modes [N/m].
    shifted : Array, shape (d, d)
        By the acceleration of the centre of mass less gravity [kg].
    spread : Array, shape (d, d, d)
        By the entries of the matrix of a rotation's accelerations [kg m].
    modal : Array, shape (d, k)
        By second derivatives of the coordinates of modes [kg].
    stiffness, length : float
        The least translational stiffness of an interface with another held [N/m], and the distance of the two [m].
    """

    elastic: Array
    shifted: Array
    spread: Array
    modal: Array
    stiffness: float
    length: float


#: The farthest node takes the place of a second interface where it is farther away than this times the farthest one.
FARTHER = 1.2


def bearings_of(elements: FiniteElements, x: Array, modes: ModeBasis) -> list[InterfaceStiffness]:
    """Return what each interface carries."""
    d, r = elements.dimension, elements.rotations
    motions = d + r
    fields = _displacements(elements, modes.shapes)
    weighted = np.array([elements.density @ field for field in fields])
    springs = elements.stiffness @ modes.shapes
    stiffness = modes.static.T @ (elements.stiffness @ modes.static)
    seats, bearings = list(modes.seats.values()), list[InterfaceStiffness]()
    for i, seat in enumerate(seats):
        moves = modes.static[:, motions * i : motions * i + d]
        shapes = _displacements(elements, moves)
        heavy = np.array([elements.density @ shape for shape in shapes])
        pairs = _pairs(stiffness, seats, i, motions)
        reach = float(np.linalg.norm(x - seat, axis=1).max())
        if reach > FARTHER * max((length for _, length in pairs), default=0.0):
            pairs.append(_free_end(elements, x, modes, seat))
        least, length = min(pairs, key=lambda pair: pair[0] * pair[1])
        bearings.append(
            InterfaceStiffness(
                elastic=moves.T @ springs,
                shifted=heavy.sum(axis=1),
                spread=np.einsum("anb,nc->abc", heavy, x),
                modal=np.einsum("anb,knb->ak", shapes, weighted),
                stiffness=least,
                length=length,
            )
        )
    return bearings


def _pairs(stiffness: Array, seats: list[Array], i: int, motions: int) -> list[tuple[float, float]]:
    """Return the least translational stiffness of an interface, and of each other one, with the other held."""
    pairs, d = list[tuple[float, float]](), len(seats[i])
    for j, other in enumerate(seats):
        length = float(np.linalg.norm(other - seats[i]))
        if j == i or length == 0.0:
            continue
        for held, free in ((i, j), (j, i)):
            left = [n for n in range(len(seats)) if n != held]
            places = np.concatenate([motions * n + np.arange(motions) for n in left])
            at = motions * left.index(free)
            gives = np.linalg.inv(stiffness[np.ix_(places, places)])[at : at + d, at : at + d]
            pairs.append((1.0 / float(np.linalg.eigvalsh(gives)[-1]), length))
    return pairs


def _free_end(elements: FiniteElements, x: Array, modes: ModeBasis, seat: Array) -> tuple[float, float]:
    """Return the least stiffness of the node that is farthest from an interface, all interfaces held."""
    away = np.linalg.norm(x - seat, axis=1)
    far = int(np.argmax(away))
    own = elements.unknowns * far + np.arange(elements.dimension)
    places = np.searchsorted(modes.inside, own)
    if modes.factor is None or not np.array_equal(modes.inside[np.minimum(places, len(modes.inside) - 1)], own):
        return np.inf, float(away[far])
    loads = np.zeros((len(modes.inside), len(own)))
    loads[places, np.arange(len(own))] = 1.0
    gives = modes.factor.solve(loads)[places]
    return 1.0 / float(np.linalg.eigvalsh((gives + gives.T) / 2.0)[-1]), float(away[far])
