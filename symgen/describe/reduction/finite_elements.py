"""The finite elements of a body: nodes, M and K, checked; its rigid motions."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy import sparse

from symgen.base.arguments import kind_of_value
from symgen.base.errors import InputError, plural, quote
from symgen.describe.coordinate_names import names_of_modal_body
from symgen.describe.formulas.identifiers import check_identifier
from symgen.describe.modal_body import MOST_MODES

Array = NDArray[np.float64]
#: A sparse array, in compressed columns; the types of SciPy do not tell what their products with arrays are.
Sparse = Any

#: A rigid motion may exert this part of the largest entries of K.
LOOSE = 1e-6
#: Entries of a symmetric matrix may differ by this part of the largest one.
ROUNDING = 1e-9
#: A body that weighs less than this over the cube of its size [kg/m^3] is not in SI units: a steel wire as thin as a
#: twenty-thousandth of its length weighs more.
LIGHTEST = 1e-5
#: Names that interfaces do not have: of points, axes and the force of the springs.
RESERVED = ("centre", "origin", "ex", "ey", "ez", "elastic")
#: Names of the directions of rigid motions.
DIRECTIONS = {
    2: ("translation along x", "translation along y", "rotation about z"),
    3: (*(f"translation along {x}" for x in "xyz"), *(f"rotation about {x}" for x in "xyz")),
}


@dataclass(frozen=True)
class FiniteElements:
    """The finite elements of a body.

    Attributes
    ----------
    x : Array, shape (n, d)
        Places of the nodes, in the plane or in space [m].
    mass, stiffness : sparse arrays, shape (n u, n u)
        Over the u unknowns of each node, node by node: displacements, then turns where nodes have them.
    density : sparse array, shape (n, n)
        Mass of one component of the displacements.
    rotary : Array, shape (n, r, r)
        Rotary inertia of the nodes; 0 for solids, whose nodes do not turn.
    """

    x: Array
    mass: Sparse
    stiffness: Sparse
    density: Sparse
    rotary: Array

    @property
    def dimension(self) -> int:
        """Number of components of a place."""
        return int(self.x.shape[1])

    @property
    def rotations(self) -> int:
        """Number of components of a turn: 1 in the plane, 3 in space."""
        return 1 if self.dimension == 2 else 3

    @property
    def unknowns(self) -> int:
        """Number of unknowns of a node."""
        return int(self.mass.shape[0]) // len(self.x)

    @property
    def turns(self) -> bool:
        """Whether nodes have turns."""
        return self.unknowns > self.dimension

    @property
    def size(self) -> float:
        """The diagonal of the box that holds all nodes [m]."""
        return float(np.linalg.norm(np.ptp(self.x, axis=0)))

    def rigid_motions(self, places: Array, seat: Array) -> Array:
        """Return the displacements of nodes in rigid motions about a seat, shape (n u, d + r): moves, then turns."""
        d, r = self.dimension, self.rotations
        motion = np.zeros((len(places), self.unknowns, d + r))
        motion[:, :d, :d] = np.eye(d)
        away = places - seat
        if d == 2:
            motion[:, 0, 2], motion[:, 1, 2] = -away[:, 1], away[:, 0]
        else:
            for a in range(3):
                motion[:, :3, 3 + a] = np.cross(np.eye(3)[a], away)
        if self.turns:
            motion[:, d:, d:] = np.eye(r)
        return motion.reshape(-1, d + r)

    def unknowns_of(self, nodes: NDArray[np.int64]) -> NDArray[np.int64]:
        """Return the places of the unknowns of some nodes in M and K."""
        return np.asarray((nodes[:, None] * self.unknowns + np.arange(self.unknowns)).ravel())


def read_elements(nodes: object, mass: object, stiffness: object) -> FiniteElements:
    """Return finite elements whose arrays are right.

    Raises
    ------
    InputError
        At the first thing that is wrong.
    """
    x = _places(nodes)
    n, d = x.shape
    m, k = _matrix("M", mass), _matrix("K", stiffness)
    per_node = (2, 3) if d == 2 else (3, 6)
    for name, matrix in (("M", m), ("K", k)):
        if matrix.shape[0] not in (n * u for u in per_node) or matrix.shape != k.shape:
            sizes = " or ".join(str(n * u) for u in per_node)
            expected = f"{per_node[0]} or {per_node[1]} unknowns a node, so {sizes} rows for {plural(n, 'node')}"
            raise InputError(name, expected, f"a matrix of shape {matrix.shape}")
    density, rotary, lumped = _masses(m, n, d)
    whole = float(density.sum())
    if not whole > 0.0:
        raise InputError("M", "a mass above 0", f"{whole:g} kg", "the density of the material is missing")
    elements = FiniteElements(x, lumped, k, density, rotary)
    if whole < LIGHTEST * elements.size**3:
        got = f"{whole:.3g} kg in a body of {elements.size:.3g} m"
        raise InputError("nodes, M", "SI units: metres, kilograms, seconds", got, "tonnes and mm?")
    _refuse_held(elements)
    return elements


def _places(nodes: object) -> Array:
    try:
        x = np.asarray(nodes, dtype=np.float64)
    except (TypeError, ValueError):
        x = np.zeros(0)
    if x.ndim != 2 or x.shape[1] not in (2, 3) or len(x) < 2:
        expected = "places of two nodes or more, shape (n, 2) in the plane or (n, 3) in space"
        raise InputError("nodes", expected, kind_of_value(nodes))
    if not np.all(np.isfinite(x)):
        raise InputError(
            "nodes", "finite places", f"{x[~np.isfinite(x)][0]} at node {np.argwhere(~np.isfinite(x))[0][0]}"
        )
    return x


def _matrix(name: str, given: object) -> Sparse:
    """Return a symmetric matrix in compressed columns."""
    try:
        plain: Any = given
        matrix = sparse.csc_array(plain, dtype=np.float64)
    except (TypeError, ValueError):
        raise InputError(name, "a matrix, sparse or not", kind_of_value(given)) from None
    if matrix.ndim != 2 or matrix.shape[0] != matrix.shape[1]:
        raise InputError(name, "a square matrix", f"one of shape {matrix.shape}")
    if not np.all(np.isfinite(matrix.data)):
        raise InputError(name, "finite entries", f"{matrix.data[~np.isfinite(matrix.data)][0]}")
    largest = float(abs(matrix).max()) if matrix.nnz else 0.0
    skew = float(abs(matrix - matrix.T).max()) if matrix.nnz else 0.0
    if skew > ROUNDING * largest:
        raise InputError(name, "a symmetric matrix", f"entries that differ from their mirror images by {skew:.3g}")
    diagonal = matrix.diagonal()
    if len(diagonal) and float(diagonal.min()) < -ROUNDING * largest:
        raise InputError(name, "a matrix without negative entries on its diagonal", f"{diagonal.min():.3g}")
    return sparse.csc_array((matrix + matrix.T) / 2.0)


def _masses(m: Sparse, n: int, d: int) -> tuple[Sparse, Array, Sparse]:
    """Return the mass of one component, the rotary inertias, and M: as given for solids, else lumped at nodes.

    A lumped node has the sum of its row: mass is kept exactly, and what displacements and turns share is left out,
    which is of the order of the elements' size. Where such sums are negative, as at corners of quadratic elements, it
    has its share of the diagonal (Hinton, Rock and Zienkiewicz).
    """
    unknowns, r = m.shape[0] // n, 1 if d == 2 else 3
    if unknowns == d:
        density = sparse.csc_array(m[::d, ::d])
        apart = abs(sparse.kron(density, sparse.eye_array(d)) - m).max()
        if float(apart) <= ROUNDING * float(abs(m).max()):
            return density, np.zeros((n, r, r)), m
    sums = _row_sums(m, n, unknowns)
    lumps, rotary = _lumped(sums, d, r)
    if float(lumps.min()) < 0.0 or float(np.linalg.eigvalsh(rotary).min()) < -ROUNDING * float(np.abs(rotary).max()):
        own = _diagonal_blocks(m, n, unknowns)
        shares, rotary = _lumped(own, d, r)
        factor = float(lumps.sum()) / (float(shares.sum()) or 1.0)
        lumps, rotary = factor * shares, factor * rotary
    blocks = np.zeros((n, unknowns, unknowns))
    blocks[:, :d, :d] = lumps[:, None, None] * np.eye(d)
    blocks[:, d:, d:] = rotary[:, : unknowns - d, : unknowns - d]
    along = np.arange(n + 1, dtype=np.int32)
    return sparse.diags_array(lumps).tocsc(), rotary, sparse.csc_array(sparse.bsr_array((blocks, along[:-1], along)))


def _lumped(blocks: Array, d: int, r: int) -> tuple[Array, Array]:
    """Return the mass and the rotary inertia that a block for each node has; 0 for nodes without turns."""
    rotary = np.zeros((len(blocks), r, r))
    if blocks.shape[1] > d:
        rotary = (blocks[:, d:, d:] + np.swapaxes(blocks[:, d:, d:], 1, 2)) / 2.0
    return np.trace(blocks[:, :d, :d], axis1=1, axis2=2) / d, rotary


def _diagonal_blocks(m: Sparse, n: int, unknowns: int) -> Array:
    """Return for each node its own block, shape (n, unknowns, unknowns)."""
    entries = m.tocoo()
    same = entries.row // unknowns == entries.col // unknowns
    row, col = entries.row[same], entries.col[same]
    blocks = np.zeros((n, unknowns, unknowns))
    blocks[row // unknowns, row % unknowns, col % unknowns] = entries.data[same]
    return blocks


def _row_sums(m: Sparse, n: int, unknowns: int) -> Array:
    """Return for each node the sum of the blocks of its row, shape (n, unknowns, unknowns)."""
    ones = sparse.kron(np.ones((n, 1)), sparse.eye_array(unknowns))
    return np.asarray((m @ ones).todense()).reshape(n, unknowns, unknowns)


def _refuse_held(elements: FiniteElements) -> None:
    """Refuse a stiffness that holds the body."""
    x, k = elements.x, elements.stiffness
    motions = elements.rigid_motions(x, x.mean(axis=0))
    motions[:, elements.dimension :] /= elements.size or 1.0
    forces = np.abs(k @ motions).max(axis=0)
    largest = float(abs(k).max()) if k.nnz else 0.0
    if largest == 0.0:
        raise InputError("K", "a stiffness", "zeros")
    for direction, force in zip(DIRECTIONS[elements.dimension], forces, strict=True):
        if force > LOOSE * largest:
            got = f"one that holds it against {direction}, by {force / largest:.2g} of its largest entry"
            hint = "leave out supports, and all unknowns of the nodes in"
            raise InputError("K", "the stiffness of a body that nothing holds", got, hint)


def read_interfaces(given: object, elements: FiniteElements) -> dict[str, NDArray[np.int64]]:
    """Return the nodes of each interface.

    Raises
    ------
    InputError
        If a node is unknown or in two interfaces, or nodes leave the turn of an interface open.
    """
    if given is None:
        return {}
    if not isinstance(given, Mapping):
        raise InputError("interfaces", "a dictionary of names and lists of nodes", kind_of_value(given))
    sets, taken = dict[str, NDArray[np.int64]](), dict[int, str]()
    for name, nodes in given.items():
        where = f"interfaces[{quote(name)}]"
        check_identifier(name, "interfaces", "interface")
        if name in (*RESERVED, *names_of_modal_body(elements.dimension, MOST_MODES)):
            raise InputError("interfaces", "another name", f"'{name}', which a modal body has already")
        sets[name] = own = _node_numbers(where, nodes, len(elements.x))
        for node in own.tolist():
            if node in taken:
                raise InputError(where, "nodes of no other interface", f"node {node}, which is in '{taken[node]}'")
            taken[node] = name
        if elements.turns and len(own) >= 1:
            continue
        away = elements.x[own] - elements.x[own].mean(axis=0)
        spread = np.linalg.svd(away, compute_uv=False)
        spread = np.concatenate([spread, np.zeros(2)])
        needed = 1 if elements.dimension == 2 else 2
        if spread[needed - 1] <= ROUNDING * elements.size:
            expected = "two nodes or more" if needed == 1 else "three nodes or more that are not in a line"
            got = plural(len(own), "node") + (" in a line" if len(own) > 2 else "")
            raise InputError(where, f"{expected}, as nodes of solids do not turn", got, "its turn is undetermined")
    return sets


def _node_numbers(where: str, nodes: object, count: int) -> NDArray[np.int64]:
    try:
        numbers = np.asarray(nodes)
    except (TypeError, ValueError):
        numbers = np.zeros(0)
    if numbers.ndim == 0 and np.issubdtype(numbers.dtype, np.integer):
        numbers = numbers[None]
    if numbers.ndim != 1 or not len(numbers) or not np.issubdtype(numbers.dtype, np.integer):
        raise InputError(where, "a list of numbers of nodes", kind_of_value(nodes))
    for node in numbers.tolist():
        if not 0 <= node < count:
            raise InputError(where, f"nodes from 0 to {count - 1}", f"node {node}")
    return np.unique(numbers.astype(np.int64))


def refuse_massless(elements: FiniteElements, inside: NDArray[np.int64]) -> None:
    """Refuse inner nodes without mass, which would move freely."""
    masses = elements.density.diagonal()  # sums of rows are negative at corners of quadratic tetrahedra
    least = float(masses.max()) * 1e-12
    for node in inside.tolist():
        if masses[node] <= least:
            hint = "put mass there, eliminate the node from K, or make it an interface"
            raise InputError("M", "a mass for each node that is in no interface", f"none at node {node}", hint)


def read_lines(given: object, count: int) -> list[NDArray[np.int64]]:
    """Return the lines of nodes of an outline."""
    if isinstance(given, str) or not isinstance(given, Sequence | np.ndarray):
        raise InputError("outline", "a list of lines, each a list of numbers of nodes", kind_of_value(given))
    lines = []
    for i, line in enumerate(given):
        where = f"outline[{i}]"
        try:
            numbers = np.asarray(line)
        except (TypeError, ValueError):
            numbers = np.zeros(0)
        if numbers.ndim != 1 or len(numbers) < 2 or not np.issubdtype(numbers.dtype, np.integer):
            raise InputError(where, "two nodes or more", kind_of_value(line))
        if int(numbers.min()) < 0 or int(numbers.max()) >= count:
            raise InputError(
                where, f"nodes from 0 to {count - 1}", str(numbers.max() if numbers.max() >= count else numbers.min())
            )
        lines.append(numbers.astype(np.int64))
    return lines
