"""Joints that hold for a while, at their catch and release: in one source for single runs, rows of sweeps, C and FMUs.

What an event changes, states of the joint and velocities, is a reset (`symgen.run.effects`). Here is what rows in force
need beside it: a joint catches in its place only, what the impact takes is the joint's, and rows that depend on others
are chosen anew.
"""

from __future__ import annotations

import math

from symgen.base.ir.numerics import SKIP
from symgen.compile.loopcode.exact import exact
from symgen.compile.loopcode.loop_instances import Meanings
from symgen.compile.native.annotations import Array, Integers
from symgen.run.effects.accumulation import Past, Rates, rates_at_state, switching_values
from symgen.run.effects.applying import (
    APPLIED,
    AT_ITS_LIMIT,
    CONTRADICTED,
    NO_VALUES,
    NOT_IN_PLACE,
    EffectModel,
    EffectWork,
    apply_where_released,
    write_values,
)
from symgen.run.effects.applying import apply_effects as apply_changes
from symgen.run.effects.resets import OfEffects
from symgen.run.effects.resets import apply_resets as apply_all
from symgen.run.layout import abi
from symgen.run.layout import ensemble_abi as e
from symgen.run.layout.redundancy import choose_rows, farthest_row, is_off
from symgen.run.layout.start_records import Instant, Layout
from symgen.run.loops.event_loop import EventState
from symgen.run.loops.watch import store_rank
from symgen.run.modes.choice import look_anew

#: A joint is in its place up to this part of the mechanism's length, or of 1 rad.
IN_PLACE = 1e-6
#: A condition is at its limit at a catch up to this multiple of what it was just before, and stays there where its
#: rate falls to this part; roundings that its value may have.
_AT_LIMIT, _STAYS, _ROUNDED = 1e3, 1e-9, 8.0


@exact()
def distance_from_place(layout: Layout, before: Array, w: Array) -> float:
    """Return the largest distance of rows that come into force from their place, over what is in place; else 0."""
    most = 0.0
    for i in range(layout.m):
        if is_off(layout, i, before) and not is_off(layout, i, w):
            scale = w[abi.LENGTH] if layout.rows[2 * i + 1] != 0 else 1.0
            distance = abs(w[layout.residual + i]) / scale
            most = distance if not distance <= most else most
    return most


@exact()
def choose_rows_anew(layout: Layout, w: Array, room: Array) -> int:
    """Choose which rows are left out, as they depend on others; return their number, -1 without room for it."""
    off, m = 0, layout.m
    if room.shape[0] < m * (layout.nv + m) + 2 * m:  # `room_of_choice`, and none where rows stay the same
        return -1
    for i in range(m):
        off += 1 if is_off(layout, i, w) else 0
    redundant = m - off - farthest_row(layout, layout.nv, m, SKIP, 1, w, room)
    for i in range(m):
        w[layout.mask + i] = 0.0
    if redundant > 0:
        choose_rows(layout, m - redundant, 1, w, room)
    return int(redundant)


@exact()
def add_losses(model: EffectModel, chosen: Integers, y: Array, work: EffectWork) -> None:
    """Add the energy that catches have taken to the states of their joints: half of impulses times rates before."""
    layout, _, _, _, changes = model
    n, k = layout.nv, layout.m
    for i in range(changes.owners.shape[0]):
        event = changes.owners[i]
        if chosen[event] != 0:
            rate = -work.impulse.values[k]
            for j in range(n):
                rate += work.impulse.rows[k * n + j] * work.still[j]
            if changes.catches[2 * event] >= 0:
                y[changes.catches[2 * event]] -= 0.5 * work.impulse.impulses[k] * rate
            k += 1


@exact(entry=True)
def catch_and_apply(model: EffectModel, t: float, now: Instant, chosen: Integers, work: EffectWork) -> int:
    """Apply the effects of events as `symgen.run.effects.applying.apply_effects` does, and have rows follow.

    Returns `NOT_IN_PLACE` where a joint catches outside its place, which ``energy`` then says.
    """
    layout, geometry, formulas, _, changes = model
    moded = False
    for k in range(chosen.shape[0]):
        moded = moded or (chosen[k] != 0 and changes.catches[2 * k] != -1)
    if not moded:
        return int(apply_changes(model, t, now, chosen, work))
    for i in range(work.scratch.shape[0]):
        work.scratch[i] = now.w[i]
    for i in range(work.state.shape[0]):
        work.state[i] = now.y[i]
    formulas(t, now.y, now.p, work.scratch, work.rate, work.out)
    if not write_values(changes, chosen, work):
        return int(NO_VALUES)
    geometry(t, work.state, now.p, work.scratch)
    distance = distance_from_place(layout, now.w, work.scratch)
    if not distance <= IN_PLACE:
        work.energy[0] = distance
        return int(NOT_IN_PLACE)
    code = int(apply_where_released(model, t, now, chosen, work))
    if code == APPLIED:
        add_losses(model, chosen, now.y, work)
        geometry(t, now.y, now.p, now.w)
        if choose_rows_anew(layout, now.w, work.impulse.rows) >= 0:
            geometry(t, now.y, now.p, now.w)
    return code


