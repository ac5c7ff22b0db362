"""Errors of the directions of an adaptive run, which its steps leave out: embedded estimates of its own stages."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from symgen.run.layout.compiled import CompiledModel
    from symgen.run.loops.integrator import Integrator, Setup
    from symgen.run.loops.run_spec import RunSpec
    from symgen.run.single.simulation import Simulation

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Estimating:
    """An adaptive scheme that keeps the errors of directions.

    Parameters
    ----------
    integrator : Integrator
        The scheme.
    loop : compiled loop
        From `symgen.run.loops.schemes.directed`.
    lanes : int
        Number of directions.
    """

    integrator: Integrator
    loop: Any
    lanes: int

    def __getattr__(self, name: str) -> Any:
        return getattr(self.integrator, name)

    def setup(self, compiled: CompiledModel, spec: RunSpec, w: Array) -> Setup:
        """Return the arguments of the loop, with room for errors."""
        from symgen.run.loops.schemes.directed import HEAD, NUMBERS, PARTS

        plain = self.integrator.setup(compiled, spec, w)
        return replace(plain, loop=self.loop, memory=plain.memory + HEAD + self.lanes * PARTS * NUMBERS)


def with_error_estimates(integrator: Integrator, spec: RunSpec, lanes: int) -> Integrator | Estimating:
    """Return a scheme that keeps the errors of directions; constant steps have no estimate."""
    from symgen.run.loops.schemes import adams, directed, explicit

    loops = {explicit.adaptive: directed.explicit, adams.adaptive: directed.adams}
    loop = loops.get(integrator.loop(spec.adaptive)) if spec.adaptive else None
    return integrator if loop is None else Estimating(integrator, loop, lanes)


def begin_estimates(simulation: Simulation, own: int) -> None:
    """Prepare the memory of errors; `own` elements of the state come before directions."""
    from symgen.run.loops.schemes.directed import LANES, OWN

    if isinstance(scheme := simulation.integrator, Estimating):
        memory = _memory_of_errors(simulation, scheme.lanes)
        memory[OWN], memory[LANES] = own, scheme.lanes


def errors_so_far(simulation: Simulation) -> Array:
    """Return the errors of the directions of a run in its memory; empty for constant steps, which have none."""
    scheme = simulation.integrator
    return _memory_of_errors(simulation, scheme.lanes) if isinstance(scheme, Estimating) else np.zeros(0)


def _memory_of_errors(simulation: Simulation, lanes: int) -> Array:
    """Return the memory of the errors of a run."""
    from symgen.run.loops.schemes.directed import HEAD, NUMBERS, PARTS

    memory: Array = simulation.state.memory
    return memory[-HEAD - lanes * PARTS * NUMBERS :]


@dataclass(frozen=True)
class StepErrors:
    """Errors of directions in the steps of a run, by direction and part of the state.

    Attributes
    ----------
    sizes, errors, times : Array, shape (n, 3)
        Of coordinates, velocities and auxiliary states: the largest element in the run, the largest estimate of the
        error of a step, and the end of that step [s].
    """

    sizes: Array
    errors: Array
    times: Array


def step_errors(simulations: Sequence[Simulation], count: int) -> StepErrors | None:
    """Return the errors of the first `count` directions of loops; None where steps have no estimate."""
    from symgen.run.loops.schemes.directed import ERROR, HEAD, MOMENT, NUMBERS, PARTS, SIZE

    schemes = [(x, x.integrator) for x in simulations]
    memories = [_memory_of_errors(x, own.lanes)[HEAD:] for x, own in schemes if isinstance(own, Estimating)]
    if not memories:
        return None
    numbers = np.concatenate(memories).reshape(-1, PARTS, NUMBERS)[:count]
    return StepErrors(numbers[:, :, SIZE], numbers[:, :, ERROR], numbers[:, :, MOMENT])
