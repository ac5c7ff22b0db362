"""`symgen.reduced`: finite elements in, the modal body of a mechanism file out."""

from __future__ import annotations

import os
from collections.abc import Mapping
from dataclasses import dataclass
from io import BytesIO
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from symgen.base import arguments
from symgen.base.arguments import kind_of_value
from symgen.base.errors import InputError, plural, quote, suggest
from symgen.base.files import check_file_name, check_writable, write_whole
from symgen.base.units import unit_of
from symgen.describe.coordinate_names import names_of_modal_body
from symgen.describe.formulas.identifiers import check_identifier
from symgen.describe.modal.modal_file import SUFFIX, VERSION
from symgen.describe.modal_body import MOST_MODES
from symgen.describe.reduction.basis import ModeBasis, modes_of
from symgen.describe.reduction.finite_elements import (
    Array,
    FiniteElements,
    read_elements,
    read_interfaces,
    read_lines,
    refuse_massless,
)
from symgen.describe.reduction.integrals import bearings_of, integrals_of
from symgen.describe.reduction.second_motion import SecondMotion, second_motion_of
from symgen.describe.reduction.second_order import couples_of, softening_of, stretches_of
from symgen.describe.reduction.ways import middles_of, shortest_ways

#: Points of an outline at most.
MOST_POINTS = 400
#: What `stiffening` may be.
STIFFENING = "interfaces"


@dataclass(frozen=True, repr=False)
class Reduced:
    """A body of finite elements as a modal body.

    Attributes
    ----------
    mass : float
        [kg].
    centre : Array, shape (d,)
        Centre of mass in the frame of the nodes [m].
    inertia : Array, shape (r, r)
        About the centre of mass; one entry in the plane [kg m^2].
    frequencies : Array, shape (k,)
        Of the free body that the modes are of [Hz].
    interfaces : tuple of str
        Names.
    inner : int
        How many modes besides those of interfaces there are.
    shapes : Array, shape (n u, k)
        Modes over the unknowns of the nodes, with psi_i . M psi_j = mass where i = j, else 0.
    """

    mass: float
    centre: Array
    inertia: Array
    frequencies: Array
    interfaces: tuple[str, ...]
    inner: int
    shapes: Array
    _arrays: Mapping[str, NDArray[np.generic]]

    def __repr__(self) -> str:
        modes, faces = plural(len(self.frequencies), "mode"), plural(len(self.interfaces), "interface")
        return f"<Reduced body of {self.mass:.6g} kg: {modes}, {faces}>"

    def save(self, path: str | os.PathLike[str]) -> Path:
        """Write the file that a modal body names.

        Parameters
        ----------
        path : str or path
            Ends in ``.npz``; a file of this name is replaced.

        Returns
        -------
        Path
            The file.

        Raises
        ------
        InputError
            If the name does not end so, or the file cannot be written.
        """
        target = Path(os.fspath(arguments.path_argument("path", path)))
        if target.suffix != SUFFIX:
            raise InputError("path", f"a name that ends in {SUFFIX}", quote(str(path)))
        check_file_name("path", target)
        check_writable("path", target)
        content = BytesIO()
        np.savez_compressed(content, allow_pickle=False, **self._arrays)
        return write_whole(target, content.getvalue())


