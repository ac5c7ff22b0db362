"""Equilibria: positions where forces balance, their stability, and all of them over a range.

Time does not go on, so drivers hold what they drive where it is. Rows that depend on others are left out of the search
and share the load afterwards, by the smallest multipliers.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from symgen.analyses.rest.dense_statics import evaluate_at_balance
from symgen.analyses.rest.settle import Settled, settle_position
from symgen.analyses.state.algebra import (
    ZERO,
    Complex,
    coordinate_differences,
    eigenvalues_with_zeros,
    json_form,
    null_space_split,
    squares_along,
    symmetric_part,
)
from symgen.analyses.state.bent_parts import sentence_on_parts
from symgen.analyses.state.edges import sentence_on_edges
from symgen.analyses.state.one_sided import fault_of_mode
from symgen.analyses.state.reduced import tangent_system
from symgen.analyses.state.subject import Subject
from symgen.base.errors import AnalysisError, InputError, plural

if TYPE_CHECKING:
    from symgen.describe.mechanism import Mechanism
    from symgen.run.layout.compiled import ModelInfo

Array = NDArray[np.float64]

#: A real part below this fraction of the largest eigenvalue is none; so is a part of an
#: eigenvalue, real or imaginary, below this one of its own, which is what rounding leaves of two that are one.
FLAT, REAL = 1e-9, 1e-6
#: A force that holds a coordinate below this part of that at the next value is nothing.
NOTHING = 1e-9
#: Halvings of an interval that has an equilibrium before Newton's method is tried, and at most; so far beside the
#: interval, as a part of it, an equilibrium at its end may be found.
FIRST_HALVINGS, HALVINGS, BESIDE = 4, 12, 1e-6
#: Equilibria nearer to each other than this are one [rad, or the length of the mechanism].
SAME = 1e-7
STABLE, UNSTABLE, INDIFFERENT = "stable", "unstable", "indifferent"


@dataclass(frozen=True)
class Equilibrium:
    """A position of rest, or of steady motion where velocities are kept.

    Attributes
    ----------
    q : dict of str to float
        Coordinates of bodies and joints.
    stability : {"stable", "unstable", "indifferent"}
        By the reduced stiffness, without dampers; in a steady motion by the eigenvalues of its linear system.
    omega_squared : tuple of float
        Eigenvalues of the reduced stiffness over the reduced mass [1/s^2], in increasing order; for complex
        eigenvalues (flutter under follower forces) the real parts. In a steady motion the stiffness holds at constant
        speeds: it gives no frequencies where a speed is free to change.
    residual : float
        Largest unbalanced force [N, N m].
    iterations : int
        Steps of Newton's method.
    states : dict of str to float
        States of the file's own, at rest.
    multipliers : dict of str to float
        By row; the smallest ones where rows depend on others.
    not_unique : tuple of str
        Joints whose reactions are not determined.
    y : Array
        The state.
    lam : Array, shape (m,)
        The multipliers.
    notes : tuple of str
        The one-sided rows in force, and forces that have no derivative there: stability and frequencies ignore that.
    band : dict of str to (float, float)
        With one degree of freedom and rows with two constant bounds, a coordinate and its values between which
        these hold.
    """

    q: dict[str, float]
    stability: str
    omega_squared: tuple[float, ...]
    residual: float
    iterations: int
    states: dict[str, float]
    multipliers: dict[str, float]
    not_unique: tuple[str, ...]
    y: Array = field(repr=False)
    lam: Array = field(repr=False)
    notes: tuple[str, ...] = ()
    band: dict[str, tuple[float, float]] = field(default_factory=dict)

    def to_dict(self) -> dict[str, Any]:
        """Return the fields in types of JSON; ends of bands that are infinite are None."""
        band = {name: [x if np.isfinite(x) else None for x in ends] for name, ends in self.band.items()}
        return dict(json_form(self)) | {"band": band}

    def __repr__(self) -> str:
        squares = ", ".join(f"{x:.4g}" for x in self.omega_squared[:3]) + ", ..." * (len(self.omega_squared) > 3)
        return (
            f"<Equilibrium: {self.stability}, omega^2 = [{squares}] 1/s^2, {plural(len(self.q), 'coordinate')} in .q>"
        )

    def _repr_html_(self) -> str:
        from symgen.analyses.kinds import notebook_html

        return notebook_html("equilibrium", self, self.notes)


def judge_equilibrium(rest: Settled, multipliers: Array | None = None) -> Equilibrium:
    """Return an equilibrium with its multipliers, its stiffness, and the reactions that are not unique.

    Parameters
    ----------
    rest : Settled
        The position.
    multipliers : Array, shape (m,), optional
        Those that obey the laws of rows with bounds; the smallest ones by default.
    """
    subject, y = rest.subject, rest.y
    info, e = subject.compiled.info, subject.evaluate(y)
    d = subject.rows(e)
    inverse, dependent = null_space_split(d, subject.loads)[1:]
    lam = -inverse.T @ e.value("balance") if multipliers is None else multipliers
    e, by_position = evaluate_at_balance(subject, y, lam)
    stiffness = by_position @ e.by("motion", "v")
    squares = reduced_squares(e.by("balance", "a"), stiffness, subject.split_freedom(d)[0])
    share = np.linalg.norm(dependent, axis=1) if dependent.size else np.zeros(info.m)
    return Equilibrium(
        q=subject.coordinates_by_name(y),
        stability=stability_in_motion(eigenvalues_with_zeros(tangent_system(subject, y).matrix)[0])
        if subject.states
        else stability_in_words(squares),
        omega_squared=tuple(float(x) for x in squares.real),
        residual=float(np.abs(e.value("balance")).max(initial=0.0)),
        iterations=rest.steps,
        states={x.name: float(y[info.own_states][i]) for i, x in enumerate(info.states)},
        multipliers={row.name: float(x) for row, x in zip(info.rows, lam, strict=True)},
        not_unique=joints_not_unique(subject.mechanism, info, share),
        y=y,
        lam=lam,
        notes=(
            *subject.notes,
            *subject.sentence_if_singular(d),
            *sentence_on_parts(subject, y),
            *sentence_on_edges(subject, y),
        ),
    )


def joints_not_unique(mechanism: Mechanism, info: ModelInfo, share: Array) -> tuple[str, ...]:
    """Return the joints whose reactions are not determined, by the share of each row in the dependencies."""
    joints = {row.joint for row, x in zip(info.rows, share, strict=True) if x > 1e-8}
    joints |= {name.partition(".")[0] for pair in info.dropped_rows for name in pair.split(" = ")}
    return tuple(j.name for j in mechanism.joints if j.name in joints)


def stability_in_words(squares: Array | Complex) -> str:
    """Return the word for squares of angular frequencies; the roots of a complex one grow in one direction of time."""
    if np.iscomplexobj(squares) or squares.min(initial=0.0) < 0.0:
        return UNSTABLE
    return INDIFFERENT if np.any(squares == 0.0) else STABLE  # also where nothing can move


def stability_in_motion(eigenvalues: Complex) -> str:
    """Return the word for the eigenvalues of a steady motion's linear system."""
    largest = np.abs(eigenvalues).max(initial=0.0)
    if np.any((eigenvalues.real > REAL * np.abs(eigenvalues)) & (eigenvalues.real > FLAT * largest)):
        return UNSTABLE
    return INDIFFERENT if np.any(eigenvalues == 0.0) else STABLE


