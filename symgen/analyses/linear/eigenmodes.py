"""Modes: eigenvalues of the reduced first-order system, shapes, and who takes part in them.

At rest the eigenvalues come from the symmetric problem K - omega^2 M along the free directions, which keeps all digits
of omega^2, and where something damps from its shapes; elsewhere from the system of first order.

Shares of bodies, joints and forces in the energies of a mode are tables that add up to 1 each. A mode changes positions
by dq = N dr and velocities by dv. Its kinetic energy is that of dv, body by body. Its restoring work is Re(dr^H dF), dF
being the change of the balance of forces with position, force by force and joint by joint: joints restore by what they
carry, which turns with them. Its dissipation is Re(dv^H dF) with velocities. What belongs to no force and no joint is
the rest: gravity, and in motion what turning bodies add.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from symgen.analyses.linear.linear_system import eigenvectors_of_states, vibration_about_rest
from symgen.analyses.rest.steady import at_rest, named_states
from symgen.analyses.state.algebra import json_form, null_space_split, rank_order, sort_eigenvalues
from symgen.analyses.state.bent_parts import sentence_on_parts
from symgen.analyses.state.edges import sentence_on_edges
from symgen.analyses.state.reduced import StateTangent, descriptor_accelerations, tangent_system
from symgen.analyses.state.subject import Subject
from symgen.base.errors import plural
from symgen.run.compiling.linearised import LinearisedState

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]

#: What a total may be of the largest one, and a rest of its total, where there is none.
NONE, REST = 1e-12, 1e-9
#: Eigenvalues apart by less than this part of themselves are one.
ALIKE = 1e-9


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
        Number of free velocities.
    names : tuple of str
        Columns of shapes: coordinates at rest, states in a steady motion.
    shapes : Array of complex, shape (modes, names)
        One for each eigenvalue whose imaginary part is not negative, or for each of `omega_squared`; at rest
        normalised to x^H M x = 1, in a steady motion to a largest element of 1.
    participation : mapping of str to Array
        Share of each body in the kinetic energy of each mode.
    stiffening : mapping of str to Array
        Share of each force and joint in the work of each mode against what restores it: joints restore by what they
        carry.
    dissipation : mapping of str to Array
        Share of each force in the damping of each mode; empty without damping.
    about : dict of str to float
        Coordinates, or states, that the modes are about.
    t : float
        Time [s].
    notes : tuple of str
        Forces that have no derivative there, as of `symgen.analyses.state.edges.sentence_on_edges`.
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
        values = self.of_shapes
        return np.asarray(-values.real / np.maximum(np.abs(values), 1e-300) + 0.0)

    @property
    def multiple(self) -> tuple[tuple[int, ...], ...]:
        """Numbers, from 1 on, of shapes that belong to one eigenvalue: each alone, and its shares, are not unique."""
        values, groups = self.of_shapes, list[tuple[int, ...]]()
        left = np.arange(len(values))
        while len(left):
            first = values[left[0]]
            one = np.abs(values[left] - first) <= ALIKE * np.maximum(np.abs(values[left]), abs(first))
            groups.append(tuple((left[one] + 1).tolist()))
            left = left[~one]
        return tuple(group for group in groups if len(group) > 1)

    def to_dict(self) -> dict[str, Any]:
        """Return the fields in types of JSON."""
        derived = {name: json_form(getattr(self, name)) for name in ("frequencies", "damping", "multiple")}
        return {**json_form(self), **derived}

    def __repr__(self) -> str:
        shown = ", ".join(f"{x:.4g}" for x in self.eigenvalues[:4]) + ", ..." * (len(self.eigenvalues) > 4)
        return f"<Modes: {plural(self.degrees_of_freedom, 'degree')} of freedom, eigenvalues {shown or 'none'} 1/s>"

    def _repr_html_(self) -> str:
        from symgen.analyses.kinds import notebook_html

        return notebook_html("modes", self, self.notes)


def modes_about(
    subject: Subject, y: Array, states: Sequence[str] = (), bodies: Callable[[], Subject] | None = None
) -> Modes:
    """Return the modes about a state of rest or of steady motion.

    Parameters
    ----------
    subject, y, states
        As for `symgen.analyses.linear.linear_system.linear_system`.
    bodies : callable, optional
        Returns the mechanism in coordinates of bodies, where the state is that of joints: without it modes of a tree
        have no tables.

    Raises
    ------
    InputError
        If the motion is neither at rest nor steady, or a name means nothing.
    """
    x = tangent_system(subject, y)
    names = named_states(subject, x, states, False, "modes")
    coordinates = tuple(q.name for q in subject.compiled.info.coordinates)
    if not x.size:
        nothing = np.zeros(0, dtype=np.complex128)
        return Modes(
            nothing,
            np.zeros(0),
            0,
            (),
            nothing.reshape(0, 0),
            about=subject.coordinates_by_name(y),
            t=x.t,
            notes=subject.notes,
        )
    still = vibration_about_rest(x)
    vectors: Array | Complex
    shapes: Array | Complex
    if still is not None and not states and not still.damping.any():
        squares, about, names = still.squares, subject.coordinates_by_name(y), coordinates
        roots = np.sqrt(-squares.astype(np.complex128))
        values, shapes = (
            np.concatenate([roots, -roots]),
            (x.base.by("motion", "v") @ still.shapes).astype(np.complex128),
        )
        # both positions and velocities change along the mode, as they do one after the other
        vectors = np.vstack(still.changes(x))
    else:
        squares = np.zeros(0)
        values, vectors = eigenvectors_of_states(x, names, still)
        order = [int(i) for i in rank_order(values) if values[i].imag >= 0.0]
        vectors = vectors[:, order]
        if states or not at_rest(subject, x):
            shapes, about = (
                x.changes_of_quantities(names)[:, : x.size] @ vectors,
                {name: x.quantity(name).value for name in names},
            )
            largest = np.abs(shapes).max(axis=0, initial=0.0)
        else:
            names, shapes, about = coordinates, x.q[:, : x.size] @ vectors, subject.coordinates_by_name(y)
            moved = x.free @ vectors[: x.positions]
            largest = np.sqrt(_work_along_modes(moved, x.base.by("balance", "a") @ moved))
        shapes = shapes / np.maximum(largest, 1e-300)
    tables, notes = (
        _shares_of_modes(x, vectors, bodies),
        (
            *subject.notes,
            *subject.sentence_if_singular(subject.rows(x.base)),
            *sentence_on_parts(subject, y, x.a),
            *sentence_on_edges(subject, y),
        ),
    )
    shapes = shapes.T.astype(np.complex128)
    return Modes(sort_eigenvalues(values), squares, x.velocities, names, shapes, *tables, about, x.t, notes)


def _shares_of_modes(
    x: StateTangent, vectors: Array | Complex, bodies: Callable[[], Subject] | None
) -> tuple[dict[str, Array], dict[str, Array], dict[str, Array]]:
    """Return participation, stiffening and dissipation of modes, which are changes of s and u in columns."""
    n = x.size
    subject, y, dq, dv = x.subject, x.y, x.q[:, :n] @ vectors, x.v[:, :n] @ vectors
    if subject.coordinates == "joint":
        if bodies is None:
            return {}, {}, {}
        subject = bodies().turn_to_joint_angles(x.subject.coordinates_by_name(x.y))
        y, dq, dv = _changes_of_bodies(x, subject, vectors)
    first = subject.evaluate(y, t=x.t)
    basis, inverse, _ = null_space_split(subject.rows(first), subject.loads)
    a, lam = descriptor_accelerations(first, basis, inverse)
    e = subject.evaluate(y, a, lam, x.t)
    dr, mass = np.linalg.pinv(e.by("motion", "v")) @ dq, e.by("balance", "a")
    kinetic, momentum = dict[str, Array](), mass @ dv
    owners = np.array([v.name.rpartition(".")[0] for v in subject.compiled.info.velocities])
    for body in dict.fromkeys(owners.tolist()):
        kinetic[body] = _work_along_modes(dv[owners == body], momentum[owners == body])
    energy = np.maximum(sum(kinetic.values(), np.zeros(dq.shape[1])), 1e-300)
    moving = bool(np.abs(y[subject.nq : subject.nq + subject.nv]).max(initial=0.0) > 0.0)
    restoring = _work_by_force(subject, e, dr, dq, "q")
    for joint, geometric in _geometric_stiffness(subject, y, a, lam, x.t):
        restoring[joint] = restoring.get(joint, 0.0) + _work_along_modes(dr, geometric @ dq)
    whole = _work_along_modes(dr, e.by("balance", "q") @ dq)
    heavy = np.maximum(_work_along_modes(dr, mass @ dr), 1e-300)
    power, drag = _work_by_force(subject, e, dv, dv, "v"), _work_along_modes(dv, e.by("balance", "v") @ dv)
    return (
        {name: part / energy for name, part in kinetic.items()},
        _parts_of_whole(restoring, whole, heavy, "gravity and turning" if moving else "gravity"),
        _parts_of_whole(power, drag, energy, "turning"),
    )


def _changes_of_bodies(
    x: StateTangent, bodies: Subject, vectors: Array | Complex
) -> tuple[Array, Array | Complex, Array | Complex]:
    """Return state and changes of bodies' own coordinates from state and changes of joint coordinates."""
    y, functions = np.zeros_like(bodies.y), [x.function(x.subject.form.functions[n][0]) for n in bodies.state_names]
    y[: len(functions)] = [value for value, _ in functions]
    changes = np.array([change[: x.size] for _, change in functions]) @ vectors
    return y, changes[: bodies.nq], changes[bodies.nq :]


