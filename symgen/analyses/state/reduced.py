"""The motion near a state as a linear system in independent unknowns.

Near a state with q' = N v, D v = nu, M v' + D^T lambda = f and D v' = gamma let q change by N Z_q s and v by
Z u - D^+ (D v - nu)_q N Z_q s, Z_q and Z being bases of what holonomic rows, and all rows, leave free: orthonormal ones
where the mechanism's length and a radian count alike, so that nothing depends on the unit of length. Then
every change of v', of the multipliers and of what is computed from them is linear in s, u and the inputs. Where rows
are nonholonomic there are more s than u.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from symgen.analyses.state.subject import RATE, Subject
from symgen.base.errors import AnalysisError, InputError, suggest
from symgen.run.compiling.linearised import LinearisedState

Array = NDArray[np.float64]


@dataclass(frozen=True)
class StateTangent:
    """Derivatives by x = (s, u, z, inputs, parameters) at a state; all matrices have as many columns.

    z are the states of the file's own.

    Attributes
    ----------
    subject : Subject
        The mechanism.
    t : float
        Time [s].
    y : Array
        The state.
    a, lam : Array
        v' and the multipliers there.
    base : LinearisedState
        The descriptor form there.
    positions, velocities : int
        Numbers of s and u.
    q, q_rates, v, rates, multipliers : Array
        Changes of q, q', v, v' and lambda.
    state_rates : Array, shape (size, ...)
        Changes of the rates of s, u and z.
    free, basis : Array, shape (nv, positions) and (nv, velocities)
        Z_q and Z.
    """

    subject: Subject
    t: float
    y: Array
    a: Array
    lam: Array
    base: LinearisedState
    positions: int
    velocities: int
    q: Array
    q_rates: Array
    v: Array
    rates: Array
    multipliers: Array
    state_rates: Array
    free: Array
    basis: Array

    @property
    def size(self) -> int:
        """Number of s, u and z."""
        return self.positions + self.velocities + self.subject.states

    @property
    def own_state_changes(self) -> Array:
        """Changes of the states of the file's own."""
        return np.eye(self.subject.states, self.q.shape[1], self.positions + self.velocities)

    @property
    def matrix(self) -> Array:
        """A of (s, u, z)' = A (s, u, z)."""
        return self.state_rates[:, : self.size]

    @property
    def speeds(self) -> Array:
        """The velocities, shape (nv,)."""
        return self.y[self.subject.nq : self.subject.nq + self.subject.nv]

    @property
    def rate(self) -> float:
        """Largest rate of change that forces, or the motion, could cause [1/s]; 1 without any."""
        e, basis, subject = self.base, np.abs(self.basis), self.subject
        heavy = np.einsum("ik,ij,jk->k", self.basis, e.by("balance", "a"), self.basis)
        stiffness = np.abs(e.by("balance", "q") @ e.by("motion", "v"))
        rates = [float(np.abs(self.speeds / subject.spans).max(initial=0.0))]
        for matrix, power in ((stiffness, 0.5), (np.abs(e.by("balance", "v")), 1.0)):
            sizes = np.einsum("ik,ij,jk->k", basis, matrix, basis)
            moved = heavy > 1e-13 * heavy.max(initial=0.0)
            rates.append(float((sizes[moved] / heavy[moved]).max(initial=0.0)) ** power)
        return max(rates) or 1.0

    @property
    def sizes(self) -> Array:
        """Scales of s, u and z, shape (size,)."""
        return np.append(np.repeat([1.0, self.rate], [self.positions, self.velocities]), self.subject.extents(self.y))

    def sizes_of_quantities(self, names: Sequence[str]) -> Array:
        """Return the large sizes of quantities: the mechanism's length or 1 rad, times `rate` for rates."""
        subject = self.subject
        units = {q.name: q.unit for q in (*subject.compiled.info.coordinates, *subject.compiled.info.velocities)}
        own = {o.name for o in subject.mechanism.outputs}
        states = dict(zip((x.name for x in subject.mechanism.states), subject.extents(self.y), strict=True))
        sizes = list[float]()
        for name in names:
            if name in states:
                sizes.append(float(states[name]))
                continue
            base = name.removesuffix(RATE)
            unit = units.get(name) or ("" if base in own else subject.form.units.get(base, ""))
            slow = 1.0 if not unit or (unit in ("m", "rad") and not name.endswith(RATE)) else self.rate
            sizes.append((subject.length if unit.startswith("m") else 1.0) * slow)
        return np.array(sizes)

    def function(self, place: int) -> tuple[float, Array]:
        """Return the value of a quantity of the state, and its changes."""
        by = {"q": self.q, "v": self.v, "a": self.rates, "z": self.own_state_changes, "lam": self.multipliers}
        changes = np.sum([self.base.by("functions", space)[place] @ x for space, x in by.items()], axis=0)
        changes[self.size :] += self.base.by("functions", "p")[place][self.subject.places]
        return float(self.base.value("functions")[place]), changes

    def changes_of_quantities(self, names: Sequence[str], rates: bool = False) -> Array:
        """Return the changes of quantities of the state, or of their rates; shape (names, size + inputs)."""
        quantities = [self.quantity(name) for name in names]
        changes = [q.rate_changes if rates else q.changes for q in quantities]
        return np.array(changes).reshape(len(names), self.q.shape[1])

    def quantity(self, name: str) -> StateQuantity:
        """Return a quantity of the state by name, with its rate.

        Raises
        ------
        InputError
            If the name does not exist; names the nearest one.
        """
        quantities = places_of_quantities(self.subject)
        if name not in quantities:
            expected = f"a coordinate, velocity or output of the state of {self.subject.mechanism.name}"
            raise InputError(f"state '{name}'", expected, "none of that name", suggest(name, quantities))
        space, at = quantities[name]
        e, y, nq = self.base, self.y, self.subject.nq
        if space == "q":
            return StateQuantity(name, float(y[at]), float(e.value("motion")[at]), self.q[at], self.q_rates[at])
        if space == "v":
            return StateQuantity(name, float(y[nq + at]), float(self.a[at]), self.v[at], self.rates[at])
        value, rate = self.function(at), self.function(at + 1)
        return StateQuantity(name, value[0], rate[0], value[1], rate[1])


