"""Memory of the turn: what events change in a run, and its rows with bounds, for single runs, rows of sweeps and C."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from symgen.describe.bounds.bounded_modes import HIT, JAM, LEAVE, LIFT, MODE, REST, REVERSE, SLIP, STICK
from symgen.describe.parts.event_sections import RESET, STOP
from symgen.run.effects.accumulation import new_past
from symgen.run.effects.effects import Effects
from symgen.run.effects.resets import OfEffects, new_effects
from symgen.run.layout.probe import rate_functions
from symgen.run.modes.row_records import first_step, new_choice
from symgen.run.modes.strikes import new_strikes
from symgen.run.modes.transition_log import LIFT as LIFT_NUMBER
from symgen.run.modes.transition_log import OF_LOG, new_transitions
from symgen.run.modes.turn_records import OfModes
from symgen.run.single.new_state import model_sizes
from symgen.run.starts.starting import observe_nothing

if TYPE_CHECKING:
    from symgen.run.layout.compiled import CompiledModel
    from symgen.run.layout.records import Span
    from symgen.run.loops.run_spec import BoundedRows, Watched

#: Words of transitions, by the numbers of `symgen.run.modes.transition_log`.
WORDS = (SLIP, STICK, REVERSE, HIT, REST, LEAVE, LIFT)


def words_of_run(turning: Sequence[str]) -> tuple[str, ...]:
    """Return the words of transitions that a run may have; `turning` is what its switching functions say."""
    return WORDS if "contacts" in turning else WORDS[:LIFT_NUMBER]


def what_changes(compiled: CompiledModel, watched: Watched) -> Effects:
    """Return the effects of events, where there are none too."""
    nothing = Effects(compiled, watched.names, {}, observe_nothing, ())
    return nothing if watched.effects is None else watched.effects


def effects_of_runs(
    compiled: CompiledModel, watched: Watched, until: float, width: int, nw: int, keeps: bool = False
) -> OfEffects:
    """Return the effects of events.

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
    keeps : bool
        Whether somebody reads what has changed.
    """
    effects, events = what_changes(compiled, watched), len(watched.names)
    past = new_past(events, events + len(watched.switches), width, nw, until)
    functions = *rate_functions(compiled.law_module), watched.function
    actions = _marks_of_action(watched, RESET), _marks_of_action(watched, STOP)
    return new_effects(effects, functions, actions, (effects.memory(width, nw), past), keeps)


def modes_of_runs(
    compiled: CompiledModel,
    watched: Watched,
    rows: BoundedRows,
    span: Span,
    width: int,
    nw: int,
    keeps: bool = False,
) -> OfModes:
    """Return rows with bounds and their events; parameters otherwise as for `effects_of_runs`.

    Parameters
    ----------
    rows : BoundedRows
        The rows.
    span : Span
        End and steps of the runs.
    """
    choice = new_choice(compiled, rows, rate_functions(compiled.law_module), width, nw)
    choice.step[0] = first_step(span)
    end = span.end if np.isfinite(span.end) else span.duration  # a run that is stepped has no end of its own
    effects = effects_of_runs(compiled, watched, end, width, nw, keeps)
    hits = watched.events_of_rows(HIT, len(rows.names))
    losses = [-1 if place is None else place for place in rows.losses]

    def rows_of_turn(word: str) -> NDArray[np.int64]:
        pairs = zip(watched.owners, watched.words, strict=True)
        return np.array([row if own == word else -1 for row, own in pairs], dtype=np.int64)

    # a turn of a single run is read whole
    log = new_transitions(len(rows.names), max(OF_LOG, 3 * len(rows.names)) if keeps else OF_LOG)
    return OfModes(
        sizes=model_sizes(compiled),
        choice=choice,
        strikes=new_strikes(effects, hits, losses, keeps, bool(rows.contacts) or rows.one_problem),
        transitions=log,
        choosing=_marks_of_action(watched, MODE) | effects.resets,
        breaks=rows_of_turn(SLIP),
        reverses=rows_of_turn(REVERSE),
        jams=rows_of_turn(JAM),
        leaves=np.maximum(rows_of_turn(LEAVE), rows_of_turn(LIFT)),
        renewed=np.zeros(1, dtype=np.int64),
    )


def _marks_of_action(watched: Watched, kind: str) -> NDArray[np.int64]:
    """Return 1 for events of an action, else 0."""
    return np.array([action == kind for action in watched.actions], dtype=np.int64)
