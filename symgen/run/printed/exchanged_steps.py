"""Events of a mechanism without modes whose steps an importer makes, as model exchange of FMUs has it.

It asks and answers as a run with modes does, see `symgen.run.printed.exchanged_run`.
"""

from __future__ import annotations

from typing import Any

from symgen.compile.loopcode.exact import copy_numbers, exact
from symgen.compile.native import types
from symgen.run.effects.applying import EFFECT_MODEL, EFFECT_WORK, apply_effects
from symgen.run.effects.stepping import STEP_MODEL, STEP_WORK, passes
from symgen.run.layout import abi
from symgen.run.layout.start_records import INSTANT
from symgen.run.printed.exchanged_run import COMPLETE, HANDLE, HAPPENED, OVER, QUIET, STUCK
from symgen.run.printed.partition import PARTITION, PARTITION_MODEL, POOR, quality_of_choice

_F, _N, _K = types.float64, types.int64, types.int64[::1]

#: Coordinates, steps, the effects of events, and 1 for each event that ends the run, else 0.
EXCHANGED_MODEL = types.RecordType((PARTITION_MODEL, STEP_MODEL, EFFECT_MODEL, _K))


@exact()
def look(steps: Any, t: float, now: Any, happened: Any, work: Any) -> int:
    """Note the events that have happened since the last look; return their number."""
    _, _, _, _, happens, directions = steps
    count = 0
    if directions.shape[0] > 0:
        happens(t, now.y, now.p, now.w, work.middle, work.after)
    for k in range(directions.shape[0]):
        if passes(directions[k], work.before[k], work.after[k]):
            happened[k] = 1
        count += happened[k]
        work.before[k] = work.after[k]
    return int(count)


@exact()
def handle(model: Any, t: float, now: Any, happened: Any, work: Any, impact: Any) -> int:
    """Apply the events that have happened; return as `exchange_run` does."""
    _, steps, effects, ends = model
    _, _, _, _, changes = effects
    code, count = QUIET, look(steps, t, now, happened, work)
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


@exact(types.int64(EXCHANGED_MODEL, _N, _F, INSTANT, _K, _K, STEP_WORK, EFFECT_WORK, PARTITION))
def exchange_steps(
    model: Any, doing: int, t: float, now: Any, iw: Any, happened: Any, work: Any, impact: Any, part: Any
) -> int:
    """Take the state of an importer, and do what it asks for.

    Parameters
    ----------
    model : tuple
        See `EXCHANGED_MODEL`.
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
        return int(handle(model, t, now, happened, work, impact))
    if doing == COMPLETE:
        if layout.windings > 0:  # counts turns; the correction is rounding and is left
            copy_numbers(now.y, work.y, layout.ny)
            now.w[abi.STEP_STATUS] = 0.0
            accept(t, work.y, now.p, now.w, iw)
        if quality_of_choice(partition, t, now.y, now.p, now.w, part) < POOR:
            return HAPPENED
        return HAPPENED if look(steps, t, now, happened, work) > 0 else QUIET
    if directions.shape[0] > 0:
        happens(t, now.y, now.p, now.w, work.middle, work.before)
    return QUIET
