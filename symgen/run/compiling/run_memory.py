"""What loops over runs take of events and of rows with bounds: their data, and memory for one run at a time."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from symgen.describe.bounds.modes import JAM, LEAVE, MODE, REVERSE, SLIP
from symgen.describe.parts.events import RESET
from symgen.run.effects.accumulation import new_past
from symgen.run.effects.effects import Effects
from symgen.run.layout.probe import rate_functions
from symgen.run.modes.bounded_rows import first_step, new_choice
from symgen.run.printed.kept_modes import OF_LOG, Transitions
from symgen.run.rows.row_events import OfEffects
from symgen.run.rows.row_modes import OfModes
from symgen.run.single.impacts import strikes_of
from symgen.run.starts.starting import observe_nothing

if TYPE_CHECKING:
    from symgen.run.layout.compiled import CompiledModel
    from symgen.run.layout.records import Span
    from symgen.run.loops.run_spec import BoundedRows, Watched


def what_changes(compiled: CompiledModel, watched: Watched) -> Effects:
    """Return the effects of events, where there are none too."""
    nothing = Effects(compiled, watched.names, {}, observe_nothing, ())
    return nothing if watched.effects is None else watched.effects


def effects_of_runs(compiled: CompiledModel, watched: Watched, until: float, width: int, nw: int) -> Any:
    """Return the effects of events, as `OF_EFFECTS`.

    Parameters
    ----------
    compiled : CompiledModel
        Model and method.
    watched : Watched
        Switching functions.
    until : float
        End of the runs [s].
    width, nw : int
        Lengths of a state and of the scratch array.
    """
    effects, events = what_changes(compiled, watched), len(watched.names)
    past = new_past(events, events + len(watched.switches), width, nw, until)
    resets = np.array([action == RESET for action in watched.actions], dtype=np.int64)
    chosen = np.zeros(events, dtype=np.int64)
    return OfEffects(effects.model, watched.function, resets, chosen, effects.memory(width, nw), past)


def modes_of_runs(compiled: CompiledModel, watched: Watched, rows: BoundedRows, span: Span, width: int, nw: int) -> Any:
    """Return rows with bounds and their events, as `OF_MODES`; parameters otherwise as for `effects_of_runs`.

    Parameters
    ----------
    rows : BoundedRows
        The rows.
    span : Span
        End and steps of the runs.
    """
    choice = new_choice(compiled, rows, rate_functions(compiled.law_module), width, nw)
    choice.step[0] = first_step(span)
    effects = effects_of_runs(compiled, watched, span.end, width, nw)
    strikes = strikes_of(watched, rows, what_changes(compiled, watched), effects.work, effects.past)
    choosing = np.array([action in (MODE, RESET) for action in watched.actions], dtype=np.int64)
    places = ({f"{name}.{word}": i for i, name in enumerate(rows.names)} for word in (SLIP, REVERSE, JAM, LEAVE))
    numbers = (np.array([at.get(name, -1) for name in watched.names]) for at in places)
    return OfModes(choice, strikes, effects, choosing, *numbers)


def new_transitions(rows: int) -> Any:
    """Return memory for the transitions of some rows with bounds."""
    integers = (np.zeros(size, dtype=np.int64) for size in (OF_LOG, OF_LOG, 1))
    return Transitions(np.zeros(OF_LOG), *integers, np.zeros(rows), np.zeros(rows, dtype=np.int64))
