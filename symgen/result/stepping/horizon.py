"""A horizon: steps ahead of the state of a run, with the derivatives of each, as predictive control asks for.

Explicit schemes with constant steps and without events make them in one compiled call; other runs make step after step
and go back.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import NDArray

from symgen.base import arguments
from symgen.base.errors import InputError, quote, suggest

if TYPE_CHECKING:
    from symgen.result.stepping.derivatives import StepDirections
    from symgen.result.stepping.stepped_run import SteppedRun

Array = NDArray[np.float64]
#: What the inputs of a horizon are given as.
Inputs = Array | Sequence[Sequence[float]] | Mapping[str, Sequence[float] | Array]
WHERE = "horizon"


class Horizon(NamedTuple):
    """States of N steps, each with its derivatives: ``x[k + 1] + A[k] dx + B[k] du``, and ``C[k] dx`` of outputs.

    Attributes
    ----------
    x : Array, shape (N + 1, n)
        The states, the present one first.
    A, B, C : Array, shapes (N, n, n), (N, n, m), (N, k, n)
        As of `StepDerivatives`, step by step; ``C[k]`` at ``x[k + 1]``.
    t : Array, shape (N + 1,)
        Times [s].
    states, inputs, outputs : tuple of str
        Names of rows and columns.
    doubts : tuple of str
        Why derivatives are in doubt.
    """

    x: Array
    A: Array
    B: Array
    C: Array
    t: Array
    states: tuple[str, ...]
    inputs: tuple[str, ...]
    outputs: tuple[str, ...]
    doubts: tuple[str, ...] = ()

    def __repr__(self) -> str:
        sizes = f"{len(self.states)} states, {len(self.inputs)} inputs, {len(self.outputs)} outputs"
        return f"<Horizon of {len(self.A)} steps from t = {self.t[0]:g} s: {sizes}>"


def run_over_horizon(run: SteppedRun, directions: StepDirections, inputs: Inputs, dt: float) -> Horizon:
    """Return the steps ahead of a run.

    Parameters
    ----------
    run, directions : SteppedRun, StepDirections
        The run, and the derivatives of its steps.
    inputs, dt : Inputs, float
        As for `SteppedRun.horizon`.
    """
    dt = arguments.number("dt", dt, positive=True)
    values = _input_values(run, directions.inputs, inputs)
    return directions.straight_ahead(values, dt) or _run_step_by_step(run, directions, values, dt)


def _input_values(run: SteppedRun, names: tuple[str, ...], inputs: Inputs) -> Array:
    """Return the values of all inputs, shape (N, m)."""
    if not isinstance(inputs, Mapping):
        values = _numbers_over_horizon(WHERE, inputs)
        if values.ndim != 2 or values.shape[1] != len(names) or not len(values):
            expected = f"inputs of shape (steps, {len(names)}), of {', '.join(names) or 'none'}"
            raise InputError(WHERE, expected, f"shape {values.shape}")
        return values
    for name in inputs:
        if name not in names:
            raise InputError(WHERE, "an input that is a number in this run", quote(name), suggest(name, names))
    columns = {name: _numbers_over_horizon(f"{WHERE}: '{name}'", column) for name, column in inputs.items()}
    lengths = {column.shape for column in columns.values()}
    if len(lengths) != 1 or len(length := lengths.pop()) != 1 or length[0] == 0:
        got = ", ".join(f"{name} of shape {x.shape}" for name, x in columns.items()) or "none"
        raise InputError(WHERE, "the same number of values of each input", got)
    now = run.parameters
    return np.column_stack([columns.get(name, np.full(length, now[name])) for name in names])


def _numbers_over_horizon(where: str, values: object) -> Array:
    """Return finite numbers as an array."""
    try:
        numbers = np.array(values, dtype=np.float64)
    except (TypeError, ValueError):
        raise InputError(where, "numbers", arguments.kind_of_value(values)) from None
    if not np.isfinite(numbers).all():
        raise InputError(where, "finite numbers", "others")
    return numbers


def _run_step_by_step(run: SteppedRun, directions: StepDirections, values: Array, dt: float) -> Horizon:
    """Make the steps of a run, and go back."""
    if run.is_controlled:
        expected = "a run without controllers, as its steps have events, other lengths or an implicit scheme"
        raise InputError(WHERE, expected, "one with")
    saved, states, slopes, times = run.save(), [directions.state()], list[tuple[Array, Array, Array]](), [run.t]
    doubts, outputs = list[str](), directions.outputs[0]
    try:
        for row in values:
            if run.step(dt, dict(zip(directions.inputs, row.tolist(), strict=True))) is not None:
                raise InputError(WHERE, "steps without an event that ends the run", f"one at t = {run.t:.6g} s")
            last = run.derivatives()
            slopes.append((last.A, last.B, last.C))
            states.append(directions.state())
            times.append(run.t)
            doubts += last.doubts
    finally:
        run.restore(saved)
    a, b, c = (np.stack(x) for x in zip(*slopes, strict=True))
    names = directions.states, directions.inputs, outputs
    return Horizon(np.stack(states), a, b, c, np.array(times), *names, tuple(dict.fromkeys(doubts)))
