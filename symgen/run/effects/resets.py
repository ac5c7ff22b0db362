"""Resets of runs: events that change a state, in one source for single runs, rows of sweeps, C and FMUs."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np

from symgen.compile.loopcode.loop_instances import Meanings
from symgen.compile.native.annotations import Array, Integers, Record
from symgen.run.effects.accumulation import Past, accumulation, add_resets, latest_events
from symgen.run.effects.applying import APPLIED, EffectModel, EffectWork
from symgen.run.effects.applying import apply_effects as apply_chosen
from symgen.run.layout import abi
from symgen.run.layout import ensemble_abi as e
from symgen.run.layout.start_records import Instant, Layout
from symgen.run.loops import search_records as records
from symgen.run.loops.afresh import begin_afresh
from symgen.run.loops.event_loop import EventState, notes_at
from symgen.run.loops.unbound import keep_after, keep_before

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from symgen.run.effects.effects import Effects


class KeptEffect(Record):
    """What one effect was, for a single run.

    Attributes
    ----------
    y : Array, shape (ny,)
        State before it.
    w : Array, shape (nw,)
        Scratch after it.
    v, impulses, energy : Array, shapes (nv,), (m + velocities,), (1,)
        Velocities after it, impulses of rows and of velocities that were set, and the change of the energy [J],
        nan where nothing has happened.
    """

    y: Array
    w: Array
    v: Array
    impulses: Array
    energy: Array


class OfEffects(Record):
    """What events change in runs, and their past.

    Attributes
    ----------
    rates, confirm, happens : function
        Rates of v and multipliers, their confirmation, switching functions.
    model : EffectModel
        First argument of `apply_effects`.
    resets, stops, chosen : Array of int64, shape (events,)
        1 for events that change a run; for those that end it; working memory.
    work, past : EffectWork, Past
        Working memory of effects; past resets of the present run.
    ends : Array, shape (HEAD_OF_EVENTS,)
        Why events end the present run, see `symgen.run.layout.ensemble_abi`.
    kept : KeptEffect
        The latest reset.
    """

    rates: abi.Rhs
    confirm: abi.Rhs
    happens: abi.Observe
    model: EffectModel
    resets: Integers
    stops: Integers
    chosen: Integers
    work: EffectWork
    past: Past
    ends: Array
    kept: KeptEffect


def new_kept_effect(layout: Layout, work: EffectWork, keeps: bool) -> KeptEffect:
    """Return memory for one effect; empty where nobody reads it."""
    sizes = len(work.state), len(work.scratch), layout.nv, len(work.impulse.impulses), 1
    return KeptEffect(*(np.full(size if keeps else 0, math.nan) for size in sizes))


def new_effects(
    effects: Effects,
    functions: tuple[Any, Any, Any],
    actions: tuple[NDArray[np.int64], NDArray[np.int64]],
    memory: tuple[Any, Any],
    keeps: bool,
) -> OfEffects:
    """Return the effects of events.

    Parameters
    ----------
    effects : Effects
        The effects.
    functions : tuple of function
        Rates of v and multipliers, their confirmation, switching functions.
    actions : tuple of Array of int
        1 for events that change a run, and for those that end it.
    memory : (EffectWork, Past)
        Working memory, and past resets.
    keeps : bool
        Whether somebody reads the effects.
    """
    chosen, kept = np.zeros(len(effects.names), dtype=np.int64), new_kept_effect(effects.model[0], memory[0], keeps)
    ends = np.full(e.HEAD_OF_EVENTS, math.nan)
    return OfEffects(*functions, effects.model, *actions, chosen, *memory, ends, kept)


def store_before(kept: KeptEffect, y: Array) -> None:
    """Keep the state before an effect."""
    for i in range(kept.y.shape[0]):
        kept.y[i] = y[i]


def store_state_after(kept: KeptEffect, now: Instant, first: int, work: EffectWork) -> None:
    """Keep the changes of an effect; the velocities begin at `first` in the state."""
    for i in range(kept.w.shape[0]):
        kept.w[i] = now.w[i]
    for j in range(kept.v.shape[0]):
        kept.v[j] = now.y[first + j]
    for j in range(kept.impulses.shape[0]):
        kept.impulses[j] = work.impulse.impulses[j]
    kept.energy[0] = work.energy[0]


def first_note(state: EventState) -> int:
    """Return the index of the first note of a run."""
    return int(notes_at(int(state.hunt[records.COUNT]), state.y.shape[0], state.w.shape[0]))


def forget_resets(effects: OfEffects) -> None:
    """Forget the resets of the run before, and why it ended."""
    for k in range(effects.past.counts.shape[0]):
        effects.past.counts[k] = 0
    for k in range(effects.ends.shape[0]):
        effects.ends[k] = math.nan


def choose_resets(effects: OfEffects, state: EventState) -> int:
    """Choose the events noted at the present time that change a run; return the last one, -1 for none."""
    hunt, chosen, t, last = state.hunt, effects.chosen, state.clock[abi.TIME], -1
    first, size = first_note(state), 2 + state.y.shape[0]
    for k in range(chosen.shape[0]):
        chosen[k] = 0
    for i in range(int(hunt[records.NOTED])):
        at, k = hunt[first + i * size], int(hunt[first + i * size + 1])
        if at == t and k < chosen.shape[0] and effects.resets[k] != 0:
            chosen[k], last = 1, k
    return last


def is_stopped(effects: OfEffects, state: EventState) -> bool:
    """Return whether an event noted at the present time ends a run."""
    hunt, t, stops = state.hunt, state.clock[abi.TIME], False
    first, size = first_note(state), 2 + state.y.shape[0]
    for i in range(int(hunt[records.NOTED])):
        at, k = hunt[first + i * size], int(hunt[first + i * size + 1])
        stops = stops or (at == t and k < effects.stops.shape[0] and effects.stops[k] != 0)
    return stops


def change_nothing(last: int, effects: OfEffects, state: EventState) -> int:
    """Return `MET` to go on, or `DONE` where an event ends a run that no event changes."""
    return int(abi.DONE) if is_stopped(effects, state) else int(abi.MET)


def apply_resets(last: int, effects: OfEffects, state: EventState) -> int:
    """Apply the chosen resets; return `MET` to go on, or the code of the end of the run.

    Parameters
    ----------
    last : int
        The last chosen event, -1 for none.
    effects : OfEffects
        The effects; why a run ends is written to its ``ends``.
    state : State
        State of the run.

    Returns
    -------
    int
        `MET`; `DONE` where an event ends the run; `GATHERED` where resets accumulate, or `IMPOSSIBLE` where joints or
        other effects do not allow one.
    """
    if last >= 0:
        now, t, chosen = Instant(state.y, state.p, state.w), state.clock[abi.TIME], effects.chosen
        nq = effects.model[0].nq
        keep_before(effects.kept, state.y)
        code = apply_chosen(effects.model, t, now, chosen, effects.work)
        if code != APPLIED:
            effects.ends[e.IMPOSSIBLE_EVENT], effects.ends[e.FAILURE] = float(last), float(code)
            return int(e.IMPOSSIBLE)
        keep_after(effects.kept, now, nq, effects.work)
        begin_afresh(state)
        if not is_stopped(effects, state):
            add_resets(effects.past, chosen, t)
            functions = effects.rates, effects.confirm, effects.happens
            end = accumulation(functions, t, nq, now, state.iw, state.hunt, chosen, effects.past)
            if end == end:
                effects.ends[e.ACCUMULATION], effects.ends[e.GATHERING] = end, latest_events(effects.past)
                return int(abi.GATHERED)
    return int(change_nothing(last, effects, state))


KEEPING = Meanings("single runs, which read the effects", keep_before=store_before, keep_after=store_state_after)
