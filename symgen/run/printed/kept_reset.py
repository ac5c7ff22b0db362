"""Effects of one event on a state, for programs without Python whose runs are kept between calls.

Rows with bounds are out of force, as at the resets of runs: modes are chosen where the run goes on from the state.
"""

from __future__ import annotations

from typing import Any

from symgen.compile.loopcode.loop_instances import Meanings, compiled_loop, viewing
from symgen.compile.native import types
from symgen.compile.native.annotations import Array
from symgen.compile.store.jit import RuntimeFunction
from symgen.run.effects.applying import APPLIED
from symgen.run.effects.applying import apply_effects as apply_chosen
from symgen.run.effects.resets import OfEffects
from symgen.run.layout.records import State
from symgen.run.layout.start_records import Instant
from symgen.run.loops.unbound import effects_alone, leave_alone
from symgen.run.modes.bounded_rows import open_rows
from symgen.run.modes.turn_records import OfModes
from symgen.run.printed.kept_loops import Traits, recipe_of
from symgen.run.rows.row_events import ModelWithEffects

_F, _A, _K = types.float64, types.float64[::1], types.int64


@viewing
def effects_beside_modes(further: OfModes) -> OfEffects:
    """Return the effects of events in a run with rows with bounds."""
    return further.strikes.effects


def open_chosen(further: OfModes, w: Array) -> None:
    """Take the rows with bounds of a run out of force."""
    open_rows(further.choice, w)


def reset_run(event: int, t: float, y: Array, model: ModelWithEffects, state: State) -> int:
    """Change a state as an event does; return 0, or 1 where joints or other effects do not allow it.

    Parameters
    ----------
    event : int
        Number of the event; one that only records or ends a run changes nothing.
    t : float
        Time [s].
    y : Array
        The state, written.
    model, state
        As for `symgen.run.printed.kept_run.advance_run`; the scratch is left with all rows out of force.
    """
    _, _, further = model
    effects = effects_alone(further)
    if effects.resets[event] == 0:
        return 0
    for k in range(effects.chosen.shape[0]):
        effects.chosen[k] = 1 if k == event else 0
    leave_alone(further, state.w)
    code = apply_chosen(effects.model, t, Instant(y, state.p, state.w), effects.chosen, effects.work)
    return 0 if code == APPLIED else 1


_MODED = Meanings("resets of FMUs with bounded rows", effects_alone=effects_beside_modes, leave_alone=open_chosen)
_loops: dict[Any, Any] = {}


def kept_reset(loop: RuntimeFunction, traits: Traits) -> Any:
    """Return `reset_run` for a scheme, made at the first use; parameters as for `kept_loops`."""
    key = loop, traits
    if key not in _loops:
        name, meanings, _, model = recipe_of(loop, traits)
        meanings |= _MODED if traits.modes else {}
        signature = types.int64(_K, _F, _A, model, traits.state)
        _loops[key] = compiled_loop(__name__, f"{name}_reset", reset_run, signature, **meanings)
    return _loops[key]