def reduced_squares(mass: Any, stiffness: Any, basis: Array) -> Array | Complex:
    """Return the squares of frequencies along the free directions, in increasing order; massless ones have none.

    They are complex numbers where one of them is none, and 0 where they are rounding.

    Parameters
    ----------
    mass, stiffness : Array or sparse, shape (nv, nv)
        M and K; along what is free K is symmetric where forces have a potential.
    basis : Array, shape (nv, n)
        The free directions.
    """
    if not basis.shape[1]:
        return np.zeros(0)
    heavy, vectors = np.linalg.eigh(symmetric_part(basis.T @ (mass @ basis)))
    light = heavy <= 1e-13 * heavy.max()
    if light.any():  # massless directions follow the rest
        a, b = basis @ vectors[:, ~light], basis @ vectors[:, light]
        by_light = b.T @ (stiffness @ np.hstack([b, a]))
        basis = a - b @ np.linalg.lstsq(by_light[:, : b.shape[1]], by_light[:, b.shape[1] :], rcond=1e-13)[0]
    squares, shapes, even = squares_along(mass, stiffness, basis)
    if even:
        return squares
    along = basis @ shapes
    values = np.sort_complex(np.linalg.eigvals(along.T @ (stiffness @ along)))
    grain = len(values) * ZERO * np.abs(values).max(initial=0.0)
    if np.any(np.abs(values.imag) > REAL * np.abs(values) + grain):
        return np.asarray(values, dtype=np.complex128)
    return np.where(np.abs(values.real) <= grain, 0.0, values.real)


