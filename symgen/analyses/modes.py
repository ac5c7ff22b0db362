"""Modes: eigenvalues of the reduced first-order system, shapes, and who takes part in them.

At rest, where nothing damps and nothing turns, the eigenvalues come from the symmetric problem K - omega^2 M along the
free directions, which keeps all digits of omega^2; elsewhere from the system of first order.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from symgen.analyses.algebra import split, symmetric
from symgen.analyses.equilibrium import rounded
from symgen.analyses.linearise import in_order, named_states
from symgen.analyses.reduced import Tangent, tangent
from symgen.analyses.steady import at_rest, system
from symgen.analyses.subject import Subject

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]

#: What the reduced damping, or an asymmetry of the stiffness, may be of its own scale where there is none.
NONE = 1e-11


@dataclass(frozen=True)
class Modes:
    """Eigenvalues and shapes about a state.

    Attributes
    ----------
    eigenvalues : Array of complex
        Of the reduced first-order system [1/s], by decreasing real part, then by decreasing imaginary part.
    omega_squared : Array
        Squares of the angular frequencies [1/s^2] in increasing order; none where something damps or turns.
    degrees_of_freedom : int
        Velocities that are free.
    names : tuple of str
        What shapes have columns of: coordinates at rest, states in a steady motion.
    shapes : Array of complex, shape (modes, names)
        One for each eigenvalue whose imaginary part is not negative, or for each of `omega_squared`; at rest
        normalised to x^H M x = 1, in a steady motion to a largest element of 1.
    participation : mapping of str to Array
        At rest in bodies' coordinates: share of each body in the kinetic energy of each mode, body by body.
    stiffening : mapping of str to Array
        Share of each force and joint in the potential energy of each mode that has some: joints have some by what
        they carry.
    about : dict of str to float
        Coordinates, or states, that the modes are about.
    t : float
        Time [s].
    """

    eigenvalues: Complex
    omega_squared: Array
    degrees_of_freedom: int
    names: tuple[str, ...]
    shapes: Complex
    participation: Mapping[str, Array] = field(default_factory=dict)
    stiffening: Mapping[str, Array] = field(default_factory=dict)
    about: Mapping[str, float] = field(default_factory=dict)
    t: float = 0.0

    @property
    def of_shapes(self) -> Complex:
        """The eigenvalue that each shape belongs to."""
        if len(self.omega_squared):
            return np.sqrt(-self.omega_squared.astype(np.complex128))
        return self.eigenvalues[self.eigenvalues.imag >= 0.0]

    @property
    def frequencies(self) -> Array:
        """Frequency of each shape [Hz]."""
        return np.asarray(np.abs(self.of_shapes.imag) / (2.0 * np.pi))

    @property
    def damping(self) -> Array:
        """Ratio of damping of each shape: -Re / abs; 0 where the eigenvalue is 0."""
        found = self.of_shapes
        return np.asarray(-found.real / np.maximum(np.abs(found), 1e-300) + 0.0)

    def to_dict(self) -> dict[str, Any]:
        """Return what JSON can express."""
        return {
            "eigenvalues": [[float(x.real), float(x.imag)] for x in self.eigenvalues],
            "omega_squared": self.omega_squared.tolist(),
            "degrees_of_freedom": self.degrees_of_freedom,
            "frequencies": self.frequencies.tolist(),
            "damping": self.damping.tolist(),
            "names": list(self.names),
            "shapes": [[[float(x.real), float(x.imag)] for x in shape] for shape in self.shapes],
            "participation": {name: share.tolist() for name, share in self.participation.items()},
            "stiffening": {name: share.tolist() for name, share in self.stiffening.items()},
            "about": dict(self.about),
            "t": self.t,
        }


def modes(
    subject: Subject, y: Array, t: float | None = None, states: Sequence[str] = (), where: str = "modes"
) -> Modes:
    """Return the modes about a state of rest or of steady motion.

    Parameters
    ----------
    subject, y, t, states
        As for `symgen.analyses.linearise.linear_system`.
    where : str
        Who asks, for messages.

    Raises
    ------
    InputError
        If the motion is neither at rest nor steady, or a name means nothing.
    """
    x = tangent(subject, y, t)
    names = named_states(subject, x, states, False, where)
    if not x.size:
        nothing = np.zeros(0, dtype=np.complex128)
        return Modes(nothing, np.zeros(0), 0, (), nothing.reshape(0, 0), about=subject.named(y), t=x.t)
    if states or not at_rest(subject, x):
        values, vectors = np.linalg.eig(system(x, names)[0])
        return _sorted(values, vectors.T, names, x, {name: x.quantity(name).value for name in names})
    about = subject.named(y)
    still = None if x.positions != x.velocities else _undamped(subject, x)
    if still is None:
        values, vectors = np.linalg.eig(x.matrix)
        shapes = (x.q[:, : x.size] @ vectors).T
        sizes = np.sqrt([_twice_kinetic(x, shape) for shape in _velocities(x, vectors)])
        return _sorted(values, shapes / np.maximum(sizes, 1e-300)[:, None], _coordinates(subject), x, about, vectors)
    squares, directions = still
    free = split(x.base.by("velocities", "v"))[0]
    along = free @ directions
    roots = np.sqrt(-squares.astype(np.complex128))
    shapes = (x.base.by("motion", "v") @ along).T.astype(np.complex128)
    return Modes(
        in_order(np.concatenate([roots, -roots])),
        squares,
        x.velocities,
        _coordinates(subject),
        shapes,
        by_body(x, along),
        by_force(x, along, squares),
        about,
        x.t,
    )


def _coordinates(subject: Subject) -> tuple[str, ...]:
    return tuple(q.name for q in subject.compiled.info.coordinates)


def _velocities(x: Tangent, vectors: Complex) -> Complex:
    """Return the changes of position of eigenvectors in terms of velocities, one a row."""
    free = split(x.base.by("velocities", "v")[x.subject.holonomic])[0]
    return np.asarray((free @ vectors[: x.positions]).T)


def _twice_kinetic(x: Tangent, change: Complex) -> float:
    return float(np.real(change.conj() @ x.base.by("balance", "a") @ change))


def _sorted(
    values: Complex,
    shapes: Complex,
    names: tuple[str, ...],
    x: Tangent,
    about: Mapping[str, float],
    vectors: Complex | None = None,
) -> Modes:
    order = [int(np.flatnonzero(values == value)[0]) for value in dict.fromkeys(in_order(values))]
    kept = [i for i in order if values[i].imag >= 0.0]
    shapes = np.array([shapes[i] for i in kept], dtype=np.complex128).reshape(len(kept), -1)
    bodies: Mapping[str, Array] = {}
    if vectors is None:
        largest = np.abs(shapes).max(axis=1, keepdims=True, initial=1e-300)
        shapes = shapes / largest
    elif len(kept):
        bodies = by_body(x, _velocities(x, vectors).T[:, kept])
    return Modes(in_order(values), np.zeros(0), x.velocities, names, shapes, bodies, {}, about, x.t)


def _undamped(subject: Subject, x: Tangent) -> tuple[Array, Array] | None:
    """Return squares of frequencies and directions, None where something damps, turns or follows."""
    from scipy import linalg

    e = x.base
    basis = split(e.by("velocities", "v"))[0]
    mass = symmetric(basis.T @ e.by("balance", "a") @ basis)
    damping = basis.T @ e.by("balance", "v") @ basis
    stiffness = basis.T @ (e.by("balance", "q") @ e.by("motion", "v")) @ basis
    size = np.abs(stiffness).max(initial=0.0)
    heavy = np.abs(mass).max(initial=0.0)
    if np.abs(damping).max(initial=0.0) > NONE * np.sqrt(size * heavy):
        return None
    if np.abs(stiffness - stiffness.T).max(initial=0.0) > 1e3 * NONE * max(size, 1e-300):
        return None
    if not len(mass):
        return np.zeros(0), np.zeros((0, 0))
    try:
        values, vectors = linalg.eigh(symmetric(stiffness), mass)
    except linalg.LinAlgError:
        return None
    return rounded(np.asarray(values)), np.asarray(vectors)


def by_body(x: Tangent, along: Array | Complex) -> dict[str, Array]:
    """Return the share of each body in the kinetic energy of modes, from their changes of position, one a column."""
    if x.subject.coordinates == "joint":
        return {}
    mass = x.base.by("balance", "a")
    total = np.real(np.einsum("ik,ij,jk->k", along.conj(), mass, along))
    owners = [v.name.partition(".")[0] for v in x.subject.compiled.info.velocities]
    found = {}
    for body in dict.fromkeys(owners):
        own = np.array([owner == body for owner in owners])
        part = along[own]
        energy = np.real(np.einsum("ik,ij,jk->k", part.conj(), mass[np.ix_(own, own)], part))
        found[body] = energy / np.maximum(total, 1e-300)
    return found


def by_force(x: Tangent, along: Array, squares: Array) -> dict[str, Array]:
    """Return the share of each force and joint in the potential energy of modes that has any.

    Joints take part by what they carry: turning them turns the forces that they transmit.
    """
    subject, e = x.subject, x.base
    if subject.coordinates == "joint":
        return {}
    motion = e.by("motion", "v")
    entries = e.by("elements", "q") @ motion
    found: dict[str, Array] = {}
    for (name, i), row in zip(subject.form.elements, entries, strict=True):
        found[name] = found.get(name, np.zeros(len(squares))) + along[i] * (row @ along)
    info, without = subject.compiled.info, subject.evaluated(x.y, x.a, None, x.t).by("balance", "q") @ motion
    for joint in dict.fromkeys(row.joint for row in info.rows):
        own = np.array([row.joint == joint for row in info.rows])
        geometric = subject.evaluated(x.y, x.a, x.lam * own, x.t).by("balance", "q") @ motion - without
        found[joint] = np.einsum("ik,ij,jk->k", along, geometric, along)
    left = squares - sum(found.values(), np.zeros(len(squares)))
    scale = np.abs(squares).max(initial=0.0)
    if np.abs(left).max(initial=0.0) > 1e-9 * scale:
        found["gravity"] = left
    stiff = np.abs(squares) > 1e-12 * max(scale, 1e-300)
    with np.errstate(all="ignore"):
        return {name: np.where(stiff, part / squares, 0.0) for name, part in found.items()}