def reduced(
    nodes: object,
    M: object,
    K: object,
    interfaces: Mapping[str, object] | None = None,
    inner: int = 0,
    rows: Mapping[str, object] | None = None,
    outline: object = None,
    stiffening: str | None = None,
) -> Reduced:
    """Return a body of finite elements as a modal body, with modes about mean axes.

    Interfaces are rigid. All 6 (n - 1) modes, in the plane 3 (n - 1), that n interfaces make by moving one by one
    (Craig and Bampton) stay, as joints need them; only the number of modes between them is a choice.

    Parameters
    ----------
    nodes : array, shape (n, 2) or (n, 3)
        Places of the nodes [m].
    M, K : arrays, dense or sparse
        Mass and stiffness [kg, N/m] over the unknowns, node by node: two displacements in the plane and three in space,
        and for nodes that turn one or three turns after them. M of solids stays as it is, any other is lumped.
    interfaces : mapping of str to list of int, optional
        Name and nodes, counted from 0, of each place where joints and forces act: several nodes, or one that turns.
    inner : int
        Number of modes with all interfaces held; without interfaces, number of modes of the free body.
    rows : mapping of str to array, optional
        Quantities that are linear in the unknowns, such as stresses, by name: a row, several rows, or a pair of these
        and a unit. ``{"node": 40, "from": "base"}`` is how far a node moves as seen from an interface, along each axis
        [m]; a plain row of a displacement is seen from the mean motion of the body. Formulas read them as
        ``arm.sigma``.
    outline : list of lists of int, optional
        Lines of nodes that pictures show; by default the shortest ways along elements between the interfaces.
    stiffening : str, optional
        ``"interfaces"``: loads on interfaces and inertia stiffen and soften the body, as interfaces move at second
        order in the coordinates of modes. Of bodies of bars, whose nodes turn.

    Returns
    -------
    Reduced
        With mass, frequencies and shapes; its `save` writes the file.

    Raises
    ------
    InputError
        If an array is not what it should be; the sentence names it.
    """
    elements = read_elements(nodes, M, K)
    sets = read_interfaces(interfaces, elements)
    count = arguments.whole_number("inner", inner, 0, elements.mass.shape[0])
    motions = elements.dimension + elements.rotations
    modes_in_all = count + motions * max(len(sets) - 1, 0)
    if not 1 <= modes_in_all <= MOST_MODES:
        of_interfaces = plural(motions * max(len(sets) - 1, 0), "mode")
        got = f"{modes_in_all}: {of_interfaces} of {plural(len(sets), 'interface')} and inner = {count}"
        raise InputError("inner", f"1 to {MOST_MODES} modes in all", got)
    tied = np.concatenate([*sets.values(), np.zeros(0, np.int64)])
    refuse_massless(elements, np.setdiff1d(np.arange(len(elements.x)), tied))
    masses = np.asarray(elements.density.sum(axis=0)).ravel()
    centre = masses @ elements.x / masses.sum()
    x = elements.x - centre
    modes = modes_of(elements, x, sets, count)
    integrals, bearings = integrals_of(elements, x, modes), bearings_of(elements, x, modes)
    second = _second_motion(stiffening, elements, x, modes, sets)
    stretches, couples = stretches_of(elements, x, modes, sets), couples_of(elements, modes)
    shape, turn = _interface_motions(elements, x, modes.shapes, sets, modes.seats)
    names, units, values = _read_rows(rows, elements, modes.shapes, sets)
    points, ends = _outline(outline, elements, sets)
    d, k = elements.dimension, len(modes.squares)
    field = modes.shapes.T.reshape(k, len(x), -1)[:, :, :d]
    mass = float(elements.density.sum())
    empty = np.zeros
    n = len(sets)
    arrays = {
        "version": np.array(VERSION),
        "mass": np.array(mass),
        "centre": centre,
        "inertia": integrals.inertia,
        "stiffness": mass * modes.squares,
        "inner": np.array(count),
        "growth": integrals.growth,
        "second": integrals.second if second is None else integrals.second + second.second,
        "cross": integrals.cross,
        "interfaces": np.array(list(sets), dtype=str) if sets else empty(0, dtype="<U1"),
        "place": np.array([seat + centre for seat in modes.seats.values()]).reshape(n, d),
        "shape": shape,
        "turn": turn,
        "elastic": np.array([b.elastic for b in bearings]).reshape(n, d, k),
        "shifted": np.array([b.shifted for b in bearings]).reshape(n, d, d),
        "spread": np.array([b.spread for b in bearings]).reshape(n, d, d, d),
        "modal": np.array([b.modal for b in bearings]).reshape(n, d, k),
        "bearing_stiffness": np.array([b.stiffness for b in bearings]).reshape(n),
        "bearing_length": np.array([b.length for b in bearings]).reshape(n),
        "stretch_ends": np.array([s.ends for s in stretches], dtype=np.int64).reshape(len(stretches), 2),
        "stretch_growth": np.array([s.growth for s in stretches]).reshape(len(stretches), k, k),
        "stretch_stiffness": np.array([s.stiffness for s in stretches]).reshape(len(stretches)),
        "couple_ends": np.array([c.ends for c in couples], dtype=np.int64).reshape(len(couples), 2),
        "couple_share": np.array([c.share for c in couples]).reshape(len(couples), d, k),
        "softening": softening_of(elements, x, modes, sets),
        "stiffened": np.array(int(second is not None)),
        "curve": empty((0, k, k, d)) if second is None else second.place,
        "twist": empty((0, k, k, elements.rotations)) if second is None else second.turn,
        "row_names": np.array(names, dtype=str) if names else empty(0, dtype="<U1"),
        "row_units": np.array(units, dtype=str) if names else empty(0, dtype="<U1"),
        "rows": values,
        "points": x[points] + centre,
        "point_shapes": np.swapaxes(field[:, points], 0, 1),
        "lines": ends,
    }
    return Reduced(
        mass=mass,
        centre=centre,
        inertia=integrals.inertia,
        frequencies=np.sqrt(modes.squares) / (2.0 * np.pi),
        interfaces=tuple(sets),
        inner=count,
        shapes=modes.shapes,
        _arrays={name: _plain(array) for name, array in arrays.items()},
    )