@dataclass(frozen=True)
class StateQuantity:
    """A quantity of the state: its value and rate, and their changes with (s, u, inputs)."""

    name: str
    value: float
    rate: float
    changes: Array
    rate_changes: Array


def places_of_quantities(subject: Subject) -> Mapping[str, tuple[str, int]]:
    """Return the positions, by name, of the quantities of the state whose rates are computed.

    Coordinates and velocities of the state, coordinates of joints and outputs with ``.rate`` after the name of their
    rates.
    """
    info = subject.compiled.info
    quantities: dict[str, tuple[str, int]] = {}
    for name, (at, orders) in subject.form.functions.items():
        if orders >= 2:
            quantities[name] = "functions", at
        if orders == 3:
            quantities[name + RATE] = "functions", at + 1
    quantities |= {q.name: ("q", i) for i, q in enumerate(info.coordinates)}
    return quantities | {v.name: ("v", i) for i, v in enumerate(info.velocities)}


def descriptor_accelerations(e: LinearisedState, basis: Array, inverse: Array) -> tuple[Array, Array]:
    """Return v' and the multipliers from the descriptor form evaluated with v' = 0 and no multipliers."""
    mass, force, gap = e.by("balance", "a"), e.value("balance"), e.value("accelerations")
    a = -inverse @ gap
    heavy = basis.T @ mass @ basis
    if len(heavy):
        a = a - basis @ _solve_heavy(heavy, basis.T @ (force + mass @ a))
    return a, -inverse.T @ (force + mass @ a)


