"""Runs of a chunk in the lanes of vector instructions, and which ensembles can have them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from symgen.errors import InputError

if TYPE_CHECKING:
    from symgen.integrators._base import BatchCall
    from symgen.model import CompiledModel
    from symgen.runtime.run import RunSpec


def check_lanes(integrator: str, spec: RunSpec) -> None:
    """Refuse what lanes cannot do.

    Raises
    ------
    InputError
        If steps are chosen from the error estimate: runs side by side take the same steps.
    """
    if spec.adaptive:
        hint = "integrator.adaptive=false with --step, or rk4"
        raise InputError("target 'lanes'", "a constant step", f"'{integrator}' with adaptive steps", hint)


@dataclass(frozen=True)
class LaneRuns:
    """Runs rows of one law, several at once.

    Parameters
    ----------
    compiled : CompiledModel
        Modules emitted for lanes.
    n_p : int
        Length of ``p``.
    n_times : int
        Output times.
    """

    compiled: CompiledModel
    n_p: int
    n_times: int

    def run(
        self, functions: tuple[Any, ...], call: BatchCall, arguments: tuple[Any, ...], left: NDArray[np.int64]
    ) -> int:
        """Run the selected rows.

        Parameters
        ----------
        functions : tuple
            Those of single runs for what is observed: rates and their confirmation, ``accept``, ``observe``.
        call : BatchCall
            The loop of the integrator, of which the tableau, the step and the end are taken.
        arguments : tuple
            From ``sizes`` to the counters, as for `symgen.runtime.lanes.lane_runs`.
        left : Array of int
            Receives 1 for rows that single runs have to do.

        Returns
        -------
        int
            How many of the selected rows were worked on.
        """
        from symgen.runtime.lanes import lane_runs, room_of_lanes

        info, law = self.compiled.info, self.compiled.law_module
        stages = call.arguments[4]
        room = room_of_lanes(info.ny, stages, self.n_p, max(1, self.compiled.law.nw), info.windings, self.n_times)
        everything: list[Any] = [law.rhs, law.accept, *functions, *call.arguments, *arguments, aligned(room), left]
        done = lane_runs(*everything)
        return int(done)


def aligned(size: int) -> NDArray[np.float64]:
    """Return zeros that begin where a line of the cache does: vectors that cross lines take twice the time."""
    found = np.zeros(size + 8)
    first = -(found.ctypes.data // 8) % 8
    return found[first : first + size]