def _second_motion(
    stiffening: object, elements: FiniteElements, x: Array, modes: ModeBasis, sets: Mapping[str, NDArray[np.int64]]
) -> SecondMotion | None:
    """Return the displacements of second order where stiffening asks for them."""
    if stiffening is None:
        return None
    if stiffening != STIFFENING:
        got = quote(stiffening) if isinstance(stiffening, str) else kind_of_value(stiffening)
        raise InputError("stiffening", f"{quote(STIFFENING)}, or None for linear modes", got)
    return second_motion_of(elements, x, modes, sets)


def _plain(array: NDArray[np.generic]) -> NDArray[np.generic]:
    """Return an array of numbers in little-endian order of C, or of texts."""
    if array.dtype.kind == "U":
        return array.astype(array.dtype.newbyteorder("<"))
    return np.array(array, dtype="<i8" if array.dtype.kind in "iu" else "<f8", order="C")


def _interface_motions(
    elements: FiniteElements, x: Array, shapes: Array, sets: Mapping[str, NDArray[np.int64]], seats: Mapping[str, Array]
) -> tuple[Array, Array]:
    """Return what each mode moves and turns each interface by, shapes (i, k, d), (i, k, r)."""
    d, r, k = elements.dimension, elements.rotations, shapes.shape[1]
    moved, turned = np.zeros((len(sets), k, d)), np.zeros((len(sets), k, r))
    for i, (name, nodes) in enumerate(sets.items()):
        local = elements.rigid_motions(x[nodes], seats[name])
        motion = np.linalg.lstsq(local, shapes[elements.unknowns_of(nodes)], rcond=None)[0]
        moved[i], turned[i] = motion[:d].T, motion[d:].T
    return moved, turned