def _work_along_modes(along: Array | Complex, force: Array | Complex) -> Array:
    return np.asarray(np.real(np.einsum("ik,ik->k", along.conj(), force)))


def _work_by_force(
    subject: Subject, e: LinearisedState, along: Array | Complex, change: Array | Complex, space: str
) -> dict[str, Array]:
    """Return the work of each force along modes by its derivatives by q or v."""
    works = dict[str, Array]()
    rows = e.by("elements", space) @ change
    for (name, i), row in zip(subject.form.elements, rows, strict=True):
        works[name] = works.get(name, 0.0) + np.real(along[i].conj() * row)
    return works


def _geometric_stiffness(subject: Subject, y: Array, a: Array, lam: Array, t: float) -> list[tuple[str, Array]]:
    """Return the stiffness of each joint that carries something."""
    without = subject.evaluate(y, a, None, t).by("balance", "q")
    joints = np.array([row.joint for row in subject.compiled.info.rows])
    return [
        (joint, subject.evaluate(y, a, np.where(joints == joint, lam, 0.0), t).by("balance", "q") - without)
        for joint in dict.fromkeys(joints.tolist())
    ]


def _parts_of_whole(parts: dict[str, Array], whole: Array, measure: Array, rest: str) -> dict[str, Array]:
    """Return parts over their whole; what is left is a part as well, and where the whole is nothing all are 0.

    It is nothing where it is the rounding of its parts, or of the whole of the mode that has most by a measure.
    """
    left, sizes = whole - sum(parts.values(), np.zeros(len(whole))), sum(map(np.abs, parts.values()), np.abs(whole))
    if np.any(np.abs(left) > REST * sizes):
        parts = {**parts, rest: left}
    largest = float((np.abs(whole) / measure).max(initial=0.0))
    there = (np.abs(whole) > NONE * largest * measure) & (np.abs(whole) > REST * sizes)
    with np.errstate(all="ignore"):
        shares = {name: np.where(there, part / whole, 0.0) for name, part in parts.items()}
    return shares if np.any(there) else {}
