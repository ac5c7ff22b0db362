"""Modes: eigenvalues of the reduced first-order system, shapes, and who takes part in them.

At rest the eigenvalues come from the symmetric problem K - omega^2 M along the free directions, which keeps all digits
of omega^2, and where something damps from its shapes; elsewhere from the system of first order.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from symgen.analyses.algebra import ranking
from symgen.analyses.linearise import in_order, named_states
from symgen.analyses.reduced import Tangent, tangent
from symgen.analyses.shares import shares
from symgen.analyses.steady import at_rest
from symgen.analyses.subject import Subject
from symgen.analyses.vibration import Vibration, eigenvectors, vibration

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]


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
        Share of each body in the kinetic energy of each mode.
    stiffening : mapping of str to Array
        Share of each force and joint in the work of each mode against what restores it: joints restore by what they
        carry.
    dissipation : mapping of str to Array
        Share of each force in what damps each mode; empty where nothing does.
    about : dict of str to float
        Coordinates, or states, that the modes are about.
    t : float
        Time [s].
    notes : tuple of str
        Forces that have no derivative there, as of `symgen.analyses.edges.edges`.
    """

    eigenvalues: Complex
    omega_squared: Array
    degrees_of_freedom: int
    names: tuple[str, ...]
    shapes: Complex
    participation: Mapping[str, Array] = field(default_factory=dict)
    stiffening: Mapping[str, Array] = field(default_factory=dict)
    dissipation: Mapping[str, Array] = field(default_factory=dict)
    about: Mapping[str, float] = field(default_factory=dict)
    t: float = 0.0
    notes: tuple[str, ...] = ()

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
            "dissipation": {name: share.tolist() for name, share in self.dissipation.items()},
            "about": dict(self.about),
            "t": self.t,
            "notes": list(self.notes),
        }


def modes(
    subject: Subject,
    y: Array,
    t: float | None = None,
    states: Sequence[str] = (),
    where: str = "modes",
    bodies: Callable[[], Subject] | None = None,
) -> Modes:
    """Return the modes about a state of rest or of steady motion.

    Parameters
    ----------
    subject, y, t, states
        As for `symgen.analyses.linearise.linear_system`.
    where : str
        Who asks, for messages.
    bodies : callable, optional
        As for `symgen.analyses.shares.shares`: without it modes of a tree have no tables.

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
    resting = at_rest(subject, x)
    still = vibration(x)
    if still is not None and not states and not still.damping.any():
        return _of_squares(x, still, bodies)
    values, vectors = eigenvectors(x, names, still)
    if states or not resting:
        shapes = np.array([x.quantity(name).changes[: x.size] for name in names]).reshape(-1, x.size) @ vectors
        about = {name: x.quantity(name).value for name in names}
        largest = np.abs(shapes).max(axis=0, initial=0.0)
    else:
        names, shapes, about = _coordinates(subject), x.q[:, : x.size] @ vectors, subject.named(y)
        largest = np.sqrt([_twice_kinetic(x, change) for change in _velocities(x, vectors)])
    kept = [int(i) for i in ranking(values) if values[i].imag >= 0.0]
    found = shares(x, vectors[:, kept], bodies)
    return Modes(
        in_order(values),
        np.zeros(0),
        x.velocities,
        names,
        (shapes / np.maximum(largest, 1e-300))[:, kept].T,
        *(found.participation, found.stiffening, found.dissipation),
        about,
        x.t,
    )


def _of_squares(x: Tangent, still: Vibration, bodies: Callable[[], Subject] | None) -> Modes:
    """Return the modes of symmetric stiffness and masses."""
    subject, squares = x.subject, still.squares
    roots = np.sqrt(-squares.astype(np.complex128))
    shapes = (x.base.by("motion", "v") @ still.shapes).T.astype(np.complex128)
    # both positions and velocities change along the mode, as they do one after the other
    found = shares(x, np.vstack(still.changes(x)), bodies)
    return Modes(
        in_order(np.concatenate([roots, -roots])),
        squares,
        x.velocities,
        _coordinates(subject),
        shapes,
        *(found.participation, found.stiffening, found.dissipation),
        subject.named(x.y),
        x.t,
    )


def _coordinates(subject: Subject) -> tuple[str, ...]:
    return tuple(q.name for q in subject.compiled.info.coordinates)


def _velocities(x: Tangent, vectors: Complex) -> Complex:
    """Return the changes of position of eigenvectors in terms of velocities, one a row."""
    return np.asarray((x.free @ vectors[: x.positions]).T)


def _twice_kinetic(x: Tangent, change: Complex) -> float:
    return float(np.real(change.conj() @ x.base.by("balance", "a") @ change))
