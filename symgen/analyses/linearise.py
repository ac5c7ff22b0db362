"""Linear systems x' = A x + B u, y = C x + D u about a state of rest or of steady motion."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from symgen.analyses.algebra import eigenvalues_of, in_order
from symgen.analyses.edges import edges
from symgen.analyses.reduced import tangent
from symgen.analyses.steady import named_states, system
from symgen.analyses.subject import Subject
from symgen.analyses.vibration import eigenvectors, vibration
from symgen.errors import InputError

Array = NDArray[np.float64]


@dataclass(frozen=True)
class LinearSystem:
    """A linear system with names.

    Attributes
    ----------
    A, B, C, D : Array
        x' = A x + B u, y = C x + D u; all are changes against the state that the system is about.
    states, inputs, outputs : tuple of str
        Names of x, u and y; parameters that derivatives were asked by are inputs as well, and stand behind.
    about : dict of str to float
        Values of states, inputs and outputs at that state.
    t : float
        Its time [s].
    left_out : tuple of str
        Outputs that depend on something else than the states, such as a cyclic coordinate.
    parameters : tuple of str
        Those of the inputs that are parameters: constants, changed once and for all while the states stay.
    notes : tuple of str
        Forces and outputs that have no derivative at that state, as of `symgen.analyses.edges`.
    poles : tuple of complex
        Eigenvalues with more digits than A alone gives them; those of A without.
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
        return in_order(np.array(self.poles) if self.poles else eigenvalues_of(self.A)[0])

    def state_space(self) -> Any:
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
        """Return what JSON can express."""
        matrices = {name: getattr(self, name).tolist() for name in ("A", "B", "C", "D")}
        names = {name: list(getattr(self, name)) for name in ("states", "inputs", "outputs", "left_out", "parameters")}
        return {**matrices, **names, "about": self.about, "t": self.t, "notes": list(self.notes)}


def linear_system(subject: Subject, y: Array, states: Sequence[str] = (), instantaneous: bool = False) -> LinearSystem:
    """Return the linear system about a state.

    Parameters
    ----------
    subject : Subject
        The mechanism.
    y : Array
        A state that satisfies the constraints.
    states, instantaneous
        As for `symgen.analyses.steady.named_states`.

    Raises
    ------
    InputError
        If a name means nothing, or the motion is not steady.
    """
    x = tangent(subject, y)
    names = named_states(subject, x, states, instantaneous, "linearise")
    a, b, _, _ = system(x, names)
    n, form, sizes, changes = x.size, subject.form, x.sizes_of(names), x.changes_of(names)
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
        a,
        b.reshape(len(names), k),
        np.array(c).reshape(len(outputs), len(names)),
        np.array(d).reshape(len(outputs), k),
        names,
        subject.varied,
        tuple(outputs),
        about,
        x.t,
        tuple(left_out),
        subject.by,
        edges(subject, y, x.a, outputs),
        tuple(eigenvectors(x, names, vibration(x))[0].tolist()),
    )
