"""Who takes part in a mode: shares of bodies, joints and forces in its energies, each table adding up to 1.

A mode changes positions by dq = N dr and velocities by dv. Its kinetic energy is that of dv, body by body. Its
restoring work is Re(dr^H dF), dF being the change of the balance of forces with position, force by force and joint by
joint: joints restore by what they carry, which turns with them. Its dissipation is Re(dv^H dF) with velocities. What
belongs to no force and no joint is the rest: gravity, and in motion what turning bodies add.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from symgen.analyses.algebra import split
from symgen.analyses.reduced import Tangent, accelerations
from symgen.analyses.subject import Subject
from symgen.compiling.linearised import Evaluated

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]

#: What a total may be of the largest one, and a rest of its total, where there is none.
NONE, REST = 1e-12, 1e-9


@dataclass(frozen=True)
class Shares:
    """Tables of a few modes; each name has one number a mode.

    Attributes
    ----------
    participation : mapping of str to Array
        Of bodies in the kinetic energy.
    stiffening : mapping of str to Array
        Of forces and joints in the work against restoring forces.
    dissipation : mapping of str to Array
        Of forces in what dampers take; empty where nothing damps.
    """

    participation: Mapping[str, Array]
    stiffening: Mapping[str, Array]
    dissipation: Mapping[str, Array]


def shares(x: Tangent, vectors: Array | Complex, bodies: Callable[[], Subject] | None = None) -> Shares:
    """Return the tables of modes.

    Parameters
    ----------
    x : Tangent
        Where they are.
    vectors : Array, shape (size, k)
        Changes of s and u.
    bodies : callable, optional
        Returns the mechanism in coordinates of bodies, where the state is that of joints.
    """
    n = x.size
    subject, y, dq, dv = x.subject, x.y, x.q[:, :n] @ vectors, x.v[:, :n] @ vectors
    if subject.coordinates == "joint":
        if bodies is None:
            return Shares({}, {}, {})
        subject = bodies().turned(x.subject.named(x.y))
        y, dq, dv = _of_bodies(x, subject, vectors)
    first = subject.evaluated(y, t=x.t)
    basis, inverse, _ = split(subject.rows(first), subject.loads)
    a, lam = accelerations(first, basis, inverse)
    e = subject.evaluated(y, a, lam, x.t)
    dr = np.linalg.pinv(e.by("motion", "v")) @ dq
    kinetic = _kinetic(subject, e.by("balance", "a"), dv)
    energy = np.maximum(sum(kinetic.values(), np.zeros(dq.shape[1])), 1e-300)
    moving = bool(np.abs(y[subject.nq : subject.nq + subject.nv]).max(initial=0.0) > 0.0)
    restoring = _by_force(subject, e, dr, dq, "q")
    for joint, geometric in _geometric(subject, y, a, lam, x.t):
        restoring[joint] = restoring.get(joint, 0.0) + _work(dr, geometric @ dq)
    whole = _work(dr, e.by("balance", "q") @ dq)
    heavy = np.maximum(_work(dr, e.by("balance", "a") @ dr), 1e-300)
    taken, drag = _by_force(subject, e, dv, dv, "v"), _work(dv, e.by("balance", "v") @ dv)
    rest = "gravity and turning" if moving else "gravity"
    return Shares(
        {name: part / energy for name, part in kinetic.items()},
        _parts(restoring, whole, heavy, rest),
        _parts(taken, drag, energy, "turning"),
    )


def _of_bodies(x: Tangent, bodies: Subject, vectors: Array | Complex) -> tuple[Array, Array | Complex, Array | Complex]:
    """Return state and changes of bodies' own coordinates from those of joints."""
    y, changes = np.zeros_like(bodies.y), list[Array]()
    for i, name in enumerate(bodies.state_names):
        y[i], change = x.function(x.subject.form.functions[name][0])
        changes.append(change[: x.size])
    found = np.array(changes).reshape(len(changes), x.size) @ vectors
    return y, found[: bodies.nq], found[bodies.nq :]


def _work(along: Array | Complex, force: Array | Complex) -> Array:
    return np.asarray(np.real(np.einsum("ik,ik->k", along.conj(), force)))


def _kinetic(subject: Subject, mass: Array, dv: Array | Complex) -> dict[str, Array]:
    owners = np.array([v.name.partition(".")[0] for v in subject.compiled.info.velocities])
    momentum = mass @ dv
    return {str(body): _work(dv[owners == body], momentum[owners == body]) for body in dict.fromkeys(owners.tolist())}


def _by_force(
    subject: Subject, e: Evaluated, along: Array | Complex, change: Array | Complex, space: str
) -> dict[str, Array]:
    """Return what each force does along modes by its derivatives by q or v."""
    found = dict[str, Array]()
    rows = e.by("elements", space) @ change
    for (name, i), row in zip(subject.form.elements, rows, strict=True):
        found[name] = found.get(name, 0.0) + np.real(along[i].conj() * row)
    return found


def _geometric(subject: Subject, y: Array, a: Array, lam: Array, t: float) -> list[tuple[str, Array]]:
    """Return the stiffness of each joint that carries something."""
    without, found = subject.evaluated(y, a, None, t).by("balance", "q"), list[tuple[str, Array]]()
    joints = np.array([row.joint for row in subject.compiled.info.rows])
    for joint in dict.fromkeys(joints.tolist()):
        own = subject.evaluated(y, a, np.where(joints == joint, lam, 0.0), t).by("balance", "q") - without
        found.append((str(joint), own))
    return found


def _parts(parts: dict[str, Array], whole: Array, measure: Array, rest: str) -> dict[str, Array]:
    """Return parts over their whole; what is left is a part as well, and where the whole is nothing all are 0.

    It is nothing where it is the rounding of its parts, or of the whole of the mode that has most by a measure.
    """
    left, sizes = whole - sum(parts.values(), np.zeros(len(whole))), sum(map(np.abs, parts.values()), np.abs(whole))
    if np.any(np.abs(left) > REST * sizes):
        parts = {**parts, rest: left}
    largest = float((np.abs(whole) / measure).max(initial=0.0))
    there = (np.abs(whole) > NONE * largest * measure) & (np.abs(whole) > REST * sizes)
    with np.errstate(all="ignore"):
        found = {name: np.where(there, part / whole, 0.0) for name, part in parts.items()}
    return found if np.any(there) else {}
