"""Where bodies are that joints of a tree carry, and parameters that would move them."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from symgen.errors import InputError
from symgen.runtime import abi
from symgen.runtime.probe import Ready

if TYPE_CHECKING:
    from symgen.describe.mechanism import Mechanism
    from symgen.runtime.compiled import CompiledModel
    from symgen.runtime.simulation import Simulation

Array = NDArray[np.float64]

#: Places of bodies after a change of parameters, beside their size or that of the mechanism: what is rounding.
MOVED = 1e-12


class CarriedBodies:
    """Coordinates and velocities of bodies of a run in joint coordinates.

    Parameters
    ----------
    mechanism : Mechanism
        With its tree.
    compiled : CompiledModel
        In joint coordinates.
    simulation : Simulation
        The run.
    """

    def __init__(self, mechanism: Mechanism, compiled: CompiledModel, simulation: Simulation) -> None:
        self.names = [f"{b.name}.{x}" for b in mechanism.bodies for x in b.coordinates]
        self.names += [f"{b.name}.{x}" for b in mechanism.bodies for x in b.speeds]
        speeds = sum(len(b.speeds) for b in mechanism.bodies)
        self._compiled, self._simulation, self._size = compiled, simulation, len(self.names) + speeds

    def at(self, p: Array | None = None) -> Array:
        """Return coordinates and velocities at the present state, with other parameters where they are given."""
        state, compiled = self._simulation.state, self._compiled
        numbers, found = state.p.copy(), np.zeros(self._size)
        if p is not None:
            numbers[: len(p)] = p
            compiled.prepare(numbers)
        observe = Ready(compiled.model.bodies, abi.OBSERVE)
        observe(float(state.clock[abi.TIME]), state.y.copy(), numbers, state.w.copy(), np.zeros(len(state.y)), found)
        return found[: len(self.names)]

    def check(self, p: Array) -> None:
        """Refuse parameters that move bodies at the present state.

        Raises
        ------
        InputError
            If they do: joints of the tree hold wherever they are, so that nothing else would notice.
        """
        with np.errstate(all="ignore"):
            before, after = self.at(), self.at(p)
        least = float(self._simulation.state.w[abi.LENGTH])
        by = np.abs(after - before) / np.maximum(np.abs(before), least)
        if not by.max(initial=0.0) <= MOVED:
            name = self.names[int(np.argmax(np.where(np.isfinite(by), by, np.inf)))]
            expected = "parameters that leave the position of every joint as it is"
            raise InputError("set", expected, f"some that move {name}", "start anew for another geometry")
