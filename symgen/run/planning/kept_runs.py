"""Runs for printers of other languages: from a prepared run to its loop bound to the model."""

from __future__ import annotations

from typing import TYPE_CHECKING

from symgen.run.breaks.foreseen_seams import foresee_in_run
from symgen.run.compiling.events import compile_events
from symgen.run.compiling.foresight import Passages, is_laid_out
from symgen.run.compiling.printed_run import PrintedRun

if TYPE_CHECKING:
    from collections.abc import Sequence

    from symgen.describe.mechanism import Mechanism
    from symgen.run.layout.compiled import CompiledModel
    from symgen.run.planning.prepare import Prepared


def run_with_modes(
    mechanism: Mechanism, run: Prepared, compiled: CompiledModel, datum: Sequence[float], foresees: bool = False
) -> PrintedRun | None:
    """Return a run for printers, None where no row of the mechanism has bounds, or holds for a while.

    Parameters
    ----------
    mechanism : Mechanism
        With its tree in joint coordinates.
    run : Prepared
        Scheme, steps, limits and events.
    compiled, datum
        As for a `PrintedRun`.
    foresees : bool
        Whether the run finds jumps whose times depend on parameters, or lie after its end, by itself.
    """
    return whole_run(mechanism, run, compiled, datum, foresees) if mechanism.has_modes else None


def whole_run(
    mechanism: Mechanism, run: Prepared, compiled: CompiledModel, datum: Sequence[float], foresees: bool = False
) -> PrintedRun:
    """Return a run for printers, with its events and seams; parameters as for `run_with_modes`."""
    rtol = run.spec.rtol if run.spec.adaptive else None
    watched = compile_events(mechanism, compiled, run.plan.events, rtol, run.plan.choice.directed)
    passages = _passages(run, compiled) if foresees else None
    return PrintedRun(compiled, run.plan.integrator, run.spec, watched, datum, run.plan.seams, passages)


def _passages(run: Prepared, compiled: CompiledModel) -> Passages | None:
    """Return the passages of a run that finds their times; None where these are known before it.

    The values that the run has been prepared with determine the times at which inputs jump.
    """
    spec, plan = run.spec, run.plan
    grid = 0.0, spec.step
    foreseen = foresee_in_run(plan.mechanism, plan.events, spec.adaptive, plan.integrator.order, grid)
    if plan.inputs.seams or is_laid_out(foreseen, spec.until):
        return None
    return Passages.of_run(foreseen, compiled)
