"""Displacements of second order that leave bars of a body strained as linear modes say.

A bar that turns by a becomes shorter along its first direction by a^2 t / 2, and two turns make a third one. Modes,
which are linear, take that for strain. The displacements of second order that undo it follow from K: with these, forces
along a body stiffen and soften it, whether interfaces or inertia press on it.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy import sparse
from scipy.sparse.linalg import splu

from symgen.base.errors import InputError
from symgen.describe.reduction.basis import ModeBasis
from symgen.describe.reduction.finite_elements import Array, FiniteElements
from symgen.describe.reduction.integrals import ROUNDING, inertia_tensor

#: Stiffnesses of bars are symmetric to this part of the largest entry.
SKEW = 1e-6


@dataclass(frozen=True)
class SecondMotion:
    """Displacements of second order, of products of coordinates of modes.

    Attributes
    ----------
    place : Array, shape (i, k, k, d)
        Of interfaces [1/m]: ``m . place m``.
    turn : Array, shape (i, k, k, r)
        Turns of interfaces [1/m^2].
    second : Array, shape (k, k, r, r)
        What they add to the halves of second derivatives of the inertia [kg].
    """

    place: Array
    turn: Array
    second: Array


class _Bars(NamedTuple):
    """Bars of a body: nodes at their ends, and stiffness over the unknowns of both."""

    start: NDArray[np.int64]
    end: NDArray[np.int64]
    stiffness: Array  # (b, 2 u, 2 u)


def second_motion_of(
    elements: FiniteElements, x: Array, modes: ModeBasis, sets: Mapping[str, NDArray[np.int64]]
) -> SecondMotion:
    """Return the displacements of second order of a body of bars.

    Parameters
    ----------
    elements : FiniteElements
        The body.
    x : Array, shape (n, d)
        Nodes from the centre of mass.
    modes : ModeBasis
        Its modes.
    sets : mapping of str to Array of int
        Nodes of each interface.

    Raises
    ------
    InputError
        If K is not that of bars, whose nodes turn.
    """
    bars = _bars_of(elements)
    d, u, k, n = elements.dimension, elements.unknowns, modes.shapes.shape[1], len(x)
    pairs = np.array([(a, b) for a in range(k) for b in range(a, k)])
    strains = _strains_of_pairs(elements, x, modes.shapes, bars, pairs)
    loads = np.zeros((n, u, len(pairs)))
    forces = np.einsum("buv,bpv->bup", bars.stiffness, strains)
    np.add.at(loads, bars.start, forces[:, :u])
    np.add.at(loads, bars.end, forces[:, u:])
    free = np.arange(u, n * u)  # one node is held, as rigid motions are taken away below
    moved = np.zeros((n * u, len(pairs)))
    moved[free] = -splu(sparse.csc_array(elements.stiffness[free][:, free])).solve(loads.reshape(n * u, -1)[free])
    rigid = elements.rigid_motions(x, np.zeros(d))
    weighed = np.asarray(elements.mass @ rigid)
    moved -= rigid @ np.linalg.solve(rigid.T @ weighed, weighed.T @ moved)
    moved /= 2.0
    whole = np.zeros((k, k), dtype=np.int64)
    whole[pairs[:, 0], pairs[:, 1]] = whole[pairs[:, 1], pairs[:, 0]] = np.arange(len(pairs))
    place, turn = np.zeros((len(sets), k, k, d)), np.zeros((len(sets), k, k, elements.rotations))
    for i, (name, nodes) in enumerate(sets.items()):
        local = elements.rigid_motions(x[nodes], modes.seats[name])
        motion = np.linalg.lstsq(local, moved[elements.unknowns_of(nodes)], rcond=None)[0].T[whole]
        place[i], turn[i] = motion[:, :, :d], motion[:, :, d:]
    field = moved.reshape(n, u, -1)[:, :d]
    weighted = np.asarray(elements.density @ field.reshape(n, -1)).reshape(field.shape)
    second = np.array([2.0 * inertia_tensor(moments) for moments in np.einsum("na,nbp->pab", x, weighted)])
    return SecondMotion(_without_rounding(place), _without_rounding(turn), second[whole])


def _without_rounding(numbers: Array) -> Array:
    return np.where(np.abs(numbers) > ROUNDING * np.abs(numbers).max(initial=0.0), numbers, 0.0)


def _bars_of(elements: FiniteElements) -> _Bars:
    """Return the bars that K consists of, one for each block beside the diagonal.

    As no rigid motion strains a bar, the block gives its whole stiffness. From blocks of larger elements, a matrix
    results that is not symmetric.
    """
    x, u, n = elements.x, elements.unknowns, len(elements.x)
    expected = "bars from node to node, whose nodes turn, for stiffening = 'interfaces'"
    if not elements.turns:
        raise InputError("K", expected, "nodes that do not turn", "a part of solids is cut into several bodies")
    blocks = sparse.bsr_array(elements.stiffness, blocksize=(u, u))
    row = np.repeat(np.arange(n), np.diff(blocks.indptr))
    above = (row < blocks.indices) & (np.abs(blocks.data).max(axis=(1, 2)) > 0.0)
    start, end, beside = row[above], blocks.indices[above].astype(np.int64), blocks.data[above]
    mirrored = np.swapaxes(beside, 1, 2)
    there, back = (
        np.array([elements.rigid_motions(x[[j]], x[i]) for i, j in zip(*ends, strict=True)])
        for ends in ((start, end), (end, start))
    )
    own, other = -beside @ there, -mirrored @ back
    largest = max(float(np.abs(part).max()) for part in (own, other))
    if any(np.abs(part - np.swapaxes(part, 1, 2)).max() > SKEW * largest for part in (own, other)):
        raise InputError("K", expected, "elements that join more than two nodes")
    return _Bars(start, end, np.block([[own, beside], [mirrored, other]]))


def _strains_of_pairs(
    elements: FiniteElements, x: Array, shapes: Array, bars: _Bars, pairs: NDArray[np.int64]
) -> Array:
    """Return what bars are strained by at second order, as motions of their ends, shape (b, p, 2 u).

    The ends are seen from axes that turn with a bar: with its chord across, and with the mean of its ends along it.
    """
    d, r, u = elements.dimension, elements.rotations, elements.unknowns
    field = shapes.T.reshape(shapes.shape[1], len(x), u)
    moved, turned = _in_space(field[:, :, :d], d), _in_space(field[:, :, d:], r)
    step = _in_space(x[bars.end] - x[bars.start], d)
    length = np.linalg.norm(step, axis=1)[:, None]
    along = step / length
    apart = (moved[:, bars.end] - moved[:, bars.start]).swapaxes(0, 1)  # (b, k, 3)
    first, last = (turned[:, ends].swapaxes(0, 1) for ends in (bars.start, bars.end))
    axis, steps = along[:, None], step[:, None]
    mean = (first + last) / 2.0
    turn = np.cross(axis, apart) / length[:, None] + np.sum(mean * axis, axis=2, keepdims=True) * axis
    a, b = pairs.T
    first, last = first - turn, last - turn
    farther = sum(np.cross(turn[:, i], 0.5 * np.cross(turn[:, j], steps) - apart[:, j]) for i, j in ((a, b), (b, a)))
    across = [own - np.sum(own * axis, axis=2, keepdims=True) * axis for own in (first, last)]
    bow = sum(
        factor * np.sum(across[i][:, p] * across[j][:, q], axis=2)
        for i, j, factor in ((0, 0, 4.0), (0, 1, -2.0), (1, 1, 4.0))
        for p, q in ((a, b), (b, a))
    )
    farther = farther + (bow * length / 60.0)[:, :, None] * axis
    ends = [-0.5 * (np.cross(turn[:, a], own[:, b]) + np.cross(turn[:, b], own[:, a])) for own in (first, last)]
    motions = [np.zeros_like(farther)[:, :, :d], _turns_of(ends[0], r), farther[:, :, :d], _turns_of(ends[1], r)]
    return np.concatenate(motions, axis=2)


def _in_space(vectors: Array, size: int) -> Array:
    """Return vectors of the plane, or turns about its normal, as vectors in space."""
    if size == 3:
        return vectors
    whole = np.zeros((*vectors.shape[:-1], 3))
    whole[..., -1 if size == 1 else slice(0, 2)] = vectors[..., 0] if size == 1 else vectors
    return whole


def _turns_of(turns: Array, size: int) -> Array:
    """Return the components of turns that nodes have."""
    return turns if size == 3 else turns[..., 2:]
