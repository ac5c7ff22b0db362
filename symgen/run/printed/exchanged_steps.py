"""Events of a mechanism without modes whose steps an importer makes, as model exchange of FMUs has it.

It asks and answers as a run with modes does, see `symgen.run.printed.exchanged_run`.
"""

from __future__ import annotations

from symgen.compile.loopcode.exact import copy_numbers, exact
from symgen.compile.native.annotations import Integers
from symgen.run.effects.applying import EffectModel, EffectWork, apply_effects
from symgen.run.effects.stepping import StepModel, StepWork, passes_event
from symgen.run.layout import abi
from symgen.run.layout.start_records import Instant
from symgen.run.printed.exchanged_run import COMPLETE, HANDLE, HAPPENED, OVER, QUIET, STUCK
from symgen.run.printed.partition import POOR, quality_of_choice
from symgen.run.printed.partition_tables import Partition, PartitionModel

#: Coordinates, steps, the effects of events, and 1 for each event that ends the run, else 0.
ExchangedModel = tuple[PartitionModel, StepModel, EffectModel, Integers]


@exact()
def look_at_step(steps: StepModel, t: float, now: Instant, happened: Integers, work: StepWork) -> int:
    """Note the events that have happened since the last look; return their number."""
    _, _, _, _, happens, directions = steps
    count = 0
    if directions.shape[0] > 0:
        happens(t, now.y, now.p, now.w, work.middle, work.after)
    for k in range(directions.shape[0]):
        if passes_event(directions[k], work.before[k], work.after[k]):
            happened[k] = 1
        count += happened[k]
        work.before[k] = work.after[k]
    return int(count)


@exact()
def apply_events(
    model: ExchangedModel, t: float, now: Instant, happened: Integers, work: StepWork, impact: EffectWork
) -> int:
    """Apply the events that have happened; return as `exchange_run` does."""
    _, steps, effects, ends = model
    _, _, _, _, changes = effects
    code, count = QUIET, look_at_step(steps, t, now, happened, work)
    for k in range(ends.shape[0]):
        if count > 0 and happened[k] != 0:
            happened[k] = 0
            for i in range(ends.shape[0]):
                work.chosen[i] = 1 if i == k else 0
            if changes.owners.shape[0] + changes.writes.shape[0] > 0:
                if apply_effects(effects, t, now, work.chosen, impact) != 0:
                    return STUCK
            code = OVER if ends[k] != 0 or code == OVER else HAPPENED
    return int(code)


@exact(entry=True)
def exchange_steps(
    model: ExchangedModel,
    doing: int,
    t: float,
    now: Instant,
    iw: Integers,
    happened: Integers,
    work: StepWork,
    impact: EffectWork,
    part: Partition,
) -> int:
    """Take the state of an importer, and do what it asks for.

    Parameters
    ----------
    model : tuple
        See `ExchangedModel`.
    doing : int
        `COMPLETE`, `HANDLE`, or `ASK`, from which on events are looked for.
    t : float
        Time of the importer [s].
    now, iw : Instant, Array of int
        Its state, which events change, and counters.
    happened : Array of int
        1 for each event that has happened and has not been handled, else 0.
    work, impact, part : StepWork, EffectWork, Partition
        Working memory, and the choice of coordinates.

    Returns
    -------
    int
        `QUIET`, `HAPPENED`, where the choice of coordinates is poor as well, `OVER` or `STUCK`.
    """
    partition, steps, _, _ = model
    layout, _, _, accept, happens, directions = steps
    if doing == HANDLE:
        return int(apply_events(model, t, now, happened, work, impact))
    if doing == COMPLETE:
        if layout.windings > 0:  # counts turns; the correction is rounding and is left
            copy_numbers(now.y, work.y, layout.ny)
            now.w[abi.STEP_STATUS] = 0.0
            accept(t, work.y, now.p, now.w, iw)
        if quality_of_choice(partition, t, now.y, now.p, now.w, part) < POOR:
            return HAPPENED
        return HAPPENED if look_at_step(steps, t, now, happened, work) > 0 else QUIET
    if directions.shape[0] > 0:
        happens(t, now.y, now.p, now.w, work.middle, work.before)
    return QUIET
