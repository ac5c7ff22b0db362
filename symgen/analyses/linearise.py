"""Linear systems x' = A x + B u, y = C x + D u about a state of rest or of steady motion."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from symgen.analyses.algebra import eigenvalues_of, ranking
from symgen.analyses.reduced import StateTangent, tangent
from symgen.analyses.steady import after, at_rest, check_steady, chosen, found_states, system, with_rates
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


def in_order(values: Array | NDArray[np.complex128]) -> NDArray[np.complex128]:
    """Return eigenvalues by decreasing real part, then by decreasing imaginary part; what rounding parts is one."""
    found = np.asarray(values, dtype=np.complex128) + 0.0
    return found[ranking(found)]


def linear_system(
    subject: Subject,
    y: Array,
    t: float | None = None,
    states: Sequence[str] = (),
    instantaneous: bool = False,
    where: str = "linearise",
) -> LinearSystem:
    """Return the linear system about a state.

    Parameters
    ----------
    subject, y, t
        As for `symgen.analyses.reduced.tangent`.
    states : sequence of str
        Quantities that are the states; rates of coordinates among them are added. Unless given, independent ones that
        determine all others at rest, and in a motion those that stay as they are.
    instantaneous : bool
        Whether a motion that is not steady has the system of the instant.
    where : str
        Who asks, for messages.

    Raises
    ------
    InputError
        If a name means nothing, or the motion is not steady.
    """
    x = tangent(subject, y, t)
    names = named_states(subject, x, states, instantaneous, where)
    a, b, _, _ = system(x, names)
    return _with_outputs(subject, x, names, a, b)


def named_states(
    subject: Subject, x: StateTangent, states: Sequence[str], instantaneous: bool, where: str
) -> tuple[str, ...]:
    """Return the names of the states that are asked for or found, after a check that they make a linear system."""
    resting, soon = at_rest(subject, x), None
    if states:
        given = tuple(dict.fromkeys(states))
        # what tells all needs no more rates, also where Euler parameters are in it, whose rates have no names
        names = given if _independent(x, given) == x.size else with_rates(subject, states)
        if _independent(x, names) < len(names):
            raise InputError("states", "states that do not depend on each other", ", ".join(names))
    elif resting or instantaneous:
        names = chosen(subject, x)
    else:
        soon = after(subject, x)
        names = found_states(subject, x, soon)
        speeds = np.array([x.quantity(name).changes[x.positions : x.size] for name in names])
        if np.linalg.matrix_rank(speeds.reshape(len(names), x.velocities)) < x.velocities:  # some of them changes
            check_steady(subject, x, chosen(subject, x), where)
            expected = "a steady motion, or states that are named"
            raise InputError(where, expected, "one in which not all velocities stay as they are")
    if not instantaneous:
        check_steady(subject, x, names, where, soon)
    return names


def _independent(x: StateTangent, names: Sequence[str]) -> int:
    """Return how many of some states do not depend on each other."""
    rows = np.array([x.quantity(name).changes[: x.size] for name in names]).reshape(len(names), x.size)
    rows = rows * x.sizes / x.sizes_of(names)[:, np.newaxis]
    return int(np.linalg.matrix_rank(rows, tol=1e-9 * np.abs(rows).max(initial=1e-300)))


def _with_outputs(subject: Subject, x: StateTangent, names: Sequence[str], a: Array, b: Array) -> LinearSystem:
    n, form, sizes = x.size, subject.form, x.sizes_of(names)
    changes = np.array([x.quantity(name).changes for name in names]).reshape(len(names), n + len(x.inputs))
    outputs, left_out, c, d = list[str](), list[str](), list[Array](), list[Array]()
    inputs = subject.varied
    numbers = [p.name for p in subject.compiled.info.parameters]
    about = {name: x.quantity(name).value for name in names}
    about |= {name: float(subject.p[numbers.index(name)]) for name in subject.by}
    about |= subject.values_of_inputs(x.y, x.t)
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
    k = len(inputs)
    return LinearSystem(
        a,
        b.reshape(len(names), k),
        np.array(c).reshape(len(outputs), len(names)),
        np.array(d).reshape(len(outputs), k),
        tuple(names),
        inputs,
        tuple(outputs),
        about,
        x.t,
        tuple(left_out),
        subject.by,
        poles=tuple(eigenvectors(x, names, vibration(x))[0].tolist()),
    )
