"""Runs for printers of other languages: from a prepared run to its loop bound to the model."""

from __future__ import annotations

from typing import TYPE_CHECKING

from symgen.run.compiling.events import compile_events
from symgen.run.compiling.printed_run import PrintedRun

if TYPE_CHECKING:
    from collections.abc import Sequence

    from symgen.describe.mechanism import Mechanism
    from symgen.run.layout.compiled import CompiledModel
    from symgen.run.planning.prepare import Prepared


def run_with_modes(
    mechanism: Mechanism, run: Prepared, compiled: CompiledModel, datum: Sequence[float]
) -> PrintedRun | None:
    """Return a run for printers, None where no row of the mechanism has bounds.

    Parameters
    ----------
    mechanism : Mechanism
        With its tree in joint coordinates.
    run : Prepared
        Scheme, steps, limits and events.
    compiled, datum
        As for a `PrintedRun`.
    """
    return whole_run(mechanism, run, compiled, datum) if mechanism.bounded else None


def whole_run(mechanism: Mechanism, run: Prepared, compiled: CompiledModel, datum: Sequence[float]) -> PrintedRun:
    """Return a run for printers, with its events and seams; parameters as for `run_with_modes`."""
    rtol = run.spec.rtol if run.spec.adaptive else None
    watched = compile_events(mechanism, compiled, run.plan.events, rtol)
    return PrintedRun(compiled, run.plan.integrator, run.spec, watched, datum, run.plan.seams)