def _solve_heavy(heavy: Array, right: Array) -> Array:
    try:
        return np.asarray(np.linalg.solve(heavy, right), dtype=np.float64)
    except np.linalg.LinAlgError:
        raise AnalysisError("nothing determines the accelerations: a body without mass is free to move") from None


def tangent_system(subject: Subject, y: Array, t: float | None = None) -> StateTangent:
    """Return the linear system near a state that satisfies the constraints.

    Parameters
    ----------
    subject : Subject
        The mechanism.
    y : Array
        The state: q and v.
    t : float, optional
        Time [s]; that of the start by default.

    Raises
    ------
    InputError
        If an input moves a joint: its rates would be inputs as well.
    AnalysisError
        If nothing determines the accelerations.
    """
    now = subject.t if t is None else t
    still = subject.evaluate(y, t=now)
    d = subject.rows(still)
    basis, inverse = subject.split_freedom(d, subject.loads)
    a, lam = descriptor_accelerations(still, basis, inverse)
    e = subject.evaluate(y, a, lam, now)
    places = subject.places
    for group in ("velocities", "positions"):
        if np.any(e.by(group, "p")[:, places[: len(subject.inputs)]]):
            raise InputError("inputs", "inputs of forces and outputs", "one that moves a joint")
    motion, mass = e.by("motion", "v"), e.by("balance", "a")
    free = subject.split_freedom(d[subject.holonomic])[0]
    positions, velocities = free.shape[1], basis.shape[1]
    first = positions + velocities + subject.states
    width = first + len(places)
    q, v, z = (
        np.zeros((subject.nq, width)),
        np.zeros((subject.nv, width)),
        np.eye(subject.states, width, first - subject.states),
    )

    def changes_of_group(group: str) -> Array:
        total = e.by(group, "q") @ q + e.by(group, "v") @ v + e.by(group, "z") @ z
        total[:, first:] += e.by(group, "p")[:, places]
        return total

    q[:, :positions] = motion @ free
    q[:, first:] = motion @ _closing_shift(subject, e, d)
    v -= inverse @ changes_of_group("velocities")
    v[:, positions : positions + velocities] += basis
    force, rates = changes_of_group("balance"), -inverse @ changes_of_group("accelerations")
    if velocities:
        rates = rates - basis @ _solve_heavy(basis.T @ mass @ basis, basis.T @ (force + mass @ rates))
    multipliers = -inverse.T @ (force + mass @ rates)
    q_rates = changes_of_group("motion")
    back = np.linalg.pinv((motion @ free) / subject.lengths[:, np.newaxis]) / subject.lengths
    along = (basis / subject.spans[:, np.newaxis] ** 2).T  # of orthonormal columns in spans
    states = changes_of_group("states") + e.by("states", "a") @ rates + e.by("states", "lam") @ multipliers
    state_rates = np.vstack([back @ q_rates, along @ rates, states])
    return StateTangent(
        *(subject, now, y, a, lam, e, positions, velocities, q, q_rates, v, rates, multipliers),
        *(state_rates, free, basis),
    )


def _closing_shift(subject: Subject, e: LinearisedState, d: Array) -> Array:
    """Return the smallest change of position, in terms of velocities, that keeps joints closed while parameters change.

    Raises
    ------
    InputError
        If a parameter opens joints that depend on each other.
    """
    rows = subject.holonomic
    opened, inverse = e.by("positions", "p")[:, subject.places][rows], subject.split_freedom(d[rows])[1]
    change = -inverse @ opened
    left = opened + d[rows] @ change
    for name, gap, whole in zip(subject.varied, left.T, opened.T, strict=True):
        if np.abs(gap).max(initial=0.0) > 1e-8 * np.abs(whole).max(initial=0.0):
            raise InputError(f"by '{name}'", "a parameter that redundant joints allow to change", "one that opens them")
    return np.asarray(change)