def find_equilibrium(subject: Subject) -> Settled:
    """Find the equilibrium that the start leads to; velocities are taken to be 0.

    Raises
    ------
    AnalysisError
        If no equilibrium is found.
    """
    y = subject.y.copy()
    y[subject.nq : subject.nq + subject.nv] = 0.0
    return settle_position(subject, y)


def scan_equilibria(subject: Subject, name: str, values: Array) -> tuple[Equilibrium, ...]:
    """Find all equilibria over a range of a coordinate.

    It is held at one value after the other, while everything else comes to rest; where the force that this takes
    changes its sign, an equilibrium is between.

    Parameters
    ----------
    subject : Subject
        The mechanism and its start; velocities are taken to be 0.
    name, values : str, Array
        The coordinate and its values.

    Raises
    ------
    AnalysisError
        If no equilibrium is found.
    """
    unit = subject.unit(name)
    if len(values) < 2:
        raise InputError(f"scan {name}", "two values or more", f"{len(values)}")
    if unit == "m":  # steps are bounded by the mechanism's length, and its start may have none
        subject = subject.with_least_length(float(np.abs(values - value_of_coordinate(subject, subject.y, name)).max()))
    rests, before, y, reached = list[Equilibrium](), None, subject.y.copy(), False
    y[subject.nq : subject.nq + subject.nv] = 0.0
    for value in values:
        try:
            held = settle_position(subject, y, [(name, float(value))])
        except AnalysisError:
            before = None  # it cannot be there, or nothing else rests
            continue
        reached, subject, y, now = True, held.subject, held.y, (float(value), held)
        if (
            before is not None
            and _changes_sign(before, now)
            and (rest := _equilibrium_between(name, before, now)) is not None
        ):
            places = rest.subject.lengths, rest.subject.compiled.info
            if all(
                np.abs(coordinate_differences(places[1], other.y, rest.y) / places[0]).max(initial=0.0) >= SAME
                for other in rests
            ):
                there = judge_equilibrium(rest)
                rests += [] if fault_of_mode(rest.subject, there.y, there.lam) else [there]
        before = now
    if not reached:
        expected = "values that the coordinate can have"
        raise InputError(f"scan {name}", expected, f"none of {values[0]:g} to {values[-1]:g}")
    if not rests:
        raise AnalysisError(f"no equilibrium was found with {name} from {values[0]:g} to {values[-1]:g}")
    return tuple(rests)


#: A value of a coordinate, and the rest of everything else where it is held there by the last multiplier.
Held = tuple[float, Settled]


def _changes_sign(a: Held, b: Held) -> bool:
    """Whether what holds a coordinate at two values has other signs there, or is nothing at one of them."""
    one, other = float(a[1].lam[-1]), float(b[1].lam[-1])
    return one * other <= 0.0 or min(abs(one), abs(other)) <= NOTHING * max(abs(one), abs(other))


def _equilibrium_between(name: str, a: Held, b: Held) -> Settled | None:
    """Find the equilibrium between two values of a coordinate: by halves, and by Newton's method from there.

    From too far away Newton's method may lead elsewhere; where it does from everywhere, that is returned.
    """
    low, high, steps, elsewhere = min(a[0], b[0]), max(a[0], b[0]), 0, None
    slack = BESIDE * (high - low)

    def nearer_end() -> Settled:
        return (a if abs(a[1].lam[-1]) < abs(b[1].lam[-1]) else b)[1]

    for halved in range(HALVINGS):
        middle = 0.5 * (a[0] + b[0])
        try:
            held = settle_position(nearer_end().subject, nearer_end().y, [(name, middle)])
        except AnalysisError:
            break
        steps, c = steps + held.steps, (middle, held)
        a, b = (a, c) if _changes_sign(a, c) else (c, b)
        if halved + 1 < FIRST_HALVINGS:
            continue
        try:
            rest = settle_position(nearer_end().subject, nearer_end().y)
        except AnalysisError:
            continue
        steps += rest.steps
        rest = replace(rest, steps=steps)
        if low - slack <= value_of_coordinate(rest.subject, rest.y, name) <= high + slack:
            return rest
        elsewhere = rest
    return elsewhere


def value_of_coordinate(subject: Subject, y: Array, name: str) -> float:
    """Return the value of a coordinate at a state."""
    space, at = subject.position(name)
    return float(y[at] if space == "q" else subject.evaluate(y).value("functions")[at])
