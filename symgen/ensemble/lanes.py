"""Runs of a chunk in the lanes of vector instructions, and which ensembles can have them."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from symgen.errors import InputError
from symgen.ir.program import LANES, lane_bases

if TYPE_CHECKING:
    from symgen.runtime.compiled import CompiledModel
    from symgen.runtime.records import Kept, RowChunk, Span, State, TableauRecord
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


def run_in_lanes(
    compiled: CompiledModel,
    observed: tuple[Any, ...],
    scheme: TableauRecord,
    span: Span,
    chunk: RowChunk,
    state: State,
    kept: Kept,
) -> int:
    """Run the selected rows, several at once; in the summary, those that single runs have to do get the code `LEFT`.

    Parameters
    ----------
    compiled : CompiledModel
        Modules emitted for lanes.
    observed : tuple
        The sizes of the model, and what single runs call at outputs: rates and their confirmation, ``accept``,
        ``observe``.
    scheme, span, chunk, state, kept
        As for `symgen.runtime.rows.run_rows`.

    Returns
    -------
    int
        How many of the selected rows were worked on.
    """
    from symgen.runtime.lanes import lane_runs, room_of_lanes

    info, law, (sizes, *observers) = compiled.info, compiled.law_module, observed
    lengths = len(state.p), len(state.w), info.windings, len(kept.outputs.times)
    lanes = state._replace(room=aligned(room_of_lanes(info.ny, scheme.stages, *lengths)))
    wide = sizes._replace(width=LANES * lane_bases(info.ny, 0, 0)["ydot"])
    return int(lane_runs((wide, law.rhs, law.accept, *observers), scheme, span, chunk, lanes, kept))


def aligned(size: int) -> NDArray[np.float64]:
    """Return zeros that begin where a line of the cache does: vectors that cross lines take twice the time."""
    found = np.zeros(size + 8)
    first = -(found.ctypes.data // 8) % 8
    return found[first : first + size]