@exact(entry=True)
def look_at_conditions(functions: Rates, t: float, now: Instant, iw: Integers, past: Past) -> int:
    """Evaluate switching functions and their rates at a state; return the number of numbers of the scratch."""
    for i in range(past.scratch.shape[0]):
        past.scratch[i] = now.w[i]
    for i in range(past.counters.shape[0]):
        past.counters[i] = iw[i]
    for i in range(past.rate.shape[0]):
        past.rate[i] = 0.0
    rates_at_state(functions, t, now.y, now.p, past)
    switching_values(functions, t, now.y, now.p, past)
    return int(past.scratch.shape[0])


def find_contradiction(effects: OfEffects, value: float, slope: float) -> int:
    """Return the event of a joint whose catch makes it release at once, or holds it at the limit; -1 for none.

    Parameters
    ----------
    effects : OfEffects
        After `look_at_conditions` at the state after the catch.
    value, slope : float
        Size of the function of the catch just before it, the largest one, and of its rate, the least one.
    """
    past, catches, n = effects.past, effects.model[4].catches, effects.past.values.shape[0]
    for k in range(effects.chosen.shape[0]):
        release = catches[2 * k + 1]
        if effects.chosen[k] != 0 and catches[2 * k] >= 0 and release >= 0:
            near = _AT_LIMIT * value + _ROUNDED * past.out[2 * n + release]
            if past.out[release] > near:
                effects.ends[e.FAILURE] = float(CONTRADICTED)
                return k
            if slope > 0.0 and abs(past.out[n + release]) <= _STAYS * slope and past.out[release] >= -near:
                effects.ends[e.FAILURE] = float(AT_ITS_LIMIT)
                return k
    return -1


def apply_with_holding(last: int, effects: OfEffects, state: EventState) -> int:
    """Apply the chosen resets as `symgen.run.effects.resets.apply_resets` does, where joints hold for a while.

    A joint that catches at a limit of its own condition, or whose catch makes that false, ends the run.
    """
    layout, _, _, _, changes = effects.model
    past, n, caught, moded = effects.past, effects.past.values.shape[0], False, False
    value, slope = 0.0, math.inf
    for k in range(effects.chosen.shape[0] if last >= 0 else 0):
        caught = caught or (effects.chosen[k] != 0 and changes.catches[2 * k] >= 0)
        moded = moded or (effects.chosen[k] != 0 and changes.catches[2 * k] != -1)
    functions, now = (effects.rates, effects.confirm, effects.happens), Instant(state.y, state.p, state.w)
    if caught:
        look_at_conditions(functions, state.clock[abi.TIME], now, state.iw, past)
        for k in range(effects.chosen.shape[0]):
            if effects.chosen[k] != 0 and changes.catches[2 * k] >= 0:
                value, slope = max(value, abs(past.out[k])), min(slope, abs(past.out[n + k]))
    code = int(apply_all(last, effects, state))
    if code == e.IMPOSSIBLE:
        effects.ends[e.FIRST_NUMBER] = effects.work.energy[0]
        return code
    if moded:
        store_rank(layout.m, layout.mask, layout.pivot, state.w, state.control)
        look_anew(state)
    if caught:
        look_at_conditions(functions, state.clock[abi.TIME], now, state.iw, past)
        event = find_contradiction(effects, value, slope)
        if event >= 0:
            effects.ends[e.IMPOSSIBLE_EVENT], effects.ends[e.FIRST_NUMBER] = float(event), math.nan
            return int(e.IMPOSSIBLE)
    return code


HOLDING = Meanings(
    "runs with joints that hold for a while",
    apply_chosen=catch_and_apply,
    apply_resets=apply_with_holding,
    change_state=apply_with_holding,
)
