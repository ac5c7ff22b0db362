"""Runs of a chunk in the lanes of vector instructions, and which ensembles can have them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from symgen.errors import InputError

if TYPE_CHECKING:
    from symgen.runtime.compiled import CompiledModel
    from symgen.runtime.records import Chunk, Kept, Sizes, Span, State, Tableau
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
    scheme : Tableau
        The record of the scheme.
    n_times : int
        Output times.
    """

    compiled: CompiledModel
    scheme: Tableau
    n_times: int

    def run(self, observers: tuple[Any, ...], sizes: Sizes, span: Span, chunk: Chunk, state: State, kept: Kept) -> int:
        """Run the selected rows; in the summary, those that single runs have to do get the code `LEFT`.

        Parameters
        ----------
        observers : tuple
            What single runs call at outputs: rates and their confirmation, ``accept``, ``observe``.
        sizes : Sizes
            Of the model.
        span, chunk, state, kept
            As for `symgen.runtime.rows.run_rows`.

        Returns
        -------
        int
            How many of the selected rows were worked on.
        """
        from symgen.runtime.lanes import lane_runs, room_of_lanes

        info, law = self.compiled.info, self.compiled.law_module
        lengths = len(state.p), len(state.w), info.windings, self.n_times
        lanes = state._replace(room=aligned(room_of_lanes(info.ny, self.scheme.stages, *lengths)))
        return int(lane_runs((sizes, law.rhs, law.accept, *observers), self.scheme, span, chunk, lanes, kept))


def aligned(size: int) -> NDArray[np.float64]:
    """Return zeros that begin where a line of the cache does: vectors that cross lines take twice the time."""
    found = np.zeros(size + 8)
    first = -(found.ctypes.data // 8) % 8
    return found[first : first + size]
