"""Linear systems x' = A x + B u, y = C x + D u about a state of rest or of steady motion, and their eigenvalues.

At rest these are those of M r'' + C r' + K r = 0 along the shapes of M and K, where stiffnesses are the squares of
frequencies, each with its own digits. In the matrix of first order each has the rounding of the largest one.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from symgen.analyses.rest.steady import at_rest, named_states, system_of_states
from symgen.analyses.state.algebra import (
    ROUNDED,
    Complex,
    eigenvalues_with_zeros,
    json_form,
    sort_eigenvalues,
    squares_along,
    sum_of_parts,
)
from symgen.analyses.state.bent_parts import sentence_on_parts
from symgen.analyses.state.edges import sentence_on_edges
from symgen.analyses.state.reduced import StateTangent, tangent_system
from symgen.analyses.state.subject import Subject
from symgen.base.digits import clear_matrix_rounding
from symgen.base.errors import InputError

if TYPE_CHECKING:
    from scipy.signal import StateSpace

Array = NDArray[np.float64]

#: What damping along two shapes may be of the faster one's frequency where there is none.
UNDAMPED = 1e-11


@dataclass(frozen=True)
class LinearSystem:
    """A linear system with names.

    Attributes
    ----------
    A, B, C, D : Array
        x' = A x + B u, y = C x + D u; all are changes from the reference state.
    states, inputs, outputs : tuple of str
        Names of x, u and y; parameters of derivatives are inputs as well, and come last.
    about : dict of str to float
        Values of states, inputs and outputs at that state.
    t : float
        Its time [s].
    left_out : tuple of str
        Outputs that depend on other quantities than the states, such as a cyclic coordinate.
    parameters : tuple of str
        The inputs that are parameters: constants, changed once and for all while the states stay.
    notes : tuple of str
        Forces and outputs that have no derivative at that state, as of `symgen.analyses.state.edges`.
    poles : tuple of complex
        Eigenvalues with more digits than A alone gives them; eigenvalues of A where there are no better ones.
    """

    A: Array
    B: Array
    C: Array
    D: Array
    states: tuple[str, ...]
    inputs: tuple[str, ...]
    outputs: tuple[str, ...]
    about: dict[str, float]
    t: float = 0.0
    left_out: tuple[str, ...] = field(default=())
    parameters: tuple[str, ...] = field(default=())
    notes: tuple[str, ...] = field(default=())
    poles: tuple[complex, ...] = field(default=(), repr=False)

    def eigenvalues(self) -> NDArray[np.complex128]:
        """Return the eigenvalues of A, by decreasing real part, then by decreasing imaginary part."""
        return sort_eigenvalues(np.array(self.poles) if self.poles else eigenvalues_with_zeros(self.A)[0])

    def state_space(self) -> StateSpace:
        """Return the system as `scipy.signal.StateSpace`."""
        from scipy.signal import StateSpace

        return StateSpace(self.A, self.B, self.C, self.D)

    def to_control(self) -> Any:
        """Return the system as ``control.StateSpace`` with the names of states, inputs and outputs.

        Raises
        ------
        InputError
            If the library `control` is not installed.
        """
        try:
            import control
        except ImportError:
            raise InputError(
                "to_control", "the library 'control' to be installed", "none", "pip install control"
            ) from None
        names = {"states": list(self.states), "inputs": list(self.inputs), "outputs": list(self.outputs)}
        return control.ss(self.A, self.B, self.C, self.D, **names)

    def to_dict(self) -> dict[str, Any]:
        """Return the fields in types of JSON."""
        return dict(json_form(self))

    def __repr__(self) -> str:
        parts = (("states", self.states), ("inputs", self.inputs), ("outputs", self.outputs))
        return f"<LinearSystem: {'; '.join(f'{len(names)} {what}{_first_names(names)}' for what, names in parts)}>"

    def _repr_html_(self) -> str:
        from symgen.analyses.kinds import notebook_html

        return notebook_html("linearise", self, self.notes)


def _first_names(names: Sequence[str]) -> str:
    return f" ({', '.join(names[:4])}{', ...' * (len(names) > 4)})" if names else ""


def linear_system(subject: Subject, y: Array, states: Sequence[str] = (), instantaneous: bool = False) -> LinearSystem:
    """Return the linear system about a state.

    Parameters
    ----------
    subject : Subject
        The mechanism.
    y : Array
        A state that satisfies the constraints.
    states, instantaneous
        As for `symgen.analyses.rest.steady.named_states`.

    Raises
    ------
    InputError
        If a name is not valid, or the motion is not steady.
    """
    x = tangent_system(subject, y)
    names = named_states(subject, x, states, instantaneous, "linearise")
    a, b, _, _ = system_of_states(x, names)
    n, form, sizes, changes = x.size, subject.form, x.sizes_of_quantities(names), x.changes_of_quantities(names)
    outputs, left_out, c, d = list[str](), list[str](), list[Array](), list[Array]()
    about = {name: x.quantity(name).value for name in names}
    about |= {
        name: float(subject.p[at]) for name, at in zip(subject.by, subject.places[-len(subject.by) :], strict=False)
    }
    about |= subject.values_of_inputs(y, x.t)
    for output in subject.mechanism.outputs:
        if output.name not in form.functions:
            left_out.append(output.name)  # an integral
            continue
        value, row = x.function(form.functions[output.name][0])
        by_states = np.linalg.lstsq((changes[:, :n] * x.sizes).T / sizes, row[:n] * x.sizes, rcond=1e-11)[0] / sizes
        rest = row[:n] - by_states @ changes[:, :n]
        if np.abs(rest).max(initial=0.0) > 1e-8 * max(1e-300, np.abs(row[:n]).max(initial=0.0)):
            left_out.append(output.name)
            continue
        outputs.append(output.name)
        about[output.name] = value
        c.append(by_states)
        d.append(row[n:] - by_states @ changes[:, n:])
    k = len(subject.varied)
    return LinearSystem(
        clear_matrix_rounding(a),
        clear_matrix_rounding(b.reshape(len(names), k)),
        clear_matrix_rounding(np.array(c).reshape(len(outputs), len(names))),
        clear_matrix_rounding(np.array(d).reshape(len(outputs), k)),
        names,
        subject.varied,
        tuple(outputs),
        about,
        x.t,
        tuple(left_out),
        subject.by,
        (
            *subject.notes,
            *subject.sentence_if_singular(subject.rows(x.base)),
            *sentence_on_parts(subject, y, x.a),
            *sentence_on_edges(subject, y, x.a, outputs),
        ),
        tuple(eigenvectors_of_states(x, names, vibration_about_rest(x))[0].tolist()),
    )


@dataclass(frozen=True)
class Vibration:
    """Small motions about a state of rest.

    Attributes
    ----------
    squares : Array, shape (n,)
        Squares of the frequencies without damping, in increasing order.
    shapes : Array, shape (nv, n)
        Their shapes in terms of velocities, normalised by masses, one a column.
    damping : Array, shape (n, n)
        Damping along the shapes; what is rounding is 0.
    """

    squares: Array
    shapes: Array
    damping: Array

    def changes(self, x: StateTangent) -> tuple[Array, Array]:
        """Return the shapes as changes of s and as changes of u."""
        positions, speeds = (np.linalg.lstsq(basis, self.shapes, rcond=None)[0] for basis in (x.free, x.basis))
        return np.asarray(positions), np.asarray(speeds)

    def eigenvectors(self, x: StateTangent) -> tuple[Complex, Complex]:
        """Return eigenvalues and eigenvectors in terms of s and u."""
        n = len(self.squares)
        fast = np.sqrt(np.abs(self.squares))
        # nothing depends on a coordinate without stiffness: its size must only not look like 0
        fast[fast == 0.0] = max(fast.max(initial=0.0), np.abs(self.damping).max(initial=0.0)) or 1.0
        first = np.block([[np.zeros((n, n)), np.eye(n)], [-np.diag(self.squares), -self.damping]])
        values, parts = eigenvalues_with_zeros(first, np.concatenate([1.0 / fast, np.ones(n)]))
        positions, speeds = self.changes(x)
        return values, np.vstack([positions @ parts[:n], speeds @ parts[n:]])


def vibration_about_rest(x: StateTangent) -> Vibration | None:
    """Return the small motions about a state of rest.

    None where something moves or has no mass, a force follows, joints hold velocities alone, or a file has states.
    """
    if not x.size or x.subject.states or x.positions != x.velocities or not at_rest(x.subject, x):
        return None
    e, basis = x.base, x.subject.split_freedom(x.subject.rows(x.base))[0]
    try:
        squares, vectors, even = squares_along(e.by("balance", "a"), e.by("balance", "q") @ e.by("motion", "v"), basis)
    except np.linalg.LinAlgError:
        return None
    if not even:
        return None
    along, whole = basis @ vectors, e.by("balance", "v")
    fast, sizes = np.sqrt(np.abs(squares)), sum_of_parts(whole, along)
    damping = along.T @ whole @ along
    limit = UNDAMPED * np.maximum.outer(fast, fast) + ROUNDED * np.sqrt(np.outer(sizes, sizes))
    return Vibration(squares, along, np.where(np.abs(damping) > limit, damping, 0.0))


def eigenvectors_of_states(x: StateTangent, names: Sequence[str], still: Vibration | None) -> tuple[Complex, Complex]:
    """Return eigenvalues and eigenvectors in terms of s and u.

    Parameters
    ----------
    x : StateTangent
        What they are of.
    names : sequence of str
        Independent states; some motions have fewer than there are s and u.
    still : Vibration, optional
        The small motions about a state of rest.
    """
    if len(names) == x.size:
        return eigenvalues_with_zeros(x.matrix, x.sizes) if still is None else still.eigenvectors(x)
    sizes = x.sizes_of_quantities(names)
    values, shapes = eigenvalues_with_zeros(system_of_states(x, names)[0], sizes)
    changes = x.changes_of_quantities(names)[:, : x.size] * x.sizes / sizes[:, np.newaxis]
    alike = np.linalg.lstsq(changes, shapes / sizes[:, np.newaxis], rcond=1e-11)[0]
    return values, np.asarray(alike * x.sizes[:, np.newaxis], dtype=np.complex128)