def _read_rows(
    given: Mapping[str, object] | None,
    elements: FiniteElements,
    shapes: Array,
    sets: Mapping[str, NDArray[np.int64]],
) -> tuple[list[str], list[str], Array]:
    """Return the name and the unit of each row, and the rows over the coordinates of modes."""
    names, units, values = list[str](), list[str](), [np.zeros((0, shapes.shape[1]))]
    if given is None:
        return names, units, values[0]
    if not isinstance(given, Mapping):
        raise InputError("rows", "a dictionary of names and rows", kind_of_value(given))
    taken = {*names_of_modal_body(elements.dimension, shapes.shape[1]), *sets}
    for name, entry in given.items():
        where = f"rows[{quote(name)}]"
        check_identifier(name, "rows", "row")
        if name in taken:
            raise InputError(where, "another name", f"'{name}', which the body has already")
        unit = ""
        if isinstance(entry, Mapping):
            entry, unit = _displacement(where, entry, elements, sets), "m"
        if isinstance(entry, tuple) and len(entry) == 2 and isinstance(entry[1], str):
            entry, unit = entry[0], unit_of(entry[1], where).text
        try:
            matrix = np.atleast_2d(np.asarray(entry.todense() if hasattr(entry, "todense") else entry, dtype=float))
        except (TypeError, ValueError):
            matrix = np.zeros((0, 0))
        size = len(shapes)
        if matrix.ndim != 2 or matrix.shape[1] != size or not len(matrix):
            expected = f"a number for each of the {size} unknowns, or several rows of these"
            raise InputError(where, expected, kind_of_value(entry))
        if not np.all(np.isfinite(matrix)):
            raise InputError(where, "finite numbers", str(matrix[~np.isfinite(matrix)][0]))
        names += [name] * len(matrix)
        units += [unit] * len(matrix)
        values.append(matrix @ shapes)
    return names, units, np.concatenate(values)


def _displacement(
    where: str, entry: Mapping[str, object], elements: FiniteElements, sets: Mapping[str, NDArray[np.int64]]
) -> Array:
    """Return the rows of how far a node moves, as seen from an interface."""
    if set(entry) != {"node", "from"}:
        expected = "a node and the interface that it is seen from, {'node': 40, 'from': 'base'}"
        raise InputError(where, expected, f"the keys {', '.join(map(str, entry)) or 'of an empty table'}")
    node, base = arguments.whole_number(f"{where}['node']", entry["node"], 0, len(elements.x) - 1), entry["from"]
    if not isinstance(base, str) or base not in sets:
        hint = "make the node an interface, whose place in the ground formulas read" if base == "ground" else ""
        hint = hint or (suggest(base, list(sets)) if isinstance(base, str) else "")
        raise InputError(
            f"{where}['from']", f"an interface: {', '.join(sets) or 'the body has none'}", repr(base), hint
        )
    own, seat = elements.unknowns_of(sets[base]), elements.x[sets[base]].mean(axis=0)
    follow = np.linalg.pinv(elements.rigid_motions(elements.x[sets[base]], seat))
    place = elements.unknowns * node + np.arange(elements.dimension)
    rows = np.zeros((elements.dimension, elements.mass.shape[0]))
    rows[np.arange(elements.dimension), place] = 1.0
    rows[:, own] -= elements.rigid_motions(elements.x[[node]], seat)[: elements.dimension] @ follow
    return rows


def _outline(
    given: object, elements: FiniteElements, sets: Mapping[str, NDArray[np.int64]]
) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Return the nodes of the outline, and pairs of places in them that lines join."""
    x = elements.x
    if given is None:
        middles = middles_of(x, sets)
        start = middles[0] if middles else int(np.argmax(np.linalg.norm(x - x.mean(axis=0), axis=1)))
        lines = shortest_ways(elements, start, middles[1:])
    else:
        lines = read_lines(given, len(x))
    points = np.unique(np.concatenate([*lines, np.zeros(0, np.int64)]))
    if len(points) > MOST_POINTS:
        if given is not None:
            raise InputError("outline", f"at most {MOST_POINTS} nodes", str(len(points)))
        lines = [
            line[np.unique(np.linspace(0, len(line) - 1, MOST_POINTS // len(lines)).round().astype(int))]
            for line in lines
        ]
        points = np.unique(np.concatenate(lines))
    pairs = {tuple(sorted(pair)) for line in lines for pair in zip(line[:-1].tolist(), line[1:].tolist(), strict=True)}
    ends = np.searchsorted(points, np.array(sorted(pairs), dtype=np.int64).reshape(-1, 2))
    return points, ends.astype(np.int64)
